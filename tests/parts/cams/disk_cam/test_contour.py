"""Cams of given arcs and lines through scenes: what files hold, what the page tells, what is refused."""

from __future__ import annotations

from itertools import groupby
from pathlib import Path
from typing import Any

import pytest

from geometry.cams.plane.shape import cam_shape
from geometry.curves.curve import Curve, Reversed
from geometry.curves.line_arc import Arc, Line
from geometry.plane.profile import Label
from parts.base.part import Part
from parts.scene.load import make_parts, scene_from_dict
from tests.exporters.documents.test_calc import sheet_for
from tests.exporters.making import read_report, run, write_scene
from tests.parts.nearest import cured, refused

ROLLER: dict[str, Any] = {"kind": "cam", "follower": "roller", "follower_radius": 12.5, "base_circle_radius": 30.0,
                          "lift": 17.5}  # fmt: skip
FLAT = {key: value for key, value in ROLLER.items() if key != "follower_radius"} | {"follower": "flat"}
POINTED = FLAT | {"follower": "pointed"}


def part_of(keys: dict[str, Any]) -> Part:
    return make_parts(scene_from_dict({"parts": {"cam": keys}}, "s", "s"), "s")[0]["cam"]


# keys, and the radii of the outline's pieces after the base circle (0: a line), to a hundredth
OUTLINES: dict[str, tuple[dict[str, Any], list[float]]] = {
    "tangent": (ROLLER | {"contour": {"rise_angle_deg": 75.0}}, [0.0, 23.89, 0.0]),
    "tangent, point": (POINTED | {"contour": {"nose_radius": 10.0}}, [0.0, 10.0, 0.0]),
    "tangent, mushroom": (ROLLER | {"follower": "mushroom", "follower_radius": 150.0, "contour": {"nose_radius": 10.0}},
                          [0.0, 10.0, 0.0]),
    "arcs": (FLAT | {"lift": 20.0, "contour": {"rise_angle_deg": 75.0, "nose_radius": 5.0}}, [82.42, 5.0, 82.42]),
    # a face pushes along its normal, wherever its stem is
    "arcs, aside": (FLAT | {"lift": 20.0, "follower_offset": 3.0,
                            "contour": {"rise_angle_deg": 75.0, "nose_radius": 5.0}}, [82.42, 5.0, 82.42]),
    "arcs, roller": (ROLLER | {"contour": {"rise_angle_deg": 75.0, "flank_radius": 100.0}}, [100.0, 16.33, 100.0]),
    "hollow": (ROLLER | {"contour": {"rise_angle_deg": 75.0, "flank_radius": -200.0}}, [200.0, 25.27, 200.0]),
    "eccentric": (FLAT | {"contour": {"nose_radius": 38.75}}, [38.75]),
    "eccentric, roller": (ROLLER | {"contour": {"nose_radius": 38.75}}, [38.75]),
}  # fmt: skip


def curves_of(keys: dict[str, Any]) -> list[Curve]:
    """The outline but for its base circle, as it was first travelled."""
    curves = [s.curve for s in cam_shape(part_of(keys).thing).profile.segments() if s.label is not Label.DWELL]
    return [c.base if isinstance(c, Reversed) else c for c in curves]


@pytest.mark.parametrize("name", OUTLINES)
def test_the_outline_is_of_the_lines_and_arcs_that_were_asked_for(name: str) -> None:
    keys, radii = OUTLINES[name]
    curves = curves_of(keys)
    assert all(isinstance(c, Arc | Line) for c in curves)
    # a line or an arc may stand there in parts
    assert [found for found, _ in groupby(round(c.radius, 2) if isinstance(c, Arc) else 0.0 for c in curves)] == radii


def test_a_curve_that_is_no_arc_stays_one() -> None:
    phases = [{"move": move, "angle_deg": 180.0, "law": "sine"} for move in ("rise", "return_")]
    assert not any(isinstance(c, Arc | Line) for c in curves_of(ROLLER | {"phases": phases}))


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["tangent", "arcs", "hollow", "eccentric, roller"])
def test_files_are_read_back_with_their_follower(name: str, tmp_path: Path) -> None:
    exports = [{"format": "dxf"}, {"format": "stl", "tolerance": 0.05}, {"format": "step"}]
    scene = write_scene(tmp_path / "s.toml", {"cam": OUTLINES[name][0]}, exports)
    assert run("build", scene, "--out", tmp_path / "out") == 0
    files = read_report(tmp_path / "out" / "s")["files"]
    assert len(files) == 3
    assert run("verify", *(tmp_path / "out" / "s" / file["path"] for file in files)) == 0


