"""The parts list of a scene: what its instances are made of, by their positions."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from geometry.base.errors import Nearest
from parts.base.materials import material_told
from parts.base.refusal import SceneError
from parts.base.texts import standard_told, words
from parts.drawing.names import drawn_names
from parts.drawing.parts_list import SECTIONS, ListRow

if TYPE_CHECKING:
    from parts.base.part import Part
    from parts.scene.standing import Instance

# of what one mass is
_SAME = 1e-9


def list_rows(
    instances: Sequence[Instance], parts: Mapping[str, Part], language: str, *, weighed: bool = True
) -> tuple[ListRow, ...]:
    """The list of all instances of ``parts``, by section and position; what has no number goes on from the greatest.

    ``weighed``: with masses.
    """
    counts = Counter(i.part for i in instances if i.part in parts)
    found: dict[tuple[object, ...], list[str]] = {}
    for part in counts:
        keys = parts[part].keys
        found.setdefault((*_told(parts[part], language), keys.position or part), []).append(part)
    number = max((parts[part].keys.position or 0 for part in counts), default=0)
    rows = []
    for (section, *_), ids in sorted(found.items(), key=lambda item: list(SECTIONS).index(str(item[0][0]))):
        if (position := parts[ids[0]].keys.position) is None:
            position = number = number + 1
        masses = [parts[p].mass if weighed else None for p in ids]
        total = None if None in masses else sum(m * counts[p] for m, p in zip(masses, ids, strict=True) if m)
        # parts that are alike but for how they lie differ by rounding
        least, most = min(m or 0.0 for m in masses), max(m or 0.0 for m in masses)
        mass = masses[0] if math.isclose(least, most, rel_tol=_SAME) else None
        told, count = _told(parts[ids[0]], language)[1:], sum(counts[p] for p in ids)
        rows.append(ListRow(str(section), position, *told, count, mass, total, tuple(ids)))
    return tuple(sorted(rows, key=lambda row: (list(SECTIONS).index(row.section), row.position)))


def check_positions(parts: Mapping[str, Part], language: str, source: str) -> None:
    """Refuse two parts of one position that the list cannot tell on one line.

    Raises
    ------
    SceneError
        In the position of the second; names the first.
    """
    numbered = {key: position for key, part in parts.items() if (position := part.keys.position) is not None}
    first: dict[int, Part] = {}
    for key, position in numbered.items():
        one = first.setdefault(position, parts[key])
        if _told(one, language) != _told(parts[key], language):
            free, place = Nearest(max(numbered.values()) + 1), f"parts.{key}.position"
            raise SceneError(source, place, position, "position_of_another", free, other=f"parts.{one.id}")


def _told(part: Part, language: str) -> tuple[str, str, str, str, str]:
    """Section, designation, name, standard and material: of one position all are alike."""
    keys, told = part.keys, words(language)
    name, designation = drawn_names(part, language)
    # what neither a drawing nor a standard describes, and is only a length of a rod, is told by its sizes
    if part.stock is not None and not (keys.designation or keys.standard or keys.position):
        name = f"{name} {part.stock.told(told)}"
    section = "standard" if keys.standard else "parts"
    standard = told.say(standard_told(keys.standard)) if keys.standard else ""
    return section, "" if keys.standard else designation, name, standard, material_told(part.material, told)
