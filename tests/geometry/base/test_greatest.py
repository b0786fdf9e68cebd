"""The greatest value of a function: against values known by other means, its bound against what passes it."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.base.greatest import greatest
from geometry.base.roots import Real

PLANE = [(-math.pi, math.pi)] * 2


def two_hills(x: Real, y: Real) -> Real:
    """A broad hill of 1 at (-2, -1), a narrow one of 1.05 at (1.7, 2.1); slopes below 1 and 1."""
    broad = 1 - 0.1 * np.hypot(x + 2, y + 1)
    return np.maximum(broad, 1.05 - np.hypot(x - 1.7, y - 2.1))


def test_the_narrow_hill_is_found_and_nothing_is_above_the_bound() -> None:
    found = greatest(two_hills, PLANE, (1, 1))
    assert found.value == pytest.approx(1.05, abs=1e-9)
    assert found.at == pytest.approx((1.7, 2.1), abs=1e-9)
    assert 1.05 <= found.bound <= 1.05 * 1.0011
    # slopes that are passed: the narrow hill stands between the places that were looked at
    assert greatest(two_hills, PLANE, (0.01, 0.01)).bound < 1.05


@pytest.mark.parametrize("shift", [0.0, 0.3, -1.1])
def test_a_ridge_and_what_is_the_same_everywhere(shift: float) -> None:
    found = greatest(lambda x, y: 3 * np.cos(x - y - shift), PLANE, (3, 3), share=1e-2)
    assert found.value == pytest.approx(3, abs=1e-12)
    assert 3 <= found.bound <= 3.03
    assert greatest(lambda x: 0 * x + 7, PLANE[:1], (0,)).bound == 7


def test_a_place_on_an_edge() -> None:
    found = greatest(lambda x: x**3, [(-1, 2)], (12,))
    assert (found.value, found.at) == (pytest.approx(8, abs=1e-9), pytest.approx((2,), abs=1e-9))
