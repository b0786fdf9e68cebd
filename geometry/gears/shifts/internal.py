"""The blocking contour of an internal pair: which profile shifts x1 (pinion), x2 (ring) give a pair that works.

All in modules. Each condition is a function of x1, x2 that is >= 0 where it is kept; its line is where it is 0. The
ring's root and fillet are those of one cutter for the whole plane. Source: GOST 19274, KHK, ISO 21771.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from functools import lru_cache
from itertools import pairwise
from operator import sub

from geometry.base.angles import involute_function
from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_root
from geometry.curves.implicit import Box, level_lines
from geometry.gears.shifts.external import (
    TIP_THICKNESSES,
    BlockingContour,
    Condition,
    ContourLine,
    Requirements,
    above,
    contour_lines,
    ratio_levels,
    ratio_name,
)
from geometry.gears.shifts.internal_shifts import (
    CUTTING,
    InternalShiftPair,
    InternalState,
    cutting_margins,
    equal_sliding,
    interferences,
    internal_state,
    least_pinion_shift,
    pinion_form,
)
from geometry.gears.teeth.cutter import PinionCutter
from geometry.gears.teeth.limits import Margin

# levels of the bottom clearance, modules: the tip at the root, and the least that contact searches found free
TIP_CLEARANCES = (0.0, 0.2)
# value and limit of a condition at x1, x2 and the pair's state there
_Sides = Callable[[float, float, InternalState], tuple[float, float]]
# no margin rises faster than this many modules a module; the smallest square looked at for legal shifts
_STEEPEST, _FINE = 8.0, 0.05
# what is compared with a level of one's choice
_LEVELLED: dict[str, Callable[[InternalState], float]] = {
    "tip_thickness_first": lambda state: state.tip_thicknesses[0],
    "tip_thickness_second": lambda state: state.tip_thicknesses[1],
    "contact_ratio": lambda state: state.contact_ratio,
    "tip_clearance_first": lambda state: state.tip_clearances[0],
    "tip_clearance_second": lambda state: state.tip_clearances[1],
}
_COSTLY = frozenset({f"cutter_{name}" for name in CUTTING} | set(CUTTING) | {"active_flank_first"})
# conditions of one gear alone: their lines are vertical (pinion) or horizontal (ring)
_OF_PINION = frozenset({"undercut_first", "tip_thickness_first", "cutter_working_angle_first", "cutter_reach_first"})
_OF_RING = frozenset({"tip_above_base", "tip_thickness_second", "rounded_root", "cutter_working_angle"})


class InternalRequirements(Requirements):
    """What a choice of shifts must keep: those of an external pair, bottom clearance in modules, radial assembly.

    Interference of any kind, a ring that its cutter cannot make and tips below the base circle are never legal. With
    less bottom clearance than the default a sharp tip may strike the mate's fillet beside the flanks.
    """

    tip_clearance: float = 0.2
    radial_assembly: bool = False


@lru_cache(maxsize=64)
def _always(pair: InternalShiftPair) -> dict[str, _Sides]:
    """Both sides, value >= limit, of every condition without a level, those that cost a root last."""

    def cutting(k: int) -> _Sides:
        return lambda x1, x2, state: (cutting_margins(pair, x2)[k], 0.0)

    def running(k: int) -> _Sides:
        return lambda x1, x2, state: (interferences(pair, x1, x2)[k], 0.0)

    least, base = least_pinion_shift(pair), pair.ring(0.0).base_radius
    sides: dict[str, _Sides] = {
        "working_angle": lambda x1, x2, state: (state.involute, 0.0),
        "tip_above_base": lambda x1, x2, state: (state.ring.tip_radius, base),
        "undercut_first": lambda x1, x2, state: (x1, least),
        "fillet_interference_second": lambda x1, x2, state: (state.ring.reach, state.end + state.line),
        "approach": lambda x1, x2, state: (state.pole, state.start),
        "recess": lambda x1, x2, state: (state.end, state.pole),
    }
    if pair.pinion_cutter is not None:
        sides["cutter_working_angle_first"] = lambda x1, x2, state: (state.pinion.cut_involute, 0.0)
        sides["cutter_reach_first"] = lambda x1, x2, state: (state.pinion.reach, state.end)
    if isinstance(pair.root, PinionCutter):
        sides["cutter_working_angle"] = lambda x1, x2, state: (state.ring.cut_involute, 0.0)
        sides |= {f"cutter_{name}": cutting(k) for k, name in enumerate(CUTTING)}
    else:
        sides["rounded_root"] = lambda x1, x2, state: (state.ring.room, 0.0)
    sides |= {name: running(k) for k, name in enumerate(CUTTING)}
    sides["active_flank_first"] = lambda x1, x2, state: (state.start, pinion_form(pair, x1))
    return sides


def conditions(pair: InternalShiftPair) -> dict[str, Condition]:
    """All conditions of the contour by name and level; ``first`` is the pinion, ``second`` the ring.

    ``active_flank_first`` as for an external pair: fillet interference, or undercut that reaches the active flank.
    ``cutter_*`` are those of cutting the ring, ``tip_above_base`` is the ring's, ``cutter_*_first`` those of a shaped
    pinion, ``rounded_root`` that of a ring's rounding in its space. ``approach`` and ``recess`` keep the pole inside
    the active line.
    """

    def at(value: Callable[[InternalState], float]) -> Callable[[float, float], float]:
        return lambda x1, x2: value(internal_state(pair, x1, x2))

    def compared(name: str, sides: _Sides) -> Condition:
        return Condition(name, None, lambda x1, x2: sub(*sides(x1, x2, internal_state(pair, x1, x2))))

    found = [compared(name, sides) for name, sides in _always(pair).items()]
    for name, value in _LEVELLED.items():
        if name == "contact_ratio":
            found += above(ratio_name(pair), ratio_levels(pair), at(value))
        else:
            levels = TIP_THICKNESSES if name.startswith("tip_thickness") else TIP_CLEARANCES
            found += above(name, levels, at(value))
    found.append(Condition("equal_sliding", None, lambda x1, x2: equal_sliding(pair, x1, x2)))
    return {c.name if c.level is None else f"{c.name} {c.level:g}": c for c in found}


@lru_cache(maxsize=64)
def _required(pair: InternalShiftPair, wish: InternalRequirements) -> tuple[tuple[str, _Sides], ...]:
    """The requirements, those that cost a root last."""
    always = _always(pair)
    left_out = {"working_angle"}
    if wish.allow_undercut:
        left_out.add("undercut_first")
    if not wish.pole_inside:
        left_out |= {"approach", "recess"}
    if not wish.radial_assembly:
        left_out.add("radial_assembly")
    found: list[tuple[str, _Sides]] = [("working_angle", always["working_angle"])]
    for name, value in _LEVELLED.items():
        told = ratio_name(pair) if name == "contact_ratio" else name
        found.append((told, _against(value, _limit(pair, wish, name))))
    found += [(name, sides) for name, sides in always.items() if name not in left_out]
    return tuple(sorted(found, key=lambda check: check[0] in _COSTLY))


def _against(value: Callable[[InternalState], float], limit: float) -> _Sides:
    return lambda x1, x2, state: (value(state), limit)


def _limit(pair: InternalShiftPair, wish: InternalRequirements, name: str) -> float:
    if name == "contact_ratio":
        # overlap alone is no contact
        return max(wish.contact_ratio, pair.overlap_ratio)
    return wish.tip_thickness if name.startswith("tip_thickness") else wish.tip_clearance


def margins(pair: InternalShiftPair, wish: InternalRequirements, x1: float, x2: float) -> tuple[Margin, ...]:
    """Every requirement with its margin; nan where the pair does not exist."""
    state = internal_state(pair, x1, x2)
    return tuple(Margin.above(name, *sides(x1, x2, state)) for name, sides in _required(pair, wish))


def least_margin(pair: InternalShiftPair, wish: InternalRequirements, x1: float, x2: float) -> float:
    """The least of all margins, -1 where the pair does not exist; what costs a root only where all else is kept."""
    least, state = math.inf, internal_state(pair, x1, x2)
    for name, sides in _required(pair, wish):
        if least < 0 and name in _COSTLY:
            break
        value, limit = sides(x1, x2, state)
        margin = value - limit
        if not margin > -math.inf:
            return -1.0
        least = min(least, margin)
    return least


class Window(Record):
    """Where legal shifts lie: a box around them, and the range of x2 - x1 and how finely to look at it."""

    box: Box
    lowest: float
    highest: float
    step: float


@lru_cache(maxsize=64)
def window(pair: InternalShiftPair) -> Window | None:
    """A box around all pairs that turn at all (contact ratio 1, pointed tips, undercut unseen); None: there are none.

    Squares of the plane of x1 and x2 - x1, both shifts from -3 to 5, are halved down to ``_FINE`` unless their middle
    is too far from every legal pair.
    """
    loose = InternalRequirements(0.0, 1.0, allow_undercut=True, tip_clearance=0.0)
    lowest = least_difference(pair)
    size, first, last = 0.4, -3.0, 5.0
    rows = math.ceil((last - first - lowest) / size)
    squares = [(first + size * (i + 0.5), lowest + size * (j + 0.5)) for i in range(20) for j in range(rows)]
    while True:
        values = [least_margin(pair, loose, x1, x1 + d) if first <= x1 + d <= last else -math.inf for x1, d in squares]
        if size <= _FINE:
            break
        kept = [
            square
            for square, value in zip(squares, values, strict=True)
            if value == -1.0 or value > -_STEEPEST * size or not first <= sum(square) <= last
        ]
        size /= 2
        squares = [(x1 + i * size / 2, d + j * size / 2) for x1, d in kept for i in (-1, 1) for j in (-1, 1)]
    hits = [square for square, value in zip(squares, values, strict=True) if value >= 0]
    if not hits:
        return None
    room = 0.2
    ones, twos, differences = [x1 for x1, _ in hits], [x1 + d for x1, d in hits], [d for _, d in hits]
    left, right, bottom, top = min(ones) - room, max(ones) + room, min(twos) - room, max(twos) + room
    low, high = max(min(differences) - size, lowest), max(differences) + size
    cells = math.ceil(min(120.0, max(40.0, 4 * max(right - left, top - bottom) / (high - low))))
    return Window(Box(left, right, bottom, top, cells), low, high, max((high - low) / 40, 1e-3))


def internal_contour(
    pair: InternalShiftPair,
    wish: InternalRequirements,
    box: Box,
    tolerance: float = 2e-4,
    names: Iterable[str] | None = None,
) -> BlockingContour:
    """The lines of the contour in a box; chords within ``tolerance`` of them, points to rounding.

    Lines of both shifts may reach beyond the box on the left and right by a cell. They are sought in the plane of x2
    and x2 - x1, which ends where inv(alpha_w) = 0, and where that of the ring and its cutter is 0: up to there margins
    are defined.
    """
    lowest = least_difference(pair)
    # both involute functions stay above their rounding
    low, high = max(lowest + 1e-12, box.bottom - box.right), box.top - box.left
    bottom = max(box.bottom, _least_ring_shift(pair) + 1e-12)
    sheared = Box(bottom, max(box.top, bottom + 1e-6), low, high, math.ceil(1.5 * box.cells))
    beyond = (sheared.right - sheared.left + sheared.top - sheared.bottom) / sheared.cells

    def within(x1: float, x2: float) -> bool:
        return box.left - beyond <= x1 <= box.right + beyond and bottom <= x2 <= box.top + 1e-9

    def field(condition: Condition) -> Condition:
        margin = condition.margin
        return replace(condition, margin=lambda x2, d: margin(x2 - d, x2) if within(x2 - d, x2) else math.nan)

    def legal(x2: float, d: float) -> float:
        # closed along the box where the region goes on beyond it
        inside = box.left < x2 - d < box.right and bottom < x2 < box.top and d > low
        return least_margin(pair, wish, x2 - d, x2) if inside else -1.0

    wanted = {n: c for n, c in conditions(pair).items() if names is None or n in names}
    known = {n: field(c) for n, c in wanted.items() if _alone(c.name) is None and n != "working_angle"}
    fine = tolerance / 2
    lines = list(contour_lines(known, lambda _: least_pinion_shift(pair), sheared, fine, None, _shifts_at))
    lines += [line for c in wanted.values() for line in _straight_lines(c, box, lowest)]
    region = tuple(tuple(map(_shifts_at, ring)) for ring in level_lines(legal, sheared, fine))
    order = {name: k for k, name in enumerate(dict.fromkeys(c.name for c in wanted.values()))}
    return BlockingContour(pair, wish, box, tuple(sorted(lines, key=lambda li: order.get(li.name, 99))), region)


def least_difference(pair: InternalShiftPair) -> float:
    """x2 - x1 at which inv(alpha_w) = 0."""
    alpha = pair.rack.pressure_angle
    return -involute_function(alpha) * (pair.second_teeth - pair.first_teeth) / (2 * math.tan(alpha)) / pair.share


def _shifts_at(point: complex) -> complex:
    """x1 + i x2 at x2 + i (x2 - x1)."""
    return complex(point.real - point.imag, point.real)


def _least_ring_shift(pair: InternalShiftPair) -> float:
    """x_2 at which inv(alpha_w0) of the ring and its cutter is 0; -inf without a cutter."""
    if not isinstance(pair.root, PinionCutter):
        return -math.inf
    alpha, difference = pair.rack.pressure_angle, pair.second_teeth - pair.root.number_of_teeth
    least = pair.root.profile_shift_coefficient - involute_function(alpha) * difference / (2 * math.tan(alpha))
    return least / pair.share


def _alone(name: str) -> int | None:
    """Which shift alone decides: 0, 1, or None: both."""
    if name in _OF_PINION:
        return 0
    return 1 if name in _OF_RING or (name.removeprefix("cutter_") != name and not name.endswith("_first")) else None


def _straight_lines(condition: Condition, box: Box, difference: float) -> list[ContourLine]:
    """inv(alpha_w) = 0, and the lines of one gear alone, as far as inv(alpha_w) >= 0 inside the box."""
    which = _alone(condition.name)
    if condition.name == "working_angle":
        low, high = max(box.left, box.bottom - difference), min(box.right, box.top - difference)
        line = (complex(x1, x1 + difference) for x1 in (low, high))
        return _segment(condition, *line) if low < high else []
    if which is None:
        return []
    lines: list[ContourLine] = []
    for root in _shifts_on_line(condition, which, box, difference):
        if which == 0:
            ends = complex(root, max(box.bottom, root + difference)), complex(root, box.top)
        else:
            ends = complex(box.left, root), complex(min(box.right, root - difference), root)
        if abs(ends[1] - ends[0]) > 0:
            lines += _segment(condition, *ends)
    return lines


def _shifts_on_line(condition: Condition, which: int, box: Box, difference: float) -> list[float]:
    """The shifts of one gear at which its condition is just kept; the other shift leaves a working angle."""
    count = 4 * box.cells
    low, high = (box.left, box.right) if which == 0 else (box.bottom, box.top)

    def margin(shift: float) -> float:
        other = shift + difference + 1.0 if which == 0 else shift - difference - 1.0
        return condition.margin(shift, other) if which == 0 else condition.margin(other, shift)

    marks = [low + (high - low) * k / count for k in range(count + 1)]
    values = [margin(m) for m in marks]
    return [
        bracketed_root(margin, one, two).value
        for (one, two), (a, b) in zip(pairwise(marks), pairwise(values), strict=True)
        if math.isfinite(a) and math.isfinite(b) and (a >= 0) != (b >= 0)
    ]


def _segment(condition: Condition, start: complex, end: complex) -> list[ContourLine]:
    """A straight line in eight pieces."""
    points = tuple(start + (end - start) * k / 8 for k in range(9))
    return [ContourLine(condition.name, condition.level, points)]
