"""The page of gear and rack."""

from __future__ import annotations

import math

from geometry.gears.pairs.rack import RackPair
from geometry.gears.teeth import limits, measurement
from geometry.gears.teeth.spur import SpurGear
from parts.base.texts import N_
from parts.gears.spur_gear.page import addendum_formula, given_data, root_radius_step
from parts.pages.contact_steps import ISO, Helical, backlash_steps, heading, limit_steps, overlap_steps, speed_steps
from parts.pages.force_steps import DrivenKeys, force_steps
from parts.pages.page import Sheet
from parts.pages.roll_steps import rack_rolls


def first_radii(page: Sheet, gear: SpurGear, helical: Helical) -> None:
    """Tip and root of the first gear; a given tip and a root that a pinion cutter made have no formula."""
    formula = f"{{r1}} + {addendum_formula()}" if gear.given_tip_diameter is None else ""
    page.add("tip_radius", gear.tip_radius, formula, "practicum (3.11)", 1)
    root_radius_step(page, gear, 1)


def rack_page(pair: RackPair, topic: str, helical: Helical, keys: DrivenKeys) -> Sheet:
    """The page of a gear and its rack; with the gear's speed and load those of its work too."""
    gear, rack = pair.gear, pair.rack
    alpha = rack.rack.pressure_angle
    page = Sheet(topic, N_("Gear and rack"))
    page.section("Given")
    given_data(page, helical.normal, gear, helical.angle, 1)
    page.add("rack_addendum", rack.addendum)
    if rack.circumferential_thinning:
        page.add("circumferential_thinning", rack.circumferential_thinning, gear=2)
    heading(page, helical, N_("Meshing"))
    page.add("reference_radius", gear.reference_radius, "{m} * {z1} / 2", "practicum (3.7)", 1)
    # on a rack it is the working circle
    page.name("r_w", "r", 1)
    nominal = gear.reference_radius + gear.profile_shift_coefficient * gear.module
    formula = "{r1} + {x_n1} * {m_n}" if abs(nominal - pair.distance) < 1e-12 * nominal else ""
    page.add("rack_distance", pair.distance, formula, "ISO 21771")
    page.add("working_pressure_angle_deg", math.degrees(alpha), "{alpha}", "ISO 21771")
    page.add("travel_per_turn", pair.travel_per_turn, "pi * {m} * {z1}", "ISO 21771")
    heading(page, helical, N_("Radii"))
    page.add("base_radius", gear.base_radius, "{r1} * cos({alpha})", "practicum (3.9)", 1)
    first_radii(page, gear, helical)
    heading(page, helical, N_("Pitch and tooth thickness"))
    page.add("pitch", rack.pitch, "pi * {m}", "practicum (3.15)")
    less = " - {A1}" if gear.circumferential_thinning else ""
    formula = f"0.5 * {{p}} + 2 * {{x1}} * {{m}} * tan({{alpha}}){less}"
    page.add("reference_thickness", gear.reference_thickness, formula, "practicum (3.16)", 1)
    formula = "0.5 * {p} - {A2}" if rack.circumferential_thinning else "0.5 * {p}"
    page.add("reference_thickness", rack.tooth_thickness, formula, "ISO 21771", 2)
    angle = measurement.angle_at(gear, gear.tip_radius)
    page.add("tip_pressure_angle_deg", math.degrees(angle), "arccos({r_b1} / {r_a1})", "practicum (3.18)", 1)
    page.add("tip_thickness", limits.tip_thickness(gear), "", "ISO 21771", 1)
    _rack_contact(page, pair, helical, keys)
    return page


def _rack_contact(page: Sheet, pair: RackPair, helical: Helical, keys: DrivenKeys) -> None:
    """Contact ratio, sliding, backlash and the conditions."""
    page.section("Contact ratio")
    formula = (
        "({r_b1} * tan({alpha_a1}) - {r1} * sin({alpha}) + ({r1} - {a_w} + {h_aR}) / sin({alpha})) "
        "/ (pi * {m} * cos({alpha}))"
    )
    gear, rack = pair.gear, pair.rack
    plain = not (gear.tip_chamfer or gear.tip_rounding or gear.rack.relief or rack.tip_chamfer or rack.tip_rounding)
    page.add("contact_ratio", pair.contact_ratio, formula if plain else "", "ISO 21771")
    overlap_steps(page, pair, helical)
    low, high = pair.active_line
    pole = gear.base_radius * math.tan(rack.rack.pressure_angle)
    page.add("active_line_length", high - low, "", "practicum, fig. 3.11")
    page.add("approach_length", pole - low, "", "ISO 21771")
    page.add("recess_length", high - pole, "{g} - {g_f}", "ISO 21771")
    factors = (pole - low) / gear.reference_radius, (high - pole) / gear.reference_radius
    page.add("sliding_factor_at_start", factors[0], "{g_f} / {r1}", "ISO 21771")
    page.add("sliding_factor_at_end", factors[1], "{g_a} / {r1}", "ISO 21771")
    rack_rolls(page, pair)
    if keys.speed_rpm is not None:
        speed_steps(page, pair, helical, high - low, factors, keys.speed_rpm)
    force_steps(page, pair, helical, keys)
    backlash_steps(page, pair, pair.normal_backlash / math.cos(rack.rack.pressure_angle), helical)
    page.section("Conditions: margins")
    found = {m.name: m for m in pair.margins()}
    fillets = found["fillet_interference_gear"].margin, found["fillet_interference_rack"].margin
    page.both("fillet_interference_margin", fillets, "", ISO)
    limit_steps(page, pair, pair.gears, helical)
    if fillets[0] < 0 and "fillet_interference_gear" not in {f.code for f in pair.findings()}:
        text = N_(
            "the rack's tip goes into the fillet by no more than counts as contact, {depth:.2g} mm: the rounding "
            "that cut it takes a little more than its clearance"
        )
        page.note(text, depth=pair.depth_in_fillet)
