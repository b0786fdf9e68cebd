"""Cylindrical cams read back: every triangle of a mesh lies in one of the exact faces, closed, the volume right.

A wall is measured by the distance of its points from the roller's way, which knows nothing of how it was meshed.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from exporters.readers import ReadMesh, read_3mf, read_stl
from exporters.verify import Verdict, deviation_failures
from exporters.verify_mesh import _normals, _topology_failures
from geometry.cams.barrel_body import BarrelBody, Cylinder, Face, Plane, Track, barrel_moments
from geometry.curve import Real
from geometry.measure import distance_to_profile

# places of the samples in each triangle, in sixths
_PLACES = [(a, b, 6 - a - b) for a in range(7) for b in range(7 - a)]
SHARES = np.array(_PLACES, dtype=float) / 6


def verify_barrel(
    file: Path, kind: str, body: BarrelBody, declared: float, tolerance: float, name: str | None
) -> Verdict:
    """Hold a file of one cylindrical cam against its exact solid; see exporters/verify.py."""
    if kind == "step":
        from exporters.verify_barrel_step import verify_barrel_step

        return verify_barrel_step(file, body, declared, tolerance, name)
    mesh = read_stl(file) if kind == "stl" else read_3mf(file, name)
    return verify_barrel_mesh(mesh, body, declared, tolerance)


def verify_barrel_shape(shape: Any, kind: str, body: BarrelBody, declared: float, tolerance: float) -> Verdict:
    """Hold one part of an assembly file ("step" or "3mf") against its exact solid."""
    if kind == "3mf":
        return verify_barrel_mesh(shape, body, declared, tolerance)
    from exporters.verify_barrel_step import verify_barrel_solid

    return verify_barrel_solid(shape, body, declared, tolerance)


def verify_barrel_mesh(mesh: ReadMesh, body: BarrelBody, declared: float, tolerance: float) -> Verdict:
    """Hold a mesh against its exact solid."""
    count = {"triangles": float(len(mesh.triangles))}
    failures = _topology_failures(mesh)
    if failures:
        return Verdict(count, tuple(failures))
    corners = mesh.vertices[mesh.triangles]
    doubled = _normals(corners)
    sizes = np.linalg.norm(doubled, axis=1)
    volume = float(np.einsum("ij,ij->i", corners[:, 0], doubled).sum() / 6)
    deviation, lone = mesh_deviation(mesh, body)
    exact = barrel_moments(body).volume
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


def mesh_deviation(mesh: ReadMesh, body: BarrelBody) -> tuple[float, int]:
    """Greatest distance of samples of the triangles from the face that each lies in, mm, and faces without any."""
    faces = surfaces_of(body)
    at_corners = np.stack([face_distance(body, face, mesh.vertices) for face in faces])
    # the face in whose surface all three corners lie best; where several do, the samples decide
    worst = at_corners[:, mesh.triangles].max(axis=2)
    near = worst <= 2 * worst.min(axis=0) + 1e-5 * body.reach()
    found = np.full(len(mesh.triangles), np.inf)
    owner = np.full(len(mesh.triangles), -1)
    for index, face in enumerate(faces):
        mine = np.flatnonzero(near[index])
        samples = np.einsum("sk,nkc->nsc", SHARES, mesh.vertices[mesh.triangles[mine]])
        here = face_distance(body, face, samples.reshape(-1, 3)).reshape(samples.shape[:2]).max(axis=1)
        better = here < found[mine]
        found[mine[better]] = here[better]
        owner[mine[better]] = index
    return float(found.max()), sum(not np.any(owner == i) for i in range(len(faces)))


def face_distance(body: BarrelBody, face: Face, points: Real) -> Real:
    """Distance of points (n, 3) from the surface that a face lies in, mm; of a wall also beyond its ends."""
    if isinstance(face, Cylinder):
        return np.abs(np.hypot(points[:, 0], points[:, 1]) - face.lower.radius)
    if isinstance(face, Plane):
        return np.abs(points[:, 2] - face.outer.z)
    if isinstance(face, Track):
        return _track_distance(body, face, points)
    plane = points[:, 0] + 1j * points[:, 1]
    height = np.maximum(0.0, np.maximum(face.low - points[:, 2], points[:, 2] - face.high))
    return np.hypot(np.asarray(distance_to_profile(plane, face.profile, trusted=np.inf)), height)


def _track_distance(body: BarrelBody, face: Track, points: Real) -> Real:
    """Of a wall: by the roller's way where a point is near it, else the way to there."""
    cam = body.cam
    size = np.hypot(points[:, 0], points[:, 1])
    beyond = np.maximum(0.0, np.maximum(cam.inner - size, size - cam.outer))
    found = np.full(len(points), np.inf)
    near = beyond <= 0.05 * cam.inner
    away, above = cam.nearest(points[near])
    # points on the other side of the roller belong to the other wall
    found[near] = np.where(above * face.side > 0, np.hypot(away, beyond[near]), np.inf)
    return found


def surfaces_of(body: BarrelBody) -> list[Face]:
    """Faces in different surfaces: a groove leaves two parts of the outer cylinder."""
    found: dict[object, Face] = {}
    for face in body.faces():
        key = ("cylinder", face.lower.radius) if isinstance(face, Cylinder) else face
        found.setdefault(key, face)
    return list(found.values())
