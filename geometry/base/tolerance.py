"""The only epsilons of the project, each with its unit and its reason."""

from __future__ import annotations

import math

from geometry.base.record import Record


class Tolerances(Record):
    """Numerical thresholds; lengths in mm, angles in rad, ``relative_*`` without unit."""

    # two segment ends are one point: a few hundred roundings of the largest coordinate
    relative_join: float = 1e-13
    # tangents that differ by less form a smooth joint: roundings of a tangent near a cusp are 1e-9
    smooth_angle: float = 1e-7
    # relative width at which a bracketed root is left: two units in the last place
    relative_root: float = 4.5e-16
    # a computed bound may lose this to rounding when it is compared with a measurement
    relative_rounding: float = 1e-15
    # lands and curves shorter than this part of the module are rounding, not geometry
    relative_length: float = 1e-12


TOLERANCES = Tolerances()

# Edges of solids lie on their faces and end at their vertices this well, mm: as well as CAD kernels tell points apart.
PRECISION = 1e-7

# |gap| up to this part of the module is contact of teeth: rounding of 1e4 teeth's coordinates and rack A's own 1.6e-9.
CONTACT_TOLERANCE = 1e-8

# Laser controllers stall on shorter moves; research on receiving programs, section 1.3.
LEAST_SEGMENT_MM = 0.02

# Lengths of parts that are smaller vanish among the digits of their places, of which STL has seven, mm.
LEAST_LENGTH = 1e-4

# Places and angles that people type have five decimals: parts that a scene puts together by hand fit this well, mm.
PLACED_MM = 1e-5


def is_told(typed: float, exact: float) -> bool:
    """Whether a length that was typed, mm, is an exact one as it is told: with five decimals, or all of them."""
    return typed in (exact, round(exact, 5))


# Decimals of curves in drawings, mm: what meets still does so better than kernels ask (1e-7), and what machines round
# differently is far less. A curve moves by so much: both ends, and a radius.
DRAWN_DECIMALS = 8
DRAWN_ROUNDING = 2e-8
# In a PDF, mm: four decimals of a point, of a place and of the height of the page, and arcs as cubics.
PDF_ROUNDING = 6e-5

# Decimals of numbers in files, of which a tolerance may ask for more or be content with less.
_LEAST_DECIMALS, _MOST_DECIMALS = 6, 12


def written_decimals(tolerance: float) -> int:
    """Decimals of the coordinates of a file, mm: a step of 1e-5 to 1e-4 of its tolerance.

    So far above what machines round differently that they write the same.
    """
    exponent = math.floor(math.log10(tolerance) + 1e-9)
    return min(max(4 - exponent, _LEAST_DECIMALS), _MOST_DECIMALS)
