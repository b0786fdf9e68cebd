"""Every word of every sheet of every scene stands clear, by boxes, off the files: of other words and of all lines.

No line is drawn twice.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import msgspec
import numpy as np
import pytest
import shapely

from exporters.production.plan import plan_build
from parts.base.refusal import SceneError
from parts.drawing.canvas import HEIGHTS, STYLES
from parts.drawing.view import TEETH
from parts.scene.files import built_in_scenes
from parts.scene.load import load_scene
from tests.exporters.making import NUMBER

SVG = "{http://www.w3.org/2000/svg}"
# letters that hang below their line, by 0.29 of a capital
HANGING = set("gjpqyQ,;()[]{}/φρξμψβηруцщфДЦЩ№")
SCENES = sorted(
    name for name, file in built_in_scenes().items() if re.search('format = "(sheet|pdf)"', file.read_text("utf-8"))
)
# a rounding, mm
NEAR = 0.02
Box = tuple[str, float, float, float, float]


def drawn(file: Path) -> tuple[list[Box], list[tuple[str, np.ndarray]]]:
    """Words with their boxes (left, low, right, high; y downwards), and chains of points of each layer, mm."""
    boxes, chains = [], []
    for group in ElementTree.parse(file).getroot().findall(f"{SVG}g"):
        for text in group.findall(f"{SVG}text"):
            size = float(re.findall(NUMBER, text.get("style", ""))[0]) * 1493 / 2048
            assert min(abs(size - height) for height in HEIGHTS) < 1e-6
            x, y, width = (float(text.get(key, "nan")) for key in ("x", "y", "textLength"))
            words = text.text or ""
            low = 0.29 * size if set(words) & HANGING else 0.0
            if text.get("transform") == f"rotate(180 {text.get('x')} {text.get('y')})":
                # upside down
                boxes.append((words, x - width + NEAR, y - low + NEAR, x - NEAR, y + size - NEAR))
                continue
            if text.get("transform"):
                # read from the right, upwards
                assert text.get("transform") == f"rotate(-90 {text.get('x')} {text.get('y')})"
                boxes.append((words, x - size + NEAR, y - width + NEAR, x + low - NEAR, y - NEAR))
                continue
            boxes.append((words, x + NEAR, y - size + NEAR, x + width - NEAR, y + low - NEAR))
        for path in group.findall(f"{SVG}path"):
            chains.append((str(group.get("id")), points_of(path.get("d", ""))))
    return boxes, chains


def points_of(data: str) -> np.ndarray:
    """Points of a path, near enough to each other."""
    rows, at, t = [], 0j, np.linspace(0, 1, 49)
    for command, text in re.findall(r"([MLAC])([^MLAC]*)", data):
        values = [float(v) for v in re.findall(NUMBER, text)]
        places = values[-2:] if command == "A" else values
        ends = [complex(x, y) for x, y in zip(places[::2], places[1::2], strict=True)]
        if command == "A":
            radius, right = values[0], values[4]
            chord = ends[-1] - at
            lift = math.sqrt(max(radius**2 - abs(chord) ** 2 / 4, 0.0))
            centre = (at + ends[-1]) / 2 + (1 if right else -1) * 1j * chord / abs(chord) * lift
            turn = np.angle((ends[-1] - centre) / (at - centre))
            rows.append(centre + (at - centre) * np.exp(1j * turn * t))
        elif command == "C":
            poles = (at, *ends)
            weights = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3)
            rows.append(sum(w * p for w, p in zip(weights, poles, strict=True)))
        elif command == "L":
            rows.append(np.array([at, ends[-1]]))
        at = ends[-1]
    return np.concatenate(rows)


def twice(chains: list[tuple[str, np.ndarray]]) -> list[str]:
    """Lines that stand twice on their layer; two sizes may end on one line."""
    places = Counter(
        (layer, frozenset(np.round(chain[np.linspace(0, len(chain) - 1, 5).astype(int)], 3).tolist()))
        for layer, chain in chains if layer != "DIMENSION"
    )  # fmt: skip
    return [f"{layer} twice: {sorted(ends, key=abs)}" for (layer, ends), count in places.items() if count > 1]


def faults(file: Path) -> list[str]:
    """Words over words and words over lines, and lines that are drawn twice."""
    boxes, chains = drawn(file)
    areas = shapely.box(*np.array([box[1:] for box in boxes]).T)
    one, other = shapely.STRtree(areas).query(areas, "intersects")
    found = [f"{boxes[k][0]} over {boxes[n][0]}" for k, n in zip(one, other, strict=True) if n < k]
    lines = [shapely.LineString(np.column_stack((chain.real, chain.imag))) for _, chain in chains]
    through, under = shapely.STRtree(areas).query(lines, "intersects")
    over = [f"{boxes[n][0]} over {chains[k][0]}" for k, n in zip(through, under, strict=True)]
    return found + over + twice(chains)


def sheets_of(name: str, language: str, **export: Any) -> Any:
    scene = load_scene(name)
    scene.scene.language = language
    sheets = [e for e in scene.exports if e.format == "sheet" or (e.format == "pdf" and e.purpose != "model")]
    # drawings of parts and assemblies are SVGs alone
    forms = ["svg" if e.purpose in ("part", "assembly") else "sheet" for e in sheets]
    scene.exports = [msgspec.structs.replace(e, **{"format": form, "tolerance": 1e-2, **export})
                     for e, form in zip(sheets, forms, strict=True)]  # fmt: skip
    return [job for job in plan_build(scene, name, [], []).sheets if job.path.endswith(".svg")]


@pytest.mark.sampled(1)
@pytest.mark.parametrize("export", [{}, {"paper": "A4", "title_block": True}, {"paper": "A1"}], ids=["", "A4", "A1"])
@pytest.mark.parametrize("language", ["en", "uk"])
@pytest.mark.parametrize("name", SCENES)
def test_no_word_stands_over_a_word_or_a_line(tmp_path: Path, name: str, language: str, export: dict[str, Any]) -> None:
    try:
        jobs = sheets_of(name, language, **export)
    except SceneError as refusal:
        # paper that does not hold it is refused with one that does
        if not refusal.key.endswith(".paper") or refusal.nearest is None:
            raise
        jobs = sheets_of(name, language, **{**export, "paper": refusal.nearest.value})
    for job in jobs:
        job.write({}, tmp_path / job.path)
        assert job.verify(tmp_path / job.path, 0.0).failures == ()
        assert faults(tmp_path / job.path) == [], job.path


def test_a_word_that_is_moved_onto_a_line_is_seen(tmp_path: Path) -> None:
    """The negative control: a name on the line that it stands beside, and one on the other."""
    (job,) = sheets_of("practicum_pair", "en")
    file = tmp_path / job.path
    job.write({}, file)
    assert faults(file) == []
    text = file.read_text(encoding="utf-8")
    x, y = re.findall(r'<text x="([\d.]+)" y="([\d.]+)"[^>]*>T</text>', text)[0]
    file.write_text(re.sub(rf'x="{x}"([^>]*>T<)', rf'x="{float(x) + 6}"\1', text), encoding="utf-8")
    assert any("over TANGENT" in fault for fault in faults(file))
    moved = re.sub(r'<text x="[\d.]+" y="[\d.]+"([^>]*>P<)', rf'<text x="{x}" y="{y}"\1', text)
    file.write_text(moved, encoding="utf-8")
    assert {"T over P", "P over T"} & set(faults(file))


def test_a_line_that_is_written_once_more_is_seen(tmp_path: Path) -> None:
    """The negative control: as it stands, and the other way round."""
    (job,) = sheets_of("practicum_pair", "en")
    file = tmp_path / job.path
    job.write({}, file)
    text = file.read_text(encoding="utf-8")
    path, start, end = re.findall(rf'(<path d="M({NUMBER},{NUMBER}) L({NUMBER},{NUMBER})"/>)', text)[0]
    for more in (path, f'<path d="M{end} L{start}"/>'):
        file.write_text(text.replace(path, path + more, 1), encoding="utf-8")
        assert [fault.partition(":")[0] for fault in faults(file)] == ["FRAME twice"]


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", [n for n in SCENES if "pair" in n or "rack" in n])
@pytest.mark.parametrize("paper", ["A4", "A3", "A2"])
def test_meshing_is_as_large_as_its_paper_allows(name: str, paper: str) -> None:
    """Three teeth of each wheel at a scale of which the next one is refused, with this paper named as too small."""
    from parts.drawing.canvas import SCALES, scale_name

    (job,) = sheets_of(name, "en", paper=paper)
    scale = job.expected.paper.scale
    assert job.canvas.paper == paper
    assert TEETH == 3
    assert scale in SCALES
    larger = SCALES[SCALES.index(scale) - 1]
    with pytest.raises(SceneError) as caught:
        sheets_of(name, "en", paper=paper, scale=scale_name(larger))
    assert caught.value.key == "exports[1].paper"
    nearest = caught.value.nearest
    assert nearest
    assert sheets_of(name, "en", paper=nearest.value, scale=scale_name(larger))[0].expected.paper.scale == larger


def test_styles_of_dashes_are_those_of_the_standard() -> None:
    """GOST 2.303: dashes of 2 to 8 mm, 1 to 2 apart; dash and dot of 5 to 30 mm, 3 to 5 apart, two dots 4 to 6."""
    for style in STYLES.values():
        if len(style.dashes) == 2:
            assert 2 <= style.dashes[0] <= 8
            assert 1 <= style.dashes[1] <= 2
        elif style.dashes:
            assert 5 <= style.dashes[0] <= 30
            dots = len(style.dashes) // 2 - 1
            assert 2 + dots <= sum(style.dashes[1:]) <= 4 + dots
