"""From the mates of a scene to matings. A mate may change a part only in its tip diameter and its thinning.

Both happen before any region is built: the shortest tip and the largest thinning that any mate asks for win.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from geometry.base.record import replace
from parts.base.mate import End, MateKeys, Mating
from parts.mates.registry import MATES


def mated(
    ends: Mapping[str, End[Any]], mates: Sequence[MateKeys], part_of: Mapping[str, str]
) -> tuple[dict[str, End[Any]], list[Mating]]:
    """The parts as their mates want them, and the matings; ``part_of``: the part of every instance that they name.

    Raises
    ------
    ParameterError
        Two parts cannot be joined so; names the key of one part, or of the mate as ``mate.KEY``, and what would work.
    """
    final = dict(ends)

    def both(mate: MateKeys) -> tuple[End[Any], End[Any]]:
        return final[part_of[mate.first]], final[part_of[mate.second]]

    def changed(name: str, **values: float) -> None:
        final[name] = replace(final[name], thing=replace(final[name].thing, **values))

    thinning: dict[str, float] = {}
    for mate in mates:
        for end, asked in zip((mate.first, mate.second), _kind(mate).thinning(mate, *both(mate)), strict=True):
            thinning[part_of[end]] = max(thinning.get(part_of[end], 0.0), asked)
    for name, asked in thinning.items():
        if asked:
            changed(name, circumferential_thinning=asked)
    # every mate tells its tips before any is changed
    for mate, tips in [(m, _kind(m).tips(m, *both(m))) for m in mates]:
        for end, radius in zip((mate.first, mate.second), tips, strict=True):
            if radius is not None and radius < final[part_of[end]].thing.tip_radius:
                changed(part_of[end], given_tip_diameter=2 * radius)
    return final, [_kind(m).mating(m, *both(m)) for m in mates]


def _kind(mate: MateKeys) -> Any:
    return MATES[str(mate.__struct_config__.tag)]
