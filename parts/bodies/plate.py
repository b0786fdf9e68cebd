"""The part kind ``plate``: a flat body with holes and slots, and what every flat body of lines and arcs shares."""

from __future__ import annotations

import math
import re
from bisect import bisect_left
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, Annotated, TypeVar

from msgspec import Meta, Struct, field
from msgspec.structs import replace

from geometry.base.errors import Nearest, ParameterError, limit, rounded
from geometry.base.nearest import last_that_holds
from geometry.base.record import replace as changed
from geometry.base.tolerance import LEAST_LENGTH
from parts.base.kind import HoleAt, Kind, Others
from parts.keys.base import MOST_LENGTH, MadeKeys, check_idle, in_vain, mm, part_mm
from parts.keys.engraving import Depth, Marks, check_depth, marked

if TYPE_CHECKING:
    from geometry.plane.offset_region import OffsetRegion
    from geometry.solids.body import Body
    from geometry.solids.plate import Edge, PlateOutline, PlateSlot

_Place = Annotated[float, part_mm("a coordinate", least=-MOST_LENGTH)]


# mm: the thinnest wall between holes of a grid, three times what rounding takes
_WALL = 3e-6
# holes of one grid
_MOST_HOLES = 1000
_COLUMNS = Meta(
    ge=1,
    le=_MOST_HOLES,
    description="a grid of equal holes: how many along x, the first one at `at`, or all about the axle of `axis_of`",
)
_ROWS = Meta(ge=1, le=_MOST_HOLES, description="how many along y")
_PITCH = part_mm("of a grid: from each hole to the next along x", above=0, example=25.0)
_ROW_PITCH = part_mm("the same along y; default: pitch", above=0, example=25.0)


_AXIS_OF = Meta(min_length=1, description="the instance whose axle it takes, in place of at")


class HoleAtTable(Struct, forbid_unknown_fields=True):
    """A round hole anywhere, or on the axis of an instance; or a grid of them."""

    diameter: Annotated[float, part_mm("diameter of the hole", above=0)]
    at: Annotated[tuple[_Place, _Place], mm("x, y of its centre")] | None = None
    axis_of: Annotated[str, _AXIS_OF] | None = None
    columns: Annotated[int, _COLUMNS] = 1
    rows: Annotated[int, _ROWS] = 1
    pitch: Annotated[float, _PITCH] | None = None
    row_pitch: Annotated[float, _ROW_PITCH] | None = None

    @property
    def count(self) -> int:
        """How many holes there are."""
        return self.columns * self.rows

    @property
    def least_pitch(self) -> float:
        """From hole to hole where the thinnest wall is left, mm; a third of it is for what rounding takes."""
        return rounded(self.diameter + _WALL, up=True, digits=6)

    @property
    def steps(self) -> tuple[float, float]:
        """From hole to hole along x and along y, mm."""
        return self.pitch or self.row_pitch or 0.0, self.row_pitch or self.pitch or 0.0

    def centres(self) -> list[complex]:
        """Where its holes stand, row by row; none while its axle is not known, which a grid has in its middle."""
        if self.at is None:
            return []
        x, y = self.steps
        first = complex(*self.at)
        if self.axis_of is not None:
            first -= complex((self.columns - 1) * x, (self.rows - 1) * y) / 2
        return [first + complex(i * x, j * y) for j in range(self.rows) for i in range(self.columns)]


class SlotTable(Struct, forbid_unknown_fields=True):
    """A slot with round ends, between the centres of its ends."""

    start: Annotated[tuple[_Place, _Place], mm("x, y of one end's centre")]
    end: Annotated[tuple[_Place, _Place], mm("x, y of the other end's centre")]
    width: Annotated[float, part_mm("width of the slot", above=0)]


class EngravedTable(SlotTable, forbid_unknown_fields=True):
    """A slot that does not go through: a mark, a pointer."""

    depth: Depth = 0.4


