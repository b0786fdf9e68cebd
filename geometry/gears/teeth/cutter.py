"""The pinion cutter (gear shaper cutter): an external involute tooth whose tip corner is rounded."""

from __future__ import annotations

import cmath
import math
from functools import cached_property

from geometry.base.angles import inverse_involute, involute_function, roll_minus_polar, tangent_length
from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.record import replace
from geometry.base.roots import bracketed_root
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import end_point
from geometry.curves.cutter_fillet import CutterFillet
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc, arc_between
from geometry.gears.teeth.involute_teeth import InvoluteTeeth
from geometry.plane.profile import Label, Segment

# the addendum of a cutter is the dedendum of what it cuts: h_a + c of ISO 53 A
CUTTER_ADDENDUM = 1.25
# beyond, the rounding of the cutter's own radius shows in the tooth it cuts
MOST_CUTTER_TEETH = 10_000
# modules; the corner that shaper cutters commonly have where the tooth has room for it
CUTTER_ROUNDING = 0.2


def cutting_angle(alpha: float, shift: float, teeth: int, own_shift: float, cutter_shift: float) -> float:
    """alpha_w0 of a cut without backlash, rad: inv(alpha_w0) = inv(alpha) + 2 x tan(alpha) / z.

    ``shift`` and ``teeth``: sums of the gear's and the cutter's, of a ring differences; ``own_shift``: the gear's,
    ``cutter_shift``: the cutter's, which is blamed where it is the larger.

    Raises
    ------
    ParameterError
        No such angle exists; names the nearest shift that has one.
    """
    value = involute_function(alpha) + 2 * shift * math.tan(alpha) / teeth
    if value < 0:
        name, given, lack = "profile_shift_coefficient", own_shift, -value * teeth / (2 * math.tan(alpha))
        if abs(cutter_shift) > abs(own_shift):
            name, given, lack = f"cutter.{name}", cutter_shift, math.copysign(lack, -cutter_shift)
        raise ParameterError.beyond(name, given, "no_working_angle_with_cutter", given + lack)
    return inverse_involute(value)


def cut_fillet(gear: InvoluteTeeth, cutter: PinionCutter, distance: float, angle: float) -> CutterFillet:
    """The lower root fillet that a cutter leaves at a ``distance`` of the axes, mm, rolling at an ``angle``, rad.

    It begins in the middle of a space: of a ring that of space 1, runs clockwise there, material on its left.
    """
    total = gear.number_of_teeth + gear.sign * cutter.number_of_teeth
    pitch_radius, rolling = distance * gear.number_of_teeth / total, distance * cutter.number_of_teeth / total
    middle = -gear.pitch_angle / 2 if gear.sign > 0 else 0.0
    land = middle + gear.sign * cutter.corner_angle * rolling / pitch_radius
    depth, end = cutter.corner_radius - rolling, math.pi / 2 - angle
    return CutterFillet(pitch_radius, -gear.sign * rolling, depth, cutter.rounding_radius, land, 0.0, end)


class PinionCutter(InvoluteTeeth, dict=True):
    """Pinion cutter; module in mm, pressure angle in rad, the rest in modules.

    Frame: axis at the origin, tooth 1 centred on +x. The tip circle is r_0 + (addendum + x_0) m; each tip corner is an
    arc that touches flank and tip circle. ``widening`` (mm) is what each flank stands farther out than standard,
    measured on the reference circle: it widens the space that is cut.
    """

    pressure_angle: float
    profile_shift_coefficient: float = 0.0
    addendum: float = CUTTER_ADDENDUM
    tip_rounding: float = CUTTER_ROUNDING
    widening: float = 0.0

    @property
    def tip_radius(self) -> float:
        """r_a0 = r_0 + (h_a0 + x_0) m."""
        return self.reference_radius + (self.addendum + self.profile_shift_coefficient) * self.module

    @property
    def rounding_radius(self) -> float:
        """rho in mm."""
        return self.tip_rounding * self.module

    @property
    def corner_radius(self) -> float:
        """c: distance of the rounding's centre from the axis, mm."""
        return self.tip_radius - self.rounding_radius

    @cached_property
    def base_half_angle(self) -> float:
        """Half of the tooth's angle on the base circle, rad."""
        shift = self.profile_shift_coefficient * self.module * math.tan(self.pressure_angle)
        half = math.pi / 4 * self.module + shift + self.widening
        return half / self.reference_radius + involute_function(self.pressure_angle)

    @cached_property
    def corner_angle(self) -> float:
        """Angle of the rounding's centre from the tooth's centre line, rad; 0: full round, negative: no fit."""
        return self._corner_angle(self.rounding_radius)

    def _corner_angle(self, rounding: float) -> float:
        """The same for a rounding in mm: the centre lies on the flank moved into the tooth by it."""
        base = self.base_radius
        reach = tangent_length(self.tip_radius - rounding, base)
        return self.base_half_angle - rounding / base - roll_minus_polar(reach / base)

    @cached_property
    def form_length(self) -> float:
        """Length from the base circle to where the flank gives way to the rounding, along the flank's normal, mm."""
        return tangent_length(self.corner_radius, self.base_radius) + self.rounding_radius

    def largest_rounding(self) -> float:
        """The tip rounding, in modules, at which both corners of a tooth meet, or that starts at the base circle."""
        if self._corner_angle(0.0) <= 0:
            return 0.0
        most = self.tip_radius - self.base_radius
        if self._corner_angle(most) >= 0:
            return most / self.module
        return bracketed_root(self._corner_angle, 0.0, most).value / self.module

    def side(self) -> tuple[Segment, ...]:
        """The lower side of tooth 1 from base circle to centre line: flank, rounding, half of the tip land."""
        base, half = self.base_radius, self.base_half_angle
        flank = Involute(base, -half, 0.0, self.form_length / base)
        centre = cmath.rect(self.corner_radius, -self.corner_angle)
        corner = cmath.rect(self.tip_radius, -self.corner_angle)
        segments = [Segment(flank, Label.FLANK)]
        if self.rounding_radius > TOLERANCES.relative_length * self.tip_radius:
            segments.append(Segment(arc_between(centre, end_point(flank), corner, turns_left=True), Label.TIP_BREAK))
        if self.corner_angle > TOLERANCES.relative_length:
            segments.append(Segment(Arc(0j, self.tip_radius, -self.corner_angle, self.corner_angle), Label.TIP_LAND))
        return tuple(segments)


