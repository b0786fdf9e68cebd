"""Steps of the tooth roots of a pair by ISO 6336-3, on the exact fillets: bending stress, what it may be, safety."""

from __future__ import annotations

import math

from geometry.base.errors import UndercutError
from geometry.base.findings import Finding
from geometry.gears.strength import iso6336, root
from geometry.gears.strength.root import RootLoad, RootSection
from geometry.gears.teeth.ring import RingGear
from geometry.gears.teeth.spur import SpurGear
from parts.mates.pages.strength_flank import cycles_step, limit_step
from parts.mates.pages.strength_keys import Rated, each
from parts.pages.page import Sheet
from parts.texts.findings import finding_of

_PART_3 = "ISO 6336-3"
_FORM = f"{_PART_3}, 6"


def root_stress(page: Sheet, rated: Rated, *, loaded: bool) -> None:
    """sigma_F of both gears, or of no load the factors alone."""
    keys, pair, helix = rated.keys, rated.pair, rated.helix
    newest = keys.method != "ISO 6336:2006"
    page.section("Roots: the critical section")
    ratio = pair.effective_contact_ratio / math.cos(rated.base_helix) ** 2
    page.add("virtual_contact_ratio_n", ratio, "{eps} / cos({beta_b})**2" if helix else "{eps}", _FORM)
    share = 1.0
    if newest:
        share = iso6336.root_load_share(ratio, rated.overlap)
        page.add("root_load_share", share, _share_formula(ratio, rated.overlap), _FORM)
    forms = [_form(page, rated, gear, k, ratio, share, newest=newest) for k, gear in enumerate(rated.gears, 1)]
    page.section("Roots: bending stress")
    slant = iso6336.root_helix_factor(helix, rated.overlap, newest=newest)
    formula = ""
    if helix and helix <= iso6336.MOST_HELIX:
        formula = f"1 - {'{eps_beta} * ' if rated.overlap < 1 else ''}{{beta}} * 180 / pi / 120"
        formula = f"({formula}) / cos({{beta}})**3" if newest else formula
    page.add("root_helix_factor", slant, formula, f"{_PART_3}, 8")
    deep = iso6336.deep_tooth_factor(ratio, keys.accuracy_grade)
    page.add("deep_tooth_factor", deep, "2.366 - 0.666 * {eps_n}" if 0.7 < deep < 1 else "", f"{_PART_3}, 10")
    for index, (gear, form) in enumerate(zip(rated.gears, forms, strict=True), 1):
        if form is None:
            continue
        rim = _rim(page, rated, gear, index)
        if not loaded:
            continue
        force = rated.value(page, "F_t")
        nominal = force / (rated.width * rated.normal_module) * form * slant * rim * deep
        formula = "{F_t} / ({b} * {m_n}) * {Y_F#} * {Y_S#} * {Y_beta} * {Y_B#} * {Y_DT}"
        page.add("nominal_root_stress", nominal, formula, f"{_PART_3}, 5", index)
        factors = [rated.value(page, key) for key in ("K_A", "K_v", "K_Fb", "K_Fa")]
        formula = "{sigma_F0#} * {K_A} * {K_v} * {K_Fb} * {K_Fa}"
        page.add("root_stress", nominal * math.prod(factors), formula, f"{_PART_3}, 5", index)


def _share_formula(ratio: float, overlap: float) -> str:
    """f_eps, but for straight teeth, of which it is a number."""
    if overlap == 0:
        return ""
    if overlap >= 1:
        return "sqrt(1 / {eps_n})"
    return f"sqrt((1 - {{eps_beta}}){' / 2' if ratio >= 2 else ''} + {{eps_beta}} / {{eps_n}})"


