"""What drawings show of solids: boundaries cut by lines, and stacks of layers by plane geometry."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable

import numpy as np
import pytest

from geometry.base.record import replace
from geometry.curves.line_arc import Arc, Line
from geometry.gears.teeth.basic_rack import iso_53
from geometry.gears.teeth.offset import gear_region
from geometry.gears.teeth.spur import SpurGear
from geometry.plane.profile import Label, Profile, Region, Segment, circle
from geometry.solids.body import Twist, plate
from geometry.solids.bores import RoundBore
from geometry.solids.hub_holes import HubHoles
from geometry.solids.sketch import (
    Layer,
    Ring,
    Sketch,
    Teeth,
    alike,
    crossing,
    hatched,
    lathe,
    reaching,
    round_ring,
    sketch_of_body,
    sketch_of_turned,
    stacked,
)
from geometry.solids.turned import Corner, HalfSection, Hole, half_section
from geometry.solids.wheel import WheelShape, wheel_body, wheel_sections

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


@pytest.mark.sampled(8)
@pytest.mark.parametrize("begins", [k * math.pi / 12 for k in range(24)])
@pytest.mark.parametrize("count", [2, 4])
def test_a_line_through_joints_of_a_round_boundary_meets_it_twice(count: int, begins: float) -> None:
    """A circle of arcs, cut through the places where they join: rounding puts these on either side of the line."""
    sweep = 2 * math.pi / count
    ring = Ring(tuple(Arc(0j, 46.0, begins + k * sweep, sweep) for k in range(count)))
    assert sorted(ring.crossings(0j, cmath.exp(1j * begins))) == pytest.approx([-46.0, 46.0], abs=1e-9)


@pytest.mark.parametrize("radius", [10.0, 36.421356, 7.3])
def test_an_edge_from_which_a_cone_rises_is_seen_all_round(radius: float) -> None:
    """Two cones on each other: nothing stands over the circle that they share, whatever rounding makes of it."""
    cones = Sketch(tuple(lathe([(0j, radius + 3j), (radius + 3j, 2 + 8j), (2 + 8j, 0 + 8j)])), (3.0,))
    circle = radius * np.exp(1j * np.linspace(0, 2 * math.pi, 720))
    assert not cones.covers(circle, 3.0).any()
    assert cones.covers(0.99 * circle, 3.0).all()


# --- a stack of layers: a disk of radius 5 with a bore of 1, 4 high, and a collar of radius 3 on it, 2 high
# both have a hole of 0.3 at 2i; the disk has one of 0.5 at 4 as well, on which the collar does not stand

STEPS = [(1 + 0j, 5 + 0j), (5 + 0j, 5 + 4j), (5 + 4j, 3 + 4j), (3 + 4j, 3 + 6j), (3 + 6j, 1 + 6j), (1 + 6j, 1 + 0j)]
THROUGH = [(2j, 0.3), (4 + 0j, 0.5)]
STACK = tuple(lathe(STEPS, THROUGH))


def circles(rings: tuple[Ring, ...]) -> list[tuple[complex, float]]:
    found = [ring.circle for ring in rings]
    return [one for one in found if one is not None] if None not in found else []


def ends(lines: Iterable[Line]) -> set[tuple[complex, complex]]:
    """Lines by their ends, in one order."""
    both = [sorted((x.start, x.end), key=lambda p: (round(p.real, 9), round(p.imag, 9))) for x in lines]
    one, two = ([complex(round(p.real, 9), round(p.imag, 9)) for p in side] for side in zip(*both, strict=True))
    return set(zip(one, two, strict=True))


def test_layers_of_half_a_section() -> None:
    assert [(k.low, k.high) for k in STACK] == [(0.0, 4.0), (4.0, 6.0)]
    disk = [(0j, 1.0), (0j, 5.0), (2j, 0.3), (4 + 0j, 0.5)]
    collar = [(0j, 1.0), (0j, 3.0), (2j, 0.3)]
    assert [circles(k.lower) for k in STACK] == [disk, collar]
    assert [circles(k.upper) for k in STACK] == [disk, collar]
    # a cone to its point, told either way round; walls between the ends of a step are cut at its height
    cone = [(0j, 4 + 0j), (4 + 0j, 8j)], [(8j, 4 + 0j), (4 + 0j, 0j)]
    for chain in cone:
        (layer,) = lathe(chain, [(1 + 0j, 0.1)])
        assert circles(layer.lower) == [(0j, 4.0)]
        assert circles(layer.upper) == [(0j, pytest.approx(0.0, abs=1e-5))]
    low, high = lathe([(0j, 6 + 0j), (6 + 0j, 2 + 8j), (2 + 8j, 1 + 8j), (1 + 8j, 1 + 2j), (1 + 2j, 0 + 2j)])
    assert (low.high, high.low, high.high) == (2.0, 2.0, 8.0)
    assert circles(low.lower) == [(0j, 6.0)]
    assert circles(low.upper) == [(0j, 5.0)]
    assert circles(high.lower) == [(0j, 1.0), (0j, 5.0)]
    assert circles(high.upper) == [(0j, 1.0), (0j, 2.0)]
    # steps lower than 1e-7 mm are none
    assert [k.high for k in lathe([(2 + 0j, 2 + 3j), (2 + 3j, 2 + 3.00000005j)])] == [3.0]


def test_a_plane_along_the_axis_shows_edges_and_the_ends_of_holes() -> None:
    seen = ends(stacked(STACK, crossing(0j, 1 + 0j)))
    walls = {(-5 + 0j, -5 + 4j), (5 + 0j, 5 + 4j), (-3 + 4j, -3 + 6j), (3 + 4j, 3 + 6j), (-1 + 0j, -1 + 6j),
             (1 + 0j, 1 + 6j), (3.5 + 0j, 3.5 + 4j), (4.5 + 0j, 4.5 + 4j)}  # fmt: skip
    # the ends of holes are closed by the edges behind them; at the step there is no line where material goes on
    flat = {(-5 + 0j, 5 + 0j), (-5 + 4j, -3 + 4j), (3 + 4j, 5 + 4j), (-3 + 6j, 3 + 6j)}
    assert seen == walls | flat
    # a wall that bends is an edge all through
    creased = ends(stacked(STACK, crossing(0j, 1 + 0j), creases=(4.0,)))
    assert creased == walls | (flat - {(-5 + 4j, -3 + 4j), (3 + 4j, 5 + 4j)}) | {(-5 + 4j, 5 + 4j)}
    # across, the other hole; from outside the edges alone
    across = ends(stacked(STACK, crossing(0j, 1j)))
    assert {(1.7 + 0j, 1.7 + 6j), (2.3 + 0j, 2.3 + 6j)} < across
    assert ends(stacked(STACK, reaching(1 + 0j))) == {
        (-5 + 0j, -5 + 4j), (5 + 0j, 5 + 4j), (-3 + 4j, -3 + 6j), (3 + 4j, 3 + 6j), (-5 + 0j, 5 + 0j),
        (-5 + 4j, -3 + 4j), (3 + 4j, 5 + 4j), (-3 + 6j, 3 + 6j)}  # fmt: skip
    # slanted walls are lines of their own
    cone = ends(stacked(tuple(lathe([(0j, 4 + 0j), (4 + 0j, 2 + 8j), (2 + 8j, 8j)])), crossing(0j, 1 + 0j)))
    assert cone == {(-4 + 0j, 4 + 0j), (-4 + 0j, -2 + 8j), (2 + 8j, 4 + 0j), (-2 + 8j, 2 + 8j)}
    # what the plane passes by is not there
    assert list(stacked(STACK, crossing(9j, 1 + 0j))) == []


def polygon(loop: tuple[Line, ...]) -> list[complex]:
    """Its corners; it is closed."""
    assert all(abs(a.end - b.start) < 1e-12 for a, b in zip(loop, (*loop[1:], loop[0]), strict=True))
    return [line.start for line in loop]


def shoelace(points: list[complex]) -> float:
    return sum((p.conjugate() * q).imag for p, q in zip(points, points[1:] + points[:1], strict=True)) / 2


def test_cut_material_makes_loops_through_the_layers() -> None:
    """Counter-clockwise; where holes begin or end there are as many loops as pieces."""
    loops = [polygon(loop) for loop in hatched(STACK, crossing(0j, -1j))]
    # along -y: a bore of 1 in disk and collar, the small hole at -2
    assert len(loops) == 3
    assert sorted(map(shoelace, loops)) == pytest.approx([0.7 * 6, 2.7 * 4 + 0.7 * 2, 4 * 4 + 2 * 2])
    right = max(loops, key=lambda loop: max(p.real for p in loop))
    assert {complex(round(p.real, 9), p.imag) for p in right} == {1, 5, 5 + 4j, 3 + 4j, 3 + 6j, 1 + 6j, 1 + 4j}
    # along x the disk has one more hole: its loops end at the step
    loops = [polygon(loop) for loop in hatched(STACK, crossing(0j, 1 + 0j))]
    assert sorted(map(shoelace, loops)) == pytest.approx([0.5 * 4, 2 * 2, 2 * 2, 2.5 * 4, 4 * 4])
    # teeth are hatched as far as their roots
    toothed = Layer(0.0, 2.0, (round_ring(5.0, 4.2),), (round_ring(5.0, 4.2),))
    (loop,) = hatched([toothed], crossing(0j, 1 + 0j))
    assert set(polygon(loop)) == {-4.2 + 0j, 4.2 + 0j, 4.2 + 2j, -4.2 + 2j}
    # layers that lie beside each other do not run into each other
    apart = [Layer(0.0, 1.0, (round_ring(1.0),), (round_ring(1.0),)),
             Layer(1.0, 2.0, (round_ring(1.0, centre=5 + 0j),), (round_ring(1.0, centre=5 + 0j),))]  # fmt: skip
    assert len(list(hatched(apart, crossing(0j, 1 + 0j)))) == 2
    over = [apart[0], Layer(1.0, 2.0, (round_ring(1.0, centre=1 + 0j),), (round_ring(1.0, centre=1 + 0j),))]
    assert len(list(hatched(over, crossing(0j, 1 + 0j)))) == 1
    gap = [apart[0], Layer(1.5, 2.0, (round_ring(1.0),), (round_ring(1.0),))]
    assert len(list(hatched(gap, crossing(0j, 1 + 0j)))) == 2


def test_what_is_seen_from_above_and_what_is_covered() -> None:
    sketch = Sketch(STACK)
    seen = [(z, ring.circle) for z, ring in sketch.edges()]
    # the bore and the small hole go on through the collar
    assert seen == [(4.0, (0j, 5.0)), (4.0, (4 + 0j, 0.5)), (6.0, (0j, 1.0)), (6.0, (0j, 3.0)), (6.0, (2j, 0.3))]
    bent = replace(sketch, creases=(4.0,))
    assert [z for z, _ in bent.edges()] == [4.0] * 4 + [6.0] * 3
    points = np.array([0j, 2 + 0j, 2j, 2.5j, 4 + 0j, 4j, 6 + 0j])
    assert sketch.covers(points, 0.0).tolist() == [False, True, False, True, False, True, False]
    # disks below a height cover nothing above it
    assert sketch.covers(points, 4.0).tolist() == [False, True, False, True, False, False, False]
    assert not sketch.covers(points, 5.0).any()
    box = Sketch((Layer(0.0, 1.0, (BOX, round_ring(1.0, centre=5 + 3j)), (BOX, round_ring(1.0, centre=5 + 3j))),))
    assert box.covers(np.array([3 + 2j, 5 + 3j, 5 + 4.5j, 1 + 2j, 5 + 6j]), 0.0).tolist() == [
        True,
        False,
        True,
        False,
        False,
    ]
    # a cone covers what either of its ends does
    cone = Sketch((Layer(0.0, 1.0, (round_ring(1.0),), (round_ring(3.0),)),))
    assert cone.covers(np.array([0.5 + 0j, 2 + 0j, 4 + 0j]), 0.0).tolist() == [True, True, False]


def test_turned_over_all_is_upside_down_and_mirrored() -> None:
    cone = Layer(6.0, 9.0, (HALF,), (BOX,))
    sketch = Sketch((*STACK, cone), (4.0,), 7.0, True)
    over = sketch.turned_over()
    assert [(k.low, k.high) for k in over.layers] == [(-9.0, -6.0), (-6.0, -4.0), (-4.0, 0.0)]
    assert (over.creases, over.pitch, over.is_shaft, over.is_ball) == ((-4.0,), 7.0, True, False)
    assert circles(over.layers[2].lower) == [(0j, 1.0), (0j, 5.0), (-2j, 0.3), (4 + 0j, 0.5)]
    # what was above is below now
    again = over.turned_over()
    assert [(k.low, k.high) for k in again.layers] == [(0.0, 4.0), (4.0, 6.0), (6.0, 9.0)]
    x, y = (v.ravel() for v in np.meshgrid(np.arange(-8.75, 9, 0.5), np.arange(-8.75, 9, 0.5)))
    for sketch_, upwards, lower, upper in ((over, -1, BOX, HALF), (again, 1, HALF, BOX)):
        layer = sketch_.layers[0 if upwards < 0 else 2]
        for ring, wanted in ((layer.lower[0], lower), (layer.upper[0], upper)):
            assert np.array_equal(ring.holds(x + 1j * y), wanted.holds(x + 1j * upwards * y))


def test_a_hexagon_that_is_turned_over_holds_what_is_mirrored() -> None:
    """Before: its sides were turned over one by one and joined crosswise, so that half of it was outside."""
    corners = [6 * cmath.exp(1j * (0.2 + k * math.pi / 3)) for k in range(6)]
    ring = Ring(tuple(Line(a, b) for a, b in zip(corners, (*corners[1:], corners[0]), strict=True)))
    (over,) = Sketch((Layer(0.0, 1.0, (ring,), (ring,)),)).turned_over().layers
    x, y = (v.ravel() for v in np.meshgrid(np.arange(-6.75, 7, 0.5), np.arange(-6.75, 7, 0.5)))
    apothems = [(np.conj(cmath.exp(1j * (0.2 + (k + 0.5) * math.pi / 3))) * (x - 1j * y)).real for k in range(6)]
    assert np.array_equal(over.lower[0].holds(x + 1j * y), np.max(apothems, axis=0) < 6 * math.cos(math.pi / 6))


def test_places_lie_within_a_boundary_or_without() -> None:
    """An L of lines, and half a disk: on a net, against what the inequalities say."""
    corners = (0j, 6 + 0j, 6 + 2j, 2 + 2j, 2 + 5j, 5j)
    angle = Ring(tuple(Line(a, b) for a, b in zip(corners, (*corners[1:], corners[0]), strict=True)))
    x, y = (v.ravel() for v in np.meshgrid(np.arange(-0.75, 8, 0.5), np.arange(-0.75, 7, 0.5)))
    wanted = ((x > 0) & (x < 6) & (y > 0) & (y < 2)) | ((x > 0) & (x < 2) & (y > 0) & (y < 5))
    assert np.array_equal(angle.holds(x + 1j * y), wanted)
    half = (y > 2) & (np.abs(x + 1j * y - (4 + 2j)) < 3)
    assert np.array_equal(HALF.holds(x + 1j * y), half)
    assert np.array_equal(round_ring(3.0, centre=4 + 2j).holds(x + 1j * y), np.abs(x + 1j * y - (4 + 2j)) < 3)
    assert alike(round_ring(2.0, centre=1j), round_ring(2.0 + 5e-8, centre=1j + 5e-8))
    assert not alike(round_ring(2.0), round_ring(2.0 + 2e-7))
    assert not alike(round_ring(2.0), round_ring(2.0, centre=2e-7 + 0j))
    assert alike(BOX, replace(BOX))
    assert not alike(BOX, HALF)
    assert reaching(1j)((BOX, round_ring(2.0, centre=5 + 9j))) == pytest.approx([1.0, 11.0])
    assert reaching(1 + 0j)((HALF, round_ring(1.0, centre=3 + 0j))) == pytest.approx([1.0, 7.0])
    assert reaching(1j)(()) == []
    assert crossing(5 + 3j, 1 + 0j)((BOX, round_ring(1.0, centre=5 + 3j))) == pytest.approx([-3, -1, 1, 3], abs=1e-9)


def test_a_body_is_drawn_by_its_walls() -> None:
    """A plate with a hole and a square window, chamfered below, a turned one, and teeth as circles."""
    square = Profile(tuple(Segment(Line(a, b), Label.HOLE) for a, b in
                           ((2 + 1j, 2 - 1j), (2 - 1j, 4 - 1j), (4 - 1j, 4 + 1j), (4 + 1j, 2 + 1j))))  # fmt: skip
    outer, hole = circle(8.0, Label.BODY), circle(1.0, Label.HOLE, hole=True, centre=-3j)
    sketch = replace(sketch_of_body(plate(Region(outer, (hole, square)), 1.0, 4.0)), is_shaft=True)
    (layer,) = sketch.layers
    assert (layer.low, layer.high, layer.upper is layer.lower) == (1.0, 4.0, True)
    assert [ring.circle for ring in layer.lower] == [(0j, 8.0), (-3j, 1.0), None]
    assert (sketch.creases, sketch.pitch, sketch.is_shaft) == ((), None, True)
    chamfered = wheel_body(
        WheelShape(5.0, chamfer_below=0.5),
        wheel_sections(lambda d, c: circle(10.0 + d - c, Label.HUB), 10.0, HubHoles(RoundBore(4.0))),
    )
    sketch = sketch_of_body(chamfered)
    assert [(k.low, k.high) for k in sketch.layers] == [(0.0, 0.5), (0.5, 5.0)]
    below, above = ([sorted(r for _, r in circles(side)) for side in (k.lower, k.upper)] for k in sketch.layers)
    assert below == [pytest.approx([2.5, 9.5]), pytest.approx([2.0, 10.0])]
    assert above == [pytest.approx([2.0, 10.0])] * 2
    assert sketch.creases == (0.0, 0.5)
    turned = plate(Region(outer, (square,)), 0.0, 2.0, Twist(rate=math.pi / 4), toothed=square)
    (layer,) = sketch_of_body(turned).layers
    assert layer.lower[1].points == pytest.approx(Ring(tuple(s.curve for s in square.segments())).points)
    # a quarter of a turn by pi / 4 a mm
    assert layer.upper[1].points == pytest.approx(1j * layer.lower[1].points)
    gear = SpurGear(2.0, 12, iso_53("A"))
    teeth = Teeth(gear.tip_radius, gear.root_radius, gear.reference_radius)
    region = gear_region(gear, 0.0).region
    (layer,) = sketch_of_body(plate(region, 0.0, 3.0), teeth).layers
    assert [(ring.circle, ring.root) for ring in layer.lower] == [((0j, gear.tip_radius), gear.root_radius)]
    assert sketch_of_body(plate(region, 0.0, 3.0), teeth).pitch == gear.reference_radius
    assert sketch_of_body(plate(region, 0.0, 3.0)).layers[0].lower[0].circle is None


def test_a_turned_part_is_drawn_by_steps_of_its_arcs() -> None:
    """A ball of eight pieces, each with its ends on the circle; a shaft with a cone, edges where its walls turn."""
    ball = sketch_of_turned(HalfSection(half_section([Corner(-5j, arc=5.0), Corner(5j)])))
    assert ball.is_ball
    assert len(ball.layers) == 8
    for layer in ball.layers:
        for z, rings in ((layer.low, layer.lower), (layer.high, layer.upper)):
            ((centre, radius),) = circles(rings)
            assert centre == 0
            assert math.hypot(radius, z) == pytest.approx(5.0, abs=1e-6)
    corners = [Corner(0j), Corner(6 + 0j), Corner(6 + 4j), Corner(4 + 9j), Corner(9j)]
    shaft = sketch_of_turned(HalfSection(half_section(corners), (Hole(3 + 0j, 0.5),)), is_shaft=True)
    assert (shaft.is_shaft, shaft.is_ball) == (True, False)
    assert [(k.low, k.high) for k in shaft.layers] == [(0.0, 4.0), (4.0, 9.0)]
    assert [circles(k.upper) for k in shaft.layers] == [[(0j, 6.0), (3 + 0j, 0.5)], [(0j, 4.0), (3 + 0j, 0.5)]]
    assert sorted(shaft.creases) == [0.0, 0.0, 4.0, 9.0, 9.0]
    # a wall that goes on into an arc has no edge there
    smooth = [Corner(0j), Corner(6 + 0j), Corner(6 + 4j, arc=2.0), Corner(4 + 6j), Corner(6j)]
    assert 4.0 not in sketch_of_turned(HalfSection(half_section(smooth))).creases
