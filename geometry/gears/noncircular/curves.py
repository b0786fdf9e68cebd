"""What a rack leaves whose pitch line rolls on a closed centrode: flanks, root fillets and lands, as exact curves.

With the rack's pitch line on the tangent at arc length s, a rack point (x along it, y outwards) lies at
c(s) + (x - s - i y) T(s). A contact's normal passes through c(s), which gives closed forms. For a circle they are the
involute, the trochoid's parallel and circles. Derivation: DERIVATIONS.md, noncircular gears.
"""

from __future__ import annotations

import cmath
import math
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.errors import CuspError
from geometry.base.record import Record, replace
from geometry.base.series import FACTORIALS, Series, composed, derived, product
from geometry.curves.bounds import BoundedSpan
from geometry.curves.curve import Complex, Real, first_turning
from geometry.gears.noncircular.pitch_line import PitchLine

_SAMPLES, _FAR = 33, 0.05


class RolledCurve(BoundedSpan):
    """What the curves have in common; each is a record with ``start`` and ``end``."""

    __slots__ = ()

    @property
    def family(self) -> tuple[object, ...]:
        """What curves of neighbouring teeth that are nearly alike have in common."""
        return (type(self), *(math.copysign(1.0, float(x)) for x in self._senses()))

    def _senses(self) -> tuple[float | Real, ...]:
        """Numbers whose signs tell them apart."""
        return (self.end - self.start,)

    def stretch(self, t: ArrayLike) -> Real:
        """Speed along the tangent: negative where the curve runs back."""
        return self.heading(np.asarray(t, dtype=float))[2]

    def point(self, t: ArrayLike) -> Complex:
        return self.heading(np.asarray(t, dtype=float))[0]

    def heading(self, t: Real) -> tuple[Complex, Complex, Real, Real, Real]:
        """Place, tangent direction, speed along it, its slope, and how fast the direction turns."""
        raise NotImplementedError

    def tangent(self, t: ArrayLike) -> Complex:
        _, direction, speed, _, _ = self.heading(np.asarray(t, dtype=float))
        return np.where(speed < 0, -1.0, 1.0) * direction

    def curvature(self, t: ArrayLike) -> Real:
        _, _, speed, _, turning = self.heading(np.asarray(t, dtype=float))
        with np.errstate(divide="ignore"):
            return turning / np.abs(speed)

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        if order > 2:
            return FACTORIALS[order] * self.series(t, order)[order]
        _, direction, speed, slope, turning = self.heading(np.asarray(t, dtype=float))
        return direction * speed if order == 1 else direction * (slope + 1j * turning * speed)

    def derivatives(self, t: ArrayLike, order: int) -> list[Complex]:
        if order > 2:
            return super().derivatives(t, order)
        point, direction, speed, slope, turning = self.heading(np.asarray(t, dtype=float))
        return [point, direction * speed, direction * (slope + 1j * turning * speed)][: order + 1]

    def slopes(self, points: Complex, t: Real) -> tuple[Real, Real]:
        """Re(conj(tangent) (p - c)) and its derivative: what a search for feet needs."""
        point, direction, speed, _, turning = self.heading(t)
        gap = np.conj(direction) * (points - point)
        return gap.real, turning * gap.imag - speed

    def moved(self, distance: float) -> Self:
        """The parallel curve to the left, wherever it turns back."""
        raise NotImplementedError

    def offset(self, distance: float) -> Self:
        after = self.moved(distance)
        speed = after.stretch(np.linspace(self.start, self.end, _SAMPLES))
        # far from a cusp all along: speeds are smooth over so short a curve
        if float(speed.min()) <= _FAR * float(speed.max()):
            cusp = first_turning(after.stretch, self.stretch, self.domain)
            if cusp is not None:
                raise CuspError(cusp, distance)
        return after


