"""Meshes of solids of faces: every edge sampled once, every face triangulated in the plane of its parameters.

A face between four sides gets a grid, stitched to the points of its edges, on splines rows as far apart as they are
bent (``spacing.py``); any other one the Delaunay triangles of its bounds and of a grid within them. How far the
triangles leave their surfaces is proven on planes and surfaces of revolution (the sagitta of the meridian and that of
the angle), and sampled on splines.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from types import UnionType

import numpy as np

from geometry.base.errors import ConvergenceError, ParameterError, ThinWallError
from geometry.base.record import Record, replace
from geometry.curves.bounds import Bound
from geometry.curves.curve import Complex, Flags, Real
from geometry.solids.charts import (
    Chart,
    Patch,
    along_edges,
    arcs,
    charts,
    edge_rows,
    patch_of,
    span_shares,
    spline_rows,
)
from geometry.solids.faced import FacedBody, Proof
from geometry.solids.faces import Circular, Cone, Edges, Extrusion, Faces, Solid, Sphere, Spline, SplineSurface, Torus
from geometry.solids.unrolled import Side, unrolled
from parts.solids.caps import Triangles, grid_decimals, library_triangles, numbered
from parts.solids.flips import constrained, inner_cells
from parts.solids.grids import Grid, grid_between, rows_between
from parts.solids.spacing import Bends, bend_places, graded

# shares of the tolerance: of edges between faces that are bent one way, or both ways; of a grid along u and v
_SINGLE, _DOUBLE, _ALONG, _ACROSS = 0.98, 0.55, 0.5, 0.4
# how often the grid of a face narrower than so many rad is made finer before the whole mesh is
_FINER, _NARROW = 10, 0.5
# by how much the sagitta of a patch is made smaller where it was passed: to so much of it, and at most to a part
_SAFE, _LEAST_SHARE = 0.9, 0.3
# by how much chords are made shorter where those of a face cross, of the sagitta; where a smaller one changed hardly
# anything, since as few chords did for it
_LESS, _HALF, _NO_BETTER = 0.25, 0.5, 0.99
# what splines may take of it
_SPLINES = 0.1
# more triangles than a file of any format carries
_MOST_ROUNDS, _MOST_TRIANGLES = 10, 2_000_000
# tolerances below such a part of a solid may ask for too many
_FINE = 1e-5
# arcs are cut into chords no longer than this, rad; samples for the bend of splines, each span
_WIDEST, _INNER = math.pi / 4, np.linspace(0, 1, 5)
# how near to the truth a proof shall be, part of the tolerance
_SLACK = 0.04
# what is added to the greatest distance of few samples, and of many, which triangles have that lie so near the worst,
# and all where so few span a patch that the few samples tell little of each
_MARGIN, _CLOSE, _WORST, _WIDE = 1.15, 1.05, 0.85, 100
# a corner of a face turns by more than this in the unit square, rad
_CORNER = 0.4
# where the many samples of a triangle stand, in barycentric shares; points at a time
_DENSE = np.array([(a, b, 5 - a - b) for a in range(6) for b in range(6 - a)]) / 5
_AT_ONCE = 4_000
# of the corners (u, v) 00, 01, 10, 11 of a patch those at the ends of its sides along u, and along v, either way
_SIDES = ((0, 2), (2, 0), (1, 3), (3, 1)), ((0, 1), (1, 0), (2, 3), (3, 2))
# differences by which two patches are one turned, part of the solid
_ALIKE = 1e-9
# decimals of the grid on which triangles of bent faces are chosen, in steps of theirs
_STEP_DIGITS = 7
# radius at which a surface is its pole, part of the greatest of a face
_AT_POLE = 1e-9
# angles at which a pole stands in the plane of a face
_ROUND_POLE = 33


class FaceMesh(Record, eq=False):
    """Vertices (n, 3), mm, triangles (k, 3), and how far they leave the solid, like an Approximation."""

    vertices: Real
    geometry: Triangles
    max_error: float
    bound: Bound
    tolerance: float


def face_mesh(solid: Solid, tolerance: float, proof: Proof | None = None) -> FaceMesh:
    """A closed mesh within ``tolerance`` mm of a solid; ``proof``: see ``FacedBody``.

    Raises
    ------
    ParameterError
        The tolerance asks for more triangles than a file can carry.
    ConvergenceError
        It is not kept.
    ThinWallError
        The chords of a face's edges touch or cross.
    """
    target, error, crossed = tolerance, math.inf, None
    for _ in range(_MOST_ROUNDS):
        made, before = _Mesher(solid, target, proof), error
        try:
            error = made.run()
        except ThinWallError as thin:
            # chords of a narrow face cross: finer ones do not
            crossed, target = thin, target * _LESS
            continue
        crossed = None
        if error <= tolerance:
            vertices, triangles = np.concatenate(made.points), np.concatenate(made.triangles)
            return FaceMesh(vertices, triangles, error, made.bound, tolerance)
        target *= max(0.95 * tolerance / error, 0.1) if error < _NO_BETTER * before else _HALF
    if crossed is not None:
        raise crossed
    raise ConvergenceError("mesh for the tolerance", error, _MOST_ROUNDS)


def faced_mesh(body: FacedBody, tolerance: float) -> FaceMesh:
    """A closed mesh within ``tolerance`` mm of a body told by its faces; splines take their share of it."""
    target = min(tolerance, body.coarsest) / body.sideways
    faces = body.within(_SPLINES * target)
    if body.proof is not None:
        return face_mesh(faces.geometry, target, body.proof)
    made = face_mesh(faces.geometry, target - faces.max_error)
    bound: Bound = "sampled" if "sampled" in (made.bound, faces.bound) else made.bound
    error = body.sideways * (made.max_error + faces.max_error)
    return replace(made, max_error=error, bound=bound, tolerance=tolerance)


class _Chain(Record, eq=False):
    """Points (n, k, 3) of a bundle of edges at shares (k,), and the numbers of their vertices (n, k)."""

    shares: Real
    points: Real
    numbers: Triangles


class _Mesher:
    """One mesh at one tolerance."""

    def __init__(self, solid: Solid, tolerance: float, proof: Proof | None) -> None:
        self.solid, self.tolerance, self.proof = solid, tolerance, proof
        # triangles on splines that are left to the proof
        self.unproven: list[Triangles] = []
        self.points: list[Real] = [solid.points[solid.vertices]]
        self.size = len(solid.vertices)
        self.triangles: list[Triangles] = []
        self.error, self.count = 0.0, 0
        self.bound: Bound = "exact"
        self.bundle, self.row = edge_rows(solid)
        self.reach = float(np.abs(solid.points).max())
        self.decimals = grid_decimals(float(np.abs(self.points[0]).max()))
        # sagittas that have done for patches, by their nets
        self.passed: dict[bytes, float] = {}
        self.bent, self.patched = (self._bounding(kinds) for kinds in (Torus | Sphere | SplineSurface, SplineSurface))
        shares = [self._own_shares(bundle, edges) for bundle, edges in enumerate(solid.edges)]
        # bundles of edges that one chord follows
        self.flat = {bundle for bundle, own in enumerate(shares) if len(own) == 2}
        # walls of cams, which are proven, are hardly twisted
        for bundle, chords in (self._twists() if proof is None else {}).items():
            shares[bundle] = np.linspace(0.0, 1.0, chords + 1)
        self.chains = [self._chain(edges, own) for edges, own in zip(solid.edges, shares, strict=True)]

    def run(self) -> float:
        """Triangles of all faces; the greatest distance, mm."""
        if self.tolerance < _FINE * self.reach:
            self._check_patches()
        for faces in self.solid.faces:
            if isinstance(faces.surface, SplineSurface | Extrusion):
                self._patches(faces)
            else:
                self._revolved(faces)
        if self.proof is not None:
            points = np.concatenate(self.points)
            self.error = max(self.error, self.proof([points[one] for one in self.unproven], _SLACK * self.tolerance))
        return self.error

    def _check_patches(self) -> None:
        """Refuse too many triangles on splines before any is made: no coarser rows than these are tried."""
        count = 0
        for faces in self.solid.faces:
            if isinstance(faces.surface, SplineSurface):
                patch = patch_of(self.solid, faces.surface)
                _, first, alike = np.unique(_nets(patch.poles), axis=0, return_index=True, return_counts=True)
                for one, times in zip(first.tolist(), alike.tolist(), strict=True):
                    _, rows = Bends(patch.rows(slice(one, one + 1))).rows(self.tolerance)
                    count += 2 * times * sum(map(len, rows))
        _check_count(self.tolerance, count)

    def _added(self, points: Real) -> Triangles:
        """The numbers of new vertices, of the shape of their points."""
        flat = points.reshape(-1, 3)
        self.points.append(flat)
        self.size += len(flat)
        return np.arange(self.size - len(flat), self.size).reshape(points.shape[:-1])

    def _bounding(self, kinds: UnionType | type) -> set[int]:
        """Bundles of edges that bound a face of some kinds."""
        own = [edges for faces in self.solid.faces if isinstance(faces.surface, kinds) for edges, _ in faces.loops]
        return set(np.unique(self.bundle[np.concatenate([x.ravel() for x in own])]).tolist()) if own else set()

    def _own_shares(self, bundle: int, edges: Edges) -> Real:
        """Where a bundle of edges is cut for its own bend."""
        sag = self.tolerance * (_DOUBLE if bundle in self.bent else _SINGLE)
        return _shares(self.solid, edges, sag, even=bundle not in self.patched)

    def _twists(self) -> dict[int, int]:
        """Chords of flat edges that twisted spline faces ask for, by bundle: one would be a base of wide triangles."""
        found: dict[int, int] = {}
        for faces in self.solid.faces:
            surface, bounds = faces.surface, faces.loops[0][0][0]
            flat = [edge for edge in bounds.tolist() if self.bundle[edge] in self.flat]
            if not flat or not isinstance(surface, SplineSurface):
                continue
            patch = patch_of(self.solid, surface)
            chords = Bends(patch.rows(_templates(patch.poles))).chords(_DOUBLE * self.tolerance)
            for edge in flat:
                bundle, row = int(self.bundle[edge]), self.row[edge]
                edges = self.solid.edges[bundle]
                ends = self.solid.points[self.solid.vertices[[edges.start[row], edges.end[row]]]]
                found[bundle] = max(found.get(bundle, 1), chords[_runs_across(patch.poles[0], ends)])
        return found

    def _chain(self, edges: Edges, shares: Real) -> _Chain:
        points, _ = along_edges(self.solid, edges, shares)
        ends = self.solid.points[self.solid.vertices[np.stack([edges.start, edges.end], axis=1)]]
        points[:, 0], points[:, -1] = ends[:, 0], ends[:, 1]
        inner = self._added(points[:, 1:-1])
        return _Chain(shares, points, np.concatenate([edges.start[:, None], inner, edges.end[:, None]], axis=1))

    def _keep(self, triangles: Triangles, error: float, bound: Bound) -> None:
        self.triangles.append(triangles)
        self.count += len(triangles)
        _check_count(self.tolerance, self.count)
        self.error = max(self.error, error)
        if bound == "sampled" or (self.bound == "exact" and error > 0):
            self.bound = bound

    # ---- planes and surfaces of revolution

    def _revolved(self, faces: Faces) -> None:
        """Faces on planes and surfaces of revolution: each alone, or another one turned about its axis."""
        own = charts(self.solid, faces.surface, len(faces.loops[0][0]))
        loops = [(edges, np.broadcast_to(senses, edges.shape)) for edges, senses in faces.loops]
        keys = np.concatenate([x for edges, senses in loops for x in (self.bundle[edges], senses)], axis=1)
        for rows in sorted((group.tolist() for group in _groups(keys)), key=min):
            first, before, kept = own[rows[0]], self.size, len(self.points)
            triangles, error, bound = self._face(faces, rows[0], first)
            self._keep(triangles, error, bound)
            if len(rows) == 1:
                continue
            edges = np.concatenate([edges[rows].T for edges, _ in loops])
            ends = [(self.chains[self.bundle[one[0]]], self.row[one]) for one in edges]
            numbers = np.concatenate([chain.numbers[k] for chain, k in ends], axis=1)
            points = np.concatenate([chain.points[k] for chain, k in ends], axis=1)
            turns, off = _turns([own[row] for row in rows], points)
            names, at, back = np.unique(numbers[0], return_index=True, return_inverse=True)
            alike = (off <= _ALIKE * self.reach) & (numbers[:, at][:, back.ravel()] == numbers).all(axis=1)
            inner = np.concatenate([np.zeros((0, 3)), *self.points[kept:]])
            places = np.searchsorted(np.append(names, np.arange(before, before + len(inner))), triangles)
            for k, row in enumerate(rows[1:], 1):
                if alike[k]:
                    added = self._added(own[row].turned(first, inner, float(turns[k])))
                    self._keep(np.append(numbers[k, at], added)[places], error + float(off[k]), bound)
                else:
                    self._keep(*self._face(faces, row, own[row]))

    def _face(self, faces: Faces, row: int, chart: Chart) -> tuple[Triangles, float, Bound]:
        """One of them: triangles, and how far they leave it, mm."""
        loops: list[list[Side]] = []
        numbers: list[list[Triangles]] = []
        for edges, senses in faces.loops:
            ways = np.broadcast_to(senses, edges.shape)[row].tolist()
            runs, own = [], []
            for edge, way in zip(edges[row].tolist(), ways, strict=True):
                chain, at = self.chains[self.bundle[edge]], self.row[edge]
                runs.append(chain.points[at, :: 1 if way else -1])
                own.append(chain.numbers[at, :: 1 if way else -1])
            sides = unrolled(chart, runs, along=faces.along)
            loops.append(sides)
            numbers.append(
                [own[s.run] if s.run is not None else own[_before(sides, k)][-1:] for k, s in enumerate(sides)]
            )
        if not faces.along:
            # counter-clockwise in u and v
            loops = [[Side(s.u[::-1], s.v[::-1], s.run) for s in sides[::-1]] for sides in loops]
            numbers = [[n[::-1] for n in own[::-1]] for own in numbers]
        made = None if chart.is_plane or len(loops) > 1 else self._gridded(chart, loops[0], numbers[0])
        triangles, u, v = made or self._trimmed(chart, loops, numbers)
        found = triangles if faces.along else triangles[:, ::-1]
        if self.proof is not None:
            # corners that splines share may lie off the surface
            corners = np.concatenate([self.chains[self.bundle[e]].points[self.row[e]] for e in _edges_of(faces, row)])
            off = float(chart.distance(corners).max())
            return found, off + (0.0 if chart.is_plane else _sagitta(chart, u, v)), "certified"
        return (found, 0.0, "exact") if chart.is_plane else (found, _sagitta(chart, u, v), "certified")

    def _gridded(
        self, chart: Chart, sides: list[Side], numbers: list[Triangles]
    ) -> tuple[Triangles, Real, Real] | None:
        """A grid between four sides, if there are as many and it does not fold: triangles, and their u and v."""
        corners = _corners(sides)
        if len(corners) != 4:
            return None
        four = []
        for first, last in zip(corners, [*corners[1:], corners[0] + len(sides)], strict=True):
            which = [k % len(sides) for k in range(first, last)]
            uv = np.concatenate([_uv(sides[k])[0 if k == which[0] else 1 :] for k in which])
            own = np.concatenate([numbers[k][0 if k == which[0] else 1 :] for k in which])
            four.append((uv, own))
        ways = [float(uv[-1, 0] - uv[0, 0]) / (1e-300 + float(np.abs(uv[-1] - uv[0]).sum())) for uv, _ in four]
        begin = int(np.argmax(ways))
        four = four[begin:] + four[:begin]
        spread = np.ptp(np.concatenate([uv for uv, _ in four]), axis=0)
        grid = Grid(tuple(_measured(uv, own, spread, k % 2) for k, (uv, own) in enumerate(four)))
        counts = [len(own) - 1 for _, own in four]
        wide = max(float(np.ptp(four[k][0][:, 0])) for k in (0, 2))
        high = max(float(np.ptp(four[k][0][:, 1])) for k in (1, 3))
        u_count, v_count = max(counts[0], counts[2]), max(counts[1], counts[3])
        if chart.is_bent:
            largest = float(chart.meridian(np.concatenate([uv[:, 1] for uv, _ in four]))[0].max())
            if isinstance(chart.surface, Torus | Sphere):
                low, top = min(float(uv[:, 1].min()) for uv, _ in four), max(float(uv[:, 1].max()) for uv, _ in four)
                if math.floor(top / (2 * math.pi)) * 2 * math.pi >= low:
                    largest = float(chart.meridian(np.zeros(1))[0][0])
            u_count = max(u_count, math.ceil(wide / _chord(largest, _ALONG * self.tolerance)))
            v_count = max(v_count, math.ceil(high / _chord(_tube(chart), _ACROSS * self.tolerance)))
        for _ in range(_FINER if chart.is_bent and wide < _NARROW else 1):
            triangles, inner = grid_between(grid, u_count, v_count)
            uv = np.concatenate([grid.ring(), inner])
            uv[grid.collapsed(), 0] = np.nan
            if np.any(_turned(uv, triangles) <= 0):
                return None
            if _sagitta(chart, uv[triangles, 0], uv[triangles, 1]) <= self.tolerance:
                break
            # what is stitched to sides of unlike lengths is wider than the cells
            u_count, v_count = math.ceil(1.15 * u_count), math.ceil(1.15 * v_count)
        if not chart.is_bent and _sagitta(chart, uv[triangles, 0], uv[triangles, 1]) > self.tolerance:
            # sides of unlike lengths: what is stitched to them is wider than both
            return None
        names = np.concatenate([grid.names(), self._added(chart.spatial(inner[:, 0], inner[:, 1]))])
        return names[triangles], uv[triangles, 0], uv[triangles, 1]

    def _trimmed(
        self, chart: Chart, loops: list[list[Side]], numbers: list[list[Triangles]]
    ) -> tuple[Triangles, Real, Real]:
        """Triangles of any face, and their u and v."""
        rings, names = _closed(chart, loops, numbers)
        if chart.is_plane:
            # on a grid, as the vertices will stand: what machines round differently chooses no triangle
            plane = np.concatenate(rings).round(self.decimals)
            triangles = library_triangles(plane, numbered(rings))
        else:
            size = max(float(np.abs(chart.meridian(ring.imag)[0]).max()) for ring in rings)
            u_step = _chord(size, _ALONG * self.tolerance)
            high = max(float(np.ptp(ring.imag)) for ring in rings)
            # along rulings steps cost nothing
            v_step = _chord(_tube(chart), _ACROSS * self.tolerance) if chart.is_bent else max(high / 2, 1e-9)
            scaled = [(ring.real / u_step + 1j * ring.imag / v_step).round(_STEP_DIGITS) for ring in rings]
            cells = inner_cells(scaled) if chart.is_bent else None
            inside = cells.points if cells else np.zeros(0, complex)
            triangles = constrained(scaled, cells)
            plane = np.concatenate([*rings, inside.real * u_step + 1j * inside.imag * v_step])
            if len(inside):
                own = plane[-len(inside) :]
                names.append(self._added(chart.spatial(own.real, own.imag)))
        u, v = plane.real.copy(), plane.imag
        found = np.concatenate(names)[triangles]
        if not chart.is_plane:
            # all angles meet in a pole, where a side is a point
            u[np.abs(chart.meridian(v)[0]) <= _AT_POLE * size] = np.nan
            kept = np.all(found != np.roll(found, 1, axis=1), axis=1)
            triangles, found = triangles[kept], found[kept]
        return found, u[triangles], v[triangles]

    # ---- splines and extrusions

    def _patches(self, faces: Faces) -> None:
        """Faces between the ends of spline surfaces, one of which may be a point, or between two copies of a curve."""
        ((edges, senses),) = faces.loops
        senses = np.broadcast_to(senses, edges.shape)
        if not faces.along:
            edges, senses = edges[:, ::-1], ~senses[:, ::-1]
        patch = patch_of(self.solid, faces.surface) if isinstance(faces.surface, SplineSurface) else None
        # which of the four ends there are, in order round the patch
        ends = [0, 1, 2, 3]
        if patch is not None and edges.shape[1] == 3:
            around = patch.poles[0, [0, -1, -1, 0], [0, 0, -1, -1]]
            ends.pop(int(np.linalg.norm(np.roll(around, -1, axis=0) - around, axis=1).argmin()))
        first = self._begin(edges, senses, patch, ends[0])
        order = (first[:, None] + np.arange(len(ends))) % len(ends)
        edges, senses = np.take_along_axis(edges, order, axis=1), np.take_along_axis(senses, order, axis=1)
        for rows in _groups(np.concatenate([self.bundle[edges], senses], axis=1)):
            own = dict(zip(ends, zip(edges[rows].T, senses[rows[0]].tolist(), strict=True), strict=True))
            self._patch_group(own, patch and patch.rows(rows), flip=not faces.along)

    def _begin(self, edges: Triangles, senses: Flags, patch: Patch | None, end: int) -> Triangles:
        """The place in each loop of the edge that is one end of the patch: along u, at v's lower end, is the first."""
        ends = np.empty((*edges.shape, 2, 3))
        for k in np.unique(self.bundle[edges]).tolist():
            mine, chain = self.bundle[edges] == k, self.chains[k]
            ends[mine] = chain.points[self.row[edges[mine]]][:, [0, -1]]
        ends[~senses] = ends[~senses][:, ::-1]
        if patch is None:
            curved = np.array([bundle not in self.flat for bundle in range(len(self.chains))])
            return np.where(curved[self.bundle[edges[:, 0]]] | curved[self.bundle[edges[:, 2]]], 0, 1)
        corners = [(0, 0), (-1, 0), (-1, -1), (0, -1)]
        wanted = np.stack([patch.poles[:, u, v] for u, v in (corners[end], corners[(end + 1) % 4])], axis=1)
        return np.asarray(np.linalg.norm(ends - wanted[:, None], axis=-1).sum(axis=-1).argmin(axis=1))

    def _patch_group(self, ends: dict[int, tuple[Triangles, bool]], patch: Patch | None, *, flip: bool) -> None:
        """Patches whose edges (n,) are of the same bundles, with the way they run; an end that has none is a point."""
        grid, names, points = self._around(ends)
        ring = np.concatenate([n[:, :-1] for n in names], axis=1)
        if patch is None:
            triangles, inside = _ruled(grid, points)
            error = self.tolerance
        else:
            places = np.concatenate([p[:, :-1] for p in points], axis=1)
            triangles, inner, error = self._fine_enough(grid, places, patch)
            inside = patch.scattered(inner)[0]
        numbers = np.concatenate([ring, self._added(inside)], axis=1)
        found = _oriented(numbers[:, triangles].reshape(-1, 3), flip)
        if patch is None or self.proof is None:
            self._keep(found, error, "sampled")
        else:
            self._keep(found, 0.0, "certified")
            self.unproven.append(found)

    def _around(self, ends: dict[int, tuple[Triangles, bool]]) -> tuple[Grid, list[Triangles], list[Real]]:
        """The sides of such patches, and the numbers and places (n, k, 3) of the points along those that have edges."""
        sides, names, points = [], [], []
        for k in range(4):
            shares, kept = np.array([0.0, 1.0]), 1
            if k in ends:
                edges, way = ends[k]
                chain, own = self.chains[self.bundle[edges[0]]], self.row[edges]
                step = 1 if way else -1
                shares = chain.shares if way else 1 - chain.shares[::-1]
                kept = len(shares)
                names.append(chain.numbers[own][:, ::step])
                points.append(chain.points[own][:, ::step])
            u, v = [
                (shares, 0 * shares),
                (0 * shares + 1, shares),
                (1 - shares, 0 * shares + 1),
                (0 * shares, 1 - shares),
            ][k]
            sides.append((shares, np.column_stack([u, v]), np.arange(kept)))
        return Grid(tuple(sides)), names, points

    def _fine_enough(self, grid: Grid, places: Real, patch: Patch) -> tuple[Triangles, Real, float]:
        """Triangles and the places within of patches with ``places`` (n, k, 3) along their sides, and their error.

        Raises
        ------
        ParameterError
            There would be too many.
        """
        which = _templates(patch.poles)
        template = patch.rows(which)
        bends, key = Bends(template), _key(template.poles)
        sag = self.passed.get(key, self.tolerance)
        along, across = ((grid.sides[k][0][1:-1], 1 - grid.sides[k + 2][0][-2:0:-1]) for k in (0, 1))
        for _ in range(_FINER):
            t, rows = bends.rows(sag)
            _check_count(self.tolerance, self.count + 2 * len(places) * sum(len(row) for row in rows))
            # where rows of unlike lengths fold, all are as fine as the finest of them and of both sides, then as many
            # as the sides they run between have chords; where that is no better, fewer do
            levels = max((t, *across), key=len)
            near = [rows[k] for k in np.abs(levels[:, None] - t).argmin(axis=1)]
            even = t, [max((*rows, *along), key=len)] * len(t)
            for tried in ((t, rows), even, (levels, near), even):
                triangles, inner = rows_between(grid, *tried, rising=bends.rising)
                table = np.concatenate([grid.ring(), inner])
                at = np.concatenate([places[which], template.scattered(inner)[0]], axis=1)
                table, at, apart = _parted(grid, table, at, triangles)
                if not _folded(template, at, table, apart):
                    break
            off = _triangle_errors(template, at, table, apart)
            error = _MARGIN * float(off.max())
            if error <= self.tolerance and self.proof is None:
                # many places in the triangles that lie worst
                worst = apart[off >= _WORST * off.max()] if len(apart) > _WIDE else apart
                error = max(error, _CLOSE * _dense_error(template, at, table, worst))
            if error <= self.tolerance:
                self.passed[key] = sag
                break
            sag *= max(_SAFE * self.tolerance / error, _LEAST_SHARE)
        return triangles, inner, error


