"""A line that two cams on one shaft draw, one along x and one along y: its places in order, how far two lines are off.

Places are complex, mm; a line is closed: its last corner leads to the first.
"""

from __future__ import annotations

import numpy as np

from geometry.cams.motion.follower_motion import FollowerMotion
from geometry.curves.curve import Complex, Real

# places that are held against a line at once
_BLOCK = 256


def along(corners: Complex, count: int) -> tuple[Real, Complex]:
    """Shares of the line's length, from 0 to below 1, and places there: every corner, and some ``count`` even ones."""
    ends = np.append(corners, corners[0])
    lengths = np.abs(np.diff(ends))
    told = np.append(0.0, np.cumsum(lengths)) / lengths.sum()
    pieces = np.ceil(count * lengths / lengths.sum()).astype(int).tolist()
    shares = np.concatenate([
        np.linspace(a, b, n, endpoint=False) for a, b, n in zip(told[:-1], told[1:], pieces, strict=True)
    ])  # fmt: skip
    return shares, np.interp(shares, told, ends)


def drawn(along_x: FollowerMotion, along_y: FollowerMotion, angles: Real, order: int = 0) -> Complex:
    """Where both followers have moved the pen at cam angles, rad, or a derivative of that, mm and rad."""
    return np.asarray(along_x.value(angles, order) + 1j * along_y.value(angles, order))


def farthest(places: Complex, line: Complex) -> float:
    """The greatest distance of places from a line."""
    ways = np.roll(line, -1) - line
    starts, ways = line[ways != 0], ways[ways != 0]
    worst = 0.0
    for first in range(0, len(places), _BLOCK):
        seen = (places[first : first + _BLOCK, None] - starts) / ways
        off = np.abs((seen - np.clip(seen.real, 0.0, 1.0)) * ways).min(axis=1)
        worst = max(worst, float(off.max()))
    return worst
