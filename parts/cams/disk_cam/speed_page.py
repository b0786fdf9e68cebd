"""The section "at a speed" of ``higherpair calc cam``: times, velocities and accelerations of the follower."""

from __future__ import annotations

import math

import numpy as np

from geometry.cams.motion.follower_motion import FollowerMotion
from parts.pages.page import Sheet


def speed_section(page: Sheet, motion: FollowerMotion, speed_rpm: float, *, slides: bool) -> None:
    """omega = pi n / 30, and of each moving phase t = phi / omega and the peaks of v = S' omega, a = S'' omega^2."""
    omega = math.pi * speed_rpm / 30
    page.section("At this speed of the cam")
    page.add("speed_rpm", speed_rpm)
    page.add("angular_speed", omega, "pi * {n_rpm} / 30")
    moving = [p for p in motion.phases if p.law is not None]
    for index, phase in enumerate(moving, 1):
        assert phase.law is not None
        many = str(index) if len(moving) > 1 else ""
        rate = abs(phase.lift) / phase.angle * phase.law.peak(1)[0]
        bend = abs(phase.lift) / phase.angle**2 * phase.law.peak(2)[0]
        page.add("time_of_phase", phase.angle / omega, symbol=f"t{many}")
        if slides:
            page.add("greatest_velocity", rate * omega, symbol=f"v_max{many}")
            page.add("greatest_acceleration", bend * omega**2 / 1000, symbol=f"a_max{many}")
        else:
            page.add("greatest_angular_velocity", rate * omega, symbol=f"ω_max{many}")
            page.add("greatest_angular_acceleration", bend * omega**2, symbol=f"ε_max{many}")
    if not moving:
        low_high = [np.abs(motion.extremes(k)).max() for k in (1, 2)]
        names = ("velocity", "acceleration") if slides else ("angular_velocity", "angular_acceleration")
        for name, value, power in zip(names, low_high, (1, 2), strict=True):
            metres = 1000.0 if name == "acceleration" else 1.0
            page.add(f"greatest_{name}", float(value) * omega**power / metres)
