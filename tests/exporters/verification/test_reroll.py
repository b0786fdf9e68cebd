"""Followers rolled over the files of cams: every kind and format, against a sweep, and a file spoiled at one place."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest

from exporters.formats.read_dxf import read_dxf
from exporters.production.build import build
from exporters.production.plan import plan_build
from exporters.production.recheck import recheck
from exporters.verification.assembly import ExpectedAssembly, verify_assembly
from exporters.verification.judge import probed
from exporters.verification.verdict import Verdict
from geometry.base.series import taylor
from geometry.cams.contact.rolled import lift_bound, outline_of_loop, outline_of_polynomials, rolled_lift
from geometry.cams.motion.guides import Oscillating, Translating
from geometry.cams.plane.disk import FollowerKind, oscillating_cam, translating_cam
from parts.cams.probes import ANGLES, outermost
from parts.scene.files import built_in_scenes
from parts.scene.formats import FILE_KINDS
from parts.scene.load import load_scene, make_parts
from parts.scene.placing import place
from tests.exporters.making import dxf_chains, read_report, run, write_scene
from tests.geometry.cams.oracle import MP, Eccentric, followed
from tests.parts.cams.disk_cam.test_cam import CAMS, cam_of, part_of, scene_text

TAIL = "".join(f'[[exports]]\nformat = "{f}"\n' for f in ("svg", "stl", "3mf")) + (
    '[[exports]]\nformat = "dxf"\npurpose = "drawing"\n[[exports]]\nformat = "dxf"\nkerf = 0.2\nname = "cut"\n'
)


def built(folder: Path, keys: dict[str, Any], tail: str = "") -> tuple[Path, dict[str, Any]]:
    scene = folder / "s.toml"
    scene.write_text(scene_text(keys, tail), encoding="utf-8")
    assert run("build", scene, "--out", folder / "o") == 0
    return folder / "o" / "s", read_report(folder / "o" / "s")


def dense(file: Path) -> np.ndarray:
    """Points of the outer contour, some 0.01 mm apart, on the arcs themselves (ezdxf's paths make them Beziers)."""
    chain = next(c for c in dxf_chains(file) if c.layer == "CUT_OUTER")
    share, points = np.linspace(0, 1, 3000), []
    for start, end, sweep in zip(chain.vertices, np.roll(chain.vertices, -1), chain.sweeps, strict=True):
        part = share if sweep == 0 else (1 - np.exp(1j * sweep * share)) / (1 - np.exp(1j * sweep))
        points.append(start + (end - start) * part)
    return np.concatenate(points)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("kind", FollowerKind)
@pytest.mark.parametrize("swings", [False, True])
def test_an_eccentric_disk_lifts_as_its_triangle_says(kind: FollowerKind, swings: bool) -> None:
    """The lift over a circle in closed form, at 40 digits; the law of the cam does not enter the rolling."""
    radius = 6.0 if kind in (FollowerKind.ROLLER, FollowerKind.MUSHROOM) else 0.0
    motion = cam_of(CAMS["roller"]).motion
    if swings:
        arm = 0.0 if kind is FollowerKind.FLAT else 70.0
        motion = cam_of(CAMS["oscillating roller"]).motion
        cam = oscillating_cam(motion, kind, 35.0, centre_distance=90.0, arm_length=arm, radius=radius, sense=-1)
    else:
        cam = translating_cam(motion, kind, 35.0, radius=radius, follower_offset=4.0)
    disk = Eccentric(40.0, 9.0)
    found = rolled_lift(cam, outline_of_loop(np.array([49.0, -31.0]) + 0j, np.ones(2)), 72)
    mount = cam.mount
    start = mount.start_height if isinstance(mount, Translating) else mount.start_angle
    exact = [float(disk.lift(kind, mount, radius, 2 * MP.pi * k / 72)) - start for k in range(72)]
    assert np.abs(found - exact).max() < 1e-12 * (90 if isinstance(mount, Translating) else 3)
    assert isinstance(mount, Oscillating) == swings


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", CAMS)
def test_every_file_is_rolled_and_agrees_with_a_sweep(name: str, tmp_path: Path) -> None:
    folder, report = built(tmp_path, CAMS[name], TAIL)
    part = part_of(CAMS[name])
    cam = part.thing
    assert cam is not None
    swings = not isinstance(cam.mount, Translating)
    lift, unit = ("swing_error_deg", 180 / math.pi) if swings else ("lift_error", 1.0)
    assert len(report["files"]) == 6
    for file in report["files"]:
        bound = lift_bound(cam, ANGLES, file["max_error"] + 1e-10).max() * unit
        assert 0 < file["measured"][lift] <= bound
        # the tolerance is used: an error is seen, not noise
        assert file["measured"][lift] >= 0.2 * file["max_error"] * unit / (120 if swings else 1)
        told = "rolled_jumps" in {f["code"] for f in file["findings"]}
        assert told == (file["format"] in ("dxf", "svg") and file["purpose"] != "drawing")
    drawing = next(f for f in report["files"] if f["purpose"] == "drawing")["measured"]
    suffix = "_deg" if swings else ""
    assert drawing[f"acceleration_jump{suffix}"] < 0.01 * drawing[f"acceleration_peak{suffix}"]
    path = next(
        f["path"] for f in report["files"] if f["format"] == "dxf" and not f["offset"] and f["tolerance"] > 1e-3
    )
    if name == "pointed":
        return
    rolled = rolled_lift(cam, outermost(read_dxf(folder / path).section(0.0)).outline(), 24)
    outline = dense(folder / path)
    swept = [followed(cam, outline, 2 * math.pi * k / 24) for k in range(24)]
    start = cam.mount.start_angle if isinstance(cam.mount, Oscillating) else cam.mount.start_height
    assert np.allclose(rolled, np.array(swept) - start, atol=1e-5)


def test_arcs_make_the_acceleration_jump_by_half_its_peak(tmp_path: Path) -> None:
    """G1 arcs within 0.005 mm; finer ones jump less, and no curve within 1e-6 mm jumps."""
    found = {}
    for tolerance in (0.005, 0.0005):
        keys = f'[[exports]]\nformat = "svg"\ntolerance = {tolerance}\n'
        (tmp_path / str(tolerance)).mkdir()
        report = built(tmp_path / str(tolerance), CAMS["flat"], keys)[1]
        measured = next(f for f in report["files"] if f["format"] == "svg")["measured"]
        found[tolerance] = measured["acceleration_jump"] / measured["acceleration_peak"]
    assert 0.3 < found[0.005] < 0.6
    assert found[0.0005] < found[0.005] / 1.7


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["roller", "flat", "oscillating roller"])
@pytest.mark.parametrize("spoil", [0.02, -0.02])
def test_a_file_spoiled_at_one_place_is_found_by_its_lift(name: str, spoil: float, tmp_path: Path) -> None:
    folder, report = built(tmp_path, CAMS[name])
    drawing = ezdxf.readfile(folder / "cam.dxf")
    outline = next(e for e in drawing.modelspace() if e.dxf.layer == "CUT_OUTER")
    points = outline.get_points("xyb")
    at = max(range(len(points)), key=lambda k: points[k][1])
    x, y, bulge = points[at]
    share = 1 + spoil / math.hypot(x, y)
    points[at] = (x * share, y * share, bulge)
    outline.set_points(points, format="xyb")
    drawing.saveas(folder / "cam.dxf")
    declared = report["files"][0]["max_error"]
    # the distance of the outline is not asked here: the lift alone must tell
    verdict = probed(read_dxf(folder / "cam.dxf"), part_of(CAMS[name]), 0.0, declared, Verdict({}, ()))
    assert any("follower's lift is wrong" in f for f in verdict.failures)
    assert recheck(folder / "cam.dxf").verdict.failures


