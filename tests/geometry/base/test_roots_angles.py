"""The bracketed root, and the involute function and its inverse, against 60-digit arithmetic."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geometry.base.angles import inverse_involute, involute_function, roll_minus_polar
from geometry.base.errors import ConvergenceError, ParameterError
from geometry.base.roots import bracketed_root
from tests.sampling import examples
from tests.strategies import numbers

MP: Any = mpmath.mp.clone()
MP.dps = 60

HARD_ROOTS: list[tuple[str, Callable[[float], float], float, float, float]] = [
    ("cosine", math.cos, 1.0, 2.0, math.pi / 2),
    ("flat cubic", lambda x: (x - 0.3) ** 3, -1.0, 1.7, 0.3),
    ("ninth power", lambda x: x**9, -1.0, 4.0, 0.0),
    ("steep exponential", lambda x: math.exp(200 * x) - 1, -1.0, 0.5, 0.0),
    ("step", lambda x: -1.0 if x < 0.123 else 1.0, 0.0, 1.0, 0.123),
    ("pole", lambda x: 1 / (x - 0.5) if x != 0.5 else 1e30, 0.0, 1.5, 0.5),
    ("root far from zero", lambda x: x - 1e12, 0.0, 1e13, 1e12),
    ("tiny root", lambda x: x - 1e-12, 0.0, 1.0, 1e-12),
    ("falling", lambda x: 2 - x, 0.0, 5.0, 2.0),
]


@pytest.mark.parametrize(
    ("function", "low", "high", "root"), [c[1:] for c in HARD_ROOTS], ids=[c[0] for c in HARD_ROOTS]
)
def test_root_is_enclosed_to_the_last_places(
    function: Callable[[float], float], low: float, high: float, root: float
) -> None:
    found = bracketed_root(function, low, high)
    a, b = found.bracket
    assert low <= a <= found.value <= b <= high
    assert a <= root <= b or found.residual == 0
    assert found.residual == function(found.value)
    assert found.residual == 0 or b - a <= 4 * np.spacing(max(abs(a), abs(b)))
    if found.residual != 0:
        assert function(a) * function(b) < 0
    assert found.iterations <= 120


def test_a_flat_root_at_an_end_of_the_bracket_is_found() -> None:
    assert bracketed_root(lambda x: x, 0.0, 1.0).value == 0.0
    assert bracketed_root(lambda x: x - 1, 0.0, 1.0).value == 1.0


def test_a_root_between_the_roundings_beside_nothing_is_found() -> None:
    """Where an arc begins on a line: its height jumps over 0, by whole roundings, at an angle of 1e-16."""
    found = bracketed_root(
        lambda t: 82.0314899178318 * math.sin(3.1605271219536704 + t) + 1.5531298436531, 0.0, 0.09004385728455445
    )
    assert 0 < found.value < 1e-15
    assert abs(found.residual) < 1e-14


@examples(200)
@given(
    st.one_of(numbers(-1e3, -1e-3), numbers(1e-3, 1e3)),
    numbers(1e-3, 1e3),
    numbers(1e-3, 1e3),
    st.sampled_from((1, 3, 5)),
)
def test_any_odd_power_is_solved_within_the_bracket(root: float, below: float, above: float, power: int) -> None:
    low, high = root - below, root + above
    found = bracketed_root(lambda x: (x - root) ** power, low, high)
    assert abs(found.value - root) <= 4 * np.spacing(abs(root))


@pytest.mark.parametrize("values", [(1.0, 2.0), (-1.0, -2.0), (math.nan, 1.0), (1.0, math.nan)])
def test_no_change_of_sign_is_refused(values: tuple[float, float]) -> None:
    with pytest.raises(ConvergenceError) as caught:
        bracketed_root(lambda x: values[0] if x == 0 else values[1], 0.0, 1.0)
    assert caught.value.iterations == 0


def test_a_function_that_never_settles_ends_with_an_error() -> None:
    with pytest.raises(ConvergenceError) as caught:
        bracketed_root(lambda x: x - 0.3, 0.0, 1.0, limit=1)
    assert caught.value.iterations == 1


def _exact_inverse(value: float) -> Any:
    """The angle by Newton on tan(a) - a at 60 digits in the unknown tan(a)."""
    target = MP.mpf(value)
    t = MP.cbrt(3 * target) if value < 1 else target + MP.pi / 2
    for _ in range(200):
        # from above on a convex increasing function: monotone
        step = (t - MP.atan(t) - target) * (1 + t * t) / (t * t)
        t -= step
        if abs(step) < MP.mpf(10) ** -55 * t:
            return MP.atan(t)
    raise AssertionError(value)


@pytest.mark.parametrize("value", [*np.geomspace(1e-37, 1e-3, 18), *np.geomspace(2e-3, 50, 60), 1e4, 1e9, 1e15, 1e300])
def test_inverse_involute_from_a_billionth_of_a_second_to_a_right_angle(value: float) -> None:
    exact = _exact_inverse(float(value))
    found = inverse_involute(float(value))
    tangent = math.tan(float(exact))
    # t - atan t cancels to t^3/3 above the series: a unit roundoff of 2 t there is 2/t^2 of the angle
    cancelled = 1.2e-16 * 2 / tangent**2 * float(exact) if tangent >= 0.06 else 0.0
    assert abs(found - exact) <= 4 * np.spacing(float(exact)) + cancelled


def test_inverse_involute_of_nothing_and_of_less() -> None:
    assert inverse_involute(0.0) == 0.0
    for bad in (-1e-300, -1.0, math.nan, math.inf):
        with pytest.raises(ParameterError):
            inverse_involute(bad)


@examples(200)
@given(numbers(1e-4, 1.55))
def test_inverse_undoes_the_involute_function(angle: float) -> None:
    # inv' = tan^2: the conditioning of the way back is inv/(angle tan^2), at most 1/3
    assert inverse_involute(involute_function(angle)) == pytest.approx(angle, rel=4e-15)


@pytest.mark.parametrize("tangent", [*np.geomspace(1e-8, 1e3, 89), 0.06, np.nextafter(0.06, 0), -0.05, -2.0])
def test_roll_minus_polar_relative_to_its_own_size(tangent: float) -> None:
    t = MP.mpf(float(tangent))
    exact = t - MP.atan(t)
    # just above the change from series to difference 0.06 - atan 0.06 loses a factor of t/(t^3/3) = 833
    allowed = 4e-16 if abs(tangent) < 0.06 else 1.2e-16 * (1 + 3 / float(t) ** 2)
    assert abs(roll_minus_polar(tangent) - exact) <= allowed * abs(exact)


def test_roll_minus_polar_is_odd_and_an_infinite_tangent_a_right_angle() -> None:
    assert all(roll_minus_polar(-t) == -roll_minus_polar(t) for t in (0.0, 0.1, 0.3, 3.0))
    assert [roll_minus_polar(t) for t in (math.inf, -math.inf, 1e200, 0.0)] == [math.inf, -math.inf, 1e200, 0]
