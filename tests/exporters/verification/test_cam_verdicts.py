"""Cams at the ends of what can be: a clear refusal or files that verify, never FAILED for a geometric reason."""

from __future__ import annotations

import copy
import math
import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.production.build import build
from exporters.production.plan import plan_build
from geometry.cams.contact.rolled import lift_bound
from geometry.cams.motion.follower_motion import dwell, follower_motion, return_, rise
from geometry.cams.plane.disk import DiskCam, FollowerKind, oscillating_cam, translating_cam
from geometry.laws.named import NAMED_LAWS
from parts.base.refusal import SceneError, sentence
from parts.scene.load import scene_from_dict
from tests.exporters.making import Keys, read_report, run, write_scene
from tests.offered import PHASES, SWING, Raw, cam, scenes, spoiled

KINDS = {"cam", "groove_cam", "conjugate_cam", "wedge_cam", "linkage_cam", "yoke_frame", "barrel_cam"}
FACE: Keys = {"follower": "flat", "follower_radius": None}
ARM: Keys = {"lift": None}


def built(folder: Path, keys: Keys, tolerance: float = 0.005) -> int:
    """The exit code of a build of one cam as a laser DXF."""
    scene = write_scene(folder / "s.toml", {"p": keys}, [{"format": "dxf", "tolerance": tolerance}])
    return run("build", scene, "--out", folder / "out")


def turning(law: str) -> list[Keys]:
    """Phases with one law."""
    return [{**phase, "law": law} if "law" in phase else phase for phase in PHASES]


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "keys",
    [
        cam(follower_offset=47.99999999999),
        cam(**ARM, swing_deg=20.0, oscillating=SWING | {"arm_length": 137.99999999999997}),
        cam(**ARM, swing_deg=20.0, oscillating=SWING, base_circle_radius=149.6075094083478),
        cam(**FACE, **ARM, swing_deg=0.319, base_circle_radius=89.9986, oscillating={"centre_distance": 90.0}),
    ],
    ids=["offset", "folded arm", "stretched arm", "face"],
)
def test_a_follower_whose_reach_ends_within_the_files_error_is_told(tmp_path: Path, keys: Keys) -> None:
    """Whether the cut outline holds it hangs on parts of the tolerance: its lift is not measured, nothing failed."""
    assert built(tmp_path, {k: v for k, v in keys.items() if v is not None}) == 0
    file = read_report(tmp_path / "out" / "s")["files"][0]
    assert "follower_may_slip" in {finding["code"] for finding in file["findings"]}
    assert not {"lift_error", "swing_error_deg"} & set(file["measured"])


def resting(kind: FollowerKind, base: float, **more: Any) -> DiskCam:
    """A cam that rests in its lowest place for a third of the turn from 200 degrees on."""
    law, third = NAMED_LAWS["sine"](), 2 * math.pi / 3
    size = 0.2 if "centre_distance" in more else 20.0
    motion = follower_motion([rise(third, size, law), return_(third, size, law), dwell(third)])
    return (oscillating_cam if "centre_distance" in more else translating_cam)(motion, kind, base, radius=8.0, **more)


@pytest.mark.parametrize("spare", [0.02, 0.011, 0.0101, 0.009, 1e-6])
def test_the_lifts_bound_holds_up_to_the_end_of_the_reach(spare: float) -> None:
    """On a dwell 0.01 mm off the follower's place is known: y^2 = R^2 - e^2, and the law of cosines of an arm."""
    error = 0.01
    slide = resting(FollowerKind.ROLLER, 40.0, follower_offset=48.0 - spare)
    held = [math.sqrt((48.0 + off) ** 2 - (48.0 - spare) ** 2) for off in (0.0, -error) if spare + off > 0]
    swing = resting(FollowerKind.ROLLER, 12.0 + spare, centre_distance=90.0, arm_length=70.0)

    def psi(reach: float) -> float:
        return math.acos((90.0**2 + 70.0**2 - reach**2) / (2 * 90.0 * 70.0))

    swung = [psi(20.0 + spare + off) for off in (0.0, -error) if spare + off > 0]
    for made, places in ((slide, held), (swing, swung)):
        bound = lift_bound(made, 3600, error)[3000]
        if spare <= error:
            assert math.isinf(bound)
        else:
            assert places[0] - places[1] <= bound < 100 * (places[0] - places[1])


