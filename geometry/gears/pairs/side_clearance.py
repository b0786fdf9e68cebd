"""Backlash asked for: from a GOST 1643 class of side clearance, or along the working circle.

Lengths in mm. Angles in rad.
"""

from __future__ import annotations

import math
from bisect import bisect_left

from geometry.base.errors import Nearest, ParameterError

# upper ends of the ranges of the centre distance, mm; GOST 1643-81, table of the guaranteed side clearance
_DISTANCES = (80, 125, 180, 250, 315, 400, 500, 630, 800, 1000, 1250, 1600, 2000)
# j_n min in micrometres for each range; its classes are the tolerance grades IT7 to IT11 of ISO 286 on a_w
_CLEARANCES = {
    "H": (0,) * 13,
    "E": (30, 35, 40, 46, 52, 57, 63, 70, 80, 90, 105, 125, 150),
    "D": (46, 54, 63, 72, 81, 89, 97, 110, 125, 140, 165, 195, 230),
    "C": (74, 87, 100, 115, 130, 140, 155, 175, 200, 230, 260, 310, 370),
    "B": (120, 140, 160, 185, 210, 230, 250, 280, 320, 360, 420, 500, 600),
    "A": (190, 220, 250, 290, 320, 360, 400, 440, 500, 560, 660, 780, 920),
}
# of a distance: rounding of a_w, by which 80 mm are 80.00000000000001
_ROUNDING = 1e-10
SIDE_CLEARANCE_CLASSES = tuple(_CLEARANCES)


def guaranteed_normal_backlash(side_clearance_class: str, working_centre_distance: float) -> float:
    """j_n min, mm, of a class of GOST 1643-81 (H, E, D, C, B, A) at a centre distance.

    Raises
    ------
    ParameterError
        The class is unknown, or the centre distance is beyond 2000 mm.
    """
    if side_clearance_class not in _CLEARANCES:
        known = SIDE_CLEARANCE_CLASSES
        raise ParameterError("side_clearance_class", side_clearance_class, "not_one_of", Nearest("C"), known=known)
    index = bisect_left(_DISTANCES, working_centre_distance * (1 - _ROUNDING))
    if index == len(_DISTANCES):
        most = _DISTANCES[-1]
        raise ParameterError("side_clearance_class", side_clearance_class, "classes_end_at_distance", distance=most)
    return _CLEARANCES[side_clearance_class][index] / 1000


def normal_from_circumferential(circumferential_backlash: float, working_pressure_angle: float) -> float:
    """j_bn = j_wt cos(alpha_w), mm; ISO 21771."""
    return circumferential_backlash * math.cos(working_pressure_angle)
