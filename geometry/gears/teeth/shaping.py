"""Limits of an external gear that a pinion cutter makes: the cutter itself, undercut, how far its involute reaches."""

from __future__ import annotations

import math

from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import replace
from geometry.base.roots import bracketed_root
from geometry.gears.teeth.joints import joint_roll
from geometry.gears.teeth.spur import SpurGear


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
    from geometry.gears.teeth.cutter import checked_cutter

    checked_cutter(cutter)
    if cutter.module != gear.module:
        raise ParameterError("cutter.module", cutter.module, "not_that_of_gear", Nearest(gear.module))
    if abs(cutter.pressure_angle - gear.pressure_angle) > 1e-12:
        own = Nearest(gear.pressure_angle)
        raise ParameterError("cutter.pressure_angle", cutter.pressure_angle, "not_that_of_gear", own)
    if gear.rack.relief is not None and gear.rack.relief.depth > 0:
        raise ParameterError("relief.depth", gear.rack.relief.depth, "no_relief_by_cutter", Nearest(0.0))
    reach = gear.generating_distance * math.sin(gear.generating_angle)
    most = math.hypot(gear.base_radius, reach)
    if gear.tip_radius > most * (1 + 1e-12):
        tip = 2 * gear.tip_radius
        raise ParameterError.beyond("tip_diameter", tip, "cutter_involute_ends_below_tip", 2 * most)


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
    cutter, alpha = gear.cutter, gear.pressure_angle
    assert cutter is not None
    teeth = gear.number_of_teeth + cutter.number_of_teeth
    return -(math.tan(alpha) - alpha) * teeth / (2 * math.tan(alpha)) - cutter.profile_shift_coefficient
