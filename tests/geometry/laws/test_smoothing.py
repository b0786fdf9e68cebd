"""Smoothed tables against the condition that a least bent curve meets, by SciPy's own splines."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geometry.base.errors import ParameterError
from geometry.cams.motion.follower_motion import motion_of_table
from geometry.laws.smoothing import smoothed
from tests.sampling import examples

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline

TURN = 2 * math.pi


def closed(places: np.ndarray, values: np.ndarray) -> CubicSpline:
    """The periodic cubic spline through points."""
    from scipy.interpolate import CubicSpline

    return CubicSpline(np.append(places, TURN), np.append(values, values[0]), bc_type="periodic")


def bending(spline: CubicSpline) -> float:
    """The integral of the square of a cubic spline's second derivative, by Simpson's rule, which is exact."""
    second = spline.derivative(2)
    ends, middles = second(spline.x), second((spline.x[1:] + spline.x[:-1]) / 2)
    return float((np.diff(spline.x) * (ends[1:] ** 2 + 4 * middles**2 + ends[:-1] ** 2)).sum() / 6)


@given(
    seed=st.integers(0, 2**32 - 1),
    rows=st.sampled_from([4, 5, 6, 9, 40, 181]),
    tolerance=st.sampled_from([1e-6, 1e-3, 0.05, 0.6]),
    even=st.booleans(),
)
@examples(25)
def test_the_third_derivative_jumps_as_the_rows_are_left(seed: int, rows: int, tolerance: float, even: bool) -> None:
    """Of all curves with this sum of squares none bends less: by variation each jump is the distance of its row over
    the weight of bending, one for all rows; and the farthest row is left by the tolerance.
    """
    choice = np.random.default_rng(seed)
    places = np.arange(rows) * TURN / rows
    if not even:
        places[1:] += choice.uniform(-0.4, 0.4, rows - 1) * TURN / rows
    values = 3 * np.cos(places + 1) + choice.uniform(-1, 1, rows)
    found = smoothed(places, values, TURN, tolerance)
    left = values - found
    assert np.abs(left).max() == pytest.approx(tolerance, rel=1e-6)
    third = 6 * closed(places, found).c[0]
    jump = third - np.roll(third, 1)
    weight = float(jump @ left / (jump @ jump))
    assert weight > 0
    assert np.abs(left - weight * jump).max() < 1e-4 * tolerance + 1e-12
    # and no small change that leaves the rows no farther bends less
    least = bending(closed(places, found))
    for _ in range(3):
        other = found + choice.normal(0, 0.1 * tolerance, rows)
        other = values + (other - values) * np.linalg.norm(left) / np.linalg.norm(other - values)
        assert bending(closed(places, other)) >= least * (1 - 1e-9)


def test_noise_goes_and_the_law_stays() -> None:
    """Rows a degree apart, off by up to 0.005 of a lift of 20: S'' of 17 was off by more than a hundred."""
    places = np.arange(360) * TURN / 360
    law = 10 - 10 * np.cos(places) - 1.5 * np.cos(2 * places)
    rows = law + np.random.default_rng(5).uniform(-0.005, 0.005, 360)
    dense = np.linspace(0, TURN, 7200)
    exact = 10 * np.cos(dense) + 6 * np.cos(2 * dense)
    rough, smooth = (motion_of_table(places.tolist(), rows.tolist(), tolerance) for tolerance in (0.0, 0.01))
    assert np.abs(rough.value(dense, 2) - exact).max() > 50
    assert np.abs(smooth.value(dense, 2) - exact).max() < 1
    assert rough.left_rows is None
    assert smooth.left_rows == pytest.approx(0.01, rel=1e-6)
    assert np.abs(smooth.value(places) - rows).max() == pytest.approx(0.01, rel=1e-6)


def test_a_tolerance_within_which_a_follower_rests_is_refused_from_half_of_the_lift_on() -> None:
    angles, lifts = [0.0, 1.0, 2.0, 4.0], [0.0, 10.0, 4.0, 1.0]
    motion_of_table(angles, lifts, 4.999)
    with pytest.raises(ParameterError) as refusal:
        motion_of_table(angles, lifts, 5.0)
    assert refusal.value.nearest is not None
    assert 4.9999 < float(str(refusal.value.nearest.value)) < 5


def uneven(rows: int, ratio: float, order: str) -> tuple[np.ndarray, np.ndarray]:
    """Rows of which some are nearer to the next one by a ratio, and a lift of 40 with noise."""
    choice = np.random.default_rng(rows)
    steps = np.ones(rows)
    if order == "thirds":
        steps[np.arange(rows) % 3 > 0] = 1 / ratio
    elif order == "one":
        steps[rows // 3] = 1 / ratio
    else:
        steps = ratio ** -choice.uniform(0, 1, rows)
    places = np.cumsum(steps) - steps[0]
    places *= TURN / (places[-1] + steps[0])
    return places, 20 * np.cos(places) + choice.uniform(-0.005, 0.005, rows)


def left_in_60_digits(places: np.ndarray, values: np.ndarray, weight: mp.mpf) -> np.ndarray:
    """By what Reinsch's spline of a weight leaves the values: (R + w Q Q) c = Q y, w Q c, by a dense elimination."""
    n = len(places)
    at = np.array([mp.mpf(float(x)) for x in places] + [mp.mpf(TURN)])
    steps, y = np.diff(at), np.array([mp.mpf(float(v)) for v in values])
    slopes = np.array([[mp.mpf(0)] * n for _ in range(n)])
    plain = slopes.copy()
    for i in range(n):
        k = (i + 1) % n
        slopes[i, i] -= 1 / steps[i]
        slopes[i, k] += 1 / steps[i]
        plain[i, i] += steps[i] / 3
        plain[k, k] += steps[i] / 3
        plain[i, k] += steps[i] / 6
        plain[k, i] += steps[i] / 6
    bent = slopes - np.roll(slopes, 1, axis=0)
    matrix, right = plain + weight * bent.dot(bent), bent.dot(y)
    for i in range(n):
        for k in range(i + 1, n):
            if share := matrix[k, i] / matrix[i, i]:
                matrix[k, i:] -= share * matrix[i, i:]
                right[k] -= share * right[i]
    for i in range(n - 1, -1, -1):
        right[i] = (right[i] - matrix[i, i + 1 :].dot(right[i + 1 :])) / matrix[i, i]
    return np.array(weight * bent.dot(right))


