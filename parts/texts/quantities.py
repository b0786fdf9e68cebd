"""What the named numbers of a part are called, with their units."""

from __future__ import annotations

from collections.abc import Mapping

from parts.base.psv import rows_of
from parts.base.texts import Words

QUANTITIES: dict[str, str] = dict(rows_of(__file__, "quantities"))


def add_quantities(table: Mapping[str, str]) -> None:
    """The names of a kind that is registered from outside, with their units."""
    QUANTITIES.update(table)


def quantity_name(words: Words, name: str) -> str:
    """A circle or quantity of a part in words; one that nobody named by its key."""
    return words.text(QUANTITIES.get(name, name))
