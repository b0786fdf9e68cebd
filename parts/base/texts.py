"""Texts in the reader's language: English stands in the code, every other language is one gettext catalogue.

A text is a msgid, or a ``Message``: a msgid with the numbers for its ``{name}`` placeholders, put off until the
language is known. Data keep texts; ``words(language).say(text)`` tells them. English reads no file.

The marks that the extraction finds (``python -m tests.catalogues``): ``N_``, ``NC_``, ``message``, ``fault``,
``unless``, ``counted``, ``in_context`` and the methods ``unless``, ``text``, ``plural``, ``term``, ``note`` and
``section``, where their msgids are literals.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from gettext import NullTranslations

ENGLISH = "en"
DOMAIN = "higherpair"
# of printed numbers: a hyphen is shorter
MINUS = "\N{MINUS SIGN}"
# numbers in words that name or type something: (3.4), fig. 3.9, tip_shortening_coefficient=0.145
_NAMED = re.compile(r"(\(\d+\.\d+\)|[^\W\d]\. \d+\.\d+(?:\N{EN DASH}\d+\.\d+)?|\b[a-z]{2}[a-z_]{2,} ?= ?[-\d.]+)")
LOCALE = Path(__file__).parents[1] / "locale"
# what plural rules say of a number with a fraction: that of a negative count, which no text has
_FRACTION = -1

# catalogues of other packages, behind ours: domain and folder
_added: list[tuple[str, Path]] = []


class Message(NamedTuple):
    """A text that waits for its language: ``many`` is its plural by the number called ``by``.

    ``numbers`` may hold messages too, which are told in the same language.
    """

    msgid: str
    numbers: Mapping[str, object] = MappingProxyType({})
    many: str = ""
    by: str = ""
    context: str = ""


Text = str | Message

# how many decimals or digits a format asks for, and of a limit what is rounding and no step more
_ASKED, _ROUNDING = r"(?:\.(\d+))?([fg])", 1e-10


class Told(float):
    """A limit as it is told: whatever the format, the last digit is rounded to the side that works, up or down."""

    up: bool

    def __new__(cls, value: float, *, up: bool) -> Told:
        made = super().__new__(cls, value)
        made.up = up
        return made

    def __format__(self, form: str) -> str:
        # commands that tell no limit start without it
        import math

        asked = re.fullmatch(_ASKED, form)
        if asked is None or self == 0 or not math.isfinite(self):
            return super().__format__(form)
        decimals = int(asked[1] or 6)
        if asked[2] == "g":
            decimals -= 1 + math.floor(math.log10(abs(self)))
        steps = self * 10.0**decimals
        slack = min(abs(steps) * _ROUNDING, 1e-3)
        return format((math.ceil(steps - slack) if self.up else math.floor(steps + slack)) / 10.0**decimals, form)


class Fault(str):
    """What is wrong with a file: in English, as reports keep it, with the message that tells it in other languages."""

    __slots__ = ("message",)
    message: Message


def N_(text: str) -> str:
    """Mark a msgid for extraction: the same text."""
    return text


def NC_(context: str, text: str) -> str:
    """Mark a msgid that one English word shares with another meaning: the same text, without its context."""
    return text


def message(msgid: str, /, **numbers: object) -> Message:
    """A text with what its placeholders stand for."""
    return Message(msgid, numbers)


def fault(msgid: str, /, **numbers: object) -> str:
    """What is wrong with a file."""
    told = Fault(msgid.format(**numbers))
    told.message = message(msgid, **numbers)
    return told


def unless(well: object, msgid: str, /, **numbers: object) -> list[str]:
    """What is wrong with a file that should be well in something; nothing where it is."""
    return [] if well else [fault(msgid, **numbers)]


def fault_of(who: str, what: str) -> str:
    """What is wrong with one of several."""
    return fault("{who}: {what}", who=who, what=what)


def counted(one: str, many: str, /, by: str, **numbers: object) -> Message:
    """A text whose form follows the number called ``by``, given here or by ``filled``."""
    return Message(one, numbers, many, by)


def in_context(context: str, msgid: str, /, **numbers: object) -> Message:
    """A text that says which of an English word's meanings it has."""
    return Message(msgid, numbers, context=context)


def listed(texts: Sequence[Text]) -> Message:
    """Several texts with commas between them."""
    named = {f"text_{k}": Message(text) if isinstance(text, str) else text for k, text in enumerate(texts)}
    return Message(", ".join(f"{{{name}}}" for name in named), named)


def standard_told(names: str) -> Text:
    """A standard by its number, or several with commas between them, in the reader's letters."""
    told = [message("GOST {number}", number=n[5:]) if n.startswith("GOST ") else n for n in names.split(", ")]
    return listed(told) if len(told) > 1 else told[0]


def filled(text: Text, /, **numbers: object) -> Message:
    """A text of a table with its numbers."""
    made = Message(text) if isinstance(text, str) else text
    return made._replace(numbers={**made.numbers, **numbers})


def told_in(language: str, told: str | Mapping[str, str]) -> str:
    """Words of a scene, which may stand in several languages: in this one, else in English, else in the first."""
    return told if isinstance(told, str) else told.get(language, told.get(ENGLISH, next(iter(told.values()))))


