"""The ten assignments on lever mechanisms of the guidelines on coursework, section 3.2, as keys of ``calc lever``.

The figures of the guidelines are lost. Assignment 1 is fixed by its worked example; how the others stand is the usual
scheme of the machine, told as an assumption, and every key of it may be given otherwise.
"""

from __future__ import annotations

from functools import cache

from geometry.base.errors import Nearest, ParameterError
from parts.base.texts import N_

# by number: the machine, what the columns behind phi_0 (deg) and omega_1 (1/s) are, ten variants
ASSIGNMENTS: dict[int, tuple[str, str, str]] = {
    1: (N_("screen"), "AO1_m O1O3/AO1 BO3/AO1 CO3/BO3 CD/CO3", """
    20 30 0.18 1.9 3.6 0.31 3
    40 60 0.27 2.2 3.7 0.26 3.2
    60 40 0.19 1.8 3.5 0.25 3.8
    80 70 0.26 2.4 3.8 0.27 3.5
    100 80 0.25 2.1 3.9 0.28 3.6
    120 70 0.24 2.5 3 0.29 4
    160 50 0.3 2 3.6 0.25 2.8
    180 60 0.23 2.2 3.9 0.3 2.5
    200 50 0.21 2.3 3.8 0.24 3.1
    240 40 0.2 2.6 3.7 0.23 3.3
    """),
    2: (N_("shaping machine"), "AO1_m O1O3/AO1 BO3/AO1 e/BO3 BC/BO3", """
    10 18 0.18 2.5 4.6 1.05 0.2
    30 14 0.16 2.3 4.8 0.91 0.35
    50 20 0.11 2.2 4.7 0.94 0.3
    70 12 0.19 2.6 4.5 1.04 0.3
    110 21 0.13 2 4.9 0.92 0.3
    130 13 0.14 2.1 5 0.93 0.35
    170 16 0.12 2.1 4.8 0.93 0.35
    190 22 0.15 2.2 4.9 0.9 0.3
    250 24 0.1 2.3 4.6 1.06 0.25
    290 25 0.17 2.4 4.7 0.92 0.3
    """),
    3: (N_("slotting machine"), "AO1_m O1O3/AO1 BO3/AO1 e/BO3 BC/BO3 DO3/AO1", """
    10 18 0.1 3.5 2 0.9 0.35 5
    40 8 0.14 3.9 2.4 0.94 0.31 5
    70 15 0.08 3.2 1.7 0.93 0.32 5
    100 17 0.11 3.4 1.9 0.91 0.34 5
    130 14 0.07 3 1.5 0.95 0.3 5
    160 16 0.12 3.6 2.1 0.91 0.34 5
    190 20 0.09 3.3 1.8 0.92 0.33 5
    220 10 0.08 3.7 2.2 0.92 0.33 5
    250 11 0.1 3.1 1.6 0.94 0.31 5
    280 9 0.15 3.8 2.3 0.93 0.32 5
    """),
    4: (N_("swinging conveyor"), "AO1_m AB/AO1 BO3/AO1 O1O3/AO1 CD/CO3 CO3/BO3", """
    20 14 0.14 2.7 2.1 2.6 3 1
    50 6 0.2 3.5 2.9 2.5 3.2 1
    80 16 0.13 2.8 2.2 2.7 4 1
    110 9 0.18 3.3 2.7 2.7 3.5 1
    140 18 0.12 2.9 2.3 2.8 3 1
    170 7 0.19 3.4 2.8 2.6 4 1
    200 11 0.16 3.1 2.5 2.9 2.5 1
    230 12 0.15 2.6 2 2.5 3 1
    260 8 0.17 3.2 2.6 2.8 3.8 1
    290 10 0.11 3 2.4 2.9 4 1
    """),
    5: (N_("swinging conveyor"), "AO1_m AB/AO1 BO3/AO1 O1O3/AO1 CB/BO3", """
    30 11 0.13 3.4 2.1 2.6 3
    70 10 0.14 3.5 2.3 2.5 2.5
    110 14 0.1 3.1 2 2.7 3
    150 18 0.06 2.7 2 2.3 3.5
    190 17 0.07 2.8 2.1 2.4 4
    210 16 0.08 2.9 2.2 2.5 3
    250 8 0.15 3.3 2.1 2.4 4
    290 15 0.09 3 2.1 2.6 2.5
    330 13 0.11 3.2 2.1 2.8 3
    360 12 0.12 3.3 2.2 2.7 4
    """),
    6: (N_("swinging conveyor"), "AO1_m AB/AO1 BO3/AO1 O1O3/AO1 CD/CO3 CO3/BO3", """
    45 17 0.1 3 2.3 2.2 3 1.2
    25 18 0.06 2.9 2.3 2.2 3.2 1.2
    65 19 0.09 2.9 2.1 2.3 4 1.2
    95 20 0.08 2.8 2 2.2 3.5 1.2
    125 21 0.07 2.8 2.1 2.3 2.8 1.2
    155 14 0.09 3.2 2.3 2.3 3.4 1.2
    185 15 0.12 3.2 2 2.5 3 1.2
    215 16 0.08 3.1 2.4 2.2 2.5 1.2
    245 12 0.11 3.1 2.1 2.3 4 1.2
    275 10 0.07 3 2.1 2.3 3 1.2
    """),
    7: (N_("swinging conveyor"), "AO1_m AB/AO1 BO3/AO1 O1O3/AO1 CD/CO3", """
    40 23 0.06 2.8 1.8 2.7 6
    70 20 0.09 3.1 2 2.6 5.5
    100 21 0.08 3 2 2.7 6
    130 16 0.13 3.4 2.2 2.6 5.5
    160 22 0.07 2.9 1.9 2.6 5.5
    190 17 0.12 3.4 2.1 2.7 6
    220 24 0.05 2.7 1.7 2.6 5.5
    250 18 0.11 3.3 2.1 2.6 5.5
    280 19 0.1 3.2 2.1 2.7 6
    310 15 0.14 3.3 2.2 2.7 6
    """),
    8: (N_("compressor"), "AO1_m AB/AO1 AS2/AB", """
    15 150 0.07 3 0.34
    45 140 0.08 2.9 0.35
    65 180 0.08 3.5 0.35
    135 160 0.12 2.8 0.34
    175 210 0.05 3.4 0.34
    215 190 0.06 3.3 0.33
    255 130 0.1 2.6 0.32
    295 200 0.06 3.2 0.32
    335 160 0.07 3.1 0.33
    355 120 0.09 2.7 0.33
    """),
    9: (N_("compressor"), "AO1_m AB/AO1 AS2/AB", """
    45 115 0.09 3.5 0.3
    25 125 0.08 3.4 0.31
    65 130 0.06 3.2 0.33
    95 110 0.1 3.4 0.29
    125 100 0.11 3.1 0.34
    155 95 0.12 3 0.35
    185 105 0.1 3.3 0.28
    215 110 0.11 3.4 0.27
    245 120 0.09 3.5 0.26
    275 135 0.07 3.3 0.32
    """),
    10: (N_("knotter"), "AO1_m O1O3/AO1 BO3/AO1 CO3/AO1 DO5/CO3 CD/CO3_=_O3O5/CO3", """
    20 90 0.14 2.7 5 4.4 0.68 1
    40 70 0.12 2.5 4.8 4.8 0.74 1
    80 100 0.18 2.5 4.6 3.8 0.6 1
    100 80 0.13 2.6 4.9 4.6 0.76 1
    140 120 0.16 2.3 4.8 4.1 0.65 1
    160 110 0.17 2.4 4.7 4 0.66 1
    200 95 0.15 2.2 4.9 4.2 0.8 1
    220 62 0.1 2.3 4.6 5 0.7 1
    260 140 0.19 2.6 4.5 3.6 0.64 1
    280 65 0.11 2.4 4.7 5.2 0.72 1
    """),
}  # fmt: skip
# what the assumed schemes have beside the columns: where O3 lies as seen from O1, how the links join
_SCHEMES: dict[int, dict[str, str | float]] = {
    1: {"first": "stone", "frame_angle_deg": 180.0, "arm_angle_deg": -90.0, "second": "slider"},
    2: {"first": "stone", "frame_angle_deg": 270.0, "arm_angle_deg": 0.0, "second": "slider"},
    3: {"first": "stone", "frame_angle_deg": 270.0, "arm_angle_deg": 180.0, "second": "slider"},
    4: {"first": "rods", "frame_angle_deg": 0.0, "arm_angle_deg": 0.0, "second": "slider"},
    5: {"first": "rods", "frame_angle_deg": 0.0, "arm_angle_deg": 0.0, "second": "slider"},
    6: {"first": "rods", "frame_angle_deg": 0.0, "arm_angle_deg": 0.0, "second": "slider"},
    7: {"first": "rods", "frame_angle_deg": 0.0, "arm_angle_deg": 0.0, "second": "slider"},
    8: {"first": "slider", "second": "none"},
    9: {"first": "slider", "second": "none"},
    10: {"first": "stone", "frame_angle_deg": 270.0, "arm_angle_deg": 0.0, "second": "rocker"},
}
# plans of the worked example: record-book number 10-71, drawn crank 30 mm, 0.1 (m/s)/mm, 3 (m/s2)/mm
EXAMPLE = {"code": "1071", "drawn_crank": 30.0, "velocity_scale": 0.1, "acceleration_scale": 3.0}


