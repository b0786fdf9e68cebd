"""Volume, centre and inertia of solids of faces by the divergence theorem, face by face.

Over a plane or a surface of revolution the integral of g du dv is that of -G du round the bounds (Green), G the
integral of g over v; by Gauss's rule on pieces short enough that the rest is rounding. Splines and extrusions are
integrated over between their four edges, where the rule is exact.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from geometry.base.errors import ConvergenceError
from geometry.base.gauss import gauss_rule, panels
from geometry.base.record import Record
from geometry.curves.curve import Real
from geometry.solids.charts import (
    SHORT_ARC,
    Chart,
    along_edges,
    charts,
    edge_rows,
    patch_of,
    smooth_shares,
    span_shares,
)
from geometry.solids.faces import Circular, Edges, Extrusion, Solid, Spline, SplineSurface, Torus
from geometry.solids.mass import Moments, moments_of
from geometry.solids.unrolled import unrolled

# nodes on a piece of an edge and across a face
_NODES, _ACROSS, _FLAT = 16, 28, 4
# moments of a polynomial patch of degree p have degree 5 p - 1
_RAISED, _AT_ONCE = 2.5, 200_000
# pieces are halved until nothing changes by more than this part, and refused above the second one
_SETTLED, _ENOUGH, _MOST = 1e-12, 1e-9, 4
# rounding of the shares of faces that are added up: of a thin wall their sum is far smaller than they are
_ROUNDING = 2e-14
# a tube is far wider than what a face has of it is off the axis, by this
_FAR = 3.0
# integrals of 1, x, y, z, and of xx, yy, xy, zz, xz, yz, told by both factors; their parts of what flows through
_SQUARES = [0, 1, 0, 2, 0, 1], [0, 1, 1, 2, 2, 2]
_PARTS = np.repeat([3.0, 4.0, 5.0], [1, 3, 6])


def face_moments(solid: Solid) -> Moments:
    """Of a closed solid; nodes on its edges are doubled until the integrals stay.

    Raises
    ------
    ConvergenceError
        They do not settle.
    """
    patches = [
        _patches(solid, faces.surface, along=faces.along)
        for faces in solid.faces if isinstance(faces.surface, SplineSurface)
    ]  # fmt: skip
    total, _ = _total(solid, 1, patches)
    for halving in range(1, _MOST + 1):
        finer, shares = _total(solid, 2**halving, patches)
        scale = np.abs(finer).max() + abs(finer[0])
        change, total = float((np.abs(finer - total).max() - _ROUNDING * shares.max()) / scale), finer
        if change <= _SETTLED:
            break
    if not change <= _ENOUGH:
        raise ConvergenceError("moments of a solid", change, _MOST)
    return moments_of(total)


def _total(solid: Solid, pieces: int, patches: Sequence[Real]) -> tuple[Real, Real]:
    """The integrals, and the sums of the sizes of what they are added up from; those of splines know no pieces."""
    samples = [_samples(solid, edges, pieces) for edges in solid.edges]
    bundle, row = edge_rows(solid)
    shares, whole = [], iter(patches)
    for faces in solid.faces:
        if isinstance(faces.surface, SplineSurface):
            shares.append(next(whole))
            continue
        rows = len(faces.loops[0][0])
        found = None if isinstance(faces.surface, Extrusion) else charts(solid, faces.surface, rows)
        for face in range(rows):
            loops = []
            for edges, senses in faces.loops:
                ways = np.broadcast_to(senses, edges.shape)[face].tolist()
                own = [(samples[bundle[e]], row[e], way) for e, way in zip(edges[face].tolist(), ways, strict=True)]
                loops.append([sample.run(at, forwards=way) for sample, at, way in own])
            share = _ruled(loops[0]) if found is None else _charted(found[face], loops, along=faces.along)
            shares.append(share)
    return np.sum(shares, axis=0), np.sum(np.abs(shares), axis=0)


class _Samples(Record, eq=False):
    """Points and derivatives (n, k, 3) of a bundle of edges, or (k, 3) along one, and weights (k,), 0 at both ends."""

    points: Real
    steps: Real
    weights: Real
    straight: bool

    def run(self, row: int, *, forwards: bool) -> _Samples:
        """One of the edges as a loop runs along it."""
        way = 1 if forwards else -1
        points, steps = self.points[row, ::way], way * self.steps[row, ::way]
        return _Samples(points, steps, self.weights[::way], self.straight)


def _samples(solid: Solid, edges: Edges, pieces: int) -> _Samples:
    curve = edges.curve
    nodes, weights = panels(smooth_shares(solid, edges, pieces), _NODES)
    shares = np.concatenate([[0.0], nodes, [1.0]])
    points, steps = along_edges(solid, edges, shares)
    return _Samples(points, steps, np.concatenate([[0.0], weights, [0.0]]), not isinstance(curve, Circular | Spline))


def _integrals(points: Real, normals: Real, weights: Real) -> Real:
    """Over points and normals (..., 3), whose sizes are those of the surface elements, with weights (...): the ten."""
    (x, y, z), (a, b, c) = ((p[..., 0], p[..., 1], p[..., 2]) for p in (points, normals))
    flux = ((x * a + y * b + z * c) * weights).ravel()
    places = np.array([x.ravel(), y.ravel(), z.ravel()])
    first = places * flux
    one, other = _SQUARES
    # pairwise sums: a product of matrices rounds as the processor likes
    sums = np.add.reduce(np.concatenate([flux[None], first, first[one] * places[other]]), axis=1)
    return sums / _PARTS


def _charted(chart: Chart, loops: list[list[_Samples]], *, along: bool) -> Real:
    across, weights = gauss_rule(_ACROSS if chart.is_bent else _FLAT)
    base, inner = _base(chart, loops), slice(1, -1)
    sides, runs, poles = [], [], []
    for loop in loops:
        for side in unrolled(chart, [run.points for run in loop], along=along):
            if side.run is None:
                count = max(1, math.ceil(abs(side.u[-1] - side.u[0]) / SHORT_ARC))
                shares, steps = panels(np.linspace(0, 1, count + 1), _NODES)
                length = side.u[-1] - side.u[0]
                poles.append((side.u[0] + length * shares, np.full(len(shares), side.v[0]), steps * length))
            else:
                run = loop[side.run]
                sides.append((side.u[inner], side.v[inner]))
                runs.append((run.points[inner], run.steps[inner], run.weights[inner]))
    (u, v), (points, steps, shares) = (map(np.concatenate, zip(*rows, strict=True)) for rows in (sides, runs))
    dx, dy, _ = (steps @ chart.axes.T).T
    if not chart.is_plane:
        x, y, _ = ((points - chart.origin) @ chart.axes.T).T
        dx = (x * dy - y * dx) / (x * x + y * y)
    u, v, step = map(np.concatenate, zip((u, v, dx * shares), *poles, strict=True))
    # along a meridian nothing is swept
    swept = step != 0
    u, v, step = u[swept], v[swept], step[swept]
    heights = base + (v[:, None] - base) * (1 + across) / 2
    return -_integrals(*chart.with_normal(u[:, None], heights), (step * (v - base))[:, None] * (weights / 2))


def _base(chart: Chart, loops: list[list[_Samples]]) -> float:
    """The v that integrals over v begin at: 0, or of a tube far wider than its face is off the axis one of the face.

    Between 0 and such a face the tube sweeps so much more than the face does that no digits of this were left.
    """
    points = loops[0][0].points
    x, y, _ = ((points - chart.origin) @ chart.axes.T).T
    if not isinstance(chart.surface, Torus) or chart.surface.tube < _FAR * float(np.hypot(x, y).min()):
        return 0.0
    return float(chart.flat(points[0])[1])


def _ruled(runs: list[_Samples]) -> Real:
    """Between two copies of a curve, which the loop runs the first of."""
    first = 0 if not (runs[0].straight and runs[2].straight) else 1
    low, high = runs[first], runs[first + 2]
    nodes, weights = gauss_rule(_FLAT)
    t = (1 + nodes)[:, None, None] / 2
    points = (1 - t) * low.points + t * high.points[::-1]
    steps = (1 - t) * low.steps - t * high.steps[::-1]
    normals = np.cross(steps, high.points[::-1] - low.points)
    return _integrals(points, normals, (weights / 2)[:, None] * low.weights)


def _patches(solid: Solid, surface: SplineSurface, *, along: bool) -> Real:
    patch = patch_of(solid, surface)
    rules = [
        panels(span_shares(knots), math.ceil(_RAISED * degree))
        for degree, knots in zip(surface.degrees, (surface.u_knots, surface.v_knots), strict=True)
    ]
    (u, u_weights), (v, v_weights) = rules
    total, block = np.zeros(len(_PARTS)), max(1, _AT_ONCE // (len(u) * len(v)))
    for start in range(0, len(patch.poles), block):
        own = patch.rows(slice(start, start + block))
        normals = np.cross(own.at(u, v, (1, 0)), own.at(u, v, (0, 1)))
        total += _integrals(own.at(u, v), normals, u_weights[:, None] * v_weights)
    return total if along else -total
