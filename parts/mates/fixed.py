"""Two instances that do not move on each other (on one shaft, bolted, a pin in its seat), or share an axis."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Annotated, Any

from msgspec import Meta

from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import replace
from parts.base.mate import End, MateKeys, MateKind, Mating, Pose, Standing
from parts.keys.base import degrees, mm
from parts.keys.mate import AboveKeys, Height
from parts.mates.sizes import same_size

if TYPE_CHECKING:
    from geometry.base.placement import Vector
    from geometry.gears.pins.geneva_driver import GenevaDriver
    from geometry.solids.pin_plates import PinPlate, RoundDisc
    from geometry.solids.pin_ring import PinRing

_MOST = 1e6
_Part = Annotated[float, Meta(ge=-_MOST, le=_MOST)]
_Shift = Annotated[float, mm("a coordinate of the second in the first one's frame", least=-_MOST, most=_MOST)]
_Axis = (
    Annotated[
        tuple[_Part, _Part, _Part],
        Meta(description="direction [x, y, z] of the second's axis in the first one's frame; default: along its axis",
             examples=[[1.0, 0.0, 0.0]]),
    ]
    | None
)  # fmt: skip
_Turn = Annotated[float, degrees("turn about z", least=-36_000, most=36_000)]


class FixedSpec(MateKeys, tag="fixed", kw_only=True):
    """Keys of ``fixed``."""

    second: Annotated[str, Meta(description="instance that is fixed to it")]
    offset: Annotated[tuple[_Shift, _Shift, _Shift], mm("x, y, z")] = (0.0, 0.0, 0.0)
    rotation_deg: _Turn = 0.0
    axis: _Axis = None


class CoaxialSpec(AboveKeys, tag="coaxial", kw_only=True):
    """Keys of ``coaxial``."""

    rotation_deg: _Turn = 0.0


_OFFSET = mm(
    "x, y, z of the axis in the carrier's frame; default: where other mates have put it", example=[40.0, 0.0, 0.0]
)


class CarriedSpec(MateKeys, tag="carried", kw_only=True):
    """Keys of ``carried``."""

    first: Annotated[str, Meta(description="the carrier: an instance that is already placed")]
    second: Annotated[str, Meta(description="instance whose axis goes round with it, free to turn")]
    offset: Annotated[tuple[_Shift, _Shift, _Shift], _OFFSET] | None = None


class PinSeatSpec(MateKeys, tag="pin_seat", kw_only=True):
    """Keys of ``pin_seat``."""

    number: Annotated[int, Meta(ge=1, le=1000, description="which seat, counted from the first one")] = 1
    height: Height = 0.0


class FixedMating(Mating):
    """One instance fixed to another; whether their solids run into each other is for the solids to tell."""

    offset: complex
    rotation: float = 0.0
    axis: Vector = (0.0, 0.0, 1.0)

    bond = "fixed"
    turns_axis = True

    @property
    def asked_turn(self) -> float | None:
        """Of ``fixed`` itself; seats are turned as they stand on their holder."""
        return self.rotation if self.kind == Fixed.name else None

    def second_pose(self, centre: complex, rotation: float, direction: float) -> Pose:
        """Carried along by the first; it has no direction of its own."""
        # what is turned over turns the other way about its own axis
        sense = -1 if self.axis == (0.0, 0.0, -1.0) else 1
        return centre + self.offset * cmath.rect(1.0, rotation), sense * rotation + self.rotation

    def second_axis(self, direction: float) -> Vector:
        """As the first's frame has it."""
        return self.axis

    def standing(self, first: Pose, second: Pose) -> Standing:
        """How far the second is from its place, mm (added to the distance), and its turn off it, rad."""
        return self.off_place(first, second)

    def quantities(self) -> dict[str, Any]:
        """Where the second stands in the first one's frame."""
        return {
            "offset": [self.offset.real, self.offset.imag, self.height],
            "rotation_deg": math.degrees(self.rotation),
            **({} if self.axis == (0.0, 0.0, 1.0) else {"axis": list(self.axis)}),
        }


