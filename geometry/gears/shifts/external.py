"""The blocking contour of an external pair: which profile shifts x1, x2 give a pair that works.

All in modules, z1 drives; of helical teeth in normal modules, lengths those of the transverse section, which meshes as
a spur pair does, and the contact ratio is the total one. Each condition is a function of x1, x2 that is >= 0 where it
is kept; its line is where it is 0. The tips follow ``shortened_tips``: r_a = r + h_a + x - k with k = x1 + x2 - y
(GOST 16532-70), or k = 0; the distance is that of zero backlash, practicum (3.3), (3.4). Sources: ISO 21771; practicum
1, below (1.3). Corners of tips that run into a fillet below its end are no line of it: pairs make such tips shorter.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING

from geometry.base.angles import inverse_involute, involute_function
from geometry.base.record import Record
from geometry.curves.implicit import Box, level_lines
from geometry.gears.pairs.sliding import specific_sliding
from geometry.gears.shifts.hills import marked
from geometry.gears.shifts.racked_teeth import RackedTeeth
from geometry.gears.teeth.basic_rack import BasicRack
from geometry.gears.teeth.joints import form_length
from geometry.gears.teeth.limits import (
    LEAST_CONTACT_RATIO,
    LEAST_TIP_THICKNESS,
    Margin,
    least_shift_without_undercut,
)
from geometry.gears.teeth.spur import SpurGear

if TYPE_CHECKING:
    from geometry.gears.shifts.internal_shifts import InternalShiftPair

TIP_THICKNESSES = (0.0, 0.25, 0.3, 0.4)
CONTACT_RATIOS = (1.0, 1.1, 1.2)
_NAN = math.nan


class ShiftPair(RackedTeeth):
    """Two numbers of teeth and one rack, for any shifts.

    Of helical teeth the rack is that of the transverse section, in transverse modules; ``helix_angle`` in rad.
    """

    shortened_tips: bool = True
    helix_angle: float = 0.0
    overlap_ratio: float = 0.0


class PairState(Record):
    """A pair at shifts x1, x2; lengths in modules, along the line of action from the first base circle.

    ``involute`` is inv(alpha_w); where it is negative all others are nan. ``starts`` is where the mate's tip touches,
    from each gear's own base circle, ``tips`` where its flank ends. ``contact_ratio`` is the total one.
    """

    involute: float
    working_pressure_angle: float
    working_centre_distance: float
    line: float
    pole: float
    starts: tuple[float, float]
    tips: tuple[float, float]
    tip_thicknesses: tuple[float, float]
    contact_ratio: float
    tip_shortening: float

    def root_sliding(self, gear_ratio: float) -> tuple[float, float]:
        """zeta_f1 and zeta_f2; -inf where a base circle is reached."""
        starts, ends = (specific_sliding(at, self.line, gear_ratio) for at in (self.starts[0], self.tips[0]))
        return starts[0], ends[1]


@lru_cache(maxsize=1 << 17)
def state_of(pair: ShiftPair, x1: float, x2: float) -> PairState:
    """The pair at two shifts, by closed forms; only an undercut gear's form circle is a root."""
    rack, alpha, share = pair.rack, pair.rack.pressure_angle, math.cos(pair.helix_angle)
    teeth, cosine = pair.first_teeth + pair.second_teeth, math.cos(alpha)
    # in transverse modules
    x1, x2 = x1 * share, x2 * share
    involute = involute_function(alpha) + 2 * (x1 + x2) * math.tan(alpha) / teeth
    if not involute >= 0:
        nans = (_NAN, _NAN)
        return PairState(involute, _NAN, _NAN, _NAN, _NAN, nans, nans, nans, _NAN, _NAN)
    angle = inverse_involute(involute)
    distance = teeth / 2 * cosine / math.cos(angle)
    shortening = x1 + x2 - (distance - teeth / 2)
    cut = max(shortening, 0.0) if pair.shortened_tips else 0.0
    line = distance * math.sin(angle)
    tips, thick = [], []
    for z, x in zip(pair.teeth, (x1, x2), strict=True):
        tip, base = z / 2 + rack.addendum + x - cut, z / 2 * cosine
        tangent = math.sqrt((tip - base) * (tip + base)) if tip > base else _NAN
        half = (math.pi / 2 + 2 * x * math.tan(alpha)) / z + involute_function(alpha)
        tips.append(tangent)
        thick.append(2 * tip * (half - involute_function(math.atan2(tangent, base))))
    return PairState(
        involute,
        angle,
        distance / share,
        line / share,
        pair.first_teeth / 2 * cosine * math.tan(angle) / share,
        ((line - tips[1]) / share, (line - tips[0]) / share),
        (tips[0] / share, tips[1] / share),
        (thick[0] / share, thick[1] / share),
        (tips[0] + tips[1] - line) / (math.pi * cosine) + pair.overlap_ratio,
        shortening / share,
    )


