"""Pieces slid together: as far as they have room, no farther, by distances that shapely measures."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from shapely.affinity import translate

from exporters.boards.slide import slid

CORNER, GAP = 2 + 3j, 1.5


def moved(pieces: list[shapely.Geometry], gap: float = GAP) -> list[shapely.Geometry]:
    return [translate(p, by.real, by.imag) for p, by in zip(pieces, slid(pieces, CORNER, gap).tolist(), strict=True)]


def test_one_alone_goes_into_the_corner_by_steps_that_end() -> None:
    """Eight mm at a time, three times to the left and twice down, to 2 um."""
    (near,) = moved([shapely.box(9.3, 9.7, 14, 15)])
    assert near.bounds[0] == pytest.approx(2, abs=2e-3)
    assert near.bounds[1] == pytest.approx(3, abs=2e-3)
    assert near.bounds[0] >= 2
    assert near.bounds[1] >= 3
    (far,) = moved([shapely.box(100, 100, 105, 107)])
    assert far.bounds == pytest.approx((76, 84, 81, 91), abs=0.01)


def test_two_stop_at_the_gap() -> None:
    """One on the other's right, one above it, and one that goes past below a corner."""
    still = shapely.box(2, 3, 12, 13)
    right, above, past = shapely.box(18, 4, 22, 12), shapely.box(3, 19, 9, 22), shapely.box(18, 14.6, 22, 18)
    for piece, bounds in ((right, (13.5, 3)), (above, (2, 14.5))):
        one, two = moved([still, piece])
        assert one.equals(still)
        assert two.bounds[:2] == pytest.approx(bounds, abs=2e-3)
        assert one.distance(two) >= GAP - 1e-12
    # from 14.6 it may go left over the corner of the other, at 1.5 mm from it, and down no more
    one, two = moved([still, past])
    assert one.distance(two) == pytest.approx(GAP, abs=2e-3)
    assert two.bounds[0] < 12


@pytest.mark.parametrize("seed", range(3))
def test_many_stay_in_the_room_apart_and_have_none_to_their_left(seed: int) -> None:
    """Discs in rows with some slack: each ends at the gap from another or at the side, 2 um to the left is too much."""
    rng = np.random.default_rng(seed)
    at = [complex(12 + 14 * x, 13 + 14 * y) + complex(*rng.uniform(-0.5, 0.5, 2)) for x in range(4) for y in range(3)]
    pieces = [shapely.Point(p.real, p.imag).buffer(5) for p in at]
    made = moved(pieces)
    for k, piece in enumerate(made):
        assert piece.bounds[0] >= 2 - 1e-12
        assert piece.bounds[1] >= 3 - 1e-12
        others = shapely.union_all([other for n, other in enumerate(made) if n != k])
        assert piece.distance(others) >= GAP - 1e-9
        left = translate(piece, -2e-3, 0)
        assert left.bounds[0] < 2 or left.distance(others) < GAP
    assert shapely.union_all(made).bounds[2] < shapely.union_all(pieces).bounds[2] - 5
