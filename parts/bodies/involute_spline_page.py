"""``higherpair calc involute-spline``: sizes of an involute spline, pins and span, the bearing stress on its sides."""

from __future__ import annotations

import math
from typing import Annotated

from geometry.base.angles import inverse_involute, involute_function
from geometry.solids.spline_fits import (
    ISO_GRADES,
    SideLimits,
    grade_of,
    greatest_form,
    greatest_tip,
    root_limits,
    side_limits,
    tip_tolerance,
)
from geometry.solids.splines import InvoluteJoint, SplineMeasures
from parts.base.texts import N_
from parts.bodies.spline_steps import Length, LoadShare, Sides, Torque, bearing_steps, fit_tables, spline_of
from parts.keys.base import check_not_in_vain, mm
from parts.keys.splines import InvoluteSplineTable
from parts.pages.inputs import calculation
from parts.pages.page import Sheet

TOPIC = "involute-spline"
table_from = spline_of("involute_spline", InvoluteSplineTable)
# the effective limit at most material, the other one, the actual ones and what pins tell at those, greatest first
_TOOTH = ("greatest_effective_tooth", "least_effective_tooth", "greatest_tooth", "least_tooth",
          "greatest_over_pins", "least_over_pins")  # fmt: skip
_SPACE = ("least_effective_space", "greatest_effective_space", "greatest_space", "least_space",
          "greatest_between_pins", "least_between_pins")  # fmt: skip
_SPANS = ("greatest_span", "least_span")

_PIN_DIAMETER = mm("pin; default: it touches in the middle of the contact", above=0, most=1000, example=3.5)


