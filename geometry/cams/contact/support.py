"""How far outlines reach in a direction: what a straight face rests on."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from geometry.base.roots import halved
from geometry.curves.curve import Complex, Curve, Real
from geometry.curves.line_arc import Arc, Line
from geometry.plane.profile import Profile

_SAMPLES, _STEPS = 65, 30


def support(profile: Profile, direction: Complex) -> tuple[Real, Complex]:
    """The greatest height of an outline in each unit direction (n,), mm, and the point that has it."""
    best, where = np.full(direction.shape, -np.inf), np.zeros(direction.shape, dtype=complex)
    for segment in profile.period:
        height, point = _of_curve(segment.curve, direction)
        better = height > best
        best, where = np.where(better, height, best), np.where(better, point, where)
    return best, where


def _of_curve(curve: Curve, direction: Complex) -> tuple[Real, Complex]:
    """The greatest height of a curve in each direction (n,), and the point that has it."""
    if isinstance(curve, Arc):
        # the arc's own point in that direction, where it has one
        spoke = curve.radius * direction * math.copysign(1.0, curve.sweep)
        swept = np.mod(math.copysign(1.0, curve.sweep) * (np.angle(spoke) - curve.start_angle), 2 * math.pi)
        inner = np.where(swept <= abs(curve.sweep), swept, 0.0)
        points = np.stack(
            [curve.point(inner), *(np.full(direction.shape, p) for p in curve.point(np.array(curve.domain)))]
        )
    else:
        t = np.linspace(*curve.domain, _SAMPLES)
        heights = (np.conj(direction)[:, None] * curve.point(t)).real
        at = np.argmax(heights, axis=1)
        tried = [t[at]]
        if not isinstance(curve, Line):
            # a curve that closes goes on before its first place and after its last one
            last = len(t) - 1
            beyond = np.where(at == 0, last, np.where(at == last, 0, at))
            tried += [_climbed(curve, direction, t, beside) for beside in (at, beyond)]
        points = np.stack([curve.point(parameter) for parameter in tried])
    heights = (np.conj(direction) * points).real
    chosen = np.argmax(heights, axis=0)
    lanes = np.arange(len(direction))
    return heights[chosen, lanes], points[chosen, lanes]


def _climbed(curve: Curve, direction: Complex, t: Real, at: Any) -> Real:
    """Parameters of greatest height beside samples: bisection of the slope between the neighbours."""
    low, high = t[np.maximum(at - 1, 0)], t[np.minimum(at + 1, len(t) - 1)]
    low, high = halved(lambda at: (np.conj(direction) * curve.derivative(at)).real > 0, low, high, _STEPS)
    return np.asarray((low + high) / 2)
