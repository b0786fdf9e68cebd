"""The working drawing of a cycloidal gear and its table: the rolling circles, the tooth, both flanks by points."""

from __future__ import annotations

from collections.abc import Sequence

from geometry.base.record import replace
from parts.base.part import Part
from parts.base.texts import N_
from parts.drawing.disk_views import disk_drawing
from parts.drawing.working import PartDrawing, Subject
from parts.gears.cycloidal_gear import page as cycloidal_gear_page
from parts.gears.cycloidal_gear.part import CycloidalGearSpec
from parts.keys.wheel import shape_of
from parts.pages.data_table import DataRow, DataTable, Mated, chosen_columns, distance_rows, own_rows
from parts.pages.inputs import SceneKeys, given

_TEETH = ("module", "number_of_teeth", "tip_rolling_radius", "root_rolling_radius", "reference_thickness",
          "root_fillet_radius")  # fmt: skip
_CIRCLES = ("reference_radius", "tip_radius", "root_radius")
_ROWS = 6


def part_drawing(subject: Subject) -> PartDrawing:
    """The section, the exact face, the bore."""
    keys = subject.part.keys
    assert isinstance(keys, CycloidalGearSpec)
    circles = "tip_diameter", "pitch_diameter", "root_diameter"
    return disk_drawing(
        subject, shape_of(keys), subject.part.thing.holes, "zero_tooth", circles, keys.number_of_teeth
    )  # fmt: skip


def data_table(part: Part, scene: SceneKeys, mates: Sequence[Mated]) -> DataTable:
    """The table, as the scene's mates have left the teeth; ``mates``: what meshes with it."""
    # of a mate that stands nowhere nothing is asked
    keys = {key: value for key, value in given(part.keys).items() if key != "mate_number_of_teeth"}
    keys |= {"tip_rolling_diameter": 2 * part.thing.tip_rolling_radius, "rows": _ROWS}
    page = cycloidal_gear_page.sheet(keys | {"circumferential_thinning": part.thing.circumferential_thinning})
    begins = DataRow(N_("x of the points"), "x", N_("through the middle of a tooth"))
    beside = distance_rows(mates, "a_w")
    tips = next(table for table in page.tables if table.name == "tip_flank")
    roots = next(table for table in page.tables if table.name == "root_flank")
    # one flank from the fillet to the tip; where both meet on the pitch circle they have one point
    flank = replace(tips, rows=(*roots.rows, *tips.rows[1:]))
    positions = chosen_columns(flank, ("u", "r", "x", "y"))
    return DataTable((own_rows(page, _TEETH), own_rows(page, _CIRCLES), (*beside, begins)), positions)
