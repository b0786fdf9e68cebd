"""Parallel curves of any exact curve, with exact derivatives, and where they turn back."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from geometry.curve import Complex, Curve, Real, Reversed, curvature_from_derivatives
from geometry.errors import CuspError
from geometry.placement import Placement2
from geometry.roots import bracketed_root
from geometry.series import FACTORIALS, conjugate, power, product

_CUSP_SAMPLES = 257


@dataclass(frozen=True, slots=True)
class OffsetCurve:
    """c(t) + d n(t), d mm to the left of ``base``, whose derivatives must reach one order further."""

    base: Curve
    distance: float

    @property
    def domain(self) -> tuple[float, float]:
        return self.base.domain

    def point(self, t: ArrayLike) -> Complex:
        return self.base.point(t) + 1j * self.distance * self.base.tangent(t)

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        """Taylor arithmetic: n = i c' / sqrt(c' conj(c'))."""
        first = [self.base.derivative(t, k + 1) / FACTORIALS[k] for k in range(order + 1)]
        square = product(first, conjugate(first))
        normal = product(first, power([x.real for x in square], -0.5))
        return self.base.derivative(t, order) + 1j * self.distance * FACTORIALS[order] * normal[order]

    def _stretch(self, t: ArrayLike) -> Real:
        return 1 - self.distance * self.base.curvature(t)

    def tangent(self, t: ArrayLike) -> Complex:
        return np.where(self._stretch(t) < 0, -1.0, 1.0) * self.base.tangent(t)

    def curvature(self, t: ArrayLike) -> Real:
        return curvature_from_derivatives(self.derivative(t), self.derivative(t, 2))

    def derivative_bound(self, order: int, a: float, b: float) -> None:
        """None: no bound is proven for a general parallel curve."""

    def checked(self) -> OffsetCurve:
        """This curve, or CuspError where it turns back: at the least stretch near 257 samples, refined."""
        t = np.linspace(*self.domain, _CUSP_SAMPLES)
        stretch = self._stretch(t)
        lowest = int(np.argmin(stretch))
        low, high = float(t[max(lowest - 1, 0)]), float(t[min(lowest + 1, len(t) - 1)])
        for _ in range(80):
            third = (high - low) / 3
            left, right = low + third, high - third
            low, high = (low, right) if self._stretch(left) < self._stretch(right) else (left, high)
        least = min(((low + high) / 2, float(t[lowest])), key=lambda place: float(self._stretch(place)))
        if float(self._stretch(least)) > 0:
            return self
        places = np.sort(np.append(t, least))
        turned = self._stretch(places) <= 0
        changes = np.flatnonzero(turned[1:] != turned[:-1])
        if not changes.size:
            raise CuspError(float(t[0]), self.distance)
        low, high = places[changes[0]], places[changes[0] + 1]
        raise CuspError(bracketed_root(lambda s: float(self._stretch(s)), float(low), float(high)).value, self.distance)

    def offset(self, distance: float) -> OffsetCurve:
        try:
            return OffsetCurve(self.base, self.distance + distance).checked()
        except CuspError as cusp:
            raise CuspError(cusp.t, distance) from None

    def trimmed(self, a: float, b: float) -> OffsetCurve:
        return replace(self, base=self.base.trimmed(a, b))

    def reversed(self) -> Curve:
        return Reversed(self)

    def placed(self, placement: Placement2) -> OffsetCurve:
        return replace(self, base=self.base.placed(placement))

    def mirrored(self) -> OffsetCurve:
        return replace(self, base=self.base.mirrored())
