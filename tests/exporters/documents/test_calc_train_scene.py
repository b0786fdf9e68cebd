"""``higherpair calc train`` of scenes: wheels numbered as the sources number them, of equal satellites one."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from exporters.documents.topics import calculate
from parts.base.refusal import SceneError
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
