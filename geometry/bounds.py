"""Sharp proven bounds of derivatives out of crude ones."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from geometry.curve import Complex

Real = NDArray[np.float64]

# an interval is cut in so many parts
_PARTS = 8


def refined_bound(
    derivative: Callable[[Real, int], Complex], crude: Callable[[int, Real, Real], Real], order: int, a: float, b: float
) -> float | None:
    """Bound of |c^(order)| on [a, b]: its value at the middle of each part plus half the part times a crude bound.

    ``crude(order, starts, ends)`` bounds a derivative on many intervals, inf where it knows none; then the result
    is None.
    """
    edges = np.linspace(a, b, _PARTS + 1)
    low, high = edges[:-1], edges[1:]
    rest = crude(order + 1, low, high)
    if not np.all(np.isfinite(rest)):
        return None
    middle = np.abs(derivative((low + high) / 2, order))
    # the factor covers the roundings of both terms
    return float(np.max(middle + (high - low) / 2 * rest)) * (1 + 1e-12)
