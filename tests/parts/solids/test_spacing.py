"""Where splines are cut: even where they are bent evenly, else as near as chords ask for, and no faster than said."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import pytest

from geometry.curves.curve import Real
from geometry.solids.charts import Patch
from geometry.solids.faces import SplineSurface
from parts.solids.spacing import Bends, bend_places, graded


@pytest.mark.parametrize(
    ("knots", "each"),
    [
        ((0, 1), 48),
        ((2, 4, 5), 24),
        (tuple(range(6)), 10),
        (tuple(range(12)), 5),
        (tuple(range(13)), 4),
        ((0, *range(7, 27)), 4),
    ],
)
def test_a_bend_is_looked_at_in_every_span_alike(knots: tuple[int, ...], each: int) -> None:
    """Four times in each span, more where there are fewer than 48 of them in all."""
    spans = [(k - knots[0]) / (knots[-1] - knots[0]) for k in knots]
    expected = [a + (b - a) * k / each for a, b in pairwise(spans) for k in range(each)]
    found = bend_places(np.array([knots[0], *knots, knots[-1]], dtype=float))
    assert found == pytest.approx([*expected, 1.0], abs=1e-14)


@pytest.mark.parametrize("bend", [0.0, 1e-7, 0.5, 8.0, 201.0])
@pytest.mark.parametrize("sag", [0.01, 0.3])
def test_a_curve_bent_evenly_is_cut_evenly(bend: float, sag: float) -> None:
    """A chord over a share h leaves it by h^2 b / 8."""
    count = max(1, math.ceil(math.sqrt(bend / (8 * sag)) - 1e-9))
    found = graded(np.linspace(0, 1, 49), np.full(49, bend), sag)
    assert found == pytest.approx(np.linspace(0, 1, count + 1), abs=1e-12)
    assert (1 / count) ** 2 * bend / 8 <= sag * (1 + 1e-9)


def passed(places: Real, bends: Real, sag: float, share: float) -> float:
    """How many chords there are from 0 to a share: the integral of one over their lengths, by the trapezium rule."""
    lengths = [
        min(
            math.sqrt(8 * sag / max(float(b), 1e-6 * sag)) + abs(float(x - y)) / 2
            for y, b in zip(places, bends, strict=True)
        )
        for x in places
    ]
    found = 0.0
    for k in range(1, len(places)):
        a, b = float(places[k - 1]), float(places[k])
        part = min(max(share - a, 0.0), b - a) / (b - a)
        found += part * (b - a) * (1 / lengths[k - 1] + 1 / lengths[k]) / 2
    return found


@pytest.mark.parametrize(
    "bends", [(1, 1, 1, 1, 400, 1, 1), (0, 0, 0, 0, 0, 0, 300), (50, 40, 30, 20, 10, 5, 1), (0, 0, 0, 0, 0, 0, 0)]
)
def test_chords_are_as_many_between_shares_as_their_lengths_say(bends: Sequence[float]) -> None:
    """No length grows by more than half a share from one place to another: near a sharp bend all chords are short."""
    places, own, sag = np.array([0.0, 0.1, 0.2, 0.45, 0.5, 0.7, 1.0]), np.array(bends, dtype=float), 0.02
    whole = passed(places, own, sag, 1.0)
    found = graded(places, own, sag)
    count = max(1, math.ceil(whole))
    assert len(found) == count + 1
    assert (found[0], found[-1]) == (0.0, 1.0)
    for k, share in enumerate(found.tolist()):
        assert passed(places, own, sag, share) == pytest.approx(whole * k / count, rel=1e-9, abs=1e-9)


def quadric(a: float, b: float, c: float, d: float = 0.0, e: float = 0.0) -> Real:
    """The net (3, 3, 3) of z = a u^2 + b v^2 + c u v + d u + e v over the unit square."""
    line, square, one = np.array([0, 0.5, 1]), np.array([0, 0, 1.0]), np.ones(3)
    z = a * np.outer(square, one) + b * np.outer(one, square) + c * np.outer(line, line)
    z += d * np.outer(line, one) + e * np.outer(one, line)
    return np.stack([np.outer(line, one), np.outer(one, line), z], axis=-1)


def bends(*nets: Real) -> Bends:
    knots = np.array([0.0, 0, 0, 1, 1, 1])
    return Bends(Patch(SplineSurface((2, 2), knots, knots, np.arange(9).reshape(1, 3, 3)), np.stack(nets)))


NETS = [(0.3, 0.1, 0.2), (0.05, 0.4, -0.3, 0.2, 0.5), (0.0, 0.0, 0.25), (0.2, 0.01, 0.0), (0.0, 0.0, 0.0)]


@pytest.mark.sampled(2)
@pytest.mark.parametrize("net", NETS)
def test_bends_are_those_of_the_second_form(net: tuple[float, ...]) -> None:
    """L, M and N of z(u, v); M asks for chords both ways, more where the mean bend is more."""
    found = bends(quadric(*net))
    a, b, c, d, e = (*net, 0.0, 0.0)[:5]
    u, v = np.meshgrid(np.linspace(0, 1, 49), np.linspace(0, 1, 49), indexing="ij")
    long = np.sqrt(1 + (2 * a * u + c * v + d) ** 2 + (2 * b * v + c * u + e) ** 2)
    along, twist, across = abs(2 * a) / long, abs(c) / long, abs(2 * b) / long
    share = math.sqrt((along + twist).mean() / max((across + twist).mean(), 1e-300))
    assert found.along == pytest.approx(along + share * twist, rel=1e-9, abs=1e-12)
    assert found.across == pytest.approx(across + (twist / share if share else 0.0), rel=1e-9, abs=1e-12)


def test_of_patches_on_one_net_the_most_bent_counts_place_by_place() -> None:
    nets = quadric(0.3, 0.1, 0.0), quadric(0.1, 0.1, 0.0, 0.4)
    own = [bends(net).along for net in nets]
    assert bends(*nets).along == pytest.approx(np.maximum(*own), rel=1e-12)


def test_chords_and_rows_are_those_of_a_parabola() -> None:
    """z = a u^2 + b v^2, nearly flat: 2 a / (8 sag) to the half along u, as many along v as b asks for."""
    a, b, sag = 4e-4, 1e-4, 1e-6
    # all but even: slopes are of the order of 1e-3
    u, v = math.sqrt(2 * a / (8 * sag)), math.sqrt(2 * b / (8 * sag))
    found = bends(quadric(a, b, 0.0))
    assert found.chords(sag) == (math.ceil(u - 1e-3), math.ceil(v - 1e-3)) == (10, 5)
    t, rows = found.rows(sag)
    assert t == pytest.approx(np.arange(1, 5) / 5, abs=1e-5)
    assert len(rows) == 4
    for row in rows:
        assert row == pytest.approx(np.arange(1, 10) / 10, abs=1e-5)
    assert found.chords(9 * sag) == (4, 2)


def test_what_is_not_bent_has_one_row_in_its_middle() -> None:
    found = bends(quadric(0.0, 0.0, 0.0, 1.0, 2.0))
    assert found.chords(0.1) == (1, 1)
    t, rows = found.rows(0.1)
    assert t.tolist() == [0.5]
    assert [row.tolist() for row in rows] == [[0.5]]


LINE, SQUARE, CUBE, ONE = np.arange(4) / 3, np.array([0, 0, 1 / 3, 1]), np.array([0, 0, 0, 1.0]), np.ones(4)


def cubic(z: Real) -> Bends:
    """Of a height over the unit square on a net of degree 3."""
    knots = np.array([0.0, 0, 0, 0, 1, 1, 1, 1])
    net = np.stack([np.outer(LINE, ONE), np.outer(ONE, LINE), z], axis=-1)[None]
    return Bends(Patch(SplineSurface((3, 3), knots, knots, np.arange(16).reshape(1, 4, 4)), net))


@pytest.mark.parametrize("falls", [False, True])
def test_rows_are_as_fine_as_the_bend_between_their_neighbours(falls: bool) -> None:
    """z = c v u^3 is bent along u the more, the greater v is: a row looks from the one before to the one after it."""
    # a little of v^2 makes rows
    z = 1e-4 * np.outer(CUBE, LINE) + 2e-5 * np.outer(ONE, SQUARE)
    sag = 1e-7
    found = cubic(z[:, ::-1] if falls else z)
    t, rows = found.rows(sag)
    assert len(t) == len(rows) >= 3
    places = np.linspace(0, 1, 49)
    assert t == pytest.approx(graded(places, found.across.max(axis=0), sag)[1:-1], abs=1e-12)
    for before, after, row in zip([0.0, *t[:-1]], [*t[1:], 1.0], rows, strict=True):
        low, high = int(np.flatnonzero(places < before).max(initial=0)), int(np.flatnonzero(places >= after - 1e-12)[0])
        most = found.along[:, low : high + 1].max(axis=1)
        assert row == pytest.approx(graded(places, most, sag)[1:-1], abs=1e-12)
    assert (len(rows[-1]) > len(rows[0])) is not falls
    along, across = found.along.max(axis=1), found.across.max(axis=0)
    assert found.chords(sag) == (len(graded(places, along, sag)) - 1, len(graded(places, across, sag)) - 1)
    assert found.chords(sag)[0] > found.chords(sag)[1]


def test_of_two_chords_the_one_that_is_bent_more_is_shorter() -> None:
    """z = u^3 + v^3: the middle place stands where half of both is passed, not at half."""
    z, sag = 1e-4 * (np.outer(CUBE, ONE) + np.outer(ONE, CUBE)), 2.5e-5
    t, (row,) = cubic(z).rows(sag)
    assert (len(t), len(row)) == (1, 1)
    middle = graded(np.linspace(0, 1, 49), 6e-4 * np.linspace(0, 1, 49), sag)[1]
    assert middle > 0.55
    assert [*t, *row] == pytest.approx([middle, middle], abs=1e-6)


@pytest.mark.parametrize(
    ("net", "rising"),
    [
        # with and against the twist: up goes the diagonal along which there is less bend
        ((0.2, 0.2, 0.3), False),
        ((0.2, 0.2, -0.3), True),
        ((-0.2, -0.2, 0.3), True),
        ((0.05, 0.3, 0.2), False),
        ((0.05, 0.3, -0.2), True),
        # both alike
        ((0.0, 0.0, 0.3), True),
        ((0.3, 0.1, 0.0), True),
        ((0.0, 0.0, 0.0), True),
        ((0.0, 0.3, 0.0), True),
    ],
)
def test_diagonals_go_where_there_is_less_bend(net: tuple[float, ...], rising: bool) -> None:
    assert bends(quadric(*net)).rising is rising
