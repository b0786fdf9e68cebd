"""Merging edges that are too short for a machine, within the tolerance and with the error measured."""

from __future__ import annotations

import numpy as np

from geometry.contour import Contour, edge_points
from geometry.curve import Complex, Real
from geometry.measure import distance_to_profile
from geometry.profile import Profile

_SHARES = np.linspace(0, 1, 17)


def merge_short_edges(
    contour: Contour, profile: Profile, tolerance: float, least_edge: float
) -> tuple[Contour, float]:
    """The contour without the short edges that can go, and the error of the edges that changed (0: none did).

    A short edge gives way to its middle point; its neighbours are drawn anew through a point of the exact
    curve. The change stays only where both remain within the tolerance; the error is sampled.
    """
    worst, kept = 0.0, set()
    while True:
        lengths = np.abs(contour.period_ends() - contour.vertices)
        short = [i for i in np.argsort(lengths) if lengths[i] < least_edge and _key(contour, i) not in kept]
        if not short or len(contour.vertices) * contour.count <= 4:
            return contour, worst
        candidate, error = _without_edge(contour, int(short[0]), profile)
        if error <= tolerance:
            contour, worst = candidate, max(worst, error)
        else:
            kept.add(_key(contour, short[0]))


def _key(contour: Contour, index: int) -> complex:
    return complex(contour.vertices[index])


def _without_edge(contour: Contour, index: int, profile: Profile) -> tuple[Contour, float]:
    """The contour with edge ``index`` collapsed to its middle, and the error of both edges beside it."""
    n = len(contour.vertices)
    turn = np.exp(2j * np.pi / contour.count)
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
    changed = Contour(vertices[keep], new_bulges[keep], contour.count)
    points = edge_points(
        np.array([first_start, middle]), np.array([middle, second_end]),
        np.array([new_bulges[before], new_bulges[index]]), _SHARES,
    )
    return changed, float(distance_to_profile(points.ravel(), profile).max())


def _bulge_like(edge: tuple[complex, complex, float], start: Complex | complex, end: Complex | complex) -> Real | float:
    """Bulge of an edge between moved ends with the same curvature as the old one."""
    old_start, old_end, bulge = edge
    if bulge == 0:
        return 0.0
    curvature = 4 * bulge / (abs(old_end - old_start) * (1 + bulge**2))
    half_sine = np.clip(curvature * abs(end - start) / 2, -1, 1)
    return float(np.tan(np.arcsin(half_sine) / 2))