@cache
def _rows(assignment: int) -> tuple[tuple[float, ...], ...]:
    lines = ASSIGNMENTS[assignment][2].strip().splitlines()
    return tuple(tuple(map(float, line.split())) for line in lines)


def rows_of_code(code: str) -> tuple[int, tuple[int, int, int]]:
    """Assignment and the variants of the columns a, b, v by the last four digits of a record-book number.

    Raises
    ------
    ParameterError
        They are no four digits.
    """
    digits = code.replace("-", "")
    if len(digits) != 4 or not (digits.isascii() and digits.isdigit()):
        raise ParameterError("code", code, "not_four_digits")
    first, second, third, last = (int(d) or 10 for d in digits)
    return last, (first, second, third)


def assigned(assignment: int, variants: tuple[int, int, int]) -> dict[str, float | str]:
    """The keys of an assignment: phi_0, omega_1 and the lengths, each by the variant of its columns.

    Raises
    ------
    ParameterError
        There is no such assignment or variant.
    """
    if assignment not in ASSIGNMENTS:
        raise ParameterError("assignment", assignment, "not_among_ten", Nearest(min(max(assignment, 1), 10)))
    for variant in variants:
        if not 1 <= variant <= 10:
            raise ParameterError("variant", variant, "not_among_ten", Nearest(min(max(variant, 1), 10)))
    rows = _rows(assignment)
    angle, speed = rows[variants[0] - 1][0], rows[variants[1] - 1][1]
    numbers = dict(zip(ASSIGNMENTS[assignment][1].split(), rows[variants[2] - 1][2:], strict=True))
    crank = round(numbers["AO1_m"] * 1000, 6)
    keys: dict[str, float | str] = {"start_angle_deg": angle, "speed": speed, "crank_length": crank}
    keys |= _SCHEMES[assignment]

    def length(column: str, of: float) -> float:
        return round(numbers[column] * of, 6)

    if keys["first"] == "slider":
        return keys | {"coupler_length": length("AB/AO1", crank), "mass_point": numbers["AS2/AB"]}
    lever = length("BO3/AO1", crank)
    keys |= {"frame_length": length("O1O3/AO1", crank), "lever_length": lever}
    if keys["first"] == "rods":
        keys["coupler_length"] = length("AB/AO1", crank)
    arm = lever
    if "CO3/BO3" in numbers:
        arm = length("CO3/BO3", lever)
    elif "CO3/AO1" in numbers:
        arm = length("CO3/AO1", crank)
    keys["arm_length"] = arm
    for column, of in (("CD/CO3", arm), ("BC/BO3", lever), ("CB/BO3", lever), ("CD/CO3_=_O3O5/CO3", arm)):
        if column in numbers:
            keys["rod_length"] = length(column, of)
    if "e/BO3" in numbers:
        # on the side of the axis on which B is
        keys["guide_height"] = length("e/BO3", lever) * (-1 if "DO3/AO1" in numbers else 1)
    if "DO3/AO1" in numbers:
        # the slotted lever reaches beyond O3 to D, its short arm to B
        keys["lever_length"] = length("DO3/AO1", crank)
    if "DO5/CO3" in numbers:
        keys |= {"rocker_length": length("DO5/CO3", arm), "pivot_distance": keys["rod_length"], "pivot_angle_deg": 30.0}
    return keys
