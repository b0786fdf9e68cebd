"""Boundaries of sections, cut by straight lines that begin anywhere."""

from __future__ import annotations

import cmath
import math

import pytest

from geometry.curves.line_arc import Arc, Line
from geometry.solids.sketch import Ring

CORNERS = (2 + 1j, 8 + 1j, 8 + 5j, 2 + 5j)
BOX = Ring(tuple(Line(a, b) for a, b in zip(CORNERS, (*CORNERS[1:], CORNERS[0]), strict=True)))
HALF = Ring((Line(1 + 2j, 7 + 2j), Arc(4 + 2j, 3.0, 0.0, math.pi)))


@pytest.mark.parametrize("lean", [0.0, 0.3, -1.1])
def test_a_line_meets_a_boundary_where_plane_geometry_has_it(lean: float) -> None:
    """From the middle of a box, and of a half disk's side: along the line both ways."""
    way = cmath.exp(1j * lean)
    half = min(3 / abs(way.real), 2 / abs(way.imag) if way.imag else math.inf)
    assert sorted(BOX.crossings(5 + 3j, way)) == pytest.approx([-half, half], abs=1e-9)
    upwards = cmath.exp(1j * (lean % math.pi or 0.5))
    assert sorted(HALF.crossings(4 + 2j, upwards)) == pytest.approx([0.0, 3.0], abs=1e-9)
    assert Ring((Arc(4 + 2j, 3.0, 0.0, 2 * math.pi),)).crossings(4 + 2j, way) == pytest.approx([-3.0, 3.0])
