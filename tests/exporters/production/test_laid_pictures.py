"""Pictures of beds: what is seen of a part from above, words as large as it has room for, a legend in rows."""

from __future__ import annotations

import math
import re
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
import shapely

from exporters.production.laid_preview import laid_previews
from exporters.production.plan import plan_build
from parts.scene.load import scene_from_toml
from tests.exporters.production.test_preview_places import SVG, opened, rings, shape, words

BED = (
    "[beds.printer]\nwidth = {wide}\ndepth = 120.0\nheight = 100.0\n{more}"
    "[[exports]]\nformat = '3mf'\npurpose = 'plate'\n"
)
PLATE = '[parts.{}]\nkind = "plate"\nwidth = {}\nheight = {}\nface_width = 4.0\n'
BARREL = (
    '[parts.barrel]\nkind = "barrel_cam"\nform = "groove"\nouter_diameter = 8.0\ngroove_depth = 1.0\n'
    'roller_diameter = 2.0\nlift = 1.0\nlength = 6.0\nphases = [{ move = "rise", angle_deg = 180.0, law = "sine" }, '
    '{ move = "return_", angle_deg = 180.0, law = "sine" }]\n'
)


WORM = (
    '[parts.worm]\nkind = "worm"\ntitle = "worm"\nmodule = 1.0\nnumber_of_starts = 1\ndiameter_quotient = 10.0\n'
    "thread_length = 5.0\n"
)


def picture(text: str, folder: Path) -> tuple[ElementTree.Element, tuple[float, float]]:
    plan = plan_build(scene_from_toml(text.encode(), "s.toml", "s"), "s", [], [])
    (file,) = laid_previews(plan, folder)
    root, size, _ = opened(file)
    return root, size


def test_of_a_part_its_section_its_hull_or_both_are_seen(tmp_path: Path) -> None:
    """A plate is its section; a drum's development is no view; a worm's section is less than its thread sweeps."""
    text = PLATE.format("slab", 40.0, 12.0) + BARREL + WORM + BED.format(wide=120.0, more="")
    root, _ = picture(text, tmp_path)
    by_fill: dict[str, list[ElementTree.Element]] = {}
    for path in root.iter(f"{SVG}path"):
        by_fill.setdefault(re.findall(r"fill:(#\w+)", path.get("style", ""))[0], []).append(path)
    samples = [r for r in root.iter(f"{SVG}rect") if "stroke-width" in r.get("style", "")][1:]
    legend = [text.replace("\xa0", " ") for text, *_ in words(root) if re.match(r"\d: 1 × ", text.replace("\xa0", " "))]
    fills = {
        name: re.findall(r"fill:(#\w+)", r.get("style", ""))[0]
        for row, r in zip(legend, samples, strict=True)
        for name in re.findall("slab|barrel|worm", row.lower())
    }
    (slab,) = by_fill[fills["slab"]]
    assert shape(slab).area == pytest.approx(480, rel=1e-6)
    (barrel,) = by_fill[fills["barrel"]]
    # chords within 0.02 mm, that much wider
    assert shape(barrel).area == pytest.approx(math.pi * 4.02**2, rel=5e-3)
    thread, section = by_fill[fills["worm"]]
    tip = 10 / 2 + 1.0
    assert shape(thread).area == pytest.approx(math.pi * (tip + 0.02) ** 2, rel=5e-3)
    assert shape(section).area < 0.95 * shape(thread).area
    assert shape(thread).buffer(0.05).contains(shape(section))


@pytest.mark.sampled(2)
@pytest.mark.parametrize(("wide", "high"), [(60.0, 20.0), (24.0, 20.0), (19.0, 20.0), (14.0, 8.0), (3.0, 3.0)])
def test_words_are_the_largest_that_have_room(wide: float, high: float, tmp_path: Path) -> None:
    """Letters of a fiftieth of the bed, three quarters or 0.55 of it; the name with its number, else the number."""
    root, (page, _) = picture(PLATE.format("slab", wide, high) + BED.format(wide=200.0, more=""), tmp_path)
    (path,) = root.iter(f"{SVG}path")
    piece = shape(path)
    (word,) = [row for row in words(root) if piece.contains(shapely.Point(row[1], row[2] - 0.35 * row[3]))]
    text, x, y, size = word
    full = 200 / 50
    tried = [(text, share * full) for text in ("1 Plate", "1") for share in (1.0, 0.75, 0.55)]
    sides = sorted((piece.bounds[2] - piece.bounds[0], piece.bounds[3] - piece.bounds[1]), reverse=True)
    turned = piece.bounds[2] - piece.bounds[0] < piece.bounds[3] - piece.bounds[1]
    across, up = sides[::-1] if turned else sides
    fitting = [(t, s) for t, s in tried if 0.62 * s * len(t) <= across and s <= up]
    assert (text, pytest.approx(size, rel=1e-3)) in [(t, s) for t, s in (fitting[:1] or tried[-1:])]
    if fitting:
        half = 0.62 * size * len(text) / 2
        assert piece.buffer(0.01).contains(shapely.box(x - half, y - 0.85 * size, x + half, y + 0.15 * size))
    assert page == pytest.approx(200 + 2 * 200 / 60, abs=1e-3)


