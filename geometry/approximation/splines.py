"""B-splines of exact curves within a tolerance: near the fewest poles, with a proven bound.

Least squares of the normal distance: the tangential part of the residual counts down to 1/1000, so that the spline may
slide along the curve, and every sample is compared with its foot on the curve (tangent distance minimisation, a
Gauss-Newton method: Wang, Pottmann, Liu, ACM Transactions on Graphics 25, 2006). The first parameter is the curve's
own (best on an involute, an entire function of its roll angle) or the root of arc length times turning (best on a
fillet, whose contact angle crowds); the knots are then shifted until all spans have alike errors.
End points, end tangents and the continuity at the knots are exact for any number of spans.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from geometry.approximation.tensor import clamped
from geometry.base.errors import ConvergenceError, CuspError, ParameterError
from geometry.base.record import Record, replace
from geometry.curves.bounds import Bound
from geometry.curves.bspline import BSpline, Index, basis, distance_bound, feet
from geometry.curves.curve import Complex, Curve, Real, end_point, start_point

_LEAST_DEGREE, _MOST_DEGREE = 3, 9
MOST_SPANS = 512
_MAP_NODES = 257
# samples of a span beyond the degree
_EXTRA_SAMPLES = 3
# weight of the tangential residual, round after round: at first the parameter is held, then it slides
_FIRST_WEIGHTS = (1.0, 0.1, 0.01)
_LATER_WEIGHTS = (0.001,) * 8
# of a curve that is like the one before: its feet are nearly right
_ALIKE_WEIGHTS = (0.01, *(0.001,) * 4)
# later rounds are taken where the error is this near the tolerance
_WORTH_SLIDING = 30.0
_KNOT_ROUNDS = 2
# shifted knots stand on a grid of so many binary digits more than there are spans
_KNOT_BITS = 6
# knots are shifted where the error is this near the tolerance, and no span counts as having less error than that share
_WORTH_SHIFTING, _LEAST_SHARE = 2.0, 1e-3
# spans with which the first parameter is chosen, and caution in the estimate of the spans that are needed
_PILOT_SPANS, _CAUTION = 3, 0.9
# up to so many spans all numbers are tried: the sliding parameter makes single ones far better than the rule
_FEW_SPANS = 4
# the share of the tolerance that rounds of least squares aim at, the rest being for the proof; the least share that
# a failed proof leaves to the samples
_AIM, _LEAST_GOAL = 0.95, 0.6
_MOST_TRIES = 24
# poles are rounded to 1/128 to 1/64 of the tolerance, end legs of so many steps and more too: along the curve they are
# known to some 1e-11 mm only, and each machine's own noise takes a few of ten thousand over a finer grid's edges
_GRID_BITS, _LEAST_ROUNDED = 7, 16
# errors below this part of the greatest coordinate are those of rounding
_NOISE = 1e-13
# how often a correction is solved for, each time with what is left
_SOLUTIONS = 2
# least length of an end leg of the control polygon, in distances from the origin: its direction is then good to
# some 6e-10 rad; a curve that starts in a cusp (an involute on its base circle) would have none. A longer leg than
# the curve's own is an error itself: the least is no longer than the tolerance
_LEAST_END_LEG = 2.5e-7
# and, where the curve is short itself, of the way to the pole after it
_OF_NEXT = 0.25

ParameterMap = Callable[[Real], Real]
# first and last point, first and last tangent
Ends = tuple[complex, complex, complex, complex]


class SplineFit(Record):
    """A spline of a curve, the bound of their distance both ways (mm), how it was found, and the knot spans."""

    spline: BSpline
    max_error: float
    bound: Bound
    pieces: int
    draft: _Draft | None = None


class _Layout(Record, dict=True):
    """Knots, and samples x (spans, samples) with their basis values (.., degree + 1) and poles at work (spans, ..)."""

    degree: int
    knots: Real
    breaks: Real
    x: Real
    values: Real
    index: Index

    @property
    def count(self) -> int:
        return len(self.knots) - self.degree - 1

    @cached_property
    def columns(self) -> Index:
        """Of each span the unknowns at work, (spans, 2 (degree + 1)): real parts of poles, then imaginary ones."""
        return np.concatenate([self.index, self.count + self.index], axis=1)

    @cached_property
    def cells(self) -> Index:
        """Where the products of two of them stand in the normal equations, row by row."""
        return np.asarray((2 * self.count * self.columns[:, :, None] + self.columns[:, None, :]).ravel())

    @cached_property
    def free(self) -> Index:
        """The unknowns without those of the end poles, and with one of each end leg."""
        n = self.count
        return np.concatenate([np.arange(1, n - 1), np.arange(n + 2, 2 * n - 2)])

    def points(self, poles: Complex) -> Complex:
        """The spline's points at the samples."""
        return np.einsum("jqk,jk->jq", self.values, poles[self.index])

    def greville(self) -> Real:
        """Knot averages: the parameters at which the poles stand."""
        return np.convolve(self.knots[1:-1], np.ones(self.degree) / self.degree, "valid")


