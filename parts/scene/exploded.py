"""How far things stand apart in an exploded view: each has gone back on the way on which it came, clear of the rest."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from geometry.curves.curve import Real
from parts.scene.steps import Stage

# between two things on one way, in parts of what comes in, and at least in parts of the whole
_SHARE, _LEAST = 0.1, 0.01


def apart(stages: Iterable[Stage], boxes: Mapping[str, Real]) -> dict[str, Real]:
    """By instance how far it is moved (3,), mm; ``boxes``: between which corners (2, 3) each stands.

    What comes in one by one, straight to an axis, stays: balls in their cage.
    """
    moved = {key: np.zeros(3) for key in boxes}
    whole = np.ptp(np.concatenate(list(boxes.values())), axis=0).max()
    for stage in stages:
        way = stage.step.along
        for key in stage.moved:
            moved[key] = moved[key] + moved[stage.step.to]
        if way is None or not stage.standing:
            continue
        back = -np.array(way, dtype=float) / np.linalg.norm(way)
        coming, standing = (np.array([boxes[k] + moved[k] for k in keys]) for keys in (stage.moved, stage.standing))
        span = np.ptp(coming.reshape(-1, 3), axis=0)
        gap = max(_SHARE * float(np.median(span)), _LEAST * whole)
        far = _needed(coming, standing, back)
        for key in stage.moved:
            moved[key] = moved[key] + back * (far + gap)
    return moved


def _needed(coming: Real, standing: Real, back: Real) -> float:
    """How far boxes go until none stands beside or before one that it meets sideways."""
    beside = np.abs(back) < 1e-9
    meets = np.ones((len(coming), len(standing)), dtype=bool)
    for k in np.flatnonzero(beside):
        meets &= coming[:, None, 0, k] < standing[None, :, 1, k]
        meets &= coming[:, None, 1, k] > standing[None, :, 0, k]
    if not meets.any():
        return 0.0
    # the corners of a box that lie nearest and farthest on the way
    nearest = np.where(back > 0, coming[:, 0], coming[:, 1]) @ back
    farthest = np.where(back > 0, standing[:, 1], standing[:, 0]) @ back
    return max(float((farthest[None, :] - nearest[:, None])[meets].max()), 0.0)
