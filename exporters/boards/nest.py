"""Pieces laid on as few boards as a fixed number of steps finds: no clock, no chance, the same layout every time.

On a grid, the places at which two pieces come too near to each other are one table for each pair of shapes (the raster
of the no-fit polygon, the sum of both covers, holes included). Each board has a map of taken places for every
shape and turn; a piece that is laid stamps its tables into them, eight places to a byte, so that the next free place is
found at once: pieces fall into holes and between others. Covers are never too small, so the gap is kept; what they
waste is taken back by sliding the pieces together, by exact distances.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from exporters.boards.slide import slid
from geometry.base.record import Draft, Record, replace
from geometry.curves.curve import Flags, Indices

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

# flags (x, y), eight to a byte along y, the first one the highest bit; a map's rows are whole words
Bits = NDArray[np.uint8]
# cells along a square of them that is looked at as a whole
_SQUARE = 16
_WORD, _TAKEN = 64, np.uint64(2**64 - 1)
# cells of the grid along the longer side of a board, and of all tables together
_COARSEST, _FINEST, _TABLES = 800, 6000, 15_000_000
# a shape that fills its circumscribed circle so well is laid in one turn
_ROUND = 1.02
# shapes are the same to this, mm; a turn is none where it changes so little of an area
_SAME, _SYMMETRIC = 1e-6, 0.002
# cells that all layouts together look at
_WORK = 1e10
# more boards than this are copies of the first ones, as long as there are pieces for them
_FEW_BOARDS = 8.0
# pairs of runs of two covers, for each cell of their table, up to which the table is made of them
_PAIRS = 4
# layouts that are tried for each piece at most
_TRIALS = 10
_NOTHING = (math.inf, math.inf, math.inf)
QUARTERS, HALVES = (0, 1, 2, 3), (0, 2)
Side = Literal["width", "height"]


class Room(Record):
    """What is laid on: width and height, mm, what is left free at the edges, between pieces; turns by quarters."""

    width: float
    height: float
    margin: float
    gap: float
    turns: tuple[int, ...] = QUARTERS

    @property
    def inner(self) -> complex:
        """The size of what is within its margins, mm."""
        return complex(self.width - 2 * self.margin, self.height - 2 * self.margin)


class Laid(Record):
    """A piece in its place: its shape, the board's number from 0 on, quarter turns, and where its origin stands, mm."""

    shape: str
    board: int
    turn: int
    at: complex


class DoesNotFitError(Exception):
    """A shape is larger than the room; ``size``: its box, mm."""

    def __init__(self, shape: str, size: tuple[float, float]) -> None:
        self.shape, self.size = shape, size
        super().__init__(shape)


class _Shape(Draft):
    """A shape in one of its turns, on the grid: cells about the middle of its box."""

    geometry: BaseGeometry
    middle: complex
    half: complex
    cover: Flags


def largest_scale(geometry: BaseGeometry, room: Room) -> float:
    """The largest scale at which a shape has room."""
    inner, sizes = room.inner, [_turned(_size(geometry), turn) for turn in room.turns]
    return max(min(inner.real / size.real, inner.imag / size.imag) for size in sizes)


def lacking(room: Room, wide: float, high: float) -> Side:
    """Which side of a room has to grow for a box that it does not hold, mm: by less where either would do.

    The width where neither does alone.
    """
    sides: tuple[Side, Side] = "width", "height"
    return min(sides, key=lambda side: least_side(room, side, wide, high) - getattr(room, side))


def least_side(room: Room, side: Side, wide: float, high: float) -> float:
    """The least width or height of a room, its other side kept, that holds a box, mm; infinite where none does."""
    inner, sizes = room.inner, [_turned(complex(wide, high), turn) for turn in room.turns]
    if side == "width":
        needed = [size.real for size in sizes if size.imag <= inner.imag]
    else:
        needed = [size.imag for size in sizes if size.real <= inner.real]
    return min(needed, default=math.inf) + 2 * room.margin


