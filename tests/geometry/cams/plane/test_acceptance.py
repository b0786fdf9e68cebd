"""Acceptance cases of cams: the eccentric disk for every follower, textbook problems, the practicum and Savvin."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from geometry.cams.motion.follower_motion import FollowerMotion, PhaseKind, dwell, follower_motion, return_, rise
from geometry.cams.motion.guides import Mount, Oscillating, Translating
from geometry.cams.plane.disk import DiskCam, FollowerKind, oscillating_cam, translating_cam
from geometry.cams.plane.synthesis import (
    axis_region,
    flat_base_radius,
    greatest_pressure_angle,
    least_convex_radius,
    roller_prime_radius,
)
from geometry.laws.law import Law
from geometry.laws.named import (
    constant_acceleration,
    cosine,
    linearly_decreasing,
    polynomial_345,
    sine,
)
from tests.geometry.cams.oracle import Eccentric, ridden_cam

PUBLISHED = json.loads((Path(__file__).parents[3] / "published" / "cams.json").read_text(encoding="utf-8"))
CASES = {c["id"]: c for c in PUBLISHED["cases"]}
LAWS: dict[str, Law] = {
    "constant acceleration": constant_acceleration(),
    "cosine acceleration": cosine(),
    "sine acceleration": sine(),
    "linearly decreasing acceleration": linearly_decreasing(),
    "3-4-5 polynomial": polynomial_345(),
}
POINTED, ROLLER, MUSHROOM, FLAT = FollowerKind
ECCENTRIC_CASES: dict[str, tuple[FollowerKind, Mount, float]] = {
    **{f"{kind}, offset {e}": (kind, Translating(e, 0.0), radius)
       for kind, radius in ((POINTED, 0.0), (ROLLER, 8.0), (MUSHROOM, 60.0), (FLAT, 0.0)) for e in (-12.0, 0.0, 5.0)},
    **{f"oscillating {kind}, sense {sense}, face offset {f}": (kind, Oscillating(100.0, 80.0, 0.0, sense, f), radius)
       for kind, radius, f in ((POINTED, 0.0, 0.0), (ROLLER, 8.0, 0.0), (MUSHROOM, 60.0, 0.0), (FLAT, 0.0, 0.0),
                               (FLAT, 0.0, 7.0), (FLAT, 0.0, -7.0)) for sense in (1, -1)},
}  # fmt: skip
NODES = np.linspace(0, 2 * math.pi, 25)[:-1]


@pytest.mark.sampled(2)
@pytest.mark.parametrize("case", ECCENTRIC_CASES)
def test_an_eccentric_disk_comes_back_as_its_circle(case: str) -> None:
    """Acceptance A8: within 1e-12 of the radius, curvature too, whatever the follower."""
    kind, mount, radius = ECCENTRIC_CASES[case]
    cam = ridden_cam(Eccentric(40.0, 10.0), kind, mount, radius, NODES)
    assert np.max(np.abs(np.abs(cam.profile_point(NODES) - 10.0) - 40.0)) <= 1e-12 * 40
    assert np.allclose(cam.curvature_radius(NODES), 40.0, rtol=1e-10)


def test_heights_over_the_eccentric_disk() -> None:
    """A8: y at 0, 90, 180 and 270 degrees of a roller 8 at offset 5 on a disk 40, 10 off its axis."""
    at = np.array([0, 0.5, 1, 1.5]) * math.pi
    cam = ridden_cam(Eccentric(40.0, 10.0), ROLLER, Translating(5.0, 0.0), 8.0, at)
    assert np.allclose(cam.reference_point(at).imag, [47.738873, 57.738873, 45.596052, 37.738873], atol=5e-7)


@pytest.mark.parametrize(("lift", "base", "offset"), [(50.0, 25.0, 0.0), (2.0, 1.5, 0.75)])
def test_harmonic_lift_under_a_flat_face_is_an_eccentric_circle(lift: float, base: float, offset: float) -> None:
    """A1, A2: radius R_b + H/2 about a point H/2 off the axis; the stem's offset changes nothing."""
    motion = follower_motion([rise(math.pi, lift, cosine()), return_(math.pi, lift, cosine())])
    cam = translating_cam(motion, FLAT, base, follower_offset=offset)
    angle = np.linspace(0, 2 * math.pi, 361)
    size = base + lift / 2
    # the follower is highest at half a turn
    assert np.max(np.abs(np.abs(cam.profile_point(angle) - 1j * -lift / 2) - size)) <= 1e-13 * size
    assert cam.face_reach() == pytest.approx((-lift / 2, lift / 2), rel=1e-14)


