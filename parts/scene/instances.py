"""Tables ``[instances.ID]`` and ``[[drives]]`` of a scene: their keys, and every refusal of them."""

from __future__ import annotations

import re
from typing import Annotated, Any

import msgspec
from msgspec import Meta, Struct

from geometry.base.errors import Nearest
from parts.base.refusal import SceneError, meant
from parts.base.schema import converted
from parts.keys.base import IDENTIFIER, degrees, mm

_Coordinate = Annotated[float, mm("a coordinate of the place", least=-1_000_000, most=1_000_000)]


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
            degrees("rotation about the part's axis, counter-clockwise", least=-36_000, most=36_000),
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


def _instance_spec(key: str, table: object, parts: dict[str, Struct], source: str) -> InstanceSpec:
    place = f"instances.{key}"
    if not re.fullmatch(IDENTIFIER, key):
        raise SceneError(source, place, None, "not_a_name", Nearest("instance_1"))
    if not isinstance(table, dict):
        raise SceneError(source, place, table, "not_a_table", None, key=place)
    spec = converted(table, InstanceSpec, source, place)
    if spec.part is None:
        if key not in parts:
            raise SceneError(source, f"{place}.part", None, "which_part", None, known=list(parts))
        return msgspec.structs.replace(spec, part=key)
    if spec.part not in parts:
        raise SceneError(source, f"{place}.part", spec.part, "no_such_part", meant(spec.part, parts), known=list(parts))
    if key in parts and spec.part != key:
        raise SceneError(source, f"{place}.part", spec.part, "itself_a_part", Nearest(key), id=key)
    return spec


def drive_spec(table: object, instances: dict[str, InstanceSpec], source: str, place: str) -> DriveSpec:
    """One drive.

    Raises
    ------
    SceneError
        With the key, its value and what is allowed.
    """
    drive = converted(table, DriveSpec, source, place)
    check_instance(drive.instance, instances, source, f"{place}.instance")
    if drive.turns == 0:
        raise SceneError(source, f"{place}.turns", drive.turns, "turns_nothing")
    return drive


def check_instance(name: str, instances: dict[str, InstanceSpec], source: str, place: str) -> None:
    """Refuse a name that is no instance, and say what its part stands as, if it is a part's."""
    if name in instances:
        return
    own = [key for key, spec in instances.items() if spec.part == name]
    if own:
        raise SceneError(source, place, name, "stands_as", Nearest(own[0]), known=own)
    raise SceneError(source, place, name, "no_such_instance", meant(name, instances), known=list(instances))
