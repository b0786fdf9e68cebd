"""How far points lie from spline surfaces between their ends: Newton's steps from the nearest node of a grid.

Points that are far off are told by that node, or by the middle of the surface: their distance is too large, by less
than half of it.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from geometry.curves.curve import Real
from geometry.solids.charts import Patch, span_shares

# nodes on a span each way, steps, points at a time, and pairs of points and nodes
_NODES, _STEPS, _AT_ONCE, _PAIRS = 6, 12, 2_000, 1_000_000
# by which a step must bring a point nearer or farther, mm
_SETTLED = 1e-11
# points farther off than so many radii, or steps of the grid, are not looked at more closely
_FAR, _OFF = 3.0, 4.0


def patch_distance(patch: Patch) -> Callable[[Real], Real]:
    """The distance of points (n, 3) from one spline surface, mm."""
    shares = span_shares(patch.surface.u_knots, _NODES), span_shares(patch.surface.v_knots, _NODES)
    grid = patch.at(*shares)[0]
    step = max(float(np.linalg.norm(np.diff(grid, axis=axis), axis=2).max()) for axis in (0, 1))
    nodes = grid.reshape(-1, 3)
    places = np.stack(np.meshgrid(*shares, indexing="ij"), axis=-1).reshape(-1, 2)
    middle = nodes.mean(axis=0)
    reach = float(np.linalg.norm(nodes - middle, axis=1).max())
    # squares of distances but for what all nodes have in common
    table, block = np.vstack([-2 * nodes.T, np.sum(nodes**2, axis=1)]), max(1, _PAIRS // len(nodes))

    def distance(points: Real) -> Real:
        found = np.linalg.norm(points - middle, axis=1)
        near = np.flatnonzero(found <= _FAR * reach)
        for start in range(0, len(near), _AT_ONCE):
            mine = near[start : start + _AT_ONCE]
            at = points[mine]
            rows = np.column_stack([at, np.ones(len(at))])
            first = np.concatenate([(rows[k : k + block] @ table).argmin(axis=1) for k in range(0, len(rows), block)])
            away = np.linalg.norm(at - nodes[first], axis=1)
            close = away <= _OFF * step
            if np.any(close):
                away[close] = _foot(patch, at[close], places[first[close]])
            found[mine] = away
        return found

    return distance


def _foot(patch: Patch, points: Real, at: Real) -> Real:
    """The least distance on the way from shares (n, 2) to the feet of points."""
    best, last, goes = np.full(len(points), np.inf), np.full(len(points), np.inf), np.arange(len(points))
    for _ in range(_STEPS):
        place, du, dv = (x[0] for x in patch.scattered(at))
        off = points[goes] - place
        away = np.linalg.norm(off, axis=1)
        best[goes] = np.minimum(best[goes], away)
        moves = np.abs(away - last) > _SETTLED
        if not np.any(moves):
            break
        # those that stand at their feet are left there: some in a hollow take many more steps
        goes, last, at, off, du, dv = (x[moves] for x in (goes, away, at, off, du, dv))
        a, b, c = np.sum(du * du, -1), np.sum(du * dv, -1), np.sum(dv * dv, -1)
        p, q = np.sum(off * du, -1), np.sum(off * dv, -1)
        # at an end of the surface the foot goes along it
        towards = np.stack([p, q], axis=1)
        held = ((at <= 0) & (towards < 0)) | ((at >= 1) & (towards > 0))
        det = np.maximum(a * c - b * b, 1e-300)
        step = np.stack([(c * p - b * q) / det, (a * q - b * p) / det], axis=1)
        step[held[:, 0], 1] = (q / np.maximum(c, 1e-300))[held[:, 0]]
        step[held[:, 1], 0] = (p / np.maximum(a, 1e-300))[held[:, 1]]
        at = np.clip(at + np.where(held, 0.0, step), 0.0, 1.0)
    return best
