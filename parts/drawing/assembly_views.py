"""Views of an assembly: what is seen along its axes, without what is covered, and a section through them.

A view's frame has x to the right, y up and z towards the viewer. Parts stand in it with their axes towards the viewer
or in its plane; teeth are circles (GOST 2.402).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from itertools import pairwise
from typing import TypeVar

import numpy as np

from geometry.base.errors import ParameterError
from geometry.base.placement import Placement2, Placement3
from geometry.base.record import Record
from geometry.curves.curve import Complex, Curve, Real
from geometry.curves.line_arc import Arc, Line
from geometry.plane.measure import distance_to_curve
from geometry.solids.sketch import Layer, Ring, Sketch, crossing, hatched, reaching, round_ring, stacked
from parts.drawing.revolved import closed
from parts.drawing.shown import SAMPLES, shown_pieces
from parts.drawing.working import AXIS, VISIBLE

# what is parallel, what is one place, mm
_PARALLEL, _SAME, _DIGITS = 1e-9, 1e-6, 6
# digits of places, mm, that a drawing tells apart
_PAPER = 4
# places that are tried for a leader's end, across a part
_GRID, _FEW, _ENOUGH = 17, 12, 48
T = TypeVar("T")
Stroke = tuple[str, Curve]
Spot = tuple[complex, float]


class Shown(Record, dict=True):
    """An instance that is drawn: of which part, what of it, and where it stands in the frame of the view; and what it
    hides there.
    """

    id: str
    part: str
    sketch: Sketch
    place: Placement3

    @property
    def axis(self) -> tuple[float, float, float]:
        """Its axis in the view."""
        return self.place.z

    @property
    def centre(self) -> complex:
        """Its origin in the view's plane, mm."""
        return complex(self.place.translation[0], self.place.translation[1])

    @property
    def depth(self) -> float:
        """Of its origin, towards the viewer, mm."""
        return self.place.translation[2]

    @property
    def stands(self) -> bool:
        """Whether its axis points at the viewer or away."""
        return abs(self.axis[2]) > 1 - _PARALLEL

    @cached_property
    def faced(self) -> tuple[Sketch, Placement2]:
        """The sketch of one that stands, its upper side to the viewer, and how its plane lies in the view's."""
        sketch = self.sketch if self.axis[2] > 0 else self.sketch.turned_over()
        return sketch, Placement2(self.place.turn, self.centre)

    @property
    def along(self) -> complex:
        """The axis of one that lies, in the view's plane."""
        return complex(self.axis[0], self.axis[1])

    def flat(self, view: complex) -> complex:
        """A direction of the view's plane across the axis of one that lies, in the part's plane."""
        back = np.array(self.place.rotation).T @ [view.real, view.imag, 0.0]
        return complex(back[0], back[1])

    def laid(self, point: complex) -> complex:
        """A point s + iz of a plane along the axis of one that lies, in the view."""
        return self.centre + self.along * (point.imag - 1j * point.real)

    @cached_property
    def reach(self) -> tuple[float, float]:
        """How far it reaches from its origin in the view, and its highest place, mm."""
        if not self.stands:
            return float(np.abs(self.silhouette.points - self.centre).max()), self.depth
        sketch = self.faced[0]
        rings = [ring for layer in sketch.layers for ring in (*layer.lower, *layer.upper)]
        return max(float(np.abs(ring.points).max()) for ring in rings), sketch.layers[-1].high + self.depth

    @property
    def tall(self) -> float:
        """From its lowest to its highest place, mm."""
        layers = self.sketch.layers
        return layers[-1].high - layers[0].low if self.stands else 0.0

    def hides(self, points: Complex, heights: np.ndarray | float) -> np.ndarray:
        """Whether it stands before points of the view's plane at heights."""
        reach, top = self.reach
        found = np.zeros(len(points), dtype=bool)
        near = (np.abs(points - self.centre) <= reach + _SAME) & (np.asarray(heights) < top - _SAME)
        if not near.any():
            return found
        if not self.stands:
            found[near] = self.silhouette.holds(points[near])
            return found
        sketch, placement = self.faced
        places = np.asarray(placement.inverse().apply(points[near]))
        levels = np.broadcast_to(heights - self.depth, points.shape)[near]
        inner = np.zeros(len(places), dtype=bool)
        for level in np.unique(levels):
            inner[levels == level] = sketch.covers(places[levels == level], float(level))
        found[near] = inner
        return found

    @cached_property
    def silhouette(self) -> Ring:
        """The outline of one that lies."""
        cuts = reaching(self.flat(-1j * self.along))
        sides: list[complex] = []
        back: list[complex] = []
        for layer in self.sketch.layers:
            for z, rings in ((layer.low, layer.lower), (layer.high, layer.upper)):
                if ends := cuts(rings):
                    sides.append(self.laid(complex(ends[1], z)))
                    back.append(self.laid(complex(ends[0], z)))
        return Ring(closed([*sides, *back[::-1]], _SAME))

    @cached_property
    def places(self) -> Complex:
        """Points all over it, in the view."""
        layers, place = self._upper
        all_points = np.concatenate([ring.points for layer in layers for ring in layer])
        x, y = (np.linspace(a.min(), a.max(), _GRID + 2)[1:-1] for a in (all_points.real, all_points.imag))
        grid = (x[:, None] + 1j * y[None, :]).ravel()
        inside = np.zeros(len(grid), dtype=bool)
        for layer in layers:
            inside |= np.sum([ring.holds(grid) for ring in layer], axis=0) % 2 == 1
        return np.asarray(place.apply(grid[inside]))

    @property
    def _upper(self) -> tuple[list[tuple[Ring, ...]], Placement2]:
        """The upper rings of its layers, or its outline, and how their plane lies in the view."""
        if not self.stands:
            return [(self.silhouette,)], Placement2()
        sketch, placement = self.faced
        return [layer.upper for layer in sketch.layers], placement

    def top(self, points: Complex) -> np.ndarray:
        """Height of its highest place at points that are on it."""
        if not self.stands:
            return np.full(len(points), self.depth)
        sketch, placement = self.faced
        places = np.asarray(placement.inverse().apply(points))
        found = np.full(len(points), -np.inf)
        for layer in reversed(sketch.layers):
            left = np.flatnonzero(found == -np.inf)
            if not len(left):
                break
            found[left[layer.at_high.hold(places[left])]] = layer.high
        return np.asarray(found + self.depth)


