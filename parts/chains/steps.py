"""The steps of a chain and of its sprockets, as pages and tables of drawings have them."""

from __future__ import annotations

import math

from geometry.gears.chains.chain import Chain
from geometry.gears.chains.sprocket import (
    AnsiForm,
    GostForm,
    IsoForm,
    SeatedForm,
    Sprocket,
    face_width,
    has_lowered_tip,
    width_parts,
)
from parts.pages.page import Sheet


def chain_steps(page: Sheet, chain: Chain) -> None:
    """What is known of the chain."""
    page.told(chain_pitch=chain.pitch, chain_roller_diameter=chain.roller_diameter)
    for name in ("inner_width", "plate_height", "transverse_pitch"):
        if value := getattr(chain, name):
            page.add(f"chain_{name}", value)
    if chain.strands > 1:
        page.add("chain_strands", chain.strands)


def circle_steps(page: Sheet, sprocket: Sprocket, gear: int = 0, *, alike: bool = False) -> None:
    """Its circles, and the tip diameter within its limits; ``alike``: its form is that of the first, told already."""
    form, teeth = sprocket.form, sprocket.number_of_teeth
    page.add("chain_pitch_diameter", 2 * sprocket.pitch_radius, "{p} / sin(pi / {z#})", form.standard, gear)
    if isinstance(form, IsoForm):
        least, most = form.tips(sprocket.chain, teeth)
        page.add("least_chain_tip", least, "{d#} + {p} * (1 - 1.6 / {z#}) - {d_r}", form.standard, gear)
        page.add("greatest_chain_tip", most, "{d#} + 1.25 * {p} - {d_r}", form.standard, gear)
        middle = "({d_al#} + {d_ag#}) / 2" if math.isclose(4 * sprocket.tip_radius, least + most) else ""
        page.add("chain_tip_diameter", 2 * sprocket.tip_radius, middle, "", gear)
        page.add("chain_root_diameter", 2 * sprocket.root_radius, "{d#} - {d_r}", form.standard, gear)
        return
    formula = ""
    if sprocket.given_tip_diameter is None:
        if not alike:
            if isinstance(form, GostForm):
                ratio = sprocket.chain.pitch / sprocket.chain.roller_diameter
                page.add("pitch_to_roller", ratio, "{p} / {d_r}", form.standard)
            page.add("tooth_height_coefficient", form.height(sprocket.chain), "", form.standard)
        formula = "" if has_lowered_tip(sprocket) else "{p} * ({K} + 1 / tan(pi / {z#}))"
    page.add("chain_tip_diameter", 2 * sprocket.tip_radius, formula, form.standard if formula else "", gear)
    if not alike:
        radius = form.seating_radius(sprocket.chain.roller_diameter)
        page.add("gap_radius", radius, f"0.5025 * {{d_r}} + {form.play:g}", form.standard)
    page.add("chain_root_diameter", 2 * sprocket.root_radius, "{d#} - 2 * {r}", form.standard, gear)


