"""Two pulleys and a timing belt: its length, centre distance, phases, teeth in mesh.

The belt's pitch line is two arcs and the straight lines that touch both. Frame: axis of the first pulley at the
origin, the second's on +x; a phase is the polar angle of a groove. Lengths in mm.
"""

from __future__ import annotations

import cmath
import math

import numpy as np

from geometry.base.findings import Finding
from geometry.base.record import Record
from geometry.base.roots import bracketed_root
from geometry.curves.curve import Complex
from geometry.gears.belts.pulley import Pulley

# of the smaller pulley that carry at least, by makers' handbooks
_LEAST_IN_MESH = 6
# mm: a belt that is longer by less is taut: what a distance rounded to hundredths of a millimetre leaves
_LOOSE = 0.01


class BeltDrive(Record):
    """Two pulleys whose pitch circles have these ``radii``, a ``distance`` apart."""

    radii: tuple[float, float]
    distance: float

    @property
    def normal(self) -> float:
        """Polar angle at which the upper strand leaves both pitch circles, rad."""
        return math.acos((self.radii[0] - self.radii[1]) / self.distance)

    @property
    def strand(self) -> float:
        """Length of a strand between both."""
        apart = self.radii[0] - self.radii[1]
        return math.sqrt((self.distance - apart) * (self.distance + apart))

    @property
    def wrap(self) -> float:
        """Angle of wrap on the smaller pulley, rad."""
        return 2 * min(self.normal, math.pi - self.normal)

    @property
    def length(self) -> float:
        """Of the taut belt."""
        first, second = self.radii
        return 2 * (self.strand + (math.pi - self.normal) * first + self.normal * second)

    def second_phase(self, first: float, pitch: float) -> float:
        """Phase of the second near 0, at one of the first near pi: whole pitches over the taut upper strand, rad."""
        (r1, r2), normal = self.radii, self.normal
        way = (first - normal) * r1 + self.strand
        # from the first's groove to where the second's polar angle is 0
        there = way + normal * r2
        return (there - pitch * round(there / pitch)) / r2

    def teeth(self, first: float, pitch: float, count: int) -> Complex:
        """Places (count,) of the belt's teeth on its pitch line, clockwise from the first's groove at its phase."""
        (r1, r2), normal, strand = self.radii, self.normal, self.strand
        ways = (np.arange(count) * pitch + (normal - first) * r1) % self.length
        on_second, on_first = 2 * normal * r2, 2 * (math.pi - normal) * r1
        upper, lower = cmath.rect(1.0, normal), cmath.rect(1.0, -normal)
        along = -1j * upper, -1j * lower
        ends = r1 * upper, self.distance + r2 * lower
        turned = self.distance + r2 * upper * np.exp(-1j * (ways - strand) / r2)
        back = ways - 2 * strand - on_second
        found: Complex = np.select(
            [ways < strand, ways < strand + on_second, back < 0],
            [ends[0] + along[0] * ways, turned, ends[1] + along[1] * (ways - strand - on_second)],
            r1 * lower * np.exp(-1j * np.minimum(back, on_first) / r1),
        )
        return found


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
    """Two pulleys and their belt of ``belt_teeth`` teeth."""

    pulleys: tuple[Pulley, Pulley]
    centre_distance: float
    belt_teeth: int

    @property
    def pitch(self) -> float:
        """Of the belt."""
        return self.pulleys[0].belt.pitch

    @property
    def drive(self) -> BeltDrive:
        """Of the pitch circles."""
        return BeltDrive((self.pulleys[0].pitch_radius, self.pulleys[1].pitch_radius), self.centre_distance)

    @property
    def slack(self) -> float:
        """By how much the belt is longer than the taut one."""
        return self.belt_teeth * self.pitch - self.drive.length

    @property
    def in_mesh(self) -> float:
        """Teeth of the smaller pulley within the angle of wrap."""
        return self.drive.wrap / (2 * math.pi) * min(p.number_of_teeth for p in self.pulleys)

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
