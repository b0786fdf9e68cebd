"""A row of round holes in the body of a rack."""

from __future__ import annotations

import math

from geometry.base.errors import Nearest, OffsetError, ParameterError
from geometry.base.record import Record
from geometry.plane.profile import Label, Profile, circle

# mm; holes that keep less to anything are those of a mistaken keyboard
_STEP = 1e-4


class RackHoles(Record):
    """``count`` equal holes, ``spacing`` mm apart about the middle, centres ``depth`` mm below the root line."""

    count: int
    diameter: float
    spacing: float
    depth: float

    def check(self, length: float, body: float) -> None:
        """Refuse holes that do not lie within the body of a rack, mm.

        Raises
        ------
        ParameterError
            With the key and the nearest value that works.
        """
        for name in ("diameter", "spacing", "depth"):
            if not 0 < getattr(self, name) < math.inf:
                raise ParameterError(f"holes.{name}", getattr(self, name), "not_finite_above_zero", Nearest(1.0))
        if self.diameter >= body:
            raise ParameterError.beyond("holes.diameter", self.diameter, "hole_as_high_as_body", body - _STEP)
        radius = self.diameter / 2
        if self.depth <= radius:
            raise ParameterError.beyond("holes.depth", self.depth, "holes_reach_root_line", radius + _STEP)
        if self.depth >= body - radius:
            raise ParameterError.beyond("holes.depth", self.depth, "holes_reach_bottom", body - radius - _STEP)
        if self.count > 1 and self.spacing <= self.diameter:
            raise ParameterError.beyond("holes.spacing", self.spacing, "holes_touch_each_other", self.diameter + _STEP)
        if self._ends(length) <= 0:
            most = Nearest(max(1, math.ceil((length - self.diameter) / self.spacing)), "at_most")
            raise ParameterError("holes.count", self.count, "holes_reach_ends", most)

    def _ends(self, length: float) -> float:
        """Material beyond the outermost hole, mm."""
        return (length - (self.count - 1) * self.spacing - self.diameter) / 2

    def thinnest(self, length: float, body: float) -> float:
        """Least material beside the holes, mm; the row keeps the root line, though teeth stand above it."""
        radius = self.diameter / 2
        between = self.spacing - self.diameter if self.count > 1 else math.inf
        return min(self.depth - radius, body - self.depth - radius, between, self._ends(length))

    def profiles(self, root: float, offset: float, thinnest: float) -> tuple[Profile, ...]:
        """One clockwise profile a hole, moved ``offset`` mm out of the material; the root line is y = -``root``."""
        if offset >= self.diameter / 2:
            raise OffsetError(offset, "closes_holes")
        if -2 * offset >= thinnest:
            raise OffsetError(offset, "no_wall_beside_holes")
        places = ((k - (self.count - 1) / 2) * self.spacing for k in range(self.count))
        radius = self.diameter / 2 - offset
        return tuple(circle(radius, Label.HOLE, hole=True, centre=complex(x, -root - self.depth)) for x in places)
