"""Undercut against brute force: a sweep of the follower decides, a follower rolled over the outline measures."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.base.errors import ParameterError, UndercutError
from geometry.cams.motion.follower_motion import dwell, follower_motion, return_, rise
from geometry.cams.motion.guides import Oscillating, Translating
from geometry.cams.plane.disk import DiskCam, FollowerKind, oscillating_cam, translating_cam
from geometry.cams.plane.shape import cam_shape, whole_profile
from geometry.cams.plane.synthesis import flat_base_radius
from geometry.cams.plane.undercut import kept_arcs
from geometry.laws.named import NAMED_LAWS, constant_velocity, polynomial_345, sine
from geometry.plane.measure import distance_to_profile, profile_area
from geometry.plane.profile import Label, Profile
from tests.geometry.cams.oracle import followed

D = math.radians
SMOOTH = [n for n in NAMED_LAWS if n != "constant_velocity"]
POINTED, ROLLER, MUSHROOM, FLAT = FollowerKind


def random_cam(rng: np.random.Generator, grain: float = 1.0) -> DiskCam:
    """A cam of any follower, guide and law, about as often undercut as not."""
    up, far, down = D(rng.uniform(50, 140)), D(rng.uniform(5, 40)), D(rng.uniform(50, 140))
    laws = [NAMED_LAWS[str(rng.choice(SMOOTH))]() for _ in range(2)]
    kind = FollowerKind(str(rng.choice([ROLLER, FLAT, MUSHROOM])))
    swings = bool(rng.random() < 0.4)
    lift = D(rng.uniform(5, 22)) if swings else rng.uniform(5, 30)
    motion = follower_motion([rise(up, lift, laws[0]), dwell(far), return_(down, lift, laws[1]),
                              dwell(2 * math.pi - up - far - down)])  # fmt: skip
    base = rng.uniform(12, 60)
    radius = 0.0 if kind is FLAT else rng.uniform(4, 35) * grain
    if not swings:
        return translating_cam(motion, kind, base, radius=radius, follower_offset=rng.uniform(-8, 8))
    distance = rng.uniform(110, 140)
    sense = int(rng.choice([1, -1]))
    if kind is FLAT:
        return oscillating_cam(
            motion, kind, base, centre_distance=distance, sense=sense, face_offset=rng.uniform(-8, 8)
        )
    return oscillating_cam(motion, kind, base, centre_distance=distance, arm_length=distance * rng.uniform(0.75, 0.95),
                           radius=radius, sense=sense)  # fmt: skip


def swept(cam: DiskCam, samples: int = 3001) -> float:
    """The most by which some position of the follower reaches into the point of another, mm; 0: a whole cam.

    By brute force: support lines of the face, or circles about the roller's centres, at all angles against all.
    """
    angle = np.linspace(0, 2 * math.pi, samples)
    points = cam.profile_point(angle)
    turn = np.exp(-1j * angle)
    worst = 0.0
    for start in range(0, samples, 500):
        block = points[start : start + 500, None]
        if cam.is_flat:
            normal = cam.normal(angle) * turn
            height = (np.conj(cam.normal(angle)) * cam.contact(angle)).real
            reach = (np.conj(normal) * block).real - height
        else:
            reach = cam.radius - np.abs(cam.reference_point(angle) * turn - block)
        worst = max(worst, float(reach.max()))
    return worst


def outline_of(profile: Profile, samples: int = 2400) -> np.ndarray:
    """Dense vertices of a profile."""
    return np.concatenate([s.curve.point(np.linspace(*s.curve.domain, samples)) for s in profile.period])


def classify(count: int, seed: int) -> tuple[int, int]:
    """Legal and illegal cams of a random sample; asserts that the sweep says the same beyond its resolution."""
    rng = np.random.default_rng(seed)
    legal = illegal = 0
    while legal + illegal < count:
        try:
            cam = random_cam(rng)
        except ParameterError:
            continue
        depth = swept(cam)
        try:
            whole = not kept_arcs(cam).gaps
        except UndercutError:
            whole = False
        if depth > 1e-4:
            illegal += 1
            assert not whole, cam
        elif depth < 1e-9:
            legal += 1
            # cusps between two samples of the sweep take less than its resolution
            assert whole or cam_shape(cam).lost_lift < 1e-4, cam
    return legal, illegal


@pytest.mark.heavy
def test_random_cams_are_classified_as_a_sweep_does() -> None:
    legal, illegal = classify(8, 11)
    assert legal >= 3
    assert illegal >= 3


@pytest.mark.heavy
def test_a_thousand_random_cams() -> None:
    legal, illegal = classify(1000, 2024)
    assert legal >= 250
    assert illegal >= 250


def undercut_examples() -> dict[str, DiskCam]:
    lift = follower_motion([rise(D(100), 25, sine()), dwell(D(30)), return_(D(100), 25, sine()), dwell(D(130))])
    swing = follower_motion([rise(D(100), D(20), sine()), dwell(D(30)), return_(D(100), D(20), sine()), dwell(D(130))])
    steep = follower_motion([rise(D(60), 25, sine()), dwell(D(10)), return_(D(70), 25, sine()), dwell(D(220))])
    jerky = follower_motion([rise(D(50), D(24), sine()), dwell(D(10)), return_(D(70), D(24), sine()), dwell(D(230))])
    found = {
        "flat": translating_cam(lift, FLAT, 10.0),
        "roller": translating_cam(steep, ROLLER, 10.0, radius=24.0),
        "offset roller": translating_cam(steep, ROLLER, 10.0, radius=24.0, follower_offset=8.0),
        "mushroom": translating_cam(steep, MUSHROOM, 22.0, radius=60.0),
    }
    for s in (1, -1):
        found[f"oscillating flat {s}"] = oscillating_cam(
            swing, FLAT, 12.0, centre_distance=100, sense=s, face_offset=2.0
        )
        found[f"oscillating roller {s}"] = oscillating_cam(
            jerky, ROLLER, 10.0, centre_distance=100, arm_length=85, radius=24.0, sense=s
        )
    return found


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", undercut_examples())
def test_lost_lift_is_what_a_follower_loses_on_the_trimmed_outline(name: str) -> None:
    cam = undercut_examples()[name]
    shape = cam_shape(cam)
    outline = outline_of(shape.profile)
    mount = cam.mount
    start = mount.start_height if isinstance(mount, Translating) else mount.start_angle
    size = 1.0 if isinstance(mount, Translating) else mount.centre_distance
    angles = np.linspace(0, 2 * math.pi, 181)
    lost = np.array([start + float(cam.motion.value(a)) - followed(cam, outline, float(a)) for a in angles])
    assert np.all(lost >= -1e-4 / size)
    if not shape.gaps:
        assert lost.max() <= 1e-4 / size
        return
    for gap in shape.gaps:
        inside = np.linspace(gap.start, gap.end, 101)
        there = [start + float(cam.motion.value(a)) - followed(cam, outline, float(a)) for a in inside]
        assert max(there) == pytest.approx(gap.lost_lift, abs=3e-4 / size)
        # the corner is a point of the outline
        assert np.abs(outline - gap.corner).min() <= 1e-9
    covered = np.zeros(len(angles), dtype=bool)
    for gap in shape.gaps:
        for shift in (0, 2 * math.pi):
            covered |= (angles + shift >= gap.start) & (angles + shift <= gap.end)
    assert lost[~covered].max() <= 1e-4 / size


def test_some_examples_are_undercut() -> None:
    lost = {name: cam_shape(cam).lost_lift for name, cam in undercut_examples().items()}
    assert sum(value > 0 for value in lost.values()) >= 5, lost
    with pytest.raises(UndercutError) as refusal:
        whole_profile(undercut_examples()["flat"])
    assert "lost" in str(refusal.value)


def test_distant_arcs_cut_each_other() -> None:
    """Layer two: no cusp anywhere, but a roller so large that it digs into the far side of a re-entrant cam."""
    motion = follower_motion([rise(D(40), 60, polynomial_345()), return_(D(40), 60, polynomial_345()), dwell(D(280))])
    small = translating_cam(motion, ROLLER, 60, radius=2)
    assert not kept_arcs(small).gaps
    # between two lobes: the concave valley is as wide as the roller is not
    lobes = [
        rise(D(25), 30, sine()),
        return_(D(25), 30, sine()),
        rise(D(25), 30, sine()),
        return_(D(25), 30, sine()),
        dwell(D(260)),
    ]
    cam = translating_cam(follower_motion(lobes), ROLLER, 60, radius=8)
    assert bool(kept_arcs(cam).gaps) == (swept(cam) > 1e-6)


@pytest.mark.parametrize("kind", [POINTED, FLAT])
def test_a_jump_of_velocity(kind: FollowerKind) -> None:
    """Uniform motion: a point's cam has corners there; a flat face leaves a straight edge, or loses lift."""
    motion = follower_motion([rise(D(150), 10, constant_velocity()), return_(D(210), 10, constant_velocity())])
    assert [j.impact for j in motion.joints()] == ["rigid", "rigid"]
    cam = translating_cam(motion, kind, 30.0)
    shape = cam_shape(cam)
    outline = outline_of(shape.profile)
    if kind is FLAT:
        edges = [s for s in shape.profile.period if s.label is Label.CORNER]
        assert len(edges) == 1
        step = 10 / D(150) + 10 / D(210)
        assert abs(edges[0].curve.point(1.0) - edges[0].curve.point(0.0)) == pytest.approx(step, rel=1e-12)
        assert len(shape.gaps) == 1
        angle = D(150)
        assert shape.lost_lift > 0.1
        assert 40.0 - followed(cam, outline, angle) == pytest.approx(shape.lost_lift, abs=1e-3)
    else:
        assert shape.gaps == ()
        assert profile_area(shape.profile) > 0


