"""Straight lines and circular arcs."""

from __future__ import annotations

import cmath

import numpy as np
from numpy.typing import ArrayLike, NDArray

from geometry.base.errors import CuspError
from geometry.base.placement import Placement2
from geometry.base.record import Record, replace
from geometry.curves.curve import Complex, Curve, Real, check_interval


class Line(Curve, Record):
    """Straight line from ``start`` to ``end``; t runs from 0 to 1."""

    start: complex
    end: complex

    @property
    def domain(self) -> tuple[float, float]:
        return 0.0, 1.0

    def point(self, t: ArrayLike) -> Complex:
        t = np.asarray(t, dtype=float)
        return (1 - t) * self.start + t * self.end

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        return np.full(np.shape(t), self.end - self.start if order == 1 else 0j)

    def tangent(self, t: ArrayLike) -> Complex:
        chord = self.end - self.start
        return np.full(np.shape(t), chord / abs(chord))

    def curvature(self, t: ArrayLike) -> Real:
        return np.zeros(np.shape(t))

    def derivative_bound(self, order: int, a: float, b: float) -> float:
        return abs(self.end - self.start) if order == 1 else 0.0

    def offset(self, distance: float) -> Line:
        chord = self.end - self.start
        step = 1j * distance * chord / abs(chord)
        return Line(self.start + step, self.end + step)

    def trimmed(self, a: float, b: float) -> Line:
        check_interval(self.domain, a, b)
        ends = self.point(np.array([a, b]))
        return Line(complex(ends[0]), complex(ends[1]))

    def reversed(self) -> Line:
        return Line(self.end, self.start)

    def placed(self, placement: Placement2) -> Line:
        return Line(placement.apply(self.start), placement.apply(self.end))

    def foot(self, points: Complex) -> tuple[Real, NDArray[np.bool_]]:
        """Parameters of the feet of points (n,) on the whole line, and which of them lie within its ends."""
        chord = self.end - self.start
        share = ((points - self.start) * chord.conjugate()).real / abs(chord) ** 2
        return share, (share >= 0) & (share <= 1)

    def mirrored(self) -> Line:
        return Line(self.end.conjugate(), self.start.conjugate())


class Arc(Curve, Record):
    """Circular arc; t is the swept angle, 0 to abs(sweep), rad; sweep > 0 turns left."""

    centre: complex
    radius: float
    start_angle: float
    sweep: float
    columns = "centre", "radius", "start_angle"

    @property
    def alike(self) -> object:
        return Arc, self._sense

    @property
    def domain(self) -> tuple[float, float]:
        return 0.0, abs(self.sweep)

    @property
    def _sense(self) -> float:
        return 1.0 if self.sweep > 0 else -1.0

    def _spoke(self, t: ArrayLike) -> Complex:
        return self.radius * np.exp(1j * (self.start_angle + self._sense * np.asarray(t, dtype=float)))

    def point(self, t: ArrayLike) -> Complex:
        return self.centre + self._spoke(t)

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        return (1j * self._sense) ** order * self._spoke(t)

    def derivatives(self, t: ArrayLike, order: int) -> list[Complex]:
        spoke = self._spoke(t)
        return [self.centre + spoke, *((1j * self._sense) ** k * spoke for k in range(1, order + 1))]

    def tangent(self, t: ArrayLike) -> Complex:
        return 1j * self._sense * self._spoke(t) / self.radius

    def curvature(self, t: ArrayLike) -> Real:
        return np.full(np.shape(t), self._sense / self.radius)

    def derivative_bound(self, order: int, a: float, b: float) -> float:
        return self.radius

    def offset(self, distance: float) -> Arc:
        radius = self.radius - self._sense * distance
        if radius <= 0:
            raise CuspError(0.0, distance)
        return replace(self, radius=radius)

    def trimmed(self, a: float, b: float) -> Arc:
        check_interval(self.domain, a, b)
        return replace(self, start_angle=self.start_angle + self._sense * a, sweep=self._sense * (b - a))

    def reversed(self) -> Arc:
        return replace(self, start_angle=self.start_angle + self.sweep, sweep=-self.sweep)

    def placed(self, placement: Placement2) -> Arc:
        return replace(self, centre=placement.apply(self.centre), start_angle=self.start_angle + placement.angle)

    def foot(self, points: Complex) -> tuple[Real, NDArray[np.bool_]]:
        """Parameters of the points of the whole circle that are nearest, (n,), rad, and which of them are the arc's."""
        swept = self.swept(points)
        return swept, (swept <= abs(self.sweep)) & (points != self.centre)

    def swept(self, points: Complex) -> Real:
        """Parameters of the points of the whole circle that are nearest to points (n,), rad."""
        return np.mod(self._sense * (np.angle(points - self.centre) - self.start_angle), 2 * cmath.pi)

    def mirrored(self) -> Arc:
        return replace(self, centre=self.centre.conjugate(), start_angle=-self.start_angle - self.sweep)


def lines_cross(a: complex, b: complex, c: complex, d: complex) -> bool:
    """Whether the lines from a to b and from c to d cross."""

    def side(a: complex, b: complex, p: complex) -> float:
        return ((b - a).conjugate() * (p - a)).imag

    return side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0


def arc_between(centre: complex, start: complex, end: complex, turns_left: bool) -> Arc:
    """The arc about ``centre`` from ``start`` to ``end``; its radius is that of ``start``."""
    spoke = start - centre
    sweep = cmath.phase((end - centre) / spoke)
    if turns_left and sweep < 0:
        sweep += 2 * cmath.pi
    elif not turns_left and sweep > 0:
        sweep -= 2 * cmath.pi
    return Arc(centre, abs(spoke), cmath.phase(spoke), sweep)
