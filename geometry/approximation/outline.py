"""Boundaries for CAD: arcs and lines as themselves, every other curve as a B-spline within a tolerance."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from geometry.approximation.splines import SplineFit, fit_spline
from geometry.base.placement import Placement2
from geometry.curves.bounds import Bound
from geometry.curves.bspline import BSpline
from geometry.curves.curve import Curve
from geometry.curves.line_arc import Arc, Line
from geometry.plane.profile import Profile

CadCurve = Arc | Line | BSpline


@dataclass(frozen=True, slots=True)
class Outline:
    """One period of finished curves, placed ``count`` times, and the bound of its error, mm."""

    period: tuple[CadCurve, ...]
    count: int
    max_error: float
    bound: Bound
    clockwise: bool = False

    def curves(self) -> Iterator[CadCurve]:
        """All curves in order of travel; a full circle about the origin is one arc."""
        arcs = [c for c in self.period if isinstance(c, Arc)]
        if self.count == 1 and len(arcs) == len(self.period) and len({(a.centre, a.radius) for a in arcs}) == 1:
            sense = math.copysign(2 * math.pi, arcs[0].sweep)
            yield Arc(arcs[0].centre, arcs[0].radius, arcs[0].start_angle, sense)
            return
        pitch = (-2 if self.clockwise else 2) * math.pi / self.count
        for k in range(self.count):
            placement = Placement2(pitch * k)
            for curve in self.period:
                yield curve if k == 0 else curve.placed(placement)


def spline_outline(
    profile: Profile, tolerance: float, *, degree: int, continuity: int, turned: bool = False
) -> Outline:
    """An exact profile as arcs, lines and B-splines within ``tolerance`` mm.

    ``turned``: for screw surfaces; only arcs about the axis stay arcs, all else becomes a B-spline.
    """
    done: dict[Curve, BSpline] = {}
    # the latest of each kind of curves that differ little from one to the next
    alike: dict[object, SplineFit] = {}
    period: list[CadCurve] = []
    worst, certified = 0.0, True
    for curve in (s.curve for s in profile.period):
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
            fit = fit_spline(curve, tolerance, degree=degree, continuity=continuity, like=alike.get(family))
            if family is not None:
                alike[family] = fit
            spline, worst = fit.spline, max(worst, fit.max_error)
            certified = certified and fit.bound == "certified"
        done[curve] = spline
        period.append(spline)
    bound: Bound = "exact" if worst == 0 else "certified" if certified else "sampled"
    return Outline(tuple(period), profile.count, worst, bound, profile.clockwise)
