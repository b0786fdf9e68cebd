"""Pieces on a board slid together by exact distances: what the cells of a grid have wasted is taken back."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from geometry.curves.curve import Complex

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

# the first step that is tried, mm, is halved until it is below the last
_FIRST, _LAST = 4.0, 1e-3
# to the left, and down, in turns
_WAYS = (-1, -1j, -1, -1j, -1)


def slid(pieces: Sequence[BaseGeometry], corner: complex, gap: float) -> Complex:
    """How far each piece moves, mm; none leaves the room at its lower left ``corner`` or comes nearer than the gap."""
    import shapely
    from shapely.affinity import translate

    placed, moved = list(pieces), np.zeros(len(pieces), dtype=complex)
    boxes = shapely.bounds(np.array(placed, dtype=object))
    for way in _WAYS:
        along = 0 if way == -1 else 1
        for index in np.argsort(boxes[:, along], kind="stable").tolist():
            own, room = placed[index], boxes[index, along] - (corner.real, corner.imag)[along]
            low, high = boxes[index, :2] - gap, boxes[index, 2:] + gap
            low[along] -= min(room, 2 * _FIRST)
            near = np.all((boxes[:, 2:] >= low) & (boxes[:, :2] <= high), axis=1)
            near[index] = False
            others = np.array([placed[k] for k in np.flatnonzero(near)], dtype=object)
            way_made, step = 0.0, _FIRST
            while step >= _LAST and way_made < 2 * _FIRST - _LAST:
                tried = way_made + step
                there = translate(own, *_xy(way * tried))
                if tried <= room and not shapely.dwithin(others, there, gap).any():
                    way_made = tried
                else:
                    step /= 2
            if way_made:
                moved[index] += way * way_made
                placed[index] = translate(own, *_xy(way * way_made))
                shapely.prepare(placed[index])
                boxes[index] = placed[index].bounds
    return moved


def _xy(place: complex) -> tuple[float, float]:
    return place.real, place.imag
