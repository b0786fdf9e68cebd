"""What is drawn on a sheet: curves on layers and lines of text, mm on paper, the origin in the lower left corner.

Every piece of text is as wide as is said here, in any program and with any font: DXF fits it between two points,
SVG states its length. Sizes and line types follow GOST 2.303 and 2.304.
"""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import get_args

import numpy as np

from geometry.approximation.outline import CadCurve, most_spans
from geometry.approximation.splines import SplineFit, fit_spline
from geometry.base.errors import ConvergenceError, ParameterError
from geometry.base.placement import Placement2
from geometry.base.record import Draft, Record, field, replace
from geometry.curves.bspline import BSpline
from geometry.curves.curve import Carried, Complex, Curve
from geometry.curves.line_arc import Arc, Line
from parts.base.psv import rows_of
from parts.base.texts import words
from parts.drawing.font import Run, letter_widths
from parts.keys.sheet import Scale, scale_value

# heights of capitals, mm; GOST 2.304. An index is one smaller
HEIGHTS = (1.8, 2.5, 3.5, 5.0, 7.0)
LEAST_TEXT, SMALL_TEXT, TEXT_HEIGHT, TITLE_TEXT = HEIGHTS[:4]
# of squared paper, mm
SQUARE = 2.5
# letters are narrowed to this part of their width before they are made smaller
NARROWED = 0.9
# the longer side of paper on which names and tables are small, mm
_SMALL_PAPER = 420.0
# frame, mm; GOST 2.104
FRAME_LEFT, FRAME = 20.0, 5.0
# scales that a drawing may have, the greatest first; GOST 2.302
SCALES = tuple(map(scale_value, get_args(Scale)))
# steps of the scales of diagrams; GOST 2.319 leaves them to the drawer, who takes round ones
_STEPS, _ROUNDING = (1.0, 2.0, 2.5, 4.0, 5.0), 1e-9
# what is no way along an axis, mm
_FLAT = 1e-9
# decimals of the points of a curve, mm, by which it is told from others
_PLACES = 6
# words whose lengths are kept
_WORDS = 4096
_INDEX = re.compile(r"_\{([^}]*)\}")
# programs that read DXF take %% for the start of a sign, and know no way to write it: the two stand in two pieces
_PER_CENT = re.compile("(?<=%)(?=%)")
# how far an index stands lower, and what hangs below a line, parts of its height
_DROP, _HANG = 0.2, 0.3


class Style(Record):
    """How a layer looks: width of its lines (mm), dashes and gaps (mm; empty: solid), DXF colour index, SVG colour."""

    width: float
    dashes: tuple[float, ...]
    aci: int
    colour: str


STYLES = {
    layer: Style(float(width), tuple(map(float, dashes.split())), int(aci), colour)
    for layer, width, dashes, aci, colour in rows_of(__file__, "styles")
}


class Stroke(Record):
    """A curve on a layer."""

    layer: str
    curve: CadCurve


# a size with its number, of one word
_SIZE = re.compile(r"\S+ = -?\d")


