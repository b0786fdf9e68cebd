"""Where the sources misprint: the printed number of a case, beside which the right one is shown.

Numbers of the practicum on higher pairs (Melitopol 2023) and of the guidelines on coursework (table 2.1), recomputed
at 40 digits.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from parts.base.psv import rows_of
from parts.base.texts import N_, Message, message
from parts.pages.page import Misprints, Printed

if TYPE_CHECKING:
    from geometry.gears.worms.worm import Worm

# by the name of the case, which its numbers end
CASES: dict[str, Misprints] = {}
for _case, _step, _gear, _text, _why in rows_of(__file__, "misprints"):
    CASES.setdefault(_case, {})[(_step, int(_gear)) if _gear else _step] = Printed(_text, _why)
# the pressure angle of all pairs, and how near to it another one is, rad
_USUAL, _SAME = math.radians(20), 1e-12
# torque on either worm of the thesis, N*m
_T_1 = 3.5


def printed_for(case: str) -> Misprints:
    """What a source prints wrongly of a case of the table; empty for any other."""
    return dict(CASES.get(case, {}))


def printed_for_pair(
    teeth: tuple[int, int], shifts: tuple[float, float], module: float, pressure_angle: float, *, internal: bool = False
) -> Misprints:
    """What a source prints wrongly for exactly this pair, angle in rad; empty for any other."""
    if abs(pressure_angle - _USUAL) > _SAME:
        return {}
    pair = "{}/{} {}/{}".format(*teeth, *shifts)
    if internal:
        return printed_for(f"thesis {pair} {module}")
    return printed_for(f"practicum {pair} {module}") or printed_for(f"guidelines {pair}")


def printed_for_worm(worm: Worm, teeth: int, shift: float, worm_torque: float | None) -> Misprints:
    """What the thesis prints wrongly for its two worm drives, numbers at its own torque, N*m; empty for any other."""
    same = (worm.module, worm.diameter_quotient, worm.number_of_starts, shift) == (5.0, 10.0, 1, 0.0)
    own = printed_for(f"worm {teeth}") if same else {}
    loaded = math.isclose(worm_torque or _T_1, _T_1)
    return own and (own if loaded else {}) | printed_for("worm")


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


# Savvin's synthesis of plane cams, by the number of the equation
SAVVIN = printed_for("Savvin")


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


# practicum, figures 4.12 and 5.9: H, the phases and E of its cams
_CAMS = {"flat": [38.0, 120.0, 30.0, 120.0, 90.0, 2.0], "roller": [30.0, 130.0, 50.0, 130.0, 50.0, 3.0]}
_ANGLE = N_("the practicum, lesson 4, prints tan ϑ = (V_qB ∓ e)/√(r_0² - e² + s_B): s_B stands behind the root")
_OF_LESSON = {
    "flat": N_("the practicum's γ_min = 45° of a flat follower is the slope of the tangent in the joint diagram: r_0 + "
               "S + S'' ≥ 0; the pressure angle of the face is 0"),
    "roller": N_("the practicum, lesson 5, 3.1 to 3.3, speaks of a flat follower's planes and of R_min = r_0 + ρ, as "
                 "lesson 4: of a roller circles touch the profile, and R_min = r_0 - r"),
}  # fmt: skip


def printed_for_cam(kind: str, sizes: list[float]) -> list[Message]:
    """What lessons 4 and 5 print wrongly, a remark each, of their own cams; empty for any other cam."""
    return [message(text) for text in (_ANGLE, _OF_LESSON[kind])] if _CAMS.get(kind) == sizes else []


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
