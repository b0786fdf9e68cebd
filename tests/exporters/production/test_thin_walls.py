"""Tolerances that leave a wall none of its own, an outline crossed or too many edges: refused with what works."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest
import trimesh

from exporters.formats.registry import shape_of
from exporters.production.build import build
from exporters.production.plan import Plan, plan_build
from geometry.base.errors import ParameterError
from geometry.base.tolerance import LEAST_SEGMENT_MM
from geometry.plane.contour import Approximation, Contour
from parts.base.refusal import SceneError
from parts.scene.load import scene_from_dict
from parts.solids.face_mesh import FaceMesh

# a disc of 40 mm with a hole 0.11 mm from its edge, where chords of both lie farthest within
TURN = math.radians(15)
DISC: dict[str, Any] = {
    "kind": "plate", "width": 40.0, "height": 40.0, "corner_radius": 20.0, "face_width": 3.0,
    "holes": [{"at": [5 * math.cos(TURN), 5 * math.sin(TURN)], "diameter": 2 * 14.89}],
}  # fmt: skip


def planned(part: dict[str, Any], **export: Any) -> Plan:
    raw = {"parts": {"p": part}, "exports": [export]}
    return plan_build(scene_from_dict(raw, "s.toml", "s"), "s.toml", [], [])


def refused(part: dict[str, Any], folder: Path, **export: Any) -> SceneError:
    with pytest.raises(SceneError) as found:
        build(planned(part, **export), folder / "o")
    assert not (folder / "o").exists()
    return found.value


@pytest.mark.parametrize("form", ["stl", "3mf"])
def test_chords_through_a_wall_are_refused_with_the_first_half_that_works(form: str, tmp_path: Path) -> None:
    """At 1 mm they cross, at a half they do not."""
    found = refused(DISC, tmp_path, format=form, tolerance=1.0)
    assert (found.key, found.value, found.code) == ("exports[1].tolerance", 1.0, "chords_cross_wall")
    assert found.numbers["part"] == "p"
    assert found.nearest is not None
    assert (found.nearest.value, found.nearest.side) == (0.5, "at_most")
    assert build(planned(DISC, format=form, tolerance=0.5), tmp_path / "o").well


def test_a_wall_for_which_no_half_works_is_to_be_thickened(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As it is where all of the halves are tried, or the next one is finer than a mesh can tell."""
    for name, value in (("_MOST_HALVINGS", 0), ("_LEAST_TOLERANCE", 0.6)):
        with monkeypatch.context() as patch:
            patch.setattr(f"exporters.production.build.{name}", value)
            found = refused(DISC, tmp_path, format="stl", tolerance=1.0)
            assert (found.key, found.code, found.nearest) == ("exports[1].tolerance", "wall_too_thin_for_mesh", None)
    with monkeypatch.context() as patch:
        patch.setattr("exporters.production.build._LEAST_TOLERANCE", 0.5)
        assert refused(DISC, tmp_path, format="stl", tolerance=1.0).code == "chords_cross_wall"


