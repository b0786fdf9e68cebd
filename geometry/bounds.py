"""Sharp proven bounds of a curve's derivatives out of crude ones."""

from __future__ import annotations

from functools import lru_cache
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from geometry.series import FACTORIALS, Series

Real = NDArray[np.float64]

# an interval is cut in so many parts
_PARTS = 8
# each of many parts of a curve again
_PART_PIECES = 2
# orders are bounded together: arcs ask for 1 and 2, splines for 2 to 4
_LOW, _HIGH = 2, 4


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
    return _bounds(curve, top, a, b)[order]


def part_bounds(curve: Bounded, edges: Real) -> Real:
    """Proven bounds of the second to the fourth derivative between each two of the rising ``edges``, (3, parts).

    inf where none is known. As derivative_bound, of all parts at once.
    """
    share = np.linspace(0.0, 1.0, _PART_PIECES + 1)
    cuts = edges[:-1, None] + np.diff(edges)[:, None] * share
    low, high = cuts[:, :-1], cuts[:, 1:]
    middle = curve.series((low + high) / 2, _HIGH)
    rest = curve.series_bound(_HIGH + 1, low.ravel(), high.ravel())
    half = np.diff(edges)[:, None] / (2 * _PART_PIECES)
    found = [
        np.max(np.abs(middle[k]) + half * (k + 1) * np.reshape(rest[k + 1], low.shape), axis=1) * FACTORIALS[k]
        for k in range(_LOW, _HIGH + 1)
    ]
    return np.array(found) * (1 + 1e-12)


@lru_cache(maxsize=64)
def _bounds(curve: Bounded, top: int, a: float, b: float) -> tuple[float | None, ...]:
    """On each part: the value at its middle plus half the part times the bound of the next derivative."""
    edges = np.linspace(a, b, _PARTS + 1)
    low, high = edges[:-1], edges[1:]
    middle = curve.series((low + high) / 2, top)
    rest = curve.series_bound(top + 1, low, high)
    half = (b - a) / (2 * _PARTS)
    result: list[float | None] = []
    for k in range(top + 1):
        # the factor covers the roundings of both terms
        most = float(np.max(np.abs(middle[k]) + half * (k + 1) * rest[k + 1])) * FACTORIALS[k] * (1 + 1e-12)
        result.append(most if np.isfinite(most) else None)
    return tuple(result)
