"""Followers on connecting rods: eccentric disks, known cams as limits, the engine, sweeps, bounds, undercut."""

from __future__ import annotations

import cmath
import json
import math
from pathlib import Path

import numpy as np
import pytest
import shapely

from geometry.base.errors import ParameterError
from geometry.cams.contact.rolled import outline_of_loop, rolled_lift
from geometry.cams.motion.follower_motion import FollowerMotion, dwell, follower_motion, return_, rise
from geometry.cams.motion.guides import Translating
from geometry.cams.plane.coupler import LinkageCam, linkage_cam
from geometry.cams.plane.disk import FollowerKind, oscillating_cam, translating_cam
from geometry.cams.plane.lost_lift import lost_lift
from geometry.cams.plane.shape import cam_shape, whole_profile
from geometry.cams.plane.undercut import is_whole, kept_arcs
from geometry.curves.line_arc import Arc, Line
from geometry.kinematics.linkage import Linkage, RockerDrive, RockerGuide, SliderDrive, SliderGuide, cosine_range
from geometry.laws.named import NAMED_LAWS
from geometry.plane.measure import distance_to_profile
from geometry.plane.profile import Profile
from tests.geometry.cams.linkage_oracle import CASES, Case, centre, normal, pose, ridden_cam
from tests.geometry.cams.oracle import MP
from tests.oracles.envelope import EnvelopeCurve, GivenMotion, Pair, Rotation, envelopes

D = math.radians
POINTED, ROLLER, MUSHROOM, FLAT = FollowerKind
NODES = np.array([0.3, 1.7, 3.1, 4.4, 5.9])
ANGLES = np.linspace(0, 2 * math.pi, 721)[:-1]
RADII = {ROLLER: 7.0, FLAT: 0.0}


def motion(lift: float) -> FollowerMotion:
    """Two laws of different smoothness and two dwells."""
    up, down = NAMED_LAWS["sine"](), NAMED_LAWS["polynomial_345"]()
    return follower_motion([rise(D(120), lift, up), dwell(D(50)), return_(D(130), lift, down), dwell(D(60))])


def travel(case: Case) -> float:
    """A lift that the case has room for, rad or mm."""
    return D(12) if isinstance(case.linkage.drive, RockerDrive) else 15.0


def made(name: str, kind: FollowerKind = ROLLER, radius: float | None = None) -> LinkageCam:
    case = CASES[name]
    size = RADII.get(kind, 7.0) if radius is None else radius
    return linkage_cam(motion(travel(case)), kind, case.linkage, case.point, direction=case.direction, radius=size)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("kind", [ROLLER, FLAT])
