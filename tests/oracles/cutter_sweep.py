"""Brute-force oracle of what a pinion cutter leaves: sweep its tooth, measure how deep a point lies in it.

Nothing here knows an envelope. The tool is one tooth of the cutter, whose signed distance is elementary: an involute
(a taut string), a rounding about a centre found by bisection, a tip circle. The work is what is left when the tool has
taken every rolling position.

Frames. Work frame: axis at 0, the space that the tooth cuts centred on +x at rolling angle 0. ``teeth`` of the work is
negative for an external gear. The cutter's axis stands at ``distance`` from the work's, its tooth points away from the
axis of a ring (towards +x) and towards the axis of an external gear (towards -x).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Points = NDArray[np.complex128]
_GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0
GRID, STEPS, CHUNK = 769, 82, 1024


@dataclass(frozen=True)
class CutterTool:
    """One tooth of a pinion cutter; lengths in mm, alpha in rad, ha, x, rho in modules, widening in mm a side."""

    m: float
    z: int
    alpha: float
    x: float
    ha: float
    rho: float
    widening: float = 0.0

    @cached_property
    def base(self) -> float:
        """Base radius."""
        return self.m * self.z / 2 * math.cos(self.alpha)

    @cached_property
    def tip(self) -> float:
        """Tip radius."""
        return self.m * (self.z / 2 + self.x + self.ha)

    @cached_property
    def half(self) -> float:
        """Half of the tooth's angle on the base circle, rad."""
        thickness = self.m * (math.pi / 2 + 2 * self.x * math.tan(self.alpha)) + 2 * self.widening
        return thickness / (self.m * self.z) + math.tan(self.alpha) - self.alpha

    def beside_flank(self, p: Points) -> Floats:
        """Distance of points in the lower half plane from the lower flank, positive outside the tooth, mm."""
        radius = np.abs(p)
        string = np.sqrt(np.maximum((radius - self.base) * (radius + self.base), 0.0))
        # where the string through p leaves the base circle, against where the flank's own string of that place ends
        leaves = np.angle(p) + np.arctan2(string, self.base)
        return string - self.base * (leaves + self.half)

    @cached_property
    def centre(self) -> complex:
        """Centre of the rounding, lower side: on the circle tip - rho, rho inside the flank; by bisection."""
        radius, rho = self.tip - self.rho * self.m, self.rho * self.m
        low, high = -math.pi / self.z, 0.2
        for _ in range(200):
            middle = (low + high) / 2
            inside = -float(self.beside_flank(np.array([radius * np.exp(1j * middle)]))[0])
            low, high = (low, middle) if inside > rho else (middle, high)
        return complex(radius * np.exp(1j * (low + high) / 2))

    def distance(self, p: Points) -> Floats:
        """Signed distance of points (n,) from the tooth, mm; exact near its outline above the base circle."""
        p = np.where(p.imag > 0, np.conj(p), p)
        flank = self.beside_flank(p)
        radius, rho = np.abs(p), self.rho * self.m
        string = np.sqrt(np.maximum((radius - self.base) * (radius + self.base), 0.0))
        centre = self.centre
        last = math.sqrt(abs(centre) ** 2 - self.base**2) + rho
        on_flank = string - flank <= last
        on_land = np.angle(p) >= np.angle(centre)
        return np.where(on_land, radius - self.tip, np.where(on_flank, flank, np.abs(p - centre) - rho))


def least_distance(points: Points, tool: CutterTool, teeth: int, distance: float, *, reach: float = 1.0) -> Floats:
    """Least signed distance (n,) of work points from the tool over all rolling positions, mm.

    ``teeth`` of the work, negative for an external gear; ``reach``: rad of the cutter's rotation either way. Scanned,
    then golden section beside the least. A point of the work's outline has 0, one inside the material more, one
    that the tool takes less.
    """
    result = np.empty(len(points))
    ratio = tool.z / teeth
    grid = np.linspace(-reach, reach, GRID)
    sense = 1.0 if teeth > 0 else -1.0

    def depth(p: Points, turn: Floats) -> Floats:
        local = sense * np.exp(-1j * turn) * (p * np.exp(1j * turn * ratio) - distance)
        shape = local.shape
        values = tool.distance(local.ravel()).reshape(shape)
        # beside the axis of the cutter, or a turn away, the tooth is not
        return np.where(np.abs(local) < tool.base * 0.999, np.inf, values)

    for start in range(0, len(points), CHUNK):
        p = points[start : start + CHUNK]
        values = depth(p[:, None], grid[None, :])
        best = np.argmin(values, axis=1)
        step = grid[1] - grid[0]
        low, high = grid[best] - step, grid[best] + step
        least = values[np.arange(len(p)), best]
        for _ in range(STEPS):
            a, b = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
            fa, fb = depth(p, a), depth(p, b)
            least = np.minimum(least, np.minimum(fa, fb))
            low, high = np.where(fa < fb, low, a), np.where(fa < fb, b, high)
        result[start : start + CHUNK] = least
    return result
