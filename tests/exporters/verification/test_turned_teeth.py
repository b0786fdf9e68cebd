"""Meshes whose teeth are one turned: few triangles are measured, and what is found is what all of them would give."""

from __future__ import annotations

from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest

from exporters.formats.readback import ReadMesh
from exporters.verification.faces import mesh_deviation, verify_faced_mesh
from geometry.curves.curve import Real
from geometry.solids.faced import FacedBody, Measured
from parts.scene.load import make_parts, scene_from_dict
from parts.solids.face_mesh import faced_mesh

Z, TOLERANCE = 24, 0.2


@cache
def _body() -> FacedBody:
    # the sides of a bore turn by a quarter, its keyway by a whole turn
    keys = {"kind": "worm_wheel", "module": 2.0, "number_of_teeth": Z, "face_width": 6.0, "bore": BORE}
    return make_parts(scene_from_dict({"parts": {"wheel": keys}}, "s", "s"), "s")[0]["wheel"].body(0.0)


BORE = {"shape": "square", "across_flats": 12.0}


@pytest.fixture(scope="module")
def mesh() -> ReadMesh:
    made = faced_mesh(_body(), TOLERANCE)
    # rounded as in an STL
    return ReadMesh(made.vertices.astype(np.float32).astype(float), made.geometry)


def _told(mesh: ReadMesh, *, turns: bool) -> tuple[float, int, int]:
    """Deviation, faces without triangles, and points that are measured, where surfaces tell their turns or do not."""
    points = []

    def counted(face: Measured) -> Measured:
        def distance(at: Real) -> Real:
            points.append(len(at))
            return face.distance(at)

        return Measured(face.what, distance, face.turns if turns else 1)

    body = SimpleNamespace(surfaces=tuple(map(counted, _body().surfaces)), reach=_body().reach)
    return *mesh_deviation(mesh, body), sum(points)


def _compared(mesh: ReadMesh) -> float:
    """The deviation, which is that of all triangles."""
    (found, lone, _), (whole, none, _) = (_told(mesh, turns=turns) for turns in (True, False))
    assert found == pytest.approx(whole, rel=1e-9)
    assert lone == none == 0
    return found


def test_few_points_are_measured(mesh: ReadMesh) -> None:
    assert _compared(mesh) <= TOLERANCE
    assert 5 * _told(mesh, turns=True)[2] < _told(mesh, turns=False)[2]


@pytest.mark.parametrize(("by", "least"), [(0.5, 0.4), (-1e-3, 0.0)])
def test_a_vertex_of_any_tooth_is_found(mesh: ReadMesh, by: float, least: float) -> None:
    rng = np.random.default_rng(round(1e6 + 1e5 * by))
    radius = np.hypot(*mesh.vertices[:, :2].T)
    teeth = np.flatnonzero(radius > 0.95 * radius.max())
    for vertex in rng.choice(teeth, 1, replace=False):
        own = mesh.triangles[(mesh.triangles == vertex).any(axis=1)]
        a, b, c = mesh.vertices[own].transpose(1, 0, 2)
        normal = np.cross(b - a, c - a).sum(axis=0)
        vertices = mesh.vertices.copy()
        vertices[vertex] += by * normal / np.linalg.norm(normal)
        moved = ReadMesh(vertices, mesh.triangles)
        assert _compared(moved) > least


def test_noise_changes_nothing(mesh: ReadMesh) -> None:
    noise = np.random.default_rng(7).normal(scale=3e-5, size=mesh.vertices.shape)
    _compared(ReadMesh(mesh.vertices + noise, mesh.triangles))


def test_a_lost_tooth_and_a_turned_triangle_are_found(mesh: ReadMesh) -> None:
    flat, radius = mesh.vertices[:, 0] + 1j * mesh.vertices[:, 1], np.hypot(*mesh.vertices[:, :2].T)
    tooth = (np.abs(np.angle(flat * np.exp(-2j * np.pi * 5 / Z))) < np.pi / Z) & (radius > 0.9 * radius.max())
    vertices = mesh.vertices.copy()
    vertices[tooth, :2] *= 0.98
    lost = verify_faced_mesh(ReadMesh(vertices, mesh.triangles), _body(), TOLERANCE, TOLERANCE)
    assert any("deviates" in failure for failure in lost.failures)
    triangles = mesh.triangles.copy()
    triangles[len(triangles) // 3] = triangles[len(triangles) // 3, ::-1]
    turned = verify_faced_mesh(ReadMesh(mesh.vertices, triangles), _body(), TOLERANCE, TOLERANCE)
    assert turned.failures
    assert not verify_faced_mesh(mesh, _body(), TOLERANCE, TOLERANCE).failures
