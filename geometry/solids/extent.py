"""How far a solid of faces reaches along the axes and away from the z axis.

Peaks lie at vertices, on bent edges, or inside faces that are bent both ways: sampled, then sought to rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from geometry.base.record import Record
from geometry.curves.curve import Flags, Real
from geometry.solids.charts import TURN, Chart, Patch, along_edges, arcs, charts, edge_rows, patch_of, span_shares
from geometry.solids.faces import Circular, Edges, Faces, Frame, Solid, Sphere, Spline, SplineSurface, Straight, Torus
from geometry.solids.unrolled import Side, unrolled

# samples of an arc, of a span, and of a face along u and v
_SAMPLES, _SPAN = 17, 4
# what a peak may stand above its sample, of the second differences; what is too little to be looked for, of the size
_ABOVE, _ALIKE = 0.2, 1e-9
# how often the places about a peak are tried at most, to what part they are narrowed, and down to what part of the
# samples' steps; how many are tried each way
_ROUNDS, _NARROWED, _SETTLED, _TRIED = 60, 0.5, 1e-6, 9

Places = Callable[[Real, Real], Real]
Held = Callable[[Real, Real], Flags]


class Extent(Record, eq=False):
    """The lower and upper corner (3,) of the box about a solid, and the greatest distance from the z axis, mm."""

    low: Real
    high: Real
    radius: float


class _Piece(Record, eq=False):
    """What may hold peaks: places (u, v, 3) at parameters, some of these, what is measured there, and what is on it."""

    place: Places
    u: Real
    v: Real
    measured: Real
    held: Held | None = None


def extent(solid: Solid) -> Extent:
    """How far a solid reaches."""
    best = _measures(solid.points[solid.vertices]).max(axis=0)
    pieces = [piece for edges in solid.edges for piece in _edges(solid, edges, best)]
    for faces in solid.faces:
        if isinstance(faces.surface, SplineSurface):
            pieces += _patches(solid, faces.surface, best)
        elif isinstance(faces.surface, Torus | Sphere):
            pieces += _bent(solid, faces, best)
    slack = _ALIKE * float(np.abs(best).max())
    seen: set[tuple[int, bytes]] = set()
    for piece in pieces:
        _raise(best, piece, slack, seen)
    return Extent(-best[3:6], best[:3], float(best[6]))


def _measures(points: Real) -> Real:
    """What is to be greatest: (..., 7)."""
    return np.concatenate([points, -points, np.hypot(points[..., :1], points[..., 1:2])], axis=-1)


def _most(measured: Real) -> Real:
    """What may be reached at most by samples (..., u, v, 7) and their second differences: (..., 7)."""
    bend = sum(
        np.abs(np.diff(measured, 2, axis=axis)).max(axis=(-3, -2)) for axis in (-3, -2) if measured.shape[axis] > 2
    )
    return np.asarray(measured.max(axis=(-3, -2)) + _ABOVE * bend)


def _edges(solid: Solid, edges: Edges, best: Real) -> list[_Piece]:
    """The bent edges of a bundle that may reach beyond the best, which their samples raise."""
    curve = edges.curve
    if isinstance(curve, Straight):
        return []
    shares = span_shares(curve.knots, _SPAN) if isinstance(curve, Spline) else np.linspace(0, 1, _SAMPLES)
    measured = _measures(along_edges(solid, edges, shares)[0])[:, :, None]
    best[:] = np.maximum(best, measured.max(axis=(0, 1, 2)))
    if isinstance(curve, Circular):
        best[:6] = np.maximum(best[:6], _peaks(solid, edges))
        # sought are the peaks of the distance from the z axis only, and none of circles about it
        measured[..., :6] = best[:6]
    found = []
    for row in np.flatnonzero(np.any(_most(measured) > best, axis=1)).tolist():
        one = _one(edges, curve, slice(row, row + 1))
        found.append(_Piece(partial(_on_edge, solid, one), shares, np.zeros(1), measured[row]))
    return found


def _peaks(solid: Solid, edges: Edges) -> Real:
    """Of arcs the greatest x, y, z and -x, -y, -z, (6,), where these stand still; -inf where they do nowhere."""
    origin, axes, first, sweep = arcs(solid, edges)
    assert isinstance(edges.curve, Circular)
    found = []
    for sense in (1.0, -1.0):
        at = np.mod(np.arctan2(sense * axes[:, 1], sense * axes[:, 0]) - first[:, None], TURN)
        peak = sense * origin + edges.curve.radius * np.hypot(axes[:, 0], axes[:, 1])
        found.append(np.where(at < sweep[:, None], peak, -np.inf).max(axis=0))
    return np.concatenate(found)


def _one(edges: Edges, curve: Circular | Spline, at: slice) -> Edges:
    """One edge of a bundle."""
    if isinstance(curve, Spline):
        return Edges(edges.start[at], edges.end[at], Spline(curve.degree, curve.knots, curve.poles[at]))
    old = curve.frame
    origin = old.origin if len(old.origin) == 1 else old.origin[at]
    frame = Frame(origin, *(x if len(x) == 1 else x[at] for x in (old.axis, old.zero)))
    return Edges(edges.start[at], edges.end[at], Circular(frame, curve.radius))


def _on_edge(solid: Solid, edge: Edges, u: Real, _: Real) -> Real:
    return along_edges(solid, edge, u)[0][0, :, None]


def _on_patch(patch: Patch, u: Real, v: Real) -> Real:
    return np.asarray(patch.at(u, v)[0])


def _on_chart(chart: Chart, u: Real, v: Real) -> Real:
    return chart.spatial(*np.meshgrid(u, v, indexing="ij"))


def _patches(solid: Solid, surface: SplineSurface, best: Real) -> list[_Piece]:
    """The spline surfaces of a bundle whose poles reach beyond the best."""
    patch, (u, v) = patch_of(solid, surface), (span_shares(k, _SPAN) for k in (surface.u_knots, surface.v_knots))
    found = []
    for row in np.flatnonzero(np.any(_measures(patch.poles).max(axis=(1, 2)) > best, axis=1)).tolist():
        place = partial(_on_patch, patch.rows(slice(row, row + 1)))
        found.append(_Piece(place, u, v, _measures(place(u, v))))
        best[:] = np.maximum(best, found[-1].measured.max(axis=(0, 1)))
    return found


def _bent(solid: Solid, faces: Faces, best: Real) -> list[_Piece]:
    """The faces on tori or spheres that may reach beyond the best."""
    bundle, at = edge_rows(solid)
    shares = np.linspace(0, 1, _SAMPLES)
    runs = {
        k: along_edges(solid, solid.edges[k], shares)[0] for e, _ in faces.loops for k in np.unique(bundle[e]).tolist()
    }
    found = []
    for row, chart in enumerate(charts(solid, faces.surface, len(faces.loops[0][0]))):
        sides: list[Side] = []
        for edges, senses in faces.loops:
            ways = np.broadcast_to(senses, edges.shape)[row].tolist()
            own = [
                runs[bundle[e]][at[e], :: 1 if way else -1] for e, way in zip(edges[row].tolist(), ways, strict=True)
            ]
            sides += unrolled(chart, own, along=faces.along)
        ends = [np.concatenate([s.u for s in sides]), np.concatenate([s.v for s in sides])]
        u, v = (np.linspace(float(x.min()), float(x.max()), _SAMPLES) for x in ends)
        place = partial(_on_chart, chart)
        measured = _measures(place(u, v))
        if np.any(_most(measured) > best):
            found.append(_Piece(place, u, v, measured, partial(_within, sides)))
    return found


def _within(sides: list[Side], u: Real, v: Real) -> Flags:
    """Which places (n,) lie inside their bounds: by how often these pass below them."""
    below = np.zeros(len(u), dtype=np.int64)
    for side in sides:
        # sides go on beyond a turn: between two ends each place of the same angle is passed once
        a, b = np.subtract.outer(side.u, u) / TURN, np.broadcast_to(side.v[:, None], (len(side.v), len(u)))
        turns = np.floor(a)
        with np.errstate(all="ignore"):
            share = (np.maximum(turns[:-1], turns[1:]) - a[:-1]) / np.diff(a, axis=0)
            passed = (turns[1:] != turns[:-1]) & (b[:-1] + share * np.diff(b, axis=0) <= v)
        below += passed.sum(axis=0)
    return below % 2 == 1


def _raise(best: Real, piece: _Piece, slack: float, seen: set[tuple[int, bytes]]) -> None:
    """Raises the best (7,) to a piece's peaks; copies of what was ``seen`` have the same."""
    shape, most = piece.measured.shape[:2], _most(piece.measured)
    on: Flags | None = None
    for k in np.flatnonzero(most > best + slack).tolist():
        own = piece.measured[..., k]
        key = k, np.round(own, 9).tobytes()
        if key in seen:
            continue
        seen.add(key)
        above = float(most[k] - own.max())
        if piece.held is not None:
            if on is None:
                on = _is_held(piece, *(x.ravel() for x in np.meshgrid(piece.u, piece.v, indexing="ij"))).reshape(shape)
            own = np.where(on, own, -np.inf)
        for row, column in _summits(own):
            if own[row, column] + above > best[k] + slack:
                best[k] = max(best[k], _peak(piece, k, row, column))


