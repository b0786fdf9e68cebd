"""What a step of a calculation says, piece by piece, in a language."""

from __future__ import annotations

import re
from functools import lru_cache

from parts.base.psv import rows_of
from parts.base.texts import Told, Words
from parts.pages.page import Step, number, unit_text
from parts.pages.terms import TERMS

SOURCES = [word for (word,) in rows_of(__file__, "sources")]


@lru_cache(maxsize=4096)
def source_text(source: str, words: Words) -> str:
    """A source as printed."""
    for word in SOURCES:
        source = re.sub(rf"\b{word}\b", words.term("source", word), source)
    return source


def step_name(step: Step, words: Words) -> str:
    """The quantity in words, with the gear it belongs to."""
    name = words.say(step.called) if step.called else words.text(TERMS[step.name].name)
    more = words.text("gear {number}", number=step.gear) if step.gear else words.say(step.of)
    return f"{name}, {more}" if more else name


def result_text(step: Step, words: Words) -> str:
    """Value and unit."""
    unit, side = unit_text(step.unit, words), TERMS[step.name].side
    gap = "" if unit in ("°", "") else " "
    value = Told(step.value, up=side == "up") if side and type(step.value) is float else step.value
    return f"{number(value, step.unit)}{gap}{unit}"


def printed_text(step: Step, words: Words) -> str:
    """What a wrong source prints, and why it is wrong; empty where it is right."""
    if step.printed is None:
        return ""
    why = words.say(step.printed.why)
    return words.text("printed in the source: {text} ({why})", text=step.printed.text, why=why)
