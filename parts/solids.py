"""The only builder of solids, mesh half: exact bodies become closed triangle meshes straight from numpy.

Every loop of a body is approximated once; the walls and caps that meet in it share its vertices, so the mesh is
closed by construction. parts/brep.py is the other half.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from geometry.approximate import approximate_profile, approximate_together
from geometry.body import Body
from geometry.contour import Approximation, Contour
from geometry.curve import Complex
from geometry.errors import ThinWallError
from parts.caps import Triangles, aligned_bore, begun_at, cap_triangles, is_round, start_in_space


@dataclass(frozen=True, slots=True)
class Mesh:
    """Vertices (n, 3) float, mm; triangles (k, 3) int, counter-clockwise seen from outside."""

    vertices: NDArray[np.float64]
    triangles: Triangles


def mesh_outlines(body: Body, tolerance: float, least_edge: float) -> tuple[Approximation, ...]:
    """Chords of every profile of a body within ``tolerance`` mm; edges below ``least_edge`` mm are merged.

    Profiles that a chamfer joins get matching vertices.
    """
    made: dict[int, Approximation] = {}
    for group in body.groups():
        profiles = [body.profiles[i] for i in group]
        if len(group) == 1:
            made[group[0]] = approximate_profile(profiles[0], tolerance, arcs=False, least_edge=least_edge)
        else:
            made |= dict(zip(group, approximate_together(profiles, tolerance, least_edge), strict=True))
    return tuple(made[i] for i in range(len(body.profiles)))


def body_mesh(body: Body, outlines: tuple[Approximation, ...]) -> Mesh:
    """The closed mesh of a body from the chords of its profiles.

    Raises
    ------
    ThinWallError
        The chords touch or cross at this tolerance.
    """
    contours = _begun_in_spaces(body, [a.geometry for a in outlines])
    try:
        caps = _cap_triangles(body, contours)
    except ThinWallError:
        contours = _with_aligned_bores(body, contours)
        caps = _cap_triangles(body, contours)
    return _assembled(body, contours, caps)


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


_Caps = dict[tuple[int, ...], tuple[Triangles, Complex]]


def _cap_triangles(body: Body, contours: list[Contour]) -> _Caps:
    """Triangles of every cap by its profiles; both faces of a plate share theirs."""
    keys = {tuple(body.loops[i].profile for i in (cap.outer, *cap.holes)) for cap in body.caps}
    return {key: cap_triangles(contours[key[0]], [contours[i] for i in key[1:]]) for key in sorted(keys)}


def _with_aligned_bores(body: Body, contours: list[Contour]) -> list[Contour]:
    """Round bores with corners behind every tooth, where chords of a thin rim have crossed."""
    alone = {group[0] for group in body.groups() if len(group) == 1}
    aligned = list(contours)
    for cap in body.caps:
        outer, *holes = (body.loops[i].profile for i in (cap.outer, *cap.holes))
        if len(holes) == 1 and holes[0] in alone and is_round(contours[holes[0]]) and contours[outer].count > 2:
            aligned[holes[0]] = aligned_bore(contours[outer], contours[holes[0]])
    return aligned


def _assembled(body: Body, contours: list[Contour], caps: _Caps) -> Mesh:
    plane = [c.expanded()[0] for c in contours]
    starts, pieces, place = [], [], 0
    for loop in body.loops:
        points = plane[loop.profile]
        starts.append(place)
        pieces.append(np.stack([points.real, points.imag, np.full(len(points), loop.z)], axis=1))
        place += len(points)
    triangles = []
    for wall in body.walls:
        triangles.append(
            _wall_triangles(len(plane[body.loops[wall.lower].profile]), starts[wall.lower], starts[wall.upper])
        )
    for cap in body.caps:
        loops = (cap.outer, *cap.holes)
        found, added = caps[tuple(body.loops[i].profile for i in loops)]
        index = [starts[i] + np.arange(len(plane[body.loops[i].profile])) for i in loops]
        index.append(place + np.arange(len(added)))
        pieces.append(np.stack([added.real, added.imag, np.full(len(added), body.loops[cap.outer].z)], axis=1))
        place += len(added)
        face = np.concatenate(index)[found]
        triangles.append(face if cap.up else face[:, ::-1])
    return Mesh(np.concatenate(pieces), np.concatenate(triangles))


def _wall_triangles(count: int, lower: int, upper: int) -> Triangles:
    """Two triangles an edge between loops whose vertices begin at two indices; material lies left of them."""
    here = np.arange(count)
    after = np.roll(here, -1)
    first = np.stack([lower + here, lower + after, upper + after], axis=1)
    second = np.stack([lower + here, upper + after, upper + here], axis=1)
    return np.concatenate([first, second])
