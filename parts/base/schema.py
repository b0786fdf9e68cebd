"""From plain tables to validated structs, and from a schema to words: key, value, range, unit, remedy."""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from functools import lru_cache
from inspect import get_annotations
from types import UnionType
from typing import Annotated, Any, Literal, TypeVar, Union, get_args, get_origin

import msgspec
from msgspec import Meta, Struct

from geometry.base.errors import Nearest, ParameterError, format_value
from geometry.base.nearest import nearest
from geometry.base.tolerance import LEAST_LENGTH
from parts.base.counted_over import counted_over
from parts.base.fields import fields_of
from parts.base.refusal import SYNONYMS, SceneError, in_unit, meant
from parts.base.texts import N_, Message, counted, listed, message
from parts.base.units import sexagesimal, written_units

S = TypeVar("S", bound=Struct)
K = TypeVar("K")


# XML has no place for them, whatever writes it
_CONTROL = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\ufffe\uffff]")


# what a script's rounding leaves of 0; in mm, degrees or modules nothing is as small
_NOTHING = 1e-12


def plain_numbers(value: Any, source: str, place: str, nothing: float = _NOTHING) -> Any:
    """What was read, its numbers finite: those nearer to 0 than ``nothing`` are 0, no word has control characters.

    Raises
    ------
    SceneError
        nan and inf, which TOML knows (1e400 becomes inf too): none of them is a dimension; control characters.
    """
    if isinstance(value, float):
        if not math.isfinite(value):
            raise SceneError(source, place, value, "not_finite")
        return value if abs(value) >= nothing else 0.0
    if isinstance(value, str) and _CONTROL.search(value):
        raise SceneError(source, place, value, "control_character")
    if isinstance(value, dict):
        return {
            key: plain_numbers(item, source, f"{place}.{key}" if place else str(key), nothing)
            for key, item in value.items()
        }
    if isinstance(value, list):
        return [plain_numbers(item, source, f"{place}[{index + 1}]", nothing) for index, item in enumerate(value)]
    return value


@contextmanager
def as_written(table: object) -> Iterator[None]:
    """Refusals within tell a number that ``plain_numbers`` made 0 as it stands in the ``table`` of all keys."""
    try:
        yield
    except SceneError as refusal:
        # behind the place of a default stands where that is said
        steps = map(str, steps_of(refusal.key.rpartition(": ")[2]))
        if refusal.value == 0 and isinstance(held := looked_up(table, list(steps)), float):
            refusal.value = held
        raise


def converted(table: object, kind: type[Struct], source: str, place: str) -> Any:
    """A table as a struct; msgspec's refusals are told with the key, its value and the allowed range."""
    if not isinstance(table, dict):
        raise SceneError(source, place, table, "not_a_table", key=place)
    try:
        made = msgspec.convert(table, kind)
    except msgspec.ValidationError as error:
        raise _explained(str(error), table, kind, source, place) from None
    for keys, value in _tiny(table):
        named = [i for i, key in enumerate(keys) if not key.isdigit()][-1]
        held = _types_of(_owner(kind, keys[:named], table)).get(keys[named])
        if any(meta.extra and meta.extra.get("length") and meta.ge == 0 for meta in _metas(held)):
            least = in_unit(f"{LEAST_LENGTH:g}", LEAST_LENGTH, _unit(held))
            raise SceneError(source, _written(place, keys), value, "hardly_above_zero", None, least=least)
    return made


def _written(place: str, keys: list[str]) -> str:
    """A place as refusals write it."""
    return "".join([place, *(f"[{int(k) + 1}]" if k.isdigit() else f".{k}" for k in keys)])


def _tiny(table: object, *keys: str) -> Iterator[tuple[list[str], float]]:
    """Numbers hardly above 0 of plain tables, each with its place."""
    if isinstance(table, float) and 0 < table < LEAST_LENGTH:
        yield [*keys], table
    elif isinstance(table, dict):
        for key, value in table.items():
            yield from _tiny(value, *keys, key)
    elif isinstance(table, list):
        for index, value in enumerate(table):
            yield from _tiny(value, *keys, str(index))


