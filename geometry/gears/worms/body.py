"""The solid of a worm: a thread between two ends, shaft steps beyond them, a bore.

The middle of the thread lies at z = 0. At both ends a cone about the axis cuts the thread: it begins on the root
cylinder at the end of the threaded length and widens inwards over the whole depth of the thread; at ``end_angle`` 0 it
is a plane. Meshes, B-reps, read-back and mass integrals go through this description.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import ClassVar, Literal

import numpy as np

from geometry.base.errors import ParameterError, limit
from geometry.base.record import Record
from geometry.curves.curve import Real
from geometry.curves.line_arc import Arc, Line
from geometry.gears.worms.thread import SectionLine, Thread
from geometry.plane.measure import distance_to_profile, gauss_rule
from geometry.plane.profile import Label, Profile, circle
from geometry.solids.mass import Moments, column_integrals, moments_of, section_moments

# Gauss's rule on each line of the axial section
_POINTS = 40
# what is one radius or one height, mm
_SAME = 1e-9
# places on a line at which the ends of a thread are looked at
_SAMPLES = 65


class Step(Record):
    """One step of a shaft from the thread outwards, mm; ``chamfer``: of its outer edge, at 45 degrees."""

    diameter: float
    length: float
    chamfer: float = 0.0


class Screwed(Record):
    """What a line of the axial section leaves on all threads, on their upper or their lower side."""

    thread: Thread
    line: SectionLine
    upper: bool
    what: str = "flank"

    def distance(self, points: Real) -> Real:
        """Of points (n, 3), mm, to first order in it: by the axial section, also beyond the ends of the line."""
        worm, side = self.thread.worm, 1 if self.upper else -1
        radius = np.hypot(points[:, 0], points[:, 1])
        angle = worm.sign * np.arctan2(points[:, 1], points[:, 0])
        pitch = math.pi * worm.module
        away = side * (points[:, 2] - worm.parameter * angle)
        away = away - pitch * np.round((away - self._height(radius)) / pitch)
        line, p = self.line, worm.parameter
        if isinstance(line, Arc):
            spoke = radius + 1j * away - line.centre
            off = np.abs(spoke) - line.radius
            normal = spoke / np.abs(spoke)
        elif isinstance(line, Line):
            off, normal = away - line.start.imag, np.full(len(radius), 1j)
        else:
            inside = np.maximum(radius, worm.flank.least_radius * (1 + 1e-12))
            off = away - worm.half_thickness(inside)
            normal = 1j + worm.flank.slope(inside)
            off, normal = off / np.abs(normal), normal / np.abs(normal)
        # what lies beyond the line's ends is not on it
        low, high = (float(line.point(t).real) for t in line.domain)
        beyond = np.maximum(0.0, np.maximum(low - radius, radius - high))
        found = np.abs(off) / np.hypot(1.0, normal.imag * p / np.maximum(radius, _SAME))
        return np.asarray(np.hypot(found, beyond))

    def _height(self, radius: Real) -> Real:
        """z of the line near a radius, mm."""
        low, high = (complex(self.line.point(t)) for t in self.line.domain)
        share = np.clip((radius - low.real) / (high.real - low.real), 0.0, 1.0)
        return np.asarray(low.imag + share * (high.imag - low.imag))


class Round(Record):
    """A cylinder or a cone about the axis between two circles (z, r), mm."""

    low: tuple[float, float]
    high: tuple[float, float]

    @property
    def what(self) -> str:
        """In a phrase."""
        return "cylinder" if self.low[1] == self.high[1] else "cone"

    def distance(self, points: Real) -> Real:
        """Of points (n, 3), mm."""
        (z0, r0), (z1, r1) = self.low, self.high
        size = math.hypot(z1 - z0, r1 - r0)
        radius = np.hypot(points[:, 0], points[:, 1])
        return np.asarray(np.abs((radius - r0) * (z1 - z0) - (points[:, 2] - z0) * (r1 - r0)) / size)


class Level(Record):
    """A plane across the axis, mm."""

    z: float
    what: str = "plane face"

    def distance(self, points: Real) -> Real:
        """Of points (n, 3), mm."""
        return np.asarray(np.abs(points[:, 2] - self.z))


class BoreWall(Record):
    """The wall of the bore."""

    profile: Profile
    what: str = "wall"

    def distance(self, points: Real) -> Real:
        """Of points (n, 3), mm."""
        plane = points[:, 0] + 1j * points[:, 1]
        return np.asarray(distance_to_profile(plane, self.profile, trusted=np.inf))


Face = Screwed | Round | Level | BoreWall


class WormBody(Record):
    """A worm as a solid; ``length`` of the thread at its root, mm, ``end_angle`` of the cone from the end plane, rad.

    ``below`` and ``above``: steps of the shaft from the thread outwards; ``bore``: its profile, clockwise.
    """

    thread: Thread
    length: float
    end_angle: float = 0.0
    below: tuple[Step, ...] = ()
    above: tuple[Step, ...] = ()
    bore: Profile | None = None
    is_faced: ClassVar[Literal[True]] = True

    @property
    def root_radius(self) -> float:
        """Of the worm, mm."""
        return self.thread.worm.root_radius

    @property
    def wall_width(self) -> float:
        """What the volume of a sliver along a wall goes by, mm: the depth of the thread over its turns."""
        worm = self.thread.worm
        turns = max(1.0, self.length / (math.pi * worm.module))
        return (worm.tip_radius - worm.root_radius) / turns

    @property
    def profiles(self) -> tuple[Profile, ...]:
        """The circle around all of it, and the bore."""
        return (circle(self.section_reach(), Label.BODY), *((self.bore,) if self.bore else ()))

    @property
    def walls(self) -> tuple[()]:
        """It has none of the kinds of geometry/solids/body.py."""
        return ()

    def end_height(self, radius: Real | float) -> Real:
        """Height of the upper cone at a radius, mm; the lower end is its mirror image."""
        return np.asarray(self.length / 2 - (np.asarray(radius) - self.root_radius) * math.tan(self.end_angle))

    def outline(self, *, above: bool) -> list[tuple[float, float]]:
        """(z, r) of a shaft from the root's end on, outwards, to its last edge, mm; without a shaft the root's end."""
        sign = 1.0 if above else -1.0
        z = self.length / 2
        found = [(sign * z, self.root_radius)]
        for step in self.above if above else self.below:
            radius = step.diameter / 2
            found.append((sign * z, radius))
            z += step.length
            if step.chamfer > 0:
                found.append((sign * (z - step.chamfer), radius))
                radius -= step.chamfer
            found.append((sign * z, radius))
        return [p for k, p in enumerate(found) if k == 0 or math.dist(p, found[k - 1]) > _SAME]

    def ends(self) -> tuple[float, float]:
        """Lowest and highest z, mm."""
        return self.outline(above=False)[-1][0], self.outline(above=True)[-1][0]

    def levels(self) -> tuple[float, ...]:
        """Heights at which something ends, ascending, mm."""
        return tuple(sorted({z for above in (False, True) for z, _ in self.outline(above=above)}))

    def section_reach(self) -> float:
        """Greatest distance from the axis, mm."""
        return self.thread.worm.tip_radius

    def reach(self) -> float:
        """Greatest coordinate, mm."""
        return max(self.section_reach(), *map(abs, self.ends()))

    def steepness(self) -> float:
        """How far a step along the axis moves a wall at most, as a part of it."""
        return 1.0

    def has_screws(self) -> bool:
        """Whether there are walls of the kind of helical teeth: none of those."""
        return False

    def surfaces(self) -> list[Face]:
        """Its faces in different surfaces."""
        thread, worm, half = self.thread, self.thread.worm, self.length / 2
        found: list[Face] = []
        for upper in (True, False):
            found += [Screwed(thread, line, upper, name) for name, line in thread.lines]
        found += [_pipe(worm.root_radius), _pipe(worm.tip_radius)]
        tip = float(self.end_height(worm.tip_radius))
        for above, sign in ((False, -1.0), (True, 1.0)):
            if self.end_angle > 0:
                found.append(Round((sign * half, worm.root_radius), (sign * tip, worm.tip_radius)))
            points = self.outline(above=above)
            if self.end_angle == 0 and (len(points) == 1 or points[0][0] != points[1][0]):
                found.append(Level(sign * half))
            for before, after in zip(points, [*points[1:], (points[-1][0], 0.0)], strict=True):
                known = _pipe(before[1]) if before[1] == after[1] else Round(before, after)
                found.append(Level(before[0]) if before[0] == after[0] else known)
        if self.bore is not None:
            found.append(BoreWall(self.bore))
        return list(dict.fromkeys(found))

    def distance(self, face: Face, points: Real) -> Real:
        """Of points (n, 3) from the surface that a face lies in, mm."""
        return face.distance(points)

    def volume(self) -> float:
        """Exact, mm^3."""
        return worm_moments(self).volume

    def checked(self) -> WormBody:
        """The solid itself, where it exists.

        Raises
        ------
        ParameterError
            The thread is too short for its ends.
        """
        least = self.least_length()
        if not self.length > least:
            raise ParameterError(
                "thread_length", self.length, "worm_thread_too_short", limit(1.001 * least, self.length)
            )
        return self

    def least_length(self) -> float:
        """Length at which the ends of all lines still leave a whole axial section between them, mm."""
        worm = self.thread.worm
        places = np.concatenate([line.point(np.linspace(*line.domain, _SAMPLES)) for _, line in self.thread.lines])
        away = np.abs(places.imag) + (places.real - worm.root_radius) * math.tan(self.end_angle)
        return 2 * float(away.max()) * (1 + 1e-6)


def _pipe(radius: float) -> Round:
    """A cylinder about the axis, of any length."""
    return Round((0.0, radius), (1.0, radius))


def worm_moments(body: WormBody) -> Moments:
    """Volume, centre and inertia: closed forms along the axis and around it, Gauss's rule over the radius.

    At a radius the thread spans a half angle a about the polar angle z / p, from one end to the other: the integrals of
    its powers of x, y and z are closed there, and analytic over each line of the axial section.
    """
    total = np.zeros(10)
    worm = body.thread.worm
    n, p, sign = worm.number_of_starts, worm.parameter, worm.sign
    nodes, weights = gauss_rule(_POINTS)
    for _, line in body.thread.lines:
        low, high = line.domain
        t = (low + high) / 2 + (high - low) / 2 * nodes
        place, way = line.point(t), line.tangent(t)
        radii = place.real
        # dr along the line by Gauss's rule: the speed over the parameter
        speed = _speed(line, t)
        total += _rings(radii, place.imag / p, np.asarray(body.end_height(radii), float), n, p, sign) @ (
            weights * (high - low) / 2 * speed * way.real
        )
    half = body.length / 2
    columns = [(circle(worm.root_radius, Label.BODY), -half, half)]
    for above in (False, True):
        points = body.outline(above=above)
        for (z0, r0), (z1, r1) in pairwise(points):
            total += _cone(min(z0, z1), max(z0, z1), r0 if z0 < z1 else r1, r1 if z0 < z1 else r0)
    if body.bore is not None:
        columns.append((body.bore, *body.ends()))
    for profile, base, top in columns:
        total += column_integrals(section_moments(profile), base, top)
    return moments_of(total)


def _speed(line: SectionLine, t: Real) -> Real:
    """|dpoint/dt| of a line, mm per unit of its parameter."""
    if isinstance(line, Arc | Line):
        return np.abs(line.derivative(t))
    # r = hypot(t, least): dr/dt = t / r, and the tangent's share of r is its real part
    return np.asarray(t / line.radius(t) / line.tangent(t).real)


def _rings(r: Real, a: Real, h: Real, n: int, p: float, sign: int) -> Real:
    """Integrals of 1, x, y, z, xx, yy, xy, zz, xz, yz over cylinders of radii r within n threads, (10, radii).

    Each thread spans the half angles a about z / p, z from -h to h.
    """
    zero = np.zeros_like(r)
    area = 2 * n * r * a
    one = n == 1
    # of cos(z / p) and z sin(z / p) from -h to h, of cos(2 z / p)
    c1, s1 = 2 * p * np.sin(h / p), 2 * (p * p * np.sin(h / p) - p * h * np.cos(h / p))
    c2 = p * np.sin(2 * h / p) if n <= 2 else zero
    x = 2 * r * r * np.sin(a) * c1 if one else zero
    yz = sign * 2 * r * r * np.sin(a) * s1 if one else zero
    polar, double = r * r * area * h, n * r**3 * np.sin(2 * a) * c2 / 2
    return np.stack([area * 2 * h, x, zero, zero, polar + double, polar - double, zero, area * 2 * h**3 / 3, zero, yz])


def _cone(low: float, high: float, lower: float, upper: float) -> Real:
    """The same integrals over a frustum about the axis between two heights, with these radii."""
    nodes, weights = gauss_rule(4)
    z = (low + high) / 2 + (high - low) / 2 * nodes
    r = lower + (upper - lower) * (z - low) / (high - low) if high > low else np.zeros(4)
    w = weights * (high - low) / 2 * math.pi
    v, vz, vzz, polar = (float(np.sum(w * f)) for f in (r**2, r**2 * z, r**2 * z * z, r**4 / 4))
    return np.array([v, 0.0, 0.0, vz, polar, polar, 0.0, vzz, 0.0, 0.0])
