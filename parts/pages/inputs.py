"""What a calculation is given: keys on the command line, or a scene, as one table checked against a schema."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Mapping, Sequence
from copy import deepcopy
from fractions import Fraction
from functools import partial, wraps
from typing import Any, Protocol, TypeVar

import msgspec
from msgspec import Struct

from geometry.base.errors import ParameterError, format_value
from parts.base.fields import fields_of
from parts.base.refusal import REMOVED, SceneError, explained, meant, placed
from parts.base.schema import converted, unit_of
from parts.base.texts import Message

K = TypeVar("K", bound=Struct)
P = TypeVar("P")
# whose keys they are in refusals
PLACE = "calc"
_PLAIN_LIST = re.compile(r"\[([^][{}\"'=]*[^][{}\"'=\s,][^][{}\"'=]*)\]")
# the bodies of a pair, before whose keys these stand
GEARS = ("first", "second")


class Placed(Protocol):
    """An instance, as far as a page asks: whose part it is, as loaded always named."""

    @property
    def part(self) -> str | None:
        """The part that it is an instance of."""


class SceneKeys(Protocol):
    """A scene, as far as a page asks: the keys of its parts, instances and mates."""

    @property
    def parts(self) -> Mapping[str, Struct]:
        """By the ID of the part."""

    @property
    def instances(self) -> Mapping[str, Placed]:
        """By the ID of the instance."""

    @property
    def mates(self) -> Sequence[Struct]:
        """In the order of the scene."""


def table_of(pairs: Sequence[str]) -> dict[str, Any]:
    """``key=value`` words as a table; dots make tables within it, values are TOML or plain text."""
    table: dict[str, Any] = {}
    for pair in pairs:
        key, sign, text = pair.partition("=")
        if not sign or not key.strip():
            raise SceneError(PLACE, pair, None, "write_key_value")
        *path, name = key.strip().split(".")
        owner = table
        for part in path:
            owner = owner.setdefault(part, {})
            if not isinstance(owner, dict):
                raise SceneError(PLACE, key, text, "has_a_value", None, key=part)
        if name in owner:
            raise SceneError(PLACE, key, text, "given_twice")
        owner[name] = _typed(text.strip())
    return table


def _typed(text: str) -> Any:
    """A value, or a list of plain words, as no shell leaves their quotes."""
    value = toml_value(text)
    words = _PLAIN_LIST.fullmatch(text) if value == text else None
    return value if words is None else [toml_value(word.strip()) for word in words[1].split(",")]


def toml_value(text: str) -> Any:
    """A value as TOML has it; what is none, a number of thousands of digits and dates are plain text."""
    try:
        parsed = tomllib.loads(f"v = {text}")
    except (ValueError, RecursionError):
        return text
    return msgspec.to_builtins(parsed["v"]) if set(parsed) == {"v"} else text


def keys_of(kind: type[Struct]) -> list[str]:
    """The keys of a struct as typed."""
    return [f.encode_name for f in fields_of(kind)]


def exact(value: float) -> Fraction:
    """The decimal number that was typed."""
    return Fraction(str(value))


def given(spec: Struct) -> dict[str, Any]:
    """A part's keys as a plain table, without what it leaves open."""
    data = msgspec.to_builtins(spec)
    return {key: value for key, value in data.items() if value is not None and key != "kind"}


def checked(table: dict[str, Any], kind: type[Struct], topic: str) -> Any:
    """A table as the struct of a topic; refusals name the key and its nearest neighbour."""
    try:
        return converted(table, kind, PLACE, topic)
    except SceneError as refusal:
        path = refusal.key.removeprefix(f"{topic}.").split(".")
        if not refusal.code.startswith("number_not_quoted") or "[" in refusal.key:
            raise
        # no shell leaves the quotes that make text of digits
        changed = owner = deepcopy(table)
        for step in path[:-1]:
            owner = owner[step]
        owner[path[-1]] = format_value(refusal.value)
        return checked(changed, kind, topic)


def refusal(topic: str, error: ParameterError, owner: str = "", keys: Struct | None = None) -> SceneError:
    """A geometry's refusal as a line about the key that the user typed; ``keys``: the topic's, which know its unit."""
    unit = "" if keys is None else unit_of(type(keys), ".".join(filter(None, (owner, error.name))))
    return placed(PLACE, ".".join(filter(None, (topic, owner))), error, unit)


def of_topic(error: SceneError, topic: str) -> SceneError:
    """A refusal of another topic's key told as that of one which has the same keys."""
    key = f"{topic}.{error.key.partition('.')[2]}"
    return error if error.key == key else error.at(key)


def calculation(topic: str, kind: type[K]) -> Callable[[Callable[[K], P]], Callable[[dict[str, Any]], P]]:
    """A page made, or begun, of the keys of a topic as one made of a table, which is checked; refusals name the key
    as typed.
    """

    def of_keys(page: Callable[[K], P]) -> Callable[[dict[str, Any]], P]:
        @wraps(page)
        def of_table(table: dict[str, Any]) -> P:
            if "part" in table:
                raise SceneError(PLACE, "part", table["part"], "part_without_scene", REMOVED)
            keys = checked(table, kind, topic)
            try:
                return page(keys)
            except ParameterError as error:
                raise refusal(topic, error, keys=keys) from error

        return of_table

    return of_keys


def told(error: ParameterError) -> Message:
    """A geometry's refusal as a remark: what is wrong and what would work."""
    return explained(placed("", "", error))


def part_of_kind(kind: str) -> Callable[[SceneKeys, str, dict[str, Any]], dict[str, Any]]:
    """How a scene gives a page the keys of its one part of a kind, or of the one that ``part`` names."""
    return partial(_of_part, kind)


def _of_part(kind: str, scene: SceneKeys, source: str, table: dict[str, Any]) -> dict[str, Any]:
    """The keys of a part of a scene, changed by those of ``table``."""
    fitting = [key for key, spec in scene.parts.items() if spec.__struct_config__.tag == kind]
    return given(scene.parts[chosen_part(kind, fitting, fitting, source, table)]) | table


def chosen_part(kind: str, fitting: Sequence[str], alone: Sequence[str], source: str, table: dict[str, Any]) -> str:
    """The one of some parts that ``part`` of a table names, which is taken out; else the only one of ``alone``.

    Raises
    ------
    SceneError
        There is none, or no such one, or none is named of several.
    """
    part: str | None = table.pop("part", None)
    if part is None and len(alone) != 1:
        code = "choose_a_part" if alone else "none_of_kind"
        raise SceneError(source, "parts", None, code, None, known=alone, kind=kind)
    if part is not None and part not in fitting:
        code = "no_such_part" if fitting else "none_of_kind"
        raise SceneError(source, "part", part, code, meant(part, fitting), known=fitting, kind=kind)
    return part or alone[0]
