"""Triangles between four sides: they fill them, their inner points are Coons', strips are merged by middle shares."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise

import numpy as np
import pytest

from geometry.curves.curve import Real
from parts.solids.caps import Triangles
from parts.solids.grids import Grid, grid_between, rows_between
from tests.parts.solids.filling import Three, filled, turned

Map = Callable[[float, float], tuple[float, float]]
# where a side's share lies in the unit square
PLACES: tuple[Map, ...] = (
    lambda x: (x, 0.0), lambda x: (1.0, x), lambda x: (1 - x, 1.0), lambda x: (0.0, 1 - x),
)  # fmt: skip


def flat(s: float, t: float) -> tuple[float, float]:
    return s, t


def bent(s: float, t: float) -> tuple[float, float]:
    """Sides that are bent; linear in s for each t, or in t for each s, summand by summand: as Coons' patch is."""
    return 2 + 3 * s + 0.4 * t * s**2 + 0.3 * (1 - s) * t**3, -1 + 2 * t + 0.5 * (1 - t) * s**2 + 0.2 * s * t**2


def grid(shares: Sequence[Sequence[float]], place: Map = flat) -> Grid:
    """Between sides that have points at shares of theirs; one with a single share is a pole at its start."""
    sides, number = [], 100
    for k, own in enumerate(shares):
        ends = own if len(own) > 1 else (0.0, 1.0)
        uv = np.array([place(*PLACES[k](x)) for x in ends])
        sides.append((np.array(ends), uv, number + np.arange(len(own))))
        number += len(own) - 1
    return Grid(tuple(sides))


def even(count: int) -> list[float]:
    return [k / count for k in range(count + 1)]


UNEVEN = [even(3), [0.0, 0.1, 0.35, 0.4, 1.0], [0.0, 0.55, 1.0], [0.0, 0.2, 0.5, 0.75, 0.8, 1.0]]


def points_of(own: Grid, inner: Real) -> list[complex]:
    return [complex(*x) for x in np.concatenate([own.ring(), inner]).tolist()]


def fills(own: Grid, triangles: Triangles, inner: Real) -> list[Three]:
    count = sum(len(names) - 1 for _, _, names in own.sides)
    return filled(points_of(own, inner), triangles.tolist(), [range(count)])


def test_a_grid_has_the_points_of_its_sides_in_order() -> None:
    own = grid(UNEVEN)
    expected = [PLACES[k](x) for k, shares in enumerate(UNEVEN) for x in shares[:-1]]
    assert own.ring().tolist() == [list(x) for x in expected]
    assert own.names().tolist() == list(range(100, 114))
    assert [x.tolist() for x in own.shares()] == UNEVEN
    assert own.collapsed().tolist() == []


@pytest.mark.parametrize(("pole", "place"), [(0, 0), (1, 3), (2, 7), (3, 0)])
def test_a_pole_has_one_point_at_the_start_of_the_next_side(pole: int, place: int) -> None:
    """Its number is that of the next side's first point; of the last side the ring's first one."""
    shares = [x if k != pole else [0.0] for k, x in enumerate(UNEVEN)]
    own = grid(shares)
    assert own.collapsed().tolist() == [place]
    assert [len(x) for x in own.shares()] == [len(x) for x in shares]
    assert len(own.ring()) == sum(len(x) - 1 for x in shares)


