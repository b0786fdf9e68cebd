"""Followers rolled over a circle about a point off the axis, however its outline is told, against its triangle."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.cams.contact.rolled import Outline, lift_bound, outline_of_loop, outline_of_polynomials, rolled_lift
from geometry.cams.motion.follower_motion import dwell, follower_motion, return_, rise
from geometry.cams.motion.guides import Oscillating
from geometry.cams.plane.disk import DiskCam, FollowerKind, translating_cam
from geometry.cams.plane.shape import whole_profile
from geometry.laws.named import NAMED_LAWS
from geometry.plane.profile import Label
from tests.geometry.cams.plane.test_disk_cam import CAMS, TURN, mount_of

DISK, ARM = 40.0, 9.0
COUNT = 36
AROUND = TURN * np.arange(16) / 16
PLAIN = {name: cam for name, cam in CAMS.items() if "coupler" not in name}


def lift_over_the_disk(name: str, cam: DiskCam, size: float, angle: np.ndarray) -> np.ndarray:
    """S where the roller's centre stands ``size`` and its radius off the disk's middle, or a face touches it."""
    middle = ARM * np.exp(1j * angle)
    if not isinstance(cam.mount, Oscillating):
        if cam.is_flat:
            return middle.imag + size - 45.0
        e, prime, radius = (5.0, 43.0, 8.0) if name == "roller" else (-4.0, 35.0, 0.0)
        return middle.imag + np.sqrt((size + radius) ** 2 - (middle.real - e) ** 2) - math.sqrt(prime**2 - e**2)
    d, arm, start, sense = mount_of(name)
    to = middle - d
    away = np.abs(to)
    # the pivot's angle to the disk's middle against the line to the cam's axis, the way the follower rises
    phase = -sense * np.angle(-to)
    if cam.is_flat:
        return phase + np.arcsin((size + (4.0 if sense > 0 else -3.0)) / away) - start
    return phase + np.arccos((away**2 + arm**2 - (size + 8.0) ** 2) / (2 * away * arm)) - start


def outlines(size: float) -> dict[str, Outline]:
    """Two arcs either way, sixteen cubics either way: their handles are 4/3 tan(theta/4) of the radius."""
    ends = np.array([ARM + size, ARM - size]) + 0j
    corners, ways = ARM + size * np.exp(1j * AROUND), 1j * size * np.exp(1j * AROUND)
    handle = 4 / 3 * math.tan(TURN / 64)
    following = np.roll(corners, -1)
    poles = np.stack([corners, corners + handle * ways, following - handle * np.roll(ways, -1), following], axis=1)
    powers = np.array([[1, -3, 3, -1], [0, 3, -6, 3], [0, 0, 3, -3], [0, 0, 0, 1]])
    return {
        "arcs": outline_of_loop(ends, np.ones(2)),
        "arcs clockwise": outline_of_loop(ends, -np.ones(2)),
        "cubics": outline_of_polynomials(poles @ powers),
        "cubics clockwise": outline_of_polynomials(poles[::-1, ::-1] @ powers),
    }


@pytest.mark.sampled(8)
@pytest.mark.parametrize("name", PLAIN)
@pytest.mark.parametrize("offset", [0.0, 0.4])
def test_a_disk_lifts_as_its_triangle_says_however_it_is_told(name: str, offset: float) -> None:
    """Moved out by an offset for a cutter's width, it lifts as it does itself."""
    angle = TURN * np.arange(COUNT) / COUNT
    wanted = lift_over_the_disk(name, PLAIN[name], DISK, angle)
    lever = 95.0 if "swinging" in name else 1.0
    for kind, outline in outlines(DISK + offset).items():
        found = rolled_lift(PLAIN[name], outline, COUNT, offset)
        assert lever * np.abs(found - wanted).max() < (1e-10 if "arcs" in kind else 1e-5)


@pytest.mark.parametrize("name", PLAIN)
def test_an_outline_that_is_wrong_by_so_much_lifts_no_wronger_than_is_told(name: str) -> None:
    """The cam's own outline moved out, as a parallel of its own: its lift against what is told, over a turn."""
    cam = PLAIN[name]
    angle = TURN * np.arange(720) / 720
    for error in (1e-3, 1e-2):
        bound = lift_bound(cam, 720, error)
        ways = []
        for side in (-error, error):
            points, normal = cam.profile_point(angle), cam.normal(angle) * np.exp(-1j * angle)
            at, lift = cam.stop(points + side * normal, normal, 0.0)
            ways.append(np.abs(lift - cam.motion.value(np.mod(at, TURN))))
        worst = np.maximum(*ways)
        assert np.all(worst <= bound * (1 + 1e-3))
        # of use: no more than an eighth above the worst of three neighbours
        three = np.maximum(np.maximum(np.roll(worst, 1), np.roll(worst, -1)), worst)
        assert np.median(bound / three) < 1.125


def chords_within(points: np.ndarray, error: float) -> np.ndarray:
    """Vertices among dense points of an outline, each chord as long as all points between stay within ``error``."""
    kept, first = [], 0
    while first < len(points) - 1:
        step = len(points) - 1 - first
        while True:
            chord = points[first + step] - points[first]
            aside = (np.conj(chord) * (points[first : first + step] - points[first])).imag / abs(chord)
            if step == 1 or np.abs(aside).max() <= error:
                break
            step -= max(1, step // 50)
        kept.append(points[first])
        first += step
    return np.array(kept)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("law", ["cosine", "polynomial_345"])
@pytest.mark.parametrize("base", [1e-4, 3e-3, 0.02])
def test_chords_that_cut_flanks_off_down_to_the_axis_are_no_fault_and_a_wrong_vertex_is(law: str, base: float) -> None:
    """A point on a cam that comes to a point: a dwell on next to nothing, flanks that leave it along its own radius."""
    shape, third, error = NAMED_LAWS[law](), TURN / 3, 0.01
    motion = follower_motion([rise(third, 20.0, shape), return_(third, 20.0, shape), dwell(third)])
    cam = translating_cam(motion, FollowerKind.POINTED, base)
    vertices = chords_within(cam.profile_point(np.linspace(TURN, 0.0, 20001)), error)
    bound = lift_bound(cam, 3600, error)
    assert np.isfinite(bound[200:2200]).all()

    def excess(at: np.ndarray) -> np.ndarray:
        lift = rolled_lift(cam, outline_of_loop(at, np.zeros(len(at))), 3600)
        off = np.abs(lift - cam.motion.value(np.arange(3600) * (TURN / 3600))) - bound
        return np.asarray(off[np.isfinite(bound)])

    assert excess(vertices).max() <= 0
    worst = int(np.abs(np.abs(vertices) - 10.0).argmin())
    spoiled = vertices.copy()
    spoiled[worst] *= 1 + 3 * error / 10.0
    assert excess(spoiled).max() > 0


@pytest.mark.parametrize("base", [1e-4, 1e-3, 3e-3])
def test_a_point_rolls_over_no_corner_of_its_own_however_small_the_base_circle_is(base: float) -> None:
    shape, third = NAMED_LAWS["sine"](), TURN / 3
    motion = follower_motion([rise(third, 20.0, shape), return_(third, 20.0, shape), dwell(third)])
    profile = whole_profile(translating_cam(motion, FollowerKind.POINTED, base))
    assert {segment.label for segment in profile.period} == {Label.CAM, Label.DWELL}
