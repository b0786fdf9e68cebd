"""The solid of a worm: a thread between two ends, shaft steps beyond them, a bore.

The middle of the thread lies at z = 0. At both ends a cone about the axis cuts the thread: it begins on the root
cylinder at the end of the threaded length and widens inwards over the whole depth of the thread; at ``end_angle`` 0 it
is a plane.
"""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from geometry.base.errors import ParameterError, limit
from geometry.base.record import Record
from geometry.curves.curve import Real
from geometry.curves.line_arc import Arc, Line
from geometry.gears.worms.thread import SectionLine, Thread, line_step
from geometry.plane.measure import gauss_rule
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

    def distance(self, points: Real) -> Real:
        """Of points (n, 3), mm, to first order in it, by the axial section; lines go on beyond their ends."""
        worm, side = self.thread.worm, 1 if self.upper else -1
        radius = np.hypot(points[:, 0], points[:, 1])
        angle = worm.sign * np.arctan2(points[:, 1], points[:, 0])
        pitch = math.pi * worm.module
        away = side * (points[:, 2] - worm.parameter * angle)
        away = away - pitch * np.round((away - self._height(radius)) / pitch)
        line, below = self.line, np.zeros(len(radius))
        if isinstance(line, Arc):
            spoke = radius + 1j * away - line.centre
            off, rise = np.abs(spoke) - line.radius, spoke.imag / np.abs(spoke)
        elif isinstance(line, Line):
            off, rise = away - line.start.imag, np.ones(len(radius))
        else:
            inside = np.maximum(radius, worm.flank.least_radius * (1 + 1e-12))
            steep = np.hypot(1.0, worm.flank.slope(inside))
            off, rise, below = (away - worm.half_thickness(inside)) / steep, 1 / steep, inside - radius
        # the screw leans what stands across the axial section
        return np.asarray(
            np.hypot(np.abs(off) / np.hypot(1.0, rise * worm.parameter / np.maximum(radius, _SAME)), below)
        )

    def _height(self, radius: Real) -> Real:
        """z of the line near a radius, mm."""
        low, high = (complex(self.line.point(t)) for t in self.line.domain)
        share = np.clip((radius - low.real) / (high.real - low.real), 0.0, 1.0)
        return np.asarray(low.imag + share * (high.imag - low.imag))


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

    @property
    def root_radius(self) -> float:
        """Of the worm, mm."""
        return self.thread.worm.root_radius

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
            if abs(radius - found[-1][1]) <= _SAME:
                # a cylinder that goes on, and no cone
                radius = found[-1][1]
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
                "thread_length", self.length, "worm_thread_too_short", limit(least * (1 + 1e-9), self.length)
            )
        return self

    def least_length(self) -> float:
        """Length at which the ends of all lines still leave a whole axial section between them, mm."""
        worm = self.thread.worm
        places = np.concatenate([line.point(np.linspace(*line.domain, _SAMPLES)) for _, line in self.thread.lines])
        away = np.abs(places.imag) + (places.real - worm.root_radius) * math.tan(self.end_angle)
        return 2 * float(away.max()) * (1 + 1e-6)


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
        place = line.point(t)
        radii = place.real
        total += _rings(radii, place.imag / p, np.asarray(body.end_height(radii), float), n, p, sign) @ (
            weights * (high - low) / 2 * line_step(line, t).real
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
