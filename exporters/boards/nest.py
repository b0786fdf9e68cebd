"""Pieces laid on as few boards as a fixed number of steps finds: no clock, no chance, the same layout every time.

On a grid, the places at which two pieces come too near to each other are one table for each pair of shapes (the raster
of the no-fit polygon, a correlation of both covers, holes included). Each board has a map of free places for every
shape and turn; a piece that is laid stamps its tables into them, so that the next free place is found at once: pieces
fall into holes and between others. Covers are never too small, so the gap is kept; what they waste is taken back by
sliding the pieces together, by exact distances.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from geometry.base.record import Draft, Record

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

Flags = NDArray[np.bool_]
# cells of the grid along the longer side of a board
_CELLS = 800
# a shape that fills its circumscribed circle so well is laid in one turn
_ROUND = 1.02
QUARTERS, HALVES = (0, 1, 2, 3), (0, 2)


class Room(Record):
    """What is laid on: width and height, mm, what is left free at the edges, between pieces; turns by quarters."""

    width: float
    height: float
    margin: float
    gap: float
    turns: tuple[int, ...] = QUARTERS


class Laid(Record):
    """A piece in its place: its shape, the board's number from 0 on, quarter turns, and where its origin stands, mm."""

    shape: str
    board: int
    turn: int
    at: complex


class DoesNotFitError(Exception):
    """A shape is larger than the room; ``size``: its least box, mm, ``scale``: the largest at which it fits."""

    def __init__(self, shape: str, size: tuple[float, float], scale: float) -> None:
        self.shape, self.size, self.scale = shape, size, scale
        super().__init__(shape)


class _Shape(Draft):
    """A shape in one of its turns, on the grid: cells about the middle of its box."""

    geometry: BaseGeometry
    middle: complex
    half: complex
    cover: Flags


def nest(shapes: Mapping[str, tuple[BaseGeometry, int]], room: Room) -> list[Laid]:
    """Lay so many pieces of each shape (polygons, mm) on boards; in the order of the boards.

    Raises
    ------
    DoesNotFitError
        A shape is larger than the room.
    """
    return _Nest(shapes, room).laid()


