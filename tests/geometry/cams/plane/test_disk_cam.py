"""Disk cams of every follower and guide: where outlines stop them, what they lose on corners, what is refused.

What is expected is written anew from the triangles of axis, pivot and follower.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.cams.contact.follower import body_points, follower_contact, judged, press_in, reach_from_pivot
from geometry.cams.contact.outlines import FollowerEnd, plate_stem
from geometry.cams.motion.follower_motion import (
    Phase,
    dwell,
    follower_motion,
    motion_of_table,
    return_,
    rise,
)
from geometry.cams.motion.joins import JOIN, with_joins
from geometry.cams.plane.coupler import LinkageCam, linkage_cam
from geometry.cams.plane.disk import DiskCam, FollowerKind, oscillating_cam, translating_cam
from geometry.cams.plane.fence import Fence
from geometry.cams.plane.lost_lift import greatest_loss, lost_lift
from geometry.cams.plane.shape import cam_shape
from geometry.laws.named import constant_velocity, polynomial_345, sine
from geometry.plane.distance import Verdict
from geometry.plane.profile import Label, Profile, Segment, circle
from geometry.solids.plate import PlateOutline, rounded
from tests.brute import works
from tests.geometry.cams.linkage_oracle import CASES

D = math.radians
POINTED, ROLLER, MUSHROOM, FLAT = FollowerKind
LIFT = follower_motion([rise(D(120), 20, sine()), dwell(D(40)), return_(D(130), 20, polynomial_345()), dwell(D(70))])
SWING = follower_motion([rise(D(120), D(18), sine()), dwell(D(40)), return_(D(130), D(18), sine()), dwell(D(70))])
TURN = 2 * math.pi


def swung(kind: FollowerKind, sense: int, offset: float = 0.0) -> DiskCam:
    arm = {} if kind is FLAT else {"arm_length": 80.0, "radius": 8.0}
    return oscillating_cam(SWING, kind, 35.0, centre_distance=95.0, sense=sense, face_offset=offset, **arm)


CAMS: dict[str, DiskCam] = {
    "roller": translating_cam(LIFT, ROLLER, 35.0, radius=8.0, follower_offset=5.0),
    "pointed": translating_cam(LIFT, POINTED, 35.0, follower_offset=-4.0),
    "flat": translating_cam(LIFT, FLAT, 45.0, follower_offset=3.0),
    "swinging roller above": swung(ROLLER, 1),
    "swinging roller below": swung(ROLLER, -1),
    "swinging flat above": swung(FLAT, 1, 4.0),
    "swinging flat below": swung(FLAT, -1, -3.0),
    **{
        f"on a coupler, {kind.value}": linkage_cam(
            follower_motion([rise(D(120), D(12), sine()), dwell(D(50)), return_(D(130), D(12), polynomial_345()),
                             dwell(D(60))]),
            kind, CASES["four-bar"].linkage, CASES["four-bar"].point, direction=CASES["four-bar"].direction,
            radius=7.0 if kind is ROLLER else 0.0,
        )
        for kind in (ROLLER, FLAT)
    },
}  # fmt: skip
ANGLES = np.array([0.2, 0.9, 1.7, 3.4, 4.1, 5.2])


@pytest.mark.parametrize("name", CAMS)
@pytest.mark.parametrize("offset", [0.0, 0.3, -0.2])
def test_an_outline_stops_the_follower_where_the_cam_does(name: str, offset: float) -> None:
    """A point of the cam, moved off it along its normal by what is told, stops it at its own angle and lift."""
    cam = CAMS[name]
    normal = cam.normal(ANGLES) * np.exp(-1j * ANGLES)
    angle, lift = cam.stop(cam.profile_point(ANGLES) + offset * normal, normal, offset)
    assert np.mod(angle, TURN) == pytest.approx(ANGLES, abs=1e-9)
    assert lift == pytest.approx(cam.motion.value(ANGLES), abs=1e-9)


def mount_of(name: str) -> tuple[float, float, float, int]:
    """d, L, psi_0 and the sense, from the base circle by the law of cosines; of a face by its distance."""
    cam = CAMS[name]
    sense = 1 if name.endswith("above") else -1
    if cam.is_flat:
        start = math.asin((35.0 + (4.0 if sense > 0 else -3.0)) / 95.0)
    else:
        start = math.acos((95.0**2 + 80.0**2 - 43.0**2) / (2 * 95 * 80))
    return 95.0, 80.0, start, sense


def centre_at(name: str, lift: float) -> complex:
    """Where the roller's centre or the point stands at a lift."""
    cam = CAMS[name]
    if isinstance(cam, LinkageCam):
        return complex(cam.mount.centre([np.asarray(lift)])[0])
    if name in ("roller", "pointed"):
        e, prime = (5.0, 43.0) if name == "roller" else (-4.0, 35.0)
        return complex(e, math.sqrt(prime**2 - e**2) + lift)
    d, arm, start, sense = mount_of(name)
    return d - arm * np.exp(-1j * sense * (start + lift))


