"""The only builder of solids, mesh half: exact bodies become closed triangle meshes straight from numpy.

Every loop of a body is approximated once; the walls and caps that meet in it share its vertices, so the mesh is
closed by construction. parts/solids/faces.py is the other half.
"""

from __future__ import annotations

from collections.abc import Container
from typing import TYPE_CHECKING, cast

import numpy as np

from geometry.approximation.chords import approximate_profile, approximate_together
from geometry.base.errors import ThinWallError
from geometry.base.record import Record, replace
from geometry.curves.bounds import Bound
from geometry.curves.curve import Complex, Flags, Real
from geometry.plane.contour import Approximation, Contour
from geometry.solids.body import Body, Cap
from geometry.solids.chamfer import chamfer_bow, cut_chamfers, level_pieces
from parts.solids.caps import (
    Triangles,
    aligned_bore,
    begun_at,
    cap_triangles,
    grid_decimals,
    is_round,
    start_in_space,
)

if TYPE_CHECKING:
    from geometry.solids.faced import FacedBody
    from parts.solids.face_mesh import FaceMesh

# of the tolerance of a screw surface that has a chamfer, what its chords may take
_TURNED_SHARE = 0.4


class Mesh(Record):
    """Vertices (n, 3) float, mm; triangles (k, 3) int, counter-clockwise seen from outside."""

    vertices: Real
    triangles: Triangles


def mesh_outlines(body: Body | FacedBody, tolerance: float, least_edge: float) -> tuple[Approximation, ...]:
    """Chords of every profile of a body within ``tolerance`` mm; edges below ``least_edge`` mm are merged.

    Profiles that a chamfer joins get matching vertices. The mesh of a body told by its faces is made whole.
    """
    if body.is_faced:
        from parts.solids.face_mesh import faced_mesh

        return cast("tuple[Approximation, ...]", (faced_mesh(body, tolerance),))
    body = _sliced(body, tolerance)
    made: dict[int, Approximation] = {}
    twisted = body.twisted_profiles()
    for group in body.groups():
        profiles = [body.profiles[i] for i in group]
        if len(group) > 1:
            made |= dict(zip(group, _chamfered(body, group, tolerance, least_edge, twisted), strict=True))
        elif group[0] in twisted:
            from geometry.approximation.twisted import approximate_twisted

            made[group[0]] = approximate_twisted(profiles[0], tolerance, least_edge)
        else:
            made[group[0]] = approximate_profile(profiles[0], tolerance, arcs=False, least_edge=least_edge)
    return tuple(made[i] for i in range(len(body.profiles)))


def _sliced(body: Body, tolerance: float) -> Body:
    """The body with its chamfers cut into slices that plane triangles follow, level ones where they are as deep."""
    return cut_chamfers(body, level_pieces(body, tolerance))


def _chamfered(
    body: Body, group: tuple[int, ...], tolerance: float, least_edge: float, twisted: Container[int]
) -> tuple[Approximation, ...]:
    """Matching chords of profiles that chamfers join; the bound holds for what lies between them too.

    Those of screw surfaces leave a share of the tolerance to the slices of these.
    """
    profiles = [body.profiles[i] for i in group]
    chamfers = [chamfer for chamfer in body.chamfers() if body.loops[chamfer[1]].profile in group]
    bow = chamfer_bow(body, chamfers)
    walls = {(group.index(body.loops[a].profile), group.index(body.loops[b].profile)) for _, a, b in chamfers}
    turned = any(i in twisted for i in group)
    made = approximate_together(profiles, walls, (_TURNED_SHARE if turned else 1.0) * tolerance - bow, least_edge)
    bound: Bound = "sampled" if bow > 0 else made[0].bound
    found = [replace(a, max_error=a.max_error + bow, bound=bound, tolerance=tolerance) for a in made]
    for k, index in enumerate(group):
        if index in twisted:
            from geometry.approximation.twisted import slices_over

            found[k] = replace(slices_over(found[k].geometry, found[k].max_error, tolerance), bound=bound)
    return tuple(found)


