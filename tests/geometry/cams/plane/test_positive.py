"""Groove, conjugate pair and yoke: the follower is touched from both sides at every angle."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.base.errors import ParameterError
from geometry.cams.contact.positive import between_rollers, conjugate_contact, second_centres, yoke_contact
from geometry.cams.motion.follower_motion import dwell, follower_motion, return_, rise
from geometry.cams.plane.disk import DiskCam, FollowerKind, Translating, oscillating_cam, translating_cam
from geometry.cams.plane.positive import Conjugate, breadth_error, conjugate_cam, yoke_breadth
from geometry.cams.plane.shape import cam_shape
from geometry.laws.named import cosine, polynomial_345, sine
from geometry.plane.distance import Verdict
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
    walls = cam_shape(cam), cam_shape(cam, 16.2)
    assert walls[0].gaps == walls[1].gaps == ()
    inner, outer = (outline_of(wall.profile, 2000) for wall in walls)
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
    outer_wall = cam_shape(cam, 24)
    assert cam_shape(cam).gaps == ()
    assert len(outer_wall.gaps) == 2
    assert outer_wall.lost_lift > 0
    # the roller may rise by so much before it meets the corner: brute force on the dense outline
    gap = outer_wall.gaps[0]
    inside = np.linspace(gap.start, gap.end, 301)
    outer = outline_of(outer_wall.profile, 4000)
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
        lambda: conjugate_cam(translating_cam(even, FLAT, 60), 200.0),
        lambda: conjugate_cam(CAMS["translating"], 70.0),
        lambda: conjugate_cam(CAMS["oscillating 1"], D(30)),
    ]
    for make in bad:
        with pytest.raises(ParameterError):
            make()
    assert isinstance(CAMS["translating"], DiskCam)


def made_pair(name: str) -> tuple[DiskCam, Conjugate]:
    return CAMS[name], conjugate_cam(CAMS[name], 150.0 if name == "translating" else D(315), radius=9.0)


@pytest.mark.parametrize("name", CAMS)
def test_both_rollers_of_a_pair_are_held_and_what_is_turned_is_seen(name: str) -> None:
    """The gaps under both rollers against dense outlines; the second disk turned on the shaft opens or overlaps."""
    cam, pair = made_pair(name)
    assert between_rollers(cam, pair) == pytest.approx(150.0 if name == "translating" else D(315))
    good = conjugate_contact(cam, pair, 1e-6)
    assert good.verdict is Verdict.CONTACT
    assert len(good.drive_angles) >= 360
    assert max(map(abs, good.gaps)) < 1e-6
    outline = outline_of(cam_shape(pair.cam).profile, 4000)
    for turn in {"oscillating 1": (0.03,), "oscillating -1": (-0.03,)}.get(name, (0.03, -0.03)):
        found = conjugate_contact(cam, pair, 1e-6, second_turn=turn)
        assert found.verdict is Verdict.OVERLAP
        assert not found.touches
        one, two = (np.array(side) for side in found.side_gaps)
        assert np.abs(one).max() < 1e-6
        assert np.array(found.gaps) == pytest.approx(np.minimum(one, two))
        assert found.greatest_gap == pytest.approx(max(one.max(), two.max()))
        assert found.worst.gap == pytest.approx(min(found.gaps))
        at = found.gaps.index(min(found.gaps))
        assert found.worst.drive_angle == found.drive_angles[at]
        for k in range(0, len(found.drive_angles), 40):
            angle = found.drive_angles[k]
            centre = complex(second_centres(cam, pair, np.array([angle]))[0])
            placed = outline * np.exp(1j * (angle + pair.turn + turn))
            # within the outline the distance counts below 0: no roller reaches the axis here
            assert two[k] == pytest.approx(np.abs(placed - centre).min() - 9.0, abs=2e-3)


@pytest.mark.parametrize(("name", "share"), [("translating", 1e-3), ("oscillating 1", 1e-3), ("oscillating -1", 1e-3)])
def test_rollers_stay_on_both_sides_of_the_axis(name: str, share: float) -> None:
    """From the limit on: the second roller's lowest place clears the axis by its radius; arms by less than a turn."""
    cam = CAMS[name]
    high = 20.0 if name == "translating" else D(18)
    if isinstance(cam.mount, Translating):
        limits = [(cam.mount.start_height + high + 9.0, 1)]
    else:
        start = cam.mount.start_angle
        limits = [(math.pi - start, 1), (2 * math.pi - start - high, -1)]
    for limit, inwards in limits:
        for works in (True, False):
            distance = limit * (1 + (share if works else -share) * inwards)
            if works:
                conjugate_cam(cam, distance, radius=9.0)
                continue
            with pytest.raises(ParameterError, match="rollers_on_one_side") as refused:
                conjugate_cam(cam, distance, radius=9.0)
            assert refused.value.nearest is not None
            offered = float(refused.value.nearest.value)
            assert offered == pytest.approx(limit, rel=2e-6)
            conjugate_cam(cam, offered, radius=9.0)
    for radius in (0.0, -1.0, math.nan):
        with pytest.raises(ParameterError, match="not_above_zero"):
            conjugate_cam(cam, limits[0][0] * (1 + limits[0][1] * share), radius=radius)


@pytest.mark.parametrize("kind", [FLAT, ROLLER])
def test_a_yoke_has_its_play_on_both_sides(kind: FollowerKind) -> None:
    motion = follower_motion([rise(D(120), 20, sine()), dwell(D(60)), return_(D(120), 20, sine()), dwell(D(60))])
    cam = translating_cam(motion, kind, 60 if kind is FLAT else 40, radius=0.0 if kind is FLAT else 10)
    breadth = yoke_breadth(cam)
    touching = yoke_contact(cam, breadth, 0.0, 1e-5)
    assert touching.verdict is Verdict.CONTACT
    assert max(np.abs(np.ravel(touching.side_gaps))) < 1e-5
    loose = yoke_contact(cam, breadth, 0.4, 1e-5)
    assert loose.verdict is Verdict.CLEAR
    # across a flat face half of the play everywhere; of a roller less where it stands aside
    gaps = np.array(loose.side_gaps)
    assert gaps.max() == pytest.approx(0.2, abs=1e-5)
    assert gaps.min() > (0.2 - 1e-5 if kind is FLAT else 0.15)
    for out, tight in ((0.3, 1), (-0.3, 0)):
        found = yoke_contact(cam, breadth, 0.4, 1e-5, out=out)
        assert found.verdict is Verdict.OVERLAP
        sides = [min(side) for side in found.side_gaps]
        # farther out the upper face leaves the cam, the lower one is drawn against it
        assert sides[tight] < -0.05
        assert sides[1 - tight] > 0.3
        if kind is FLAT:
            assert sorted(sides) == pytest.approx([-0.1, 0.5], abs=1e-5)
    assert yoke_contact(cam, breadth - 0.01, 0.0, 1e-5).verdict is Verdict.OVERLAP


def test_breadth_errors_are_those_of_dense_samples() -> None:
    uneven = follower_motion([rise(D(120), 20, sine()), dwell(D(60)), return_(D(100), 20, sine()), dwell(D(80))])
    at = np.linspace(0, 2 * math.pi, 5001)
    both = uneven.value(at) + uneven.value(np.mod(at + math.pi, 2 * math.pi))
    assert breadth_error(uneven) == pytest.approx(np.abs(both - 20).max(), rel=1e-3)
    with pytest.raises(ParameterError, match="breadth_not_constant"):
        yoke_breadth(translating_cam(uneven, FLAT, 60))