@pytest.mark.sampled(1)
@pytest.mark.parametrize("law", ["polynomial_4567", "linearly_decreasing", "sine"])
def test_the_least_cam_of_a_face_has_no_cusp(tmp_path: Path, law: str) -> None:
    """S''(S) just touches its tangent at 45 degrees: a radius of curvature of 0, which no file can hold."""
    keys = cam(**FACE, base_circle_radius=None, lift=38.0, phases=turning(law), least_transmission_angle_deg=45.0)
    keys = {k: v for k, v in keys.items() if v is not None}
    assert built(tmp_path, keys) == 0
    scene = scene_from_dict({"parts": {"p": keys}, "exports": [{"format": "dxf"}]}, "s", "s")
    base = plan_build(scene, "s", [], []).parts["p"].report.circles["base_circle_diameter"] / 2
    turn, rest, shape = math.radians(120), dwell(math.radians(60)), NAMED_LAWS[law]()
    motion = follower_motion([rise(turn, 38.0, shape), rest, return_(turn, 38.0, shape), rest])
    # and the left sides of the jumps
    angle = np.append(np.linspace(0, 2 * math.pi, 200_001), np.nextafter(np.radians([120.0, 180.0, 300.0, 360.0]), 0))
    least = -(motion.value(angle) + motion.value(angle, 2)).min()
    assert base == pytest.approx(least, rel=1e-7)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("keys", "key", "offered"),
    [
        (cam(**FACE, base_circle_radius=20.26, lift=38.0, phases=turning("sine")), "base_circle_radius", True),
        (cam(base_circle_radius=None, least_transmission_angle_deg=89.99999999999999),
         "least_transmission_angle_deg", True),
        ({"follower_radius": 32.39330077534162}, "follower_radius", True),
        (cam(follower="pointed", follower_radius=None, base_circle_radius=0.005), "tolerance", False),
    ],
    ids=["hollow face", "huge", "crest", "point"],
)  # fmt: skip
def test_what_cannot_be_made_is_refused_in_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], keys: Keys, key: str, offered: bool
) -> None:
    if "kind" not in keys:
        # scenes of all kinds are made for tests that run, not as tests are collected
        keys = scenes()["wedge"]["parts"]["p"] | keys
    keys = {k: v for k, v in keys.items() if v is not None}
    assert built(tmp_path, keys) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert f".{key} = " in told
    works = float(told.split(" mm works")[0].split(" degrees works")[0].rpartition(" ")[2])
    assert built(tmp_path, keys | {key: works}) == 0 if offered else built(tmp_path, keys, works) == 0


@pytest.mark.parametrize(
    ("name", "holes"),
    [("wedge", {"holes": {"diameter": 1e-11, "x": 5.0, "y": 7.0}}),
     ("offset roller", {"timing_mark": {"diameter": 1e-11}}),
     ("cam with holes", {"holes": [{"count": 4, "diameter": 1e-11, "pitch_circle_diameter": 50.0}]})],
)  # fmt: skip
def test_a_hole_that_no_double_holds_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str, holes: Keys
) -> None:
    assert built(tmp_path, scenes()[name]["parts"]["p"] | holes) == 2
    assert "diameter = 1e-11" in capsys.readouterr().err


@pytest.mark.sampled(1)
@pytest.mark.parametrize("side", ["below", "above"])
def test_the_follower_is_rolled_between_the_chamfers(side: str, tmp_path: Path) -> None:
    """Before: at half of the width, within a chamfer beyond it, where the file failed its check."""
    keys = scenes()["offset roller"]["parts"]["p"] | {"face_width": 8.0, "face_chamfer": {side: 5.0}}
    scene = write_scene(tmp_path / "s.toml", {"p": keys}, [{"format": "stl"}])
    assert run("build", scene, "--out", tmp_path / "out") == 0


def accepted(raw: Raw, folder: Path) -> str:
    """What is wrong with the files of a scene that was accepted, nothing of one that is refused."""
    try:
        plan = plan_build(scene_from_dict(copy.deepcopy(raw), "s", "s"), "s", [], [])
        made = build(plan, folder)
    except SceneError as refused:
        return "" if "\n" not in sentence(refused, "en") else f"told in lines: {refused}"
    return "; ".join(failure for item in made.written for failure in item.failures)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("turn", range(60))
def test_no_cam_that_is_accepted_fails(turn: int, tmp_path: Path) -> None:
    """Cams of all kinds with one number far off, and just inside the limit that refuses it."""
    choice = random.Random(turn)
    cams = {name: raw for name, raw in scenes().items() if any(p["kind"] in KINDS for p in raw["parts"].values())}
    for number in range(4):
        name = choice.choice(sorted(cams))
        what, wrong = spoiled(bare(cams[name]), choice)
        assert accepted(wrong, tmp_path / str(number)) == "", (name, what)


def bare(raw: Raw) -> Raw:
    """The cams of a scene and what is made of them, as laser DXF."""
    parts = {key: part for key, part in raw["parts"].items() if part["kind"] in KINDS}
    return {"parts": copy.deepcopy(parts), "exports": [{"format": "dxf"}]}
