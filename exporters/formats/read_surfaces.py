"""Surfaces of a STEP file against the edges of their faces: how far these lie off, and what flux a face has.

The flux of X/3 through a face is its share of the volume. On a plane, a surface of revolution or an extrusion it is that
of a 1-form round the bounds, whose differential it is: with a surface's own parameters u and v, v along the axis,
X . (X_u x X_v) / 3 du dv = d(-H du), H its integral over v. Spline surfaces are integrated over between their ends.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from exporters.formats.read_curves import Knots, lobatto
from exporters.formats.read_part21 import Index, Real
from geometry.base.record import Record

# an area of parameters that is none, rad^2
_FLAT = 1e-9
PLANE, ROUND, SPHERE, TORUS, EXTRUSION, SPLINE = range(6)


class Forms(Record):
    """At nodes (n, k) of edges: distance from the surface, mm, and the 1-forms of flux, area of (u, v), and u."""

    gap: Real
    flux: Real
    area: Real
    turn: Real


def forms(kind: int, at: Real, step: Real, centre: Real, sizes: Real, about: Real) -> Forms:
    """Of points and steps (n, k, 3) in the frames of their surfaces; ``centre`` (n, 3): a frame's own origin in it.

    ``sizes`` (n, 2): radius, and tangent of the half angle of a cone, or a torus's second radius; ``about`` (n,): an
    angle round the tube of a torus that its face has, rad.
    """
    x, y, z = np.moveaxis(at, 2, 0)
    c1, c2, c3 = (centre[:, k, None] for k in range(3))
    r, s = sizes[:, 0, None], sizes[:, 1, None]
    turn = x * step[..., 1] - y * step[..., 0]
    if kind == PLANE:
        return Forms(np.abs(z), c3 / 6 * turn, turn / 2, turn)
    if kind == EXTRUSION:
        return Forms(np.zeros_like(x), -z / 3 * turn, np.zeros_like(x), turn)
    size = np.hypot(x, y)
    with np.errstate(divide="ignore", invalid="ignore"):
        turn = np.where(size > 0, turn / size**2, 0.0)
        across = np.where(size > 0, (x * c1 + y * c2) / size, 0.0)
    if kind == ROUND:
        # the normal is (n - s a) of size root(1 + s^2)
        gap = np.abs(size - (r + z * s)) / np.sqrt(1 + s * s)
        return Forms(gap, -(across - s * c3 + r) / 3 * (r * z + s * z * z / 2) * turn, -z * turn, turn)
    if kind == SPHERE:
        v = np.arctan2(z, size)
        inside = across * (v / 2 + np.sin(2 * v) / 4) + c3 * np.sin(v) ** 2 / 2 + r * np.sin(v)
        return Forms(np.abs(np.hypot(size, z) - r), -r * r / 3 * inside * turn, -np.sin(v) * turn, turn)
    v = about[:, None] + np.angle((size - r + 1j * z) * np.exp(-1j * about)[:, None])
    a = across + r
    inside = (
        r * (a * np.sin(v) + c3 * (1 - np.cos(v)) + s * v)
        + s * (a * (v / 2 + np.sin(2 * v) / 4) + c3 * np.sin(v) ** 2 / 2 + s * np.sin(v))
    )  # fmt: skip
    return Forms(np.abs(np.hypot(size - r, z) - s), -s / 3 * inside * turn, -v * turn, turn)


def whole(kind: int, sizes: Real, along: Real, turns: Real, area: Real, sense: Real) -> Real:
    """What faces round a pole of a sphere, and whole spheres and tori, have beside the flux of their bounds, (n,).

    ``along``: the centre's place on the axis; ``turns``: of the bounds round the axis; ``area``: by the 1-form.
    """
    r, s = sizes.T
    if kind == TORUS:
        return np.where(sense * area < _FLAT, sense * 2 * np.pi**2 * r * s * s, 0.0)
    poles = np.sign((turns / (2 * np.pi)).round()) * sense
    one = sense * 2 * np.pi * r * r / 3 * (r + poles * along / 2)
    return np.where(poles != 0, one, np.where(sense * area < _FLAT, sense * 4 * np.pi / 3 * r**3, 0.0))
