"""Splines over strips of a worm's surface: knots along every line of its section and around, shared by all cells."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from geometry.approximation.tensor import axis_poles, clamped, greville
from geometry.base.errors import ConvergenceError
from geometry.base.record import Record
from geometry.curves.bspline import basis_matrix
from geometry.curves.curve import Real

DEGREE = 7
# kernels join curves and surfaces within 1e-7 mm; edges are kept well below that
TARGET, MARGIN = 2e-8, 1.5
# of the size, for rounding
_ROUNDING = 2e-15
_MOST_SPANS = 64
_SAMPLES = 11
_MOST_ROUNDS = 12

# exact points (cells, u, v, 3) over a line of the section, by its number, at shares u of it and v of its cells
Points = Callable[[int, Real, Real], Real]


class Knots(Record, eq=False):
    """Knots along each line and around, from 0 to 1, and how far their splines lie from the points between, mm."""

    along: list[Real]
    around: Real
    worst: float


def fitted_knots(lines: int, points: Points, tolerance: float, reach: float) -> Knots:
    """As many spans over ``lines`` and cells as keep the splines of a body of that ``reach`` within the tolerance, mm.

    Raises
    ------
    ConvergenceError
        64 spans for a step are not enough.
    """
    target = max(min(tolerance, TARGET) / MARGIN, 4 * _ROUNDING * reach)
    spans = [1] * (lines + 1)
    for _ in range(_MOST_ROUNDS):
        v_knots = clamped(DEGREE, np.linspace(0.0, 1.0, spans[-1] + 1))
        u_knots = [clamped(DEGREE, np.linspace(0.0, 1.0, n + 1)) for n in spans[:-1]]
        errors = [_errors(points, k, knots, v_knots) for k, knots in enumerate(u_knots)]
        # a spline that is off both ways is off by both
        worst = max(map(sum, errors))
        if worst <= target:
            return Knots(u_knots, v_knots, worst)
        for k, (along, _) in enumerate(errors):
            spans[k] = _more(spans[k], along, target)
        spans[-1] = _more(spans[-1], max(e for _, e in errors), target)
        if max(spans) > _MOST_SPANS:
            break
    raise ConvergenceError("spline surfaces of the thread", worst, max(spans))


def _more(spans: int, error: float, target: float) -> int:
    return spans if error <= target / 2 else math.ceil(spans * min(2.0, max(1.2, (error / target) ** (1 / 8))))


def _errors(points: Points, k: int, u_knots: Real, v_knots: Real) -> tuple[float, float]:
    """Errors of the splines of a line along it and around, mm, each as if the other were exact."""
    fine = [np.linspace(0, 1, _SAMPLES * (len(x) - 2 * DEGREE - 1) + 1) for x in (u_knots, v_knots)]
    exact, worst = points(k, fine[0], fine[1]), []
    for way, knots in enumerate((u_knots, v_knots)):
        at = [greville(DEGREE, knots), fine[1]] if way == 0 else [fine[0], greville(DEGREE, knots)]
        poles = axis_poles(DEGREE, knots, points(k, *at), 1 + way)
        made = np.moveaxis(np.tensordot(basis_matrix(DEGREE, knots, fine[way]), poles, axes=(1, 1 + way)), 0, 1 + way)
        worst.append(float(np.linalg.norm(made - exact, axis=-1).max()))
    return worst[0], worst[1]