def test_an_untouched_file_verifies_and_tells_its_lift(tmp_path: Path) -> None:
    folder, report = built(tmp_path, CAMS["roller"])
    again = recheck(folder / "cam.dxf")
    assert not again.verdict.failures
    assert again.verdict.measured == report["files"][0]["measured"]


def test_step_files_are_rolled_too(tmp_path: Path) -> None:
    pytest.importorskip("OCP", exc_type=ImportError)
    report = built(tmp_path, CAMS["roller"] | {"face_chamfer": 0.5}, '[[exports]]\nformat = "step"\n')[1]
    step = next(f for f in report["files"] if f["format"] == "step")
    assert 1e-9 < step["measured"]["lift_error"] < 2e-6
    assert step["measured"]["acceleration_jump"] < 1e-3 * step["measured"]["acceleration_peak"]
    assert json.dumps(report)


RISE, BACK = {"move": "rise", "law": "polynomial_345"}, {"move": "return_", "law": "modified_sine"}
POINTED: dict[str, dict[str, Any]] = {
    "disk": {"kind": "cam", "lift": 30.0, "base_circle_radius": 15.0,
             "phases": [RISE | {"angle_deg": 60.0}, {"move": "dwell", "angle_deg": 60.0},
                        BACK | {"angle_deg": 120.0}, {"move": "dwell", "angle_deg": 120.0}]},
    "wedge": {"kind": "wedge_cam", "lift": 45.0, "base_height": 45.0,
              "phases": [RISE | {"travel": 180.0}, BACK | {"travel": 180.0}]},
}  # fmt: skip


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", POINTED)
@pytest.mark.parametrize(("offset", "tolerance"), [(0.06, 0.003), (0.2, 0.01)])
def test_a_point_passes_hollow_corners_of_chords_that_are_moved_out(
    name: str, offset: float, tolerance: float, tmp_path: Path
) -> None:
    """It is less than a point then, and fell between two chords, on the lower edge of a plate."""
    part = POINTED[name] | {"follower": "pointed", "face_width": 6.0}
    scene = write_scene(tmp_path / "s.toml", {"p": part}, [{"format": "stl", "offset": offset, "tolerance": tolerance}])
    assert run("build", scene, "--out", tmp_path / "o") == 0
    (file,) = read_report(tmp_path / "o" / "s")["files"]
    assert 0 < file["measured"]["lift_error"] < 3 * tolerance


