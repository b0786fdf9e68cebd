"""``higherpair calc strength``: load capacity of an involute pair, by ISO 6336 or by GOST 21354-87.

The critical section of the root lies on the exact fillet that the cutter leaves; where that is a rack, the standard's
own closed form stands beside it as the formula.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import Any, cast

from geometry.base.errors import ParameterError
from geometry.base.findings import Finding
from geometry.gears.pairs.internal import InternalPair
from geometry.gears.strength import iso6336
from geometry.gears.strength.materials import GROUPS
from parts.base.texts import N_
from parts.gears.spur_gear.page import cutter_data, given_data, sector_data, shift_data, thinning_data
from parts.keys.base import check_not_in_vain
from parts.mates.pages.external import Asked, PairKeys, Pairs, external_page, table_of_pair
from parts.mates.pages.internal import InternalKeys, internal_page
from parts.mates.pages.pair_keys import kind_of_pair
from parts.mates.pages.strength_flank import flank_allowed, flank_stress
from parts.mates.pages.strength_gost import gost_steps
from parts.mates.pages.strength_keys import LoadedInternalKeys, LoadedPairKeys, LoadKeys, Pair, Rated, given_once
from parts.mates.pages.strength_root import root_allowed, root_stress
from parts.pages.contact_steps import ISO, Helical, face_steps, heading, meshing_steps
from parts.pages.force_steps import asked_torque, torque_steps
from parts.pages.inputs import SceneKeys
from parts.pages.page import Sheet
from parts.texts.findings import finding_of

TOPIC = "strength"
OTHER_KINDS = (("second.kind", "ring_gear"),)
_PART_1 = "ISO 6336-1"
# what multiplies the load
_OF_LOAD = ("application_factor", "dynamic_factor", "face_load_factor", "root_face_load_factor",
            "transverse_load_factor", "root_transverse_load_factor")  # fmt: skip
# what the materials bear by their limits
_OF_CONTACT = ("least_contact_safety", "oil_viscosity", "flank_roughness", "flank_factor", "contact_size_factor",
               "hardening_factor")  # fmt: skip
_OF_BENDING = ("least_bending_safety", "surface_factor", "gradient_factor", "reversing_factor", "root_roughness")


def table_from(scene: SceneKeys, source: str, table: dict[str, Any]) -> dict[str, Any]:
    """The keys of a mate of a scene, changed by those of the command line."""
    return table_of_pair(scene, source, table, PAIRS)


def sheet(table: dict[str, Any]) -> Sheet:
    """The calculation of a pair, by its kind."""
    kind, table = kind_of_pair(table, TOPIC, list(PAIRS))
    return PAIRS[kind][1](table)


def _begun(pair: Pair, keys: PairKeys | InternalKeys, helical: Helical) -> tuple[Sheet, Rated]:
    """A page without a step yet, and the pair with its load."""
    width = min(keys.first.face_width, keys.second.face_width)
    rated = Rated(pair, cast("LoadKeys", keys), helical, width)
    page = Sheet(TOPIC, _TITLES[rated.keys.method])
    page.section("Given")
    return page, rated


def _external(asked: Asked) -> Sheet:
    page, rated = _begun(asked.pair, asked.keys, asked.helical)
    for index, (normal, gear) in enumerate(zip(asked.normal, asked.pair.gears, strict=True), 1):
        given_data(page, normal, gear, asked.helical.angle, index)
    total = "profile_shift_sum" if asked.shifts_follow else "tight_profile_shift_sum"
    return _rated(page, rated, "" if asked.keys.working_centre_distance is None else total)


def _internal(pair: InternalPair, keys: InternalKeys, helical: Helical) -> Sheet:
    (page, rated), ring = _begun(pair, keys, helical), pair.ring
    given_data(page, helical.normal, pair.pinion, helical.angle, 1)
    page.add("number_of_teeth", ring.number_of_teeth, gear=2)
    sector_data(page, ring, 2)
    shift_data(page, ring.profile_shift_coefficient / math.cos(helical.angle), helical.angle, 2)
    if ring.cutter is not None:
        cutter_data(page, ring.cutter, 2, 1 / math.cos(helical.angle))
    thinning_data(page, ring, helical.angle, "+", 2)
    return _rated(page, rated, "" if keys.working_centre_distance is None else "profile_shift_difference")


def _rated(page: Sheet, rated: Rated, wanted: str) -> Sheet:
    """All that follows after the data of both gears."""
    pair, torque = rated.pair, asked_torque(rated.keys)
    if pair.effective_contact_ratio <= 0:
        raise ParameterError("working_centre_distance", pair.working_centre_distance, "flanks_do_not_meet")
    if not rated.helix:
        page.add("face_width", rated.width)
    _mesh(page, rated, wanted)
    if torque is not None:
        _load(page, rated, torque)
    else:
        check_not_in_vain(rated.keys, _OF_LOAD, "torque")
    if rated.keys.method == "GOST 21354":
        gost_steps(page, rated, loaded=torque is not None)
    else:
        if torque is not None:
            _load_factors(page, rated, torque)
        for steps in (flank_stress, flank_allowed, root_stress, root_allowed):
            steps(page, rated, loaded=torque is not None)
    _check_vain(page, rated, loaded=torque is not None)
    if torque is not None:
        _torques(page, rated, torque)
        _summary(page)
    page.sections = [section for section in page.sections if section.steps]
    if rated.unused:
        page.note(N_("{method} has no {keys}: not used"), method=rated.keys.method, keys=", ".join(rated.unused))
    return page


def _check_vain(page: Sheet, rated: Rated, *, loaded: bool) -> None:
    """Refuse keys that act only with what is not given: limits of the materials, their group, a life, a load."""
    keys, iso = rated.keys, rated.keys.method != "GOST 21354"

    def vain(names: Sequence[str], other: str) -> None:
        check_not_in_vain(keys, [name for name in names if name not in rated.unused], other)

    # a group gives its limits, where the method has them
    given = iso and keys.material_group is not None
    contact, bending = (
        given or any(f"{key}{index}" in page.known for index in (1, 2)) or limit is not None
        for key, limit in (("sigma_Hlim", keys.contact_limit), ("sigma_Flim", keys.bending_limit))
    )  # fmt: skip
    if iso and not loaded:
        vain(("least_contact_safety", "least_bending_safety"), "torque")
    if not (contact or bending):
        vain(("load_cycles", "life_hours"), "material_group")
    if not contact:
        vain(_OF_CONTACT, "contact_limit")
    if not bending:
        vain(_OF_BENDING, "bending_limit")
    if keys.material_group is None:
        vain(("material_quality", "root_roughness", "long_life_factor", "pits_allowed"), "material_group")
        if iso or rated.cycles is None:
            vain(("hardness",), "material_group")
    if rated.cycles is None:
        vain(("long_life_factor", "pits_allowed"), "load_cycles")
    if not any(group is not None and len(group.slip) > 1 for group in rated.groups):
        names = ", ".join(f'"{name}"' for name, group in GROUPS.items() if len(group.slip) > 1)
        vain(("yield_strength",), f"material_group = {names}")
    if not rated.helix:
        vain(("profile_factor",), "helix_angle_deg")
    if not (loaded or contact or keys.life_hours):
        vain(("speed_rpm",), "torque")
    if iso and not (loaded and keys.speed_rpm) and rated.value(page, "Y_DT") == 1:
        vain(("accuracy_grade",), "speed_rpm" if loaded else "torque")


def _mesh(page: Sheet, rated: Rated, wanted: str) -> None:
    """Circles, angles and contact ratios that the factors take."""
    pair, helical = rated.pair, rated.helical
    heading(page, helical, N_("Meshing"))
    meshing_steps(page, pair, helical, wanted)
    gears, tips = rated.gears, rated.active_tips
    page.both("reference_radius", [g.reference_radius for g in gears], "{m} * {z#} / 2", ISO)
    page.both("base_radius", [g.base_radius for g in gears], "{r#} * cos({alpha})", ISO)
    page.both("active_tip_diameter", [2 * r for r in tips], "", ISO)
    angles = [math.degrees(math.acos(g.base_radius / r)) for g, r in zip(gears, tips, strict=True)]
    page.both("active_tip_angle_deg", angles, "arccos(2 * {r_b#} / {d_Na#})", ISO)
    signs = ("+", "- ({z1} + {z2})") if pair.sign > 0 else ("-", "+ ({z2} - {z1})")
    formula = "({{z1}} * tan({{alpha_Na1}}) {} {{z2}} * tan({{alpha_Na2}}) {} * tan({{alpha_w}})) / (2 * pi)"
    page.add("contact_ratio", pair.effective_contact_ratio, formula.format(*signs), ISO)
    if rated.helix:
        face_steps(page, helical.face)
    low, high = iso6336.CONTACT_RATIOS
    if not low <= pair.effective_contact_ratio <= high:
        limit = low if pair.effective_contact_ratio < low else high
        page.notes.append(finding_of(0, Finding("strength_contact_ratio", pair.effective_contact_ratio, limit)))
    if rated.helix > iso6336.MOST_HELIX + 1e-12:
        numbers = math.degrees(rated.helix), math.degrees(iso6336.MOST_HELIX)
        page.notes.append(finding_of(0, Finding("strength_helix", *numbers)))


def _load(page: Sheet, rated: Rated, torque: float) -> None:
    """Torques, the nominal force on the reference circles and their speed."""
    pair, keys = rated.pair, rated.keys
    page.section("Load")
    if keys.speed_rpm is not None:
        page.add("gear_speed", keys.speed_rpm, gear=1, given=True)
    torque_steps(page, keys, torque, "gear_torque", 1)
    page.add("gear_torque", torque * pair.gear_ratio, "{T1} * {u}", gear=2)
    page.add("reference_force", rated.force(torque), "1000 * {T1} / {r1}", f"{_PART_1}, 4")
    if rated.speed is not None:
        page.add("reference_speed", rated.speed, "pi * {n1} * {r1} / 30000", f"{_PART_1}, 4")


def _load_factors(page: Sheet, rated: Rated, torque: float) -> None:
    """K_A to K_Falpha: given, or by the simplest of the standard's own ways."""
    keys = rated.keys
    page.section("Factors of load")
    page.add("outer_load_factor", keys.application_factor, given=True)
    _dynamic_factor(page, rated, torque)
    page.add("face_load_factor", keys.face_load_factor, given=True)
    if keys.root_face_load_factor is None:
        heights = [abs(g.tip_radius - g.root_radius) for g in rated.gears]
        share = max(min(rated.width / height for height in heights), 3.0)
        page.add("width_by_height", share, "", f"{_PART_1}, 7")
        exponent = iso6336.face_exponent(rated.width, heights)
        page.add("face_exponent", exponent, "{b_h}**2 / (1 + {b_h} + {b_h}**2)", f"{_PART_1}, 7")
        page.add("root_face_load_factor", keys.face_load_factor**exponent, "{K_Hb}**({N_F})", f"{_PART_1}, 7")
    else:
        page.given(root_face_load_factor=keys.root_face_load_factor)
    page.add("transverse_load_factor", keys.transverse_load_factor, given=True)
    own = keys.root_transverse_load_factor
    if own is None:
        page.add("root_transverse_load_factor", keys.transverse_load_factor, "{K_Ha}", f"{_PART_1}, 8")
    else:
        page.add("root_transverse_load_factor", own, given=True)


