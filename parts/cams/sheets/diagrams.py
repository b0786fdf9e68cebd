"""S'', S' and S over the cam angle, one below another, with the poles and broken lines of the graphical method."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from geometry.approximation.outline import CadCurve
from geometry.base.record import Draft, field
from geometry.cams.motion.diagrams import diagram, hermite_spline
from geometry.cams.motion.follower_motion import FollowerMotion
from geometry.curves.curve import Curve
from geometry.curves.line_arc import Arc, Line
from parts.base.texts import words
from parts.cams.sheets.picture import CamPicture, Scales, thinned
from parts.drawing.canvas import SMALL_TEXT, SQUARE, TEXT_HEIGHT, Box, Canvas, standard_scale, text_width
from parts.drawing.choice import Asked
from parts.pages.cam_steps import Phases
from parts.texts.sheets import sheet_words

LAYERS = {2: "DIAGRAM_BEND", 1: "DIAGRAM_RATE", 0: "DIAGRAM_LIFT"}
# room on the left for the pole, on the right for the numbers of the ordinate; below for the phases; mm
LEFT, RIGHT, BELOW = 36.0, 17.0, 16.0
# between diagrams, for their names and numbers
_GAP = 15.0
_ORDERS = (2, 1, 0)
_TICKS = 5
# of a square: what counts as none
_SAME = 1e-6
# after the point of an axis' numbers: more than any scale of a drawing has
_MOST_DIGITS = 400
Exact = list[tuple[str, complex, complex]]


class Drawn(Draft):
    """What was drawn and must be read back: exact curves of each layer on paper, straight lines, arcs."""

    curves: dict[str, list[Curve]] = field(default_factory=dict)
    lines: Exact = field(default_factory=list)

    def add(self, canvas: Canvas, layer: str, curve: Curve, tolerance: float) -> None:
        """Draw an exact curve that is given on paper, once where rise and return have the same."""
        shown: CadCurve
        if isinstance(curve, Line | Arc):
            shown = curve
        else:
            shown, error = hermite_spline(curve, tolerance)
            canvas.max_error = max(canvas.max_error, error)
        if canvas.add(layer, shown):
            self.curves.setdefault(layer, []).append(curve)

    def line(self, canvas: Canvas, layer: str, start: complex, end: complex) -> None:
        """Draw a straight line that is checked."""
        canvas.line(layer, start, end)
        self.lines.append((layer, start, end))


def heights_of(area: Box) -> float:
    """How high each diagram may be in an area."""
    return (area.tall - BELOW - 3 * _GAP) / 3


def draw_diagrams(canvas: Canvas, picture: CamPicture, area: Box, scales: Scales, asked: Asked) -> Drawn:
    """All three diagrams in an area, mm; their lines and exact curves on paper.

    By hand: squared paper with the axes, to draw them on.
    """
    drawn, motion, unit = Drawn(), picture.cam.motion, picture.unit
    height, left = heights_of(area), area.left + LEFT
    zeros, top = {}, area.high - _GAP
    for order in _ORDERS:
        low, high = _range(motion, order, unit / scales.of(order))
        # in the middle of its band
        zeros[order] = complex(left, top - (height - (high - low)) / 2 - high)
        top -= height + _GAP
    width = 360 / scales.phi_deg
    _phases(canvas, picture, zeros, left, width, area)
    for order in _ORDERS:
        zero, up = zeros[order], unit / scales.of(order)
        reach = _range(motion, order, up)
        if asked.by_hand:
            # what the diagram reaches is for students to find
            low, high = reach = (
                SQUARE * math.floor(reach[0] / SQUARE + _SAME),
                SQUARE * math.ceil(reach[1] / SQUARE - _SAME),
            )
            canvas.squares(Box(zero.real, zero.imag + low, zero.real + width, zero.imag + high))
        _axes(canvas, picture, zero, width, reach, order, scales)
        _numbers(canvas, picture, zero, scales, order, reach[0] if asked.by_hand else None)
        if not asked.by_hand:
            _ordinates(canvas, drawn, picture, zero, scales, order)
            _curve(canvas, drawn, picture, zero, scales, order, asked.tolerance)
    if picture.drawn is not None and not asked.by_hand:
        _graphical(canvas, drawn, picture, zeros, scales)
    return drawn


def _range(motion: FollowerMotion, order: int, up: float) -> tuple[float, float]:
    low, high = motion.extremes(order)
    return min(low, 0.0) * up, max(high, 0.0) * up


def _axes(
    canvas: Canvas,
    picture: CamPicture,
    zero: complex,
    width: float,
    reach: tuple[float, float],
    order: int,
    scales: Scales,
) -> None:
    """Both axes with arrows and names, and the ordinate's numbers on the right."""
    low, high = reach
    right = zero + width + 9.0
    canvas.line("AXIS", zero, right)
    canvas.arrow("AXIS", right, 1.0)
    top = zero + 1j * (high + 6.0)
    canvas.line("AXIS", zero + 1j * min(low - 2.0, 0.0), top)
    canvas.arrow("AXIS", top, 1j)
    # on the left, where no line of a phase runs
    text = picture.axis_name(order)
    canvas.write(text, top - complex(2.5 + text_width(text), 2.0))
    canvas.write("φ", right + complex(-3.0, 3.0))
    scale = scales.of(order)
    step = standard_scale(max(high - low, 1e-9) * scale / _TICKS)
    digits = next(d for d in range(_MOST_DIGITS) if round(step, d) == step)
    for k in range(math.ceil(low * scale / step - 1e-9), math.floor(high * scale / step + 1e-9) + 1):
        if k == 0:
            continue
        at = zero + width + 1j * (k * step / scale)
        canvas.line("AXIS", at - 0.8, at + 0.8)
        text = picture.say(k * step, digits)
        canvas.write(text, at + complex(1.8, -SMALL_TEXT / 2), SMALL_TEXT)
    canvas.line("AXIS", zero + width + 1j * min(low, 0.0), zero + width + 1j * high)


