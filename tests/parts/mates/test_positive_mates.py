"""Mates of positive drives: contact from both sides over a turn, places at any cam angle, what stands wrong."""

from __future__ import annotations

import math

import numpy as np
import pytest

from exporters.production.check import check_pair
from exporters.production.plan import plan_build
from geometry.plane.distance import Verdict
from parts.base.refusal import SceneError
from parts.mates.positive import ConjugateMating, YokeMating
from parts.scene.load import make_parts, scene_from_toml
from tests.parts.cams.positive.test_yoke_frame import FLAT, ROLLERS, YOKE
from tests.parts.positive_scenes import GROOVE, ROLLER, SWING, Keys, scene

FIRST: dict[str, Keys] = {
    "translating": ROLLER | {"follower_offset": 5.0},
    "against": ROLLER | {"lift": 0.0, "swing_deg": 18.0, "oscillating": SWING},
    "with": ROLLER | {"lift": 0.0, "swing_deg": 18.0, "oscillating": SWING | {"sense": "with"}},
}
SECOND: Keys = {"kind": "conjugate_cam", "of": "cam"}


def text(parts: dict[str, Keys], kind: str, tail: str = "") -> bytes:
    mate = f'[[mates]]\nkind = "{kind}"\nfirst = "cam"\nsecond = "two"\n'
    return (scene(parts) + mate + tail).encode()


def mating(parts: dict[str, Keys], kind: str):
    return make_parts(scene_from_toml(text(parts, kind), "s.toml", "s"), "s.toml")[1][0]


@pytest.mark.parametrize(
    "name",
    ["with", pytest.param("translating", marks=pytest.mark.heavy), pytest.param("against", marks=pytest.mark.heavy)],
)
def test_conjugate_cams_touch_both_rollers(name: str) -> None:
    arm = {"arm_length": 70.0} if "oscillating" in FIRST[name] else {}
    pair = mating({"cam": FIRST[name], "two": SECOND | {"follower_radius": 9.0} | arm}, "conjugate_cams")
    assert isinstance(pair, ConjugateMating)
    found = pair.contact(0.0, 0.0, None)
    assert found.verdict is Verdict.CONTACT
    assert max(abs(found.worst.gap), found.greatest_gap) < 1e-9
    # a tenth of a minute of arc on the shaft: one side or the other is cut by some 0.1 um and more
    for turn in (3e-5, -3e-5):
        turned = pair.contact(turn, 0.0, None)
        assert turned.verdict is Verdict.OVERLAP
        assert turned.worst.gap < -1e-5
    assert check_pair(pair, "en")["verdict"] == "contact"
    assert check_pair(pair, "uk", second_turn=1e-3)["verdict"] == "overlap"


def test_a_conjugate_pair_stands_on_one_axis_turned_alike() -> None:
    tail = "height = 12.0\n[instances.cam]\nat = [5.0, 6.0, 1.0]\nrotation_deg = 70.0\n"
    data = scene_from_toml(text({"cam": FIRST["with"], "two": SECOND}, "conjugate_cams", tail), "s.toml", "s")
    stand = {i.id: i for i in plan_build(data, "s.toml", [], []).placing.instances}
    assert stand["two"].at == pytest.approx((5.0, 6.0, 13.0))
    assert stand["two"].rotation == pytest.approx(math.radians(70))


@pytest.mark.parametrize(
    ("keys", "second", "mate", "wide"),
    [(FIRST["with"], SECOND, "conjugate_cams", 1.0), (ROLLERS, YOKE, "cam_yoke", 1.0), (FLAT, YOKE, "cam_yoke", 0.0)],
)
def test_what_would_stand_within_its_cam_stands_upon_it(keys: Keys, second: Keys, mate: str, wide: float) -> None:
    """Without a height both disks, a cam and a plate with rollers, ran into each other; faces stand about their cam."""
    data = scene_from_toml(text({"cam": keys | {"face_width": 7.0}, "two": second}, mate, ""), "s.toml", "s")
    stand = {i.id: i for i in plan_build(data, "s.toml", [], []).placing.instances}
    assert stand["two"].at[2] == 7.0 * wide


