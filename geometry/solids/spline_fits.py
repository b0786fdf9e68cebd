"""Limits of tooth thickness and space width by the tolerance classes of ISO 4156-1, DIN 5480-1, GOST 6033-80; mm."""

from __future__ import annotations

import math
from bisect import bisect_left
from string import ascii_letters

from geometry.base.record import Record
from geometry.solids.splines import InvoluteJoint
from geometry.solids.zones import MOST_SIZE, deviation, zone_limits

# grades, and the letters of hubs and of shafts
CLASSES: dict[str, tuple[range, tuple[str, ...], tuple[str, ...]]] = {
    "ISO 4156": (range(4, 8), ("H",), ("d", "e", "f", "h", "js", "k")),
    "DIN 5480": (range(5, 13), tuple("FGHJKM"), tuple("abcdefghjkmnprstuv")),
    # its tables, where they could be read, are those of DIN 5480: 8f, 9d, 10d and 11c in all columns
    "GOST 6033": (range(7, 12), ("H",), tuple("cdfgh")),
}
# other deviations of shafts by GOST 6033-80, of which no second source was found
UNHELD = {"GOST 6033": tuple("aknpr")}
# ISO 4156-1: the greatest m z of its deviations
MOST_REFERENCE = 1000.0
# of grades 4 to 7: T + lambda in tolerance units, what F_p, F_alpha and F_beta are made of, um
ISO_GRADES = (
    (10.0, 2.5, 6.3, 1.6, 10.0, 0.8, 4.0),
    (16.0, 3.55, 9.0, 2.5, 16.0, 1.0, 5.0),
    (25.0, 5.0, 12.5, 4.0, 25.0, 1.25, 6.3),
    (40.0, 7.1, 18.0, 6.3, 40.0, 2.0, 10.0),
)
# DIN 5480-1, table 7: the column is that of d_B (of m z in GOST 6033-80) up to, and one more for each m passed, mm
_DIN_DIAMETERS, _DIN_MODULES = (12, 25, 50, 100, 200, 400), (1.5, 4)
# deviations of the ninth column and their series: those of F to M of a hub, of a to v of a shaft are multiples of them
_DIN_DEVIATIONS = {
    "j": (8, 9, 10, 11, 12, 14, 16, 18, 20), "k": (16, 18, 20, 22, 25, 28, 32, 36, 40),
    "m": (24, 27, 30, 33, 37, 42, 48, 54, 60), "n": (32, 36, 40, 44, 50, 56, 64, 72, 80),
    "p": (40, 45, 50, 55, 62, 70, 80, 90, 100), "r": (48, 54, 60, 66, 75, 84, 96, 108, 120),
    "s": (56, 63, 70, 77, 88, 98, 112, 126, 140), "t": (64, 72, 80, 88, 100, 112, 128, 144, 160),
    "u": (72, 81, 90, 99, 112, 126, 144, 162, 180), "v": (80, 90, 100, 110, 125, 140, 160, 180, 200),
}  # fmt: skip
# the letters that have such a deviation, or the negative one
_DIN_LIKE = {"F": "k", "G": "j"}
_DIN_BELOW = {"J": "j", "K": "k", "M": "m", "g": "j", "f": "k", "e": "m", "d": "n", "c": "r", "b": "t", "a": "v"}
# actual and effective tolerance, um: a column on is a row on, a grade on is three
_DIN_TOLERANCES = (
    (8, 4), (9, 5), (10, 6), (11, 7), (12, 8), (14, 8), (16, 9), (18, 10), (20, 12), (22, 14), (25, 15), (28, 17),
    (32, 18), (36, 20), (40, 23), (45, 26), (50, 30), (56, 34), (63, 37), (71, 41), (80, 45), (90, 50), (100, 60),
    (112, 68), (125, 75), (140, 84), (160, 90), (175, 105), (200, 120), (225, 135),
)  # fmt: skip


class IsoUnits(Record):
    """What T + lambda and lambda of ISO 4156-1 are made of, um: i* of m z, i** of the width, F_p, F_alpha, F_beta.

    ``length`` of the teeth, mm.
    """

    length: float
    of_diameter: float
    of_width: float
    pitch: float
    profile: float
    helix: float


class SideLimits(Record):
    """Of the width of a space (``way`` 1) or a tooth (-1) on the reference circle.

    ``deviation``: of the effective limit at most material from the nominal width; ``variation`` (lambda, T_eff): how
    far the actual one stands off it, ``total`` (T + lambda, T_G): how far that at least material does.
    """

    nominal: float
    deviation: float
    variation: float
    total: float
    way: int
    units: IsoUnits | None = None

    def _both(self, near: float, far: float) -> tuple[float, float]:
        begin = self.nominal + self.deviation
        least, most = sorted((begin + self.way * near, begin + self.way * far))
        return least, most

    @property
    def effective(self) -> tuple[float, float]:
        """What a mate without deviations meets, least and greatest."""
        return self._both(0.0, self.total - self.variation)

    @property
    def actual(self) -> tuple[float, float]:
        """What pins and callipers tell, least and greatest."""
        return self._both(self.variation, self.total)


