"""How one moving instance of a scene stands to another one, over the period after which both stand alike."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from typing import Protocol

import numpy as np

from geometry.base.record import Record, field
from geometry.curves.curve import Complex, Real
from parts.scene.shapes import Shape, free_between
from parts.scene.standing import Instance
from parts.scene.train import Train, Turning

# samples of a path for each cycle of its fastest rate; cycles at most, of axes alone too, of which the rest is told
PER_CYCLE, MOST_CYCLES, _MOST_OF_AXES = 720, 400, 2000
# what is one place, mm; one angle, rad; one pose, mm or share of a turn
_SAME, _SAME_ANGLE, _ALIKE = 1e-7, 1e-9, 1e-6
# samples in a part that may repeat; times that are tried where two pairs may stand alike, and how often each is
# made better
_LEAST_PART, _TRIED, _HALVINGS = 36, 8, 40
SPREAD = np.arange(1, 34) * (math.sqrt(5) - 1) / 2 % 1.0


class Placed(Protocol):
    """Turns (n, 3, 3) and places (n, 3), mm, of an instance at many t."""

    def __call__(self, key: str, t: Real, *, own: bool) -> tuple[Real, Real]: ...


def _nowhere(key: str, t: Real, *, own: bool) -> tuple[Real, Real]:
    raise KeyError(key)


class Course(Record):
    """How a scene's drives move it together; t is the share of what they are asked for.

    ``pose``: axes (mm) and angles (rad) of an instance at many t. ``rates``: of each instance that moves its turns for
    one t, then those of whatever carries it, from the nearest one. ``once``: what slides or turns unevenly, which is
    followed on the way that is asked for alone.

    In space: ``placed`` gives turns (n, 3, 3) and places (n, 3) of any instance, with its ``own`` turn or as what
    carries it goes; ``chains``: what turns it; ``in_space``: what ``pose`` does not tell; ``spins``: what turns about
    its own axis.
    """

    pose: Callable[[str, Real], tuple[Complex, Real]]
    rates: Mapping[str, tuple[Fraction, ...]]
    once: frozenset[str] = frozenset()
    placed: Placed = _nowhere
    chains: Mapping[str, tuple[Turning, ...]] = field(default_factory=dict)
    in_space: frozenset[str] = frozenset()
    spins: frozenset[str] = frozenset()


def course_of(train: Train, instances: Iterable[str]) -> Course:
    """The course of a scene's train."""
    keys = list(instances)
    told = {key: train.rates(key) for key in keys}
    most = Fraction(math.ceil(max([1.0, *(abs(x) for turned in train.turned for x in turned.values())])))
    rates = {key: (most,) if chain is None else chain for key, chain in told.items()}
    once = frozenset(key for key, chain in told.items() if chain is None)
    moves = {key: chain for key, chain in rates.items() if any(chain)}
    chains = {key: train.chain(key) for key in keys}
    spins = frozenset(key for key in keys if train.spins(key))
    return Course(train.along, moves, once, train.placed, chains, train.in_space, spins)


class Path(Record):
    """The second as seen from the first, ``seen`` at any times; ``length``: how far any of its points has gone at most.

    ``times`` and ``length`` (mm) belong together; ``distances`` (mm) are those of the axes at these times, ``stands``
    what is alike (n, 3) where the pair stands alike. ``share`` of the ``period`` is looked at.
    """

    seen: Callable[[Real], tuple[Complex, Real]]
    counts: tuple[int, int]
    period: Fraction
    share: float
    times: Real
    length: Real
    distances: Real
    stands: Complex

    def is_like(self, other: Path) -> bool:
        """Whether this pair passes through the same poses as another one of the same parts, at some other time."""
        if (self.period, self.counts) != (other.period, other.counts) or self.share < 1:
            return False
        probe = np.concatenate([[0.0], float(self.period) * SPREAD])
        wanted = _stands(*self.seen(probe), self.counts)
        off = np.abs(other.stands - wanted[0]).max(axis=1)
        # the nearest times of all, then nearer
        for start in other.times[np.argsort(off)[:_TRIED]]:
            step, late = float(other.times[1]), float(start)
            for _ in range(_HALVINGS):
                tried = late + step * np.array([-1.0, -0.5, 0.0, 0.5, 1.0])
                late = float(tried[np.abs(_stands(*other.seen(tried), self.counts) - wanted[0]).max(axis=1).argmin()])
                step /= 2
            if float(np.abs(_stands(*other.seen(probe + late), self.counts) - wanted).max()) <= _ALIKE:
                return True
        return False