def nest(shapes: Mapping[str, tuple[BaseGeometry, int]], room: Room) -> list[Laid]:
    """Lay so many pieces of each shape (polygons, mm) on boards; in the order of the boards.

    Raises
    ------
    DoesNotFitError
        A shape is larger than the room.
    """
    plain = _plain(shapes, room.gap)
    alike = _alike(plain)
    leaders = dict.fromkeys(alike.values())
    counts = {name: sum(shapes[k][1] for k, own in alike.items() if own == name) for name in leaders}
    found = _Nest({name: (plain[name], counts[name]) for name in leaders}, room).laid()
    # shapes that are alike take the places of the first of them in turns
    queues = {name: [k for k, own in alike.items() if own == name for _ in range(shapes[k][1])] for name in leaders}
    laid = []
    for one in found:
        name = queues[one.shape].pop(0)
        off = _middle(plain[one.shape]) - _middle(plain[name])
        laid.append(replace(one, shape=name, at=one.at + off * 1j**one.turn))
    # only the last board has room to be saved
    last = max((one.board for one in laid), default=0)
    return [x for x in laid if x.board < last] + _together([x for x in laid if x.board == last], plain, room)


def _plain(shapes: Mapping[str, tuple[BaseGeometry, int]], gap: float) -> dict[str, BaseGeometry]:
    """The shapes without the holes into which no piece goes."""
    import shapely

    def sides(geometry: BaseGeometry) -> list[float]:
        size = _size(geometry)
        return sorted((size.real, size.imag))

    boxes = [sides(geometry) for geometry, _ in shapes.values()]
    found = {}
    for name, (geometry, _) in shapes.items():
        pieces = []
        for piece in shapely.get_parts(geometry):
            holes = ((hole, sides(hole)) for hole in piece.interiors)
            kept = [h for h, (a, b) in holes if any(x + 2 * gap <= a and y + 2 * gap <= b for x, y in boxes)]
            pieces.append(shapely.Polygon(piece.exterior, kept))
        found[name] = shapely.union_all(pieces)
    return found


def _size(geometry: BaseGeometry) -> complex:
    """Width and height of its box."""
    low_x, low_y, high_x, high_y = geometry.bounds
    return complex(high_x - low_x, high_y - low_y)


def _turned(size: complex, quarters: int) -> complex:
    """A size after quarter turns."""
    return complex(size.imag, size.real) if quarters % 2 else size


def _middle(geometry: BaseGeometry) -> complex:
    """The middle of its box."""
    low_x, low_y, high_x, high_y = geometry.bounds
    return complex(low_x + high_x, low_y + high_y) / 2


def _about(geometry: BaseGeometry) -> BaseGeometry:
    """A geometry about the middle of its box."""
    from shapely.affinity import translate

    middle = _middle(geometry)
    return translate(geometry, -middle.real, -middle.imag)


def _alike(shapes: Mapping[str, BaseGeometry]) -> dict[str, str]:
    """For each shape the first one that is the same but for its place."""
    about = {name: _about(geometry).normalize() for name, geometry in shapes.items()}
    return {name: next(k for k, one in about.items() if one.equals_exact(own, _SAME)) for name, own in about.items()}


def _together(laid: Sequence[Laid], shapes: Mapping[str, BaseGeometry], room: Room) -> list[Laid]:
    """The pieces of a board, slid together."""
    from shapely.affinity import rotate, translate

    placed = [translate(rotate(shapes[x.shape], 90 * x.turn, origin=(0, 0)), x.at.real, x.at.imag) for x in laid]
    moved = slid(placed, room.margin * (1 + 1j), room.gap)
    return [replace(x, at=x.at + by) for x, by in zip(laid, moved.tolist(), strict=True)]


