"""Cam curves under the laws of every curve: 50-digit derivatives, curvature, bounds, offsets, and approximations."""

from __future__ import annotations

import math
from typing import Any

import mpmath
import numpy as np
import pytest

from geometry.approximation.chords import approximate_profile
from geometry.approximation.outline import spline_outline
from geometry.base.errors import CuspError
from geometry.base.placement import Placement2
from geometry.cams.motion.follower_motion import dwell, follower_motion, motion_of_table, return_, rise
from geometry.cams.motion.guides import Oscillating, Translating
from geometry.cams.plane.curves import CentreEnvelope, FaceEnvelope
from geometry.cams.plane.disk import DiskCam, FollowerKind, oscillating_cam, translating_cam
from geometry.cams.plane.shape import cam_shape
from geometry.curves.curve import Carried, Curve, Mirrored, Reversed
from geometry.curves.line_arc import Arc
from geometry.laws.named import gutman_13, modified_sine, polynomial_345, polynomial_4567, sine
from geometry.laws.piece import LawPiece
from geometry.plane.contour import edge_points
from geometry.plane.measure import distance_to_profile, profile_area
from tests import laws

MP: Any = mpmath.mp.clone()
MP.dps = 50
D = math.radians
RISE = polynomial_345().pieces[0].placed(0.0, D(110), 0.0, 22.0)
SWING = gutman_13().pieces[0].placed(0.0, D(110), 0.0, D(19))
MOUNTS = {
    "translating": (RISE, Translating(6.0, 41.0)),
    "against": (SWING, Oscillating(95.0, 80.0, D(28), 1, 5.0)),
    "with": (SWING, Oscillating(95.0, 80.0, D(50), -1, -5.0)),
}
CURVES: dict[str, CentreEnvelope | FaceEnvelope] = {}
for _name, (_lift, _mount) in MOUNTS.items():
    CURVES[f"path, {_name}"] = CentreEnvelope(_lift, _mount, 0.0, D(110))
    CURVES[f"roller, {_name}"] = CentreEnvelope(_lift, _mount, 0.1, D(100), -9.0)
    CURVES[f"outer wall, {_name}"] = CentreEnvelope(_lift, _mount, 0.1, D(100), 9.0)
    CURVES[f"face, {_name}"] = FaceEnvelope(_lift, _mount, 0.0, D(110), 0.4)
EVERY = pytest.mark.parametrize("name", CURVES)


def exact_lift(piece: LawPiece, t: Any) -> Any:
    """The piece at 50 digits, from its coefficients and waves."""
    share = (t - MP.mpf(piece.start)) / (MP.mpf(piece.end) - MP.mpf(piece.start))
    n = len(piece.coefficients) - 1
    total = sum(
        MP.binomial(n, k) * MP.mpf(c) * share**k * (1 - share) ** (n - k) for k, c in enumerate(piece.coefficients)
    )
    return total + sum(
        MP.mpf(w.amplitude) * MP.sin(MP.mpf(w.frequency) * (t - MP.mpf(piece.start)) + MP.mpf(w.phase))
        for w in piece.waves
    )


def exact_point(curve: CentreEnvelope | FaceEnvelope, t: Any) -> Any:
    """The curve from geometry: a circle about the centre or a line, and its envelope by numerical differentiation."""
    mount, back = curve.mount, MP.expj

    def centre(x: Any) -> Any:
        s = exact_lift(curve.lift, x)  # type: ignore[arg-type]
        if isinstance(mount, Translating):
            return MP.mpc(mount.offset, mount.start_height + s) * back(-x)
        arm = MP.mpf(mount.arm_length) * MP.expj(MP.pi - mount.sense * (MP.mpf(mount.start_angle) + s))
        return (mount.centre_distance + arm) * back(-x)

    def line(x: Any) -> Any:
        """A point of the face and its direction."""
        s = exact_lift(curve.lift, x)  # type: ignore[arg-type]
        if isinstance(mount, Translating):
            return MP.mpc(0, mount.start_height + s + curve.distance) * back(-x), back(-x)
        way = MP.expj(MP.pi - mount.sense * (MP.mpf(mount.start_angle) + s))
        normal = way * MP.mpc(0, -mount.sense)
        return (mount.centre_distance + (MP.mpf(curve.distance) - mount.face_offset) * normal) * back(-x), way * back(
            -x
        )

    if isinstance(curve, CentreEnvelope):
        if curve.distance == 0:
            return centre(t)
        way = MP.diff(centre, t)
        return centre(t) + MP.mpc(0, curve.distance) * way / abs(way)
    point, way = line(t)
    point_rate, way_rate = MP.diff(lambda x: line(x)[0], t), MP.diff(lambda x: line(x)[1], t)
    # the face's point whose velocity runs along the face
    step = -(MP.conj(way) * point_rate).imag / (MP.conj(way) * way_rate).imag
    return point + step * way


