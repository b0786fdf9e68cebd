"""Hills of a margin along a line: where it is greatest, also between marks that are all below 0."""

from __future__ import annotations

import math
from collections.abc import Callable

# no margin rises faster than this many modules a module
_STEEPEST = 8.0
# golden sections within a line: to 1e-9
_SECTIONS = 40
_GOLDEN = (math.sqrt(5) - 1) / 2


def golden_section(function: Callable[[float], float], low: float, high: float, sections: int = _SECTIONS) -> float:
    """Where a function of one hill is greatest; -inf outside its domain only pushes inwards."""
    one, two = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
    values = function(one), function(two)
    for _ in range(sections):
        if values[0] >= values[1]:
            high, two = two, one
            one = high - _GOLDEN * (high - low)
            values = function(one), values[0]
        else:
            low, one = one, two
            two = low + _GOLDEN * (high - low)
            values = values[1], function(two)
    return max((low, high, (low + high) / 2), key=function)


def marked(function: Callable[[float], float], low: float, high: float, step: float) -> tuple[list[float], list[float]]:
    """Marks no farther apart than a step with a function's values, and where all about is below 0, tops between two."""
    count = max(2, math.ceil((high - low) / step))
    marks = [low + (high - low) * k / count for k in range(count + 1)]
    values = [function(m) for m in marks]
    beside = [-math.inf, *values, -math.inf]
    for k in reversed(range(count + 1)):
        # beside a mark that stands over those on both sides there may be 0 and more
        if -_STEEPEST * step <= values[k] < 0 and beside[k] <= values[k] > beside[k + 2]:
            top = golden_section(function, marks[max(k - 1, 0)], marks[min(k + 1, count)])
            at = k + (top > marks[k])
            marks.insert(at, top)
            values.insert(at, function(top))
    return marks, values
