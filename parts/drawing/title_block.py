"""The main inscription (title block) of a sheet: forms 1, 2 and 2a of GOST 2.104 in the frame's lower right corner.

``draw_title_block`` draws it onto any canvas; layouts keep ``TITLE_BLOCK[1]`` mm free above the frame's lower side.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial

from geometry.base.errors import ParameterError
from geometry.base.record import Record
from parts.base.psv import rows_of, sentences_of
from parts.base.texts import words
from parts.drawing.canvas import SMALL_TEXT, Box, Canvas, text_of, text_width
from parts.drawing.cells import INDENT, fits_cell, fits_line, letters_held, write_cell, write_lines
from parts.keys.title import TitleBlockTable

# left, low, right, high, mm from the lower left corner of a form
_Cell = Sequence[float]
# height of a designation that stands turned, mm
_LARGE = 7.0
# names of people and dates are narrowed to this part of their width in their narrow cells
_PEOPLE = 0.5
# who signs a drawing, from the top row down
_ROLES = ("drawn", "checked", "technical_check", "standards_check", "approved")


class Form(Record):
    """A form of GOST 2.104, as its table has it: lines by their layers, and cells by what is written there."""

    lines: list[tuple[str, _Cell]]
    words: Mapping[str, _Cell]
    entries: Mapping[str, _Cell]
    counts: Mapping[str, _Cell]

    @property
    def size(self) -> tuple[float, float]:
        """Width and height, mm."""
        return max(cell[2] for _, cell in self.lines), max(cell[3] for _, cell in self.lines)


def _form(name: str) -> Form:
    rows = [
        (what, key, [*map(float, cell.split())]) for form, what, key, cell in rows_of(__file__, "forms") if form == name
    ]
    cells = ({key: cell for what, key, cell in rows if what == one} for one in ("word", "entry", "count"))
    return Form([(layer, ends) for what, layer, ends in rows if what == "line"], *cells)


# of a drawing, of the first sheet of a text, of its others
FORM_1, FORM_2, FORM_2A = map(_form, ("1", "2", "2a"))
TITLE_BLOCK = FORM_1.size
LABELS = sentences_of(__file__, "labels")
# columns on the left of the frame: width of the names and of all; from below, and from the top: name, height; mm
_NAME, _COLUMNS = 5.0, 12.0
_FROM_BELOW = (("original", 25), ("signed", 35), ("replaces", 25), ("duplicate", 25), ("signed", 35))
# graph 26: long and short side, mm
_TURNED = (70.0, 14.0)
# from the left side of a form to graph 31, mm
_COPIED = 70.0
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
    people = tuple((role, getattr(table, role)) for role in _ROLES)
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
        (key, getattr(block, key), partial(fits_cell, cell=_at(0j, cell))) for key, (*cell, _) in form.entries.items()
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
    for layer, (left, low, right, high) in form.lines:
        canvas.line(layer, corner + complex(left, low), corner + complex(right, high))
    for key, cell in form.words.items():
        told = words(language).say(LABELS[key])
        write_cell(canvas, told, _at(corner, cell), SMALL_TEXT, middle=key not in _ROLES)
    for role, name in block.people:
        if name and role in form.words:
            _, low, _, high = form.words[role]
            write_cell(canvas, name, _at(corner, (17, low, 40, high)), SMALL_TEXT, middle=False)
            if block.date:
                write_cell(canvas, block.date, _at(corner, (55, low, 65, high)), SMALL_TEXT)
    for key, (*cell, size) in form.entries.items():
        write_lines(canvas, getattr(block, key), _at(corner, cell), size)
    _count(canvas, corner, block, form, language)
    _columns(canvas, language)
    _below(canvas, corner.real, language)
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


def _below(canvas: Canvas, left: float, language: str) -> None:
    """Who copied the sheet, left to a pen, and its format, below the frame (GOST 2.104, graphs 31 and 32)."""
    canvas.foot = canvas.margins[1]
    told, y = words(language), canvas.frame.low - canvas.foot + 1.2
    text = f"{told.say(LABELS['paper_format'])} {canvas.paper}"
    canvas.write(told.say(LABELS["copied"]), complex(left + _COPIED, y), SMALL_TEXT)
    canvas.write(text, complex(canvas.frame.right - text_width(text, SMALL_TEXT), y), SMALL_TEXT)


def _count(canvas: Canvas, corner: complex, block: TitleBlock, form: Form, language: str) -> None:
    """Number of the sheet, left out where there is one only (GOST 2.104), and how many there are."""
    for key, cell in form.counts.items():
        number = "" if key == "sheet" and block.sheets == 1 else str(getattr(block, key))
        named = key not in form.words
        text = f"{words(language).say(LABELS[key])} {number}".strip() if named else number
        write_cell(canvas, text, _at(corner, cell), SMALL_TEXT, middle=not named)


def _at(corner: complex, cell: _Cell) -> Box:
    """A cell of a form on paper."""
    left, low, right, high = cell
    return Box(corner.real + left, corner.imag + low, corner.real + right, corner.imag + high)
