"""The ten assignments on lever mechanisms of the guidelines on coursework, section 3.2, as keys of ``calc lever``.

The figures of the guidelines are lost. Assignment 1 is fixed by its worked example; how the others stand is the usual
scheme of the machine, told as an assumption, and every key of it may be given otherwise.
"""

from __future__ import annotations

from functools import cache

from geometry.base.errors import Nearest, ParameterError
from parts.base.psv import rows_of
from parts.base.refusal import REMOVED

MACHINES: dict[int, str] = {}
# what the assumed schemes have beside the columns: where O3 lies as seen from O1, how the links join
_SCHEMES: dict[int, dict[str, str | float]] = {}
for _number, _machine, _first, _second, *_angles in rows_of(__file__, "lever_schemes"):
    MACHINES[int(_number)] = _machine
    _told = zip(("frame_angle_deg", "arm_angle_deg"), _angles, strict=True)
    _SCHEMES[int(_number)] = {"first": _first, "second": _second} | {key: float(angle) for key, angle in _told if angle}
# plans of the worked example: record-book number 10-71, drawn crank 30 mm, 0.1 (m/s)/mm, 3 (m/s2)/mm
EXAMPLE: dict[str, float | str] = {
    "code": "1071",
    "drawn_crank": 30.0,
    "velocity_scale": 0.1,
    "acceleration_scale": 3.0,
}


@cache
def _columns(assignment: int) -> tuple[list[str], list[list[float]]]:
    """What its columns are, phi_0 (deg) and omega_1 (1/s) first, and its ten variants."""
    heads, *rows = (cells for number, *cells in rows_of(__file__, "lever_tasks") if number == str(assignment))
    return heads, [[*map(float, row)] for row in rows]


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


def chosen(
    code: int | str | None, assignment: int | None, variant: int | None
) -> tuple[dict[str, float | str], int | None, tuple[int, ...]]:
    """The keys that a code, or an assignment and its row, stand for, the number of the assignment, and its rows.

    Raises
    ------
    ParameterError
        Both are given, or a row of none, or there is no such one.
    """
    if code is not None:
        for name, value in (("assignment", assignment), ("variant", variant)):
            if value is not None:
                raise ParameterError(name, value, "other_is_given", REMOVED, other="code")
        number, rows = rows_of_code(str(code))
        return assigned(number, rows), number, rows
    if assignment is None:
        if variant is not None:
            raise ParameterError("variant", variant, "needs_other", REMOVED, other="assignment")
        return {}, None, ()
    row = 1 if variant is None else variant
    return assigned(assignment, (row, row, row)), assignment, (row,)


def assigned(assignment: int, variants: tuple[int, int, int]) -> dict[str, float | str]:
    """The keys of an assignment: phi_0, omega_1 and the lengths, each by the variant of its columns.

    Raises
    ------
    ParameterError
        There is no such assignment or variant.
    """
    if assignment not in MACHINES:
        raise ParameterError("assignment", assignment, "not_among_ten", Nearest(min(max(assignment, 1), 10)))
    for variant in variants:
        if not 1 <= variant <= 10:
            raise ParameterError("variant", variant, "not_among_ten", Nearest(min(max(variant, 1), 10)))
    heads, rows = _columns(assignment)
    angle, speed = rows[variants[0] - 1][0], rows[variants[1] - 1][1]
    numbers = dict(zip(heads[2:], rows[variants[2] - 1][2:], strict=True))
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
