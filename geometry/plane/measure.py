"""Measuring: area of exact profiles, and distances between exact boundaries and what was made of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import reduce
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from geometry.base.gauss import panels
from geometry.base.record import made_once
from geometry.curves.curve import Complex, Curve, Real, start_point
from geometry.curves.line_arc import Arc, Line
from geometry.plane.profile import Profile

_GAUSS_POINTS = 20
_GAUSS_PANELS = 4
# where one formula gives way to the next no panel is longer than such a part of the whole
_KNOT_PANELS = 32
_COARSE_SAMPLES, _FINE_SAMPLES, _LEAST_BETWEEN_KNOTS = 17, 65, 4
# by how much such a curve turns between fine samples at most, rad, unless that takes more halvings
_MOST_TURN, _HALVINGS = 0.5, 6
# distances found at once, few enough for the cache, and samples that a point is first held against
_CACHED, _WINDOW = 30_000, 300
# and those of samples to points when all of them are looked at; what a curve is longer than its chord
_AT_ONCE, _BULGE = 1_000_000, 1.2
# lines and arcs that cost less by their closed forms than by samples of all
_FEW = 4
# near a cusp the steps only halve the error, so the thorough pass takes many
_QUICK_STEPS, _THOROUGH_STEPS = 4, 24
# ends so near, mm, shut a curve
_SHUT = 1e-6
NDArrayInt = NDArray[np.int64]


class Travelled(Protocol):
    """What distances ask of a curve; splines of files give no more."""

    @property
    def domain(self) -> tuple[float, float]:
        """Parameter interval."""

    def point(self, t: ArrayLike) -> Complex:
        """Points, mm."""

    def derivatives(self, t: ArrayLike, order: int) -> list[Complex]:
        """Points and derivatives up to ``order``, mm per parameter unit to that power."""


def profile_area(profile: Profile) -> float:
    """Signed area inside a closed profile, mm^2, by Green's theorem (counter-clockwise positive).

    A profile of one period is measured about its own first point, so that a small hole far from the axis loses no
    digits. Gauss quadrature of 20 points on 4 panels a segment, or on some between its knots: exact to rounding for
    these analytic integrands where they are not wild.
    """
    return made_once(profile, "area", lambda: _area(profile))


def _area(profile: Profile) -> float:
    total = 0.0
    pole = start_point(profile.period[0].curve) if profile.count == 1 else 0j
    for segment in profile.period:
        t, weights = quadrature(segment.curve)
        integrand = (np.conj(segment.curve.point(t) - pole) * segment.curve.derivative(t)).imag
        total += 0.5 * float(np.sum(integrand * weights))
    return total * profile.count


def profile_length(profile: Profile) -> float:
    """Length of a closed profile, mm."""
    total = 0.0
    for segment in profile.period:
        t, weights = quadrature(segment.curve)
        total += float(np.sum(np.abs(segment.curve.derivative(t)) * weights))
    return total * profile.count


def quadrature(curve: Curve) -> tuple[Real, Real]:
    """Nodes and weights over a curve's domain."""
    return panels(panel_edges(curve, _GAUSS_PANELS), _GAUSS_POINTS)


def panel_edges(curve: Curve, count: int) -> Real:
    """Parameters between which a curve is one smooth formula: its knots and some between, or so many equal panels."""
    low, high = curve.domain
    if not curve.knots.size:
        return np.linspace(low, high, count + 1)
    edges = np.array([low, *curve.knots, high])
    parts = np.maximum(np.ceil(np.diff(edges) * (_KNOT_PANELS / (high - low))), 1).astype(int)
    return np.array(
        [*(a + (b - a) * k / n for a, b, n in zip(edges, edges[1:], parts, strict=False) for k in range(n)), high]
    )


def distance_to_profile(points: Complex, profile: Profile, *, trusted: float = 0.0) -> Real:
    """Distance of each point (n,) from an exact profile, mm.

    A quick pass projects each point on the curves beside its nearest coarse sample; it can only be too large,
    so what it finds above ``trusted`` mm is measured again on every curve with fine samples.
    """
    turns = (0,) if profile.count == 1 else (-1, 0, 1)
    near = np.exp([-1j * profile.pitch_angle * k for k in turns])
    return _distance(_folded(points, profile), [s.curve for s in profile.period], near, trusted)