def test_what_lies_there_is_told_in_rows_beside_its_colour(tmp_path: Path) -> None:
    """Six parts: rows one below the other, as many in each as the bed is wide; the page ends below them."""
    names = [f"part_of_the_number_{k}" for k in range(6)]
    text = "".join(PLATE.format(name, 12.0 + k, 6.0) for k, name in enumerate(names)) + BED.format(
        wide=160.0, more="copies = { part_of_the_number_3 = 2 }\n"
    )
    root, (page, deep) = picture(text, tmp_path)
    size = 160 / 50
    room = 160 / 60
    bed, *samples = [r for r in root.iter(f"{SVG}rect") if r.get("width") != "100%"]
    assert [float(bed.get(key, "")) for key in ("x", "y", "width", "height")] == pytest.approx(
        [room, room, 160, 120], abs=1e-3
    )
    told = [(t.replace("\xa0", " "), x, y, s) for t, x, y, s in words(root)]
    assert told[len(told) - 7][0] == "s: 160 × 120 × 100"
    legend = told[-6:]
    assert [row[0].split(": ")[0] for row in legend] == [str(k + 1) for k in range(6)]
    assert {row[0].split(": ")[1] for row in legend} == {
        f"{1 + (k == 3)} × Plate {name}" for k, name in enumerate(names)
    }
    assert [row[3] for row in legend] == pytest.approx([size] * len(legend), rel=1e-3)
    heights = np.unique([row[2] for row in legend])
    assert np.diff(heights) == pytest.approx(np.full(len(heights) - 1, 1.7 * size), abs=1e-3)
    assert len(heights) > 2
    for (text_, x, y, _), sample in zip(legend, samples, strict=True):
        assert [float(sample.get(key, "")) for key in ("x", "y", "width")] == pytest.approx(
            [x - 1.4 * size, y - 0.8 * size, size], abs=2e-3
        )
        assert x + 0.55 * size * len(text_) <= page
        # the next one in its row begins behind it, where there is one; the first stands at the side
        row = sorted(other[1] for other in legend if other[2] == y)
        assert row[0] == pytest.approx(room + 1.4 * size, abs=1e-3)
        following = [other for other in row if other > x]
        assert all(x + 0.62 * size * len(text_) < other for other in following[:1])
    # no row has room for the first of the next one
    for above, below in pairwise(heights):
        last = max((row for row in legend if row[2] == above), key=lambda row: row[1])
        first = min((row for row in legend if row[2] == below), key=lambda row: row[1])
        end = last[1] - 1.4 * size + 0.62 * size * len(last[0]) + 3 * size
        assert end + 0.62 * size * len(first[0]) + 3 * size > room + 160
    assert deep > heights[-1]
    assert deep == pytest.approx(heights[-1] + size, abs=0.02)


def test_pieces_stand_where_they_lie(tmp_path: Path) -> None:
    """As the plan has them, turned by quarters; y upwards on the bed."""
    text = PLATE.format("slab", 40.0, 12.0) + BED.format(wide=120.0, more="copies = { slab = 3 }\n")
    plan = plan_build(scene_from_toml(text.encode(), "s.toml", "s"), "s", [], [])
    (file,) = laid_previews(plan, tmp_path)
    root, _, _ = opened(file)
    (job,) = plan.assemblies
    room = 120 / 60
    drawn = [np.concatenate(rings(path)) for path in root.iter(f"{SVG}path")]
    assert len(drawn) == 3
    for piece, corners in zip(job.told["pieces"].values(), drawn, strict=True):
        x, y, _ = piece["at"]
        half = (20, 6) if piece["turn_deg"] % 180 == 0 else (6, 20)
        assert (corners.real.min(), corners.real.max()) == pytest.approx(
            (room + x - half[0], room + x + half[0]), abs=1e-3
        )
        assert (corners.imag.min(), corners.imag.max()) == pytest.approx(
            (room + 120 - y - half[1], room + 120 - y + half[1]), abs=1e-3
        )
