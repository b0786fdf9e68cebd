"""The catalogues of languages: ``python -m tests.catalogues`` takes the texts out of the code and compiles.

Each ``parts/locale/LANGUAGE/LC_MESSAGES/higherpair.po`` gets the texts of today, keeps its translations and its head,
and is compiled to the .mo beside it. A new language begins as such a .po with a head of its own (``Language`` and
``Plural-Forms``; the rule for ``n < 0`` is that of numbers with a fraction). Texts without a translation are counted;
``test_catalogues`` refuses them. Babel is needed here only.
"""

from __future__ import annotations

import ast
import inspect
import io
import pkgutil
import re
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any, Literal, get_args, get_origin

from babel.messages.catalog import Catalog, Message
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po, write_po
from msgspec import Meta, Struct
from msgspec.structs import fields

import parts
from exporters.command.new import comments_of
from geometry.base.record import Draft, Record
from geometry.laws.named import NAMED_LAWS
from parts.base.densities import NAMES as MATERIALS
from parts.base.reasons import SUBJECTS, sentences
from parts.base.registry import KINDS
from parts.base.schema import phrase_of
from parts.base.texts import DOMAIN, LOCALE
from parts.drawing.names import NAME_OF_PART
from parts.drawing.title_block import LABELS
from parts.keys.law import EXAMPLES
from parts.mates.pages.lever_tasks import MACHINES
from parts.mates.registry import MATES
from parts.pages.cam_steps import law_text
from parts.pages.contour_picture import STYLES
from parts.pages.misprints import CASES
from parts.pages.module_rules import CONDITIONS, RULES
from parts.pages.page import UNITS
from parts.pages.symbols import INDICES
from parts.pages.terms import TERMS
from parts.pages.text import SOURCES
from parts.recipes.names import NAMES
from parts.recipes.registry import RECIPES
from parts.scene.files import SCENE_FOLDER
from parts.scene.toml_errors import SENTENCES
from parts.texts import checks
from parts.texts.findings import FINDINGS
from parts.texts.planetary import FAULTS
from parts.texts.quantities import QUANTITIES
from parts.texts.sheets import SHEETS
from tests.sources import told

HOUSE = Path(parts.__file__).parents[1]
# argparse asks gettext for these, which would look for the terminal's language in the system's catalogues
_ARGPARSE = (
    "usage: ",
    "positional arguments",
    "options",
    "show this help message and exit",
    "show program's version number and exit",
    "unrecognized arguments: %s",
    "ambiguous option: %(option)s could match %(matches)s",
    "argument %(argument_name)s: %(message)s",
    "invalid choice: %(value)r (choose from %(choices)s)",
    "invalid choice: %(value)r, maybe you meant %(closest)r? (choose from %(choices)s)",
    "expected one argument",
    "expected at most one argument",
    "expected at least one argument",
    "invalid %(type)s value: %(value)r",
    "the following arguments are required: %s",
    "one of the arguments %s is required",
    "not allowed with argument %s",
    "ignored explicit argument %r",
)
_PACKAGES = (HOUSE / "parts", HOUSE / "exporters")
Key = tuple[str | None, str]
_HEAD = """\
msgid ""
msgstr ""
"Project-Id-Version: higherpair\\n"
"Language: {language}\\n"
"MIME-Version: 1.0\\n"
"Content-Type: text/plain; charset=UTF-8\\n"
"Content-Transfer-Encoding: 8bit\\n"
"""


def extracted() -> dict[Key, str]:
    """All texts by context and msgid; for each its plural, empty where it has none.

    Raises
    ------
    ValueError
        A text with two plurals.
    """
    found: dict[Key, str] = {}
    for context, one, many in (*_marked(), *_kept_in_data()):
        if found.setdefault((context, one), many) != many:
            raise ValueError(f"{one!r} stands with a plural and without it, or with two")
    return found


def _marked() -> Iterator[tuple[str | None, str, str]]:
    """What the marks in the code name, where it is written out there."""
    for file in (file for package in _PACKAGES for file in sorted(package.rglob("*.py"))):
        yield from told(file.read_text("utf-8")).marked


def _kept_in_data() -> Iterator[tuple[str | None, str, str]]:
    """What needs no mark: sentences by code, plain texts, and of units those that are words."""
    tables = (*map(sentences, SUBJECTS), FINDINGS, checks.MATES, checks.CONDITIONS, SHEETS, LABELS, FAULTS)
    for text in (text for table in tables for text in table.values()):
        yield (None, text, "") if isinstance(text, str) else (text.context or None, text.msgid, text.many)
    yield from ((None, text, "") for text in (*_plain_texts(), *_ARGPARSE))
    yield from ((NAME_OF_PART, text, "") for text in KINDS.called.values())
    yield None, "expected %s argument", "expected %s arguments"
    yield from (("index", text, "") for text in INDICES.values())
    yield from (("source", text, "") for text in SOURCES)
    yield from (("unit", text, "") for text, _ in UNITS.values() if any(map(str.isalpha, text)))


