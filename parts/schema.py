"""From plain tables to validated structs, and from a schema to words: key, value, range, unit, remedy."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from typing import Any, Literal, get_args, get_origin

import msgspec
from msgspec import Meta, Struct

from geometry.errors import format_value


class SceneError(ValueError):
    """A scene cannot be read or built: the place, what stands there, and what would work."""

    def __init__(self, source: str, key: str, value: object, remedy: str) -> None:
        self.source, self.key, self.value, self.remedy = source, key, value, remedy
        given = "" if value is None else f" = {_shown(value)}"
        place = f"{source}: {key}{given}" if key else source or '""'
        super().__init__("".join(c if c.isprintable() else "?" for c in f"{place}: {remedy}"))


def refuse_infinite(value: Any, source: str, place: str) -> None:
    """TOML knows nan and inf, and 1e400 becomes inf: none of them is a dimension."""
    if isinstance(value, float) and not math.isfinite(value):
        raise SceneError(source, place, value, "must be a finite number below 1e308")
    if isinstance(value, dict):
        for key, item in value.items():
            refuse_infinite(item, source, f"{place}.{key}" if place else str(key))
    if isinstance(value, list):
        for index, item in enumerate(value):
            refuse_infinite(item, source, f"{place}[{index + 1}]")


def converted(table: Any, kind: type[Struct], source: str, place: str) -> Any:
    """A table as a struct; msgspec's refusals are told with the key, its value and the allowed range."""
    if not isinstance(table, dict):
        raise SceneError(source, place, table, "write it as a table of keys")
    try:
        return msgspec.convert(table, kind)
    except msgspec.ValidationError as error:
        raise _explained(str(error), table, kind, source, place) from None


def _explained(text: str, table: dict[str, Any], kind: type[Struct], source: str, place: str) -> SceneError:
    """msgspec's message in the user's terms."""
    path = re.search(r" - at `\$\.?(.*?)`$", text)
    message = text[: path.start()] if path else text
    keys = [k for k in re.split(r"[.\[\]]+", path.group(1) if path else "") if k]
    where = ".".join([place, *(f"item {int(k) + 1}" if k.isdigit() else k for k in keys)])
    if unknown := re.search(r"unknown field `(.*?)`", message):
        owner, name = _owner(kind, keys, table), unknown.group(1)
        tag = owner.__struct_config__.tag_field
        known = ([tag] if tag else []) + [f.encode_name for f in msgspec.structs.fields(owner)]
        remedy = f"unknown key{near(name, known)}; known keys: {', '.join(known)}"
        return SceneError(source, f"{where}.{name}", _lookup(table, [*keys, name]), remedy)
    if missing := re.search(r"missing required field `(.*?)`", message):
        name = missing.group(1)
        meant = _describe_tags(kind, [*keys, name], table) or describe_key(_owner(kind, keys, table), name)
        return SceneError(source, f"{where}.{name}", None, f"is missing: {meant}")
    hint = _describe_tags(kind, keys, table)
    if not hint and (named := [i for i, k in enumerate(keys) if not k.isdigit()]):
        hint = describe_key(_owner(kind, keys[: named[-1]], table), keys[named[-1]])
    wrong_type = re.match(r"Expected `(.*?)`, got `(.*?)`", message)
    kinds = f"must be {_TYPE_WORDS.get(wrong_type.group(1), wrong_type.group(1))}" if wrong_type else ""
    remedy = "; ".join(filter(None, (kinds, hint)))
    return SceneError(source, where, _lookup(table, keys), remedy or message)


_TYPE_WORDS = {
    "float": "a number",
    "int": "a whole number",
    "bool": "true or false",
    "str": "text in quotes",
    "float | null": "a number",
    "float | object": "a number or a table",
    "str | null": "text in quotes",
    "array | null": "a list in brackets",
    "object | null": "a table",
    "object": "a table",
    "str | object": "text or a table",
    "bool | object": "true, false or a table",
    "array | object | null": "a table or a list of tables",
    "object | array | null": "a table or a list of tables",
}


