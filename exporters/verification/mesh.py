"""Meshes against exact bodies: closed and manifold, every outline, wall and face in its place, the volume right."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from exporters.formats.readback import Loop, ReadMesh
from exporters.verification.chamfers import chamfer_distances, slice_points
from exporters.verification.outlines import verify_loops
from exporters.verification.topology import (
    Triangles,
    areas,
    chains,
    doubled_normals,
    pieces,
    topology_failures,
    volume_in,
)
from exporters.verification.verdict import Verdict, deviation_failures
from geometry.base.distinct import distinct
from geometry.curves.curve import Flags, Real
from geometry.plane.measure import profile_area, profile_length
from geometry.solids.body import Body, Wall
from geometry.solids.mass import body_moments
from parts.base.texts import N_, fault, unless

# heights are float32 numbers, rounded twice where a file holds them as text
_LEVEL = 2.0**-23


def verify_mesh(mesh: ReadMesh, body: Body, declared: float, tolerance: float) -> Verdict:
    """Hold a mesh against its exact body.

    All triangles lie in the caps or in the walls between two levels; the outlines of the walls are measured where
    they end, and closedness makes them the outlines of the caps too.
    """
    count = {"triangles": float(len(mesh.triangles))}
    failures = topology_failures(mesh)
    if failures:
        return Verdict(count, tuple(failures))
    measured = count | {"volume": volume_in(mesh)}
    levels = np.array(body.levels())
    index = np.abs(mesh.vertices[:, 2, None] - levels).argmin(axis=1)
    off = np.abs(mesh.vertices[:, 2] - levels[index]) > _LEVEL * np.abs(levels).max()
    if np.any(off & ~_within_aslant(body, mesh.vertices[:, 2])):
        return Verdict(measured, (fault("a vertex stands off every face"),))
    heights = np.where(off, mesh.vertices[:, 2], levels[index])
    mesh = ReadMesh(np.column_stack([mesh.vertices[:, :2], heights]), mesh.triangles)
    flat = mesh.triangles[np.ptp(heights[mesh.triangles], axis=1) == 0]
    failures += _cap_failures(body, mesh.vertices[flat], declared)
    worst, edges, border = 0.0, [np.inf], 0.0
    for verdict, length in _wall_verdicts(mesh, body, declared, tolerance):
        failures += verdict.failures
        worst = max(worst, verdict.measured.get("max_deviation", np.inf))
        edges.append(verdict.measured.get("shortest_edge", np.inf))
        border = max(border, length)
    border += sum(profile_length(body.loop_profile(wall.lower)) for wall in body.walls if body.is_screw(wall))
    exact = body_moments(body).volume
    volume, told = measured["volume"], N_("volume {volume:.9g} mm^3 instead of {exact:.9g} mm^3")
    bound = border * declared * (levels[-1] - levels[0])
    failures += unless(not abs(volume - exact) > bound, told, volume=volume, exact=exact)
    measured |= {
        "volume_error": volume / exact - 1,
        "max_deviation": worst,
        "shortest_edge": min(edges),
        "least_triangle_area": float(areas(mesh).min()),
    }
    return Verdict(measured, tuple(dict.fromkeys(failures)))


def _wall_verdicts(mesh: ReadMesh, body: Body, declared: float, tolerance: float) -> Iterator[tuple[Verdict, float]]:
    """All triangles that are not flat against the walls, with the lengths of outlines that stand on each other."""
    heights = mesh.vertices[:, 2][mesh.triangles]
    low, high = heights.min(axis=1), heights.max(axis=1)
    rest = low != high
    between = [body.height(w) for w in body.walls if not body.is_upright(w)]
    for (start, end, aslant), walls in _walls_by_height(body):
        mine = rest & (low >= start) & (high <= end)
        if not aslant:
            mine &= (low == start) & (high == end)
            if any(a[0] < end and a[1] > start for a in between):
                # a slice of a screw surface or of a chamfer may stand between the same heights; it has upright edges
                # where its sections agree, as crowned teeth do in the middle of their tips, but not all round
                which = pieces(mesh.triangles[mine])
                mine[mine] = ~np.isin(which, which[~_stands(mesh, mesh.triangles[mine])])
        rest &= ~mine
        yield from _verify_walls(mesh, mesh.triangles[mine], (start, end), body, walls, declared, tolerance)
    for wall in filter(body.is_screw, body.walls):
        from exporters.verification.twisted import verify_twisted

        mine = rest & (low >= body.height(wall)[0]) & (high <= body.height(wall)[1])
        rest &= ~mine
        yield verify_twisted(mesh, mesh.triangles[mine], body, wall, declared, tolerance), 0.0
    failures = unless(not np.any(rest), "a wall does not end at the faces of the part")
    yield Verdict({"max_deviation": 0.0}, tuple(failures)), 0.0


def _within_aslant(body: Body, z: Real) -> Flags:
    """Which heights lie between the ends of a wall that does not stand upright."""
    found = np.zeros(len(z), dtype=bool)
    for wall in body.walls:
        if not body.is_upright(wall):
            low, high = body.height(wall)
            found |= (low < z) & (z < high)
    return found


def _stands(mesh: ReadMesh, triangles: Triangles) -> Flags:
    """Which triangles have an upright edge."""
    corners = (mesh.vertices[:, 0] + 1j * mesh.vertices[:, 1])[triangles]
    return np.asarray(np.any(corners == np.roll(corners, 1, axis=1), axis=1))


def _walls_by_height(body: Body) -> list[tuple[tuple[float, float, bool], list[Wall]]]:
    """The walls between each two levels, without screw surfaces: those that stand upright, then those aslant."""
    found: dict[tuple[float, float, bool], list[Wall]] = {}
    for wall in body.walls:
        if not body.is_screw(wall):
            found.setdefault((*body.height(wall), not body.is_upright(wall)), []).append(wall)
    return sorted(found.items(), key=lambda item: item[0][2])


def _cap_failures(body: Body, corners: Real, declared: float) -> list[str]:
    """Flat triangles against the caps: level by level, looking the right way, of the right area."""
    doubled, heights = doubled_normals(corners)[:, 2], corners[:, 0, 2]
    expected: dict[tuple[float, bool], list[float]] = {}
    for cap in body.caps:
        profiles = [body.loop_profile(i) for i in (cap.outer, *cap.holes)]
        outer, *holes = (abs(profile_area(p)) for p in profiles)
        slack = declared * sum(profile_length(p) for p in profiles)
        total = expected.setdefault((body.loops[cap.outer].z, cap.up), [0.0, 0.0])
        total[0] += outer - sum(holes)
        total[1] += slack
    failures: list[str] = []
    told = N_("the face at z = {z:g} has {found:.9g} mm^2 instead of {area:.9g} mm^2")
    for (z, up), (area, slack) in expected.items():
        mine = (heights == z) & ((doubled > 0) == up)
        found = float(np.abs(doubled[mine]).sum() / 2)
        failures += unless(not abs(found - area) > slack + 1e-12 * area, told, z=z, found=found, area=area)
    known = np.array([[z, up] for z, up in expected])
    strange = ~np.any((heights[:, None] == known[:, 0]) & ((doubled > 0)[:, None] == known[:, 1]), axis=1)
    return failures + unless(not np.any(strange), "triangles of a face overlap")


def _verify_walls(
    mesh: ReadMesh,
    triangles: Triangles,
    pair: tuple[float, float],
    body: Body,
    walls: list[Wall],
    declared: float,
    tolerance: float,
) -> list[tuple[Verdict, float]]:
    """The outlines of the walls between two levels, each with its length; of chamfers every slice and between them."""
    z, places = mesh.vertices[:, 2], mesh.vertices[:, 0] + 1j * mesh.vertices[:, 1]
    found = []
    if all(body.is_upright(w) for w in walls):
        if not np.all(_stands(mesh, triangles)):
            return [(Verdict({}, (fault("the walls do not stand upright between both faces"),)), 0.0)]
        layers = [(pair[0], triangles)]
    else:
        low, high = z[triangles].min(axis=1), z[triangles].max(axis=1)
        slices = distinct(z[triangles])
        if tuple(slices[[0, -1]]) != pair or np.any(np.searchsorted(slices, high) - np.searchsorted(slices, low) != 1):
            return [(Verdict({}, (fault("a chamfer does not run from slice to slice between its ends"),)), 0.0)]
        layers = [(level, triangles[low == level]) for level in slices[:-1].tolist()]
        layers.append((pair[1], triangles[high == pair[1]]))
        worst = float(chamfer_distances(slice_points(mesh, triangles), body, declared).max())
        failures = deviation_failures(worst, declared, tolerance, body.section_reach())
        found.append((Verdict({"max_deviation": worst}, tuple(failures)), 0.0))
    for level, layer in layers:
        loops = [places[chain] for chain in chains(layer, z, level)]
        profiles = [body.standing(w, level) for w in walls]
        verdict = verify_loops(
            [Loop(v, np.zeros(len(v)), "") for v in loops],
            profiles,
            [""] * len(profiles),
            declared,
            tolerance,
            # triangles that all turn one way, with outlines this near to the exact ones, cannot overlap
            known_simple=True,
        )
        found.append((verdict, float(sum(np.abs(np.roll(v, -1) - v).sum() for v in loops))))
    return found
