"""Where the sources misprint: the printed number of a case, beside which the right one is shown.

Numbers of the practicum on higher pairs (Melitopol 2023) and of the guidelines on coursework (table 2.1), recomputed
at 40 digits.
"""

from __future__ import annotations

from collections.abc import Mapping

from exporters.calculations.sheet import Printed

_COSINE = ("the cosine of 27°55' was read: 0.8836 for 0.8915", "взято косинус 27°55': 0,8836 замість 0,8915")
_FOLLOWS = ("follows from the wrong centre distance", "наслідок хибної міжосьової відстані")
_ROUNDED = ("cut off with pi = 3.14 and tan 20° = 0.364", "обрізано при π = 3,14 і tg 20° = 0,364")

# lesson 3, section 3.1: z 13/21, m 10, x 0.694/0.384
_PRACTICUM: dict[tuple[str, int], Printed] = {
    ("involute_of_working_pressure_angle", 0): Printed(
        "0.037985", "the last digit is cut off", "остання цифра обрізана"
    ),
    ("working_pressure_angle_deg", 0): Printed(
        "26°55' (26.92°)", "26°56.0': inv 26°55' = 0.037910", "26°56,0': inv 26°55' = 0,037910"
    ),
    ("working_centre_distance", 0): Printed("180.79", *_COSINE),
    ("working_radius", 1): Printed("69.14", *_FOLLOWS),
    ("working_radius", 2): Printed("111.65", *_FOLLOWS),
    ("base_radius", 1): Printed("61.06", "65 cos 20° = 61.08", "65·cos 20° = 61,08"),
    ("pitch", 0): Printed("14.13", "fig. 3.9: 3.14 * 4.5 of another variant", "рис. 3.9: 3,14·4,5 з іншого варіанта"),
    ("reference_thickness", 1): Printed("20.75", *_ROUNDED),
    ("reference_thickness", 2): Printed("18.49", *_ROUNDED),
    ("tip_pressure_angle_deg", 1): Printed("40.53°", "from r_b1 = 61.06", "від r_b1 = 61,06"),
    ("contact_ratio", 0): Printed(
        "1.14", "the printed angles themselves give 1.1668", "самі надруковані кути дають 1,1668"
    ),
    ("cosine_of_working_pressure_angle", 0): Printed("0.8836", "that is cos 27°55'", "це cos 27°55'"),
    ("measured_difference_percent", 0): Printed(
        "0.2 %", "(1.14 - 1.137)/1.14 = 0.26 %", "його ж (1,14 - 1,137)/1,14 = 0,26 %"
    ),
}
# guidelines, table 2.1: printed alpha_w that its own shifts do not give, and why
_GUIDELINES = {
    (9, 11): ("30.28°", "x2 = 0.543 would give it", "його дало б x2 = 0,543"),
    (9, 12): ("30.23°", "x2 = 0.580 would give it", "його дало б x2 = 0,580"),
    (10, 11): ("29.79°", "shifts rounded to 0.001", "зміщення округлено до 0,001"),
    (10, 12): ("29.51°", "x2 = 0.532 gives it: one wrong digit", "його дає x2 = 0,532: одна хибна цифра"),
    (11, 11): ("29.23°", "shifts rounded to 0.001", "зміщення округлено до 0,001"),
    (11, 12): ("28.99°", "x2 = 0.518 would give it", "його дало б x2 = 0,518"),
}
_GUIDELINE_SHIFTS = {
    (9, 11): (0.570, 0.546),
    (9, 12): (0.580, 0.561),
    (10, 11): (0.549, 0.535),
    (10, 12): (0.558, 0.522),
    (11, 11): (0.522, 0.522),
    (11, 12): (0.531, 0.516),
}


def printed_for_pair(
    teeth: tuple[int, int], shifts: tuple[float, float], module: float
) -> Mapping[tuple[str, int], Printed]:
    """What a source prints wrongly for exactly this pair; empty for any other."""
    if (teeth, shifts, module) == ((13, 21), (0.694, 0.384), 10.0):
        return _PRACTICUM
    if _GUIDELINE_SHIFTS.get(teeth) == shifts:
        return {("working_pressure_angle_deg", 0): Printed(*_GUIDELINES[teeth])}
    return {}


# thesis, section 2.3: z 96/144, m 3
_THESIS: dict[tuple[str, int], Printed] = {
    ("contact_ratio", 0): Printed(
        "1.87", "an approximate formula's; the tip circles give less", "за наближеною формулою; кола вершин дають менше"
    ),
    ("pitch", 0): Printed("9.42", "cut off with pi = 3.14", "обрізано при π = 3,14"),
}


def printed_for_internal(teeth: tuple[int, int], module: float) -> Mapping[tuple[str, int], Printed]:
    """What the thesis prints wrongly for its internal pair; empty for any other."""
    return _THESIS if (teeth, module) == ((96, 144), 3.0) else {}


_INFINITE = (
    "multiplied by the relative turning: divided by it F and R are infinite where both links turn alike",
    "помножено на відносну кутову швидкість: поділені на неї F і R нескінченні, де обидві ланки обертаються однаково",
)
# Savvin's synthesis of plane cams: misprints by the number of the equation, each follows from the others
SAVVIN: dict[str, Printed] = {
    "12": Printed("1/(ω_2-ω_1)·[A'·sin(α_2-α_1) - B'·cos(α_2-α_1)]", *_INFINITE),
    "13": Printed("1/(ω_2-ω_1)·[A'·cos(α_2-α_1) + B'·sin(α_2-α_1)]", *_INFINITE),
    "19": Printed(
        "one sign of the root",
        "both sides of the circle satisfy (11); with F, R times the relative turning the minus is the cam's",
        "(11) справджують обидва боки кола; мінус перед F, R, помноженими на відносну швидкість, дає бік кулачка",
    ),
    "21": Printed(
        "F·cos(α_2-α_1) + R·sin(α_2-α_1)",
        "(4) gives the minus; the printed point leaves the circle of the roller",
        "(4) дає мінус; надрукована точка не лежить на колі ролика",
    ),
    "27": Printed("γ_2 = γ_11 + α_1", "this is gamma_1, as (28) has it", "це γ_1, як у формулі (28)"),
    "28": Printed(
        "arctg(-ξ_21'/r_21) + α_1 - arctg(y_A2'/x_A2)",
        "eta_21' and x_A2' by (25), (26); two arctangents lose quadrants, so the acute angle is taken",
        "за (25), (26) має бути η_21' і x_A2'; два арктангенси гублять чверті, тому взято гострий кут",
    ),
}