HolesAt = Annotated[list[HoleAtTable], Meta(max_length=1000, examples=[[{"at": [0.0, 20.0], "diameter": 3.0}]])]
Slots = Annotated[
    list[SlotTable],
    Meta(max_length=1000, examples=[[{"start": [0.0, 28.0], "end": [0.0, 36.0], "width": 3.0}]]),
]

_ENGRAVED = Meta(
    max_length=1000,
    description="slots in the upper face, not cut",
    examples=[[{"start": [20.0, 0.0], "end": [28.0, 0.0], "width": 1.0}]],
)


class FlatKeys(MadeKeys, kw_only=True):
    """Keys of every flat body of lines and arcs."""

    holes: HolesAt = field(default_factory=list)
    slots: Slots = field(default_factory=list)
    engraved: Annotated[list[EngravedTable], _ENGRAVED] = field(default_factory=list)


_BEYOND_AXLES = part_mm(
    "least distance from each hole of an axle (`axis_of`) to the edge: the plate grows as they need it",
    above=0,
    example=10.0,
)


_STROKES = Meta(
    max_length=100,
    description="lines through points x, y that a laser engraves in single strokes; a closed one ends where it begins",
    examples=[[[[-20.0, -30.0], [0.0, -20.0], [20.0, -30.0]]]],
)
_Stroke = Annotated[list[tuple[_Place, _Place]], Meta(min_length=2, max_length=4000)]


class PlateSpec(FlatKeys, forbid_unknown_fields=True, tag_field="kind", tag="plate"):
    """Keys of ``plate``."""

    width: Annotated[float, part_mm("along x", above=0, example=60.0)]
    height: Annotated[float, part_mm("along y", above=0, example=90.0)]
    centre: Annotated[tuple[_Place, _Place], mm("x, y of the middle")] = (0.0, 0.0)
    corner_radius: Annotated[float, part_mm("rounding of the corners", least=0)] = 0.0
    beyond_axles: Annotated[float, _BEYOND_AXLES] | None = None
    strokes: Annotated[list[_Stroke], _STROKES] = field(default_factory=list)


def checked_outline(
    edges: tuple[Edge, ...], keys: FlatKeys, own: Sequence[tuple[str, complex, float]] = ()
) -> PlateOutline:
    """Edges with the holes and slots of a part's keys, checked one after the other; ``own``: key, centre, diameter."""
    from geometry.solids.plate import PlateOutline

    whole, names = outline_with_marks(edges, keys, own)
    try:
        whole.check_holes(names)
    except ParameterError as refusal:
        raise _by_place(keys, refusal, partial(_holds, edges, own)) from refusal
    for number, mark in enumerate(keys.engraved, 1):
        check_depth(f"engraved[{number}]", mark.depth, keys.face_width)
    return PlateOutline(edges, whole.holes[: len(names) - len(keys.engraved)])


def outline_with_marks(
    edges: tuple[Edge, ...], keys: FlatKeys, own: Sequence[tuple[str, complex, float]] = ()
) -> tuple[PlateOutline, list[str]]:
    """Edges with all that the keys cut and, behind that, engrave, not yet checked; and the key of each one's size."""
    from geometry.solids.plate import PlateHole, PlateOutline

    for number, table in enumerate(keys.holes, 1):
        if table.count > 1 or table.pitch is not None or table.row_pitch is not None:
            _check_grid(keys, number, partial(_holds, edges, own))
    # a hole for an axle comes when that stands
    placed = [(i, PlateHole(at, h.diameter)) for i, h in enumerate(keys.holes, 1) for at in h.centres()]
    holes = (*(PlateHole(at, d) for _, at, d in own), *(hole for _, hole in placed))
    names = [*(key for key, _, _ in own), *(f"holes[{i}].diameter" for i, _ in placed)]
    slots, marks = (_slots(key, getattr(keys, key), names) for key in ("slots", "engraved"))
    return PlateOutline(edges, (*holes, *slots, *marks)), names


def _with_hole(keys: FlatKeys, number: int, key: str, value: float) -> FlatKeys:
    """The keys, one of a table of holes of another value."""
    holes = [replace(table, **{key: value}) if k == number else table for k, table in enumerate(keys.holes, 1)]
    return replace(keys, holes=holes)


