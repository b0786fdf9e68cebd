"""Mertsalov's flywheel against closed forms, and against the motion that it gives."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.base.errors import ParameterError
from geometry.kinematics.flywheel import Cycle, mertsalov, travelled

ANGLE = np.linspace(0, 2 * math.pi, 3601)
SPEED = 20.0


def pumped(mass: float = 0.0) -> Cycle:
    """A slider on the crank's own axis (x = r cos phi), resisted by 1 kN on its way back, r 0.1 m."""
    work = 1000 * 0.1 * np.where(math.pi > ANGLE, 1 - np.cos(ANGLE), 2.0)
    return Cycle(ANGLE, work, mass * (0.1 * np.sin(ANGLE)) ** 2)


def test_energy_of_half_a_sine_is_known() -> None:
    """M_c = 100 sin phi over half a turn, M_d = 100/pi: extremes where both are equal, and at the end of the half."""
    wheel = mertsalov(pumped(), SPEED, 0.05)
    assert wheel.driving == pytest.approx(100 / math.pi, rel=1e-12)
    equal = math.asin(1 / math.pi)

    def gained(phi: float) -> float:
        return 100 / math.pi * phi - 100 * (1 - math.cos(phi))

    expected = gained(equal) - gained(math.pi - equal)
    assert wheel.swing == pytest.approx(expected, rel=1e-6)
    assert wheel.moment == pytest.approx(expected / (SPEED**2 * 0.05), rel=1e-6)
    assert wheel.gained[-1] == pytest.approx(0, abs=1e-9)
    # 8 kg at r omega = 2 m/s take 16 J of it in the middle of a way
    loaded = mertsalov(pumped(8.0), SPEED, 0.05)
    assert loaded.of_links[[0, 900, 1800, 2700]] == pytest.approx([0, 16, 0, 16], abs=1e-12)
    assert loaded.of_flywheel == pytest.approx(wheel.gained - 16 * np.sin(ANGLE) ** 2, abs=1e-9)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("unevenness", "mass", "near"), [(0.05, 0.0, 2e-3), (0.01, 8.0, 2e-2), (0.04, 8.0, 8e-2)])
def test_the_machine_runs_as_evenly_as_asked(unevenness: float, mass: float, near: float) -> None:
    """The equation of motion with that flywheel: right without masses of links, with them to first order."""
    from scipy.integrate import solve_ivp

    wheel = mertsalov(pumped(mass), SPEED, unevenness)

    def rate(phi: float, square: np.ndarray) -> np.ndarray:
        back = math.sin(phi) if phi % (2 * math.pi) < math.pi else 0.0
        moment = wheel.driving - 100 * max(back, 0.0)
        inertia = wheel.moment + mass * (0.1 * math.sin(phi)) ** 2
        grown = mass * 0.1**2 * math.sin(2 * phi)
        return (2 * moment - grown * square) / inertia

    found = solve_ivp(rate, (0, 2 * math.pi), [SPEED**2], rtol=1e-10, atol=1e-8, max_step=0.04, dense_output=True)
    speeds = np.sqrt(found.sol(np.linspace(0, 2 * math.pi, 4001))[0])
    told = (speeds.max() - speeds.min()) / ((speeds.max() + speeds.min()) / 2)
    assert told == pytest.approx(unevenness, rel=near + 3 * unevenness)
    # a flywheel of half the size is not enough
    assert told < 1.5 * unevenness
    assert mertsalov(pumped(mass), SPEED, 2 * unevenness).moment == pytest.approx(wheel.moment / 2, rel=1e-12)


def test_what_does_no_work_is_refused() -> None:
    with pytest.raises(ParameterError) as found:
        mertsalov(Cycle(ANGLE, 0 * ANGLE, 0 * ANGLE), SPEED, 0.05)
    assert found.value.code == "no_work_over_cycle"


@pytest.mark.parametrize("phase", [0.0, 0.3, 1.0, 2.5003])
def test_a_slider_goes_twice_its_stroke_in_a_turn(phase: float) -> None:
    """Its dead points are among the places."""
    t = np.sort(np.concatenate([np.linspace(0, 2 * math.pi, 721) + phase, [math.pi, 2 * math.pi]]))
    gone = {forward: travelled(np.cos(t), forward=forward) for forward in (True, False)}
    for way in gone.values():
        assert way[-1] == pytest.approx(2.0, abs=1e-14)
        assert (np.diff(way) >= 0).all()
    assert np.abs(gone[True] - gone[False] - (np.cos(t) - math.cos(phase))).max() < 1e-14