def count_edges(body: Body | FacedBody, outlines: tuple[Approximation, ...]) -> int:
    """How many edges the slices of a mesh have in all: what its size goes by."""
    total = sum(len(a.geometry) for a in outlines)
    if body.is_faced:
        return total
    body = _sliced(body, outlines[0].tolerance)
    for wall in filter(body.twist, body.walls):
        from geometry.approximation.twisted import slice_turns

        own = outlines[body.loops[wall.lower].profile]
        total += len(own.geometry) * (len(slice_turns(body.twist(wall), own.turn_step)) - 2)
    return total


def body_mesh(body: Body | FacedBody, outlines: tuple[Approximation, ...]) -> Mesh:
    """The closed mesh of a body from the chords of its profiles.

    Raises
    ------
    ThinWallError
        The chords touch or cross at this tolerance.
    """
    if body.is_faced:
        made = cast("FaceMesh", outlines[0])
        return _whole(np.round(made.vertices, grid_decimals(body.section_reach())) + 0.0, made.geometry)
    body, decimals = _sliced(body, outlines[0].tolerance), grid_decimals(body.section_reach())
    # on a grid before any triangle is chosen: what machines round differently chooses none
    contours = _begun_in_spaces(body, [replace(a.geometry, decimals=decimals) for a in outlines])
    try:
        caps = _cap_triangles(body, contours)
    except ThinWallError:
        contours = _with_aligned_bores(body, contours)
        caps = _cap_triangles(body, contours)
    return _assembled(body, contours, [a.turn_step for a in outlines], caps)


def _whole(vertices: Real, triangles: Triangles) -> Mesh:
    """The mesh without what a file rounds to nothing: vertices that are one there, and triangles between them."""
    held = vertices.astype(np.float32)
    corners = held[triangles]
    flat = np.zeros(len(triangles), dtype=bool)
    for k in range(3):
        flat |= np.all(corners[:, k] == corners[:, k - 1], axis=1)
    if not flat.any():
        return Mesh(vertices, triangles)
    pairs = np.unique(triangles[flat])
    _, first, same = np.unique(held[pairs], axis=0, return_index=True, return_inverse=True)
    number = np.arange(len(vertices))
    number[pairs] = pairs[first[same.ravel()]]
    used, numbered = np.unique(number[triangles[~flat]], return_inverse=True)
    return Mesh(vertices[used], numbered.reshape(-1, 3))


def _begun_in_spaces(body: Body, contours: list[Contour]) -> list[Contour]:
    """Toothed contours begun where a tooth leaves the root circle; joined ones at the same vertex."""
    begun = list(contours)
    for group in body.groups():
        leader = contours[group[0]]
        if leader.count > 2 and not is_round(leader):
            index = start_in_space(leader)
            for i in group:
                begun[i] = begun_at(contours[i], index)
    return begun


_Key = tuple[tuple[int, float, complex], ...]
_Caps = dict[_Key, tuple[Triangles, Complex]]


def _cap_key(body: Body, cap: Cap) -> _Key:
    """The profiles of a cap's loops with their turns and shifts, the latter from that of the outer one."""
    loops = [body.loops[i] for i in (cap.outer, *cap.holes)]
    return tuple((loop.profile, loop.turn, loop.shift - loops[0].shift) for loop in loops)


def _cap_triangles(body: Body, contours: list[Contour]) -> _Caps:
    """Triangles of every cap by its profiles and turns; both faces of a plate share theirs."""
    keys = {_cap_key(body, cap) for cap in body.caps}
    made = {}
    for key in sorted(keys, key=lambda k: [(p, t, s.real, s.imag) for p, t, s in k]):
        outer, *holes = (_moved(contours[profile], turn, shift) for profile, turn, shift in key)
        made[key] = cap_triangles(outer, holes)
    return made