@pytest.mark.sampled(3)
@pytest.mark.parametrize("grow", [-2.0, -0.05, -1e-3, 1e-3, 0.05, 2.0])
def test_small_loops_at_corners_are_seen(grow: float) -> None:
    """A parallel of a cornered outline: the loops are as small as the offset, and every point keeps its distance."""
    motion = follower_motion(
        [rise(D(80), 8, sine()), dwell(D(20)), return_(D(45), 8, constant_velocity()), dwell(D(215))]
    )
    cam = translating_cam(motion, POINTED, 60.0)
    plain, moved = cam_shape(cam), cam_shape(cam, grow)
    assert len(moved.gaps) == 1
    points = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 65)) for s in moved.profile.period])
    assert np.allclose(distance_to_profile(points, plain.profile), abs(grow), rtol=1e-6, atol=1e-10)


def test_a_roller_rolls_over_its_own_corner() -> None:
    """A jump of velocity upwards: the roller's centre stands while the cam turns nothing, an arc closes the gap."""
    motion = follower_motion([rise(D(150), 10, constant_velocity()), return_(D(210), 10, constant_velocity())])
    shape = cam_shape(translating_cam(motion, ROLLER, 30.0, radius=6.0))
    arcs = [s.curve for s in shape.profile.period if s.label is Label.CORNER]
    assert len(arcs) == 1
    assert arcs[0].radius == pytest.approx(6.0)
    assert len(shape.gaps) == 1
    assert shape.lost_lift > 0


