"""What a scene needs of rods and tubes: lengths to be cut by hand, beside all that a laser or a printer makes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from geometry.base.record import Record
from parts.base.kind import Stock
from parts.base.part import Part
from parts.scene.boards import cut_from

if TYPE_CHECKING:
    from parts.scene.scene_file import SceneFile

# exports whose files are a machine's: what they hold is not cut by hand
_MACHINES = ("laser", "board", "print", "plate")


class StockRow(Record):
    """Lengths that are alike: how many of them all sets need, and the parts that they become."""

    stock: Stock
    count: int
    parts: tuple[str, ...]


def stock_rows(scene: SceneFile, parts: Mapping[str, Part]) -> list[StockRow]:
    """The lengths of rods and tubes that no file of a scene makes, the thickest and longest first."""
    made = {part for export in scene.exports for part in _held(scene, parts, export.purpose, export.parts)}
    sets = max((one.sets for one in (*scene.boards.values(), *scene.beds.values())), default=1)
    counts = Counter(str(spec.part) for spec in scene.instances.values())
    found: dict[tuple[float, float, float], list[str]] = {}
    for key in counts:
        stock = parts[key].stock
        if stock is not None and key not in made:
            found.setdefault((stock.diameter, stock.bore, stock.length), []).append(key)
    return [
        StockRow(Stock(*sizes), sets * sum(counts[p] for p in found[sizes]), tuple(found[sizes]))
        for sizes in sorted(found, reverse=True)
    ]


def _held(
    scene: SceneFile, parts: Mapping[str, Part], purpose: str | None, named: Sequence[str] | None
) -> Sequence[str]:
    """The parts that an export's files hold, where they are a machine's."""
    # a laser's file of all parts holds rods as their ends alone
    if purpose not in _MACHINES or (purpose == "laser" and named is None):
        return ()
    own = [key for key in parts if key in (named or parts)]
    if purpose == "board":
        return [key for key in own if any(cut_from(board, key, parts[key]) for board in scene.boards.values())]
    if purpose == "plate":
        return [key for key in own if any(key in (bed.parts or parts) for bed in scene.beds.values())]
    return own
