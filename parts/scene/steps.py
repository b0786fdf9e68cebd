"""Tables ``[[steps]]``: the order of assembly, and the straight way on which each part comes to its place.

What a step brings comes with all that earlier steps have joined to it, and is joined to what stands about ``to``.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta, Struct
from msgspec.structs import replace

from geometry.base.record import Record
from parts.base.refusal import REMOVED, SceneError
from parts.base.schema import converted
from parts.keys.base import mm
from parts.scene.instances import Group, InstanceSpec, check_instance

if TYPE_CHECKING:
    from parts.base.mate import MateKeys

_BRING = Meta(
    min_length=1,
    description="instances or groups that come in, with all that earlier steps have joined to them",
    examples=[["wheel"]],
)
_ALONG = Meta(
    min_length=3,
    max_length=3,
    description="direction [x, y, z] in which they come from outside; default: each straight to the axis of `to`",
    examples=[[0.0, 0.0, -1.0]],
)
_OUTWARDS = mm(
    "then each moves by this away from the axis of `to`, below 0 towards it", least=-1e6, most=1e6, example=8.0
)
_ONE_HOLE = Meta(
    description=("`to` is turned on for each: all go in where the first does, like a row of balls through one hole")
)
_SCREWED = Meta(description="turned in along its thread or helical teeth: a worm past its wheel")
_OPENED = mm(
    "for turned parts like a snap ring: by how much its radius is opened on the way", above=0, most=1e3, example=1.5
)


class StepSpec(Struct, forbid_unknown_fields=True):
    """Keys of ``[[steps]]``."""

    bring: Annotated[list[str], _BRING]
    to: Annotated[str, Meta(description="an instance of what they are joined to", examples=["frame"])]
    along: Annotated[list[Annotated[float, Meta(ge=-1e6, le=1e6)]], _ALONG] | None = None
    outwards: Annotated[float, _OUTWARDS] | None = None
    one_hole: Annotated[bool, _ONE_HOLE] = False
    screwed: Annotated[bool, _SCREWED] = False
    opened: Annotated[float, _OPENED] | None = None

    @property
    def one_by_one(self) -> bool:
        """Whether each has a way of its own."""
        return self.along is None or self.outwards is not None


class Stage(Record):
    """A step, what it moves (instances), and what stands where it is joined to."""

    step: StepSpec
    moved: tuple[str, ...]
    standing: tuple[str, ...]


def step_specs(
    raw: Sequence[object], parts: Mapping[str, Struct], instances: dict[str, InstanceSpec],
    groups: Mapping[str, Group], mates: Sequence[MateKeys], source: str,
) -> list[StepSpec]:  # fmt: skip
    """The steps of a scene, their groups told out; two models that no mate joins are put together each by itself.

    Raises
    ------
    SceneError
        With the key, its value and what is allowed; something is brought to itself, or never.
    """
    found: list[StepSpec] = []
    kinds = {key: part.__struct_config__.tag for key, part in parts.items()}
    for number, table in enumerate(raw, 1):
        place = f"steps[{number}]"
        spec = converted(table, StepSpec, source, place)
        if spec.along is not None and not any(spec.along):
            raise SceneError(source, f"{place}.along", spec.along, "no_direction")
        if spec.outwards is not None and spec.along is None:
            raise SceneError(source, f"{place}.outwards", spec.outwards, "outwards_after_along", REMOVED)
        if spec.outwards == 0:
            raise SceneError(source, f"{place}.outwards", spec.outwards, "nowhere_outwards", REMOVED)
        if spec.one_hole and spec.outwards is None:
            raise SceneError(source, f"{place}.one_hole", spec.one_hole, "hole_for_one_by_one", REMOVED)
        brought = [one for name in spec.bring for one in (groups[name].members if name in groups else (name,))]
        for name in brought:
            check_instance(name, instances, source, f"{place}.bring")
        check_instance(spec.to, instances, source, f"{place}.to")
        if spec.opened is not None and any(kinds[str(instances[name].part)] != "turned" for name in brought):
            raise SceneError(source, f"{place}.opened", spec.opened, "opened_turned", REMOVED)
        found.append(replace(spec, bring=brought))
    if not found:
        return found
    whole = {key: {key} for key in instances}
    for number, stage in enumerate(stages(found, instances), 1):
        if stage.step.to in stage.moved:
            told = {"to": stage.step.to}
            raise SceneError(source, f"steps[{number}].bring", stage.step.bring, "joined_before", None, "", **told)
        whole |= dict.fromkeys((together := {*stage.moved, *stage.standing}), together)
    left = [key for key, one in whole.items() if len(one) == 1]
    if left or any(mate.second not in whole[mate.first] for mate in mates):
        left = left or [key for key in instances if key not in together]
        raise SceneError(source, "steps", len(found), "never_brought", None, "", left=left[:10])
    return found


def stages(steps: Iterable[StepSpec], instances: Iterable[str]) -> Iterator[Stage]:
    """What each step moves, and what stands there by then."""
    joined: dict[str, tuple[str, ...]] = {key: (key,) for key in instances}
    for step in steps:
        moved = tuple(dict.fromkeys(one for key in step.bring for one in joined[key]))
        standing = tuple(key for key in joined[step.to] if key not in moved)
        yield Stage(step, moved, standing if step.to not in moved else ())
        joined |= dict.fromkeys((*standing, *moved), (*standing, *moved))
