"""The different values of an array, without ``numpy.ma``, which ``numpy.unique`` loads at its first call."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Value = TypeVar("Value", np.float64, np.int64)


def distinct(values: NDArray[Value]) -> NDArray[Value]:
    """The different values in rising order, (number of them,); numbers only, none of them NaN."""
    rising = np.sort(values, axis=None)
    return rising[np.concatenate([np.ones(min(1, rising.size), dtype=bool), rising[1:] != rising[:-1]])]
