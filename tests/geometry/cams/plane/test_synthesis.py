"""Least sizes: the admissible region of axes by brute force, oscillating followers, curvature, rules for rollers."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.base.errors import ConvergenceError, ParameterError
from geometry.cams.motion.follower_motion import PhaseKind, dwell, follower_motion, return_, rise
from geometry.cams.plane.disk import FollowerKind, oscillating_cam, translating_cam
from geometry.cams.plane.synthesis import (
    AxisRegion,
    axis_region,
    convex_roller_base_radius,
    flat_base_radius,
    greatest_pressure_angle,
    least_convex_radius,
    least_pitch_radius,
    oscillating_axis,
    oscillating_start_angles,
    roller_prime_radius,
)
from geometry.cams.plane.undercut import is_whole
from geometry.laws.named import modified_sine, modified_trapezoid, polynomial_345, sine

D = math.radians
ROLLER, FLAT = FollowerKind.ROLLER, FollowerKind.FLAT
LIFT = follower_motion([rise(D(110), 25, sine()), dwell(D(40)), return_(D(90), 25, polynomial_345()), dwell(D(120))])
SWING = follower_motion([
    rise(D(130), D(20), modified_sine()), dwell(D(50)), return_(D(130), D(20), modified_trapezoid()), dwell(D(50)),
])  # fmt: skip


@pytest.mark.parametrize("returning", [None, 40.0])
@pytest.mark.parametrize("offset", [-9.0, 0.0, 6.0])
def test_the_least_prime_circle_keeps_the_pressure_angle(offset: float, returning: float | None) -> None:
    limit = None if returning is None else D(returning)
    prime = roller_prime_radius(LIFT, offset, D(30), limit)
    cam = translating_cam(LIFT, ROLLER, prime - 5, radius=5, follower_offset=offset)
    angle = np.linspace(0, D(110), 4001)
    steepest = float(np.abs(cam.pressure_angle(angle)).max())
    assert steepest <= D(30) * (1 + 1e-9)
    back = float(np.abs(cam.pressure_angle(np.linspace(D(150), D(240), 4001))).max())
    if limit is not None:
        assert back <= limit * (1 + 1e-9)
    assert max(steepest / D(30), back / limit if limit else 0) >= 1 - 1e-6


def test_the_axis_stands_no_higher_than_the_lowest_centre() -> None:
    assert AxisRegion(((-4.0, 0.5),)).least_height(-10.0) == 1.0
    assert AxisRegion(((-4.0, 0.5), (-6.0, -0.5))).least_height(0.0) == 0.0


def test_flat_radius_is_the_edge_of_undercut() -> None:
    least = flat_base_radius(LIFT).value
    assert is_whole(translating_cam(LIFT, FLAT, least * 1.0001))
    assert not is_whole(translating_cam(LIFT, FLAT, least * 0.9999))
    assert least_convex_radius(translating_cam(LIFT, FLAT, least + 7)).value == pytest.approx(7, rel=1e-12)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("returning", [None, 45.0])
def test_the_smallest_oscillating_cam(sense: int, returning: float | None) -> None:
    """The limits hold and are reached, and no axis nearby that keeps them has a smaller prime circle."""
    limit = None if returning is None else D(returning)
    axis = oscillating_axis(SWING, 80.0, sense, D(40), limit)
    cam = oscillating_cam(SWING, ROLLER, axis.prime_radius - 2, centre_distance=axis.centre_distance, arm_length=80,
                          radius=2, sense=sense)  # fmt: skip
    assert cam.mount.start_angle == pytest.approx(axis.start_angle, rel=1e-9)
    assert greatest_pressure_angle(cam, PhaseKind.RISE).value <= D(40) * (1 + 1e-9)
    if limit is not None:
        assert greatest_pressure_angle(cam, PhaseKind.RETURN).value <= limit * (1 + 1e-9)
    place = axis.centre_distance * np.exp(1j * axis.start_angle)
    rng = np.random.default_rng(5)
    worse = 0
    for _ in range(24):
        other = 80 + (place - 80) * rng.uniform(0.9, 0.999) * np.exp(1j * rng.normal(0, 0.05))
        if other.imag <= 0:
            continue
        near = oscillating_cam(SWING, ROLLER, abs(other - 80) - 1, centre_distance=abs(other), arm_length=80, radius=1,
                               sense=sense)  # fmt: skip
        broken = greatest_pressure_angle(near, PhaseKind.RISE).value > D(40)
        if limit is not None:
            broken = broken or greatest_pressure_angle(near, PhaseKind.RETURN).value > limit
        assert broken
        worse += 1
    assert worse > 8


def steepest(start: float, arm: float, distance: float, sense: int, kind: PhaseKind | None = None) -> float:
    """Greatest pressure angle by drawing: the normal of points of the pitch curve against the way of the arm's end."""
    worst, step = 0.0, 1e-6
    for piece in SWING.moving_pieces(kind):
        t = np.linspace(piece.start + 2 * step, piece.end - 2 * step, 2001)
        end = [distance - arm * np.exp(-1j * sense * (start + SWING.value(t + k * step))) for k in (-1, 0, 1)]
        path = end[2] * np.exp(-1j * (t + step)) - end[0] * np.exp(-1j * (t - step))
        slope = np.angle(path * np.exp(1j * t) / (1j * (end[1] - distance)))
        worst = max(worst, float(np.abs(np.abs(np.abs(slope) - np.pi / 2)).max()))
    return worst


