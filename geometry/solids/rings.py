"""Closed rings of edges over finished curves, and what is swept, capped and ruled between them.

A ring is one period of curves in all its places: each curve is one bundle of edges.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from geometry.approximation.outline import CadCurve, Outline
from geometry.base.record import Record, replace
from geometry.curves.bspline import BSpline
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import Arc
from geometry.solids.faces import (
    Circular,
    Cone,
    Cylinder,
    Extrusion,
    Faces,
    Frame,
    Index,
    Loop,
    Plane,
    SolidBuilder,
    Spline,
    SplineSurface,
    Straight,
    Surface,
)  # fmt: skip

# what is one radius, part of it
_SAME = 1e-12
UP, AHEAD = np.array([[0.0, 0.0, 1.0]]), np.array([[1.0, 0.0, 0.0]])


class Slot(Record, eq=False):
    """One curve of a ring as walls over it take it: vertices where it starts, points and edges, a row for each place.

    Where walls come to a point it has no curve, and that point alone.
    """

    start: Index
    points: Index
    curve: CadCurve | None = None
    shape: Straight | Circular | Spline | None = None
    edges: Index | None = None


class Ring(Record, eq=False):
    """The edges of a closed boundary across the axis: its curves, and a bundle for each, a row for each of ``turns``.

    ``points``: those of the curves' poles, of lines and arcs their ends; ``starts``: vertices. ``present``: which
    curves of the walls beside it there are, the last one among them; by default all.
    """

    curves: tuple[CadCurve, ...]
    turns: Complex
    starts: tuple[Index, ...]
    points: tuple[Index, ...]
    shapes: tuple[Straight | Circular | Spline, ...]
    edges: tuple[Index, ...]
    present: tuple[bool, ...] = ()

    def slots(self) -> list[Slot]:
        """A slot for every curve of the walls beside it."""
        found: list[Slot] = []
        rows = zip(self.starts, self.points, self.curves, self.shapes, self.edges, strict=True)
        own = [Slot(*row) for row in rows]
        for is_there in reversed(self.present or (True,) * len(own)):
            found.append(own.pop() if is_there else Slot(found[-1].start, found[-1].points[:, :1]))
        return found[::-1]

    def loop(self, *, forwards: bool) -> Loop:
        """The ring as the loop of one face."""
        edges = np.stack(self.edges, axis=1).reshape(1, -1)
        return edges if forwards else edges[:, ::-1], np.full(edges.shape[1], forwards)


class RingBuilder(SolidBuilder):
    """Builds rings, and the faces between two of one period; ``ahead``: where faces about the axis are cut open."""

    ahead = AHEAD

    def ring(self, outline: Outline, z: float, turn: float = 0.0, shift: complex = 0j) -> Ring:
        """The ring of an outline at height z mm, turned (rad) and moved (mm)."""
        curves, angles = outline.places()
        turns = np.exp(1j * (angles + turn))
        corners = [self.add_points(turns * complex(c.point(c.domain[0])) + shift, z) for c in curves]
        starts = [self.add_vertices(points) for points in corners]
        shapes: list[Straight | Circular | Spline] = []
        points, edges = [], []
        for i, curve in enumerate(curves):
            inner = np.zeros((len(turns), 0), dtype=np.intp)
            if isinstance(curve, BSpline):
                inner = self.add_points(turns[:, None] * curve.poles[1:-1] + shift, z)
            points.append(np.concatenate([corners[i][:, None], inner, following(corners, i)[:, None]], axis=1))
            if isinstance(curve, Arc):
                centres = turns * curve.centre + shift
                origin = self.add_points(centres, z) if curve.centre else self.on_axis(z, shift)
                shapes.append(Circular(Frame(origin, math.copysign(1, curve.sweep) * UP, AHEAD), curve.radius))
            elif isinstance(curve, BSpline) and inner.size:
                shapes.append(Spline(curve.degree, curve.knots, points[i]))
            else:
                shapes.append(Straight(spatial(turns * _way(curve), 0.0)))
            edges.append(self.add_edges(starts[i], following(starts, i), shapes[i]))
        return Ring(curves, turns, tuple(starts), tuple(points), tuple(shapes), tuple(edges))

    def frame_at(self, z: float) -> Frame:
        """The upright frame at height z mm."""
        return Frame(self.on_axis(z), UP, self.ahead)

    def pipe(self, radius: float) -> Cylinder:
        """The cylinder about the axis, its radius in mm."""
        return Cylinder(self.frame_at(0.0), radius)

    def lathed(self, start: complex, end: complex) -> Cylinder | Cone:
        """What a line of half a section, r + iz, sweeps about the axis; a cone's axis runs to where it is wider."""
        narrow, wide = sorted((start, end), key=lambda place: place.real)
        if narrow.real == wide.real:
            return Cylinder(self.frame_at(start.imag), start.real)
        slant = math.atan2(wide.real - narrow.real, abs(wide.imag - narrow.imag))
        way = UP if wide.imag > narrow.imag else -UP
        if narrow.real == 0:
            # an apex is no place for a surface to begin
            narrow = (narrow + wide) / 2
        return Cone(Frame(self.on_axis(narrow.imag), way, self.ahead), narrow.real, slant)

    def cap(self, z: float, loops: Sequence[Loop], *, up: bool) -> None:
        """A plane face at height z mm."""
        self.faces.append(Faces(Plane(self.frame_at(z)), tuple(loops), up))

    def swept(self, lower: Ring, upper: Ring, way: Real) -> None:
        """Faces swept along a direction (1, 3)."""
        slots = list(zip(lower.slots(), upper.slots(), strict=True))
        corners = [self.add_edges(low.start, high.start, Straight(way)) for low, high in slots]
        for i, (low, high) in enumerate(slots):
            if isinstance(low.shape, Circular) and way[0, 2] == 1:
                self._cylinder(low, high, corners, i)
            elif isinstance(low.shape, Straight):
                self._between(low, high, corners, i, _plane(lower, low, way))
            else:
                assert low.edges is not None
                self._between(low, high, corners, i, Extrusion(low.edges, way))

    def ruled(
        self,
        lower: Ring,
        upper: Ring,
        height: tuple[float, float],
        along: BSpline,
        rise: Real,
        grids: Sequence[Complex],
        round_faces: Mapping[int, tuple[Surface, bool]] | None = None,
    ) -> None:
        """Faces between rings of which one may be turned or narrower: poles over each curve (u, v) in the plane.

        ``rise``: their heights (v,), mm; ``along``: a spline on their knots v. Planes over lines, cylinders and cones
        over arcs (whose grids are those of their ends), splines over all else. ``round_faces``: the surfaces over
        curves where they are others, and whether their normals point outwards. Over a curve that one ring has not
        faces come to a point, over one that none has there is none.
        """
        slots = list(zip(lower.slots(), upper.slots(), strict=True))
        corners, points = self._corners(lower.turns, slots, along, rise, [grid[0] for grid in grids])
        for i, (grid, (low, high)) in enumerate(zip(grids, slots, strict=True)):
            curve = low.curve or high.curve
            if curve is None:
                continue
            if round_faces and i in round_faces:
                surface, outwards = round_faces[i]
                self._between(low, high, corners, i, surface, along=outwards)
            elif isinstance(low.shape, Circular) and isinstance(high.shape, Circular):
                self._cylinder(low, high, corners, i, high.shape.radius - low.shape.radius, height)
            elif isinstance(curve, BSpline):
                surface = self._tensor(lower.turns, curve, (low, high), points, i, along, rise, grid)
                self._between(low, high, corners, i, surface)
            else:
                slant = spatial(lower.turns * complex(grid[0, -1] - grid[0, 0]), height[1] - height[0])
                self._between(low, high, corners, i, _plane(lower, low, slant))

    def _between(
        self, low: Slot, high: Slot, corners: Sequence[Index], i: int, surface: Surface, *, along: bool = True
    ) -> None:
        """The faces over curve i between two rings and the edges from corner to corner."""
        around = (low.edges, True), (following(corners, i), True), (high.edges, False), (corners[i], False)
        self.bounded(surface, [(edges, way) for edges, way in around if edges is not None], along=along)

    def _cylinder(
        self, low: Slot, high: Slot, corners: Sequence[Index], i: int, widening: float = 0.0,
        height: tuple[float, float] = (0.0, 1.0),
    ) -> None:  # fmt: skip
        """The cylinders over arcs, or the cones to wider or narrower ones, whose axes run to where they are wider."""
        shape = low.shape
        assert isinstance(shape, Circular)
        surface: Surface = Cylinder(replace(shape.frame, axis=UP), shape.radius)
        # radii that differ by rounding only are one
        if abs(widening) > _SAME * shape.radius:
            narrow, up = (shape, UP) if widening > 0 else (high.shape, -UP)
            assert isinstance(narrow, Circular)
            slant = math.atan2(abs(widening), height[1] - height[0])
            surface = Cone(replace(narrow.frame, axis=up), narrow.radius, slant)
        self._between(low, high, corners, i, surface, along=isinstance(low.curve, Arc) and low.curve.sweep > 0)

    def _corners(
        self, turns: Complex, slots: Sequence[tuple[Slot, Slot]], along: BSpline, rise: Real, rows: Sequence[Complex]
    ) -> tuple[list[Index], list[Index]]:
        """The edges from corner to corner with poles ``rows`` at heights ``rise``, and the points of these poles."""
        found: list[tuple[Index, Index] | None] = []
        for (low, high), row in zip(slots, rows, strict=True):
            if low.curve is None and high.curve is None:
                found.append(None)
                continue
            inner = self.add_points(turns[:, None] * row[1:-1], rise[1:-1])
            own = np.concatenate([low.points[:, :1], inner, high.points[:, :1]], axis=1)
            straight = Straight(spatial(turns * complex(row[-1] - row[0]), rise[-1] - rise[0]))
            shape = Spline(along.degree, along.knots, own) if inner.size else straight
            found.append((self.add_edges(low.start, high.start, shape), own))
        # where there is nothing between them neighbours meet
        whole = [next(x for x in found[k:] if x is not None) for k in range(len(found))]
        return [x[0] for x in whole], [x[1] for x in whole]

    def _tensor(
        self, turns: Complex, section: BSpline, ends: tuple[Slot, Slot], corners: Sequence[Index], i: int,
        along: BSpline, rise: Real, grid: Complex,
    ) -> SplineSurface:  # fmt: skip
        """Splines over curve i; at their rims they have the poles of the edges there."""
        poles = np.empty((len(turns), *grid.shape), dtype=np.intp)
        poles[:, 1:-1, 1:-1] = self.add_points(turns[:, None, None] * grid[1:-1, 1:-1], rise[1:-1])
        poles[:, 0], poles[:, -1] = corners[i], following(corners, i)
        poles[:, :, 0], poles[:, :, -1] = ends[0].points, ends[1].points
        return SplineSurface((section.degree, along.degree), section.knots, along.knots, poles)


def following(rows: Sequence[Index], i: int) -> Index:
    """Of rows by curve that of the curve after curve i: after the last one comes the first of the next place."""
    return rows[i + 1] if i + 1 < len(rows) else np.roll(rows[0], -1, axis=0)


def spatial(plane: Complex, rise: float) -> Real:
    """Directions (n, 3) of steps in the plane with a rise, mm."""
    steps = np.stack([plane.real, plane.imag, np.full(len(plane), rise)], axis=1)
    return np.asarray(steps / np.linalg.norm(steps, axis=1)[:, None])


def _way(curve: CadCurve) -> complex:
    """From its start to its end, mm."""
    return complex(curve.point(curve.domain[1]) - curve.point(curve.domain[0]))


def _plane(lower: Ring, low: Slot, slant: Real) -> Plane:
    """The planes over a ring's lines along slants (n or 1, 3)."""
    assert low.curve is not None
    way = spatial(lower.turns * _way(low.curve), 0.0)
    normal = np.cross(way, slant)
    return Plane(Frame(low.points[:, 0], normal / np.linalg.norm(normal, axis=1)[:, None], way))
