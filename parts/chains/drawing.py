"""The working drawing of a sprocket and its table (GOST 2.408): the chain, the gap, what is measured, the circles."""

from __future__ import annotations

from collections.abc import Sequence

from geometry.base.record import replace
from parts.base.part import Part
from parts.base.texts import N_, standard_told
from parts.chains import page as sprocket_page
from parts.chains.sprocket import SPROCKET, SprocketSpec
from parts.drawing.disk_views import disk_drawing
from parts.drawing.wheel_views import Groove
from parts.drawing.working import PartDrawing, Size, Subject
from parts.pages.data_table import DataRow, DataTable, Mated, distance_rows, grade_rows, rows_of, with_limits
from parts.pages.inputs import SceneKeys, given

_GAP = ("seating_radius", "seating_angle_deg", "chain_flank_radius", "gap_radius", "joining_radius", "head_radius",
        "half_gap_angle_deg", "joining_angle_deg", "straight_flank", "gap_displacement")  # fmt: skip
_CHAIN = ("chain_pitch", "chain_roller_diameter", "chain_strands")
_MEASURED = ("sprocket_over_pins", "root_chord")
_CIRCLES = ("chain_pitch_diameter", "chain_root_diameter")
# of the chain, for information: between and beside its plates the teeth go
_PLATES = ("chain_plate_height", "chain_inner_width")


def part_drawing(subject: Subject) -> PartDrawing:
    """Section with the rows of teeth, the exact face, the bore."""
    keys, sprocket = subject.part.keys, subject.part.thing
    assert isinstance(keys, SprocketSpec)
    shape, circles = SPROCKET.shape(keys, sprocket), ("tip_diameter", "pitch_diameter", "root_diameter")
    pitch, width, core = sprocket.chain.transverse_pitch, sprocket.face_width, sprocket.core_radius
    grooves = tuple(Groove(k * pitch + width, (k + 1) * pitch, core) for k in range(sprocket.strands - 1))
    bevel = (sprocket.tip_radius - sprocket.bevel_radius, sprocket.bevel) if sprocket.bevel else None
    made = disk_drawing(
        subject, shape, sprocket.holes, "zero_tooth", circles, keys.number_of_teeth, grooves=grooves, bevel=bevel
    )  # fmt: skip
    section, *others = made.views
    if bevel is not None:
        ends = complex(0.0, sprocket.bevel_radius), complex(bevel[1], sprocket.tip_radius)
        section = section.plus(sizes=(Size("tooth_bevel", *ends, "above"), Size("tooth_bevel.depth", *ends, "left")))
    if not grooves:
        return replace(made, views=(section, *others))
    first = grooves[0]
    sizes = (
        *(replace(one, name="rows_width") if one.name == "face_width" else one for one in section.sizes),
        Size("tooth_row_width", 1j * sprocket.root_radius, complex(width, sprocket.root_radius), "above"),
        Size("transverse_pitch", 1j * sprocket.root_radius, complex(pitch, sprocket.root_radius), "above"),
        Size("core_diameter", complex(first.high, -core), complex(first.high, core), "right", "Ø"),
    )
    return replace(made, views=(replace(section, sizes=sizes), *others))


def data_table(part: Part, scene: SceneKeys, mates: Sequence[Mated]) -> DataTable:
    """The table of the teeth; ``mates``: the other sprocket of its drive."""
    keys = part.keys
    assert isinstance(keys, SprocketSpec)
    page = sprocket_page.sheet(given(keys))
    teeth, *chain = rows_of(page, ("number_of_teeth", *_CHAIN))
    form = DataRow(N_("profile of the teeth by"), "", standard_told(part.thing.form.standard))
    named = () if keys.chain is None else (DataRow(N_("chain"), "", keys.chain),)
    beside = distance_rows(mates, "a")
    others = [DataRow(N_("teeth of the other sprocket"), "z", mate.part.thing.number_of_teeth) for mate in mates]
    # seats that are deeper by a limit make both of what is measured less by it
    measured = [row for one in rows_of(page, _MEASURED) for row in with_limits([one], keys.accuracy)]
    return DataTable(
        (
            (teeth, *named, *chain, form, *rows_of(page, _GAP), *grade_rows(keys.accuracy)),
            tuple(measured),
            (*rows_of(page, _CIRCLES), *rows_of(page, _PLATES), *beside, *others),
        )
    )
