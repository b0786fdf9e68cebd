"""A solid as it is seen in rectangular isometry (GOST 2.317): patches of its layers, each over those before it.

The viewer stands at (1, -1, 1): x runs down to the right, y up to the right, z upwards. Solids are told by their
sketches; a layer is seen as its walls, the way of its boundary from end to end, under its nearer end.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Literal

import numpy as np

from geometry.base.placement import Placement3
from geometry.base.record import Record
from geometry.curves.curve import Complex, Curve, Real
from geometry.curves.line_arc import Line
from geometry.solids.sketch import Layer, Ring, Sketch, alike

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

# towards the viewer, to the right and upwards in the picture
TOWARDS = np.array([1.0, -1.0, 1.0]) / math.sqrt(3)
_PLANE = np.array([[1.0, 1.0, 0.0], [-1.0, 1.0, 2.0]]) / np.sqrt([[2.0], [6.0]])
# places at which the bend of a curve is told; what has no area, mm^2
_SAMPLES, _FLAT = 17, 1e-9
# how near two boundaries are one, mm; share of an edge that is all of it; what is thin, in tolerances
_ONE, _ALL, _THIN = 1e-3, 0.999, 12.0


class Patch(Record):
    """What is painted: walls or an end within closed loops, or edges along open lines; points in the picture, mm.

    A face is an end with its edges.
    """

    kind: Literal["wall", "end", "face", "edge"]
    loops: tuple[Complex, ...]


class Picture(Record):
    """A solid about its origin: its patches from behind, and all that it covers."""

    patches: tuple[Patch, ...]
    outline: BaseGeometry
    corners: Real


def seen(points: Real) -> Complex:
    """Places in space (n, 3) in the picture, mm."""
    flat = points @ _PLANE.T
    return flat[:, 0] + 1j * flat[:, 1]


def pictured(sketch: Sketch, laid: Placement3, tolerance: float) -> Picture:
    """A solid laid by ``laid``; arcs within ``tolerance`` mm."""
    import shapely

    way = np.array(laid.rotation)[:, 2] @ TOWARDS
    stack = sketch if way > 0 else sketch.turned_over()
    if way <= 0:
        laid = laid @ Placement3(((1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, -1.0)))
    patches: list[Patch] = []
    shapes: list[BaseGeometry] = []
    places: list[Real] = []
    layers = _merged(stack.layers, _THIN * tolerance)
    high: list[Complex] = []
    for number, layer in enumerate(layers):
        ends = [_both(*rings, layer, laid, tolerance) for rings in zip(layer.lower, layer.upper, strict=True)]
        places += [loop for both in ends for loop in both]
        low, below = [seen(one) for one, _ in ends], high
        high = [seen(two) for _, two in ends]
        if number:
            patches += [*_ended(below, low), *_begun(low, below)]
        shapes.append(shapely.union(_walls(low, high), _filled(high)))
        patches.append(Patch("wall", tuple(loops_of(shapes[-1], tolerance**2))))
    patches += _ended(high, [])
    outline = shapely.union_all(shapes)
    every = np.concatenate(places)
    return Picture(tuple(patches), outline, np.array([every.min(axis=0), every.max(axis=0)]))


def _merged(layers: Sequence[Layer], thin: float) -> list[Layer]:
    """Layers that run on as they are made one, and those that are too thin to be told apart."""
    found: list[Layer] = []
    for layer in layers:
        last = found[-1] if found else layer
        if (
            found
            and _curves(last.lower) == _curves(layer.upper)
            and (
                layer.high - last.low < thin
                or (_is_upright(last) and _is_upright(layer) and _same(last.upper, layer.lower))
            )
        ):
            found[-1] = Layer(last.low, layer.high, last.lower, layer.upper)
        else:
            found.append(layer)
    return found


def _curves(rings: Sequence[Ring]) -> list[int]:
    return [len(ring.curves) for ring in rings]


def _is_upright(layer: Layer) -> bool:
    return layer.upper is layer.lower or _same(layer.lower, layer.upper)


def _same(one: Sequence[Ring], other: Sequence[Ring]) -> bool:
    return len(one) == len(other) and all(map(alike, one, other))


def _both(lower: Ring, upper: Ring, layer: Layer, laid: Placement3, tolerance: float) -> tuple[Real, Real]:
    """The ends of a wall in space, (n, 3) each, point for point."""
    curves = zip(lower.curves, upper.curves, strict=True)
    counts = [max(_count(one, tolerance), _count(two, tolerance)) for one, two in curves]

    def loop(ring: Ring, z: float) -> Real:
        pieces = [c.point(np.linspace(*c.domain, n + 1)[:-1]) for c, n in zip(ring.curves, counts, strict=True)]
        flat = np.concatenate(pieces)
        return laid.apply(np.column_stack([flat.real, flat.imag, np.full(len(flat), z)]))

    return loop(lower, layer.low), loop(upper, layer.high)


def _count(curve: Curve, tolerance: float) -> int:
    """Chords of a curve within a tolerance."""
    if isinstance(curve, Line):
        return 1
    points = np.asarray(curve.point(np.linspace(*curve.domain, _SAMPLES)), dtype=complex)
    turn = float(np.abs(np.angle(np.diff(points)[1:] / np.diff(points)[:-1])).sum())
    length = float(np.abs(np.diff(points)).sum())
    # sagitta of an even bend: length * turn / 8 n^2
    return max(math.ceil(math.sqrt(length * turn / (8 * tolerance))), math.ceil(turn / (math.pi / 2)), 1)


def _walls(low: Sequence[Complex], high: Sequence[Complex]) -> BaseGeometry:
    """What boundaries pass over on their way from one end to the other."""
    import shapely

    sides = [np.stack([a, np.roll(a, -1), np.roll(b, -1), b, a], axis=1) for a, b in zip(low, high, strict=True)]
    corners = np.concatenate(sides)
    quads = shapely.polygons(np.stack([corners.real, corners.imag], axis=-1))
    quads = quads[shapely.area(quads) > _FLAT]
    crossed = ~shapely.is_valid(quads)
    quads[crossed] = shapely.make_valid(quads[crossed])
    return shapely.union_all(quads)


def _ended(loops: Sequence[Complex], after: Sequence[Complex]) -> list[Patch]:
    """The nearer end of a layer, under the next one."""
    edges = _edges(loops, after)
    if sum(map(_length, edges)) > _ALL * sum(_length(np.append(loop, loop[0])) for loop in loops):
        return [Patch("face", tuple(loops))]
    return [Patch("end", tuple(loops)), Patch("edge", edges)] if edges else []


def _begun(loops: Sequence[Complex], before: Sequence[Complex]) -> list[Patch]:
    """The edges in which a layer stands on the one before: what bounds the farthest of all is seen as the outline."""
    return [Patch("edge", edges)] if (edges := _edges(loops, before)) else []


def _length(line: Complex) -> float:
    return float(np.abs(np.diff(line)).sum())


def _edges(loops: Sequence[Complex], others: Sequence[Complex]) -> tuple[Complex, ...]:
    """Boundaries of an end where those of its neighbour do not run on, as open lines."""
    import shapely

    lines = shapely.union_all([shapely.LinearRing(_pairs(loop)) for loop in loops])
    if others:
        known = shapely.union_all([shapely.LinearRing(_pairs(loop)) for loop in others])
        lines = shapely.difference(lines, shapely.buffer(known, _ONE))
    lines = shapely.line_merge(lines)
    found = (np.asarray(part.coords) for part in shapely.get_parts(lines) if part.length > 2 * _ONE)
    return tuple(places[:, 0] + 1j * places[:, 1] for places in found)


def _filled(loops: Sequence[Complex]) -> BaseGeometry:
    """Within an odd number of loops."""
    import shapely

    return shapely.build_area(shapely.GeometryCollection([shapely.LinearRing(_pairs(loop)) for loop in loops]))


def loops_of(shape: BaseGeometry, least: float) -> Iterator[Complex]:
    """All boundaries of what is filled about at least so much, mm^2."""
    import shapely

    for part in shapely.get_parts(shape):
        if isinstance(part, shapely.Polygon):
            for ring in (part.exterior, *part.interiors):
                if shapely.Polygon(ring).area > least:
                    places = np.asarray(ring.coords)[:-1]
                    yield places[:, 0] + 1j * places[:, 1]


def _pairs(points: Complex) -> Real:
    return np.column_stack([points.real, points.imag])
