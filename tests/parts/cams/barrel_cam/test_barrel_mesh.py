"""The proven bound of a mesh's distance from a cylindrical cam, against brute force."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.base.record import replace
from geometry.cams.barrel.body import BarrelBody
from geometry.cams.barrel.cam import LOWER, AxialGuide, BarrelCam
from geometry.cams.barrel.faces import barrel_faces
from geometry.plane.profile import Label, circle
from parts.cams.barrel_cam.probe import walls_of
from parts.solids.face_mesh import faced_mesh
from tests.geometry.cams.barrel.test_barrel import AXIAL, CAMS, CONES, SWINGING, motion

TOLERANCE = 0.05
RNG = np.random.default_rng(5)


def swept(cam: BarrelCam, corners: np.ndarray) -> float:
    """Greatest distance of random points of some triangles from the roller's way: over a fine row of its places."""
    shares, corners = RNG.dirichlet((0.7, 0.7, 0.7), 12), RNG.permutation(corners)[:250]
    points = np.einsum("sk,nkc->nsc", shares, corners).reshape(-1, 3)
    found = np.full(len(points), np.inf)
    angles = np.linspace(0, 2 * math.pi, 6001)
    for t, p in zip(angles, cam.place(angles, 0)[0], strict=True):
        turned = (points[:, 0] + 1j * points[:, 1]) * np.exp(1j * t)
        near = turned.real > 0
        size = cam.radius + cam.taper * (turned.real[near] - cam.reference)
        away = np.hypot(turned.imag[near] - p.real, points[near, 2] - p.imag) - size
        found[near] = np.minimum(found[near], away / math.hypot(1, cam.taper))
    return float(np.abs(found).max())


@pytest.mark.heavy
@CAMS
@pytest.mark.parametrize("tolerance", [0.05, 0.01])
def test_the_declared_error_holds_and_is_near(cam: BarrelCam, tolerance: float) -> None:
    exact = BarrelBody(cam, 50.0)
    body = barrel_faces(exact)
    made = faced_mesh(body, tolerance)
    assert made.bound == "certified"
    assert made.max_error <= tolerance
    corners = made.vertices[made.geometry]
    walls = walls_of(corners, exact)
    assert body.proof is not None
    truth, proven = swept(cam, np.concatenate(list(walls.values()))), body.proof(list(walls.values()), 1e-4)
    # a step along the axis is longer than the way to the wall by the slope of the groove
    assert truth - 1e-4 <= proven <= min(made.max_error, 2 * truth + 1e-4)
    # a corner in the middle of a wall moved off it
    for own in walls.values():
        moved = own.copy()
        moved[len(own) // 2, 1, 2] += 0.3
        assert body.proof([moved], 1e-4) > 0.25


LEVEL = BarrelCam(motion(1.0), AxialGuide(20.0), 5.0, 35.0, 33.0)
# its walls are cut at unlike steps
SWUNG = replace(SWINGING, motion=motion(0.05 * SWINGING.motion.lift), inner=SWINGING.outer - 2.0)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("cam", "bore"), [(LEVEL, None), (LEVEL, 20.0), (SWUNG, None)])
def test_the_declared_error_is_the_truth_where_cylinders_rule(cam: BarrelCam, bore: float | None) -> None:
    """Nearly level grooves: how near to the axis any edge of a triangle on a cylinder, or on the bore, comes."""
    hole = None if bore is None else circle(bore, Label.HOLE, hole=True)
    made = faced_mesh(barrel_faces(BarrelBody(cam, 60.0, web=0.0, bore=hole)), TOLERANCE)
    assert made.bound == "certified"
    points = made.vertices[made.geometry]
    away, middle = np.hypot(points[..., 0], points[..., 1]), (points + np.roll(points, 1, axis=1)) / 2
    worst, level = {}, np.ptp(points[..., 2], axis=1) < 1e-6
    for radius in (bore or cam.outer, cam.inner, cam.outer):
        on = np.all(np.abs(away - radius) < 1e-7, axis=1) & ~level
        assert on.any()
        worst[radius] = radius - np.hypot(middle[on, :, 0], middle[on, :, 1]).min()
    assert max(worst.values()) <= made.max_error <= 1.1 * max(worst.values())


@pytest.mark.sampled(1)
@pytest.mark.parametrize("cam", [AXIAL, SWINGING, CONES[0], replace(CONES[0], is_groove=False)])
def test_a_body_of_faces_reaches_as_far_as_its_cylinders(cam: BarrelCam) -> None:
    body = barrel_faces(BarrelBody(cam, 50.0, web=0.0, hub=None))
    low, high = body.levels()
    top = 50.0 if cam.is_groove else max(cam.wall(np.linspace(0, 2 * math.pi, 2001), LOWER, r)[:, 2].max()
                                         for r in (cam.inner, cam.outer))  # fmt: skip
    assert (low, high) == (pytest.approx(0.0, abs=1e-12), pytest.approx(top, abs=1e-4))
    assert body.section_reach() == pytest.approx(cam.outer, rel=1e-8)
