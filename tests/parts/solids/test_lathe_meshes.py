"""Meshes of faces round an axis, with flats, holes, poles; of copies and extrusions: closed, near, not too fine."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence

import numpy as np
import pytest

from geometry.base.errors import ThinWallError
from geometry.curves.curve import Real
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
    Solid,
    SolidBuilder,
    Sphere,
    Spline,
    SplineSurface,
    Straight,
    Surface,
    Torus,
)  # fmt: skip
from geometry.solids.rings import AHEAD, UP
from parts.solids.face_mesh import FaceMesh, face_mesh

Distance = Callable[[np.ndarray], np.ndarray]
SIDEWAYS = np.array([[0.0, -1.0, 0.0]])
DOWN, UPRIGHT = -UP, Straight(UP)


def one(edge: Index, forwards: bool) -> Loop:
    """A loop of a single edge."""
    return edge[:, None], np.array([forwards])


class Lathe(SolidBuilder):
    """Faces between whole circles about the z axis, each with a seam over +x."""

    def circle(self, r: float, z: float) -> tuple[Index, Index]:
        """Its edge and its vertex."""
        corner = self.add_vertices(self.add_points(np.array([r + 0j]), z))
        return self.add_edges(corner, corner, Circular(Frame(self.on_axis(z), UP, AHEAD), r)), corner

    def between(
        self, low: tuple[Index, Index], high: tuple[Index, Index], surface: Surface,
        meridian: Straight | Circular = UPRIGHT, *, out: bool = True,
    ) -> None:  # fmt: skip
        """A face round the axis, its normal away from it (or towards)."""
        seam = self.add_edges(low[1], high[1], meridian)
        edges, ways = [low[0], seam, high[0], seam], [True, True, False, False]
        if not out:
            edges, ways = edges[::-1], [not way for way in ways[::-1]]
        self.faces.append(Faces(surface, ((np.stack(edges, axis=1), np.array(ways)),), along=out))

    def flat(self, z: float, up: bool, outer: tuple[Index, Index], *holes: tuple[Index, Index]) -> None:
        frame = Frame(self.on_axis(z), UP, AHEAD)
        loops = (one(outer[0], up), *(one(hole[0], not up) for hole in holes))
        self.faces.append(Faces(Plane(frame), loops, along=up))

    def at(self, z: float, axis: Real = UP) -> Frame:
        return Frame(self.on_axis(z), axis, AHEAD)

    def upright(self, r: float, z: float) -> Frame:
        """Of a meridian's circle about a point over +x, its angle 0 ahead and a quarter up."""
        return Frame(self.add_points(np.array([r + 0j]), z), SIDEWAYS, AHEAD)


def tube(inner: float, outer: float, height: float) -> Solid:
    made = Lathe()
    low, top, low_in, top_in = (made.circle(r, z) for r in (outer, inner) for z in (0.0, height))
    made.between(low, top, Cylinder(made.at(0.0), outer))
    made.between(low_in, top_in, Cylinder(made.at(0.0), inner), out=False)
    made.flat(0.0, False, low, low_in)
    made.flat(height, True, top, top_in)
    return made.solid()


def closed_by_flats(
    surface: Callable[[Lathe], tuple[Surface, Straight | Circular]], low: tuple[float, float], high: tuple[float, float]
) -> Solid:
    """One bent face between two disks."""
    made = Lathe()
    below, above = made.circle(*low), made.circle(*high)
    made.between(below, above, *surface(made))
    made.flat(low[1], False, below)
    made.flat(high[1], True, above)
    return made.solid()


def leaning(low: tuple[float, float], high: tuple[float, float]) -> Straight:
    way = np.array([[high[0] - low[0], 0.0, high[1] - low[1]]])
    return Straight(way / np.linalg.norm(way))


