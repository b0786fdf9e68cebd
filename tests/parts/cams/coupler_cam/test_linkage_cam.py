"""Linkage cams as parts: files rolled, spoiled files, refusals fed back, followers and members in their places."""

from __future__ import annotations

import math
import re
import shutil
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest

from exporters.formats.read_dxf import read_dxf
from exporters.production.recheck import recheck
from exporters.verification.judge import probed
from exporters.verification.verdict import Verdict
from geometry.cams.contact.rolled import lift_bound
from geometry.cams.plane.coupler import LinkageCam
from parts.base.texts import words
from parts.cams.probes import ANGLES
from parts.texts.findings import finding_text
from parts.texts.quantities import quantity_name
from tests.exporters.making import read_report, run
from tests.parts.nearest import cured, refused
from tests.parts.positive_scenes import PHASES, Keys, parts_of, scene, without
from tests.sampling import some_of

ROCKER: Keys = {"member": "rocker", "pivot": [91.0, 26.0], "length": 58.0, "start_angle_deg": 167.0}
SLIDER: Keys = {"member": "slider", "start": [25.0, 30.0], "direction_deg": 70.0}
GUIDE: Keys = {"member": "rocker", "pivot": [62.0, 124.0], "length": 68.0}
FOUR: Keys = {"kind": "linkage_cam", "follower": "roller", "follower_radius": 6.0, "driven": ROCKER,
              "coupler_length": 43.0, "guide": GUIDE, "coupler_point": [6.0, 16.0], "swing_deg": 24.0,
              "phases": PHASES, "bore_diameter": 12.0, "timing_mark": {"diameter": 2.5}}  # fmt: skip
SLID: Keys = without(FOUR, "swing_deg") | {
    "driven": SLIDER, "coupler_length": 50.0, "lift": 15.0, "coupler_point": [6.0, 9.0],
    "guide": {"member": "slider", "through": [0.0, 50.0], "direction_deg": 10.0}}  # fmt: skip
FLAT: Keys = without(FOUR, "follower_radius") | {
    "follower": "flat", "follower_direction_deg": -60.0, "coupler_point": [2.0, 11.0], "swing_deg": 12.0}  # fmt: skip
MUSHROOM: Keys = FOUR | {"follower": "mushroom", "follower_radius": 20.0, "follower_direction_deg": -60.0}
POINTED: Keys = without(FOUR, "follower_radius") | {"follower": "pointed"}
ALL = {"rocker": FOUR, "slider": SLID, "flat": FLAT, "mushroom": MUSHROOM, "pointed": POINTED}
FORMATS = ("dxf", 'format = "dxf"\npurpose = "drawing"', "svg", "stl", "3mf")


def cam_of(keys: Keys) -> LinkageCam:
    cam = parts_of({"cam": keys})["cam"].thing
    assert isinstance(cam, LinkageCam)
    return cam


def built(folder: Path, keys: Keys, *formats: str) -> tuple[Path, dict[str, Any]]:
    file = folder / "s.toml"
    file.write_text(scene({"cam": keys}, *formats), encoding="utf-8")
    assert run("build", file, "--out", folder / "o") == 0
    return folder / "o" / "s", read_report(folder / "o" / "s")


@pytest.mark.heavy
@pytest.mark.parametrize("name", ["slider", *(pytest.param(n, marks=pytest.mark.heavy) for n in ("rocker", "flat"))])
def test_every_file_is_rolled_by_the_followers_true_motion(name: str, tmp_path: Path) -> None:
    report = built(tmp_path, ALL[name], *FORMATS)[1]
    cam, swings = cam_of(ALL[name]), name != "slider"
    key, unit = ("swing_error_deg", 180 / math.pi) if swings else ("lift_error", 1.0)
    assert len(report["files"]) == len(FORMATS)
    for file in report["files"]:
        assert file["bound"] == "certified"
        bound = lift_bound(cam, ANGLES, file["max_error"] + 1e-10).max() * unit
        assert 0.1 * file["max_error"] * unit / (100 if swings else 1) <= file["measured"][key] <= bound
    drawing = report["files"][1]["measured"]
    suffix = "_deg" if swings else ""
    assert drawing[f"acceleration_jump{suffix}"] < 0.01 * drawing[f"acceleration_peak{suffix}"]


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["flat", "mushroom", "pointed"])
def test_other_followers_are_rolled_over_a_laser_file(name: str, tmp_path: Path) -> None:
    file = built(tmp_path, ALL[name], 'format = "dxf"\nkerf = 0.2')[1]["files"][0]
    assert 1e-6 < file["measured"]["swing_error_deg"] < 0.05


