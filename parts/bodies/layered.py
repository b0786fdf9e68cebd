"""The part kind ``layered``: an upright body of layers, each within its own contours: housings, counterbores, cages."""

from __future__ import annotations

import cmath
import itertools
import math
from contextlib import suppress
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta, Struct, field
from msgspec.structs import replace

from geometry.base.errors import GeometryError, ParameterError, limit
from parts.base.kind import Kind, Others, Report
from parts.base.part_keys import MaterialKeys
from parts.base.schema import value_at
from parts.base.texts import N_
from parts.bodies.plate import Slots
from parts.keys.base import MOST_LENGTH, mm, part_mm, start
from parts.keys.holes import AcrossFlats, CornerRadius, Direction

if TYPE_CHECKING:
    from geometry.curves.line_arc import Arc
    from geometry.plane.offset_region import OffsetRegion
    from geometry.solids.body import Body
    from geometry.solids.layers import Contour, Layers

_Place = Annotated[float, part_mm("a coordinate", least=-MOST_LENGTH)]


class CircleTable(Struct, forbid_unknown_fields=True):
    """A circle: an outline or a hole, by how many contours it lies in."""

    diameter: Annotated[float, part_mm("diameter of the circle", above=0)]
    at: Annotated[tuple[_Place, _Place], mm("x, y of its centre")] = (0.0, 0.0)


class PolygonTable(Struct, forbid_unknown_fields=True):
    """A polygon, its corners rounded alike."""

    points: Annotated[list[tuple[_Place, _Place]], Meta(min_length=3, max_length=1000, description="x, y of corners")]
    corner_radius: CornerRadius = 0.0


class LayerHexagonTable(Struct, forbid_unknown_fields=True, kw_only=True):
    """A hexagon: in a layer the pocket of a nut, or the head of a bolt."""

    across_flats: AcrossFlats
    at: Annotated[tuple[_Place, _Place], mm("x, y of its centre")] = (0.0, 0.0)
    corner_radius: CornerRadius = 0.0
    angle_deg: Direction = 90.0

    def polygon(self) -> PolygonTable:
        """Its corners, the first one clockwise of its first flat."""
        corner, way = self.across_flats / math.sqrt(3), math.radians(self.angle_deg - 30)
        corners = [complex(*self.at) + cmath.rect(corner, way + math.tau * k / 6) for k in range(6)]
        return PolygonTable([(p.real, p.imag) for p in corners], self.corner_radius)


_ARC = part_mm(
    "radius of the arc to the next point: above 0 bulges out of the outline, below 0 into it; 0: a line",
    least=-MOST_LENGTH,
)


_COUNT = Meta(
    ge=1,
    le=1000,
    description="how often its corners stand about the axis, counter-clockwise: those of one tooth make a wheel",
    examples=[16],
)


class OutlinePoint(Struct, forbid_unknown_fields=True, kw_only=True):
    """A corner of an outline of lines and arcs."""

    x: _Place
    y: _Place
    arc: Annotated[float, _ARC] = 0.0


class OutlineTable(Struct, forbid_unknown_fields=True):
    """An outline of lines and arcs, none of these more than half a circle."""

    points: Annotated[list[OutlinePoint], Meta(min_length=2, max_length=1000, description="its corners, either way")]
    count: Annotated[int, _COUNT] = 1


class LayerTable(Struct, forbid_unknown_fields=True, kw_only=True):
    """A layer: material is what lies within an odd number of its contours."""

    thickness: Annotated[float, part_mm("thickness of the layer", above=0)]
    circles: Annotated[list[CircleTable], Meta(max_length=2000)] = field(default_factory=list)
    polygons: Annotated[list[PolygonTable], Meta(max_length=1000)] = field(default_factory=list)
    hexagons: Annotated[list[LayerHexagonTable], Meta(max_length=1000)] = field(default_factory=list)
    slots: Slots = field(default_factory=list)
    outlines: Annotated[list[OutlineTable], Meta(max_length=1000)] = field(default_factory=list)


