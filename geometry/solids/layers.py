"""Solids of layers: closed contours at heights, material within an odd number of them.

A contour that goes on into the next layer goes on as one wall. What one layer has and the next has not is a plane face:
the regions between contours, told by how deep they are nested in both layers. Contours of one layer and of its
neighbours lie within each other or apart; they neither cross nor touch.
"""

from __future__ import annotations

import math
from functools import cached_property
from itertools import pairwise

import numpy as np

from geometry.base.errors import GeometryError, OffsetError, ParameterError
from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import Arc, Line
from geometry.plane.measure import distance_to_plain
from geometry.plane.profile import Label, Profile, Region, Segment
from geometry.solids.body import Body, BodyBuilder
from geometry.solids.plate import Edge, boxes_meet, moved_edges

# points of an arc where contours are held against each other: at most, and of one of 1 mm
_SAMPLES, _OF_ONE = 128, 64.0


class Contour(Record, dict=True):
    """A closed counter-clockwise chain of lines and arcs, mm; a circle is one of two arcs about its centre."""

    edges: tuple[Edge, ...]

    @cached_property
    def circle(self) -> tuple[complex, float] | None:
        """Centre and radius of one that is a circle."""
        arcs = [e for e in self.edges if isinstance(e, Arc)]
        one = len(arcs) == len(self.edges) and len({(a.centre, a.radius) for a in arcs}) == 1
        return (arcs[0].centre, arcs[0].radius) if one else None

    @cached_property
    def points(self) -> Complex:
        """Along it, without the end."""
        found = []
        for edge in self.edges:
            count = min(_SAMPLES, math.ceil(_OF_ONE * math.sqrt(edge.radius))) if isinstance(edge, Arc) else 1
            found.append(edge.point(np.linspace(*edge.domain, count + 1)[:-1]))
        return np.concatenate(found)

    @cached_property
    def box(self) -> tuple[float, float, float, float]:
        """Least and greatest x, least and greatest y."""
        x, y = self.points.real, self.points.imag
        return float(x.min()), float(x.max()), float(y.min()), float(y.max())

    @cached_property
    def _lines(self) -> tuple[Complex, Complex]:
        """Starts and ends of its lines."""
        lines = [e for e in self.edges if isinstance(e, Line)]
        return np.array([e.start for e in lines], complex), np.array([e.end for e in lines], complex)

    def lines_near(self, box: tuple[float, float, float, float]) -> tuple[Complex, Complex]:
        """Starts and ends of the lines between its points that may come into a box."""
        start, end = self.points, np.roll(self.points, -1)
        corners = np.array([complex(*box[::2])]), np.array([complex(*box[1::2])])
        near = boxes_meet(*_boxes(start, end), *corners)[:, 0]
        return start[near], end[near]

    def span(self, place: complex) -> tuple[float, float]:
        """Least and greatest distance of the contour from a place, mm."""
        start, end = self._lines
        share = ((place - start) * np.conj(end - start)).real / np.maximum(np.abs(end - start) ** 2, 1e-300)
        found = [np.abs(start + np.clip(share, 0.0, 1.0) * (end - start) - place), np.abs(start - place)]
        for arc in (e for e in self.edges if isinstance(e, Arc)):
            found += [distance_to_plain(np.array([place]), arc), np.abs(arc.point(np.array(arc.domain)) - place)]
            # opposite to the foot
            if arc.foot(np.array([2 * arc.centre - place]))[1][0]:
                found.append(np.array([abs(place - arc.centre) + arc.radius]))
        every = np.concatenate(found)
        return float(every.min()), float(every.max())

    def moved(self, offset: float, *, hole: bool) -> Profile:
        """The boundary of the material within it, or about it, moved ``offset`` mm out of that."""
        edges = moved_edges(self.edges, -offset if hole else offset)
        if hole:
            edges = tuple(e.reversed() for e in reversed(edges))
        return Profile(tuple(Segment(e, Label.HOLE if hole else Label.BODY) for e in edges))


class Nest(Record, dict=True):
    """Contours that lie within each other or apart."""

    contours: tuple[Contour, ...]

    @cached_property
    def corners(self) -> tuple[Complex, Complex]:
        """The lowest and the highest corners of their boxes."""
        x, y = np.array([c.box for c in self.contours]).reshape(-1, 2, 2).transpose(1, 2, 0)
        return x[0] + 1j * y[0], x[1] + 1j * y[1]

    def about(self, one: Contour) -> list[Contour]:
        """Those that a contour lies within."""
        (low, high), (x, x_end, y, y_end) = self.corners, one.box
        near = (low.real < x) & (high.real > x_end) & (low.imag < y) & (high.imag > y_end)
        return [self.contours[k] for k in np.flatnonzero(near).tolist() if _within(one, self.contours[k])]


