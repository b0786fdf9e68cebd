"""The part kind ``cam``: built-in scenes, refusals with a remedy that works, and the follower rolled over the files."""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import Any, get_args

import ezdxf
import numpy as np
import pytest
from msgspec import convert

from exporters.command.cli import main
from exporters.formats.read_svg import read_svg
from geometry.base.errors import Nearest, OffsetError, UndercutError
from geometry.cams.motion.follower_motion import PhaseKind
from geometry.cams.motion.guides import Translating
from geometry.cams.plane.disk import DiskCam
from geometry.cams.plane.synthesis import greatest_pressure_angle
from geometry.laws.named import NAMED_LAWS
from geometry.plane.measure import distance_to_profile
from parts.base.part import Part
from parts.base.refusal import SceneError
from parts.cams.disk_cam.part import CAM, CamSpec
from parts.keys.cam import LawName
from parts.scene.load import load_scene, make_parts, scene_from_toml
from tests.exporters.making import read_report, toml
from tests.geometry.cams.oracle import followed
from tests.parts.nearest import cured, refused

PHASES = [
    {"move": "rise", "angle_deg": 120.0, "law": "sine"},
    {"move": "dwell", "angle_deg": 40.0},
    {"move": "return_", "angle_deg": 130.0, "law": "polynomial_345"},
    {"move": "dwell", "angle_deg": 70.0},
]
STEEP = [PHASES[0] | {"angle_deg": 55.0}, PHASES[1], PHASES[2] | {"angle_deg": 70.0}, PHASES[3] | {"angle_deg": 195.0}]
ROLLER: dict[str, Any] = {"kind": "cam", "follower": "roller", "lift": 20.0, "phases": PHASES, "follower_radius": 8.0,
                          "base_circle_radius": 35.0, "bore_diameter": 12.0}  # fmt: skip
SWING = {"centre_distance": 95.0, "arm_length": 80.0}
CAMS: dict[str, dict[str, Any]] = {
    "roller": ROLLER | {"follower_offset": 5.0},
    "pointed": ROLLER | {"follower": "pointed", "follower_radius": 0.0},
    "mushroom": ROLLER | {"follower": "mushroom", "follower_radius": 70.0},
    "flat": ROLLER | {"follower": "flat", "follower_radius": 0.0, "base_circle_radius": 42.0},
    "oscillating roller": ROLLER | {"lift": 0.0, "swing_deg": 18.0, "oscillating": SWING},
    "oscillating flat": ROLLER | {"lift": 0.0, "swing_deg": 12.0, "follower": "flat", "follower_radius": 0.0,
                                  "oscillating": {"centre_distance": 95.0, "sense": "with", "face_offset": 4.0}},
}  # fmt: skip


def scene_text(keys: dict[str, Any], tail: str = "") -> str:
    def value(x: Any) -> str:
        return (
            f"[{', '.join(value(y) for y in x)}]"
            if isinstance(x, list)
            else toml(x)
            if not isinstance(x, dict)
            else _table(x)
        )

    def _table(x: dict[str, Any]) -> str:
        return "{ " + ", ".join(f"{k} = {value(v)}" for k, v in x.items()) + " }"

    lines = ["[parts.cam]", *(f"{k} = {value(v)}" for k, v in keys.items())]
    return "\n".join([*lines, '[[exports]]\nformat = "dxf"', tail, ""])


@cache
def _made(text: str) -> Part:
    return make_parts(scene_from_toml(text.encode(), "s.toml", "s"), "s.toml")[0]["cam"]


def part_of(keys: dict[str, Any]) -> Part:
    """The cam of keys, made once."""
    return _made(scene_text(keys))


def cam_of(name_or_keys: str | dict[str, Any]) -> DiskCam:
    """The cam of a built-in scene or of keys."""
    if not isinstance(name_or_keys, str):
        cam = part_of(name_or_keys).thing
        assert isinstance(cam, DiskCam)
        return cam
    spec = load_scene(name_or_keys).parts["cam"]
    assert isinstance(spec, CamSpec)
    return CAM.thing(spec, {})


def test_scenes_know_every_named_law() -> None:
    assert get_args(LawName) == tuple(NAMED_LAWS)


def test_the_practicums_cams_have_the_least_sizes() -> None:
    """Lessons 4 and 5: r_0 of the taken laws, recomputed at 40 digits; R_min = r_0 + 10 of the flat one."""
    flat, roller = cam_of("practicum_flat_cam"), cam_of("practicum_roller_cam")
    assert isinstance(flat.mount, Translating)
    assert flat.mount.start_height == pytest.approx(30.26159019146893, rel=1e-12)
    assert flat.motion.lift == pytest.approx(38, rel=1e-14)
    assert abs(complex(roller.reference_point(0.0))) == pytest.approx(25.176679221264166, rel=1e-12)
    assert roller.motion.lift == pytest.approx(30, rel=1e-14)
    assert greatest_pressure_angle(roller, PhaseKind.RISE).value == pytest.approx(math.radians(30), abs=1e-12)
    ends = [math.degrees(p.angle) for p in roller.motion.phases]
    assert ends == pytest.approx([130, 50, 130, 50])


def test_the_guidelines_cam() -> None:
    cam = cam_of("guidelines_cam")
    assert isinstance(cam.mount, Translating)
    assert cam.mount.start_height == pytest.approx(45.81466903731541 + 10, rel=1e-12)
    assert float(cam.motion.value(math.radians(90 * 3 / 8))) == pytest.approx(10.125, rel=1e-12)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", CAMS)
