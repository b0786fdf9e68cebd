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
from exporters.verification.area import told_verdict
from exporters.verification.samples import edge_points, inner_points
from exporters.verification.topology import areas, edge_lengths, of_each, topology_failures, volume_in
from exporters.verification.verdict import Verdict, deviation_failures, volume_bound
from geometry.curves.curve import Flags, Indices, Real
from parts.base.texts import N_, unless

if TYPE_CHECKING:
    from geometry.solids.measured import Faced, Measured

# places of the samples within each triangle and on each edge, in sixths
_INNER = np.array([(a, b, 6 - a - b) for a in range(1, 5) for b in range(1, 6 - a)]) / 6
_ALONG = np.array([(6 - a, a) for a in range(1, 6)]) / 6
# points of a face that tell in which surfaces it may lie
_FEW = 9
# how much farther a triangle may lie from a face than from its nearest to be one of its own, and part of the reach
_AS_WELL, _SURE = 2.0, 1e-5
# size of the cells by which triangles that are one turned are found, part of the reach, and how much a distance, which
# is right to first order, changes at most for each mm that a point is moved
_CELL, _STEEP = 5e-5, 2.0


def verify_faced_mesh(mesh: ReadMesh, body: Faced, declared: float, tolerance: float) -> Verdict:
    """Hold a mesh against its exact solid."""
    count = {"triangles": float(len(mesh.triangles))}
    failures = topology_failures(mesh)
    if failures:
        return Verdict(count, tuple(failures))
    sizes, volume = areas(mesh), volume_in(mesh)
    deviation, lone = mesh_deviation(mesh, body)
    exact = body.moments.volume
    reach = body.reach()
    failures += deviation_failures(deviation, declared, tolerance, reach)
    failures += unless(not lone, "{count} faces of the part have no triangle", count=lone)
    bound = declared * float(sizes.sum()) + 1e-9 * exact
    told = N_("volume {volume:.9g} mm^3 instead of {exact:.9g} mm^3")
    failures += unless(abs(volume - exact) <= bound, told, volume=volume, exact=exact)
    measured = count | {
        "volume": volume,
        "volume_error": volume / exact - 1,
        "max_deviation": deviation,
        "shortest_edge": float(of_each(edge_lengths, mesh, mesh.triangles).min()),
        "least_triangle_area": float(sizes.min()),
    }
    return Verdict(measured, tuple(failures))


def mesh_deviation(mesh: ReadMesh, body: Faced) -> tuple[float, int]:
    """Greatest distance of samples of the triangles from the face that each lies in, mm, and faces without any.

    Of triangles that are one turned about the axis, by as much as surfaces may be, one is measured; how far the others
    are from being the same bounds what could be found on them, and those that might be worse are measured too.
    """
    like, off = _turned(mesh, max(face.turns for face in body.surfaces), _CELL * body.reach())
    first = np.unique(like)
    found, bounds, has = _measured(mesh, first, body)
    worst = float(found.max())
    bound = np.full(len(mesh.triangles), np.inf)
    bound[first] = bounds
    rest = np.flatnonzero(~(bound[like] + _STEEP * off <= worst) & (like != np.arange(len(like))))
    if rest.size:
        found, _, also = _measured(mesh, rest, body)
        worst, has = max(worst, float(found.max())), has | also
    return worst, int(np.count_nonzero(~has))


def _turned(mesh: ReadMesh, count: int, cell: float) -> tuple[Indices, Real]:
    """Of each triangle one that it may be, turned by a part of 1 / ``count`` turn, and how far off its corners are, mm.

    Which one that is need not be the best choice: nothing but the distance is relied on.
    """
    corners = mesh.faces()
    own = np.arange(len(corners))
    if count <= 1:
        return own, np.zeros(len(corners))
    pitch = 2 * np.pi / count
    flat, high = corners[..., 0] + 1j * corners[..., 1], corners[..., 2]
    middle = flat.mean(axis=1)
    step = np.floor(np.angle(middle) / pitch)
    ahead = middle * np.exp(-1j * pitch * step)
    # middles in one cell; a border of cells between two that are alike costs time alone
    cells = np.stack([ahead.real, ahead.imag, high.mean(axis=1)], axis=1) / cell
    names = np.floor(cells - cells.min(axis=0)).astype(np.int64)
    wide = names.max(axis=0) + 1
    names = (names[:, 0] * wide[1] + names[:, 1]) * wide[2] + names[:, 2]
    _, first, which = np.unique(names, return_index=True, return_inverse=True)
    like = first[which]
    turned, level = flat[like] * np.exp(1j * pitch * (step - step[like]))[:, None], high[like]
    # the same corners may be told from another one on
    pairs = ((np.roll(turned, k, axis=1) - flat, np.roll(level, k, axis=1) - high) for k in range(3))
    off = np.min([np.hypot(np.abs(across), up).max(axis=1) for across, up in pairs], axis=0)
    return like, off


