"""The part kind ``pin_ring``: the ring or plate that holds the pins of a cycloidal reducer."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta, Struct

from geometry.errors import ParameterError, told
from geometry.hub_holes import HubHoles, least_wall
from geometry.windows import RoundHoles
from parts.hole_keys import hub_holes, with_remedy
from parts.keys import Colour, Density, FaceWidth, Material, mm
from parts.part import Part
from parts.ring_gear import RimHolesTable
from parts.round_keys import MOST, PinCircle, PinCount, PinDiameter, moved_section, round_part

if TYPE_CHECKING:
    from geometry.body import Body
    from geometry.pin_ring import PinRing

_MARGIN = 1e-6


class PinRingSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="pin_ring"):
    """Ring that holds pins on a circle, the first one on +x."""

    number_of_pins: PinCount
    pin_circle_diameter: PinCircle
    pin_diameter: PinDiameter
    pins: Annotated[
        Literal["half_round", "fixed", "holes"],
        Meta(description="seats for loose pins, pins of one piece with the ring, or a plate with holes for them"),
    ] = "half_round"
    seat_clearance: Annotated[float, mm("radius of a seat or hole beyond the pin's", least=-10, most=100)] = 0.0
    inner_diameter: (
        Annotated[float, mm("inside of the ring; default: the pin circle (holes: free of them)", least=0, most=MOST)]
        | None
    ) = None
    outer_diameter: (
        Annotated[float, mm("outside; default: pin circle + 3 pins, or beyond the holes", above=0, most=2 * MOST)]
        | None
    ) = None
    face_width: FaceWidth = 10.0
    holes: RimHolesTable | list[RimHolesTable] | None = None
    material: Material | None = None
    density: Density | None = None
    colour: Colour | None = None


def checked_pin_ring(spec: PinRingSpec) -> PinRing:
    """The ring of a part, checked to exist.

    Raises
    ------
    ParameterError
        Names the key and the nearest value that works.
    """
    ring = _ring_of(spec)
    least = least_wall(ring.pin_circle_radius) * (1 + _MARGIN)
    _check_pins(spec, ring, least)
    _check_inside(spec, ring, least)
    for key, group in _named(ring.holes):
        group.check(key)
    inner = ring.rim_radius + least
    for key, group in _named(ring.holes):
        below = (group.pitch_circle_diameter - group.diameter) / 2
        if below < inner:
            low = 2 * inner + group.diameter
            text = f"the holes reach the pins; at least {told(low * (1 + _MARGIN), up=True)} mm works"
            raise ParameterError(f"{key}.pitch_circle_diameter", group.pitch_circle_diameter, text)
    try:
        ring.holes.check(max(ring.outer_radius, ring.holes.reach * 2 + least))
    except ParameterError as refusal:
        raise with_remedy(refusal, spec, _builds) from refusal
    needed = max(ring.rim_radius, *(g.reach for g in ring.holes.round_holes), 0.0) + least
    if ring.outer_radius < needed:
        text = f"leaves no rim; at least {told(2 * needed * (1 + _MARGIN), up=True)} mm works"
        raise ParameterError("outer_diameter", spec.outer_diameter, text)
    return ring


def _named(holes: HubHoles) -> list[tuple[str, RoundHoles]]:
    """Groups of holes with the names of their tables."""
    lone = len(holes.round_holes) == 1
    return [("holes" if lone else f"holes.item {i + 1}", g) for i, g in enumerate(holes.round_holes)]


def _builds(spec: PinRingSpec) -> bool:
    try:
        checked_pin_ring(spec)
    except ParameterError:
        return False
    return True


def _ring_of(spec: PinRingSpec) -> PinRing:
    from geometry.pin_ring import PinRing

    circle_radius, pin = spec.pin_circle_diameter / 2, spec.pin_diameter / 2
    inner = circle_radius
    if spec.inner_diameter is not None:
        inner = spec.inner_diameter / 2
    elif spec.pins == "holes":
        # a wall of half a pin inside the holes
        inner = max(circle_radius - pin - max(spec.seat_clearance, 0.0) - pin, 0.0)
    holes = hub_holes(None, spec.holes, None)
    outer = circle_radius + 3 * pin + max(spec.seat_clearance, 0.0)
    outer = max(outer, *(group.reach + pin for group in holes.round_holes), inner + pin, 0.0)
    if spec.outer_diameter is not None:
        outer = spec.outer_diameter / 2
    seat = pin + spec.seat_clearance
    return PinRing(spec.number_of_pins, circle_radius, pin, seat, inner, outer, spec.pins, holes, spec.face_width)


def _check_pins(spec: PinRingSpec, ring: PinRing, least: float) -> None:
    """Seats beside each other on their circle."""
    if spec.pins == "fixed" and spec.seat_clearance != 0:
        raise ParameterError("seat_clearance", spec.seat_clearance, "pins of one piece have no seats; 0 works")
    chord = ring.pin_circle_radius * math.sin(math.pi / ring.number_of_pins)
    seat = max(ring.seat_radius, ring.pin_radius)
    room = chord - least / 2
    if ring.pin_radius > room:
        text = f"{ring.number_of_pins} pins touch each other; at most {told(2 * room * (1 - _MARGIN))} mm works"
        raise ParameterError("pin_diameter", spec.pin_diameter, text)
    if seat > room:
        text = f"the seats touch each other; at most {told((room - ring.pin_radius) * (1 - _MARGIN))} mm works"
        raise ParameterError("seat_clearance", spec.seat_clearance, text)
    if ring.seat_radius < ring.pin_radius / 2:
        text = f"leaves no seat; at least {told(-ring.pin_radius / 2, up=True)} mm works"
        raise ParameterError("seat_clearance", spec.seat_clearance, text)


def _check_inside(spec: PinRingSpec, ring: PinRing, least: float) -> None:
    """The inner diameter leaves the pins their hold."""
    value = 2 * ring.inner_radius
    if spec.pins == "holes":
        most = ring.pin_circle_radius - ring.seat_radius - least
        if ring.inner_radius > max(most, 0.0):
            works = f"at most {told(2 * most * (1 - _MARGIN))} mm works" if most > 0 else "0 works"
            raise ParameterError("inner_diameter", value, f"reaches the holes of the pins; {works}")
        return
    low, high = ring.seats.least_inner_radius(), ring.seats.greatest_inner_radius()
    room = 0.02 * (high - low)
    if ring.inner_radius > high - room:
        text = f"lies beyond the pins; at most {told(2 * (high - room) * (1 - _MARGIN))} mm works"
        raise ParameterError("inner_diameter", value, text)
    if ring.inner_radius < low + room:
        text = f"buries the pins; at least {told(2 * (low + room) * (1 + _MARGIN), up=True)} mm works"
        raise ParameterError("inner_diameter", value, text)


def pin_ring_part(part_id: str, spec: PinRingSpec, ring: PinRing) -> Part:
    """The part of a ring; sections are computed when an export asks."""
    from geometry.body import plate

    section = moved_section(ring.region)

    def body(offset: float) -> Body:
        return plate(section(offset).region, 0.0, spec.face_width)

    circles = {"pin_circle_diameter": spec.pin_circle_diameter}
    if ring.inner_radius > 0:
        circles["inner_diameter"] = 2 * ring.inner_radius
    return round_part(
        part_id,
        spec,
        section,
        body,
        face_width=spec.face_width,
        circles=circles,
        quantities={"number_of_pins": float(ring.number_of_pins), "pin_diameter": spec.pin_diameter},
    )
