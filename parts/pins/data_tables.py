"""The tables of the drawings of what meshes with round pins: the pins, and what makes the flank."""

from __future__ import annotations

from collections.abc import Sequence

from parts.base.part import Part
from parts.base.texts import N_
from parts.pages.data_table import DataRow, DataTable, Mated, chosen_columns, rows_of
from parts.pages.inputs import SceneKeys, given
from parts.pages.page import Sheet, Table
from parts.pins import cycloidal_page, lantern_page
from parts.pins.lantern_gear import LanternGearSpec

_FLANK = ("number_of_lobes", "generating_radius", "generating_pin_radius", "eccentricity")
_PINS = ("number_of_pins", "pin_circle_radius", "pin_radius", "pin_clearance", "pin_circle_shift")
_TEETH = ("number_of_teeth", "lantern_gear_pitch_radius", "lantern_pitch", "generating_pin_radius", "root_arc_radius")
_LANTERN = ("number_of_pins", "lantern_pitch_radius", "pin_radius", "pin_clearance", "root_clearance")
_PAIR = ("working_centre_distance",)
_OUTPUT = ("output_pin_diameter", "output_hole_clearance")


def data_table(part: Part, scene: SceneKeys, mates: Sequence[Mated]) -> DataTable:
    """The table of a disc, or of a lantern's gear: what generates the flank, the pins, the flank by points."""
    if isinstance(part.keys, LanternGearSpec):
        page = lantern_page.sheet(given(part.keys))
        begins = DataRow(N_("x of the points"), "x", N_("through the middle of a tooth"))
        return DataTable(
            (rows_of(page, _TEETH), rows_of(page, _LANTERN), (*rows_of(page, _PAIR), begins)),
            _points(page, "flank", "u"),
        )
    page = cycloidal_page.sheet(given(part.keys))
    begins = DataRow(N_("x of the points"), "x", N_("through the top of a lobe"))
    return DataTable(
        (rows_of(page, _FLANK), rows_of(page, _PINS), (*rows_of(page, _OUTPUT), begins)),
        _points(page, "profile", "psi"),
    )


def _points(page: Sheet, name: str, angle: str) -> Table:
    """Places of the flank by the angle that generates them."""
    return chosen_columns(next(table for table in page.tables if table.name == name), (angle, "r", "x", "y"))
