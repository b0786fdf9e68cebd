"""Mates of a scene: the practicum's pair, an idler, refusals, and an overlap that fails the command."""

from __future__ import annotations

from pathlib import Path

import pytest

from exporters.command.cli import main
from parts.base.mate import Mating
from parts.base.part import Part
from parts.base.refusal import SceneError
from parts.scene.load import load_scene, make_parts, scene_from_toml

GEAR = '[parts.{}]\nkind = "spur_gear"\nmodule = {}\nnumber_of_teeth = {}\nprofile_shift_coefficient = {}\n'
MATE = '[[mates]]\nkind = "external_gear_pair"\nfirst = "{}"\nsecond = "{}"\n'


def parts_of(text: str) -> tuple[dict[str, Part], list[Mating]]:
    return make_parts(scene_from_toml(text.encode(), "s.toml", "s"), "s.toml")


def test_the_practicum_pair_is_that_of_lesson_3() -> None:
    """Reference cases 000.p3.alpha_w, a_w and r_a with the exact equalising shift."""
    parts, (mating,) = make_parts(load_scene("practicum_pair"), "practicum_pair")
    assert mating.pair.working_centre_distance == pytest.approx(179.18263740574994, abs=1e-9)
    assert parts["pinion"].circles["tip_diameter"] / 2 == pytest.approx(80.34263740574995, abs=1e-9)


def test_an_idler_takes_the_shorter_tip_of_its_two_mates() -> None:
    gears = GEAR.format("a", 2, 20, 0.2) + GEAR.format("b", 2, 25, 0.3) + GEAR.format("c", 2, 30, 0.6)
    alone, _ = parts_of(gears + MATE.format("b", "c"))
    less, _ = parts_of(gears + MATE.format("a", "b"))
    both, matings = parts_of(gears + MATE.format("a", "b") + MATE.format("b", "c"))
    tips = [parts["b"].circles["tip_diameter"] for parts in (alone, less, both)]
    assert tips[0] < tips[1]
    assert tips[2] == tips[0]
    assert {m.pair.second.tip_radius if m.second == "b" else m.pair.first.tip_radius for m in matings} == {tips[0] / 2}


@pytest.mark.parametrize(
    ("text", "named"),
    [
        (GEAR.format("a", 2, 20, 0) + GEAR.format("b", 3, 20, 0) + MATE.format("a", "b"), "parts.b.module"),
        (GEAR.format("a", 2, 20, 0) + MATE.format("a", "c"), "mates[1].second"),
        (GEAR.format("a", 2, 20, 0) + MATE.format("a", "a"), "mates[1].second"),
        (GEAR.format("a", 2, 20, 0) + '[[mates]]\nkind = "belt"\n', "mates[1].kind"),
        (GEAR.format("a", 2, 20, 0) + "[[mates]]\n", "mates[1].kind"),
    ],
)
def test_what_cannot_mesh_is_refused(text: str, named: str) -> None:
    with pytest.raises(SceneError) as caught:
        parts_of(text)
    assert named in str(caught.value)


def test_a_check_tells_contact_from_overlap(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "practicum_pair"]) == 0
    assert "CONTACT" in capsys.readouterr().out
    # tips that are given stay: these are so long that they strike the mate's root
    tip = "tip_diameter = 45.2\n"
    long = GEAR.format("a", 2, 20, 0) + tip + GEAR.format("b", 2, 20, 0) + tip
    scene = tmp_path / "long.toml"
    scene.write_text(long + MATE.format("a", "b"), encoding="utf-8")
    assert main(["check", str(scene)]) == 1
    assert "OVERLAP" in capsys.readouterr().out
