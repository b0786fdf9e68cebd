"""Pictures of pages as a reader sees them: places by grids and their numbers, colours by keys, all within the sheet."""

from __future__ import annotations

import html
import math
import re
from itertools import pairwise
from xml.etree import ElementTree

import numpy as np
import pytest
import shapely

from geometry.curves.implicit import Box
from geometry.gears.shifts.external import BlockingContour, ContourLine, Requirements, ShiftPair
from geometry.gears.shifts.internal import InternalRequirements
from geometry.gears.shifts.internal_shifts import InternalShiftPair
from geometry.gears.teeth.basic_rack import BasicRack
from geometry.gears.teeth.cutter import PinionCutter
from geometry.gears.teeth.ring import RoundedRoot
from parts.base.texts import MINUS, words
from parts.pages.contour_picture import ContourPicture, clipped, contour_text, grid_step, region_text, tool_texts
from parts.pages.error_map import ErrorMap
from parts.pages.svg import written

SVG = "{http://www.w3.org/2000/svg}"
EN = words("en")


class Sheet:
    """The entities of a picture."""

    def __init__(self, text: str) -> None:
        self.root = ElementTree.fromstring(text)
        self.width, self.height = (float(self.root.get(key, "nan")) for key in ("width", "height"))
        assert self.root.get("viewBox") == f"0 0 {self.width:.0f} {self.height:.0f}"

    def all(self, tag: str) -> list[ElementTree.Element]:
        return self.root.findall(SVG + tag)

    def texts(self) -> dict[str, tuple[float, float]]:
        return {"".join(t.itertext()).replace(MINUS, "-"): (num(t, "x"), num(t, "y")) for t in self.all("text")}

    def outside(self) -> list[str]:
        """Words and lines that leave the sheet; a letter is at most as wide as high, most are half of it."""
        found = []
        for t in self.all("text"):
            size = float(re.findall(r"font-size:(\d+)px", t.get("style", ""))[0])
            x, y = num(t, "x"), num(t, "y")
            if not (
                x >= 0 and x + 0.62 * size * len("".join(t.itertext())) <= self.width and size * 0.7 <= y <= self.height
            ):
                found.append("".join(t.itertext()))
        for t in self.all("line"):
            ends = [num(t, key) for key in ("x1", "x2", "y1", "y2")]
            if min(ends) < 0 or max(ends[:2]) > self.width or max(ends[2:]) > self.height:
                found.append("line")
        return found


def num(element: ElementTree.Element, key: str) -> float:
    text = element.get(key, "nan")
    return math.nan if text.endswith("%") else float(text)


def style(element: ElementTree.Element, key: str) -> str | None:
    return dict(part.split(":", 1) for part in element.get("style", "").split(";")).get(key)


RACK = BasicRack(math.radians(20.0), 1.0, 0.25, 0.38)
PAIR = ShiftPair(13, 21, RACK)
BOX = Box(-0.5, 1.5, -0.3, 1.1, 10)
RING = (0.1 + 0.2j, 0.9 + 0.2j, 0.9 + 0.8j, 0.1 + 0.8j)
LINES = (
    ContourLine("undercut_first", None, (0.2 - 1j, 0.2 + 3j)),
    ContourLine("tip_thickness_second", 0.25, (-0.4 + 0.9j, 0.4 + 1.0j, 1.4 + 0.2j)),
    ContourLine("tip_thickness_second", 0.4, (-0.4 + 0.7j, 1.4 + 0.1j)),
    ContourLine("contact_ratio", 1.1, (-1 + 0.5j, 0.5 + 0.5j, 0.5 + 2j)),
    ContourLine("recess", None, (0.6 + 0.1j, 0.9 + 0.3j)),
    ContourLine("approach", None, (3 + 3j, 4 + 4j)),
)
CONTOUR = BlockingContour(PAIR, Requirements(), BOX, LINES, (RING,))
PICTURE = ContourPicture(CONTOUR, (("chosen", (0.5, 0.5)), ("beyond", (2.0, 0.5)), ("edge", (1.5, -0.3))))


