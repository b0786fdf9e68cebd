"""What belt and chain drives have in common: it turns both wheels the same way, and alone touches them."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta, Struct

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from parts.base.mate import Pose, Toothed
from parts.keys.base import MOST_LENGTH, either, mm

if TYPE_CHECKING:
    from geometry.kinematics.mechanism import Kind
    from geometry.plane.loop import Loop, Wheel

_FAR = 1e6
_AT = Meta(
    min_length=2,
    max_length=2,
    description="its axis from that of the first, mm: towards the second, and to the left of that; left of it in the"
    " strand on the left",
    examples=[[40.0, 14.0]],
)
_NUMBER_OF_TEETH = Meta(ge=6, le=500, description="of a toothed one", examples=[20])
_DIAMETER = mm("of a smooth one", above=0, most=2 * MOST_LENGTH, example=12.0)
_OVER = mm(
    "from the rim of a smooth one to the pitch line of the belt; chains lie on it with their rollers",
    least=-MOST_LENGTH,
    most=MOST_LENGTH,
    example=0.4,
)


class IdlerTable(Struct, forbid_unknown_fields=True, kw_only=True):
    """A wheel that guides or tightens what is about two others: toothed or smooth."""

    at: Annotated[list[Annotated[float, mm("a part of it", least=-_FAR, most=_FAR)]], _AT]
    outside: Annotated[bool, Meta(description="whether it presses from outside of the loop")] = False
    number_of_teeth: Annotated[int, _NUMBER_OF_TEETH] | None = None
    diameter: Annotated[float, _DIAMETER] | None = None
    pitch_line_offset: Annotated[float, _OVER] = 0.0

    def wheel(self, name: str, pitch_radius: Callable[[int], float], over: float = 0.0) -> Wheel:
        """It by the pitch line about it, mm; ``pitch_radius``: by teeth, ``over``: of a chain over what is smooth.

        Raises
        ------
        ParameterError
            Both teeth and diameter are told, or neither.
        """
        from geometry.plane.loop import Wheel

        if self.number_of_teeth is not None and self.diameter is not None:
            raise either(f"{name}.diameter", self.diameter, "number_of_teeth", None)
        if self.number_of_teeth is not None:
            radius = pitch_radius(self.number_of_teeth)
        elif self.diameter is not None:
            radius = self.diameter / 2 + over + self.pitch_line_offset
        else:
            raise ParameterError(f"{name}.number_of_teeth", None, "one_of_two_is_missing", other="diameter")
        if radius <= 0:
            raise ParameterError(f"{name}.pitch_line_offset", self.pitch_line_offset, "idler_of_no_size")
        rim = radius - over if self.diameter is None else self.diameter / 2
        return Wheel(complex(*self.at), radius, self.outside, rim)


Idlers = Annotated[
    list[IdlerTable],
    Meta(max_length=20, examples=[[{"at": [40.0, 14.0], "diameter": 12.0, "outside": True}]]),
]


def idler_wheels(
    idlers: Sequence[IdlerTable], prefix: str, pitch_radius: Callable[[int], float], over: float = 0.0
) -> tuple[Wheel, ...]:
    """The circles of idlers, mm; ``prefix``: of their key."""
    return tuple(one.wheel(f"{prefix}idlers[{k}]", pitch_radius, over) for k, one in enumerate(idlers, 1))


def check_idlers(
    loop: Loop, wheels: Sequence[Wheel], idlers: Sequence[IdlerTable], prefix: str, unit: float = 1.0
) -> None:
    """Refuse idlers to which the loop, told in ``unit`` mm, does not come.

    Raises
    ------
    ParameterError
        ``idlers[k].at`` of one of them.
    """
    from geometry.plane.loop import Loop

    for wheel in (loop.wheels[k] for k in loop.missed()):
        if wheel in wheels:
            k = wheels.index(wheel)
            key, at = f"{prefix}idlers[{k + 1}].at", idlers[k].at
            if loop.meeting:
                one, two = (loop.wheels[i] for i in loop.meeting)
                apart, least = unit * abs(one.centre - two.centre), unit * (one.radius + two.radius)
                # told with four decimals or fewer, it is still enough
                least = math.ceil(least * 1e4) / 1e4
                raise ParameterError(key, at, "idler_meets_wheel", apart=apart, least=least)
            if not loop.passes_by:
                raise ParameterError(key, at, "idler_in_strand")
            other = replace(wheel, outside=not wheel.outside)
            if Loop(tuple(other if one is wheel else one for one in loop.wheels)).missed():
                raise ParameterError(key, at, "idler_missed")
            raise ParameterError(key, at, "idler_passed_by", other="true" if other.outside else "false")


class Wrapped(Toothed, kw_only=True):
    """Two wheels, and what is wrapped about them."""

    rolls: Kind | None = "internal"
    has_contact: bool = False
    # mm in a unit of ``loop``
    unit: float = 1.0

    @property
    def loop(self) -> Loop:
        """What is wrapped, the first wheel at the origin, the second on +x."""
        raise NotImplementedError

    def about(self, first: Pose, second: Pose) -> list[tuple[complex, float]]:
        """Axes and radii, mm, of all wheels in the order in which the loop comes to them, below 0 of those outside."""
        way = cmath.rect(self.unit, cmath.phase(second[0] - first[0]))
        return [(first[0] + way * wheel.centre, self.unit * wheel.side) for wheel in self.loop.wheels]

    def idlers(self, first: Pose, second: Pose) -> list[tuple[complex, float]]:
        """Axes and radii, mm, of those that no part is: a toothed one as far as the chain or the pitch line."""
        axes = [axis for axis, _ in self.about(first, second)]
        rims = (self.unit * wheel.rim for wheel in self.loop.wheels)
        return [(axis, rim) for axis, rim in zip(axes, rims, strict=True) if rim > 0]


def gap_away(rotation: float, direction: float, step: float) -> float:
    """Phase of the first wheel's gap that is nearest to the side away from the second, rad; ``step`` between gaps."""
    return math.pi + math.remainder(rotation - direction + step / 2 - math.pi, step)


def idler_quantities(wraps: Sequence[float], taut: complex | None) -> dict[str, float]:
    """The least angle of wrap on an idler, and where the last one makes all taut, if it does."""
    place = {} if taut is None else {"taut_idler_x": taut.real, "taut_idler_y": taut.imag}
    return {"idler_wrap_deg": math.degrees(min(wraps)), **place}
