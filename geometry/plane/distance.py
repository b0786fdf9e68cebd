"""Exact signed distance of points and curves from a boundary of exact curves; the words for a contact's verdict.

The boundary has its material on the left; distances are positive outside it. Feet of perpendiculars on lines, arcs and
involutes are closed forms, those on other curves roots bracketed by samples. The signed distance is
1-Lipschitz, so a curve's unsearched pieces are excluded by bounds. Derivations: each function's docstring.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import StrEnum
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from geometry.base.record import Record
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import Complex, Curve, Real, Reversed
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc, Line
from geometry.plane.foot_search import FootSearch
from geometry.plane.profile import joint_turn

_STEPS = 60
_CLOSED_FORMS = (Involute, Arc, Line)
Indices = NDArray[np.intp]
Flags = NDArray[np.bool_]


class Verdict(StrEnum):
    """How two bodies stand to each other over a motion."""

    CLEAR = "clear"
    CONTACT = "contact"
    OVERLAP = "overlap"
    UNDECIDED = "undecided"


class Feet(NamedTuple):
    """Nearest boundary points of n points.

    ``distance`` (n,) in mm, positive outside the material; ``curve_index`` (n,) and ``parameter`` (n,) on
    it; ``normal`` (n,) the unit direction in which the distance grows.
    """

    distance: Real
    curve_index: Indices
    parameter: Real
    normal: Complex


class Boundary(Record, dict=True):
    """A chain of curves with the material on its left, open or closed.

    ``end_normals`` are the outward normals at the two ends of an open chain, where it goes on by symmetry beyond
    what is stored; without them the ends count as smooth.
    """

    curves: tuple[Curve, ...]
    closed: bool = False
    end_normals: tuple[complex, complex] | None = None

    @cached_property
    def vertices(self) -> Complex:
        """Ends of the curves in order, mm; the last end of a closed chain is its first."""
        points = [complex(c.point(c.domain[0])) for c in self.curves]
        if not self.closed:
            points.append(complex(self.curves[-1].point(self.curves[-1].domain[1])))
        return np.array(points)

    @cached_property
    def _vertex_normals(self) -> Complex:
        """Sum of the outward normals on both sides: its sign tells the side of a point nearest to the vertex."""
        first = [-1j * complex(c.tangent(c.domain[0])) for c in self.curves]
        last = [-1j * complex(c.tangent(c.domain[1])) for c in self.curves]
        if self.closed:
            return np.array([a + b for a, b in zip(first, [last[-1], *last[:-1]], strict=True)])
        start, end = self.end_normals or (first[0], last[-1])
        return np.array([start, *(a + b for a, b in zip(first[1:], last[:-1], strict=True)), end])

    @cached_property
    def convex_corners(self) -> tuple[complex, ...]:
        """Vertices at which the outline turns left, mm; at an open end, where it does so with its mirror image."""
        chain = list(pairwise(self.curves))
        if self.closed:
            chain.append((self.curves[-1], self.curves[0]))
        found = [complex(b.point(b.domain[0])) for a, b in chain if joint_turn(a, b) > TOLERANCES.smooth_angle]
        if not self.closed and self.end_normals:
            start, end = self.curves[0], self.curves[-1]
            outward = -1j * complex(start.tangent(start.domain[0])), -1j * complex(end.tangent(end.domain[1]))
            turns = np.angle([outward[0] / self.end_normals[0], self.end_normals[1] / outward[1]])
            ends = complex(start.point(start.domain[0])), complex(end.point(end.domain[1]))
            found += [p for p, turn in zip(ends, turns, strict=True) if turn > TOLERANCES.smooth_angle]
        return tuple(found)

    @cached_property
    def _vertex_feet(self) -> tuple[Indices, Real]:
        index = list(range(len(self.curves)))
        parameter = [c.domain[0] for c in self.curves]
        if not self.closed:
            index.append(len(self.curves) - 1)
            parameter.append(self.curves[-1].domain[1])
        return np.array(index, dtype=np.intp), np.array(parameter)

    @cached_property
    def _searches(self) -> tuple[FootSearch | None, ...]:
        return tuple(None if isinstance(_forward(c), _CLOSED_FORMS) else FootSearch(c) for c in self.curves)

    def feet(self, points: Complex) -> Feet:
        """Nearest boundary point of each point (n,), by all curves and all vertices.

        A tie goes to a curve's inside. Accuracy: a few roundings of the largest coordinate.
        """
        points = np.asarray(points, dtype=complex).ravel()
        spokes = points[:, None] - self.vertices
        lengths = np.abs(spokes)
        which = np.argmin(lengths, axis=1)
        rows = np.arange(len(points))
        spoke, size = spokes[rows, which], lengths[rows, which]
        pseudo = self._vertex_normals[which]
        sign = np.where((np.conj(pseudo) * spoke).real < 0, -1.0, 1.0)
        distance = sign * size
        with np.errstate(invalid="ignore", divide="ignore"):
            normal = np.where(size > 0, sign * spoke / size, pseudo / np.abs(pseudo))
        index, parameter = (table[which] for table in self._vertex_feet)
        for number, (curve, search) in enumerate(zip(self.curves, self._searches, strict=True)):
            chosen, t = _interior_feet(curve, search, points, np.abs(distance))
            if not chosen.size:
                continue
            outward = -1j * curve.tangent(t)
            gap = (np.conj(outward) * (points[chosen] - curve.point(t))).real
            # a point may have several feet on one curve: the nearest is assigned last
            order = np.argsort(-np.abs(gap), kind="stable")
            nearer = order[np.abs(gap[order]) <= np.abs(distance[chosen[order]])]
            chosen = chosen[nearer]
            distance[chosen], normal[chosen] = gap[nearer], outward[nearer]
            index[chosen], parameter[chosen] = number, t[nearer]
        return Feet(distance, index, parameter, normal)


def _forward(curve: Curve) -> Curve:
    """An involute that is travelled backwards, as on a ring's flank, as itself; any other curve as it is."""
    return curve.base if isinstance(curve, Reversed) and isinstance(curve.base, Involute) else curve


