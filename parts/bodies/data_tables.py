"""The table of a flat body: the places of engraved slots, as wide and as deep as they are, or of many holes."""

from __future__ import annotations

from collections.abc import Sequence

from parts.base.part import Part
from parts.base.texts import N_
from parts.bodies.carrier import CarrierPlate
from parts.bodies.plate import FlatKeys
from parts.bodies.plate_drawing import FROM_EDGES, datum_of, extent, listed_holes
from parts.pages.data_table import DataRow, DataTable, Mated
from parts.pages.inputs import SceneKeys
from parts.pages.page import Table

_HOLES = (("n", ""), ("x", "mm"), ("y", "mm"), ("d", "mm"))
_HEADS = (("n", ""), ("x_1", "mm"), ("y_1", "mm"), ("x_2", "mm"), ("y_2", "mm"), ("b", "mm"), ("h", "mm"))


def data_table(part: Part, scene: SceneKeys, mates: Sequence[Mated]) -> DataTable | None:
    """Both ends of the middle line of each slot, its width and its depth, or holes; None where there are none."""
    keys, thing, region = part.keys, part.thing, part.section(0.0).region
    assert isinstance(keys, FlatKeys)
    low, _ = extent(region)
    if not keys.engraved:
        circles = thing.circles if isinstance(thing, CarrierPlate) else ()
        holes = listed_holes(part, circles)
        datum, words = datum_of(region, circles)
        told = [(float(k), (c - datum).real, (c - datum).imag, 2 * r) for k, (c, r) in enumerate(holes, 1)]
        row = DataRow(N_("holes"), "d", words)
        return DataTable(((row,),), Table("holes", "", _HOLES, tuple(told))) if holes else None
    rows = []
    for number, slot in enumerate(keys.engraved, 1):
        ends = [complex(*end) - low for end in (slot.start, slot.end)]
        places = [value for end in ends for value in (end.real, end.imag)]
        rows.append((float(number), *places, slot.width, slot.depth))
    slots = DataRow(N_("engraved slots"), "", FROM_EDGES)
    return DataTable(((slots,),), Table("engraved", "", _HEADS, tuple(rows)))