def kind_of(
    table: Mapping[str, Any], known: Collection[str], source: str, place: str, code: str = "unknown_kind"
) -> str:
    """What a table says that it is, one of the ``known``; ``code``: of a refusal of another."""
    kind = table.get("kind")
    if isinstance(kind, str) and kind in known:
        return kind
    if kind is None:
        _check_misspelt("kind", table, source, place)
        code = "missing_kind"
    raise SceneError(source, f"{place}.kind", kind, code, meant(kind, known), known=list(known))


def _check_misspelt(name: str, table: Mapping[str, Any], source: str, place: str, known: Collection[str] = ()) -> None:
    """Refuse a key that is none of those ``known`` but a missing one, misspelt: msgspec looks for that one first."""
    import difflib

    strange = [key for key in table if key not in known]
    for key in strange:
        if counted := counted_over(key, table[key], [name], table):
            raise SceneError(source, f"{place}.{key}", table[key], "unknown_key", counted, known=[name])
    synonyms = [key for key in strange if name in SYNONYMS.get(key.lower(), ())]
    for key in synonyms[:1] or difflib.get_close_matches(name, strange, 1, 0.7):
        raise SceneError(source, f"{place}.{key}", table[key], "unknown_key", Nearest(name, "meant"), known=[name])


def _explained(text: str, table: dict[str, Any], kind: type[Struct], source: str, place: str) -> SceneError:
    """msgspec's message in the user's terms."""
    path = re.search(r" - at `\$\.?(.*?)`$", text)
    message = text[: path.start()] if path else text
    keys = [k for k in re.split(r"[.\[\]]+", path.group(1) if path else "") if k]
    where = _written(place, keys)
    if unknown := re.search(r"unknown field `(.*?)`", message):
        owner, name = _owner(kind, keys, table), unknown.group(1)
        tag = owner.__struct_config__.tag_field
        known = ([tag] if tag else []) + [f.encode_name for f in own_first(owner)]
        around = looked_up(table, keys)
        # hardly a key that stands there already
        like = counted_over(name, around[name], known, around)
        like = like or meant(name, [key for key in known if key not in around]) or meant(name, known)
        see = f"higherpair new {owner.__struct_config__.tag}" if tag == "kind" else ""
        return SceneError(source, f"{where}.{name}", around[name], "unknown_key", like, known=known, see=see)
    if missing := re.search(r"missing required field `(.*?)`", message):
        name = missing.group(1)
        owner = _owner(kind, keys, table)
        _check_misspelt(name, looked_up(table, keys), source, where, owner.__struct_encode_fields__)
        what = _tags_of(kind, [*keys, name], table)
        what = what or _with_form(described_key(owner, name), _form_of(owner, name), kind, [*keys, name], table)
        return SceneError(source, f"{where}.{name}", None, "missing_key" if what else "missing", None, what=what)
    allowed, words = _tags_of(kind, keys, table), _tags(_tagged_at(kind, keys, table))
    if allowed is None and (named := [i for i, k in enumerate(keys) if not k.isdigit()]):
        owner, name = _owner(kind, keys[: named[-1]], table), keys[named[-1]]
        allowed, words = described_key(owner, name), _literals(_types_of(owner).get(name))
    value, wrong_type = looked_up(table, keys), re.match(r"Expected `(.*?)`, got `(.*?)`", message)
    if path and path.group(1).endswith("[...]"):
        # msgspec does not tell which entry of such a table it is
        name = _wrong_entry(_types_of(_owner(kind, keys[:-1], table)).get(keys[-1]), value)
        where, value = f"{where}.{name}", value[name]
    nearest = meant(value, words) if isinstance(value, str) and message.startswith("Invalid") else None
    allowed = _with_form(allowed, message, kind, keys, table)
    if wrong_type is None:
        return SceneError(source, where, value, "not_allowed", nearest, allowed=allowed or message)
    types, owner = wrong_type.group(1), _owner(kind, keys[:-1], table)
    may_be = {*types.split(" | ")}
    if "float" in may_be and isinstance(value, str) and (comma := re.fullmatch(r"\s*(-?\d+),(\d+)\s*", value)):
        code = "comma_in_number_or_list" if "array" in may_be else "comma_in_number"
        return SceneError(source, where, value, code, None, whole=comma.group(1), part=comma.group(2))
    if isinstance(value, str) and may_be & {"array", "object"} and value.startswith(("[", "{")):
        return SceneError(source, where, value, "brackets_read_as_text")
    is_text = may_be - {"null"} == {"str"}
    if is_text and isinstance(value, list) and (listed_in := re.match(r"(exports|mates|drives)\[", where)):
        return SceneError(source, where, value, "one_for_each", None, table=listed_in[1])
    if is_text and type(value) in (int, float) and (not words or format_value(value) in words):
        quoted = format_value(format_value(value))
        code = "number_not_quoted" if allowed is None else "number_not_quoted_of"
        return SceneError(source, where, value, code, None, last=keys[-1], quoted=quoted, allowed=allowed)
    code = "wrong_type" if allowed is None else "wrong_type_of"
    nearest = _of_type(value, types, owner, keys[-1])
    field = _field(owner, keys[-1])
    told = type_words(types, tables=field is None or bool(tables_of(field)))
    return SceneError(source, where, value, code, nearest, type=told, allowed=allowed)


