"""What keys mean, which a refusal in another language leaves out: the key says it, and its range and words stay."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from functools import cache
from typing import Any, get_args

import msgspec
from msgspec import Meta, Struct

from exporters.words_errors_more import MEANINGS


def without_meaning(piece: str) -> str | None:
    """A piece of a refusal without the English description in it; empty if there is no more; None if it is none."""
    from exporters.words_errors import piece_in_ukrainian

    tail = piece
    while True:
        head, colon, tail = tail.partition(": ")
        if not any(head in text for text in _meanings()) and head != "table":
            return None
        if not colon:
            return "таблиця" if piece.startswith("table: ") else ""
        choices = [one for one in tail.split(" or ") if not one.startswith("table: ")]
        made = [piece_in_ukrainian(one) for one in choices]
        if made and None not in made:
            return " або ".join(filter(None, made))


def without_meanings(remedy: str) -> str:
    """A refusal without the descriptions of keys that stand in it whole; the few that say all are put in Ukrainian."""
    for text in sorted((m for m in _meanings() if m in remedy), key=len, reverse=True):
        place = rf"(^|; |: | or )(table: )?{re.escape(text)}(: |; | or |$)"
        for found in reversed(list(re.finditer(place, remedy))):
            told = MEANINGS.get(text) or ("table" if found[2] else "")
            remedy = remedy[: found.start()] + _closed(found[1], told, found[3]) + remedy[found.end() :]
    return remedy


def _closed(before: str, told: str, after: str) -> str:
    """What is left where a description stood, or where ``told`` takes its place."""
    if told:
        return f"{before}{told}{'; ' if after == ': ' else after}"
    if after == "; ":
        return before if before in ("", "; ") else after
    return before if after else ""


def _meanings() -> frozenset[str]:
    """All descriptions of keys and tables, those of the calculations that are at work too."""
    asked = [m for name, m in list(sys.modules.items()) if name.startswith("exporters.calculations.")]
    tables = [v for m in asked for v in vars(m).values() if isinstance(v, type) and issubclass(v, Struct)]
    return _of_scenes() | {text for owner in dict.fromkeys(tables) for text in _described(owner, set())}


@cache
def _of_scenes() -> frozenset[str]:
    """Those of parts, mates and exports."""
    from parts.kinds import KINDS
    from parts.mates import MATES
    from parts.scene import ChecksSpec, ExportSpec, SceneInfo

    owners = [*(spec for spec, *_ in KINDS.values()), *MATES.values(), ExportSpec, SceneInfo, ChecksSpec]
    return frozenset(text for owner in owners for text in _described(owner, set()))


def _described(kind: Any, seen: set[Any]) -> Iterator[str]:
    if isinstance(kind, type) and issubclass(kind, Struct):
        if kind in seen:
            return
        seen.add(kind)
        yield (kind.__doc__ or "").splitlines()[0].rstrip(".")
        for field in msgspec.structs.fields(kind):
            yield from _described(field.type, seen)
        return
    for meta in getattr(kind, "__metadata__", ()):
        if isinstance(meta, Meta) and meta.description:
            yield meta.description
    for one in get_args(kind):
        yield from _described(one, seen)
