"""The exploded view of a scene by the command: every instance, its number on what is seen of it, both languages."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
import shapely

from exporters.command.cli import main

SCENE = """
[scene]
title = {{ en = "Stack", uk = "Стопка" }}
language = "{language}"

[parts.base]
kind = "plate"
width = 90.0
height = 90.0
face_width = 8.0
position = 1
title = {{ en = "Base", uk = "Основа" }}

[parts.ring]
kind = "turned"
points = [{{ r = 20.0, z = 0.0 }}, {{ r = 35.0, z = 0.0 }}, {{ r = 35.0, z = 6.0 }}, {{ r = 20.0, z = 6.0 }}]
position = 2
title = {{ en = "Ring", uk = "Кільце" }}

[parts.pin]
kind = "turned"
points = [{{ r = 0.0, z = 0.0 }}, {{ r = 4.0, z = 0.0 }}, {{ r = 4.0, z = 20.0 }}, {{ r = 0.0, z = 20.0 }}]
position = 3
title = {{ en = "Pin", uk = "Палець" }}

[parts.slug]
kind = "turned"
points = [{{ r = 0.0, z = 0.0 }}, {{ r = 3.0, z = 0.0 }}, {{ r = 3.0, z = 3.0 }}, {{ r = 0.0, z = 3.0 }}]
position = 4

[instances]
base = {{ part = "base", at = [0, 0, 0] }}
ring = {{ part = "ring", at = [0, 0, 8] }}
pin_1 = {{ part = "pin", at = [27, 0, 14] }}
pin_2 = {{ part = "pin", at = [-27, 0, 14] }}
slug = {{ part = "slug", at = [0, 0, -3] }}

[[steps]]
bring = ["pin_1", "pin_2"]
to = "ring"
along = [0.0, 0.0, -1.0]

[[steps]]
bring = ["ring"]
to = "base"
along = [0.0, 0.0, -1.0]

[[steps]]
bring = ["slug"]
to = "base"
along = [0.0, 0.0, 1.0]

[[exports]]
format = "stl"
"""


def loops(data: str) -> list[np.ndarray]:
    """Closed loops of a path of steps."""
    found = []
    for piece in data.split("M")[1:]:
        start, _, steps = piece.rstrip("z").partition("l")
        rows = [tuple(map(float, pair.split(","))) for pair in (start, *steps.split())]
        found.append(np.cumsum(rows, axis=0))
    return found


def drawn(text: str) -> list[tuple[str, shapely.geometry.base.BaseGeometry]]:
    """Instances from behind, with what each covers."""
    outlines = {
        name: [shapely.Polygon(loop) for loop in loops(group.split('class="o" d="')[1].split('"')[0])]
        for name, group in re.findall(r'<g id="(d\d+)">(.*?)</g>', text, re.DOTALL)
    }
    shift = float(re.findall(r"translate\((\d+)", text)[0])
    rows = re.findall(r'<use id="(\w+)" xlink:href="#(d\d+)" x="([-\d.]+)" y="([-\d.]+)"', text)
    return [
        (name, shapely.transform(
            shapely.union_all(outlines[of]), lambda xy, x=float(x), y=float(y): xy + np.array([x + shift, y])))
        for name, of, x, y in rows
    ]  # fmt: skip


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("language", "words"), [("en", ("Stack", "2  Ring")), ("uk", ("Стопка", "3  Палець × 2"))])
def test_numbers_stand_on_what_is_seen(language: str, words: tuple[str, ...], tmp_path: Path) -> None:
    file = tmp_path / "stack.toml"
    file.write_text(SCENE.format(language=language), encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path)]) == 0
    text = (tmp_path / "stack" / "stack.exploded.preview.svg").read_text(encoding="utf-8")
    assert all(word in text for word in words)
    things = drawn(text)
    names = [name for name, _ in things]
    # from behind: what stands higher, or nearer on the left, is drawn over the rest
    assert names == ["slug", "base", "ring", "pin_1", "pin_2"] or names == ["slug", "base", "ring", "pin_2", "pin_1"]
    ends = [shapely.Point(float(x), float(y)) for x, y in re.findall(r'<circle cx="([\d.]+)" cy="([\d.]+)"', text)]
    numbers = re.findall(r'text-anchor="middle">(\d+)<', text)
    own = {"1": "base", "2": "ring", "3": "pin", "4": "slug"}
    # the slug stands behind the base and has no number in the picture
    assert sorted(numbers) == ["1", "2", "3"]
    assert text.count(": 4<") == 1
    for number, end in zip(numbers, ends, strict=True):
        seen = [name for name, shape in things if shape.contains(end)]
        assert seen[-1].startswith(own[number])


def test_a_plate_of_one_part_has_the_view_of_all_and_long_names_stay_within_it(tmp_path: Path) -> None:
    file, name = tmp_path / "stack.toml", "Кільце " + "дуже широке " * 8
    bed = "[beds.b]\nwidth = 200.0\ndepth = 200.0\nheight = 100.0\n[[exports]]\n"
    plate = f'{bed}format = "3mf"\npurpose = "plate"\nparts = ["pin"]\n'
    text = SCENE.format(language="uk").replace("Кільце", name).replace('[[exports]]\nformat = "stl"\n', plate)
    file.write_text(text, encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path), "--no-verify", "-q"]) == 0
    picture = (tmp_path / "stack" / "stack.exploded.preview.svg").read_text(encoding="utf-8")
    left, _, width, _ = map(float, re.findall(r'viewBox="([^"]+)"', picture)[0].split())
    texts = re.findall(r'<text x="(\d+)" y="[-\d.]+"[^>]*>([^<]+)<', picture)
    assert any(name.strip() in words for _, words in texts)
    # letters of 13 are 0.6 of that wide
    assert max(float(x) + 0.6 * 13 * len(words) for x, words in texts) < left + width


def test_without_an_order_there_is_no_such_view(tmp_path: Path) -> None:
    file = tmp_path / "stack.toml"
    file.write_text(re.sub(r"\[\[steps\]\](.|\n)*(?=\[\[exports)", "", SCENE.format(language="en")), encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path)]) == 0
    assert not list((tmp_path / "stack").glob("*.exploded*"))
