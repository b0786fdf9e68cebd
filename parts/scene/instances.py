"""Tables ``[instances.ID]`` and ``[[drives]]`` of a scene: their keys, and every refusal of them.

A table with a ``count`` is a group: so many instances ID_1, ID_2 ... about one axis. What names a group is said of each
member, a step further from one to the next.
"""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Collection, Iterator, Mapping
from typing import TYPE_CHECKING, Annotated, Any

from msgspec import Meta, Struct
from msgspec.structs import replace

from geometry.base.errors import Nearest
from geometry.base.record import Record
from parts.base.part_keys import Title
from parts.base.refusal import REMOVED, SceneError, meant
from parts.base.schema import converted
from parts.keys.base import IDENTIFIER, degrees, mm

if TYPE_CHECKING:
    from parts.base.mate import MateKeys

_Coordinate = Annotated[float, mm("a coordinate of the place", least=-1_000_000, most=1_000_000)]

_AT = Meta(min_length=3, max_length=3, description="place [x, y, z] of the part, in mm")
_ROTATION = degrees("rotation about the part's axis, counter-clockwise", least=-36_000, most=36_000)
_AXIS = Meta(
    min_length=3,
    max_length=3,
    description="direction [x, y, z] of the part's axis, of any length; default: upwards",
    examples=[[1.0, 0.0, 0.0]],
)
_SUBASSEMBLY = Meta(
    pattern=IDENTIFIER, description="what it is assembled with, in the product tree", examples=["drive"]
)


class InstanceSpec(Struct, forbid_unknown_fields=True):
    """Keys of ``[instances.ID]``."""

    part: Annotated[str, Meta(description="the part that stands here; default: the part of the same id")] | None = None
    at: Annotated[list[_Coordinate], _AT] | None = None
    rotation_deg: Annotated[float, _ROTATION] | None = None
    axis: Annotated[list[Annotated[float, Meta(ge=-1e6, le=1e6)]], _AXIS] | None = None
    held: Annotated[bool, Meta(description="stands still, as the frame does: a ring that is screwed on")] | None = None
    subassembly: Annotated[str, _SUBASSEMBLY] | None = None

    title: Title | None = None


_COUNT = Meta(ge=1, le=1000, description=("number of equal ones: ID_1, ID_2 ..."), examples=[3])
_ABOUT = Meta(min_length=2, max_length=2, description="with count: [x, y] of the axis about which they stand, in mm")
_STEP = degrees("with count: from each to the next; default: 360 / count", least=-360, most=360)


class InstanceTable(InstanceSpec, forbid_unknown_fields=True):
    """Keys of ``[instances.ID]`` as they stand in a file: one instance, or several."""

    count: Annotated[int, _COUNT] | None = None
    about: Annotated[list[_Coordinate], _ABOUT] | None = None
    step_deg: Annotated[float, _STEP] | None = None


class Group(Record):
    """Equal instances about an axis: their ids, and the angle (degrees) from each to the next."""

    members: tuple[str, ...]
    step_deg: float

    def angle(self, index: int) -> float:
        """How far a member is turned from the first, degrees."""
        return index * self.step_deg


_TRAVEL = mm("for a slide, instead of turns: how far it travels along its x axis", least=-1e6, most=1e6)
_TURNS = Meta(ge=-10_000, le=10_000, description="how far it is turned, counter-clockwise", extra={"unit": "turns"})


class DriveSpec(Struct, forbid_unknown_fields=True):
    """Keys of ``[[drives]]``."""

    instance: Annotated[str, Meta(description="the instance that is driven")]
    turns: Annotated[float, _TURNS] = 1.0
    travel: Annotated[float, _TRAVEL] | None = None


def instance_specs(
    raw: dict[str, Any], parts: Collection[str], source: str
) -> tuple[dict[str, InstanceSpec], dict[str, Group]]:
    """Every instance of a scene, part by part, and the groups; a part that no table names has one of its own id.

    Raises
    ------
    SceneError
        With the key, its value and what is allowed.
    """
    given: dict[str, InstanceSpec] = {}
    groups: dict[str, Group] = {}
    for key, table in raw.items():
        spec = _instance_table(key, table, parts, source)
        made = {key: _one(spec, 0.0)}
        if spec.count is not None:
            group = _group(key, spec, spec.count)
            groups[key] = group
            made = {member: _one(spec, group.angle(k), k + 1) for k, member in enumerate(group.members)}
        for member in made:
            _check_id(member, spec, parts, source, f"instances.{key}")
            if member in given or (member in raw and member != key):
                raise SceneError(source, f"instances.{member}", None, "is_a_member", None, group=f"instances.{key}")
        given |= made
    specs: dict[str, InstanceSpec] = {}
    for part in parts:
        own = {key: spec for key, spec in given.items() if spec.part == part}
        specs |= own or {part: InstanceSpec(part)}
    return specs, groups


def _instance_table(key: str, table: object, parts: Collection[str], source: str) -> InstanceTable:
    """One table, with the part that stands there."""
    place = f"instances.{key}"
    if not re.fullmatch(IDENTIFIER, key):
        raise SceneError(source, place, None, "not_a_name", Nearest("instance_1"))
    spec: InstanceTable = converted(table, InstanceTable, source, place)
    for name in ("about", "step_deg") if spec.count is None else ():
        if (value := getattr(spec, name)) is not None:
            raise SceneError(source, f"{place}.{name}", value, "only_of_a_count", REMOVED)
    if spec.about is not None and spec.at is None:
        # where each stands is for its mates to say
        raise SceneError(source, f"{place}.about", spec.about, "about_needs_at", REMOVED)
    if spec.axis is not None and not any(spec.axis):
        raise SceneError(source, f"{place}.axis", spec.axis, "no_direction")
    if spec.axis is not None and spec.at is None:
        raise SceneError(source, f"{place}.axis", spec.axis, "axis_needs_at", REMOVED)
    if spec.part is None:
        if key not in parts:
            raise SceneError(source, f"{place}.part", None, "which_part", None, known=list(parts))
        return replace(spec, part=key)
    if spec.part not in parts:
        raise SceneError(source, f"{place}.part", spec.part, "no_such_part", meant(spec.part, parts), known=list(parts))
    return spec


