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
