"""``higherpair calc ring``: one internal gear, spur or helical: dimensions, limits and what is measured from within."""

from __future__ import annotations

import math
from typing import Annotated

from msgspec import Meta

from geometry.gears.teeth import measurement, ring_limits
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.ring_made import generation
from parts.base.texts import N_, Told
from parts.gears.ring_gear.part import RingGearSpec, checked_ring_gear, tip_finding
from parts.gears.spur_gear.page import (
    cutter_data,
    generated_root,
    generating_shift,
    height_steps,
    helix_steps,
    least_tip_step,
    normal_tip_step,
    section_data,
    sector_data,
    sector_steps,
    shift_data,
    thickness_steps,
    thinning_data,
)
from parts.keys.base import mm
from parts.pages.inputs import calculation, part_of_kind
from parts.pages.measured_steps import Asked, measured_steps
from parts.pages.page import Sheet
from parts.pages.roll_steps import gear_rolls
from parts.texts.findings import finding_of

TOPIC = "ring"
table_from = part_of_kind("ring_gear")
_GOST, _ISO = "GOST 19274", "ISO 21771"

_MEASURED_BETWEEN_PINS = mm("size between pins or balls measured on the part", above=0, most=100_000)


class RingKeys(RingGearSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the topic: those of a ring, and what is measured."""

    spaces_spanned: Annotated[int, Meta(ge=1, le=10_000, description="spaces in the span")] | None = None
    pin_diameter: Annotated[float, mm("pin or ball", above=0, most=10_000)] | None = None
    kerf: Annotated[float, mm("full width of a cut that was not corrected for", least=0, most=10)] | None = None
    measured_span: Annotated[float, mm("span measured on the part", above=0, most=100_000)] | None = None
    measured_between_pins: Annotated[float, _MEASURED_BETWEEN_PINS] | None = None
    diameter: Annotated[float, mm("circle on which the tooth is measured", above=0, most=100_000)] | None = None


@calculation(TOPIC, RingKeys)
def sheet(keys: RingKeys) -> Sheet:
    """The calculation of one ring."""
    ring = checked_ring_gear(keys)
    page = Sheet(TOPIC, N_("Internal gear"))
    helix = math.radians(keys.helix_angle_deg)
    _given(page, ring, keys, helix)
    _dimensions(page, ring, keys)
    _thicknesses(page, ring, helix, keys.diameter)
    gear_rolls(page, ring)
    _limits(page, ring, keys)
    measured, face = (keys.measured_span, keys.measured_between_pins), (keys.face_width, keys.double_helical)
    asked = Asked(helix, *face, keys.spaces_spanned, keys.pin_diameter, keys.kerf, *measured)
    measured_steps(page, ring, asked)
    return page


def _given(page: Sheet, ring: RingGear, keys: RingKeys, helix: float) -> None:
    """Module, angle, shift, addendum, and what makes the root, in normal modules."""
    page.section("Given")
    section_data(page, keys.module, math.radians(keys.pressure_angle_deg), helix)
    page.add("number_of_teeth", ring.number_of_teeth)
    sector_data(page, ring)
    shift_data(page, keys.profile_shift_coefficient, helix)
    page.add("addendum_coefficient", keys.addendum_coefficient)
    thinning_data(page, ring, helix, "+")
    normal = ring.module / keys.module
    if isinstance(ring.root, RoundedRoot):
        page.told(dedendum_coefficient=ring.root.dedendum * normal, root_rounding_coefficient=ring.root.radius)
    else:
        cutter_data(page, ring.root, normal=normal)


def _dimensions(page: Sheet, ring: RingGear, keys: RingKeys) -> None:
    """Pitches and diameters; the root is where the cutter's tips come to."""
    page.section("Diameters")
    page.add("pitch", math.pi * ring.module, "pi * {m}", _ISO)
    page.add("base_pitch", ring.pitch_angle * ring.base_radius, "{p} * cos({alpha})", _ISO)
    helix_steps(page, ring.module, ring.number_of_teeth, math.radians(keys.helix_angle_deg))
    page.add("reference_diameter", 2 * ring.reference_radius, "{m} * {z}", _ISO)
    page.add("base_diameter", 2 * ring.base_radius, "{d} * cos({alpha})", _ISO)
    formula = ""
    if ring.given_tip_diameter is None and ring.tip_radius == ring.default_tip_radius:
        plain = keys.tip_rule == "KHK" or keys.profile_shift_coefficient >= 2
        short = "" if plain else " - (0.25 - 0.125 * {x_n})"
        formula = f"{{d}} - 2 * ({{h_a}} - {{x_n}}{short}) * {{m_n}}"
    page.add("tip_diameter", 2 * ring.tip_radius, formula, _GOST if formula else "")
    if isinstance(ring.root, RoundedRoot):
        page.add("root_diameter", 2 * ring.root_radius, f"{{d}} + 2 * ({{h_f}} + {generating_shift(ring)}) * {{m_n}}")
    else:
        generated_root(page, ring, _GOST, "-", "+")
    page.add("root_form_diameter", ring_limits.root_form_diameter(ring), "", _ISO)
    heights = ring.reference_radius - ring.tip_radius, ring.root_radius - ring.reference_radius
    height_steps(page, heights, ("({d} - {d_a}) / 2", "({d_f} - {d}) / 2"))
    sector_steps(page, ring)


def _thicknesses(page: Sheet, ring: RingGear, helix: float, diameter: float | None) -> None:
    """Tooth and space on the reference, base and tip circles, and on one that is asked for."""
    page.section("Tooth thickness")
    page.add("profile_shift", ring.profile_shift_coefficient * ring.module, "{x} * {m}", _ISO)
    less = " - {A}" if ring.circumferential_thinning else ""
    formula = f"0.5 * {{p}} - 2 * {{x}} * {{m}} * tan({{alpha}}){less}"
    page.add("reference_thickness", ring.reference_thickness, formula, _ISO)
    page.add("space_width", math.pi * ring.module - ring.reference_thickness, "{p} - {S}", _ISO)
    formula = "{d_b} * ({e} / {d} + inv({alpha}))"
    page.add("base_space_width", measurement.base_thickness(ring), formula, _ISO)
    angle = math.degrees(measurement.angle_at(ring, ring.tip_radius))
    page.add("tip_pressure_angle_deg", angle, "arccos({d_b} / {d_a})", _ISO)
    formula = "{d_a} * ({S} / {d} - inv({alpha}) + inv({alpha_a}))"
    page.add("tip_thickness", ring_limits.tip_thickness(ring), formula, _ISO)
    normal_tip_step(page, ring, ring_limits.tip_thickness(ring), helix)
    thickness_steps(page, ring, diameter, "{d_y} * ({S} / {d} - inv({alpha}) + inv({alpha_y}))")


def _limits(page: Sheet, ring: RingGear, keys: RingKeys) -> None:
    """Margins of the cutting, the pointed tip, and what is poor."""
    page.section("Conditions: margins")
    if (mesh := generation(ring)) is not None:
        for margin in mesh.margins():
            page.add(f"{margin.name}_margin", margin.margin, "", "KHK")
    if (pointed := ring_limits.pointed_tip(ring).limit) > 0:
        # the least of a ring
        page.add("pointed_diameter", Told(pointed, up=True))
    least_tip_step(page, ring.module)
    limited = tip_finding(ring, keys.module)
    found = [*([] if limited is None else [limited]), *ring_limits.findings(ring)]
    page.notes += [finding_of(0, finding) for finding in found]
