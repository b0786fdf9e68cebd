"""The working drawings of ratchet wheels, external or rings."""

from __future__ import annotations

import cmath
import math

from geometry.base.record import replace
from geometry.curves.line_arc import Arc
from geometry.gears.ratchets.wheel import RatchetWheel
from parts.drawing.disk_views import disk_drawing, ring_drawing
from parts.drawing.wheel_views import circle_of
from parts.drawing.working import AXIS, VISIBLE, PartDrawing, Round, Size, Subject, View, arc_angles
from parts.keys.wheel import shape_of
from parts.ratchets.wheel import RatchetWheelSpec
from parts.texts.sheets import counted_words


def part_drawing(subject: Subject) -> PartDrawing:
    """The drawing of a wheel or a ring."""
    wheel, keys = subject.part.thing, subject.part.keys
    assert isinstance(wheel, RatchetWheel)
    assert isinstance(keys, RatchetWheelSpec)
    if wheel.internal:
        drawn = _ring(wheel, subject)
    else:
        circles = "tip_diameter", "root_diameter"
        drawn = disk_drawing(subject, shape_of(keys), wheel.holes, "zero_edge", circles, wheel.number_of_teeth)
    section, face, *others = drawn.views
    angles = {"front_angle": keys.front_angle_deg, "notch_angle": math.degrees(wheel.cut_angle)}
    words = subject.words("ratchet_angles", **{key: subject.say(value) for key, value in angles.items()})
    views = section, _with_teeth(face, wheel, subject.language), *others
    turns = subject.words(f"ratchet_{keys.turns}")
    return replace(drawn, views=views, requirements=(*drawn.requirements, words, turns))


def _ring(wheel: RatchetWheel, subject: Subject) -> PartDrawing:
    """Cut through the edge of a tooth."""
    radii = wheel.tip_radius, wheel.root_radius, wheel.outer_radius
    strokes = [*((VISIBLE, edge) for edge in wheel.outline()), (AXIS, circle_of(wheel.root_radius))]
    told = {"tip_diameter": wheel.tip_radius, "root": wheel.root_radius}
    return ring_drawing(subject, radii, wheel.holes, told, strokes, "zero_edge", wheel.number_of_teeth)


def _with_teeth(face: View, wheel: RatchetWheel, language: str) -> View:
    """How far the land of tooth 1 rises over its edge, and the rounding of a root."""
    places = counted_words(language, "places_of", wheel.number_of_teeth)
    start, end = complex(wheel.tip_radius), cmath.rect(wheel.tip_radius, wheel.land_angle)
    if not wheel.ccw:
        start, end = end.conjugate(), start
    face = face.plus(sizes=[Size("tip_land", start, end, "right", places=places)])
    # of a root with an arc between both roundings, that of the working face
    roundings = (e for e in wheel.outline() if isinstance(e, Arc) and e.centre != 0)
    one = min(roundings, key=lambda arc: abs(abs(cmath.phase(arc.centre)) - wheel.pitch_angle), default=None)
    if one is None:
        return face
    told = Round("root_fillet", one.centre, one.radius, "R", is_radius=True, angles=arc_angles(one), places=places)
    return face.plus(rounds=[told])
