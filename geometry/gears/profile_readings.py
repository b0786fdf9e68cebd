"""Arcs read off the exact outline of a tooth, as one reads them off a drawing: no formula of the involute."""

from __future__ import annotations

import cmath
from dataclasses import dataclass

from geometry.curve import Curve, end_point, start_point
from geometry.errors import ParameterError, at_least, at_most
from geometry.gears.spur import SpurGear
from geometry.gears.tooth import tooth_side
from geometry.intersect import crossing_circle
from geometry.tolerance import TOLERANCES


@dataclass(frozen=True, slots=True)
class ProfileReadings:
    """Tooth and space on one circle, arcs in mm."""

    radius: float
    thickness: float
    space_width: float


def profile_readings(gear: SpurGear, radius: float) -> ProfileReadings:
    """Where the generated outline crosses a circle: fillet, flank or relief, whichever is there.

    Raises
    ------
    ParameterError
        The circle does not cross the tooth sides between root and tip.
    """
    side = tooth_side(gear)
    slack = TOLERANCES.relative_join * radius
    for segment in reversed(side.segments):
        low, high = abs(start_point(segment.curve)), abs(end_point(segment.curve))
        if low - slack <= radius <= high + slack and high - low > slack:
            angle = -cmath.phase(_point_at(segment.curve, radius, low, high))
            return ProfileReadings(radius, 2 * radius * angle, radius * (gear.pitch_angle - 2 * angle))
    least, most = at_least(2 * gear.root_radius), at_most(2 * gear.tip_radius)
    raise ParameterError("diameter", 2 * radius, f"must be between root and tip circle, {least} to {most} mm")


def _point_at(curve: Curve, radius: float, low: float, high: float) -> complex:
    if radius <= low:
        return start_point(curve)
    return end_point(curve) if radius >= high else complex(curve.point(crossing_circle(curve, radius).value))
