"""Binary STL: the bytes, the solid, and the outline of both faces measured from outside."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.production.build import build
from exporters.production.plan import plan_build
from parts.scene.load import scene_from_dict
from tests.exporters.making import build_gear, check_deviation, face_chains, run, stl_triangles, write_scene
from tests.exporters.outside import Gear, half_tooth

REFERENCE = Gear(2, 23, bore=8)
GEARS = {
    "m 2 z 23": REFERENCE,
    "practicum": Gear(10, 13, 0.694, tip_diameter=160.68, bore=30),
    "undercut, solid": Gear(3, 8),
    "relieved": Gear(3, 30, bore=20, relief_depth=0.02),
    "thin rim": Gear(1, 60, bore=57.2),
    "fine watch": Gear(0.2, 60, bore=1),
}


def built(folder: Path, gear: Gear, face_width: float = 5.0, **export: Any) -> tuple[Path, dict[str, Any]]:
    """An STL of one gear and its entry in the report."""
    report = build_gear(folder, gear, {"format": "stl", **export}, face_width=face_width)
    return folder / "out" / "s" / "g.stl", report["files"][0]


def test_the_header_cannot_be_taken_for_text_and_counts_match(tmp_path: Path) -> None:
    file, entry = built(tmp_path, REFERENCE)
    mesh = stl_triangles(file)
    assert not mesh.header.lstrip().lower().startswith(b"solid")
    assert len(mesh.header) == 80
    assert b"mm" in mesh.header
    assert entry["entities"]["triangles"] == len(mesh.corners)
    assert entry["bytes"] == file.stat().st_size == 84 + 50 * len(mesh.corners)
    assert file.read_bytes()[84 + 48 :: 50][:2] == b"\0" * 2


def test_normals_are_those_of_the_stored_corners(tmp_path: Path) -> None:
    mesh = stl_triangles(built(tmp_path, REFERENCE)[0])
    corner = mesh.corners.astype(float)
    cross = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    exact = cross / np.linalg.norm(cross, axis=1, keepdims=True)
    assert np.abs(exact - mesh.normals).max() < 1e-6


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", GEARS)
@pytest.mark.parametrize("tolerance", [0.05, 0.01, 0.001])
def test_both_faces_are_within_the_tolerance(tmp_path: Path, name: str, tolerance: float) -> None:
    gear = GEARS[name]
    file, entry = built(tmp_path, gear, 3.3, tolerance=tolerance)
    check_deviation(file, gear, entry, 0.0)
    check_deviation(file, gear, entry, 3.3)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["m 2 z 23", "undercut, solid", "thin rim"])
@pytest.mark.parametrize("offset", [-0.05, 0.08])
def test_an_offset_moves_every_wall(tmp_path: Path, name: str, offset: float) -> None:
    file, entry = built(tmp_path, GEARS[name], offset=offset)
    check_deviation(file, GEARS[name], entry)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", GEARS)
def test_a_slicer_finds_one_closed_solid_in_millimetres(tmp_path: Path, name: str) -> None:
    import trimesh

    gear = GEARS[name]
    file, entry = built(tmp_path, gear, 3.3)
    solid = trimesh.load(io.BytesIO(file.read_bytes()), file_type="stl")
    assert solid.is_watertight
    assert solid.is_winding_consistent
    assert solid.euler_number == (0 if gear.bore else 2)
    assert solid.body_count == 1
    assert solid.bounds[:, 2] == pytest.approx([0, np.float32(3.3)], abs=0)
    assert solid.extents[0] == pytest.approx(2 * gear.tip_radius, rel=2e-2)
    half = np.concatenate([[0j], *half_tooth(gear).values()])
    tooth = abs(float(np.sum(np.imag(np.conj(half) * np.roll(half, -1)))))
    exact = 3.3 * (gear.teeth * tooth - np.pi * gear.bore**2 / 4)
    walls = solid.area - 2 * exact / 3.3
    assert abs(solid.volume - exact) < 1.01 * entry["max_error"] * walls
    assert solid.volume < exact or gear.bore or gear.teeth < 10


def test_walls_stand_upright_on_the_same_outline(tmp_path: Path) -> None:
    mesh = stl_triangles(built(tmp_path, REFERENCE, 3.3)[0])
    top = np.float32(3.3)
    assert np.all((mesh.corners[:, :, 2] == 0) | (mesh.corners[:, :, 2] == top))
    lower, upper = (face_chains(mesh, height) for height in (0.0, 3.3))
    for one, other in zip(lower, upper, strict=True):
        assert set(one.vertices.tolist()) == set(other.vertices.tolist())


def test_numbers_are_the_nearest_float32(tmp_path: Path) -> None:
    """The outline's tip and root stand on their circles as well as seven digits can say it."""
    chain = face_chains(stl_triangles(built(tmp_path, REFERENCE)[0]), 0.0)[-1]
    radii = np.abs(chain.vertices)
    assert abs(radii.max() - REFERENCE.tip_radius) < 2.0**-23 * REFERENCE.tip_radius
    assert abs(radii.min() - REFERENCE.root_radius) < 2.0**-23 * REFERENCE.tip_radius


def test_the_report_measures_edges_and_triangles_of_a_plate(tmp_path: Path) -> None:
    """An outline of 30 x 20 mm, 4 mm high: the least triangles are halves of its narrow walls."""
    raw = {"parts": {"p": {"kind": "plate", "width": 30.0, "height": 20.0, "face_width": 4.0}},
           "exports": [{"format": "stl"}]}  # fmt: skip
    (written,) = build(plan_build(scene_from_dict(raw, "s", "s"), "s", [], []), tmp_path).written
    found = written.measured
    assert (found["triangles"], found["shortest_edge"]) == (16, pytest.approx(20.0))
    assert found["volume"] == pytest.approx(2400.0)
    assert found["least_triangle_area"] == pytest.approx(40.0)


def test_the_thickness_of_a_wide_plate_is_the_nearest_float32(tmp_path: Path) -> None:
    # of seven digits, and four more than those of a grid by its width
    keys = {"kind": "plate", "width": 2400.0, "height": 1200.0, "face_width": 3.3333333}
    scene = write_scene(tmp_path / "s.toml", {"p": keys}, [{"format": "stl"}])
    assert run("build", scene, "--out", tmp_path / "out") == 0
    heights = stl_triangles(tmp_path / "out" / "s" / "p.stl").corners[:, :, 2]
    assert np.all((heights == 0) | (heights == np.float32(3.3333333)))
