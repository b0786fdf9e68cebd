"""The part kind ``lever_crank``: the flat crank of a plane lever mechanism, which tells where its other links stand."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated

from geometry.base.errors import GeometryError, ParameterError
from geometry.base.record import Record
from parts.base.kind import Others, Report
from parts.bodies.plate import Extruded, FlatKeys, checked_outline
from parts.keys.base import part_mm, start
from parts.keys.levers import MECHANISM, MechanismTable, turning_levers

if TYPE_CHECKING:
    from geometry.kinematics.levers import Levers
    from geometry.solids.plate import Edge, PlateOutline

_CRANK_ROCKER = {
    "first": "rods", "crank_length": 25.0, "frame_length": 80.0, "coupler_length": 70.0, "lever_length": 50.0,
}  # fmt: skip


class LeverCrankSpec(FlatKeys, forbid_unknown_fields=True, kw_only=True, tag_field="kind", tag="lever_crank"):
    """Keys of ``lever_crank``."""

    mechanism: Annotated[MechanismTable, MECHANISM, start(_CRANK_ROCKER)]
    width: Annotated[float, part_mm("of its round end about the pin A", above=0)] = 12.0
    boss_diameter: Annotated[float, part_mm("of the round end about the pivot O1", above=0)] = 12.0
    pivot_diameter: Annotated[float, part_mm("hole for the axle", least=0)] = 6.0
    pin_diameter: Annotated[float, part_mm("hole for the pin A; 0 is none", least=0)] = 4.0


class LeverCrank(Record):
    """A crank's outline, and the mechanism in whose frame it stands turned by its angle from +x."""

    levers: Levers
    outline: PlateOutline


class LeverCrankKind(Extruded[LeverCrankSpec, LeverCrank]):
    """A crank and its mechanism."""

    name, keys = "lever_crank", LeverCrankSpec

    def thing(self, keys: LeverCrankSpec, others: Others) -> LeverCrank:
        """The mechanism, checked to go all the way round, and the outline, checked to exist."""
        levers = turning_levers(keys.mechanism)
        own = [("pivot_diameter", 0j, keys.pivot_diameter), ("pin_diameter", levers.crank + 0j, keys.pin_diameter)]
        outline = checked_outline(_edges(keys, levers.crank), keys, [hole for hole in own if hole[2] > 0])
        return LeverCrank(levers, outline)

    def flat(self, thing: LeverCrank) -> PlateOutline:
        """Its outline."""
        return thing.outline

    def report(self, keys: LeverCrankSpec, thing: LeverCrank) -> Report:
        """What its mechanism moves over a turn: swings of what turns, the stroke of what slides, the ratio of ways."""
        return Report(quantities=mechanism_quantities(thing.levers))


def mechanism_quantities(levers: Levers) -> dict[str, float]:
    """Named results over a turn of the crank: swings in degrees, a stroke in mm, and how much longer one way takes."""
    from geometry.kinematics.levers import members, travel

    found: dict[str, float] = {}
    for member in members(levers):
        if member in ("lever", "second_rocker"):
            found[f"{member}_swing_deg"] = math.degrees(travel(levers, member).run)
        elif member == "slider":
            found["slider_stroke"] = travel(levers, member).run
    if (ratio := travel(levers, [*members(levers)][-1]).ratio) is not None:
        found["ratio_of_ways"] = ratio
    return found


def _edges(keys: LeverCrankSpec, length: float) -> tuple[Edge, ...]:
    """The hull of both ends."""
    from geometry.solids.plate import belt

    try:
        return belt((0j, keys.boss_diameter / 2), (length + 0j, keys.width / 2))
    except GeometryError as refusal:
        name = "width" if keys.width > keys.boss_diameter else "boss_diameter"
        less, given = sorted((keys.width, keys.boss_diameter))
        last = (less + 2 * length) * (1 - 1e-6)
        raise ParameterError.beyond(name, given, "end_within_the_other", last) from refusal


LEVER_CRANK = LeverCrankKind()
