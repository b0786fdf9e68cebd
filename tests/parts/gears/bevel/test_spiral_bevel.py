"""Bevel gears that are not straight, through scenes, files and pages: by meshes, by free bodies, by books."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

import manifold3d
import msgspec
import numpy as np
import pytest

from exporters.command.cli import main
from exporters.documents.topics import calculate
from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.gears.bevel.faces import faced_bevel
from parts.base.refusal import SceneError
from parts.gears.bevel_gear.part import BEVEL_GEAR, BevelGearSpec
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import place
from parts.solids.mesh import body_mesh, mesh_outlines
from tests.exporters.making import write_scene

PINION: dict[str, Any] = {
    "kind": "bevel_gear", "module": 2.0, "number_of_teeth": 13, "mate_number_of_teeth": 20,
     "profile_shift_coefficient": 0.2,
    "addendum_coefficient": 0.9, "spiral_angle_deg": 30.0, "hand": "left", "bore_diameter": 4.0,
}  # fmt: skip
WHEEL = PINION | {"number_of_teeth": 20, "mate_number_of_teeth": 13, "profile_shift_coefficient": -0.2, "hand": "right"}
KINDS: dict[str, dict[str, Any]] = {
    "spiral": {}, "zerol": {"spiral_angle_deg": 0.0, "cutter_radius": 15.0}, "skew": {"tooth_line": "straight"},
}  # fmt: skip


def scene(pinion: dict[str, Any], wheel: dict[str, Any], **mate: Any) -> dict[str, Any]:
    """A pair, the wheel first, which lies askew."""
    return {
        "parts": {"pinion": PINION | pinion, "wheel": WHEEL | wheel},
        "instances": {
            "wheel": {"part": "wheel", "rotation_deg": 13.0, "at": [1.0, 2.0, 3.0], "axis": [0.3, -0.4, 0.86]}
        },
        "mates": [{"kind": "bevel_pair", "first": "wheel", "second": "pinion", "direction_deg": 40.0, **mate}],
    }


@pytest.mark.sampled(1)
@pytest.mark.parametrize("kind", KINDS)
def test_meshes_of_both_keep_half_of_the_backlash_all_over_a_pitch(kind: str) -> None:
    """By meshes alone, turned step by step in their ratio; beside it they clash."""
    raw = scene(KINDS[kind], KINDS[kind], normal_backlash=0.2)
    file = scene_from_dict(raw, "s", "s")
    parts, matings = make_parts(file, "s")
    stand = {i.id: i for i in place(file.instances, [], parts, matings, "s").instances}
    meshes = {}
    for name, part in parts.items():
        body = part.body(0.0)
        meshes[name] = body_mesh(body, mesh_outlines(body, 0.003, 0.0))

    def solid(name: str, turned: float) -> Any:
        mesh, (c, s) = meshes[name], (math.cos(turned), math.sin(turned))
        vertices = mesh.vertices @ np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]).T
        vertices = stand[name].scene_from_part.apply(vertices)
        return manifold3d.Manifold(manifold3d.Mesh(vertices.astype(np.float32), mesh.triangles.astype(np.uint32)))

    gear = parts["wheel"].thing
    # where the flanks lean most or are nearest to the apex it is least
    places = np.linspace(gear.inner_distance, gear.cone_distance, 99)
    cosine = math.cos(gear.pressure_angle)
    half = gear.circumferential_thinning * cosine / gear.cone_distance
    least = float((half * places / np.hypot(1.0, np.tan(gear.line.spiral(places)) * cosine)).min())
    assert gear.circumferential_thinning * gear.normal_share == pytest.approx(0.1, rel=1e-12)
    assert matings[0].contact(0.0, 0.0, None).worst.gap == pytest.approx(least, rel=1e-3)
    for share in (0.0, 0.37, 0.71):
        turned = share * math.tau / 13
        pinion, wheel = solid("pinion", turned), solid("wheel", -turned * 13 / 20)
        assert (pinion ^ wheel).volume() < 1e-6
        assert pinion.min_gap(wheel, 1.0) == pytest.approx(least, abs=0.0065)
    assert (solid("pinion", 0.4 * math.tau / 13) ^ solid("wheel", 0.0)).volume() > 1.0


@pytest.mark.sampled(1)
@pytest.mark.parametrize("kind", KINDS)
def test_files_hold_what_they_declare_and_spoiled_ones_are_found(kind: str, tmp_path: Path) -> None:
    exports = [{"format": "step"}, {"format": "stl", "tolerance": 0.1}]
    file = write_scene(tmp_path / "s.toml", {"pinion": PINION | KINDS[kind]}, exports)
    assert main(["build", str(file), "--out", str(tmp_path)]) == 0
    step = tmp_path / "s" / "pinion.step"
    whole = step.read_text()
    numbers = list(re.finditer(r"CARTESIAN_POINT\('',\((-?[\d.E+-]+),", whole))
    spot = numbers[len(numbers) // 3]
    step.write_text(whole[: spot.start(1)] + f"{float(spot[1]) + 2e-3:.9f}" + whole[spot.end(1) :])
    assert main(["verify", str(step)]) == 1


@pytest.mark.parametrize(
    ("pinion", "wheel", "refusal"),
    [
        ({"hand": "right"}, {}, 'pinion.hand = "right": must fit its mate; "left" works'),
        ({"spiral_angle_deg": 25.0}, {}, "pinion.spiral_angle_deg = 25.0: must fit its mate; 30 degrees"),
        ({}, {"spiral_angle_deg": None}, "pinion.spiral_angle_deg = 30.0: must fit its mate; remove spiral_angle_deg"),
        ({"tooth_line": "straight"}, {}, 'pinion.tooth_line = "straight": must fit its mate; "arc"'),
        ({"face_width": 5.0}, {}, "pinion.face_width = 5.0: must fit its mate"),
        ({"cutter_radius": 18.0}, {"cutter_radius": 19.0}, "pinion.cutter_radius = 18.0: must fit its mate; 19 mm"),
        ({"cutter_radius": 3.0}, {}, "pinion.cutter_radius = 3.0: the tooth line leans by"),
        (
            {"cutter_radius": 18.0, "tooth_line": "straight"},
            {},
            "pinion.cutter_radius = 18.0: is only for teeth along an arc",
        ),
    ],
)
def test_what_does_not_fit_is_refused_by_its_key(pinion: dict[str, Any], wheel: dict[str, Any], refusal: str) -> None:
    raw = scene(pinion, wheel)
    raw["parts"] = {name: {k: v for k, v in part.items() if v is not None} for name, part in raw["parts"].items()}
    with pytest.raises(SceneError, match=re.escape(refusal)):
        make_parts(scene_from_dict(raw, "s", "s"), "s")


@pytest.mark.parametrize("hand", ["right", "left"])
def test_forces_are_those_along_the_normal_of_the_exact_flank(hand: str) -> None:
    """Of the driver, whose torque they balance, where its flank crosses the mean pitch circle; and of the mate."""
    words = ["module=3", "number_of_teeth=20", "mate_number_of_teeth=30", "shaft_angle_deg=75", "spiral_angle_deg=35",
             f"hand={hand}", "face_width=15", "addendum_coefficient=0.85", "torque=30"]  # fmt: skip
    told = json.loads(calculate("bevel", words, "json", "en"))["values"]
    keys: dict[str, Any] = {
        word.partition("=")[0]: float(word.partition("=")[2]) for word in words if "hand" not in word
    }
    keys |= {"kind": "bevel_gear", "hand": hand, "number_of_teeth": 20, "mate_number_of_teeth": 30}
    del keys["torque"]
    gear = make_parts(scene_from_dict({"parts": {"g": keys}}, "s", "s"), "s")[0]["g"].thing
    sigma = math.radians(75)
    # turning counter-clockwise seen from the apex, the upper flank drives
    for before, way, own in (("", 1, gear), ("clockwise_", -1, gear.opposite())):
        share = np.linspace(0.0, 1.0, 20_001)
        points = own.wall_points("flank", share, np.array([0.5]))[:, 0] * [1, way, 1]
        depth, radius = gear.mounting_distance - points[:, 2], np.hypot(points[:, 0], points[:, 1])
        k = int(np.abs(np.arctan2(radius, depth) - gear.pitch_angle).argmin())
        step = own.wall_points("flank", share[[k]], np.array([0.5 - 1e-5, 0.5 + 1e-5]))[0] * [1, way, 1]
        normal = np.cross(points[k + 1] - points[k - 1], step[1] - step[0])
        out = np.array([points[k, 0], points[k, 1], 0.0]) / radius[k]
        round_ = np.array([-out[1], out[0], 0.0])
        force = normal / (normal @ round_) * (-way) * 2000 * 30 / (2 * radius[k])
        assert told[f"{before}radial_force"]["first"] == pytest.approx(-force @ out, rel=2e-4)
        assert told[f"{before}axial_force"]["first"] == pytest.approx(-force[2], rel=2e-4)
        # the mate's axis lies in the plane of the own axis and the pitch point, beyond it
        axis = -math.cos(sigma) * np.array([0, 0, 1.0]) + math.sin(sigma) * out
        inwards = -math.cos(sigma) * out - math.sin(sigma) * np.array([0, 0, 1.0])
        assert told[f"{before}axial_force"]["second"] == pytest.approx(-force @ axis, rel=2e-4)
        assert told[f"{before}radial_force"]["second"] == pytest.approx(force @ inwards, rel=2e-4)
        assert np.linalg.norm(force) == pytest.approx(told["normal_force"], rel=2e-4)


def test_the_normal_chord_is_the_way_across_the_exact_tooth() -> None:
    """The shortest from pitch line to pitch line with its middle on the mean circle: arcs and taper bend it little."""
    words = ["module=3", "number_of_teeth=20", "mate_number_of_teeth=40", "spiral_angle_deg=35", "face_width=20"]
    told = json.loads(calculate("bevel", words, "json", "en"))["values"]
    keys = {"kind": "bevel_gear", "module": 3.0, "number_of_teeth": 20, "mate_number_of_teeth": 40,
     "spiral_angle_deg": 35.0,
            "face_width": 20.0}  # fmt: skip
    gear = make_parts(scene_from_dict({"parts": {"g": keys}}, "s", "s"), "s")[0]["g"].thing
    size = gear.mean_distance + np.linspace(-3.0, 3.0, 2001)
    across = []
    for way in (1, -1):
        azimuth = way * gear.half_pitch_angle + gear.spin(size)
        plane = size * math.sin(gear.pitch_angle) * np.exp(1j * azimuth)
        across.append(np.stack([plane.real, plane.imag, size * math.cos(gear.pitch_angle)], axis=1))
    found = float(np.linalg.norm(across[0] - across[1][::-1], axis=1).min())
    assert told["mean_normal_chord"]["first"] == pytest.approx(found, rel=5e-4)


def test_the_worked_example_of_khk() -> None:
    """KHK, Gear Technical Reference, spiral bevel gears of the Gleason system: m 3, z 20/40, b 20, beta_m 35."""
    words = [
        "module=3", "number_of_teeth=20", "mate_number_of_teeth=40", "face_width=20", "spiral_angle_deg=35",
        "addendum_coefficient=0.85", "tip_clearance_coefficient=0.188", "profile_shift_coefficient=0.2925",
    ]  # fmt: skip
    told = json.loads(calculate("bevel", words, "json", "en"))["values"]
    expected: dict[str, float | list[float]] = {
        "transverse_pressure_angle_deg": 23.95680, "outer_cone_distance": 67.08204, "outer_addendum": [3.4275, 1.6725],
        "outer_dedendum": [2.2365, 3.9915], "dedendum_angle_deg": [1.90952, 3.40519],
        "tip_cone_angle_deg": [29.97024, 65.34447], "root_cone_angle_deg": [24.65553, 60.02976],
        "outer_tip_circle": [66.1313, 121.4959], "tip_circle_to_apex": [58.4672, 28.5041],
        "inner_tip_circle": [46.1140, 85.1224],
    }  # fmt: skip
    for name, value in expected.items():
        found = told[name]
        assert (list(found.values()) if isinstance(found, dict) else found) == pytest.approx(value, abs=6e-5), name


def test_the_usual_shift_of_leaning_teeth_is_told_in_the_outer_module() -> None:
    """Dunaev, Lelikov: d_ae1 = d_e1 + 1.64 (1 + x_n1) m_te cos d1, x_n1 = 2 (1 - 1 / u^2) sqrt(cos^3 beta / z1)."""
    words = [
        "module=3",
        "number_of_teeth=20",
        "mate_number_of_teeth=50",
        "spiral_angle_deg=35",
        "addendum_coefficient=0.82",
    ]
    shift = json.loads(calculate("bevel", words, "json", "en"))["values"]["usual_shift"]
    told = json.loads(calculate("bevel", [*words, f"profile_shift_coefficient={shift}"], "json", "en"))["values"]
    own = 2 * (1 - 0.4**2) * math.sqrt(math.cos(math.radians(35.0)) ** 3 / 20)
    tip = 60.0 + 1.64 * (1 + own) * 3 * math.cos(math.atan(0.4))
    assert told["outer_tip_circle"]["first"] == pytest.approx(tip, abs=2e-3)


@pytest.mark.parametrize(
    ("keys", "name"),
    [
        ({"face_width": 90.0}, "face_width"),
        ({"face_width": 35.0, "spiral_angle_deg": 0.0}, "cutter_radius"),
        ({"face_width": 40.0, "tip_cone": "apex", "spiral_angle_deg": 20.0, "cutter_radius": 20.0}, "cutter_radius"),
        ({"face_width": 40.0, "tip_cone": "apex"}, "face_width"),
    ],
)
def test_faces_too_wide_lead_to_the_nearest_value_that_works(keys: dict[str, Any], name: str) -> None:
    """A cutter that is not told has the mean cone distance of the face that is offered."""
    raw = {"module": 3.0, "number_of_teeth": 16, "mate_number_of_teeth": 24, "spiral_angle_deg": 35.0} | keys

    def made(**more: Any) -> None:
        BEVEL_GEAR.thing(msgspec.convert(raw | more | {"kind": "bevel_gear"}, BevelGearSpec), {})

    with pytest.raises(ParameterError) as caught:
        made()
    assert caught.value.name == name
    assert caught.value.nearest is not None
    value = caught.value.nearest.value
    assert isinstance(value, float)
    made(**{name: value})
    with pytest.raises(ParameterError):
        made(**{name: value * (1.001 if caught.value.nearest.side == "at_most" else 0.999)})


@pytest.mark.sampled(1)
@pytest.mark.parametrize("kind", KINDS)
def test_turning_spheres_changes_no_volume(kind: str) -> None:
    """Of a straight gear with the same section: volume, centre and the moment about the axis stay (Cavalieri)."""
    raw = {"parts": {"g": PINION | KINDS[kind]}}
    part = make_parts(scene_from_dict(raw, "s", "s"), "s")[0]["g"]
    straight = replace(part.thing, spiral_angle=0.0, cutter_radius=math.inf)
    own, other = part.body(0.0).moments, faced_bevel(straight).moments
    assert own.volume == pytest.approx(other.volume, rel=1e-9)
    assert own.centre[2] == pytest.approx(other.centre[2], rel=1e-9)
    assert own.inertia[2][2] == pytest.approx(other.inertia[2][2], rel=1e-9)


def test_a_differential_of_spiral_gears_closes() -> None:
    """Both wheels of one hand, the satellites between them of the other: each stands in the spaces of both."""
    raw = scene(KINDS["spiral"], KINDS["spiral"])
    mates = [("sun", "one", 0.0), ("sun", "two", 180.0), ("one", "side", 0.0), ("two", "side", 0.0)]
    raw["instances"] = {"sun": {"part": "wheel"}, "one": {"part": "pinion"}, "two": {"part": "pinion"},
                        "side": {"part": "wheel"}}  # fmt: skip
    raw["mates"] = [{"kind": "bevel_pair", "first": a, "second": b, "direction_deg": way} for a, b, way in mates]
    file = scene_from_dict(raw, "s", "s")
    parts, matings = make_parts(file, "s")
    placing = place(file.instances, [], parts, matings, "s")
    assert all(condition.met for mate in placing.mates for condition in mate.conditions)
