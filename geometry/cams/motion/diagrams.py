"""Diagrams of a follower's motion as exact curves: over the cam angle, and one derivative over another.

Practicum, lessons 4 and 5: figures 4.8 and 5.4 (S'', S', S over phi), 4.9 and 5.6 (S over S'' or S').
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.errors import ConvergenceError
from geometry.base.record import Record
from geometry.base.series import FACTORIALS, Series, derived, exponential, product, taylor
from geometry.curves.bspline import BSpline
from geometry.curves.curve import Complex, Curve, Real, Span, curvature_from_derivatives, end_point, start_point
from geometry.curves.line_arc import Line
from geometry.laws.piece import LawPiece

_MOST_SPANS = 4000
_BOUND_PARTS = 16
# a derivative below this part of the largest is none: the curve stands still there
_STILL = 1e-9


class DrawnCurve(Span):
    """What all diagram curves share: they may stand still at their ends, where S' and S'' begin with 0."""

    __slots__ = ()

    def tangent(self, t: ArrayLike) -> Complex:
        """Unit tangent; where the curve stands still, its limit from inside the domain."""
        at = np.asarray(t, dtype=float)
        late = at > (self.start + self.end) / 2
        grid = np.linspace(*self.domain, 33)
        found = np.zeros(at.shape, dtype=complex)
        for order in range(1, 6):
            value = self.derivative(at, order) * np.where(late, (-1.0) ** (order - 1), 1.0)
            most = float(np.abs(self.derivative(grid, order)).max())
            good = (found == 0) & (np.abs(value) > _STILL * most)
            found = np.where(good, value, found)
        return np.asarray(found / np.abs(found), dtype=complex)

    def curvature(self, t: ArrayLike) -> Real:
        """Signed curvature, 1/mm of paper; nan where the curve stands still."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return curvature_from_derivatives(self.derivative(t), self.derivative(t, 2))


class MotionCurve(DrawnCurve, Record):
    """x = ``along`` t + ``across`` S^(p)(t), y = ``up`` S^(q)(t), moved to ``origin``; t the cam angle, rad.

    ``along`` in mm of paper per rad, ``across`` and ``up`` in mm of paper per unit of the derivative; ``orders``
    (p, q). A diagram over the cam angle has ``across`` 0, one derivative over another ``along`` 0.
    """

    piece: LawPiece
    start: float
    end: float
    origin: complex
    along: float
    across: float
    up: float
    orders: tuple[int, int]

    def point(self, t: ArrayLike) -> Complex:
        at = np.asarray(t, dtype=float)
        return self.origin + self.along * at + self._part(at, 0)

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        at = np.asarray(t, dtype=float)
        return (self.along if order == 1 else 0.0) + self._part(at, order)

    def _part(self, at: Real, order: int) -> Complex:
        p, q = self.orders
        real = self.across * self.piece.value(at, order + p) if self.across else 0.0
        return np.asarray(real + 1j * (self.up * self.piece.value(at, order + q)), dtype=complex)

    def derivative_bound(self, order: int, a: float, b: float) -> float | None:
        """Of each part of the interval: the law's own bounds."""
        edges = np.linspace(a, b, _BOUND_PARTS + 1)
        p, q = self.orders
        bounds = self.piece.bounds(order + max(p, q), edges[:-1], edges[1:])
        along = abs(self.along) if order == 1 else 0.0
        return float(np.hypot(along + abs(self.across) * bounds[order + p], abs(self.up) * bounds[order + q]).max())


class ArmCurve(DrawnCurve, Record):
    """L (1 + sense psi'(t)) exp(i (direction - sense S(t))) from the pivot at ``origin``, enlarged ``scale`` times.

    Of an oscillating roller, psi' being S'; ``direction`` of the lowest arm, rad. At the pressure angle nu the axis
    lies on the line through this point that is inclined by 90 degrees - nu to the arm, from
    tan nu = (L (1 + sense psi') - d cos psi) / (d sin psi).
    """

    piece: LawPiece
    start: float
    end: float
    origin: complex
    scale: float
    arm_length: float
    sense: int
    direction: float

    def _series(self, at: Real, order: int) -> Series:
        s = taylor(self.piece.values(at, order + 1))
        turn = exponential([1j * (self.direction - self.sense * s[0]), *(-1j * self.sense * x for x in s[1:])])
        reach = [self.sense * x for x in derived(s)]
        reach[0] = reach[0] + 1.0
        return [self.scale * self.arm_length * x for x in product(reach, turn)]

    def point(self, t: ArrayLike) -> Complex:
        return self.origin + self._series(np.asarray(t, dtype=float), 0)[0]

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        return FACTORIALS[order] * self._series(np.asarray(t, dtype=float), order)[order]

    def derivative_bound(self, order: int, a: float, b: float) -> float | None:
        """The same series of moduli: a majorant."""
        edges = np.linspace(a, b, _BOUND_PARTS + 1)
        s = taylor(self.piece.bounds(order + 1, edges[:-1], edges[1:]))
        turn = exponential([0.0 * s[0], *s[1:]])
        reach = derived(s)
        reach[0] = reach[0] + 1.0
        bound = product(reach, turn)[order] * FACTORIALS[order]
        return float(np.max(self.scale * self.arm_length * bound))


def diagram(piece: LawPiece, order: int, origin: complex, along: float, up: float) -> Curve:
    """S^(order) over the cam angle on one piece; a straight line where it is one."""
    return _straight(MotionCurve(piece, *piece.domain, origin, along, 0.0, up, (0, order)), order + 1)


def joint_diagram(piece: LawPiece, order: int, origin: complex, scale: float) -> Curve | None:
    """S over S^(order) on one piece, "joint diagram" of lessons 4 and 5, section 3.2; None of a dwell."""
    if piece.is_constant:
        return None
    return _straight(MotionCurve(piece, *piece.domain, origin, 0.0, scale, scale, (order, 0)), order)


def _straight(curve: MotionCurve, degree: int) -> Curve:
    """The line that a curve is where its piece is a polynomial of a degree at most; else the curve."""
    if curve.piece.waves or len(curve.piece.coefficients) - 1 > degree:
        return curve
    return Line(start_point(curve), end_point(curve))


def hermite_spline(curve: Curve, tolerance: float) -> tuple[BSpline, float]:
    """A C1 cubic within ``tolerance`` mm that meets points and derivatives at even steps: |E| <= h^4 M4 / 384.

    For curves that stand still at an end, where a spline with a tangent of its own would be of no use.

    Raises
    ------
    ConvergenceError
        4000 spans are not enough, or no bound is known.
    """
    a, b = curve.domain
    most = curve.derivative_bound(4, a, b)
    if most is None or not math.isfinite(most):
        raise ConvergenceError("spline of the diagram", math.inf, 0)
    spans = max(1, math.ceil((b - a) * (most / (384 * tolerance)) ** 0.25))
    if spans > _MOST_SPANS:
        raise ConvergenceError("spline of the diagram", most * ((b - a) / _MOST_SPANS) ** 4 / 384, _MOST_SPANS)
    t = np.linspace(a, b, spans + 1)
    third = (b - a) / (3 * spans)
    points, rates = curve.point(t), curve.derivative(t)
    inner = np.stack([points - third * rates, points + third * rates], axis=1).ravel()[1:-1]
    poles = np.concatenate([points[:1], inner, points[-1:]])
    knots = np.concatenate([[a, a], np.repeat(t, 2), [b, b]])
    return BSpline(3, knots, poles), most * ((b - a) / spans) ** 4 / 384
