"""Places for words: beside what they name, over nothing that is written, off the lines where there is room."""

from __future__ import annotations

import cmath
import math

import numpy as np

from geometry.curves.curve import Complex
from parts.drawing.canvas import Box, Canvas, text_of, text_width

_DIRECTIONS = 24
_REACHES = (1.5, 3.0, 5.0, 8.0, 12.0, 17.0, 23.0, 30.0, 40.0, 55.0, 75.0, 100.0, 135.0)
# farther than this a word is joined to its point by a line
_NEAR = 3.0
_CLEARANCE = 0.6
# from point to point of what may cross a word, mm
_STEP = 0.5
# what a millimetre of distance, and half a millimetre of line under a word, cost: words stand over lines nowhere
# but where there is no other place
_PER_MM, _PER_POINT = 0.12, 8.0


class Labeller:
    """Puts words on a canvas whose lines are all drawn; ``room`` is where words may stand."""

    def __init__(self, canvas: Canvas, room: Box) -> None:
        self._canvas = canvas
        self._room = room
        self._points = canvas.obstacles()

    @property
    def letters(self) -> float:
        """Height of words that none is told of, mm."""
        return self._canvas.letters

    def name(
        self, text: str, point: complex, height: float | None = None, prefer: complex = 0j, *,
        answer: bool | None = None,
    ) -> None:  # fmt: skip
        """A word beside a point, in the direction ``prefer`` where that costs nothing; ``answer`` as of a text."""
        height = height or self.letters
        width = text_width(text, height)
        away = np.abs(self._points - point)
        texts = [(abs(nearest(t.box, point) - point), t.box) for t in self._canvas.texts]
        below = text_of(text, 0j, height).box
        # no box of this word goes farther beyond the reach of its middle
        beyond = width + height + max(map(abs, below.corners)) + 2 * _CLEARANCE
        best: tuple[float, complex, float] | None = None
        for reach in _REACHES:
            least = math.inf if best is None else best[0]
            # what is farther costs more
            if _PER_MM * reach >= least:
                break
            near = self._points[away < reach + beyond]
            # those too that a line to the word may come near
            words = [box for off, box in texts if off < reach + beyond + _CLEARANCE]
            for k in range(_DIRECTIONS):
                way = cmath.exp(2j * math.pi * k / _DIRECTIONS)
                aside = math.copysign(min(abs(way.real) * 2, 1) * width / 2, way.real)
                above = math.copysign(min(abs(way.imag) * 2, 1) * height / 2, way.imag)
                at = point + way * reach + complex(aside, above) - complex(width, height) / 2
                box = below.moved(at)
                cost = self._cost(box, point, reach, near, words, math.inf if best is None else best[0])
                if cost is not None and prefer:
                    cost += 0.5 * abs(way - prefer / abs(prefer))
                if cost is not None and (best is None or cost < best[0]):
                    best = cost, at, reach
        if best is None:
            return
        _, at, reach = best
        made = self._canvas.write(text, at, height, answer=answer)
        if reach > _NEAR:
            self._lead(point, made.box)

    def _cost(
        self, box: Box, point: complex, reach: float, near: Complex, texts: list[Box], most: float
    ) -> float | None:
        """What a place costs beside the strokes' points and the words that are near; None where it may not be or costs
        ``most`` or more.
        """
        box = box.grown(_CLEARANCE)
        if not box.within(self._room) or any(box.overlaps(other) for other in texts):
            return None
        cost = _PER_POINT * box.holds(near) + _PER_MM * reach
        if reach > _NEAR:
            cost += 0.6
        if cost >= most:
            return None
        if reach > _NEAR:
            path = point + (nearest(box, point) - point) * np.linspace(0, 1, 2 + int(reach / _STEP)).astype(complex)
            if any(other.grown(_CLEARANCE).holds(path) for other in texts):
                return None
        return cost

    def _lead(self, point: complex, box: Box) -> None:
        end = nearest(box, point)
        self._canvas.line("DIMENSION", point, end)
        count = max(int(abs(end - point) / 0.5), 2)
        self._points = np.concatenate([self._points, point + (end - point) * np.linspace(0, 1, count)])

    def column(self, names: list[tuple[str, complex]], edge: float, low: float, high: float, *, left: bool) -> None:
        """Words one above the other beside the line x = ``edge``, each led to its point, in the order of the points."""
        if not names:
            return
        names = sorted(names, key=lambda pair: pair[1].imag)
        size = self.letters
        step = 1.7 * size
        heights = spread([p.imag for _, p in names], step, low, high)
        for (text, point), y in zip(names, heights, strict=True):
            start = edge - text_width(text, size) if left else edge
            self._canvas.write(text, complex(start, y - size / 2), size)
            foot = complex(edge + (1.0 if left else -1.0), y)
            self._canvas.line("DIMENSION", point, foot)
        self._points = self._canvas.obstacles()


def nearest(box: Box, point: complex) -> complex:
    """The point of a rectangle nearest to another."""
    return complex(min(max(point.real, box.left), box.right), min(max(point.imag, box.low), box.high))


def spread(wanted: list[float], step: float, low: float, high: float) -> list[float]:
    """Places at least ``step`` apart in [low, high], near the wanted ones, which rise; evenly where room is short."""
    count = len(wanted)
    step = min(step, (high - low) / max(count - 1, 1))
    # least squares of places minus their least offsets: pool what would fall below its predecessor
    pools: list[tuple[float, int]] = []
    for index, value in enumerate(wanted):
        mean, size = value - index * step, 1
        while pools and pools[-1][0] > mean:
            other, more = pools.pop()
            mean, size = (other * more + mean * size) / (more + size), more + size
        pools.append((mean, size))
    flat = [mean for mean, size in pools for _ in range(size)]
    top = high - (count - 1) * step
    return [min(max(f, low), top) + index * step for index, f in enumerate(flat)]