def _dynamic_factor(page: Sheet, rated: Rated, torque: float) -> None:
    """K_v: given, by method C of grade and speed, else 1."""
    keys, grade, parameter, parts = rated.keys, rated.keys.accuracy_grade, rated.speed_parameter, rated.dynamic_parts
    if grade is None or parameter is None or parts is None:
        page.add("speed_factor", keys.dynamic_factor or 1.0, given=True)
        return
    source, helical, overlap = f"{_PART_1}, 6", rated.helix > 0, rated.overlap
    page.add("accuracy_grade", grade, given=True)
    page.add("speed_parameter", parameter, "{v} * {z1} / 100 * {u} / sqrt(1 + {u}**2)", source)
    line = rated.line_load(torque)
    usual = max(line, iso6336.LEAST_LINE_LOAD)
    page.add("rated_line_load", usual, "{K_A} * {F_t} / {b}" if usual == line else "", source)
    third = "2" if parameter <= 0.2 else "(2.071 - 0.357 * {v_z})"
    formula = ""
    if parameter <= iso6336.MOST_SPEED and (not helical or overlap >= 1):
        first, second = iso6336.dynamic_coefficients(grade, helical=helical)
        page.told(first_dynamic_coefficient=first, second_dynamic_coefficient=second)
        formula = f"1 + ({{K_1}} / {{w_A}} + {{K_2}}) * {{v_z}} * {third}"
    page.add("speed_factor", iso6336.dynamic_factor(parts, line), formula, source)
    if parameter > iso6336.MOST_SPEED:
        page.notes.append(finding_of(0, Finding("strength_speed", parameter, iso6336.MOST_SPEED)))


