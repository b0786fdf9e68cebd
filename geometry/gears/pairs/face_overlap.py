"""Contact along the face of helical gears: the sections of one drive angle are those of a range of drive angles.

A section at height z stands as the lowest one would stand after the drive has turned on by the twist over z. Both
helices turn together, so the gap along the face at one drive angle is the transverse gap curve over the angle that the
face covers, overlap ratio times pitch. A drive whose transverse contact is interrupted runs on where the face covers
the interruption.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from geometry.curves.curve import Real
from geometry.plane.distance import Flags

# each round finds the ends of contact this many times closer
_FINER = 16
_ROUNDS = 9


def is_bridged(angles: Real, touching: Flags, pitch: float, face: float, touches: Callable[[Real], Flags]) -> bool:
    """Whether one side of the teeth is in contact somewhere along the face at every drive angle.

    Parameters
    ----------
    angles, touching
        Drive angles (n,) in order within one pitch, rad, and whether the section touches there.
    face
        Drive angle that the face covers, rad.
    touches
        Tells for more drive angles (k,) whether the section touches.
    """
    if touching.all():
        return True
    if not touching.any():
        return False
    there = np.flatnonzero(touching)
    for here, following in zip(there, np.append(there[1:], there[0] + len(angles)), strict=True):
        if following - here == 1:
            continue
        way = np.concatenate([angles, angles + pitch])
        ends = (float(way[here]), float(way[here + 1]), float(way[following - 1]), float(way[following]))
        if not _covers(face, ends, touches):
            return False
    return True


def _covers(face: float, ends: tuple[float, float, float, float], touches: Callable[[Real], Flags]) -> bool:
    """Whether the face covers an interruption; ``ends``: last contact, first and last without, next contact, rad."""
    left, first, last, back = ends
    shares = np.arange(1, _FINER) / _FINER
    for _ in range(_ROUNDS):
        if face >= back - left:
            return True
        if face < last - first:
            return False
        before, after = left + shares * (first - left), last + shares * (back - last)
        hit = touches(np.concatenate([before, after]))
        out = np.flatnonzero(~hit[: len(before)])
        k = int(out[0]) if out.size else len(before)
        left, first = float(np.append(left, before)[k]), float(np.append(before, first)[k])
        out = np.flatnonzero(~hit[len(before) :])
        k = int(out[-1]) + 1 if out.size else 0
        last, back = float(np.append(last, after)[k]), float(np.append(after, back)[k])
    return face >= (back - left + last - first) / 2
