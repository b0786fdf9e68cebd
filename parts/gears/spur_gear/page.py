"""``higherpair calc spur``: one external gear, spur or helical: dimensions, limits and what a calliper reads."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Annotated, Any

from msgspec import Meta

from geometry.base.errors import ParameterError
from geometry.gears.teeth import limits, measurement
from geometry.gears.teeth.limits import LEAST_TIP_THICKNESS
from geometry.gears.teeth.measurement import SPAN_CONTACT
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import base_helix_angle
from parts.base.refusal import REMOVED, SceneError
from parts.base.texts import N_, message
from parts.gears.spur_gear.part import SpurGearSpec, checked_spur_gear, gear_of, section_of
from parts.keys.base import mm
from parts.pages.inputs import PLACE, SceneKeys, checked, part_of_kind, refusal
from parts.pages.page import Sheet

TOPIC = "spur"


class SpurKeys(SpurGearSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the topic: those of a spur gear, and what is measured."""

    teeth_spanned: Annotated[int, Meta(ge=1, le=10_000, description="teeth in the span")] | None = None
    pin_diameter: Annotated[float, mm("pin or ball", above=0, most=10_000)] | None = None
    kerf: Annotated[float, mm("full width of a cut that was not corrected for", least=0, most=10)] | None = None
    measured_span: Annotated[float, mm("span measured on the part", above=0, most=100_000)] | None = None
    diameter: Annotated[float, mm("circle on which the tooth is measured", above=0, most=100_000)] | None = None


def table_from(scene: SceneKeys, source: str, table: dict[str, Any]) -> dict[str, Any]:
    """The keys of a part of a scene, changed by those of the command line."""
    return part_of_kind(scene, source, table, "spur_gear")


def sheet(table: dict[str, Any]) -> Sheet:
    """The calculation of one gear."""
    if "part" in table:
        raise SceneError(PLACE, "part", table["part"], "part_without_scene", REMOVED)
    keys: SpurKeys = checked(table, SpurKeys, TOPIC)
    try:
        helix = math.radians(keys.helix_angle_deg)
        normal = checked_spur_gear(keys) if helix == 0 else gear_of(keys)
        gear = section_of(normal, helix)
        page = Sheet(TOPIC, N_("External gear"))
        page.section(N_("Given"))
        given_data(page, normal, gear, helix)
        dimensions(page, gear, helix)
        _thicknesses(page, gear, keys.diameter)
        _limits(page, gear, helix)
        _measured(page, gear, helix, keys)
    except ParameterError as error:
        raise refusal(TOPIC, error, keys=keys) from error
    return page


def given_data(page: Sheet, normal: SpurGear, gear: SpurGear, helix: float, index: int = 0) -> None:
    """Module, angle, rack and shift; of helical gears first the normal data, then the transverse that follow."""
    rack = normal.rack
    alpha, shift = math.degrees(rack.pressure_angle), normal.profile_shift_coefficient
    if index < 2 and helix:
        page.add("module", normal.module, symbol="m_n", key="m_n")
        page.add("helix_angle_deg", math.degrees(helix))
        page.add("pressure_angle_deg", alpha, symbol="α_n", key="alpha_n")
        page.add("transverse_module", gear.module, "{m_n} / cos({beta})", "ISO 21771")
        formula = "arctan(tan({alpha_n}) / cos({beta}))"
        page.add("transverse_pressure_angle_deg", math.degrees(gear.rack.pressure_angle), formula, "ISO 21771")
        angle = math.degrees(base_helix_angle(gear.rack.pressure_angle, helix))
        page.add("base_helix_angle_deg", angle, "arctan(tan({beta}) * cos({alpha}))", "ISO 21771")
    elif index < 2:
        page.add("module", normal.module)
        page.add("pressure_angle_deg", alpha)
    page.add("number_of_teeth", gear.number_of_teeth, gear=index)
    if helix:
        page.add("profile_shift_coefficient", shift, "", "", index, symbol="x_n", key="x_n")
        formula, value = "{x_n#} * cos({beta})", gear.profile_shift_coefficient
        page.add("transverse_profile_shift_coefficient", value, formula, "ISO 21771", index)
    else:
        page.add("profile_shift_coefficient", shift, gear=index)
    page.add("addendum_coefficient", rack.addendum, gear=index)
    page.add("tip_clearance_coefficient", rack.tip_clearance, gear=index)
    page.add("tip_radius_coefficient", rack.tip_radius, gear=index)
    if gear.circumferential_thinning:
        page.add("circumferential_thinning", gear.circumferential_thinning, gear=index)
        if gear.thinning_by_deeper_cut:
            formula = "{x#} - {A#} / (2 * {m} * tan({alpha}))"
            page.add("generating_shift_coefficient", gear.generating_shift_coefficient, formula, "ISO 21771", index)


