"""Hatching of sections: lines at 45 degrees between closed loops; GOST 2.306."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from geometry.approximation.outline import CadCurve
from geometry.curves.line_arc import Line

# samples of what is not straight; a line runs at least so far off a corner, parts of the spacing
_SAMPLES, _OFF = 65, 0.381966
_TURN = np.exp(-0.25j * np.pi)


def hatching(loops: Sequence[Sequence[CadCurve]], spacing: float, *, falls: bool = False) -> list[Line]:
    """Lines at 45 degrees, ``spacing`` apart, where an odd number of loops is crossed; rising, or falling."""
    if falls:
        # what is mirrored runs the other way round
        over = [[curve.mirrored() for curve in reversed(loop)] for loop in loops]
        return [line.mirrored() for line in hatching(over, spacing)]
    edges = []
    for loop in loops:
        points = np.concatenate([c.point(np.linspace(*c.domain, 2 if isinstance(c, Line) else _SAMPLES)) for c in loop])
        # lines of hatching lie along x here
        edges.append(np.stack([points, np.roll(points, -1)]) * _TURN)
    if not edges:
        return []
    start, end = np.concatenate(edges, axis=1)
    low, high = min(start.imag.min(), end.imag.min()), max(start.imag.max(), end.imag.max())
    found = []
    for k in range(int(np.floor(low / spacing)), int(np.ceil(high / spacing)) + 1):
        level = (k + _OFF) * spacing
        crossed = (start.imag > level) != (end.imag > level)
        a, b = start[crossed], end[crossed]
        places = np.sort((a + (b - a) * (level - a.imag) / (b.imag - a.imag)).real)
        for left, right in list(pairwise(places.tolist()))[::2]:
            ends = [complex(x, level) * np.conj(_TURN) for x in (left, right)]
            if right - left > _OFF * spacing:
                found.append(Line(complex(ends[0]), complex(ends[1])))
    return found