def flattened_ball(radius: float, flats: Sequence[tuple[np.ndarray, float]], *, at_seam: bool = False) -> Solid:
    """A ball with a seam at y = 0 and flats across directions at distances; ``at_seam``: they touch it in a vertex."""
    made = SolidBuilder()
    middle, low, high, ahead = (
        made.add_points(np.array([x + 0j]), z) for x, z in ((0, 0.0), (0, -radius), (0, radius), (radius, 0.0))
    )
    south, north = made.add_vertices(low), made.add_vertices(high)
    frame = Frame(middle, SIDEWAYS, AHEAD)
    corner = made.add_vertices(ahead) if at_seam else None
    ends = [south, north] if corner is None else [south, corner, north]
    seam = [made.add_edges(a, b, Circular(frame, radius)) for a, b in itertools.pairwise(ends)]
    edges = np.stack([*seam, *seam[::-1]], axis=1)
    loops: list[Loop] = [(edges, np.array([True] * len(seam) + [False] * len(seam)))]
    for way, far in flats:
        centre = way * far
        side = np.cross(way, [0.0, 0.0, 1.0]) if corner is None else np.array([radius, 0.0, 0.0]) - centre
        side /= np.linalg.norm(side)
        own = math.sqrt(radius**2 - far**2)
        place = made.add_points(np.array([complex(centre[0], centre[1])]), centre[2])
        rim = centre + own * side
        start = (
            corner
            if corner is not None
            else made.add_vertices(made.add_points(np.array([complex(rim[0], rim[1])]), rim[2]))
        )
        across = Frame(place, way[None], side[None])
        circle = made.add_edges(start, start, Circular(across, own))
        loops.append(one(circle, False))
        made.faces.append(Faces(Plane(across), (one(circle, True),)))
    made.faces.append(Faces(Sphere(Frame(middle, UP, AHEAD), radius), tuple(loops)))
    return made.solid()


def rods(heights: Sequence[float], radius: float = 3.0) -> Solid:
    """Cylinders beside each other, each turned by 40 degrees more, all in the same bundles."""
    made, count = SolidBuilder(), len(heights)
    axes = 10.0 * np.arange(count) + 5j * np.arange(count)
    turn = np.exp(1j * np.radians(40.0) * np.arange(count))
    zero = np.stack([turn.real, turn.imag, np.zeros(count)], axis=1)
    ends = []
    for z in (np.zeros(count), np.array(heights)):
        centre = made.add_points(axes, z)
        corner = made.add_vertices(made.add_points(axes + radius * turn, z))
        frame = Frame(centre, UP, zero)
        ends.append((frame, made.add_edges(corner, corner, Circular(frame, radius)), corner))
    (low, below, first), (high, above, last) = ends
    seam = made.add_edges(first, last, Straight(UP))
    loop = np.stack([below, seam, above, seam], axis=1), np.array([True, True, False, False])
    made.faces.append(Faces(Cylinder(low, radius), (loop,)))
    made.faces.append(Faces(Plane(low), (one(below, False),), along=False))
    made.faces.append(Faces(Plane(high), (one(above, True),)))
    return made.solid()


# a lens of two cubic splines over a chord of 20
POLES = np.array([[-10, -6 - 8j, 6 - 8j, 10], [10, 5 + 9j, -5 + 6j, -10]], dtype=complex)
CLAMPED = np.array([0.0, 0, 0, 0, 1, 1, 1, 1])


def lens(height: float) -> Solid:
    """An extrusion of it."""
    made = SolidBuilder()
    ends, edges = [], []
    for z in (0.0, height):
        corner = made.add_points(POLES[:, 0], z)
        vertices = made.add_vertices(corner)
        inner = made.add_points(POLES[:, 1:3], z)
        poles = np.concatenate([corner[:, None], inner, np.roll(corner, -1)[:, None]], axis=1)
        ends.append(vertices)
        edges.append(made.add_edges(vertices, np.roll(vertices, -1), Spline(3, CLAMPED, poles)))
    up = made.add_edges(ends[0], ends[1], Straight(UP))
    loop = np.stack([edges[0], np.roll(up, -1), edges[1], up], axis=1), np.array([True, True, False, False])
    made.faces.append(Faces(Extrusion(edges[0], UP), (loop,)))
    for z, ring, is_up in ((0.0, edges[0][::-1], False), (height, edges[1], True)):
        made.faces.append(
            Faces(Plane(Frame(made.on_axis(z), UP, AHEAD)), ((ring[None], np.full(2, is_up)),), along=is_up)
        )
    return made.solid()


