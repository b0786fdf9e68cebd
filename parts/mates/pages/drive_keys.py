"""How a scene gives a page its drive: two wheels of one kind, and what is about them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from parts.base.mate import MateKeys
from parts.pages.inputs import SceneKeys, chosen_part, given
from parts.pages.page import Sheet

# how a page takes its keys from a scene, its source and what was asked besides
TableFrom = Callable[[SceneKeys, str, dict[str, Any]], dict[str, Any]]


def drive_of_kind(kind: str, mate: type[MateKeys], own: Sequence[str], *lengths: str) -> TableFrom:
    """The keys of the first wheel (of this ``kind``) of a scene's one such mate, or of that which ``part`` names.

    With them go the teeth of the other wheel, what it has of its ``own``, and those of the mate's ``lengths`` that are
    given.
    """

    def table_from(scene: SceneKeys, source: str, table: dict[str, Any]) -> dict[str, Any]:
        ends: dict[str, MateKeys] = {}
        for one in scene.mates:
            if isinstance(one, mate):
                ends.setdefault(str(scene.instances[one.first].part), one)
        found = ends[chosen_part(kind, [*ends], [*ends], source, table)]
        first, second = (given(scene.parts[str(scene.instances[key].part)]) for key in (found.first, found.second))
        asked = {key: value for key in lengths if (value := getattr(found, key)) not in (None, [])}
        teeth = {"mate_number_of_teeth": second["number_of_teeth"]}
        if not teeth.keys() & table.keys():
            asked |= {f"mate_{key}": second[key] for key in own if key in second}
        return first | asked | teeth | table

    return table_from


def idler_steps(page: Sheet, wraps: Sequence[float], taut: complex | None) -> None:
    """The angle of wrap on each idler, and where the last one makes all taut."""
    for k, wrap in enumerate(wraps, 1):
        page.add("idler_wrap_deg", math.degrees(wrap), "", "", k)
    if taut is not None:
        page.told(taut_idler_x=taut.real, taut_idler_y=taut.imag)
