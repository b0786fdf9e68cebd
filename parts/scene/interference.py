"""Who runs into whom as the scene stands: solids against solids, for what the exact plane contact does not decide.

Each solid is taken with its boundaries moved a little into the material and meshed within that, so that the mesh lies
inside the true solid: what overlaps then overlaps for certain. The booleans are those of manifold3d.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from contextlib import suppress
from itertools import combinations
from typing import Any

import numpy as np

from geometry.base.errors import GeometryError
from geometry.base.record import Record, made_once, replace
from geometry.curves.curve import Real
from geometry.solids.body import Body
from geometry.solids.faced import FacedBody
from parts.base.part import Part
from parts.scene.half_sections import Sections
from parts.scene.placing import Placing
from parts.scene.standing import UPWARDS, Instance
from parts.solids.mesh import Mesh, body_mesh, mesh_outlines

# boundaries go this far into the material, as a part of the solid's size, those of upright walls at most mm, and the
# mesh half of it
INSET, MOST_INSET = 2e-4, 1e-3
_SHARE = 0.5
# where a wall is thin they go in by less
_INSETS = (1.0, 1 / 4, 1 / 16, 1 / 64)
# planes about a vertex that turn by less, squared, are one
_FLAT = 1e-3
# of the lesser solid: less in common is rounding
SLIVER = 1e-9
# of places, mm, and turns: what rounding leaves is no difference
_DIGITS = 9


class SolidOverlap(Record):
    """Two instances whose solids have this volume (mm^3) in common, as they stand; None: a wall too thin to tell."""

    first: str
    second: str
    volume: float | None


def solid_overlaps(
    placing: Placing,
    parts: dict[str, Part],
    fits: list[tuple[Instance, Instance, float]] | None = None,
) -> tuple[SolidOverlap, ...]:
    """Every two instances that run into each other for certain; teeth of plates in a mate are left to their contact.

    ``fits`` takes what keeps pairs apart, mm, that half sections have decided.
    """
    contact, sections = by_contact(placing, parts), Sections(parts)
    boxes = {i.id: _box(i, parts[i.part]) for i in placing.instances}
    found = []
    # pairs that stand alike, as in a row, are held once
    held: dict[object, float | None] = {}
    for pair in combinations(placing.instances, 2):
        one, two = pair
        if frozenset((one.id, two.id)) in contact or not _meet(boxes[one.id], boxes[two.id]):
            continue
        volume: float | None
        if (fit := sections.between(one, two)) is not None:
            volume = fit.volume
            if fits is not None and volume == 0 and not fit.is_least:
                fits.append((one, two, fit.gap))
        else:
            key = _stand(one, two)
            if key not in held:
                held[key] = _common(pair, parts, sections)
            volume = held[key]
        if volume != 0:
            found.append(SolidOverlap(one.id, two.id, volume))
    return tuple(found)


def _common(pair: Sequence[Instance], parts: dict[str, Part], sections: Sections) -> float | None:
    """The volume that two solids have in common, mm^3; None: a wall too thin to tell."""
    try:
        # a thread is meshed only where its hull is not clear
        hulls = [sections.made(i.part).hull for i in pair]
        volume = common_volume(
            [placed_solid(i, h or inner_solid(parts[i.part])) for i, h in zip(pair, hulls, strict=True)]
        )
        if volume > 0 and any(hulls):
            volume = common_volume([placed_solid(i, inner_solid(parts[i.part])) for i in pair])
    except GeometryError:
        return None
    return volume


def _stand(one: Instance, two: Instance) -> object:
    """What is equal for pairs that stand alike: their parts, and where the second is seen from the first."""
    if one.axis != UPWARDS or two.axis != UPWARDS:
        return one.id, two.id
    away = (two.centre - one.centre) * cmath.rect(1.0, -one.rotation)
    turn = cmath.rect(1.0, two.rotation - one.rotation)
    numbers = (away.real, away.imag, two.at[2] - one.at[2], turn.real, turn.imag)
    return one.part, two.part, *(round(x, _DIGITS) + 0.0 for x in numbers)


def has_solid_pairs(placing: Placing, parts: dict[str, Part]) -> bool:
    """Whether there are pairs that are left to their solids."""
    count = len(placing.instances)
    return len(by_contact(placing, parts)) < count * (count - 1) // 2


def by_contact(placing: Placing, parts: dict[str, Part]) -> set[frozenset[str]]:
    """Pairs of plates that their mate holds against each other exactly."""
    return {
        frozenset((m.first.id, m.second.id))
        for m in placing.mates
        if m.mating.has_contact
        and (m.mating.decides_solids or (parts[m.first.part].is_plate and parts[m.second.part].is_plate))
    }


def _box(instance: Instance, part: Part) -> tuple[complex, float, float, float]:
    """Centre, reach, lower and upper end of an instance, mm."""
    body = part.blank(0.0)
    reach = body.section_reach()
    if instance.axis != UPWARDS:
        # a ball about it
        low, high = body.levels()[0], body.levels()[-1]
        x, y, z = (at + (low + high) / 2 * way for at, way in zip(instance.at, instance.axis, strict=True))
        far = math.hypot(reach, (high - low) / 2)
        return complex(x, y), far, z - far, z + far
    return instance.centre, reach, instance.at[2] + body.levels()[0], instance.at[2] + body.levels()[-1]


def _meet(one: tuple[complex, float, float, float], two: tuple[complex, float, float, float]) -> bool:
    near = abs(one[0] - two[0]) < one[1] + two[1]
    return near and min(one[3], two[3]) > max(one[2], two[2])


def placed_solid(instance: Instance, solid: Any) -> Any:
    """A solid in the place of an instance."""
    if instance.axis != UPWARDS:
        return solid.transform(instance.scene_from_part.matrix())
    x, y, z = instance.at
    turned = solid.rotate([0.0, 0.0, math.degrees(math.remainder(instance.rotation, 2 * math.pi))])
    return turned.translate([x, y, z])


def inner_solid(part: Part) -> Any:
    """A mesh inside the part's solid, as manifold3d has it; finer where its walls are thin."""
    return made_once(part, "inner_solid", lambda: _inner_solid(part))


