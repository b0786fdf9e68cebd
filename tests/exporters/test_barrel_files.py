"""Files of cylindrical cams: read back, the roller put into the groove, and spoiled meshes and solids seen."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.readers import ReadMesh, read_stl
from exporters.recheck import recheck
from exporters.reroll_barrel import ANGLES, rolled_places
from exporters.verify import Verdict
from exporters.verify_barrel import face_distance, verify_barrel_mesh
from geometry.cams.barrel import LOWER, UPPER
from geometry.cams.barrel_body import BarrelBody, Plane, Track
from geometry.cams.follower_motion import TURN
from parts.solids import body_mesh, mesh_outlines
from tests.parts.test_barrel_cam import END, GROOVE, SWING, body_of

from .making import read_report, run, write_scene

FORMS = {"groove": GROOVE | {"clearance": 0.2, "bore": {"shape": "keyway", "diameter": 12.0},
                             "hub": {"diameter": 24.0, "above": 4.0, "below": 2.0}},
         "end": END | {"bore_diameter": 10.0}, "tube": END | {"web_thickness": 0.0}, "swing": SWING}  # fmt: skip
TOLERANCE = 0.05


def mesh_of(body: BarrelBody) -> tuple[ReadMesh, float]:
    outlines = mesh_outlines(body, TOLERANCE, 0.0)
    made = body_mesh(body, outlines)
    return ReadMesh(made.vertices, made.triangles), outlines[0].max_error


def verdict(mesh: ReadMesh, body: BarrelBody, error: float) -> Verdict:
    return verify_barrel_mesh(mesh, body, error, TOLERANCE)


@pytest.mark.parametrize("name", FORMS)
def test_meshes_are_closed_and_near_by_an_outside_measure(name: str) -> None:
    import trimesh

    body = body_of(FORMS[name])
    mesh, error = mesh_of(body)
    solid = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    assert solid.is_watertight and solid.is_winding_consistent
    assert not verdict(mesh, body, error).failures
    # points of the walls by brute force stand on the mesh
    angles = np.linspace(0, TURN, 37)
    for side in body.cam.sides:
        for radius in (body.cam.inner, (body.cam.inner + body.cam.outer) / 2, body.cam.outer):
            points = body.cam.wall(angles, side, radius)
            assert np.abs(trimesh.proximity.closest_point(solid, points)[1]).max() <= error


def test_spoiled_walls_are_seen_at_the_start_the_middle_and_the_end() -> None:
    body = body_of(FORMS["groove"])
    mesh, error = mesh_of(body)
    walls = [face for face in body.faces() if isinstance(face, Track)]
    for wall in walls:
        away = face_distance(body, wall, mesh.vertices)
        mine = np.flatnonzero(away < 1e-6)
        for pick in (mine[0], mine[len(mine) // 2], mine[-1]):
            vertices = mesh.vertices.copy()
            vertices[pick, 2] += 2.5 * error
            assert any("deviates" in f for f in verdict(ReadMesh(vertices, mesh.triangles), body, error).failures)


def test_missing_triangles_and_faces_are_seen() -> None:
    body = body_of(FORMS["groove"])
    mesh, error = mesh_of(body)
    for k in (0, len(mesh.triangles) // 2, len(mesh.triangles) - 1):
        holed = ReadMesh(mesh.vertices, np.delete(mesh.triangles, k, axis=0))
        assert "not closed" in verdict(holed, body, error).failures[0]
    # a cam of another lift, another groove, another length
    for other in (GROOVE | {"lift": 19.0, "length": body.length}, GROOVE | {"groove_depth": 7.9},
                  {**FORMS["groove"], "end_margin": 5.2}):  # fmt: skip
        assert verdict(mesh, body_of(other), error).failures
    bare = replace(body, hub=None)
    assert any("face" in f or "deviates" in f for f in verdict(mesh_of(bare)[0], body, error).failures)


def test_the_roller_in_the_groove_feels_the_walls() -> None:
    """Heights by the mesh agree with the exact ones; a wall lifted by d lifts the roller by d."""
    body = body_of(FORMS["groove"])
    mesh, error = mesh_of(body)
    cam = body.cam
    axis = cam.place(np.arange(ANGLES) * TURN / ANGLES, 0)[0].imag
    found, smaller = rolled_places(mesh, cam, (cam.radius, cam.radius - 0.5))
    for side in (UPPER, LOWER):
        assert np.abs(found[side] - axis).max() < 1.5 * error
    # half a mm of play on each side in a dwell, more on slopes
    play = smaller[UPPER] - smaller[LOWER]
    assert play.min() > 1.0 - 2 * error
    assert play[ANGLES * 150 // 360] == pytest.approx(1.0, abs=2 * error)
    assert play.max() > 1.05
    away = face_distance(body, next(f for f in body.faces() if isinstance(f, Track) and f.side == LOWER), mesh.vertices)
    vertices = mesh.vertices.copy()
    vertices[away < 1e-6, 2] += 0.3
    lifted = rolled_places(ReadMesh(vertices, mesh.triangles), cam, (cam.radius,))[0]
    assert np.abs(lifted[LOWER] - found[LOWER] - 0.3).max() < 1e-9
    assert np.array_equal(lifted[UPPER], found[UPPER])


def built(folder: Path, keys: dict[str, Any], exports: list[dict[str, Any]]) -> tuple[Path, dict[str, Any]]:
    scene = write_scene(folder / "s.toml", {"cam": keys}, exports)
    assert run("build", scene, "--out", folder / "o") == 0
    return folder / "o" / "s", read_report(folder / "o" / "s")


def test_files_of_a_swinging_follower(tmp_path: Path) -> None:
    exports = [{"format": "stl", "tolerance": TOLERANCE}, {"format": "dxf", "tolerance": 0.01},
               {"format": "dxf", "purpose": "drawing", "tolerance": 1e-4, "name": "d"}]  # fmt: skip
    folder, report = built(tmp_path, SWING | {"clearance": 0.1}, exports)
    by_path = {f["path"]: f for f in report["files"]}
    measured = by_path["cam.stl"]["measured"]
    assert measured["lift_error"] < 1.3 * TOLERANCE
    assert measured["least_play"] > 0.1 - 2 * TOLERANCE
    assert by_path["cam.laser.dxf"]["entities"]["LWPOLYLINE"] == 2
    assert recheck(folder / "cam.stl").verdict.failures == ()
    # a wall shifted as a whole by more than the tolerance
    mesh = read_stl(folder / "cam.stl")
    assert mesh.vertices[:, 2].min() == 0.0


def test_a_step_file_holds_the_exact_cam(tmp_path: Path) -> None:
    pytest.importorskip("OCP")
    from exporters.step import write_step
    from exporters.verify_barrel_step import verify_barrel_step
    from parts.brep import body_outlines, body_solid

    for name in ("groove", "end", "swing"):
        body = body_of(FORMS[name])
        splines = body_outlines(body, 1e-6)
        file = tmp_path / f"{name}.step"
        write_step(file, "cam", body_solid(body, splines), None)
        error = splines[0].max_error + 1e-9
        assert error < 5e-8
        good = verify_barrel_step(file, body, error, 1e-6, "cam")
        assert good.failures == ()
        assert abs(good.measured["volume_error"]) < 1e-8
        # against a cam that differs a little, at its walls, its floor, and its ends
        cam = body.cam
        low = replace(body, cam=replace(cam, guide=cam.guide.raised(1e-4)))
        assert any("deviates" in f for f in verify_barrel_step(file, low, error, 1e-6, "cam").failures)
        deep = replace(body, cam=replace(cam, inner=cam.inner - 1e-4))
        assert verify_barrel_step(file, deep, error, 1e-6, "cam").failures
        wide = replace(body, cam=cam.with_radius(cam.radius + 1e-5))
        assert verify_barrel_step(file, wide, error, 1e-6, "cam").failures
        longer = replace(body, length=body.length + 1e-3)
        assert bool(verify_barrel_step(file, longer, error, 1e-6, "cam").failures) == cam.is_groove
        assert any(isinstance(face, Plane) for face in body.faces())
