"""``[defaults]``: what repeats is said once, and a refusal names where a key has come from."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import pytest

from exporters.command.cli import main
from exporters.production.plan import plan_build
from parts.base.refusal import SceneError
from parts.scene.load import load_scene, make_parts, resolved, scene_from_dict, scene_from_toml
from parts.scene.schema import scene_schema

SHORT = """
[defaults]
material = "plywood 3 mm"
face_width = 3.0
bore_diameter = 6.0
module = 2.0
kerf = 0.2
tolerance = 0.01
normal_backlash = 0.1
[parts.pinion]
kind = "spur_gear"
number_of_teeth = 18
[parts.wheel]
kind = "spur_gear"
number_of_teeth = 30
face_width = 4.0
bore = { shape = "hexagon", across_flats = 8.0 }
[[mates]]
kind = "external_gear_pair"
first = "pinion"
second = "wheel"
[boards.plywood]
width = 600.0
height = 400.0
thickness = 3.0
[[exports]]
format = "dxf"
[[exports]]
format = "dxf"
purpose = "board"
[[exports]]
format = "stl"
offset = -0.05
[[exports]]
format = "step"
"""
LONG = """
[parts.pinion]
kind = "spur_gear"
number_of_teeth = 18
material = "plywood 3 mm"
face_width = 3.0
bore_diameter = 6.0
module = 2.0
[parts.wheel]
kind = "spur_gear"
number_of_teeth = 30
material = "plywood 3 mm"
face_width = 4.0
bore = { shape = "hexagon", across_flats = 8.0 }
module = 2.0
[[mates]]
kind = "external_gear_pair"
first = "pinion"
second = "wheel"
normal_backlash = 0.1
[boards.plywood]
width = 600.0
height = 400.0
thickness = 3.0
kerf = 0.2
[[exports]]
format = "dxf"
kerf = 0.2
tolerance = 0.01
[[exports]]
format = "dxf"
purpose = "board"
tolerance = 0.01
[[exports]]
format = "stl"
offset = -0.05
tolerance = 0.01
[[exports]]
format = "step"
"""
SET = '[defaults]\nmaterial = "PLA"\nmodule = 1.5\n[[assemblies]]\nkind = "planetary_set"\nteeth = [24, 24, 72]\n'


def test_a_short_scene_is_the_long_one() -> None:
    import jsonschema

    short, long = (resolved(scene_from_toml(text.encode(), "s", "s")) for text in (SHORT, LONG))
    assert short == long
    assert jsonschema.Draft202012Validator(json.loads(scene_schema())).is_valid(tomllib.loads(SHORT))


def test_told_out_it_is_the_same_scene(tmp_path: Path) -> None:
    for text in (SHORT, SET):
        file, plain = tmp_path / "s.toml", tmp_path / "plain" / "s.toml"
        plain.parent.mkdir(exist_ok=True)
        plain.unlink(missing_ok=True)
        file.write_text(text, encoding="utf-8")
        assert main(["new", str(file), "--expand", "--out", str(plain)]) == 0
        assert "defaults" not in plain.read_text("utf-8")
        assert resolved(load_scene(str(file))) == resolved(load_scene(str(plain)))


def test_an_assembly_takes_them() -> None:
    scene = resolved(scene_from_toml(SET.encode(), "s", "s"))
    assert {(p["module"], p["material"]) for p in scene["parts"].values() if "module" in p} == {(1.5, "PLA")}


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("bore_diameter = 6.0\nm", "bore_diameter = 60.0\nm", "parts.pinion: defaults.bore_diameter"),
        ("kerf = 0.2", "kerf = -1", "defaults.kerf"),
        ("module = 2.0", 'module = "two"', "parts.pinion: defaults.module"),
        ("module = 2.0", "moduel = 2.0", "defaults.moduel"),
        ("module = 2.0", "rack_step = 2.0", "defaults.rack_step"),
        ("[defaults]", "defaults = 3", "defaults"),
    ],
)
def test_a_refusal_names_where_the_key_stands(old: str, new: str, told: str, tmp_path: Path) -> None:
    file = tmp_path / "s.toml"
    text = SHORT.replace(old, new, 1)
    if told == "defaults":
        text = "defaults = 3\n" + SHORT.split("normal_backlash = 0.1")[1]
    file.write_text(text, encoding="utf-8")
    with pytest.raises(SceneError) as refused:
        plan_build(load_scene(str(file)), str(file), [], [])
    assert refused.value.key == told
    assert "\n" not in str(refused.value)


def test_a_key_that_no_export_takes_is_not_offered_itself() -> None:
    """Of a mesh's export: "did you mean kerf?" was said of kerf."""
    text = '[defaults]\nkerf = 0.2\n[parts.g]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 22\n'
    text += '[[exports]]\nformat = "stl"\n'
    with pytest.raises(SceneError) as refused:
        scene_from_toml(text.encode(), "s", "s")
    assert refused.value.key == "defaults.kerf"
    assert "kerf" not in str(refused.value).partition("= 0.2")[2]


