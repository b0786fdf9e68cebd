"""``higherpair calc involute-spline``: sizes of an involute spline, pins and span, the bearing stress on its sides."""

from __future__ import annotations

import math
from typing import Annotated

from geometry.base.angles import inverse_involute, involute_function
from geometry.solids.splines import InvoluteJoint
from parts.base.texts import N_
from parts.bodies.spline_steps import Length, LoadShare, Sides, Torque, bearing_steps
from parts.keys.base import mm
from parts.keys.splines import InvoluteSplineTable
from parts.pages.inputs import calculation
from parts.pages.page import Sheet

TOPIC = "involute-spline"


class InvoluteSplineKeys(InvoluteSplineTable, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the spline, its pins and its load."""

    torque: Torque = None
    length: Length = None
    load_share: LoadShare = 0.75
    pin_diameter: (
        Annotated[
            float,
            mm("pin; default: it touches in the middle of the contact", above=0, most=1000, example=3.5),
        ]
        | None
    ) = None


@calculation(TOPIC, InvoluteSplineKeys)
def sheet(keys: InvoluteSplineKeys) -> Sheet:
    """The calculation of an involute spline."""
    keys.checked("")
    joint = keys.joint()
    reference, alpha = joint.module * joint.teeth, joint.pressure_angle
    page = Sheet(TOPIC, N_("Involute spline"))
    page.section("Given")
    page.add("spline_designation", joint.name)
    page.add("module", joint.module)
    page.add("number_of_teeth", joint.teeth)
    page.add("spline_pressure_angle_deg", math.degrees(alpha))
    page.section("Sizes")
    page.add("reference_diameter", reference, "{m} * {z}")
    page.add("base_diameter", reference * math.cos(alpha), "{d} * cos({alpha})")
    if keys.standard != "ISO 4156":
        shift = (joint.thickness - math.pi / 2 * joint.module) / 2 / math.tan(alpha)
        page.add("spline_outer_diameter", joint.hub_diameters[0] + 2 * joint.module)
        page.add("spline_shift", shift, "({D} - {m} * {z} - 1.1 * {m}) / 2", keys.standard)
        page.add("spline_thickness", joint.thickness, "pi / 2 * {m} + 2 * {xm} * tan({alpha})", keys.standard)
    else:
        page.add("spline_thickness", joint.thickness, "pi / 2 * {m}", keys.standard)
    page.add("shaft_tip_diameter", joint.shaft_diameters[1])
    page.add("shaft_root_diameter", joint.shaft_diameters[0])
    page.add("hub_tip_diameter", joint.hub_diameters[0])
    page.add("hub_root_diameter", joint.hub_diameters[1])
    _form_steps(page, joint)
    page.add("spline_clearance", keys.clearance)
    tip, inner = joint.shaft_diameters[1], joint.hub_diameters[0]
    sides = Sides(joint.teeth, (tip + inner) / 2, (tip - inner) / 2)
    page.add("spline_mean_diameter", sides.mean_diameter, "({d_a} + {D_a}) / 2")
    page.add("spline_height", sides.height, "({d_a} - {D_a}) / 2")
    for is_shaft in (True, False):
        _measured_steps(page, joint, keys, is_shaft=is_shaft)
    bearing_steps(page, sides, keys.torque, keys.length, keys.load_share)
    return page


def _form_steps(page: Sheet, joint: InvoluteJoint) -> None:
    """Where the sides must be true, by ISO 4156, and where they are."""
    if joint.form_clearance:
        page.add("spline_form_clearance", joint.form_clearance, "0.1 * {m}", joint.standard)
        low, high = joint.form_diameters
        page.add("shaft_form_diameter", low, "{D_a} - 2 * {c_F}", joint.standard)
        page.add("hub_form_diameter", high, "{d_a} + 2 * {c_F}", joint.standard)
    shaft, hub = joint.shaft(), joint.hub()
    page.add("shaft_rounding", shaft.root_rounding)
    page.add("hub_rounding", hub.crest_rounding)
    page.add("shaft_side_diameter", shaft.side_diameters[0])
    page.add("hub_side_diameter", hub.side_diameters[1])


def _measured_steps(page: Sheet, joint: InvoluteJoint, keys: InvoluteSplineKeys, *, is_shaft: bool) -> None:
    """Over pins and the span of a shaft that has all of the clearance, between pins of such a hub."""
    page.section(N_("Measurement of the shaft") if is_shaft else N_("Measurement of the hub"))
    play, sign = (-keys.clearance, "-") if is_shaft else (keys.clearance, "+")
    found = joint.measured(play, is_shaft=is_shaft, pin_diameter=keys.pin_diameter or 0.0)
    reference, alpha, z = joint.module * joint.teeth, joint.pressure_angle, joint.teeth
    base = reference * math.cos(alpha)
    page.add("measured_spline_thickness", found.thickness, f"{{s}} {sign} 2 * {{j}} / cos({{alpha}})")
    page.add("pin_diameter", found.pin_diameter, given=keys.pin_diameter is not None)
    way = 1 if is_shaft else -1
    involute = found.thickness / reference + involute_function(alpha) + way * found.pin_diameter / base
    involute -= math.pi / z if is_shaft else 0.0
    formula = (
        "{s_m} / {d} + inv({alpha}) + {D} / {d_b} - pi / {z}"
        if is_shaft
        else ("{s_m} / {d} + inv({alpha}) - {D} / {d_b}")
    )
    page.add("involute_at_pins", involute, formula)
    angle = math.degrees(inverse_involute(involute))
    page.add("pin_angle_deg", angle, "arcinv({inv_alpha_M})")
    aslant = " * cos(pi / (2 * {z}))" if z % 2 else ""
    formula = f"{{d_b}}{aslant} / cos({{alpha_M}}) {'+' if is_shaft else '-'} {{D}}"
    page.add("over_pins" if is_shaft else "between_pins", found.over_pins, formula)
    if is_shaft:
        page.add("teeth_spanned", found.teeth_spanned)
        formula = "cos({alpha}) * (pi * {m} * ({k} - 1) + {s_m} + {d} * inv({alpha}))"
        page.add("span", found.span, formula)