class Box(Record):
    """An upright rectangle, mm."""

    left: float
    low: float
    right: float
    high: float

    @staticmethod
    def of(points: Iterable[complex]) -> Box:
        """The least that holds some points."""
        xs, ys = zip(*((p.real, p.imag) for p in points), strict=True)
        return Box(min(xs), min(ys), max(xs), max(ys))

    @staticmethod
    def about(boxes: Iterable[Box]) -> Box:
        """The least that holds some."""
        left, low, right, high = zip(*((b.left, b.low, b.right, b.high) for b in boxes), strict=True)
        return Box(min(left), min(low), max(right), max(high))

    @property
    def wide(self) -> float:
        """From left to right."""
        return self.right - self.left

    @property
    def tall(self) -> float:
        """From low to high."""
        return self.high - self.low

    @property
    def middle(self) -> complex:
        """Where its diagonals cross."""
        return complex(self.left + self.right, self.low + self.high) / 2

    @property
    def corners(self) -> tuple[complex, complex, complex, complex]:
        """Counter-clockwise from the lower left one."""
        return (complex(self.left, self.low), complex(self.right, self.low), complex(self.right, self.high),
                complex(self.left, self.high))  # fmt: skip

    def moved(self, by: complex) -> Box:
        """The same elsewhere."""
        return Box(self.left + by.real, self.low + by.imag, self.right + by.real, self.high + by.imag)

    def grown(self, by: float) -> Box:
        """Larger on every side."""
        return Box(self.left - by, self.low - by, self.right + by, self.high + by)

    def overlaps(self, other: Box) -> bool:
        """Whether both have an inner point in common."""
        return self.left < other.right and other.left < self.right and self.low < other.high and other.low < self.high

    def within(self, other: Box) -> bool:
        """Whether this one lies in the other."""
        return (
            self.left >= other.left and self.right <= other.right and self.low >= other.low and self.high <= other.high
        )

    def span(self, start: complex, way: complex, flat: float = _FLAT) -> tuple[float, float]:
        """Where a line lies in it, parts of its ``way`` from the start; the end stands first where it lies nowhere.

        ``flat``: what counts as no step across, and as on its boundary.
        """
        first, last = -math.inf, math.inf
        for at, step, low, high in (
            (start.real, way.real, self.left, self.right),
            (start.imag, way.imag, self.low, self.high),
        ):
            if abs(step) > flat:
                one, two = sorted(((low - at) / step, (high - at) / step))
                first, last = max(first, one), min(last, two)
            elif not low - flat <= at <= high + flat:
                last = -math.inf
        return first, last

    def holds(self, points: Complex) -> int:
        """How many points lie in it."""
        inside = (points.real > self.left) & (points.real < self.right)
        return int(np.count_nonzero(inside & (points.imag > self.low) & (points.imag < self.high)))


class Text(Record):
    """A line of text; ``_{…}`` lowers what stands in the braces.

    ``answer``: whether students find it out themselves; None: as the value of every size in the picture, r = 5.00.
    """

    text: str
    runs: tuple[Run, ...]
    box: Box
    answer: bool | None = None

    def moved(self, by: complex) -> Text:
        """The same elsewhere."""
        return replace(self, runs=tuple(replace(r, at=r.at + by) for r in self.runs), box=self.box.moved(by))

    def asked(self) -> Iterator[Text]:
        """What students see of it: nothing of an answer, the name alone of a size in the picture."""
        if self.answer is None and _SIZE.match(self.text):
            index = next(k for k, run in enumerate(self.runs) if "=" in run.text)
            last = self.runs[index]
            text = last.text.partition("=")[0] + "="
            width = last.width * plain_width(text, last.height) / plain_width(last.text, last.height)
            runs = (*self.runs[:index], replace(last, text=text, width=width))
            yield replace(self, text=self.text.partition("=")[0] + "=", runs=runs)
        elif not self.answer:
            yield self


def text_of(text: str, at: complex, height: float = TEXT_HEIGHT, most: float | None = None) -> Text:
    """A line of text from the left end of its base line, in a height of the standard.

    One longer than ``most`` mm is narrowed a little, made smaller, or narrowed as far as it must.
    """
    told, size, pieces = _fitted(text, height, most)
    runs, x = [], at.real
    for bare, low, drop, lead, long, width in pieces:
        if bare:
            runs.append(Run(bare, complex(x + lead, at.imag - drop), low, long))
        x += width
    # room for what hangs below the line
    hang = max((at.imag - run.at.imag + _HANG * run.height for run in runs), default=0.0)
    return Text(told, tuple(runs), Box(at.real, at.imag - hang, x, at.imag + size * 1.05))


# letters, their height, how far below the line, from the piece's beginning, their length, that of the piece, mm
_Piece = tuple[str, float, float, float, float, float]


@lru_cache(_WORDS)
def _fitted(text: str, height: float, most: float | None) -> tuple[str, float, list[_Piece]]:
    """What a line tells, its height, and of each piece its lengths: words look for their places by the thousand."""
    sizes = [h for h in reversed(HEIGHTS) if h <= height] or [LEAST_TEXT]
    size = next((h for h in sizes if most is None or NARROWED * text_width(text, h) <= most), sizes[-1])
    natural = text_width(text, size)
    squeeze = min(1.0, (natural if most is None else most) / natural) if natural else 1.0
    pieces = []
    for piece, low, is_index in _pieces(text, size):
        lead, bare = piece[: len(piece) - len(piece.lstrip(" "))], piece.strip(" ")
        lead_width, long, width = (plain_width(part, low) * squeeze for part in (lead, bare, piece))
        pieces.append((bare, low, _DROP * size if is_index else 0.0, lead_width, long, width))
    return _INDEX.sub(r"\1", text), size, pieces


