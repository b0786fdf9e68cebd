"""The part kinds ``output_plate`` and ``lantern_wheel``: plates that carry round pins."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Literal, TypeVar

from msgspec import Meta
from msgspec.structs import replace

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.findings import Finding
from geometry.base.nearest import nearest
from geometry.base.tolerance import LEAST_LENGTH
from geometry.solids.hub_holes import HubHoles, least_wall
from geometry.solids.windows import RoundHoles
from parts.base.kind import Others, Report
from parts.keys.base import MOST_LENGTH, mm, part_mm
from parts.keys.holes import Direction, HoledKeys, holes_of
from parts.keys.pins import (
    MARGIN,
    PinCircle,
    PinDiameter,
    RoundPinKind,
    check_holes,
    least_of,
    most_of,
)

if TYPE_CHECKING:
    from geometry.solids.body import Body
    from geometry.solids.pin_plates import PinPlate

# of solid pins beyond the plate where no key says it, mm
_PIN_LENGTH = 10.0

_OUTER_DIAMETER = mm("outside; default: pin circle + 2 pins", above=0, most=2 * MOST_LENGTH, example=60.0)
_PINS = Meta(description="pins of one piece with the plate, or holes for loose pins (flat files: holes)")
_SEAT_CLEARANCE = mm("radius of a hole for a pin beyond the pin's (solid pins: of flat files)", least=-10, most=100)


class PinPlateKeys(HoledKeys, kw_only=True):
    """Keys of every plate with pins."""

    number_of_pins: int
    pin_circle_diameter: PinCircle
    pin_diameter: PinDiameter
    pins: Annotated[Literal["solid", "holes"], _PINS] = "solid"
    seat_clearance: Annotated[float, _SEAT_CLEARANCE] = 0.0
    outer_diameter: Annotated[float, _OUTER_DIAMETER] | None = None


_OUTPUT_PLATE_PIN_LENGTH = mm("how far solid pins stand out; default: 10", least=0.01, most=10_000, example=10.0)


class OutputPlateSpec(PinPlateKeys, kw_only=True, tag_field="kind", tag="output_plate"):
    """Keys of ``output_plate``."""

    number_of_pins: Annotated[int, Meta(ge=1, le=200, description="number of output pins", examples=[6])]
    pin_circle_diameter: Annotated[PinCircle, Meta(examples=[44.0])]
    pin_diameter: Annotated[PinDiameter, Meta(examples=[6.0])]
    pin_length: Annotated[float, _OUTPUT_PLATE_PIN_LENGTH] | None = None
    start_deg: Direction = 0.0


_LANTERN_WHEEL_OUTER_DIAMETER = mm(
    "outside of the plates; default: pin circle + 2 pins", above=0, most=2 * MOST_LENGTH, example=100.0
)
_PIN_CIRCLE_DIAMETER = part_mm("circle of the pins' centres: the pitch circle", least=0.1, example=80.0)


class LanternWheelSpec(PinPlateKeys, kw_only=True, tag_field="kind", tag="lantern_wheel"):
    """Keys of ``lantern_wheel``."""

    number_of_pins: Annotated[int, Meta(ge=3, le=1000, description="number of pins N", examples=[12])]
    pin_circle_diameter: Annotated[float, _PIN_CIRCLE_DIAMETER]
    face_width: Annotated[float, mm("free length of the pins between the plates", least=0.01, most=10_000)] = 10.0
    plate_thickness: Annotated[float, mm("thickness of each plate", least=0.01, most=10_000)] = 3.0
    outer_diameter: Annotated[float, _LANTERN_WHEEL_OUTER_DIAMETER] | None = None


K = TypeVar("K", bound=PinPlateKeys)


class _Plate(RoundPinKind[K, "PinPlate"]):
    """A plate with pins."""

    def middle(self, keys: K, thing: PinPlate) -> float:
        """Half of the plate."""
        return thing.thickness / 2

    def is_plate(self, keys: K, thing: PinPlate) -> bool:
        """Whether the pins are loose."""
        return not thing.solid

    def report(self, keys: K, thing: PinPlate) -> Report:
        """Its pins."""
        return Report(
            circles={"pin_circle_diameter": keys.pin_circle_diameter},
            quantities={"number_of_pins": float(keys.number_of_pins), "pin_diameter": keys.pin_diameter},
            flat_findings=(Finding("flat_pins", 0.0, 0.0),) if thing.solid else (),
        )


class OutputPlate(_Plate[OutputPlateSpec]):
    """Pins on one plate."""

    name, keys = "output_plate", OutputPlateSpec

    def thing(self, keys: OutputPlateSpec, others: Others) -> PinPlate:
        """The plate with its pins, checked to exist."""
        if keys.pins != "solid" and keys.pin_length is not None:
            raise ParameterError("pin_length", keys.pin_length, "only_of_solid_pins", Nearest(None))
        length = _PIN_LENGTH if keys.pin_length is None else keys.pin_length
        return _checked(keys, math.radians(keys.start_deg), keys.face_width, length)

    def solid(self, keys: OutputPlateSpec, thing: PinPlate, offset: float) -> Body:
        """The plate, its pins upright on it."""
        return thing.body(offset)

    def height(self, keys: OutputPlateSpec, thing: PinPlate) -> float:
        """Of plate and pins."""
        return thing.thickness + (thing.length if thing.solid else 0.0)


class LanternWheel(_Plate[LanternWheelSpec]):
    """Pins between two plates."""

    name, keys = "lantern_wheel", LanternWheelSpec

    def thing(self, keys: LanternWheelSpec, others: Others) -> PinPlate:
        """The plates with their pins, checked to exist."""
        return _checked(keys, 0.0, keys.plate_thickness, keys.face_width)

    def solid(self, keys: LanternWheelSpec, thing: PinPlate, offset: float) -> Body:
        """Both plates and the pins between them."""
        return thing.body(offset, between=True)

    def height(self, keys: LanternWheelSpec, thing: PinPlate) -> float:
        """Of both plates and the pins."""
        return thing.thickness * (2 if thing.solid else 1) + (thing.length if thing.solid else 0.0)


def _checked(keys: PinPlateKeys, start: float, thickness: float, length: float) -> PinPlate:
    """A plate whose pins stand beside each other, within its edge and off its holes; ``start`` in rad, sizes in mm."""
    from geometry.solids.pin_plates import PinPlate, pin_reach

    pins = RoundHoles(keys.number_of_pins, keys.pin_diameter, keys.pin_circle_diameter, start)
    holes = holes_of(keys)
    outer = _outer_radius(keys)
    made = PinPlate(pins, outer, holes, keys.pins == "solid", keys.seat_clearance, thickness, length)
    low, high = pin_reach(made)
    edge = high + least_wall(1.01 * high) * (1 + MARGIN)
    if outer < edge:
        least = least_of(2 * edge, 2 * outer)
        raise ParameterError("outer_diameter", keys.outer_diameter, "pins_reach_edge", least, diameter=2 * high)
    least_room = least_wall(outer) * (1 + MARGIN)
    _check_pins(keys, made)
    if holes.bore is not None and keys.bore_diameter > 0 and holes.bore_reach > low - least_room:
        most = most_of(2 * (low - least_room), keys.bore_diameter)
        raise ParameterError("bore_diameter", keys.bore_diameter, "bore_reaches_pins", most)
    own = RoundHoles(pins.count, 2 * (high - pins.pitch_circle_diameter / 2), pins.pitch_circle_diameter, start)
    every = HubHoles(holes.bore, (own, *holes.round_holes), holes.spokes)
    check_holes(keys, every, outer, own=1)
    return made


def _outer_radius(keys: PinPlateKeys) -> float:
    """Of the plate, by default half a pin beyond the pins, mm."""
    usual = keys.pin_circle_diameter / 2 + keys.pin_diameter + max(keys.seat_clearance, 0.0)
    return usual if keys.outer_diameter is None else keys.outer_diameter / 2


def _check_pins(keys: PinPlateKeys, made: PinPlate) -> None:
    """Pins and their holes beside each other."""
    seat, clearance = made.pin_radius + made.seat_clearance, keys.seat_clearance
    if seat < made.pin_radius / 2:
        raise ParameterError("seat_clearance", clearance, "leaves_no_hole", limit(-made.pin_radius / 2, clearance))
    if made.pins.count == 1:
        return
    half = keys.pin_circle_diameter * math.sin(math.pi / made.pins.count) / 2

    def room(changed: PinPlateKeys) -> float:
        """For the radius of a pin or its hole; the least wall of a small plate goes by its size."""
        return half - least_wall(_outer_radius(changed)) * (1 + MARGIN) / 2

    def thinner(diameter: float) -> bool:
        return diameter / 2 <= room(replace(keys, pin_diameter=diameter)) * (1 - MARGIN)

    def tighter(value: float) -> bool:
        return value <= (room(replace(keys, seat_clearance=value)) - made.pin_radius) * (1 - MARGIN)

    left = room(keys)
    if made.pin_radius > left:
        raise ParameterError(
            "pin_diameter", keys.pin_diameter, "pins_touch",
            lambda: nearest(thinner, keys.pin_diameter, max(2 * left * (1 - MARGIN), LEAST_LENGTH), digits=6),
            pins=made.pins.count, circle=keys.pin_circle_diameter,
        )  # fmt: skip
    if seat > left:
        most = (left - made.pin_radius) * (1 - MARGIN)
        raise ParameterError(
            "seat_clearance", clearance, "holes_touch_each_other", lambda: nearest(tighter, clearance, most, digits=6)
        )