def full_round(cutter: PinionCutter) -> PinionCutter:
    """The cutter with the largest tip rounding that its tooth takes."""
    return replace(cutter, tip_rounding=cutter.largest_rounding())


# of a tooth that cannot be: more teeth may do what no addendum and no rounding does
CUTTER_TOOTH = frozenset({"cutter.addendum", "cutter.tip_rounding"})


def checked_cutter(cutter: PinionCutter) -> PinionCutter:
    """The cutter itself, or a refusal that names the nearest value that works.

    Raises
    ------
    ParameterError
        A value is no dimension, the tooth is pointed below its tip circle, or the rounding does not fit.
    """
    _check_numbers(cutter)
    if cutter.tip_radius <= cutter.base_radius:
        least = (cutter.base_radius - cutter.reference_radius) / cutter.module - cutter.profile_shift_coefficient
        raise ParameterError.beyond("cutter.addendum", cutter.addendum, "cutter_tip_below_base", least + 1e-4)
    sharp = replace(cutter, tip_rounding=0.0)
    if sharp.corner_angle < 0:
        most = _most_addendum(sharp)
        lower = limit(most, cutter.addendum) if most > 0 else None
        raise ParameterError("cutter.addendum", cutter.addendum, "cutter_tooth_pointed", lower)
    largest = cutter.largest_rounding()
    if cutter.tip_rounding > largest * (1 + 1e-12):
        raise ParameterError.beyond("cutter.tip_rounding", cutter.tip_rounding, "cutter_rounding_does_not_fit", largest)
    return cutter


def _check_numbers(cutter: PinionCutter) -> None:
    if not 3 <= cutter.number_of_teeth <= MOST_CUTTER_TEETH:
        near = Nearest(3, "at_least") if cutter.number_of_teeth < 3 else Nearest(MOST_CUTTER_TEETH, "at_most")
        raise ParameterError("cutter.number_of_teeth", cutter.number_of_teeth, "no_such_cutter_teeth", near)
    if not 0 < cutter.pressure_angle < math.pi / 2:
        raise ParameterError("pressure_angle", cutter.pressure_angle, "not_below_right_angle")
    if not 0 < cutter.module < math.inf:
        raise ParameterError("module", cutter.module, "not_finite_above_zero")
    if not math.isfinite(cutter.profile_shift_coefficient):
        x = cutter.profile_shift_coefficient
        raise ParameterError("cutter.profile_shift_coefficient", x, "not_finite", Nearest(0.0))
    for name, value in (("addendum", cutter.addendum), ("tip_rounding", cutter.tip_rounding)):
        if not 0 <= value < math.inf:
            raise ParameterError(f"cutter.{name}", value, "not_finite_or_negative")


def _most_addendum(sharp: PinionCutter) -> float:
    """The addendum, in modules, at which both flanks of the tooth meet."""

    def width(addendum: float) -> float:
        return replace(sharp, addendum=addendum).corner_angle

    low = (sharp.base_radius - sharp.reference_radius) / sharp.module - sharp.profile_shift_coefficient
    low = max(low + 1e-9, 0.0)
    if width(low) <= 0:
        return 0.0
    return bracketed_root(width, low, sharp.addendum).value
