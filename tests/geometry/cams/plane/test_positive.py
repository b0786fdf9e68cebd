"""Groove, conjugate pair and yoke: the follower is touched from both sides at every angle."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.base.errors import ParameterError
from geometry.cams.motion.follower_motion import dwell, follower_motion, return_, rise
from geometry.cams.plane.disk import DiskCam, FollowerKind, oscillating_cam, translating_cam
from geometry.cams.plane.positive import breadth_error, conjugate_cam, groove, yoke_breadth
from geometry.cams.plane.shape import cam_shape
from geometry.laws.named import cosine, polynomial_345, sine
from tests.geometry.cams.plane.test_undercut import outline_of

D = math.radians
LIFT = follower_motion([rise(D(120), 20, sine()), dwell(D(40)), return_(D(130), 20, polynomial_345()), dwell(D(70))])
SWING = follower_motion([rise(D(120), D(18), sine()), dwell(D(40)), return_(D(130), D(18), sine()), dwell(D(70))])
ROLLER, FLAT = FollowerKind.ROLLER, FollowerKind.FLAT
CAMS = {
    "translating": translating_cam(LIFT, ROLLER, 35, radius=8, follower_offset=5),
    **{f"oscillating {s}": oscillating_cam(SWING, ROLLER, 35, centre_distance=95, arm_length=80, radius=8, sense=s)
       for s in (1, -1)},
}  # fmt: skip


@pytest.mark.parametrize("name", CAMS)
def test_a_groove_holds_the_roller_between_its_walls(name: str) -> None:
    cam = CAMS[name]
    made = groove(cam, clearance=0.2)
    assert made.width == pytest.approx(16.2)
    assert made.inner.gaps == made.outer.gaps == ()
    inner, outer = outline_of(made.inner.profile, 2000), outline_of(made.outer.profile, 2000)
    for angle in np.linspace(0, 2 * math.pi, 37):
        centre = complex(cam.reference_point(angle)) * np.exp(-1j * angle)
        assert np.abs(inner - centre).min() == pytest.approx(8.0, abs=1e-4)
        assert np.abs(outer - centre).min() == pytest.approx(8.2, abs=1e-4)


def test_the_outer_wall_is_undercut_where_the_path_is_concave_and_sharp() -> None:
    steep = follower_motion([rise(D(45), 30, sine()), dwell(D(60)), return_(D(45), 30, sine()), dwell(D(210))])
    cam = translating_cam(steep, ROLLER, 30, radius=12)
    angle = np.linspace(0, 2 * math.pi, 3601)
    radii = cam.pitch_curvature_radius(angle)
    assert radii[radii < 0].max() > -12
    made = groove(cam)
    assert made.inner.gaps == ()
    assert len(made.outer.gaps) == 2
    assert made.outer.lost_lift > 0
    # the roller may rise by so much before it meets the corner: brute force on the dense outline
    gap = made.outer.gaps[0]
    inside = np.linspace(gap.start, gap.end, 301)
    outer = outline_of(made.outer.profile, 4000)
    free = []
    for a in inside:
        points = outer * np.exp(1j * a)
        near = (np.abs(points.real) < 12) & (points.imag > 20)
        top = float((points.imag[near] - np.sqrt(144 - points.real[near] ** 2)).min())
        free.append(top - float(cam.reference_point(a).imag))
    assert max(free) == pytest.approx(gap.lost_lift, abs=1e-3)


@pytest.mark.parametrize("name", CAMS)
def test_a_conjugate_pair_touches_both_rollers(name: str) -> None:
    cam = CAMS[name]
    translating = name == "translating"
    distance = 150.0 if translating else D(315)
    second = conjugate_cam(cam, distance, radius=9.0)
    outline = outline_of(cam_shape(second.cam).profile, 2000) * np.exp(1j * second.turn)
    for angle in np.linspace(0, 2 * math.pi, 37):
        first = complex(cam.reference_point(angle))
        # the second arm stands at a fixed angle from the first, about the same pivot
        swung = 95 + (first - 95) * np.exp(-1j * getattr(cam.mount, "sense", 1) * distance)
        centre = first - 1j * distance if translating else swung
        assert np.abs(outline * np.exp(1j * angle) - centre).min() == pytest.approx(9.0, abs=1e-4)


def test_a_flat_yoke_of_constant_breadth() -> None:
    motion = follower_motion([rise(D(120), 20, sine()), dwell(D(60)), return_(D(120), 20, sine()), dwell(D(60))])
    assert breadth_error(motion) <= 1e-13 * 20
    cam = translating_cam(motion, FLAT, 60)
    breadth = yoke_breadth(cam)
    assert breadth == pytest.approx(140)
    outline = outline_of(cam_shape(cam).profile)
    for angle in np.linspace(0, math.pi, 25):
        across = (outline * np.exp(1j * angle)).imag
        assert np.ptp(across) == pytest.approx(breadth, abs=1e-4)
    rollers = translating_cam(motion, ROLLER, 40, radius=10)
    assert yoke_breadth(rollers) == pytest.approx(120)


def test_refusals() -> None:
    uneven = follower_motion([rise(D(120), 20, sine()), dwell(D(60)), return_(D(100), 20, sine()), dwell(D(80))])
    even = follower_motion([rise(math.pi, 20, cosine()), return_(math.pi, 20, cosine())])
    bad = [
        lambda: yoke_breadth(translating_cam(uneven, FLAT, 60)),
        lambda: yoke_breadth(translating_cam(even, ROLLER, 60, radius=10, follower_offset=3)),
        lambda: yoke_breadth(translating_cam(even, FollowerKind.POINTED, 60)),
        lambda: yoke_breadth(CAMS["oscillating 1"]),
        lambda: groove(translating_cam(even, FLAT, 60)),
        lambda: groove(CAMS["translating"], clearance=-0.1),
        lambda: conjugate_cam(translating_cam(even, FLAT, 60), 200.0),
        lambda: conjugate_cam(CAMS["translating"], 70.0),
        lambda: conjugate_cam(CAMS["oscillating 1"], D(30)),
    ]
    for make in bad:
        with pytest.raises(ParameterError):
            make()
    assert isinstance(CAMS["translating"], DiskCam)
