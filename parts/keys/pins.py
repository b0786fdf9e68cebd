"""What parts around round pins share: bore and holes by their keys, sections whose refusals name an offset."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Annotated, Protocol, TypeVar

from msgspec import Meta

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.nearest import moved
from geometry.plane.offset_region import OffsetRegion
from geometry.plane.profile import Region
from geometry.solids.hub_holes import HubHoles, least_wall
from geometry.solids.wheel import check_wheel
from parts.base.kind import Kind
from parts.base.part_keys import MaterialKeys
from parts.keys.base import part_mm
from parts.keys.holes import BoredKeys, holes_of, spoked, wide_bore, with_remedy
from parts.keys.wheel import HubbedKeys, shape_of

LobeCount = Annotated[int, Meta(ge=2, le=1000, description="number of lobes z of the disc", examples=[11])]
PinCount = Annotated[int, Meta(ge=3, le=1000, description="number of pins", examples=[12])]
PinCircle = Annotated[float, part_mm("circle of the pins' centres", least=0.1, example=80.0)]
PinDiameter = Annotated[float, part_mm("diameter of each pin", least=0.01, example=8.0)]
# what is kept from every limit, as a part of it
MARGIN = 1e-6


def most_of(value: float, given: float) -> Nearest:
    """An upper limit, a little less than ``value``; 0 where nothing is left."""
    return limit(value * (1 - MARGIN), given, digits=6) if value > 0 else Nearest(0.0)


def least_of(value: float, given: float) -> Nearest:
    """A lower limit, a little more than ``value``."""
    return limit(value * (1 + MARGIN), given, digits=6)


def check_holes(keys: BoredKeys, holes: HubHoles, radius: float, own: int = 0, centre: float = 0.0) -> None:
    """Refuse holes that meet one another or reach ``radius`` mm; the first ``own`` groups are no table of the scene's.

    ``centre``: how far the bore stands off the middle of that radius, mm.

    Raises
    ------
    ParameterError
        Names the key and what would work.
    """
    inside = radius - centre - least_wall(radius)
    if holes.bore is not None and holes.bore_reach > inside and keys.bore_diameter > 0:
        most = most_of(2 * inside, keys.bore_diameter)
        raise ParameterError("bore_diameter", keys.bore_diameter, "no_wall_around_bore", most)
    if centre and holes.bore_reach > inside:
        raise wide_bore(keys, inside, "no_wall_around_bore")

    def fits(changed: BoredKeys) -> bool:
        return holes_of(changed, *holes.round_holes[:own]).fits(radius - centre)

    try:
        holes.check(radius - centre)
    except ParameterError as refusal:
        raise with_remedy(_renamed(refusal, holes, own), keys, fits) from refusal


def wheel_holes(keys: HubbedKeys, root_radius: float) -> HubHoles:
    """Bore and holes of a wheel, which stay within ``root_radius`` mm and leave its body its room.

    Raises
    ------
    ParameterError
        Names the key and what would work.
    """
    keys = spoked(keys, root_radius)
    holes = holes_of(keys)
    check_holes(keys, holes, root_radius)
    check_wheel(shape_of(keys), 2 * root_radius, holes)
    return holes


def _renamed(refusal: ParameterError, holes: HubHoles, own: int) -> ParameterError:
    """A refusal of a group of holes under its number in the scene; what meets a part's own group is the bore."""
    place = re.fullmatch(r"holes(?:\[(\d+)\])?\.(\w+)", refusal.name)
    if place is None or not own:
        return refusal
    number, key = int(place[1] or 1) - own, place[2]
    if number < 1 and holes.bore is not None:
        return ParameterError(*holes.bore.size, "bore_reaches_pins")
    return refusal.renamed(f"holes.{key}" if len(holes.round_holes) - own == 1 else f"holes[{number}].{key}")


class Sectioned(Protocol):
    """What knows its own section."""

    def region(self, offset: float) -> Region:
        """Moved ``offset`` mm out of the material."""


K = TypeVar("K", bound=MaterialKeys)
T = TypeVar("T", bound=Sectioned)


class RoundPinKind(Kind[K, T]):
    """A kind with round pins, or that is one: its thing knows the section."""

    drawing = "parts.pins.drawings"

    def section(self, keys: K, thing: T, offset: float) -> OffsetRegion:
        """That of the thing, moved."""
        return moved_region(thing.region, offset)


def moved_region(build: Callable[[float], Region], offset: float) -> OffsetRegion:
    """A section moved ``offset`` mm out of the material; a refusal names the nearest offset that works."""
    return OffsetRegion(moved(build, offset, "leaves_no_outline"), offset, ())
