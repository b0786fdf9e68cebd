"""What assembly drawings show of a solid: its sections from height to height, teeth as circles (GOST 2.402).

A sketch is a stack of layers. In its lower and its upper end each has closed boundaries in the plane of the part;
between both they run straight. Round arcs of turned parts are cut into so many layers.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from itertools import pairwise

import numpy as np

from geometry.base.record import Record, replace
from geometry.base.roots import halved
from geometry.curves.curve import Complex, Curve, Real
from geometry.curves.line_arc import Arc, Line
from geometry.plane.distance import Flags
from geometry.plane.profile import Label
from geometry.solids.body import Body, Wall
from geometry.solids.bores import FlatBore
from geometry.solids.turned import HalfSection, Pocket

# what is one height or one place, mm; samples of a curve; steps of a halving
_SAME, _SAMPLES, _HALVINGS = 1e-7, 33, 40
# radius of the root of what is teeth alone: nothing of it is hatched
NOTHING = 0.0
# radius of what is a point, mm
_POINT = 1e-6
# layers of an arc of a turned part
_ARC = 8
# turn of a wall from which on it is an edge, rad
_EDGE = 0.1


class Ring(Record, dict=True):
    """A closed boundary in the plane; ``root``: radius to which the section of teeth is hatched, mm.

    ``spokes``: of a window the radii between which there are spokes beside it, mm.
    """

    curves: tuple[Curve, ...]
    root: float | None = None
    spokes: tuple[float, float] | None = None

    @cached_property
    def circle(self) -> tuple[complex, float] | None:
        """Centre and radius, where it is a single whole circle."""
        (one, *more) = self.curves
        return (one.centre, one.radius) if isinstance(one, Arc) and not more else None

    @cached_property
    def points(self) -> Complex:
        """All along it, without the last, which is the first."""
        return np.concatenate([c.point(np.linspace(*c.domain, _SAMPLES))[:-1] for c in self.curves])

    def holds(self, points: Complex) -> np.ndarray:
        """Whether points lie within it."""
        if (round_ := self.circle) is not None:
            return np.asarray(np.abs(points - round_[0]) < round_[1])
        chain, low, high = self._chain
        found = np.zeros(len(points), dtype=bool)
        near = np.flatnonzero(
            (points.real > low.real) & (points.real < high.real) & (points.imag > low.imag) & (points.imag < high.imag)
        )
        if near.size:
            x, y = points.real[near], points.imag[near]
            above = np.ascontiguousarray(chain.imag) > y[:, None]
            # few of the chords cross the height of a point
            row, k = np.nonzero(above[:, 1:] != above[:, :-1])
            start, end = chain[k], chain[k + 1]
            at = start.real + (end.real - start.real) * (y[row] - start.imag) / (end.imag - start.imag)
            found[near] = np.bincount(row[x[row] < at], minlength=len(near)) % 2 == 1
        return found

    @cached_property
    def _chain(self) -> tuple[Complex, complex, complex]:
        """Its places, the first again behind the last, and the corners of the box about it."""
        chain = np.append(self.points, self.points[0])
        low, high = complex(chain.real.min(), chain.imag.min()), complex(chain.real.max(), chain.imag.max())
        return chain, low, high

    def crossings(self, origin: complex, way: complex) -> list[float]:
        """Where a straight line meets it, mm along ``way`` from ``origin``."""
        if (round_ := self.circle) is not None:
            foot = (round_[0] - origin) / way
            reach = round_[1] ** 2 - foot.imag**2
            return [] if reach <= 0 else [foot.real - math.sqrt(reach), foot.real + math.sqrt(reach)]
        found = []
        samples = [np.linspace(*curve.domain, _SAMPLES) for curve in self.curves]
        sides = [((c.point(t) - origin) / way).imag > 0 for c, t in zip(self.curves, samples, strict=True)]
        for number, (curve, t, side) in enumerate(zip(self.curves, samples, sides, strict=True)):
            # where two curves join on the line itself both have it on one side
            side[0] = sides[number - 1][-1]
            at = np.flatnonzero(side[1:] != side[:-1])

            def stays(places: Real, curve: Curve = curve, above: Flags = side[at]) -> Flags:
                return np.asarray((((curve.point(places) - origin) / way).imag > 0) == above)

            low, _ = halved(stays, t[at], t[at + 1], _HALVINGS)
            found += ((curve.point(low) - origin) / way).real.tolist()
        return found

    def filled(self) -> Ring:
        """What is hatched of it."""
        return self if self.root is None else round_ring(self.root)


class _Boundaries(Record):
    """Boundaries of a section: centres and radii of the circles, and the others."""

    centres: Complex
    radii: Real
    others: tuple[Ring, ...]

    def hold(self, points: Complex) -> np.ndarray:
        """Whether there is material at points."""
        count = (np.abs(points[:, None] - self.centres) < self.radii).sum(axis=1)
        for ring in self.others:
            count += ring.holds(points)
        return np.asarray(count % 2 == 1)

    def bound(self, points: Complex) -> np.ndarray:
        """Whether points lie on one of its circles."""
        return np.asarray((np.abs(np.abs(points[:, None] - self.centres) - self.radii) < _SAME).any(axis=1))


def _boundaries(rings: Sequence[Ring]) -> _Boundaries:
    circles = [ring.circle for ring in rings if ring.circle is not None]
    centres, radii = np.array([c for c, _ in circles], dtype=complex), np.array([r for _, r in circles], dtype=float)
    return _Boundaries(centres, radii, tuple(ring for ring in rings if ring.circle is None))


class Layer(Record, dict=True):
    """The material between two heights, mm: boundaries at its lower and its upper end, one for one."""

    low: float
    high: float
    lower: tuple[Ring, ...]
    upper: tuple[Ring, ...]

    @property
    def spokes(self) -> tuple[float, ...]:
        """Radii between which there are spokes, which no section along them cuts (GOST 2.305), mm."""
        return next((ring.spokes for ring in self.lower if ring.spokes), ())

    @cached_property
    def at_high(self) -> _Boundaries:
        """Where there is material at its upper end."""
        return _boundaries(self.upper)

    @cached_property
    def at_low(self) -> _Boundaries:
        """Where there is material at its lower end."""
        return self.at_high if self.upper is self.lower else _boundaries(self.lower)


class Sketch(Record):
    """Layers from below; ``creases``: heights at which walls bend; ``pitch``: radius of the pitch cylinder, mm.

    ``pitch_cone``: both ends of the pitch line of a bevel gear, r + iz; ``pitch`` is then the outer radius.
    ``is_shaft``: not hatched where it is cut along its axis; ``is_key``: along x; ``is_ball``: nowhere (GOST 2.305).
    """

    layers: tuple[Layer, ...]
    creases: tuple[float, ...] = ()
    pitch: float | None = None
    is_shaft: bool = False
    is_ball: bool = False
    is_key: bool = False
    pitch_cone: tuple[complex, complex] | None = None

    def turned_over(self) -> Sketch:
        """The same, turned over about x."""

        def over(rings: Sequence[Ring]) -> tuple[Ring, ...]:
            return tuple(replace(ring, curves=tuple(c.mirrored() for c in reversed(ring.curves))) for ring in rings)

        layers = []
        for k in reversed(self.layers):
            lower = over(k.upper)
            layers.append(Layer(-k.high, -k.low, lower, lower if k.upper is k.lower else over(k.lower)))
        cone = None if self.pitch_cone is None else (self.pitch_cone[0].conjugate(), self.pitch_cone[1].conjugate())
        return replace(self, layers=tuple(layers), creases=tuple(-z for z in self.creases), pitch_cone=cone)

    def edges(self) -> Iterator[tuple[float, Ring]]:
        """What is seen from above of boundaries: upper ends of walls and their creases, by height."""
        for number, layer in enumerate(self.layers):
            after = self.layers[number + 1].lower if number + 1 < len(self.layers) else ()
            for ring in layer.upper:
                goes_on = any(alike(ring, other) for other in after)
                if not goes_on or any(abs(layer.high - z) < _SAME for z in self.creases):
                    yield layer.high, ring

    def covers(self, points: Complex, height: float) -> np.ndarray:
        """Whether material stands above points of the plane at a height."""
        found = np.zeros(len(points), dtype=bool)
        above = (layer for layer in self.layers if layer.low >= height - _SAME)
        for end in (end for k in above for end in ((k.at_low,) if k.upper is k.lower else (k.at_low, k.at_high))):
            # what is covered already is not asked for again
            left = np.flatnonzero(~found)
            if not len(left):
                break
            # an edge on which more of the same wall stands is seen
            found[left] = end.hold(points[left]) & ~end.bound(points[left])
        return found


def alike(one: Ring, other: Ring) -> bool:
    """Whether two boundaries are the same."""
    if one is other:
        return True
    if one.circle is not None and other.circle is not None:
        return abs(one.circle[0] - other.circle[0]) < _SAME and abs(one.circle[1] - other.circle[1]) < _SAME
    return one.curves == other.curves


class Teeth(Record):
    """Radii of teeth, mm."""

    tip: float
    root: float
    pitch: float


def round_ring(radius: float, root: float | None = None, centre: complex = 0j) -> Ring:
    """A circle."""
    return Ring((Arc(centre, radius, 0.0, 2 * math.pi),), root)


def sketch_of_body(body: Body, teeth: Teeth | None = None) -> Sketch:
    """A solid of walls between plane caps; its toothed profile is drawn as ``teeth``."""

    def ring(wall: Wall, z: float) -> Ring:
        low, high = body.height(wall)
        placement = body.loops[wall.lower if z - low < high - z else wall.upper].placement
        profile = body.section(wall, z) if body.is_chamfer(wall) else body.loop_profile(wall.lower)
        if teeth is not None and profile.count > 1 and any(s.label is Label.FLANK for s in profile.period):
            return round_ring(teeth.tip, teeth.root)
        curves = tuple(s.curve.placed(placement) for s in profile.segments())
        if len(circles := {(c.centre, c.radius) for c in curves if isinstance(c, Arc)}) == 1 and len(curves) == 2:
            ((centre, radius),) = circles
            if all(isinstance(c, Arc) for c in curves):
                return round_ring(radius, centre=centre)
        window = (s.curve for s in profile.segments() if s.label is Label.WINDOW)
        # where spokes begin and end
        match sorted(curve.radius for curve in window if isinstance(curve, Arc)):
            case [hub, rim]:
                return Ring(curves, None, (hub, rim))
        return Ring(curves)

    layers, creases = [], []
    for low, high in pairwise(body.levels()):
        walls = [w for w in body.walls if body.height(w)[0] <= low + _SAME and body.height(w)[1] >= high - _SAME]
        lower = tuple(ring(w, low) for w in walls)
        straight = all(body.is_upright(w) for w in walls)
        layers.append(Layer(low, high, lower, lower if straight else tuple(ring(w, high) for w in walls)))
        if any(body.is_chamfer(w) for w in walls):
            creases += [low, high]
    return Sketch(tuple(layers), tuple(creases), None if teeth is None else teeth.pitch)


def sketch_of_turned(section: HalfSection, *, is_shaft: bool = False) -> Sketch:
    """A turned part with its flats, without its keyways."""
    chain, creases = [], []
    for piece, after in zip(section.pieces, (*section.pieces[1:], section.pieces[0]), strict=True):
        points = piece.points()
        kept = points[:: max(1, (len(points) - 1) // _ARC)] if piece.centre is not None else points
        chain += [] if piece.on_axis else list(pairwise(kept.tolist()))
        arriving, leaving = points[-1] - points[-2], np.diff(after.points()[:2])[0]
        if abs(np.angle(leaving / arriving)) > _EDGE:
            creases.append(float(points[-1].imag))
    flats = [p for p in section.pockets if p.is_flat]
    levels = [z for p in flats for z in (p.low, p.high)]
    layers = tuple(
        _flattened(layer, [p for p in flats if p.low < (layer.low + layer.high) / 2 < p.high])
        for layer in lathe(chain, [(h.centre, h.radius) for h in section.holes], levels)
    )
    return Sketch(layers, (*creases, *levels), None, is_shaft, section.is_ball)


def _flattened(layer: Layer, flats: Sequence[Pocket]) -> Layer:
    """A turned layer whose outermost circle has one flat or two opposite ones, of those that reach beyond them."""

    def cut(rings: tuple[Ring, ...]) -> tuple[Ring, ...]:
        *inner, outer = rings
        if not flats or outer.circle is None or outer.circle[1] <= flats[0].floor:
            return rings
        bore = FlatBore(2 * outer.circle[1], flats[0].floor, len(flats), flats[0].angle)
        return *inner, Ring(tuple(s.curve for s in bore.profile().segments()))

    return replace(layer, lower=cut(layer.lower), upper=cut(layer.upper)) if flats else layer


def lathe(
    chain: Sequence[tuple[complex, complex]], holes: Sequence[tuple[complex, float]] = (), places: Sequence[float] = ()
) -> Iterator[Layer]:
    """The layers of half a section, whose lines are r + iz; round holes go through along the axis.

    ``places``: heights at which layers end too.
    """
    levels = sorted({*(round(p.imag, 9) for edge in chain for p in edge), *(round(z, 9) for z in places)})
    for low, high in pairwise(levels):
        if high - low < _SAME:
            continue
        rising = [(a, b) if a.imag <= b.imag else (b, a) for a, b in chain]
        walls = [(a, b) for a, b in rising if a.imag <= low + _SAME and b.imag >= high - _SAME]
        radii = [sorted(a.real + (b.real - a.real) * (z - a.imag) / (b.imag - a.imag) for a, b in walls)
                 for z in (low, high)]  # fmt: skip
        # a cone's point is a small circle
        ends = [[round_ring(max(r, _POINT)) for r in side] for side in radii]
        reach = min(max(side) for side in radii)
        through = tuple(round_ring(r, centre=c) for c, r in holes if abs(c) + r < reach)
        yield Layer(low, high, (*ends[0], *through), (*ends[1], *through))


# lines of a view by their place: of what is cut or seen of layers whose boundaries meet a line at some places
Cuts = Callable[[tuple[Ring, ...]], list[float]]


def stacked(layers: Sequence[Layer], cuts: Cuts, creases: Sequence[float] = ()) -> Iterator[Line]:
    """The lines about a stack of layers in a plane along its axis, s + iz; ``cuts``: where boundaries meet the plane.

    Edges behind the ends of holes are among them, and creases.
    """
    spans = [(k.low, k.high, cuts(k.lower), cuts(k.upper)) for k in layers]
    spans = [span for span in spans if span[2] and len(span[2]) == len(span[3])]
    walls: dict[float, list[tuple[float, float]]] = {}
    for low, high, first, last in spans:
        for a, b in zip(first, last, strict=True):
            if abs(a - b) > _SAME:
                yield Line(complex(a, low), complex(b, high))
                continue
            runs = walls.setdefault(round(a, 7), [])
            if runs and abs(runs[-1][1] - low) < _SAME:
                runs[-1] = runs[-1][0], high
            else:
                runs.append((low, high))
    for s, runs in walls.items():
        for low, high in runs:
            yield Line(complex(s, low), complex(s, high))
    for z in sorted({round(z, 9) for span in spans for z in span[:2]}):
        below = next((span[3] for span in spans if abs(span[1] - z) < _SAME), [])
        above = next((span[2] for span in spans if abs(span[0] - z) < _SAME), [])
        bends = any(abs(z - c) < _SAME for c in creases)
        for a, b in _faces(below, above, bends=bends):
            yield Line(complex(a, z), complex(b, z))


def _faces(below: list[float], above: list[float], *, bends: bool) -> Iterator[tuple[float, float]]:
    """Stretches of a height at which a line stands: material on one side alone, the end of a hole, or a crease."""
    places = sorted({round(s, 7) for s in (*below, *above)})
    stretches: list[tuple[float, float]] = []
    for a, b in pairwise(places):
        middle = (a + b) / 2
        solid = [sum(s < middle for s in side) % 2 == 1 for side in (below, above)]
        enclosed = [bool(side) and side[0] < middle < side[-1] for side in (below, above)]
        drawn = solid[0] != solid[1] or (not any(solid) and enclosed[0] != enclosed[1]) or (bends and any(enclosed))
        if drawn and stretches and abs(stretches[-1][1] - a) < _SAME:
            stretches[-1] = stretches[-1][0], b
        elif drawn:
            stretches.append((a, b))
    yield from stretches


def hatched(layers: Sequence[Layer], cuts: Cuts) -> Iterator[tuple[Line, ...]]:
    """The material that a plane along the axis cuts, as closed loops s + iz, teeth as far as their roots, no spokes.

    Layers that lie on each other make one loop, for hatching to run through.
    """
    # of each loop that grows: places of its left and its right side
    growing: list[tuple[list[complex], list[complex]]] = []
    for layer in layers:
        between = tuple(map(round_ring, layer.spokes))
        solid = [
            (*(ring.filled() for ring in side if ring.root != NOTHING and not ring.spokes), *between)
            for side in (layer.lower, layer.upper)
        ]
        first, last = map(cuts, solid)
        if len(first) != len(last) or len(first) % 2:
            continue
        spans = list(zip(first[::2], first[1::2], last[::2], last[1::2], strict=True))
        goes_on = len(spans) == len(growing) and all(
            abs(left[-1].imag - layer.low) < _SAME and a < right[-1].real and left[-1].real < b
            for (left, right), (a, b, _, _) in zip(growing, spans, strict=True)
        )
        if not goes_on:
            yield from map(_closed, growing)
            growing = [([], []) for _ in spans]
        for (left, right), (a, b, c, d) in zip(growing, spans, strict=True):
            left += [complex(a, layer.low), complex(c, layer.high)]
            right += [complex(b, layer.low), complex(d, layer.high)]
    yield from map(_closed, growing)


def _closed(sides: tuple[list[complex], list[complex]]) -> tuple[Line, ...]:
    """The loop up the right side and down the left."""
    left, right = sides
    ring = [*right, *reversed(left)]
    kept = [p for p, q in zip(ring, (*ring[1:], ring[0]), strict=True) if abs(p - q) > _SAME]
    return tuple(Line(p, q) for p, q in zip(kept, (*kept[1:], kept[0]), strict=True))


def crossing(origin: complex, way: complex) -> Cuts:
    """Where boundaries meet a straight line."""

    def cuts(rings: tuple[Ring, ...]) -> list[float]:
        return sorted(s for ring in rings for s in ring.crossings(origin, way))

    return cuts


def reaching(way: complex) -> Cuts:
    """How far the outermost boundary reaches along a direction, both ways."""

    def cuts(rings: tuple[Ring, ...]) -> list[float]:
        ends: list[float] = []
        for ring in rings:
            if (found := ring.circle) is not None:
                middle = (found[0] / way).real
                ends += [middle - found[1], middle + found[1]]
            else:
                along: Real = (ring.points / way).real
                ends += [float(along.min()), float(along.max())]
        return [min(ends), max(ends)] if ends else []

    return cuts