class Drawn(Record):
    """What a view has of an assembly, model mm: lines by layer, hatched loops and axes by part, places on parts.

    ``spots``: for each part, points on it that are seen with their distance from all lines, the farthest first.
    """

    strokes: tuple[Stroke, ...]
    hatched: tuple[tuple[tuple[Line | Arc, ...], ...], ...]
    axes: tuple[Line, ...]
    spots: dict[str, tuple[Spot, ...]]


def seen(shown: Sequence[Shown], view: Placement3) -> list[Shown]:
    """Instances in the frame of a view.

    Raises
    ------
    ParameterError
        An axis is oblique to the view.
    """
    found = [Shown(one.id, one.part, one.sketch, view @ one.place) for one in shown]
    for one in found:
        if not one.stands and abs(one.axis[2]) > _PARALLEL:
            raise ParameterError("purpose", "assembly", "assembly_axis_oblique", instance=one.id)
    return found


def along_axes(shown: Sequence[Shown]) -> Drawn:
    """What is seen, each line as far as nothing stands before it."""
    strokes: list[Stroke] = []
    axes: list[Line] = []
    covers = _Covers(tuple(shown))
    for one in shown:
        edges = [piece for height, curve in _edges(one) for piece in _visible(curve, height, one, covers)]
        if not edges:
            continue
        strokes += [(VISIBLE, piece) for piece in edges]
        top = _height(one)
        for layer, curve in _pitches(one):
            strokes += [(layer, piece) for piece in _visible(curve, top, one, covers)]
        axes += _axes(one)
    lines = _Lines(strokes)
    spots: dict[str, tuple[Spot, ...]] = {}
    for one in shown:
        if len(spots.get(one.part, ())) >= _ENOUGH:
            continue
        found = one.places
        for other in covers.near(found, one.reach[1] - one.tall) if len(found) else ():
            if other is not one:
                found = found[~other.hides(found, one.top(found))]
        spots[one.part] = (*spots.get(one.part, ()), *_farthest(found, lines.room(found, one.centre, one.reach[0])))
    return Drawn(_once(strokes, _stroke_place), (), _once(axes, _place), spots)


