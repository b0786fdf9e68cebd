"""Tables of the product's own data in files: a row a line, cells between ``|``; lines with ``#`` first are remarks."""

from __future__ import annotations

from pathlib import Path

from parts.base.texts import Text, counted


def rows_in(text: str) -> list[list[str]]:
    """The cells of each row of a text."""
    lines = text.strip().splitlines()
    return [[cell.strip() for cell in line.split("|")] for line in lines if line and not line.startswith("#")]


def rows_of(module: str, table: str) -> list[list[str]]:
    """Those of a table that lies beside a module, or on a way from there; ``module``: its ``__file__``."""
    return rows_in((Path(module).parent / f"{table}.psv").read_text("utf-8"))


def sentences_of(module: str, table: str) -> dict[str, Text]:
    """Sentences by code; what is counted has its plural and the number that it follows beside it."""
    return {code: counted(one, *plural) if plural else one for code, one, *plural in rows_of(module, table)}
