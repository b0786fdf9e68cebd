"""Sections and views of what is turned about an axis: edges seen behind a section or from outside.

A loop is half a section, closed: the axis along x, the distance from it along y, above 0.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise

import numpy as np

from geometry.base.record import replace
from geometry.curves.curve import Complex, end_point, start_point
from geometry.curves.line_arc import Arc, Line
from parts.drawing.canvas import Box
from parts.drawing.working import VISIBLE, Stroke, View

Loop = Sequence[Line | Arc]
# parts of the size: how far beside an edge is looked, what is one place
_BESIDE, _SAME = 1e-7, 1e-6
_SAMPLES = 129
_SMOOTH = 1e-6
# mm within which edges lie in one plane
_HERE = 1e-9


def closed(points: Sequence[complex], least: float = 1e-9) -> tuple[Line, ...]:
    """A closed chain of lines, without those of no length: below the ``least``, mm."""
    ring = [p for p, q in pairwise([*points, points[0]]) if abs(p - q) > least]
    return tuple(Line(a, b) for a, b in pairwise([*ring, ring[0]]))


def block(low: float, high: float, near: float, far: float) -> tuple[Line, ...]:
    """A rectangle of a section: from z to z, between two distances from the axis, mm."""
    return closed(Box(low, near, high, far).corners)


def below(loop: Loop) -> tuple[Line | Arc, ...]:
    """The other half."""
    return tuple(curve.mirrored() for curve in reversed(loop))


def outlined(loop: Loop) -> list[Stroke]:
    """The lines of a section, without what lies on the axis."""
    return [(VISIBLE, curve) for curve in loop if not (start_point(curve).imag == end_point(curve).imag == 0)]


def joined(view: View, *places: float) -> View:
    """A section of bodies that touch in planes across the axis and are of one piece: no edge is where both have one."""
    strokes = [*view.strokes]
    for x in places:
        edges = [
            s for s in strokes if isinstance(s[1], Line) and abs(s[1].start.real - x) + abs(s[1].end.real - x) < _HERE
        ]
        spans = [sorted((start_point(curve).imag, end_point(curve).imag)) for _, curve in edges]
        heights = sorted({round(y, 9) for span in spans for y in span})
        pieces = [(a, b) for a, b in pairwise(heights) if sum(low < (a + b) / 2 < high for low, high in spans) % 2]
        strokes = [stroke for stroke in strokes if stroke not in edges]
        strokes += [(VISIBLE, Line(complex(x, a), complex(x, b))) for a, b in _without(pieces, (), _HERE)]
    return replace(view, strokes=tuple(strokes))


def seen_edges(loop: Loop, *, cut: bool) -> list[Line]:
    """The edges that are seen in one half: behind a section where it is ``cut``, else of the whole from outside."""
    points, size = _points(loop)
    corners = _corners(loop)
    found: list[Line] = []
    for x in sorted({round(corner.real / size, 9) for corner in corners}):
        here = [c.imag for c in corners if abs(c.real / size - x) < 2e-9]
        at = next(c.real for c in corners if abs(c.real / size - x) < 2e-9)
        sides = [_material(points, at + way * _BESIDE * size) for way in (-1, 1)]
        spans = [(min(_covered(side, radius, size, cut=cut) for side in sides), radius) for radius in here]
        faces = [
            sorted((start_point(c).imag, end_point(c).imag))
            for c in loop
            if isinstance(c, Line) and abs(c.start.real - at) + abs(c.end.real - at) < _SAME * size
        ]
        for low, high in _without(spans, faces, _SAME * size):
            found.append(Line(complex(at, low), complex(at, high)))
    return found


def seen_circles(loop: Loop) -> list[float]:
    """Radii of the edges that are seen along the axis, from its far end."""
    points, size = _points(loop)
    turned = points.imag + 1j * points.real
    found = []
    for corner in _corners(loop):
        sides = [_material(turned, corner.imag + way * _BESIDE * size) for way in (-1, 1)]
        # nothing stands before it on one side
        if any(side and abs(side[-1][1] - corner.real) < 1e-5 * size for side in sides):
            found.append(corner.imag)
    return found


def _corners(loop: Loop) -> list[complex]:
    """Where a loop has edges."""
    return [
        start_point(after)
        for before, after in pairwise([*loop, loop[0]])
        if abs((complex(before.tangent(before.domain[1])).conjugate() * complex(after.tangent(after.domain[0]))).imag)
        > _SMOOTH
    ]


def _points(loop: Loop) -> tuple[Complex, float]:
    """Points along a loop, and how large it is, mm."""
    points = np.concatenate([c.point(np.linspace(*c.domain, 2 if isinstance(c, Line) else _SAMPLES)) for c in loop])
    return points, float(np.abs(points).max())


def _material(points: Complex, x: float) -> list[tuple[float, float]]:
    """Where there is material along the line at x, from the axis outwards."""
    start, end = points, np.roll(points, -1)
    crossed = (start.real > x) != (end.real > x)
    a, b = start[crossed], end[crossed]
    heights = np.sort(a.imag + (b.imag - a.imag) * (x - a.real) / (b.real - a.real)).tolist()
    return list(pairwise(heights))[::2]


def _covered(material: Iterable[tuple[float, float]], radius: float, size: float, *, cut: bool) -> float:
    """Up to which distance from the axis an edge of a radius is covered on one side."""
    if cut:
        return max((min(end, radius) for start, end in material if start < radius - _SAME * size), default=0.0)
    # from outside, by what is larger
    return radius if any(end > radius + _SAME * size for _, end in material) else 0.0


def _without(
    spans: Iterable[tuple[float, float]], faces: Iterable[Sequence[float]], least: float
) -> list[tuple[float, float]]:
    """What of spans lies on no face, joined."""
    found: list[tuple[float, float]] = []
    for low, high in sorted(spans):
        if found and low <= found[-1][1] + least:
            found[-1] = found[-1][0], max(high, found[-1][1])
        else:
            found.append((low, high))
    for a, b in faces:
        found = [
            piece for low, high in found for piece in ((low, min(high, a)), (max(low, b), high)) if piece[1] > piece[0]
        ]
    return [(low, high) for low, high in found if high - low > least]


def outer_of(loop: Loop) -> Callable[[Line | Arc], bool]:
    """Tells of curves of half a section which are seen from outside: on one side nothing is farther from the axis."""
    points, size = _points(loop)
    beside = _BESIDE * size

    def is_outer(curve: Line | Arc) -> bool:
        middle = complex(curve.point(sum(curve.domain) / 2))
        return any(
            all(end <= middle.imag + 1e-5 * size for _, end in _material(points, middle.real + way * beside))
            for way in (-1, 1)
        )

    return is_outer