def test_over_an_eccentric_disk_the_cam_is_that_disk(name: str, kind: FollowerKind) -> None:
    """Lift, S', S'' and S''' from 40 digits: points, normals, both curvatures and their rate are the disk's."""
    cam = ridden_cam(CASES[name], kind, RADII[kind], 4.0, NODES)
    size = float(cam.motion.pieces[0].size)  # type: ignore[attr-defined]
    points = cam.profile_point(NODES)
    assert np.abs(np.abs(points - 4.0) - size).max() < 1e-12 * size
    outward = cam.normal(NODES) * np.exp(-1j * NODES)
    assert np.abs(outward - (points - 4.0) / size).max() < 1e-12
    assert np.abs(cam.curvature_radius(NODES) / size - 1).max() < 1e-11
    curve = cam.curve(cam.motion.pieces[0])
    # the vertices of a circle are everywhere
    assert np.abs(curve.vertex_function(NODES)).max() < 1e-8 * np.abs(curve.derivative(NODES)).max() ** 4


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", CASES)
def test_poses_and_their_derivatives_are_those_of_40_digits(name: str) -> None:
    case, cam = CASES[name], made(name)
    piece = cam.motion.pieces[0]
    for at in (0.2, 1.1, 2.0):
        s = [piece.value(np.float64(at), k) / math.factorial(k) for k in range(5)]

        def moved(t, s=s):
            return sum(MP.mpf(float(c)) * t**k for k, c in enumerate(s))

        found, angle = cam.mount.centre(s), cam.mount.angle(s)
        height, _ = cam.mount.face(s)
        for k in range(5):
            exact = MP.taylor(lambda t: centre(case, moved(t)), 0, k)[k]
            assert abs(complex(found[k]) - complex(exact)) < 1e-12 * max(1.0, abs(complex(exact))) * 10
            turn = MP.taylor(lambda t: pose(case.linkage, moved(t))[1], 0, k)[k]
            off = float(angle[k]) - float(turn)
            assert abs(math.remainder(off, 2 * math.pi) if k == 0 else off) < 1e-13 * max(1.0, abs(float(turn))) * 10
            way = MP.taylor(lambda t: (centre(case, moved(t)) * MP.conj(normal(case, moved(t)))).real, 0, k)[k]
            assert abs(float(height[k]) - float(way)) < 1e-12 * max(1.0, abs(float(way))) * 10


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("kind", [ROLLER, MUSHROOM, POINTED])
def test_at_the_rockers_end_it_is_the_cam_of_an_oscillating_follower(kind: FollowerKind, sense: int) -> None:
    radius = 0.0 if kind is POINTED else 8.0
    known = oscillating_cam(motion(D(20)), kind, 40.0, centre_distance=90.0, arm_length=70.0, radius=radius,
                            sense=sense)  # fmt: skip
    drive = RockerDrive(90 + 0j, 70.0, math.pi - sense * known.mount.start_angle, -sense)
    cam = linkage_cam(
        motion(D(20)), kind, Linkage(drive, 50.0, RockerGuide(120 + 80j * sense, 60.0)), 0j, radius=radius
    )
    assert np.abs(cam.profile_point(ANGLES) - known.profile_point(ANGLES)).max() < 1e-12
    # its sign is that of the textbook's formula, which turns with the sense
    assert np.abs(cam.pressure_angle(ANGLES) - sense * known.pressure_angle(ANGLES)).max() < 1e-12
    assert np.abs(cam.curvature_radius(ANGLES) / known.curvature_radius(ANGLES) - 1).max() < 1e-11


@pytest.mark.parametrize("offset", [0.0, 7.0, -7.0])
def test_on_a_slider_it_is_the_cam_of_a_translating_follower(offset: float) -> None:
    known = translating_cam(motion(18.0), ROLLER, 40.0, radius=9.0, follower_offset=offset)
    assert isinstance(known.mount, Translating)
    drive = SliderDrive(complex(offset, known.mount.start_height), D(90))
    cam = linkage_cam(motion(18.0), ROLLER, Linkage(drive, 60.0, SliderGuide(0 + 60j, 0.0)), 0j, radius=9.0)
    assert np.abs(cam.profile_point(ANGLES) - known.profile_point(ANGLES)).max() < 1e-12
    assert np.abs(cam.pressure_angle(ANGLES) - known.pressure_angle(ANGLES)).max() < 1e-12


def test_a_parallelogram_moves_its_follower_on_a_circle_without_turning() -> None:
    """Circular translation: a roller on any point of the coupler is that of a rocker about a pivot moved likewise."""
    known = oscillating_cam(motion(D(18)), ROLLER, 40.0, centre_distance=90.0, arm_length=70.0, radius=8.0)
    turn = cmath.exp(1j * D(35))
    point = 11 - 17j
    pivot = 90 - point * turn
    drive = RockerDrive(pivot, 70.0, math.pi - known.mount.start_angle, -1)
    # A left of the line from A to the second pivot would be the anti-parallelogram
    parallel = [linkage_cam(motion(D(18)), ROLLER, Linkage(drive, 50.0, RockerGuide(pivot + 50 * turn, 70.0, side)),
                            point, radius=8.0) for side in (1, -1)]  # fmt: skip
    turning = [cam.member_swing("coupler") for cam in parallel]
    cam = parallel[int(np.argmin(turning))]
    assert min(turning) < 1e-13
    assert max(turning) > 0.1
    assert np.abs(cam.profile_point(ANGLES) - known.profile_point(ANGLES)).max() < 1e-12
    # a flat face that does not turn is lifted as a translating one is
    face = linkage_cam(motion(D(18)), FLAT, cam.mount.linkage, point, direction=D(70))
    height = (face.reference_point(ANGLES) * np.conj(face.normal(ANGLES))).real
    rate = (face.way(ANGLES, face.place(ANGLES)) * np.conj(face.normal(ANGLES))).real * face.motion.value(ANGLES, 1)
    by_book = face.normal(ANGLES) * (height - 1j * rate)
    assert np.abs(face.contact(ANGLES) - by_book).max() < 1e-12 * 100


