"""The only epsilons of the project, each with its unit and its reason."""

from __future__ import annotations

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

# Laser controllers stall on shorter moves; research on receiving programs, section 1.3.
LEAST_SEGMENT_MM = 0.02

# Places and angles that people type have five decimals: parts that a scene puts together by hand fit this well, mm.
PLACED_MM = 1e-5
