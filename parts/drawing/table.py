"""Tables on sheets: name, symbol, value."""

from __future__ import annotations

from geometry.base.record import Record
from parts.drawing.canvas import TEXT_HEIGHT, Box, Canvas

# columns and rows, mm
COLUMNS = (62.0, 16.0, 42.0)
ROW = 7.0
_INDENT = 1.5


class Row(Record):
    """A row; a heading has a name alone; ``sample`` is a layer whose line stands in place of a symbol."""

    name: str
    symbol: str = ""
    value: str = ""
    sample: str = ""


def table_size(rows: list[Row], columns: tuple[float, ...] = COLUMNS) -> tuple[float, float]:
    """Width and height, mm."""
    return sum(columns), ROW * len(rows)


def draw_table(
    canvas: Canvas,
    corner: complex,
    rows: list[Row],
    columns: tuple[float, ...] = COLUMNS,
    height_of_text: float = TEXT_HEIGHT,
) -> None:
    """A table with its lower left corner at ``corner``; words are squeezed into their cells."""
    width, height = table_size(rows, columns)
    canvas.box("TABLE", Box(corner.real, corner.imag, corner.real + width, corner.imag + height))
    for index, row in enumerate(rows):
        y = corner.imag + height - ROW * (index + 1)
        if index:
            canvas.line("TABLE", complex(corner.real, y + ROW), complex(corner.real + width, y + ROW))
        x = corner.real
        cells = (row.name, row.symbol, row.value)
        single = not row.symbol and not row.value and not row.sample
        for column, (text, wide) in enumerate(zip(cells, columns, strict=True)):
            if column and not single and not (row.sample and column == 2):
                canvas.line("TABLE", complex(x, y), complex(x, y + ROW))
            if text:
                most = (width if single else wide) - 2 * _INDENT
                canvas.write(text, complex(x + _INDENT, y + (ROW - height_of_text) / 2), height_of_text, most)
            x += wide
        if row.sample:
            middle = complex(corner.real + columns[0], y + ROW / 2)
            canvas.line(row.sample, middle + 1.5, middle + columns[1] + columns[2] - 1.5)
