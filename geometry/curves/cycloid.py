"""Parallel curves of trochoids: what a round pin cuts where one circle rolls on another.

A pin's centre draws A e^{is} - B e^{ims} in the frame of the body that it cuts (A > 0, m > 1). With the shortening
coefficient lambda = m B / A below 1 the path has no cusps (cycloidal disc); with lambda = 1 it is the ordinary
epicycloid, whose parallel is a sum of three turning vectors (lantern gear), as that of the hypocycloid is (clock
gears). Derivation: F. L. Litvin, A. Fuentes, Gear
Geometry and Applied Theory, 2nd ed., chapter 13 (cycloidal gearing), written with complex numbers.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.errors import CuspError
from geometry.base.placement import Placement2
from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_root
from geometry.base.series import FACTORIALS, Series, product, sharpened, unit
from geometry.curves.bounds import BoundedSpan
from geometry.curves.curve import Carried, Complex, Curve, Real, Span

# orders of the bounds beyond what is asked for: each one sharpens those below it; parts of an interval
_MORE, _PARTS = 4, 8
# radii of Cauchy's circles that are tried, as shares of the way to where the bound fails
_SHARES = (0.3, 0.5, 0.7, 0.85)
# the speed of the path grows by this factor at most from split to split in a valley
_GRADE = 4.0
_TURN = 2 * math.pi


class ShortTrochoid(BoundedSpan, Record):
    """The parallel, ``distance`` mm to the left (inwards), of A e^{is} - B e^{ims} turned by ``angle`` rad.

    A = ``radius``, B = ``arm`` in mm, m = ``order`` > 1, 0 < m B < A. Its parameter is s, rad.
    """

    radius: float
    arm: float
    order: float
    distance: float
    angle: float
    start: float
    end: float

    @property
    def shortening(self) -> float:
        """lambda = m B / A."""
        return self.order * self.arm / self.radius

    def square(self, t: ArrayLike) -> Real:
        """q = |1 - lambda e^{i (m-1) s}|^2: the squared speed of the path in that of its circle."""
        short = self.shortening
        sine = np.sin((self.order - 1) / 2 * np.asarray(t, dtype=float))
        return (1 - short) ** 2 + 4 * short * sine**2

    def path_curvature(self, t: ArrayLike) -> Real:
        """Curvature of the pin centre's path, 1/mm: positive on the lobes, negative in the valleys."""
        return path_curvature(self.radius, self.shortening, self.order, self.square(t))

    def _unit(self, t: Real, order: int) -> Series:
        """Taylor coefficients of e^{is} w/|w|, w = 1 - lambda e^{i (m-1) s}: the outward normal of the path."""
        short, rate = self.shortening, self.order - 1
        wave = np.exp(1j * rate * t)
        # e^{ix} - 1 without cancellation
        small = 2j * np.sin(rate * t / 2) * np.exp(0.5j * rate * t)
        first: Series = [(1 - short) - short * small]
        first += [-short * wave * ((1j * rate) ** k / FACTORIALS[k]) for k in range(1, order + 1)]
        turn = np.exp(1j * t)
        return product(unit(first), [turn * (1j**k / FACTORIALS[k]) for k in range(order + 1)])

    def series(self, t: ArrayLike, order: int) -> Series:
        """Taylor coefficients of the curve at ``t``."""
        at = np.asarray(t, dtype=float)
        normal = self._unit(at, order)
        turn, wave = self.radius * np.exp(1j * at), self.arm * np.exp(1j * self.order * at)
        own = np.exp(1j * self.angle)
        return [
            own * (turn * (1j**k / FACTORIALS[k]) - wave * ((1j * self.order) ** k / FACTORIALS[k]) - self.distance * n)
            for k, n in enumerate(normal)
        ]

    def series_bound(self, order: int, a: Real, b: Real) -> Series:
        """Bounds of the moduli of the Taylor coefficients on each interval: geometry/curves/bounds.py.

        By Cauchy's estimate of sqrt(w / w~), w~ = 1 - lambda e^{-i tau}, tau = (m-1) s: within
        r = ln(1 + x |w| / lambda) of a real tau both change by x |w| at most, so that its coefficients are below
        sqrt((1 + x) / (1 - x)) / r^k.
        """
        top, rate, short = order + _MORE, self.order - 1, self.shortening
        shares = np.linspace(0, 1, _PARTS + 1)
        edges = np.asarray(a)[..., None] * (1 - shares) + np.asarray(b)[..., None] * shares
        low, high = edges[..., :-1], edges[..., 1:]
        # |w| is least at an end, or where tau is a whole turn
        crosses = np.ceil(low * rate / _TURN) <= np.floor(high * rate / _TURN)
        least = np.where(crosses, 1 - short, np.sqrt(np.minimum(self.square(low), self.square(high))))
        unit: Series = [np.ones(np.shape(least))]
        for k in range(1, top + 1):
            radii = [np.log1p(x * least / short) / rate for x in _SHARES]
            found = [math.sqrt((1 + x) / (1 - x)) / r**k for x, r in zip(_SHARES, radii, strict=True)]
            unit.append(np.minimum.reduce(found))
        normal = product(unit, [1 / FACTORIALS[k] for k in range(top + 1)])
        normal[0] = unit[0]
        normal = sharpened(normal, self._unit((low + high) / 2, top), (high - low) / 2)
        return [
            (self.radius + self.arm * self.order**k) / FACTORIALS[k] + abs(self.distance) * normal[k].max(axis=-1)
            for k in range(order + 1)
        ]

    def tangent(self, t: ArrayLike) -> Complex:
        at = np.asarray(t, dtype=float)
        sense = np.where(1 - self.distance * self.path_curvature(at) < 0, -1.0, 1.0)
        return 1j * sense * np.exp(1j * self.angle) * self._unit(at, 0)[0]

    def curvature(self, t: ArrayLike) -> Real:
        path = self.path_curvature(t)
        with np.errstate(divide="ignore"):
            return path / np.abs(1 - self.distance * path)

    def splits(self) -> tuple[float, ...]:
        """Inflections and vertices inside the domain, ascending: between them the curvature keeps sign and trend."""
        return self._where_squares_are(
            (inflection_square(self.shortening, self.order), vertex_square(self.shortening, self.order))
        )

    def graded_splits(self) -> tuple[float, ...]:
        """``splits``, and near the limit of shortening more in the valleys, where the speed grows by powers of ten."""
        turn = inflection_square(self.shortening, self.order)
        found, square = [turn, vertex_square(self.shortening, self.order)], (_GRADE * (1 - self.shortening)) ** 2
        while square < turn / _GRADE:
            found.append(square)
            square *= _GRADE**2
        return self._where_squares_are(found)

    def _where_squares_are(self, squares: Sequence[float]) -> tuple[float, ...]:
        """Where q takes these values, and the middles of valleys and lobes, inside the domain."""
        rate, found = self.order - 1, []
        for square in squares:
            cosine = (1 + self.shortening**2 - square) / (2 * self.shortening)
            if abs(cosine) < 1:
                phase = math.acos(cosine) / rate
                whole = _TURN / rate
                first = math.floor(self.start / whole) - 1
                last = math.ceil(self.end / whole) + 1
                found += [k * whole + side * phase for k in range(first, last + 1) for side in (-1, 1)]
        half = math.pi / rate
        found += [k * half for k in range(math.floor(self.start / half), math.ceil(self.end / half) + 1)]
        return tuple(sorted(s for s in found if self.start < s < self.end))

    def offset(self, distance: float) -> ShortTrochoid:
        moved = replace(self, distance=self.distance + distance)
        places = np.array([self.start, *self.splits(), self.end])
        curvature = self.path_curvature(places)
        before, after = 1 - self.distance * curvature, 1 - moved.distance * curvature
        # the curvature is monotone between these places: so is the stretch
        turned = np.flatnonzero(after * np.sign(before) <= 0)
        if not turned.size:
            return moved
        first = int(turned[0])
        if first == 0:
            raise CuspError(self.start, distance)
        low, high = float(places[first - 1]), float(places[first])
        root = bracketed_root(lambda s: float(1 - moved.distance * self.path_curvature(s)), low, high)
        raise CuspError(root.value, distance)


