"""What the rounded corner of a pinion cutter leaves: the root fillet of a ring or of a pinion-cut external gear."""

from __future__ import annotations

import math
from collections.abc import Callable
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.record import Record
from geometry.base.series import FACTORIALS, Series, exponential, majorant_power, power, product
from geometry.curves.curve import Complex, Real
from geometry.curves.fillet import Fillet


class CutterFillet(Fillet, Record):
    """Envelope of a circle carried on a circle about a cutter's axis while cutter and work roll.

    e(u) = centre + exp(i (angle + k th)) (R + (w + s rho) exp(-i u)), in the work's frame, with the signed radius r of
    the cutter's pitch circle (positive: internal, the cutter rolls inside the work; negative: external), s its sign,
    k = r/R, c = |r| + D the distance of the rounding centre from the cutter's axis, l = |r|/c,
    T = sqrt(1 - l^2 sin^2 u), w = s (c^2 - r^2) / (c T + |r| cos u) and th = u - asin(l sin u).
    ``u`` is the angle of the contact normal, rad: 0 at the cutter's tip circle, pi/2 - alpha_w at its flank; negative
    values give the mirror image. Speed rho (1 - k th') + (1 - k) w^2 / (c T) with th' = |w| / (c T) sign(D), turning
    rate -(1 - k th'). At D = 0 it is an arc. r -> -infinity is ``TrochoidFillet``. A left offset d has rho + d.
    Derivation: DERIVATIONS.md, section 6.
    """

    pitch_radius: float
    cutter_radius: float
    depth: float
    tip_radius: float
    angle: float
    start: float
    end: float
    centre: complex = 0j

    @property
    def _sense(self) -> float:
        return math.copysign(1.0, self.cutter_radius)

    @property
    def _ratio(self) -> float:
        return self.cutter_radius / self.pitch_radius

    @property
    def corner_radius(self) -> float:
        """c: distance of the rounding centre from the cutter's axis, mm."""
        return abs(self.cutter_radius) + self.depth

    @property
    def _share(self) -> float:
        return abs(self.cutter_radius) / self.corner_radius

    @property
    def _excess(self) -> float:
        """1 - l^2, without cancellation."""
        return self.depth * (2 * abs(self.cutter_radius) + self.depth) / self.corner_radius**2

    def _parts(self, u: Any, lib: ModuleType = np) -> tuple[Any, Any, Any]:
        """T, g = T - l cos u (signed w / (s c)) and th."""
        sine, cosine, share = lib.sin(u), lib.cos(u), self._share
        root = lib.sqrt(1 - (share * sine) ** 2)
        gap = self._excess / (root + share * cosine)
        return root, gap, (np.arctan2 if lib is np else math.atan2)(sine * gap, cosine * root + share * sine**2)

    def _point(self, u: Any, lib: ModuleType, exp: Callable[[Any], Any]) -> Any:
        _, gap, turn = self._parts(u, lib)
        reach = self._sense * (self.corner_radius * gap + self.tip_radius)
        return self.centre + exp(1j * (self.angle + self._ratio * turn)) * (self.pitch_radius + reach * exp(-1j * u))

    def normal_length(self, u: float) -> float:
        """|w| sign(D) + rho: distance of the contact point from the pitch point along the normal, mm."""
        return self.corner_radius * float(self._parts(u, math)[1]) + self.tip_radius

    def turning(self, t: ArrayLike) -> Real:
        """1 - k th': how fast the tangent turns to the right, rad/rad."""
        root, gap, _ = self._parts(np.asarray(t, dtype=float))
        return 1 - self._ratio * gap / root

    def speed(self, t: ArrayLike) -> Real:
        """de/du along the tangent, mm/rad; negative where the curve runs back."""
        u = np.asarray(t, dtype=float)
        root, gap, _ = self._parts(u)
        rolling = (1 - self._ratio) * self.corner_radius * gap**2 / root
        return self.tip_radius * (1 - self._ratio * gap / root) + rolling

    def tangent(self, t: ArrayLike) -> Complex:
        u = np.asarray(t, dtype=float)
        turn = self.angle + self._ratio * self._parts(u)[2] - u
        return np.where(self.speed(u) < 0, 1.0, -1.0) * self._sense * 1j * np.exp(1j * turn)

    def slopes(self, points: Complex, t: Real) -> tuple[Real, Real]:
        """Re(conj(tangent) (p - e)) along growing u, and its derivative: the tangent turns at -(1 - k th')."""
        speed = self.speed(t)
        gap = np.conj(self.tangent(t)) * (points - self.point(t)) * np.where(speed < 0, -1.0, 1.0)
        return gap.real, -self.turning(t) * gap.imag - speed

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        """Taylor arithmetic on e' = -s i exp(i (angle + k th - u)) speed(u)."""
        u = np.asarray(t, dtype=float)
        sine, cosine, share = np.sin(u), np.cos(u), self._share
        waves = [cosine, -sine, -cosine, sine]
        wave = [w / FACTORIALS[k] for k, w in enumerate(waves[:order])]
        # T^2 = 1 - l^2 sin^2 u; its derivatives are those of (l^2 / 2) cos 2u
        double = [np.cos(2 * u), -np.sin(2 * u), -np.cos(2 * u), np.sin(2 * u)]
        square = [share**2 / 2 * 2**k * d / FACTORIALS[k] for k, d in enumerate(double[:order])]
        square[0] = 1 - (share * sine) ** 2
        inverse = power(square, -0.5)
        total = [a + share * b for a, b in zip(product(square, inverse), wave, strict=True)]
        gap = [self._excess * x for x in power(total, -1.0)]
        rate = product(gap, inverse)
        phase = [1j * (self._ratio * a - b) for a, b in zip(_integral(rate, self._parts(u)[2]), _line(u), strict=False)]
        speed = self._speed_series(rate, product(product(gap, gap), inverse))
        value = product(exponential(phase[:order]), speed)[order - 1] * FACTORIALS[order - 1]
        return -1j * self._sense * np.exp(1j * self.angle) * value

    def _speed_series(self, rate: Series, rolling: Series) -> Series:
        weight, ratio = (1 - self._ratio) * self.corner_radius, self._ratio
        series = [weight * b - self.tip_radius * ratio * a for a, b in zip(rate, rolling, strict=True)]
        series[0] = series[0] + self.tip_radius
        return series

    def derivative_bound(self, order: int, a: float, b: float) -> float:
        """Majorants of every series in ``derivative``; T and T + l cos u are least where |u| is largest."""
        far, share = min(max(abs(a), abs(b)), math.pi / 2), self._share
        square = [share**2 * 2 ** (k - 1) / FACTORIALS[k] for k in range(1, order)]
        least = 1 - (share * math.sin(far)) ** 2
        inverse = majorant_power(least, square, -0.5)
        # T = T^2 / T: its coefficients beyond the first by the same majorants
        root = product([1.0, *square], inverse)
        total = [root[k] + share / FACTORIALS[k] for k in range(1, order)]
        gap = [abs(self._excess) * x for x in majorant_power(math.sqrt(least) + share * math.cos(far), total, -1.0)]
        rate = product(gap, inverse)
        ratio = abs(self._ratio)
        phase = [0.0, *(ratio * x for x in _integral(rate, 0.0)[1:])]
        if order > 1:
            phase[1] += 1.0
        rolling = product(product(gap, gap), inverse)
        weight, rho = abs(1 - self._ratio) * self.corner_radius, abs(self.tip_radius)
        speed = [weight * y + rho * ratio * x for x, y in zip(rate, rolling, strict=True)]
        speed[0] += rho
        return float(product(exponential(phase[:order]), speed)[order - 1] * FACTORIALS[order - 1])


def _integral(rate: Series, constant: float | Real) -> Series:
    """Coefficients of the integral of a series."""
    return [constant, *(x / (k + 1) for k, x in enumerate(rate))]


def _line(u: Real) -> Series:
    """Coefficients of u about u."""
    return [u, 1.0, 0.0, 0.0, 0.0]
