"""Crossings and loops of envelopes: a curve with known double points, and undercut cams by another road."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.cams.motion.follower_motion import dwell, follower_motion, return_, rise
from geometry.cams.plane.disk import FollowerKind, translating_cam
from geometry.cams.plane.shape import cam_shape
from geometry.curves.line_arc import Arc, Line
from geometry.laws.named import sine
from tests.geometry.plane.test_envelope import ROLLER_CIRCLE, D, follower_of
from tests.oracles.envelope import Pair, Rotation, envelopes
from tests.oracles.loops import self_crossings, without_loops
from tests.oracles.trochoid import Trochoid


def test_a_prolate_trochoid_crosses_itself_on_its_axis() -> None:
    """Symmetric about the axis through its middle: the crossing lies on it, at opposite parameters."""
    curve = Trochoid(20.0, 6.0, 0.0, -45.0, 45.0)
    found = self_crossings(curve)
    assert len(found) == 1
    assert found[0].first == pytest.approx(-found[0].second, abs=1e-10)
    assert abs(found[0].point.imag) <= 1e-10
    assert abs(complex(curve.point(found[0].first)) - complex(curve.point(found[0].second))) <= 1e-10
    assert self_crossings(Arc(0j, 5.0, 0.0, 2 * math.pi)) == []
    assert self_crossings(Line(0j, 1 + 1j)) == []


@pytest.mark.heavy
@pytest.mark.sampled(1)
@pytest.mark.parametrize("kind", ["flat", "roller"])
def test_the_engine_cuts_the_loops_that_the_cam_cuts(kind: str) -> None:
    """Crossings of the engine's branch are the corners of the trimmed cam; a flat face loses what it parts by."""
    flat = kind == "flat"
    angle = 100 if flat else 60
    motion = follower_motion([rise(D(angle), 25, sine()), dwell(D(30)), return_(D(angle), 25, sine()),
                              dwell(2 * math.pi - D(2 * angle + 30))])  # fmt: skip
    if flat:
        cam = translating_cam(motion, FollowerKind.FLAT, 8.0)
        profile = Line(90 + 0j, -90 + 0j)
    else:
        cam = translating_cam(motion, FollowerKind.ROLLER, 10.0, radius=24.0)
        profile = Arc(0j, 24.0, 0.1, ROLLER_CIRCLE)
    shape = cam_shape(cam)
    assert len(shape.gaps) == 2
    rising = min(shape.gaps, key=lambda g: g.start)
    # the loop may reach into the dwell: the branch over rise and dwell
    found = envelopes(Pair(Rotation(1.0), follower_of(cam), profile), 0.02, D(angle + 29), samples=721)
    t = np.linspace(0.1, D(angle) - 0.1, 33)
    branch = min(found, key=lambda e: float(np.max(np.abs(e.point(t) - cam.profile_point(t)))))
    kept, loops = without_loops(branch)
    assert len(loops) == 1
    assert len(kept) == 2
    assert loops[0].start == pytest.approx(rising.start, abs=1e-9)
    assert loops[0].end == pytest.approx(rising.end, abs=1e-9)
    assert loops[0].corner == pytest.approx(rising.corner, abs=1e-9)
    if flat:
        assert loops[0].clearance == pytest.approx(rising.lost_lift, rel=1e-3)
    else:
        # the normal leans from the guide, so less than the lift is lost along it
        assert 0.3 * rising.lost_lift < loops[0].clearance <= rising.lost_lift
    assert abs(complex(kept[0].point(kept[0].end)) - complex(kept[1].point(kept[1].start))) <= 1e-9


def test_a_whole_branch_is_left_alone() -> None:
    motion = follower_motion([rise(D(120), 20, sine()), return_(D(120), 20, sine()), dwell(D(120))])
    cam = translating_cam(motion, FollowerKind.FLAT, 60.0)
    pair = Pair(Rotation(1.0), follower_of(cam), Line(90 + 0j, -90 + 0j))
    branch = envelopes(pair, 0.05, 2.0)[0]
    kept, loops = without_loops(branch)
    assert kept == [branch]
    assert loops == []
