"""The involute function and its inverse, accurate from the smallest angle on."""

from __future__ import annotations

import math

from geometry.base.errors import ParameterError

# below this tangent the series of t - atan t is shorter than its cancellation
_SERIES_BELOW = 0.2
# t - atan t = t^3 (1/3 - t^2/5 + ...), the last term first
_SERIES = tuple((1 if k % 2 else -1) / (2 * k + 1) for k in range(12, 0, -1))
# beyond the split the series of 1/value is the nearer one: both are 1.4 % off there, which two steps make 1e-18
_INVERSE_STEPS, _INVERSE_SPLIT = 2, 1.35


def roll_minus_polar(tangent: float) -> float:
    """``t - atan(t)`` for the tangent ``t`` of the profile angle, without cancellation.

    This is the polar angle that an involute has gained at roll angle ``t``: inv(alpha) = tan(alpha) - alpha.
    """
    if abs(tangent) >= _SERIES_BELOW:
        return tangent - math.atan(tangent)
    square, series = tangent * tangent, 0.0
    for coefficient in _SERIES:
        series = coefficient + series * square
    return tangent * square * series


def involute_function(angle: float) -> float:
    """inv(alpha) = tan(alpha) - alpha, rad; practicum (3.3)."""
    return roll_minus_polar(math.tan(angle))


def tangent_length(radius: float, base: float) -> float:
    """sqrt(r^2 - r_b^2), mm: from the base circle to a radius, along the normal of the flank; 0 inside that circle."""
    return math.sqrt(max((radius - base) * (radius + base), 0.0))


def inverse_involute(value: float) -> float:
    """The angle in [0, pi/2) whose involute function is ``value``, rad; to the rounding of that function.

    Halley's method for t = tan(alpha) from the first terms of its series: at 0 in (3 value)^(1/3), beyond in
    1 / (value + pi/2).

    Raises
    ------
    ParameterError
        ``value`` is negative or not finite: no real angle has such an involute function.
    """
    if not 0 <= value < math.inf:
        raise ParameterError("involute", value, "not_finite_or_negative")
    if value == 0:
        return 0.0
    if value < _INVERSE_SPLIT:
        root = math.cbrt(3 * value)
        t = root * (1 + root**2 * (1 / 5 + root**2 * 3 / 175))
    else:
        whole = value + math.pi / 2
        t = whole - 1 / whole
    for _ in range(_INVERSE_STEPS):
        square = t * t
        step = (roll_minus_polar(t) - value) * (1 + 1 / square)
        t -= step / (1 - step / (t * (1 + square)))
    return math.atan(t)
