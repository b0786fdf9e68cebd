"""A cam's sheet on small paper: pages of diagrams, constructions and tables, in columns that fill the frame."""

from __future__ import annotations

from functools import cache
from itertools import combinations, pairwise

import pytest

from exporters.production.plan import plan_build
from geometry.curves.line_arc import Line
from parts.drawing.canvas import Box, Canvas
from parts.scene.load import scene_from_toml
from tests.parts.cams.sheets.test_joint_diagrams import BASE, ROLLER

EXPORT = """
[[exports]]
format = "sheet"
purpose = "cam"
tolerance = 0.01
intervals = 8
paper = "{paper}"
cells = "{cells}"
"""
PAPERS = {"A4": (210.0, 297.0), "A3": (297.0, 420.0)}


@cache
def pages(paper: str, cells: str = "empty") -> list[Canvas]:
    text = BASE.format(follower=ROLLER.format(offset=6.0)) + EXPORT.format(paper=paper, cells=cells)
    return [job.canvas for job in plan_build(scene_from_toml(text.encode(), "t", "t"), "t", [], []).sheets[::2]]


def table_lines(canvas: Canvas, *, upright: bool) -> list[Line]:
    found = [s.curve for s in canvas.strokes if s.layer == "TABLE" and isinstance(s.curve, Line)]
    return [c for c in found if (abs(c.start.real - c.end.real) < 1e-9) == upright]


def tables(canvas: Canvas) -> list[Box]:
    """The tables of a page in the order in which they are drawn: four lines that close, each once."""
    lines = [s.curve for s in canvas.strokes if s.layer == "TABLE" and isinstance(s.curve, Line)]
    found = []
    for four in zip(lines, lines[1:], lines[2:], lines[3:], strict=False):
        if all(abs(one.end - two.start) < 1e-9 for one, two in zip(four, (*four[1:], four[0]), strict=True)):
            xs, ys = [c.start.real for c in four], [c.start.imag for c in four]
            found.append(Box(min(xs), min(ys), max(xs), max(ys)))
    return found


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("paper", "count"), [("A4", 1), ("A3", 2)])
def test_tables_fill_columns_from_the_top_of_their_pages(paper: str, count: int) -> None:
    first, second, *rest = pages(paper)
    assert rest
    size = PAPERS[paper]
    for number, page in enumerate((first, second, *rest), 1):
        assert (page.width, page.height) == size
        (title,) = (t for t in page.texts if t.text.endswith(f"({number}/{2 + len(rest)})"))
        assert title.box.low > size[1] - 5 - 14
        # words stand within the frame, none over another
        frame = page.frame.grown(1e-6)
        assert all(t.box.within(frame) for t in page.texts)
        for one, other in combinations([t.box for t in page.texts], 2):
            assert not one.grown(-0.05).overlaps(other)
    assert not table_lines(first, upright=True)
    assert not table_lines(second, upright=True)
    assert {s.layer for s in first.strokes} & {"AXIS", "PHASE"}
    assert {s.layer for s in second.strokes} >= {"FRAME", "AXIS"}
    # 4 mm from the frame and between columns of one width
    wide = (size[0] - 20 - 5 - 8 - 4 * (count - 1)) / count
    columns = [24 + k * (wide + 4) for k in range(count)]
    top = size[1] - 5 - 14
    for page in rest:
        boxes = tables(page)
        assert sorted({round(b.left, 6) for b in boxes}) == pytest.approx(
            columns[: len({round(b.left, 6) for b in boxes})]
        )
        assert {round(b.right - b.left, 6) for b in boxes} == {round(wide, 6)}
        for left in columns:
            mine = [b for b in boxes if abs(b.left - left) < 1e-6]
            for above, box in zip([None, *mine], mine, strict=False):
                assert box.high == pytest.approx(top if above is None else above.low - 3.0, abs=1e-6)
                assert box.low > 5 + 4 - 1e-6
    # columns are used from the left, pages from the first
    assert all(min(b.left for b in tables(page)) == pytest.approx(24) for page in rest)


def test_rows_for_a_pen_are_higher_than_printed_ones() -> None:
    """7 mm where students find something, 4.5 in tables that are given, and in every table of numbers."""
    for cells, heights in (("empty", {4.5, 7.0}), ("numbers", {4.5})):
        found = set()
        for page in pages("A4", cells)[2:]:
            for box in tables(page):
                inside = box.grown(1e-6)
                levels = [c.start for c in table_lines(page, upright=False)]
                ys = sorted({round(p.imag, 6) for p in levels if Box(p.real, p.imag, p.real, p.imag).within(inside)})
                steps = {round(b - a, 3) for a, b in pairwise(ys)}
                assert len(steps) == 1
                found |= steps
        assert found == heights


def test_each_row_stands_on_one_page_as_on_the_large_sheet() -> None:
    """What stands in the tables of the large sheet, and nothing else but the scale of a smaller drawing."""

    def told(canvases: list[Canvas]) -> list[str]:
        found = []
        for canvas in canvases:
            boxes = [b.grown(0.2) for b in tables(canvas)]
            found += [t.text for t in canvas.texts if any(t.box.within(b) for b in boxes)]
        return sorted(found)

    large, small = told(pages("A1")), told(pages("A4"))
    assert len(large) > 100
    headings = set(small) - set(large)
    assert all(text[0].isdigit() or "/" in text or "°" in text for text in headings)
    gone = set(large) - set(small)
    assert all(text[0].isdigit() or "/" in text or "°" in text for text in gone)
    # a table that goes on has its heading again, each of its rows stands once
    more = [text for text in small if small.count(text) > large.count(text)]
    assert len(small) >= len(large)
    assert len(more) < 40