class _Covers(Record, dict=True):
    """All that hides in a view."""

    all: tuple[Shown, ...]

    @cached_property
    def _rounds(self) -> tuple[Complex, np.ndarray, np.ndarray]:
        """Centres, reaches and tops."""
        reaches = np.array([one.reach for one in self.all])
        return np.array([one.centre for one in self.all]), reaches[:, 0], reaches[:, 1]

    def near(self, points: Complex, height: float) -> list[Shown]:
        """Those that may stand before points at a height."""
        centres, reaches, tops = self._rounds
        middle = (points.real.min() + points.real.max()) / 2 + 0.5j * (points.imag.min() + points.imag.max())
        radius = np.abs(points - middle).max()
        may = (np.abs(centres - middle) <= reaches + radius + _SAME) & (tops > height + _SAME)
        return [self.all[k] for k in np.flatnonzero(may)]


def _edges(one: Shown) -> Iterator[tuple[float, Curve]]:
    """The lines of an instance, with their heights."""
    if one.stands:
        sketch, placement = one.faced
        for height, ring in sketch.edges():
            yield from ((height + one.depth, curve) for curve in _placed(ring, placement))
        return
    cuts = reaching(one.flat(-1j * one.along))
    for line in stacked(one.sketch.layers, cuts, one.sketch.creases):
        yield one.depth, Line(one.laid(line.start), one.laid(line.end))


def _placed(ring: Ring, placement: Placement2) -> list[Curve]:
    """A boundary in the view; files know no place at which a circle begins."""
    if (found := ring.circle) is not None:
        return [Arc(placement.apply(found[0]), found[1], 0.0, 2 * math.pi)]
    return [curve.placed(placement) for curve in ring.curves]


def _pitches(one: Shown) -> Iterator[Stroke]:
    """Pitch circle, or pitch lines along the teeth."""
    pitch = one.sketch.pitch
    if pitch is None:
        return
    if one.stands:
        yield AXIS, Arc(one.centre, pitch, 0.0, 2 * math.pi)
        return
    low, high = _toothed(one.sketch)
    start, end = one.sketch.pitch_cone or (complex(pitch, low), complex(pitch, high))
    for side in (1, -1):
        yield AXIS, Line(*(one.laid(complex(side * p.real, p.imag)) for p in (start, end)))


def _height(one: Shown) -> float:
    """Of the upper end of its teeth, or of its axis."""
    if not one.stands or one.sketch.pitch is None:
        return one.depth
    return _toothed(one.faced[0])[1] + one.depth


def _toothed(sketch: Sketch) -> tuple[float, float]:
    """From where to where along the axis teeth stand, mm."""
    found = [k for k in sketch.layers if any(ring.root is not None for ring in k.lower)]
    return found[0].low, found[-1].high


def _axes(one: Shown) -> Iterator[Line]:
    """A cross of axes, or the axis."""
    if not one.stands:
        layers = one.sketch.layers
        yield Line(one.laid(1j * layers[0].low), one.laid(1j * layers[-1].high))
        return
    outer = [ring.circle for layer in one.sketch.layers for ring in layer.upper]
    if reach := max((c[1] for c in outer if c is not None and abs(c[0]) < _SAME), default=0.0):
        yield Line(one.centre - reach, one.centre + reach)
        yield Line(one.centre - 1j * reach, one.centre + 1j * reach)


