"""Tables of the product's own data in files: a row a line, cells between ``|``; lines with ``#`` first are remarks."""

from __future__ import annotations

from pathlib import Path

from parts.base.texts import Text, counted, in_context


def rows_in(text: str) -> list[list[str]]:
    """The cells of each row of a text."""
    lines = text.strip().splitlines()
    return [[cell.strip() for cell in line.split("|")] for line in lines if line and not line.startswith("#")]


def rows_of(module: str, table: str) -> list[list[str]]:
    """Those of a table that lies beside a module, or on a way from there; ``module``: its ``__file__``."""
    return rows_in((Path(module).parent / f"{table}.psv").read_text("utf-8"))


def sentences_of(module: str, table: str) -> dict[str, Text]:
    """Sentences by code; beside one which of an English word's meanings it has, or its plural and what it counts."""
    return {code: _sentence(*cells) for code, *cells in rows_of(module, table)}


def _sentence(text: str, *more: str) -> Text:
    match more:
        case ():
            return text
        case (context,):
            return in_context(context, text)
        case (plural, number):
            return counted(text, plural, number)
    raise ValueError(f"too many cells: {text}")
