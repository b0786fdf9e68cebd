"""The path of a point of a rolling rack: its parallel is the fillet that the product knows in closed form."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.record import Record
from geometry.curves.curve import Complex
from geometry.curves.fillet import TurnedSpan


class Trochoid(TurnedSpan, Record):
    """Path of a point of a rolling rack, ``depth`` inside the pitch line, in the gear's frame.

    c(s) = centre + exp(i (angle - s/r)) (r - depth + i s); s is the position of the point along the
    pitch line, mm. depth = 0 gives the involute of the pitch circle. Derivatives of any order.
    """

    pitch_radius: float
    depth: float
    angle: float
    start: float
    end: float
    centre: complex = 0j

    def point(self, t: ArrayLike) -> Complex:
        s = np.asarray(t, dtype=float)
        turn = np.exp(1j * (self.angle - s / self.pitch_radius))
        return self.centre + turn * (self.pitch_radius - self.depth + 1j * s)

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        s = np.asarray(t, dtype=float)
        rate = -1j / self.pitch_radius
        turn = np.exp(1j * (self.angle - s / self.pitch_radius))
        arm = self.pitch_radius - self.depth + 1j * s
        return turn * (rate**order * arm + order * rate ** (order - 1) * 1j)

    def derivative_bound(self, order: int, a: float, b: float) -> float:
        rate, reach = 1 / self.pitch_radius, max(abs(a), abs(b))
        if order == 1:
            return rate * math.hypot(self.depth, reach)
        # c^(k) = (-i/r)^(k-1) exp(..) ((-i/r)(r - depth + i s) + k i)
        return rate ** (order - 1) * math.hypot(order - 1 + rate * self.depth, rate * reach)
