"""The part kind ``carrier_plate``: one of the two plates between which satellites stand on pins."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta, Struct

from geometry.base.errors import Nearest, ParameterError
from geometry.base.nearest import kept, nearest
from geometry.base.record import Record
from parts.base.kind import Others, Report
from parts.base.schema import replaced, value_at
from parts.bodies.plate import Extruded, FlatKeys, checked_outline, outline_with_marks
from parts.keys.base import MOST_LENGTH, BoreDiameter, mm, part_mm
from parts.keys.holes import Direction
from parts.keys.pins import PinCircle, PinDiameter, least_of

if TYPE_CHECKING:
    from geometry.solids.arms import ArmEnd
    from geometry.solids.plate import Edge, PlateOutline
    from geometry.solids.windows import HoleCircle

# of a hole's diameter: the round end about it; beyond the least hub on which the arms stand beside each other
_BOSS, _HUB = 2.4, 1.05
# keys of holes, and shares of one that are tried where it does not fit
_SIZES = ("pin_diameter", "spacers.diameter", "bore_diameter")
_SHARES = (0.95, 0.9, 0.75, 0.5, 0.25, 0.1, 0.03, 0.01)

_BOSS_DIAMETER = part_mm("of the arm's round end; default: 2.4 holes", above=0, example=8.0)


class PinHolesTable(Struct, forbid_unknown_fields=True):
    """Holes on a circle, each in the round end of an arm of its own: of spacers between both plates."""

    count: Annotated[int, Meta(ge=1, le=200, description="number of holes", examples=[3])]
    pitch_circle_diameter: Annotated[PinCircle, Meta(examples=[60.0])]
    diameter: Annotated[PinDiameter, Meta(examples=[3.0])]
    boss_diameter: Annotated[float, _BOSS_DIAMETER] | None = None
    start_deg: Direction = 0.0


_DIRECTIONS = Meta(
    min_length=1,
    max_length=200,
    description="of each pin; default: equally spaced, the first on +x",
    examples=[[0.0, 117.0, 243.0]],
)
_CARRIER_PLATE_BOSS_DIAMETER = part_mm("of each arm's round end; default: 2.4 pins", above=0, example=15.0)
_HUB_DIAMETER = part_mm("of the middle; default: as the arms need it", above=0, example=40.0)
_OUTER_DIAMETER = mm("a round plate in place of arms", above=0, most=2 * MOST_LENGTH, example=100.0)


class CarrierPlateSpec(FlatKeys, forbid_unknown_fields=True, kw_only=True, tag_field="kind", tag="carrier_plate"):
    """Keys of ``carrier_plate``."""

    number_of_pins: Annotated[int, Meta(ge=1, le=200, description="number of satellites", examples=[3])]
    pin_circle_diameter: Annotated[PinCircle, Meta(examples=[80.0])]
    pin_diameter: Annotated[PinDiameter, Meta(examples=[6.0])]
    directions_deg: Annotated[list[Direction], _DIRECTIONS] | None = None
    seat_clearance: Annotated[float, mm("radius of a hole beyond the pin's", least=-10, most=100)] = 0.0
    boss_diameter: Annotated[float, _CARRIER_PLATE_BOSS_DIAMETER] | None = None
    hub_diameter: Annotated[float, _HUB_DIAMETER] | None = None
    outer_diameter: Annotated[float, _OUTER_DIAMETER] | None = None
    bore_diameter: BoreDiameter = 0.0
    spacers: PinHolesTable | None = None


class CarrierPlate(Record):
    """A plate's outline, the circles of its seats, those of pins first, and the radius of a pin; mm."""

    outline: PlateOutline
    circles: tuple[HoleCircle, ...]
    pin_radius: float
    takes_loose_pins = True

    def pin_centres(self) -> list[complex]:
        """Where the pins stand, mm."""
        return self.circles[0].centres()


class CarrierPlateKind(Extruded[CarrierPlateSpec, CarrierPlate]):
    """A plate of a carrier."""

    name, keys = "carrier_plate", CarrierPlateSpec
    drawing = "parts.bodies.carrier_drawing"

    def thing(self, keys: CarrierPlateSpec, others: Others) -> CarrierPlate:
        """The plate, checked: arms beside each other, holes that keep their walls."""
        try:
            edges, holes, circles = _drawn(keys)
            return CarrierPlate(checked_outline(edges, keys, holes), circles, keys.pin_diameter / 2)
        except ParameterError as refusal:
            if refusal.name not in _SIZES:
                raise
            raise _in_keys(keys, refusal) from refusal

    def flat(self, thing: CarrierPlate) -> PlateOutline:
        """Its outline."""
        return thing.outline

    def report(self, keys: CarrierPlateSpec, thing: CarrierPlate) -> Report:
        """Its pins."""
        return Report(
            circles={"pin_circle_diameter": keys.pin_circle_diameter},
            quantities={"number_of_pins": float(keys.number_of_pins), "pin_diameter": keys.pin_diameter},
        )


CARRIER_PLATE = CarrierPlateKind()