def pointed(height: float) -> Solid:
    """The same under a tip: ruled patches that end in a point there, an edge of theirs has no length."""
    made = SolidBuilder()
    corner = made.add_points(POLES[:, 0], 0.0)
    vertices = made.add_vertices(corner)
    poles = np.concatenate([corner[:, None], made.add_points(POLES[:, 1:3], 0.0), np.roll(corner, -1)[:, None]], axis=1)
    rim = made.add_edges(vertices, np.roll(vertices, -1), Spline(3, CLAMPED, poles))
    tip = made.add_points(np.array([1 + 2j]), height)
    top = made.add_vertices(tip)
    sides = Spline(1, np.array([0.0, 0, 1, 1]), np.stack([corner, np.repeat(tip, 2)], axis=1))
    up = made.add_edges(vertices, np.repeat(top, 2), sides)
    net = np.stack([poles, np.broadcast_to(tip, poles.shape)], axis=2)
    surface = SplineSurface((3, 1), CLAMPED, np.array([0.0, 0, 1, 1]), net)
    loop = np.stack([rim, np.roll(up, -1), up], axis=1), np.array([True, True, False])
    made.faces.append(Faces(surface, (loop,)))
    made.faces.append(
        Faces(Plane(Frame(made.on_axis(0.0), UP, AHEAD)), ((rim[::-1][None], np.full(2, False)),), along=False)
    )
    return made.solid()


def lens_area() -> float:
    """Green's theorem for Bezier arcs, exact by Gauss's rule."""
    t, weight = np.polynomial.legendre.leggauss(6)
    t = (t + 1) / 2
    basis = np.stack([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3])
    slope = np.stack([-3 * (1 - t) ** 2, 3 * (1 - t) ** 2 - 6 * t * (1 - t), 6 * t * (1 - t) - 3 * t**2, 3 * t**2])
    return float(sum((np.conj(p @ basis) * (p @ slope)).imag @ weight for p in POLES) / 4)


def cylinder(radius: float) -> Distance:
    return lambda p: np.abs(np.hypot(p[:, 0], p[:, 1]) - radius)


def cone(radius: float, slope: float) -> Distance:
    return lambda p: np.abs(np.hypot(p[:, 0], p[:, 1]) - radius - slope * p[:, 2]) / math.hypot(1, slope)


def level(z: float) -> Distance:
    return lambda p: np.abs(p[:, 2] - z)


def flat(way: np.ndarray, far: float) -> Distance:
    return lambda p: np.abs(p @ way - far)


def round_about(radius: float) -> Distance:
    return lambda p: np.abs(np.linalg.norm(p, axis=1) - radius)


TILTED = np.array([-0.6, -0.48, 0.64])
ACROSS = np.array([0.28, 0.96, 0.0])
# of the flat that touches the seam: as far from it as its circle is wide, half the angle about the ball's middle
TOUCHING = np.array([math.cos(0.5), math.sin(0.5), 0.0])
# solid, its volume, surfaces on which its boundary lies, genus
CASES: dict[str, tuple[Solid, float, tuple[Distance, ...], int]] = {
    "tube": (tube(6.0, 10.0, 8.0), math.pi * 64 * 8, (cylinder(6.0), cylinder(10.0), level(0.0), level(8.0)), 1),
    "zone": (
        closed_by_flats(lambda m: (Sphere(m.at(0.0), 10.0), Circular(m.upright(0.0, 0.0), 10.0)),
                        (math.sqrt(84), -4.0), (8.0, 6.0)),
        math.pi * (100 * 10 - (6**3 + 4**3) / 3), (round_about(10.0), level(-4.0), level(6.0)), 0,
    ),
    "narrowing": (
        closed_by_flats(lambda m: (Cone(m.at(8.0, DOWN), 5.0, math.atan(5 / 8)), leaning((10, 0), (5, 8))),
                        (10.0, 0.0), (5.0, 8.0)),
        math.pi * 8 / 3 * (100 + 50 + 25),
        (cone(10.0, -5 / 8), level(0.0), level(8.0)), 0,
    ),
    "widening": (
        closed_by_flats(lambda m: (Cone(m.at(0.0), 5.0, math.atan(5 / 8)), leaning((5, 0), (10, 8))),
                        (5.0, 0.0), (10.0, 8.0)),
        math.pi * 8 / 3 * (100 + 50 + 25),
        (cone(5.0, 5 / 8), level(0.0), level(8.0)), 0,
    ),
    # Pappus: a cylinder of 8 and a quarter disk about it
    "rounded": (
        closed_by_flats(lambda m: (Torus(m.at(0.0), 8.0, 3.0), Circular(m.upright(8.0, 0.0), 3.0)),
                        (11.0, 0.0), (8.0, 3.0)),
        math.pi * 64 * 3 + math.pi * 9 / 4 * 2 * math.pi * (8 + 4 * 3 / (3 * math.pi)),
        (lambda p: np.abs(np.hypot(np.hypot(p[:, 0], p[:, 1]) - 8, p[:, 2]) - 3), level(0.0), level(3.0)), 0,
    ),
    # less two caps of height 1 and 2 of a ball of 5: pi h^2 (3 r - h) / 3
    "flats": (
        flattened_ball(5.0, [(TILTED, 4.0), (ACROSS, 3.0)]), 4 / 3 * math.pi * 125 - math.pi * (14 + 4 * 13) / 3,
        (round_about(5.0), flat(TILTED, 4.0), flat(ACROSS, 3.0)), 0,
    ),
    "flat at the seam": (
        flattened_ball(5.0, [(TOUCHING, 5 * math.cos(0.5))], at_seam=True),
        4 / 3 * math.pi * 125 - math.pi * (5 * (1 - math.cos(0.5))) ** 2 * (15 - 5 * (1 - math.cos(0.5))) / 3,
        (round_about(5.0), flat(TOUCHING, 5 * math.cos(0.5))), 0,
    ),
    "lens": (lens(4.0), 4 * lens_area(), (), 0),
    "pointed": (pointed(9.0), 3 * lens_area(), (), 0),
}  # fmt: skip


