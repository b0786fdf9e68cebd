"""Measuring: area of exact profiles, and distances between exact boundaries and what was made of them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import reduce
from itertools import pairwise
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from geometry.base.gauss import panels
from geometry.base.record import made_once
from geometry.curves.alike import Alike, Travelled, by_formula, evenly, sampled
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
# points with a curve each that are asked together
_PAIRS = 200_000
# lines and arcs that cost less by their closed forms than by samples of all
_FEW = 4
# near a cusp the steps only halve the error, so the thorough pass takes many
_QUICK_STEPS, _THOROUGH_STEPS = 4, 24
# part of a sample's distance of which the last step is the last: the next one is its square
_STILL = 1e-12
# ends so near, mm, shut a curve
_SHUT = 1e-6
NDArrayInt = NDArray[np.int64]
# numbers of points, each with that of a curve, and where it stands turned to it
_Asked: TypeAlias = tuple[NDArrayInt, NDArrayInt, Complex]


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
    return distance_to_own([points], [profile], trusted=trusted)[0]


def distance_to_own(places: Sequence[Complex], profiles: Sequence[Profile], *, trusted: float = 0.0) -> list[Real]:
    """The same of many profiles, each of places of its own; what one formula gives in all of them is asked together."""
    turns = [(0,) if p.count == 1 else (-1, 0, 1) for p in profiles]
    near = [np.exp([-1j * p.pitch_angle * k for k in some]) for p, some in zip(profiles, turns, strict=True)]
    chains = [[s.curve for s in p.period] for p in profiles]
    return _distances([_folded(x, p) for x, p in zip(places, profiles, strict=True)], chains, near, trusted)


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
    middles, reaches = _discs(samples[None])
    return complex(middles[0]), float(reaches[0])


def _discs(samples: Complex) -> tuple[Complex, Real]:
    """The same of many chains (n, samples)."""
    middles = (samples[:, 0] + samples[:, samples.shape[1] // 2]) / 2
    return middles, np.abs(samples - middles[:, None]).max(axis=1) + np.abs(np.diff(samples)).max(axis=1)


def distance_to_chain(points: Complex, curves: Sequence[Curve], *, trusted: float = 0.0) -> Real:
    """The same of curves one behind the other, mm: a part of a profile whose other parts are farther away."""
    return _distances([points], [curves], [np.ones(1, dtype=complex)], trusted)[0]


def _distances(
    places: Sequence[Complex], chains: Sequence[Sequence[Curve]], turns: Sequence[Complex], trusted: float
) -> list[Real]:
    """Quick, then thorough where it matters: there the points are turned to the periods beside theirs too."""
    plain = [
        len(near) == 1 and len(chain) <= _FEW and all(isinstance(c, Arc | Line) for c in chain)
        for chain, near in zip(chains, turns, strict=True)
    ]
    found = [
        distance_to_curves(x, c) if known else np.zeros(0) for x, c, known in zip(places, chains, plain, strict=True)
    ]
    rest = [k for k, known in enumerate(plain) if not known and places[k].size]
    if not rest:
        return found
    points, own = _joined([places[k] for k in rest])
    asked = [chains[k] for k in rest]
    result = _quick_distance(points, own, asked)
    doubtful = np.flatnonzero(result > trusted)
    if doubtful.size:
        near = [turns[k] for k in rest]
        result[doubtful] = _thorough_distance(points[doubtful], own[doubtful], asked, near, result[doubtful])
    for k, mine in zip(rest, np.split(result, np.cumsum([places[k].size for k in rest])[:-1]), strict=True):
        found[k] = mine
    return found


def _joined(places: Sequence[Complex]) -> tuple[Complex, NDArrayInt]:
    """All of them one behind the other, and the number of the part that each is of."""
    return np.concatenate(places), np.repeat(np.arange(len(places)), [x.size for x in places])


def distance_to_curve(points: Complex, curve: Travelled) -> Real:
    """Distance of each point (n,) from one curve, mm: projection from its nearest of 65 samples."""
    if isinstance(curve, Arc | Line):
        return distance_to_plain(points, curve)
    alone = evenly([curve], _FINE_SAMPLES)
    start = _nearest_index(points, alone.points[0])
    return _projected(points, alone, np.zeros_like(start), start, newton=True)


def distance_to_curves(points: Complex, curves: Sequence[Curve]) -> Real:
    """Distance of each point (n,) from the nearest of some exact curves, mm."""
    return np.min([distance_to_curve(points, curve) for curve in curves], axis=0)


def _quick_distance(points: Complex, own: NDArrayInt, chains: Sequence[Sequence[Curve]]) -> Real:
    """Distances of points from the curves of their own chains beside the nearest coarse samples."""
    curves = [c for chain in chains for c in chain]
    groups = [(k, evenly([curves[i] for i in k], _COARSE_SAMPLES)) for k in by_formula(curves)]
    samples = np.empty((len(curves), _COARSE_SAMPLES), dtype=complex)
    for numbers, group in groups:
        samples[numbers] = group.points
    last, edges = _COARSE_SAMPLES - 1, np.cumsum([0, *map(len, chains)])
    asked: list[tuple[NDArrayInt, NDArrayInt, NDArrayInt]] = []
    for chain, (low, high) in enumerate(pairwise(edges.tolist())):
        mine = np.flatnonzero(own == chain)
        which, start = np.divmod(_nearest_index(points[mine], samples[low:high].ravel()), _COARSE_SAMPLES)
        asked.append((mine, low + which, start))
        # a nearest sample at a joint speaks for the curves on both sides of it, round the whole
        for at, step in ((0, -1), (last, 1)):
            joint = np.flatnonzero(start == at)
            asked.append((mine[joint], low + (which[joint] + step) % (high - low), last - start[joint]))
    rows, which, start = (np.concatenate(x) for x in zip(*asked, strict=True))
    best = np.full(points.shape, np.inf)
    place = np.empty(len(curves), dtype=np.int64)
    for numbers, group in groups:
        place[:], place[numbers] = -1, np.arange(len(numbers))
        mine = np.flatnonzero(place[which] >= 0)
        if mine.size:
            asking = rows[mine]
            np.minimum.at(
                best, asking, _projected(points[asking], group, place[which[mine]], start[mine], newton=False)
            )
    return best


def _thorough_distance(
    points: Complex, own: NDArrayInt, chains: Sequence[Sequence[Curve]], turns: Sequence[Complex], most: Real
) -> Real:
    """On every curve of its chain that may be nearer to a point than ``most``, what is known already."""
    best = np.full(points.shape, np.inf)
    curves = [c for chain in chains for c in chain]
    chain_of = np.repeat(np.arange(len(chains)), [*map(len, chains)])
    rows_of = [np.flatnonzero(own == k) for k in range(len(chains))]
    nears = [[points[rows] * turn for turn in some] for rows, some in zip(rows_of, turns, strict=True)]

    def asked(numbers: NDArrayInt, group: Alike) -> Iterator[_Asked]:
        """The points, each with every curve that may be so near."""
        middles, reaches = _discs(group.points)
        for chain in np.unique(chain_of[numbers]).tolist():
            places = np.flatnonzero(chain_of[numbers] == chain)
            for near in nears[chain]:
                for block in np.array_split(np.arange(near.size), math.ceil(near.size * len(places) / _PAIRS)):
                    rows, at = rows_of[chain][block], near[block]
                    row, column = np.nonzero(
                        np.abs(at[:, None] - middles[places]) - reaches[places] <= most[rows, None]
                    )
                    if row.size:
                        yield rows[row], places[column], at[row]

    for numbers in by_formula(curves):
        some = [curves[i] for i in numbers]
        group = evenly(some, _FINE_SAMPLES) if len(some) > 1 else sampled(some, _fine(some[0])[None])
        for rows, which, near in _batches(asked(numbers, group)):
            blocks = np.array_split(np.arange(near.size), math.ceil(near.size * group.parameters.shape[1] / _AT_ONCE))
            if group.whole is None:
                start = _nearest_index(near, group.points[0])
            else:
                start = np.concatenate([np.abs(near[x, None] - group.points[which[x]]).argmin(axis=1) for x in blocks])
            found = _projected(near, group, which, start, newton=True)
            if not isinstance(some[0], Arc | Line):
                for block in blocks:
                    found[block] = _on_other_branches(near[block], group, which[block], found[block])
            np.minimum.at(best, rows, found)
    return best


def _batches(parts: Iterator[_Asked]) -> Iterator[_Asked]:
    """Small parts put together: of a wrong file every point is asked of every curve, which are too many at once."""
    held: list[_Asked] = []
    for part in parts:
        held.append(part)
        if sum(rows.size for rows, _, _ in held) > _PAIRS:
            yield _one(held)
            held = []
    if held:
        yield _one(held)


def _one(held: list[_Asked]) -> _Asked:
    rows, which, points = (np.concatenate(x) for x in zip(*held, strict=True))
    return rows, which, points


def _on_other_branches(points: Complex, group: Alike, which: NDArrayInt, found: Real) -> Real:
    """What is ``found`` from the nearest sample, or less.

    Of a curve that comes back beside itself, or turns between samples far from each other, a piece that does not end at
    that sample may be nearer: by half of its length than its nearer end at most. The distance falls at its start then
    and rises at its end. One that ends there is asked again, from its other end, where steps from there led nowhere.
    """
    samples = group.points[which]
    spokes = points[:, None] - samples
    gap, falls = np.abs(spokes), (np.conj(group.ways[which]) * spokes).real
    least = np.minimum(gap[:, :-1], gap[:, 1:]) - _BULGE / 2 * np.abs(np.diff(samples))
    apart = gap.argmin(axis=1)[:, None] - np.arange(samples.shape[1] - 1)
    others = ((apart != 0) & (apart != 1)) | (found >= gap.min(axis=1))[:, None]
    row, piece = np.nonzero((falls[:, :-1] >= 0) & (falls[:, 1:] <= 0) & (least < found[:, None]) & others)
    if row.size:
        found = found.copy()
        beside = apart[row, piece]
        nearer = gap[row, piece + 1] < gap[row, piece]
        start = piece + np.where(beside == 0, True, np.where(beside == 1, False, nearer))
        np.minimum.at(found, row, _projected(points[row], group, which[row], start, newton=True))
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


def _projected(points: Complex, group: Alike, which: NDArrayInt, start: NDArrayInt, *, newton: bool) -> Real:
    """Distance of each point from one curve of a group by projection from its nearest sample; steps stay beside it.

    Without ``newton`` the curvature's part of the slope is left out, which is little for points near the curve.
    """
    if group.whole is None and isinstance(plain := group.curves[0], Arc | Line):
        return distance_to_plain(points, plain)
    curve, last = group.of(which), group.points.shape[1] - 1
    ends = group.points[:, [0, -1]]
    if isinstance(curve, Arc):
        inside = curve.swept(points) <= group.parameters[which, -1]
        radial = np.abs(np.abs(points - curve.centre) - curve.radius)
        return np.where(inside, radial, np.abs(ends[which] - points[:, None]).min(1))
    found = np.abs(curve.point(_feet(points, group, which, start, newton=newton)) - points)
    # where a curve is shut, the nearest sample is its first and its last one: the foot may lie on either side
    shut = (np.abs(ends[:, 1] - ends[:, 0]) < _SHUT)[which]
    seam = np.flatnonzero(shut & ((start == 0) | (start == last)))
    if seam.size:
        other = _feet(points[seam], group, which[seam], last - start[seam], newton=newton)
        found[seam] = np.minimum(found[seam], np.abs(group.of(which[seam]).point(other) - points[seam]))
    return np.minimum(found, np.abs(ends[which] - points[:, None]).min(1))


def _feet(points: Complex, group: Alike, which: NDArrayInt, start: NDArrayInt, *, newton: bool) -> Real:
    """Parameters of feet by steps from samples."""
    lows, highs = group.parameters[which, 0], group.parameters[which, -1]
    reaches = (highs - lows) / (min(group.parameters.shape[1], _FINE_SAMPLES) - 1)
    t, before = group.parameters[which, start], np.full(start.shape, math.nan)
    rows = np.arange(len(t))
    for left in reversed(range(_THOROUGH_STEPS if newton else _QUICK_STEPS)):
        at, mine, low, high, reach = t[rows], points[rows], lows[rows], highs[rows], reaches[rows]
        point, first, *second = group.of(which[rows]).derivatives(at, 2 if newton else 1)
        gap = point - mine
        square = (np.conj(first) * first).real
        slope = square + sum((np.conj(gap) * x).real for x in second)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = (np.conj(gap) * first).real / np.where(slope > 0, slope, square)
        # in a cusp at an end, where an involute begins, every point would have its foot: half a sample inwards
        if not square.all():
            step = np.where(square > 0, step, np.where(at > (low + high) / 2, reach / 2, -reach / 2))
        # what ``np.clip`` does, at half the cost
        following = np.minimum(np.maximum(at - np.minimum(np.maximum(step, -reach), reach), low), high)
        # a foot that all but stays, or goes to and fro by a rounding, is where all steps bring it, or one before
        swings = following == before[rows]
        t[rows] = np.where(swings, at if left % 2 else following, following)
        before[rows] = at
        rows = rows[(np.abs(following - at) > _STILL * reach) & ~swings]
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
