"""Steps of a pair in mesh, external, in a ring or on a rack: contact ratio both ways, sliding, backlash, limits."""

from __future__ import annotations

import math
from collections.abc import Sequence

from geometry.base.angles import inverse_involute, involute_function
from geometry.base.record import Record
from geometry.gears.pairs.common_face import CommonFace
from geometry.gears.pairs.external import ExternalPair
from geometry.gears.pairs.internal import InternalPair
from geometry.gears.pairs.rack import RackPair
from geometry.gears.pairs.sliding import active_line
from geometry.gears.teeth import limits
from geometry.gears.teeth.limits import LEAST_CONTACT_RATIO, LEAST_TIP_THICKNESS
from geometry.gears.teeth.ring import RingGear
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import base_helix_angle, helix_angle_at, normal_share, transverse_angle
from parts.base.texts import N_, message
from parts.pages.page import Sheet
from parts.texts.findings import finding_of

ISO = "ISO 21771"
Pair = ExternalPair | InternalPair
# less is none, mm
_PLAY = 1e-9


class Helical(Record):
    """What a pair of transverse sections does not know of itself: its first gear in normal data, and the face."""

    normal: SpurGear
    face: CommonFace

    @property
    def angle(self) -> float:
        """Helix angle, rad; 0 for straight teeth."""
        return self.face.helix.angle

    def normal_backlash(self, pair: Pair | RackPair) -> float:
        """j_bn of the pair, mm."""
        section = transverse_angle(self.normal.rack.pressure_angle, self.angle)
        return float(pair.normal_backlash) * normal_share(section, self.angle)


def heading(page: Sheet, helical: Helical, title: str) -> None:
    """A section whose numbers are transverse where the teeth are helical, and says so."""
    page.section(message("{title} (transverse section)", title=message(title)) if helical.angle else title)


def _tips_are_broken(pair: Pair) -> bool:
    """Whether a flank of an external pair ends below its tip circle: (3.18) then misses it."""
    tips = pair.first.tip_radius, pair.second.tip_radius
    return pair.sign > 0 and any(abs(f - r) > 1e-12 * f for f, r in zip(pair.tip_form_radii, tips, strict=True))


def _tangents(pair: Pair) -> str:
    """From the base circles to the tips, along the line of action; a ring's counts against the pinion's."""
    return f"{{r_b1}} * tan({{alpha_a1}}) {'+' if pair.sign > 0 else '-'} {{r_b2}} * tan({{alpha_a2}})"


def meshing_steps(page: Sheet, pair: Pair, helical: Helical, wanted: str) -> None:
    """(3.2) to (3.4), from the shifts to the distance, or to what they sum up to (``wanted``: its term) from that."""
    angle, alpha, normal = pair.working_pressure_angle, pair.first.rack.pressure_angle, helical.normal.rack
    teeth, sources = "{z1} + {z2}", ("practicum (3.3)", "practicum (3.4)")
    if pair.sign < 0:
        teeth, sources = "{z2} - {z1}", ("GOST 19274", "GOST 19274")
    page.add("gear_ratio", pair.gear_ratio, "{z2} / {z1}", "practicum (3.2)")
    if pair.sign > 0:
        page.add("tangent_of_pressure_angle", math.tan(alpha), "tan({alpha})", "practicum 3.1")
    page.add("involute_of_pressure_angle", involute_function(alpha), "inv({alpha})", "practicum, table Д.1")
    reference = f"{{m}} * ({teeth}) / 2"
    if wanted:
        page.add("working_centre_distance", pair.working_centre_distance)
        formula = f"arccos({reference} * cos({{alpha}}) / {{a_w}})"
        page.add("working_pressure_angle_deg", math.degrees(angle), formula, sources[1])
        page.add("involute_of_working_pressure_angle", involute_function(angle), "inv({alpha_w})", sources[0])
        total = (pair.teeth[1] + pair.sign * pair.teeth[0]) * (involute_function(angle) - involute_function(alpha))
        formula = f"({teeth}) * ({{inv_alpha_w}} - inv({{alpha}})) / (2 * tan({{alpha_n}}))"
        page.add(wanted, total / (2 * math.tan(normal.pressure_angle)), formula, sources[0])
    else:
        values = involute_function(angle), math.degrees(angle), pair.working_centre_distance
        working_steps(page, values, internal=pair.sign < 0, normal=True)
    if pair.sign > 0:
        page.add("cosine_of_working_pressure_angle", math.cos(angle), "cos({alpha_w})", "practicum, table Е.1")
    page.add("reference_centre_distance", pair.reference_centre_distance, reference, "ISO 21771")
    # of the pair in transverse modules, told in normal ones like the shifts
    value = pair.centre_distance_coefficient / math.cos(helical.angle)
    page.add("centre_distance_coefficient", value, "({a_w} - {a}) / {m_n}", "ISO 21771")
    if helical.angle:
        across = math.sin(angle) * math.cos(base_helix_angle(alpha, helical.angle))
        formula = "arcsin(sin({alpha_w}) * cos({beta_b}))"
        page.add("normal_working_pressure_angle_deg", math.degrees(math.asin(across)), formula, ISO)
        working = helix_angle_at(helical.angle, math.cos(alpha) / math.cos(angle))
        formula = "arctan(tan({beta}) * cos({alpha}) / cos({alpha_w}))"
        page.add("working_helix_angle_deg", math.degrees(working), formula, ISO)


