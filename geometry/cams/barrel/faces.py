"""The faces of a cylindrical cam: walls as spline surfaces, cylinders between their rims, plane ends, a bore.

Walls are one face for each stretch of the motion. Cylinders are cut upright where the roller stands still, for there
the rims of all walls stand above each other.
"""

from __future__ import annotations

from functools import lru_cache, partial

import numpy as np

from geometry.approximation.outline import Outline
from geometry.cams.barrel.body import BarrelBody, BoreWall, Cylinder, Plane, Ring, Track, barrel_moments
from geometry.cams.barrel.cam import LOWER, UPPER
from geometry.cams.barrel.rolling import wall_height
from geometry.cams.barrel.splines import BarrelSplines, barrel_splines
from geometry.cams.motion.follower_motion import TURN
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import Arc
from geometry.solids import faces as kinds
from geometry.solids.faced import FacedBody, FacedSolid
from geometry.solids.faces import Circular, Index, Loop, Solid, Spline, Straight, Use, turned_over
from geometry.solids.measured import Measured
from geometry.solids.rings import UP, RingBuilder
from geometry.solids.rings import Ring as Edging
from geometry.solids.splines import involute_walls

# with fewer poles the edges leave the walls by more than solids allow; what a STEP file asks for serves all else too
_FINEST = 0.95e-6
# one face of a cylinder goes round by no more than this, rad, where the roller's rests allow it
_MOST_TURN = 3.5


def barrel_faces(body: BarrelBody) -> FacedBody:
    """A cylindrical cam as a body told by its faces; its meshes are proven by how high their triangles stand."""
    cam = body.cam

    @lru_cache(maxsize=4)
    def within(tolerance: float) -> FacedSolid:
        made = barrel_splines(cam, tolerance, body.bore)
        return FacedSolid(barrel_solid(body, made), made.max_error, made.bound)

    def proof(walls: list[Real], slack: float) -> float:
        sides: dict[int, list[Real]] = {side: [] for side in cam.sides}
        for corners in walls:
            a, b = np.moveaxis(corners[:, 1:] - corners[:, :1], 1, 0)
            # the lower wall looks up
            sides[UPPER if np.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) < 0 else LOWER].append(corners)
        return wall_height(cam, {side: np.concatenate(own) for side, own in sides.items() if own}, slack).bound

    own = () if body.bore is None else involute_walls(body.bore)
    tracks = [face for face in body.faces() if isinstance(face, Track)]
    return FacedBody(
        lambda tolerance: within(min(tolerance, _FINEST)),
        (*(Measured("wall", partial(face.distance, cam)) for face in tracks), *own),
        lambda: barrel_moments(body),
        proof,
    )


def barrel_solid(body: BarrelBody, splines: BarrelSplines) -> Solid:
    """The faces of a cylindrical cam from the splines of its walls and its bore."""
    made = _Maker(body, splines)
    for face in body.faces():
        if isinstance(face, Track):
            made.track(face)
    for face in body.faces():
        if isinstance(face, Cylinder):
            made.cylinder(face)
        elif isinstance(face, BoreWall) and splines.bore is not None:
            made.bore = made.upright(splines.bore, face.low, face.high)
    for face in body.faces():
        if isinstance(face, Plane):
            made.end(face)
    return made.solid()


