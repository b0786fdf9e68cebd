"""What moving the sides of gears and of rings has in common: corner arcs, what is kept, edges of face chamfers."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Sequence

import numpy as np

from geometry.base.findings import Finding
from geometry.base.record import replace
from geometry.base.roots import bracketed_root
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import Curve, Reversed, end_point, start_point
from geometry.curves.fillet import Fillet
from geometry.curves.line_arc import Arc
from geometry.plane.profile import Label, Profile, Segment, joint_turn

# of a curve, where it is looked whether it turns back or passes a line
SAMPLES = 65
# share of a tip rounding's radius that is left at the edge of the deepest face chamfer
KEPT_ROUNDING = 0.25


def corner_arc(before: Curve, after: Curve, distance: float) -> list[Segment]:
    """The arc of radius ``distance`` mm about a convex corner between two curves; none at another joint."""
    turn = joint_turn(before, after)
    if not turn > TOLERANCES.smooth_angle:
        return []
    arriving = cmath.phase(complex(before.tangent(before.domain[1])))
    return [Segment(Arc(start_point(after), distance, arriving - math.pi / 2, turn), Label.CORNER)]


def with_corner_arcs(
    segments: Sequence[Segment], distance: float, grown: Callable[[Segment], list[Segment]], facing: float
) -> list[Segment]:
    """Segments moved outwards by ``grown``, an arc about each convex corner, the tip closed on its centre line.

    ``facing``: the direction in which the tooth points, rad.
    """
    moved: list[Segment] = []
    for index, segment in enumerate(segments):
        moved += corner_arc(segments[index - 1].curve, segment.curve, distance) if index else []
        moved += grown(segment)
    last = segments[-1].curve
    if segments[-1].label is not Label.TIP_LAND:
        leaving = cmath.phase(complex(last.tangent(last.domain[1]))) - math.pi / 2
        rest = math.remainder(facing - leaving, 2 * math.pi)
        if rest > TOLERANCES.smooth_angle:
            moved.append(Segment(Arc(end_point(last), distance, leaving, rest), Label.CORNER))
    return moved


def after_cusp(pieces: list[Segment], distance: float, findings: list[Finding]) -> tuple[list[Segment], bool]:
    """The pieces without the part of the fillet that runs back, and whether there was one, which is a finding."""
    fillet = pieces[0].curve
    if not isinstance(fillet, Fillet) or fillet.cusp() is None:
        return pieces, False
    findings.append(Finding("fillet_cusp_trimmed", distance, fillet.tip_radius + distance))
    low, high = fillet.domain
    if float(fillet.speed(high)) <= 0:
        return pieces[1:], True
    if float(fillet.speed(low)) > 0:
        # regular at both ends, running back between them: what is behind the last turn is kept
        places = np.linspace(low, high, SAMPLES)
        low = float(places[np.flatnonzero(fillet.speed(places) <= 0)[-1]]) if np.any(fillet.speed(places) <= 0) else low
        if float(fillet.speed(low)) > 0:
            return pieces, True
    turning = bracketed_root(lambda u: float(fillet.speed(u)), low, high).value
    return [Segment(replace(fillet, start=turning), Label.ROOT_FILLET), *pieces[1:]], True


def kept_from(pieces: list[Segment], found: tuple[int, float]) -> list[Segment]:
    """The pieces from the parameter of one of them on, by its index."""
    index, at = found
    curve, label = pieces[index].curve, pieces[index].label
    rest = pieces[index + 1 :]
    return [Segment(curve.trimmed(at, curve.domain[1]), label), *rest] if at < curve.domain[1] else rest


def at_chamfer(rounding: float, depth: float, deepest: float, profile: Callable[[float], Profile]) -> Profile:
    """The ``profile`` of teeth with the tip rounding, mm, that is left of theirs by a face chamfer of a ``depth``, mm.

    It shrinks by the depth, as a parallel one does; where the ``deepest`` chamfer would leave less than
    a quarter of its radius, it shrinks evenly to that quarter, so that its face does not end in a point.
    """
    shrinking = min(1.0, (1 - KEPT_ROUNDING) * rounding / deepest)
    kept = rounding - shrinking * depth
    made = profile(kept)
    if shrinking == 1.0 or kept == 0.0:
        return made
    # the centre of its arc moves with the depth: its face is no cone, and curves of any kind are followed by splines
    period = (
        Segment(Reversed(s.curve.reversed()), s.label) if isinstance(s.curve, Arc) and s.label is Label.TIP_BREAK else s
        for s in made.period
    )
    return replace(made, period=tuple(period))
