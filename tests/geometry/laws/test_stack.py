"""Pieces of several forms one behind the other are, as arrays, what each of them is alone."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.laws.named import NAMED_LAWS
from geometry.laws.piece import LawPiece, Wave, sign_changes
from geometry.laws.stack import PieceStack

# a rest, a line, a quintic, waves of one and of two frequencies whose phase is not 0, a parabola that turns
PIECES = (
    LawPiece(-1.5, -1.0, (2.0,)),
    LawPiece(-1.0, 0.5, (2.0, 5.0)),
    *(p.placed(0.5, 2.0, 5.0, -3.0) for p in NAMED_LAWS["polynomial_345"]().pieces),
    LawPiece(2.5, 4.0, (2.0, 1.0), (Wave(0.4, 3.0, 0.7),)),
    *(p.placed(4.0, 3.0, 1.4, 6.0) for p in NAMED_LAWS["gutman_13"]().pieces),
    LawPiece(7.0, 8.0, (7.4, 8.4, 7.4)),
)
STACK = PieceStack(PIECES)
AT = np.concatenate([np.linspace(*p.domain, 7)[1:-1] for p in PIECES])


def test_values_are_those_of_the_piece_on_which_they_stand() -> None:
    owner = [next(p for p in PIECES if p.start <= t < p.end) for t in AT]
    for order, found in enumerate(STACK.values(AT, 4)):
        assert found.tolist() == [float(p.value(t, order)) for p, t in zip(owner, AT, strict=True)]
        assert np.array_equal(STACK.at(STACK.index(AT), AT, order), found)
    # at a joint from the right, beyond both ends by the outer pieces
    assert STACK.index(np.array([-9.0, -1.0, 0.5, 9.0])).tolist() == [0, 1, 2, len(PIECES) - 1]
    assert STACK.values(np.array([-1.0, 7.0]), 1)[1].tolist() == [2.0, 2.0]


def test_bounds_are_those_of_the_piece() -> None:
    for share in (1e-3, 0.3, 1.0):
        low = np.array([p.start + (1 - share) * 0.6 * (p.end - p.start) for p in PIECES])
        high = low + share * np.array([p.end - p.start for p in PIECES])
        found = STACK.bounds(4, low, high)
        for k, piece in enumerate(PIECES):
            alone = piece.bounds(4, low[k : k + 1], high[k : k + 1])
            assert [b[k] for b in found] == pytest.approx([float(b[0]) for b in alone], rel=1e-15)


def test_bounds_of_a_wave_are_its_value_and_what_it_gains() -> None:
    """A sin(w t + p): |A| w^k (|sin^(k)| in the middle and w times half the interval), no more than |A| w^k."""
    wave = LawPiece(0.0, 2.0, (0.0,), (Wave(-0.4, 3.0, 0.7),))
    for middle, half in ((0.3, 0.05), (1.1, 0.01), (1.0, 0.9)):
        found = wave.bounds(3, np.array([middle - half]), np.array([middle + half]))
        angle = 3.0 * middle + 0.7
        for k, value in enumerate(found):
            seen = abs((math.sin, math.cos)[k % 2](angle))
            assert float(value[0]) == pytest.approx(0.4 * 3.0**k * min(1.0, seen + 3.0 * half), rel=1e-9)


@pytest.mark.parametrize("order", [0, 1, 2])
def test_extremes_are_the_ends_and_where_the_next_derivative_changes_sign(order: int) -> None:
    index, t = STACK.extremes(order)
    for k, piece in enumerate(PIECES):
        assert t[index == k] == pytest.approx(piece.extremes(order), abs=1e-14)
    assert STACK.extremes(order)[1] is t
    # the parabola turns in its middle, which a sample is
    assert t[index == len(PIECES) - 1].tolist() == ([7.0, 7.5, 8.0] if order == 0 else [7.0, 8.0])
    # the second derivative of a wave changes sign where its angle passes half turns
    if order == 1:
        wanted = [t for t in ((k * math.pi - 0.7) / 3.0 for k in range(9)) if 0 < t < 1.5]
        assert t[index == 3][1:-1] == pytest.approx([2.5 + t for t in wanted], abs=1e-12)


def test_roots_are_found_whichever_way_a_function_goes() -> None:
    t = np.linspace(0.0, 4.0, 9)
    assert sign_changes(lambda x: (x - 0.7) * (x - 2.0) * (x - 3.3), t) == pytest.approx([0.7, 2.0, 3.3], abs=1e-14)
    # one that only touches is none
    assert sign_changes(lambda x: (x - 2.0) ** 2 * (x - 3.2), t) == pytest.approx([3.2], abs=1e-14)
    assert sign_changes(lambda x: 0.0 * x, t).tolist() == []
    index, roots = STACK.sign_changes(lambda k, x: (x - STACK.starts[k] - 0.2) * (x - STACK.starts[k] - 0.4), 9)
    order = np.lexsort((roots, index))
    assert index[order].tolist() == [k for k in range(len(PIECES)) for _ in range(2)]
    assert (roots - STACK.starts[index])[order] == pytest.approx([0.2, 0.4] * len(PIECES), abs=1e-14)
