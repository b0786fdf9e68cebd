"""Points that have another one near, against all pairs."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geometry.plane.nearby import have_near
from tests.sampling import examples


@given(
    seed=st.integers(0, 2**32 - 1),
    count=st.sampled_from([1, 2, 130, 700]),
    centre=st.sampled_from([0.0, 0.5, -3.0, 10j]),
    distance=st.sampled_from([-1.0, 0.0, 0.02, 0.3, 1.0, 5.0]),
)
@examples(60)
def test_as_all_pairs_say(seed: int, count: int, centre: complex, distance: float) -> None:
    """About the origin, beside it and far from it, on both sides of 180 degrees."""
    choice = np.random.default_rng(seed)
    points, others = (choice.normal(size=(2, n)).T @ [1, 1j] + centre for n in (count, count + 57))
    pairs = np.abs(points[:, None] - others)
    assert have_near(points, others, distance).tolist() == (pairs.min(axis=1) < distance).tolist()


@pytest.mark.parametrize("angle", [0.0, np.pi / 2, np.pi, -np.pi])
def test_one_at_the_edge_of_its_window_is_seen(angle: float) -> None:
    """Where the direction to the other one touches the circle about the point: asin(3 / 5) aside, 4 away."""
    points = np.full(300, 5 * np.exp(1j * angle))
    for side in (1, -1):
        others = np.append(4 * np.exp(1j * (angle + side * np.arcsin(0.6))), -100 * points[:500])
        assert have_near(points, others, 3 * (1 + 1e-12)).all()
        assert not have_near(points, others, 3 * (1 - 1e-12)).any()