# corners of one outline, those that are turned on too
_MOST_POINTS = 2000
# kinds of contours of a layer, in the order in which they are numbered
_CONTOURS = ("circles", "polygons", "hexagons", "slots", "outlines")
# of a contour: its layer, which of its contours it is, from 0 on, and its key
_Spot = tuple[int, int, str]

_BOX = [
    {"thickness": 4.0, "polygons": [{"points": [[-30, -20], [30, -20], [30, 20], [-30, 20]], "corner_radius": 5.0}]},
    {"thickness": 8.0, "circles": [{"diameter": 30.0}, {"diameter": 20.0}]},
]

_HAND = [
    {
        "thickness": 3.0,
        "outlines": [{"points": [
            {"x": 4.0, "y": 0.0}, {"x": 1.0, "y": 60.0, "arc": 1.0}, {"x": -1.0, "y": 60.0},
            {"x": -4.0, "y": 0.0, "arc": 4.0},
        ]}],
        "slots": [{"start": [0.0, 10.0], "end": [0.0, 25.0], "width": 2.0}],
        "circles": [{"diameter": 3.0}],
    },
]  # fmt: skip

_RATCHET = [
    {
        "thickness": 5.0,
        "outlines": [{"points": [{"x": 20.0, "y": 0.0}, {"x": 16.0, "y": 0.0}], "count": 16}],
        "circles": [{"diameter": 6.0}],
    },
]

_NUTS = [
    {"thickness": 3.0, "polygons": _BOX[0]["polygons"], "circles": [{"diameter": 4.4, "at": [20.0, 0.0]}]},
    {"thickness": 3.4, "polygons": _BOX[0]["polygons"], "hexagons": [{"across_flats": 7.2, "at": [20.0, 0.0]}]},
]

_LAYERS = Meta(
    min_length=1,
    max_length=100,
    description="from the lowest upwards; contours of neighbours are the same, apart, or within each other",
)


class LayeredSpec(MaterialKeys, kw_only=True, tag_field="kind", tag="layered"):
    """Keys of ``layered``."""

    layers: Annotated[
        list[LayerTable],
        _LAYERS,
        start(
            _BOX,
            (_HAND, N_("the hand of a clock: flat, of lines and arcs, for the laser")),
            (_RATCHET, N_("a ratchet wheel: two corners of one tooth, sixteen times")),
            (_NUTS, N_("a plate with the pocket of a nut M4")),
        ),
    ]


class Layered(Kind[LayeredSpec, "Layers"]):
    """Layers upon each other, the lower face of the lowest at z = 0."""

    name, keys, has_outline = "layered", LayeredSpec, False
    drawing = "parts.bodies.layered_drawing"

    def thing(self, keys: LayeredSpec, others: Others) -> Layers:
        """The layers, checked to have contours that neither cross nor touch."""
        from geometry.solids.layers import Layer, Layers

        made, places = [], dict[str, _Spot]()
        for number, table in enumerate(keys.layers, 1):
            if not any(getattr(table, key) for key in _CONTOURS):
                raise ParameterError(f"layers[{number}]", None, "layer_of_nothing")
            made.append(Layer(table.thickness, tuple(_contours(table, f"layers[{number}]"))))
            names = (f"{key}[{k}]" for key in _CONTOURS for k, _ in enumerate(getattr(table, key), 1))
            places |= {
                f"layers[{number}].contours[{k + 1}]": (number - 1, k, f"layers[{number}].{name}")
                for k, name in enumerate(names)
            }
        try:
            return Layers(tuple(made)).checked()
        except ParameterError as refusal:
            if refusal.name not in places:
                raise
            raise _in_keys(keys, Layers(tuple(made)), refusal, places) from refusal

    def section(self, keys: LayeredSpec, thing: Layers, offset: float) -> OffsetRegion:
        """The layer with the largest outline."""
        from geometry.plane.offset_region import OffsetRegion

        return OffsetRegion(thing.region(offset), offset, ())

    def solid(self, keys: LayeredSpec, thing: Layers, offset: float) -> Body:
        """The layers."""
        return thing.body(offset)

    def is_plate(self, keys: LayeredSpec, thing: Layers) -> bool:
        """One layer is its section, extruded."""
        return len(thing.layers) == 1

    def height(self, keys: LayeredSpec, thing: Layers) -> float:
        """Of all layers."""
        return thing.heights[-1]

    def report(self, keys: LayeredSpec, thing: Layers) -> Report:
        """Its size."""
        low_x, high_x, low_y, high_y = (f(c.box[k] for layer in thing.layers for c in layer.contours)
                                        for k, f in enumerate((min, max, min, max)))  # fmt: skip
        return Report(quantities={"width": high_x - low_x, "height": high_y - low_y, "length": thing.heights[-1]})


