"""Walls of cylindrical cams against a brute-force envelope, screws, rings, and 40-digit integrals."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from geometry.approximation.chords import approximate_profile
from geometry.approximation.outline import spline_outline
from geometry.base.errors import OffsetError
from geometry.base.record import replace
from geometry.cams.barrel.body import BarrelBody, barrel_moments
from geometry.cams.barrel.cam import LOWER, UPPER, AxialGuide, BarrelCam, Guide, SwingGuide
from geometry.cams.barrel.development import DevelopedEdge, development
from geometry.cams.barrel.sliding import cam_sliding
from geometry.cams.barrel.splines import barrel_splines
from geometry.cams.motion.follower_motion import (
    FollowerMotion,
    PhaseKind,
    dwell,
    follower_motion,
    motion_of_table,
    return_,
)
from geometry.cams.motion.follower_motion import rise as rising
from geometry.laws.named import constant_velocity, modified_sine, polynomial_345
from geometry.plane.measure import profile_area
from geometry.plane.profile import Label, circle
from tests.oracles.exact_gear import MP
from tests.sampling import some_of

RISE, HIGH, FALL = 2.1, 1.0, 1.9
RADIUS, OUTER, INNER = 5.0, 30.0, 22.0


def motion(lift: float) -> FollowerMotion:
    law = polynomial_345()
    rest = 2 * math.pi - RISE - HIGH - FALL
    return follower_motion([rising(RISE, lift, law), dwell(HIGH), return_(FALL, lift, law), dwell(rest)])


AXIAL = BarrelCam(motion(20.0), AxialGuide(15.0), RADIUS, OUTER, INNER)
SWINGING = BarrelCam(motion(0.4), SwingGuide(48.0, 30.0, 50.0, -0.25), RADIUS, OUTER, INNER)
BACKWARDS = BarrelCam(motion(0.4), SwingGuide(-48.0, 30.0, 50.0, -0.2), RADIUS, OUTER, INNER)
# apex on the cam's axis, and blunter cones
CONES = [replace(AXIAL, taper=RADIUS / OUTER, reference=OUTER), replace(SWINGING, taper=0.4, reference=OUTER),
         replace(BACKWARDS, taper=0.1, reference=OUTER)]  # fmt: skip
CAMS = pytest.mark.parametrize("cam", [AXIAL, SWINGING, BACKWARDS, *CONES],
                               ids=["axial", "swinging", "backwards", "apex", "blunt", "slim"])  # fmt: skip


def exact_lift(lift: float, angle: Any) -> Any:
    """S of the 3-4-5 polynomial by 40 digits, from the textbook's powers."""

    def s(u: Any) -> Any:
        return u**3 * (10 - 15 * u + 6 * u**2)

    if angle <= RISE:
        return lift * s(angle / MP.mpf(RISE))
    if angle <= RISE + HIGH:
        return MP.mpf(lift)
    if angle <= RISE + HIGH + FALL:
        return lift * (1 - s((angle - RISE - HIGH) / MP.mpf(FALL)))
    return MP.mpf(0)


def exact_place(guide: Guide, angle: Any) -> tuple[Any, Any]:
    """y and z of the roller's axis by 40 digits: from the triangle of the arm, not from the code."""
    if isinstance(guide, AxialGuide):
        return MP.mpf(0), guide.start_height + exact_lift(20.0, angle)
    psi = guide.start_angle + exact_lift(0.4, angle)
    away = -1 if guide.pivot_offset > 0 else 1
    return (guide.pivot_offset + away * guide.arm_length * MP.cos(psi),
            guide.pivot_height + guide.arm_length * MP.sin(psi))  # fmt: skip


def exact_distance(cam: BarrelCam, point: np.ndarray, angle: Any) -> Any:
    """Distance of a point of the cam from the roller, across its axis, when the cam has turned by an angle."""
    x, y, z = (MP.mpf(float(c)) for c in point)
    across = x * MP.sin(angle) + y * MP.cos(angle)
    place = exact_place(cam.guide, angle)
    along = x * MP.cos(angle) - y * MP.sin(angle)
    return MP.hypot(across - place[0], z - place[1]) - cam.radius - cam.taper * (along - cam.reference)