class _Draft(Record):
    """Poles, the samples' feet, the greatest sampled error of each span and of all; inf where it runs backwards.

    ``span``: the curve's domain.
    """

    layout: _Layout
    poles: Complex
    feet: Real
    errors: Real
    error: float
    span: tuple[float, float]

    @property
    def spans(self) -> int:
        return len(self.layout.breaks) - 1

    @property
    def spline(self) -> BSpline:
        return BSpline(self.layout.degree, self.layout.knots, self.poles)


def fit_spline(
    curve: Curve,
    tolerance: float,
    *,
    degree: int,
    continuity: int,
    like: SplineFit | None = None,
    most: int = MOST_SPANS,
) -> SplineFit:
    """B-spline within ``tolerance`` mm of a curve, near the least number of poles.

    ``continuity`` is that of the spline's derivatives at interior knots, of multiplicity degree - continuity:
    degree - 1 gives simple knots (cubic C2 for drawings), and fewer poles than anything less. First and last pole
    are the curve's end points to the bit, the end tangents are the curve's. Method: module docstring.
    ``like``: the fit of a curve that is nearly alike, whose knots and feet are tried first.

    Raises
    ------
    ParameterError
        Degree not from 3 to 9, continuity not from 1 to degree - 1, or tolerance not positive.
    CuspError
        The curve turns back.
    ConvergenceError
        ``most`` spans are not enough, or rounding keeps the error above the tolerance.
    """
    if not tolerance > 0:
        raise ParameterError("tolerance", tolerance, "not_above_zero")
    if like is not None and (found := _alike(curve, like, tolerance)) is not None:
        return found
    return _fit(curve, tolerance, degree, continuity, most)


