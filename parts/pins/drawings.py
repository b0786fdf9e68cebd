"""The working drawings of what has round pins or runs on them: discs, lanterns and their gears, rings, plates, pins."""

from __future__ import annotations

import math

from geometry.base.errors import ParameterError
from geometry.base.placement import Placement2
from geometry.base.record import replace
from geometry.curves.line_arc import Line
from geometry.solids.bores import RoundBore
from geometry.solids.hub_holes import HubHoles
from geometry.solids.pin_plates import PinPlate, RoundDisc
from geometry.solids.pin_ring import PinRing
from geometry.solids.wheel import WheelShape
from parts.drawing.directions import directions
from parts.drawing.disk_views import disk_drawing
from parts.drawing.revolved import below, block, joined, outlined
from parts.drawing.wheel_views import (
    Wheel,
    axis_cross,
    circle_of,
    goes_on,
    hole_round,
    ring_face,
    ring_section,
    wheel_views,
)
from parts.drawing.working import (
    AXIS,
    VISIBLE,
    PartDrawing,
    Round,
    Size,
    Stroke,
    Subject,
    View,
    requirements,
)
from parts.keys.pins import most_of
from parts.keys.wheel import shape_of
from parts.pins.cycloidal_disc import CycloidalDiscSpec
from parts.pins.lantern_gear import LanternGearSpec
from parts.pins.pin import EccentricSpec, PinSpec
from parts.pins.pin_plate import LanternWheelSpec, OutputPlateSpec
from parts.pins.pin_ring import PinRingSpec

# mm in which two radii are one
_SAME = 1e-9


def part_drawing(subject: Subject) -> PartDrawing:
    """The drawing of any part with round pins, or that runs on them."""
    thing = subject.part.thing
    match subject.part.keys:
        case CycloidalDiscSpec() as keys:
            shape = shape_of(keys)
            return disk_drawing(subject, shape, thing.holes, "zero_lobe", ("tip_diameter", "root_diameter"))
        case LanternGearSpec() as keys:
            shape, teeth = shape_of(keys), keys.number_of_teeth
            circles = "tip_diameter", "pitch_diameter", "root_diameter"
            return disk_drawing(subject, shape, thing.holes, "zero_tooth", circles, teeth)
        case OutputPlateSpec() | LanternWheelSpec():
            views = _plates(thing, subject)
            return _told(views, HubHoles(thing.holes.bore, (thing.pins, *thing.holes.round_holes)), subject)
        case PinRingSpec():
            own = replace(thing.pin_holes, diameter=2 * thing.pin_radius)
            return _told(_ring(thing, subject), HubHoles(None, (own, *thing.holes.round_holes)), subject)
        case EccentricSpec():
            return _eccentric(thing, subject)
        case PinSpec() as keys:
            return _told(_pin(keys, thing, subject), HubHoles(), subject)
        case keys:
            raise TypeError(type(keys))


def _told(views: tuple[View, ...], holes: HubHoles, subject: Subject) -> PartDrawing:
    """Views of a round body, with the words on the directions of what is in it."""
    return PartDrawing(views, requirements(subject, *directions(holes, subject, "")))


def _plates(made: PinPlate, subject: Subject) -> tuple[View, ...]:
    """A plate with holes for its pins, or with pins that are of one piece with it; of a lantern both plates."""
    own = () if made.solid else (made.seats,)
    holes = HubHoles(made.holes.bore, (*own, *made.holes.round_holes), made.holes.spokes)
    outer, thick = made.outer_radius, made.thickness
    section, face, *others = wheel_views(Wheel(WheelShape(thick), holes, (outer, outer), None), subject)
    if not made.solid:
        return section, face, *others
    circle, radius, end = made.pins.pitch_circle_diameter / 2, made.pin_radius, thick + made.length
    pin = block(thick, end, circle - radius, circle + radius)
    pins = [pin, below(pin)]
    sizes = [
        Size("pin_length", complex(thick, -circle - radius), complex(end, -circle - radius), "below"),
        Size("pin_circle_diameter", complex(end, -circle), complex(end, circle), "right", "Ø"),
    ]
    strokes, hatched, length, faces = list[Stroke](), list(pins), end, [thick]
    if isinstance(subject.part.keys, LanternWheelSpec):
        other, length, faces = Placement2(0.0, complex(end)), end + thick, [thick, end]
        section = goes_on(section, end)
        strokes += [(layer, curve.placed(other)) for layer, curve in section.strokes]
        hatched += [tuple(curve.placed(other) for curve in loop) for loop in section.hatched]
        sizes.append(Size("width", -1j * outer, complex(length, -outer), "below"))
    strokes += [(VISIBLE, line) for bar in pins for line in bar]
    longer = tuple(Line(a.start, complex(max(a.end.real, length), a.end.imag)) for a in section.axes)
    axes = [Line(complex(0.0, way * circle), complex(length, way * circle)) for way in (1, -1)]
    runs = subject.worked(complex(thick + made.length / 2, circle + radius), free=1j)
    section = replace(section, axes=longer).plus(strokes, hatched, axes, sizes, notes=[runs])
    return joined(section, *faces), _with_pins(face, made, subject), *others