def test_sections_move_outwards_by_the_offset(name: str) -> None:
    part = part_of(CAMS[name])
    plain = part.section(0.0).region
    for offset in (-0.4, 0.4):
        moved = part.section(offset).region
        points = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 33)) for s in moved.outer.segments()])
        assert np.allclose(distance_to_profile(points, plain.outer), 0.4, atol=1e-9)
        assert abs(complex(moved.holes[0].period[0].curve.point(0.0))) == pytest.approx(6 - offset)


def polyline(file: Path) -> np.ndarray:
    """The outer contour of a laser DXF, its arcs finely flattened by ezdxf."""
    space = ezdxf.readfile(file).modelspace()
    outline = next(e for e in space.query("LWPOLYLINE") if e.dxf.layer == "CUT_OUTER")
    path = ezdxf.path.make_path(outline)
    return np.array([complex(p.x, p.y) for p in path.flattening(1e-6)])


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["roller", "flat", "mushroom", "oscillating roller", "oscillating flat"])
def test_the_follower_rolled_over_the_file_lifts_as_it_should(name: str, tmp_path: Path) -> None:
    """|dS| <= tolerance / cos nu; of a swinging follower, over the arm of the contact."""
    scene = tmp_path / "s.toml"
    scene.write_text(scene_text(CAMS[name]), encoding="utf-8")
    assert main(["build", str(scene), "--out", str(tmp_path / "o")]) == 0
    report = read_report(tmp_path / "o" / "s")
    declared = report["files"][0]["max_error"]
    assert declared <= 0.005
    outline = polyline(tmp_path / "o" / "s" / "cam.dxf")
    cam = cam_of(CAMS[name])
    worst = 0.0
    for angle in np.linspace(0, 2 * math.pi, 181):
        if isinstance(cam.mount, Translating):
            start, arm = cam.mount.start_height, math.cos(float(cam.pressure_angle(angle)))
        else:
            start = cam.mount.start_angle
            point = complex(cam.reference_point(angle) if not cam.is_flat else cam.contact(angle))
            arm = abs(point - cam.mount.centre_distance) * math.cos(float(cam.pressure_angle(angle)))
        error = abs(start + float(cam.motion.value(angle)) - followed(cam, outline, float(angle)))
        assert error * arm <= declared * 1.01 + 2e-6
        worst = max(worst, error * arm)
    assert worst >= 0.2 * declared


@pytest.mark.heavy
@pytest.mark.parametrize("name", ["concave", "oscillating roller"])
def test_every_format_is_written_and_read_back(name: str, tmp_path: Path) -> None:
    keys = CAMS.get(name, ROLLER | {"base_circle_radius": 18.0, "lift": 25.0})
    formats = ["svg", "stl", "3mf"]
    tail = (
        "".join(f'[[exports]]\nformat = "{f}"\n' for f in formats)
        + '[[exports]]\nformat = "dxf"\npurpose = "drawing"\n'
    )
    scene = tmp_path / "s.toml"
    scene.write_text(scene_text(keys, tail), encoding="utf-8")
    assert main(["build", str(scene), "--out", str(tmp_path / "o")]) == 0
    files = read_report(tmp_path / "o" / "s")["files"]
    assert {f["format"] for f in files} == {"dxf", "svg", "stl", "3mf"}
    assert all(f["verified"] and f["measured"]["max_deviation"] <= f["max_error"] for f in files)


def test_own_diagrams_and_tables() -> None:
    half = {"shape": "half_sine", "width": 1.0, "peak": 1.0}
    down = {"shape": "half_sine", "width": 1.0, "peak": -1.0}
    law = {"diagram": [half, down]}
    phases = [PHASES[0] | {"law": law}, *PHASES[1:]]
    angle = np.linspace(0, 2 * math.pi, 99)
    assert np.allclose(cam_of(ROLLER | {"phases": phases}).profile_point(angle), cam_of(ROLLER).profile_point(angle))
    every = [
        {"shape": "constant", "width": 1.0, "ordinate": 1.0},
        {"shape": "linear", "width": 1.0, "first": 1.0, "last": 0.5},
        {"shape": "quarter_sine", "width": 1.0, "peak": 2.0},
        {"shape": "quarter_cosine", "width": 1.0, "peak": 2.0},
        {"shape": "half_cosine", "width": 1.0, "first": 1.0, "last": -1.0},
        {"shape": "points", "width": 1.0, "points": [[0.0, -1.0], [0.5, -2.0], [1.0, -1.0]]},
        {"shape": "trapezoid", "width": 5.0, "ordinate": -1.0, "up": 0.2},
    ]
    shared = [PHASES[0] | {"law": {"diagram": every, "balance": True}, "share": 0.5, "angle_deg": 60.0},
              {"move": "rise", "angle_deg": 60.0, "law": "sine", "share": 0.5}, *PHASES[1:]]  # fmt: skip
    cam = cam_of(ROLLER | {"phases": shared, "base_circle_radius": 60.0})
    assert float(cam.motion.value(math.radians(60))) == pytest.approx(10)
    table = [[a, 10 - 10 * math.cos(math.radians(a))] for a in range(0, 360, 10)]
    read = {k: v for k, v in ROLLER.items() if k not in ("phases", "lift")} | {"motion_table": table}
    assert cam_of(read).motion.lift == pytest.approx(20, rel=1e-4)


