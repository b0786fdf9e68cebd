"""The one search for a value that works: deterministic, on one parameter, a counted number of trials, no clock."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import TypeVar

from geometry.base.errors import GeometryError, Nearest, OffsetError, ParameterError, limit, rounded
from geometry.base.record import Record

V = TypeVar("V")
# trials of one search, those of the ends included: 2^-40 of the way is below what is printed
MOST_TRIALS = 40
# what is less than so much of the last digit that is told is nothing; so much of itself is sought no nearer; sizes so
# far apart are not alike
_NOTHING, _FINE, _ALIKE = 0.01, 1e-7, 4.0


def kept(holds: Callable[[V], object], value: V) -> bool:
    """What ``holds`` judges of a value, a check by None; a ``GeometryError`` of it is a no."""
    try:
        found = holds(value)
    except GeometryError:
        return False
    return found is None or bool(found)


def nearest(
    holds: Callable[[float], bool],
    given: float,
    toward: float | Iterable[float],
    *,
    digits: int = 4,
    enough: float = 0.0,
    share: float = 0.0,
) -> Nearest | None:
    """The value nearest to ``given`` that holds, on the way to ``toward`` (or to the first of several that holds).

    ``holds`` judges one value of one parameter: a margin of what is made, never a scene; a ``GeometryError`` of it is
    a no. Whole numbers are searched where both ends are whole. At most ``MOST_TRIALS`` trials; ``None`` where none of
    the ends holds, or where what would be printed does not: then one parameter cannot cure it. ``enough``, or a
    ``share`` of it: so near to the last one that holds a costly search may end, on round numbers that are the same
    whatever is given.
    """
    left = MOST_TRIALS - 2

    def tried(value: float) -> bool:
        nonlocal left
        left -= 1
        return kept(holds, value)

    ends = [toward] if isinstance(toward, int | float) else toward
    failed, good = [given], given
    for good in ends:
        if left <= 0:
            return None
        if tried(good):
            break
        failed.append(good)
    else:
        return None
    # what lies before the last that failed on the way is not looked at again; other ends may lie beyond it
    on_way = [one for one in failed if (one - good) * (given - good) > 0]
    bad = min(on_way, key=lambda one: abs(one - good), default=given)
    if isinstance(good, int) and isinstance(bad, int):
        while abs(good - bad) > 1 and left > 0:
            between = (good + bad) // 2
            good, bad = (between, bad) if tried(between) else (good, between)
        return limit(good, given)
    rough, held = enough > 0 or share > 0, [good]
    while left > 0:
        near = max(enough, share * abs(good)) if rough else 0.0
        if (middle := _between(good, bad, digits, near, round_ones=rough)) is None:
            break
        if tried(middle):
            good = middle
            held.append(middle)
        else:
            bad = middle
    # at the very edge rounding may decide: then one before it is told
    for found in dict.fromkeys(limit(float(last), given, digits=digits) for last in reversed(held)):
        if isinstance(found.value, float) and (found.value in held or (left > -2 and tried(found.value))):
            return found
    return None


def _between(one: float, other: float, digits: int, near: float, *, round_ones: bool) -> float | None:
    """A number that halves the way from one to another, as it would be told or a round one; None: they are ``near``.

    What is sought is far more often of the size of the smaller one than of the larger: sizes are halved first.
    """
    low, high = sorted((one, other))
    if low < 0 < high:
        return 0.0
    nothing = _NOTHING * 10.0**-digits
    small, large = sorted((abs(low), abs(high)))
    told_apart = 0.1 * 10.0 ** -max(digits, 3 - math.floor(math.log10(large))) if round_ones and large > 0 else 0.0
    if high - low <= max(near, nothing, told_apart, _FINE * large):
        return None
    if large > _ALIKE * (small := max(small, nothing)):
        return math.copysign(2.0 ** _roundest(math.log2(small), math.log2(large)), low + high)
    if round_ones:
        return _roundest(low, high)
    told = (rounded((low + high) / 2, up=up, digits=digits) for up in (False, True))
    return next((value for value in told if low < value < high), None)


def _roundest(low: float, high: float) -> float:
    """The number of fewest binary places between two others."""
    step = 2.0 ** math.frexp(max(abs(low), abs(high)))[1]
    while (found := (math.floor(low / step) + 1) * step) >= high:
        step /= 2
    return found


def nearer(refusal: ParameterError, holds: Callable[[float], bool]) -> ParameterError:
    """The same refusal where more holds than it knew: its limit is sought between what was given and what it offers."""

    def cure() -> Nearest | None:
        own, given = refusal.nearest, refusal.value
        if own is None or not (isinstance(own.value, float) and isinstance(given, float)):
            return own
        found = nearest(holds, given, own.value)
        # a value that alone works is no limit
        return own if found is not None and found.value == own.value else found

    return refusal.told_of(refusal.name, refusal.value, cure)


class Suspect(Record):
    """A parameter that may be to blame: its value, one that takes it out of play, and whether a value of it works."""

    name: str
    value: float
    harmless: float
    works: Callable[[float], bool]
    # after the point of what is sought; an angle in rad wants 7
    digits: int = 4


def blamed(suspects: Iterable[Suspect], first: str) -> Suspect | None:
    """The first suspect that alone can cure a refusal, the one named ``first`` before the others; else None."""
    ordered = sorted(suspects, key=lambda s: s.name != first)
    return next((s for s in ordered if s.value != s.harmless and kept(s.works, s.harmless)), None)


def last_that_holds(holds: Callable[[float], object], fails: float, works: float = 0.0, steps: int = 24) -> float:
    """The value nearest to one that ``fails`` at which something can be made, halved from one that ``works``.

    ``holds``: False or a ``GeometryError`` is a no.
    """
    for _ in range(steps):
        middle = (works + fails) / 2
        try:
            good = holds(middle) is not False
        except GeometryError:
            good = False
        works, fails = (middle, fails) if good else (works, middle)
    return works


def moved(build: Callable[[float], V], offset: float, code: str = "") -> V:
    """What ``build`` makes of an offset out of the material, mm; ``code``: why one fails that does not say it itself.

    Raises
    ------
    GeometryError
        Nothing can be made even without an offset: as ``build`` says it.
    OffsetError
        Nothing can be made at this one; names the nearest that works.
    """
    if not math.isfinite(offset):
        raise OffsetError(offset, "not_finite")
    try:
        return build(offset)
    except GeometryError as refusal:
        if offset == 0:
            raise
        build(0.0)
        code = refusal.reason if isinstance(refusal, OffsetError) else code or str(refusal.args[-1])
        raise OffsetError(offset, code, last_that_holds(build, offset)) from refusal
