"""What a key may hold, by its annotation: numbers in a range, words, true or false; and values worth a trial."""

from __future__ import annotations

import difflib
import math
import types
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal, Union, get_args, get_origin

import msgspec
from msgspec import Meta, Struct

# where a number is missing, or something else stands in its place
_LADDER = (10.0, 5.0, 20.0, 2.0, 1.0, 50.0, 100.0, 0.5, 30.0, 3.0, 200.0, 0.1, 0.0, 60.0, 500.0, 0.01)
_MOST_TRIALS = 40


@dataclass(slots=True)
class KeyType:
    """What may stand at a place. ``low`` and ``high``: the range of its number; ``optional``: it may be left out."""

    whole: bool = False
    number: bool = False
    truth: bool = False
    words: tuple[str, ...] = ()
    low: float = -math.inf
    high: float = math.inf
    open_low: bool = False
    open_high: bool = False
    unit: str = ""
    optional: bool = False
    default: Any = None

    def allows(self, value: float) -> bool:
        """Whether a number lies in the range."""
        above = value > self.low if self.open_low else value >= self.low
        return above and (value < self.high if self.open_high else value <= self.high)


def key_type(kind: type[Struct], place: tuple[str | int, ...], table: Any) -> KeyType | None:
    """The type of a key of a struct; of several tables that may stand there, that of the one which does."""
    held: Any = kind
    field = None
    for word in place:
        table = table.get(word) if isinstance(table, dict) else _item(table, word)
        if isinstance(word, int):
            held, field = _items(held, word), None
            continue
        owner = next((s for s in _structs(held) if any(f.encode_name == word for f in msgspec.structs.fields(s))), None)
        if owner is None:
            return None
        field = next(f for f in msgspec.structs.fields(owner) if f.encode_name == word)
        held = field.type
    made = KeyType()
    _read(held, made)
    if field is not None and not field.required:
        made.optional = True
        made.default = field.default if field.default is not msgspec.NODEFAULT else None
    return made


def _item(table: Any, word: Any) -> Any:
    return table[word] if isinstance(table, list) and isinstance(word, int) and word < len(table) else None


def _structs(held: Any) -> list[type[Struct]]:
    if isinstance(held, type) and issubclass(held, Struct):
        return [held]
    if get_origin(held) in (list, tuple):
        return []
    return [s for a in get_args(held) for s in _structs(a)]


def _items(held: Any, index: int) -> Any:
    """The type of an item of a list."""
    if get_origin(held) is list:
        return get_args(held)[0]
    if get_origin(held) is tuple:
        return get_args(held)[min(index, len(get_args(held)) - 1)]
    found = [i for a in get_args(held) if not isinstance(a, Meta) and (i := _items(a, index)) is not None]
    return found[0] if found else None


def _read(held: Any, made: KeyType) -> None:
    origin = get_origin(held)
    if held in (int, float):
        made.number, made.whole = True, held is int
    elif held is bool:
        made.truth = True
    elif origin is Literal:
        made.words += tuple(a for a in get_args(held) if isinstance(a, str))
    elif origin in (Union, types.UnionType):
        for one in get_args(held):
            _read(one, made)
    elif hasattr(held, "__metadata__"):
        _read(get_args(held)[0], made)
        for meta in (m for m in held.__metadata__ if isinstance(m, Meta) and made.number):
            made.low = max(made.low, *(float(v) for v in (meta.ge, meta.gt) if v is not None), -math.inf)
            made.high = min(made.high, *(float(v) for v in (meta.le, meta.lt) if v is not None), math.inf)
            made.open_low, made.open_high = meta.gt is not None, meta.lt is not None
            made.unit = str((meta.extra or {}).get("unit", ""))


def trials(value: Any, key: KeyType) -> Iterator[Any]:
    """Values of a key worth a trial, from near to far."""
    if key.words:
        words = [w for w in key.words if w != value]
        near = difflib.get_close_matches(str(value), words, 3, 0.5) if value not in key.words else []
        yield from [*near, *(w for w in words if w not in near)]
    if key.truth and not key.number:
        yield from (v for v in (False, True) if v is not value)
    if key.number:
        seen: set[float] = set()
        tried = _whole(value, key) if key.whole else _real(value, key)
        for one in tried:
            if one not in seen and one != value and key.allows(one):
                seen.add(one)
                yield one
            if len(seen) >= _MOST_TRIALS:
                return


def coarse(value: Any, key: KeyType) -> list[Any]:
    """A few of them far from each other, to see whether the key matters at all."""
    found = list(trials(value, key))
    return found if key.words or key.truth else found[1:12:2] + found[14:15]


def is_number(value: Any) -> bool:
    """Whether a value is a number that may be computed with: whole ones may be too large for that."""
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= 1e300


def _number_of(value: Any) -> float | None:
    """The number that somebody put in quotes."""
    try:
        return float(value) if isinstance(value, str) and math.isfinite(float(value)) else None
    except ValueError:
        return None


def _whole(value: Any, key: KeyType) -> Iterator[int]:
    meant = _number_of(value)
    start = value if is_number(value) else meant if meant is not None else key.default
    if not is_number(start) or abs(start) > 1e12:
        yield from (round(v) for v in (20.0, 30.0, *_LADDER, 1000.0) if v >= 1)
        return
    inside = round(min(max(start, key.low), key.high))
    yield inside
    for step in (1, 2, 3, 4, 6, 8, 11, 15, 21, 30, 42, 60, 100, 200, 500):
        yield inside + step
        yield inside - step
    yield from (inside // 2**k for k in range(1, 8))
    yield from (10, 20, 30, 12, 60)


def _real(value: Any, key: KeyType) -> Iterator[float]:
    meant, usual = _number_of(value), float(key.default) if is_number(key.default) else None
    if meant is not None:
        yield meant
    if not is_number(value):
        yield from (v for v in (usual, *_LADDER) if v is not None)
        return
    inside = float(min(max(value, key.low), key.high))
    yield inside
    goal = usual if usual is not None else 0.0
    for k in (0.05, 0.15, 0.3, 0.5, 0.7, 0.85, 0.95, 1.0):
        yield inside + (goal - inside) * k
    for factor in (1.15, 1.5, 2.0, 0.25, 3.0, 4.0, 0.1, 8.0, 0.03, 0.01, 30.0, 0.001, 100.0):
        yield inside * factor
    yield from _LADDER
    yield -inside