def distance_to_nearest(points: Complex, profiles: Sequence[Profile], trusted: float) -> Real:
    """Distance of each point (n,) from the nearest profile, mm.

    The profile is found by the quick pass, which may take another for the nearest where arcs are long: a point that is
    farther than ``trusted`` mm is asked of all of them.
    """
    found = np.full(points.shape, np.inf)
    near = np.zeros(points.shape, dtype=np.int64)
    discs = [profile_disc(p) for p in profiles] if len(profiles) > 1 else []
    if discs:
        # no profile is asked of points that another's disc says to be nearer to that one
        most = reduce(np.minimum, (np.abs(points - middle) + reach for middle, reach in discs))
        for index, (profile, (middle, reach)) in enumerate(zip(profiles, discs, strict=True)):
            mine = np.flatnonzero(np.abs(points - middle) - reach <= most)
            quick = distance_to_profile(points[mine], profile, trusted=math.inf)
            nearer = quick < found[mine]
            found[mine[nearer]], near[mine[nearer]] = quick[nearer], index
    for index, profile in enumerate(profiles):
        own = np.flatnonzero(near == index)
        if own.size:
            found[own] = distance_to_profile(points[own], profile, trusted=trusted)
    for index, (middle, reach) in enumerate(discs):
        mine = np.flatnonzero((found > trusted) & (near != index) & (np.abs(points - middle) - reach < found))
        if mine.size:
            found[mine] = np.minimum(found[mine], distance_to_profile(points[mine], profiles[index], trusted=trusted))
    return found


def profile_disc(profile: Profile) -> tuple[complex, float]:
    """Middle and radius, mm, of a disc that holds a profile."""
    if profile.count > 1:
        return 0j, profile.reach()
    return _disc(np.concatenate([s.curve.point(np.linspace(*s.curve.domain, _FINE_SAMPLES)) for s in profile.period]))


