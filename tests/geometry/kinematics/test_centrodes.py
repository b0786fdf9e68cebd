"""Noncircular centrodes: closed forms N1 to N3, closure, rolling without sliding, convexity."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.base.errors import ParameterError
from geometry.base.series import FACTORIALS, Series
from geometry.curves.curve import Complex, Real
from geometry.kinematics.centrodes import CentrodePair, RatioCentrode, closing_distance
from tests.oracles.ellipses import FocalEllipse, Oval
from tests.oracles.envelope import GivenMotion, Rotation, instant_centre

ANGLES = np.linspace(-1, 12, 53)


def mate_point(pair: CentrodePair, angle: Real) -> Complex:
    """The second centrode in its own body's frame, which agrees with the fixed axes at phi_1 = 0."""
    return -(pair.centre_distance - pair.first.series(angle, 0)[0]) * np.exp(1j * pair.mate_angle(angle))


@pytest.mark.parametrize(("centrode", "distance", "degrees", "expected"), [
    (FocalEllipse(40.0, 0.5), 80.0, 45.0, 102.35010012),
    (FocalEllipse(40.0, 0.3), 80.0, 45.0, 75.13883911),
    (Oval(1.5, 1.0), 2.5, 30.0, 40.89339465),
])  # fmt: skip
def test_published_positions(centrode: FocalEllipse | Oval, distance: float, degrees: float, expected: float) -> None:
    """Acceptance N1, N2, N3, by the closed form and by the integral of the ratio."""
    at = math.radians(degrees)
    assert math.degrees(float(centrode.mate_angle(at))) == pytest.approx(expected, abs=1e-8)
    assert math.degrees(float(CentrodePair(centrode, distance).mate_angle(at))) == pytest.approx(expected, abs=1e-8)


@pytest.mark.parametrize(("centrode", "distance"), [(FocalEllipse(40.0, 0.6), 80.0), (Oval(30.0, 20.0), 50.0)])
def test_equal_centrodes_close_and_roll(centrode: FocalEllipse | Oval, distance: float) -> None:
    pair = CentrodePair(centrode, distance)
    assert pair.mate_turns() == pytest.approx(1, abs=1e-13)
    assert np.allclose(pair.mate_angle(ANGLES), centrode.mate_angle(ANGLES), atol=1e-12)
    assert closing_distance(centrode, 1.0) == pytest.approx(distance, rel=1e-12)
    # the relative instant centre is the common point of both centrodes
    fixed, moving = instant_centre(Rotation(1.0), GivenMotion(pair.pose), ANGLES)
    assert np.allclose(fixed, centrode.series(ANGLES, 0)[0] * np.exp(-1j * ANGLES), atol=1e-11)
    assert np.allclose(moving, mate_point(pair, ANGLES), atol=1e-11)
    # the mate is the centrode itself, begun at its short radius
    place = mate_point(pair, ANGLES)
    turned = math.pi if isinstance(centrode, FocalEllipse) else math.pi / 2
    assert np.allclose(np.abs(place), centrode.series(np.angle(-place) + turned, 0)[0], atol=1e-11)
    # arcs rolled off are equal: |d point| = sqrt(r^2 + r'^2) d phi
    r = centrode.series(ANGLES, 1)
    h = 1e-5
    mate_speed = np.abs(mate_point(pair, ANGLES + h) - mate_point(pair, ANGLES - h)) / (2 * h)
    assert np.allclose(mate_speed, np.hypot(r[0], r[1]), rtol=1e-8)


def test_series_are_derivatives() -> None:
    for centrode in (FocalEllipse(40.0, 0.6), Oval(30.0, 20.0)):
        h = 1e-4
        for k in (1, 2, 3):
            below = [centrode.series(ANGLES + s * h, 3)[k - 1] * FACTORIALS[k - 1] for s in (-2, -1, 1, 2)]
            slope = (8 * (below[2] - below[1]) - (below[3] - below[0])) / (12 * h)
            assert np.allclose(centrode.series(ANGLES, 3)[k] * FACTORIALS[k], slope, rtol=1e-7, atol=1e-6)


def test_a_ratio_function_makes_its_pair() -> None:
    """i = 1 + 0.3 cos phi closes at one turn; a mate of two turns needs another distance."""

    def ratio(angle: np.ndarray, order: int) -> Series:
        waves = [0.3 * np.cos(angle + k * math.pi / 2) / FACTORIALS[k] for k in range(order + 1)]
        waves[0] = waves[0] + 1
        return waves

    centrode = RatioCentrode(ratio, 90.0)
    pair = CentrodePair(centrode, 90.0)
    assert np.allclose(pair.ratio(ANGLES), 1 + 0.3 * np.cos(ANGLES), rtol=1e-14)
    assert pair.mate_turns() == pytest.approx(1, abs=1e-13)
    assert np.allclose(pair.mate_angle(ANGLES), ANGLES + 0.3 * np.sin(ANGLES), atol=1e-12)
    assert closing_distance(centrode, 1.0) == pytest.approx(90.0, rel=1e-12)
    half = closing_distance(centrode, 0.5)
    assert half > 90
    assert CentrodePair(centrode, half).mate_turns() == pytest.approx(0.5, rel=1e-12)


def polygon_is_convex(points: np.ndarray) -> bool:
    """Brute force: all turns of a dense polygon have one sign."""
    steps = np.diff(np.append(points, points[:2]))
    turns = (np.conj(steps[:-1]) * steps[1:]).imag
    return bool(np.all(turns > 0) or np.all(turns < 0))


@pytest.mark.sampled(1)
@pytest.mark.parametrize("ratio", [1.2, 1.5, 1.9, 2.1, 3.0])
def test_convexity_of_ovals(ratio: float) -> None:
    oval = Oval(20.0 * ratio, 20.0)
    pair = CentrodePair(oval, 20.0 * (1 + ratio))
    t = np.linspace(0, 2 * math.pi, 4001)[:-1]
    shapes = oval.series(t, 0)[0] * np.exp(1j * t), mate_point(pair, t)
    assert pair.is_convex() == tuple(polygon_is_convex(s) for s in shapes)


def test_refusals() -> None:
    with pytest.raises(ParameterError):
        CentrodePair(Oval(30.0, 20.0), 28.0).mate_turns()
    with pytest.raises(ParameterError):
        closing_distance(Oval(30.0, 20.0), 0.0)
