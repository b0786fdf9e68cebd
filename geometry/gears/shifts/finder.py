"""Shifts inside the blocking contour: for least wear, for the greatest contact ratio, for a centre distance.

Everything is sought along lines of one working angle, x1 + x2 = s, or x2 - x1 = s for an internal pair: on them equal
sliding has one root, and the legal part is found by its sign on a grid with bracketed ends.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache, partial
from itertools import pairwise

from geometry.base.nearest import last_that_holds
from geometry.base.record import Record
from geometry.base.roots import bracketed_root
from geometry.curves.implicit import Box
from geometry.gears.shifts import external as blocking_contour
from geometry.gears.shifts import internal as internal_contour
from geometry.gears.shifts import internal_shifts
from geometry.gears.shifts.external import PairState, Requirements, ShiftPair, usual_box
from geometry.gears.shifts.hills import golden_section, marked
from geometry.gears.shifts.internal import InternalRequirements, Window
from geometry.gears.shifts.internal_shifts import InternalShiftPair, InternalState
from geometry.gears.teeth.limits import Margin

# how finely sums and shifts are looked at, in modules; between grid points the greatest margin is sought
_STEP = 0.05
# golden sections between lines: to 1e-7; halvings at an end: to 1e-12
_OUTER_SECTIONS, _HALVINGS = 28, 36
# what a root leaves of a margin of 0
_ROUNDING = 1e-9


class Proposal(Record):
    """Shifts, and what they give: contact ratio, specific sliding at both feet, the least margin of all."""

    first: float
    second: float
    contact_ratio: float
    root_sliding: tuple[float, float]
    margin: float


AnyShiftPair = ShiftPair | InternalShiftPair


def _step(box: Box) -> float:
    """How finely to look: coarser where the legal shifts spread far."""
    return max(_STEP, max(box.right - box.left, box.top - box.bottom) / 60)


def state_of(pair: AnyShiftPair, x1: float, x2: float) -> PairState | InternalState:
    """A pair of either kind at two shifts."""
    if isinstance(pair, InternalShiftPair):
        return internal_shifts.internal_state(pair, x1, x2)
    return blocking_contour.state_of(pair, x1, x2)


def _in_ring(wish: Requirements) -> InternalRequirements:
    """What is asked of any pair, asked of an internal one."""
    if isinstance(wish, InternalRequirements):
        return wish
    return InternalRequirements(wish.tip_thickness, wish.contact_ratio, wish.allow_undercut, wish.pole_inside)


def margins(pair: AnyShiftPair, wish: Requirements, x1: float, x2: float) -> tuple[Margin, ...]:
    """Every requirement of a pair of either kind; an internal one may have ``InternalRequirements``."""
    if isinstance(pair, InternalShiftPair):
        return internal_contour.margins(pair, _in_ring(wish), x1, x2)
    return blocking_contour.margins(pair, wish, x1, x2)


def least_margin(pair: AnyShiftPair, wish: Requirements, x1: float, x2: float) -> float:
    """The least of them."""
    if isinstance(pair, InternalShiftPair):
        return internal_contour.least_margin(pair, _in_ring(wish), x1, x2)
    return blocking_contour.least_margin(pair, wish, x1, x2)


def second_shift(pair: AnyShiftPair, shift_sum: float, x1: float) -> float:
    """x2 on the line of one working angle."""
    return shift_sum + x1 if isinstance(pair, InternalShiftPair) else shift_sum - x1


def _window(pair: AnyShiftPair) -> Window | None:
    """Where legal shifts lie, and which lines of one working angle are looked at; None: nowhere."""
    if isinstance(pair, InternalShiftPair):
        return internal_contour.window(pair)
    box = usual_box(pair)
    return None if box is None else Window(box, box.left + box.bottom, box.right + box.top, _step(box))


def _first_shifts(pair: AnyShiftPair, shift_sum: float) -> tuple[float, float, float] | None:
    """Where to look for x1 on a line of one working angle: from, to, step; None: nowhere."""
    if (found := _window(pair)) is None:
        return None
    box, way = found.box, 1 if isinstance(pair, InternalShiftPair) else -1
    # no shifts outside are legal
    ends = sorted(way * (x2 - shift_sum) for x2 in (box.bottom, box.top))
    low, high = max(box.left, ends[0]), min(box.right, ends[1])
    return (low, high, _step(box)) if low < high else None


def _sums(pair: AnyShiftPair, wish: Requirements) -> list[float]:
    """The lines of one working angle that are looked at; where none has legal shifts, also the best between them."""
    if (found := _window(pair)) is None:
        return []
    count = math.ceil((found.highest - found.lowest) / found.step) + 1
    sums = [found.lowest + found.step * k for k in range(count)]
    if any(legal_shifts(pair, wish, total) for total in sums):
        return sums

    def greatest(total: float) -> float:
        line = _first_shifts(pair, total)
        return -math.inf if line is None else max(marked(partial(_margin_on, pair, wish, total), *line)[1])

    return marked(greatest, sums[0], sums[-1], found.step)[0]


def _margin_on(pair: AnyShiftPair, wish: Requirements, total: float, x1: float) -> float:
    return least_margin(pair, wish, x1, second_shift(pair, total, x1))


# what is looked for on a line asks for its legal part, one choice of shifts after another
@lru_cache(maxsize=1 << 11)
def legal_shifts(pair: AnyShiftPair, wish: Requirements, shift_sum: float) -> tuple[tuple[float, float], ...]:
    """The intervals of x1 that keep the requirements at x1 + x2, or x2 - x1 of an internal pair, = ``shift_sum``."""
    found = _first_shifts(pair, shift_sum)
    return () if found is None else tuple(_positive(partial(_margin_on, pair, wish, shift_sum), *found))


def for_sum(pair: AnyShiftPair, wish: Requirements, shift_sum: float) -> Proposal | None:
    """The legal shifts of a given sum (a given centre distance) whose feet slide most equally; None: none is legal."""
    found = legal_shifts(pair, wish, shift_sum)
    if not found:
        return None
    low, high = max(found, key=lambda part: part[1] - part[0])
    wanted = equal_sliding_shift(pair, shift_sum, low, high)
    return proposal(pair, wish, wanted, second_shift(pair, shift_sum, wanted))


def nearest_sum(pair: AnyShiftPair, wish: Requirements, shift_sum: float) -> float | None:
    """The sum (x2 - x1 of an internal pair) nearest to an illegal one that has legal shifts; None: there is none."""

    def legal(total: float) -> float:
        return 0.0 if legal_shifts(pair, wish, total) else -math.inf

    good = min((s for s in _sums(pair, wish) if legal(s) == 0), key=lambda s: abs(s - shift_sum), default=None)
    return None if good is None else _last_inside(legal, good, shift_sum)


def equal_sliding_shift(pair: AnyShiftPair, shift_sum: float, low: float, high: float) -> float:
    """x1 of equal sliding between two x1 of one sum, or the end nearer to it: with x1 the first foot slides less."""

    def difference(x1: float) -> float:
        x2 = second_shift(pair, shift_sum, x1)
        if isinstance(pair, InternalShiftPair):
            return internal_shifts.equal_sliding(pair, x1, x2)
        return blocking_contour.equal_sliding(pair, x1, x2)

    ends = difference(low), difference(high)
    # beyond the base circle of the first gear sliding has no bound, so the root lies above; of the second, below
    if math.isnan(ends[0]) or math.isnan(ends[1]):
        return high if math.isnan(ends[0]) else low
    if ends[0] <= 0:
        return low
    return high if ends[1] >= 0 else bracketed_root(difference, low, high, at_ends=ends).value


def least_wear(pair: AnyShiftPair, wish: Requirements) -> Proposal | None:
    """The legal shifts with equal sliding of both feet and the least of it; None where no such pair is legal."""

    def shift(total: float) -> float | None:
        for low, high in legal_shifts(pair, wish, total):
            x1 = equal_sliding_shift(pair, total, low, high)
            if low < x1 < high and _is_legal(pair, wish, total, x1):
                return x1
        return None

    return _best(pair, wish, shift, partial(_foot_sliding, pair))


def least_sliding(pair: AnyShiftPair, wish: Requirements) -> Proposal | None:
    """The legal shifts with the least sliding at the foot that slides more, equal or not; None: no pair is legal.

    For pairs whose legal shifts all lie on one side of equal sliding.
    """

    def shift(total: float) -> float | None:
        found = [equal_sliding_shift(pair, total, low, high) for low, high in legal_shifts(pair, wish, total)]
        legal = [x1 for x1 in found if _is_legal(pair, wish, total, x1)]
        return max(legal, key=partial(_foot_sliding, pair, total), default=None)

    return _best(pair, wish, shift, partial(_foot_sliding, pair))


def greatest_contact_ratio(pair: AnyShiftPair, wish: Requirements) -> Proposal | None:
    """The legal shifts with the greatest contact ratio; None where no pair is legal."""

    def ratio(total: float, x1: float) -> float:
        return state_of(pair, x1, second_shift(pair, total, x1)).contact_ratio

    def shift(total: float) -> float | None:
        own = partial(ratio, total)
        found = [
            x for low, high in legal_shifts(pair, wish, total) for x in (golden_section(own, low, high), low, high)
        ]
        # between marks a narrow gap in the legal shifts may have been overlooked
        return max((x1 for x1 in found if _is_legal(pair, wish, total, x1)), key=own, default=None)

    return _best(pair, wish, shift, ratio)


def _is_legal(pair: AnyShiftPair, wish: Requirements, total: float, x1: float) -> bool:
    return _margin_on(pair, wish, total, x1) >= -_ROUNDING


def _foot_sliding(pair: AnyShiftPair, total: float, x1: float) -> float:
    """Of both feet the one that slides more: the lesser, below 0."""
    return min(state_of(pair, x1, second_shift(pair, total, x1)).root_sliding(pair.gear_ratio))


def proposal(pair: AnyShiftPair, wish: Requirements, x1: float, x2: float) -> Proposal:
    """What a pair of shifts gives."""
    state = state_of(pair, x1, x2)
    return Proposal(x1, x2, state.contact_ratio, state.root_sliding(pair.gear_ratio), least_margin(pair, wish, x1, x2))


def _best(
    pair: AnyShiftPair,
    wish: Requirements,
    shift: Callable[[float], float | None],
    worth: Callable[[float, float], float],
) -> Proposal | None:
    """The shifts that are worth most, of those that ``shift`` chooses of each sum: their x1, None where there is none.

    ``worth`` judges a sum and its x1. Where nothing is chosen the sums' domain ends, which is halved in on.
    """

    def function(total: float) -> float:
        x1 = shift(total)
        return -math.inf if x1 is None else worth(total, x1)

    sums = _sums(pair, wish)
    if not sums:
        return None
    values = [function(s) for s in sums]
    best = max(range(len(sums)), key=lambda k: values[k])
    if values[best] == -math.inf:
        return None
    ends = []
    for k in (best - 1, best + 1):
        k = min(max(k, 0), len(sums) - 1)
        ends.append(sums[k] if values[k] > -math.inf else _last_inside(function, sums[best], sums[k]))
    total = max((golden_section(function, ends[0], ends[1], _OUTER_SECTIONS), sums[best]), key=function)
    x1 = shift(total)
    return None if x1 is None else proposal(pair, wish, x1, second_shift(pair, total, x1))


def _last_inside(function: Callable[[float], float], inside: float, outside: float) -> float:
    return last_that_holds(lambda x: function(x) > -math.inf, outside, inside, _HALVINGS)


def _positive(function: Callable[[float], float], low: float, high: float, step: float) -> list[tuple[float, float]]:
    """The intervals in which a function is >= 0; ends are roots, the side that is >= 0."""
    marks, values = marked(function, low, high, step)
    ends: list[float] = [marks[0]] if values[0] >= 0 else []
    for (a, b), (fa, fb) in zip(pairwise(marks), pairwise(values), strict=True):
        if (fa >= 0) != (fb >= 0):
            bracket = bracketed_root(function, a, b, at_ends=(fa, fb)).bracket
            ends.append(next((e for e in bracket if function(e) >= 0), bracket[0]))
    if len(ends) % 2:
        ends.append(marks[-1])
    return list(zip(ends[::2], ends[1::2], strict=True))
