"""The involute of a circle: every flank that a straight-sided cutter leaves on a gear."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.angles import roll_minus_polar
from geometry.base.errors import CuspError
from geometry.base.placement import Placement2
from geometry.base.record import Record, replace
from geometry.curves.curve import Complex, Curve, Real, check_interval


class Involute(Curve, Record):
    """c(f) = centre + r_b exp(i (t0 + f)) (1 - i f); f is the roll angle, rad.

    f > 0 is the branch that turns left on its way out (the lower flank of a tooth on +x), f < 0 its
    mirror image travelled inwards (the upper flank). The domain must not hold f = 0 inside it.
    Source: ISO 21771, involute in polar form; |c^(k)| = r_b sqrt(f^2 + (k-1)^2).
    """

    base_radius: float
    base_angle: float
    start_roll: float
    end_roll: float
    centre: complex = 0j
    columns = "base_radius", "base_angle", "centre"

    @property
    def domain(self) -> tuple[float, float]:
        return self.start_roll, self.end_roll

    @property
    def _sense(self) -> float:
        return 1.0 if self.start_roll + self.end_roll > 0 else -1.0

    def point(self, t: ArrayLike) -> Complex:
        f = np.asarray(t, dtype=float)
        return self.centre + self.base_radius * np.exp(1j * (self.base_angle + f)) * (1 - 1j * f)

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        f = np.asarray(t, dtype=float)
        factor = 1j ** (order - 1) * f + (order - 1) * 1j ** (order - 2)
        return self.base_radius * np.exp(1j * (self.base_angle + f)) * factor

    def derivatives(self, t: ArrayLike, order: int) -> list[Complex]:
        f = np.asarray(t, dtype=float)
        spoke = self.base_radius * np.exp(1j * (self.base_angle + f))
        factors = [1j ** (k - 1) * f + (k - 1) * 1j ** (k - 2) for k in range(1, order + 1)]
        return [self.centre + spoke * (1 - 1j * f), *(spoke * factor for factor in factors)]

    def tangent(self, t: ArrayLike) -> Complex:
        return self._sense * np.exp(1j * (self.base_angle + np.asarray(t, dtype=float)))

    def curvature(self, t: ArrayLike) -> Real:
        with np.errstate(divide="ignore"):
            return 1 / (self.base_radius * np.abs(np.asarray(t, dtype=float)))

    def derivative_bound(self, order: int, a: float, b: float) -> float:
        return self.base_radius * math.hypot(max(abs(a), abs(b)), order - 1)

    def offset(self, distance: float) -> Involute:
        """The same involute, turned: an involute stays an involute."""
        turn = self._sense * distance / self.base_radius
        moved = replace(
            self,
            base_angle=self.base_angle + turn,
            start_roll=self.start_roll - turn,
            end_roll=self.end_roll - turn,
        )
        if moved.start_roll * self._sense < 0 or moved.end_roll * self._sense < 0:
            raise CuspError(turn, distance)
        return moved

    def trimmed(self, a: float, b: float) -> Involute:
        check_interval(self.domain, a, b)
        return replace(self, start_roll=a, end_roll=b)

    def placed(self, placement: Placement2) -> Involute:
        return replace(self, base_angle=self.base_angle + placement.angle, centre=placement.apply(self.centre))

    def mirrored(self) -> Involute:
        return replace(
            self,
            base_angle=-self.base_angle,
            start_roll=-self.end_roll,
            end_roll=-self.start_roll,
            centre=self.centre.conjugate(),
        )

    def roll_at_radius(self, radius: float) -> float:
        """Roll angle at a distance from the centre, rad, with the sign of this branch."""
        ratio = radius / self.base_radius
        return self._sense * math.sqrt(max((ratio - 1) * (ratio + 1), 0.0))

    def polar_angle_at_radius(self, radius: float) -> float:
        """Polar angle about the centre, rad, at a distance from it."""
        return self.base_angle + roll_minus_polar(self.roll_at_radius(radius))