def contact_steps(page: Sheet, pair: Pair, helical: Helical) -> None:
    """(3.20) to (3.22), form and active diameters, axial overlap; of a ring by GOST 19274."""
    external, broken = pair.sign > 0, _tips_are_broken(pair)
    source, own, less = "practicum (3.20)", "+", "- ({z1} + {z2})"
    if not external:
        source, own, less = "GOST 19274", "-", "+ ({z2} - {z1})"
    formula = f"({{z1}} * tan({{alpha_a1}}) {own} {{z2}} * tan({{alpha_a2}}) {less} * tan({{alpha_w}})) / (2 * pi)"
    page.add("contact_ratio", pair.contact_ratio, "" if broken else formula, source)
    page.add("working_pitch", pair.working_pitch, "2 * pi * {r_w1} / {z1}", "practicum (3.21)")
    formula = f"{{r_w1}} * ({_tangents(pair)} {'-' if external else '+'} {{a_w}} * sin({{alpha_w}})) / {{r_b1}}"
    page.add("arc_of_action", pair.arc_of_action, "" if broken else formula, "practicum, fig. 3.13")
    page.add("contact_ratio_by_arc", pair.contact_ratio_by_arc, "{dd} / {p_w}", "practicum (3.21)")
    difference = abs(pair.contact_ratio_by_arc / pair.contact_ratio - 1) * 100
    formula = "abs(({eps_arc} - {eps}) / {eps}) * 100"
    page.add("contact_ratio_difference_percent", difference, formula, "practicum (3.22)")
    overlap_steps(page, pair, helical)
    active, forms, tips = pair.active_profile_radii, pair.root_form_radii, pair.tip_form_radii
    # a ring's flanks begin outside
    two = active[1][:: pair.sign]
    for name, values in (
        ("root_form_diameter", forms),
        ("start_of_active_profile_diameter", (active[0][0], two[0])),
        ("active_tip_diameter", (active[0][1], two[1])),
        ("tip_form_diameter", tips),
    ):
        page.both(name, (2 * values[0], 2 * values[1]), "", ISO)


def face_steps(page: Sheet, face: CommonFace) -> None:
    """Common face width and overlap ratio of helical teeth."""
    page.add("face_width", face.width)
    half = " / 2" if face.helix.double else ""
    page.add("overlap_ratio", face.overlap_ratio, f"{{b}}{half} * sin(abs({{beta}})) / (pi * {{m_n}})", "ISO 21771")


def overlap_steps(page: Sheet, pair: Pair | RackPair, helical: Helical) -> None:
    """The effective contact ratio where it is less; overlap and total contact ratio of helical teeth."""
    if abs(pair.effective_contact_ratio - pair.contact_ratio) > 1e-9:
        page.add("effective_contact_ratio", pair.effective_contact_ratio, "", "ISO 21771")
    face = helical.face
    if face.helix.angle:
        face_steps(page, face)
        page.add("total_contact_ratio", face.overlap_ratio + pair.contact_ratio, "{eps} + {eps_beta}", "ISO 21771")
    _sector_steps(page, pair, face)


def _sector_steps(page: Sheet, pair: Pair | RackPair, face: CommonFace) -> None:
    """Over which angle the teeth of a sector are in mesh, and what it moves by that."""
    gears: Sequence[SpurGear | RingGear] = pair.gears
    if all(gear.sector is None for gear in gears):
        return
    from geometry.gears.pairs.sector_mesh import sector_meshes

    whole = abs(pair.effective_contact_ratio - pair.contact_ratio) <= 1e-9
    overlap = " + {eps_beta}" if face.helix.angle else ""
    formula = f"({{z_s#}} - 1 + {'{eps}' if whole else '{eps_eff}'}{overlap}) * 360 / {{z#}}"
    for place, mesh in sector_meshes(pair, face.overlap_ratio).items():
        index = place + 1
        page.add("sector_mesh_angle_deg", math.degrees(mesh.mesh_angle), formula, "", index)
        if isinstance(pair, RackPair):
            page.add("sector_travel", mesh.mesh_angle * mesh.rate, "{phi_m#} / 180 * pi * {r#}", "", index)
        else:
            moved = f"{{phi_m#}} * {{z#}} / {{z{3 - index}}}"
            page.add("sector_moves_deg", math.degrees(mesh.mesh_angle * mesh.rate), moved, "", index)


