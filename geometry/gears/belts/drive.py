"""Two pulleys, any idlers and a timing belt: its length, centre distance, phases, teeth in mesh.

The belt's pitch line is arcs and the straight lines that touch them. Frame: axis of the first pulley at the
origin, the second's on +x; a phase is the polar angle of a groove. Lengths in mm.
"""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np

from geometry.base.findings import Finding
from geometry.base.record import Record
from geometry.base.roots import bracketed_root
from geometry.curves.curve import Complex
from geometry.gears.belts.pulley import Pulley
from geometry.plane.loop import DriveLoop, Wheel, about_two

# of the smaller pulley that carry at least, by makers' handbooks
_LEAST_IN_MESH = 6
# mm: a belt that is longer by less is taut: what a distance rounded to hundredths of a millimetre leaves
_LOOSE = 0.01


class BeltDrive(Record, dict=True):
    """Two pulleys whose pitch circles have these ``radii``, a ``distance`` apart, and ``idlers`` in their frame."""

    radii: tuple[float, float]
    distance: float
    idlers: tuple[Wheel, ...] = ()

    @cached_property
    def loop(self) -> DriveLoop:
        """The belt's pitch line, the first pulley first."""
        return about_two(self.radii, self.distance, self.idlers)

    @property
    def length(self) -> float:
        """Of the taut belt."""
        return self.loop.length

    def second_phase(self, first: float, pitch: float) -> float:
        """Phase of the second near 0, at one of the first near pi: whole pitches over the taut upper strand, rad."""
        # from the first's groove to where the second's polar angle is 0
        there = self.loop.way(self.loop.second, 0.0) - self.loop.way(0, first) + self.length
        return (there - pitch * round(there / pitch)) / self.radii[1]

    def teeth(self, first: float, pitch: float, count: int) -> Complex:
        """Places (count,) of the belt's teeth on its pitch line, clockwise from the first's groove at its phase."""
        return self.loop.places(self.loop.way(0, first) + pitch * np.arange(count, dtype=float))


def exact_distance(radii: tuple[float, float], length: float, least: float) -> float | None:
    """The distance at which a belt of a length is taut; None: below ``least``."""
    if BeltDrive(radii, least).length > length:
        return None
    return bracketed_root(lambda distance: BeltDrive(radii, distance).length - length, least, least + length).value


def textbook_length(radii: tuple[float, float], distance: float) -> float:
    """L = 2 a + pi (d1 + d2) / 2 + (d2 - d1)^2 / 4 a."""
    return 2 * distance + math.pi * sum(radii) + (radii[1] - radii[0]) ** 2 / distance


def textbook_distance(radii: tuple[float, float], length: float) -> float | None:
    """a = (b + sqrt(b^2 - 8 (d2 - d1)^2)) / 8 with b = 2 L - pi (d1 + d2); None: there is none."""
    free, apart = 2 * (length - math.pi * sum(radii)), 2 * (radii[1] - radii[0])
    under = free**2 - 8 * apart**2
    return (free + math.sqrt(under)) / 8 if free > 0 and under >= 0 else None


class BeltMesh(Record):
    """Two pulleys and their belt of ``belt_teeth`` teeth, about ``idlers`` too."""

    pulleys: tuple[Pulley, Pulley]
    centre_distance: float
    belt_teeth: int
    idlers: tuple[Wheel, ...] = ()

    @property
    def pitch(self) -> float:
        """Of the belt."""
        return self.pulleys[0].belt.pitch

    @property
    def drive(self) -> BeltDrive:
        """Of the pitch circles."""
        return BeltDrive(
            (self.pulleys[0].pitch_radius, self.pulleys[1].pitch_radius), self.centre_distance, self.idlers
        )

    @property
    def slack(self) -> float:
        """By how much the belt is longer than the taut one."""
        return self.belt_teeth * self.pitch - self.drive.length

    @property
    def in_mesh(self) -> float:
        """Teeth within the angle of wrap, of the pulley that has fewer of them."""
        wrapped = zip(self.pulleys, self.drive.loop.both_wraps, strict=True)
        return min(p.number_of_teeth * wrap / (2 * math.pi) for p, wrap in wrapped)

    @property
    def taut_idler(self) -> complex | None:
        """Where the last idler makes the belt taut, straight on from where it stands; None: nowhere."""
        loop = self.drive.loop
        wheel = loop.wheels.index(self.idlers[-1])
        taut = loop.tightened(wheel, self.belt_teeth * self.pitch)
        return None if taut is None else taut.wheels[wheel].centre

    @property
    def rim_gap(self) -> float:
        """Between the pulleys, flanges and all."""
        return self.centre_distance - sum(p.reach for p in self.pulleys)

    def findings(self) -> tuple[Finding, ...]:
        """A belt that is not taut, few teeth that carry."""
        found = []
        if self.slack > _LOOSE:
            found.append(Finding("belt_hangs_loose", self.slack, 0.0))
        if self.in_mesh < _LEAST_IN_MESH:
            found.append(Finding("few_belt_teeth_in_mesh", self.in_mesh, _LEAST_IN_MESH))
        return tuple(found)