def addendum_formula(helix: float, shortening: str = "") -> str:
    """h_a + x m, or with the normal module and the transverse shift, over placeholders."""
    if helix:
        return f"{{h_a#}} * {{m_n}} + ({{x#}}{shortening}) * {{m}}" if shortening else "{h_a#} * {m_n} + {x#} * {m}"
    return f"({{h_a#}} + {{x#}}{shortening}) * {{m}}"


def dedendum_formula(gear: SpurGear, helix: float) -> str:
    """The same for h_f - x m."""
    shift = thinned_shift(gear)
    if helix:
        return f"({{h_a#}} + {{c#}}) * {{m_n}} - {shift} * {{m}}"
    return f"({{h_a#}} + {{c#}} - {shift}) * {{m}}"


def _enclosed(formula: str, helix: float) -> str:
    """A sum in brackets; of spur gears it is a product."""
    return f"({formula})" if helix else formula


def thinned_shift(gear: SpurGear, index: str = "#") -> str:
    """The shift that the root follows, as a placeholder."""
    return f"{{x_E{index}}}" if gear.circumferential_thinning and gear.thinning_by_deeper_cut else f"{{x{index}}}"


def thickness_formula(gear: SpurGear) -> str:
    """S with or without thinning, over placeholders."""
    less = " - {A#}" if gear.circumferential_thinning else ""
    return "0.5 * {p} + 2 * {x#} * {m} * tan({alpha})" + less


def dimensions(page: Sheet, gear: SpurGear, helix: float) -> None:
    """Pitches and diameters of one gear."""
    page.section(N_("Diameters"))
    page.add("pitch", math.pi * gear.module, "pi * {m}", "practicum, table 1.1")
    page.add("base_pitch", gear.pitch_angle * gear.base_radius, "{p} * cos({alpha})", "ISO 21771")
    page.add("reference_diameter", 2 * gear.reference_radius, "{m} * {z}", "practicum (3.7)")
    page.add("base_diameter", 2 * gear.base_radius, "{d} * cos({alpha})", "practicum, table 1.1")
    formula = "" if gear.given_tip_diameter is not None else f"{{d}} + 2 * {_enclosed(addendum_formula(helix), helix)}"
    page.add("tip_diameter", 2 * gear.tip_radius, formula, "practicum (3.11)" if formula else "")
    formula = f"{{d}} - 2 * {_enclosed(dedendum_formula(gear, helix), helix)}"
    page.add("root_diameter", 2 * gear.root_radius, formula, "practicum (3.13)")
    page.add("root_form_diameter", limits.root_form_diameter(gear), "", "ISO 21771")


