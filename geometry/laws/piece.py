"""One analytic piece of a law of motion: a polynomial in Bernstein form plus sine waves.

Every diagram of the textbooks (constant, linear, trapezoid, sines, cosines, polynomials, splines) integrates twice
to such pieces in closed form. Bernstein's basis keeps high degrees exact to rounding where powers of u lose digits:
11 of them for a polynomial of degree 31.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_roots

Real = NDArray[np.float64]

_EXTREME_SAMPLES = 65
# samples between which a curve is split where functions change sign, and the least part that is split off
_SPLIT_SAMPLES, _LEAST_SHARE = 129, 1e-4
# so many arguments at once: their powers stay in the cache
_BLOCK = 2048
# fewer than these are short
_SHORT = 100


class Wave(Record):
    """amplitude sin(frequency (t - start of the piece) + phase); frequency in rad per unit of t."""

    amplitude: float
    frequency: float
    phase: float


class LawPiece(Record):
    """s(t) on [start, end]: Bernstein coefficients over that interval, and waves; exact derivatives of every order.

    Units are the owner's: a normalised law runs from 0 to 1 in both, a follower's motion in rad of cam angle and mm
    (or rad for an oscillating follower). Beyond its interval the formula goes on.
    """

    start: float
    end: float
    coefficients: tuple[float, ...]
    waves: tuple[Wave, ...] = ()

    @property
    def domain(self) -> tuple[float, float]:
        """The interval [start, end]."""
        return self.start, self.end

    @property
    def is_constant(self) -> bool:
        """Whether the piece is a dwell."""
        return not self.waves and len(set(self.coefficients)) == 1

    def value(self, t: ArrayLike, order: int = 0) -> Real:
        """s or a derivative of it, of the shape of ``t``."""
        return self._values(np.asarray(t, dtype=float), (order,))[0]

    def values(self, t: Real, order: int) -> list[Real]:
        """s, s' ... s^(order)."""
        return self._values(t, range(order + 1))

    def _values(self, t: Real, orders: Sequence[int]) -> list[Real]:
        """Derivatives of several orders, which share their powers."""
        width, n, flat = self.end - self.start, len(self.coefficients) - 1, np.ravel(t)
        if flat.size > _BLOCK:
            blocks = [self._values(part, orders) for part in np.array_split(flat, -(-flat.size // _BLOCK))]
            return [np.concatenate(parts).reshape(np.shape(t)) for parts in zip(*blocks, strict=True)]
        local, rest = powers(flat, self.start, self.end, width, n)
        angles = [wave.frequency * (flat - self.start) + wave.phase for wave in self.waves]
        result = []
        for order in orders:
            weights = _weights(self.coefficients, width, order)
            m = len(weights) - 1
            terms = weights * local[: m + 1]
            terms *= rest[m::-1]
            total = np.add.reduce(terms, axis=0)
            for wave, angle in zip(self.waves, angles, strict=True):
                total = total + wave.amplitude * wave.frequency**order * sine_derivative(angle, order)
            result.append(total.reshape(np.shape(t)))
        return result

    def bounds(self, order: int, a: Real, b: Real) -> list[Real]:
        """Proven bounds of |s|, |s'| ... |s^(order)| on each of the intervals [a, b].

        Taylor's series about the middle ends with the polynomial's degree; waves are at most their amplitude.
        """
        middle, half = (a + b) / 2, (b - a) / 2
        top = max(order, len(self.coefficients) - 1)
        values = [np.abs(v) for v in replace(self, waves=()).values(middle, top)]
        result = []
        for k in range(order + 1):
            terms = [values[j] * half ** (j - k) / math.factorial(j - k) for j in range(k, top + 1)]
            total = np.asarray(sum(terms))
            for wave in self.waves:
                at = wave.frequency * (middle - self.start) + wave.phase
                most = np.abs(sine_derivative(at, k)) + abs(wave.frequency) * half
                total = total + abs(wave.amplitude) * abs(wave.frequency) ** k * np.minimum(most, 1.0)
            result.append(total * (1 + 1e-12))
        return result

    def placed(self, origin: float, length: float, base: float, lift: float) -> LawPiece:
        """The piece with t -> origin + length t and s -> base + lift s."""
        waves = tuple(
            Wave(lift * w.amplitude, w.frequency / length, w.phase) for w in self.waves if w.amplitude * lift != 0
        )
        values = tuple(base + lift * c for c in self.coefficients)
        return LawPiece(origin + length * self.start, origin + length * self.end, values, waves)

    def spanning(self, start: float, end: float) -> LawPiece:
        """The piece with its ends set to given numbers that differ from its own by roundings."""
        return replace(self, start=start, end=end)

    def reversed_in_time(self) -> LawPiece:
        """s(start + end - t)."""
        width = self.end - self.start
        waves = tuple(Wave(-w.amplitude, w.frequency, -w.frequency * width - w.phase) for w in self.waves)
        return replace(self, coefficients=self.coefficients[::-1], waves=waves)

    def extremes(self, order: int) -> Real:
        """Arguments, ends included, at which |s^(order)| may be greatest: sign changes of the next derivative."""
        return _extremes(self, order)


@lru_cache(maxsize=512)
def _extremes(piece: LawPiece, order: int) -> Real:
    t = np.linspace(piece.start, piece.end, _EXTREME_SAMPLES)
    inner = sign_changes(lambda x: piece.value(x, order + 1), t)
    found = np.concatenate([[piece.start], inner, [piece.end]])
    # shared by all who ask
    found.flags.writeable = False
    return found


def sine_derivative(angle: Real, order: int) -> Real:
    """sin^(order)(angle) without adding to the angle, which would round."""
    kind = order % 4
    return (np.sin, np.cos, lambda x: -np.sin(x), lambda x: -np.cos(x))[kind](angle)


def powers(t: Real, start: Real | float, end: Real | float, width: Real | float, most: int) -> tuple[Real, Real]:
    """x^0 to x^most, (most + 1, n), of where ``t`` stands from the start and from the end, each to full digits."""
    both = np.empty((most + 1, 2, len(t)))
    both[0] = 1.0
    if most:
        x = both[1]
        np.subtract(t, start, out=x[0])
        np.subtract(end, t, out=x[1])
        x /= width
        # row by row: accumulate goes through long arrays against their order; short ones it takes at one call
        if len(t) < _SHORT:
            both[2:] = x
            np.multiply.accumulate(both[1:], axis=0, out=both[1:])
        else:
            for k in range(1, most):
                np.multiply(both[k], x, out=both[k + 1])
    return both[:, 0], both[:, 1]


@lru_cache(maxsize=512)
def _weights(coefficients: tuple[float, ...], width: float, order: int) -> Real:
    """Bernstein coefficients of a derivative times the binomials of its degree: factors of local^i rest^(m - i)."""
    values = np.array(coefficients, dtype=float)
    for _ in range(order):
        if len(values) == 1:
            return np.zeros((1, 1))
        values = np.diff(values) * ((len(values) - 1) / width)
    return np.array([[math.comb(len(values) - 1, i) * v] for i, v in enumerate(values.tolist())])


def sign_changes(function: Callable[[Real], Real], t: Real) -> Real:
    """Rising roots of a vectorised function between samples of opposite sign, all bracketed together.

    A root that falls on a sample counts where the samples beside it have opposite signs.
    """
    values = function(t)
    sign = np.sign(values)
    exact = t[1:-1][(sign[1:-1] == 0) & (sign[:-2] * sign[2:] < 0)]
    at = np.flatnonzero(sign[:-1] * sign[1:] < 0)
    if not len(at):
        return exact
    return np.sort(np.concatenate([bracketed_roots(function, t[at], t[at + 1], values[at], values[at + 1]), exact]))


def split_places(functions: Sequence[Callable[[Real], Real]], start: float, end: float) -> list[float]:
    """Both ends, and between them where vectorised functions change sign; of places beside each other the first."""
    t, least = np.linspace(start, end, _SPLIT_SAMPLES), _LEAST_SHARE * (end - start)
    edges = [start]
    for at in np.sort(np.concatenate([sign_changes(function, t) for function in functions])).tolist():
        # an inflection is also where a curve that starts straight begins
        if at - edges[-1] > least and end - at > least:
            edges.append(at)
    return [*edges, end]