def test_more_edges_than_a_file_carries_are_refused_with_what_leaves_fewer(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The number of arcs goes by the cube root of the tolerance, that of chords by the square root."""
    gear = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 12, "face_width": 3.0}
    rows: list[tuple[str, dict[str, Any], int, int]] = [
        ("svg", {}, 3, 1), ("svg", {"curves": "lines"}, 2, 1), ("stl", {}, 2, 2), ("3mf", {}, 2, 4)
    ]  # fmt: skip
    for form, more, order, heavier in rows:
        (job,) = planned(gear, format=form, tolerance=0.005, **more).jobs
        with monkeypatch.context() as patch:
            patch.setattr("exporters.formats.registry._MOST_EDGES", 100 * heavier)
            with pytest.raises(ParameterError) as found:
                shape_of(job)
            refusal = found.value
            edges = refusal.numbers["edges"]
            assert edges > 100
            assert (refusal.name, refusal.value, refusal.code) == ("tolerance", 0.005, "too_many_edges")
            assert refusal.nearest is not None
            exact = 0.005 * (edges / 100) ** order
            assert exact <= refusal.nearest.value <= exact + 1e-6
            # as many as may be
            patch.setattr("exporters.formats.registry._MOST_EDGES", edges * heavier)
            shape_of(job)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("form", ["stl", "3mf"])
def test_a_mesh_that_would_take_a_laptop_s_memory_is_refused_before_it_is_made(form: str, tmp_path: Path) -> None:
    """Module 0.01 on a face of 10 mm: a 3MF of 8 million triangles took 11 GB; what is offered is of 3 GB at most."""
    gear = {"kind": "spur_gear", "module": 0.01, "number_of_teeth": 20, "face_width": 10.0, "helix_angle_deg": 20.0}
    found = refused(gear, tmp_path, format=form, tolerance=1e-5)
    assert (found.key, found.code) == ("exports[1].tolerance", "too_many_edges")
    assert found.nearest is not None
    (job,) = planned(gear, format=form, tolerance=found.nearest.value).jobs
    chords = cast("tuple[Approximation, ...]", shape_of(job))
    # two triangles on each piece of each slice
    triangles = 2 * sum(len(a.geometry) * abs(job.part.body(0.0).twist(w)) / a.turn_step
                        for a in chords for w in job.part.body(0.0).walls)  # fmt: skip
    most = {"stl": 4e6, "3mf": 2e6}[form]
    assert 0.85 * most < triangles < most


def test_what_is_offered_for_more_than_digits_hold_is_made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The finest that float32 holds was offered where the file would then need too many edges, and was refused too."""
    gear = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 12, "face_width": 3.0}
    monkeypatch.setattr("exporters.formats.registry._MOST_EDGES", 8000)
    found = refused(gear, tmp_path, format="3mf", tolerance=1e-7)
    assert found.code == "finer_than_mesh_digits"
    assert found.nearest is not None
    (job,) = planned(gear, format="3mf", tolerance=found.nearest.value).jobs
    assert shape_of(job)


BEVEL = {"kind": "bevel_gear", "number_of_teeth": 12, "mate_number_of_teeth": 24, "spiral_angle_deg": 35.0}
FACE = {"kind": "face_gear", "number_of_teeth": 40, "pinion_number_of_teeth": 20}


