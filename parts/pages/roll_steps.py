"""Steps of what an inspector of involutes sets: roll angles and lengths of a flank, of one gear and of a pair."""

from __future__ import annotations

import math

from geometry.base.angles import tangent_length
from geometry.gears.pairs.external import ExternalPair
from geometry.gears.pairs.internal import InternalPair
from geometry.gears.pairs.sliding import active_line
from geometry.gears.teeth.ring import RingGear
from geometry.gears.teeth.ring_tooth import ring_side
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import tooth_side
from parts.base.texts import N_
from parts.pages.page import Sheet

_ISO = "ISO 21771"


def _angle(page: Sheet, name: str, radius: float, base: float, diameters: tuple[str, str], gear: int = 0) -> None:
    """The roll angle xi = tan(alpha_y) on a circle; ``diameters``: how formulas have it and the base circle."""
    formula = f"sqrt(({{{diameters[0]}}} / {diameters[1]})**2 - 1)"
    page.add(name, math.degrees(tangent_length(radius, base) / base), formula, _ISO, gear)


def gear_rolls(page: Sheet, gear: SpurGear | RingGear) -> None:
    """Where the involute of one gear begins and ends."""
    side = ring_side(gear) if isinstance(gear, RingGear) else tooth_side(gear)
    root, tip = side.flank_radii(relief=True)
    page.section(N_("Roll angles"))
    page.add("tip_form_diameter", 2 * tip, "", _ISO)
    for name, radius, key in (
        ("root_form", root, "d_Ff"), ("reference", gear.reference_radius, "d"), ("tip_form", tip, "d_Fa")
    ):  # fmt: skip
        _angle(page, f"roll_angle_at_{name}_deg", radius, gear.base_radius, (key, "{d_b}"))
    for name, radius, key in (("root_form", root, "d_Ff"), ("tip_form", tip, "d_Fa")):
        length = tangent_length(radius, gear.base_radius)
        page.add(f"roll_length_at_{name}", length, f"sqrt({{{key}}}**2 - {{d_b}}**2) / 2", _ISO)


def pair_rolls(page: Sheet, pair: ExternalPair | InternalPair) -> None:
    """Where both involutes and their contact begin and end, roll on each other, and are alone in contact (B to D)."""
    line, bases = active_line(pair), (pair.first.base_radius, pair.second.base_radius)
    # a ring's flanks begin outside
    actives = pair.active_profile_radii[0], pair.active_profile_radii[1][:: pair.sign]
    page.section(N_("Roll angles"))
    rows = [
        ("root_form", "d_Ff#", pair.root_form_radii), ("start", "d_Nf#", (actives[0][0], actives[1][0])),
        ("end", "d_Na#", (actives[0][1], actives[1][1])), ("tip_form", "d_Fa#", pair.tip_form_radii),
    ]  # fmt: skip
    for gear, base in enumerate(bases, 1):
        for name, key, radii in rows:
            _angle(page, f"roll_angle_at_{name}_deg", radii[gear - 1], base, (key, "(2 * {r_b#})"), gear)
    pitch = math.tan(pair.working_pressure_angle)
    page.add("roll_angle_at_pitch_point_deg", math.degrees(pitch), "tan({alpha_w})", _ISO)
    if not pair.base_pitch < line.length < 2 * pair.base_pitch:
        return
    step = "2 * pi * {r_b1} / {z1}"
    for name, point, place, ends, signs in (
        ("start", "d_B#", line.end - pair.base_pitch, ("d_Na", "d_Nf"), "-+"),
        ("end", "d_D#", line.start + pair.base_pitch, ("d_Nf", "d_Na"), "+-"),
    ):
        tangents = place, line.line_length - pair.sign * place
        for gear, base in enumerate(bases, 1):
            # both flanks of a ring's pair go outwards together
            sign = signs[gear - 1 if pair.sign > 0 else 0]
            formula = f"2 * sqrt({{r_b#}}**2 + (sqrt({{{ends[gear - 1]}#}}**2 / 4 - {{r_b#}}**2) {sign} {step})**2)"
            radius = math.hypot(base, tangents[gear - 1])
            page.add(f"single_contact_{name}_diameter", 2 * radius, formula, _ISO, gear)
            _angle(page, f"roll_angle_at_single_contact_{name}_deg", radius, base, (point, "(2 * {r_b#})"), gear)