@EVERY
def test_one_evaluation_gives_the_point_and_its_derivatives(name: str) -> None:
    laws.check_derivatives_together(CURVES[name])


@pytest.mark.sampled(1)
@EVERY
def test_points_and_derivatives_against_fifty_digits(name: str) -> None:
    curve = CURVES[name]
    low, high = curve.domain
    for t in (low + 0.02, 0.4 * low + 0.6 * high, high - 0.01):
        assert abs(complex(curve.point(t)) - complex(exact_point(curve, MP.mpf(t)))) <= 1e-12
        for order in (1, 2, 3, 4):
            exact = MP.diff(lambda x: exact_point(curve, x), MP.mpf(t), order, h=MP.mpf(10) ** -6)
            bound = curve.derivative_bound(order, low, high)
            assert bound is not None
            assert abs(complex(curve.derivative(t, order)) - complex(exact)) <= 1e-8 * bound


@EVERY
def test_tangent_and_curvature_follow_from_the_derivatives(name: str) -> None:
    curve = CURVES[name]
    t = np.linspace(*curve.domain, 41)
    first, second = curve.derivative(t), curve.derivative(t, 2)
    assert np.allclose(curve.tangent(t), first / np.abs(first), atol=1e-12)
    assert np.allclose(curve.curvature(t), (np.conj(first) * second).imag / np.abs(first) ** 3, rtol=1e-9, atol=1e-12)


@pytest.mark.sampled(3)
@EVERY
def test_bounds_hold_and_are_sharp_on_short_intervals(name: str) -> None:
    curve = CURVES[name]
    low, high = curve.domain
    for a, b in ((0.0, 1.0), (0.0, 0.2), (0.4, 0.5), (0.8, 1.0)):
        start, end = low + a * (high - low), low + b * (high - low)
        t = np.linspace(start, end, 401)
        for order in (1, 2, 3, 4):
            bound = curve.derivative_bound(order, start, end)
            assert bound is not None
            largest = float(np.abs(curve.derivative(t, order)).max())
            assert largest <= bound
            if b - a < 0.3 and order <= 2:
                assert bound <= 2 * largest


@pytest.mark.sampled(3)
@EVERY
def test_laws_of_any_curve(name: str) -> None:
    curve = CURVES[name]
    assert isinstance(curve, Curve)
    laws.check_reversal(curve)
    laws.check_placement(curve, Placement2(0.7, 3 - 2j))
    laws.check_trimming(curve, 0.2, 0.7)
    laws.check_offset_adds(curve, 0.3, -0.2)
    for distance in (-1.5, -0.2, 0.2, 2.0):
        laws.check_cusp(curve, distance)


@pytest.mark.sampled(8)
@EVERY
def test_mirrored_and_carried(name: str) -> None:
    curve = CURVES[name]
    mirrored = curve.mirrored()
    assert isinstance(mirrored, Mirrored)
    assert isinstance(mirrored, Curve)
    t = np.linspace(*curve.domain, 9)
    assert np.allclose(mirrored.point(-t), np.conj(curve.point(t)))
    assert np.allclose(mirrored.derivative(-t, 3), -np.conj(curve.derivative(t, 3)))
    assert np.allclose(mirrored.curvature(-t), curve.curvature(t))
    assert np.allclose(mirrored.tangent(-t), -np.conj(curve.tangent(t)))
    # material stays on its side: offset and mirror commute
    assert np.allclose(mirrored.offset(0.2).point(-t), np.conj(curve.offset(0.2).point(t)))
    laws.check_reversal(mirrored)
    laws.check_placement(mirrored, Placement2(-0.4, 1 + 2j))
    carried = curve.placed(Placement2(1.1, 2j))
    assert isinstance(carried, Carried)
    laws.check_offset_distance(carried, 0.3)
    assert np.allclose(carried.mirrored().point(-t), np.conj(carried.point(t)))
    assert mirrored.mirrored() == curve


def test_a_large_roller_has_a_cusp_where_the_radius_says() -> None:
    path = CURVES["path, translating"]
    assert isinstance(path, CentreEnvelope)
    t = np.linspace(*path.domain, 4001)
    radii = -1 / path.pitch_curvature(t)
    least = float(radii[radii > 0].min())
    path.offset(-0.999 * least)
    with pytest.raises(CuspError):
        path.offset(-1.001 * least)


