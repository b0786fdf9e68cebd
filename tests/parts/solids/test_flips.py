"""Delaunay triangles whose edges are kept, and the cells within, held against brute force over points and cells."""

from __future__ import annotations

from functools import cache
from itertools import combinations, pairwise, product

import numpy as np
import pytest
import shapely

from geometry.base.errors import ThinWallError
from geometry.curves.curve import Complex
from parts.solids.caps import Triangles
from parts.solids.flips import Cells, constrained, inner_cells
from tests.parts.solids.filling import area, filled, sides_of, turned

# how near to the bounds cells may come, and by how much samples of these may miss it, in cells
CLEAR, MISSED = 0.45, 0.11


def star(seed: int, radius: float, count: int, middle: complex) -> Complex:
    """A polygon with one corner in each of some directions, counter-clockwise."""
    draw = np.random.default_rng(seed)
    angles = 2 * np.pi * (np.arange(count) + draw.uniform(0.1, 0.9, count)) / count
    return np.asarray(middle + radius * draw.uniform(0.45, 1.0, count) * np.exp(1j * angles))


def square(low: complex, high: complex) -> Complex:
    return np.array([low, complex(high.real, low.imag), high, complex(low.real, high.imag)])


STRIP = np.array([0, 2.3, 12 + 9.7j, 12 + 12j, 9.7 + 12j, 2.3j])
# stars with a hole each, off the grid; strips along both diagonals, whose cells meet in corners only
REGIONS = {
    "star": (star(3, 9.0, 11, -3.3 + 2.7j), star(5, 2.5, 7, -3.1 + 2.4j)[::-1]),
    "slender": (star(8, 14.0, 5, 40.2 - 31.9j), star(9, 1.4, 6, 40.0 - 31.5j)[::-1]),
    "strip": (STRIP - 5.3 - 5j,),
    # holes as near to cells as they may come, on every side
    "holes": (square(1.2 - 3j, 21.2 + 9j), square(5.67 - 0.53j, 8.73 + 2.53j)[::-1], square(13 + 1j, 16 + 6j)[::-1]),
    "other strip": (STRIP.conj()[::-1] + 0.2,),
}


def in_circle(a: complex, b: complex, c: complex, d: complex) -> float:
    """The determinant that is above 0 where d lies within the circle about a, b, c, counter-clockwise."""
    rows = [[p.real - d.real, p.imag - d.imag, abs(p - d) ** 2] for p in (a, b, c)]
    return float(np.linalg.det(np.array(rows)))


def held(rings: tuple[Complex, ...], cells: Cells | None, found: Triangles) -> None:
    """They fill the region, keep its edges, and no corner across an edge that is free lies within a circle."""
    points = np.concatenate([*rings, cells.points if cells else np.zeros(0)]).tolist()
    ends = np.cumsum([0, *(len(ring) for ring in rings)]).tolist()
    triangles = filled(points, found.tolist(), [range(a, b) for a, b in pairwise(ends)])
    across = {(one, two): apex for x in triangles for one, two, apex in sides_of(x)}
    for (one, two), apex in across.items():
        if (two, one) in across:
            four = [points[k] for k in (one, two, apex, across[two, one])]
            size = max(abs(p - q) for p, q in combinations(four, 2))
            assert in_circle(*four) <= 1e-8 * size**4


@cache
def cells_of(name: str) -> Cells | None:
    return inner_cells(REGIONS[name])


def indices(rings: tuple[Complex, ...], cells: Cells) -> set[tuple[int, int]]:
    """The cells by their lower corners, counted from the region's lower left one."""
    whole = np.concatenate(rings)
    corners = cells.points[cells.triangles].reshape(-1, 3) - complex(whole.real.min(), whole.imag.min())
    low = corners.real.min(axis=1) + 1j * corners.imag.min(axis=1)
    assert np.abs(corners - np.round(corners.real) - 1j * np.round(corners.imag)).max() < 1e-12
    return {(round(z.real), round(z.imag)) for z in low.tolist()}


@pytest.mark.parametrize("name", REGIONS)
def test_cells_are_those_that_stand_clear_of_the_bounds(name: str) -> None:
    """Every cell is asked by itself: whether its middle lies within, and whether the bounds come near it."""
    rings = REGIONS[name]
    cells = cells_of(name)
    assert cells is not None
    found = indices(rings, cells)
    whole = np.concatenate(rings)
    region = shapely.Polygon(
        *(np.stack([r.real, r.imag], axis=1) for r in rings[:1]),
        [np.stack([r.real, r.imag], axis=1) for r in rings[1:]],
    )
    assert region.is_valid
    low_x, low_y, high_x, high_y = region.bounds
    sure, open_ones = set(), set()
    for i, j in product(range(-1, int(high_x - low_x) + 2), range(-1, int(high_y - low_y) + 2)):
        x, y = low_x + i, low_y + j
        if not region.contains(shapely.Point(x + 0.5, y + 0.5)):
            continue
        far, near = (shapely.box(x - c, y - c, x + 1 + c, y + 1 + c) for c in (CLEAR, CLEAR - MISSED))
        if not region.boundary.intersects(far):
            sure.add((i, j))
        if not region.boundary.intersects(near):
            open_ones.add((i, j))
    assert whole.real.min() == low_x
    assert found <= open_ones
    # what is left out meets another cell in a corner only
    for i, j in sure - found:
        assert any(
            (i + a, j + b) in sure and not {(i + a, j), (i, j + b)} & found for a, b in product((-1, 1), repeat=2)
        )


