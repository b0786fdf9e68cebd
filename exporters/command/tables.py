"""The closing tables of the command: drawn by rich on a terminal, plain columns anywhere else."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TypeAlias, TypeVar

from parts.base.part import Part
from parts.base.texts import Words
from parts.texts.findings import finding_message

# letters in a line of a terminal that nobody has widened
_PAGE_WIDTH = 80
T = TypeVar("T")
# of a table what stands above each column, and what in it
Columns: TypeAlias = tuple[tuple[str, Callable[[T], str]], ...]


def part_notes(parts: Iterable[Part], told: Words, labels: dict[str, list[str]] | None = None) -> list[str]:
    """What was noticed on parts, beside what is of others (``labels``: by its words), each once."""
    labels = {} if labels is None else labels
    for part in parts:
        for finding in part.findings:
            labels.setdefault(told.say(finding_message(finding)), []).append(part.id)
    named = ((", ".join(dict.fromkeys(own)), text) for text, own in labels.items())
    return [told.text("note: {text}", text=f"{names}: {text}") for names, text in named]


def show(title: str, columns: Columns[T], items: Sequence[T], told: Words, remarks: list[str]) -> None:
    """A table, where it has rows, and the lines below it. rich is loaded for a terminal only: it costs a build."""
    header = [told.text(head) for head, _ in columns]
    rows = [[cell(item) for _, cell in columns] for item in items]
    if rows and sys.stdout.isatty():
        _show_rich(title, header, rows)
    elif rows:
        sys.stdout.write("".join(f"{line}\n" for line in [*filter(None, [_printable(title)]), *_plain(header, rows)]))
    sys.stdout.write("".join(line + "\n" for line in remarks))


def _plain(header: Sequence[str], rows: list[list[str]]) -> Iterator[str]:
    """Columns; a name for which the width of a page leaves no room stands on a line of its own."""
    widths = [max(map(len, column)) for column in zip(header, *rows, strict=True)]
    room = max(len(header[0]), _PAGE_WIDTH - sum(w + 2 for w in widths[1:]))
    widths[0] = max(len(row[0]) for row in (header, *rows) if len(row[0]) <= room)
    for first, *rest in (header, *rows):
        if len(first) > widths[0]:
            yield first
            first = ""
        yield "  ".join([first.ljust(widths[0]), *(c.rjust(w) for c, w in zip(rest, widths[1:], strict=True))])


def _show_rich(title: str, header: Sequence[str], rows: list[list[str]]) -> None:
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    table = Table(title=escape(_printable(title)), title_justify="left")
    for column, name in enumerate(header):
        # on a narrow terminal no digit is left out
        table.add_column(name, justify="right" if column else "left", overflow="fold")
    for row in rows:
        table.add_row(*map(escape, row))
    Console(highlight=False, emoji=False).print(table)


def _printable(text: str) -> str:
    """A text without the characters that steer a terminal."""
    return "".join(c if c.isprintable() else " " for c in text)
