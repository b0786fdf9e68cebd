"""Tensor products of B-splines through points of a surface at Greville's places."""

from __future__ import annotations

from typing import TypeVar, cast

import numpy as np

from geometry.curves.bspline import basis_matrix
from geometry.curves.curve import Complex, Real

P = TypeVar("P", Real, Complex)


def clamped(degree: int, breaks: Real, multiplicity: int = 1) -> Real:
    """Knots with inner breaks of a multiplicity between clamped ends."""
    inner = np.repeat(breaks[1:-1], multiplicity)
    return np.concatenate([np.full(degree + 1, breaks[0]), inner, np.full(degree + 1, breaks[-1])])


def greville(degree: int, knots: Real) -> Real:
    """One place for each pole: the mean of its inner knots."""
    found = np.array([knots[i + 1 : i + degree + 1].mean() for i in range(len(knots) - degree - 1)])
    found[0], found[-1] = knots[0], knots[-1]
    return found


def seen_places(degree: int, knots: Real, pieces: int) -> Real:
    """Greville's places, the gaps between them cut into so many pieces.

    A spline through them is farthest off within a gap, and gaps at both ends are a small part of a span.
    """
    places = greville(degree, knots)
    gaps = len(places) - 1
    return np.interp(np.linspace(0, gaps, gaps * pieces + 1), np.arange(gaps + 1), places)


def tensor_poles(degree: int, u_knots: Real, v_knots: Real, points: P) -> P:
    """Poles (u, v, ...) through points (u, v, ...) at Greville's places of both knots."""
    along, across = (basis_matrix(degree, knots, greville(degree, knots)) for knots in (u_knots, v_knots))
    half = np.linalg.solve(along, points.reshape(len(along), -1)).reshape(points.shape)
    turned = np.swapaxes(half, 0, 1)
    poles = np.linalg.solve(across, turned.reshape(len(across), -1)).reshape(turned.shape)
    return cast("P", np.swapaxes(poles, 0, 1))


def axis_poles(degree: int, knots: Real, points: Real, axis: int) -> Real:
    """Poles of splines through points at Greville's places along one axis of theirs."""
    moved = np.moveaxis(points, axis, 0)
    found = np.linalg.solve(basis_matrix(degree, knots, greville(degree, knots)), moved.reshape(len(moved), -1))
    return np.asarray(np.moveaxis(np.asarray(found.reshape(moved.shape), float), 0, axis))
