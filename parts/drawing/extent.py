"""How far curves reach in a direction, exactly."""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import partial

import numpy as np

from geometry.base.roots import bracketed_root
from geometry.curves.curve import Curve

# what is one place, mm
_SAME, _SAMPLES = 1e-6, 65


def farthest(curves: Iterable[Curve], way: complex) -> complex:
    """The farthest place of curves in a direction of length 1; the first of those that are equally far."""
    best = 0j
    reach = -math.inf
    for curve in curves:
        t = np.linspace(*curve.domain, _SAMPLES)
        k = int((curve.point(t) / way).real.argmax())
        low, high = t[max(k - 1, 0)], t[min(k + 1, _SAMPLES - 1)]
        if _rate(curve, way, low) > 0 > _rate(curve, way, high):
            at = bracketed_root(partial(_rate, curve, way), low, high).value
        else:
            at = t[k]
        if ((point := complex(curve.point(at))) / way).real > reach + _SAME:
            best, reach = point, (point / way).real
    return best


def _rate(curve: Curve, way: complex, t: float) -> float:
    """How fast a curve runs in a direction."""
    return (complex(curve.derivative(t)) / way).real
