"""Curves of a drawing: one fit of a shape that stands in several places, which lies in each."""

from __future__ import annotations

import cmath
import math

import numpy as np

from geometry.base.placement import Placement2
from geometry.curves.bspline import BSpline
from geometry.curves.curve import Carried
from geometry.curves.ellipse import EllipticArc
from geometry.curves.line_arc import Arc
from parts.drawing.canvas import Canvas, fitted


def test_a_shape_in_three_places_lies_in_each() -> None:
    long, short, tolerance = 30.0, 12.0, 1e-3
    shape = EllipticArc(Arc(0j, long, 0.2, 1.9), short / long, Placement2())
    placements = [Placement2(0.3, 5 + 2j), Placement2(-2.0, 40 - 7j), Placement2(math.pi, 0j)]
    canvas = Canvas(0.0, 0.0, "")
    found = fitted(canvas, [Carried(shape, one) for one in placements], 0.5, tolerance)
    for spline, one in zip(found, placements, strict=True):
        assert isinstance(spline, BSpline)
        back = (spline.point(np.linspace(*spline.domain, 50)) - one.translation) * cmath.exp(-1j * one.angle)
        # off the ellipse by its implicit equation, to first order
        x, y = back.real, back.imag
        slope = 2 * np.hypot(x / long**2, y / short**2)
        assert np.abs((x**2 / long**2 + y**2 / short**2 - 1) / slope).max() < 1.01 * tolerance / 0.5
        for end, angle in ((back[0], 0.2), (back[-1], 2.1)):
            assert abs(end - complex(long * math.cos(angle), short * math.sin(angle))) < 1e-12
        # the same fit: its knots
        assert spline.knots is found[0].knots  # type: ignore[union-attr]
    assert 0 < canvas.max_error <= tolerance
