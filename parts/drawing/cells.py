"""Words in cells of tables and forms: in the middle or from the left, in as many lines as they need."""

from __future__ import annotations

from parts.drawing.canvas import SMALL_TEXT, Box, Canvas, text_of, text_width

# free on both sides of a cell's words, mm
INDENT = 0.8
# from line to line, heights of a capital
_STEP = 1.6


def write_cell(canvas: Canvas, text: str, cell: Box, size: float, *, middle: bool = True) -> None:
    """One line within a cell, in its middle or from its left."""
    room = cell.right - cell.left - 2 * INDENT
    long = text_of(text, 0j, size, room).box.right
    x = (cell.left + cell.right - long) / 2 if middle else cell.left + INDENT
    canvas.write(text, complex(x, (cell.low + cell.high - size) / 2), size, room)


def write_lines(canvas: Canvas, text: str, cell: Box, size: float, *, middle: bool = True) -> None:
    """A text in its cell, in as many lines as it needs at most of what has room."""
    room = cell.right - cell.left - 2 * INDENT
    rows, most = wrapped(text, room, size), _most(cell, size)
    while len(rows) > most and size > SMALL_TEXT:
        size = max(SMALL_TEXT, size - 0.5)
        rows, most = wrapped(text, room, size), _most(cell, size)
    # what is longer still is squeezed into the last line
    rows = [*rows[: most - 1], " ".join(rows[most - 1 :])] if len(rows) > most else rows
    step = _STEP * size
    for index, row in enumerate(rows):
        centre = (cell.low + cell.high) / 2 + step * ((len(rows) - 1) / 2 - index)
        write_cell(canvas, row, Box(cell.left, centre - step / 2, cell.right, centre + step / 2), size, middle=middle)


def _most(cell: Box, size: float) -> int:
    """How many lines have room in a cell."""
    return max(1, int((cell.high - cell.low - 1) / (_STEP * size)))


def wrapped(text: str, width: float, size: float) -> list[str]:
    """The text in lines no longer than a width, mm, at its spaces."""
    rows: list[str] = []
    for word in text.split():
        if rows and text_width(f"{rows[-1]} {word}", size) <= width:
            rows[-1] += f" {word}"
        else:
            rows.append(word)
    return rows