@pytest.mark.sampled(1)
@pytest.mark.parametrize("cam", [FLAT, FLAT | {"follower_offset": 4.0}, ROLLERS])
def test_a_yoke_touches_from_both_sides(cam: Keys) -> None:
    pair = mating({"cam": cam, "two": YOKE}, "cam_yoke")
    assert isinstance(pair, YokeMating)
    found = pair.contact(0.0, 0.0, None)
    assert found.verdict is Verdict.CONTACT
    assert max(abs(found.worst.gap), found.greatest_gap) < 1e-9 * 100
    for out in (1e-4, -1e-4):
        moved = pair.contact(out, 0.0, None)
        assert moved.verdict is Verdict.OVERLAP
        assert moved.worst.gap == pytest.approx(-1e-4, rel=0.3)


def test_play_is_a_gap_on_both_sides() -> None:
    pair = mating({"cam": FLAT, "two": YOKE | {"clearance": 0.2}}, "cam_yoke")
    found = pair.contact(0.0, 0.0, None)
    assert found.verdict is Verdict.CLEAR
    assert found.worst.gap == pytest.approx(0.1, abs=1e-6)
    assert found.greatest_gap == pytest.approx(0.1, abs=1e-6)
    assert pair.contact(0.11, 0.0, None).verdict is Verdict.OVERLAP


@pytest.mark.parametrize(("direction", "rotation"), [(90.0, 0.0), (90.0, 70.0), (0.0, 200.0)])
def test_the_yoke_stands_where_the_cam_has_lifted_it(direction: float, rotation: float) -> None:
    parts = {"cam": FLAT, "two": YOKE}
    tail = f"direction_deg = {direction}\n[instances.cam]\nat = [3.0, 4.0, 0.0]\nrotation_deg = {rotation}\n"
    plan = plan_build(scene_from_toml(text(parts, "cam_yoke", tail), "s.toml", "s"), "s.toml", [], [])
    two = next(i for i in plan.placing.instances if i.id == "two")
    made = plan.parts["cam"].thing
    assert made is not None
    lift = float(made.motion.value(math.radians(rotation - direction + 90)))
    assert two.centre == pytest.approx(3 + 4j + lift * np.exp(1j * math.radians(direction)))
    # the frame's window holds the turned cam
    place = np.exp(1j * two.rotation)
    window = plan.parts["two"].section(0.0).region.holes[0]
    corners = np.array([complex(s.curve.point(s.curve.domain[0])) for s in window.period]) * place + two.centre
    outline = plan.parts["cam"].section(0.0).region.outer
    cam = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 999)) for s in outline.segments()])
    cam = cam * np.exp(1j * math.radians(rotation)) + 3 + 4j
    along = np.exp(-1j * math.radians(direction))
    assert (cam * along).real.max() == pytest.approx((corners * along).real.max(), abs=1e-3)
    assert (cam * along).real.min() == pytest.approx((corners * along).real.min(), abs=1e-3)


def test_another_cam_is_refused() -> None:
    parts = {"cam": FIRST["with"], "other": FIRST["against"], "two": SECOND | {"of": "other"}}
    with pytest.raises(SceneError, match="another cam") as caught:
        mating(parts, "conjugate_cams")
    assert "parts.two.of" in str(caught.value)
    with pytest.raises(SceneError, match="another cam"):
        mating({"cam": FLAT, "other": ROLLERS, "two": YOKE | {"of": "other"}}, "cam_yoke")
    with pytest.raises(SceneError, match="yoke_frame"):
        mating({"cam": FLAT, "two": YOKE}, "conjugate_cams")


def test_a_roller_stands_in_its_groove() -> None:
    keys = GROOVE | {"roller_clearance": 0.2}
    pair = mating({"cam": keys, "two": {"kind": "roller", "diameter": 16.0}}, "cam_follower")
    assert pair.contact(0.0, 0.0, None).verdict is Verdict.CONTACT
    with pytest.raises(SceneError, match="16 mm works"):
        mating({"cam": keys, "two": {"kind": "roller", "diameter": 15.0}}, "cam_follower")
