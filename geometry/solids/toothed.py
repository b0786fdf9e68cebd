"""The faces of teeth whose sides are splines between two ends: a fillet and a flank each, on every tooth of a wheel.

From the lower root over the tip to the upper root a tooth has six corners at each end: root, joint and tip of its lower
side, and the same of its upper side back. Ends are the outer (0) and the inner one (1).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from geometry.approximation.outline import Outline
from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from geometry.solids.body import Body
from geometry.solids.body_faces import BodyFaces
from geometry.solids.faces import (
    Circular,
    Cone,
    Cylinder,
    Index,
    Loop,
    Spline,
    SplineSurface,
    Straight,
    Use,
    turned_over,
)

# parts of a side, from the root on
FILLET, FLANK = 0, 1
_MIRROR = np.array([1.0, -1.0, 1.0])


class ToothWall(Record, eq=False):
    """A fillet or a flank of the upper side: knots from root to tip and inwards, poles (u, v, 3), mm.

    ``degrees``: both ways; 1 along the tooth where it is ruled.
    """

    degrees: tuple[int, int]
    across: Real
    along: Real
    poles: Real


class ToothEdges(Record, eq=False):
    """Edges and corners of all teeth: ``corners`` (n, 6) at both ends, ``radial`` from corner to corner inwards.

    ``ends``: at each end those along a fillet or flank, by side (-1, 1) and part, from root to tip.
    """

    corners: tuple[Index, Index]
    radial: Mapping[int, Index]
    ends: tuple[Mapping[tuple[int, int], Index], Mapping[tuple[int, int], Index]]

    def over(self, end: int, tip: Index) -> list[Use]:
        """Over a tooth at an end, from the lower root to the upper one; ``tip``: the edges of its land."""
        at = self.ends[end]
        rise: list[Use] = [(at[-1, FILLET], True), (at[-1, FLANK], True), (tip, True)]
        return [*rise, (at[1, FLANK], False), (at[1, FILLET], False)]


class ToothedFaces(BodyFaces):
    """The faces of a ``core`` with teeth, which take the place of its first wall.

    ``turns``: those of the teeth, unit numbers; ``rims``: what stands in place of that wall, by its loops.
    """

    def __init__(self, core: Body, outlines: Sequence[Outline], teeth: int) -> None:
        super().__init__(core, outlines)
        self.turns: Complex = np.exp(2j * math.pi * np.arange(teeth) / teeth)
        self.rims: dict[int, Loop] = {}

    def within(self) -> None:
        """All faces of the core but those of its first wall."""
        for wall in self.body.walls[1:]:
            self.wall(wall)
        for cap in self.body.caps:
            self.face(cap)

    def around(self, loop: int, left: bool) -> Loop:
        """The loop of a face, which runs about teeth where the core begins."""
        return self.rims[loop] if loop in self.rims else super().around(loop, left)

    def circle_arcs(self, radius: float, z: float, start: Index, stop: Index) -> Index:
        """Arcs about the axis at a height, mm, counter-clockwise."""
        return self.add_edges(start, stop, Circular(self.frame_at(z), radius))

    def skirt(
        self, surface: Cylinder | Cone, rim: tuple[float, float], low: Index, way: Real, feet: Index, roots: Index,
        over: list[Use],
    ) -> None:  # fmt: skip
        """Tooth by tooth the outside, from a circle (radius, height) with vertices ``low`` along ``way`` to teeth."""
        lines = self.add_edges(low, feet, Straight(way))
        arcs = self.circle_arcs(*rim, low, np.roll(low, -1))
        around = [(arcs, True), (np.roll(lines, -1), True), (roots, False), *turned_over(over), (lines, False)]
        self.bounded(surface, around)
        self.rims[self.body.walls[0].lower] = arcs[::-1][None], np.full(len(arcs), False)

    def on_teeth(self, points: Real) -> Index:
        """Numbers of points (k, 3) of one tooth on all teeth, (n, k)."""
        plane = self.turns[:, None] * (points[:, 0] + 1j * points[:, 1])
        return self.add_points(plane, np.broadcast_to(points[:, 2], plane.shape))

    def sides(self, walls: Mapping[int, Sequence[ToothWall]]) -> ToothEdges:
        """The faces of both sides; fillet and flank ``walls[-1]`` are those of which the lower side is the image."""
        corners, points = [], []
        for end in (0, -1):
            lower, upper = (
                np.array([fillet.poles[0, end], flank.poles[0, end], flank.poles[-1, end]])
                for fillet, flank in (walls[-1], walls[1])
            )
            points.append(self.on_teeth(np.concatenate([lower * _MIRROR, upper[::-1]])))
            corners.append(np.stack([self.add_vertices(column) for column in points[-1].T], axis=1))
        radial: dict[int, Index] = {}
        ruled = [part for part in (FILLET, FLANK) if walls[1][part].degrees[1] == 1]
        for corner in sorted({k for part in ruled for k in (part, part + 1, 4 - part, 5 - part)}):
            begin, stop = (column[:, corner] for column in corners)
            way = self.place(stop) - self.place(begin)
            radial[corner] = self.add_edges(begin, stop, Straight(way / np.linalg.norm(way, axis=1)[:, None]))
        ends: tuple[dict[tuple[int, int], Index], dict[tuple[int, int], Index]] = {}, {}
        for side, part in ((s, p) for s in (-1, 1) for p in (FILLET, FLANK)):
            first, last = (part, part + 1) if side < 0 else (5 - part, 4 - part)
            wall = walls[side][part]
            grid = self._grid(wall.poles * (_MIRROR if side < 0 else 1.0), points, first, last)
            for end in (0, 1):
                curve = Spline(wall.degrees[0], wall.across, grid[:, :, -end])
                ends[end][side, part] = self.add_edges(corners[end][:, first], corners[end][:, last], curve)
            for corner, u in ((first, 0), (last, -1)):
                if corner not in radial:
                    line = Spline(wall.degrees[1], wall.along, grid[:, u])
                    radial[corner] = self.add_edges(corners[0][:, corner], corners[1][:, corner], line)
            around = [(ends[0][side, part], True), (radial[last], True), (ends[1][side, part], False),
                      (radial[first], False)]  # fmt: skip
            surface = SplineSurface(wall.degrees, wall.across, wall.along, grid)
            self.bounded(surface, around if side < 0 else turned_over(around), along=side < 0)
        return ToothEdges((corners[0], corners[1]), radial, ends)

    def _grid(self, poles: Real, ends: Sequence[Index], first: int, last: int) -> Index:
        """Numbers (n, u, v) of poles (u, v, 3) on all teeth, whose corners stand already."""
        inner = np.ones(poles.shape[:2], bool)
        inner[np.ix_((0, -1), (0, -1))] = False
        grid = np.empty((len(self.turns), *poles.shape[:2]), int)
        grid[:, inner] = self.on_teeth(poles[inner])
        for u, corner in ((0, first), (-1, last)):
            for v in (0, 1):
                grid[:, u, -v] = ends[v][:, corner]
        return grid
