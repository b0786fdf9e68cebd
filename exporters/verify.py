"""Every file is held against the exact section: closed, simple, in its place, within its tolerance.

Measured densely and between the writer's own nodes. A check that fails names what was found.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from exporters.readers import Loop, ReadError, ReadMesh, read_3mf, read_dxf, read_stl, read_svg, step_names
from geometry.contour import edge_points, signed_area
from geometry.curve import Complex
from geometry.measure import distance_to_profile, profile_area
from geometry.profile import Profile, Region

# how many points of a file are measured: all edges get at least 3 between their ends
_POINTS = 10_000
# rounding of the measurement itself, as a part of the section's size
_ROUNDING = 1e-13


@dataclass(frozen=True, slots=True)
class Verdict:
    """What was measured on a file, and what is wrong with it (nothing: it is good)."""

    measured: dict[str, float]
    failures: tuple[str, ...]


def verify_file(
    file: Path,
    kind: str,
    region: Region,
    thickness: float,
    declared: float,
    tolerance: float,
    name: str | None = None,
) -> Verdict:
    """Read a file back and hold it against its exact section.

    ``declared``: the error that its report states, mm; the measured one must not exceed it or ``tolerance``.
    ``name``: what the part must be called where the format has names.
    """
    try:
        if kind in ("stl", "3mf"):
            mesh = read_stl(file) if kind == "stl" else read_3mf(file, name)
            return verify_mesh(mesh, region, thickness, declared, tolerance)
        if kind in ("step", "drawing"):
            from exporters.verify_cad import verify_cad

            if kind == "step" and name is not None and (found := step_names(file)) != [name]:
                raise ReadError(f"the file names its parts {', '.join(found) or 'nothing'} instead of {name}")
            return verify_cad(file, kind, region, thickness, declared, tolerance)
        loops = read_dxf(file) if kind == "dxf" else read_svg(file)
        return _verdict(loops, region, declared, tolerance)
    except (ReadError, OSError) as error:
        return Verdict({}, (str(error),))


def _verdict(
    loops: list[Loop], region: Region, declared: float, tolerance: float, *, known_simple: bool = False
) -> Verdict:
    profiles = region.profiles()
    if len(loops) != len(profiles):
        return Verdict({"contours": len(loops)}, (f"{len(loops)} contours instead of {len(profiles)}",))
    failures: list[str] = []
    worst, shortest = 0.0, float("inf")
    unmatched = list(loops)
    for profile in profiles:
        distances = [_rough_distance(loop, profile) for loop in unmatched]
        loop = unmatched.pop(int(np.argmin(distances)))
        layer = "CUT_OUTER" if profile is region.outer else "CUT_INNER"
        if loop.layer and loop.layer.upper() != layer:
            failures.append(f"a contour stands on {loop.layer} instead of {layer}")
        deviation, found = _check_loop(loop, profile, declared, known_simple)
        worst = max(worst, deviation)
        shortest = min(shortest, float(np.abs(np.roll(loop.vertices, -1) - loop.vertices).min()))
        failures += found
    failures += deviation_failures(worst, declared, tolerance, region)
    return Verdict({"contours": len(loops), "max_deviation": worst, "shortest_edge": shortest}, tuple(failures))


def deviation_failures(worst: float, declared: float, tolerance: float, region: Region) -> list[str]:
    """What is wrong with a deviation, mm: more than the tolerance, or more than was declared."""
    allowed = _ROUNDING * region.outer.reach()
    failures = []
    if not worst <= tolerance + allowed:
        failures.append(f"deviates by {worst:.6g} mm from the exact outline; the tolerance is {tolerance:g} mm")
    elif not worst <= declared + allowed:
        failures.append(f"deviates by {worst:.6g} mm, more than the declared {declared:.6g} mm")
    return failures


def _rough_distance(loop: Loop, profile: Profile) -> float:
    step = max(1, len(loop.vertices) // 16)
    return float(distance_to_profile(loop.vertices[::step], profile, trusted=float("inf")).max())


def _check_loop(loop: Loop, profile: Profile, declared: float, known_simple: bool) -> tuple[float, list[str]]:
    """Greatest deviation of a loop, and what is wrong with its shape."""
    starts, ends = loop.vertices, np.roll(loop.vertices, -1)
    if len(starts) < 2 or not (np.all(np.isfinite(starts)) and np.all(np.isfinite(loop.bulges))):
        return float("inf"), ["a contour holds no shape or a coordinate that is not a number"]
    failures = []
    if np.any(starts == ends):
        failures.append("a contour repeats a vertex")
    inner = int(np.clip(_POINTS // len(starts), 3, 24))
    points = edge_points(starts, ends, loop.bulges, np.linspace(0, 1, inner + 2)[:-1])
    deviation = float(distance_to_profile(points.ravel(), profile, trusted=declared).max())
    length = float(np.abs(np.diff(points, axis=1)).sum())
    exact, found = profile_area(profile), signed_area(starts, loop.bulges)
    if abs(abs(found) - abs(exact)) > max(deviation, declared) * length + 1e-12 * abs(exact):
        failures.append(f"encloses {abs(found):.9g} mm^2 instead of {abs(exact):.9g} mm^2")
    if not known_simple and not is_simple(points[:, :: max(1, (inner + 1) // 4)].ravel()):
        failures.append("a contour crosses itself")
    return deviation, failures


def is_simple(points: Complex) -> bool:
    """Whether a closed polygon does not cross itself, by GEOS."""
    import shapely

    ring = shapely.linearrings(np.stack([points.real, points.imag], axis=1))
    return bool(shapely.is_simple(ring))


def verify_mesh(mesh: ReadMesh, region: Region, thickness: float, declared: float, tolerance: float) -> Verdict:
    """Closed, manifold, no thin triangle; its two caps and walls stand on the exact section."""
    failures = _topology_failures(mesh)
    if failures:
        return Verdict({"triangles": len(mesh.triangles)}, tuple(failures))
    corners = mesh.vertices[mesh.triangles]
    volume = float(np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6)
    z = mesh.vertices[:, 2]
    top = float(np.float32(thickness))
    if not np.all((z == 0) | (z == top)):
        return Verdict({"volume": volume}, ("a vertex stands off both faces",))
    if not _walls_upright(mesh):
        return Verdict({"volume": volume}, ("the walls do not stand upright between both faces",))
    loops = _bottom_loops(mesh)
    flat = _verdict([Loop(v, np.zeros(len(v)), "") for v in loops], region, declared, tolerance, known_simple=True)
    exact = sum(profile_area(p) for p in region.profiles()) * thickness
    allowed = sum(np.abs(np.roll(v, -1) - v).sum() for v in loops) * declared * thickness
    if abs(volume - exact) > allowed:
        failures.append(f"volume {volume:.9g} mm^3 instead of {exact:.9g} mm^3")
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    measured = flat.measured | {
        "triangles": len(mesh.triangles),
        "volume": volume,
        "volume_error": volume / exact - 1,
        "least_triangle_area": float(areas.min()),
    }
    return Verdict(measured, (*failures, *flat.failures))


def _walls_upright(mesh: ReadMesh) -> bool:
    """Whether every triangle between the faces has two corners above each other: then both outlines are one."""
    z = mesh.vertices[:, 2][mesh.triangles]
    places = (mesh.vertices[:, 0] + 1j * mesh.vertices[:, 1])[mesh.triangles[np.ptp(z, axis=1) > 0]]
    return bool(np.all(np.any(places == np.roll(places, 1, axis=1), axis=1)))


def _topology_failures(mesh: ReadMesh) -> list[str]:
    """Watertight, manifold, consistently turned, no triangle without area."""
    t = mesh.triangles
    if np.any((t[:, 0] == t[:, 1]) | (t[:, 1] == t[:, 2]) | (t[:, 2] == t[:, 0])):
        return ["a triangle has two equal corners"]
    corners = mesh.vertices[t]
    doubled = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    if not np.all(doubled > 0):
        return ["a triangle has no area"]
    n = len(mesh.vertices)
    edges = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]]).astype(np.int64)
    forward, backward = np.sort(edges[:, 0] * n + edges[:, 1]), np.sort(edges[:, 1] * n + edges[:, 0])
    if np.any(forward[1:] == forward[:-1]):
        return ["two triangles run along one edge the same way"]
    if not np.array_equal(forward, backward):
        return ["the mesh is not closed: an edge has a triangle on one side only"]
    return []


def _bottom_loops(mesh: ReadMesh) -> list[Complex]:
    """The outlines in the lower face: edges that bound exactly one triangle of it, chained."""
    flat = mesh.vertices[:, 2][mesh.triangles] == 0
    points = mesh.vertices[:, 0] + 1j * mesh.vertices[:, 1]
    # the lower face looks down, so its triangles turn clockwise seen from above
    lower = mesh.triangles[flat.all(axis=1)][:, ::-1]
    upper = mesh.triangles[~flat.any(axis=1)]
    # triangles that all turn one way, with outlines this near to the exact ones, cannot overlap
    for name, face in (("lower", lower), ("upper", upper)):
        a, b, c = points[face].T
        if not np.all((np.conj(b - a) * (c - a)).imag > 0):
            raise ReadError(f"triangles of the {name} face overlap")
    n = len(mesh.vertices)
    edges = np.concatenate([lower[:, [0, 1]], lower[:, [1, 2]], lower[:, [2, 0]]])
    keys, twins = edges[:, 0] * n + edges[:, 1], np.sort(edges[:, 1] * n + edges[:, 0])
    place = np.minimum(np.searchsorted(twins, keys), len(twins) - 1)
    border = edges[twins[place] != keys]
    if np.bincount(border[:, 0], minlength=n).max() > 1:
        raise ReadError("the lower face touches itself in a point")
    following = dict(zip(border[:, 0].tolist(), border[:, 1].tolist(), strict=True))
    loops = []
    while following:
        start, vertex = following.popitem()
        chain = [start]
        while vertex != start:
            chain.append(vertex)
            if vertex not in following:
                raise ReadError("the outline of the lower face is not closed")
            vertex = following.pop(vertex)
        loops.append(points[chain])
    return loops
