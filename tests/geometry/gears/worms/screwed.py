"""Points of a worm's thread by the screw alone, which no writer and no check of the program goes by."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from geometry.curves.curve import Complex, Real
from geometry.gears.worms.thread import Thread


def screwed(thread: Thread, plane: Complex, theta: ArrayLike, *, upper: bool = True, start: int = 0) -> Real:
    """Points (..., 3), mm, of places r + iz of the upper side turned by theta, rad, of both broadcast."""
    worm, side, angle = thread.worm, 1 if upper else -1, np.asarray(theta, float)
    out = plane.real * np.exp(1j * worm.sign * (side * angle + start * math.tau / worm.number_of_starts))
    rise = side * (plane.imag + worm.parameter * angle)
    return np.stack(np.broadcast_arrays(out.real, out.imag, rise), axis=-1)
