"""Where the sources misprint: the printed number of a case, beside which the right one is shown.

Numbers of the practicum on higher pairs (Melitopol 2023) and of the guidelines on coursework (table 2.1), recomputed
at 40 digits.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from parts.base.texts import N_, Message, message
from parts.pages.page import Misprints, Printed

if TYPE_CHECKING:
    from geometry.gears.worms.worm import Worm

_COSINE = N_("the cosine of 27°55' was read: 0.8836 for 0.8915")
_FOLLOWS = N_("follows from the wrong centre distance")
_ROUNDED = N_("cut off with pi = 3.14 and tan 20° = 0.364")

# lesson 3, section 3.1: z 13/21, m 10, x 0.694/0.384
_PRACTICUM: Misprints = {
    ("involute_of_working_pressure_angle", 0): Printed("0.037985", N_("the last digit is cut off")),
    ("working_pressure_angle_deg", 0): Printed("26°55' (26.92°)", N_("26°56.0': inv 26°55' = 0.037910")),
    ("working_centre_distance", 0): Printed("180.79", _COSINE),
    ("working_radius", 1): Printed("69.14", _FOLLOWS),
    ("working_radius", 2): Printed("111.65", _FOLLOWS),
    ("base_radius", 1): Printed("61.06", N_("65 cos 20° = 61.08")),
    ("pitch", 0): Printed("14.13", N_("fig. 3.9: 3.14 * 4.5 of another variant")),
    ("reference_thickness", 1): Printed("20.75", _ROUNDED),
    ("reference_thickness", 2): Printed("18.49", _ROUNDED),
    ("tip_pressure_angle_deg", 1): Printed("40.53°", N_("from r_b1 = 61.06")),
    ("contact_ratio", 0): Printed("1.14", N_("the printed angles themselves give 1.1668")),
    ("cosine_of_working_pressure_angle", 0): Printed("0.8836", N_("that is cos 27°55'")),
    ("measured_difference_percent", 0): Printed("0.2 %", N_("(1.14 - 1.137)/1.14 = 0.26 %")),
}
# the pressure angle of all of them, and how near to it another one is, rad
_USUAL, _SAME = math.radians(20), 1e-12
# guidelines, table 2.1, by its teeth and shifts: printed alpha_w that the shifts do not give, and why
_GUIDELINES: Mapping[tuple[tuple[int, int], tuple[float, float]], tuple[str, str]] = {
    ((9, 11), (0.570, 0.546)): ("30.28°", N_("x2 = 0.543 would give it")),
    ((9, 12), (0.580, 0.561)): ("30.23°", N_("x2 = 0.580 would give it")),
    ((10, 11), (0.549, 0.535)): ("29.79°", N_("shifts rounded to 0.001")),
    ((10, 12), (0.558, 0.522)): ("29.51°", N_("x2 = 0.532 gives it: one wrong digit")),
    ((11, 11), (0.522, 0.522)): ("29.23°", N_("shifts rounded to 0.001")),
    ((11, 12), (0.531, 0.516)): ("28.99°", N_("x2 = 0.518 would give it")),
}


def printed_for_pair(
    teeth: tuple[int, int], shifts: tuple[float, float], module: float, pressure_angle: float
) -> Misprints:
    """What a source prints wrongly for exactly this pair, angle in rad; empty for any other."""
    if abs(pressure_angle - _USUAL) > _SAME:
        return {}
    if (teeth, shifts, module) == ((13, 21), (0.694, 0.384), 10.0):
        return dict(_PRACTICUM)
    told = _GUIDELINES.get((teeth, shifts))
    return {("working_pressure_angle_deg", 0): Printed(*told)} if told else {}


# thesis, section 2.3: z 96/144, m 3
_THESIS: Misprints = {
    ("contact_ratio", 0): Printed("1.87", N_("an approximate formula's; the tip circles give less")),
    ("pitch", 0): Printed("9.42", N_("cut off with pi = 3.14")),
}


def printed_for_internal(teeth: tuple[int, int], module: float) -> Misprints:
    """What the thesis prints wrongly for its internal pair; empty for any other."""
    return dict(_THESIS) if (teeth, module) == ((96, 144), 3.0) else {}


# thesis, section 2.2: both worm drives m 5, q 10, one start, by the teeth of the wheel
_COSINE_LEFT_OUT = N_("the factor cos gamma of the formula was not used")
_WORMS: dict[int, Misprints] = {
    128: {
        ("thesis_least_module", 0): Printed("4.09", _COSINE_LEFT_OUT),
        ("thesis_contact_stress", 0): Printed("142.7", N_("its own numbers give 182.70 MPa, more than allowed")),
    },
    106: {
        ("thesis_least_module", 0): Printed("4.10", _COSINE_LEFT_OUT),
        ("thesis_contact_stress", 0): Printed("148.3", N_("its own numbers give 200.77 MPa, more than allowed")),
    },
}
_WORM_FORMULAS: Misprints = {
    ("contact_stress", 0): Printed(
        "2 · 170 …", N_("half the width raises the stress by the root of 2, not by 2; 26 of 45 mm are not one half")
    ),
    ("worm_pitch_diameter", 0): Printed("q (m + 2x)", N_("(q + 2x) m; the same at x = 0")),
    ("worm_radial_force", 0): Printed("51", N_("the radial force belongs to the large force, along the worm")),
    ("worm_form", 0): Printed("ZT", N_("a base diameter is printed, which only ZI has")),
}


def printed_for_worm(worm: Worm, teeth: int, shift: float) -> Misprints:
    """What the thesis prints wrongly for its two worm drives; empty for any other."""
    same = (worm.module, worm.diameter_quotient, worm.number_of_starts, shift) == (5.0, 10.0, 1, 0.0)
    return {**_WORMS[teeth], **_WORM_FORMULAS} if same and teeth in _WORMS else {}


# thesis, sections 2.3 and 2.4
_POWER_MODULE: Misprints = {
    ("pair_least_module", 0): Printed("2.43", N_("its own numbers give 2.40")),
    ("pair_allowed_contact", 0): Printed("665", N_("850/1.2·0.9405 = 666.19")),
    ("overlap_ratio", 0): Printed("π·m/sin β", N_("upside down and without the width: it divides by zero")),
    ("preload", 0): Printed("94", N_("140/1.5 = 93.33, rounded up")),
    ("thesis_worm_radial_force", 0): Printed(
        "51", N_("the radial force belongs to the large force along the worm: 1400·tan 20° = 510 N")
    ),
    ("turn_capacity", 0): Printed("1.06e6 N", N_("the unit is N/mm^(3/2)")),
    ("radial_stiffness", 0): Printed("5.5e4", N_("with i_2 = 1, where preload and axial stiffness have i_2 = 0")),
}


def printed_for_power_module() -> Misprints:
    """What the thesis misprints of its module."""
    return dict(_POWER_MODULE)


_QUADRANT = N_("arctg(x/y) and arcsin lose quadrants; atan2 (x, y) and the law of cosines do not")
_NO_ANGLE = N_("0/0, or an argument of arcsin beyond 1; the angle is kept at the centre")


def printed_for_delta(point: complex, arms: tuple[float, float], delta: float) -> Printed | None:
    """What the thesis's formula for delta (rad) gives where that is not the angle."""
    (one, two), far = arms, abs(point)
    try:
        sine = math.sqrt(4 * (one * two) ** 2 - (one**2 + two**2 - far**2) ** 2) / (2 * one * far)
        # y = 0 as the limit from above
        lean = math.atan(point.real / point.imag) if point.imag else math.copysign(math.pi / 2, point.real)
        found = lean - math.asin(sine)
    except (ValueError, ZeroDivisionError):
        return Printed("arctg (x/y) - arcsin √…", _NO_ANGLE)
    off = abs(math.remainder(found - delta, 2 * math.pi))
    return Printed(f"{math.degrees(found):.4f}°", _QUADRANT) if off > 1e-6 else None


