"""Two bevel gears whose apexes are one: what both are together, and the gap between them over a pitch of motion.

Everything is one problem on the unit sphere; a gap there is as many times the cone distance in mm, least at the inner
end, and less where tooth lines lean. Those turn the same problem on, from sphere to sphere. Azimuths are rotations of
each gear about its own axis, from the pitch line on.
"""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np

from geometry.base.both import both
from geometry.base.record import Record
from geometry.base.tolerance import CONTACT_TOLERANCE
from geometry.curves.curve import Real
from geometry.gears.bevel.gear import BevelGear
from geometry.gears.bevel.sphere import spatial
from geometry.gears.bevel.walls import tooth_off
from geometry.gears.mesh.search import PairContact, flanks_contact

# drive angles in a pitch; places along a fillet, a flank, half a tip land; teeth to each side of the pitch line
_DRIVE_ANGLES, _PLACES, _NEAR_TEETH = 24, 17, 3
# spheres on which flanks are looked at that are not straight, for gaps and for their ratio
_SPHERES, _ALONG = 9, 129


class BevelPair(Record, dict=True):
    """Two gears of one apex, made for each other."""

    first: BevelGear
    second: BevelGear

    @property
    def gears(self) -> tuple[BevelGear, BevelGear]:
        """Both."""
        return self.first, self.second

    @property
    def ratio(self) -> float:
        """u12, turns of the first for one of the second."""
        return self.second.number_of_teeth / self.first.number_of_teeth

    @property
    def normal_backlash(self) -> float:
        """Between the flanks along the normal at the outer end, mm."""
        return sum(gear.circumferential_thinning for gear in self.gears) * self.first.normal_share

    @cached_property
    def _rolled(self) -> tuple[float, float]:
        """Of the line of action from the pitch line to both base circles, rad."""
        return both(float(gear.involute.arc(gear.pitch_angle)) for gear in self.gears)

    @property
    def tip_arcs(self) -> tuple[float, float]:
        """Of the line of action from the pitch line to where it meets the outer tip of each, rad."""
        return self.tip_arcs_at(self.first.cone_distance)

    def tip_arcs_at(self, distance: float) -> tuple[float, float]:
        """The same at a cone distance, mm."""
        one, two = (float(g.involute.arc(g.tip_angle_at(distance))) for g in self.gears)
        return one - self._rolled[0], two - self._rolled[1]

    @property
    def form_reserves(self) -> tuple[float, float]:
        """By how much the flank of each begins before the mate's tip asks for it, along the line of action, mm."""
        one, two = self._reserves(self.tip_arcs)
        return one * self.first.cone_distance, two * self.first.cone_distance

    def _reserves(self, tips: tuple[float, float]) -> tuple[float, float]:
        """The same for tips that reach so far, rad."""
        (first, second), (one, two) = self.gears, tips
        return self._rolled[0] - two - first.joint[1], self._rolled[1] - one - second.joint[1]

    @property
    def contact_ratio(self) -> float:
        """epsilon_alpha: the arc of the line of action on which flanks meet, outer, over the base pitch."""
        return self.contact_ratio_at(self.first.cone_distance)

    def contact_ratio_at(self, distance: float) -> float:
        """The same of the teeth at a cone distance, mm: less inwards where tips run along the mate's root."""
        tips = self.tip_arcs_at(distance)
        lost = sum(max(-reserve, 0.0) for reserve in self._reserves(tips))
        return (sum(tips) - lost) / (math.sin(self.first.involute.base) * math.tau / self.first.number_of_teeth)

    @property
    def face_contact_ratio(self) -> float:
        """epsilon_beta: what the tooth line turns along the face, over the pitch."""
        outer, inner = self.first.spin([self.first.cone_distance, self.first.inner_distance])
        return float(abs(outer - inner)) * self.first.number_of_teeth / math.tau

    @cached_property
    def total_contact_ratio(self) -> float:
        """epsilon_gamma: the turn from where two flanks meet first to where they part, over the pitch.

        On each sphere flanks meet as straight ones do, by as much later as the tooth line turns it on; which end of the
        face meets first is the sides' difference, and the less of both counts.
        """
        first = self.first
        if first.is_straight:
            return self.contact_ratio
        spheres = np.linspace(first.cone_distance, first.inner_distance, _ALONG)
        reach = []
        for distance in spheres:
            one, two = tips = self.tip_arcs_at(distance)
            cut_off = [max(-reserve, 0.0) for reserve in self._reserves(tips)]
            reach.append((one - cut_off[1], two - cut_off[0]))
        ends, begins = np.array(reach).T / math.sin(first.involute.base)
        turned = first.spin(spheres)
        least = min(float((ends - way * turned).max() + (begins + way * turned).max()) for way in (-1, 1))
        return least * first.number_of_teeth / math.tau

    @property
    def bottom_clearances(self) -> tuple[float, float]:
        """Between the root of each and the mate's tip at the outer end, mm."""
        first, second = self.gears
        return first.dedendum - second.addendum, second.dedendum - first.addendum

    @property
    def sliding_factors(self) -> tuple[float, float]:
        """At the tips of the second and of the first, where contact begins and ends, outer: part of the pitch speed.

        Both gears turn about the pitch line against each other, sin Sigma / sin delta_2 as fast as the first does.
        """
        first, second = self.gears
        turned = math.sin(first.shaft_angle) / (math.sin(first.pitch_angle) * math.sin(second.pitch_angle))
        end, start = (
            turned * math.sin(arc) / math.cos(gear.tip_angle - gear.pitch_angle)
            for gear, arc in zip(self.gears, self.tip_arcs, strict=True)
        )
        return start, end

    @property
    def virtual_contact_ratio(self) -> float:
        """Of the two spur gears of the back cones (Tredgold), whose flanks are whole."""
        alpha, m = self.first.pressure_angle, self.first.module
        found = 0.0
        for gear in self.gears:
            radius, sine = m * gear.virtual_teeth / 2, math.sin(alpha)
            found += math.sqrt((radius + gear.addendum) ** 2 - (radius * math.cos(alpha)) ** 2) - radius * sine
        return found / (math.pi * m * math.cos(alpha))

    def contact(self, phase_off: float = 0.0, tolerance: float | None = None) -> PairContact:
        """Verdict over one pitch; the second is ``phase_off`` rad further round than in the middle of its backlash."""
        first, second = self.gears
        allowed = CONTACT_TOLERANCE * first.module if tolerance is None else tolerance
        drive = np.linspace(0.0, math.tau / first.number_of_teeth, _DRIVE_ANGLES, endpoint=False)
        # teeth of one stand against spaces of the other, and what turns one forwards turns the other back
        turned = phase_off + math.pi / second.number_of_teeth - drive * (first.number_of_teeth / second.number_of_teeth)
        found = []
        for way in (-1, 1):
            both = []
            for distances, one, two, ahead, behind in self._sections():
                own, others = drive + ahead, turned + behind
                least = np.minimum(_least(one, two, way, own, others), _least(two, one, way, others, own))
                both += [least * d * first.normal_share_at(d) / math.cos(first.pressure_angle) for d in distances]
            found.append(np.min(both, axis=0))
        return flanks_contact(np.stack(found), drive, complex(first.outer(first.pitch_angle).real), allowed)

    def _sections(self) -> list[tuple[tuple[float, ...], BevelGear, BevelGear, float, float]]:
        """Cone distances, mm, the teeth of both on spheres there, and how far the tooth line turns them, rad.

        Straight teeth are the same on all spheres: a gap is least at the inner end, what overlaps deepest at the outer.
        """
        first, second = self.gears
        if first.is_straight:
            return [((first.cone_distance, first.inner_distance), first, second, 0.0, 0.0)]
        spheres = np.linspace(first.cone_distance, first.inner_distance, _SPHERES).tolist()
        return [((d,), first.at(d), second.at(d), float(first.spin(d)), float(second.spin(d))) for d in spheres]