@lru_cache(maxsize=1 << 14)
def form_tangent(number_of_teeth: int, rack: BasicRack, shift: float) -> float:
    """Length along the line of action from the base circle to where the involute begins, in modules.

    r sin(alpha) - (h_Ff - x) / sin(alpha) without undercut, else the true crossing of fillet and involute; nan where
    the fillet leaves no tooth.
    """
    sine = math.sin(rack.pressure_angle)
    tangent = number_of_teeth / 2 * sine - (rack.form_dedendum - shift) / sine
    if tangent >= 0:
        return tangent
    return form_length(SpurGear(1.0, number_of_teeth, rack, shift))


def active_flank(pair: ShiftPair, x1: float, x2: float, index: int, exactly: bool = True) -> Margin:
    """Where the mate's tip asks the flank of the first (0) or second (1) gear to begin, against where it does.

    Not ``exactly``: at the base circle, where that of no undercut gear begins lower.
    """
    start = state_of(pair, x1, x2).starts[index]
    share = math.cos(pair.helix_angle)
    form = form_tangent(pair.teeth[index], pair.rack, (x1, x2)[index] * share) / share if exactly else 0.0
    return Margin.above(f"active_flank_{('first', 'second')[index]}", start, form)


class Condition(Record):
    """A condition: its name, the level where it has one, and its margin at x1, x2 (>= 0 where it is kept)."""

    name: str
    level: float | None
    margin: Callable[[float, float], float]


def above(name: str, levels: Sequence[float], value: Callable[[float, float], float]) -> list[Condition]:
    """A condition for every level that a value is to keep above."""

    def kept(level: float) -> Condition:
        return Condition(name, level, lambda x1, x2: value(x1, x2) - level)

    return [kept(level) for level in levels]


def conditions(pair: ShiftPair) -> dict[str, Condition]:
    """All conditions of the contour by name and level, like ``tip_thickness_first 0.25``.

    ``active_flank_*`` is where the mate's tip asks for the flank against where it begins: fillet interference of a gear
    that is not undercut, undercut that reaches the active flank of one that is. ``approach`` and ``recess`` keep the
    pole inside the active line; ``equal_sliding`` is > 0 where the first gear's foot slides more.
    """

    def state(x1: float, x2: float) -> PairState:
        return state_of(pair, x1, x2)

    def of_gear(i: int, who: str) -> list[Condition]:
        least = least_shift(pair, i)
        return [
            Condition(f"undercut_{who}", None, lambda x1, x2: (x1, x2)[i] - least),
            Condition(f"active_flank_{who}", None, lambda x1, x2: active_flank(pair, x1, x2, i).margin),
            *above(f"tip_thickness_{who}", TIP_THICKNESSES, lambda x1, x2: state(x1, x2).tip_thicknesses[i]),
        ]

    found = [Condition("working_angle", None, lambda x1, x2: state(x1, x2).involute)]
    found += [*of_gear(0, "first"), *of_gear(1, "second")]
    found += above(ratio_name(pair), ratio_levels(pair), lambda x1, x2: state(x1, x2).contact_ratio)
    found += [
        Condition("approach", None, lambda x1, x2: state(x1, x2).pole - state(x1, x2).starts[0]),
        Condition("recess", None, lambda x1, x2: state(x1, x2).tips[0] - state(x1, x2).pole),
        Condition("equal_sliding", None, lambda x1, x2: equal_sliding(pair, x1, x2)),
    ]
    return {c.name if c.level is None else f"{c.name} {c.level:g}": c for c in found}