def test_a_contour_is_read_off_by_its_grid() -> None:
    """Lines in fifths of a module, each with its number; curves, region and marks stand where these say."""
    sheet = Sheet(PICTURE.svg(EN))
    # numbers of both axes are alike: those of one axis are read at its own lines
    texts = [("".join(t.itertext()).replace(MINUS, "-"), num(t, "x"), num(t, "y")) for t in sheet.all("text")]
    lines = [t for t in sheet.all("line") if "#dde2e6" in t.get("style", "") or "#808890" in t.get("style", "")]
    upright, level = {}, {}
    for line in lines:
        x1, x2, y1, y2 = (num(line, key) for key in ("x1", "x2", "y1", "y2"))
        if x1 == x2:
            (told,) = [t for t, x, y in texts if -14 < x - x1 < 0 and 8 < y - y2 < 24 and re.fullmatch(r"-?[\d.]+", t)]
            upright[float(told)] = x1
            bottom, top = y2, y1
        else:
            (told,) = [t for t, x, y in texts if -40 < x - x1 < -24 and 0 < y - y1 < 6 and re.fullmatch(r"-?[\d.]+", t)]
            level[float(told)] = y1
            left, right = x1, x2
        heavy = "#808890" in line.get("style", "")
        assert heavy == (float(told) == 0.0)
    assert sorted(upright) == pytest.approx([-0.4, -0.2, 0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4])
    assert sorted(level) == pytest.approx([-0.2, 0, 0.2, 0.4, 0.6, 0.8, 1.0])
    unit = upright[1.0] - upright[0.0]
    assert level[0.0] - level[1.0] == pytest.approx(unit, abs=0.02)
    # the box of 2 by 1.4 modules is filled by the grid
    assert right - left == pytest.approx(2 * unit, abs=0.05)
    assert bottom - top == pytest.approx(1.4 * unit, abs=0.05)
    assert left == pytest.approx(upright[0.0] - 0.5 * unit, abs=0.02)
    assert top == pytest.approx(level[0.0] - 1.1 * unit, abs=0.02)

    def model(text: str) -> list[complex]:
        pairs = (p.split(",") for p in text.split())
        return [complex((float(x) - upright[0.0]) / unit, (level[0.0] - float(y)) / unit) for x, y in pairs]

    wanted = [[0.2 - 0.3j, 0.2 + 1.1j], [-0.4 + 0.9j, 0.4 + 1.0j, 1.4 + 0.2j], [-0.4 + 0.7j, 1.4 + 0.1j],
              [-0.5 + 0.5j, 0.5 + 0.5j, 0.5 + 1.1j], [0.6 + 0.1j, 0.9 + 0.3j]]  # fmt: skip
    found = [model(t.get("points", "")) for t in sheet.all("polyline")]
    assert len(found) == len(wanted)
    for one, two in zip(found, wanted, strict=True):
        assert np.abs(np.array(one) - np.array(two)).max() < 1e-4
    (path,) = sheet.all("path")
    assert (
        np.abs(np.array(model(path.get("d", "").replace("M", "").replace("L", "").replace("Z", ""))) - RING).max()
        < 1e-4
    )
    assert style(path, "fill-rule") == "evenodd"
    # marks that lie in the box, on its edge too, each with its number beside it
    marks = [t for t in sheet.all("circle") if style(t, "stroke")]
    places = [model(f"{t.get('cx')},{t.get('cy')}")[0] for t in marks]
    assert np.abs(np.array(places) - np.array([0.5 + 0.5j, 1.5 - 0.3j])).max() < 1e-4
    for number, mark in zip("13", marks, strict=True):
        x, y = next((x, y) for t, x, y in texts if t == number and abs(x - num(mark, "cx")) < 12)
        assert 0 < x - num(mark, "cx") < 10
        assert 0 < num(mark, "cy") - y < 10
    assert sheet.outside() == []


