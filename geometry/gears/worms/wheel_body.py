"""The solid of a worm wheel: the teeth about a core of plane faces, bore, holes, hub and web.

The core is a body whose rim is a circle; its wall is left out, and the teeth stand between its two ends instead.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property, partial
from typing import ClassVar, Literal

import numpy as np

from geometry.base.record import Record
from geometry.curves.curve import Real
from geometry.gears.worms.hob import Cut
from geometry.gears.worms.wheel import Side, WormTeeth
from geometry.plane.measure import distance_to_profile, gauss_rule
from geometry.plane.profile import Profile
from geometry.solids.body import Body
from geometry.solids.mass import Moments, body_moments

# Gauss's rule along each part of a side and over the heights of each band
_ALONG, _ACROSS = 32, 32
# heights and shares from which the foot of a perpendicular is sought, its steps, the step of derivatives, and how far
# beyond the ends of a part it may lie, as shares of it
_LEVELS, _SHARES, _STEPS, _SHIFT, _BEYOND = 65, 17, 8, 1e-5, 0.02


class Surface(Record):
    """A surface in which faces lie, with what tells how far points (n, 3) are from it, mm."""

    what: str
    distance: Callable[[Real], Real]


class WormWheelBody(Record, dict=True):
    """Teeth about a core whose rim is its profile ``rim``; lower face of the rim at z = 0."""

    teeth: WormTeeth
    core: Body
    rim: Profile
    is_faced: ClassVar[Literal[True]] = True

    @property
    def middle(self) -> float:
        """Height of the mid plane, mm."""
        return self.teeth.width / 2

    @property
    def profiles(self) -> tuple[Profile, ...]:
        """Those of the core."""
        return self.core.profiles

    @property
    def walls(self) -> tuple[()]:
        """None that a plane outline sweeps."""
        return ()

    def levels(self) -> tuple[float, ...]:
        """Heights of all plane faces, ascending, mm."""
        return self.core.levels()

    def section_reach(self) -> float:
        """Greatest distance from the axis, mm."""
        return float(self.teeth.tip_radius(self.middle))

    def reach(self) -> float:
        """Greatest coordinate, mm."""
        return max(self.section_reach(), *map(abs, self.levels()))

    def steepness(self) -> float:
        """1: a step along the axis moves a wall by no more than itself."""
        return 1.0

    def has_screws(self) -> bool:
        """Whether there are walls of the kind of helical teeth: never."""
        return False

    @property
    def wall_width(self) -> float:
        """What the volume of a sliver along a wall goes by, mm."""
        return float(self.teeth.tip_radius(0.0)) - float(self.teeth.root_radius(0.0))

    def volume(self) -> float:
        """Exact, mm^3."""
        return self.moments().volume

    def moments(self) -> Moments:
        """Volume, centre and inertia: the core's, and Green's theorem on the teeth's sections by Gauss's rule.

        Three teeth or more have their centre on the axis, half a turn about a tooth's middle puts it in the mid plane.
        """
        teeth, core = self.teeth, body_moments(self.core)
        nodes, weights = gauss_rule(_ACROSS)
        area = polar = upright = 0.0
        for low, high in zip(teeth.breaks, teeth.breaks[1:], strict=False):
            z = (low + high) / 2 + (high - low) / 2 * nodes
            own, second = self._sections(z)
            share = weights * (high - low) / 2
            area += float(share @ own)
            polar += float(share @ second)
            upright += float(share @ (own * (z + self.middle) ** 2))
        radius, width = self.rim.reach(), teeth.width
        disk = math.pi * radius**2
        area -= disk * width
        polar -= disk * radius**2 / 2 * width
        upright -= disk * width**3 / 3
        volume = core.volume + area
        centre = (core.volume * core.centre + area * np.array([0.0, 0.0, self.middle])) / volume
        side = polar / 2 + upright
        return Moments(volume, centre, core.inertia + np.diag([side, side, polar]))

    def _sections(self, heights: Real) -> tuple[Real, Real]:
        """Areas and polar moments of the teeth's sections down to the axis, each (n,)."""
        teeth, count = self.teeth, self.teeth.number_of_teeth
        area, polar = np.zeros(len(heights)), np.zeros(len(heights))
        nodes, weights = gauss_rule(_ALONG)
        steps = _derivatives(nodes)
        ends = []
        for z in (heights, -heights):
            side = teeth.side(z)
            for part in (teeth.fillet, teeth.flank):
                plane = part(side, (nodes[:, None] + 1) / 2).plane
                # the lower side runs ahead, the upper one, half a turn on, back: both add up
                cross = (np.conj(plane) * (steps @ plane)).imag * weights[:, None]
                area += cross.sum(axis=0) / 2
                polar += (np.abs(plane) ** 2 * cross).sum(axis=0) / 4
            ends.append((np.angle(teeth.fillet(side, 0.0).plane), np.angle(teeth.flank(side, 1.0).plane)))
        (root, tip), (other_root, other_tip) = ends
        for radius, turn in (
            (teeth.tip_radius(heights), -tip - other_tip),
            (teeth.root_radius(heights), 2 * math.pi / count + root + other_root),
        ):
            area += radius**2 * turn / 2
            polar += radius**4 * turn / 4
        return count * area, count * polar

    def surfaces(self) -> list[Surface]:
        """The surfaces in which its faces lie."""
        teeth = self.teeth
        found = [
            Surface("flank", partial(self._from_side, teeth.flank)),
            Surface("fillet", partial(self._from_side, teeth.fillet)),
            Surface("root", self._from_root),
        ]
        if teeth.throat_height > 0:
            found.append(Surface("throat", partial(self._from_torus, teeth.throat_radius)))
        if teeth.throat_height < teeth.width / 2:
            found.append(Surface("rim", lambda points: np.abs(_radii(points) - teeth.outer_radius)))
        found += [Surface("plane face", partial(_from_level, z)) for z in self.levels()]
        found += [
            Surface("wall", partial(_from_wall, profile)) for profile in self.core.profiles if profile is not self.rim
        ]
        return found

    def distance(self, face: Surface, points: Real) -> Real:
        """Of points (n, 3) from a surface, mm; of flanks and fillets also beyond their ends."""
        return face.distance(points)

    def _from_torus(self, tube: float, points: Real) -> Real:
        return np.asarray(
            np.abs(np.hypot(_radii(points) - self.teeth.centre_distance, points[:, 2] - self.middle) - tube)
        )

    def _from_root(self, points: Real) -> Real:
        radius = _radii(points)
        near = np.abs(points[:, 2] - self.middle) <= self.middle * (1 + _BEYOND)
        heights = np.where(near, points[:, 2] - self.middle, 0.0)
        return np.where(near, np.abs(radius - self.teeth.root_radius(heights)), np.inf)

    @cached_property
    def _lean(self) -> tuple[Real, Real]:
        """Heights and the angles of the middle of tooth 1 there, rad."""
        z = np.linspace(-self.middle, self.middle, _LEVELS)
        lower, upper = (np.angle(self.teeth.flank(self.teeth.side(h), 0.5).plane) for h in (z, -z))
        return z, (lower - upper) / 2

    def _from_side(self, part: Callable[[Side, Real | float], Cut], points: Real) -> Real:
        """Of points from the flanks or fillets of all teeth: each is turned onto the lower side of tooth 1."""
        height = np.clip(points[:, 2] - self.middle, -self.middle, self.middle)
        plane = points[:, 0] + 1j * points[:, 1]
        lean = np.interp(height, *self._lean)
        pitch = 2 * math.pi / self.teeth.number_of_teeth
        plane = plane * np.exp(-1j * pitch * np.round((np.angle(plane) - lean) / pitch))
        upper = np.angle(plane * np.exp(-1j * lean)) > 0
        plane, height = np.where(upper, np.conj(plane), plane), np.where(upper, -height, height)
        away = np.empty(len(plane))
        # few heights are many points' own: their sides are found once
        own, back = np.unique(np.round(height, 12), return_inverse=True)
        side = self.teeth.side(own)
        side = Side(height, side.inner[back], side.normal[back], side.outer[back], side.undercut[back])
        reach = np.abs(plane)
        shares = np.linspace(0.0, 1.0, _SHARES)
        table = np.abs(part(side, shares[:, None]).plane)
        at = np.clip((table < reach).sum(axis=0), 1, _SHARES - 1)
        row = np.arange(len(reach))
        before, after = table[at - 1, row], table[at, row]
        share = (at - 1 + np.clip((reach - before) / (after - before), 0.0, 1.0)) / (_SHARES - 1)
        for _ in range(_STEPS):
            here = part(side, share).plane
            way = (part(side, share + _SHIFT).plane - here) / _SHIFT
            step = (np.conj(way) * (plane - here)).real / np.abs(way) ** 2
            share = np.clip(share + step, -_BEYOND, 1 + _BEYOND)
        cut = part(side, share)
        off = plane - cut.plane
        across = (np.conj(cut.normal) * off).real
        along = np.abs((np.conj(cut.normal) * off).imag) / np.abs(cut.normal)
        away = np.hypot(across, np.where((share <= -_BEYOND) | (share >= 1 + _BEYOND), along, 0.0))
        return np.hypot(away, np.abs(points[:, 2] - self.middle) - np.abs(height))


def _radii(points: Real) -> Real:
    return np.hypot(points[:, 0], points[:, 1])


def _from_level(z: float, points: Real) -> Real:
    return np.abs(points[:, 2] - z)


def _from_wall(profile: Profile, points: Real) -> Real:
    return np.asarray(distance_to_profile(points[:, 0] + 1j * points[:, 1], profile, trusted=np.inf))


def _derivatives(nodes: Real) -> Real:
    """What values at nodes are multiplied by for the derivatives there of the polynomial through them."""
    apart = nodes[:, None] - nodes + np.eye(len(nodes))
    weights = 1 / apart.prod(axis=1)
    matrix = weights / weights[:, None] / apart
    np.fill_diagonal(matrix, 0.0)
    np.fill_diagonal(matrix, -matrix.sum(axis=1))
    return matrix