def measured_steps(page: Sheet, pair: ExternalPair, arc: float, pitch: float) -> None:
    """(3.21), (3.22) with an arc and a pitch measured off a drawing of any scale."""
    page.section("Measured off the drawing")
    page.add("measured_arc_of_action", arc, "", "practicum, fig. 3.13")
    page.add("measured_working_pitch", pitch, "", "practicum, fig. 3.13")
    ratio = arc / pitch
    page.add("measured_contact_ratio", ratio, "{dd_m} / {p_wm}", "practicum (3.21)")
    formula = "abs(({eps_m} - {eps}) / {eps}) * 100"
    page.add("measured_difference_percent", abs(ratio / pair.contact_ratio - 1) * 100, formula, "practicum (3.22)")


def sliding_steps(page: Sheet, pair: Pair, helical: Helical, speed_rpm: float | None) -> None:
    """The line of action and its parts, specific sliding; the first gear drives, with its speed speeds in mm/s too."""
    line, external = active_line(pair), pair.sign > 0
    whole = not _tips_are_broken(pair) and abs(pair.effective_contact_ratio - pair.contact_ratio) < 1e-9

    def when_whole(formula: str) -> str:
        return formula if whole else ""

    page.section("Line of action and sliding")
    page.add("line_of_action_length", line.line_length, "{a_w} * sin({alpha_w})", "practicum, fig. 3.5")
    formula = when_whole(f"{_tangents(pair)} {'-' if external else '+'} {{L}}")
    page.add("active_line_length", line.length, formula, "practicum, fig. 3.11")
    ends = ("tan({alpha_a2})", "tan({alpha_w})")[:: pair.sign]
    page.add("approach_length", line.approach, when_whole(f"{{r_b2}} * ({ends[0]} - {ends[1]})"), "ISO 21771")
    page.add("recess_length", line.recess, "{g} - {g_f}", "ISO 21771")
    # from the base circles: where contact ends and begins, of each gear and of its mate
    last1, last2 = "{r_b1} * tan({alpha_a1})", "{r_b2} * tan({alpha_a2})"
    first1, first2 = f"({{L}} - {last2})", f"({{L}} - {last1})"
    if not external:
        first1, first2 = f"({last2} - {{L}})", f"({{L}} + {last1})"
    (root1, root2), (tip1, tip2) = line.root_sliding, line.tip_sliding
    for name, gear, sliding, formula in (
        ("root_sliding", 1, root1, f"1 - {last2} / ({{u}} * {first1})"),
        ("root_sliding", 2, root2, f"1 - {{u}} * {last1} / {first2}"),
        ("tip_sliding", 1, tip1, f"1 - {first2} / ({{u}} * {last1})"),
        ("tip_sliding", 2, tip2, f"1 - {{u}} * {first1} / ({last2})"),
    ):
        page.add(name, sliding, when_whole(formula), "ISO 21771", gear)
    factors, per = line.speed_factors(pair.working_radii[0]), f"(1 {'+' if external else '-'} 1 / {{u}}) / {{r_w1}}"
    page.add("sliding_factor_at_start", factors[0], f"{{g_f}} * {per}", "ISO 21771")
    page.add("sliding_factor_at_end", factors[1], f"{{g_a}} * {per}", "ISO 21771")
    bends = line.pole, line.line_length - pair.sign * line.pole
    page.both("pole_curvature_radius", bends, "{r_w#} * sin({alpha_w})", ISO)
    if not helical.angle:
        pressure = pair.module * line.line_length / (bends[0] * bends[1])
        page.add("specific_pressure", pressure, "{m} * {L} / ({rho_P1} * {rho_P2})")
    if speed_rpm is not None:
        speed_steps(page, pair, helical, line.length, factors, speed_rpm)
    if line.approach < 0 or line.recess < 0:
        page.note("the pole lies outside the active line of action")


