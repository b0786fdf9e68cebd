"""Proven bounds of the derivatives of a cylindrical cam's edges, by Taylor arithmetic on the bounds of its law.

With rho between sqrt(R^2 - y^2) and R, w = rho + k r - p' stays away from 0, and so does the slope of
rho^2 + y(rho)^2 = R^2 by which its coefficients follow one from another: each by its modulus is a bound. The point
rho + iy of the edge has the modulus R, so that its angle's derivatives follow too.
"""

from __future__ import annotations

import math

import numpy as np

from geometry.base.series import (
    Series,
    affine,
    derived,
    exponential,
    inverse_modulus_majorant,
    majorant_power,
    product,
    sharpened,
    taylor,
    unit_majorant,
)
from geometry.cams.barrel.cam import AxialGuide, BarrelCam
from geometry.curves.curve import Real
from geometry.laws.piece import LawPiece

# how often the bounds of the contact's place and of w sharpen each other
_ROUNDS = 4


def edge_bounds(cam: BarrelCam, piece: LawPiece, radius: float, order: int, a: Real, b: Real) -> tuple[Series, Series]:
    """Bounds of the Taylor coefficients of polar angle (rad, from order 1 on) and height (mm) of an edge on [a, b].

    As BarrelCam.edge_series, of either side; inf where none is proven.
    """
    place, aside, steady = _place_bounds(cam, piece, max(order + 1, 2), a, b)
    rate = derived(place)
    rise, taper = 1 + cam.taper**2, cam.taper
    most = float(np.max(np.abs(cam.radius_at([0.0, radius]))))
    reach = aside[0] + most
    with np.errstate(all="ignore"):
        for _ in range(_ROUNDS):
            shortest = np.sqrt(radius**2 - reach**2)
            level = rise * shortest + taper * (cam.radius - taper * cam.reference) - aside[1]
            # w is as high as p' is steep: without it steep grooves have bounds of no use
            least = np.where(level > 0, np.hypot(level, steady), level)
            lean = taper * aside[0] / least
            # the normal leans across the axis by no more than w does along it
            across = np.where(level > 0, rate[0] / least + lean, 1.0)
            reach = np.minimum(reach, aside[0] + most * across)
        # of the equation in rho: 2 rho + 2 y dy/d rho
        turn = rise * rate[0] / least**2 + lean * rise / least / np.sqrt(1 - lean**2)
        slope = 2 * (shortest - reach * (taper + most * turn))
        rho: Series = [radius + 0.0 * reach, *(0.0 * reach for _ in range(order))]
        for k in range(1, order + 1):
            arm = _arm_bounds(cam, rho, rate, aside, least, most)
            y: Series = [reach, *(p + x for p, x in zip(aside[1 : order + 1], arm[1:], strict=True))]
            rest = product(rho, rho)[k] + product(y, y)[k]
            rho[k] = rest / slope
        arm = _arm_bounds(cam, rho, rate, aside, least, most)
        plane = [x + p + z for x, p, z in zip(rho, aside, arm, strict=False)]
        turning = product(derived(plane), majorant_power(radius, plane[1:], -1.0))
        proven = (slope > 0) & (least > 0) & (lean < 1)
    polar = [np.full(np.shape(reach), math.inf), *(t / (k + 1) for k, t in enumerate(turning))]
    if order:
        polar[1] = polar[1] + 1.0
    height = [p + x for p, x in zip(place, arm, strict=False)]
    return ([np.where(proven & np.isfinite(x), x, math.inf) for x in polar],
            [np.where(proven & np.isfinite(x), x, math.inf) for x in height])  # fmt: skip


def _arm_bounds(cam: BarrelCam, rho: Series, rate: Series, aside: Series, least: Real, most: float) -> Series:
    """Bounds of the coefficients of r n, from the roller's axis to the contact."""
    taper, order = cam.taper, len(rho) - 1
    size: Series = [most + 0.0 * least, *(taper * x for x in rho[1:])]
    w = [a + taper * s + b for a, s, b in zip(rho, size, rate, strict=False)]
    normal = unit_majorant(w, least)
    if taper:
        lean = [taper * x for x in product(aside[: order + 1], inverse_modulus_majorant(w, least))]
        square = product(lean, lean)
        level = majorant_power(1 - square[0], square[1:], -0.5)
        normal = product(normal, [x + y for x, y in zip(level, lean, strict=True)])
    normal[0] = 1.0 + 0.0 * least
    return product(size, normal)


def _place_bounds(cam: BarrelCam, piece: LawPiece, order: int, a: Real, b: Real) -> tuple[Series, Series, Real]:
    """Bounds of the coefficients of the roller's place p, of its part across the cam's axis, and the least |Im p'|."""
    s = taylor(piece.bounds(order, a, b))
    at, half = cam.place((a + b) / 2, order, piece), (b - a) / 2
    guide = cam.guide
    if isinstance(guide, AxialGuide):
        place = [s[0] + abs(guide.start_height), *s[1:]]
        place = sharpened(place, at, half)
        return place, [0.0 * x for x in place], _least_rise(at, place, half)
    # of exp(i psi): psi itself counts for nothing
    turn = exponential([0.0 * s[0], *s[1:]])
    place = affine(abs(guide.pivot_offset) + abs(guide.pivot_height), guide.arm_length, turn)
    aside = sharpened(place, [x.real for x in at], half)
    place = sharpened(place, at, half)
    return place, aside, _least_rise(at, place, half)


def _least_rise(middle: Series, place: Series, half: Real) -> Real:
    """Bound from below of the speed along the cam's axis: its middle value, and how far it may change from there."""
    return np.asarray(np.maximum(0.0, np.abs(middle[1].imag) * (1 - 1e-12) - half * 2 * place[2]))
