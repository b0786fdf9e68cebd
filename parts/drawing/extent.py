"""How far curves reach in a direction, and where a straight line crosses an outline, exactly."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator
from functools import partial
from typing import NamedTuple

import numpy as np

from geometry.base.roots import bracketed_root
from geometry.curves.curve import Complex, Curve, Real
from geometry.curves.line_arc import Line
from geometry.plane.profile import Profile

# what is one place, mm
_SAME, _SAMPLES = 1e-6, 65


def farthest(curves: Iterable[Curve], way: complex) -> complex:
    """The farthest place of curves in a direction of length 1; the first of those that are equally far."""
    best = 0j
    reach = -math.inf
    for point in (at for curve in curves for at in summits(curve, way)):
        if (point / way).real > reach + _SAME:
            best, reach = point, (point / way).real
    return best


def summits(curve: Curve, way: complex) -> Iterator[complex]:
    """The places of a curve that are no less far in a direction of length 1 than those beside them."""
    # a straight line has no summits but its ends
    t = np.linspace(*curve.domain, 2 if isinstance(curve, Line) else _SAMPLES)
    ahead = (curve.point(t) / way).real
    # the seam of a closed curve is both of its ends
    beside = np.maximum(np.append(ahead[1:], -math.inf), np.insert(ahead[:-1], 0, -math.inf))
    for k in np.flatnonzero(ahead >= beside - _SAME).tolist():
        low, high = t[max(k - 1, 0)], t[min(k + 1, len(t) - 1)]
        if _rate(curve, way, low) > 0 > _rate(curve, way, high):
            yield complex(curve.point(bracketed_root(partial(_rate, curve, way), low, high).value))
        else:
            yield complex(curve.point(t[k]))


def reach(profile: Profile, angle: float) -> float:
    """How far a profile about the origin is from there in a direction (rad), mm."""
    return max(crossings(sampled(profile), 0j, cmath.rect(1.0, angle)))


class Sampled(NamedTuple):
    """The curves of an outline with places along each, a row a curve: their parameters, their points."""

    curves: list[Curve]
    t: Real
    points: Complex


def sampled(profile: Profile) -> Sampled:
    """An outline, to be asked more than once where lines cross it."""
    curves = [segment.curve for segment in profile.segments()]
    t = np.array([np.linspace(*curve.domain, _SAMPLES) for curve in curves])
    return Sampled(curves, t, np.array([curve.point(row) for curve, row in zip(curves, t, strict=True)]))


def crossings(outline: Sampled, start: complex, way: complex) -> list[float]:
    """How far from a place along a direction of length 1 an outline crosses the straight line through both, mm."""
    found, seen = [], (outline.points - start) / way
    above = seen.imag >= 0
    for row, k in np.argwhere(above[:, :-1] != above[:, 1:]).tolist():
        # an end that all but lies on the line may be off it to the other side where it is asked for alone
        curve, t, sides = outline.curves[row], outline.t[row], (float(seen[row, k].imag), float(seen[row, k + 1].imag))
        at = bracketed_root(partial(_off, curve, start, way), float(t[k]), float(t[k + 1]), at_ends=sides).value
        found.append(((complex(curve.point(at)) - start) / way).real)
    # where segments meet on the line itself rounding puts their ends on one side or on both
    return found + seen[above[:, 0] != np.roll(above[:, -1], 1), 0].real.tolist()


def _off(curve: Curve, start: complex, way: complex, t: float) -> float:
    """How far a curve is on the left of a line."""
    return ((complex(curve.point(t)) - start) / way).imag


def _rate(curve: Curve, way: complex, t: float) -> float:
    """How fast a curve runs in a direction."""
    return (complex(curve.derivative(t)) / way).real
