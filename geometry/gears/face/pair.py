"""A face gear and its spur pinion: what both are together, and the gap between them over a pitch of motion.

The pinion's axis stands at right angles to the gear's and meets it, ``mounting_distance`` above the lower face. Planes
across the pinion's axis have a pressure angle each; in them both touch as the gear and its shaper do. Flanks that a
shaper of more teeth has crowned touch in the gear's plane of contact alone.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property

import numpy as np

from geometry.base.angles import tangent_length
from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_roots
from geometry.base.tolerance import CONTACT_TOLERANCE
from geometry.curves.curve import Complex, Real
from geometry.gears.face.gear import FILLET, FLANK, FaceGear, Places, form_length
from geometry.gears.face.walls import side_off
from geometry.gears.mesh.search import PairContact, flanks_contact, gear_outline
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import ToothSide, tooth_side
from geometry.plane.distance import Boundary, folded
from geometry.plane.profile import Label
from geometry.solids.faces import Index
from geometry.solids.wheel import Hub

# drive angles in a pitch; planes; places along a curve; teeth to each side; radii of a ratio
_DRIVE_ANGLES, _PLANES, _PLACES, _TEETH, _ALONG = 24, 9, 9, 2, 129
# how near to where both touch a plane stands, rad or mm: it tells which plane, not where they touch in it
_NEAR = 1e-7


# of a flank where its gap is told
_SHARES = np.linspace(0.0, 1.0, 33)


def _root(function: Callable[[Real, Index], Real], count: int) -> Real:
    """Shares of flanks (count,) at which a falling function of shares and numbers is 0, or the end nearer to it."""
    every = np.arange(count)
    first, last = function(np.zeros(count), every), function(np.ones(count), every)
    share = np.where(first <= 0, 0.0, 1.0)
    rows = np.flatnonzero((first > 0) & (last < 0))
    ends = np.zeros(len(rows)), np.ones(len(rows)), first[rows], last[rows]
    share[rows] = bracketed_roots(lambda own: function(own, rows), *ends, enough=_NEAR)
    return share


class FacePair(Record, dict=True):
    """A face gear and its pinion, whose face lies from ``low`` to ``high`` mm off the gear's axis, its hub beside."""

    gear: FaceGear
    pinion: SpurGear
    low: float
    high: float
    pinion_hub: Hub | None = None

    @property
    def ratio(self) -> float:
        """u, turns of the pinion for one of the gear."""
        return self.gear.number_of_teeth / self.pinion.number_of_teeth

    @property
    def normal_backlash(self) -> float:
        """j_bn along the line of action, alike in all planes, mm."""
        thinning = self.gear.circumferential_thinning + self.pinion.circumferential_thinning
        return thinning * math.cos(self.pinion.pressure_angle)

    @property
    def bottom_clearances(self) -> tuple[float, float]:
        """Between the gear's root and the pinion's tip, the pinion's root and the gear's tip, mm."""
        gear, axis = self.gear, self.gear.mounting_distance
        return axis - gear.thickness - self.pinion.tip_radius, axis - gear.height - self.pinion.root_radius

    @property
    def hub_clearance(self) -> float:
        """Between the hub that stands out of the gear's plate and the pinion with its own, mm; infinite without one."""
        gear, hub = self.gear, self.gear.hub
        if hub is None or not hub.above:
            return math.inf
        ends = [(self.low, self.pinion.tip_radius)]
        if self.pinion_hub is not None:
            # z leads to the gear's axis
            ends.append((self.low - self.pinion_hub.above, self.pinion_hub.diameter / 2))
        steps = [(begins - hub.diameter / 2, gear.mounting_distance - radius - gear.thickness - hub.above)
                 for begins, radius in ends]  # fmt: skip
        return min(math.hypot(*step) if min(step) > 0 else max(step) for step in steps)

    @cached_property
    def side(self) -> ToothSide:
        """The pinion's tooth."""
        return tooth_side(self.pinion)

    @cached_property
    def form_length(self) -> float:
        """From the base circle to where the pinion's involute begins, along the line of action, mm."""
        return form_length(self.pinion)

    @cached_property
    def planes(self) -> Real:
        """Distances from the gear's axis at which both have teeth and touch, mm."""
        gear = self.gear
        tip = gear.side(FLANK, 1.0, np.array([gear.inner_radius, gear.outer_radius])).x
        found = np.linspace(max(float(tip[0]), self.low), min(float(tip[1]), self.high), _PLANES)
        if gear.more_teeth and self.low <= gear.contact_plane <= self.high:
            found[np.abs(found - gear.contact_plane)[1:-1].argmin() + 1] = gear.contact_plane
        return found

    def _angles(self, x: Real) -> Real:
        """Pressure angles in planes, rad."""
        return np.arccos(self.gear.section_x(0.0) / x)

    @property
    def form_reserve(self) -> float:
        """By how much the pinion's involute begins before the gear's tip asks for it, along the line of action, mm."""
        gear, planes = self.gear, self.planes
        if gear.more_teeth:
            planes = np.array([gear.contact_plane])
        return float(gear.tip_length(self._angles(planes)).min()) - gear.length_apart - self.form_length

    @property
    def gear_form_reserve(self) -> float:
        """By how much the gear's flank goes on below the pinion's tip, along the line of action, mm."""
        return self.gear.shaper.form_length - self.gear.length_apart - self._tip_length

    @property
    def _tip_length(self) -> float:
        """From the base circle to the pinion's tip, mm."""
        return tangent_length(self.pinion.tip_radius, self.pinion.base_radius)

    @cached_property
    def contact_ratio(self) -> float:
        """The pinion's turn from where two flanks meet first to where they part last, over its pitch."""
        if self.gear.more_teeth:
            return self._path / (math.pi * self.gear.module * math.cos(self.pinion.pressure_angle))
        radii = np.linspace(self.gear.inner_radius, self.gear.outer_radius, _ALONG)
        ends = [self._on(length, radii) for length in (self.form_length, self._tip_length)]
        begins, parts = (self._turns(at) for at in ends)
        if not (len(begins) and len(parts)):
            return 0.0
        return float(begins.max() - parts.min()) * self.pinion.number_of_teeth / math.tau

    def _turns(self, at: Places) -> Real:
        """How far the pinion has turned at those places that lie on its face, and at its ends; none beside it."""
        low, high = max(self.low, float(at.x[0])), min(self.high, float(at.x[-1]))
        within = at.x[(at.x > low) & (at.x < high)]
        return np.interp([low, *within, high], at.x, at.turn) if low <= high else within

    @property
    def _path(self) -> float:
        """How long both touch in the plane of contact, along the line of action, mm."""
        gear = self.gear
        if not self.low <= gear.contact_plane <= self.high:
            return 0.0
        # of the shaper's line of action
        begins = max(self.form_length + gear.length_apart, float(gear.tip_length(np.asarray(gear.contact_angle))))
        ends = min(self._tip_length + gear.length_apart, gear.shaper.form_length)
        length = np.linspace(begins, ends, _ALONG)
        radius = gear.cut_radius(gear.contact_angle, length)
        within = length[(radius >= gear.inner_radius) & (radius <= gear.outer_radius)]
        return float(np.ptp(within)) if len(within) else 0.0

    @cached_property
    def end_gap(self) -> float:
        """How near flanks that drive come over a pitch where they stay farthest apart along the face, mm; 0: lines.

        On the cylinders through the tips where the face ends that both have: the pinion may be narrower.
        """
        gear, ends = self.gear, self.planes[[0, -1]]
        play = self.normal_backlash / 2 / self.pinion.base_radius

        def on(share: Real) -> Real:
            return gear.inner_radius + share * (gear.outer_radius - gear.inner_radius)

        radii = on(_root(lambda share, which: ends[which] - gear.side(FLANK, 1.0, on(share)).x, len(ends)))
        along = replace(self, low=0.0, high=gear.outer_radius)
        gap, _, _ = along._feet(self._drive, -play, [(FLANK, _SHARES)], radii)
        return float(gap.reshape(-1, len(_SHARES), len(radii)).min(axis=(0, 1)).max())

    @property
    def _drive(self) -> Real:
        """Angles of the pinion over a pitch, rad."""
        return np.linspace(0.0, math.tau / self.pinion.number_of_teeth, _DRIVE_ANGLES, endpoint=False)

    def _on(self, length: float, radii: Real) -> Places:
        """Places of the flank at radii that stand so far along the line of action, mm, or the nearest end."""

        def over(share: Real, which: Index) -> Real:
            at = self.gear.side(FLANK, share, radii[which])
            # on the base circle but for rounding
            along = np.maximum(at.depth**2 + at.radius**2 - at.x**2 - self.pinion.base_radius**2, 0.0)
            return np.sqrt(along) - length

        return self.gear.side(FLANK, _root(over, len(radii)), radii)

    def _meeting(self, turn: Real) -> Real:
        """Planes in which a flank of the shaper turned so far, (...), touches on cylinders, (..., radii), mm.

        Where flanks are crowned those in which they come nearest are all.
        """
        if self.gear.more_teeth:
            return np.broadcast_to(self.planes, (*turn.shape, _PLANES))
        radii = np.linspace(self.gear.inner_radius, self.gear.outer_radius, _PLANES)
        wanted, radii = (a.ravel() for a in np.broadcast_arrays(turn[..., None], radii))
        share = _root(lambda u, which: wanted[which] - self.gear.side(FLANK, u, radii[which]).turn, len(wanted))
        return self.gear.side(FLANK, share, radii).x.reshape(*turn.shape, _PLANES)

    def contact(self, phase_off: float = 0.0, tolerance: float | None = None) -> PairContact:
        """Verdict over one pitch; the pinion is ``phase_off`` rad further round than in the middle of its backlash."""
        allowed = CONTACT_TOLERANCE * self.gear.module if tolerance is None else tolerance
        drive = self._drive
        gaps = np.stack([self._least(drive, way * phase_off, way) for way in (1, -1)])
        if (clearance := self.hub_clearance) < 0:
            gaps = np.minimum(gaps, clearance)
        return flanks_contact(gaps, drive, complex(self.gear.reference_radius, 0.0), allowed)

    def _least(self, drive: Real, off: float, way: int) -> Real:
        """Least gaps (n,) beside lower sides of the pinion's teeth, or (-1) upper ones seen in a mirror."""
        turned = way * drive
        return np.minimum(self._of_pinion(turned, off), self._of_gear(turned, off))

    def _of_pinion(self, turned: Real, off: float) -> Real:
        """Of places of the pinion's lower sides from the gear; teeth are told by their angle from straight down."""
        gear, pinion = self.gear, self.pinion
        pitch, base = pinion.pitch_angle, pinion.base_radius
        nearest = turned - pitch * np.round(turned / pitch)
        # (n, teeth, planes, places)
        middles = nearest[:, None] + pitch * np.arange(-_TEETH, _TEETH + 1)
        fixed: Complex = np.concatenate(
            [s.curve.point(np.linspace(*s.curve.domain, _PLACES)) for s in self.side.segments]
        )
        # where the line of action of a plane meets the flank
        half = pinion.base_half_angle
        meet = self._meeting(middles + off + gear.shaper.base_half_angle - half)[..., None]
        s = base * (self._angles(meet) + half - middles[:, :, None, None] - off)
        roll = np.clip(s, self.form_length, self._tip_length) / base
        meets = base * np.exp(1j * (roll - half)) * (1 - 1j * roll)
        shape = (*middles.shape, _PLANES, len(fixed))
        places = np.concatenate([np.broadcast_to(fixed, shape), meets], axis=3)
        x = np.concatenate([np.broadcast_to(self.planes[:, None], shape), meet], axis=3)
        seen = places * np.exp(1j * (middles[:, :, None, None] + off))
        # from straight down: along y, and how deep below the shaper's axis
        y, depth = seen.imag, seen.real + gear.axes_apart
        own = np.broadcast_to(turned[:, None, None, None], y.shape)
        found = np.full(y.shape, np.inf)
        near = (depth > gear.tip_depth) & (x >= self.low) & (x <= self.high)
        azimuth = np.arctan2(y, x) - own / self.ratio + math.pi / gear.number_of_teeth
        found[near] = self._gear_off(np.hypot(x, y)[near], azimuth[near], depth[near])
        return np.asarray(found.reshape(len(turned), -1).min(axis=1))

    def _gear_off(self, radius: Real, azimuth: Real, depth: Real) -> Real:
        """How far places below the gear's tips are outside of it; azimuths from the middle of a tooth, rad."""
        gear = self.gear
        pitch = math.tau / gear.number_of_teeth
        aside = np.abs(azimuth - pitch * np.round(azimuth / pitch))
        found = gear.shaper.tip_radius - depth
        beside = np.flatnonzero((radius >= gear.inner_radius) & (radius <= gear.outer_radius))
        row = radius[beside], aside[beside], depth[beside]
        joint = gear.side(FLANK, 0.0, row[0]).depth
        for which, mine in ((FILLET, row[2] > joint), (FLANK, row[2] <= joint)):
            if mine.any():
                off = side_off(gear, which, *(column[mine] for column in row))[0]
                found[beside[mine]] = np.minimum(found[beside[mine]], off)
        return found

    @cached_property
    def _outline(self) -> Boundary:
        return gear_outline(self.side)

    def _of_gear(self, turned: Real, off: float) -> Real:
        """Of places of the gear's upper sides, whose spaces the pinion's lower sides stand in, from the pinion."""
        gap, _, _ = self._feet(turned, off, [(which, np.linspace(0.0, 1.0, _PLACES)) for which in (FILLET, FLANK)])
        return np.asarray(gap.reshape(len(turned), -1).min(axis=1))

    def _feet(
        self, turned: Real, off: float, places: list[tuple[int, Real]], radii: Real | None = None
    ) -> tuple[Real, Real, Index]:
        """Of places (side, shares) on radii, of the whole face else, at turns (n,): gaps, radii on the pinion, nearest
        curves.
        """
        gear, pinion = self.gear, self.pinion
        if radii is None:
            radii = np.linspace(gear.inner_radius, gear.outer_radius, _PLANES)
        sides = [gear.side(which, share[:, None], radii) for which, share in places]
        radius, azimuth, depth = (
            np.concatenate([getattr(at, name).ravel() for at in sides]) for name in ("radius", "azimuth", "depth")
        )
        pitch = math.tau / gear.number_of_teeth
        ahead = turned / self.ratio
        nearest = ahead - pitch * np.round(ahead / pitch)
        middles = nearest[:, None] + pitch * np.arange(-_TEETH, _TEETH + 1)
        turn = azimuth + middles[:, :, None] - math.pi / gear.number_of_teeth
        x, y = radius * np.cos(turn), radius * np.sin(turn)
        seen = (depth - gear.axes_apart + 1j * y) * np.exp(-1j * (turned[:, None, None] + off))
        found, curves = np.full(seen.shape, np.inf), np.zeros(seen.shape, int)
        near = (np.abs(seen) < pinion.tip_radius + gear.module) & (x >= self.low) & (x <= self.high)
        points, _ = folded(seen[near], np.zeros(int(near.sum()), complex), pinion.pitch_angle)
        feet = self._outline.feet(points)
        found[near], curves[near] = feet.distance, feet.curve_index
        return found, np.abs(seen), curves

    @cached_property
    def tip_in_fillet(self) -> tuple[float, float]:
        """Where tips come nearest to what is no flank of the pinion: the gap, from its axis, mm; (inf, 0) nowhere."""
        gap, reach, curves = self._feet(self._drive, 0.0, [(FLANK, np.ones(1))])
        below = [k for k, s in enumerate(self.side.segments) if s.label in (Label.ROOT_FILLET, Label.ROOT_LAND)]
        gap[~np.isin(curves, below)] = np.inf
        least = int(gap.argmin())
        return float(gap.flat[least]), float(reach.flat[least])
