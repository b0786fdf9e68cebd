"""Sharp proven bounds of a curve's derivatives out of crude ones."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from geometry.curve import Curve, Reversed
from geometry.series import FACTORIALS, Series

Real = NDArray[np.float64]

# an interval is cut in so many parts
_PARTS = 8
# each of many parts of a curve again
# orders are bounded together: arcs ask for 1 and 2, splines for 2 to 4
_LOW, _HIGH = 2, 4


@runtime_checkable
class Bounded(Protocol):
    """A curve that knows its Taylor series and some bound of it; hashable."""

    def __hash__(self) -> int: ...

    def series(self, t: ArrayLike, order: int) -> Series:
        """Taylor coefficients 0 to ``order`` at ``t``."""

    def series_bound(self, order: int, a: Real, b: Real) -> Series:
        """Bounds of their moduli on each interval [a, b], by right, however crude; inf where none is known."""


def derivative_bound(curve: Bounded, order: int, a: float, b: float) -> float | None:
    """Proven bound of |c^(order)| on [a, b], order 1 to 4; None where the curve knows none."""
    top = _LOW if order <= _LOW else _HIGH
    bound = float(_bounds(curve, top, (a, b))[order, 0])
    return bound if np.isfinite(bound) else None


def bounds_between(curve: Curve, edges: Real, orders: Sequence[int]) -> Real:
    """Proven bounds of |c^(k)|, k in ``orders``, between neighbouring ``edges``: (len(orders), n - 1); inf: none known.

    Curves with Taylor series are asked once for all intervals.
    """
    if isinstance(curve, Reversed):
        return bounds_between(curve.original, -edges[::-1], orders)[:, ::-1]
    if isinstance(curve, Bounded):
        top = _LOW if max(orders) <= _LOW else _HIGH
        return _bounds(curve, top, tuple(edges.tolist()))[list(orders)]
    found = [[curve.derivative_bound(k, a, b) for a, b in pairwise(edges.tolist())] for k in orders]
    return np.array([[np.inf if x is None else x for x in row] for row in found])


@lru_cache(maxsize=64)
def _bounds(curve: Bounded, top: int, edges: tuple[float, ...]) -> Real:
    """On each part: the value at its middle plus half the part times the bound of the next derivative."""
    a, width = np.array(edges[:-1])[:, None], np.diff(np.array(edges))[:, None]
    low = a + width * (np.arange(_PARTS) / _PARTS)
    high = np.append(low[:, 1:], a + width, axis=1)
    middle = curve.series(((low + high) / 2).ravel(), top)
    rest = curve.series_bound(top + 1, low.ravel(), high.ravel())
    half = np.repeat(width.ravel() / (2 * _PARTS), _PARTS)
    result = np.empty((top + 1, len(a)))
    for k in range(top + 1):
        # the factor covers the roundings of both terms
        parts = np.abs(middle[k]) + half * (k + 1) * rest[k + 1]
        most = parts.reshape(len(a), _PARTS).max(axis=1) * FACTORIALS[k] * (1 + 1e-12)
        result[k] = np.where(np.isfinite(most), most, np.inf)
    result.flags.writeable = False
    return result
