"""A worm wheel measured: its volume and inertia, and how far points lie from its flanks and fillets.

The wheel is teeth about a core: a body whose rim is a circle, which the teeth take the place of.
"""

from __future__ import annotations

import math
from functools import cached_property
from itertools import pairwise

import numpy as np

from geometry.base.gauss import gauss_rule, panels
from geometry.base.record import Record
from geometry.curves.curve import Complex, Indices, Real
from geometry.gears.worms.hob import Cut
from geometry.gears.worms.wheel import BEYOND, Side, WormTeeth
from geometry.plane.profile import Profile
from geometry.solids.body import Body
from geometry.solids.mass import Moments, body_moments

# Gauss's rule along each part of a side and over the heights of each band
_ALONG, _MOST_ALONG, _ACROSS = 32, 256, 32
# where these are enough, part of the integrals
_SETTLED = 1e-9
# heights of a band and shares from which the foot of a perpendicular is sought, its steps, the step of derivatives
_LEVELS, _SHARES, _STEPS, _SHIFT = 97, 129, 64, 1e-5
# how near along a side a foot is found, modules
_FOUND = 1e-6
# points that are looked at a time, and how near the border of flank and fillet both are looked at, modules
_BLOCK, _BESIDE = 8192, 0.1
# a way of no length, squared, mm^2
_NONE = 1e-30
# parts of a side
FILLET, FLANK = 0, 1


