"""The table of a working drawing: what makes the teeth or the cam, what is measured, what is told beside (GOST 2.403).

The values are the steps of the calculation of the same part. Sizes of the form are those of GOST 2.403 as drawing
programs have them; cams, for which no standard has a table, are laid out alike, with their positions below.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from itertools import accumulate, chain, pairwise

from geometry.base.record import Record, replace
from parts.base.part import Part
from parts.base.texts import N_, Text, Words, in_context, message, standard_told, words
from parts.drawing.canvas import SMALL_TEXT, TEXT_HEIGHT, Box, Canvas, plain_width, text_width
from parts.drawing.cells import INDENT, wrapped, write_cell, write_lines
from parts.keys.accuracy import AccuracyTable
from parts.pages.page import Sheet, Step, Table, shortest, unit_text
from parts.pages.symbols import head_text, lowered, symbol_text
from parts.pages.terms import TERMS

# name, symbol, value; a row, and one of two lines, mm
COLUMNS = (65.0, 10.0, 35.0)
WIDTH = sum(COLUMNS)
_ROW, _TWO_LINES = 8.0, 13.0
# a row of positions and its first column, mm, and how many columns have room, in tables side by side
_POSITION, _MOST_COLUMNS = 5.0, 8
# how many times as wide as the rows a table of positions is beside them at most
_WIDEST = 4
# decimals to which equal rows are the same
_SAME = 9
# decimals of a size and of a number without unit
_DECIMALS = {"mm": 3, "": 4}
# how drawings name what calculations name by their sources
_NAMES: Mapping[str, Text] = {
    "profile_shift_coefficient": in_context("data table", "profile shift coefficient"),
    "pressure_angle_deg": in_context("data table", "pressure angle of the basic rack"),
    "tip_radius_coefficient": in_context("data table", "fillet radius of the basic rack, in modules"),
    "rack_pitch": in_context("data table", "pitch"),
}
# the same of symbols, where drawings have no others that are like them
_SYMBOLS = {"thread_chord": "s_a1", "thread_chord_height": "h_a1", "constant_chord": "s_c"}
Value = float | int | Text


class DataRow(Record):
    """A row: a quantity with its unit, or words; ``deviations``: the upper and the lower one, mm."""

    name: Text
    symbol: str
    value: Value
    unit: str = ""
    deviations: tuple[float, float] | None = None


class Mated(Record):
    """A part that meshes with the one that is drawn, and the distance of their axes, mm; None: they have none."""

    part: Part
    distance: float | None


class DataTable(Record):
    """Rows for the maker, for who measures, for who asks; the parts are divided by thick lines.

    ``positions``: a table of numbers below, by its columns.
    """

    parts: tuple[tuple[DataRow, ...], ...]
    positions: Table | None = None


def row_of(step: Step) -> DataRow:
    """A step of a calculation as a row."""
    row = term_row(step.name, step.value)
    symbol = _SYMBOLS.get(step.name, step.symbol)
    return replace(row, name=step.called or row.name, symbol=symbol, unit=step.unit)


def term_row(name: str, value: Value) -> DataRow:
    """A value under the name, the symbol and the unit that calculations have for it."""
    term = TERMS[name]
    return DataRow(_NAMES.get(name, term.name), term.symbol, value, term.unit)


def rows_of(page: Sheet, names: Iterable[str]) -> tuple[DataRow, ...]:
    """The steps of these names that the calculation has, in the order of the names."""
    steps = page.steps()
    return tuple(row_of(step) for name in names for step in steps if step.name == name)


def distance_rows(mates: Iterable[Mated], symbol: str) -> list[DataRow]:
    """How far the axes of mates are, each distance once."""
    distances = {round(mate.distance, 9): mate.distance for mate in mates if mate.distance is not None}
    return [DataRow(N_("centre distance"), symbol, distance, "mm") for distance in distances.values()]


def grade_rows(accuracy: AccuracyTable | None) -> tuple[DataRow, ...]:
    """The accuracy grade, where one is given."""
    if accuracy is None:
        return ()
    told = message("{grade} {standard}", grade=accuracy.grade, standard=standard_told(accuracy.source))
    return (DataRow(N_("accuracy grade"), "", told),)


def with_limits(rows: Sequence[DataRow], accuracy: AccuracyTable | None) -> tuple[DataRow, ...]:
    """What is measured, the last of it with its deviations where they are given."""
    limits = None if accuracy is None else accuracy.deviations
    return (*rows[:-1], replace(rows[-1], deviations=limits and (max(limits), min(limits))))


def own_rows(page: Sheet, names: Iterable[str]) -> tuple[DataRow, ...]:
    """The same of a calculation of two gears: those of the first and of both, without the number in their symbols."""
    rows = ((step, row_of(step)) for name in names for step in page.steps() if step.name == name and step.gear < 2)
    return tuple(replace(row, symbol=TERMS[step.name].symbol) if step.gear else row for step, row in rows)


def chosen_columns(table: Table, names: Sequence[str]) -> Table:
    """Some of a table's columns, by their symbols."""
    kept = [k for name in names for k, (symbol, _) in enumerate(table.heads) if symbol == name]
    # two that differ in what is left out, a leap of the acceleration, are one
    rows = tuple(
        {tuple(round(row[k], _SAME) for k in kept): tuple(row[k] for k in kept) for row in table.rows}.values()
    )
    return replace(table, heads=tuple(table.heads[k] for k in kept), rows=rows)


