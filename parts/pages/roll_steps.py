"""Steps of what an inspector of involutes sets: roll angles and lengths of a flank, of one gear, a pair, on a rack."""

from __future__ import annotations

import math

from geometry.base.angles import tangent_length
from geometry.gears.pairs.external import ExternalPair
from geometry.gears.pairs.internal import InternalPair
from geometry.gears.pairs.rack import RackPair
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


def _single_contact(
    page: Sheet, name: str, radius: float, base: float, symbols: tuple[str, str, str], gear: int
) -> None:
    """Where one pair alone begins or ends to be in contact; ``symbols``: a base pitch from where, which way, itself."""
    end, sign, point = symbols
    step = "2 * pi * {r_b1} / {z1}"
    formula = f"2 * sqrt({{r_b#}}**2 + (sqrt({{{end}#}}**2 / 4 - {{r_b#}}**2) {sign} {step})**2)"
    page.add(f"single_contact_{name}_diameter", 2 * radius, formula, _ISO, gear)
    _angle(page, f"roll_angle_at_single_contact_{name}_deg", radius, base, (point, "(2 * {r_b#})"), gear)


def _pitch_point(page: Sheet, alpha: float) -> None:
    page.add("roll_angle_at_pitch_point_deg", math.degrees(math.tan(alpha)), "tan({alpha_w})", _ISO)


def rack_rolls(page: Sheet, pair: RackPair) -> None:
    """What ``pair_rolls`` tells, of a gear on a rack."""
    base, (low, high) = pair.gear.base_radius, pair.active_line
    forms = pair.sides[0].flank_radii(relief=True)
    rows = (
        ("root_form", "root_form", "d_Ff", forms[0]),
        ("start", "start_of_active_profile", "d_Nf", math.hypot(base, low)),
        ("end", "active_tip", "d_Na", math.hypot(base, high)),
        ("tip_form", "tip_form", "d_Fa", forms[1]),
    )
    page.section(N_("Roll angles"))
    for name, diameter, key, radius in rows:
        page.add(f"{diameter}_diameter", 2 * radius, "", _ISO, 1)
        _angle(page, f"roll_angle_at_{name}_deg", radius, base, (f"{key}#", "(2 * {r_b#})"), 1)
    _pitch_point(page, pair.rack.rack.pressure_angle)
    if pair.base_pitch < high - low < 2 * pair.base_pitch:
        inner, outer = math.hypot(base, high - pair.base_pitch), math.hypot(base, low + pair.base_pitch)
        _single_contact(page, "start", inner, base, ("d_Na", "-", "d_B#"), 1)
        _single_contact(page, "end", outer, base, ("d_Nf", "+", "d_D#"), 1)


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
    _pitch_point(page, pair.working_pressure_angle)
    if not pair.base_pitch < line.length < 2 * pair.base_pitch:
        return
    for name, point, place, ends, signs in (
        ("start", "d_B#", line.end - pair.base_pitch, ("d_Na", "d_Nf"), "-+"),
        ("end", "d_D#", line.start + pair.base_pitch, ("d_Nf", "d_Na"), "+-"),
    ):
        tangents = place, line.line_length - pair.sign * place
        for gear, base in enumerate(bases, 1):
            # both flanks of a ring's pair go outwards together
            sign = signs[gear - 1 if pair.sign > 0 else 0]
            radius = math.hypot(base, tangents[gear - 1])
            _single_contact(page, name, radius, base, (ends[gear - 1], sign, point), gear)
