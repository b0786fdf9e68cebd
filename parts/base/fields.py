"""The keys of a table of a scene, which msgspec resolves from their annotations anew whenever it is asked."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from msgspec import Struct
from msgspec.structs import FieldInfo, fields


@lru_cache(maxsize=256)
def fields_of(kind: type[Struct]) -> tuple[FieldInfo, ...]:
    """The keys of a table."""
    return fields(kind)


def given_keys(keys: Struct) -> dict[str, Any]:
    """The keys that are not as they are by default, and what they are."""
    usual = defaults_of(type(keys))
    return {name: value for name in usual if (value := getattr(keys, name)) != usual[name]}


@lru_cache(maxsize=256)
def defaults_of(kind: type[Struct]) -> dict[str, Any]:
    """What each key of a table is by default."""
    return {field.name: field.default for field in fields_of(kind)}