def path_of(pair: tuple[Instance, Instance], shapes: tuple[Shape, Shape], course: Course) -> Path | None:
    """The path over one period of a pair, None of one that stands still on each other, or turns what is round."""
    one, two = _chains(course, pair)
    rates = {x - one[0] for x in (*one, *two)} - {Fraction(0)}
    if not rates:
        return None
    fastest = float(max(map(abs, rates)))
    # spread over the whole, so that no dwell is taken for rest
    probe = min(float(common_period(rates)), MOST_CYCLES / fastest) * np.concatenate([[0.0], SPREAD])
    places, turns = _seen(course, pair, probe)
    still = float(np.abs(places - places[0]).max()) <= _SAME
    coaxial = float(np.abs(places).max()) <= _SAME
    counts = _counts(np.abs(places), shapes)
    if still and (float(np.abs(np.exp(1j * turns) - np.exp(1j * turns[0])).max()) <= _SAME_ANGLE or not counts[1]):
        return None
    if coaxial and not all(counts):
        return None
    once = bool({i.id for i in pair} & course.once)
    period = Fraction(1) if once else _period(places, probe, (one, two), counts, rates)
    cycles = max(float(period) * fastest, 1e-9)
    share = min(1.0, MOST_CYCLES / cycles)
    start = 0.0
    if share < 1:
        # the axes may go round far slower than both turn: the looked at part lies about their worst place
        slow, free, is_whole = _axes_free(course, pair, shapes, (one, two))
        if is_whole and stays_free(free):
            return None
        start = float(slow[free.argmin()]) - float(period) * share / 2
    times = start + np.linspace(0.0, float(period) * share, int(PER_CYCLE * max(1.0, cycles * share)) + 1)
    places, turns = _seen(course, pair, times)
    turned = np.unwrap(turns)
    # seen from the second it is the same motion: the smaller bound counts
    back = -places * np.exp(-1j * turned)
    steps = np.minimum(
        np.abs(np.diff(places)) + shapes[1].reach * np.abs(np.diff(turned)),
        np.abs(np.diff(back)) + shapes[0].reach * np.abs(np.diff(turned)),
    )
    # an arc is longer than its chord
    length = np.concatenate([[0.0], np.cumsum(steps)]) * (1 + 2.0 / PER_CYCLE)
    stands = _stands(places, turned, counts)
    parts = _repeats(stands) if once and share == 1 else 1
    kept = slice(0, (len(times) - 1) // parts + 1)
    return Path(lambda t: _seen(course, pair, t), counts, period / parts, share, times[kept], length[kept],
                np.abs(places[kept]), stands[kept])  # fmt: skip


def _repeats(stands: Complex) -> int:
    """Into how many equal parts of its way a pair falls that stands alike in all of them, by every sample."""
    steps = len(stands) - 1
    for parts in range(steps // _LEAST_PART, 1, -1):
        if steps % parts == 0:
            size = steps // parts
            if float(np.abs(stands[size:] - stands[:-size]).max()) <= _ALIKE:
                return parts
    return 1


def _axes_free(
    course: Course,
    pair: tuple[Instance, Instance],
    shapes: tuple[Shape, Shape],
    chains: tuple[tuple[Fraction, ...], tuple[Fraction, ...]],
) -> tuple[Real, Real, bool]:
    """What circles leave, mm, at times over the period of the distance of the axes, which only carriers change; whether
    these are all of it.
    """
    carriers = {*chains[0][1:], *chains[1][1:]}
    rates = {x - y for x in carriers for y in carriers} - {Fraction(0)}
    fastest = float(max(rates, default=Fraction(1)))
    whole = float(common_period(rates)) * fastest
    cycles = min(whole, float(_MOST_OF_AXES))
    times = np.linspace(0.0, cycles / fastest, int(PER_CYCLE * max(1.0, cycles)) + 1)
    return times, free_between(np.abs(_seen(course, pair, times)[0]), shapes), cycles == whole


def stays_free(free: Real) -> bool:
    """Whether what circles leave, mm, stays above 0 between its samples too: there it falls by half a step at most."""
    return bool(free.min() > (0.5 + 1.0 / PER_CYCLE) * np.abs(np.diff(free)).max(initial=0.0))


def _chains(course: Course, pair: tuple[Instance, Instance]) -> tuple[tuple[Fraction, ...], tuple[Fraction, ...]]:
    """Rates of both and of what carries them, as far as the first that carries both: the frame at last."""
    one, two = ((*course.rates.get(i.id, (Fraction(0),)), Fraction(0)) for i in pair)
    base = next(rate for rate in one[1:] if rate in two[1:])
    return one[: one.index(base, 1) + 1], two[: two.index(base, 1) + 1]


def _seen(course: Course, pair: tuple[Instance, Instance], times: Real) -> tuple[Complex, Real]:
    """Axis and angle of the second in the frame of the first."""
    (place, angle), (other, turn) = (course.pose(i.id, times) for i in pair)
    return np.asarray((other - place) * np.exp(-1j * angle)), np.asarray(turn - angle)


def _stands(places: Complex, turns: Real, counts: tuple[int, int]) -> Complex:
    """Numbers that are equal where a pair stands alike: the distance, the line of centres in the first, and the second
    against that line, each modulo the symmetry of its part; of coaxial ones the turn alone.
    """
    distance = np.abs(places)
    line = np.where(distance > _SAME, places / np.maximum(distance, _SAME), 1.0)
    own = line ** counts[0] if counts[0] else np.ones_like(line)
    other = (np.exp(1j * turns) / line) ** counts[1] if counts[1] else np.ones_like(line)
    if distance.max() <= _SAME:
        other = np.exp(1j * turns * math.lcm(*counts))
    return np.stack([distance + 0j, own, other], axis=-1)


def _period(
    places: Complex,
    probe: Real,
    chains: tuple[tuple[Fraction, ...], tuple[Fraction, ...]],
    counts: tuple[int, int],
    rates: set[Fraction],
) -> Fraction:
    """After how long a pair stands alike: the second's axis goes round at the rates of what carries either."""
    own, other = chains[0][0], chains[1][0]
    carriers = sorted({*chains[0][1:], *chains[1][1:]})
    waves = np.exp(2j * math.pi * np.outer(probe, [float(x - own) for x in carriers]))
    arms, *_ = np.linalg.lstsq(waves, places, rcond=None)
    if float(np.abs(waves @ arms - places).max()) > _SAME:
        # a law is in it: what it is made of repeats
        return common_period(rates)
    around = [x for x, arm in zip(carriers, arms, strict=True) if abs(arm) > _SAME]
    if not around:
        return common_period({(other - own) * math.lcm(*counts)})
    found = {x - around[0] for x in around} | {counts[0] * (around[0] - own), counts[1] * (other - around[0])}
    return common_period(found)


def _counts(distances: Real, shapes: tuple[Shape, Shape]) -> tuple[int, int]:
    """How often each of a pair looks alike in a turn where the other one reaches."""
    near, far = float(distances.min()), float(distances.max())
    one, two = shapes
    return one.count(near - two.reach, far + two.reach), two.count(near - one.reach, far + one.reach)


def common_period(rates: Iterable[Fraction]) -> Fraction:
    """The time after which all rates have made whole turns; 1 where nothing turns."""
    periods = [1 / abs(rate) for rate in rates if rate]
    if not periods:
        return Fraction(1)
    return Fraction(math.lcm(*(p.numerator for p in periods)), math.gcd(*(p.denominator for p in periods)))
