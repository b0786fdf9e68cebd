"""The parts list on paper: form 1 of GOST 2.106 on upright A4, with form 2 of the title block first, then 2a."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from decimal import Decimal
from itertools import zip_longest

from geometry.base.record import Record
from parts.base.texts import N_, Text, Words, in_context, words
from parts.drawing.canvas import TEXT_HEIGHT, Box, Canvas, Paper, text_of, text_width
from parts.drawing.cells import INDENT, wrapped, write_cell
from parts.drawing.choice import blank
from parts.drawing.expected import Expected
from parts.drawing.title_block import FORM_2, FORM_2A, Form

# GOST 2.106: widths of the columns, height of the head and of a row, mm
_COLUMNS = (6.0, 6.0, 8.0, 70.0, 63.0, 10.0, 22.0)
_HEAD, _ROW = 15.0, 8.0
_HEADS: tuple[Text, ...] = (
    in_context("parts list", "Format"), in_context("parts list", "Zone"), in_context("parts list", "Item"),
    in_context("parts list", "Designation"), in_context("parts list", "Name"), in_context("parts list", "Qty"),
    in_context("parts list", "Note"),
)  # fmt: skip
# below it a mass is told in g, kg
_SMALL = 0.1
# the column of names
_NAMES = 4
_KILOGRAMS, _GRAMS = N_("{mass} kg"), N_("{mass} g")
# sections of a list in their order
SECTIONS: dict[str, Text] = {
    "parts": in_context("parts list", "Parts"),
    "standard": in_context("parts list", "Standard items"),
}
_Cells = tuple[str, ...]


class ListRow(Record):
    """A position: what it is, how many of it, the mass of one and of all, kg; None: its density is not known.

    ``mass`` is None too where parts of several masses share a position; ``parts``: their ids.
    """

    section: str
    position: int
    designation: str
    name: str
    standard: str
    material: str
    count: int
    mass: float | None
    total: float | None
    parts: tuple[str, ...]


def form_of(number: int) -> Form:
    """The title block of the sheet of a number."""
    return FORM_2 if number == 1 else FORM_2A


def list_sheets(rows: Sequence[ListRow], language: str) -> list[Expected]:
    """The sheets of a list, without their title blocks; no section begins at the end of a sheet."""
    lines = list(_lines(rows, language))
    sheets: list[Expected] = []
    while lines or not sheets:
        canvas = blank("A4", upright=True)
        floor = canvas.frame.low + form_of(len(sheets) + 1).size[1]
        room = int((canvas.frame.high - _HEAD - floor) / _ROW + 1e-9)
        shown = lines[:room]
        # a name goes on with its number, a heading with what stands below it
        while len(lines) > room and len(shown) > 1 and (_is_heading(shown[-1]) or not (shown[-1][2] or lines[room][2])):
            shown.pop()
        canvas.box("FRAME", canvas.frame)
        _table(canvas, complex(canvas.frame.left, canvas.frame.high), shown, room, language)
        del lines[: len(shown)]
        while lines and not any(lines[0]):
            del lines[0]
        sheets.append(Expected(canvas, Paper(1.0, 0j), ()))
    return sheets


def list_size(rows: Sequence[ListRow], language: str) -> tuple[float, float]:
    """Width and height of a list that stands on a drawing, mm."""
    return sum(_COLUMNS), _HEAD + _ROW * len(list(_lines(rows, language)))


def draw_list(canvas: Canvas, corner: complex, rows: Sequence[ListRow], language: str) -> None:
    """A list on a drawing, its upper left corner at ``corner``."""
    lines, (width, height) = list(_lines(rows, language)), list_size(rows, language)
    # the table has lines on the right of its columns, the title block one below
    canvas.line("FRAME", corner - 1j * height, corner)
    canvas.line("FRAME", corner, corner + width)
    _table(canvas, corner, lines, len(lines), language)


def _table(canvas: Canvas, corner: complex, lines: Sequence[_Cells], room: int, language: str) -> None:
    """Head, lines and free rows, as many as there is room for."""
    _form(canvas, corner, room, language)
    for number, cells in enumerate(lines):
        _write(canvas, cells, corner - 1j * (_HEAD + _ROW * (number + 1)))


def _is_heading(cells: _Cells) -> bool:
    """Whether a line is the heading of a section, or is left free."""
    return not any(cells) or len(cells) == 1


def _lines(rows: Sequence[ListRow], language: str) -> Iterator[_Cells]:
    """The lines of a list: of a section its heading between free ones, of a position as many as its name needs."""
    told, room = words(language), _COLUMNS[_NAMES] - 2 * INDENT
    section = ""
    for row in rows:
        if row.section != section:
            section = row.section
            yield from (("",), (told.say(SECTIONS[section]),), ("",))
        names = wrapped(row.name, room, TEXT_HEIGHT)
        # a standard is not torn from its number
        if row.standard and text_width(f"{names[-1]} {row.standard}", TEXT_HEIGHT) <= room:
            names[-1] += f" {row.standard}"
        elif row.standard:
            names += wrapped(row.standard, room, TEXT_HEIGHT)
        mass = "" if row.mass is None else _mass(row.mass, told)
        marks = wrapped(row.designation, _COLUMNS[_NAMES - 1] - 2 * INDENT, TEXT_HEIGHT) or [""]
        yield ("", "", str(row.position), marks[0], names[0], str(row.count), mass)
        yield from (("", "", "", *pair, "", "") for pair in zip_longest(marks[1:], names[1:], fillvalue=""))


def mass_text(mass: float) -> str:
    """Three digits that count, never with a power of ten."""
    return f"{Decimal(f'{mass:#.3g}'):f}"


def _mass(mass: float, told: Words) -> str:
    """A mass in kg, a small one in g."""
    text, value = (_GRAMS, 1e3 * mass) if mass < _SMALL else (_KILOGRAMS, mass)
    return told.text(text, mass=told.decimal(mass_text(value)))


def _form(canvas: Canvas, corner: complex, room: int, language: str) -> None:
    """Lines and head of the table."""
    x, high = corner.real, corner.imag
    left, low = x, high - _HEAD - _ROW * room
    for head, width in zip(_HEADS, _COLUMNS, strict=True):
        text = words(language).say(head)
        # heads that would be made small are read from the right
        if text_of(text, 0j, TEXT_HEIGHT, width - 2 * INDENT).runs[0].height < TEXT_HEIGHT:
            long = min(text_width(text, TEXT_HEIGHT), _HEAD - 2 * INDENT)
            at = complex(x + (width + TEXT_HEIGHT) / 2, high - (_HEAD + long) / 2)
            canvas.write_rising(text, at, TEXT_HEIGHT, _HEAD - 2 * INDENT)
        else:
            write_cell(canvas, text, Box(x, high - _HEAD, x + width, high), TEXT_HEIGHT)
        x += width
        canvas.line("FRAME", complex(x, low), complex(x, high))
    for number in range(room + 1):
        y = high - _HEAD - _ROW * number
        canvas.line("TABLE" if number else "FRAME", complex(left, y), complex(x, y))


def _write(canvas: Canvas, cells: _Cells, corner: complex) -> None:
    """A line of the list from its lower left corner; a heading is underlined, in the middle of the names."""
    left, low = corner.real, corner.imag
    if len(cells) == 1:
        x = left + sum(_COLUMNS[:_NAMES])
        if cells[0]:
            write_cell(canvas, cells[0], Box(x, low, x + _COLUMNS[_NAMES], low + _ROW), TEXT_HEIGHT)
            box = canvas.texts[-1].box
            canvas.line("TABLE", complex(box.left, box.low - 0.2), complex(box.right, box.low - 0.2))
        return
    for number, (text, width) in enumerate(zip(cells, _COLUMNS, strict=True)):
        if text:
            box = Box(left, low, left + width, low + _ROW)
            write_cell(canvas, text, box, TEXT_HEIGHT, middle=number not in (_NAMES, _NAMES - 1))
        left += width
