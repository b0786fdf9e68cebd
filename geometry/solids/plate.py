"""Flat bodies bounded by lines and arcs, with round holes and slots, every boundary moved exactly.

Outwards every convex corner gets its arc, inwards every concave one; at the others neighbours are cut where they
cross. A rounding that an offset consumes is dropped and its neighbours meet.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from functools import partial

import numpy as np

from geometry.base.errors import GeometryError, OffsetError, ParameterError
from geometry.base.nearest import kept, moved
from geometry.base.record import Record
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import Complex, Flags, Real, end_point, start_point
from geometry.curves.line_arc import Arc, Line, arc_between
from geometry.plane.measure import distance_to_plain
from geometry.plane.offset_region import OffsetRegion
from geometry.plane.profile import Label, Profile, Region, Segment, circle, joint_turn

Edge = Line | Arc
_ARC_SAMPLES, _MOST_SAMPLES = 24, 4096
# as a part of the edges beside it
_LEAST_ROUNDING = 1e-9
# what is left for a hole at a place that has no room for one, mm
_LEAST_HOLE = 1e-3
# mm, and the share of the smallest hole that is less: a thinner wall is none in a file
_LEAST_WALL = 1e-6
# of the reach
_TOUCH = 1e-12
# edges that meet so near to an end of one, part of the greatest place, or so flat, rad, do not cross
_AT_END, _ANGLE = 1e-9, 1e-4


class PlateHole(Record):
    """A round hole at ``centre``, mm."""

    centre: complex
    diameter: float

    def profile(self, offset: float) -> Profile:
        """The clockwise boundary, moved ``offset`` mm out of the material."""
        if not offset < self.diameter / 2:
            raise OffsetError(offset, "hole_closed", self.diameter / 2 * (1 - 1e-6))
        return circle(self.diameter / 2 - offset, Label.HOLE, hole=True, centre=self.centre)


class PlateSlot(Record):
    """A slot with round ends about the centres ``start`` and ``end``, mm."""

    start: complex
    end: complex
    width: float

    def profile(self, offset: float) -> Profile:
        """The clockwise boundary, moved ``offset`` mm out of the material."""
        radius = self.width / 2 - offset
        if not radius > 0:
            raise OffsetError(offset, "slot_closed", self.width / 2 * (1 - 1e-6))
        along = cmath.phase(self.end - self.start)
        left = 1j * cmath.rect(radius, along)
        edges: list[Edge] = [
            Line(self.start + left, self.end + left),
            Arc(self.end, radius, along + math.pi / 2, -math.pi),
            Line(self.end - left, self.start - left),
            Arc(self.start, radius, along - math.pi / 2, -math.pi),
        ]
        return Profile(tuple(Segment(e, Label.HOLE) for e in edges))


class PlateOutline(Record):
    """A counter-clockwise outline of lines and arcs, and holes in it."""

    edges: tuple[Edge, ...]
    holes: tuple[PlateHole | PlateSlot, ...] = ()

    def region(self, offset: float = 0.0) -> OffsetRegion:
        """The section, every boundary moved ``offset`` mm out of the material.

        Raises
        ------
        OffsetError
            Something vanishes or two boundaries meet; names the offset nearest to it that works.
        """
        return OffsetRegion(moved(self._region, offset), offset, ())

    def check_holes(self, keys: Sequence[str]) -> None:
        """Refuse holes that touch each other or the edge; ``keys`` name the size of each."""
        sizes = [_size(hole) for hole in self.holes]
        wall = 2 * _LEAST_WALL * min([1.0, *sizes])
        rooms = dict[str, tuple[float, float]]()
        clearances = _clearances(self.edges, self.holes).tolist()
        for k, (key, size, clear) in enumerate(zip(keys, sizes, clearances, strict=True)):
            if not (size > 0 and clear >= wall):
                # the wall goes by the smallest hole, which this one may become
                others, whole = min([1.0, *sizes[:k], *sizes[k + 1 :]]), size + 2 * clear
                room = max(whole - 4 * _LEAST_WALL * others, whole / (1 + 4 * _LEAST_WALL)) if size > 0 else -math.inf
                rooms[key] = size, min(room, rooms.get(key, (size, room))[1])
        # several holes may have one key: the one that has least room tells what works
        for key, (size, room) in rooms.items():
            if not room >= _LEAST_HOLE:
                raise ParameterError(key, size, "hole_lies_outside")
            raise ParameterError.beyond(key, size, "hole_reaches_edge", room * (1 - 1e-6))

    def exists(self, offset: float = 0.0) -> bool:
        """Whether there is such a section."""
        return kept(self._region, offset)

    def _region(self, offset: float) -> Region:
        edges = moved_edges(self.edges, offset)
        outer = Profile(tuple(Segment(e, Label.BODY) for e in edges))
        holes = tuple(h.profile(offset) for h in self.holes)
        if crosses_itself(edges):
            raise GeometryError("boundary_crosses_itself")
        clear = _clearances(edges, self.holes, offset)
        # where they touch on purpose rounding may decide
        if clear.size and clear.min() < -_TOUCH * outer.reach():
            raise GeometryError("boundaries_cross" if clear.min() > -math.inf else "hole_lies_outside")
        return Region(outer, holes)


def moved_profile(edges: Sequence[Edge], offset: float) -> Profile:
    """A closed chain, material on its left, moved ``offset`` mm out of the material.

    Raises
    ------
    OffsetError
        An edge vanishes; names the offset nearest to it that works.
    """
    return Profile(tuple(Segment(e, Label.BODY) for e in moved(partial(moved_edges, edges), offset)))


def moved_edges(edges: Sequence[Edge], offset: float, *, sharp: bool = False) -> tuple[Edge, ...]:
    """A closed counter-clockwise chain moved ``offset`` mm to its right, corners rounded or cut, or kept ``sharp``.

    Raises
    ------
    GeometryError
        An edge vanishes.
    """
    if offset == 0:
        return tuple(edges)
    kept = [(e, _carrier(e, offset)) for e in edges]
    alive = [(edge, carrier) for edge, carrier in kept if carrier is not None]
    ends: list[tuple[complex, Arc | None, complex]] = []
    for index, (edge, carrier) in enumerate(alive):
        following, after = alive[(index + 1) % len(alive)]
        ends.append(_joint(edge, carrier, following, after, 0.0 if sharp else offset))
    made: list[Edge] = []
    for index, (_, carrier) in enumerate(alive):
        leaving, arc, _ = ends[index]
        made.append(_between(carrier, ends[index - 1][2], leaving, sharp=sharp))
        if arc is not None:
            made.append(arc)
    return tuple(made)


def _carrier(edge: Edge, offset: float) -> Edge | None:
    """The moved edge; None where an arc is consumed."""
    if isinstance(edge, Arc):
        # what rounding leaves of a radius is none
        left = edge.radius + math.copysign(offset, edge.sweep * offset)
        if left <= _LEAST_ROUNDING * edge.radius:
            return None
    return edge.offset(-offset)


def _joint(
    edge: Edge, carrier: Edge, following: Edge, after: Edge, offset: float
) -> tuple[complex, Arc | None, complex]:
    """Where a moved edge ends, the arc about the corner if there is one, and where the next one starts."""
    corner = end_point(edge)
    adjacent = abs(start_point(following) - corner) <= TOLERANCES.relative_join * (abs(corner) + 1)
    turn = joint_turn(edge, following)
    if adjacent and abs(turn) <= TOLERANCES.smooth_angle:
        return end_point(carrier), None, end_point(carrier)
    if adjacent and turn * offset > 0:
        first, last = end_point(carrier), start_point(after)
        return first, Arc(corner, abs(offset), cmath.phase(first - corner), turn), last
    middle = corner if adjacent else (corner + start_point(following)) / 2
    found = min(_crossings(carrier, after), key=lambda p: abs(p - middle), default=None)
    if found is None:
        raise GeometryError("no_edge_between_corners")
    return found, None, found


def _between(carrier: Edge, start: complex, end: complex, *, sharp: bool) -> Edge:
    """The part of a moved edge between two points of it."""
    if isinstance(carrier, Line):
        way = complex(carrier.tangent(0.0))
        if not ((end - start) * way.conjugate()).real > 0:
            raise GeometryError("edge_consumed")
        return Line(start, end)
    made = arc_between(carrier.centre, start, end, carrier.sweep > 0)
    whole = abs(carrier.sweep)
    # what is cut off on both sides is never longer than the arc, what sharp corners add less than half a turn; one that
    # goes round again has turned over
    if abs(made.sweep) > (whole + math.pi if sharp else whole * (1 + 1e-9) + 1e-12):
        raise GeometryError("arc_consumed")
    return made


def _crossings(one: Edge, two: Edge) -> list[complex]:
    """Points that the whole lines or circles of two edges have in common."""
    if isinstance(one, Line) and isinstance(two, Line):
        u, v = one.end - one.start, two.end - two.start
        whole = (u.conjugate() * v).imag
        if whole == 0:
            return []
        return [one.start + u * (((two.start - one.start).conjugate() * v).imag / whole)]
    if isinstance(one, Arc) and isinstance(two, Arc):
        apart = two.centre - one.centre
        distance = abs(apart)
        if distance == 0:
            return []
        along = (distance**2 + one.radius**2 - two.radius**2) / (2 * distance)
        return _both(one.centre + along * apart / distance, 1j * apart / distance, one.radius**2 - along**2)
    line, arc = (one, two) if isinstance(one, Line) else (two, one)
    assert isinstance(line, Line)
    assert isinstance(arc, Arc)
    way = complex(line.tangent(0.0))
    foot = line.start + way * ((arc.centre - line.start) * way.conjugate()).real
    return _both(foot, way, arc.radius**2 - abs(foot - arc.centre) ** 2)


def _both(middle: complex, way: complex, square: float) -> list[complex]:
    if square < 0:
        return []
    half = math.sqrt(square)
    return [middle - half * way, middle + half * way]


def _size(hole: PlateHole | PlateSlot) -> float:
    """Its diameter or its width, mm."""
    return hole.diameter if isinstance(hole, PlateHole) else hole.width


def _clearances(edges: Sequence[Edge], holes: Sequence[PlateHole | PlateSlot], offset: float = 0.0) -> Real:
    """How far each hole, grown by -``offset``, lies off the edge and the holes before it, mm (n,): below 0 it crosses.

    Exact where holes are nearer than a wall, farther ones may be left out: distances between its middle line, a point
    where it is round, and theirs, less what is about these; -inf where it lies outside.
    """
    if not holes:
        return np.zeros(0)
    ends = [(h.centre, h.centre) if isinstance(h, PlateHole) else (h.start, h.end) for h in holes]
    start, end = np.array(ends, dtype=np.complex128).T
    radius = np.array([_size(h) for h in holes]) / 2 - offset
    outer = Profile(tuple(Segment(e, Label.BODY) for e in edges))
    # chords that are nearer to their arcs than the middle of the smallest hole may be
    sharpest = max((e.radius * e.sweep**2 for e in edges if isinstance(e, Arc)), default=0.0)
    fine = math.ceil(math.sqrt(sharpest / (4 * max(radius.min(), _LEAST_WALL))))
    polygon = _polygon(outer, min(max(_ARC_SAMPLES, fine), _MOST_SAMPLES))
    inside = np.array([_winding(complex(place), polygon) == 1 for place in start])
    off_edge = np.min([_off_edge(edge, start, end) for edge in edges], axis=0) - radius
    # only those whose boxes meet may lie nearer to each other than a wall
    corners = np.sort(np.array([[start.real, end.real], [start.imag, end.imag]]), axis=1)
    low, high = corners[0] + 1j * corners[1] + np.array([[-1 - 1j], [1 + 1j]]) * (radius + _LEAST_WALL)
    one, two = np.nonzero(np.tril(boxes_meet(low, high, low, high), -1))
    before = np.full(len(holes), np.inf)
    np.minimum.at(before, one, _off_line(start[one], end[one], start[two], end[two]) - radius[one] - radius[two])
    return np.where(inside, np.minimum(off_edge, before), -np.inf)


def _off_edge(edge: Edge, start: Complex, end: Complex) -> Real:
    """Distances of lines (n,) from an edge, mm: at their ends, at its own, where they cross it or are nearest to it."""
    if isinstance(edge, Line):
        return _off_line(np.array(edge.start), np.array(edge.end), start, end)
    way = end - start
    square = np.where(way == 0, 1.0, np.abs(way) ** 2)
    middle = ((edge.centre - start) * np.conj(way)).real / square
    half = np.sqrt(np.maximum(edge.radius**2 - np.abs(start + middle * way - edge.centre) ** 2, 0.0) / square)
    shares = (np.zeros(start.shape), np.ones(start.shape), middle, middle - half, middle + half)
    found = [distance_to_plain(start + np.clip(share, 0.0, 1.0) * way, edge) for share in shares]
    return np.min(
        [*found, *(_off_point(np.array(p), start, end) for p in (start_point(edge), end_point(edge)))], axis=0
    )


def _off_line(first: Complex, last: Complex, start: Complex, end: Complex) -> Real:
    """Distances between lines from ``first`` to ``last`` and others, mm, all broadcast: 0 where they cross."""
    along, way = last - first, end - start
    across = (way * np.conj(along)).imag
    share = ((first - start) * np.conj(along)).imag / np.where(across == 0, 1.0, across)
    crossing = _off_point(start + np.clip(share, 0.0, 1.0) * way, first, last)
    ends = [_off_point(p, first, last) for p in (start, end)] + [_off_point(p, start, end) for p in (first, last)]
    return np.minimum.reduce([crossing, *ends])


def _off_point(points: Complex, start: Complex, end: Complex) -> Real:
    """Distances of points from lines, mm, all broadcast."""
    way = end - start
    share = ((points - start) * np.conj(way)).real / np.where(way == 0, 1.0, np.abs(way) ** 2)
    return np.abs(points - start - np.clip(share, 0.0, 1.0) * way)


def meets_itself(edges: Sequence[Edge]) -> bool:
    """Whether two edges of a closed chain meet anywhere but in the corner that they share."""
    corners = np.array([start_point(e) for e in edges])
    near, count = _AT_END * float(np.abs(corners).max()), len(edges)
    low, high = np.array([_box(e) for e in edges]).T
    # a corner that lies on an edge lies in its box
    lies = boxes_meet(low - near * (1 + 1j), high + near * (1 + 1j), corners, corners)
    own = np.arange(count)
    lies[own, own] = lies[own, (own + 1) % count] = False
    for k in np.flatnonzero(lies.any(axis=1)).tolist():
        others = corners[lies[k]]
        if float(_off_edge(edges[k], others, others).min()) <= near:
            return True
    return crosses_itself(edges)


def crosses_itself(edges: Sequence[Edge]) -> bool:
    """Whether two edges of a boundary meet within both at an angle."""
    low, high = np.array([_box(e) for e in edges]).T
    near = _AT_END * float(np.abs([low, high]).max())
    pairs = np.argwhere(np.triu(boxes_meet(low, high, low, high), 1))
    straight = np.array([isinstance(e, Line) for e in edges])[pairs].all(axis=1)
    ends = np.array([(start_point(e), end_point(e)) for e in edges])
    one_way, other = ends[pairs[straight]].transpose(1, 2, 0)
    if _lines_cross(one_way, other, near):
        return True
    for i, j in pairs[~straight].tolist():
        one, two = edges[i], edges[j]
        for place in _crossings(one, two):
            first, second = (_way_within(e, place, near) for e in (one, two))
            if first is not None and second is not None and abs((first.conjugate() * second).imag) > _ANGLE:
                return True
    return False


def boxes_meet(low: Complex, high: Complex, lowest: Complex, highest: Complex) -> Flags:
    """Which boxes (n,) have a place in common with which others (m,), by their corners: (n, m)."""
    found = (low.real[:, None] <= highest.real) & (high.real[:, None] >= lowest.real)
    return found & (low.imag[:, None] <= highest.imag) & (high.imag[:, None] >= lowest.imag)


def _lines_cross(one: Complex, two: Complex, near: float) -> bool:
    """Whether a line of a pair (start and end, (2, n)) crosses the other at an angle, off the ends of both."""
    u, v, across = one[1] - one[0], two[1] - two[0], two[0] - one[0]
    whole = (u.conj() * v).imag
    angled = np.abs(whole) > _ANGLE * np.abs(u) * np.abs(v)
    whole = np.where(angled, whole, 1.0)
    # shares of both lines at which they cross
    shares = np.array([(across.conj() * v).imag / whole, (across.conj() * u).imag / whole])
    margins = near / np.where(angled, np.abs([u, v]), 1.0)
    return bool((angled & ((shares > margins) & (shares < 1 - margins)).all(axis=0)).any())


def _box(edge: Edge) -> tuple[complex, complex]:
    """The lowest and the highest corner of the rectangle about an edge."""
    ends = [start_point(edge), end_point(edge)]
    if isinstance(edge, Arc):
        farthest = (edge.centre + edge.radius * 1j**k for k in range(4))
        ends += [place for place in farthest if _is_along(edge, place)]
    x, y = [end.real for end in ends], [end.imag for end in ends]
    return complex(min(x), min(y)), complex(max(x), max(y))


def _is_along(arc: Arc, place: complex) -> bool:
    """Whether a place of its circle lies on an arc."""
    turn = cmath.phase((place - arc.centre) * (start_point(arc) - arc.centre).conjugate())
    return math.copysign(1.0, arc.sweep) * turn % math.tau < abs(arc.sweep)


def _way_within(edge: Edge, place: complex, near: float) -> complex | None:
    """Direction of an edge at a place of its whole line or circle; None beyond its ends, or so near to one."""
    if min(abs(place - start_point(edge)), abs(place - end_point(edge))) <= near:
        return None
    if isinstance(edge, Arc):
        return 1j * (place - edge.centre) / edge.radius if _is_along(edge, place) else None
    way = edge.end - edge.start
    return way / abs(way) if 0 < ((place - edge.start) * way.conjugate()).real < abs(way) ** 2 else None


def _polygon(profile: Profile, count: int) -> Complex:
    """The starts of its lines, so many points of each arc."""
    return np.concatenate([
        np.array([c.start]) if isinstance(c := s.curve, Line) else c.point(np.linspace(*c.domain, count + 1)[:-1])
        for s in profile.period
    ])  # fmt: skip


def _winding(point: complex, polygon: Complex) -> int:
    """How often a polygon runs round a point."""
    spokes = polygon - point
    if not spokes.all():
        # on its corner: neither inside (1) nor outside (0)
        return 2
    return round(float(np.angle(np.roll(spokes, -1) / spokes).sum()) / (2 * math.pi))


def rounded(corners: Sequence[tuple[complex, float]]) -> tuple[Edge, ...]:
    """The closed outline through corners (point, rounding radius), counter-clockwise; mm.

    A rounding that is lost beside its corner's neighbours is none.

    Raises
    ------
    GeometryError
        A rounding that its edges have no room for.
    """
    cut = []
    for index, (corner, radius) in enumerate(corners):
        before, after = corners[index - 1][0] - corner, corners[(index + 1) % len(corners)][0] - corner
        u, v = before / abs(before), after / abs(after)
        turn = cmath.phase(-v / u)
        radius = radius if radius > _LEAST_ROUNDING * min(abs(before), abs(after)) else 0.0
        reach = radius * abs(math.tan(turn / 2))
        cut.append((corner + reach * u, corner + reach * v, turn, u, radius))
    edges: list[Edge] = []
    for index, (enter, _, turn, u, radius) in enumerate(cut):
        last = cut[index - 1][1]
        way = enter - last
        whole = corners[index][0] - corners[index - 1][0]
        if (way * whole.conjugate()).real < -1e-9 * abs(whole) ** 2:
            raise GeometryError("roundings_meet")
        if abs(way) > 1e-9 * abs(whole):
            edges.append(Line(last, enter))
        if radius > 0 and turn != 0:
            centre = enter - 1j * u * math.copysign(radius, turn)
            edges.append(Arc(centre, radius, cmath.phase(enter - centre), turn))
    return tuple(edges)


def belt(first: tuple[complex, float], second: tuple[complex, float]) -> tuple[Edge, ...]:
    """The hull of two circles (centre, radius), the second to the right of the first or anywhere else; mm."""
    (one, small), (two, large) = first, second
    apart = two - one
    if not abs(apart) > abs(large - small):
        raise GeometryError("end_within_the_other")
    lean = math.asin((small - large) / abs(apart))
    along = cmath.phase(apart)
    low, high = along - math.pi / 2 + lean, along + math.pi / 2 - lean
    a, b = one + cmath.rect(small, low), two + cmath.rect(large, low)
    c, d = two + cmath.rect(large, high), one + cmath.rect(small, high)
    return (
        Line(a, b),
        Arc(two, large, low, math.pi - 2 * lean),
        Line(c, d),
        Arc(one, small, high, math.pi + 2 * lean),
    )