class WormWheel(Record, dict=True):
    """Teeth about a core whose rim is its profile ``rim``; lower face of the rim at z = 0."""

    teeth: WormTeeth
    core: Body
    rim: Profile

    @property
    def middle(self) -> float:
        """Height of the mid plane, mm."""
        return self.teeth.width / 2

    def moments(self) -> Moments:
        """Volume, centre and inertia: the core's, and Green's theorem on the teeth's sections by Gauss's rule.

        Three teeth or more have their centre on the axis, half a turn about a tooth's middle puts it in the mid plane.
        """
        teeth, core = self.teeth, body_moments(self.core)
        points = _ALONG
        found, finer = (self._integrals(count) for count in (points, 2 * points))
        # flanks whose contact runs far ask for more
        while np.abs(finer - found).max() > _SETTLED * np.abs(found).max() and points < _MOST_ALONG:
            points *= 2
            found, finer = finer, self._integrals(2 * points)
        area, polar, upright = found.tolist()
        radius, width = self.rim.reach(), teeth.width
        disk = math.pi * radius**2
        area -= disk * width
        polar -= disk * radius**2 / 2 * width
        upright -= disk * width**3 / 3
        volume = core.volume + area
        centre = (core.volume * core.centre + area * np.array([0.0, 0.0, self.middle])) / volume
        side = polar / 2 + upright
        return Moments(volume, centre, core.inertia + np.diag([side, side, polar]))

    def _integrals(self, points: int) -> Real:
        """Of the teeth's sections down to the axis over the heights: areas, polar moments, areas by squared heights."""
        z, weights = panels(np.array(self.teeth.breaks), _ACROSS)
        own, second = self._sections(z, points)
        return np.array([weights @ own, weights @ second, weights @ (own * (z + self.middle) ** 2)])

    def _sections(self, heights: Real, points: int) -> tuple[Real, Real]:
        """Areas and polar moments of the teeth's sections down to the axis, each (n,)."""
        teeth, count = self.teeth, self.teeth.number_of_teeth
        area, polar = np.zeros(len(heights)), np.zeros(len(heights))
        nodes, weights = gauss_rule(points)
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

    def from_root(self, points: Real) -> Real:
        """Of points (n, 3) from what the land of the hob's tip leaves, mm."""
        height = np.clip(points[:, 2] - self.middle, -self.middle, self.middle)
        radius = np.hypot(points[:, 0], points[:, 1])
        step = _SHIFT * self.middle
        slope = (self.teeth.root_radius(height + step) - self.teeth.root_radius(height - step)) / (2 * step)
        away = (radius - self.teeth.root_radius(height)) / np.hypot(1.0, slope)
        return np.hypot(away, points[:, 2] - self.middle - height)

    def from_sides(self, points: Real) -> Real:
        """Of points (n, 3) from flanks or fillets, whichever is nearer: one goes over into the other, mm."""
        height = np.clip(points[:, 2] - self.middle, -self.middle, self.middle)
        reach, away = np.hypot(points[:, 0], points[:, 1]), np.full(len(points), np.inf)
        ends = self._reaches[FILLET][0][1]
        borders = [np.interp(h, self._table.heights, ends) for h in (height, -height)]
        beside = _BESIDE * self.teeth.hob.worm.module
        owners = reach < np.maximum(*borders) + beside, reach > np.minimum(*borders) - beside
        for which, mine in zip((FILLET, FLANK), owners, strict=True):
            away[mine] = np.minimum(away[mine], self.from_side(which, points[mine]))
        return away

    def from_side(self, which: int, points: Real) -> Real:
        """Of points (n, 3) from the fillets (0) or flanks (1) of all teeth, mm, to first order in it.

        Each point is turned onto the lower side of tooth 1, and its foot sought in its plane across the axis.
        """
        return np.concatenate(
            [self._block(which, points[k : k + _BLOCK]) for k in range(0, max(len(points), 1), _BLOCK)]
        )

    def _block(self, which: int, points: Real) -> Real:
        table = self._table
        height = np.clip(points[:, 2] - self.middle, -self.middle, self.middle)
        plane = points[:, 0] + 1j * points[:, 1]
        pitch, reach = 2 * math.pi / self.teeth.number_of_teeth, np.abs(plane)
        # the side that is nearest on the same circle
        (share, lower), (other, upper) = (self._first(which, reach, h) for h in (height, -height))
        ahead, behind = (
            np.remainder(a + pitch / 2, pitch) - pitch / 2 for a in (np.angle(plane) - lower, np.angle(plane) + upper)
        )
        is_upper = np.abs(behind) < np.abs(ahead)
        plane = reach * np.exp(1j * np.where(is_upper, upper - behind, lower + ahead))
        share, height = np.where(is_upper, other, share), np.where(is_upper, -height, height)
        # where fillet and flank end need not be known well, but where they are
        inner, normal, outer, *hurry = (
            np.interp(height, table.heights, x) for x in (table.inner, table.normal, table.outer, *table.hurry)
        )
        none = np.zeros(len(height), dtype=bool)
        side = Side(height, inner, normal, outer, none, (hurry[0], hurry[1]), none)
        cut, left = self._foot(which, side, plane, share)
        off = (np.conj(cut.normal) * (plane - cut.plane)).real
        # beyond its ends a part has no foot
        along = np.where(np.abs(left) > self._found, left, 0.0)
        away = np.sqrt(off**2 + along**2 + (np.abs(points[:, 2] - self.middle) - np.abs(height)) ** 2)
        # where the fillet reaches the tip there is no flank
        return np.where((inner == outer) & (which == FLANK), np.inf, away)

    def _foot(self, which: int, side: Side, plane: Complex, share: Real) -> tuple[Cut, Real]:
        """Feet of points (n,), each in its plane, sought from shares of a part; how far along it each is off still, mm.

        Steps of the secant: where a side is about to fold a slope means little a step further on.
        """
        part, forwards = (self.teeth.fillet, self.teeth.flank)[which], self._forwards[which]
        cut = part(side, share)
        way = (part(side, share + _SHIFT).plane - cut.plane) / _SHIFT
        slope = np.maximum(np.abs(way), _NONE)

        def ahead(which: Indices, cut: Cut) -> Real:
            return forwards * (np.conj(cut.normal) * (plane[which] - cut.plane)).imag / np.abs(cut.normal)

        goes = np.arange(len(share))
        share, left = share.copy(), ahead(goes, cut)
        for _ in range(_STEPS):
            end = np.where(left[goes] > 0, 1 + BEYOND, -BEYOND)
            goes = goes[(np.abs(left[goes]) > self._found) & (share[goes] != end)]
            if not goes.size:
                break
            step = np.clip(left[goes] / slope[goes], -BEYOND, BEYOND)
            there = np.clip(share[goes] + step, -BEYOND, 1 + BEYOND)
            now = ahead(goes, part(side.only(goes), there))
            rise = (left[goes] - now) / (there - share[goes])
            slope[goes] = np.where(rise > 0, rise, slope[goes])
            share[goes], left[goes] = there, now
        return part(side, share), left

    @cached_property
    def _forwards(self) -> tuple[float, ...]:
        """Of fillet and flank: 1 where outwards along it is to the left of its normal, -1 where it is to the right.

        A part never turns back, but where it all but stands still its own way there is rounding.
        """
        side, ends = self.teeth.side(0.0), np.linspace(0.0, 1.0, 3)[:, None]
        parts = (part(side, ends) for part in (self.teeth.fillet, self.teeth.flank))
        turned = ((np.conj(cut.normal[1]) * (cut.plane[2] - cut.plane[0])).imag for cut in parts)
        return tuple(float(np.sign(x[0])) for x in turned)

    @property
    def _found(self) -> float:
        """As near along a side a foot is found, mm: its distance errs by the square of that."""
        return _FOUND * self.teeth.hob.worm.module

    @cached_property
    def _table(self) -> Side:
        """The lower side at heights that are dense in every band, and more so at its ends: there flanks vanish."""
        shares = (1 - np.cos(np.linspace(0.0, math.pi, _LEVELS))) / 2
        bands = [low + (high - low) * shares for low, high in pairwise(self.teeth.breaks)]
        return self.teeth.side(np.unique(np.concatenate(bands)))

    @cached_property
    def _reaches(self) -> tuple[tuple[Real, Real], ...]:
        """Of fillet and flank: radii of both ends at the heights of the table, mm; shares and angles of even steps."""
        found = []
        even = np.linspace(0.0, 1.0, _SHARES)
        for part in (self.teeth.fillet, self.teeth.flank):
            plane = part(self._table, even[:, None]).plane
            reach, turn = np.abs(plane), np.angle(plane)
            ends = reach[[0, -1]]
            with np.errstate(divide="ignore", invalid="ignore"):
                # a flank that is one point has any share
                steps = np.where(ends[1] > ends[0], (reach - ends[0]) / (ends[1] - ends[0]), even[:, None])
            shares = np.stack([np.interp(even, column, even) for column in steps.T], axis=1)
            turns = np.stack(
                [np.interp(share, even, column) for share, column in zip(shares.T, turn.T, strict=True)], axis=1
            )
            found.append((ends, np.stack([shares, turns])))
        return tuple(found)

    def _first(self, which: int, reach: Real, height: Real) -> Real:
        """About which share of a lower part stands at a radius and a height, and its angle: linear both ways."""
        ends, table = self._reaches[which]
        heights = self._table.heights
        column = np.clip(np.searchsorted(heights, height) - 1, 0, len(heights) - 2)
        across = (height - heights[column]) / (heights[column + 1] - heights[column])
        low, high = (ends[k][column] * (1 - across) + ends[k][column + 1] * across for k in (0, 1))
        with np.errstate(divide="ignore", invalid="ignore"):
            # where a part has no width any share is its
            place = np.nan_to_num(np.clip((reach - low) / (high - low), 0.0, 1.0)) * (_SHARES - 1)
        row = np.minimum(place.astype(np.intp), _SHARES - 2)
        up = place - row
        found = [table[:, row, c] * (1 - up) + table[:, row + 1, c] * up for c in (column, column + 1)]
        return np.asarray(found[0] * (1 - across) + found[1] * across)


def _derivatives(nodes: Real) -> Real:
    """What values at nodes are multiplied by for the derivatives there of the polynomial through them."""
    apart = nodes[:, None] - nodes + np.eye(len(nodes))
    weights = 1 / apart.prod(axis=1)
    matrix = weights / weights[:, None] / apart
    np.fill_diagonal(matrix, 0.0)
    np.fill_diagonal(matrix, -matrix.sum(axis=1))
    return matrix
