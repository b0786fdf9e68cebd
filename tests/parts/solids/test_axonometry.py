"""Solids in isometry: areas by hand, what is seen through a hole, edges where walls do not run on."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from geometry.base.placement import Placement3
from geometry.curves.line_arc import Line
from geometry.solids.sketch import Layer, Ring, Sketch, round_ring
from parts.solids.axonometry import Picture, pictured, seen

# of the angle between the view and the plane
SIN, COS = 1 / math.sqrt(3), math.sqrt(2 / 3)
FINE = 1e-3


def square(side: float) -> Ring:
    corners = [complex(x, y) * side / 2 for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return Ring(tuple(Line(a, b) for a, b in zip(corners, (*corners[1:], corners[0]), strict=True)))


def tower(*layers: tuple[float, float, tuple[Ring, ...]]) -> Sketch:
    return Sketch(tuple(Layer(low, high, rings, rings) for low, high, rings in layers))


def kinds(picture: Picture) -> list[str]:
    return [patch.kind for patch in picture.patches]


@pytest.mark.parametrize("axis", [(0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)])
def test_a_cube_is_a_regular_hexagon_however_it_lies(axis: tuple[float, float, float]) -> None:
    found = pictured(tower((-5, 5, (square(10),))), Placement3.towards(axis, 0.0), FINE)
    assert found.outline.area == pytest.approx(math.sqrt(3) * 100, rel=1e-9)
    assert kinds(found) == ["wall", "face"]
    assert np.ptp(found.corners, axis=0) == pytest.approx([10, 10, 10])


def test_a_cylinder_and_what_is_seen_through_a_tube() -> None:
    laid = Placement3.towards((0.0, 0.0, 1.0), 0.0)
    rod = pictured(tower((0, 30, (round_ring(20),))), laid, FINE)
    assert rod.outline.area == pytest.approx(math.pi * 400 * SIN + 40 * 30 * COS, rel=1e-4)
    middle = seen(np.array([[0.0, 0.0, 0.0]]))[0]
    for height, through in ((5, True), (60, False)):
        tube = pictured(tower((-height / 2, height / 2, (round_ring(20), round_ring(15)))), laid, FINE)
        assert tube.outline.contains(shapely.Point(middle.real, middle.imag)) != through
        wall = next(patch for patch in tube.patches if patch.kind == "wall")
        assert (len(wall.loops) == 2) == through


def test_edges_stand_where_walls_do_not_run_on() -> None:
    laid = Placement3.towards((0.0, 0.0, 1.0), 0.0)
    outer = round_ring(20)
    one = pictured(tower((0, 10, (outer,)), (10, 30, (outer,))), laid, FINE)
    assert kinds(one) == ["wall", "face"]
    stepped = pictured(tower((0, 10, (outer,)), (10, 30, (round_ring(8),))), laid, FINE)
    assert kinds(stepped) == ["wall", "face", "edge", "wall", "face"]
    # a blind hole: the outer wall runs on past its floor
    blind = pictured(tower((0, 10, (outer,)), (10, 30, (outer, round_ring(8)))), laid, FINE)
    edges = [patch for patch in blind.patches if patch.kind == "edge"]
    lengths = [sum(float(np.abs(np.diff(line)).sum()) for line in patch.loops) for patch in edges]
    assert max(lengths) < 2 * math.pi * 8.1


def test_cones_narrow_and_thin_layers_are_one() -> None:
    laid = Placement3.towards((0.0, 0.0, 1.0), 0.0)
    cone = Sketch((Layer(0, 30, (round_ring(20),), (round_ring(1e-6),)),))
    found = pictured(cone, laid, FINE)
    # the point is seen above the ellipse: its two tangents and the arc between them
    up, low = 30 * COS, 20 * SIN
    lean = math.acos(low / up)
    area = 20 * low * (math.pi - lean) + 20 * low * math.tan(lean)
    assert found.outline.area == pytest.approx(area, rel=1e-3)
    rounded = [Layer(k, k + 1, (round_ring(20 - k),), (round_ring(19 - k),)) for k in range(6)]
    assert kinds(pictured(Sketch(tuple(rounded)), laid, 1.0)).count("wall") == 1
    assert kinds(pictured(Sketch(tuple(rounded)), laid, FINE)).count("wall") == 6
