"""How one instance of a scene stands to another one in space: where axes lie, or go round with what lies."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from geometry.base.record import Record
from geometry.curves.curve import Real
from geometry.kinematics.mechanism import one_line, parallel
from parts.scene.relative_path import MOST_CYCLES, PER_CYCLE, SPREAD, Course, common_period
from parts.scene.shapes import Shape
from parts.scene.standing import Instance

# what is one place or one direction, mm and parts of 1
_SAME = 1e-7
_Size = tuple[float, float, float]


class SpacePath(Record):
    """The second as seen from the first over one period: ``length`` (mm) bounds how far any of its points has gone.

    ``times`` and ``length`` belong together, ``free`` (mm) is what cylinders about both leave there; ``share`` of the
    period is looked at. The own turns of what is ``round_`` about its axis are left out.
    """

    course: Course
    pair: tuple[Instance, Instance]
    round_: tuple[bool, bool]
    share: float
    times: Real
    length: Real
    free: Real

    def seen(self, times: Real) -> tuple[Real, Real]:
        """Turns (n, 3, 3) and places (n, 3), mm, of the second's frame in the first's."""
        return _seen(self.course, self.pair, self.round_, times)


def space_path(
    pair: tuple[Instance, Instance], shapes: tuple[Shape, Shape], course: Course, round_: tuple[bool, bool]
) -> SpacePath | None:
    """The path of a pair over its period; None of one that stands still on each other."""
    once = {i.id for i in pair} & course.once
    rates = {Fraction(1)} if once else _rates(course, pair, shapes, round_)
    fastest = max([Fraction(0), *map(abs, rates)])
    if once:
        fastest = max(abs(x) for i in pair for x in course.rates.get(i.id, (Fraction(1),)))
    if not fastest:
        return None
    period = common_period(rates)
    cycles = float(period * fastest)
    share = min(1.0, MOST_CYCLES / cycles)
    times = np.linspace(0.0, float(period) * share, int(PER_CYCLE * max(1.0, cycles * share)) + 1)
    probe = times[-1] * np.concatenate([[0.0], SPREAD])
    if all(float(np.abs(x - x[:1]).max()) <= _SAME for x in _seen(course, pair, round_, probe)):
        return None
    turned, frames = _seen(course, pair, round_, times)
    one, two, ways = _size(shapes[0]), _size(shapes[1]), np.array([0.0, 0.0, 1.0])
    places = frames + turned @ ways * two[2] - ways * one[2]
    # the angle between neighbours, by the chord of their matrices
    chords = np.linalg.norm(np.diff(turned, axis=0), axis=(1, 2)) / math.sqrt(8)
    angles = 2 * np.arcsin(np.minimum(chords, 1.0))
    # seen from the second it is the same motion: the smaller bound counts
    back = -np.einsum("nji,nj->ni", turned, places)
    gone = [np.linalg.norm(np.diff(at, axis=0), axis=1) + math.hypot(*size[:2]) * angles
            for at, size in ((places, two), (back, one))]  # fmt: skip
    length = np.concatenate([[0.0], np.cumsum(np.minimum(*gone))]) * (1 + 2.0 / PER_CYCLE)
    return SpacePath(course, pair, round_, share, times, length, _free(turned, (places, back), (one, two)))


def coaxial(pair: tuple[Instance, Instance]) -> bool:
    """Whether both stand on one line, their axes pointing either way."""
    one, two = pair
    way = np.subtract(two.at, one.at)
    beside = way - float(way @ np.array(one.axis)) * np.array(one.axis)
    return bool(parallel(one.axis, two.axis)) and float(np.linalg.norm(beside)) <= _SAME


def lift_between(pair: tuple[Instance, Instance], course: Course) -> float | None:
    """How far the second stays above the first along its axis, mm; None of axes that are not one direction, or vary."""
    if parallel(pair[0].axis, pair[1].axis) != 1:
        return None
    slowest = max([1.0, *(float(1 / abs(step.rate)) for i in pair for step in course.chains[i.id] if step.rate)])
    turned, places = _seen(course, pair, (False, False), slowest * np.concatenate([[0.0], SPREAD]))
    heights = places[:, 2]
    stays = np.ptp(heights) <= _SAME and (1 - turned[:, 2, 2]).max() <= _SAME**2
    return float(heights[0]) if stays else None


def _seen(course: Course, pair: tuple[Instance, Instance], round_: tuple[bool, bool], times: Real) -> tuple[Real, Real]:
    (turned, place), (other, there) = (
        course.placed(i.id, times, own=not whole) for i, whole in zip(pair, round_, strict=True)
    )
    return np.einsum("nji,njk->nik", turned, other), np.einsum("nji,nj->ni", turned, there - place)


def _rates(
    course: Course, pair: tuple[Instance, Instance], shapes: tuple[Shape, Shape], round_: tuple[bool, bool]
) -> set[Fraction]:
    """How often everything comes again by which a pair stands otherwise; on one line only the difference counts."""
    one, two = (list(course.chains[i.id]) for i in pair)
    while one and two and one[-1].body == two[-1].body:
        one.pop()
        two.pop()
    laws = {step.rate for step in (*one, *two) if step.by_law}
    one, two = ([step for step in chain if not step.by_law] for chain in (one, two))
    alike: list[dict[str, int]] = []
    for i, whole, shape, chain in zip(pair, round_, shapes, (one, two), strict=True):
        own = i.id in course.spins and chain
        alike.append({chain[0].body.link: 0 if whole else shape.count(0.0, shape.reach)} if own else {})
    turning: list[tuple[Fraction, int]] = []
    if one and two and one_line(one[-1].body, two[-1].body):
        low, other = one.pop(), two.pop()
        counts = alike[0].get(low.body.link, 1), alike[1].get(other.body.link, 1)
        sense = parallel(low.body.axis, other.body.axis)
        turning.append((low.rate - sense * other.rate, math.lcm(*counts)))
    for chain, own_count in zip((one, two), alike, strict=True):
        turning += [(step.rate, own_count.get(step.body.link, 1)) for step in chain]
    return ({rate * count for rate, count in turning} | laws) - {Fraction(0)}


def _size(shape: Shape) -> _Size:
    """Radius, half the height, and the height of the middle, mm."""
    return shape.reach, (shape.high - shape.low) / 2, (shape.high + shape.low) / 2


def _free(turned: Real, places: tuple[Real, Real], sizes: tuple[_Size, _Size]) -> Real:
    """What a ball about each, or planes and a cylinder about either one's axis, leave between both, mm."""
    cosine = np.abs(turned[:, 2, 2])
    sine = np.sqrt(np.maximum(1 - cosine**2, 0.0))
    found: Real = np.linalg.norm(places[0], axis=1) - sum(math.hypot(*size[:2]) for size in sizes)
    one, two = sizes
    for at, own, other in ((places[0], one, two), (places[1], two, one)):
        above = np.abs(at[:, 2]) - own[1] - (other[1] * cosine + other[0] * sine)
        beside = np.hypot(at[:, 0], at[:, 1]) - own[0] - (other[1] * sine + other[0])
        found = np.maximum(found, np.maximum(above, beside))
    return found
