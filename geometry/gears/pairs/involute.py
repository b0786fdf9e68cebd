"""The involute pair, external or a pinion in its ring: one set of formulas, ISO 21771's for signed tooth numbers.

A ring has a negative tooth number there, and with it negative radii and the opposite sign of its profile shift. Outside
this file nothing is negative, and a ring's shift is positive away from its axis (GOST 19274): ``signed`` goes between
both. The practicum's numbers (lesson 3) are those of its equations for external pairs.

Frame: the first gear's axis is the origin, or the ring's; the other lies at ``working_centre_distance`` in the given
direction, and so does the mesh.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import cached_property, lru_cache
from typing import Any, ClassVar, Generic, NamedTuple, TypeVar

import numpy as np

from geometry.base.angles import inverse_involute, involute_function, tangent_length
from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.findings import Finding
from geometry.base.nearest import kept
from geometry.base.record import Record, replace
from geometry.base.tolerance import TOLERANCES, is_told
from geometry.curves.curve import Real
from geometry.gears.pairs.corners import Passing
from geometry.gears.teeth.limits import Margin, not_kept
from geometry.gears.teeth.ring import RingGear
from geometry.gears.teeth.ring_tooth import RingSide
from geometry.gears.teeth.side import Side
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import ToothSide, tooth_side
from geometry.plane.distance import Flags

# to which the sought limit is given, so that it works when a printed one is typed back
_NEAREST_DIGITS = 6
# modules by which tips that yield keep off where they would touch a fillet or a root, and mm that are rounding
_OFF_ROOT, _SAME = 0.005, 1e-9

Gear = SpurGear | RingGear
G = TypeVar("G", bound=Gear)
S = TypeVar("S", bound=ToothSide | RingSide)


class Signed(NamedTuple):
    """Tooth number, shift coefficient, reference and base radius (mm) as ISO 21771 has them: a ring's negated."""

    teeth: int
    shift: float
    reference_radius: float
    base_radius: float


def signed(gear: Gear) -> Signed:
    """A gear's numbers with the signs of ISO 21771; the same change of sign leads back."""
    sign = gear.sign
    return Signed(
        sign * gear.number_of_teeth,
        sign * gear.profile_shift_coefficient,
        sign * gear.reference_radius,
        sign * gear.base_radius,
    )


