"""The lessons of the practicum as sets: boards for ten groups, sheets with and without numbers, paper models."""

from __future__ import annotations

import re
from pathlib import Path

import ezdxf
import pytest
import shapely
from ezdxf.path import make_path

from exporters.command.cli import main
from parts.scene.load import load_scene, make_parts
from parts.scene.placing import place

LESSONS = [f"lesson_{number}" for number in range(1, 6)]


@pytest.mark.parametrize("name", LESSONS)
def test_a_lesson_stands_and_has_all_that_a_class_wants(name: str) -> None:
    scene = load_scene(name)
    parts, matings = make_parts(scene, name)
    placing = place(scene.instances, scene.drives, parts, matings, name)
    assert placing.off_centre == ()
    assert all(condition.met for mate in placing.mates for condition in mate.conditions)
    (board,) = scene.boards.values()
    assert (board.width, board.height, board.thickness, board.sets) == (600, 400, 3, 10)
    made = {(e.purpose, e.name, e.cells) for e in scene.exports if e.format == "pdf"}
    asked = next(purpose for purpose, told, _ in made if told == "students")
    assert made == {(asked, "students", "empty"), (asked, "teacher", "numbers"), ("model", "paper", "numbers")}
    assert {e.format for e in scene.exports if e.purpose == "board"} == {"dxf", "svg"}
    # no shift that students find stands engraved on their model
    names = [n for part in parts.values() if (n := part.keys.label or part.name) and isinstance(n, str)]
    assert not [n for n in names if re.search(r"\bx\W*0[.,]\d", n)]


PAIR = """
[defaults]
module = 4.0
[parts.pinion]
kind = "spur_gear"
number_of_teeth = 13
profile_shift_coefficient = 0.694
[parts.wheel]
kind = "spur_gear"
number_of_teeth = 21
profile_shift_coefficient = 0.384
[[mates]]
kind = "external_gear_pair"
first = "pinion"
second = "wheel"
[[exports]]
format = "sheet"
name = "students"
cells = "empty"
[[exports]]
format = "sheet"
name = "teacher"
"""


def test_students_find_the_numbers_themselves(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "s.toml"
    file.write_text(PAIR, encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path)]) == 0
    texts = {
        name: re.findall(r"<text[^>]*>([^<]*)", (tmp_path / "s" / f"s.{name}.1.svg").read_text("utf-8"))
        for name in ("students", "teacher")
    }
    # (3.4) of the practicum: m (z1 + z2) / 2 cos 20 / cos 26.9331
    for answer in ("71.673", "26.9331°", "0.694"):
        assert answer in texts["teacher"]
        assert answer not in texts["students"]
    for given in ("4", "13", "21"):
        assert given in texts["students"]
    assert not any(re.search(r"= -?\d", text) for text in texts["students"])
    file.write_text(PAIR.replace('format = "sheet"\nname = "students"', 'format = "dxf"'), encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path)]) == 2
    assert "exports[1].cells" in capsys.readouterr().err


@pytest.mark.heavy
@pytest.mark.parametrize("name", LESSONS)
def test_a_lesson_builds_whole_in_both_languages(name: str, tmp_path: Path) -> None:
    for language in ("uk", "en"):
        assert main(["build", name, "--out", str(tmp_path / language), "--language", language]) == 0
    for file in sorted((tmp_path / "en" / name).glob("*.dxf")):
        outer, names = [], []
        for entity in ezdxf.readfile(file).modelspace():
            points = [(v.x, v.y) for v in make_path(entity).flattening(0.002)]
            (outer if entity.is_closed else names).append(points)
        edges = shapely.union_all([shapely.LinearRing(points) for points in outer])
        assert names
        assert shapely.distance(edges, shapely.MultiLineString(names)) >= 0.125
        left, low, right, high = edges.bounds
        assert min(left, low, 600 - right, 400 - high) >= 4.9
