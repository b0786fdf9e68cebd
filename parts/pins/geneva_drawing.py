"""The working drawings of Geneva wheels and of their drivers, whole or in pieces."""

from __future__ import annotations

import cmath
import math

from geometry.base.placement import Placement2
from geometry.base.record import replace
from geometry.curves.line_arc import Arc, Line
from geometry.gears.pins.geneva import GenevaWheel
from geometry.gears.pins.geneva_driver import GenevaDriver
from geometry.solids.hub_holes import HubHoles
from geometry.solids.wheel import WheelShape
from parts.drawing.directions import directions
from parts.drawing.disk_views import disk_drawing, ring_drawing
from parts.drawing.revolved import below, block, joined, outlined
from parts.drawing.wheel_views import (
    Wheel,
    circle_of,
    goes_on,
    section_view,
    wheel_views,
)
from parts.drawing.working import (
    AXIS,
    VISIBLE,
    PartDrawing,
    Round,
    Size,
    Subject,
    View,
    arc_angles,
    requirements,
)
from parts.keys.wheel import shape_of
from parts.pins.geneva_wheel import GenevaWheelSpec
from parts.texts.sheets import counted_words, sheet_words


def part_drawing(subject: Subject) -> PartDrawing:
    """The drawing of a wheel, a ring, a driver or a piece of one."""
    thing = subject.part.thing
    if isinstance(thing, GenevaWheel):
        assert isinstance(subject.part.keys, GenevaWheelSpec)
        drawn = _ring(thing, subject) if thing.drive.internal else _wheel(thing, subject.part.keys, subject)
        section, face, *others = drawn.views
        words = subject.words(
            "locking_arcs", radius=subject.say(thing.arc_radius), diameter=subject.say(2 * thing.drive.centre_distance)
        )
        return replace(
            drawn,
            views=(section, _with_slots(face, thing, subject.language), *others),
            requirements=(*drawn.requirements, words),
        )
    assert isinstance(thing, GenevaDriver)
    if thing.piece == "disc":
        holes = thing.holes if thing.has_bored_disc else HubHoles()
        drawn = disk_drawing(subject, WheelShape(thing.width), holes, "zero_pin")
        section, face, *others = drawn.views
        return replace(drawn, views=(section, _with_reliefs(face, thing), *others))
    return _crank(thing, subject)


def _wheel(wheel: GenevaWheel, keys: GenevaWheelSpec, subject: Subject) -> PartDrawing:
    slots = wheel.drive.number_of_slots
    return disk_drawing(subject, shape_of(keys), wheel.holes, "zero_slot", ("tip_diameter",), slots)


def _ring(wheel: GenevaWheel, subject: Subject) -> PartDrawing:
    """Cut through the end of a slot."""
    end, outer = wheel.slot_end + wheel.half_width, wheel.outer_radius
    strokes = [(VISIBLE, edge) for edge in wheel.outline()]
    radii, slots = (wheel.tip_radius, end, outer), wheel.drive.number_of_slots
    return ring_drawing(subject, radii, wheel.holes, {"tip_diameter": wheel.tip_radius}, strokes, "zero_slot", slots)


def _with_slots(face: View, wheel: GenevaWheel, language: str) -> View:
    """Width and end of a slot, a locking arc, the rounding of a tip."""
    half, sense = wheel.half_width, wheel.drive.sense
    way = cmath.rect(1.0, wheel.drive.half_slot_angle)
    towards = math.degrees(wheel.drive.half_slot_angle) + (180 if sense < 0 else 0)
    slots = wheel.drive.number_of_slots

    def round_(name: str, centre: complex, radius: float, angles: tuple[float, ...], count: int) -> Round:
        places = counted_words(language, "places_of", count)
        return Round(name, centre, radius, "R", is_radius=True, angles=angles, places=places)

    around = (towards, towards + 20, towards - 20)
    rounds = [round_("locking_arc", wheel.drive.centre_distance * way, wheel.arc_radius, around, slots)]
    corner = wheel.half_period()[2]
    if wheel.tip_rounding > 0 and isinstance(corner, Arc):
        rounds.append(round_("tip_rounding", corner.centre, corner.radius, arc_angles(corner), 2 * slots))
    mouth = wheel.drive.mouth_radius
    places = counted_words(language, "places_of", slots)
    width = Size("slot_width", complex(mouth, -half), complex(mouth, half), "right", places=places)
    end = Size("slot_end", 0j, complex(wheel.slot_end + sense * half), "below")
    return face.plus(sizes=(width, end), rounds=rounds)


