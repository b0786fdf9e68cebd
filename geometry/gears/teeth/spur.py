"""An external spur gear cut by a rack: its parameters and the dimensions that follow from them."""

from __future__ import annotations

import math
from functools import cached_property
from typing import TYPE_CHECKING

from geometry.base.angles import involute_function
from geometry.base.record import replace
from geometry.curves.involute import Involute
from geometry.curves.trochoid import RackFillet, TrochoidFillet
from geometry.gears.teeth.basic_rack import BasicRack
from geometry.gears.teeth.involute_teeth import InvoluteTeeth
from geometry.gears.teeth.sector import Sector
from geometry.solids.bores import RoundBore
from geometry.solids.hub_holes import HubHoles

if TYPE_CHECKING:
    from geometry.curves.cutter_fillet import CutterFillet
    from geometry.gears.teeth.cutter import PinionCutter

_NO_HOLES = HubHoles()


class SpurGear(InvoluteTeeth, dict=True):
    """External spur gear; lengths in mm, coefficients in modules, angles in rad.

    ``circumferential_thinning`` thins each tooth at the reference circle: cut by a wider rack tooth (root
    diameter kept) or, with ``thinning_by_deeper_cut``, by feeding the rack in (root diameter lowered).
    With a ``cutter`` it is cut by that pinion cutter: the rack then only gives pressure angle and addendum, and the
    root diameter follows from the cutter's centre distance. A ``sector`` tells which teeth of all are kept.
    Source of the dimensions: ISO 21771, GOST 16532, practicum (3.7) to (3.17).
    """

    rack: BasicRack
    profile_shift_coefficient: float = 0.0
    given_tip_diameter: float | None = None
    circumferential_thinning: float = 0.0
    thinning_by_deeper_cut: bool = False
    tip_chamfer: float = 0.0
    tip_rounding: float = 0.0
    bore_diameter: float = 0.0
    hub: HubHoles = _NO_HOLES
    cutter: PinionCutter | None = None
    sector: Sector | None = None

    @property
    def pressure_angle(self) -> float:
        """That of the rack, rad."""
        return self.rack.pressure_angle

    @cached_property
    def generating_shift_coefficient(self) -> float:
        """x_E: the shift at which the rack really cuts; less than x where thinning is a deeper cut."""
        if not self.thinning_by_deeper_cut:
            return self.profile_shift_coefficient
        infeed = self.circumferential_thinning / (2 * math.tan(self.pressure_angle))
        return self.profile_shift_coefficient - infeed / self.module

    @cached_property
    def _widening(self) -> float:
        """Half of what the rack tooth is wider than its standard, mm."""
        return 0.0 if self.thinning_by_deeper_cut else self.circumferential_thinning / 2

    @cached_property
    def generating_angle(self) -> float:
        """alpha_w0: working angle of the cut, rad; alpha for a rack.

        With a cutter inv(alpha_w0) = inv(alpha) + 2 (x_E + x_0) tan(alpha) / (z + z_0).

        Raises
        ------
        ParameterError
            No such angle exists; names the least shift that has one.
        """
        alpha = self.pressure_angle
        if self.cutter is None:
            return alpha
        from geometry.gears.teeth.cutter import cutting_angle

        shift = self.generating_shift_coefficient + self.cutter.profile_shift_coefficient
        teeth = self.number_of_teeth + self.cutter.number_of_teeth
        return cutting_angle(alpha, shift, teeth, self.profile_shift_coefficient, self.cutter.profile_shift_coefficient)

    @property
    def generating_distance(self) -> float:
        """a_0: distance of a cutter's axis from the gear's, mm; inf for a rack."""
        if self.cutter is None:
            return math.inf
        return (self.base_radius + self.cutter.base_radius) / math.cos(self.generating_angle)

    @property
    def root_radius(self) -> float:
        """r_f = r - (h_f - x_E) m, or a_0 - r_a0 with a cutter."""
        if self.cutter is not None:
            return self.generating_distance - self.cutter.tip_radius
        return self.reference_radius - (self.rack.dedendum - self.generating_shift_coefficient) * self.module

    @property
    def core_radius(self) -> float:
        """Of the largest circle about the axis within the outline, mm: the root circle, but for a sector's rest."""
        return self.root_radius if self.sector is None else self.sector.core_radius(self.root_radius)

    @property
    def tip_radius(self) -> float:
        """r_a = r + (h_a + x) m, or half of the given tip diameter."""
        if self.given_tip_diameter is not None:
            return self.given_tip_diameter / 2
        return self.reference_radius + (self.rack.addendum + self.profile_shift_coefficient) * self.module

    @cached_property
    def holes(self) -> HubHoles:
        """All holes; ``bore_diameter`` above 0 is the short form of a round bore in ``hub``."""
        return replace(self.hub, bore=RoundBore(self.bore_diameter)) if self.bore_diameter > 0 else self.hub

    @property
    def bore_radius(self) -> float:
        """Greatest distance of the bore from the axis, mm; 0 is no bore."""
        return self.holes.bore_reach

    @property
    def rounding_depth(self) -> float:
        """D: how far the rack's rounding centre lies inside the reference circle, mm."""
        return (self.rack.rounding_depth - self.generating_shift_coefficient) * self.module

    @property
    def rounding_radius(self) -> float:
        """rho in mm."""
        return self.rack.tip_radius * self.module

    @property
    def root_land_half_angle(self) -> float:
        """Half of the angle that the rack's flat tip leaves on the root circle, rad."""
        half_flat = self.rack.rounding_half_distance * self.module + self._widening
        return half_flat / self.reference_radius

    @property
    def reference_thickness(self) -> float:
        """s: tooth thickness on the reference circle, mm; practicum (3.16)."""
        return 2 * self.reference_radius * self._half_angle(self.pressure_angle, 0.0)

    @property
    def base_half_angle(self) -> float:
        """psi_b: half of the tooth's angle on the base circle, rad."""
        alpha = self.pressure_angle
        return self._half_angle(alpha, 0.0) + involute_function(alpha)

    def _half_angle(self, flank_angle: float, datum_gain: float) -> float:
        """Half of the tooth's angle on the reference circle for a rack flank of a given angle, rad.

        ``datum_gain`` is how much wider (each side) that flank would make the tooth at the datum line, mm.
        """
        shift = self.generating_shift_coefficient * self.module
        half = math.pi / 4 * self.module + shift * math.tan(flank_angle) + datum_gain - self._widening
        return half / self.reference_radius

    def flank(self) -> Involute:
        """The lower main flank of tooth 1 from the base circle outwards, beyond the tip."""
        return Involute(self.base_radius, -self.base_half_angle, 0.0, 1 + self.tip_radius / self.base_radius)

    def relief_flank(self) -> Involute:
        """The lower relieved flank of tooth 1: the involute of a smaller base circle."""
        relief, alpha, alpha_g = self.rack.relief, self.pressure_angle, self.rack.relief_angle
        height = self.rack.addendum - (relief.height if relief else 0.0)
        # both rack flanks meet at that height, so on the datum line the steeper one is further out
        gain = height * self.module * (math.tan(alpha_g) - math.tan(alpha))
        half = self._half_angle(alpha_g, gain) + involute_function(alpha_g)
        base_radius = self.reference_radius * math.cos(alpha_g)
        return Involute(base_radius, -half, 0.0, 1 + self.tip_radius / base_radius)

    def fillet(self) -> RackFillet | CutterFillet:
        """The lower root fillet of tooth 1 as far as the rounding reaches, whether cut away or not."""
        if self.cutter is not None:
            from geometry.gears.teeth.cutter import cut_fillet

            cutter = replace(self.cutter, widening=self._widening)
            return cut_fillet(self, cutter, self.generating_distance, self.generating_angle)
        angle = -self.pitch_angle / 2 + self.root_land_half_angle
        end = math.pi / 2 - self.pressure_angle
        radii = self.reference_radius, self.rounding_depth, self.rounding_radius
        if self.rack.stretch != 1 and self.rounding_radius > 0:
            from geometry.curves.elliptic_fillet import EllipticFillet

            return EllipticFillet(*radii, angle, 0.0, end, self.rounding_radius, self.rack.stretch)
        return TrochoidFillet(*radii, angle, 0.0, end)