def test_the_middle_of_a_trammels_rod_runs_on_a_circle() -> None:
    """Cardan's ellipses: two guides at right angles, the middle of the rod is half of it from their crossing."""
    linkage = Linkage(SliderDrive(5 + 20j, D(90)), 60.0, SliderGuide(5 + 0j, 0.0))
    found = linkage.closed(0.0, 35.0)
    assert found is not None
    joint, turn = found.pose([np.linspace(0, 35, 50)])
    assert np.abs(np.abs(joint[0] + 30 * turn[0] - 5) - 30).max() < 1e-13 * 60


def engine(cam: LinkageCam) -> list[EnvelopeCurve]:
    """The same cam by the envelope engine: Savvin's condition, no closed form of roller or face."""

    def moving(t, order):
        s = [cam.motion.value(t, k) / math.factorial(k) for k in range(order + 1)]
        return cam.mount.centre(s), cam.mount.angle(s)

    along = cmath.exp(1j * (cam.mount.direction - math.pi / 2))
    shape = Line(-80 * along, 80 * along) if cam.is_flat else Arc(0j, cam.radius, 0.3, 2 * math.pi)
    return envelopes(Pair(Rotation(1.0), GivenMotion(moving), shape), 0.05, 6.2)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("kind", [ROLLER, FLAT])
def test_the_envelope_engine_says_the_same(name: str, kind: FollowerKind) -> None:
    cam = made(name, kind)
    t = np.linspace(0.2, 5.9, 41)
    best = min(engine(cam), key=lambda b: float(np.abs(b.point(t) - cam.profile_point(t)).max()))
    contacts = best.contacts(t)
    assert np.abs(contacts.point_1 - cam.profile_point(t)).max() < 1e-9
    assert np.abs(np.abs(contacts.sliding) - np.abs(cam.sliding_velocity(t))).max() < 1e-8
    assert np.abs(1 / np.abs(contacts.curvature_1) - np.abs(cam.curvature_radius(t))).max() < 1e-6 * 50
    lifting = np.abs(cam.motion.value(t, 1)) > 1e-3 * travel(CASES[name])
    angle = np.abs(cam.contact_pressure_angle(t))
    assert np.abs(contacts.pressure_angle - np.minimum(angle, math.pi - angle))[lifting].max() < 1e-9


def brute_centres(name: str, angle: np.ndarray) -> np.ndarray:
    """Reference points in the cam's frame by the oracle's own linkage."""
    cam = made(name)
    lift = cam.motion.value(angle)
    return np.array([complex(centre(CASES[name], MP.mpf(float(s)))) for s in lift]) * np.exp(-1j * angle)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", CASES)
