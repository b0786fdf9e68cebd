"""The greatest value of a function of a few variables, held between what was found and what cannot be passed.

Boxes that could still hold a greater value, by the slopes that the function never passes, are halved along the side
that leaves most open; from the best place then a star of directions leads up to the last digits. The bound holds by the
slopes alone.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product

import numpy as np

from geometry.base.record import Record
from geometry.base.roots import Real

# boxes along each variable at first; steps of the star that no longer matter
_FIRST, _LAST = 4, 1e-9
_MOST_BOXES = 1_000_000


class Greatest(Record):
    """The value at a place, and what the function passes nowhere."""

    value: float
    at: tuple[float, ...]
    bound: float


def greatest(
    function: Callable[..., Real],
    ranges: Sequence[tuple[float, float]],
    slopes: Sequence[float] | Real,
    share: float = 1e-3,
) -> Greatest:
    """The greatest value within ranges, to a ``share`` of it.

    ``function`` takes an array for each variable, and gives one, or what is the same everywhere; ``slopes``: how much
    it changes at most for each variable's unit.
    """
    steep = np.abs(np.asarray(slopes, dtype=float))
    low, high = (np.array([r[k] for r in ranges]) for k in (0, 1))
    half = (high - low) / (2 * _FIRST)
    steps = [np.arange(_FIRST)] * len(low)
    boxes = low + half * (1 + 2 * np.stack(np.meshgrid(*steps, indexing="ij"), -1).reshape(-1, len(low)))
    best, place = -np.inf, boxes[0]
    while True:
        values = np.broadcast_to(np.asarray(function(*boxes.T), dtype=float), len(boxes))
        top = int(values.argmax())
        if values[top] > best:
            best, place = float(values[top]), boxes[top]
        above = values + float(half @ steep)
        enough = best + share * abs(best)
        kept = above > enough
        if not kept.any() or 2 * kept.sum() > _MOST_BOXES:
            bound = float(above.max()) if kept.any() else enough if steep.any() else best
            value, place = _climbed(function, place, half, best, (low, high))
            return Greatest(value, tuple(map(float, place)), max(value, bound))
        side = int(np.argmax(half * steep))
        half = half.copy()
        half[side] /= 2
        step = np.zeros(len(half))
        step[side] = half[side]
        boxes = np.concatenate([boxes[kept] - step, boxes[kept] + step])


def _climbed(
    function: Callable[..., Real], place: Real, half: Real, value: float, ends: tuple[Real, Real]
) -> tuple[float, Real]:
    """Up from a place by a star of directions whose steps are halved where none leads up."""
    star = np.array([way for way in product((-1.0, 0.0, 1.0), repeat=len(place)) if any(way)])
    step = half.copy()
    while (step > _LAST).any():
        around = np.clip(place + star * step, *ends)
        values = np.broadcast_to(np.asarray(function(*around.T), dtype=float), len(star))
        top = int(values.argmax())
        if values[top] > value:
            value, place = float(values[top]), around[top]
        else:
            step = step / 2
    return value, place
