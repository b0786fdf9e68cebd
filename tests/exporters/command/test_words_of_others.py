"""Words and numbers of other programs in a scene: each refusal says which key of ours has the same."""

from __future__ import annotations

import json
import math
import re
import tomllib
from pathlib import Path

import pytest

from exporters.documents.topics import TOPICS
from parts.base.refusal import SYNONYMS
from parts.scene.files import built_in_scenes
from tests.exporters.making import Keys, run, write_scene

_PHASES = [{"move": "rise", "angle_deg": 180.0, "law": "sine"}, {"move": "return_", "angle_deg": 180.0, "law": "sine"}]
_CAM: Keys = {"kind": "cam", "follower": "roller", "lift": 10.0, "phases": _PHASES}
_SPUR: Keys = {"kind": "spur_gear", "number_of_teeth": 20}
_WORM: Keys = {"kind": "worm", "module": 2.0, "number_of_starts": 1, "thread_length": 30.0}
_PULLEY: Keys = {"kind": "timing_pulley", "number_of_teeth": 20, "belt": "GT2"}
_LOBED: Keys = {"kind": "cycloidal_disc", "pin_circle_diameter": 50.0, "pin_diameter": 5.0, "eccentricity": 1.0}
_BEVEL: Keys = {"kind": "bevel_gear", "module": 2.0, "number_of_teeth": 20, "mate_number_of_teeth": 20}


def told(tmp_path: Path, capsys: pytest.CaptureFixture[str], part: Keys) -> str:
    """The refusal of a scene of one part."""
    assert run("check", write_scene(tmp_path / "s.toml", {"g": part}, [{"format": "stl"}])) == 2
    return capsys.readouterr().err


@pytest.mark.parametrize(
    ("part", "word", "number", "ours", "value"),
    [
        (_SPUR, "diametral_pitch", 24, "module", 127 / 120),
        (_SPUR, "DP", 25.4, "module", 1.0),
        (_SPUR, "circular_pitch", 5.0, "module", 1.5915494309189535),
        (_SPUR, "pitch_diameter", 50.0, "module", 2.5),
        (_SPUR | {"helix_angle_deg": 60.0}, "pitch_diameter", 50.0, "module", 1.25),
        (_WORM, "pitch_diameter", 25.0, "diameter_quotient", 12.5),
        (_CAM | {"base_circle_radius": 40.0}, "roller_diameter", 10.0, "follower_radius", 5.0),
        (_CAM | {"follower_radius": 5.0}, "base_circle_diameter", 80.0, "base_circle_radius", 40.0),
        (_SPUR | {"module": 2.0}, "tip_radius", 21.5, "tip_diameter", 43.0),
        (_LOBED, "number_of_pins", 11, "number_of_lobes", 10),
        (_CAM | {"follower_radius": 5.0}, "max_pressure_angle_deg", 30.0, "least_transmission_angle_deg", 60.0),
        (_CAM | {"follower_radius": 5.0}, "pressure_angle_deg", 30.0, "least_transmission_angle_deg", 60.0),
    ],
)
def test_a_number_of_another_program_is_told_as_ours(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], part: Keys, word: str, number: float, ours: str, value: float
) -> None:
    """And the scene takes what was told."""
    line = re.search(r"(\w+) = (\S+) is the same\n", told(tmp_path, capsys, part | {word: number}))
    assert line is not None
    assert line[1] == ours
    assert math.isclose(float(line[2]), value, rel_tol=4e-16)
    mended = part | tomllib.loads(line[0].removesuffix(" is the same\n"))
    assert run("check", write_scene(tmp_path / "s.toml", {"g": mended}, [{"format": "stl"}])) == 0


