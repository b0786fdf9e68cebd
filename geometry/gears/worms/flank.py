"""Flanks of cylindrical worms by how they are cut: how far each stands back, axially, from its point on the reference.

A thread lies about z = 0 on +x, its upper flank is the screw surface z = s_x / 2 - F(r) + p theta, the lower one its
image under half a turn about x. F, the drop, is zero on the reference cylinder and grows outwards. Forms of GOST 18498
and ISO/TR 10828; the formulas are in DERIVATIONS.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.record import Record
from geometry.base.roots import bracketed_root, bracketed_roots
from geometry.curves.curve import Real

# places at which a least one is sought, and how often nearer
_PLACES, _ROUNDS = 33, 9
# rows of a table from which contacts are found, steps from there, and how near they end, part of the radius
_TABLE, _STEPS, _MET = 2049, 3, 2e-14


class Screw(Record):
    """What every form of flank starts from.

    ``radius`` of the reference cylinder, mm; ``parameter`` p, axial advance, mm per rad; ``half_thickness`` and
    ``half_space``, axial, on the reference cylinder, mm.
    """

    radius: float
    parameter: float
    half_thickness: float
    half_space: float

    @property
    def lead_angle(self) -> float:
        """gamma on the reference cylinder, rad."""
        return math.atan2(self.parameter, self.radius)


class Flank(Record):
    """A form of flank; ``angle``: of its straight line, of the rack or of the wheel, rad."""

    screw: Screw
    angle: float

    @property
    def least_radius(self) -> float:
        """Where the flank begins, mm; 0 where it goes on to the axis."""
        return 0.0

    def drop(self, radius: ArrayLike) -> Real:
        """F, axial, mm, at radii (mm) from ``least_radius`` on."""
        raise NotImplementedError

    def slope(self, radius: ArrayLike) -> Real:
        """dF/dr, the tangent of the axial pressure angle."""
        raise NotImplementedError


class ArchimedeanFlank(Flank):
    """ZA: straight in the axial section."""

    def drop(self, radius: ArrayLike) -> Real:
        """F = (r - r_1) tan alpha_x."""
        return (np.asarray(radius, float) - self.screw.radius) * math.tan(self.angle)

    def slope(self, radius: ArrayLike) -> Real:
        """The same everywhere."""
        return np.full(np.shape(radius), math.tan(self.angle))


class InvoluteFlank(Flank, dict=True):
    """ZI: an involute helical gear of few teeth; straight in planes that touch the base cylinder."""

    @property
    def base_lead_angle(self) -> float:
        """gamma_b, rad: cos gamma_b = cos alpha_n cos gamma."""
        return math.acos(math.cos(self.angle) * math.cos(self.screw.lead_angle))

    @cached_property
    def least_radius(self) -> float:
        """The base radius p / tan gamma_b, mm."""
        return self.screw.parameter / math.tan(self.base_lead_angle)

    def _roll(self, radius: ArrayLike) -> Real:
        """Tangent of the transverse pressure angle at a radius."""
        base = self.least_radius
        ratio = np.asarray(radius, float) / base
        return np.sqrt(np.maximum((ratio - 1) * (ratio + 1), 0.0))

    def drop(self, radius: ArrayLike) -> Real:
        """F = p (inv alpha_t(r) - inv alpha_t(r_1))."""
        here, there = self._roll(radius), self._roll(self.screw.radius)
        # the difference of both angles, without loss where they are alike
        turned = np.arctan2(here - there, 1 + here * there)
        return self.screw.parameter * (here - there - turned)

    def slope(self, radius: ArrayLike) -> Real:
        """p tan alpha_t / r."""
        return self.screw.parameter * self._roll(radius) / np.asarray(radius, float)


class ConvoluteFlank(Flank):
    """ZN1, ZN2: straight in the plane normal to the middle helix of the thread, or of the ``space``."""

    space: bool = False

    @lru_cache(maxsize=64)  # noqa: B019
    def _line(self) -> tuple[float, float, float]:
        """The line's point on the reference cylinder, along x and along the binormal, mm, and its slope."""
        screw, gamma = self.screw, self.screw.lead_angle
        half, sine = screw.half_space if self.space else screw.half_thickness, math.sin(gamma)

        def beyond(width: float) -> float:
            return width * math.cos(gamma) + screw.parameter * math.asin(min(width * sine / screw.radius, 1.0)) - half

        width = bracketed_root(beyond, 0.0, min(half / math.cos(gamma), screw.radius / sine)).value
        lean = math.tan(self.angle)
        return math.sqrt(screw.radius**2 - (width * sine) ** 2), width, lean if self.space else -lean

    @property
    def least_radius(self) -> float:
        """Distance of the line from the axis, mm."""
        x, width, lean = self._line()
        sine = math.sin(self.screw.lead_angle)
        return abs(width - x * lean) * sine / math.hypot(1.0, lean * sine)

    def _at(self, radius: ArrayLike) -> tuple[Real, Real]:
        """Places along x and along the binormal of the line's points at radii, mm."""
        x, width, lean = self._line()
        sine = math.sin(self.screw.lead_angle)
        r = np.asarray(radius, float)
        # |point|^2 = (x + t)^2 + (width + lean t)^2 sine^2, x^2 + width^2 sine^2 = r_1^2
        a, b = 1 + (lean * sine) ** 2, x + width * lean * sine**2
        c = (self.screw.radius - r) * (self.screw.radius + r)
        t = -c / (b + np.sqrt(np.maximum(b * b - a * c, 0.0)))
        return x + t, width + lean * t

    def drop(self, radius: ArrayLike) -> Real:
        """From the line, screwed back into the axial section."""
        screw, gamma = self.screw, self.screw.lead_angle
        x, width = self._at(radius)
        z = width * math.cos(gamma) + screw.parameter * np.arctan2(width * math.sin(gamma), x)
        return z - screw.half_space if self.space else screw.half_thickness - z

    def slope(self, radius: ArrayLike) -> Real:
        """By the derivatives along the line."""
        screw, lean = self.screw, self._line()[2]
        sine, cosine = math.sin(screw.lead_angle), math.cos(screw.lead_angle)
        x, width = self._at(radius)
        rise = lean * cosine + screw.parameter * sine * (lean * x - width) / (x**2 + (width * sine) ** 2)
        out = (x + width * lean * sine**2) / np.asarray(radius, float)
        return rise / out if self.space else -rise / out


