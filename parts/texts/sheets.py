"""The words on sheets, in their sources' own terms."""

from __future__ import annotations

from parts.base.psv import sentences_of
from parts.base.texts import N_, counted, filled, words

SHEETS = sentences_of(__file__, "sheets") | {
    # with spaces at their ends, which no cell has
    "holes_of": counted("{count} hole ", "{count} holes ", by="count"),
    "chamfers_of": counted("{count} chamfer ", "{count} chamfers ", by="count"),
    "places_of": counted(" ({count} place)", " ({count} places)", by="count"),
    "step_of": N_(" (step {step})"),
    "pins_of": counted("{count} pin ", "{count} pins ", by="count"),
    "seats_of": counted("{count} seat ", "{count} seats ", by="count"),
}


def sheet_words(language: str, key: str, **numbers: object) -> str:
    """A term of a sheet in a language."""
    return words(language).say(filled(SHEETS[key], **numbers))


def counted_words(language: str, key: str, count: int) -> str:
    """How many there are; no word of one alone."""
    return sheet_words(language, key, count=count) if count > 1 else ""


def view_letter(language: str, number: int = 0) -> str:
    """The name of a view or section, 0 the first; after the last letter they begin again with a number."""
    letters = sheet_words(language, "view_letters")
    rounds, place = divmod(number, len(letters))
    return f"{letters[place]}{rounds or ''}"