def _thicknesses(page: Sheet, gear: SpurGear, diameter: float | None) -> None:
    page.section(N_("Tooth thickness"))
    page.add("profile_shift", gear.profile_shift_coefficient * gear.module, "{x} * {m}", "practicum (1.1)")
    page.add("reference_thickness", gear.reference_thickness, thickness_formula(gear), "practicum (3.16)")
    page.add("space_width", math.pi * gear.module - gear.reference_thickness, "{p} - {S}", "practicum, table 1.1")
    page.add("base_thickness", measurement.base_thickness(gear), "{d_b} * ({S} / {d} + inv({alpha}))", "ISO 21771")
    angle = math.degrees(measurement.angle_at(gear, gear.tip_radius))
    page.add("tip_pressure_angle_deg", angle, "arccos({d_b} / {d_a})", "practicum (3.18)")
    formula = "{d_a} * ({S} / {d} + inv({alpha}) - inv({alpha_a}))"
    if gear.rack.relief is not None:
        formula = ""
    page.add("tip_thickness", limits.tip_thickness(gear), formula, "ISO 21771")
    if diameter is not None:
        thickness = measurement.thickness_at(gear, diameter / 2)
        page.add("diameter", diameter)
        page.add(
            "pressure_angle_at_diameter_deg",
            math.degrees(measurement.angle_at(gear, diameter / 2)),
            "arccos({d_b} / {d_y})",
            "ISO 21771",
        )
        page.add("thickness_at_diameter", thickness, "{d_y} * ({S} / {d} + inv({alpha}) - inv({alpha_y}))", "ISO 21771")


def _limits(page: Sheet, gear: SpurGear, helix: float) -> None:
    page.section(N_("Undercut and pointed tip"))
    sine = math.sin(gear.rack.pressure_angle) ** 2
    height = "({h_a} + {c} - {rho_f} * (1 - sin({alpha})))" if not helix else ""
    formula = f"2 * {height} / sin({{alpha}})**2" if height else ""
    page.add("least_number_of_teeth", 2 * gear.rack.form_dedendum / sine, formula, "ISO 21771")
    if not helix:
        rule = limits.practicum_undercut(gear).limit
        page.add("least_shift_practicum", rule, "(17 - {z}) / 17", "practicum (1.2)")
    formula = f"{height} - {{z}} * sin({{alpha}})**2 / 2" if height else ""
    least = limits.least_shift_without_undercut(gear) / math.cos(helix)
    page.add("least_shift_without_undercut", least, formula, "ISO 21771", symbol="x_n,min" if helix else "")
    page.add("pointed_diameter", limits.pointed_diameter(gear))
    page.add(
        "least_tip_thickness", LEAST_TIP_THICKNESS * gear.module, f"{LEAST_TIP_THICKNESS} * {{m}}", "practicum (1.3)"
    )
    greatest = greatest_shift(gear)
    if greatest is not None:
        symbol = "x_n,0.3" if helix else ""
        page.add("greatest_shift_for_tip_thickness", greatest / math.cos(helix), "", "practicum (1.3)", symbol=symbol)
    page.notes.append(N_("practicum (1.3) prints x_0.3 <= x <= x_min; right is x_min <= x <= x_0.3"))
    if limits.undercut(gear).margin < 0:
        page.notes.append(N_("the tooth is undercut: x < x_min"))
    if limits.thin_tip(gear).margin < 0:
        page.notes.append(N_("the tip is thinner than 0.3 m"))


def greatest_shift(gear: SpurGear) -> float | None:
    """x at which S_a falls to 0.3 m with the rack's full tooth height, found from the gear's own shift outwards."""
    from geometry.base.roots import bracketed_root

    def spare(x: float) -> float:
        changed = replace(gear, profile_shift_coefficient=x, given_tip_diameter=None)
        return -2 * changed.tip_radius * float(
            changed.flank().polar_angle_at_radius(changed.tip_radius)
        ) / gear.module - (LEAST_TIP_THICKNESS)

    low, high = limits.least_shift_without_undercut(gear), gear.profile_shift_coefficient
    low = min(low, high)
    high = max(low, high) + 1
    while spare(high) > 0 and high < 100:
        high *= 2
    return bracketed_root(spare, low, high).value if spare(low) > 0 > spare(high) else None


