"""Centrodes: bounds that hold and are sharp, mates by plain sums, curvatures by differences, distances that close."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.base.errors import ParameterError
from geometry.kinematics.centrodes import CentrodePair, FourierRatio, LobedEllipse, RatioCentrode, closing_distance

WAVE = FourierRatio(0.8, (0.2, 0.05), (0.1, -0.03), 2)
CENTRODES = {
    "focal": LobedEllipse(20.0, 0.4),
    "oval": LobedEllipse(20.0, 0.2, 2),
    "slender": LobedEllipse(20.0, 0.97),
    "ratio": RatioCentrode(WAVE, 50.0),
}
ANGLES = np.linspace(0.1, 6.0, 15)
ALL = pytest.mark.parametrize("name", CENTRODES)


def radius_of(name: str, angle: np.ndarray) -> np.ndarray:
    """By the textbook's formulas."""
    if name == "ratio":
        i = 0.8 * (
            1 + 0.2 * np.cos(2 * angle) + 0.05 * np.cos(4 * angle) + 0.1 * np.sin(2 * angle) - 0.03 * np.sin(4 * angle)
        )
        return 50 * i / (1 + i)
    e, n = {"focal": (0.4, 1), "oval": (0.2, 2), "slender": (0.97, 1)}[name]
    return 20 / (1 - e * np.cos(n * angle))


@ALL
def test_radii_and_their_series_are_the_textbook_s(name: str) -> None:
    found = CENTRODES[name].series(ANGLES, 4)
    assert found[0] == pytest.approx(radius_of(name, ANGLES), rel=1e-12)
    # the series tells the radius nearby
    step = 0.004 if name == "slender" else 0.02
    near = sum(x * step**k for k, x in enumerate(found))
    assert near == pytest.approx(radius_of(name, ANGLES + step), rel=2e-6)


@ALL
def test_bounds_of_series_hold_and_are_sharp_on_short_intervals(name: str) -> None:
    centrode = CENTRODES[name]
    for width, most in ((0.3, 1e4), (1e-3, 1.6)):
        low = np.linspace(0, 6, 21)
        bound = centrode.series_bound(3, low, low + width)
        for share in np.linspace(0, 1, 11):
            for exact, found in zip(centrode.series(low + share * width, 3), bound, strict=True):
                assert (np.abs(exact) <= found * (1 + 1e-12)).all()
        if name != "ratio":
            assert (bound[0] <= most * centrode.series(low + width / 2, 0)[0]).all()


def test_bounds_of_a_wave_are_the_sums_of_its_amplitudes() -> None:
    low = np.array([0.0, 1.0])
    bound = WAVE.bound(3, low, low + 0.1)
    for k, found in enumerate(bound):
        sizes = sum(0.8 * abs(a) * (2 * n) ** k for row in (WAVE.cosines, WAVE.sines) for n, a in enumerate(row, 1))
        assert found == pytest.approx([(0.8 if k == 0 else 0.0) + sizes / math.factorial(k)] * 2, rel=1e-12)
    assert (
        RatioCentrode(lambda angle, order: [np.ones_like(angle)], 10.0).series_bound(1, low, low + 1)[0][0] == math.inf
    )


@ALL
def test_a_mate_turns_as_the_sum_of_small_steps_says(name: str) -> None:
    pair = CentrodePair(CENTRODES[name], 50.0 if name == "ratio" else 700.0)
    at = np.linspace(0, 3.0, 60_001)
    radius = radius_of(name, (at[:-1] + at[1:]) / 2)
    ratio = radius / (pair.centre_distance - radius)
    assert pair.ratio(ANGLES) == pytest.approx(
        radius_of(name, ANGLES) / (pair.centre_distance - radius_of(name, ANGLES)), rel=1e-12)  # fmt: skip
    turned = np.cumsum(ratio) * (at[1] - at[0])
    for k in (20_000, 60_000):
        assert float(pair.mate_angle(at[k])) == pytest.approx(turned[k - 1], rel=1e-7)
    place, angle = pair.pose(ANGLES, 2)
    assert np.array_equal(place[0], np.full(len(ANGLES), pair.centre_distance))
    assert angle[0] == pytest.approx(-pair.mate_angle(ANGLES), rel=1e-12)
    assert angle[1] == pytest.approx(-pair.ratio(ANGLES), rel=1e-12)
    step = 1e-5
    slope = -(pair.ratio(ANGLES + step) - pair.ratio(ANGLES - step)) / (2 * step)
    assert 2 * angle[2] == pytest.approx(slope, rel=1e-5, abs=1e-6)


@ALL
def test_curvatures_are_those_of_three_points(name: str) -> None:
    """Of both centrodes, as the circles through three near points of each have them."""
    pair = CentrodePair(CENTRODES[name], 50.0 if name == "ratio" else 700.0)
    step = 2e-4

    def bend(points: np.ndarray) -> np.ndarray:
        a, b, c = points
        sides = np.abs(b - a) * np.abs(c - b) * np.abs(c - a)
        return 2 * (np.conj(b - a) * (c - a)).imag / sides

    first, second = [], []
    for k in (-1, 0, 1):
        at = ANGLES + k * step
        radius = radius_of(name, at)
        first.append(radius * np.exp(1j * at))
        # on its own body the second one's polar angle runs the other way
        second.append((pair.centre_distance - radius) * np.exp(1j * pair.mate_angle(at)))
    own, mate = pair.curvatures(ANGLES)
    assert own == pytest.approx(bend(np.array(first)), rel=2e-4, abs=1e-6)
    assert mate == pytest.approx(bend(np.array(second)), rel=2e-4, abs=1e-6)
    assert pair.is_convex() == (bool((pair.curvatures(np.linspace(0, 7, 2000))[0] > 0).all()),
                                bool((pair.curvatures(np.linspace(0, 7, 2000))[1] > 0).all()))  # fmt: skip


@pytest.mark.parametrize("turns", [0.02, 0.5, 1.0, 3.0])
def test_the_distance_at_which_a_mate_closes(turns: float) -> None:
    centrode = CENTRODES["focal"]
    distance = closing_distance(centrode, turns)
    assert CentrodePair(centrode, distance).mate_turns() == pytest.approx(turns, rel=1e-9)
    if turns == 1.0:
        # equal ellipses stand 2 p / (1 - e^2) apart
        assert distance == pytest.approx(40 / (1 - 0.16), rel=1e-9)


def test_a_mate_that_cannot_turn_so_often_is_refused_with_what_can() -> None:
    for wrong in (0.0, -1.0, math.nan):
        with pytest.raises(ParameterError, match="not_whole_turns"):
            closing_distance(CENTRODES["focal"], wrong)
    with pytest.raises(ParameterError, match="centres_would_meet") as refused:
        closing_distance(CENTRODES["focal"], 1e9)
    assert refused.value.nearest is not None
    works = float(refused.value.nearest.value)
    assert works < 1e9
    assert closing_distance(CENTRODES["focal"], works * (1 - 1e-6)) > 20 / 0.6
    with pytest.raises(ParameterError, match="centre_within_centrode"):
        CentrodePair(CENTRODES["focal"], 20 / 0.6).ratio(0.0)
