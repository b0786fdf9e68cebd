"""What a calculation of a pair is given, as the keys of its two bodies and of what is wanted of both."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import msgspec
from msgspec import Struct

from parts.base.refusal import SceneError, meant
from parts.pages.inputs import PLACE, keys_of

GEARS = ("first", "second")


def merged(under: Mapping[str, Any], over: Mapping[str, Any], pair: type[Struct]) -> dict[str, Any]:
    """Tables laid over each other; a key of the bodies without first. or second. goes to every one that has it."""
    result = {key: dict(value) if isinstance(value, dict) else value for key, value in under.items()}
    owners = {field.name: keys_of(field.type) for field in msgspec.structs.fields(pair) if field.name in GEARS}
    for key, value in over.items():
        having = [name for name, known in owners.items() if key in known]
        if key in GEARS and isinstance(value, dict):
            result[key] = result.get(key, {}) | value
        elif key in keys_of(pair) or not having:
            result[key] = value
        else:
            for name in having:
                mine = over.get(name)
                if not (isinstance(mine, dict) and key in mine):
                    result[name] = {**result.get(name, {}), key: value}
    return result


def pair_table(table: Mapping[str, Any], pair: type[Struct], topic: str) -> dict[str, Any]:
    """What was typed as the keys of both bodies and of the pair.

    Raises
    ------
    SceneError
        A key that neither has, or a body of which nothing is told.
    """
    made, bodies = merged({}, table, pair), [f.type for f in msgspec.structs.fields(pair) if f.name in GEARS]
    known = list(dict.fromkeys([*keys_of(pair), *(key for kind in bodies for key in keys_of(kind)), "kind"]))
    for key in made:
        if key not in keys_of(pair):
            raise SceneError(PLACE, f"{topic}.{key}", made[key], "unknown_key", meant(key, known), known=known)
    for name in GEARS:
        if name not in made:
            raise SceneError(PLACE, f"{topic}.{name}", None, "gear_missing", None, name=name)
    return made
