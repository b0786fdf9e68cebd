"""Meshes and moments of solids of faces, against closed forms and against those of the bodies that made the faces."""

from __future__ import annotations

import math

import numpy as np
import pytest

from exporters.formats.readback import ReadMesh
from exporters.verification.faces import mesh_deviation
from exporters.verification.topology import doubled_normals, topology_failures
from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.solids.area import surface_area
from geometry.solids.extent import extent
from geometry.solids.face_moments import face_moments
from geometry.solids.faces import (
    Circular,
    Faces,
    Frame,
    Index,
    Plane,
    Solid,
    SolidBuilder,
    Sphere,
    Spline,
    SplineSurface,
    Torus,
)  # fmt: skip
from geometry.solids.mass import body_moments
from geometry.solids.rings import AHEAD, UP
from parts.scene.load import load_scene, make_parts, scene_from_dict
from parts.solids.face_mesh import face_mesh, faced_mesh
from parts.solids.faces import solid_curves, solid_faces

# across a circle that stands upright, its angle 0 ahead and a quarter up
_SIDEWAYS = np.array([[0.0, -1.0, 0.0]])


def ball(radius: float, at: complex = 0j, made: SolidBuilder | None = None) -> Solid:
    """A ball with one meridian as its seam, beside what is ``made`` already."""
    made = made or SolidBuilder()
    middle, low, high = (made.add_points(np.array([at]), z) for z in (0.0, -radius, radius))
    south, north = made.add_vertices(low), made.add_vertices(high)
    seam = made.add_edges(south, north, Circular(Frame(middle, _SIDEWAYS, AHEAD), radius))
    loop = np.stack([seam, seam], axis=1), np.array([True, False])
    made.faces.append(Faces(Sphere(Frame(middle, UP, AHEAD), radius), (loop,)))
    return made.solid()


def ring(radius: float, tube: float) -> Solid:
    """A torus with two circles as its seams."""
    made = SolidBuilder()
    middle, outside, within = (made.add_points(np.array([x + 0j]), 0.0) for x in (0.0, radius + tube, radius))
    corner = made.add_vertices(outside)
    around = made.add_edges(corner, corner, Circular(Frame(middle, UP, AHEAD), radius + tube))
    across = made.add_edges(corner, corner, Circular(Frame(within, _SIDEWAYS, AHEAD), tube))
    loop = np.stack([around, across, around, across], axis=1), np.array([True, True, False, False])
    made.faces.append(Faces(Torus(Frame(middle, UP, AHEAD), radius, tube), (loop,)))
    return made.solid()


def twisted_prism(size: float, height: float, turn: float, made: SolidBuilder | None = None) -> Solid:
    """A square under one that is turned, with bilinear faces between them, whose sides are splines of degree 1."""
    made, knots = made or SolidBuilder(), np.array([0.0, 0.0, 1.0, 1.0])
    square = size * np.exp(0.5j * np.pi * np.arange(4))
    points = np.stack([made.add_points(square, 0.0), made.add_points(square * np.exp(1j * turn), height)])
    low, high = (made.add_vertices(own) for own in points)

    def sides(start: Index, end: Index, poles: tuple[Index, Index]) -> Index:
        return made.add_edges(start, end, Spline(1, knots, np.stack(poles, axis=1)))

    below, above = (sides(v, np.roll(v, -1), (p, np.roll(p, -1))) for v, p in zip((low, high), points, strict=True))
    up = sides(low, high, (points[0], points[1]))
    poles = np.stack([points.T, np.roll(points.T, -1, axis=0)], axis=1)
    loop = np.stack([below, np.roll(up, -1), above, up], axis=1), np.array([True, True, False, False])
    made.faces.append(Faces(SplineSurface((1, 1), knots, knots, poles), (loop,)))
    for z, ring, is_up in ((0.0, below[::-1], False), (height, above, True)):
        frame = Frame(made.on_axis(z), UP, AHEAD)
        made.faces.append(Faces(Plane(frame), ((ring[None], np.full(4, is_up)),), along=is_up))
    return made.solid()


