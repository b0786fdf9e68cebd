"""What of an edge is seen: its pieces between the places where something begins or ends to hide it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import pairwise

import numpy as np

from geometry.curves.curve import Curve, Real

# samples of an edge, steps of a halving, part of an edge that is none
SAMPLES, _HALVINGS, _NONE = 65, 24, 1e-6


def shown_pieces(curve: Curve, hidden: Callable[[Real], np.ndarray]) -> Iterator[Curve]:
    """The pieces of an edge that nothing hides; ``hidden``: whether it is, at parameters."""
    t = np.linspace(*curve.domain, SAMPLES)
    mask = hidden(t)
    if not mask.any():
        yield curve
        return
    at = np.flatnonzero(mask[1:] != mask[:-1])
    low, high, before = t[at], t[at + 1], mask[at]
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        same = hidden(middle) == before if len(middle) else before
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    shows = not mask[0]
    for a, b in pairwise([float(t[0]), *low.tolist(), float(t[-1])]):
        if shows and b - a > _NONE * (t[-1] - t[0]):
            yield curve.trimmed(a, b)
        shows = not shows
