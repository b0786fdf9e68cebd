"""Two centrodes that roll on their equals by closed forms: the ellipse about its focus and the two-lobed oval."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.record import Record
from geometry.base.series import Series, power
from geometry.curves.curve import Real


def _cosine(angle: Real, order: int, times: int) -> Series:
    """Taylor coefficients of cos(times angle)."""
    return [times**k * np.cos(times * angle + k * math.pi / 2) / math.factorial(k) for k in range(order + 1)]


class FocalEllipse(Record):
    """Ellipse about a focus, r = a (1 - e^2)/(1 - e cos phi), from its long radius; rolls on its equal at A = 2a."""

    semi_axis: float
    eccentricity: float

    def series(self, angle: Real, order: int) -> Series:
        """Taylor coefficients of the radius."""
        under = [-self.eccentricity * x for x in _cosine(angle, order, 1)]
        under[0] = under[0] + 1.0
        return [self.semi_axis * (1 - self.eccentricity**2) * x for x in power(under, -1.0)]

    def mate_angle(self, angle: ArrayLike) -> Real:
        """phi_2 by tan(phi_2/2) = (1 + e)/(1 - e) tan(phi_1/2), rad, continuous."""
        half = np.asarray(angle, dtype=float) / 2
        ratio = (1 + self.eccentricity) / (1 - self.eccentricity)
        return 2 * _stretched(half, ratio)


class Oval(Record):
    """Two-lobed oval r = 2ab/((a + b) - (a - b) cos 2 phi), from its long radius a; rolls on its equal at A = a + b."""

    long_radius: float
    short_radius: float

    def series(self, angle: Real, order: int) -> Series:
        """Taylor coefficients of the radius."""
        a, b = self.long_radius, self.short_radius
        under = [-(a - b) * x for x in _cosine(angle, order, 2)]
        under[0] = under[0] + (a + b)
        return [2 * a * b * x for x in power(under, -1.0)]

    def mate_angle(self, angle: ArrayLike) -> Real:
        """phi_2 by tan(phi_2) = (a/b) tan(phi_1), rad, continuous."""
        return _stretched(np.asarray(angle, dtype=float), self.long_radius / self.short_radius)


def _stretched(angle: Real, ratio: float) -> Real:
    """atan(ratio tan(angle)) on the angle's own branch."""
    turns = np.round(angle / math.pi) * math.pi
    rest = angle - turns
    return turns + np.arctan2(ratio * np.sin(rest), np.cos(rest))
