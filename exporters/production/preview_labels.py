"""Names on the picture of a scene: each beside its part, over no other name and on no part above its own."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from geometry.base.record import Record, replace
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import lines_cross

# width of a letter and room about a word, part of the letters' height; places tried above and below, and to each side
_LETTER, _ROOM, _RINGS = 0.62, 0.15, 24
# height of the letters of a word for which whole ones have no place over no edge, part of those
_SMALL = 0.7
# places along each side of a picture at which the uppermost part is known
_CELLS = 200
# how well a word can stand; places of a part to which a line from its word is tried, and directions
_BEST, _SPOTS, _DIRECTIONS = 3, 6, 24


class Label(Record):
    """A word whose middle stands at (x, y), y downwards to its foot; ``size``: height of its letters.

    ``leads``: where a line from it ends, on what it names.
    """

    text: str
    x: float
    y: float
    size: float
    leads: complex | None = None

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Left, top, right, bottom, with some room about it."""
        half, room = _LETTER * self.size * len(self.text) / 2, _ROOM * self.size
        return self.x - half - room, self.y - self.size - room, self.x + half + room, self.y + room

    @property
    def line(self) -> tuple[complex, complex] | None:
        """From the side of its box that is nearer to what it names."""
        if self.leads is None:
            return None
        left, top, right, low = self.box
        return complex(min(max(self.leads.real, left), right), min(max(self.leads.imag, top), low)), self.leads


