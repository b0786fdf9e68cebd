"""The root fillet of a helical gear in its transverse section: what the ellipse of a rounded rack leaves."""

from __future__ import annotations

import math
from collections.abc import Callable
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.record import Record
from geometry.base.series import FACTORIALS, Series, derived, exponential, power, product
from geometry.curves.curve import Complex, Real
from geometry.curves.fillet import Fillet


class EllipticFillet(Fillet, Record):
    """Envelope of a rack's elliptic tip rounding in the gear's frame.

    The rack's rounding is an ellipse of semi-axes ``semi_axis`` (along its depth) and ``semi_axis`` x ``stretch``,
    moved outwards by ``tip_radius`` - ``semi_axis``: its support function is p(u) = tip_radius - a +
    sqrt(a^2 cos^2 u + b^2 sin^2 u). Everything else is that of ``TrochoidFillet``, which it is at stretch 1: ``u`` is
    the angle of the contact normal, rad, and with n = D sec u + p - p' tan u and s = D tan u - p' sec u

        e(u) = centre + exp(i (angle - s/r)) (r - n exp(-i u)),    speed (s'/r) n + p + p''.

    A left offset d has tip_radius + d. Derivation: DERIVATIONS.md, section 9.
    """

    pitch_radius: float
    depth: float
    tip_radius: float
    angle: float
    start: float
    end: float
    semi_axis: float
    stretch: float
    centre: complex = 0j

    def _square(self, u: Real, order: int) -> Series:
        """a^2 cos^2 u + b^2 sin^2 u = (a^2 + b^2)/2 + (a^2 - b^2)/2 cos 2u, up to an order."""
        a, b = self.semi_axis, self.semi_axis * self.stretch
        waves = (np.cos(2 * u), -np.sin(2 * u), -np.cos(2 * u), np.sin(2 * u))
        series = [(a - b) * (a + b) / 2 * 2**k * waves[k % 4] / FACTORIALS[k] for k in range(order + 1)]
        series[0] = series[0] + (a * a + b * b) / 2
        return series

    def _support(self, u: Real, order: int) -> Series:
        series = power(self._square(u, order), 0.5)
        series[0] = series[0] + (self.tip_radius - self.semi_axis)
        return series

    def _parts(self, u: Real, order: int) -> tuple[Series, Series, Series]:
        """s up to ``order``, n and the rounding's radius of curvature p + p'' up to one less."""
        support = self._support(u, order + 1)
        waves = (np.cos(u), -np.sin(u), -np.cos(u), np.sin(u))
        cosine = [waves[k % 4] / FACTORIALS[k] for k in range(order + 1)]
        sine = [-waves[(k + 1) % 4] / FACTORIALS[k] for k in range(order + 1)]
        return _joined(support, power(cosine, -1.0), sine, self.depth, -1.0)

    def _rolled(self, u: Any, lib: ModuleType = np) -> tuple[Any, Any, Any, Any]:
        """s, n, s' and p + p'' in closed form."""
        cosine, sine = lib.cos(u), lib.sin(u)
        flat, wide = self.semi_axis**2, (self.semi_axis * self.stretch) ** 2
        root = lib.sqrt(flat * cosine * cosine + wide * sine * sine)
        slope = (wide - flat) * sine * cosine / root
        bow = ((wide - flat) * (cosine - sine) * (cosine + sine) - slope * slope) / root
        support, secant, tan = self.tip_radius - self.semi_axis + root, 1 / cosine, sine / cosine
        normal = self.depth * secant + support - slope * tan
        rate = (self.depth * secant - bow - slope * tan) * secant
        return (self.depth * sine - slope) * secant, normal, rate, support + bow

    def normal_length(self, u: float) -> float:
        """n: distance of the contact point from the pitch point, mm."""
        return float(self._rolled(u, math)[1])

    def _point(self, u: Any, lib: ModuleType, exp: Callable[[Any], Any]) -> Any:
        shift, normal, _, _ = self._rolled(u, lib)
        return self.centre + exp(1j * (self.angle - shift / self.pitch_radius)) * (
            self.pitch_radius - normal * exp(-1j * u)
        )

    def speed(self, t: ArrayLike) -> Real:
        """de/du along the tangent, mm/rad; negative where the curve runs back."""
        _, normal, rate, bend = self._rolled(np.asarray(t, dtype=float))
        return np.asarray(rate / self.pitch_radius * normal + bend)

    def tangent(self, t: ArrayLike) -> Complex:
        u = np.asarray(t, dtype=float)
        shift, normal, rate, bend = self._rolled(u)
        sense = np.where(rate / self.pitch_radius * normal + bend < 0, -1j, 1j)
        return sense * np.exp(1j * (self.angle - shift / self.pitch_radius - u))

    def turning(self, t: ArrayLike) -> Real:
        """1 + s'/r: how fast the tangent turns to the right, rad/rad."""
        return np.asarray(1 + self._rolled(np.asarray(t, dtype=float))[2] / self.pitch_radius)

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        """Taylor arithmetic on e' = i exp(i (angle - s/r - u)) speed(u)."""
        u = np.asarray(t, dtype=float)
        shift, normal, bend = self._parts(u, order)
        phase = [-1j * x / self.pitch_radius for x in shift[:order]]
        phase[0] = phase[0] - 1j * u
        if order > 1:
            phase[1] = phase[1] - 1j
        value = product(exponential(phase), self._speed_series(shift, normal, bend)[:order])[order - 1]
        return np.asarray(1j * np.exp(1j * self.angle) * value * FACTORIALS[order - 1])

    def _speed_series(self, shift: Series, normal: Series, bend: Series) -> Series:
        rolling = product([x / self.pitch_radius for x in derived(shift)], normal)
        return [a + b for a, b in zip(rolling, bend, strict=False)]

    def derivative_bound(self, order: int, a: float, b: float) -> float:
        """Majorants of every series in ``derivative``; secant and tangent are greatest where u is farthest from 0."""
        far = max(abs(a), abs(b))
        square = self._square(np.asarray(far), 0)[0]
        flat, wide = self.semi_axis, self.semi_axis * self.stretch
        rest = [abs(wide - flat) * (wide + flat) / 2 * 2**k / FACTORIALS[k] for k in range(1, order + 2)]
        # the binomials of a root alternate in sign beyond the first two
        root = power([min(flat, wide) ** 2, *(-x for x in rest)], 0.5)
        top = math.sqrt(max(float(square), flat**2)) + abs(self.tip_radius - self.semi_axis)
        support = [top, *(-x for x in root[1:])]
        sines, cosines = (math.sin(far), math.cos(far)), (math.cos(far), -math.sin(far))
        waves = (cosines[0], cosines[1], -cosines[0], -cosines[1])
        cosine = [waves[k % 4] / FACTORIALS[k] for k in range(order + 1)]
        secant = power(cosine, -1.0)
        sine = [(sines[0], math.cos(far), -sines[0], -math.cos(far))[k % 4] / FACTORIALS[k] for k in range(order + 1)]
        shift, normal, bend = _joined(support, secant, sine, abs(self.depth), 1.0)
        phase = [0.0, *(x / self.pitch_radius for x in shift[1:order])]
        if order > 1:
            phase[1] += 1
        value = product(exponential(phase), self._speed_series(shift, normal, bend)[:order])[order - 1]
        return float(value * FACTORIALS[order - 1])


def _joined(support: Series, secant: Series, sine: Series, depth: float, sign: float) -> tuple[Series, Series, Series]:
    """s, n and p + p'' from p; with ``sign`` 1 and bounds for all of them, their bounds."""
    slope = derived(support)
    tangent = product(sine, secant)
    shift = [depth * a + sign * b for a, b in zip(tangent, product(slope, secant), strict=True)]
    terms = zip(secant, support, product(slope, tangent), strict=False)
    normal = [depth * a + b + sign * c for a, b, c in terms][:-1]
    bend = [a + b for a, b in zip(support, derived(slope), strict=False)]
    return shift, normal, bend
