"""``[defaults]``: what repeats is said once, and a refusal names where a key has come from."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import pytest

from exporters.command.cli import main
from exporters.production.plan import plan_build
from parts.base.refusal import SceneError
from parts.scene.load import load_scene, resolved, scene_from_toml
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