def test_a_twisted_face_is_cut_as_its_twist_asks() -> None:
    """A face with u v t across takes t / (2 tolerance) triangles; broad ones at uncut edges took 40 times as many."""
    size, height, turn, tolerance = 10.0, 15.0, 0.5, 0.01
    solid = twisted_prism(size, height, turn)
    made = face_mesh(solid, tolerance)
    mesh = ReadMesh(made.vertices, made.geometry)
    assert topology_failures(mesh) == []
    # Gauss: the twist of the net, along the normal in its middle, is the most of it
    net = solid.points[solid.faces[0].surface.poles[0]]
    u, v = net[1].mean(axis=0) - net[0].mean(axis=0), net[:, 1].mean(axis=0) - net[:, 0].mean(axis=0)
    normal = np.cross(u, v) / np.linalg.norm(np.cross(u, v))
    twist = abs(float((net[0, 0] - net[0, 1] - net[1, 0] + net[1, 1]) @ normal))
    assert len(made.geometry) < 4 * 4 * twist / (2 * tolerance)
    # sections are squares turned and smaller: their areas are a square's polynomial in the height
    corner = size * (np.array([0.0, 0.5, 1.0]) * (np.exp(1j * turn) - 1) + 1)
    volume = height * float(2 * np.abs(corner) ** 2 @ [1, 4, 1]) / 6
    corners = mesh.faces()
    found = float(np.einsum("ij,ij->i", corners[:, 0], doubled_normals(corners)).sum() / 6)
    assert found == pytest.approx(volume, abs=tolerance * surface_area(solid))


def held(solid: Solid, tolerance: float) -> float:
    """The volume of a closed mesh within a tolerance."""
    made = face_mesh(solid, tolerance)
    mesh = ReadMesh(made.vertices, made.geometry)
    assert topology_failures(mesh) == []
    assert made.max_error <= tolerance
    corners = mesh.faces()
    return float(np.einsum("ij,ij->i", corners[:, 0], doubled_normals(corners)).sum() / 6)


def test_a_mesh_is_no_better_proven_than_its_least_face() -> None:
    """A ball's distance is proven, a twisted face's is sampled: both together are sampled, whichever comes first."""
    assert face_mesh(ball(3.0), 0.05).bound == "certified"
    assert face_mesh(twisted_prism(4.0, 5.0, 0.4), 0.05).bound == "sampled"
    first, second = SolidBuilder(), SolidBuilder()
    ball(3.0, 20.0 + 0j, first)
    twisted_prism(4.0, 5.0, 0.4, second)
    for solid in (twisted_prism(4.0, 5.0, 0.4, first), ball(3.0, 20.0 + 0j, second)):
        made = face_mesh(solid, 0.05)
        assert made.bound == "sampled"
        assert 0 < made.max_error <= 0.05


def test_a_ball_and_a_ring_by_closed_forms() -> None:
    r, big, tube = 5.0, 10.0, 3.0
    found = face_moments(ball(r, 7 + 2j))
    volume = 4 / 3 * math.pi * r**3
    assert found.volume == pytest.approx(volume, rel=1e-12)
    assert surface_area(ball(r, 7 + 2j)) == pytest.approx(4 * math.pi * r**2, rel=1e-12)
    assert found.centre == pytest.approx([7, 2, 0], abs=1e-11)
    assert found.inertia[2, 2] == pytest.approx(volume * (0.4 * r**2 + 53), rel=1e-12)
    found = face_moments(ring(big, tube))
    volume = 2 * math.pi**2 * big * tube**2
    assert found.volume == pytest.approx(volume, rel=1e-12)
    assert surface_area(ring(big, tube)) == pytest.approx(4 * math.pi**2 * big * tube, rel=1e-12)
    assert found.inertia[2, 2] == pytest.approx(volume * (big**2 + 0.75 * tube**2), rel=1e-12)
    for solid, exact, distance in (
        (ball(r), 4 / 3 * math.pi * r**3, lambda p: np.linalg.norm(p, axis=1) - r),
        (ring(big, tube), volume, lambda p: np.hypot(np.hypot(p[:, 0], p[:, 1]) - big, p[:, 2]) - tube),
    ):
        for tolerance in (0.3, 0.01):
            assert held(solid, tolerance) == pytest.approx(exact, abs=surface_area(solid) * tolerance)
            made = face_mesh(solid, tolerance)
            middles = made.vertices[made.geometry].mean(axis=1)
            # outside the corners stand on it, inside the triangles lie within the declared error
            assert np.abs(distance(made.vertices)).max() < 1e-12
            worst = float(np.abs(distance(middles)).max())
            assert 0.1 * made.max_error < worst <= made.max_error


