"""An unknown gear by what a calliper reads off it: pressure angle and module by two spans, then shift and heights.

Spans over k teeth and over k + 1 differ by the base pitch, of helical teeth the normal one, whatever shift and thinning
are. Lengths in mm, angles in rad; module, pressure angle and coefficients are those of the normal section.
Source: ISO 21771; modules of GOST 9563-60, diametral pitches of ANSI B6.1.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from geometry.base.angles import involute_function
from geometry.base.record import Record
from geometry.gears.teeth.module_rows import DIAMETRAL_PITCHES, INCH, MODULES
from geometry.gears.teeth.transverse import transverse_angle

# as they are met, the usual one first, degrees
ANGLES = (20.0, 14.5, 25.0, 22.5, 15.0, 17.5, 30.0)
_ROWS = {"GOST 9563-60": [float(m) for m in MODULES], "ANSI B6.1": [INCH / float(p) for p in DIAMETRAL_PITCHES]}
# share of the base pitch within which a calliper's reading fits
FITS = 0.01
# shifts beyond it are seldom cut; a wrong pressure angle gives such ones, as its involute does not suit the span
_SELDOM = 1.0


class Match(Record):
    """A pressure angle, rad, with the module that fits it best; ``deviation``: share by which the reading is more.

    ``row``: the standard that has the module, where one has it.
    """

    pressure_angle: float
    module: float
    deviation: float
    row: str


def matches(base_pitch: float, angles: Sequence[float], module: float | None = None) -> list[Match]:
    """For each of the ``angles``, rad, the nearest module and the nearest diametral pitch, or the ``module`` given.

    First those that fit, in the order of the angles, then the others, the nearest first.
    """
    found = []
    for angle in angles:
        asked = base_pitch / (math.pi * math.cos(angle))
        for row, modules in _ROWS.items() if module is None else [("", [module])]:
            nearest = min(modules, key=lambda m: abs(math.log(asked / m)))
            found.append(Match(angle, nearest, asked / nearest - 1, row))

    def rank(match: Match) -> tuple[int, float]:
        off = abs(match.deviation)
        return (angles.index(match.pressure_angle) if off <= FITS else len(angles)), off

    return sorted(found, key=rank)


def shift_of_span(span: float, teeth_spanned: int, teeth: int, match: Match, helix: float) -> float:
    """x of W = m cos(alpha) (pi (k - 1/2) + z inv(alpha_t)) + 2 x m sin(alpha); thinning makes it less than it is."""
    alpha = match.pressure_angle
    arc = math.pi * (teeth_spanned - 0.5) + teeth * involute_function(transverse_angle(alpha, helix))
    return (span / (match.module * math.cos(alpha)) - arc) / (2 * math.tan(alpha))


def by_span(
    found: Sequence[Match], span: float, teeth_spanned: int, teeth: int, helix: float
) -> list[tuple[Match, float]]:
    """Each with the shift that it makes of the span; of those that fit, first those with a shift that gears have."""
    told = [(match, shift_of_span(span, teeth_spanned, teeth, match, helix)) for match in found]
    return sorted(told, key=lambda each: (abs(each[0].deviation) > FITS, abs(each[1]) > _SELDOM))


def pin_centres(size: float, pin: float, teeth: int) -> float:
    """Diameter on which the centres of pins stand whose size over them is told, of a ring (``pin`` below 0) between."""
    return (size - pin) / (math.cos(math.pi / (2 * teeth)) if teeth % 2 else 1.0)


def shift_of_pins(centres: float, pin: float, teeth: int, match: Match, helix: float) -> float:
    """x of inv(alpha_D) = inv(alpha_t) + D / (z m cos(alpha)) - pi / (2 z) + 2 x tan(alpha) / z, ISO 21771.

    ``centres``: d_b / cos(alpha_D). Of a ring D is below 0, and the half pitch has the other sign. Thinning makes x
    less than it is, of a ring more.
    """
    alpha, transverse = match.pressure_angle, transverse_angle(match.pressure_angle, helix)
    base = match.module * teeth / math.cos(helix) * math.cos(transverse)
    polar = involute_function(math.acos(base / centres)) - involute_function(transverse)
    own = math.copysign(math.pi / 2, pin) - pin / (match.module * math.cos(alpha))
    return (teeth * polar + own) / (2 * math.tan(alpha))
