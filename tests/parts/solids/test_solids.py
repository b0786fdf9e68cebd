"""Meshes of extruded gears, judged by trimesh: closed, turned one way, of the right volume and kind."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from exporters.formats.registry import shape_of
from exporters.production.plan import plan_build
from geometry.base.errors import GeometryError, ParameterError
from geometry.plane.contour import Approximation, Contour
from geometry.plane.profile import Label, Region, circle
from geometry.solids.body import plate
from parts.base.refusal import SceneError
from parts.scene.load import scene_from_dict
from parts.solids.mesh import Mesh, body_mesh
from tests.sampling import examples

WIDTH = 4.0
GEARS: dict[str, dict[str, Any]] = {
    "z 3": {"number_of_teeth": 3, "profile_shift_coefficient": 0.5, "tip_diameter": 10.5},
    "z 3 steep": {"number_of_teeth": 3, "pressure_angle_deg": 25.0, "profile_shift_coefficient": 0.4,
                  "tip_diameter": 10.4},
    "z 4 undercut": {"number_of_teeth": 4},
    "z 5 undercut": {"number_of_teeth": 5},
    "z 5 bore": {"number_of_teeth": 5, "bore_diameter": 2.0},
    "z 8 deep undercut": {"number_of_teeth": 8, "profile_shift_coefficient": -0.3},
    "z 23": {"number_of_teeth": 23},
    "z 23 bore": {"number_of_teeth": 23, "bore_diameter": 8.0},
    "hair rim": {"number_of_teeth": 23, "bore_diameter": 40.98},
    "thin rim": {"number_of_teeth": 60, "bore_diameter": 114.9},
    "thinner than its chords": {"number_of_teeth": 200, "bore_diameter": 394.99},
    "pin hole": {"number_of_teeth": 23, "bore_diameter": 0.01},
    "relieved": {"number_of_teeth": 30, "tip_relief": {"depth_coefficient": 0.02}, "bore_diameter": 10.0},
    "chamfered": {"number_of_teeth": 23, "tip_chamfer": 0.3},
    "rounded": {"number_of_teeth": 23, "tip_rounding": 0.3, "bore_diameter": 10.0},
    "sharp rack": {"number_of_teeth": 23, "basic_rack": {"tip_radius_coefficient": 0.0}},
    "full round": {"number_of_teeth": 23, "basic_rack": {"tip_radius_coefficient": 0.4719}},
    "pointed": {"number_of_teeth": 12, "profile_shift_coefficient": 0.82},
    "5 degrees": {"number_of_teeth": 40, "pressure_angle_deg": 5.0, "profile_shift_coefficient": 0.5},
    "z 1000": {"number_of_teeth": 1000, "bore_diameter": 100.0},
    "z 1000 solid": {"number_of_teeth": 1000},
}  # fmt: skip


def contours(keys: dict[str, Any], tolerance: float, offset: float = 0.0) -> tuple[Contour, Contour | None]:
    """Outer boundary and bore of a gear as an STL gets them."""
    gear = {"kind": "spur_gear", "module": 2.0, "face_width": WIDTH, **keys}
    raw = {"parts": {"g": gear}, "exports": [{"format": "stl", "tolerance": tolerance, "offset": offset}]}
    plan = plan_build(scene_from_dict(raw, "test", "test"), "test", [], [])
    outer, *bores = (a.geometry for a in shape_of(plan.jobs[0]))
    return outer, bores[0] if bores else None


def extruded_gear(outer: Contour, bore: Contour | None, width: float) -> Mesh:
    """The mesh of a plate with these outlines; only the number of the exact profiles matters here."""
    stands_for = circle(1.0, Label.BORE)
    body = plate(Region(stands_for, () if bore is None else (circle(0.5, Label.BORE, hole=True),)), 0.0, width)
    return body_mesh(body, tuple(Approximation(c, 0.0, "exact", 0.0) for c in (outer, bore) if c is not None))


def shoelace(contour: Contour) -> float:
    """Area within a contour of chords, its corners on the grid of 1e-8 mm on which those of meshes stand."""
    turns = np.exp(2j * np.pi / contour.count * np.arange(contour.count))
    points = (turns[:, None] * contour.vertices).ravel().round(8)
    return abs(0.5 * float(np.sum(np.imag(np.conj(points) * np.roll(points, -1)))))


def bore_area(mesh: Mesh, bore: Contour | None) -> tuple[float, int]:
    """Area and corners of the hole in a mesh: an even polygon on the bore's circle, no coarser than asked for.

    A rim thinner than the bore's chords gets a finer bore, with as many corners behind every tooth.
    """
    if bore is None:
        return 0.0, 0
    radius = abs(bore.vertices[0])
    flat = mesh.vertices[mesh.vertices[:, 2] == 0]
    corners = flat[np.isclose(np.hypot(flat[:, 0], flat[:, 1]), radius, rtol=1e-12)]
    count = len(corners)
    assert count >= len(bore.vertices) * bore.count
    angles = np.sort(np.arctan2(corners[:, 1], corners[:, 0]))
    # places along a curve stand on a grid, the same on any processor
    assert np.allclose(np.diff(angles), 2 * np.pi / count, rtol=0, atol=4e-6)
    return count * radius**2 * np.sin(2 * np.pi / count) / 2, count


def check_mesh(mesh: Mesh, outer: Contour, bore: Contour | None) -> None:
    """All that a slicer could complain about."""
    import trimesh

    solid = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    assert solid.is_watertight
    assert solid.is_winding_consistent
    assert solid.euler_number == (2 if bore is None else 0)
    assert solid.body_count == 1
    hole, corners = bore_area(mesh, bore)
    assert solid.volume == pytest.approx((shoelace(outer) - hole) * WIDTH, rel=1e-9)
    assert solid.area_faces.min() > 0
    # caps and walls stand on the same vertices: every corner of the contours once in each face, and one hub
    assert len(mesh.vertices) == 2 * (len(outer.vertices) * outer.count + (corners if bore else 1))
    assert len(np.unique(mesh.vertices, axis=0)) == len(mesh.vertices)
    assert set(np.unique(mesh.vertices[:, 2])) == {0.0, WIDTH}
    assert len(np.unique(mesh.triangles)) == len(mesh.vertices)


def check_caps(mesh: Mesh, outer: Contour, bore: Contour | None) -> None:
    """Both faces flat and whole, the walls upright: areas by the direction of the triangles."""
    import trimesh

    solid = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    normal = solid.face_normals[:, 2]
    face = shoelace(outer) - bore_area(mesh, bore)[0]
    assert solid.area_faces[normal > 0.5].sum() == pytest.approx(face, rel=1e-9)
    assert solid.area_faces[normal < -0.5].sum() == pytest.approx(face, rel=1e-9)
    walls = np.abs(normal) < 0.5
    assert np.abs(normal[walls]).max() < 1e-9
    centres = solid.triangles_center
    assert np.all(centres[normal > 0.5, 2] == WIDTH)
    assert np.all(centres[normal < -0.5, 2] == 0)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("tolerance", [0.5, 0.05, 0.01, 0.001])
@pytest.mark.parametrize("name", GEARS)
def test_a_gear_becomes_one_sound_solid(name: str, tolerance: float) -> None:
    if tolerance < 0.01 and GEARS[name]["number_of_teeth"] > 500:
        pytest.skip("a million triangles; the heavy tests have them")
    outer, bore = contours(GEARS[name], tolerance)
    mesh = extruded_gear(outer, bore, WIDTH)
    check_mesh(mesh, outer, bore)
    check_caps(mesh, outer, bore)


@pytest.mark.sampled(14)
@pytest.mark.parametrize("offset", [-0.4, -0.05, 0.05, 0.4])
@pytest.mark.parametrize("name", ["z 5 bore", "z 8 deep undercut", "z 23", "z 23 bore", "relieved", "sharp rack"])
def test_an_offset_gear_is_a_sound_solid_too(name: str, offset: float) -> None:
    outer, bore = contours(GEARS[name], 0.01, offset)
    check_mesh(extruded_gear(outer, bore, WIDTH), outer, bore)


@examples(60)
@given(
    teeth=st.integers(3, 150),
    shift=st.floats(-0.5, 1.0),
    share=st.one_of(st.just(0.0), st.floats(0.001, 0.9999)),
    tolerance=st.floats(-3, -0.31).map(lambda v: 10**v),
    angle=st.sampled_from([14.5, 20.0, 25.0, 30.0]),
)
def test_any_gear_becomes_one_sound_solid(
    teeth: int, shift: float, share: float, tolerance: float, angle: float
) -> None:
    root = 2.0 * (teeth - 2.5 + 2 * shift)
    keys = {"number_of_teeth": teeth, "profile_shift_coefficient": shift, "pressure_angle_deg": angle,
            "bore_diameter": max(root * share, 0.0)}  # fmt: skip
    try:
        outer, bore = contours(keys, tolerance)
    except (SceneError, ParameterError):
        return
    try:
        mesh = extruded_gear(outer, bore, WIDTH)
    except GeometryError:
        # only chords so coarse that the outline of a tooth crosses itself are refused
        assert tolerance > 0.1
    else:
        check_mesh(mesh, outer, bore)


@pytest.mark.heavy
@pytest.mark.parametrize("tolerance", [0.01, 0.001, 0.0005])
@pytest.mark.parametrize(
    "keys",
    [
        {"number_of_teeth": 1000, "bore_diameter": 100.0},
        {"number_of_teeth": 10_000, "bore_diameter": 19990.0},
        {"number_of_teeth": 3000},
    ],
    ids=str,
)
def test_the_largest_gears(keys: dict[str, Any], tolerance: float) -> None:
    try:
        outer, bore = contours(keys, tolerance)
    except ParameterError as error:
        if error.code != "finer_than_mesh_digits":
            raise
    else:
        check_mesh(extruded_gear(outer, bore, WIDTH), outer, bore)


def test_the_checks_notice_a_flipped_a_missing_and_a_flat_triangle() -> None:
    outer, bore = contours(GEARS["z 23 bore"], 0.05)
    good = extruded_gear(outer, bore, WIDTH)
    count = len(good.triangles)
    for at in (0, count // 2, count - 1):
        flipped, flat = good.triangles.copy(), good.triangles.copy()
        flipped[at] = flipped[at][::-1]
        flat[at, 2] = flat[at, 1]
        for triangles in (flipped, np.delete(good.triangles, at, axis=0), flat):
            with pytest.raises(AssertionError):
                check_mesh(Mesh(good.vertices, triangles), outer, bore)
        moved = good.vertices.copy()
        moved[at % len(moved), :2] *= 1.01
        with pytest.raises(AssertionError):
            check_mesh(Mesh(moved, good.triangles), outer, bore)