def _groups(keys: Triangles) -> list[Triangles]:
    """The rows of every key (n, k)."""
    _, which = np.unique(keys, axis=0, return_inverse=True)
    return [np.flatnonzero(which.ravel() == k) for k in range(int(which.max()) + 1)]


def _turns(own: Sequence[Chart], points: Real) -> tuple[Real, Real]:
    """By how much faces are the first of them turned, each about its axis, rad, and how far their points (n, k, 3)
    are then off, mm."""
    local = np.stack([(at - chart.origin) @ chart.axes.T for chart, at in zip(own, points, strict=True)])
    flat, high = local[..., 0] + 1j * local[..., 1], local[..., 2]
    turns = np.angle(np.sum(flat * np.conj(flat[0]), axis=1))
    off = np.abs(flat * np.exp(-1j * turns)[:, None] - flat[0]) + np.abs(high - high[0])
    return turns, off.max(axis=1)


def _ruled(grid: Grid, points: list[Real]) -> tuple[Triangles, Real]:
    """Triangles of patches that are straight between two copies of a curve, and the places (n, k, 3) within them."""
    counts = [len(shares) - 1 for shares, _, _ in grid.sides]
    triangles, inner = grid_between(grid, max(counts[0], counts[2]), max(counts[1], counts[3]))
    low, high = points[0], points[2][:, ::-1]
    s, t = inner.T
    at = np.interp(s, grid.sides[0][0], np.arange(low.shape[1])).round().astype(int)
    return triangles, low[:, at] * (1 - t)[:, None] + high[:, at] * t[:, None]


