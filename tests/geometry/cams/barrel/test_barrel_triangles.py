"""The proven bound of a mesh's distance from the walls of a cylindrical cam, against brute force."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.base.record import replace
from geometry.cams.barrel.body import BarrelBody
from geometry.cams.barrel.cam import LOWER, UPPER, AxialGuide, BarrelCam
from geometry.cams.barrel.triangles import triangle_bound
from geometry.plane.profile import Label, circle
from parts.solids.barrel_mesh import barrel_mesh
from tests.geometry.cams.barrel.test_barrel import AXIAL, CAMS, CONES, SWINGING, motion

TOLERANCE = 0.05
RNG = np.random.default_rng(5)


def patch(cam: BarrelCam, side: int, step: float, levels: int, start: float = 0.6) -> tuple[np.ndarray, np.ndarray]:
    """Triangles (n, 3, 3) of a strip of a wall, and the cam angles of their corners."""
    angles, radii = start + step * np.arange(6), np.linspace(cam.inner, cam.outer, levels + 1)
    points = cam.wall(angles[:, None], side, radii)
    corners, near = [], []
    for i in range(5):
        for j in range(levels):
            for ring in (((i, j), (i + 1, j), (i + 1, j + 1)), ((i, j), (i + 1, j + 1), (i, j + 1))):
                corners.append([points[k] for k in ring])
                near.append([angles[k[0]] for k in ring])
    return np.array(corners), np.array(near)


def swept(cam: BarrelCam, corners: np.ndarray, near: np.ndarray) -> float:
    """Greatest distance of random points of the triangles from the roller's way: over a fine row of its places."""
    shares = RNG.dirichlet((0.7, 0.7, 0.7), 120)
    points = np.einsum("sk,nkc->nsc", shares, corners).reshape(-1, 3)
    angles = np.linspace(near.min() - 0.6, near.max() + 0.6, 4001)
    found = np.full(len(points), np.inf)
    for t, p in zip(angles, cam.place(angles, 0)[0], strict=True):
        turned = (points[:, 0] + 1j * points[:, 1]) * np.exp(1j * t)
        size = cam.radius + cam.taper * (turned.real - cam.reference)
        away = np.hypot(turned.imag - p.real, points[:, 2] - p.imag) - size
        found = np.minimum(found, away / math.hypot(1, cam.taper))
    return float(np.abs(found).max())


@pytest.mark.sampled(2)
@CAMS
@pytest.mark.parametrize("side", [UPPER, LOWER])
def test_the_bound_is_never_below_the_truth_nor_far_above(cam: BarrelCam, side: int) -> None:
    for step, levels in ((0.05, 3), (0.1, 2)):
        corners, near = patch(cam, side, step, levels)
        truth = swept(cam, corners, near)
        found = triangle_bound(cam, corners, near, step, truth)
        assert truth - 2e-5 <= found <= 1.35 * truth + 1e-4


def test_a_corner_off_the_wall_is_seen() -> None:
    for pick in (0, 7, -1):
        corners, near = patch(AXIAL, LOWER, 0.05, 3)
        good = triangle_bound(AXIAL, corners, near, 0.05, TOLERANCE)
        corners[pick, 1, 2] += 0.3
        assert triangle_bound(AXIAL, corners, near, 0.05, TOLERANCE) > good + 0.1


def test_edges_that_are_long_against_the_roller_prove_nothing() -> None:
    thin = AXIAL.with_radius(0.05)
    corners, near = patch(thin, LOWER, 0.3, 1)
    assert triangle_bound(thin, corners, near, 0.3, 1e-3) == math.inf


@pytest.mark.sampled(1)
@pytest.mark.parametrize("cam", [AXIAL, SWINGING, *CONES[:2], replace(CONES[0], is_groove=False)])
def test_meshes_are_certified(cam: BarrelCam) -> None:
    made = barrel_mesh(BarrelBody(cam, 50.0, web=0.0), TOLERANCE)
    assert made.bound == "certified"
    assert made.max_error <= TOLERANCE


LEVEL = BarrelCam(motion(1.0), AxialGuide(20.0), 5.0, 35.0, 33.0)
# its walls are cut at unlike steps
SWUNG = replace(SWINGING, motion=motion(0.05 * SWINGING.motion.lift), inner=SWINGING.outer - 2.0)


@pytest.mark.parametrize(("cam", "bore"), [(LEVEL, None), (LEVEL, 20.0), (SWUNG, None)])
def test_the_declared_error_is_the_truth_where_cylinders_rule(cam: BarrelCam, bore: float | None) -> None:
    """Nearly level grooves: how near to the axis any edge of a triangle on a cylinder, or on the bore, comes."""
    hole = None if bore is None else circle(bore, Label.HOLE, hole=True)
    made = barrel_mesh(BarrelBody(cam, 60.0, web=0.0, bore=hole), TOLERANCE)
    points = made.vertices[made.geometry]
    away, middle = np.hypot(points[..., 0], points[..., 1]), (points + np.roll(points, 1, axis=1)) / 2
    worst = {}
    for radius in (bore or cam.outer, cam.inner, cam.outer):
        on = np.all(np.abs(away - radius) < 1e-9, axis=1)
        assert on.any()
        worst[radius] = radius - np.hypot(middle[on, :, 0], middle[on, :, 1]).min()
    assert made.max_error == pytest.approx(max(worst.values()), rel=1e-9)


def test_a_mesh_whose_walls_are_not_proven_says_so() -> None:
    assert barrel_mesh(BarrelBody(AXIAL.with_radius(0.05), 50.0, web=0.0), TOLERANCE).bound == "sampled"