def face_at(name: str, lift: float) -> tuple[complex, complex]:
    """A point of the face and its normal away from the axis."""
    cam = CAMS[name]
    if isinstance(cam, LinkageCam):
        height, angle = cam.mount.face([np.asarray(lift)])
        normal = complex(np.exp(1j * angle[0]))
        return float(height[0]) * normal, normal
    if name == "flat":
        return 1j * (45.0 + lift), 1j
    d, _, start, sense = mount_of(name)
    psi = start + lift
    along = -np.exp(-1j * sense * psi)
    normal = 1j * sense * np.exp(-1j * sense * psi)
    return d + 10 * along - (4.0 if sense > 0 else -3.0) * normal, normal


@pytest.mark.parametrize("name", [n for n in CAMS if n != "pointed"])
@pytest.mark.parametrize("beyond", [False, True])
def test_what_is_lost_on_a_corner_is_what_the_follower_drops(name: str, beyond: bool) -> None:
    """The corner is put where a follower that stands so much lower, or higher under an outer wall, touches it."""
    cam = CAMS[name]
    if beyond and (cam.is_flat or isinstance(cam, LinkageCam)):
        return
    drop = 0.01 if cam.swings else 0.6
    for angle in ANGLES.tolist():
        lift = float(cam.motion.value(angle)) + (drop if beyond else -drop)
        if cam.is_flat:
            place, normal = face_at(name, lift)
            corner, distance = place + 3.0j * normal, 0.0
        else:
            # off the way of the follower's centre, so that the angle counts
            way = cam.way(np.array([angle]), np.array([centre_at(name, lift)]))[0]
            out = way / abs(way) * np.exp(0.4j)
            corner, distance = centre_at(name, lift) + (8.0 if beyond else -cam.radius) * out, cam.radius
            distance = 8.0 if beyond else -distance
        lost = lost_lift(cam, np.array([angle]), corner * np.exp(-1j * angle), distance)
        assert lost == pytest.approx([drop], abs=1e-9)
        # an outline that stands off the face by so much is touched sooner
        if cam.is_flat and not isinstance(cam, LinkageCam):
            moved = lost_lift(cam, np.array([angle]), (corner + 0.2 * normal) * np.exp(-1j * angle), 0.2)
            assert moved == pytest.approx([drop], abs=1e-9)


def test_the_most_that_is_lost_is_found_between_samples() -> None:
    """A flat follower above a corner at the radius r is held up by r sin(angle)."""
    cam = CAMS["flat"]
    corner = 30.0 * np.exp(1j * 1.2)
    fine = np.linspace(0.1, 0.6, 200_001)
    lost = 45.0 + cam.motion.value(fine) - (corner * np.exp(1j * fine)).imag
    assert greatest_loss(cam, 0.1, 0.6, corner, 0.0) == pytest.approx(float(lost.max()), abs=1e-9)


@pytest.mark.parametrize("name", [n for n in CAMS if "coupler" not in n])
def test_a_follower_slips_where_its_guide_ends(name: str) -> None:
    """An arm reaches from |d - L| to d + L, a stem no nearer than its offset, a face no farther than its pivot."""
    cam = CAMS[name]
    lift = cam.motion.value(ANGLES)
    if name == "flat":
        assert np.isinf(cam.reach_margin(ANGLES)).all()
        return
    if cam.swings:
        d, arm, start, _ = mount_of(name)
        if cam.is_flat:
            wanted = d * (1 - np.sin(start + lift))
        else:
            reach = np.sqrt(d * d + arm * arm - 2 * d * arm * np.cos(start + lift))
            wanted = np.minimum(reach - abs(d - arm), d + arm - reach)
    else:
        reach = np.abs([centre_at(name, x) for x in lift.tolist()])
        wanted = reach - (5.0 if name == "roller" else 4.0)
    assert cam.reach_margin(ANGLES) == pytest.approx(wanted, rel=1e-12)


