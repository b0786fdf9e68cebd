"""Chamfers in files: points against the exact sections at their own heights.

A point's distance is taken within the plane of its height, which is never less than that from the surface.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from exporters.formats.readback import ReadMesh
from exporters.verification.topology import Triangles
from geometry.plane.measure import distance_to_nearest
from geometry.solids.body import Body

Points = NDArray[np.float64]

# heights of samples that differ by rounding, a thousandth of what STEP files keep, have one section; so far beyond a
# chamfer they are its own, mm
_LEVEL_DIGITS, _BEYOND = 9, 1e-7
# heights between two slices of a mesh, and places across each triangle there, that are measured
_UP, _ACROSS = (0.25, 0.5, 0.75), (0.0, 0.5)


def chamfer_distances(points: Points, body: Body, declared: float) -> Points:
    """Distances (n,) of points (n, 3) from the chamfers of a body, each within the plane of its height, mm.

    Infinite where a point stands at no height of a chamfer.
    """
    heights = np.round(points[:, 2], _LEVEL_DIGITS)
    best = np.full(len(points), np.inf)
    places = points[:, 0] + 1j * points[:, 1]
    walls = [wall for wall in body.walls if body.is_chamfer(wall)]
    for z in np.unique(heights).tolist():
        mine = np.flatnonzero(heights == z)
        sections = []
        for wall in walls:
            low, high = body.height(wall)
            if low - _BEYOND <= z <= high + _BEYOND:
                sections.append(body.standing(wall, float(np.clip(z, low, high))))
        if sections:
            best[mine] = distance_to_nearest(places[mine], sections, declared)
    return best


def slice_points(mesh: ReadMesh, triangles: Triangles) -> Points:
    """Points (n, 3) within triangles between slices, at a few heights each."""
    corners = mesh.vertices[triangles]
    heights = corners[:, :, 2]
    # the corner that stands alone on its slice, and the two others
    alone = np.argmax(np.abs(heights - np.median(heights, axis=1, keepdims=True)), axis=1)
    order = (alone[:, None] + np.arange(3)) % 3
    tip, first, second = np.moveaxis(np.take_along_axis(corners, order[:, :, None], axis=1), 1, 0)
    low, high = heights.min(axis=1), heights.max(axis=1)
    found = []
    for up in _UP:
        z = low + up * (high - low)
        share = ((z - tip[:, 2]) / (first[:, 2] - tip[:, 2]))[:, None]
        for across in _ACROSS:
            points = tip + share * ((1 - across) * first + across * second - tip)
            points[:, 2] = z
            found.append(points)
    return np.concatenate(found)
