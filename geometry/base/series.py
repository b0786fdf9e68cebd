"""Truncated Taylor series: lists of coefficients c^(k)/k!, each a number or an array over many points at once.

The same recursions on moduli give majorants: bounds of every coefficient over a whole interval.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import reduce
from operator import add, mul
from typing import Any

import numpy as np

FACTORIALS = tuple(float(math.factorial(k)) for k in range(25))
# numbers or numpy arrays, real or complex; the recursions do not care
Series = list[Any]
# middles of the intervals that bounds are asked for: the series there, and half their widths
About = tuple[Series, Any]


def taylor(derivatives: Sequence[Any]) -> Series:
    """Coefficients of a function from its value and derivatives; bounds of the ones from bounds of the others."""
    return [x if k < 2 else x / FACTORIALS[k] for k, x in enumerate(derivatives)]


def product(a: Sequence[Any], b: Sequence[Any]) -> Series:
    """Coefficients of a product, as many as the shorter factor has."""
    return [_dot(a[: k + 1], b[k::-1]) for k in range(min(len(a), len(b)))]


def _dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
    """a[0] b[0] + a[1] b[1] ...: ``sum`` begins with a nought, which of long arrays is as much work as a term."""
    return reduce(add, map(mul, a, b))


def conjugate(a: Sequence[Any]) -> Series:
    """Coefficients of the complex conjugate along a real parameter."""
    return [np.conj(x) for x in a]


def affine(start: Any, way: Any, a: Sequence[Any]) -> Series:
    """Coefficients of start + way a."""
    return [start + way * a[0], *(way * x for x in a[1:])]


def derived(a: Sequence[Any]) -> Series:
    """Coefficients of the derivative, one fewer."""
    return [(k + 1) * a[k + 1] for k in range(len(a) - 1)]


def quotient(a: Sequence[Any], b: Sequence[Any]) -> Series:
    """Coefficients of a / b; b[0] must not vanish."""
    result: Series = []
    for k in range(min(len(a), len(b))):
        result.append((a[k] - sum(map(mul, b[1 : k + 1], result[::-1]))) / b[0])
    return result


def power(a: Sequence[Any], exponent: float) -> Series:
    """Coefficients of a^exponent, from a y' = exponent a' y; a[0] > 0 (any nonzero value for whole exponents)."""
    y: Series = [a[0] ** exponent]
    for k in range(1, len(a)):
        total = sum((exponent * j - (k - j)) * a[j] * y[k - j] for j in range(1, k + 1))
        y.append(total / (k * a[0]))
    return y


def exponential(a: Sequence[Any]) -> Series:
    """Coefficients of exp(a), from y' = a' y."""
    y, slopes = [np.exp(a[0])], derived(a)
    for k in range(1, len(a)):
        y.append(_dot(slopes[:k], y[::-1]) / k)
    return y


def modulus_square(a: Sequence[Any]) -> Series:
    """Coefficients of |a|^2 along a real parameter."""
    return [np.real(x) for x in product(a, conjugate(a))]


def unit(a: Sequence[Any]) -> Series:
    """Coefficients of the direction a / |a|."""
    return product(a, power(modulus_square(a), -0.5))


def argument(a: Sequence[Any]) -> Series:
    """Coefficients of the angle of a, from that of a[0] on, rad."""
    rates = quotient(derived(a), a)
    return [np.angle(a[0]), *(x.imag / (k + 1) for k, x in enumerate(rates))]


def composed(outer: Sequence[Any], inner: Sequence[Any]) -> Series:
    """Coefficients of outer(inner), ``outer`` being expanded about inner[0]: Horner's scheme on series."""
    step: Series = [0.0 * inner[0], *inner[1:]]
    result: Series = [outer[-1] + 0.0 * step[0], *([0.0 * step[0]] * (len(inner) - 1))]
    for coefficient in reversed(outer[:-1]):
        result = product(result, step)
        result[0] = result[0] + coefficient
    return result


def unit_majorant(first: Sequence[Any], least: Any) -> Series:
    """Bounds of the coefficients of w / |w| where those of w are bounded by ``first`` and |w| >= ``least`` > 0."""
    return product(first, inverse_modulus_majorant(first, least))


def inverse_modulus_majorant(first: Sequence[Any], least: Any) -> Series:
    """Bounds of the coefficients of 1 / |w| where those of w are bounded by ``first`` and |w| >= ``least`` > 0.

    1 / |w| = (w conj(w))^(-1/2); in the recursion of ``power`` every term is taken by its modulus.
    """
    square = product(first, first)
    y: Series = [1 / least]
    for k in range(1, len(square)):
        total = sum((0.5 * j + (k - j)) * square[j] * y[k - j] for j in range(1, k + 1))
        y.append(total / (k * least**2))
    return y


def sharpened(bounds: Sequence[Any], middle: Sequence[Any], half: Any) -> Series:
    """Bounds of coefficients over an interval by their values at its middle: |c_k| <= |m_k| + half (k + 1) b_(k+1)."""
    result: Series = list(bounds)
    for k in range(len(bounds) - 2, -1, -1):
        result[k] = np.minimum(bounds[k], np.abs(middle[k]) + half * (k + 1) * result[k + 1])
    return result


def majorant_power(least: float, rest: Sequence[Any], exponent: float) -> Series:
    """Bounds of the coefficients of a^exponent, exponent < 0, where |a| >= ``least`` and |a_k| <= ``rest``[k - 1].

    (a0 + p)^e has the terms binom(e, j) a0^(e - j) p^j, whose binomials alternate in sign: (least - P)^e bounds them.
    """
    return power([least, *(-r for r in rest)], exponent)
