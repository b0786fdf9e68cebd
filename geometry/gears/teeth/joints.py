"""Where the curves of one tooth side meet: true crossings by bracketed roots.

Every curve here runs outwards on the lower side of tooth 1, and the distance from the axis grows along
it, so a crossing is a root of the difference of polar angles at one radius.
"""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, TypeAlias

from geometry.base.errors import ConvergenceError, ParameterError, UndercutError
from geometry.base.record import replace
from geometry.base.roots import bracketed_root
from geometry.curves.intersect import crossing_circle
from geometry.curves.involute import Involute

if TYPE_CHECKING:
    from geometry.curves.cutter_fillet import CutterFillet
    from geometry.curves.trochoid import RackFillet
    from geometry.gears.teeth.spur import SpurGear

GearFillet: TypeAlias = "RackFillet | CutterFillet"

# rad: a few last digits of a polar angle
_ROUNDING = 1e-15


def joint_roll(fillet: GearFillet, base_radius: float) -> float:
    """Roll angle of the flank point cut by the end of the cutter's flank, rad; negative: undercut."""
    return float(fillet.pitch_radius * math.cos(fillet.end) - fillet.normal_length(fillet.end)) / base_radius


def fillet_flank_joint(fillet: GearFillet, flank: Involute) -> tuple[GearFillet, Involute]:
    """Fillet and flank trimmed to their common point: tangent, or the true crossing where undercut.

    Raises
    ------
    UndercutError
        The fillet takes all of the flank: they have no point in common.
    """
    roll = joint_roll(fillet, flank.base_radius)
    if roll >= 0:
        return fillet, replace(flank, start_roll=roll)

    def lead(u: float) -> float:
        point = complex(fillet.point(u))
        return cmath.phase(point) - flank.polar_angle_at_radius(abs(point))

    at_base = parameter_at_radius(fillet, flank.base_radius)
    if lead(at_base) <= _ROUNDING:
        # the cut into the flank is below rounding: both meet on the base circle
        return replace(fillet, end=at_base), flank
    if (left := lead(fillet.end)) > 0:
        raise UndercutError("undercut", left, "no_involute_below_tip")
    crossing = bracketed_root(lead, at_base, fillet.end).value
    radius = abs(complex(fillet.point(crossing)))
    return replace(fillet, end=crossing), replace(flank, start_roll=flank.roll_at_radius(radius))


def form_length(gear: SpurGear) -> float:
    """Length along the flank's normal from the base circle to where the fillet leaves it; nan where it leaves none."""
    try:
        _, left = fillet_flank_joint(gear.fillet(), gear.flank())
    except (ConvergenceError, ParameterError):
        # far below the last shift that leaves a tooth no fillet has a point at all, and no cutter an angle
        return math.nan
    return left.start_roll * left.base_radius


def parameter_at_radius(fillet: GearFillet, radius: float) -> float:
    """Parameter u at which a rising fillet is ``radius`` from the axis."""
    high = fillet.domain[1]
    if abs(complex(fillet.point(high))) <= radius:
        return high
    return crossing_circle(fillet, radius).value


def flank_crossing_radius(inner: Involute, outer: Involute, low: float, high: float) -> float | None:
    """Radius in [low, high] above which ``outer`` bounds the tooth; None where it does not reach it yet.

    Returns ``low`` where ``outer`` bounds the tooth from there on.
    """

    def lead(radius: float) -> float:
        return outer.polar_angle_at_radius(radius) - inner.polar_angle_at_radius(radius)

    if lead(high) <= 0:
        return None
    if lead(low) >= 0:
        return low
    return bracketed_root(lead, low, high).value


def pointed_radius(flank: Involute) -> float:
    """Radius at which a lower flank reaches the tooth's centre line (both flanks meet), mm."""
    if flank.base_angle >= 0:
        return flank.base_radius
    high = 2 * flank.base_radius
    while flank.polar_angle_at_radius(high) < 0:
        high *= 2
    return bracketed_root(flank.polar_angle_at_radius, flank.base_radius, high).value


def greatest_lead(fillet: GearFillet) -> float:
    """Greatest height above the tooth's centre line that a lower fillet reaches, mm; negative: clear."""
    low, high = fillet.domain

    def slope(u: float) -> float:
        return float(fillet.tangent(u).imag)

    ends = max(complex(fillet.point(low)).imag, complex(fillet.point(high)).imag)
    if slope(low) > 0 > slope(high):
        return max(ends, complex(fillet.point(bracketed_root(slope, low, high).value)).imag)
    return ends
