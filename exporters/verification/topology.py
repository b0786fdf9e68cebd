"""How the triangles of a mesh hang together: closed and manifold, the borders of some of them, their normals."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from exporters.formats.readback import ReadMesh, closed_chains
from geometry.curves.curve import Flags, Real
from parts.base.readback import refuse_if
from parts.base.texts import fault

Triangles = NDArray[np.int64]


def doubled_normals(corners: Real) -> Real:
    """Twice the area of each triangle along its normal, (n, 3)."""
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


def edge_lengths(corners: Real) -> Real:
    """Of each triangle, (n, 3)."""
    return np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)


def topology_failures(mesh: ReadMesh) -> list[str]:
    """Watertight, manifold, consistently turned, no triangle without area."""
    t = mesh.triangles
    if np.any((t[:, 0] == t[:, 1]) | (t[:, 1] == t[:, 2]) | (t[:, 2] == t[:, 0])):
        return [fault("a triangle has two equal corners")]
    doubled = np.linalg.norm(doubled_normals(mesh.faces()), axis=1)
    if not np.all(doubled > 0):
        return [fault("a triangle has no area")]
    n = len(mesh.vertices)
    edges = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]]).astype(np.int64)
    forward, backward = np.sort(edges[:, 0] * n + edges[:, 1]), np.sort(edges[:, 1] * n + edges[:, 0])
    if np.any(forward[1:] == forward[:-1]):
        return [fault("two triangles run along one edge the same way")]
    if not np.array_equal(forward, backward):
        return [fault("the mesh is not closed: an edge has a triangle on one side only")]
    return []


def chains(triangles: Triangles, on_level: Flags, count: int) -> list[list[int]]:
    """Closed chains of the triangles' edges that lie on a level, as vertex numbers."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    edges = edges[on_level[edges].all(axis=1)]
    refuse_if(not len(edges), "a wall has no edge at one of its ends")
    refuse_if(np.bincount(edges[:, 0], minlength=count).max() > 1, "an outline touches itself in a point")
    return closed_chains(dict(zip(edges[:, 0].tolist(), edges[:, 1].tolist(), strict=True)))
