"""A row of round holes in the body of a rack."""

from __future__ import annotations

import math
from dataclasses import dataclass

from geometry.errors import OffsetError, ParameterError, at_least, at_most
from geometry.profile import Label, Profile, circle


@dataclass(frozen=True, slots=True)
class RackHoles:
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
                raise ParameterError(f"holes.{name}", getattr(self, name), "must be a finite number above 0; 1 works")
        if self.diameter >= body:
            text = f"is no less than the body's height; at most {at_most(body * 0.9, 4)} mm works"
            raise ParameterError("holes.diameter", self.diameter, text)
        radius = self.diameter / 2
        if self.depth <= radius:
            text = f"the holes reach the root line; at least {at_least(radius * 1.001, 4)} mm works"
            raise ParameterError("holes.depth", self.depth, text)
        if self.depth >= body - radius:
            text = f"the holes reach the bottom; at most {at_most((body - radius) * 0.999, 4)} mm works"
            raise ParameterError("holes.depth", self.depth, text)
        if self.count > 1 and self.spacing <= self.diameter:
            text = f"the holes touch each other; at least {at_least(self.diameter * 1.001, 4)} mm works"
            raise ParameterError("holes.spacing", self.spacing, text)
        if self._ends(length) <= 0:
            most = max(1, int((length - self.diameter) * 0.999 / self.spacing) + 1)
            raise ParameterError("holes.count", self.count, f"the holes reach the ends; at most {most} works")

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
            raise OffsetError(offset, "closes the holes", self.diameter / 2 * (1 - 1e-6))
        if -2 * offset >= thinnest:
            raise OffsetError(offset, "leaves no wall beside the holes", -thinnest / 2 * (1 - 1e-6))
        places = ((k - (self.count - 1) / 2) * self.spacing for k in range(self.count))
        radius = self.diameter / 2 - offset
        return tuple(circle(radius, Label.HOLE, hole=True, centre=complex(x, -root - self.depth)) for x in places)