# what a default does nothing for: a stem or axles that are not there, pins of a flat cam's frame, angles of a face
IDLE = """
[defaults]
stem_width = 8.0
pin_diameter = 5.0
beyond_axles = 9.0
least_transmission_angle_deg = 60.0
[parts.tappet]
kind = "follower"
end = "roller"
[parts.cam]
kind = "cam"
base_circle_radius = 60.0
follower = "flat"
lift = 10.0
phases = [
    { move = "rise", angle_deg = 90.0, law = "sine" }, { move = "dwell", angle_deg = 90.0 },
    { move = "return", angle_deg = 90.0, law = "sine" }, { move = "dwell", angle_deg = 90.0 },
]
[parts.board]
kind = "plate"
width = 40.0
height = 30.0
[parts.roller_cam]
kind = "cam"
base_circle_radius = 40.0
follower = "roller"
follower_radius = 8.0
lift = 10.0
phases = [{ move = "rise", angle_deg = 180.0, law = "sine" }, { move = "return", angle_deg = 180.0, law = "sine" }]
[parts.stemless]
kind = "yoke_frame"
of = "cam"
stem_above = 0.0
[parts.frame]
kind = "yoke_frame"
of = "cam"
[[exports]]
format = "svg"
"""


def test_what_would_do_nothing_is_passed_over(tmp_path: Path) -> None:
    file, plain = tmp_path / "s.toml", tmp_path / "plain.toml"
    file.write_text(IDLE, encoding="utf-8")
    scene = load_scene(str(file))
    told = {(part, key) for part, keys in resolved(scene)["parts"].items() for key, value in keys.items()
            if value == {"stem_width": 8.0, "pin_diameter": 5.0, "beyond_axles": 9.0,
                         "least_transmission_angle_deg": 60.0}.get(key, "")}  # fmt: skip
    assert told == {("tappet", "stem_width"), ("tappet", "pin_diameter"), ("frame", "stem_width"),
                    ("roller_cam", "least_transmission_angle_deg")}  # fmt: skip
    assert set(plan_build(scene, str(file), [], []).parts) == set(scene.parts)
    assert main(["new", str(file), "--expand", "--out", str(plain)]) == 0
    assert resolved(load_scene(str(plain)))["parts"] == resolved(scene)["parts"]
    # what a part says itself is refused
    file.write_text(IDLE.replace("stem_above", "stem_width = 8.0\nstem_above"), encoding="utf-8")
    with pytest.raises(SceneError) as refused:
        plan_build(load_scene(str(file)), str(file), [], [])
    assert (refused.value.key, refused.value.code) == ("parts.stemless.stem_width", "needs_other")


# parts in a form beside which some key does nothing, and that key: refused to each, of ``[defaults]`` passed over
PHASES = [{"move": move, "angle_deg": 180.0, "law": "sine"} for move in ("rise", "return")]
DISK = {"kind": "cam", "follower": "roller", "follower_radius": 8.0, "base_circle_radius": 40.0, "lift": 10.0}
SWINGING = {k: v for k, v in DISK.items() if k != "lift"} | {
    "swing_deg": 9.0,
    "oscillating": {"centre_distance": 95.0, "arm_length": 80.0},
    "phases": PHASES,
}
POINTED = {k: v for k, v in DISK.items() if k != "follower_radius"} | {"phases": PHASES}
UNSIZED = {k: v for k, v in POINTED.items() if k != "base_circle_radius"}
BARREL = {"kind": "barrel_cam", "form": "groove", "outer_diameter": 60.0, "roller_diameter": 10.0, "groove_depth": 8.0,
          "lift": 20.0, "phases": PHASES}  # fmt: skip