def gap_steps(page: Sheet, sprocket: Sprocket) -> None:
    """The gap between two teeth."""
    form, teeth, roller = sprocket.form, sprocket.number_of_teeth, sprocket.chain.roller_diameter
    if isinstance(form, IsoForm):
        page.add("gap_share", form.share)
        bed = "0.505 * {d_r} + {f} * 0.069 * cbrt({d_r})"
        page.add("seating_radius", form.seating_radius(roller), bed, form.standard)
        seat = "(140 - 20 * {f} - 90 / {z}) * pi / 180"
        page.add("seating_angle_deg", math.degrees(form.seating_angle(teeth)), seat, form.standard)
        flank = "(1 - {f}) * 0.12 * {d_r} * ({z} + 2) + {f} * 0.008 * {d_r} * ({z}**2 + 180)"
        page.add("chain_flank_radius", form.flank_radius(roller, teeth), flank, form.standard)
        return
    radius, angles = form.seating_radius(roller), form.angles(teeth)
    page.add("joining_radius", 0.8 * roller + radius, "0.8 * {d_r} + {r}", form.standard)
    for name, half, (whole, part) in zip(
        ("half_gap_angle_deg", "joining_angle_deg", "half_tooth_angle_deg"), angles, ((55, 60), (18, 56), (17, 64)),
        strict=True,
    ):  # fmt: skip
        page.add(name, math.degrees(half), f"({whole} - {part} / {{z}}) * pi / 180", form.standard)
    head = f"{{d_r}} * ({form.far} * cos({{phi}}) + 0.8 * cos({{beta}}) - 1.3025) - {form.play:g}"
    page.add("head_radius", form.flank_radius(roller, teeth), head, form.standard)
    straight = f"{{d_r}} * ({form.far} * sin({{phi}}) - 0.8 * sin({{beta}}))"
    page.add("straight_flank", form.straight(roller, teeth), straight, form.standard)
    if apart := form.displacement(sprocket.chain.pitch):
        page.add("gap_displacement", apart, "0.03 * {p}", form.standard)


def width_steps(page: Sheet, sprocket: Sprocket) -> None:
    """Width of the teeth, of all rows, and what the chain's plates leave beside them."""
    chain, form, iso = sprocket.chain, sprocket.form, isinstance(sprocket.form, IsoForm)
    formula, width = "", sprocket.face_width
    if chain.inner_width and math.isclose(width, face_width(chain, form), rel_tol=1e-12):
        part, less = width_parts(chain, form)
        formula = f"{part:.2f} * {{b_1}}" + (f" - {less:g}" if less else "")
    page.add("tooth_row_width", width, formula, form.standard if formula else "")
    if chain.strands > 1:
        page.add("rows_width", sprocket.total_width, "({n_s} - 1) * {p_t} + {b_f}", form.standard)
    if not isinstance(form, GostForm):
        part = 0.125 if not iso else 0.06 if chain.thin else 0.13
        page.add("tooth_side_relief", part * chain.pitch, f"{part} * {{p}}", form.standard)
        part = 1.0 if iso else 1.0625
        page.add("tooth_side_radius", part * chain.pitch, "{p}" if iso else f"{part} * {{p}}", form.standard)
    else:
        page.add("tooth_side_radius", 1.7 * chain.roller_diameter, "1.7 * {d_r}", form.standard)
    page.told(tooth_bevel=sprocket.bevel or None)
    if sprocket.plate_room:
        rest = "1.04 * {h_2} - 0.76" if iso else "{p} - 0.762" if isinstance(form, AnsiForm) else "1.3 * {h_2}"
        page.add("plate_room_diameter", sprocket.plate_room, f"{{p}} / tan(pi / {{z}}) - {rest}", form.standard)


def measured_steps(page: Sheet, sprocket: Sprocket) -> None:
    """Over pins as thick as the rollers, and between the roots."""
    off, form = " * cos(pi / (2 * {z}))" if sprocket.number_of_teeth % 2 else "", sprocket.form
    chord, source = f"({{d_f}} + 2 * {{r_i}}){off} - 2 * {{r_i}}", ""
    if isinstance(form, SeatedForm):
        chord, source = f"{{d}}{off} - 2 * {{r}}", form.standard
        if off and form.displacement(sprocket.chain.pitch):
            chord, source = f"{chord} - {{e}} * sin(pi / (2 * {{z}}))", ""
    if isinstance(form, AnsiForm):
        page.add("nominal_caliper_diameter", sprocket.nominal_chord, f"{{d}}{off} - {{d_r}}", form.standard)
    page.add("root_chord", sprocket.root_chord, chord if off else "{d_f}", source if off else "")
    over, source = (f"{{d}}{off} + {{d_r}}", form.standard) if isinstance(form, IsoForm) else ("{L_x} + 2 * {d_r}", "")
    page.add("sprocket_over_pins", sprocket.over_pins, over, source)
    page.add("tip_thickness", sprocket.tip_thickness)
