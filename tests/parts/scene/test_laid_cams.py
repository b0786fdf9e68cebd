"""Cams on axes that lie: lifts by their polynomial, built-in cams laid as a whole, solids by their meshes, refusals."""

from __future__ import annotations

import math
import re
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.production.check import scene_checks
from exporters.production.motion import MotionJob
from exporters.production.plan import plan_build
from parts.base.refusal import SceneError
from parts.scene.files import built_in_scenes
from parts.scene.instances import DriveSpec
from parts.scene.load import scene_from_dict
from tests.parts.gears.bevel.test_bevel_differential import differential, frames, meshes, rigid, stood
from tests.parts.gears.bevel.test_bevel_films import svg_pose

BEVEL: dict[str, Any] = {"kind": "bevel_gear", "module": 2.0, "number_of_teeth": 20, "mate_number_of_teeth": 30}
CAM: dict[str, Any] = {"kind": "cam", "follower": "flat", "lift": 12.0, "base_circle_radius": 20.0, "face_width": 5.0,
                       "phases": [{"move": "rise", "angle_deg": 150.0, "law": "polynomial_345"},
                                  {"move": "return_", "angle_deg": 210.0, "law": "polynomial_345"}]}  # fmt: skip
TAPPET: dict[str, Any] = {"kind": "follower", "end": "flat", "stem_width": 8.0, "stem_length": 60.0,
                          "plate_diameter": 40.0, "plate_thickness": 4.0, "face_width": 5.0}  # fmt: skip
POST: dict[str, Any] = {"kind": "plate", "width": 6.0, "height": 6.0, "face_width": 4.0}
FOLLOWS: dict[str, Any] = {"kind": "cam_follower", "first": "cam", "second": "tappet", "direction_deg": 60.0}


def on_a_bevel_shaft(**post: Any) -> dict[str, Any]:
    """A cam on the lying shaft that a bevel pair of ratio 1.5 turns, and a post."""
    return {
        "parts": {"one": BEVEL, "two": {**BEVEL, "number_of_teeth": 30, "mate_number_of_teeth": 20}, "cam": CAM,
                  "tappet": TAPPET, "post": POST},
        "instances": {**{key: {"part": key} for key in ("one", "two", "cam", "tappet")},
                      "post": {"part": "post", **post}},
        "mates": [{"kind": "bevel_pair", "first": "one", "second": "two", "normal_backlash": 0.1},
                  {"kind": "fixed", "first": "two", "second": "cam", "offset": [0.0, 0.0, -12.0]}, FOLLOWS],
        "drives": [{"instance": "one", "turns": 1.5}],
    }  # fmt: skip


def lift(angle: float) -> float:
    """12 (10 u^3 - 15 u^4 + 6 u^5) upwards over 150 degrees, downwards over the rest."""
    turned = math.degrees(angle) % 360.0
    u = turned / 150.0 if turned < 150.0 else (360.0 - turned) / 210.0
    return 12.0 * (10 * u**3 - 15 * u**4 + 6 * u**5)


def test_a_tappet_rises_as_its_lying_cam_has_turned() -> None:
    """At R_b + S along its way, in the cam's plane; meshes of both touch, by manifold3d."""
    placing, parts = stood(on_a_bevel_shaft(at=[0.0, 90.0, 0.0]))
    begin, solids = frames(placing, 0.0), meshes(parts)
    shaft = begin["cam"][:, 2]
    assert abs(shaft[2]) < 1e-12
    # z is laid on -x by a turn about y, after which y stays
    across = [np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0])]
    way = across[0] * math.cos(math.pi / 3) + across[1] * math.sin(math.pi / 3)
    for share in (0.0, 0.1, 0.37, 0.52, 0.81):
        now = frames(placing, 1.5 * share)
        # a whole turn backwards in 1.5 turns of the first gear
        x = begin["cam"][:, 0]
        turned = x * math.cos(2 * math.pi * share) - np.cross(shaft, x) * math.sin(2 * math.pi * share)
        assert np.allclose(now["cam"][:, 0], turned, atol=1e-12)
        angle = math.atan2(turned @ across[1], turned @ across[0]) - math.radians(60.0 - 90.0)
        assert np.allclose(now["tappet"][:, 3], begin["cam"][:, 3] + (20.0 + lift(angle)) * way, atol=1e-9)
        assert np.allclose(now["tappet"][:, 1], way, atol=1e-12)
        placed = [solids[key].transform(now[key]) for key in ("cam", "tappet")]
        assert 0.0 <= placed[0].min_gap(placed[1], 1.0) < 0.02
        assert (placed[0] ^ placed[1]).volume() < 0.5


