"""Mates of a scene before they are made: what they join, and their refusals in the keys of the scene."""

from __future__ import annotations

from typing import Any

from geometry.errors import ParameterError
from parts.kinds import KINDS
from parts.mates import GEAR_PAIRS, JOINS, mated
from parts.schema import SceneError


def pair_refused(
    scene: Any, refusal: ParameterError, pair: tuple[dict[str, Any], Any, dict[str, str]], source: str, place: str
) -> SceneError:
    """The refusal of a mate under the scene's key; of helical gears in normal terms, with a value that meshes.

    ``pair``: the gears by part, the mate, and the part of every instance.
    """
    gears, mate, part_of = pair
    owner, _, key = refusal.name.rpartition(".")
    if owner == "mate":
        return SceneError(source, f"{place}.{key}", refusal.value, refusal.allowed)
    from parts.helix_keys import helix_of, in_normal_terms

    blamed = _blamed(scene, mate, part_of)
    spec, error = scene.parts[blamed], refusal

    def meshes(changed: Any) -> bool:
        mated({**gears, blamed: KINDS[spec.__struct_config__.tag][1](changed)}, [mate], part_of)
        return True

    if helix_of(spec).angle:
        # the other gear's number in the text is one of its transverse section
        text = refusal.allowed.replace(" with the first gear's", ";", 1).replace(" with the pinion's", ";", 1)
        error = in_normal_terms(spec, ParameterError(refusal.name, refusal.value, text), meshes)
    return SceneError(source, f"{place}: parts.{blamed}.{error.name}", error.value, error.allowed)


def _blamed(scene: Any, mate: Any, part_of: dict[str, str]) -> str:
    """The part in whose keys a pair's refusals speak: the ring of an internal pair, else the second."""
    names = [part_of[mate.first], part_of[mate.second]]
    rings = [name for name in names if scene.parts[name].__struct_config__.tag == "ring_gear"]
    return rings[0] if rings else names[1]


def check_kinds(scene: Any, mate: Any, part_of: dict[str, str], source: str, place: str) -> None:
    """A mate joins the kinds of parts that it is for."""
    mate_kind = mate.__struct_config__.tag
    found = tuple(scene.parts[part_of[i]].__struct_config__.tag for i in (mate.first, mate.second))
    joins = JOINS[mate_kind]
    if joins is None or found in joins:
        return
    index = 0 if all(first != found[0] for first, _ in joins) else 1
    key = ("first", "second")[index]
    wanted = " or ".join(f"{a} and {b}" for a, b in joins)
    other = next((m for m, others in JOINS.items() if others and found in others), None)
    hint = f'; kind = "{other}" joins these two' if other else ""
    remedy = f"is a {found[index]}; {mate_kind} joins {wanted}{hint}"
    raise SceneError(source, f"{place}.{key}", getattr(mate, key), remedy)


def check_helices(scene: Any, mate: Any, part_of: dict[str, str], source: str, place: str) -> None:
    """Helices that mesh, and one normal module: told in the keys of the parts, before their transverse sections."""
    if not isinstance(mate, GEAR_PAIRS):
        return
    from parts.helix_keys import helix_of

    one, two = (scene.parts[part_of[i]] for i in (mate.first, mate.second))
    first, second = helix_of(one), helix_of(two)
    if first.angle == 0 and second.angle == 0:
        return
    from geometry.gears.helix import mesh_fault

    fault = mesh_fault(first, second, internal=mate.__struct_config__.tag == "internal_gear_pair")
    if fault is None and one.module != two.module:
        fault = "module", two.module, f"must be that of its mate; {one.module:.12g} works"
    if fault is None and first.double and one.face_width != two.face_width:
        # the points of both herringbones stand half way up
        fault = "face_width", two.face_width, f"must be that of its mate; {one.face_width:.12g} works"
    if fault is not None:
        key, value, remedy = fault
        raise SceneError(source, f"{place}: parts.{part_of[mate.second]}.{key}", value, remedy)