@pytest.mark.heavy
def test_the_cams_of_an_assembly_are_rolled(tmp_path: Path) -> None:
    scene = load_scene(str(built_in_scenes()["laser_cam_model"]))
    parts, matings = make_parts(scene, "t")
    plan = plan_build(scene, "t", [], ["3mf"])
    written = build(plan, tmp_path / "o").written
    (made,) = [w for w in written if w.job.path == "laser_cam_model.3mf"]
    assert not made.failures
    assert 0 < made.measured["cam.lift_error"] <= made.max_error * (1 + 1e-6)
    assert made.measured["cam.acceleration_peak"] > 0
    # the same file held against a cam of another law is refused
    other = load_scene(str(built_in_scenes()["laser_cam_model"]))
    other.parts["cam"].phases[0].law = "sine"
    wrong, _ = make_parts(other, "t")
    instances = place(scene.instances, scene.drives, parts, matings, "t").instances
    # the same outline, rolled over by the follower of the other
    parts["cam"].__dict__["probes"] = wrong["cam"].probes
    expected = ExpectedAssembly("laser_cam_model", parts, 0.0, instances)
    verdict = verify_assembly(tmp_path / "o" / "laser_cam_model.3mf", FILE_KINDS["3mf"], expected, made.max_error, 0.01)
    assert any("lift is wrong" in failure for failure in verdict.failures)


def test_an_angle_beside_a_cell_of_an_edge_is_not_taken_for_its_end() -> None:
    """Edges are searched cell by cell; every contact here is just before the middle of an arc, an end of two cells.

    Over a circle of radius R whose centre turns c from the axis a roller stands at
    y = c sin phi + sqrt((R + r)^2 - (e - c cos phi)^2).
    """
    big, out, small, aside = 40.0, 9.0, 6.0, 4.0
    model = part_of(CAMS["roller"]).thing
    assert model is not None
    cam = translating_cam(model.motion, FollowerKind.ROLLER, 35.0, radius=small, follower_offset=aside)
    assert isinstance(cam.mount, Translating)
    phi = np.radians(np.arange(0, 360, 30))
    centre = out * np.exp(1j * phi)
    height = centre.imag + np.sqrt((big + small) ** 2 - (aside - centre.real) ** 2)
    touched = np.unwrap(np.angle((aside + 1j * height - centre) * np.exp(-1j * phi)))[::-1]
    for beside in (0.0, 2e-7):
        ends = np.stack([touched - 0.1, touched + 0.1 + 2 * beside], axis=1).ravel()
        sweeps = np.diff(np.append(ends, ends[0] + 2 * np.pi))
        found = rolled_lift(cam, outline_of_loop(out + big * np.exp(1j * ends), np.tan(sweeps / 4)), 12)
        assert np.abs(found + cam.mount.start_height - height).max() < 1e-11


@pytest.mark.parametrize("swings", [False, True])
def test_a_face_is_held_by_edges_that_turn_within_a_millionth_of_their_length(swings: bool) -> None:
    """As splines do beside a cusp; the oracle is the farthest of half a million points, crowded at their ends."""
    around = 2 * np.pi * np.arange(13) / 12
    corners, ways = 40 * np.exp(1j * around), 1j * np.exp(1j * around)
    ahead, back = 7 * ways[:-1], 7 * ways[1:]
    # every other one turns aside at once after an end leg as short as a drawing's error, and back within an eighth
    ahead[1::2] *= 3e-7 / 7
    poles = np.stack([corners[:-1], corners[:-1] + ahead, corners[1:] - back, corners[1:]], axis=1)
    poles[1::2, 2] = poles[1::2, 1] + 3 * ways[:-1][1::2] * np.exp(-0.1j)
    powers = np.array([[1, -3, 3, -1], [0, 3, -6, 3], [0, 0, 3, -3], [0, 0, 0, 1]])
    crowd = 10.0 ** -np.linspace(1, 10, 2000)
    t = np.concatenate([np.linspace(0, 1, 40001), crowd, 1 - crowd])
    points = np.concatenate([np.polyval(edge[::-1], t) for edge in poles @ powers])
    cam = part_of(CAMS["oscillating flat" if swings else "flat"]).thing
    assert cam is not None
    for shift in (0.0, 1e-4):
        found = rolled_lift(cam, outline_of_polynomials((poles + shift) @ powers), 24)
        for k in range(24):
            lift = taylor([np.array(found[k])])
            height, normal = cam.mount.face(lift)
            # the face that touches at S, in the cam's frame: nothing reaches over it, something reaches it
            out = np.exp(-1j * (float(normal[0]) - 2 * np.pi * k / 24))
            over = float((points * out).real.max() - float(height[0]))
            assert abs(over + shift * out.real) < 1e-8
            assert shift == 0 or abs(out.real) < 0.1 or abs(over) > 1e-5