def test_a_cone_that_nearly_ends_in_its_tip_takes_few_triangles() -> None:
    shaft = {"diameter": 12.0, "length": 10.0, "chamfer": 5.97}
    worm = {"kind": "worm", "module": 2.0, "thread_length": 12.0}
    counts = []
    for chamfer in (1.0, 5.97):
        keys = {**worm, "shaft_below": [{**shaft, "chamfer": chamfer}]}
        body = make_parts(scene_from_dict({"parts": {"worm": keys}}, "s", "s"), "s")[0]["worm"].body(0.0)
        made = faced_mesh(body, 0.1)
        assert topology_failures(ReadMesh(made.vertices, made.geometry)) == []
        counts.append(len(made.geometry))
    # no more than the circle that it has less of
    assert counts[1] <= counts[0]


def test_a_worm_wheel_has_triangles_where_it_is_bent() -> None:
    # 75 716 before, as close all over as at the ends of its undercut
    wheel = {"kind": "worm_wheel", "module": 2.0, "number_of_teeth": 30}
    body = make_parts(scene_from_dict({"parts": {"wheel": wheel}}, "s", "s"), "s")[0]["wheel"].body(0.0)
    made = faced_mesh(body, 0.05)
    assert len(made.geometry) < 16_000
    mesh = ReadMesh(made.vertices, made.geometry)
    assert topology_failures(mesh) == []
    deviation, lone = mesh_deviation(mesh, body)
    assert 0.4 * made.max_error < deviation <= made.max_error <= 0.05
    assert lone == 0


def test_a_tolerance_that_few_chords_hardly_miss_is_met() -> None:
    """Ever less of the sagitta asked for as few chords ten times, of which the same ones were off by 2 %."""
    gear = {"kind": "face_gear", "module": 2.0, "number_of_teeth": 22, "pinion_number_of_teeth": 13}
    keys = {**gear, "pinion_profile_shift_coefficient": -0.3}
    body = make_parts(scene_from_dict({"parts": {"gear": keys}}, "s", "s"), "s")[0]["gear"].body(0.0)
    made = faced_mesh(body, 0.06)
    assert mesh_deviation(ReadMesh(made.vertices, made.geometry), body)[0] <= made.max_error <= 0.06