def _ordinates(canvas: Canvas, drawn: Drawn, picture: CamPicture, zero: complex, scales: Scales, order: int) -> None:
    """A line up to the curve at each position."""
    up = picture.unit / scales.of(order)
    for _, angle in _places(picture):
        value = float(picture.cam.motion.value(angle, order)) * up
        if abs(value) > 1e-6:
            foot = zero + angle / scales.phi
            drawn.line(canvas, "ORDINATE", foot, foot + 1j * value)


def _numbers(canvas: Canvas, picture: CamPicture, zero: complex, scales: Scales, order: int, low: float | None) -> None:
    """The number of each position on the side of the axis that the curve leaves free, or below ``low``, mm."""
    motion, up, places = picture.cam.motion, picture.unit / scales.of(order), _places(picture)
    if low is not None:
        # beside the last one the ordinate has a number
        places = places[:-1]
    x = np.array([a / scales.phi for _, a in places])
    widest = max(text_width(str(n), SMALL_TEXT) for n, _ in places)
    for (number, angle), at, named in zip(places, x.tolist(), thinned(x, widest + 0.8), strict=True):
        if not named:
            continue
        place = 0.8
        if low is not None:
            place = low + SMALL_TEXT * -1.35
        elif _beside(motion, angle, order, 2.0 * scales.phi) * up >= -1e-6:
            place = SMALL_TEXT * -1.35
        canvas.write(str(number), zero + at + complex(0.5, place), SMALL_TEXT)


def _places(picture: CamPicture) -> list[tuple[int, float]]:
    """Numbers and angles of the positions, and the first one again."""
    return [(p.number, p.angle) for p in picture.positions] + [(0, 2 * math.pi)]


def _beside(motion: FollowerMotion, angle: float, order: int, reach: float) -> float:
    """The value of a diagram that counts for the number at ``angle``: the lowest just after it."""
    at = np.linspace(angle, angle + reach, 5)
    return float(np.min(motion.value(at, order)))


