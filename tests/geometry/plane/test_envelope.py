"""The envelope engine against everything with a formula of its own: racks, cycloidal disks, Savvin's cases, cams."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from geometry.base.errors import ParameterError
from geometry.base.placement import Placement2
from geometry.base.series import FACTORIALS
from geometry.cams.motion.follower_motion import dwell, follower_motion, return_, rise
from geometry.cams.motion.guides import Oscillating
from geometry.cams.plane.disk import DiskCam, FollowerKind, oscillating_cam, translating_cam
from geometry.curves.curve import Curve
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc, Line
from geometry.curves.trochoid import TrochoidFillet
from geometry.kinematics.motion import Pose
from geometry.laws.named import polynomial_345, sine
from tests import laws
from tests.oracles.envelope import EnvelopeCurve, GivenMotion, Pair, Rotation, Sliding, envelopes, instant_centre

PUBLISHED = json.loads((Path(__file__).parents[2] / "published" / "cams.json").read_text(encoding="utf-8"))
CASES = {c["id"]: c for c in PUBLISHED["cases"]}
D = math.radians
ROLLER_CIRCLE = 2 * math.pi


@dataclass(frozen=True)
class Wavy:
    """a + b t + c sin(f t + p) as a series: enough for the motions of the cases."""

    a: complex
    b: complex
    c: complex
    f: float
    p: float

    def series(self, t: np.ndarray, order: int) -> list[np.ndarray]:
        """Taylor coefficients."""
        waves = [
            self.c * self.f**k * np.sin(self.f * t + self.p + k * math.pi / 2) / FACTORIALS[k] for k in range(order + 1)
        ]
        waves[0] = waves[0] + self.a + self.b * t
        if order:
            waves[1] = waves[1] + self.b
        return waves


def general_motions() -> tuple[GivenMotion, GivenMotion]:
    """Seed 002, "general": x01 = 3 sin t, y01 = 2 t, x02 = 30 + 5 cos 2t, y02 = 45 - 4 t, both angles wavy."""

    def first(t: np.ndarray, order: int) -> Pose:
        return Wavy(0, 2j, 3, 1, 0).series(t, order), [x.real for x in Wavy(0, 1, 0.3, 1, 0).series(t, order)]

    def second(t: np.ndarray, order: int) -> Pose:
        half = math.pi / 2
        return Wavy(30 + 45j, -4j, 5, 2, half).series(t, order), [
            x.real for x in Wavy(-0.2, 0, 0.4, 1, half).series(t, order)
        ]

    return GivenMotion(first), GivenMotion(second)


def nearest(curves: list[EnvelopeCurve], t: float, point: complex) -> float:
    """Distance of a point from the nearest branch at t."""
    return min(abs(complex(c.point(t)) - point) for c in curves if c.start <= t <= c.end)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("degrees", [30, 60, 100])
def test_savvins_general_case(degrees: int) -> None:
    """Both bodies in general plane motion, a roller; A, B, F and R as recomputed from the printed formulas."""
    first, second = general_motions()
    expected = CASES[f"002.roller.general.{degrees}"]["recomputed"]
    found = envelopes(Pair(first, second, Arc(0j, 6.0, 0.0, ROLLER_CIRCLE)), 0.2, 2.2)
    assert nearest(found, D(degrees), complex(expected["xi1"], expected["eta1"])) <= 1e-12 * 60
    _, moving = instant_centre(first, second, np.array(D(degrees)))
    assert complex(moving) == pytest.approx(complex(expected["F"], expected["R"]), rel=1e-12)


def test_bodies_that_turn_alike() -> None:
    """omega_1 = omega_2: (12), (13) divide by zero, the engine's condition does not; both sides are branches."""
    case = CASES["002.omega_equal"]
    given, limit = case["inputs"], case["recomputed"]["limit_contact_(up_to_sign)"]

    def moving(t: np.ndarray, order: int) -> Pose:
        origin = Wavy(
            complex(given["x02_minus_x01"], given["y02_minus_y01"]), complex(given["vx"], given["vy"]), 0, 1, 0
        )
        return origin.series(t, order), [
            x.real for x in Wavy(given["alpha2"], given["omega1"], 0, 1, 0).series(t, order)
        ]

    pair = Pair(
        Rotation(given["omega1"], start=given["alpha1"]),
        GivenMotion(moving),
        Arc(0j, given["r_roller_mm"], 0.3, ROLLER_CIRCLE),
    )
    found = envelopes(pair, -0.05, 0.05, samples=11)
    contacts = [complex(e.contacts(0.0).point_2) for e in found]
    for sign in (1, -1):
        assert min(abs(c - sign * complex(*limit)) for c in contacts) <= 1e-9