@pytest.mark.parametrize("name", [n for n in CAMS if n != "pointed"])
def test_a_face_reaches_as_far_as_it_is_touched(name: str) -> None:
    """Places of contact on a fine net, along the face from the foot of the axis or pivot; of a roller round it."""
    cam = CAMS[name]
    low, high = cam.face_reach()
    angles = np.linspace(0, TURN, 20_001)[:-1]
    contact = cam.contact(angles)
    if isinstance(cam, LinkageCam):
        across = np.exp(1j * (cam.coupler_angle(angles) + cam.mount.direction - np.pi / 2))
        places = ((contact - cam.place(angles)) * np.conj(across)).real
    elif name == "flat":
        places = contact.real
    elif cam.is_flat:
        _, _, start, sense = mount_of(name)
        along = -np.exp(-1j * sense * (start + cam.motion.value(angles)))
        from_pivot = ((contact - 95.0) * np.conj(along)).real
        # counted from the foot of the axis, towards the pivot
        places = 95.0 * np.cos(start + cam.motion.value(angles)) - from_pivot
        assert reach_from_pivot(cam) == pytest.approx(from_pivot.max(), abs=1e-4)
    else:
        places = cam.radius * np.sin(cam.pressure_angle(angles))
    if cam.is_flat and cam.swings and not isinstance(cam, LinkageCam):
        places = places if abs(places.max() - high) < abs(-places.min() - high) else -places
    assert low == pytest.approx(places.min(), abs=1e-3)
    assert high == pytest.approx(places.max(), abs=1e-3)
    if name == "flat":
        rate = LIFT.extremes(1)
        assert (low, high) == pytest.approx(rate, rel=1e-9)
        assert cam.least_plate_diameter() == pytest.approx(2 * max(abs(rate[1] - 3.0), abs(rate[0] - 3.0)))


def test_followers_stand_on_their_stems_and_arms() -> None:
    for name in ("roller", "flat"):
        cam = CAMS[name]
        at, turn = cam.follower_pose(1.3)
        lift = float(LIFT.value(1.3))
        assert turn == 0.0
        assert at == pytest.approx(centre_at(name, lift) if name == "roller" else complex(3.0, 45.0 + lift))
    for name in ("swinging roller above", "swinging roller below"):
        at, turn = CAMS[name].follower_pose(1.3, on_arm=True)
        assert at == 95.0
        arm = 80 * np.exp(1j * turn)
        assert at + arm == pytest.approx(centre_at(name, float(SWING.value(1.3))), abs=1e-12)
    coupler = CAMS["on a coupler, roller"]
    assert isinstance(coupler, LinkageCam)
    place, turn = coupler.follower_pose(1.3)
    assert place == pytest.approx(complex(coupler.place(1.3)))
    assert turn == pytest.approx(float(coupler.coupler_angle(1.3)) + coupler.mount.direction - math.pi / 2)
    assert coupler.follower_pose(1.3, turns=False)[1] == 0.0


# --- what is refused


