"""The working drawing of a face gear: in section, teeth not cut (GOST 2.402), and the table of its rim."""

from __future__ import annotations

from collections.abc import Sequence

from geometry.base.record import replace
from geometry.curves.line_arc import Line
from parts.base.part import Part
from parts.base.texts import N_
from parts.drawing.directions import directions
from parts.drawing.revolved import Loop, below, closed, outlined
from parts.drawing.wheel_views import Wheel, circle_of, wheel_views
from parts.drawing.working import AXIS, VISIBLE, PartDrawing, Size, Subject, requirements
from parts.gears.data_tables import mate_rows
from parts.gears.face_gear import page as face_page
from parts.gears.face_gear.part import FaceGearSpec
from parts.pages.data_table import DataRow, DataTable, Mated, rows_of
from parts.pages.inputs import SceneKeys, given

# sizes of the plate by those of a disk
_NAMES = {"tip_diameter": "outer_diameter", "face_width": "plate_thickness"}


def part_drawing(subject: Subject) -> PartDrawing:
    """The plate in section with its teeth; its face where there are holes, and its bore where that is not round."""
    keys, gear = subject.part.keys, subject.part.thing
    assert isinstance(keys, FaceGearSpec)
    holes, outer, inner = gear.holes, gear.outer_radius, gear.inner_radius
    wheel = Wheel(gear.shape, holes, (outer, outer), None)
    section, *others = wheel_views(wheel, subject)
    if holes.round_holes or holes.spokes:
        others[0] = replace(others[0], strokes=(*others[0].strokes, (VISIBLE, circle_of(inner))))
    else:
        # its face is circles
        others = others[1:]
    pitch = gear.mounting_distance - gear.cutter.reference_radius
    teeth: Loop = closed([complex(x, r) for x, r in (
        (gear.thickness, inner), (gear.height, inner), (gear.height, outer), (gear.thickness, outer))])  # fmt: skip
    strokes = [*section.strokes, *outlined(teeth), *outlined(below(teeth))]
    strokes += [(AXIS, Line(complex(pitch, way * inner), complex(pitch, way * outer))) for way in (1, -1)]
    sizes = [replace(one, name=_NAMES.get(one.name, one.name)) for one in section.sizes]
    sizes += [
        Size("inner_diameter", complex(gear.height, -inner), complex(gear.height, inner), "right", "Ø"),
        Size("height", -1j * outer, complex(gear.height, -outer), "below"),
        Size("mounting_distance", 0j, complex(gear.mounting_distance), "below"),
    ]
    rough = subject.worked(complex(pitch, (inner + outer) / 2))
    axis = Line(complex(min(gear.shape.levels.hub[0], 0.0)), complex(gear.mounting_distance))
    view = replace(
        section, strokes=tuple(strokes), axes=(axis, *section.axes[1:]), sizes=tuple(sizes),
        notes=(rough, *section.notes),
    )  # fmt: skip
    more = directions(holes, subject, "zero_tooth", keys.number_of_teeth)
    return PartDrawing((view, *others), requirements(subject, *more))


def data_table(part: Part, scene: SceneKeys, mates: Sequence[Mated]) -> DataTable:
    """The table of the rim; ``mates``: what meshes with it."""
    keys, gear = part.keys, part.thing
    assert isinstance(keys, FaceGearSpec)
    page = face_page.sheet(given(keys) | {"circumferential_thinning": gear.circumferential_thinning})
    first = rows_of(page, ("module", "pressure_angle_deg", "addendum_coefficient", "dedendum_coefficient"))
    teeth = DataRow(N_("number of teeth of the face gear"), "z", keys.number_of_teeth)
    control = rows_of(page, ("face_tooth_depth",))
    last = rows_of(page, ("circumferential_thinning", "cutter_teeth", "undercut_diameter", "pointed_diameter"))
    pinion = DataRow(N_("teeth of the mate"), "z", keys.pinion_number_of_teeth)
    # its teeth, which all mates have, stand before its shift
    beside = pinion, *rows_of(page, ("profile_shift_coefficient",)), *mate_rows(mates)[1:]
    return DataTable(((first[0], teeth, *first[1:]), control, (*last, *beside)))