def _measured(page: Sheet, gear: SpurGear, helix: float, keys: SpurKeys) -> None:
    page.section(N_("Span"))
    cosine = " * cos({beta_b})" if helix else ""
    page.add("teeth_to_span", measurement.teeth_to_span(gear, helix), "", "GOST 16532-70")
    best = measurement.best_span(gear, helix)
    if keys.teeth_spanned is not None:
        best = measurement.span(gear, keys.teeth_spanned, helix)
    if best is None:
        page.notes.append(N_("no span touches the flanks of this gear"))
    else:
        page.add("teeth_spanned", best.teeth)
        formula = "({k} - 1) * {p_b} + {S_b}"
        formula = f"({formula}){cosine}" if helix else formula
        page.add("span", best.length, formula, "ISO 21771")
        if gear.circumferential_thinning:
            full = measurement.span(measurement.nominal(gear), best.teeth, helix).length
            page.add("span_nominal", full, f"{{W}} + {{A}} * cos({{alpha}}){cosine}", "ISO 21771")
        formula = f"sqrt({{d_b}}**2 + ({{W}}{cosine})**2)" if helix else "sqrt({d_b}**2 + {W}**2)"
        page.add("span_contact_diameter", best.contact_diameter, formula, "GOST 16532-70")
        _real_part(page, gear, best, helix, keys)
        if helix:
            _span_width(page, best, keys.face_width)
        if not best.touches_flanks:
            page.notes.append(N_("the span does not touch the involutes"))
    _pins(page, gear, helix, keys.pin_diameter, keys.kerf)
    page.section(N_("Chords"))
    chord, constant = measurement.reference_chord(gear, helix), measurement.constant_chord(gear, helix)
    formulas = ("", "") if helix else ("{d} * sin({S} / {d})", "({d_a} - {d} * cos({S} / {d})) / 2")
    page.add("chordal_thickness", chord.thickness, formulas[0], "GOST 16532-70")
    page.add("chordal_height", chord.height, formulas[1], "GOST 16532-70")
    formulas = ("", "") if helix else ("{S} * cos({alpha})**2", "({d_a} - {d} - {S_c} * tan({alpha})) / 2")
    page.add("constant_chord", constant.thickness, formulas[0], "GOST 16532-70")
    page.add("constant_chord_height", constant.height, formulas[1], "GOST 16532-70")


def _span_width(page: Sheet, best: measurement.Span, face_width: float) -> None:
    """What the face must be wide for the span of helical teeth, and what it is."""
    page.add("face_width", face_width)
    page.add("least_face_width", best.least_face_width, "{W} * sin(abs({beta_b}))", "ISO 21771")
    formula = f"{{b_min}} + ({SPAN_CONTACT[0]} + {SPAN_CONTACT[1]} * {{W}}) * cos({{beta_b}})"
    page.add("secure_face_width", best.secure_face_width, formula, "DIN 3960")
    if face_width < best.least_face_width:
        page.notes.append(
            message(
                "the face width of {width:g} mm is too small for the span: above {least:.4f} mm is needed; measure "
                "over balls",
                width=face_width,
                least=best.least_face_width,
            )
        )
    elif face_width < best.secure_face_width:
        page.notes.append(
            message(
                "the span finds little hold on a face width of {width:g} mm: {secure:.4f} mm is secure",
                width=face_width,
                secure=best.secure_face_width,
            )
        )


def _real_part(page: Sheet, gear: SpurGear, best: measurement.Span, helix: float, keys: SpurKeys) -> None:
    """The span that a cut without correction leaves, and what a measured span tells."""
    cosine = " * cos({beta_b})" if helix else ""
    if keys.kerf:
        page.add("kerf", keys.kerf)
        # each face touches a flank that lies half a kerf deeper along its normal
        page.add("span_after_kerf", best.length - keys.kerf, "{W} - {kerf}")
    if keys.measured_span is not None:
        page.add("measured_span", keys.measured_span)
        page.add("normal_allowance", best.length - keys.measured_span, "{W} - {W_m}")
        thinned = measurement.gear_with_span(gear, best.teeth, keys.measured_span, helix).circumferential_thinning
        own = " + {A}" if gear.circumferential_thinning else ""
        page.add("thinning_from_span", thinned, f"{{E}} / (cos({{alpha}}){cosine}){own}", "ISO 21771")