class InvolutePair(Record, Generic[G, S], dict=True):
    """Two gears in mesh at a centre distance; lengths in mm, angles in rad, coefficients in modules.

    Results for both gears are tuples (first, second).
    """

    first: SpurGear
    second: G
    working_centre_distance: float
    working_pressure_angle: float

    # how the limits name both gears
    roles: ClassVar[tuple[str, str]] = ("first", "second")

    @property
    def sign(self) -> int:
        """Of the second gear's tooth number: 1 external, -1 in a ring."""
        return self.second.sign

    @property
    def module(self) -> float:
        """m, mm."""
        return self.first.module

    @property
    def gears(self) -> tuple[SpurGear, G]:
        """Both gears."""
        return self.first, self.second

    @property
    def teeth(self) -> tuple[int, int]:
        """Numbers of teeth, without signs."""
        return self.first.number_of_teeth, self.second.number_of_teeth

    @property
    def gear_ratio(self) -> float:
        """u = z2 / z1 without its sign; practicum (3.2). Both gears of an internal pair turn the same way."""
        return self.second.number_of_teeth / self.first.number_of_teeth

    @property
    def reference_centre_distance(self) -> float:
        """a = r1 + r2, mm; r2 - r1 in a ring."""
        return abs(self.first.reference_radius + signed(self.second).reference_radius)

    @property
    def centre_distance_coefficient(self) -> float:
        """y = (a_w - a) / m."""
        return (self.working_centre_distance - self.reference_centre_distance) / self.module

    @property
    def working_radii(self) -> tuple[float, float]:
        """r_w1, r_w2, mm; practicum (3.5), (3.6)."""
        a_w, u = self.working_centre_distance, self.gear_ratio
        return a_w / (u + self.sign), a_w * u / (u + self.sign)

    @property
    def base_pitch(self) -> float:
        """p_b = pi m cos(alpha), mm: the pitch along the line of action; ISO 21771."""
        return math.pi * self.module * math.cos(self.first.rack.pressure_angle)

    @property
    def working_pitch(self) -> float:
        """p_w = 2 pi r_w1 / z1, mm."""
        return self.working_radii[0] * self.first.pitch_angle

    @cached_property
    def first_side(self) -> ToothSide:
        """The exact side of the first gear's teeth; raises ParameterError where it cannot be built."""
        return tooth_side(self.first)

    @property
    def second_side(self) -> S:
        """That of the second's teeth or, of a ring, spaces; raises ParameterError where it cannot be built."""
        raise NotImplementedError

    @property
    def sides(self) -> tuple[ToothSide, S]:
        """Both sides."""
        return self.first_side, self.second_side

    @property
    def root_form_radii(self) -> tuple[float, float]:
        """r_Ff, mm: where each involute gives way to the fillet; the ring's is its outer end."""
        return self.first_side.flank_radii()[0], self.second_side.flank_radii()[0]

    @property
    def tip_form_radii(self) -> tuple[float, float]:
        """r_Fa, mm: where each flank (relief included) ends; the tip radius unless the tip is broken."""
        return self.first_side.flank_radii(relief=True)[1], self.second_side.flank_radii(relief=True)[1]

    @property
    def tip_pressure_angles(self) -> tuple[float, float]:
        """alpha_a = arccos(r_b / r_Fa), rad; practicum (3.18), (3.19)."""
        one, two = self._tip_tangents()
        return math.atan2(one, self.first.base_radius), math.atan2(two, self.second.base_radius)

    @property
    def contact_ratio(self) -> float:
        """eps_alpha from the angles at the tips, relieved flanks counted; practicum (3.20), ISO 21771."""
        return self._ratio_between(*self.tip_pressure_angles)

    def _ratio_between(self, first_tip: float, second_tip: float) -> float:
        """(z1 tan(alpha_a1) + z2 tan(alpha_a2) - (z1 + z2) tan(alpha_w)) / (2 pi)."""
        z1, z2 = self.first.number_of_teeth, signed(self.second).teeth
        tangents = z1 * math.tan(first_tip) + z2 * math.tan(second_tip)
        return (tangents - (z1 + z2) * math.tan(self.working_pressure_angle)) / (2 * math.pi)

    @property
    def effective_contact_ratio(self) -> float:
        """eps_alpha between the ends of the active profiles: less where a fillet or a base circle ends a flank."""
        low, high = self.active_line
        return (high - low) / self.base_pitch

    @property
    def arc_of_action(self) -> float:
        """Arc dd' on the working circles while one pair of teeth is in contact, mm; practicum, figure 3.13."""
        along = self._tip_tangents()[0] - self._start_tangents()[0]
        return self.working_radii[0] * along / self.first.base_radius

    @property
    def contact_ratio_by_arc(self) -> float:
        """eps_alpha = dd' / p_w; practicum (3.21)."""
        return self.arc_of_action / self.working_pitch

    @property
    def active_profile_radii(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Radii between which each flank is in contact, mm, the lesser first; ISO 21771 (d_Nf, d_Na).

        Where the mate's tip asks for more than the involute has, the root form circle or the base circle bounds it.
        """
        active, line = self.active_line, self._line_of_action
        (low, high), two = active, self.second.base_radius
        ends = [math.hypot(two, line - self.sign * at) for at in active[:: -self.sign]]
        one = self.first.base_radius
        return (math.hypot(one, low), math.hypot(one, high)), (ends[0], ends[1])

    @property
    def active_line(self) -> tuple[float, float]:
        """Where contact begins and ends on the line of action, mm from the first gear's base circle."""
        asked, forms, tips = self._start_tangents(), self._form_tangents(), self._tip_tangents()
        return max(asked[0], forms[0]), min(tips[0], self.sign * (self._line_of_action - forms[1]))

    @property
    def tip_clearances(self) -> tuple[float, float]:
        """Bottom clearance at the root of the first and of the second gear, mm: a_w - r_f - r_a of the mate, signed."""
        a_w, sign = self.sign * self.working_centre_distance, self.sign
        return (
            a_w - self.first.root_radius - sign * self.second.tip_radius,
            a_w - sign * self.second.root_radius - self.first.tip_radius,
        )

    @property
    def normal_backlash(self) -> float:
        """j_bt, mm (j_bn of spur gears): play along the line of action, from thinning and centre distance.

        j_bt = (A_1 + A_2) cos(alpha) + 2 (r_b1 + r_b2) (inv alpha_w - inv alpha_w0), alpha_w0 from (3.3).
        """
        return Sums.of(self.first, self.second).normal_backlash(self.working_pressure_angle)

    @property
    def touching_distance(self) -> float:
        """At which both would have no backlash, mm."""
        return Sums.of(self.first, self.second).touching_distance

    @property
    def circumferential_backlash(self) -> float:
        """j_wt = j_bn / cos(alpha_w), mm: play as an arc on the working circles; ISO 21771."""
        return self.normal_backlash / math.cos(self.working_pressure_angle)

    @property
    def facing(self) -> float:
        """The direction in which the second gear sees the mesh, from the line of centres, rad."""
        return math.pi if self.sign > 0 else 0.0

    def second_rotation(self, first_rotation: float, direction: float = 0.0, *, contact: int = 0) -> float:
        """Rotation of the second gear that brings a tooth of one into the middle of a space of the other, rad.

        ``first_rotation`` is the first gear's, ``direction`` that of the line of centres (both rad, from +x).
        ``contact`` = +1 or -1 turns the second gear on, counter-clockwise or clockwise, by half of the backlash:
        its flanks then touch. The result is not reduced to one turn: it runs on as the first gear turns.
        """
        z1, z2 = self.first.number_of_teeth, signed(self.second).teeth
        # a ring is described from the middle of a space, which a tooth of the pinion enters
        faced = direction + self.facing - (math.pi / z2 if self.sign > 0 else 0.0)
        return faced - (first_rotation - direction) * z1 / z2 + contact * self._half_play(self.second)

    def flank_gaps(self, first_rotation: Real, second_rotation: Real, distance: float) -> Real:
        """Closed form for the main flanks at a centre distance (mm), for rotations (n,) of both gears (rad): (n, 2) mm.

        Columns: lower and upper flanks of the first gear's teeth, line of centres along +x, from a ring to its pinion.
        The common normal touches both base circles: gap = a sin(alpha_w) - r_b1 f1 - r_b2 f2 with the roll angles f
        (``contact.involute_gap``), signed for a ring. inf where no common normal meets two flanks.
        """
        one, two, sign = self.first.base_radius, self.second.base_radius, self.sign
        base, result = abs(one + sign * two), np.full((len(first_rotation), 2), np.inf)
        if not distance > base:
            return result
        angle = math.acos(base / distance)
        length = distance * math.sin(angle)
        own, (least, most) = _main_flank(self.first_side, one), _main_flank(self.second_side, two)
        for column, sense in enumerate((1.0, -1.0)):
            reached = one * (angle - sense * first_rotation + self.first.base_half_angle)
            mate = two * (angle - sense * (second_rotation - self.facing) + self.second.base_half_angle)

            def meets(at: Real, gap: Real) -> Flags:
                roll = length - sign * (gap + at)
                return (roll >= least) & (roll <= most)

            result[:, column] = facing_gaps(sign * length - reached - sign * mate, reached, own, self.base_pitch, meets)
        return result

    def _half_play(self, gear: Gear) -> float:
        """Half of the backlash as a rotation of one of the gears, rad."""
        return self.normal_backlash / (2 * gear.base_radius)

    @cached_property
    def touching_corners(self) -> tuple[float | None, float | None]:
        """Tip radii of both gears from which on their corners run into the mate's fillet, mm; None: none does."""
        second, first = (self._corner(gear) for gear in range(2))
        return first, second

    def _corner(self, index: int) -> float | None:
        """Of the mate of one of the gears."""
        gear, mate = self.gears[index], self.gears[1 - index]
        facing = math.pi * (1 + 1 / mate.number_of_teeth) if self.sign > 0 else 0.0
        return Passing(
            self.sides[index],
            mate.flank(),
            self.working_radii[index],
            mate.sign * self.working_centre_distance,
            1 + self.sign * gear.number_of_teeth / mate.number_of_teeth,
            facing - mate.sign * self._half_play(mate),
            mate.sign,
        ).corner(mate.tip_radius, undercut=self._flank_cut_away()[index])

    def _flank_cut_away(self) -> tuple[bool, bool]:
        """Whether undercut has taken the start of a flank, so that a tip may pass where it was."""
        return False, False

    @cached_property
    def tip_limits(self) -> tuple[float, float]:
        """Greatest tip diameters, of a ring the least, whose corners keep off the mate's fillet, mm; inf: any does."""
        line, forms, bases = (
            self._line_of_action,
            self._form_tangents(),
            (self.first.base_radius, self.second.base_radius),
        )
        reached = self.sign * (line - forms[1]), line - self.sign * forms[0]
        limits = []
        gears: tuple[SpurGear | G, ...] = self.gears
        for gear, corner, base, end, cut in zip(
            gears, self.touching_corners, bases, reached, self._flank_cut_away()[::-1], strict=True
        ):
            flank = math.inf if cut else gear.sign * math.hypot(base, max(end, 0.0))
            limits.append(2 * gear.sign * min(flank, math.inf if corner is None else gear.sign * corner))
        return limits[0], limits[1]

    def tips_off_roots(self) -> tuple[float | None, float | None]:
        """Tip radii, mm, that keep off the mate's fillet and root where those of the pair reach it; None: as they are.

        They lie ``off_root``: corners run on beyond the end of the involute. Tips that no tooth could have so short
        stay, and so do those of teeth that do not reach each other.
        """
        return _tips_off_roots(self)

    def can_end(self, index: int, tip_radius: float) -> bool:
        """Whether one of the gears can have a tip radius, mm."""
        gear: Any = replace(self.gears[index], given_tip_diameter=2 * tip_radius)
        pair = replace(self, second=gear) if index else replace(self, first=gear)
        return kept(lambda index: pair.sides[index], index)

    def margins(self) -> tuple[Margin, ...]:
        """The pair's own limits, each with its margin (>= 0 where kept); practicum 3.1, blocking contours.

        ``fillet_interference_*``: where the mate's tip asks the flank to start against where the involute starts, or
        the mate's corner already runs into the fillet (``tip_limits``), both in mm along the line of action from the
        base circle. ``active_flank_cut_away_*``: the same of a flank whose start undercut has taken, which costs
        contact ratio. ``contact_ratio`` (effective) against 1; ``tip_clearance_*`` and ``normal_backlash`` against 0,
        mm.
        """
        clearances, (one, two) = self.tip_clearances, self.roles
        return (
            *self._start_margins(),
            Margin.above("contact_ratio", self.effective_contact_ratio, 1.0),
            Margin.above(f"tip_clearance_{one}", clearances[0], 0.0),
            Margin.above(f"tip_clearance_{two}", clearances[1], 0.0),
            Margin.above("normal_backlash", self.normal_backlash, 0.0),
        )

    def flank_starts(self) -> tuple[Margin, Margin]:
        """Where the mate's tip asks each flank to start against where its involute does, as blocking contours have it.

        In mm along the line of action from the base circle; ``active_flank_cut_away_*``: undercut has taken the start.
        """
        one, two = (
            Margin(
                f"{'active_flank_cut_away' if cut else 'fillet_interference'}_{role}", start, form, way * (start - form)
            )
            for role, start, form, cut, way in zip(
                self.roles,
                self._start_tangents(),
                self._form_tangents(),
                self._flank_cut_away(),
                (1, self.sign),
                strict=True,
            )
        )
        return one, two

    def _start_margins(self) -> Iterator[Margin]:
        """Those of where both flanks start, and of corners that already run into the fillet below."""
        line, sign = self._line_of_action, self.sign
        for index, (margin, way) in enumerate(zip(self.flank_starts(), (1, sign), strict=True)):
            corner, cut = self.touching_corners[1 - index], self._flank_cut_away()[index]
            if cut or corner is None:
                yield margin
            if corner is not None:
                along = tangent_length(corner, self.gears[1 - index].base_radius)
                end = line - sign * along if index else sign * (line - along)
                form = end if cut else way * max(way * margin.limit, way * end)
                name = f"fillet_interference_{self.roles[index]}"
                yield Margin(name, margin.value, form, way * (margin.value - form))

    def findings(self) -> tuple[Finding, ...]:
        """The limits that are not kept; a margin within rounding of the pair's size counts as kept."""
        return not_kept(self.margins(), max(self.working_centre_distance, self.second.root_radius))

    @property
    def _line_of_action(self) -> float:
        """a_w sin(alpha_w): length between the points where the line of action touches the base circles, mm."""
        return self.working_centre_distance * math.sin(self.working_pressure_angle)

    def _tangents(self, radii: tuple[float, float]) -> tuple[float, float]:
        """Length from each gear's base circle to a radius, along the line of action, mm."""
        return tangent_length(radii[0], self.first.base_radius), tangent_length(radii[1], self.second.base_radius)

    def _tip_tangents(self) -> tuple[float, float]:
        """The same to each gear's last flank point."""
        return self._tangents(self.tip_form_radii)

    def _form_tangents(self) -> tuple[float, float]:
        """The same to each gear's first flank point."""
        return self._tangents(self.root_form_radii)

    def _start_tangents(self) -> tuple[float, float]:
        """The same to where the mate's tip touches; negative beyond the base circle's point of contact."""
        tips, line, sign = self._tip_tangents(), self._line_of_action, self.sign
        return sign * (line - tips[1]), line - sign * tips[0]


# trials of a mate ask pairs that are made anew and alike
@lru_cache(maxsize=64)
def _tips_off_roots(pair: InvolutePair[Any, Any]) -> tuple[float | None, float | None]:
    a_w, sign = pair.working_centre_distance, pair.sign
    roots = sign * (a_w - pair.second.root_radius), a_w - sign * pair.first.root_radius
    found: list[float | None] = [None, None]
    gears: tuple[Any, ...] = pair.gears
    for index, (gear, most, root) in enumerate(zip(gears, pair.tip_limits, roots, strict=True)):
        limit = min(gear.sign * most / 2, gear.sign * root)
        if gear.sign * gear.tip_radius > limit + _SAME and pair.effective_contact_ratio > 0:
            tip = gear.sign * off_root(limit, pair.module)
            found[index] = tip if pair.can_end(index, tip) else None
    return found[0], found[1]


def off_root(limit: float, module: float) -> float:
    """The tip radius, mm, that keeps off one which touches, of teeth of a (transverse) module, below 0 of a ring.

    Rounded down as tips are told, to 1e-4 mm, of modules below 0.1 mm to as many digits of them.
    """
    digits = 10.0 ** max(4, math.ceil(3 - math.log10(module)))
    return math.floor(digits * (limit - _OFF_ROOT * module)) / digits


class Sums(Record):
    """What a mesh follows from: sums over both gears of signed teeth, shifts and base radii; and thinning, mm."""

    teeth: int
    shift: float
    base: float
    thinning: float
    alpha: float

    @classmethod
    def of(cls, first: SpurGear, second: Gear) -> Sums:
        """Those of two gears."""
        one, two = signed(first), signed(second)
        thinning = first.circumferential_thinning + second.circumferential_thinning
        return cls(
            one.teeth + two.teeth,
            one.shift + two.shift,
            one.base_radius + two.base_radius,
            thinning,
            second.pressure_angle,
        )

    @property
    def involute(self) -> float:
        """inv(alpha_w) without thinning: inv(alpha) + 2 (x1 + x2) tan(alpha) / (z1 + z2); practicum (3.3)."""
        return involute_function(self.alpha) + 2 * self.shift * math.tan(self.alpha) / self.teeth

    def distance(self, angle: float) -> float:
        """a_w = (r_b1 + r_b2) / cos(alpha_w), mm; practicum (3.4)."""
        return abs(self.base) / math.cos(angle)

    def angle(self, distance: float) -> float:
        """alpha_w at a distance of at least both base radii, mm."""
        return math.acos(abs(self.base) / distance)

    def normal_backlash(self, angle: float) -> float:
        """j_bt at a working angle, mm."""
        opened = involute_function(angle) - self.involute
        # the inverse involute function leaves a few roundings: at the distance of (3.4) there is nothing else
        if abs(opened) < 16 * TOLERANCES.relative_root:
            opened = 0.0
        return self.thinning * math.cos(self.alpha) + 2 * self.base * opened

    @property
    def touching_distance(self) -> float:
        """At which no backlash is left, mm: less than that of the shifts by the thinning, in a ring more."""
        spare = self.thinning * math.cos(self.alpha) / (2 * self.base)
        return self.distance(inverse_involute(max(self.involute - spare, 0.0)))

    def shift_at(self, distance: float) -> float:
        """x1 + x2 of the pair without thinning at a distance, mm.

        Raises
        ------
        ParameterError
            The distance is less than the base circles leave.
        """
        self.refuse_below_base(distance)
        gained = involute_function(self.angle(distance)) - involute_function(self.alpha)
        return gained * self.teeth / (2 * math.tan(self.alpha))

    def refuse_below_base(self, distance: float) -> None:
        """Raise where the base circles leave no working angle."""
        if not distance >= abs(self.base):
            least = limit(abs(self.base), distance, digits=_NEAREST_DIGITS)
            raise ParameterError("working_centre_distance", distance, "no_working_angle", least)


def common_sums(first: SpurGear, second: Gear, blamed: str) -> Sums:
    """The sums of two gears that fit; ``blamed``: what refusals call the first gear (first, pinion).

    Raises
    ------
    ParameterError
        Modules or pressure angles differ; names what would work.
    """
    refuse_other_rack(first, second.module, second.pressure_angle, blamed)
    return Sums.of(first, second)


def refuse_other_rack(first: SpurGear, module: float, alpha: float, blamed: str) -> None:
    """Raise where the mate of a gear has another module, mm, or pressure angle, rad, than that gear."""
    if first.module != module:
        raise ParameterError("module", module, f"not_that_of_{blamed}", Nearest(first.module))
    one, two = math.degrees(first.rack.pressure_angle), math.degrees(alpha)
    if abs(one - two) > 1e-12 * one:
        raise ParameterError("pressure_angle_deg", two, f"not_that_of_{blamed}", Nearest(round(one, 12)))


def working_angle(sums: Sums, first: SpurGear, second: Gear, blamed: str) -> float:
    """alpha_w by (3.3), rad; raises ParameterError with the second's nearest shift where there is none."""
    value = sums.involute
    if value >= 0:
        return inverse_involute(value)
    least = -involute_function(sums.alpha) * sums.teeth / (2 * math.tan(sums.alpha)) - first.profile_shift_coefficient
    x = second.profile_shift_coefficient
    cure = limit(second.sign * least, x, digits=_NEAREST_DIGITS)
    raise ParameterError("profile_shift_coefficient", x, f"no_working_angle_with_{blamed}", cure, involute=value)


def with_room(sums: Sums, distance: float) -> tuple[float, float]:
    """A distance, mm, at which the teeth have room, and alpha_w there, rad; one as it is told is that of touching.

    Raises
    ------
    ParameterError
        They have none; names the nearest distance at which they have.
    """
    if distance >= abs(sums.base) and sums.normal_backlash(sums.angle(distance)) >= -1e-12 * distance:
        return distance, sums.angle(distance)
    touching = sums.touching_distance
    if is_told(distance, touching):
        return touching, sums.angle(touching)
    raise ParameterError.beyond("working_centre_distance", distance, "teeth_overlap", touching, digits=_NEAREST_DIGITS)


def facing_gaps(
    gap: Real, reached: Real, ends: tuple[float, float], base_pitch: float, meets: Callable[[Real, Real], Flags]
) -> Real:
    """Gaps (n,), mm, of the flanks that face each other, of flanks a base pitch apart: those with the least.

    ``reached`` (n,): where the first gear's flank is on the line of action, mm from its base circle, as it is up to
    whole base pitches; ``ends``: between which lengths it is a flank. ``meets`` tells of such lengths and gaps whether
    the mate's flank is there. inf where no common normal meets two flanks.
    """
    low, high = ends
    gap = gap - np.round(gap / base_pitch) * base_pitch
    found = np.full(gap.shape, np.inf)
    start = low + np.mod(reached - low, base_pitch)
    for k in range(math.ceil((high - low) / base_pitch) + 1):
        at = start + k * base_pitch
        inside = (at <= high) & meets(at, gap)
        found[inside] = gap[inside]
    return found


def _main_flank(side: Side, base: float) -> tuple[float, float]:
    """The lengths from the base circle, mm, between which the main flank lies."""
    low, high = sorted(abs(roll) * base for roll in side.flanks()[0].domain)
    return low, high