def highest(rows: list[tuple[float, float]]) -> tuple[float, float]:
    """Where the periodic cubic spline through rows is highest, by its moments and the roots of its slope; degrees."""
    at, s = np.transpose([*rows, (360.0, rows[0][1])])
    h, n = np.diff(at), len(rows)
    system, rise = np.zeros((n, n)), np.diff(s) / h
    for i in range(n):
        system[i, i] = 2 * (h[i - 1] + h[i])
        system[i, i - 1] += h[i - 1]
        system[i, (i + 1) % n] += h[i]
    moments = np.linalg.solve(system, 6 * (rise - np.roll(rise, 1)))
    found = []
    for i in range(n):
        one, two = moments[i], moments[(i + 1) % n]
        cubic = np.poly1d([(two - one) / 6 / h[i], one / 2, rise[i] - h[i] * (2 * one + two) / 6, s[i]])
        found += [(float(cubic(x)), at[i] + x) for x in np.real(cubic.deriv().roots) if 0 <= x <= h[i]]
    return max(found)


@pytest.mark.parametrize("follower", ["roller", "oscillating roller"])
def test_a_table_that_is_left_between_its_rows_is_told(follower: str) -> None:
    """A spline through a dwell goes beyond it: nobody said how far."""
    dwell = [(0.0, 0.0), (90.0, 10.0), (120.0, 10.0), (180.0, 10.0), (270.0, 0.0), (320.0, 0.0)]
    smooth = [(30.0 * k, 5 - 5 * math.cos(math.radians(30 * k))) for k in range(12)]
    own = {k: v for k, v in CAMS[follower].items() if k not in ("phases", "lift", "swing_deg")}
    top, place = highest(dwell)
    # below the lowest row too, and by a 250th of the lift
    below = [(at, 10 - s) for at, s in dwell]
    little = [(14.4 * k, 5 - 5 * math.cos(math.radians(14.4 * k))) for k in range(25)]
    beside = highest(little)[0] - little[12][1]
    for table, wanted in ((dwell, [(top - 10, place)]), (smooth, []), (below, [(top - 10, place)]),
                          (little, [(beside, 180.0)])):  # fmt: skip
        found = [f for f in part_of(own | {"motion_table": [list(row) for row in table]}).findings
                 if f.code in ("lift_overshoots", "swing_overshoots")]  # fmt: skip
        assert [(f.value, f.limit) for f in found] == [pytest.approx(told, rel=1e-6) for told in wanted]


def test_a_chamfered_hub_and_keyway() -> None:
    keys = ROLLER | {"bore_diameter": 0.0, "bore": {"shape": "keyway", "diameter": 16.0}, "face_chamfer": 0.5,
                     "hub": {"diameter": 34.0, "above": 6.0}}  # fmt: skip
    part = part_of(keys)
    assert not part.is_plate
    mesh = part.to_trimesh()
    assert mesh.is_watertight
    assert mesh.bounds[1][2] == pytest.approx(16.0)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("tolerance", [1.0, 0.1, 0.01])
def test_a_cam_without_bore_whose_base_circle_has_few_corners(tolerance: float) -> None:
    """What stands on the lowest circle of a cam is no ring of spaces between teeth."""
    phases = [PHASES[0] | {"angle_deg": 2.0}, PHASES[2] | {"angle_deg": 120.0}, PHASES[3] | {"angle_deg": 238.0}]
    part = part_of(CAMS["flat"] | {"phases": phases, "lift": 0.05, "base_circle_radius": 900.0, "bore_diameter": 0.0})
    for offset in (0.0, -400.0):
        mesh = part.to_trimesh(tolerance, offset)
        assert mesh.is_watertight
        assert mesh.volume > 0


def test_notes_on_impacts_rollers_and_pressure() -> None:
    jerky = [p | ({"law": "constant_velocity"} if p["move"] == "rise" else {}) for p in PHASES]
    codes = {
        f.code for f in part_of(ROLLER | {"follower": "pointed", "follower_radius": 0.0, "phases": jerky}).findings
    }
    assert "rigid_impact" in codes
    codes = {f.code for f in part_of(ROLLER | {"base_circle_radius": 12.0, "bore_diameter": 0.0}).findings}
    assert "steep_pressure_angle" in codes
    assert part_of(ROLLER).findings == ()


@pytest.mark.parametrize("kind", ["disk", "groove", "barrel", "wedge"])
def test_jumps_of_a_swinging_follower_are_told_in_the_degrees_of_its_swing(kind: str) -> None:
    """Simple harmonic motion of psi over phi: S'' = psi / 2 (pi / phi)^2 at its ends, S' = 0."""
    swing, angle = 12.0, 120.0
    moves = [("rise", angle, "cosine"), ("dwell", 60.0, ""), ("return_", 130.0, "sine"), ("dwell", 50.0, "")]
    way = "travel" if kind == "wedge" else "angle_deg"
    phases = [{"move": move, way: size} | ({"law": law} if law else {}) for move, size, law in moves]
    common: dict[str, Any] = {"swing_deg": swing, "phases": phases}
    arm = {"centre_distance": 90.0, "arm_length": 80.0}
    keys: dict[str, Any] = {
        "disk": {"kind": "cam", "follower": "roller", "follower_radius": 8.0, "base_circle_radius": 30.0,
                 "oscillating": arm},
        "groove": {"kind": "groove_cam", "follower_radius": 8.0, "base_circle_radius": 30.0, "groove_depth": 5.0,
                   "oscillating": arm, "roller_clearance": 0.1},
        "barrel": {"kind": "barrel_cam", "form": "groove", "outer_diameter": 90.0, "roller_diameter": 10.0,
                   "groove_depth": 8.0, "oscillating": {"arm_length": 80.0}},
        "wedge": {"kind": "wedge_cam", "follower": "roller", "follower_radius": 5.0, "base_height": 20.0,
                  "oscillating": {"arm_length": 80.0, "pivot_height": 20.0}},
    }[kind]  # fmt: skip
    per = angle if kind == "wedge" else math.radians(angle)
    code = "wedge_swung_soft_impact" if kind == "wedge" else "swung_soft_impact"
    (found,) = (f for f in part_of(keys | common).findings if "impact" in f.code)
    assert found.code == code
    assert found.value == pytest.approx(swing / 2 * (math.pi / per) ** 2, rel=1e-9)


