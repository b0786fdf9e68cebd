"""Steps of a pair's load capacity by GOST 21354-87, in its own symbols."""

from __future__ import annotations

import math

from geometry.base.errors import ParameterError
from geometry.base.findings import Finding
from geometry.gears.strength import gost21354 as gost
from parts.base.refusal import REMOVED
from parts.mates.pages.strength_flank import cycles_step, overlap_step, zone_step
from parts.mates.pages.strength_keys import Rated, each, given_once
from parts.pages.page import Sheet
from parts.texts.findings import finding_of

GOST = "GOST 21354-87"


def gost_steps(page: Sheet, rated: Rated, *, loaded: bool) -> None:
    """Stresses, what the materials bear, safeties."""
    keys = rated.keys
    if loaded:
        page.section("Factors of load")
        page.given(outer_load_factor=keys.application_factor, pair_speed_factor=keys.dynamic_factor or 1.0)
        page.given(face_load_factor=keys.face_load_factor, transverse_load_factor=keys.transverse_load_factor)
        own = keys.root_face_load_factor, keys.root_transverse_load_factor
        for name, value, usual, formula in (
            ("root_face_load_factor", own[0], keys.face_load_factor, "{K_Hb}"),
            ("root_transverse_load_factor", own[1], keys.transverse_load_factor, "{K_Ha}"),
        ):
            page.add(name, usual if value is None else value, "" if value else formula, given=value is not None)
    _flanks(page, rated, loaded=loaded)
    _roots(page, rated, loaded=loaded)


def _flanks(page: Sheet, rated: Rated, *, loaded: bool) -> None:
    keys, pair, sign = rated.keys, rated.pair, rated.pair.sign
    page.section("Flanks: contact stress")
    page.add("elasticity_factor", gost.ELASTICITY_FACTOR, "", GOST)
    zone, overlap = zone_step(page, rated, GOST), overlap_step(page, rated, GOST)
    if loaded:
        load = math.prod(rated.value(page, key) for key in ("F_t", "K_A", "K_Hv", "K_Hb", "K_Ha"))
        factors = gost.ELASTICITY_FACTOR * zone * overlap
        stress = gost.contact_stress(factors, load, rated.width, 2 * pair.first.reference_radius, pair.gear_ratio, sign)
        root = "{F_t} * {K_A} * {K_Hv} * {K_Hb} * {K_Ha} / ({b} * 2 * {r1})"
        formula = f"{{Z_E}} * {{Z_H}} * {{Z_eps}} * sqrt({root} * ({{u}} {'+' if sign > 0 else '-'} 1) / {{u}})"
        page.add("contact_stress", stress, formula, GOST)
    page.section("Flanks: what they bear")
    for index, gear in enumerate(rated.gears, 1):
        limit = _limit(page, rated, index, contact=True)
        if limit is None:
            continue
        hardness, hard = each(keys.hardness)[index - 1], rated.is_hard(index)
        cycles, life = cycles_step(page, rated, index), 1.0
        if cycles is not None and hardness is not None:
            page.add("contact_limit_cycles", gost.contact_cycles(hardness), "", GOST, index)
            life = gost.contact_life(cycles, gost.contact_cycles(hardness), hard=hard)
        if cycles is not None and hardness is None:
            page.notes.append(finding_of(index, Finding("strength_life_hardness", 1.0, 0.0)))
        page.add("gost_contact_life_factor", life, "", GOST, index)
        given, film = each(keys.flank_factor)[index - 1], 1.0
        if given is not None:
            film = given
        elif rated.speed is not None:
            film = gost.velocity_factor(rated.speed, hard=hard)
        page.add("gost_flank_factor", film, "", GOST, index, given=given is not None)
        size = gost.contact_size_factor(2 * gear.reference_radius)
        formula = "sqrt(1.07 - 0.0001 * 2 * {r#})" if size < 1 else ""
        page.add("contact_size_factor", size, formula, GOST, index)
        bears = limit * life * film * size
        page.add("contact_strength", bears, "{sigma_Hlim#} * {Z_N#} * {Z_RvL#} * {Z_X#}", GOST, index)
        if loaded:
            stress = rated.value(page, "sigma_H")
            page.add("contact_safety", bears / stress, "{sigma_HG#} / {sigma_H}", GOST, index)
        least = keys.least_contact_safety
        given_once(page, "least_contact_safety", least)
        page.add("allowed_flank_stress", bears / least, "{sigma_HG#} / {S_Hmin}", GOST, index)


