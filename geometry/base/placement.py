"""Proper rigid motions of the plane and of space; names read ``a_from_b`` and inner frames cancel."""

from __future__ import annotations

import cmath
import math
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from geometry.base.record import Record

Points = TypeVar("Points", complex, NDArray[np.complex128])
Vector = tuple[float, float, float]


class Placement2(Record):
    """Turn by ``angle`` (rad, counter-clockwise) about the origin, then move by ``translation`` (mm)."""

    angle: float = 0.0
    translation: complex = 0j

    def apply(self, points: Points) -> Points:
        """Points (plane points as x + iy) of frame b in frame a."""
        return cmath.exp(1j * self.angle) * points + self.translation

    def __matmul__(self, other: Placement2) -> Placement2:
        """``a_from_b @ b_from_c`` is ``a_from_c``."""
        return Placement2(self.angle + other.angle, self.apply(other.translation))

    def inverse(self) -> Placement2:
        """``b_from_a``."""
        return Placement2(-self.angle, -self.translation * cmath.exp(-1j * self.angle))

    def mirrored(self) -> Placement2:
        """The motion that carries mirror images in the x axis where this one carries their originals."""
        return Placement2(-self.angle, self.translation.conjugate())


class Placement3(Record):
    """Turn by the rotation whose rows are ``rotation``, then move by ``translation`` (mm)."""

    rotation: tuple[Vector, Vector, Vector] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    translation: Vector = (0.0, 0.0, 0.0)

    @classmethod
    def about_z(cls, angle: float, translation: Vector = (0.0, 0.0, 0.0)) -> Placement3:
        """Turn by ``angle`` (rad, counter-clockwise seen from +z), then move."""
        c, s = math.cos(angle), math.sin(angle)
        return cls(((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)), translation)

    @classmethod
    def towards(cls, axis: Vector, angle: float, translation: Vector = (0.0, 0.0, 0.0)) -> Placement3:
        """Turn by ``angle`` (rad) about z, lay z on the unit vector ``axis`` by the shortest way, then move.

        What points down is turned over about x.
        """
        turned = cls.about_z(angle, translation)
        x, y, z = axis
        aside = x * x + y * y
        if aside == 0 and z > 0:
            return turned
        # (1 - z) / aside, without cancellation above
        k = 1 / (1 + z) if z >= 0 else (1 - z) / aside if aside else 0.0
        laid = np.array([[1 - k * x * x, -k * x * y, x], [-k * x * y, 1 - k * y * y, y], [-x, -y, z]])
        if not aside:
            laid = np.diag([1.0, -1.0, -1.0])
        return _placement3(laid @ np.array(turned.rotation), np.array(translation))

    @property
    def z(self) -> Vector:
        """The direction of frame b's z in frame a."""
        x, y, z = (row[2] for row in self.rotation)
        return x, y, z

    @property
    def turn(self) -> float:
        """The angle of frame b's x in frame a, seen along z, rad."""
        return math.atan2(self.rotation[1][0], self.rotation[0][0])

    def matrix(self) -> NDArray[np.float64]:
        """(3, 4): rotation and translation side by side."""
        return np.column_stack([np.array(self.rotation), np.array(self.translation)])

    def apply(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points (n, 3) of frame b in frame a, mm."""
        return points @ np.array(self.rotation).T + np.array(self.translation)

    def __matmul__(self, other: Placement3) -> Placement3:
        """``a_from_b @ b_from_c`` is ``a_from_c``."""
        rotation = np.array(self.rotation) @ np.array(other.rotation)
        return _placement3(rotation, self.apply(np.array(other.translation)))

    def inverse(self) -> Placement3:
        """``b_from_a``."""
        back = np.array(self.rotation).T
        return _placement3(back, -back @ np.array(self.translation))


def _placement3(rotation: NDArray[np.float64], translation: NDArray[np.float64]) -> Placement3:
    (a, b, c), move = rotation.tolist(), translation.tolist()
    return Placement3((tuple(a), tuple(b), tuple(c)), tuple(move))
