"""Near the fewest tangent-continuous arcs for a tolerance: one arc between points of the curve.

All joints lie on the curve. At the ends the arcs share the curve's tangents; in between they lean by about
kappa' h^2 / 12, which makes both lobes of each arc's error alike: kappa' h^3 / 125 an arc of length h, where
biarcs that share every tangent leave kappa' h^3 / 40. Derivation: DERIVATIONS.md, section 4.
"""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from geometry.base.errors import ConvergenceError
from geometry.base.record import Record
from geometry.base.roots import bracketed_root
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import Complex, Curve, Real

_DENSITY_SAMPLES = 257
_MOST_ARCS = 4096
# nodes of a curve with knots; trends of this share of an arc's length are seen; arcs beyond twice the estimate
_LEAST_NODES, _NODES_A_KNOT, _MOST_NODES = 33, 8, 1025
_SEEN, _SPARE_ARCS = 0.5, 6
_LEAST_SAMPLES, _MOST_SAMPLES = 33, 4097
# how much of the tolerance, or of the error found, the bound of what lies between samples may use
_MARGIN_SHARE = 0.03
_REFINEMENTS = 3
# samples of each arc's interval where a curve has no proven bounds, and what is added to their greatest
_BOUND_SAMPLES, _SAMPLED_MARGIN = 9, 1.1
# an end arc starts tangent to the curve and needs 1/sqrt(2) of the inner arcs' length
_END_SHARE = math.sqrt(0.5)
# the inner arcs are stretched and shrunk in turn by up to this part until the last tangent is met, this well
_STRETCHES = (0.8, -0.8)
_ENOUGH = 1e-3 * TOLERANCES.smooth_angle
# a difference below this part of its terms is rounding; the grid on which lengths are summed
_LOST, _SUM_GRID = 1e-10, 2.0**24
_STRETCH_BITS = (10, 16, 22, 28, 32, 36, 40)
_FIRST_SHARES = (0.4, 0.5, 0.6, 0.45, 0.55, 0.36)


class ArcSpline(Record):
    """Joints (n + 1,) on the curve, bulge of each arc (n,), and the proven bound of the deviation, mm."""

    parameters: Real
    points: Complex
    bulges: Real
    max_error: float
    certified: bool


class _Candidate(Record):
    """A spline whose error is only sampled, mm: what is not within a tolerance needs no proof."""

    parameters: Real
    points: Complex
    bulges: Real
    error: float

    def proven(self, curve: Curve, tolerance: float) -> ArcSpline:
        error, certified = arc_error(curve, self.parameters, self.points, self.bulges, tolerance)
        return ArcSpline(self.parameters, self.points, self.bulges, error, certified)


def arc_spline(curve: Curve, tolerance: float) -> ArcSpline:
    """G1 arcs within ``tolerance`` mm of a curve of one-signed curvature, or with knots, near the least number.

    Raises
    ------
    ConvergenceError
        More than ``_MOST_ARCS`` arcs would be needed.
    """
    if curve.knots.size:
        return _across_knots(curve, tolerance)
    return _fitted(curve, tolerance, _density(curve), _MOST_ARCS)


