"""Where a sector's teeth are in mesh with a mate, and how they enter one that stands; on the exact line of contact.

A sector turns by ``rho`` from where its own +x axis looks along the line of centres to the mesh, counter-clockwise. A
tooth whose centre line stands ``phi`` off that line is in contact with its counter-clockwise flank, the one that drives
counter-clockwise, while ``phi = t - alpha_w - psi_b`` for a roll angle t of its active flank (psi_b: half of the tooth
on the base circle; of a ring its space). Its other flank is the mirror image. Angles in rad, lengths in mm.
Source: DERIVATIONS.md.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from functools import cached_property
from typing import NamedTuple

from geometry.base.angles import involute_function, tangent_length
from geometry.base.findings import Finding
from geometry.base.record import Record
from geometry.base.roots import bracketed_root
from geometry.curves.curve import end_point, start_point
from geometry.curves.line_arc import Arc
from geometry.gears.pairs.external import ExternalPair
from geometry.gears.pairs.internal import InternalPair
from geometry.gears.pairs.rack import RackPair
from geometry.gears.teeth.rack import RackSide
from geometry.gears.teeth.ring import RingGear
from geometry.gears.teeth.side import Side
from geometry.gears.teeth.spur import SpurGear
from geometry.plane.profile import Label

Pair = ExternalPair | InternalPair | RackPair
# of a pitch: what is whole but for rounding
_SAME = 1e-9


class Sense(NamedTuple):
    """Directions between which a tooth's counter-clockwise flank is in contact, rad."""

    low: float
    high: float


class SectorMesh(Record):
    """A sector in mesh.

    ``low``, ``high``: where the centre line of a tooth stands as its counter-clockwise flank begins and ends to touch;
    ``first``, ``last``: of the outer teeth of the first run, in the sector; ``twist``: by how much teeth turn from face
    to face. ``rate``: the mate's motion, rad or mm, for one rad. ``entry_margin``: along the tips of a mate that stands
    where the last tooth has left it, from where those of the first tooth pass them to the nearest tip land, mm: below 0
    they run into each other, or into the flank beside it, or its own flank would push the tooth that it meets back.
    """

    teeth: int
    runs: int
    pitch: float
    low: float
    high: float
    first: float
    last: float
    rate: float
    entry_margin: float
    twist: float = 0.0

    @property
    def turn(self) -> float:
        """From run to run."""
        return 2 * math.pi / self.runs

    @property
    def mesh_angle(self) -> float:
        """Over which a run is in contact on one flank: (n - 1 + eps) pitches, eps the total contact ratio."""
        return self.last - self.first + self.high - self.low + abs(self.twist)

    @property
    def jam(self) -> tuple[Finding, ...]:
        """The remark that the first tooth runs into a tip of a mate that stands, so far beside its edge, mm."""
        return (Finding("first_tooth_jams", -self.entry_margin, 0.0),) if self.entry_margin < 0 else ()

    def ends(self, way: int = 1) -> tuple[float, float]:
        """Turns of the sector between which the first run touches with flanks that look ``way``: 1, -1, or 0: any."""
        if not way:
            both = self.ends(1), self.ends(-1)
            return min(one[0] for one in both), max(one[1] for one in both)
        low, high = (self.low, self.high) if way > 0 else (-self.high, -self.low)
        return low - self.last - max(self.twist, 0.0), high - self.first - min(self.twist, 0.0)

    def beyond(self, least: float, most: float, start: float) -> float:
        """How far turns from ``least`` to ``most`` go beyond the contact of the run that is nearest at ``start``."""
        low, high = self.ends(0)
        if high - low >= self.turn:
            return 0.0
        run = self.turn * round((start - (low + high) / 2) / self.turn)
        return max(most - high - run, low + run - least, 0.0)


