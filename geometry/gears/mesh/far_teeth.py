"""Which of many passing teeth may hold a least gap: bounds by how little a tooth moves from one position to the next.

Every tooth of a body takes the same way through its mate, one pitch after the other. All teeth at all drive angles
are thus places on one way, and the gap of a place differs from that of another by no more than the tooth has travelled
between both, as its mate sees it. A few places, measured, exclude most of the others; what stays is measured on
finer and finer steps. The whole way is a few modules long however many teeth stand on it.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from geometry.curves.curve import Real
from geometry.plane.distance import Indices

# steps along the way, in modules: the first, and how much finer each next one is; so many of them
_FIRST_STEP, _FINER, _ROUNDS = 0.2, 8.0, 4
# room for what the speed does between two places
_ROOM = 1.05
# so few places are not worth another step
_FEW = 256

Measure = Callable[[Indices, Indices], Real]


class Measured:
    """Places on a way that have been measured, for the next search along the same way: positions and least gaps, mm."""

    def __init__(self) -> None:
        self.way = np.zeros(0)
        self.gap = np.zeros((0, 0))

    def add(self, way: Real, gap: Real) -> None:
        """More places; nan where a column of a place is not known."""
        some = ~np.isnan(gap).all(axis=1)
        self.gap = np.concatenate([self.gap.reshape(-1, gap.shape[1]), gap[some]])
        self.way = np.concatenate([self.way, way[some]])


def promising_places(
    way: Real,
    speed: Callable[[Real], Real],
    module: float,
    measure: Measure,
    least: Real,
    known: Measured,
    slack: float = 0.0,
) -> tuple[Indices, Indices]:
    """Rows and columns of the places on a way that may hold less than ``least``.

    Parameters
    ----------
    way
        (n,) positions of the places, in order, in the unit of the motion.
    speed
        For positions the greatest speed of a point of the tooth against the mate, mm per unit.
    measure
        Takes rows and columns of places and gives what their gap is at least, mm; a column is one part of the tooth.
    least
        (n, columns) what a place must go below, mm.
    known
        Places that are known already; those that this search measures are added.
    slack
        mm that places may stand off the common way.
    """
    everywhere = np.concatenate([way, known.way])
    order = np.argsort(everywhere, kind="stable")
    speeds = speed(everywhere[order])
    steps = np.maximum(speeds[1:], speeds[:-1]) * np.diff(everywhere[order])
    travelled = np.empty(len(order))
    travelled[order] = _ROOM * np.concatenate([[0.0], np.cumsum(steps)])
    old, travelled = travelled[len(way) :], travelled[: len(way)]
    found = np.full(least.shape, np.nan)
    left = _bounds(known.gap, old, travelled, least.shape[1]) - slack < least
    step = _FIRST_STEP * module
    for _ in range(_ROUNDS):
        row, column = np.nonzero(left & np.isnan(found))
        if row.size <= _FEW:
            break
        chosen = _one_a_step(np.floor(travelled[row] / step).astype(np.intp), column)
        row, column = row[chosen], column[chosen]
        found[row, column] = measure(row, column)
        left &= _bounds(found, travelled, travelled, least.shape[1]) - slack < least
        step /= _FINER
    known.add(way, found)
    rows, columns = np.nonzero(left)
    return rows, columns


def _one_a_step(cell: Indices, column: Indices) -> Indices:
    """The first place of each column in each step of the way; cells do not fall."""
    mine = [np.flatnonzero(column == c) for c in range(int(column.max()) + 1)]
    return np.concatenate([rows[np.diff(cell[rows], prepend=-1) > 0] for rows in mine])


def _bounds(gap: Real, at: Real, wanted: Real, columns: int) -> Real:
    """What gaps are at least where ``wanted`` has been travelled, by the nearest measured ones on either side."""
    bound = np.full((len(wanted), columns), -np.inf)
    for column in range(columns if gap.size else 0):
        measured = np.flatnonzero(~np.isnan(gap[:, column]))
        measured = measured[np.argsort(at[measured], kind="stable")]
        if not measured.size:
            continue
        values, places = gap[measured, column], at[measured]
        before = np.searchsorted(places, wanted, side="right") - 1
        for nearest in (np.maximum(before, 0), np.minimum(before + 1, len(places) - 1)):
            other = values[nearest] - np.abs(wanted - places[nearest])
            bound[:, column] = np.maximum(bound[:, column], other)
    return bound