def closed(made: FaceMesh) -> int:
    """Each side is run once either way; Euler's number."""
    triangles = made.geometry
    sides = {(a, b) for x in triangles.tolist() for a, b in ((x[0], x[1]), (x[1], x[2]), (x[2], x[0]))}
    assert len(sides) == 3 * len(triangles)
    assert sides == {(b, a) for a, b in sides}
    return len(np.unique(triangles)) - len(sides) // 2 + len(triangles)


def volume(made: FaceMesh) -> tuple[float, float]:
    a, b, c = made.vertices[made.geometry].transpose(1, 0, 2)
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6), float(
        np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    )


SHARES = np.array([(a, b, 6 - a - b) for a in range(7) for b in range(7 - a)]) / 6


@pytest.mark.sampled(9)
@pytest.mark.parametrize("tolerance", [0.4, 0.02])
@pytest.mark.parametrize("name", CASES)
def test_a_mesh_is_closed_as_large_and_as_near_as_it_says(name: str, tolerance: float) -> None:
    solid, exact, surfaces, genus = CASES[name]
    made = face_mesh(solid, tolerance)
    assert closed(made) == 2 - 2 * genus
    found, area = volume(made)
    assert found == pytest.approx(exact, abs=tolerance * area)
    assert made.max_error <= tolerance == made.tolerance
    if not surfaces:
        return
    assert np.min([distance(made.vertices) for distance in surfaces], axis=0).max() < 1e-9
    inner = np.einsum("sk,nkc->nsc", SHARES, made.vertices[made.geometry]).reshape(-1, 3)
    worst = float(np.min([distance(inner) for distance in surfaces], axis=0).max())
    assert worst <= made.max_error * (1 + 1e-9) + 1e-12
    assert made.bound == "certified"
    # nor is it much finer than was asked for
    assert worst > 0.25 * tolerance


@pytest.mark.parametrize("name", ["zone", "flats", "rounded", "narrowing"])
def test_a_bent_face_takes_triangles_by_its_bend(name: str) -> None:
    """A tenth of the tolerance takes ten times as many where it is bent both ways, the root of that one way."""
    coarse, fine = (len(face_mesh(CASES[name][0], t).geometry) for t in (0.2, 0.02))
    assert (2.2 if name == "narrowing" else 6) < fine / coarse < (4.5 if name == "narrowing" else 16)