class Layer(Record):
    """So thick, mm, within an odd number of contours."""

    thickness: float
    contours: tuple[Contour, ...]


class Layers(Record, dict=True):
    """Layers upon each other, the lowest at z = 0."""

    layers: tuple[Layer, ...]

    @cached_property
    def heights(self) -> tuple[float, ...]:
        """Of all faces, from 0 upwards, mm."""
        return (0.0, *np.cumsum([layer.thickness for layer in self.layers]).tolist())

    @cached_property
    def _depths(self) -> list[dict[Contour, bool]]:
        """For each layer its contours, and whether each is a hole."""
        nests = [Nest(layer.contours) for layer in self.layers]
        return [{c: len(nest.about(c)) % 2 == 1 for c in nest.contours} for nest in nests]

    def checked(self) -> Layers:
        """Refuse contours that cross or touch in a layer, or one layer's and the next one's.

        Raises
        ------
        ParameterError
            ``layers[k].contours[i]``; ``other``: that one which it meets.
        """
        for number, layer in enumerate(self.layers, 1):
            own = [(f"layers[{number}].contours[{k}]", c) for k, c in enumerate(layer.contours, 1)]
            above = self.layers[number].contours if number < len(self.layers) else ()
            beside = [(f"layers[{number + 1}].contours[{k}]", c) for k, c in enumerate(above, 1)]
            every = [*own, *beside]
            lowest, highest = Nest(tuple(c for _, c in every)).corners
            boxes = ((lowest[k : k + 1], highest[k : k + 1]) for k in range(len(own)))
            near = enumerate(boxes_meet(*box, lowest, highest)[0] for box in boxes)
            pairs = ((every[k], every[j]) for k, meets in near for j in np.flatnonzero(meets).tolist() if j > k)
            for (one, first), (two, second) in pairs:
                # what goes on is one wall
                same = first == second and two.startswith(f"layers[{number}].")
                if same or (first != second and _crosses(first, second)):
                    raise ParameterError(two, None, "contours_cross", other=one)
        for number, (low, high) in enumerate(pairwise(self._depths), 1):
            for k, (contour, hole) in enumerate(low.items(), 1):
                if high.get(contour, hole) != hole:
                    raise ParameterError(f"layers[{number}].contours[{k}]", None, "contour_turns")
        if len(set(self._pieces().values())) > 1:
            raise ParameterError("layers", None, "layers_fall_apart")
        return self

    def _pieces(self) -> dict[tuple[int, Contour], int]:
        """For the outlines of every layer, the number of the piece that they belong to."""
        found = {(k, c): 0 for k, depths in enumerate(self._depths) for c, hole in depths.items() if not hole}
        found = {key: number for number, key in enumerate(found)}
        for k, (low, high) in enumerate(pairwise(self._depths)):
            nests = [Nest(tuple(side)) for side in (low, high)]
            for inner in {**low, **high}:
                owners = [_owner(inner, nest) for nest in nests]
                if owners[0] is None or owners[1] is None:
                    continue
                one, two = found[k, owners[0]], found[k + 1, owners[1]]
                if one != two:
                    found = {key: one if number == two else number for key, number in found.items()}
        return found

    def region(self, offset: float = 0.0) -> Region:
        """The largest piece of the layer with the largest outline."""
        outers = ((c, depths) for depths in self._depths for c, hole in depths.items() if not hole)
        outer, depths = max(outers, key=lambda found: _extent(found[0]))
        inside = [c for c, hole in depths.items() if hole and _within(c, outer)]
        nest = Nest((*inside, outer))
        held = [c for c in inside if nest.about(c) == [outer]]
        return Region(outer.moved(offset, hole=False), tuple(c.moved(offset, hole=True) for c in held))

    def body(self, offset: float = 0.0) -> Body:
        """The solid, every wall moved ``offset`` mm out of the material.

        Raises
        ------
        OffsetError
            A contour vanishes.
        """
        made, heights = BodyBuilder(), self.heights
        profiles: dict[tuple[Contour, bool], Profile] = {}
        try:
            for depths in self._depths:
                for contour, hole in depths.items():
                    if (contour, hole) not in profiles:
                        profiles[contour, hole] = contour.moved(offset, hole=hole)
        except GeometryError as refusal:
            raise OffsetError(offset, str(refusal.args[-1])) from refusal
        empty: dict[Contour, bool] = {}
        walls = [empty, *self._depths, empty]
        for k, depths in enumerate(self._depths):
            for contour, hole in depths.items():
                if contour in walls[k]:
                    continue
                end = k + 1
                while contour in walls[end + 1]:
                    end += 1
                made.upright(profiles[contour, hole], heights[k], heights[end])
        for z, (low, high) in zip(heights, pairwise(walls), strict=True):
            self._faces(made, z, low, high, profiles)
        return made.body()

    def _faces(
        self,
        made: BodyBuilder,
        z: float,
        low: dict[Contour, bool],
        high: dict[Contour, bool],
        profiles: dict[tuple[Contour, bool], Profile],
    ) -> None:
        """The plane faces at a height between two layers."""
        edges = [c for c in {**low, **high} if (c in low) != (c in high)]
        both = [c for c in low if c in high]
        loops = {c: made.loop(profiles[c, {**low, **high}[c]], z) for c in edges}
        nest, sides = Nest((*edges, *both)), [(side, Nest(tuple(side))) for side in (low, high)]
        about = {c: nest.about(c) for c in nest.contours}
        # those just within each one
        inner: dict[Contour, list[Contour]] = {c: [] for c in nest.contours}
        for c in edges:
            for outer in (o for o in about[c] if len(about[o]) == len(about[c]) - 1):
                inner[outer].append(c)
        for outer in edges:
            states = [len(own.about(outer)) % 2 == (outer not in side) for side, own in sides]
            if states[0] != states[1]:
                made.cap(loops[outer], [loops[c] for c in inner[outer]], up=states[0])


