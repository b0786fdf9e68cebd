"""``higherpair calc rack``: one rack, spur or helical: dimensions, and what is measured on it."""

from __future__ import annotations

import math
from typing import Annotated

from geometry.base.record import replace
from geometry.base.tolerance import is_told
from geometry.gears.teeth import rack_measurement
from geometry.gears.teeth.rack import Rack
from parts.base.texts import N_
from parts.gears.rack.part import RackSpec, checked_rack_part
from parts.gears.spur_gear.page import section_data
from parts.gears.spur_gear.part import rounding_finding
from parts.keys.base import mm
from parts.pages.inputs import calculation, part_of_kind
from parts.pages.page import Sheet
from parts.texts.findings import finding_message

TOPIC = "rack"
table_from = part_of_kind("rack")
_ISO = "ISO 21771"

_MEASURED_OVER_PIN = mm("size from the rack's back over a pin, measured on the part", above=0, most=100_000)


class RackKeys(RackSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the topic: those of a rack, and what is measured."""

    pin_diameter: Annotated[float, mm("pin in a space", above=0, most=10_000)] | None = None
    measured_over_pin: Annotated[float, _MEASURED_OVER_PIN] | None = None
    kerf: Annotated[float, mm("full width of a cut that was not corrected for", least=0, most=10)] | None = None


@calculation(TOPIC, RackKeys)
def sheet(keys: RackKeys) -> Sheet:
    """The calculation of one rack."""
    rack = checked_rack_part(keys)
    page = Sheet(TOPIC, N_("Rack"))
    helix = math.radians(keys.helix_angle_deg)
    _given(page, rack, keys, helix)
    _dimensions(page, rack)
    _pins(page, rack, keys, helix)
    page.section("Chords")
    chord, constant = rack_measurement.reference_chord(rack, helix), rack_measurement.constant_chord(rack, helix)
    page.add("rack_chord", chord.thickness, "{S} * cos({beta})" if helix else "{S}", _ISO)
    page.add("chordal_height", chord.height, "{h_aR}", _ISO)
    page.add("constant_chord", constant.thickness, "{S_ch} * cos({alpha_n})**2", "GOST 16532-70")
    formula = "{h_ch} - {S_c} * tan({alpha_n}) / 2"
    page.add("constant_chord_height", constant.height, formula, "GOST 16532-70")
    page.notes += [finding_message(f) for f in rounding_finding(keys)]
    return page


def _given(page: Sheet, rack: Rack, keys: RackKeys, helix: float) -> None:
    """Module, angle, teeth and the basic rack, in normal modules."""
    page.section("Given")
    section_data(page, keys.module, math.radians(keys.pressure_angle_deg), helix)
    page.add("number_of_teeth", rack.number_of_teeth)
    normal = rack.module / keys.module
    page.add("addendum_coefficient", rack.rack.addendum * normal)
    page.add("tip_clearance_coefficient", rack.rack.tip_clearance * normal)
    page.add("tip_radius_coefficient", rack.rack.tip_radius * normal)
    page.told(circumferential_thinning=rack.circumferential_thinning or None)


def _dimensions(page: Sheet, rack: Rack) -> None:
    """Pitch, heights and thicknesses."""
    page.section("Pitch and tooth thickness")
    page.add("rack_pitch", rack.pitch, "pi * {m}", _ISO)
    page.add("rack_length", rack.length, "{z} * {p}")
    page.add("rack_addendum", rack.addendum, "{h_a} * {m_n}", _ISO, symbol="h_a")
    page.add("rack_dedendum", rack.dedendum, "({h_a} + {c}) * {m_n}", _ISO)
    less = " - {A}" if rack.circumferential_thinning else ""
    page.add("rack_thickness", rack.tooth_thickness, f"0.5 * {{p}}{less}", _ISO)
    page.add("rack_space_width", rack.pitch - rack.tooth_thickness, "{p} - {S}", _ISO)
    page.add("rack_tip_thickness", rack.tip_thickness, "{S} - 2 * {h_aR} * tan({alpha})", _ISO)
    page.add("rack_back_distance", rack.body_height + rack.dedendum)


def _pins(page: Sheet, rack: Rack, keys: RackKeys, helix: float) -> None:
    """Over a pin, from the rack's back."""
    page.section("Over a pin")
    share = " * cos({beta})" if helix else ""
    best = rack_measurement.pin_touching_at(rack, 0.0, helix)
    low, high = rack_measurement.pin_limits(rack, helix)
    page.add("pin_at_datum_line", best, f"{{e}}{share} / cos({{alpha_n}})", "KHK")
    page.told(least_rack_pin=low, greatest_rack_pin=high)
    pin = best if keys.pin_diameter is None else keys.pin_diameter
    found = rack_measurement.over_pin(rack, pin, helix)
    page.add("pin_diameter", pin)
    formula = f"{{H}} - {{e}}{share} / (2 * tan({{alpha_n}})) + {{D}} / 2 * (1 + 1 / sin({{alpha_n}}))"
    page.add("over_pin", found.length, formula, "KHK")
    if rack.circumferential_thinning:
        nominal = replace(rack, circumferential_thinning=0.0)
        page.add("over_pin_nominal", rack_measurement.over_pin(nominal, pin, helix).length)
    if keys.kerf:
        page.add("kerf", keys.kerf)
        # the space's flanks and the back lie half a kerf deeper
        formula = "{M} - {kerf} / 2 * (1 + 1 / sin({alpha_n}))"
        cut = found.length - keys.kerf / 2 * (1 + 1 / math.sin(math.radians(keys.pressure_angle_deg)))
        page.add("over_pin_after_kerf", cut, formula)
    if keys.measured_over_pin is not None:
        page.add("measured_over_pin", keys.measured_over_pin)
        thinned = rack_measurement.rack_with_size(rack, pin, keys.measured_over_pin, helix)
        own = " + {A}" if rack.circumferential_thinning else ""
        formula = f"2 * tan({{alpha_n}}) * ({{M}} - {{M_m}}){share.replace('*', '/')}{own}"
        page.add("thinning_from_rack_size", thinned.circumferential_thinning, formula)
    formula = f"({{D}} * cos({{alpha_n}}) - {{e}}{share}) / (2 * tan({{alpha_n}}))"
    page.add("pin_contact_height", found.contact_height, formula)
    if not ((found.touches_flanks and found.stands_out) or is_told(pin, low) or is_told(pin, high)):
        told = N_("a pin of {diameter:.4g} mm does not touch the flanks or does not stand out; take the best one")
        page.note(told, diameter=pin)
