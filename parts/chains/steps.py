"""The steps of a chain and of its sprockets, as pages and tables of drawings have them."""

from __future__ import annotations

import math

from geometry.gears.chains.chain import Chain
from geometry.gears.chains.sprocket import GostForm, IsoForm, Sprocket, face_width, has_lowered_tip, height_coefficient
from parts.pages.page import Sheet

ISO, GOST = "ISO 606", "GOST 591-69"


def chain_steps(page: Sheet, chain: Chain) -> None:
    """What is known of the chain."""
    page.add("chain_pitch", chain.pitch)
    page.add("chain_roller_diameter", chain.roller_diameter)
    for name in ("inner_width", "plate_height", "transverse_pitch"):
        if value := getattr(chain, name):
            page.add(f"chain_{name}", value)
    if chain.strands > 1:
        page.add("chain_strands", chain.strands)


def circle_steps(page: Sheet, sprocket: Sprocket, gear: int = 0) -> None:
    """Its circles, and the tip diameter within its limits."""
    form, teeth = sprocket.form, sprocket.number_of_teeth
    page.add("chain_pitch_diameter", 2 * sprocket.pitch_radius, "{p} / sin(pi / {z#})", _source(sprocket), gear)
    if isinstance(form, IsoForm):
        least, most = form.tips(sprocket.chain, teeth)
        page.add("least_chain_tip", least, "{d#} + {p} * (1 - 1.6 / {z#}) - {d_r}", ISO, gear)
        page.add("greatest_chain_tip", most, "{d#} + 1.25 * {p} - {d_r}", ISO, gear)
        middle = "({d_al#} + {d_ag#}) / 2" if math.isclose(4 * sprocket.tip_radius, least + most) else ""
        page.add("chain_tip_diameter", 2 * sprocket.tip_radius, middle, "", gear)
        page.add("chain_root_diameter", 2 * sprocket.root_radius, "{d#} - {d_r}", ISO, gear)
        return
    formula = ""
    if sprocket.given_tip_diameter is None:
        if not gear or gear == 1:
            page.add("pitch_to_roller", sprocket.chain.pitch / sprocket.chain.roller_diameter, "{p} / {d_r}", GOST)
            page.add("tooth_height_coefficient", height_coefficient(sprocket.chain), "", GOST)
        formula = "" if has_lowered_tip(sprocket) else "{p} * ({K} + 1 / tan(pi / {z#}))"
    page.add("chain_tip_diameter", 2 * sprocket.tip_radius, formula, GOST if formula else "", gear)
    if not gear or gear == 1:
        page.add("gap_radius", form.seating_radius(sprocket.chain.roller_diameter), "0.5025 * {d_r} + 0.05", GOST)
    page.add("chain_root_diameter", 2 * sprocket.root_radius, "{d#} - 2 * {r}", GOST, gear)


def gap_steps(page: Sheet, sprocket: Sprocket) -> None:
    """The gap between two teeth."""
    form, teeth, roller = sprocket.form, sprocket.number_of_teeth, sprocket.chain.roller_diameter
    if isinstance(form, IsoForm):
        page.add("gap_share", form.share)
        page.add("seating_radius", form.seating_radius(roller), "0.505 * {d_r} + {f} * 0.069 * cbrt({d_r})", ISO)
        seat = "(140 - 20 * {f} - 90 / {z}) * pi / 180"
        page.add("seating_angle_deg", math.degrees(form.seating_angle(teeth)), seat, ISO)
        flank = "(1 - {f}) * 0.12 * {d_r} * ({z} + 2) + {f} * 0.008 * {d_r} * ({z}**2 + 180)"
        page.add("chain_flank_radius", form.flank_radius(roller, teeth), flank, ISO)
        return
    radius, angles = form.seating_radius(roller), form.angles(teeth)
    page.add("joining_radius", 0.8 * roller + radius, "0.8 * {d_r} + {r}", GOST)
    for name, half, (whole, part) in zip(
        ("half_gap_angle_deg", "joining_angle_deg", "half_tooth_angle_deg"), angles, ((55, 60), (18, 56), (17, 64)),
        strict=True,
    ):  # fmt: skip
        page.add(name, math.degrees(half), f"({whole} - {part} / {{z}}) * pi / 180", GOST)
    head = "{d_r} * (1.24 * cos({phi}) + 0.8 * cos({beta}) - 1.3025) - 0.05"
    page.add("head_radius", form.flank_radius(roller, teeth), head, GOST)
    straight = roller * (1.24 * math.sin(angles[2]) - 0.8 * math.sin(angles[1]))
    page.add("straight_flank", straight, "{d_r} * (1.24 * sin({phi}) - 0.8 * sin({beta}))", GOST)
    if form.displaced:
        page.add("gap_displacement", form.displacement(sprocket.chain.pitch), "0.03 * {p}", GOST)


def width_steps(page: Sheet, sprocket: Sprocket) -> None:
    """Width of the teeth, of all rows, and what the chain's plates leave beside them."""
    chain, iso = sprocket.chain, isinstance(sprocket.form, IsoForm)
    formula, width = "", sprocket.face_width
    if chain.inner_width and math.isclose(width, face_width(chain, sprocket.form), rel_tol=1e-12):
        part = (0.93 if chain.pitch <= 12.7 else 0.95) - 0.02 * (chain.strands > 1)
        formula = f"{part:.2f} * {{b_1}}" if iso else f"{0.93 if chain.strands == 1 else 0.9} * {{b_1}} - 0.15"
    page.add("tooth_row_width", width, formula, _source(sprocket) if formula else "")
    if chain.strands > 1:
        page.add("rows_width", sprocket.total_width, "({n_s} - 1) * {p_t} + {b_f}", _source(sprocket))
    if iso:
        part = 0.06 if chain.thin else 0.13
        page.add("tooth_side_relief", part * chain.pitch, f"{part} * {{p}}", ISO)
        page.add("tooth_side_radius", chain.pitch, "{p}", ISO)
    else:
        page.add("tooth_side_radius", 1.7 * chain.roller_diameter, "1.7 * {d_r}", GOST)
    if sprocket.bevel:
        page.add("tooth_bevel", sprocket.bevel)
    if sprocket.plate_room:
        rest = "1.04 * {h_2} - 0.76" if iso else "1.3 * {h_2}"
        page.add("plate_room_diameter", sprocket.plate_room, f"{{p}} / tan(pi / {{z}}) - {rest}", _source(sprocket))


def measured_steps(page: Sheet, sprocket: Sprocket) -> None:
    """Over pins as thick as the rollers, and between the roots."""
    off, form = " * cos(pi / (2 * {z}))" if sprocket.number_of_teeth % 2 else "", sprocket.form
    chord, source = f"({{d_f}} + 2 * {{r_i}}){off} - 2 * {{r_i}}", ""
    if isinstance(form, GostForm):
        chord, source = f"{{d}}{off} - 2 * {{r}}", GOST
        if off and form.displaced:
            chord, source = f"{chord} - {{e}} * sin(pi / (2 * {{z}}))", ""
    page.add("root_chord", sprocket.root_chord, chord if off else "{d_f}", source if off else "")
    over, source = (f"{{d}}{off} + {{d_r}}", ISO) if isinstance(form, IsoForm) else ("{L_x} + 2 * {d_r}", "")
    page.add("sprocket_over_pins", sprocket.over_pins, over, source)
    page.add("tip_thickness", sprocket.tip_thickness)


def _source(sprocket: Sprocket) -> str:
    return GOST if isinstance(sprocket.form, GostForm) else ISO
