"""Names on the picture of a scene: each near its part, over no other name."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from geometry.base.record import Record

# width of a letter and room about a word, part of the letters' height; places tried above and below, and to each side
_LETTER, _ROOM, _RINGS = 0.62, 0.15, 24


class Label(Record):
    """A word whose middle stands at (x, y), y downwards to its foot; ``size``: height of its letters."""

    text: str
    x: float
    y: float
    size: float

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Left, top, right, bottom, with some room about it."""
        half, room = _LETTER * self.size * len(self.text) / 2, _ROOM * self.size
        return self.x - half - room, self.y - self.size - room, self.x + half + room, self.y + room

    def covers(self, other: Label) -> bool:
        """Whether both boxes share anything."""
        a, b = self.box, other.box
        return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def spread_labels(wanted: Sequence[Label]) -> list[Label]:
    """The words in their order, each at the free place nearest to where it was wanted."""
    made: list[Label] = []
    for label in wanted:
        free = (one for one in _places(label) if not any(one.covers(other) for other in made))
        made.append(next(free, label))
    return made


def _places(label: Label) -> Iterator[Label]:
    """The wanted place, then places ever farther from it."""
    step, wide = label.size * (1 + 2 * _ROOM), _LETTER * label.size * len(label.text)
    shifts = [(0.0, 0.0)]
    for ring in range(1, _RINGS + 1):
        shifts += [(0.0, ring * step), (0.0, -ring * step)]
        for side in (1, -1):
            shifts += [(side * wide * 0.6, k * step) for k in (ring, -ring)]
            shifts += [(side * wide * 1.1 * (ring // 4 + 1), k * step) for k in (0, ring, -ring)]
    shifts.sort(key=lambda s: abs(s[0]) + 1.5 * abs(s[1]))
    for x, y in shifts:
        yield Label(label.text, label.x + x, label.y + y, label.size)