def _curve(
    canvas: Canvas, drawn: Drawn, picture: CamPicture, zero: complex, scales: Scales, order: int, tolerance: float
) -> None:
    """The exact curve, piece by piece, upright where it jumps."""
    up, along = picture.unit / scales.of(order), 1 / scales.phi
    before: complex | None = None
    first: complex | None = None
    for piece in picture.cam.motion.pieces:
        curve = diagram(piece, order, zero, along, up)
        a, b = curve.domain
        start, end = complex(curve.point(a)), complex(curve.point(b))
        if before is not None and abs(start - before) > 1e-6:
            drawn.add(canvas, LAYERS[order], Line(before, start), tolerance)
        drawn.add(canvas, LAYERS[order], curve, tolerance)
        first, before = start if first is None else first, end
    assert first is not None
    assert before is not None
    closing = first + 2 * math.pi * along
    # the jump from the end of the turn to its start
    if abs(closing - before) > 1e-6:
        drawn.add(canvas, LAYERS[order], Line(before, closing), tolerance)


def _phases(
    canvas: Canvas, picture: CamPicture, zeros: dict[int, complex], left: float, width: float, area: Box
) -> None:
    """Lines through all diagrams where a phase ends, and the names and angles of the phases below."""
    phases = picture.cam.motion.phases
    low, high = area.low + 4.0, area.high - _GAP + 4.0
    at = left
    counts: dict[str, int] = {}
    names = []
    for kind, _ in Phases(phases, picture.cam.motion.lift).named():
        counts[kind] = counts.get(kind, 0) + 1
        names.append((kind, counts[kind]))
    for index, phase in enumerate(phases):
        length = width * phase.angle / (2 * math.pi)
        if index:
            canvas.line("PHASE", complex(at, low), complex(at, high))
        kind, number = names[index]
        y = low + 2.0
        canvas.line("DIMENSION", complex(at, y), complex(at + length, y))
        for tip, way in ((complex(at, y), -1.0), (complex(at + length, y), 1.0)):
            canvas.arrow("DIMENSION", tip, way, 2.5)
        symbol = sheet_words(picture.language, f"phase_{kind}")
        symbol += str(number) if counts[kind] > 1 else ""
        angle = words(picture.language).decimal(f"{math.degrees(phase.angle):.6g}°")
        text = f"φ_{{{symbol}}} = {angle}"
        size = TEXT_HEIGHT if text_width(text) < length - 2 else SMALL_TEXT
        if text_width(text, size) > length - 1:
            text = angle
        if text_width(text, size) <= length - 1:
            canvas.write(text, complex(at + (length - text_width(text, size)) / 2, y + 1.7), size, answer=False)
        at += length
    for x in (left, left + width):
        canvas.line("PHASE", complex(x, low), complex(x, zeros[0].imag))


def _graphical(canvas: Canvas, drawn: Drawn, picture: CamPicture, zeros: dict[int, complex], scales: Scales) -> None:
    """The broken lines of both integrations, and the poles with their rays for the first rise (fig. 4.6, 4.7)."""
    motion = picture.drawn
    assert motion is not None
    unit = picture.unit
    for phase in motion.phases:
        x = phase.angles / scales.phi
        for order, values in ((1, phase.rate), (0, phase.lift)):
            points = (zeros[order] + x + 1j * values * unit / scales.of(order)).tolist()
            for start, end in pairwise(points):
                drawn.line(canvas, "GRAPHICAL", start, end)
    if not motion.phases:
        return
    phase = motion.phases[0]
    for order, ordinates, reach in ((2, phase.middles, scales.poles[1]), (1, phase.rate_middles, scales.poles[0])):
        if reach > LEFT - 4.0:
            continue
        pole = zeros[order] - reach
        drawn.line(canvas, "GRAPHICAL", pole, zeros[order])
        for value in ordinates.tolist():
            drawn.line(canvas, "GRAPHICAL", pole, zeros[order] + 1j * value * unit / scales.of(order))
        canvas.write(f"P_{{{order}}}", pole + complex(-6.0, -1.0), SMALL_TEXT)
