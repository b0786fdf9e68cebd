"""The table of a cam's drawing: motion, follower, where the angles begin, and the positions of its profile."""

from __future__ import annotations

from collections.abc import Sequence

from geometry.base.record import replace
from parts.base.part import Part
from parts.base.texts import N_, Text, listed, message
from parts.cams.disk_cam.page import sheet, table_from
from parts.cams.groove_cam.piece import GroovePieceSpec
from parts.pages.cam_steps import law_text
from parts.pages.data_table import DataRow, DataTable, Mated, chosen_columns, row_of, rows_of
from parts.pages.inputs import SceneKeys
from parts.pages.page import Sheet
from parts.pages.terms import TERMS

_MOTION = ("lift", "swing_deg")
# what the drawing itself has a size of is no row: diameters, depths, the base circle where its disk shows it
_LEAST = "least_base_circle_radius", "base_circle_radius", "least_cam_radius"
_SIZES = (
    "follower_radius", "roller_diameter", "cone_angle_deg", "follower_offset", "centre_distance", "arm_length",
    "face_offset", "pivot_offset", "pivot_height", "start_angle_deg", "roller_distance", "inner_roller_angle_deg",
    "second_arm_length", "second_follower_radius", "driven_pivot_x", "driven_pivot_y", "driven_length",
    "driven_start_angle_deg", "driven_start_x", "driven_start_y", "driven_direction_deg", "coupler_length",
    "guide_pivot_x", "guide_pivot_y", "guide_length", "guide_through_x", "guide_through_y", "guide_direction_deg",
    "coupler_point_x", "coupler_point_y", "follower_direction_deg", *_LEAST, "base_height", "whole_travel",
    "groove_width",
)  # fmt: skip
# the table of positions of each kind, and its columns that a maker needs
_POLAR = ("phi", "S", "r", "theta")
_POSITIONS = {
    "cam": ("positions", _POLAR),
    "linkage_cam": ("positions", _POLAR),
    "conjugate_cam": ("positions_second", _POLAR),
    "groove_cam": ("positions", ("phi", "S", "x_p", "y_p")),
    "wedge_cam": ("positions", ("s", "S", "x", "y")),
    "barrel_cam": ("development", ("phi", "x", "z", "x_1", "z_1", "x_2", "z_2")),
}
_FOLLOWERS: dict[str, Text] = {
    "pointed": N_("pointed"),
    "roller": N_("with a roller"),
    "mushroom": N_("mushroom"),
    "flat": N_("flat"),
}


def data_table(part: Part, scene: SceneKeys, mates: Sequence[Mated]) -> DataTable:
    """The table of a cam of a scene."""
    # a plate of a groove cam has the table of its cam
    owner, kind = (part.keys.of, "groove_cam") if isinstance(part.keys, GroovePieceSpec) else (part.id, part.kind)
    page = sheet(table_from(scene, "", {"part": owner}))
    name, columns = _POSITIONS[kind]
    found = next(table for table in page.tables if table.name == name)
    return DataTable(
        (
            (*rows_of(page, _MOTION), *_phases(page)),
            (*_follower(part), *_sizes(part, page)),
            _datum(kind),
        ),
        chosen_columns(found, columns),
    )


def _phases(page: Sheet) -> list[DataRow]:
    """Each phase with its law."""
    laws = [phase["law"] for phase in page.data["phases"]]
    steps = [s for s in page.steps() if s.name.endswith(("_angle_deg", "_travel")) and s.name.partition("_")[0] in
             ("rise", "return", "far", "near")]  # fmt: skip
    rows = []
    for step, law in zip(steps, laws, strict=False):
        row = row_of(step)
        named = message("{phase}: {law}", phase=message(TERMS[step.name].name), law=law_text(law)) if law else row.name
        rows.append(replace(row, name=named))
    return rows


def _follower(part: Part) -> tuple[DataRow, ...]:
    keys = part.keys
    shape = _FOLLOWERS.get(getattr(keys, "follower", ""))
    if shape is None:
        return ()
    moves = N_("oscillating") if getattr(keys, "oscillating", None) else N_("translating")
    if part.kind == "linkage_cam":
        moves = N_("on a connecting rod")
    return (DataRow(N_("follower"), "", listed([shape, moves])),)


def _sizes(part: Part, page: Sheet) -> list[DataRow]:
    """Sizes that the calculation tells, in the order of drawings."""
    shown = _LEAST if "base_circle_diameter" in part.circles else ()
    steps = {step.name: step for step in page.steps() if step.name in _SIZES and step.name not in shown}
    return [row_of(steps[name]) for name in _SIZES if name in steps]


def _datum(kind: str) -> tuple[DataRow, ...]:
    """Where the columns of the positions of a kind begin."""
    if kind == "wedge_cam":
        return (DataRow(N_("origin of x and y"), "O", N_("as drawn")),)
    if kind == "barrel_cam":
        turning = DataRow(N_("the cam turns, seen from the right of its section"), "", N_("counter-clockwise"))
        return (turning, DataRow(N_("development of the outer cylinder"), "x", N_("φ = 0 at its right end")))
    turning = DataRow(N_("the cam turns"), "", N_("counter-clockwise"))
    if kind == "groove_cam":
        return (turning, DataRow(N_("path of the roller's centre"), "x_p", N_("from the axis, as drawn")))
    return (turning, DataRow(N_("polar angle of the profile"), "θ", N_("from +x, as drawn")))
