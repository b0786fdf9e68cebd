"""Threads that end in axial planes, and spaces out of which the tool leaves: bands of the screw on a cylinder.

A blunt thread is a ridge on the root cylinder: at both ends an axial plane cuts off all that is no whole thread. Where
the tool leaves, each space is a groove in the tip cylinder: from its end on the tool goes outwards evenly with the
angle, so that its section, as it stands, is lifted, and line after line of it leaves the cylinder.

The angle of a band is that about the axis for its middle's height, z = p s; groove j lies above thread j, at the polar
angle s - pi / n.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.gauss import gauss_rule
from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from geometry.gears.worms.thread import SectionLine, Thread, line_offset, line_step

# Gauss's rule on each line, and over the angle of each cell
_ALONG, _AROUND = 40, 24
# of the cylinder beyond ridges and grooves, modules
CLEAR, _BEYOND = 0.1, 0.5
_SAMPLES = 65


class Cell(Record, eq=False):
    """A piece of every band between two axial planes at angles ``low`` and ``high``, rad.

    ``last``: the number of the last line of the section that it has, which runs on to its parameter ``ends`` at the
    lower and the upper plane; ``alike``: cells that the screw carries into it, itself included, each ``step`` rad on.
    """

    low: float
    high: float
    last: int
    ends: tuple[float, float]
    alike: int = 1
    step: float = 0.0


class Band(Record):
    """Ridges (``kind`` 1) or grooves (-1) of ``thread``, whole for ``half`` rad to both sides of the middle.

    ``run_out``: rad in which a groove's tool leaves; none of ridges.
    """

    thread: Thread
    kind: int
    half: float
    run_out: float = 0.0

    @property
    def lines(self) -> list[SectionLine]:
        """Of the axial section, from the root on."""
        return [line for _, line in self.thread.lines]

    @property
    def radius(self) -> float:
        """Of the cylinder on which the bands lie, mm."""
        worm = self.thread.worm
        return worm.root_radius if self.kind > 0 else worm.tip_radius

    @property
    def end(self) -> float:
        """Angle at which nothing is left of a band, rad."""
        return self.half + self.run_out

    @property
    def turned(self) -> float:
        """Polar angle of band 0 where its own is 0, rad."""
        return 0.0 if self.kind > 0 else -math.pi / self.thread.worm.number_of_starts

    @property
    def rate(self) -> float:
        """How fast the tool leaves, mm/rad; 0 of ridges."""
        worm = self.thread.worm
        return (worm.tip_radius - worm.root_radius) / self.run_out if self.run_out else 0.0

    def half_width(self, place: Complex) -> Real:
        """Of a band at places of the thread's section, axial, mm."""
        return place.imag if self.kind > 0 else math.pi * self.thread.worm.module / 2 - place.imag

    def places(self, side: int, place: Complex, angle: Real) -> tuple[Complex, Real]:
        """Points of band 0 of a right-hand worm in the plane, and heights, mm; both broadcast."""
        lifted = place.real + self.rate * np.maximum(np.abs(angle) - self.half, 0.0)
        rise = self.thread.worm.parameter * angle + side * self.half_width(place)
        return lifted * np.exp(1j * (angle + self.turned)), rise

    def exits(self) -> list[Cell]:
        """The cells of the upper end, in which the lines leave the cylinder, the last line first."""
        if not self.run_out:
            return []
        found = []
        for k in reversed(range(len(self.lines))):
            start, stop = self.lines[k].domain
            low, high = (float(self.leaving(k, t)) for t in (stop, start))
            found.append(Cell(low, high, k, (stop, start)))
        return found

    def leaving(self, number: int, t: ArrayLike) -> Real:
        """The angle at which the place t of a line leaves the cylinder, rad."""
        lifted = self.radius - self.lines[number].point(t).real
        return np.asarray(self.half + lifted / self.rate)

    def angles(self, cell: Cell, v: Real) -> tuple[Real, Real]:
        """Angles at shares of a cell, rad, and where its last line ends there."""
        ends = cell.ends[0] + (cell.ends[1] - cell.ends[0]) * v
        if cell.ends[0] == cell.ends[1]:
            return cell.low + (cell.high - cell.low) * v, ends
        way = self.leaving(cell.last, ends)
        return (way if cell.high > 0 else -way), ends

    def cells(self, step: float, rest: float) -> list[Cell]:
        """All cells from the lower end to the upper one: even steps about the middle, and what is left of them.

        ``rest``: what an uneven cell has at least, part of a step.
        """
        last = len(self.lines) - 1
        ends = (self.lines[-1].domain[1],) * 2
        count = max(0, math.floor(2 * (self.half / step - rest)))
        inner = count * step / 2
        even = [Cell(-inner, -inner + step, last, ends, count, step)] if count else []
        below, above = Cell(-self.half, -inner, last, ends), Cell(inner, self.half, last, ends)
        exits = self.exits()
        mirrored = [Cell(-c.high, -c.low, c.last, c.ends[::-1]) for c in reversed(exits)]
        return [*mirrored, below, *even, above, *exits]

    def height(self) -> float:
        """Half the length of the cylinder on which the bands lie, beyond which a shaft may be of any diameter, mm."""
        worm = self.thread.worm
        if self.kind > 0:
            return worm.parameter * self.half + self.thread.root_half + CLEAR * worm.module
        reach = max(
            float(self.places(1, line.point(np.linspace(*line.domain, _SAMPLES)),
                              self.leaving(k, np.linspace(*line.domain, _SAMPLES)))[1].max())
            for k, line in enumerate(self.lines)
        )  # fmt: skip
        return reach + _BEYOND * worm.module

    def integrals(self) -> Real:
        """Of 1, x, y, z, xx, yy, xy, zz, xz, yz over the material that all bands add to their cylinder, (10,)."""
        worm, total = self.thread.worm, np.zeros(10)
        nodes, weights = gauss_rule(_AROUND)
        share, along = (nodes + 1) / 2, (gauss_rule(_ALONG)[0] + 1) / 2
        starts = math.tau * np.arange(worm.number_of_starts) / worm.number_of_starts
        for cell in self.cells(math.pi / 2, 0.0):
            angle, ends = self.angles(cell, share)
            # by how much the angle goes on for a share
            way = np.full_like(share, cell.high - cell.low)
            if cell.ends[0] != cell.ends[1]:
                fall = line_step(self.lines[cell.last], ends).real * (cell.ends[1] - cell.ends[0])
                way = -fall / self.rate * math.copysign(1.0, cell.high)
            for k in range(cell.last + 1):
                line, (low, high) = self.lines[k], self.lines[k].domain
                stop = ends if k == cell.last else np.full_like(ends, high)
                t = low + (stop - low) * along[:, None]
                place = line.point(t)
                step = line_step(line, t).real * (stop - low)
                for turn in range(cell.alike):
                    here = angle + turn * cell.step
                    plane, _ = self.places(1, place, here)
                    half, middle = self.half_width(place), worm.parameter * here
                    weight = gauss_rule(_ALONG)[1][:, None] / 2 * step * weights / 2 * way * np.abs(plane)
                    level = (2 * half, 2 * half * middle, 2 * half * (middle**2 + half**2 / 3))
                    for start in starts.tolist():
                        spun = plane * np.exp(1j * start)
                        x, y = spun.real, worm.sign * spun.imag
                        one, z, zz = level
                        terms = (one, one * x, one * y, z, one * x * x, one * y * y, one * x * y, zz, z * x, z * y)
                        total += [float((weight * term).sum()) for term in terms]
        return self.kind * total