def _least(gear: BevelGear, mate: BevelGear, way: int, turned: Real, mate_turned: Real) -> Real:
    """Least gaps (n,) of the places on one side (+-1) of a gear's teeth from its mate, both turned so (n,), rad."""
    pitch = math.tau / gear.number_of_teeth
    # its teeth nearest to the pitch line
    nearest = turned[:, None] - pitch * np.round(turned[:, None] / pitch)
    middles = (nearest + pitch * np.arange(-_NEAR_TEETH, _NEAR_TEETH + 1)).ravel()
    angle, aside = _places(gear, way * middles)
    x, y, z = np.moveaxis(spatial(angle, middles[:, None] + way * aside), -1, 0)
    sine, cosine = math.sin(gear.shaft_angle), math.cos(gear.shaft_angle)
    x, y, z = sine * z - cosine * x, -y, sine * x + cosine * z
    azimuth = np.arctan2(y, x) - np.repeat(mate_turned, 2 * _NEAR_TEETH + 1)[:, None]
    return np.asarray(tooth_off(mate, np.arctan2(np.hypot(x, y), z), azimuth).reshape(len(turned), -1).min(axis=1))


def _places(gear: BevelGear, middles: Real) -> tuple[Real, Real]:
    """Angles and azimuths off their middles (n, k) of a side of teeth whose middles stand so; where it drives, too."""
    share = np.linspace(0.0, 1.0, _PLACES)
    sides = [gear.tooth_places(name, share) for name in ("fillet", "flank")]
    top = float(sides[1][1][-1])
    land = np.full(_PLACES, gear.tip_angle), top * share
    fixed = [np.concatenate(rows) for rows in zip(*sides, land, strict=True)]
    # where the line of action meets the flank
    involute, pitch = gear.involute, gear.pitch_angle
    own = float(gear.half_angle(pitch))
    rolled = float(involute.arc(pitch)) + math.sin(involute.base) * (middles + own)
    rolled = np.clip(rolled, gear.joint[1], gear.tip_arc)
    meets = involute.angle(rolled)
    found = []
    for row, at in zip(fixed, (meets, gear.half_angle(meets)), strict=True):
        found.append(np.concatenate([np.broadcast_to(row, (len(middles), len(row))), at[:, None]], axis=1))
    return found[0], found[1]