def swept_distance(cam: BarrelCam, points: np.ndarray, steps: int = 20_001) -> np.ndarray:
    """Least distance of points from the roller over one turn, across its axis, by sampling alone."""
    angles = np.linspace(0, 2 * math.pi, steps)
    place = cam.place(angles, 0)[0]
    found = []
    for x, y, z in points:
        turned = (x + 1j * y) * np.exp(1j * angles)
        away = np.abs(turned.imag + 1j * z - place) - cam.radius - cam.taper * (turned.real - cam.reference)
        found.append(away[turned.real > 0].min())
    return np.array(found)


@pytest.mark.sampled(1)
@CAMS
@pytest.mark.parametrize("side", [UPPER, LOWER])
def test_a_wall_is_the_envelope_of_the_roller(cam: BarrelCam, side: int) -> None:
    """Its points are touched at their own cam angle, to 1e-11 at 40 digits, and cut by the roller at no other."""
    for angle in (0.4, 1.3, 2.0, 2.9, 3.5, 4.6):
        for radius in (INNER, 25.0, OUTER):
            point = cam.wall(angle, side, radius)
            assert math.hypot(point[0], point[1]) == pytest.approx(radius, abs=1e-12)
            here = exact_distance(cam, point, MP.mpf(angle))
            assert abs(here) < 1e-11
            slope = MP.diff(lambda t, p=point: exact_distance(cam, p, t), MP.mpf(angle))
            assert abs(slope) < 1e-10
    angles = np.linspace(0, 2 * math.pi, 60, endpoint=False)
    points = np.concatenate([cam.wall(angles, side, radius) for radius in (INNER, OUTER)])
    swept = swept_distance(cam, points)
    assert swept.min() > -1e-12
    assert swept.max() < 5e-6
    assert np.abs(cam.distance(points)).max() < 1e-12


def test_a_parallel_curve_at_one_radius_is_not_the_wall() -> None:
    """The outer edge carried inwards along the radius, as flat developments do it, is off by tenths of a mm."""
    angle = 1.05
    outer = AXIAL.wall(angle, UPPER, OUTER)
    carried = outer * np.array([INNER / OUTER, INNER / OUTER, 1.0])
    assert abs(exact_distance(AXIAL, carried, MP.mpf(angle))) > 0.1
    assert abs(float(AXIAL.distance(carried[None])[0])) > 0.05


def test_distance_finds_how_far_a_point_is_from_the_wall() -> None:
    angles = np.linspace(0, 6, 50)
    for shift in (-0.3, 0.2):
        other = replace(AXIAL, radius=RADIUS + shift)
        found = AXIAL.distance(other.wall(angles, LOWER, 26.0))
        assert np.abs(found - shift).max() < 1e-12


@pytest.mark.parametrize("cam", CONES, ids=["apex", "blunt", "slim"])
def test_a_cone_moved_along_its_normals_leaves_a_parallel_wall(cam: BarrelCam) -> None:
    for shift in (-0.3, 0.2):
        other = replace(cam, radius=RADIUS + shift * math.hypot(1, cam.taper))
        found = cam.distance(other.wall(np.linspace(0, 6, 50), UPPER, 26.0))
        assert np.abs(found - shift).max() < 1e-12


def test_a_cone_with_its_apex_on_the_cams_axis_does_not_slide_while_it_rests() -> None:
    """The surface of the cam runs at the speed rho, a cylinder of 5 mm at 5 times its turns: 22 to 30 mm, 4/26 slides.

    A cone of another angle slides again, by the speeds rho / r(rho) of both ends.
    """
    rest = replace(AXIAL, motion=follower_motion([dwell(2 * math.pi)]))
    assert cam_sliding(rest) == pytest.approx(4 / 26, rel=1e-12)
    assert cam_sliding(replace(rest, taper=RADIUS / OUTER, reference=OUTER)) < 1e-14
    ends = INNER / (RADIUS - 0.3 * 8), OUTER / RADIUS
    blunt = replace(rest, taper=0.3, reference=OUTER)
    assert cam_sliding(blunt) == pytest.approx(abs(ends[0] - ends[1]) / sum(ends), rel=1e-12)
    # while it moves, the contact line turns away from the ray of the apex, and less than half of the sliding is left
    assert cam_sliding(CONES[0]) < 0.5 * cam_sliding(AXIAL)


