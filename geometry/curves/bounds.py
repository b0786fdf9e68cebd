"""Sharp proven bounds of a curve's derivatives out of crude ones."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Literal

import numpy as np

from geometry.base.series import FACTORIALS, Series
from geometry.curves.curve import Real, SeriesSpan

# how well the deviation of an approximation is known
Bound = Literal["exact", "certified", "sampled"]

# an interval is cut in so many parts
_PARTS = 8
# orders are bounded together: arcs ask for 1 and 2, splines for 2 to 4
_LOW, _HIGH = 2, 4


class BoundedSpan(SeriesSpan):
    """A curve that knows its Taylor series and some bound of it; hashable."""

    __slots__ = ()

    def series_bound(self, order: int, a: Real, b: Real) -> Series:
        """Bounds of the coefficients' moduli on each interval [a, b], by right, however crude; inf: none is known."""
        raise NotImplementedError

    def derivative_bound(self, order: int, a: float, b: float) -> float | None:
        bound = float(_bounds(self, _top(order), (a, b))[order, 0])
        return bound if np.isfinite(bound) else None

    def derivative_bounds(self, edges: Real, orders: Sequence[int]) -> Real:
        """All intervals at once."""
        return _bounds(self, _top(max(orders)), tuple(edges.tolist()))[list(orders)]


def _top(order: int) -> int:
    return _LOW if order <= _LOW else _HIGH


@lru_cache(maxsize=64)
def _bounds(curve: BoundedSpan, top: int, edges: tuple[float, ...]) -> Real:
    """On each part: the value at its middle plus half the part times the bound of the next derivative."""
    a, width = np.array(edges[:-1])[:, None], np.diff(np.array(edges))[:, None]
    low = (a + width * (np.arange(_PARTS) / _PARTS)).ravel()
    high = np.append(low.reshape(len(a), _PARTS)[:, 1:], a + width, axis=1).ravel()
    half, first = np.repeat(width.ravel() / (2 * _PARTS), _PARTS), np.arange(0, low.size, _PARTS)
    knots = curve.knots[(curve.knots > edges[0]) & (curve.knots < edges[-1])]
    if knots.size:
        # a part ends where its formula does
        starts = low[first]
        low = np.union1d(low, knots)
        high = np.append(low[1:], edges[-1])
        half, first = (high - low) / 2, np.searchsorted(low, starts)
    middle = curve.series((low + high) / 2, top)
    rest = curve.series_bound(top + 1, low, high)
    result = np.empty((top + 1, len(a)))
    for k in range(top + 1):
        # the factor covers the roundings of both terms
        parts = np.abs(middle[k]) + half * (k + 1) * rest[k + 1]
        most = np.maximum.reduceat(parts, first) * FACTORIALS[k] * (1 + 1e-12)
        result[k] = np.where(np.isfinite(most), most, np.inf)
    result.flags.writeable = False
    return result