def _drawn(
    keys: CarrierPlateSpec,
) -> tuple[tuple[Edge, ...], list[tuple[str, complex, float]], tuple[HoleCircle, ...]]:
    """Edges, holes (key, centre, diameter) and the circles of seats, not yet held against each other."""
    from geometry.solids.windows import HoleCircle

    seat, turns = keys.pin_diameter + 2 * keys.seat_clearance, [math.radians(a % 360) for a in _directions(keys)]
    circles = [HoleCircle(seat, keys.pin_circle_diameter, tuple(turns))]
    arms = [_end(a, keys.pin_circle_diameter, keys.pin_diameter, keys.boss_diameter) for a in turns]
    if (table := keys.spacers) is not None:
        turns = [math.radians((table.start_deg + 360 * k / table.count) % 360) for k in range(table.count)]
        circles.append(HoleCircle(table.diameter, table.pitch_circle_diameter, tuple(turns)))
        arms += [_end(a, table.pitch_circle_diameter, table.diameter, table.boss_diameter) for a in turns]
    names = "pin_diameter", "spacers.diameter"
    holes = [(key, at, c.diameter) for key, c in zip(names, circles, strict=False) for at in c.centres()]
    if keys.bore_diameter > 0:
        holes.insert(0, ("bore_diameter", 0j, keys.bore_diameter))
    return _edges(keys, arms), holes, tuple(circles)


def _in_keys(keys: CarrierPlateSpec, refusal: ParameterError) -> ParameterError:
    """The refusal of a hole by the key that was typed, with the nearest value of which the plate is made.

    A seat is as wide as its pin and its clearance; arms follow from their pins.
    """
    name, code = refusal.name, refusal.code
    circles = {"pin_diameter": keys.pin_circle_diameter}
    if keys.spacers is not None:
        circles["spacers.diameter"] = keys.spacers.pitch_circle_diameter
    if name in circles and keys.bore_diameter > 0:
        # of a hole and the bore that meet the one that has to change less
        size, bore, room = float(str(refusal.value)), keys.bore_diameter, circles[name]
        least = (room - size) * _SHARES[0]
        if (room - bore) / size < (room - size) / bore < 1 and kept(partial(_works, keys, "bore_diameter"), least):
            name, code = "bore_diameter", "hole_reaches_edge"
    if name == "pin_diameter" and keys.seat_clearance and kept(partial(_works, keys, "seat_clearance"), 0.0):
        name = "seat_clearance"
    given = float(str(value_at(keys, name)))
    ends = (0.0,) if name == "seat_clearance" else [given * share for share in _SHARES]
    cure = partial(nearest, partial(_works, keys, name), given, ends)
    # a round end that was typed may be to blame as well
    boss = refusal.name.replace("pin_diameter", "boss_diameter").replace("s.diameter", "s.boss_diameter")
    typed = value_at(keys, boss) if boss != refusal.name else None
    if typed is not None and kept(partial(_works, keys, boss), None):
        return ParameterError(name, given, "no_wall_in_boss", cure, key=boss.rpartition(".")[2], boss=typed)
    return ParameterError(name, given, code, cure, **refusal.numbers)


def _works(keys: CarrierPlateSpec, name: str, value: float | None) -> bool:
    changed = replaced(keys, name, value)
    edges, holes, _ = _drawn(changed)
    whole, names = outline_with_marks(edges, changed, holes)
    whole.check_holes(names)
    return True


def _directions(keys: CarrierPlateSpec) -> list[float]:
    """Of the pins, degrees."""
    count = keys.number_of_pins
    if keys.directions_deg is None:
        return [360 * k / count for k in range(count)]
    if len(keys.directions_deg) != count:
        raise ParameterError("directions_deg", keys.directions_deg, "not_one_a_pin", pins=count)
    return keys.directions_deg


def _end(angle: float, circle: float, diameter: float, boss: float | None) -> ArmEnd:
    from geometry.solids.arms import ArmEnd

    return ArmEnd(angle, circle / 2, (_BOSS * diameter if boss is None else boss) / 2)


def _edges(keys: CarrierPlateSpec, arms: list[ArmEnd]) -> tuple[Edge, ...]:
    """A hub with arms; round where it is asked for, or where the hub has room for all of their ends."""
    from geometry.curves.line_arc import Arc
    from geometry.solids.arms import armed_outline, least_hub

    arms.sort(key=lambda arm: arm.angle)
    needed = least_hub(arms)
    if keys.outer_diameter is not None:
        if keys.hub_diameter is not None:
            raise ParameterError("hub_diameter", keys.hub_diameter, "is_round_already", Nearest(None))
        hub = keys.outer_diameter / 2
    elif keys.hub_diameter is not None:
        hub = keys.hub_diameter / 2
        if hub < needed:
            raise ParameterError("hub_diameter", keys.hub_diameter, "arms_meet", least_of(2 * needed, 2 * hub))
    else:
        hub = max(_HUB * needed, keys.bore_diameter / 2 + keys.pin_diameter)
        if any(hub >= arm.distance for arm in arms):
            hub = max(arm.distance + arm.radius for arm in arms)
    reaching = [arm for arm in arms if arm.distance + arm.radius > hub * (1 + 1e-9)]
    if keys.outer_diameter is not None or not reaching:
        return (Arc(0j, hub, 0.0, math.pi), Arc(0j, hub, math.pi, math.pi))
    short = next((arm for arm in reaching if hub >= arm.distance), None)
    if short is not None:
        raise ParameterError("hub_diameter", keys.hub_diameter, "hub_reaches_pins", circle=2 * short.distance)
    return armed_outline(hub, reaching)
