"""The table of a part's working drawing, in a scene: its kind's, with the parts that mesh with it."""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from typing import TYPE_CHECKING

from parts.base.part import Part
from parts.pages.data_table import DataTable, Mated
from parts.scene.placing import Placing

if TYPE_CHECKING:
    from parts.scene.scene_file import SceneFile

# what rolls on each other about axes that meet, or about one axis alone
_WITHOUT_DISTANCE = ("bevel", "rack")


def part_table(part: Part, scene: SceneFile, placing: Placing, parts: Mapping[str, Part]) -> DataTable | None:
    """The table of a part; None where its kind, or this one of it, has none."""
    if part.made_by.data_table is None:
        return None
    mates = []
    for placed in placing.mates:
        ends, mating = (placed.first.part, placed.second.part), placed.mating
        if part.id in ends and mating.rolls not in (None, "parallel"):
            distance = None if mating.rolls in _WITHOUT_DISTANCE else mating.distance
            mates.append(Mated(parts[ends[ends[0] == part.id]], distance))
    made: DataTable | None = importlib.import_module(part.made_by.data_table).data_table(part, scene, mates)
    return made
