"""What round pins leave of a body that they sweep past: distances from dense pin positions, by rigid motions alone.

Shares no formula with geometry/curves/cycloid.py: bodies are turned and moved, nothing else.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.complex128]
Reals = NDArray[np.float64]
Centre = Callable[[Reals], Points]


def disc_pins(pins: int, radius: float, eccentricity: float) -> list[Centre]:
    """The centres of fixed pins seen from a disc of pins - 1 lobes, each over the angle of the eccentric."""

    def of(k: int) -> Centre:
        def centre(drive: Reals) -> Points:
            fixed = radius * np.exp(2j * math.pi * k / pins)
            # the disc: moved to the eccentric, turned back by one lobe a turn
            return (fixed - eccentricity * np.exp(1j * drive)) * np.exp(1j * drive / (pins - 1))

        return centre

    return [of(k) for k in range(pins)]


def lantern_pins(pins: int, teeth: int, radius: float) -> list[Centre]:
    """The centres of a lantern's pins seen from the gear, over the lantern's rotation; the gear is at the origin."""
    distance = radius * (1 + teeth / pins)

    def of(k: int) -> Centre:
        def centre(drive: Reals) -> Points:
            place = distance + radius * np.exp(1j * (math.pi + 2 * math.pi * k / pins - drive))
            return place * np.exp(-1j * drive * pins / teeth)

        return centre

    return [of(k) for k in range(pins)]


def least_distance(point: complex, centres: list[Centre], drive: Reals) -> float:
    """Least distance of a point from all pin centres over a motion: the best samples refined by golden section."""
    best = math.inf
    for centre in centres:
        away = np.abs(centre(drive) - point)
        k = int(np.argmin(away))
        if away[k] > best + 2 * np.abs(np.diff(away)).max():
            continue
        low, high = drive[max(k - 1, 0)], drive[min(k + 1, len(drive) - 1)]
        ratio = (math.sqrt(5) - 1) / 2
        for _ in range(60):
            a, b = high - ratio * (high - low), low + ratio * (high - low)
            first, second = np.abs(centre(np.array([a, b])) - point)
            low, high = (low, b) if first < second else (a, high)
        best = min(best, float(np.abs(centre(np.array([(low + high) / 2]))[0] - point)))
    return best
