"""Points within the faces of a solid that was read: by its surfaces' own formulas, at places of our choice."""

from __future__ import annotations

import numpy as np

from exporters.formats.read_curves import lobatto, spans_of
from exporters.formats.read_part21 import Index
from exporters.formats.read_solid import EXTRUSION, LEVEL, PLANE, ROUND, SPHERE, SPLINE, TORUS, Model
from geometry.curves.curve import Real
from parts.base.readback import refuse_if

# which of the nodes on the way up are looked at: few heights, each of which may need a section of its own
_KEPT = [0, 2, 4, 7, 9, 11]
# spline surfaces that are evaluated at a time
_BLOCK = 100
# places on each line across a face
_PLACES = np.linspace(0.02, 0.98, 9)


def edge_points(model: Model, faces: Index) -> Real:
    """Of all edges of some faces, (n, 3)."""
    span, use = model.spans
    mine = np.unique(span[np.isin(model.uses.face, faces)[use]])
    points = model.points[mine]
    level = np.ptp(points[..., 2], axis=1) <= LEVEL
    return np.concatenate([points[level].reshape(-1, 3), points[~level][:, _KEPT].reshape(-1, 3)])


def foot_points(model: Model, walls: Index) -> tuple[Real, Index]:
    """Of upright walls above the edges that they stand on, (n, 12, 3), and the wall of each row."""
    flat = walls[model.kind[walls] != EXTRUSION]
    span, face = model.feet(flat)
    at = model.frames.local(face, model.points[span])
    round_ = model.kind[face] == ROUND
    at[~round_, :, 2] = 0.0
    size = np.hypot(at[round_, :, 0], at[round_, :, 1])
    at[round_, :, :2] *= (model.sizes[face[round_], :1] / size)[..., None]
    swept = walls[model.kind[walls] == EXTRUSION]
    span, row = spans_of(model.curves, model.moved[swept])
    return np.concatenate([_placed(model, face, at), model.points[span]]), np.concatenate([face, swept[row]])


def inner_points(model: Model, faces: Index) -> Real:
    """Points within faces, (n, 3)."""
    pieces, nodes = [np.zeros((0, 3))], lobatto()[0]
    # a table of 2000 rows has as many patches
    for patches in [model.patches[k] for k in np.unique(model.owners[faces]).tolist() if k >= 0]:
        mine = np.flatnonzero(np.isin(patches.faces, faces))
        pieces += [
            patches.grid(nodes, nodes[_KEPT], mine[k : k + _BLOCK])[0].reshape(-1, 3)
            for k in range(0, len(mine), _BLOCK)
        ]
    for face in faces[model.kind[faces] != SPLINE].tolist():
        mine = np.flatnonzero(model.uses.face == face)
        span, use = spans_of(model.curves, model.uses.edge[mine])
        at = model.frames.local(np.full(len(span), face), model.points[span])
        at[~model.uses.left[mine][use]] = at[~model.uses.left[mine][use], ::-1]
        kind = int(model.kind[face])
        if kind == EXTRUSION:
            curved = ~model.straight[model.uses.edge[mine]][use]
            found = _on_rulings(at[curved], use[curved])
        else:
            found = _across(at, kind, bool(model.normal[face]), model.sizes[face])
        pieces.append(_placed(model, np.array([face]), found[None])[0])
    return np.concatenate(pieces)


def _placed(model: Model, face: Index, at: Real) -> Real:
    """Points (n, k, 3) in the frames of faces (n,), in that of the solid."""
    return np.asarray(model.frames.origins[face][:, None] + at @ model.frames.axes[face])


def _on_rulings(at: Real, use: Index) -> Real:
    """Of an extrusion between two copies of its curve: the lower one, lifted towards the other."""
    low, *others, high = sorted((float(at[use == k, :, 2].mean()), k) for k in np.unique(use).tolist())
    refuse_if(others, "an extrusion of the STEP file does not lie between two copies of its curve")
    lifts = np.array([0.0, 0.0, high[0] - low[0]]) * lobatto()[0][_KEPT, None]
    return np.asarray((at[use == low[1]].reshape(-1, 1, 3) + lifts).reshape(-1, 3))


def _across(at: Real, kind: int, normal: bool, sizes: Real) -> Real:
    """Of a plane or a face of revolution: points (n, 3) on lines across it, between the bounds on both sides.

    ``at``: nodes (n, k, 3) of the bounds' spans as they run, the face on their left, seen from its normal.
    """
    v = at[..., 1] if kind == PLANE else at[..., 2]
    plane = at[..., 0] + 1j * at[..., 1]
    centre, tube = (0.0, sizes[0]) if kind == SPHERE else sizes
    if kind in (SPHERE, TORUS):
        # the angle of the meridian, from the middle of the face
        spoke = np.abs(plane) - centre + 1j * at[..., 2]
        middle = np.angle((spoke / np.abs(spoke)).mean())
        v = middle + np.angle(spoke * np.exp(-1j * middle))
    found = []
    for level in (v.min() + (v.max() - v.min()) * lobatto()[0][_KEPT[1:-1]]).tolist():
        up, down = (v[:, :-1] <= level) & (v[:, 1:] > level), (v[:, :-1] > level) & (v[:, 1:] <= level)
        sides = []
        for way in (down, up) if normal else (up, down):
            share = (level - v[:, :-1][way]) / (v[:, 1:][way] - v[:, :-1][way])
            where = plane[:, :-1][way] * (1 - share) + plane[:, 1:][way] * share
            sides.append(where.real if kind == PLANE else np.angle(where))
        begin, end = sides
        if not len(begin):
            begin, end = np.zeros(1), np.full(1, 2 * np.pi)
        width = end - begin[:, None]
        if kind != PLANE:
            width = np.mod(width, 2 * np.pi)
            # a seam has the face on both sides of it
            width[(width < 1e-9) | (width > 2 * np.pi - 1e-9)] = 2 * np.pi
        width[width <= 0] = np.inf
        nearest = width.min(axis=1, keepdims=True)
        # on a ring narrower than the bow of its bounds between nodes a line finds no other side
        lines = np.isfinite(nearest[:, 0])
        u = (begin[lines, None] + nearest[lines] * _PLACES).ravel()
        size, height = sizes[0] + sizes[1] * level, level
        if kind in (SPHERE, TORUS):
            size, height = centre + tube * np.cos(level), tube * np.sin(level)
        round_ = (size * np.cos(u), size * np.sin(u), np.full(u.size, height))
        found.append(np.column_stack((u, np.full(u.size, level), np.zeros(u.size)) if kind == PLANE else round_))
    return np.concatenate(found)