def test_the_page_tells_the_sizes_that_follow_and_where_the_contact_changes() -> None:
    """By hand: r_n (1 - cos 75) = 30 - 47.5 cos 75, d = 47.5 - r_n, tan theta = d sin 75 / 47.5."""
    page = sheet_for("cam contour_cams part=tangent speed_rpm=600")
    told = {step.name: step.value for section in page.sections for step in section.steps}
    assert told["nose_radius"] == pytest.approx(23.8890317, abs=1e-6)
    assert told["nose_distance"] == pytest.approx(23.6109683, abs=1e-6)
    assert told["nose_change_deg"] == pytest.approx(25.6473229, abs=1e-6)
    arcs = sheet_for("cam contour_cams part=valve")
    assert next(s.value for part in arcs.sections for s in part.steps if s.name == "flank_radius") == pytest.approx(
        82.4221153, abs=1e-6
    )


# keys, the key that is blamed, why, whether it is told what works
WRONG: dict[str, tuple[dict[str, Any], str, str, bool]] = {
    "rise too short": (ROLLER | {"contour": {"rise_angle_deg": 50.0}}, "contour.rise_angle_deg",
                       "no_such_contour", True),
    "nose too large": (ROLLER | {"contour": {"rise_angle_deg": 75.0, "nose_radius": 60.0}}, "contour.nose_radius",
                       "no_such_contour", True),
    "one size too many": (ROLLER | {"contour": {"rise_angle_deg": 75.0, "nose_radius": 10.0, "flank_radius": 90.0}},
                          "contour.flank_radius", "contour_overdetermined", True),
    "too few": (ROLLER | {"contour": {}}, "contour", "contour_too_few", False),
    "no radius": (ROLLER | {"contour": {"rise_angle_deg": 75.0, "flank_radius": 0.0}}, "contour.flank_radius",
                  "no_flank_radius", True),
    "face on a hollow": (FLAT | {"contour": {"rise_angle_deg": 75.0, "flank_radius": -200.0}}, "contour.flank_radius",
                         "face_needs_convex_flank", True),
    "hollow too small": (ROLLER | {"contour": {"rise_angle_deg": 75.0, "flank_radius": -10.0}}, "contour.flank_radius",
                         "roller_above_hollow", True),
    "steep": (ROLLER | {"lift": 60.0, "contour": {"rise_angle_deg": 30.0, "nose_radius": 3.0}},
              "contour.rise_angle_deg", "contour_too_steep", True),
    "flank of an eccentric": (ROLLER | {"contour": {"nose_radius": 38.75, "rise_angle_deg": 60.0}},
                              "contour.rise_angle_deg", "eccentric_has_no_flank", True),
    "phases too": (ROLLER | {"contour": {"rise_angle_deg": 75.0}, "phases": [
        {"move": move, "angle_deg": 180.0, "law": "sine"} for move in ("rise", "return_")]},
        "phases", "either_key", True),
    "offset": (ROLLER | {"contour": {"rise_angle_deg": 75.0}, "follower_offset": 3.0}, "follower_offset",
               "contour_is_centric", True),
    "no base": ({key: value for key, value in ROLLER.items() if key != "base_circle_radius"}
                | {"contour": {"rise_angle_deg": 75.0}}, "base_circle_radius", "contour_needs_base", False),
    "arm": (FLAT | {"lift": 0.0, "contour": {"rise_angle_deg": 75.0, "nose_radius": 10.0},
                    "oscillating": {"centre_distance": 90.0}}, "contour", "contour_needs_slide", False),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_what_makes_no_contour_is_refused_with_what_works(name: str) -> None:
    keys, key, code, told = WRONG[name]
    refusal = refused({"cam": keys})
    assert (refusal.key, refusal.code) == (f"parts.cam.{key}", code)
    assert (refusal.nearest is not None) == told
    if told:
        cured({"cam": keys}, refusal)


def test_a_chamfer_that_leaves_a_point_of_an_arc_is_refused() -> None:
    """The arc of 5 mm about the nose, moved in by as much: its curvature is without limit there."""
    valve: dict[str, Any] = {"contour": {"rise_angle_deg": 75.0, "nose_radius": 5.0}, "face_chamfer": 5.0}
    valve = FLAT | valve | {"lift": 20.0, "face_width": 12.0}
    refusal = refused({"cam": valve})
    assert (refusal.key, refusal.code) == ("parts.cam.face_chamfer", "chamfer_leaves_nothing_of_outline")
    cured({"cam": valve}, refusal)
