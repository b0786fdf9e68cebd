"""What barrel cams tell by derivatives, against differences of the walls themselves; a guide that is moved up."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from geometry.base.record import replace
from geometry.cams.barrel.body import Ring, Track
from geometry.cams.barrel.cam import LOWER, UPPER, BarrelCam, SwingGuide
from geometry.cams.motion.follower_motion import PhaseKind
from tests.geometry.cams.barrel.test_barrel import CAMS, INNER, OUTER

STEP = 1e-5
ANGLES = np.linspace(0.2, 5.0, 13)


def moving(cam: BarrelCam) -> list[tuple[np.ndarray, object]]:
    """Cam angles within each piece that moves, with the piece."""
    return [(np.linspace(*p.domain, 9)[1:-1], p) for p in cam.motion.moving_pieces()]


@pytest.mark.sampled(6)
@CAMS
@pytest.mark.parametrize("side", [UPPER, LOWER])
def test_how_fast_an_edge_goes_round_is_the_slope_of_its_polar_angle(cam: BarrelCam, side: int) -> None:
    for angles, piece in moving(cam):
        for radius in (INNER, 26.0, OUTER):
            before, after = (cam.wall(angles + k * STEP, side, radius, piece) for k in (-1, 1))
            polar = np.angle((after[:, 0] + 1j * after[:, 1]) / (before[:, 0] + 1j * before[:, 1]))
            assert cam.edge_speed(angles, side, radius, piece) == pytest.approx(-polar / (2 * STEP), abs=2e-8)


@pytest.mark.sampled(6)
@CAMS
@pytest.mark.parametrize("side", [UPPER, LOWER])
def test_the_pressure_angle_is_that_of_the_wall_s_own_normal(cam: BarrelCam, side: int) -> None:
    """The normal by differences along the wall and round it; the way of the roller by differences of its place."""
    for angles, piece in moving(cam):
        for radius in (INNER, OUTER):
            along = cam.wall(angles + STEP, side, radius, piece) - cam.wall(angles - STEP, side, radius, piece)
            across = cam.wall(angles, side, radius + STEP, piece) - cam.wall(angles, side, radius - STEP, piece)
            normal = np.cross(along, across)
            normal /= np.linalg.norm(normal, axis=1)[:, None]
            if isinstance(cam.guide, SwingGuide):
                arm = cam.place(angles, 0, piece)[0] - complex(cam.guide.pivot_offset, cam.guide.pivot_height)
                way = 1j * arm / np.abs(arm)
            else:
                way = np.full(len(angles), 1j)
            # in the cam's frame the roller's own plane is turned back
            aside = 1j * np.exp(-1j * angles)
            ways = np.stack([(way.real * aside).real, (way.real * aside).imag, way.imag], axis=1)
            cosine = np.abs(np.sum(normal * ways, axis=1))
            assert cam.pressure_angle(angles, radius, piece, side) == pytest.approx(np.arccos(cosine), abs=2e-5)


@CAMS
def test_the_extremes_of_a_cam_are_those_of_dense_samples(cam: BarrelCam) -> None:
    speeds = {}
    for piece in cam.motion.moving_pieces():
        at = np.linspace(*piece.domain, 400)
        for side in cam.sides:
            for radius in (INNER, 26.0, OUTER):
                found = cam.edge_speed(at, side, radius, piece)
                speeds[float(found.min())] = float(at[found.argmin()])
    least, where = cam.least_edge_speed()
    assert least <= min(speeds) + 1e-9
    assert least == pytest.approx(min(*speeds, 1.0), abs=2e-3)
    if least < 0.999:
        here = [p for p in cam.motion.moving_pieces() if p.domain[0] <= where <= p.domain[1]]
        told = [cam.edge_speed(np.array([where]), s, r, p)[0] for p in here for s in cam.sides for r in (INNER, OUTER)]
        assert min(told) == pytest.approx(least, abs=1e-3)
    for kind in (PhaseKind.RISE, PhaseKind.RETURN):
        pressures = {}
        for piece in cam.motion.moving_pieces(kind):
            at = np.linspace(*piece.domain, 400)
            for side in cam.sides:
                found = cam.pressure_angle(at, INNER, piece, side)
                pressures[float(found.max())] = float(at[found.argmax()])
        most, where = cam.greatest_pressure_angle(kind)
        assert most >= max(pressures) - 1e-12
        assert most == pytest.approx(max(pressures), abs=1e-4)
        assert where == pytest.approx(pressures[max(pressures)], abs=0.02)
    speed = max(np.abs(np.gradient(cam.place(np.linspace(0, 2 * math.pi, 4000), 0)[0], 2 * math.pi / 3999)))
    assert cam.fastest == pytest.approx(speed, rel=0.02)


@CAMS
def test_a_cam_under_a_raised_guide_is_the_same_cam_higher(cam: BarrelCam) -> None:
    raised = replace(cam, guide=cam.guide.raised(7.5))
    for side in cam.sides:
        up = raised.wall(ANGLES, side, 26.0) - cam.wall(ANGLES, side, 26.0)
        assert up == pytest.approx(np.tile([0.0, 0.0, 7.5], (len(ANGLES), 1)), abs=1e-12)


@pytest.mark.sampled(2)
@CAMS
@pytest.mark.parametrize("side", [UPPER, LOWER])
def test_points_off_a_wall_are_so_far_from_the_roller(cam: BarrelCam, side: int) -> None:
    """By the least of dense samples over the cam angle, and by what is known to stand close by."""
    rng = np.random.default_rng(5)
    angles = rng.uniform(0, 2 * math.pi, 30)
    points = cam.wall(angles, side, rng.uniform(INNER, OUTER, 30)) + rng.uniform(-0.6, 0.6, (30, 3))
    turns = np.linspace(0, 2 * math.pi, 20_001)
    turned = (points[:, 0] + 1j * points[:, 1])[:, None] * np.exp(1j * turns)
    gaps = np.abs(turned.imag + 1j * points[:, 2, None] - cam.place(turns, 0)[0])
    # to the surface of a cone along its own normal
    away = (gaps - cam.radius_at(turned.real)) * 1.0
    away = np.where(turned.real > 0, away, np.inf).min(axis=1) * cam.upright
    near = cam.distance(points)
    assert near == pytest.approx(away, abs=2e-5)
    found, at = cam.foot(points, angles, 0.2)
    assert found == pytest.approx(near, abs=1e-9)
    assert np.abs(np.angle(np.exp(1j * (at - angles)))).max() < 0.25
    assert np.sign(cam.nearest(points)[1]) == pytest.approx(np.full(30, float(side)))


@pytest.mark.sampled(2)
@CAMS
@pytest.mark.parametrize("side", [UPPER, LOWER])
def test_a_wall_ends_at_its_cylinders(cam: BarrelCam, side: int) -> None:
    """A point of the wall's own continuation beyond an end is as far from the wall as from its cylinder."""
    track = Track(side, Ring(INNER, side=side), Ring(OUTER, side=side))
    for radius, beyond in ((INNER - 0.5, 0.5), (INNER, 0.0), (26.0, 0.0), (OUTER, 0.0), (OUTER + 0.8, 0.8)):
        points = cam.wall(ANGLES, side, radius)
        assert track.distance(cam, points) == pytest.approx(beyond, abs=1e-9)
        # a mm off the roller's way, by the hypotenuse; the other wall, and what is far beyond, has no distance
        off = points + np.array([0.0, 0.0, 0.01 * side])
        away = cam.distance(off)
        assert np.all((away > 0) & (away < 0.0101))
        assert track.distance(cam, off) == pytest.approx(np.hypot(away, beyond), abs=1e-9)
    far = [cam.wall(ANGLES, -side, 26.0), cam.wall(ANGLES, side, OUTER + 0.06 * INNER), cam.wall(ANGLES, side, 20.0)]
    for points in far:
        assert np.isinf(track.distance(cam, points)).all()


@CAMS
def test_the_greatest_speed_is_asked_of_each_piece_once(cam: BarrelCam, monkeypatch: pytest.MonkeyPatch) -> None:
    """Before, of all pieces for each search of a foot: the square of a table's rows."""
    own, asked, place = replace(cam), [], BarrelCam.place

    def counted(one: BarrelCam, angle: Any, order: int = 1, piece: Any = None) -> Any:
        asked.append(piece)
        return place(one, angle, order, piece)

    monkeypatch.setattr(BarrelCam, "place", counted)
    points, near = np.array([[26.0, 0.0, 0.0]]), np.zeros(1)
    for _ in range(3):
        own.foot(points, near, 0.01)
    told = [piece for piece in asked if piece is not None]
    assert len(told) == len(own.motion.pieces)
