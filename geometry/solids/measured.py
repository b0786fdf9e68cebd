"""What files, mass and checks ask of a body that is told by its faces, however these are made."""

from __future__ import annotations

from collections.abc import Callable
from typing import ClassVar, Literal, Protocol

from geometry.base.record import Record
from geometry.curves.curve import Real
from geometry.solids.mass import Moments


class Measured(Record, eq=False):
    """An exact surface of a body: what it is called, and how far points (n, 3) lie from it, mm, also beyond it.

    ``turns``: so many equal turns of a whole one about the z axis bring it onto itself each; 0: any turn does.
    """

    what: str
    distance: Callable[[Real], Real]
    turns: int = 1


class Faced(Protocol):
    """What files, mass and checks ask of a body told by its faces; all lengths in mm.

    Who reads files back shares nothing with who makes faces: ``FacedBody`` is one that does.
    """

    is_faced: ClassVar[Literal[True]]

    @property
    def precision(self) -> float:
        """Within which edges lie on faces and end at vertices."""

    @property
    def surfaces(self) -> tuple[Measured, ...]:
        """Every exact surface once."""

    @property
    def moments(self) -> Moments:
        """Volume, centre and inertia."""

    @property
    def slack(self) -> float:
        """How much the volume of ``moments`` may be off for each mm that a file's faces are, mm^2; 0: exact."""

    def levels(self) -> tuple[float, ...]:
        """Heights, the lowest first, the highest last."""

    def section_reach(self) -> float:
        """Greatest distance from the axis."""

    def reach(self) -> float:
        """Greatest coordinate."""

    def steepness(self) -> float:
        """How far a surface moves sideways for a step along the axis at most."""
