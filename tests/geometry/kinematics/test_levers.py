"""Lever mechanisms: their links keep their lengths, rates are those of difference quotients, limits are sharp."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.kinematics.levers import Levers, Rods, Slider, Stone, closed, ranges, swing
from tests.sampling import examples

TURN = np.linspace(0, 2 * math.pi, 361)
QUARTER = cmath.rect(270.0, -math.pi / 2)
MECHANISMS = {
    "screen": Levers(300.0, 40.0, Stone(-600 + 0j), 1080.0, QUARTER, Slider(756.0, -600 + 0j)),
    "whitworth": Levers(300.0, 7.0, Stone(100j), 200.0, 150 + 50j, Slider(400.0, 30j, 0.3, -1)),
    "conveyor": Levers(100.0, 10.0, Rods(260 + 0j, 270.0, 210.0), 210.0, 252 + 0j, Slider(630.0, 260 + 40j, 0.2)),
    "mirrored": Levers(100.0, 10.0, Rods(260 - 30j, 270.0, 210.0, -1), 210.0, 90 + 40j, Slider(330.0, 0j, 1.4, -1)),
    "drag link": Levers(200.0, 5.0, Rods(60 + 0j, 210.0, 190.0), 190.0, 100j, Slider(400.0, 60 + 0j)),
    "six bars": Levers(100.0, 10.0, Rods(260 + 0j, 270.0, 210.0), 210.0, 100 + 20j, Rods(410 + 60j, 190.0, 170.0, -1)),
    "compressor": Levers(70.0, 150.0, Slider(210.0, 12j)),
}


@pytest.mark.parametrize("name", MECHANISMS)
def test_links_keep_their_lengths_all_round(name: str) -> None:
    levers = MECHANISMS[name]
    at = levers.moved(TURN)
    first, second = levers.first, levers.second
    assert np.abs(at.place("A") - levers.crank * np.exp(1j * TURN)).max() < 1e-12 * levers.crank
    if isinstance(first, Stone):
        # A lies on the lever, B beyond it at its own distance
        lean = (at.place("A") - first.pivot) * np.conj(at.place("B") - first.pivot)
        assert np.abs(lean.imag).max() < 1e-9 * levers.lever**2
        assert lean.real.min() > 0
        assert at.reach is not None
        assert np.allclose(at.reach[0], np.abs(at.place("A") - first.pivot), rtol=1e-14)
    else:
        assert np.allclose(np.abs(at.place("B") - at.place("A")), first.rod, rtol=1e-13)
    if not isinstance(first, Slider):
        assert np.allclose(np.abs(at.place("B") - first.pivot), levers.lever, rtol=1e-13)
    if second is not None:
        assert not isinstance(first, Slider)
        # a rigid arm: C seen from the lever stands still
        seen = (at.place("C") - first.pivot) / (at.place("B") - first.pivot)
        assert np.abs(seen - levers.arm / levers.lever).max() < 1e-12
        assert np.allclose(np.abs(at.place("D") - at.place("C")), second.rod, rtol=1e-13)
    for slider, joint, end in ((first, "A", "B"), (second, "C", "D")):
        if isinstance(slider, Slider):
            along = cmath.exp(1j * slider.angle)
            assert np.abs(((at.place(end) - slider.on) / along).imag).max() < 1e-10
            assert (slider.side * ((at.place(end) - at.place(joint)) / along).real).min() > 0
    # no jump to the other way of putting it together: nothing moves farther than its greatest speed takes it
    step = (TURN[1] - TURN[0]) / levers.speed
    for point in at.points:
        assert np.abs(np.diff(at.place(point))).max() <= np.abs(at.velocity(point)).max() * step * 1.05


@pytest.mark.parametrize("name", MECHANISMS)
def test_rates_are_difference_quotients(name: str) -> None:
    levers, h = MECHANISMS[name], 1e-4
    shifts = np.array([-2, -1, 0, 1, 2]) * h
    for angle in (0.3, 2.0, 4.4, 5.9):
        near = levers.moved(angle + shifts)
        for point in near.points:
            p = near.place(point)
            scale = np.abs(p).max()
            first = (p[0] - 8 * p[1] + 8 * p[3] - p[4]) / 12 / h * levers.speed
            second = (-p[0] + 16 * p[1] - 30 * p[2] + 16 * p[3] - p[4]) / 12 / h**2 * levers.speed**2
            assert abs(near.velocity(point)[2] - first) < 1e-10 * scale * levers.speed
            assert abs(near.acceleration(point)[2] - second) < 3e-6 * scale * levers.speed**2
        for link in near.links:
            turned = np.unwrap(near.angle(link))
            speed, change = near.turning(link)
            rate = (turned[0] - 8 * turned[1] + 8 * turned[3] - turned[4]) / 12 / h * levers.speed
            assert speed[2] == pytest.approx(rate, abs=1e-9 * levers.speed)
            bend = (speed[0] - 8 * speed[1] + 8 * speed[3] - speed[4]) / 12 / h * levers.speed
            assert change[2] == pytest.approx(bend, abs=1e-8 * levers.speed**2)


@pytest.mark.parametrize("name", [name for name in MECHANISMS if name != "compressor"])
def test_the_lever_swings_as_told(name: str) -> None:
    levers = MECHANISMS[name]
    angles = np.unwrap(levers.moved(np.linspace(0, 2 * math.pi, 20_001)).angle("3"))
    low, high = swing(levers)
    assert np.ptp(angles) == pytest.approx(high - low, abs=1e-6)
    if high - low < 6:
        middle = (angles.min() + angles.max() - low - high) / 2
        assert math.remainder(middle, 2 * math.pi) == pytest.approx(0, abs=1e-6)


def test_a_slider_crank_moves_by_the_textbook() -> None:
    """x = r cos phi + sqrt(l^2 - r^2 sin^2 phi); dead centres r + l and l - r from O1."""
    r, rod, w = 70.0, 210.0, 150.0
    at = Levers(r, w, Slider(rod)).moved(TURN)
    root = np.sqrt(rod**2 - (r * np.sin(TURN)) ** 2)
    assert np.allclose(at.place("B"), r * np.cos(TURN) + root, rtol=1e-14)
    assert np.allclose(at.velocity("B"), -w * r * np.sin(TURN) * (1 + r * np.cos(TURN) / root), atol=1e-9 * w * r)
    dead = Levers(r, w, Slider(rod)).moved([0.0, math.pi])
    share = r / rod
    assert np.allclose(dead.acceleration("B"), [-(w**2) * r * (1 + share), w**2 * r * (1 - share)], rtol=1e-12)


def refusal(levers: Levers) -> ParameterError:
    with pytest.raises(ParameterError) as found:
        closed(levers)
    return found.value


@given(
    crank=st.floats(20, 150), far=st.floats(200, 400), rod=st.floats(100, 500), rocker=st.floats(50, 400),
    side=st.sampled_from([1, -1]),
)  # fmt: skip
@examples(60)
def test_four_bars_close_or_are_refused_at_the_limit(
    crank: float, far: float, rod: float, rocker: float, side: int
) -> None:
    levers = Levers(crank, 1.0, Rods(cmath.rect(far, 1.0), rod, rocker, side), rocker)
    joints = np.abs(crank * np.exp(1j * np.linspace(0, 2 * math.pi, 721)) - cmath.rect(far, 1.0))
    fits = bool((joints < rod + rocker).all() and (joints > abs(rod - rocker)).all())
    # within the step of the circle that was tried the joint comes a little nearer
    spare = min(rod + rocker - far - crank, far - crank - abs(rod - rocker))
    if spare > 0:
        assert fits
        levers.moved(TURN)
        return
    assert not fits or spare > -1e-2
    error = refusal(levers)
    assert (error.name, error.code) == ("first.rod", "rods_do_not_close")
    if error.nearest is None:
        # no rod closes with that rocker: it is shorter than half of what the joint goes nearer and farther
        assert rocker <= crank * (1 + 1e-4)
        return
    value = error.nearest.value
    assert isinstance(value, float)
    pivot = cmath.rect(far, 1.0)
    replace(levers, first=Rods(pivot, value, rocker, side)).moved(TURN)
    beyond = value + 1e-3 * (-1 if error.nearest.side == "at_least" else 1)
    assert refusal(replace(levers, first=Rods(pivot, beyond, rocker, side))).name == "first.rod"


@pytest.mark.parametrize(
    ("levers", "name", "least"),
    [
        (Levers(70.0, 1.0, Slider(69.0)), "first.rod", 70.0),
        (Levers(70.0, 1.0, Slider(80.0, 30j)), "first.rod", 100.0),
        # C swings through 60 degrees about -90: it stands 270 below O3 at the most
        (Levers(300.0, 1.0, Stone(-600 + 0j), 1080.0, QUARTER, Slider(260.0, -600 + 0j)), "second.rod", 270.0),
        (Levers(300.0, 1.0, Stone(-600 + 0j), 1080.0, QUARTER, Slider(260.0, -600 + 100j)), "second.rod", 370.0),
    ],
)
def test_rods_that_do_not_reach_are_offered_the_least(levers: Levers, name: str, least: float) -> None:
    error = refusal(levers)
    assert (error.name, error.code) == (name, "rod_does_not_reach")
    assert error.numbers["least"] == pytest.approx(least, rel=1e-12)
    assert error.nearest is not None
    value = error.nearest.value
    assert isinstance(value, float)
    assert least < value < least * (1 + 1e-5) + 1e-4
    whose = name.partition(".")[0]
    replace(levers, **{whose: replace(getattr(levers, whose), rod=value)}).moved(TURN)


def test_a_stone_through_its_pivot_is_refused() -> None:
    assert refusal(Levers(50.0, 1.0, Stone(50j), 200.0)).code == "stone_through_pivot"
    Levers(50.0, 1.0, Stone(50.001j), 200.0).moved(TURN)


def test_mobility_is_one() -> None:
    for levers in MECHANISMS.values():
        assert 3 * levers.links - 2 * levers.lower_pairs == 1


HALF = st.sampled_from([1, -1])
LENGTH, WAY = st.floats(20, 200), st.floats(0, 2 * math.pi)


@st.composite
def mechanisms(draw: st.DrawFn) -> Levers:
    """Any lengths: most cannot turn all round."""
    crank, lever = draw(LENGTH), draw(LENGTH)
    pivot = cmath.rect(draw(LENGTH), draw(WAY))
    kind = draw(st.sampled_from(["stone", "rods", "slider"]))
    if kind == "slider":
        return Levers(
            crank, 1.0, Slider(draw(LENGTH), 1j * draw(st.floats(-90, 90)) * cmath.exp(0.7j), 0.7, draw(HALF))
        )
    first = Stone(pivot) if kind == "stone" else Rods(pivot, draw(LENGTH), lever, draw(HALF))
    arm, second, way = cmath.rect(draw(LENGTH), draw(WAY)), draw(st.sampled_from(["none", "slider", "rods"])), draw(WAY)
    if second == "none":
        return Levers(crank, 1.0, first, lever)
    if second == "slider":
        on = pivot + 1j * draw(st.floats(-90, 90)) * cmath.exp(1j * way)
        return Levers(crank, 1.0, first, lever, arm, Slider(draw(LENGTH), on, way, draw(HALF)))
    other = pivot + cmath.rect(draw(LENGTH), way)
    return Levers(crank, 1.0, first, lever, arm, Rods(other, draw(LENGTH), draw(LENGTH), draw(HALF)))


def joins(levers: Levers, angle: float) -> bool:
    """Whether the links close, by circles and lines that are put together with a compass."""
    first, second = levers.first, levers.second
    joint = cmath.rect(levers.crank, angle)
    if isinstance(first, Slider):
        return abs(((joint - first.on) / cmath.exp(1j * first.angle)).imag) < first.rod
    lever = joint - first.pivot
    if isinstance(first, Rods):
        far = max(abs(lever), 1e-12)
        cosine = (first.rocker**2 + far**2 - first.rod**2) / (2 * first.rocker * far)
        if abs(cosine) > 1:
            return False
        # B on its side of the way from O3 to A
        lever *= cmath.exp(1j * first.side * math.acos(cosine))
    if second is None:
        return True
    if not lever:
        # a stone on its pivot gives its lever no direction
        return False
    end = first.pivot + levers.arm * lever / abs(lever)
    if isinstance(second, Slider):
        return abs(((end - second.on) / cmath.exp(1j * second.angle)).imag) < second.rod
    return abs(second.rod - second.rocker) < abs(end - second.pivot) < second.rod + second.rocker


@given(mechanisms())
@example(Levers(20.0, 1.0, Stone(20 + 0j), 20.0, 21 + 0j, Slider(20.0, 20 + 0j)))
@examples(120)
def test_the_crank_moves_between_the_angles_at_which_links_close(levers: Levers) -> None:
    found = ranges(levers)
    for angle in np.linspace(0.0, 2 * math.pi, 721):
        shifted = angle + np.array([0.0, 2 * math.pi])
        if all(np.abs(shifted - end).min() > 1e-6 for ends in found for end in ends):
            assert joins(levers, angle) == any(((low < shifted) & (shifted < high)).any() for low, high in found)
    for low, high in found:
        # beside its limits, and between them, it moves; at a limit that it does not pass it is refused
        levers.moved(np.linspace(low, high, 9)[1:-1])
    try:
        closed(levers)
    except ParameterError:
        return
    # links that pass their limit at a hair's breadth have it for one
    assert sum(high - low for low, high in found) == pytest.approx(2 * math.pi)


def test_a_double_rockers_limits_are_those_of_the_triangle() -> None:
    """Khurmi 8.5: crank 300, rod and rocker 360, frame 600; in line they span 720."""
    levers = Levers(300.0, 10.0, Rods(600 + 0j, 360.0, 360.0), 360.0)
    most = math.acos((300**2 + 600**2 - 720**2) / (2 * 300 * 600))
    assert ranges(levers) == [pytest.approx((2 * math.pi - most, 2 * math.pi + most), rel=1e-14)]
    with pytest.raises(ParameterError):
        levers.moved(most + 1e-6)
    levers.moved(most - 1e-6)


def test_a_parallelogram_folds_in_line_twice() -> None:
    levers = Levers(50.0, 1.0, Rods(200 + 0j, 200.0, 50.0, -1), 50.0)
    assert ranges(levers) == [pytest.approx((0, math.pi)), pytest.approx((math.pi, 2 * math.pi))]
    # both cranks turn alike where it is a parallelogram, in opposite ways where it is crossed
    assert levers.moved(1.0).turning("3")[0] == pytest.approx(1.0, rel=1e-12)
    crossed = replace(levers, first=Rods(200 + 0j, 200.0, 50.0, 1))
    assert crossed.moved(1.0).turning("3")[0] < 0
    # too short to join at all
    assert ranges(replace(levers, first=Rods(200 + 0j, 60.0, 50.0))) == []
