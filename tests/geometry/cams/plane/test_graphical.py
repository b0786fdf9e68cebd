"""The graphical method against the lessons' steps done by hand in mm of paper, and its error against exact motion."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.cams.motion.follower_motion import FollowerMotion, dwell, follower_motion, motion_of_table, return_, rise
from geometry.cams.plane.disk import DiskCam, FollowerKind, oscillating_cam, translating_cam
from geometry.cams.plane.graphical import (
    Drawing,
    GraphicalMotion,
    graphical_hindrance,
    graphical_motion,
    graphical_profile_error,
    graphical_radius,
)
from geometry.laws.named import NAMED_LAWS

CASES = {
    c["id"]: c
    for c in json.loads((Path(__file__).parents[3] / "published" / "cams.json").read_text(encoding="utf-8"))["cases"]
}
# the diagrams as the textbooks write them, of a phase of length 1, in any scale
SHAPES = {
    "sine": lambda u: math.sin(2 * math.pi * u),
    "cosine": lambda u: math.cos(math.pi * u),
    "linearly_decreasing": lambda u: 1 - 2 * u,
    "polynomial_345": lambda u: u * (1 - u) * (1 - 2 * u),
    "polynomial_4567": lambda u: u**2 * (1 - u) ** 2 * (1 - 2 * u),
}


def motion(law: str, lift: float = 38.0, degrees: float = 120.0) -> FollowerMotion:
    made = NAMED_LAWS[law]()
    angle, rest = math.radians(degrees), math.radians(30)
    return follower_motion(
        [rise(angle, lift, made), dwell(rest), return_(angle, lift, made), dwell(2 * math.pi - 2 * angle - rest)]
    )


def by_hand(law: str, n: int, *, smooth: bool, lift: float, angle: float) -> tuple[list[float], ...]:
    """Sections 3.1 and 2.2.1 with pencil and ruler: 97 mm of axis, poles at 23 and 31 mm, 41 mm of highest S''."""
    shape, length, h_1, h_2, peak = SHAPES[law], 97.0, 23.0, 31.0, 41.0
    dx = length / n
    rate, way = [0.0], [0.0]
    for i in range(n):
        # the ray from P_2 to the mid-ordinate, carried to the diagram of S'
        slope = peak * shape((i + 0.5) / n) / h_2
        rate.append(rate[-1] + slope * dx)
        middle = (rate[-2] + rate[-1]) / 2
        if smooth:
            # the tangents at both ends have the slopes of S'' there
            middle += dx / 8 * peak * (shape(i / n) - shape((i + 1) / n)) / h_2
        way.append(way[-1] + middle / h_1 * dx)
    mu_phi = angle / length  # (4.1)
    mu_s = lift / way[-1]  # (4.2)
    mu_1 = mu_s / (h_1 * mu_phi)  # (4.3)
    mu_2 = mu_1 / (h_2 * mu_phi)  # (4.4)
    bend = [peak * shape(i / n) * mu_2 for i in range(n + 1)]
    return [y * mu_s for y in way], [y * mu_1 for y in rate], bend


@pytest.mark.parametrize("drawing", list(Drawing))
@pytest.mark.parametrize("n", [5, 8])
@pytest.mark.parametrize("law", SHAPES)
def test_it_is_what_pencil_and_ruler_give(law: str, n: int, drawing: Drawing) -> None:
    drawn = graphical_motion(motion(law), n, drawing)
    way, rate, bend = by_hand(law, n, smooth=drawing is Drawing.SMOOTH, lift=38.0, angle=math.radians(120))
    up, down = drawn.phases
    assert up.lift == pytest.approx(way, abs=1e-11)
    assert up.rate == pytest.approx(rate, abs=1e-11)
    assert [*up.bend[:, 0], up.bend[-1, 1]] == pytest.approx(bend, abs=1e-10)
    assert down.lift == pytest.approx([38 - x for x in way], abs=1e-11)
    assert (up.first, down.first) == (0, n + 1)
    assert math.degrees(down.angles[0]) == pytest.approx(150)


def test_table_2_2_by_drawing() -> None:
    """Mid-ordinates of a straight S'' are exact; the parabola of S' gives 1 + 1/(2 n^2), scales 128/129 of theirs."""
    drawn = graphical_motion(motion("linearly_decreasing", 32.0, 90.0), 8)
    phase = drawn.phases[0]
    assert phase.factor == pytest.approx(128 / 129, rel=1e-14)
    chords = graphical_motion(motion("linearly_decreasing", 32.0, 90.0), 8, Drawing.CHORDS)
    assert chords.phases[0].factor == pytest.approx(64 / 63, rel=1e-14)
    for k in range(9):
        printed = CASES[f"003.table2_2.k{k}_8"]["recomputed"]
        assert phase.rate[k] == pytest.approx(printed["S1_mm"] * 128 / 129, abs=1e-11)
        # the drawn S' is exact but for the scale, and so its least radius
        assert abs(phase.lift[k] - printed["S_mm"]) < 0.0234
    cam = translating_cam(drawn.motion, FollowerKind.FLAT, 60.0)
    found = graphical_radius(cam, drawn, None)
    assert found is not None
    exact = 768 / math.pi**2 - 32
    assert found == pytest.approx((768 / math.pi**2 * 128 / 129 - 32, exact), rel=1e-12)
    assert exact == pytest.approx(-CASES["003.table2_2.r0_flat"]["recomputed"]["min_S_plus_S2_mm"])


