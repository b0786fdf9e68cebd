"""``higherpair calc lantern``: the gear of a lantern, the limits of its teeth, contact ratio, pressure angles."""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np
from msgspec import Meta

from geometry.gears.pins.lantern import LanternGear, greatest_pin_diameter, lantern_findings, limits_of
from parts.base.texts import N_
from parts.pages.inputs import calculation, part_of_kind
from parts.pages.page import Sheet, Table, table_of
from parts.pins.lantern_gear import LANTERN_GEAR, LanternGearSpec
from parts.texts.findings import finding_message

TOPIC = "lantern"
table_from = part_of_kind("lantern_gear")
_SOURCE = "Litvin, Fuentes, Gear Geometry, 13"


class LanternKeys(LanternGearSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the gear of a lantern, and how long its table is."""

    rows: Annotated[int, Meta(ge=2, le=2000, description="rows of the table of the flank")] = 13


@calculation(TOPIC, LanternKeys)
def sheet(keys: LanternKeys) -> Sheet:
    """The calculation of a lantern and its gear."""
    gear = LANTERN_GEAR.thing(keys, {})
    page = Sheet(TOPIC, N_("Lantern and its gear"))
    _given(page, gear)
    _sizes(page, gear)
    _limits(page, gear)
    _contact(page, gear)
    page.tables.append(_table(gear, keys.rows))
    page.note("where the gear drives, its flanks touch from the line of centres on; where the lantern drives, up to it")
    page.notes += [finding_message(f) for f in lantern_findings(gear)]
    return page


def _given(page: Sheet, gear: LanternGear) -> None:
    page.section("Given")
    page.told(number_of_teeth=gear.number_of_teeth, number_of_pins=gear.number_of_pins)
    page.told(lantern_pitch_radius=gear.lantern_radius, pin_radius=gear.pin_diameter / 2)
    page.told(pin_clearance=gear.pin_clearance, root_clearance=gear.root_clearance)


def _sizes(page: Sheet, gear: LanternGear) -> None:
    page.section("Sizes")
    page.add("gear_ratio", gear.number_of_teeth / gear.number_of_pins, "{z} / {N}")
    page.add("lantern_gear_pitch_radius", gear.pitch_radius, "{r_2} * {z} / {N}")
    page.add("working_centre_distance", gear.centre_distance, "{r_1} + {r_2}")
    page.add("lantern_pitch", gear.pitch, "2 * pi * {r_2} / {N}")
    page.add("pitch_angle_deg", math.degrees(gear.pitch_angle), "2 * pi / {z}")
    page.add("epicycloid_order", 1 + gear.number_of_teeth / gear.number_of_pins, "1 + {z} / {N}", _SOURCE)
    page.add("generating_pin_radius", gear.generating_pin_radius, "{r_p} + {c_p}")
    page.add("root_arc_radius", gear.root_arc_radius, "{rho} + {c_f}")
    page.add("root_radius", gear.root_radius, "{r_1} - {rho_f}")


def _limits(page: Sheet, gear: LanternGear) -> None:
    found = limits_of(gear)
    page.section("Limits of the tooth")
    page.add("half_pin_distance", gear.lantern_radius * math.sin(math.pi / gear.number_of_pins),
             "{r_2} * sin(pi / {N})")  # fmt: skip
    page.add("greatest_pin_radius", greatest_pin_diameter(gear) / 2)
    neck = 2 * (gear.pitch_radius * math.sin(gear.pitch_angle / 2) - gear.root_arc_radius)
    page.add("neck_width", neck, "2 * ({r_1} * sin({tau} / 2) - {rho_f})")
    page.told(flank_start_radius=found.start_radius, pointed_radius=found.pointed_radius)
    page.told(tip_radius=found.tip_radius, tip_thickness=gear.tip_thickness)


def _contact(page: Sheet, gear: LanternGear) -> None:
    found = limits_of(gear)
    page.section("Contact")
    page.told(flank_start_angle_deg=math.degrees(found.start), flank_end_angle_deg=math.degrees(found.tip))
    page.add("lantern_contact_ratio", gear.contact_ratio, "({u_2} - {u_1}) / {tau}")
    # the pin has turned u z / N; its chord to the pole leans half as much on the tangent of both pitch circles
    turned = found.tip * gear.number_of_teeth / gear.number_of_pins
    page.add("end_pressure_angle_deg", math.degrees(turned / 2), "{u_2} * {z} / (2 * {N})")


def _table(gear: LanternGear, rows: int) -> Table:
    """u, the pin's angle from the line of centres, pressure angle, radius, flank in the gear's frame, its curvature."""
    found = limits_of(gear)
    u = np.linspace(found.start, found.tip, rows)
    flank = gear.flank(found.start, found.tip)
    point, turned = flank.point(u), u * gear.number_of_teeth / gear.number_of_pins
    with np.errstate(divide="ignore"):
        bend = 1 / flank.curvature(u)
    columns = [np.degrees(u), np.degrees(turned), np.degrees(turned) / 2, np.abs(point), point.real, point.imag, bend]
    heads = (("u", "deg"), ("phi", "deg"), ("alpha", "deg"), ("r", "mm"), ("x", "mm"), ("y", "mm"), ("rho", "mm"))
    title = N_("Flank from root to tip: gear's and pin's angle, pressure angle, lower flank of tooth 1, its curvature")
    return table_of("flank", title, heads, zip(*columns, strict=True))
