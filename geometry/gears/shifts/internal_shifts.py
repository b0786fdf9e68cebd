"""A pinion and a ring at any profile shifts: their sizes, line of action and interference, by closed forms.

All in modules, of helical teeth in normal ones, lengths those of the transverse section, which meshes as spur gears do.
The pinion (first) drives the ring (second). Shift of the ring is positive away from its axis, so that
the working angle follows from x2 - x1. Tips: r_a1 = r_1 + h_a + x_1; r_a2 = r_2 - (h_a2 - x_2 - k_2) with the k_2 of
GOST 19274 or 0. Source: GOST 19274, KHK, ISO 21771.
"""

from __future__ import annotations

import math
from functools import lru_cache

from geometry.base.angles import inverse_involute, involute_function
from geometry.base.record import Record, replace
from geometry.gears.pairs.sliding import specific_sliding
from geometry.gears.shifts.racked_teeth import RackedTeeth
from geometry.gears.teeth.cutter import PinionCutter
from geometry.gears.teeth.internal_mesh import InternalMesh
from geometry.gears.teeth.joints import form_length
from geometry.gears.teeth.limits import least_shift_without_undercut
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.ring_limits import generation
from geometry.gears.teeth.ring_tooth import rounded_root_plug
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import normal_angle
from geometry.gears.teeth.transverse_ring import transverse_ring

_NAN = math.nan
CUTTING = ("involute_interference", "trochoid_interference", "radial_assembly")


class InternalShiftPair(RackedTeeth):
    """Numbers of teeth, the pinion's rack or cutter, the ring's cutter or rounded root (module 1), for any shifts.

    ``least_tip_diameter``: the ring's tip is no deeper than that, modules, as ``RingGear`` has it. Of helical teeth
    rack, root and cutter are those of the transverse section, in transverse modules; ``helix_angle`` in rad.
    """

    root: PinionCutter | RoundedRoot
    ring_addendum: float = 1.0
    plain_tip: bool = False
    pinion_cutter: PinionCutter | None = None
    least_tip_diameter: float = 0.0
    helix_angle: float = 0.0
    overlap_ratio: float = 0.0

    def __hash__(self) -> int:
        # what all caches are asked by: cheap rather than fine
        return self.first_teeth << 16 ^ self.second_teeth

    @property
    def share(self) -> float:
        """Normal over transverse module, cos(beta)."""
        return math.cos(self.helix_angle)

    def pinion(self, shift: float) -> SpurGear:
        """The section of the pinion at a shift, normal module 1."""
        x = shift * self.share
        return SpurGear(1.0 / self.share, self.first_teeth, self.rack, x, cutter=self.pinion_cutter)

    def ring(self, shift: float) -> RingGear:
        """The section of the ring at a shift, normal module 1, its rim beyond any root."""
        angle, rim = normal_angle(self.rack.pressure_angle, self.helix_angle), 4.0 * self.second_teeth + 100
        gear = RingGear(1.0, self.second_teeth, angle, rim, RoundedRoot(), shift, self.ring_addendum, self.plain_tip)
        gear = transverse_ring(gear, self.helix_angle)
        return replace(gear, root=self.root, least_tip_diameter=self.least_tip_diameter)


class GearNumbers(Record):
    """What one gear alone says, modules: tip and root radius, length along the line of action to its tip, thickness.

    ``reach``: where the cutter's flank ends, on the ring from its base circle; of a shaped pinion how far its cutter's
    involute reaches. ``cut_involute`` is inv(alpha_w0) with the cutter, inf without one. ``room`` is what a rounded
    root leaves of the space's bottom, half of it. nan where the gear does not exist.
    """

    tip_radius: float
    root_radius: float
    tip_tangent: float
    tip_thickness: float
    reach: float
    cut_involute: float = math.inf
    room: float = math.inf


