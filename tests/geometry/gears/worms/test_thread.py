"""The corners of a thread touch what they join, and the normals of what the screw carries are those of its points."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.curves.line_arc import Arc
from geometry.gears.worms.flank import FORMS
from geometry.gears.worms.thread import Thread, thread_of
from geometry.gears.worms.worm import LEAST_LAND, Worm
from tests.geometry.gears.worms.screwed import screwed


@pytest.mark.parametrize("form", sorted(FORMS))
@pytest.mark.parametrize(("quotient", "starts"), [(10.0, 1), (8.0, 4), (50.0, 1), (30.0, 10)])
def test_the_lines_of_a_thread_run_on_smoothly_from_root_to_tip(form: str, quotient: float, starts: int) -> None:
    worm = Worm(5.0, starts, quotient, form).checked()
    thread = thread_of(worm, 0.5)
    ends = [(line.point(np.array(line.domain)), line.tangent(np.array(line.domain))) for _, line in thread.lines]
    for (point, way), (next_point, next_way) in pairwise(ends):
        assert abs(point[1] - next_point[0]) < 1e-12
        assert abs(way[1] - next_way[0]) < 1e-12
    # arcs of the asked radii that touch both cylinders
    assert ends[0][0][0] == pytest.approx(complex(worm.root_radius, thread.root_half), abs=1e-12)
    assert ends[0][1][0] == pytest.approx(-1j, abs=1e-12)
    assert ends[-1][0][1] == pytest.approx(complex(worm.tip_radius, thread.tip_half), abs=1e-12)
    assert ends[-1][1][1] == pytest.approx(-1j, abs=1e-12)
    assert [line.radius for _, line in thread.lines if isinstance(line, Arc)] == pytest.approx([1.0, 0.5], abs=1e-12)


@pytest.mark.parametrize("hand", ["right", "left"])
@pytest.mark.parametrize("upper", [True, False])
def test_normals_point_out_of_the_thread_and_across_its_surface(hand: str, upper: bool) -> None:
    thread = thread_of(Worm(4.0, 2, 9.0, "ZI", hand="left" if hand == "left" else "right"), 0.3)
    step, theta = 1e-6, 0.7
    for name, line in thread.lines:
        t = np.linspace(*line.domain, 5)[1:-1]
        normal = thread.normals(line.point(t), line.tangent(t), theta, upper=upper, start=1)
        points = screwed(thread, line.point(t), theta, upper=upper, start=1)
        for near in (screwed(thread, line.point(t + step), theta, upper=upper, start=1),
                     screwed(thread, line.point(t), theta + step, upper=upper, start=1)):  # fmt: skip
            across = np.einsum("ij,ij->i", normal, near - points) / np.linalg.norm(near - points, axis=1)
            assert np.abs(across).max() < 1e-5, name
        # a step along it leaves the thread: axially beyond the line, at its own radius
        out = points + 1e-4 * normal
        radius, angle = np.hypot(out[:, 0], out[:, 1]), np.arctan2(out[:, 1], out[:, 0])
        away = out[:, 2] - thread.worm.sign * thread.worm.parameter * (angle - thread.worm.sign * math.pi)
        pitch = math.pi * thread.worm.module
        offset = np.abs((away + pitch / 2) % pitch - pitch / 2)
        if name == "flank":
            assert (offset > thread.worm.half_thickness(radius)).all()


def test_a_screw_carries_its_lines_into_each_other() -> None:
    thread = thread_of(Worm(5.0, 3, 12.0, "ZN1"))
    worm, line = thread.worm, thread.lines[-1][1]
    plane = line.point(np.linspace(*line.domain, 7))
    first, moved = screwed(thread, plane, 0.2), screwed(thread, plane, 0.2 + math.tau / 3)
    # a turn by one of three starts is a step to the next thread, one pitch on
    beside = screwed(thread, plane, 0.2, start=1) + np.array([0.0, 0.0, math.pi * worm.module])
    assert moved == pytest.approx(beside, abs=1e-12)
    assert np.hypot(first[:, 0], first[:, 1]) == pytest.approx(plane.real, abs=1e-12)


@pytest.mark.parametrize(("quotient", "starts"), [(6.0, 4), (8.0, 4), (8.0, 5), (10.0, 6)])
def test_a_worm_that_is_made_in_one_module_is_made_in_all(quotient: float, starts: int) -> None:
    # the involute leaves its base circle radially, above root and fillet: rounding refused one module in four
    of_one = thread_of(Worm(1.0, starts, quotient).checked())
    for module in (0.5, 1.5, 2.0, 3.0, 3.15, 4.0, 6.3, 7.0, 9.0, 12.0, 16.0):
        thread = thread_of(Worm(module, starts, quotient).checked())
        assert thread.root_half == pytest.approx(of_one.root_half * module, rel=1e-12)
        assert [name for name, _ in thread.lines] == [name for name, _ in of_one.lines]


@pytest.mark.parametrize(
    ("worm", "rounding", "key"),
    [
        (Worm(5.0, 6, 6.0, "ZN1"), 0.0, "diameter_quotient"),
        (Worm(8.0, 8, 10.0, "ZK1"), 0.0, "diameter_quotient"),
        # an involute but for 1e-6 of it: its flank begins radially but for 1e-5, in a cusp that has no curvature
        (Worm(2.0, 6, 7.0, "ZK1", math.radians(25.0), wheel_diameter=1e6), 0.0, "diameter_quotient"),
        (Worm(5.0, 1, 10.0, fillet_coefficient=1.5), 0.0, "fillet_coefficient"),
        (Worm(5.0, 1, 10.0), 4.0, "tip_rounding"),
        # the flank would end below the reference cylinder, or nowhere
        (Worm(5.0, 1, 10.0, addendum_coefficient=0.2), 2.0, "tip_rounding"),
        (Worm(5.0, 1, 10.0, addendum_coefficient=0.2), 60.0, "tip_rounding"),
    ],
)
def test_threads_without_room_are_refused_with_what_works(worm: Worm, rounding: float, key: str) -> None:
    with pytest.raises(ParameterError) as caught:
        thread_of(worm.checked(), rounding)
    offered = caught.value.nearest
    assert caught.value.name == key
    assert offered is not None
    assert isinstance(offered.value, float)
    made: Thread
    if key == "tip_rounding":
        made = thread_of(worm, offered.value)
    else:
        made = thread_of(replace(worm, **{key: offered.value}), rounding)
    assert 2 * made.root_half < math.pi * made.worm.module
    assert made.tip_half >= LEAST_LAND * made.worm.module
    flank = dict(made.lines)["flank"]
    assert flank.point(np.array(flank.domain)).real.max() > made.worm.reference_radius