LOW = motion_of_table([0.0, D(90), D(180), D(270)], [0.0, 6.0, 0.0, -14.0])
Made = Callable[[float], object]
REFUSED: dict[str, tuple[str, str, Made, float, int]] = {
    # key, code, what is made of a value, its limit, and the side on which it works
    "offset": ("follower_offset", "offset_beyond_prime_circle",
               lambda v: translating_cam(LIFT, ROLLER, 20.0, radius=5.0, follower_offset=v), 25.0, -1),
    "offset to the left": ("follower_offset", "offset_beyond_prime_circle",
                           lambda v: translating_cam(LIFT, ROLLER, 20.0, radius=5.0, follower_offset=v), -25.0, 1),
    "passes the axis": ("base_circle_radius", "follower_passes_axis",
                        lambda v: translating_cam(LOW, ROLLER, v, radius=3.0, follower_offset=6.0),
                        math.hypot(6.0, -LOW.extremes()[0]) - 3.0, 1),
    "face beyond its pivot": ("base_circle_radius", "face_beyond_pivot",
                              lambda v: oscillating_cam(SWING, FLAT, v, centre_distance=95.0, face_offset=4.0),
                              91.0, -1),
    "arm too short": ("base_circle_radius", "arm_does_not_reach",
                      lambda v: oscillating_cam(SWING, ROLLER, v, centre_distance=95.0, arm_length=60.0, radius=8.0),
                      27.0, 1),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_sizes_are_refused_from_a_limit_on_with_what_works(name: str) -> None:
    key, code, make, limit, side = REFUSED[name]
    with pytest.raises(ParameterError) as refused:
        make(limit - side * 1e-4)
    assert (refused.value.name, refused.value.code) == (key, code)
    offered = works(refused.value)
    assert offered == pytest.approx(limit, abs=3e-3 if name != "arm too short" else 0.1)
    assert (offered - limit) * side >= 0
    make(limit + side * 2e-3) if name != "face beyond its pivot" else None
    if name not in ("face beyond its pivot", "arm too short"):
        make(offered)


def swings(
    lift: float, base: float = 35.0, sense: int = 1, kind: FollowerKind = ROLLER, angle: float = 120.0
) -> DiskCam:
    motion = follower_motion(
        [rise(D(angle), lift, sine()), return_(D(angle), lift, sine()), dwell(TURN - D(2 * angle))]
    )
    arm = {} if kind is FLAT else {"arm_length": 80.0, "radius": 8.0}
    return oscillating_cam(motion, kind, base, centre_distance=95.0, sense=sense, **arm)


@pytest.mark.parametrize(
    ("code", "kind", "sense", "base", "limit"),
    [
        # start + lift reaches pi; a face square to the line of centres; 1 - psi' = 0 where psi' is 2 lift / angle
        ("swings_beyond_centres", ROLLER, 1, 35.0, math.pi - math.acos((95**2 + 80**2 - 43**2) / (2 * 95 * 80))),
        ("face_past_square", FLAT, 1, 35.0, math.pi / 2 - math.asin(35 / 95)),
        ("flat_outruns_cam", FLAT, -1, 35.0, D(120) / 2),
    ],
)
def test_a_swing_is_refused_from_a_limit_on(
    code: str, kind: FollowerKind, sense: int, base: float, limit: float
) -> None:
    # so slow that the face does not outrun the cam before
    angle = 175 if code == "face_past_square" else 120
    swings(limit * (1 - 1e-3), base, sense, kind, angle)
    with pytest.raises(ParameterError) as refused:
        swings(limit * (1 + 1e-3), base, sense, kind, angle)
    assert (refused.value.name, refused.value.code) == ("lift", code)
    assert works(refused.value) == pytest.approx(limit, rel=3e-6)
    assert works(refused.value) < limit
    swings(works(refused.value), base, sense, kind, angle)


def test_a_face_that_begins_below_the_line_of_centres_is_refused() -> None:
    """Its S falls by 14 degrees under 0: sin(psi_0) d - f is the least base circle for which it stays above it."""
    low = motion_of_table([0.0, D(90), D(180), D(270)], [0.0, D(5), 0.0, D(-14)])
    least = 95.0 * math.sin(-low.extremes()[0]) - 4.0
    with pytest.raises(ParameterError) as refused:
        oscillating_cam(low, FLAT, least - 1e-3, centre_distance=95.0, face_offset=4.0)
    assert (refused.value.name, refused.value.code) == ("base_circle_radius", "swings_beyond_centres")
    assert works(refused.value) == pytest.approx(least, abs=5e-4)
    oscillating_cam(low, FLAT, works(refused.value), centre_distance=95.0, face_offset=4.0)
    # a roller's S that falls so deep is told a smaller lift
    start = math.acos((95**2 + 80**2 - 20.0**2) / (2 * 95 * 80))
    deep = motion_of_table([0.0, D(90), D(180), D(270)], [0.0, 0.1, 0.0, -1.1 * start])
    with pytest.raises(ParameterError) as refused:
        oscillating_cam(deep, ROLLER, 14.0, centre_distance=95.0, arm_length=80.0, radius=6.0)
    low_, high = deep.extremes()
    assert works(refused.value) == pytest.approx((high - low_) * start / -low_, rel=1e-5)


@pytest.mark.parametrize(
    ("key", "value", "code"),
    [("centre_distance", 0.0, "not_above_zero"), ("centre_distance", -5.0, "not_above_zero"),
     ("arm_length", 0.0, "not_above_zero"), ("sense", 0, "no_sense"), ("sense", 2, "no_sense"),
     ("base_circle_radius", 0.0, "not_above_zero"), ("base_circle_radius", math.inf, "not_above_zero")],
)  # fmt: skip
def test_what_is_no_size_is_refused(key: str, value: float, code: str) -> None:
    keys = {"centre_distance": 95.0, "arm_length": 80.0, "radius": 8.0, "sense": 1} | {key: value}
    base = keys.pop("base_circle_radius", 35.0)
    with pytest.raises(ParameterError) as refused:
        oscillating_cam(SWING, ROLLER, base, **keys)  # type: ignore[arg-type]
    assert (refused.value.name, refused.value.code, refused.value.value) == (key, code, value)


# --- phases that go on with their neighbours


@pytest.mark.parametrize("closed", [True, False])
def test_a_joined_phase_goes_on_with_the_motion_beside_it(closed: bool) -> None:
    """S' and S'' of both neighbours in mm per rad at both ends, by their own laws; rest beside dwells and the ends."""
    phases = [rise(D(60), 12.0, constant_velocity()), Phase(D(90), 6.0, JOIN), return_(D(120), 18.0, sine()),
              Phase(D(30), 5.0, JOIN), dwell(D(20)), Phase(D(40), -5.0, JOIN)]  # fmt: skip
    made = with_joins(phases, closed=closed)
    assert [p.law for p in made if p.law is JOIN] == []
    assert [made[k] for k in (0, 2, 4)] == [phases[k] for k in (0, 2, 4)]

    def rates(phase: Phase, end: float) -> list[float]:
        if phase.law is None:
            return [0.0, 0.0]
        piece = phase.law.pieces[-1 if end else 0]
        return [float(piece.value(end, k)) * phase.lift / phase.angle**k for k in (1, 2)]

    rest = [0.0, 0.0]
    assert rates(made[1], 0.0) == pytest.approx([12.0 / D(60), 0.0], abs=1e-9)
    assert rates(made[1], 1.0) == pytest.approx(rates(made[2], 0.0), abs=1e-9)
    assert rates(made[3], 0.0) == pytest.approx(rates(made[2], 1.0), abs=1e-9)
    assert rates(made[3], 1.0) == pytest.approx(rest, abs=1e-9)
    assert rates(made[5], 0.0) == pytest.approx(rest, abs=1e-9)
    assert rates(made[5], 1.0) == pytest.approx([12.0 / D(60), 0.0] if closed else rest, abs=1e-9)
    for phase in (made[1], made[3], made[5]):
        assert phase.law is not None
        (piece,) = phase.law.pieces
        assert piece.value(np.array([0.0, 1.0])) == pytest.approx([0.0, 1.0], abs=1e-12)
        assert np.abs(piece.value(np.array([0.3]), 6)).max() < 1e-6
    for wrong in ([phases[1], phases[1], phases[2]], [phases[1], phases[2], phases[5]]):
        if wrong[-1].law is JOIN and not closed:
            with_joins(wrong, closed=False)
            continue
        with pytest.raises(ParameterError) as refused:
            with_joins(wrong, closed=closed)
        assert refused.value.code == "joins_side_by_side"
        assert refused.value.name == "phases[1].law"
        assert works(refused.value) == "sine"


# --- contact


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["roller", "flat", "swinging flat above", "swinging roller above"])
def test_gaps_are_none_on_the_cam_and_what_it_is_lifted_by(name: str) -> None:
    cam = CAMS[name]
    end = FollowerEnd(cam.kind, cam.radius)
    assert follower_contact(cam, end, 1e-6).verdict is Verdict.CONTACT
    for out in (0.1, -0.1):
        found = follower_contact(cam, end, 1e-6, out=out)
        assert found.verdict is (Verdict.CLEAR if out > 0 else Verdict.OVERLAP)
        angles = np.array(found.drive_angles)
        assert len(angles) == 360
        if cam.is_flat:
            assert np.array(found.gaps) == pytest.approx(out, abs=1e-8)
            continue
        # along the normal it is nearer by the cosine of the pressure angle, but for what curves add
        assert np.array(found.gaps) == pytest.approx(out * np.cos(cam.pressure_angle(angles)), abs=3e-4)
        worst = found.worst
        assert worst.gap == min(found.gaps)
        assert found.gaps[found.drive_angles.index(worst.drive_angle)] == worst.gap
        centre = complex(cam.reference_point(worst.drive_angle))
        way = complex(cam.way(np.array([worst.drive_angle]), np.array([centre]))[0])
        assert abs(worst.point - centre - out * way / abs(way)) == pytest.approx(8.0)


