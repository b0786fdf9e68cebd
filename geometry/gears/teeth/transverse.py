"""Helical gears by numbers: the transverse section that follows from normal data, and back.

A helical gear meshes in every transverse section like a spur gear of module m_n / cos(beta); ISO 21771. All that
depends on radii, thicknesses and the line of action is therefore the spur gear's of that section.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import replace
from geometry.gears.teeth.basic_rack import BasicRack, TipRelief
from geometry.gears.teeth.spur import SpurGear

if TYPE_CHECKING:
    from geometry.gears.teeth.cutter import PinionCutter


def transverse_angle(normal_pressure_angle: float, helix_angle: float) -> float:
    """alpha_t = atan(tan(alpha_n) / cos(beta)), rad; ISO 21771."""
    return math.atan(math.tan(normal_pressure_angle) / math.cos(helix_angle))


def normal_angle(transverse_pressure_angle: float, helix_angle: float) -> float:
    """alpha_n = atan(tan(alpha_t) cos(beta)), rad; ISO 21771."""
    return math.atan(math.tan(transverse_pressure_angle) * math.cos(helix_angle))


def helix_angle_at(helix_angle: float, share: float) -> float:
    """beta_y = atan(tan(beta) r_y / r) on a cylinder ``share`` times as wide as the reference one, rad; ISO 21771."""
    return math.atan(math.tan(helix_angle) * share)


def base_helix_angle(transverse_pressure_angle: float, helix_angle: float) -> float:
    """beta_b = atan(tan(beta) cos(alpha_t)), rad; ISO 21771."""
    return helix_angle_at(helix_angle, math.cos(transverse_pressure_angle))


def normal_share(transverse_pressure_angle: float, helix_angle: float) -> float:
    """cos(beta_b): normal backlash j_bn over j_bt, that along the line of action in the transverse plane; ISO 21771.

    j_bn = j_wt cos(alpha_wt) cos(beta_b); pairs calculate j_bt = j_wt cos(alpha_wt). 1 for straight teeth.
    """
    return math.cos(base_helix_angle(transverse_pressure_angle, helix_angle)) if helix_angle else 1.0


def transverse_gear(normal: SpurGear, helix_angle: float) -> SpurGear:
    """The transverse section of a helical gear whose normal data stand in ``normal``; the angle in rad.

    Lengths stay, coefficients become those of the transverse module. The circle that rounds the normal rack is an
    ellipse here, and the fillet is what this ellipse leaves: nothing is approximated. ``circumferential_thinning`` is
    transverse already. A pinion cutter's data are normal too, but for its tip rounding: a circle, in normal modules,
    in the transverse section.

    Raises
    ------
    ParameterError
        The helix angle is not below 90 degrees.
    """
    if helix_angle == 0:
        return normal
    if not abs(helix_angle) < math.pi / 2:
        raise ParameterError("helix_angle", helix_angle, "not_below_right_angle", Nearest(math.radians(60.0)))
    cosine = math.cos(helix_angle)
    cutter = normal.cutter
    return replace(
        normal,
        cutter=None if cutter is None else transverse_cutter(cutter, helix_angle),
        module=normal.module / cosine,
        rack=transverse_rack(normal.rack, helix_angle),
        profile_shift_coefficient=normal.profile_shift_coefficient * cosine,
    )


def transverse_rack(rack: BasicRack, helix_angle: float) -> BasicRack:
    """The rack of a transverse section, in transverse modules; the angle in rad."""
    if helix_angle == 0:
        return rack
    cosine, angle = math.cos(helix_angle), transverse_angle(rack.pressure_angle, helix_angle)
    relief = rack.relief
    if relief is not None:
        # the relieved flank is a plane as well: its angle goes the way of the main one's
        height, relieved = relief.height * cosine, transverse_angle(rack.relief_angle, helix_angle)
        relief = TipRelief(height * math.tan(relieved - angle) / math.cos(angle), height)
    values = rack.addendum * cosine, rack.tip_clearance * cosine, rack.tip_radius * cosine
    return BasicRack(angle, *values, relief, rack.stretch / cosine)


def transverse_cutter(cutter: PinionCutter, helix_angle: float) -> PinionCutter:
    """The transverse section of a helical pinion cutter given in normal modules; the angle in rad."""
    if helix_angle == 0:
        return cutter
    cosine = math.cos(helix_angle)
    return replace(
        cutter,
        module=cutter.module / cosine,
        pressure_angle=transverse_angle(cutter.pressure_angle, helix_angle),
        profile_shift_coefficient=cutter.profile_shift_coefficient * cosine,
        addendum=cutter.addendum * cosine,
        tip_rounding=cutter.tip_rounding * cosine,
    )


def overlap_ratio(face_width: float, helix_angle: float, normal_module: float) -> float:
    """eps_beta = b sin(beta) / (pi m_n): axial overlap, without unit; ISO 21771.

    The thesis on the power module prints it upside down and without the width.
    """
    return face_width * math.sin(abs(helix_angle)) / (math.pi * normal_module)
