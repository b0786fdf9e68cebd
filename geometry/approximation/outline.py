"""Boundaries for CAD: arcs and lines as themselves, every other curve as a B-spline within a tolerance."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from geometry.approximation.splines import MOST_SPANS, SplineFit, fit_spline
from geometry.base.errors import ConvergenceError
from geometry.base.placement import Placement2
from geometry.base.record import Record, replace
from geometry.curves.bounds import Bound
from geometry.curves.bspline import BSpline
from geometry.curves.curve import Complex, Curve, Real
from geometry.curves.line_arc import Arc, Line
from geometry.plane.profile import Profile, Segment

CadCurve = Arc | Line | BSpline
# spans of a spline over the knots of a curve, a knot: with more it is shorter to end one at each
_SPANS_A_KNOT = 2


class Outline(Record):
    """One period of finished curves, placed ``count`` times, and the bound of its error, mm.

    ``faces``: of the end of a chamfer, the poles (curve's, over the depth) of the face from the whole boundary to each
    curve; a line's and an arc's are those of its ends.
    """

    period: tuple[CadCurve, ...]
    count: int
    max_error: float
    bound: Bound
    clockwise: bool = False
    faces: tuple[Complex, ...] = ()

    @property
    def is_circle(self) -> bool:
        """Whether it is one full circle."""
        arcs = [c for c in self.period if isinstance(c, Arc)]
        return self.count == 1 and len(arcs) == len(self.period) and len({(a.centre, a.radius) for a in arcs}) == 1

    def places(self) -> tuple[tuple[CadCurve, ...], Real]:
        """The curves of one period and the angles, rad, of its places (count,); a full circle is one arc."""
        period, first = self.period, self.period[0]
        if self.is_circle and isinstance(first, Arc):
            period = (replace(first, sweep=math.copysign(2 * math.pi, first.sweep)),)
        pitch = (-2 if self.clockwise else 2) * math.pi / self.count
        return period, pitch * np.arange(self.count, dtype=float)

    def curves(self) -> Iterator[CadCurve]:
        """All curves in order of travel; a full circle is one arc."""
        period, turns = self.places()
        for turn in turns.tolist():
            yield from (curve.placed(Placement2(turn)) if turn else curve for curve in period)


def parted(profile: Profile) -> Profile:
    """The profile cut at the knots of its curves: a spline stands for each part."""
    if not any(s.curve.knots.size for s in profile.period):
        return profile
    return replace(profile, period=tuple(Segment(part, s.label) for s in profile.period for part in s.curve.parts()))


def most_spans(curve: Curve) -> int:
    """Of a spline over all of a curve: where it needs more, its parts between knots need fewer."""
    return _SPANS_A_KNOT * (len(curve.knots) + 1) if curve.knots.size else MOST_SPANS


def spline_outline(
    profile: Profile, tolerance: float, *, degree: int, continuity: int, turned: bool = False, at_knots: bool = False
) -> Outline:
    """An exact profile as arcs, lines and B-splines within ``tolerance`` mm.

    One spline runs over the knots of a curve, as over the rows of a table, where the tolerance lets it; where it does
    not, or ``at_knots``, one stands for each part. ``turned``: for screw surfaces; only arcs about the axis stay arcs,
    all else becomes a B-spline.
    """
    done: dict[Curve, BSpline] = {}
    # the latest of each kind of curves that differ little from one to the next
    alike: dict[object, SplineFit] = {}
    period: list[CadCurve] = []
    worst, certified = 0.0, True
    # a spline is no whole loop
    at_knots = at_knots or (len(profile.period), profile.count) == (1, 1)
    left = [s.curve for s in (parted(profile) if at_knots else profile).period][::-1]
    while left:
        curve = left.pop()
        if isinstance(curve, Line) and turned:
            period.append(BSpline(1, np.array([0.0, 0.0, 1.0, 1.0]), np.array([curve.start, curve.end])))
            continue
        if isinstance(curve, Line) or (isinstance(curve, Arc) and not (turned and curve.centre)):
            period.append(curve)
            continue
        twin = done.get(curve.mirrored())
        if twin is not None:
            # both sides of a tooth are mirror images: one is fitted
            spline = twin.mirrored()
        else:
            family = getattr(curve, "family", None)
            most = most_spans(curve)
            try:
                fit = fit_spline(
                    curve, tolerance, degree=degree, continuity=continuity, like=alike.get(family), most=most
                )
            except ConvergenceError:
                if not curve.knots.size:
                    raise
                left += curve.parts()[::-1]
                continue
            if family is not None:
                alike[family] = fit
            spline, worst = fit.spline, max(worst, fit.max_error)
            certified = certified and fit.bound == "certified"
        done[curve] = spline
        period.append(spline)
    bound: Bound = "exact" if worst == 0 else "certified" if certified else "sampled"
    return Outline(tuple(period), profile.count, worst, bound, profile.clockwise)