def _of_type(value: object, types: str, owner: type[Struct], name: str) -> Nearest | None:
    """What was probably meant by a value where a key, or a place of its list, holds other ``types``, or nothing."""
    # a number in place of a table that has a plain key beside it: bore and bore_diameter
    if type(value) in (int, float) and has_key(owner, f"{name}_diameter"):
        return Nearest(f"{name}_diameter", "meant")
    if not name.isdigit() and (number := _number_meant(value, _types_of(owner).get(name))):
        return number
    if not name.isdigit() and (row := _row_meant(value, _types_of(owner).get(name))):
        return row
    field = _field(owner, name)
    tables = tables_of(field) if field and "object" in types else []
    return Nearest(f"{name} = {table_line(tables[0])}", "like") if tables else None


# a number in quotes, a fraction, a ratio or a share, with a sign of print, its unit or what has slipped in about it
_WRITTEN = re.compile(
    r"([\s\"'\u201c\u201d\u00ab\u00bb=(]*)([-+\u2212\u2013]?)(\d+[.,]?\d*|[.,]\d+)(?:\s*[/:]\s*(\d+[.,]?\d*))?\s*(\D*)"
)
# several numbers in a row, in brackets of any kind or none
_ROW = re.compile(r"[\s\[({]*(-?\d+(?:\.\d+)?)(?:(?:\s*[,;]\s*|\s+)(-?\d+(?:\.\d+)?))+[\s\])}]*")


def _number_meant(value: object, kind: object) -> Nearest | None:
    """The number that a key may hold and that was probably meant by what is none of its type, or nothing."""
    if isinstance(value, list) and len(value) == 1:
        (value,) = value
    if isinstance(value, str):
        value = number_in(value, _unit(kind))
    # of integers there is no end
    if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) <= sys.float_info.max:
        return None
    number = int(value) if float(value).is_integer() else float(f"{value:.12g}")
    return Nearest(number, "meant") if _fits(number, kind) else None


def number_in(text: str, unit: str) -> float | None:
    """The number that a text has, in the unit of its key; None: none, or of another unit."""
    if unit == "degrees" and (angle := sexagesimal(text)) is not None:
        return angle
    if (found := _WRITTEN.fullmatch(text)) is None:
        return None
    before, sign, *numbers, behind = found.groups("")
    digits, by = (float(number.replace(",", ".") or 1) for number in numbers)
    behind = behind.strip().lower()
    # what quotation marks leave, but for a lone one behind a length: inches
    if before.strip() or unit != "mm" or behind not in written_units():
        behind = behind.strip("\"'\u201c\u201d\u00ab\u00bb;,). ")
    size, of = (0.01 if unit != "%" else 1.0, unit) if behind == "%" else written_units().get(behind, (1.0, behind))
    if of not in ("", unit.lower(), unit) or by == 0:
        return None
    return digits / by * size * (1 if sign in "+" else -1)


def _row_meant(value: object, kind: object) -> Nearest | None:
    """The list that a key may hold and that was meant by its numbers without brackets, or in others."""
    if not isinstance(value, str) or not _ROW.fullmatch(value):
        return None
    numbers = [float(number) if "." in number else int(number) for number in re.findall(r"-?\d+(?:\.\d+)?", value)]
    return Nearest(numbers, "meant") if _fits(numbers, kind) else None


