"""Loops about circles: hulls of shapely, closed forms of a roller from outside, places along them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from shapely import MultiPolygon, Point
from shapely.ops import unary_union

from geometry.plane.loop import Loop, Wheel


def pressed(radius: float, half: float, roller: float, height: float) -> tuple[Loop, float, float, float]:
    """Two equal circles, a roller from outside in the middle above: the loop, its length, wraps on circle and roller.

    By the right triangles of an inner tangent: its angle from the line of centres is asin((r + R) / d).
    """
    loop = Loop((Wheel(-half + 0j, radius), Wheel(1j * height, roller, True), Wheel(half + 0j, radius)))
    far = math.hypot(half, height)
    # below the level at which it leaves a circle, the strand falls towards the roller
    lean = math.asin((radius + roller) / far) - math.atan2(height, half)
    strand = math.sqrt(far**2 - (radius + roller) ** 2)
    length = 2 * strand + 2 * lean * roller + 2 * (math.pi + lean) * radius + 2 * half
    return loop, length, math.pi + lean, 2 * lean


@pytest.mark.parametrize(("roller", "height"), [(3.0, 11.0), (6.0, 14.5), (3.0, 5.0)])
def test_a_roller_presses_a_strand_from_outside(roller: float, height: float) -> None:
    loop, length, wrap, own = pressed(9.0, 40.0, roller, height)
    assert loop.missed() == ()
    assert loop.length == pytest.approx(length, rel=1e-14)
    assert loop.wraps == pytest.approx((wrap, own, wrap), rel=1e-12)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("seed", range(6))
def test_circles_inside_are_wrapped_by_their_hull(seed: int) -> None:
    rng = np.random.default_rng(seed)
    angles = math.pi - np.arange(5) * 2 * math.pi / 5 + rng.uniform(-0.3, 0.3, 5)
    wheels = [Wheel(complex(60 * np.exp(1j * a)), float(r)) for a, r in zip(angles, rng.uniform(3, 25, 5), strict=True)]
    loop = Loop(tuple(wheels))
    discs = [Point(w.centre.real, w.centre.imag).buffer(w.radius, quad_segs=2_000) for w in wheels]
    assert loop.length == pytest.approx(unary_union(MultiPolygon(discs)).convex_hull.length, rel=1e-6)
    assert sum(loop.wraps) == pytest.approx(2 * math.pi)


def test_places_go_smoothly_round_what_is_inside_and_outside() -> None:
    """One step of way apart, on their circles where they are wrapped; ``way`` finds the angle of each again."""
    loop = Loop(
        (
            Wheel(0j, 9.0),
            Wheel(20 + 13j, 4.0, True),
            Wheel(35 + 12j, 3.0),
            Wheel(60 + 0j, 15.0),
            Wheel(30 - 16j, 5.0, True),
        )
    )
    assert loop.missed() == ()
    ways = np.linspace(0, loop.length, 20_001)
    places = loop.places(ways)
    steps = np.diff(places)
    assert np.abs(steps).max() <= ways[1] * (1 + 1e-9)
    assert np.abs(steps).sum() == pytest.approx(loop.length, rel=1e-7)
    # no corner anywhere
    assert np.abs(np.angle(steps[1:] / steps[:-1])).max() < 1.01 * ways[1] / 3.0
    for k, wheel in enumerate(loop.wheels):
        on = np.abs(np.abs(places - wheel.centre) - wheel.radius) < 1e-9
        assert on.sum() * ways[1] == pytest.approx(wheel.radius * loop.wraps[k], abs=3 * ways[1])
        row = np.flatnonzero(on)[5]
        found = loop.way(k, float(np.angle(places[row] - wheel.centre)))
        assert math.remainder(found - ways[row], loop.length) == pytest.approx(0.0, abs=1e-9)


def test_a_wheel_is_pressed_on_until_the_loop_is_as_long_as_asked() -> None:
    loop = pressed(9.0, 40.0, 3.0, 11.0)[0]
    found = loop.tightened(1, 220.0)
    assert found is not None
    assert found.length == pytest.approx(220.0, rel=1e-12)
    assert found.wheels[1].centre.real == pytest.approx(0.0, abs=1e-12)
    assert found.wheels[1].centre.imag < 11.0
    assert pressed(9.0, 40.0, 3.0, found.wheels[1].centre.imag)[1] == pytest.approx(220.0, rel=1e-12)
    # through to the other strand
    assert loop.tightened(1, 300.0) is None


@pytest.mark.parametrize(
    ("others", "free"),
    [
        # wheels of 10 mm that all but touch, and that overlap by 0.1 mm
        ([(20.01 + 0j, 10.0)], True), ([(19.9 + 0j, 10.0)], False),
        # a strand 10.5 mm over a wheel of the other side, less and more than its radius
        ([(100 + 0j, 10.0), (50 - 0.5j, 10.4)], True), ([(100 + 0j, 10.0), (50 - 0.5j, 10.6)], False),
    ],
)  # fmt: skip
def test_wheels_and_strands_keep_off_each_other(others: list[tuple[complex, float]], free: bool) -> None:
    loop = Loop(tuple(Wheel(*wheel) for wheel in [(0j, 10.0), *others]))
    assert (loop.missed() == ()) == free


@pytest.mark.heavy
def test_no_place_is_told_where_the_line_would_leave_another_wheel() -> None:
    """A place was told where its length jumps: a belt of 142 mm would have hung by 1.26 mm there."""
    wheels = [(0j, 33 / math.pi), (45.3 + 0j, 16 / math.pi), (15.85 - 7.05j, 3.33), (29.45 - 7.24j, 2.98)]
    first, second, one, last = (Wheel(*wheel) for wheel in wheels)
    loop = Loop((first, second, last, one))
    assert not loop.missed()

    def hull(pressed: float, *others: tuple[complex, float]) -> float:
        circles = [*others, (29.45 - 7.24j + pressed * (0.16 - 1j), 2.98)]
        return float(unary_union([Point(c.real, c.imag).buffer(r, 4096) for c, r in circles]).convex_hull.length)

    # all are inside: the line is their hull, and where the last makes it 142 mm long it has left the other one
    low, high = 0.0, 20.0
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if hull(middle, *wheels[:3]) < 142.0 else (low, middle)
    assert hull(low, *wheels[:2]) == pytest.approx(142.0)
    assert loop.tightened(2, 142.0) is None


@pytest.mark.parametrize(
    ("wheel", "which"),
    [
        # it floats beside the strand; it stands in a wheel; it is pressed through the other strand; beyond one
        (Wheel(13j, 3.0, True), 1),
        (Wheel(5j, 3.0), 1),
        (Wheel(-35 + 10j, 3.0, True), 1),
        (Wheel(-8j, 3.0, True), 1),
    ],
)
def test_wheels_that_the_line_cannot_come_to_are_told(wheel: Wheel, which: int) -> None:
    loop = Loop((Wheel(-40 + 0j, 9.0), wheel, Wheel(40 + 0j, 9.0)))
    assert which in loop.missed()
