"""What moving the sides of gears and of rings out of the material has in common: corner arcs, and what is kept."""

from __future__ import annotations

import cmath
import math

from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import Curve, start_point
from geometry.curves.line_arc import Arc
from geometry.plane.profile import Label, Segment, joint_turn


def corner_arc(before: Curve, after: Curve, distance: float) -> list[Segment]:
    """The arc of radius ``distance`` mm about a convex corner between two curves; none at another joint."""
    turn = joint_turn(before, after)
    if not turn > TOLERANCES.smooth_angle:
        return []
    arriving = cmath.phase(complex(before.tangent(before.domain[1])))
    return [Segment(Arc(start_point(after), distance, arriving - math.pi / 2, turn), Label.CORNER)]


def kept_from(pieces: list[Segment], found: tuple[int, float]) -> list[Segment]:
    """The pieces from the parameter of one of them on, by its index."""
    index, at = found
    curve, label = pieces[index].curve, pieces[index].label
    rest = pieces[index + 1 :]
    return [Segment(curve.trimmed(at, curve.domain[1]), label), *rest] if at < curve.domain[1] else rest
