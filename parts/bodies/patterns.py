"""Contours that stand in equal steps about one axis, as holes on a circle do: told once, with circle and step."""

from __future__ import annotations

import cmath
import math
from collections.abc import Hashable, Iterable, Iterator, Sequence

from geometry.base.record import Record

# mm that are one place; fewer than so many are told each by its place
_NEAR, _LEAST = 1e-6, 5


class Repeated(Record):
    """Equal things in equal steps of 360 / ``count`` degrees about ``centre``, all of them or but for some.

    ``members``: numbers of all; ``first``: places of those nearest to the direction +x, one of each that a step lays
    onto each other.
    """

    centre: complex
    count: int
    members: frozenset[int]
    first: tuple[tuple[complex, ...], ...]

    @property
    def radii(self) -> tuple[float, ...]:
        """Of the circles that all places lie on, mm."""
        found: list[float] = []
        for radius in sorted(abs(p - self.centre) for places in self.first for p in places):
            if not found or radius - found[-1] > _NEAR:
                found.append(radius)
        return tuple(found)


def repeated(
    shapes: Sequence[tuple[Hashable, tuple[complex, ...]]], centres: Iterable[complex] = ()
) -> Iterator[Repeated]:
    """Patterns of equal things by what each is and the places that tell where it stands, one or two, mm.

    ``centres``: about which they may stand, beside the origin and their own middle.
    """
    kinds: dict[Hashable, list[int]] = {}
    for number, (kind, _) in enumerate(shapes):
        kinds.setdefault(kind, []).append(number)
    places = [places for _, places in shapes]
    for left in kinds.values():
        mean = sum(_middle(places[n]) for n in left) / len(left)
        for centre in dict.fromkeys((0j, *centres, complex(round(mean.real, 6), round(mean.imag, 6)))):
            circles: dict[float, list[int]] = {}
            for n in left:
                circles.setdefault(round(abs(_middle(places[n]) - centre), 5), []).append(n)
            for radius, members in circles.items():
                things = [[p - centre for p in places[n]] for n in members]
                if len(members) < _LEAST or radius < _NEAR or not (count := _steps(things)):
                    continue
                ordered = sorted(members, key=lambda n: abs(round(cmath.phase(_middle(places[n]) - centre), 9)))
                first = tuple(places[n] for n in ordered[: max(len(members) // count, 1)])
                yield Repeated(centre, count, frozenset(members), first)
                left = [n for n in left if n not in members]


def _middle(places: Sequence[complex]) -> complex:
    return sum(places) / len(places)


def _steps(things: Sequence[Sequence[complex]]) -> int:
    """In how many steps a turn is parted that things stand at, which are as far from the centre; 0: in none."""
    found = sorted(things, key=lambda thing: cmath.phase(_middle(thing)))

    def is_laid(count: int) -> bool:
        way, step = cmath.rect(1.0, 2 * math.pi / count), len(found) // count
        return all(_same([p * way for p in one], found[(k + step) % len(found)]) for k, one in enumerate(found))

    whole = next((n for n in range(len(found), _LEAST - 1, -1) if len(found) % n == 0 and is_laid(n)), 0)
    if whole or len(found[0]) > 1:
        return whole
    # some are left out: the fewest steps that all stand at, more than half of them taken
    turns = [place / found[0][0] for (place,) in found]
    return next((n for n in range(len(found) + 1, 2 * len(found)) if all(abs(t**n - 1) < n * _NEAR for t in turns)), 0)


def _same(one: Sequence[complex], other: Sequence[complex]) -> bool:
    """Whether places are the same, in any order."""
    return all(min(abs(p - q) for q in other) < _NEAR for p in one)
