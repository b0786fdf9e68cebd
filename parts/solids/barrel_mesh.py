"""Meshes of cylindrical cams: rings of points about the axis, and triangles between them; closed by construction."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from geometry.approximation.arcs import summed
from geometry.approximation.chords import approximate_profile
from geometry.base.errors import ConvergenceError
from geometry.base.record import Record
from geometry.cams.barrel.body import BarrelBody, BoreWall, Cylinder, Plane, Ring, Track
from geometry.cams.barrel.cam import BarrelCam
from geometry.cams.barrel.triangles import triangle_bound
from geometry.curves.bounds import Bound
from geometry.curves.curve import Complex, Real
from geometry.laws.piece import LawPiece
from geometry.plane.contour import Contour
from parts.solids.caps import cap_triangles

Triangles = NDArray[np.int64]

_SAMPLES, _RADII, _FLOOR = 129, 5, 1e-2
# what is added where a proof is too far from the samples, and what they leave to the proof
_MARGIN, _LEAST_MARGIN = 1.15, 1.02
# shares of the tolerance: along the groove, and across its walls
_ALONG, _ACROSS = 0.6, 0.15
_MOST_ROUNDS, _MOST_NODES = 12, 200_000
# barycentric places of the samples of each triangle
_PLACES = np.array(
    [[1, 1, 1], [3, 3, 0], [0, 3, 3], [3, 0, 3], [4, 1, 1], [1, 4, 1], [1, 1, 4], [5, 1, 0], [0, 5, 1], [1, 0, 5]],
    dtype=float,
)
SHARES = _PLACES / _PLACES.sum(axis=1, keepdims=True)


class BarrelMesh(Record):
    """Vertices (n, 3), mm, triangles (k, 3), and how far they leave the exact solid, like an Approximation."""

    vertices: NDArray[np.float64]
    geometry: Triangles
    max_error: float
    bound: Bound = "sampled"


class Grid(Record):
    """Nodes of the walls: cam angles and the pieces that they belong to, and radii across a wall, mm."""

    angles: Real
    pieces: tuple[LawPiece, ...]
    counts: tuple[int, ...]
    radii: Real


def barrel_mesh(body: BarrelBody, tolerance: float) -> BarrelMesh:
    """A closed mesh within ``tolerance`` mm of the exact solid.

    Raises
    ------
    ConvergenceError
        The tolerance asks for more nodes than a file can carry.
    """
    cam = body.cam
    along, across = _ALONG * tolerance, _ACROSS * tolerance
    for _ in range(_MOST_ROUNDS):
        grid = _grid(cam, along, across)
        walls = {side: cam_wall(cam, grid, side) for side in cam.sides}
        sampled, chord = max(_wall_error(cam, walls[s], grid.angles) for s in cam.sides), _chord_error(cam, walls)
        error = max(_LEAST_MARGIN * sampled, chord)
        if error <= tolerance:
            # samples say so: now the proof, where it is near enough
            proven = max(_wall_bound(cam, walls[side], grid.angles, tolerance) for side in cam.sides)
            certified = proven <= 2 * max(sampled, chord)
            error = max(proven if certified else _MARGIN * sampled, chord)
            if error <= tolerance:
                break
        factor = 0.95 * tolerance / error
        along, across = along * factor, across * factor
    else:
        raise ConvergenceError("mesh for the tolerance", error, _MOST_ROUNDS)
    made = _Assembler(body, walls, tolerance)
    vertices, triangles = made.mesh()
    return BarrelMesh(
        vertices, triangles, max(error, made.error), "certified" if certified and made.certified else "sampled"
    )


def cam_wall(cam: BarrelCam, grid: Grid, side: int) -> Real:
    """Points (radii, angles, 3) of a wall at the nodes of a grid."""
    found, at = [], 0
    for piece, count in zip(grid.pieces, grid.counts, strict=True):
        angles = grid.angles[at : at + count]
        found.append(cam.wall(angles[None, :], side, grid.radii[:, None], piece))
        at += count
    return np.concatenate(found, axis=1)


def _grid(cam: BarrelCam, along: float, across: float) -> Grid:
    """Nodes at which chords along the walls and across them leave them by about these errors, mm."""
    angles, counts = [], []
    radii = np.linspace(cam.inner, cam.outer, _RADII)
    bend = 0.0
    for piece in cam.motion.pieces:
        t = np.linspace(*piece.domain, _SAMPLES)
        sag = np.zeros(_SAMPLES)
        for side in cam.sides:
            points = cam.wall(t[None, :], side, radii[:, None], piece)
            normal = _normals(cam, t, side, radii, piece)
            second = np.gradient(np.gradient(points, t, axis=1, edge_order=2), t, axis=1, edge_order=2)
            sag = np.maximum(sag, np.abs((second * normal).sum(axis=-1)).max(axis=0))
            turn = np.gradient(np.angle(np.exp(1j * t) * (points[..., 0] + 1j * points[..., 1])), t, axis=1) - 1
            # on the cylinders the chords leave the circle
            sag = np.maximum(sag, (radii[:, None] * turn**2).max(axis=0))
            across_second = np.gradient(np.gradient(points, radii, axis=0), radii, axis=0)
            bend = max(bend, float(np.abs((across_second * normal).sum(axis=-1)).max()))
        # a floor, in chords: in a dwell all else is rounding
        rate = np.sqrt(sag / (8 * along)) + _FLOOR / (t[-1] - t[0])
        shares, whole = summed((rate[1:] + rate[:-1]) / 2 * np.diff(t))
        count = max(2, math.ceil(whole))
        if count > _MOST_NODES:
            raise ConvergenceError("mesh for the tolerance", along, count)
        angles.append(np.interp(np.linspace(0, 1, count, endpoint=False), shares, t))
        counts.append(count)
    levels = max(1, math.ceil((cam.outer - cam.inner) * math.sqrt(bend / (8 * across))))
    return Grid(np.concatenate(angles), cam.motion.pieces, tuple(counts), np.linspace(cam.inner, cam.outer, levels + 1))


def _normals(cam: BarrelCam, angles: Real, side: int, radii: Real, piece: LawPiece) -> Real:
    """Unit normals (radii, angles, 3) of a wall, towards the roller's axis."""
    place = cam.place(angles[None, :], 1, piece)
    rho = cam.distance_along(place, side, radii[:, None])
    n = cam.upright * (place[0] - cam.contact(place, side, rho)) / cam.radius_at(rho)
    turned = (cam.upright * cam.taper + 1j * n.real) * np.exp(-1j * angles)
    return np.stack([turned.real, turned.imag, n.imag], axis=-1)


