"""The pictures of ``converge``: nothing runs off the page."""

from __future__ import annotations

import itertools
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest

from exporters.production.plot import write_loglog

# the mean width of a letter of DejaVu Sans, the widest of the common fonts, by its size
_LETTER = 0.61 * 12


@pytest.mark.parametrize("count", [1, 40])
def test_the_key_and_the_title_stand_within_the_page(tmp_path: Path, count: int) -> None:
    name = "wheel root_fillet degree 7 splines 8.00"
    file = tmp_path / "p.svg"
    write_loglog(file, "помилка залежно від кількості частин; порядок у ключі " * 2, ("x", "y"),
                 [(f"{name} {i}", [1.0, 10.0], [1.0, 0.1]) for i in range(count)])  # fmt: skip
    root = ET.parse(file).getroot()
    width, height = float(root.attrib["width"]), float(root.attrib["height"])
    texts = [e for e in root.iter() if e.tag.endswith("text")]
    assert sum((e.text or "").startswith(name) for e in texts) == count
    for text in texts:
        assert float(text.attrib["x"]) + _LETTER * len(text.text or "") <= width, text.text
        assert float(text.attrib["y"]) <= height, text.text


def test_points_stand_by_the_lines_of_their_decades(tmp_path: Path) -> None:
    """Values read back off the grid and its numbers; what is not above 0 or not finite is left out."""
    file = tmp_path / "p.svg"
    runs = {
        "one": ([0.3, 1.0, 40.0], [2e-4, 0.05, 1.0]),
        "two & <more>": ([7.0, 5000.0, -1.0, 3.0], [0.5, 3e-4, 1.0, 0.0]),
    }
    series = [(name, xs, ys) for name, (xs, ys) in runs.items()]
    write_loglog(file, "title", ("time", "error"), [*series, ("none", [0.0, 1.0], [1.0, float("inf")])])
    root = ET.parse(file).getroot()
    every = [(e.tag.rpartition("}")[2], e) for e in root.iter()]
    words = {e.text: (float(e.attrib["x"]), float(e.attrib["y"])) for tag, e in every if tag == "text"}
    assert "none" not in words
    lines = [[float(e.attrib[k]) for k in ("x1", "y1", "x2", "y2")] for tag, e in every if tag == "line"]
    upright, level = ([row for row in lines if row[k] == row[k + 2]] for k in (0, 1))
    assert (len(upright), len(level)) == (6, 5)
    # decades from 0.1 to 10000 below, from 1e-4 to 1 beside: a number at each line, evenly
    across = {f"1e{d}": row[0] for d, row in zip(range(-1, 5), upright, strict=True)}
    along = {f"1e{d}": row[1] for d, row in zip(range(-4, 1), level, strict=True)}
    numbers = [(e.text, float(e.attrib["x"]), float(e.attrib["y"])) for tag, e in every if tag == "text"]
    below = {text: x for text, x, y in numbers if text in across and y > max(along.values()) + 9}
    assert {text: x + 12 for text, x in below.items()} == pytest.approx(across, abs=0.02)
    beside = {text: y for text, x, y in numbers if text in along and x < min(across.values()) - 25}
    assert {text: y - 4 for text, y in beside.items()} == pytest.approx(along, abs=0.02)
    for rows, others in ((upright, level), (level, upright)):
        k = 0 if rows is upright else 1
        places = [row[k] for row in rows]
        assert np.ptp(np.diff(places)) < 0.02
        # each line runs from the first to the last one across it
        assert {(row[1 - k], row[3 - k]) for row in rows} <= {
            (a[1 - k], b[1 - k]) for a, b in itertools.permutations(others, 2)
        }
    left, right, top, bottom = (*(f(across.values()) for f in (min, max)), *(f(along.values()) for f in (min, max)))
    drawn = [e.attrib for tag, e in every if tag == "polyline"]
    marks = [e.attrib for tag, e in every if tag == "circle"]
    colours = [row["style"].split("stroke:")[1][:7] for row in drawn]
    assert len(set(colours)) == 2
    exact = []
    for (name, (xs, ys)), row, colour in zip(runs.items(), drawn, colours, strict=True):
        points = np.array([[float(v) for v in pair.split(",")] for pair in row["points"].split()])
        values = [(x, y) for x, y in zip(xs, ys, strict=True) if x > 0 and y > 0]
        told = np.log10(values)
        assert points[:, 0] == pytest.approx(left + (told[:, 0] + 1) / 5 * (right - left), abs=0.02)
        assert points[:, 1] == pytest.approx(bottom - (told[:, 1] + 4) / 4 * (bottom - top), abs=0.02)
        assert words[name][0] > right
        exact += [(*p, colour) for p in points.tolist()]
    told = [(float(m["cx"]), float(m["cy"]), m["style"].split("stroke:")[1][:7]) for m in marks]
    assert told == exact
    assert top <= words["one"][1] < words["two & <more>"][1]
    assert float(root.attrib["height"]) > words["time"][1] > bottom
    assert words["error"][1] < top


def test_lines_are_told_apart_and_each_stands_in_the_key(tmp_path: Path) -> None:
    """Eight colours went round: of two files with one colour nobody knew which was which."""
    file = tmp_path / "p.svg"
    runs = [(f"run {k}", [1.0, 1e15], [1.0, 10.0 ** -(k + 1)]) for k in range(22)]
    write_loglog(file, "title", ("time", "error"), runs)
    every = [(e.tag.rpartition("}")[2], e) for e in ET.parse(file).getroot().iter()]
    drawn = [e.attrib["style"] for tag, e in every if tag == "polyline"]
    assert len(set(drawn)) == len(runs)
    assert [e.attrib["style"] for tag, e in every if tag == "path"] == drawn
    # of the numbers below none runs into the next, nor into the key
    below = sorted(
        (float(e.attrib["x"]), e.text or "") for tag, e in every if tag == "text" and e.attrib["y"] == "400.00"
    )
    ends = [x + _LETTER * len(text) for x, text in below]
    assert all(end < x for end, (x, _) in zip(ends, below[1:], strict=False))
    # points of lines of one colour differ too, and the longest name is not cut off
    assert len({e.attrib["style"] for tag, e in every if tag == "circle"}) == 16
    names = [float(e.attrib["x"]) + _LETTER * len(e.text) for tag, e in every if (e.text or "").startswith("run")]
    assert max(names) < float(every[0][1].attrib["width"])
    assert ends[-1] < min(float(e.attrib["d"][1:].split(",")[0]) for tag, e in every if tag == "path")
