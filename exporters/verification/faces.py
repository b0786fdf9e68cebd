"""Solids told by their faces, like cylindrical cams: every triangle of a mesh, and every face and edge that the kernel
evaluates, lies in one of the exact faces; closed, and the volume right.

A face says how far points lie from its surface; that of a wall goes by the roller's way, and not by how it was made.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from exporters.formats.read_solid import EXTRUSION, ROUND, SPLINE
from exporters.formats.read_step import ReadSolid
from exporters.formats.readback import ReadMesh
from exporters.verification.samples import edge_points, inner_points
from exporters.verification.topology import doubled_normals, topology_failures
from exporters.verification.verdict import Verdict, deviation_failures, volume_bound, volume_failures

if TYPE_CHECKING:
    from geometry.solids.measured import Faced

# places of the samples in each triangle, in sixths
_PLACES = [(a, b, 6 - a - b) for a in range(7) for b in range(7 - a)]
SHARES = np.array(_PLACES, dtype=float) / 6


def verify_faced_mesh(mesh: ReadMesh, body: Faced, declared: float, tolerance: float) -> Verdict:
    """Hold a mesh against its exact solid."""
    count = {"triangles": float(len(mesh.triangles))}
    failures = topology_failures(mesh)
    if failures:
        return Verdict(count, tuple(failures))
    corners = mesh.faces()
    doubled = doubled_normals(corners)
    sizes = np.linalg.norm(doubled, axis=1)
    volume = float(np.einsum("ij,ij->i", corners[:, 0], doubled).sum() / 6)
    deviation, lone = mesh_deviation(mesh, body)
    exact = body.moments.volume
    reach = body.reach()
    failures += deviation_failures(deviation, declared, tolerance, reach)
    if lone:
        failures.append(f"{lone} faces of the part have no triangle")
    if not abs(volume - exact) <= declared * float(sizes.sum()) / 2 + 1e-9 * exact:
        failures.append(f"volume {volume:.9g} mm^3 instead of {exact:.9g} mm^3")
    edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    measured = count | {
        "volume": volume,
        "volume_error": volume / exact - 1,
        "max_deviation": deviation,
        "shortest_edge": float(edges.min()),
        "least_triangle_area": float(sizes.min() / 2),
    }
    return Verdict(measured, tuple(failures))


def mesh_deviation(mesh: ReadMesh, body: Faced) -> tuple[float, int]:
    """Greatest distance of samples of the triangles from the face that each lies in, mm, and faces without any."""
    faces = body.surfaces
    at_corners = np.stack([face.distance(mesh.vertices) for face in faces])
    # the face in whose surface all three corners lie best; where several do, the samples decide
    worst = at_corners[:, mesh.triangles].max(axis=2)
    near = worst <= 2 * worst.min(axis=0) + 1e-5 * body.reach()
    found = np.full(len(mesh.triangles), np.inf)
    owner = np.full(len(mesh.triangles), -1)
    for index, face in enumerate(faces):
        mine = np.flatnonzero(near[index])
        samples = np.einsum("sk,nkc->nsc", SHARES, mesh.vertices[mesh.triangles[mine]])
        here = face.distance(samples.reshape(-1, 3)).reshape(samples.shape[:2]).max(axis=1)
        better = here < found[mine]
        found[mine[better]] = here[better]
        owner[mine[better]] = index
    return float(found.max()), sum(not np.any(owner == i) for i in range(len(faces)))


def verify_faced_solid(found: ReadSolid, body: Faced, declared: float, tolerance: float) -> Verdict:
    """Hold a re-read solid against its exact one: faces, edges, ends, volume."""
    model, surfaces = found.model, body.surfaces
    used: set[int] = set()
    worst = 0.0
    for face in range(len(model.faces)):
        own = np.array([face])
        points = np.concatenate([edge_points(model, own), inner_points(model, own)])
        away = [float(surface.distance(points).max()) for surface in surfaces]
        best = int(np.argmin(away))
        used.add(best)
        worst = max(worst, away[best])
    failures = [f"a {surface.what} of the part is missing" for i, surface in enumerate(surfaces) if i not in used]
    failures += deviation_failures(worst, declared, tolerance, body.reach())
    volume, exact = float(model.flux.sum()), body.moments.volume
    walls = float(model.area[np.isin(model.kind, (EXTRUSION, SPLINE))].sum())
    bound = volume_bound(exact, float(model.area.sum()), walls + body.slack, declared)
    failures += volume_failures(volume, exact, bound, found.said.get("volume"))
    measured = {
        "volume": volume,
        "volume_error": volume / exact - 1,
        "volume_bound": bound / exact,
        "cylinders": float(np.count_nonzero((model.kind == ROUND) & (model.sizes[:, 1] == 0))),
        "max_deviation": worst,
    }
    return Verdict(measured, tuple(dict.fromkeys(failures)))
