"""The working drawing of a carrier's plate: pins and spacers on circles about its axis, radii of its arms."""

from __future__ import annotations

import math

from geometry.solids.hub_holes import HubHoles
from geometry.solids.windows import RoundHoles
from parts.bodies import plate_drawing
from parts.bodies.carrier import CarrierPlate
from parts.drawing.directions import directions
from parts.drawing.working import PartDrawing, Subject

# rad that are none
_SAME = 1e-9


def part_drawing(subject: Subject) -> PartDrawing:
    """One view with the circles of pins and spacers; words on directions that no view of equal steps tells."""
    thing = subject.part.thing
    assert isinstance(thing, CarrierPlate)
    equal, more = list[RoundHoles](), list[str]()
    for one in thing.circles:
        step = math.tau / len(one.angles)
        steps = (angle - one.angles[0] - k * step for k, angle in enumerate(one.angles))
        if all(abs(math.remainder(turn, math.tau)) < _SAME for turn in steps):
            equal.append(RoundHoles(len(one.angles), one.diameter, one.circle, one.angles[0]))
            continue
        angles = ", ".join(f"{subject.say(math.degrees(angle))}°" for angle in one.angles)
        zero = subject.words("zero_x")
        more.append(subject.words("holes_each", size=subject.say(one.diameter), angles=angles, zero=zero))
    told = directions(HubHoles(None, tuple(equal)), subject, "zero_x", all_circled=True)
    return plate_drawing.part_drawing(subject, (), thing.circles, *told, *more)