def _fits(value: object, kind: object) -> bool:
    try:
        msgspec.convert(value, kind)
    except msgspec.ValidationError:
        return False
    return True


def _form_of(owner: type[Struct], name: str) -> str:
    """What msgspec would say of an empty word, where a key takes words of a form."""
    metas = _metas(_types_of(owner).get(name))
    return "matching regex" if any(m.pattern for m in metas) else ""


def _wrong_entry(kind: object, table: Mapping[str, Any]) -> str:
    """The first key of a table of any keys whose value alone is refused."""
    for key, value in table.items():
        try:
            msgspec.convert({key: value}, kind)
        except msgspec.ValidationError:
            return key
    raise AssertionError(table)


def _with_form(
    allowed: Message | None, said: str, kind: type[Struct], keys: list[str], table: object
) -> Message | None:
    """What a key may hold, and how long it may be or what a word of it looks like where ``said`` is about that."""
    if allowed is None or not keys:
        return allowed
    field = _field(_owner(kind, keys[:-1], table), keys[-1])
    if pair := re.match(r"Expected `array` of length (\d+)", said):
        span = counted("exactly {n} number", "exactly {n} numbers", "n", n=int(pair.group(1)))
        told = next((m.description for m in _metas(field.type) if m.description), "") if field is not None else ""
        allowed = Message(told) if told else allowed
        if isinstance(held := looked_up(table, keys), list) and len(held) > int(pair.group(1)):
            span = message("{range}, with a decimal point, since a comma parts them", range=span)
    elif long := re.match(r"Expected `(str|array|object)` of length (<=|>=) (\d+)", said):
        most, number = long.group(2) == "<=", int(long.group(3))
        if long.group(1) == "array":
            own = [] if field is None else [m for m in _metas(field.type) if m.max_length == number]
            # where there is a least number ``described`` tells both
            if not most or any(m.min_length is not None for m in own):
                return allowed
            span = message("at most {limit:g}", limit=number)
        elif long.group(1) == "object":
            span = message("at least {limit:g}", limit=number)
        elif most:
            span = counted("at most {n} character", "at most {n} characters", "n", n=number)
        else:
            span = counted("at least {n} character", "at least {n} characters", "n", n=number)
    elif "matching regex" in said and field is not None and (example := _example(field)):
        span = message("like {example}", example=format_value(example))
    else:
        return allowed
    return message("{what}: {range}", what=allowed, range=span)


def _field(owner: type[Struct], name: str) -> msgspec.structs.FieldInfo | None:
    return next((f for f in fields_of(owner) if f.encode_name == name), None)


def _example(field: msgspec.structs.FieldInfo) -> str | None:
    """A word that a key may hold: its default, or the first of its examples."""
    if isinstance(field.default, str):
        return field.default
    return next((word for m in _metas(field.type) for word in m.examples or () if isinstance(word, str)), None)


def _metas(kind: object) -> list[Meta]:
    """What is said of a type and of those that it allows."""
    own = [m for m in getattr(kind, "__metadata__", ()) if isinstance(m, Meta)]
    return own + [m for a in get_args(kind) if not isinstance(a, str) for m in _metas(a)]


_TYPES = {
    "float": N_("a number"),
    "int": N_("a whole number"),
    "bool": N_("true or false"),
    "str": N_("text in quotes"),
    "object": N_("a table"),
    "array": N_("a list in brackets"),
    "array | object": N_("a table or a list of tables"),
    "bool | object": N_("true, false or a table"),
}


def type_words(types: str, *, tables: bool = True) -> Message:
    """msgspec's union of types in words; ``tables``: its objects, and its lists of them, are tables of keys."""
    names = sorted(name for name in types.split(" | ") if name != "null")
    whole = " | ".join(names)
    if whole in _TYPES and tables:
        return Message(_TYPES[whole])
    return either([Message(_TYPES.get(name, name)) for name in names])


def either(choices: list[Message]) -> Message:
    """Several choices, one after the other."""
    made = choices[0]
    for choice in choices[1:]:
        made = message("{one} or {other}", one=made, other=choice)
    return made


