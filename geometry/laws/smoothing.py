"""Measured values smoothed: the periodic cubic spline of least bending that stays near them.

Of all periodic curves the natural measure of bending, the integral of g''^2, plus the squares of what the values are
left by, is least for a cubic spline with knots at the places (C. H. Reinsch, Numerische Mathematik 10, 1967). The more
the bending weighs, the smoother it runs and the farther it leaves the values; here as far as a tolerance says.
"""

from __future__ import annotations

import math
from itertools import count

import numpy as np

from geometry.base.errors import ParameterError
from geometry.base.nearest import nearest
from geometry.base.roots import bracketed_root
from geometry.laws.piece import Real

# places in the order 0, n-1, 1, n-2 ...: what is two places apart on the circle is four apart there
_BAND = 4
# the weight of bending, in cubes of the mean step: where its search begins, and its factor
_FIRST_WEIGHT, _FACTOR = 1e-2, 10.0
# how near the greatest distance comes to the tolerance, and how far beyond it may be seen, parts of it
_ENOUGH, _BEYOND = 1e-9, 1e-6
# how near to the widest tolerance that works the one that is offered comes, part of it
_ROUGHLY = 0.3


def smoothed(places: Real, values: Real, period: float, tolerance: float) -> Real:
    """Values at rising ``places`` of the smoothest periodic spline that leaves none of the given ones by more than a
    tolerance; all alike where that is within it.

    ``places`` and ``values``: (n,), at least 3; ``period`` beyond the last place less the first.

    Raises
    ------
    ParameterError
        Places so near to each other beside the others that their bending is lost in the last digits at that tolerance.
    """
    level = np.full(len(values), float(np.mean(values)))
    if np.abs(values - level).max() <= tolerance:
        return level
    steps = np.diff(np.append(places, places[0] + period))
    system = _System(steps, values)
    unit = float(np.mean(steps)) ** 3

    def beyond(power: float) -> float:
        left = float(np.abs(values - system.smoothed(unit * math.exp(power))).max())
        return math.log(max(left, 1e-300) / tolerance)

    low = high = math.log(_FIRST_WEIGHT)
    step = math.log(_FACTOR)
    try:
        if beyond(low) > 0:
            low = next(at for k in count(1) if beyond(at := high - k * step) <= 0)
            high = low + step
        else:
            high = next(at for k in count(1) if beyond(at := low + k * step) > 0)
            low = high - step
        found = system.smoothed(unit * math.exp(bracketed_root(beyond, low, high, enough=_ENOUGH).value))
        if np.abs(values - found).max() <= tolerance * (1 + _BEYOND):
            return found
    except FloatingPointError:
        pass
    raise ParameterError(
        "table_tolerance",
        tolerance,
        "rows_too_uneven",
        lambda: nearest(
            lambda less: len(smoothed(places, values, period, less)) > 0,
            tolerance,
            [tolerance / 10**k for k in range(1, 7)],
            digits=9,
            share=_ROUGHLY,
        ),
    )


class _System:
    """Second derivatives c of the spline by weight w: (R + w Q Q) c = Q y, its values then y - w Q c."""

    def __init__(self, steps: Real, values: Real) -> None:
        n = len(steps)
        self._values, self._beside = values, 1 / steps
        before = np.roll(steps, 1)
        self._own = -(1 / steps + 1 / before)
        self._bent = self._times(values)
        i = np.arange(n)
        rank = np.where(2 * i < n, 2 * i, 2 * (n - 1 - i) + 1)
        self._rank = rank
        off, own = self._beside, self._own
        # both symmetric matrices by their entries (i, i), (i, i + 1), (i, i + 2), round about
        square = (own**2 + off**2 + np.roll(off, 1) ** 2, off * (own + np.roll(own, -1)), off * np.roll(off, -1))
        self._square = self._banded(square)
        self._plain = self._banded(((steps + before) / 3, steps / 6, np.zeros(n)))

    def _times(self, values: Real) -> Real:
        """Q times a column: the change of slope at each place."""
        slope = (np.roll(values, -1) - values) * self._beside
        return np.asarray(slope - np.roll(slope, 1))

    def _banded(self, entries: tuple[Real, ...]) -> Real:
        """Rows of the matrix in the folded order: entry d of row k stands d places before its diagonal."""
        n, rank = len(entries[0]), self._rank
        band = np.zeros((n, _BAND + 1))
        for shift, entry in enumerate(entries):
            other = np.roll(rank, -shift)
            np.add.at(band, (np.maximum(rank, other), np.abs(rank - other)), entry)
        return band

    def smoothed(self, weight: float) -> Real:
        """The spline's values for a weight of its bending."""
        right = np.empty_like(self._bent)
        right[self._rank] = self._bent
        bending = _solved(self._plain + weight * self._square, right)[self._rank]
        return self._values - weight * self._times(bending)


def _solved(band: Real, right: Real) -> Real:
    """The solution of a symmetric positive definite system by Cholesky's square roots, row by row.

    Raises ``FloatingPointError`` where rounding has left a matrix that is not positive definite.
    """
    rows, x = band.tolist(), right.tolist()
    n = len(rows)
    for k, row in enumerate(rows):
        most = min(_BAND, k)
        for d in range(most, -1, -1):
            # entry (k, k - d) less what the rows before have taken
            other, total = rows[k - d], row[d]
            for e in range(d + 1, min(most, d + _BAND) + 1):
                total -= row[e] * other[e - d]
            if d == 0 and not total > 0:
                raise FloatingPointError
            row[d] = total / other[0] if d else math.sqrt(total)
        total = x[k]
        for d in range(1, most + 1):
            total -= row[d] * x[k - d]
        x[k] = total / row[0]
    for k in range(n - 1, -1, -1):
        x[k] /= rows[k][0]
        for d in range(1, min(_BAND, k) + 1):
            x[k - d] -= rows[k][d] * x[k]
    return np.array(x)