def test_what_stands_in_the_way_of_a_lying_cams_tappet_is_struck() -> None:
    """A post over the stem, which reaches 20 + 60 mm from the shaft, 10.9 more at first, 12 more at most."""
    found = []
    for far in (91.5, 92.5):
        way = np.array([0.0, math.sin(math.pi / 3), math.cos(math.pi / 3)])
        shaft = next(one for one in stood(on_a_bevel_shaft(at=[0.0, 90.0, 0.0]))[0].instances if one.id == "cam")
        at = (np.array(shaft.at) - [2.5, 0.0, 0.0] + far * way).tolist()
        placing, parts = stood(on_a_bevel_shaft(at=at, axis=way.tolist()))
        checks = scene_checks(placing, parts, [DriveSpec("one", 1.5)], "en", contact=True)
        assert checks["mates"][2]["verdict"] == "contact"
        found.append([{one["first"], one["second"]} for one in checks.get("solids", [])])
    assert found == [[{"tappet", "post"}], []]


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("name", "way"),
    [("laser_cam_model", "turns"), ("print_cam_set", "turns"), ("yoke_cam", "turns"), ("linkage_cam", "turns"),
     ("conjugate_cams", "turns"), ("wedge_cam", "travel")],
)  # fmt: skip
@pytest.mark.parametrize("axis", [[1.0, -2.0, 2.0], [0.0, 0.0, -1.0]], ids=["askew", "turned over"])
def test_built_in_cams_laid_as_a_whole_move_what_they_move_upright(name: str, way: str, axis: list[float]) -> None:
    """Invariance, at a share of a turn of the first, or of the way of a plate."""
    raw = tomllib.loads(built_in_scenes()[name].read_text("utf-8"))
    raw = {key: raw[key] for key in ("parts", "instances", "mates") if key in raw}
    first, run = raw["mates"][0]["first"], {"turns": 0.3, "travel": -15.0}[way]
    own = raw.get("instances", {})
    here = {**own.get(first, {}), "at": [3.0, -4.0, 5.0]}
    one, two = (
        stood({**raw, "instances": {**own, first: {**here, **extra}}, "drives": [{"instance": first, way: run}]})[0]
        for extra in ({}, {"axis": axis})
    )
    still, upright, laid = frames(one, 0.0), frames(one, run), frames(two, run)
    whole = rigid(frames(two, 0.0)[first]) @ np.linalg.inv(rigid(still[first]))
    moved = [key for key, stands in upright.items() if not np.allclose(stands, still[key], atol=1e-9)]
    assert len(moved) > 1
    for key in moved:
        assert np.allclose(rigid(laid[key]), whole @ rigid(upright[key]), atol=1e-9), key
    assert all(condition.met for mate in two.mates for condition in mate.conditions)


def test_what_slides_over_each_other_on_axes_that_lie_is_apart_as_it_is_upright() -> None:
    """The stem on the roller of a wedge cam: its face is that of the plate, which no pose of solids can tell apart."""
    raw = tomllib.loads(built_in_scenes()["wedge_cam"].read_text("utf-8"))
    raw = {key: raw[key] for key in ("parts", "mates")} | {"drives": [{"instance": "wedge", "travel": -15.0}]}
    raw["instances"] = {"wedge": {"part": "wedge", "at": [3.0, -4.0, 5.0], "axis": [1.0, -2.0, 2.0]}}
    placing, parts = stood(raw)
    found = scene_checks(placing, parts, [DriveSpec("wedge", travel=-15.0)], "en", contact=True)
    assert (found["motion"]["pairs"], found["motion"]["uncovered"]) == (2, [])
    assert "solids" not in found


def test_a_cam_upright_on_what_is_turned_over_moves_its_tappet() -> None:
    """It turns clockwise where what carries it turns counter-clockwise about its axis, which points down."""
    raw: dict[str, Any] = {
        "parts": {"cam": CAM, "tappet": TAPPET, "post": POST},
        "instances": {"post": {"part": "post", "at": [0.0, 0.0, 0.0], "axis": [0.0, 0.0, -1.0]},
                      "cam": {"part": "cam"}, "tappet": {"part": "tappet"}},
        "mates": [{"kind": "fixed", "first": "post", "second": "cam", "axis": [0.0, 0.0, -1.0]}, FOLLOWS],
        "drives": [{"instance": "post", "turns": 0.3}],
    }  # fmt: skip
    placing, _ = stood(raw)
    now = frames(placing, 0.3)
    far = 20.0 + lift(-2 * math.pi * 0.3 - math.radians(60.0 - 90.0))
    assert np.allclose(now["tappet"][:, 3], [far * math.cos(math.pi / 3), far * math.sin(math.pi / 3), 0.0], atol=1e-9)


