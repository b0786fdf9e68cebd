"""Keys of cams and yokes that would change nothing, or what nobody meant: refused with what works, or told."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from parts.texts.findings import finding_text
from tests.parts.cams.positive.test_yoke_frame import ROLLERS, YOKE
from tests.parts.nearest import cured, refused
from tests.parts.positive_scenes import ROLLER, Keys, parts_of, without

SWINGING: Keys = without(ROLLER, "lift") | {"swing_deg": 15.0, "base_circle_radius": 40.0}


def test_a_face_offset_is_for_flat_followers() -> None:
    swing: dict[str, Any] = {"centre_distance": 90.0, "arm_length": 80.0}
    parts = {"cam": SWINGING | {"oscillating": swing | {"face_offset": 4.0}}}
    refusal = refused(parts)
    assert (refusal.key, refusal.code) == ("parts.cam.oscillating.face_offset", "for_flat_only")
    cured(parts, refusal)
    flat = SWINGING | {"follower": "flat", "follower_radius": 0.0, "base_circle_radius": 30.0, "swing_deg": 10.0}
    assert parts_of({"cam": flat | {"oscillating": {"centre_distance": 90.0, "face_offset": 4.0}}})["cam"].thing


@pytest.mark.parametrize("offset", [4.0, -4.0, 0.0])
def test_an_offset_under_a_flat_follower_is_told_to_change_nothing(offset: float) -> None:
    keys = ROLLER | {"follower": "flat", "follower_radius": 0.0, "follower_offset": offset}
    part = parts_of({"cam": keys})["cam"]
    found = {f.code: f for f in part.findings}
    assert ("flat_offset" in found) == (offset != 0)
    assert part.thing is not None
    if offset:
        angles = np.linspace(0, 2 * math.pi, 3601)
        reach = part.thing.motion.value(angles, 1) - offset
        assert found["flat_offset"].value == offset
        assert found["flat_offset"].limit == pytest.approx(2 * np.abs(reach).max(), rel=1e-5)
        plain = parts_of({"cam": keys | {"follower_offset": 0.0}})["cam"].thing
        assert plain is not None
        assert np.abs(part.thing.profile_point(angles) - plain.profile_point(angles)).max() < 1e-9
        assert finding_text("uk", found["flat_offset"]) != finding_text("en", found["flat_offset"])


@pytest.mark.parametrize("pin", [16.0, 40.0])
def test_a_yokes_pin_goes_through_its_roller(pin: float) -> None:
    parts = {"cam": ROLLERS, "yoke": YOKE | {"pin_diameter": pin}}
    refusal = refused(parts)
    assert (refusal.key, refusal.code) == ("parts.yoke.pin_diameter", "pin_fills_roller")
    assert 15.0 < cured(parts, refusal)["yoke"]["pin_diameter"] < 16.0


def test_a_pivot_within_the_cam_is_told() -> None:
    near = SWINGING | {"base_circle_radius": 30.0, "oscillating": {"centre_distance": 25.0, "arm_length": 20.0}}
    part = parts_of({"cam": near})["cam"]
    found = next(f for f in part.findings if f.code == "pivot_within_cam")
    outline = part.section(0.0).region.outer
    points = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 2000)) for s in outline.segments()])
    assert found.value == pytest.approx(np.abs(points).max() - 25.0, abs=1e-4)
    assert finding_text("uk", found) != finding_text("en", found)
    far = SWINGING | {"oscillating": {"centre_distance": 90.0, "arm_length": 80.0}}
    assert not any(f.code == "pivot_within_cam" for f in parts_of({"cam": far})["cam"].findings)


KEYWAY: Keys = {"shape": "keyway", "diameter": 58.0}
HEXAGON: Keys = {"shape": "hexagon", "across_flats": 58.0}
PLAIN: Keys = without(ROLLER, "bore_diameter")
GROOVE: Keys = without(PLAIN, "follower") | {"kind": "groove_cam", "groove_depth": 5.0}
ROUND: Keys = {"kind": "roller", "diameter": 60.0}
SECOND: Keys = {"kind": "conjugate_cam", "of": "first", "roller_distance": 130.0}


@pytest.mark.parametrize("bore", [KEYWAY, HEXAGON])
@pytest.mark.parametrize("name", ["cam", "groove", "roller", "second"])
def test_a_bore_that_is_too_large_is_named_as_it_was_typed(name: str, bore: Keys) -> None:
    """Its keyway or its corners reach farther than its size: the size that works does so when it is fed back."""
    key = "diameter" if "diameter" in bore else "across_flats"
    keys = {"cam": PLAIN | {"base_circle_radius": 30.0}, "groove": GROOVE, "roller": ROUND, "second": SECOND}[name]
    typed = {"groove": 99.0, "second": 117.0}.get(name, 58.0)
    parts = {"p": keys} | ({"first": PLAIN} if name == "second" else {})
    wrong = parts | {"p": keys | {"bore": bore | {key: typed}}}
    refusal = refused(wrong)
    assert (refusal.key, refusal.value) == (f"parts.p.bore.{key}", typed)
    assert refusal.code.startswith("no_wall_")
    cured(wrong, refusal)


def test_an_oscillating_cam_has_no_yoke_and_is_told_why() -> None:
    swinging = SWINGING | {"oscillating": {"centre_distance": 90.0, "arm_length": 80.0}}
    refusal = refused({"cam": swinging, "yoke": YOKE})
    assert (refusal.key, refusal.code) == ("parts.yoke.of", "yoke_slides")
