"""Rack and pinion: distance, contact ratio, backlash, phase, conditions.

Frame: the pinion's axis is the origin, the rack lies towards +x in the mesh frame, its datum line at x = ``distance``,
its teeth pointing to -x. The pitch circle is always the reference circle. Symbols are those of ISO 21771.
"""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np

from geometry.base.angles import tangent_length
from geometry.base.errors import ParameterError
from geometry.base.findings import Finding
from geometry.base.record import Record, replace
from geometry.base.tolerance import CONTACT_TOLERANCE, is_told
from geometry.curves.curve import Real, end_point, start_point
from geometry.gears.pairs.involute import facing_gaps, refuse_other_rack
from geometry.gears.teeth.limits import Margin, not_kept
from geometry.gears.teeth.rack import Rack, RackSide
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import ToothSide, tooth_side
from geometry.plane.distance import Flags
from geometry.plane.profile import Label


class RackPair(Record, dict=True):
    """A gear in mesh with a rack; made by ``rack_pair``. Lengths in mm, angles in rad."""

    gear: SpurGear
    rack: Rack
    distance: float

    @property
    def working_centre_distance(self) -> float:
        """The distance, as other pairs call it, mm."""
        return self.distance

    @property
    def gears(self) -> tuple[SpurGear]:
        """The one gear."""
        return (self.gear,)

    @property
    def working_radii(self) -> tuple[float]:
        """The reference circle is always the working circle, mm."""
        return (self.gear.reference_radius,)

    @property
    def working_pressure_angle(self) -> float:
        """That of the rack, rad."""
        return self.rack.rack.pressure_angle

    @property
    def module(self) -> float:
        """m, mm."""
        return self.gear.module

    @property
    def base_pitch(self) -> float:
        """p_b = pi m cos(alpha), mm."""
        return math.pi * self.module * math.cos(self.rack.rack.pressure_angle)

    @cached_property
    def sides(self) -> tuple[ToothSide, RackSide]:
        """The exact tooth sides; raises ParameterError where one cannot be built."""
        return tooth_side(self.gear), self.rack.side

    @property
    def travel_per_turn(self) -> float:
        """pi d, mm."""
        return 2 * math.pi * self.gear.reference_radius

    @property
    def _line(self) -> float:
        """r sin(alpha): from the base circle to the pitch point along the line of action, mm."""
        return self.gear.reference_radius * math.sin(self.rack.rack.pressure_angle)

    def _gear_tangents(self, *, relief: bool = True) -> tuple[float, float]:
        """Length from the base circle to the gear's first and last flank point, mm; ``relief``: that part too."""
        low, high = self.sides[0].flank_radii(relief=relief)
        return tangent_length(low, self.gear.base_radius), tangent_length(high, self.gear.base_radius)

    def _rack_depths(self) -> tuple[float, float]:
        """x of the rack's first and last flank point in the mesh frame with the datum line at ``distance``, mm."""
        line = next(s.curve for s in self.sides[1].segments if s.label is Label.FLANK)
        return self.distance + start_point(line).real, self.distance + end_point(line).real

    def _rack_tangents(self) -> tuple[float, float]:
        """Length from the gear's base circle to where the rack's tip and root end the line of action, mm."""
        radius, sine = self.gear.reference_radius, math.sin(self.rack.rack.pressure_angle)
        low, high = self._rack_depths()
        return self._line - (radius - low) / sine, self._line + (high - radius) / sine

    @property
    def contact_ratio(self) -> float:
        """eps_alpha between the tips of gear and rack."""
        return (self._gear_tangents()[1] - self._rack_tangents()[0]) / self.base_pitch

    @property
    def effective_contact_ratio(self) -> float:
        """eps_alpha between the ends of the active profiles: less where a fillet ends a flank."""
        low, high = self.active_line
        return (high - low) / self.base_pitch

    @property
    def active_line(self) -> tuple[float, float]:
        """Where contact begins and ends on the line of action, mm from the gear's base circle."""
        gear, rack = self._gear_tangents(), self._rack_tangents()
        return max(gear[0], rack[0]), min(gear[1], rack[1])

    @property
    def tip_clearances(self) -> tuple[float, float]:
        """Bottom clearance at the gear's root and at the rack's, mm."""
        return (
            self.distance - self.rack.addendum - self.gear.root_radius,
            self.distance + self.rack.dedendum - self.gear.tip_radius,
        )

    @property
    def normal_backlash(self) -> float:
        """j_bt, mm (j_bn of spur gears): (A_1 + A_2) cos(alpha) + 2 (distance - r - x m) sin(alpha)."""
        alpha, gear = self.rack.rack.pressure_angle, self.gear
        thinning = gear.circumferential_thinning + self.rack.circumferential_thinning
        nominal = gear.reference_radius + gear.profile_shift_coefficient * gear.module
        return thinning * math.cos(alpha) + 2 * (self.distance - nominal) * math.sin(alpha)

    @property
    def touching_distance(self) -> float:
        """At which both would have no backlash, mm."""
        return self.distance - self.normal_backlash / (2 * math.sin(self.rack.rack.pressure_angle))

    def rack_position(self, rotation: float) -> float:
        """y, mm, of the space's centre line that faces a tooth at ``rotation``, rad: the rack moves by r per radian."""
        return self.gear.reference_radius * rotation

    def margins(self) -> tuple[Margin, ...]:
        """The pair's limits, each with its margin (>= 0 where kept); mm along the line of action or of clearance."""
        gear, rack = self._gear_tangents(), self._rack_tangents()
        return (
            Margin.above("fillet_interference_gear", rack[0], gear[0]),
            Margin.below("fillet_interference_rack", gear[1], rack[1]),
            Margin.above("contact_ratio", self.effective_contact_ratio, 1.0),
            Margin.above("tip_clearance_gear", self.tip_clearances[0], 0.0),
            Margin.above("tip_clearance_rack", self.tip_clearances[1], 0.0),
            Margin.above("normal_backlash", self.normal_backlash, 0.0),
        )

    def findings(self) -> tuple[Finding, ...]:
        """The limits that are not kept; a margin within rounding of the distance counts as kept.

        So does a tip that goes into the fillet by less than is contact: the rounding of ISO 53 A takes 3e-5 modules
        more than its clearance, so that every rack of it does, 1.6e-9 modules deep.
        """
        found = not_kept(self.margins(), self.distance)
        if self.depth_in_fillet > CONTACT_TOLERANCE * self.module:
            return found
        return tuple(f for f in found if f.code != "fillet_interference_gear")

    @property
    def depth_in_fillet(self) -> float:
        """How deep the rack's tip goes into the gear's fillet, mm: its corner out of the rounding that cut that."""
        gear = self.gear
        rounding = gear.module * (gear.rack.tip_radius if gear.cutter is None else gear.cutter.tip_rounding)
        beyond = max(self._gear_tangents()[0] - self._rack_tangents()[0], 0.0)
        return math.hypot(rounding, beyond * math.tan(self.rack.rack.pressure_angle)) - rounding


