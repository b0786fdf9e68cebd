"""Linkage cams near a dead point or a pressure angle of 90 degrees: refused, and cured with room to spare."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from geometry.cams.contact.rolled import lift_bound
from parts.cams.probes import ANGLES
from tests.parts.cams.coupler_cam.test_linkage_cam import FOUR, GUIDE, ROCKER, built, cam_of
from tests.parts.nearest import cured, refused
from tests.parts.positive_scenes import Keys, without

# what stands in line, or nearly, or whose follower hardly moves: every offer gives files that hold when rolled
BARE = without(FOUR, "bore_diameter", "timing_mark") | {"driven": ROCKER | {"sense": "clockwise"}, "phases": [
    {"move": "rise", "angle_deg": 120.0, "law": "sine"}, {"move": "dwell", "angle_deg": 60.0},
    {"move": "return_", "angle_deg": 120.0, "law": "sine"}, {"move": "dwell", "angle_deg": 60.0}]}  # fmt: skip
SHORT_GUIDE = BARE | {"guide": GUIDE | {"length": 8.0}}
FACE = without(BARE, "follower_radius") | {"follower": "flat"}
SINGULAR: dict[str, Keys] = {
    "short": BARE | {"coupler_length": 1.0},
    "standing": BARE | {"coupler_length": 25.64},
    "long": BARE | {"coupler_length": 500.0},
    "in line": BARE | {"coupler_length": 133.4136},
    "short guide": SHORT_GUIDE,
    "at 90 degrees": SHORT_GUIDE | {"driven": ROCKER | {"sense": "clockwise", "start_angle_deg": 124.7301}},
    "flat": FACE,
    "turned face": FACE | {"follower_direction_deg": 200.0},
}


@pytest.mark.sampled(1)
@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("name", SINGULAR)
def test_near_a_dead_point_an_offer_keeps_away_from_it_and_its_files_hold(name: str, tmp_path: Path) -> None:
    refusal = refused({"cam": SINGULAR[name]})
    if name == "flat":
        # neither the direction of the face alone nor the start of the rocker alone
        assert (refusal.key, refusal.nearest) == ("parts.cam.follower_direction_deg", None)
        return
    keys = cured({"cam": SINGULAR[name]}, refusal)["cam"]
    report = built(tmp_path, keys, "dxf", "stl")[1]
    assert len(report["files"]) == 2
    cam = cam_of(keys)
    assert np.degrees(np.abs(cam.pressure_angle(np.linspace(0, 6.28, 2001))).max()) < 85
    assert cam.mount.linkage.transmission_angle() > math.radians(1.99)


def test_the_bound_of_a_lift_follows_a_rate_that_falls() -> None:
    """The follower pressed onto an outline that is 0.02 mm off: by bisection, and by the linear bound, which fails."""
    cam = cam_of(BARE | {"coupler_length": 26.75})
    mount, low = cam.mount, cam.motion.extremes()[0]

    def away(lift: float) -> float:
        return abs(complex(mount.centre([np.float64(lift)])[0]))

    wanted, inner, outer = away(low) - 0.02, low - 0.02, low
    assert away(inner) < wanted
    for _ in range(60):
        middle = (inner + outer) / 2
        inner, outer = (middle, outer) if away(middle) < wanted else (inner, middle)
    step = 1e-7
    linear = 0.02 / ((away(low + step) - away(low - step)) / (2 * step))
    bound = lift_bound(cam, ANGLES, 0.02)[-1]
    assert linear < low - outer <= bound < 2 * linear


@pytest.mark.sampled(1)
@pytest.mark.parametrize("swing", [0.001, 0.3])
def test_a_small_swing_is_rolled_on_a_mesh_that_is_off_by_more_than_it(swing: float, tmp_path: Path) -> None:
    assert built(tmp_path, BARE | {"swing_deg": swing}, "stl")[1]["files"][0]["measured"]["swing_error_deg"] < 0.02