class Steps(Record, dict=True):
    """A second that a first with a sector moves while its teeth touch, turning ``way`` (1, -1), and that stands else.

    The last tooth of a run leaves the line of contact at its tip, whose corner pushes the mate's flank on until it
    slips off where the tip circles cross, or pushes no more; there the mate is left. The first tooth of the next run
    meets the last one that then stands within the tip circle of the sector, ``ahead`` pitches behind the one that was
    left, and pushes its corner until both touch on the line of contact. So n teeth move the mate by n - 1 + ``ahead``.
    Directions are those of a tooth's centre line as ``SectorMesh`` has them; a ``conjugate`` one tells where the mate
    stands: where a tooth there, its flanks long enough, would touch it on the line of contact.
    """

    mesh: SectorMesh
    pair: ExternalPair
    way: int

    @property
    def ahead(self) -> int:
        """How many pitches behind the tooth that the last one has left stands the one that the first one meets."""
        return _ahead(self.pair, 0)

    @property
    def moved(self) -> int:
        """Teeth of the mate that a run moves it by."""
        return self.mesh.teeth - 1 + self.ahead

    @cached_property
    def line(self) -> Sense:
        """Where a tooth stands as contact on the line of action begins at the mate's tip and ends at its own.

        A flank that is cut away there is taken as whole: it would push a little less.
        """
        pair, alpha = self.pair, self.pair.working_pressure_angle
        own, mate = (tangent_length(r, g.base_radius) for r, g in zip(pair.tip_form_radii, pair.gears, strict=True))
        low, off = pair.working_centre_distance * math.sin(alpha) - mate, alpha + pair.first.base_half_angle
        return Sense(max(low, 0.0) / pair.first.base_radius - off, own / pair.first.base_radius - off)

    @cached_property
    def left(self) -> float:
        """Where a tooth stands as its tip leaves that of the mate."""
        return max(_left(self.pair, 0)[0], self.line.high)

    @cached_property
    def stands(self) -> float:
        """Conjugate direction of the first tooth while the mate stands."""
        return max(self._pushed_on(self.left), self.line.high) - self.ahead * self.mesh.pitch

    @cached_property
    def first_touch(self) -> float:
        """Where the first tooth stands as it first touches the standing mate."""
        return min(self._pushed(self.stands), self.line.low) if self.stands < self.line.low else self.stands

    @property
    def jams_at(self) -> float:
        """The turn of the sector as its first tooth stops at the standing mate; only where that jams."""
        pair, a, behind = self.pair, self.pair.working_centre_distance, _behind(self.pair, 0)
        (own, tip), pitch = pair.tip_form_radii, pair.second.pitch_angle
        half, (enters, deepest) = _half(pair.second, tip), _coming_in(pair, 0)

        def on_land(middle: float) -> float:
            # its flank, at best where their normal goes through the mate's axis, or its tip
            locks = math.asin(pair.first.base_radius / a)
            met = a - cmath.rect(tip, min(max(locks, middle - half), middle + half, _met(pair, 0)))
            return cmath.phase(met) - _half(pair.first, abs(met))

        def within(towards: float) -> float:
            # how far its tip is in the flank of the tooth behind the one that it is to push
            return -_at_tip(pair, 0, towards) - behind

        at = on_land(behind - pitch)
        if within(enters) >= 0:
            at = min(at, on_land(behind))
        elif within(deepest) > 0:
            at = min(at, -bracketed_root(within, deepest, enters).value - _half(pair.first, own))
        return self.way * (at - (self.mesh.last if self.way > 0 else -self.mesh.first))

    @property
    def rest(self) -> float:
        """Over which the sector turns from run to run while the mate stands; not above 0: it never does."""
        return self.mesh.turn - (self.left - self.first_touch + self.mesh.last - self.mesh.first)

    def _pushed(self, conjugate: float) -> float:
        """Where the first tooth stands as its flank touches the tip corner of the mate's tooth."""
        tip, mate = self.pair.tip_form_radii[1], self.pair.second
        low = _contact(self.pair, 1).low
        turned = low + (self.mesh.high - conjugate) * self.mesh.rate + _half(mate, tip)
        corner = self.pair.working_centre_distance - cmath.rect(tip, turned)
        return cmath.phase(corner) - _half(self.pair.first, abs(corner))

    def _pushed_on(self, at: float) -> float:
        """Conjugate direction as the tip corner of a tooth that stands so touches the mate's flank."""
        own, mate = self.pair.tip_form_radii[0], self.pair.second
        corner = self.pair.working_centre_distance - cmath.rect(own, at + _half(self.pair.first, own))
        turned = cmath.phase(corner) - _half(mate, abs(corner))
        return self.mesh.high + (_contact(self.pair, 1).low - turned) / self.mesh.rate

    def advanced(self, rho: float) -> float:
        """The turn of a gear with all teeth that moves the mate as far as the sector does up to ``rho``."""
        mesh, lead = self.mesh, self.mesh.last if self.way > 0 else -self.mesh.first
        runs, rest = divmod(self.way * rho + lead - self.first_touch, mesh.turn)
        return self.way * (self._conjugate(self.first_touch + rest) + runs * self.moved * mesh.pitch - lead)

    def _conjugate(self, at: float) -> float:
        """Conjugate direction of the first tooth, which stands so, or has passed."""
        others, (low, high) = self.mesh.last - self.mesh.first, self.line
        if at >= high + others:
            return max(self._pushed_on(min(at - others, self.left)), high) + others
        if at >= low or at <= self.first_touch:
            return max(at, self.stands) if at >= low else self.stands
        if at >= self._pushed(low):
            return low
        return bracketed_root(lambda tried: self._pushed(tried) - at, self.stands, low).value