LINKED = {"kind": "linkage_cam", "follower": "roller", "coupler_length": 43.0, "coupler_point": [6.0, 16.0],
          "driven": {"member": "rocker", "pivot": [91.0, 26.0], "length": 58.0, "start_angle_deg": 167.0,
                     "sense": "clockwise"},
          "guide": {"member": "rocker", "pivot": [62.0, 124.0], "length": 68.0, "assembly": "left"},
          "follower_radius": 6.0, "swing_deg": 24.0, "phases": PHASES}  # fmt: skip
GROOVE = {"kind": "groove_cam", "follower_radius": 8.0, "groove_depth": 5.0, "phases": PHASES,
          "base_circle_radius": 40.0}  # fmt: skip
SWUNG = {**GROOVE, "swing_deg": 9.0, "oscillating": {"centre_distance": 95.0, "arm_length": 80.0}}
WEDGE = {"kind": "wedge_cam", "follower": "roller", "phases": [{"move": "rise", "travel": 60.0, "law": "sine"}],
         "base_height": 15.0, "lift": 20.0, "follower_radius": 6.0}  # fmt: skip
BEVEL = {"kind": "bevel_gear", "module": 2.0, "number_of_teeth": 20, "mate_number_of_teeth": 40}
PITCHED = {"kind": "ratchet_wheel", "module": 5.0, "number_of_teeth": 24}
FORMS: list[tuple[dict[str, object], str, object]] = [
    ({"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20}, "double_helical", True),
    ({"kind": "rack", "module": 2.0, "number_of_teeth": 5}, "double_helical", True),
    ({"kind": "worm", "module": 2.0, "thread_length": 40.0}, "grinding_wheel_diameter", 200.0),
    ({"kind": "worm", "module": 2.0, "thread_length": 40.0}, "run_out_deg", 60.0),
    ({"kind": "worm_wheel", "module": 2.0, "number_of_teeth": 40}, "grinding_wheel_diameter", 200.0),
    (BEVEL, "cutter_radius", 60.0),
    (BEVEL, "tooth_line", "straight"),
    ({**DISK, "phases": PHASES}, "plate_diameter", 60.0),
    ({**DISK, "phases": PHASES}, "table_tolerance", 0.1),
    (
        {"kind": "cam", "follower": "flat", "base_circle_radius": 60.0, "lift": 10.0, "phases": PHASES},
        "follower_radius",
        8.0,
    ),
    ({**POINTED, "follower": "pointed"}, "follower_radius", 8.0),
    ({**UNSIZED, "follower": "flat", "least_curvature_radius": 5.0}, "least_return_transmission_angle_deg", 50.0),
    (SWINGING, "follower_offset", 4.0),
    (
        {"kind": "timing_pulley", "belt": "GT2", "number_of_teeth": 30, "flanges": {"diameter": 22.0}},
        "face_chamfer",
        0.2,
    ),
    (PITCHED, "outer_diameter", 150.0),
    (
        {
            "kind": "cam",
            "follower": "flat",
            "base_circle_radius": 60.0,
            "swing_deg": 9.0,
            "oscillating": {"centre_distance": 95.0},
            "phases": PHASES,
        },
        "plate_diameter",
        60.0,
    ),
    ({**PITCHED, "internal": True, "outer_diameter": 150.0}, "bore_diameter", 6.0),
    ({"kind": "sprocket", "number_of_teeth": 17, "chain": "08B-1"}, "displaced", True),
    ({"kind": "follower", "end": "roller"}, "plate_diameter", 60.0),
    ({"kind": "follower", "end": "roller"}, "tip_angle_deg", 50.0),
    ({"kind": "follower", "end": "roller"}, "follower_radius", 5.0),
    ({"kind": "follower_arm", "end": "roller", "arm_length": 60.0}, "tip_height", 9.0),
    ({"kind": "follower_arm", "end": "roller", "arm_length": 60.0}, "face_offset", 2.0),
    (BARREL, "web_thickness", 3.0),
    (BARREL, "cone_angle_deg", 10.0),
    ({**BARREL, "form": "end"}, "clearance", 0.1),
    (LINKED, "plate_diameter", 60.0),
    (LINKED, "lift", 9.0),
    ({**GROOVE, "lift": 10.0}, "swing_deg", 9.0),
    (SWUNG, "lift", 9.0),
    (SWUNG, "follower_offset", 4.0),
    (WEDGE, "swing_deg", 9.0),
    ({"kind": "sprocket", "number_of_teeth": 17, "chain": "08B-1", "tooth_form": "GOST 591"}, "form", 0.5),
    ({**BEVEL, "spiral_angle_deg": 30.0, "tooth_line": "straight"}, "cutter_radius", 60.0),
    ({"kind": "worm", "module": 2.0, "thread_length": 40.0, "thread_ends": "run_out"}, "end_angle_deg", 60.0),
    ({"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20, "thinning_method": "deeper_cut"}, "crowning", 0.02),
    ({**PITCHED, "internal": True, "outer_diameter": 150.0}, "hub", {"diameter": 20.0, "below": 3.0}),
]


@pytest.mark.parametrize(("form", "key", "value"), FORMS)
def test_keys_of_other_forms_are_passed_over(form: dict[str, object], key: str, value: object) -> None:
    """A default for one worm of ZK1 was refused because of another one of ZI."""
    scene = scene_from_dict({"defaults": {key: value}, "parts": {"a": dict(form)}}, "s", "s")
    plain = scene_from_dict({"parts": {"a": dict(form)}}, "s", "s")
    assert scene.parts == plain.parts
    make_parts(scene, "s")
    with pytest.raises(SceneError) as refused:
        make_parts(scene_from_dict({"parts": {"a": {**form, key: value}}}, "s", "s"), "s")
    assert refused.value.key == f"parts.a.{key}"


# parts that say in another form what a key of ``[defaults]`` says
TABLED = {k: v for k, v in DISK.items() if k != "lift"} | {
    "motion_table": [[0.0, 0.0], [90.0, 5.0], [180.0, 10.0], [270.0, 5.0]]
}
CONTOURED = {**DISK, "contour": {"rise_angle_deg": 75.0}}
GEAR = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20}
WORM = {"kind": "worm", "module": 2.0, "thread_length": 40.0}
OVAL = {"kind": "noncircular_gear", "module": 2.0, "number_of_teeth": 30, "centrode": "oval"}
DRIVEN = {k: v for k, v in OVAL.items() if k != "module"} | {"axis_ratio": 1.4}
GENEVA = {"kind": "geneva_wheel", "number_of_slots": 6, "centre_distance": 60.0}
WHEEL = {"kind": "worm_wheel", "module": 2.0, "number_of_teeth": 30}
RING = {"kind": "ring_gear", "module": 2.0, "number_of_teeth": 40}
KEY = {"kind": "key", "length": 20.0}
SPROCKET = {"kind": "sprocket", "number_of_teeth": 17}
SHAFT = {"kind": "shaft", "steps": [{"diameter": 20.0, "length": 30.0}]}
SAID: list[tuple[dict[str, object], str, object]] = [
    ({**SHAFT, "centre_holes": {"diameter": 4.0}}, "bore_diameter", 6.0),
    (TABLED, "phases", PHASES),
    ({**DISK, "phases": PHASES}, "motion_table", TABLED["motion_table"]),
    (CONTOURED, "phases", PHASES),
    (CONTOURED, "motion_table", TABLED["motion_table"]),
    ({**WORM, "lead_angle_deg": 6.0}, "diameter_quotient", 8.0),
    ({**WORM, "diameter_quotient": 8.0}, "lead_angle_deg", 6.0),
    ({**SPROCKET, "pitch": 12.7, "roller_diameter": 8.5, "inner_width": 7.75}, "chain", "08B-1"),
    ({**SPROCKET, "chain": "08B-1"}, "pitch", 15.0),
    ({**SPROCKET, "chain": "08B-1"}, "roller_diameter", 9.0),
    ({**GEAR, "tip_rounding": 0.1}, "tip_chamfer", 0.1),
    ({**GEAR, "tip_chamfer": 0.1}, "tip_rounding", 0.1),
    ({**OVAL, "axis_ratio": 1.4}, "centre_distance", 80.0),
    ({**DRIVEN, "centre_distance": 80.0}, "module", 2.0),
    (GENEVA, "crank_radius", 25.0),
    ({**SHAFT, "bore_diameter": 6.0}, "centre_holes", {"diameter": 4.0}),
    ({**DISK, "phases": PHASES}, "contour", {"rise_angle_deg": 75.0}),
    ({**WHEEL, "working_centre_distance": 41.0}, "profile_shift_coefficient", 0.1),
    ({**WHEEL, "profile_shift_coefficient": 0.1}, "working_centre_distance", 41.0),
    ({**RING, "rounded_root": {}}, "cutter", {"number_of_teeth": 20}),
    ({**BARREL, "length": 60.0}, "end_margin", 4.0),
    ({**KEY, "shaft_diameter": 20.0}, "width", 5.0),
    ({**KEY, "width": 6.0, "height": 6.0}, "shaft_diameter", 20.0),
    ({**OVAL, "eccentricity": 0.3}, "axis_ratio", 1.4),
    ({**OVAL, "axis_ratio": 1.4}, "eccentricity", 0.3),
]


@pytest.mark.parametrize(("form", "key", "value"), SAID)
def test_what_a_part_says_in_another_form_needs_no_default(form: dict[str, object], key: str, value: object) -> None:
    scene = scene_from_dict({"defaults": {key: value}, "parts": {"a": dict(form)}}, "s", "s")
    make_parts(scene, "s")
    assert scene.parts == scene_from_dict({"parts": {"a": dict(form)}}, "s", "s").parts
    with pytest.raises(SceneError):
        make_parts(scene_from_dict({"parts": {"a": {**form, key: value}}}, "s", "s"), "s")


def test_a_motion_of_its_own_needs_no_default_of_another_form() -> None:
    """Phases for all cams were refused where one has a table."""
    scene = {"defaults": {"phases": PHASES, "lift": 9.0}, "parts": {"a": TABLED, "b": {**DISK}, "c": {**DISK}}}
    del scene["parts"]["b"]["lift"]
    made, _ = make_parts(scene_from_dict(scene, "s", "s"), "s")
    assert [made[name].thing.motion.lift for name in "abc"] == pytest.approx([10.0, 9.0, 10.0])


def test_of_a_lift_and_a_swing_for_all_each_follower_takes_its_own() -> None:
    own = {"slide": GROOVE, "arm": SWUNG, "wedge": WEDGE, "cam": {**DISK, "phases": PHASES}}
    parts = {name: {k: v for k, v in keys.items() if k not in ("lift", "swing_deg")} for name, keys in own.items()}
    made = scene_from_dict({"defaults": {"lift": 10.0, "swing_deg": 9.0}, "parts": parts}, "s", "s").parts
    assert {name: (keys.lift, keys.swing_deg) for name, keys in made.items()} == {
        "slide": (10.0, 0.0),
        "arm": (0.0, 9.0),
        "wedge": (10.0, 0.0),
        "cam": (10.0, 0.0),
    }


def test_rollers_of_a_second_cam_stand_as_its_first_one_moves_its_own() -> None:
    first = {**DISK, "phases": PHASES}
    for owner, key, value in ((first, "roller_angle_deg", 150.0), (SWINGING, "roller_distance", 130.0)):
        parts = {"first": owner, "second": {"kind": "conjugate_cam", "of": "first"}}
        scene = scene_from_dict({"defaults": {key: value}, "parts": parts}, "s", "s")
        assert getattr(scene.parts["second"], key) is None


def test_a_position_is_not_one_for_all() -> None:
    """It was refused at the second part, as that of the first."""
    with pytest.raises(SceneError) as refused:
        scene_from_dict({"defaults": {"position": 3}, "parts": {"a": BEVEL, "b": BEVEL}}, "s", "s")
    assert (refused.value.key, refused.value.code) == ("defaults.position", "not_one_for_all")