def test_a_constant_slope_makes_screw_surfaces() -> None:
    cam = BarrelCam(follower_motion([rising(3.0, 20.0, constant_velocity()),
                                     return_(2 * math.pi - 3.0, 20.0, constant_velocity())]),
                    AxialGuide(10.0), RADIUS, OUTER, INNER)  # fmt: skip
    for side in (UPPER, LOWER):
        first, second = (cam.wall(t, side, np.linspace(INNER, OUTER, 5), cam.motion.pieces[0]) for t in (0.5, 1.7))
        turn = np.exp(-1j * 1.2)
        plane = (first[:, 0] + 1j * first[:, 1]) * turn
        moved = np.stack([plane.real, plane.imag, first[:, 2] + 1.2 * 20.0 / 3.0], axis=1)
        assert np.abs(moved - second).max() < 1e-12


def test_a_resting_roller_leaves_a_plane_ring() -> None:
    still = follower_motion([dwell(2 * math.pi)])
    cam = BarrelCam(still, AxialGuide(20.0), RADIUS, OUTER, INNER)
    assert np.all(cam.wall(np.linspace(0, 6, 9), UPPER, 25.0)[:, 2] == 25.0)
    body = BarrelBody(cam, 40.0, circle(6.0, Label.BORE, hole=True), (12.0, 3.0, 5.0))
    found = barrel_moments(body)
    channel = math.pi * 2 * RADIUS * (OUTER**2 - INNER**2)
    exact = math.pi * (40 * OUTER**2 + 8 * 144 - 48 * 36) - channel
    assert found.volume == pytest.approx(exact, rel=1e-14)
    inertia = math.pi / 2 * (40 * OUTER**4 + 8 * 12**4 - 48 * 6**4 - 2 * RADIUS * (OUTER**4 - INNER**4))
    assert found.inertia[2, 2] == pytest.approx(inertia, rel=1e-13)


def test_a_resting_cone_leaves_cones() -> None:
    """Its groove is 2 r(rho) wide: 4 pi times the integral of rho (r + k (rho - R)), a polynomial."""
    cone = BarrelCam(
        follower_motion([dwell(2 * math.pi)]), AxialGuide(20.0), RADIUS, OUTER, INNER, taper=0.2, reference=OUTER
    )
    base = RADIUS - 0.2 * OUTER
    exact = 4 * math.pi * (base * (OUTER**2 - INNER**2) / 2 + 0.2 * (OUTER**3 - INNER**3) / 3)
    assert math.pi * OUTER**2 * 40 - barrel_moments(BarrelBody(cone, 40.0)).volume == pytest.approx(exact, rel=1e-12)


def cut_area(radius: float) -> float:
    """Area that an axial groove takes from a cylinder: the integral of (z_up - z_low) R d theta, by parts over phi."""
    u, weights = np.polynomial.legendre.leggauss(80)
    u = (u + 1) / 2
    total = RADIUS * (2 * math.pi - RISE - FALL)
    for width in (RISE, FALL):
        slope = 20.0 * 30 * u**2 * (1 - u) ** 2 / width
        square = radius**2
        rho = np.sqrt((square - slope**2 + np.sqrt((square + slope**2) ** 2 - 4 * slope**2 * RADIUS**2)) / 2)
        far = np.hypot(rho, slope)
        height = RADIUS * rho / far + slope * np.arcsin(RADIUS * slope / far / radius)
        total += width / 2 * float(weights @ height)
    return 2 * radius * total


