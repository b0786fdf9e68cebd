"""The part kind ``plate``: a flat body with holes and slots, and what every flat body of lines and arcs shares."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, TypeVar

from msgspec import Meta, Struct, field
from msgspec.structs import replace

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.nearest import last_that_holds
from parts.base.kind import HoleAt, Kind, Others
from parts.keys.base import MOST_LENGTH, MadeKeys, mm, part_mm
from parts.keys.engraving import Depth, Marks, check_depth, marked

if TYPE_CHECKING:
    from geometry.plane.offset_region import OffsetRegion
    from geometry.solids.body import Body
    from geometry.solids.plate import Edge, PlateOutline, PlateSlot

_Place = Annotated[float, part_mm("a coordinate", least=-MOST_LENGTH)]


class HoleAtTable(Struct, forbid_unknown_fields=True):
    """A round hole anywhere, or on the axis of an instance."""

    diameter: Annotated[float, part_mm("diameter of the hole", above=0)]
    at: Annotated[tuple[_Place, _Place], mm("x, y of its centre")] | None = None
    axis_of: Annotated[str, Meta(description="the instance whose axle it takes, in place of at")] | None = None


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


class PlateSpec(FlatKeys, forbid_unknown_fields=True, tag_field="kind", tag="plate"):
    """Keys of ``plate``."""

    width: Annotated[float, part_mm("along x", above=0, example=60.0)]
    height: Annotated[float, part_mm("along y", above=0, example=90.0)]
    centre: Annotated[tuple[_Place, _Place], mm("x, y of the middle")] = (0.0, 0.0)
    corner_radius: Annotated[float, part_mm("rounding of the corners", least=0)] = 0.0
    beyond_axles: Annotated[float, _BEYOND_AXLES] | None = None


def checked_outline(
    edges: tuple[Edge, ...], keys: FlatKeys, own: Sequence[tuple[str, complex, float]] = ()
) -> PlateOutline:
    """Edges with the holes and slots of a part's keys, checked one after the other; ``own``: key, centre, diameter."""
    from geometry.solids.plate import PlateOutline

    whole, names = outline_with_marks(edges, keys, own)
    try:
        whole.check_holes(names)
    except ParameterError as refusal:
        raise _by_place(keys, refusal) from refusal
    for number, mark in enumerate(keys.engraved, 1):
        check_depth(f"engraved[{number}]", mark.depth, keys.face_width)
    return PlateOutline(edges, whole.holes[: len(names) - len(keys.engraved)])


def outline_with_marks(
    edges: tuple[Edge, ...], keys: FlatKeys, own: Sequence[tuple[str, complex, float]] = ()
) -> tuple[PlateOutline, list[str]]:
    """Edges with all that the keys cut and, behind that, engrave, not yet checked; and the key of each one's size."""
    from geometry.solids.plate import PlateHole, PlateOutline

    # a hole for an axle comes when that stands
    placed = {i: PlateHole(complex(*h.at), h.diameter) for i, h in enumerate(keys.holes, 1) if h.at is not None}
    holes = (*(PlateHole(at, d) for _, at, d in own), *placed.values())
    names = [*(key for key, _, _ in own), *(f"holes[{i}].diameter" for i in placed)]
    slots, marks = (_slots(key, getattr(keys, key), names) for key in ("slots", "engraved"))
    return PlateOutline(edges, (*holes, *slots, *marks)), names


def _by_place(keys: FlatKeys, refusal: ParameterError) -> ParameterError:
    """A refusal of what lies wrong in the key of its place, not of its size; a hole for an axle cannot be moved."""
    found = re.fullmatch(r"(?P<place>(?P<key>holes|slots|engraved)\[(?P<number>\d+)\])\.\w+", refusal.name)
    if found is None:
        return refusal
    table = getattr(keys, found["key"])[int(found["number"]) - 1]
    if isinstance(table, HoleAtTable) and table.axis_of is not None and table.at is not None:
        x, y = (round(value, 4) + 0.0 for value in table.at)
        told = {"axle": table.axis_of, "x": x, "y": y}
        return ParameterError(f"{found['place']}.axis_of", table.axis_of, "hole_of_axle_outside", **told)
    if refusal.code != "hole_lies_outside":
        return refusal
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
        return [HoleAt(None if h.at is None else complex(*h.at), h.diameter, h.axis_of) for h in keys.holes]

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
        for at in (complex(*hole.at) for hole in keys.holes if hole.axis_of is not None and hole.at is not None):
            one, two = at - beyond, at + beyond
            low = complex(min(low.real, one.real), min(low.imag, one.imag))
            high = complex(max(high.real, two.real), max(high.imag, two.imag))
    return low, high


class Plate(Flat[PlateSpec]):
    """A rectangular plate with holes and slots."""

    name, keys = "plate", PlateSpec
    # linkages have plates among others
    mate_shown = "fixed"

    def thing(self, keys: PlateSpec, others: Others) -> PlateOutline:
        """The outline, checked: holes that keep their walls, else the side that is long enough for those of axles."""
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

        reach = max(abs(a - c) + h.diameter for h in keys.holes if h.at for a, c in zip(h.at, keys.centre, strict=True))
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
        return checked_outline(rounded([(c, keys.corner_radius) for c in corners]), keys)


PLATE = Plate()
