"""Parallels of trochoids against 50 digits, their bounds, and the closed forms of their limits."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geometry.base.errors import CuspError
from geometry.base.record import replace
from geometry.curves.curve import Curve
from geometry.curves.cycloid import (
    CycloidParallel,
    ShortTrochoid,
    greatest_shortening,
    least_convex_radius,
)
from tests import laws
from tests.sampling import examples
from tests.strategies import angles, numbers, placements

MP: Any = mpmath.mp.clone()
MP.dps = 50

EXAMPLES: dict[str, Curve] = {
    "disc": ShortTrochoid(40.0, 2.5, 12.0, 4.0, -0.3, 0.0, 0.28),
    "path": ShortTrochoid(40.0, 2.5, 12.0, 0.0, 0.0, 0.1, 0.5),
    "outer parallel": ShortTrochoid(40.0, 1.0, 12.0, -3.0, 0.2, -0.2, 0.2),
    "two lobes": ShortTrochoid(40.0, 5.0, 3.0, 15.0, -1.5, 0.0, 1.57),
    "nearly a cusp": ShortTrochoid(40.0, 3.3, 12.0, 1.0, 0.0, 0.02, 0.28),
    "lantern flank": CycloidParallel(30.0, 4.0, 4.0, -0.1, 0.05, 0.4),
    "epicycloid": CycloidParallel(30.0, 1.7, 0.0, 0.4, 0.3, 2.0),
    "hypocycloid": CycloidParallel(-6.0, -3.0, 0.0, 0.2, -0.7, -0.05),
    "parallel of a hypocycloid": CycloidParallel(-6.0, -1.5, 0.8, 0.2, -1.1, -0.02),
    "radius": CycloidParallel(-6.0, -1.0, -0.5, 0.3, -1.4, -0.1),
}
EVERY = pytest.mark.parametrize("curve", EXAMPLES.values(), ids=EXAMPLES.keys())


def pin_centre(curve: Any, t: Any) -> Any:
    """A point of a circle that rolls on another without slipping, by the turns of both bodies at 50 digits."""
    arm, order = MP.mpf(curve.arm), MP.mpf(curve.order)
    far = MP.mpf(curve.radius) if isinstance(curve, ShortTrochoid) else arm * order
    # the line of centres turns by t, the rolling body by (m - 1) t against it
    centre = far * MP.expj(t)
    spoke = arm * MP.expj(t + (order - 1) * t)
    return MP.expj(MP.mpf(curve.angle)) * (centre - spoke)


def exact(curve: Any) -> Any:
    """The parallel at 50 digits, its normal by numerical differentiation of the path."""

    def point(t: Any) -> Any:
        first = MP.diff(lambda x: pin_centre(curve, x), t)
        return pin_centre(curve, t) + 1j * MP.mpf(curve.distance) * first / abs(first)

    return point


@pytest.mark.sampled(2)
@EVERY
def test_points_and_derivatives_against_fifty_digits(curve: Any) -> None:
    point = exact(curve)
    low, high = curve.domain
    for t in np.linspace(low, high, 4)[1:-1].tolist():
        assert abs(complex(curve.point(t)) - complex(point(MP.mpf(t)))) <= 1e-13 * laws.size(curve)
        for order in (1, 2, 3, 4):
            found, right = complex(curve.derivative(t, order)), complex(MP.diff(point, MP.mpf(t), order))
            assert abs(found - right) <= 1e-11 * max(abs(right), curve.derivative_bound(order, t - 1e-4, t + 1e-4))
        first, second = (MP.diff(point, MP.mpf(t), k) for k in (1, 2))
        assert abs(complex(curve.tangent(t)) - complex(first / abs(first))) <= 1e-12
        bend = float((MP.conj(first) * second).imag / abs(first) ** 3)
        assert float(curve.curvature(t)) == pytest.approx(bend, rel=1e-10, abs=1e-12)


def test_beyond_a_cusp_the_tangent_points_where_the_parallel_runs() -> None:
    """Of parallels twice as far off as the path is bent: they run back as fast as the path goes on."""
    for curve, t in ((EXAMPLES["disc"], 0.02), (EXAMPLES["two lobes"], 0.3)):
        assert isinstance(curve, ShortTrochoid)
        back = replace(curve, distance=2 / float(curve.path_curvature(t)))
        point = exact(back)
        first = complex(MP.diff(point, MP.mpf(t), 1))
        assert complex(back.tangent(t)) == pytest.approx(first / abs(first), abs=1e-9)
        assert (first / complex(MP.diff(partial(pin_centre, back), MP.mpf(t)))).real == pytest.approx(-1, rel=1e-9)


@EVERY
def test_bounds_hold_and_close_in(curve: Any) -> None:
    low, high = curve.domain
    for a, b in ((low, high), (low, low + 0.1 * (high - low)), (high - 0.02 * (high - low), high)):
        t = np.linspace(a, b, 401)
        for order in (1, 2, 3, 4):
            largest = float(np.abs(curve.derivative(t, order)).max())
            bound = curve.derivative_bound(order, a, b)
            assert bound >= largest * (1 - 1e-13)
            if isinstance(curve, ShortTrochoid) and b - a < 0.03 * (high - low):
                assert bound <= 1.6 * largest


@examples(40)
@given(st.sampled_from(list(EXAMPLES.values())), placements, numbers(0, 0.45), numbers(0.55, 1))
def test_laws_of_curves(curve: Curve, placement: Any, a: float, b: float) -> None:
    laws.check_reversal(curve)
    laws.check_placement(curve, placement)
    laws.check_trimming(curve, a, b)
    mirrored = curve.mirrored()
    assert np.allclose(mirrored.mirrored().point(curve.domain[0]), curve.point(curve.domain[0]), rtol=1e-14)


@examples(150)
@given(numbers(0.02, 0.98), st.integers(2, 40), numbers(-1.2, 1.2), angles, numbers(-1.0, 0.3), numbers(0.05, 1.0))
def test_cusps_are_seen(short: float, order: int, share: float, angle: float, start: float, length: float) -> None:
    """Offsets of parallels: an error exactly where the samples of 1 - kappa d turn negative."""
    rate = order - 1
    curve = ShortTrochoid(40.0, 40 * short / order, float(order), 0.0, angle, start / rate, (start + length) / rate)
    laws.check_cusp(curve, share * 40 / order)


def test_a_cusp_names_its_parameter() -> None:
    curve = ShortTrochoid(40.0, 2.5, 12.0, 0.0, 0.0, 0.0, math.pi / 11)
    least = least_convex_radius(40.0, 0.75, 12.0)
    assert isinstance(curve.offset(least * (1 - 1e-9)), ShortTrochoid)
    with pytest.raises(CuspError) as caught:
        curve.offset(least * 1.01)
    assert abs(1 - 1.01 * least * float(curve.path_curvature(caught.value.t))) < 1e-9


@pytest.mark.sampled(2)
@pytest.mark.parametrize("order", [2, 3, 4, 6, 12, 30, 101])
@pytest.mark.parametrize("short", ["0.02", "0.2", "0.45", "0.5", "0.75", "0.96", "0.999"])
def test_least_radius_against_fifty_digits(order: int, short: str) -> None:
    """The closed form against the extreme of the curvature from the definition, found at 50 digits."""
    lam, radius = MP.mpf(short), MP.mpf(40)

    def bend(tau: Any) -> Any:
        s = tau / (order - 1)
        first = 1j * radius * (MP.expj(s) - lam * MP.expj(order * s))
        second = -radius * (MP.expj(s) - lam * order * MP.expj(order * s))
        return (MP.conj(first) * second).imag / abs(first) ** 3

    places = [MP.pi * k / 64 for k in range(65)]
    best = max(places, key=bend)
    low, high = max(best - MP.pi / 64, MP.mpf(0)), min(best + MP.pi / 64, MP.pi)
    for _ in range(170):
        a, b = low + (high - low) / 3, high - (high - low) / 3
        low, high = (low, b) if bend(a) > bend(b) else (a, high)
    found = least_convex_radius(40.0, float(short), order)
    assert found == pytest.approx(float(1 / bend((low + high) / 2)), rel=1e-12)
    assert greatest_shortening(40.0, order, found) == pytest.approx(float(short), rel=1e-7)


@pytest.mark.parametrize("order", [3.0, 7.0, 10.0, 40.0])
def test_each_shortening_is_found_again_from_its_least_radius(order: float) -> None:
    """Both closed forms and the place where one takes over from the other, by going there and back."""
    for short in np.linspace(0.01, 0.99, 197):
        found = least_convex_radius(40.0, short, order)
        assert greatest_shortening(40.0, order, found) == pytest.approx(short, abs=1e-6)


def test_vertices_and_inflections_lie_where_they_are_told() -> None:
    curve = ShortTrochoid(40.0, 2.5, 12.0, 4.0, -0.3, -0.1, 0.6)
    t = np.linspace(-0.1, 0.6, 200_001)
    bend = curve.path_curvature(t)
    signs = t[np.flatnonzero(np.diff(np.sign(bend)))]
    turns = t[1:-1][np.flatnonzero(np.diff(np.sign(np.diff(bend))))]
    expected = np.sort(np.concatenate([signs, turns]))
    assert np.allclose(curve.splits(), expected, atol=1e-5)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("order", [2.0, 3.0, 8.0, 40.0])
def test_the_greatest_shortening_leaves_just_the_pin(order: float) -> None:
    """Both closed forms invert the least convex radius, on either side of where they meet."""
    both = (order - 2) / (2 * order - 1)
    meet = least_convex_radius(40.0, max(both, 0.0), order) / 40.0
    # (1 + x)^2 / (1 + m x) falls from 1; the other form ends at a cusp, where nothing is left
    sizes = [meet * (1 - 1e-6), meet / 2, 0.01, *((meet * (1 + 1e-6), (1 + meet) / 2, 0.99) if meet < 0.98 else ())]
    for share in sizes:
        shortening = greatest_shortening(40.0, order, 40.0 * share)
        assert 0 <= shortening < 1
        assert least_convex_radius(40.0, shortening, order) == pytest.approx(40.0 * share, rel=2e-6)
        # by the curvature of the path itself: dense samples over a lobe
        arm = shortening * 40.0 / order
        t = np.linspace(0, 2 * math.pi / (order - 1), 40_001)
        first = 1j * (40.0 * np.exp(1j * t) - order * arm * np.exp(1j * order * t))
        second = -(40.0 * np.exp(1j * t) - order**2 * arm * np.exp(1j * order * t))
        bend = (np.conj(first) * second).imag / np.abs(first) ** 3
        assert 1 / bend.max() == pytest.approx(40.0 * share, rel=1e-3)


@pytest.mark.parametrize(("start", "end"), [(0.05, 0.4), (0.5, 0.9), (1.3, 1.9), (1.2, 1.25), (0.8, 1.6), (1.05, 1.06)])
@pytest.mark.parametrize("distance", [-4.0, 0.0, 4.0, 60.0])
def test_bounds_of_an_epicycloid_s_speed_are_its_extremes(start: float, end: float, distance: float) -> None:
    """m = 4: the sine is greatest at pi / 3, within the span, before or behind it."""
    curve = CycloidParallel(30.0, 4.0, distance, -0.1, 0.05, 2.0)
    most = float(np.abs(curve.derivative(np.linspace(start, end, 20_001))).max())
    assert most <= curve.derivative_bound(1, start, end) * (1 + 1e-12)
    assert curve.derivative_bound(1, start, end) <= most * (1 + 1e-6)
    for order in (2, 3):
        assert float(np.abs(curve.derivative(np.linspace(start, end, 999), order)).max()) <= curve.derivative_bound(
            order, start, end
        )