def _owner(kind: type[Struct], keys: list[str], table: Any) -> type[Struct]:
    """The struct that holds the last key of a path; of several, the one whose tag stands in the table."""
    for key in keys:
        table = _lookup(table, [key])
        field = next((f for f in msgspec.structs.fields(kind) if f.encode_name == key), None)
        if field is not None and (structs := _structs_of(field.type)):
            tag = table.get(structs[0].__struct_config__.tag_field) if isinstance(table, dict) else None
            kind = next((s for s in structs if s.__struct_config__.tag == tag), structs[0])
    return kind


def _structs_of(kind: Any) -> list[type[Struct]]:
    """The structs that a type allows, those in a list too."""
    found = [a for a in (*get_args(kind), kind) if isinstance(a, type) and issubclass(a, Struct)]
    return found or [a for k in get_args(kind) for a in get_args(k) if isinstance(a, type) and issubclass(a, Struct)]


def _describe_tags(kind: type[Struct], keys: list[str], table: Any) -> str:
    """The words that the last key of a path may hold, where it tells several tables apart; else nothing."""
    if len(keys) < 2:
        return ""
    owner = _owner(kind, keys[:-2], table)
    field = next((f for f in msgspec.structs.fields(owner) if f.encode_name == keys[-2]), None)
    structs = _structs_of(field.type) if field is not None else []
    return _tag_words(structs) if len(structs) > 1 and structs[0].__struct_config__.tag_field == keys[-1] else ""


def _tag_words(structs: list[type[Struct]]) -> str:
    return "one of " + ", ".join(f'"{s.__struct_config__.tag}"' for s in structs)


def _lookup(table: Any, keys: list[str]) -> Any:
    for key in keys:
        if isinstance(table, dict):
            table = table.get(key)
        elif isinstance(table, list) and key.isdigit():
            table = table[int(key)]
    return table


def describe_key(owner: type[Struct], name: str) -> str:
    """Meaning, range and unit of a key, in one phrase."""
    field = next((f for f in msgspec.structs.fields(owner) if f.encode_name == name), None)
    return "" if field is None else describe_type(field.type)


def describe_type(kind: Any) -> str:
    """Meaning, range, choices and unit of an annotated type."""
    if get_origin(kind) is Literal:
        return "one of " + ", ".join(f'"{a}"' for a in get_args(kind))
    meta = next((m for m in getattr(kind, "__metadata__", ()) if isinstance(m, Meta)), None)
    if meta is None:
        if isinstance(kind, type) and issubclass(kind, Struct):
            return f"table: {(kind.__doc__ or '').splitlines()[0].rstrip('.')}"
        tagged = [s for s in _structs_of(kind) if s.__struct_config__.tag]
        if len(tagged) > 1:
            return f"table with {tagged[0].__struct_config__.tag_field} = {_tag_words(tagged)}"
        return " or ".join(dict.fromkeys(filter(None, (describe_type(a) for a in get_args(kind)))))
    low = f"above {meta.gt:g}" if meta.gt is not None else f"at least {meta.ge:g}" if meta.ge is not None else ""
    high = f"at most {meta.le:g}" if meta.le is not None else f"below {meta.lt:g}" if meta.lt is not None else ""
    if meta.min_length is not None and get_origin(get_args(kind)[0]) is list:
        low = f"{meta.min_length} values" if meta.max_length == meta.min_length else f"at least {meta.min_length}"
    unit = meta.extra["unit"] if meta.extra else ""
    span = " ".join(filter(None, (", ".join(filter(None, (low, high))), unit)))
    return ": ".join(filter(None, (meta.description, span, describe_type(get_args(kind)[0]))))


def near(word: str, known: Iterable[str]) -> str:
    """A hint at the known word that was probably meant, or nothing."""
    import difflib

    match = difflib.get_close_matches(word, list(known), 1, 0.5)
    return f" (did you mean {match[0]}?)" if match else ""


def _shown(value: object) -> str:
    text = " ".join((format_value(value) if not isinstance(value, dict | list) else str(value)).split())
    return text if len(text) <= 60 else text[:57] + "..."