def rising_text(
    text: str, at: complex, height: float = TEXT_HEIGHT, most: float | None = None, way: complex = 1j
) -> Text:
    """A line of text turned to be read from the right or as its ``way`` is, from the beginning of its base line."""
    made = text_of(text, 0j, height, most)
    runs = tuple(replace(run, at=at + way * run.at, way=way) for run in made.runs)
    return Text(made.text, runs, Box.of(at + way * corner for corner in made.box.corners[::2]))


@lru_cache(_WORDS)
def _pieces(text: str, height: float) -> tuple[tuple[str, float, bool], ...]:
    """The pieces of a line, each with its height, and whether it is an index: least letters have none lower."""
    index = max((h for h in HEIGHTS if h < height), default=LEAST_TEXT)
    found = ((p, index if k % 2 else height, k % 2 == 1) for k, p in enumerate(_INDEX.split(text)))
    return tuple((part, size, low) for p, size, low in found for part in _PER_CENT.split(p) if part)


def text_width(text: str, height: float = TEXT_HEIGHT) -> float:
    """Length of a line of text, mm."""
    return sum(plain_width(piece, size) for piece, size, _ in _pieces(text, height))


@lru_cache(_WORDS)
def plain_width(text: str, height: float) -> float:
    """Length of letters of one height, mm."""
    widths = letter_widths()
    return height * sum(widths.get(c, 1.0) for c in text)


class Dimension(Record):
    """A dimension of a drawing, on paper; of its numbers ``value`` alone is the model's, mm, or degrees.

    Between the ``points`` along ``angle`` (degrees), its line through ``line``: of a radius from the centre to the arc.
    ``scale``: mm of paper for one of the model; ``text``: its words, <> for the
    number, whose decimal ``mark`` is a point or a comma. ``strokes`` and ``texts``: which of the canvas's it consists
    of; ``middle``: of its words, from which programs that draw them anew put those that are ``beside`` it aside.

    Of an angle ``vertex``, from which its sides go through both points, counter-clockwise; ``line`` is on its arc.
    """

    name: str
    value: float
    scale: float
    points: tuple[complex, complex]
    line: complex
    angle: float
    text: str
    mark: str
    middle: complex
    beside: bool
    strokes: range
    texts: range
    vertex: complex | None = None


