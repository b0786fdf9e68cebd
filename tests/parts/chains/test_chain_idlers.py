"""Chain drives with idlers in scenes: links, slack, teeth against rollers, pictures, refusals."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import ezdxf
import pytest

from exporters.documents.topics import calculate
from exporters.production.check import scene_checks
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import place
from tests.exporters.making import run, table, write_scene

Keys = dict[str, Any]
SMALL: Keys = {"kind": "sprocket", "chain": "08B-1", "number_of_teeth": 17, "bore_diameter": 10.0}
LARGE = SMALL | {"number_of_teeth": 38}
IDLER: Keys = {"at": [110.0, -45.0], "number_of_teeth": 11, "outside": True}
ROLLER: Keys = {"at": [100.0, 82.0], "diameter": 30.0}
MATE: Keys = {"kind": "chain_drive", "first": "a", "second": "b", "centre_distance": 230.0}


def told(mate: Keys) -> dict[str, Any]:
    raw = {"parts": {"a": SMALL, "b": LARGE}, "mates": [MATE | mate], "drives": [{"instance": "a", "turns": 1.0}]}
    scene = scene_from_dict(raw, "t", "t")
    parts, matings = make_parts(scene, "t")
    placing = place(scene.instances, scene.drives, parts, matings, "t")
    (found,) = scene_checks(placing, parts, scene.drives, "en", contact=True)["mates"]
    return dict(found)


def test_a_tensioner_is_moved_to_where_the_chain_is_taut() -> None:
    found = told({"idlers": [ROLLER, IDLER]})
    assert found["number_of_links"] == 68
    assert found["verdict"] == "contact"
    place_ = [round(found[f"taut_idler_{axis}"], 3) for axis in "xy"]
    moved = told({"idlers": [ROLLER, IDLER | {"at": place_}], "number_of_links": 68})
    assert moved["chain_slack"] < 0.01
    assert moved["verdict"] == "contact"


@pytest.mark.heavy
def test_a_drawing_has_the_pitch_line_about_all_wheels(tmp_path: Path) -> None:
    """Arcs of the pitch circles of both and of the idler outside; of the roller one pin alone is seated."""
    mates = table("[[mates]]", MATE | {"idlers": [ROLLER, IDLER]})
    exports = [{"format": "dxf", "purpose": "assembly"}]
    scene = write_scene(tmp_path / "s.toml", {"a": SMALL, "b": LARGE}, exports, mates)
    assert run("build", scene, "--out", tmp_path) == 0
    (file,) = tmp_path.rglob("*.dxf")
    space = ezdxf.readfile(file).modelspace()
    radii = sorted(one.dxf.radius for one in space.query("ARC") if one.dxf.layer == "CENTRE")
    pitch = [1.0 / math.sin(math.pi / z) for z in (11, 17, 38)]
    for radius in pitch:
        assert min(abs(r / radii[-1] - radius / pitch[-1]) for r in radii) < 1e-6
    values = json.loads(calculate("chain", [str(scene)], "json", "en"))["values"]
    assert values["number_of_links"] == 68
    assert values["chain_slack"] == pytest.approx(68 * 12.7 - values["taut_loop_length"])


@pytest.mark.parametrize(
    ("mate", "words"),
    [
        ({"idlers": [IDLER | {"at": [110.0, -90.0]}]}, r"idlers\[1\].at = \[110.0, -90.0\]"),
        ({"idlers": [IDLER], "number_of_links": 60}, r"number_of_links = 60: .*; 6\d works"),
        ({"idlers": [IDLER], "number_of_links": 80}, r"number_of_links = 80: .*; 6\d works"),
        ({"idlers": [{"at": [0.0, 50.0]}]}, r"idlers\[1\].number_of_teeth"),
    ],
)
def test_idlers_that_do_not_go_are_refused_by_their_key(mate: Keys, words: str) -> None:
    with pytest.raises(SceneError, match=words):
        told(mate)


@pytest.mark.parametrize(
    "idlers",
    [
        # as it was: all of the slack hung in a short strand, over the teeth of the first sprocket: an overlap of 2 mm
        [{"at": [49.5, -60.86], "outside": True, "number_of_teeth": 20}],
        # as it was: a roller that is hardly touched has no seat between its strands: a traceback
        [{"at": [105.79, 2.58], "outside": True, "number_of_teeth": 7},
         {"at": [32.91, -56.11], "outside": True, "diameter": 5.97}, {"at": [109.74, -65.42], "number_of_teeth": 9}],
    ],
)  # fmt: skip
def test_slack_hangs_in_the_longest_strand_and_every_idler_has_a_seat(idlers: list[Keys]) -> None:
    assert told({"idlers": idlers})["verdict"] == "contact"
