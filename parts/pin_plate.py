"""The part kinds ``output_plate`` and ``lantern_wheel``: plates that carry round pins."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta, Struct

from geometry.errors import ParameterError, told
from geometry.findings import Finding
from geometry.hub_holes import HubHoles, least_wall
from geometry.windows import RoundHoles
from parts.hole_keys import BoreTable, Direction, HolesTable
from parts.keys import BoreDiameter, Colour, Density, FaceWidth, Material, mm
from parts.part import Part
from parts.round_keys import MOST, PinCircle, PinDiameter, check_holes, holes_of, moved_section, round_part

if TYPE_CHECKING:
    from geometry.body import Body
    from geometry.offset_region import OffsetRegion
    from geometry.pin_plates import PinPlate

_MARGIN = 1e-6
# of solid pins beyond the plate where no key says it, mm
_PIN_LENGTH = 10.0
_Form = Annotated[
    Literal["solid", "holes"],
    Meta(description="pins of one piece with the plate, or holes for loose pins (flat files: holes)"),
]


class OutputPlateSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="output_plate"):
    """Plate with the output pins of a cycloidal reducer on its upper face, or with holes for them."""

    number_of_pins: Annotated[int, Meta(ge=1, le=200, description="number of output pins")]
    pin_circle_diameter: PinCircle
    pin_diameter: PinDiameter
    pins: _Form = "solid"
    pin_length: Annotated[float, mm("how far solid pins stand out; default: 10", least=0.01, most=10_000)] | None = None
    seat_clearance: Annotated[
        float, mm("radius of a hole for a pin beyond the pin's (solid pins: of flat files)", least=-10, most=100)
    ] = 0.0
    start_deg: Direction = 0.0
    outer_diameter: Annotated[float, mm("outside; default: pin circle + 2 pins", above=0, most=2 * MOST)] | None = None
    face_width: FaceWidth = 10.0
    bore_diameter: BoreDiameter = 0.0
    bore: BoreTable | None = None
    holes: HolesTable | list[HolesTable] | None = None
    material: Material | None = None
    density: Density | None = None
    colour: Colour | None = None


class LanternWheelSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="lantern_wheel"):
    """Lantern: round pins between two plates, or one of its plates with holes for them; the first pin on +x."""

    number_of_pins: Annotated[int, Meta(ge=3, le=1000, description="number of pins N")]
    pin_circle_diameter: Annotated[float, mm("circle of the pins' centres: the pitch circle", least=0.1, most=MOST)]
    pin_diameter: PinDiameter
    pins: _Form = "solid"
    face_width: Annotated[float, mm("free length of the pins between the plates", least=0.01, most=10_000)] = 10.0
    plate_thickness: Annotated[float, mm("thickness of each plate", least=0.01, most=10_000)] = 3.0
    seat_clearance: Annotated[
        float, mm("radius of a hole for a pin beyond the pin's (solid pins: of flat files)", least=-10, most=100)
    ] = 0.0
    outer_diameter: (
        Annotated[float, mm("outside of the plates; default: pin circle + 2 pins", above=0, most=2 * MOST)] | None
    ) = None
    bore_diameter: BoreDiameter = 0.0
    bore: BoreTable | None = None
    holes: HolesTable | list[HolesTable] | None = None
    material: Material | None = None
    density: Density | None = None
    colour: Colour | None = None


PlateSpec = OutputPlateSpec | LanternWheelSpec


def checked_pin_plate(spec: PlateSpec) -> PinPlate:
    """The plate of a part with its pins, checked to exist.

    Raises
    ------
    ParameterError
        Names the key and the nearest value that works.
    """
    from geometry.pin_plates import PinPlate, pin_reach

    start = math.radians(spec.start_deg) if isinstance(spec, OutputPlateSpec) else 0.0
    pins = RoundHoles(spec.number_of_pins, spec.pin_diameter, spec.pin_circle_diameter, start)
    holes, solid = holes_of(spec), spec.pins == "solid"
    outer = pins.pitch_circle_diameter / 2 + spec.pin_diameter + max(spec.seat_clearance, 0.0)
    outer = outer if spec.outer_diameter is None else spec.outer_diameter / 2
    if isinstance(spec, OutputPlateSpec):
        if not solid and spec.pin_length is not None:
            raise ParameterError("pin_length", spec.pin_length, 'is for pins = "solid"; remove it')
        thickness, length = spec.face_width, _pin_length(spec)
    else:
        thickness, length = spec.plate_thickness, spec.face_width
    made = PinPlate(pins, outer, holes, solid, spec.seat_clearance, thickness, length)
    low, high = pin_reach(made)
    edge = high + least_wall(1.01 * high) * (1 + _MARGIN)
    if outer < edge:
        text = f"the pins reach the edge; at least {told(2 * edge * (1 + _MARGIN), up=True)} mm works"
        raise ParameterError("outer_diameter", spec.outer_diameter, text)
    least = least_wall(outer) * (1 + _MARGIN)
    _check_pins(spec, made, least)
    own = RoundHoles(pins.count, 2 * (high - pins.pitch_circle_diameter / 2), pins.pitch_circle_diameter, start)
    if holes.bore is not None and spec.bore_diameter > 0 and holes.bore_reach > low - least:
        most = 2 * (low - least) * (1 - _MARGIN)
        text = f"reaches the pins; at most {told(most)} mm works" if most > 0 else "reaches the pins; 0 works"
        raise ParameterError("bore_diameter", spec.bore_diameter, text)
    every = HubHoles(holes.bore, (own, *holes.round_holes), holes.spokes)
    check_holes(spec, every, outer, own=1)
    return made


def _pin_length(spec: OutputPlateSpec) -> float:
    return _PIN_LENGTH if spec.pin_length is None else spec.pin_length


def _check_pins(spec: PlateSpec, made: PinPlate, least: float) -> None:
    seat = made.pin_radius + made.seat_clearance
    if seat < made.pin_radius / 2:
        text = f"leaves no hole; at least {told(-made.pin_radius / 2, up=True)} mm works"
        raise ParameterError("seat_clearance", spec.seat_clearance, text)
    if made.pins.count == 1:
        return
    room = spec.pin_circle_diameter * math.sin(math.pi / made.pins.count) / 2 - least / 2
    if max(seat, made.pin_radius) <= room:
        return
    if made.pin_radius > room:
        text = f"{made.pins.count} pins touch each other; at most {told(2 * room * (1 - _MARGIN))} mm works"
        raise ParameterError("pin_diameter", spec.pin_diameter, text)
    text = f"the holes touch each other; at most {told((room - made.pin_radius) * (1 - _MARGIN))} mm works"
    raise ParameterError("seat_clearance", spec.seat_clearance, text)


def output_plate_part(part_id: str, spec: OutputPlateSpec, made: PinPlate) -> Part:
    """The part of an output plate."""
    section = moved_section(made.region)

    def body(offset: float) -> Body:
        return made.body(offset)

    height = spec.face_width + (_pin_length(spec) if made.solid else 0.0)
    return _part(part_id, spec, made, section, body, height)


def lantern_wheel_part(part_id: str, spec: LanternWheelSpec, made: PinPlate) -> Part:
    """The part of a lantern."""
    section = moved_section(made.region)

    def body(offset: float) -> Body:
        return made.lantern(offset)

    height = spec.plate_thickness * (2 if made.solid else 1) + (spec.face_width if made.solid else 0.0)
    return _part(part_id, spec, made, section, body, height)


def _part(
    part_id: str,
    spec: PlateSpec,
    made: PinPlate,
    section: Callable[[float], OffsetRegion],
    body: Callable[[float], Body],
    height: float,
) -> Part:
    return round_part(
        part_id,
        spec,
        section,
        body,
        face_width=height,
        is_plate=not made.solid,
        flat_findings=(Finding("flat_pins", 0.0, 0.0),) if made.solid else (),
        circles={"pin_circle_diameter": spec.pin_circle_diameter},
        quantities={"number_of_pins": float(spec.number_of_pins), "pin_diameter": spec.pin_diameter},
    )
