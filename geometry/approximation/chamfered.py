"""Chamfers for CAD: the sections between two boundaries as splines on common knots, polynomials over the depth.

A chamfer's section at any depth is the exact boundary there, segment for segment (``Wall.section``). Each segment is
taken at Chebyshev's depths on the knots of the whole boundary's spline, and what lies between is interpolated: a corner
then runs along its own curve, not along a chord, and neighbouring faces share it. The degree over the depth is the
least that leaves every corner and every section in its place; what is left is measured at the depths between the nodes.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise

import numpy as np

from geometry.approximation.outline import CadCurve, Outline, parted, spline_outline
from geometry.approximation.splines import samples_of, spline_on_knots
from geometry.base.errors import ConvergenceError
from geometry.base.record import replace
from geometry.curves.bounds import Bound
from geometry.curves.bspline import BSpline, basis_matrix, distance_bound, feet
from geometry.curves.curve import Complex, Curve, Real, at_shares, end_point, start_point
from geometry.curves.line_arc import Arc, Line
from geometry.plane.profile import Profile

# what corners may be off between the nodes, mm: below the tolerance by which kernels know their edges, 1e-7
_CORNER_MM = 9e-8
# the greatest degree over the depth, and how often a chamfer's pieces are halved
_MOST_DEGREE, _MOST_DOUBLED = 6, 3
# the tolerance's shares that the splines of a boundary are made with, one after the other
_SHARES = (0.9, 0.3, 0.1, 0.03)
# samples of a segment where the degree over the depth is chosen
_ROUGH_SAMPLES = 17
# points of a knot span that are measured between the nodes, and how much more the error may be between them
_DENSE, _SAMPLED = 48, 1.03

# the exact boundary at shares of a chamfer's depth, from 0 (whole) to 1
Sections = Callable[[float], Profile]


def chamfered_outlines(
    whole: Profile, chamfers: Sequence[Sequence[Sections]], tolerance: float, *, degree: int, turned: bool = False
) -> tuple[Outline, ...]:
    """The whole boundary and the end of each chamfer within ``tolerance`` mm; each end has the poles of its faces.

    ``chamfers``: the pieces of each one's depth, one behind the other. ``turned``: the boundary is that of a screw
    surface too.

    Raises
    ------
    ConvergenceError
        The tolerance asks for more than the splines can give.
    """
    error = math.inf
    for share in _SHARES:
        outline = spline_outline(
            whole, share * tolerance, degree=degree, continuity=degree - 1, turned=turned, at_knots=True
        )
        made = []
        for pieces in chamfers:
            above = outline
            for sections in pieces:
                above = _end_of(sections(0.0), above, sections, share * tolerance)
                made.append(above)
        error = max(o.max_error for o in made)
        if error <= tolerance:
            return outline, *made
    raise ConvergenceError("chamfer for the tolerance", error, len(_SHARES))


def node_shares(degree: int) -> Real:
    """The shares of the depth at which a chamfer of a degree is exact: Chebyshev's points with both ends."""
    return np.asarray((1 - np.cos(np.pi * np.arange(degree + 1) / degree)) / 2)


def bezier_poles(values: Complex) -> Complex:
    """Poles (..., degree + 1) of the polynomials over the depth that take values at the shares of the nodes."""
    degree = values.shape[-1] - 1
    poles = values @ np.linalg.inv(_bernstein(degree, node_shares(degree))).T
    poles[..., 0], poles[..., -1] = values[..., 0], values[..., -1]
    return np.asarray(poles)


def _bernstein(degree: int, shares: Real) -> Real:
    """Values (shares, degree + 1) of Bernstein's polynomials."""
    k = np.arange(degree + 1)
    binomial = np.array([math.comb(degree, int(j)) for j in k])
    return np.asarray(binomial * shares[:, None] ** k * (1 - shares[:, None]) ** (degree - k))


def _between(degree: int) -> Real:
    """The shares half way between the nodes' angles, where an interpolation is worst."""
    return np.asarray((1 - np.cos(np.pi * (np.arange(degree) + 0.5) / degree)) / 2)


def _curves(sections: Sections, shares: Real) -> list[list[Curve]]:
    """The curves (segments, shares) of a chamfer's sections."""
    rows = [[s.curve for s in parted(sections(share)).period] for share in shares.tolist()]
    return [list(curves) for curves in zip(*rows, strict=True)]


def pieces_needed(
    sections: Sections, span: tuple[float, float], *ways: Callable[[int], tuple[float, ...]]
) -> list[float]:
    """The shares at which a chamfer is cut from one to the other end of a span, each piece near a polynomial.

    The fewest that do of what the ``ways`` make of 1, 2, 4 and 8; else what the first makes of 8. More than one is
    needed where the form changes within the span, as where an offset flank begins to be cut at its foot.
    """
    low, high = span
    own = _piece(sections, low, high)
    counts = [2**k for k in range(_MOST_DOUBLED + 1)]
    tries = sorted((way(count) for way in ways for count in counts), key=len)
    near = (cuts for cuts in tries if all(_degree(_piece(own, *ends)) for ends in pairwise((0.0, *cuts))))
    return [(1 - share) * low + share * high for share in next(near, ways[0](counts[-1]))]


def _piece(sections: Sections, low: float, high: float) -> Sections:
    return lambda share: sections((1 - share) * low + share * high)


def _degree(sections: Sections) -> int | None:
    """The least degree over the depth that leaves corners and sections, as far as samples tell, in their place."""
    for degree in range(1, _MOST_DEGREE + 1):
        nodes, tests = _curves(sections, node_shares(degree)), _curves(sections, _between(degree))
        if all(_strays(a, b) <= _CORNER_MM for a, b in zip(nodes, tests, strict=True)):
            return degree
    return None


