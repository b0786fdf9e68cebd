"""Arcs of ellipses: circular arcs stretched along y and then moved, as root fillets of helical racks are."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from geometry.curve import Complex, Curve, Real, Reversed, curvature_from_derivatives
from geometry.line_arc import Arc
from geometry.offset import OffsetCurve
from geometry.placement import Placement2


@dataclass(frozen=True, slots=True)
class EllipticArc:
    """``arc`` stretched by ``stretch`` along y, then carried by ``placement``; t is the arc's own angle, rad."""

    arc: Arc
    stretch: float
    placement: Placement2

    @property
    def domain(self) -> tuple[float, float]:
        return self.arc.domain

    def _stretched(self, points: Complex) -> Complex:
        return np.asarray(points.real + 1j * self.stretch * points.imag)

    def point(self, t: ArrayLike) -> Complex:
        return np.asarray(self.placement.apply(self._stretched(self.arc.point(t))))

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        turn = cmath.exp(1j * self.placement.angle)
        return np.asarray(turn * self._stretched(self.arc.derivative(t, order)))

    def tangent(self, t: ArrayLike) -> Complex:
        first = self.derivative(t)
        return np.asarray(first / np.abs(first))

    def curvature(self, t: ArrayLike) -> Real:
        return curvature_from_derivatives(self.derivative(t), self.derivative(t, 2))

    def derivative_bound(self, order: int, a: float, b: float) -> float:
        return self.arc.radius * max(1.0, abs(self.stretch))

    def offset(self, distance: float) -> Curve:
        return OffsetCurve(self, distance).checked()

    def trimmed(self, a: float, b: float) -> EllipticArc:
        return replace(self, arc=self.arc.trimmed(a, b))

    def reversed(self) -> Curve:
        return Reversed(self)

    def placed(self, placement: Placement2) -> EllipticArc:
        return replace(self, placement=placement @ self.placement)

    def mirrored(self) -> EllipticArc:
        moved = Placement2(-self.placement.angle, self.placement.translation.conjugate())
        return replace(self, arc=self.arc.mirrored(), placement=moved)


def ellipse_angle(normal_angle: float, stretch: float) -> float:
    """Angle t of the ellipse's point whose normal stands at an angle below 90 degrees, rad."""
    return math.atan2(stretch * math.sin(normal_angle), math.cos(normal_angle))
