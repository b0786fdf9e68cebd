"""What cams and followers report and refuse, against dense samples of their motion and closed forms of their sizes."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest

from parts.base.part import Part
from parts.scene.load import make_parts, scene_from_dict
from parts.texts.quantities import QUANTITIES
from tests.offered import GONE, Raw, cam, scenes
from tests.parts.limits import check_limit, check_offer, check_refused, offset_limits, refused, scene_of, with_key

# 20 mm up by the sine in 120 degrees, a dwell of 60, down by 10 u^3 - 15 u^4 + 6 u^5 in 120, a dwell of 60
H, BETA = 20.0, math.radians(120.0)
U = np.linspace(0.0, 1.0, 20_001)
RISE = (H * (U - np.sin(2 * np.pi * U) / (2 * np.pi)), H * (1 - np.cos(2 * np.pi * U)) / BETA,
        2 * np.pi * H * np.sin(2 * np.pi * U) / BETA**2)  # fmt: skip
FALL = (H * (1 - 10 * U**3 + 15 * U**4 - 6 * U**5), -H * 30 * U**2 * (1 - U) ** 2 / BETA,
        -H * 60 * U * (1 - U) * (1 - 2 * U) / BETA**2)  # fmt: skip
S, V, A = (np.concatenate(pair) for pair in zip(RISE, FALL, strict=True))
STEEP_SINE = 2 * H / BETA


@cache
def made(name: str) -> Part:
    return next(iter(make_parts(scene_from_dict(scenes()[name], "s", "s"), "s")[0].values()))


def part_of(part: dict[str, Any]) -> Part:
    return make_parts(scene_from_dict(scene_of(part), "s", "s"), "s")[0]["p"]


def pitch_radii(s0: float, e: float = 0.0) -> np.ndarray:
    """Radii of curvature of the follower's path in the cam's frame, mm: p = (s_0 + S) i + e, turned by -phi."""
    p = 1j * (s0 + S) + e
    one, two = 1j * V - 1j * p, 1j * A + 2 * V - p
    # it runs clockwise: convex where it turns right
    return np.asarray(np.abs(one) ** 3 / -(two * one.conjugate()).imag)


def least_convex(s0: float, e: float = 0.0) -> float:
    """The least of those above 0; of the dwells they are that of the place where they stand."""
    radii = pitch_radii(s0, e)
    return float(min(radii[radii > 0].min(), abs(complex(e, s0))))


def finding(part: Part, code: str) -> tuple[float, float] | None:
    return next(((f.value, f.limit) for f in part.findings if f.code == code), None)


@pytest.mark.parametrize("e", [0.0, 10.0, -7.0])
def test_a_roller_cam_reports_what_dense_samples_say(e: float) -> None:
    """tan(nu) = (S' - e) / (s_0 + S); the least convex radius of the path, less the roller's."""
    part = part_of(cam(follower_offset=e))
    s0 = math.sqrt(48.0**2 - e**2)
    up, down = (np.degrees(np.abs(np.arctan((v - e) / (s0 + s)))).max() for s, v, _ in (RISE, FALL))
    least = least_convex(s0, e)
    assert part.circles == pytest.approx({"base_circle_diameter": 80.0, "prime_circle_diameter": 96.0})
    assert part.quantities == pytest.approx(
        {"lift": 20.0, "follower_radius": 8.0, "follower_offset": e, "pressure_angle_rise_deg": up,
         "pressure_angle_return_deg": down, "least_curvature_radius": least - 8.0,
         "largest_roller_radius": 0.8 * least},
        rel=1e-6,
    )  # fmt: skip


def test_the_largest_roller_leaves_the_radius_that_is_wished() -> None:
    part = part_of(cam(least_curvature_radius=12.0))
    least = least_convex(48.0)
    assert part.quantities["largest_roller_radius"] == pytest.approx(min(least - 12.0, 0.8 * least), rel=1e-6)
    assert finding(part, "curvature_radius_not_kept") is None
    kept = least - 8.0
    told = finding(part_of(cam(least_curvature_radius=kept + 1e-3)), "curvature_radius_not_kept")
    assert told == (pytest.approx(kept, rel=1e-6), pytest.approx(kept + 1e-3))


def test_a_flat_cam_reports_what_dense_samples_say() -> None:
    """The face is touched at S' from the line through the axis; the profile's radius is R + S + S''."""
    flat = {"follower": "flat", "follower_radius": None, "plate_diameter": None}
    part = part_of(cam(**flat))
    assert part.circles == {"base_circle_diameter": 80.0}
    told = {k: v for k, v in part.quantities.items() if "pressure" not in k}
    assert told == pytest.approx(
        {"lift": 20.0, "least_curvature_radius": (40 + S + A).min(), "face_from": V.min(), "face_to": V.max(),
         "least_plate_diameter": 2 * V.max()}, rel=1e-6)  # fmt: skip
    assert part.quantities["pressure_angle_rise_deg"] == pytest.approx(0.0, abs=1e-9)
    beside = part_of(cam(**flat, follower_offset=3.0))
    reach = max(abs(V.min() - 3.0), abs(V.max() - 3.0))
    assert beside.quantities["least_plate_diameter"] == pytest.approx(2 * reach, rel=1e-6)
    assert finding(beside, "flat_offset") == (3.0, pytest.approx(2 * reach, rel=1e-6))
    raw = scene_of(cam(**flat | {"plate_diameter": 60.0}))
    check_limit(raw, "parts.p.plate_diameter", "contact_over_edge", float(2 * V.max()), "at_least", near=1e-5)


@pytest.mark.parametrize("sense", ["against", "with"])
def test_a_swinging_roller_reports_what_dense_samples_say(sense: str) -> None:
    """tan(nu) = (L (1 + sense psi') - d cos(psi)) / (d sin(psi)), psi from the triangle of arm, pivot and roller."""
    swing = {"centre_distance": 90.0, "arm_length": 70.0, "sense": sense}
    part = part_of(cam(lift=None, swing_deg=20.0, oscillating=swing))
    d, arm, way = 90.0, 70.0, 1 if sense == "against" else -1
    start = math.acos((d**2 + arm**2 - 48.0**2) / (2 * d * arm))
    unit = math.radians(20.0) / H
    told = part.quantities
    for name, (s, v, _) in (("rise", RISE), ("return", FALL)):
        psi = start + unit * s
        tangent = (arm * (1 + way * unit * v) - d * np.cos(psi)) / (d * np.sin(psi))
        steepest = np.degrees(np.arctan(np.abs(tangent))).max()
        assert told[f"pressure_angle_{name}_deg"] == pytest.approx(steepest, rel=1e-6)
    assert told["swing_deg"] == pytest.approx(20.0)
    assert told["start_angle_deg"] == pytest.approx(math.degrees(start))
    assert "lift" not in told
    # a motion that begins with a return ends its way there below
    back = [{"move": "return_", "angle_deg": 180.0, "law": "sine"}, {"move": "rise", "angle_deg": 180.0, "law": "sine"}]
    first = part_of(cam(lift=None, swing_deg=20.0, oscillating=swing, phases=back)).quantities
    assert first["start_angle_deg"] == pytest.approx(math.degrees(start))
    assert "S = 0" in QUANTITIES["start_angle_deg"]
    assert "lowest" not in QUANTITIES["start_angle_deg"]
    # the path in the cam's frame, by differences of fine samples
    phi = np.concatenate([U * BETA, math.radians(180.0) + U * BETA])
    psi = start + unit * S
    where = (d + arm * np.exp(1j * way * (math.pi - psi))) * np.exp(-1j * phi)
    assert np.abs(where).min() == pytest.approx(48.0, rel=1e-9)


def test_findings_begin_where_limits_end() -> None:
    """A pressure angle of 30 degrees, a roller of 0.8 of the path's least radius: nothing; a hair more: both."""
    exact = part_of(cam(base_circle_radius=None, least_transmission_angle_deg=60.0))
    assert exact.quantities["pressure_angle_rise_deg"] == pytest.approx(30.0, abs=1e-9)
    assert exact.findings == ()
    prime = (RISE[1] / math.tan(math.radians(30)) - RISE[0]).max()
    assert exact.circles["prime_circle_diameter"] == pytest.approx(2 * prime, rel=1e-7)
    steep = part_of(cam(base_circle_radius=None, least_transmission_angle_deg=59.9999))
    assert finding(steep, "steep_pressure_angle") == (pytest.approx(30.0001, rel=1e-9), 30.0)
    asked = part_of(cam(least_transmission_angle_deg=85.0))
    up = np.degrees(np.arctan(RISE[1] / (48 + RISE[0]))).max()
    assert finding(asked, "transmission_angle_not_kept") == (pytest.approx(90 - up, rel=1e-6), 85.0)
    kept = part_of(cam(least_transmission_angle_deg=float(90 - up - 1e-5)))
    assert finding(kept, "transmission_angle_not_kept") is None
    usual = 0.8 * least_convex(48.0)
    for radius, told in ((usual - 1e-3, None), (usual + 1e-3, (usual + 1e-3, usual))):
        roller = part_of(cam(follower_radius=radius, base_circle_radius=48.0 - radius, bore_diameter=0.0))
        assert finding(roller, "large_roller") == (None if told is None else pytest.approx(told, rel=1e-5))


def test_impacts_are_told_with_their_size_and_place() -> None:
    """S' jumps by H / beta where the velocity is constant, S'' by 8 H / beta^2 in the middle of constant ones."""
    phases = [{"move": "rise", "angle_deg": 120.0, "law": "constant_velocity"}, {"move": "dwell", "angle_deg": 60.0},
              {"move": "return_", "angle_deg": 180.0, "law": "sine"}]  # fmt: skip
    pointed = part_of(cam(follower="pointed", follower_radius=None, phases=phases))
    value, at = finding(pointed, "rigid_impact") or (0.0, 0.0)
    assert value == pytest.approx(H / BETA)
    assert at in (pytest.approx(0.0), pytest.approx(120.0))
    phases[0]["law"] = "constant_acceleration"
    soft = part_of(cam(phases=phases))
    assert finding(soft, "soft_impact") == (pytest.approx(8 * H / BETA**2), pytest.approx(60.0))
    assert finding(soft, "rigid_impact") is None
    still = part_of(cam(phases=[{"move": "dwell", "angle_deg": 360.0}]))
    assert finding(still, "never_moves") == (0.0, 20.0)


def test_a_pivot_within_the_cam_is_told() -> None:
    """By the profile's greatest distance from the axis: the path's less the roller's radius, where that is level."""
    swing = {"centre_distance": 60.0, "arm_length": 50.0}
    part = part_of(cam(lift=None, swing_deg=30.0, oscillating=swing, bore_diameter=0.0))
    start = math.acos((60.0**2 + 50.0**2 - 48.0**2) / (2 * 60.0 * 50.0))
    end = start + math.radians(30.0)
    far = math.sqrt(60.0**2 + 50.0**2 - 2 * 60 * 50 * math.cos(end)) - 8.0
    assert finding(part, "pivot_within_cam") == (pytest.approx(far - 60.0, abs=2e-3), 60.0)


LEAST: list[tuple[dict[str, Any], float]] = [
    # (48 - 8) of the transmission angle; R + S + S'' = rho of a flat face; the path's convex radius r + rho of a roller
    ({"least_transmission_angle_deg": 45.0, "follower_radius": 2.0}, (RISE[1] - RISE[0]).max() - 2.0),
    ({"least_transmission_angle_deg": 45.0, "follower": "pointed", "follower_radius": None}, (RISE[1] - RISE[0]).max()),
    ({"least_transmission_angle_deg": 45.0, "follower": "flat", "follower_radius": None, "least_curvature_radius": 5.0},
     5.0 - (S + A).min()),
]  # fmt: skip


@pytest.mark.parametrize(("keys", "base"), LEAST)
def test_a_least_cam_is_as_small_as_its_condition_allows(keys: dict[str, Any], base: float) -> None:
    part = part_of(cam(base_circle_radius=None, bore_diameter=0.0, **keys))
    assert part.circles["base_circle_diameter"] == pytest.approx(2 * base, rel=1e-6)


def test_the_least_roller_cam_keeps_its_convex_radius() -> None:
    part = part_of(cam(base_circle_radius=None, least_transmission_angle_deg=30.0, least_curvature_radius=9.0,
                       follower_radius=3.0, bore_diameter=0.0))  # fmt: skip
    assert part.quantities["least_curvature_radius"] == pytest.approx(9.0, rel=1e-6)
    prime = part.circles["prime_circle_diameter"] / 2
    assert least_convex(prime) == pytest.approx(12.0, rel=1e-5)


def steepest(parts: tuple[np.ndarray, ...], s0: float, e: float) -> float:
    """The greatest pressure angle of a sliding follower over samples of its motion, degrees."""
    return float(np.degrees(np.abs(np.arctan((parts[1] - e) / (s0 + parts[0]))).max()))


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("rise", "back", "e"), [(60.0, 50.0, 6.0), (60.0, 15.0, 6.0), (70.0, 65.0, -4.0)])
def test_the_return_may_have_a_transmission_angle_of_its_own(rise: float, back: float, e: float) -> None:
    """The cam is the least of which both hold by dense samples; the finding tells which does not of a smaller one."""
    keys: dict[str, Any] = {"follower_offset": e, "bore_diameter": 0.0, "follower_radius": 2.0,
                            "least_transmission_angle_deg": rise}  # fmt: skip
    both = keys | {"least_return_transmission_angle_deg": back}
    prime = part_of(cam(base_circle_radius=None, **both)).circles["prime_circle_diameter"] / 2
    s0 = math.sqrt(prime**2 - e**2)
    falls = [rise - (90 - steepest(RISE, s0, e)), back - (90 - steepest(FALL, s0, e))]
    assert max(falls) == pytest.approx(0.0, abs=1e-4)
    # half a millimetre below it the one that asked for it falls short, and the cam says which
    small = part_of(cam(base_circle_radius=prime - 2.5, **both))
    s0 = math.sqrt((prime - 0.5) ** 2 - e**2)
    for code, parts, asked in (("", RISE, rise), ("return_", FALL, back)):
        kept = 90 - steepest(parts, s0, e)
        told = finding(small, f"{code}transmission_angle_not_kept")
        assert told == (None if kept >= asked else (pytest.approx(kept, abs=1e-4), asked))
    assert any(f.code.endswith("transmission_angle_not_kept") for f in small.findings)


@pytest.mark.parametrize("back", [0.0, 30.0, pytest.param(50.0, marks=pytest.mark.heavy), None])
def test_a_swinging_roller_keeps_the_angle_of_its_rise_alone_where_it_is_asked_to(back: float | None) -> None:
    """tan nu = (L (1 + psi') - d cos psi) / (d sin psi) over dense samples: the least arm angle at which it holds."""
    arm, distance, rise = 70.0, 95.0, 50.0
    swing = {"centre_distance": distance, "arm_length": arm}
    part = part_of(cam(lift=None, swing_deg=20.0, oscillating=swing, base_circle_radius=None, bore_diameter=0.0,
                       least_transmission_angle_deg=rise, least_return_transmission_angle_deg=back,
                       follower_radius=3.0))  # fmt: skip
    unit = math.radians(20.0) / H
    limits = 90 - rise, 90 - (rise if back is None else back)
    samples = [(s[::40], v[::40]) for s, v, _ in (RISE, FALL)]

    def holds(start: float) -> bool:
        for (s, v), most in zip(samples, limits, strict=True):
            psi = start + unit * s
            steep = np.abs(np.arctan((arm * (1 + unit * v) - distance * np.cos(psi)) / (distance * np.sin(psi))))
            if np.degrees(steep).max() > most:
                return False
        return True

    starts = np.radians(np.arange(1.0, 60.0, 0.01))
    least = next(start for start in starts if holds(start))
    prime = math.sqrt(distance**2 + arm**2 - 2 * distance * arm * math.cos(least))
    assert part.circles["prime_circle_diameter"] / 2 == pytest.approx(prime, abs=0.02)


def test_of_a_swinging_roller_the_steeper_return_is_told() -> None:
    """By the same formula, the arm's least angle by the law of cosines: a return that is steeper than the rise."""
    arm, distance, prime = 70.0, 95.0, 48.0
    part = part_of(cam(lift=None, swing_deg=20.0, oscillating={"centre_distance": distance, "arm_length": arm},
                       base_circle_radius=prime - 3.0, bore_diameter=0.0, least_transmission_angle_deg=85.0,
                       follower_radius=3.0))  # fmt: skip
    unit, steep = math.radians(20.0) / H, []
    for s, v, _ in (RISE, FALL):
        psi = math.acos((distance**2 + arm**2 - prime**2) / (2 * distance * arm)) + unit * s
        tangent = (arm * (1 + unit * v) - distance * np.cos(psi)) / (distance * np.sin(psi))
        steep.append(math.degrees(np.abs(np.arctan(tangent)).max()))
    assert steep[1] > steep[0] + 1.0
    assert finding(part, "transmission_angle_not_kept") == (pytest.approx(90 - steep[1], abs=1e-3), 85.0)


@pytest.mark.heavy
def test_the_angle_of_the_return_is_blamed_where_it_asks_for_too_much() -> None:
    raw = scene_of(cam(lift=None, swing_deg=20.0, oscillating={"arm_length": 70.0}, base_circle_radius=None,
                       bore_diameter=0.0, least_transmission_angle_deg=50.0))  # fmt: skip
    key = "parts.p.least_return_transmission_angle_deg"
    found = refused(with_key(raw, key, 89.9))
    assert found is not None
    assert (found.key, found.code) == (key, "no_axis_keeps_angle")
    assert found.nearest is not None
    assert isinstance(found.nearest.value, float)
    assert refused(with_key(raw, key, found.nearest.value)) is None
    assert refused(with_key(raw, key, found.nearest.value * 1.001)) is not None
    flat = scene_of(cam(follower="flat", follower_radius=None, base_circle_radius=None, least_curvature_radius=5.0))
    check_refused(flat, key, 20.0, "flat_has_no_return_angle", None)


CAM_REFUSED: list[tuple[Raw, str, object, str, object]] = [
    (scene_of(cam(base_circle_radius=None)), "base_circle_radius", GONE, "base_circle_missing", ...),
    (scene_of(cam(follower="flat", follower_radius=None, base_circle_radius=None)), "least_transmission_angle_deg",
     60.0, "flat_angle_is_45", 45.0),
    # before: without effect
    (scenes()["flat"], "least_transmission_angle_deg", 60.0, "needs_other", None),
    (scenes()["flat"], "least_return_transmission_angle_deg", 20.0, "needs_other", None),
    (scenes()["swinging flat"], "least_transmission_angle_deg", 60.0, "needs_other", None),
    (scenes()["swinging roller"], "follower_offset", 3.0, "arm_has_no_offset", 0.0),
    (scenes()["swinging roller"], "oscillating.face_offset", 3.0, "for_flat_only", 0.0),
    (scenes()["swinging roller"], "oscillating.centre_distance", GONE, "distance_missing", ...),
    (scenes()["swinging flat"], "base_circle_radius", GONE, "base_circle_missing_of_arm", ...),
    (with_key(scenes()["swinging roller"], "parts.p.base_circle_radius", GONE), "least_transmission_angle_deg", GONE,
     "", ...),
    (scene_of(cam()), "plate_diameter", 30.0, "for_faces_only", None),
    (scene_of(cam()), "holes", {"count": 4, "diameter": 10.0, "pitch_circle_diameter": 70.1},
     "holes_beyond_base_circle", "at_most"),
]  # fmt: skip


@pytest.mark.parametrize(("raw", "key", "value", "code", "works"), CAM_REFUSED)
def test_keys_that_a_cam_lacks_or_has_too_many_are_told(
    raw: Raw, key: str, value: object, code: str, works: object
) -> None:
    if not code:
        found = refused(raw)
        assert found is not None
        assert (found.key, found.code, found.nearest) == ("parts.p.base_circle_radius", "base_circle_missing", None)
        return
    if key == "holes":
        found = refused(with_key(raw, "parts.p.holes", value))
        assert found is not None
        assert (found.key, found.code, found.value) == ("parts.p.holes.pitch_circle_diameter", code, 70.1)
        assert found.numbers["inside"] == pytest.approx(40.0)
        # the hole's radius inside of the base circle
        assert found.nearest is not None
        assert found.nearest.side == works
        assert found.nearest.value == pytest.approx(70.0, abs=2e-4)
        assert refused(with_key(raw, "parts.p.holes", {**value, "pitch_circle_diameter": 69.9})) is None  # type: ignore[dict-item]
        return
    check_refused(raw, f"parts.p.{key}", value, code, works)


def test_limits_of_a_least_cam() -> None:
    """The roller fills the prime circle of its angle; a bore reaches the base circle of 40."""
    prime = (RISE[1] / math.tan(math.radians(30)) - RISE[0]).max()
    raw = scene_of(cam(base_circle_radius=None, least_transmission_angle_deg=60.0, bore_diameter=0.0))
    found = refused(with_key(raw, "parts.p.follower_radius", 40.0))
    assert found is not None
    assert (found.key, found.code) == ("parts.p.follower_radius", "fills_prime_circle")
    assert found.numbers["prime"] == pytest.approx(prime, rel=1e-7)
    assert found.nearest is not None
    assert found.nearest.side == "at_most"
    assert refused(with_key(raw, "parts.p.follower_radius", found.nearest.value)) is None
    check_limit(scene_of(cam()), "parts.p.bore_diameter", "no_wall_to_base_circle", 80.0, "at_most", near=3e-4)
    offset_limits(cam(bore_diameter=10.0), (5 - 40) / 2, 5.0)


STEM: dict[str, Any] = {"kind": "follower", "end": "roller"}
FLAT = STEM | {"end": "flat", "plate_diameter": 60.0}
CAP = STEM | {"end": "mushroom", "plate_diameter": 48.0, "follower_radius": 30.0}
ARM: dict[str, Any] = {"kind": "follower_arm", "end": "roller", "arm_length": 60.0}
ROLLER: dict[str, Any] = {"kind": "roller", "diameter": 16.0, "bore_diameter": 6.0}

FOLLOWER_LIMITS: list[tuple[dict[str, Any], str, str, float, str, float]] = [
    (STEM, "stem_length", "shorter_than_half_width", 5.0, "at_least", 4e-5),
    (STEM | {"end": "pointed"}, "stem_length", "tip_longer_than_stem", 5 * math.sqrt(3), "at_least", 1e-5),
    (FLAT, "plate_diameter", "below_stem_width", 10.0, "at_least", 1e-5),
    (FLAT, "corner_radius", "plate_has_no_room", 25.0, "at_most", 1e-5),
    (FLAT | {"corner_radius": 4.0}, "stem_length", "plate_takes_stem", 9.0, "at_least", 2e-5),
    (CAP, "plate_diameter", "arc_ends_at_its_diameter", 60.0, "at_most", 1e-5),
    (STEM, "pin_diameter", "hole_reaches_edge", 10.0, "at_most", 2e-5),
    (ARM, "arm_length", "end_within_the_other", 3.0, "at_least", 1e-4),
    (ROLLER, "bore_diameter", "no_wall_in_roller", 16.0, "at_most", 2e-4),
]


@pytest.mark.parametrize(("part", "key", "code", "limit", "side", "near"), FOLLOWER_LIMITS)
def test_a_follower_has_the_sizes_that_its_ends_leave(
    part: dict[str, Any], key: str, code: str, limit: float, side: str, near: float
) -> None:
    check_limit(scene_of(part), f"parts.p.{key}", code, limit, side, near=near)


def test_holes_of_arms_are_told_the_largest_that_their_ends_hold() -> None:
    """As it was: a boss and a round end that a hole fills were told none, since what was offered left no wall."""
    for key, size in (("pivot_diameter", 16.0), ("pin_diameter", 10.0)):
        for value in (size, 1.5 * size):
            found = refused(scene_of(ARM | {key: value}))
            assert found is not None
            assert (found.key, found.code) == (f"parts.p.{key}", "hole_reaches_edge")
            assert found.nearest is not None
            assert 0.99 * size < float(str(found.nearest.value)) < size
            assert refused(scene_of(ARM | {key: found.nearest.value})) is None


@pytest.mark.parametrize(
    ("part", "key", "value", "code", "works"),
    [
        (STEM, "follower_radius", 8.0, "roller_is_a_part", 0.0),
        (FLAT, "follower_radius", 8.0, "for_other_ends", 0.0),
        (FLAT, "pin_diameter", 3.0, "for_other_ends", 0.0),
        (STEM, "plate_diameter", 30.0, "for_other_ends", 0.0),
        (STEM, "corner_radius", 1.0, "for_other_ends", 0.0),
        (ARM, "face_offset", 2.0, "for_other_ends", 0.0),
        # before: without effect
        (STEM, "plate_thickness", 4.0, "for_other_ends", 5.0),
        (FLAT, "tip_angle_deg", 50.0, "for_other_ends", 60.0),
        (ARM, "tip_angle_deg", 50.0, "for_other_ends", 60.0),
        (ARM, "tip_height", 5.0, "for_other_ends", 10.0),
        (CAP, "follower_radius", 0.0, "follower_without_radius", ...),
        (FLAT, "plate_diameter", 0.0, "follower_without_plate", 20.0),
        (FLAT | {"stem_width": 7.0}, "plate_diameter", 0.0, "follower_without_plate", 14.0),
        (CAP, "plate_diameter", 0.0, "follower_without_plate", 20.0),
    ],
)
def test_keys_of_other_ends_are_told(part: dict[str, Any], key: str, value: object, code: str, works: object) -> None:
    check_refused(scene_of(part), f"parts.p.{key}", value, code, works)


def test_an_arm_whose_cap_leaves_no_outline_is_told_a_lower_one() -> None:
    arm = ARM | {"end": "mushroom", "arm_length": 52.0, "width": 50.0, "boss_diameter": 9.0, "follower_radius": 42.0,
                 "pivot_diameter": 0.0}  # fmt: skip
    found = refused(scene_of(arm | {"tip_height": 29.0}))
    assert found is not None
    assert (found.key, found.code, found.value) == ("parts.p.tip_height", "no_whole_outline", 29.0)
    assert found.nearest is not None
    most = float(str(found.nearest.value))
    assert found.nearest.side == "at_most"
    assert refused(scene_of(arm | {"tip_height": most})) is None
    assert refused(scene_of(arm | {"tip_height": most + 2e-3})) is not None


def area(part: dict[str, Any]) -> float:
    whole = part_of(part | {"face_width": 2.0})
    return float(whole.made_by.moments(whole.body(0.0)).volume) / 2


def test_followers_are_as_large_as_their_keys_say() -> None:
    """Stems of 10 x 80 from their reference point: a half circle, a wedge of 60 degrees, a plate of 5, a cap."""
    half, wedge = 12.5 * math.pi, 5 * math.sqrt(3)
    assert area(STEM) == pytest.approx(800 + half)
    assert area(STEM | {"pin_diameter": 3.0}) == pytest.approx(800 + half - 2.25 * math.pi)
    assert area(STEM | {"end": "pointed"}) == pytest.approx(10 * (80 - wedge) + 5 * wedge)
    assert area(FLAT) == pytest.approx(60 * 5 + 10 * 75)
    assert area(FLAT | {"corner_radius": 2.0}) == pytest.approx(60 * 5 + 10 * 75 + 2 * (4 - math.pi))
    # the cap's edge lies 18 below the centre of its arc: a segment of radius 30 over a chord of 48
    cap = 900 * math.asin(0.8) - 24 * 18
    assert area(CAP) == pytest.approx(cap + 48 * 5 + 10 * (80 + 18 - 5))
    # a belt about two circles of 8 and 5 that stand 60 apart
    slope = math.asin(3 / 60)
    belt = 64 * (math.pi / 2 + slope) + 25 * (math.pi / 2 - slope) + 13 * 60 * math.cos(slope)
    assert area(ARM | {"pivot_diameter": 0.0}) == pytest.approx(belt)
    assert area(ARM | {"pin_diameter": 4.0}) == pytest.approx(belt - math.pi * (9 + 4))
    mirrored = [
        part_of(ARM | {"end": "pointed", "sense": sense}).section(0.0).region.outer for sense in ("against", "with")
    ]
    ways = [max(complex(s.curve.point(s.curve.domain[0])).imag for s in outer.segments()) for outer in mirrored]
    assert ways[0] != pytest.approx(ways[1])
    assert part_of(FLAT).thing.reach == (-30.0, 30.0)
    assert part_of(STEM).thing.reach is None
    assert (part_of(CAP).thing.radius, part_of(FLAT).thing.radius) == (30.0, 0.0)


def test_a_roller_has_walls_and_bears_offsets_to_half_of_them() -> None:
    assert part_of(ROLLER).circles == {"roller_diameter": 16.0}
    assert part_of(ROLLER).findings == ()
    assert finding(part_of(ROLLER | {"bore_diameter": 14.01}), "thin_roller_wall") == (pytest.approx(0.995), 1.0)
    assert finding(part_of(ROLLER | {"bore_diameter": 13.99}), "thin_roller_wall") is None
    offset_limits(ROLLER, (3 - 8) / 2, 3.0)
    with pytest.raises(ValueError, match="leaves_no_rim"):
        part_of(ROLLER | {"bore_diameter": 0.0}).section(-8.0)
    assert part_of(ROLLER | {"bore_diameter": 0.0}).section(-7.99).region.outer.reach() == pytest.approx(0.01)


# a wall of 5 mm radius and its play in a barrel of 70, its floor at 27
GROOVE = scenes()["barrel"]
PLAIN = {k: v for k, v in GROOVE["parts"]["p"].items() if k not in ("length", "clearance", "bore_diameter")}
END = scenes()["end barrel"]
ARMED = scenes()["swinging barrel"]
INSIDE = 0.98

BARREL_LIMITS: list[tuple[Raw, str, str, float, str, float]] = [
    (GROOVE, "length", "groove_needs_length", 18 + 10.1 + 0.1, "at_least", 1e-5),
    (with_key(END, "parts.p.hub", GONE), "bore_diameter", "no_wall_to_floor", 2 * (27 - 0.05), "at_most", 1e-5),
    (GROOVE, "bore_diameter", "no_wall_to_floor", 2 * (27 - 0.05), "at_most", 1e-5),
    # the track begins 12 over the lower end
    (END, "web_thickness", "web_reaches_track", 12 - 0.05, "at_most", 1e-5),
    (END, "hub.diameter", "no_wall_around_bore", 8 + 0.1, "at_least", 1e-4),
    (END, "hub.diameter", "hub_beyond_barrel", 70 - 0.1, "at_most", 1e-5),
    (with_key(END, "parts.p.hub", {"diameter": 30.0, "above": 2.0}), "hub.diameter", "hub_beyond_barrel", 54 - 0.1,
     "at_most", 1e-5),
    (with_key(GROOVE, "parts.p.hub", {"diameter": 30.0, "above": 2.0}), "hub.diameter", "hub_beyond_barrel", 70 - 0.1,
     "at_most", 1e-5),
    # an arm stays a degree off the cam's axis
    (ARMED, "oscillating.start_angle_deg", "arm_along_axis", 69.0, "at_most", 1e-6),
    (ARMED, "oscillating.start_angle_deg", "arm_along_axis", -89.0, "at_least", 1e-6),
]  # fmt: skip


@pytest.mark.sampled(3)
@pytest.mark.parametrize(("raw", "key", "code", "limit", "side", "near"), BARREL_LIMITS)
def test_a_barrel_is_as_long_and_as_thick_as_its_groove_needs(
    raw: Raw, key: str, code: str, limit: float, side: str, near: float
) -> None:
    if code == "arm_along_axis":
        beyond = limit + (1e-6 if side == "at_most" else -1e-6)
        found = refused(with_key(raw, f"parts.p.{key}", beyond))
        assert found is not None
        assert (found.key, found.code) == (f"parts.p.{key}", code)
        within = refused(with_key(raw, f"parts.p.{key}", limit - (1e-6 if side == "at_most" else -1e-6)))
        assert within is None or within.code != code
        return
    check_limit(raw, f"parts.p.{key}", code, limit, side, near=near)


@pytest.mark.parametrize(
    ("raw", "key", "value", "code", "works"),
    [
        (GROOVE, "web_thickness", 3.0, "for_end_only", 0.0),
        (GROOVE, "cone_angle_deg", 10.0, "for_conical_only", None),
        (GROOVE, "end_margin", 10.0, "follows_from", None),
        (END, "clearance", 0.1, "end_without_play", 0.0),
        # a bottom half as thick as the tube is long below its track
        (END, "web_thickness", 0.0, "bottom_missing", 6.0),
    ],
)
def test_keys_of_the_other_form_of_a_barrel_are_told(
    raw: Raw, key: str, value: object, code: str, works: object
) -> None:
    check_refused(raw, f"parts.p.{key}", value, code, works)


def test_a_barrel_reports_its_sizes() -> None:
    """At the floor the slope is steepest: tan = S' / x, where the roller's side, 5.05 sin(nu) across, meets it."""
    told = made("barrel").quantities

    def steepest(rate: float) -> float:
        nu = 0.0
        for _ in range(60):
            nu = math.atan(rate / math.sqrt(27**2 - (5.05 * math.sin(nu)) ** 2))
        return math.degrees(nu)

    steep = [steepest(0.9 * float(v)) for v in (RISE[1].max(), -FALL[1].min())]
    # length 60: a groove of 18 and 10.1 in its middle, the roller's lowest place half a width over that
    assert {k: v for k, v in told.items() if k not in ("roller_sliding", "largest_roller_diameter")} == pytest.approx(
        {"outer_diameter": 70.0, "floor_diameter": 54.0, "length": 60.0, "roller_diameter": 10.0, "groove_width": 10.1,
         "lift": 18.0, "start_height": (60 - 28.1) / 2 + 5.05, "pressure_angle_rise_deg": steep[0],
         "pressure_angle_return_deg": steep[1]}, rel=1e-6)  # fmt: skip
    assert finding(made("barrel"), "steep_groove") == (pytest.approx(steep[0], rel=1e-6), 30.0)
    end = made("end barrel").quantities
    # the track from 12 to 24, the roller's axis 5 over it
    assert (end["length"], end["start_height"], end["inner_diameter"]) == pytest.approx((24.0, 17.0, 54.0))
    assert "groove_width" not in end
    usual = part_of(PLAIN | {"lift": 18.0}).quantities
    assert usual["length"] == pytest.approx(18 + 10 + 2 * 5)
    swinging = made("swinging barrel").quantities
    # the arm of 50 swings 10 degrees to either side, and strays as far to the left as to the right
    assert swinging["start_inclination_deg"] == pytest.approx(-10.0)
    assert "plane across the axis" in QUANTITIES["start_inclination_deg"]
    assert "start_angle_deg" not in swinging
    assert swinging["pivot_offset"] == pytest.approx(50 * (1 + math.cos(math.radians(10))) / 2)
    assert swinging["pivot_height"] - swinging["start_height"] == pytest.approx(50 * math.sin(math.radians(10)))
    assert swinging["length"] == pytest.approx(100 * math.sin(math.radians(10)) + 10 + 2 * 5)


def test_a_roller_wider_than_its_barrel_is_told_and_a_floor_too_narrow_for_it() -> None:
    """The roller's edge lies within 0.98 of the floor's radius."""
    raw = scene_of(PLAIN | {"lift": 1.0})
    wide = with_key(raw, "parts.p.roller_diameter", 70.0)
    check_offer(wide, "parts.p.outer_diameter", 70.0, "roller_too_big", 70 / INSIDE + 16, "at_least")
    check = with_key(raw, "parts.p.roller_diameter", 40.0)
    found = refused(with_key(check, "parts.p.groove_depth", 35 - 20 / INSIDE + 1e-4))
    assert found is not None
    assert (found.key, found.code) == ("parts.p.groove_depth", "floor_too_narrow")
    inside = refused(with_key(check, "parts.p.groove_depth", 35 - 20 / INSIDE - 1e-4))
    assert inside is None or inside.code != "floor_too_narrow"


# 20 mm in 60 of travel, a roller of 6, base height 15
WEDGE = scenes()["wedge"]
BARE = with_key(with_key(WEDGE, "parts.p.holes", GONE), "parts.p.corner_radius", 0.0)
DRILLED = with_key(
    BARE, "parts.p.holes", [{"diameter": 4.0, "x": 5.0, "y": 7.0}, {"diameter": 4.0, "x": 11.0, "y": 7.0}]
)


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("raw", "key", "code", "limit", "side"),
    [
        (BARE, "run_in", "no_room_for_corner", 0.05, "at_least"),
        (WEDGE, "run_in", "no_room_for_corner", 2.05, "at_least"),
        (WEDGE, "run_out", "no_room_for_corner", 2.05, "at_least"),
        # half of the plate's height over its lower edge
        (BARE, "corner_radius", "no_room_in_plate", (15 - 0.05) / 2, "at_most"),
        (BARE, "base_height", "no_plate_under_follower", 0.05, "at_least"),
        # from hole to hole, from the lower edge
        (DRILLED, "holes[2].diameter", "hole_reaches_edge", 2 * (6 - 2 - 0.05), "at_most"),
        (DRILLED, "holes[1].diameter", "hole_reaches_edge", 2 * (7 - 0.05), "at_most"),
    ],
)
def test_a_wedge_has_room_for_its_corners_and_holes(raw: Raw, key: str, code: str, limit: float, side: str) -> None:
    if key == "holes[1].diameter":
        raw = with_key(raw, "parts.p.holes", [{"diameter": 4.0, "x": 5.0, "y": 7.0}])
    check_limit(raw, f"parts.p.{key}", code, limit, side, near=2e-4)


def test_a_wedge_reports_what_its_law_says() -> None:
    """Upright the pressure angle is the slope 2 H / b; the crest's radius that of (u, S) less the roller's."""
    told = made("wedge").quantities
    b, slope = 60.0, 2 * 20.0 / 60.0
    assert told["pressure_angle_deg"] == pytest.approx(math.degrees(math.atan(slope)))
    s1, s2 = 20 * (1 - np.cos(2 * np.pi * U)) / b, 2 * np.pi * 20 * np.sin(2 * np.pi * U) / b**2
    crest = ((1 + s1**2) ** 1.5 / np.where(s2 < 0, -s2, np.nan))[s2 < -1e-9]
    assert told["least_curvature_radius"] == pytest.approx(float(np.nanmin(crest)) - 6.0, rel=1e-6)
    assert (told["lift"], told["travel"], told["follower_radius"]) == pytest.approx((20.0, 60.0, 6.0))
    assert finding(made("wedge"), "steep_pressure_angle") == (pytest.approx(math.degrees(math.atan(slope))), 30.0)
    rough = with_key(with_key(BARE, "parts.p.follower", "pointed"), "parts.p.follower_radius", GONE)
    rough = with_key(rough, "parts.p.phases", [{"move": "rise", "travel": 60.0, "law": "constant_velocity"}])
    part = make_parts(scene_from_dict(rough, "s", "s"), "s")[0]["p"]
    value, at = finding(part, "wedge_rigid_impact") or (0.0, 0.0)
    assert value == pytest.approx(20 / 60)
    assert at in (0.0, 60.0)


def test_a_groove_reports_both_ways_and_its_own_sizes() -> None:
    """The rim is half of the groove's width, in whole millimetres of the diameter; 68 + 8 + 0.1 is the outer wall."""
    part = made("groove")
    up, down = (np.degrees(np.abs(np.arctan(v / (48 + s)))).max() for s, v, _ in (RISE, FALL))
    told = part.quantities
    assert (told["groove_width"], told["groove_depth"]) == pytest.approx((16.1, 5.0))
    assert (told["pressure_angle_rise_deg"], told["pressure_angle_return_deg"]) == pytest.approx((up, down), rel=1e-6)
    raw = scenes()["groove"]
    usual = make_parts(scene_from_dict(with_key(raw, "parts.p.outer_diameter", GONE), "s", "s"), "s")[0]["p"]
    assert usual.circles["outer_diameter"] == math.ceil(2 * (76.1 + 8.05))
    check_limit(raw, "parts.p.outer_diameter", "no_rim_beyond_groove", 2 * (76.1 + 0.05), "at_least", near=1e-5)
    chamfered = with_key(raw, "parts.p.face_chamfer", 1.0)
    check_limit(chamfered, "parts.p.outer_diameter", "no_rim_beyond_groove", 2 * (77.1 + 0.05), "at_least", near=1e-5)
    width = raw["parts"]["p"].get("face_width", 10.0)
    check_limit(raw, "parts.p.groove_depth", "groove_goes_through", width - 0.05, "at_most", near=1e-5)
    for clearance, told_play in ((0.0, True), (0.32, False), (0.3201, True)):
        changed = with_key(raw, "parts.p.roller_clearance", clearance)
        play = finding(make_parts(scene_from_dict(changed, "s", "s"), "s")[0]["p"], "roller_play")
        assert play == ((pytest.approx(clearance), pytest.approx(0.32)) if told_play else None)


YOKE: Raw = {"parts": {"c": cam(follower="flat", follower_radius=None, phases=[
    {"move": "rise", "angle_deg": 180.0, "law": "sine"}, {"move": "return_", "angle_deg": 180.0, "law": "sine"}]),
    "y": {"kind": "yoke_frame", "of": "c"}}, "exports": [{"format": "svg"}]}  # fmt: skip
ROLLERS = with_key(with_key(YOKE, "parts.c.follower", "roller"), "parts.c.follower_radius", 8.0)
# the flat cam's farthest place: (40 + S)^2 + S'^2 is greatest where S' = 0
FAR = 60.0


@pytest.mark.parametrize(
    ("raw", "key", "code", "limit", "side"),
    [
        # the window is 2 (60 + 2) wide, bars of 8 beside it, half a millimetre of ledge left on both sides
        (YOKE, "stem_width", "wider_than_frame", 2 * (FAR + 2 + 8) - 1, "at_most"),
        (with_key(YOKE, "parts.y.stem_width", 133.0), "corner_radius", "cuts_into_stem", 3.0, "at_most"),
        (YOKE, "corner_radius", "no_bar_at_corner", 8.0, "at_most"),
        # the plate is as wide as the wider of slot and pin and two walls
        (ROLLERS, "stem_width", "wider_than_frame", 10 + 16 - 1, "at_most"),
        (ROLLERS, "pin_diameter", "pin_fills_roller", 2 * (8 - 0.05), "at_most"),
        # breadth 2 * 48 + 20: half of it less the lift, shaft and pin
        (ROLLERS, "shaft_diameter", "slot_meets_pin", 116 - 20 - 4 - 0.1, "at_most"),
    ],
)
def test_a_frame_leaves_bars_and_walls(raw: Raw, key: str, code: str, limit: float, side: str) -> None:
    check_limit(raw, f"parts.y.{key}", code, limit, side, near=2e-4)


def test_a_frame_reports_its_breadth_and_bears_offsets_to_half_its_bars() -> None:
    """2 R + H of faces, 2 (R + r) + H of roller centres, and the play."""
    for raw, breadth in ((YOKE, 100.0), (ROLLERS, 116.0)):
        part = make_parts(scene_from_dict(with_key(raw, "parts.y.clearance", 0.2), "s", "s"), "s")[0]["y"]
        assert part.quantities["yoke_breadth"] == pytest.approx(breadth + 0.2)
        assert part.quantities["lift"] == pytest.approx(20.0)
        assert part.quantities["yoke_breadth_error"] == pytest.approx(0.0, abs=1e-9)
        part.section(-4 + 1e-6)
        with pytest.raises(ValueError, match="no_bar"):
            part.section(-4.0)
    part.section(2 - 1e-6)
    with pytest.raises(ValueError, match="pin_holes_closed"):
        part.section(2.0)
