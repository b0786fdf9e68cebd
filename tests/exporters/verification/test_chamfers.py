"""Face chamfers in STEP and meshes: points of the files against the roof of 45 degrees over the exact outline.

The oracle shares nothing with the code: a point of a chamfer lies as deep below the outline, measured by brute force
along the exact outline's own points, as it stands from the height at which the chamfer begins.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.formats.read_stl import read_stl
from exporters.formats.registry import REGISTRY, declared_error, shape_of
from exporters.production.build import build
from exporters.production.plan import plan_build
from exporters.verification.judge import verify_file
from exporters.verification.mesh import verify_mesh
from geometry.base.record import replace
from geometry.plane.profile import Label, Region
from parts.scene.formats import FILE_KINDS
from parts.scene.load import make_parts, scene_from_dict
from parts.solids.mesh import body_mesh, mesh_outlines

GEAR: dict[str, Any] = {"module": 2.0, "number_of_teeth": 10, "profile_shift_coefficient": 0.4, "face_width": 4.0}
CHAMFER = 0.3
# the oracle looks at one tooth and its spaces, rad
SECTOR = 0.45
PARTS: dict[str, dict[str, Any]] = {
    "gear": GEAR,
    "tip rounding": {**GEAR, "tip_rounding": 0.5},
    "tip chamfer": {**GEAR, "tip_chamfer": 0.2},
    "ring": {"kind": "ring_gear", "module": 2.0, "number_of_teeth": 20, "face_width": 4.0, "tip_rounding": 0.5},
    # its tips end on the base circle, at the cusps of its flanks
    "ring of cusps": {"kind": "ring_gear", "module": 2.0, "number_of_teeth": 20, "face_width": 4.0, "rounded_root": {}},
    "ring sector": {
        "kind": "ring_gear",
        "module": 2.0,
        "number_of_teeth": 20,
        "face_width": 4.0,
        "rounded_root": {},
        "sector": {"teeth": 3, "blank_diameter": 48.0, "corner_radius": 0.7},
    },
    "hexagon": {**GEAR, "number_of_teeth": 17, "bore": {"shape": "hexagon", "across_flats": 8.0, "corner_radius": 0.8}},
}


def job(kind: str, name: str, **export: Any) -> Any:
    """The job of a part with a chamfer below and above."""
    part = {"kind": "spur_gear", **PARTS[name], "face_chamfer": CHAMFER}
    scene = scene_from_dict({"parts": {"g": part}, "exports": [{"format": kind, **export}]}, "test", "test")
    return plan_build(scene, "test", [], []).jobs[0]


def written(kind: str, name: str, folder: Path) -> tuple[Any, Path, float]:
    """The job, its file and the declared error."""
    work = job(kind, name)
    made, file = shape_of(work), folder / work.path
    REGISTRY[kind].write(work, made, file)
    return work, file, declared_error(work, made)[0]


def roof_distance(points: np.ndarray, region: Region, width: float) -> np.ndarray:
    """Distance of points (n, 3) from the roof over a region: how deep they lie against how deep they should."""
    places, z = points[:, 0] + 1j * points[:, 1], points[:, 2]
    depth = np.full(len(points), np.inf)
    for profile in region.profiles():
        for curve in (s.curve for s in profile.segments()):
            ends = curve.point(np.array(curve.domain))
            if np.abs(np.angle(ends)).min() > 1.5 * SECTOR:
                continue
            t = np.linspace(*curve.domain, 201)
            near = np.abs(places[:, None] - curve.point(t)).argmin(axis=1)
            best, step = t[near], t[1] - t[0]
            for _ in range(60):
                # golden section would do; ternary search needs the points only
                left, right = (np.clip(best + s * step, *curve.domain) for s in (-0.5, 0.5))
                tries = np.stack([left, best, right])
                gaps = np.abs(curve.point(tries) - places)
                best = np.take_along_axis(tries, gaps.argmin(axis=0)[None], axis=0)[0]
                step *= 0.6
            depth = np.minimum(depth, np.abs(curve.point(best) - places))
    asked_depth = CHAMFER - np.minimum(z, width - z)
    return np.abs(depth - asked_depth) / math.sqrt(2)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", PARTS)
def test_the_declared_error_of_a_step_file_holds_on_chamfers(name: str, tmp_path: Path) -> None:
    pytest.importorskip("OCP", exc_type=ImportError)
    from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Surface
    from OCP.GeomAbs import GeomAbs_SurfaceType

    from parts.solids.kernel import edges_of, faces_of, solids_of

    work, file, declared = written("step", name, tmp_path)
    points = []
    for face in faces_of(solids_of(file.read_text())[0]):
        surface = BRepAdaptor_Surface(face)
        ends = []
        for edge in edges_of(face):
            curve = BRepAdaptor_Curve(edge)
            places = [curve.Value(t) for t in np.linspace(curve.FirstParameter(), curve.LastParameter(), 7).tolist()]
            ends += [(p.X(), p.Y(), p.Z()) for p in places]
        z = np.array(ends)[:, 2]
        x, y = np.array(ends)[:, :2].T
        if np.ptp(z) < 1e-6 or np.ptp(z) > 2 * CHAMFER or np.abs(np.arctan2(y, x)).max() > SECTOR:
            continue
        points += ends
        if surface.GetType() == GeomAbs_SurfaceType.GeomAbs_BSplineSurface:
            low, high = surface.FirstUParameter(), surface.LastUParameter()
            for u in np.linspace(low, high, 15).tolist():
                points += [(p.X(), p.Y(), p.Z()) for p in (surface.Value(u, v) for v in (0.1, 0.35, 0.6, 0.9))]
    assert len(points) > 300
    assert roof_distance(np.array(points), work.section.region, GEAR["face_width"]).max() <= declared + 1e-9


@pytest.mark.sampled(1)
@pytest.mark.parametrize("tolerance", [0.01, 0.0005])
def test_the_declared_error_of_a_mesh_holds_on_chamfers(tolerance: float, tmp_path: Path) -> None:
    work = job("stl", "gear", tolerance=tolerance)
    made, file = shape_of(work), tmp_path / work.path
    REGISTRY["stl"].write(work, made, file)
    declared = declared_error(work, made)[0]
    mesh = read_stl(file)
    corners = mesh.vertices[mesh.triangles]
    z, width = corners[:, :, 2], GEAR["face_width"]
    low = (z.min(axis=1) < CHAMFER - 1e-4) & (z.max(axis=1) < CHAMFER + 1e-4) & (np.ptp(z, axis=1) > 1e-4)
    shares = np.array([(1, 1, 1), (1, 1, 0), (0, 1, 1), (1, 0, 1), (4, 1, 1), (1, 4, 1), (1, 1, 4)], dtype=float)
    # one tooth and its neighbours
    mine = corners[low & (np.abs(np.angle(corners[:, 0, 0] + 1j * corners[:, 0, 1])) < SECTOR)]
    points = np.einsum("pk,nkc->npc", shares / shares.sum(axis=1, keepdims=True), mine).reshape(-1, 3)
    assert len(points) > 500
    found = roof_distance(points, work.section.region, width).max()
    assert declared / 3 <= found <= declared <= tolerance
    assert verify_mesh(mesh, work.exact, declared, tolerance).failures == ()


@pytest.mark.parametrize(
    ("chamfer", "told"),
    [(0.3, None), (0.31, 0.31), ({"below": 0.2, "above": 0.4}, 0.4), ({"below": 0.3, "above": 0.1}, None)],
)
def test_a_tip_rounding_that_a_plain_chamfer_would_take_is_told(chamfer: Any, told: float | None) -> None:
    """From three quarters of the radius on it is less by less than the depth."""
    keys = {"kind": "spur_gear", **GEAR, "tip_rounding": 0.4, "face_chamfer": chamfer}
    scene = scene_from_dict({"parts": {"g": keys}, "exports": [{"format": "step"}]}, "test", "test")
    work = plan_build(scene, "test", [], []).jobs[0]
    found = [(f.value, f.limit) for f in work.part.findings if f.code == "tip_rounding_kept"]
    assert found == ([] if told is None else [(told, pytest.approx(0.3, rel=1e-12))])
    # where a quarter is kept, the roof of 45 degrees is left beside it
    wall, whole, end = max(work.body.chamfers(), key=lambda c: np.ptp([work.body.loops[i].z for i in c[1:]]))
    tip = [s.curve for s in work.body.section_at(wall, whole, end, 1.0).period if s.label is Label.TIP_BREAK]
    depth = float(np.ptp([work.body.loops[i].z for i in (whole, end)]))
    t = np.linspace(*tip[0].domain, 5)
    assert 1 / np.abs(tip[0].curvature(t)) == pytest.approx(max(0.4 - depth, 0.1), rel=1e-6)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("where", [0, 1, 2])
def test_a_bent_chamfer_of_a_step_file_is_caught(where: int, tmp_path: Path) -> None:
    """Inner poles of one face are moved: its edges, its caps and the walls stay where they are."""
    pytest.importorskip("OCP", exc_type=ImportError)
    work = job("step", "gear")
    made = list(shape_of(work))
    index = next(i for i, outline in enumerate(made) if outline.faces)
    faces = list(made[index].faces)
    curved = [i for i, poles in enumerate(faces) if poles.shape[0] > 2]
    bent = faces[curved[where]].copy()
    bent[bent.shape[0] // 2, 1] += 1e-4
    faces[curved[where]] = bent
    made[index] = replace(made[index], faces=tuple(faces))
    file = tmp_path / work.path
    REGISTRY["step"].write(work, tuple(made), file)
    failures = verify_file(file, FILE_KINDS["step"], work.exact, declared_error(work, tuple(made))[0], 1e-6).failures
    assert any("deviates" in failure for failure in failures)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_a_dented_chamfer_of_a_mesh_is_caught(share: float, tmp_path: Path) -> None:
    """A vertex of an inner slice is pushed in: both ends of the chamfer stay where they are."""
    work = job("stl", "gear", tolerance=0.0005)
    made, file = shape_of(work), tmp_path / work.path
    REGISTRY["stl"].write(work, made, file)
    mesh, declared = read_stl(file), declared_error(work, made)[0]
    inner = np.flatnonzero((mesh.vertices[:, 2] > 0.01) & (mesh.vertices[:, 2] < CHAMFER - 0.01))
    mesh.vertices[inner[round(share * (len(inner) - 1))], :2] *= 1 - 2e-3 / 12
    assert any("deviates" in failure for failure in verify_mesh(mesh, work.exact, declared, 0.0005).failures)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("depth", [0.1, CHAMFER, 0.4])
def test_an_engraving_beside_a_chamfer_is_measured_however_deep_it_is(depth: float, tmp_path: Path) -> None:
    """Before: one no deeper than the chamfer failed its check. One that is moved along is caught."""
    part = {"kind": "spur_gear", **GEAR, "face_chamfer": CHAMFER, "number_of_teeth": 17, "tooth_mark": {"depth": depth}}
    scene = scene_from_dict({"parts": {"g": part}, "exports": [{"format": "stl"}]}, "test", "test")
    work = plan_build(scene, "test", [], []).jobs[0]
    made, file = shape_of(work), tmp_path / work.path
    REGISTRY["stl"].write(work, made, file)
    mesh, declared = read_stl(file), declared_error(work, made)[0]
    assert verify_mesh(mesh, work.exact, declared, 0.01).failures == ()
    # all that lies within the root circle
    mesh.vertices[np.hypot(*mesh.vertices[:, :2].T) < 14.0, 0] += 0.1
    assert any("deviates" in failure for failure in verify_mesh(mesh, work.exact, declared, 0.01).failures)


@pytest.mark.parametrize("kind", ["stl", "step"])
def test_a_rounding_keeps_a_quarter_of_itself_at_a_face_that_alone_is_chamfered(kind: str, tmp_path: Path) -> None:
    """0.38 mm deep, a rounding of 0.4 mm is 0.1 mm at the chamfered face and whole at the other."""
    part = {"kind": "spur_gear", **GEAR, "tip_rounding": 0.4, "face_chamfer": {"above": 0.38}}
    export = {"format": kind, "tolerance": 0.001}
    plan = plan_build(scene_from_dict({"parts": {"g": part}, "exports": [export]}, "t", "t"), "t", [], [])
    assert build(plan, tmp_path / "o").well
    if kind == "stl":
        mesh = read_stl(tmp_path / "o" / plan.jobs[0].path)
        for height, radius in ((4.0, 0.1), (0.0, 0.4)):
            level = mesh.vertices[mesh.vertices[:, 2] == height]
            points = level[:, 0] + 1j * level[:, 1]
            points = points[np.abs(points) > np.abs(points).max() - radius]
            points = points[np.argsort(np.angle(points))]
            # the circle through three that follow each other on one rounding
            a, b, c = points[:-2], points[1:-1], points[2:]
            across = np.abs(((b - a).conj() * (c - a)).imag)
            circles = np.abs((b - a) * (c - b) * (a - c)) / (2 * across)
            # corners are singles on chords of some hundredths of a mm
            assert circles.min() == pytest.approx(radius, rel=5e-3)


def test_the_finest_mesh_of_a_chamfered_gear_has_no_flat_triangle() -> None:
    """At what was offered for less than digits hold: chords were cut as if one wall stood over all slices.

    Some lay so near each other that float32 made one line of three corners, which no read-back lets pass.
    """
    keys = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 8, "face_width": 6.0, "face_chamfer": 0.3}
    parts, _ = make_parts(scene_from_dict({"parts": {"g": keys}}, "test", "test"), "test")
    body = parts["g"].body(0.0)
    mesh = body_mesh(body, mesh_outlines(body, 1.526e-5, 1e-4))
    corners = mesh.vertices.astype("<f4").astype(float)[mesh.triangles]
    assert np.all(np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) > 0)
