"""Exact boundaries as chords or arcs within a tolerance, with a bound of the error that is never too small.

Chords: the farthest point of a curve of one-signed curvature is where its tangent is parallel to the chord, so
the deviation is exact. Arcs: geometry/approximation/arcs.py. A parametric bound h^2 M2 / 8 would be 2 to 7 times too
large.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from functools import lru_cache
from typing import cast

import numpy as np

from geometry.approximation.arcs import arc_error, arc_spline, summed
from geometry.base.errors import ConvergenceError
from geometry.base.record import Record, replace
from geometry.base.roots import halved
from geometry.base.tolerance import TOLERANCES
from geometry.curves.alike import by_formula, sampled
from geometry.curves.bounds import Bound
from geometry.curves.curve import Complex, Curve, Real, at_shares
from geometry.curves.line_arc import Arc, Line
from geometry.plane.contour import Approximation, Contour
from geometry.plane.merge import merge_short_edges
from geometry.plane.profile import Profile, Segment

_DENSITY_SAMPLES, _SAMPLES_A_KNOT = 129, 4
# a tolerance, part of the longest chord, at which the error of chords across knots is sampled
_CHORD_SHARE = 1e-3
_MAX_CHORDS = 1_000_000
# a height counts by the square of its place
_HALVINGS = 28


class Piece(Record):
    """Points (n + 1,) and bulges (n,) of one approximated segment."""

    points: Complex
    bulges: Real
    max_error: float
    certified: bool

    def mirrored(self) -> Piece:
        """The piece of the mirrored segment: mirroring and travelling back both flip a bulge's sign."""
        return Piece(np.conj(self.points[::-1]), self.bulges[::-1], self.max_error, self.certified)


# cut files, pictures, films and checks ask for the same outlines
@lru_cache(maxsize=32)
def approximate_profile(profile: Profile, tolerance: float, *, arcs: bool, least_edge: float = 0.0) -> Approximation:
    """A closed profile as a contour within ``tolerance`` mm.

    ``arcs``: tangent-continuous arcs, circular and straight segments as themselves; else chords only.
    Edges shorter than ``least_edge`` mm are merged where the tolerance allows it.

    Raises
    ------
    ConvergenceError
        The tolerance is so small that more pieces than a file can carry would be needed.
    """
    make, profile = _arc_piece if arcs else _chord_piece, _joined(profile)
    done: dict[Curve, Piece] = {}
    for curve in (s.curve for s in profile.period):
        # both sides of a tooth are mirror images: one is computed
        twin = None if isinstance(curve, Arc | Line) else done.get(curve.mirrored())
        done[curve] = twin.mirrored() if twin is not None else make(curve, tolerance)
    pieces = [done[s.curve] for s in profile.period]
    contour = Contour(
        np.concatenate([p.points[:-1] for p in pieces]),
        np.concatenate([p.bulges for p in pieces]),
        profile.count,
        profile.clockwise,
    )
    error = max(p.max_error for p in pieces)
    bound: Bound = "certified" if all(p.certified for p in pieces) else "sampled"
    if least_edge > 0:
        edges = np.array([len(p.bulges) for p in pieces])
        contour, merged_error = merge_short_edges(contour, edges, profile, tolerance, least_edge)
        error = max(error, merged_error)
        bound = "sampled" if merged_error > 0 else bound
    contour.vertices.flags.writeable = contour.bulges.flags.writeable = False
    return Approximation(contour, error, bound if error > 0 else "exact", tolerance)


def _joined(profile: Profile) -> Profile:
    """The profile with what is one spline in one segment."""
    period: list[Segment] = []
    for segment in profile.period:
        whole = period[-1].curve.joined(segment.curve) if period else None
        if whole is None:
            period.append(segment)
        else:
            period[-1] = Segment(whole, segment.label)
    return replace(profile, period=tuple(period)) if len(period) < len(profile.period) else profile