def _with_pins(face: View, made: PinPlate, subject: Subject) -> View:
    """The face of a plate with the pins that stand on it."""
    bore = made.holes.bore
    turn = 0.0 if bore is None or isinstance(bore, RoundBore) else math.pi / 2 - bore.angle
    centres = [centre * complex(math.cos(turn), math.sin(turn)) for centre in made.pins.centres()]
    strokes: list[Stroke] = [(VISIBLE, circle_of(made.pin_radius, centre)) for centre in centres]
    strokes.append((AXIS, circle_of(made.pins.pitch_circle_diameter / 2)))
    told = hole_round("pin_diameter", centres, made.pin_radius, subject, "pins_of")
    axes = [Line(c * (1 - made.pin_radius / abs(c)), c * (1 + made.pin_radius / abs(c))) for c in centres]
    return face.plus(strokes, axes=axes, rounds=[told])


def _ring(ring: PinRing, subject: Subject) -> tuple[View, ...]:
    """A ring with holes for pins, with half round seats, or with pins of one piece: cut through one of them."""
    inner, outer, width = ring.inner_radius, ring.outer_radius, ring.face_width
    if ring.pins == "holes":
        bore = RoundBore(2 * inner) if inner > 0 else None
        holes = HubHoles(bore, (ring.pin_holes, *ring.holes.round_holes))
        return wheel_views(Wheel(WheelShape(width), holes, (outer, outer), None), subject)
    circle, is_seat = ring.pin_circle_radius, ring.pins == "half_round"
    radius = ring.seat_radius if is_seat else ring.pin_radius
    # where the material begins in the plane of the section: beyond a seat, or at the foot of a pin
    begins = circle + radius if is_seat else circle - radius
    section = ring_section(WheelShape(width), (inner, begins, outer), ring.holes, subject)
    sizes, axes = [Size("inner_diameter", complex(width, -inner), complex(width, inner), "right", "Ø")], list[Line]()
    # seats about the edge itself have no other circle
    if abs(inner - circle) > _SAME:
        sizes.append(Size("pin_circle_diameter", -1j * circle, 1j * circle, "left", "Ø"))
        axes = [Line(complex(0.0, way * circle), complex(width, way * circle)) for way in (1, -1)]
    runs = subject.worked(complex(width / 2, -begins), free=1j)
    section = replace(section, notes=(runs,)).plus(axes=axes, sizes=sizes)
    seats = ring.region(0.0).holes[0]
    centres = ring.pin_centres()
    words = subject.words("seats_of" if is_seat else "pins_of", count=len(centres))
    best = max(centres, key=lambda c: c.real + c.imag)
    way = math.degrees(math.atan2(best.imag, best.real))
    angles = tuple(way + turn for turn in (0.0, 30.0, -30.0, 60.0, -60.0))
    told = Round("pins", best, radius, words + ("R" if is_seat else "Ø"), is_radius=is_seat, angles=angles)
    face = ring_face(outer, ring.holes, subject)
    strokes = [*((VISIBLE, s.curve) for s in seats.segments()), (AXIS, circle_of(circle))]
    return section, replace(face, rounds=(told, *face.rounds)).plus(strokes)


def _eccentric(disc: RoundDisc, subject: Subject) -> PartDrawing:
    """A round disc whose bore stands off its middle."""
    keys = subject.part.keys
    assert isinstance(keys, EccentricSpec)
    middle, radius = complex(disc.eccentricity), disc.radius
    if disc.eccentricity >= radius:
        # the section is that in which its axis lies
        raise ParameterError(
            "eccentricity", disc.eccentricity, "axis_leaves_section", most_of(radius, disc.eccentricity)
        )
    made = disk_drawing(subject, WheelShape(keys.face_width), disc.holes, "zero_thick")
    if not disc.eccentricity:
        return made
    section, face, *others = made.views
    size = Size("eccentricity", 0j, middle, "below")
    told = Round("diameter", middle, radius, angles=(45.0, 60.0, 30.0, 135.0))
    axes = [*axis_cross(radius), Line(middle - 1.05j * radius, middle + 1.05j * radius)]
    face = replace(face, axes=tuple(axes), rounds=(told, *face.rounds)).plus(sizes=[size])
    return replace(made, views=(section, face, *others))


def _pin(keys: PinSpec, disc: RoundDisc, subject: Subject) -> tuple[View, ...]:
    """A pin from outside, one with a bore in section."""
    radius, length = disc.radius, keys.length
    if disc.holes.bore is not None:
        return wheel_views(Wheel(WheelShape(length), disc.holes, (radius, radius), None, runs=True), subject)[:1]
    side = block(0.0, length, 0.0, radius)
    strokes = [*outlined(side), *outlined(below(side))]
    sizes = (
        Size("diameter", -1j * radius, 1j * radius, "left", "Ø", subject.wishes.shaft),
        Size("length", -1j * radius, complex(length, -radius), "below"),
    )
    runs = subject.worked(complex(0.7 * length, radius), free=1j)
    return (View(tuple(strokes), (), (Line(0j, complex(length)),), sizes, notes=(runs,)),)