class RolledFlank(RolledCurve, Record):
    """What a straight rack flank cuts: c(s) + (x - s) cos(a) exp(i a) T(s), s the arc length.

    ``crossing``: x, where the flank crosses the pitch line, mm; ``angle``: a, rad, the pressure angle of a lower
    tooth side, its negative of an upper one. Both sides run counter-clockwise as s grows. Where the speed
    (x - s) kappa cos(a) - sin(a) vanishes the flank turns back: undercut begins.
    """

    line: PitchLine
    crossing: float | Real
    angle: float
    start: float
    end: float
    columns = ("crossing",)

    @property
    def alike(self) -> object:
        return RolledFlank, self.line, self.angle

    def _senses(self) -> tuple[float | Real, ...]:
        return (self.angle,)

    @property
    def _lean(self) -> complex:
        return math.cos(self.angle) * cmath.exp(1j * self.angle)

    @property
    def _sense(self) -> float:
        """The tangent is sense i exp(i a) T."""
        return -math.copysign(1.0, self.angle)

    def series(self, t: ArrayLike, order: int) -> Series:
        """Taylor coefficients at ``t``."""
        s = np.asarray(t, dtype=float)
        base = self.line.series(s, order + 1)
        arm = [self._lean * (self.crossing - s), -self._lean + 0j * s, *([0j * s] * (order - 1))][: order + 1]
        return [a + b for a, b in zip(base, product(arm, derived(base)), strict=False)]

    def heading(self, t: Real) -> tuple[Complex, Complex, Real, Real, Real]:
        """Place, tangent direction, speed along it, its slope, and how fast the direction turns."""
        base, tangent, kappa, slope = self.line.frame_and_slope(t)
        sense, cosine, arm = self._sense, math.cos(self.angle), self.crossing - t
        direction = sense * 1j * cmath.exp(1j * self.angle) * tangent
        speed = sense * (arm * kappa * cosine - math.sin(self.angle))
        return base + arm * self._lean * tangent, direction, speed, sense * cosine * (arm * slope - kappa), kappa

    def tangent(self, t: ArrayLike) -> Complex:
        return self._sense * 1j * cmath.exp(1j * self.angle) * self.line.frame(t)[1]

    def series_bound(self, order: int, a: Real, b: Real) -> Series:
        """Bounds of their moduli on each interval."""
        base = self.line.series_bound(order + 1, a, b)
        lean = abs(self._lean)
        reach = lean * np.maximum(np.abs(self.crossing - a), np.abs(self.crossing - b))
        arm = [reach, lean + 0.0 * reach, *([0.0 * reach] * (order - 1))][: order + 1]
        return [x + y for x, y in zip(base, product(arm, derived(base)), strict=False)]

    def moved(self, distance: float) -> Self:
        """The parallel curve to the left."""
        return replace(self, crossing=self.crossing - self._sense * distance / math.cos(self.angle))


