"""The root fillet of a helical gear in its transverse section: what the ellipse of a rounded rack leaves."""

from __future__ import annotations

import math
from types import ModuleType
from typing import Any

import numpy as np

from geometry.base.record import Record
from geometry.base.series import FACTORIALS, Series, derived, power, product
from geometry.curves.curve import Real
from geometry.curves.trochoid import RackFillet


class EllipticFillet(RackFillet, Record):
    """Envelope of a rack's elliptic tip rounding in the gear's frame.

    The rack's rounding is an ellipse of semi-axes ``semi_axis`` (along its depth) and ``semi_axis`` x ``stretch``,
    moved outwards by ``tip_radius`` - ``semi_axis``: its support function is p(u) = tip_radius - a +
    sqrt(a^2 cos^2 u + b^2 sin^2 u). At stretch 1 it is a ``TrochoidFillet``. A left offset d has tip_radius + d.
    Derivation: DERIVATIONS.md, section 9.
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
    columns = "pitch_radius", "depth", "tip_radius", "angle", "semi_axis", "stretch", "centre"

    def _square(self, u: Real, order: int) -> Series:
        """a^2 cos^2 u + b^2 sin^2 u = (a^2 + b^2)/2 + (a^2 - b^2)/2 cos 2u, up to an order."""
        a, b = self.semi_axis, self.semi_axis * self.stretch
        waves = (np.cos(2 * u), -np.sin(2 * u), -np.cos(2 * u), np.sin(2 * u))
        series = [(a - b) * (a + b) / 2 * 2**k * waves[k % 4] / FACTORIALS[k] for k in range(order + 1)]
        series[0] = series[0] + (a * a + b * b) / 2
        return series

    def _parts(self, u: Any, secant: Series, tangent: Series, *, bound: bool) -> tuple[Series, Series, Series]:
        support, depth, sign = self._support(u, len(secant)), self.depth, -1.0
        if bound:
            support, depth, sign = self._support_bound(float(u), len(secant)), abs(self.depth), 1.0
        slope = derived(support)
        shift = [depth * a + sign * b for a, b in zip(tangent, product(slope, secant), strict=True)]
        terms = zip(secant, support, product(slope, tangent), strict=False)
        normal = [depth * a + b + sign * c for a, b, c in terms][:-1]
        return shift, normal, [a + b for a, b in zip(support, derived(slope), strict=False)]

    def _support(self, u: Real, order: int) -> Series:
        series = power(self._square(u, order), 0.5)
        series[0] = series[0] + (self.tip_radius - self.semi_axis)
        return series

    def _support_bound(self, far: float, order: int) -> Series:
        square = self._square(np.asarray(far), 0)[0]
        flat, wide = self.semi_axis, self.semi_axis * self.stretch
        rest = [abs(wide - flat) * (wide + flat) / 2 * 2**k / FACTORIALS[k] for k in range(1, order + 1)]
        # the binomials of a root alternate in sign beyond the first two
        root = power([min(flat, wide) ** 2, *(-x for x in rest)], 0.5)
        top = math.sqrt(max(float(square), flat**2)) + abs(self.tip_radius - self.semi_axis)
        return [top, *(-x for x in root[1:])]

    def _rolled(self, u: Any, lib: ModuleType = np) -> tuple[Any, Any, Any, Any]:
        cosine, sine = lib.cos(u), lib.sin(u)
        flat, wide = self.semi_axis**2, (self.semi_axis * self.stretch) ** 2
        root = lib.sqrt(flat * cosine * cosine + wide * sine * sine)
        slope = (wide - flat) * sine * cosine / root
        bow = ((wide - flat) * (cosine - sine) * (cosine + sine) - slope * slope) / root
        support, secant, tan = self.tip_radius - self.semi_axis + root, 1 / cosine, sine / cosine
        normal = self.depth * secant + support - slope * tan
        rate = (self.depth * secant - bow - slope * tan) * secant
        return (self.depth * sine - slope) * secant, normal, rate, support + bow