def test_a_swept_roller_leaves_the_profile_and_nothing_else(name: str) -> None:
    """Every roller touches the outline and none reaches into it; a shifted roller is seen."""
    cam = made(name)
    assert is_whole(cam)
    profile = whole_profile(cam)
    angle = np.linspace(0, 2 * math.pi, 121)[:-1]
    centres = brute_centres(name, angle)
    assert np.abs(distance_to_profile(centres, profile) - cam.radius).max() < 1e-9
    outward = cam.normal(angle) * np.exp(-1j * angle)
    assert np.abs(distance_to_profile(centres - 0.01 * outward, profile) - cam.radius).min() > 0.009
    outline = shapely.Polygon(_coordinates(dense(profile)))
    rollers = shapely.MultiPoint(_coordinates(centres)).buffer(cam.radius * (1 - 1e-4), quad_segs=32)
    assert outline.is_valid
    assert outline.intersection(rollers).area < 1e-6


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", CASES)
def test_a_swept_face_leaves_the_profile_and_nothing_else(name: str) -> None:
    case, cam = CASES[name], made(name, FLAT)
    if not is_whole(cam):
        pytest.skip("this face is undercut")
    points = dense(whole_profile(cam))
    for at in np.linspace(0, 2 * math.pi, 61)[:-1]:
        lift = MP.mpf(float(cam.motion.value(at)))
        out = complex(normal(case, lift)) * cmath.exp(-1j * at)
        height = ((points - complex(centre(case, lift)) * cmath.exp(-1j * at)) * out.conjugate()).real
        assert -1e-3 < height.max() < 1e-11


def dense(profile: Profile, samples: int = 400) -> np.ndarray:
    return np.concatenate([s.curve.point(np.linspace(*s.curve.domain, samples)) for s in profile.segments()])


def _coordinates(points: np.ndarray) -> np.ndarray:
    return np.c_[points.real, points.imag]


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("kind", [ROLLER, FLAT])
def test_bounds_of_derivatives_hold_and_are_not_loose(name: str, kind: FollowerKind) -> None:
    cam = made(name, kind)
    for piece in cam.motion.pieces:
        if piece.is_constant:
            continue
        curve = cam.curve(piece)
        for share in ((0.0, 1.0), (0.3, 0.4)):
            a, b = (piece.start + x * (piece.end - piece.start) for x in share)
            t = np.linspace(a, b, 301)
            for order in (1, 2, 3, 4):
                bound = curve.derivative_bound(order, a, b)
                assert bound is not None
                most = np.abs(curve.derivative(t, order)).max()
                assert most <= bound
                if order <= 2 and share[0]:
                    assert bound < 3.0 * most


def test_room_is_the_least_of_all_positions() -> None:
    rng = np.random.default_rng(5)
    closed = 0
    for _ in range(300):
        turns = rng.random() < 0.5
        drive = (RockerDrive(complex(*rng.uniform(-50, 50, 2)), rng.uniform(5, 60), rng.uniform(-4, 4),
                             int(rng.choice([1, -1]))) if turns
                 else SliderDrive(complex(*rng.uniform(-50, 50, 2)), rng.uniform(-4, 4)))  # fmt: skip
        guide = (RockerGuide(complex(*rng.uniform(-50, 50, 2)), rng.uniform(5, 60)) if rng.random() < 0.5
                 else SliderGuide(complex(*rng.uniform(-50, 50, 2)), rng.uniform(-4, 4)))  # fmt: skip
        high = rng.uniform(0.1, 2.5) if turns else rng.uniform(1, 60)
        linkage = Linkage(drive, rng.uniform(5, 80), guide)
        found = linkage.closed(0.0, high)
        with np.errstate(invalid="ignore"):
            joint, turn = (x[0] for x in linkage.pose([np.linspace(0, high, 4001)]))
        whole = bool(np.all(np.isfinite(turn)))
        if found is None:
            least, most = linkage.coupler_lengths(0.0, high)
            assert not whole or not least + 1e-3 < linkage.coupler_length < most - 1e-3
            continue
        closed += 1
        assert whole
        far = joint + linkage.coupler_length * turn
        if isinstance(guide, RockerGuide):
            assert np.abs(np.abs(far - guide.pivot) - guide.length).max() < 1e-10
            sine = np.abs((np.conj(turn) * (guide.pivot - far)).imag) / guide.length
        else:
            assert np.abs(((far - guide.point) * cmath.exp(-1j * guide.direction)).imag).max() < 1e-10
            sine = np.abs((turn * cmath.exp(-1j * guide.direction)).real)
        least = math.sin(found.transmission_angle())
        assert least - 1e-9 <= sine.min() <= least + 2e-3
    assert closed > 60


