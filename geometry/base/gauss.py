"""Gauss's rule: nodes and weights of integrals."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Real = NDArray[np.float64]


@lru_cache(maxsize=4)
def gauss_rule(count: int) -> tuple[Real, Real]:
    """Nodes and weights on [-1, 1] from the eigenvalues of the Jacobi matrix (Golub and Welsch, 1969)."""
    k = np.arange(1, count)
    off = k / np.sqrt(4.0 * k**2 - 1)
    nodes, vectors = np.linalg.eigh(np.diag(off, 1) + np.diag(off, -1))
    return nodes, 2 * vectors[0] ** 2


def panels(breaks: Real, count: int) -> tuple[Real, Real]:
    """Nodes and weights of Gauss's rule, ``count`` in each interval between breaks (n,): arrays (count (n - 1),)."""
    nodes, weights = gauss_rule(count)
    half = np.diff(breaks)[:, None] / 2
    return ((breaks[:-1] + breaks[1:])[:, None] / 2 + half * nodes).ravel(), (half * weights).ravel()