def test_a_cam_that_leaves_its_plane_is_refused() -> None:
    """On a satellite whose axis goes round."""
    raw = differential(("ring", 1.0), ("left", 1.0))
    raw["parts"] |= {"cam": CAM, "tappet": TAPPET}
    raw["instances"] |= {"cam": {"part": "cam"}, "tappet": {"part": "tappet"}}
    raw["mates"] += [{"kind": "fixed", "first": "one", "second": "cam"}, FOLLOWS]
    with pytest.raises(SceneError) as caught:
        stood(raw)
    assert (caught.value.code, caught.value.key) == ("leaves_its_plane", f"mates[{len(raw['mates'])}].first")


def film(raw: dict[str, Any], file: Path) -> tuple[MotionJob, str]:
    """The animated SVG of a scene, and its text."""
    found = scene_from_dict({**raw, "exports": [{"format": "motion"}]}, "s", "s")
    job = next(one for one in plan_build(found, "s", [], ["motion"]).files if isinstance(one, MotionJob))
    job.write(None, file)
    return job, file.read_text("utf-8")


def test_a_lying_cam_is_seen_as_wide_as_it_is_in_each_pose(tmp_path: Path) -> None:
    """Of a cam with a flat follower the reach across is R_b + S on either side, here by the file's own numbers."""
    raw = on_a_bevel_shaft(at=[0.0, 90.0, 0.0])
    job, text = film(raw, tmp_path / "film.svg")
    begin = frames(stood(raw)[0], 0.0)["cam"]
    declared, _ = job.declared(None)
    assert declared <= 0.02
    own = text[text.index('<g id="cam"') :]
    changed = re.search(r'attributeName="d"[^>]*values="([^"]*)"', own)
    assert changed is not None
    forms = [np.array(re.findall(r"(-?[\d.]+),(-?[\d.]+)", one), dtype=float) for one in changed[1].split(";")]
    for k, corners in enumerate(forms):
        # the shaft points along -x: about it the cam turns from z to y, and goes backwards
        angle = math.atan2(begin[1, 0], begin[2, 0]) - 2 * math.pi * job.turns / 1.5 * k / (len(forms) - 1)
        across = [20.0 + lift(angle), -20.0 - lift(angle - math.pi)]
        # y runs downwards
        assert np.allclose([-corners[:, 1].min(), -corners[:, 1].max()], across, atol=declared)
        assert np.ptp(corners[:, 0]) == pytest.approx(5.0, abs=1e-3)
    assert job.verify(tmp_path / "film.svg", declared).failures == ()
    spoilt = tmp_path / "spoilt.svg"
    at = changed[1].split(";")[len(forms) // 3]
    spoilt.write_text(text.replace(at, re.sub(r"(\d)\.(\d+)", r"\1.5\2", at)), "utf-8")
    assert job.verify(spoilt, declared).failures


@pytest.mark.parametrize("direction", [0.0, 40.0, 90.0])
def test_a_rack_that_rises_stays_where_it_is_seen_from_above(direction: float, tmp_path: Path) -> None:
    """Its place in the picture is that of its frame, whatever its height."""
    gear = {"kind": "spur_gear", "module": 1.0, "face_width": 5.0, "number_of_teeth": 20}
    raw: dict[str, Any] = {
        "parts": {"gear": gear, "rack": {**gear, "kind": "rack"}},
        "instances": {"gear": {"part": "gear", "at": [3.0, -4.0, 5.0], "axis": [0.0, 1.0, 0.0]}},
        "mates": [{"kind": "rack_pair", "first": "gear", "second": "rack", "direction_deg": direction}],
        "drives": [{"instance": "gear", "turns": 0.2}],
    }
    job, text = film(raw, tmp_path / "film.svg")
    for share in (0.0, 0.5, 1.0):
        now = frames(stood(raw)[0], 0.2 * share)["rack"]
        place, turn = svg_pose(text, "rack", share)
        assert np.allclose([place.real, place.imag], now[:2, 3], atol=job.declared(None)[0])
        assert turn == pytest.approx(0.0, abs=1e-9)
    assert job.verify(tmp_path / "film.svg", job.declared(None)[0]).failures == ()