def _in_keys(keys: LayeredSpec, layers: Layers, refusal: ParameterError, places: dict[str, _Spot]) -> ParameterError:
    """The refusal of a contour in the keys, of two that cross by a circle with the diameter that crosses none."""
    meeting = [places[refusal.name], *(places[str(other)] for other in refusal.numbers.values())]
    for (layer, index, key), (_, _, other) in zip(meeting, reversed(meeting), strict=True):
        contour, table = layers.layers[layer].contours[index], value_at(keys, key)
        if isinstance(table, CircleTable) and refusal.code == "contours_cross":
            # in a layer beside this one the same contour goes on
            beside = [c for one in layers.layers[max(layer - 1, 0) : layer + 2] for c in one.contours if c != contour]
            near = [*beside, *(c for k, c in enumerate(layers.layers[layer].contours) if k != index)]
            radius = _free_radius([c.span(complex(*table.at)) for c in near], table.diameter / 2)
            cure = None if radius is None else limit(2 * radius, table.diameter, digits=6)
            return ParameterError(f"{key}.diameter", table.diameter, refusal.code, cure, other=other)
    numbers = {name: places[str(other)][2] for name, other in refusal.numbers.items()}
    return ParameterError(meeting[0][2], None, refusal.code, **numbers)


def _free_radius(spans: list[tuple[float, float]], radius: float) -> float | None:
    """The radius nearest to another one that lies in no span, mm; None: in none of them it lies."""
    found, margin = [], 1e-9
    for end, way in ((0, -1), (1, 1)):
        free = radius
        for span in sorted(spans, key=lambda span: way * span[1 - end]):
            if span[0] - margin * radius <= free <= span[1] + margin * radius:
                free = span[end] * (1 + way * margin)
        found.append(free)
    return min((r for r in found if r > 0 and r != radius), key=lambda r: abs(r - radius), default=None)


def _contours(table: LayerTable, place: str) -> list[Contour]:
    """The contours of a layer, counter-clockwise.

    Raises
    ------
    ParameterError
        Roundings that meet, or a slot that ends where it begins.
    """
    from geometry.curves.line_arc import Arc
    from geometry.solids.layers import Contour
    from geometry.solids.plate import belt

    found = []
    for circle in table.circles:
        centre, radius = complex(*circle.at), circle.diameter / 2
        found.append(Contour((Arc(centre, radius, 0.0, math.pi), Arc(centre, radius, math.pi, math.pi))))
    found += [_polygon(one, f"{place}.polygons[{number}]") for number, one in enumerate(table.polygons, 1)]
    found += [_polygon(one.polygon(), f"{place}.hexagons[{number}]") for number, one in enumerate(table.hexagons, 1)]
    for number, slot in enumerate(table.slots, 1):
        if slot.start == slot.end:
            raise ParameterError(f"{place}.slots[{number}].end", list(slot.end), "slot_ends_at_start")
        ends = ((complex(*at), slot.width / 2) for at in (slot.start, slot.end))
        found.append(Contour(belt(*ends)))
    for number, outline in enumerate(table.outlines, 1):
        found.append(_outline(outline, f"{place}.outlines[{number}]"))
    return found


