"""Arcs of ellipses: circular arcs stretched along y and then moved, as root fillets of helical racks are."""

from __future__ import annotations

import cmath
import math

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.placement import Placement2
from geometry.base.record import Record, replace
from geometry.curves.curve import Complex, Curve
from geometry.curves.line_arc import Arc


class EllipticArc(Curve, Record):
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

    def derivative_bound(self, order: int, a: float, b: float) -> float:
        return self.arc.radius * max(1.0, abs(self.stretch))

    def trimmed(self, a: float, b: float) -> EllipticArc:
        return replace(self, arc=self.arc.trimmed(a, b))

    def placed(self, placement: Placement2) -> EllipticArc:
        return replace(self, placement=placement @ self.placement)

    def mirrored(self) -> EllipticArc:
        return replace(self, arc=self.arc.mirrored(), placement=self.placement.mirrored())


def ellipse_angle(normal_angle: float, stretch: float) -> float:
    """Angle t of the ellipse's point whose normal stands at an angle below 90 degrees, rad."""
    return math.atan2(stretch * math.sin(normal_angle), math.cos(normal_angle))
