"""An instance of a part at its place in a scene."""

from __future__ import annotations

import math

from geometry.base.placement import Placement3, Vector
from geometry.base.record import Record

UPWARDS: Vector = (0.0, 0.0, 1.0)


class Instance(Record):
    """A part at its place: the part's frame turned by ``rotation`` (rad) about z, then moved to ``at`` (mm).

    ``subassembly``: its place in the product tree.

    Between both z is laid on the unit vector ``axis``, as ``Placement3.towards`` does it.

    ``placed_by``: "at" (the scene says where), "mate", "origin" (the first of all), "row" (laid out beside), or "axles"
    (a frame, under them).
    """

    id: str
    part: str
    at: Vector = (0.0, 0.0, 0.0)
    rotation: float = 0.0
    placed_by: str = "origin"
    axis: Vector = UPWARDS
    subassembly: str | None = None

    @property
    def centre(self) -> complex:
        """Its axis in the plane, mm."""
        return complex(self.at[0], self.at[1])

    @property
    def is_upright(self) -> bool:
        """Whether its axis points up, or straight down."""
        return self.axis[0] == self.axis[1] == 0

    @property
    def is_over(self) -> bool:
        """Whether it is turned over: its axis points straight down."""
        return self.is_upright and self.axis[2] < 0

    @property
    def scene_from_part(self) -> Placement3:
        """The placement of the part's frame in the scene."""
        return Placement3.towards(self.axis, math.remainder(self.rotation, 2 * math.pi), self.at)