@pytest.mark.sampled(1)
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("returning", [None, 40.0])
@pytest.mark.parametrize("distance", [60.0, 81.0, 120.0])
def test_the_least_prime_circle_at_a_distance(sense: int, returning: float | None, distance: float) -> None:
    """Every psi_0 between both ends keeps the limit, none beside them does: against angles taken from drawn points."""
    limit = None if returning is None else D(returning)
    low, high = oscillating_start_angles(SWING, 80.0, distance, sense, D(40), limit)
    kind = PhaseKind.RISE if returning is None else None

    def keeps(start: float) -> bool:
        return steepest(start, 80.0, distance, sense, kind) <= D(40)

    searched = [x for x in np.linspace(0.002, math.pi - D(20) - 0.002, 24).tolist() if keeps(x)]
    assert bool(searched) == (low < high)
    if searched:
        assert [keeps(low + x) for x in (-1e-5, 1e-5)] == [False, True]
        assert [keeps(high + x) for x in (-1e-5, 1e-5)] == [True, False]
        assert low <= searched[0] <= searched[-1] <= high


@pytest.mark.sampled(1)
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("limit", [11.0, 15.0, 30.0, 45.0, 60.0, 80.0])
@pytest.mark.parametrize("returns", [True, False])
def test_the_best_distance_is_the_best(sense: int, limit: float, returns: bool) -> None:
    """At limits where corners of nearly parallel lines ended the search before, too."""
    back = D(limit) if returns else None
    best = oscillating_axis(SWING, 80.0, sense, D(limit), back)
    for share in [*np.linspace(0.6, 1.6, 9), 1 - 1e-6, 1 + 1e-6]:
        away = best.centre_distance * float(share)
        low, high = oscillating_start_angles(SWING, 80.0, away, sense, D(limit), back)
        if low < high:
            assert abs(80 - away * np.exp(1j * low)) >= best.prime_radius * (1 - 1e-9)


def test_a_pivot_too_near_has_no_cam() -> None:
    assert oscillating_start_angles(SWING, 80.0, 61.0, 1, D(40))[0] == math.inf
    assert oscillating_axis(SWING, 80.0, 1, D(40), D(40)).centre_distance > 61.0


def test_convex_radius_of_rollers() -> None:
    base = convex_roller_base_radius(LIFT, 6.0, 9.0, follower_offset=2.0)
    cam = translating_cam(LIFT, ROLLER, base, radius=6.0, follower_offset=2.0)
    assert least_convex_radius(cam).value == pytest.approx(9.0, rel=1e-9)
    angle = np.linspace(0, 2 * math.pi, 7201)
    radii = cam.curvature_radius(angle)
    assert float(radii[radii + 6 > 0].min()) == pytest.approx(9.0, rel=1e-5)
    assert least_pitch_radius(cam) == pytest.approx(15.0, rel=1e-9)
    assert convex_roller_base_radius(LIFT, 6.0, 0.0, follower_offset=20.0) >= 14.0


def test_refusals() -> None:
    for limit in (0.0, D(90), -0.1):
        with pytest.raises(ParameterError):
            axis_region(LIFT, limit)
        with pytest.raises(ParameterError):
            oscillating_axis(SWING, 80.0, 1, limit)
    with pytest.raises(ParameterError):
        axis_region(follower_motion([dwell(2 * math.pi)]), D(30))
    mad = follower_motion([rise(D(20), D(100), sine()), return_(D(20), D(100), sine()), dwell(D(320))])
    try:
        axis = oscillating_axis(mad, 80.0, -1, D(5), D(5))
    except ConvergenceError:
        return
    assert axis.prime_radius > 80