def test_the_key_of_a_contour_has_each_kind_of_line_once_in_its_stroke() -> None:
    sheet = Sheet(PICTURE.svg(EN))
    key = [t for t in sheet.all("line") if style(t, "stroke-opacity")]
    drawn = [t for t in sheet.all("polyline")]
    keys = ("stroke", "stroke-dasharray", "stroke-opacity", "stroke-width")
    strokes = [tuple(style(t, k) for k in keys) for t in key]
    # those of the line beyond the box are not told
    assert strokes == [tuple(style(t, k) for k in keys) for t in drawn]
    assert [s[2] for s in strokes] == ["1", "0.75", "0.4", "0.7", "1"]
    assert [s[1] for s in strokes] == [None, None, None, None, "2 2"]
    texts = [("".join(t.itertext()), num(t, "x"), num(t, "y")) for t in sheet.all("text")]
    rows = []
    for line in key:
        (told,) = [t for t, x, y in texts if 0 < x - num(line, "x2") < 12 and 0 < y - num(line, "y1") < 8]
        rows.append(told)
        assert num(line, "y1") == num(line, "y2")
        assert 20 < num(line, "x2") - num(line, "x1") < 50
    # their indices lowered
    assert rows == ["undercut, gear 1: xmin1", "Sa2 = 0.25 m", "Sa2 = 0.4 m", "εα = 1.1",
                    "pole at the end of action"]  # fmt: skip
    right = max(num(t, "x2") for t in sheet.all("line") if "#dde2e6" in t.get("style", ""))
    assert all(num(line, "x1") > right + 10 for line in key)
    # what the region keeps beside its colour, the rack, the marks with both shifts
    (box,) = [t for t in sheet.all("rect") if style(t, "fill") == "#e4f2e4"]
    region = next((x, y) for t, x, y in texts if t.startswith("region"))
    assert num(box, "y") < region[1] < num(box, "y") + num(box, "height") + 2
    below = {t: y for t, _, y in texts}
    assert below["region: ε ≥ 1.1, Sa ≥ 0.3 m"] < below["α = 20°, ha* = 1, c* = 0.25, ρf* = 0.38"]
    for told, at in (("1: chosen: 0.5000 / 0.5000", 1), (f"3: edge: 1.5000 / {MINUS}0.3000", 2)):
        (circle,) = [t for t in sheet.all("circle") if not style(t, "stroke") and abs(num(t, "cy") - below[told]) < 8]
        assert num(circle, "cx") < next(x for t, x, _ in texts if t == told)
        assert at
    # no two rows of the key lie on each other
    heights = sorted(y for t, x, y in texts if x > right + 10)
    assert min(b - a for a, b in pairwise(heights)) > 12
    # the names of the axes: below the numbers at the right, above them at the left
    at = {t: (x, y) for t, x, y in texts}
    bottom = max(num(t, "y2") for t in sheet.all("line") if "#dde2e6" in t.get("style", ""))
    top = min(num(t, "y1") for t in sheet.all("line") if "#dde2e6" in t.get("style", ""))
    assert right - 50 < at["x1"][0] < right
    assert at["x1"][1] > bottom + 24
    assert at["x2"][0] < 60
    assert at["x2"][1] < top - 6
    assert at["z1 = 13, z2 = 21"][1] < at["x2"][1]


def test_a_picture_is_as_large_as_its_longer_side_allows() -> None:
    """560 units of the longer side, whichever that is."""
    for box, wide, tall in ((BOX, 560.0, 392.0), (Box(-3.0, -1.6, 1.0, 3.0, 10), 392.0, 560.0)):
        sheet = Sheet(ContourPicture(BlockingContour(PAIR, Requirements(), box, (), ()), ()).svg(EN))
        lines = [t for t in sheet.all("line") if "#dde2e6" in t.get("style", "")]
        assert max(num(t, "x2") - num(t, "x1") for t in lines) == pytest.approx(wide, abs=0.02)
        assert max(num(t, "y2") - num(t, "y1") for t in lines) == pytest.approx(tall, abs=0.02)
        assert sheet.outside() == []


def test_a_contour_with_many_lines_has_room_for_its_key() -> None:
    flat = Box(-0.5, 1.5, 0.0, 0.2, 10)
    names = ("undercut_first", "undercut_second", "contact_ratio", "approach", "recess", "equal_sliding")
    lines = tuple(ContourLine(name, None, (0.1 * k + 0j, 0.1 * k + 0.2j)) for k, name in enumerate(names))
    many = BlockingContour(PAIR, Requirements(), flat, lines, ())
    sheet = Sheet(ContourPicture(many, (("one", (0.1, 0.1)), ("two", (0.3, 0.1)))).svg(EN))
    assert sheet.outside() == []
    assert sheet.all("path") == []
    rows = [num(t, "y") for t in sheet.all("text") if num(t, "x") > 640]
    assert max(rows) < sheet.height - 4


@pytest.mark.parametrize(
    ("size", "step"), [(0.69, 0.05), (0.71, 0.1), (1.41, 0.2), (2.79, 0.2), (2.81, 0.5), (14.1, 2.0), (60.0, 5.0)]
)
def test_a_grid_has_at_most_fourteen_steps(size: float, step: float) -> None:
    assert grid_step(Box(0.0, size, 0.0, size / 2, 10)) == step
    assert grid_step(Box(0.0, size / 2, 0.0, size, 10)) == step