def test_a_groove_touches_at_either_wall() -> None:
    """A wall 0.3 mm beyond the roller all along: lifted by 0.1 it stands nearer to that wall."""
    cam = CAMS["roller"]
    outer = cam_shape(cam, 16.3).profile
    end = FollowerEnd(ROLLER, 8.0)
    found = follower_contact(cam, end, 1e-6, beyond=outer)
    assert np.array(found.side_gaps[1]) == pytest.approx(0.3, abs=1e-6)
    assert found.verdict is Verdict.CONTACT
    assert found.greatest_gap == pytest.approx(0.3, abs=1e-6)
    lifted = follower_contact(cam, end, 1e-6, out=0.25, beyond=outer)
    angles = np.array(lifted.drive_angles)
    inner, far = (np.array(x) for x in lifted.side_gaps)
    assert inner + far == pytest.approx(0.3, abs=2e-3)
    assert lifted.verdict is Verdict.CLEAR
    assert list(lifted.gaps) == np.minimum(inner, far).tolist()
    # the place of the least gap lies on the roller, on the side of the wall that is nearer
    worst = lifted.worst
    centre = complex(cam.reference_point(worst.drive_angle)) + 0.25j
    k = lifted.drive_angles.index(worst.drive_angle)
    normal = complex(cam.normal(angles[k]))
    side = 1 if far[k] < inner[k] else -1
    assert worst.point == pytest.approx(centre + side * 8.0 * normal, abs=1e-9)