def ratio_name(pair: ShiftPair | InternalShiftPair) -> str:
    """Which contact ratio is kept."""
    return "total_contact_ratio" if pair.helix_angle else "contact_ratio"


def ratio_levels(pair: ShiftPair | InternalShiftPair) -> Sequence[float]:
    """The contact ratios that are told: overlap alone is no contact."""
    return [ratio for ratio in CONTACT_RATIOS if ratio > pair.overlap_ratio] or [pair.overlap_ratio]


def equal_sliding(pair: ShiftPair, x1: float, x2: float) -> float:
    """(L - g_A)(L - g_E) - u^2 g_A g_E: 0 where zeta_f1 = zeta_f2, > 0 where the first foot slides more.

    nan where the active line reaches a base circle: no sliding is finite there.
    """
    state = state_of(pair, x1, x2)
    (low1, low2), (high1, high2) = state.starts, state.tips
    if not (low1 > 0 and low2 > 0):
        return _NAN
    return high2 * low2 - pair.gear_ratio**2 * low1 * high1


@lru_cache(maxsize=256)
def least_shift(pair: ShiftPair, index: int) -> float:
    """x_min of the first (0) or second (1) gear."""
    return least_shift_without_undercut(SpurGear(1.0, pair.teeth[index], pair.rack)) / math.cos(pair.helix_angle)


class Requirements(Record):
    """What a choice of shifts must keep: tip thickness in modules, contact ratio, undercut at all or only unseen.

    The defaults are those of practicum 1, below (1.3).
    """

    tip_thickness: float = LEAST_TIP_THICKNESS
    contact_ratio: float = LEAST_CONTACT_RATIO
    allow_undercut: bool = False
    pole_inside: bool = False


def margins(pair: ShiftPair, wish: Requirements, x1: float, x2: float) -> tuple[Margin, ...]:
    """Every requirement with its margin; nan where the pair does not exist."""
    flanks = (active_flank(pair, x1, x2, i) for i in (0, 1))
    return (*(Margin.above(*side) for side in _sides(pair, wish, x1, x2)), *flanks)


def _sides(pair: ShiftPair, wish: Requirements, x1: float, x2: float) -> Iterator[tuple[str, float, float]]:
    """The requirements that cost no root, by name, value and limit."""
    state = state_of(pair, x1, x2)
    yield "working_angle", state.involute, 0.0
    for i, who in enumerate(("first", "second")):
        if not wish.allow_undercut:
            yield f"undercut_{who}", (x1, x2)[i], least_shift(pair, i)
        yield f"tip_thickness_{who}", state.tip_thicknesses[i], wish.tip_thickness
    # overlap alone is no contact
    yield ratio_name(pair), state.contact_ratio, max(wish.contact_ratio, pair.overlap_ratio)
    if wish.pole_inside:
        yield "approach", state.pole, state.starts[0]
        yield "recess", state.tips[0], state.pole


def least_margin(pair: ShiftPair, wish: Requirements, x1: float, x2: float) -> float:
    """The least of all margins, -1 where the pair does not exist.

    It has no steps, by which hills of the legal shifts would be missed.
    """
    found = [value - limit for _, value, limit in _sides(pair, wish, x1, x2)]
    for i in (0, 1):
        # an undercut flank costs a root: not where undercut is refused anyway
        exactly = wish.allow_undercut or (x1, x2)[i] >= least_shift(pair, i)
        found.append(active_flank(pair, x1, x2, i, exactly).margin)
    return -1.0 if any(map(math.isnan, found)) else min(found)


class ContourLine(Record):
    """One line of the contour: its condition, and points x1 + i x2."""

    name: str
    level: float | None
    points: tuple[complex, ...]


