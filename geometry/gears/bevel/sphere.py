"""Curves of bevel teeth on the unit sphere about the apex: the involute, and the fillet that a rounded cutter leaves.

A place is an angle from the gear's axis and an azimuth about it, rad. What holds on the sphere holds at every cone
distance: a tooth is a cone over its curve.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.record import Record
from geometry.curves.curve import Real


class SphericalInvolute(Record):
    """What a point of a great circle draws that rolls off the small circle ``base`` rad from the axis, from azimuth 0.

    The great circle that touches the base circle is its normal, so involutes of one base circle are parallel, and two
    gears whose base circles touch one great circle are conjugate (Litvin, Gear Geometry, spherical involute).
    """

    base: float

    def arc(self, angle: ArrayLike) -> Real:
        """Of the rolled great circle up to the place at ``angle``; 0 below ``base``."""
        t = np.asarray(angle, dtype=float)
        # cos t = cos b cos(arc), without its cancellation near the base circle
        sine = np.sqrt(np.maximum(np.sin(t - self.base) * np.sin(t + self.base), 0.0))
        return np.asarray(np.arctan2(sine, np.cos(t)))

    def angle(self, arc: ArrayLike) -> Real:
        """Of the place where so much of the great circle is rolled off."""
        a = np.asarray(arc, dtype=float)
        sine = np.hypot(math.sin(self.base), math.cos(self.base) * np.sin(a))
        return np.asarray(np.arctan2(sine, math.cos(self.base) * np.cos(a)))

    def involute(self, arc: ArrayLike) -> Real:
        """Azimuth of that place: the arc rolled off less the angle seen from the axis, rad."""
        a, sine = np.asarray(arc, dtype=float), math.sin(self.base)
        seen = np.arctan2(np.sin(a), sine * np.cos(a))
        return np.asarray(a / sine - seen)

    def involute_at(self, angle: ArrayLike) -> Real:
        """The same by the angle from the axis."""
        return self.involute(self.arc(angle))


class SphericalFillet(Record):
    """Envelope of a crown gear's rounded tip that rolls on the pitch cone ``pitch`` rad wide, beside a space.

    The rounding, ``radius`` rad, has its centre ``depth`` rad below the pitch plane of the crown gear (above where
    negative) and ``aside`` rad of its azimuth off the middle of its tooth. The normal of the envelope goes through the
    pitch line; ``u``, rad, is its angle to the meridian there: 0 at the root, pi/2 less the pressure angle where the
    straight flank begins. Derivation: DERIVATIONS.md, section 20.
    """

    pitch: float
    depth: float
    radius: float
    aside: float

    def turn(self, u: ArrayLike) -> Real:
        """How far the gear has turned since the crown gear's tooth stood in the middle."""
        # azimuth of the rounding's centre on the crown gear, from the pitch line
        centre = np.arcsin(math.tan(self.depth) * np.tan(np.asarray(u, dtype=float)))
        return np.asarray((centre - self.aside) / math.sin(self.pitch))

    def turn_rate(self, u: ArrayLike) -> Real:
        """d turn / du."""
        tangent, deep = np.tan(np.asarray(u, dtype=float)), math.tan(self.depth)
        return np.asarray(deep * (1 + tangent**2) / np.sqrt(1 - (deep * tangent) ** 2) / math.sin(self.pitch))

    def reach(self, u: ArrayLike) -> Real:
        """From the pitch line to the place, along the normal."""
        return np.asarray(np.arcsin(math.sin(self.depth) / np.cos(np.asarray(u, dtype=float))) + self.radius)

    def seen(self, u: ArrayLike) -> Real:
        """Unit vectors (..., 3) of the places; the pitch line, through which the normal goes, lies at azimuth 0."""
        t = np.asarray(u, dtype=float)
        reach, sine, cosine = self.reach(t), math.sin(self.pitch), math.cos(self.pitch)
        x = np.cos(reach) * sine - np.sin(reach) * cosine * np.cos(t)
        y = np.sin(reach) * np.sin(t)
        z = np.cos(reach) * cosine + np.sin(reach) * sine * np.cos(t)
        return np.stack([x, y, z], axis=-1)

    def place(self, u: ArrayLike) -> tuple[Real, Real]:
        """Angle from the axis, and azimuth off the middle of the space."""
        x, y, z = np.moveaxis(self.seen(u), -1, 0)
        return np.arctan2(np.hypot(x, y), z), np.arctan2(y, x) - self.turn(u)


def spatial(angle: Real, azimuth: Real) -> Real:
    """Unit vectors (..., 3) from the apex; the gear's axis is z."""
    a, b = np.broadcast_arrays(angle, azimuth)
    return np.stack([np.sin(a) * np.cos(b), np.sin(a) * np.sin(b), np.cos(a)], axis=-1)