def _oriented(triangles: Triangles, flip: bool) -> Triangles:
    return triangles[:, ::-1] if flip else triangles


def _runs_across(poles: Real, ends: Real) -> bool:
    """Whether an edge with ends (2, 3) is a side of a patch along v."""
    off = np.linalg.norm(poles[[0, 0, -1, -1], [0, -1, 0, -1]][:, None] - ends, axis=2)
    along, across = (min(off[a, 0] + off[b, 1] for a, b in pairs) for pairs in _SIDES)
    return bool(across < along)


def _edges_of(faces: Faces, row: int) -> list[int]:
    return [edge for edges, _ in faces.loops for edge in edges[row].tolist()]


def _before(sides: Sequence[Side], k: int) -> int:
    """The run before a side at a pole."""
    run = sides[k - 1].run
    assert run is not None
    return run


def _chord(radius: float, sag: float) -> float:
    """The angle whose chord leaves a circle by a sagitta, rad."""
    return min(_WIDEST, 4 * math.asin(math.sqrt(min(max(sag, 0.0) / (2 * radius), 0.5)))) if radius > 0 else _WIDEST


def _tube(chart: Chart) -> float:
    return chart.surface.tube if isinstance(chart.surface, Torus) else getattr(chart.surface, "radius", 0.0)