def test_a_rack_leaves_the_involute() -> None:
    """Acceptance A9: translation r theta, straight flank of 20 degrees: the involute of r cos 20."""
    r, alpha = 23.0, D(20)
    flank = Line(r - 6 * np.exp(1j * alpha), r + 6 * np.exp(1j * alpha))
    curve = envelopes(Pair(Rotation(1.0), Sliding(1j * r), flank), -0.33, 0.33)[0]
    t = np.linspace(*curve.domain, 65)
    base = r * math.cos(alpha)
    # the contact's distance along the line of action gives the involute's roll angle
    roll = np.sqrt(np.abs(curve.point(t)) ** 2 / base**2 - 1)
    exact = Involute(base, 0.0, 0.0, 2.0)
    turn = curve.point(t) / exact.point(roll)
    mirrored = curve.point(t) / np.conj(exact.point(roll))
    spread = min(np.ptp(np.angle(turn)), np.ptp(np.angle(mirrored)))
    assert spread <= 1e-12
    assert np.allclose(np.abs(curve.curvature(t)), 1 / (base * roll), rtol=1e-9)


def test_a_rounded_rack_leaves_the_fillet() -> None:
    """A9: the tip rounding's envelope is the trochoid fillet."""
    fillet = TrochoidFillet(23.0, 1.74, 0.76, 0.0, 0.1, 1.2)
    u = np.linspace(0.15, 1.15, 41)
    tip = Arc(23.0 - 1.74 + 0j, 0.76, math.pi / 2, math.pi)
    found = envelopes(Pair(Rotation(1.0), Sliding(23j), tip), -0.3, 0.3)
    t = 1.74 * np.tan(u) / 23.0
    t = t[np.abs(t) < 0.29]
    u = u[: len(t)]
    worst = min(float(np.max(np.abs(e.point(t) - fillet.point(u)))) for e in found if e.start < -0.29 and e.end > 0.29)
    assert worst <= 1e-12 * 23


@pytest.mark.parametrize("lobes", [6, 11])
def test_a_pin_on_a_carrier_leaves_the_cycloidal_disk(lobes: int) -> None:
    """Acceptance A10: the normal passes through the rolling point (z + 1) E, which gives the disk in closed form."""
    ring, pin, arm = 50.0, 5.0, 2.0

    def disk(t: np.ndarray, order: int) -> Pose:
        origin = [arm * np.exp(1j * t) * 1j**k / FACTORIALS[k] for k in range(order + 1)]
        return origin, [x.real for x in Wavy(0, -1 / lobes, 0, 1, 0).series(t, order)]

    pair = Pair(GivenMotion(disk), Rotation(0.0), Arc(ring + 0j, pin, 0.0, ROLLER_CIRCLE))
    found = envelopes(pair, 0.0, 2 * math.pi, samples=181)
    t = np.linspace(0, 2 * math.pi, 97)
    pole = arm * (lobes + 1) * np.exp(1j * t)
    for side in (1, -1):
        contact = ring + side * pin * (pole - ring) / np.abs(pole - ring)
        exact = (contact - arm * np.exp(1j * t)) * np.exp(1j * t / lobes)
        assert min(float(np.max(np.abs(e.point(t) - exact))) for e in found) <= 1e-12 * ring


def cams() -> dict[str, tuple[DiskCam, Curve]]:
    """Disk cams with the follower's profile in the follower's own frame."""
    lift = [rise(D(120), 20, sine()), dwell(D(50)), return_(D(120), 20, polynomial_345()), dwell(D(70))]
    swing = [rise(D(120), D(18), sine()), dwell(D(50)), return_(D(120), D(18), polynomial_345()), dwell(D(70))]
    kinds = FollowerKind
    found: dict[str, tuple[DiskCam, Curve]] = {}
    for e in (-6.0, 0.0, 6.0):
        found[f"roller {e}"] = (
            translating_cam(follower_motion(lift), kinds.ROLLER, 35, radius=9, follower_offset=e),
            Arc(0j, 9.0, 0.1, ROLLER_CIRCLE),
        )
    found["flat"] = translating_cam(follower_motion(lift), kinds.FLAT, 45), Line(40 + 0j, -40 + 0j)
    found["mushroom"] = translating_cam(follower_motion(lift), kinds.MUSHROOM, 45, radius=80), Arc(0j, 80.0, -2.4, 1.6)
    for s in (1, -1):
        roller = oscillating_cam(
            follower_motion(swing), kinds.ROLLER, 35, centre_distance=95, arm_length=80, radius=9, sense=s
        )
        found[f"oscillating roller {s}"] = roller, Arc(0j, 9.0, 0.1, ROLLER_CIRCLE)
        flat = oscillating_cam(follower_motion(swing), kinds.FLAT, 35, centre_distance=95, sense=s, face_offset=4)
        found[f"oscillating flat {s}"] = flat, Line(-200 + 0j, 200 + 0j)
    return found