def test_the_length_of_a_thread_leads_from_the_page_to_the_part_and_back(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Who took the page's word for the part was sent to the power module."""
    worm = {key: value for key, value in _WORM.items() if key != "thread_length"}
    assert "did you mean thread_length?" in told(tmp_path, capsys, worm | {"worm_length": 30.0})
    assert run("calc", "worm", "module=2", "number_of_teeth=30", "thread_length=30") == 2
    assert "did you mean worm_length?" in capsys.readouterr().err


def test_a_calculation_tells_it_too(capsys: pytest.CaptureFixture[str]) -> None:
    pair = ("calc", "gear-pair", "first.number_of_teeth=12", "second.number_of_teeth=24")
    assert run(*pair, "diametral_pitch=8") == 2
    assert "module = 3.175 is the same" in capsys.readouterr().err
    # what is no number, and what stands there already
    for words in (("circular_pitch=pi",), ("module=2", "circular_pitch=6.5")):
        assert run("calc", "spur", "number_of_teeth=12", *words) == 2
        assert "is the same" not in capsys.readouterr().err


@pytest.mark.parametrize(
    ("part", "word", "value", "meant"),
    [
        (_SPUR | {"module": 2.0}, "teeth_number", 19, "number_of_teeth"),
        (_SPUR | {"module": 2.0}, "herringbone", True, "double_helical"),
        (_SPUR | {"module": 2.0}, "hub_diameter", 12.0, "hub.diameter"),
        (_SPUR | {"module": 2.0}, "n_spokes", 5, "spokes.count"),
        (_SPUR | {"module": 2.0}, "backlash", 0.1, "circumferential_thinning"),
        (_WORM, "backlash", 0.1, "axial_thinning"),
        (_SPUR | {"module": 2.0}, "axle_hole", 5.0, "bore_diameter"),
        (_SPUR | {"module": 2.0}, "root_fillet", 0.2, "basic_rack.tip_radius_coefficient"),
        (_SPUR | {"module": 2.0}, "quality", 7, "accuracy"),
        (_SPUR | {"module": 2.0}, "text", "Z20", "label"),
        (_SPUR | {"module": 2.0}, "barrelling", 0.02, "crowning"),
        (_SPUR | {"module": 2.0}, "C_beta", 0.02, "crowning"),
        (_SPUR | {"module": 2.0}, "lengthwise_crowning", 0.02, "crowning"),
        (_SPUR | {"module": 2.0}, "spoke_width", 3.0, "spokes.width"),
        (_SPUR | {"module": 2.0}, "clearance", 0.3, "basic_rack.tip_clearance_coefficient"),
        (_SPUR | {"module": 2.0}, "bolt_circle_diameter", 30.0, "holes.pitch_circle_diameter"),
        (_LOBED, "teeth", 10, "number_of_lobes"),
        (_BEVEL, "helix_angle", 30.0, "spiral_angle_deg"),
        (_SPUR | {"module": 2.0}, "root_diameter", 30.0, None),
        (_BEVEL, "cone_distance", 30.0, None),
        (_BEVEL, "pitch_angle_deg", 45.0, None),
        (_PULLEY, "profile", "GT2", "belt"),
        (_CAM | {"follower_radius": 5.0}, "base_radius", 30.0, "base_circle_radius"),
        (_CAM | {"follower_radius": 5.0, "base_circle_radius": 30.0}, "offset", 5.0, "follower_offset"),
    ],
)
def test_a_word_of_another_program_leads_to_ours_or_nowhere(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], part: Keys, word: str, value: object, meant: str | None
) -> None:
    refusal = told(tmp_path, capsys, part | {word: value})
    found = re.search(r"did you mean (\S+)\?", refusal)
    assert (found[1] if found else None) == meant


@pytest.mark.parametrize("word", ["horizontal_expansion", "xy_size_compensation"])
def test_what_slicers_call_an_offset_leads_to_it(tmp_path: Path, capsys: pytest.CaptureFixture[str], word: str) -> None:
    part = _SPUR | {"module": 2.0}
    assert run("check", write_scene(tmp_path / "s.toml", {"g": part}, [{"format": "stl", word: -0.1}])) == 2
    assert "did you mean offset?" in capsys.readouterr().err


