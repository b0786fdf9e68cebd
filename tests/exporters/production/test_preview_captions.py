"""Captions of pictures: signs with lowered letters, values beside their signs, letters that every program shows."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from exporters.formats.svg import text_line
from exporters.production.check_lines import picture_names
from exporters.production.plan import plan_build
from exporters.production.preview import outlines_of, scene_preview
from parts.scene.load import load_scene, make_parts
from tests.exporters.making import run
from tests.exporters.production.test_preview_places import SVG, opened, rings, words

SCENE = """
[scene]
language = "uk"
[parts.bevel]
kind = "bevel_gear"
module = 2.0
number_of_teeth = 20
mate_number_of_teeth = 40
[parts.lever]
kind = "follower_arm"
end = "roller"
arm_length = 50.0
pin_diameter = 4.0
face_width = 4.0
[parts.dowel]
kind = "pin"
diameter = 3.0
length = 10.0
[parts.ring]
kind = "pin_ring"
number_of_pins = 12
pin_circle_diameter = 80.0
pin_diameter = 8.0
outer_diameter = 110.0
face_width = 4.0
[[exports]]
format = "stl"
tolerance = 0.5
"""


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("captions")
    (folder / "s.toml").write_text(SCENE, encoding="utf-8")
    assert run("build", folder / "s.toml", "--out", folder, "-q", "--no-verify") == 0
    return folder / "s"


def pieces(text: ElementTree.Element) -> list[tuple[str, float, bool]]:
    """What a text is made of, each with how far below its line it stands, and whether it is small."""
    found, y = [(text.text or "", 0.0, False)], 0.0
    for span in text.iter(f"{SVG}tspan"):
        y += float(span.get("dy", "0"))
        found += [(span.text or "", y, "70%" in span.get("style", "")), (span.tail or "", y, False)]
    return [piece for piece in found if piece[0].strip()]


def test_signs_stand_with_lowered_letters_and_all_else_on_its_line(built: Path) -> None:
    root, *_ = opened(built / "bevel.preview.svg")
    every = [pieces(text) for text in root.iter(f"{SVG}text")]
    assert not [piece for row in every for piece, *_ in row if "_" in piece]
    lowered = [piece for row in every for piece, y, small in row if small]
    assert lowered[:3] == ["a", "f", "e"]
    assert {"v", "ae"} < set(lowered)
    for row in every:
        for _, y, small in row:
            assert (y > 0.1) if small else y == pytest.approx(0.0, abs=1e-3)


@pytest.mark.parametrize(("text", "low", "plain"), [
    ("a_w = 27 mm, α_w = 20", ["w", "w"], ["a", " = 27 mm, α", " = 20"]),
    ("2 R_b", ["b"], ["2 R"]),
    ("4 mm^3 in common", ["3"], ["4 mm", " in common"]),
    ("lower_disc and a_b_c", [], ["lower_disc and a_b_c"]),
    ("<&", [], ["<&"]),
])  # fmt: skip
def test_only_signs_are_taken_apart(text: str, low: list[str], plain: list[str]) -> None:
    """Ids are no signs; no letter is lost, spaces stand before what goes back to its line."""
    line = ElementTree.fromstring(text_line(text, 3.0, 4.0, 2.0).replace("<text", f'<text xmlns="{SVG[1:-1]}"'))
    assert "".join(line.itertext()) == (re.sub(r"[_^]", "", text) if low else text)
    every = pieces(line)
    assert [piece for piece, _, small in every if small] == low
    assert [piece.strip() for piece, _, small in every if not small] == [piece.strip() for piece in plain]
    assert not [s for s in line.iter(f"{SVG}tspan") if (s.text or "").strip() != s.text]


def test_a_value_stands_beside_its_sign_and_its_unit(built: Path) -> None:
    rows = [text for file in built.glob("*.preview.svg") for text, *_ in words(opened(file)[0])]
    values = [row for row in rows if re.search(r"\d,\d{4}$", row)]
    assert len(values) > 15
    assert not [row for row in values if not re.search(r"\w,\xa0\w+\xa0\xa0[\d,]+$|\w\xa0\xa0[\d,]+$", row)]
    # what is counted has no decimals
    assert [row for row in rows if row.endswith("\xa0\xa012")]


def test_a_part_stands_in_the_middle_whatever_its_origin(built: Path) -> None:
    """A lever turns about its one end: as much paper below as above, the caption begins as far to the right."""
    root, (width, height), _ = opened(built / "lever.preview.svg")
    outline = np.concatenate([ring for path in root.iter(f"{SVG}path") for ring in rings(path)])
    left, right, top, low = outline.real.min(), outline.real.max(), outline.imag.min(), outline.imag.max()
    assert top == pytest.approx(height - low, abs=0.02)
    assert right - left > 0.5 * width
    assert all(x > right + left for _, x, *_ in words(root))
    cross = [line for line in root.iter(f"{SVG}line") if line.get("x1") == line.get("x2")]
    # its pivot is near its left end
    assert left < float(cross[0].get("x1", "")) < left + 0.25 * (right - left)


def test_letters_of_a_small_picture_are_not_too_small_for_any_program(built: Path) -> None:
    """Of a pin of 3 mm they are some 0.07 mm high: written a hundred times as large, shown at their size."""
    root, (width, _), _ = opened(built / "dowel.preview.svg")
    for text in root.iter(f"{SVG}text"):
        assert text.get("transform") == "scale(0.01)"
        assert float(re.findall(r"font-size:([\d.]+)", text.get("style", ""))[0]) > 5
    assert all(0.05 < size < 0.1 and 3 < x < x + 0.6 * size * len(row) < width for row, x, _, size in words(root))


@pytest.mark.sampled(2)
@pytest.mark.parametrize("scene", ["cycloidal_reducer", "fit_coupon", "bevel_reducer", "practicum_example_3"])
def test_no_two_instances_of_a_picture_have_one_name_and_none_its_id(scene: str) -> None:
    """But where parts without a title are of one kind: there the id stands after that, of instances a number too."""
    for language, letters in (("uk", "А-ЯІЇЄҐа-яіїєґ"), ("en", "A-Za-z")):
        made = load_scene(scene, language)
        parts = make_parts(made, scene)[0]
        names = picture_names(made.instances, parts)
        assert len(set(names.values())) == len(names)
        kinds = Counter(part.kind for part in parts.values() if part.title is None)
        for key, name in names.items():
            part = parts[str(made.instances[key].part)]
            told = name if kinds[part.kind] < 2 else re.sub(rf" {part.id}\b( \d+)?$", "", name)
            assert re.fullmatch(rf"[{letters}'’(),.× 0-9]+", told), name


def test_names_stand_on_no_roller_of_a_chain(tmp_path: Path) -> None:
    plan = plan_build(load_scene("chain_drive", "en"), "chain_drive", [], [])
    outlines = {key: outlines_of(part.section(0.0).region) for key, part in plan.parts.items()}
    root = ElementTree.parse(scene_preview(plan, outlines, {}, tmp_path)).getroot()
    (group,) = root.iter(f"{SVG}g")
    rollers = [c for c in group.iter(f"{SVG}circle") if "#7f8c99" in c.get("style", "")]
    at = np.array([complex(float(c.get("cx", "")), float(c.get("cy", ""))) for c in rollers])
    radii = np.array([float(c.get("r", "")) for c in rollers])
    told = words(group)
    assert len(told) == 5
    assert len(rollers) > 100
    for text, x, y, size in told:
        half = 0.5 * size * len(text) / 2
        near = np.clip(at.real, x - half, x + half) + 1j * np.clip(at.imag, y - 0.7 * size, y)
        assert (np.abs(at - near) > 0.9 * radii).all(), text