class InvoluteSplineKeys(InvoluteSplineTable, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the spline, its pins and its load."""

    torque: Torque = None
    length: Length = None
    load_share: LoadShare = 0.75
    pin_diameter: Annotated[float, _PIN_DIAMETER] | None = None


@calculation(TOPIC, InvoluteSplineKeys)
def sheet(keys: InvoluteSplineKeys) -> Sheet:
    """The calculation of an involute spline."""
    keys.checked("")
    joint = keys.joint()
    reference, alpha = joint.module * joint.teeth, joint.pressure_angle
    page = Sheet(TOPIC, N_("Involute spline"))
    page.section("Given")
    page.told(spline_designation=joint.named(), module=joint.module, number_of_teeth=joint.teeth)
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
    page.told(shaft_tip_diameter=joint.shaft_diameters[1], shaft_root_diameter=joint.shaft_diameters[0])
    page.told(hub_tip_diameter=joint.hub_diameters[0], hub_root_diameter=joint.hub_diameters[1])
    _form_steps(page, joint)
    page.add("spline_clearance", keys.clearance)
    tip, inner = joint.shaft_diameters[1], joint.hub_diameters[0]
    sides = Sides(joint.teeth, (tip + inner) / 2, (tip - inner) / 2)
    page.add("spline_mean_diameter", sides.mean_diameter, "({d_a} + {D_a}) / 2")
    page.add("spline_height", sides.height, "({d_a} - {D_a}) / 2")
    for is_shaft in (True, False):
        _measured_steps(page, joint, keys, is_shaft=is_shaft)
    # the length is that of the deviations too
    length = keys.length if keys.torque is not None or not (joint.hub_class or joint.shaft_class) else None
    if keys.torque is None:
        check_not_in_vain(keys, ("load_share",), "torque")
    bearing_steps(page, sides, keys.torque, length, keys.load_share)
    fit_tables(page, joint.fits)
    return page


def _form_steps(page: Sheet, joint: InvoluteJoint) -> None:
    """Where the sides must be true, by ISO 4156, and where they are."""
    if joint.form_clearance:
        page.add("spline_form_clearance", joint.form_clearance, "0.1 * {m}", joint.standard)
        low, high = joint.form_diameters
        page.add("shaft_form_diameter", low, "{D_a} - 2 * {c_F}", joint.standard)
        page.add("hub_form_diameter", high, "{d_a} + 2 * {c_F}", joint.standard)
    shaft, hub = joint.shaft(), joint.hub()
    page.told(shaft_rounding=shaft.root_rounding, hub_rounding=hub.crest_rounding)
    page.told(shaft_side_diameter=shaft.side_diameters[0], hub_side_diameter=hub.side_diameters[1])


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
    limits = side_limits(joint, is_shaft=is_shaft, length=keys.length)
    if limits is not None:
        _limit_steps(page, joint, limits, found, is_shaft=is_shaft)


def _root_steps(
    page: Sheet, joint: InvoluteJoint, limits: SideLimits, roots: tuple[float, float], *, is_shaft: bool
) -> None:
    """Limits of tip and root diameters by ISO 4156; where the sides of a shaft with its deviation begin."""
    share, standard = ISO_GRADES[-1][0], joint.standard
    width = f"({share:g} * {{i_d}} + {4 * share:g} * {{i_s}}) / 1000 / tan({{alpha}})"
    tip = (greatest_tip(joint, limits) or joint.shaft_diameters[1]) if is_shaft else joint.hub_diameters[0]
    if (wide := tip_tolerance(joint, tip)) is not None:
        name, way = ("least_shaft_tip", -1) if is_shaft else ("greatest_hub_tip", 1)
        begin = "D_a" if not is_shaft else "D_EE" if greatest_tip(joint, limits) is not None else "d_a"
        page.add(name, tip + way * wide, f"{{{begin}}} {'-' if is_shaft else '+'} {1000 * wide:g} / 1000", standard)
    if not is_shaft:
        page.add("least_hub_root", roots[0], "{D_f}", standard)
        page.add("greatest_hub_root", roots[1], f"{{D_EI}} + {width}", standard)
        return
    thinned = " + {es} / 1000 / tan({alpha})" if limits.deviation else ""
    if limits.deviation:
        along = "sqrt({D_Fe}**2 - {d_b}**2) / 2 + {es} / 2000 / (tan({alpha}) * sin({alpha}))"
        formula = f"2 * sqrt(({{d_b}} / 2)**2 + ({along})**2)"
        page.add("greatest_shaft_form", greatest_form(joint, limits), formula, standard)
    page.add("greatest_shaft_root", roots[1], f"{{d_f}}{thinned}", standard)
    page.add("least_shaft_root", roots[0], f"{{D_IE}} - {width}", standard)


def _limit_steps(
    page: Sheet, joint: InvoluteJoint, limits: SideLimits, found: SplineMeasures, *, is_shaft: bool
) -> None:
    """The limits of a class, and what is measured at each of them with the pins of the nominal size."""
    page.section(N_("Limits of the shaft") if is_shaft else N_("Limits of the hub"))
    told = joint.shaft_class if is_shaft else joint.hub_class
    page.add("spline_class", told)
    standard, sign = joint.standard, "-" if is_shaft else "+"
    page.add("spline_deviation", 1000 * limits.deviation, "", standard)
    if (units := limits.units) is not None:
        share, *error = ISO_GRADES[grade_of(told) - 4]
        reference = joint.module * joint.teeth
        formula = "0.45 * cbrt({d}) + 0.001 * {d}" if reference <= 500 else "0.004 * {d} + 2.1"
        page.add("diameter_tolerance_unit", units.of_diameter, formula, standard)
        page.add("width_tolerance_unit", units.of_width, "0.45 * cbrt({s}) + 0.001 * {s}", standard)
        formula = f"{share:g} * {{i_d}} + {4 * share:g} * {{i_s}}"
        page.add("spline_total", 1000 * limits.total, formula, standard)
        usual = units.length == reference / 2
        page.add("spline_teeth_length", units.length, "{d} / 2" if usual else "", given=not usual)
        page.add("spline_pitch_error", units.pitch, f"{error[0]:g} * sqrt(pi * {{d}} / 2) + {error[1]:g}", standard)
        formula = f"{error[2]:g} * ({{m}} + 0.0125 * {{d}}) + {error[3]:g}"
        page.add("spline_profile_error", units.profile, formula, standard)
        page.add("spline_helix_error", units.helix, f"{error[4]:g} * sqrt({{l_t}}) + {error[5]:g}", standard)
        formula = "0.6 * sqrt({F_p}**2 + {F_alpha}**2 + {F_beta}**2)"
        page.add("spline_variation", 1000 * limits.variation, formula, standard)
    else:
        page.add("spline_total", 1000 * limits.total, "", standard)
        page.add("spline_variation", 1000 * limits.variation, "", standard)
    names = _TOOTH if is_shaft else _SPACE
    near, far = limits.effective[::-1] if is_shaft else limits.effective
    page.add(names[0], near, "{s} + {es} / 1000")
    if limits.units is not None:
        page.add(names[1], far, f"{{near}} {sign} ({{TL}} - {{lam}}) / 1000")
        if (tip := greatest_tip(joint, limits)) is not None:
            page.add("greatest_shaft_tip", tip, "{d_a} + {es} / 1000 / tan({alpha})", standard)
    if (roots := root_limits(joint, limits)) is not None:
        _root_steps(page, joint, limits, roots, is_shaft=is_shaft)
    page.add(names[2], limits.actual[1], "{near} - {lam} / 1000" if is_shaft else "{near} + {TL} / 1000")
    page.add(names[3], limits.actual[0], "{near} - {TL} / 1000" if is_shaft else "{near} + {lam} / 1000")
    aslant = " * cos(pi / (2 * {z}))" if joint.teeth % 2 else ""
    for width, over, span, key in zip(limits.actual[::-1], names[4:], _SPANS, ("most", "least"), strict=True):
        angle = f"{{{key}}} / {{d}} + inv({{alpha}})"
        angle += " + {D} / {d_b} - pi / {z}" if is_shaft else " - {D} / {d_b}"
        measured = joint.of_width(width, is_shaft=is_shaft, pin_diameter=found.pin_diameter)
        page.add(over, measured.over_pins, f"{{d_b}}{aslant} / cos(arcinv({angle})) {'+' if is_shaft else '-'} {{D}}")
        if is_shaft:
            # over as many teeth as the nominal one
            along = found.span + (width - found.thickness) * math.cos(joint.pressure_angle)
            page.add(span, along, f"cos({{alpha}}) * (pi * {{m}} * ({{k}} - 1) + {{{key}}} + {{d}} * inv({{alpha}}))")
