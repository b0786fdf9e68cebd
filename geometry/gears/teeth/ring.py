"""A ring gear (internal spur gear): its parameters and the dimensions that follow from them.

The ring's tooth space has the shape of an external tooth: space 1 is centred on +x. Profile shift is positive AWAY from
the axis (GOST 19274, KHK; ISO 21771, with its negative tooth number, has it the other way round).
"""

from __future__ import annotations

import math
from functools import cached_property

from geometry.base.angles import involute_function
from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import Record, replace
from geometry.curves.cutter_fillet import CutterFillet
from geometry.curves.involute import Involute
from geometry.gears.teeth.cutter import PinionCutter, cut_fillet, cutting_angle
from geometry.gears.teeth.involute_teeth import InvoluteTeeth
from geometry.gears.teeth.sector import Sector
from geometry.solids.hub_holes import HubHoles


class RoundedRoot(Record):
    """A root that no cutter made: an arc tangent to flank and root circle, in modules; None is the full round.

    For laser, wire and print. The root circle is r_2 + (dedendum + x_2) m.
    """

    dedendum: float = 1.25
    radius: float | None = None


_NO_HOLES = HubHoles()


class RingGear(InvoluteTeeth, dict=True):
    """Internal spur gear; lengths in mm, coefficients in modules, angles in rad.

    The default tip diameter is that of GOST 19274, d_2 - 2 (h_a - x_2 - k_2) m, whose k_2 = 0.25 - 0.125 x_2 (0 from
    x_2 = 2 on) keeps the tips off a mate's fillets; ``plain_tip`` leaves k_2 out (KHK). Thinning thins each ring tooth
    at the reference circle: cut by a wider cutter tooth (root diameter kept) or, with ``thinning_by_deeper_cut``, by
    feeding the cutter out (root diameter raised).
    ``any_cutter``: nobody named the cutter, so that another may be taken (``ring_made.settled_ring``), and
    ``least_tip_diameter``: the default tip is made no deeper than that (0: as deep as it likes).
    ``holes``: round holes in the rim, like a bolt circle. A ``sector`` tells which teeth of all are kept.
    Source of the dimensions: GOST 19274, ISO 21771.
    """

    pressure_angle: float
    outer_diameter: float
    root: PinionCutter | RoundedRoot
    profile_shift_coefficient: float = 0.0
    addendum: float = 1.0
    plain_tip: bool = False
    given_tip_diameter: float | None = None
    circumferential_thinning: float = 0.0
    thinning_by_deeper_cut: bool = False
    tip_chamfer: float = 0.0
    tip_rounding: float = 0.0
    any_cutter: bool = False
    holes: HubHoles = _NO_HOLES
    least_tip_diameter: float = 0.0
    sector: Sector | None = None

    @property
    def sign(self) -> int:
        """-1."""
        return -1

    @cached_property
    def generating_shift_coefficient(self) -> float:
        """x_E: the shift at which the space is really cut; more than x_2 where thinning is a deeper cut."""
        if not self.thinning_by_deeper_cut:
            return self.profile_shift_coefficient
        infeed = self.circumferential_thinning / (2 * math.tan(self.pressure_angle))
        return self.profile_shift_coefficient + infeed / self.module

    @property
    def _widening(self) -> float:
        return 0.0 if self.thinning_by_deeper_cut else self.circumferential_thinning / 2

    @cached_property
    def cutter(self) -> PinionCutter | None:
        """The cutter with the teeth it really has: wider where that thins the ring's; None for a rounded root."""
        if not isinstance(self.root, PinionCutter):
            return None
        return replace(self.root, widening=self._widening)

    @property
    def tip_radius(self) -> float:
        """r_a2: half of the given tip diameter, else the default one, no deeper than ``least_tip_diameter``."""
        if self.given_tip_diameter is not None:
            return self.given_tip_diameter / 2
        return max(self.default_tip_radius, self.least_tip_diameter / 2)

    @property
    def default_tip_radius(self) -> float:
        """r_2 - (h_a - x_2 - k_2) m, mm; below the base circle no ring has it."""
        height = self.addendum - self.profile_shift_coefficient - self.tip_shortening_coefficient
        return self.reference_radius - height * self.module

    @property
    def tip_shortening_coefficient(self) -> float:
        """k_2 of GOST 19274, in modules; 0 with ``plain_tip``."""
        x = self.profile_shift_coefficient
        return 0.0 if self.plain_tip or x >= 2 else 0.25 - 0.125 * x

    @property
    def core_radius(self) -> float:
        """Of the least circle about the axis without the toothed boundary, mm: the root circle, or a sector's blank."""
        return self.root_radius if self.sector is None else self.sector.core_radius(self.root_radius)

    @property
    def outer_radius(self) -> float:
        """Radius of the rim, mm."""
        return self.outer_diameter / 2

    @cached_property
    def generating_angle(self) -> float:
        """alpha_w0 of ring and cutter without backlash: inv = inv(alpha) + 2 (x_E - x_0) tan(alpha) / (z_2 - z_0).

        Raises
        ------
        ParameterError
            The cutter has too many teeth, or no such angle exists; names the nearest value that works.
        """
        cutter, alpha = self._known_cutter, self.pressure_angle
        difference = self.number_of_teeth - cutter.number_of_teeth
        if difference <= 0:
            most = Nearest(self.number_of_teeth - 1, "at_most")
            raise ParameterError("cutter.number_of_teeth", cutter.number_of_teeth, "not_below_ring_teeth", most)
        shift = self.generating_shift_coefficient - cutter.profile_shift_coefficient
        return cutting_angle(alpha, shift, difference, self.profile_shift_coefficient, cutter.profile_shift_coefficient)

    @cached_property
    def generating_distance(self) -> float:
        """a_0: distance of the cutter's axis from the ring's, mm."""
        difference = self.base_radius - self._known_cutter.base_radius
        return difference / math.cos(self.generating_angle)

    @property
    def _known_cutter(self) -> PinionCutter:
        cutter = self.cutter
        if cutter is None:
            raise TypeError("a rounded root has no cutter")
        return cutter

    @property
    def root_radius(self) -> float:
        """r_f2 = a_0 + r_a0, or r_2 + (h_f + x_E) m for a rounded root."""
        if isinstance(self.root, RoundedRoot):
            return self.reference_radius + (self.root.dedendum + self.generating_shift_coefficient) * self.module
        return self.generating_distance + self._known_cutter.tip_radius

    @cached_property
    def base_half_angle(self) -> float:
        """Half of the space's angle on the base circle, rad; beyond the tip circle, where that lies outside it."""
        shift = self.generating_shift_coefficient * self.module * math.tan(self.pressure_angle)
        half = math.pi / 4 * self.module + shift + self._widening
        return half / self.reference_radius + involute_function(self.pressure_angle)

    @property
    def reference_thickness(self) -> float:
        """s_2: tooth thickness on the reference circle, mm."""
        space = 2 * self.reference_radius * (self.base_half_angle - involute_function(self.pressure_angle))
        return math.pi * self.module - space

    def flank(self) -> Involute:
        """The lower flank of space 1 from the base circle outwards, beyond the root circle."""
        return Involute(self.base_radius, -self.base_half_angle, 0.0, 1 + self.root_radius / self.base_radius)

    def fillet(self) -> CutterFillet:
        """The lower root fillet of space 1 from the root circle to the flank; runs clockwise, material on its left."""
        return cut_fillet(self, self._known_cutter, self.generating_distance, self.generating_angle)

    @property
    def cut_form_length(self) -> float:
        """Length from the base circle to the flank's outer end, along its normal, where the cutter's flank ends, mm."""
        return self.generating_distance * math.sin(self.generating_angle) + self._known_cutter.form_length
