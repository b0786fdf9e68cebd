"""Which of many passing teeth may hold a least gap: bounds by how little a tooth moves from one position to the next.

Every tooth of a body takes the same way through its mate, one pitch after the other. All teeth at all drive angles
are thus places on one way, and the gap of a place differs from that of another by no more than the tooth has travelled
between both, as its mate sees it. A few places, measured, exclude most of the others; what stays is measured on
finer and finer steps. The whole way is a few modules long however many teeth stand on it.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from geometry.contact import Indices
from geometry.curve import Real

# steps along the way, in modules: the first, and how much finer each next one is; so many of them
_FIRST_STEP, _FINER, _ROUNDS = 0.2, 4.0, 4
# room for what the speed does between two places
_ROOM = 1.05
# so few places are not worth another step
_FEW = 64

Measure = Callable[[Indices, Indices], Real]


def promising_places(
    way: Real, speed: Real, module: float, measure: Measure, least: Real, slack: float = 0.0
) -> tuple[Indices, Indices]:
    """Rows and columns of the places on a way that may hold less than ``least``.

    Parameters
    ----------
    way
        (n,) positions of the places, in order, in the unit of the motion.
    speed
        (n,) greatest speed of a point of the tooth against the mate, mm per unit.
    measure
        Takes rows and columns of places and gives what their gap is at least, mm; a column is one part of the tooth.
    least
        (n, columns) what a place must go below, mm.
    slack
        mm that places may stand off the common way.
    """
    steps = np.maximum(speed[1:], speed[:-1]) * np.diff(way)
    travelled = _ROOM * np.concatenate([[0.0], np.cumsum(steps)])
    left = np.ones(least.shape, dtype=bool)
    known = np.full(left.shape, np.nan)
    step = _FIRST_STEP * module
    for _ in range(_ROUNDS):
        row, column = np.nonzero(left & np.isnan(known))
        if row.size <= _FEW:
            break
        chosen = _one_a_step(np.floor(travelled[row] / step).astype(np.intp), column)
        row, column = row[chosen], column[chosen]
        known[row, column] = measure(row, column)
        left &= _bounds(known, travelled) - slack < least
        step /= _FINER
    rows, columns = np.nonzero(left)
    return rows, columns


def _one_a_step(cell: Indices, column: Indices) -> Indices:
    """The first place of each column in each step of the way; cells do not fall."""
    mine = [np.flatnonzero(column == c) for c in range(int(column.max()) + 1)]
    return np.concatenate([rows[np.diff(cell[rows], prepend=-1) > 0] for rows in mine])


def _bounds(known: Real, travelled: Real) -> Real:
    """What each place's gap is at least by the nearest measured ones on either side; -inf without any."""
    bound = np.full(known.shape, -np.inf)
    rows = np.arange(len(known))
    for column in range(known.shape[1]):
        measured = np.flatnonzero(~np.isnan(known[:, column]))
        if not measured.size:
            continue
        values, places = known[measured, column], travelled[measured]
        for after in (0, 1):
            nearest = np.searchsorted(measured, rows, side="right") - 1 + after
            there = (nearest >= 0) & (nearest < len(measured))
            at = nearest[there]
            other = values[at] - np.abs(travelled[there] - places[at])
            bound[there, column] = np.maximum(bound[there, column], other)
    return bound