def value_text(row: DataRow, told: Words) -> str:
    """What stands in the last column."""
    if isinstance(row.value, float):
        return told.decimal(sexagesimal(row.value) if row.unit == "deg" else rounded(row.value, row.unit))
    return told.decimal(str(row.value)) if isinstance(row.value, int) else told.say(row.value)


def rounded(value: float, unit: str) -> str:
    """A number to as many decimals as drawings have."""
    return shortest(value, _DECIMALS[unit])


def sexagesimal(degrees: float) -> str:
    """Degrees, minutes and seconds; what is nothing at the end is left out."""
    seconds = round(abs(degrees) * 3600)
    parts = [f"{seconds // 3600}°", f"{seconds // 60 % 60:02d}′", f"{seconds % 60:02d}″"]
    while len(parts) > 1 and parts[-1].startswith("00"):
        parts.pop()
    return "-" * (degrees < 0 and seconds > 0) + "".join(parts)


def _name(row: DataRow, told: Words) -> str:
    name = told.say(row.name)
    return name[:1].upper() + name[1:]


def _height(row: DataRow, told: Words) -> float:
    """Of a row, mm: two lines where its name or its words need them."""
    cells = (_name(row, told), COLUMNS[0]), (value_text(row, told), COLUMNS[2])
    long = any(len(wrapped(text, wide - 2 * INDENT, TEXT_HEIGHT)) > 1 for text, wide in cells)
    return _TWO_LINES if long else _ROW


def _sides(table: Table) -> int:
    """How many tables of positions are as wide as the rows."""
    return _MOST_COLUMNS // len(table.heads)


def _blocks(table: Table, wide: int) -> list[Sequence[tuple[float, ...]]]:
    """The rows of positions that stand side by side, in a table so many times as wide as the rows."""
    sides = _sides(table) * wide
    each = math.ceil(len(table.rows) / sides)
    return [table.rows[k * each : (k + 1) * each] for k in range(sides)]


def table_sizes(table: DataTable, language: str) -> tuple[tuple[int, float, float], ...]:
    """How a table may stand: with positions below (0), or so many times as wide beside it; its width and height, mm."""
    told = words(language)
    rows = sum(_height(row, told) for part in table.parts for row in part)
    if table.positions is None:
        return ((0, WIDTH, rows),)

    def positions(wide: int) -> float:
        assert table.positions is not None
        return _POSITION * (1 + len(_blocks(table.positions, wide)[0]))

    beside = ((wide, WIDTH * (1 + wide), max(rows, positions(wide))) for wide in range(1, _WIDEST + 1))
    return ((0, WIDTH, rows + positions(1)), *beside)