class Lifted(Record):
    """What the tool leaves at one end (1 or -1) of all grooves."""

    band: Band
    end: int

    def distance(self, points: Real) -> Real:
        """Of points (n, 3), mm, to first order in it, by the axial section that stands lifted at their angle."""
        band, worm = self.band, self.band.thread.worm
        radius, z = np.hypot(points[:, 0], points[:, 1]), points[:, 2]
        pitch = math.tau / worm.number_of_starts
        angle = worm.sign * np.arctan2(points[:, 1], points[:, 0]) - band.turned
        angle = angle + pitch * np.round((z - worm.parameter * angle) / (worm.parameter * pitch))
        above = z - worm.parameter * angle
        own = radius - band.rate * (self.end * angle - band.half)
        width = math.pi * worm.module / 2
        place = own + 1j * (width - np.abs(above))
        # the root between both sides, then line by line
        away = np.abs(own - worm.root_radius) / np.hypot(1.0, band.rate / radius)
        joints = [line.point(line.domain[0]).real.item() for line in band.lines[1:]]
        number = np.searchsorted(joints, own)
        beside = np.abs(above) > width - band.thread.root_half
        for k, line in enumerate(band.lines):
            mine = beside & (number == k)
            off, normal = line_offset(line, place[mine])
            # tangent of the section outwards, and the way of the tool
            side = np.sign(above[mine])
            out, rise = normal.imag, side * normal.real
            lean = rise * self.end * band.rate - out * worm.parameter
            away[mine] = np.abs(off) / np.hypot(1.0, lean / radius[mine])
        return np.asarray(away)