class GroundFlank(Flank):
    """ZK1: enveloped by a conical wheel of ``wheel_diameter`` (mm, at the reference), its axis swivelled by gamma."""

    wheel_diameter: float

    @property
    def least_radius(self) -> float:
        """Where the wheel touches nearest to the axis, mm."""
        width = self.half_width()
        return float(self._touch(np.array([self._deepest(width)]), width)[0][0])

    @lru_cache(maxsize=64)  # noqa: B019
    def _deepest(self, half_width: float) -> float:
        """How far from the wheel's axis it touches the screw nearest to the screw's, mm."""
        low, high = self.wheel_diameter / 2, self.wheel_diameter / 2 + self.screw.radius
        for _ in range(_ROUNDS):
            places = np.linspace(low, high, _PLACES)
            k = int(np.argmin(self._touch(places, half_width)[0]))
            low, high = float(places[max(k - 1, 0)]), float(places[min(k + 1, _PLACES - 1)])
        return (low + high) / 2

    def _touch(self, distance: Real, half_width: float) -> tuple[Real, Real, Real]:
        """Radius, axial half space and its slope, where the cone touches the screw ``distance`` mm from its axis."""
        screw, gamma = self.screw, self.screw.lead_angle
        sine, cosine = math.sin(gamma), math.cos(gamma)
        lean, straight = math.sin(self.angle), math.cos(self.angle)
        mean = self.wheel_diameter / 2
        centre = screw.radius + mean
        width = half_width + (mean - distance) * math.tan(self.angle)
        # n . v = 0 is A cos phi + B sin phi = C
        a = sine * (distance * straight - width * lean)
        b = lean * (centre * cosine + screw.parameter * sine)
        c = straight * sine * mean
        phi = np.arctan2(b, a) - np.arccos(np.clip(c / np.hypot(a, b), -1.0, 1.0))
        x = centre - distance * np.cos(phi)
        y = distance * np.sin(phi) * cosine - width * sine
        z = distance * np.sin(phi) * sine + width * cosine
        radius = np.hypot(x, y)
        normal = (-lean * np.cos(phi), lean * np.sin(phi) * cosine - straight * sine)
        upward = lean * np.sin(phi) * sine + straight * cosine
        slope = -(normal[0] * x + normal[1] * y) / (radius * upward)
        return radius, z - screw.parameter * np.arctan2(y, x), slope

    def _distances(self, radius: Real, half_width: float) -> Real:
        """How far from the wheel's axis it touches the screw at radii, mm."""
        mean, reach = self.wheel_diameter / 2, self.screw.radius
        about = mean + self.screw.radius - radius
        low = np.maximum(about - 0.5 * reach, 1e-6 * mean)
        high = np.minimum(about + 0.5 * reach, self._deepest(half_width))

        def beyond(distance: Real) -> Real:
            return self._touch(distance, half_width)[0] - radius

        return bracketed_roots(beyond, low, high, beyond(low), beyond(high))

    @lru_cache(maxsize=64)  # noqa: B019
    def half_width(self) -> float:
        """Half width of the wheel at its mean diameter that leaves the asked thickness, mm."""
        reference = np.array([self.screw.radius])

        def beyond(width: float) -> float:
            return float(self._touch(self._distances(reference, width), width)[1][0]) - self.screw.half_space

        return bracketed_root(beyond, 0.0, 2 * self.screw.half_space).value

    @lru_cache(maxsize=64)  # noqa: B019
    def _table(self) -> tuple[Real, Real, Real]:
        """Radii, ascending, how far from the wheel's axis it touches there, and by how much that changes."""
        width, mean = self.half_width(), self.wheel_diameter / 2
        places = np.linspace(max(mean - self.screw.radius, 1e-6 * mean), self._deepest(width), _TABLE)[::-1]
        radius = self._touch(places, width)[0]
        return radius, places, np.gradient(places, radius)

    def _contact(self, radius: ArrayLike) -> tuple[Real, Real]:
        r = np.asarray(radius, float)
        half, slope = self._met(r.tobytes())
        return half.reshape(r.shape), slope.reshape(r.shape)

    # thickness and slope are asked for at the same radii, one after the other
    @lru_cache(maxsize=2)  # noqa: B019
    def _met(self, asked: bytes) -> tuple[Real, Real]:
        """Axial half spaces and slopes at radii, mm."""
        width, flat = self.half_width(), np.frombuffer(asked)
        radii, places, slopes = self._table()
        distance, slope = np.interp(flat, radii, places), np.interp(flat, radii, slopes)
        for left in range(_STEPS, -1, -1):
            radius, half, steep = self._touch(distance, width)
            met = np.abs(radius - flat) <= _MET * flat
            if met.all() or not left:
                break
            distance = distance - (radius - flat) * slope
        # beyond the table, and where the wheel reaches deepest
        hard = ~met | (flat > radii[-1])
        if hard.any():
            distance[hard] = self._distances(flat[hard], width)
            _, half, steep = self._touch(distance, width)
        for kept in (half, steep):
            kept.setflags(write=False)
        return half, steep

    def drop(self, radius: ArrayLike) -> Real:
        """From the line of contact, screwed back into the axial section."""
        return self._contact(radius)[0] - self.screw.half_space

    def slope(self, radius: ArrayLike) -> Real:
        """By the normal of cone and screw, which they share."""
        return self._contact(radius)[1]


# each from screw, angle and the diameter of the grinding wheel
FORMS: Mapping[str, Callable[[Screw, float, float], Flank]] = {
    "ZA": lambda screw, angle, _: ArchimedeanFlank(screw, angle),
    "ZI": lambda screw, angle, _: InvoluteFlank(screw, angle),
    "ZN1": lambda screw, angle, _: ConvoluteFlank(screw, angle),
    "ZN2": lambda screw, angle, _: ConvoluteFlank(screw, angle, True),
    "ZK1": GroundFlank,
}
