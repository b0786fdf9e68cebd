"""The order in which the contours of a board are cut: engraved first, what lies within another before it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from geometry.curves.curve import Complex
from geometry.plane.contour import Approximation, Contour

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

# of half a turn
_CHORDS = 20
_ENGRAVED, _INNER, _OUTER = "ENGRAVE", "CUT_INNER", "CUT_OUTER"


def in_order(rows: Iterable[tuple[str, Approximation]]) -> tuple[tuple[str, ...], tuple[Approximation, ...]]:
    """Layers and boundaries in the order of cutting.

    A piece that lies in a hole of another is cut before that hole, on the layer of inner contours: a program that goes
    by layers, too, must not let it fall before it is cut. Contours of one layer and depth follow each other by the
    shortest way from the last one, beginning in the corner of the board.
    """
    found = list(rows)
    depths = _depths([b for _, b in found])
    layers = [_INNER if layer == _OUTER and depth else layer for (layer, _), depth in zip(found, depths, strict=True)]
    order: list[int] = []
    at = 0j
    for layer in (_ENGRAVED, _INNER, _OUTER):
        own = [i for i, name in enumerate(layers) if name == layer]
        for depth in sorted({depths[i] for i in own}, reverse=True):
            group = [i for i in own if depths[i] == depth]
            starts = np.array([found[i][1].geometry.vertices[0] for i in group])
            way, at = nearest_next(starts, at)
            order += [group[k] for k in way]
    return tuple(layers[i] for i in order), tuple(found[i][1] for i in order)


def nearest_next(points: Complex, at: complex) -> tuple[list[int], complex]:
    """All points (n,), each time the nearest that is left; and where that ends."""
    left, way = np.ones(len(points), dtype=bool), []
    for _ in points:
        distance = np.where(left, np.abs(points - at), np.inf)
        way.append(int(distance.argmin()))
        left[way[-1]], at = False, complex(points[way[-1]])
    return way, at


def _depths(boundaries: Sequence[Approximation]) -> list[int]:
    """How many others each boundary lies in: boundaries do not cross, so the boxes and one point of each tell."""
    import shapely

    rings = [boundary.geometry for boundary in boundaries]
    boxes = [ring.box() for ring in rings]
    low, high = np.array([a for a, _ in boxes]), np.array([b for _, b in boxes])
    first = np.array([ring.expanded()[0][0] for ring in rings])
    depths = [0] * len(rings)
    for index in range(len(rings)):
        within = (low[index].real < low.real) & (low[index].imag < low.imag)
        within &= (high[index].real > high.real) & (high[index].imag > high.imag)
        inside = np.flatnonzero(within)
        if not len(inside):
            continue
        held = shapely.contains_xy(_polygon(rings[index]), first[inside].real, first[inside].imag)
        for k in inside[held]:
            depths[k] += 1
    return depths


def _polygon(contour: Contour) -> BaseGeometry:
    """A contour by chords, the more the longer its arcs are."""
    import shapely

    sweep = 4 * float(np.arctan(np.abs(contour.bulges)).max())
    points = contour.sampled(1 + math.ceil(_CHORDS / (2 * math.pi) * sweep))
    return shapely.Polygon(np.stack([points.real, points.imag], axis=1))