def _shares(solid: Solid, edges: Edges, sag: float, *, even: bool) -> Real:
    """Where a bundle of edges is cut: the ends of chords that leave none of them by more than a sagitta."""
    curve = edges.curve
    if isinstance(curve, Circular):
        longest = float(arcs(solid, edges)[3].max())
        return np.linspace(0, 1, max(1, math.ceil(longest / _chord(curve.radius, sag) - 1e-9)) + 1)
    if not isinstance(curve, Spline):
        return np.array([0.0, 1.0])
    breaks = span_shares(curve.knots)
    at = bend_places(curve.knots) if not even else (breaks[:-1, None] + np.diff(breaks)[:, None] * _INNER).ravel()
    bends = np.einsum("kp,npc->nkc", spline_rows(curve.degree, curve.knots, at, 2)[2], solid.points[curve.poles])
    bent = np.linalg.norm(bends, axis=2).max(axis=0)
    if not even:
        return graded(at, bent, sag)
    most = bent.reshape(-1, len(_INNER)).max(axis=1)
    counts = np.maximum(1, np.ceil(np.diff(breaks) * np.sqrt(most / (8 * sag)))).astype(int)
    # chords may pass over knots at which the curve has no corner
    whole = max(1.0, math.ceil(math.sqrt(float(most.max()) / (8 * sag))))
    if whole < counts.sum() and np.unique(curve.knots, return_counts=True)[1][1:-1].max(initial=0) < curve.degree:
        breaks, counts = np.array([0.0, 1.0]), np.array([int(whole)])
    _check_count(sag, int(counts.sum()))
    pieces = [np.linspace(a, b, n, endpoint=False) for a, b, n in zip(breaks, breaks[1:], counts, strict=False)]
    return np.append(np.concatenate(pieces), 1.0)


