"""Any curve carried by a rigid motion or mirrored, for curves whose own formula has no place for it."""

from __future__ import annotations

import cmath
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from geometry.curve import Complex, Curve, Real, Reversed
from geometry.errors import CuspError
from geometry.placement import Placement2


@dataclass(frozen=True, slots=True)
class Carried:
    """``base`` turned and moved by ``placement``; parameter, speed and curvature are its own."""

    base: Curve
    placement: Placement2

    @property
    def domain(self) -> tuple[float, float]:
        return self.base.domain

    def point(self, t: ArrayLike) -> Complex:
        return self.placement.apply(self.base.point(t))

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        return cmath.exp(1j * self.placement.angle) * self.base.derivative(t, order)

    def tangent(self, t: ArrayLike) -> Complex:
        return cmath.exp(1j * self.placement.angle) * self.base.tangent(t)

    def curvature(self, t: ArrayLike) -> Real:
        return self.base.curvature(t)

    def derivative_bound(self, order: int, a: float, b: float) -> float | None:
        return self.base.derivative_bound(order, a, b)

    def offset(self, distance: float) -> Curve:
        return Carried(self.base.offset(distance), self.placement)

    def trimmed(self, a: float, b: float) -> Curve:
        return Carried(self.base.trimmed(a, b), self.placement)

    def reversed(self) -> Curve:
        return Reversed(self)

    def placed(self, placement: Placement2) -> Curve:
        return Carried(self.base, placement @ self.placement)

    def mirrored(self) -> Curve:
        return Carried(self.base.mirrored(), Placement2(-self.placement.angle, self.placement.translation.conjugate()))


@dataclass(frozen=True, slots=True)
class Mirrored:
    """Mirror image of ``base`` in the x axis, travelled the other way: parameter t runs as -t of the base."""

    base: Curve

    @property
    def domain(self) -> tuple[float, float]:
        low, high = self.base.domain
        return -high, -low

    def point(self, t: ArrayLike) -> Complex:
        return np.conj(self.base.point(-np.asarray(t, dtype=float)))

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        return (-1) ** order * np.conj(self.base.derivative(-np.asarray(t, dtype=float), order))

    def tangent(self, t: ArrayLike) -> Complex:
        return -np.conj(self.base.tangent(-np.asarray(t, dtype=float)))

    def curvature(self, t: ArrayLike) -> Real:
        # mirroring and travelling back both turn the sign
        return self.base.curvature(-np.asarray(t, dtype=float))

    def derivative_bound(self, order: int, a: float, b: float) -> float | None:
        return self.base.derivative_bound(order, -b, -a)

    def offset(self, distance: float) -> Curve:
        try:
            return Mirrored(self.base.offset(distance))
        except CuspError as cusp:
            raise CuspError(-cusp.t, distance) from None

    def trimmed(self, a: float, b: float) -> Curve:
        return Mirrored(self.base.trimmed(-b, -a))

    def reversed(self) -> Curve:
        return Reversed(self)

    def placed(self, placement: Placement2) -> Curve:
        return Carried(self, placement)

    def mirrored(self) -> Curve:
        return self.base
