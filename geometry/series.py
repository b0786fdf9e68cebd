"""Taylor arithmetic: products, reciprocals, powers and exponentials of truncated power series.

A series is the list of its coefficients f^(k)/k!, each a number or an array. With positive coefficients that are bounds
of another series', and signs chosen by ``majorant_power``, the same arithmetic gives bounds (Cauchy's majorants).
"""

from __future__ import annotations

from typing import Any

import numpy as np

FACTORIALS = (1, 1, 2, 6, 24, 120)
Series = list[Any]


def product(a: Series, b: Series) -> Series:
    """Coefficients of a product."""
    return [sum(a[j] * b[k - j] for j in range(k + 1)) for k in range(len(a))]


def power(a: Series, exponent: float) -> Series:
    """Coefficients of a^exponent, from a y' = exponent a' y; a[0] must not be 0."""
    y = [a[0] ** exponent]
    for k in range(1, len(a)):
        total = sum((exponent * j - (k - j)) * a[j] * y[k - j] for j in range(1, k + 1))
        y.append(total / (k * a[0]))
    return y


def exponential(a: Series) -> Series:
    """Coefficients of exp(a), from y' = a' y."""
    y = [np.exp(a[0])]
    for k in range(1, len(a)):
        y.append(sum(j * a[j] * y[k - j] for j in range(1, k + 1)) / k)
    return y


def majorant_power(least: float, rest: Series, exponent: float) -> Series:
    """Bounds of the coefficients of a^exponent, exponent < 0, where |a| >= ``least`` and |a_k| <= ``rest``[k - 1].

    (a0 + p)^e has the terms binom(e, j) a0^(e - j) p^j, whose binomials alternate in sign: (least - P)^e bounds them.
    """
    return power([least, *(-r for r in rest)], exponent)
