"""What the readers of assembly files give: parts, and where each of them stands."""

from __future__ import annotations

from typing import NamedTuple

from geometry.base.record import Record
from geometry.curves.curve import Real
from parts.base.readback import ReadBack


class Prototype(NamedTuple):
    """A part of an assembly file, with its colour, #rrggbb."""

    name: str
    part: ReadBack
    colour: str | None


class Occurrence(NamedTuple):
    """A part in its place: the index of its prototype, and its placement as (3, 4): rotation and move, mm.

    ``within``: the sub-assembly that it belongs to; None of formats that have none.
    """

    name: str
    prototype: int
    place: Real
    within: str | None = None


class ReadAssembly(Record):
    """What an assembly file holds."""

    title: str
    prototypes: list[Prototype]
    occurrences: list[Occurrence]
