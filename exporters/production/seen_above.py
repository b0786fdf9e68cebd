"""How a part looks from above as it lies: what is round about its axis by its half section, all else by its ends."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from geometry.approximation.chords import approximate_profile
from geometry.base.placement import Placement3
from geometry.curves.line_arc import Line
from geometry.plane.profile import Label, Profile, Segment
from parts.base.part import Part
from parts.scene.half_sections import sectioned
from parts.scene.shapes import shape_of
from parts.scene.standing import Instance

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

    from geometry.curves.curve import Complex, Real

# mm, and its decimals: the places that outlines go by, and how much what touches at a point is made wider
_PLACES = 5
_SAME, _WIDER = 10.0**-_PLACES, 10.0 ** (1 - _PLACES)
# what looks alike in so many parts of a turn has teeth: as it turns it looks as what it sweeps
_TEETH = 8
# mm: what stands less beside the way past it is no corner; decimals of places that are told apart by more
_FLAT, _LINE = 1e-8, 7


def seen_lying(part: Part, instance: Instance, chord: float, *, spins: bool) -> tuple[Profile, float]:
    """Its silhouette about its origin, as the instance is laid and turned, and how far chords are off it, mm.

    Of one that goes about its axis, or ``spins`` and has teeth, whole. ``chord``: what chords may leave, mm.
    """
    import shapely

    made, off = sectioned(part), 0.0
    if made.half is not None:
        rows = made.bands
    else:
        points, off = outer_points(part, chord)
        levels = part.blank(0.0).levels()
        far = float(np.abs(points).max())
        rows = np.array([[levels[0], levels[-1], 0.0, 0.0, far, far]])
    if made.half is not None or (spins and is_round(part)):
        # alike on both sides
        count = 4 * math.ceil(math.pi / math.acos(1 - min(chord / rows[:, 4:].max(), 1.0)) / 4)
        off += float(rows[:, 4:].max()) * (1 - math.cos(math.pi / count))
        seen = shapely.union_all(_cones(rows, instance, count))
    else:
        ends = [np.column_stack([points.real, points.imag, np.full(len(points), z)]) for z in (levels[0], levels[-1])]
        seen = _hull(Placement3.towards(instance.axis, instance.rotation).apply(np.concatenate(ends)))
    # on places that a file's digits hold exactly: slivers of a union cross themselves once they are rounded
    outline = shapely.set_precision(seen, _SAME)
    if outline.geom_type != "Polygon":
        # what touches at a point alone is one outline yet
        outline = shapely.set_precision(outline.buffer(_WIDER, join_style="mitre"), _SAME)
        off += _WIDER
    ring = np.round(shapely.get_coordinates(shapely.orient_polygons(outline).exterior), _PLACES)
    corners = [complex(x, y) for x, y in ring.tolist()]
    return Profile(tuple(Segment(Line(a, b), Label.BODY) for a, b in pairwise(corners))), off + _SAME


def is_round(part: Part) -> bool:
    """Whether what turns about its axis is seen as what it sweeps: it is round, or has teeth."""
    return sectioned(part).half is not None or not 0 < shape_of(part).count(0.0, math.inf) < _TEETH


def outer_points(part: Part, chord: float) -> tuple[Complex, float]:
    """Points of its outer boundary, counter-clockwise, and how far chords between them are off it, mm."""
    outer = approximate_profile(part.section(0.0).region.outer, chord, arcs=False)
    return outer.geometry.expanded()[0], outer.max_error


def _cones(rows: Real, instance: Instance, count: int) -> list[BaseGeometry]:
    """Of a body that is round about its axis the hulls of both ends of each cone, their circles of so many points."""
    way = np.array(instance.axis)
    flat = math.hypot(*way[:2])
    aside = np.array([-way[1], way[0], 0.0]) / flat
    turns = np.arange(count) * (2 * math.pi / count)
    circle = np.cos(turns)[:, None] * aside + np.sin(turns)[:, None] * np.cross(way, aside)
    return [
        _hull(np.concatenate([r * circle + z * way for z, r in ((z0, r0), (z1, r1))]))
        for z0, z1, _, _, r0, r1 in rows.tolist()
    ]


def _hull(points: Real) -> BaseGeometry:
    """Of points seen from above: Andrew's chain. That of GEOS 3.14 loses corners of circles seen edge on."""
    import shapely

    # rounding would put points of one line in any order
    points = np.round(points[:, :2], _LINE)
    rows = points[np.lexsort((points[:, 1], points[:, 0]))].tolist()
    return shapely.Polygon([*_side(rows), *_side(rows[::-1])])


def _side(rows: list[list[float]]) -> list[list[float]]:
    """The right side of a hull on the way from the first point to the last, which is left out."""
    kept: list[list[float]] = []
    for x, y in rows:
        while len(kept) > 1:
            (x0, y0), (x1, y1) = kept[-2:]
            if (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0) > _FLAT * math.hypot(x - x0, y - y0):
                break
            kept.pop()
        kept.append([x, y])
    return kept[:-1]