def _plain_texts() -> Iterator[str]:
    """Kinds, terms, keys and tables of scenes and calculations."""
    yield from (*KINDS.phrases.values(), *MATES.phrases.values(), *RECIPES.phrases.values())
    yield from SENTENCES
    yield from (term.name for term in TERMS.values())
    yield from (*QUANTITIES.values(), *MATERIALS, *(meant for _, meant in EXAMPLES))
    yield from (one.title for recipe in NAMES.values() for one in recipe.values() if one.title)
    yield from (row.reason for row in (*RULES, *CONDITIONS))
    yield from MACHINES.values()
    yield from (printed.why for case in CASES.values() for printed in case.values())
    # the rest are symbols
    yield from (style.name for style in STYLES.values() if re.search("[a-z]{4}", style.name))
    yield from (law_text(law().name).msgid for law in NAMED_LAWS.values())
    for file in sorted(SCENE_FOLDER.glob("*.toml")):
        yield from comments_of(file.read_text("utf-8"))
    for kind in _structs():
        if not (phrase := phrase_of(kind)).startswith("Keys of"):
            yield phrase
        for field in fields(kind):
            yield from _descriptions(field.type)


def _structs() -> list[type[Struct]]:
    """All tables of keys, in the order of their names; records are none."""
    found: dict[str, type[Struct]] = {}
    for module in pkgutil.walk_packages(parts.__path__, "parts."):
        if ".solids" in module.name:
            continue
        for _, thing in inspect.getmembers(import_module(module.name), inspect.isclass):
            is_table = issubclass(thing, Struct) and not issubclass(thing, Record | Draft)
            if is_table and thing.__module__.startswith("parts."):
                found[f"{thing.__module__}.{thing.__qualname__}"] = thing
    return [found[name] for name in sorted(found)]


def _descriptions(kind: Any) -> Iterator[str]:
    """The meanings in an annotated type."""
    for meta in getattr(kind, "__metadata__", ()):
        if isinstance(meta, Meta) and meta.description:
            yield meta.description
        if isinstance(meta, Meta) and meta.extra and "unit" in meta.extra:
            yield meta.extra["unit"]
    for one in get_args(kind):
        yield from _descriptions(one)


def names_typed() -> Iterator[str]:
    """What is typed as it is in every language: kinds, built-in scenes, keys and their choices."""
    yield from (*KINDS.phrases, *MATES.phrases, *RECIPES.phrases, *(file.stem for file in SCENE_FOLDER.glob("*.toml")))
    for kind in _structs():
        for field in fields(kind):
            yield field.name
            yield from _choices(field.type)


def _choices(kind: Any) -> Iterator[str]:
    """The words among which an annotated type leaves the choice."""
    for one in get_args(kind):
        if get_origin(kind) is Literal:
            yield str(one)
        else:
            yield from _choices(one)


def catalogue_files() -> list[Path]:
    """The .po of every language."""
    return sorted(LOCALE.glob(f"*/LC_MESSAGES/{DOMAIN}.po"))


def read(file: Path) -> Catalog:
    """A .po with the number of plural forms of its head."""
    with file.open("rb") as stream:
        return read_po(stream, abort_invalid=True)


def updated(file: Path, texts: dict[Key, str]) -> str:
    """A .po with the texts of today, its translations and its head kept."""
    head, _, _ = file.read_text("utf-8").partition("\n\n")
    old = read(file)
    # begun with the head: a catalogue that knows no language has two forms of each plural
    new = read_po(io.BytesIO(f"{head}\n".encode()), abort_invalid=True)
    for (context, one), many in texts.items():
        kept = old.get(one, context)
        string = kept.string if kept is not None and bool(kept.pluralizable) == bool(many) else None
        empty = ("",) * old.num_plurals if many else ""
        new.add((one, many) if many else one, string or empty, context=context)
    stream = io.BytesIO()
    write_po(stream, new, width=110, no_location=True, omit_header=True, sort_output=True)
    return f"{head}\n\n{stream.getvalue().decode('utf-8').strip()}\n"


def compiled(file: Path) -> bytes:
    """The .mo of a .po: the same bytes from any Babel."""
    head = ast.literal_eval("(" + file.read_text("utf-8").partition("\n\n")[0].partition("msgstr ")[2] + ")")
    told = [m for m in read(file) if m.id and all(_forms(m)) and not m.fuzzy]
    stream = io.BytesIO()
    write_mo(stream, _Compiled([Message("", head), *told]))  # type: ignore[arg-type]
    return stream.getvalue()


class _Compiled(list[Message]):
    """Messages with the head of their .po: a Babel catalogue would put its own version and the date there."""

    charset = "utf-8"


def untranslated(file: Path) -> list[str]:
    """The msgids of a .po that lack a translation, or one of its forms, or have a doubtful one."""
    return [str(m.id) for m in read(file) if m.id and (m.fuzzy or not all(_forms(m)))]


def _forms(told: Message) -> tuple[str, ...]:
    return tuple(told.string) if isinstance(told.string, tuple) else (told.string,)


def main(words: list[str]) -> int:
    """Bring every language up to date; ``words``: languages to begin."""
    for language in words:
        file = LOCALE / language / "LC_MESSAGES" / f"{DOMAIN}.po"
        if not file.exists():
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(_HEAD.format(language=language) + "\n", "utf-8")
    texts = extracted()
    for file in catalogue_files():
        file.write_text(updated(file, texts), "utf-8")
        file.with_suffix(".mo").write_bytes(compiled(file))
        print(f"{file.relative_to(HOUSE)}: {len(texts)} texts, {len(untranslated(file))} without a translation")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
