"""Names on the picture of a scene: on its part or beside it, over no other name and no edge, or on a line."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import cached_property
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geometry.base.record import Record, replace
from geometry.curves.curve import Complex, Flags, Indices, Real
from geometry.curves.line_arc import lines_cross

# width of a letter and room about a word, part of the letters' height; places tried above and below, and to each side
_LETTER, _ROOM, _RINGS = 0.62, 0.15, 24
# height of the letters of a word for which whole ones have no place over no edge, part of those
_SMALL = 0.7
# places along each side of a picture at which the uppermost part is known
_CELLS = 200
# how well a word can stand; places of a part to which a line from its word is tried, and directions
_BEST, _SPOTS, _DIRECTIONS = 2, 12, 24
# what a line from a word to its part is longer by where it runs over an edge, and through a word or a line: letters
_EDGE, _CROSSING = 8.0, 1e6


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
        left, top, right, low = self.boxes(self.x, self.y)
        return left, top, right, low

    def boxes(self, x: Any, y: Any) -> tuple[Any, Any, Any, Any]:
        """The same where it stands elsewhere, numbers or arrays."""
        half, room = _LETTER * self.size * len(self.text) / 2, _ROOM * self.size
        return x - half - room, y - self.size - room, x + half + room, y + room

    @property
    def line(self) -> tuple[complex, complex] | None:
        """From the side of its box that is nearer to what it names; none where it stands on the end of it."""
        if self.leads is None:
            return None
        left, top, right, low = self.box
        start = complex(min(max(self.leads.real, left), right), min(max(self.leads.imag, top), low))
        return None if start == self.leads else (start, self.leads)


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
        """How well a word stands where it is."""
        return int(self.ranks(label, np.array([label.x]), np.array([label.y]), number)[0])

    def ranks(self, label: Label, x: Real, y: Real, number: int) -> Indices:
        """How well a word stands at places for the part of this number: 2 on it alone, 1 beside it alone, 0 not so.

        On another part it would name that one; over an edge it could not be read.
        """
        left, top, right, low = label.boxes(x, y)
        sums = [np.pad(f.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0))) for f in (self._top == number, self._top < 0)]

        def counted(left: Real, top: Real, right: Real, low: Real) -> tuple[Indices, Indices, Indices]:
            """Cells within boxes that show the part, that show none, and all."""
            places = ((top, self._low.imag), (low, self._low.imag), (left, self._low.real), (right, self._low.real))
            cells = [((at - corner) / self._step).astype(int) + k % 2 for k, (at, corner) in enumerate(places)]
            one, two, begin, end = (side.clip(0, len(self._top)) for side in cells)
            own, none = (s[two, end] - s[one, end] - s[two, begin] + s[one, begin] for s in sums)
            return own, none, (two - one) * (end - begin)

        own, none, cells = counted(left, top, right, low)
        corner, last, (begin, end) = self._low, self._high, self._picture
        beyond = (left < corner.real) | (top < corner.imag) | (right > last.real) | (low > last.imag)
        # right above or below its part others may stand beside its ends, as in a row
        high, deep = top - label.size, low + label.size
        beside = counted(left - label.size, high, right + label.size, deep)
        middle = counted(x - label.size, high, x + label.size, deep)
        near = np.any([(n > 0) & (n + free == every) for n, free, every in (beside, middle)], axis=0)
        held = (left >= begin.real) & (top >= begin.imag) & (right <= end.real) & (low <= end.imag)
        is_on = ~beyond & (cells > 0) & (own == cells)
        return np.asarray(held * np.where(is_on, _BEST, near & (none == cells) & (beyond | (cells > 0))))

    def plain(self, boxes: Real) -> Flags:
        """Which boxes (left, top, right, bottom along the last axis) are whole in the picture, over no edge."""
        begin, end = self._picture
        left, top, right, low = np.moveaxis(self._cells(boxes), -1, 0)
        sums = self._edges
        crossed = sums[low + 1, right + 1] - sums[top, right + 1] - sums[low + 1, left] + sums[top, left]
        held = (boxes[..., :2] >= (begin.real, begin.imag)) & (boxes[..., 2:] <= (end.real, end.imag))
        return np.asarray((crossed == 0) & held.all(axis=-1))

    def edges(self, line: tuple[complex, complex]) -> int:
        """Over how many edges of what is seen a line runs; one more where it begins on a part."""
        places = np.linspace(*line, 2 + int(abs(line[1] - line[0]) / self._step))
        columns, rows = self._cells(np.column_stack([places.real, places.imag])).T
        seen = self._around[rows, columns]
        return int(np.count_nonzero(np.diff(seen)) + (seen[0] >= 0))

    def _cells(self, places: Real) -> NDArray[np.int_]:
        """The cells of x and y in turn along the last axis, counted with a row and a column of paper on each side."""
        corner = np.resize([self._low.real, self._low.imag], places.shape[-1])
        cells = np.floor((places - corner) / self._step) + 1
        return np.asarray(cells.clip(0, len(self._top) + 1).astype(int))

    @cached_property
    def _around(self) -> NDArray[np.int_]:
        """The uppermost parts, with a row and a column of paper on each side."""
        return np.pad(self._top, 1, constant_values=-1)

    @cached_property
    def _edges(self) -> NDArray[np.int_]:
        """How many cells above and to the left of each corner of cells show another part than one beside them."""
        seen = np.pad(self._around, ((1, 0), (1, 0)), mode="edge")
        other = (seen[1:, 1:] != seen[1:, :-1]) | (seen[1:, 1:] != seen[:-1, 1:])
        return np.pad(other.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))

    def spots(self, number: int) -> list[complex]:
        """Places well within what is seen of the part of this number, first one in the midst of them."""
        layers = [self._around == number]
        while layers[-1].any():
            last = layers[-1]
            inner = last[1:-1, 1:-1] & last[:-2, 1:-1] & last[2:, 1:-1] & last[1:-1, :-2] & last[1:-1, 2:]
            layers.append(np.pad(inner, 1))
        rows, columns = np.nonzero(layers[(len(layers) - 1) // 2])
        at = self._low + self._step * (columns - 0.5 + 1j * (rows - 0.5))
        outwards: list[complex] = at[np.abs(at - at.mean()).argsort(kind="stable")].tolist()
        return outwards[:: max(len(outwards) // _SPOTS, 1)][:_SPOTS]


def spread_labels(wanted: Sequence[Label], tops: Tops | None = None) -> list[Label | None]:
    """The words in their order, each at the free place nearest to where it was wanted, each but once.

    ``tops``: the parts of these words, in this order; one that is covered has no place for its word.
    """
    made: list[Label | None] = [None] * len(wanted)
    taken = np.empty((0, 4))
    for number, label in enumerate(wanted):
        found = None
        if any(other and other.text == label.text for other in made) or (tops and not tops.seen(number)):
            continue
        for one in (label, replace(label, size=_SMALL * label.size)) if tops else (label,):
            x, y = _places(one, taken)
            ranks = tops.ranks(one, x, y, number) if tops else np.full(x.shape, _BEST)
            if ranks.size and (best := ranks.max()):
                # of those that are as good the nearest
                at = int((ranks == best).argmax())
                found = replace(one, x=float(x[at]), y=float(y[at]))
                break
        made[number] = found
        taken = np.vstack([taken, found.box]) if found else taken
    # lines are drawn where all other words are known, the shortest to what is uppermost
    for number, label in reversed(list(enumerate(wanted))):
        if tops and tops.seen(number) and not any(other and other.text == label.text for other in made):
            made[number] = _led(label, number, tops, [other for other in made if other])
    return made


def _led(label: Label, number: int, tops: Tops, made: Sequence[Label]) -> Label | None:
    """A word over no edge, on a line to its part that runs over little else and is short; None: no room."""
    taken = np.array([other.box for other in made]).reshape(-1, 4)
    lines = [other.line for other in made if other.line]
    least, found = math.inf, None
    for spot, size in product(tops.spots(number), (label.size, _SMALL * label.size)):
        for place in _around(replace(label, x=spot.real, y=spot.imag, size=size, leads=spot), tops, taken):
            line = place.line or (spot, spot)
            # what is as long at full size is not written smaller
            length = abs(line[1] - line[0]) / size
            if (
                length < least
                and (length := length + _EDGE * tops.edges(line)) < least
                and (length := length + _CROSSING * _crossed(place, line, taken, lines)) < least
            ):
                least, found = length, place
    return found


def _crossed(label: Label, way: tuple[complex, complex], taken: Real, lines: Sequence[tuple[complex, complex]]) -> int:
    """How many words the line of one runs through, and how many lines it, or the word, crosses."""
    own = np.array([label.box])
    through = int(_runs(*way, taken).sum()) + sum(int(_runs(*line, own).sum()) for line in lines)
    return through + sum(lines_cross(*way, *line) for line in lines)


def _runs(start: complex, end: complex, boxes: Real) -> Flags:
    """Through which boxes (rows of left, top, right, bottom) a line runs."""
    ways = np.array([end.real - start.real, end.imag - start.imag])
    # what is no way at all is as good as a very short one
    ways = np.where(ways == 0, 1e-300, ways)
    at = np.array([start.real, start.imag])
    one, two = (boxes[:, :2] - at) / ways, (boxes[:, 2:] - at) / ways
    first, last = np.minimum(one, two).max(axis=1), np.maximum(one, two).min(axis=1)
    return np.asarray(np.maximum(first, 0.0) < np.minimum(last, 1.0))


def _covered(boxes: Real, taken: Real) -> Flags:
    """Which boxes (left, top, right, low along the last axis) share something with one of those taken (in rows)."""
    left, top, right, low = np.moveaxis(boxes[..., None], -2, 0)
    shared = (left < taken[:, 2]) & (taken[:, 0] < right) & (top < taken[:, 3]) & (taken[:, 1] < low)
    return np.asarray(shared.any(axis=-1))


def _around(label: Label, tops: Tops, taken: Real) -> Iterator[Label]:
    """In each direction the nearest place over no edge and no box (rows of left, top, right, bottom)."""
    ways = np.exp(2j * np.pi * np.arange(_DIRECTIONS) / _DIRECTIONS)
    shifts = np.arange(1, 4 * _RINGS + 1)[:, None] / 2 * label.size * (1 + 2 * _ROOM) * ways
    boxes = np.array(label.box) + np.stack([shifts.real, shifts.imag] * 2, axis=-1)
    free = tops.plain(boxes) & ~_covered(boxes, taken)
    for way in np.flatnonzero(free.any(axis=0)).tolist():
        shift = complex(shifts[free[:, way].argmax(), way])
        yield replace(label, x=label.x + shift.real, y=label.y + shift.imag)


def _places(label: Label, taken: Real) -> tuple[Real, Real]:
    """The wanted place, then places ever farther from it, in no box (rows of left, top, right, bottom)."""
    step, wide = label.size * (1 + 2 * _ROOM), _LETTER * label.size * len(label.text)
    shifts = [(0.0, 0.0)]
    for ring in range(1, _RINGS + 1):
        shifts += [(0.0, ring * step), (0.0, -ring * step)]
        for side in (1, -1):
            shifts += [(side * wide * share, k * step) for share in (0.6, 1.1, 1.7) for k in (ring, -ring)]
            shifts += [(side * wide * 1.1 * (ring // 4 + 1), k * step) for k in (0, ring, -ring)]
    right, down = np.array(shifts).T
    nearest = np.argsort(np.abs(right) + 1.5 * np.abs(down), kind="stable")
    x, y = label.x + right[nearest], label.y + down[nearest]
    free = ~_covered(np.stack(label.boxes(x, y), axis=-1), taken)
    return x[free], y[free]