def test_cosines_over_an_interval() -> None:
    rng = np.random.default_rng(1)
    for first, last in rng.uniform(-12, 12, (200, 2)):
        values = np.cos(np.linspace(first, last, 5001))
        low, high = cosine_range(first, last)
        assert low - 1e-12 <= values.min() <= low + 1e-4
        assert high - 1e-4 <= values.max() <= high + 1e-12


@pytest.mark.sampled(1)
@pytest.mark.parametrize("kind", [ROLLER, FLAT])
def test_an_undercut_cam_is_trimmed_and_the_lost_lift_is_what_a_follower_loses(kind: FollowerKind) -> None:
    """Too large a roller, or too steep a law for a face: dropped onto the dense outline it loses what is told."""
    law, angle = NAMED_LAWS["sine"](), D(60) if kind is ROLLER else D(75)
    steep = follower_motion(
        [rise(angle, D(20), law), dwell(D(20)), return_(angle, D(20), law), dwell(D(340) - 2 * angle)]
    )
    radius = 30.0 if kind is ROLLER else 0.0
    cam = linkage_cam(steep, kind, FOUR.linkage, FOUR.point, direction=FOUR.direction, radius=radius)
    kept = kept_arcs(cam)
    assert kept.gaps
    outline = dense(cam_shape(cam).profile, 3000)

    def gap_over(near: np.ndarray, lift: float) -> float:
        if kind is ROLLER:
            return float(np.abs(cam.mount.centre([np.float64(lift)])[0] - near).min()) - radius
        height, turned = (x[0] for x in cam.mount.face([np.float64(lift)]))
        return float(height - (near * np.exp(-1j * turned)).real.max())

    for gap in kept.gaps:
        at = np.linspace(gap.start, gap.end, 7)[1:-1]
        told = lost_lift(cam, at, gap.corner, -radius)
        assert told.min() > 0
        for place, lost in zip(at.tolist(), told.tolist(), strict=True):
            wanted, near = float(cam.motion.value(place)), outline * cmath.exp(1j * place)
            # the first S from above at which some vertex is reached
            free, rests = wanted + 1e-6, wanted - 1.5 * lost - 1e-3
            for _ in range(2):
                lifts = np.linspace(free, rests, 33).tolist()
                first = next(i for i, x in enumerate(lifts) if gap_over(near, x) <= 1e-9)
                free, rests = lifts[max(first - 1, 0)], lifts[first]
            assert abs(wanted - rests - lost) < 3e-3 * max(lost, 1e-3) + 4e-6
        assert gap.lost_lift >= told.max() - 1e-12


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", CASES)
def test_rolled_over_a_circle_it_moves_as_40_digits_say(name: str) -> None:
    """The cam's own law does not enter: an eccentric disk of the follower's least size, read back as two arcs."""
    case, cam = CASES[name], made(name)
    arm, low = 2.0, float(abs(complex(centre(case, MP.mpf(travel(case) / 2))))) - cam.radius
    circle = outline_of_loop(np.array([low + arm, arm - low]) + 0j, np.ones(2))
    found = rolled_lift(cam, circle, 24)
    for k in range(0, 24, 5):
        disk = arm * MP.expj(2 * MP.pi * k / 24)
        exact = MP.findroot(lambda s, disk=disk: abs(centre(case, s) - disk) - (low + cam.radius), travel(case) / 2)
        assert abs(found[k] - float(exact)) < 1e-12 * max(1.0, travel(case))