def _owner(kind: type[Struct], keys: list[str], table: object) -> type[Struct]:
    """The struct that holds the last key of a path; of several, the one whose tag stands in the table."""
    structs = [kind]
    for key in keys:
        table = looked_up(table, [key])
        structs = structs_of(_types_of(kind).get(key)) or structs
        # items of a list are told apart by their own tags
        tag = table.get(structs[0].__struct_config__.tag_field) if isinstance(table, dict) else None
        kind = next((s for s in structs if s.__struct_config__.tag == tag), structs[0])
    return kind


def structs_of(kind: object) -> list[type[Struct]]:
    """The structs that a type allows, those in a list too."""
    if isinstance(kind, type) and issubclass(kind, Struct):
        return [kind]
    return list(dict.fromkeys(s for a in get_args(kind) for s in structs_of(a)))


def _tagged_at(kind: type[Struct], keys: list[str], table: object) -> list[type[Struct]]:
    """The tables that the last key of a path tells apart, where it does; else none."""
    above = len(keys) - 2
    while above >= 0 and keys[above].isdigit():
        above -= 1
    if above < 0:
        return []
    structs = structs_of(_types_of(_owner(kind, keys[:above], table)).get(keys[above]))
    return structs if structs and structs[0].__struct_config__.tag_field == keys[-1] else []


def _tags_of(kind: type[Struct], keys: list[str], table: object) -> Message | None:
    """The words that the last key of a path may hold, where it tells several tables apart; else nothing."""
    tables = _tagged_at(kind, keys, table)
    return _one_of(_tags(tables)) if tables else None


def _tags(structs: list[type[Struct]]) -> list[str]:
    return [str(s.__struct_config__.tag) for s in structs]


def _one_of(words: Iterable[object]) -> Message:
    quoted = [format_value(w) for w in words]
    if len(quoted) > 1:
        return message("one of {choices}", choices=", ".join(quoted))
    return message("only {choice} works", choice=quoted[0])


def looked_up(table: object, keys: list[str]) -> Any:
    """What stands at a place in plain tables; None where there is no such place."""
    for key in keys:
        if isinstance(table, dict):
            table = table.get(key)
        elif isinstance(table, list) and key.isdigit():
            table = table[int(key)] if int(key) < len(table) else None
    return table


def described_key(owner: type[Struct], name: str) -> Message | None:
    """Meaning, range and unit of a key, in one phrase."""
    return described(_types_of(owner).get(name))


def _literals(kind: object) -> list[str]:
    """The words that a key of a type may hold."""
    if get_origin(kind) is Literal:
        return [str(a) for a in get_args(kind)]
    return [w for a in get_args(kind) if not isinstance(a, str) for w in _literals(a)]


def described(kind: object) -> Message | None:
    """Meaning, range, choices and unit of an annotated type."""
    if get_origin(kind) is Literal:
        return _one_of(get_args(kind))
    metas = [m for m in getattr(kind, "__metadata__", ()) if isinstance(m, Meta)]
    if not metas:
        if isinstance(kind, type) and issubclass(kind, Struct):
            return message("table: {what}", what=Message(phrase_of(kind)))
        tagged = [s for s in structs_of(kind) if s.__struct_config__.tag]
        if len(tagged) > 1:
            field = tagged[0].__struct_config__.tag_field
            return message("table with {key} = {choices}", key=field, choices=_one_of(_tags(tagged)))
        found = [d for d in (described(a) for a in get_args(kind)) if d is not None]
        return either([d for i, d in enumerate(found) if d not in found[:i]]) if found else None
    inner = described(get_args(kind)[0])
    # a key tells its own meaning of a type that has one
    meaning = [Message(m.description) for m in metas if m.description][-1:]
    pieces = [*meaning, *(_span(m, kind) for m in metas), inner]
    made: Message | None = None
    for piece in filter(None, pieces):
        made = piece if made is None else message("{what}: {range}", what=made, range=piece)
    return made