class _Nest:
    """The tables of one layout."""

    def __init__(self, shapes: Mapping[str, tuple[BaseGeometry, int]], room: Room) -> None:
        self.room = room
        self.inner = room.inner
        self.counts = {name: count for name, (_, count) in shapes.items()}
        filled = sum(geometry.area * count for geometry, count in shapes.values())
        self.many = filled > _FEW_BOARDS * self.inner.real * self.inner.imag
        sizes = [_size(geometry) for geometry, _ in shapes.values()]
        spans = np.array([max(size.real, size.imag) + room.gap for size in sizes])
        # squares about all pairs of shapes in all turns to each other, of which each is looked at cell by cell
        pairs = len(room.turns) * float(np.square(spans[:, None] + spans).sum())
        longer = max(room.width, room.height)
        self.cell = min(max(math.sqrt(pairs / _TABLES), longer / _FINEST), longer / _COARSEST)
        self.grown: dict[str, Flags] = {}
        self.turned = {name: self._turns(name, geometry) for name, (geometry, _) in shapes.items()}
        self.tables: dict[tuple[str, int, str, int], _Table] = {}
        self.empty = {(name, turn): self._empty(one) for name, x in self.turned.items() for turn, one in x.items()}

    def _turns(self, name: str, geometry: BaseGeometry) -> dict[int, _Shape]:
        """A shape in all turns in which it fits."""
        from shapely.affinity import rotate

        middle, half, about = _middle(geometry), _size(geometry) / 2, _about(geometry)
        halves, turns = (half, _turned(half, 1)), self.room.turns
        if not any(self._has_room(halves[turn % 2]) for turn in turns):
            raise DoesNotFitError(name, (2 * half.real, 2 * half.imag))
        # a shape that has room but no place on the grid stands beside it by half a cell each way at most
        tight = any(len(self._places(h, axis)) == 0 for h in halves for axis in (0, 1) if self._has_room(h))
        more = self.cell / math.sqrt(2) if tight else 0.0
        self.grown[name] = self._cover(about, half, self.room.gap + more)
        cover = self._cover(about, half, more)
        reach = np.hypot(*np.array(about.convex_hull.exterior.coords).T).max()
        if reach <= _ROUND * min(half.real, half.imag):
            # one turn is as good as another, but chords may leave room in one alone
            turns = next((turn,) for turn in turns if self._has_room(halves[turn % 2]))
        found: dict[int, _Shape] = {}
        for turn in turns:
            size = halves[turn % 2]
            if not self._has_room(size):
                continue
            turned = rotate(about, 90 * turn, origin=(0, 0)) if turn else about
            if any(turned.symmetric_difference(s.geometry).area <= _SYMMETRIC * turned.area for s in found.values()):
                continue
            found[turn] = _Shape(turned, middle * 1j**turn, size, np.rot90(cover, turn, axes=(0, 1)))
        return found

    def _has_room(self, half: complex) -> bool:
        return 2 * half.real <= self.inner.real and 2 * half.imag <= self.inner.imag

    def _places(self, half: complex, axis: int) -> range:
        """Where on the grid the middle of a shape may stand along an axis."""
        own, inner = (half.real, half.imag)[axis], (self.inner.real, self.inner.imag)[axis]
        return range(math.ceil(own / self.cell - 1e-9), math.floor((inner - own) / self.cell + 1e-9) + 1)

    def _at(self, half: complex, x: int, y: int) -> complex:
        """Where the middle of a shape stands, mm: in its place on the grid, or beside it where the room is tight."""
        last = self.inner - half
        real, imag = max(half.real, x * self.cell), max(half.imag, y * self.cell)
        return complex(min(real, last.real), min(imag, last.imag))

    def _cover(self, geometry: BaseGeometry, half: complex, more: float) -> Flags:
        """Cells (x, y) about the origin that hold all of a geometry, grown by ``more`` mm."""
        import shapely

        grown = geometry.buffer(more + self.cell / math.sqrt(2) * 1.001, quad_segs=16)
        counts = [math.ceil((size + more) / self.cell) + 1 for size in (half.real, half.imag)]
        x, y = (np.arange(-n, n + 1) * self.cell for n in counts)
        shapely.prepare(grown)
        # squares of cells, a little wider than they are, lie within or without but along the border
        step = _SQUARE * self.cell
        left, low = x[::_SQUARE, None], y[::_SQUARE]
        squares = shapely.box(*np.broadcast_arrays(left, low, left + step, low + step))
        within = shapely.contains_properly(grown, squares)
        found, border = (
            np.repeat(np.repeat(flags, _SQUARE, axis=0), _SQUARE, axis=1)[: len(x), : len(y)]
            for flags in (within, shapely.intersects(grown, squares) & ~within)
        )
        at = np.nonzero(border)
        found[at] = shapely.contains_xy(grown, x[at[0]], y[at[1]])
        return found

    def table(self, one: tuple[str, int], two: tuple[str, int]) -> _Table:
        """Steps (x, y) about the middle from shape ``one`` to shape ``two`` at which they are too near."""
        name, turn = one
        other, turned = two
        if (name, turn, other, turned) not in self.tables:
            first = self.grown[name]
            second = np.rot90(self.turned[other][turned].cover, -turn, axes=(0, 1))
            near = _sums(first, second[::-1, ::-1])
            for quarter in range(4):
                self.tables[name, quarter, other, (turned - turn + quarter) % 4] = _Table(
                    np.ascontiguousarray(np.rot90(near, quarter, axes=(0, 1)))
                )
        return self.tables[name, turn, other, turned]

    def laid(self) -> list[Laid]:
        """The better of two searches, from the best order and from the worst: each exchanges two pieces at a time."""
        shapes = {name: next(iter(turns.values())) for name, turns in self.turned.items()}
        size = {name: shape.geometry.convex_hull.area for name, shape in shapes.items()}
        reach = {name: max(shape.half.real, shape.half.imag) for name, shape in shapes.items()}
        breadth = {name: min(shape.half.real, shape.half.imag) for name, shape in shapes.items()}
        pieces = [name for name, count in self.counts.items() for _ in range(count)]
        orders = [sorted(pieces, key=lambda name: -by[name]) for by in (size, reach, breadth)]
        # one set after the other, as nearly as the counts allow
        shares = [((k + 1) / count, -size[name], name) for name, count in self.counts.items() for k in range(count)]
        orders.append([name for _, _, name in sorted(shares)])
        begun = sorted(filter(None, map(self._packed, orders)), key=lambda found: found.rank)
        return min((self._better(one) for one in (begun[0], begun[-1])), key=lambda found: found.rank).laid

    def _better(self, best: _Layout) -> _Layout:
        """The best of a fixed number of layouts about one."""
        pieces = best.order
        cells = np.mean([math.prod(t.shape) for t in self.tables.values()]) if len(self.counts) > 1 else math.inf
        trials = _WORK / 2 / (len(pieces) * sum(map(len, self.turned.values())) * cells)
        chance = _Chance()
        # as the best rank only falls, an order that was no better is none later
        worse: set[tuple[str, ...]] = set()
        for _ in range(min(int(trials), _TRIALS * len(pieces))):
            order = list(best.order)
            one = two = chance.below(len(order))
            while order[one] == order[two]:
                two = chance.below(len(order))
            order[one], order[two] = order[two], order[one]
            if tuple(order) in worse:
                continue
            found = self._packed(order, best.rank)
            if found is not None and found.rank <= best.rank:
                best = found
            else:
                worse.add(tuple(order))
        return best

    def _packed(self, order: Sequence[str], than: tuple[float, float, float] = _NOTHING) -> _Layout | None:
        """All pieces in an order, each where it lies farthest to the left, board by board; None: no better ``than``."""
        left = list(order)
        found: list[Laid] = []
        end, board = 0.0, 0
        while left:
            here, left, end = self._board(board, left, than[1] if board + 1 == than[0] else math.inf)
            found += here
            board += 1
            if self.many and left:
                used, rest = Counter(one.shape for one in here), Counter(left)
                times = min(rest[name] // count for name, count in used.items())
                found += [replace(one, board=board + k) for k in range(times) for one in here]
                left = _without(left, {name: times * count for name, count in used.items()})
                board += times
            if board > than[0] or (board == than[0] and (left or end > than[1])):
                return None
        ends = sorted((one.at.real for one in found if one.board == board - 1), reverse=True)
        return _Layout(tuple(order), found, (board, round(end, 6), sum(ends)))

    def _board(self, board: int, order: Sequence[str], most: float) -> tuple[list[Laid], list[str], float]:
        """What lies on one board, what is left, and how far it reaches, mm; no more once that is above ``most``."""
        names = dict.fromkeys(order)
        counts = {name: order.count(name) for name in names}
        taken = {(name, turn): self.empty[name, turn].copy() for name in names for turn in self.turned[name]}
        laid, left, end = [], [], 0.0
        full: set[str] = set()
        for name in order:
            counts[name] -= 1
            found = () if name in full else (self._first(taken, name, turn) for turn in self.turned[name])
            best = min(filter(None, found), default=None)
            if best is None:
                full.add(name)
                left.append(name)
                continue
            (right, _), turn, (x, y) = best
            end = max(end, right)
            if end > most:
                break
            shape = self.turned[name][turn]
            at = self._at(shape.half, x, y) + self.room.margin * (1 + 1j) - shape.middle
            laid.append(Laid(name, board, turn, at))
            for (other, way), places in taken.items():
                if counts[other] and other not in full:
                    self.table((name, turn), (other, way)).stamp(places, x, y)
        return laid, left, end

    def _empty(self, shape: _Shape) -> Bits:
        """Where the middle of a shape may not stand on an empty board."""
        inner = self.inner.real, self.inner.imag
        across, along = (math.floor(size / self.cell + 1e-9) + 1 for size in inner)
        places = np.ones((across, math.ceil(along / _WORD) * _WORD), dtype=bool)
        # where the room is tight, the place next to the middle of the board
        near = [round(size / 2 / self.cell) for size in inner]
        xs, ys = (self._places(shape.half, axis) or range(near[axis], near[axis] + 1) for axis in (0, 1))
        places[xs.start : xs.stop, ys.start : ys.stop] = False
        return np.packbits(places, axis=1)

    def _first(
        self, taken: Mapping[tuple[str, int], Bits], name: str, turn: int
    ) -> tuple[tuple[float, int], int, tuple[int, int]] | None:
        """The leftmost and then lowest free place of a shape in a turn, and by what it is compared with others."""
        places = taken[name, turn]
        x, y = divmod(int((places.view(np.uint64) != _TAKEN).argmax()) * _WORD, 8 * places.shape[1])
        bits = np.unpackbits(places[x, y // 8 : (y + _WORD) // 8])
        if bits.all():
            return None
        y += int(bits.argmin())
        return (x * self.cell + self.turned[name][turn].half.real, y), turn, (x, y)


class _Table:
    """Steps (x, y) about the middle from one shape to another at which they are too near."""

    def __init__(self, near: Flags) -> None:
        self.shape = near.shape
        # by the bit of their first byte at which the rows begin, with a byte for what that shifts out
        self.begun: dict[int, Bits] = {0: np.pad(np.packbits(near, axis=1), ((0, 0), (0, 1)))}

    def stamp(self, places: Bits, x: int, y: int) -> None:
        """What is too near to a piece at x, y is taken."""
        left, (low, bit) = x - self.shape[0] // 2, divmod(y - self.shape[1] // 2, 8)
        if bit not in self.begun:
            self.begun[bit] = self.begun[0] >> np.uint8(bit)
            self.begun[bit][:, 1:] |= self.begun[0][:, :-1] << np.uint8(8 - bit)
        table = self.begun[bit]
        here = slice(max(left, 0), left + table.shape[0]), slice(max(low, 0), low + table.shape[1])
        part = places[here]
        part |= table[here[0].start - left :, here[1].start - low :][: part.shape[0], : part.shape[1]]


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


def _without(order: Sequence[str], counts: Mapping[str, int]) -> list[str]:
    """An order without the first so many of each name."""
    spent = dict(counts)
    left = []
    for name in order:
        if spent.get(name, 0):
            spent[name] -= 1
        else:
            left.append(name)
    return left


def _sums(first: Flags, second: Flags) -> Flags:
    """Cells that are a cell of one cover and one of another, added."""
    size = first.shape[0] + second.shape[0] - 1, first.shape[1] + second.shape[1] - 1
    cells = math.prod(size)
    (begin, end), (start, stop) = (_runs(cover, size[1]) for cover in (first, second))
    if len(begin) * len(start) > _PAIRS * cells:
        # of covers full of holes a transform is the shorter way
        fast = _fast(size[0]), _fast(size[1])
        spectrum = np.fft.rfft2(first, fast) * np.fft.rfft2(second, fast)
        return np.fft.irfft2(spectrum, fast)[: size[0], : size[1]] >= 0.5
    # a run and a run are a run: how many have begun before a cell, less those that have ended
    over = np.bincount(np.add.outer(begin, start).ravel(), minlength=cells + 1)
    over -= np.bincount(np.add.outer(end, stop - 1).ravel(), minlength=cells + 1)
    return (np.cumsum(over)[:cells] > 0).reshape(size)


def _runs(cover: Flags, width: int) -> tuple[Indices, Indices]:
    """Where runs of taken cells along y begin, and where they have ended, in rows of a width one after the other."""
    steps = np.diff(np.pad(cover, ((0, 0), (1, 1))).view(np.int8), axis=1)
    begin, end = (np.nonzero(steps == side) for side in (1, -1))
    return begin[0] * width + begin[1], end[0] * width + end[1]


def _fast(count: int) -> int:
    """The next length of which a transform is fast."""
    return min(factor << (-(-count // factor) - 1).bit_length() for factor in (1, 3, 5, 9, 15))