def follower_of(cam: DiskCam) -> GivenMotion:
    """The follower's frame: at its reference point; the oscillating one turned so that +x runs along its arm."""

    def pose(t: np.ndarray, order: int) -> Pose:
        s = [cam.motion.value(t, k) / FACTORIALS[k] for k in range(order + 1)]
        mount = cam.mount
        if not isinstance(mount, Oscillating):
            return mount.centre(s), [0.0 * x for x in s]
        angle = [-mount.sense * x for x in s]
        angle[0] = angle[0] - mount.sense * mount.start_angle
        if not cam.is_flat:
            return mount.centre(s), angle
        # the face runs parallel to the arm through the pivot, nearer to the axis by the face offset
        from geometry.base.series import exponential

        down = [-mount.face_offset * mount.sense * 1j * x for x in exponential([1j * x for x in angle])]
        down[0] = down[0] + mount.centre_distance
        return down, angle

    return GivenMotion(pose)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", cams())
def test_closed_forms_of_cams_are_the_engines(name: str) -> None:
    """Profile, pressure angle and both curvatures of every kind of disk cam, in rise and return."""
    cam, profile = cams()[name]
    pair = Pair(Rotation(1.0), follower_of(cam), profile)
    for start, end in ((0.02, 2.07), (3.0, 5.0)):
        t = np.linspace(start + 0.05, end - 0.05, 41)
        found = [e for e in envelopes(pair, start, end, samples=121) if e.start <= t[0] and e.end >= t[-1]]
        curve = min(found, key=lambda e: float(np.max(np.abs(e.point(t) - cam.profile_point(t)))))
        assert np.max(np.abs(curve.point(t) - cam.profile_point(t))) <= 1e-11 * 50
        contacts = curve.contacts(t)
        assert np.allclose(np.abs(contacts.curvature_1), 1 / np.abs(cam.curvature_radius(t)), rtol=1e-8)
        assert np.allclose(contacts.fixed, cam.contact(t), atol=1e-9)
        if name.startswith(("roller", "flat", "mushroom")):
            assert np.allclose(contacts.pressure_angle, np.abs(cam.pressure_angle(t)), atol=1e-9)


def test_an_envelope_is_a_curve_like_any_other() -> None:
    cam, profile = cams()["roller 6.0"]
    pair = Pair(Rotation(1.0), follower_of(cam), profile)
    curve = envelopes(pair, 0.1, 2.0, samples=61)[0]
    assert isinstance(curve, Curve)
    laws.check_reversal(curve)
    laws.check_placement(curve, Placement2(0.7, 3 - 2j))
    laws.check_trimming(curve, 0.2, 0.7)
    mirrored = curve.mirrored()
    assert np.allclose(mirrored.point(np.array([-1.0, -0.5])), np.conj(curve.point(np.array([1.0, 0.5]))))
    h = 1e-4
    t = np.linspace(0.3, 1.8, 15)
    for order in (1, 2, 3, 4):
        before = curve.point if order == 1 else partial(curve.derivative, order=order - 1)
        slope = (8 * (before(t + h) - before(t - h)) - (before(t + 2 * h) - before(t - 2 * h))) / (12 * h)
        assert np.allclose(curve.derivative(t, order), slope, atol=1e-6 * np.abs(slope).max())


def test_cusps_of_an_undercut_roller_cam() -> None:
    """Each side turns back where the path's radius of curvature is the roller's: convex inside, concave outside."""
    motion = follower_motion([rise(D(60), 20, sine()), return_(D(60), 20, sine()), dwell(D(240))])
    cam = translating_cam(motion, FollowerKind.ROLLER, 12, radius=20)
    pair = Pair(Rotation(1.0), follower_of(cam), Arc(0j, 20.0, 0.1, ROLLER_CIRCLE))
    cusps = np.concatenate([e.cusps() for e in envelopes(pair, 0.05, 1.04)])
    assert np.allclose(np.sort(cam.pitch_curvature_radius(cusps)), [-20.0, -20.0, 20.0, 20.0], rtol=1e-9)


def test_a_motion_that_never_touches_is_refused() -> None:
    with pytest.raises(ParameterError):
        envelopes(Pair(Rotation(0.0), Sliding(1 + 0j), Line(0j, 1 + 1j)), 0.0, 1.0)