def _span(meta: Meta, kind: object) -> Message | None:
    """The range of a key with its unit; nothing where it has none."""
    ends: list[Message] = []
    if meta.min_length is not None and get_origin(get_args(kind)[0]) is list:
        if meta.max_length == meta.min_length:
            ends.append(counted("{n} value", "{n} values", "n", n=meta.min_length))
        else:
            ends.append(message("at least {limit:g}", limit=meta.min_length))
            if meta.max_length is not None:
                ends.append(message("at most {limit:g}", limit=meta.max_length))
    else:
        low = (N_("above {limit:g}"), meta.gt), (N_("at least {limit:g}"), meta.ge)
        high = (N_("below {limit:g}"), meta.lt), (N_("at most {limit:g}"), meta.le)
        for rows in (low, high):
            ends += [message(text, limit=end) for text, end in rows if end is not None][:1]
    unit = meta.extra.get("unit", "") if meta.extra else ""
    if not ends:
        return Message(unit) if unit else None
    return in_unit(listed(ends), ends[-1].numbers.get("limit", 0), unit)


def has_key(kind: type[Struct], name: str) -> bool:
    """Whether a table of those keys has one of that name."""
    return name in kind.__struct_encode_fields__


def own_first(kind: type[Struct]) -> list[msgspec.structs.FieldInfo]:
    """The keys of a table: those that it needs, its own, and what it shares with more and more others."""
    names = [name for one in kind.__mro__ for name in get_annotations(one)]
    return sorted(fields_of(kind), key=lambda field: (not field.required, names.index(field.name)))


def is_open(field: msgspec.structs.FieldInfo) -> bool:
    """Whether a key has no default to show."""
    return field.default is msgspec.NODEFAULT or field.default is None


def example_of(kind: object) -> Meta | None:
    """The last annotation with examples, of the outermost that have any: a key may have another one than its type."""
    if get_origin(kind) not in (Annotated, Union, UnionType):
        return None
    own = [m for m in getattr(kind, "__metadata__", ()) if isinstance(m, Meta) and m.examples]
    return own[-1] if own else next(filter(None, map(example_of, get_args(kind))), None)


def tables_of(field: msgspec.structs.FieldInfo) -> list[type[Struct]]:
    """The kinds of table that a key takes."""
    return [a for a in get_args(field.type) or (field.type,) if isinstance(a, type) and issubclass(a, Struct)]


def marks_of(meta: Meta | None) -> Mapping[str, Any]:
    """What else is said of a key beside its examples."""
    return (meta.extra if meta is not None else None) or {}


def starting_value(field: msgspec.structs.FieldInfo, meta: Meta | None) -> str:
    """What stands at a key as TOML: what a scene starts from, its default, an example, or the first of its tables."""
    if meta is not None and meta.examples and (is_open(field) or "start" in marks_of(meta)):
        return as_toml(meta.examples[-1])
    tables = tables_of(field)
    return as_toml(field.default) if not is_open(field) else table_line(tables[0]) if tables else "..."