def _visible(curve: Curve, height: float, one: Shown, covers: _Covers) -> Iterator[Curve]:
    """The pieces of an edge that nothing hides."""
    points = curve.point(np.linspace(*curve.domain, SAMPLES))
    near = [other for other in covers.near(points, height) if other.stands or other is not one]

    def hidden(t: np.ndarray) -> np.ndarray:
        points = curve.point(t)
        found = np.zeros(len(t), dtype=bool)
        for other in near:
            left = np.flatnonzero(~found)
            if not len(left):
                break
            found[left] = other.hides(points[left], height)
        return found

    return shown_pieces(curve, hidden)


def cut(shown: Sequence[Shown]) -> Drawn:
    """The section by the plane of the view."""
    strokes: list[Stroke] = []
    axes: list[Line] = []
    hatches: dict[str, list[tuple[Line | Arc, ...]]] = {}
    filled: dict[str, list[tuple[Line | Arc, ...]]] = {}
    for one in shown:
        drawn = list(_cut_across(one) if one.stands else _cut_along(one))
        strokes += [stroke for stroke, _ in drawn if stroke is not None]
        loops = [loop for _, loop in drawn if loop is not None]
        filled.setdefault(one.part, []).extend(loops)
        along_x = one.sketch.is_key and abs(one.place.rotation[2][0]) < _PARALLEL
        if not (one.sketch.is_ball or along_x or (_is_whole(one.sketch) and not one.stands)):
            hatches.setdefault(one.part, []).extend(loops)
        if drawn:
            strokes += _pitches(one) if abs(one.depth) < _SAME or one.stands else ()
            axes += _axes(one) if abs(one.depth) < _SAME or one.stands else ()
    lines = _Lines(strokes)
    spots = {part: _farthest(*_within(loops, lines)) for part, loops in filled.items()}
    hatched = tuple(tuple(loops) for loops in hatches.values() if loops)
    return Drawn(_once(strokes, _stroke_place), hatched, _once(axes, _place), spots)


def _once(lines: Sequence[T], place: Callable[[T], object]) -> tuple[T, ...]:
    """Lines without those that lie on one another: edges of several heights or parts are one line of the view."""
    found: dict[object, T] = {}
    for line in lines:
        found.setdefault(place(line), line)
    return tuple(found.values())


def _stroke_place(stroke: Stroke) -> tuple[object, ...]:
    return stroke[0], *_place(stroke[1])


def _place(curve: Curve) -> tuple[object, ...]:
    """Where a line lies, either way round."""
    low, high = curve.domain
    points = np.round(curve.point(np.linspace(low, high, 5)), _PAPER) + 0.0
    return min(tuple(points.tolist()), tuple(points[::-1].tolist()), key=lambda row: [(p.real, p.imag) for p in row])


Cut = tuple[Stroke | None, tuple[Line | Arc, ...] | None]


def _cut_along(one: Shown) -> Iterator[Cut]:
    """A part cut along its axis."""
    rotation = np.array(one.place.rotation)
    normal = complex(rotation[2, 0], rotation[2, 1])
    across = one.flat(-1j * one.along)
    layers = one.sketch.layers
    whole = _is_whole(one.sketch) and abs(one.depth) < _SAME
    cuts = reaching(across) if whole else crossing(-one.depth * normal, across)
    for line in stacked(layers, cuts, one.sketch.creases if whole else ()):
        yield (VISIBLE, Line(one.laid(line.start), one.laid(line.end))), None
    for layer in layers:
        for a, b in zip(*(cuts(_hatched_to(side, layer)) for side in (layer.lower, layer.upper)), strict=False):
            yield (VISIBLE, Line(one.laid(complex(a, layer.low)), one.laid(complex(b, layer.high)))), None
    for loop in hatched(layers, cuts):
        yield None, tuple(Line(one.laid(k.start), one.laid(k.end)) for k in loop)


def _hatched_to(side: Sequence[Ring], layer: Layer) -> tuple[Ring, ...]:
    """The roots of teeth in an end of a layer, and where spokes begin and end."""
    return tuple(map(round_ring, (*(ring.root for ring in side if ring.root is not None), *layer.spokes)))