def _check_count(tolerance: float, triangles: int) -> None:
    if triangles > _MOST_TRIANGLES:
        raise ParameterError("tolerance", tolerance, "too_many_edges", edges=triangles)


def _uv(side: Side) -> Real:
    return np.column_stack([side.u, side.v])


def _corners(sides: Sequence[Side]) -> list[int]:
    """The sides at whose starts the loop has a corner, in the unit square."""
    u, v = np.concatenate([s.u for s in sides]), np.concatenate([s.v for s in sides])
    scale = np.array([max(float(np.ptp(u)), 1e-300), max(float(np.ptp(v)), 1e-300)])
    found = []
    for k, side in enumerate(sides):
        last = sides[k - 1]
        one, two = (_uv(last)[-1] - _uv(last)[-2]) / scale, (_uv(side)[1] - _uv(side)[0]) / scale
        turn = math.atan2(one[0] * two[1] - one[1] * two[0], float(one @ two))
        if abs(turn) > _CORNER or last.run is None or side.run is None:
            found.append(k)
    return found


def _measured(uv: Real, names: Triangles, spread: Real, along: int) -> tuple[Real, Real, Triangles]:
    """A side with its shares by what it runs along, u (0) or v (1), or where it turns back by its length."""
    steps = np.abs(np.diff(uv[:, along]))
    if np.ptp(np.sign(np.diff(uv[:, along]))) != 0 or steps.sum() == 0:
        steps = np.linalg.norm(np.diff(uv, axis=0) / spread, axis=1)
    return np.concatenate([[0.0], np.cumsum(steps)]) / steps.sum(), uv, names


