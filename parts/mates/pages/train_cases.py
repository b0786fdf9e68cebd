"""The trains of the sources: lesson 2 of the practicum with its exercises, and the examples of the guide on trains.

A figure that is lost leaves the kind of one mesh open, which decides the sign of the ratio: ``open``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from geometry.base.record import Record
from parts.base.psv import rows_of


class Case(Record):
    """A train in the words of the keys; ``open``: the mesh whose kind only the lost figure would show."""

    meshes: str
    driven: str
    teeth: Mapping[str, int] = {}
    shafts: str = ""
    carriers: Mapping[str, str] = {}
    held: str = ""
    speeds: Mapping[str, float] = {}
    module: float | None = None
    open: str = ""


def _pairs(cell: str) -> dict[str, str]:
    """Names and what they have, as 1=20 2'=30."""
    return dict(word.split("=") for word in cell.split())


def _case(cells: Sequence[str]) -> Case:
    meshes, driven, teeth, shafts, carriers, held, speeds, module, lost = cells
    wheels = {wheel: int(z) for wheel, z in _pairs(teeth).items()}
    given = {link: float(speed) for link, speed in _pairs(speeds).items()}
    own = float(module) if module else None
    return Case(meshes, driven, wheels, shafts, _pairs(carriers), held, given, own, lost)


CASES = {name: _case(cells) for name, *cells in rows_of(__file__, "train_cases")}
