"""The main inscription (title block) of a sheet: forms 1, 2 and 2a of GOST 2.104 in the frame's lower right corner.

``draw_title_block`` draws it onto any canvas; layouts keep ``TITLE_BLOCK[1]`` mm free above the frame's lower side.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from geometry.base.errors import ParameterError
from geometry.base.record import Record
from parts.base.psv import sentences_of
from parts.base.texts import words
from parts.drawing.canvas import SMALL_TEXT, TEXT_HEIGHT, Box, Canvas, text_of, text_width
from parts.drawing.cells import INDENT, fits_cell, fits_line, letters_held, write_cell, write_lines
from parts.keys.title import TitleBlockTable

# left, low, right, high, mm from the lower left corner of a form
_Cell = tuple[float, float, float, float]
_Line = tuple[float, float, float]
# heights of capitals of designation, name and the rest, mm
_LARGE, _MIDDLE = 7.0, 5.0
# names of people and dates are narrowed to this part of their width in their narrow cells
_PEOPLE = 0.5
# who signs a drawing, from the top row down; the fourth row is free
_ROLES = ("drawn", "checked", "technical_check", "", "standards_check", "approved")


# the head of the table of changes: its columns, mm
_CHANGES = (("change", 0, 7), ("change_sheet", 7, 17), ("document", 17, 40), ("signature", 40, 55), ("date", 55, 65))


class Form(Record):
    """A form of GOST 2.104, mm: its size, lines (where, from, to), the words in all such blocks, what each cell holds.

    ``head``: where the head of the table of changes begins; below it who ``signs``, from the top row down, a row may
    be free. ``counts``: cells of the sheet's number and of how many there are, beside their names or below them.
    """

    size: tuple[float, float]
    thick_rows: tuple[_Line, ...]
    thin_rows: tuple[_Line, ...]
    thick_columns: tuple[_Line, ...]
    thin_columns: tuple[_Line, ...]
    head: float
    signs: tuple[str, ...]
    names: dict[str, _Cell]
    entries: tuple[tuple[str, _Cell, float], ...]
    counts: dict[str, _Cell]

    @property
    def labels(self) -> dict[str, _Cell]:
        """The cells of all words that stand in such blocks."""
        head: dict[str, _Cell] = {key: (left, self.head, right, self.head + 5) for key, left, right in _CHANGES}
        rows = ((role, self.head - 5 * k) for k, role in enumerate(self.signs, 1) if role)
        return head | {role: (0, low, 17, low + 5) for role, low in rows} | self.names


# of a drawing, of the first sheet of a text, of its others
FORM_1 = Form(
    (185.0, 55.0),
    ((55, 0, 185), (40, 65, 185), (35, 0, 65), (35, 135, 185), (30, 0, 65), (20, 135, 185), (15, 65, 185), (0, 0, 185)),
    tuple((y, 0, 65) for y in (50, 45, 40, 25, 20, 15, 10, 5)),
    (
        (0, 0, 55), (7, 30, 55), (17, 0, 55), (40, 0, 55), (55, 0, 55), (65, 0, 55), (135, 0, 40), (150, 20, 40),
        (155, 15, 20), (167, 20, 40), (185, 0, 55),
    ),
    ((140, 20, 35), (145, 20, 35)),
    30,
    _ROLES,
    {"letter": (135, 35, 150, 40), "mass": (150, 35, 167, 40), "scale": (167, 35, 185, 40)},
    (
        ("designation", (65, 40, 185, 55), _LARGE), ("name", (65, 15, 135, 40), _MIDDLE),
        ("material", (65, 0, 135, 15), _MIDDLE), ("letter", (135, 20, 140, 35), TEXT_HEIGHT),
        ("mass", (150, 20, 167, 35), TEXT_HEIGHT), ("scale", (167, 20, 185, 35), TEXT_HEIGHT),
        ("organisation", (135, 0, 185, 15), _MIDDLE),
    ),
    {"sheet": (135, 15, 155, 20), "sheets": (155, 15, 185, 20)},
)  # fmt: skip
FORM_2 = Form(
    (185.0, 40.0),
    ((40, 0, 185), (30, 0, 65), (25, 0, 185), (20, 135, 185), (15, 135, 185), (0, 0, 185)),
    tuple((y, 0, 65) for y in (35, 20, 15, 10, 5)),
    (
        (0, 0, 40), (7, 25, 40), (17, 0, 40), (40, 0, 40), (55, 0, 40), (65, 0, 40), (135, 0, 25), (150, 15, 25),
        (165, 15, 25), (185, 0, 40),
    ),
    ((140, 15, 20), (145, 15, 20)),
    25,
    ("drawn", "checked", "", "standards_check", "approved"),
    {"letter": (135, 20, 150, 25), "sheet": (150, 20, 165, 25), "sheets": (165, 20, 185, 25)},
    (
        ("designation", (65, 25, 185, 40), _LARGE), ("name", (65, 0, 135, 25), _MIDDLE),
        ("letter", (135, 15, 140, 20), SMALL_TEXT), ("organisation", (135, 0, 185, 15), _MIDDLE),
    ),
    {"sheet": (150, 15, 165, 20), "sheets": (165, 15, 185, 20)},
)  # fmt: skip
FORM_2A = Form(
    (185.0, 15.0),
    ((15, 0, 185), (8, 175, 185), (5, 0, 65), (0, 0, 185)),
    ((10, 0, 65),),
    ((0, 0, 15), (7, 0, 15), (17, 0, 15), (40, 0, 15), (55, 0, 15), (65, 0, 15), (175, 0, 15), (185, 0, 15)),
    (),
    0,
    (),
    {"sheet": (175, 8, 185, 15)},
    (("designation", (65, 0, 175, 15), _LARGE),),
    {"sheet": (175, 0, 185, 8)},
)
TITLE_BLOCK = FORM_1.size
LABELS = sentences_of(__file__, "labels")
# columns on the left of the frame: width of the names and of all; from below, and from the top: name, height; mm
_NAME, _COLUMNS = 5.0, 12.0
_FROM_BELOW = (("original", 25), ("signed", 35), ("replaces", 25), ("duplicate", 25), ("signed", 35))
# graph 26: long and short side, mm
_TURNED = (70.0, 14.0)
_FROM_TOP = (("first_use", 60), ("reference", 60))


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
    own = {key: getattr(table, key) for key in table.__struct_fields__ if key not in _ROLES}
    return TitleBlock(scale=scale, sheet=sheet, sheets=sheets, people=people, **own)


def check_held(block: TitleBlock, form: Form, *, turned: bool) -> None:
    """Refuse words that their cells do not hold, the designation also where it stands ``turned``.

    Raises
    ------
    ParameterError
        With the cell's key and the number of letters that fit.
    """
    checks: list[tuple[str, str, Callable[[str], bool]]] = [
        (key, getattr(block, key), partial(fits_cell, cell=_at(0j, cell))) for key, cell, _ in form.entries
    ]
    if turned:
        checks.append(("designation", block.designation, partial(fits_line, width=_TURNED[0] - 2 * INDENT)))
    checks += [(role, name, partial(fits_line, width=23 - 2 * INDENT, factor=_PEOPLE)) for role, name in block.people]
    checks.append(("date", block.date, partial(fits_line, width=10 - 2 * INDENT, factor=_PEOPLE)))
    for key, text, fits in checks:
        if not fits(text):
            raise ParameterError(key, text, "cell_holds_letters", most=letters_held(text, fits))


def draw_title_block(canvas: Canvas, block: TitleBlock, language: str, form: Form = FORM_1) -> Box:
    """Draw a title block into the lower right corner of the canvas's frame; the room that it takes, mm."""
    width, height = form.size
    corner = complex(canvas.frame.right - width, canvas.frame.low)
    for layer, rows in (("FRAME", form.thick_rows), ("TABLE", form.thin_rows)):
        for y, a, b in rows:
            canvas.line(layer, corner + complex(a, y), corner + complex(b, y))
    for layer, columns in (("FRAME", form.thick_columns), ("TABLE", form.thin_columns)):
        for x, a, b in columns:
            canvas.line(layer, corner + complex(x, a), corner + complex(x, b))
    labels = form.labels
    for key, cell in labels.items():
        told = words(language).say(LABELS[key])
        write_cell(canvas, told, _at(corner, cell), SMALL_TEXT, middle=key not in _ROLES)
    for role, name in block.people:
        if name and role in labels:
            _, low, _, high = labels[role]
            write_cell(canvas, name, _at(corner, (17, low, 40, high)), SMALL_TEXT, middle=False)
            if block.date:
                write_cell(canvas, block.date, _at(corner, (55, low, 65, high)), SMALL_TEXT)
    for key, cell, size in form.entries:
        write_lines(canvas, getattr(block, key), _at(corner, cell), size)
    _count(canvas, corner, block, form, language)
    _columns(canvas, language)
    return Box(corner.real, corner.imag, corner.real + width, corner.imag + height)


