"""Plane B-splines, and a proven bound of their normal distance from an exact curve.

The proof: let S be the spline, c the curve and p a map of S's parameters onto c's domain that keeps the ends. Then
E(x) = S(x) - c(p(x)) bounds the distance both ways: every point of S is within |E| of c, and since p reaches every
parameter of c, every point of c is within |E| of S. p is a cubic of Hermite form between feet of perpendiculars,
so that |E| is the normal distance at the feet. Between them E is within h^4 / 384 max |E''''| of its own Hermite
cubic, whose Bezier points bound it. |E''''| is bounded by the spline's control polygon and by the chain rule:
|(c o p)''''| <= M4 p1^4 + 6 M3 p1^2 p2 + M2 (3 p2^2 + 4 p1 p3), M_k = curve.derivative_bound(k), p_k >= |p^(k)|.
Where a curve knows no such bounds, twice what E is off its Hermite cubic at the middle stands for that term.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from geometry.base.distinct import distinct
from geometry.base.errors import ParameterError
from geometry.base.placement import Placement2
from geometry.base.record import Record
from geometry.base.tolerance import TOLERANCES
from geometry.curves.bounds import Bound
from geometry.curves.curve import Complex, Curve, Real, Span

Index = NDArray[np.intp]

# cells of the proof: at least this many to begin with, and per knot span
_LEAST_CELLS, _CELLS_PER_SPAN = 128, 24
# intervals of the curve on which its derivative bounds are asked for
_LEAST_PARTS = 8
# a cell is halved while its bound exceeds the greatest sampled distance by more than this share
_MARGIN_SHARE = 0.03
_MOST_HALVINGS = 48
_MOST_CELLS = 200_000
_FOOT_STEPS = 3
# cells of the domain 0 to 1 are not halved below this; feet whose distances differ by this part of a point are alike
_LEAST_CELL, _ALIKE = 1e-13, 1e-15


class BSpline(Record, eq=False):
    """Clamped plane B-spline: ``degree``, full knot vector (n + degree + 1,), poles (n,) as x + iy, mm.

    The parameter has no unit. Source: de Boor, A Practical Guide to Splines, chapter X.

    Raises
    ------
    ParameterError
        The knots decrease, are not clamped, or their number does not fit the poles.
    """

    degree: int
    knots: Real
    poles: Complex

    def __post_init__(self) -> None:
        p, knots = self.degree, self.knots
        if p < 1 or len(knots) != len(self.poles) + p + 1 or len(self.poles) <= p:
            raise ParameterError("knots", len(knots), "wrong_number_of_knots", wanted=len(self.poles) + p + 1)
        clamped = np.all(knots[: p + 1] == knots[0]) and np.all(knots[-p - 1 :] == knots[-1])
        inner = knots[p:-p]
        if not clamped or not np.all(inner[1:] >= inner[:-1]) or not np.all(knots[p + 1 :] > knots[: -p - 1]):
            raise ParameterError("knots", knots.tolist(), "knots_not_clamped")

    @property
    def domain(self) -> tuple[float, float]:
        """Parameter interval, no unit."""
        return float(self.knots[0]), float(self.knots[-1])

    @property
    def breaks(self) -> Real:
        """The different knots, (spans + 1,)."""
        return distinct(self.knots)

    def point(self, t: ArrayLike) -> Complex:
        """Points, mm, of the shape of ``t``; the first and the last pole exactly at the ends of the domain."""
        t = np.asarray(t, dtype=float)
        first, values = basis(self.degree, self.knots, t)
        return np.einsum("...k,...k->...", values, self.poles[first[..., None] + np.arange(self.degree + 1)])

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        """Derivative of any order, mm, of the shape of ``t``; at an interior knot the value from the right."""
        if order > self.degree:
            return np.zeros(np.shape(t), dtype=complex)
        t, degree, poles = np.asarray(t, dtype=float), self.degree - order, self.derivative_poles(order)
        first, values = basis(degree, self.knots[order : len(self.knots) - order], t)
        return np.einsum("...k,...k->...", values, poles[first[..., None] + np.arange(degree + 1)])

    def derivatives(self, t: ArrayLike, order: int) -> list[Complex]:
        """Points and derivatives up to ``order``."""
        return [self.derivative(t, k) for k in range(order + 1)]

    def derivative_poles(self, order: int) -> Complex:
        """Poles (n - order,) of the derivative on the knots without ``order`` at each end; 0 where a knot jumps."""
        poles = self.poles
        for k in range(order):
            p = self.degree - k
            step = self.knots[self.degree + 1 : len(self.knots) - k - 1] - self.knots[k + 1 : -self.degree - 1]
            with np.errstate(divide="ignore", invalid="ignore"):
                poles = np.where(step > 0, p * np.diff(poles) / step, 0)
        return poles

    def derivative_bound(self, order: int, spans: Index) -> Real:
        """Proven bound of |S^(order)| on each knot span, mm; ``spans`` holds i with knots[i] < knots[i + 1]."""
        if order > self.degree:
            return np.zeros(len(spans))
        local = np.arange(self.degree - order + 1)
        return np.abs(self.derivative_poles(order))[(spans - self.degree)[:, None] + local].max(axis=1)

    def reversed(self) -> BSpline:
        """The same points travelled the other way, on the same domain."""
        return BSpline(self.degree, _mirrored_knots(self.knots), self.poles[::-1])

    def trimmed(self, low: float, high: float) -> BSpline:
        """The same points between two parameters (blossoms at the knots that are left; Ramshaw 1987)."""
        p = self.degree
        inner = self.knots[(self.knots > low) & (self.knots < high)]
        knots = np.concatenate([np.full(p + 1, low), inner, np.full(p + 1, high)])
        poles = []
        for first in range(len(knots) - p - 1):
            # of the polynomial on some span that the pole is at work on
            wide = next(k for k in range(first, first + p + 1) if knots[k] < knots[k + 1])
            span = int(span_index(p, self.knots, (knots[wide] + knots[wide + 1]) / 2))
            rest = self.poles[span - p : span + 1]
            for k in range(1, p + 1):
                starts, ends = self.knots[span - p + k : span + 1], self.knots[span + 1 : span + 1 + p + 1 - k]
                share = (knots[first + k] - starts) / (ends - starts)
                rest = (1 - share) * rest[:-1] + share * rest[1:]
            poles.append(rest[0])
        return BSpline(p, knots, np.array(poles))

    def placed(self, placement: Placement2) -> BSpline:
        """The spline carried by a rigid motion."""
        return BSpline(self.degree, self.knots, placement.apply(self.poles))

    def mirrored(self) -> BSpline:
        """Mirror image in the x axis, travelled the other way: material stays on the same side."""
        return BSpline(self.degree, _mirrored_knots(self.knots), np.conj(self.poles[::-1]))


class SeenEdge(Span, Record):
    """A part of an edge of a tooth as it is seen along the axis, which is a plane spline."""

    spline: BSpline
    start: float = 0.0
    end: float = 1.0

    def point(self, t: ArrayLike) -> Complex:
        return self.spline.point(t)

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        return self.spline.derivative(t, order)


def _mirrored_knots(knots: Real) -> Real:
    """a + b - knots, the ends exact."""
    low, high = knots[0], knots[-1]
    flipped = np.clip(low + (high - knots[::-1]), low, high)
    return np.where(knots[::-1] == low, high, flipped)


def span_index(degree: int, knots: Real, t: Real) -> Index:
    """Index i with knots[i] <= t < knots[i + 1], the last span closed; shape of ``t``."""
    return np.minimum(np.maximum(np.searchsorted(knots, t, side="right") - 1, degree), len(knots) - degree - 2)


def basis(degree: int, knots: Real, t: Real) -> tuple[Index, Real]:
    """First pole at work (shape of ``t``) and the values of the degree + 1 basis functions, (..., degree + 1)."""
    return basis_and_lower(degree, knots, t)[:2]


def basis_and_lower(degree: int, knots: Real, t: Real) -> tuple[Index, Real, Real]:
    """The same, and the values of the functions one degree lower, (..., degree).

    Cox's and de Boor's recursion, written so that the values at the ends of the domain are exactly 0 and 1.
    """
    span = span_index(degree, knots, t)
    # the knots about each parameter's span, fetched once; what is summed stands first
    near = knots[np.add.outer(np.arange(1 - degree, degree + 1), span)]
    beyond, values = t - near[:degree], np.ones((1, *t.shape))
    lower = values
    for k in range(1, degree + 1):
        share = beyond[degree - k :] / (near[degree : degree + k] - near[degree - k : degree])
        raised = np.zeros((k + 1, *t.shape))
        raised[:-1] = (1 - share) * values
        raised[1:] += share * values
        lower, values = values, raised
    last, before = (np.ascontiguousarray(np.moveaxis(x, 0, -1)) for x in (values, lower))
    return span - degree, last, before


def basis_matrix(degree: int, knots: Real, t: Real) -> Real:
    """Values of all basis functions, (places, poles)."""
    first, values = basis(degree, knots, t)
    matrix = np.zeros((len(t), len(knots) - degree - 1))
    np.put_along_axis(matrix, first[:, None] + np.arange(degree + 1), values, axis=1)
    return matrix


def feet(
    curve: Curve, points: Complex, guess: Real, steps: int = _FOOT_STEPS, known: Sequence[Complex] | None = None
) -> Real:
    """Curve parameters of the perpendiculars' feet by Newton's method from a near guess, within the domain.

    Without the curvature term: the error falls by distance x curvature a step. ``known``: points and derivatives of the
    curve at the guess.
    """
    t, (low, high) = guess, curve.domain
    for _ in range(steps):
        (at, first), known = known or curve.derivatives(t, 1), None
        square = np.maximum(np.abs(first) ** 2, 1e-300)
        t = np.minimum(np.maximum(t + (np.conj(first) * (points - at)).real / square, low), high)
    return t


class _Ends(Record):
    """Both ends of each cell, (2, cells): spline parameter, foot, its rate, E and E'."""

    x: Real
    foot: Real
    rate: Real
    error: Complex
    slope: Complex


