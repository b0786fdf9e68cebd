"""Steps of a pair's contact: contact ratio by both ways, sliding, backlash and the limits of the pair."""

from __future__ import annotations

import math

from geometry.gears.pairs.common_face import CommonFace
from geometry.gears.pairs.external import ExternalPair
from geometry.gears.pairs.sliding import active_line
from geometry.gears.teeth import limits
from geometry.gears.teeth.limits import LEAST_TIP_THICKNESS
from geometry.gears.teeth.transverse import base_helix_angle
from parts.base.texts import N_, in_context
from parts.pages.page import Sheet
from parts.texts.findings import finding_of

# from the base circles to the tips, along the line of action
_TANGENTS = "{r_b1} * tan({alpha_a1}) + {r_b2} * tan({alpha_a2})"


def _tips_are_broken(pair: ExternalPair) -> bool:
    """Whether a flank ends below its tip circle: (3.18) then misses it."""
    return any(abs(f - g.tip_radius) > 1e-12 * f for f, g in zip(pair.tip_form_radii, pair.gears, strict=True))


def contact_steps(page: Sheet, pair: ExternalPair, face: CommonFace) -> None:
    """(3.20) to (3.22), form and active diameters, axial overlap."""
    page.section(N_("Contact ratio"))
    formula = "({z1} * tan({alpha_a1}) + {z2} * tan({alpha_a2}) - ({z1} + {z2}) * tan({alpha_w})) / (2 * pi)"
    broken = _tips_are_broken(pair)
    page.add("contact_ratio", pair.contact_ratio, "" if broken else formula, "practicum (3.20)")
    page.add("working_pitch", pair.working_pitch, "2 * pi * {r_w1} / {z1}", "practicum (3.21)")
    formula = f"{{r_w1}} * ({_TANGENTS} - {{a_w}} * sin({{alpha_w}})) / {{r_b1}}"
    page.add("arc_of_action", pair.arc_of_action, "" if broken else formula, "practicum, fig. 3.13")
    page.add("contact_ratio_by_arc", pair.contact_ratio_by_arc, "{dd} / {p_w}", "practicum (3.21)")
    difference = abs(pair.contact_ratio_by_arc / pair.contact_ratio - 1) * 100
    formula = "abs(({eps_arc} - {eps}) / {eps}) * 100"
    page.add("contact_ratio_difference_percent", difference, formula, "practicum (3.22)")
    if abs(pair.effective_contact_ratio - pair.contact_ratio) > 1e-9:
        page.add("effective_contact_ratio", pair.effective_contact_ratio, "", "ISO 21771")
    overlap_steps(page, pair.contact_ratio, face, "{b}@ * sin(abs({beta})) / (pi * {m_n})")
    active = pair.active_profile_radii
    forms, tips = pair.root_form_radii, pair.tip_form_radii
    for name, values in (
        ("root_form_diameter", forms),
        ("start_of_active_profile_diameter", (active[0][0], active[1][0])),
        ("active_tip_diameter", (active[0][1], active[1][1])),
        ("tip_form_diameter", tips),
    ):
        page.both(name, (2 * values[0], 2 * values[1]), "", ("ISO 21771", "ISO 21771"))


def overlap_steps(page: Sheet, contact_ratio: float, face: CommonFace, formula: str) -> None:
    """Overlap and total contact ratio of helical teeth; ``@`` in the formula: what halves a double helix's width."""
    if face.helix.angle == 0:
        return
    page.add("face_width", face.width)
    half = " / 2" if face.helix.double else ""
    page.add("overlap_ratio", face.overlap_ratio, formula.replace("@", half), "ISO 21771")
    page.add("total_contact_ratio", face.overlap_ratio + contact_ratio, "{eps} + {eps_beta}", "ISO 21771")


def measured_steps(page: Sheet, pair: ExternalPair, arc: float, pitch: float) -> None:
    """(3.21), (3.22) with an arc and a pitch measured off a drawing of any scale."""
    page.section(N_("Measured off the drawing"))
    page.add("measured_arc_of_action", arc, "", "practicum, fig. 3.13")
    page.add("measured_working_pitch", pitch, "", "practicum, fig. 3.13")
    ratio = arc / pitch
    page.add("measured_contact_ratio", ratio, "{dd_m} / {p_wm}", "practicum (3.21)")
    formula = "abs(({eps_m} - {eps}) / {eps}) * 100"
    page.add("measured_difference_percent", abs(ratio / pair.contact_ratio - 1) * 100, formula, "practicum (3.22)")