def wall_triangles(shape: tuple[int, ...]) -> Triangles:
    """Triangles of a grid of (radii, angles) points whose last angle meets the first, facing up."""
    levels, count = shape[:2]
    here = np.arange(count)
    after = np.roll(here, -1)
    found = []
    for j in range(levels - 1):
        low, high = j * count, (j + 1) * count
        found.append(np.stack([low + here, high + after, high + here], axis=1))
        found.append(np.stack([low + here, low + after, high + after], axis=1))
    return np.concatenate(found)


def _wall_error(cam: BarrelCam, points: Real, angles: Real) -> float:
    """Greatest distance of the triangles' samples from the exact wall, mm."""
    index = wall_triangles(points.shape)
    samples = np.einsum("sk,nkc->nsc", SHARES, points.reshape(-1, 3)[index]).reshape(-1, 3)
    turn = np.exp(1j * np.tile(angles, points.shape[0]))[index]
    # the angles of a triangle lie close together: their mean direction, across the turn too
    near = np.angle(np.einsum("sk,nk->ns", SHARES, turn)).ravel()
    width = float(np.abs(np.angle(np.exp(1j * (np.roll(angles, -1) - angles)))).max())
    return float(np.abs(cam.distance(samples, near, width)).max())


def _wall_bound(cam: BarrelCam, points: Real, angles: Real, tolerance: float) -> float:
    """Proven bound of the distance of the triangles from the exact wall, mm."""
    index = wall_triangles(points.shape)
    near = np.tile(angles, points.shape[0])[index]
    # beside the start of the turn, angles go on below 0
    near = np.where(near - near.min(axis=1, keepdims=True) > math.pi, near - 2 * math.pi, near)
    width = float(np.ptp(near, axis=1).max())
    return triangle_bound(cam, points.reshape(-1, 3)[index], near, width, tolerance)


def _chord_error(cam: BarrelCam, walls: dict[int, Real]) -> float:
    """How far triangles between rings leave the cylinders: over the widest step of the polar angle.

    As ``zipped`` orders them, a triangle's third corner is at most half the widest step from the middle of its step.
    """
    worst = 0.0
    for row, radius in ((0, cam.inner), (-1, cam.outer)):
        wide = max(float(_steps(points[row, :, 0] + 1j * points[row, :, 1]).max()) for points in walls.values())
        worst = max(worst, 2 * radius * math.sin(wide / 4) ** 2)
    return worst


def _steps(ring: Complex) -> Real:
    return np.abs(np.angle(np.roll(ring, -1) / ring))