class InternalState(Record):
    """A pair at two shifts; lengths in modules, along the line of action from the pinion's base circle.

    ``involute`` is inv(alpha_w); where it is negative all that follows is nan. The active line runs from ``start`` (the
    ring's tip) to ``end`` (the pinion's). ``contact_ratio`` is the total one.
    """

    involute: float
    pinion: GearNumbers
    ring: GearNumbers
    working_pressure_angle: float
    working_centre_distance: float
    line: float
    pole: float
    start: float
    end: float
    contact_ratio: float

    @property
    def tip_thicknesses(self) -> tuple[float, float]:
        """S_a1, S_a2 in modules."""
        return self.pinion.tip_thickness, self.ring.tip_thickness

    @property
    def tip_clearances(self) -> tuple[float, float]:
        """Bottom clearance at the pinion's root and at the ring's, modules."""
        a_w = self.working_centre_distance
        return (
            self.ring.tip_radius - a_w - self.pinion.root_radius,
            self.ring.root_radius - a_w - self.pinion.tip_radius,
        )

    def root_sliding(self, gear_ratio: float) -> tuple[float, float]:
        """zeta_f1 at the start and zeta_f2 at the end of the active line; -inf where a base circle is reached."""
        starts, ends = (specific_sliding(at, self.line, gear_ratio, -1) for at in (self.start, self.end))
        return starts[0], ends[1]


@lru_cache(maxsize=1 << 14)
def pinion_numbers(pair: InternalShiftPair, shift: float) -> GearNumbers:
    """The pinion alone; closed forms."""
    gear, alpha = pair.pinion(shift), pair.rack.pressure_angle
    tip, base = gear.tip_radius, gear.base_radius
    tangent = math.sqrt((tip - base) * (tip + base)) if tip > base else _NAN
    thick = 2 * tip * (gear.base_half_angle - involute_function(math.atan2(tangent, base)))
    if pair.pinion_cutter is None:
        return GearNumbers(tip, gear.root_radius, tangent, thick, math.inf)
    involute = _cut_involute(pair.first_teeth, pair.pinion_cutter, shift * pair.share, alpha)
    if not involute >= 0:
        return GearNumbers(tip, _NAN, tangent, thick, _NAN, involute)
    reach = gear.generating_distance * math.sin(gear.generating_angle)
    return GearNumbers(tip, gear.root_radius, tangent, thick, reach, involute)


@lru_cache(maxsize=1 << 14)
def ring_numbers(pair: InternalShiftPair, shift: float) -> GearNumbers:
    """The ring alone; closed forms, but for the full round of a rounded root."""
    gear, alpha = pair.ring(shift), pair.rack.pressure_angle
    tip, base = gear.tip_radius, gear.base_radius
    tangent = math.sqrt((tip - base) * (tip + base)) if tip >= base else _NAN
    space = gear.base_half_angle - involute_function(math.atan2(tangent, base))
    thick = tip * (gear.pitch_angle - 2 * space)
    if isinstance(pair.root, RoundedRoot):
        return _rounded_ring(gear, pair.root, tip, tangent, thick)
    involute = _cut_involute(-pair.second_teeth, pair.root, shift * pair.share, alpha)
    if not involute >= 0:
        return GearNumbers(tip, _NAN, tangent, thick, _NAN, involute)
    return GearNumbers(tip, gear.root_radius, tangent, thick, gear.cut_form_length, involute)


@lru_cache(maxsize=1 << 14)
def cutting_margins(pair: InternalShiftPair, shift: float) -> tuple[float, float, float]:
    """Margins of the ring's cutting in the order of ``CUTTING``, modules; inf without a cutter, nan beyond any cut."""
    if not ring_numbers(pair, shift).cut_involute >= 0:
        return _NAN, _NAN, _NAN
    mesh = generation(pair.ring(shift))
    if mesh is None:
        return math.inf, math.inf, math.inf
    found = [m.margin for m in mesh.margins()]
    return found[0], found[1], found[2]