def without(key: str) -> dict[str, Any]:
    return {k: v for k, v in ROLLER.items() if k != key}


def without_base(name: str) -> dict[str, Any]:
    return {k: v for k, v in CAMS[name].items() if k != "base_circle_radius"}


BARE, AT_50 = without_base("oscillating roller"), {"least_transmission_angle_deg": 50.0}
LEVEL = {"shape": "constant", "width": 1.0, "ordinate": 1.0}
# keys, the key that is blamed, why
WRONG: dict[str, tuple[dict[str, Any], str, str]] = {
    "no motion": (without("phases"), "phases", "phases_or_table"),
    "tolerance without a table": (ROLLER | {"table_tolerance": 0.01}, "table_tolerance", "tolerance_without_table"),
    "tolerance of half the lift": (
        {k: v for k, v in ROLLER.items() if k not in ("phases", "lift")}
        | {"motion_table": [[0.0, 0.0], [120.0, 20.0], [200.0, 12.0], [300.0, 1.0]], "table_tolerance": 10.0},
        "table_tolerance", "rest_within_tolerance"),
    "both motions": (ROLLER | {"lift": 0.0, "motion_table": [[0.0, 0.0], [120.0, 20.0], [200.0, 12.0]]}, "phases",
                     "phases_or_table"),
    "no lift": (ROLLER | {"lift": 0.0}, "lift", "no_lift"),
    "no law": (ROLLER | {"phases": [{"move": "rise", "angle_deg": 120.0}, *PHASES[1:]]}, "phases[1].law",
               "law_missing"),
    "dwell with a law": (ROLLER | {"phases": [*PHASES[:3], PHASES[3] | {"law": "sine"}]}, "phases[4].law",
                         "dwell_with_law"),
    "dwell with a share": (ROLLER | {"phases": [*PHASES[:3], PHASES[3] | {"share": 0.5}]}, "phases[4].share",
                           "dwell_with_law"),
    "phases of 290 degrees": (ROLLER | {"phases": PHASES[:3]}, "phases[3].angle_deg", "phases_not_a_turn"),
    "short phase": (ROLLER | {"phases": [PHASES[0] | {"angle_deg": 12.0}, *PHASES[1:]]}, "phases[1].angle_deg",
                    "phases_not_a_turn"),
    "long phase": (ROLLER | {"phases": [PHASES[0] | {"angle_deg": 300.0}, *PHASES[1:]]}, "phases[1].angle_deg",
                   "phases_not_a_turn"),
    "half way back": (ROLLER | {"phases": [*PHASES[:2], PHASES[2] | {"share": 0.5}, PHASES[3]]}, "phases[3].share",
                      "does_not_come_back"),
    "never back": (ROLLER | {"phases": [*PHASES[:3], PHASES[0] | {"angle_deg": 70.0}]}, "phases[2].move",
                   "does_not_come_back"),
    "open diagram": (ROLLER | {"phases": [PHASES[0] | {"law": {"diagram": [LEVEL]}}, *PHASES[1:]]},
                     "phases[1].law.diagram", "diagram_on_one_side"),
    "no roller": (ROLLER | {"follower_radius": 0.0}, "follower_radius", "follower_without_radius"),
    "radius of a flat": (ROLLER | {"follower": "flat"}, "follower_radius", "follower_has_no_radius"),
    "no base circle": (without("base_circle_radius"), "base_circle_radius", "base_circle_missing"),
    "flat at 60": (without("base_circle_radius") | {"follower": "flat", "follower_radius": 0.0,
                                                    "least_transmission_angle_deg": 60.0},
                   "least_transmission_angle_deg", "flat_angle_is_45"),
    "large roller": (without("base_circle_radius") | {"follower_radius": 80.0, "least_transmission_angle_deg": 60.0},
                     "follower_radius", "fills_prime_circle"),
    "offset beyond": (ROLLER | {"follower_offset": 50.0}, "follower_offset", "offset_beyond_prime_circle"),
    "offset to the other side": (ROLLER | {"follower_offset": -50.0}, "follower_offset", "offset_beyond_prime_circle"),
    "bore beyond": (ROLLER | {"bore_diameter": 70.5}, "bore_diameter", "no_wall_to_base_circle"),
    "holes beyond": (ROLLER | {"holes": {"count": 4, "diameter": 10.0, "pitch_circle_diameter": 64.0}},
                     "holes.pitch_circle_diameter", "holes_beyond_base_circle"),
    "small plate": (CAMS["flat"] | {"follower_offset": 4.0, "plate_diameter": 30.0}, "plate_diameter",
                    "contact_over_edge"),
    "plate of a roller": (ROLLER | {"plate_diameter": 30.0}, "plate_diameter", "for_faces_only"),
    "two bores": (ROLLER | {"bore": {"shape": "round", "diameter": 9.0}}, "bore_diameter", "either_key"),
    "lift of a rocker": (CAMS["oscillating roller"] | {"lift": 3.0}, "lift", "stroke_of_another"),
    "swing of a stem": (ROLLER | {"swing_deg": 3.0}, "swing_deg", "swing_without_arm"),
    "offset of a rocker": (CAMS["oscillating roller"] | {"follower_offset": 3.0}, "follower_offset",
                           "arm_has_no_offset"),
    "short arm": (CAMS["oscillating roller"] | {"oscillating": SWING | {"arm_length": 30.0}},
                  "base_circle_radius", "arm_does_not_reach"),
    "rocker without base": (BARE, "base_circle_radius", "base_circle_missing"),
    "flat rocker without base": (without_base("oscillating flat"), "base_circle_radius", "base_circle_missing_of_arm"),
    "rocker without pivot": (CAMS["oscillating roller"] | {"oscillating": {"arm_length": 80.0}},
                             "oscillating.centre_distance", "distance_missing"),
    "rocker without arm": (BARE | AT_50 | {"oscillating": {}}, "oscillating.arm_length", "arm_missing"),
    "roller beyond reach": (CAMS["oscillating roller"] | {"follower_radius": 1000.0}, "follower_radius",
                            "arm_does_not_reach"),
    "pivot too near": (BARE | AT_50 | {"oscillating": {"centre_distance": 62.0, "arm_length": 80.0}},
                       "oscillating.centre_distance", "pivot_keeps_no_angle"),
    "angle that no axis keeps": (BARE | {"oscillating": {"arm_length": 80.0}, "least_transmission_angle_deg": 88.0},
                                 "least_transmission_angle_deg", "no_axis_keeps_angle"),
    "angle that no axis keeps at its distance": (
        BARE | {"oscillating": SWING, "least_transmission_angle_deg": 88.0},
        "least_transmission_angle_deg", "no_axis_keeps_angle"),
    "roller of a small rocker": (BARE | AT_50 | {"follower_radius": 70.0}, "follower_radius", "fills_prime_circle"),
    "face behind the pivot": (
        CAMS["oscillating flat"] | {"oscillating": {"centre_distance": 95.0, "sense": "with", "face_offset": -90.0}},
        "base_circle_radius", "swings_beyond_centres"),
    "wild swing": (CAMS["oscillating roller"] | {"swing_deg": 170.0}, "swing_deg", "swings_beyond_centres"),
    "fast flat rocker": (CAMS["oscillating flat"] | {"swing_deg": 75.0}, "swing_deg", "flat_outruns_cam"),
    "impact": (ROLLER | {"phases": [PHASES[0] | {"law": "constant_velocity"}, *PHASES[1:]]}, "phases[1].law",
               "undercut_by_impact"),
    "small flat": (CAMS["flat"] | {"base_circle_radius": 9.0, "bore_diameter": 0.0, "lift": 30.0},
                   "base_circle_radius", "undercut"),
    "small roller cam": (ROLLER | {"base_circle_radius": 9.0, "bore_diameter": 0.0, "follower_radius": 25.0,
                                   "phases": STEEP}, "base_circle_radius", "undercut"),
    "small flat rocker": (CAMS["oscillating flat"] | {"base_circle_radius": 12.0, "bore_diameter": 0.0,
                                                      "swing_deg": 20.0}, "base_circle_radius", "undercut_swing"),
}  # fmt: skip
# no one value of the blamed key is enough, or it is the user's to choose
NOT_CURED = {"no motion", "no lift", "never back", "open diagram", "no roller", "no base circle",
             "rocker without base", "flat rocker without base", "rocker without pivot",
             "rocker without arm"}  # fmt: skip