# sheets, drawings and their languages show the same curves
@lru_cache(maxsize=256)
def _fit(curve: Curve, tolerance: float, degree: int, continuity: int, most: int) -> SplineFit:
    """``fit_spline`` without another fit."""
    parameter, draft = _first_parameter(curve, degree, continuity, _AIM * tolerance)
    spans = max(1, math.floor(_PILOT_SPANS * _CAUTION * _excess(draft, tolerance)))
    spans = spans if spans > _FEW_SPANS else 1
    goal, made, refitted = tolerance, (_PILOT_SPANS, tolerance), 0
    for _ in range(_MOST_TRIES):
        if spans > most:
            break
        if (spans, goal) != made:
            draft, made = _fitted(curve, parameter, spans, degree, continuity, _AIM * goal), (spans, goal)
        if draft.error <= goal:
            draft = _rounded(draft, tolerance)
            error, bound = _bound(curve, draft)
            if error <= tolerance:
                draft.poles.flags.writeable = False
                return SplineFit(draft.spline, error, bound, spans, draft)
            # the samples have missed a peak by so much: more rounds once, then more spans
            goal = tolerance * max(draft.error / error, _LEAST_GOAL)
            if refitted < spans:
                refitted = spans
                continue
        spans = max(spans + 1 + spans // 64, min(2 * spans, math.floor(spans * _CAUTION * _excess(draft, goal))))
    raise ConvergenceError("spline for the tolerance", draft.error, draft.spans)


def spline_of_spans(curve: Curve, spans: int, *, degree: int, continuity: int, refined: bool = True) -> SplineFit:
    """The spline of a given number of knot spans and its error, mm; arguments and errors as in fit_spline.

    Not ``refined``: one least-squares fit on knots even in the curve's best parameter, the bare method, whose
    error falls by its order; refining lessens the error by sliding feet and knots, unevenly from one number to another.
    """
    parameter, _ = _first_parameter(curve, degree, continuity, 0.0)
    if refined:
        draft = _fitted(curve, parameter, spans, degree, continuity, 0.0)
    else:
        layout = _layout(degree, continuity, np.linspace(0.0, 1.0, spans + 1))
        draft = _relaxed(curve, layout, curve.point(parameter(layout.greville())), parameter(layout.x), math.inf)
    if not math.isfinite(draft.error):
        raise ConvergenceError(f"spline of {spans} spans", draft.error, len(_FIRST_WEIGHTS))
    error, bound = _bound(curve, draft)
    return SplineFit(draft.spline, error, bound, spans)


def _alike(curve: Curve, like: SplineFit, tolerance: float) -> SplineFit | None:
    """The spline on the knots of another one, from its feet; None where it is not good enough at once."""
    if like.draft is None or like.spline.degree != like.draft.layout.degree:
        return None
    model, (low, high) = like.draft, curve.domain
    start, end = like.draft.span
    shares = (model.feet - start) / (end - start)
    t = low + (high - low) * shares
    layout = model.layout
    poles = curve.point(low + (high - low) * np.interp(layout.greville(), layout.x.ravel(), shares.ravel()))
    draft = _relaxed(curve, layout, poles, t, _AIM * tolerance, _ALIKE_WEIGHTS)
    if draft.error > tolerance:
        return None
    draft = _rounded(draft, tolerance)
    error, bound = _bound(curve, draft)
    return SplineFit(draft.spline, error, bound, model.spans, draft) if error <= tolerance else None


def _rounded(draft: _Draft, tolerance: float) -> _Draft:
    """The draft with its poles on a grid of a hundredth of the tolerance, far above what machines round differently.

    Ends stay, and the lengths of the end legs are rounded in place of their poles.
    """
    grid = 2.0 ** (math.frexp(tolerance)[1] - _GRID_BITS)
    poles, (start, *_, end) = np.round(draft.poles / grid) * grid, draft.poles.tolist()
    for place, corner in ((1, start), (-2, end)):
        leg = draft.poles[place] - corner
        length = round(abs(leg) / grid) * grid
        poles[place] = corner + leg * (length / abs(leg) if length > _LEAST_ROUNDED * grid else 1.0)
    poles[0], poles[-1] = start, end
    return replace(draft, poles=poles)


def spline_on_knots(curve: Curve, model: BSpline, poles: Complex, shares: Real, tolerance: float) -> BSpline:
    """The spline of a curve on the simple knots of another one, from ``poles`` that are nearly right.

    It is bettered until its samples keep ``tolerance`` mm, or no more. ``shares`` of the curve's domain: feet of the
    samples ``samples_of(model)``, rising.
    """
    layout = _layout(model.degree, model.degree - 1, model.breaks)
    low, high = curve.domain
    at = (low + (high - low) * shares).reshape(layout.x.shape)
    return _rounded(_relaxed(curve, layout, poles, at, _AIM * tolerance, _ALIKE_WEIGHTS), tolerance).spline


def samples_of(model: BSpline) -> Real:
    """The parameters at which a spline of simple knots is held against its curve."""
    return _layout(model.degree, model.degree - 1, model.breaks).x.ravel()


def _excess(draft: _Draft, tolerance: float) -> float:
    """Factor by which the spans of a draft have to grow: its error falls like spans^-(degree + 1)."""
    return (draft.error / tolerance) ** (1 / (draft.layout.degree + 1)) if math.isfinite(draft.error) else 2.0


def _bound(curve: Curve, draft: _Draft) -> tuple[float, Bound]:
    """Bound of the distance between the curve and a draft's spline."""
    x, t = (np.pad(part.ravel(), 1) for part in (draft.layout.x, draft.feet))
    (x[0], x[-1]), (t[0], t[-1]) = draft.spline.domain, curve.domain
    return distance_bound(curve, draft.spline, x, t)


def _first_parameter(curve: Curve, degree: int, continuity: int, tolerance: float) -> tuple[ParameterMap, _Draft]:
    """The parameter that gives a spline of few spans the smaller error, and that spline."""
    if not _LEAST_DEGREE <= degree <= _MOST_DEGREE:
        raise ParameterError("degree", degree, "out_of_range", least=_LEAST_DEGREE, most=_MOST_DEGREE)
    if not 1 <= continuity < degree:
        raise ParameterError("continuity", continuity, "out_of_range", least=1, most=degree - 1)
    t = np.linspace(*curve.domain, _MAP_NODES)
    tangent = curve.tangent(t)
    backwards = np.flatnonzero((np.conj(tangent[:-1]) * tangent[1:]).real < 0)
    if backwards.size:
        raise CuspError(float(t[backwards[0]]), 0.0)
    maps = [m for m in (_natural(curve), _arc_and_turning(curve)) if m is not None]
    drafts = [_fitted(curve, m, _PILOT_SPANS, degree, continuity, tolerance) for m in maps]
    # errors of rounding choose nothing: each machine has its own
    floor = _NOISE * float(np.abs(drafts[0].poles).max())
    best = min(range(len(maps)), key=lambda i: max(drafts[i].error, floor))
    return maps[best], drafts[best]


def _natural(curve: Curve) -> ParameterMap:
    low, high = curve.domain
    return lambda x: low + (high - low) * x


def _arc_and_turning(curve: Curve) -> ParameterMap | None:
    """The inverse of the integral of sqrt(speed x turning rate) = speed sqrt(curvature), made to run from 0 to 1.

    None where the curve is straight, has an inflection, at which the root is not smooth, or turns too unevenly for
    this, and where it is the curve's own parameter.
    """
    t = np.linspace(*curve.domain, 2 * _MAP_NODES - 1)
    first, second = curve.derivative(t), curve.derivative(t, 2)
    with np.errstate(divide="ignore", invalid="ignore"):
        turning = (np.conj(first) * second).imag / np.abs(first)
    if turning.min() < 0 < turning.max():
        return None
    rate = np.sqrt(np.abs(turning))
    if not (np.all(np.isfinite(rate)) and 1e-3 * rate.max() < rate.min() < (1 - 1e-9) * rate.max()):
        return None
    # Simpson's rule over the nodes, the rate between them at the middles
    steps = (rate[:-2:2] + 4 * rate[1::2] + rate[2::2]) * (t[2] - t[0]) / 6
    whole = float(steps.sum())
    nodes, slopes, x = t[::2], whole / rate[::2], np.concatenate([[0.0], np.cumsum(steps)]) / whole

    def inverse(at: Real) -> Real:
        i = np.clip(np.searchsorted(x, at, side="right") - 1, 0, len(x) - 2)
        h = x[i + 1] - x[i]
        s = (at - x[i]) / h
        bow = (1 - s) * h * slopes[i] - s * h * slopes[i + 1] + (2 * s - 1) * (nodes[i + 1] - nodes[i])
        return nodes[i] + s * (nodes[i + 1] - nodes[i]) + s * (1 - s) * bow

    return inverse


def _layout(degree: int, continuity: int, breaks: Real) -> _Layout:
    """Clamped knots at ``breaks`` and Chebyshev samples in every span."""
    knots = clamped(degree, breaks, degree - continuity)
    samples = degree + _EXTRA_SAMPLES
    share = (1 - np.cos(np.pi * (np.arange(samples) + 0.5) / samples)) / 2
    x = breaks[:-1, None] + np.diff(breaks)[:, None] * share
    first, values = basis(degree, knots, x)
    return _Layout(degree, knots, breaks, x, values, first[:, :1] + np.arange(degree + 1))


def _fitted(
    curve: Curve, parameter: ParameterMap, spans: int, degree: int, continuity: int, tolerance: float
) -> _Draft:
    """The best spline of a number of spans found, or the first one within the tolerance."""
    layout = _layout(degree, continuity, np.linspace(0.0, 1.0, spans + 1))
    poles = curve.point(parameter(layout.greville()))
    latest = best = _relaxed(curve, layout, poles, parameter(layout.x), tolerance)
    for _ in range(_KNOT_ROUNDS if spans > 1 else 0):
        if best.error <= tolerance or not _is_near(best.error, tolerance, _WORTH_SHIFTING):
            break
        layout = _layout(degree, continuity, _shifted(latest))
        near = np.interp(layout.x, latest.layout.x.ravel(), latest.feet.ravel())
        t = feet(curve, latest.spline.point(layout.x), near)
        latest = _relaxed(curve, layout, latest.spline.point(layout.greville()), t, tolerance)
        best = min(best, latest, key=lambda d: d.error)
    return best


def _shifted(draft: _Draft) -> Real:
    """Knots at which all spans would have the same error, if it grows like their length^(degree + 1)."""
    breaks, power = draft.layout.breaks, 1 / (draft.layout.degree + 1)
    share = np.maximum(draft.errors, _LEAST_SHARE * draft.errors.max()) ** power
    whole = np.concatenate([[0.0], np.cumsum(share)])
    shifted = np.interp(np.linspace(0, whole[-1], len(breaks)), whole, breaks)
    # even places: what errors have lost to rounding moves no knot
    grid = 2.0 ** (_KNOT_BITS + len(breaks).bit_length())
    even = np.round(shifted * grid) / grid
    if np.all(np.diff(even) > 0):
        shifted = even
    shifted[0], shifted[-1] = breaks[0], breaks[-1]
    return shifted


def _is_near(error: float, tolerance: float, factor: float) -> bool:
    """Whether an error is within a factor of the tolerance; always where none is asked for."""
    return error <= factor * tolerance if tolerance > 0 else math.isfinite(error)


def _relaxed(
    curve: Curve,
    layout: _Layout,
    poles: Complex,
    t: Real,
    tolerance: float,
    weights: tuple[float, ...] = _FIRST_WEIGHTS + _LATER_WEIGHTS,
) -> _Draft:
    """Rounds of least squares and new feet from poles near the curve; the best round, or the first that is enough."""
    ends = _ends(curve)
    least = _LEAST_END_LEG * max(abs(ends[0]), abs(ends[1]))
    least = min(least, tolerance) if tolerance > 0 else least
    poles = _with_ends(ends, poles, least)
    best: _Draft | None = None
    known, points = curve.derivatives(t, 1), layout.points(poles)
    for index, weight in enumerate(weights):
        change = _correction(ends, layout, known[0] - points, curve.tangent(t), weight)
        poles = _with_ends(ends, poles + change, least)
        points = layout.points(poles)
        before, t = t, feet(curve, points, t, steps=2, known=known)
        if not np.all(np.diff(t.ravel()) > 0):
            # where the curve all but stands still a step to a foot leads too far: it stays, and feet keep their order
            nearer = np.abs(points - curve.point(t)) < np.abs(points - known[0])
            t = np.maximum.accumulate(np.where(nearer, t, before).ravel()).reshape(t.shape)
        known = curve.derivatives(t, 1)
        errors = np.abs(points - known[0]).max(axis=1)
        error = float(errors.max())
        if best is None or error < best.error:
            best = _Draft(layout, poles, t, errors, error, curve.domain)
        far = index + 1 >= len(_FIRST_WEIGHTS) and not _is_near(best.error, tolerance, _WORTH_SLIDING)
        if best.error <= tolerance or far:
            break
    assert best is not None
    return best


def _with_ends(ends: Ends, poles: Complex, least: float) -> Complex:
    """Poles whose ends are the curve's to the bit, and whose end legs lie along its tangents, ``least`` mm long."""
    start, end, leave, arrive = ends
    poles = poles.copy()
    first, last = min(least, abs(poles[2] - start) * _OF_NEXT), min(least, abs(end - poles[-3]) * _OF_NEXT)
    poles[1] = start + leave * max(first, ((poles[1] - start) * leave.conjugate()).real)
    poles[-2] = end - arrive * max(last, ((end - poles[-2]) * arrive.conjugate()).real)
    poles[0], poles[-1] = start, end
    return poles


def _ends(curve: Curve) -> Ends:
    """First and last point, first and last tangent."""
    leave, arrive = (complex(curve.tangent(at)) for at in curve.domain)
    return start_point(curve), end_point(curve), leave, arrive


def _correction(ends: Ends, layout: _Layout, off: Complex, tangent: Complex, weight: float) -> Complex:
    """Change of the poles by least squares: normal residuals count 1, tangential ones ``weight``.

    ``off``: from the samples to their feet on the curve; ``tangent``: of the curve there.

    Normal equations, assembled span by span. Being those of a correction, their rounding is corrected by the next
    round. The end poles stay, their neighbours move along the end tangents.
    """
    residual = np.conj(tangent) * off
    turned = layout.values * np.conj(tangent)[..., None]
    normal = np.concatenate([turned.imag, turned.real], axis=2)
    sliding = weight * np.concatenate([turned.real, -turned.imag], axis=2)
    rows = np.concatenate([normal, sliding], axis=1)
    known = np.concatenate([residual.imag, weight * residual.real], axis=1)
    n, columns, kept = layout.count, layout.columns, layout.free
    blocks = rows.transpose(0, 2, 1) @ rows
    matrix = _summed(layout.cells, blocks, 4 * n * n).reshape(2 * n, 2 * n)
    # the end legs' directions become unknowns in place of the real parts of their poles
    _, _, leave, arrive = ends
    ways = ((1, leave), (n - 2, arrive))
    for line in (matrix, matrix.T):
        _along(line, n, ways)
    reduced = matrix[np.ix_(kept, kept)]
    reduced.ravel()[:: len(reduced) + 1] += 1e-15 * np.trace(reduced) / len(reduced)
    inverse, change, left = np.linalg.inv(reduced), np.zeros(n, dtype=complex), known
    # what the squared matrix has rounded away is found from the residuals of its rows: the same poles on any machine
    for again in range(_SOLUTIONS):
        if again:
            left = known - np.einsum("jqk,jk->jq", rows, np.concatenate([change.real, change.imag])[columns])
        right = _summed(columns.ravel(), np.einsum("jqk,jq->jk", rows, left), 2 * n)
        _along(right, n, ways)
        solved = np.zeros(2 * n)
        solved[kept] = inverse @ right[kept]
        step = solved[:n] + 1j * solved[n:]
        step[1] *= leave
        step[n - 2] *= arrive
        change += step
    return change


def _summed(places: NDArray[np.intp], shares: Real, size: int) -> Real:
    """Sums of shares by their places, (size,)."""
    return np.asarray(np.bincount(places, weights=shares.ravel(), minlength=size), dtype=np.float64)


def _along(line: Real, n: int, ways: Sequence[tuple[int, complex]]) -> None:
    """The rows of the real parts of poles become those of their ways along directions."""
    for pole, way in ways:
        line[pole] = way.real * line[pole] + way.imag * line[n + pole]
