"""The faces of a worm whose thread ends in axial planes, or whose tool leaves its spaces: bands on one cylinder.

All columns lie in axial planes. Where the tool leaves, cells end where a line of the section has left the cylinder of
the tips: the last line of a cell comes to a point there. Between two bands the cylinder is cut along its axis wherever
both have a column, or one of them has and the other has come to its end.
"""

from __future__ import annotations

import math

import numpy as np

from geometry.approximation.tensor import axis_poles, clamped, greville
from geometry.curves.curve import Real
from geometry.gears.worms.band import Band, Cell
from geometry.gears.worms.body import WormBody
from geometry.gears.worms.shaft_faces import REST, WormRings
from geometry.gears.worms.strips import DEGREE, fitted_knots
from geometry.solids import faces as kinds
from geometry.solids.faces import Frame, Index, Spline, Straight, Use, turned_over
from geometry.solids.rings import UP


class _Side:
    """One side of every band, from the lower end to the upper one: a row of its lists for each column or cell.

    ``corners``: of each column the vertices (n,) of its joints, the last on the outer rim of the section; ``helices``:
    of each cell the edges (n,) from the joints where its lines begin; ``rims``: along the ends of its last line;
    ``across``: of each column the edges along its lines.
    """

    def __init__(self) -> None:
        self.corners: list[list[Index]] = []
        self.corner_points: list[list[Index]] = []
        self.helices: list[list[Index]] = []
        self.helix_points: list[list[Index]] = []
        self.across: list[list[Index]] = []
        self.across_points: list[list[Index]] = []

    def first(self) -> list[Index]:
        """The edges where the section begins, at the root."""
        return [row[0] for row in self.helices]

    def rims(self) -> list[Index]:
        """The edges where it ends, at the tip."""
        return [row[-1] for row in self.helices]


