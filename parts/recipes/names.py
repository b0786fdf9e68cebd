"""What parts and instances of assemblies are called, and how they look: ``names.psv``, by recipe."""

from __future__ import annotations

from geometry.base.record import Record
from parts.base.psv import rows_of


class Named(Record):
    """A part or an instance of a recipe; empty where nothing is told. ``position``: of the parts list."""

    title: str = ""
    colour: str = ""
    position: str = ""
    material: str = ""
    standard: str = ""


NAMES: dict[str, dict[str, Named]] = {}
for _recipe, _name, *_cells in rows_of(__file__, "names"):
    NAMES.setdefault(_recipe, {})[_name] = Named(*_cells)
