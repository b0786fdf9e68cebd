"""The internal pair, pinion in ring: working angle, centre distance, contact ratio, backlash, phase, conditions.

Frame: the ring's axis is the origin, the pinion's lies at ``working_centre_distance`` in the given direction, and so
does the mesh. Results for both gears are tuples (pinion, ring). Shift of the ring is positive away from its axis, so
that everything follows from x2 - x1. Source: GOST 19274, KHK, Elements of Metric Gear Technology.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from geometry.base.angles import inverse_involute, involute_function
from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.findings import Finding
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import Real
from geometry.gears.teeth.internal_mesh import InternalMesh
from geometry.gears.teeth.limits import Margin
from geometry.gears.teeth.ring import RingGear
from geometry.gears.teeth.ring_tooth import RingSide, flank_ends, ring_side
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import ToothSide, tooth_side
from geometry.plane.profile import Label


@dataclass(frozen=True)
class InternalPair:
    """A pinion in mesh with a ring; made by ``internal_pair``. Lengths in mm, angles in rad."""

    pinion: SpurGear
    ring: RingGear
    working_centre_distance: float
    working_pressure_angle: float

    @property
    def gears(self) -> tuple[SpurGear, RingGear]:
        """Pinion and ring."""
        return self.pinion, self.ring

    @property
    def module(self) -> float:
        """m, mm."""
        return self.pinion.module

    @property
    def teeth(self) -> tuple[int, int]:
        """z_1, z_2."""
        return self.pinion.number_of_teeth, self.ring.number_of_teeth

    @property
    def gear_ratio(self) -> float:
        """u = z_2 / z_1; both gears turn the same way."""
        return self.ring.number_of_teeth / self.pinion.number_of_teeth

    @property
    def reference_centre_distance(self) -> float:
        """a = r_2 - r_1, mm."""
        return self.ring.reference_radius - self.pinion.reference_radius

    @property
    def centre_distance_coefficient(self) -> float:
        """y = (a_w - a) / m."""
        return (self.working_centre_distance - self.reference_centre_distance) / self.module

    @property
    def working_radii(self) -> tuple[float, float]:
        """r_w1, r_w2, mm."""
        a_w, u = self.working_centre_distance, self.gear_ratio
        return a_w / (u - 1), a_w * u / (u - 1)

    @property
    def base_pitch(self) -> float:
        """p_b = pi m cos(alpha), mm."""
        return math.pi * self.module * math.cos(self.ring.pressure_angle)

    @property
    def working_pitch(self) -> float:
        """p_w = 2 pi r_w1 / z_1, mm."""
        return self.working_radii[0] * self.pinion.pitch_angle

    @cached_property
    def sides(self) -> tuple[ToothSide, RingSide]:
        """The exact tooth sides; raises ParameterError where a gear cannot be built."""
        return tooth_side(self.pinion), ring_side(self.ring)

    @property
    def root_form_radii(self) -> tuple[float, float]:
        """r_Ff, mm: where each involute gives way to the fillet; the ring's is its outer end."""
        return self._pinion_flank()[0], flank_ends(self.sides[1])[1]

    @property
    def tip_form_radii(self) -> tuple[float, float]:
        """r_Fa, mm: where each flank ends at the tip."""
        return self._pinion_flank()[1], flank_ends(self.sides[1])[0]

    def _pinion_flank(self, *, relief: bool = True) -> tuple[float, float]:
        labels = (Label.FLANK, Label.RELIEF) if relief else (Label.FLANK,)
        ends = [s.curve for s in self.sides[0].segments if s.label in labels]
        return abs(complex(ends[0].point(ends[0].domain[0]))), abs(complex(ends[-1].point(ends[-1].domain[1])))

    @property
    def tip_pressure_angles(self) -> tuple[float, float]:
        """alpha_a = arccos(r_b / r_Fa), rad."""
        tips, bases = self._tip_tangents(), (self.pinion.base_radius, self.ring.base_radius)
        return math.atan2(tips[0], bases[0]), math.atan2(tips[1], bases[1])

    @property
    def contact_ratio(self) -> float:
        """eps_alpha = (z_1 tan alpha_a1 - z_2 tan alpha_a2 + (z_2 - z_1) tan alpha_w) / 2 pi."""
        (one, two), (z1, z2) = self.tip_pressure_angles, self.teeth
        total = z1 * math.tan(one) - z2 * math.tan(two) + (z2 - z1) * math.tan(self.working_pressure_angle)
        return total / (2 * math.pi)

    @property
    def effective_contact_ratio(self) -> float:
        """eps_alpha between the ends of the active profiles: less where a fillet or a base circle ends a flank."""
        low, high = self._active_line()
        return (high - low) / self.base_pitch

    @property
    def arc_of_action(self) -> float:
        """Arc on the working circles while one pair of teeth is in contact, mm."""
        along = self._tip_tangents()[0] - (self._tip_tangents()[1] - self._line_of_action)
        return self.working_radii[0] * along / self.pinion.base_radius

    @property
    def contact_ratio_by_arc(self) -> float:
        """eps_alpha: the arc of action over the working pitch."""
        return self.arc_of_action / self.working_pitch

    @property
    def active_profile_radii(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Radii between which each flank is in contact, mm, the lesser first."""
        (low, high), line = self._active_line(), self._line_of_action
        one, two = self.pinion.base_radius, self.ring.base_radius
        return (
            (math.hypot(one, max(low - line, 0.0)), math.hypot(one, high - line)),
            (math.hypot(two, low), math.hypot(two, high)),
        )

    def _active_line(self) -> tuple[float, float]:
        """Where contact begins and ends on the line of action, mm from the ring's base circle."""
        line, tips, forms = self._line_of_action, self._tip_tangents(), self._form_tangents()
        return max(tips[1], line + forms[0]), min(line + tips[0], forms[1])

    @property
    def tip_clearances(self) -> tuple[float, float]:
        """Bottom clearance at the pinion's root and at the ring's, mm."""
        a_w = self.working_centre_distance
        return (
            self.ring.tip_radius - a_w - self.pinion.root_radius,
            self.ring.root_radius - a_w - self.pinion.tip_radius,
        )

    @property
    def tip_limits(self) -> tuple[float, float]:
        """Largest tip diameter of the pinion and least of the ring that keep off the mate's fillet, mm."""
        line, forms = self._line_of_action, self._form_tangents()
        most = math.hypot(self.pinion.base_radius, max(forms[1] - line, 0.0))
        return 2 * most, 2 * math.hypot(self.ring.base_radius, line + forms[0])

    def tip_diameters_at_clearance(self, clearance: float) -> tuple[float, float]:
        """Tip diameters, mm, that leave a bottom clearance, mm, at the mate's root; none is shortened of itself."""
        a_w = self.working_centre_distance
        return 2 * (self.ring.root_radius - a_w - clearance), 2 * (a_w + self.pinion.root_radius + clearance)

    @property
    def normal_backlash(self) -> float:
        """j_bt, mm (j_bn of spur gears): (A_1 + A_2) cos(alpha) - 2 (r_b2 - r_b1) (inv alpha_w - inv alpha_w0)."""
        return _normal_backlash(self.pinion, self.ring, self.working_pressure_angle)

    @property
    def circumferential_backlash(self) -> float:
        """j_wt = j_bn / cos(alpha_w), mm."""
        return self.normal_backlash / math.cos(self.working_pressure_angle)

    def pinion_rotation(self, ring_rotation: float, direction: float = 0.0, *, contact: int = 0) -> float:
        """Rotation of the pinion that brings a tooth of it into the middle of a space of the ring, rad.

        ``direction`` is that of the line of centres. ``contact`` = +1 or -1 turns the pinion on, counter-clockwise or
        clockwise, by half of the backlash: its flanks then touch. Not reduced to one turn.
        """
        turned = direction + (ring_rotation - direction) * self.gear_ratio
        return turned + contact * self.normal_backlash / (2 * self.pinion.base_radius)

    def ring_rotation(self, pinion_rotation: float, direction: float = 0.0, *, contact: int = 0) -> float:
        """The same for the ring, whose rotation brings a space of it about a tooth of the pinion, rad."""
        turned = direction + (pinion_rotation - direction) / self.gear_ratio
        return turned + contact * self.normal_backlash / (2 * self.ring.base_radius)

    @property
    def mesh(self) -> InternalMesh:
        """The numbers that decide on interference, with the tips where their flanks end."""
        bases = self.pinion.base_radius, self.ring.base_radius
        tips = self.pinion.tip_radius, self.ring.tip_radius
        return InternalMesh(self.teeth, bases, tips, self.working_centre_distance, self.working_pressure_angle)

    def margins(self) -> tuple[Margin, ...]:
        """The pair's limits, each with its margin (>= 0 where kept).

        Involute and trochoid interference and radial assembly (``InternalMesh``); ``fillet_interference_pinion`` and
        ``_ring``: where the mate's tip asks the flank to reach against where the involute ends, mm along the line of
        action; ``contact_ratio`` (effective) against 1; ``tip_clearance_*`` and ``normal_backlash`` against 0, mm. With
        little clearance a sharp tip may still strike the mate's fillet beside the flanks: ``internal_contact`` tells.
        """
        line, tips, forms = self._line_of_action, self._tip_tangents(), self._form_tangents()
        clearances, ratio, backlash = self.tip_clearances, self.effective_contact_ratio, self.normal_backlash
        asked = tips[1] - line, tips[0] + line
        return (
            *self.mesh.margins(),
            Margin("fillet_interference_pinion", asked[0], forms[0], asked[0] - forms[0]),
            Margin("fillet_interference_ring", asked[1], forms[1], forms[1] - asked[1]),
            Margin("contact_ratio", ratio, 1.0, ratio - 1.0),
            Margin("tip_clearance_pinion", clearances[0], 0.0, clearances[0]),
            Margin("tip_clearance_ring", clearances[1], 0.0, clearances[1]),
            Margin("normal_backlash", backlash, 0.0, backlash),
        )

    def findings(self) -> tuple[Finding, ...]:
        """The limits that are not kept; a margin within rounding of the ring's size counts as kept."""
        rounding = 1e3 * TOLERANCES.relative_rounding * self.ring.root_radius
        return tuple(Finding(m.name, m.value, m.limit) for m in self.margins() if m.margin < -rounding)

    @property
    def _line_of_action(self) -> float:
        """a_w sin(alpha_w): length between the points where the line of action touches the base circles, mm."""
        return self.working_centre_distance * math.sin(self.working_pressure_angle)

    def _tip_tangents(self) -> tuple[float, float]:
        """Length from each base circle to the flank's end at the tip, along the line of action, mm."""
        tips = self.tip_form_radii
        return _tangent(tips[0], self.pinion.base_radius), _tangent(tips[1], self.ring.base_radius)

    def _form_tangents(self) -> tuple[float, float]:
        """The same to the flank's end at the root."""
        forms = self.root_form_radii
        return _tangent(forms[0], self.pinion.base_radius), _tangent(forms[1], self.ring.base_radius)


def internal_pair(pinion: SpurGear, ring: RingGear, working_centre_distance: float | None = None) -> InternalPair:
    """The pair at zero backlash but for thinning, or at a given centre distance, mm. No tip is changed.

    inv(alpha_w) = inv(alpha) + 2 (x_2 - x_1) tan(alpha) / (z_2 - z_1), a_w = (r_b2 - r_b1) / cos(alpha_w).

    Raises
    ------
    ParameterError
        Modules or pressure angles differ, the pinion has as many teeth as the ring, no working angle exists, or the
        teeth would overlap at the centre distance. Each names the nearest value that works.
    """
    _check_mates(pinion, ring)
    angle = _working_angle(pinion, ring)
    base = ring.base_radius - pinion.base_radius
    distance = base / math.cos(angle)
    if working_centre_distance is not None:
        distance = _checked_distance(pinion, ring, working_centre_distance)
        angle = math.acos(base / distance)
    return InternalPair(pinion, ring, distance, angle)


def shift_difference(pinion: SpurGear, ring: RingGear, distance: float) -> float:
    """x_2 - x_1 of the pair without thinning at a wanted centre distance, mm."""
    base, alpha = ring.base_radius - pinion.base_radius, ring.pressure_angle
    if not distance >= base:
        raise ParameterError("working_centre_distance", distance, "no_working_angle", limit(base, distance, digits=6))
    teeth = ring.number_of_teeth - pinion.number_of_teeth
    gained = involute_function(math.acos(base / distance)) - involute_function(alpha)
    return gained * teeth / (2 * math.tan(alpha))


def internal_flank_gaps(pair: InternalPair, pinion_turn: Real, ring_turn: Real, distance: float) -> Real:
    """Closed form for the flanks at a centre distance (mm), for rotations (n,) of both gears (rad): (n, 2) mm.

    Columns: lower and upper flanks of the pinion's teeth, line of centres along +x from ring to pinion. The common
    normal touches both base circles: gap = r_b2 f2 - r_b1 f1 - a sin(alpha_w) with the roll angles f. inf where no
    common normal meets two flanks.
    """
    one, two = pair.pinion.base_radius, pair.ring.base_radius
    result = np.full((len(pinion_turn), 2), np.inf)
    if not distance > two - one:
        return result
    angle = math.acos((two - one) / distance)
    length, base_pitch = distance * math.sin(angle), pair.base_pitch
    low, high = (_tangent(r, one) for r in pair._pinion_flank(relief=False))
    least, most = (_tangent(r, two) for r in flank_ends(pair.sides[1]))
    # lower flanks face with normals that touch both base circles at the polar angle -psi of the other branch
    for column, sense in enumerate((1.0, -1.0)):
        reached = one * (angle - sense * pinion_turn + pair.pinion.base_half_angle)
        mate = two * (angle - sense * ring_turn + pair.ring.base_half_angle)
        gap = mate - reached - length
        gap = gap - np.round(gap / base_pitch) * base_pitch
        start = low + np.mod(reached - low, base_pitch)
        for k in range(math.ceil((high - low) / base_pitch) + 1):
            at = start + k * base_pitch
            roll = at + length + gap
            inside = (at <= high) & (roll >= least) & (roll <= most)
            result[inside, column] = gap[inside]
    return result


def _check_mates(pinion: SpurGear, ring: RingGear) -> None:
    if pinion.module != ring.module:
        raise ParameterError("module", ring.module, "not_that_of_pinion", Nearest(pinion.module))
    one, two = math.degrees(pinion.rack.pressure_angle), math.degrees(ring.pressure_angle)
    if abs(one - two) > 1e-12 * one:
        raise ParameterError("pressure_angle_deg", two, "not_that_of_pinion", Nearest(round(one, 12)))
    if pinion.number_of_teeth >= ring.number_of_teeth:
        least = Nearest(pinion.number_of_teeth + 1, "at_least")
        raise ParameterError("number_of_teeth", ring.number_of_teeth, "not_above_pinion_teeth", least)


def _zero_backlash_involute(pinion: SpurGear, ring: RingGear) -> float:
    """inv(alpha_w) of the pair without thinning."""
    difference = ring.profile_shift_coefficient - pinion.profile_shift_coefficient
    teeth = ring.number_of_teeth - pinion.number_of_teeth
    return involute_function(ring.pressure_angle) + 2 * difference * math.tan(ring.pressure_angle) / teeth


def _working_angle(pinion: SpurGear, ring: RingGear) -> float:
    value = _zero_backlash_involute(pinion, ring)
    if value >= 0:
        return inverse_involute(value).value
    alpha, teeth = ring.pressure_angle, ring.number_of_teeth - pinion.number_of_teeth
    least = pinion.profile_shift_coefficient - involute_function(alpha) * teeth / (2 * math.tan(alpha))
    x = ring.profile_shift_coefficient
    cure = limit(least, x, digits=6)
    raise ParameterError("profile_shift_coefficient", x, "no_working_angle_with_pinion", cure, involute=value)


def _normal_backlash(pinion: SpurGear, ring: RingGear, angle: float) -> float:
    thinning = pinion.circumferential_thinning + ring.circumferential_thinning
    closed = involute_function(angle) - _zero_backlash_involute(pinion, ring)
    # the inverse involute function leaves a few roundings: at the distance of the shifts there is nothing else
    if abs(closed) < 16 * TOLERANCES.relative_root:
        closed = 0.0
    return thinning * math.cos(ring.pressure_angle) - 2 * (ring.base_radius - pinion.base_radius) * closed


def _checked_distance(pinion: SpurGear, ring: RingGear, distance: float) -> float:
    base = ring.base_radius - pinion.base_radius
    if not distance >= base:
        raise ParameterError("working_centre_distance", distance, "no_working_angle", limit(base, distance, digits=6))
    if _normal_backlash(pinion, ring, math.acos(base / distance)) >= -1e-12 * distance:
        return distance
    thinning = pinion.circumferential_thinning + ring.circumferential_thinning
    spare = thinning * math.cos(ring.pressure_angle) / (2 * base)
    angle = inverse_involute(max(_zero_backlash_involute(pinion, ring) + spare, 0.0)).value
    most = limit(base / math.cos(angle), distance, digits=6)
    raise ParameterError("working_centre_distance", distance, "teeth_overlap", most)


def _tangent(radius: float, base: float) -> float:
    """sqrt(r^2 - r_b^2), mm."""
    return math.sqrt(max((radius - base) * (radius + base), 0.0))
