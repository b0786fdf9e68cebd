"""The kind ``bevel_gear``, its mate and its page, through scenes and files."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

import manifold3d
import numpy as np
import pytest

from exporters.command.cli import main
from exporters.documents.topics import calculate
from parts.base.refusal import SceneError
from parts.scene.load import load_scene, make_parts, scene_from_dict
from parts.scene.placing import place
from parts.solids.mesh import body_mesh, mesh_outlines
from tests.exporters.making import read_report, write_scene
from tests.exporters.spoil import Records, change_stl, corner_shifted, triangle_flipped
from tests.sampling import some_of

PINION: dict[str, Any] = {
    "kind": "bevel_gear", "module": 2.0, "number_of_teeth": 12, "mate_number_of_teeth": 18,
     "profile_shift_coefficient": 0.2,
    "hub_diameter": 16.0, "hub_length": 4.0, "bore_diameter": 6.0,
}  # fmt: skip
# as large, with half of the teeth
COARSE = PINION | {"module": 4.0, "number_of_teeth": 6, "mate_number_of_teeth": 9}
WHEEL: dict[str, Any] = {
    "kind": "bevel_gear", "module": 2.0, "number_of_teeth": 18, "mate_number_of_teeth": 12,
     "profile_shift_coefficient": -0.2,
    "bore": {"shape": "hexagon", "across_flats": 8.0},
}  # fmt: skip


def scene(pinion: dict[str, Any] | None = None, wheel: dict[str, Any] | None = None, **mate: Any) -> dict[str, Any]:
    """A pair, the wheel first."""
    return {
        "parts": {"pinion": PINION | (pinion or {}), "wheel": WHEEL | (wheel or {})},
        "instances": {"wheel": {"part": "wheel", "rotation_deg": 13.0}},
        "mates": [{"kind": "bevel_pair", "first": "wheel", "second": "pinion", "direction_deg": 40.0, **mate}],
    }


def tip_pressed_in(records: Records, at: int, step: float) -> Records:
    """The outermost vertex moved towards the axis in all its triangles: the mesh stays closed."""
    corners = records["corners"]
    flat = corners.reshape(-1, 3)
    chosen = flat[np.hypot(flat[:, 0], flat[:, 1]).argmax()].copy()
    moved = chosen * np.array([1 - step / np.hypot(*chosen[:2]), 1 - step / np.hypot(*chosen[:2]), 1.0], np.float32)
    corners[np.all(corners == chosen, axis=2)] = moved
    return records


def standing_solids(raw: dict[str, Any]) -> dict[str, Any]:
    """All in their places as meshes."""
    file = scene_from_dict(raw, "s", "s")
    parts, matings = make_parts(file, "s")
    found = {}
    for instance in place(file.instances, [], parts, matings, "s").instances:
        body = parts[instance.part].body(0.0)
        mesh = body_mesh(body, mesh_outlines(body, 0.005, 0.0))
        vertices = instance.scene_from_part.apply(mesh.vertices).astype(np.float32)
        found[instance.id] = manifold3d.Manifold(manifold3d.Mesh(vertices, mesh.triangles.astype(np.uint32)))
    return found


def solids(raw: dict[str, Any], turned: float = 0.0) -> list[Any]:
    """Both in their places as meshes; the second turned about its axis by so many degrees."""
    file = scene_from_dict(raw, "s", "s")
    parts, matings = make_parts(file, "s")
    found = []
    for instance in place(file.instances, [], parts, matings, "s").instances:
        body = parts[instance.part].body(0.0)
        mesh = body_mesh(body, mesh_outlines(body, 0.002, 0.0))
        vertices = mesh.vertices
        if instance.id == "pinion" and turned:
            c, s = math.cos(math.radians(turned)), math.sin(math.radians(turned))
            vertices = vertices @ np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]).T
        vertices = instance.scene_from_part.apply(vertices)
        own = manifold3d.Mesh(vertices.astype(np.float32), mesh.triangles.astype(np.uint32))
        found.append(manifold3d.Manifold(own))
    return found


@pytest.mark.sampled(1)
@pytest.mark.parametrize("angle", [90.0, 65.0])
def test_teeth_stand_in_spaces_wherever_the_first_stands(angle: float) -> None:
    """By meshes alone: a gap of half the backlash in place; turned by a third of a pitch they clash."""
    turn = {"shaft_angle_deg": angle}
    raw = scene(turn, turn, normal_backlash=0.2)
    wheel, pinion = solids(raw)
    assert (wheel ^ pinion).volume() < 1e-6
    parts, (mating,) = make_parts(scene_from_dict(raw, "s", "s"), "s")
    gear = parts["wheel"].thing
    # least at the inner end
    least = 0.1 * gear.inner_distance / gear.cone_distance
    assert wheel.min_gap(pinion, 1.0) == pytest.approx(least, abs=0.006)
    assert mating.contact(0.0, 0.0, None).worst.gap == pytest.approx(least, rel=1e-9)
    wheel, pinion = solids(raw, turned=10.0)
    assert (wheel ^ pinion).volume() > 1.0


def differential(**side: Any) -> dict[str, Any]:
    """Two wheels face to face, two pinions between them: every mesh a mate; ``side``: keys of the upper wheel."""
    mates = [("sun", "one", 0.0), ("sun", "two", 180.0), ("one", "side", 0.0), ("two", "side", 0.0)]
    return {
        "parts": {"pinion": PINION, "wheel": WHEEL},
        "instances": {"sun": {"part": "wheel", "rotation_deg": 7.0}, "one": {"part": "pinion"},
                      "two": {"part": "pinion"}, "side": {"part": "wheel", **side}},
        "mates": [{"kind": "bevel_pair", "first": a, "second": b, "direction_deg": way, "normal_backlash": 0.2}
                  for a, b, way in mates],
    }  # fmt: skip


def test_a_differential_stands_in_mesh_all_round() -> None:
    """By meshes alone: no pair has anything in common, a pitch further of the upper wheel neither, half of one has."""
    found = standing_solids(differential())
    pairs = [("sun", "one"), ("sun", "two"), ("one", "side"), ("two", "side")]
    for a, b in pairs:
        assert (found[a] ^ found[b]).volume() < 1e-6
        assert found[a].min_gap(found[b], 1.0) < 0.12
    # both wheels face each other about the pinions' axes
    low, high = found["sun"].bounding_box(), found["side"].bounding_box()
    axis = sum(found["one"].bounding_box()[k] for k in (2, 5)) / 2
    assert (low[2] + high[5]) / 2 == pytest.approx(axis, abs=0.02)
    for share, clash in ((1.0, False), (0.5, True)):
        turned = found["side"].rotate((0.0, 0.0, share * 360 / 18))
        for name in ("one", "two"):
            assert ((turned ^ found[name]).volume() > 0.1) is clash


@pytest.mark.parametrize("teeth", [18, 19, 20])
def test_satellites_close_a_differential_where_their_number_divides_the_teeth_of_both_wheels(teeth: int) -> None:
    """The condition of assembly of a planetary set, whose wheels turn against each other when the carrier is held."""
    raw = differential()
    wheel = {**WHEEL, "number_of_teeth": teeth}
    raw["parts"] = {"pinion": {**PINION, "mate_number_of_teeth": teeth}, "wheel": wheel}
    raw["instances"] = {
        "sun": {"part": "wheel"},
        "satellite": {"part": "pinion", "count": 3},
        "side": {"part": "wheel"},
    }
    mates = [("sun", "satellite"), *((f"satellite_{k}", "side") for k in (1, 2, 3))]
    raw["mates"] = [{"kind": "bevel_pair", "first": a, "second": b, "normal_backlash": 0.05} for a, b in mates]
    file = scene_from_dict(raw, "s", "s")
    parts, matings = make_parts(file, "s")
    conditions = [c for mate in place(file.instances, [], parts, matings, "s").mates for c in mate.conditions]
    assert {c.code for c in conditions if not c.met} == (set() if 2 * teeth % 3 == 0 else {"phase"})


def test_what_stands_by_hand_is_held_against_its_mates() -> None:
    raw = differential()
    file = scene_from_dict(raw, "s", "s")
    parts, matings = make_parts(file, "s")
    placing = place(file.instances, [], parts, matings, "s")
    assert all(condition.met for mate in placing.mates for condition in mate.conditions)
    (side,) = (instance for instance in placing.instances if instance.id == "side")

    def broken(**keys: Any) -> list[str]:
        own: dict[str, Any] = {
            "at": list(side.at),
            "axis": list(side.axis),
            "rotation_deg": math.degrees(side.rotation),
        }
        file = scene_from_dict(differential(**{**own, **keys}), "s", "s")
        parts, matings = make_parts(file, "s")
        mates = place(file.instances, [], parts, matings, "s").mates
        assert [mate.only_checks for mate in mates] == [False, False, True, True]
        return [condition.code for condition in mates[3].conditions if not condition.met]

    assert broken() == []
    pitch = 360 / 18
    assert broken(rotation_deg=math.degrees(side.rotation) + pitch) == []
    assert broken(rotation_deg=math.degrees(side.rotation) + pitch / 3) == ["phase"]
    # half of the backlash of 0.2 mm to either side, on the base circle of the outer end
    play = math.degrees(0.1 / (18 * math.cos(math.radians(20))))
    assert broken(rotation_deg=math.degrees(side.rotation) + 0.9 * play) == []
    assert broken(rotation_deg=math.degrees(side.rotation) - 1.15 * play) == ["phase"]
    x, y, z = side.at
    assert broken(at=[x, y, z + 0.01]) == ["apex_distance"]
    assert "shaft_angle" in broken(axis=[0.01, 0.0, -1.0])


def test_check_tells_ratio_contact_and_turns(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "bevel_pair"]) == 0
    said = capsys.readouterr().out
    assert "ratio 0.5" in said
    # half of the backlash at the outer end, at the inner one 7 tenths of it
    assert "CLEAR, least gap 0.035 mm" in said
    assert "pinion = 2, wheel = -1" in said


def test_files_hold_what_they_declare_and_spoiled_ones_are_found(tmp_path: Path) -> None:
    exports = [{"format": "step"}, {"format": "stl", "tolerance": 0.05}]
    file = write_scene(tmp_path / "s.toml", {"pinion": COARSE}, exports)
    out = tmp_path / "out"
    assert main(["build", str(file), "--out", str(out)]) == 0
    folder = out / "s"
    report = read_report(folder)
    assert report["parts"]["pinion"]["outer_cone_distance"] == pytest.approx(2 * math.hypot(12, 18) / 2, rel=1e-12)
    whole = (folder / "pinion.step").read_text()
    # a pole in the middle of a flank
    numbers = list(re.finditer(r"CARTESIAN_POINT\('',\((-?[\d.E+-]+),", whole))
    spot = numbers[len(numbers) // 3]
    (folder / "pinion.step").write_text(whole[: spot.start(1)] + f"{float(spot[1]) + 2e-3:.9f}" + whole[spot.end(1) :])
    assert main(["verify", str(folder / "pinion.step")]) == 1
    (folder / "pinion.step").write_text(whole)
    assert main(["verify", str(folder / "pinion.step")]) == 0
    mesh = (folder / "pinion.stl").read_bytes()
    for change in some_of((corner_shifted, triangle_flipped, tip_pressed_in)):
        change_stl(folder / "pinion.stl", change, 0.4, 0.05)
        assert main(["verify", str(folder / "pinion.stl")]) == 1, change.__name__
        (folder / "pinion.stl").write_bytes(mesh)


@pytest.mark.heavy
@pytest.mark.parametrize(
    "keys", [{"face_width": 18.0}, {"face_width": 15.0}, {"face_width": 18.0, "tip_cone": "apex"}], ids=str
)
def test_faces_much_wider_than_usual_are_written_and_read_back(tmp_path: Path, keys: dict[str, Any]) -> None:
    """R_e is 21.6: the more of it a face takes, the more spans its flanks and all beside them have."""
    file = write_scene(tmp_path / "s.toml", {"pinion": COARSE | {"bore_diameter": 1.0} | keys}, [{"format": "step"}])
    assert main(["build", str(file), "--out", str(tmp_path / "out")]) == 0
    (entry,) = read_report(tmp_path / "out" / "s")["files"]
    assert entry["max_error"] < 3e-8


def test_a_gear_of_thirty_metres_is_drawn_too() -> None:
    """A rounding of 1 mm beside cones of 31 m, and heavy undercut: splines within 3e-8 mm have room for both."""
    sizes: list[dict[str, Any]] = [
        {"number_of_teeth": 60, "mate_number_of_teeth": 13, "pressure_angle_deg": 14.5,
         "profile_shift_coefficient": -0.2,
         "tip_radius_coefficient": 0.001},
        {"number_of_teeth": 17, "mate_number_of_teeth": 60, "pressure_angle_deg": 10.0,
         "tip_clearance_coefficient": 0.0},
    ]  # fmt: skip
    for keys in sizes:
        raw = {"parts": {"g": {"kind": "bevel_gear", "module": 1000.0, **keys}}}
        part = make_parts(scene_from_dict(raw, "s", "s"), "s")[0]["g"]
        assert part.body(0.0).within(1e-7).max_error < 3e-8


HOLED: dict[str, Any] = {
    "kind": "bevel_gear", "module": 4.0, "number_of_teeth": 25, "mate_number_of_teeth": 10, "rim_thickness": 4.0,
    "hub_diameter": 30.0, "hub_length": 6.0, "bore_diameter": 10.0,
    "holes": {"count": 4, "diameter": 8.0, "pitch_circle_diameter": 44.0},
}  # fmt: skip


def test_a_gear_beside_a_mate_of_metres_is_drawn_too() -> None:
    """Fillet and flank met within 1e-13 of the gear's own size, and are known to that of a cone distance a hundred
    times as large: 3.7e-12 mm with 5000 teeth of the mate."""
    keys = {"number_of_teeth": 20, "mate_number_of_teeth": 10_000, "shaft_angle_deg": 170.0}
    raw: dict[str, Any] = {"parts": {"gear": PINION | keys | {"profile_shift_coefficient": 0.0}}}
    profile = make_parts(scene_from_dict(raw, "s", "s"), "s")[0]["gear"].section(0.0).region.outer
    assert len(profile.period) == 6


@pytest.mark.heavy
def test_holes_run_from_the_front_to_the_back_of_the_rim(tmp_path: Path) -> None:
    """As cylinders that are taken out of it; files and the sheet are read back."""
    keys = {name: value for name, value in HOLED.items() if name != "holes"}
    scenes = ({"parts": {"wheel": one}} for one in (keys, HOLED))
    plain, holed = (make_parts(scene_from_dict(raw, "s", "s"), "s")[0]["wheel"] for raw in scenes)
    gear = plain.thing
    # from the inner root circle to where the back cone ends
    delta, root = math.atan2(50, 20), gear.root_angle
    cone = 50.0 / math.sin(delta)
    front = (cone - gear.face_width) / math.cos(root - delta) * math.cos(root)
    back = cone / math.cos(root - delta) * math.cos(root) + 4.0 * math.sin(delta)
    lost = plain.body(0.0).moments.volume - holed.body(0.0).moments.volume
    assert lost == pytest.approx(4 * math.pi * 4.0**2 * (back - front), rel=1e-9)
    drawing = {"format": "svg", "purpose": "part", "paper": "A3", "scale": "1:1", "tolerance": 0.01}
    exports = [{"format": "step"}, {"format": "stl", "tolerance": 0.1}, drawing]
    file = write_scene(tmp_path / "s.toml", {"wheel": HOLED}, exports)
    assert main(["build", str(file), "--out", str(tmp_path), "--quiet"]) == 0


@pytest.mark.parametrize(("circle", "key"), [(64.0, "holes.pitch_circle_diameter"), (34.0, "hub_diameter")])
def test_holes_that_have_no_room_are_refused_with_some_that_have(circle: float, key: str) -> None:
    keys = HOLED | {"holes": HOLED["holes"] | {"pitch_circle_diameter": circle}}
    with pytest.raises(SceneError) as refusal:
        make_parts(scene_from_dict({"parts": {"wheel": keys}}, "s", "s"), "s")
    assert f"parts.wheel.{key}" in str(refusal.value)
    assert refusal.value.nearest is not None


@pytest.mark.parametrize(
    ("pinion", "wheel", "key", "told"),
    [
        ({}, {"number_of_teeth": 19}, "parts.pinion.mate_number_of_teeth", "19"),
        ({}, {"module": 2.5}, "parts.pinion.module", "2.5"),
        ({}, {"profile_shift_coefficient": 0.1}, "parts.pinion.profile_shift_coefficient", "-0.1"),
        ({"shaft_angle_deg": 80.0}, {}, "parts.pinion.shaft_angle_deg", "90"),
        ({"mounting_distance": 10.0, "hub_length": 0.0}, {}, "parts.pinion.mounting_distance", "at least 19.8834 mm"),
        ({"mounting_distance": 90.0, "hub_diameter": 0.0, "hub_length": 0.0}, {}, "parts.pinion.mounting_distance",
         "run into the axis; at most 2"),
        ({"mounting_distance": 40.0}, {}, "parts.pinion.mounting_distance", "hub_length"),
        ({"hub_length": 0.0}, {}, "parts.pinion.hub_length", "needs its diameter and its length"),
        ({"bore_diameter": 15.9}, {}, "parts.pinion.bore_diameter", "at most 1"),
        ({"hub_diameter": 30.0}, {}, "parts.pinion.hub_diameter", "at most 20"),
        ({"circumferential_thinning": 9.0}, {}, "parts.pinion.circumferential_thinning", "leaves no tip"),
        ({"face_width": 30.0}, {}, "parts.pinion.face_width", "apex"),
    ],
)  # fmt: skip
def test_wrong_keys_are_refused_in_one_line(pinion: dict[str, Any], wheel: dict[str, Any], key: str, told: str) -> None:
    raw = scene(pinion, wheel)
    with pytest.raises(SceneError) as caught:
        make_parts(scene_from_dict(raw, "s", "s"), "s")
    said = str(caught.value)
    assert key in said
    assert told in said


def test_a_mounting_distance_sets_the_hub_or_the_rim() -> None:
    for keys, mounted in ((PINION | {"hub_length": 0.0, "mounting_distance": 30.0}, 30.0),
                          (WHEEL | {"mounting_distance": 17.0}, 17.0),
                          # a dedendum of 1.4 m and the rim down the back cone, from where the pitch cone ends
                          (WHEEL | {"rim_thickness": 5.0}, 12 + (2.8 + 5.0) * 3 / math.sqrt(13))):  # fmt: skip
        part = make_parts(scene_from_dict({"parts": {"p": keys}}, "s", "s"), "s")[0]["p"]
        low, high = part.body(0.0).levels()
        tip = part.thing.inner(part.thing.inner_tip_angle)
        assert (low, high) == pytest.approx((0.0, mounted - tip.imag), abs=1e-12)


def test_a_bevel_gear_that_is_offset_or_cut_flat_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = write_scene(tmp_path / "s.toml", {"pinion": PINION}, [{"format": "stl", "offset": 0.1}])
    assert main(["build", str(file), "--out", str(tmp_path / "out")]) == 2
    assert "exports[1].offset = 0.1" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()
    file = write_scene(tmp_path / "s.toml", {"pinion": PINION}, [{"format": "dxf"}])
    assert main(["build", str(file), "--out", str(tmp_path / "out")]) == 2
    assert 'exports[1].format = "dxf": no part that is asked for has a flat outline' in capsys.readouterr().err
    assert not (tmp_path / "out").exists()
    # beside a file that can be made it is left out
    file = write_scene(tmp_path / "s.toml", {"pinion": PINION}, [{"format": "dxf"}, {"format": "stl"}])
    assert main(["build", str(file), "--out", str(tmp_path / "out"), "--no-verify"]) == 0
    assert "pinion has no flat outline" in capsys.readouterr().out
    assert not list((tmp_path / "out").rglob("*.dxf"))


def test_the_page_tells_what_textbooks_tell() -> None:
    """Dunaev, Lelikov, and GOST 19624 by hand: m 2.5, z 20/50, x 0.3 at a right angle, b 20."""
    words = ["module=2.5", "number_of_teeth=20", "mate_number_of_teeth=50", "profile_shift_coefficient=0.3",
     "face_width=20",
             "torque=30"]  # fmt: skip
    told = json.loads(calculate("bevel", words, "json", "en"))["values"]
    distance = 2.5 / 2 * math.hypot(20, 50)
    small = math.atan(20 / 50)
    expected = {
        "outer_cone_distance": distance, "mean_cone_distance": distance - 10, "inner_cone_distance": distance - 20,
        "outer_pitch_diameter": [50.0, 125.0], "outer_addendum": [3.25, 1.75], "outer_dedendum": [2.25, 3.75],
        "pitch_cone_angle_deg": [math.degrees(small), 90 - math.degrees(small)],
        "outer_tip_circle": [50 + 6.5 * math.cos(small), 125 + 3.5 * math.sin(small)],
        "tip_circle_to_apex": [62.5 - 3.25 * math.sin(small), 25 - 1.75 * math.cos(small)],
        "dedendum_angle_deg": [math.degrees(math.atan(h / distance)) for h in (2.25, 3.75)],
        "virtual_teeth": [20 / math.cos(small), 50 / math.sin(small)],
    }  # fmt: skip
    for name, value in expected.items():
        found = told[name]
        assert (list(found.values()) if isinstance(found, dict) else found) == pytest.approx(value, rel=1e-9), name
    along = 2000 * 30 / (50 * (1 - 10 / distance))
    assert told["circumferential_force"] == pytest.approx(along, rel=1e-9)
    radial, axial = (list(told[f"{name}_force"].values()) for name in ("radial", "axial"))
    # what pushes one aside pushes the other along
    assert radial == pytest.approx(axial[::-1], rel=1e-12)
    assert math.hypot(along, radial[0], axial[0]) == pytest.approx(told["normal_force"], rel=1e-12)


@pytest.mark.parametrize(("teeth", "shift"), [(20, 0.0), (20, 0.3), (12, 0.6), (14, 0.7)])
def test_thin_tips_are_told_where_those_of_the_virtual_spur_gear_are_thin(teeth: int, shift: float) -> None:
    """Tips of less than 0.3 m, by Tredgold's gear where its tips are 0.05 m and more off that limit."""
    gear = {"module": 2.0, "number_of_teeth": teeth, "mate_number_of_teeth": 40, "profile_shift_coefficient": shift}
    parts, _ = make_parts(
        scene_from_dict({"parts": {"p": PINION | gear | {"hub_diameter": 0.0, "hub_length": 0.0}}}, "s", "s"), "s"
    )
    virtual = teeth / math.cos(math.atan(teeth / 40))

    def involute(angle: float) -> float:
        return math.tan(angle) - angle

    alpha = math.radians(20)
    tip = math.acos(math.cos(alpha) * virtual / (virtual + 2 + 2 * shift))
    half = (math.pi / 2 + 2 * shift * math.tan(alpha)) / virtual + involute(alpha) - involute(tip)
    land = (virtual + 2 + 2 * shift) * half
    assert abs(land - 0.3) > 0.05
    assert ("thin_tip" in [found.code for found in parts["p"].findings]) == (land < 0.3)


