"""What a rounded rack tip leaves: the path of its rounding centre, and the root fillet."""

from __future__ import annotations

import math
from collections.abc import Callable
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from geometry.curves.fillet import Fillet

_BINOMIALS = ((1,), (1, 1), (1, 2, 1), (1, 3, 3, 1), (1, 4, 6, 4, 1))


class TrochoidFillet(Fillet, Record):
    """Envelope of a rack's rounded tip in the gear's frame: the root fillet.

    e(u) = centre + exp(i (angle - q tan u)) (r - D + i D tan u - rho exp(-i u)), q = D/r.
    ``u`` is the angle of the contact normal on the rounding, rad: 0 at the rack's tip line, pi/2 - alpha
    at its straight flank; negative values give the mirror image. D = ``depth`` is how far the rounding
    centre lies inside the pitch line: at D = 0 the rack-position form is 0/0, this one is an arc, and
    beyond (D < 0) no sign flips. Speed rho (1 + q sec^2 u) + D^2/r sec^3 u, turning rate -(1 + q sec^2 u).
    A left offset d has rho + d: a fillet stays a fillet. Derivation: DERIVATIONS.md, section 2.
    """

    pitch_radius: float
    depth: float
    tip_radius: float
    angle: float
    start: float
    end: float
    centre: complex = 0j

    def _point(self, u: Any, lib: ModuleType, exp: Callable[[Any], Any]) -> Any:
        shift = self.depth * lib.tan(u)
        arm = self.pitch_radius - self.depth + 1j * shift - self.tip_radius * exp(-1j * u)
        return self.centre + exp(1j * (self.angle - shift / self.pitch_radius)) * arm

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        """Leibniz' rule on e' = i exp(i (angle - q tan u - u)) speed(u)."""
        u = np.asarray(t, dtype=float)
        q = self.depth / self.pitch_radius
        tan = _tangent_derivatives(np.tan(u), order)
        phase = [-1j * (q * d + (u if k == 0 else float(k == 1))) for k, d in enumerate(tan)]
        turn = _exponential_derivatives(phase, order - 1)
        speed = _speed_derivatives(self.tip_radius, self.tip_radius * q, self.depth * q, tan)
        total = sum(b * turn[k] * speed[order - 1 - k] for k, b in enumerate(_BINOMIALS[order - 1]))
        return 1j * np.exp(1j * self.angle) * total

    def speed(self, t: ArrayLike) -> Real:
        """de/du along the tangent, mm/rad; negative where the curve runs back."""
        secant = 1 / np.cos(np.asarray(t, dtype=float))
        q = self.depth / self.pitch_radius
        return self.tip_radius * (1 + q * secant**2) + self.depth * q * secant**3

    def tangent(self, t: ArrayLike) -> Complex:
        u = np.asarray(t, dtype=float)
        turn = self.angle - self.depth / self.pitch_radius * np.tan(u)
        return np.where(self.speed(u) < 0, -1.0, 1.0) * 1j * np.exp(1j * (turn - u))

    def turning(self, t: ArrayLike) -> Real:
        """1 + q sec^2 u: how fast the tangent turns to the right, rad/rad."""
        secant = 1 / np.cos(np.asarray(t, dtype=float))
        return 1 + self.depth / self.pitch_radius * secant**2

    def derivative_bound(self, order: int, a: float, b: float) -> float:
        """Sum of the moduli of all terms of the derivative, at the end where tan is largest."""
        tan = _tangent_derivatives(np.tan(max(abs(a), abs(b))), order)
        q = abs(self.depth) / self.pitch_radius
        phase = [0.0, *(q * d + float(k == 1) for k, d in enumerate(tan) if k)]
        turn = _exponential_derivatives(phase, order - 1)
        rho, depth = abs(self.tip_radius), abs(self.depth)
        speed = _speed_derivatives(rho, rho * q, depth * q, tan)
        return float(sum(n * turn[k] * speed[order - 1 - k] for k, n in enumerate(_BINOMIALS[order - 1])))

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


def _tangent_derivatives(tan: Real, order: int) -> list[Real]:
    """tan u and its derivatives up to ``order`` (at most 4), from the value of tan u."""
    square = 1 + tan * tan
    if order == 1:
        return [tan, square]
    table = [tan, square, 2 * tan * square, square * (2 + 6 * tan**2), square * (16 * tan + 24 * tan**3)]
    return table[: order + 1]


def _speed_derivatives(constant: float, square: float, cube: float, tan: list[Real]) -> list[Real]:
    """constant + square sec^2 u + cube sec^3 u and its derivatives, from tan u and its derivatives."""
    t, secant_cubed = tan[0], tan[1] ** 1.5
    if len(tan) == 2:
        return [constant + (square * tan[1] + cube * secant_cubed)]
    cubes = [np.ones_like(t), 3 * t, 12 * t**2 + 3, 60 * t**3 + 33 * t]
    result = [square * d + cube * secant_cubed * c for d, c in zip(tan[1:], cubes, strict=False)]
    return [constant + result[0], *result[1:]]


def _exponential_derivatives(exponent: list, order: int) -> list:
    """exp(g) and its derivatives up to ``order`` from g and its derivatives (Bell recursion)."""
    result = [np.exp(exponent[0])]
    for n in range(1, order + 1):
        result.append(sum(b * result[k] * exponent[n - k] for k, b in enumerate(_BINOMIALS[n - 1])))
    return result