def _with_reliefs(face: View, driver: GenevaDriver) -> View:
    """The disc's radius, a relief's, and where its bottom stands."""
    disc, middle = driver.disc, math.pi / driver.disc.number_of_pins
    rounds = [Round("locking_disc", 0j, disc.wheel.locking_radius, "R", is_radius=True,
                    angles=tuple(math.degrees(middle) + turn for turn in (0.0, 20.0, -20.0)))]  # fmt: skip
    relief = disc.relief()
    # where it meets the locking arc after it
    corner = complex(relief.point(relief.domain[1]))
    if isinstance(relief, Arc):
        rounds.append(Round("relief", relief.centre, relief.radius, "R", is_radius=True, angles=arc_angles(relief)))
    sizes = (
        Size("relief_apex", 0j, complex(disc.apex), "above"),
        Size("disc_corners", corner.conjugate(), corner, "right"),
    )
    return face.plus(sizes=sizes, rounds=rounds)


def _crank(driver: GenevaDriver, subject: Subject) -> PartDrawing:
    """The plate, with disc and pins upon it or with holes for pins; the disc's place is seen either way."""
    disc, thick, outer = driver.disc, driver.plate_thickness, driver.plate_radius
    is_whole = driver.piece == "whole"
    own = () if is_whole else (driver.seats,)
    holes = HubHoles(driver.holes.bore, (*own, *driver.holes.round_holes))
    section, face, *others = wheel_views(Wheel(WheelShape(thick), holes, (outer, outer), None, stands=False), subject)
    crank = disc.drive.crank_radius
    face = face.plus([*((VISIBLE, edge) for edge in disc.outline()), (AXIS, circle_of(crank))])
    if is_whole:
        pins = [(VISIBLE, circle_of(driver.pin_radius, centre)) for centre in disc.pin_centres()]
        count = disc.number_of_pins
        told = f"{sheet_words(subject.language, 'pins_of', count=count) if count > 1 else ''}Ø"
        one = Round("pin_diameter", complex(crank), driver.pin_radius, told, angles=(45.0, -45.0))
        size = Size("crank_radius", 0j, complex(crank), "below")
        section = _with_disc(section, driver, subject)
        face = _with_reliefs(face.plus(pins, sizes=[size], rounds=[one]), driver)
    words = requirements(subject, *directions(holes, subject, "zero_pin"))
    return PartDrawing((section, face, *others), words)


def _with_disc(section: View, driver: GenevaDriver, subject: Subject) -> View:
    """The section of the plate with what is of one piece with it: above the axis through pin 1."""
    disc, low = driver.disc, driver.plate_thickness
    ends = low + driver.width, low + driver.pin_length
    crank, pin = disc.drive.crank_radius, driver.pin_radius
    radius, apex = disc.wheel.locking_radius, disc.apex
    upright, even = Placement2(0.0, complex(low)), disc.number_of_pins % 2 == 0
    across = apex if even else radius
    pins: list[tuple[Line | Arc, ...]] = [block(low, ends[1], crank - pin, crank + pin)]
    # across of pin 1 stands another one where their number is even
    pins += [below(pins[0])] * even
    if driver.has_bored_disc:
        bored = HubHoles(driver.holes.bore)
        on_it = section_view(Wheel(WheelShape(driver.width), bored, (apex, across), None, stands=False), subject)
        strokes = [(layer, curve.placed(upright)) for layer, curve in on_it.strokes]
        hatched = [tuple(curve.placed(upright) for curve in loop) for loop in on_it.hatched]
        section = goes_on(section, driver.width)
    else:
        hatched = [] if even else [below(block(low, ends[0], -apex, radius))]
        strokes = [stroke for loop in hatched for stroke in outlined(loop)]
    strokes += [(VISIBLE, line) for loop in pins for line in loop]
    sizes = [Size("disc_height", complex(0.0, -across), complex(ends[0], -across), "below")]
    if ends[0] != ends[1]:
        sizes.append(Size("pin_height", complex(0.0, crank + pin), complex(ends[1], crank + pin), "above"))
    axes = Line(complex(0.0, crank), complex(ends[1], crank)), Line(0j, complex(max(ends)))
    runs = [subject.worked(complex(low + driver.pin_length / 2, crank + pin), free=1j),
            subject.worked(complex(low + driver.width / 2, -across), free=-1j)]  # fmt: skip
    return joined(section.plus(strokes, [*hatched, *pins], axes, sizes, notes=runs), low)