FOUR = CASES["four-bar"]
REFUSED = {
    "too short": (lambda: linkage_cam(motion(D(12)), ROLLER, Linkage(FOUR.linkage.drive, 20.0, FOUR.linkage.guide),
                                      FOUR.point, radius=7.0), "coupler_length", "linkage_comes_apart"),
    "no radius": (lambda: made("four-bar", ROLLER, 0.0), "radius", "follower_without_radius"),
    "a radius": (lambda: made("four-bar", FLAT, 3.0), "radius", "follower_has_no_radius"),
    "other way": (lambda: linkage_cam(motion(D(12)), ROLLER, Linkage(RockerDrive(91 + 26j, 58.0, D(167), 1), 43.0,
                                      FOUR.linkage.guide), FOUR.point, radius=7.0), "sense", "follower_comes_nearer"),
    "face away": (lambda: linkage_cam(motion(D(12)), FLAT, FOUR.linkage, FOUR.point, direction=FOUR.direction + D(180)),
                  "direction", "face_looks_away"),
    "over the axis": (lambda: linkage_cam(motion(D(60)), ROLLER, Linkage(RockerDrive(50 + 0j, 50.0, D(150), 1), 60.0,
                                          RockerGuide(40 + 90j, 60.0)), 0j, radius=5.0),
                      "point", "follower_reaches_axis"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_be_is_refused(name: str) -> None:
    build, key, code = REFUSED[name]
    with pytest.raises(ParameterError) as caught:
        build()
    assert (caught.value.name, caught.value.code) == (key, code)


@pytest.mark.parametrize(
    ("length", "code", "least", "most"),
    [(50.0, "linkage_comes_apart", 110.0, 150.0), (20.0, "linkage_never_closes", 140.0, 120.0)],
)
def test_couplers_that_do_not_close_are_told_between_which_lengths_they_would(
    length: float, code: str, least: float, most: float
) -> None:
    """A slider that moves 60 mm away from a pivot 100 mm behind it: joint A from 100 to 160 mm off a rocker's pivot."""
    linkage = Linkage(SliderDrive(0j, 0.0), 160.0, RockerGuide(-100 + 0j, length))
    with pytest.raises(ParameterError) as caught:
        linkage_cam(motion(60.0), ROLLER, linkage, 0j, radius=5.0)
    assert (caught.value.name, caught.value.value, caught.value.code) == ("coupler_length", 160.0, code)
    assert caught.value.numbers == pytest.approx({"least": least, "most": most})


@pytest.mark.parametrize("kind", ["translating", "rocker"])
@pytest.mark.parametrize("degrees", [30, 60, 100])
def test_savvins_rollers_by_his_corrected_formulas(kind: str, degrees: int) -> None:
    """(21), (22) recomputed at 40 digits: the roller on the driven member, whatever else hangs on it."""
    file = Path(__file__).parents[3] / "published" / "cams.json"
    cases = {c["id"]: c for c in json.loads(file.read_text(encoding="utf-8"))["cases"]}
    known = cases[f"002.roller.{kind}.{degrees}"]
    lift, drive, radius = 20.0, SliderDrive(10 + 40j, D(90)), 8.0
    linkage = Linkage(drive, 70.0, SliderGuide(0 + 50j, 0.0))
    if kind == "rocker":
        lift, radius = D(20), 10.0
        linkage = Linkage(RockerDrive(80 + 0j, 60.0, D(145), -1), 70.0, RockerGuide(100 + 90j, 80.0))
    law = NAMED_LAWS["sine"]()
    steps = follower_motion([rise(D(120), lift, law), return_(D(120), lift, law), dwell(D(120))])
    cam = linkage_cam(steps, ROLLER, linkage, 0j, radius=radius)
    point = complex(cam.profile_point(D(degrees)))
    assert abs(point - complex(known["recomputed"]["xi1"], known["recomputed"]["eta1"])) < 1e-10
    if (kind, degrees) == ("translating", 60):
        # his follower does not turn: all of it moves as the roller's centre does here
        angle = math.degrees(float(cam.pressure_angle(D(60))))
        assert angle == pytest.approx(cases["002.pressure_angle"]["recomputed"]["nu_deg_savvin"], abs=1e-9)
