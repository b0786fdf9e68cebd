"""On which side of an outline points lie: exact to a nanometre, where a polygon would err by micrometres."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest

from geometry.cams.plane.fence import Fence
from geometry.cams.plane.walls import reversed_profile
from geometry.curves.line_arc import Arc, Line
from geometry.plane.profile import Label, Profile, Segment


def hollow_bar() -> Profile:
    """A square of 40 mm with a hollow arc of 100 mm radius on top."""
    half = math.asin(20 / 100)
    centre = complex(0, 40 + 100 * math.cos(half))
    corners = [-20 + 0j, 20 + 0j, 20 + 40j, -20 + 40j]
    arc = Arc(centre, 100.0, cmath.phase(corners[2] - centre), -2 * half)
    curves = [Line(corners[0], corners[1]), Line(corners[1], corners[2]), arc, Line(corners[3], corners[0])]
    return Profile(tuple(Segment(c, Label.BODY) for c in curves))


@pytest.mark.parametrize("turned_over", [False, True])
def test_points_a_nanometre_off_are_told_apart(turned_over: bool) -> None:
    profile = hollow_bar()
    points, inside = [], []
    for segment in profile.period:
        curve = segment.curve
        t = np.linspace(*curve.domain, 203)[1:-1]
        normal = 1j * curve.derivative(t) / np.abs(curve.derivative(t))
        for off in (1e-9, -1e-9, 1e-3, -1e-3, 1e-4):
            points.append(curve.point(t) + off * normal)
            inside.append(np.full(len(t), off > 0))
    fence = Fence(reversed_profile(profile) if turned_over else profile)
    assert np.array_equal(fence.holds(np.concatenate(points)), np.concatenate(inside))


def test_a_polygon_alone_would_err_in_the_hollow() -> None:
    """The control: the same points by crossings of the polygon only."""
    profile, fence = hollow_bar(), Fence(hollow_bar())
    arc = profile.period[2].curve
    t = np.linspace(*arc.domain, 203)[1:-1]
    points = arc.point(t) - 1e-5 * 1j * arc.derivative(t) / np.abs(arc.derivative(t))
    assert fence._crossed(points).any()
    assert not fence.holds(points).any()


def test_corners_and_far_points() -> None:
    fence = Fence(hollow_bar())
    corners = np.array([-20 + 0j, 20 + 0j, 20 + 40j, -20 + 40j])
    out = corners + 1e-7 * np.array([-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j])
    assert not fence.holds(out).any()
    assert fence.holds(corners + 1e-7 * np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j])).all()
    assert fence.holds(np.array([0j + 20j, 1e3 + 0j, 0 + 1e9j, -19 + 39j])).tolist() == [True, False, False, True]
    assert fence.signed_distance(np.array([0 + 10j, 0 - 10j])) == pytest.approx([-10, 10])