@pytest.mark.parametrize("teeth", [(17, 31), (19, 31), (24, 27)])
def test_the_usual_face_width_as_it_is_told_is_not_too_wide(teeth: tuple[int, int]) -> None:
    """0.3 of the cone distance, with five decimals; 1e-5 mm more is."""
    usual = 0.3 * math.hypot(*teeth) * 2.0 / 2
    for width, wide in ((round(usual, 5), False), (round(usual, 5) + 1e-5, True), (None, False)):
        keys = PINION | {"number_of_teeth": teeth[0], "mate_number_of_teeth": teeth[1]}
        keys |= {} if width is None else {"face_width": width}
        found = make_parts(scene_from_dict({"parts": {"p": keys}}, "t", "t"), "t")[0]["p"].findings
        assert ("bevel_wide_face" in [one.code for one in found]) == wide


# KHK, Gear Technical Reference, calculation of straight bevel gears: m 3, z 20/40, b 22 at a right angle; what the page
# tells, then the radius of the inner tip circle of each
KHK: dict[str, tuple[list[str], dict[str, list[float]], list[float]]] = {
    "Gleason": (
        ["profile_shift_coefficient=0.345", "tip_clearance_coefficient=0.188"],
        {
            "outer_addendum": [4.035, 1.965], "outer_dedendum": [2.529, 4.599],
            "dedendum_angle_deg": [2.15903, 3.92194], "addendum_angle_deg": [3.92194, 2.15903],
            "tip_cone_angle_deg": [30.48699, 65.59398], "root_cone_angle_deg": [24.40602, 59.51301],
            "inner_tip_circle": [44.8425, 81.6609],
            "outer_tip_circle": [67.2180, 121.7575], "tip_circle_to_apex": [58.1955, 28.2425],
        },
        [44.8425, 81.6609],
    ),
    "standard": (
        ["tip_clearance_coefficient=0.25", "tip_cone=apex"],
        {
            "dedendum_angle_deg": [3.19960, 3.19960], "addendum_angle_deg": [2.56064, 2.56064],
            "tip_cone_angle_deg": [29.12569, 65.99559], "root_cone_angle_deg": [23.36545, 60.23535],
            "inner_tip_circle": [43.9292, 82.4485],
            "outer_tip_circle": [65.3666, 122.6833], "tip_circle_to_apex": [58.6584, 27.3167],
        },
        [43.9292, 82.4485],
    ),
}  # fmt: skip