@pytest.mark.parametrize("place", [flat, bent])
@pytest.mark.parametrize(
    ("shares", "cells"),
    [(UNEVEN, (4, 5)), (UNEVEN, (2, 2)), (UNEVEN, (1, 1)), ([even(2)] * 4, (1, 7)), ([even(1)] * 4, (3, 2))],
)
def test_a_grid_fills_what_is_between_its_sides(
    shares: Sequence[Sequence[float]], cells: tuple[int, int], place: Map
) -> None:
    """Its inner points stand as evenly as the cells say, two at least either way, where Coons has them."""
    own = grid(shares, place)
    triangles, inner = grid_between(own, *cells)
    u, v = (max(2, n) for n in cells)
    # of sides that are chords a patch is bilinear between their points: those of the map only at their own shares
    tops = [np.array([[np.interp(x, s, uv[:, c]) for c in (0, 1)] for x in even(n)]) for (s, uv, _), n in zip(
        own.sides, (u, v, u, v), strict=True
    )]  # fmt: skip
    low, right, high, left = tops[0], tops[1], tops[2][::-1], tops[3][::-1]
    corner = [np.array(place(*x)) for x in ((0, 0), (1, 0), (1, 1), (0, 1))]
    expected = []
    for j in range(1, v):
        for k in range(1, u):
            s, t = k / u, j / v
            bilinear = (1 - t) * ((1 - s) * corner[0] + s * corner[1]) + t * ((1 - s) * corner[3] + s * corner[2])
            expected.append((1 - t) * low[k] + t * high[k] + (1 - s) * left[j] + s * right[j] - bilinear)
    assert inner == pytest.approx(np.array(expected), abs=1e-14)
    found = {frozenset(x) for x in fills(own, triangles, inner)}
    first = len(own.ring())
    for j in range(v - 2):
        for k in range(u - 2):
            a, b = first + j * (u - 1) + k, first + (j + 1) * (u - 1) + k
            # diagonals go up with u and v
            assert {frozenset((a, a + 1, b + 1)), frozenset((a, b + 1, b))} <= found


def test_a_grid_meets_a_map_that_coons_reproduces() -> None:
    own = grid([even(4), even(5), even(4), even(5)], bent)
    _, inner = grid_between(own, 4, 5)
    expected = [bent(k / 4, j / 5) for j in range(1, 5) for k in range(1, 4)]
    assert inner == pytest.approx(np.array(expected), abs=1e-14)


def merged(low: Sequence[float], high: Sequence[float]) -> set[tuple[str, int, int]]:
    """Edges of two chains by their middle shares, in order: each with the place that the other chain has come to."""
    middles = [((a + b) / 2, 0, "low") for a, b in pairwise(low)]
    middles += [((a + b) / 2, 1, "high") for a, b in pairwise(high)]
    found, at = set(), {"low": 0, "high": 0}
    for _, _, side in sorted(middles):
        found.add((side, at["low"], at["high"]))
        at[side] += 1
    return found


def strip(triangles: Sequence[Three], low: Sequence[int], high: Sequence[int]) -> set[tuple[str, int, int]]:
    found = set()
    for x in triangles:
        below, above = (sorted(chain.index(k) for k in x if k in chain) for chain in (low, high))
        found.add(("low" if len(below) == 2 else "high", below[0], above[0]))
    return found


# shares of two sides, both from left to right; the last have middles that are one
STRIPS = [
    ([0.0, 0.1, 0.35, 0.4, 1.0], [0.0, 0.55, 1.0]),
    ([0.0, 1.0], [0.0, 0.2, 0.5, 0.7, 1.0]),
    ([0.0, 0.5, 0.8, 1.0], [0.0, 0.5, 0.8, 1.0]),
]


@pytest.mark.parametrize("turn", [0, 1])
@pytest.mark.parametrize(("low", "high"), STRIPS)
def test_a_strip_between_two_sides_is_merged_by_their_middles(low: list[float], high: list[float], turn: int) -> None:
    """One cell across: no point within; of the same middle shares the first side comes first."""
    back = [1 - x for x in high[::-1]]
    own = grid([low, even(1), back, even(1)] if turn == 0 else [even(1), low, even(1), back])
    triangles, inner = grid_between(own, 9, 1) if turn == 0 else grid_between(own, 1, 9)
    assert inner.shape == (0, 2)
    found = fills(own, triangles, inner)
    start, count = turn, len(own.ring())
    one = [start + k for k in range(len(low))]
    two = [(start + len(low) + k) % count for k in range(len(high))][::-1]
    assert strip(found, one, two) == merged(low, high)


