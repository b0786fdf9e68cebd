"""The area of a solid's faces, all faces of a bundle at once.

Over planes and surfaces of revolution it is an integral along the bounds (Green): of a cone the area of its shadow
across the axis over the sine of its slant, of spheres and tori up to that of the whole. Extrusions go by the length of
what is moved, splines are integrated over by Gauss's rule on every span.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from geometry.base.gauss import panels
from geometry.base.record import Record
from geometry.curves.curve import Real
from geometry.solids.charts import TURN, along_edges, axes_of, edge_rows, smooth_shares, span_shares, spline_rows
from geometry.solids.faces import (
    Cone,
    Cylinder,
    Edges,
    Extrusion,
    Faces,
    Index,
    Plane,
    Solid,
    Sphere,
    SplineSurface,
    Straight,
    Torus,
)  # fmt: skip

# nodes on a piece of an edge
_NODES = 12
# a seam that turns less than this round the axis of a torus runs round its tube, rad
_SEAM = 1e-9
# nodes each way on a piece of a spline surface, and fewer that must tell the same to this part, which the more of them
# know to its 1.6th power; else the pieces are halved, so often at most; places at a time
_ACROSS, _FEWER, _ALIKE, _MOST, _AT_ONCE = 8, 5, 1e-7, 4, 200_000


def surface_area(solid: Solid) -> float:
    """Of all faces, mm^2."""
    runs = _Runs(tuple(_samples(solid, edges) for edges in solid.edges), *edge_rows(solid))
    return sum(float(_areas(solid, runs, faces).sum()) for faces in solid.faces)


class _Samples(Record, eq=False):
    """Points of edges and derivatives by their shares (n, k, 3), and weights (k,)."""

    points: Real
    steps: Real
    weights: Real


class _Runs(Record, eq=False):
    """Samples of every bundle of edges; of every edge its bundle and its row there."""

    samples: tuple[_Samples, ...]
    bundle: Index
    row: Index

    def of(self, edges: Index) -> Iterator[tuple[Index, Real, Real, Real]]:
        """Edges bundle by bundle: their places among these, points and steps (n, k, 3), and weights (k,)."""
        bundles = self.bundle[edges]
        for number in np.unique(bundles).tolist():
            mine = np.flatnonzero(bundles == number)
            own, rows = self.samples[number], self.row[edges[mine]]
            yield mine, own.points[rows], own.steps[rows], own.weights


def _samples(solid: Solid, edges: Edges) -> _Samples:
    # along a line every integrand is even
    nodes, weights = panels(smooth_shares(solid, edges), 1 if isinstance(edges.curve, Straight) else _NODES)
    return _Samples(*along_edges(solid, edges, nodes), weights)


def _areas(solid: Solid, runs: _Runs, faces: Faces) -> Real:
    """Of the faces of a bundle, (n,)."""
    surface = faces.surface
    if isinstance(surface, SplineSurface):
        return _settled(solid, surface)
    if isinstance(surface, Extrusion):
        return _swept(solid, runs, faces, surface)
    count = len(faces.loops[0][0])
    origin, axes = axes_of(solid, surface.frame, count)
    bounds = np.concatenate([edges for edges, _ in faces.loops], axis=1)
    ways = np.concatenate([np.where(np.broadcast_to(senses, edges.shape), 1, -1) for edges, senses in faces.loops], 1)
    face, total, places = np.repeat(np.arange(count), bounds.shape[1]), np.zeros(count), []
    for mine, points, steps, weights in runs.of(bounds.ravel()):
        turned = axes[face[mine]].transpose(0, 2, 1)
        at, step = (points - origin[face[mine], None]) @ turned, steps @ turned
        turn = ways.ravel()[mine, None] * (at[..., 0] * step[..., 1] - at[..., 1] * step[..., 0])
        places.append((mine, at, turn, weights))
    about = _middles(surface, places, bounds, faces.along) if isinstance(surface, Torus) else np.zeros((bounds.size, 2))
    for mine, at, turn, weights in places:
        total += np.bincount(face[mine], _form(surface, at, turn, about[mine]) @ weights, count)
    whole = _whole(surface)
    if whole is None:
        return np.abs(total)
    share = np.mod(total if faces.along else -total, whole)
    # all of it where there is no bound but seams, each of which is run both ways
    bounds = np.sort(bounds, axis=1)
    bare = bounds.shape[1] % 2 == 0 and np.all(bounds[:, ::2] == bounds[:, 1::2], axis=1)
    return np.where(bare, whole, share)


def _form(surface: Plane | Cylinder | Cone | Torus | Sphere, at: Real, turn: Real, about: Real) -> Real:
    """What is integrated along the bounds, of places (n, k, 3) in a surface's frame and twice the area they sweep."""
    if isinstance(surface, Plane):
        return turn / 2
    if isinstance(surface, Cone):
        return turn / (2 * math.sin(surface.slant))
    size, z = np.hypot(at[..., 0], at[..., 1]), at[..., 2]
    turn = turn / size**2
    if isinstance(surface, Cylinder):
        return np.asarray(-surface.radius * z * turn)
    if isinstance(surface, Sphere):
        return np.asarray(-surface.radius * (z + surface.radius) * turn)
    near, base = about[:, :1], about[:, 1:]
    v = near + np.angle((size - surface.radius + 1j * z) * np.exp(-1j * near))
    # from the face's own angle on: from 0 a tube far wider than the face is off the axis sweeps more than digits hold
    swept = surface.radius * (v - base) + 2 * surface.tube * np.cos((v + base) / 2) * np.sin((v - base) / 2)
    return np.asarray(-surface.tube * swept * turn)


