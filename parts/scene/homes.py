"""Where a key belongs that stands in a table which has none of that name: the other tables of a scene that have it."""

from __future__ import annotations

import difflib
from collections.abc import Iterator, Mapping
from typing import Any

from msgspec import Struct

from geometry.base.errors import format_value
from parts.base.fields import fields_of
from parts.base.refusal import SYNONYMS, SceneError
from parts.base.schema import either, has_key, looked_up, steps_of, structs_of
from parts.base.texts import Message, Text, message
from parts.keys.boards import PURPOSES_LAID
from parts.scene.defaults import defaults_take
from parts.scene.kinds import homes

Tables = dict[str, Any]
# a spelling that is nearer to a key of its own table is meant for that one
_NEAR = 0.75
# so many kinds are told of those that have a key
_FEW = 3


def at_home(refusal: SceneError, raw: Tables, plain: Mapping[str, type[Struct]]) -> SceneError:
    """A refusal of a key that its table has not, with the tables that have it, where there are some.

    ``raw``: the tables of the scene, ``plain``: the keys of those that are of no kind, by their headers.
    """
    steps = [str(step) for step in steps_of(refusal.key)]
    if steps and len(steps) < 4 and steps[0] in map(_table, plain):
        refusal.numbers["see"] = refusal.numbers.get("see") or f"higherpair new {steps[0]}"
    own, key = "" if len(steps) < 2 else steps[0], steps[-1] if steps else ""
    # what a mate does not lay higher its place does
    near, alike = refusal.nearest, ["at"] if (own, key) == ("mates", "height") else SYNONYMS.get(key.lower(), [])
    sure = near and (near.side == "same" or near.value in alike)
    if sure or (near and difflib.SequenceMatcher(None, key, str(near.value)).ratio() >= _NEAR):
        return refusal
    export = plain["[[exports]]"]
    # of exports that have it none takes it
    if own == "defaults" and has_key(export, key):
        return refusal
    within = len(steps) > len(("parts", "ID", "key"))
    for header, kinds in homes().items():
        # a table of what has the key itself
        kind = looked_up(raw, [*steps[:2], "kind"]) if within and own == _table(header) else None
        if isinstance(kind, str) and kind in kinds and has_key(kinds[kind].keys, key):
            return _told(refusal, key, [f"[{own}.{steps[1]}]" if own == "parts" else header])
    if within:
        # far tables have keys of the same name by chance, as instances have the `at` of a corner
        return refusal
    for name in (key, *alike):
        found: list[Text] = [*_inside(name, raw, steps)]
        # what others of its own table take helps none of its kind
        others = {table: rows for table, rows in raw.items() if within or table != own}
        if own != "defaults" and defaults_take(name, others, export):
            found.append("[defaults]")
        for header, kinds in homes().items():
            table = _table(header)
            there = [row["kind"] for row in _rows(raw.get(table)) if row.get("kind") in [*kinds]]
            if table != own and any(has_key(kinds[kind].keys, name) for kind in there):
                found.append(header)
        for header, keys in plain.items():
            if (
                _table(header) != own
                and has_key(keys, name)
                and (_table(header) in raw or _table(header) not in PURPOSES_LAID)
            ):
                found.append(header)
        if found:
            return _told(refusal, name, found)
    found = [*_of_others(key, raw, plain)]
    return _told(refusal, key, found) if found else refusal


def _told(refusal: SceneError, name: str, found: list[Text]) -> SceneError:
    tables = either([Message("{it}", {"it": place}) for place in found])
    return SceneError(refusal.source, refusal.key, refusal.value, "key_elsewhere", None, home=name, tables=tables)


def _table(header: str) -> str:
    return header.strip("[]").partition(".")[0]


def _rows(tables: object) -> list[dict[str, Any]]:
    """The tables of one name, whatever stands there."""
    held = tables.values() if isinstance(tables, dict) else tables if isinstance(tables, list) else ()
    return [row for row in held if isinstance(row, dict)]


def _inside(name: str, raw: Tables, steps: list[str]) -> Iterator[Text]:
    """The tables in that part, mate or assembly itself which have a key."""
    for header, kinds in homes().items():
        if not steps or steps[0] != _table(header) or len(steps) < 3:
            continue
        kind = looked_up(raw, [*steps[:2], "kind"])
        for field in fields_of(kinds[kind].keys) if isinstance(kind, str) and kind in kinds else ():
            if any(has_key(keys, name) for keys in structs_of(field.type)):
                yield field.encode_name


def _of_others(name: str, raw: Tables, plain: Mapping[str, type[Struct]]) -> Iterator[Text]:
    """The tables that have a key, but are not in the scene, or are there of other kinds."""
    for header, kinds in homes().items():
        having = [format_value(kind) for kind in kinds if has_key(kinds[kind].keys, name)]
        if having:
            told: Text = ", ".join(having[:_FEW])
            if len(having) > _FEW:
                told = message("{few} and {more} more", few=told, more=len(having) - _FEW)
            yield message("{table} of kind {kinds}", table=header, kinds=told)
    yield from (header for header, keys in plain.items() if _table(header) not in raw and has_key(keys, name))