def quarter_motion(law: Law, lift: float) -> FollowerMotion:
    quarter = math.pi / 2
    return follower_motion([rise(quarter, lift, law), dwell(quarter), return_(quarter, lift, law), dwell(quarter)])


def test_the_cycloidal_flat_cam() -> None:
    """A4: 1.8926312786 at 66.5444 degrees, face 8/pi; a package's README prints 1.893 and 2.55."""
    found = flat_base_radius(quarter_motion(sine(), 1.0), 0.25)
    assert found.value == pytest.approx(1.8926312786, abs=5e-11)
    assert math.degrees(found.angle) == pytest.approx(66.5444, abs=5e-5)
    cam = translating_cam(quarter_motion(sine(), 1.0), FLAT, found.value)
    low, high = cam.face_reach()
    assert high - low == pytest.approx(8 / math.pi, rel=1e-13)
    assert least_convex_radius(cam).value == pytest.approx(0.25, abs=1e-12)


def test_the_cycloidal_roller_cam() -> None:
    """A5: R_b 1.2509445300 for 30 degrees with a roller of 0.5; least convex pitch radius 1.39410981 at 66.42."""
    motion = quarter_motion(sine(), 1.0)
    prime = roller_prime_radius(motion, 0.0, math.radians(30))
    assert prime - 0.5 == pytest.approx(1.2509445300, abs=5e-11)
    cam = translating_cam(motion, ROLLER, prime - 0.5, radius=0.5)
    assert greatest_pressure_angle(cam).value == pytest.approx(math.radians(30), abs=1e-12)
    bend = least_convex_radius(cam)
    assert bend.value + 0.5 == pytest.approx(1.39410981, abs=5e-9)
    assert math.degrees(bend.angle) == pytest.approx(66.42, abs=5e-3)


def test_the_345_roller_cam() -> None:
    """A6: 10 mm in 90/45/180/45, r 12.5, R_b 63.7."""
    law, d = polynomial_345(), math.radians
    motion = follower_motion([rise(d(90), 10, law), dwell(d(45)), return_(d(180), 10, law), dwell(d(45))])
    cam = translating_cam(motion, ROLLER, 63.7, radius=12.5)
    steepest = greatest_pressure_angle(cam, PhaseKind.RISE)
    assert math.degrees(steepest.value) == pytest.approx(8.376513, abs=5e-7)
    assert math.degrees(steepest.angle) == pytest.approx(43.700, abs=5e-4)
    bend = least_convex_radius(cam)
    assert bend.value + 12.5 == pytest.approx(67.065060, abs=5e-7)
    assert math.degrees(bend.angle) == pytest.approx(69.319, abs=5e-4)
    angle = np.linspace(0, 2 * math.pi, 1441)
    assert np.all(cam.curvature_radius(angle) > 0)


@pytest.mark.parametrize("law", LAWS)
def test_least_radius_of_the_practicums_flat_cam(law: str) -> None:
    case = CASES[f"000.p4.r0.{law.replace(' ', '_')}"]["recomputed"]
    d = math.radians
    phases = [rise(d(120), 38, LAWS[law]), dwell(d(30)), return_(d(120), 38, LAWS[law]), dwell(d(90))]
    motion = follower_motion(phases)
    found = flat_base_radius(motion)
    assert found.value == pytest.approx(case["r0_mm"], rel=1e-13)
    # the return is symmetric and as good a place
    share = found.angle / d(120)
    assert min(abs(share - case["at_k"]), abs(share - (150 + 120 * (1 - case["at_k"])) / 120)) <= 1e-9
    assert motion.extremes(2)[1] == pytest.approx(case["S2_max_mm"], rel=1e-13)
    for rho in (10, 15):
        assert flat_base_radius(motion, rho).value == pytest.approx(case[f"R_min_with_rho_{rho}_mm"], rel=1e-13)


@pytest.mark.parametrize("law", LAWS)
def test_least_radius_of_the_practicums_roller_cam(law: str) -> None:
    case = CASES[f"000.p5.r0.{law.replace(' ', '_')}"]["recomputed"]
    d = math.radians
    motion = follower_motion([rise(d(130), 30, LAWS[law]), dwell(d(50)), return_(d(130), 30, LAWS[law]), dwell(d(50))])
    rising, both = axis_region(motion, d(30)), axis_region(motion, d(30), d(30))
    assert rising.least_height(3.0) == pytest.approx(case["s0_offset_helps_mm"], rel=1e-13)
    assert rising.least_prime_radius(3.0) == pytest.approx(case["r0_offset_helps_mm"], rel=1e-13)
    assert rising.least_height(-3.0) == pytest.approx(case["s0_offset_hinders_mm"], rel=1e-13)
    assert rising.least_prime_radius(-3.0) == pytest.approx(case["r0_offset_hinders_mm"], rel=1e-13)
    assert both.least_prime_radius(3.0) == pytest.approx(case["r0_both_phases_offset_helps_on_rise_mm"], rel=1e-13)


