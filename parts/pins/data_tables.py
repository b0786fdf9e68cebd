"""The tables of the drawings of what meshes with round pins: the pins, and what makes the flank."""

from __future__ import annotations

from collections.abc import Sequence

from parts.base.part import Part
from parts.base.texts import N_
from parts.pages.data_table import DataRow, DataTable, Mated, chosen_columns, rows_of
from parts.pages.inputs import SceneKeys, given
from parts.pins import cycloidal_page

_FLANK = ("number_of_lobes", "generating_radius", "generating_pin_radius", "eccentricity")
_PINS = ("number_of_pins", "pin_circle_radius", "pin_radius", "pin_clearance", "pin_circle_shift")
_OUTPUT = ("output_pin_diameter", "output_hole_clearance")


def data_table(part: Part, scene: SceneKeys, mates: Sequence[Mated]) -> DataTable:
    """The table of a disc: what generates its lobes, the pins that it runs in, half a lobe by points."""
    page = cycloidal_page.sheet(given(part.keys))
    begins = DataRow(N_("x of the points"), "x", N_("through the top of a lobe"))
    points = next(table for table in page.tables if table.name == "profile")
    return DataTable(
        (rows_of(page, _FLANK), rows_of(page, _PINS), (*rows_of(page, _OUTPUT), begins)),
        chosen_columns(points, ("psi", "r", "x", "y")),
    )
