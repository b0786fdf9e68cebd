"""``higherpair calc cam`` of a wedge cam: a plate that slides under its follower; everything over its travel, mm."""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np
from msgspec import Meta

from geometry.base.errors import ParameterError, limit
from geometry.cams.plane.wedge import Swinging, Upright, WedgeCam, sharpest_crest, steepest
from parts.base.texts import N_
from parts.cams.wedge_cam.part import WEDGE_CAM, WedgeCamSpec, wedge_findings, wedge_phases
from parts.keys.base import mm
from parts.pages.cam_steps import (
    TOPIC,
    Phases,
    coefficient_steps,
    grid,
    motion_columns,
    phase_steps,
    radius_step,
    straightened,
    with_left_sides,
)
from parts.pages.inputs import calculation
from parts.pages.page import Sheet, Table, table_of
from parts.texts.findings import finding_message

# rows of a table by default, about, and at most
_ROWS, _MOST_ROWS = 36, 3600

_STEP = mm("step of the table over the travel; default: a round one", above=0, most=1000)
_PLATE_VELOCITY = Meta(gt=0, le=1e6, description="of the plate: adds velocities", extra={"unit": "mm/s"})


class WedgeKeys(WedgeCamSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of a wedge cam, the step of its table, and how fast the plate goes."""

    step: Annotated[float, _STEP] | None = None
    plate_velocity: Annotated[float, _PLATE_VELOCITY] | None = None


@calculation(TOPIC, WedgeKeys)
def sheet(keys: WedgeKeys) -> Sheet:
    """The calculation of a wedge cam."""
    cam = WEDGE_CAM.thing(keys, {})
    step = _step(keys, cam.motion.travel)
    swings = keys.oscillating is not None
    lift = math.radians(keys.swing_deg) if swings else keys.lift
    phases = Phases(tuple(wedge_phases(keys, lift)), lift, swings, slides=True)
    page = Sheet(TOPIC, N_("Wedge cam (a plate that slides)"))
    phase_steps(page, phases)
    page.add("whole_travel", cam.motion.travel)
    radius_step(page, cam.kind, cam.radius)
    page.add("base_height", keys.base_height)
    if isinstance(cam.mount, Swinging):
        page.told(arm_length=cam.mount.arm_length, pivot_height=cam.mount.pivot.imag)
        page.add("start_angle_deg", math.degrees(cam.mount.start_angle))
    coefficient_steps(page, phases)
    _sizes(page, cam)
    page.data["phases"] = phases.data()
    page.tables.append(_positions(cam, step, keys.plate_velocity, swings=swings))
    if keys.plate_velocity is not None:
        _velocities(page, cam, keys.plate_velocity, swings=swings)
    page.notes += [finding_message(f) for f in wedge_findings(keys, cam)]
    return page


def _step(keys: WedgeKeys, travel: float) -> float:
    """The step of the table, mm: 1, 2 or 5 times a power of ten."""
    if keys.step is None:
        power = 10.0 ** math.floor(math.log10(travel / _ROWS))
        return next(k * power for k in (1, 2, 5, 10) if travel / (k * power) <= _ROWS)
    if travel / keys.step > _MOST_ROWS:
        raise ParameterError("step", keys.step, "too_many_rows", limit(travel / _MOST_ROWS, keys.step))
    return keys.step


def _sizes(page: Sheet, cam: WedgeCam) -> None:
    page.section("Sizes")
    for name, sense in (("rise", 1), ("return", -1)):
        found = steepest(cam, sense)
        if found is None:
            continue
        if isinstance(cam.mount, Upright):
            page.add("peak_slope", math.tan(found), symbol="|S'|_max", key="S1m")
        formula = "arctan({S1m})" if isinstance(cam.mount, Upright) else ""
        page.add(f"pressure_angle_{name}_deg", math.degrees(found), formula)
    crest = sharpest_crest(cam)
    page.add("least_curvature_radius", crest - cam.radius)


def _positions(cam: WedgeCam, step: float, velocity: float | None, *, swings: bool) -> Table:
    """s, S, S', S'', pressure angle, radius of curvature, profile in the plate's frame; the last row is the end."""
    travel = cam.motion.travel
    inner = [joint.angle for joint in cam.motion.impacts() if joint.angle > 0]
    told, at = with_left_sides(np.append(grid(cam.motion.pieces, step, travel), travel), inner)
    motion = [cam.motion.value(at, k) for k in range(3)]
    columns, heads = motion_columns(motion, told, swings=swings, slides=True, speed=velocity)
    normal = 1j * cam.rate(at)
    profile = cam.centre(at) - cam.radius * normal / np.abs(normal)
    with np.errstate(divide="ignore"):
        bend = -1 / cam.pitch_curvature(at) - cam.radius
    title = N_("Positions: travel of the plate, motion, pressure angle, radius of curvature, profile of the plate")
    heads += [("nu", "deg"), ("rho", "mm"), ("x", "mm"), ("y", "mm")]
    columns += [np.degrees(cam.pressure_angle(at)), straightened(bend, travel), profile.real, profile.imag]
    return table_of("positions", title, heads, zip(*columns, strict=True))


def _velocities(page: Sheet, cam: WedgeCam, velocity: float, *, swings: bool) -> None:
    """v = S' c, a = S'' c^2."""
    page.section("At this velocity of the plate")
    page.add("plate_velocity", velocity)
    first, second = (max(map(abs, cam.motion.extremes(k))) for k in (1, 2))
    names = ("greatest_angular_velocity", "greatest_angular_acceleration")
    if not swings:
        names, second = ("greatest_velocity", "greatest_acceleration"), second / 1000
    page.add(names[0], first * velocity)
    page.add(names[1], second * velocity**2)