def _turned(table: Real, triangles: Triangles) -> Real:
    """Twice the signed areas of triangles in the plane of parameters."""
    a, b, c = table[triangles].transpose(1, 0, 2)
    return np.asarray((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])


def _folded(patch: Patch, points: Real, table: Real, triangles: Triangles) -> bool:
    """Whether triangles look the other way than their patches, or than the plane of parameters."""
    if np.any(_turned(table, triangles) <= 0):
        return True
    _, du, dv = patch.scattered(table[triangles].mean(axis=1))
    a, b, c = np.moveaxis(points[:, triangles], 2, 0)
    return bool(np.any(np.sum(np.cross(b - a, c - a) * np.cross(du, dv), axis=-1) <= 0))


def _sagitta(chart: Chart, u: Real, v: Real) -> float:
    """Proven bound of the distance of triangles with corners (n, 3) in u and v on a surface of revolution, mm.

    Seen along the circles about the axis a point of a triangle lies within the sagitta of its angle of the hull of
    its corners' meridian points; these lie on a line, or within the sagitta of the tube's arc.
    """
    if not len(u):
        return 0.0
    wide = np.nanmax(u, axis=1) - np.nanmin(u, axis=1)
    high = np.ptp(v, axis=1)
    bow = _tube(chart) * 2 * np.sin(np.minimum(high, math.pi) / 4) ** 2 if chart.is_bent else 0.0 * high
    size = np.abs(chart.meridian(v)[0]).max(axis=1) + bow
    away = bow + size * 2 * np.sin(np.minimum(wide, math.pi) / 4) ** 2
    if not isinstance(chart.surface, Cone):
        return float(away.max())
    return math.cos(chart.surface.slant) * float(np.minimum(away, _fanned(chart, u, v)).max())


