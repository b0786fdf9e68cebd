"""The forms of the title block, cell by cell as the figures of GOST 2.104-2006 have them, and what stands in each."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Any

import pytest
import shapely

from geometry.approximation.outline import CadCurve
from geometry.base.errors import ParameterError
from parts.base.texts import words
from parts.drawing.canvas import Box, Canvas, Text, text_width
from parts.drawing.cells import letters_held, wrapped, write_lines
from parts.drawing.title_block import (
    FORM_1,
    FORM_2,
    FORM_2A,
    Form,
    TitleBlock,
    check_held,
    draw_title_block,
    draw_turned,
    title_block_of,
    turned_box,
)
from parts.keys.title import TitleBlockTable

# left, low, width, height, mm from the lower left corner of the form
Cell = tuple[float, float, float, float]
# of the table of changes and of those who sign: graphs 14 to 18, and 10 to 13, all rows 5 mm high
CHANGES, PEOPLE = (7, 10, 23, 15, 10), (17, 23, 15, 10)
ROLES = ("Drawn", "Checked", "Tech.", "", "Norms", "Approved")


def row(low: float, widths: Sequence[float], height: float = 5.0) -> list[Cell]:
    return [(sum(widths[:k]), low, wide, height) for k, wide in enumerate(widths)]


def rows(lows: Iterable[float], widths: Sequence[float]) -> list[Cell]:
    return [cell for low in lows for cell in row(low, widths)]


# what cells a form has: drawn in thick lines, and in thin ones between these
THICK: dict[str, list[Cell]] = {
    "1": [
        *row(35, CHANGES, 20), *row(30, CHANGES), *row(0, PEOPLE, 30),
        (65, 40, 120, 15), (65, 15, 70, 25), (65, 0, 70, 15), (135, 0, 50, 15),
        (135, 35, 15, 5), (150, 35, 17, 5), (167, 35, 18, 5), (135, 20, 15, 15), (150, 20, 17, 15), (167, 20, 18, 15),
        (135, 15, 20, 5), (155, 15, 30, 5),
    ],
    "2": [
        *row(30, CHANGES, 10), *row(25, CHANGES), *row(0, PEOPLE, 25), (65, 25, 120, 15), (65, 0, 70, 25),
        (135, 0, 50, 15), (135, 20, 15, 5), (150, 20, 15, 5), (165, 20, 20, 5), (135, 15, 15, 5), (150, 15, 15, 5),
        (165, 15, 20, 5),
    ],
    "2a": [*row(0, CHANGES), *row(5, CHANGES, 10), (65, 0, 110, 15), (175, 8, 10, 7), (175, 0, 10, 8)],
}  # fmt: skip
THIN: dict[str, list[Cell]] = {
    "1": [*rows((35, 40, 45, 50), CHANGES), *rows(range(0, 30, 5), PEOPLE),
          *((135 + 5 * k, 20, 5, 15) for k in range(3))],
    "2": [*rows((30, 35), CHANGES), *rows(range(0, 25, 5), PEOPLE), *((135 + 5 * k, 15, 5, 5) for k in range(3))],
    "2a": rows((5, 10), CHANGES),
}  # fmt: skip
# cells with the words that stand in all such blocks: in their middle, those of people on the left
HEAD = ("Rev.", "Sheet", "Document", "Sign.", "Date")


def head(low: float) -> list[tuple[str, Cell]]:
    return list(zip(HEAD, row(low, CHANGES), strict=True))


NAMED: dict[str, list[tuple[str, Cell]]] = {
    "1": [*head(30), ("Stage", (135, 35, 15, 5)), ("Mass", (150, 35, 17, 5)), ("Scale", (167, 35, 18, 5))],
    "2": [*head(25), ("Stage", (135, 20, 15, 5)), ("Sheet", (150, 20, 15, 5)), ("Sheets", (165, 20, 20, 5))],
    "2a": [*head(0), ("Sheet", (175, 8, 10, 7))],
}
SIGNING = {
    "1": {name: 25.0 - 5 * k for k, name in enumerate(ROLES) if name},
    "2": {name: 20.0 - 5 * k for k, name in enumerate(("Drawn", "Checked", "", "Norms", "Approved")) if name},
    "2a": {},
}
# graphs 1 to 9: cell and height of capitals
FILLED: dict[str, dict[str, tuple[Cell, float]]] = {
    "1": {
        "name": ((65, 15, 70, 25), 5.0), "designation": ((65, 40, 120, 15), 7.0), "material": ((65, 0, 70, 15), 5.0),
        "letter": ((135, 20, 5, 15), 3.5), "mass": ((150, 20, 17, 15), 3.5), "scale": ((167, 20, 18, 15), 3.5),
        "organisation": ((135, 0, 50, 15), 5.0),
    },
    "2": {
        "name": ((65, 0, 70, 25), 5.0), "designation": ((65, 25, 120, 15), 7.0), "letter": ((135, 15, 5, 5), 2.5),
        "organisation": ((135, 0, 50, 15), 5.0),
    },
    "2a": {"designation": ((65, 0, 110, 15), 7.0)},
}  # fmt: skip
# number of the sheet and of sheets: with their names in one cell, or below these
COUNTED: dict[str, list[tuple[str, Cell]]] = {
    "1": [("Sheet 3", (135, 15, 20, 5)), ("Sheets 4", (155, 15, 30, 5))],
    "2": [("3", (150, 15, 15, 5)), ("4", (165, 15, 20, 5))],
    "2a": [("3", (175, 0, 10, 8))],
}
FORMS: dict[str, Form] = {"1": FORM_1, "2": FORM_2, "2a": FORM_2A}
BLOCK = TitleBlock(
    "Gear", "AB.1", "5:2", "Group", "Steel", "2.5", "O", "1.2", 3, 4,
    (("drawn", "Ann"), ("checked", "Ben"), ("technical_check", "Cat"), ("standards_check", "Dan"), ("approved", "Eve")),
)  # fmt: skip


def straight(curve: CadCurve, corner: complex = 0j) -> shapely.LineString:
    """A line from a corner."""
    ends = [complex(curve.point(t)) - corner for t in curve.domain]
    return shapely.LineString([(p.real, p.imag) for p in ends])


def bounds(cells: Iterable[Cell]) -> Any:
    return shapely.union_all([shapely.box(x, y, x + w, y + h).exterior for x, y, w, h in cells])


def drawn(name: str, block: TitleBlock = BLOCK) -> tuple[Canvas, complex]:
    """A form on paper, and its lower left corner."""
    canvas = Canvas(420.0, 297.0, "A3")
    draw_title_block(canvas, block, "en", FORMS[name])
    return canvas, complex(415 - 185, 5)


@pytest.mark.parametrize("name", FORMS)
def test_lines_are_the_bounds_of_its_cells_and_none_is_drawn_twice(name: str) -> None:
    canvas, corner = drawn(name)
    size = {"1": 55, "2": 40, "2a": 15}[name]
    assert draw_title_block(Canvas(420.0, 297.0, "A3"), BLOCK, "en", FORMS[name]) == Box(230.0, 5.0, 415.0, 5.0 + size)
    for layer, cells in (("FRAME", THICK[name]), ("TABLE", THIN[name])):
        own = [stroke.curve for stroke in canvas.strokes if stroke.layer == layer]
        lines = [line for line in (straight(curve, corner) for curve in own) if line.bounds[0] > -1]
        expected = bounds(cells)
        if layer == "TABLE":
            expected = expected.difference(bounds(THICK[name]).buffer(1e-6))
        whole = shapely.union_all(lines)
        assert whole.symmetric_difference(expected).length < 1e-3
        assert sum(line.length for line in lines) == pytest.approx(whole.length, abs=1e-9)


def text(canvas: Canvas, words_: str, cell: Cell, corner: complex) -> Text:
    """The one line of text that lies in a cell."""
    x, y, w, h = cell
    inside = shapely.box(x, y, x + w, y + h)
    middles = [complex(t.box.left + t.box.right, t.box.low + t.box.high) / 2 - corner for t in canvas.texts]
    (found,) = (
        t
        for t, middle in zip(canvas.texts, middles, strict=True)
        if t.text == words_ and inside.contains(shapely.Point(middle.real, middle.imag))
    )
    return found


def stands(found: Text, cell: Cell, corner: complex, size: float, *, middle: bool = True) -> None:
    """In the middle of its cell, or 0.8 mm from its left, capitals as far from below as from above."""
    x, y, w, h = cell
    height, long = shown(found.text, size, w - 1.6)
    assert found.box.right - found.box.left == pytest.approx(long, rel=1e-12)
    at = found.runs[0].at - corner
    left = x + (w - long) / 2 if middle else x + 0.8
    assert (at.real, at.imag) == pytest.approx((left, y + (h - size) / 2), abs=1e-9)
    assert found.runs[0].height == height


def shown(told: str, size: float, room: float) -> tuple[float, float]:
    """Height and length of words: letters narrowed to nine tenths where they must, else of the next size."""
    height = next((h for h in (7.0, 5.0, 3.5, 2.5, 1.8) if h <= size and 0.9 * text_width(told, h) <= room), 1.8)
    return height, min(text_width(told, height), room)


@pytest.mark.parametrize("name", FORMS)
def test_words_stand_in_their_cells(name: str) -> None:
    canvas, corner = drawn(name)
    for word, cell in NAMED[name]:
        stands(text(canvas, word, cell, corner), cell, corner, 2.5)
    people = dict(
        zip(("Drawn", "Checked", "Tech.", "Norms", "Approved"), ("Ann", "Ben", "Cat", "Dan", "Eve"), strict=True)
    )
    for word, low in SIGNING[name].items():
        for what, cell, middle in (
            (word, (0, low, 17, 5), False),
            (people[word], (17, low, 23, 5), False),
            ("1.2", (55, low, 10, 5), True),
        ):
            stands(text(canvas, what, cell, corner), cell, corner, 2.5, middle=middle)
    for key, (cell, size) in FILLED[name].items():
        stands(text(canvas, getattr(BLOCK, key), cell, corner), cell, corner, size)
    for word, cell in COUNTED[name]:
        stands(text(canvas, word, cell, corner), cell, corner, 2.5, middle=name != "1")
    # graphs 31 and 32 below the frame
    copied, format_ = (next(t for t in canvas.texts if t.text == one) for one in ("Copied", "Format A3"))
    assert corner.real < copied.box.left < copied.box.right < format_.box.left < format_.box.right <= 415.0 + 1e-9
    assert all(0.0 < one.box.low < one.box.high < corner.imag for one in (copied, format_))
    count = len(NAMED[name]) + 3 * len(SIGNING[name]) + len(FILLED[name]) + len(COUNTED[name]) + 2
    assert len([t for t in canvas.texts if t.runs and t.runs[0].way == 1]) == count


@pytest.mark.parametrize("name", FORMS)
def test_the_only_sheet_has_no_number_and_nobody_no_date(name: str) -> None:
    canvas, _ = drawn(name, TitleBlock("Gear", date="1.2", people=(("drawn", ""), ("approved", "Eve"))))
    told = sorted(t.text for t in canvas.texts if t.runs and t.runs[0].way == 1)
    signed = {"1": [*filter(None, ROLES), "Eve", "1.2"], "2": [*SIGNING["2"], "Eve", "1.2"], "2a": []}[name]
    counted = {"1": ["Sheet", "Sheets 1"], "2": ["1"], "2a": []}[name]
    entries = ["Gear"] if name != "2a" else []
    below = ["Copied", "Format A3"]
    assert told == sorted([*(word for word, _ in NAMED[name]), *signed, *counted, *entries, *below])


def test_a_signature_without_a_date_leaves_its_cell_free() -> None:
    canvas, corner = drawn("1", TitleBlock("Gear", people=(("approved", "Eve"),)))
    assert text(canvas, "Eve", (17, 0, 23, 5), corner)
    assert not [t for t in canvas.texts if 55 < t.box.left - corner.real < 65 and t.box.low - corner.imag < 5]


def test_long_names_dates_and_designations_are_squeezed_into_their_cells() -> None:
    """0.8 mm are free on both sides: of 23, of 10, of 70 mm."""
    long = "words of a length that no cell has " * 3
    canvas, corner = drawn("1", TitleBlock("Gear", date=long, people=(("drawn", long),)))
    name, date = (text(canvas, long, (x, 25, wide, 5), corner) for x, wide in ((17, 23), (55, 10)))
    assert [name.box.left - corner.real, name.box.right - corner.real] == pytest.approx([17.8, 39.2])
    assert [date.box.left - corner.real, date.box.right - corner.real] == pytest.approx([55.8, 64.2])
    turned = Canvas(420.0, 297.0, "A3")
    draw_turned(turned, long)
    assert [turned.texts[0].box.left, turned.texts[0].box.right] == pytest.approx([20.8, 89.2])


def test_columns_of_the_margin_have_their_lines_and_words() -> None:
    """GOST 2.104, graphs 19 to 25: names in the first 5 mm, in the middle of their length, read from the right."""
    canvas, _ = drawn("1")
    left = [s for s in canvas.strokes if max(s.curve.point(t).real for t in s.curve.domain) <= 20 + 1e-9]
    assert {s.layer for s in left} == {"FRAME"}
    lines = {tuple(sorted((round(x, 9), round(y, 9)) for x, y in straight(s.curve).coords)) for s in left}
    below = [5, 30, 65, 90, 115, 150]
    above = [292, 232, 172]
    level = {((8.0, y), (20.0, y)) for y in (*below, *above)}
    upright = {((x, low), (x, high)) for x in (8.0, 13.0) for low, high in ((5, 150), (172, 292))}
    assert lines == level | upright
    names = ["Orig. no.", "Sign., date", "Repl. no.", "Dupl. no.", "Sign., date", "First used in", "Ref. no."]
    spans = [*pairwise(below), (232, 292), (172, 232)]
    told = [t for t in canvas.texts if t.runs[0].way == 1j]
    assert [t.text for t in told] == names
    for found, (low, high) in zip(told, spans, strict=True):
        long = text_width(found.text, 2.5)
        assert found.runs[0].at == pytest.approx(complex(8 + 2.5 + 1.25, (low + high - long) / 2), abs=1e-9)
        assert found.runs[0].height == 2.5
        assert (found.box.low, found.box.high) == pytest.approx(((low + high - long) / 2, (low + high + long) / 2))


@pytest.mark.parametrize(
    ("width", "height", "paper", "corners"),
    [
        (420.0, 297.0, "A3", (20, 278, 90, 292)),
        (297.0, 420.0, "A3", (20, 345, 34, 415)),
        (210.0, 297.0, "A4", (20, 278, 90, 292)),
        (594.0, 594.0, "A2x", (20, 575, 90, 589)),
    ],
)
def test_the_designation_once_more_is_upside_down_or_read_from_the_right(
    width: float, height: float, paper: str, corners: tuple[float, ...]
) -> None:
    """Graph 26, 70 by 14 mm: along the long side of the sheet, on A4 along the upper one, in the middle of its cell."""
    canvas = Canvas(width, height, paper)
    left, low, right, high = corners
    assert turned_box(canvas) == Box(*corners)
    draw_turned(canvas, "")
    assert canvas.texts == []
    lines = shapely.union_all([straight(s.curve) for s in canvas.strokes])
    assert {s.layer for s in canvas.strokes} == {"FRAME"}
    assert lines.symmetric_difference(shapely.box(*corners).exterior).length < 1e-9
    draw_turned(canvas, "AB.123")
    (run,) = canvas.texts[0].runs
    way = -1 if right - left > high - low else 1j
    assert (run.way, run.height) == (way, 7.0)
    middle = run.at + way * complex(text_width("AB.123", 7.0), 7.0) / 2
    assert middle == pytest.approx(complex(left + right, low + high) / 2, abs=1e-9)
    assert run.width == pytest.approx(text_width("AB.123", 7.0))


def test_a_block_takes_the_keys_of_its_table() -> None:
    table = TitleBlockTable(
        name="a", designation="b", organisation="c", material="d", mass="e", letter="f", date="g", drawn="h",
        checked="i", technical_check="j", standards_check="k", approved="l",
    )  # fmt: skip
    people = (("drawn", "h"), ("checked", "i"), ("technical_check", "j"), ("standards_check", "k"), ("approved", "l"))
    assert title_block_of(table, "2:1", 5, 6) == TitleBlock("a", "b", "2:1", "c", "d", "e", "f", "g", 5, 6, people)
    alone = title_block_of(table, "2:1")
    assert (alone.sheet, alone.sheets) == (1, 1)


def held(rows_: int, wide: float, letter: str = "i") -> int:
    """How many of one letter a cell holds: full rows of 2.5 mm, the last of 1.8 mm narrowed to nine tenths."""
    each = int((wide - 1.6) / text_width(letter, 2.5) + 1e-9)
    return each * (rows_ - 1) + int((wide - 1.6) / (0.9 * text_width(letter, 1.8)) + 1e-9)


@pytest.mark.parametrize(
    ("key", "rows_", "wide"),
    # rows of four millimetres, one is kept free
    [("name", 6, 70), ("designation", 3, 120), ("material", 3, 70), ("organisation", 3, 50), ("mass", 3, 17),
     ("scale", 3, 18), ("letter", 3, 5)],
)  # fmt: skip
def test_words_that_a_cell_does_not_hold_are_refused(key: str, rows_: int, wide: float) -> None:
    most = held(rows_, wide)
    keys = {"name": "x", key: "i" * most}
    check_held(TitleBlock(**keys), FORM_1, turned=False)
    keys[key] += "i"
    with pytest.raises(ParameterError) as caught:
        check_held(TitleBlock(**keys), FORM_1, turned=False)
    assert (caught.value.name, caught.value.code) == (key, "cell_holds_letters")
    assert (caught.value.value, caught.value.numbers) == ("i" * (most + 1), {"most": most})


@pytest.mark.parametrize(("turned", "wide"), [(True, 70)])
def test_a_turned_designation_and_narrow_cells_hold_one_line(turned: bool, wide: float) -> None:
    """Graph 26 has one line; names and dates are narrowed to half of their width."""
    one = int((wide - 1.6) / (0.9 * text_width("i", 1.8)))
    name, date = (int((cell - 1.6) / (0.5 * text_width("i", 1.8))) for cell in (23, 10))
    fine = TitleBlock("x", designation="i" * one, date="i" * date, people=(("drawn", "i" * name), ("approved", "i")))
    check_held(fine, FORM_1, turned=turned)
    wrong = {
        "designation": TitleBlock("x", designation="i" * (one + 1)), "date": TitleBlock("x", date="i" * (date + 1)),
        "approved": TitleBlock("x", people=(("drawn", "i"), ("approved", "i" * (name + 1)))),
    }  # fmt: skip
    for key, most in (("designation", one), ("date", date), ("approved", name)):
        with pytest.raises(ParameterError) as caught:
            check_held(wrong[key], FORM_1, turned=turned)
        assert (caught.value.name, caught.value.numbers) == (key, {"most": most})
    check_held(wrong["designation"], FORM_1, turned=False)


def test_letters_held_are_counted_from_the_beginning() -> None:
    assert letters_held("abcdef", lambda text_: len(text_) <= 4) == 4
    assert letters_held("abcdef", lambda text_: len(text_) <= 9) == 6
    assert letters_held("abcdef", lambda text_: not text_) == 0


def written(told: str, cell: Box, size: float, *, middle: bool = True) -> list[Text]:
    canvas = Canvas(420.0, 297.0, "A3")
    write_lines(canvas, told, cell, size, middle=middle)
    return canvas.texts


def test_lines_of_a_cell_stand_about_its_middle_a_step_of_1_6_heights_apart() -> None:
    cell = Box(10.0, 20.0, 50.0, 50.0)
    long = "wide words in lines of a cell"
    found = written(long, cell, 5.0)
    assert len(found) > 2
    assert " ".join(t.text for t in found) == long
    bases = [t.runs[0].at.imag for t in found]
    middle = 35 - 2.5
    assert bases == pytest.approx([middle + 8.0 * ((len(found) - 1) / 2 - k) for k in range(len(found))])
    assert all((t.box.left + t.box.right) / 2 == pytest.approx(30.0) for t in found)
    # no word would have had room in the line before
    for one, two in pairwise(found):
        assert text_width(f"{one.text} {two.text.split()[0]}", 5.0) > 40 - 1.6 >= text_width(one.text, 5.0)
    assert [t.box.left for t in written(long, cell, 5.0, middle=False)] == pytest.approx([10.8] * len(found))


@pytest.mark.parametrize(("high", "size"), [(25.01, 5.0), (24.99, 4.5), (19.0, 3.5), (13.01, 2.5)])
def test_letters_become_smaller_by_half_a_millimetre_until_all_lines_have_room(high: float, size: float) -> None:
    """Of steps of 1.6 heights of capitals three have room in a cell but for a millimetre."""
    word = "i" * int(25 / text_width("i", 2.5))
    found = written(f"{word} {word} {word}", Box(0.0, 0.0, 39.6, high), 5.0)
    assert [t.text for t in found] == [word] * 3
    assert 3 * 1.6 * size <= high - 1
    assert size == 5.0 or high - 1 < 3 * 1.6 * (size + 0.5)
    gaps = [one.runs[0].at.imag - two.runs[0].at.imag for one, two in pairwise(found)]
    assert gaps == pytest.approx([1.6 * size] * 2)


@pytest.mark.parametrize(("high", "lines"), [(12.9, 2), (8.9, 1), (2.0, 1)])
def test_what_has_no_room_in_the_least_letters_is_squeezed_into_the_last_line(high: float, lines: int) -> None:
    word = "i" * int(25 / text_width("i", 2.5))
    found = written(f"{word} {word} {word}", Box(0.0, 0.0, 39.6, high), 5.0)
    assert [t.text for t in found] == [word] * (lines - 1) + [" ".join([word] * (4 - lines))]
    assert found[-1].box.right - found[-1].box.left == pytest.approx(shown(found[-1].text, 2.5, 38.0)[1])


@pytest.mark.parametrize("size", [2.5, 5.0])
def test_a_word_that_no_line_holds_goes_on_in_the_next_one(size: float) -> None:
    """A line holds what is no longer in the least letters, narrowed; what is broken is so in letters of their size."""
    each, most = (int(30 / text_width("i", h) / narrowed) for h, narrowed in ((size, 1.0), (1.8, 0.9)))
    assert wrapped("i" * most, 30.0, size) == ["i" * most]
    assert wrapped("a " + "i" * (most + 1), 30.0, size)[:2] == ["a", "i" * each]
    assert "".join(wrapped("i" * (most + 1), 30.0, size)) == "i" * (most + 1)
    assert wrapped(" a  b ", 30.0, size) == ["a b"]
    assert wrapped("", 30.0, size) == []


def test_ukrainian_words_stand_in_the_same_cells() -> None:
    canvas = Canvas(420.0, 297.0, "A3")
    draw_title_block(canvas, BLOCK, "uk")
    own = drawn("1")[0]
    assert len(canvas.texts) == len(own.texts)
    for one, two in zip(canvas.texts, own.texts, strict=True):
        if one.runs[0].way == 1:
            assert one.runs[0].at.imag == pytest.approx(two.runs[0].at.imag, abs=0.7)
    assert words("uk").language == "uk"
