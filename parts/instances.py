"""Tables ``[instances.ID]`` and ``[[drives]]`` of a scene: their keys, and every refusal of them."""

from __future__ import annotations

import re
from typing import Annotated, Any

import msgspec
from msgspec import Meta, Struct

from parts.keys import IDENTIFIER
from parts.schema import SceneError, converted, near

_Coordinate = Annotated[
    float, Meta(ge=-1_000_000, le=1_000_000, description="a coordinate of the place", extra={"unit": "mm"})
]


class InstanceSpec(Struct, forbid_unknown_fields=True):
    """Keys of ``[instances.ID]``."""

    part: Annotated[str, Meta(description="the part that stands here; default: the part of the same id")] | None = None
    at: (
        Annotated[list[_Coordinate], Meta(min_length=3, max_length=3, description="place [x, y, z] of the part, in mm")]
        | None
    ) = None
    rotation_deg: (
        Annotated[
            float,
            Meta(
                ge=-36_000,
                le=36_000,
                description="rotation about the part's axis, counter-clockwise",
                extra={"unit": "degrees"},
            ),
        ]
        | None
    ) = None


class DriveSpec(Struct, forbid_unknown_fields=True):
    """Keys of ``[[drives]]``."""

    instance: Annotated[str, Meta(description="the instance that is driven")]
    turns: Annotated[
        float,
        Meta(ge=-10_000, le=10_000, description="how far it is turned, counter-clockwise", extra={"unit": "turns"}),
    ] = 1.0


def instance_specs(raw: dict[str, Any], parts: dict[str, Struct], source: str) -> dict[str, InstanceSpec]:
    """Every instance of a scene, part by part; a part that no table names has one instance of its own id.

    Raises
    ------
    SceneError
        With the key, its value and what is allowed.
    """
    given = {key: _instance_spec(key, table, parts, source) for key, table in raw.items()}
    specs: dict[str, InstanceSpec] = {}
    for part in parts:
        own = {key: spec for key, spec in given.items() if spec.part == part}
        specs |= own or {part: InstanceSpec(part)}
    return specs


def _instance_spec(key: str, table: Any, parts: dict[str, Struct], source: str) -> InstanceSpec:
    place = f"instances.{key}"
    if not re.fullmatch(IDENTIFIER, key):
        remedy = "an instance's name is made of letters, digits, _ and - (at most 64); rename it"
        raise SceneError(source, place, None, remedy)
    if not isinstance(table, dict):
        raise SceneError(source, place, table, f"write it as a table, [instances.{key}]")
    spec = converted(table, InstanceSpec, source, place)
    if spec.part is None:
        if key not in parts:
            raise SceneError(source, f"{place}.part", None, f"is missing: which part stands here? {_known(parts)}")
        return msgspec.structs.replace(spec, part=key)
    if spec.part not in parts:
        remedy = f"no such part{near(spec.part, parts)}; {_known(parts)}"
        raise SceneError(source, f"{place}.part", spec.part, remedy)
    if key in parts and spec.part != key:
        remedy = f"{key} is itself a part; name that one, or give the instance another id"
        raise SceneError(source, f"{place}.part", spec.part, remedy)
    return spec


def _known(parts: dict[str, Struct]) -> str:
    return f"parts: {', '.join(parts)}"


def drive_spec(table: Any, instances: dict[str, InstanceSpec], source: str, place: str) -> DriveSpec:
    """One drive.

    Raises
    ------
    SceneError
        With the key, its value and what is allowed.
    """
    drive = converted(table, DriveSpec, source, place)
    check_instance(drive.instance, instances, source, f"{place}.instance")
    if drive.turns == 0:
        raise SceneError(source, f"{place}.turns", drive.turns, "turns nothing; 1.0 is one turn")
    return drive


def check_instance(name: str, instances: dict[str, InstanceSpec], source: str, place: str) -> None:
    """Refuse a name that is no instance, and say what its part stands as, if it is a part's."""
    if name in instances:
        return
    own = [key for key, spec in instances.items() if spec.part == name]
    if own:
        raise SceneError(source, place, name, f"the part stands as {', '.join(own)}; name one of them")
    remedy = f"no such instance{near(name, instances)}; instances: {', '.join(instances)}"
    raise SceneError(source, place, name, remedy)
