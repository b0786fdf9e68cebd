"""Steps of the flanks of a pair by ISO 6336-2: contact stress, what the materials bear, safety."""

from __future__ import annotations

import math

from geometry.base.errors import ParameterError
from geometry.base.findings import Finding
from geometry.gears.strength import iso6336
from geometry.gears.strength.gost21354 import contact_stress
from geometry.gears.strength.materials import Line
from parts.base.refusal import REMOVED
from parts.mates.pages.strength_keys import Rated, each, given_once
from parts.pages.page import Sheet
from parts.texts.findings import finding_of

_PART_2 = "ISO 6336-2"


def zone_step(page: Sheet, rated: Rated, source: str) -> float:
    """Z_H."""
    pair, slant = rated.pair, " * cos({beta_b})" if rated.helix else ""
    value = iso6336.zone_factor(pair.first.rack.pressure_angle, pair.working_pressure_angle, rated.base_helix)
    formula = f"sqrt(2{slant} * cos({{alpha_w}}) / (cos({{alpha}})**2 * sin({{alpha_w}})))"
    page.add("zone_factor", value, formula, source)
    return value


def elasticity_step(page: Sheet, rated: Rated, source: str) -> float:
    """Z_E of both materials."""
    moduli, ratios = each(rated.keys.elastic_modulus), each(rated.keys.poisson_ratio)
    for index in (1, 2):
        page.add("elastic_modulus", moduli[index - 1], gear=index, given=True)
        page.add("poisson_ratio", ratios[index - 1], gear=index, given=True)
    value = iso6336.elasticity_factor(moduli, ratios)
    formula = "sqrt(1 / (pi * ((1 - {nu1}**2) / {E1} + (1 - {nu2}**2) / {E2})))"
    page.add("elasticity_factor", value, formula, source)
    return value


def overlap_step(page: Sheet, rated: Rated, source: str) -> float:
    """Z_eps."""
    ratio, overlap = rated.pair.effective_contact_ratio, rated.overlap
    formula = "sqrt((4 - {eps}) / 3 * (1 - {eps_beta}) + {eps_beta} / {eps})"
    if overlap == 0 or overlap >= 1:
        formula = "sqrt(1 / {eps})" if overlap else "sqrt((4 - {eps}) / 3)"
    value = iso6336.contact_ratio_factor(ratio, overlap)
    page.add("overlap_factor", value, formula, source)
    return value


def _single_contact(page: Sheet, rated: Rated) -> tuple[float, float]:
    """Z_B and Z_D: the stress at the inner ends of single contact against that at the pole."""
    source, overlap, profile = f"{_PART_2}, 6", rated.overlap, rated.profile_factor
    if rated.helix and profile != 1:
        page.add("profile_factor", profile, given=True)
    way = "-" if rated.pair.sign > 0 else "+"
    turns = (f"{way} ({{eps}} - 1) * 2 * pi / {{z2}}", "- ({eps} - 1) * 2 * pi / {z1}")
    firsts = ("- 2 * pi / {z1}", f"{way} 2 * pi / {{z2}}")
    found = []
    for index, name in enumerate(("pinion_contact_factor", "wheel_contact_factor")):
        bare, own, mate = rated.contact_parameter(index), index + 1, 2 - index
        if bare is None:
            ratio = rated.pair.effective_contact_ratio
            page.notes.append(finding_of(own, Finding("strength_single_contact", ratio, 2.0)))
        else:
            inner = f"(tan({{alpha_Na{own}}}) {firsts[index]}) * (tan({{alpha_Na{mate}}}) {turns[index]})"
            page.add("contact_parameter", bare, f"tan({{alpha_w}}) / sqrt({inner})", source, own)
        value = iso6336.single_contact_factor(1.0 if bare is None else bare, overlap, profile)
        formula = ""
        if bare is not None and bare > 1 and overlap < 1:
            formula = f"{{M{own}}}"
            if overlap:
                formula += f" - {{eps_beta}} * ({{M{own}}} - {'sqrt({f_ZCa})' if profile != 1 else '1'})"
        page.add(name, value, formula, source)
        found.append(value)
    return found[0], found[1]


def flank_stress(page: Sheet, rated: Rated, *, loaded: bool) -> None:
    """sigma_H of both gears, or of no load the factors alone."""
    pair, keys, sign = rated.pair, rated.keys, rated.pair.sign
    page.section("Flanks: contact stress")
    zone = zone_step(page, rated, f"{_PART_2}, 6")
    singles = _single_contact(page, rated)
    elasticity = elasticity_step(page, rated, f"{_PART_2}, 7")
    overlap = overlap_step(page, rated, f"{_PART_2}, 8")
    helix = iso6336.helix_factor_contact(rated.helix)
    page.add("contact_helix_factor", helix, "1 / sqrt(cos({beta}))" if rated.helix else "", f"{_PART_2}, 9")
    if not loaded:
        return
    factors, force = zone * elasticity * overlap * helix, rated.value(page, "F_t")
    nominal = contact_stress(factors, force, rated.width, 2 * pair.first.reference_radius, pair.gear_ratio, sign)
    root = f"sqrt({{F_t}} / ({{b}} * 2 * {{r1}}) * ({{u}} {'+' if sign > 0 else '-'} 1) / {{u}})"
    formula = f"{{Z_H}} * {{Z_E}} * {{Z_eps}} * {{Z_beta}} * {root}"
    page.add("nominal_contact_stress", nominal, formula, f"{_PART_2}, 5")
    load = keys.application_factor * rated.value(page, "K_v") * keys.face_load_factor * keys.transverse_load_factor
    for index, (single, key) in enumerate(zip(singles, ("Z_B", "Z_D"), strict=True), 1):
        value = single * nominal * math.sqrt(load)
        formula = f"{{{key}}} * {{sigma_H0}} * sqrt({{K_A}} * {{K_v}} * {{K_Hb}} * {{K_Ha}})"
        page.add("flank_contact_stress", value, formula, f"{_PART_2}, 5", index)


