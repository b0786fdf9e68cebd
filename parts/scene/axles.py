"""Holes that know an axle (``axis_of``): where they come when the instances of a scene stand."""

from __future__ import annotations

import cmath
from collections.abc import Mapping

from msgspec.structs import replace

from parts.base.part import Part
from parts.base.part_keys import MaterialKeys
from parts.base.refusal import REMOVED, SceneError
from parts.bodies.plate import FlatKeys
from parts.scene.instances import InstanceSpec, check_instance
from parts.scene.placing import Placing
from parts.scene.standing import UPWARDS

Parts = dict[str, Part]


def waits_for_axles(specs: Mapping[str, MaterialKeys], instances: dict[str, InstanceSpec], source: str) -> bool:
    """Whether a part has a hole for an axle.

    Raises
    ------
    SceneError
        A hole has a place and an axle, or neither; or that instance is not there.
    """
    found = False
    for part, keys in specs.items():
        for number, hole in enumerate(keys.holes if isinstance(keys, FlatKeys) else (), 1):
            place = f"parts.{part}.holes[{number}]"
            if hole.axis_of is None and hole.at is None:
                raise SceneError(source, f"{place}.at", None, "no_place_of_hole")
            if hole.axis_of is None:
                continue
            if hole.at is not None:
                told = {"one": "at", "other": "axis_of"}
                raise SceneError(source, f"{place}.axis_of", hole.axis_of, "either_key", REMOVED, **told)
            others = {key: spec for key, spec in instances.items() if spec.part != part}
            if hole.axis_of in instances and hole.axis_of not in others:
                raise SceneError(source, f"{place}.axis_of", hole.axis_of, "own_axis")
            check_instance(hole.axis_of, others, source, f"{place}.axis_of")
            found = True
    return found


def with_axle_holes(parts: Parts, placing: Placing, source: str) -> dict[str, MaterialKeys]:
    """The keys of all parts with a place for each hole of an axle, in the frame of the part's first instance.

    Raises
    ------
    SceneError
        One of both axes is not upright.
    """
    stand = {instance.id: instance for instance in placing.instances}
    made = {key: part.keys for key, part in parts.items()}
    for frame in reversed(placing.instances):
        keys = parts[frame.part].keys
        if not isinstance(keys, FlatKeys) or not any(hole.axis_of for hole in keys.holes):
            continue
        holes = list(keys.holes)
        for index, hole in enumerate(holes):
            if hole.axis_of is None:
                continue
            axle = stand[hole.axis_of]
            tilted = next((i for i in (axle, frame) if i.axis != UPWARDS), None)
            if tilted is not None:
                place = f"parts.{frame.part}.holes[{index + 1}].axis_of"
                raise SceneError(source, place, hole.axis_of, "axle_not_upright", instance=tilted.id)
            at = (axle.centre - frame.centre) * cmath.exp(-1j * frame.rotation)
            holes[index] = replace(hole, at=(at.real, at.imag))
        made[frame.part] = replace(keys, holes=holes)
    return made