def _left(pair: ExternalPair, index: int) -> tuple[float, float]:
    """Where teeth of a sector at a place in its pair and of the mate stand as the tip of one leaves the other's flank.

    It slips off where the tip circles cross, or before that no longer pushes: as the flank's normal goes through the
    sector's axis, it has turned the mate as far as it will.
    """
    towards = _coming_in(pair, index)[1]
    return towards - _half(pair.gears[index], pair.tip_form_radii[index]), _at_tip(pair, index, towards)


def _coming_in(pair: ExternalPair, index: int) -> tuple[float, float]:
    """Directions about the sector's axis, off the line of centres: of where the tip circles cross, and of the place on
    its own between there and that line at which its tip comes deepest into flanks of the mate.
    """
    a, own, tip = pair.working_centre_distance, pair.tip_form_radii[index], pair.tip_form_radii[1 - index]
    crossing = _angle((a**2 + own**2 - tip**2) / (2 * a * own))
    return crossing, min(crossing, math.asin(pair.gears[1 - index].base_radius / a))


def _at_tip(pair: ExternalPair, index: int, towards: float) -> float:
    """Where a tooth of the mate stands whose flank a tip of the sector touches from there."""
    corner = pair.working_centre_distance - cmath.rect(pair.tip_form_radii[index], towards)
    return cmath.phase(corner) - _half(pair.gears[1 - index], abs(corner))


def _behind(pair: ExternalPair, index: int) -> float:
    """Where the tooth of the standing mate stands behind the one that the first tooth meets."""
    return _left(pair, index)[1] + (_ahead(pair, index) + 1) * pair.gears[1 - index].pitch_angle


def _ahead(pair: ExternalPair, index: int) -> int:
    """Of ``Steps``: the last tooth whose flank then ends within the tip circle of the sector."""
    mate, tip = pair.gears[1 - index], pair.tip_form_radii[1 - index]
    return math.floor((_met(pair, index) - _half(mate, tip) - _left(pair, index)[1]) / mate.pitch_angle + _SAME)


def _half(gear: SpurGear, radius: float) -> float:
    """Half of a tooth's angle between its main flanks on a circle, rad."""
    return gear.base_half_angle - involute_function(math.acos(min(gear.base_radius / radius, 1.0)))