def path_curvature(radius: float, shortening: float, order: float, square: ArrayLike) -> Real:
    """Curvature of the trochoid A e^{is} - B e^{ims}, 1/mm, where q = |1 - lambda e^{i (m-1) s}|^2 is ``square``.

    kappa = ((m + 1) q - (m - 1) (1 - lambda^2)) / (2 A q^{3/2}).
    """
    q = np.asarray(square, dtype=float)
    with np.errstate(divide="ignore"):
        return ((order + 1) * q - (order - 1) * (1 - shortening) * (1 + shortening)) / (2 * radius * q**1.5)


def inflection_square(shortening: float, order: float) -> float:
    """q at which the path's curvature vanishes."""
    return (order - 1) * (1 - shortening) * (1 + shortening) / (order + 1)


def vertex_square(shortening: float, order: float) -> float:
    """q at which the path's curvature is greatest."""
    return 3 * inflection_square(shortening, order)


def least_convex_radius(radius: float, shortening: float, order: float) -> float:
    """Least convex radius of curvature of the trochoid, mm: its parallel inwards has a cusp from there on.

    A sqrt(27 (m - 1) (1 - lambda^2) / (m + 1)^3) where the vertex q* = 3 (m - 1) (1 - lambda^2) / (m + 1) is reached,
    lambda > (m - 2) / (2 m - 1); else A (1 + lambda)^2 / (1 + m lambda), at the middle of a lobe.
    """
    if shortening > (order - 2) / (2 * order - 1):
        return radius * math.sqrt(27 * (order - 1) * (1 - shortening) * (1 + shortening) / (order + 1) ** 3)
    return radius * (1 + shortening) ** 2 / (1 + order * shortening)


