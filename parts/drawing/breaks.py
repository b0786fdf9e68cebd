"""A long view with a break: what lies between is left out, wavy lines end what is left; GOST 2.305, 2.303."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator

import numpy as np

from geometry.base.placement import Placement2
from geometry.base.record import Record, replace
from geometry.curves.line_arc import Arc, Line
from parts.drawing.working import THIN, Size, Stroke, View

# mm, what is no length; how far a wavy line swings to a side, parts of half its height
_NONE, _SWING = 1e-6, 0.15


class Break(Record):
    """What lies nearer to the middle than ``at`` is left out of a view, but for a gap of a width, mm."""

    at: float
    gap: float

    @property
    def shift(self) -> float:
        """By how much either end comes nearer, mm."""
        return self.at - self.gap / 2

    def moved(self, point: complex) -> complex:
        """Where a place is drawn; one that is left out in the middle of what is left on the left."""
        return point - math.copysign(self.shift, point.real)

    def keeps(self, point: complex) -> bool:
        """Whether a place is drawn."""
        return abs(point.real) > self.at - _NONE


def broken(view: View, at: Break) -> View:
    """The view with the break; sizes over it keep their numbers."""
    points = np.concatenate([chord.ravel() for chord in view.chords])
    low, high = float(points.imag.min()), float(points.imag.max())
    far = float(np.abs(points.real).max())
    waves = [Wave(side * at.gap / 2, low, high) for side in (-1, 1)]
    strokes = [part for stroke in view.strokes for part in _parts(stroke, at, waves)]
    strokes += [(THIN, arc) for wave in waves for arc in wave.arcs()]
    middle = -(at.at + far) / 2
    notes = (one if at.keeps(one.at) else replace(one, at=complex(middle, one.at.imag)) for one in view.notes)
    return replace(
        view,
        strokes=tuple(strokes),
        axes=tuple(Line(at.moved(a.start), at.moved(a.end)) for a in view.axes),
        sizes=tuple(_size(one, at) for one in view.sizes),
        rounds=tuple(replace(one, centre=at.moved(one.centre)) for one in view.rounds),
        notes=tuple(replace(one, at=at.moved(one.at)) for one in notes),
        cuts=tuple(replace(one, at=at.moved(complex(one.at)).real) for one in view.cuts),
    )


def _size(one: Size, at: Break) -> Size:
    over = one.start.real * one.end.real < 0
    return replace(one, start=at.moved(one.start), end=at.moved(one.end), whole=one.value if over else one.whole)


def _parts(stroke: Stroke, at: Break, waves: list[Wave]) -> Iterator[Stroke]:
    """What is left of a line: all of it, nothing, or both ends of one that runs along."""
    layer, curve = stroke
    points = curve.point(np.linspace(*curve.domain, 5))
    xs = points.real
    if min(abs(xs)) > at.at - _NONE and xs.min() * xs.max() > 0:
        yield layer, curve.placed(Placement2(0.0, complex(-math.copysign(at.shift, xs[0]))))
    elif np.ptp(points.imag) < _NONE and xs.min() < -at.at and xs.max() > at.at:
        for end, wave in zip(sorted(map(complex, points[[0, -1]]), key=lambda p: p.real), waves, strict=True):
            yield layer, Line(at.moved(end), wave.on(end.imag))


class Wave(Record):
    """A wavy line upwards: a half to the left, a half to the right."""

    x: float
    low: float
    high: float

    def arcs(self) -> tuple[Arc, Arc]:
        """Both halves, from below."""
        half = (self.high - self.low) / 2
        swing = _SWING * half
        # chord and height of the segment
        radius = (half * half / 4 + swing * swing) / (2 * swing)
        turn = 2 * math.asin(half / 2 / radius)
        made = []
        for k, side in enumerate((-1, 1)):
            centre = complex(self.x - side * (radius - swing), self.low + half * (k + 0.5))
            start = cmath.phase(complex(side, -math.tan(turn / 2)))
            made.append(Arc(centre, radius, start, side * turn))
        return made[0], made[1]

    def on(self, height: float) -> complex:
        """Its place at a height."""
        lower, upper = self.arcs()
        arc, side = (lower, -1) if height < (self.low + self.high) / 2 else (upper, 1)
        off = height - arc.centre.imag
        return complex(arc.centre.real + side * math.sqrt((arc.radius - off) * (arc.radius + off)), height)
