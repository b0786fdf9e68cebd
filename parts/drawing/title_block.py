"""The main inscription (title block) of a sheet: form 1 of GOST 2.104, 185 x 55 mm, in the frame's lower right corner.

``draw_title_block`` draws it onto any canvas; layouts keep ``TITLE_BLOCK[1]`` mm free above the frame's lower side.
"""

from __future__ import annotations

from geometry.base.record import Record
from parts.base.texts import Text, in_context, words
from parts.drawing.canvas import SMALL_TEXT, TEXT_HEIGHT, Box, Canvas, text_width
from parts.drawing.cells import INDENT, write_cell, write_lines
from parts.keys.title import TitleBlockTable

# width and height, mm; GOST 2.104, form 1
TITLE_BLOCK = (185.0, 55.0)
# lines of form 1, mm from the block's lower left corner: where, from, to
_THICK_ROWS = (
    (55, 0, 185), (40, 65, 185), (35, 0, 65), (35, 135, 185), (30, 0, 65), (20, 135, 185), (15, 65, 185), (0, 0, 185),
)  # fmt: skip
_THIN_ROWS = tuple((y, 0, 65) for y in (50, 45, 40, 25, 20, 15, 10, 5))
_THICK_COLUMNS = (
    (0, 0, 55), (7, 30, 55), (17, 0, 55), (40, 0, 55), (55, 0, 55), (65, 0, 55), (135, 0, 40), (150, 20, 40),
    (155, 15, 20), (167, 20, 40), (185, 0, 55),
)  # fmt: skip
_THIN_COLUMNS = ((140, 20, 35), (145, 20, 35))
_LABELS: dict[str, Text] = {
    "change": in_context("title block", "Rev."),
    "change_sheet": in_context("title block, changes", "Sheet"),
    "document": in_context("title block", "Document"),
    "signature": in_context("title block", "Sign."),
    "date": in_context("title block", "Date"),
    "drawn": in_context("title block", "Drawn"),
    "checked": in_context("title block", "Checked"),
    "technical_check": in_context("title block", "Tech."),
    "standards_check": in_context("title block", "Norms"),
    "approved": in_context("title block", "Approved"),
    "letter": in_context("title block", "Stage"),
    "mass": in_context("title block", "Mass"),
    "scale": in_context("title block", "Scale"),
    "sheet": in_context("title block", "Sheet"),
    "sheets": in_context("title block", "Sheets"),
    "original": in_context("title block", "Orig. no."),
    "signed": in_context("title block", "Sign., date"),
    "replaces": in_context("title block", "Repl. no."),
    "duplicate": in_context("title block", "Dupl. no."),
    "reference": in_context("title block", "Ref. no."),
    "first_use": in_context("title block", "First used in"),
}
# columns on the left of the frame: width of the names and of all; from below, and from the top: name, height; mm
_NAME, _COLUMNS = 5.0, 12.0
_FROM_BELOW = (("original", 25), ("signed", 35), ("replaces", 25), ("duplicate", 25), ("signed", 35))
_FROM_TOP = (("first_use", 60), ("reference", 60))
# who signs, from the top row down; the fourth row is free
_ROLES = ("drawn", "checked", "technical_check", "", "standards_check", "approved")
# heights of capitals of designation, name and the rest, mm
_LARGE, _MIDDLE = 7.0, 5.0


class TitleBlock(Record):
    """What stands in the block; ``people`` by role (``drawn``, ``checked``, …); empty where it is left to a pen."""

    name: str
    designation: str = ""
    scale: str = ""
    organisation: str = ""
    material: str = ""
    mass: str = ""
    letter: str = ""
    date: str = ""
    sheet: int = 1
    sheets: int = 1
    people: tuple[tuple[str, str], ...] = ()


def title_block_of(table: TitleBlockTable, scale: str, sheet: int = 1, sheets: int = 1) -> TitleBlock:
    """The block that a scene asks for."""
    people = tuple((role, getattr(table, role)) for role in _ROLES if role)
    return TitleBlock(
        table.name,
        table.designation,
        scale,
        table.organisation,
        table.material,
        table.mass,
        table.letter,
        table.date,
        sheet,
        sheets,
        people,
    )


