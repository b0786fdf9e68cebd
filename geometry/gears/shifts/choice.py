"""Shifts that a centre distance asks for."""

from __future__ import annotations

from geometry.gears.pairs.involute import Sums
from geometry.gears.shifts.external import Requirements, ShiftPair
from geometry.gears.shifts.finder import for_sum
from geometry.gears.teeth.spur import SpurGear


def shift_sum_for_distance(first: SpurGear, second: SpurGear, working_centre_distance: float) -> float:
    """x1 + x2 for zero backlash at a centre distance, mm; practicum (3.3), (3.4) read backwards.

    Raises
    ------
    ParameterError
        The distance is not beyond the sum of the base radii: no working angle exists.
    """
    return Sums.of(first, second).shift_at(working_centre_distance)


def shifts_for_distance(
    first: SpurGear,
    second: SpurGear,
    working_centre_distance: float,
    first_shift: float | None = None,
    second_shift: float | None = None,
) -> tuple[float, float]:
    """Shifts for a centre distance, mm: the missing one follows from the given one.

    With none given: equal sliding of both feet where that keeps clear of undercut, pointed tips, interference and a
    contact ratio of 1; half each where nothing does.

    Raises
    ------
    ParameterError
        The distance leaves no working angle.
    """
    total = shift_sum_for_distance(first, second, working_centre_distance)
    if first_shift is not None:
        return first_shift, total - first_shift
    if second_shift is not None:
        return total - second_shift, second_shift
    pair = ShiftPair(first.number_of_teeth, second.number_of_teeth, first.rack)
    for undercut in (False, True):
        found = for_sum(pair, Requirements(0.0, 1.0, allow_undercut=undercut), total)
        if found is not None:
            return found.first, total - found.first
    return total / 2, total / 2