def _is_whole(sketch: Sketch) -> bool:
    """Whether it is not cut along its axis: a ball, a shaft that no bore goes through, a bolt or a pin (GOST 2.305).

    A bolt or a pin is what has nothing inside and is longer than wide.
    """
    rings = [side for layer in sketch.layers for side in (layer.lower, layer.upper)]
    if sketch.is_ball or (sketch.is_shaft and any(len(side) == 1 for side in rings)):
        return True
    points = np.concatenate([ring.points for side in rings for ring in side])
    wide = max(np.ptp(points.real), np.ptp(points.imag))
    return all(len(side) == 1 for side in rings) and sketch.layers[-1].high - sketch.layers[0].low > wide


def _cut_across(one: Shown) -> Iterator[Cut]:
    """A part cut across its axis."""
    sketch, placement = one.faced
    layer = next((k for k in sketch.layers if k.low < -one.depth < k.high), None)
    if layer is None:
        return
    for ring in layer.lower:
        for curve in _placed(ring, placement):
            yield (VISIBLE, curve), None
        curves = _placed(ring.filled(), placement)
        yield None, tuple(piece for c in curves for piece in _plain(c))
        if ring.root is not None:
            yield (VISIBLE, curves[0]), None


def _plain(curve: Curve) -> list[Line | Arc]:
    """A curve as what hatching takes."""
    if isinstance(curve, Line | Arc):
        return [curve]
    points = curve.point(np.linspace(*curve.domain, 17)).tolist()
    return [Line(a, b) for a, b in pairwise(points)]


class _Lines:
    """The lines of a view, their samples (n, SAMPLES), and the boxes about them."""

    def __init__(self, strokes: Sequence[Stroke]) -> None:
        self.curves = [curve for _, curve in strokes]
        samples = [curve.point(np.linspace(*curve.domain, SAMPLES)) for curve in self.curves]
        self.samples = np.array(samples, dtype=complex).reshape(-1, SAMPLES)
        x, y = self.samples.real, self.samples.imag
        self.sides = [x.min(axis=1), x.max(axis=1), y.min(axis=1), y.max(axis=1)]

    def room(self, points: Complex, about: complex, reach: float) -> Real:
        """How far points are from the lines that come within ``reach`` of a place, mm.

        Rounded: what has as much room is a tie on any machine, here and beside other instances.
        """
        if not len(points):
            return np.zeros(0)
        (left, right, low, high), reach = self.sides, reach + _SAME
        near = (left <= about.real + reach) & (right >= about.real - reach)
        near &= (low <= about.imag + reach) & (high >= about.imag - reach)
        off = [self._off(points, k) for k in np.flatnonzero(near).tolist()]
        return np.min(off, axis=0).round(_DIGITS)

    def _off(self, points: Complex, k: int) -> Real:
        """Of points from a line: a circle may be parted anywhere, so exactly; of other curves by samples."""
        if isinstance(curve := self.curves[k], Line | Arc):
            return distance_to_curve(points, curve)
        return np.abs(points[:, None] - self.samples[k]).min(axis=1)


def _within(loops: Sequence[Sequence[Line | Arc]], lines: _Lines) -> tuple[Complex, Real]:
    """Points in what is hatched, and how much room is about each, mm."""
    found, rooms = [np.zeros(0, dtype=complex)], [np.zeros(0)]
    for loop in loops:
        points = np.concatenate([c.point(np.linspace(*c.domain, 9)) for c in loop])
        x, y = (np.linspace(a.min(), a.max(), 9) for a in (points.real, points.imag))
        grid = (x[1:-1, None] + 1j * y[None, 1:-1]).ravel()
        found.append(grid[Ring(tuple(loop)).holds(grid)])
        rooms.append(lines.room(found[-1], complex(x[4], y[4]), max(x[-1] - x[0], y[-1] - y[0]) / 2))
    return np.concatenate(found), np.concatenate(rooms)


def _farthest(points: Complex, room: Real) -> tuple[Spot, ...]:
    """The best few of places, those with the most room about first."""
    return tuple((complex(points[k]), float(room[k])) for k in np.argsort(-room, kind="stable")[:_FEW])
