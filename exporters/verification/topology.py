"""How the triangles of a mesh hang together: closed and manifold, the borders of some of them, their normals."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from exporters.formats.readback import ReadMesh, closed_chains
from geometry.base.distinct import distinct
from geometry.curves.curve import Real
from parts.base.readback import refuse_if
from parts.base.texts import fault

Triangles = NDArray[np.int64]
# triangles whose corners are looked at together: all of a large mesh would fill the memory
AT_ONCE = 1 << 15


def of_each(measure: Callable[[Real], Real], mesh: ReadMesh, triangles: Triangles) -> Real:
    """What is measured on the corners (n, 3, 3) of triangles, (n, ...)."""
    blocks = (triangles[k : k + AT_ONCE] for k in range(0, len(triangles), AT_ONCE))
    return np.concatenate([measure(mesh.vertices[block]) for block in blocks])


def areas(mesh: ReadMesh) -> Real:
    """Of each triangle, mm^2, (n,)."""
    return of_each(lambda corners: np.linalg.norm(doubled_normals(corners), axis=1) / 2, mesh, mesh.triangles)


def volume_in(mesh: ReadMesh) -> float:
    """The volume within a closed mesh, mm^3."""
    under = of_each(lambda at: np.einsum("ij,ij->i", at[:, 0], doubled_normals(at)), mesh, mesh.triangles)
    return float(under.sum() / 6)


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
    if not np.all(areas(mesh) > 0):
        return [fault("a triangle has no area")]
    n = len(mesh.vertices)
    forward, backward = (np.sort(np.concatenate([t[:, k] * n + t[:, k - way] for k in range(3)])) for way in (2, 1))
    if np.any(forward[1:] == forward[:-1]):
        return [fault("two triangles run along one edge the same way")]
    if not np.array_equal(forward, backward):
        return [fault("the mesh is not closed: an edge has a triangle on one side only")]
    return []


def chains(triangles: Triangles, z: Real, level: float) -> list[list[int]]:
    """Closed chains of the triangles' edges that lie on a level, as vertex numbers; ``z`` of the vertices, mm."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    edges = edges[(z[edges] == level).all(axis=1)]
    refuse_if(not len(edges), "a wall has no edge at one of its ends")
    refuse_if(len(distinct(edges[:, 0])) < len(edges), "an outline touches itself in a point")
    return closed_chains(dict(zip(edges[:, 0].tolist(), edges[:, 1].tolist(), strict=True)))


def pieces(triangles: Triangles) -> Triangles:
    """A number for each triangle, the same for those that hang together by their corners, (n,)."""
    used, corners = np.unique(triangles, return_inverse=True)
    corners = corners.reshape(-1, 3)
    number = np.arange(len(used))
    while np.any(np.ptp(number[corners], axis=1)):
        np.minimum.at(number, corners, number[corners].min(axis=1, keepdims=True))
        number = number[number]
    return number[corners[:, 0]]
