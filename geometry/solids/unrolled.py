"""The bounds of a face unrolled into the plane of its surface's parameters.

Angles go on beyond a turn, so that a seam lies at both ends of it; at a pole, where all angles meet in one point, a
side of no length in space leads on.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from geometry.base.record import Record
from geometry.curves.curve import Real
from geometry.solids.charts import TURN, Chart
from geometry.solids.faces import Cone, Sphere

# distance from the axis at which a point stands on it, part of the size of the surface
_POLE = 1e-9


class Side(Record, eq=False):
    """u and v (k,) along a part of a loop: the number of its ``run`` of points, or None at a pole."""

    u: Real
    v: Real
    run: int | None


def unrolled(chart: Chart, runs: Sequence[Real], *, along: bool) -> list[Side]:
    """The sides of one loop given by points (k, 3) along its edges, both ends among them, as the loop runs.

    ``along``: the surface's normals point out of the material, so that the loop runs counter-clockwise in u and v.
    """
    found: list[Side] = []
    for number, points in enumerate(runs):
        u, v = chart.flat(points)
        if not chart.is_plane:
            for inner, end in ((1, 0), (-2, -1)):
                if _at_pole(chart, points[end]):
                    u[end] = u[inner]
            u = _without_jumps(u)
            if chart.is_bent:
                v = _without_jumps(v)
        if found and not chart.is_plane:
            u, v = _joined(chart, found, points[0], u, v, along=along)
        found.append(Side(u, v, number))
    if not chart.is_plane and _at_pole(chart, runs[0][0]):
        _joined(chart, found, runs[0][0], found[0].u, found[0].v, along=along)
    return found


def _joined(chart: Chart, found: list[Side], corner: Real, u: Real, v: Real, *, along: bool) -> tuple[Real, Real]:
    """The next side moved by whole turns to where the last one ends; at a pole with a side between."""
    end, height = float(found[-1].u[-1]), float(found[-1].v[-1])
    if not _at_pole(chart, corner):
        v = v + TURN * np.round((height - v[0]) / TURN) if chart.is_bent else v
        return u + TURN * np.round((end - u[0]) / TURN), v
    above = isinstance(chart.surface, Sphere) and height > 0
    way = -1.0 if above == along else 1.0
    step = float(np.mod(way * (u[0] - end), TURN))
    # back along the seam on which it came: all the way round
    step = TURN if step < _POLE or step > TURN - _POLE else step
    found.append(Side(np.array([end, end + way * step]), np.full(2, height), None))
    return u + (end + way * step - u[0]), v


def _without_jumps(angles: Real) -> Real:
    """Neighbours less than half a turn apart; few are not, and to see that costs a tenth of ``unwrap``."""
    return angles if (np.abs(angles[1:] - angles[:-1]) < TURN / 2).all() else np.unwrap(angles)


def _at_pole(chart: Chart, point: Real) -> bool:
    if not isinstance(chart.surface, Sphere | Cone):
        return False
    away = point - chart.origin
    x, y, _ = (away @ chart.axes.T).tolist()
    return math.hypot(x, y) <= _POLE * max(chart.surface.radius, *map(abs, away.tolist()))
