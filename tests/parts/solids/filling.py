"""Whether triangles fill a plane region, asked of every side and corner."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import pytest

Three = tuple[int, int, int]


def turned(a: complex, b: complex, c: complex) -> float:
    """Twice the area of a triangle, positive where it runs counter-clockwise."""
    return ((b - a).conjugate() * (c - a)).imag


def area(ring: Sequence[complex]) -> float:
    return sum((a.conjugate() * b).imag for a, b in zip(ring, [*ring[1:], ring[0]], strict=True)) / 2


def sides_of(triangle: Three) -> tuple[Three, Three, Three]:
    """Its sides, each with the corner across."""
    a, b, c = triangle
    return (a, b, c), (b, c, a), (c, a, b)


def filled(
    points: Sequence[complex], triangles: Iterable[Sequence[int]], loops: Sequence[Sequence[int]]
) -> list[Three]:
    """The triangles, which fill what loops bound: the first outside, the others its holes; either way round.

    All are counter-clockwise, their sum is the region's area, each side is that of two of them, once either way, but
    for the bounds, and every point is a corner.
    """
    found = [(a, b, c) for a, b, c in triangles]
    doubled = [turned(points[a], points[b], points[c]) for a, b, c in found]
    assert min(doubled) > 0
    outer, *holes = (abs(area([points[k] for k in loop])) for loop in loops)
    assert sum(doubled) / 2 == pytest.approx(outer - sum(holes), rel=1e-12)
    sides = [(a, b) for one in found for a, b, _ in sides_of(one)]
    assert len(set(sides)) == len(sides)
    bounds = {frozenset(side) for loop in loops for side in zip(loop, [*loop[1:], loop[0]], strict=True)}
    assert {frozenset(side) for side in set(sides) - {(b, a) for a, b in sides}} == bounds
    assert {k for one in found for k in one} == set(range(len(points)))
    return found
