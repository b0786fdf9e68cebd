"""Edges of walls on the unrolled outer cylinder: where the roller touches them, against the exact walls."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.cams.barrel.cam import LOWER, UPPER, BarrelCam
from geometry.cams.barrel.rolling import UnrolledWall
from tests.geometry.cams.barrel.test_barrel import CAMS, OUTER

STEP = 1e-5
MIDDLE = 3.5


def edge(cam: BarrelCam, side: int, angles: np.ndarray) -> np.ndarray:
    """Points of the sheet: x round the cylinder from its seam opposite to x on, y up from the sheet's middle."""
    points = cam.wall(angles, side, OUTER)
    return OUTER * (np.arctan2(points[:, 1], points[:, 0]) + math.pi) + 1j * (points[:, 2] - MIDDLE)


@CAMS
@pytest.mark.parametrize("side", [UPPER, LOWER])
def test_the_roller_touches_an_exact_edge_where_it_left_it(cam: BarrelCam, side: int) -> None:
    angles = np.concatenate([np.linspace(*p.domain, 9)[1:-1] for p in cam.motion.moving_pieces()])
    points = edge(cam, side, angles)
    ahead, behind = (edge(cam, side, angles + k * STEP) for k in (-1, 1))
    # out of the material, to the roller below an upper edge; angles near the seam are left out
    along = (ahead - behind) / np.abs(ahead - behind)
    seamless = (np.abs(ahead - behind) < 1.0) & (along.real > 0)
    assert seamless.sum() > 10
    angles, points, along = angles[seamless], points[seamless], along[seamless]
    normal = -1j * side * along
    wall = UnrolledWall(cam, side, MIDDLE)
    height = cam.place(angles, 0)[0].imag
    for offset, up in ((0.0, 0.0), (0.3, 0.0), (-0.2, 1.25)):
        at, found = wall.stop(points + offset * normal + 1j * up, normal, offset)
        assert np.angle(np.exp(1j * (at - angles))) == pytest.approx(np.zeros(len(angles)), abs=2e-8)
        assert found == pytest.approx(height + up, abs=1e-7)
    # and where it faces away, or is level with the roller's way, never
    assert np.isnan(wall.stop(points, -normal, 0.0)[1]).all()
    assert np.isnan(wall.stop(points[:1], np.array([1.0 + 0j]), 0.0)[1]).all()
    upright, away = wall.upright(angles)
    assert upright == pytest.approx(along.real, abs=1e-8)
    start = cam.wall(np.zeros(1), side, OUTER)[0]
    gone = np.abs(np.angle(np.exp(1j * (points.real / OUTER - math.pi)) / complex(start[0], start[1])))
    assert away == pytest.approx(OUTER * gone, abs=1e-9)