def whole_cams() -> dict[str, DiskCam]:
    lift = follower_motion(
        [rise(D(130), 30, polynomial_345()), dwell(D(50)), return_(D(130), 30, sine()), dwell(D(50))]
    )
    swing = follower_motion(
        [rise(D(130), D(20), modified_sine()), dwell(D(50)), return_(D(130), D(20), polynomial_4567()), dwell(D(50))]
    )
    kinds = FollowerKind
    return {
        "pointed": translating_cam(lift, kinds.POINTED, 30, follower_offset=3),
        "roller": translating_cam(lift, kinds.ROLLER, 30, radius=10, follower_offset=3),
        "concave roller": translating_cam(lift, kinds.ROLLER, 12, radius=9),
        "mushroom": translating_cam(lift, kinds.MUSHROOM, 60, radius=30, follower_offset=-3),
        "flat": translating_cam(lift, kinds.FLAT, 45, follower_offset=2),
        "oscillating roller": oscillating_cam(swing, kinds.ROLLER, 40, centre_distance=100, arm_length=80, radius=10),
        "oscillating flat": oscillating_cam(swing, kinds.FLAT, 60, centre_distance=100, sense=-1, face_offset=5),
    }


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("name", "arcs"), [
    *((name, True) for name in whole_cams()), ("concave roller", False), ("oscillating flat", False), ("flat", False),
])  # fmt: skip
def test_outlines_stay_within_their_declared_error(name: str, arcs: bool) -> None:
    """Arcs and chords, measured densely both ways; curves with inflections are split there."""
    cam = whole_cams()[name]
    profile = cam_shape(cam).profile
    made = approximate_profile(profile, 0.005, arcs=arcs)
    assert made.bound == "certified"
    assert made.max_error <= 0.005
    contour = made.geometry
    points = edge_points(
        contour.vertices, contour.period_ends(), contour.bulges, np.linspace(0, 1, 21 if arcs else 9)
    ).ravel()
    measured = float(distance_to_profile(points, profile, trusted=0.0).max())
    assert measured <= made.max_error * (1 + 1e-9)
    assert measured >= 0.3 * made.max_error
    assert len(contour) <= (60 if arcs else 400)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("name", "degree"), [("roller", 3), ("flat", 7)])
def test_splines_stay_within_a_nanometre(name: str, degree: int) -> None:
    cam = whole_cams()[name]
    profile = cam_shape(cam).profile
    made = spline_outline(profile, 1e-6, degree=degree, continuity=degree - 1)
    assert made.bound == "certified"
    assert made.max_error <= 1e-6
    points = np.concatenate([c.point(np.linspace(*c.domain, 501)) for c in made.period])
    assert float(distance_to_profile(points, profile, trusted=0.0).max()) <= made.max_error * (1 + 1e-9)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", whole_cams())
def test_profiles_are_counter_clockwise_and_dwell_on_arcs(name: str) -> None:
    cam = whole_cams()[name]
    profile = cam_shape(cam).profile
    dwells = [s.curve for s in profile.period if isinstance(s.curve, Arc)]
    assert len(dwells) == 2
    assert all(abs(a.centre) == 0 and a.sweep == pytest.approx(D(50)) for a in dwells)
    angle = np.linspace(0, 2 * math.pi, 10_001)
    polygon = cam.profile_point(angle)[::-1]
    area = 0.5 * float(np.sum((np.conj(polygon[:-1]) * polygon[1:]).imag))
    assert profile_area(profile) == pytest.approx(area, rel=1e-6)
    assert profile_area(profile) > 0
    for segment in profile.period:
        bend = segment.curve.curvature(np.linspace(*segment.curve.domain, 33)[1:-1])
        assert np.all(bend > 0) or np.all(bend < 0)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("grow", [-0.6, 0.6])
@pytest.mark.parametrize("name", whole_cams())
def test_grown_outlines_are_parallel(name: str, grow: float) -> None:
    cam = whole_cams()[name]
    profile, moved = cam_shape(cam).profile, cam_shape(cam, grow).profile
    points = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 65)) for s in moved.period])
    assert np.allclose(distance_to_profile(points, profile), abs(grow), atol=1e-10)
    assert (profile_area(moved) - profile_area(profile)) * grow > 0


def test_an_imported_table_makes_the_cam_of_its_law() -> None:
    """Lift every degree: the spline's cam is within a micrometre of the law's, and smooth."""
    lift = follower_motion(
        [rise(D(130), 30, polynomial_345()), dwell(D(50)), return_(D(130), 30, sine()), dwell(D(50))]
    )
    angles = np.radians(np.arange(361.0))
    read = motion_of_table(angles, lift.value(angles))
    t = np.linspace(0, 2 * math.pi, 1441)
    assert np.abs(read.value(t) - lift.value(t)).max() <= 1e-4
    cams = [translating_cam(m, FollowerKind.ROLLER, 30, radius=10) for m in (lift, read)]
    assert np.abs(cams[0].profile_point(t) - cams[1].profile_point(t)).max() <= 2e-3
    assert all(j.continuity >= 2 for j in read.joints())


def test_reversed_segments_are_the_protocols() -> None:
    profile = cam_shape(whole_cams()["roller"]).profile
    assert all(isinstance(s.curve, Arc | Reversed) for s in profile.period)
