"""Limits of an external gear that a pinion cutter makes: the cutter itself, undercut, how far its involute reaches."""

from __future__ import annotations

import math
from dataclasses import replace

from geometry.errors import ParameterError, at_most
from geometry.gears.cutter import checked_cutter
from geometry.gears.joints import joint_roll
from geometry.gears.spur import SpurGear
from geometry.roots import bracketed_root


def check_shaping(gear: SpurGear) -> None:
    """Refuse a cutter that cannot make the gear; nothing to say of a gear that a rack cuts.

    Raises
    ------
    ParameterError
        The cutter does not exist, does not belong to the gear, or its involute ends before the gear's tips; names
        the nearest value that works.
    """
    cutter = gear.cutter
    if cutter is None:
        return
    checked_cutter(cutter)
    if cutter.module != gear.module:
        raise ParameterError("cutter.module", cutter.module, f"must be that of the gear; {gear.module:.12g} works")
    if abs(cutter.pressure_angle - gear.rack.pressure_angle) > 1e-12:
        angle = math.degrees(gear.rack.pressure_angle)
        text = f"must be that of the gear; {angle:.12g} works"
        raise ParameterError("cutter.pressure_angle_deg", math.degrees(cutter.pressure_angle), text)
    if gear.rack.relief is not None and gear.rack.relief.depth > 0:
        raise ParameterError(
            "tip_relief.depth_coefficient", gear.rack.relief.depth, "a pinion cutter cuts none; 0 works"
        )
    reach = gear.generating_distance * math.sin(gear.generating_angle)
    most = math.hypot(gear.base_radius, reach)
    if gear.tip_radius > most * (1 + 1e-12):
        text = (
            f"the cutter's involute ends at its base circle, below the gear's tips; at most {at_most(2 * most)} works"
        )
        raise ParameterError("tip_diameter", 2 * gear.tip_radius, text)


def least_shift_with_cutter(gear: SpurGear) -> float:
    """x_min of a gear cut by a pinion cutter: the shift at which the fillet begins on the base circle.

    The roll of the joint of fillet and flank grows with the shift; its root is bracketed.
    """

    def roll(shift: float) -> float:
        moved = replace(gear, profile_shift_coefficient=shift, circumferential_thinning=0.0)
        return joint_roll(moved.fillet(), gear.base_radius)

    low = _least_shift(gear) + 1e-9
    high = max(low + 1, 1.0)
    while roll(high) < 0:
        high += 1
    return low if roll(low) >= 0 else bracketed_root(roll, low, high).value


def _least_shift(gear: SpurGear) -> float:
    """The shift at which inv(alpha_w0) = 0."""
    cutter, alpha = gear.cutter, gear.rack.pressure_angle
    assert cutter is not None
    teeth = gear.number_of_teeth + cutter.number_of_teeth
    return -(math.tan(alpha) - alpha) * teeth / (2 * math.tan(alpha)) - cutter.profile_shift_coefficient