# each takes as long as all others together, or half as long
SLOW = {"angle that no axis keeps", "roller of a small rocker", "small flat rocker", "pivot too near",
        "fast flat rocker", "small roller cam", "large roller"}  # fmt: skip


@pytest.mark.parametrize("name", [pytest.param(n, marks=pytest.mark.heavy) if n in SLOW else n for n in WRONG])
def test_wrong_keys_are_refused_in_the_users_terms(name: str) -> None:
    keys, blamed, code = WRONG[name]
    refusal = refused({"cam": keys})
    assert (refusal.key, refusal.code) == (f"parts.cam.{blamed}", code)
    assert (refusal.nearest is None) == (name in NOT_CURED)
    if name not in NOT_CURED:
        cured({"cam": keys}, refusal)


def test_a_face_on_the_far_side_of_its_pivot_is_offered_a_base_circle_beyond_the_pivot() -> None:
    """Whole from where rho = h + h'' of the support h = d sin(psi) - f over the normal's angle is 0 on the return."""
    phases = [
        {"move": "rise", "angle_deg": 88.88, "law": "polynomial_345"}, {"move": "dwell", "angle_deg": 98.0},
        {"move": "return_", "angle_deg": 56.39, "law": "polynomial_4567"}, {"move": "dwell", "angle_deg": 116.73},
    ]  # fmt: skip
    swing = {"centre_distance": 82.516, "sense": "against", "face_offset": -7.777}
    keys = {"kind": "cam", "phases": phases, "follower": "flat", "swing_deg": 9.97, "oscillating": swing}
    refusal = refused({"cam": keys | {"base_circle_radius": 35.799}})
    cured({"cam": keys | {"base_circle_radius": 35.799}}, refusal)
    assert refusal.nearest is not None
    law, swung, turn = np.polynomial.Polynomial([0, 0, 0, 0, 35, -84, 70, -20]), math.radians(9.97), math.radians(56.39)
    u = np.linspace(0, 1, 20_001)
    fall, speed, pull = (swung / turn**k * (1.0 - law(u) if k == 0 else -law.deriv(k)(u)) for k in range(3))
    psi = math.asin((float(str(refusal.nearest.value)) - 7.777) / 82.516) + fall
    factor = (1 + 2 * speed) / (1 + speed) ** 2
    rho = 82.516 * (factor * np.sin(psi) + pull / (1 + speed) ** 3 * np.cos(psi)) + 7.777
    assert rho.min() == pytest.approx(0.0, abs=5e-3)