def _across_knots(curve: Curve, tolerance: float) -> ArcSpline:
    """Arcs that do not heed the knots: broken where the curvature turns as far as the tolerance sees.

    Where arcs need more joints than a smooth curve of that shape, both halves are fitted for themselves, at last the
    parts between the knots.
    """
    nodes, coordinate, total, turns = _seen_density(curve, tolerance)
    found = []
    for a, b in pairwise([0, *turns, len(nodes) - 1]):
        stretch = curve.trimmed(float(nodes[a]), float(nodes[b]))
        share = coordinate[b] - coordinate[a]
        density = nodes[a : b + 1], (coordinate[a : b + 1] - coordinate[a]) / share, total * share
        try:
            limit = 2 * math.ceil(density[2] / tolerance ** (1 / 3)) + _SPARE_ARCS
            found.append(_fitted(stretch, tolerance, density, limit))
        except ConvergenceError:
            knots = stretch.knots
            if knots.size <= 1:
                found += [arc_spline(part, tolerance) for part in stretch.parts()]
                continue
            middle = float(knots[len(knots) // 2])
            for low, high in pairwise((stretch.domain[0], middle, stretch.domain[1])):
                found.append(arc_spline(stretch.trimmed(low, high), tolerance))
    last = found[-1]
    return ArcSpline(
        np.concatenate([*(x.parameters[:-1] for x in found), last.parameters[-1:]]),
        np.concatenate([*(x.points[:-1] for x in found), last.points[-1:]]),
        np.concatenate([x.bulges for x in found]),
        max(x.max_error for x in found),
        all(x.certified for x in found),
    )


def _seen_density(curve: Curve, tolerance: float) -> tuple[Real, Real, float, list[int]]:
    """What ``_density`` gives, from differences over some rows, and the nodes at which the curvature's trend turns.

    A trend counts where an arc as long as it would leave the tolerance: the rest is the roughness of a table.
    """
    count = min(_MOST_NODES, max(_LEAST_NODES, _NODES_A_KNOT * curve.knots.size))
    t = np.linspace(*curve.domain, count)
    step, p = t[1] - t[0], curve.point(t)
    first, third = (p[2:-1] - p[1:-2]) / step, np.diff(p, 3) / step**3
    second = (p[3:] - p[2:-1] - p[1:-2] + p[:-3]) / (2 * step**2)
    speed, cross = np.abs(first), (np.conj(first) * second).imag
    change = (np.conj(first) * third).imag / speed**3 - 3 * cross * (np.conj(first) * second).real / speed**5
    # of each step between nodes; the first and the last have no differences of their own
    change, speed = np.pad(change, 1, mode="edge"), np.pad(speed, 1, mode="edge")
    rate = np.abs(change / speed / 125) ** (1 / 3) * speed
    lengths = (rate + 1e-6 * (rate.max() + np.finfo(float).tiny) + 1e-12 * speed) * step
    turns = _trends(np.sign(change) * lengths, _SEEN * tolerance ** (1 / 3))
    return t, *summed(lengths), turns


def _trends(signed: Real, least: float) -> list[int]:
    """Where runs of one sign end, those shorter than ``least`` being taken into the longer ones beside them."""
    ends = np.append(np.flatnonzero(np.diff(np.sign(signed))) + 1, len(signed)).tolist()
    sizes = np.abs(np.add.reduceat(signed, [0, *ends[:-1]])).tolist()
    while len(sizes) > 1:
        k = min(range(len(sizes)), key=sizes.__getitem__)
        if sizes[k] >= least:
            break
        # what lies on both sides goes on over it
        low, high = max(k - 1, 0), min(k + 1, len(sizes) - 1)
        whole = abs(sum(size for j, size in enumerate(sizes[low : high + 1], low) if j != k) - sizes[k])
        ends[low : high + 1], sizes[low : high + 1] = [ends[high]], [whole]
    return ends[:-1]


def _fitted(curve: Curve, tolerance: float, density: tuple[Real, Real, float], limit: int) -> ArcSpline:
    nodes, coordinate, total = density
    count = max(1, math.ceil(total / tolerance ** (1 / 3) * 0.9 + 0.4))
    while count <= limit:
        found = _candidate(curve, count, nodes, coordinate, tolerance)
        error = tolerance if found is None else found.error
        if found is not None and error <= tolerance:
            spline = found.proven(curve, tolerance)
            if spline.max_error <= tolerance:
                return spline
            error = spline.max_error
        count = max(count + 1, min(2 * count, math.floor(count * (error / tolerance) ** (1 / 3) * 0.97)))
    raise ConvergenceError("arcs for the tolerance", tolerance, limit)


def arc_spline_of(curve: Curve, count: int) -> ArcSpline:
    """The G1 spline of a given number of arcs.

    Raises
    ------
    ConvergenceError
        So few arcs cannot meet both end tangents.
    """
    nodes, coordinate, total = _density(curve)
    expected = (total / count) ** 3
    found = _candidate(curve, count, nodes, coordinate, expected)
    if found is None:
        raise ConvergenceError(f"{count} arcs between the end tangents", math.nan, 0)
    return found.proven(curve, expected)


def _density(curve: Curve) -> tuple[Real, Real, float]:
    """Samples, the coordinate in which arcs of equal error have equal length, and its whole length.

    The coordinate is the integral of (|d kappa / ds| / 125)^(1/3) ds; the whole is in mm^(1/3).
    """
    t = np.linspace(*curve.domain, _DENSITY_SAMPLES)
    first, second, third = (curve.derivative(t, k) for k in (1, 2, 3))
    speed, cross = np.abs(first), (np.conj(first) * second).imag
    with np.errstate(all="ignore"):
        change = (np.conj(first) * third).imag / speed**3 - 3 * cross * (np.conj(first) * second).real / speed**5
        # a difference that is nothing but rounding would have a cube root that is more
        change[np.abs(change) < _LOST * (np.abs(third) / speed**2 + 3 * np.abs(second) ** 2 / speed**3)] = 0.0
        rate = np.abs(change / speed / 125) ** (1 / 3) * speed
    # at a cusp the rate is 0/0; its limit is that of its neighbours
    known = np.isfinite(rate)
    rate = np.interp(t, t[known], rate[known]) if known.any() else np.zeros_like(t)
    # a floor keeps the coordinate strictly increasing where the curve is an arc
    rate += 1e-6 * (rate.max() + np.finfo(float).tiny) + 1e-12 * speed
    return t, *summed((rate[1:] + rate[:-1]) / 2 * np.diff(t))


def summed(lengths: Real) -> tuple[Real, float]:
    """Steps (n,) summed from 0 to 1 (n + 1,), and the whole; on so coarse a grid that no machine's rounding is seen."""
    whole = np.concatenate([[0.0], np.cumsum(lengths)])
    return np.round(whole / whole[-1] * _SUM_GRID) / _SUM_GRID, float(whole[-1])


def _candidate(curve: Curve, count: int, nodes: Real, coordinate: Real, tolerance: float) -> _Candidate | None:
    """The spline of a given number of arcs; None where the end tangent cannot be met.

    Where the curvature grows without bound towards the start (a flank near its base circle) the first lean
    is not the steady one and would swing on through all arcs: other first lengths are tried.
    """
    best = _with_first_share(curve, count, nodes, coordinate, _END_SHARE)
    expected = tolerance if best is None else 0.6 * best.error
    # one arc alone has no first length
    if count == 1 or (best is not None and (best.error <= tolerance or not _steepens(curve))):
        return best
    for share in _FIRST_SHARES:
        other = _with_first_share(curve, count, nodes, coordinate, share)
        if other is not None and (best is None or other.error < best.error):
            best = other
            if best.error <= min(tolerance, expected):
                break
    return best


def _steepens(curve: Curve) -> bool:
    """Whether the curvature at an end is many times that in the middle."""
    low, high = curve.domain
    ends = np.abs(curve.curvature(np.array([low, (low + high) / 2, high])))
    return bool(max(ends[0], ends[2]) > 4 * ends[1])


def _with_first_share(curve: Curve, count: int, nodes: Real, coordinate: Real, first: float) -> _Candidate | None:
    """The spline whose arc at the steeper end has ``first`` of the inner arcs' length."""
    shares = np.ones(count)
    if count > 1:
        low, high = np.abs(curve.curvature(np.array(curve.domain)))
        shares[0], shares[-1] = (first, _END_SHARE) if low >= high else (_END_SHARE, first)
    pattern = np.where(np.arange(count) % 2 == 0, 1.0, -1.0)
    headings = tuple(float(np.angle(curve.tangent(end))) for end in curve.domain)

    def joints(stretch: float) -> Real:
        steps = np.concatenate([[0.0], np.cumsum(shares * (1 + stretch * pattern))])
        t = np.interp(steps / steps[-1], coordinate, nodes)
        t[0], t[-1] = curve.domain
        return t

    def mismatch(stretch: float) -> float:
        return _arcs_through(curve, joints(stretch), headings)[2]

    stretch, middle = 0.0, mismatch(0.0)
    if abs(middle) > _ENOUGH:
        far = next((end for end in _STRETCHES if count > 1 and mismatch(end) * middle < 0), None)
        if far is None:
            return None
        exact = bracketed_root(mismatch, min(far, 0.0), max(far, 0.0), enough=_ENOUGH / 8).value
        # the shortest number that is good enough: joints are then the same whatever a machine rounds
        shorter = (round(exact * 2**bits) / 2**bits for bits in _STRETCH_BITS)
        stretch = next((short for short in shorter if abs(mismatch(short)) <= _ENOUGH), exact)
    t = joints(stretch)
    points, bulges, _ = _arcs_through(curve, t, headings)
    error = float(np.max(_sampled_distance(curve, t, points, bulges, _LEAST_SAMPLES)))
    return _Candidate(t, points, bulges, error)


def _arcs_through(curve: Curve, t: Real, headings: tuple[float, ...]) -> tuple[Complex, Real, float]:
    """Points, bulges of tangent arcs through them from the curve's first heading, and the last one's error."""
    points = curve.point(t)
    heading, leans = headings[0], []
    for chord in np.angle(points[1:] - points[:-1]).tolist():
        lean = math.remainder(chord - heading, 2 * math.pi)
        leans.append(lean)
        heading += 2 * lean
    return points, np.tan(np.array(leans) / 2), math.remainder(heading - headings[1], 2 * math.pi)


def arc_error(curve: Curve, t: Real, points: Complex, bulges: Real, tolerance: float) -> tuple[float, bool]:
    """Greatest distance between a curve and its arcs: samples plus a proven bound of what lies between.

    With delta(t) = |c(t) - q| - R and d = max |delta|, |delta''| <= (M1^2 k + M2 (1 + k d)) / (1 - k d),
    k = 1/R; the samples are so dense that this adds a few hundredths of the tolerance.
    """
    chord = points[1:] - points[:-1]
    curvature = 4 * bulges / (np.abs(chord) * (1 + bulges**2))
    second, certified = _second_derivative_bounds(curve, t, np.abs(curvature), tolerance)
    share = _MARGIN_SHARE * tolerance
    for _ in range(_REFINEMENTS):
        steps = float(np.max(np.diff(t) * np.sqrt(second / (8 * share)), initial=0.0))
        samples = min(_MOST_SAMPLES, max(_LEAST_SAMPLES, math.ceil(steps) + 1))
        worst = _sampled_distance(curve, t, points, bulges, samples)
        # the bound of delta'' holds while no sample is farther than it was assumed
        margin = (np.diff(t) / (samples - 1)) ** 2 / 8 * second * np.maximum(1, worst / tolerance)
        if np.max(margin) <= 2 * _MARGIN_SHARE * np.max(worst) or samples == _MOST_SAMPLES:
            break
        share = _MARGIN_SHARE * float(np.max(worst))
    scale = float(np.max(np.abs(points)))
    return float(np.max(worst + margin)) + 4 * TOLERANCES.relative_rounding * scale, certified


def _sampled_distance(curve: Curve, t: Real, points: Complex, bulges: Real, samples: int) -> Real:
    """Greatest distance of the curve's samples from each arc, without its centre, which may be far away.

    For an offset w from the arc's start with left normal n and curvature k it is
    (k |w|^2 - 2 w.n) / (1 + sqrt(1 + k (k |w|^2 - 2 w.n))).
    """
    chord = points[1:] - points[:-1]
    k = (4 * bulges / (np.abs(chord) * (1 + bulges**2)))[:, None]
    at = t[:-1, None] + np.diff(t)[:, None] * np.linspace(0, 1, samples)
    normal = 1j * chord / np.abs(chord) * np.exp(-2j * np.arctan(bulges))
    offset = curve.point(at) - points[:-1, None]
    numerator = k * np.abs(offset) ** 2 - 2 * (offset * np.conj(normal)[:, None]).real
    return np.abs(numerator / (1 + np.sqrt(np.maximum(1 + k * numerator, 0)))).max(axis=1)


def _second_derivative_bounds(curve: Curve, t: Real, k: Real, distance: float) -> tuple[Real, bool]:
    """Bound of |delta''| on each arc's interval, and whether the curve has proven derivative bounds."""
    m1, m2 = curve.derivative_bounds(t, (1, 2))
    certified = bool(np.all(np.isfinite(m1) & np.isfinite(m2)))
    if not certified:
        # samples with a margin: what is not proven shall at least not be too small
        at = t[:-1, None] + np.diff(t)[:, None] * np.linspace(0, 1, _BOUND_SAMPLES)
        m1, m2 = (_SAMPLED_MARGIN * np.abs(curve.derivative(at, order)).max(axis=1) for order in (1, 2))
    reach = np.minimum(k * distance, 0.5)
    return (m1**2 * k + m2 * (1 + reach)) / (1 - reach), certified
