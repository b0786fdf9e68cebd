"""``higherpair calc train`` of scenes: wheels numbered as the sources number them, of equal satellites one."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

from exporters.documents.topics import calculate
from parts.base.refusal import SceneError
from parts.scene.load import load_scene, make_parts
from parts.scene.placing import place
from tests.parts.scene.test_trains import DRIVE, FREE, GEAR, JAMES

# the axes of both gears stand on the plate
DAVID = (
    "".join(GEAR.format(name, z) for name, z in (("a", 50), ("b", 30), ("c", 20), ("d", 60)))
    + '[parts.arm]\nkind = "plate"\nwidth = 20.0\nheight = 20.0\nface_width = 3.0\n[instances.d]\nheld = true\n'
    + '[[mates]]\nkind = "external_gear_pair"\nfirst = "a"\nsecond = "b"\n'
    + '[[mates]]\nkind = "fixed"\nfirst = "b"\nsecond = "c"\noffset = [0, 0, 8]\n'
    + '[[mates]]\nkind = "external_gear_pair"\nfirst = "c"\nsecond = "d"\ndirection_deg = 180.0\n'
    + '[[mates]]\nkind = "coaxial"\nfirst = "a"\nsecond = "arm"\nheight = 20.0\n'
    + '[[mates]]\nkind = "carried"\nfirst = "arm"\nsecond = "b"\n'
)


def calculated(folder: Path, text: str, *keys: str) -> dict[str, Any]:
    file = folder / "set.toml"
    file.write_text(text, encoding="utf-8")
    return json.loads(calculate("train", (str(file), *keys), "json", "en"))


def test_james_with_four_satellites(tmp_path: Path) -> None:
    data = calculated(tmp_path, JAMES + DRIVE.format("sun", ""), "mesh_efficiency=0.98")
    values = data["values"]
    assert (values["moving_links"], values["lower_pairs"], values["higher_pairs"]) == (3, 3, 2)
    assert data["exact"] == {"ratio": "4", "driver": "1", "driven": "H"}
    assert any("1 sun, 2 planet_1, 3 ring, H carrier" in note for note in data["notes"])
    assert values["efficiency"] == pytest.approx((1 + 3 * 0.98**2) / 4)
    assert [row["F_t"] > 0 for row in data["flows_1"]] == [True, True]


def test_a_free_ring_asks_for_a_second_drive(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="left free"):
        calculated(tmp_path, FREE)
    both = FREE + DRIVE.format("sun", "turns = 3") + DRIVE.format("ring", "turns = -1")
    assert {s["symbol"]: s["value"] for s in calculated(tmp_path, both)["steps"]}["ω_H"] == 0.0
    data = calculated(tmp_path, FREE, "speeds.1=120", "speeds.3=10", "driven=H")
    assert data["exact_turns"]["H"] == {"1": "1/4", "3": "3/4"}


def test_both_rims_of_a_satellite_have_one_number(tmp_path: Path) -> None:
    data = calculated(tmp_path, DAVID, "driver=1")
    assert any("1 a, 2 b, 2' c, 3 d, H arm" in note for note in data["notes"])
    assert data["exact"]["ratio"] == "-4/5"
    assert calculated(tmp_path, DAVID + DRIVE.format("arm", ""))["exact"] == {
        "ratio": "-5/4",
        "driver": "H",
        "driven": "1",
    }


SCENES = [("james", "4", "H"), ("ferguson", "10000", "1"), ("practicum_example_1", "20", "6"),
          ("practicum_example_2", "32", "H"), ("compound_two_stage", "108/5", "H2")]  # fmt: skip


@pytest.mark.parametrize(("scene", "ratio", "driven"), SCENES)
def test_scenes_of_the_sources(scene: str, ratio: str, driven: str) -> None:
    data = json.loads(calculate("train", (scene,), "json", "en"))
    assert (data["exact"]["ratio"], data["exact"]["driven"]) == (ratio, driven)


def test_built_in_scenes() -> None:
    data = json.loads(calculate("train", ("idler_train",), "json", "en"))
    assert data["exact"]["ratio"] == "31/17"
    assert any("1 driver, 2 idler, 3 wheel" in note for note in data["notes"])
    with pytest.raises(SceneError, match="pair of gears"):
        calculate("train", ("laser_gear",), "json", "en")


def test_what_nothing_moves_is_named_by_number(tmp_path: Path) -> None:
    """A second rim is one body with the first: it is named once."""
    with pytest.raises(SceneError, match="left free") as caught:
        calculated(tmp_path, DAVID.replace("held = true", ""))
    assert "H, 2, 3" in str(caught.value)


BEVEL = (
    '[parts.{}]\nkind = "bevel_gear"\nmodule = 2.0\nnumber_of_teeth = {}\nmate_number_of_teeth = {}\nface_width = 6.0\n'
)
# an axle: the pinion turns the crown, which carries the satellites
AXLE = (
    "".join(BEVEL.format(*one) for one in (("side", 16, 10), ("sat", 10, 16), ("crown", 41, 11), ("pinion", 11, 41)))
    + '[instances]\nleft = { part = "side" }\none = { part = "sat" }\nother = { part = "sat" }\n'
    + 'right = { part = "side" }\n'
    + '[[mates]]\nkind = "bevel_pair"\nfirst = "left"\nsecond = "one"\n'
    + '[[mates]]\nkind = "bevel_pair"\nfirst = "left"\nsecond = "other"\ndirection_deg = 180.0\n'
    + '[[mates]]\nkind = "bevel_pair"\nfirst = "one"\nsecond = "right"\n'
    + '[[mates]]\nkind = "bevel_pair"\nfirst = "other"\nsecond = "right"\n'
    + '[[mates]]\nkind = "coaxial"\nfirst = "left"\nsecond = "crown"\nheight = -30.0\n'
    + '[[mates]]\nkind = "carried"\nfirst = "crown"\nsecond = "one"\n'
    + '[[mates]]\nkind = "carried"\nfirst = "crown"\nsecond = "other"\n'
    + '[[mates]]\nkind = "bevel_pair"\nfirst = "crown"\nsecond = "pinion"\n'
)


def speeds(data: dict[str, Any]) -> dict[str, float]:
    return {step["symbol"]: step["value"] for step in data["steps"] if step["symbol"].startswith("ω")}


def test_a_bevel_differential_by_willis() -> None:
    """Side wheels sum up to twice the cage; a satellite turns against it by 24/16 of what a side wheel does."""
    data = json.loads(calculate("train", ("bevel_differential",), "json", "en"))
    assert data["exact_turns"] == {
        "1": {"H": "0", "1": "1"},
        "2": {"H": "3/2", "1": "-3/2"},
        "3": {"H": "2", "1": "-1"},
        "H": {"H": "1", "1": "0"},
    }
    assert speeds(data) == pytest.approx({"ω_H": 1.0, "ω_1": 1.5, "ω_2": -1.5 * (1.5 - 1.0), "ω_3": 2 * 1.0 - 1.5})
    assert data["values"]["degree_of_freedom"] == 2


@pytest.mark.parametrize("driven", ["left", "right"])
def test_an_axle_turns_as_its_drives_do(driven: str, tmp_path: Path) -> None:
    """Beside a differential the bevels' signs count: both apexes up, crown and pinion turn in opposite ways.

    The axis of the right wheel points down: its own turn is told about that of the cage, against its sign.
    """
    drives = DRIVE.format("pinion", "turns = 41") + DRIVE.format(driven, "turns = 3")
    data = calculated(tmp_path, AXLE + drives)
    cage, wheel = -11.0, 3.0 if driven == "left" else -3.0
    found = speeds(data)
    names = dict(
        reversed(pair.split())
        for pair in next(n for n in data["notes"] if "in the scene" in n).split(": ")[1].split(", ")
    )
    assert found["ω_H"] == pytest.approx(cage)
    assert found[f"ω_{names[driven]}"] == pytest.approx(wheel)
    other = {"left": "right", "right": "left"}[driven]
    assert found[f"ω_{names[other]}"] == pytest.approx(2 * cage - wheel)


def test_a_reducer_of_bevel_and_spur_has_no_sign_of_its_bevels() -> None:
    """Guidelines: the ratio of a bevel pair has no sign; nothing is said of directions then."""
    data = json.loads(calculate("train", ("bevel_reducer",), "json", "en"))
    assert data["exact"]["ratio"] == "-6"
    for one in (data, json.loads(calculate("train", ("case=trains_3",), "json", "en"))):
        assert not any("turn the same way" in note or "opposite ways" in note for note in one["notes"])
        assert any("no sign" in note for note in one["notes"])


def test_bevels_that_are_typed_face_each_other_unless_their_signs_are_told() -> None:
    """Willis: with the last wheel held 1 - (-1) = 2; of wheels on one side of a stepped satellite 1 - 3."""
    typed = ("teeth=[20,14,20]", "meshes=1-2 bevel, 2-3 bevel", "carriers.H=2", "held=3")
    assert json.loads(calculate("train", typed, "json", "en"))["exact"]["ratio"] == "2"
    stepped = ("teeth={'1'=20,'2'=40,\"2'\"=20,'3'=30}", "meshes=1-2 bevel -, 2'-3 bevel -", "carriers.H=2", "held=3")
    assert json.loads(calculate("train", stepped, "json", "en"))["exact"]["ratio"] == "-2"


@pytest.mark.parametrize("name", ["worm_set_print", "power_table_print"])
def test_worms_turn_in_the_calculation_as_the_drives_turn_them(name: str) -> None:
    """A lone drive by its ratio; of a table's worms and disks every speed against what the drives of the scene give."""
    data = json.loads(calculate("train", (name,), "json", "en"))
    if name == "worm_set_print":
        assert data["exact"] == {"ratio": "15", "driver": "1", "driven": "2"}
        assert any("no sign" in note for note in data["notes"])
        return
    file = load_scene(name)
    parts, matings = make_parts(file, name)
    train = place(file.instances, file.drives, parts, matings, name).train
    assert train is not None
    turns = {key: sum(run.get(key, 0.0) for run in train.turned) for run in train.turned for key in run}
    told = sorted(abs(value) for value in speeds(data).values())
    worms = [key for key, spec in file.instances.items() if parts[spec.part or key].kind == "worm"]
    assert len(worms) == 2
    for key in worms:
        assert min(abs(abs(turns[key]) - value) for value in told) < 1e-9


@pytest.mark.parametrize("form", ["text", "md", "html"])
def test_a_ratio_of_whole_numbers_has_the_minus_of_all_others(form: str) -> None:
    """16/32 and 16/48 of bevel and spur wheels: u = 2 (-3) = -6, once as a product and once exactly."""
    page = calculate("train", ["bevel_reducer"], form, "en")
    assert "\N{MINUS SIGN}6" in page
    assert re.search(r"(?<![\w-])-\d", re.sub(r"<style>.*?</style>|<[^>]*>", "", page, flags=re.DOTALL)) is None