def _summits(values: Real) -> list[tuple[int, int]]:
    """Places (u, v) that none of their neighbours is above, the highest first.

    Of equally high ones the first and the last: what goes once round has its ends in one place.
    """
    wide = np.pad(values, 1, constant_values=-np.inf)
    rows, columns = values.shape
    around = [wide[i : i + rows, j : j + columns] for i in range(3) for j in range(3)]
    found: dict[float, list[tuple[int, int]]] = {}
    for row, column in np.argwhere((values >= np.max(around, axis=0)) & np.isfinite(values)).tolist():
        found.setdefault(round(float(values[row, column]), 9), []).append((row, column))
    return [
        place
        for height in sorted(found, reverse=True)
        for place in dict.fromkeys((found[height][0], found[height][-1]))
    ]


def _peak(piece: _Piece, k: int, row: int, column: int) -> float:
    """The greatest of one measure about a sample; -inf where its place is not on the piece."""
    ways = piece.u, piece.v
    middle = [float(piece.u[row]), float(piece.v[column])]
    half = [float(np.diff(x).max(initial=0.0)) for x in ways]
    settled = [h * _SETTLED for h in half]
    for _ in range(_ROUNDS):
        tried = [
            np.clip(m + h * np.linspace(-1, 1, _TRIED if h else 1), x[0], x[-1])
            for m, h, x in zip(middle, half, ways, strict=True)
        ]
        found = _measures(piece.place(tried[0], tried[1]))[..., k]
        at = np.unravel_index(int(np.argmax(found)), found.shape)
        middle = [float(x[i]) for x, i in zip(tried, at, strict=True)]
        # a ridge that runs aslant leads out of what was tried: it is followed before this is narrowed
        inside = all(0 < i < len(x) - 1 or x[i] in (way[0], way[-1]) for x, i, way in zip(tried, at, ways, strict=True))
        if inside and all(h <= s for h, s in zip(half, settled, strict=True)):
            break
        half = [h * _NARROWED for h in half] if inside else half
    return float(found.max()) if _is_held(piece, np.array(middle[:1]), np.array(middle[1:]))[0] else -np.inf


def _is_held(piece: _Piece, u: Real, v: Real) -> Flags:
    """Whether places (n,) are on a piece: those at an end are looked at beside it, where digits do not decide."""
    if piece.held is None:
        return np.ones(len(u), dtype=bool)
    ends = [(float(x[0]), float(x[-1]), _ALIKE * float(x[-1] - x[0])) for x in (piece.u, piece.v)]
    return piece.held(*(np.clip(x, a + step, b - step) for x, (a, b, step) in zip((u, v), ends, strict=True)))