def sliding_steps(page: Sheet, pair: ExternalPair) -> None:
    """The line of action and its parts, specific sliding; the first gear drives."""
    line = active_line(pair)
    whole = not _tips_are_broken(pair) and abs(pair.effective_contact_ratio - pair.contact_ratio) < 1e-9

    def when_whole(formula: str) -> str:
        return formula if whole else ""

    page.section(N_("Line of action and sliding"))
    page.add("line_of_action_length", line.line_length, "{a_w} * sin({alpha_w})", "practicum, fig. 3.5")
    page.add("active_line_length", line.length, when_whole(f"{_TANGENTS} - {{L}}"), "practicum, fig. 3.11")
    formula = when_whole("{r_b2} * (tan({alpha_a2}) - tan({alpha_w}))")
    page.add("approach_length", line.approach, formula, "ISO 21771")
    page.add("recess_length", line.recess, "{g} - {g_f}", "ISO 21771")
    last = ("{r_b1} * tan({alpha_a1})", "{r_b2} * tan({alpha_a2})")
    (root1, root2), (tip1, tip2) = line.root_sliding, line.tip_sliding
    for gear, root, formula in (
        (1, root1, f"1 - {last[1]} / ({{u}} * ({{L}} - {last[1]}))"),
        (2, root2, f"1 - {{u}} * {last[0]} / ({{L}} - {last[0]})"),
    ):
        page.add("root_sliding", root, when_whole(formula), "ISO 21771", gear)
    for gear, tip, formula in (
        (1, tip1, f"1 - ({{L}} - {last[0]}) / ({{u}} * {last[0]})"),
        (2, tip2, f"1 - {{u}} * ({{L}} - {last[1]}) / ({last[1]})"),
    ):
        page.add("tip_sliding", tip, when_whole(formula), "ISO 21771", gear)
    factors = line.speed_factors(pair.working_radii[0])
    page.add("sliding_factor_at_start", factors[0], "{g_f} * (1 + 1 / {u}) / {r_w1}", "ISO 21771")
    page.add("sliding_factor_at_end", factors[1], "{g_a} * (1 + 1 / {u}) / {r_w1}", "ISO 21771")
    if line.approach < 0 or line.recess < 0:
        page.notes.append(N_("the pole lies outside the active line of action"))


def backlash_steps(page: Sheet, pair: ExternalPair, helix: float) -> None:
    """j_n, j_t and the bottom clearances."""
    page.section(N_("Backlash and clearance"))
    circumferential = pair.circumferential_backlash
    normal = pair.normal_backlash * math.cos(base_helix_angle(pair.first.rack.pressure_angle, helix))
    page.add("circumferential_backlash", circumferential, "{p_w} - {S_w1} - {S_w2}", "ISO 21771")
    cosine = " * cos({beta_b})" if helix else ""
    page.add("normal_backlash", normal, f"{{j_wt}} * cos({{alpha_w}}){cosine}", "ISO 21771")
    page.both("bottom_clearance_at_root", pair.tip_clearances, "{a_w} - {r_f#} - {r_a~}", ("ISO 21771", "ISO 21771"))


def limit_steps(page: Sheet, pair: ExternalPair, face: CommonFace) -> None:
    """Undercut and the thickness of the tips, with remarks where a limit is not kept."""
    helix = face.helix.angle
    page.section(in_context("pair", "Limits"))
    if not helix:
        rules = [limits.practicum_undercut(g).limit for g in pair.gears]
        page.both("least_shift_practicum", (rules[0], rules[1]), "(17 - {z#}) / 17", ("practicum (1.2)",) * 2)
    for index, gear in enumerate(pair.gears, 1):
        exact = limits.least_shift_without_undercut(gear) / math.cos(helix)
        symbol = "x_n,min" if helix else ""
        page.add("least_shift_without_undercut", exact, "", "ISO 21771", index, symbol=symbol)
    page.add(
        "least_tip_thickness", LEAST_TIP_THICKNESS * pair.module, f"{LEAST_TIP_THICKNESS} * {{m}}", "practicum (1.3)"
    )
    found = [(f, 0) for f in face.findings(pair.findings(), pair.effective_contact_ratio)]
    for index, gear in enumerate(pair.gears, 1):
        found += [(f, index) for f in limits.findings(gear) if f.code != "thin_rim"]
    for finding, owner in found:
        page.notes.append(finding_of(owner, finding))


def working_steps(page: Sheet, values: tuple[float, float, float], *, internal: bool, normal: bool) -> None:
    """From the shifts to the working pressure angle (``values``: its involute, it in degrees) and the distance, mm.

    ``normal``: shifts and angle of the formula are those of the normal section.
    """
    x, alpha = ("x_n", "alpha_n") if normal else ("x", "alpha")
    shifts, teeth = f"{{{x}1}} + {{{x}2}}", "{z1} + {z2}"
    sources = "practicum (3.3)", "practicum (3.4)"
    if internal:
        shifts, teeth, sources = f"{{{x}2}} - {{{x}1}}", "{z2} - {z1}", ("GOST 19274", "GOST 19274")
    formula = f"2 * ({shifts}) * tan({{{alpha}}}) / ({teeth}) + inv({{alpha}})"
    page.add("involute_of_working_pressure_angle", values[0], formula, sources[0])
    page.add("working_pressure_angle_deg", values[1], "arcinv({inv_alpha_w})", sources[0])
    formula = f"{{m}} * ({teeth}) / 2 * cos({{alpha}}) / cos({{alpha_w}})"
    page.add("working_centre_distance", values[2], formula, sources[1])