@pytest.mark.parametrize("system", KHK)
def test_worked_examples_of_khk(system: str) -> None:
    keys, expected, inner = KHK[system]
    words = ["module=3", "number_of_teeth=20", "mate_number_of_teeth=40", "face_width=22", *keys]
    told = json.loads(calculate("bevel", words, "json", "en"))["values"]
    for name, value in expected.items():
        assert list(told[name].values()) == pytest.approx(value, abs=6e-5), name
    given: dict[str, Any] = {key: value if key == "tip_cone" else float(value) for key, value in
                             (word.split("=") for word in words)}  # fmt: skip
    for teeth, mate, way, diameter in ((20, 40, 1, inner[0]), (40, 20, -1, inner[1])):
        shift = way * given.get("profile_shift_coefficient", 0.0)
        own = {"number_of_teeth": teeth, "mate_number_of_teeth": mate, "profile_shift_coefficient": shift}
        raw = {"parts": {"gear": given | own | {"kind": "bevel_gear"}}}
        gear = make_parts(scene_from_dict(raw, "s", "s"), "s")[0]["gear"]
        solid = gear.body(0.0).within(1e-6).geometry
        points = solid.points[solid.vertices]
        off = np.abs(np.hypot(points[:, 0], points[:, 1]) - diameter / 2)
        # both corners of every tooth stand on the inner tip circle
        assert int((off < 6e-5).sum()) == 2 * teeth