def _check_grid(keys: FlatKeys, number: int, holds: Callable[[FlatKeys], bool]) -> None:
    """Refuse a grid of holes that do not know their pitch or meet, and keys of a grid where there is none.

    Raises
    ------
    ParameterError
        With the key.
    """
    table, place = keys.holes[number - 1], f"holes[{number}]"
    if table.count > _MOST_HOLES:
        fewer, more = sorted(("columns", "rows"), key=lambda many: int(getattr(table, many)))
        cure = partial(_most_holes, keys, number, holds, more, _MOST_HOLES // getattr(table, fewer))
        raise ParameterError(f"{place}.{more}", getattr(table, more), "grid_of_too_many_holes", cure, most=_MOST_HOLES)
    least = table.least_pitch
    pitches = {"pitch": (table.pitch, "columns"), "row_pitch": (table.row_pitch, "rows")}
    for (key, (pitch, many)), step in zip(pitches.items(), table.steps, strict=True):
        count = getattr(table, many)
        # one pitch serves both ways
        if pitch is not None and count == 1 and (key == "row_pitch" or table.rows == 1):
            raise ParameterError(f"{place}.{key}", pitch, "only_of_a_grid", Nearest(None), key=many)
        if count == 1:
            continue
        if step == 0:
            raise ParameterError(f"{place}.pitch", None, "grid_needs_pitch", count=count)
        if step < least:
            typed = key if pitch is not None or table.pitch is None else "pitch"
            if holds(_with_hole(keys, number, typed, least)):
                raise ParameterError(f"{place}.{typed}", step, "grid_holes_meet", Nearest(least, "at_least"))
            # no pitch is wide enough within the edges
            smaller = partial(_works, keys, number, holds, "diameter")
            most = min(s for s, n in zip(table.steps, (table.columns, table.rows), strict=True) if n > 1)
            most -= _WALL
            if most <= LEAST_LENGTH or not smaller(LEAST_LENGTH):
                raise ParameterError(f"{place}.{typed}", step, "grid_holes_meet")
            most = most if smaller(most) else last_that_holds(smaller, most, LEAST_LENGTH, steps=30)
            raise ParameterError.beyond(f"{place}.diameter", table.diameter, "grid_holes_meet", most, digits=6)


def _holds(edges: tuple[Edge, ...], own: Sequence[tuple[str, complex, float]], keys: FlatKeys) -> bool:
    """Whether edges have room for all that the keys cut and engrave."""
    try:
        whole, names = outline_with_marks(edges, keys, own)
        whole.check_holes(names)
    except ParameterError:
        return False
    return True


def _works(keys: FlatKeys, number: int, holds: Callable[[FlatKeys], bool], key: str, value: float) -> bool:
    """Whether a table of holes has room with another value of a key."""
    return holds(_with_hole(keys, number, key, value))


def _most_holes(keys: FlatKeys, number: int, holds: Callable[[FlatKeys], bool], key: str, most: int) -> Nearest | None:
    """So many columns, or rows, have room, of at most so many."""
    works = partial(_works, keys, number, holds, key)
    found = bisect_left(range(1, most + 1), True, key=lambda n: not works(n))
    return Nearest(found, "at_most") if found else None


def _grid_outside(keys: FlatKeys, number: int, holds: Callable[[FlatKeys], bool]) -> ParameterError:
    """The refusal of a grid that does not lie inside as a whole: by the first of its keys that alone can cure it."""
    table, place = keys.holes[number - 1], f"holes[{number}]"
    works = partial(_works, keys, number, holds)
    for key in ("columns", "rows"):
        given = getattr(table, key)
        if (most := _most_holes(keys, number, holds, key, given - 1)) is not None:
            return ParameterError(f"{place}.{key}", given, "grid_lies_outside", most)
    # one that serves both ways may cure what neither number does, and one of its own what leaves no second row
    least = table.least_pitch
    for key, step in (("pitch", table.pitch), ("row_pitch", table.row_pitch)):
        if step is not None and works(key, least):
            found = limit(last_that_holds(partial(works, key), step, least, steps=30), step, digits=6)
            return ParameterError(f"{place}.{key}", step, "grid_lies_outside", found)
    return ParameterError(f"{place}.at", [*(table.at or ())], "grid_lies_outside")


def _by_place(
    keys: FlatKeys, refusal: ParameterError, holds: Callable[[FlatKeys], bool] = lambda _: False
) -> ParameterError:
    """A refusal of what lies wrong in the key of its place, not of its size; a hole for an axle cannot be moved."""
    found = re.fullmatch(r"(?P<place>(?P<key>holes|slots|engraved)\[(?P<number>\d+)\])\.\w+", refusal.name)
    if found is None:
        return refusal
    table = getattr(keys, found["key"])[int(found["number"]) - 1]
    outside = refusal.code == "hole_lies_outside"
    on_axle = isinstance(table, HoleAtTable) and table.axis_of is not None and (outside or table.count == 1)
    if on_axle and table.at is not None:
        x, y = (round(value, 4) + 0.0 for value in table.at)
        told = {"axle": table.axis_of, "x": x, "y": y}
        return ParameterError(f"{found['place']}.axis_of", table.axis_of, "hole_of_axle_outside", **told)
    if not outside:
        return refusal
    if isinstance(table, HoleAtTable) and table.count > 1:
        return _grid_outside(keys, int(found["number"]), holds)
    if isinstance(table, SlotTable):
        return ParameterError(found["place"], {"start": [*table.start], "end": [*table.end]}, refusal.code)
    return ParameterError(f"{found['place']}.at", [*table.at], refusal.code)


def _slots(key: str, tables: Sequence[SlotTable], names: list[str]) -> tuple[PlateSlot, ...]:
    """Slots between two places; ``names`` gets the key of each one's size."""
    from geometry.solids.plate import PlateSlot

    for number, table in enumerate(tables, 1):
        if table.start == table.end:
            raise ParameterError(f"{key}[{number}].end", list(table.end), "slot_ends_at_start")
        names.append(f"{key}[{number}].width")
    return tuple(PlateSlot(complex(*t.start), complex(*t.end), t.width) for t in tables)


K = TypeVar("K", bound=FlatKeys)
T = TypeVar("T")


def _marks(keys: FlatKeys) -> Marks:
    """What is engraved."""
    slots = _slots("engraved", keys.engraved, [])
    return [(slot.profile(0.0), table.depth) for slot, table in zip(slots, keys.engraved, strict=True)]


class Extruded(Kind[K, T]):
    """An outline of lines and arcs that is extruded as it is, lower face at z = 0."""

    drawing = "parts.bodies.plate_drawing"
    data_table = "parts.bodies.data_tables"

    def flat(self, thing: T) -> PlateOutline:
        """The outline of the exact thing."""
        raise NotImplementedError

    def holes_at(self, keys: K) -> Sequence[HoleAt]:
        """Its holes; those for axles get their places when these stand."""
        waiting: list[complex | None] = [None]
        return [HoleAt(at, h.diameter, h.axis_of, h.count > 1) for h in keys.holes for at in h.centres() or waiting]

    def section(self, keys: K, thing: T, offset: float) -> OffsetRegion:
        """The outline moved, and what is engraved in it."""
        return marked(self.flat(thing).region(offset), _marks(keys))

    def solid(self, keys: K, thing: T, offset: float) -> Body:
        """The outline, extruded and engraved."""
        from geometry.solids.body import plate
        from geometry.solids.engraving import engraved

        body = plate(self.flat(thing).region(offset).region, 0.0, keys.face_width)
        return engraved(body, _marks(keys), keys.face_width)


class Flat(Extruded[K, "PlateOutline"]):
    """A kind whose thing is an outline and nothing else."""

    def flat(self, thing: PlateOutline) -> PlateOutline:
        """The thing itself."""
        return thing


def _box(keys: PlateSpec) -> tuple[complex, complex]:
    """Lowest and highest corner: of the given sides, and as far beyond the holes of axles as asked for."""
    low, high = (complex(*keys.centre) + sign * complex(keys.width, keys.height) / 2 for sign in (-1, 1))
    if keys.beyond_axles is not None:
        beyond = keys.beyond_axles * (1 + 1j)
        for at in (at for hole in keys.holes if hole.axis_of is not None for at in hole.centres()):
            one, two = at - beyond, at + beyond
            low = complex(min(low.real, one.real), min(low.imag, one.imag))
            high = complex(max(high.real, two.real), max(high.imag, two.imag))
    return low, high


class Plate(Flat[PlateSpec]):
    """A rectangular plate with holes and slots."""

    name, keys = "plate", PlateSpec
    # linkages have plates among others
    mate_shown = "fixed"

    def idle(self, keys: PlateSpec, others: Others) -> Iterator[ParameterError]:
        """How far it goes beyond holes of axles where it has none."""
        if all(hole.axis_of is None for hole in keys.holes):
            yield from in_vain(keys, ("beyond_axles",), other="holes.axis_of")

    def thing(self, keys: PlateSpec, others: Others) -> PlateOutline:
        """The outline, checked: holes that keep their walls, else the side that is long enough for those of axles."""
        check_idle(self.idle(keys, others))
        try:
            return self._outline(keys)
        except ParameterError as refusal:
            if refusal.code != "hole_of_axle_outside":
                raise
            for side, given in (("width", keys.width), ("height", keys.height)):
                if (works := self._least(keys, side, given)) is not None:
                    raise ParameterError(side, given, refusal.code, works, **refusal.numbers) from refusal
            raise

    def _least(self, keys: PlateSpec, side: str, given: float) -> Nearest | None:
        """The least length of a side that holds all holes; None where none does."""

        def fits(value: float) -> bool:
            try:
                self._outline(replace(keys, **{side: value}))
            except ParameterError:
                return False
            return True

        ways = ((at - complex(*keys.centre), h.diameter) for h in keys.holes for at in h.centres())
        reach = max(max(abs(way.real), abs(way.imag)) + diameter for way, diameter in ways)
        most = min(max(given, 2 * reach), MOST_LENGTH)
        return limit(last_that_holds(fits, given, most, steps=30), given) if fits(most) else None

    def _outline(self, keys: PlateSpec) -> PlateOutline:
        """The outline, checked: roundings that the sides have room for, holes that keep their walls."""
        from geometry.solids.plate import rounded

        most = min(keys.width, keys.height) / 2
        if keys.corner_radius > most:
            raise ParameterError("corner_radius", keys.corner_radius, "rounding_above_half_side", limit(most, math.inf))
        low, high = _box(keys)
        corners = [low, complex(high.real, low.imag), high, complex(low.real, high.imag)]
        self._check_strokes(keys, low, high)
        return checked_outline(rounded([(c, keys.corner_radius) for c in corners]), keys)

    def _check_strokes(self, keys: PlateSpec, low: complex, high: complex) -> None:
        """No stroke leaves the plate."""
        inner = (1 + 1j) * keys.corner_radius
        for number, stroke in enumerate(keys.strokes, 1):
            for at in (complex(*point) for point in stroke):
                near, far = low + inner, high - inner
                held = complex(min(max(at.real, near.real), far.real), min(max(at.imag, near.imag), far.imag))
                if abs(at - held) > keys.corner_radius:
                    raise ParameterError(f"strokes[{number}]", [at.real, at.imag], "stroke_leaves_plate")

    def section(self, keys: PlateSpec, thing: PlateOutline, offset: float) -> OffsetRegion:
        """The outline moved, what is engraved in it, and strokes, which no offset moves."""
        made = super().section(keys, thing, offset)
        strokes = tuple(tuple(complex(*point) for point in stroke) for stroke in keys.strokes)
        return changed(made, region=changed(made.region, strokes=strokes)) if strokes else made


PLATE = Plate()
