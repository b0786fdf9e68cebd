"""How one moving instance of a scene stands to another one, over the period after which both stand alike."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction

import numpy as np

from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from parts.scene.placing import Instance, Placing
from parts.scene.shapes import Shape

# samples of a path for each cycle of its fastest rate; cycles at most, of which the rest is told
_PER_CYCLE, _MOST_CYCLES = 720, 400
# what is one place, mm; one angle, rad; one rate, turns; digits of a phase, a part of a period
_SAME, _SAME_ANGLE, _SAME_RATE, _DIGITS = 1e-7, 1e-9, 1e-6, 7
_TURN = 2 * math.pi
_SPREAD = np.arange(1, 34) * (math.sqrt(5) - 1) / 2 % 1.0


class Course(Record):
    """How a scene's drives move it; t is the share of what they are asked for.

    ``pose``: axes (mm) and angles (rad) of an instance at many t. ``rates``: of each instance that moves its turns for
    one t, then those of whatever carries it, from the nearest one. ``unknown``: what moves in ways that are not known.
    """

    pose: Callable[[str, Real], tuple[Complex, Real]]
    rates: Mapping[str, tuple[Fraction, ...]]
    unknown: frozenset[str] = frozenset()


class Path(Record):
    """The second as seen from the first, ``seen`` at any times; ``length``: how far any of its points has gone at most.

    ``times`` and ``length`` (mm) belong together; ``distances`` (mm) are those of the axes at these times.
    """

    seen: Callable[[Real], tuple[Complex, Real]]
    times: Real
    length: Real
    distances: Real
    share: float
    key: tuple[object, ...] | None


def path_of(pair: tuple[Instance, Instance], shapes: tuple[Shape, Shape], course: Course) -> Path | None:
    """The path over one period of a pair, None of one that stands still on each other, or turns what is round."""
    one, two = _chains(course, pair)
    rates = {x - one[0] for x in (*one, *two)} - {Fraction(0)}
    if not rates:
        return None
    whole = float(_common([1 / abs(rate) for rate in rates]))
    fastest = float(max(map(abs, rates)))
    # spread over the whole, so that no dwell is taken for rest; the second is near the first
    probe = np.concatenate([[0.0, 1e-3 / fastest], min(whole, _MOST_CYCLES / fastest) * _SPREAD])
    places, turns = _seen(course, pair, probe)
    still = float(np.abs(places - places[0]).max()) <= _SAME
    coaxial = float(np.abs(places).max()) <= _SAME
    counts = _counts(np.abs(places), shapes)
    if still and (float(np.abs(np.exp(1j * turns) - np.exp(1j * turns[0])).max()) <= _SAME_ANGLE or not counts[1]):
        return None
    if coaxial and not all(counts):
        return None
    period, key = _period(places, turns, probe, (one, two), counts, rates, coaxial=coaxial)
    cycles = max(float(period) * fastest, 1e-9)
    share = min(1.0, _MOST_CYCLES / cycles)
    times = np.linspace(0.0, float(period) * share, int(_PER_CYCLE * max(1.0, cycles * share)) + 1)
    places, turns = _seen(course, pair, times)
    turned = np.unwrap(turns)
    # seen from the second it is the same motion: the smaller bound counts
    back = -places * np.exp(-1j * turned)
    steps = np.minimum(
        np.abs(np.diff(places)) + shapes[1].reach * np.abs(np.diff(turned)),
        np.abs(np.diff(back)) + shapes[0].reach * np.abs(np.diff(turned)),
    )
    # an arc is longer than its chord
    length = np.concatenate([[0.0], np.cumsum(steps)]) * (1 + 2.0 / _PER_CYCLE)
    return Path(lambda t: _seen(course, pair, t), times, length, np.abs(places), share, key)


def _chains(course: Course, pair: tuple[Instance, Instance]) -> tuple[tuple[Fraction, ...], tuple[Fraction, ...]]:
    """Rates of both and of what carries them, as far as the first that carries both: the frame at last."""
    one, two = ((*course.rates.get(i.id, (Fraction(0),)), Fraction(0)) for i in pair)
    base = next(rate for rate in one[1:] if rate in two[1:])
    return one[: one.index(base, 1) + 1], two[: two.index(base, 1) + 1]


def _seen(course: Course, pair: tuple[Instance, Instance], times: Real) -> tuple[Complex, Real]:
    """Axis and angle of the second in the frame of the first."""
    (place, angle), (other, turn) = (course.pose(i.id, times) for i in pair)
    return np.asarray((other - place) * np.exp(-1j * angle)), np.asarray(turn - angle)


def _period(
    places: Complex,
    turns: Real,
    probe: Real,
    chains: tuple[tuple[Fraction, ...], tuple[Fraction, ...]],
    counts: tuple[int, int],
    rates: set[Fraction],
    *,
    coaxial: bool,
) -> tuple[Fraction, tuple[object, ...] | None]:
    """The turns t after which a pair stands alike, and what else stands so at some time.

    Of a pair a fixed distance apart the direction of the line of centres in the first, and the second's turn against
    it, each count modulo the symmetry of the part: two numbers that grow evenly, so a line on a torus.
    """
    own, other = chains[0][0], chains[1][0]
    if coaxial:
        alike = math.lcm(*counts)
        phase = float(turns[0]) / _TURN * alike
        return 1 / abs((other - own) * alike), ("coaxial", round(phase % 1.0, _DIGITS) % 1.0)
    distance = np.abs(places)
    direction = np.unwrap(np.angle(places))
    slope = float(direction[1] - direction[0]) / _TURN / float(probe[1])
    along = next((x - own for x in {*chains[0], *chains[1]} if abs(float(x - own) - slope) <= _SAME_RATE), None)
    if float(np.ptp(distance)) > _SAME or along is None:
        # everything it is made of repeats
        return _common([1 / abs(rate) for rate in rates]), None
    # what is round has no phase
    pace = along * counts[0], (other - own - along) * counts[1]
    phases = float(direction[0]) / _TURN * counts[0], float(turns[0] - direction[0]) / _TURN * counts[1]
    if not any(pace):
        return 1 / max(map(abs, rates)), None
    period = _common([1 / abs(p) for p in pace if p])
    loops = [int(p * period) for p in pace]
    line = (loops[1] * phases[0] - loops[0] * phases[1]) % 1.0
    return period, (round(float(distance[0]), _DIGITS), *loops, round(line, _DIGITS) % 1.0)


def _counts(distances: Real, shapes: tuple[Shape, Shape]) -> tuple[int, int]:
    """How often each of a pair looks alike in a turn where the other one reaches."""
    near, far = float(distances.min()), float(distances.max())
    one, two = shapes
    return one.count(near - two.reach, far + two.reach), two.count(near - one.reach, far + one.reach)


def _common(periods: Sequence[Fraction]) -> Fraction:
    """The least common multiple."""
    return Fraction(math.lcm(*(p.numerator for p in periods)), math.gcd(*(p.denominator for p in periods)))


def course_of(placing: Placing) -> Course:
    """How the drives of a scene move it; t is the share of what they are asked for."""
    assert placing.train is not None
    chains = {i.id: placing.train.rates(i.id) for i in placing.instances}
    rates = {key: chain for key, chain in chains.items() if chain and any(chain)}
    return Course(placing.train.along, rates, frozenset(key for key, chain in chains.items() if chain is None))
