"""Where names of a drawing stand: beside what they name, off its lines, off each other, within its field.

Places are complex, in px, y down. A name takes a box, ``WIDE`` for each letter.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from geometry.base.record import Record
from geometry.curves.curve import Complex

# of a letter at 13 px in the middle of names, from above a capital to below a descender, and what stays free about it
WIDE, TALL, FREE = 8.4, 13.0, 2.0
# sweeps over all names: the first beside those before it, the others anew where all now stand
_SWEEPS = 6


class Name(Record):
    """A name and the middles that its box may have, the best first."""

    text: str
    spots: tuple[complex, ...]


def box(text: str) -> complex:
    """Width and height of a name."""
    return complex(WIDE * len(text), TALL)


def beside_line(text: str, start: complex, end: complex) -> Name:
    """Along a line, first at its middle on its left as it runs on the paper, last before and behind its ends."""
    way = (end - start) / abs(end - start)
    spots = []
    for gap in (FREE + 1, FREE + 9, FREE + 17):
        for share in (0.5, 0.35, 0.65, 0.2, 0.8, 0.05, 0.95):
            for across in (-1j * way, 1j * way):
                spots.append(start + share * (end - start) + across * (gap + _reach(text, across)))
        spots += [end + way * (gap + _reach(text, way)), start - way * (gap + _reach(text, way))]
    return Name(text, tuple(spots))


def beside_point(text: str, point: complex, radius: float) -> Name:
    """About a point, first to its right and above."""
    half = box(text) / 2
    ways = (1 - 1j, -1 - 1j, 1 + 1j, -1 + 1j, 1 + 0j, -1 + 0j, -1j, 1j)
    spots = [
        point + complex(way.real * (half.real + room), way.imag * (half.imag + room))
        for room in (radius + FREE, radius + FREE + 8, radius + FREE + 16)
        for way in ways
    ]
    return Name(text, tuple(spots))


def settled(
    names: Sequence[Name], lines: Sequence[tuple[complex, complex]], field: tuple[complex, complex]
) -> list[complex]:
    """The middles of all names: of each the first of its spots at which least is hidden. ``field``: two corners."""
    starts, ends = (np.array([line[k] for line in lines if line[0] != line[1]], complex) for k in (0, 1))
    sizes = [box(name.text) for name in names]
    # what lines and the field's edge cost does not hang on the other names
    fixed = [
        np.array([hidden(starts, ends, spot, size) + _outside(spot, size, field) for spot in name.spots])
        for name, size in zip(names, sizes, strict=True)
    ]
    chosen: dict[int, int] = {}
    for _ in range(_SWEEPS):
        before = dict(chosen)
        for k, name in enumerate(names):
            others = [(names[j].spots[spot], sizes[j]) for j, spot in chosen.items() if j != k]
            costs = [
                cost + sum(_shared(spot, sizes[k], *other) for other in others)
                for spot, cost in zip(name.spots, fixed[k], strict=True)
            ]
            chosen[k] = int(np.argmin(costs))
        if chosen == before:
            break
    return [name.spots[chosen[k]] for k, name in enumerate(names)]


def hidden(starts: Complex, ends: Complex, middle: complex, size: complex) -> float:
    """How much of lines runs through a box and what stays free about it, px."""
    way = ends - starts
    low, high = np.zeros(len(way)), np.ones(len(way))
    with np.errstate(divide="ignore", invalid="ignore"):
        for part, half in ((np.real, size.real / 2 + FREE), (np.imag, size.imag / 2 + FREE)):
            one, two = ((part(middle - starts) + side * half) / part(way) for side in (-1, 1))
            low, high = np.fmax(low, np.fmin(one, two)), np.fmin(high, np.fmax(one, two))
    return float(np.sum(np.maximum(high - low, 0) * np.abs(way)))


def _reach(text: str, way: complex) -> float:
    """From a box's middle to its edge's tangent across a way."""
    half = box(text) / 2
    return abs(way.real) * half.real + abs(way.imag) * half.imag


def _shared(one: complex, size: complex, other: complex, others: complex) -> float:
    """How far two boxes run into each other, px; 0 where they are free."""
    apart = one - other
    across = (size.real + others.real) / 2 + FREE - abs(apart.real)
    down = (size.imag + others.imag) / 2 + FREE - abs(apart.imag)
    # two names on each other are worse than a name on a line
    return 4 * across * down / TALL if across > 0 and down > 0 else 0.0


def _outside(middle: complex, size: complex, field: tuple[complex, complex]) -> float:
    """How far a box stands out of the field, px, weighed as nothing that may be."""
    low, high = field[0] - (middle - size / 2), middle + size / 2 - field[1]
    return 100 * sum(max(out, 0.0) for out in (low.real, low.imag, high.real, high.imag))
