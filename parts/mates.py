"""Mates of a scene: gears that mesh. A mate may change a part only in its tip diameter, before any region is built."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Any

from msgspec import Meta, Struct

from geometry.gears.spur import SpurGear

if TYPE_CHECKING:
    from geometry.gears.pair import ExternalPair


class ExternalGearPairSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="external_gear_pair"):
    """Two external spur gears in mesh: exact centre distance, tip shortening, phase."""

    first: Annotated[str, Meta(description="instance that is already placed")]
    second: Annotated[str, Meta(description="instance that is brought into mesh")]
    direction_deg: Annotated[
        float, Meta(ge=-360, le=360, description="direction of the line of centres", extra={"unit": "degrees"})
    ] = 0.0


@dataclass(frozen=True, slots=True)
class Mating:
    """Two instances in mesh, with the gears as they are built."""

    first: str
    second: str
    direction_deg: float
    pair: ExternalPair


def mated(
    gears: dict[str, SpurGear], mates: list[Any], part_of: dict[str, str]
) -> tuple[dict[str, SpurGear], list[Mating]]:
    """The gears with their tips shortened, the shortest asked for by any mate, and the pairs of them.

    ``gears`` by part, ``part_of`` the part of every instance that ``mates`` name.

    Raises
    ------
    ParameterError
        Two gears cannot mesh; names the key of the second gear and what would work.
    """
    if not mates:
        return gears, []
    # only scenes with mates pay for the mathematics of pairs
    from geometry.gears.pair import external_pair

    pairs = [external_pair(gears[part_of[m.first]], gears[part_of[m.second]]) for m in mates]
    final = dict(gears)
    for mate, pair in zip(mates, pairs, strict=True):
        for name, gear in ((part_of[mate.first], pair.first), (part_of[mate.second], pair.second)):
            if gear.tip_radius < final[name].tip_radius:
                final[name] = replace(final[name], given_tip_diameter=2 * gear.tip_radius)
    matings = [
        Mating(
            m.first,
            m.second,
            m.direction_deg,
            replace(p, first=final[part_of[m.first]], second=final[part_of[m.second]]),
        )
        for m, p in zip(mates, pairs, strict=True)
    ]
    return final, matings