class BandFaces(WormRings):
    """Bands on their cylinder."""

    def __init__(self, body: WormBody, band: Band, tolerance: float) -> None:
        super().__init__(body)
        self.band, self.lines = band, band.lines
        alike = band.cells(self.step, REST)
        self.kinds = alike
        # every cell by itself
        self.cells = [
            Cell(c.low + k * c.step, c.high + k * c.step, c.last, c.ends) for c in alike for k in range(c.alike)
        ]
        self.knots = fitted_knots(len(self.lines), self._sampled, tolerance, self.worm.tip_radius)
        self.sides: dict[int, _Side] = {}

    # points -----------------------------------------------------------------------------------------------------

    def _grid(self, side: int, cell: Cell, k: int, u: Real, v: Real) -> Real:
        """Points (u, v, 3) of a side of band 0 over line k of a cell."""
        low, high = self.lines[k].domain
        angle, ends = self.band.angles(cell, v)
        stop = ends if k == cell.last else np.full_like(ends, high)
        flat, z = self.band.places(side, self.lines[k].point(low + (stop - low) * u[:, None]), angle)
        return np.stack([flat.real, self.worm.sign * flat.imag, np.broadcast_to(z, flat.shape)], axis=-1)

    def _sampled(self, k: int, u: Real, v: Real) -> Real:
        """Points of one side over line k of one of all cells that are alike; half a turn about x makes the other."""
        return np.stack([self._grid(1, cell, k, u, v) for cell in self.kinds if k <= cell.last])

    # faces ------------------------------------------------------------------------------------------------------

    def threaded(self) -> None:
        """Both sides of all bands, what lies between these, and the cylinder about them."""
        for side in (1, -1):
            self.sides[side] = self._strip(side)
        axial = self._middles()
        if self.band.kind > 0:
            self._end_planes(axial)
        self._about(axial)

    def _strip(self, side: int) -> _Side:
        made = _Side()
        u_knots, v_knots = self.knots.along, self.knots.around
        v, whole = greville(DEGREE, v_knots), np.array([0.0, 1.0])
        lasts = [c.last for c in self.cells]
        # a column has the lines that both cells beside it have to their very end
        for column in range(len(self.cells) + 1):
            beside = [self.cells[c] for c in (column - 1, column) if 0 <= c < len(self.cells)]
            low = column < len(self.cells)
            cell = self.cells[column] if low else self.cells[-1]
            count = min(lasts[c] for c in (column - 1, column) if 0 <= c < len(self.cells)) + 1
            if len(beside) == 1 and self.band.run_out:
                count = 0
            at = whole[:1] if low else whole[1:]
            joints = [self._grid(side, cell, k, whole[:1], at)[0] for k in range(min(count, cell.last) + 1)]
            if count > cell.last:
                joints.append(self._grid(side, cell, cell.last, whole[1:], at)[0])
            places = [self.placed(p)[:, 0] for p in joints]
            own = [self.add_vertices(p) for p in places]
            made.corners.append(own)
            made.corner_points.append(places)
            lines, points = [], []
            for k in range(count):
                exact = self._grid(side, cell, k, greville(DEGREE, u_knots[k]), at)
                inner = self.placed(axis_poles(DEGREE, u_knots[k], exact, 0)[1:-1, 0])
                poles = np.concatenate([places[k][:, None], inner, places[k + 1][:, None]], axis=1)
                points.append(poles)
                lines.append(self.add_edges(own[k], own[k + 1], Spline(DEGREE, u_knots[k], poles)))
            made.across.append(lines)
            made.across_points.append(points)
        for number, cell in enumerate(self.cells):
            before, after = made.corners[number], made.corners[number + 1]
            edges, points = [], []
            for k in range(cell.last + 2):
                exact = self._grid(side, cell, min(k, cell.last), whole[:1] if k <= cell.last else whole[1:], v)
                inner = self.placed(axis_poles(DEGREE, v_knots, exact, 1)[0, 1:-1])
                start, end = before[min(k, len(before) - 1)], after[min(k, len(after) - 1)]
                ends = [made.corner_points[c][min(k, len(made.corner_points[c]) - 1)] for c in (number, number + 1)]
                poles = np.concatenate([ends[0][:, None], inner, ends[1][:, None]], axis=1)
                points.append(poles)
                edges.append(self.add_edges(start, end, Spline(DEGREE, v_knots, poles)))
            made.helices.append(edges)
            made.helix_points.append(points)
        for k in range(len(self.lines)):
            done = 0
            for kind in self.kinds:
                if k <= kind.last:
                    self._patches(made, side, k, range(done, done + kind.alike))
                done += kind.alike
        return made

    def _patches(self, made: _Side, side: int, k: int, cells: range) -> None:
        """The faces over line k of cells that are alike."""
        u_knots, v_knots = self.knots.along[k], self.knots.around
        rows, loops = [], []
        ways: list[bool] = []
        for number in cells:
            exact = self._grid(side, self.cells[number], k, greville(DEGREE, u_knots), greville(DEGREE, v_knots))
            poles = axis_poles(DEGREE, v_knots, axis_poles(DEGREE, u_knots, exact, 0), 1)
            grid = np.empty((len(self.starts), *poles.shape[:2]), dtype=np.intp)
            grid[:, 1:-1, 1:-1] = self.placed(poles[1:-1, 1:-1])
            grid[:, 0], grid[:, -1] = made.helix_points[number][k], made.helix_points[number][k + 1]
            around: list[Use] = []
            for column, at, forwards in ((number, 0, True), (number + 1, -1, False)):
                if k < len(made.across[column]):
                    grid[:, :, at] = made.across_points[column][k]
                    around.append((made.across[column][k], forwards))
                else:
                    # the line has come to a point
                    grid[:, :, at] = grid[:, :1, at]
            around.append((made.helices[number][k], False))
            around.insert(1 if around[0][1] else 0, (made.helices[number][k + 1], True))
            rows.append(grid)
            loops.append([edge for edge, _ in around])
            ways = [way for _, way in around]
        surface = kinds.SplineSurface((DEGREE, DEGREE), u_knots, v_knots, np.concatenate(rows))
        columns = zip(*loops, strict=True)
        uses: list[Use] = [(np.concatenate(column), way) for column, way in zip(columns, ways, strict=True)]
        up = side * self.band.kind > 0
        if not up:
            uses = turned_over(uses)
        self.face(surface, uses, along=up, threaded=True)

    def _middles(self) -> list[Index]:
        """Tips of ridges, roots of grooves; upright edges at both ends on the cylinder, of ridges at the tips too."""
        lower, upper = self.sides[-1], self.sides[1]
        ridge = self.band.kind > 0
        foot, head = (s.rims() if ridge else s.first() for s in (lower, upper))
        corner = -1 if ridge else 0
        axial = [
            self.add_edges(a[corner], b[corner], Straight(UP))
            for a, b in zip(lower.corners, upper.corners, strict=True)
        ]
        far = self.pipe(self.worm.tip_radius if ridge else self.worm.root_radius)
        done = 0
        for kind in self.kinds:
            own = range(done, done + kind.alike)
            done += kind.alike
            bundle = [np.concatenate([row[c] for c in own]) for row in (foot, head)]
            left, right = (np.concatenate([axial[c + k] for c in own]) for k in (0, 1))
            around: list[Use] = [(bundle[0], True), (right, True), (bundle[1], False), (left, False)]
            if kind.ends[0] == kind.ends[1]:
                self.face(far, around)
            else:
                low, high = (s.helix_points[own[0]][0] for s in (lower, upper))
                knots = clamped(DEGREE, np.array([0.0, 1.0]))
                share = greville(DEGREE, knots)[:, None]
                ends = [np.concatenate(self.points)[row] for row in (low, high)]
                between = ends[0][:, None] * (1 - share[..., None]) + ends[1][:, None] * share[..., None]
                inner = between[:, 1:-1]
                points = self.add_points(inner[..., 0] + 1j * inner[..., 1], inner[..., 2])
                grid = np.concatenate([low[:, None], points, high[:, None]], axis=1)
                self.face(kinds.SplineSurface((DEGREE, DEGREE), knots, self.knots.around, grid), around,
                          along=False, threaded=True)  # fmt: skip
        feet = [self.add_edges(lower.corners[c][0], upper.corners[c][0], Straight(UP)) for c in (0, -1) if ridge]
        return [*feet, axial[0], axial[-1]]

    def _end_planes(self, axial: list[Index]) -> None:
        """The axial planes in which threads end."""
        turns = math.tau * self.starts / len(self.starts)
        for end, foot, top in ((-1, axial[0], axial[2]), (1, axial[1], axial[3])):
            column = 0 if end < 0 else -1
            angle = self.worm.sign * (end * self.band.half + turns)
            out = end * self.worm.sign
            normals = np.stack([-out * np.sin(angle), out * np.cos(angle), np.zeros(len(angle))], axis=1)
            origin = self.on_axis(0.0)
            # as the plane is seen from beyond the upper end
            around: list[Use] = [(foot, True)]
            around += [(edge, True) for edge in self.sides[1].across[column]]
            around.append((top, False))
            around += [(edge, False) for edge in reversed(self.sides[-1].across[column])]
            if end < 0:
                around = turned_over(around)
            self.face(kinds.Plane(Frame(origin, normals, UP)), around)

    # cylinder ---------------------------------------------------------------------------------------------------

    def _about(self, axial: list[Index]) -> None:
        """The cylinder between each band and the one above it."""
        band, n = self.band, len(self.starts)
        height, radius, end = band.height(), band.radius, band.end
        ridge, above = band.kind > 0, np.roll(np.arange(n), 1)
        upper, lower = self.sides[1], self.sides[-1]
        corner = 0 if ridge else -1
        feet = [row[corner] for row in upper.corners]
        heads = [row[corner][above] for row in lower.corners]
        up_edges = upper.first() if ridge else upper.rims()
        down_edges = [row[above] for row in (lower.first() if ridge else lower.rims())]
        # even steps by their numbers, counted about this band's middle
        first = sum(c.alike for c in self.kinds[: self._even()])
        count = self.kinds[self._even()].alike if self.kinds[self._even()].step else 0
        # a short band has no column on an even step
        levels = {k: first + k for k in range(count + 1)} if count else {}

        def angle_of(number: int) -> float:
            return self.band.turned + (number - count / 2) * self.step

        nodes = ({k: feet[c] for k, c in levels.items()}, {k - self.between: heads[c] for k, c in levels.items()})
        pitch, margin = math.tau / n, REST * self.step / 2
        room = [(at - pitch + margin + self.band.turned, at - margin + self.band.turned) for at in (-end, end)]
        on_low, on_high, lines = self.uprights(sorted({*nodes[0], *nodes[1]}), nodes, angle_of, room, radius, height)
        # where the bands end: upright lines to the circles, both of one band, taken with the band above too
        ends = {s: self.on_circle(radius, self.band.turned + s * end, s * height) for s in (-1, 1)}
        low_corner, high_corner = lower.corners[0][corner], upper.corners[-1][corner]
        uprights = {-1: self.add_edges(ends[-1], low_corner, Straight(UP)),
                    1: self.add_edges(high_corner, ends[1], Straight(UP))}  # fmt: skip
        low_nodes = [ends[-1][above], *on_low, ends[-1]]
        bottom, _ = self.arcs(radius, -height, low_nodes)
        bottom_nodes = [*low_nodes, low_corner, *feet]
        own_bottom = len(bottom)
        bottom += [(uprights[-1], True), (axial[0], True), *((edge, True) for edge in up_edges), (uprights[1], True)]
        bottom_nodes += [ends[1]]
        high_nodes = [ends[1][above], *on_high, ends[1]]
        arcs, _ = self.arcs(radius, height, high_nodes)
        top: list[Use] = [(uprights[-1][above], True), *((edge, True) for edge in down_edges),
                          (axial[1][above], True), (uprights[1][above], True), *arcs]  # fmt: skip
        top_nodes = [ends[-1][above], *heads, upper.corners[-1][corner][above], *high_nodes]
        for s, own in ((-1, bottom[:own_bottom]), (1, arcs)):
            self.rims[s] = [(np.array([edge[j]]), way) for j in range(n) for edge, way in own]
        edges = [self.add_edges(foot, head, Straight(UP)) for foot, head in lines]
        surface = self.pipe(radius)
        for around in self.panels(edges, lines, (bottom, bottom_nodes), (top, top_nodes)):
            self.face(surface, around)

    def _even(self) -> int:
        """Which kind of cells has even steps."""
        return next((k for k, c in enumerate(self.kinds) if c.step), 0)