def greatest_shortening(radius: float, order: float, pin_radius: float) -> float:
    """The shortening coefficient at which the least convex radius has come down to ``pin_radius`` < A; closed form."""
    share = pin_radius / radius
    both = (order - 2) / (2 * order - 1)
    if both > 0 and pin_radius > least_convex_radius(radius, both, order):
        # (1 + x)^2 = share (1 + m x), its smaller root; without cancellation
        half = (2 - order * share) / 2
        constant = 1 - share
        root = math.sqrt(max(half * half - constant, 0.0))
        return constant / (root - half) if half < 0 else root - half
    return math.sqrt(max(0.0, 1 - share**2 * (order + 1) ** 3 / (27 * (order - 1))))


class CycloidParallel(Span, Record):
    """The parallel, ``distance`` mm to the left, of the cycloid a e^{iu} - b e^{imu}, a = m b, turned by ``angle``.

    b = ``arm``, mm: the radius of the circle that rolls outside of another one, of radius (m - 1) b; of a hypocycloid,
    where it rolls inside, b and m are below 0. u = 0 is a cusp on that circle, from which an epicycloid runs outwards
    along ``angle``, and at which a hypocycloid ends. Being c = a e^{iu} - b e^{imu} + i d e^{i(m+1)u/2}, it has the
    signed speed 2 a sin((m-1)u/2) - d (m+1)/2 along e^{i(m+1)u/2}. Its parameter is u, rad, 0 <= (m-1) u <= 2 pi.
    """

    arm: float
    order: float
    distance: float
    angle: float
    start: float
    end: float

    @property
    def _turning(self) -> float:
        return (self.order + 1) / 2

    def point(self, t: ArrayLike) -> Complex:
        return self.derivative(t, 0)

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        u = np.asarray(t, dtype=float)
        a = self.arm * self.order
        found = (
            a * 1j**order * np.exp(1j * u)
            - self.arm * (1j * self.order) ** order * np.exp(1j * self.order * u)
            + 1j * self.distance * (1j * self._turning) ** order * np.exp(1j * self._turning * u)
        )
        return np.exp(1j * self.angle) * found

    def speed(self, t: ArrayLike) -> Real:
        """Signed speed, mm/rad: negative where the parallel runs back, before its cusp."""
        u = np.asarray(t, dtype=float)
        return 2 * self.arm * self.order * np.sin((self.order - 1) / 2 * u) - self.distance * self._turning

    def tangent(self, t: ArrayLike) -> Complex:
        u = np.asarray(t, dtype=float)
        return np.where(self.speed(u) < 0, -1.0, 1.0) * np.exp(1j * (self.angle + self._turning * u))

    def curvature(self, t: ArrayLike) -> Real:
        with np.errstate(divide="ignore"):
            return self._turning / np.abs(self.speed(t))

    def slopes(self, points: Complex, t: Real) -> tuple[Real, Real]:
        """For feet of perpendiculars: Re(conj(tangent) (p - c)) and its derivative; a cusp is no foot of all points."""
        gap = np.conj(self.tangent(t)) * (points - self.point(t))
        return gap.real, self._turning * gap.imag - np.abs(self.speed(t))

    def derivative_bound(self, order: int, a: float, b: float) -> float:
        if order == 1:
            # |v| is concave or convex between the zeros of its parts: the sine is greatest at an end or at its crest
            crest = math.pi / (self.order - 1)
            ends = [abs(float(self.speed(x))) for x in (a, b)]
            return max(*ends, abs(float(self.speed(min(max(crest, a), b))))) * (1 + 1e-15)
        path = self.arm * self.order * (1 + abs(self.order) ** (order - 1))
        return path + abs(self.distance) * abs(self._turning) ** order

    def cusp(self) -> float:
        """u at which the parallel to the left turns back; 0 where it does not.

        Raises
        ------
        CuspError
            It runs back all the way.
        """
        sine = self.distance * self._turning / (2 * self.arm * self.order)
        if sine >= 1:
            raise CuspError(self.start, self.distance)
        return 2 * math.asin(max(sine, 0.0)) / (self.order - 1)

    def offset(self, distance: float) -> CycloidParallel:
        moved = replace(self, distance=self.distance + distance)
        before, after = ([float(c.speed(x)) for x in self.domain] for c in (self, moved))
        for at, old, new in zip(self.domain, before, after, strict=True):
            if old * new <= 0 and old != 0:
                raise CuspError(at, distance)
        return moved

    def placed(self, placement: Placement2) -> Curve:
        if placement.translation == 0:
            return replace(self, angle=self.angle + placement.angle)
        return Carried(self, placement)
