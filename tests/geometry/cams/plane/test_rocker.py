"""The region of a flat rocker's axis against the cam's own radii of curvature, by brute force."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.base.errors import ConvergenceError, ParameterError
from geometry.cams.motion.follower_motion import FollowerMotion, dwell, follower_motion, return_, rise
from geometry.cams.plane.disk import FollowerKind, oscillating_cam
from geometry.cams.plane.rocker import rocker_base, rocker_planes
from geometry.laws import named


def motion(swing_deg: float, rising: float = 120.0) -> FollowerMotion:
    law, swing = named.polynomial_345(), math.radians(swing_deg)
    angles = [math.radians(a) for a in (rising, 60.0, 120.0, 180.0 - rising)]
    return follower_motion([rise(angles[0], swing, law), dwell(angles[1]), return_(angles[2], swing, law),
                            dwell(angles[3])])  # fmt: skip


def least_radius(given: FollowerMotion, base: float, distance: float, sense: int, offset: float) -> float:
    """Of the cam, by its own formula at 7 200 angles; minus infinity where there is no such cam."""
    try:
        cam = oscillating_cam(given, FollowerKind.FLAT, base, centre_distance=distance, sense=sense,
                              face_offset=offset)  # fmt: skip
    except ParameterError:
        return -math.inf
    return float(cam.curvature_radius(np.linspace(0, 2 * math.pi, 7201)).min())


CASES = [(10.0, 80.0, 1, 5.0, 3.0), (10.0, 80.0, -1, 5.0, 3.0), (14.0, 100.0, 1, 0.0, 0.0), (8.0, 60.0, -1, -4.0, 6.0)]


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("swing", "distance", "sense", "offset", "radius"), CASES)
def test_the_least_base_at_a_distance_is_that_of_bisection(
    swing: float, distance: float, sense: int, offset: float, radius: float
) -> None:
    given = motion(swing)
    found = rocker_base(given, distance, sense, offset, radius)
    low, high = 0.05 * distance, found.prime_radius * 1.2
    assert least_radius(given, high, distance, sense, offset) > radius
    assert not least_radius(given, low, distance, sense, offset) > radius
    for _ in range(40):
        middle = (low + high) / 2
        fine = least_radius(given, middle, distance, sense, offset) >= radius
        low, high = (low, middle) if fine else (middle, high)
    assert found.prime_radius == pytest.approx(high, abs=2e-5)
    assert distance * math.sin(found.start_angle) - offset == pytest.approx(found.prime_radius)


@pytest.mark.parametrize("sense", [1, -1])
def test_half_planes_tell_the_radius_itself(sense: int) -> None:
    """The slack of each half-plane is rho over the length of its normal: for cams that are convex and that are not."""
    given = motion(12.0)
    for base in (12.0, 30.0, 60.0):
        cam = oscillating_cam(given, FollowerKind.FLAT, base, centre_distance=90.0, sense=sense, face_offset=4.0)
        axis = 90 * np.exp(1j * math.asin((base + 4) / 90))
        for piece in given.pieces:
            t = np.linspace(*piece.domain, 9)[1:-1]
            normal, level = rocker_planes(piece, t, sense, 4.0)
            scale = 4.0 / level
            slack = ((np.conj(normal) * axis).real - level) * scale
            assert slack == pytest.approx(cam.curvature_radius(t), rel=1e-9, abs=1e-9)


def test_what_cannot_be_is_refused() -> None:
    given = motion(10.0)
    with pytest.raises(ConvergenceError, match="too near"):
        rocker_base(given, 5.0, 1, 5.0, 3.0)
    with pytest.raises(ConvergenceError):
        rocker_base(motion(50.0, 100.0), 90.0, -1, 0.0, 20.0)
    with pytest.raises(ParameterError, match="flat_outruns_cam"):
        rocker_base(motion(80.0, 60.0), 90.0, -1)
