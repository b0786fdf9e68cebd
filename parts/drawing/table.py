"""Tables on sheets: name, symbol, value, each column as wide as its words."""

from __future__ import annotations

from geometry.base.record import Record
from parts.drawing.canvas import TEXT_HEIGHT, Box, Canvas, text_width

# height of a row, room beside words, least length of a line that a row shows; in heights of a capital
_ROW, _INDENT, _SAMPLE = 1.85, 0.45, 6.0


class Row(Record):
    """A row; a heading has a name alone; ``sample`` is a layer whose line stands in place of a symbol.

    ``answers``: how many cells, from the right, students find out themselves.
    """

    name: str
    symbol: str = ""
    value: str = ""
    sample: str = ""
    answers: int = 1

    @property
    def cells(self) -> tuple[str, str, str]:
        """From the left."""
        return self.name, self.symbol, self.value

    @property
    def is_heading(self) -> bool:
        """Whether its name takes the whole row."""
        return not (self.symbol or self.value or self.sample)


class Table(Record):
    """Rows in letters of a height, mm; words are squeezed where all columns would be wider than ``most`` mm."""

    rows: tuple[Row, ...]
    text: float = TEXT_HEIGHT
    most: float | None = None

    @property
    def columns(self) -> tuple[float, ...]:
        """Widths, mm."""
        room = 2 * _INDENT * self.text
        cells = [row.cells for row in self.rows if not row.is_heading]
        widths = [max((text_width(row[k], self.text) + room for row in cells if row[k]), default=0.0) for k in range(3)]
        headings = [text_width(row.name, self.text) + room for row in self.rows if row.is_heading]
        samples = [widths[0] + _SAMPLE * self.text for row in self.rows if row.sample]
        widths[2] += max([sum(widths), *headings, *samples]) - sum(widths)
        return tuple(min(width, self._widest(widths)) for width in widths)

    def _widest(self, widths: list[float]) -> float:
        """What a column may have so that all have room: narrow ones keep theirs."""
        left, rest = self.most or sum(widths), sorted(widths)
        for number, width in enumerate(rest):
            if width * (len(rest) - number) > left:
                return left / (len(rest) - number)
            left -= width
        return rest[-1]

    @property
    def size(self) -> tuple[float, float]:
        """Width and height, mm."""
        return sum(self.columns), _ROW * self.text * len(self.rows)

    def draw(self, canvas: Canvas, corner: complex) -> None:
        """The table with its lower left corner at ``corner``."""
        columns, (width, height), step = self.columns, self.size, _ROW * self.text
        indent, left, top = _INDENT * self.text, corner.real, corner.imag + height
        canvas.box("TABLE", Box(left, corner.imag, left + width, top))
        for index, row in enumerate(self.rows):
            y = top - step * (index + 1)
            if index:
                canvas.line("TABLE", complex(left, y + step), complex(left + width, y + step))
            x = left
            for column, (text, wide) in enumerate(zip(row.cells, columns, strict=True)):
                if column and wide and not row.is_heading and not (row.sample and column == 2):
                    canvas.line("TABLE", complex(x, y), complex(x, y + step))
                if text:
                    most = (width if row.is_heading else wide) - 2 * indent
                    at, answer = complex(x + indent, y + (step - self.text) / 2), column >= 3 - row.answers
                    canvas.write(text, at, self.text, most, answer=answer and not row.is_heading)
                x += wide
            if row.sample:
                middle = complex(left + columns[0], y + step / 2)
                canvas.line(row.sample, middle + indent, middle + columns[1] + columns[2] - indent)