def _limit(page: Sheet, rated: Rated, index: int, *, contact: bool) -> float | None:
    """A limit that is given, or that of normalized or quenched and tempered steel by its hardness.

    Raises
    ------
    ParameterError
        Such steel without a hardness.
    """
    keys, group = rated.keys, rated.groups[index - 1]
    name = "contact_limit" if contact else "fatigue_limit_bending"
    given = each(keys.contact_limit if contact else keys.bending_limit)[index - 1]
    if given is not None:
        page.add(name, given, gear=index, given=True)
        return given
    hardness = each(keys.hardness)[index - 1]
    if group is None:
        return None
    if group.name not in ("St", "V", "V alloy"):
        code = f"strength_gost_{'contact' if contact else 'bending'}"
        page.notes.append(finding_of(index, Finding(code, 0.0, 0.0)))
        return None
    if hardness is None:
        raise ParameterError("material_group", keys.material_group, "needs_other", REMOVED, other="hardness")
    given_once(page, "hardness", hardness, index)
    value = (gost.contact_limit if contact else gost.bending_limit)(hardness)
    page.add(name, value, "2 * {x_H#} + 70" if contact else "1.75 * {x_H#}", GOST, index)
    return value


def _roots(page: Sheet, rated: Rated, *, loaded: bool) -> None:
    keys, pair, helix, overlap = rated.keys, rated.pair, rated.helix, rated.overlap
    page.section("Roots: bending stress")
    slant, ratio = gost.helix_factor(helix, overlap), pair.effective_contact_ratio
    formula = "1 - {eps_beta} * {beta} * 180 / pi / 120" if helix and slant > 0.7 else ""
    page.add("root_helix_factor", slant, formula, GOST)
    share = gost.contact_ratio_factor(ratio, overlap, helix)
    formula = ("0.2 + 0.8 / {eps}" if overlap < 1 else "1 / {eps}") if helix else ""
    page.add("root_overlap_factor", share, formula, GOST)
    stresses: list[float | None] = []
    for index in (1, 2):
        form = _form(page, rated, index)
        stresses.append(None)
        if form is None or not loaded:
            continue
        load = math.prod(rated.value(page, key) for key in ("F_t", "K_A", "K_Hv", "K_Fb", "K_Fa"))
        stress = load / (rated.width * rated.normal_module) * form * slant * share
        formula = "{F_t} / ({b} * {m_n}) * {K_A} * {K_Hv} * {K_Fb} * {K_Fa} * {Y_FS#} * {Y_beta} * {Y_eps}"
        page.add("root_stress", stress, formula, GOST, index)
        stresses[-1] = stress
    page.section("Roots: what they bear")
    for index, (gear, found) in enumerate(zip(rated.gears, stresses, strict=True), 1):
        limit = _limit(page, rated, index, contact=False)
        if limit is None:
            continue
        cycles, life = cycles_step(page, rated, index), 1.0
        if cycles is not None:
            life = gost.bending_life(cycles, hard=rated.is_hard(index))
        page.add("gost_root_life_factor", life, "", GOST, index)
        rough, given = each(keys.surface_factor)[index - 1], each(keys.gradient_factor)[index - 1]
        page.add("roughness_factor", 1.0 if rough is None else rough, "", GOST, index, given=rough is not None)
        size = gost.bending_size_factor(2 * gear.reference_radius)
        page.add("size_factor", size, "1.05 - 0.000125 * 2 * {r#}" if size < 1 else "", GOST, index)
        gradient = gost.gradient_factor(rated.normal_module) if given is None else given
        page.add("gradient_factor", gradient, "1.082 - 0.172 * lg({m_n})" if given is None else "", GOST, index)
        reversing = each(keys.reversing_factor)[index - 1]
        page.add("reversing_factor", reversing, gear=index, given=True)
        bears = limit * life * (1.0 if rough is None else rough) * size * gradient * reversing
        formula = "{sigma_Flim#} * {Y_N#} * {Y_R#} * {Y_X#} * {Y_d#} * {K_R#}"
        page.add("root_strength", bears, formula, GOST, index)
        if found is not None:
            page.add("bending_safety", bears / found, "{sigma_FG#} / {sigma_F#}", GOST, index)
        given_once(page, "least_bending_safety", keys.least_bending_safety)
        formula = "{sigma_FG#} / {S_Fmin}"
        page.add("allowed_root_stress", bears / keys.least_bending_safety, formula, GOST, index)


def _form(page: Sheet, rated: Rated, index: int) -> float | None:
    """Y_FS: given, or by the number of teeth and the shift of an external gear; None of a ring."""
    gear, given = rated.gears[index - 1], each(rated.keys.form_factor)[index - 1]
    if given is not None:
        page.add("whole_form_factor", given, gear=index, given=True)
        return given
    if gear.sign < 0:
        page.notes.append(finding_of(index, Finding("strength_gost_ring", 0.0, 0.0)))
        return None
    teeth = gear.number_of_teeth / math.cos(rated.helix) ** 3
    page.add("virtual_teeth", teeth, "{z#} / cos({beta})**3" if rated.helix else "{z#}", GOST, index)
    value = gost.form_factor(teeth, gear.profile_shift_coefficient / math.cos(rated.helix))
    formula = "3.47 + 13.2 / {z_v#} - 29.7 * {x_n#} / {z_v#} + 0.092 * {x_n#}**2"
    page.add("whole_form_factor", value, formula, GOST, index)
    return value