def _owner(contour: Contour, nest: Nest) -> Contour | None:
    """The outline of the material of a layer just within a contour; None where there is none."""
    about = [*nest.about(contour), *(c for c in nest.contours if c == contour)]
    inmost = Nest(tuple(about))
    return max(about, key=lambda c: len(inmost.about(c))) if len(about) % 2 else None


def _extent(contour: Contour) -> float:
    low_x, high_x, low_y, high_y = contour.box
    return (high_x - low_x) * (high_y - low_y)


def _within(one: Contour, two: Contour) -> bool:
    """Whether a contour lies within another, given that they do not cross."""
    a, b = one.box, two.box
    if not (a[0] > b[0] and a[1] < b[1] and a[2] > b[2] and a[3] < b[3]):
        return False
    if two.circle is not None:
        return abs(complex(one.points[0]) - two.circle[0]) < two.circle[1]
    spokes = two.points - one.points[0]
    return bool(abs(np.angle(np.roll(spokes, -1) / spokes).sum()) > math.pi)


def _crosses(one: Contour, two: Contour) -> bool:
    """Whether two contours cross or touch."""
    a, b = one.box, two.box
    if a[1] < b[0] or b[1] < a[0] or a[3] < b[2] or b[3] < a[2]:
        return False
    if one.circle is not None and two.circle is not None:
        distance = abs(one.circle[0] - two.circle[0])
        return abs(one.circle[1] - two.circle[1]) <= distance <= one.circle[1] + two.circle[1]
    for round_one, other in ((one, two), (two, one)):
        if round_one.circle is not None:
            least, greatest = other.span(round_one.circle[0])
            return least <= round_one.circle[1] <= greatest
    (p, p_end), (q, q_end) = one.lines_near(b), two.lines_near(a)
    # two on one line lie on no side of each other, wherever they are
    i, j = np.nonzero(boxes_meet(*_boxes(p, p_end), *_boxes(q, q_end)))
    p, p_end, q, q_end = p[i], p_end[i], q[j], q_end[j]

    def sides(way: Complex, start: Complex, end: Complex) -> Real:
        return np.asarray((np.conj(way) * start).imag * (np.conj(way) * end).imag)

    over, under = sides(p_end - p, q - p, q_end - p), sides(q_end - q, p - q, p_end - q)
    return bool(((over <= 0) & (under <= 0)).any())


def _boxes(starts: Complex, ends: Complex) -> tuple[Complex, Complex]:
    """The lowest and the highest corners of the rectangles about lines."""
    both = np.array([starts, ends])
    return both.real.min(axis=0) + 1j * both.imag.min(axis=0), both.real.max(axis=0) + 1j * both.imag.max(axis=0)
