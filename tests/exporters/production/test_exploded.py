"""The exploded view of a scene by the command: every instance, its number on what is seen of it, both languages."""

from __future__ import annotations

import math
import re
from itertools import pairwise
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


@pytest.fixture(scope="module")
def stack(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The view of the stack."""
    folder = tmp_path_factory.mktemp("stack")
    (folder / "stack.toml").write_text(SCENE.format(language="en"), encoding="utf-8")
    assert main(["build", str(folder / "stack.toml"), "--out", str(folder), "-q"]) == 0
    return (folder / "stack" / "stack.exploded.preview.svg").read_text(encoding="utf-8")


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


def isometric(x: float, y: float, z: float) -> complex:
    """A place in rectangular isometry, seen from (1, -1, 1), y of the page downwards."""
    return complex((x + y) / math.sqrt(2), (x - y - 2 * z) / math.sqrt(6))


def test_everything_stands_where_its_order_puts_it_and_within_the_picture(stack: str) -> None:
    """Instances on the ways on which they come, leaders in two columns, words below: all of it by plain isometry."""
    things = dict(drawn(stack))
    left, top, width, height = map(float, re.findall(r'viewBox="([^"]+)"', stack)[0].split())
    bounds = np.array([shape.bounds for shape in things.values()])
    low, high = bounds[:, :2].min(axis=0), bounds[:, 2:].max(axis=0)
    # the longer side is 1200, beside two columns of 52 for the numbers
    assert (low[0], high[0]) == pytest.approx((52, 1252), abs=0.2)
    assert -0.2 <= low[1] < 40
    assert (left, top, width) == pytest.approx((-52, -52, 1200 + 4 * 52))
    scale = 1200 / abs(isometric(45, 45, 0) - isometric(-45, -45, 0))
    uses = re.findall(r'<use id="(\w+)" xlink:href="#(d\d+)" x="([-\d.]+)" y="([-\d.]+)"', stack)
    at = {name: complex(float(x), float(y)) / scale for name, _, x, y in uses}
    # alike ones share their drawing
    assert len({of for _, of, *_ in uses}) == 4
    corners = [isometric(x, y, z) for x in (-45, 45) for y in (-45, 45) for z in (0, 8)]
    hull = shapely.MultiPoint([((c + at["base"]).real * scale + 52, (c + at["base"]).imag * scale) for c in corners])
    assert shapely.symmetric_difference(hull.convex_hull, things["base"]).area < 1e-3 * things["base"].area
    assert at["pin_1"] - at["pin_2"] == pytest.approx(isometric(54, 0, 0), abs=0.02)
    up = {name: -(at[name] - at["base"] - isometric(x, 0, 0)).imag * math.sqrt(6) / 2
          for name, x in (("ring", 0), ("pin_1", 27), ("slug", 0))}  # fmt: skip
    for name, x in (("ring", 0), ("pin_1", 27), ("slug", 0)):
        assert (at[name] - at["base"]).real == pytest.approx(isometric(x, 0, 0).real, abs=0.02)
    # each is clear of the one that it goes on: base 0 to 8, ring 6 high, pins 20, the slug 3 high comes from below
    assert 8 < up["ring"] < 8 + 30
    assert up["ring"] + 6 < up["pin_1"] < up["ring"] + 6 + 40
    assert -3 - 30 < up["slug"] < -3
    leaders = re.findall(r'<path class="l" d="M(\d+),([\d.]+)h(-?\d+)L([\d.]+),([\d.]+)"/>', stack)
    rings = re.findall(r'<circle cx="([\d.]+)" cy="([\d.]+)" r="2.2"/>', stack)
    numbers = re.findall(r'<text x="(\d+)" y="([\d.]+)" text-anchor="middle">', stack)
    rows: dict[str, list[tuple[float, float]]] = {"0": [], "1304": []}
    for (start, y, shelf, *end), ring, (x, base) in zip(leaders, rings, numbers, strict=True):
        assert tuple(end) == ring
        assert float(shelf) == (26 if start == "0" else -26)
        assert (float(x), float(base)) == pytest.approx((float(start) + float(shelf) / 2, float(y) - 3), abs=0.06)
        rows[start].append((float(y), float(end[0])))
    assert all(rows.values())
    for column in rows.values():
        assert column == sorted(column)
        assert all(b - a >= 1.5 * 13 - 0.1 for (a, _), (b, _) in pairwise(column))
        assert all(0 <= y <= high[1] + 0.2 for y, _ in column)
    assert max(end for _, end in rows["0"]) <= min(end for _, end in rows["1304"])
    words = re.findall(r'<text x="(\d+)" y="([\d.]+)">([^<]+)<', stack)
    assert len(words) == 5
    assert all(float(y) > high[1] + 13 for _, y, _ in words)
    assert all(float(y) + 13 < top + height for _, y, _ in words)
    columns = sorted({float(x) for x, *_ in words})
    for x, _, told in words:
        beyond = next((c for c in columns if c > float(x)), left + width)
        assert float(x) + 0.55 * 13 * len(told) < beyond
    for column in columns:
        assert np.allclose(np.diff([float(y) for x, y, _ in words if float(x) == column]), 1.4 * 13, atol=1.01)


def test_light_is_on_what_faces_the_viewer(stack: str) -> None:
    """Ends lighter than the part's colour, walls from dark over bright to dark."""
    shades = {
        number: re.findall(r'stop-color="#(\w+)"', row)
        for number, row in re.findall(r'<linearGradient id="g(\d)">(.*)</linearGradient>', stack)
    }
    groups = re.findall(r'<g id="d(\d+)">(.*?)</g>', stack, re.DOTALL)
    assert len(groups) == 4

    def light(colour: str) -> int:
        return sum(int(colour[k : k + 2], 16) for k in (0, 2, 4))

    for number, group in groups:
        dark, bright, middle, last = map(light, shades[number])
        (end,) = {light(c) for c in re.findall(r'fill="#(\w+)"', group)}
        assert last < dark < middle < bright < end
        assert end / bright == pytest.approx(1.08 / 0.98, rel=0.01)
        assert [dark / bright, middle / bright, last / bright] == pytest.approx([0.633, 0.898, 0.51], rel=0.01)


def test_a_plate_of_one_part_has_the_view_of_all_and_long_names_stay_within_it(tmp_path: Path) -> None:
    file, name = tmp_path / "stack.toml", "Кільце " + "дуже широке " * 7
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
    # one and a half columns of names are as wide as the picture: they stand in two, of some 1650 in all
    assert len({x for x, words in texts if re.match(r"\d+  ", words)}) == 2
    assert width < 1800


def test_without_an_order_there_is_no_such_view(tmp_path: Path) -> None:
    file = tmp_path / "stack.toml"
    file.write_text(re.sub(r"\[\[steps\]\](.|\n)*(?=\[\[exports)", "", SCENE.format(language="en")), encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path)]) == 0
    assert not list((tmp_path / "stack").glob("*.exploded*"))