def _rounded_ring(gear: RingGear, root: RoundedRoot, tip: float, tangent: float, thick: float) -> GearNumbers:
    """A ring whose root no cutter made; its involute ends where the rounding begins."""
    # the body that fills the space, sharp where the rounding is as large as it takes
    asked = rounded_root_plug(replace(gear, root=replace(root, radius=root.radius or 0.0)))
    room = min(asked.corner_angle * asked.tip_radius, asked.tip_radius - asked.base_radius - asked.rounding_radius)
    reach = rounded_root_plug(gear).form_length if room >= 0 else _NAN
    return GearNumbers(tip, gear.root_radius, tangent, thick, reach, room=room)


def _cut_involute(teeth: int, cutter: PinionCutter, shift: float, alpha: float) -> float:
    """inv(alpha_w0) at a transverse shift; ``teeth`` is negative for a ring.

    -inf where the ring has no more teeth than its cutter.
    """
    total, moved = teeth + cutter.number_of_teeth, shift + cutter.profile_shift_coefficient
    if teeth < 0:
        total, moved = -total, shift - cutter.profile_shift_coefficient
    if total <= 0:
        return -math.inf
    return involute_function(alpha) + 2 * moved * math.tan(alpha) / total


@lru_cache(maxsize=1 << 17)
def internal_state(pair: InternalShiftPair, x1: float, x2: float) -> InternalState:
    """The pair at two shifts, by closed forms and the inverse involute function."""
    alpha, difference = pair.rack.pressure_angle, pair.second_teeth - pair.first_teeth
    one, two = pinion_numbers(pair, x1), ring_numbers(pair, x2)
    involute = involute_function(alpha) + 2 * (x2 - x1) * pair.share * math.tan(alpha) / difference
    if not involute >= 0:
        return InternalState(involute, one, two, _NAN, _NAN, _NAN, _NAN, _NAN, _NAN, _NAN)
    angle = inverse_involute(involute)
    # half of a tooth's share of the base circles
    base = math.cos(alpha) / (2 * pair.share)
    distance = difference * base / math.cos(angle)
    line = distance * math.sin(angle)
    start, end = two.tip_tangent - line, one.tip_tangent
    pole = pair.first_teeth * base * math.tan(angle)
    ratio = (end - start) / (2 * math.pi * base) + pair.overlap_ratio
    return InternalState(involute, one, two, angle, distance, line, pole, start, end, ratio)


@lru_cache(maxsize=1 << 14)
def pinion_form(pair: InternalShiftPair, shift: float) -> float:
    """Length along the line of action from the base circle to where the pinion's involute begins, modules.

    nan where the fillet leaves no tooth.
    """
    return form_length(pair.pinion(shift))


@lru_cache(maxsize=256)
def least_pinion_shift(pair: InternalShiftPair) -> float:
    """x_min of the pinion."""
    return least_shift_without_undercut(pair.pinion(0.0)) / pair.share


@lru_cache(maxsize=1 << 16)
def interferences(pair: InternalShiftPair, x1: float, x2: float) -> tuple[float, float, float]:
    """Margins of involute interference, trochoid interference and radial assembly (``InternalMesh``), modules."""
    state = internal_state(pair, x1, x2)
    if not state.involute >= 0:
        return _NAN, _NAN, _NAN
    bases = tuple(z / 2 / pair.share * math.cos(pair.rack.pressure_angle) for z in pair.teeth)
    tips = state.pinion.tip_radius, state.ring.tip_radius
    angle, distance = state.working_pressure_angle, state.working_centre_distance
    mesh = InternalMesh(pair.teeth, (bases[0], bases[1]), tips, distance, angle)
    found = [m.margin for m in mesh.margins()]
    return found[0], found[1], found[2]


def equal_sliding(pair: InternalShiftPair, x1: float, x2: float) -> float:
    """(g_A + L)(g_E + L) - u^2 g_A g_E: 0 where zeta_f1 = zeta_f2, > 0 where the pinion's foot slides more.

    nan where the active line reaches the pinion's base circle: its sliding is not finite there.
    """
    state = internal_state(pair, x1, x2)
    low, high, line = state.start, state.end, state.line
    return (low + line) * (high + line) - pair.gear_ratio**2 * low * high if low > 0 else _NAN
