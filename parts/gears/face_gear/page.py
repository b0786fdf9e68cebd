"""``higherpair calc face-gear``: between which diameters teeth can be, contact and forces of the pair."""

from __future__ import annotations

import math
from contextlib import suppress

import numpy as np

from geometry.base.errors import GeometryError
from geometry.gears.face.gear import FLANK, FaceGear
from geometry.gears.face.pair import FacePair
from parts.base.texts import N_
from parts.gears.face_gear.part import FACE_GEAR, FaceGearSpec, face_gear_findings, pinion_of
from parts.pages.force_steps import Power, Speed, Torque, both_speeds, driving_torque
from parts.pages.inputs import calculation, part_of_kind
from parts.pages.page import Sheet
from parts.texts.findings import finding_message

TOPIC = "face-gear"
table_from = part_of_kind("face_gear")
_LITVIN = "Litvin, 18.4"
# a place of a plane: twice its distance from the gear's axis
_PLACE = "2 * sqrt({%s}**2 + ({%s} / 2 * sin({%s}) - {%s} * cos({%s}))**2)"


class FaceKeys(FaceGearSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the face gear, which tell its pinion too, and of the pair at work."""

    speed_rpm: Speed = None
    torque: Torque = None
    power: Power = None


@calculation(TOPIC, FaceKeys)
def sheet(keys: FaceKeys) -> Sheet:
    """The calculation of a face gear and its pinion."""
    gear = FACE_GEAR.thing(keys, {})
    page = Sheet(TOPIC, N_("Face gear and spur pinion at a right angle"))
    _given(page, keys, gear)
    _sizes(page, gear)
    _limits(page, gear)
    _face(page, gear)
    with suppress(GeometryError):
        # of another rack only its own pinion may be
        pair = FacePair(gear, pinion_of(keys), 0.0, gear.outer_radius + gear.module)
        page.add("total_contact_ratio", pair.contact_ratio)
        if gear.more_teeth:
            page.add("end_gap", pair.end_gap)
    if keys.speed_rpm is not None:
        both_speeds(page, (keys.speed_rpm, keys.speed_rpm / gear.ratio))
    _forces(page, gear, keys)
    page.notes += [finding_message(found) for found in face_gear_findings(gear)]
    return page


def _given(page: Sheet, keys: FaceKeys, gear: FaceGear) -> None:
    page.section(N_("Given"))
    page.both("number_of_teeth", (keys.pinion_number_of_teeth, keys.number_of_teeth))
    page.add("module", keys.module)
    if keys.pinion_profile_shift_coefficient:
        page.add("profile_shift_coefficient", keys.pinion_profile_shift_coefficient, gear=1)
    page.told(pressure_angle_deg=keys.pressure_angle_deg, addendum_coefficient=gear.addendum / keys.module)
    page.told(dedendum_coefficient=gear.cutter.addendum, cutter_tip_rounding=gear.cutter.tip_rounding)
    if gear.more_teeth:
        page.add("cutter_teeth", gear.shaper.number_of_teeth)
    page.told(circumferential_thinning=keys.circumferential_thinning or None)
    page.add("plate_thickness", gear.thickness)


def _sizes(page: Sheet, gear: FaceGear) -> None:
    shaper = gear.shaper
    page.section(N_("Pinion, shaper and teeth"))
    pinion, high = gear.cutter, ""
    page.add("gear_ratio", gear.ratio, "{z2} / {z1}")
    page.both("reference_diameter", (2 * pinion.reference_radius, 2 * gear.reference_radius), "{m} * {z#}")
    angles = math.degrees(math.atan(1 / gear.ratio)), math.degrees(math.atan(gear.ratio))
    page.both("pitch_cone_angle_deg", angles, "arctan({z#} / {z~})")
    page.add("base_diameter", 2 * pinion.base_radius, "{d1} * cos({alpha})", gear=1)
    if gear.more_teeth:
        high = " + {H_0}"
        page.add("contact_plane", gear.contact_plane)
        page.add(
            "contact_plane_angle_deg", math.degrees(gear.contact_angle), "arccos({d2} * cos({alpha}) / (2 * {x_c}))"
        )
        own = "{x1} + " if pinion.profile_shift_coefficient else ""
        thick = "({z_0} - {z1}) * (inv({alpha_c}) - inv({alpha})) / (2 * tan({alpha}))"
        page.add("cutter_shift", shaper.profile_shift_coefficient, own + thick)
        page.add("shaper_base_diameter", 2 * shaper.base_radius, "{m} * {z_0} * cos({alpha})")
        page.add("shaper_axes_apart", gear.axes_apart, "{x_c} * ({z_0} - {z1}) / {z2}")
    # a shift carries the gear's teeth along
    root, tip = ("({h_f} + {x1})", "({h_a} - {x1})") if pinion.profile_shift_coefficient else ("{h_f}", "{h_a}")
    page.add("shaper_tip_diameter", 2 * shaper.tip_radius, f"{{d1}} + 2 * {root} * {{m}}" + high.replace("{", "2 * {"))
    corner = f"sqrt(({{d_a0}} / 2 - {{rho_0}} * {{m}})**2 - ({{{_base(gear)}}} / 2)**2)"
    page.add("shaper_form_length", shaper.form_length, f"{corner} + {{rho_0}} * {{m}}")
    name = "shaper_tip_depth" if gear.more_teeth else "face_tip_depth"
    page.add(name, gear.tip_depth, f"{{d1}} / 2 - {tip} * {{m}}" + high)
    page.add("face_tooth_depth", gear.whole_depth, "({h_a} + {h_f}) * {m}")
    page.add("pinion_axis_height", gear.mounting_distance, "{t} + {d_a0} / 2" + high.replace("+", "-"))
    if gear.circumferential_thinning:
        backlash = gear.circumferential_thinning * math.cos(shaper.pressure_angle)
        page.add("normal_backlash", backlash, "{A} * cos({alpha})")


def _base(gear: FaceGear) -> str:
    """The base diameter of the shaper in formulas: that of the pinion, unless it has more teeth."""
    return "d_b0" if gear.more_teeth else "d_b1"


def _limits(page: Sheet, gear: FaceGear) -> None:
    """Undercut, the base circle, pointed tips; two angles are roots of one equation each."""
    page.section(N_("Limits of the face"))
    plane, base = "{d_b1} * {u} / (2 * cos({%s}))", _base(gear)
    angle = gear.undercut_angle
    # s (s - r_b tan alpha) = (x tan alpha)^2
    page.add("undercut_angle_deg", math.degrees(angle), "", _LITVIN)
    page.add("undercut_plane", float(gear.section_x(angle)), plane % "alpha_u")
    page.add("undercut_diameter", 2 * gear.undercut_radius, _PLACE % ("x_u", base, "alpha_u", "s_F", "alpha_u"))
    if gear.form_radius(0.0):
        page.add("base_limit_angle_deg", math.degrees(math.acos(gear.tip_depth / gear.shaper.base_radius)),
                 f"arccos(2 * {{h_t}} / {{{base}}})")  # fmt: skip
        limit = f"sqrt(({{d_b1}} * {{u}} / cos({{alpha_l}}))**2 + ({{{base}}} * sin({{alpha_l}}))**2)"
        page.add("base_limit_diameter", 2 * gear.form_radius(0.0), limit)
    # of the plane of the flank's pointed end
    angle = math.acos(float(gear.section_x(0.0) / gear.side(FLANK, 1.0, gear.pointed_radius).x))
    page.add("pointed_angle_deg", math.degrees(angle), "", _LITVIN)
    page.add("pointed_plane", float(gear.section_x(angle)), plane % "alpha_p")
    length = float(gear.tip_length(np.asarray(angle)))
    page.add("pointed_length", length, f"({{h_t}} - {{{base}}} / 2 * cos({{alpha_p}})) / sin({{alpha_p}})")
    page.add("pointed_diameter", 2 * gear.pointed_radius, _PLACE % ("x_p", base, "alpha_p", "s_p", "alpha_p"))


def _face(page: Sheet, gear: FaceGear) -> None:
    page.section(N_("Face and contact"))
    page.told(face_inner_diameter=2 * gear.inner_radius, face_outer_diameter=2 * gear.outer_radius)
    page.add("face_width", gear.face_width, "({D_e} - {D_i}) / 2")
    inner, outer = gear.tip_thickness([gear.inner_radius, gear.outer_radius]).tolist()
    page.told(inner_tip_thickness=inner, outer_tip_thickness=outer)
    if not gear.more_teeth:
        middle = (gear.inner_radius + gear.outer_radius) / 2
        page.add("middle_plane", middle, "({D_i} + {D_e}) / 4")
        formula = "arccos({d_b1} * {u} / (2 * {x_m}))"
        page.add("middle_angle_deg", math.degrees(_plane_angle(gear, middle)), formula)


def _plane_angle(gear: FaceGear, x: float) -> float:
    return math.acos(float(gear.section_x(0.0)) / x)


def _forces(page: Sheet, gear: FaceGear, keys: FaceKeys) -> None:
    """Along the line of action in the middle of the face, where a load is given, the pinion driving."""
    torque = driving_torque(page, keys)
    if torque is None:
        return
    page.add("gear_torque", torque * gear.ratio, "{T1} * {u}", gear=2)
    normal = 1000 * torque / gear.cutter.base_radius
    page.add("normal_force", normal, "2000 * {T1} / {d_b1}")
    name, alpha = "alpha_m", _plane_angle(gear, (gear.inner_radius + gear.outer_radius) / 2)
    if gear.more_teeth:
        name, alpha = "alpha_c", gear.contact_angle
    page.add("circumferential_force", normal * math.cos(alpha), f"{{F_n}} * cos({{{name}}})")
    across = normal * math.sin(alpha)
    page.add("radial_force", across, f"{{F_n}} * sin({{{name}}})", gear=1)
    page.add("axial_force", across, "{F_r1}", gear=2)
