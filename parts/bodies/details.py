"""Details of a long part seen from outside: places with lengths too small in it, enlarged beside it; GOST 2.305."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from geometry.base.placement import Placement2
from geometry.base.record import replace
from geometry.curves.line_arc import Line, arc_between
from parts.drawing.canvas import Box
from parts.drawing.wheel_views import circle_of
from parts.drawing.working import HIDDEN, THIN, VISIBLE, Note, Side, Size, Stroke, View
from parts.texts.sheets import view_letter

# parts of a view's size: a length that is too small, and the least circle about a detail
_SMALL, _CIRCLE = 1 / 150, 1 / 60
# how far beside its places a detail reaches, parts of them; its least length, and the whole at most, mm on paper
_BESIDE, _LEAST, _MOST = 0.6, 5.0, 60.0
# how many times longer than a detail what is shown across the axis is at most; mm that are none
_THICK, _NONE = 2.0, 1e-9
# of a break line: its waves, how far they stand out, parts of one
_WAVES, _OUT = 4, 0.15


def detailed(view: View, ends: tuple[float, float], language: str) -> Iterator[View]:
    """A view along the axis between its ends, then its details, each with the sizes that the view itself then lacks."""
    size = max(ends[1] - ends[0], float(np.ptp([curve.point(0.0).imag for _, curve in view.strokes])))
    found = list[View]()
    for places in _small(view.sizes, _SMALL * size):
        window = _window(view.strokes, places, ends)
        pieces = [*_clipped(view.strokes, window)]
        letter = view_letter(language, len(view.cuts) + len(found))
        is_whole = window.low <= -window.high
        sizes = [*_sizes(view.sizes, places, ends, across=is_whole)]
        rounds = [one for one in view.rounds if _holds(window, one.centre)]
        least = min(_MOST, _LEAST * max(window.wide, window.tall) / min(b - a for a, b in pairwise(places)))
        # an upper half stands beside the axis
        down = Placement2(0.0, 0j if is_whole else -0.5j * (window.low + window.high))
        axes = (Line(complex(window.left), complex(window.right)),) if is_whole else ()
        found.append(View(
            tuple((layer, curve.placed(down)) for layer, curve in (*pieces, *_breaks(pieces, window, ends))), (), axes,
            tuple(_placed(new, down) for _, new in sizes),
            tuple(replace(one, centre=complex(down.apply(one.centre))) for one in rounds), title=letter, least=least,
        ))  # fmt: skip
        about = circle_of(max(abs(complex(window.wide, window.tall)) / 2, _CIRCLE * size), window.middle)
        told = [old for old, _ in sizes]
        view = replace(
            view, strokes=(*view.strokes, (THIN, about)), sizes=tuple(s for s in view.sizes if s not in told),
            rounds=tuple(one for one in view.rounds if one not in rounds),
            notes=(*view.notes, Note(complex(about.point(math.pi / 4)), letter, is_letter=True)),
        )  # fmt: skip
    yield view
    yield from found


def _holds(window: Box, point: complex) -> bool:
    """Whether a point lies within, or above."""
    return window.left < point.real < window.right and window.low < point.imag


def _placed(size: Size, by: Placement2) -> Size:
    """A size that is moved, a length to the half that is shown."""
    if by.translation == 0:
        return size
    start, end = (complex(by.apply(complex(p.real, abs(p.imag)))) for p in (size.start, size.end))
    return replace(size, start=start, end=end, side="above")


def _is_length(size: Size) -> bool:
    return size.name.startswith(("length", "width"))


def _small(sizes: Sequence[Size], most: float) -> Iterator[list[float]]:
    """Runs of places along the axis that are nearer to each other than so much."""
    places = sorted({round(p.real, 7) for one in sizes if _is_length(one) for p in (one.start, one.end)})
    run = places[:1]
    for one, two in pairwise(places):
        if two - one >= most:
            if len(run) > 1:
                yield run
            run = []
        run.append(two)
    if len(run) > 1:
        yield run


def _window(strokes: Sequence[Stroke], places: Sequence[float], ends: tuple[float, float]) -> Box:
    """What a detail shows: some length on both sides of places; across the axis all, its lower side below that.

    Of what is thick the surface alone.
    """
    span = places[-1] - places[0]
    left, right = max(places[0] - _BESIDE * span, ends[0]), min(places[-1] + _BESIDE * span, ends[1])
    heights = list[float]()
    for points in (curve.point(np.linspace(*curve.domain, 17)) for layer, curve in strokes if layer == VISIBLE):
        first, last = points.real.min(), points.real.max()
        if last - first > _NONE and first < right - _NONE and last > left + _NONE:
            heights += [y for y in (points.imag.min(), points.imag.max()) if y > _NONE]
    low, high = min(heights), max(heights)
    if 2 * high <= _THICK * (right - left):
        return Box(left, -high, right, high)
    return Box(left, low - max(_BESIDE * span, high - low), right, high)


def _clipped(strokes: Sequence[Stroke], window: Box) -> Iterator[Stroke]:
    """What of lines lies in a window; arcs whose ends do whole."""
    for layer, curve in strokes:
        if layer not in (VISIBLE, HIDDEN):
            continue
        if not isinstance(curve, Line):
            if _holds(window, complex(curve.point(sum(curve.domain) / 2))):
                yield layer, curve
            continue
        way = curve.end - curve.start
        first, last = window.span(curve.start, way)
        first, last = max(first, 0.0), min(last, 1.0)
        if (last - first) * abs(way) > _NONE:
            yield layer, Line(curve.start + first * way, curve.start + last * way)


def _breaks(pieces: Sequence[Stroke], window: Box, ends: tuple[float, float]) -> Iterator[Stroke]:
    """The wavy lines at which a detail is broken off, as high as it is there, and below."""
    tops = dict[float, float]()
    for x in (window.left, window.right):
        points = (complex(p) for _, curve in pieces for p in curve.point(np.array(curve.domain)))
        tops[x] = max((p.imag for p in points if abs(p.real - x) < _NONE), default=window.low)
    for x, end in zip((window.left, window.right), ends, strict=True):
        if abs(x - end) > _NONE:
            yield from _wave(complex(x, max(window.low, -tops[x])), complex(x, tops[x]))
    if window.low > -window.high:
        yield from _wave(complex(window.left, window.low), complex(window.right, window.low))


def _wave(first: complex, last: complex) -> Iterator[Stroke]:
    """A thin line of arcs, to one side and to the other."""
    step = (last - first) / _WAVES
    side = _OUT * abs(step)
    # half a chord and how far an arc stands out give its radius
    radius = (abs(step) ** 2 / 4 + side**2) / (2 * side)
    for k in range(_WAVES):
        one, two, way = first + k * step, first + (k + 1) * step, (-1) ** k
        centre = (one + two) / 2 + 1j * way * (radius - side) * step / abs(step)
        yield THIN, arc_between(centre, one, two, way > 0)


def _sizes(
    sizes: Sequence[Size], places: Sequence[float], ends: tuple[float, float], *, across: bool
) -> Iterator[tuple[Size, Size]]:
    """Sizes that a detail takes over, and what they are in it: lengths from the place that the view itself tells.

    ``across``: diameters too.
    """
    low, high = places[0] - _NONE, places[-1] + _NONE

    def held(p: complex) -> bool:
        return low <= round(p.real, 7) <= high

    lengths = [one for one in sizes if _is_length(one)]
    halves = [one for one in lengths if held(one.start) != held(one.end)]
    # the whole length is the first to stay
    halves.sort(key=lambda one: -one.value)
    anchor = next((one.start if held(one.start) else one.end for one in halves), None)
    for one in sizes:
        if one.side in ("left", "right"):
            if across and held(one.start):
                side: Side = "left" if one.start.real - places[0] < places[-1] - one.start.real else "right"
                yield one, replace(one, side=side)
        elif held(one.start) and held(one.end):
            yield one, one
        elif one in halves and anchor is not None:
            own, other = (one.start, one.end) if held(one.start) else (one.end, one.start)
            if abs(own.real - anchor.real) > _NONE and min(abs(other.real - end) for end in ends) < _NONE:
                yield one, replace(one, start=anchor, end=own)
