"""The working drawing of a body of layers: a section along its axis, and one across every layer that has contours anew.

Places are told from the axes of the part's frame, what stands alike on both sides of one from side to side.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import pairwise
from operator import attrgetter

from geometry.base.record import Record, replace
from geometry.curves.line_arc import Arc, Line
from geometry.solids.layers import Contour, Layers, Nest
from parts.bodies.layered import CircleTable, LayeredSpec, LayerTable, OutlineTable, PolygonTable
from parts.bodies.patterns import Repeated, repeated
from parts.bodies.plate import SlotTable
from parts.bodies.plate_drawing import diameters, radii
from parts.drawing.places import place_sizes, spans
from parts.drawing.revolved import block
from parts.drawing.wheel_views import circle_of
from parts.drawing.working import AXIS, VISIBLE, Cut, Note, PartDrawing, Round, Size, Subject, View, requirements
from parts.texts.sheets import counted_words, sheet_words

# mm that are none; parts of the size: beside a place that is looked at, what jumps there; digits of places
_NONE, _BESIDE, _JUMP, _DIGITS = 1e-9, 1e-7, 1e-5, 9
# of more layers the heights stand in the titles of their sections: marks of these have no room among extension lines
_FEW = 10
# corners that a polygon for a spanner has at least, and parts of its size that are none
_SPANNED, _EQUAL = 6, 1e-6
# parts of the width: about centres of arcs so large holes may stand on a circle
_LARGE = 0.1
Span = tuple[float, float]
_Coordinate = Callable[[complex], float]
_REAL: _Coordinate = attrgetter("real")
_IMAG: _Coordinate = attrgetter("imag")
_Table = CircleTable | PolygonTable | SlotTable | OutlineTable


class _Piece(Record):
    """Part of a contour that rises or falls in both coordinates; ``side``: signs of its way from its centre."""

    start: complex
    end: complex
    arc: Arc | None = None
    side: complex = 0j

    def across(self, x: float) -> float | None:
        """The height at which it crosses the upright line at x."""
        return self._crossed(x, _REAL, _IMAG)

    def along(self, y: float) -> float | None:
        """The place at which it crosses the level line at y."""
        return self._crossed(y, _IMAG, _REAL)

    def _crossed(self, at: float, of: _Coordinate, other: _Coordinate) -> float | None:
        """One coordinate where the other one has a value."""
        if (of(self.start) > at) == (of(self.end) > at):
            return None
        if self.arc is not None:
            centre = self.arc.centre
            return other(centre) + other(self.side) * _leg(self.arc.radius, at - of(centre))
        way = self.end - self.start
        return other(self.start) + other(way) * (at - of(self.start)) / of(way)


def _leg(radius: float, other: float) -> float:
    return math.sqrt(max((radius - other) * (radius + other), 0.0))


def part_drawing(subject: Subject) -> PartDrawing:
    """Of one layer the view alone, its thickness told; of more the section through as many contours as there are.

    What has nothing inside is seen from the left, not cut (GOST 2.305).
    """
    layers, keys = subject.part.thing, subject.part.keys
    assert isinstance(layers, Layers)
    assert isinstance(keys, LayeredSpec)
    if len(layers.layers) == 1:
        at = max((complex(e.point(0.0)) for c in layers.layers[0].contours for e in c.edges), key=lambda p: p.real)
        note = Note(at, f"s {subject.say(layers.heights[-1])}")
        return PartDrawing((_across(layers.layers[0].contours, keys.layers[0], subject, notes=(note,)),),
                           requirements(subject))  # fmt: skip
    solid = all(len(layer.contours) == 1 for layer in layers.layers)
    plane, letters, plans = None if solid else _plane(layers), dict[frozenset[Contour], str](), list[View]()
    told: list[object] = []
    along = () if plane is None else (Cut(plane, subject.letter()),)
    cuts: list[Cut] = []
    for layer, table, (low, high) in zip(layers.layers, keys.layers, pairwise(layers.heights), strict=True):
        same = frozenset(layer.contours)
        if same not in letters:
            letters[same] = letter = subject.letter(len(along) + len(letters))
            marks = () if plans else along
            plans.append(_across(layer.contours, table, subject, told, f"{letter}-{letter}", marks))
        cuts.append(Cut((low + high) / 2, letters[same], from_right=True))
    section = _section(layers, plane, "".join(f"{cut.letter}-{cut.letter}" for cut in along), cuts)
    if len(layers.layers) > _FEW:
        plans = [replace(plan, title=f"{plan.title}, {_between(layers, same, subject)}")
                 for plan, same in zip(plans, letters, strict=True)]  # fmt: skip
    return PartDrawing((section, *plans), requirements(subject))


def _between(layers: Layers, contours: frozenset[Contour], subject: Subject) -> str:
    """From which height to which the layers of a section reach."""
    spans = (span for layer, span in zip(layers.layers, pairwise(layers.heights), strict=True)
             if frozenset(layer.contours) == contours)  # fmt: skip
    return "z " + "; ".join("...".join(subject.say(round(z, _DIGITS)) for z in span) for span in spans)


def _across(
    contours: Sequence[Contour], table: LayerTable, subject: Subject, told: list[object] | None = None,
    title: str = "", cuts: tuple[Cut, ...] = (), notes: tuple[Note, ...] = (),
) -> View:  # fmt: skip
    """The section across a layer, seen from above, with the sizes of what is not ``told`` yet, which is then."""
    known: list[object] = [] if told is None else told
    tables: list[_Table] = [
        *table.circles, *table.polygons, *(one.polygon() for one in table.hexagons), *table.slots, *table.outlines
    ]  # fmt: skip
    new = [(one, contour) for one, contour in zip(tables, contours, strict=True) if one not in known]
    known += [one for one, _ in new]
    low_x, high_x, low_y, high_y = (f(c.box[k] for c in contours) for k, f in enumerate((min, max, min, max)))
    arcs = [e for c in contours for e in c.edges if isinstance(e, Arc) and e.radius > _LARGE * (high_x - low_x)]
    large = {complex(round(e.centre.real, 6), round(e.centre.imag, 6)) for e in arcs}
    patterns = [*repeated([_shape(one) for one, _ in new], sorted(large, key=str))]
    alike = frozenset[int]().union(*(pattern.members for pattern in patterns))
    places = [complex(*p) for k, (one, _) in enumerate(new) if k not in alike for p in _places(one)]
    nest = Nest(tuple(contours))
    holes, solid = (
        [c.circle for _, c in new if c.circle is not None and len(nest.about(c)) % 2 == way] for way in (True, False)
    )
    chains = [contour.edges for _, contour in new if contour.circle is None]
    axes = [
        Line(complex(min(low_x, 0.0)), complex(max(high_x, 0.0))),
        Line(1j * min(low_y, 0.0), 1j * max(high_y, 0.0)),
    ]
    for middle, radius in sorted({c.circle for c in contours if c.circle and c.circle[0]}, key=str):
        axes += [Line(middle - radius * way, middle + radius * way) for way in (1, 1j)]
    places += [pattern.centre for pattern in patterns]
    spanned = [flats for one, _ in new if isinstance(one, PolygonTable) and (flats := _flats(one.points))]
    sizes = (
        *place_sizes(places, complex(low_x, low_y)),
        *(
            Size(f"spanner.{k}", a, b, "left" if abs((b - a).real) < _NONE else "below", "S ")
            for k, (a, b) in enumerate(spanned, 1)
        ),
        *_first_ones(patterns, high_x, {c.imag for c in places}),
    )
    turned_on = [one for one, _ in new if isinstance(one, OutlineTable) and one.count > 1]
    notes += tuple(Note(complex(one.points[0].x, one.points[0].y), _turned_on(one.count, subject.language))
                   for one in turned_on)  # fmt: skip
    rounds = (
        *diameters(solid, subject.language, solid=True),
        *diameters(holes, subject.language),
        *radii(chains, subject.language),
        *_circles(patterns, subject.language),
    )
    strokes = (
        *((VISIBLE, edge) for contour in contours for edge in contour.edges),
        *((AXIS, circle_of(one.radius, one.centre)) for one in _circles(patterns, subject.language)),
    )
    hatched = tuple(contour.edges for contour in contours) if title else ()
    return View(strokes, hatched, tuple(axes), sizes, rounds, notes, title, cuts=cuts)


def _turned_on(count: int, language: str) -> str:
    """Of an outline whose corners stand about the axis: how often, and in which step."""
    words = counted_words(language, "places_of", count), sheet_words(language, "step_of", step=f"360°/{count}")
    return "".join(words).strip()


def _places(table: _Table) -> Iterable[tuple[float, float]]:
    """What of a contour has its place told: its corners, or the middles of its arcs."""
    match table:
        case CircleTable():
            return (table.at,)
        case PolygonTable():
            flats = _flats(table.points)
            return ((p.real, p.imag) for p in [sum(flats) / 2]) if flats else table.points
        case SlotTable():
            return table.start, table.end
        case OutlineTable():
            return ((p.x, p.y) for p in table.points)


def _flats(points: Sequence[tuple[float, float]]) -> list[complex]:
    """The middles of two flats that a spanner holds, level or upright ones; none where it is no such polygon."""
    corners = [complex(*p) for p in points]
    middle, way = sum(corners) / len(corners), cmath.rect(1.0, 2 * math.pi / len(corners))
    ways = way, way.conjugate()
    turns = [(b - middle) / ((a - middle) or 1.0) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
    if len(corners) < _SPANNED or len(corners) % 2 or all(any(abs(t - w) > _EQUAL for t in turns) for w in ways):
        return []
    flats = [(a + b) / 2 for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
    found = [p for p in flats if min(abs((p - middle).real), abs((p - middle).imag)) < _EQUAL * abs(p - middle)]
    return [complex(round(p.real, _DIGITS), round(p.imag, _DIGITS)) for p in found[:: len(found) // 2 or 1]][:2]


def _shape(table: _Table) -> tuple[object, tuple[complex, ...]]:
    """What may stand on a circle: its size, and the places that tell where it is; others stand for themselves."""
    match table:
        case CircleTable():
            return table.diameter, (complex(*table.at),)
        case SlotTable():
            start, end = complex(*table.start), complex(*table.end)
            return (table.width, round(abs(end - start), 6)), (start, end)
        case _:
            return id(table), (0j,)


def _circles(patterns: Sequence[Repeated], language: str) -> list[Round]:
    """The circles of what repeats, each once, with the steps of all that stand on it."""
    found: dict[tuple[complex, float], list[str]] = {}
    for one in patterns:
        for radius in one.radii:
            steps = found.setdefault((one.centre, round(radius, 6)), [])
            if (step := f"360°/{one.count}") not in steps:
                steps.append(step)
    return [Round(f"pattern.{k}", centre, radius, places=sheet_words(language, "step_of", step=", ".join(steps)))
            for k, ((centre, radius), steps) in enumerate(found.items(), 1)]  # fmt: skip


def _first_ones(patterns: Sequence[Repeated], right: float, known: set[float]) -> Iterator[Size]:
    """How far from the axis the first ones of what repeats stand, on the side to which they do."""
    points = {round(p.imag, _DIGITS): p for one in patterns for places in one.first for p in places}
    points = {y: p for y, p in points.items() if all(abs(y - other) > _NONE for other in known)}
    for k, (a, b) in enumerate(spans(points), 1):
        yield Size(f"first.{k}", points.get(a, complex(right, a)), points.get(b, complex(right, b)), "right")


def _plane(layers: Layers) -> float:
    """The upright plane through most contours, of several the one nearest to the middle; along no edge."""
    contours = {contour for layer in layers.layers for contour in layer.contours}
    low, high = min(c.box[0] for c in contours), max(c.box[1] for c in contours)
    middle, size = (low + high) / 2, high - low
    places = {middle, *(c.circle[0].real for c in contours if c.circle), *((c.box[0] + c.box[1]) / 2 for c in contours)}
    upright = {p.real for c in contours for piece in _pieces(c) for p in (piece.start, piece.end)
               if abs(piece.start.real - piece.end.real) < _NONE}  # fmt: skip
    free = [x for x in places if all(abs(x - other) > _JUMP * size for other in upright)] or [middle + _JUMP * size]
    return max(sorted(free), key=lambda x: (sum(c.box[0] < x < c.box[1] for c in contours), -abs(x - middle)))


def _pieces(contour: Contour) -> Iterator[_Piece]:
    """A contour in parts that rise or fall."""
    for edge in contour.edges:
        if isinstance(edge, Arc):
            yield from _quarters(edge)
        else:
            yield _Piece(edge.start, edge.end)


def _quarters(arc: Arc) -> Iterator[_Piece]:
    """An arc in parts that rise or fall."""
    first, last = sorted((arc.start_angle, arc.start_angle + arc.sweep))
    step = math.pi / 2
    turns = [first, *(k * step for k in range(math.floor(first / step) + 1, math.ceil(last / step))), last]
    for low, high in pairwise(turns):
        way = cmath.rect(1.0, (low + high) / 2)
        start, end = (arc.centre + cmath.rect(arc.radius, turn) for turn in (low, high))
        yield _Piece(start, end, arc, complex(math.copysign(1, way.real), math.copysign(1, way.imag)))


class _Behind(Record):
    """What is seen along one level line of a layer beyond a plane: nothing but the cut; else the nearest wall's place.

    ``place``: None where there is none; ``way``: its direction there.
    """

    is_cut: bool
    place: float | None
    way: complex


def _section(layers: Layers, plane: float | None, title: str, cuts: Sequence[Cut]) -> View:
    """The section along an upright plane, or the view, from the left: heights to the right, y upwards."""
    pieces = [[piece for contour in layer.contours for piece in _pieces(contour)] for layer in layers.layers]
    x = min(p.start.real for row in pieces for p in row) - 1.0 if plane is None else plane
    levels = [sorted(y for p in row if (y := p.across(x)) is not None) for row in pieces]
    spans = [list(zip(row[::2], row[1::2], strict=True)) for row in levels]
    heights, size = layers.heights, max(abs(p.end) for row in pieces for p in row)
    lines = [
        Line(complex(low, y), complex(high, y))
        for ys, (low, high) in zip(levels, pairwise(heights), strict=True)
        for y in ys
    ]
    empty: list[_Piece] = []
    around = [empty, *pieces, empty]
    # edges of faces: where one layer ends and the other does not, in the plane or behind it
    for z, (low, high) in zip(heights, pairwise(around), strict=True):
        for a, b in pairwise(_breaks((*low, *high), x)):
            views = _behind(low, x, (a + b) / 2), _behind(high, x, (a + b) / 2)
            if views[0].is_cut != views[1].is_cut or not (views[0].is_cut or views[0].place == views[1].place):
                lines.append(Line(complex(z, a), complex(z, b)))
    for own, (bottom, top) in zip(pieces, pairwise(heights), strict=True):
        for y in _breaks(own, x):
            one, two = (_behind(own, x, y + way * _BESIDE * size) for way in (-1, 1))
            if not (one.is_cut or two.is_cut) and _parted(one, two, size):
                lines.append(Line(complex(bottom, y), complex(top, y)))
    bars = [block(*ends, *span) for row, ends in zip(spans, pairwise(heights), strict=True) for span in row]
    told = range(1, len(heights)) if len(pieces) <= _FEW else (len(pieces),)
    feet = [min([*ys] or [p.end.imag for p in row]) for ys, row in zip(levels, pieces, strict=True)]
    sizes = [Size(f"height.{k}", complex(0.0, feet[0]), complex(heights[k], feet[k - 1]), "below") for k in told]
    axes = {
        (low, high, round(c.circle[0].imag, _DIGITS))
        for layer, (low, high) in zip(layers.layers, pairwise(heights), strict=True)
        for c in layer.contours if c.circle and (plane is None or abs(c.circle[0].real - plane) < _NONE)
    }  # fmt: skip
    centre = [Line(complex(low, y), complex(high, y)) for low, high, y in sorted(axes)]
    strokes = tuple((VISIBLE, line) for line in _joined(lines, _JUMP * size))
    return View(strokes, tuple(bars), tuple(_joined(centre, _NONE)), tuple(sizes), title=title, cuts=tuple(cuts))


def _breaks(pieces: Iterable[_Piece], x: float) -> list[float]:
    """Heights at which what is seen may change: ends of pieces beyond a plane, and where they cross it."""
    found: set[float] = set()
    for piece in pieces:
        found |= {round(p.imag, _DIGITS) for p in (piece.start, piece.end) if p.real > x - _NONE}
        if (y := piece.across(x)) is not None:
            found.add(round(y, _DIGITS))
    return sorted(found)


def _behind(pieces: Iterable[_Piece], x: float, y: float) -> _Behind:
    """What is seen of a layer from the plane at x along the level line at y."""
    found = sorted(
        ((at, piece) for piece in pieces if (at := piece.along(y)) is not None and at > x), key=lambda f: f[0]
    )
    if not found:
        return _Behind(False, None, 0j)
    at, piece = found[0]
    way = piece.end - piece.start if piece.arc is None else 1j * (complex(at, y) - piece.arc.centre)
    return _Behind(len(found) % 2 == 1, at, way / abs(way))


def _parted(one: _Behind, two: _Behind, size: float) -> bool:
    """Whether walls on both sides of a level line make an edge: they stand apart, or in a corner."""
    if one.place is None or two.place is None:
        return one.place is not two.place
    # beside the end of an arc a wall falls back as the root of the distance
    return abs(one.place - two.place) > 2 * math.sqrt(_BESIDE) * size or (
        abs((one.way.conjugate() * two.way).imag) > math.sqrt(_BESIDE) * 4
    )


def _joined(lines: Iterable[Line], near: float) -> list[Line]:
    """Level and upright lines, those that go on, or lie so near to each other, mm, as one."""
    rows: dict[tuple[bool, float], list[Span]] = {}
    for line in lines:
        level = abs(line.start.imag - line.end.imag) < _NONE
        at = round(line.start.imag if level else line.start.real, _DIGITS)
        ends = (line.start.real, line.end.real) if level else (line.start.imag, line.end.imag)
        # on paper these are one
        one = next((k for k in rows if k[0] == level and abs(k[1] - at) < near), (level, at))
        rows.setdefault(one, []).append((min(ends), max(ends)))
    found = []
    for (level, at), row in rows.items():
        low, high = min(row)
        for a, b in sorted(row):
            if a > high + _NONE:
                found.append((level, at, low, high))
                low = a
            high = max(high, b)
        found.append((level, at, low, high))
    return [Line(complex(a, at), complex(b, at)) if level else Line(complex(at, a), complex(at, b))
            for level, at, a, b in found]  # fmt: skip