class Words(NamedTuple):
    """One language; its methods translate, then fill in the placeholders where numbers are given.

    Numbers may be messages too, which are told in the same language.
    """

    language: str
    catalogue: NullTranslations | None

    def text(self, msgid: str, /, **numbers: object) -> str:
        """A text."""
        return self._filled(self.catalogue.gettext(msgid) if self.catalogue and msgid else msgid, numbers)

    def plural(self, one: str, many: str, n: float, /, **numbers: object) -> str:
        """A text by a count, 1 tooth or 2 teeth; a count with a fraction may have a form of its own."""
        if self.catalogue:
            told = self.catalogue.ngettext(one, many, abs(int(n)) if n == int(n) else _FRACTION)
        else:
            told = one if n == 1 else many
        return self._filled(told, numbers)

    def term(self, context: str, msgid: str, /, **numbers: object) -> str:
        """A text of one of the meanings of an English word."""
        return self._filled(self.catalogue.pgettext(context, msgid) if self.catalogue else msgid, numbers)

    def say(self, text: Text) -> str:
        """A text that may have waited, with all that it holds."""
        if isinstance(text, Fault):
            text = text.message
        if isinstance(text, str):
            return self.text(text)
        if text.many:
            count = text.numbers[text.by]
            assert isinstance(count, int | float)
            return self.plural(text.msgid, text.many, count, **text.numbers)
        if text.context:
            return self.term(text.context, text.msgid, **text.numbers)
        return self.text(text.msgid, **text.numbers)

    def _filled(self, told: str, numbers: Mapping[str, object]) -> str:
        said = {name: self.say(n) if isinstance(n, Message | Fault) else n for name, n in numbers.items()}
        return told.format(**said) if said else told

    def decimal(self, number: str) -> str:
        """A number, or words with numbers, as the language prints it on drawings: 0.5 or 0,5, with a true minus."""
        # points of indices stay, and hyphens of ranges and names; nobody reads powers of ten as 8.47e-06 on paper
        told = re.sub(r"\b\d+(?:\.\d+)?e[-+]0\d\b", _written_out, number)
        told = re.sub(r"(?<=\d)\.(?=\d)", self.term("decimal point", "."), told)
        return re.sub(r"(?<![\w)}\]-])-(?=\d)", MINUS, told)

    def phrase(self, said: str) -> str:
        """Words with numbers as the language prints them; names of equations, figures and tables, (3.4) or fig. 3.9,
        and keys with their values stay as they are read and typed.
        """
        told = "".join(one if k % 2 else self.decimal(one) for k, one in enumerate(_NAMED.split(said)))
        lists = told != said and self.term("decimal point", ".") == ","
        return re.sub(rf"(?<=\d), (?=[\d{MINUS}])", "; ", told) if lists else told

    def printed(self, formula: str) -> str:
        """A formula with its numbers as the language prints it: true minus signs too, no comma of a number beside one
        of a list.
        """
        told = self.decimal(formula)
        if told != formula and self.term("decimal point", ".") == ",":
            told = told.replace(", ", "; ")
        return re.sub(r"(?<![^\s(|{\[/·])-(?=[\w(√∛|\s])", MINUS, told)


def _written_out(found: re.Match[str]) -> str:
    """A number with a power of ten, with all its zeros."""
    mantissa, _, power = found[0].partition("e")
    return f"{float(found[0]):.{max(len(mantissa.partition('.')[2]) - int(power), 0)}f}"


@cache
def words(language: str) -> Words:
    """The words of a language; one without a catalogue speaks English."""
    if language == ENGLISH:
        return Words(ENGLISH, None)
    from gettext import find, translation

    homes = [home for home in ((DOMAIN, LOCALE), *_added) if find(*home, [language])]
    catalogues = [translation(*home, [language]) for home in homes]
    for one in catalogues[1:]:
        catalogues[0].add_fallback(one)
    return Words(language, catalogues[0] if catalogues else None)


@cache
def english_of(word: str, most: int) -> list[str]:
    """So many texts in English whose translation in some language is a word, begins with it or has it, likest first.

    Behind them what those begin with whose translation begins so: the chamfer of the tips, a chamfer.
    """
    wanted, found = _letters(word), set[tuple[int, int, str]]()
    for language in languages():
        # gettext tells translations of a text alone: of all of them its own table
        table: dict[object, str] = getattr(words(language).catalogue, "_catalog", {})
        for msgid, told in table.items():
            if isinstance(msgid, str) and wanted in (own := _letters(told)) and f" {wanted} " in f" {own} ":
                rank = 0 if own == wanted else 1 if own.startswith(wanted) else 2
                found.add((rank, len(own), re.split("[,:;(=]", msgid.rpartition("\x04")[2])[0].strip()))
    likest = sorted(found)[:most]
    heads = [re.split(" (?:of|for|in|at) ", msgid)[0] for rank, _, msgid in likest if rank < 2]
    # a number of teeth is no number
    return [*(msgid for *_, msgid in likest), *(head for head in heads if head.count(" ") >= wanted.count(" "))]


def _letters(told: str) -> str:
    """Words in small letters, one blank between them, with one form of the apostrophe."""
    return " ".join(re.findall(r"[^\W_]+(?:'[^\W_]+)*", re.sub("[\u2019\u02bc]", "'", told.lower())))


def languages() -> tuple[str, ...]:
    """English, and each language whose folder lies beside the others."""
    return ENGLISH, *sorted(p.name for p in LOCALE.iterdir() if (p / "LC_MESSAGES" / f"{DOMAIN}.mo").is_file())


def add_catalogue(domain: str, folder: Path) -> None:
    """Another package's texts: ``folder/LANGUAGE/LC_MESSAGES/domain.mo``, asked where ours has nothing."""
    if (domain, folder) not in _added:
        _added.append((domain, folder))
        words.cache_clear()
