"""A roller in its groove: both walls over a turn, the clearance told, placed by hand within it and beyond."""

from __future__ import annotations

import numpy as np
import pytest

from exporters.production.check import scene_checks
from exporters.production.check_lines import check_lines, has_bad_verdict
from geometry.plane.distance import Verdict
from parts.scene.load import make_parts, scene_from_toml
from parts.scene.placing import place
from tests.parts.mates.test_positive_mates import mating
from tests.parts.positive_scenes import GROOVE, GROOVES, ROLLER, scene, without


@pytest.mark.sampled(1)
@pytest.mark.parametrize("kind", GROOVES)
def test_both_walls_of_a_groove_hold_the_roller_and_tell_its_clearance(kind: str) -> None:
    """At the inner wall the outer one is the clearance away, at the outer one it touches, beyond it overlaps."""
    keys = GROOVES[kind] | {"roller_clearance": 0.2}
    pair = mating({"cam": keys, "two": {"kind": "roller", "diameter": 16.0}}, "cam_follower")
    inner, outer = np.array(pair.contact(0.0, 0.0, None).side_gaps)
    assert np.abs(inner).max() < 1e-10
    assert outer == pytest.approx(0.2, abs=1e-10)
    assert pair.quantities()["roller_clearance"] == 0.2
    assert pair.normal_backlash == 0.2
    # off both walls: held, but it rattles
    between = pair.contact(0.1, 0.0, None)
    assert between.verdict is Verdict.CLEAR
    assert min(between.side_gaps[0]) > 0
    assert min(between.side_gaps[1]) > 0
    assert pair.contact(-1e-5, 0.0, None).verdict is Verdict.OVERLAP
    pressed = pair.contact(0.3, 0.0, None)
    assert pressed.verdict is Verdict.OVERLAP
    assert min(pressed.side_gaps[1]) < -0.09
    assert min(pressed.side_gaps[0]) > 0


def test_a_disk_cam_has_no_outer_wall() -> None:
    pair = mating({"cam": ROLLER, "two": {"kind": "roller", "diameter": 16.0}}, "cam_follower")
    assert pair.contact(0.3, 0.0, None).verdict is Verdict.CLEAR
    assert "roller_clearance" not in pair.quantities()


def test_a_roller_placed_by_hand_has_the_play_of_its_groove() -> None:
    """Anywhere from the inner wall to the outer one is right, beyond either is not."""
    parts = {"cam": without(GROOVE, "follower_offset") | {"roller_clearance": 0.2},
             "two": {"kind": "roller", "diameter": 16.0}}  # fmt: skip
    middle = 35.0 + 8.0
    for off, good in ((0.0, True), (0.1, True), (0.2, True), (0.21, False), (-0.01, False)):
        text = scene(parts).partition("[[exports]]")[0]
        text += f"[instances.cam]\n[instances.two]\nat = [0.0, {middle + off}, 0.0]\n"
        text += '[[mates]]\nkind = "cam_follower"\nfirst = "cam"\nsecond = "two"\n'
        made = scene_from_toml(text.encode(), "t", "t")
        found, matings = make_parts(made, "t")
        placing = place(made.instances, made.drives, found, matings, "t")
        checks = scene_checks(placing, found, (), "en", contact=True)
        assert has_bad_verdict(checks) is not good, off
        if good:
            assert "clearance 0.2 mm" in check_lines(checks, "en")[0]
            assert "зазор паза 0.2 мм" in check_lines(checks, "uk")[0]