def test_what_is_cut_off_at_a_box_is_what_lies_in_it() -> None:
    """Against the intersection of the same chain by shapely, for chains that leave and come back."""
    rng = np.random.default_rng(4)
    for _ in range(40):
        points = rng.uniform(-1.5, 2.5, 12) + 1j * rng.uniform(-1.5, 2.5, 12)
        pieces = clipped([complex(p) for p in points], Box(0.0, 1.0, 0.0, 1.0, 5))
        cut = shapely.LineString(np.column_stack((points.real, points.imag))).intersection(shapely.box(0, 0, 1, 1))
        length = sum(abs(b - a) for piece in pieces for a, b in pairwise(piece))
        assert length == pytest.approx(cut.length, abs=1e-6)
        for piece in pieces:
            for p in piece:
                assert shapely.Point(p.real, p.imag).distance(cut) < 1e-6
    assert clipped([0j, 1 + 0j], Box(0.0, 1.0, 0.0, 1.0, 5)) == [[0j, 1 + 0j]]
    assert clipped([2 + 0j, 3 + 0j], Box(0.0, 1.0, 0.0, 1.0, 5)) == []


def test_a_contour_in_letters_is_legal_where_its_margins_are() -> None:
    """61 columns over the box and half as many rows a length, of which a mark takes one; x1 and x2 at the ends."""
    from geometry.gears.shifts.external import least_margin

    lines = contour_text(CONTOUR, {"1": (0.5, 0.5), "2": (1.5, -0.3)}, EN).splitlines()
    *rows, foot = lines
    assert len(rows) == round(61 * 1.4 / 2.0 / 2)
    heights = np.linspace(1.1, -0.3, len(rows))
    assert [row[:6] for row in rows] == [f"{y:6.2f}".replace("-", "\N{MINUS SIGN}") for y in heights]
    across = np.linspace(-0.5, 1.5, 61)
    for y, row in zip(heights, rows, strict=True):
        assert len(row) == 7 + 61
        for x, letter in zip(across, row[7:], strict=True):
            if letter in "12":
                continue
            assert letter == ("#" if least_margin(PAIR, Requirements(), float(x), float(y)) >= 0 else ".")
    marked = {
        row[7:][k]: (across[k], y)
        for y, row in zip(heights, rows, strict=True)
        for k in range(61)
        if row[7:][k] in "12"
    }
    assert abs(marked["1"][0] - 0.5) < 0.018
    assert abs(marked["1"][1] - 0.5) < 0.036
    assert marked["2"] == (1.5, pytest.approx(-0.3))
    assert foot.split() == ["\N{MINUS SIGN}0.50", "1.50", "x1"]
    assert foot.index("\N{MINUS SIGN}0.50") == 7
    assert foot.index("1.50") + 4 == 7 + 61
    assert PICTURE.letters(EN).splitlines()[0][:6] == "  1.10"
    assert PICTURE.letters(words("uk")).splitlines()[0][:6] == "  1,10"
    # the second of three is beyond the box, and shown in no picture
    assert PICTURE.shown(EN) == {"1: chosen": (0.5, 0.5), "3: edge": (1.5, -0.3)}


def test_tools_and_wishes_of_rings_are_told() -> None:
    cutter = PinionCutter(1.0, 20, math.radians(20.0), 0.1, 1.25, 0.2)
    ring = InternalShiftPair(20, 60, RACK, cutter)
    assert region_text(CONTOUR, EN) == "region: ε ≥ 1.1, S_a ≥ 0.3 m"
    inner = BlockingContour(ring, InternalRequirements(0.25, 1.2), BOX, (), ())
    assert region_text(inner, EN) == "region: ε ≥ 1.2, S_a ≥ 0.25 m, c ≥ 0.2 m"
    rack = "α = 20°, h_a* = 1, c* = 0.25, ρ_f* = 0.38"
    assert tool_texts(PAIR, EN) == [rack]
    assert tool_texts(ring, EN) == [
        rack, "r_a2 = r_2 - (1 - x_2 - k_2) m, k_2 = 0.25 - 0.125 x_2".replace("-", MINUS),
        "cutter of the ring: z_0 = 20, x_0 = 0.1, h_a0* = 1.25, ρ_0* = 0.2"]  # fmt: skip
    rooted = InternalShiftPair(20, 60, RACK, RoundedRoot(1.25, 0.3), plain_tip=True, pinion_cutter=cutter)
    assert tool_texts(rooted, EN)[1:] == [
        "r_a2 = r_2 - (1 - x_2 - k_2) m, k_2 = 0".replace("-", MINUS),
        "rounded root of the ring: h_f2* = 1.25, ρ = 0.3 m",
        "cutter of the pinion: z_0 = 20, x_0 = 0.1, h_a0* = 1.25, ρ_0* = 0.2"]  # fmt: skip
    full = InternalShiftPair(20, 60, RACK, RoundedRoot(1.25, None))
    assert "full" in tool_texts(full, EN)[2]


SQUARE = np.array([-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j])
MAP = ErrorMap("Errors", "mm", (10.0, 30.0, 60.0, 100.0), (0.1, 0.3, 0.5),
               ((30 + 40j, (SQUARE, 2 * SQUARE)),), ("left", "right"), 5.0)  # fmt: skip


