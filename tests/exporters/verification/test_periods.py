"""A toothed outline is measured by one period and the others against it: nothing in any of them goes unseen."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest

from exporters.formats.readback import Loop
from exporters.verification.outlines import verify_loops
from geometry.approximation.chords import approximate_profile
from geometry.gears.teeth.basic_rack import iso_53
from geometry.gears.teeth.offset import gear_region
from geometry.gears.teeth.spur import SpurGear
from geometry.plane.measure import distance_to_profile
from tests.brute import arc_points

TEETH = 17
PROFILE = gear_region(SpurGear(2.0, TEETH, iso_53("A"))).region.outer
MADE = approximate_profile(PROFILE, 0.002, arcs=True)
DECLARED = MADE.max_error


def measured(vertices: np.ndarray, bulges: np.ndarray) -> float:
    """What the read-back says, and holds against a dense measurement of every edge."""
    verdict = verify_loops([Loop(vertices, bulges, "")], [PROFILE], ["CUT_OUTER"], DECLARED, DECLARED)
    told = verdict.measured["max_deviation"]
    ends = np.roll(vertices, -1)
    dense = np.concatenate([arc_points(a, b, float(c), 20) for a, b, c in zip(vertices, ends, bulges, strict=True)])
    brute = float(distance_to_profile(dense, PROFILE).max())
    assert 0.98 * brute <= told <= brute + 0.011 * DECLARED
    assert bool(verdict.failures) == (told > DECLARED)
    return told


@pytest.mark.sampled(1)
@pytest.mark.parametrize("period", [0, 1, TEETH // 2, TEETH - 1])
@pytest.mark.parametrize("moved", [0.002, 0.5, 3.0])
@pytest.mark.parametrize("bent", [False, True])
@pytest.mark.parametrize("clockwise", [False, True])
def test_a_change_in_any_period_is_measured(period: int, moved: float, bent: bool, clockwise: bool) -> None:
    vertices, bulges = MADE.geometry.expanded()
    own = len(vertices) // TEETH
    vertices, bulges = np.roll(vertices, 3).copy(), np.roll(bulges, 3).copy()
    plain = measured(vertices, bulges)
    edge = period * own + int(np.argmax(np.abs(bulges[:own])))
    if bent:
        bulges[edge] += 2 * moved * DECLARED / abs(vertices[(edge + 1) % len(vertices)] - vertices[edge])
    else:
        vertices[edge] += cmath.rect(moved * DECLARED, math.pi * 2 * edge / len(vertices))
    if clockwise:
        vertices, bulges = vertices[::-1], -np.roll(bulges[::-1], -1)
    found = measured(vertices, bulges)
    assert found >= plain if moved < 0.01 else found != plain