def limit_step(
    page: Sheet, rated: Rated, name: str, given: float | None, line: Line | None, index: int
) -> float | None:
    """A stress number that is given, or that of a group's line by its hardness; None: neither.

    Raises
    ------
    ParameterError
        A line without a hardness.
    """
    if given is not None:
        page.add(name, given, gear=index, given=True)
        return given
    if line is None:
        return None
    hardness, source = each(rated.keys.hardness)[index - 1], "ISO 6336-5"
    if line.slope == 0:
        page.add(name, line.base, "", source, index)
        return line.base
    if hardness is None:
        group = rated.keys.material_group
        raise ParameterError("material_group", group, "needs_other", REMOVED, other="hardness")
    given_once(page, "hardness", hardness, index)
    value = line.at(hardness)
    page.add(name, value, f"{line.slope:g} * {{x_H#}} + {line.base:g}", source, index)
    if not line.low <= hardness <= line.high:
        near = line.low if hardness < line.low else line.high
        code = f"strength_hardness_{'contact' if name == 'contact_limit' else 'bending'}"
        page.notes.append(finding_of(index, Finding(code, hardness, near)))
    return value


def cycles_step(page: Sheet, rated: Rated, index: int) -> float | None:
    """N_L of a gear's teeth, where a life is asked for."""
    cycles = rated.cycles
    if cycles is None:
        return None
    if "N_L1" not in page.known:
        hours = rated.keys.life_hours
        if hours:
            speed_step(page, rated)
            page.add("life_hours", hours, given=True)
        page.add("load_cycles", cycles[0], "60 * {n1} * {L_h}" if hours else "", gear=1, given=not hours)
    if f"N_L{index}" not in page.known:
        page.add("load_cycles", cycles[1], "{N_L1} / {u}", gear=2)
    return cycles[index - 1]


def speed_step(page: Sheet, rated: Rated) -> None:
    """n_1, where the page has no load that has told it."""
    if rated.keys.speed_rpm is not None:
        given_once(page, "gear_speed", rated.keys.speed_rpm, 1)


def flank_allowed(page: Sheet, rated: Rated, *, loaded: bool) -> None:
    """sigma_HG of both gears and their safety; nothing where no limit is known."""
    keys, groups, source = rated.keys, rated.groups, f"{_PART_2}, 12"
    page.section("Flanks: what they bear")
    limits = []
    for index, (group, quality) in enumerate(zip(groups, each(keys.material_quality), strict=True), 1):
        line = None if group is None else group.contact[quality]
        limits.append(limit_step(page, rated, "contact_limit", each(keys.contact_limit)[index - 1], line, index))
    known = [limit for limit in limits if limit is not None]
    if not known:
        return
    films = _films(page, rated, min(known), source)
    for index, (limit, group) in enumerate(zip(limits, groups, strict=True), 1):
        if limit is None:
            continue
        cycles, life = cycles_step(page, rated, index), 1.0
        if cycles is not None and group is not None:
            life = iso6336.life_factor(group.contact_knots(pits=keys.pits_allowed), cycles, keys.long_life_factor)
        if cycles is not None and group is None:
            page.notes.append(finding_of(index, Finding("strength_life_contact", 1.0, 0.0)))
        page.add("contact_life_factor", life, "", f"{_PART_2}, 11", index, symbol="Z_NT", key="Z_NT")
        own = each(keys.flank_factor)[index - 1]
        film, told = films, "{Z_L} * {Z_v} * {Z_R}"
        if own is not None:
            film, told = own, "{Z_LvR#}"
            page.add("flank_factor", own, "", source, index, given=True)
        hardened = _hardening(page, rated, index)
        size = each(keys.contact_size_factor)[index - 1]
        page.add("contact_size_factor", size, gear=index, given=True)
        value = limit * life * film * hardened * size
        formula = f"{{sigma_Hlim#}} * {{Z_NT#}} * {told} * {{Z_W#}} * {{Z_X#}}"
        page.add("contact_strength", value, formula, f"{_PART_2}, 5", index)
        if loaded:
            stress = rated.value(page, f"sigma_H{index}")
            page.add("contact_safety", value / stress, "{sigma_HG#} / {sigma_H#}", f"{_PART_2}, 5", index)


