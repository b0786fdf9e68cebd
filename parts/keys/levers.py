"""Keys of a plane lever mechanism, and the mechanism that they are: of ``calc lever``, of cranks and of models."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta, Struct
from msgspec.structs import replace

from geometry.base.errors import ParameterError
from parts.base.fields import given_keys
from parts.base.refusal import REMOVED
from parts.base.schema import described_key
from parts.keys.base import degrees, mm

if TYPE_CHECKING:
    from geometry.kinematics.levers import Levers

MOST = 1e5
_CODE = "last four digits of a record-book number: chooses assignment and rows"
_ASSIGNMENT = "number of an assignment of the guidelines, 1 to 10"
Code = Annotated[int | str, Meta(description=_CODE, examples=[1071])] | None
Assignment = Annotated[int, Meta(description=_ASSIGNMENT, examples=[4])] | None
Variant = Annotated[int, Meta(description="its row, 1 to 10", examples=[2])] | None
_BESIDE = "how far the guide passes to the left of O3, of O1 where there is no lever"
_SIDE = "1: slider ahead of C, or O5 to the left of CD; -1: behind it, or to the right"
# geometry names the parts of a mechanism, users its lengths
NAMES = {"first.rod": "coupler_length", "first.pivot": "frame_length", "second.rod": "rod_length"}


def _length(text: str) -> Meta:
    """A key of a link's length."""
    return mm(text, above=0, most=MOST)


_FIRST = Meta(description="what A joins: stone in a lever, rod and rocker, slider")
_FIRST_SIDE = Meta(description="on which side of AB the pivot O3 lies: 1 left, -1 right")
MECHANISM = Meta(description="the mechanism that it turns; its x axis is that of the scene")


class MechanismTable(Struct, kw_only=True, forbid_unknown_fields=True):
    """A crank O1A, what A joins, and a rod CD from the lever to a slider or a rocker."""

    first: Annotated[Literal["stone", "rods", "slider"], _FIRST] = "stone"
    second: Annotated[Literal["slider", "rocker", "none"], Meta(description="what the lever drives")] = "none"
    crank_length: Annotated[float, _length("crank O1A")] | None = None
    frame_length: Annotated[float, _length("frame O1O3")] | None = None
    frame_angle_deg: Annotated[float, degrees("direction from O1 to O3", least=-360, most=360)] = 0.0
    coupler_length: Annotated[float, _length("rod AB")] | None = None
    lever_length: Annotated[float, _length("lever O3B")] | None = None
    first_side: Annotated[Literal[1, -1], _FIRST_SIDE] = 1
    arm_length: Annotated[float, _length("arm O3C of the lever, for CD; default: as long as O3B")] | None = None
    arm_angle_deg: Annotated[float, degrees("direction of O3C against the lever", least=-360, most=360)] = 0.0
    rod_length: Annotated[float, _length("second rod CD")] | None = None
    rocker_length: Annotated[float, _length("rocker O5D")] | None = None
    pivot_distance: Annotated[float, _length("distance O3O5")] | None = None
    pivot_angle_deg: Annotated[float, degrees("direction from O3 to O5", least=-360, most=360)] = 0.0
    guide_height: Annotated[float, mm(_BESIDE, least=-MOST, most=MOST)] = 0.0
    guide_angle_deg: Annotated[float, degrees("direction of the guide", least=-360, most=360)] = 0.0
    second_side: Annotated[Literal[1, -1], Meta(description=_SIDE)] = 1


def scaled(keys: MechanismTable, scale: float) -> MechanismTable:
    """A mechanism with all lengths divided."""
    lengths = {
        name: value for name, value in given_keys(keys).items() if name.endswith(("length", "distance", "height"))
    }
    return replace(keys, **{name: round(value / scale, 6) for name, value in lengths.items()})


def unused(keys: MechanismTable) -> set[str]:
    """Keys that no link of the mechanism takes."""
    slides = "slider" in (keys.first, keys.second)
    taken = {
        "frame_length": keys.first != "slider", "frame_angle_deg": keys.first != "slider",
        "lever_length": keys.first != "slider", "coupler_length": keys.first != "stone",
        "first_side": keys.first == "rods", "arm_length": keys.second != "none",
        "arm_angle_deg": keys.second != "none", "rod_length": keys.second != "none",
        "second_side": keys.second != "none" or keys.first == "slider",
        "rocker_length": keys.second == "rocker", "pivot_distance": keys.second == "rocker",
        "pivot_angle_deg": keys.second == "rocker", "guide_height": slides, "guide_angle_deg": slides,
    }  # fmt: skip
    return {name for name, used in taken.items() if not used}


def levers_of(keys: MechanismTable, speed: float = 1.0, change: float = 0.0) -> Levers:
    """The mechanism of the keys, its crank turning at a ``speed``, rad/s, which changes, rad/s^2.

    Raises
    ------
    ParameterError
        A length that the mechanism needs is missing.
    """

    def needed(name: str) -> float:
        value = getattr(keys, name)
        if value is None:
            raise ParameterError(name, None, "missing_key", None, what=described_key(type(keys), name))
        return float(value)

    from geometry.kinematics.levers import Levers, Rods, Slider, Stone

    crank = needed("crank_length")
    guide = math.radians(keys.guide_angle_deg)
    across = keys.guide_height * 1j * cmath.exp(1j * guide)
    if keys.first == "slider":
        if keys.second != "none":
            raise ParameterError("second", keys.second, "lever_needed", REMOVED)
        rod = Slider(needed("coupler_length"), across, guide, keys.second_side)
        return Levers(crank, speed, rod, change=change)
    pivot = cmath.rect(needed("frame_length"), math.radians(keys.frame_angle_deg))
    lever = needed("lever_length")
    first: Stone | Rods = Stone(pivot)
    if keys.first == "rods":
        first = Rods(pivot, needed("coupler_length"), lever, keys.first_side)
    if keys.second == "none":
        return Levers(crank, speed, first, lever, change=change)
    arm = cmath.rect(keys.arm_length or lever, math.radians(keys.arm_angle_deg))
    second: Slider | Rods = Slider(needed("rod_length"), pivot + across, guide, keys.second_side)
    if keys.second == "rocker":
        other = pivot + cmath.rect(needed("pivot_distance"), math.radians(keys.pivot_angle_deg))
        second = Rods(other, needed("rod_length"), needed("rocker_length"), keys.second_side)
    return Levers(crank, speed, first, lever, arm, second, change)


def turning_levers(keys: MechanismTable) -> Levers:
    """The mechanism of the keys in the table ``mechanism``, checked to let the crank go all the way round.

    Raises
    ------
    ParameterError
        It does not, a length is missing, or no link has one that is given.
    """
    from geometry.kinematics.levers import closed

    for name, value in given_keys(keys).items():
        if name in unused(keys):
            raise ParameterError(f"mechanism.{name}", value, "of_no_link", REMOVED)
    try:
        levers = levers_of(keys)
        closed(levers)
    except ParameterError as refusal:
        raise refusal.renamed(f"mechanism.{NAMES.get(refusal.name, refusal.name)}") from refusal
    return levers
