"""Measured values smoothed: the periodic cubic spline of least bending that stays near them.

Of all periodic curves the natural measure of bending, the integral of g''^2, plus the squares of what the values are
left by, is least for a cubic spline with knots at the places (C. H. Reinsch, Numerische Mathematik 10, 1967). The more
the bending weighs, the smoother it runs and the farther it leaves the values; here as far as a tolerance says.
"""

from __future__ import annotations

import math

import numpy as np

from geometry.base.roots import bracketed_root
from geometry.laws.piece import Real

# the weight of bending, in cubes of the mean step: where its search begins, and its factor
_FIRST_WEIGHT, _FACTOR = 1e-2, 10.0
# how near the greatest distance comes to the tolerance, part of it
_ENOUGH = 1e-9


def smoothed(places: Real, values: Real, period: float, tolerance: float) -> Real:
    """Values at rising ``places`` of the smoothest periodic spline that leaves none of the given ones by more than a
    tolerance; all alike where that is within it.

    ``places`` and ``values``: (n,), at least 3; ``period`` beyond the last place less the first.
    """
    level = np.full(len(values), float(np.mean(values)))
    if np.abs(values - level).max() <= tolerance * (1 + _ENOUGH):
        return level
    apart = np.diff(np.append(places, places[0] + period))
    steps, rises = (apart / np.mean(apart)).tolist(), (np.roll(values, -1) - values).tolist()

    def beyond(power: float) -> float:
        left = float(np.abs(_left(steps, rises, math.exp(power))).max())
        return math.log(max(left, 1e-300) / tolerance)

    last = math.log(_FIRST_WEIGHT)
    at_last = beyond(last)
    step = math.log(_FACTOR) if at_last <= 0 else -math.log(_FACTOR)
    while ((at_power := beyond(power := last + step)) > 0) == (at_last > 0):
        last, at_last = power, at_power
    root = bracketed_root(beyond, last, power, enough=_ENOUGH, at_ends=(at_last, at_power))
    return values - _left(steps, rises, math.exp(root.value))


def _left(steps: list[float], rises: list[float], weight: float) -> Real:
    """By what the values are left where bending has a weight, (n,).

    ``steps`` from each place to the next, ``rises`` of the values over them. C is the weight times g'', D its slope
    over a step; D grows at a place by what its value is left by. Step by step from the last one back: the least that is
    still to come is a form of C and D with the matrix (a, b; b, e) and its determinant, all of them sums without a
    difference, so that no digit is lost where places lie near to each other (DERIVATIONS.md, 22).
    """
    a = b = e = determinant = p = r = 0.0
    # how C and D at the end follow those at the beginning and the pull of two multipliers that close the turn
    cx, cy, dx, dy = 1.0, 0.0, 0.0, 1.0
    gxx = gxy = gyy = gx = gy = 0.0
    kept = []
    for h, rise in zip(reversed(steps), reversed(rises), strict=True):
        share = h / weight
        determinant += share * (a * h * h / 3 + b * h + e + share * h * h / 12)
        e += h * (a * h + 2 * b + share * h / 3)
        b += h * (a + share / 2)
        a += share
        r += p * h + rise
        dx, dy = dx + cx * h, dy + cy * h
        k = 1 / (1 + e)
        kept.append((h, k, b, e, r, dx, dy))
        gxx, gxy, gyy = gxx - k * dx * dx, gxy - k * dx * dy, gyy - k * dy * dy
        gx, gy = gx - k * r * dx, gy - k * r * dy
        p, cx, cy = p - k * b * r, cx - k * b * dx, cy - k * b * dy
        a = k * (a + determinant)
        b, e, determinant, r, dx, dy = k * b, k * e, k * determinant, k * r, k * dx, k * dy
    closed = np.array([[a, b, cx - 1, cy], [b, e, dx, dy - 1], [cx - 1, dx, gxx, gxy], [cy, dy - 1, gxy, gyy]])
    c, d, x, y = np.linalg.solve(closed, [-p, -r, -gx, -gy]).tolist()
    left = []
    for h, k, b, e, r, dx, dy in reversed(kept):
        left.append(-k * (e * d + b * c + r + dx * x + dy * y))
        d += left[-1]
        c += h * d
    return np.array(left)
