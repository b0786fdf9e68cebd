"""After how long a pair stands alike: found by trying it, with the teeth of both, and that no part of it does."""

from __future__ import annotations

import cmath
import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from geometry.curves.curve import Complex, Real
from parts.scene.relative_path import Course, path_of
from parts.scene.standing import Instance

# of each body how far its axis is from the frame's, and its turns for one t: its own, then those of what carries it
Body = tuple[complex, tuple[int, ...]]


class Toothed:
    """A shape that looks alike so often wherever it is met."""

    def __init__(self, teeth: int, reach: float) -> None:
        self.teeth, self.reach = teeth, reach

    def count(self, near: float, far: float) -> int:
        assert near < far
        return self.teeth


def path(bodies: tuple[Body, Body], teeth: tuple[int, int]) -> Any:
    """The path of a pair; a carried body's axis goes round the origin with its carrier."""

    def pose(key: str, t: Real) -> tuple[Complex, Real]:
        arm, rates = bodies[int(key)]
        around = rates[1] if len(rates) > 1 else 0
        return arm * np.exp(2j * math.pi * around * np.asarray(t)), 2 * math.pi * rates[0] * np.asarray(t)

    course = Course(pose, {str(k): tuple(map(Fraction, rates)) for k, (_, rates) in enumerate(bodies)})
    shapes: Any = tuple(Toothed(z, 10.0) for z in teeth)
    return path_of((Instance("0", "p"), Instance("1", "p")), shapes, course)


def is_alike(made: Any, after: float, teeth: tuple[int, int]) -> bool:
    """Whether the pair stands alike that much later, at any time: turned by whole teeth of each."""
    t = np.linspace(0.0, 1.0, 41)
    (here, turn), (there, turned) = made.seen(t), made.seen(t + after)
    for k in range(teeth[0]):
        step = 2 * math.pi * k / teeth[0]
        rest = (turned - turn - step) * teeth[1] / (2 * math.pi)
        if np.abs(there - here * cmath.exp(1j * step)).max() < 1e-6 and np.abs(rest - np.round(rest)).max() < 1e-6:
            return True
    return False


PAIRS: dict[str, tuple[tuple[Body, Body], tuple[int, int]]] = {
    "two axes that stand": (((0.0, (2,)), (30.0, (-3,))), (9, 12)),
    "satellite and sun": (((30.0, (-2, 1)), (0.0, (4,))), (20, 30)),
    "sun and satellite": (((0.0, (4,)), (30.0, (-2, 1))), (30, 20)),
    "of one carrier": (((30.0, (-2, 1)), (-30.0, (5, 1))), (6, 4)),
    "of two carriers": (((30.0, (-2, 1)), (45.0, (3, 2))), (4, 6)),
    "with the same axis": (((0.0, (2,)), (0.0, (-3,))), (4, 6)),
    "a still one": (((30.0, (0,)), (0.0, (5,))), (7, 8)),
}


@pytest.mark.parametrize("name", PAIRS)
def test_a_pair_stands_alike_after_its_period_and_no_sooner(name: str) -> None:
    bodies, teeth = PAIRS[name]
    made = path(bodies, teeth)
    assert made is not None
    assert made.share == 1.0
    assert is_alike(made, float(made.period), teeth)
    for part in (2, 3, 5, 7):
        assert not is_alike(made, float(made.period) / part, teeth)
    # it is looked at from its beginning to its end; no point goes farther than is told
    assert (made.times[0], made.times[-1]) == (0.0, pytest.approx(float(made.period)))
    places, turns = made.seen(made.times)
    rim = 10.0 * np.exp(1j * math.pi / 6 * np.arange(12))
    from_first = places[:, None] + np.exp(1j * turns)[:, None] * rim
    from_second = (rim - places[:, None]) * np.exp(-1j * turns)[:, None]
    ways = []
    for seen in (from_first, from_second):
        ways.append(np.concatenate([[0.0], np.cumsum(np.abs(np.diff(seen, axis=0)).max(axis=1))]))
    assert (made.length >= np.minimum(*ways) - 1e-9).all()
    assert made.length[-1] <= 2.1 * max(way[-1] for way in ways)
    assert made.distances == pytest.approx(np.abs(places))


def test_what_stands_still_to_each_other_has_no_path() -> None:
    assert path(((0.0, (2,)), (0.0, (2,))), (4, 6)) is None
    assert path(((30.0, (1, 1)), (-30.0, (1, 1))), (4, 6)) is None
    # round ones about one axis, and a round one that turns where it stands
    assert path(((0.0, (2,)), (0.0, (-3,))), (0, 6)) is None
    assert path(((30.0, (0,)), (0.0, (5,))), (7, 0)) is None


@pytest.mark.parametrize(
    ("teeth", "phase", "alike"),
    [
        # 6 (3 t + 1/4) and 10 (3 t - 1/4) are whole at t = 1/12
        ((6, 10), 0.25, True),
        # 20 (3 t + 1/3) and 20 (3 t - 1/3) are never both whole
        ((20, 20), 1 / 3, False),
        ((30, 30), 1 / 3, True),
        ((6, 10), 0.2501, False),
    ],
)
def test_satellites_are_alike_where_one_comes_through_the_poses_of_another(
    teeth: tuple[int, int], phase: float, alike: bool
) -> None:
    """The carrier turns once, the satellite back twice, the sun four times: at t the line of centres has gone 3 t in
    the satellite, and the sun 3 t against it."""
    sun: Body = (0j, (4,))
    one, other = (path(((30 * cmath.exp(2j * math.pi * start), (-2, 1)), sun), teeth) for start in (0.0, phase))
    assert one.is_like(other) is alike
    assert other.is_like(one) is alike
    # neither farther out nor with other teeth
    assert not one.is_like(path(((30.01, (-2, 1)), sun), teeth))
    assert not one.is_like(path(((30.0, (-2, 1)), sun), (teeth[0], teeth[1] + 1)))


@pytest.mark.parametrize(("teeth", "parts"), [((6, 0), 6), ((5, 0), 1), ((1, 0), 1)])
def test_what_moves_by_a_law_is_followed_until_it_stands_alike(teeth: tuple[int, int], parts: int) -> None:
    """Six turns of a crank, each of which moves a wheel on by a sixth: alike after one of them if it has six slots."""

    def pose(key: str, t: Real) -> tuple[Complex, Real]:
        turn = 12 * math.pi * np.asarray(t)
        return (60 + 0 * turn, -(turn + np.sin(turn)) / 6) if key == "0" else (30 * np.exp(1j * turn), turn)

    course = Course(pose, {key: (Fraction(6),) for key in "01"}, frozenset("0"))
    shapes: Any = tuple(Toothed(z, 10.0) for z in teeth)
    made = path_of((Instance("0", "p"), Instance("1", "p")), shapes, course)
    assert made is not None
    assert made.period == Fraction(1, parts)
    assert made.times[-1] == pytest.approx(1 / parts)
    assert made.length[-1] > 2 * math.pi * 30 * 6 / parts
