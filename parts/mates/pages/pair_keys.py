"""What a calculation of a pair is given, as the keys of its two bodies and of what is wanted of both."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import msgspec
from msgspec import Struct

from parts.base.refusal import SceneError, meant
from parts.pages.inputs import PLACE, keys_of

GEARS = ("first", "second")
# the second body of each kind of pair
_SECOND = {"external_gear_pair": "spur_gear", "internal_gear_pair": "ring_gear", "rack_pair": "rack"}


def kind_of_pair(table: Mapping[str, Any], topic: str, known: Sequence[str]) -> tuple[str, dict[str, Any]]:
    """The kind of a pair, told by ``kind`` or by what its second body is, ``second.kind``; and the other keys.

    Raises
    ------
    SceneError
        A kind that is none of the ``known``.
    """
    rest = {key: value for key, value in table.items() if key != "kind"}
    second = rest.get("second")
    if "kind" in table or not isinstance(second, dict) or "kind" not in second:
        key, kind = f"{topic}.kind", table.get("kind", known[0])
        if kind not in known:
            raise SceneError(PLACE, key, kind, "unknown_pair", meant(kind, known), known=known)
        return kind, rest
    bodies = {_SECOND[kind]: kind for kind in known}
    if (body := second["kind"]) not in bodies:
        raise SceneError(PLACE, f"{topic}.second.kind", body, "not_one_of", meant(body, bodies), known=list(bodies))
    return bodies[body], rest | {"second": {key: value for key, value in second.items() if key != "kind"}}


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