def test_a_heart_cam_is_told_why_nothing_of_one_key_gives_it_a_roller() -> None:
    """Its path has a corner at the top: by the law of either half alone, any base circle and any roller."""
    halves = [{"move": move, "angle_deg": 180.0, "law": "constant_velocity"} for move in ("rise", "return_")]
    heart = ROLLER | {"phases": halves}
    refusal = refused({"cam": heart})
    assert (refusal.key, refusal.code, refusal.nearest) == ("parts.cam.phases[1].law", "undercut_by_impacts", None)
    sizes = [{"base_circle_radius": base} for base in (60.0, 1000.0)] + [{"follower_radius": 1e-3}]
    laws = [[halves[0] | {"law": "sine"}, halves[1]], [halves[0], halves[1] | {"law": "sine"}]]
    for other in [*sizes, *({"phases": phases} for phases in laws)]:
        assert refused({"cam": heart | other}).code.startswith("undercut_by_impact")
    made = part_of(heart | {"follower": "pointed", "follower_radius": 0.0})
    # the spiral of Archimedes on both sides
    angles = np.linspace(0.0, math.pi, 50)
    points = np.concatenate([made.thing.profile_point(angles), made.thing.profile_point(2 * math.pi - angles)])
    assert np.abs(points) == pytest.approx(np.tile(35.0 + 20.0 * angles / math.pi, 2), abs=1e-12)


def test_of_several_laws_that_move_at_their_ends_the_one_that_cures_is_named() -> None:
    """The rise goes on into the next phase, and the motion rises at 0: only the return drops away."""
    phases = [
        {"move": "rise", "angle_deg": 60.0, "law": "constant_velocity", "share": 0.4},
        {"move": "rise", "angle_deg": 100.0, "law": "join", "share": 0.6},
        {"move": "dwell", "angle_deg": 20.0},
        {"move": "return_", "angle_deg": 180.0, "law": "constant_velocity"},
    ]
    keys = ROLLER | {"phases": phases}
    refusal = refused({"cam": keys})
    assert (refusal.key, refusal.code) == ("parts.cam.phases[4].law", "undercut_by_impact")
    cured({"cam": keys}, refusal)


def test_a_law_at_rest_is_offered_only_where_the_cam_is_whole_with_it() -> None:
    phases = [STEEP[0] | {"law": "constant_velocity"}, *STEEP[1:]]
    for base, works in ((60.0, True), (9.0, False)):
        keys = ROLLER | {"phases": phases, "base_circle_radius": base, "bore_diameter": 0.0, "follower_radius": 25.0}
        with pytest.raises(UndercutError) as refusal:
            CAM.thing(convert(keys, CamSpec), {})
        assert refusal.value.code == "undercut_by_impact"
        assert refusal.value.nearest == (Nearest("sine") if works else None)
        try:
            CAM.thing(convert(keys | {"phases": STEEP}, CamSpec), {})
        except UndercutError:
            assert not works
        else:
            assert works


# loops at the jump of S'' of 1e-3, 2e-9 and 2e-10 rad, the last ones smaller than a sweep sees
@pytest.mark.parametrize(
    ("base", "code"),
    [
        pytest.param(90.0, "undercut_swing", marks=pytest.mark.heavy),
        (109.7, "undercut_swing"),
        (109.7801, "profile_folds"),
    ],
)
def test_a_face_that_swings_is_offered_the_base_circle_from_which_on_the_profile_never_turns_back(
    base: float, code: str
) -> None:
    phases = [
        {"move": "rise", "angle_deg": 120.0, "law": "modified_trapezoid"},
        {"move": "dwell", "angle_deg": 40.0},
        {"move": "return_", "angle_deg": 80.0, "law": "constant_acceleration"},
        {"move": "dwell", "angle_deg": 120.0},
    ]
    swing = {"centre_distance": 120.0, "sense": "against", "face_offset": 0.0}
    keys = {"kind": "cam", "phases": phases, "follower": "flat", "swing_deg": 15.0, "oscillating": swing}
    refusal = refused({"cam": keys | {"base_circle_radius": base}})
    assert (refusal.key, refusal.code) == ("parts.cam.base_circle_radius", code)
    cured({"cam": keys | {"base_circle_radius": base}}, refusal)
    # support h = a sin psi over the normal's angle phi + psi: rho = h + h'' is 0 just before the middle of the return
    speed, pull = -2 * math.radians(15.0) / math.radians(80.0), -4 * math.radians(15.0) / math.radians(80.0) ** 2
    psi = math.radians(7.5) + math.asin(refusal.nearest.value / 120.0)  # type: ignore[union-attr, operator]
    sine, cosine, turn = 120.0 * math.sin(psi), 120.0 * math.cos(psi), 1 + speed
    rho = sine + ((cosine * pull - sine * speed**2) / turn - cosine * speed * pull / turn**2) / turn
    assert rho == pytest.approx(0.0, abs=5e-3)


def test_the_plate_is_as_large_as_the_contact_runs() -> None:
    """Contact at S' beside the axis, the stem at e: the named diameter is the least one."""
    keys = CAMS["flat"] | {"follower_offset": 4.0}
    cam = cam_of(keys)
    reach = cam.motion.value(np.linspace(0, 2 * math.pi, 7201), 1) - 4.0
    least = cam.least_plate_diameter()
    assert least == pytest.approx(2 * float(np.abs(reach).max()), rel=1e-6)
    part_of(keys | {"plate_diameter": least * 1.0001})
    with pytest.raises(SceneError):
        part_of(keys | {"plate_diameter": least * 0.9999})