def approximate_together(
    profiles: Sequence[Profile], walls: Collection[tuple[int, int]], tolerance: float, least_edge: float = 0.0
) -> tuple[Approximation, ...]:
    """Chords of profiles of equal segments, at equal shares of each: both ends of ruled walls, by their numbers.

    The error holds on the walls too: a wall's two triangles leave the ruled surface between them by a quarter
    of the normal part of their twist at most.
    """
    slack = min(least_edge, tolerance / 4)
    shares = []
    for curves in zip(*([s.curve for s in p.period] for p in profiles), strict=True):
        shares.append(_shared_chords(curves, walls, tolerance - slack))
    made = [
        [s.curve.point(at_shares(s.curve, t)) for s, (t, _) in zip(p.period, shares, strict=True)] for p in profiles
    ]
    vertices = np.array([np.concatenate([points[:-1] for points in pieces]) for pieces in made])
    error = max(e for _, e in shares)
    ends = np.append(vertices[:, 1:], vertices[:, :1] * np.exp(1j * profiles[0].pitch_angle), axis=1)
    lengths = np.abs(ends - vertices)
    short = lengths.min(axis=0) < slack
    # a vertex at the start of a short edge goes; a chord then moves by less than the edges it swallows, all of them
    # together no longer than the slack
    short &= np.cumsum(np.where(short, lengths.max(axis=0), 0.0)) <= slack
    if short.any() and not short.all():
        vertices, error = vertices[:, ~short], error + slack
    bound: Bound = "certified" if error > 0 else "exact"
    zeros = np.zeros(vertices.shape[1])
    return tuple(
        Approximation(Contour(v, zeros, p.count, p.clockwise), error, bound, tolerance)
        for v, p in zip(vertices, profiles, strict=True)
    )


def _shared_chords(curves: Sequence[Curve], walls: Collection[tuple[int, int]], tolerance: float) -> tuple[Real, float]:
    """Shares (n + 1,) of matching curves at which all are cut into chords, and the greatest error, mm."""
    counts = [chord_parameters(c, tolerance)[0] for c in curves]
    finest = max(range(len(curves)), key=lambda i: len(counts[i]))
    low, high = curves[finest].domain
    shares = (counts[finest] - low) / (high - low)
    shares[[0, -1]] = 0.0, 1.0
    while len(shares) <= _MAX_CHORDS:
        bent = [c for c in curves if not isinstance(c, Line)]
        error = max((_greatest([bent[i] for i in own], shares) for own in by_formula(bent)), default=0.0)
        error += _twist(np.array([c.point(at_shares(c, shares)) for c in curves]), walls)
        if error <= tolerance:
            return shares, error
        finer = np.linspace(0, len(shares) - 1, math.ceil(1.2 * len(shares)) + 1)
        shares = np.interp(finer, np.arange(len(shares)), shares)
    raise ConvergenceError("chords for the tolerance", tolerance, _MAX_CHORDS)


def _greatest(alike: Sequence[Curve], shares: Real) -> float:
    """The greatest error of chords at equal shares of curves that one formula gives, mm."""
    t = np.array([at_shares(c, shares) for c in alike])
    return chord_error(alike[0], t[0]) if len(alike) == 1 else _chord_error(alike, t)


def _twist(points: Complex, walls: Collection[tuple[int, int]]) -> float:
    """Bound of the distance between ruled walls over matching chords and their triangles, mm; points (k, n)."""
    chords = np.diff(points, axis=1)
    along = np.conj(chords / np.abs(chords))
    ends = [pair for wall in walls for pair in (wall, wall[::-1])]
    return float(max(np.abs((along[a] * (chords[b] - chords[a])).imag).max() for a, b in ends)) / 4


def _arc_piece(curve: Curve, tolerance: float) -> Piece:
    if isinstance(curve, Line):
        return Piece(np.array([curve.start, curve.end]), np.zeros(1), 0.0, True)
    if isinstance(curve, Arc):
        # a bulge of 1 (half a turn) is the most that every reader takes
        count = max(1, math.ceil(abs(curve.sweep) / math.pi - 1e-9))
        return Piece(
            curve.point(np.linspace(*curve.domain, count + 1)),
            np.full(count, math.tan(curve.sweep / count / 4)),
            0.0,
            True,
        )
    spline = arc_spline(curve, tolerance)
    return Piece(spline.points, spline.bulges, spline.max_error, spline.certified)


def _chord_piece(curve: Curve, tolerance: float) -> Piece:
    t, error, certified = chord_parameters(curve, tolerance)
    return Piece(curve.point(t), np.zeros(len(t) - 1), error, certified)


