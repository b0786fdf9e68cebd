"""The terms of the calculations: ISO 1122-1 and the practicum's own words.

A term is known by its DESIGN name; ``key`` stands for it in formulas, with 1 or 2 behind it where it belongs to a gear.
The table of them all is ``terms.psv``.
"""

from __future__ import annotations

from pathlib import Path

from geometry.base.record import Record


class Term(Record):
    """A quantity: its key in formulas, its printed symbol, its unit, its name."""

    key: str
    symbol: str
    unit: str
    name: str


TERMS: dict[str, Term] = {}


def add_terms(text: str) -> None:
    """One term a line: DESIGN name | key | symbol | unit | name; lines that begin with ``#`` are remarks.

    Raises
    ------
    ValueError
        A name that is taken.
    """
    lines = [line for line in text.strip().splitlines() if not line.startswith("#")]
    rows = [[cell.strip() for cell in line.split("|")] for line in lines]
    if taken := {name for name, *_ in rows} & TERMS.keys():
        raise ValueError(f"terms that are there already: {taken}")
    TERMS.update({name: Term(*cells) for name, *cells in rows})


add_terms((Path(__file__).parent / "terms.psv").read_text("utf-8"))
