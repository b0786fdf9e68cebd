"""``higherpair calc spur``: one external gear, spur or helical: dimensions, limits and what a calliper reads."""

from __future__ import annotations

import math
from typing import Annotated

from msgspec import Meta

from geometry.base.record import replace
from geometry.gears.teeth import limits, measurement
from geometry.gears.teeth.cutter import PinionCutter
from geometry.gears.teeth.limits import LEAST_TIP_THICKNESS, checked_gear
from geometry.gears.teeth.ring import RingGear
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import base_helix_angle, helix_angle_at, normal_share, transverse_angle
from parts.base.texts import N_
from parts.gears.spur_gear.part import SpurGearSpec, checked_spur_gear, gear_of, rack_findings
from parts.keys.base import mm
from parts.pages.inputs import calculation, part_of_kind
from parts.pages.measured_steps import Asked, measured_steps
from parts.pages.page import Sheet
from parts.pages.roll_steps import gear_rolls
from parts.texts.findings import finding_message

TOPIC = "spur"
_LESSON = "practicum, fig. 3.3"
table_from = part_of_kind("spur_gear")

_MEASURED_OVER_PINS = mm("size over pins or balls measured on the part", above=0, most=100_000)


class SpurKeys(SpurGearSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the topic: those of a spur gear, and what is measured."""

    teeth_spanned: Annotated[int, Meta(ge=1, le=10_000, description="teeth in the span")] | None = None
    pin_diameter: Annotated[float, mm("pin or ball", above=0, most=10_000)] | None = None
    kerf: Annotated[float, mm("full width of a cut that was not corrected for", least=0, most=10)] | None = None
    measured_span: Annotated[float, mm("span measured on the part", above=0, most=100_000)] | None = None
    measured_over_pins: Annotated[float, _MEASURED_OVER_PINS] | None = None
    diameter: Annotated[float, mm("circle on which the tooth is measured", above=0, most=100_000)] | None = None


@calculation(TOPIC, SpurKeys)
def sheet(keys: SpurKeys) -> Sheet:
    """The calculation of one gear."""
    helix = math.radians(keys.helix_angle_deg)
    normal = checked_spur_gear(keys) if helix == 0 else gear_of(keys)
    gear = checked_gear(normal, helix)
    page = Sheet(TOPIC, N_("External gear"))
    page.section("Given")
    given_data(page, normal, gear, helix)
    dimensions(page, gear, helix)
    _thicknesses(page, gear, helix, keys.diameter)
    gear_rolls(page, gear)
    _limits(page, gear, helix)
    measured, face = (keys.measured_span, keys.measured_over_pins), (keys.face_width, keys.double_helical)
    asked = Asked(helix, *face, keys.teeth_spanned, keys.pin_diameter, keys.kerf, *measured)
    measured_steps(page, gear, asked)
    if keys.crowning:
        less = 2 * keys.crowning * normal_share(gear.pressure_angle, helix)
        page.note(N_("crowned teeth: their sizes are those where they are thickest; "
                     "at either face the span is {less:g} mm less"), less=less)  # fmt: skip
    page.notes += [finding_message(f) for f in rack_findings(keys, gear)]
    return page


def section_data(page: Sheet, normal_module: float, normal_pressure_angle: float, helix: float) -> None:
    """Module and pressure angle; of helical teeth the normal ones, the helix, and what follows from them.

    ``{m_n}`` and ``{alpha_n}`` stand in the formulas of both: coefficients are told in normal modules.
    """
    alpha = math.degrees(normal_pressure_angle)
    if not helix:
        page.told(module=normal_module, pressure_angle_deg=alpha)
        page.name("m_n", "m")
        page.name("alpha_n", "alpha")
        return
    page.add("module", normal_module, symbol="m_n", key="m_n")
    page.add("helix_angle_deg", math.degrees(helix))
    page.add("pressure_angle_deg", alpha, symbol="α_n", key="alpha_n")
    page.add("transverse_module", normal_module / math.cos(helix), "{m_n} / cos({beta})", "ISO 21771")
    transverse = transverse_angle(normal_pressure_angle, helix)
    formula = "arctan(tan({alpha_n}) / cos({beta}))"
    page.add("transverse_pressure_angle_deg", math.degrees(transverse), formula, "ISO 21771")
    angle = math.degrees(base_helix_angle(transverse, helix))
    page.add("base_helix_angle_deg", angle, "arctan(tan({beta}) * cos({alpha}))", "ISO 21771")


def shift_data(page: Sheet, normal_shift: float, helix: float, index: int = 0) -> None:
    """The profile shift, ``{x_n#}`` in formulas; of helical teeth the normal one and the transverse."""
    if not helix:
        page.add("profile_shift_coefficient", normal_shift, gear=index)
        page.name("x_n", "x", index)
        return
    page.add("profile_shift_coefficient", normal_shift, "", "", index, symbol="x_n", key="x_n")
    value = normal_shift * math.cos(helix)
    page.add("transverse_profile_shift_coefficient", value, "{x_n#} * cos({beta})", "ISO 21771", index)


def given_data(page: Sheet, normal: SpurGear, gear: SpurGear, helix: float, index: int = 0) -> None:
    """Module, angle, rack and shift; of helical gears first the normal data, then the transverse that follow."""
    rack = normal.rack
    if index < 2:
        section_data(page, normal.module, rack.pressure_angle, helix)
    page.add("number_of_teeth", gear.number_of_teeth, gear=index)
    sector_data(page, gear, index)
    shift_data(page, normal.profile_shift_coefficient, helix, index)
    page.add("addendum_coefficient", rack.addendum, gear=index)
    if normal.cutter is None:
        page.add("tip_clearance_coefficient", rack.tip_clearance, gear=index)
        page.add("tip_radius_coefficient", rack.tip_radius, gear=index)
    else:
        # of the rack only the addendum is left
        cutter_data(page, normal.cutter, index)
    if rack.relief is not None:
        page.add("relief_depth_coefficient", rack.relief.depth, gear=index)
        page.add("relief_height_coefficient", rack.relief.height, gear=index)
    thinning_data(page, gear, helix, "-", index)


def sector_data(page: Sheet, gear: SpurGear | RingGear, index: int = 0) -> None:
    """The teeth that a sector keeps of all; those of each run of several."""
    if gear.sector is not None:
        page.add("sector_teeth", gear.sector.teeth, gear=index)
        if gear.sector.runs > 1:
            page.add("sector_runs", gear.sector.runs, gear=index)


def sector_steps(page: Sheet, gear: SpurGear | RingGear) -> None:
    """The angle that a sector's teeth take, and the arc on the reference circle: what they move a rack by."""
    if gear.sector is not None:
        page.add("sector_angle_deg", math.degrees(gear.sector.teeth * gear.pitch_angle), "360 * {z_s} / {z}")
        page.add("sector_arc", gear.sector.teeth * math.pi * gear.module, "{z_s} * {p}")


def thinning_data(page: Sheet, gear: SpurGear | RingGear, helix: float, sign: str, index: int = 0) -> None:
    """What the teeth are thinned by, and the shift that a deeper cut, on the side of ``sign``, makes of it."""
    if gear.circumferential_thinning:
        page.add("circumferential_thinning", gear.circumferential_thinning, gear=index)
        if gear.thinning_by_deeper_cut:
            formula = f"{{x_n#}} {sign} {{A#}} / (2 * {{m_n}} * tan({{alpha}}))"
            value = gear.generating_shift_coefficient / math.cos(helix)
            page.add("generating_shift_coefficient", value, formula, "ISO 21771", index)


def cutter_data(page: Sheet, cutter: PinionCutter, index: int = 0, normal: float = 1.0) -> None:
    """The pinion cutter that makes the root; ``normal``: its coefficients in normal modules."""
    page.add("cutter_teeth", cutter.number_of_teeth, gear=index)
    page.add("cutter_shift", cutter.profile_shift_coefficient * normal, gear=index)
    page.add("cutter_addendum", cutter.addendum * normal, gear=index)
    page.add("cutter_tip_rounding", cutter.tip_rounding * normal, gear=index)


def addendum_formula(shortening: str = "") -> str:
    """h_a + x m, over placeholders."""
    return f"({{h_a#}} + {{x_n#}}{shortening}) * {{m_n}}"


def generating_shift(gear: SpurGear | RingGear) -> str:
    """The shift that the root follows, as a placeholder."""
    return "{x_E#}" if gear.circumferential_thinning and gear.thinning_by_deeper_cut else "{x_n#}"


def dedendum_formula(gear: SpurGear) -> str:
    """h_f - x m of a root that a rack cuts, over placeholders."""
    return f"({{h_a#}} + {{c#}} - {generating_shift(gear)}) * {{m_n}}"


def root_radius_step(page: Sheet, gear: SpurGear, index: int) -> None:
    """r_f of one gear of a pair; one that a pinion cutter makes has its formula on the page of the gear."""
    if gear.cutter is None:
        source = f"practicum (3.{12 + index})"
        page.add("root_radius", gear.root_radius, f"{{r#}} - {dedendum_formula(gear)}", source, index)
    else:
        page.add("root_radius", gear.root_radius, "", "ISO 21771", index)


def thickness_formula(gear: SpurGear) -> str:
    """S with or without thinning, over placeholders."""
    less = " - {A#}" if gear.circumferential_thinning else ""
    return "0.5 * {p} + 2 * {x#} * {m} * tan({alpha})" + less


def dimensions(page: Sheet, gear: SpurGear, helix: float) -> None:
    """Pitches and diameters of one gear."""
    page.section("Diameters")
    page.add("pitch", math.pi * gear.module, "pi * {m}", "practicum, table 1.1")
    page.add("base_pitch", gear.pitch_angle * gear.base_radius, "{p} * cos({alpha})", "ISO 21771")
    helix_steps(page, gear.module, gear.number_of_teeth, helix)
    page.add("reference_diameter", 2 * gear.reference_radius, "{m} * {z}", "practicum (3.7)")
    page.add("base_diameter", 2 * gear.base_radius, "{d} * cos({alpha})", "practicum, table 1.1")
    formula = "" if gear.given_tip_diameter is not None else f"{{d}} + 2 * {addendum_formula()}"
    page.add("tip_diameter", 2 * gear.tip_radius, formula, "practicum (3.11)" if formula else "")
    if gear.cutter is None:
        formula = f"{{d}} - 2 * {dedendum_formula(gear)}"
        page.add("root_diameter", 2 * gear.root_radius, formula, "practicum (3.13)")
    else:
        generated_root(page, gear, "ISO 21771", "+", "-")
    page.add("root_form_diameter", limits.root_form_diameter(gear), "", "ISO 21771")
    heights = gear.tip_radius - gear.reference_radius, gear.reference_radius - gear.root_radius
    height_steps(page, heights, ("({d_a} - {d}) / 2", "({d} - {d_f}) / 2"))
    sector_steps(page, gear)


def generated_root(page: Sheet, gear: SpurGear | RingGear, source: str, out: str, back: str) -> None:
    """The root circle that the tips of a pinion cutter come to; the signs of what it adds, and takes off again."""
    formula = f"({generating_shift(gear)} {out} {{x_0}}) * tan({{alpha_n}}) / ({{z}} {out} {{z_0}})"
    page.add(
        "generating_angle_deg", math.degrees(gear.generating_angle), f"arcinv(inv({{alpha}}) + 2 * {formula})", source
    )
    formula = f"({{z}} {out} {{z_0}}) * {{m}} * cos({{alpha}}) / (2 * cos({{alpha_w0}}))"
    page.add("generating_distance", gear.generating_distance, formula, source)
    formula = f"2 * {{a_w0}} {back} {{m}} * {{z_0}} {back} 2 * ({{h_a0}} + {{x_0}}) * {{m_n}}"
    page.add("root_diameter", 2 * gear.root_radius, formula, source)


def normal_tip_step(
    page: Sheet, gear: SpurGear | RingGear, thickness: float, helix: float, index: int = 0, radius: str = "d"
) -> None:
    """S_an of helical teeth after their transverse S_a; ``radius``: r or d, which the page has of tip and reference."""
    if helix:
        across = helix_angle_at(helix, gear.tip_radius / gear.reference_radius)
        formula = f"{{S_a#}} * cos(arctan({{{radius}_a#}} * tan({{beta}}) / {{{radius}#}}))"
        page.add("normal_tip_thickness", thickness * math.cos(across), formula, "ISO 21771", index)


def thickness_steps(page: Sheet, gear: SpurGear | RingGear, diameter: float | None, formula: str) -> None:
    """Pressure angle and thickness on a circle that is asked for."""
    if diameter is not None:
        page.add("diameter", diameter)
        angle = math.degrees(measurement.angle_at(gear, diameter / 2))
        page.add("pressure_angle_at_diameter_deg", angle, "arccos({d_b} / {d_y})", "ISO 21771")
        page.add("thickness_at_diameter", measurement.thickness_at(gear, diameter / 2), formula, "ISO 21771")


def helix_steps(page: Sheet, module: float, teeth: int, helix: float) -> None:
    """Pitches across and along the axis, lead and virtual teeth of helical teeth; ``module`` is the transverse one."""
    if not helix:
        return
    pitch = math.pi * module / math.tan(abs(helix))
    page.add("normal_pitch", math.pi * module * math.cos(helix), "pi * {m_n}", "ISO 21771")
    page.add("axial_pitch", pitch, "pi * {m_n} / sin(abs({beta}))", "ISO 21771")
    page.add("tooth_lead", teeth * pitch, "{z} * {p_x}", "ISO 21771")
    page.add("virtual_teeth", teeth / math.cos(helix) ** 3, "{z} / cos({beta})**3", "GOST 16532-70")


def height_steps(page: Sheet, heights: tuple[float, float], formulas: tuple[str, str], index: int = 0) -> None:
    """Addendum and dedendum from the reference circle, and the whole depth of the tooth."""
    page.add("tooth_addendum", heights[0], formulas[0], _LESSON, index)
    page.add("tooth_dedendum", heights[1], formulas[1], _LESSON, index)
    page.add("tooth_depth", sum(heights), "{H_a#} + {H_f#}", _LESSON, index)


def _thicknesses(page: Sheet, gear: SpurGear, helix: float, diameter: float | None) -> None:
    page.section("Tooth thickness")
    page.add("profile_shift", gear.profile_shift_coefficient * gear.module, "{x} * {m}", "practicum (1.1)")
    page.add("reference_thickness", gear.reference_thickness, thickness_formula(gear), "practicum (3.16)")
    page.add("space_width", math.pi * gear.module - gear.reference_thickness, "{p} - {S}", "practicum, table 1.1")
    page.add("base_thickness", measurement.base_thickness(gear), "{d_b} * ({S} / {d} + inv({alpha}))", "ISO 21771")
    angle = math.degrees(measurement.angle_at(gear, gear.tip_radius))
    page.add("tip_pressure_angle_deg", angle, "arccos({d_b} / {d_a})", "practicum (3.18)")
    formula = "{d_a} * ({S} / {d} + inv({alpha}) - inv({alpha_a}))" if gear.rack.relief is None else ""
    page.add("tip_thickness", limits.tip_thickness(gear), formula, "ISO 21771")
    normal_tip_step(page, gear, limits.tip_thickness(gear), helix)
    thickness_steps(page, gear, diameter, "{d_y} * ({S} / {d} + inv({alpha}) - inv({alpha_y}))")


def _limits(page: Sheet, gear: SpurGear, helix: float) -> None:
    page.section("Undercut and pointed tip")
    rack = gear.cutter is None
    height = "({h_a} + {c} - {rho_f} * (1 - sin({alpha})))" if rack and not helix else ""
    if rack:
        sine = math.sin(gear.pressure_angle) ** 2
        formula = f"2 * {height} / sin({{alpha}})**2" if height else ""
        page.add("least_number_of_teeth", 2 * gear.rack.form_dedendum / sine, formula, "ISO 21771")
    if rack and not helix:
        rule_step(page, gear)
    formula = f"{height} - {{z}} * sin({{alpha}})**2 / 2" if height else ""
    least = limits.least_shift_without_undercut(gear) / math.cos(helix)
    page.add("least_shift_without_undercut", least, formula, "ISO 21771", symbol="x_n,min" if helix else "")
    page.add("pointed_diameter", limits.pointed_diameter(gear))
    least_tip_step(page, gear.module)
    greatest = greatest_shift(gear)
    if greatest is not None:
        symbol = "x_n,0.3" if helix else ""
        page.add("greatest_shift_for_tip_thickness", greatest / math.cos(helix), "", "practicum (1.3)", symbol=symbol)
    page.note("practicum (1.3) prints x_0.3 <= x <= x_min; right is x_min <= x <= x_0.3")
    if limits.undercut_shifts(gear, helix) is not None:
        page.note("the tooth is undercut: x < x_min")
    if limits.thin_tips(gear):
        page.note("the tip is thinner than 0.3 m")


def rule_step(page: Sheet, gear: SpurGear, index: int = 0) -> None:
    """The least shift by the rule of textbooks."""
    least, practicums = limits.practicum_undercut(gear).limit, (limits.rule_teeth(gear), gear.rack.addendum) == (17, 1)
    page.add("least_shift_practicum", least, rule_formula(gear), "practicum (1.2)" if practicums else "", index)


def rule_formula(gear: SpurGear) -> str:
    """How a page writes ``limits.practicum_undercut``."""
    least = limits.rule_teeth(gear)
    return ("" if gear.rack.addendum == 1 else "{h_a#} * ") + f"({least} - {{z#}}) / {least}"


def least_tip_step(page: Sheet, module: float) -> None:
    """How thick a tip is at least, by the practicum."""
    formula = f"{LEAST_TIP_THICKNESS} * {{m}}"
    page.add("least_tip_thickness", LEAST_TIP_THICKNESS * module, formula, "practicum (1.3)")


def greatest_shift(gear: SpurGear) -> float | None:
    """x at which S_a falls to 0.3 m with the rack's full tooth height, found from the gear's own shift outwards."""
    from geometry.base.roots import bracketed_root

    def spare(x: float) -> float:
        changed = replace(gear, profile_shift_coefficient=x, given_tip_diameter=None)
        tip = changed.tip_radius
        return -2 * tip * changed.flank().polar_angle_at_radius(tip) / gear.module - LEAST_TIP_THICKNESS

    low, high = limits.least_shift_without_undercut(gear), gear.profile_shift_coefficient
    low = min(low, high)
    high = max(low, high) + 1
    while spare(high) > 0 and high < 100:
        # doubled, but for a shift below 0, which doubling would not raise
        high += high if high > 0 else 1.0
    return bracketed_root(spare, low, high).value if spare(low) > 0 > spare(high) else None
