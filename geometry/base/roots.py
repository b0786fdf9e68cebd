"""Bracketed roots of one real equation: they cannot leave the bracket and say how they ended."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from geometry.base.errors import ConvergenceError
from geometry.base.record import Record
from geometry.base.tolerance import TOLERANCES

Real = NDArray[np.float64]


# bisection alone takes some 60
_MOST_STEPS = 120
# parts of a step to both sides of a place over which it is seen whether a function rises there
_STIR = 1e-5


class Root(Record):
    """A root with the evidence for it: the last bracket holds a change of sign."""

    value: float
    residual: float
    iterations: int
    bracket: tuple[float, float]


def bracketed_root(
    function: Callable[[float], float],
    low: float,
    high: float,
    *,
    limit: int = 300,
    enough: float = 0.0,
    at_ends: tuple[float, float] | None = None,
) -> Root:
    """Root of a continuous function with opposite signs at ``low`` and ``high``; to the last digit.

    ``enough``: a residual of this size ends the search before. ``at_ends``: the values at ``low`` and ``high``, where
    they are known.

    Chandrupatla's method (Advances in Engineering Software 28, 1997): inverse quadratic interpolation
    where it is safe, bisection otherwise; some 10 steps, and up to 150 where rounding makes a function jump beside 0.

    Raises
    ------
    ConvergenceError
        No change of sign in the bracket, or more than ``limit`` steps.
    """
    b, a, c = low, high, high
    fb, fa = (function(low), function(high)) if at_ends is None else at_ends
    fc = fa
    for end, value in ((low, fb), (high, fa)):
        if value == 0:
            return Root(end, 0.0, 0, (end, end))
    if fa * fb > 0 or fa != fa or fb != fb:
        raise ConvergenceError(f"no change of sign between {low:.6g} and {high:.6g}", min(abs(fa), abs(fb)), 0)
    fraction = 0.5
    for iteration in range(1, limit + 1):
        x = a + fraction * (b - a)
        fx = function(x)
        if (fx > 0) == (fa > 0):
            c, fc = a, fa
        else:
            c, b, fc, fb = b, a, fb, fa
        a, fa = x, fx
        best, residual = (a, fa) if abs(fa) < abs(fb) else (b, fb)
        reach = abs(b - a)
        least = 2 * TOLERANCES.relative_root * abs(best) + 1e-300
        if abs(residual) <= enough or reach <= least:
            return Root(best, residual, iteration, (min(a, b), max(a, b)))
        fraction = _next_fraction(a, b, c, fa, fb, fc, 0.5 * least / reach)
    raise ConvergenceError("root", residual, limit)


def _next_fraction(a: float, b: float, c: float, fa: float, fb: float, fc: float, margin: float) -> float:
    """Where in [a, b] to look next, as a fraction; 0.5 where interpolation is not safe."""
    if fa == fb or fb == fc or fc == fa or a == b or b == c or c == a:
        return 0.5
    xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
    if phi**2 < xi and (1 - phi) ** 2 < 1 - xi:
        fraction = (fa / (fb - fa)) * (fc / (fb - fc)) + ((c - a) / (b - a)) * (fa / (fc - fa)) * (fb / (fc - fb))
    else:
        fraction = 0.5
    return min(1 - margin, max(margin, fraction))


def halved(stays: Callable[[Real], NDArray[np.bool_]], low: Real, high: Real, steps: int) -> tuple[Real, Real]:
    """Brackets (n,) halved so often about where a vectorised condition turns: it ``stays`` true at ``low``."""
    for _ in range(steps if low.size else 0):
        middle = (low + high) / 2
        same = stays(middle)
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return low, high


def crests(function: Callable[[Real], Real], samples: Real, step: float) -> Real:
    """Where a vectorised function is greatest within a ``step`` of samples (n,) that their neighbours do not exceed.

    There it is as great on both sides: a bracketed root of the difference over so little that a corner is no matter,
    nor are the digits, for a place counts by its square.
    """

    def slope(x: Real) -> Real:
        return function(x + stir) - function(x - stir)

    stir, low, high = _STIR * step, samples - step, samples + step
    return bracketed_roots(slope, low, high, slope(low), slope(high))


def tops(values: Real) -> NDArray[np.intp]:
    """Which samples (n,) of a period may stand beside its greatest value: none exceeds them by more than they bend."""
    before, after = np.roll(values, 1), np.roll(values, -1)
    bend = 2 * values - before - after
    return np.flatnonzero((bend > 0) & (values >= before) & (values >= after) & (values + bend >= values.max()))


def bracketed_roots(
    function: Callable[[Real], Real], low: Real, high: Real, at_low: Real, at_high: Real, *, enough: float = 0.0
) -> Real:
    """Roots (n,) of a vectorised function that has the values of opposite sign ``at_low`` and ``at_high``.

    The method of ``bracketed_root`` on all brackets together, to the last digit; brackets whose function jumps end
    at the jump. ``enough``: a residual of this size ends a search before.
    """
    b, a, fb, fa = low, high, at_low, at_high
    fraction, best = np.full(len(low), 0.5), low
    with np.errstate(all="ignore"):
        for _ in range(_MOST_STEPS):
            x = a + fraction * (b - a)
            fx = function(x)
            same = (fx > 0) == (fa > 0)
            c, fc = np.where(same, a, b), np.where(same, fa, fb)
            b, fb = np.where(same, b, a), np.where(same, fb, fa)
            a, fa = x, fx
            best = np.where(np.abs(fa) < np.abs(fb), a, b)
            reach, least = np.abs(b - a), 2 * TOLERANCES.relative_root * np.abs(best) + 1e-300
            done = (np.minimum(np.abs(fa), np.abs(fb)) <= enough) | (reach <= least)
            if done.all():
                break
            xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
            guess = (fa / (fb - fa)) * (fc / (fb - fc)) + ((c - a) / (b - a)) * (fa / (fc - fa)) * (fb / (fc - fb))
            safe = (phi**2 < xi) & ((1 - phi) ** 2 < 1 - xi) & np.isfinite(guess)
            margin = 0.5 * least / reach
            fraction = np.where(safe, np.clip(guess, margin, 1 - margin), 0.5)
            # what is found stays where it is
            fraction = np.where(done, np.where(best == a, 0.0, 1.0), fraction)
    return best