def _torques(page: Sheet, rated: Rated, torque: float) -> None:
    """What torque on the first gear either safety lets through, and the least of them all."""
    keys, found = rated.keys, []
    page.section("Torque allowed on the first gear")
    given_once(page, "least_contact_safety", keys.least_contact_safety)
    given_once(page, "least_bending_safety", keys.least_bending_safety)
    for name, key, least, power in (
        ("contact_torque", "S_H", keys.least_contact_safety, 2),
        ("bending_torque", "S_F", keys.least_bending_safety, 1),
    ):
        for index in (1, 2):
            if f"{key}{index}" not in page.known:
                continue
            safety = rated.value(page, f"{key}{index}")
            raised = f"({{{key}#}} / {{{key}min}})" + ("**2" if power == 2 else "")
            borne, formula = _borne(page, rated, torque, (safety / least) ** power, raised)
            found.append(torque * borne)
            page.add(name, found[-1], formula, gear=index)
            if safety < least:
                page.notes.append(finding_of(index, Finding(f"strength_{name}", safety, least)))
    if found:
        page.add("allowed_torque", min(found))
    else:
        page.sections.pop()


def _borne(page: Sheet, rated: Rated, torque: float, most: float, raised: str) -> tuple[float, str]:
    """How many times the torque may be carried where the stress may grow ``most`` times with it, told as ``raised``.

    With the formula of that torque. By method C K_v falls as the load grows, down to K_v0.
    """
    parts, line, least = rated.dynamic_parts, rated.line_load(torque), iso6336.LEAST_LINE_LOAD
    borne = most if parts is None else iso6336.load_borne(most, parts, line)
    if parts is None or max(line, line * borne) <= least:
        return borne, f"{{T1}} * {raised}"
    if "w_0" not in page.known:
        page.add("dynamic_rest", parts[0], "", f"{_PART_1}, 6")
        page.add("dynamic_line_load", parts[1], "", f"{_PART_1}, 6")
    if line * borne <= least:
        return borne, f"{{T1}} * {{K_v}} * {raised} / ({{K_v0}} + {{w_0}} / {least:g})"
    return borne, f"{{T1}} * ({{K_v}} * {raised} - {{w_0}} * {{b}} / ({{K_A}} * {{F_t}})) / {{K_v0}}"


