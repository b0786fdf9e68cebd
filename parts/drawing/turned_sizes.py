"""The sizes of what is turned, after GOST 2.307: half a section can be made again from them, and none is told twice.

A loop is half a section, its axis along x. Chamfers of 45 degrees and fillets are told by how many there are of one
size; without them, each place along the axis where a corner is has one size to another place, and each distance from
the axis one diameter, one more for each other tolerance zone.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import pairwise

from geometry.base.record import Record, replace
from geometry.curves.curve import end_point, start_point
from geometry.curves.line_arc import Arc, Line
from parts.drawing.revolved import Loop, outer_of
from parts.drawing.working import Round, Side, Size, arc_angles
from parts.texts.sheets import counted_words, sheet_words

# mm in which places are one; parts of one in which directions are; digits of places
_NONE, _SMOOTH, _DIGITS = 1e-9, 1e-6, 7
# places along the axis, and distances from it, that sizes tell, in as many rows less one; what has more of either has a
# table
_MOST = 21


class Own(Record):
    """An outer cylinder between two heights, of a radius, mm; what stands before and after its diameter."""

    low: float
    high: float
    radius: float
    after: str
    before: str = "Ø"


class Fits(Record):
    """Tolerance zones of outer and inner cylinders, of the largest one (None: as the others); grooves have none.

    ``own``: outer cylinders with zones, or signs, of their own.
    """

    outer: str = ""
    inner: str = ""
    largest: str | None = None
    own: tuple[Own, ...] = ()


class _Edge(Record):
    """A curve of a half section without chamfers and fillets; ``told``: its sizes are wanted."""

    curve: Line | Arc
    outer: bool
    told: bool

    @property
    def ends(self) -> tuple[complex, complex]:
        """Where it begins and ends."""
        return start_point(self.curve), end_point(self.curve)

    def runs_along(self) -> bool:
        """Whether it sweeps a cylinder."""
        return isinstance(self.curve, Line) and abs(self.curve.start.imag - self.curve.end.imag) < _NONE

    def stands(self) -> bool:
        """Whether it sweeps a plane."""
        return isinstance(self.curve, Line) and abs(self.curve.start.real - self.curve.end.real) < _NONE


class TurnedSizes(Record):
    """What is told of half a section: linear sizes, and radii on leaders."""

    sizes: tuple[Size, ...]
    rounds: tuple[Round, ...]


class SectionCorner(Record):
    """A corner of half a section without chamfers and fillets, and the radius of the arc to the next one, 0: a line.

    Above 0 it bulges out of the material.
    """

    at: complex
    arc: float = 0.0


Told = Callable[[Line | Arc], bool]


def turned_sizes(
    loop: Loop, fits: Fits, language: str, told: Told = lambda curve: True, *, listed: bool = True
) -> TurnedSizes:
    """All sizes of half a section, or of those of its curves that are ``told`` in a view.

    Where corners are too many for sizes, a table tells them: chamfers and fillets alone have sizes. ``listed``: there
    is such a table.
    """
    whole = _walled(_joined(loop))
    chamfers, fillets, edges = _taken_apart(whole, told)
    arcs = [edge.curve for edge in edges if isinstance(edge.curve, Arc) and edge.told]
    balls = [arc for arc in arcs if abs(arc.centre.imag) < _NONE and _on_axis(start_point(arc), end_point(arc))]
    rounded = [*(whole[k] for k in fillets if told(whole[k]))]
    sizes = [*_chamfers([whole[k] for k in chamfers if told(whole[k])], language)]
    if not (listed and _are_listed(edges)):
        rounded += [arc for arc in arcs if arc not in balls]
        sizes = [*_diameters(edges, fits, _turn(loop), language), *_balls(balls, language), *_lengths(edges), *sizes]
    radii = [arc for arc in rounded if isinstance(arc, Arc)]
    return TurnedSizes(tuple(sizes), tuple(_radii(radii, _turn(loop), language)))


def listed_corners(loop: Loop, told: Told = lambda curve: True) -> tuple[SectionCorner, ...]:
    """The corners of half a section one after the other, where they are too many for sizes; none elsewhere."""
    *_, edges = _taken_apart(_walled(_joined(loop)), told)
    if not _are_listed(edges):
        return ()
    turn, found, last = _turn(loop), list[SectionCorner](), None
    for edge in edges:
        if edge.told and not _on_axis(*edge.ends):
            arc = edge.curve
            bulge = arc.radius * math.copysign(1.0, arc.sweep * turn) if isinstance(arc, Arc) else 0.0
            found.append(SectionCorner(edge.ends[0], bulge))
            last = edge.ends[1]
    return (*found, *(SectionCorner(p) for p in (last,) if p is not None and abs(p - found[0].at) > _NONE))


def bores(loop: Loop, told: Told = lambda curve: True) -> tuple[Line, ...]:
    """The cylinders of holes about the axis, one of each diameter, without chamfers; grooves in them left out.

    Where corners are too many for sizes, the narrowest one alone.
    """
    *_, edges = _taken_apart(_walled(_joined(loop)), told)
    turn, found = _turn(loop), dict[float, Line]()
    for k, edge in enumerate(edges):
        if not (edge.told and edge.runs_along() and _has_about(edge, turn)) or edge.outer or _groove(edges, k):
            continue
        height, middle = edge.ends[0].imag, sum(end.real for end in edge.ends) / 2
        # what has a boss in it is no bore
        spans = (sorted(end.real for end in other.ends) for other in edges if other.ends[0].imag < height - _NONE)
        if height > _NONE and not any(low < middle < high for low, high in spans) and isinstance(edge.curve, Line):
            found.setdefault(_radius(height), edge.curve)
    narrow = [found[radius] for radius in sorted(found)]
    return tuple(narrow[:1] if _are_listed(edges) else narrow)


def seats(loop: Loop, told: Told = lambda curve: True) -> tuple[Line, ...]:
    """The outer cylinders that are ``told``, the longest one of each diameter, without chamfers; grooves left out.

    Where corners are too many for sizes, the widest one alone.
    """
    *_, edges = _taken_apart(_walled(_joined(loop)))
    found = dict[float, Line]()
    for k, edge in enumerate(edges):
        line = edge.curve
        if edge.outer and edge.runs_along() and isinstance(line, Line) and not _groove(edges, k) and told(line):
            radius = _radius(edge.ends[0].imag)
            found[radius] = max(found.get(radius, line), line, key=lambda one: abs(one.end - one.start))
    wide = [found[radius] for radius in sorted(found, reverse=True)]
    return tuple(wide[:1] if _are_listed(edges) else wide)


def _taken_apart(
    whole: Sequence[Line | Arc], told: Told = lambda curve: True
) -> tuple[list[int], list[int], list[_Edge]]:
    """Places of chamfers and of fillets, and all else without them."""
    chamfers = [k for k in range(len(whole)) if _is_chamfer(whole, k)]
    fillets = [k for k in range(len(whole)) if _is_fillet(whole, k)]
    is_outer = outer_of(whole)
    # what is left of a curve between chamfers and fillets begins and ends elsewhere
    return chamfers, fillets, [
        _Edge(sharp, is_outer(curve), told(curve)) for sharp, curve in _sharp(whole, {*chamfers, *fillets})
    ]  # fmt: skip


def _are_listed(edges: Sequence[_Edge]) -> bool:
    """Whether corners are too many for sizes: by their places along the axis and their distances from it."""
    corners = [end for edge in edges if edge.told for end in edge.ends]
    places = [{round(value, _DIGITS) for value in values} for values in (
        (p.real for p in corners), (p.imag for p in corners))]  # fmt: skip
    return max(map(len, places)) > _MOST


def _turn(loop: Loop) -> float:
    """1 where half a section runs counter-clockwise, else -1."""
    return math.copysign(1.0, sum(_cross(start_point(c), end_point(c)) for c in loop))


def _joined(loop: Loop) -> list[Line | Arc]:
    """A loop whose arcs about one centre that go on are one."""
    found: list[Line | Arc] = []
    for curve in loop:
        last = found[-1] if found else None
        if (
            isinstance(curve, Arc) and isinstance(last, Arc) and abs(curve.centre - last.centre) < _NONE
            and abs(curve.radius - last.radius) < _NONE and abs(end_point(last) - start_point(curve)) < _NONE
        ):  # fmt: skip
            found[-1] = replace(last, sweep=last.sweep + curve.sweep)
        else:
            found.append(curve)
    return found


def _walled(loop: Sequence[Line | Arc]) -> list[Line | Arc]:
    """A loop with the walls that fillets as high as they are leave nothing of: each up to its sharp corner."""
    found: list[Line | Arc] = []
    for k, curve in enumerate(loop):
        before, after = loop[k - 1], loop[(k + 1) % len(loop)]
        start, end = _standing(before, curve, after), _standing(after, curve, before, turned=True)
        found += [*([start] if start else []), curve, *([Line(end.end, end.start)] if end else [])]
    return found


def _standing(beside: Line | Arc, arc: Line | Arc, floor: Line | Arc, *, turned: bool = False) -> Line | None:
    """From the beginning of a quarter of a circle, which stands on a line along the axis, to its corner; else None.

    ``turned``: from its end.
    """
    if not (isinstance(arc, Arc) and isinstance(beside, Line) and isinstance(floor, Line)):
        return None
    foot, sense = (end_point(arc), -1) if turned else (start_point(arc), 1)
    way = sense * _way(arc, at_end=turned)
    quarter = abs(abs(arc.sweep) - math.pi / 2) < _SMOOTH and abs(way.real) < _SMOOTH
    stands = abs(_way(beside, at_end=not turned).imag) < _SMOOTH and not _on_axis(foot)
    goes_on = abs(_way(floor, at_end=turned) - _way(arc, at_end=not turned)) < _SMOOTH
    return Line(foot, foot + way * arc.radius) if quarter and stands and goes_on else None


def _way(curve: Line | Arc, *, at_end: bool) -> complex:
    way = complex(curve.tangent(curve.domain[at_end]))
    return way / abs(way)


def _is_chamfer(loop: Sequence[Line | Arc], k: int) -> bool:
    """Whether a line of 45 degrees stands between one along the axis and one across it."""
    before, curve, after = loop[k - 1], loop[k], loop[(k + 1) % len(loop)]
    if not all(isinstance(c, Line) for c in (before, curve, after)):
        return False
    way, sides = _way(curve, at_end=False), (_way(before, at_end=True), _way(after, at_end=False))
    slanted = abs(abs(way.real) - abs(way.imag)) < _SMOOTH
    square = min(abs(sides[0].real), abs(sides[0].imag)) < _SMOOTH and abs(_dot(*sides)) < _SMOOTH
    return slanted and square and all(_dot(way, side) > 0 for side in sides)


def _cross(one: complex, two: complex) -> float:
    return (one.conjugate() * two).imag


def _dot(one: complex, two: complex) -> float:
    return (one.conjugate() * two).real


def _is_fillet(loop: Sequence[Line | Arc], k: int) -> bool:
    """Whether an arc rounds a corner of two lines."""
    before, curve, after = loop[k - 1], loop[k], loop[(k + 1) % len(loop)]
    if not (isinstance(before, Line) and isinstance(curve, Arc) and isinstance(after, Line)):
        return False
    ends = (_way(before, at_end=True), _way(curve, at_end=False)), (_way(curve, at_end=True), _way(after, at_end=False))
    turn = abs(cmath.phase(_way(after, at_end=False) / _way(before, at_end=True)))
    return all(abs(a - b) < _SMOOTH for a, b in ends) and _SMOOTH < turn < math.pi - _SMOOTH


def _sharp(loop: Sequence[Line | Arc], cuts: Iterable[int]) -> Iterator[tuple[Line | Arc, Line | Arc]]:
    """A loop without the curves at these places, each as it then is and as it was: lines go on until they meet."""
    cut, size = set(cuts), len(loop)
    for k, curve in enumerate(loop):
        if k in cut:
            continue
        if isinstance(curve, Arc):
            yield curve, curve
            continue
        start = _meeting(loop[k - 2], curve) if (k - 1) % size in cut else curve.start
        end = _meeting(curve, loop[(k + 2) % size]) if (k + 1) % size in cut else curve.end
        yield Line(start, end), curve


def _meeting(one: Line | Arc, two: Line | Arc) -> complex:
    """Where two lines cross."""
    assert isinstance(one, Line)
    assert isinstance(two, Line)
    a, b, across = one.end - one.start, two.end - two.start, two.start - one.start
    return one.start + a * _cross(across, b) / _cross(a, b)


def _on_axis(*points: complex) -> bool:
    return all(abs(point.imag) < _NONE for point in points)


def _radius(place: float) -> float:
    return round(place, _DIGITS)


def _groove(edges: Sequence[_Edge], k: int) -> bool:
    """Whether material stands higher on both sides of a cylinder or an arc that begins and ends at one height."""
    edge, before, after = edges[k], edges[k - 1], edges[(k + 1) % len(edges)]
    start, end = edge.ends
    if isinstance(edge.curve, Arc):
        return abs(start.imag - end.imag) < _NONE and not _on_axis(start)
    way = 1 if edge.outer else -1
    return edge.runs_along() and all(way * (far.imag - start.imag) > _NONE for far in (before.ends[0], after.ends[1]))


def _zone(edges: Sequence[_Edge], k: int, fits: Fits, turn: float) -> tuple[str, str]:
    """The sign and the tolerance zone of a cylinder.

    It is that of a hole where material stands about it; a boss in a recess has none.
    """
    edge = edges[k]
    start, end = edge.ends
    middle = complex((start.real + end.real) / 2, start.imag)
    for one in fits.own if edge.outer else ():
        if one.low < middle.real < one.high and abs(middle.imag - one.radius) < _SMOOTH:
            return one.before, one.after
    if fits.largest is not None and abs(start.imag - max(e.ends[0].imag for e in edges)) < _NONE:
        return "Ø", fits.largest
    if _groove(edges, k):
        return "Ø", ""
    return "Ø", fits.outer if edge.outer else fits.inner if _has_about(edge, turn) else ""


def _has_about(edge: _Edge, turn: float) -> bool:
    """Whether a cylinder has material about it, not within."""
    start, end = edge.ends
    return turn * (end.real - start.real) > 0


def _diameters(edges: Sequence[_Edge], fits: Fits, turn: float, language: str) -> Iterator[Size]:
    """A diameter for each distance from the axis and zone, outer ones and inner ones; at cylinders, else at corners.

    ``turn``: of the loop, 1 or -1.
    """
    xs = [end.real for edge in edges for end in edge.ends]
    middle = (min(xs) + max(xs)) / 2
    # for each size the places at which it is, of edges and of their corners
    seen: dict[tuple[float, bool], dict[tuple[str, str], list[tuple[int, complex]]]] = {}
    for k in sorted(range(len(edges)), key=lambda k: not edges[k].runs_along()):
        edge = edges[k]
        if edge.stands() or not edge.told:
            continue
        for corner in edge.ends[:1] if edge.runs_along() else edge.ends:
            # a corner at the end of a cylinder is as far out as that
            at_cylinder = not edge.runs_along() and any(
                other.runs_along() and any(abs(end - corner) < _NONE for end in other.ends) for other in edges
            )
            zones = seen.setdefault((_radius(corner.imag), edge.outer), {})
            zone = _zone(edges, k, fits, turn) if edge.runs_along() else ("Ø", "")
            # the corner between a cone outside and one inside is one of either
            twice = any(
                abs(place - corner) < _NONE for one in seen.values() for told in one.values() for _, place in told
            )
            if corner.imag < _NONE or at_cylinder or ((zones or twice) and not edge.runs_along()):
                continue
            zones.setdefault(zone, []).append((k, corner))
    found = [(*places[0], zone, places) for zones in seen.values() for zone, places in zones.items()]
    for number, (k, corner, zone, places) in enumerate(found, 1):
        edge = edges[k]
        xs = [end.real for end in edge.ends] if edge.runs_along() else [corner.real]
        at_left = sum(xs) / len(xs) <= middle if edge.outer else sum(xs) / len(xs) < middle - _NONE
        side: Side = "left" if at_left else "right"
        at = min(xs) if at_left else max(xs)
        name = f"{'outer' if edge.outer else 'inner'}_diameter.{number}"
        count = 1 + sum(not _goes_on(edges, one, two) for (one, _), (two, _) in pairwise(places))
        ends = complex(at, -corner.imag), complex(at, corner.imag)
        yield Size(name, *ends, side, *zone, counted_words(language, "places_of", count))


def _goes_on(edges: Sequence[_Edge], first: int, last: int) -> bool:
    """Whether a cylinder goes on as another of its diameter beyond a groove that is narrower than either."""
    one, two = edges[first], edges[last]
    way, height, low, high = 1 if one.outer else -1, one.ends[0].imag, one.ends[1].real, two.ends[0].real
    between = [p.imag for edge in edges[first + 1 : last] for p in edge.ends]
    length = min(abs(edge.ends[1].real - edge.ends[0].real) for edge in (one, two))
    return abs(high - low) < length and all(way * (r - height) < _NONE for r in between)


def _balls(arcs: Sequence[Arc], language: str) -> Iterator[Size]:
    """The diameter of a ball, which tells its length too."""
    for k, arc in enumerate(arcs, 1):
        ends = arc.centre - 1j * arc.radius, arc.centre + 1j * arc.radius
        yield Size(f"ball.{k}", *ends, "left", f"{sheet_words(language, 'ball')} Ø")


class _Places:
    """Places along the axis, and which of them sizes join already."""

    def __init__(self) -> None:
        self.roots: dict[float, float] = {}

    def root(self, place: float) -> float:
        while (above := self.roots.setdefault(place, place)) != place:
            place = above
        return place

    def join(self, one: float, two: float) -> bool:
        """Join two; whether they were apart."""
        first, second = self.root(one), self.root(two)
        self.roots[first] = second
        return first != second


def _lengths(edges: Sequence[_Edge]) -> Iterator[Size]:
    """The whole length, from the lower end to each outer face, from the nearer end to each inner one, widths."""
    corners: dict[float, list[tuple[complex, bool]]] = {}
    for edge, after in zip(edges, [*edges[1:], edges[0]], strict=True):
        corner = edge.ends[1]
        # nothing is told of the axis itself
        if all(one.told or _on_axis(*one.ends) for one in (edge, after)):
            corners.setdefault(round(corner.real, _DIGITS), []).append((corner, edge.outer or after.outer))
    if not corners:
        return
    low, high = min(corners), max(corners)
    # what is deepest in a hole is no end to measure from
    is_end = any(edge.stands() and round(edge.ends[0].real, _DIGITS) == high for edge in edges if edge.told)
    joined = _Places()
    for edge in edges:
        if edge.told and isinstance(edge.curve, Arc) and _is_bound(edge, edges):
            joined.join(*(round(end.real, _DIGITS) for end in edge.ends))
    partners = {far: near for near, far in _widths(edges) if near in corners and far in corners}
    pairs = [(low, high)]
    for place in sorted(set(corners) - {low, high} - set(partners)):
        outer = any(is_outside for _, is_outside in corners[place])
        pairs.append((low if outer or not is_end or place - low <= high - place + _NONE else high, place))
    pairs += [(partners[place], place) for place in sorted(partners)]
    number = 0
    for first, second in pairs:
        if first == second or not joined.join(first, second):
            continue
        outer = second not in partners and any(is_outside for _, is_outside in corners[second])
        start, end = (max((p for p, _ in corners[place]), key=lambda p: p.imag) for place in (first, second))
        number += 1
        name = "length" if second == high else f"{'width' if second in partners else 'length'}.{number}"
        if outer:
            yield Size(name, start.conjugate(), end.conjugate(), "below")
        else:
            yield Size(name, start, end, "above")


def _is_bound(edge: _Edge, edges: Sequence[_Edge]) -> bool:
    """Whether an arc's radius tells how far its ends are apart.

    It stands about the axis, is half a circle, or goes on smoothly from a line.
    """
    arc, k = edge.curve, edges.index(edge)
    assert isinstance(arc, Arc)
    start, end = edge.ends
    beside = (edges[k - 1].curve, edges[(k + 1) % len(edges)].curve)
    smooth = (
        isinstance(beside[0], Line) and abs(_way(beside[0], at_end=True) - _way(arc, at_end=False)) < _SMOOTH,
        isinstance(beside[1], Line) and abs(_way(beside[1], at_end=False) - _way(arc, at_end=True)) < _SMOOTH,
    )
    whole = abs(abs(start - end) - 2 * arc.radius) < _SMOOTH * arc.radius
    return abs(start.real - end.real) > _NONE and (abs(arc.centre.imag) < _NONE or whole or any(smooth))


def _widths(edges: Sequence[_Edge]) -> Iterator[tuple[float, float]]:
    """Grooves by the place of one wall and of the other, which is told from that: the lower wall where they differ."""
    for k, edge in enumerate(edges):
        if not _groove(edges, k):
            continue
        first, last = (round(end.real, _DIGITS) for end in edge.ends)
        if isinstance(edge.curve, Arc):
            yield min(first, last), max(first, last)
            continue
        before, after = edges[k - 1], edges[(k + 1) % len(edges)]
        if not (before.stands() and after.stands()):
            continue
        way = 1 if edge.outer else -1
        heights = way * before.ends[0].imag, way * after.ends[1].imag
        if abs(heights[0] - heights[1]) < _NONE:
            yield min(first, last), max(first, last)
        else:
            yield (first, last) if heights[0] > heights[1] else (last, first)


def _chamfers(lines: Sequence[Line | Arc], language: str) -> Iterator[Size]:
    """Chamfers of 45 degrees, those of one length at once."""
    groups: dict[float, list[Line | Arc]] = {}
    for line in lines:
        groups.setdefault(round(abs((end_point(line) - start_point(line)).real), _DIGITS), []).append(line)
    for number, group in enumerate(groups.values(), 1):
        # the one that is the farthest out; both ends at one height: programs that take sizes as aligned read it right
        line = max(group, key=lambda c: max(start_point(c).imag, end_point(c).imag))
        top = max(start_point(line).imag, end_point(line).imag)
        start, end = (complex(p.real, top) for p in (start_point(line), end_point(line)))
        words = counted_words(language, "chamfers_of", len(group))
        yield Size(f"chamfer.{number}", start, end, "above", words, "×45°")


def _radii(arcs: Sequence[Arc], turn: float, language: str) -> Iterator[Round]:
    """Radii of arcs, those of one size at once, about the axis as those of balls; ``turn``: of the loop, 1 or -1."""
    groups: dict[tuple[float, bool], list[Arc]] = {}
    for arc in arcs:
        groups.setdefault((round(arc.radius, _DIGITS), abs(arc.centre.imag) < _NONE), []).append(arc)
    for number, ((_, is_ball), group) in enumerate(groups.items(), 1):
        arc = group[0]
        before = f"{sheet_words(language, 'ball')} R" if is_ball else "R"
        places = counted_words(language, "places_of", len(group))
        # leaders come from outside of the material
        yield Round(f"radius.{number}", arc.centre, arc.radius, before, is_radius=True, inward=arc.sweep * turn < 0,
                    angles=arc_angles(arc), places=places)  # fmt: skip
