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
from parts.scene.half_sections import Sectioned
from parts.scene.placing import Instance

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

    from geometry.curves.curve import Real

# points of a circle; mm: what chords leave of an outline; decimals, and mm, of the places that outlines go by
_ROUND, _CHORD, _PLACES = 1440, 1e-3, 5
_SAME = 10.0**-_PLACES
# mm: what stands less beside the way past it is no corner
_FLAT = 1e-8


def seen_lying(part: Part, instance: Instance) -> Profile:
    """Its silhouette about its origin, as the instance is laid and turned; of one that goes about its axis, whole."""
    import shapely

    made = Sectioned(part)
    seen = shapely.union_all(_cones(made, instance) if made.half is not None else [_ends(part, instance)])
    # on places that a file's digits hold exactly: slivers of a union cross themselves once they are rounded
    outline = shapely.set_precision(seen, _SAME)
    if outline.geom_type != "Polygon":
        # what touches at a point alone is one outline yet
        outline = shapely.set_precision(outline.buffer(10 * _SAME, join_style="mitre"), _SAME)
    ring = np.round(shapely.get_coordinates(shapely.orient_polygons(outline).exterior), _PLACES)
    corners = [complex(x, y) for x, y in ring.tolist()]
    return Profile(tuple(Segment(Line(a, b), Label.BODY) for a, b in pairwise(corners)))


def _cones(made: Sectioned, instance: Instance) -> list[BaseGeometry]:
    """Of a body that is round about its axis the hulls of both ends of each cone."""
    way = np.array(instance.axis)
    flat = math.hypot(*way[:2])
    aside = np.array([-way[1], way[0], 0.0]) / flat
    turns = np.arange(_ROUND) * (2 * math.pi / _ROUND)
    circle = np.cos(turns)[:, None] * aside + np.sin(turns)[:, None] * np.cross(way, aside)
    rows = made.bands
    return [
        _hull(np.concatenate([r * circle + z * way for z, r in ((z0, r0), (z1, r1))]))
        for z0, z1, _, _, r0, r1 in rows.tolist()
    ]


def _ends(part: Part, instance: Instance) -> BaseGeometry:
    """The hull of both ends of its outer boundary."""
    outer = approximate_profile(part.section(0.0).region.outer, _CHORD, arcs=False).geometry.expanded()[0]
    levels = part.body(0.0).levels()
    ends = [np.column_stack([outer.real, outer.imag, np.full(len(outer), z)]) for z in (levels[0], levels[-1])]
    return _hull(Placement3.towards(instance.axis, instance.rotation).apply(np.concatenate(ends)))


def _hull(points: Real) -> BaseGeometry:
    """Of points seen from above: Andrew's chain. That of GEOS 3.14 loses corners of circles seen edge on."""
    import shapely

    rows = points[np.lexsort((points[:, 1], points[:, 0])), :2].tolist()
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