def _form(
    page: Sheet, rated: Rated, gear: SpurGear | RingGear, index: int, ratio: float, share: float, *, newest: bool
) -> float | None:
    """Y_F Y_S of a gear, step by step; None where no tangent touches its fillet."""
    virtual = root.virtual_gear(gear, rated.helix)
    tip = virtual.reference_radius + rated.active_tips[index - 1] - gear.reference_radius
    try:
        section = root.root_section(virtual)
    except UndercutError:
        section = None
    load = root.root_load(virtual, tip, ratio)
    if section is None or not root.lever_arm(virtual, section, load) > 0:
        degrees = math.degrees(root.RING_TANGENT_ANGLE if virtual.sign < 0 else root.TANGENT_ANGLE)
        page.notes.append(finding_of(index, Finding("strength_no_section", 0.0, degrees)))
        return None
    slant = "{z#} / (cos({beta_b})**2 * cos({beta}))" if rated.helix else "{z#}"
    page.add("normal_teeth", float(virtual.number_of_teeth), slant, _FORM, index)
    _load(page, rated, virtual, load, tip, index)
    formulas = _rack_steps(page, rated, virtual, section, index)
    page.add("critical_thickness", section.thickness, formulas[0], _FORM, index)
    page.add("fillet_radius", section.radius, formulas[1], _FORM, index)
    page.add("section_distance", section.distance, formulas[2], _FORM, index)
    arm = root.lever_arm(virtual, section, load)
    ends = ("{d_bn#} / (2 * cos({alpha_Fen#}))", "{x_F#}")[:: virtual.sign]
    page.add("bending_arm", arm, f"{ends[0]} - {ends[1]}", _FORM, index)
    form = root.form_factor(virtual, section, load) * share
    formula = "6 * {h_Fe#} * {m_n} * cos({alpha_Fen#}) / ({s_Fn#}**2 * cos({alpha_n}))"
    page.add("tooth_form_factor", form, formula + (" * {f_eps}" if newest else ""), _FORM, index)
    page.add("notch_parameter", section.notch, "{s_Fn#} / (2 * {rho_F#})", f"{_PART_3}, 7", index)
    correction = root.stress_correction(section.thickness, arm, section.notch)
    formula = "(1.2 + 0.13 * {s_Fn#} / {h_Fe#}) * {q_s#}**(1 / (1.21 + 2.3 * {h_Fe#} / {s_Fn#}))"
    page.add("stress_correction_factor", correction, formula, f"{_PART_3}, 7", index)
    low, high = iso6336.NOTCHES
    if not low <= section.notch < high:
        limit = low if section.notch < low else high
        page.notes.append(finding_of(index, Finding("strength_notch", section.notch, limit)))
    return form * correction


def _load(page: Sheet, rated: Rated, virtual: SpurGear | RingGear, load: RootLoad, tip: float, index: int) -> None:
    """From the tip of the virtual gear to alpha_Fen."""
    external = virtual.sign > 0
    page.add("virtual_base_diameter", 2 * virtual.base_radius, "{m_n} * {z_n#} * cos({alpha_n})", _FORM, index)
    page.add("virtual_tip_diameter", 2 * tip, "{m_n} * {z_n#} + {d_Na#} - 2 * {r#}", _FORM, index)
    along = "sqrt(({d_an#} / 2)**2 - ({d_bn#} / 2)**2)"
    along += f" {'-' if external else '+'} pi * {{m_n}} * cos({{alpha_n}}) * ({{eps_n}} - 1)"
    formula = f"2 * sqrt(({along})**2 + ({{d_bn#}} / 2)**2)"
    page.add("virtual_load_diameter", 2 * load.radius, formula, _FORM, index)
    page.add("load_pressure_angle_deg", math.degrees(load.pressure_angle), "arccos({d_bn#} / {d_en#})", _FORM, index)
    thin = " - {A#} * cos({beta}) / {m_n}" if rated.helix else " - {A#} / {m_n}"
    thin = thin if virtual.circumferential_thinning else ""
    way, back = ("+", "-") if external else ("-", "+")
    formula = f"(pi / 2 {way} 2 * {{x_n#}} * tan({{alpha_n}}){thin}) / {{z_n#}}"
    formula += f" {way} inv({{alpha_n}}) {back} inv({{alpha_en#}})"
    page.add("load_half_angle_deg", math.degrees(load.half_angle), formula, _FORM, index)
    page.add("load_angle_deg", math.degrees(load.angle), f"{{alpha_en#}} {back} {{gamma_e#}}", _FORM, index)


def _rack_steps(
    page: Sheet, rated: Rated, virtual: SpurGear | RingGear, section: RootSection, index: int
) -> tuple[str, str, str]:
    """E, G, H and theta of a tooth that a rack cuts, and the formulas that follow; of others there is none."""
    if isinstance(virtual, RingGear) or virtual.cutter is not None:
        return "", "", ""
    module, rack = virtual.module, virtual.rack
    wider = not virtual.thinning_by_deeper_cut and virtual.circumferential_thinning
    half = virtual.root_land_half_angle * virtual.reference_radius
    formula = "pi / 4 * {m_n} - ({h_a#} + {c#}) * {m_n} * tan({alpha_n})"
    formula += " - (1 - sin({alpha_n})) * {rho_f#} * {m_n} / cos({alpha_n})"
    if wider:
        formula += " + {A#} * cos({beta}) / 2" if rated.helix else " + {A#} / 2"
    page.add("rounding_half_distance", half, formula, _FORM, index)
    depth = rack.tip_radius - rack.dedendum + virtual.generating_shift_coefficient
    shift = "{x_E#}" if virtual.thinning_by_deeper_cut and virtual.circumferential_thinning else "{x_n#}"
    page.add("rounding_height", depth, f"{{rho_f#}} - {{h_a#}} - {{c#}} + {shift}", _FORM, index)
    turn = 2 / virtual.number_of_teeth * (math.pi / 2 - half / module) - math.pi / 3
    page.add("section_parameter", turn, "2 / {z_n#} * (pi / 2 - {E_0#} / {m_n}) - pi / 3", _FORM, index)
    page.add("section_angle_deg", math.degrees(section.parameter), "", "θ = 2 G / z_n tan θ - H", index)
    return (
        "{m_n} * ({z_n#} * sin(pi / 3 - {theta#}) + sqrt(3) * ({G#} / cos({theta#}) - {rho_f#}))",
        "{m_n} * ({rho_f#} + 2 * {G#}**2 / (cos({theta#}) * ({z_n#} * cos({theta#})**2 - 2 * {G#})))",
        "{m_n} / 2 * ({z_n#} * cos(pi / 3 - {theta#}) + {G#} / cos({theta#}) - {rho_f#})",
    )