@pytest.mark.parametrize("heights", [(5.0, 5.0, 5.0), (5.0, 9.0), (4.0, 7.0, 4.0)])
def test_copies_turned_and_those_that_are_none_are_meshed_where_they_stand(heights: tuple[float, ...]) -> None:
    made = face_mesh(rods(heights), 0.05)
    assert closed(made) == 2 * len(heights)
    found, area = volume(made)
    assert found == pytest.approx(math.pi * 9 * sum(heights), abs=0.05 * area)
    corners = made.vertices[made.geometry]
    for k, high in enumerate(heights):
        own = corners[np.abs(corners[:, :, 0].mean(axis=1) - 10.0 * k) < 4]
        off = np.hypot(own[..., 0] - 10.0 * k, own[..., 1] - 5.0 * k)
        assert own[..., 2].max() == pytest.approx(high)
        assert off.max() == pytest.approx(3.0, abs=1e-12)
        walls = own[(np.ptp(own[..., 2], axis=1) > 0)]
        assert np.abs(np.hypot(walls[..., 0] - 10.0 * k, walls[..., 1] - 5.0 * k) - 3.0).max() < 1e-12
    # alike ones have as many triangles each
    if len(set(heights)) == 1:
        assert len(corners) % len(heights) == 0
    assert made.max_error <= 0.05


@pytest.mark.parametrize("rim", [0.05, 0.002])
def test_a_wall_thinner_than_its_chords_gets_finer_ones(rim: float) -> None:
    """At half a millimetre of tolerance the chords of both circles would cross."""
    made = face_mesh(tube(10.0 - rim, 10.0, 3.0), 0.5)
    assert closed(made) == 0
    found, _ = volume(made)
    assert 0 < found == pytest.approx(math.pi * (100 - (10 - rim) ** 2) * 3, rel=0.6)
    assert made.max_error <= 0.5
    # no triangle of a plane face is turned over, as they were where chords crossed
    a, b, c = made.vertices[made.geometry].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    level_ = np.abs(normals[:, :2]).max(axis=1) == 0
    assert (np.sign(normals[level_, 2]) == np.where(a[level_, 2] == 3.0, 1, -1)).all()


def test_bounds_that_cross_at_any_tolerance_are_refused() -> None:
    made = Lathe()
    outer = made.circle(5.0, 0.0)
    corner = made.add_vertices(made.add_points(np.array([7 + 0j]), 0.0))
    hole = made.add_edges(corner, corner, Circular(Frame(made.add_points(np.array([4 + 0j]), 0.0), UP, AHEAD), 3.0))
    made.flat(0.0, True, outer, (hole, corner))
    with pytest.raises(ThinWallError, match="touch or cross"):
        face_mesh(made.solid(), 0.1)


def test_a_face_without_a_seam_round_its_axis_is_refused() -> None:
    """What reads files of others cuts such faces open."""
    made = Lathe()
    rim, _ = made.circle(5.0, 0.0)
    made.faces.append(Faces(Cylinder(made.at(0.0), 5.0), (one(rim, True),)))
    with pytest.raises(ThinWallError, match="without a seam"):
        face_mesh(made.solid(), 0.1)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("scale", [1e-2, 1e2])
@pytest.mark.parametrize("name", ["zone", "flats", "lens", "tube"])
def test_larger_and_smaller_solids_have_the_same_triangles(name: str, scale: float) -> None:
    """At a tolerance as much larger or smaller."""
    solid = CASES[name][0]
    plain = face_mesh(solid, 0.05)
    grown = face_mesh(scaled(solid, scale), 0.05 * scale)
    assert len(grown.geometry) == len(plain.geometry)
    assert grown.vertices == pytest.approx(plain.vertices * scale, abs=1e-9 * scale)
    assert grown.max_error == pytest.approx(plain.max_error * scale, rel=1e-6)


def scaled(solid: Solid, by: float) -> Solid:
    from geometry.base.record import replace

    edges = tuple(
        replace(e, curve=replace(e.curve, radius=by * e.curve.radius)) if isinstance(e.curve, Circular) else e
        for e in solid.edges
    )
    faces = []
    for face in solid.faces:
        own = face.surface
        sizes = {name: by * getattr(own, name) for name in ("radius", "tube") if hasattr(own, name)}
        faces.append(replace(face, surface=replace(own, **sizes)) if sizes else face)
    return Solid(by * solid.points, solid.vertices, edges, tuple(faces))