def as_toml(value: object) -> str:
    """A value as it stands in a scene."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {as_toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(as_toml, value)) + "]"
    return f'"{value}"' if isinstance(value, str) else str(value)


def table_line(table: type[Struct]) -> str:
    """A table of a kind, in one line; without the tables in it that may be left out."""
    config = table.__struct_config__
    tag = [f'{config.tag_field} = "{config.tag}"'] if config.tag_field else []
    own = [f for f in fields_of(table) if not (f.default is None and tables_of(f))]
    shown = [(f, meta) for f in own if not marks_of(meta := example_of(f.type)).get("aside")]
    inner = (f"{f.encode_name} = {starting_value(f, meta)}" for f, meta in shown)
    return "{ " + ", ".join([*tag, *inner]) + " }"


def untold(kind: type[Struct], named: Collection[str] = (), place: str = "") -> Iterator[str]:
    """Keys with neither default nor example, and tables without a docstring: ``new`` has nothing to tell of them.

    ``named``: keys that hold a name of the scene's.
    """
    if not kind.__doc__:
        yield f"{place or 'the table of its keys'} has no docstring"
    for field in fields_of(kind):
        name, tables = f"{place}.{field.encode_name}".lstrip("."), tables_of(field)
        if field.required and not tables and field.encode_name not in named and example_of(field.type) is None:
            yield f"{name} has neither default nor example"
        for table in tables:
            yield from untold(table, (), name)
        # those of a list are told by the example of the list
        yield from (f"{name} has no docstring" for s in structs_of(field.type) if s not in tables and not s.__doc__)


def phrase_of(kind: type[Struct]) -> str:
    """What a table of keys is, in one phrase: a text, without the marks of a docstring."""
    return (kind.__doc__ or "").splitlines()[0].rstrip(".").replace("``", "")


def steps_of(path: str) -> list[str | int]:
    """The keys and indices of a place as refusals write it: ``holes[2].diameter``."""
    return [int(number) - 1 if number else key for number, key in re.findall(r"\[(\d+)\]|([^.[]+)", path)]


def replaced(keys: object, path: str, value: object) -> Any:
    """A struct with the value of one key changed, at any depth; lists are copied.

    Raises
    ------
    ParameterError
        There is no such place.
    """
    return _replaced(keys, steps_of(path), value, path)


def tried(keys: S, path: str, value: object) -> S:
    """A struct with another value of one key, None: without it, as a scene would give it.

    Raises
    ------
    ParameterError
        The value is not one that the key may have.
    """
    changed = replaced(keys, path, value)
    try:
        return msgspec.convert(without_none(msgspec.to_builtins(changed)), type(keys))
    except msgspec.ValidationError as error:
        raise ParameterError(path, value, "not_allowed", allowed=str(error)) from error


def nearest_key(
    keys: K,
    path: str,
    given: float,
    toward: float | Iterable[float],
    whole: Callable[[K], object],
    *,
    digits: int = 4,
) -> Nearest | None:
    """The value of a key nearest to the ``given`` one with which what the keys make is ``whole``; see ``nearest``."""
    return nearest(lambda value: bool(whole(replaced(keys, path, value))), given, toward, digits=digits)


def without_none(held: object) -> Any:
    """What JSON would have, but its nulls."""
    if isinstance(held, dict):
        return {key: without_none(value) for key, value in held.items() if value is not None}
    return [without_none(value) for value in held] if isinstance(held, list | tuple) else held


def _replaced(held: object, steps: list[str | int], value: object, path: str) -> Any:
    if not steps:
        if isinstance(held, int) and not isinstance(held, bool) and isinstance(value, float) and value.is_integer():
            return int(value)
        return value
    step, *rest = steps
    if isinstance(held, Struct) and isinstance(step, str) and step in held.__struct_fields__:
        return msgspec.structs.replace(held, **{step: _replaced(getattr(held, step), rest, value, path)})
    if isinstance(held, list | tuple) and isinstance(step, int) and step < len(held):
        return [*held[:step], _replaced(held[step], rest, value, path), *held[step + 1 :]]
    raise ParameterError(path, value, "unknown_key", known=[])


def value_at(keys: object, path: str) -> Any:
    """What stands at a key, at any depth; None where there is no such place."""
    for step in steps_of(path):
        if isinstance(step, int):
            keys = keys[step] if isinstance(keys, list | tuple) and step < len(keys) else None
        else:
            keys = getattr(keys, step) if isinstance(keys, Struct) and step in keys.__struct_fields__ else None
    return keys


def as_typed(keys: Struct, refusal: ParameterError) -> ParameterError:
    """A refusal of one side's key in the key that the scene has: one number for both, or a table."""
    both = refusal.name.rpartition(".")[0]
    return refusal.renamed(both) if both and isinstance(value_at(keys, both), float) else refusal


def unit_of(kind: type[Struct], path: str) -> str:
    """The unit of a key, at any depth; empty where it has none."""
    names = [s for s in steps_of(path) if isinstance(s, str)]
    owners = [kind]
    for name in names[:-1]:
        owners = [s for o in owners if (found := _types_of(o).get(name)) for s in structs_of(found)]
    return _unit(next((found for o in owners if (found := _types_of(o).get(names[-1]))), None))


@lru_cache(maxsize=256)
def _types_of(kind: type[Struct]) -> dict[str, object]:
    """What stands at each key."""
    return {f.encode_name: f.type for f in fields_of(kind)}


def _unit(kind: object) -> str:
    for meta in getattr(kind, "__metadata__", ()):
        if isinstance(meta, Meta) and meta.extra and "unit" in meta.extra:
            return str(meta.extra["unit"])
    return next(filter(None, (_unit(a) for a in get_args(kind) if not isinstance(a, str))), "")
