"""The table of a part's working drawing, in a scene: its kind's, with the parts that mesh with it."""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from typing import TYPE_CHECKING

from parts.base.part import Part
from parts.mates.involute import GearMating
from parts.mates.worm import WormMating
from parts.pages.data_table import DataTable, Mated
from parts.scene.placing import Placing

if TYPE_CHECKING:
    from parts.scene.load import SceneFile


def part_table(part: Part, scene: SceneFile, placing: Placing, parts: Mapping[str, Part]) -> DataTable | None:
    """The table of a part; None where its kind, or this one of it, has none."""
    if part.made_by.data_table is None:
        return None
    mates = []
    for placed in placing.mates:
        ends = placed.first.part, placed.second.part
        if part.id in ends and isinstance(placed.mating, GearMating | WormMating):
            mates.append(Mated(parts[ends[ends[0] == part.id]], placed.mating.distance))
    made: DataTable | None = importlib.import_module(part.made_by.data_table).data_table(part, scene, mates)
    return made
