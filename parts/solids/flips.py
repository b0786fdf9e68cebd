"""Delaunay triangles of plane regions whose edges are kept, with unit cells in their middle where that helps."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from geometry.base.errors import ThinWallError
from geometry.base.record import Record
from geometry.curves.curve import Complex, Flags, Real
from parts.solids.caps import Triangles, library_triangles, numbered

# how near to the bounds cells may come, and how closely these are sampled for it, in cells
_CLEAR, _SAMPLED = 0.45, 0.2
_AROUND = _CLEAR * np.array([complex(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1)])
_MOST_CELLS, _MOST_ROUNDS, _ROUNDING = 400_000, 1000, 1e-9


class Cells(Record, eq=False):
    """Corners (n,) of unit cells within a region, triangles over them, and the loops round them, clockwise."""

    points: Complex
    triangles: Triangles
    loops: tuple[Triangles, ...]


def constrained(rings: Sequence[Complex], cells: Cells | None) -> Triangles:
    """Delaunay triangles of the region within rings (the first one outside, the others clockwise) and of cells in it.

    Raises
    ------
    ThinWallError
        The rings touch or cross.
    """
    numbers = numbered(rings)
    points = np.concatenate(rings)
    size = len(points)
    found = []
    if cells is not None:
        points = np.concatenate([points, cells.points])
        found.append(cells.triangles + size)
        numbers += [loop + size for loop in cells.loops]
    found.append(library_triangles(points, numbers))
    kept = np.concatenate([np.stack([n, np.roll(n, 1)], axis=1) for n in numbers[: len(rings)]])
    return _flipped(points, np.concatenate(found), kept)


def _flipped(points: Complex, triangles: Triangles, kept: Triangles) -> Triangles:
    """Lawson's flips, as many at a time as do not meet."""
    count = len(points)
    fixed = np.sort(kept, axis=1) @ np.array([count, 1])
    for _ in range(_MOST_ROUNDS):
        sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
        apex = triangles.T[[2, 0, 1]].ravel()
        key = np.sort(sides, axis=1) @ np.array([count, 1])
        order = np.argsort(key, kind="stable")
        twin = np.flatnonzero(key[order][1:] == key[order][:-1])
        one, two = order[twin], order[twin + 1]
        free = ~np.isin(key[one], fixed)
        one, two = one[free], two[free]
        a, b, c, d = (points[x] for x in (sides[one, 0], sides[one, 1], apex[one], apex[two]))
        wrong = np.flatnonzero(_in_circle(a, b, c, d) & (_cross(d, b, c) > 0) & (_cross(a, d, c) > 0))
        if not wrong.size:
            break
        first, second = one[wrong] % len(triangles), two[wrong] % len(triangles)
        chosen = np.full(len(triangles), len(wrong))
        np.minimum.at(chosen, first, np.arange(len(wrong)))
        np.minimum.at(chosen, second, np.arange(len(wrong)))
        mine = np.flatnonzero((chosen[first] == np.arange(len(wrong))) & (chosen[second] == np.arange(len(wrong))))
        at, other = one[wrong[mine]], two[wrong[mine]]
        triangles = triangles.copy()
        triangles[first[mine]] = np.stack([apex[other], sides[at, 1], apex[at]], axis=1)
        triangles[second[mine]] = np.stack([sides[at, 0], apex[other], apex[at]], axis=1)
    return triangles


def _cross(a: Complex, b: Complex, c: Complex) -> Real:
    return np.asarray((np.conj(b - a) * (c - a)).imag)


def _in_circle(a: Complex, b: Complex, c: Complex, d: Complex) -> Flags:
    """Whether d lies within the circle about the triangle a, b, c, by more than rounding."""
    p, q, r = a - d, b - d, c - d
    squares = [np.abs(x) ** 2 for x in (p, q, r)]
    terms = [squares[k] * (np.conj(x) * y).imag for k, (x, y) in enumerate(((q, r), (r, p), (p, q)))]
    size = np.maximum.reduce([*squares])
    return np.asarray(sum(terms) > _ROUNDING * size * size)


def inner_cells(rings: Sequence[Complex]) -> Cells | None:
    """The cells of a unit grid that stand clear of the bounds of a region, if there are any."""
    whole = np.concatenate(rings)
    low = complex(whole.real.min(), whole.imag.min())
    # a cell that passes the least rectangle about the region does not stand clear
    wide, high = int(np.ptp(whole.real)), int(np.ptp(whole.imag))
    if wide * high > _MOST_CELLS:
        raise ThinWallError("a face asks for more cells than a file can carry")
    near = np.zeros((wide, high), dtype=bool)
    # crossings of the rows' middles, for what lies inside
    middles = low.imag + np.arange(high) + 0.5
    change = np.zeros((wide + 1, high), dtype=np.int64)
    for ring in rings:
        for a, b in zip(ring.tolist(), np.roll(ring, 1).tolist(), strict=True):
            steps = int(abs(b - a) / _SAMPLED) + 2
            spots = (a + (b - a) * np.linspace(0, 1, steps) - low)[:, None] + _AROUND
            i, j = np.floor(spots.real).astype(int), np.floor(spots.imag).astype(int)
            good = (i >= 0) & (j >= 0) & (i < wide) & (j < high)
            near[i[good], j[good]] = True
            rows = np.flatnonzero((min(a.imag, b.imag) <= middles) & (middles < max(a.imag, b.imag)))
            x = a.real + (b.real - a.real) * (middles[rows] - a.imag) / (b.imag - a.imag) - low.real
            # cells whose middle lies to the right of it
            np.add.at(change, (np.minimum(np.ceil(x - 0.5).astype(int), wide), rows), 1)
    inside = (np.cumsum(change, axis=0)[:-1] % 2 == 1) & ~near
    # cells that meet in a corner only would pinch the region about them
    for a, b in (((0, 0), (1, 1)), ((0, 1), (1, 0))):
        one, two = (inside[x : x + wide - 1, y : y + high - 1] for x, y in (a, b))
        other = [inside[x : x + wide - 1, y : y + high - 1] for x, y in ((a[0], b[1]), (b[0], a[1]))]
        one &= ~(one & two & ~other[0] & ~other[1])
    i, j = np.nonzero(inside)
    if not len(i):
        return None
    step = high + 1
    corners = (i * step + j)[:, None] + np.array([0, step, step + 1, 1])
    used, local = np.unique(corners, return_inverse=True)
    local = local.reshape(corners.shape)
    points = low + (used // step) + 1j * (used % step)
    triangles = np.concatenate([local[:, [0, 1, 2]], local[:, [0, 2, 3]]])
    return Cells(points, triangles, _loops(local, len(used)))


def _loops(cells: Triangles, count: int) -> tuple[Triangles, ...]:
    """The loops round cells, with the cells on the right."""
    sides = np.concatenate([cells[:, [k, (k + 1) % 4]] for k in range(4)])
    key, back = sides @ np.array([count, 1]), sides @ np.array([1, count])
    rim = sides[~np.isin(back, key)]
    following = {b: a for a, b in rim.tolist()}
    found = []
    while following:
        start, vertex = following.popitem()
        chain = [start]
        while vertex != start:
            chain.append(vertex)
            vertex = following.pop(vertex)
        found.append(np.array(chain))
    return tuple(found)