def _summary(page: Sheet) -> None:
    """Stresses, safeties and torques of both gears side by side: what the page knows of either."""
    both = ([page.known.get(f"{key}{index}", page.known.get(key)) for index in (1, 2)] for key in _COLUMNS)
    columns = [(one, two) for one, two in both if one is not None and two is not None]
    heads = [(one.symbol.removesuffix("1"), one.unit) for one, _ in columns]
    rows = [[index, *(float(column[index - 1].value) for column in columns)] for index in (1, 2)]
    page.table("strength", N_("Both gears"), [(N_("gear"), ""), *heads], rows)


# the keys of what stands in it
_COLUMNS = ("sigma_H", "sigma_HG", "S_H", "sigma_F", "sigma_FG", "S_F", "T_H", "T_F")
_TITLES = {
    "ISO 6336": N_("Load capacity by ISO 6336:2019"),
    "ISO 6336:2006": N_("Load capacity by ISO 6336:2006"),
    "GOST 21354": N_("Load capacity by GOST 21354-87"),
}
PAIRS: Pairs = {
    "external_gear_pair": (
        LoadedPairKeys, partial(external_page, kind=LoadedPairKeys, topic=TOPIC, page_of=_external)
    ),
    "internal_gear_pair": (
        LoadedInternalKeys, partial(internal_page, kind=LoadedInternalKeys, topic=TOPIC, page_of=_internal)
    ),
}  # fmt: skip
