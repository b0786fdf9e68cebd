"""The working drawing of a bevel gear: in section, teeth not cut (GOST 2.402), and the table of its rim (2.405)."""

from __future__ import annotations

import math
from collections.abc import Sequence

from geometry.base.record import replace
from geometry.curves.line_arc import Line
from geometry.gears.bevel.gear import BevelGear
from geometry.solids.bores import RoundBore
from parts.base.part import Part
from parts.base.texts import N_, standard_told
from parts.drawing.directions import directions
from parts.drawing.revolved import Loop, below, closed, outlined, seen_edges
from parts.drawing.turned_sizes import Fits, turned_sizes
from parts.drawing.wheel_views import (
    Wheel,
    bore_note,
    bore_radii,
    circle_sizes,
    cut_holes,
    face_view,
    keyway_edges,
    spline_cut,
    spots,
    with_bore,
)
from parts.drawing.working import (
    AXIS,
    VISIBLE,
    Angle,
    PartDrawing,
    Size,
    Slant,
    Stroke,
    Subject,
    View,
    requirements,
)
from parts.gears.bevel_gear import page as bevel_page
from parts.gears.bevel_gear.part import BevelGearSpec
from parts.gears.data_tables import hand_row, mate_rows
from parts.keys.holes import holes_of
from parts.pages.data_table import DataRow, DataTable, Mated, grade_rows, own_rows, sexagesimal, with_limits
from parts.pages.inputs import SceneKeys, given

# the basic rack of GOST 13754-81, which the table then tells by its name: of modules from 1 mm on
_RACK = {"pressure_angle_deg": 20.0, "addendum_coefficient": 1.0, "tip_clearance_coefficient": 0.2,
         "tip_radius_coefficient": 0.2}  # fmt: skip
_TYPES = {"straight": N_("straight"), "skew": N_("skew"), "spiral": N_("spiral"), "zerol": N_("zerol")}
# what is measured
_CHORD, _NORMAL_CHORD = ("outer_chord_height", "outer_chord"), ("mean_normal_chord_height", "mean_normal_chord")
# sides of sizes across the axis
_ACROSS = ("left", "right")
_NONE = 1e-9


def part_drawing(subject: Subject) -> PartDrawing:
    """The gear in section, and its bore where that is not round."""
    keys, gear = subject.part.keys, subject.part.thing
    assert isinstance(keys, BevelGearSpec)
    holes, low, high = holes_of(keys), gear.blank.hub_length, gear.mounting_distance - gear.front.imag
    wheel = Wheel(gear.core_shape, holes, (_tips(gear)[0].imag,) * 2, None)
    axes = [Line(0j, complex(gear.mounting_distance))]
    up, down = bore_radii(holes.bore)
    strokes: list[Stroke] = []
    hatched: list[Loop] = []
    for way, bore in ((1, up), (-1, down)):
        tips: Loop = _half(gear, bore, _tips(gear))
        roots: Loop = _half(gear, bore, _along(gear, gear.root_angle))
        if way < 0:
            tips, roots = below(tips), below(roots)
        strokes += outlined(tips)
        lines = [Line(*_along(gear, angle)) for angle in (gear.root_angle, gear.pitch_angle)]
        root, pitch = (line if way > 0 else Line(line.start.conjugate(), line.end.conjugate()) for line in lines)
        strokes += [(VISIBLE, root), (AXIS, pitch)]
        edges = seen_edges(_half(gear, bore, _along(gear, gear.root_angle)), cut=True)
        strokes += [(VISIBLE, edge if way > 0 else edge.mirrored()) for edge in edges]
        hatched.append(tuple(roots))
        cut_holes(holes, wheel.turn, way, (low, high), (strokes, hatched, axes))
    spline = spline_cut(holes.bore, 0.0, high)
    strokes += [(VISIBLE, edge) for edge in (*keyway_edges(holes.bore, 0.0, high), *spline.roots)]
    hatched += spline.teeth
    axes += spline.axes
    wishes = subject.wishes
    is_round = holes.bore is None or isinstance(holes.bore, RoundBore)
    fits = Fits("", wishes.bore, wishes.tip)
    outer, inner = _tips(gear)
    # cones and the face width tell the inner tip, the inner root and where the back cone ends (GOST 2.405)
    half = _half(gear, up if is_round else 0.0, (outer,))
    by_cones = {round(2 * at.imag, 7) for at in (_place(gear, gear.rim), _place(gear, gear.front))}
    told = turned_sizes(half, fits, subject.language, listed=False).sizes
    sizes = [one for one in told if one.side not in _ACROSS or round(one.value, 7) not in by_cones]
    # on the right stands the angle of the tips
    sizes = [replace(one, side="left") if abs(one.value - 2 * outer.imag) < _NONE else one for one in sizes]
    # what the runouts are about
    sizes = [replace(one, name="bore_diameter") if one.name.startswith("inner_diameter") else one for one in sizes]
    sizes.append(Size("mounting_distance", 0j, complex(gear.mounting_distance), "below"))
    sizes += circle_sizes(holes, wheel.turn, low)
    middle = sum(_along(gear, gear.pitch_angle)) / 2
    notes = [subject.worked(middle)]
    if holes.bore is not None:
        notes.append(bore_note((0.0, high), -down, subject.rough(wishes.bore_roughness)))
    # of the back cone and of the tip cone, at the outer tip
    cones = (
        _cone_angle(outer, _place(gear, gear.rim), -1.0, 90.0 - math.degrees(gear.pitch_angle)),
        _cone_angle(outer, inner, 1.0, math.degrees(gear.tip_cone_angle)),
    )
    view = View(
        tuple(strokes), tuple(map(tuple, hatched)), tuple(axes), tuple(sizes), notes=tuple(notes),
        slants=(_face_width(gear),), angles=cones,
        rim=spots(outer, inner, 1j * (inner - outer)), face=spots(1j * _back(gear), 1j * up, -1 + 0j),
    )  # fmt: skip
    more = directions(holes, subject, "zero_tooth", keys.number_of_teeth)
    others = (face_view(wheel, subject),) if holes.round_holes else ()
    views = with_bore((view, *others), holes.bore, high, subject, wheel.turn if others else None)
    return PartDrawing(views, requirements(subject, *more))


