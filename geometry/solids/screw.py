"""Screw surfaces over splines: the section's spline times a spline of the turn, with a proven bound.

The surface over a section c(t) that turns by theta over its height is c(t) exp(i theta v), v from 0 to 1 upwards.
With splines C of c and E of the turn, C(t) E(v) is a tensor product, and it is off by at most
|C - c| |E| + |c| |E - exp|: what both splines are off. E interpolates value and three derivatives at both ends of each
span (Hermite, degree 7), which leaves |E - exp| <= delta^8 / (8! 2^8) for a span of delta rad.
"""

from __future__ import annotations

import cmath
import math
from itertools import pairwise

import numpy as np

from geometry.approximation.outline import Outline
from geometry.approximation.tensor import clamped
from geometry.base.record import replace
from geometry.curves.bounds import Bound
from geometry.curves.bspline import BSpline, basis_matrix
from geometry.curves.curve import Real
from geometry.solids.body import Body, Loop, Wall

_DEGREE = 7
_REMAINDER = 1 / (math.factorial(8) * 2.0**8)
# what a turn is off at the rim, mm: far below the tolerance by which kernels know their faces and edges, 1e-7
_TURN_MM = 1e-8
# rounding of a turn's poles, without unit
_ROUNDING = 1e-14
# screw surfaces that turn farther are cut into several: kernels know a cylinder's face by less than a turn, rad
_MOST_TURN = 2.0


def turn_error(reach: float) -> float:
    """Bound of reach |E(v) - exp(i theta v)| that every turn of a boundary within ``reach`` mm keeps, mm."""
    return max(_TURN_MM, 2 * _ROUNDING * reach)


def turn_spans(twist: float, reach: float) -> int:
    """Spans that a spline of a turn (rad) needs for a boundary within ``reach`` mm."""
    allowed = turn_error(reach) / reach - _ROUNDING
    return max(1, math.ceil(abs(twist) * (_REMAINDER / allowed) ** (1 / 8)))


def turn_spline(twist: float, spans: int) -> BSpline:
    """E: a spline of exp(i twist v), v from 0 to 1, of degree 7 and three continuous derivatives."""
    edges = np.linspace(0.0, 1.0, spans + 1)
    delta = twist / spans
    poles: list[complex] = [1.0]
    for a, _ in pairwise(edges.tolist()):
        start, end = cmath.exp(1j * twist * a), cmath.exp(1j * (twist * a + delta))
        leaving, arriving = _bezier_ends(1j * delta), _bezier_ends(-1j * delta)
        poles += [start * leaving[k] for k in (1, 2, 3)] + [end * arriving[k] for k in (3, 2, 1)] + [end]
    pieces = BSpline(_DEGREE, clamped(_DEGREE, edges, _DEGREE), np.array(poles))
    if spans == 1:
        return pieces
    # three derivatives are continuous at the inner knots: fewer poles hold the same curve
    knots = clamped(_DEGREE, edges, _DEGREE - 3)
    share = (1 - np.cos(np.pi * (np.arange(_DEGREE + 1) + 0.5) / (_DEGREE + 1))) / 2
    v = (edges[:-1, None] + np.diff(edges)[:, None] * share).ravel()
    found = np.linalg.lstsq(basis_matrix(_DEGREE, knots, v), pieces.point(v), rcond=None)[0]
    found[0], found[-1] = pieces.poles[0], pieces.poles[-1]
    return BSpline(_DEGREE, knots, np.asarray(found, dtype=np.complex128))


def _bezier_ends(rate: complex) -> list[complex]:
    """First four Bezier points of degree 7 with the derivatives 1, rate, rate^2, rate^3 at the start."""
    falling = [1.0, 1 / 7, 1 / 42, 1 / 210]
    differences = [falling[k] * rate**k for k in range(4)]
    return [sum(math.comb(k, j) * differences[j] for j in range(k + 1)) for k in range(4)]


def heights(spline: BSpline, low: float, high: float) -> Real:
    """Heights of the poles of a turn's spline between two levels, mm: its knot averages."""
    averages = np.array([spline.knots[i + 1 : i + 1 + spline.degree].mean() for i in range(len(spline.poles))])
    return low + (high - low) * averages


def with_turn_error(outline: Outline, reach: float) -> Outline:
    """An outline within ``reach`` mm whose bound holds on the screw surface over it too."""
    error = turn_error(reach)
    bound: Bound = "sampled" if outline.bound == "sampled" else "certified"
    return replace(outline, max_error=outline.max_error * (1 + error / reach) + error, bound=bound)


def cut_twists(body: Body) -> Body:
    """The body with its screw surfaces cut into ones that turn by less than some two radians."""
    loops, walls = list(body.loops), []
    for wall in body.walls:
        twist = 0.0 if body.is_chamfer(wall) else body.twist(wall)
        count = max(1, math.ceil(abs(twist) / _MOST_TURN))
        (low, high), first = body.height(wall), body.loops[wall.lower]
        below = wall.lower
        for k in range(1, count):
            z = low + (high - low) * k / count
            loops.append(Loop(first.profile, z, first.turn + twist * k / count, first.shift))
            walls.append(Wall(below, len(loops) - 1))
            below = len(loops) - 1
        walls.append(replace(wall, lower=below))
    return replace(body, loops=tuple(loops), walls=tuple(walls))