class _Assembler:
    """Puts the rings of a body in place once and collects the triangles between them."""

    def __init__(self, body: BarrelBody, walls: dict[int, Real], tolerance: float) -> None:
        self.body, self.walls, self.tolerance = body, walls, tolerance
        self.pieces: list[Real] = []
        self.triangles: list[Triangles] = []
        self.rings: dict[Ring | tuple[str, float], Triangles] = {}
        self.size, self.error, self.certified = 0, 0.0, True

    def mesh(self) -> tuple[Real, Triangles]:
        """Vertices and triangles, outside seen counter-clockwise."""
        cam = self.body.cam
        for face in self.body.faces():
            if isinstance(face, Track):
                self._track(face)
        for face in self.body.faces():
            if isinstance(face, Cylinder):
                self._cylinder(face, cam)
        self._bore()
        for face in self.body.faces():
            if isinstance(face, Plane):
                self._plane(face)
        return np.concatenate(self.pieces), np.concatenate(self.triangles)

    def _added(self, points: Real) -> Triangles:
        self.pieces.append(points)
        self.size += len(points)
        return np.arange(self.size - len(points), self.size)

    def _track(self, face: Track) -> None:
        """A wall; its rings run against the cam angle afterwards, counter-clockwise."""
        points = self.walls[face.side]
        index = self._added(points.reshape(-1, 3))
        rows = index.reshape(points.shape[:2])
        self.rings[face.inner], self.rings[face.outer] = rows[0][::-1], rows[-1][::-1]
        triangles = index[wall_triangles(points.shape)]
        # the lower wall looks up, the upper one down
        self.triangles.append(triangles[:, ::-1] if face.side > 0 else triangles)

    def _plane_points(self, index: Triangles) -> Complex:
        points = np.concatenate(self.pieces)[index]
        return np.asarray(points[:, 0] + 1j * points[:, 1])

    def _circle(self, ring: Ring, like: Triangles | None) -> Triangles:
        """The points of a circle, at the polar angles of another ring, or evenly spread."""
        if ring not in self.rings:
            if like is not None:
                unit = np.exp(1j * np.angle(self._plane_points(like)))
            else:
                step = 4 * math.asin(min(math.sqrt(self.tolerance / (2 * ring.radius)), 0.25))
                count = max(12, math.ceil(2 * math.pi / step))
                unit = np.exp(2j * math.pi * np.arange(count) / count)
                self.error = max(self.error, 2 * ring.radius * math.sin(math.pi / count / 2) ** 2)
            plane = ring.radius * unit
            self.rings[ring] = self._added(np.stack([plane.real, plane.imag, np.full(len(plane), ring.z)], axis=1))
        return self.rings[ring]

    def _cylinder(self, face: Cylinder, cam: BarrelCam) -> None:
        edges = [self.rings[r] for r in (face.lower, face.upper) if r in self.rings]
        like = edges[0] if edges else None
        lower, upper = self._circle(face.lower, like), self._circle(face.upper, like if edges else None)
        if not edges:
            upper = self._circle(face.upper, lower)
        found = zipped(lower, upper, self._plane_points(lower), self._plane_points(upper))
        self.triangles.append(found if face.outward else found[:, ::-1])

    def _bore(self) -> None:
        bores = [face for face in self.body.faces() if isinstance(face, BoreWall)]
        for face in bores:
            made = approximate_profile(face.profile, self.tolerance, arcs=False)
            self.error = max(self.error, made.max_error)
            self.certified = self.certified and made.bound != "sampled"
            plane, _ = made.geometry.expanded()
            rings = []
            for z in (face.low, face.high):
                rings.append(self._added(np.stack([plane.real, plane.imag, np.full(len(plane), z)], axis=1)))
                self.rings["bore", z] = rings[-1]
            here, after = rings[0], np.roll(rings[0], -1)
            up, up_after = rings[1], np.roll(rings[1], -1)
            # the profile runs clockwise, its material on the left
            self.triangles += [np.stack([here, after, up_after], axis=1), np.stack([here, up_after, up], axis=1)]

    def _plane(self, face: Plane) -> None:
        outer = self._circle(face.outer, None)
        holes = [self._circle(face.inner, None)] if face.inner else []
        holes += [self.rings["bore", face.outer.z]] if face.bore is not None else []
        contours = [Contour(p, np.zeros(len(p))) for p in map(self._plane_points, (outer, *holes))]
        found, middle = cap_triangles(contours[0], contours[1:])
        added = self._added(np.stack([middle.real, middle.imag, np.full(len(middle), face.outer.z)], axis=1))
        triangles = np.concatenate([outer, *holes, added])[found]
        self.triangles.append(triangles if face.up else triangles[:, ::-1])


def zipped(lower: Triangles, upper: Triangles, low: Complex, high: Complex) -> Triangles:
    """Triangles between two rings that run counter-clockwise about the axis, seen from outside counter-clockwise.

    Steps are taken in the order of the polar angles; rings at the same angles get quads cut in two.
    """
    start = int(np.argmin(np.abs(np.angle(high / low[0]))))
    upper, high = np.roll(upper, -start), np.roll(high, -start)
    n, m = len(lower), len(upper)
    base = float(np.angle(low[0]))
    first = base + np.concatenate([[0.0], np.cumsum(np.angle(np.roll(low, -1) / low))])
    second = (
        first[0]
        + float(np.angle(high[0] / low[0]))
        + np.concatenate([[0.0], np.cumsum(np.angle(np.roll(high, -1) / high))])
    )
    # the step whose middle comes first is taken first
    keys = np.concatenate([(first[1:] + first[:-1]) / 2, (second[1:] + second[:-1]) / 2])
    # rounded: the same angles are a tie on any machine
    order = np.argsort(np.round(keys, 11), kind="stable")
    is_low = order < n
    i = np.concatenate([[0], np.cumsum(is_low)])[:-1]
    j = np.concatenate([[0], np.cumsum(~is_low)])[:-1]
    here, there = lower[i % n], upper[j % m]
    third = np.where(is_low, lower[(i + 1) % n], upper[(j + 1) % m])
    return np.stack([here, third, there], axis=1)
