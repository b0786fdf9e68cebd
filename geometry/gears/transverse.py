"""Helical gears by numbers: the transverse section that follows from normal data, and back.

A helical gear meshes in every transverse section like a spur gear of module m_n / cos(beta); ISO 21771. All that
depends on radii, thicknesses and the line of action is therefore the spur gear's of that section.
"""

from __future__ import annotations

import math
from dataclasses import replace

from geometry.errors import ParameterError
from geometry.gears.basic_rack import BasicRack, TipRelief
from geometry.gears.spur import SpurGear


def transverse_angle(normal_pressure_angle: float, helix_angle: float) -> float:
    """alpha_t = atan(tan(alpha_n) / cos(beta)), rad; ISO 21771."""
    return math.atan(math.tan(normal_pressure_angle) / math.cos(helix_angle))


def normal_angle(transverse_pressure_angle: float, helix_angle: float) -> float:
    """alpha_n = atan(tan(alpha_t) cos(beta)), rad; ISO 21771."""
    return math.atan(math.tan(transverse_pressure_angle) * math.cos(helix_angle))


def base_helix_angle(transverse_pressure_angle: float, helix_angle: float) -> float:
    """beta_b = atan(tan(beta) cos(alpha_t)), rad; ISO 21771."""
    return math.atan(math.tan(helix_angle) * math.cos(transverse_pressure_angle))


def transverse_gear(normal: SpurGear, helix_angle: float) -> SpurGear:
    """The transverse section of a helical gear whose normal data stand in ``normal``; the angle in rad.

    Lengths stay, coefficients become those of the transverse module. The circle that rounds the normal rack is an
    ellipse here; its stand-in begins at the same form height h_Ff, so that form diameters and the limit of undercut
    stay exact and only the fillet below them is drawn nearly. ``circumferential_thinning`` is transverse already.

    Raises
    ------
    ParameterError
        The helix angle is not below 90 degrees.
    """
    if helix_angle == 0:
        return normal
    if not abs(helix_angle) < math.pi / 2:
        raise ParameterError("helix_angle_deg", math.degrees(helix_angle), "must be below 90 degrees; 60 works")
    cosine = math.cos(helix_angle)
    return replace(
        normal,
        module=normal.module / cosine,
        rack=transverse_rack(normal.rack, helix_angle),
        profile_shift_coefficient=normal.profile_shift_coefficient * cosine,
    )


def transverse_rack(rack: BasicRack, helix_angle: float) -> BasicRack:
    """The rack of a transverse section, in transverse modules; the angle in rad."""
    cosine, angle = math.cos(helix_angle), transverse_angle(rack.pressure_angle, helix_angle)
    # the same depth of the rounding along the radius
    radius = rack.tip_radius * cosine * (1 - math.sin(rack.pressure_angle)) / (1 - math.sin(angle))
    relief = rack.relief
    if relief is not None:
        # depth along the normal of the flank grows with 1 / cos(beta_b)
        base_helix = base_helix_angle(angle, helix_angle)
        relief = TipRelief(relief.depth * cosine / math.cos(base_helix), relief.height * cosine)
    return BasicRack(angle, rack.addendum * cosine, rack.tip_clearance * cosine, radius, relief)


def overlap_ratio(face_width: float, helix_angle: float, normal_module: float) -> float:
    """eps_beta = b sin(beta) / (pi m_n): axial overlap, without unit; ISO 21771.

    The thesis on the power module prints it upside down and without the width.
    """
    return face_width * math.sin(abs(helix_angle)) / (math.pi * normal_module)


def virtual_number_of_teeth(number_of_teeth: int, transverse_pressure_angle: float, helix_angle: float) -> float:
    """z_nx = z / (cos^2(beta_b) cos(beta)), the teeth of the normal section's spur gear; ISO 21771."""
    base_helix = base_helix_angle(transverse_pressure_angle, helix_angle)
    return number_of_teeth / (math.cos(base_helix) ** 2 * math.cos(helix_angle))
