"""Phases, joints, impacts and tables."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.base.errors import ParameterError
from geometry.cams.motion.follower_motion import (
    FollowerMotion,
    Phase,
    PhaseKind,
    dwell,
    follower_motion,
    motion_of_table,
    return_,
    rise,
)
from geometry.laws.named import NAMED_LAWS, constant_acceleration, constant_velocity, polynomial_law, sine

D = math.radians
# between dwells; velocity or acceleration of a law for one end stop suddenly at the other
IMPACT: dict[str, set[str | None]] = {
    "constant_velocity": {"rigid"},
    "constant_acceleration": {"soft"},
    "linearly_decreasing": {"soft"},
    "cosine": {"soft"},
    "double_harmonic": {None, "soft"},
    "half_cycloidal": {None, "rigid"},
    "half_harmonic": {"soft", "rigid"},
}


@pytest.mark.parametrize("name", NAMED_LAWS)
def test_every_law_in_every_phase(name: str) -> None:
    """Ends, continuity with a dwell on both sides, the sign of the motion, and what happens at the joints."""
    law = NAMED_LAWS[name]()
    motion = follower_motion([rise(D(100), 30, law), dwell(D(60)), return_(D(140), 30, law), dwell(D(60))])
    assert float(motion.value(0.0)) == 0
    assert float(motion.value(D(100))) == pytest.approx(30, rel=1e-15)
    assert float(motion.value(D(300))) == pytest.approx(0, abs=1e-13)
    assert motion.lift == pytest.approx(30, rel=1e-14)
    assert [p.kind for p in motion.phases] == [PhaseKind.RISE, PhaseKind.DWELL, PhaseKind.RETURN, PhaseKind.DWELL]
    inner = np.linspace(D(1), D(99), 50)
    assert np.all(motion.value(inner, 1) > 0)
    assert np.allclose(motion.value(inner, 2), 30 / D(100) ** 2 * law.value(inner / D(100), 2), rtol=1e-9, atol=1e-9)
    down = np.linspace(D(161), D(299), 50)
    assert np.allclose(motion.value(down), 30 - 30 * law.value((down - D(160)) / D(140)), atol=1e-12)
    at_ends = [j for j in motion.joints() if any(abs(j.angle - D(x)) < 1e-9 for x in (0, 100, 160, 300))]
    assert {j.impact for j in at_ends} == IMPACT.get(name, {None})
    # values a turn later are the same
    assert np.allclose(motion.value(inner + 2 * math.pi), motion.value(inner), atol=1e-12)


def test_jumps_have_their_size() -> None:
    motion = follower_motion([rise(D(90), 10, constant_velocity()), return_(D(270), 10, constant_acceleration())])
    first, middle = motion.joints()[0], next(j for j in motion.joints() if abs(j.angle - D(90)) < 1e-12)
    assert first.jumps[1] == pytest.approx(10 / D(90))
    assert middle.jumps[1] == pytest.approx(-10 / D(90))
    inner = [j for j in motion.joints() if j.impact == "soft"]
    assert len(inner) == 1
    assert inner[0].jumps[2] == pytest.approx(8 * 10 / D(270) ** 2)
    assert len(motion.impacts()) == 3


def test_matched_velocities_are_no_impact() -> None:
    """A rise that ends at full speed, a uniform stretch, and a run-out: S' goes on, S'' jumps."""
    start = polynomial_law([(0.0, 0, 0.0), (0.0, 1, 0.0), (1.0, 0, 1.0)])
    speed = float(start.value(1.0, 1))
    a = D(40)
    lift = 5.0
    uniform = lift * speed / a * D(30)
    end = start.reversed_in_time()
    motion = follower_motion([rise(a, lift, start), rise(D(30), uniform, constant_velocity()), rise(a, lift, end),
                              return_(D(250), 2 * lift + uniform, sine())])  # fmt: skip
    assert "rigid" not in {j.impact for j in motion.joints()}
    assert "soft" in {j.impact for j in motion.joints()}


def test_many_phases() -> None:
    motion = follower_motion([
        rise(D(40), 10, sine()), dwell(D(20)), rise(D(60), 15, sine()), return_(D(50), 5, sine()), dwell(D(30)),
        return_(D(100), 20, sine()), dwell(D(60)),
    ])  # fmt: skip
    assert motion.lift == pytest.approx(25)
    assert float(motion.value(D(185))) == pytest.approx(20)
    assert motion.extremes(0) == pytest.approx((0, 25), abs=1e-13)
    assert len(motion.moving_pieces(PhaseKind.RISE)) == 2
    assert len(motion.moving_pieces(PhaseKind.RETURN)) == 2
    turned = motion.negated()
    assert np.allclose(turned.value(np.linspace(0, 6, 99)), -motion.value(np.linspace(0, 6, 99)))


@pytest.mark.parametrize("phases", [
    [],
    [rise(D(90), 10, sine()), return_(D(90), 10, sine())],
    [rise(D(180), 10, sine()), return_(D(180), 9, sine())],
    [Phase(D(180), 10.0), return_(D(180), 10, sine())],
    [rise(0.0, 10, sine()), return_(D(360), 10, sine())],
    [rise(float("nan"), 10, sine()), return_(D(360), 10, sine())],
])  # fmt: skip
def test_phases_that_do_not_close_are_refused(phases: list[Phase]) -> None:
    with pytest.raises(ParameterError):
        follower_motion(phases)


def test_the_refusal_tells_what_the_phases_make() -> None:
    with pytest.raises(ParameterError) as caught:
        follower_motion([rise(D(90), 10, sine()), return_(D(90), 10, sine())])
    assert (caught.value.code, caught.value.numbers) == ("phases_not_a_turn", {"whole": 180.0, "off": 180.0})


def test_tables() -> None:
    angles = np.radians([0, 40, 90, 150, 200, 260, 310])
    lifts = [0, 4, 12, 15, 9, 3, 0.5]
    motion = motion_of_table(angles, lifts)
    assert isinstance(motion, FollowerMotion)
    assert np.allclose(motion.value(angles), lifts, atol=1e-13)
    assert all(j.continuity >= 2 for j in motion.joints())
    closed = motion_of_table([*angles, 2 * math.pi], [*lifts, 0])
    t = np.linspace(0, 6.2, 99)
    assert np.allclose(closed.value(t), motion.value(t), atol=1e-13)
    for bad_angles, bad_lifts in (
        ([0, 1], [0, 1]),
        ([0.1, 1, 2], [0, 1, 0]),
        ([0, 2, 1], [0, 1, 0]),
        ([0, 1, 7], [0, 1, 0]),
        ([0, 1, 2 * math.pi], [0, 1, 0.5]),
        ([0, 1, 2], [0, float("nan"), 1]),
        ([0, 1, 2], [0, 1]),
    ):
        with pytest.raises(ParameterError):
            motion_of_table(bad_angles, bad_lifts)
