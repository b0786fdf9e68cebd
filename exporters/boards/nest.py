"""Pieces laid on as few boards as a fixed number of steps finds: no clock, no chance, the same layout every time.

On a grid, the places at which two pieces come too near to each other are one table for each pair of shapes (the raster
of the no-fit polygon, a correlation of both covers, holes included). Each board has a map of free places for every
shape and turn; a piece that is laid stamps its tables into them, so that the next free place is found at once: pieces
fall into holes and between others. Covers are never too small, so the gap is kept; what they waste is taken back by
sliding the pieces together, by exact distances.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from exporters.boards.slide import slid
from geometry.base.record import Draft, Record, replace

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

Flags = NDArray[np.bool_]
# cells of the grid along the longer side of a board, and of all tables together
_COARSEST, _FINEST, _TABLES = 800, 6000, 15_000_000
# a shape that fills its circumscribed circle so well is laid in one turn
_ROUND = 1.02
# cells that all layouts together look at
_WORK = 2e10
# layouts that are tried for each piece at most
_TRIALS = 12
_NOTHING = (math.inf, math.inf, math.inf)
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
    laid = _Nest(shapes, room).laid()
    return [one for number in range(1 + max((x.board for x in laid), default=-1))
            for one in _together([x for x in laid if x.board == number], shapes, room)]  # fmt: skip


def _together(laid: Sequence[Laid], shapes: Mapping[str, tuple[BaseGeometry, int]], room: Room) -> list[Laid]:
    """The pieces of a board, slid together."""
    from shapely.affinity import rotate, translate

    placed = [translate(rotate(shapes[x.shape][0], 90 * x.turn, origin=(0, 0)), x.at.real, x.at.imag) for x in laid]
    moved = slid(placed, room.margin * (1 + 1j), room.gap)
    return [replace(x, at=x.at + by) for x, by in zip(laid, moved.tolist(), strict=True)]


class _Nest:
    """The tables of one layout."""

    def __init__(self, shapes: Mapping[str, tuple[BaseGeometry, int]], room: Room) -> None:
        self.room = room
        self.inner = complex(room.width - 2 * room.margin, room.height - 2 * room.margin)
        self.counts = {name: count for name, (_, count) in shapes.items()}
        boxes = [g.bounds for g, _ in shapes.values()]
        spans = np.array([max(b[2] - b[0], b[3] - b[1]) + room.gap for b in boxes])
        # squares about all pairs of shapes in all turns to each other, of which each is looked at cell by cell
        pairs = len(room.turns) * float(np.square(spans[:, None] + spans).sum())
        longer = max(room.width, room.height)
        self.cell = min(max(math.sqrt(pairs / _TABLES), longer / _FINEST), longer / _COARSEST)
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
        """Steps (x, y) about the middle from shape ``one`` to shape ``two`` at which they are not too near."""
        name, turn = one
        other, turned = two
        if (name, turn, other, turned) not in self.tables:
            shape = next(iter(self.turned[name].items()))
            base = self.turned[name].get(0) or _back(shape[1], shape[0])
            first = self._cover(base.geometry, base.half, self.room.gap)
            cover = self.turned[other][turned].cover
            second = np.rot90(cover, -turn, axes=(0, 1))
            size = [a + b - 1 for a, b in zip(first.shape, second.shape, strict=True)]
            fast = [_fast(n) for n in size]
            spectrum = np.fft.rfft2(first, fast) * np.fft.rfft2(second[::-1, ::-1], fast)
            clear = np.fft.irfft2(spectrum, fast)[: size[0], : size[1]] < 0.5
            for quarter in range(4):
                self.tables[name, quarter, other, (turned - turn + quarter) % 4] = np.ascontiguousarray(
                    np.rot90(clear, quarter, axes=(0, 1))
                )
        return self.tables[name, turn, other, turned]

    def laid(self) -> list[Laid]:
        """The best of a fixed number of layouts: each begins anew from the best order, two pieces of it exchanged."""
        size = {name: next(iter(turns.values())).geometry.convex_hull.area for name, turns in self.turned.items()}
        reach = {
            name: max(max(s.half.real, s.half.imag) for s in turns.values()) for name, turns in self.turned.items()
        }
        pieces = [name for name, count in self.counts.items() for _ in range(count)]
        orders = [sorted(pieces, key=lambda name: -by[name]) for by in (size, reach)]
        best = min(filter(None, map(self._packed, orders)), key=lambda found: found.rank)
        work = len(pieces) * sum(map(len, self.turned.values())) * np.mean([t.size for t in self.tables.values()])
        chance = _Chance()
        for _ in range(min(int(_WORK / work), _TRIALS * len(pieces)) if len(self.counts) > 1 else 0):
            order = list(best.order)
            one, two = chance.below(len(order)), chance.below(len(order))
            if order[one] == order[two]:
                continue
            order[one], order[two] = order[two], order[one]
            found = self._packed(order, best.rank)
            if found is not None and found.rank <= best.rank:
                best = found
        return best.laid

    def _packed(self, order: Sequence[str], than: tuple[float, float, float] = _NOTHING) -> _Layout | None:
        """All pieces in an order, each where it lies farthest to the left, board by board; None: no better ``than``."""
        left = list(order)
        found: list[Laid] = []
        end, board = 0.0, 0
        while left:
            here, left, end = self._board(board, left)
            found += here
            board += 1
            if (board, end if board == than[0] else 0.0) > than[:2] or (left and board == than[0]):
                return None
        ends = sorted((one.at.real for one in found if one.board == board - 1), reverse=True)
        return _Layout(tuple(order), found, (board, round(end, 6), sum(ends)))

    def _board(self, board: int, order: Sequence[str]) -> tuple[list[Laid], list[str], float]:
        """What lies on one board, what is left, and how far it reaches, mm."""
        names = dict.fromkeys(order)
        counts = {name: order.count(name) for name in names}
        free = {(name, turn): self._all_free(shape) for name in names for turn, shape in self.turned[name].items()}
        laid, left, end = [], [], 0.0
        full: set[str] = set()
        for name in order:
            counts[name] -= 1
            found = () if name in full else (self._first(free, name, turn) for turn in self.turned[name])
            best = min(filter(None, found), default=None)
            if best is None:
                full.add(name)
                left.append(name)
                continue
            (right, _), turn, (x, y) = best
            end = max(end, right)
            at = complex(x, y) * self.cell + self.room.margin * (1 + 1j) - self.turned[name][turn].middle
            laid.append(Laid(name, board, turn, at))
            for (other, way), places in free.items():
                if counts[other] and other not in full:
                    _stamp(places, self.table((name, turn), (other, way)), x, y)
        return laid, left, end

    def _all_free(self, shape: _Shape) -> Flags:
        """Where the middle of a shape may stand on an empty board."""
        count = [math.floor(size / self.cell + 1e-9) + 1 for size in (self.inner.real, self.inner.imag)]
        low = [math.ceil(size / self.cell - 1e-9) for size in (shape.half.real, shape.half.imag)]
        high = self.inner - shape.half
        places = np.zeros(count, dtype=bool)
        ends = [math.floor(size / self.cell + 1e-9) + 1 for size in (high.real, high.imag)]
        places[low[0] : ends[0], low[1] : ends[1]] = True
        return places

    def _first(
        self, free: Mapping[tuple[str, int], Flags], name: str, turn: int
    ) -> tuple[tuple[float, int], int, tuple[int, int]] | None:
        """The leftmost and then lowest free place of a shape in a turn, and by what it is compared with others."""
        places = free[name, turn]
        x, y = divmod(int(places.argmax()), places.shape[1])
        if not places[x, y]:
            return None
        return (x * self.cell + self.turned[name][turn].half.real, y), turn, (x, y)


class _Layout(Record):
    """Pieces in their places, the order that has led to it, and its rank: boards, how far the last one is used, mm."""

    order: tuple[str, ...]
    laid: list[Laid]
    rank: tuple[float, float, float]


class _Chance:
    """Numbers that are as good as chance, the same on every machine (Lehmer's generator, Park and Miller 1988)."""

    def __init__(self) -> None:
        self.state = 1

    def below(self, count: int) -> int:
        """A number from 0 to below ``count``."""
        self.state = self.state * 48271 % 2147483647
        return self.state % count


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
    part &= table[here[0].start - left :, here[1].start - low :][: part.shape[0], : part.shape[1]]


def _fast(count: int) -> int:
    """The next length of which a transform is fast."""
    best = 1 << (count - 1).bit_length()
    for factor in (9, 5, 3, 15):
        scaled = factor << max(0, math.ceil(math.log2(count / factor)))
        best = min(best, scaled) if scaled >= count else best
    return best
