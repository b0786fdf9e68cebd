"""The parser of the command, and what argparse says of itself, in the language of the command."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import Any, NoReturn

from parts.base.texts import Words

# figure dash, en dash, em dash, bar and minus, which editors make of -
_PRINTED_DASHES = "\u2012\u2013\u2014\u2015\u2212"


class Misused(Exception):
    """A command line that means nothing: one line for its user."""


class _Help(argparse.RawDescriptionHelpFormatter):
    """Help as wide as the terminal, as argparse has it, which would load all archives of ``shutil`` to ask that."""

    def __init__(self, prog: str) -> None:
        super().__init__(prog, width=_columns() - 2)

    def _split_lines(self, text: str, width: int) -> list[str]:
        """Lines that break at blanks alone: no topic is read with a hyphen at the end of a line."""
        import textwrap

        return textwrap.wrap(" ".join(text.split()), width, break_on_hyphens=False)


class Parser(argparse.ArgumentParser):
    """A parser that raises ``Misused``."""

    words: Words
    # adds arguments that are not needed before this parser is asked
    takes: Callable[[Parser], None] | None = None

    def __init__(self, **how: Any) -> None:
        super().__init__(formatter_class=_Help, **how)

    def whole(self) -> Parser:
        """This parser with all its arguments."""
        takes, self.takes = self.takes, None
        if takes is not None:
            takes(self)
        return self

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """As argparse has it, which asks the parser of a command in this way too."""
        return super(Parser, self.whole()).parse_known_args(args, namespace)

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """A word that is none of the choices: with the one that was meant, as later versions of Python have it."""
        if action.choices is None or value in action.choices:
            return
        from parts.base.refusal import meant

        closest = meant(value, list(action.choices))
        if closest is None:
            super()._check_value(action, value)
            return
        text = self.words.text("invalid choice: %(value)r, maybe you meant %(closest)r? (choose from %(choices)s)")
        told = {"value": value, "closest": closest.value, "choices": ", ".join(map(repr, action.choices))}
        raise argparse.ArgumentError(action, text % told)

    def error(self, message: str) -> NoReturn:
        """One line, and where there is more."""
        _refuse(self.words, message, self.prog)


def _refuse(words: Words, message: str, command: str) -> NoReturn:
    raise Misused(f"higherpair: {words.text('{message}; see `{command} --help`', message=message, command=command)}")


def parsed(parser: Parser, arguments: Sequence[str]) -> argparse.Namespace:
    """What a command line says. Words behind options belong to those before them, which argparse leaves over.

    ``several`` of a command: the name of its positional words, and what one of them is made by.

    Raises
    ------
    Misused
        Words that mean nothing.
    """
    # the dashes of a text editor begin no option, and no value
    if printed := next((word for word in arguments if word and word[0] in _PRINTED_DASHES), None):
        _refuse_strange(parser, [printed], parser.prog, _options_of(parser))
    options, rest = parser.parse_known_args(arguments)
    several: tuple[str, Callable[[str], object]] | None = getattr(options, "several", None)
    if strange := [word for word in rest if several is None or word.startswith("-")]:
        _refuse_strange(parser, strange, f"{parser.prog} {options.command}", _options_of(parser, options.command))
    if several is not None:
        name, made_by = several
        found = [file for word in map(str, (*getattr(options, name), *rest)) for file in _matched(word)]
        setattr(options, name, [made_by(word) for word in found])
    return options


def _matched(word: str) -> list[str]:
    """The files of a pattern that the shell has left as it is, as those of Windows do; else the word itself."""
    if not {"*", "?"} & {*word} or os.path.lexists(word):
        return [word]
    import glob

    return sorted(glob.glob(word)) or [word]


def _options_of(parser: Parser, command: str | None = None) -> list[str]:
    """The options of one of the commands, or of all of them."""
    commands = {name: made for a in parser._actions if isinstance(a.choices, dict) for name, made in a.choices.items()}
    asked = [*commands.values(), parser] if command is None else [commands[command]]
    return [one for made in asked for one in made.whole()._option_string_actions]


def _refuse_strange(parser: Parser, strange: Sequence[str], command: str, known: Sequence[str]) -> NoReturn:
    """Words that are none of the options, with that which the first was probably meant for."""
    from parts.base.reasons import REMEDIES
    from parts.base.refusal import meant

    text = parser.words.text("unrecognized arguments: %s") % " ".join(strange)
    bare = {one.lstrip("-"): one for one in known if one.startswith("--")}
    word = strange[0].lstrip("-" + _PRINTED_DASHES).partition("=")[0]
    if close := meant(word, bare):
        remedy = parser.words.text(REMEDIES["meant"], value=bare[str(close.value)])
        text = parser.words.text("{why}; {remedy}", why=text, remedy=remedy)
    _refuse(parser.words, text, command)


def _columns() -> int:
    """What the environment says, else the terminal, else 80."""
    said = os.environ.get("COLUMNS", "")
    if said.isdecimal() and int(said) > 0:
        return int(said)
    with suppress(OSError):
        return os.get_terminal_size().columns or 80
    return 80


@contextmanager
def speaking(words: Words) -> Iterator[None]:
    """Let argparse speak a language while parsers are made and used."""
    own = vars(argparse)
    before = {name: own[name] for name in ("_", "ngettext")}
    own.update(_=words.text, ngettext=words.plural)
    Parser.words = words
    try:
        yield
    finally:
        own.update(before)
