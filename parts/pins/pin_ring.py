"""The part kind ``pin_ring``: the ring or plate that holds the pins of a cycloidal reducer."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.solids.hub_holes import least_wall
from parts.base.kind import Others, Report
from parts.gears.ring_gear.part import RimHolesTable
from parts.keys.base import MOST_LENGTH, MadeKeys, mm, part_mm
from parts.keys.holes import hub_holes, with_remedy
from parts.keys.pins import MARGIN, PinCircle, PinCount, PinDiameter, RoundPinKind, least_of, most_of

if TYPE_CHECKING:
    from geometry.solids.pin_ring import PinRing


_INNER_DIAMETER = part_mm(
    "inside of the ring; default: the pin circle, or what clears a disc (holes: free)",
    least=0,
    example=83.0,
)
_OUTER_DIAMETER = mm(
    "outside; default: pin circle + 3 pins, or beyond the holes", above=0, most=2 * MOST_LENGTH, example=110.0
)
_PINS = Meta(description="seats for loose pins, pins of one piece with the ring, or a plate with holes for them")


class PinRingSpec(MadeKeys, kw_only=True, tag_field="kind", tag="pin_ring"):
    """Keys of ``pin_ring``."""

    number_of_pins: PinCount
    pin_circle_diameter: PinCircle
    pin_diameter: PinDiameter
    pins: Annotated[Literal["half_round", "fixed", "holes"], _PINS] = "half_round"
    seat_clearance: Annotated[float, mm("radius of a seat or hole beyond the pin's", least=-10, most=100)] = 0.0
    inner_diameter: Annotated[float, _INNER_DIAMETER] | None = None
    outer_diameter: Annotated[float, _OUTER_DIAMETER] | None = None
    holes: RimHolesTable | list[RimHolesTable] | None = None


class PinRingKind(RoundPinKind[PinRingSpec, "PinRing"]):
    """A ring with its pins."""

    name, keys = "pin_ring", PinRingSpec

    def thing(self, keys: PinRingSpec, others: Others) -> PinRing:
        """The ring, checked to hold its pins and to leave a rim; a refusal names the key that alone can cure it."""
        try:
            return _whole(keys)
        except ParameterError as refusal:
            raise with_remedy(refusal, keys, lambda changed: _whole(changed) is not None) from refusal

    def report(self, keys: PinRingSpec, thing: PinRing) -> Report:
        """Its pins and its inside."""
        circles = {"pin_circle_diameter": keys.pin_circle_diameter}
        if thing.inner_radius > 0:
            circles["inner_diameter"] = 2 * thing.inner_radius
        quantities = {"number_of_pins": float(thing.number_of_pins), "pin_diameter": keys.pin_diameter}
        return Report(circles=circles, quantities=quantities)


def _whole(keys: PinRingSpec) -> PinRing:
    ring = _ring_of(keys)
    least = least_wall(ring.pin_circle_radius) * (1 + MARGIN)
    _check_pins(keys, ring, least)
    _check_inside(keys, ring, least)
    inner = ring.rim_radius + least
    for key, group in ring.holes.groups():
        group.check(key)
    for key, group in ring.holes.groups():
        circle = group.pitch_circle_diameter
        if (circle - group.diameter) / 2 < inner:
            wide = least_of(2 * inner + group.diameter, circle)
            raise ParameterError(f"{key}.pitch_circle_diameter", circle, "holes_reach_pins", wide)
    ring.holes.check(max(ring.outer_radius, ring.holes.reach * 2 + least))
    needed = max(ring.rim_radius, *(g.reach for g in ring.holes.round_holes), 0.0) + least
    if ring.outer_radius < needed:
        wide = least_of(2 * needed, 2 * ring.outer_radius)
        raise ParameterError("outer_diameter", keys.outer_diameter, "leaves_no_rim", wide)
    return ring


def _ring_of(keys: PinRingSpec) -> PinRing:
    from geometry.solids.pin_ring import PinRing

    circle_radius, pin = keys.pin_circle_diameter / 2, keys.pin_diameter / 2
    inner = circle_radius
    if keys.inner_diameter is not None:
        inner = keys.inner_diameter / 2
    elif keys.pins == "holes":
        # a wall of half a pin inside the holes
        inner = max(circle_radius - pin - max(keys.seat_clearance, 0.0) - pin, 0.0)
    holes = hub_holes(None, keys.holes, None)
    outer = circle_radius + 3 * pin + max(keys.seat_clearance, 0.0)
    outer = max(outer, *(group.reach + pin for group in holes.round_holes), inner + pin, 0.0)
    if keys.outer_diameter is not None:
        outer = keys.outer_diameter / 2
    seat = pin + keys.seat_clearance
    return PinRing(keys.number_of_pins, circle_radius, pin, seat, inner, outer, keys.pins, holes, keys.face_width)


def _check_pins(keys: PinRingSpec, ring: PinRing, least: float) -> None:
    """Seats beside each other on their circle."""
    clearance = keys.seat_clearance
    if keys.pins == "fixed" and clearance != 0:
        raise ParameterError("seat_clearance", clearance, "fixed_pins_have_no_seats", Nearest(0.0))
    chord = ring.pin_circle_radius * math.sin(math.pi / ring.number_of_pins)
    room = chord - least / 2
    if ring.pin_radius > room:
        most = most_of(2 * room, keys.pin_diameter)
        raise ParameterError(
            "pin_diameter",
            keys.pin_diameter,
            "pins_touch",
            most,
            pins=ring.number_of_pins,
            circle=keys.pin_circle_diameter,
        )
    if max(ring.seat_radius, ring.pin_radius) > room:
        raise ParameterError("seat_clearance", clearance, "seats_touch", most_of(room - ring.pin_radius, clearance))
    if ring.seat_radius < ring.pin_radius / 2:
        raise ParameterError("seat_clearance", clearance, "leaves_no_seat", limit(-ring.pin_radius / 2, clearance))


def _check_inside(keys: PinRingSpec, ring: PinRing, least: float) -> None:
    """The inner diameter leaves the pins their hold."""
    value = 2 * ring.inner_radius
    if keys.pins == "holes":
        most = ring.pin_circle_radius - ring.seat_radius - least
        if ring.inner_radius > max(most, 0.0):
            raise ParameterError("inner_diameter", value, "inside_reaches_pin_holes", most_of(2 * most, value))
        return
    low, high = ring.inner_limits
    if ring.inner_radius > high:
        raise ParameterError("inner_diameter", value, "inside_beyond_pins", most_of(2 * high, value))
    if ring.inner_radius < low:
        raise ParameterError("inner_diameter", value, "inside_buries_pins", least_of(2 * low, value))