class Canvas(Draft):
    """A sheet that grows: paper size (mm) with its name, strokes and texts; ``max_error`` of its splines, mm.

    ``band``: height kept free above the frame's lower side, mm, for a title block; ``columns``: width of what
    stands on the left of the frame, ``foot``: height of what
    stands below it, mm; ``margins``: on the left of the frame and around it, mm.
    """

    width: float
    height: float
    paper: str
    strokes: list[Stroke] = field(default_factory=list)
    texts: list[Text] = field(default_factory=list)
    dimensions: list[Dimension] = field(default_factory=list)
    max_error: float = 0.0
    sampled: bool = False
    band: float = 0.0
    columns: float = 0.0
    foot: float = 0.0
    margins: tuple[float, float] = (FRAME_LEFT, FRAME)
    _drawn: set[tuple[str, frozenset[complex]]] = field(default_factory=set)

    @property
    def layers(self) -> list[str]:
        """Those that have strokes, in the order in which they are drawn."""
        used = {stroke.layer for stroke in self.strokes}
        return [name for name in STYLES if name in used]

    @property
    def letters(self) -> float:
        """Height of the capitals of names and tables, mm: small ones on small paper."""
        return SMALL_TEXT if max(self.width, self.height) <= _SMALL_PAPER else TEXT_HEIGHT

    @property
    def content(self) -> Box:
        """The frame without the band of the title block."""
        frame = self.frame
        return Box(frame.left, frame.low + self.band, frame.right, frame.high)

    @property
    def frame(self) -> Box:
        """The frame that all stands in."""
        left, other = self.margins
        return Box(left, other, self.width - other, self.height - other)

    @property
    def reach(self) -> Box:
        """All that is drawn on: the frame, and what stands in its margin."""
        return replace(self.frame, left=self.frame.left - self.columns, low=self.frame.low - self.foot)

    def line(self, layer: str, start: complex, end: complex) -> None:
        """A straight line."""
        self.add(layer, Line(start, end))

    def add(self, layer: str, curve: CadCurve) -> bool:
        """A curve, unless it stands on its layer already: a side that two tables share, say; whether it did not."""
        points = np.round(curve.point(np.linspace(*curve.domain, 5)), _PLACES)
        place = layer, frozenset(points.tolist())
        if new := place not in self._drawn:
            self._drawn.add(place)
            self.strokes.append(Stroke(layer, curve))
        return new

    def arrow(self, layer: str, tip: complex, way: complex, length: float = 3.0, half: float = 12.0) -> None:
        """The open head of an arrow that points a ``way`` (of length 1), its sides ``half`` degrees from it."""
        for side in (1, -1):
            self.line(layer, tip, tip - length * way * cmath.exp(1j * side * math.radians(half)))

    def box(self, layer: str, box: Box) -> None:
        """Four lines."""
        for start, end in pairwise([*box.corners, box.corners[0]]):
            self.line(layer, start, end)

    def head(self, title: str, margin: float) -> None:
        """The frame, and a title under its upper side, so far from both ends."""
        frame = self.frame
        self.box("FRAME", frame)
        self.write(title, complex(frame.left + margin, frame.high - 9.0), TITLE_TEXT, frame.wide - 2 * margin)

    def squares(self, area: Box, free: Box | None = None) -> None:
        """Squared paper, from the lower left corner; ``free``: squares that are left out, at its right side."""
        free = free or Box(area.right, area.low, area.right, area.low)
        for k in range(int(area.wide / SQUARE + 1e-9) + 1):
            x = area.left + k * SQUARE
            parted = x > free.left + SQUARE / 2
            for low, high in ((area.low, free.low), (free.high, area.high)) if parted else ((area.low, area.high),):
                self.line("ORDINATE", complex(x, low), complex(x, high))
        for k in range(round(area.tall / SQUARE) + 1):
            y = area.low + k * SQUARE
            parted = free.low + SQUARE / 2 < y < free.high - SQUARE / 2
            self.line("ORDINATE", complex(area.left, y), complex(free.left if parted else area.right, y))

    def squares_about(self, at: complex, room: Box, beside: float = 0.0, free: complex = 0j) -> None:
        """Squared paper within a room: a point lies on a corner of squares, or ``beside`` of a square away from it.

        ``free``: width and height of what stays without squares at the right side, below the point's line.
        """
        sides = at.real - room.left, at.imag - room.low, room.right - at.real, room.high - at.imag
        left, below, right, above = ((side // SQUARE - beside) * SQUARE for side in sides)
        box = Box(at.real - left, at.imag - below, at.real + right, at.imag + above)
        wide, tall = (math.ceil(size / SQUARE) * SQUARE for size in (free.real, free.imag))
        self.squares(box, Box(box.right - wide, at.imag - tall, box.right, at.imag))

    def write(
        self, text: str, at: complex, height: float = TEXT_HEIGHT, most: float | None = None, *,
        answer: bool | None = None,
    ) -> Text:  # fmt: skip
        """A line of text from the left end of its base line."""
        made = replace(text_of(text, at, height, most), answer=answer)
        self.texts.append(made)
        return made

    def write_rising(self, text: str, at: complex, height: float, most: float, way: complex = 1j) -> None:
        """A line of text turned to be read from the right or as its ``way`` is, from the beginning of its base line."""
        self.texts.append(rising_text(text, at, height, most, way))

    def take(self, other: Canvas, by: complex) -> None:
        """All strokes and texts of another one, moved."""
        paper = Paper(1.0, by)
        self.strokes += [replace(s, curve=paper.scaled(s.curve)) for s in other.strokes]
        self.texts += [text.moved(by) for text in other.texts]
        self.max_error, self.sampled = max(self.max_error, other.max_error), self.sampled or other.sampled

    def obstacles(self) -> Complex:
        """Points on all strokes, about half a millimetre apart."""
        rows = []
        for curve in (s.curve for s in self.strokes):
            a, b = curve.domain
            rough = curve.point(np.linspace(a, b, 17))
            count = int(np.clip(np.abs(np.diff(rough)).sum() / 0.5, 2, 4000))
            rows.append(curve.point(np.linspace(a, b, count)))
        return np.concatenate(rows) if rows else np.zeros(0, dtype=complex)


def fitted(canvas: Canvas, curves: Sequence[Curve], scale: float, tolerance: float) -> tuple[CadCurve, ...]:
    """Exact curves in model mm as what a file holds; see ``fitted_each``."""
    return tuple(one for made in fitted_each(canvas, curves, scale, tolerance) for one in made)


def fitted_each(canvas: Canvas, curves: Sequence[Curve], scale: float, tolerance: float) -> list[list[CadCurve]]:
    """Exact curves in model mm, each as what a file holds of it: splines where it is neither line nor arc.

    ``tolerance`` in mm on paper; mirror images share one fit, and so does one shape in several places. A curve that one
    spline does not follow is cut at its knots.
    """
    made: list[list[CadCurve]] = [[] for _ in curves]
    done: dict[Curve, BSpline] = {}
    shapes: dict[Curve, tuple[BSpline, Placement2]] = {}
    # the latest of each kind of curves that differ little from one to the next
    alike: dict[object, SplineFit] = {}
    left = [*enumerate(curves)][::-1]
    while left:
        index, curve = left.pop()
        if isinstance(curve, Arc | Line):
            made[index].append(curve)
            continue
        if (twin := done.get(curve.mirrored())) is not None:
            done[curve] = twin.mirrored()
        elif isinstance(curve, Carried) and (found := shapes.get(curve.base)) is not None:
            spline, place = found
            done[curve] = spline.placed(curve.placement @ place.inverse())
        else:
            family = getattr(curve, "family", None)
            most = most_spans(curve)
            try:
                fit = fit_spline(curve, tolerance / scale, degree=3, continuity=2, like=alike.get(family), most=most)
            except ConvergenceError:
                if not curve.knots.size:
                    raise
                left += [(index, part) for part in curve.parts()[::-1]]
                continue
            if family is not None:
                alike[family] = fit
            canvas.max_error = max(canvas.max_error, fit.max_error * scale)
            canvas.sampled = canvas.sampled or fit.bound == "sampled"
            done[curve] = fit.spline
            if isinstance(curve, Carried):
                shapes[curve.base] = fit.spline, curve.placement
        made[index].append(done[curve])
    return made


def exact_each(curves: Sequence[Curve], made: Sequence[Sequence[CadCurve]]) -> list[tuple[Curve, ...]]:
    """The exact curve behind each one of ``fitted_each``: of a curve that was cut at its knots its parts."""
    return [curve.parts() if len(own) > 1 else (curve,) for curve, own in zip(curves, made, strict=True)]


def draw(canvas: Canvas, layer: str, curves: Sequence[CadCurve], paper: Paper) -> None:
    """Curves in model mm on a layer."""
    for curve in curves:
        canvas.add(layer, paper.scaled(curve))


class Paper(Record):
    """Where the model's plane lies on the paper: enlarged ``scale`` times, its origin at ``origin``."""

    scale: float
    origin: complex

    def point(self, point: complex) -> complex:
        """A model point on paper."""
        return self.origin + self.scale * point

    def scaled(self, curve: CadCurve) -> CadCurve:
        """A curve on paper."""
        if isinstance(curve, Line):
            return Line(self.origin + self.scale * curve.start, self.origin + self.scale * curve.end)
        if isinstance(curve, Arc):
            return replace(curve, centre=self.origin + self.scale * curve.centre, radius=self.scale * curve.radius)
        return replace(curve, poles=self.origin + self.scale * curve.poles)


def standard_scale(needed: float) -> float:
    """The least of 1, 2, 2.5, 4, 5 times a power of ten that is not below ``needed`` (units per mm of paper)."""
    if not (needed > 0 and math.isfinite(needed)):
        raise ParameterError("scale", needed, "not_finite_above_zero")
    power = 10.0 ** math.floor(math.log10(needed))
    factor = next((step for step in _STEPS if step * power >= needed * (1 - _ROUNDING)), 10.0)
    return float(f"{factor * power:.6g}")


def scale_name(scale: float) -> str:
    """2:1 or 1:2.5, as scenes have it."""
    return f"{scale:g}:1" if scale >= 1 else f"1:{1 / scale:g}"


def scale_text(scale: float, language: str) -> str:
    """2:1 or 1:2,5."""
    return decimal(scale_name(scale), language)


def decimal(text: str, language: str) -> str:
    """A number as the language writes it."""
    return words(language).decimal(text)