class CarriedMating(Mating):
    """A link that turns about an axis of another one: a satellite on its carrier, a wheel about a shaft."""

    offset: complex | None
    rotation: float = 0.0

    bond = "turning"

    @property
    def placed_turn(self) -> float | None:
        """Of ``coaxial``; what is carried turns as other mates have it."""
        return self.rotation if self.kind == Coaxial.name else None

    def second_pose(self, centre: complex, rotation: float, direction: float) -> Pose:
        """About its place on the carrier, turned with it as it is placed."""
        if self.offset is None:
            raise ParameterError("offset", None, "place_on_carrier", None)
        return centre + self.offset * cmath.rect(1.0, rotation), rotation + self.rotation

    def standing(self, first: Pose, second: Pose) -> Standing | None:
        """How far the axis is from its place, mm (added to the distance); wherever it stands where none is told."""
        return None if self.offset is None else self.off_place(first, second, free=True)


class Fixed(MateKind[FixedSpec, Any, Any]):
    """Anything on anything."""

    name, keys = "fixed", FixedSpec

    def mating(self, keys: FixedSpec, first: End[Any], second: End[Any]) -> FixedMating:
        """Whatever the parts are."""
        x, y, z = keys.offset
        mating = _fixed(self.name, keys, complex(x, y), z, math.radians(keys.rotation_deg))
        if keys.axis is None:
            return mating
        if not any(keys.axis):
            raise ParameterError("mate.axis", list(keys.axis), "no_direction", None)
        a, b, c = (value / math.hypot(*keys.axis) + 0.0 for value in keys.axis)
        return replace(mating, axis=(a, b, c))


def _fixed(name: str, keys: MateKeys, offset: complex, height: float, rotation: float = 0.0) -> FixedMating:
    return FixedMating(
        name, keys.first, keys.second, 0.0, height=height, distance=abs(offset), offset=offset, rotation=rotation
    )


class Coaxial(MateKind[CoaxialSpec, Any, Any]):
    """Anything about anything's axis."""

    name, keys = "coaxial", CoaxialSpec

    def mating(self, keys: CoaxialSpec, first: End[Any], second: End[Any]) -> CarriedMating:
        """Whatever the parts are."""
        turn = math.radians(keys.rotation_deg)
        return CarriedMating(*self.joined(keys), height=keys.height, offset=0j, rotation=turn)


class Carried(MateKind[CarriedSpec, Any, Any]):
    """Anything on anything, free to turn."""

    name, keys = "carried", CarriedSpec

    def mating(self, keys: CarriedSpec, first: End[Any], second: End[Any]) -> CarriedMating:
        """Whatever the parts are."""
        offset = None if keys.offset is None else complex(*keys.offset[:2])
        return CarriedMating(
            *self.joined(keys),
            height=0.0 if keys.offset is None else keys.offset[2],
            distance=0.0 if offset is None else abs(offset),
            offset=offset,
        )


_HOLDERS = ("pin_ring", "output_plate", "lantern_wheel", "geneva_driver", "carrier_plate")


class PinSeat(MateKind[PinSeatSpec, "PinRing | PinPlate | GenevaDriver", "RoundDisc"]):
    """A loose pin in its seat."""

    name, keys = "pin_seat", PinSeatSpec
    joins = tuple((holder, "pin") for holder in _HOLDERS)

    def mating(
        self, keys: PinSeatSpec, first: End[PinRing | PinPlate | GenevaDriver], second: End[RoundDisc]
    ) -> FixedMating:
        """There is such a seat for a loose pin of this diameter."""
        holder = first.thing
        if not holder.takes_loose_pins:
            raise ParameterError("mate.first", keys.first, "has_its_pins")
        centres = holder.pin_centres()
        if keys.number > len(centres):
            raise ParameterError("mate.number", keys.number, "fewer_seats", Nearest(len(centres), "at_most"))
        same_size("diameter", 2 * second.thing.radius, 2 * holder.pin_radius, "not_of_the_seats")
        return _fixed(self.name, keys, centres[keys.number - 1], keys.height)