def draw_title_block(canvas: Canvas, block: TitleBlock, language: str) -> Box:
    """Draw a title block into the lower right corner of the canvas's frame; the room that it takes, mm."""
    width, height = TITLE_BLOCK
    corner = complex(canvas.frame.right - width, canvas.frame.low)
    for layer, rows in (("FRAME", _THICK_ROWS), ("TABLE", _THIN_ROWS)):
        for y, a, b in rows:
            canvas.line(layer, corner + complex(a, y), corner + complex(b, y))
    for layer, columns in (("FRAME", _THICK_COLUMNS), ("TABLE", _THIN_COLUMNS)):
        for x, a, b in columns:
            canvas.line(layer, corner + complex(x, a), corner + complex(x, b))
    _labels(canvas, corner, language)
    _entries(canvas, corner, block)
    _count(canvas, corner, block, language)
    _columns(canvas, language)
    return Box(corner.real, corner.imag, corner.real + width, corner.imag + height)


def _columns(canvas: Canvas, language: str) -> None:
    """The columns in the margin, with the names of their cells."""
    frame = canvas.frame
    canvas.columns = _COLUMNS
    left = frame.left - _COLUMNS
    for cells, start, way in ((_FROM_BELOW, frame.low, 1), (_FROM_TOP, frame.high, -1)):
        y = start
        canvas.line("FRAME", complex(left, y), complex(frame.left, y))
        for key, height in cells:
            low = min(y, y + way * height)
            y += way * height
            canvas.line("FRAME", complex(left, y), complex(frame.left, y))
            text, room = words(language).say(_LABELS[key]), height - 2 * INDENT
            long = min(text_width(text, SMALL_TEXT), room)
            at = complex(left + (_NAME + SMALL_TEXT) / 2, low + (height - long) / 2)
            canvas.write_rising(text, at, SMALL_TEXT, room)
        for x in (left, left + _NAME):
            canvas.line("FRAME", complex(x, start), complex(x, y))


def _labels(canvas: Canvas, corner: complex, language: str) -> None:
    """The words that stand in every block."""

    def label(key: str, cell: tuple[float, float, float, float], *, middle: bool = True) -> None:
        write_cell(canvas, words(language).say(_LABELS[key]), _at(corner, cell), SMALL_TEXT, middle=middle)

    for key, left, right in (
        ("change", 0, 7), ("change_sheet", 7, 17), ("document", 17, 40), ("signature", 40, 55), ("date", 55, 65),
    ):  # fmt: skip
        label(key, (left, 30, right, 35))
    for index, role in enumerate(_ROLES):
        if role:
            label(role, (0, 25 - 5 * index, 17, 30 - 5 * index), middle=False)
    for key, left, right in (("letter", 135, 150), ("mass", 150, 167), ("scale", 167, 185)):
        label(key, (left, 35, right, 40))


def _entries(canvas: Canvas, corner: complex, block: TitleBlock) -> None:
    """What this sheet says; number of the sheet only where there are several (GOST 2.104)."""
    people = dict(block.people)
    for index, role in enumerate(_ROLES):
        low = 25 - 5 * index
        if people.get(role):
            write_cell(canvas, people[role], _at(corner, (17, low, 40, low + 5)), SMALL_TEXT, middle=False)
            if block.date:
                write_cell(canvas, block.date, _at(corner, (55, low, 65, low + 5)), SMALL_TEXT)
    for text, cell, size in (
        (block.designation, (65, 40, 185, 55), _LARGE),
        (block.name, (65, 15, 135, 40), _MIDDLE),
        (block.material, (65, 0, 135, 15), _MIDDLE),
        (block.letter, (135, 20, 140, 35), TEXT_HEIGHT),
        (block.mass, (150, 20, 167, 35), TEXT_HEIGHT),
        (block.scale, (167, 20, 185, 35), TEXT_HEIGHT),
        (block.organisation, (135, 0, 185, 15), _MIDDLE),
    ):
        write_lines(canvas, text, _at(corner, cell), size)


def _count(canvas: Canvas, corner: complex, block: TitleBlock, language: str) -> None:
    """Number of the sheet, left out where there is one only (GOST 2.104), and how many there are."""
    sheet, sheets = (words(language).say(_LABELS[key]) for key in ("sheet", "sheets"))
    number = f" {block.sheet}" if block.sheets > 1 else ""
    for text, left, right in ((f"{sheet}{number}", 135, 155), (f"{sheets} {block.sheets}", 155, 185)):
        write_cell(canvas, text, _at(corner, (left, 15, right, 20)), SMALL_TEXT, middle=False)


def _at(corner: complex, cell: tuple[float, float, float, float]) -> Box:
    """A cell of the form: left, low, right, high from the block's corner."""
    left, low, right, high = cell
    return Box(corner.real + left, corner.imag + low, corner.real + right, corner.imag + high)