_INFINITE = N_("multiplied by the relative turning: divided by it F and R are infinite where both links turn alike")
# Savvin's synthesis of plane cams: misprints by the number of the equation, each follows from the others
SAVVIN: dict[str, Printed] = {
    "12": Printed("1/(ω_2-ω_1)·[A'·sin(α_2-α_1) - B'·cos(α_2-α_1)]", _INFINITE),
    "13": Printed("1/(ω_2-ω_1)·[A'·cos(α_2-α_1) + B'·sin(α_2-α_1)]", _INFINITE),
    "19": Printed(
        "one sign of the root",
        N_("both sides of the circle satisfy (11); with F, R times the relative turning the minus is the cam's"),
    ),
    "21": Printed(
        "F·cos(α_2-α_1) + R·sin(α_2-α_1)", N_("(4) gives the minus; the printed point leaves the circle of the roller")
    ),
    "27": Printed("γ_2 = γ_11 + α_1", N_("this is gamma_1, as (28) has it")),
    "28": Printed(
        "arctg(-ξ_21'/r_21) + α_1 - arctg(y_A2'/x_A2)",
        N_("eta_21' and x_A2' by (25), (26); two arctangents lose quadrants, so the acute angle is taken"),
    ),
}


# guidelines, table 2.2: H 32, rise of 90 degrees by linearly decreasing acceleration, flat follower
_TABLE_2_2 = (
    ("2/8", "S", "5.012", "5.000"),
    ("5/8", "S + S''", "2.43", "2.42"),
    ("7/8", "S + S''", "-27.73", "-27.74"),
)


