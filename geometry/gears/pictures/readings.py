"""Arcs read off the exact outline of a tooth, as one reads them off a drawing: no formula of the involute."""

from __future__ import annotations

import cmath

from geometry.base.errors import ParameterError
from geometry.base.record import Record
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import Curve, end_point, start_point
from geometry.curves.intersect import crossing_circle
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import tooth_side


class ProfileReadings(Record):
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
    end = gear.root_radius if radius < gear.root_radius else gear.tip_radius
    raise ParameterError.beyond("diameter", 2 * radius, "not_between_root_and_tip", 2 * end, digits=6)


def _point_at(curve: Curve, radius: float, low: float, high: float) -> complex:
    if radius <= low:
        return start_point(curve)
    return end_point(curve) if radius >= high else complex(curve.point(crossing_circle(curve, radius).value))
