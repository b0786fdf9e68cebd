"""Mates of a scene: the practicum's pair, an idler, refusals, and an overlap that fails the command."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
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


KNIFE = """
[parts.cam]
kind = "cam"
follower = "pointed"
base_circle_radius = {base}
lift = 20.0
{motion}
[parts.knife]
kind = "follower"
end = "pointed"
tip_angle_deg = {tip}
stem_width = 12.0
[[mates]]
kind = "cam_follower"
first = "cam"
second = "knife"
"""
PHASES = """phases = [{ move = "rise", angle_deg = 60, law = "sine" }, { move = "dwell", angle_deg = 30 },
{ move = "return_", angle_deg = 60, law = "cosine" }, { move = "dwell", angle_deg = 210 }]"""


def overlap_of(text: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> tuple[float, float]:
    """Depth, mm, and cam angle, deg, that ``check`` tells."""
    (tmp_path / "knife.toml").write_text(text, encoding="utf-8")
    assert main(["check", str(tmp_path / "knife.toml"), "--json"]) == 1
    (told,) = json.loads(capsys.readouterr().out)["mates"]
    assert told["verdict"] == "overlap"
    return -told["gap"], told["drive_angle_deg"]


def test_a_blunt_knife_runs_into_an_eccentric_circle(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Circle of 30 mm, 10 mm off its axis: the tip's way leans by asin(1/3), and so far its flank cuts a chord off.

    The foot of the centre on the flank lies between points of it that are looked at.
    """
    text = KNIFE.format(base=20, motion="contour = { nose_radius = 30.0 }", tip=160)
    depth, angle = overlap_of(text, tmp_path, capsys)
    assert depth == pytest.approx(30 * (1 - math.sin(math.radians(80) + math.asin(1 / 3))), rel=1e-8)
    assert abs(angle - 180) == pytest.approx(90, abs=0.01)


def test_a_knife_runs_in_deepest_between_whole_degrees(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Flank against profile by brute force, every 0.01 degrees: of every fifth degree it was 0.0001 mm less."""
    depth, angle = overlap_of(KNIFE.format(base=30, motion=PHASES, tip=100), tmp_path, capsys)

    def radius(phi: np.ndarray) -> np.ndarray:
        share = phi / math.radians(60)
        return 30 + 20 * (share - np.sin(2 * math.pi * share) / (2 * math.pi))

    turned = np.linspace(0, math.radians(40), 40_001)
    profile = 1j * radius(turned) * np.exp(-1j * turned)
    found = []
    for phi in np.radians(np.arange(25.0, 25.31, 0.01)):
        flank = (np.linspace(3.5, 4.0, 201) * np.exp(1j * math.radians(40)) + 1j * radius(phi)) * np.exp(-1j * phi)
        # its nearest point of the profile, and the chord through that one's neighbours, 4e-8 mm off the curve
        near = np.array([np.abs(point - profile[20_000:30_000]).argmin() + 20_000 for point in flank])
        chord = profile[near + 1] - profile[near - 1]
        found.append((np.abs((np.conj(chord) * (flank - profile[near - 1])).imag / np.abs(chord)).max(), phi))
    most, at = max(found)
    assert depth == pytest.approx(most, rel=2e-6)
    assert angle == pytest.approx(math.degrees(at), abs=0.02)