def test_wrong_sizes_are_refused_with_a_remedy() -> None:
    motion = follower_motion([rise(D(120), 20, sine()), return_(D(120), 20, sine()), dwell(D(120))])
    swing = follower_motion([rise(D(40), D(50), sine()), return_(D(120), D(50), sine()), dwell(D(200))])
    for make in (
        lambda: translating_cam(motion, ROLLER, 30.0),
        lambda: translating_cam(motion, FLAT, 30.0, radius=3.0),
        lambda: translating_cam(motion, FLAT, 0.0),
        lambda: translating_cam(motion, ROLLER, 10.0, radius=5.0, follower_offset=15.0),
        lambda: oscillating_cam(swing, ROLLER, 10.0, centre_distance=100, arm_length=50, radius=5.0),
        lambda: oscillating_cam(swing, FLAT, 30.0, centre_distance=100, sense=-1),
        lambda: oscillating_cam(swing, FLAT, 130.0, centre_distance=100),
        lambda: oscillating_cam(swing, ROLLER, 30.0, centre_distance=100, arm_length=90, radius=5.0, sense=2),
        lambda: oscillating_cam(motion, ROLLER, 30.0, centre_distance=100, arm_length=90, radius=5.0),
    ):
        with pytest.raises(ParameterError):
            make()


def test_oscillating_mount_is_the_one_named() -> None:
    cam = undercut_examples()["oscillating roller 1"]
    assert isinstance(cam.mount, Oscillating)
    assert cam.mount.sense == 1


@pytest.mark.parametrize("laws", [("cosine", "cosine"), ("triangle", "sine"), ("polynomial_345", "cosine")])
def test_a_section_below_a_cusp_is_what_half_planes_leave_at_every_depth(laws: tuple[str, str]) -> None:
    """A convex cam is its support lines', moved inwards: h(theta) - d, whatever its loops; it keeps its segments."""
    motion = follower_motion([rise(D(84), 30.0, NAMED_LAWS[laws[0]]()), return_(D(134), 30.0, NAMED_LAWS[laws[1]]()),
                              dwell(D(142))])  # fmt: skip
    base = flat_base_radius(motion, 0.0).value * (1 + 1e-9)
    cam = translating_cam(motion, FLAT, base)
    angle = np.linspace(0, 2 * math.pi, 7201)
    normal = 1j * np.exp(-1j * angle)
    support = base + motion.value(angle)
    labels = [s.label for s in cam_shape(cam).profile.period]
    for depth in (1e-6, 1e-4, 1e-2, 0.3):
        shape = cam_shape(cam, -depth)
        assert [s.label for s in shape.profile.period] == labels
        shares = np.linspace(0, 1, 25)
        for segment in shape.profile.period:
            low, high = segment.curve.domain
            points = segment.curve.point((1 - shares) * low + shares * high)
            outside = ((points[:, None] * normal.conj()).real - support).max(axis=1)
            # between two lines less is seen
            assert -depth - 3e-5 <= outside.min()
            assert outside.max() <= -depth + 1e-9
