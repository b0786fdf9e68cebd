"""Words in cells of tables and forms: in the middle or from the left, in as many lines as they need."""

from __future__ import annotations

import re
from collections.abc import Callable

from geometry.plane.letters import HELD
from parts.drawing.canvas import LEAST_TEXT, NARROWED, SMALL_TEXT, Box, Canvas, text_of, text_width

# free on both sides of a cell's words, mm
INDENT = 0.8
# where lines may end: a no-break space holds a number to its symbol
_SPACES = re.compile(r"[ \t\r\n]+")
# in place of a space at which no line ends
_JOINT = "\0"
# from line to line, heights of a capital
_STEP = 1.6


def write_cell(canvas: Canvas, text: str, cell: Box, size: float, *, middle: bool = True) -> None:
    """One line within a cell, in its middle or from its left."""
    room = cell.wide - 2 * INDENT
    long = text_of(text, 0j, size, room).box.right
    x = cell.middle.real - long / 2 if middle else cell.left + INDENT
    canvas.write(text, complex(x, cell.middle.imag - size / 2), size, room)


def write_lines(canvas: Canvas, text: str, cell: Box, size: float, *, middle: bool = True) -> None:
    """A text in its cell, in as many lines as it needs at most of what has room."""
    room = cell.wide - 2 * INDENT
    rows, most = wrapped(text, room, size), _most(cell, size)
    while len(rows) > most and size > SMALL_TEXT:
        size = max(SMALL_TEXT, size - 0.5)
        rows, most = wrapped(text, room, size), _most(cell, size)
    # what is longer still is squeezed into the last line
    rows = [*rows[: most - 1], " ".join(rows[most - 1 :])] if len(rows) > most else rows
    step = _STEP * size
    for index, row in enumerate(rows):
        centre = cell.middle.imag + step * ((len(rows) - 1) / 2 - index)
        write_cell(canvas, row, Box(cell.left, centre - step / 2, cell.right, centre + step / 2), size, middle=middle)


def _most(cell: Box, size: float) -> int:
    """How many lines have room in a cell."""
    return max(1, int((cell.tall - 1) / (_STEP * size)))


def wrapped(text: str, width: float, size: float) -> list[str]:
    """The text in lines no longer than a width, mm, at its spaces; a word that fits no line goes on in the next one.

    A number stays at its symbol where both fit a line.
    """
    rows: list[str] = []
    groups = (group.replace(_JOINT, " ") for group in _SPACES.split(HELD.sub(f"\\1{_JOINT}", text)) if group)
    for word in (w for group in groups for w in ([group] if text_width(group, size) <= width else group.split(" "))):
        rest = word
        while not fits_line(rest, width):
            count = max(1, sum(text_width(rest[:k], size) <= width for k in range(1, len(rest))))
            rows.append(rest[:count])
            rest = rest[count:]
        if rows and text_width(f"{rows[-1]} {rest}", size) <= width and rest == word:
            rows[-1] += f" {rest}"
        else:
            rows.append(rest)
    return rows


def fits_line(text: str, width: float, factor: float = NARROWED) -> bool:
    """Whether a line has room, mm, its smallest letters narrowed to a part of their width."""
    return factor * text_width(text, LEAST_TEXT) <= width


def fits_cell(text: str, cell: Box) -> bool:
    """Whether ``write_lines`` finds room for all of a text without narrowing it further."""
    room, most = cell.wide - 2 * INDENT, _most(cell, SMALL_TEXT)
    rows = wrapped(text, room, SMALL_TEXT)
    return fits_line(" ".join(rows[most - 1 :]), room)


def letters_held(text: str, fits: Callable[[str], bool]) -> int:
    """How many letters of a text fit, from its beginning."""
    return next(count for count in range(len(text), -1, -1) if fits(text[:count]))
