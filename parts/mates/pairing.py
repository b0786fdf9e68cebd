"""From the mates of a scene to matings. A mate may change a part only in its tip diameter (inside) and its thinning.

Both happen before any region is built: the shortest tooth that any mate asks for wins, and thinning is shared out so
that mates have the backlash that they ask for.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from geometry.base.record import replace
from parts.base.mate import End, MateKeys, Mating
from parts.mates.registry import MATES


def mated(
    ends: Mapping[str, End[Any]], mates: Sequence[MateKeys], part_of: Mapping[str, str], *, shortened: bool = True
) -> tuple[dict[str, End[Any]], list[Mating]]:
    """The parts as their mates want them, and the matings; ``part_of``: the part of every instance that they name.

    Not ``shortened``: with the tips that they have alone, as textbooks calculate.

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

    asked = [((part_of[m.first], part_of[m.second]), _kind(m).thinning(m, *both(m))) for m in mates]
    for name, thinning in shared_out(asked).items():
        if thinning:
            changed(name, circumferential_thinning=thinning)
    # every mate tells its tips before any is changed
    wanted: dict[str, tuple[float, Any]] = {}
    for mate, tips in [(m, _kind(m).tips(m, *both(m))) for m in mates]:
        for end, radius in zip((mate.first, mate.second), tips, strict=True):
            if radius is not None:
                own = final[name := part_of[end]].thing.tip_radius
                # no mate makes teeth longer: the shortest has its tip farthest from what it was
                if name not in wanted or abs(radius - own) > abs(wanted[name][0] - own):
                    wanted[name] = radius, _kind(mate)
    for name, (radius, kind) in wanted.items() if shortened else ():
        final[name] = replace(final[name], thing=kind.shortened(final[name].thing, radius))
    return final, [_kind(m).mating(m, *both(m)) for m in mates]


# what a mate asks of its two parts alone: their ids, and the thinning of each, mm
Asked = tuple[tuple[str, str], tuple[float, float]]


def shared_out(asked: Sequence[Asked]) -> dict[str, float]:
    """The thinning of parts, mm, from what each mate asks of its two alone.

    A part that another mate has thinned already leaves its mate what is lacking. Mates that ask for most are served
    first, or last, whichever gives less beyond what was asked for: nothing in a train of two pairs, or of like ones.
    """
    rising = sorted(asked, key=lambda one: sum(one[1]))
    ways = [_served(order) for order in (rising[::-1], rising)]
    return min(ways, key=lambda given: sum(abs(_lacking(given, one)) for one in asked))


def _served(asked: Sequence[Asked]) -> dict[str, float]:
    """The same, mate after mate."""
    given: dict[str, float] = {}
    for one in asked:
        bearing = _bearing(one)
        taking = [part for part in bearing if part not in given] or bearing
        lacking, shares = max(_lacking(given, one), 0.0), dict(zip(*one, strict=True))
        whole = sum(shares[part] for part in taking)
        # once, though a part may mesh with another of its kind
        for part in dict.fromkeys(taking):
            given[part] = given.get(part, 0.0) + lacking * (shares[part] / whole)
    return given


def _bearing(one: Asked) -> list[str]:
    """The parts that a mate asks to be thinned."""
    return [part for part, share in zip(*one, strict=True) if share > 0]


def _lacking(given: Mapping[str, float], one: Asked) -> float:
    """What both parts of a mate have too little, mm; below 0: too much."""
    return sum(one[1]) - sum(given.get(part, 0.0) for part in _bearing(one))


def _kind(mate: MateKeys) -> Any:
    return MATES[str(mate.__struct_config__.tag)]