def _measured(mesh: ReadMesh, which: Indices, body: Faced) -> tuple[Real, Real, Flags]:
    """Greatest distances of samples of some triangles from the face that each lies in, mm, and which faces have any.

    Between them: the same from such faces alone as all turns that ``mesh_deviation`` makes bring onto themselves.
    """
    faces = body.surfaces
    used, triangles = np.unique(mesh.triangles[which], return_inverse=True)
    vertices, triangles = mesh.vertices[used], triangles.reshape(-1, 3)
    at_corners = np.stack([face.distance(vertices) for face in faces])
    low, high = np.moveaxis(np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]], axis=2), 2, 0)
    names, sides = np.unique(low * len(vertices) + high, return_inverse=True)
    edges, sides = np.stack(np.divmod(names, len(vertices)), axis=1), sides.reshape(-1, 3)
    # the face in whose surface all three corners lie best; where several do, the samples decide
    worst = at_corners[:, triangles].max(axis=2)
    near = worst <= _AS_WELL * worst.min(axis=0) + _SURE * body.reach()
    most = max(face.turns for face in faces)
    found, bounds = np.full((2, len(triangles)), np.inf)
    own: list[tuple[Indices, Real]] = []
    for index, face in enumerate(faces):
        mine = np.flatnonzero(near[index])
        # an edge between two triangles is looked at once
        borders, side = np.unique(sides[mine], return_inverse=True)
        within, along = (
            _greatest(face, shares, vertices[corners])
            for shares, corners in ((_INNER, triangles[mine]), (_ALONG, edges[borders]))
        )
        here = np.maximum(np.maximum(worst[index, mine], within), along[side.reshape(-1, 3)].max(axis=1))
        found[mine] = np.minimum(found[mine], here)
        if face.turns in (0, most):
            bounds[mine] = np.minimum(bounds[mine], here)
        own.append((mine, here))
    # a face narrower than the tolerance has triangles that lie as well in its neighbours, or better: chords leave it
    sure, greatest = _SURE * body.reach(), float(found.max())
    has = [bool(np.any(here <= np.maximum(_AS_WELL * found[mine] + sure, greatest))) for mine, here in own]
    return found, bounds, np.array(has)


def _greatest(face: Measured, shares: Real, corners: Real) -> Real:
    """Greatest distances (n,) from a face of places between corners (n, k, 3), mm."""
    samples = np.einsum("sk,nkc->nsc", shares, corners)
    return np.asarray(face.distance(samples.reshape(-1, 3)).reshape(samples.shape[:2]).max(axis=1))


def verify_faced_solid(found: ReadSolid, body: Faced, declared: float, tolerance: float) -> Verdict:
    """Hold a re-read solid against its exact one: faces, edges, ends, volume."""
    model, surfaces = found.model, body.surfaces
    own = [np.array([face]) for face in range(len(model.faces))]
    points = [np.concatenate([edge_points(model, face), inner_points(model, face)]) for face in own]
    # a few points tell which surfaces a face may lie in, all of them which one it does
    few = np.concatenate([p[np.linspace(0, len(p) - 1, _FEW).astype(int)] for p in points])
    rough = np.stack([surface.distance(few).reshape(-1, _FEW).max(axis=1) for surface in surfaces])
    near = rough <= _AS_WELL * rough.min(axis=0) + _SURE * body.reach()
    away = np.full(near.shape, np.inf)
    for index, surface in enumerate(surfaces):
        mine = np.flatnonzero(near[index])
        if mine.size:
            starts = np.cumsum([0, *(len(points[face]) for face in mine[:-1])])
            away[index, mine] = np.maximum.reduceat(surface.distance(np.concatenate([points[f] for f in mine])), starts)
    used, worst = set(away.argmin(axis=0).tolist()), float(away.min(axis=0).max())
    failures = deviation_failures(worst, declared, tolerance, body.reach())
    for index, surface in enumerate(surfaces):
        failures += unless(index in used, "a {what} of the part is missing", what=surface.what)
    walls = float(model.area[np.isin(model.kind, (EXTRUSION, SPLINE))].sum())
    # what a cone holds goes by heights, which a flat one makes the most of
    steep = np.where(model.kind == ROUND, np.maximum(1.0, model.sizes[:, 1]), 1.0)
    exact = body.moments.volume
    bound = volume_bound(exact, float(model.area @ steep), walls + body.slack, declared)
    told = told_verdict(found, exact, bound, body.precision)
    return Verdict(told.measured | {"max_deviation": worst}, tuple(dict.fromkeys((*failures, *told.failures))))
