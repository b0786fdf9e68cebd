"""Two instances that do not move on each other: on one shaft, or bolted."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import Annotated, Any

from msgspec import Meta, Struct

from parts.joined import Joined
from parts.keys import mm
from parts.standing import Standing

_MOST = 1e6
_Shift = Annotated[float, mm("a coordinate of the second in the first one's frame", least=-_MOST, most=_MOST)]


class FixedSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="fixed"):
    """The second instance stands still on the first: ``offset`` and ``rotation_deg`` in the first one's frame."""

    first: Annotated[str, Meta(description="instance that is already placed")]
    second: Annotated[str, Meta(description="instance that is fixed to it")]
    offset: Annotated[tuple[_Shift, _Shift, _Shift], Meta(description="x, y, z", extra={"unit": "mm"})] = (
        0.0,
        0.0,
        0.0,
    )
    rotation_deg: Annotated[
        float, Meta(ge=-36_000, le=36_000, description="turn about z", extra={"unit": "degrees"})
    ] = 0.0


@dataclass(frozen=True, slots=True)
class FixedMating(Joined):
    """One instance fixed to another; whether their solids run into each other is for the solids to tell."""

    offset: complex
    rotation: float
    kind: str = "fixed"
    module: float = 1.0
    ratio: float = 1.0
    has_contact: bool = False

    @property
    def distance(self) -> float:
        """Between the axes, mm."""
        return abs(self.offset)

    def second_pose(self, centre: complex, rotation: float, direction: float) -> tuple[complex, float]:
        """Carried along by the first; it has no direction of its own."""
        return centre + self.offset * cmath.rect(1.0, rotation), rotation + self.rotation

    def standing(self, first: tuple[complex, float], second: tuple[complex, float]) -> Standing:
        """How far the second is from its place, mm (added to the distance), and its turn off it, rad."""
        centre, rotation = self.second_pose(*first, 0.0)
        off = math.remainder(second[1] - rotation, 2 * math.pi)
        return Standing(cmath.phase(self.offset), self.distance + abs(second[0] - centre), off, 0.0)

    def quantities(self) -> dict[str, Any]:
        """Where the second stands in the first one's frame."""
        return {
            "offset": [self.offset.real, self.offset.imag, self.height],
            "rotation_deg": math.degrees(self.rotation),
        }


def fixed_mating(mate: FixedSpec, first: Any, second: Any) -> FixedMating:
    """The mating of a fixed mate, whatever its parts are."""
    x, y, z = mate.offset
    return FixedMating(mate.first, mate.second, 0.0, z, complex(x, y), math.radians(mate.rotation_deg))