@pytest.mark.sampled(2)
@pytest.mark.parametrize("power", [-8, 0, 2, 5])
@pytest.mark.parametrize(("ratio", "order"), [(1e3, "thirds"), (1e6, "thirds"), (1e4, "one"), (1e7, "any")])
def test_uneven_rows_are_smoothed_to_the_last_digits(ratio: float, order: str, power: int) -> None:
    """Steps a million times unlike, near the rows and nearly at rest: beside the equations themselves in 60 digits."""
    places, values = uneven(31, ratio, order)
    with mp.workdps(60):
        exact = left_in_60_digits(places, values, (TURN / len(places)) ** 3 * mp.mpf(10) ** power).astype(float)
    found = smoothed(places, values, TURN, float(np.abs(exact).max()))
    assert np.abs(values - found - exact).max() < 1e-8 * np.abs(exact).max() + 1e-14


@pytest.mark.sampled(2)
@pytest.mark.parametrize("share", [0.0025, 0.025, 0.22, 0.45, 0.4999])
@pytest.mark.parametrize("order", ["thirds", "one", "any"])
@pytest.mark.parametrize("ratio", [1.0, 1e2, 1e5])
def test_thousands_of_uneven_rows_are_left_by_the_tolerance(ratio: float, order: str, share: float) -> None:
    """2 000 rows, of even steps too, were refused at some tolerances as too uneven."""
    places, values = uneven(2000, ratio, order)
    tolerance = share * float(np.ptp(values))
    left = values - smoothed(places, values, TURN, tolerance)
    assert np.abs(left).max() == pytest.approx(tolerance, rel=2e-9)
    # what is left pulls the curve neither up nor down
    assert abs(left.sum()) < 1e-12 * np.abs(left).sum()


def test_a_tolerance_within_rounding_of_rest_is_rest() -> None:
    places, values = uneven(50, 1.0, "one")
    most = float(np.abs(values - values.mean()).max())
    assert np.ptp(smoothed(places, values, TURN, most * (1 - 1e-15))) == 0
    assert np.ptp(smoothed(places, values, TURN, most * (1 - 1e-7))) > 0


def test_rows_that_are_all_within_the_tolerance_are_level() -> None:
    places = np.array([0.0, 1.0, 2.0, 4.0])
    assert smoothed(places, np.array([1.0, 2.0, 3.0, 2.0]), TURN, 1.0).tolist() == [2.0] * 4