def test_the_volume_of_a_groove_by_a_formula_of_its_own() -> None:
    nodes, weights = np.polynomial.legendre.leggauss(5)
    half, middle = (OUTER - INNER) / 2, (OUTER + INNER) / 2
    groove = sum(w * half * cut_area(middle + half * x) for x, w in zip(nodes, weights, strict=True))
    found = barrel_moments(BarrelBody(AXIAL, 50.0))
    assert math.pi * OUTER**2 * 50 - found.volume == pytest.approx(groove, rel=1e-9)


@pytest.mark.sampled(1)
@CAMS
def test_a_roller_that_is_too_large_undercuts_where_the_speed_says(cam: BarrelCam) -> None:
    """Where every edge's speed is positive no other position cuts a wall; else some does."""
    steep = replace(cam, motion=motion(cam.motion.lift * 1.5), outer=40.0)
    for radius in np.linspace(2.0, 20.0, 7).tolist():
        tried = replace(steep, radius=radius)
        speed, at = tried.least_edge_speed()
        angles = np.concatenate([np.linspace(0, 2 * math.pi, 40), at + np.linspace(-0.2, 0.2, 20)])
        if tried.radius_at(0.7 * INNER) <= 0:
            continue
        points = np.concatenate([tried.wall(angles, side, r) for side in tried.sides for r in (INNER, 31.0, 40.0)])
        least = swept_distance(tried, points, 2_001).min()
        if speed > 0.02:
            assert least > -1e-3
        elif speed < -0.02:
            assert least < -1e-3


def test_the_pressure_angle_is_greatest_at_the_floor() -> None:
    slope = 20.0 / RISE * 1.875
    value, at = AXIAL.greatest_pressure_angle(PhaseKind.RISE)
    assert at == pytest.approx(RISE / 2, abs=1e-4)
    # rho of the floor's end of the contact line, by the quadratic equation
    square = (INNER**2 - slope**2 + math.sqrt((INNER**2 + slope**2) ** 2 - 4 * slope**2 * RADIUS**2)) / 2
    assert math.tan(value) == pytest.approx(slope / math.sqrt(square), rel=1e-7)


@pytest.mark.sampled(1)
@CAMS
def test_developed_edges_and_their_derivatives(cam: BarrelCam) -> None:
    for side in (UPPER, LOWER):
        edge = DevelopedEdge(cam, cam.motion.pieces[0], side, 10.0, 0.0, RISE)
        t, step = np.linspace(0.2, RISE - 0.2, 9), 1e-3
        wall = cam.wall(t, side, OUTER)
        assert (
            np.abs(OUTER * np.exp(1j * (edge.point(t).real / OUTER - math.pi)) - wall[:, 0] - 1j * wall[:, 1]).max()
            < 1e-11
        )
        assert np.abs(edge.point(t).imag + 10.0 - wall[:, 2]).max() < 1e-12
        before: Callable[[np.ndarray], np.ndarray] = edge.point
        for order in (1, 2, 3, 4):
            # Richardson's two central differences
            slope = [(before(t + h) - before(t - h)) / (2 * h) for h in (step, step / 2)]
            exact = edge.derivative(t, order)
            assert np.abs((4 * slope[1] - slope[0]) / 3 - exact).max() < 1e-6 * np.abs(exact).max()
            before = partial(edge.derivative, order=order)


@pytest.mark.sampled(1)
@CAMS
def test_bounds_of_developed_edges_hold(cam: BarrelCam) -> None:
    """Against derivatives at many places of each interval of a rise and a rest; short ones are near the truth."""
    for piece in cam.motion.pieces[:2]:
        for side, distance in some_of(((UPPER, 0.0), (LOWER, 0.3))):
            edge = DevelopedEdge(cam, piece, side, 0.0, piece.start, piece.end, distance)
            for parts, sharp in ((3, 1e9), (8, 8.0)):
                cuts = np.linspace(*piece.domain, parts + 1)
                for low, high in pairwise(cuts.tolist()):
                    inside = edge.derivatives(np.linspace(low, high, 15), 4)
                    for order in (1, 2, 3, 4):
                        found = edge.derivative_bound(order, low, high)
                        most = float(np.abs(inside[order]).max())
                        if found is None:
                            # a parallel over so long a piece may turn back for all that is known
                            assert parts == 3
                            assert distance
                            continue
                        assert most <= found * (1 + 1e-12)
                        assert order > 1 or distance or found <= sharp * most


