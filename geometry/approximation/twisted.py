"""Twisted walls as triangles within a tolerance: chords of the section and slices along the axis, with a proven bound.

Between two slices every chord spans two triangles, which share one of its two diagonals. A point of theirs is turned
back by the twist at its height and then held against the exact section, so that the error is that of the section at
the point's own height; along the surface's normal it is less. In the frame of its chord the turned point's height is
linear along a section of the triangle, so its extremes lie on the triangle's edges: three curves over the slice's
height. The exact section's height over its chord lies between 0 and the chord's error, on the side to which it bends.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from geometry.approximation.chords import chord_parameters, chords_of
from geometry.base.errors import ConvergenceError
from geometry.base.record import Draft
from geometry.curves.curve import Complex, Curve, Real
from geometry.curves.line_arc import Line
from geometry.plane.contour import Approximation, Contour
from geometry.plane.profile import Profile

# shares of a slice's height at which the three edges are looked at
_SHARES = np.linspace(0.0, 1.0, 17)
# steps between slices that are tried: the coarsest leaves nothing to the chords, each next one is finer by this
_LEAST_SLICING, _SLICINGS, _FINER = 0.93, 14, 0.85
_MOST_CHORDS, _MOST_SHRINKS = 4096, 100


class _Chords(Draft):
    """Chords of one curve by their number: parameters, points, error, and the side to which it bends."""

    curve: Curve
    made: dict[int, tuple[Complex, float]]

    def of(self, count: int) -> tuple[Complex, float]:
        """Points (count + 1,) of chords of near equal error, and that error, mm."""
        if count not in self.made:
            t, error = chords_of(self.curve, count)
            self.made[count] = self.curve.point(t), error
        return self.made[count]

    @property
    def bend(self) -> float:
        """1 where the curve turns left, and so lies right of its chords, else -1; 0 for a line."""
        low, high = self.curve.domain
        return 0.0 if isinstance(self.curve, Line) else float(np.sign(self.curve.curvature((low + high) / 2)))

    def fewest(self, step: float, tolerance: float) -> int | None:
        """The fewest chords that keep slices of a step within a tolerance; None where no number does."""
        count = len(chord_parameters(self.curve, tolerance)[0]) - 1
        while count <= _MOST_CHORDS:
            points, error = self.of(count)
            both = [_errors(points, error, self.bend, np.full(count, flag), step) for flag in (True, False)]
            worst = float(np.minimum(*both).max())
            if worst <= tolerance:
                return count
            # what the slices alone cost
            floor = float(np.abs(points).max()) * step**2 / 8
            if count > 8 and 0.999 * floor < worst < floor * 1.001:
                return None
            count = max(count + 1, math.floor(count * min(1.5, math.sqrt(worst / tolerance))))
        return None


def approximate_twisted(profile: Profile, tolerance: float, least_edge: float = 0.0) -> Approximation:
    """Chords of a profile and the step between the slices of its twisted walls, near the fewest triangles.

    Raises
    ------
    ConvergenceError
        The tolerance is so small that more chords than a file can carry would be needed.
    """
    slack = min(least_edge, tolerance / 4)
    goal = tolerance - slack
    known: dict[Curve, _Chords] = {}
    for segment in profile.period:
        # both sides of a tooth are mirror images, and a mirrored slice stands on its head
        if segment.curve.mirrored() not in known:
            known.setdefault(segment.curve, _Chords(segment.curve, {}))
    # a vertex between two slices runs on a chord of its circle
    step = math.sqrt(8 * _LEAST_SLICING * goal / profile.reach())
    best: tuple[float, float, dict[Curve, int]] | None = None
    for _ in range(_SLICINGS):
        counts = {curve: chords.fewest(step, goal) for curve, chords in known.items()}
        found = {curve: n for curve, n in counts.items() if n is not None}
        if len(found) == len(counts):
            cost = sum(found.values()) / step
            if best is not None and cost > best[0]:
                break
            best = (cost, step, found)
        step *= _FINER
    if best is None:
        raise ConvergenceError("slices for the tolerance", tolerance, _MOST_CHORDS)
    return _finished(profile, known, best[2], best[1], tolerance, slack)


def _finished(
    profile: Profile, known: dict[Curve, _Chords], counts: dict[Curve, int], step: float, tolerance: float, slack: float
) -> Approximation:
    """The whole contour; its diagonals are those that the mesh takes, so the step may have to shrink a little."""
    points, errors, bends = [], [], []
    for segment in profile.period:
        own = segment.curve in known
        curve = segment.curve if own else segment.curve.mirrored()
        piece, error = known[curve].of(counts[curve])
        points.append((piece if own else np.conj(piece[::-1]))[:-1])
        errors.append(np.full(counts[curve], error))
        bends.append(np.full(counts[curve], known[curve].bend))
    vertices, chords, bend = np.concatenate(points), np.concatenate(errors), np.concatenate(bends)
    turned = np.exp(1j * profile.pitch_angle)
    short = np.abs(np.append(vertices[1:], vertices[0] * turned) - vertices) < slack
    # a vertex at the start of a short edge goes; its neighbours move by less than that edge
    kept = ~short if short.any() and not short.all() else np.full(len(vertices), True)
    contour = Contour(vertices[kept], np.zeros(np.count_nonzero(kept)), profile.count, profile.clockwise)
    return _sliced(contour, chords[kept], [bend[kept]], 0.0 if kept.all() else slack, step, tolerance)


def slices_over(contour: Contour, error: float, tolerance: float) -> Approximation:
    """Chords within ``error`` mm of a profile, on whichever side of it, with the step between slices that they allow.

    Raises
    ------
    ConvergenceError
        The chords leave too little of the tolerance to the slices.
    """
    farthest = float(np.abs(np.append(contour.vertices, contour.period_ends()[-1])).max())
    return _sliced(contour, error, [1, -1], 0.0, math.sqrt(8 * (tolerance - error) / farthest), tolerance)


def _sliced(
    contour: Contour, chords: Real | float, bends: Sequence[Real | int], moved: float, step: float, tolerance: float
) -> Approximation:
    """A contour whose errors of chords, mm, bend so, with the greatest step up to one that keeps the tolerance.

    ``moved``: what its vertices are off besides, mm.
    """
    ends = np.append(contour.vertices, contour.period_ends()[-1])
    for _ in range(_MOST_SHRINKS):
        worst = moved
        for sense in (1, -1):
            rising = rising_diagonals(contour, sense * step)
            for bend in bends:
                found = _errors(ends, chords, bend, rising, sense * step)
                worst = max(worst, float(found.max()) + moved)
        if worst <= tolerance:
            return Approximation(contour, worst, "certified", tolerance, step)
        step *= 0.95
    raise ConvergenceError("slices for the tolerance", worst, _MOST_SHRINKS)


def rising_diagonals(contour: Contour, step: float) -> NDArray[np.bool_]:
    """Which edges (n,) of a period take the diagonal from their lower start to their upper end.

    That diagonal bulges to the left for a step > 0 (rad), by edge x step / 4. Each edge takes the one that bulges to
    where the contour bends, so that both errors do not add up.
    """
    before = contour.vertices[-1] * np.exp(-1j * contour.pitch_angle)
    after = contour.vertices[1 if len(contour.vertices) > 1 else 0]
    if len(contour.vertices) == 1:
        after = after * np.exp(1j * contour.pitch_angle)
    closing = contour.period_ends()[-1]
    points = np.concatenate([[before], contour.vertices, [closing], [after * np.exp(1j * contour.pitch_angle)]])
    edges = np.diff(points)
    turns = np.angle(edges[1:] * np.conj(edges[:-1]))
    # between chords of a line rounding turns either way
    convex = turns[:-1] + turns[1:] >= -1e-9
    return np.asarray(convex != (step > 0))


def _errors(points: Complex, error: float | Real, bend: float | Real, rising: NDArray[np.bool_], step: float) -> Real:
    """Bound of the distance of each chord's two triangles from the exact section at their height, (n,), mm.

    ``points`` (n + 1,) of the chords, whose exact curve lies ``error`` mm off on the side away from ``bend``.
    """
    a, b = points[:-1, None], points[1:, None]
    chord = (b - a) / np.abs(b - a)
    turn, share = np.exp(1j * step), _SHARES
    back = np.exp(-1j * step * share)
    start, end = np.where(rising[:, None], a, b), np.where(rising[:, None], b, a)
    paths = np.stack([back * ((1 - share) * p + share * turn * q) for p, q in ((a, a), (b, b), (start, end))])
    local = np.conj(chord) * (paths - a)
    span = np.abs(b - a)
    over = np.maximum(np.maximum(-local.real, local.real - span), 0.0).max(axis=(0, 2))
    low = np.where(np.asarray(bend) > 0, -np.asarray(error), 0.0)
    high = np.where(np.asarray(bend) < 0, np.asarray(error), 0.0)
    height = local.imag
    found = np.maximum(height.max(axis=(0, 2)) - low, high - height.min(axis=(0, 2)))
    # between the shares a path leaves its chord by an eighth of its second derivative
    size, gap = np.abs(points).max(), _SHARES[1] ** 2 / 8
    missed = gap * (size * step**2 + 2 * abs(step) * (span[:, 0] + size * abs(step)))
    return np.asarray(np.hypot(found, over) + missed)


def slice_turns(twist: float, step: float) -> Real:
    """Turns of the slices of a wall that twists by ``twist`` rad, both ends included, rad from its lower end."""
    count = max(1, math.ceil(abs(twist) / step * (1 - 1e-12)))
    return np.linspace(0.0, twist, count + 1)
