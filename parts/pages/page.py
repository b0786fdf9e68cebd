"""A calculation as data: ordered steps, each with formula, numbers put in, value, unit and source.

A formula is written once, as an expression over ``{key}`` placeholders: shown with symbols it is the formula, with
values the numbers put in, and the tests evaluate it. ``#`` in a placeholder is the gear's number, ``~`` its mate's.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol, SupportsFloat

from geometry.base.record import Draft, Record, field, replace
from parts.base.psv import rows_of
from parts.base.texts import NC_, Text, Words, filled
from parts.pages.symbols import symbol_text
from parts.pages.terms import TERMS

if TYPE_CHECKING:
    from parts.drawing.expected import Expected

Value = float | int | str
_SUPERSCRIPTS = {"2": "²", "3": "³", "4": "⁴"}


class Picture(Protocol):
    """What a page draws."""

    def svg(self, words: Words) -> str:
        """The picture in a language."""


class Printed(Record):
    """What the source prints where it is wrong, a number or formula, and why it is wrong."""

    text: str
    why: Text


# by a step's name and gear, or by its symbol
Misprints = dict[tuple[str, int] | str, Printed]


class Known(Record):
    """What a placeholder stands for."""

    symbol: str
    value: Value
    unit: str


class Step(Record):
    """One line of a calculation; ``gear`` is 0 (neither) or its number; ``inputs`` are what its formula stood for.

    ``of``: which of several steps of the same name it is; ``called``: what it is here, where the term's name says too
    much or too little; ``given``: no result of the calculation.
    """

    name: str
    gear: int
    symbol: str
    value: Value
    unit: str
    formula: str = ""
    source: str = ""
    printed: Printed | None = None
    inputs: Mapping[str, Known] = field(default_factory=dict)
    of: Text = ""
    called: Text = ""
    given: bool = False


class Section(Draft):
    """Steps under a heading."""

    title: Text
    steps: list[Step] = field(default_factory=list)


class Table(Record):
    """Rows of numbers under heads (symbol, unit), by ``name`` in json; pages print the first ``shown`` columns.

    ``labels``: what stands before the numbers of each row, in the first columns.
    """

    name: str
    title: Text
    heads: tuple[tuple[str, str], ...]
    rows: tuple[tuple[float, ...], ...]
    shown: int | None = None
    labels: tuple[tuple[str, ...], ...] = ()


Head = tuple[str, str]
# numpy's numbers are no floats to a checker
Cell = str | SupportsFloat


def table_of(name: str, title: Text, heads: Iterable[Head], rows: Iterable[Sequence[Cell]]) -> Table:
    """Rows under heads (symbol, unit), words first, then numbers, as a table."""
    labels, numbers = list[tuple[str, ...]](), list[tuple[float, ...]]()
    for row in rows:
        labels.append(tuple(cell for cell in row if isinstance(cell, str)))
        numbers.append(tuple(x if isinstance(x, int) else float(x) for x in row if not isinstance(x, str)))
    return Table(name, title, tuple(heads), tuple(numbers), labels=tuple(labels))


class Sheet(Draft):
    """A calculation that grows step by step; ``notes`` are remarks, ``signed`` is the last line of a form."""

    topic: str
    title: Text
    sections: list[Section] = field(default_factory=list)
    known: dict[str, Known] = field(default_factory=dict)
    by_symbol: dict[str, Known] = field(default_factory=dict)
    notes: list[Text] = field(default_factory=list)
    signed: Text | None = None
    # what is drawn, the same in letters, and what only json carries
    picture: Picture | None = None
    plain_picture: Callable[[Words], str] | None = None
    tables: list[Table] = field(default_factory=list)
    picture_file: str | None = None
    # sheets on paper, made in a language, and the file that is asked for
    paper: Callable[[str], Sequence[Expected]] | None = None
    paper_file: str | None = None
    data: dict[str, Any] = field(default_factory=dict)
    # each is told once, at the first such step
    printed: Misprints = field(default_factory=dict)

    def section(self, title: Text, /, **numbers: object) -> None:
        """A new heading, with what its placeholders stand for."""
        self.sections.append(Section(filled(title, **numbers) if numbers else title))

    def note(self, text: Text, /, **numbers: object) -> None:
        """A remark, with what its placeholders stand for."""
        self.notes.append(filled(text, **numbers) if numbers else text)

    def add(
        self,
        name: str,
        value: Value,
        formula: str = "",
        source: str = "",
        gear: int = 0,
        *,
        symbol: str = "",
        key: str = "",
        of: Text = "",
        called: Text = "",
        given: bool = False,
    ) -> None:
        """A step; later formulas know its value by the term's key, or by the symbol.

        ``symbol``, ``key`` and ``called`` stand in for the term's symbol, key and name.
        """
        term = TERMS[name]
        index = str(gear) if gear else ""
        shown = _numbered(symbol or term.symbol, index)
        formula = formula.replace("#", index).replace("~", {"1": "2", "2": "1"}.get(index, ""))
        inputs = {placeholder: self.value_of(placeholder) for placeholder in KEYS.findall(formula)}
        printed = self.printed.pop((name, gear), None) or self.printed.pop(shown, None)
        step = Step(name, gear, shown, value, term.unit, formula, source, printed, inputs, of, called, given)
        self.sections[-1].steps.append(step)
        self.known[(key or term.key) + index] = self.by_symbol[shown] = Known(shown, value, term.unit)

    def value_of(self, placeholder: str) -> Known:
        """What a formula puts in for a key, or for a symbol that is no key.

        Raises
        ------
        KeyError
            Nothing is known by that yet.
        """
        found = self.known.get(placeholder) or self.by_symbol.get(placeholder)
        if found is None:
            raise KeyError(f"{placeholder} is not known yet")
        return found

    def table(self, name: str, title: Text, heads: Iterable[Head], rows: Iterable[Sequence[Cell]]) -> None:
        """A table of rows under heads (symbol, unit): words first, then numbers."""
        self.tables.append(table_of(name, title, heads, rows))

    def name(self, key: str, known: str, gear: int = 0) -> None:
        """A second key for a value that is known, for formulas that are the same of other parts."""
        index = str(gear) if gear else ""
        self.known[key + index] = self.value_of(known + index)

    def both(
        self,
        name: str,
        values: Sequence[Value],
        formula: str = "",
        sources: str | tuple[str, str] = "",
        symbol: str = "",
    ) -> None:
        """A step for each gear, two or one; ``symbol``: one of its own, by which formulas call it too."""
        for gear, value in enumerate(values, 1):
            source = sources if isinstance(sources, str) else sources[gear - 1]
            self.add(name, value, formula, source, gear, symbol=symbol, key=symbol)

    def told(self, **values: Value | None) -> None:
        """Steps of what no formula gives, by the names of their terms; None: there is no such step."""
        for name, value in values.items():
            if value is not None:
                self.add(name, value)

    def given(self, **values: Value | None) -> None:
        """The same of what is given."""
        for name, value in values.items():
            if value is not None:
                self.add(name, value, given=True)

    def mark_misprint(self, printed: Printed) -> None:
        """The last step as one that its source misprints."""
        steps = self.sections[-1].steps
        steps[-1] = replace(steps[-1], printed=printed)

    def steps(self) -> list[Step]:
        """All steps in order."""
        return [step for section in self.sections for step in section.steps]


# what formulas put in: a key or a symbol
KEYS = re.compile(r"\{([^{}]+)\}")


def _numbered(symbol: str, index: str) -> str:
    """A symbol of one gear: S_a1, ab stays ab."""
    return f"{symbol[:-1]}{index}*" if index and symbol.endswith("*") else symbol + index


def shortest(value: float, decimals: int) -> str:
    """A number without zeros at its end, and with no more digits than it has."""
    if abs(value) >= 10.0 ** (15 - decimals):
        return f"{value:.15g}"
    text = f"{value:.{decimals}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def not_finite(value: float) -> str:
    """Infinity, or that there is no such value."""
    return "–" if math.isnan(value) else "∞" if value > 0 else "-∞"


def number(value: Value, unit: str, *, enclosed: bool = False) -> str:
    """A value as a reader wants it; ``enclosed`` puts negative numbers in brackets."""
    if isinstance(value, str):
        return value
    if isinstance(value, int):
        text = str(value)
    elif not math.isfinite(value):
        text = not_finite(value)
    else:
        _, decimals = UNITS[unit]
        text = shortest(value, decimals)
        # a small number keeps its leading digits: involutes, clearances
        if 1e-12 < abs(value) < (0.1 if not unit else 10.0 ** (2 - decimals)):
            text = f"{value:.6g}" if not unit else f"{value:.3g}"
    if unit == "deg" and enclosed:
        text += "°"
    return f"({text})" if enclosed and text.startswith("-") else text


def formula_text(step: Step, words: Words) -> str:
    """The right side of a step's formula with symbols."""
    return symbol_text(pretty(KEYS.sub(lambda m: step.inputs[m[1]].symbol, step.formula), words), words)