def test_fillets_beside_a_bowed_edge_are_not_folded() -> None:
    """The joint of flank and fillet bows as far as its fillet is wide: chords of coarse rows lay beyond it."""
    gear = {"kind": "face_gear", "module": 2.0, "number_of_teeth": 60, "pinion_number_of_teeth": 40}
    keys = {**gear, "pressure_angle_deg": 14.5}
    body = make_parts(scene_from_dict({"parts": {"gear": keys}}, "s", "s"), "s")[0]["gear"].body(0.0)
    made = faced_mesh(body, 0.02)
    mesh = ReadMesh(made.vertices, made.geometry)
    assert topology_failures(mesh) == []
    # edges of each triangle as they run, and the same against it: its neighbours' normals
    normals = doubled_normals(mesh.faces())
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    ways = made.geometry[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    forth, back = (np.lexsort(side.T) for side in (ways, ways[:, ::-1]))
    # no edge of the part is sharper than one of its ends'
    assert np.sum(normals[forth // 3] * normals[back // 3], axis=1).min() > -0.2
    assert mesh_deviation(mesh, body)[0] <= made.max_error


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("scene", "part"), [("bevel_pair", "pinion"), ("worm_set_print", "wheel")])
def test_no_triangle_is_chosen_by_last_bits(scene: str, part: str) -> None:
    """Another machine rounds coordinates otherwise: the triangles are the same, the volume too."""
    parts, _ = make_parts(load_scene(scene), scene)
    body = parts[part].body(0.0)
    solid = body.within(0.02).geometry
    made = face_mesh(solid, 0.2, body.proof)
    assert topology_failures(ReadMesh(made.vertices, made.geometry)) == []
    draw = np.random.default_rng(37)
    for _ in range(2):
        bits = draw.integers(-2, 3, solid.points.shape) * np.finfo(float).eps
        other = face_mesh(replace(solid, points=solid.points * (1 + bits)), 0.2, body.proof)
        assert np.array_equal(other.geometry, made.geometry)
        assert other.vertices == pytest.approx(made.vertices, abs=1e-9)


def test_a_solid_reaches_as_far_as_closed_forms_say() -> None:
    """A ball off the axis, a ring, and a ring that leans: its highest place lies inside its face."""
    found = extent(ball(5.0, 7 + 2j))
    assert found.low == pytest.approx([2, -3, -5], abs=1e-9)
    assert found.high == pytest.approx([12, 7, 5], abs=1e-9)
    assert found.radius == pytest.approx(math.hypot(7, 2) + 5, abs=1e-9)
    found = extent(ring(10.0, 3.0))
    assert [*found.low, *found.high, found.radius] == pytest.approx([-13, -13, -3, 13, 13, 3, 13], abs=1e-9)
    lean = 0.7
    turn = np.array([[1, 0, 0], [0, math.cos(lean), -math.sin(lean)], [0, math.sin(lean), math.cos(lean)]])
    whole = ring(10.0, 3.0)
    (around, across), (face,) = whole.edges, whole.faces
    tilted = Solid(
        whole.points @ turn.T,
        whole.vertices,
        tuple(replace(e, curve=replace(e.curve, frame=_turned(e.curve.frame, turn))) for e in (around, across)),
        (replace(face, surface=replace(face.surface, frame=_turned(face.surface.frame, turn))),),
    )
    assert extent(tilted).high == pytest.approx([13, 10 * math.cos(lean) + 3, 10 * math.sin(lean) + 3], abs=1e-9)


def _turned(frame: Frame, turn: np.ndarray) -> Frame:
    return Frame(frame.origin, frame.axis @ turn.T, frame.zero @ turn.T)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("scene", ["helical_pair", "cycloidal_reducer", "barrel_cam"])
def test_solids_of_scenes_are_closed_and_as_large_as_their_bodies(scene: str) -> None:
    """The faces that STEP is written of, meshed and integrated, beside the bodies they were made of."""
    parts, _ = make_parts(load_scene(scene), scene)
    for part in parts.values():
        body = part.body(0.0)
        curves = solid_curves(body, 1e-6)
        solid = solid_faces(body, curves)
        exact = body.moments if body.is_faced else body_moments(body)
        found = face_moments(solid)
        assert found.volume == pytest.approx(exact.volume, rel=1e-8)
        assert found.inertia == pytest.approx(exact.inertia, rel=1e-7, abs=1e-7 * np.abs(exact.inertia).max())
        assert held(solid, 0.05) == pytest.approx(exact.volume, abs=0.05 * surface_area(solid))


def test_no_more_triangles_are_counted_than_are_made(monkeypatch: pytest.MonkeyPatch) -> None:
    """Too many would refuse a worm that has room; of too few the refusal would come late."""
    keys = {"kind": "worm", "module": 2.0, "thread_length": 6.0}
    body = make_parts(scene_from_dict({"parts": {"worm": keys}}, "s", "s"), "s")[0]["worm"].body(0.0)
    told: list[int] = []
    monkeypatch.setattr("parts.solids.face_mesh._FINE", 1.0)
    monkeypatch.setattr("parts.solids.face_mesh._check_count", lambda _, count: told.append(count))
    made = len(faced_mesh(body, 0.01).geometry)
    assert made / 5 < told[0] <= made


def test_too_many_triangles_are_counted_before_any_is_made(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a worm far too fine most were made first: it was refused after 16 s."""
    keys = {"kind": "worm", "module": 2.0, "thread_length": 40.0}
    body = make_parts(scene_from_dict({"parts": {"worm": keys}}, "s", "s"), "s")[0]["worm"].body(0.0)
    made: list[object] = []
    monkeypatch.setattr("parts.solids.face_mesh.rows_between", lambda *told, **_: made.append(told))
    with pytest.raises(ParameterError) as caught:
        faced_mesh(body, 4e-5)
    assert (caught.value.code, made) == ("too_many_edges", [])
