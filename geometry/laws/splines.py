"""Interpolating cubics and displacement B-splines as Bernstein pieces."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.laws.law import Law
from geometry.laws.piece import LawPiece, Real

_MOST_POINTS = 4000
_LEAST_DEGREE, _MOST_DEGREE = 3, 9


def cubic_pieces(places: Real, values: Real, *, periodic: bool) -> list[tuple[float, float, tuple[float, ...]]]:
    """The interpolating C2 cubic spline: (start, end, Bernstein coefficients) of each interval.

    ``places`` rise; ``periodic``: the last value is the first one's, and so are slope and curvature; otherwise the
    ends are "not a knot" (de Boor, A Practical Guide to Splines, chapter IV).

    Raises
    ------
    ParameterError
        Fewer than 2 points (4 where periodic), more than 4000, or places that do not rise.
    """
    n, steps = len(places), np.diff(places)
    least = 4 if periodic else 2
    if not least <= n <= _MOST_POINTS or len(values) != n:
        raise ParameterError("table", n, "number_of_points", least=least, most=_MOST_POINTS)
    if not np.all(steps > 0) or not np.all(np.isfinite(values)):
        at = int(np.argmin(steps)) + 2
        raise ParameterError("table", float(places[at - 1]), "arguments_do_not_rise", row=at)
    slopes = _slopes(steps, np.diff(values) / steps, periodic)
    return [
        (
            float(places[i]),
            float(places[i + 1]),
            (
                float(values[i]),
                float(values[i] + steps[i] * slopes[i] / 3),
                float(values[i + 1] - steps[i] * slopes[i + 1] / 3),
                float(values[i + 1]),
            ),
        )
        for i in range(n - 1)
    ]


def _slopes(h: Real, d: Real, periodic: bool) -> Real:
    """Slopes at the nodes for which the second derivative is continuous; h interval lengths, d divided differences."""
    n = len(h) + 1
    if n == 2:
        return np.array([d[0], d[0]])
    # of node i: below[i] m[i - 1] + main[i] m[i] + above[i] m[i + 1] = right[i]
    below, main, above, right = (np.zeros(n) for _ in range(4))
    below[1:-1], main[1:-1], above[1:-1] = h[1:], 2 * (h[:-1] + h[1:]), h[:-1]
    right[1:-1] = 3 * (h[1:] * d[:-1] + h[:-1] * d[1:])
    if periodic:
        # node 0 stands between the last interval and the first; the last node is node 0
        below[0], main[0], above[0] = h[0], 2 * (h[-1] + h[0]), h[-1]
        right[0] = 3 * (h[0] * d[-1] + h[-1] * d[0])
        # the corners of the matrix as a product u v^T, by Sherman and Morrison
        corner, share = below[0], above[-2] / main[0]
        main[-2] += share * corner
        main[0] *= 2
        other = np.zeros(n - 1)
        other[0], other[-1] = -main[0] / 2, above[-2]
        found, unit = (_tridiagonal(below[:-1], main[:-1], above[:-1], x) for x in (right[:-1], other))
        ratio = -2 * corner / main[0]
        slopes = found - (found[0] + ratio * found[-1]) / (1 + unit[0] + ratio * unit[-1]) * unit
        return np.append(slopes, slopes[0])
    if n == 3:
        # a parabola through three points
        main[0], above[0], right[0] = 1, 1, 2 * d[0]
        below[2], main[2], right[2] = 1, 1, 2 * d[1]
    else:
        # equal third derivatives in the first two and in the last two intervals
        for row, (a, b), (da, db), beside in ((0, h[:2], d[:2], above), (n - 1, h[:-3:-1], d[:-3:-1], below)):
            main[row], beside[row] = b, a + b
            right[row] = ((a + 2 * (a + b)) * b * da + a * a * db) / (a + b)
    return _tridiagonal(below, main, above, right)


def _tridiagonal(below: Real, main: Real, above: Real, right: Real) -> Real:
    """The solution by elimination without exchanges: the rows of splines are dominant."""
    lower, upper, pivots, values = below.tolist(), above.tolist(), main.tolist(), right.tolist()
    for i in range(1, len(values)):
        factor = lower[i] / pivots[i - 1]
        pivots[i] -= factor * upper[i - 1]
        values[i] -= factor * values[i - 1]
    values[-1] /= pivots[-1]
    for i in range(len(values) - 2, -1, -1):
        values[i] = (values[i] - upper[i] * values[i + 1]) / pivots[i]
    return np.array(values)


def hermite_coefficients(left: Sequence[float], right: Sequence[float], width: float) -> tuple[float, ...]:
    """Bernstein coefficients of the polynomial with given derivatives 0, 1, 2 ... at both ends of an interval.

    Its degree is len(left) + len(right) - 1. Each derivative fixes one more coefficient from its end: no system.
    """
    n = len(left) + len(right) - 1
    first = _end_coefficients(left, n, width)
    last = _end_coefficients([(-1) ** k * value for k, value in enumerate(right)], n, width)
    return (*first, *reversed(last))


def _end_coefficients(derivatives: Sequence[float], degree: int, width: float) -> list[float]:
    """First coefficients from the derivatives at the start: forward differences, summed up."""
    differences = [
        value * width**k * math.factorial(degree - k) / math.factorial(degree) for k, value in enumerate(derivatives)
    ]
    return [sum(math.comb(i, j) * differences[j] for j in range(i + 1)) for i in range(len(differences))]


def bspline_law(poles: Sequence[float], *, degree: int = 5, knots: Sequence[float] | None = None) -> Law:
    """Displacement as a clamped B-spline; inner ``knots`` in (0, 1), default: equally spaced.

    Poles in any unit that begin at 0 and end at the lift, which is scaled to 1; k equal poles at an end make k - 1
    derivatives vanish there.

    Raises
    ------
    ParameterError
        Degree not from 3 to 9, too few poles, poles that lift nothing, or knots out of order.
    """
    from geometry.curves.bspline import BSpline

    if not _LEAST_DEGREE <= degree <= _MOST_DEGREE:
        nearest = limit(min(max(degree, _LEAST_DEGREE), _MOST_DEGREE), degree)
        raise ParameterError("degree", degree, "out_of_range", nearest, least=_LEAST_DEGREE, most=_MOST_DEGREE)
    count = len(poles) - degree - 1
    if count < 0:
        raise ParameterError("poles", len(poles), "too_few_poles", degree=degree, least=degree + 1)
    lift = poles[-1] - poles[0]
    if not lift > 0 or not all(math.isfinite(p) for p in poles):
        raise ParameterError("poles", list(poles), "poles_lift_nothing")
    inner = np.arange(1, count + 1) / (count + 1) if knots is None else np.asarray(knots, dtype=float)
    if len(inner) != count or not np.all(np.diff(np.concatenate([[0.0], inner, [1.0]])) > 0):
        raise ParameterError("knots", inner.tolist(), "knots_do_not_rise", Nearest(None), number=count)
    vector = np.concatenate([np.zeros(degree + 1), inner, np.ones(degree + 1)])
    spline = BSpline(degree, vector, np.array([(p - poles[0]) / lift for p in poles], dtype=np.complex128))
    breaks = spline.breaks
    pieces = []
    half = (degree + 1) // 2
    for a, b in zip(breaks[:-1].tolist(), breaks[1:].tolist(), strict=True):
        # the derivatives at both ends of the span, each taken from inside it
        below = b if b == 1.0 else float(np.nextafter(b, a))
        left = [float(np.real(spline.point(a) if k == 0 else spline.derivative(a, k))) for k in range(half)]
        right = [
            float(np.real(spline.point(b) if k == 0 else spline.derivative(below, k))) for k in range(degree + 1 - half)
        ]
        pieces.append(LawPiece(a, b, hermite_coefficients(left, right, b - a)))
    return Law(f"B-spline of degree {degree}", tuple(pieces))