def colour(text: str) -> tuple[int, ...]:
    return tuple(int(text[k : k + 2], 16) for k in (1, 3, 5))


def test_an_error_map_is_read_off_by_its_bands_and_its_key() -> None:
    """Bands to scale about the middle, the outer ones first; their colour is that of their value in the key."""
    sheet = Sheet(MAP.svg(EN))
    bands = sheet.all("circle")
    assert len(bands) == 4
    radii = [num(t, "r") for t in bands]
    assert [r / radii[0] for r in radii] == pytest.approx([1.0, 0.6, 0.3, 0.1], abs=1e-4)
    middle = complex(num(bands[0], "cx"), num(bands[0], "cy"))
    assert all(complex(num(t, "cx"), num(t, "cy")) == middle for t in bands)
    assert middle.real - radii[0] > 0
    assert middle.imag - radii[0] > 26
    assert middle.imag + radii[0] < sheet.height
    # the hole within the least radius is white
    assert style(bands[-1], "fill") == "#ffffff"
    key = [t for t in sheet.all("rect") if num(t, "height") == 22]
    texts = [("".join(t.itertext()), num(t, "x"), num(t, "y")) for t in sheet.all("text")]
    told = []
    for box in key:
        (text,) = [t for t, x, y in texts if 28 < x - num(box, "x") < 44 and 10 < y - num(box, "y") < 20]
        told.append((float(text.removesuffix(" mm")), style(box, "fill")))
    assert [value for value, _ in told] == pytest.approx(list(np.linspace(0.5, 0.1, 9)), rel=1e-3)
    assert all(num(b, "y") - num(a, "y") == 22 for a, b in pairwise(key))
    shades = dict(told)
    assert [style(t, "fill") for t in bands[:3]] == [shades[0.5], shades[0.3], shades[0.1]]
    # from pale green over yellow to red: redder step by step
    ways = [colour(shade) for _, shade in reversed(told) if shade]
    assert all(b[1] < a[1] for a, b in pairwise(ways[4:]))
    assert all(b[0] > a[0] for a, b in pairwise(ways[:5]))
    assert (ways[0], ways[4], ways[-1]) == ((232, 245, 233), (255, 236, 179), (229, 115, 115))
    assert ways[2] == tuple(round((a + b) / 2) for a, b in zip(ways[0], ways[4], strict=True))
    # what is reached, enlarged about its place, y upwards
    unit = radii[0] / 100.0
    polygons = sheet.all("polygon")
    for polygon, size, name in zip(polygons, (5.0, 10.0), ("left", "right"), strict=True):
        points = np.array([complex(*map(float, p.split(","))) for p in polygon.get("points", "").split()])
        place = (points - middle).conjugate() / unit
        assert np.abs(place - (30 + 40j + size * SQUARE)).max() < 0.01
        (sample,) = [
            t for t in sheet.all("rect") if num(t, "height") == 13 and style(t, "stroke") == style(polygon, "stroke")
        ]
        at = next((x, y) for t, x, y in texts if t == name)
        assert 28 < at[0] - num(sample, "x") < 44
        assert num(sample, "y") < at[1] < num(sample, "y") + 16
    assert {"Errors", "5 : 1", "r = 10 … 100 mm"} <= {t for t, _, _ in texts}
    rows = sorted(y for t, x, y in texts if x > middle.real + radii[0])
    assert min(b - a for a, b in pairwise(rows)) > 12
    assert sheet.outside() == []
    assert html.unescape(MAP.svg(EN)).count("<svg") == 1


def test_an_error_map_of_one_value_has_one_colour_and_no_reach() -> None:
    sheet = Sheet(ErrorMap("Errors", "mm", (0.0, 50.0), (0.2,)).svg(EN))
    assert len(sheet.all("circle")) == 1
    assert {style(t, "fill") for t in sheet.all("rect") if num(t, "height") == 22} == {"#e8f5e9"}
    assert sheet.all("polygon") == []
    texts = sheet.texts()
    assert "r = 0 … 50 mm" in texts
    assert not any(t.endswith(": 1") for t in texts)


def test_a_power_behind_an_index_stands_on_the_line() -> None:
    """The square of a driver's velocity was small and low, as a part of its index."""
    made = ElementTree.fromstring(written(0, 0, "ε_2/ω_1² + β_2/ω_3³"))
    assert "".join(made.itertext()) == "ε2/ω1² + β2/ω3³"
    assert [one.text for one in made if "font-size" in one.get("style", "")] == ["2", "1", "2", "3"]