def _polygon(polygon: PolygonTable, place: str) -> Contour:
    """A polygon as a contour.

    Raises
    ------
    ParameterError
        Roundings that meet, or edges.
    """
    from geometry.solids.layers import Contour
    from geometry.solids.plate import meets_itself, rounded

    corners = [complex(*p) for p in polygon.points]
    area = sum((a.conjugate() * b).imag for a, b in zip(corners, [*corners[1:], corners[0]], strict=True))
    ordered = corners if area > 0 else corners[::-1]
    try:
        made = Contour(rounded([(p, polygon.corner_radius) for p in ordered]))
    except (GeometryError, ZeroDivisionError) as error:
        raise ParameterError(f"{place}.corner_radius", polygon.corner_radius, "roundings_meet") from error
    if meets_itself(made.edges):
        raise ParameterError(f"{place}.points", len(corners), "boundary_crosses_itself")
    return made


def _outline(outline: OutlineTable, place: str) -> Contour:
    """An outline as a contour; corners that are repeated may be told clockwise, where only so they make one.

    Raises
    ------
    ParameterError
        An arc shorter than its chord, no outline, too many corners, or edges that meet.
    """
    from geometry.solids.plate import meets_itself

    points, count = outline.points, outline.count
    key, value = ("points", len(points)) if count == 1 else ("count", count)
    wrong = ParameterError(f"{place}.{key}", value, "boundary_crosses_itself")
    try:
        made = _repeated(points, count, place)
        if not meets_itself(made.edges):
            return made
    except ParameterError as refusal:
        wrong = refusal
    ways = itertools.pairwise(complex(p.x, p.y) for p in points)
    if count > 1 and sum(cmath.phase(b * a.conjugate()) for a, b in ways) < 0:
        # an arc leads to the next corner: told backwards, to the one before
        turned = [replace(p, arc=q.arc) for p, q in zip(points[::-1], [*points[-2::-1], points[-1]], strict=True)]
        with suppress(ParameterError):
            if not meets_itself((made := _repeated(turned, count, place)).edges):
                return made
    raise wrong


def _repeated(points: list[OutlinePoint], count: int, place: str) -> Contour:
    """Corners so often about the axis as a contour.

    Raises
    ------
    ParameterError
        An arc shorter than its chord, or no outline: its ways enclose nothing; or too many corners.
    """
    from geometry.curves.line_arc import Line, arc_between
    from geometry.solids.layers import Contour

    if len(points) * count > _MOST_POINTS:
        most = limit(_MOST_POINTS // len(points), count)
        raise ParameterError(f"{place}.count", count, "outline_of_too_many_points", most, most=_MOST_POINTS)
    turns = [cmath.rect(1.0, math.tau * k / count) for k in range(count)]
    corners = [turn * complex(p.x, p.y) for turn in turns for p in points]
    arcs = [(p.arc, k) for _ in turns for k, p in enumerate(points, 1)]
    ways = [(a, b, *arc) for a, b, arc in zip(corners, [*corners[1:], corners[0]], arcs, strict=True)]
    # the polygon of the corners tells which way it runs; of two corners it is counter-clockwise
    area = math.fsum((a.conjugate() * b).imag / 2 for a, b, *_ in ways)
    if area < 0:
        ways = [(b, a, radius, number) for a, b, radius, number in reversed(ways)]
    edges: list[Line | Arc] = []
    enclosed = abs(area)
    for begin, end, radius, number in ways:
        chord = abs(end - begin)
        if chord == 0:
            raise ParameterError(f"{place}.points", len(points), "outline_of_nothing")
        if radius == 0:
            edges.append(Line(begin, end))
            continue
        rest = radius**2 - chord**2 / 4
        if rest < -1e-12 * radius**2:
            least = limit(math.copysign(chord / 2 * (1 + 1e-9), radius), radius, digits=6)
            raise ParameterError(f"{place}.points[{number}].arc", radius, "arc_shorter_than_chord", least)
        side = 1j * math.copysign(math.sqrt(max(rest, 0.0)), radius)
        centre = (begin + end) / 2 + side * (end - begin) / chord
        arc = arc_between(centre, begin, end, radius > 0)
        edges.append(arc)
        enclosed += radius**2 / 2 * (arc.sweep - math.sin(arc.sweep))
    if enclosed <= 0:
        raise ParameterError(f"{place}.points", len(points), "outline_of_nothing")
    return Contour(tuple(edges))


LAYERED = Layered()
