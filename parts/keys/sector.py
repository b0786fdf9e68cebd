"""Scene keys of teeth on a part of the rim: ``sector``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta, Struct

from geometry.base.errors import Nearest, ParameterError
from parts.keys.base import part_mm

if TYPE_CHECKING:
    from geometry.gears.teeth.sector import Sector

_FIRST_TOOTH = Meta(
    ge=-10_000,
    le=10_000,
    description="number of the first one, counter-clockwise from the tooth on +x (0); default: the run about +x",
    examples=[-4],
)
_CORNER_RADIUS = part_mm("rounding of the corners beside the toothed rim", least=0)
_BLANK_DIAMETER = "diameter of the blank between the runs; default: the root diameter"
# a hub's default, of the bore's diameter and of the root diameter
_HUB_OF_BORE, _HUB_OF_ROOTS = 2.0, 0.25


class SectorTable(Struct, forbid_unknown_fields=True):
    """Teeth on a part of the rim alone: a toothed sector, or equal runs of teeth that move a mate step by step."""

    teeth: Annotated[int, Meta(ge=1, le=10_000, description="number of teeth that are kept, of each run", examples=[9])]
    first_tooth: Annotated[int, _FIRST_TOOTH] | None = None
    runs: Annotated[int, Meta(ge=1, le=1000, description="number of equal runs, evenly spaced")] = 1
    blank_diameter: Annotated[float, part_mm(_BLANK_DIAMETER, above=0, example=30.0)] | None = None
    corner_radius: Annotated[float, _CORNER_RADIUS] = 0.0


class RingSectorTable(SectorTable, forbid_unknown_fields=True):
    """Teeth on a part of the rim alone: a toothed sector, or equal runs of teeth that move a mate step by step."""

    # beyond the roots of the ring that `new` shows
    blank_diameter: Annotated[float, part_mm(_BLANK_DIAMETER, above=0, example=128.0)] | None = None


class GearSectorTable(SectorTable, forbid_unknown_fields=True):
    """Teeth on a part of the rim alone; the rest is a blank, or cut away but for a hub."""

    rest: Annotated[
        Literal["blank", "cut"], Meta(description="the rest of the rim: a round blank, or cut along tangents of a hub")
    ] = "blank"
    hub_diameter: (
        Annotated[
            float,
            part_mm(
                "diameter of the hub of a cut sector; default: twice the bore, or a quarter of the root diameter",
                above=0,
                example=16.0,
                aside=True,
            ),
        ]
        | None
    ) = None


def sector_of(table: SectorTable | None, sign: int, root_radius: float = 0.0, bore_reach: float = 0.0) -> Sector | None:
    """The sector of a table, its hub of a usual size where it is cut and nobody gave one; ``sign``: -1 of a ring.

    Raises
    ------
    ParameterError
        A key that the rest does not have.
    """
    if table is None:
        return None
    from geometry.gears.teeth.sector import Sector, centred

    first = centred(table.teeth, sign) if table.first_tooth is None else table.first_tooth
    hub, cut = None, isinstance(table, GearSectorTable) and table.rest == "cut"
    if isinstance(table, GearSectorTable):
        if cut:
            for key, usual in (("blank_diameter", None), ("runs", 1)):
                if (given := getattr(table, key)) != usual:
                    raise ParameterError(f"sector.{key}", given, "not_of_cut_sector", Nearest(usual))
            hub = table.hub_diameter or max(2 * _HUB_OF_BORE * bore_reach, 2 * _HUB_OF_ROOTS * root_radius)
        elif table.hub_diameter is not None:
            raise ParameterError("sector.hub_diameter", table.hub_diameter, "of_cut_sector", Nearest(None))
    return Sector(table.teeth, first, table.runs, table.blank_diameter, hub, table.corner_radius)
