"""The solid of a worm: a thread between two ends, shaft steps beyond them, a bore.

The middle of the thread lies at z = 0. At both ends a cone about the axis cuts the thread: it begins on the root
cylinder at the end of the threaded length and widens inwards over the whole depth of the thread; at ``end_angle`` 0 it
is a plane.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Literal

import numpy as np

from geometry.base.errors import ParameterError
from geometry.base.gauss import panels
from geometry.base.record import Record
from geometry.curves.curve import Real
from geometry.gears.worms.band import CLEAR, Band
from geometry.gears.worms.thread import FlankLine, SectionLine, Thread, line_offset, line_step
from geometry.plane.profile import Label, Profile, circle
from geometry.solids.mass import Moments, column_integrals, moments_of, section_moments

# Gauss's rule on each line of the axial section
_POINTS = 40
# what is one radius or one height, mm
_SAME = 1e-9
# places on a line at which the ends of a thread are looked at
_SAMPLES = 65
# axial pitches of the longest thread, whose STEP has some 120 MB
_MOST_PITCHES = 1000


Ends = Literal["cut", "blunt", "run_out"]


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
        off, normal = line_offset(self.line, radius + 1j * away)
        least = worm.flank.least_radius if isinstance(self.line, FlankLine) else 0.0
        below = np.maximum(least - radius, 0.0)
        # the screw leans what stands across the axial section
        lean = normal.imag * worm.parameter / np.maximum(radius, _SAME)
        return np.asarray(np.hypot(np.abs(off) / np.hypot(1.0, lean), below))

    def _height(self, radius: Real) -> Real:
        """z of the line near a radius, mm."""
        low, high = (complex(self.line.point(t)) for t in self.line.domain)
        share = np.clip((radius - low.real) / (high.real - low.real), 0.0, 1.0)
        return np.asarray(low.imag + share * (high.imag - low.imag))


class WormBody(Record):
    """A worm as a solid; ``length`` of the thread at its root, mm, ``end_angle`` of the cone from the end plane, rad.

    ``ending``: cut by those cones; blunt, where an axial plane cuts off all that is no whole thread; or the tool leaves
    its spaces within ``run_out`` rad, from ``length`` between the middles of theirs on, into a cylinder of the tips.
    ``below`` and ``above``: steps of the shaft from the thread outwards; ``bore``: its profile, clockwise.
    """

    thread: Thread
    length: float
    end_angle: float = 0.0
    below: tuple[Step, ...] = ()
    above: tuple[Step, ...] = ()
    bore: Profile | None = None
    ending: Ends = "cut"
    run_out: float = 0.0

    @property
    def band(self) -> Band | None:
        """The threads between axial planes, or the spaces out of which the tool leaves; none that a cone cuts."""
        p = self.thread.worm.parameter
        if self.ending == "cut":
            return None
        if self.ending == "blunt":
            return Band(self.thread, 1, (self.length - self.lost / 2) / 2 / p)
        return Band(self.thread, -1, self.length / 2 / p, self.run_out)

    @property
    def start(self) -> tuple[float, float]:
        """Half the length of the cylinder that ends in the shaft, and its radius, mm."""
        band = self.band
        return (self.length / 2, self.root_radius) if band is None else (band.height(), band.radius)

    @property
    def lost(self) -> float:
        """By how much the length between whole flanks falls short of ``length`` at the root, mm."""
        thread, module = self.thread, self.thread.worm.module
        if self.ending == "cut":
            return 0.0
        # a flank of a blunt thread ends as far within its end as the other one at its foot
        if self.ending == "blunt":
            return 4 * (thread.root_half + CLEAR * module)
        return math.pi * module - 2 * thread.tip_half

    @property
    def root_radius(self) -> float:
        """Of the worm, mm."""
        return self.thread.worm.root_radius

    def end_height(self, radius: Real | float) -> Real:
        """Height of the upper cone at a radius, mm; the lower end is its mirror image."""
        return np.asarray(self.length / 2 - (np.asarray(radius) - self.root_radius) * math.tan(self.end_angle))

    def outline(self, *, above: bool) -> list[tuple[float, float]]:
        """(z, r) of a shaft from the end of the thread's cylinder on, outwards, to its last edge, mm; or that end."""
        sign = 1.0 if above else -1.0
        z, radius = self.start
        found = [(sign * z, radius)]
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

    def envelope(self) -> list[tuple[float, float]]:
        """(z, r) of all corners from the lower end to the upper one, the thread whole up to its tips, mm."""
        below, above = self.outline(above=False)[::-1], self.outline(above=True)
        worm, thread = self.thread.worm, []
        if self.ending == "cut":
            thread = [(float(self.end_height(worm.tip_radius)), worm.tip_radius)]
        elif self.ending == "blunt":
            # the whole section as it stands where the thread is cut off
            foot = self.start[0] - CLEAR * worm.module
            thread = [(foot - self.thread.root_half + self.thread.tip_half, worm.tip_radius), (foot, worm.root_radius)]
        return [*below, *((-z, r) for z, r in reversed(thread)), *thread, *above]

    def root_line(self) -> list[tuple[float, float]]:
        """(z, r) of the corners of a line along the roots of the spaces, mm."""
        band, half = self.band, self.length / 2
        found = [(half, self.root_radius)]
        if band is not None and band.run_out:
            found.append((self.thread.worm.parameter * band.end, band.radius))
        return [*((-z, r) for z, r in reversed(found)), *found]

    def ends(self) -> tuple[float, float]:
        """Lowest and highest z, mm."""
        return self.outline(above=False)[-1][0], self.outline(above=True)[-1][0]

    def beside(self) -> list[tuple[str, float, float]]:
        """Where it is solid beside its whole thread: the key of each piece, how far off it begins, its radius, mm."""
        start, radius = self.start
        band, found = self.band, []
        if band is not None and band.run_out:
            found.append(("thread_length", (self.length - self.lost) / 2, radius))
        for key, steps in (("shaft_below", self.below), ("shaft_above", self.above)):
            away = start
            for number, step in enumerate(steps, 1):
                found.append((f"{key}[{number}].diameter", away, step.diameter / 2))
                away += step.length
        return found

    def checked(self) -> WormBody:
        """The solid itself, where it exists.

        Raises
        ------
        ParameterError
            The thread is too short for its ends, or so long that its faces fill the memory.
        """
        most = _MOST_PITCHES * math.pi * self.thread.worm.module
        if self.length > most:
            raise ParameterError.beyond("thread_length", self.length, "worm_thread_too_long", most, most=_MOST_PITCHES)
        least = self.least_length()
        if not self.length > least:
            raise ParameterError.beyond("thread_length", self.length, "worm_thread_too_short", least * (1 + 1e-9))
        return self

    def least_length(self) -> float:
        """Length at which the ends of all lines still leave a whole axial section between them, mm."""
        worm = self.thread.worm
        if self.ending != "cut":
            return self.lost * (1 + 1e-6)
        places = np.concatenate([line.point(np.linspace(*line.domain, _SAMPLES)) for _, line in self.thread.lines])
        away = np.abs(places.imag) + (places.real - worm.root_radius) * math.tan(self.end_angle)
        return 2 * float(away.max()) * (1 + 1e-6)


