"""Arcs of hyperbolas whose axes lie along x and y, as planes along the axis of a cone cut it."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.record import Record
from geometry.curves.curve import Complex, Span


class Hyperbola(Span, Record):
    """centre + along cosh t + i across sinh t, from ``start`` to ``end``; mm."""

    centre: complex
    along: float
    across: float
    start: float
    end: float

    def point(self, t: ArrayLike) -> Complex:
        return self.centre + self.derivative(t, 0)

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        even, odd = (np.cosh(t), np.sinh(t)) if order % 2 == 0 else (np.sinh(t), np.cosh(t))
        return np.asarray(self.along * even + 1j * self.across * odd)

    def derivative_bound(self, order: int, a: float, b: float) -> float:
        return math.hypot(self.along, self.across) * math.cosh(max(abs(a), abs(b)))
