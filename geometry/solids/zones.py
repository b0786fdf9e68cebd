"""Limits of a size by its tolerance zone: ISO 286-1 and GOST 25346, those that splines have; table 1 and 2."""

from __future__ import annotations

from bisect import bisect_left
from string import digits

# sizes up to, mm; of tolerance grades and of most deviations
_STEPS = (3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500, 630, 800, 1000)
# of grade 6 on, um, up to 500 mm
_GRADES = (
    (6, 8, 9, 11, 13, 16, 19, 22, 25, 29, 32, 36, 40),
    (10, 12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57, 63),
    (14, 18, 22, 27, 33, 39, 46, 54, 63, 72, 81, 89, 97),
    (25, 30, 36, 43, 52, 62, 74, 87, 100, 115, 130, 140, 155),
    (40, 48, 58, 70, 84, 100, 120, 140, 160, 185, 210, 230, 250),
    (60, 75, 90, 110, 130, 160, 190, 220, 250, 290, 320, 360, 400),
    (100, 120, 150, 180, 210, 250, 300, 350, 400, 460, 520, 570, 630),
)
GRADES = range(6, 6 + len(_GRADES))
# -es of shafts, EI of holes, um
_DEVIATIONS = {
    "d": (20, 30, 40, 50, 65, 80, 100, 120, 145, 170, 190, 210, 230, 260, 290, 320),
    "e": (14, 20, 25, 32, 40, 50, 60, 72, 85, 100, 110, 125, 135, 145, 160, 170),
    "f": (6, 10, 13, 16, 20, 25, 30, 36, 43, 50, 56, 62, 68, 76, 80, 86),
    "g": (2, 4, 5, 6, 7, 9, 10, 12, 14, 15, 17, 18, 20),
}
# -es of a, by steps of its own
_STEPS_OF_A = (6, 10, 18, 30, 40, 50, 65, 80, 100, 120, 140, 160, 180, 200, 225, 250, 280, 315, 355, 400, 450, 500)
_A = (270, 280, 290, 300, 310, 320, 340, 360, 380, 410, 460, 520, 580, 660, 740, 820, 920, 1050, 1200, 1350, 1500, 1650)
# ei; that of k for grades up to 7, 0 above
_ABOVE = {
    "k": (0, 1, 1, 1, 2, 2, 2, 3, 3, 4, 4, 4, 5),
    "n": (4, 8, 10, 12, 15, 17, 20, 23, 27, 31, 34, 37, 40),
}
# mm, to which all of these go
MOST_SIZE = 500
HOLES, SHAFTS = ("D", "F", "H", "JS"), ("a", "d", "e", "f", "g", "h", "js", "k", "n")


def deviation(letter: str, size: float) -> int:
    """How far d to g of a shaft begins below a size in mm, um."""
    return _DEVIATIONS[letter][bisect_left(_STEPS, size)]


def split_zone(zone: str) -> tuple[str, int]:
    """The letter of a zone, JS where GOST has Js, and its grade."""
    letter = zone.rstrip(digits)
    return ("JS" if letter == "Js" else letter), int(zone[len(letter) :])


def zone_limits(zone: str, size: float) -> tuple[float, float]:
    """The lower and the upper deviation, mm, of a size in mm with a zone, H7 or f7."""
    letter, grade = split_zone(zone)
    step = bisect_left(_STEPS, size)
    tolerance = _GRADES[grade - GRADES[0]][step]
    match letter:
        case "H":
            lower: float = 0
        case "D" | "F":
            lower = deviation(letter.lower(), size)
        case "k" | "n":
            lower = _ABOVE[letter][step] if letter == "n" or grade < 8 else 0
        case "js" | "JS":
            lower = -tolerance / 2
        case "h":
            lower = -tolerance
        case "a":
            lower = -_A[bisect_left(_STEPS_OF_A, size)] - tolerance
        case _:
            lower = -deviation(letter, size) - tolerance
    return lower / 1000, (lower + tolerance) / 1000


def side_symmetry(width: float) -> float:
    """The tolerance T of the symmetry of straight sides, mm, of GOST 1139-80 and ISO 14: IT7 of their width."""
    return zone_limits("H7", width)[1]
