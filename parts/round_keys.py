"""What parts around round pins share: bore and holes by their keys, sections with remedies, finished parts."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import lru_cache
from typing import Annotated, Any

from msgspec import Meta

from geometry.body import Body
from geometry.errors import GeometryError, OffsetError, ParameterError, told
from geometry.hub_holes import HubHoles, least_wall
from geometry.offset_region import OffsetRegion
from geometry.profile import Region
from geometry.windows import RoundHoles
from parts.hole_keys import RoundBoreTable, hub_holes, with_remedy
from parts.keys import mm
from parts.materials import density_of
from parts.part import Part

MOST = 100_000.0
LobeCount = Annotated[int, Meta(ge=2, le=1000, description="number of lobes z of the disc")]
PinCount = Annotated[int, Meta(ge=3, le=1000, description="number of pins")]
PinCircle = Annotated[float, mm("circle of the pins' centres", least=0.1, most=MOST)]
PinDiameter = Annotated[float, mm("diameter of each pin", least=0.01, most=MOST)]
_MARGIN = 1e-6


def holes_of(spec: Any, *own: RoundHoles) -> HubHoles:
    """Bore and holes by the keys of a part; ``own`` groups stand before the others.

    Raises
    ------
    ParameterError
        Both ``bore`` and ``bore_diameter`` are given, or a keyway has no row in its standard.
    """
    if spec.bore is not None and spec.bore_diameter > 0:
        raise ParameterError("bore_diameter", spec.bore_diameter, "give either bore_diameter or bore; 0 works")
    bore = RoundBoreTable(spec.bore_diameter) if spec.bore_diameter > 0 else spec.bore
    found = hub_holes(bore, getattr(spec, "holes", None), getattr(spec, "spokes", None))
    return HubHoles(found.bore, (*own, *found.round_holes), found.spokes)


def check_holes(spec: Any, holes: HubHoles, radius: float, own: int = 0, centre: float = 0.0) -> None:
    """Refuse holes that meet one another or reach ``radius`` mm; the first ``own`` groups are no table of the scene's.

    ``centre``: how far the bore stands off the middle of that radius, mm.

    Raises
    ------
    ParameterError
        Names the key and what would work.
    """
    inside = radius - centre - least_wall(radius)
    if holes.bore is not None and holes.bore_reach > inside and spec.bore_diameter > 0:
        limit = f"at most {told(2 * inside * (1 - _MARGIN))} mm" if inside > 0 else "0"
        raise ParameterError("bore_diameter", spec.bore_diameter, f"leaves no wall about the bore; {limit} works")

    def works(changed: Any) -> bool:
        try:
            return holes_of(changed, *holes.round_holes[:own]).fits(radius - centre)
        except GeometryError:
            return False

    try:
        holes.check(radius - centre)
    except ParameterError as refusal:
        raise with_remedy(_renamed(refusal, len(holes.round_holes), own), spec, works) from refusal


def _renamed(refusal: ParameterError, groups: int, own: int) -> ParameterError:
    """A refusal of a group of holes under its number in the scene."""
    found = re.match(r"holes(?:\.item (\d+))?\.(\w+)", refusal.name)
    if not found or not own:
        return refusal
    number = int(found[1] or 1) - own
    name = f"holes.{found[2]}" if groups - own == 1 else f"holes.item {number}.{found[2]}"
    return ParameterError(name, refusal.value, refusal.allowed)


def moved_section(build: Callable[[float], Region]) -> Callable[[float], OffsetRegion]:
    """The section of a part over its offset, kept; refusals name the nearest offset that works."""

    def section(offset: float) -> OffsetRegion:
        try:
            return OffsetRegion(build(offset), offset, ())
        except GeometryError as refusal:
            if offset == 0:
                raise
            works, fails = 0.0, offset
            for _ in range(30):
                middle = (works + fails) / 2
                try:
                    build(middle)
                    works = middle
                except GeometryError:
                    fails = middle
            reason = refusal.reason if isinstance(refusal, OffsetError) else "leaves no outline"
            raise OffsetError(offset, reason, works) from refusal

    return section


def round_part(
    part_id: str,
    spec: Any,
    section: Callable[[float], OffsetRegion],
    body: Callable[[float], Body],
    *,
    face_width: float,
    is_plate: bool = True,
    **more: Any,
) -> Part:
    """The part of a spec with its material; ``more``: findings, circles, quantities."""
    return Part(
        part_id,
        spec.__struct_config__.tag,
        lru_cache(maxsize=8)(section),
        lru_cache(maxsize=2)(body),
        face_width,
        is_plate,
        material=spec.material,
        colour=spec.colour,
        density=spec.density or density_of(spec.material),
        **more,
    )