@pytest.mark.parametrize(
    ("form", "keys"), [pytest.param("stl", BEVEL, marks=pytest.mark.heavy), ("3mf", BEVEL), ("stl", FACE)]
)
def test_what_is_offered_for_too_many_triangles_of_bent_faces_is_made(
    form: str, keys: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It was sought by whole meshes, 11 s and 660 MB for a spiral gear, and where digits held nothing was offered."""
    gear = {**keys, "module": 2.0}
    most = 200_000
    monkeypatch.setattr("exporters.formats.registry._MOST_EDGES", {"stl": 2, "3mf": 4}[form] * most)
    monkeypatch.setattr("parts.solids.face_mesh._MOST_TRIANGLES", most)
    for tolerance, code in ((1e-7, "finer_than_mesh_digits"), (1e-4, "too_many_edges")):
        found = refused(gear, tmp_path, format=form, tolerance=tolerance)
        assert (found.key, found.code) == ("exports[1].tolerance", code)
        assert found.nearest is not None
        (job,) = planned(gear, format=form, tolerance=found.nearest.value).jobs
        (mesh,) = cast("tuple[FaceMesh]", shape_of(job))
        assert mesh.max_error <= found.nearest.value
        assert 0.4 * most < len(mesh.geometry) <= most


def test_fewer_triangles_are_offered_of_walls_that_are_proven(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A barrel cam was offered a mesh that took two minutes: every triangle is proven twice."""
    most, motion = 20_000, [{"move": way, "angle_deg": 180.0, "law": "sine"} for way in ("rise", "return")]
    cam = {"kind": "barrel_cam", "form": "end", "outer_diameter": 40.0, "groove_depth": 5.0, "roller_diameter": 8.0,
           "lift": 6.0, "phases": motion}  # fmt: skip
    monkeypatch.setattr("exporters.formats.registry._MOST_EDGES", 2 * most)
    monkeypatch.setattr("parts.solids.face_mesh._MOST_TRIANGLES", most)
    found = refused(cam, tmp_path, format="stl", tolerance=1e-7).nearest
    assert found is not None
    (mesh,) = cast("tuple[FaceMesh]", shape_of(planned(cam, format="stl", tolerance=found.value).jobs[0]))
    assert 0.1 * most < len(mesh.geometry) <= most / 3


@pytest.mark.sampled(2)
@pytest.mark.parametrize("more", [{}, {"helix_angle_deg": 25.0}, {"helix_angle_deg": 25.0, "bore_diameter": 5.0}])
def test_edges_are_counted_in_every_slice_of_a_twisted_wall(
    more: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Two triangles of the file stand on each of them; those that lie are of the faces."""
    gear = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 12, "face_width": 6.0} | more
    plan = planned(gear, format="stl", tolerance=0.01)
    with monkeypatch.context() as patch:
        patch.setattr("exporters.formats.registry._MOST_EDGES", 1)
        with pytest.raises(ParameterError) as found:
            shape_of(plan.jobs[0])
    assert build(plan, tmp_path / "o").well
    heights = trimesh.load_mesh(tmp_path / "o" / "p.stl").triangles[:, :, 2]
    assert 2 * found.value.numbers["edges"] == np.count_nonzero(np.ptp(heights, axis=1))


def test_what_is_remarked_on_a_file_goes_by_its_part_and_its_edges() -> None:
    """Teeth of module 2 bear 0.1 mm; a plate has none, CAD files are exact; short edges are counted in all periods."""
    gear = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 12, "face_width": 3.0}
    plate = {"kind": "plate", "width": 20.0, "height": 10.0, "face_width": 3.0}
    hub = gear | {"hub": {"diameter": 12.0, "above": 4.0}, "bore_diameter": 5.0}
    for part, export, coarse in (
        (hub, {"format": "svg"}, False), (hub, {"format": "stl"}, False), (hub, {"format": "step"}, False),
        (gear, {"format": "svg", "tolerance": 0.0999}, False), (gear, {"format": "svg", "tolerance": 0.1001}, True),
        (gear, {"format": "stl", "tolerance": 0.1001}, True), (plate, {"format": "svg", "tolerance": 0.5}, False),
        (gear, {"format": "step", "tolerance": 0.1001}, False),
    ):  # fmt: skip
        (job,) = planned(part, **export).jobs
        found = {f.code: f for f in job.remarks({job.shape_key: shape_of(job)})}
        assert ("coarse_tolerance" in found) is coarse, export
        if coarse:
            assert (found["coarse_tolerance"].value, found["coarse_tolerance"].limit) == (
                0.1001, pytest.approx(0.1, rel=1e-12)
            )  # fmt: skip
        assert ("flat_outline" in found) is (part is hub and export["format"] == "svg")
    (job,) = planned(gear, format="svg").jobs
    # a period of three edges, one of them short, four times round; and one that is just long enough
    short, long = 0.99 * LEAST_SEGMENT_MM, 1.01 * LEAST_SEGMENT_MM
    for length, count in ((short, 4), (long, 0)):
        places = np.array([10.0, 10 + 1j * length, 8 + 4j])
        contour = Contour(places, np.zeros(3), 4)
        found = [f for f in job.remarks({job.shape_key: (Approximation(contour, 0.0, "exact", 0.01),)})]
        assert [(f.value, f.limit) for f in found if f.code == "short_edges"] == [(count, LEAST_SEGMENT_MM)] * bool(
            count
        )


def test_holes_in_rows_are_no_thin_walls(tmp_path: Path) -> None:
    """Corners of many holes in one line: their flat triangles were taken for chords through a wall."""
    grid = {"diameter": 4.0, "at": [-96.0, -96.0], "columns": 17, "rows": 17, "pitch": 12.0}
    board = {"kind": "plate", "width": 210.0, "height": 210.0, "face_width": 3.0, "holes": [grid]}
    assert build(planned(board, format="stl", tolerance=0.2), tmp_path / "o").well
    mesh = trimesh.load_mesh(tmp_path / "o" / "p.stl")
    assert mesh.is_watertight
    # Euler: as many handles as holes
    assert mesh.euler_number == 2 - 2 * 17**2
    assert mesh.area_faces.min() > 0
    assert mesh.volume == pytest.approx(3 * (210**2 - 289 * 4 * math.pi), rel=3e-2)