def draw_data_table(canvas: Canvas, corner: complex, table: DataTable, language: str, beside: int = 0) -> Box:
    """Draw a table with its upper right corner at ``corner``, as ``table_sizes`` has it; the room that it takes, mm."""
    told = words(language)
    left, right, y = corner.real - WIDTH, corner.real, corner.imag
    edges = [left + sum(COLUMNS[:k]) for k in range(len(COLUMNS) + 1)]
    for part in filter(None, table.parts):
        canvas.line("FRAME", complex(left, y), complex(right, y))
        for number, row in enumerate(part):
            if number:
                canvas.line("TABLE", complex(left, y), complex(right, y))
            low = y - _height(row, told)
            name, symbol, value = (Box(a, low, b, y) for a, b in pairwise(edges))
            write_lines(canvas, _name(row, told), name, TEXT_HEIGHT, middle=False)
            # symbols with long indices have more of their narrow column
            symbol = replace(symbol, left=symbol.left - INDENT / 2, right=symbol.right + INDENT / 2)
            write_cell(canvas, lowered(symbol_text(row.symbol, told)) or "—", symbol, TEXT_HEIGHT)
            _write_value(canvas, row, value, told)
            y = low
    for x in edges[1:-1]:
        canvas.line("FRAME", complex(x, corner.imag), complex(x, y))
    box = Box(left, y, right, corner.imag)
    if table.positions is None:
        canvas.box("FRAME", box)
        return box
    if not beside:
        box = replace(box, low=_draw_positions(canvas, complex(left, y), table.positions, told))
        canvas.box("FRAME", box)
        return box
    start = complex(left - WIDTH * beside, corner.imag)
    low = _draw_positions(canvas, start, table.positions, told, beside)
    for one in (box, Box(start.real, low, left, corner.imag)):
        canvas.box("FRAME", one)
    return Box(start.real, min(low, y), right, corner.imag)


def _write_value(canvas: Canvas, row: DataRow, cell: Box, told: Words) -> None:
    """The value, its deviations one above the other behind it, as GOST 2.307 has them."""
    text = value_text(row, told)
    if row.deviations is None:
        write_lines(canvas, text, cell, TEXT_HEIGHT)
        return
    limits = [told.decimal(f"{value:+.3f}" if value else "0") for value in row.deviations]
    wide = max(plain_width(limit, SMALL_TEXT) for limit in limits)
    middle = cell.right - INDENT - wide
    write_cell(canvas, text, Box(cell.left, cell.low, middle, cell.high), TEXT_HEIGHT)
    step = (cell.high - cell.low) / 2
    for limit, low in zip(limits, (cell.low + step, cell.low), strict=True):
        canvas.write(limit, complex(middle, low + (step - SMALL_TEXT) / 2), SMALL_TEXT, wide)


def _draw_positions(canvas: Canvas, corner: complex, table: Table, told: Words, wide: int = 1) -> float:
    """Numbers in columns under their heads, in tables side by side; where they end, mm."""
    blocks = _blocks(table, wide)
    side, height = WIDTH / _sides(table), _POSITION * (1 + len(blocks[0]))
    heads = [", ".join(filter(None, (_head(name, told), unit_text(unit, told)))) for name, unit in table.heads]
    written = [[[told.decimal(text) for text in position_texts(row)] for row in rows] for rows in blocks]
    # what is left of the width all columns share
    needed = [
        max(text_width(text, SMALL_TEXT) for text in column) for column in zip(heads, *chain(*written), strict=True)
    ]
    more = (side - sum(needed)) / len(needed)
    edges = [0.0, *accumulate(wide + more for wide in needed)]
    for number, rows in enumerate(written):
        left = corner.real + number * side
        for line, row in enumerate([heads, *rows]):
            y = corner.imag - _POSITION * line
            canvas.line("TABLE" if line else "FRAME", complex(left, y), complex(left + side, y))
            for text, a, b in zip(row, edges, edges[1:], strict=False):
                write_cell(canvas, text, Box(left + a, y - _POSITION, left + b, y), SMALL_TEXT)
        for k, x in enumerate(edges[:-1]):
            canvas.line(
                "TABLE" if k else "FRAME", left + complex(x, corner.imag), left + complex(x, corner.imag - height)
            )
    return corner.imag - height


def _head(name: str, told: Words) -> str:
    # drawings have R for a radius
    name = name.replace("r", "R", 1) if name.partition("_")[0] == "r" else name
    return lowered(symbol_text(head_text(name), told))


def position_texts(row: Sequence[float]) -> list[str]:
    """A row of positions: the argument with the decimals that it has, the rest with as many as drawings have."""
    # z: what rounds to nothing has no sign
    return [rounded(row[0], "mm"), *(f"{value:z.{_DECIMALS['mm']}f}" for value in row[1:])]
