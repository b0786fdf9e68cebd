"""Level lines of the plane against curves that are known: circles, hyperbolas, fields that are not everywhere."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from geometry.curves.implicit import Box, level_lines

Q = 1.7 + 0.3j


@pytest.mark.parametrize("cells", [5, 8, 12])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-4])
def test_a_circle_is_one_closed_line(cells: int, tolerance: float) -> None:
    """Points are on it, the middles of chords as near as asked, and it goes round once."""

    def field(x: float, y: float) -> float:
        return abs(complex(x, y) - Q) - 1.9

    (line,) = level_lines(field, Box(-1.0, 4.0, -2.0, 3.0, cells), tolerance)
    points = np.array(line)
    assert np.abs(np.abs(points - Q) - 1.9).max() < 1e-9
    assert line[0] == line[-1]
    middles = (points[1:] + points[:-1]) / 2
    assert np.abs(np.abs(middles - Q) - 1.9).max() <= tolerance * (1 + 1e-6)
    turned = np.angle((points[1:] - Q) / (points[:-1] - Q))
    assert abs(turned.sum()) == pytest.approx(2 * math.pi)
    assert (np.sign(turned) == np.sign(turned[0])).all()
    # no more points than four times what arcs of that height take
    assert len(line) < 4 * max(math.pi / math.acos(1 - tolerance / 1.9), 4 * cells)


@pytest.mark.parametrize("level", [0.02, -0.02])
@pytest.mark.parametrize("cells", [3, 5, 7])
def test_a_saddle_within_a_cell_parts_its_lines_as_its_middle_says(level: float, cells: int) -> None:
    """x y = c: two branches in opposite quadrants, of which none crosses over into the other two."""
    lines = level_lines(lambda x, y: x * y - level, Box(-1.0, 1.0, -1.0, 1.0, cells), 1e-4)
    assert len(lines) == 2
    quadrants = set()
    for line in lines:
        signs = {(math.copysign(1, p.real), math.copysign(1, p.imag)) for p in line}
        assert len(signs) == 1
        quadrants |= signs
        for one, two in pairwise(line):
            middle = (one + two) / 2
            # beside the axes a chord bows most: by less than is asked for along its normal
            assert abs(middle.real * middle.imag - level) < 1e-4 * 2
        ends = sorted((line[0], line[-1]), key=lambda p: abs(p.real))
        assert abs(ends[0].imag) == pytest.approx(1.0)
        assert abs(ends[1].real) == pytest.approx(1.0)
    assert quadrants == ({(1, 1), (-1, -1)} if level > 0 else {(1, -1), (-1, 1)})


def test_open_lines_end_at_the_border_or_where_there_is_no_field() -> None:
    """A slanted line through a box that is wider than high; beyond x = 2 the field is no number."""

    def field(x: float, y: float) -> float:
        return math.nan if x > 2.0 else y - 0.25 * x - 0.1

    ((*line,),) = level_lines(field, Box(-3.0, 3.0, -2.0, 1.0, 6), 1e-3)
    points = sorted(line, key=lambda p: p.real)
    assert points[0] == pytest.approx(-3.0 - 0.65j)
    assert points[-1] == pytest.approx(2.0 + 0.6j)
    # straight: one point on every line of the grid that it crosses
    assert [p.real for p in points] == pytest.approx(sorted([-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, -2.4, -0.4, 1.6]))
    assert all(p.imag == pytest.approx(0.25 * p.real + 0.1) for p in points)
    assert level_lines(lambda x, y: 1.0, Box(0.0, 1.0, 0.0, 1.0, 4), 1e-3) == []


def test_several_lines_are_told_apart() -> None:
    """Of sin x sin y the zeros within three quarters: two circles apart and a line are three."""

    def field(x: float, y: float) -> float:
        z = complex(x, y)
        return (abs(z - 2) - 1) * (abs(z + 2) - 1) * (y - 1.7)

    lines = level_lines(field, Box(-4.03, 4.01, -2.02, 2.04, 30), 1e-3)
    assert len(lines) == 3
    closed = [line for line in lines if line[0] == line[-1]]
    assert len(closed) == 2
    assert sorted(np.mean([p.real for p in line[1:]]) for line in closed) == pytest.approx([-2, 2], abs=0.05)
    (open_line,) = (line for line in lines if line[0] != line[-1])
    assert {round(p.imag, 9) for p in open_line} == {1.7}
    assert sorted((open_line[0].real, open_line[-1].real)) == pytest.approx([-4.03, 4.01])
