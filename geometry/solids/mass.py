"""Volume, centre and inertia of bodies by exact integrals: Green's theorem in each section, Gauss's rule between."""

from __future__ import annotations

import numpy as np

from geometry.base.gauss import panels
from geometry.base.record import Record, made_once
from geometry.curves.curve import Real
from geometry.plane.measure import profile_length, quadrature
from geometry.plane.profile import Profile
from geometry.solids.body import Body, Wall

# an upright wall's integrals are polynomials of degree 2 in z
_HEIGHT_POINTS = 4
# sections of a chamfer are smooth in z
_CHAMFER_POINTS = 8
# turned sections vary like cosines of twice the turn
_TURNED_POINTS = 20


class Moments(Record):
    """Integrals over a body of unit density.

    ``volume`` mm^3; ``centre`` (3,) mm; ``inertia`` (3, 3) about the origin's axes, mm^5: the tensor
    with -integral of x y off its diagonal.
    """

    volume: float
    centre: Real
    inertia: Real


def body_moments(body: Body) -> Moments:
    """Moments of a body: each wall carries its signed sections from its lower to its upper loop."""
    return made_once(body, "moments", lambda: _moments(body))


def _moments(body: Body) -> Moments:
    total = np.zeros(10)
    for wall in body.walls:
        total += _wall_share(body, wall)
    return moments_of(total)


def moments_of(integrals: Real) -> Moments:
    """Moments from the integrals of 1, x, y, z, xx, yy, xy, zz, xz, yz."""
    v, x, y, z, xx, yy, xy, zz, xz, yz = integrals.tolist()
    inertia = np.array([[yy + zz, -xy, -xz], [-xy, xx + zz, -yz], [-xz, -yz, xx + yy]])
    return Moments(v, np.array([x, y, z]) / v, inertia)


def column_integrals(section: Real, low: float, high: float) -> Real:
    """The same integrals over an upright column between two heights, mm, from those of its section."""
    a, x, y, xx, yy, xy = section.tolist()
    h, h2, h3 = high - low, (high**2 - low**2) / 2, (high**3 - low**3) / 3
    return np.array([a * h, x * h, y * h, a * h2, xx * h, yy * h, xy * h, a * h3, x * h2, y * h2])


def _wall_share(body: Body, wall: Wall) -> Real:
    """Integrals of 1, x, y, z, xx, yy, xy, zz, xz, yz over what a wall carries, (10,)."""
    low, high = body.height(wall)
    lower, chamfer = body.loop_profile(wall.lower), body.is_chamfer(wall)
    one_section = None if chamfer else section_moments(lower)
    # the moments of three periods or more do not feel a turn
    place = body.loops[wall.lower]
    moved = body.shear(wall) != 0 or (lower.count < 3 and not (chamfer and place.turn == 0 == place.shift))
    count = _CHAMFER_POINTS if chamfer else _TURNED_POINTS if moved else _HEIGHT_POINTS
    share = np.zeros(10)
    for z, weight in zip(*(x.tolist() for x in panels(np.array([low, high]), count)), strict=True):
        section = one_section if one_section is not None else section_moments(body.section(wall, z))
        if moved:
            section = _moved(section, float(body.turn_at(wall, z)), complex(body.shift_at(wall, z)))
        a, x, y, xx, yy, xy = section.tolist()
        share += weight * np.array([a, x, y, a * z, xx, yy, xy, a * z * z, x * z, y * z])
    return share


def _moved(section: Real, angle: float, shift: complex) -> Real:
    """Integrals of 1, x, y, xx, yy, xy over a section turned by an angle, rad, and then moved, mm."""
    a, x, y, xx, yy, xy = section.tolist()
    first = (x + 1j * y) * np.exp(1j * angle)
    # integrals of the square of x + iy, and of its modulus
    second = (xx - yy + 2j * xy) * np.exp(2j * angle) + 2 * shift * first + a * shift**2
    polar = xx + yy + 2 * (shift.conjugate() * first).real + a * abs(shift) ** 2
    first += a * shift
    return np.array([a, first.real, first.imag, (polar + second.real) / 2, (polar - second.real) / 2, second.imag / 2])


def section_moments(profile: Profile) -> Real:
    """Integrals of 1, x, y, x^2, y^2, xy inside a profile, (6,); counter-clockwise positive."""
    rules = [(s.curve, *quadrature(s.curve)) for s in profile.period]
    p = np.concatenate([curve.point(t) for curve, t, _ in rules])
    swept = (np.conj(p) * np.concatenate([curve.derivative(t) * weights for curve, t, weights in rules])).imag
    # divergence of (x f, y f) for f homogeneous of degree n is (n + 2) f
    if profile.count > 2:
        # three periods or more: the centre lies on the axis, both second moments are equal
        polar = profile.count * float(np.sum(np.abs(p) ** 2 * swept)) / 4
        return np.array([profile.count * swept.sum() / 2, 0, 0, polar / 2, polar / 2, 0])
    turn = np.exp(1j * profile.pitch_angle * np.arange(profile.count))[:, None]
    p, cross = (turn * p).ravel(), np.tile(swept, profile.count)
    x, y = p.real, p.imag
    return np.array(
        [
            cross.sum() / 2,
            (x * cross).sum() / 3,
            (y * cross).sum() / 3,
            (x * x * cross).sum() / 4,
            (y * y * cross).sum() / 4,
            (x * y * cross).sum() / 4,
        ]
    )


def wall_area(body: Body) -> float:
    """What a change of all walls by one mm within the planes of their heights changes of the volume at most, mm^2."""
    lengths: dict[int, float] = {}
    area = 0.0
    for wall in body.walls:
        profiles = [body.loops[loop].profile for loop in (wall.lower, wall.upper)]
        for profile in profiles:
            if profile not in lengths:
                lengths[profile] = profile_length(body.profiles[profile])
        low, high = body.height(wall)
        area += max(lengths[profile] for profile in profiles) * (high - low)
    return area