def turned_box(canvas: Canvas) -> Box:
    """Where the designation stands once more, in the upper left corner: along the long side, on A4 along the upper."""
    long, short = _TURNED
    upright = canvas.height > canvas.width and canvas.paper != "A4"
    wide, tall, frame = short if upright else long, long if upright else short, canvas.frame
    return Box(frame.left, frame.high - tall, frame.left + wide, frame.high)


def draw_turned(canvas: Canvas, designation: str) -> None:
    """The designation upside down, on upright sheets read from the right (GOST 2.104, graph 26)."""
    box, room = turned_box(canvas), _TURNED[0] - 2 * INDENT
    canvas.box("FRAME", box)
    if not designation:
        return
    made, middle = text_of(designation, 0j, _LARGE, room), box.middle
    way = 1j if box.tall > _TURNED[1] else -1
    begin = middle - way * complex(made.box.right, made.runs[0].height) / 2
    canvas.write_rising(designation, begin, _LARGE, room, way)


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
            text, room = words(language).say(LABELS[key]), height - 2 * INDENT
            long = min(text_width(text, SMALL_TEXT), room)
            at = complex(left + (_NAME + SMALL_TEXT) / 2, low + (height - long) / 2)
            canvas.write_rising(text, at, SMALL_TEXT, room)
        for x in (left, left + _NAME):
            canvas.line("FRAME", complex(x, start), complex(x, y))


def _count(canvas: Canvas, corner: complex, block: TitleBlock, form: Form, language: str) -> None:
    """Number of the sheet, left out where there is one only (GOST 2.104), and how many there are."""
    for key, cell in form.counts.items():
        number = "" if key == "sheet" and block.sheets == 1 else str(getattr(block, key))
        named = key not in form.labels
        text = f"{words(language).say(LABELS[key])} {number}".strip() if named else number
        write_cell(canvas, text, _at(corner, cell), SMALL_TEXT, middle=not named)


def _at(corner: complex, cell: _Cell) -> Box:
    """A cell of a form on paper."""
    left, low, right, high = cell
    return Box(corner.real + left, corner.imag + low, corner.real + right, corner.imag + high)
