"""The terms of the calculations: ISO 1122-1 and the practicum's own words.

A term is known by its DESIGN name; ``key`` stands for it in formulas, with 1 or 2 behind it where it belongs to a gear.
The table of them all is ``terms.psv``.
"""

from __future__ import annotations

from collections.abc import Sequence

from geometry.base.record import Record
from parts.base.psv import rows_in, rows_of


class Term(Record):
    """A quantity: its key in formulas, its printed symbol, its unit, its name; ``side``: of a limit that may be typed,
    to which its last digit is rounded, up or down.
    """

    key: str
    symbol: str
    unit: str
    name: str
    side: str = ""


TERMS: dict[str, Term] = {}


def add_terms(text: str) -> None:
    """One term a line: DESIGN name | key | symbol | unit | name, of a limit | up or down too; ``#`` begins a remark.

    Raises
    ------
    ValueError
        A name that is taken.
    """
    _add(rows_in(text))


def _add(rows: Sequence[Sequence[str]]) -> None:
    if taken := {name for name, *_ in rows} & TERMS.keys():
        raise ValueError(f"terms that are there already: {taken}")
    TERMS.update({name: Term(*cells) for name, *cells in rows})


_add(rows_of(__file__, "terms"))