def _place(gear: BevelGear, place: complex) -> complex:
    """Radius and distance from the apex as they are drawn: height and radius."""
    return complex(gear.mounting_distance - place.imag, place.real)


def _back(gear: BevelGear) -> float:
    """How far out the back face reaches, mm."""
    return gear.blank.hub_diameter / 2 if gear.blank.hub_length else _place(gear, gear.rim).imag


def _along(gear: BevelGear, angle: float) -> tuple[complex, complex]:
    """The outer and the inner end of a cone over the apex, as drawn."""
    return _place(gear, gear.outer(angle)), _place(gear, gear.inner(angle))


def _tips(gear: BevelGear) -> tuple[complex, complex]:
    """The same of the tip cone."""
    return _place(gear, gear.outer(gear.tip_angle)), _place(gear, gear.inner(gear.inner_tip_angle))


def _cone_angle(start: complex, end: complex, way: float, degrees: float) -> Angle:
    """Between a cone and a parallel of the axis, to the right (1) or to the left (-1)."""
    long = abs(end - start)
    return Angle(start, complex(way), (end - start) / long, sexagesimal(degrees), (0.0, long))


def _face_width(gear: BevelGear) -> Slant:
    """Along the pitch cone, below the axis."""
    (outer, inner), pitch = (
        tuple(p.conjugate() for p in ends) for ends in (_tips(gear), _along(gear, gear.pitch_angle))
    )
    way = (pitch[1] - pitch[0]) / abs(pitch[1] - pitch[0])
    return Slant("face_width", outer, inner, way, -1j * way)


def _half(gear: BevelGear, bore: float, ends: tuple[complex, ...]) -> tuple[Line, ...]:
    """Half the section up to a cone of the teeth with these ends, from the bore on the back face on."""
    blank, rim, front = gear.blank, _place(gear, gear.rim), _place(gear, gear.front)
    hub = [complex(0, blank.hub_diameter / 2), complex(blank.hub_length, blank.hub_diameter / 2)]
    points = [1j * bore, *(hub if blank.hub_length else []), rim, *ends, front, complex(front.real, bore)]
    return closed(points)


def data_table(part: Part, scene: SceneKeys, mates: Sequence[Mated]) -> DataTable:
    """The table of the rim; ``mates``: what meshes with it."""
    keys, gear = part.keys, part.thing
    assert isinstance(keys, BevelGearSpec)
    page = bevel_page.sheet(given(keys) | {"circumferential_thinning": gear.circumferential_thinning})

    def rows(*names: str) -> tuple[DataRow, ...]:
        return own_rows(page, names)

    straight = gear.is_straight
    standard = straight and keys.module >= 1 and all(getattr(keys, key) == value for key, value in _RACK.items())
    rack = (DataRow(N_("basic rack"), "", standard_told("GOST 13754-81")),) if standard else rows(*_RACK)
    first = (
        *rows("outer_module", "number_of_teeth"), DataRow(N_("type of tooth"), "", _TYPES[gear.tooth_type]),
        *rows("spiral_angle_deg"), *([] if straight else [hand_row(gear.hand)]), *rows("cutter_radius"),
        *rack,
        *rows("profile_shift_coefficient", "thickness_coefficient", "pitch_cone_angle_deg"),
        *grade_rows(keys.accuracy),
    )  # fmt: skip
    control = with_limits(rows(*(_CHORD if straight else _NORMAL_CHORD)), keys.accuracy)
    last = rows(
        "shaft_angle_deg", "mean_module", "mean_normal_module", "outer_cone_distance", "mean_cone_distance",
        "mean_pitch_diameter", "root_cone_angle_deg", "outer_depth",
    )  # fmt: skip
    beside = mate_rows(mates) or [DataRow(N_("teeth of the mate"), "z", keys.mate_number_of_teeth)]
    return DataTable((first, control, (*last, *beside)))
