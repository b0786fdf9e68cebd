"""Where the roller rests on triangles of a wall, against points taken all over them."""

from __future__ import annotations

import numpy as np
import pytest

from geometry.cams.barrel.cam import BarrelCam
from geometry.cams.barrel.rolling import rolled_places
from tests.geometry.cams.barrel.test_barrel import AXIAL, CONES


@pytest.mark.parametrize("cam", [AXIAL, CONES[0]])
@pytest.mark.parametrize("side", [1, -1])
def test_the_roller_rests_where_no_point_of_a_triangle_is_in_it(cam: BarrelCam, side: int) -> None:
    """Edges steeper and flatter than the roller, long and short, cut by its sides or not; a point is never missed."""
    rng = np.random.default_rng(8)
    u, v = np.meshgrid(np.linspace(0, 1, 181), np.linspace(0, 1, 181))
    weights = np.stack([u * v, u * (1 - v), 1 - u], axis=-1).reshape(-1, 3)
    for size in (0.05, 0.4, 3.0):
        for _ in range(12):
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