def numbers_text(step: Step, words: Words) -> str:
    """The right side of a step's formula with the numbers put in."""

    def put_in(match: re.Match[str]) -> str:
        known = step.inputs[match[1]]
        return number(known.value, known.unit, enclosed=True)

    return pretty(KEYS.sub(put_in, step.formula), words)


def pretty(text: str, words: Words) -> str:
    """An expression as printed: products as dots, powers raised, functions as the language writes them."""
    text = text.replace(" ** ", "**").replace(" * ", "·").replace(" / ", "/")
    text = text.replace("sqrt(", "√(").replace("cbrt(", "∛(")
    # one argument needs no brackets: cos α; the power of a function stands behind its name: cos² α
    simple = r"([^()\s/·]+|\([^()\s/·]+\))"
    text = re.sub(rf"\b(cos|sin|tan|inv)\({simple}\)\*\*([23])", lambda m: f"{m[1]}{_SUPERSCRIPTS[m[3]]} {m[2]}", text)
    text = re.sub(rf"\b(cos|sin|tan|inv)\({simple}\)", r"\1 \2", text)
    text = re.sub(r"\*\*([234])", lambda m: _SUPERSCRIPTS[m[1]], text)
    text = re.sub(r"\bpi\b", "π", text).replace("**(", "^(")
    while found := re.search(r"\b(abs|ceil|floor)\(", text):
        end, depth = found.end(), 1
        while depth:
            depth += {"(": 1, ")": -1}.get(text[end], 0)
            end += 1
        left, right = _BRACKETS[found[1]]
        text = f"{text[: found.start()]}{left}{text[found.end() : end - 1]}{right}{text[end:]}"
    return re.sub(r"\b(arctan|tan)\b", lambda m: words.term("function", m[1]), text)


# as printed, and decimals shown
UNITS = {unit: (text, int(decimals)) for unit, text, decimals in rows_of(__file__, "units")}
# functions that are brackets
_BRACKETS = {"abs": ("|", "|"), "ceil": ("⌈", "⌉"), "floor": ("⌊", "⌋")}
# functions that languages write in their own way
_FUNCTIONS = (NC_("function", "tan"), NC_("function", "arctan"))


def unit_text(unit: str, words: Words) -> str:
    """A unit in a language."""
    text, _ = UNITS.get(unit, (unit, 0))
    return words.term("unit", text) if text else ""