def speed_steps(
    page: Sheet, pair: Pair | RackPair, helical: Helical, active: float, factors: tuple[float, float], speed_rpm: float
) -> None:
    """What depends on time: speeds of gears and of their working circles, of sliding at both ends of contact."""
    page.section("Speeds")
    page.add("gear_speed", speed_rpm, gear=1, given=True)
    if not isinstance(pair, RackPair):
        page.add("gear_speed", speed_rpm / pair.gear_ratio, "{n1} / {u}", "ISO 21771", 2)
    # helical teeth end their contact at one face later than at the other
    later = " + 2 * pi * {eps_beta} / {z#}" if helical.angle else ""
    for gear, one in enumerate(pair.gears, 1):
        turned = math.degrees(active / one.base_radius + helical.face.overlap_ratio * one.pitch_angle)
        page.add("angle_of_action_deg", turned, f"{{g}} / {{r_b#}}{later}", "ISO 21771", gear)
    speed = math.pi * speed_rpm / 30 * pair.working_radii[0]
    page.add("pitch_speed", speed, "pi * {n1} / 30 * {r_w1}", "ISO 21771")
    page.add("sliding_speed_at_start", factors[0] * speed, "{K_gf} * {v_w}", "ISO 21771")
    page.add("sliding_speed_at_end", factors[1] * speed, "{K_ga} * {v_w}", "ISO 21771")


def backlash_steps(
    page: Sheet, pair: Pair | RackPair, circumferential: float, helical: Helical, formulas: tuple[str, str] = ("", "")
) -> None:
    """j_t, j_n, what they let move, and the bottom clearances; ``formulas`` of j_t and of these."""
    page.section("Backlash and clearance")
    page.add("circumferential_backlash", circumferential, formulas[0], "ISO 21771")
    cosine = " * cos({beta_b})" if helical.angle else ""
    formula = f"{{j_wt}} * cos({{alpha_w}}){cosine}"
    page.add("normal_backlash", helical.normal_backlash(pair), formula, "ISO 21771")
    if circumferential > _PLAY:
        _played(page, pair, circumferential)
    page.both("bottom_clearance_at_root", pair.tip_clearances, formulas[1], ISO)


def _played(page: Sheet, pair: Pair | RackPair, backlash: float) -> None:
    """What a backlash lets move: each gear while the other is held, the axes until teeth touch on both sides."""
    turns = [math.degrees(backlash / radius) for radius in pair.working_radii]
    page.both("angular_backlash_deg", turns, "{j_wt} / {r_w#}", ISO)
    if isinstance(pair, RackPair):
        moved = backlash / (2 * math.tan(pair.working_pressure_angle))
        page.add("radial_backlash", moved, "{j_wt} / (2 * tan({alpha}))", ISO)
        return
    distance, angle = pair.working_centre_distance, pair.working_pressure_angle
    tight = involute_function(angle) - pair.sign * backlash / (2 * distance)
    if tight > 0:
        moved = pair.sign * distance * (1 - math.cos(angle) / math.cos(inverse_involute(tight)))
        less, sign = ("-", "") if pair.sign > 0 else ("+", "-")
        there = f"arcinv(inv({{alpha_w}}) {less} {{j_wt}} / (2 * {{a_w}}))"
        page.add("radial_backlash", moved, f"{sign}{{a_w}} * (1 - cos({{alpha_w}}) / cos({there}))", ISO)


def limit_steps(page: Sheet, pair: Pair | RackPair, gears: Sequence[SpurGear], helical: Helical) -> None:
    """Undercut and tips of external gears, with remarks where they or the pair do not keep a limit."""
    symbol = "x_n,min" if helical.angle else ""
    for index, gear in enumerate(gears, 1):
        least = limits.least_shift_without_undercut(gear) / math.cos(helical.angle)
        page.add("least_shift_without_undercut", least, "", "ISO 21771", index, symbol=symbol)
    least = LEAST_TIP_THICKNESS * pair.module
    page.add("least_tip_thickness", least, f"{LEAST_TIP_THICKNESS} * {{m}}", "practicum (1.3)")
    if not helical.angle:
        page.add("least_contact_ratio", LEAST_CONTACT_RATIO, "", "practicum, lesson 1")
        if 1 <= pair.effective_contact_ratio < LEAST_CONTACT_RATIO:
            text = N_("contact ratio {value:.4f} is below {least:g}, which the practicum asks of shifted wheels")
            page.note(text, value=pair.effective_contact_ratio, least=LEAST_CONTACT_RATIO)
    found = [(f, 0) for f in helical.face.findings(pair.findings(), pair.effective_contact_ratio)]
    for index, gear in enumerate(gears, 1):
        found += [(f, index) for f in limits.findings(gear, helical.angle) if f.code != "thin_rim"]
    page.notes += [finding_of(owner, finding) for finding, owner in found]


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