def _whole(surface: Plane | Cylinder | Cone | Torus | Sphere) -> float | None:
    """The area of a surface that is closed, mm^2; a tube wider than its torus's radius goes through itself."""
    if isinstance(surface, Sphere):
        return 2 * TURN * surface.radius**2
    if isinstance(surface, Torus) and surface.tube <= surface.radius:
        return TURN**2 * surface.radius * surface.tube
    return None


def _middles(surface: Torus, places: list[tuple[Index, Real, Real, Real]], bounds: Index, along: bool) -> Real:
    """Of the bounds (n, m) of faces on a torus angles round the tube, near theirs and of the face, rad, (n m, 2).

    A face that is cut open by a seam round the axis reaches from it once round the tube: its sides are a turn apart.
    """
    spokes, turns = np.zeros(bounds.shape, complex), np.zeros(bounds.shape)
    for mine, at, turn, weights in places:
        size = np.hypot(at[..., 0], at[..., 1])
        spokes.flat[mine] = (size - surface.radius + 1j * at[..., 2]) @ weights
        turns.flat[mine] = (turn / size**2) @ weights
    seams = (bounds[:, :, None] == bounds[:, None]).sum(axis=2) > 1
    turns[~seams | (np.abs(turns) < _SEAM)] = 0.0
    cut = np.any(turns != 0, axis=1)
    middle = np.angle(np.where(cut, -(np.abs(turns) * spokes).sum(axis=1), spokes.sum(axis=1)))
    near = middle[:, None] - (math.pi if along else -math.pi) * np.sign(turns)
    return np.column_stack([near.ravel(), np.repeat(middle, bounds.shape[1])])


def _swept(solid: Solid, runs: _Runs, faces: Faces, surface: Extrusion) -> Real:
    """Of extrusions, whose bounds have the edge after the moved one along the direction."""
    ((edges, _),) = faces.loops
    after = (np.argmax(edges == surface.edges[:, None], axis=1) + 1) % edges.shape[1]
    ruling, total = edges[np.arange(len(edges)), after], np.zeros(len(edges))
    ways = np.empty((len(edges), 3))
    for mine, _, steps, weights in runs.of(ruling):
        ways[mine] = np.einsum("nkc,k->nc", steps, weights)
    for mine, _, steps, weights in runs.of(surface.edges):
        total[mine] = np.linalg.norm(np.cross(steps, ways[mine, None]), axis=2) @ weights
    return total


def _settled(solid: Solid, surface: SplineSurface) -> Real:
    """Of spline surfaces, (n,), on pieces so small that fewer nodes tell the same."""
    for halving in range(_MOST + 1):
        rough, found = (_patches(solid, surface, 2**halving, nodes) for nodes in (_FEWER, _ACROSS))
        if np.abs(rough - found).max() <= _ALIKE * found.max():
            break
    return found


def _patches(solid: Solid, surface: SplineSurface, pieces: int, nodes: int) -> Real:
    rules = [panels(span_shares(knots, pieces), nodes) for knots in (surface.u_knots, surface.v_knots)]
    (u, along), (v, across) = (
        spline_rows(degree, knots, shares, 1)
        for degree, knots, (shares, _) in zip(surface.degrees, (surface.u_knots, surface.v_knots), rules, strict=True)
    )
    (_, u_weights), (_, v_weights) = rules
    total = np.empty(len(surface.poles))
    block = max(1, _AT_ONCE // (len(u_weights) * len(v_weights)))
    for start in range(0, len(total), block):
        part = slice(start, start + block)
        poles = np.moveaxis(solid.points[surface.poles[part]], 3, 0)
        (a, b, c), (d, e, f) = along @ poles @ v.T, u @ poles @ across.T
        sizes = np.sqrt((b * f - c * e) ** 2 + (c * d - a * f) ** 2 + (a * e - b * d) ** 2)
        total[part] = sizes @ v_weights @ u_weights
    return total