def _rim(page: Sheet, rated: Rated, gear: SpurGear | RingGear, index: int) -> float:
    """Y_B."""
    rim, height = each(rated.keys.rim_thickness)[index - 1], abs(gear.tip_radius - gear.root_radius)
    formula, ring = "", gear.sign < 0
    if rim is not None:
        page.add("rim_thickness", rim, gear=index, given=True)
        if not ring:
            page.add("root_tooth_depth", height, gear=index)
    value = iso6336.rim_factor(rim, height, rated.normal_module, ring=ring)
    if value > 1:
        formula = "1.15 * ln(8.324 * {m_n} / {s_R#})" if ring else "1.6 * ln(2.242 * {h_t#} / {s_R#})"
    page.add("rim_factor", value, formula, f"{_PART_3}, 9", index)
    least = 1.75 * rated.normal_module if ring else 0.5 * height
    if rim is not None and rim <= least:
        page.notes.append(finding_of(index, Finding("strength_rim", rim, least)))
    return value


def root_allowed(page: Sheet, rated: Rated, *, loaded: bool) -> None:
    """sigma_FG of both gears and their safety; nothing where no limit is known."""
    keys = rated.keys
    page.section("Roots: what they bear")
    for index, (group, quality) in enumerate(zip(rated.groups, each(keys.material_quality), strict=True), 1):
        if f"q_s{index}" not in page.known:
            continue
        line = None if group is None else group.bending[quality]
        limit = limit_step(page, rated, "fatigue_limit_bending", each(keys.bending_limit)[index - 1], line, index)
        if limit is None:
            continue
        page.add("test_gear_factor", 2.0, "", f"{_PART_3}, 5", index)
        cycles, life = cycles_step(page, rated, index), 1.0
        if cycles is not None and group is not None:
            life = iso6336.life_factor(group.bending_knots, cycles, keys.long_life_factor)
        if cycles is not None and group is None:
            page.notes.append(finding_of(index, Finding("strength_life_bending", 1.0, 0.0)))
        page.add("root_life_factor", life, "", f"{_PART_3}, 12", index)
        sensitive, rough = _notch(page, rated, index), _surface(page, rated, index)
        size = 1.0 if group is None else iso6336.size_factor(group, rated.normal_module)
        page.add("root_size_factor", size, "", f"{_PART_3}, 15", index)
        reversing = each(keys.reversing_factor)[index - 1]
        page.add("mean_stress_factor", reversing, gear=index, given=True)
        value = limit * 2 * life * sensitive * rough * size * reversing
        formula = "{sigma_Flim#} * {Y_ST#} * {Y_NT#} * {Y_d#} * {Y_R#} * {Y_X#} * {Y_M#}"
        page.add("root_strength", value, formula, f"{_PART_3}, 5", index)
        if loaded:
            stress = rated.value(page, f"sigma_F{index}")
            page.add("bending_safety", value / stress, "{sigma_FG#} / {sigma_F#}", f"{_PART_3}, 5", index)


def _notch(page: Sheet, rated: Rated, index: int) -> float:
    """Y_delta_relT: given, by the material, or 1 and 0.95 by the notch alone."""
    keys, source, group = rated.keys, f"{_PART_3}, 13", rated.groups[index - 1]
    given, notch = each(keys.gradient_factor)[index - 1], rated.value(page, f"q_s{index}")
    if given is not None:
        page.add("relative_notch_factor", given, gear=index, given=True)
        return given
    slip = None if group is None else group.slip_layer(each(keys.yield_strength)[index - 1])
    value, formula = 1.0 if notch >= 1.5 else 0.95, ""
    if slip is not None:
        page.add("slip_layer", slip, "", source, index)
        value = iso6336.notch_sensitivity(notch, slip)
        formula = "(1 + sqrt({rho_s#} * (1 + 2 * {q_s#}) / 5)) / (1 + sqrt({rho_s#} * 1.2))"
    page.add("relative_notch_factor", value, formula, source, index)
    return value


def _surface(page: Sheet, rated: Rated, index: int) -> float:
    """Y_R_relT: given, by the roughness, else 1."""
    keys, source, group = rated.keys, f"{_PART_3}, 14", rated.groups[index - 1]
    given, height = each(keys.surface_factor)[index - 1], each(keys.root_roughness)[index - 1]
    value = 1.0 if given is None else given
    if given is None and group is not None and height is not None:
        page.add("root_roughness", height, gear=index, given=True)
        value = iso6336.surface_factor(group, height)
    page.add("relative_surface_factor", value, "", source, index, given=given is not None)
    return value
