"""The working drawings of ratchet wheels, external or rings."""

from __future__ import annotations

import cmath
import math

from geometry.base.placement import Placement2
from geometry.base.record import replace
from geometry.gears.ratchets.wheel import RatchetWheel
from parts.drawing.directions import directions
from parts.drawing.disk_views import disk_drawing
from parts.drawing.wheel_views import ring_face, ring_section
from parts.drawing.working import VISIBLE, Note, PartDrawing, Round, Size, Subject, View, requirements
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
    return replace(drawn, views=views, requirements=(*drawn.requirements, words))


def _ring(wheel: RatchetWheel, subject: Subject) -> PartDrawing:
    """Cut through the edge of a tooth."""
    outer, width = wheel.outer_radius, subject.part.face_width
    section = ring_section(width, (wheel.tip_radius, wheel.root_radius, outer), wheel.holes, subject)
    rough = subject.rough(subject.wishes.flank_roughness)
    section = section.plus(notes=[Note(complex(width / 2, -wheel.root_radius), rough, is_rough=True, free=1j)])
    face = ring_face(outer, wheel.holes, subject)
    told = [
        Round(name, 0j, radius, angles=(-60.0, -120.0, -30.0, 210.0))
        for name, radius in (("tip_diameter", wheel.tip_radius), ("root", wheel.root_radius))
    ]
    face = replace(face, rounds=(*told, *face.rounds)).plus((VISIBLE, edge) for edge in wheel.outline())
    teeth = wheel.number_of_teeth
    return PartDrawing((section, face), requirements(subject, *directions(wheel.holes, subject, "zero_edge", teeth)))


def _with_teeth(face: View, wheel: RatchetWheel, language: str) -> View:
    """The land of tooth 1 and the rounding of a root."""
    teeth, turn = wheel.number_of_teeth, Placement2(wheel.pitch_angle)
    places = counted_words(language, "places_of", teeth)
    start, end = complex(wheel.tip_radius), cmath.rect(wheel.tip_radius, wheel.land_angle)
    centre = turn.apply(wheel.notch.last)
    if not wheel.ccw:
        start, end, centre = end.conjugate(), start, centre.conjugate()
    face = face.plus(sizes=[Size("tip_land_chord", start, end, "right", places=places)])
    if wheel.fillet_radius == 0:
        return face
    angles = tuple(180.0 + turned for turned in (0.0, 30.0, -30.0))
    told = Round("root_fillet", centre, wheel.fillet_radius, "R", is_radius=True, angles=angles, places=places)
    return face.plus(rounds=[told])