class RolledFillet(RolledCurve, Record):
    """What a rack's rounded tip cuts: c(s) + i (D - i D tan u + rho exp(-i u)) T(s) at s = x - D tan u.

    ``u`` is the angle of the contact normal on the rounding, rad, 0 at the rack's tip line, positive on the rack's
    flank of the lower tooth side, negative on its mirror image; ``centre``: x of the rounding's centre, or a column of
    them for as many fillets, ``depth``: D, how far it lies inside the pitch line, ``tip_radius``: rho, mm. Speed
    rho (1 + kappa D sec^2 u) + kappa D^2 sec^3 u.
    """

    line: PitchLine
    centre: float | Real
    depth: float
    tip_radius: float | Real
    start: float
    end: float
    columns = "centre", "tip_radius"

    @property
    def alike(self) -> object:
        return RolledFillet, self.line, self.depth

    def _senses(self) -> tuple[float | Real, ...]:
        return self.end - self.start, self.end + self.start

    def _arc(self, u: Real) -> Real:
        return self.centre - self.depth * np.tan(u)

    def series(self, t: ArrayLike, order: int) -> Series:
        """Taylor coefficients at ``t``."""
        u = np.asarray(t, dtype=float)
        base = self.line.series(self._arc(u), order + 1)
        tan = _tangent_series(np.tan(u), order)
        step = [0.0 * u, *(-self.depth * x for x in tan[1:])]
        turn = [np.exp(-1j * u) * (-1j) ** k / FACTORIALS[k] for k in range(order + 1)]
        arm = [self.depth * x + 1j * self.tip_radius * y for x, y in zip(tan, turn, strict=True)]
        arm[0] = arm[0] + 1j * self.depth
        place = composed(base[: order + 1], step)
        return [a + b for a, b in zip(place, product(arm, composed(derived(base), step)), strict=False)]

    def heading(self, t: Real) -> tuple[Complex, Complex, Real, Real, Real]:
        """Place, tangent direction, speed along it, its slope, and how fast the direction turns."""
        tan, secant = np.tan(t), 1 / np.cos(t)
        base, tangent, kappa, slope = self.line.frame_and_slope(self.centre - self.depth * tan)
        rate = -self.depth * secant**2
        speed = self.tip_radius * (1 - kappa * rate) + kappa * self.depth**2 * secant**3
        # d kappa / du = slope rate, d rate / du = 2 tan rate
        change = -self.tip_radius * rate * (slope * rate + 2 * kappa * tan)
        change = change + self.depth**2 * secant**3 * (slope * rate + 3 * kappa * tan)
        turn = np.exp(-1j * t)
        place = base + (self.depth * (1j + tan) + 1j * self.tip_radius * turn) * tangent
        return place, tangent * turn, speed, change, kappa * rate - 1

    def series_bound(self, order: int, a: Real, b: Real) -> Series:
        """Bounds of their moduli on each interval."""
        places = self._arc(a), self._arc(b)
        base = self.line.series_bound(order + 1, np.minimum(*places), np.maximum(*places))
        tan = _tangent_series(np.tan(np.maximum(np.abs(a), np.abs(b))), order)
        depth, radius = abs(self.depth), np.abs(self.tip_radius)
        step = [0.0 * a, *(depth * x for x in tan[1:])]
        arm = [depth * x + radius / FACTORIALS[k] for k, x in enumerate(tan)]
        arm[0] = arm[0] + depth
        place = composed(base[: order + 1], step)
        return [x + y for x, y in zip(place, product(arm, composed(derived(base), step)), strict=False)]

    def moved(self, distance: float) -> Self:
        """The parallel curve to the left."""
        return replace(self, tip_radius=self.tip_radius + distance)


class RolledLand(RolledCurve, Record):
    """A parallel of the centrode ``height`` mm outside it: c(s) - i h T(s); the tip, and what the rack's tip leaves."""

    line: PitchLine
    height: float | Real
    start: float
    end: float
    columns = ("height",)

    @property
    def alike(self) -> object:
        return RolledLand, self.line

    def _senses(self) -> tuple[float | Real, ...]:
        return (self.height,)

    def series(self, t: ArrayLike, order: int) -> Series:
        """Taylor coefficients at ``t``."""
        base = self.line.series(t, order + 1)
        return [a - 1j * self.height * b for a, b in zip(base, derived(base), strict=False)]

    def heading(self, t: Real) -> tuple[Complex, Complex, Real, Real, Real]:
        """Place, tangent direction, speed along it, its slope, and how fast the direction turns."""
        base, tangent, kappa, slope = self.line.frame_and_slope(t)
        return base - 1j * self.height * tangent, tangent, 1 + self.height * kappa, self.height * slope, kappa

    def series_bound(self, order: int, a: Real, b: Real) -> Series:
        """Bounds of their moduli on each interval."""
        base = self.line.series_bound(order + 1, np.asarray(a), np.asarray(b))
        return [x + abs(self.height) * y for x, y in zip(base, derived(base), strict=False)]

    def moved(self, distance: float) -> Self:
        """The parallel curve to the left."""
        return replace(self, height=self.height - distance)


def _tangent_series(tan: Real, order: int) -> Series:
    """Taylor coefficients of tan u from its value, by y' = 1 + y^2."""
    y: Series = [tan]
    for k in range(order):
        square = sum(y[j] * y[k - j] for j in range(k + 1))
        y.append(((1.0 if k == 0 else 0.0) + square) / (k + 1))
    return y
