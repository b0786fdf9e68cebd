"""Proper rigid motions of the plane; names read ``a_from_b`` and inner frames cancel."""

from __future__ import annotations

import cmath
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Points = TypeVar("Points", complex, NDArray[np.complex128])


@dataclass(frozen=True, slots=True)
class Placement2:
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