def worm_moments(body: WormBody) -> Moments:
    """Volume, centre and inertia: closed forms along the axis and around it, Gauss's rule over the radius.

    At a radius the thread spans a half angle a about the polar angle z / p, from one end to the other: the integrals of
    its powers of x, y and z are closed there, and analytic over each line of the axial section.
    """
    half, radius = body.start
    columns = [(circle(radius, Label.BODY), -half, half)]
    total = _cut_threads(body) if body.band is None else body.band.integrals()
    for above in (False, True):
        points = body.outline(above=above)
        for (z0, r0), (z1, r1) in pairwise(points):
            total += _cone(min(z0, z1), max(z0, z1), r0 if z0 < z1 else r1, r1 if z0 < z1 else r0)
    if body.bore is not None:
        columns.append((body.bore, *body.ends()))
    for profile, base, top in columns:
        total += column_integrals(section_moments(profile), base, top)
    return moments_of(total)


def _cut_threads(body: WormBody) -> Real:
    """The same integrals over threads between the cones."""
    worm = body.thread.worm
    n, p, sign = worm.number_of_starts, worm.parameter, worm.sign
    total = np.zeros(10)
    for _, line in body.thread.lines:
        t, weights = panels(np.array(line.domain), _POINTS)
        place = line.point(t)
        end = np.asarray(body.end_height(place.real), float)
        total += _rings(place.real, place.imag / p, end, n, p, sign) @ (weights * line_step(line, t).real)
    return total


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
    z, w = panels(np.array([low, high]), 4)
    r = lower + (upper - lower) * (z - low) / (high - low) if high > low else np.zeros(4)
    v, vz, vzz, polar = (math.pi * float(np.sum(w * f)) for f in (r**2, r**2 * z, r**2 * z * z, r**4 / 4))
    return np.array([v, 0.0, 0.0, vz, polar, polar, 0.0, vzz, 0.0, 0.0])
