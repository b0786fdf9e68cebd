"""Where the roller rests on triangles of a wall, against points taken all over them."""

from __future__ import annotations

import numpy as np
import pytest

from geometry.cams.barrel.cam import LOWER, UPPER, BarrelCam
from geometry.cams.barrel.rolling import held, rolled_places, wall_height
from geometry.cams.motion.follower_motion import TURN
from tests.geometry.cams.barrel.test_barrel import AXIAL, CONES, INNER, OUTER, SWINGING


@pytest.mark.parametrize("cam", [AXIAL, CONES[0]])
@pytest.mark.parametrize("side", [1, -1])
def test_the_roller_rests_where_no_point_of_a_triangle_is_in_it(cam: BarrelCam, side: int) -> None:
    """Edges steeper and flatter than the roller, long and short, cut by its sides or not; a point is never missed."""
    rng = np.random.default_rng(8)
    u, v = np.meshgrid(np.linspace(0, 1, 181), np.linspace(0, 1, 181))
    weights = np.stack([u * v, u * (1 - v), 1 - u], axis=-1).reshape(-1, 3)
    for size in (0.05, 0.4, 3.0):
        for _ in range(7):
            middle = np.array([rng.uniform(cam.inner + 1, cam.outer - 1), rng.uniform(-1, 1) * cam.radius, 0.0])
            corners = middle + size * rng.normal(size=(1, 3, 3))
            found = float(rolled_places(cam, {side: corners}, 1)[side][0])
            place = complex(cam.place(np.zeros(1), 0)[0][0])
            x, y, z = (weights @ corners[0]).T
            square = cam.radius_at(x) ** 2 - (y - place.real) ** 2
            met = square > 0
            if not met.any():
                continue
            # the axis stands so high that the highest point just touches
            highest = float((np.sqrt(square[met]) + side * (place.imag - z[met])).max())
            assert highest <= side * (place.imag - found) + 1e-9
            assert side * (place.imag - found) <= highest + 0.05 * size


@pytest.mark.sampled(6)
@pytest.mark.parametrize("cam", [AXIAL, SWINGING, CONES[0]], ids=["axial", "swinging", "cone"])
@pytest.mark.parametrize("side", [UPPER, LOWER])
@pytest.mark.parametrize("up", [0.05, -0.05])
def test_a_wall_whose_one_point_is_moved_stands_off_by_as_much(cam: BarrelCam, side: int, up: float) -> None:
    """Fine triangles of the exact wall; the height of the point that was moved along the axis, and where it stands."""
    angles, radii = np.linspace(0.6, 0.7, 7), np.linspace(INNER + 2, OUTER - 2, 4)
    points = cam.wall(angles[:, None], side, radii)
    points[3, 2] += [0.0, 0.0, up]
    a, b, c, d = points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:]
    corners = np.concatenate([np.stack(t, axis=2).reshape(-1, 3, 3) for t in ((a, b, c), (a, c, d))])
    found = wall_height(cam, {side: corners}, 1e-4)
    assert found.found == pytest.approx(abs(up), rel=1e-12)
    assert found.found <= found.bound <= 1.02 * found.found + 1e-9
    assert found.angle == pytest.approx(angles[3], abs=1e-6)
    place = cam.place(angles[3:4], 1)
    assert found.depth == pytest.approx(float(cam.distance_along(place, side, radii[2])[0]), abs=1e-5)
    step = 1e-5
    along = cam.wall(angles[3] + step, side, radii[2]) - cam.wall(angles[3] - step, side, radii[2])
    across = cam.wall(angles[3], side, radii[2] + step) - cam.wall(angles[3], side, radii[2] - step)
    normal = np.cross(along, across)
    assert found.upright == pytest.approx(abs(normal[2]) / np.linalg.norm(normal), abs=1e-6)
    # the other wall, exact but for its triangles, adds nothing; none at all has no height
    whole = {side: corners, -side: cam.wall(angles[:3], -side, radii[:1])[None]}
    assert wall_height(cam, whole, 1e-4) == found
    assert wall_height(cam, {}, 1e-4).bound == 0.0


def test_a_roller_rests_on_walls_at_every_angle() -> None:
    """Of an exact wall, in triangles, the axis is off its law by no more than they stand off the wall; else nowhere."""
    angles, radii = np.linspace(0.0, TURN, 181), np.linspace(INNER, OUTER, 4)
    for side in (UPPER, LOWER):
        points = AXIAL.wall(angles[:, None], side, radii)
        a, b, c, d = points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:]
        corners = np.concatenate([np.stack(t, axis=2).reshape(-1, 3, 3) for t in ((a, b, c), (a, c, d))])
        found = rolled_places(AXIAL, {side: corners}, 40)[side]
        law = AXIAL.place(np.arange(40) * (TURN / 40), 0)[0].imag
        assert 0.001 < np.abs(found - law).max() <= wall_height(AXIAL, {side: corners}, 1e-4).bound
        half = rolled_places(AXIAL, {side: corners[:100]}, 40)[side]
        assert np.isfinite(half).any()
        assert not np.isfinite(half).all()


@pytest.mark.sampled(3)
@pytest.mark.parametrize("cam", [AXIAL, SWINGING], ids=["axial", "swinging"])
@pytest.mark.parametrize("side", [UPPER, LOWER])
@pytest.mark.parametrize("start", [0.6, 2.0])
def test_a_wide_triangle_leaves_the_wall_by_no_more_than_is_told(cam: BarrelCam, side: int, start: float) -> None:
    """Its corners lie on the wall, and what stands farthest in the roller, or off it, is a place between them."""
    ends = zip(start + np.array([0.0, 0.25, 0.1]), (INNER + 2, INNER + 2, OUTER - 2), strict=True)
    corners = np.concatenate(
        [cam.wall(np.array([angle]), side, np.array([radius])).reshape(1, 3) for angle, radius in ends]
    )
    u, v = (share.ravel() for share in np.meshgrid(np.linspace(0, 1, 41), np.linspace(0, 1, 41)))
    points = np.stack([u * v, u * (1 - v), 1 - u], axis=1) @ corners
    angles = np.linspace(start - 0.3, start + 0.6, 601)[:, None]
    heights = held(cam, side, points[None, :, 0] + 1j * points[None, :, 1], points[None, :, 2], angles)[0].max(axis=0)
    found = wall_height(cam, {side: corners[None]}, 1e-6)
    assert np.abs(heights).max() <= found.bound <= 1.025 * np.abs(heights).max()