def is_slabs(body: Body | FacedBody) -> bool:
    """Whether a body is upright slabs: no screws, chamfers or curved faces."""
    return not body.is_faced and all(body.is_upright(wall) for wall in body.walls)


def inset_of(reach: float, *, upright: bool) -> float:
    """How far boundaries of a solid that reaches so far from its axis go into it, mm.

    Of upright walls, whose outlines cost little, no farther where it is large: a pin too thick for a frame's hole is
    as much too thick in a longer frame.
    """
    return min(INSET * reach, MOST_INSET) if upright else INSET * reach


def _inner_solid(part: Part) -> Any:
    body = part.blank(0.0)
    inset = inset_of(body.section_reach(), upright=is_slabs(body))
    for share in () if isinstance(body, FacedBody) else _INSETS:
        with suppress(GeometryError):
            inner = part.blank(-share * inset)
            return meshed_solid(body_mesh(inner, mesh_outlines(inner, _SHARE * share * inset, 0.0)))
    # what is told by its faces, or has a land that no such boundary leaves
    mesh = body_mesh(body, mesh_outlines(body, _SHARE * inset, 0.0))
    return meshed_solid(replace(mesh, vertices=_moved_in(mesh, inset)))


def meshed_solid(mesh: Mesh) -> Any:
    """A closed mesh as manifold3d has it."""
    import manifold3d

    vertices, triangles = mesh.vertices.astype(np.float32), mesh.triangles.astype(np.uint32)
    return manifold3d.Manifold(manifold3d.Mesh(vertices, triangles))


def _moved_in(mesh: Mesh, inset: float) -> Real:
    """The vertices of a mesh moved into it, so that the planes about each go in by an inset (least squares)."""
    corners = mesh.vertices[mesh.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normals, axis=1)
    normals /= areas[:, None]
    spread, pull = np.zeros((len(mesh.vertices), 3, 3)), np.zeros((len(mesh.vertices), 3))
    for corner in mesh.triangles.T:
        np.add.at(spread, corner, areas[:, None, None] * normals[:, :, None] * normals[:, None])
        np.add.at(pull, corner, areas[:, None] * normals)
    return np.asarray(mesh.vertices - inset * np.einsum("nij,nj->ni", np.linalg.pinv(spread, _FLAT, True), pull))


def common_volume(pair: Sequence[Any]) -> float:
    """Volume in common, mm^3; slivers are none."""
    common = pair[0] ^ pair[1]
    least = SLIVER * min(solid.volume() for solid in pair)
    return float(common.volume()) if common.volume() > least else 0.0