def _check_id(key: str, spec: InstanceSpec, parts: Collection[str], source: str, place: str) -> None:
    if not re.fullmatch(IDENTIFIER, key):
        raise SceneError(source, place, None, "not_a_name", Nearest("instance"))
    if key in parts and spec.part != key:
        raise SceneError(source, f"{place}.part", spec.part, "itself_a_part", Nearest(key), id=key)


def _group(key: str, spec: InstanceTable, count: int) -> Group:
    step = 360 / count if spec.step_deg is None else spec.step_deg
    return Group(tuple(f"{key}_{number}" for number in range(1, count + 1)), step)


def _one(spec: InstanceTable, angle: float, number: int = 0) -> InstanceSpec:
    """One instance, or the member of this number, turned about the axis by so many degrees."""
    title = f"{spec.title} {number}" if spec.title and number else spec.title
    if spec.at is None or not angle:
        return InstanceSpec(spec.part, spec.at, spec.rotation_deg, spec.axis, spec.held, spec.subassembly, title)
    axis = complex(*(spec.about or (0.0, 0.0)))
    moved = axis + (complex(*spec.at[:2]) - axis) * cmath.rect(1.0, math.radians(angle))
    turned = (spec.rotation_deg or 0.0) + angle
    direction = None if spec.axis is None else complex(*spec.axis[:2]) * cmath.rect(1.0, math.radians(angle))
    tilted = spec.axis and direction is not None and [direction.real, direction.imag, spec.axis[2]]
    moved_to = [moved.real, moved.imag, spec.at[2]]
    return InstanceSpec(spec.part, moved_to, turned, tilted or None, spec.held, spec.subassembly, title)


def members(mate: MateKeys, groups: Mapping[str, Group], source: str, place: str) -> Iterator[MateKeys]:
    """A mate as it is, or for each member of the group that it names: directions and seats go on with the members.

    Raises
    ------
    SceneError
        Two groups of different size.
    """
    one, two = groups.get(mate.first), groups.get(mate.second)
    group = two or one
    if group is None:
        yield mate
        return
    if one is not None and two is not None and len(one.members) != len(two.members):
        told = {"first": mate.first, "count": len(one.members)}
        raise SceneError(source, f"{place}.second", mate.second, "groups_differ", None, "", **told)
    for index, member in enumerate(group.members):
        ends = {"first": mate.first if one is None else one.members[index], "second": mate.second}
        ends["second"] = mate.second if two is None else member
        yield replace(mate, **ends, **({} if one and two else _further(mate, index, group, placed=two is not None)))


def _further(mate: MateKeys, index: int, group: Group, *, placed: bool) -> dict[str, Any]:
    """What a mate says of a member, so many steps on; ``placed``: the members are its seconds."""

    def said(key: str) -> Any:
        return getattr(mate, key)

    from parts.keys.mate import further

    keys, angle = mate.__struct_fields__, group.angle(index)
    found: dict[str, Any] = {}
    if "number" in keys:
        found["number"] = said("number") + index
    if "direction_deg" in keys and angle:
        found["direction_deg"] = further(said("direction_deg"), angle)
    axis = said("axis") if "axis" in keys else None
    if "rotation_deg" in keys and angle and placed:
        # what is turned over turns the other way about its own axis
        over = axis is not None and not any(axis[:2]) and axis[2] < 0
        found["rotation_deg"] = said("rotation_deg") + (-angle if over else angle)
    if axis is not None and angle and placed:
        aside = complex(*axis[:2]) * cmath.rect(1.0, math.radians(angle))
        found["axis"] = (aside.real, aside.imag, axis[2])
    if "offset" in keys and said("offset") is not None and angle and placed:
        x, y, z = said("offset")
        moved = complex(x, y) * cmath.rect(1.0, math.radians(angle))
        found["offset"] = (moved.real, moved.imag, z)
    return found


def drive_spec(table: object, instances: dict[str, InstanceSpec], source: str, place: str) -> DriveSpec:
    """One drive.

    Raises
    ------
    SceneError
        With the key, its value and what is allowed.
    """
    drive = converted(table, DriveSpec, source, place)
    check_instance(drive.instance, instances, source, f"{place}.instance")
    if drive.travel == 0:
        raise SceneError(source, f"{place}.travel", drive.travel, "travels_nowhere")
    if drive.turns == 0:
        raise SceneError(source, f"{place}.turns", drive.turns, "turns_nothing")
    return drive


def check_instance(name: str, instances: dict[str, InstanceSpec], source: str, place: str) -> None:
    """Refuse a name that is no instance, and say what its part stands as, if it is a part's."""
    if name in instances:
        return
    own = [key for key, spec in instances.items() if spec.part == name]
    if own:
        raise SceneError(source, place, name, "stands_as", Nearest(own[0], "meant"), known=own)
    if not instances:
        raise SceneError(source, place, name, "no_instances")
    raise SceneError(source, place, name, "no_such_instance", meant(name, instances), known=list(instances))
