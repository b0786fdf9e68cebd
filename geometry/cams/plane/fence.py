"""On which side of a closed outline points lie: a fine polygon for most, the exact curves for what is near them."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from geometry.base.record import Record
from geometry.base.roots import halved
from geometry.curves.curve import Complex, Curve, Real
from geometry.plane.distance import Flags
from geometry.plane.measure import distance_to_profile
from geometry.plane.profile import Profile

_SAMPLES, _STEPS, _CHUNK = 65, 40, 2048


class Fence(Record, dict=True):
    """A closed outline of one period, and points along it."""

    profile: Profile

    @cached_property
    def _samples(self) -> tuple[Complex, Any, Real]:
        """Corners of the polygon, and the curve and parameter of each."""
        points, owners, places = [], [], []
        for index, segment in enumerate(self.profile.period):
            t = np.linspace(*segment.curve.domain, _SAMPLES)[:-1]
            points.append(segment.curve.point(t))
            owners.append(np.full(len(t), index))
            places.append(t)
        return np.concatenate(points), np.concatenate(owners), np.concatenate(places)

    @cached_property
    def _thickness(self) -> float:
        """How far the curves bulge beyond the polygon, mm, with room: from their middles."""
        worst = 0.0
        for segment in self.profile.period:
            t = np.linspace(*segment.curve.domain, 2 * _SAMPLES - 1)
            points = segment.curve.point(t)
            worst = max(worst, float(np.abs(points[1::2] - (points[:-1:2] + points[2::2]) / 2).max()))
        return 2 * worst

    def holds(self, points: Complex) -> Any:
        """Whether points lie within the outline, whichever way it runs: crossings of a ray, near it the exact side."""
        corners, room = self._samples[0], self._thickness
        box = (points.real > corners.real.min() - room) & (points.real < corners.real.max() + room)
        box &= (points.imag > corners.imag.min() - room) & (points.imag < corners.imag.max() + room)
        rows = np.flatnonzero(box)
        found, near, apart = np.zeros(points.shape, dtype=bool), np.zeros(len(rows), dtype=int), np.zeros(len(rows))
        for k in range(0, len(rows), _CHUNK):
            some = points[rows[k : k + _CHUNK]]
            found[rows[k : k + _CHUNK]] = self._crossed(some)
            away = np.abs(some[:, None] - corners)
            near[k : k + _CHUNK], apart[k : k + _CHUNK] = away.argmin(axis=1), away.min(axis=1)
        # where the polygon differs from the curves, these tell
        close = apart < self._step
        rows, near = rows[close], near[close]
        if rows.size:
            close = distance_to_profile(points[rows], self.profile) <= room
            rows, near = rows[close], near[close]
            found[rows] = self._beside(points[rows], near)
        return found

    @cached_property
    def _step(self) -> float:
        corners = self._samples[0]
        return float(np.abs(np.roll(corners, -1) - corners).max()) + self._thickness

    def _crossed(self, points: Complex) -> Any:
        start = self._samples[0]
        end = np.roll(start, -1)
        x, y = points.real[:, None], points.imag[:, None]
        across = (start.imag > y) != (end.imag > y)
        with np.errstate(divide="ignore", invalid="ignore"):
            at = start.real + (y - start.imag) * (end.real - start.real) / (end.imag - start.imag)
        return (across & (x < at)).sum(axis=1) % 2 == 1

    def _beside(self, points: Complex, near: Any) -> Any:
        """The exact side of points: that of the nearer of the two arcs that meet at their nearest corners.

        Where the foot is the corner itself the point lies in its normal cone, and both tangents tell the same.
        """
        _, owners, places = self._samples
        best, left = np.full(points.shape, np.inf), np.zeros(points.shape, dtype=bool)
        for edge in ((near - 1) % len(owners), near):
            for index in np.unique(owners[edge]):
                mine = np.flatnonzero(owners[edge] == index)
                curve, start, to = self.profile.period[int(index)].curve, places[edge][mine], points[mine]
                end = start + (curve.domain[1] - curve.domain[0]) / (_SAMPLES - 1)

                def ahead(t: Real, curve: Curve = curve, to: Complex = to) -> Flags:
                    return np.asarray((np.conj(curve.derivative(t)) * (to - curve.point(t))).real > 0)

                a, _ = halved(ahead, start, end, _STEPS)
                spoke = to - curve.point(a)
                nearer = np.abs(spoke) < best[mine]
                best[mine] = np.where(nearer, np.abs(spoke), best[mine])
                left[mine] = np.where(nearer, (np.conj(curve.derivative(a)) * spoke).imag > 0, left[mine])
        return left == self._runs_left

    @cached_property
    def _runs_left(self) -> bool:
        """Whether the outline runs counter-clockwise."""
        corners = self._samples[0]
        return bool((np.conj(corners) * np.roll(corners, -1)).imag.sum() > 0)

    def signed_distance(self, points: Complex) -> Real:
        """Distances of points from the outline, below 0 inside, mm."""
        return np.asarray(distance_to_profile(points, self.profile) * np.where(self.holds(points), -1.0, 1.0))