def test_a_speed_of_a_drive_is_its_turns(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It was sent to the exports."""
    scene = write_scene(tmp_path / "s.toml", {"g": _SPUR | {"module": 2.0}}, [{"format": "stl"}])
    scene.write_text(scene.read_text("utf-8") + '[[drives]]\ninstance = "g"\nrpm = 10\n', "utf-8")
    assert run("check", scene) == 2
    assert capsys.readouterr().err.endswith("did you mean turns?\n")


def test_the_driven_one_of_a_pair_is_the_mate(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    gear = {"kind": "noncircular_gear", "module": 2.0, "number_of_teeth": 30, "centrode": "oval", "axis_ratio": 1.4}
    assert told(tmp_path, capsys, gear | {"role": "driven"}).endswith("did you mean mate?\n")


_TOOTHED = _SPUR | {"module": 2.0}


@pytest.mark.parametrize(
    ("part", "key", "value"),
    [
        (_TOOTHED, "hub", 12.0), (_TOOTHED, "spokes", 5), (_TOOTHED, "bore", True), (_TOOTHED, "holes", 5),
        (_TOOTHED, "web", 3.0), (_PULLEY, "flanges", True),
    ],
)  # fmt: skip
def test_what_other_programs_tell_by_one_number_is_shown_as_a_table(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], part: Keys, key: str, value: object
) -> None:
    """And a larger part takes the line that is shown."""
    line = re.search(rf"; like ({key} = {{ .* }})\n", told(tmp_path, capsys, part | {key: value}))
    assert line is not None
    large = part | {"number_of_teeth": 60} | ({"bore_diameter": 6.0} if key in ("hub", "web") else {})
    scene = write_scene(tmp_path / "s.toml", {"g": large | tomllib.loads(line[1])}, [{"format": "stl"}])
    assert run("check", scene) == 0


@pytest.mark.parametrize(
    ("word", "meant"),
    [
        ("crown_gear", "face_gear"), ("internal_gear", "ring_gear"), ("elliptical_gear", "noncircular_gear"),
        ("cylindrical_cam", "barrel_cam"), ("maltese_cross", "geneva_wheel"), ("screw_gear", "crossed_helical_pair"),
        ("cycloidal_drive", "cycloidal_reducer"), ("disc_cam", "cam"), ("detent", "pawl"),
        ("planetary_gear", "planetary_set"),
        ("harmonic_drive", None), ("globoidal_cam", None), ("sector_gear", "spur_gear"),
    ],
)  # fmt: skip
def test_a_kind_of_another_program_leads_to_ours_or_nowhere(
    capsys: pytest.CaptureFixture[str], word: str, meant: str | None
) -> None:
    assert run("new", word) == 2
    found = re.search(r"did you mean (\S+)\?", capsys.readouterr().err)
    assert (found[1] if found else None) == meant


def test_all_synonyms_lead_to_words_of_ours(capsys: pytest.CaptureFixture[str]) -> None:
    """Keys, values and kinds of the schema, keys of calculations, their topics, built-in scenes."""
    assert run("schema") == 0
    known, left = {*TOPICS, *built_in_scenes()}, [json.loads(capsys.readouterr().out)]
    while left:
        node = left.pop()
        if isinstance(node, dict):
            known |= {*node.get("properties", ()), *map(str, node.get("enum", ())), str(node.get("const"))}
            left += node.values()
        elif isinstance(node, list):
            left += node
    for topic in TOPICS:
        assert run("calc", topic, "--keys") == 0
        keys = capsys.readouterr().out
        known |= {*re.findall(r"^#? ?([\w.]+) = ", keys, re.MULTILINE), *re.findall(r'"([^"]+)"', keys)}
    lost = {f"{word} | {ours}" for word, all_ours in SYNONYMS.items() for ours in all_ours
            if ours not in (word, *known) and ours.partition(".")[0] not in known}  # fmt: skip
    assert not lost