def rack_pair(gear: SpurGear, rack: Rack, distance: float | None = None) -> RackPair:
    """The pair at r + x m from axis to datum line, without backlash but for thinning, or at a given distance, mm.

    Raises
    ------
    ParameterError
        Modules or pressure angles differ, or the teeth would overlap at the distance; names what would work.
    """
    refuse_other_rack(gear, rack.module, rack.rack.pressure_angle, "gear")
    nominal = gear.reference_radius + gear.profile_shift_coefficient * gear.module
    pair = RackPair(gear, rack, nominal if distance is None else distance)
    if distance is not None and not pair.normal_backlash >= -1e-12 * nominal:
        touching = pair.touching_distance
        if is_told(distance, touching):
            return replace(pair, distance=touching)
        raise ParameterError.beyond("working_centre_distance", distance, "teeth_overlap", touching, digits=6)
    return pair


def rack_flank_gaps(pair: RackPair, rotation: Real, position: Real, distance: float) -> Real:
    """Closed form for the flanks: gear rotations (n,) rad, positions of a rack tooth's centre line (n,) mm: (n, 2) mm.

    Columns: lower and upper flanks of the gear's teeth. The common normal touches the base circle at the pressure
    angle: gap = distance sin(alpha) - (y + s/2) cos(alpha) - r_b f. inf where it misses one flank.
    """
    alpha, base, base_pitch = pair.rack.rack.pressure_angle, pair.gear.base_radius, pair.base_pitch
    ends = pair._gear_tangents(relief=False)
    least, most = (x + distance - pair.distance for x in pair._rack_depths())
    result = np.full((len(rotation), 2), np.inf)
    half = pair.rack.tooth_thickness / 2

    def meets(at: Real, gap: Real) -> Flags:
        depth = base * math.cos(alpha) + (at + gap) * math.sin(alpha)
        return (depth >= least) & (depth <= most)

    for column, sense in enumerate((1.0, -1.0)):
        reached = base * (alpha - sense * rotation + pair.gear.base_half_angle)
        gap = distance * math.sin(alpha) - (sense * position + half) * math.cos(alpha) - reached
        result[:, column] = facing_gaps(gap, reached, ends, base_pitch, meets)
    return result
