"""Measuring: area of exact profiles, and distances between exact boundaries and what was made of them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from geometry.contour import arc_centres
from geometry.curve import Complex, Curve, Real
from geometry.line_arc import Arc, Line
from geometry.profile import Profile, Region

_GAUSS_POINTS = 20
_GAUSS_PANELS = 4


def profile_area(profile: Profile) -> float:
    """Signed area inside a closed profile, mm^2, by Green's theorem (counter-clockwise positive).

    Gauss quadrature of 20 points on 4 panels a segment: exact to rounding for these analytic integrands.
    """
    x, weights = np.polynomial.legendre.leggauss(_GAUSS_POINTS)
    total = 0.0
    for segment in profile.period:
        edges = np.linspace(*segment.curve.domain, _GAUSS_PANELS + 1)
        half = np.diff(edges)[:, None] / 2
        t = (edges[:-1, None] + edges[1:, None]) / 2 + half * x
        integrand = (np.conj(segment.curve.point(t)) * segment.curve.derivative(t)).imag
        total += 0.5 * float(np.sum(integrand * weights * half))
    return total * profile.count


def region_area(region: Region) -> float:
    """Area of the material, mm^2."""
    return sum(profile_area(p) for p in region.profiles())


@dataclass(frozen=True, slots=True)
class ProfileSamples:
    """Dense samples of one period: curve index, parameter and point of each, in order of travel."""

    curves: tuple[Curve, ...]
    index: NDArrayInt
    parameter: Real
    point: Complex
    pitch_angle: float


NDArrayInt = np.ndarray


def sample_profile(profile: Profile, per_curve: int) -> ProfileSamples:
    """``per_curve`` samples on every segment of one period, ends included."""
    curves = tuple(s.curve for s in profile.period)
    parameters = [np.linspace(*c.domain, per_curve) for c in curves]
    points = [c.point(t) for c, t in zip(curves, parameters, strict=True)]
    index = np.repeat(np.arange(len(curves)), per_curve)
    return ProfileSamples(curves, index, np.concatenate(parameters), np.concatenate(points), profile.pitch_angle)


def distance_to_profile(points: Complex, profile: Profile, *, per_curve: int = 33) -> Real:
    """Distance of each point from an exact profile, mm.

    Points are turned into the first period; the nearest sample of each curve starts a projection that is
    refined by Newton's method and kept inside the curve. Exact for points nearer than the samples are apart.
    """
    turn = profile.pitch_angle
    middle = _middle_angle(profile)
    period = np.round((np.angle(points) - middle) / turn)
    folded = points * np.exp(-1j * turn * period)
    best = np.full(points.shape, np.inf)
    for segment in profile.period:
        for shift in _neighbour_shifts(profile):
            near = folded * np.exp(-1j * turn * shift)
            best = np.minimum(best, _distance_to_curve(near, segment.curve, per_curve))
    return best


def _neighbour_shifts(profile: Profile) -> tuple[int, ...]:
    return (0,) if profile.count == 1 else (-1, 0, 1)


def _middle_angle(profile: Profile) -> float:
    """Polar angle about which one period lies, rad."""
    start = profile.period[0].curve.point(profile.period[0].curve.domain[0])
    return float(np.angle(start)) + profile.pitch_angle / 2


def _distance_to_curve(points: Complex, curve: Curve, per_curve: int) -> Real:
    if isinstance(curve, Arc):
        return _distance_to_arc(points, curve)
    low, high = curve.domain
    if isinstance(curve, Line):
        chord = curve.end - curve.start
        share = np.clip(((points - curve.start) * np.conj(chord)).real / abs(chord) ** 2, 0, 1)
        return np.abs(points - curve.start - share * chord)
    samples = np.linspace(low, high, per_curve)
    t = samples[_nearest_index(points, curve.point(samples))]
    for _ in range(6):
        gap, first = curve.point(t) - points, curve.derivative(t)
        slope = np.abs(first) ** 2 + (np.conj(gap) * curve.derivative(t, 2)).real
        with np.errstate(divide="ignore", invalid="ignore"):
            step = (np.conj(gap) * first).real / np.where(slope > 0, slope, np.abs(first) ** 2)
        reach = (high - low) / (per_curve - 1)
        t = np.clip(t - np.clip(np.nan_to_num(step), -reach, reach), low, high)
    return np.minimum(np.abs(curve.point(t) - points), np.abs(curve.point(samples[[0, -1]])[:, None] - points).min(0))


def _nearest_index(points: Complex, samples: Complex) -> NDArrayInt:
    """Index of the nearest sample of each point, in blocks that fit the cache."""
    result = np.zeros(points.shape, dtype=int)
    block = max(1, 2_000_000 // len(samples))
    for start in range(0, len(points), block):
        part = slice(start, start + block)
        result[part] = np.argmin(np.abs(points[part, None] - samples), axis=1)
    return result


def _distance_to_arc(points: Complex, arc: Arc) -> Real:
    sense = 1.0 if arc.sweep > 0 else -1.0
    spoke = points - arc.centre
    swept = np.mod(sense * (np.angle(spoke) - arc.start_angle), 2 * math.pi)
    radial = np.abs(np.abs(spoke) - arc.radius)
    ends = arc.point(np.array(arc.domain))
    return np.where(swept <= abs(arc.sweep), radial, np.abs(points - ends[:, None]).min(0))


def distance_to_edges(points: Complex, starts: Complex, ends: Complex, bulges: Real) -> Real:
    """Distance (n, k) of points (n, k) from edge n (line or arc) alone, mm."""
    chord = ends - starts
    length = np.abs(chord)
    share = np.clip(((points - starts[:, None]) * np.conj(chord)[:, None]).real / (length**2)[:, None], 0, 1)
    straight = np.abs(points - starts[:, None] - share * chord[:, None])
    curved = np.flatnonzero(bulges)
    if curved.size:
        centres, radii = arc_centres(starts[curved], ends[curved], bulges[curved])
        straight[curved] = np.abs(np.abs(points[curved] - centres[:, None]) - radii[:, None])
    return straight