@pytest.mark.parametrize("name", REGIONS)
def test_loops_run_round_the_cells_clockwise_and_meet_nowhere(name: str) -> None:
    cells = cells_of(name)
    assert cells is not None
    corners = cells.points[cells.triangles]
    assert [turned(*one) for one in corners.tolist()] == pytest.approx([1.0] * len(corners), abs=1e-9)
    count = len(indices(REGIONS[name], cells))
    assert len(cells.triangles) == 2 * count
    assert sum(area(cells.points[loop].tolist()) for loop in cells.loops) == pytest.approx(-count, rel=1e-12)
    every = np.concatenate(cells.loops)
    assert len(np.unique(every)) == len(every)
    for loop in cells.loops:
        assert np.abs(cells.points[loop] - np.roll(cells.points[loop], 1)) == pytest.approx(np.ones(len(loop)))
    # every corner is one of a cell, and stands once
    assert set(cells.triangles.ravel().tolist()) == set(range(len(cells.points)))
    assert len(np.unique(np.round(cells.points, 9))) == len(cells.points)


@pytest.mark.parametrize("name", REGIONS)
@pytest.mark.parametrize("filled", [True, False])
def test_triangles_are_delaunay_within_edges_that_are_kept(name: str, filled: bool) -> None:
    cells = cells_of(name) if filled else None
    held(REGIONS[name], cells, constrained(REGIONS[name], cells))


def test_on_a_convex_ring_they_are_those_of_the_convex_hull_of_the_paraboloid() -> None:
    """Delaunay triangles are the lower hull of (x, y, x^2 + y^2), whatever made them."""
    from scipy.spatial import ConvexHull

    draw = np.random.default_rng(7)
    angles = np.sort(draw.uniform(0, 2 * np.pi, 40))
    ring = 2.0 - 1j + 7 * np.cos(angles) + 3j * np.sin(angles)
    hull = ConvexHull(np.stack([ring.real, ring.imag, np.abs(ring) ** 2], axis=1))
    lower = hull.simplices[hull.equations[:, 2] < 0]
    found = constrained((ring,), None)
    assert {frozenset(x) for x in found.tolist()} == {frozenset(x) for x in lower.tolist()}


@pytest.mark.parametrize("scale", [1e-3, 1e3])
def test_triangles_of_larger_and_smaller_rings_are_the_same(scale: float) -> None:
    rings = REGIONS["star"]
    same = constrained(tuple(scale * ring for ring in rings), None)
    assert {frozenset(x) for x in same.tolist()} == {frozenset(x) for x in constrained(rings, None).tolist()}


def test_a_square_of_whole_cells_has_only_those_a_cell_within() -> None:
    """Cells that touch the bounds are left out: of 6 x 4 there are 4 x 2, as near as a whole cell."""
    rings = (square(10 - 3j, 16 + 1j),)
    cells = inner_cells(rings)
    assert cells is not None
    assert indices(rings, cells) == set(product(range(1, 5), range(1, 3)))
    assert sorted(cells.points.tolist(), key=lambda z: (z.real, z.imag)) == [
        complex(x, y) for x in range(11, 16) for y in range(-2, 1)
    ]
    held(rings, cells, constrained(rings, cells))


def test_no_cell_stands_clear_in_a_narrow_region() -> None:
    assert inner_cells((square(0j, 30 + 1.8j),)) is None
    assert inner_cells((square(0j, 1.8 + 30j),)) is None
    assert inner_cells((square(0j, 30 + 1.95j),)) is None
    assert inner_cells((square(0j, 30 + 3j),)) is not None


def test_more_cells_than_a_file_carries_are_refused() -> None:
    """The least rectangle about a region has at most 400 000, whatever part of it the region fills."""
    assert inner_cells((np.array([0, 1000 + 400j, 999 + 400j]),)) is None
    with pytest.raises(ThinWallError, match="more cells"):
        inner_cells((np.array([0, 1000 + 401j, 999 + 401j]),))


def test_rings_that_cross_are_refused() -> None:
    outer = square(0j, 10 + 10j)
    with pytest.raises(ThinWallError, match="touch or cross"):
        constrained((outer, square(4 + 4j, 12 + 6j)[::-1]), None)
    with pytest.raises(ThinWallError, match="touch or cross"):
        constrained((np.array([0, 10, 3 + 8j, 3 - 2j]),), None)
    assert len(constrained((outer, square(4 + 4j, 9 + 6j)[::-1]), None)) == 8