def test_least_flat_radius_of_table_2_2() -> None:
    case = CASES["003.table2_2.r0_flat"]["recomputed"]
    d = math.radians
    law = linearly_decreasing()
    motion = follower_motion([rise(d(90), 32, law), dwell(d(60)), return_(d(90), 32, law), dwell(d(120))])
    found = flat_base_radius(motion)
    assert found.value == pytest.approx(-case["min_S_plus_S2_mm"], rel=1e-13)
    assert found.angle == pytest.approx(d(90), abs=1e-12)


def test_pressure_angle_formula_of_the_practicum() -> None:
    case = CASES["000.p4.pressure_angle_formula"]
    given = case["inputs"]
    height = math.sqrt(given["r0_mm"] ** 2 - given["e_mm"] ** 2)
    # a motion with the case's S and S' at its middle
    s, rate = given["s_B_mm"], given["V_qB_mm"]
    angle, law = 2 * s * 15 / 8 / rate, polynomial_345()
    motion = follower_motion([rise(angle, 2 * s, law), return_(3.0, 2 * s, law), dwell(2 * math.pi - 3.0 - angle)])
    cam = DiskCam(motion, Translating(given["e_mm"], height), POINTED)
    at = s * 15 / 8 / rate
    assert math.tan(float(cam.pressure_angle(at))) == pytest.approx(case["recomputed"]["tan_true"], rel=1e-12)


@pytest.mark.parametrize("degrees", [30, 60, 100])
def test_savvins_translating_roller_and_flat_face(degrees: int) -> None:
    """Seed 002: (21), (22) corrected, (15), (16), and the pressure angle (28)."""
    d = math.radians
    motion = follower_motion([rise(d(120), 20, sine()), dwell(d(120)), return_(d(120), 20, sine())])
    roller = DiskCam(motion, Translating(10.0, 40.0), ROLLER, 8.0)
    expected = CASES[f"002.roller.translating.{degrees}"]["recomputed"]
    found = complex(roller.profile_point(d(degrees)))
    assert found == pytest.approx(complex(expected["xi1"], expected["eta1"]), rel=1e-13)
    flat = DiskCam(motion, Translating(10.0, 40.0), FLAT)
    expected = CASES[f"002.flat.translating.{degrees}"]["recomputed"]
    assert complex(flat.profile_point(d(degrees))) == pytest.approx(
        complex(expected["xi1"], expected["eta1"]), rel=1e-13
    )
    if degrees == 60:
        angle = CASES["002.pressure_angle"]["recomputed"]["nu_deg_classical"]
        assert math.degrees(float(roller.pressure_angle(d(60)))) == pytest.approx(angle, rel=1e-13)


@pytest.mark.parametrize("degrees", [30, 60, 100])
def test_savvins_rocker(degrees: int) -> None:
    d = math.radians
    motion = follower_motion([rise(d(120), d(20), sine()), dwell(d(120)), return_(d(120), d(20), sine())])
    cam = DiskCam(motion, Oscillating(80.0, 60.0, d(35)), ROLLER, 10.0)
    expected = CASES[f"002.roller.rocker.{degrees}"]["recomputed"]
    assert complex(cam.profile_point(d(degrees))) == pytest.approx(
        complex(expected["xi1"], expected["eta1"]), rel=1e-13
    )


def test_base_circles_are_kept() -> None:
    """The lowest contact stands on the base circle, for every follower."""
    d = math.radians
    motion = follower_motion([rise(d(120), d(20), sine()), dwell(d(40)), return_(d(120), d(20), sine()), dwell(d(80))])
    linear = follower_motion([rise(d(120), 20, sine()), dwell(d(40)), return_(d(120), 20, sine()), dwell(d(80))])
    at = d(320)
    cams = [
        translating_cam(linear, POINTED, 31.0, follower_offset=4),
        translating_cam(linear, ROLLER, 31.0, radius=9.0, follower_offset=-4),
        translating_cam(linear, MUSHROOM, 31.0, radius=90.0),
        translating_cam(linear, FLAT, 31.0, follower_offset=4),
        *(
            oscillating_cam(motion, ROLLER, 31.0, centre_distance=90, arm_length=85, radius=9.0, sense=s)
            for s in (1, -1)
        ),
        *(oscillating_cam(motion, FLAT, 31.0, centre_distance=90, face_offset=f) for f in (-3, 0, 3)),
    ]
    for cam in cams:
        assert abs(complex(cam.profile_point(at))) == pytest.approx(31.0, rel=1e-14)