def _fanned(chart: Chart, u: Real, v: Real) -> Real:
    """Bounds (n,) for triangles on a cone across its axis, mm: near the tip wide angles are short ways.

    The radius of a cone is linear in a triangle's shares: no point of it falls short of its circle by more than the
    corner that does most, seen along any one direction; those of the corners and between two of them are tried.
    """
    radius = np.abs(chart.meridian(v)[0])
    found = np.full(len(u), np.inf)
    for one, other in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)):
        off = np.minimum(np.abs(u - (u[:, [one]] + u[:, [other]]) / 2), math.pi)
        # a corner in the tip itself has no angle
        short = np.where(np.isnan(u), 0.0, radius * 2 * np.sin(off / 2) ** 2).max(axis=1)
        found = np.fmin(found, short)
    return found


def _closed(
    chart: Chart, loops: list[list[Side]], numbers: list[list[Triangles]]
) -> tuple[list[Complex], list[Triangles]]:
    """The loops as rings of points u + iv with their numbers; surfaces of revolution have seams (kernels make them)."""
    rings, names = [], []
    for bounds, own in zip(loops, numbers, strict=True):
        sides = [s if s.run is not None else _at_steps(s) for s in bounds]
        if round(float(sides[-1].u[-1] - sides[0].u[0]) / (2 * math.pi)):
            raise ThinWallError("a face goes round its axis without a seam")
        rings.append(np.concatenate([(s.u + 1j * s.v)[:-1] for s in sides]))
        names.append(np.concatenate([np.broadcast_to(n, s.u.shape)[:-1] for s, n in zip(sides, own, strict=True)]))
    if chart.is_plane:
        return rings, names
    # holes lie within the turn that is cut open
    middle = (float(rings[0].real.min()) + float(rings[0].real.max())) / 2
    rings[1:] = [r - 2 * math.pi * round((float(r.real.mean()) - middle) / (2 * math.pi)) for r in rings[1:]]
    return _spliced(rings, names)


def _at_steps(pole: Side) -> Side:
    """A side that is a point at many angles, each for the triangles near it."""
    u = np.linspace(pole.u[0], pole.u[-1], _ROUND_POLE)
    return Side(u, np.full(_ROUND_POLE, pole.v[0]), None)


