"""Merging edges that are too short for a machine, within the tolerance and with the error measured."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from geometry.curves.curve import Complex, Real
from geometry.plane.contour import Contour, edge_points
from geometry.plane.measure import distance_to_profile
from geometry.plane.profile import Profile

_SHARES = np.linspace(0, 1, 65)
# what 65 samples of a smooth error may miss of its peak
_SAMPLING = 1.01


def merge_short_edges(
    contour: Contour, lone: NDArray[np.bool_], profile: Profile, tolerance: float, least_edge: float
) -> tuple[Contour, float]:
    """The contour without the short edges that can go, and the error of the edges that changed (0: none did).

    A short edge gives way to its middle point; its neighbours are bent to end there. The change stays only
    where all remains within the tolerance; the error is sampled, both ways. Only ``lone`` edges, which stand
    for a whole curve, are tried: curves of several edges have about the least number already.
    """
    worst = 0.0
    lone = lone.copy()
    while len(contour) > 4:
        lengths = np.abs(contour.period_ends() - contour.vertices)
        lengths[~lone] = np.inf
        shortest = int(np.argmin(lengths))
        if lengths[shortest] >= least_edge:
            break
        candidate, error = _without_edge(contour, shortest, profile, tolerance)
        if error <= tolerance:
            contour, worst = candidate, max(worst, error)
            gone = (shortest + 1) % len(lone)
            lone = np.delete(lone, gone)
            shortest -= gone < shortest
        lone[shortest] = False
    return contour, worst


def _without_edge(contour: Contour, index: int, profile: Profile, tolerance: float) -> tuple[Contour, float]:
    """The contour with edge ``index`` collapsed to its middle, and the error of both edges beside it."""
    n = len(contour.vertices)
    turn = np.exp(1j * contour.pitch_angle)
    starts, ends, bulges = contour.vertices, contour.period_ends(), contour.bulges
    middle = edge_points(starts[[index]], ends[[index]], bulges[[index]], np.array([0.5]))[0, 0]
    before, after = (index - 1) % n, (index + 1) % n
    old_before = (starts[before], ends[before], bulges[before])
    old_after = (starts[after], ends[after], bulges[after])
    vertices, new_bulges = contour.vertices.copy(), contour.bulges.copy()
    # the collapsed edge's start becomes the middle point; its end vertex goes
    vertices[index] = middle
    first_start = starts[before] / turn if index == 0 else starts[before]
    new_bulges[before] = _bulge_like(old_before, first_start, middle)
    second_end = ends[after] * turn if index == n - 1 else ends[after]
    new_bulges[index] = _bulge_like(old_after, middle, second_end)
    keep = np.arange(n) != after
    changed = Contour(vertices[keep], new_bulges[keep], contour.count, contour.clockwise)
    points = edge_points(
        np.array([first_start, middle]),
        np.array([middle, second_end]),
        np.array([new_bulges[before], new_bulges[index]]),
        _SHARES,
    )
    error = float(distance_to_profile(points.ravel(), profile, trusted=tolerance).max())
    if error <= tolerance:
        error = max(error, _left_aside(changed, profile))
    return changed, _SAMPLING * error


def _left_aside(contour: Contour, profile: Profile) -> float:
    """Greatest distance of the exact profile from a contour, sampled, mm: what a merged corner leaves aside."""
    samples = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, len(_SHARES))) for s in profile.period])
    turn = np.exp(1j * contour.pitch_angle)
    shifts = (1.0,) if contour.count == 1 else (1 / turn, 1.0, turn)
    best = np.full(len(samples), np.inf)
    for shift in shifts:
        starts, ends = contour.vertices * shift, contour.period_ends() * shift
        for start, end, bulge in zip(starts, ends, contour.bulges, strict=True):
            best = np.minimum(best, _distance_to_edge(samples, start, end, float(bulge)))
    return float(best.max())


def _distance_to_edge(points: Complex, start: complex, end: complex, bulge: float) -> Real:
    """Distance of points from one line or arc, mm."""
    if bulge == 0:
        chord = end - start
        share = np.clip(((points - start) * np.conj(chord)).real / abs(chord) ** 2, 0, 1)
        return np.abs(points - start - share * chord)
    centre = (start + end) / 2 + 1j * (end - start) * (1 - bulge**2) / (4 * bulge)
    swept = np.angle((points - centre) / (start - centre)) * np.sign(bulge)
    radial = np.abs(np.abs(points - centre) - abs(start - centre))
    ends = np.minimum(np.abs(points - start), np.abs(points - end))
    return np.where((swept % (2 * np.pi)) <= 4 * np.arctan(abs(bulge)), radial, ends)


def _bulge_like(edge: tuple[complex, complex, float], start: complex, end: complex) -> float:
    """Bulge of an edge between moved ends with the same curvature as the old one."""
    old_start, old_end, bulge = edge
    if bulge == 0:
        return 0.0
    curvature = 4 * bulge / (abs(old_end - old_start) * (1 + bulge**2))
    half_sine = np.clip(curvature * abs(end - start) / 2, -1, 1)
    return float(np.tan(np.arcsin(half_sine) / 2))