def test_verdicts_of_gaps_at_two_walls() -> None:
    places, points = np.array([0.0, 1.0, 2.0]), np.array([1j, 2j, 3j])
    cases = [
        ([0.0, 1e-7, -1e-7], [1.0, 1.0, 1.0], Verdict.CONTACT, -1e-7, 2, 1.0),
        ([0.0, 0.4, 0.2], [0.3, 0.0, 0.0], Verdict.CONTACT, 0.0, 0, 0.4),
        ([0.0, 0.4, 0.2], [0.3, 2e-6, 0.0], Verdict.CLEAR, 0.0, 0, 0.4),
        ([0.0, 0.4, 0.2], [0.3, -2e-6, 0.0], Verdict.OVERLAP, -2e-6, 1, 0.4),
        ([0.0, 0.4, math.inf], [0.3, 0.0, 0.0], Verdict.UNDECIDED, 0.0, 0, math.inf),
    ]  # fmt: skip
    for one, two, verdict, least, at, greatest in cases:
        found = judged(places, (np.array(one), np.array(two)), points, 1e-6)
        assert (found.verdict, found.worst.gap, found.greatest_gap) == (verdict, least, greatest)
        assert (found.worst.drive_angle, found.worst.point) == (places[at], points[at])
        assert found.side_gaps == (tuple(one), tuple(two))
        assert found.gaps == tuple(min(a, b) for a, b in zip(one, two, strict=True))
        assert (found.tolerance, found.worst.labels) == (1e-6, (Label.CAM, Label.BODY))