def sector_meshes(pair: Pair, overlap: float = 0.0) -> dict[int, SectorMesh]:
    """The sectors of a pair, by their place in it; ``overlap``: its ratio, below 0 where the first is left-handed."""
    found = {}
    gears: Sequence[SpurGear | RingGear] = pair.gears
    for index, gear in enumerate(gears):
        if (sector := gear.sector) is None:
            continue
        contact, pitch = _contact(pair, index), gear.pitch_angle
        if isinstance(gear, RingGear):
            # a space's lower flank, the image of its upper one, is the tooth's before it, half a pitch away
            contact = Sense(-contact.high - pitch / 2, -contact.low - pitch / 2)
        ends = [sector.centre(k, pitch, gear.sign) for k in (0, sector.teeth - 1)]
        rate = gear.reference_radius if isinstance(pair, RackPair) else pair.teeth[index] / pair.teeth[1 - index]
        hand = -1 if index and isinstance(pair, ExternalPair) else 1
        margin, twist = _entry_margin(pair, index), hand * overlap * pitch
        found[index] = SectorMesh(sector.teeth, sector.runs, pitch, *contact, ends[0], ends[1], rate, margin, twist)
    return found


def _contact(pair: Pair, index: int) -> Sense:
    """Where a tooth of a gear, or a space of a ring, stands as contact on its upper flank begins and ends."""
    gear, alpha = pair.gears[index], pair.working_pressure_angle
    low, high = pair.active_line
    if index:
        assert not isinstance(pair, RackPair)
        line = pair.working_centre_distance * math.sin(alpha)
        low, high = (line - high, line - low) if pair.sign > 0 else (line + low, line + high)
    off = alpha + gear.base_half_angle
    return Sense(low / gear.base_radius - off, high / gear.base_radius - off)


def _entry_margin(pair: Pair, index: int) -> float:
    """Of ``SectorMesh``, for the gear at its place: the mate stands where the last tooth has left it."""
    gear = pair.gears[index]
    if isinstance(pair, RackPair):
        half, line = _land(pair.sides[1]), pair.distance - pair.rack.addendum
        met = math.sqrt(max(gear.tip_radius**2 - line**2, 0.0))
        return abs(math.remainder(2 * met + half, pair.rack.pitch)) - half
    mate, half = pair.gears[1 - index], _land(pair.sides[1 - index])
    if isinstance(pair, ExternalPair):
        behind, met = _behind(pair, index), _met(pair, index)
        # coming in, the tip passes the tooth behind as it would leave it going out the other way
        flank = behind + _left(pair, index)[1]
        # beyond there a flank that touches the corner of the tooth before that one pushes it back
        corner = behind - mate.pitch_angle + _half(pair.gears[1 - index], pair.tip_form_radii[1 - index])
        back = math.asin(gear.base_radius / pair.working_centre_distance) - corner
        return mate.tip_radius * min(abs(math.remainder(behind - met, mate.pitch_angle)) - half, flank, back)
    return mate.tip_radius * (abs(math.remainder(2 * _met(pair, index) + half, mate.pitch_angle)) - half)


def _met(pair: ExternalPair | InternalPair, index: int) -> float:
    """From the line of centres to where the tip circles cross, about the axis of the mate of a gear, rad."""
    gear, mate, a = pair.gears[index], pair.gears[1 - index], pair.working_centre_distance
    own, tip = gear.tip_radius, mate.tip_radius
    # a pinion sees its ring's axis behind it
    sign = -1 if isinstance(gear, RingGear) else 1
    return _angle(sign * (a**2 + tip**2 - own**2) / (2 * a * tip))


def _angle(cosine: float) -> float:
    return math.acos(min(1.0, max(-1.0, cosine)))


def _land(side: Side | RackSide) -> float:
    """Half of a tip land: rad of an arc, mm of a line; 0 where there is none."""
    last = side.segments[0 if isinstance(side, RackSide) else -1]
    if last.label is not Label.TIP_LAND:
        return 0.0
    low, high = last.curve.domain
    return (high - low) if isinstance(last.curve, Arc) else abs(end_point(last.curve) - start_point(last.curve))