def test_what_is_measured_on_a_tooth() -> None:
    """The printed constants of GOST 19624-74 at 20 degrees, and the exact tooth cut half way along its face."""
    words = [
        "module=2.5",
        "number_of_teeth=20",
        "mate_number_of_teeth=50",
        "profile_shift_coefficient=0.3",
        "face_width=20",
    ]
    told = json.loads(calculate("bevel", words, "json", "en"))["values"]
    thickness, high = (list(told[name].values()) for name in ("outer_thickness", "outer_addendum"))
    assert list(told["outer_constant_chord"].values()) == pytest.approx([0.8830 * s for s in thickness], rel=1e-4)
    expected = [h - 0.1607 * s for h, s in zip(high, thickness, strict=True)]
    assert list(told["outer_constant_chord_height"].values()) == pytest.approx(expected, rel=1e-4)
    teeth = list(told["virtual_teeth"].values())
    assert list(told["virtual_least_shift"].values()) == pytest.approx([1.068 - 0.0585 * z for z in teeth], abs=3e-3)
    keys = {key: float(value) for key, value in (word.split("=") for word in words)}
    keys |= {"number_of_teeth": 20, "mate_number_of_teeth": 50}
    raw = {"parts": {"gear": {"kind": "bevel_gear"} | keys}}
    gear = make_parts(scene_from_dict(raw, "s", "s"), "s")[0]["gear"].thing
    # where the exact flank crosses the pitch cone: shares between fillet and tip, half way along
    share = np.linspace(0.0, 1.0, 4001)
    points = gear.wall_points("flank", share, np.array([0.5]))[:, 0]
    depth, radius = gear.mounting_distance - points[:, 2], np.hypot(points[:, 0], points[:, 1])
    at = int(np.abs(np.arctan2(radius, depth) - gear.pitch_angle).argmin())
    assert 2 * points[at, 1] == pytest.approx(told["mean_chord"]["first"], abs=2e-3)
    tip = points[-1]
    middle = np.array([radius[at], depth[at]]) * [math.cos(math.atan2(points[at, 1], points[at, 0])), 1.0]
    # along the perpendicular of the pitch line
    outwards = np.array([math.cos(gear.pitch_angle), -math.sin(gear.pitch_angle)])
    height = (np.array([math.hypot(*tip[:2]), gear.mounting_distance - tip[2]]) - middle) @ outwards
    assert height == pytest.approx(told["mean_chord_height"]["first"], abs=2e-3)