def _interior_feet(curve: Curve, search: FootSearch | None, points: Complex, best: Real) -> tuple[Indices, Real]:
    """Which points have a foot inside a curve that may beat ``best``, and its parameter."""
    if isinstance(forward := _forward(curve), Involute):
        t, inside = _involute_foot(points, forward)
        t = t if forward is curve else -t
    elif isinstance(curve, Arc | Line):
        t, inside = curve.foot(points)
    else:
        assert search is not None
        return search.feet(points, best)
    chosen = np.flatnonzero(inside)
    return chosen, t[chosen]


def _involute_foot(points: Complex, curve: Involute) -> tuple[Real, Flags]:
    """Roll angle of the foot on an involute and whether it lies inside the domain.

    Normals of an involute touch its base circle: p = e^{i psi} (r_b - i s), s = sqrt(R^2 - r_b^2), so that
    psi = arg p + atan(s / r_b) and the roll is psi - t0 (its mirror image on the other branch). The distance
    falls until that psi and grows from there on; inside the base circle it only grows.
    """
    spoke = points - curve.centre
    low, high = curve.domain
    forward = low + high > 0
    radius = np.abs(spoke)
    s = np.sqrt(np.maximum((radius - curve.base_radius) * (radius + curve.base_radius), 0))
    lean = np.arctan2(s, curve.base_radius)
    roll = np.angle(spoke) + (lean if forward else -lean) - curve.base_angle
    middle = (low + high) / 2
    roll = middle + np.mod(roll - middle + math.pi, 2 * math.pi) - math.pi
    return roll, (roll >= low) & (roll <= high) & (radius > curve.base_radius)


Evaluation = Callable[[Real, Indices], tuple[Real, Real]]


def least_in_brackets(
    evaluate: Evaluation, low: Real, high: Real, slopes: tuple[Real, Real], accuracy: float
) -> tuple[Real, Real]:
    """Parameters and values of the minima of n functions, each in a bracket with falling and rising ends.

    ``evaluate(t, rows)`` gives value and slope of the functions ``rows`` at ``t``. Safeguarded false position
    on the slope; a function is left when |slope| * bracket < ``accuracy`` (in the unit of the value), which
    bounds the error for a function convex in its bracket.
    """
    low, high = low.copy(), high.copy()
    falling, rising = slopes[0].copy(), slopes[1].copy()
    best_t, best = (low + high) / 2, np.full(low.shape, np.inf)
    rows = np.arange(len(low))
    for step in range(_STEPS):
        if not rows.size:
            break
        a, b, fa, fb = low[rows], high[rows], falling[rows], rising[rows]
        share = np.full(a.shape, 0.5)
        if step % 3 != 2:
            with np.errstate(divide="ignore", invalid="ignore"):
                share = np.nan_to_num(fa / (fa - fb), nan=0.5)
        t = a + np.clip(share, 0.001, 0.999) * (b - a)
        value, slope = evaluate(t, rows)
        better = value < best[rows]
        best[rows[better]], best_t[rows[better]] = value[better], t[better]
        down = slope < 0
        low[rows[down]], falling[rows[down]] = t[down], slope[down]
        high[rows[~down]], rising[rows[~down]] = t[~down], slope[~down]
        rows = rows[(np.abs(slope) * (high[rows] - low[rows]) > accuracy) & (high[rows] - low[rows] > 1e-16)]
    return best_t, best


def promising(low: Real, high: Real, slope_low: Real, slope_high: Real, lengths: Real, best: Real | float) -> Flags:
    """Which pieces of curves may hold less than ``best``: a falling and a rising end, and the Lipschitz bound.

    A function that changes by at most one per unit length stays above (low + high - length) / 2.
    """
    return (slope_low <= 0) & (slope_high >= 0) & ((low + high - lengths) / 2 < best)


class Samples(NamedTuple):
    """Even samples of a curve and lengths of the pieces between them, with room for what they bulge, mm."""

    parameters: Real
    points: Complex
    lengths: Real


def sampled(curve: Curve, step: float) -> Samples:
    """Samples of a curve about ``step`` mm apart, 3 to 65 of them."""
    rough = np.asarray(curve.point(np.linspace(*curve.domain, 9)))
    count = min(65, max(3, math.ceil(float(np.abs(np.diff(rough)).sum()) / step) + 1))
    t = np.linspace(*curve.domain, count)
    points = np.asarray(curve.point(t))
    return Samples(t, points, 1.2 * np.abs(np.diff(points)))


def folded(points: Complex, vectors: Complex, pitch: float) -> tuple[Complex, Complex]:
    """Points, and directions at them, carried into the sector [-pitch/2, 0] by turns and the mirror image.

    For a body with these symmetries about the origin distances stay, and the nearest outline point is there too.
    """
    turn = np.exp(-1j * pitch * np.round(np.angle(points) / pitch))
    points, vectors = points * turn, vectors * turn
    upper = points.imag > 0
    return np.where(upper, np.conj(points), points), np.where(upper, np.conj(vectors), vectors)


def fold_images(points: Complex, pitch: float) -> Indices:
    """Which half pitch each point lies in, counted from the x axis: points with one number are folded alike."""
    return np.floor(np.angle(points) / (pitch / 2)).astype(np.intp)