def distance_bound(curve: Curve, spline: BSpline, x: Real, t: Real) -> tuple[float, Bound]:
    """Bound of the distance between a curve and a spline with common ends, both ways, mm.

    ``x`` rising spline parameters, ``t`` near feet of theirs on the curve, both (k,) with the ends of both domains.
    The bound is "certified" where the curve has proven derivative bounds up to order 4, else "sampled", and
    at most a few percent (and roundings of the coordinates) above the distance at its own samples.
    """
    grid, part, edges = _grid(spline)
    start = feet(curve, spline.point(grid), np.interp(grid, x, t))
    start[0], start[-1] = curve.domain
    start = np.maximum.accumulate(start)
    bounds = curve.derivative_bounds(start[edges], (2, 3, 4))
    if curve.knots.size:
        grid, start, within = _cut_at_knots(curve, spline, grid, start)
        part = part[within]
    fourth = spline.derivative_bound(4, span_index(spline.degree, spline.knots, (grid[:-1] + grid[1:]) / 2))
    cells = _cell_ends(curve, spline, np.stack([grid[:-1], grid[1:]]), np.stack([start[:-1], start[1:]]))
    moduli, count, certified = bounds[:, part], len(part), bool(np.all(np.isfinite(bounds)))
    worst = float(np.abs(cells.error).max())
    proven = 0.0
    floor = 4 * TOLERANCES.relative_rounding * float(np.abs(spline.poles).max())
    for halving in range(_MOST_HALVINGS):
        rest = _proven_rest(cells, fourth, moduli) if certified else _sampled_rest(curve, spline, cells)
        found = _hull(cells) + rest
        found = np.where(np.isfinite(found), found, np.inf)
        wide = (found > worst * (1 + _MARGIN_SHARE) + floor) & (halving + 1 < _MOST_HALVINGS)
        count += int(np.count_nonzero(wide))
        wide &= (count < _MOST_CELLS) & (cells.x[1] - cells.x[0] > _LEAST_CELL)
        proven = max(proven, float(np.max(found, where=~wide, initial=0.0)))
        if not wide.any():
            break
        cells = _halved(curve, spline, cells, wide)
        fourth, moduli = np.tile(fourth[wide], 2), np.tile(moduli[:, wide], 2)
        worst = max(worst, float(np.abs(cells.error).max()))
    return max(proven, worst) + floor, "certified" if certified else "sampled"