def test_a_strip_whose_ends_have_more_points_has_some_within() -> None:
    own = grid([even(3), even(2), even(3), even(1)])
    assert len(grid_between(own, 3, 1)[1]) == 2
    own = grid([even(2), even(3), even(1), even(3)])
    assert len(grid_between(own, 1, 3)[1]) == 2
    own = grid([even(1), even(3), even(2), even(3)])
    assert len(grid_between(own, 1, 3)[1]) == 2
    own = grid([even(3), even(1), even(3), even(2)])
    assert len(grid_between(own, 3, 1)[1]) == 2
    # more cells are asked for than its ends have
    assert len(grid_between(grid([even(3), even(1), even(3), even(1)]), 3, 2)[1]) == 2


@pytest.mark.parametrize("pole", range(4))
def test_a_grid_at_a_pole_fills_what_is_left(pole: int) -> None:
    """One side is a point: the triangles next to it end there."""
    shares = [x if k != pole else [0.0] for k, x in enumerate(UNEVEN)]
    own = grid(shares)
    triangles, inner = grid_between(own, 3, 3)
    place = int(own.collapsed()[0])
    points = points_of(own, inner)
    # of a pole's many places the one nearest to a triangle counts
    low, high = (complex(*own.sides[pole][1][k]) for k in (0, 1))
    doubled = [
        max(turned(*(end if k == place else points[k] for k in x)) for end in (low, high)) for x in triangles.tolist()
    ]
    assert min(doubled) > 0
    sides = [(x[k], x[k - 2]) for x in triangles.tolist() for k in range(3)]
    count = len(own.ring())
    assert set(sides) - {(b, a) for a, b in sides} == {(k, (k + 1) % count) for k in range(count)}
    assert {k for x in triangles.tolist() for k in x} == set(range(len(points)))


ROWS = [[0.2, 0.5, 0.8], [0.22, 0.4, 0.6, 0.85], [0.26, 0.82]]


@pytest.mark.parametrize("rising", [True, False])
def test_rows_of_their_own_fill_the_square(rising: bool) -> None:
    own, t = grid(UNEVEN), np.array([0.2, 0.6, 0.7])
    triangles, inner = rows_between(own, t, [np.array(row) for row in ROWS], rising=rising)
    assert inner.tolist() == [[u, v] for row, v in zip(ROWS, t.tolist(), strict=True) for u in row]
    found = fills(own, triangles, inner)
    first = len(own.ring())
    one, two, three = (range(first + a, first + b) for a, b in ((0, 3), (3, 7), (7, 9)))
    chains = [
        # the lower side and rows above each other, the upper one
        (range(4), one, UNEVEN[0], ROWS[0]),
        (one, two, ROWS[0], ROWS[1]),
        (two, three, ROWS[1], ROWS[2]),
        ([7, 8, 9], three[::-1], UNEVEN[2], [1 - x for x in ROWS[2][::-1]]),
        # both sides, and the ends of the rows next to them
        ([3, 4, 5, 6, 7], [x[-1] for x in (one, two, three)], UNEVEN[1], t.tolist()),
        ([9, 10, 11, 12, 13, 0], [x[0] for x in (three, two, one)], UNEVEN[3], (1 - t[::-1]).tolist()),
    ]
    count = 0
    for low, high, below, above in chains:
        mine = [x for x in found if {*low, *high} >= set(x) and set(x) & set(low) and set(x) & set(high)]
        assert strip(mine, low, high) == merged(below, above)
        count += len(mine)
    assert count == len(found)


@pytest.mark.parametrize("rising", [True, False])
@pytest.mark.parametrize("count", [2, 5])
def test_diagonals_of_alike_rows_all_go_one_way(count: int, rising: bool) -> None:
    own = grid([even(count + 1)] * 4)
    row = np.arange(1, count + 1) / (count + 1)
    triangles, inner = rows_between(own, row, [row] * count, rising=rising)
    found = {frozenset(x) for x in fills(own, triangles, inner)}
    first = len(own.ring())
    for j in range(count - 1):
        for k in range(count - 1):
            a, b = first + j * count + k, first + (j + 1) * count + k
            halves = ((a, a + 1, b + 1), (a, b + 1, b)) if rising else ((a, a + 1, b), (a + 1, b + 1, b))
            assert {frozenset(x) for x in halves} <= found
