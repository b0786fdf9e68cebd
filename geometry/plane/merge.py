"""Merging edges that are too short for a machine, within the tolerance and with the error measured."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from geometry.plane.contour import Contour, edge_points
from geometry.plane.measure import distance_to_chain, distance_to_profile
from geometry.plane.profile import Profile

_SHARES = np.linspace(0, 1, 65)
# what 65 samples of a smooth error may miss of its peak
_SAMPLING = 1.01
Indices = NDArray[np.intp]


def merge_short_edges(
    contour: Contour, edges: Indices, profile: Profile, tolerance: float, least_edge: float
) -> tuple[Contour, float]:
    """The contour without the short edges that can go, and the error of the edges that changed (0: none did).

    A short edge gives way to its middle point; its neighbours are bent to end there. The change stays only
    where all remains within the tolerance; the error is sampled, both ways. ``edges``: how many stand for each curve
    of the period; only an edge that stands for a whole curve is tried: curves of several have about the least number.
    """
    worst = 0.0
    chain = _Chain(contour, np.repeat(np.arange(len(edges)), edges), profile)
    lone = edges[chain.owners] == 1
    aside: Real | None = None
    while len(chain.contour) > 4:
        lengths = np.abs(chain.contour.period_ends() - chain.contour.vertices)
        lengths[~lone] = np.inf
        shortest = int(np.argmin(lengths))
        if lengths[shortest] >= least_edge:
            break
        candidate, beside, error = _without_edge(chain, shortest, tolerance)
        if error <= tolerance:
            # what it leaves aside changes for the curves beside it only
            aside = chain.left_aside(range(len(edges))) if aside is None else aside
            changed = aside.copy()
            changed[np.array(beside) % len(edges)] = candidate.left_aside(beside)
            error = _SAMPLING * max(error, float(changed.max()))
            if error <= tolerance:
                chain, aside, worst = candidate, changed, max(worst, error)
                gone = (shortest + 1) % len(lone)
                lone = np.delete(lone, gone)
                shortest -= gone < shortest
        lone[shortest] = False
    return chain.contour, worst


class _Chain(Record):
    """A contour, the curve of the profile's period that each edge stands for, and the profile.

    Edges and curves are numbered on beyond the period, where they are turned by its pitch, and before it.
    """

    contour: Contour
    owners: Indices
    profile: Profile

    def left_aside(self, curves: range) -> Real:
        """Greatest distance of some exact curves from the contour, sampled, mm: what a merged corner leaves aside."""
        return np.array([self._aside(number) for number in curves])

    def _aside(self, number: int) -> float:
        count = len(self.profile.period)
        index = number % count
        curve = self.profile.period[index].curve
        samples = curve.point(np.linspace(*curve.domain, len(_SHARES)))
        # the edges of this curve and of those beside it, and one more where they have none left
        owners = np.concatenate([self.owners - count, self.owners, self.owners + count])
        first, last = np.searchsorted(owners, (index - 1, index + 2)) - len(self.owners)
        k = np.arange(first - 1, last + 1)
        turn = np.exp(1j * self.contour.pitch_angle * (k // len(self.owners)))
        k = k % len(self.owners)
        starts, ends = self.contour.vertices[k] * turn, self.contour.period_ends()[k] * turn
        return float(_distance_to_edges(samples, starts, ends, self.contour.bulges[k]).min(axis=0).max())

    def distance(self, points: Complex, curves: range, tolerance: float) -> float:
        """Greatest distance of points beside some curves from the profile, mm."""
        if self.profile.count > 1:
            return float(distance_to_profile(points, self.profile, trusted=tolerance).max())
        period = self.profile.period
        near = range(curves.start - 1, min(curves.stop + 1, curves.start - 1 + len(period)))
        return float(distance_to_chain(points, [period[k % len(period)].curve for k in near], trusted=tolerance).max())


def _without_edge(chain: _Chain, index: int, tolerance: float) -> tuple[_Chain, range, float]:
    """The chain with edge ``index`` collapsed to its middle, the curves beside it, and the error of both its edges."""
    contour = chain.contour
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
    owners, count = chain.owners.copy(), len(chain.profile.period)
    first, last = owners[before] - count * (index == 0), owners[after] + count * (index == n - 1)
    owners[index] = last
    changed = _Chain(
        Contour(vertices[keep], new_bulges[keep], contour.count, contour.clockwise), owners[keep], chain.profile
    )
    points = edge_points(
        np.array([first_start, middle]),
        np.array([middle, second_end]),
        np.array([new_bulges[before], new_bulges[index]]),
        _SHARES,
    )
    beside = range(first, last + 1)
    return changed, beside, chain.distance(points.ravel(), beside, tolerance)


def _distance_to_edges(points: Complex, starts: Complex, ends: Complex, bulges: Real) -> Real:
    """Distances (edges, points) of points from lines and arcs, mm."""
    start, end, bulge = starts[:, None], ends[:, None], bulges[:, None]
    chord = end - start
    share = np.clip(((points - start) * np.conj(chord)).real / np.abs(chord) ** 2, 0, 1)
    straight = np.abs(points - start - share * chord)
    with np.errstate(divide="ignore", invalid="ignore"):
        centre = (start + end) / 2 + 1j * chord * (1 - bulge**2) / (4 * bulge)
        swept = np.angle((points - centre) / (start - centre)) * np.sign(bulge)
        radial = np.abs(np.abs(points - centre) - np.abs(start - centre))
    tips = np.minimum(np.abs(points - start), np.abs(points - end))
    bent = np.where((swept % (2 * np.pi)) <= 4 * np.arctan(np.abs(bulge)), radial, tips)
    return np.where(bulge == 0, straight, bent)


def _bulge_like(edge: tuple[complex, complex, float], start: complex, end: complex) -> float:
    """Bulge of an edge between moved ends with the same curvature as the old one."""
    old_start, old_end, bulge = edge
    if bulge == 0:
        return 0.0
    curvature = 4 * bulge / (abs(old_end - old_start) * (1 + bulge**2))
    half_sine = np.clip(curvature * abs(end - start) / 2, -1, 1)
    return float(np.tan(np.arcsin(half_sine) / 2))
