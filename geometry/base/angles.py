"""The involute function and its inverse, accurate from the smallest angle on."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from geometry.base.errors import ParameterError
from geometry.base.roots import Root, bracketed_root

# below this tangent the series of t - atan t is shorter than its cancellation
_SERIES_BELOW = 0.2


def roll_minus_polar(tangent: ArrayLike) -> NDArray[np.float64]:
    """``t - atan(t)`` for the tangent ``t`` of the profile angle, without cancellation.

    This is the polar angle that an involute has gained at roll angle ``t``: inv(alpha) = tan(alpha) - alpha.
    """
    t = np.asarray(tangent, dtype=float)
    small = np.abs(t) < _SERIES_BELOW
    # the series of what is not small is never asked: of an infinite tangent it is 0 times infinity
    return np.where(small, _by_series(np.where(small, t, 0.0)), t - np.arctan(t))


def _roll_minus_polar(t: float) -> float:
    """The same for one number, without the cost of an array."""
    return _by_series(t) if abs(t) < _SERIES_BELOW else t - math.atan(t)


def _by_series(t: Any) -> Any:
    """t - atan(t) = t^3/3 - t^5/5 + ..., of a number or an array."""
    square = t * t
    series = 0.0 * square
    for k in range(12, 0, -1):
        series = (1 / (2 * k + 1) if k % 2 else -1 / (2 * k + 1)) + series * square
    return t * square * series


def involute_function(angle: float) -> float:
    """inv(alpha) = tan(alpha) - alpha, rad; practicum (3.3)."""
    return _roll_minus_polar(math.tan(angle))


def inverse_involute(value: float) -> Root:
    """The angle in [0, pi/2) whose involute function is ``value``, rad.

    Raises
    ------
    ParameterError
        ``value`` is negative: no real angle has a negative involute function.
    """
    if not value >= 0:
        raise ParameterError("involute", value, "not_finite_or_negative")
    if value == 0:
        return Root(0.0, 0.0, 0, (0.0, 0.0))
    # t - atan t is below t^3/3 and above t - pi/2
    low, high = (3 * value) ** (1 / 3), max((3 * value) ** (1 / 3), value) * 1.2 + math.pi / 2 * (value > 0.3)
    while _roll_minus_polar(high) < value:
        high *= 1.5
    root = bracketed_root(lambda t: _roll_minus_polar(t) - value, low * (1 - 1e-12), high)
    return Root(math.atan(root.value), root.residual, root.iterations, root.bracket)


@lru_cache(maxsize=1 << 14)
def angle_of_involute(value: float) -> float:
    """``inverse_involute`` for many calls with few values: one root serves all pairs of one sum of shifts."""
    return inverse_involute(value).value