LEAST = {"lift": 4.5, "least_transmission_angle_deg": 45.0}


@pytest.mark.parametrize(("laws", "angles", "sizes", "tail"), [
    pytest.param(("modified_trapezoid", "modified_trapezoid"), (63.0, 51.0), LEAST, '[[exports]]\nformat = "step"',
                 marks=pytest.mark.heavy),
    # between a joint of the law and the least radius of curvature lie 4e-6 mm and 1.5e-9 mm of the profile
    pytest.param(("modified_sine_cv33", "modified_trapezoid"), (85.0, 53.0), LEAST, "", marks=pytest.mark.heavy),
    (("modified_sine", "modified_sine_cv50"), (122.0, 35.0), {"lift": 1.0, "base_circle_radius": 20.48}, ""),
])  # fmt: skip
def test_the_least_cam_of_a_flat_follower_has_files_though_its_profile_all_but_stands_still(
    laws: tuple[str, str], angles: tuple[float, float], sizes: dict[str, float], tail: str, tmp_path: Path
) -> None:
    """Where pull is even the radius of curvature is 0 at a joint of the law, but for rounding."""
    phases = [
        {"move": "rise", "angle_deg": angles[0], "law": laws[0]},
        {"move": "return_", "angle_deg": angles[1], "law": laws[1]},
        {"move": "dwell", "angle_deg": 360.0 - sum(angles)},
    ]
    keys = {"kind": "cam", "phases": phases, "follower": "flat"} | sizes
    scene = tmp_path / "least.toml"
    scene.write_text(scene_text(keys, f'purpose = "drawing"\n{tail}'), encoding="utf-8")
    assert main(["build", str(scene), "--out", str(tmp_path), "--quiet"]) == 0
    files = read_report(tmp_path / "least")["files"]
    assert [file["tolerance"] for file in files] == [1e-6] * (2 if tail else 1)
    # a face over an outline is off by no more than the outline
    assert all(file["measured"][k] <= 1e-6 for file in files for k in ("max_deviation", "lift_error"))


def test_a_mushroom_is_held_beside_a_cusp_whose_end_leg_is_as_short_as_digits(tmp_path: Path) -> None:
    """The digits of a STEP file turn that leg: the follower fell through by 6 mm."""
    phases = [
        {"move": "rise", "angle_deg": 84.0, "law": "modified_sine_cv20"},
        {"move": "return_", "angle_deg": 134.0, "law": "triangle"},
        {"move": "dwell", "angle_deg": 142.0},
    ]
    keys = {"kind": "cam", "phases": phases, "follower": "mushroom", "lift": 2.13, "follower_radius": 3.6710253}
    scene = tmp_path / "mushroom.toml"
    text = scene_text(keys | {"least_transmission_angle_deg": 63.0})
    scene.write_text(text.replace('"dxf"', '"step"'), encoding="utf-8")
    assert main(["build", str(scene), "--out", str(tmp_path), "--quiet"]) == 0
    (file,) = read_report(tmp_path / "mushroom")["files"]
    assert file["measured"]["lift_error"] <= 2e-6


def test_the_least_cam_of_a_flat_face_has_chamfers(tmp_path: Path) -> None:
    """Below its cusp they meet in an edge: 4e-8 mm was offered, of a tooth outline."""
    phases = [
        {"move": "rise", "angle_deg": 84.0, "law": "cosine"},
        {"move": "return_", "angle_deg": 134.0, "law": "cosine"},
        {"move": "dwell", "angle_deg": 142.0},
    ]
    keys = {"kind": "cam", "phases": phases, "follower": "flat", "lift": 30.0, "least_transmission_angle_deg": 45.0}
    scene = tmp_path / "least.toml"
    text = scene_text(keys | {"face_width": 12.0, "face_chamfer": 0.3, "bore_diameter": 6.0})
    scene.write_text(text.replace('"dxf"', '"stl"\ntolerance = 0.05'), encoding="utf-8")
    assert main(["build", str(scene), "--out", str(tmp_path), "--quiet"]) == 0


def test_a_follower_near_the_end_of_its_reach_is_held_at_the_joints_of_splines(tmp_path: Path) -> None:
    """The conjugate's roller, 0.0001 mm from where its arm ends: no outline was found where the rise ends."""
    phases = [
        {"move": "rise", "angle_deg": 116.0, "law": "cosine"},
        {"move": "return_", "angle_deg": 138.0, "law": "polynomial_345"},
        {"move": "dwell", "angle_deg": 106.0},
    ]
    oscillating = {"centre_distance": 70.0, "sense": "with", "arm_length": 53.3}
    cam = {"kind": "cam", "follower": "roller", "phases": phases, "oscillating": oscillating}
    keys = cam | {"swing_deg": 25.0, "follower_radius": 3.9, "base_circle_radius": 12.8001}
    text = scene_text(keys, 'purpose = "drawing"\nparts = ["other"]\n[parts.other]\nkind = "conjugate_cam"\nof = "cam"')
    assert _built(tmp_path, text) == ["other.dxf"]


