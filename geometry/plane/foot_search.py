"""Feet of perpendiculars on curves without a closed form: roots bracketed by samples, safeguarded Newton iteration."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from geometry.curves.curve import Complex, Curve, Real

_FOOT_SAMPLES = 17
_STEPS = 60
Indices = NDArray[np.intp]
Slopes = Callable[[Complex, Real], tuple[Real, Real]]


class FootSearch:
    """Feet on a curve without a closed form: every change of sign between samples, safeguarded Newton iteration."""

    def __init__(self, curve: Curve) -> None:
        # a curve may know a shorter way
        known: Slopes | None = getattr(curve, "slopes", None)
        self.slopes = known or _general_slopes(curve)
        self.parameters = np.linspace(*curve.domain, _FOOT_SAMPLES)
        self.samples = np.asarray(curve.point(self.parameters))
        self.middle = complex(np.mean(self.samples))
        # half of the longest chord, with room for what the arc is longer
        self.reach = 0.6 * float(np.max(np.abs(np.diff(self.samples))))
        self.radius = float(np.max(np.abs(self.samples - self.middle))) + self.reach

    def feet(self, points: Complex, best: Real) -> tuple[Indices, Real]:
        """Points that may have a foot nearer than ``best`` inside the curve, once for each foot, and its parameter."""
        chosen = np.flatnonzero(np.abs(points - self.middle) - self.radius < best)
        if not chosen.size:
            return chosen, np.zeros(0)
        away = np.abs(points[chosen, None] - self.samples).min(axis=1)
        chosen = chosen[away - self.reach <= best[chosen]]
        slopes = self.slopes(points[chosen, None], self.parameters)[0]
        row, k = np.nonzero((slopes[:, :-1] >= 0) & (slopes[:, 1:] <= 0))
        chosen = chosen[row]
        return chosen, self._root(points[chosen], self.parameters[k], self.parameters[k + 1])

    def _root(self, points: Complex, low: Real, high: Real) -> Real:
        t = (low + high) / 2
        least = 1e-10 * float(self.parameters[-1] - self.parameters[0])
        for _ in range(_STEPS):
            slope, change = self.slopes(points, t)
            low, high = np.where(slope >= 0, t, low), np.where(slope <= 0, t, high)
            with np.errstate(divide="ignore", invalid="ignore"):
                step = t - slope / change
            following = np.where((step >= low) & (step <= high), step, (low + high) / 2)
            moved = np.abs(following - t)
            t = following
            if not np.any(moved > least):
                break
        return t


def _general_slopes(curve: Curve) -> Slopes:
    """Half of the falling rate of the squared distance, Re(conj(c') (p - c)), and its derivative."""

    def slopes(points: Complex, t: Real) -> tuple[Real, Real]:
        gap, first = points - curve.point(t), curve.derivative(t)
        return (np.conj(first) * gap).real, (np.conj(curve.derivative(t, 2)) * gap).real - np.abs(first) ** 2

    return slopes