@pytest.mark.parametrize(
    ("teeth", "mate", "shift"), [(20, 40, 0.34), (20, 50, 0.37), (20, 80, 0.42), (20, 100, 0.43), (40, 200, 0.30)]
)
def test_the_usual_shift_is_that_of_the_textbook_table(teeth: int, mate: int, shift: float) -> None:
    """Dunaev, Lelikov: shifts of straight bevel pinions at a right angle."""
    words = ["module=2", f"number_of_teeth={teeth}", f"mate_number_of_teeth={mate}"]
    told = json.loads(calculate("bevel", words, "json", "en"))["values"]["usual_shift"]
    assert told == pytest.approx(shift, abs=0.0075)


def test_sliding_is_the_cross_product_of_both_turnings_with_the_place() -> None:
    """At the outer tips on the line of action, alpha off the tangent plane of both pitch cones."""
    words = ["module=2.5", "number_of_teeth=20", "mate_number_of_teeth=30", "shaft_angle_deg=75", "speed_rpm=300"]
    told = json.loads(calculate("bevel", words, "json", "en"))["values"]
    sigma, alpha = math.radians(75), math.radians(20)
    one, two = (math.radians(angle) for angle in told["pitch_cone_angle_deg"].values())
    # the pitch line is z, both axes lie in the plane of x and z; seen from the apex they turn in opposite senses
    first = np.array([-math.sin(one), 0.0, math.cos(one)])
    second = np.array([math.sin(two), 0.0, math.cos(two)])
    assert math.acos(first @ second) == pytest.approx(sigma)
    speed = math.pi * 300 / 30
    turning = speed * first + speed * 20 / 30 * second
    assert np.linalg.norm(np.cross(turning, [0, 0, 1])) < 1e-12 * speed
    for name, gear, axis, delta, way in (
        ("sliding_speed_at_end", "first", first, one, 1), ("sliding_speed_at_start", "second", second, two, -1),
    ):  # fmt: skip
        # along the line of action up to the tip cone: x away from the first axis
        aim = delta + math.atan(told["outer_addendum"][gear] / told["outer_cone_distance"])
        arcs = np.linspace(0.0, 0.4, 400_001)
        along = np.array([way * math.sin(alpha), way * math.cos(alpha), 0.0])
        places = np.cos(arcs)[:, None] * [0, 0, 1] + np.sin(arcs)[:, None] * along
        at = places[int(np.abs(np.arccos(places @ axis) - aim).argmin())]
        size = told["outer_cone_distance"] / math.cos(aim - delta)
        assert np.linalg.norm(np.cross(turning, size * at)) == pytest.approx(told[name], rel=1e-4)