def _grid(spline: BSpline) -> tuple[Real, Index, Index]:
    """Ends of the first cells (cells + 1,), the part of each cell, and where the parts begin and end."""
    breaks = spline.breaks
    spans = len(breaks) - 1
    per_span = max(_CELLS_PER_SPAN, math.ceil(_LEAST_CELLS / spans))
    share = np.arange(per_span) / per_span
    grid = np.append((breaks[:-1, None] + np.diff(breaks)[:, None] * share).ravel(), breaks[-1])
    parts = min(spans * per_span, max(spans, _LEAST_PARTS))
    edges = np.arange(parts + 1) * (spans * per_span) // parts
    return grid, np.repeat(np.arange(parts), np.diff(edges)), edges


def _cut_at_knots(curve: Curve, spline: BSpline, grid: Real, start: Real) -> tuple[Real, Real, Index]:
    """Ends of cells and their feet, with a cell's end at every knot of the curve, and the cell that each was part of.

    Within a cell the curve is one formula: the rest is bounded by its fourth derivative.
    """
    knots, cell = curve.knots, np.arange(len(grid) - 1)
    low = np.clip(np.searchsorted(start, knots, side="right") - 1, 0, len(cell) - 1)
    points, ways = curve.point(knots), curve.tangent(knots)
    at = np.interp(knots, start, grid)
    for _ in range(_FOOT_STEPS):
        along = (np.conj(ways) * spline.derivative(at)).real
        ahead = (np.conj(ways) * (points - spline.point(at))).real
        at = np.clip(at + ahead / np.where(along > 0, along, np.inf), grid[low], grid[low + 1])
    # a knot at an end of a cell is the foot of that end
    first, last = at - grid[low] <= _LEAST_CELL, grid[low + 1] - at <= _LEAST_CELL
    start[low[first]], start[low[last] + 1] = knots[first], knots[last]
    inner = ~(first | last)
    low, at, knots = low[inner], at[inner], knots[inner]
    order = np.argsort(np.concatenate([grid, at]), kind="stable")
    ends, feet_there = np.concatenate([grid, at]), np.concatenate([start, knots])
    return ends[order], feet_there[order], np.sort(np.concatenate([cell, low]))