def _moved(contour: Contour, turn: float, shift: complex) -> Contour:
    if turn == 0 and shift == 0:
        return contour
    return replace(contour, vertices=contour.vertices * np.exp(1j * turn) + shift)


def _with_aligned_bores(body: Body, contours: list[Contour]) -> list[Contour]:
    """Round bores with corners behind every tooth, where chords of a thin rim have crossed."""
    alone = {group[0] for group in body.groups() if len(group) == 1}
    aligned = list(contours)
    for cap in body.caps:
        outer, *holes = (body.loops[i].profile for i in (cap.outer, *cap.holes))
        if len(holes) == 1 and holes[0] in alone and is_round(contours[holes[0]]) and contours[outer].count > 2:
            aligned[holes[0]] = aligned_bore(contours[outer], contours[holes[0]])
    return aligned


def _assembled(body: Body, contours: list[Contour], steps: list[float], caps: _Caps) -> Mesh:
    plane = [c.expanded()[0] for c in contours]
    starts, pieces, place = [], [], 0

    def added(points: Complex, z: float) -> int:
        """Puts points at a height; the number of the first one."""
        nonlocal place
        pieces.append(np.stack([points.real, points.imag, np.full(len(points), z)], axis=1))
        place += len(points)
        return place - len(points)

    for loop in body.loops:
        turn = np.exp(1j * loop.turn) if loop.turn else 1.0
        starts.append(added(plane[loop.profile] * turn + loop.shift, loop.z))
    triangles = []
    for wall in body.walls:
        loop = body.loops[wall.lower]
        points, (low, high), twist = plane[loop.profile], body.height(wall), body.twist(wall)
        turns, rising, below = np.zeros(2), None, starts[wall.lower]
        if twist:
            from geometry.approximation.twisted import rising_diagonals, slice_turns

            turns = slice_turns(twist, steps[loop.profile])
            contour = contours[loop.profile]
            rising = np.tile(rising_diagonals(contour, float(turns[1])), contour.count)
        for k, turn in enumerate(turns[1:-1].tolist(), 1):
            here = added(points * np.exp(1j * (loop.turn + turn)), low + (high - low) * k / (len(turns) - 1))
            triangles.append(_wall_triangles(len(points), below, here, rising))
            below = here
        triangles.append(_wall_triangles(len(points), below, starts[wall.upper], rising))
    for cap in body.caps:
        loops = (cap.outer, *cap.holes)
        found, middle = caps[_cap_key(body, cap)]
        index = [starts[i] + np.arange(len(plane[body.loops[i].profile])) for i in loops]
        index.append(added(middle + body.loops[cap.outer].shift, body.loops[cap.outer].z) + np.arange(len(middle)))
        face = np.concatenate(index)[found]
        triangles.append(face if cap.up else face[:, ::-1])
    vertices = np.concatenate(pieces)
    # heights on a grid of their own: that of a wide thin plate is too coarse for what a float32 holds of its thickness
    for axes, reach in ((slice(2), body.section_reach()), (2, float(np.abs(vertices[:, 2]).max()))):
        vertices[:, axes] = np.round(vertices[:, axes], grid_decimals(reach)) + 0.0
    return Mesh(vertices, np.concatenate(triangles))


def _wall_triangles(count: int, lower: int, upper: int, rising: Flags | None = None) -> Triangles:
    """Two triangles an edge between loops whose vertices begin at two indices; material lies left of them.

    ``rising`` (count,): which edges take the diagonal from their lower start to their upper end; all without it.
    """
    here = np.arange(count)
    after = np.roll(here, -1)
    first = np.stack([lower + here, lower + after, upper + after], axis=1)
    second = np.stack([lower + here, upper + after, upper + here], axis=1)
    if rising is not None:
        first[~rising, 2] = (upper + here)[~rising]
        second[~rising, 0] = (lower + after)[~rising]
    return np.concatenate([first, second])
