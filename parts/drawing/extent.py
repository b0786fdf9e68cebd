"""How far curves reach in a direction, and where a straight line crosses an outline, exactly."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator
from functools import partial

import numpy as np

from geometry.base.roots import bracketed_root
from geometry.curves.curve import Curve
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
    t = np.linspace(*curve.domain, _SAMPLES)
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
    return max(crossings(profile, 0j, cmath.rect(1.0, angle)))


def crossings(profile: Profile, start: complex, way: complex) -> list[float]:
    """How far from a place along a direction of length 1 an outline crosses the straight line through both, mm."""
    found, ends = [], []
    for segment in profile.segments():
        curve = segment.curve
        t = np.linspace(*curve.domain, _SAMPLES)
        seen = (curve.point(t) - start) / way
        above = seen.imag >= 0
        ends.append((above[0], above[-1], float(seen[0].real)))
        for k in np.flatnonzero(above[:-1] != above[1:]):
            # an end that all but lies on the line may be off it to the other side where it is asked for alone
            sides = float(seen[k].imag), float(seen[k + 1].imag)
            off = partial(_off, curve, start, way)
            at = bracketed_root(off, float(t[k]), float(t[k + 1]), at_ends=sides).value
            found.append(((complex(curve.point(at)) - start) / way).real)
    # where segments meet on the line itself rounding puts their ends on one side or on both
    found += [at for (_, before, _), (after, _, at) in zip(ends[-1:] + ends[:-1], ends, strict=True) if before != after]
    return found


def _off(curve: Curve, start: complex, way: complex, t: float) -> float:
    """How far a curve is on the left of a line."""
    return ((complex(curve.point(t)) - start) / way).imag


def _rate(curve: Curve, way: complex, t: float) -> float:
    """How fast a curve runs in a direction."""
    return (complex(curve.derivative(t)) / way).real