def _spliced(rings: list[Complex], names: list[Triangles]) -> tuple[list[Complex], list[Triangles]]:
    """Rings with the holes that touch the first one in a vertex become a way round them within it."""
    ring, name = rings[0], names[0]
    apart: list[int] = []
    for k in range(1, len(rings)):
        same = np.argwhere(name[:, None] == names[k])
        if not len(same):
            apart.append(k)
            continue
        # a vertex of a seam stands on both sides of the face, a pole at many angles: where the hole lies already
        at, to = same[np.abs(ring[same[:, 0]] - rings[k][same[:, 1]]).argmin()].tolist()
        way = np.roll(rings[k], -to) + (ring[at] - rings[k][to])
        ring = np.concatenate([ring[:at], way, ring[at:]])
        name = np.concatenate([name[:at], np.roll(names[k], -to), name[at:]])
    return [ring, *(rings[k] for k in apart)], [name, *(names[k] for k in apart)]


def _templates(poles: Real) -> Triangles:
    """Of patches those that no other one is, turned: by the lengths in their nets."""
    first: dict[bytes, int] = {}
    for k, row in enumerate(_nets(poles)):
        first.setdefault(row.tobytes(), k)
    return np.array([*first.values()])


def _nets(poles: Real) -> Real:
    """The lengths in the nets of patches, a row each, equal where one is another one, turned."""
    steps = [np.diff(poles, axis=1), np.diff(poles, axis=2), poles[:, 1:, 1:] - poles[:, :-1, :-1]]
    lengths = np.concatenate([np.linalg.norm(s, axis=-1).reshape(len(poles), -1) for s in steps], axis=1)
    return np.round(lengths / (_ALIKE * max(float(np.abs(poles).max()), 1e-300)) / 100)


def _parted(grid: Grid, table: Real, points: Real, triangles: Triangles) -> tuple[Real, Real, Triangles]:
    """Places (k, 2), points (n, k, 3) and triangles, of which each that ends in a pole has a corner of its own there.

    It lies on the side that is a point, in the middle of its triangle.
    """
    poles = grid.collapsed()
    if not len(poles):
        return table, points, triangles
    row, corner = np.nonzero(np.isin(triangles, poles))
    own = table[triangles[row]]
    along = next(k for k, (_, _, names) in enumerate(grid.sides) if len(names) == 1) % 2
    places = own[np.arange(len(row)), corner]
    others = own.sum(axis=1) - places
    places[:, along] = others[:, along] / 2
    apart = triangles.copy()
    apart[row, corner] = len(table) + np.arange(len(row))
    return (
        np.concatenate([table, places]),
        np.concatenate([points, points[:, triangles[row, corner]]], axis=1),
        apart,
    )


def _key(poles: Real) -> bytes:
    """What nets that are one turned over have in common."""
    lengths = np.concatenate([np.linalg.norm(np.diff(poles, axis=axis), axis=-1).ravel() for axis in (1, 2)])
    return np.sort(np.round(lengths, 7)).tobytes()


def _triangle_errors(patch: Patch, points: Real, table: Real, triangles: Triangles) -> Real:
    """How far the middles of triangles (n,), and those of their edges, leave their patches at most, mm."""
    pairs = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]], axis=2)
    names, edges = np.unique(pairs[..., 0] * len(table) + pairs[..., 1], return_inverse=True)
    ends = np.stack([names // len(table), names % len(table)], axis=1)
    at, places = zip(*((points[:, x].mean(axis=2), table[x].mean(axis=1)) for x in (triangles, ends)), strict=True)
    off = _errors(patch, np.concatenate(at, axis=1), np.concatenate(places))
    return np.maximum(off[: len(triangles)], off[len(triangles) + edges.reshape(-1, 3)].max(axis=1))


def _dense_error(patch: Patch, points: Real, table: Real, triangles: Triangles) -> float:
    """How far many places in triangles leave their patches at most, mm."""
    at = np.einsum("sk,rnkc->rnsc", _DENSE, points[:, triangles]).reshape(len(points), -1, 3)
    return float(_errors(patch, at, np.einsum("sk,nkc->nsc", _DENSE, table[triangles]).reshape(-1, 2)).max())


def _errors(patch: Patch, points: Real, places: Real) -> Real:
    """Greatest distances (k,) of points (n, k, 3) from their patches, mm: one step of Newton's from shares (k, 2)."""
    block = max(1, _AT_ONCE // len(points))
    worst = np.zeros(len(places))
    for start in range(0, len(places), block):
        uv, at = places[start : start + block], points[:, start : start + block]
        place, du, dv = patch.scattered(uv)
        off = at - place
        away = np.linalg.norm(off, axis=2)
        a, b, c = np.sum(du * du, -1), np.sum(du * dv, -1), np.sum(dv * dv, -1)
        p, q = np.sum(off * du, -1), np.sum(off * dv, -1)
        det = np.maximum(a * c - b * b, 1e-300)
        steps = np.stack([(c * p - b * q) / det, (a * q - b * p) / det], axis=2)
        for row, step in enumerate(steps):
            place, du, dv = (x[0] for x in patch.rows(slice(row, row + 1)).scattered(uv + step))
            normal = np.cross(du, dv)
            normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
            # where a patch begins with no way along u the step leads astray
            across = np.abs(np.sum((at[row] - place) * normal, axis=1))
            worst[start : start + block] = np.maximum(worst[start : start + block], np.minimum(away[row], across))
    return worst
