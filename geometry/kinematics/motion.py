"""Motions of a body in its plane: where its frame's origin is and how far it has turned, as Taylor series.

The common parameter t is time or the drive's angle (Savvin's "common parameter"); plane points are complex.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import numpy as np

from geometry.base.record import Record
from geometry.base.series import Series, exponential, product
from geometry.curves.curve import Real

Pose = tuple[Series, Series]


class PlaneMotion(Protocol):
    """A moving frame, vectorised over t."""

    def pose(self, t: Real, order: int) -> Pose:
        """Taylor coefficients 0 to ``order`` of the origin (complex, mm) and of the angle alpha (rad)."""


def _constant(value: complex | float, t: Real, order: int) -> Series:
    zero = 0.0 * t
    return [value + zero, *([zero] * order)]


class Rotation(Record):
    """Turning about a fixed ``centre`` at a constant ``rate`` (rad per unit of t) from ``start``."""

    rate: float = 1.0
    centre: complex = 0j
    start: float = 0.0

    def pose(self, t: Real, order: int) -> Pose:
        """The origin rests, the angle is start + rate t."""
        angle = _constant(0.0, t, order)
        angle[0] = self.start + self.rate * t
        if order:
            angle[1] = self.rate + 0.0 * t
        return _constant(self.centre, t, order), angle


class Sliding(Record):
    """Uniform translation: the origin at ``start`` + ``velocity`` t, the frame turned by ``angle``."""

    velocity: complex
    start: complex = 0j
    angle: float = 0.0

    def pose(self, t: Real, order: int) -> Pose:
        """The angle rests."""
        origin = _constant(0j, t, order)
        origin[0] = self.start + self.velocity * t
        if order:
            origin[1] = self.velocity + 0.0 * t
        return origin, _constant(self.angle, t, order)


class GivenMotion(Record):
    """Any motion, from a function (t, order) that returns its two series."""

    function: Callable[[Real, int], Pose]

    def pose(self, t: Real, order: int) -> Pose:
        """What the function says."""
        return self.function(t, order)


def relative_pose(first: PlaneMotion, second: PlaneMotion, t: Real, order: int) -> Pose:
    """Frame 2 seen from frame 1: A + i B and alpha_2 - alpha_1; Savvin's (6), (7)."""
    origin1, angle1 = first.pose(t, order)
    origin2, angle2 = second.pose(t, order)
    back = exponential([-1j * x for x in angle1])
    return product([b - a for a, b in zip(origin1, origin2, strict=True)], back), [
        b - a for a, b in zip(angle1, angle2, strict=True)
    ]


def instant_centre(first: PlaneMotion, second: PlaneMotion, t: Real) -> tuple[Real, Real]:
    """The relative instant centre in frame 1 (fixed centrode) and in frame 2 (moving one), complex, mm.

    (F, R) of Savvin's (12), (13); inf where the bodies do not turn against each other.
    """
    place, angle = relative_pose(first, second, t, 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        moving = 1j * place[1] * np.exp(-1j * angle[0]) / angle[1]
    return place[0] + moving * np.exp(1j * angle[0]), moving
