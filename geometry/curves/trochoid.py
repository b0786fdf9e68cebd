"""What a rounded rack tip leaves: the root fillet in the gear's frame."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.record import Record
from geometry.base.series import FACTORIALS, Series, derived, exponential, power, product
from geometry.curves.curve import Complex, Real
from geometry.curves.fillet import Fillet


class RackFillet(Fillet):
    """Envelope of a rack's rounded tip of support function p(u) in the gear's frame.

    ``u`` is the angle of the contact normal on the rounding, rad: 0 at the rack's tip line, pi/2 - alpha at its
    straight flank; negative values give the mirror image. With n = D sec u + p - p' tan u and s = D tan u - p' sec u

        e(u) = centre + exp(i (angle - s/r)) (r - n exp(-i u)),    speed (s'/r) n + p + p''.

    D = ``depth`` is how far the rounding's centre lies inside the pitch line: at D = 0 the rack-position form is 0/0,
    this one is an arc, and beyond (D < 0) no sign flips.
    """

    __slots__ = ()
    pitch_radius: float
    depth: float

    def _parts(self, u: Any, secant: Series, tangent: Series, *, bound: bool) -> tuple[Series, Series, Series]:
        """Series of s, n and the rounding's radius of curvature p + p'', or bounds of them up to the angle u."""
        raise NotImplementedError

    def _rolled(self, u: Any, lib: ModuleType = np) -> tuple[Any, Any, Any, Any]:
        """s, n, s' and p + p'' in closed form."""
        raise NotImplementedError

    def normal_length(self, u: float) -> float:
        """n: distance of the contact point from the pitch point, mm."""
        return float(self._rolled(u, math)[1])

    def _point(self, u: Any, lib: ModuleType, exp: Callable[[Any], Any]) -> Any:
        shift, normal, _, _ = self._rolled(u, lib)
        return self.centre + exp(1j * (self.angle - shift / self.pitch_radius)) * (
            self.pitch_radius - normal * exp(-1j * u)
        )

    def speed(self, t: ArrayLike) -> Real:
        """de/du along the tangent, mm/rad; negative where the curve runs back."""
        return np.asarray(self._moving(np.asarray(t, dtype=float))[1])

    def tangent(self, t: ArrayLike) -> Complex:
        if isinstance(t, float):
            way, rate = self._moving(t, math, cmath.exp)
            return np.complex128(-way if rate < 0 else way)
        direction, speed = self._moving(np.asarray(t, dtype=float))
        return np.where(speed < 0, -direction, direction)

    def _moving(self, u: Any, lib: ModuleType = np, exp: Callable[[Any], Any] = np.exp) -> tuple[Any, Any]:
        """Direction of growing u where the speed is positive, and the speed."""
        shift, normal, rate, bend = self._rolled(u, lib)
        direction = 1j * exp(1j * (self.angle - shift / self.pitch_radius - u))
        return direction, rate / self.pitch_radius * normal + bend

    def turning(self, t: ArrayLike) -> Real:
        """1 + s'/r: how fast the tangent turns to the right, rad/rad."""
        return np.asarray(1 + self._rolled(np.asarray(t, dtype=float))[2] / self.pitch_radius)

    def slopes(self, points: Complex, t: Real) -> tuple[Real, Real]:
        """Re(conj(tangent) (p - e)) along growing u, and its derivative: normals pass through the pitch point.

        |p| sin(arg p - angle + u + s/r) - r sin u.
        """
        shift, _, rate, _ = self._rolled(t)
        turned = (points - self.centre) * np.exp(1j * (t + shift / self.pitch_radius - self.angle))
        change = turned.real * (1 + rate / self.pitch_radius) - self.pitch_radius * np.cos(t)
        return turned.imag - self.pitch_radius * np.sin(t), change

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        """Taylor arithmetic on e' = i exp(i (angle - s/r - u)) speed(u)."""
        u = np.asarray(t, dtype=float)
        if order == 1:
            direction, speed = self._moving(u)
            return np.asarray(direction * speed)
        shift, normal, bend = self._parts(u, *_secant_and_tangent(u, order), bound=False)
        phase = [-1j * x / self.pitch_radius for x in shift[:order]]
        phase[0], phase[1] = phase[0] - 1j * u, phase[1] - 1j
        value = product(exponential(phase), self._speed_series(shift, normal, bend)[:order])[order - 1]
        return np.asarray(1j * np.exp(1j * self.angle) * value * FACTORIALS[order - 1])

    def _speed_series(self, shift: Series, normal: Series, bend: Series) -> Series:
        rolling = product([x / self.pitch_radius for x in derived(shift)], normal)
        return [a + b for a, b in zip(rolling, bend, strict=False)]

    def derivative_bound(self, order: int, a: float, b: float) -> float:
        """Majorants of every series in ``derivative``; secant and tangent are greatest where u is farthest from 0."""
        far = max(abs(a), abs(b))
        shift, normal, bend = self._parts(far, *_secant_and_tangent(far, order, math), bound=True)
        phase = [0.0, *(x / self.pitch_radius for x in shift[1:order])]
        if order > 1:
            phase[1] += 1
        value = product(exponential(phase), self._speed_series(shift, normal, bend)[:order])[order - 1]
        return float(value * FACTORIALS[order - 1])


class TrochoidFillet(RackFillet, Record):
    """The fillet of a circular rounding, p = rho: n = D sec u + rho, s = D tan u.

    Speed rho (1 + q sec^2 u) + D^2/r sec^3 u, q = D/r, turning rate -(1 + q sec^2 u). A left offset d has rho + d: a
    fillet stays a fillet. Derivation: DERIVATIONS.md, section 2.
    """

    pitch_radius: float
    depth: float
    tip_radius: float
    angle: float
    start: float
    end: float
    centre: complex = 0j
    columns = "pitch_radius", "depth", "tip_radius", "angle", "centre"

    def _parts(self, u: Any, secant: Series, tangent: Series, *, bound: bool) -> tuple[Series, Series, Series]:
        depth, rho = (abs(self.depth), abs(self.tip_radius)) if bound else (self.depth, self.tip_radius)
        normal = [depth * x for x in secant]
        normal[0] = normal[0] + rho
        return [depth * x for x in tangent], normal, [rho, *[0.0] * (len(secant) - 1)]

    def _point(self, u: Any, lib: ModuleType, exp: Callable[[Any], Any]) -> Any:
        # n exp(-iu) without sec u, whose rounding a crossing that is all but tangent would magnify
        shift = self.depth * lib.tan(u)
        arm = self.pitch_radius - self.depth + 1j * shift - self.tip_radius * exp(-1j * u)
        return self.centre + exp(1j * (self.angle - shift / self.pitch_radius)) * arm

    def _rolled(self, u: Any, lib: ModuleType = np) -> tuple[Any, Any, Any, Any]:
        secant = 1 / lib.cos(u)
        return self.depth * lib.tan(u), self.depth * secant + self.tip_radius, self.depth * secant**2, self.tip_radius

    def cusp(self) -> float | None:
        """The first parameter in the domain, by size, at which the speed is not positive; else None."""
        low, high = sorted((abs(self.start), abs(self.end)))
        low = 0.0 if self.start < 0 < self.end else low
        # in S = sec u the speed is the cubic rho + rho q S^2 + D q S^3
        q = self.depth / self.pitch_radius
        roots = np.roots([self.depth * q, self.tip_radius * q, 0.0, self.tip_radius])
        real = sorted(r.real for r in roots if abs(r.imag) < 1e-9 * abs(r) and r.real >= 1)
        inside = [math.acos(1 / s) for s in real if low < math.acos(1 / s) < high]
        if float(self.speed(low)) <= 0:
            return low
        return inside[0] if inside else None


def _secant_and_tangent(u: Any, order: int, lib: ModuleType = np) -> tuple[Series, Series]:
    """Coefficients of sec u and tan u; at the angle farthest from 0 they bound those of all nearer ones."""
    waves = (lib.cos(u), -lib.sin(u), -lib.cos(u), lib.sin(u))
    cosine = [waves[k % 4] / FACTORIALS[k] for k in range(order + 1)]
    secant = power(cosine, -1.0)
    return secant, product([-waves[(k + 1) % 4] / FACTORIALS[k] for k in range(order + 1)], secant)
