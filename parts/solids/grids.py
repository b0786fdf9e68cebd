"""Triangles between four sides of any numbers of points: a grid inside, stitched to the sides."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from geometry.base.record import Record
from geometry.curves.curve import Real
from parts.solids.caps import Triangles, numbered

# of shares that are compared; by how much of a step a row is taken to lean
_DIGITS, _LEAN = 11, 0.1


class Grid(Record, eq=False):
    """Four sides, counter-clockwise from the lower one: shares (k,), u and v (k, 2), and numbers of their points (k,).

    A side at a pole has the u and v of its ends and one point.
    """

    sides: tuple[tuple[Real, Real, Triangles], ...]

    def ring(self) -> Real:
        """u and v of the points of all sides, (n, 2)."""
        return np.concatenate([uv[: len(names) - 1] for _, uv, names in self.sides])

    def names(self) -> Triangles:
        """Their numbers, (n,)."""
        return np.concatenate([names[:-1] for _, _, names in self.sides])

    def shares(self) -> list[Real]:
        """Of the points of each side."""
        return [own[: len(names)] for own, _, names in self.sides]

    def chains(self) -> list[Triangles]:
        """The places in the ring of the points of each side, both ends among them; of a pole one."""
        starts = np.cumsum([0, *(len(names) - 1 for _, _, names in self.sides)]).tolist()
        return [np.arange(a, b + 1) % starts[-1] for a, b in pairwise(starts)]

    def collapsed(self) -> Triangles:
        """The places in the ring of poles, where u is any."""
        return np.array([chain[0] for chain in self.chains() if len(chain) == 1], dtype=np.int64)


def grid_between(grid: Grid, u_count: int, v_count: int) -> tuple[Triangles, Real]:
    """Triangles over the points of the ring and those behind them, and u and v of the latter, (m, 2).

    ``u_count``, ``v_count``: cells along both, whose diagonals go up with u and v.
    """
    bottom, right, top, left = chains = grid.chains()
    counts = [len(chain) - 1 for chain in chains]
    shares = grid.shares()
    total = sum(counts)
    if v_count == 1 and max(counts[1], counts[3]) <= 1:
        return _zipped(bottom, shares[0], top[::-1], 1 - shares[2][::-1]), np.zeros((0, 2))
    if u_count == 1 and max(counts[0], counts[2]) <= 1:
        return _zipped(right, shares[1], left[::-1], 1 - shares[3][::-1]), np.zeros((0, 2))
    u_count, v_count = max(2, u_count), max(2, v_count)
    s, t = np.arange(1, u_count) / u_count, np.arange(1, v_count) / v_count
    inner = total + np.arange((u_count - 1) * (v_count - 1)).reshape(v_count - 1, u_count - 1)
    found = [
        _zipped(bottom, shares[0], inner[0], s),
        _zipped(right, shares[1], inner[:, -1], t),
        _zipped(top, shares[2], inner[-1, ::-1], 1 - s[::-1]),
        _zipped(left, shares[3], inner[::-1, 0], 1 - t[::-1]),
    ]
    a, b, c, d = (x.ravel() for x in (inner[:-1, :-1], inner[:-1, 1:], inner[1:, 1:], inner[1:, :-1]))
    found += [np.stack(cell, axis=1) for cell in ((a, b, c), (a, c, d))]
    return np.concatenate(found), _between(grid, s, t)


def rows_between(grid: Grid, t: Real, rows: list[Real], *, rising: bool) -> tuple[Triangles, Real]:
    """The same between the sides of the unit square over rows at ``t`` that have their own places along u each."""
    chains, shares = grid.chains(), grid.shares()
    inner = [own + sum(len(chain) - 1 for chain in chains) for own in numbered(rows)]
    first, last = (np.array([own[k] for own in inner]) for k in (0, -1))
    found = [
        _zipped(chains[0], shares[0], inner[0], rows[0]),
        _zipped(chains[1], shares[1], last, t),
        _zipped(chains[2], shares[2], inner[-1][::-1], 1 - rows[-1][::-1]),
        _zipped(chains[3], shares[3], first[::-1], 1 - t[::-1]),
    ]
    for (low, s_low), (high, s_high) in pairwise(zip(inner, rows, strict=True)):
        # of alike rows the diagonals all go one way
        lean = (-_LEAN if rising else _LEAN) / max(len(low), len(high))
        found.append(_zipped(low, s_low, high, s_high + lean))
    return np.concatenate(found), np.column_stack([np.concatenate(rows), np.repeat(t, [len(row) for row in rows])])


def _between(grid: Grid, s: Real, t: Real) -> Real:
    """u and v of the inner points, row after row (Coons)."""
    lower, right = (_side(grid, k, x) for k, x in ((0, s), (1, t)))
    upper, left = (_side(grid, k, 1 - x) for k, x in ((2, s), (3, t)))
    corners = [grid.sides[k][1][0] for k in range(4)]
    s, t = s[None, :, None], t[:, None, None]
    flat = (1 - t) * lower[None] + t * upper[None] + (1 - s) * left[:, None] + s * right[:, None]
    corner = (1 - s) * (1 - t) * corners[0] + s * (1 - t) * corners[1] + s * t * corners[2] + (1 - s) * t * corners[3]
    return np.asarray((flat - corner).reshape(-1, 2))


def _side(grid: Grid, k: int, at: Real) -> Real:
    shares, uv, _ = grid.sides[k]
    return np.column_stack([np.interp(at, shares, uv[:, 0]), np.interp(at, shares, uv[:, 1])])


def _zipped(low: Triangles, low_shares: Real, high: Triangles, high_shares: Real) -> Triangles:
    """Triangles between two chains that run the same way, the second on the left of the first."""
    keys = np.concatenate([(low_shares[1:] + low_shares[:-1]) / 2, (high_shares[1:] + high_shares[:-1]) / 2])
    # rounded: the same shares are a tie on any machine
    is_low = np.argsort(np.round(keys, _DIGITS), kind="stable") < len(low) - 1
    i: Triangles = np.cumsum(is_low) - is_low
    j: Triangles = np.arange(len(is_low)) - i
    third = np.where(is_low, low[np.minimum(i + 1, len(low) - 1)], high[np.minimum(j + 1, len(high) - 1)])
    return np.stack([low[i], third, high[j]], axis=1)