def _cell_ends(curve: Curve, spline: BSpline, x: Real, foot: Real) -> _Ends:
    """E and E' at rising feet; their rate is kept within three times the cell's mean so that p rises too."""
    middle = x.mean(axis=0)
    # the spline's derivative at a knot has to be that of the cell's own side; it is continuous where C1
    inside = np.stack([x[0], np.minimum(x[1], np.nextafter(x[1], middle))])
    forward, (at, first) = spline.derivative(inside), curve.derivatives(foot, 1)
    square = np.maximum(np.abs(first) ** 2, 1e-300)
    mean = (foot[1] - foot[0]) / np.maximum(x[1] - x[0], 1e-300)
    rate = np.clip((np.conj(first) * forward).real / square, 0, 3 * mean)
    return _Ends(x, foot, rate, spline.point(x) - at, forward - first * rate)


def _halved(curve: Curve, spline: BSpline, cells: _Ends, wide: NDArray[np.bool_]) -> _Ends:
    """The cells that are too wide, each cut in two at the middle of its spline parameters."""
    x, foot = cells.x[:, wide], cells.foot[:, wide]
    middle = x.mean(axis=0)
    guess = foot.mean(axis=0) + (x[1] - x[0]) / 8 * (cells.rate[0, wide] - cells.rate[1, wide])
    points = spline.point(middle)
    between = np.clip(feet(curve, points, guess), foot[0], foot[1])
    # where the curve all but stands still its feet are all alike: one that leaves both halves a share of them
    quarter = (foot[1] - foot[0]) / 4
    even = np.clip(between, foot[0] + quarter, foot[1] - quarter)
    alike = np.abs(points - curve.point(even)) <= np.abs(points - curve.point(between)) + _ALIKE * np.abs(points)
    between = np.where(alike, even, between)
    ends = np.concatenate([x[0], middle]), np.concatenate([middle, x[1]])
    at = np.concatenate([foot[0], between]), np.concatenate([between, foot[1]])
    return _cell_ends(curve, spline, np.stack(ends), np.stack(at))


def _hull(cells: _Ends) -> Real:
    """Greatest modulus of the Bezier points of each cell's Hermite cubic of E, mm."""
    leg = (cells.x[1] - cells.x[0]) / 3
    inner = cells.error + np.stack([leg, -leg]) * cells.slope
    return np.maximum(np.abs(inner), np.abs(cells.error)).max(axis=0)


def _proven_rest(cells: _Ends, fourth: Real, moduli: Real) -> Real:
    """Bound of what E is off its Hermite cubic on each cell: h^4 / 384 times that of its fourth derivative, mm."""
    h = cells.x[1] - cells.x[0]
    m2, m3, m4 = moduli
    # the derivatives of p are bounded by the differences of its Bezier points
    mean = (cells.foot[1] - cells.foot[0]) / h
    r0, r1 = cells.rate
    p1 = np.maximum(np.maximum(r0, r1), np.abs(3 * mean - r0 - r1))
    p2 = 2 / h * np.maximum(np.abs(3 * mean - 2 * r0 - r1), np.abs(3 * mean - r0 - 2 * r1))
    p3 = 6 / h**2 * np.abs(r0 + r1 - 2 * mean)
    chain = m4 * p1**4 + 6 * m3 * p1**2 * p2 + m2 * (3 * p2**2 + 4 * p1 * p3)
    return h**4 / 384 * (fourth + chain)


def _sampled_rest(curve: Curve, spline: BSpline, cells: _Ends) -> Real:
    """Twice what E is off its Hermite cubic at the middle of each cell, mm."""
    h = cells.x[1] - cells.x[0]
    foot = cells.foot.mean(axis=0) + h / 8 * (cells.rate[0] - cells.rate[1])
    cubic = cells.error.mean(axis=0) + h / 8 * (cells.slope[0] - cells.slope[1])
    return 2 * np.abs(spline.point(cells.x.mean(axis=0)) - curve.point(foot) - cubic)