def printed_for_rise(law: str, lift: float, angle_deg: float) -> list[Message]:
    """What table 2.2 of the guidelines prints wrongly, a remark each; empty for any other rise."""
    if (law, lift, angle_deg) != ("linearly decreasing acceleration", 32.0, 90.0):
        return []
    text = N_("the guidelines' table 2.2 prints {quantity} = {printed} at k = {place} of the rise: right is {right}")
    rows = (dict(zip(("place", "quantity", "printed", "right"), row, strict=True)) for row in _TABLE_2_2)
    return [message(text, **row) for row in rows]


# practicum, tables Д.1 and Е.1: degree and minute, what is printed, what is right
_TABLES = (
    ("Д.1", 29, 50, "0.0529", "0.0528"),
    ("Д.1", 32, 50, "0.0732", "0.0722"),
    ("Д.1", 35, 0, "0.0393", "0.0893"),
    ("Е.1", 26, 20, "0.886", "0.896"),
)
# of the other cells, the rows that have one whose last digit is cut off
_CUT = {21, 22, 23, 24, 26, 30, 31, 35, 37, 40}


def printed_in_tables(first: int, last: int) -> list[Message]:
    """What the practicum's tables of inv and cos print wrongly from one row to another, degrees; a remark each."""
    text = N_("the practicum's table {table} prints {printed} at {place}: right is {right}")
    remarks = [
        message(text, table=table, printed=printed, place=f"{row}°{minute}'", right=right)
        for table, row, minute, printed, right in _TABLES
        if first <= row <= last
    ]
    if any(first <= row <= last for row in _CUT):
        remarks.append(message("the practicum cuts the last digit of some cells off, which is rounded here"))
    return remarks


_EXAMPLE_1 = N_("coaxial only with two internal meshes, so both signs are plus; the product is the same")
_EXAMPLE_3 = N_("the sun meshes the satellite outside, the satellite the ring inside; the product is the same")
_LOST_SIGN = N_("the sign is lost: 120/(-0.8) = -150")
# lesson 2 of the practicum and the guide on trains, by the numbers of teeth: what is misprinted, by its symbol
_TRAINS: dict[tuple[int, ...], Misprints] = {
    (88, 48, 4, 44, 25, 17, 100): {"u_14^H": Printed("(-48/88)·(-44/4)", _EXAMPLE_1)},
    (13, 52, 15, 33, 11, 45): {
        "u_36^H": Printed("6", N_("(33/15)·(45/11) = 9; the 6 is that of example 1")),
        "u_1H": Printed("20", N_("-4·(1 - 9) = 32")),
    },
    (25, 100, 20, 30, 80): {"u_35^H": Printed("(30/20)·(-80/30)", _EXAMPLE_3)},
    (40, 30, 20, 60): {
        "u_13^H": Printed("9/5", N_("30·60/(40·20) = 9/4; 9/5 is that of z_1 = 50, which is coaxial")),
        "u_1H^3": Printed("-0.8", N_("that of z_1 = 50, which is coaxial")),
        "ω_H": Printed("150", _LOST_SIGN),
        "ω_2": Printed("600", _LOST_SIGN),
    },
    (50, 30, 20, 60): {"ω_H": Printed("150", _LOST_SIGN), "ω_2": Printed("600", _LOST_SIGN)},
    (40, 20, 120): {"ω_2": Printed("-150", N_("follows from z_2 = 20, which does not reach the ring; 40 gives -60"))},
}


def printed_for_train(teeth: tuple[int, ...]) -> Misprints:
    """What the sources print wrongly for a train of these teeth, in their order; empty for any other."""
    return dict(_TRAINS.get(teeth, {}))
