"""The external spur pair: working angle, centre distance, tip shortening, contact ratio, backlash, phase.

Frame: the first gear's axis is the origin, the second gear's lies at ``working_centre_distance`` in the given
direction. Symbols are those of ISO 21771; equation numbers those of the practicum, lesson 3 (seed 000).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from geometry.base.angles import inverse_involute, involute_function
from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.findings import Finding
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import Curve, Real, end_point, start_point
from geometry.gears.teeth.limits import Margin, undercut
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import ToothSide, tooth_side
from geometry.plane.profile import Label

# more than which the sought limit is exceeded when a printed one is typed back
_NEAREST_DIGITS = 6


@dataclass(frozen=True)
class ExternalPair:
    """Two external spur gears in mesh; made by ``external_pair``.

    ``first`` and ``second`` carry their shortened tips. Lengths in mm, angles in rad, coefficients in modules;
    results for both gears are tuples (first, second).
    """

    first: SpurGear
    second: SpurGear
    working_centre_distance: float
    working_pressure_angle: float
    tip_shortening_coefficient: float

    @property
    def module(self) -> float:
        """m, mm."""
        return self.first.module

    @property
    def gears(self) -> tuple[SpurGear, SpurGear]:
        """Both gears."""
        return self.first, self.second

    @property
    def gear_ratio(self) -> float:
        """u = z2 / z1; practicum (3.2)."""
        return self.second.number_of_teeth / self.first.number_of_teeth

    @property
    def reference_centre_distance(self) -> float:
        """a = r1 + r2, mm."""
        return self.first.reference_radius + self.second.reference_radius

    @property
    def centre_distance_coefficient(self) -> float:
        """y = (a_w - a) / m."""
        return (self.working_centre_distance - self.reference_centre_distance) / self.module

    @property
    def working_radii(self) -> tuple[float, float]:
        """r_w1, r_w2, mm; practicum (3.5), (3.6)."""
        a_w, u = self.working_centre_distance, self.gear_ratio
        return a_w / (u + 1), a_w * u / (u + 1)

    @property
    def base_pitch(self) -> float:
        """p_b = pi m cos(alpha), mm: the pitch along the line of action; ISO 21771."""
        return math.pi * self.module * math.cos(self.first.rack.pressure_angle)

    @property
    def working_pitch(self) -> float:
        """p_w = 2 pi r_w1 / z1, mm."""
        return self.working_radii[0] * self.first.pitch_angle

    @cached_property
    def sides(self) -> tuple[ToothSide, ToothSide]:
        """The exact tooth sides.

        Raises
        ------
        ParameterError
            A gear of the pair cannot be built.
        """
        return tooth_side(self.first), tooth_side(self.second)

    @property
    def root_form_radii(self) -> tuple[float, float]:
        """r_Ff, mm: where each involute begins."""
        return _flank_start(self.sides[0]), _flank_start(self.sides[1])

    @property
    def tip_form_radii(self) -> tuple[float, float]:
        """r_Fa, mm: where each flank (relief included) ends; the tip radius unless the tip is broken."""
        return _flank_end(self.sides[0]), _flank_end(self.sides[1])

    @property
    def tip_pressure_angles(self) -> tuple[float, float]:
        """alpha_a = arccos(r_b / r_Fa), rad; practicum (3.18), (3.19)."""
        first, second = (math.atan2(t, g.base_radius) for t, g in zip(self._tip_tangents(), self.gears, strict=True))
        return first, second

    @property
    def contact_ratio(self) -> float:
        """eps_alpha from the angles at the tips, relieved flanks counted; practicum (3.20), ISO 21771."""
        return self._ratio_between(*self.tip_pressure_angles)

    @property
    def main_flank_contact_ratio(self) -> float:
        """eps_alpha of the main flanks alone: equal to ``contact_ratio`` where no tip is relieved."""
        ends = (_flank_end(s, relief=False) for s in self.sides)
        angles = [math.acos(g.base_radius / r) for r, g in zip(ends, self.gears, strict=True)]
        return self._ratio_between(*angles)

    def _ratio_between(self, first_tip: float, second_tip: float) -> float:
        z1, z2 = self.first.number_of_teeth, self.second.number_of_teeth
        tangents = z1 * math.tan(first_tip) + z2 * math.tan(second_tip)
        return (tangents - (z1 + z2) * math.tan(self.working_pressure_angle)) / (2 * math.pi)

    @property
    def effective_contact_ratio(self) -> float:
        """eps_alpha between the ends of the active profiles: less than by (3.20) where a flank is cut away."""
        low, high = self._active_line()
        return (high - low) / self.base_pitch

    @property
    def arc_of_action(self) -> float:
        """Arc dd' on the working circles while one pair of teeth is in contact, mm; practicum, figure 3.13."""
        starts, tips = self._start_tangents(), self._tip_tangents()
        return self.working_radii[0] * (tips[0] - starts[0]) / self.first.base_radius

    @property
    def contact_ratio_by_arc(self) -> float:
        """eps_alpha = dd' / p_w; practicum (3.21)."""
        return self.arc_of_action / self.working_pitch

    @property
    def active_profile_radii(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Radii at which each gear's active profile starts and ends, mm; ISO 21771 (d_Nf, d_Na).

        Where the mate's tip asks for more than the involute has, the root form circle or the base circle bounds it.
        """
        (low, high), line = self._active_line(), self._line_of_action
        one, two = self.first.base_radius, self.second.base_radius
        return (
            (math.hypot(one, low), math.hypot(one, high)),
            (math.hypot(two, line - high), math.hypot(two, line - low)),
        )

    def _active_line(self) -> tuple[float, float]:
        """Where contact begins and ends on the line of action, mm from the first gear's base circle."""
        asked, forms, tips = self._start_tangents(), self._form_tangents(), self._tip_tangents()
        return max(asked[0], forms[0]), min(tips[0], self._line_of_action - forms[1])

    @property
    def tip_clearances(self) -> tuple[float, float]:
        """Bottom clearance at the root of the first and of the second gear, mm: a_w - r_f - r_a of the mate."""
        a_w = self.working_centre_distance
        return (
            a_w - self.first.root_radius - self.second.tip_radius,
            a_w - self.second.root_radius - self.first.tip_radius,
        )

    @property
    def normal_backlash(self) -> float:
        """j_bt, mm (j_bn of spur gears): play along the line of action, from thinning and centre distance.

        j_bt = (A_1 + A_2) cos(alpha) + 2 (r_b1 + r_b2) (inv alpha_w - inv alpha_w0), alpha_w0 from (3.3).
        """
        return _normal_backlash(self.first, self.second, self.working_pressure_angle)

    @property
    def circumferential_backlash(self) -> float:
        """j_wt = j_bn / cos(alpha_w), mm: play as an arc on the working circles; ISO 21771."""
        return self.normal_backlash / math.cos(self.working_pressure_angle)

    def second_rotation(self, first_rotation: float, direction: float = 0.0, *, contact: int = 0) -> float:
        """Rotation of the second gear that brings a tooth of one into the middle of a space of the other, rad.

        ``first_rotation`` is the first gear's, ``direction`` that of the line of centres (both rad, from +x).
        ``contact`` = +1 or -1 turns the second gear on, counter-clockwise or clockwise, by half of the backlash:
        its flanks then touch. The result is not reduced to one turn: it runs on as the first gear turns.
        """
        z1, z2 = self.first.number_of_teeth, self.second.number_of_teeth
        middle = direction + math.pi - math.pi / z2 - (first_rotation - direction) * z1 / z2
        return middle + contact * self.normal_backlash / (2 * self.second.base_radius)

    def margins(self) -> tuple[Margin, ...]:
        """The pair's own limits, each with its margin (>= 0 where kept); practicum 3.1, blocking contours.

        ``fillet_interference_*``: where the mate's tip asks the active profile to start against where the
        involute starts, both in mm along the line of action from the base circle (exact for a rounded rack:
        the limit comes from the root form circle). The same for an undercut gear is ``active_flank_cut_away_*``: the
        flank asked for is missing, which costs contact ratio; whether the mate's tip strikes the fillet only
        ``pair_contact`` tells. ``contact_ratio`` (effective) against 1; ``tip_clearance_*`` and
        ``normal_backlash`` against 0, mm.
        """
        starts, forms, clearances = self._start_tangents(), self._form_tangents(), self.tip_clearances
        ratio, backlash = self.effective_contact_ratio, self.normal_backlash
        names = ["active_flank_cut_away" if undercut(g).margin < 0 else "fillet_interference" for g in self.gears]
        return (
            Margin(f"{names[0]}_first", starts[0], forms[0], starts[0] - forms[0]),
            Margin(f"{names[1]}_second", starts[1], forms[1], starts[1] - forms[1]),
            Margin("contact_ratio", ratio, 1.0, ratio - 1.0),
            Margin("tip_clearance_first", clearances[0], 0.0, clearances[0]),
            Margin("tip_clearance_second", clearances[1], 0.0, clearances[1]),
            Margin("normal_backlash", backlash, 0.0, backlash),
        )

    def findings(self) -> tuple[Finding, ...]:
        """The limits that are not kept; a margin within rounding of the centre distance counts as kept."""
        rounding = 1e3 * TOLERANCES.relative_rounding * self.working_centre_distance
        return tuple(Finding(m.name, m.value, m.limit) for m in self.margins() if m.margin < -rounding)

    @property
    def _line_of_action(self) -> float:
        """a_w sin(alpha_w): length between the points where the line of action touches the base circles, mm."""
        return self.working_centre_distance * math.sin(self.working_pressure_angle)

    def _tip_tangents(self) -> tuple[float, float]:
        """Length from the base circle to each gear's last flank point, along the line of action, mm."""
        tips = self.tip_form_radii
        return _tangent(tips[0], self.first), _tangent(tips[1], self.second)

    def _form_tangents(self) -> tuple[float, float]:
        """The same to each gear's first flank point."""
        forms = self.root_form_radii
        return _tangent(forms[0], self.first), _tangent(forms[1], self.second)

    def _start_tangents(self) -> tuple[float, float]:
        """The same to where the mate's tip touches; negative beyond the base circle's point of contact."""
        tips, line = self._tip_tangents(), self._line_of_action
        return line - tips[1], line - tips[0]


def external_pair(first: SpurGear, second: SpurGear, working_centre_distance: float | None = None) -> ExternalPair:
    """The pair of two gears at zero backlash but for their thinning, or at a given centre distance, mm.

    Working angle by (3.3), centre distance by (3.4), tips shortened by Delta y = x1 + x2 - y where that is
    positive, by (3.11), (3.12): gears with a given tip diameter keep it, and no tip is ever lengthened.

    Raises
    ------
    ParameterError
        Modules or pressure angles differ; no working angle exists (inv alpha_w < 0); the centre distance leaves
        no room for the teeth. Each names the nearest value that works.
    """
    _check_mates(first, second)
    angle = _working_angle(first, second)
    base = first.base_radius + second.base_radius
    distance = base / math.cos(angle)
    if working_centre_distance is not None:
        distance = _checked_distance(first, second, working_centre_distance)
        angle = math.acos(base / distance)
    x_sum = first.profile_shift_coefficient + second.profile_shift_coefficient
    reference = first.reference_radius + second.reference_radius
    shortening = x_sum - (distance - reference) / first.module
    return ExternalPair(_shortened(first, shortening), _shortened(second, shortening), distance, angle, shortening)


def flank_gaps(pair: ExternalPair, first_rotation: Real, second_rotation: Real, distance: float) -> Real:
    """Closed form for the main flanks at a centre distance (mm), for rotations (n,) of both gears (rad): (n, 2) mm.

    Columns: lower and upper flanks of the first gear's teeth, line of centres along +x. The common normal touches
    both base circles: gap = a sin(alpha_w) - r_b1 f1 - r_b2 f2 with the roll angles f (``contact.involute_gap``); the
    teeth that face each other are those with the least. inf where no common normal meets two flanks.
    """
    gears, base_pitch = pair.gears, pair.base_pitch
    one, two = (g.base_radius for g in gears)
    result = np.full((len(first_rotation), 2), np.inf)
    if not distance > one + two:
        return result
    angle = math.acos((one + two) / distance)
    length = distance * math.sin(angle)
    (low, high), (least, most) = (_flanks(side, relief=False)[0].domain for side in pair.sides)
    for column, sense in enumerate((1.0, -1.0)):
        reached = one * (angle - sense * first_rotation + gears[0].base_half_angle)
        mate = two * (angle - sense * (second_rotation - math.pi) + gears[1].base_half_angle)
        gap = length - reached - mate
        gap = gap - np.round(gap / base_pitch) * base_pitch
        start = low * one + np.mod(reached - low * one, base_pitch)
        for k in range(math.ceil((high - low) * one / base_pitch) + 1):
            at = start + k * base_pitch
            roll = (length - gap - at) / two
            inside = (at <= high * one) & (roll >= least) & (roll <= most)
            result[inside, column] = gap[inside]
    return result


def _check_mates(first: SpurGear, second: SpurGear) -> None:
    if first.module != second.module:
        raise ParameterError("module", second.module, "not_that_of_first", Nearest(first.module))
    one, two = (math.degrees(g.rack.pressure_angle) for g in (first, second))
    if abs(one - two) > 1e-12 * one:
        raise ParameterError("pressure_angle_deg", two, "not_that_of_first", Nearest(round(one, 12)))


def _zero_backlash_involute(first: SpurGear, second: SpurGear) -> float:
    """inv(alpha_w) of the pair without thinning; practicum (3.3)."""
    alpha = first.rack.pressure_angle
    x_sum = first.profile_shift_coefficient + second.profile_shift_coefficient
    teeth = first.number_of_teeth + second.number_of_teeth
    return involute_function(alpha) + 2 * x_sum * math.tan(alpha) / teeth


def _working_angle(first: SpurGear, second: SpurGear) -> float:
    value = _zero_backlash_involute(first, second)
    if value >= 0:
        return inverse_involute(value).value
    alpha, teeth = first.rack.pressure_angle, first.number_of_teeth + second.number_of_teeth
    least = -involute_function(alpha) * teeth / (2 * math.tan(alpha)) - first.profile_shift_coefficient
    x = second.profile_shift_coefficient
    cure = limit(least, x, digits=_NEAREST_DIGITS)
    raise ParameterError("profile_shift_coefficient", x, "no_working_angle_with_first", cure, involute=value)


def _normal_backlash(first: SpurGear, second: SpurGear, angle: float) -> float:
    thinning = first.circumferential_thinning + second.circumferential_thinning
    base = first.base_radius + second.base_radius
    opened = involute_function(angle) - _zero_backlash_involute(first, second)
    # the inverse involute function leaves a few roundings: at the distance of (3.4) there is nothing else
    if abs(opened) < 16 * TOLERANCES.relative_root:
        opened = 0.0
    return thinning * math.cos(first.rack.pressure_angle) + 2 * base * opened


def _checked_distance(first: SpurGear, second: SpurGear, distance: float) -> float:
    base = first.base_radius + second.base_radius
    if distance >= base and _normal_backlash(first, second, math.acos(base / distance)) >= -1e-12 * distance:
        return distance
    thinning = first.circumferential_thinning + second.circumferential_thinning
    spare = thinning * math.cos(first.rack.pressure_angle) / (2 * base)
    angle = inverse_involute(max(_zero_backlash_involute(first, second) - spare, 0.0)).value
    least = limit(base / math.cos(angle), distance, digits=_NEAREST_DIGITS)
    raise ParameterError("working_centre_distance", distance, "teeth_overlap", least)


def _shortened(gear: SpurGear, shortening: float) -> SpurGear:
    """The gear with its tip radius by (3.11); a given tip diameter stays, a tip is never lengthened."""
    if gear.given_tip_diameter is not None or shortening <= 0:
        return gear
    return replace(gear, given_tip_diameter=2 * (gear.tip_radius - shortening * gear.module))


def _tangent(radius: float, gear: SpurGear) -> float:
    """sqrt(r^2 - r_b^2), mm."""
    base = gear.base_radius
    return math.sqrt(max((radius - base) * (radius + base), 0.0))


def _flanks(side: ToothSide, *, relief: bool = True) -> list[Curve]:
    labels = (Label.FLANK, Label.RELIEF) if relief else (Label.FLANK,)
    return [s.curve for s in side.segments if s.label in labels]


def _flank_start(side: ToothSide) -> float:
    return abs(start_point(_flanks(side)[0]))


def _flank_end(side: ToothSide, *, relief: bool = True) -> float:
    return abs(end_point(_flanks(side, relief=relief)[-1]))