def test_flat_outlines_are_proven() -> None:
    """Chords, arcs and splines, moved or not."""
    for cam, offset, arcs in some_of(((AXIAL, 0.0, False), (CONES[1], 0.2, True))):
        made = approximate_profile(development(cam, 50.0, offset).region.outer, 0.01, arcs=arcs)
        assert made.bound == "certified"
        assert made.max_error <= 0.01
    lower = development(AXIAL, 50.0, 0.2).region.outer
    assert spline_outline(lower, 1e-2, degree=3, continuity=2).bound == "certified"


def test_jackets_have_the_area_that_is_left() -> None:
    """Both jackets together lose what the groove takes, and grow by their border when they are moved out."""
    region = development(AXIAL, 50.0).region
    assert len(region.profiles()) == 2
    area = sum(profile_area(p) for p in region.profiles())
    assert area == pytest.approx(2 * math.pi * OUTER * 50 - cut_area(OUTER), rel=1e-11)
    for offset in some_of((0.5, -0.5)):
        moved = development(AXIAL, 50.0, offset).region
        for before, after in zip(region.profiles(), moved.profiles(), strict=True):
            growth = (profile_area(after) - profile_area(before)) / offset
            assert growth == pytest.approx(2 * 2 * math.pi * OUTER, rel=0.2)
    with pytest.raises(OffsetError) as refusal:
        development(AXIAL, 50.0, -6.0)
    development(AXIAL, 50.0, refusal.value.nearest_offset)


def test_spline_walls_keep_their_word() -> None:
    """Held against the roller's way at places that the fit has not seen."""
    table = motion_of_table(
        [k * math.pi / 6 for k in range(12)], [5 + 4 * math.sin(k * math.pi / 6 + 0.4) for k in range(12)]
    )
    cams = (SWINGING, CONES[0], BarrelCam(table, AxialGuide(20.0), RADIUS, OUTER, INNER, is_groove=False),
            BarrelCam(motion_soft(), AxialGuide(10.0), RADIUS, OUTER, INNER))  # fmt: skip
    for cam in some_of(cams, 2):
        made = barrel_splines(cam, 1e-6)
        assert made.max_error < 4e-8
        for walls in made.walls.values():
            whole = sum(w.stretch.end - w.stretch.start for w in walls)
            assert whole == pytest.approx(2 * math.pi, abs=1e-12)
            for wall in walls:
                points = sampled(wall.along, wall.across, wall.poles)
                assert np.abs(cam.distance(points)).max() <= made.max_error


def motion_soft() -> FollowerMotion:
    return follower_motion([rising(2.0, 12.0, modified_sine()), return_(2 * math.pi - 2.0, 12.0, modified_sine())])


def sampled(along: np.ndarray, across: np.ndarray, poles: np.ndarray) -> np.ndarray:
    """Points of a tensor-product spline by the Cox-de Boor recursion, at random parameters."""

    def values(knots: np.ndarray, t: float) -> np.ndarray:
        found = ((knots[:-1] <= t) & (t < knots[1:])).astype(float)
        for p in range(1, 8):
            width = knots[p:] - knots[:-p]
            share = np.divide(t - knots[:-p], width, out=np.zeros(len(width)), where=width > 0)
            rest = np.divide(knots[p:] - t, width, out=np.zeros(len(width)), where=width > 0)
            found = share[:-1] * found[:-1] + rest[1:] * found[1:]
        return found

    rng = np.random.default_rng(3)
    found = []
    for _ in range(4):
        u, v = (knots[0] + rng.random() * (knots[-1] - knots[0]) for knots in (along, across))
        found.append(np.einsum("i,j,ijc->c", values(along, u), values(across, v), poles))
    return np.array(found)