# what is laid into the spaces: cylinders (pins) with straight teeth, balls with helical ones
_PINS = {
    name: (name, name.replace("pin", "ball"))
    for name in (
        "best_pin_diameter", "least_pin_diameter", "greatest_pin_diameter", "pin_diameter", "pin_centre_angle_deg",
        "pin_centre_diameter", "over_pins", "over_pins_nominal", "over_pins_after_kerf", "pin_contact_diameter",
    )
}  # fmt: skip


def _pins(page: Sheet, gear: SpurGear, helix: float, wanted: float | None, kerf: float | None) -> None:
    """Over pins, over balls where the teeth are helical, and when pins give the same there."""
    balls = bool(helix)

    def add(name: str, value: float, formula: str = "", source: str = "") -> None:
        page.add(_PINS[name][balls], value, formula, source)

    page.section(N_("Over balls") if balls else N_("Over pins"))
    cosine = " / cos({beta_b})" if helix else ""
    try:
        best = measurement.best_pin_diameter(gear, helix)
        low, high = measurement.pin_limits(gear, helix)
    except ParameterError:
        page.notes.append(
            N_("no ball touches both flanks of a space") if balls else N_("no pin touches both flanks of a space")
        )
        return
    add("best_pin_diameter", best, "", "ISO 21771")
    add("least_pin_diameter", low)
    add("greatest_pin_diameter", high)
    pin = best if wanted is None else wanted
    found = measurement.over_pins(gear, pin, helix)
    add("pin_diameter", pin)
    angle = math.degrees(math.acos(2 * gear.base_radius / found.centre_diameter))
    formula = f"arcinv({{D}} / {{d_b}}{cosine} + {{S_b}} / {{d_b}} - pi / {{z}})"
    add("pin_centre_angle_deg", angle, formula, "ISO 21771")
    add("pin_centre_diameter", found.centre_diameter, "{d_b} / cos({alpha_D})", "ISO 21771")
    even = gear.number_of_teeth % 2 == 0
    formula = "{d_D} + {D}" if even else "{d_D} * cos(pi / (2 * {z})) + {D}"
    add("over_pins", found.length, formula, "ISO 21771")
    if gear.circumferential_thinning:
        add("over_pins_nominal", measurement.over_pins(measurement.nominal(gear), pin, helix).length)
    if kerf:
        base = base_helix_angle(gear.rack.pressure_angle, helix)
        thinner = kerf / (math.cos(base) * math.cos(gear.rack.pressure_angle))
        cut = replace(gear, circumferential_thinning=gear.circumferential_thinning + thinner)
        add("over_pins_after_kerf", measurement.over_pins(cut, pin, helix).length)
    add("pin_contact_diameter", found.contact_diameter)
    if not (found.touches_flanks and found.stands_out):
        told = (
            N_("a ball of {diameter:.4g} mm does not touch the involutes or does not stand out; take the best one")
            if balls
            else N_("a pin of {diameter:.4g} mm does not touch the involutes or does not stand out; take the best one")
        )
        page.notes.append(message(told, diameter=pin))
    if balls:
        page.notes.append(_same_over_pins(even=even))


def _same_over_pins(*, even: bool) -> str:
    """Pins lie along the screw line of their middle, which stands at right angles to both normals of contact."""
    if even:
        return N_("the number of teeth is even: pins of the ball's diameter give the same M")
    return N_("the number of teeth is odd: M holds for balls in one transverse plane, not for pins in helical spaces")
