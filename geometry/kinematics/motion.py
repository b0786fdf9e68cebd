"""Motions of a body in its plane: where its frame's origin is and how far it has turned, as Taylor series.

The common parameter t is time or the drive's angle (Savvin's "common parameter"); plane points are complex.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from geometry.base.record import Record
from geometry.base.series import Series
from geometry.curves.curve import Real

Pose = tuple[Series, Series]


class PlaneMotion(Protocol):
    """A moving frame, vectorised over t."""

    def pose(self, t: Real, order: int) -> Pose:
        """Taylor coefficients 0 to ``order`` of the origin (complex, mm) and of the angle alpha (rad)."""


class GivenMotion(Record):
    """Any motion, from a function (t, order) that returns its two series."""

    function: Callable[[Real, int], Pose]

    def pose(self, t: Real, order: int) -> Pose:
        """What the function says."""
        return self.function(t, order)
