"""The working drawing of a timing pulley and its table: the belt, the groove, the circles."""

from __future__ import annotations

from collections.abc import Sequence

from geometry.base.record import replace
from parts.base.part import Part
from parts.base.texts import N_
from parts.belts import page as pulley_page
from parts.belts.pulley import TIMING_PULLEY, TimingPulleySpec
from parts.drawing.disk_views import disk_drawing
from parts.drawing.wheel_views import Groove, circle_of
from parts.drawing.working import VISIBLE, PartDrawing, Size, Subject
from parts.pages.data_table import DataRow, DataTable, Mated, distance_rows, rows_of
from parts.pages.inputs import SceneKeys, given

_GROOVE = ("pulley_groove_depth", "groove_floor_width", "groove_corner_width", "groove_angle_deg",
           "greatest_root_radius", "groove_floor_radius", "groove_flank_radius", "flank_centre_offset",
           "groove_tip_radius")  # fmt: skip


def part_drawing(subject: Subject) -> PartDrawing:
    """Section with the flanges, the exact face, the bore."""
    keys, pulley = subject.part.keys, subject.part.thing
    assert isinstance(keys, TimingPulleySpec)
    shape, circles = TIMING_PULLEY.shape(keys, pulley), ("outer_diameter", "pitch_diameter", "root_diameter")
    flanges, low, high = pulley.flanges, pulley.low, pulley.low + pulley.toothed_width
    if flanges is None:
        return disk_drawing(subject, shape, pulley.holes, "zero_tooth", circles, keys.number_of_teeth)
    grooves = (Groove(low, high, pulley.outer_radius),)
    made = disk_drawing(
        subject, shape, pulley.holes, "zero_tooth", circles, keys.number_of_teeth, grooves=grooves, rim=pulley.reach
    )
    section, face, *others = made.views
    radius = pulley.reach
    edge = 0.0 if flanges.below else high
    sizes = (
        *(replace(one, name="pulley_width") if one.name == "face_width" else one for one in section.sizes),
        Size("toothed_width", complex(low, pulley.outer_radius), complex(high, pulley.outer_radius), "above"),
        Size("flanges.diameter", complex(edge, -radius), complex(edge, radius), "left", "Ø"),
    )
    # the sign of the teeth stands on them, not on the flanges
    teeth = complex((low + high) / 2, pulley.outer_radius)
    notes = tuple(replace(note, at=teeth) if note.at.imag == radius else note for note in section.notes)
    seen = face.plus([(VISIBLE, circle_of(radius))])
    return replace(made, views=(replace(section, sizes=sizes, notes=notes), seen, *others))


def data_table(part: Part, scene: SceneKeys, mates: Sequence[Mated]) -> DataTable:
    """The table of the teeth; ``mates``: the other pulley of its drive."""
    keys = part.keys
    assert isinstance(keys, TimingPulleySpec)
    page = pulley_page.sheet(given(keys))
    belt = (DataRow(N_("timing belt"), "", keys.belt),) if isinstance(keys.belt, str) else ()
    beside = distance_rows(mates, "a")
    others = [DataRow(N_("teeth of the other pulley"), "z", mate.part.thing.number_of_teeth) for mate in mates]
    return DataTable(
        (
            (*rows_of(page, ("number_of_teeth", "belt_pitch")), *belt, *rows_of(page, _GROOVE)),
            (),
            (*rows_of(page, ("belt_pitch_diameter", "pulley_root_diameter")), *beside, *others),
        )
    )
