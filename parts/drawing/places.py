"""Where holes stand that are on no circle with others: told by their distances from two axes, each size once."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator

from geometry.solids.hub_holes import HubHoles
from geometry.solids.windows import RoundHoles
from parts.drawing.working import Size

# digits of places
_DIGITS = 9


def apart(holes: HubHoles) -> tuple[RoundHoles, ...]:
    """Holes that stand alone on their circles, of sizes that several of them have."""
    ones = Counter(group.diameter for group in holes.round_holes if group.count == 1)
    return tuple(group for group in holes.round_holes if group.count == 1 and ones[group.diameter] > 1)


def circled(holes: HubHoles) -> tuple[RoundHoles, ...]:
    """The others: groups that are told by their circle."""
    others = apart(holes)
    return tuple(group for group in holes.round_holes if group not in others)


def place_sizes(places: Iterable[complex], corner: complex) -> Iterator[Size]:
    """Sizes of places from the axes; ``corner``: the lower left one of the view, from which those of an axis begin."""
    places = list(places)
    lowest = {round(p.real, _DIGITS): p for p in sorted(places, key=lambda p: -p.imag)}
    leftmost = {round(p.imag, _DIGITS): p for p in sorted(places, key=lambda p: -p.real)}
    for k, (a, b) in enumerate(spans(lowest), 1):
        start, end = (lowest.get(x, complex(x, corner.imag)) for x in (a, b))
        yield Size(f"x.{k}", start, end, "below")
    for k, (a, b) in enumerate(spans(leftmost), 1):
        start, end = (leftmost.get(y, complex(corner.real, y)) for y in (a, b))
        yield Size(f"y.{k}", start, end, "left")


def spans(values: Iterable[float]) -> Iterator[tuple[float, float]]:
    """The ends of sizes: from an axis, of what is alike on both sides of it from side to side."""
    found = {round(value, _DIGITS) for value in values} - {0.0}
    for value in sorted(found):
        if value > 0 and -value in found:
            yield -value, value
        elif -value not in found:
            yield min(value, 0.0), max(value, 0.0)
