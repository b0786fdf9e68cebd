"""Two bodies of steel pressed together at a point: the load for their approach (K. L. Johnson, Contact Mechanics, 4.2).

With the half axes a >= b of the ellipse, k = b / a, K and E the complete elliptic integrals of sqrt(1 - k²), and
A <= B half of the sums of both bodies' curvatures along a and b:

    B / A = (E / k² - K) / (K - E),  b³ = 3 F k E / (2 pi E* (A + B)),  delta = 3 F k K / (2 pi E* b).
"""

from __future__ import annotations

import math

from geometry.base.roots import bracketed_root

_LEAST = 1e-6


def stiffness(curvatures: tuple[float, float], modulus: float) -> float:
    """C of the load C delta^(3/2), N/mm^(3/2), delta the approach.

    ``curvatures``: sums of both bodies' along a and across it, 1/mm, the smaller one first, above 0; ``modulus`` E*,
    MPa, 1/E* = (1 - nu²)/E of both bodies added.
    """
    k, half = _ellipse(curvatures, modulus)
    return float((3 * k * elliptic(k)[0] / (2 * math.pi * modulus * half)) ** -1.5)


def pressure(load: float, curvatures: tuple[float, float], modulus: float) -> float:
    """The greatest pressure 3 F / (2 pi a b), MPa, under a load in N; the rest as for ``stiffness``."""
    k, half = _ellipse(curvatures, modulus)
    return 3 * k * load ** (1 / 3) / (2 * math.pi * half**2)


def _ellipse(curvatures: tuple[float, float], modulus: float) -> tuple[float, float]:
    """k = b / a, and b under a load of 1 N, mm."""
    flat, sharp = curvatures
    k = 1.0
    if sharp > flat * (1 + 1e-9):

        def off(k: float) -> float:
            first, second = elliptic(k)
            return (second / k**2 - first) * flat - sharp * (first - second)

        k = bracketed_root(off, _LEAST, 1 - 1e-9).value
    half = (3 * k * elliptic(k)[1] / (math.pi * modulus * (flat + sharp))) ** (1 / 3)
    return k, half


def elliptic(k: float) -> tuple[float, float]:
    """The complete elliptic integrals K and E of the modulus sqrt(1 - k²), by the arithmetic-geometric mean."""
    mean, other, weight, total = 1.0, k, 0.5, 0.5 * (1 - k * k)
    while mean - other > 1e-16 * mean and weight < 1e6:
        mean, other, half = (mean + other) / 2, math.sqrt(mean * other), (mean - other) / 2
        weight *= 2
        total += weight * half * half
    first = math.pi / (2 * mean)
    return first, first * (1 - total)
