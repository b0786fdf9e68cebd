"""Hatching fills what its loops enclose."""

from __future__ import annotations

import numpy as np
import pytest

from geometry.curves.bspline import BSpline
from geometry.curves.line_arc import Line
from parts.drawing.hatching import hatching


def test_a_section_that_ends_in_a_spline_is_hatched_up_to_it() -> None:
    """A segment of a parabola: two thirds of its box; a chord of the spline would enclose nothing."""
    bow = BSpline(2, np.array([0.0, 0, 0, 1, 1, 1]), np.array([10 + 0j, 5 + 10j, 0]))
    lines = hatching([[Line(0j, 10 + 0j), bow]], 0.02)
    assert 0.02 * sum(abs(line.end - line.start) for line in lines) == pytest.approx(10 * 5 * 2 / 3, rel=2e-3)


@pytest.mark.parametrize("falls", [False, True])
def test_an_angle_is_hatched_all_over_either_way(falls: bool) -> None:
    """Two rectangles side by side: as much as both have, each line within one of them."""
    corners = (0j, 30 + 0j, 30 + 5j, 8 + 5j, 8 + 20j, 20j)
    loop = [Line(a, b) for a, b in zip(corners, (*corners[1:], corners[0]), strict=True)]
    lines = hatching([loop], 0.05, falls=falls)
    assert 0.05 * sum(abs(line.end - line.start) for line in lines) == pytest.approx(30 * 5 + 8 * 15, rel=1e-2)
    for line in lines:
        at, way = (line.start + line.end) / 2, line.end - line.start
        assert (0 < at.real < 30 and 0 < at.imag < 5) or (0 < at.real < 8 and 0 < at.imag < 20)
        assert way.imag / way.real == pytest.approx(-1.0 if falls else 1.0)


def test_stubs_are_left_out_where_a_section_comes_to_a_point() -> None:
    """A wedge of 10 degrees: its lines end a third of a spacing or more apart, and cover all but its tip."""
    corners = (0j, 30 + 0j, 30 + 30j * np.tan(np.radians(10)))
    loop = [Line(complex(a), complex(b)) for a, b in zip(corners, (*corners[1:], corners[0]), strict=True)]
    for spacing in (0.3, 1.0, 3.0):
        lengths = [abs(line.end - line.start) for line in hatching([loop], spacing)]
        assert min(lengths) > spacing / 3
        assert spacing * sum(lengths) == pytest.approx(450 * np.tan(np.radians(10)), abs=2 * spacing**2)
