"""The table of what is engraved in a flat body: the places of its slots, as wide and as deep as they are."""

from __future__ import annotations

from collections.abc import Sequence

from parts.base.part import Part
from parts.base.texts import N_
from parts.bodies.plate import FlatKeys
from parts.bodies.plate_drawing import extent
from parts.pages.data_table import DataRow, DataTable, Mated
from parts.pages.inputs import SceneKeys
from parts.pages.page import Table

_HEADS = (("n", ""), ("x_1", "mm"), ("y_1", "mm"), ("x_2", "mm"), ("y_2", "mm"), ("b", "mm"), ("h", "mm"))


def data_table(part: Part, scene: SceneKeys, mates: Sequence[Mated]) -> DataTable | None:
    """Both ends of the middle line of each slot, its width and its depth; None where nothing is engraved."""
    keys = part.keys
    assert isinstance(keys, FlatKeys)
    if not keys.engraved:
        return None
    low, _ = extent(part.section(0.0).region)
    rows = []
    for number, slot in enumerate(keys.engraved, 1):
        ends = [complex(*end) - low for end in (slot.start, slot.end)]
        places = [value for end in ends for value in (end.real, end.imag)]
        rows.append((float(number), *places, slot.width, slot.depth))
    told = DataRow(N_("engraved slots"), "", N_("x and y from the left and the lower edge"))
    return DataTable(((told,),), Table("engraved", "", _HEADS, tuple(rows)))
