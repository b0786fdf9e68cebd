"""How far places on the unit sphere lie outside of a bevel gear's exact tooth, rad: for files and for mates."""

from __future__ import annotations

import math

import numpy as np

from geometry.curves.curve import Real
from geometry.gears.bevel.gear import BevelGear
from geometry.gears.bevel.sphere import spatial

# steps of the search for the foot on a fillet, how far it goes beyond its ends, of which step on it is found, and the
# slope that is none, rad
_STEPS, _BEYOND, _FOUND, _FLAT, _TABLE = 8, 0.2, 1e-13, 1e-6, 65


def flank_off(gear: BevelGear, angle: Real, aside: Real) -> Real:
    """Of places at angles from the axis, ``aside`` of their tooth's middle: involutes of one base are parallel."""
    base = gear.involute.base
    return np.asarray((aside - gear.half_angle(np.maximum(angle, base))) * math.sin(base))


def fillet_off(gear: BevelGear, angle: Real, aside: Real) -> Real:
    """The same of the fillet, whose normals go through the pitch line; beyond its ends it goes on."""
    return _fillet_foot(gear, angle, aside)[0]


def _fillet_foot(gear: BevelGear, angle: Real, aside: Real) -> tuple[Real, Real]:
    """The same, and ``u`` of the nearest place of the fillet."""
    angle, aside = np.broadcast_arrays(angle, aside)
    azimuth = math.pi / gear.number_of_teeth - aside
    fillet, end = gear.fillet, gear.joint[0]
    sine, cosine = math.sin(fillet.pitch), math.cos(fillet.pitch)
    table = np.linspace(0.0, end, _TABLE)
    u = table[(spatial(angle, azimuth) @ spatial(*fillet.place(table)).T).argmax(axis=-1)]
    out, along = np.sin(angle), np.cos(angle)
    furthest = 0.99 * math.acos(math.sin(abs(fillet.depth)))
    for _ in range(_STEPS):
        # seen from the pole the normal at u is (-cos pitch sin u, -cos u, sin pitch sin u), and here are the aims
        turned = azimuth + fillet.turn(u)
        x, y, rate = out * np.cos(turned), out * np.sin(turned), fillet.turn_rate(u)
        inwards = cosine * x - sine * along
        off_normal = inwards * np.sin(u) + y * np.cos(u)
        slope = (inwards + x * rate) * np.cos(u) - (cosine * rate + 1) * y * np.sin(u)
        step = off_normal / np.where(np.abs(slope) > _FLAT, slope, np.inf)
        before, u = u, np.clip(u - step, -_BEYOND, min(end + _BEYOND, furthest))
        if (np.abs(u - before) < _FOUND).all():
            break
    turned = azimuth + fillet.turn(u)
    aim = spatial(angle, turned)
    off = np.linalg.norm(np.cross(fillet.seen(u), aim), axis=-1)
    from_pole = np.linalg.norm(spatial(np.asarray(fillet.pitch), np.asarray(0.0)) - aim, axis=-1)
    return np.asarray(np.where(from_pole < 2 * np.sin(fillet.reach(u) / 2), off, -off)), u


def tooth_off(gear: BevelGear, angle: Real, azimuth: Real) -> Real:
    """Of places from the whole of tooth and root, by the nearest of their curves."""
    pitch = math.tau / gear.number_of_teeth
    aside = np.abs(azimuth - pitch * np.round(azimuth / pitch))
    form = float(gear.involute.angle(gear.joint[1]))
    beside = np.maximum(aside - gear.half_angle(gear.tip_angle), 0.0)
    above = angle - gear.tip_angle
    # the chord to the tip's edge, or straight down to its land
    across = np.sqrt(np.abs(np.sin(angle)) * math.sin(gear.tip_angle)) * np.sin(beside / 2)
    over = 2 * np.arcsin(np.hypot(np.sin(above / 2), across))
    found = np.where(above > 0, over, flank_off(gear, angle, aside))
    low = angle < form
    found[low] = fillet_off(gear, angle[low], aside[low])
    above_root = angle - gear.root_angle
    return np.asarray(np.where(above_root < 0, above_root, np.minimum(found, above_root)))


def wall_distance(gear: BevelGear, name: str, way: int, points: Real) -> Real:
    """How far points (n, 3) of the part lie from a ``flank`` or ``fillet`` of a side (+-1), mm.

    Straight ones are cones. Tooth lines lean others to the spheres, by tan beta times what of the normal on a sphere
    goes round the axis: sin u, by Clairaut, of a great circle through the pitch line.
    """
    depth, radius = gear.mounting_distance - points[:, 2], np.hypot(points[:, 0], points[:, 1])
    size, pitch = np.hypot(depth, radius), math.tau / gear.number_of_teeth
    azimuth = np.arctan2(points[:, 1], points[:, 0]) - gear.spin(size)
    # folded on the tooth's other side: chords between fillets that meet bow over the middle of their space
    aside, angle = way * azimuth, np.arctan2(radius, depth)
    aside = aside - pitch * np.floor(aside / pitch + 0.25)
    if name == "fillet":
        off, u = _fillet_foot(gear, angle, aside)
        share = np.sin(u)
    else:
        below = np.maximum(gear.involute.base - angle, 0.0)
        off = np.sin(np.minimum(np.hypot(flank_off(gear, angle, aside), below), math.pi / 2))
        share = np.asarray(math.cos(gear.pressure_angle))
    return np.asarray(size * np.abs(off) / np.hypot(1.0, np.tan(gear.line.spiral(size)) * share))
