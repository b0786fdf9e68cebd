"""How far points lie from a face gear's exact flanks and fillets: for files and for mates."""

from __future__ import annotations

import math

import numpy as np

from geometry.curves.curve import Complex, Real
from geometry.gears.face.gear import FaceGear, Places

# steps of the search for a foot, how far beyond the ends of a side it goes, part of it, and the step of slopes
_STEPS, _BEYOND, _SHIFT = 12, 0.02, 1e-5
# how near along a side a foot is found, modules
_FOUND = 1e-8
# places of a file whose feet are sought together: few wait for the slowest then
_AT_ONCE = 1 << 12
# shares at which a foot is first looked for
_TABLE = np.linspace(0.0, 1.0, 33)


def side_off(gear: FaceGear, which: int, radius: Real, aside: Real, depth: Real) -> tuple[Real, Real]:
    """How far places are outside of a side, and how far beyond its ends along it, mm, to first order in it.

    ``radius`` within the face, ``aside`` (rad) of the middle of their tooth, ``depth`` below the shaper's axis, (n,).
    Feet are sought on the cylinder of each place, unrolled.
    """
    place = radius * aside + 1j * depth
    middle = _unrolled(gear.side(which, _TABLE, (gear.inner_radius + gear.outer_radius) / 2))
    share = _TABLE[np.abs(place[:, None] - middle).argmin(axis=1)]
    rows = np.arange(len(share))
    for _ in range(_STEPS):
        before, own = share[rows], radius[rows]
        at = gear.side(which, before, own)
        along = 1j * at.around / np.abs(at.around)
        left = (np.conj(along) * (place[rows] - _unrolled(at))).real
        slope = (np.conj(along) * (_unrolled(gear.side(which, before + _SHIFT, own)) - _unrolled(at))).real / _SHIFT
        share[rows] = np.clip(before + left / slope, -_BEYOND, 1 + _BEYOND)
        rows = rows[~(np.abs((share[rows] - before) * slope) < _FOUND * gear.module)]
        if not rows.size:
            break
    at = gear.side(which, share, radius)
    off = np.conj(at.around) * (place - _unrolled(at))
    return np.asarray(off.real), np.asarray(off.imag / np.abs(at.around))


def _unrolled(at: Places) -> Complex:
    """Along the azimuth, and downwards, mm."""
    return np.asarray(at.radius * at.azimuth + 1j * at.depth)


def wall_distance(gear: FaceGear, which: int, points: Real) -> Real:
    """How far points (n, 3) of the part lie from the fillets (0) or flanks (1) of all teeth, mm."""
    reach, pitch = np.hypot(points[:, 0], points[:, 1]), math.tau / gear.number_of_teeth
    radius = np.clip(reach, gear.inner_radius, gear.outer_radius)
    turn = np.arctan2(points[:, 1], points[:, 0])
    aside = np.abs(turn - pitch * np.round(turn / pitch))
    depth, off, left = gear.shaper_height - points[:, 2], np.empty(len(points)), np.empty(len(points))
    for k in range(0, len(points), _AT_ONCE):
        own = slice(k, k + _AT_ONCE)
        off[own], left[own] = side_off(gear, which, radius[own], aside[own], depth[own])
    return np.sqrt(off**2 + left**2 + (reach - radius) ** 2)
