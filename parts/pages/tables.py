"""Tables of numbers within a calculation, in every format of a sheet."""

from __future__ import annotations

import html
import math
from typing import Any

from parts.base.texts import Words
from parts.pages.page import Table, not_finite, shortest, unit_text
from parts.pages.symbols import head_text, subscripts

# decimals of a column, and of one whose numbers are small
_DIGITS, _MOST = 4, 8


def _heads(table: Table, words: Words) -> list[str]:
    shown = table.heads[: table.shown]
    return [", ".join(filter(None, (words.text(head_text(symbol)), unit_text(unit, words)))) for symbol, unit in shown]


def _rows(table: Table, words: Words) -> list[list[str]]:
    decimals = [_decimals(column) for column in zip(*table.rows, strict=True)]
    return [
        [words.decimal(cell) for cell in (*map(words.text, labels), *map(_cell, row, decimals))][: table.shown]
        for labels, row in zip(_labels(table), table.rows, strict=True)
    ]


def _decimals(column: tuple[float, ...]) -> int:
    """As many as a column of small numbers needs for four digits of its greatest."""
    most = max((abs(value) for value in column if math.isfinite(value)), default=0.0)
    return min(max(_DIGITS, 3 - math.floor(math.log10(most))), _MOST) if most else _DIGITS


def _labels(table: Table) -> tuple[tuple[str, ...], ...]:
    return table.labels or ((),) * len(table.rows)


def _cell(value: float, decimals: int) -> str:
    return shortest(value, decimals) if math.isfinite(value) else not_finite(value)


def plain_table(table: Table, words: Words) -> list[str]:
    """Lines of a table for a terminal, columns flush right."""
    rows = [_heads(table, words), *_rows(table, words)]
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    lines = ["  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True)) for row in rows]
    title = words.phrase(words.say(table.title))
    return [title, "-" * len(title), *lines]


def markdown_table(table: Table, words: Words) -> list[str]:
    """Lines of a table in Markdown."""
    heads = [head.replace("_", r"\_") for head in _heads(table, words)]
    rows = [heads, ["---:"] * len(heads), *_rows(table, words)]
    return [f"## {words.phrase(words.say(table.title))}", "", *(f"| {' | '.join(row)} |" for row in rows)]


def html_table(table: Table, words: Words) -> str:
    """A table of a page."""
    head = "".join(f"<th>{subscripts(h)}</th>" for h in _heads(table, words))
    rows = ["".join(f"<td>{subscripts(cell)}</td>" for cell in row) for row in _rows(table, words)]
    body = "\n".join(f"<tr>{row}</tr>" for row in (head, *rows))
    return f"<h2>{html.escape(words.phrase(words.say(table.title)))}</h2>\n<table>\n{body}\n</table>"


def table_data(table: Table) -> list[dict[str, Any]]:
    """All digits: one object for each row; infinity is null."""
    names = [symbol for symbol, _ in table.heads]
    numbers = ([value if math.isfinite(value) else None for value in row] for row in table.rows)
    return [dict(zip(names, [*labels, *row], strict=True)) for labels, row in zip(_labels(table), numbers, strict=True)]


def csv_table(table: Table) -> str:
    """All columns and digits as lines of CSV: heads "symbol (unit)", decimal points, infinity as inf."""
    heads = [f"{symbol} ({unit})" if unit else symbol for symbol, unit in table.heads]
    # an added zero takes the sign off a zero
    rows = zip(_labels(table), table.rows, strict=True)
    lines = [heads, *([*labels, *(repr(value + 0.0) for value in row)] for labels, row in rows)]
    return "".join(f"{','.join(line)}\n" for line in lines)
