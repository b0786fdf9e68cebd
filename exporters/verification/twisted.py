"""Screw surfaces and sheared walls in meshes: every slice and what lies between the slices, held against them.

A point is turned and moved back by what the wall has turned and moved at the point's own height, and measured against
the exact section: its distance within the plane of its height, which is never less than that from the surface.
"""

from __future__ import annotations

import numpy as np

from exporters.formats.readback import ReadMesh
from exporters.verification.topology import AT_ONCE, Triangles, chains, edge_lengths, of_each
from exporters.verification.verdict import Verdict, deviation_failures
from geometry.plane.measure import distance_to_profile, profile_area, profile_length
from geometry.solids.body import Body, Wall
from parts.base.texts import N_, fault, unless

# places of a triangle that are measured beside its corners: the middles of its edges, its centre, and between them
_PLACES = np.array([(1, 1, 0), (0, 1, 1), (1, 0, 1), (1, 1, 1), (4, 1, 1), (1, 4, 1), (1, 1, 4)], dtype=float)
# meshes of more triangles are measured at fewer places of each
_MANY = 60_000


def verify_twisted(
    mesh: ReadMesh, triangles: Triangles, body: Body, wall: Wall, declared: float, tolerance: float
) -> Verdict:
    """Hold the triangles of one screw surface against it.

    Each triangle spans two neighbouring slices, each slice is one closed outline of the right area, and corners,
    edges and faces lie within the declared error.
    """
    if not len(triangles):
        return Verdict({"max_deviation": np.inf, "shortest_edge": np.inf}, (fault("a screw surface is missing"),))
    profile, z = body.loop_profile(wall.lower), mesh.vertices[:, 2]
    used = np.zeros(len(z), dtype=bool)
    used[triangles] = True
    levels, level_of = np.unique(z[used], return_inverse=True)
    index = level_of[np.cumsum(used)[triangles] - 1]
    runs = not np.any(np.ptp(index, axis=1) != 1) and (levels[0], levels[-1]) == body.height(wall)
    failures = unless(runs, "a screw surface does not run from slice to slice between its ends")
    area, length = abs(profile_area(profile)), profile_length(profile)
    order = np.argsort(index.min(axis=1), kind="stable")
    starts = np.searchsorted(index.min(axis=1)[order], np.arange(len(levels)))
    for number, level in enumerate(levels.tolist()):
        # the triangles above a slice, below the last one
        layer = min(number, len(levels) - 2)
        mine = triangles[order[starts[layer] : starts[layer + 1]]]
        loops = chains(mine, z, level)
        outline = body.moved_back(wall, mesh.vertices[loops[0]])
        found = 0.5 * abs(float(np.sum((np.conj(outline) * np.roll(outline, -1)).imag)))
        told = N_("the slice at z = {level:.6g} mm has {count} outlines")
        failures += unless(len(loops) == 1, told, level=level, count=len(loops))
        near = len(loops) > 1 or not abs(found - area) > declared * length + 1e-12 * area
        told = N_("the slice at z = {level:.6g} mm encloses {found:.9g} mm^2 instead of {area:.9g} mm^2")
        failures += unless(near, told, level=level, found=found, area=area)
    places = _PLACES if len(triangles) < _MANY else _PLACES[3:4]
    shares = places / places.sum(axis=1, keepdims=True)
    inside = of_each(lambda corners: np.einsum("pk,nkc->npc", shares, corners).reshape(-1, 3), mesh, triangles)
    points = np.concatenate([mesh.vertices[used], inside])
    blocks = (body.moved_back(wall, points[k : k + AT_ONCE]) for k in range(0, len(points), AT_ONCE))
    deviation = float(np.max([distance_to_profile(block, profile, trusted=declared).max() for block in blocks]))
    failures += deviation_failures(deviation, declared, tolerance, profile.reach())
    shortest = float(of_each(edge_lengths, mesh, triangles).min())
    return Verdict({"max_deviation": deviation, "shortest_edge": shortest}, tuple(failures))
