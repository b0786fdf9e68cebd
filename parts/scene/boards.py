"""What lies on the boards and beds of a scene: which parts, how many of each."""

from __future__ import annotations

from collections.abc import Mapping

from geometry.base.errors import Nearest
from parts.base.part import Part
from parts.base.refusal import SceneError
from parts.base.texts import Message, listed
from parts.keys.boards import BoardSpec, LaidKeys
from parts.scene.instances import InstanceSpec

# of all boards or beds of a table together, which take a minute to lay out
MOST_PIECES = 20_000
# parts are as thick as their board to this, mm
_SAME_THICKNESS = 1e-6


def pieces_of(
    spec: LaidKeys, parts: list[str], instances: Mapping[str, InstanceSpec], source: str, place: str
) -> dict[str, int]:
    """How many pieces of each of some parts lie on all boards together; those of which there are none are left out.

    Raises
    ------
    SceneError
        There is none of any, or there are too many.
    """
    found = {}
    for part in parts:
        own = [key for key, i in instances.items() if i.part == part]
        count = spec.copies.get(part)
        if count is None:
            count = sum(spec.copies.get(key, 1) for key in own)
        found[part] = spec.sets * count
    if (every := sum(found.values())) > MOST_PIECES:
        sets = Nearest(max(1, spec.sets * MOST_PIECES // every), "at_most")
        raise SceneError(source, f"{place}.sets", spec.sets, "too_many_pieces", sets, pieces=every, most=MOST_PIECES)
    if parts and not any(found.values()):
        raise SceneError(source, f"{place}.copies", spec.copies, "nothing_is_laid")
    return {part: count for part, count in found.items() if count}


def cut_from(spec: BoardSpec, key: str, part: Part) -> bool:
    """Whether a board is what a part is cut from: it names the part, or the part is flat, as thick, and not bought."""
    if spec.parts is not None:
        return key in spec.parts
    return part.is_plate and not part.is_bought and abs(part.face_width - spec.thickness) <= _SAME_THICKNESS


def parts_of_board(spec: BoardSpec, parts: Mapping[str, Part], source: str, place: str) -> list[str]:
    """The parts that are cut from a board: those that it names, or all flat ones of its thickness.

    Raises
    ------
    SceneError
        There is none, or one that it names is not as thick.
    """
    for part in spec.parts or ():
        if abs(parts[part].face_width - spec.thickness) > _SAME_THICKNESS:
            raise SceneError(
                source, f"{place}.thickness", spec.thickness, "part_not_so_thick", None, "mm",
                part=part, thickness=parts[part].face_width,
            )  # fmt: skip
    if spec.parts is not None:
        return spec.parts
    found = [key for key, part in parts.items() if cut_from(spec, key, part)]
    if not found:
        flat = {k: p.face_width for k, p in parts.items() if p.is_plate and p.stock is None}
        if not flat:
            raise SceneError(source, f"{place}.thickness", spec.thickness, "no_flat_part")
        told = [Message("{part} ({width})", {"part": k, "width": f"{w:g}"}) for k, w in flat.items()]
        nearest = Nearest(min(flat.values(), key=lambda width: abs(width - spec.thickness)))
        raise SceneError(
            source, f"{place}.thickness", spec.thickness, "no_part_so_thick", nearest, "mm", found=listed(told)
        )
    return found