class _Maker(RingBuilder):
    """Vertices, edges and faces of one cam."""

    def __init__(self, body: BarrelBody, splines: BarrelSplines) -> None:
        super().__init__()
        self.cam, self.splines = body.cam, splines.walls
        walls = next(iter(self.splines.values()))
        self.cuts = _cuts([w.stretch.start + TURN * w.stretch.turns for w in walls], [w.stretch.rests for w in walls])
        # by side, inner (0) or outer (1) cylinder and stretch: vertices, points and edges of the rims
        self.corners: dict[tuple[int, int], Index] = {}
        self.rims: dict[tuple[int, int], list[Index]] = {}
        # of a circle between the cuts: its vertices and edges; whole circles of hubs; both ends of the bore
        self.arcs: dict[Ring, tuple[Index, Index]] = {}
        self.circles: dict[Ring, Edging] = {}
        self.bore: tuple[Edging, Edging] | None = None

    def track(self, face: Track) -> None:
        """The faces of a wall, one for each stretch."""
        walls = self.splines[face.side]
        # a wall ends where the next one begins
        rows = [self.add_points(w.poles[:-1, :, 0] + 1j * w.poles[:-1, :, 1], w.poles[:-1, :, 2]) for w in walls]
        grids = [np.concatenate([a, b[:1]]) for a, b in zip(rows, [*rows[1:], rows[0]], strict=True)]
        starts = np.array([[grid[0, 0], grid[0, -1]] for grid in grids]).T
        corners = [self.add_vertices(points) for points in starts]
        across = [
            self.add_edges(corners[0][k : k + 1], corners[1][k : k + 1], Spline(w.degree, w.across, grids[k][:1]))
            for k, w in enumerate(walls)
        ]
        for row in (0, 1):
            self.corners[face.side, row] = corners[row]
            self.rims[face.side, row] = []
        for k, (wall, grid) in enumerate(zip(walls, grids, strict=True)):
            after = (k + 1) % len(walls)
            for row in (0, 1):
                ends = corners[row][k : k + 1], corners[row][after : after + 1]
                shape = Spline(wall.degree, wall.along, grid[None, :, -row])
                self.rims[face.side, row].append(self.add_edges(*ends, shape))
            inner, outer = (self.rims[face.side, row][k] for row in (0, 1))
            around = [(inner, True), (across[after], True), (outer, False), (across[k], False)]
            surface = kinds.SplineSurface((wall.degree, wall.degree), wall.along, wall.across, grid[None])
            self._face(surface, around, along=not (self.cam.is_groove and face.side == UPPER))

    def cylinder(self, face: Cylinder) -> None:
        """The faces of a cylinder: whole between two circles, else one between each two cuts."""
        lower, upper = face.lower, face.upper
        if not (lower.side or upper.side):
            whole = Outline((Arc(0j, lower.radius, 0.0, TURN),), 1, 0.0, "exact")
            self.circles[lower], self.circles[upper] = self.upright(whole, lower.z, upper.z)
            return
        row = 0 if lower.radius == self.cam.inner else 1
        pipe = self.pipe(lower.radius)
        below, above = self._starts(lower, row), self._starts(upper, row)
        seams = self.add_edges(below, above, Straight(UP))
        for i, (first, last) in enumerate(self.cuts):
            after = (i + 1) % len(self.cuts)
            # anticlockwise from the later cut to the earlier one
            around = [*self._along(lower, row, i, first, last), (seams[i : i + 1], True)]
            around += turned_over(self._along(upper, row, i, first, last))
            around.append((seams[after : after + 1], False))
            self._face(pipe, around, along=face.outward)

    def upright(self, outline: Outline, low: float, high: float) -> tuple[Edging, Edging]:
        """An upright wall; its rings."""
        ends = self.ring(outline, low), self.ring(outline, high)
        self.swept(*ends, UP)
        return ends

    def end(self, face: Plane) -> None:
        """A plane end within its circle, without its hole."""
        loops = [self._circle(face.outer, left=face.up)]
        if face.inner is not None:
            loops.append(self._circle(face.inner, left=not face.up))
        if face.bore is not None:
            assert self.bore is not None
            # the bore runs clockwise
            loops.append(self.bore[1 if face.up else 0].loop(forwards=face.up))
        self.cap(face.outer.z, loops, up=face.up)

    def _face(self, surface: kinds.Surface, around: list[Use], *, along: bool) -> None:
        """A face within edges that turn left about its surface's normal; ``along``: that points outwards."""
        self.bounded(surface, around if along else turned_over(around), along=along)

    def _starts(self, ring: Ring, row: int) -> Index:
        """The vertices of a ring at the cuts."""
        first = [first for first, _ in self.cuts]
        if ring.side:
            return self.corners[ring.side, row][first]
        if ring not in self.arcs:
            above = self.corners[next(iter(self.splines)), row][first]
            places = self.place(above)
            way: Complex = np.exp(1j * np.arctan2(places[:, 1], places[:, 0]))
            vertices = self.add_vertices(self.add_points(ring.radius * way, ring.z))
            # the cam angle grows clockwise
            edges = self.add_edges(np.roll(vertices, -1), vertices, Circular(self.frame_at(ring.z), ring.radius))
            self.arcs[ring] = vertices, edges
        return self.arcs[ring][0]

    def _along(self, ring: Ring, row: int, i: int, first: int, last: int) -> list[Use]:
        """The edges of a ring from the cut after part i to that before it, anticlockwise."""
        if ring.side:
            return [(edge, False) for edge in reversed(self.rims[ring.side, row][first:last])]
        return [(self.arcs[ring][1][i : i + 1], True)]

    def _circle(self, ring: Ring, *, left: bool) -> Loop:
        """A circle as the loop of one face: of a hub, or the arcs between the cuts of a cylinder with a wall."""
        if ring in self.circles:
            return self.circles[ring].loop(forwards=left)
        edges = self.arcs[ring][1]
        return (edges[::-1] if left else edges)[None], np.full(len(edges), left)


def _cuts(starts: list[float], rests: list[bool]) -> list[tuple[int, int]]:
    """Runs of stretches (first, beyond the last) between cuts of the cylinders, all at rests of the roller."""
    ends = [*starts[1:], starts[0] + TURN]
    joints = [k for k, at_rest in enumerate(rests) if at_rest]
    kept = [0]
    for k, following in zip(joints[1:], [*joints[2:], len(starts)], strict=True):
        if ends[following - 1] - starts[kept[-1]] > _MOST_TURN:
            kept.append(k)
    return list(zip(kept, [*kept[1:], len(starts)], strict=True))
