"""Instances fixed to each other: carried along by what they stand on, checked as solids."""

import math
import re
from pathlib import Path

import pytest

from exporters.command.cli import main
from exporters.production.check import scene_checks
from exporters.production.check_lines import check_lines, has_bad_verdict
from parts.scene.load import SceneError, make_parts, scene_from_toml
from parts.scene.placing import Placing, place

TOML = """
[parts.low]
kind = "spur_gear"
module = 2.0
number_of_teeth = 20
face_width = 5.0
[parts.high]
kind = "spur_gear"
module = 1.0
number_of_teeth = 15
face_width = 4.0
[parts.third]
kind = "spur_gear"
module = 1.0
number_of_teeth = 25
face_width = 4.0
[instances.low]
rotation_deg = 90.0
[instances.high]
[instances.third]
[[mates]]
kind = "fixed"
first = "low"
second = "high"
offset = [{offset}]
rotation_deg = 30.0
[[mates]]
kind = "external_gear_pair"
first = "high"
second = "third"
[[drives]]
instance = "low"
turns = 1.0
[checks]
interference = true
"""


def placed(offset: str, extra: str = "") -> tuple[Placing, dict, dict]:
    scene = scene_from_toml((TOML.format(offset=offset) + extra).encode(), "t", "t")
    parts, matings = make_parts(scene, "t")
    placing = place(scene.instances, scene.drives, parts, matings, "t")
    return placing, scene_checks(placing, parts, scene.drives, "en", contact=True), parts


def test_second_is_carried_and_turns_with_the_first() -> None:
    placing, checks, _ = placed("3.0, 0.0, 6.0")
    high = placing.instances[1]
    # 3 along x of a first that is turned by a quarter
    assert high.at == pytest.approx((0.0, 3.0, 6.0), abs=1e-12)
    assert high.rotation == pytest.approx(math.radians(120))
    assert placing.instances[2].at[2] == 6.0
    assert placing.turns[0] == pytest.approx({"low": 1.0, "high": 1.0, "third": -15 / 25})
    assert not has_bad_verdict(checks)
    assert "fixed" in check_lines(checks, "en")[0]


def test_solids_that_run_into_each_other_are_told() -> None:
    _, checks, _ = placed("0.0, 0.0, 4.0")
    assert has_bad_verdict(checks)
    assert (checks["solids"][0]["first"], checks["solids"][0]["second"]) == ("low", "high")


@pytest.mark.parametrize(
    ("at", "broken"), [("0.0, 0.0, 6.0", set()), ("0.0, 0.1, 6.0", {"centre_distance"}), ("0.0, 0.0, 5.5", {"height"})]
)
def test_between_placed_instances_it_only_checks(at: str, broken: set[str]) -> None:
    text = TOML.replace("[instances.low]", "[instances.low]\nat = [0.0, 0.0, 0.0]")
    text = text.replace("[instances.high]", f"[instances.high]\nat = [{at}]\nrotation_deg = 120.0")
    scene = scene_from_toml(text.format(offset="0.0, 0.0, 6.0").encode(), "t", "t")
    parts, matings = make_parts(scene, "t")
    found = place(scene.instances, scene.drives, parts, matings, "t").mates[0]
    assert found.only_checks
    assert {c.code for c in found.conditions if not c.met} == broken


def test_wrong_offset_names_the_key() -> None:
    with pytest.raises(SceneError, match="offset"):
        placed("0.0, 0.0")


# a set of David with wheels of its own, 48 / 72 and 45 / 75, below a wheel that is turned as the mesh with it asks
TWO_MESHES = """
[defaults]
module = 2.0
face_width = 8.0
[parts.first]
kind = "spur_gear"
number_of_teeth = 70
[parts.second]
kind = "spur_gear"
number_of_teeth = 31
[parts.low]
kind = "spur_gear"
number_of_teeth = 75
[parts.satellite]
kind = "spur_gear"
number_of_teeth = 45
[parts.twin]
kind = "spur_gear"
number_of_teeth = 48
[parts.high]
kind = "spur_gear"
number_of_teeth = 72
[[mates]]
kind = "external_gear_pair"
first = "first"
second = "second"
direction_deg = 17.0
[[mates]]
kind = "coaxial"
first = "second"
second = "low"
height = 20.0
[[mates]]
kind = "external_gear_pair"
first = "low"
second = "satellite"
[[mates]]
kind = "fixed"
first = "satellite"
second = "twin"
offset = [0.0, 0.0, 10.0]
[[mates]]
kind = "{kind}"
first = "second"
second = "high"
{place}
{turn}
[[mates]]
kind = "external_gear_pair"
first = "twin"
second = "high"
"""
PLACES = {
    "coaxial": "height = 30.0",
    "fixed": "offset = [0.0, 0.0, 30.0]",
    "parallel": "offset = [0.0, 0.0, 30.0]",
}


@pytest.mark.sampled(3)
@pytest.mark.parametrize("kind", PLACES)
@pytest.mark.parametrize("begun", [0.0, 100.0])
def test_the_turn_that_is_told_fits_where_it_is_typed(
    kind: str, begun: float, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Of a wheel that a mate with a key of its turn has placed: it is that key whose value is told."""
    file = tmp_path / "set.toml"

    def checked(turn: float) -> tuple[int, str]:
        file.write_text(TWO_MESHES.format(kind=kind, place=PLACES[kind], turn=f"rotation_deg = {turn!r}"))
        return main(["check", str(file)]), capsys.readouterr().out

    code, said = checked(begun)
    (told,) = re.findall(r"the mate that places high has rotation_deg = (\S+), (\S+) makes it fit", said)
    assert code == 1
    assert float(told[0]) == begun
    _, fits = checked(float(told[1]))
    assert "stands turned" not in fits
    assert "pair twin - high: a_w = 120.00000 mm" in fits
    assert float(re.findall(r"twin - high.*CONTACT, least gap (\S+) mm", fits)[0]) == pytest.approx(0.0, abs=1e-6)


def test_what_is_carried_has_no_key_of_its_turn(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It turns as other mates have it: the turn that fits is its own."""
    file = tmp_path / "set.toml"
    file.write_text(TWO_MESHES.format(kind="carried", place=PLACES["fixed"], turn=""))
    assert main(["check", str(file)]) == 1
    said = capsys.readouterr().out
    assert re.search(r"high stands turned by \S+ deg, rotation_deg = \S+ makes it fit twin", said)
    assert "has rotation_deg" not in said
