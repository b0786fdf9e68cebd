"""What a calculation is given: keys on the command line, or a scene, as one table checked against a schema."""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from typing import Any

import msgspec
from msgspec import Struct

from geometry.errors import ParameterError
from geometry.gears.limits import checked_gear
from geometry.gears.spur import SpurGear
from geometry.gears.transverse import transverse_gear
from parts.schema import SceneError, converted, near, refuse_infinite
from parts.spur_gear import SpurGearSpec

# whose keys they are in refusals
PLACE = "calc"


def table_of(pairs: Sequence[str]) -> dict[str, Any]:
    """``key=value`` words as a table; dots make tables within it, values are TOML or plain text."""
    table: dict[str, Any] = {}
    for pair in pairs:
        key, sign, text = pair.partition("=")
        if not sign or not key.strip():
            raise SceneError(PLACE, pair, None, "write key=value, like number_of_teeth=23")
        *path, name = key.strip().split(".")
        owner = table
        for part in path:
            owner = owner.setdefault(part, {})
            if not isinstance(owner, dict):
                raise SceneError(PLACE, key, text, f"{part} has a value already; remove one of them")
        if name in owner:
            raise SceneError(PLACE, key, text, "is given twice; once is enough")
        owner[name] = _value(text.strip())
    refuse_infinite(table, PLACE, "")
    return table


def _value(text: str) -> Any:
    try:
        parsed = tomllib.loads(f"v = {text}")
    except (tomllib.TOMLDecodeError, RecursionError):
        return text
    return parsed["v"] if set(parsed) == {"v"} else text


def keys_of(kind: type[Struct]) -> list[str]:
    """The keys of a struct as typed."""
    return [f.encode_name for f in msgspec.structs.fields(kind)]


def given(spec: Struct) -> dict[str, Any]:
    """A part's keys as a plain table, without what it leaves open."""
    data = msgspec.to_builtins(spec)
    return {key: value for key, value in data.items() if value is not None and key != "kind"}


def checked(table: dict[str, Any], kind: type[Struct], topic: str) -> Any:
    """A table as the struct of a topic; refusals name the key and its nearest neighbour."""
    return converted(table, kind, PLACE, topic)


def refusal(topic: str, error: ParameterError, owner: str = "") -> SceneError:
    """A geometry's refusal as a line about the key that the user typed."""
    key = ".".join(filter(None, (topic, owner, error.name)))
    return SceneError(PLACE, key, error.value, error.allowed)


def checked_section(normal: SpurGear, helix: float) -> SpurGear:
    """The transverse section of a gear, checked to exist; refusals say that their numbers are transverse.

    Raises
    ------
    ParameterError
        The gear cannot exist.
    """
    try:
        return checked_gear(transverse_gear(normal, helix))
    except ParameterError as error:
        if not helix:
            raise
        text = f"{error.allowed} (numbers of the transverse section)"
        raise ParameterError(error.name, error.value, text) from error


def only_part(scene: Any, source: str, part: str | None) -> str:
    """The part of a scene that is calculated: the one named, or the only gear there is."""
    gears = [key for key, spec in scene.parts.items() if isinstance(spec, SpurGearSpec)]
    if part is not None:
        if part not in gears:
            raise SceneError(source, "part", part, f"no such gear{near(part, gears)}; gears: {', '.join(gears)}")
        return part
    if len(gears) != 1:
        raise SceneError(source, "parts", None, f"has {len(gears)} gears: {', '.join(gears)}; add part=ID")
    return gears[0]


def part_of_kind(scene: Any, source: str, table: dict[str, Any], kind: str) -> dict[str, Any]:
    """The keys of the scene's one part of a kind, or of the one that ``part`` names, changed by those of ``table``."""
    fitting = [key for key, spec in scene.parts.items() if spec.__struct_config__.tag == kind]
    part = table.pop("part", None)
    if part is None and len(fitting) != 1:
        raise SceneError(source, "parts", None, f"has {len(fitting)} of {kind}: {', '.join(fitting)}; add part=ID")
    if part is not None and part not in fitting:
        known = f"{near(part, fitting)}; there are {', '.join(fitting)}" if fitting else "; the scene has none"
        raise SceneError(source, "part", part, f"is no {kind}{known}")
    return given(scene.parts[part or fitting[0]]) | table