def side_limits(joint: InvoluteJoint, *, is_shaft: bool, length: float | None = None) -> SideLimits | None:
    """The limits of its shaft or hub by the class that it has, None without one.

    ``length`` of the teeth, by default half of the reference diameter, as the tables of ISO 4156-2 have it.
    """
    told = joint.shaft_class if is_shaft else joint.hub_class
    if not told:
        return None
    letter = told.lstrip("0123456789")
    grade, way = grade_of(told), -1 if is_shaft else 1
    if joint.standard != "ISO 4156":
        begin, actual, effective = _din(joint, grade, letter)
        return SideLimits(joint.thickness, begin / 1000, effective / 1000, (actual + effective) / 1000, way)
    share = ISO_GRADES[grade - 4][0]
    units = _iso_units(joint, grade, joint.reference_radius if length is None else length)
    total = share * units.of_diameter + 4 * share * units.of_width
    variation = 0.6 * math.hypot(units.pitch, units.profile, units.helix)
    es = _iso_deviation(2 * joint.reference_radius, letter, total)
    return SideLimits(joint.thickness, es / 1000, variation / 1000, total / 1000, way, units)


def greatest_tip(joint: InvoluteJoint, limits: SideLimits) -> float | None:
    """D_ee max of a shaft of ISO 4156 whose teeth are thinner than nominal, mm; None where it is the nominal one."""
    if joint.standard != "ISO 4156" or limits.way > 0 or limits.deviation >= 0:
        return None
    return joint.shaft_diameters[1] + limits.deviation / math.tan(joint.pressure_angle)


def root_limits(joint: InvoluteJoint, limits: SideLimits) -> tuple[float, float] | None:
    """Least and greatest root diameters of ISO 4156, mm: whatever the class, they have the tolerance of grade 7."""
    if (units := limits.units) is None:
        return None
    share, slope = ISO_GRADES[-1][0], math.tan(joint.pressure_angle)
    width = (share * units.of_diameter + 4 * share * units.of_width) / 1000 / slope
    if limits.way > 0:
        return joint.hub_diameters[1], joint.hub_diameters[1] + width
    most = joint.shaft_diameters[0] + limits.deviation / slope
    return most - width, most


def tip_tolerance(joint: InvoluteJoint, size: float) -> float | None:
    """Of a tip diameter by ISO 4156-1, table 11, mm: grade 10 to m 0.75, 11 below m 2, else 12; None: too large."""
    grade = 10 if joint.module <= 0.75 else 11 if joint.module < 2 else 12
    return zone_limits(f"H{grade}", size)[1] if size <= MOST_SIZE else None


def greatest_form(joint: InvoluteJoint, limits: SideLimits) -> float:
    """D_Fe max of a shaft, mm: on thinner teeth the sides begin nearer to the axis (ISO 4156-1)."""
    base, sine = joint.reference_radius * math.cos(joint.pressure_angle), math.sin(joint.pressure_angle)
    along = math.sqrt((joint.form_diameters[0] / 2) ** 2 - base**2)
    return 2 * math.hypot(base, along + limits.deviation / (2 * math.tan(joint.pressure_angle) * sine))


def grade_of(told: str) -> int:
    """The number of a class: 5 of 5H."""
    return int(told.rstrip(ascii_letters))


def _iso_units(joint: InvoluteJoint, grade: int, length: float) -> IsoUnits:
    d, m = 2 * joint.reference_radius, joint.module
    _, *factors = ISO_GRADES[grade - 4]
    of_diameter = 0.45 * math.cbrt(d) + 0.001 * d if d <= 500 else 0.004 * d + 2.1
    pitch = factors[0] * math.sqrt(math.pi * d / 2) + factors[1]
    profile = factors[2] * (m + 0.0125 * d) + factors[3]
    helix = factors[4] * math.sqrt(length) + factors[5]
    width = joint.thickness
    return IsoUnits(length, of_diameter, 0.45 * math.cbrt(width) + 0.001 * width, pitch, profile, helix)


def _iso_deviation(reference: float, letter: str, total: float) -> float:
    """es_v, um; that of js and k is told in whole ones."""
    if letter in ("js", "k"):
        return math.ceil(total / 2 if letter == "js" else total)
    if letter in ("h", "H"):
        return 0
    return -deviation(letter, reference)


def _din(joint: InvoluteJoint, grade: int, letter: str) -> tuple[int, int, int]:
    """A_e or A_s, T_act and T_eff of table 7 (es, T and T_e less T of GOST), um."""
    gost = joint.standard == "GOST 6033"
    diameter = 2 * joint.reference_radius if gost else joint.hub_diameters[0] + 2 * joint.module
    column = bisect_left(_DIN_DIAMETERS, diameter) + bisect_left(_DIN_MODULES, joint.module)
    like = _DIN_BELOW.get(letter) or _DIN_LIKE.get(letter, letter)
    deviation = _DIN_DEVIATIONS[like][column] if like not in ("h", "H") else 0
    return (-deviation if letter in _DIN_BELOW else deviation, *_DIN_TOLERANCES[3 * (grade - 5) + column])
