"""The working drawing of a face gear: in section, teeth not cut (GOST 2.402), and the table of its rim."""

from __future__ import annotations

from collections.abc import Sequence

from geometry.base.record import replace
from geometry.curves.line_arc import Line
from geometry.gears.face.gear import FaceGear
from geometry.solids.bores import RoundBore
from parts.base.part import Part
from parts.base.texts import N_, Message
from parts.drawing.directions import directions
from parts.drawing.revolved import Loop, below, closed, outlined, seen_edges
from parts.drawing.turned_sizes import Fits, turned_sizes
from parts.drawing.wheel_views import bore_note, bore_radii, bore_view, keyway_edges, seen_along
from parts.drawing.working import AXIS, VISIBLE, Note, PartDrawing, Size, Stroke, Subject, View, requirements
from parts.gears.face_gear import page as face_page
from parts.gears.face_gear.part import FaceGearSpec
from parts.keys.holes import bore_of, hub_holes
from parts.pages.data_table import DataRow, DataTable, Mated, row_of
from parts.pages.inputs import SceneKeys, given
from parts.pages.page import Sheet

# mm, what is no difference
_NONE = 1e-9


def part_drawing(subject: Subject) -> PartDrawing:
    """The gear in section, and its bore where that is not round."""
    keys, gear = subject.part.keys, subject.part.thing
    assert isinstance(keys, FaceGearSpec)
    holes = hub_holes(bore_of(keys), None, None)
    up, down = bore_radii(holes.bore)
    strokes: list[Stroke] = []
    hatched = []
    pitch = gear.mounting_distance - gear.shaper.reference_radius
    for way, bore in ((1, up), (-1, down)):
        tips: Loop = _half(gear, bore)
        plate: Loop = closed([1j * bore, 1j * gear.outer_radius, complex(gear.thickness, gear.outer_radius),
                              complex(gear.thickness, bore)])  # fmt: skip
        edges = seen_edges(plate, cut=True)
        if way < 0:
            tips, plate = below(tips), below(plate)
        strokes += outlined(tips)
        root, middle = (
            Line(complex(x, way * gear.inner_radius), complex(x, way * gear.outer_radius))
            for x in (gear.thickness, pitch)
        )
        strokes += [(VISIBLE, root), (AXIS, middle)]
        strokes += [(VISIBLE, edge if way > 0 else edge.mirrored()) for edge in edges]
        hatched.append(tuple(plate))
    strokes += [(VISIBLE, edge) for edge in keyway_edges(holes.bore, 0.0, gear.thickness)]
    wishes = subject.wishes
    is_round = holes.bore is None or isinstance(holes.bore, RoundBore)
    fits = Fits("", wishes.bore, wishes.tip)
    # where the teeth begin is no bore
    sizes = [replace(one, after="") if abs(one.value - 2 * gear.inner_radius) < _NONE else one
             for one in turned_sizes(_half(gear, up if is_round else 0.0), fits, subject.language).sizes]  # fmt: skip
    sizes.append(Size("mounting_distance", 0j, complex(gear.mounting_distance), "below"))
    middle_radius = (gear.inner_radius + gear.outer_radius) / 2
    notes = [Note(complex(pitch, middle_radius), f"Ra {subject.say(wishes.flank_roughness)}", is_rough=True)]
    if holes.bore is not None:
        notes.append(bore_note((0.0, gear.thickness), -down, f"Ra {subject.say(wishes.bore_roughness)}"))
    axes = (Line(0j, complex(gear.mounting_distance)),)
    view = View(tuple(strokes), tuple(hatched), axes, tuple(sizes), notes=tuple(notes))
    more = directions(holes, subject, "zero_tooth", keys.number_of_teeth)
    if is_round:
        return PartDrawing((view,), requirements(subject, *more))
    assert holes.bore is not None
    seen = seen_along(view, gear.thickness, subject)
    return PartDrawing((seen, bore_view(holes.bore, subject)), requirements(subject, *more))


def _half(gear: FaceGear, bore: float) -> tuple[Line, ...]:
    """Half the section up to the tips: height and radius."""
    top, low = gear.height, gear.thickness
    return closed([
        1j * bore, 1j * gear.outer_radius, complex(top, gear.outer_radius), complex(top, gear.inner_radius),
        complex(low, gear.inner_radius), complex(low, bore),
    ])  # fmt: skip


def data_table(part: Part, scene: SceneKeys, mates: Sequence[Mated]) -> DataTable:
    """The table of the rim; ``mates``: what meshes with it."""
    keys, gear = part.keys, part.thing
    assert isinstance(keys, FaceGearSpec)
    page = face_page.sheet(given(keys) | {"circumferential_thinning": gear.circumferential_thinning})
    first = _rows(page, "module", "pressure_angle_deg", "addendum_coefficient", "dedendum_coefficient")
    teeth = DataRow(N_("number of teeth of the face gear"), "z", keys.number_of_teeth)
    control = _rows(page, "face_tooth_depth")
    last = _rows(page, "normal_backlash", "undercut_diameter", "pointed_diameter")
    beside = [DataRow(N_("teeth of the mate"), "z", keys.pinion_teeth), *_rows(page, "profile_shift_coefficient")]
    drawings = dict.fromkeys(getattr(m.part.keys, "designation", None) or m.part.title or m.part.id for m in mates)
    beside += [DataRow(N_("drawing of the mate"), "", Message("{name}", {"name": name})) for name in drawings]
    return DataTable(((first[0], teeth, *first[1:]), control, (*last, *beside)))


def _rows(page: Sheet, *names: str) -> tuple[DataRow, ...]:
    """The steps of these names."""
    return tuple(row_of(step) for name in names for step in page.steps() if step.name == name)
