"""The curves in which surfaces meet across each other, as splines that lie on both as well as rounding lets them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from geometry.approximation.tensor import clamped, greville
from geometry.curves.bspline import basis_matrix
from geometry.curves.curve import Real

RIM_DEGREE = 7
# part of the radius that is near enough
NEAR = 1e-10
_PIECES, _CHECKS, _MARGIN = (8, 16, 32, 64, 128), 1001, 1.2


def fitted(curve: Callable[[Real], Real], off: Callable[[Real], Real], near: float) -> tuple[Real, Real, float]:
    """A spline along a curve by shares of it, (n,) to (n, k): knots, poles and error, mm.

    ``off``: how far points are off the surfaces that meet in it, mm.
    """
    for pieces in _PIECES:
        knots = clamped(RIM_DEGREE, np.linspace(0, 1, pieces + 1))
        shares = greville(RIM_DEGREE, knots)
        poles = np.linalg.solve(basis_matrix(RIM_DEGREE, knots, shares), curve(shares))
        points = basis_matrix(RIM_DEGREE, knots, np.linspace(0, 1, _CHECKS)) @ poles
        error = _MARGIN * float(off(points).max())
        if error <= near:
            break
    return knots, np.asarray(poles, dtype=float), error


def rim_across(half: float, radius: float) -> tuple[Real, Real, float]:
    """The curve in which half a cylinder meets a larger one that it stands across: knots, poles and error, mm.

    Poles (n, 3): along the larger one's circle, along its axis, and away from that.
    """

    def curve(shares: Real) -> Real:
        along, up = half * np.cos(np.pi * shares), half * np.sin(np.pi * shares)
        return np.column_stack([along, up, np.sqrt(radius**2 - along**2)])

    def off(points: Real) -> Real:
        x, z, y = points.T
        return np.asarray(np.maximum(np.abs(np.hypot(x, z) - half), np.abs(np.hypot(x, y) - radius)))

    return fitted(curve, off, NEAR * radius)