class Tops:
    """Which of the parts of a picture is the uppermost at each place of a grid, by number in their order upwards.

    Every part is its closed boundaries, points as the picture has them, y downwards; ``picture``: its upper left and
    lower right corner.
    """

    def __init__(
        self, parts: Sequence[Sequence[Complex]], cells: int = _CELLS, picture: tuple[complex, complex] | None = None
    ) -> None:
        every = np.concatenate([loop for loops in parts for loop in loops])
        self._low = complex(every.real.min(), every.imag.min())
        self._high = complex(every.real.max(), every.imag.max())
        self._picture = picture or (complex(-math.inf, -math.inf), complex(math.inf, math.inf))
        self._step = max(float(np.ptp(every.real)), float(np.ptp(every.imag)), 1e-300) / cells
        at = self._step * (np.arange(cells) + 0.5)
        self._top: NDArray[np.int_] = np.full((cells, cells), -1)
        for number, loops in enumerate(parts):
            starts = np.concatenate(loops)
            ends = np.concatenate([np.roll(loop, -1) for loop in loops])
            heights = self._low.imag + at
            for row in np.flatnonzero((heights >= starts.imag.min()) & (heights < starts.imag.max())).tolist():
                y = heights[row]
                cut = (starts.imag > y) != (ends.imag > y)
                a, b = starts[cut], ends[cut]
                places = np.sort(a.real + (y - a.imag) / (b.imag - a.imag) * (b.real - a.real))
                self._top[row, np.searchsorted(places, self._low.real + at) % 2 == 1] = number

    def seen(self, number: int) -> bool:
        """Whether anything is seen of the part of this number."""
        return number in self._seen

    @cached_property
    def _seen(self) -> set[int]:
        return set(np.unique(self._top).tolist())

    def shows(self, label: Label, number: int) -> int:
        """How well a word stands for the part of this number: 3 on it alone, 2 beside it alone, 1 beside it.

        0: not beside what is seen of it, on what is above it, or not whole in the picture.
        """
        left, top, right, low = label.box
        if not self._holds(label):
            return 0
        beside = self._within(left - label.size, top - label.size, right + label.size, low + label.size)
        under = set(self._within(left, top, right, low).ravel().tolist())
        if left < self._low.real or top < self._low.imag or right > self._high.real or low > self._high.imag:
            under.add(-1)
        if not (beside == number).any() or max(under) > number:
            return 0
        alone = set(beside.ravel().tolist()) <= {number, -1}
        return 3 if under == {number} else 2 if under == {-1} and alone else 1

    def free(self, label: Label) -> bool:
        """Whether a word stands whole in the picture, on no part."""
        return self._holds(label) and bool((self._within(*label.box) < 0).all())

    def _holds(self, label: Label) -> bool:
        """Whether a word stands whole in the picture."""
        left, top, right, low = label.box
        begin, end = self._picture
        return left >= begin.real and top >= begin.imag and right <= end.real and low <= end.imag

    def spots(self, number: int) -> list[complex]:
        """Places where the part of this number is seen, first one in the midst of what is seen of it."""
        rows, columns = np.nonzero(self._top == number)
        at = self._low + self._step * (columns + 0.5 + 1j * (rows + 0.5))
        outwards: list[complex] = at[np.abs(at - at.mean()).argsort(kind="stable")].tolist()
        return outwards[:: max(len(outwards) // _SPOTS, 1)][:_SPOTS]

    def _within(self, left: float, top: float, right: float, low: float) -> NDArray[np.int_]:
        """The uppermost parts in a box."""
        corner, step = self._low, self._step
        rows = slice(max(int((top - corner.imag) / step), 0), max(int((low - corner.imag) / step) + 1, 0))
        return self._top[rows, max(int((left - corner.real) / step), 0) : max(int((right - corner.real) / step) + 1, 0)]


def spread_labels(wanted: Sequence[Label], tops: Tops | None = None) -> list[Label | None]:
    """The words in their order, each at the free place nearest to where it was wanted, each but once.

    ``tops``: the parts of these words, in this order; one that is covered has no place for its word.
    """
    made: list[Label | None] = [None] * len(wanted)
    taken = np.empty((0, 4))
    for number, label in enumerate(wanted):
        best, found = 0, None
        if any(other and other.text == label.text for other in made) or (tops and not tops.seen(number)):
            continue
        for one in (label, replace(label, size=_SMALL * label.size)) if tops else (label,):
            for place in _apart(list(_places(one)), taken):
                if (rank := tops.shows(place, number) if tops else _BEST) > best:
                    best, found = rank, place
                if best == _BEST:
                    break
            if best > 1:
                break
        made[number] = found
        taken = np.vstack([taken, found.box]) if found else taken
    # lines are drawn where all other words are known
    for number, label in enumerate(wanted):
        if tops and tops.seen(number) and not any(other and other.text == label.text for other in made):
            made[number] = _led(label, number, tops, [other for other in made if other])
    return made


def _led(label: Label, number: int, tops: Tops, made: Sequence[Label]) -> Label | None:
    """A word beside all parts, with a line to its own that crosses as few words and lines as can be; None: no room."""
    taken = np.array([other.box for other in made]).reshape(-1, 4)
    lines = [other.line for other in made if other.line]
    least, found = math.inf, None
    for spot in tops.spots(number):
        here = replace(label, x=spot.real, y=spot.imag, leads=spot)
        for place in _apart([one for one in _around(here) if tops.free(one)], taken):
            if (crossed := _crossed(place, taken, lines)) < least:
                least, found = crossed, place
        if not least:
            break
    return found


def _crossed(label: Label, taken: Real, lines: Sequence[tuple[complex, complex]]) -> int:
    """How many words the line of one runs through, and how many lines it, or the word, crosses."""
    assert label.line
    own = np.array([label.box])
    through = int(_runs(*label.line, taken).sum()) + sum(int(_runs(*line, own).sum()) for line in lines)
    return through + sum(lines_cross(*label.line, *line) for line in lines)


def _runs(start: complex, end: complex, boxes: Real) -> NDArray[np.bool_]:
    """Through which boxes (rows of left, top, right, bottom) a line runs."""
    ways = np.array([end.real - start.real, end.imag - start.imag])
    # what is no way at all is as good as a very short one
    ways = np.where(ways == 0, 1e-300, ways)
    at = np.array([start.real, start.imag])
    one, two = (boxes[:, :2] - at) / ways, (boxes[:, 2:] - at) / ways
    first, last = np.minimum(one, two).max(axis=1), np.maximum(one, two).min(axis=1)
    return np.asarray(np.maximum(first, 0.0) < np.minimum(last, 1.0))


def _apart(places: Sequence[Label], taken: Real) -> list[Label]:
    """Those whose boxes share nothing with boxes (rows of left, top, right, bottom)."""
    left, top, right, low = np.array([place.box for place in places]).reshape(-1, 4).T[:, :, None]
    shared = (left < taken[:, 2]) & (taken[:, 0] < right) & (top < taken[:, 3]) & (taken[:, 1] < low)
    return [place for place, covered in zip(places, shared.any(axis=1), strict=True) if not covered]


def _around(label: Label) -> Iterator[Label]:
    """Places in all directions, ever farther."""
    ways = np.exp(2j * np.pi * np.arange(_DIRECTIONS) / _DIRECTIONS).tolist()
    for ring in range(1, 4 * _RINGS + 1):
        for way in ways:
            shift = ring / 2 * label.size * (1 + 2 * _ROOM) * way
            yield replace(label, x=label.x + shift.real, y=label.y + shift.imag)


def _places(label: Label) -> Iterator[Label]:
    """The wanted place, then places ever farther from it."""
    step, wide = label.size * (1 + 2 * _ROOM), _LETTER * label.size * len(label.text)
    shifts = [(0.0, 0.0)]
    for ring in range(1, _RINGS + 1):
        shifts += [(0.0, ring * step), (0.0, -ring * step)]
        for side in (1, -1):
            shifts += [(side * wide * share, k * step) for share in (0.6, 1.1, 1.7) for k in (ring, -ring)]
            shifts += [(side * wide * 1.1 * (ring // 4 + 1), k * step) for k in (0, ring, -ring)]
    shifts.sort(key=lambda s: abs(s[0]) + 1.5 * abs(s[1]))
    for x, y in shifts:
        yield replace(label, x=label.x + x, y=label.y + y)