def _films(page: Sheet, rated: Rated, softer: float, source: str) -> float:
    """Z_L, Z_v and Z_R of the softer gear, each 1 where its data are not given; their product."""
    keys = rated.keys
    if None not in each(keys.flank_factor):
        return 1.0
    basic = iso6336.lubricant_coefficient(softer)
    viscosity, velocity, roughness = 1.0, 1.0, 1.0
    if keys.oil_viscosity is not None:
        given_once(page, "oil_viscosity", keys.oil_viscosity)
        viscosity = iso6336.lubricant_factor(softer, keys.oil_viscosity)
    if keys.oil_viscosity is not None or rated.speed is not None:
        page.add("lubricant_coefficient", basic, "", source)
    formula = "{C_ZL} + 4 * (1 - {C_ZL}) / (1.2 + 134 / {nu_40})**2"
    page.add("lubricant_factor", viscosity, "" if keys.oil_viscosity is None else formula, source)
    if rated.speed is not None:
        _speed(page, rated, rated.speed)
        velocity = iso6336.velocity_factor(softer, rated.speed)
    formula = "{C_ZL} + 0.02 + 2 * (0.98 - {C_ZL}) / sqrt(0.8 + 32 / {v})"
    page.add("circumferential_speed_factor", velocity, "" if rated.speed is None else formula, source)
    formula, heights = "", _heights(page, rated, source)
    if heights is not None:
        one, two, curvature = *heights, rated.reduced_curvature
        mean = (one + two) / 2 * (10 / curvature) ** (1 / 3)
        page.add("reduced_roughness", mean, "({R_z1} + {R_z2}) / 2 * cbrt(10 / {rho_red})", source)
        power = iso6336.roughness_exponent(softer)
        page.add("roughness_exponent", power, "", source)
        roughness, formula = (3 / mean) ** power, "(3 / {R_z10})**({C_ZR})"
    page.add("contact_roughness_factor", roughness, formula, source)
    return viscosity * velocity * roughness


def _speed(page: Sheet, rated: Rated, speed: float) -> None:
    """v, where the page has not told it yet."""
    if "v" not in page.known:
        speed_step(page, rated)
        page.add("reference_speed", speed, "pi * {n1} * {r1} / 30000", "ISO 6336-1, 4")


def _heights(page: Sheet, rated: Rated, source: str) -> tuple[float, float] | None:
    """R_z of both flanks, told with rho_red, by which they count; None where they are not given."""
    one, two = each(rated.keys.flank_roughness)
    if one is None or two is None:
        return None
    for index, height in enumerate((one, two), 1):
        given_once(page, "flank_roughness", height, index)
    if "rho_red" not in page.known:
        teeth = f"({{r_b2}} {'+' if rated.pair.sign > 0 else '-'} {{r_b1}})"
        formula = f"{{r_b1}} * {{r_b2}} * tan({{alpha_w}}) / {teeth}"
        page.add("reduced_curvature", rated.reduced_curvature, formula, source)
    return one, two


def _hardening(page: Sheet, rated: Rated, index: int) -> float:
    """Z_W of a gear: given, or that of soft steel whose mate is hard, and smooth where its R_zH is not known."""
    keys, source = rated.keys, f"{_PART_2}, 13"
    own, mate = rated.groups[index - 1], rated.groups[2 - index]
    given, hardness = each(keys.hardening_factor)[index - 1], each(keys.hardness)[index - 1]
    value, formula = 1.0 if given is None else given, ""
    if given is None and own and mate and own.is_soft_steel and mate.is_hard and hardness is not None:
        given_once(page, "hardness", hardness, index)
        roughness = _hardening_roughness(page, rated, index, source)
        value = iso6336.hardening_factor(hardness, roughness)
        formula = "1.2 - ({x_H#} - 130) / 1700" if 130 <= hardness <= 470 else ""
        if roughness > 3:
            smooth = f"({formula})" if formula else "1.2" if hardness < 130 else "1"
            formula = f"{smooth} * (3 / {'{R_zH}' if roughness <= 16 else '16'})**(0.15)"
    page.add("hardening_factor", value, formula, source, index, given=given is not None)
    return value


def _hardening_roughness(page: Sheet, rated: Rated, index: int, source: str) -> float:
    """R_zH of a soft gear's hard mate, um: that of a smooth one where roughness, oil or speed is not given."""
    viscosity, speed, heights = rated.keys.oil_viscosity, rated.speed, _heights(page, rated, source)
    if viscosity is None or speed is None or heights is None:
        return 3.0
    given_once(page, "oil_viscosity", viscosity)
    _speed(page, rated, speed)
    hard, soft = heights[2 - index], heights[index - 1]
    value = iso6336.hardening_roughness(hard, soft, rated.reduced_curvature, viscosity * speed)
    ratio = f"({{R_z{3 - index}}} / {{R_z{index}}})**(0.66)"
    formula = f"{{R_z{3 - index}}} * (10 / {{rho_red}})**(0.33) * {ratio} / ({{nu_40}} * {{v}} / 1500)**(0.33)"
    page.add("hardening_roughness", value, formula, source)
    return value