@pytest.mark.heavy
def test_a_step_file_is_rolled(tmp_path: Path) -> None:
    pytest.importorskip("OCP", exc_type=ImportError)
    step = built(tmp_path, FOUR | {"hub": {"diameter": 30.0, "above": 4.0}}, "step")[1]["files"][0]["measured"]
    assert 1e-9 < step["swing_error_deg"] < 1e-5


@pytest.fixture(scope="module", params=["rocker", "flat"])
def laser(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[Keys, Path, float]:
    """The keys of a cam, its laser file, and the error that it declares."""
    keys = ALL[request.param]
    folder, report = built(tmp_path_factory.mktemp("laser"), keys)
    return keys, folder / "cam.dxf", report["files"][0]["max_error"]


def rolled(file: Path, keys: Keys, declared: float) -> tuple[str, ...]:
    """What is wrong with a file by its follower's lift alone: the distance to the outline is not asked."""
    return probed(read_dxf(file), parts_of({"cam": keys})["cam"], 0.0, declared, Verdict({}, ())).failures


@pytest.mark.sampled(1)
def test_a_spoiled_file_is_found_by_its_lift(laser: tuple[Keys, Path, float], tmp_path: Path) -> None:
    """A vertex at the start, the middle or the end of the outline is moved outwards."""
    keys, good, declared = laser
    assert not rolled(good, keys, declared)
    for place in (0.0, 0.5, 1.0):
        drawing = ezdxf.readfile(good)
        outline = next(e for e in drawing.modelspace() if e.dxf.layer == "CUT_OUTER")
        points = outline.get_points("xyb")
        at = round(place * (len(points) - 1))
        x, y, bulge = points[at]
        share = 1 + 0.05 / math.hypot(x, y)
        points[at] = (x * share, y * share, bulge)
        outline.set_points(points, format="xyb")
        drawing.saveas(tmp_path / "cam.dxf")
        assert any("lift is wrong" in f for f in rolled(tmp_path / "cam.dxf", keys, declared))
    shutil.copy(good.parent / "report.json", tmp_path)
    assert recheck(tmp_path / "cam.dxf").verdict.failures


def test_a_cam_for_another_linkage_is_not_that_cam(laser: tuple[Keys, Path, float]) -> None:
    """The file, rolled with a follower whose place on the coupler is a tenth of a mm away."""
    keys, good, declared = laser
    x, y = keys["coupler_point"]
    moved = [x + 0.1, y] if keys["follower"] == "roller" else [x, y + 0.1]
    assert any("lift is wrong" in f for f in rolled(good, keys | {"coupler_point": moved}, declared))


def test_quantities_are_those_of_dense_samples() -> None:
    part = parts_of({"cam": FOUR})["cam"]
    cam, told = cam_of(FOUR), part.quantities
    t = np.linspace(0, 2 * math.pi, 20001)[:-1]
    rising = cam.motion.value(t, 1) > 0
    assert told["pressure_angle_rise_deg"] == pytest.approx(
        np.degrees(np.abs(cam.pressure_angle(t))[rising].max()), abs=1e-4
    )
    assert told["contact_pressure_angle_deg"] == pytest.approx(
        np.degrees(np.abs(cam.contact_pressure_angle(t)).max()), abs=1e-4
    )
    assert told["coupler_swing_deg"] == pytest.approx(np.degrees(np.ptp(cam.coupler_angle(t))), abs=1e-5)
    convex = cam.curvature_radius(t)
    assert told["least_curvature_radius"] == pytest.approx(convex[convex > 0].min(), rel=1e-5)
    flat = parts_of({"cam": FLAT})["cam"]
    face = cam_of(FLAT)
    along = np.exp(1j * (face.coupler_angle(t) + face.mount.direction - math.pi / 2))
    reach = ((face.contact(t) - face.place(t)) * np.conj(along)).real
    assert flat.quantities["face_from"] == pytest.approx(reach.min(), abs=1e-3)
    assert flat.quantities["least_plate_diameter"] == pytest.approx(2 * np.abs(reach).max(), abs=1e-3)
    assert flat.quantities["greatest_sliding_velocity"] == pytest.approx(
        np.abs(face.sliding_velocity(t)).max(), rel=1e-5
    )
    for name in (*part.quantities, *flat.quantities):
        assert quantity_name(words("uk"), name) != quantity_name(words("en"), name)


# keys, the key that is blamed
WRONG: dict[str, tuple[Keys, str]] = {
    "too short": (FOUR | {"coupler_length": 20.0}, "coupler_length"),
    "too long": (FOUR | {"coupler_length": 190.0}, "coupler_length"),
    "other way": (FOUR | {"driven": ROCKER | {"sense": "counter_clockwise"}}, "driven.sense"),
    "slides in": (SLID | {"driven": SLIDER | {"direction_deg": -110.0, "start": [30.0, 45.0]}}, "driven.direction_deg"),
    "far lift": (SLID | {"lift": 95.0}, "coupler_length"),
    "big roller": (FOUR | {"follower_radius": 60.0}, "follower_radius"),
    "undercut": (FOUR | {"follower_radius": 36.0, "phases": [
        {"move": "rise", "angle_deg": 60.0, "law": "sine"}, {"move": "dwell", "angle_deg": 20.0},
        {"move": "return_", "angle_deg": 60.0, "law": "sine"}, {"move": "dwell", "angle_deg": 220.0}]},
        "follower_radius"),
    "face away": (FLAT | {"follower_direction_deg": 120.0}, "follower_direction_deg"),
    "no direction": (without(FLAT, "follower_direction_deg"), "follower_direction_deg"),
    "table": (without(FOUR, "swing_deg", "phases") | {"coupler_length": 20.0, "motion_table": [
        [0.0, 0.0], [120.0, 24.0], [240.0, 6.0]]}, "coupler_length"),
    "bent face": (FLAT | {"swing_deg": 30.0}, "swing_deg"),
    "narrow plate": (FLAT | {"plate_diameter": 5.0}, "plate_diameter"),
    "wide bore": (without(FOUR, "timing_mark") | {"bore_diameter": 90.0}, "bore_diameter"),
    "lift of a rocker": (FOUR | {"lift": 3.0}, "lift"),
    "swing of a slider": (SLID | {"swing_deg": 3.0}, "swing_deg"),
    "radius of a face": (FLAT | {"follower_radius": 3.0}, "follower_radius"),
}  # fmt: skip


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", WRONG)
def test_a_refusal_names_the_key_and_a_value_that_works_when_it_is_fed_back(name: str) -> None:
    keys, blamed = WRONG[name]
    refusal = refused({"cam": keys})
    assert refusal.key == f"parts.cam.{blamed}"
    cured({"cam": keys}, refusal)


def test_a_slider_has_no_swing_and_no_table_that_swings() -> None:
    """Of other cams a swing belongs to a table of their arm."""
    assert refused({"cam": SLID | {"swing_deg": 20.0}}).code == "stroke_of_another"


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["too short", "other way", "slides in", "big roller", "face away", "bent face"])
def test_a_refusal_speaks_ukrainian(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "s.toml"
    file.write_text('[scene]\nlanguage = "uk"\n' + scene({"cam": WRONG[name][0]}), encoding="utf-8")
    assert run("check", file) == 2
    told = capsys.readouterr().err
    assert f"cam.{WRONG[name][1]} = " in told
    assert re.search("підходить", told)
    reason = told.split(" = ", 1)[1].split(":", 1)[1]
    assert not re.search(r"(?<![\w\"])(the|works|axis|mm)\b", reason), told


def test_what_one_key_does_not_cure_is_said_and_no_more() -> None:
    """No roller that keeps off the axis leaves room for the bore."""
    wide = refused({"cam": FOUR | {"follower_radius": 60.0, "bore_diameter": 300.0}})
    assert (wide.key, wide.code, wide.nearest) == ("parts.cam.follower_radius", "follower_reaches_axis", None)


def test_a_length_far_away_is_found() -> None:
    """A driven rocker with its pivot 9 m away: the coupler that reaches it, by where lengths close at all."""
    parts = {"cam": FOUR | {"driven": ROCKER | {"pivot": [9100.0, 26.0]}}}
    far = refused(parts)
    assert (far.key, far.code) == ("parts.cam.coupler_length", "linkage_comes_apart")
    cured(parts, far)


def test_remarks_speak_both_languages() -> None:
    steep = [PHASES[0] | {"angle_deg": 60.0, "law": "constant_acceleration"}, PHASES[1], PHASES[2],
             PHASES[3] | {"angle_deg": 130.0}]  # fmt: skip
    poor = FOUR | {"phases": steep, "coupler_length": 39.0, "follower_radius": 16.0, "least_curvature_radius": 100.0}
    found = {f.code: f for f in parts_of({"cam": poor})["cam"].findings}
    assert {"swung_soft_impact", "steep_pressure_angle", "linkage_curvature_radius"} <= set(found)
    steepest = parts_of({"cam": poor})["cam"].quantities["pressure_angle_rise_deg"]
    assert found["steep_pressure_angle"].value == pytest.approx(steepest)
    told = parts_of({"cam": FOUR | {"coupler_length": 60.0, "guide": GUIDE | {"length": 115.0}}})["cam"]
    found |= {f.code: f for f in told.findings}
    cam = told.thing
    assert isinstance(cam, LinkageCam)
    lifts = np.linspace(0, math.radians(24), 2001)
    joint, turn = (x[0] for x in cam.mount.linkage.pose([lifts]))
    way = 62 + 124j - joint - 60 * turn
    least = np.degrees(np.arcsin(np.abs((np.conj(turn) * way).imag) / 115).min())
    assert found["small_transmission_angle"].value == pytest.approx(least, abs=1e-6)
    assert not {f.code for f in parts_of({"cam": FOUR})["cam"].findings}
    for finding in found.values():
        assert finding_text("uk", finding) != finding_text("en", finding)


MATES = """
[parts.roller]
kind = "roller"
diameter = {diameter}
[parts.rod]
kind = "plate"
width = 70.0
height = 50.0
[parts.arm]
kind = "follower_arm"
end = "roller"
arm_length = {arm}
[instances.cam]
rotation_deg = {turn}
[instances.roller]
{at}
[[mates]]
kind = "cam_follower"
first = "cam"
second = "roller"
[[mates]]
kind = "linkage_member"
first = "cam"
second = "rod"
member = "coupler"
height = 12.0
[[mates]]
kind = "linkage_member"
first = "cam"
second = "arm"
member = "{member}"
height = 24.0
[checks]
interference = true
"""


def mated(folder: Path, **values: Any) -> Path:
    file = folder / "m.toml"
    given = {"diameter": 12.0, "arm": 58.0, "turn": 50.0, "at": "", "member": "driven"} | values
    file.write_text(scene({"cam": FOUR}) + MATES.format(**given), encoding="utf-8")
    return file


def test_follower_and_members_stand_where_the_linkage_puts_them(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("build", mated(tmp_path), "--out", tmp_path / "o") == 0
    mates = read_report(tmp_path / "o" / "m")["checks"]["mates"]
    assert mates[0]["verdict"] == "contact"
    assert abs(mates[0]["gap"]) < 1e-11
    cam, angle = cam_of(FOUR), math.radians(50.0)
    assert mates[1]["second_rotation_deg"] == pytest.approx(math.degrees(float(cam.coupler_angle(angle))))
    lift = float(cam.motion.value(angle))
    assert math.remainder(mates[2]["second_rotation_deg"] - (167.0 - math.degrees(lift)), 360.0) == pytest.approx(0.0)
    assert run("check", mated(tmp_path)) == 0
    # a roller typed where it stands only checks; one pushed in by 0.01 mm is seen
    place, way = complex(cam.place(angle)), complex(cam.normal(np.float64(angle)))
    for off, code in some_of(((0.0, 0), (-0.01, 1), (0.01, 1)), 2):
        at = place + off * way
        assert run("check", mated(tmp_path, at=f"at = [{at.real:.9f}, {at.imag:.9f}, 0.0]")) == code, off
    capsys.readouterr()


@pytest.mark.parametrize(("values", "key"), [
    ({"diameter": 13.0}, "roller.diameter = 13.0: must be what the cam is made for; 12 mm works"),
    ({"arm": 57.0}, "arm.arm_length = 57.0: must be that of the linkage; 58 mm works"),
    ({"member": "guide"}, "68 mm works"),
])  # fmt: skip
def test_parts_of_another_mechanism_are_refused(
    values: Keys, key: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("check", mated(tmp_path, **values)) == 2
    assert key in capsys.readouterr().err


STEM = """
[parts.stem]
kind = "follower"
end = "{end}"
{keys}
[[mates]]
kind = "cam_follower"
first = "cam"
second = "stem"
"""


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("name", "keys"), [("flat", "plate_diameter = 160.0"), ("pointed", "tip_angle_deg = 20.0"),
                                            ("mushroom", "follower_radius = 20.0\nplate_diameter = 38.0")])  # fmt: skip
def test_stems_turn_with_the_connecting_rod(name: str, keys: str, tmp_path: Path) -> None:
    file = tmp_path / "m.toml"
    spec = ALL[name] | {"follower_direction_deg": -60.0}
    file.write_text(scene({"cam": spec}) + STEM.format(end=name, keys=keys), encoding="utf-8")
    assert run("build", file, "--out", tmp_path / "o", "--no-verify") == 0
    mate = read_report(tmp_path / "o" / "m")["checks"]["mates"][0]
    cam = cam_of(spec)
    assert mate["second_rotation_deg"] == pytest.approx(
        math.degrees(float(cam.coupler_angle(0.0)) + math.radians(-60.0)) - 90
    )