def test_laws_whose_drawing_is_exact() -> None:
    """Sine and cosine: the sums of mid-ordinates are the true integrals but for one factor, which (4.2) takes out."""
    assert np.abs(graphical_motion(motion("sine"), 8).errors(1)).max() < 1e-12
    assert np.abs(graphical_motion(motion("cosine"), 8).errors(0)).max() < 1e-12
    steps = graphical_motion(motion("constant_acceleration"), 8)
    assert np.abs(steps.errors(0)).max() < 1e-12
    assert np.abs(steps.errors(1)).max() < 1e-12
    cam = translating_cam(steps.motion, FollowerKind.FLAT, 60.0)
    printed = CASES["000.p4.r0.constant_acceleration"]["recomputed"]["r0_mm"]
    assert graphical_radius(cam, steps, None) == pytest.approx((printed, printed), rel=1e-12)
    # with 9 parts the peak of S' lies within one: the broken line cuts it off, the tangents do not
    assert np.abs(graphical_motion(motion("constant_acceleration"), 9).errors(0)).max() < 1e-12
    chords = graphical_motion(motion("constant_acceleration"), 9, Drawing.CHORDS)
    assert 0.05 < np.abs(chords.errors(0)).max() < 0.5


def roller() -> DiskCam:
    moves = motion("polynomial_345", 30.0, 130.0)
    return translating_cam(moves, FollowerKind.ROLLER, 17.2, radius=8.0, follower_offset=3.0)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("drawing", list(Drawing))
def test_the_error_falls_with_the_square_of_the_number(drawing: Drawing) -> None:
    cam = roller()
    rows = []
    for n in (16, 32, 64):
        drawn = graphical_motion(cam.motion, n, drawing)
        radius = graphical_radius(cam, drawn, math.radians(30))
        assert radius is not None
        rows.append(
            (
                np.abs(drawn.errors(0)).max(),
                np.abs(drawn.errors(1)).max(),
                graphical_profile_error(cam, drawn),
                abs(drawn.phases[0].factor - 1),
            )
        )
    orders = np.log2(np.array(rows[:-1]) / np.array(rows[1:]))
    assert np.all((orders > 1.85) & (orders < 2.15)), orders
    # the tangent touches between the points, whose place changes with n: the trend of two doublings
    least = [
        abs(found[0] - found[1])
        for n in (8, 16, 32, 64)
        if (found := graphical_radius(cam, graphical_motion(cam.motion, n, drawing), math.radians(30)))
    ]
    assert least[0] / least[2] > 8
    assert least[1] / least[3] > 8


def exactly(drawn: GraphicalMotion, error: float = 0.0) -> GraphicalMotion:
    """The drawing of a hand that makes no error, or one of so many mm."""
    made = []
    for phase in drawn.phases:
        inside = phase.angles.copy()
        inside[-1] = np.nextafter(inside[-1], 0)
        lift, rate = (drawn.motion.value(inside, k) for k in (0, 1))
        made.append(replace(phase, lift=lift + error, rate=rate))
    return replace(drawn, phases=tuple(made))


def swinging(kind: FollowerKind, sense: int) -> DiskCam:
    moves = motion("polynomial_345", math.radians(12), 130.0)
    radius = 6.0 if kind is FollowerKind.ROLLER else 0.0
    return oscillating_cam(moves, kind, 40.0, centre_distance=100.0, arm_length=90.0, radius=radius, sense=sense)


CAMS = {
    "roller": roller,
    "flat": lambda: translating_cam(motion("cosine"), FollowerKind.FLAT, 40.0),
    "rocker": lambda: swinging(FollowerKind.ROLLER, 1),
    "rocker with": lambda: swinging(FollowerKind.ROLLER, -1),
    "flat rocker": lambda: swinging(FollowerKind.FLAT, 1),
}


@pytest.mark.parametrize("name", CAMS)
def test_an_exact_hand_draws_the_exact_cam(name: str) -> None:
    cam = CAMS[name]()
    drawn = graphical_motion(cam.motion, 8)
    assert graphical_profile_error(cam, exactly(drawn)) < 1e-9
    error = 0.05 / (90 if "rocker" in name else 1)
    assert 0.02 < graphical_profile_error(cam, exactly(drawn, error)) < 0.08
    assert graphical_radius(cam, drawn, None) is None or name == "flat"


def test_what_cannot_be_drawn_is_refused() -> None:
    for moves in (motion("constant_velocity"), motion_of_table([0, 2, 4], [0, 1, 2])):
        assert graphical_hindrance(moves)
        with pytest.raises(ParameterError, match="phases"):
            graphical_motion(moves)
    assert graphical_hindrance(motion("sine")) is None
    for number, nearest in ((1, 2), (73, 72)):
        with pytest.raises(ParameterError) as caught:
            graphical_motion(motion("sine"), number)
        assert (caught.value.name, caught.value.code) == ("intervals", "out_of_range")
        assert caught.value.nearest is not None
        assert caught.value.nearest.value == nearest
        assert graphical_motion(motion("sine"), nearest).intervals == nearest
