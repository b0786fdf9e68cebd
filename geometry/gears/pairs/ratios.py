"""Numbers of teeth for a ratio, by one pair of gears or by two in a row."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

Whole = NDArray[np.int_]

# shares below it are what rounding leaves of none
_NONE = 1e-13


def teeth_for(
    ratio: Fraction, stages: int, least: int, most: int, share: float, *, coaxial: bool = False
) -> list[tuple[int, ...]]:
    """Numbers of teeth (z1, z2) or (z1, z2, z3, z4), the fewest in all first, each set nearer than all with fewer.

    z2 / z1, times z4 / z3, is off the ratio by at most that ``share``; every number is from ``least`` to ``most``, and
    no stage goes against the ratio; the last wheel has the number nearest to what the others ask for, or that of
    z1 + z2 = z3 + z4 where the last shaft stands in line with the first, ``coaxial``.
    """
    up = float(max(ratio, 1 / ratio))
    found = [_pairs(up, least, most)] if stages == 1 else [*_double(up, least, most, share, coaxial)]
    sets = np.concatenate([np.zeros((0, 2 * stages), dtype=int), *found])
    off = np.abs(np.prod(sets[:, 1::2], axis=1) / np.prod(sets[:, ::2], axis=1) / up - 1)
    off[off < _NONE] = 0.0
    kept, nearest = list[tuple[int, ...]](), np.inf
    total = sets.sum(axis=1)
    for at in np.lexsort((off, total)):
        again = kept and off[at] == nearest and total[at] == sum(kept[-1])
        if off[at] <= share and (off[at] < nearest or again):
            kept.append(tuple(map(int, sets[at])))
            nearest = off[at]
    return kept if ratio >= 1 else [tuple(z for pair in zip(s[1::2], s[::2], strict=True) for z in pair) for s in kept]


def _nearest(asked: NDArray[np.floating[Any]], least: int, most: int) -> Whole:
    """The whole numbers nearest to the ``asked`` ones, within the limits."""
    return np.clip(np.floor(asked + 0.5 + 1e-9), least, most).astype(int)


def _pairs(ratio: float, least: int, most: int) -> Whole:
    first = np.arange(least, most + 1)
    return np.stack([first, _nearest(first * ratio, least, most)], axis=1)


def _double(ratio: float, least: int, most: int, share: float, coaxial: bool) -> Iterator[Whole]:
    """Two stages, the lesser ratio first, for each first number of teeth."""
    second, third = np.meshgrid(np.arange(least, most + 1), np.arange(least, most + 1), indexing="ij")
    for first in range(least, most + 1):
        fourth = first + second - third if coaxial else _nearest(ratio * first * third / second, least, most)
        kept = np.abs(second * fourth / (ratio * first * third) - 1) <= share + _NONE
        kept &= (second >= first) & (second * third <= fourth * first) & (fourth <= most)
        yield np.stack([np.full_like(second, first)[kept], second[kept], third[kept], fourth[kept]], axis=1)