class BlockingContour(Record):
    """All lines inside a box, and the borders of the region that keeps the requirements."""

    pair: ShiftPair | InternalShiftPair
    requirements: Requirements
    box: Box
    lines: tuple[ContourLine, ...]
    region: tuple[tuple[complex, ...], ...]


@lru_cache(maxsize=64)
def usual_box(pair: ShiftPair, cells: int = 40) -> Box | None:
    """A box around all pairs that turn at all (contact ratio 1, pointed tips, undercut unseen); None: there are none.

    Found on a coarse grid of shifts from -3 to 5, and as far beyond it as narrow corners reach.
    """
    steps, loose = [-3 + k / 10 for k in range(81)], Requirements(0.0, 1.0, allow_undercut=True)
    inside = [(x1, x2) for x1 in steps for x2 in steps if least_margin(pair, loose, x1, x2) >= 0]
    if not inside:
        return None
    ones, twos = [x for x, _ in inside], [x for _, x in inside]
    room = 0.2
    ends = [min(ones) - room, max(ones) + room, min(twos) - room, max(twos) + room]
    for k, way in enumerate((-room, room, -room, room)):
        low, high = (ends[2], ends[3]) if k < 2 else (ends[0], ends[1])
        while steps[0] < ends[k] < steps[-1] and _has_legal(pair, loose, k < 2, ends[k], low, high):
            ends[k] += way
    left, right, bottom, top = ends
    return Box(left, right, bottom, top, cells)


def _has_legal(pair: ShiftPair, wish: Requirements, first: bool, at: float, low: float, high: float) -> bool:
    """Whether shifts are legal where x1 (``first``) or x2 is ``at``, the other one between two values."""

    def margin(along: float) -> float:
        x1, x2 = (at, along) if first else (along, at)
        return least_margin(pair, wish, x1, x2)

    return max(marked(margin, low, high, 0.1)[1]) >= 0


def blocking_contour(
    pair: ShiftPair, wish: Requirements, box: Box, tolerance: float = 2e-4, names: Iterable[str] | None = None
) -> BlockingContour:
    """The lines of the contour in a box; chords within ``tolerance`` of them, points to rounding.

    ``active_flank`` lines are told apart by undercut: ``fillet_interference_*`` and ``undercut_to_active_flank_*``.
    """
    lines = contour_lines(conditions(pair), lambda index: least_shift(pair, index), box, tolerance, names)
    region = level_lines(lambda x1, x2: least_margin(pair, wish, x1, x2), box, tolerance)
    return BlockingContour(pair, wish, box, lines, tuple(tuple(r) for r in region))


def contour_lines(
    known: dict[str, Condition],
    least: Callable[[int], float],
    box: Box,
    tolerance: float,
    names: Iterable[str] | None = None,
    shifts_at: Callable[[complex], complex] = complex,
) -> tuple[ContourLine, ...]:
    """The lines of conditions in a box; ``least`` is x_min of the first (0) or second (1) gear.

    ``shifts_at`` gives x1 + i x2 at a point of the box, where conditions are told in other coordinates.
    """
    lines: list[ContourLine] = []
    for name, condition in known.items():
        if names is not None and name not in names:
            continue
        for chain in level_lines(condition.margin, box, tolerance):
            points = [shifts_at(p) for p in chain]
            if not condition.name.startswith("active_flank"):
                lines.append(ContourLine(condition.name, condition.level, tuple(points)))
                continue
            who = condition.name.removeprefix("active_flank_")
            lines += _by_undercut(who, least(0 if who == "first" else 1), points)
    return tuple(lines)


def _by_undercut(who: str, least: float, points: list[complex]) -> list[ContourLine]:
    """A line cut where it crosses x_min; both pieces share the point next to it."""
    index = 0 if who == "first" else 1
    pieces: list[ContourLine] = []
    run: list[complex] = []
    name = ""
    for point in points:
        shift = point.real if index == 0 else point.imag
        now = f"fillet_interference_{who}" if shift >= least else f"undercut_to_active_flank_{who}"
        if name and now != name:
            pieces.append(ContourLine(name, None, (*run, point)))
            run = []
        name = now
        run.append(point)
    return [*pieces, ContourLine(name, None, tuple(run))]
