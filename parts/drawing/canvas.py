"""What is drawn on a sheet: curves on layers and lines of text, mm on paper, the origin in the lower left corner.

Every piece of text is as wide as is said here, in any program and with any font: DXF fits it between two points,
SVG states its length. Sizes and line types follow GOST 2.303 and 2.304.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

import numpy as np

from geometry.approximation.outline import CadCurve
from geometry.approximation.splines import fit_spline
from geometry.base.errors import ParameterError
from geometry.base.record import Draft, Record, field, replace
from geometry.curves.bspline import BSpline
from geometry.curves.curve import Complex, Curve
from geometry.curves.line_arc import Arc, Line
from parts.base.texts import words

# heights of capitals, mm; GOST 2.304
TEXT_HEIGHT, SMALL_TEXT, LEAST_TEXT = 3.5, 2.5, 1.8
# paper sizes (width, height of the upright sheet) and frame, mm; GOST 2.301, 2.104
PAPERS = {"A3": (297.0, 420.0), "A2": (420.0, 594.0), "A1": (594.0, 841.0), "A0": (841.0, 1189.0)}
FRAME_LEFT, FRAME = 20.0, 5.0
# scales that a drawing may have; GOST 2.302
SCALES = (100, 50, 40, 20, 10, 5, 4, 2.5, 2, 1, 1 / 2, 1 / 2.5, 1 / 4, 1 / 5, 1 / 10, 1 / 15, 1 / 20, 1 / 25, 1 / 40,
          1 / 50, 1 / 75, 1 / 100, 1 / 200, 1 / 400, 1 / 500, 1 / 800, 1 / 1000)  # fmt: skip
# steps of the scales of diagrams; GOST 2.319 leaves them to the drawer, who takes round ones
_STEPS, _ROUNDING = (1.0, 2.0, 2.5, 4.0, 5.0), 1e-9
_SUBSCRIPT, _DROP = 0.7, 0.3
# widths of letters as parts of the height of a capital
_NARROW, _WIDE = set("iljtfrIі.,:;'|()[]! °"), set("mwMWшщжюмфШЩЖЮМФ@—")


class Style(Record):
    """How a layer looks: width of its lines (mm), dashes and gaps (mm; empty: solid), DXF colour index, SVG colour."""

    width: float
    dashes: tuple[float, ...]
    aci: int
    colour: str


_DASH_DOT = (12.0, 1.75, 0.5, 1.75)
_DASHED = (4.0, 1.5)
STYLES: dict[str, Style] = {
    "FRAME": Style(0.5, (), 7, "#000000"),
    "TABLE": Style(0.25, (), 7, "#000000"),
    "RACK": Style(0.18, (), 8, "#808080"),
    "OUTLINE": Style(0.5, (), 7, "#000000"),
    "ACTIVE_FLANK": Style(1.0, (), 1, "#c00000"),
    "TOOTH_START": Style(0.25, _DASHED, 5, "#2040c0"),
    "TOOTH_END": Style(0.25, _DASHED, 6, "#a000a0"),
    "CENTRE": Style(0.25, _DASH_DOT, 7, "#404040"),
    "CIRCLE_TIP": Style(0.25, (), 7, "#303030"),
    "CIRCLE_WORKING": Style(0.35, _DASH_DOT, 3, "#007020"),
    "CIRCLE_REFERENCE": Style(0.25, _DASH_DOT, 4, "#007890"),
    "CIRCLE_BASE": Style(0.25, (), 30, "#c06000"),
    "CIRCLE_ROOT": Style(0.25, (), 8, "#606060"),
    "TANGENT": Style(0.25, (), 8, "#606060"),
    "LINE_OF_ACTION": Style(0.35, (), 1, "#c00000"),
    "ACTIVE_LINE": Style(0.7, (), 1, "#c00000"),
    "ARC_OF_ACTION": Style(0.7, (), 5, "#2040c0"),
    "WORKING_PITCH": Style(0.7, (), 3, "#007020"),
    "DISK": Style(0.5, (), 7, "#000000"),
    "HATCH": Style(0.13, (), 8, "#909090"),
    "CONSTRUCTION": Style(0.13, (), 8, "#a0a0a0"),
    "ORDINATE": Style(0.13, (), 8, "#a0a0a0"),
    "AXIS": Style(0.35, (), 7, "#000000"),
    "PHASE": Style(0.25, _DASH_DOT, 8, "#606060"),
    "SCHEME": Style(0.7, (), 7, "#000000"),
    "VELOCITY": Style(0.6, (), 5, "#2040c0"),
    "ANGULAR_VELOCITY": Style(0.6, (), 1, "#c00000"),
    "DIAGRAM_BEND": Style(0.6, (), 1, "#c00000"),
    "DIAGRAM_RATE": Style(0.6, (), 3, "#007020"),
    "DIAGRAM_LIFT": Style(0.6, (), 5, "#2040c0"),
    "GRAPHICAL": Style(0.18, (), 6, "#a000a0"),
    "JOINT_DIAGRAM": Style(0.6, (), 5, "#2040c0"),
    "GAMMA_TANGENT": Style(0.35, (), 1, "#c00000"),
    "RETURN_TANGENT": Style(0.25, _DASHED, 1, "#c00000"),
    "OFFSET_AXIS": Style(0.25, _DASH_DOT, 4, "#007890"),
    "CIRCLE_PRIME": Style(0.25, (), 30, "#c06000"),
    "CIRCLE_OFFSET": Style(0.25, (), 4, "#007890"),
    "CIRCLE_FAR": Style(0.18, _DASHED, 8, "#606060"),
    "CIRCLE_PIVOT": Style(0.25, _DASH_DOT, 4, "#007890"),
    "FOLLOWER": Style(0.25, (), 3, "#007020"),
    "ROLLER": Style(0.25, (), 3, "#007020"),
    "PITCH_CURVE": Style(0.35, _DASH_DOT, 5, "#2040c0"),
    "CAM": Style(0.9, (), 7, "#000000"),
    "DIMENSION": Style(0.18, (), 8, "#505050"),
    "TEXT": Style(0.25, (), 7, "#000000"),
}


class Stroke(Record):
    """A curve on a layer."""

    layer: str
    curve: CadCurve


class Run(Record):
    """A piece of text in one line and height: left end of its base line, height of a capital and length, mm."""

    text: str
    at: complex
    height: float
    width: float


class Box(Record):
    """An upright rectangle, mm."""

    left: float
    low: float
    right: float
    high: float

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

    def holds(self, points: Complex) -> int:
        """How many points lie in it."""
        inside = (points.real > self.left) & (points.real < self.right)
        return int(np.count_nonzero(inside & (points.imag > self.low) & (points.imag < self.high)))


class Text(Record):
    """A line of text; ``_{…}`` lowers what stands in the braces."""

    text: str
    runs: tuple[Run, ...]
    box: Box


def text_of(text: str, at: complex, height: float = TEXT_HEIGHT, most: float | None = None) -> Text:
    """A line of text from the left end of its base line; one longer than ``most`` mm is made smaller, then narrower."""
    if most is not None and text_width(text, height) > most:
        # many viewers do not narrow letters: what fits by its size fits everywhere
        height *= max(min(1.0, LEAST_TEXT / height), most / text_width(text, height))
    pieces = [(p, False) if i % 2 == 0 else (p, True) for i, p in enumerate(re.split(r"_\{([^}]*)\}", text)) if p]
    natural = text_width(text, height)
    squeeze = min(1.0, (most or natural) / natural) if natural else 1.0
    runs, x = [], at.real
    lowered = False
    for piece, is_low in pieces:
        size = height * _SUBSCRIPT if is_low else height
        width = plain_width(piece, size) * squeeze
        bare = piece.strip(" ")
        if bare:
            lead = plain_width(piece[: len(piece) - len(piece.lstrip(" "))], size) * squeeze
            place = complex(x + lead, at.imag - (_DROP * height if is_low else 0.0))
            runs.append(Run(bare, place, size, plain_width(bare, size) * squeeze))
            lowered = lowered or is_low
        x += width
    # room for what hangs below the line
    box = Box(at.real, at.imag - (0.35 if lowered else 0.3) * height, x, at.imag + height * 1.05)
    return Text(re.sub(r"_\{([^}]*)\}", r"\1", text), tuple(runs), box)


def text_width(text: str, height: float = TEXT_HEIGHT) -> float:
    """Length of a line of text, mm."""
    pieces = re.split(r"_\{([^}]*)\}", text)
    return sum(plain_width(p, height * (_SUBSCRIPT if i % 2 else 1)) for i, p in enumerate(pieces))


def plain_width(text: str, height: float) -> float:
    """Length of letters of one height, mm."""
    return height * sum(_letter_width(c) for c in text)


def _letter_width(letter: str) -> float:
    if letter in _NARROW:
        return 0.45
    return 1.15 if letter in _WIDE else 1.02 if letter.isupper() else 0.8


class Canvas(Draft):
    """A sheet that grows: paper size (mm) with its name, strokes and texts; ``max_error`` of its splines, mm.

    ``band``: height kept free above the frame's lower side, mm, for a title block.
    """

    width: float
    height: float
    paper: str
    strokes: list[Stroke] = field(default_factory=list)
    texts: list[Text] = field(default_factory=list)
    max_error: float = 0.0
    sampled: bool = False
    band: float = 0.0

    @property
    def content(self) -> Box:
        """The frame without the band of the title block."""
        frame = self.frame
        return Box(frame.left, frame.low + self.band, frame.right, frame.high)

    @property
    def frame(self) -> Box:
        """The frame that all stands in."""
        return Box(FRAME_LEFT, FRAME, self.width - FRAME, self.height - FRAME)

    def line(self, layer: str, start: complex, end: complex) -> None:
        """A straight line."""
        self.strokes.append(Stroke(layer, Line(start, end)))

    def arc(self, layer: str, arc: Arc) -> None:
        """An arc or a full circle."""
        self.strokes.append(Stroke(layer, arc))

    def box(self, layer: str, box: Box) -> None:
        """Four lines."""
        corners = (complex(box.left, box.low), complex(box.right, box.low), complex(box.right, box.high),
                   complex(box.left, box.high))  # fmt: skip
        for start, end in zip(corners, (*corners[1:], corners[0]), strict=True):
            self.line(layer, start, end)

    def write(self, text: str, at: complex, height: float = TEXT_HEIGHT, most: float | None = None) -> Text:
        """A line of text from the left end of its base line."""
        made = text_of(text, at, height, most)
        self.texts.append(made)
        return made

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
    """Exact curves in model mm as what a file holds: splines where they are neither line nor arc.

    ``tolerance`` in mm on paper; mirror images share one fit.
    """
    done: dict[Curve, CadCurve] = {}
    for curve in curves:
        if isinstance(curve, Arc | Line):
            done[curve] = curve
        elif (twin := done.get(curve.mirrored())) is not None and isinstance(twin, BSpline):
            done[curve] = twin.mirrored()
        else:
            fit = fit_spline(curve, tolerance / scale, degree=3, continuity=2)
            canvas.max_error = max(canvas.max_error, fit.max_error * scale)
            canvas.sampled = canvas.sampled or fit.bound == "sampled"
            done[curve] = fit.spline
    return tuple(done[curve] for curve in curves)


def draw(canvas: Canvas, layer: str, curves: Sequence[CadCurve], paper: Paper) -> None:
    """Curves in model mm on a layer."""
    canvas.strokes += [Stroke(layer, paper.scaled(curve)) for curve in curves]


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
    for factor in (*_STEPS, 10.0):
        if factor * power >= needed * (1 - _ROUNDING):
            return float(f"{factor * power:.6g}")
    return 10.0 * power


def scale_text(scale: float, language: str) -> str:
    """2:1 or 1:2,5."""
    text = f"{scale:g}:1" if scale >= 1 else f"1:{1 / scale:g}"
    return decimal(text, language)


def decimal(text: str, language: str) -> str:
    """A number as the language writes it."""
    return words(language).decimal(text)