def chord_parameters(curve: Curve, tolerance: float) -> tuple[Real, float, bool]:
    """Parameters of near the fewest chords within ``tolerance`` mm, the error, and whether it is proven.

    Chords of equal error have length sqrt(8 tolerance / |kappa|).
    """
    if isinstance(curve, Line):
        return np.array(curve.domain), 0.0, True
    if isinstance(curve, Arc):
        return _arc_chords(curve, tolerance)
    nodes, coordinate, total = _chord_density(curve)
    count = max(1, math.ceil(total / math.sqrt(8 * tolerance)))
    while count <= _MAX_CHORDS:
        t = _equal_steps(curve, nodes, coordinate, count)
        error = chord_error(curve, t)
        if error <= tolerance:
            return t, error, True
        count = max(count + 1, math.floor(count * math.sqrt(error / tolerance)))
    raise ConvergenceError("chords for the tolerance", tolerance, _MAX_CHORDS)


def chords_of(curve: Curve, count: int) -> tuple[Real, float]:
    """Parameters of a given number of chords of near equal error, and that error, mm."""
    if isinstance(curve, Line | Arc):
        # of an arc R (1 - cos(step / 2)) = 2 R sin^2(step / 4)
        error = 2 * curve.radius * math.sin(abs(curve.sweep) / count / 4) ** 2 if isinstance(curve, Arc) else 0.0
        return np.linspace(*curve.domain, count + 1), error
    t = _equal_steps(curve, *_chord_density(curve)[:2], count)
    return t, chord_error(curve, t)


def _chord_density(curve: Curve) -> tuple[Real, Real, float]:
    """Samples, shares of the integral of sqrt(|kappa|) ds, in which chords of equal error have equal length, and it."""
    nodes = np.linspace(*curve.domain, _DENSITY_SAMPLES + _SAMPLES_A_KNOT * curve.knots.size)
    speed, curvature = np.abs(curve.derivative(nodes)), np.abs(curve.curvature(nodes))
    with np.errstate(invalid="ignore"):
        rate = np.sqrt(curvature * speed) * np.sqrt(speed)
    rate = np.where(np.isfinite(rate), rate, 0.0)
    # a floor keeps the coordinate strictly increasing where the curve is straight or has a cusp
    rate += 1e-6 * rate.max() + 1e-12 * np.sqrt(speed.max())
    return nodes, *summed((rate[1:] + rate[:-1]) / 2 * np.diff(nodes))


def _equal_steps(curve: Curve, nodes: Real, coordinate: Real, count: int) -> Real:
    t = np.interp(np.linspace(0, 1, count + 1), coordinate, nodes)
    t[0], t[-1] = curve.domain
    return t


def _arc_chords(arc: Arc, tolerance: float) -> tuple[Real, float, bool]:
    """The fewest equal chords of a circular arc."""
    step = 4 * math.asin(min(math.sqrt(tolerance / (2 * arc.radius)), math.sin(math.pi / 6)))
    count = max(1, math.ceil(abs(arc.sweep) / step))
    if count > _MAX_CHORDS:
        raise ConvergenceError("chords for the tolerance", tolerance, _MAX_CHORDS)
    return *chords_of(arc, count), True


def chord_error(curve: Curve, t: Real) -> float:
    """Greatest distance between a curve of one-signed curvature and its chords: exact up to rounding.

    Of a curve with knots, which may turn often, a bound: arcs without a bulge.
    """
    if not curve.knots.size:
        return _chord_error([curve], t[None])
    points = curve.point(t)
    longest = float(np.abs(np.diff(points)).max())
    return arc_error(curve, t, points, np.zeros(len(points) - 1), _CHORD_SHARE * longest)[0]


def _chord_error(curves: Sequence[Curve], t: Real) -> float:
    """The same of curves that one formula gives, (curves, n).

    The distance from the chord is greatest where the tangent is parallel to it: bisection on all chords at once.
    """
    group = sampled(curves, t)
    points, chord = group.points[:, :-1].ravel(), np.diff(group.points).ravel()
    curve = cast("Curve", group.of(np.repeat(np.arange(len(curves)), t.shape[1] - 1)))
    back, low = np.conj(chord / np.abs(chord)), t[:, :-1].ravel()
    sign = np.sign((back * curve.tangent(low)).imag)
    _, high = halved(lambda at: (back * curve.tangent(at)).imag * sign > 0, low, t[:, 1:].ravel(), _HALVINGS)
    height = np.abs((back * (curve.point(high) - points)).imag)
    return float(height.max()) + 4 * TOLERANCES.relative_rounding * float(np.abs(group.points).max())