def test_a_pointed_rocker_near_the_end_of_its_reach_has_a_drawing_and_a_step_file(tmp_path: Path) -> None:
    """Between two splines digits are 5e-5 of the way to the next angle; the wall was measured 3.7e-6 mm^2 short."""
    phases = [
        {"move": "rise", "angle_deg": 43.0, "law": "constant_acceleration"},
        {"move": "return_", "angle_deg": 132.0, "law": "modified_sine_cv20"},
        {"move": "dwell", "angle_deg": 185.0},
    ]
    oscillating = {"centre_distance": 99.0, "sense": "against", "arm_length": 92.4}
    cam = {"kind": "cam", "follower": "pointed", "phases": phases, "oscillating": oscillating}
    keys = cam | {"swing_deg": 16.0, "base_circle_radius": 6.6001066001}
    text = scene_text(keys, 'purpose = "drawing"\n[[exports]]\nformat = "step"')
    assert _built(tmp_path, text) == ["cam.dxf", "cam.step"]


def test_an_arc_of_a_svg_whose_radius_has_no_digits_is_a_line(tmp_path: Path) -> None:
    """Its crown is 5.5e-9 mm: an arc of radius 0 was written, and its reading ended in a traceback."""
    phases = [
        {"move": "rise", "angle_deg": 64.0, "law": "modified_sine"},
        {"move": "dwell", "angle_deg": 10.0},
        {"move": "return_", "angle_deg": 25.0, "law": "modified_sine"},
        {"move": "dwell", "angle_deg": 261.0},
    ]
    keys = {"kind": "cam", "phases": phases, "follower": "pointed", "lift": 12.22, "base_circle_radius": 4.73}
    assert _built(tmp_path, scene_text(keys).replace('"dxf"', '"svg"')) == ["cam.svg"]
    text = (tmp_path / "s" / "cam.svg").read_text(encoding="ascii")
    assert "A0," not in text
    # and of others it is read as one
    (tmp_path / "other.svg").write_text(text.replace(" L", " A0,0 0 0 1 "), encoding="ascii")
    (one,), (other,) = (read_svg(file).loops for file in (tmp_path / "s" / "cam.svg", tmp_path / "other.svg"))
    assert np.any(one.bulges == 0)
    np.testing.assert_array_equal(one.bulges, other.bulges)


def _built(folder: Path, text: str) -> list[str]:
    """The files of a scene whose build must end well."""
    (folder / "s.toml").write_text(text, encoding="utf-8")
    assert main(["build", str(folder / "s.toml"), "--out", str(folder), "--quiet"]) == 0
    return [file["path"] for file in read_report(folder / "s")["files"]]


def test_the_drawing_of_a_heart_cam_encloses_what_archimedes_says(tmp_path: Path) -> None:
    """Two spirals: pi (r^2 + r h + h^2 / 3); each is one spline of half a turn."""
    halves = [{"move": move, "angle_deg": 180.0, "law": "constant_velocity"} for move in ("rise", "return_")]
    keys = {"kind": "cam", "phases": halves, "follower": "pointed", "lift": 20.0, "base_circle_radius": 40.0}
    scene = tmp_path / "heart.toml"
    scene.write_text(scene_text(keys, 'purpose = "drawing"'), encoding="utf-8")
    assert main(["build", str(scene), "--out", str(tmp_path), "--quiet"]) == 0
    splines = ezdxf.readfile(tmp_path / "heart" / "cam.dxf").modelspace().query("SPLINE")
    points = np.concatenate([list(s.construction_tool().approximate(2000))[:-1] for s in splines])[:, :2]
    x, y = points.T
    area = abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2
    assert area == pytest.approx(math.pi * (40.0**2 + 40.0 * 20.0 + 20.0**2 / 3), rel=1e-6)


def test_a_cam_does_not_mate_as_a_gear() -> None:
    tail = '[parts.gear]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 20\n' \
           '[[mates]]\nkind = "external_gear_pair"\nfirst = "gear"\nsecond = "cam"\n'  # fmt: skip
    with pytest.raises(SceneError, match="is a cam"):
        make_parts(scene_from_toml(scene_text(ROLLER, tail).encode(), "s.toml", "s"), "s.toml")


def test_a_closing_offset_names_one_that_works() -> None:
    for keys, most in ((ROLLER, -14.5), (ROLLER | {"bore_diameter": 0.0}, -35.0)):
        part = part_of(keys)
        with pytest.raises(OffsetError) as caught:
            part.section(-36.0)
        assert caught.value.nearest_offset >= most
        part.section(caught.value.nearest_offset)


def test_gear_scenes_load_no_cams(tmp_path: Path) -> None:
    import subprocess
    import sys

    code = (
        "import sys; from parts.scene.load import load_scene, make_parts; make_parts(load_scene('print_gear'), 'x'); "
        "assert not [m for m in sys.modules if m.startswith(('geometry.cams', 'geometry.laws'))]"
    )
    subprocess.run([sys.executable, "-c", code], check=True, cwd=Path(__file__).parents[4])


def test_one_chamfer_of_both_faces_is_told_as_one() -> None:
    # before: face_chamfer.below, and no remedy
    keys = {"cam": ROLLER | {"face_width": 8.0, "face_chamfer": 6.0}}
    refusal = refused(keys)
    assert (refusal.key, refusal.code) == ("parts.cam.face_chamfer", "chamfers_meet")
    assert cured(keys, refusal)["cam"]["face_chamfer"] == pytest.approx(4.0, abs=1e-3)


def test_a_pointed_cam_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Before: built, and no file of it had an outline for the follower; 0.001 mm of a land is enough."""
    for chamfer, code in ((4.0, 2), (3.9995, 0)):
        keys = ROLLER | {"face_width": 8.0, "face_chamfer": chamfer}
        (tmp_path / "s.toml").write_text(scene_text(keys) + '\n[[exports]]\nformat = "step"\n')
        assert main(["build", str(tmp_path / "s.toml"), "--out", str(tmp_path / "out")]) == code
    assert "face_chamfer = 4.0: meets the other chamfer" in capsys.readouterr().err
