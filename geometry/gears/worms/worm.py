"""Cylindrical worms by GOST 18498 and GOST 19036: diameters, angles, and their exact sections.

Frame: the axis is z, a thread lies about z = 0 on +x; a right-hand worm's thread rises counter-clockwise.
"""

from __future__ import annotations

import math
from functools import cached_property, partial
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.errors import ParameterError
from geometry.base.nearest import nearest
from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_root
from geometry.curves.curve import Real
from geometry.gears.worms.flank import FORMS, Flank, Screw

Hand = Literal["right", "left"]
# half the least land of a thread and of a space, and the least of a flank, modules: thinner faces take no mesh
LEAST_LAND = 1e-3


class Worm(Record, dict=True):
    """A cylindrical worm; coefficients are in axial modules.

    ``diameter_quotient``: q = d_1 / m; ``pressure_angle`` (rad): axial for ZA, in the normal for ZI, ZN1 and ZN2, of
    the grinding wheel for ZK1, whose ``wheel_diameter`` is in mm; ``thinning``: of the thread, axial, mm.
    """

    module: float
    number_of_starts: int
    diameter_quotient: float
    form: str = "ZI"
    pressure_angle: float = math.radians(20)
    hand: Hand = "right"
    addendum_coefficient: float = 1.0
    tip_clearance_coefficient: float = 0.2
    fillet_coefficient: float = 0.2
    wheel_diameter: float = 300.0
    thinning: float = 0.0

    @property
    def reference_radius(self) -> float:
        """r_1 = q m / 2, mm."""
        return self.diameter_quotient * self.module / 2

    @property
    def parameter(self) -> float:
        """p, axial advance per rad, mm."""
        return self.module * self.number_of_starts / 2

    @property
    def lead(self) -> float:
        """p_z, mm per turn."""
        return math.pi * self.module * self.number_of_starts

    @property
    def lead_angle(self) -> float:
        """gamma on the reference cylinder, tan gamma = z_1 / q, rad."""
        return self.screw.lead_angle

    @property
    def sign(self) -> int:
        """1 of a right-hand thread, -1 of a left-hand one."""
        return 1 if self.hand == "right" else -1

    @property
    def tip_radius(self) -> float:
        """r_a1, mm."""
        return self.reference_radius + self.addendum_coefficient * self.module

    @property
    def root_radius(self) -> float:
        """r_f1, mm."""
        return self.reference_radius - (self.addendum_coefficient + self.tip_clearance_coefficient) * self.module

    @cached_property
    def screw(self) -> Screw:
        """Reference radius, advance, and both halves of the axial pitch."""
        quarter = math.pi * self.module / 4
        thin = self.thinning / 2
        return Screw(self.reference_radius, self.parameter, quarter - thin, quarter + thin)

    @cached_property
    def flank(self) -> Flank:
        """Its form of flank."""
        return FORMS[self.form](self.screw, self.pressure_angle, self.wheel_diameter)

    def half_thickness(self, radius: ArrayLike) -> Real:
        """Half the axial thickness of the thread at radii, mm."""
        return self.screw.half_thickness - self.flank.drop(radius)

    @property
    def form_radius(self) -> float:
        """Where the flank begins over the root, mm."""
        return max(self.root_radius, self.flank.least_radius)

    @property
    def tip_thickness(self) -> float:
        """Axial thickness of the thread at the tip, mm."""
        return float(2 * self.half_thickness(self.tip_radius))

    @property
    def axial_pressure_angle(self) -> float:
        """alpha_x on the reference cylinder, rad."""
        return self.axial_pressure_angle_at(self.reference_radius)

    def axial_pressure_angle_at(self, radius: float) -> float:
        """alpha_x at a radius from the axis, rad."""
        return math.atan(float(self.flank.slope(radius)))

    @property
    def normal_pressure_angle(self) -> float:
        """alpha_n of the flank in the normal of the reference helix, rad."""
        return math.atan(math.tan(self.axial_pressure_angle) * math.cos(self.lead_angle))

    @property
    def has_tip(self) -> bool:
        """Whether the thread ends in a land that is more than next to nothing."""
        return self.tip_thickness >= 2 * LEAST_LAND * self.module

    def checked(self) -> Worm:
        """The worm itself, where it exists.

        Raises
        ------
        ParameterError
            The root lies under the axis, or the thread is pointed below its tip.
        """
        if self.root_radius <= 0:
            least = 2.001 * (self.addendum_coefficient + self.tip_clearance_coefficient)
            raise ParameterError.beyond("diameter_quotient", self.diameter_quotient, "worm_root_under_axis", least)
        if self.form_radius >= self.reference_radius:
            raise ParameterError("number_of_starts", self.number_of_starts, "worm_flank_above_reference")
        if not self.has_tip:
            none = self.screw.half_thickness <= LEAST_LAND * self.module
            if self.thinning > 0 and (none or replace(self, thinning=0.0).has_tip):

                def left(thinning: float) -> bool:
                    return replace(self, thinning=thinning).has_tip

                cure = partial(nearest, left, self.thinning, 0.0)
                raise ParameterError("axial_thinning", self.thinning, "worm_pointed", cure)
            sharp = self._pointed_radius()
            most = (sharp - self.reference_radius) / self.module
            raise ParameterError.beyond("addendum_coefficient", self.addendum_coefficient, "worm_pointed", most)
        return self

    def _pointed_radius(self) -> float:
        """Where next to nothing is left between both flanks of a thread, mm."""

        def left(radius: float) -> float:
            return float(self.half_thickness(radius)) - LEAST_LAND * self.module

        return bracketed_root(left, self.reference_radius, self.tip_radius).value

    def axial(self, radius: ArrayLike, distance: float = 0.0) -> tuple[Real, Real]:
        """Both flanks of a thread in the plane y = ``distance`` (mm): z at radii from the axis, upper and lower, mm.

        The section slides along z by the lead as the worm turns: it is a rack.
        """
        r = np.asarray(radius, float)
        along = self.parameter * np.arcsin(self.sign * distance / r)
        half = self.half_thickness(r)
        return along + half, along - half

    def section_slopes(self, radius: ArrayLike, distance: float = 0.0) -> tuple[Real, Real]:
        """dz/dx of both flanks in the plane y = ``distance`` (mm), x = sqrt(r^2 - y^2)."""
        r = np.asarray(radius, float)
        x = np.sqrt((r - distance) * (r + distance))
        turned = -self.parameter * self.sign * distance / r**2
        steep = self.flank.slope(r) * x / r
        return turned - steep, turned + steep
