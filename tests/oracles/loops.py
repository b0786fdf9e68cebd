"""Where a curve crosses itself, and the parts of an envelope that remain when its loops are cut off."""

from __future__ import annotations

import numpy as np

from geometry.base.record import Record
from geometry.curves.curve import Complex, Curve
from geometry.plane.measure import distance_to_curve
from tests.oracles.envelope import EnvelopeCurve

_SAMPLES = 1025
_NEWTON_STEPS = 30
_GAP_SAMPLES = 129


class Crossing(Record):
    """Both parameters, the smaller first, and the point in which a curve crosses itself, mm."""

    first: float
    second: float
    point: complex


def self_crossings(curve: Curve, samples: int = _SAMPLES) -> list[Crossing]:
    """Every crossing of a curve with itself that a polygon of so many samples shows, refined by Newton's method.

    Ends that meet are no crossing. Sorted by the first parameter.
    """
    t = np.linspace(*curve.domain, samples)
    points = curve.point(t)
    size = float(np.abs(points - points.mean()).max())
    found: list[Crossing] = []
    for i, j in _crossing_edges(points):
        crossing = _refined(curve, (float(t[i] + t[i + 1]) / 2, float(t[j] + t[j + 1]) / 2), size)
        if crossing is not None and all(abs(crossing.point - c.point) > 1e-9 * size for c in found):
            found.append(crossing)
    return sorted(found, key=lambda c: c.first)


def _crossing_edges(points: Complex) -> list[tuple[int, int]]:
    """Pairs of edges of an open polygon that cross, neighbours left out."""
    starts, ends = points[:-1], points[1:]
    found = []
    for i in range(len(starts) - 2):
        edge = ends[i] - starts[i]
        a = (np.conj(edge) * (starts[i + 2 :] - starts[i])).imag
        b = (np.conj(edge) * (ends[i + 2 :] - starts[i])).imag
        other = ends[i + 2 :] - starts[i + 2 :]
        c = (np.conj(other) * (starts[i] - starts[i + 2 :])).imag
        d = (np.conj(other) * (ends[i] - starts[i + 2 :])).imag
        found += [(i, i + 2 + int(k)) for k in np.flatnonzero((a * b < 0) & (c * d < 0))]
    return found


def _refined(curve: Curve, guess: tuple[float, float], size: float) -> Crossing | None:
    a, b = guess
    low, high = curve.domain
    for _ in range(_NEWTON_STEPS):
        gap = complex(curve.point(b)) - complex(curve.point(a))
        u, v = complex(curve.derivative(a)), complex(curve.derivative(b))
        whole = (u.conjugate() * v).imag
        if whole == 0:
            return None
        a = min(high, max(low, a + (gap.conjugate() * v).imag / whole))
        b = min(high, max(low, b + (gap.conjugate() * u).imag / whole))
    point, other = complex(curve.point(a)), complex(curve.point(b))
    if abs(point - other) > 1e-10 * size or b - a < 1e-9 * (high - low):
        return None
    return Crossing(a, b, (point + other) / 2)


class CutLoop(Record):
    """A loop that was cut off an envelope: its ends in t, its corner, and how far the follower parts from it, mm.

    ``clearance``: the greatest distance, along the normal, of the follower's profile from the corner on which it
    then rides; of a follower that slides along that normal this is the lost lift.
    """

    start: float
    end: float
    corner: complex
    clearance: float


def without_loops(curve: EnvelopeCurve) -> tuple[list[EnvelopeCurve], list[CutLoop]]:
    """What remains of an envelope when the loops between its cusps are cut off at their crossings.

    A loop is cut where the branch turns back between both ends of a crossing; other crossings stay.
    """
    cusps = curve.cusps()
    if not cusps.size:
        return [curve], []
    loops: list[CutLoop] = []
    at = curve.start
    kept: list[EnvelopeCurve] = []
    for crossing in self_crossings(curve):
        inside = cusps[(cusps > crossing.first) & (cusps < crossing.second)]
        if not inside.size or crossing.first < at:
            continue
        kept.append(curve.trimmed(at, crossing.first))
        loops.append(CutLoop(crossing.first, crossing.second, crossing.point, _clearance(curve, crossing)))
        at = crossing.second
    return [*kept, curve.trimmed(at, curve.end)], loops


def _clearance(curve: EnvelopeCurve, crossing: Crossing) -> float:
    """Greatest distance of the corner from the follower's profile between both ends of a loop, mm."""
    t = np.linspace(crossing.first, crossing.second, _GAP_SAMPLES)
    corner = curve.pair.seen_from_second(np.full(len(t), crossing.point), t)
    return float(distance_to_curve(corner, curve.pair.profile).max())