class _Nest:
    """The tables of one layout."""

    def __init__(self, shapes: Mapping[str, tuple[BaseGeometry, int]], room: Room) -> None:
        self.room = room
        self.inner = complex(room.width - 2 * room.margin, room.height - 2 * room.margin)
        self.cell = max(room.width, room.height) / _CELLS
        self.counts = {name: count for name, (_, count) in shapes.items()}
        self.turned = {name: self._turns(name, geometry) for name, (geometry, _) in shapes.items()}
        self.tables: dict[tuple[str, int, str, int], Flags] = {}

    def _turns(self, name: str, geometry: BaseGeometry) -> dict[int, _Shape]:
        """A shape in all turns in which it fits."""
        from shapely.affinity import rotate, translate

        low_x, low_y, high_x, high_y = geometry.bounds
        middle, half = complex(low_x + high_x, low_y + high_y) / 2, complex(high_x - low_x, high_y - low_y) / 2
        about = translate(geometry, -middle.real, -middle.imag)
        cover = self._cover(about, half, 0.0)
        turns = self.room.turns
        reach = np.hypot(*np.array(about.convex_hull.exterior.coords).T).max()
        if reach <= _ROUND * min(half.real, half.imag):
            turns = (0,)
        found = {}
        for turn in turns:
            size = half if turn % 2 == 0 else complex(half.imag, half.real)
            if 2 * size.real > self.inner.real or 2 * size.imag > self.inner.imag:
                continue
            turned = rotate(about, 90 * turn, origin=(0, 0)) if turn else about
            found[turn] = _Shape(turned, middle * 1j**turn, size, np.rot90(cover, turn, axes=(0, 1)))
        if not found:
            sizes = [half if turn % 2 == 0 else complex(half.imag, half.real) for turn in turns]
            scale = max(min(self.inner.real / s.real, self.inner.imag / s.imag) / 2 for s in sizes)
            raise DoesNotFitError(name, (2 * half.real, 2 * half.imag), scale)
        return found

    def _cover(self, geometry: BaseGeometry, half: complex, more: float) -> Flags:
        """Cells (x, y) about the origin that hold all of a geometry, grown by ``more`` mm."""
        import shapely

        grown = geometry.buffer(more + self.cell / math.sqrt(2) * 1.001, quad_segs=16)
        counts = [math.ceil((size + more) / self.cell) + 1 for size in (half.real, half.imag)]
        axes = [np.arange(-n, n + 1) * self.cell for n in counts]
        shapely.prepare(grown)
        return np.asarray(shapely.contains_xy(grown, *np.meshgrid(*axes, indexing="ij")))

    def table(self, one: tuple[str, int], two: tuple[str, int]) -> Flags:
        """Steps (x, y) about the middle from shape ``one`` to shape ``two`` at which they are too near."""
        name, turn = one
        other, turned = two
        key = (name, 0, other, (turned - turn) % 4)
        if key not in self.tables:
            shape = next(iter(self.turned[name].items()))
            base = self.turned[name].get(0) or _back(shape[1], shape[0])
            first = self._cover(base.geometry, base.half, self.room.gap)
            cover = self.turned[other][turned].cover
            second = np.rot90(cover, -turn, axes=(0, 1))
            size = [a + b - 1 for a, b in zip(first.shape, second.shape, strict=True)]
            fast = [_fast(n) for n in size]
            spectrum = np.fft.rfft2(first, fast) * np.fft.rfft2(second[::-1, ::-1], fast)
            self.tables[key] = np.fft.irfft2(spectrum, fast)[: size[0], : size[1]] > 0.5
        return np.rot90(self.tables[key], turn, axes=(0, 1))

    def laid(self) -> list[Laid]:
        """All pieces, board by board."""
        left = dict(self.counts)
        order = sorted(left, key=lambda name: -next(iter(self.turned[name].values())).geometry.convex_hull.area)
        found: list[Laid] = []
        board = 0
        while any(left.values()):
            found += self._board(board, order, left)
            board += 1
        return found

    def _board(self, board: int, order: Sequence[str], left: dict[str, int]) -> Iterator[Laid]:
        """What lies on one board; ``left`` is counted down."""
        free = {}
        wide, high = (math.floor(size / self.cell + 1e-9) for size in (self.inner.real, self.inner.imag))
        for name in order:
            for turn, shape in self.turned[name].items() if left[name] else ():
                low = [math.ceil(size / self.cell - 1e-9) for size in (shape.half.real, shape.half.imag)]
                ends = [(s - h) / self.cell + 1e-9 for s, h in ((self.inner.real, shape.half.real),
                                                                 (self.inner.imag, shape.half.imag))]  # fmt: skip
                free[name, turn] = np.zeros((wide + 1, high + 1), dtype=bool)
                free[name, turn][low[0] : math.floor(ends[0]) + 1, low[1] : math.floor(ends[1]) + 1] = True
        for name in order:
            while left[name]:
                best = min(filter(None, (self._first(free, name, turn) for turn in self.turned[name])), default=None)
                if best is None:
                    break
                _, turn, (x, y) = best
                left[name] -= 1
                shape = self.turned[name][turn]
                at = complex(x, y) * self.cell + self.room.margin * (1 + 1j) - shape.middle
                yield Laid(name, board, turn, at)
                for (other, way), places in free.items():
                    if left[other]:
                        _stamp(places, self.table((name, turn), (other, way)), x, y)

    def _first(
        self, free: Mapping[tuple[str, int], Flags], name: str, turn: int
    ) -> tuple[tuple[float, int], int, tuple[int, int]] | None:
        """The leftmost and then lowest free place of a shape in a turn, and by what it is compared with others."""
        places = free[name, turn]
        at = int(places.argmax())
        x, y = divmod(at, places.shape[1])
        if not places[x, y]:
            return None
        return (x * self.cell + self.turned[name][turn].half.real, y), turn, (x, y)


def _back(shape: _Shape, turn: int) -> _Shape:
    """A shape as it is before a turn."""
    from shapely.affinity import rotate

    half = shape.half if turn % 2 == 0 else complex(shape.half.imag, shape.half.real)
    return _Shape(rotate(shape.geometry, -90 * turn, origin=(0, 0)), shape.middle, half, shape.cover)


def _stamp(places: Flags, table: Flags, x: int, y: int) -> None:
    """What is too near to a piece at x, y is free no more."""
    left, low = x - table.shape[0] // 2, y - table.shape[1] // 2
    here = slice(max(left, 0), left + table.shape[0]), slice(max(low, 0), low + table.shape[1])
    part = places[here]
    part &= ~table[here[0].start - left :, here[1].start - low :][: part.shape[0], : part.shape[1]]


def _fast(count: int) -> int:
    """The next length of which a transform is fast."""
    best = 1 << (count - 1).bit_length()
    for factor in (9, 5, 3, 15):
        scaled = factor << max(0, math.ceil(math.log2(count / factor)))
        best = min(best, scaled) if scaled >= count else best
    return best
