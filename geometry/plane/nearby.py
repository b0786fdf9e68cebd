"""Which points of the plane have another one near to them, without holding all against all."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from geometry.curves.curve import Complex

# points that share their others, and what rounding takes from an angle, rad
_BLOCK, _SPARE = 128, 1e-9
# of the others every so many are asked first: most of what is near to any is near to one of them
_FEW = 16


def have_near(points: Complex, others: Complex, distance: float) -> NDArray[np.bool_]:
    """Whether one of the ``others`` is nearer than ``distance`` to each of the points (n,).

    Seen from the origin it stands within asin(distance / |point|) of the point's direction: no other one is asked.
    """
    found = np.zeros(len(points), dtype=bool)
    if not distance > 0:
        return found
    turns = np.angle(others)
    order = np.argsort(turns)
    # once more on either side, so that no window is cut at 180 degrees
    around = np.tile(others[order], 3)
    turns = (turns[order] + 2 * math.pi * np.arange(-1, 2)[:, None]).ravel()
    where = np.angle(points)
    ranks = np.argsort(where)
    for begin in range(0, len(points), _BLOCK):
        some = ranks[begin : begin + _BLOCK]
        share = distance / max(float(np.abs(points[some]).min()), 1e-300)
        reach = math.asin(share) + _SPARE if share < 1 else math.pi
        first, last = np.searchsorted(turns, [where[some[0]] - reach, where[some[-1]] + reach])
        near = around[first:last] if last - first < len(others) else others
        if len(near):
            for step in (_FEW, 1):
                some = some[~found[some]]
                found[some] = np.abs(points[some, None] - near[::step]).min(axis=1) < distance
    return found