def _strays(nodes: list[Curve], tests: list[Curve]) -> float:
    """How far samples of a segment, interpolated over the depth, lie off their sections, mm."""
    degree = len(nodes) - 1
    weights = _bernstein(degree, _between(degree))
    samples = np.array([_spread(c, np.linspace(0, 1, _ROUGH_SAMPLES)) for c in nodes]).T
    made = weights @ bezier_poles(samples).T
    worst = 0.0
    for curve, points in zip(tests, made, strict=True):
        t = at_shares(curve, np.linspace(0, 1, _ROUGH_SAMPLES))
        gaps = points - curve.point(t)
        worst = max(worst, _off(gaps, curve, t))
        if isinstance(curve, Arc):
            # a cone's edges run by its own angles
            worst = max(worst, 2 * float(np.abs(gaps[[0, -1]]).max()))
    return worst


def _spread(curve: Curve, shares: Real) -> Complex:
    return np.asarray(curve.point(at_shares(curve, shares)))


def _end_of(whole: Profile, outline: Outline, sections: Sections, tolerance: float) -> Outline:
    """The end of a chamfer from a whole boundary, with the poles of every segment's face and the bound of them all."""
    degree = _degree(sections) or _MOST_DEGREE
    nodes, tests = _curves(sections, node_shares(degree)), _curves(sections, _between(degree))
    period: list[CadCurve] = []
    faces, worst = [], outline.max_error
    certified = True
    for base, segment, own, others in zip(outline.period, parted(whole).period, nodes, tests, strict=True):
        if isinstance(base, BSpline) and base.degree > 1:
            rows, error, proven = _spline_rows(base, segment.curve, own, others, tolerance)
            period.append(BSpline(base.degree, base.knots, rows[-1]))
        else:
            end = own[-1]
            assert isinstance(end, Arc | Line)
            rows, proven = np.array([[start_point(c), end_point(c)] for c in own]), True
            # a straight edge of a screw surface is a spline
            period.append(BSpline(1, base.knots, rows[-1]) if isinstance(base, BSpline) else end)
            error = _strays(own, others)
        worst, certified = max(worst, error), certified and proven
        faces.append(bezier_poles(rows.T))
    bound: Bound = outline.bound if degree == 1 and worst == outline.max_error and certified else "sampled"
    return replace(outline, period=tuple(period), max_error=worst, bound=bound, faces=tuple(faces))


def _spline_rows(
    base: BSpline, whole: Curve, nodes: list[Curve], tests: list[Curve], tolerance: float
) -> tuple[Complex, float, bool]:
    """Poles (nodes, n) on the knots of a segment's spline, the greatest error at all depths, and whether it is proven.

    They begin with least squares of how far each section lies from the whole boundary at equal shares, at the feet of
    the spline's samples; the ends are exact.
    """
    x = samples_of(base)
    foot = _shares_of_feet(base, whole, x)
    matrix = basis_matrix(base.degree, base.knots, x)
    own = _spread(whole, foot)
    moved = np.array([_spread(c, foot) - own for c in nodes]).T
    ends = np.array([[start_point(c), end_point(c)] for c in nodes]).T - base.poles[[0, -1], None]
    inner = np.linalg.lstsq(matrix[:, 1:-1], moved - matrix[:, [0, -1]] @ ends, rcond=None)[0]
    guesses = (base.poles[:, None] + np.concatenate([ends[:1], inner, ends[1:]])).T
    fits = [spline_on_knots(c, base, guess, foot, tolerance) for c, guess in zip(nodes[1:], guesses[1:], strict=True)]
    rows = np.array([base.poles, *(fit.poles for fit in fits)])
    between = _bernstein(len(nodes) - 1, _between(len(nodes) - 1)) @ bezier_poles(rows.T).T
    padded, shares = np.pad(x, 1), np.pad(foot, 1)
    (padded[0], padded[-1]), shares[-1] = base.domain, 1.0
    if len(nodes) == 2:
        error, bound = distance_bound(nodes[-1], fits[-1], padded, at_shares(nodes[-1], shares))
    else:
        error, bound = 0.0, "sampled"
    at = _dense(base)
    for curve, poles in zip([*nodes[1:], *tests], [*rows[1:], *between], strict=True):
        points, guess = BSpline(base.degree, base.knots, poles).point(at), np.interp(at, padded, shares)
        foot_of = feet(curve, points, at_shares(curve, guess))
        error = max(error, _SAMPLED * _off(points - curve.point(foot_of), curve, foot_of))
    return rows, error, bound == "certified"


def _dense(spline: BSpline) -> Real:
    """Parameters of many points in every span, and its ends."""
    breaks = spline.breaks
    return np.append((breaks[:-1, None] + np.diff(breaks)[:, None] * np.arange(_DENSE) / _DENSE).ravel(), breaks[-1])


def _off(gaps: Complex, curve: Curve, t: Real) -> float:
    """Greatest distance of points from a curve by their gaps from their feet, mm; it goes on straight beyond its ends.

    Where a corner stands along both of its curves does not matter, as long as it stands on both.
    """
    return float(np.abs((gaps * np.conj(curve.tangent(t))).imag).max())


def _shares_of_feet(spline: BSpline, curve: Curve, x: Real) -> Real:
    """Shares of a curve's domain at which a spline's points have their feet, rising."""
    low, high = curve.domain
    shares = np.linspace(0, 1, 16 * len(x))
    points = spline.point(x)
    near = np.abs(points[:, None] - _spread(curve, shares)).argmin(axis=1)
    found = (feet(curve, points, at_shares(curve, shares[near])) - low) / (high - low)
    return np.asarray(np.maximum.accumulate(found))