def _disc(samples: Complex) -> tuple[complex, float]:
    """A disc that holds a chain by its samples, with room for what it bulges between them."""
    middle = complex(samples[0] + samples[len(samples) // 2]) / 2
    return middle, float(np.abs(samples - middle).max() + np.abs(np.diff(samples)).max())


def distance_to_chain(points: Complex, curves: Sequence[Curve], *, trusted: float = 0.0) -> Real:
    """The same of curves one behind the other, mm: a part of a profile whose other parts are farther away."""
    return _distance(points, curves, np.ones(1, dtype=complex), trusted)


def _distance(points: Complex, curves: Sequence[Curve], turns: Complex, trusted: float) -> Real:
    """Quick, then thorough where it matters: there the points are turned to the periods beside theirs too."""
    if len(turns) == 1 and len(curves) <= _FEW and all(isinstance(c, Arc | Line) for c in curves):
        return distance_to_curves(points, curves)
    result = _quick_distance(points, curves)
    doubtful = np.flatnonzero(result > trusted)
    if doubtful.size:
        result[doubtful] = _thorough_distance(points[doubtful], curves, turns, result[doubtful])
    return result


def distance_to_curve(points: Complex, curve: Travelled) -> Real:
    """Distance of each point (n,) from one curve, mm: projection from its nearest of 65 samples."""
    if isinstance(curve, Arc | Line):
        return distance_to_plain(points, curve)
    t = np.linspace(*curve.domain, _FINE_SAMPLES)
    return _projected(points, curve, t, _nearest_index(points, curve.point(t)), newton=True)


def distance_to_curves(points: Complex, curves: Sequence[Curve]) -> Real:
    """Distance of each point (n,) from the nearest of some exact curves, mm."""
    return np.min([distance_to_curve(points, curve) for curve in curves], axis=0)


def _quick_distance(points: Complex, curves: Sequence[Curve]) -> Real:
    parameters = [np.linspace(*c.domain, _COARSE_SAMPLES) for c in curves]
    samples = np.concatenate([c.point(t) for c, t in zip(curves, parameters, strict=True)])
    nearest = _nearest_index(points, samples)
    best = np.full(points.shape, np.inf)
    order = np.argsort(nearest, kind="stable")
    ranks = nearest[order]
    for index, curve in enumerate(curves):
        # a nearest sample at a joint speaks for the curves on both sides of it, round the whole
        first, last = index * _COARSE_SAMPLES - 1, (index + 1) * _COARSE_SAMPLES
        low, high, end = np.searchsorted(ranks, [first, last + 1, len(samples) - 1])
        beyond = order[end:] if first < 0 else order[:0], order[: np.searchsorted(ranks, last + 1 - len(samples))]
        mine = np.concatenate([order[low:high], *beyond])
        if mine.size:
            start = np.clip(nearest[mine] - first - 1, 0, _COARSE_SAMPLES - 1)
            found = _projected(points[mine], curve, parameters[index], start, newton=False)
            best[mine] = np.minimum(best[mine], found)
    return best


def _thorough_distance(points: Complex, curves: Sequence[Curve], turns: Complex, most: Real) -> Real:
    """On every curve that may be nearer than ``most``, what is known already."""
    best = np.full(points.shape, np.inf)
    for curve in curves:
        t = _fine(curve)
        samples = curve.point(t)
        middle, reach = _disc(samples)
        for turn in turns:
            near = points * turn
            mine = np.flatnonzero(np.abs(near - middle) - reach <= most)
            if mine.size:
                near = near[mine]
                found = _projected(near, curve, t, _nearest_index(near, samples), newton=True)
                if not isinstance(curve, Arc | Line):
                    for block in np.array_split(np.arange(len(near)), math.ceil(len(near) * len(t) / _AT_ONCE)):
                        found[block] = _on_other_branches(near[block], curve, t, samples, found[block])
                best[mine] = np.minimum(best[mine], found)
    return best


def _on_other_branches(points: Complex, curve: Curve, parameters: Real, samples: Complex, found: Real) -> Real:
    """What is ``found`` from the nearest sample, or less.

    Of a curve that comes back beside itself, or turns between samples far from each other, a piece that does not end at
    that sample may be nearer: by half of its length than its nearer end at most. The distance falls at its start then
    and rises at its end. One that ends there is asked again, from its other end, where steps from there led nowhere.
    """
    ways, spokes = curve.derivatives(parameters, 1)[1], points[:, None] - samples
    gap, falls = np.abs(spokes), (np.conj(ways) * spokes).real
    least = np.minimum(gap[:, :-1], gap[:, 1:]) - _BULGE / 2 * np.abs(np.diff(samples))
    apart = gap.argmin(axis=1)[:, None] - np.arange(len(samples) - 1)
    others = ((apart != 0) & (apart != 1)) | (found >= gap.min(axis=1))[:, None]
    row, piece = np.nonzero((falls[:, :-1] >= 0) & (falls[:, 1:] <= 0) & (least < found[:, None]) & others)
    if row.size:
        found = found.copy()
        beside = apart[row, piece]
        nearer = gap[row, piece + 1] < gap[row, piece]
        start = piece + np.where(beside == 0, True, np.where(beside == 1, False, nearer))
        np.minimum.at(found, row, _projected(points[row], curve, parameters, start, newton=True))
    return found


def _fine(curve: Curve) -> Real:
    """Parameters of fine samples: evenly, and so many between knots too, which may lie near each other.

    Between those a curve with knots turns little: where it turns more there are further ones.
    """
    even = np.linspace(*curve.domain, _FINE_SAMPLES)
    if not curve.knots.size:
        return even
    edges = np.array([even[0], *curve.knots, even[-1]])
    each = max(_LEAST_BETWEEN_KNOTS, _FINE_SAMPLES // (len(edges) - 1))
    t = np.unique(np.append(even, edges[:-1, None] + np.diff(edges)[:, None] * (np.arange(each) / each)))
    for _ in range(_HALVINGS):
        ways = curve.tangent(t)
        turns = np.flatnonzero(np.abs(np.angle(ways[1:] * np.conj(ways[:-1]))) > _MOST_TURN)
        if not turns.size:
            break
        t = np.insert(t, turns + 1, (t[turns] + t[turns + 1]) / 2)
    return t


def _folded(points: Complex, profile: Profile) -> Complex:
    """Points turned into the sector of the first period."""
    start = profile.period[0].curve.point(profile.period[0].curve.domain[0])
    period = np.floor((np.angle(points) - float(np.angle(start))) / profile.pitch_angle)
    return points * np.exp(-1j * profile.pitch_angle * period)


def _projected(points: Complex, curve: Travelled, samples: Real, start: NDArrayInt, *, newton: bool) -> Real:
    """Distance from a curve by projection from the nearest sample; the steps stay beside it.

    Without ``newton`` the curvature's part of the slope is left out, which is little for points near the curve.
    """
    if isinstance(curve, Arc | Line):
        return distance_to_plain(points, curve)
    ends = curve.point(samples[[0, -1]])
    found = np.abs(curve.point(_feet(points, curve, samples, start, newton=newton)) - points)
    # where a curve is shut, the nearest sample is its first and its last one: the foot may lie on either side
    seam = np.flatnonzero((start == 0) | (start == len(samples) - 1)) if abs(ends[1] - ends[0]) < _SHUT else start[:0]
    if seam.size:
        other = _feet(points[seam], curve, samples, len(samples) - 1 - start[seam], newton=newton)
        found[seam] = np.minimum(found[seam], np.abs(curve.point(other) - points[seam]))
    return np.minimum(found, np.abs(ends[:, None] - points).min(0))


def _feet(points: Complex, curve: Travelled, samples: Real, start: NDArrayInt, *, newton: bool) -> Real:
    """Parameters of feet by steps from samples."""
    low, high = curve.domain
    reach = (high - low) / (min(len(samples), _FINE_SAMPLES) - 1)
    t, before = samples[start], np.full(start.shape, math.nan)
    rows = np.arange(len(t))
    for left in reversed(range(_THOROUGH_STEPS if newton else _QUICK_STEPS)):
        at, mine = t[rows], points[rows]
        point, first, *second = curve.derivatives(at, 2 if newton else 1)
        gap = point - mine
        square = (np.conj(first) * first).real
        slope = square + sum((np.conj(gap) * x).real for x in second)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = (np.conj(gap) * first).real / np.where(slope > 0, slope, square)
        # in a cusp at an end, where an involute begins, every point would have its foot: half a sample inwards
        step = np.where(square > 0, step, np.where(at > (low + high) / 2, reach / 2, -reach / 2))
        # what ``np.clip`` does, at half the cost
        following = np.minimum(np.maximum(at - np.minimum(np.maximum(step, -reach), reach), low), high)
        # a foot that stays, or goes to and fro by a rounding, is where it will be after all steps, or one before
        swings = following == before[rows]
        t[rows] = np.where(swings, at if left % 2 else following, following)
        before[rows] = at
        rows = rows[(following != at) & ~swings]
        if not rows.size:
            break
    return t


def _nearest_index(points: Complex, samples: Complex) -> NDArrayInt:
    """Index of the nearest sample of each point, the first of equal ones.

    Points go in blocks along the longer side of the samples, of which those farther along it than the nearest that
    was found are not looked at.
    """
    if len(points) * len(samples) <= _CACHED:
        gap = points[:, None] - samples
        return np.argmin(gap.real**2 + gap.imag**2, axis=1)
    result = np.zeros(points.shape, dtype=np.int64)
    if np.ptp(samples.real) < np.ptp(samples.imag):
        points, samples = points * 1j, samples * 1j
    along = np.argsort(samples.real, kind="stable")
    places, order = samples.real[along], np.argsort(points.real, kind="stable")
    window = min(len(samples), _WINDOW)
    for block in np.array_split(order, math.ceil(len(points) * window / _CACHED)):
        mine = points[block]
        low, high = mine.real[0], mine.real[-1]
        beside = max(places[0] - high, low - places[-1], 0.0)
        reach = beside + (places[-1] - places[0]) * window / len(samples)
        while True:
            first, last = np.searchsorted(places, low - reach), np.searchsorted(places, high + reach, side="right")
            among = np.sort(along[first:last])
            if among.size:
                gap = mine[:, None] - samples[among]
                square = gap.real**2 + gap.imag**2
                best = np.argmin(square, axis=1)
                if among.size == len(samples) or square[np.arange(len(mine)), best].max() <= reach * reach:
                    break
            reach *= 2
        result[block] = among[best]
    return result


def distance_to_plain(points: Complex, arc: Arc | Line) -> Real:
    """Distance of points (n,) from an edge, whose feet have a closed form, mm."""
    if isinstance(arc, Line):
        chord = arc.end - arc.start
        # of no length it is its start
        share = np.clip(((points - arc.start) * np.conj(chord)).real / (abs(chord) ** 2 or 1.0), 0, 1)
        return np.abs(points - arc.start - share * chord)
    radial = np.abs(np.abs(points - arc.centre) - arc.radius)
    ends = arc.point(np.array(arc.domain))
    return np.where(arc.foot(points)[1], radial, np.abs(points - ends[:, None]).min(0))