def test_a_body_is_pressed_in_as_deep_as_it_stands() -> None:
    """A bar that comes down to 9 mm from the axis of a disk of radius 10, between two of the places looked at."""
    fence, places = Fence(circle(10.0, Label.CAM)), np.arange(5.0)
    corners = [-20 + 1j, 20 + 1j, 20 + 4j, -20 + 4j]
    end = FollowerEnd(POINTED, outline=PlateOutline(rounded([(c, 0.0) for c in corners])))

    def bar(place: float) -> tuple[complex, complex]:
        return complex(0.013, 8 + (place - 1.3) ** 2), 1 + 0j

    told, given = np.array([0.5, 0.0, -0.9, 0.0, 0.0]), np.full(5, 7j)
    at, gaps, points = press_in(places, told, given, fence, end, bar, 1e-6)
    assert at[2] == pytest.approx(1.3, abs=1e-4)
    assert gaps[2] == pytest.approx(-1, abs=1e-8)
    assert points[2] == pytest.approx(9j, abs=1e-4)
    # at the places themselves the deepest sample of the bar counts, where it is deeper than the end's gap
    assert np.delete(gaps, 2) == pytest.approx([0.5, -0.91, -0.9, 0, 0], abs=1e-4)
    assert points.tolist() == [7j, pytest.approx(9.09j, abs=0.02), pytest.approx(9j, abs=1e-4), 7j, 7j, 7j]
    untouched = press_in(places, told, given, fence, end, lambda place: (20j, 1 + 0j), 1e-6)
    assert all(map(np.array_equal, untouched, (places, told, given)))
    # less than the tolerance is none
    beside = press_in(places, 0 * told, given, fence, end, lambda place: (9j - 1e-9j, 1 + 0j), 1e-6)
    assert not beside[1].any()


def test_a_body_is_looked_at_without_its_round_end() -> None:
    outline = PlateOutline(plate_stem(10.0, 60.0, (30.0, 5.0), 40.0, 1.0))
    edges = len(outline.edges)
    found = body_points(FollowerEnd(MUSHROOM, 40.0, (15.0, 15.0), outline=outline), np.linspace(0, edges, 400))
    told = found[np.isfinite(found)]
    assert 40 < len(told) < 400
    assert told.imag.max() == pytest.approx(60.0)
    assert np.all(np.abs(told) > 40.0 * (1 + 1e-10))
    square = PlateOutline(rounded([(c, 0.0) for c in (0j, 30 + 0j, 30 + 4j, 4j)]))
    arm = FollowerEnd(ROLLER, 8.0, arm_length=20.0, outline=square)
    on_arm = body_points(arm, np.array([0.0, 0.5, 1.0, 1.1, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0]))
    assert np.flatnonzero(np.isnan(on_arm)).tolist() == [4, 8]
    assert on_arm[[0, 1, 2, 3, 5, 6, 7, 9]] == pytest.approx([4j, 2j, 0, 3, 30, 30 + 2j, 30 + 4j, 4j])


def test_a_face_is_held_by_lines_arcs_and_curves() -> None:
    """A flat follower on outlines that are no cam of its own: the height of what is highest there."""
    cam = CAMS["flat"]
    square = [complex(x, y) for x, y in ((-20, -20), (20, -20), (20, 20), (-20, 20))]
    box = Profile(tuple(Segment(e, Label.CAM) for e in rounded([(c, 5.0) for c in square])))
    from geometry.cams.contact import follower as module

    gaps, points = module._face_gaps(cam, Fence(box), ANGLES, 0.0)
    for angle, gap, point in zip(ANGLES.tolist(), gaps.tolist(), points.tolist(), strict=True):
        # corners are arcs of 5 about (+-15, +-15)
        top = max((c * 0.75 * np.exp(1j * angle)).imag for c in square) + 5.0
        assert gap == pytest.approx(45.0 + float(LIFT.value(angle)) - top, abs=1e-9)
        assert point.imag == pytest.approx(top, abs=1e-9)
    eccentric = circle(12.0, Label.CAM, centre=3 + 4j)
    gaps, points = module._face_gaps(cam, Fence(eccentric), ANGLES, 0.25)
    top = ((3 + 4j) * np.exp(1j * ANGLES)).imag + 12.0
    assert gaps == pytest.approx(45.25 + LIFT.value(ANGLES) - top, abs=1e-9)
    assert points == pytest.approx((3 + 4j) * np.exp(1j * ANGLES) + 12j, abs=1e-9)


def test_a_moved_cam_is_a_new_one() -> None:
    assert replace(CAMS["roller"], radius=8.0) == CAMS["roller"]