def test_a_backlash_that_leaves_no_tooth_is_refused_by_its_own_key() -> None:
    words = ["module=2", "number_of_teeth=20", "mate_number_of_teeth=40"]
    with pytest.raises(SceneError, match=r"normal_backlash = 9.0: .*; at most ") as caught:
        calculate("bevel", [*words, "normal_backlash=9"], "text", "en")
    assert caught.value.nearest is not None
    assert "j_n" in calculate("bevel", [*words, f"normal_backlash={caught.value.nearest.value}"], "text", "en")


def test_the_page_of_a_scene_and_its_refusals() -> None:
    assert "δ1" in calculate("bevel", ["bevel_pair", "part=wheel"], "text", "en")
    # the mate's shift is the negative of the one that is given
    with pytest.raises(SceneError, match="profile_shift_coefficient"):
        calculate(
            "bevel",
            ["module=2", "number_of_teeth=40", "mate_number_of_teeth=8", "profile_shift_coefficient=-0.9"],
            "text",
            "en",
        )
    assert load_scene("bevel_pair").parts["pinion"].__struct_config__.tag == "bevel_gear"


AXES = ([0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, -3.0, 1e-9], [0.3, -0.4, -0.86], [1e-7, 0.0, 1.0])


@pytest.mark.parametrize("axis", AXES, ids=str)
def test_a_pair_stands_to_each_other_alike_on_any_axis(axis: list[float]) -> None:
    """The placement of the second seen from the first is that beside an upright first: both as rigid motions."""

    def seen(**first: Any) -> np.ndarray[Any, np.dtype[np.float64]]:
        raw = scene({"shaft_angle_deg": 75.0}, {"shaft_angle_deg": 75.0})
        raw["instances"]["wheel"] |= first
        file = scene_from_dict(raw, "s", "s")
        parts, matings = make_parts(file, "s")
        stand = {i.id: i for i in place(file.instances, [], parts, matings, "s").instances}
        return (stand["wheel"].scene_from_part.inverse() @ stand["pinion"].scene_from_part).matrix()

    assert seen(at=[5.0, -7.0, 11.0], axis=axis) == pytest.approx(seen(), abs=1e-9)
