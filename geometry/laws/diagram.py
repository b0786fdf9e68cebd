"""Acceleration diagrams: segments side by side, closed integrals, and the scaling to the lift.

A diagram is drawn in any scale: only the shares of the widths and of the ordinates count. Lessons 4 and 5 of the
practicum give laws in this way and integrate them by chords; here the integrals are exact.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from geometry.base.errors import ParameterError
from geometry.base.record import Record
from geometry.laws.law import Law
from geometry.laws.piece import LawPiece, Wave

# areas above and below the axis must agree to this part of them: typed ordinates are rounded
_CLOSING = 1e-9
# a shorter span of a sine would be integrated as a difference of large numbers
_LEAST_SPAN = math.pi / 8
# share of the phase: ends of curves on a narrower one miss each other by rounding; 2000 points side by side are wider
LEAST_STRETCH = 5e-4


class Stretch(Record):
    """A segment of an acceleration diagram: its width and, over v = 0 to 1, Bernstein coefficients and waves."""

    width: float
    coefficients: tuple[float, ...] = (0.0,)
    waves: tuple[Wave, ...] = ()

    def scaled(self, factor: float) -> Stretch:
        """The segment with its ordinates multiplied."""
        waves = tuple(Wave(factor * w.amplitude, w.frequency, w.phase) for w in self.waves)
        return Stretch(self.width, tuple(factor * c for c in self.coefficients), waves)


def constant(width: float, ordinate: float) -> Stretch:
    """A horizontal segment."""
    return Stretch(width, (ordinate,))


def linear(width: float, first: float, last: float) -> Stretch:
    """A sloping segment."""
    return Stretch(width, (first, last))


def sine(width: float, peak: float, first_angle: float, last_angle: float) -> Stretch:
    """peak sin(angle), the angle running from first to last, rad: any part of a sine or cosine.

    Raises
    ------
    ParameterError
        The angles are nearer than pi/8.
    """
    span = last_angle - first_angle
    if not abs(span) >= _LEAST_SPAN:
        raise ParameterError("last_angle", last_angle, "angles_too_near", least=_LEAST_SPAN)
    return Stretch(width, (0.0,), (Wave(peak, span, first_angle),))


def half_sine(width: float, peak: float) -> Stretch:
    """0 up to the peak and down to 0."""
    return sine(width, peak, 0.0, math.pi)


def quarter_sine(width: float, peak: float) -> Stretch:
    """0 up to the peak, where it is horizontal."""
    return sine(width, peak, 0.0, math.pi / 2)


def quarter_cosine(width: float, peak: float) -> Stretch:
    """Horizontal at the peak, down to 0."""
    return sine(width, peak, math.pi / 2, math.pi)


def half_cosine(width: float, first: float, last: float) -> Stretch:
    """Horizontal at both ends: (first + last)/2 + (first - last)/2 cos(pi v)."""
    return Stretch(width, ((first + last) / 2,), (Wave((first - last) / 2, math.pi, math.pi / 2),))


def trapezoid(width: float, ordinate: float, up: float, down: float | None = None) -> list[Stretch]:
    """0, ramp up over the share ``up`` of the width, level, ramp down over ``down`` (default: as up), 0.

    Raises
    ------
    ParameterError
        The ramps take more than the whole width.
    """
    down = up if down is None else down
    if not (up >= 0 and down >= 0 and up + down <= 1):
        raise ParameterError("up", up, "ramps_above_width")
    level = 1 - up - down
    parts = [
        (up, linear(width * up, 0.0, ordinate)),
        (level, constant(width * level, ordinate)),
        (down, linear(width * down, ordinate, 0.0)),
    ]
    return [stretch for share, stretch in parts if share > 1e-12]


def polynomial(width: float, powers: Sequence[float]) -> Stretch:
    """Sum of powers[k] v^k over the segment, v from 0 to 1."""
    n = len(powers) - 1
    values = [sum(math.comb(i, k) / math.comb(n, k) * powers[k] for k in range(i + 1)) for i in range(n + 1)]
    return Stretch(width, tuple(values))


def tabulated(width: float, places: Sequence[float], ordinates: Sequence[float]) -> list[Stretch]:
    """A cubic spline through ordinates at rising places, the first and last of which are the segment's ends.

    "Not a knot" at both ends, a line or parabola for two or three points.

    Raises
    ------
    ParameterError
        Fewer than two points, or places that do not rise.
    """
    from geometry.laws.splines import cubic_pieces

    scale = width / (places[-1] - places[0])
    return [
        Stretch((b - a) * scale, values)
        for a, b, values in cubic_pieces(np.asarray(places, float), np.asarray(ordinates, float), periodic=False)
    ]


def law_of_diagram(name: str, stretches: Sequence[Stretch], *, balance: bool = False) -> Law:
    """The law whose acceleration is the diagram, scaled so that lift and phase are 1.

    ``balance``: scale the segments whose area lies below the axis so that velocity returns to 0.

    Raises
    ------
    ParameterError
        A width that is not positive, a diagram that does not close, or one that does not lift.
    """
    widths = [s.width for s in stretches]
    for index, width in enumerate(widths):
        if not width > 0 or not math.isfinite(width):
            raise ParameterError(f"diagram[{index + 1}].width", width, "not_above_zero")
    parts = _shared("diagram", stretches, 1.0)
    areas = [_area(s) for s in parts]
    above, below = sum(a for a in areas if a > 0), -sum(a for a in areas if a < 0)
    if balance and above > 0 and below > 0:
        parts = [s.scaled(above / below) if a < 0 else s for s, a in zip(parts, areas, strict=True)]
        areas = [_area(s) for s in parts]
    size = sum(_size(s) for s in parts)
    if not size > 0:
        raise ParameterError("diagram", None, "diagram_on_axis")
    if not abs(math.fsum(areas)) <= _CLOSING * size:
        if not (above > 0 and below > 0):
            raise ParameterError("diagram", None, "diagram_on_one_side", above=above, below=below)
        factor = above / below
        raise ParameterError("diagram", None, "diagram_not_closed", above=above, below=below, factor=factor)
    pieces = _integrated(parts, 0.0, 1.0)
    lift = float(pieces[-1].value(pieces[-1].end))
    if not lift > _CLOSING * size:
        raise ParameterError("diagram", None, "diagram_lifts_nothing")
    pieces = _integrated(parts, 0.0, 1 / lift)
    return Law(name, tuple(pieces))


def law_of_halves(name: str, first: Sequence[Stretch], second: Sequence[Stretch], *, share: float = 0.5) -> Law:
    """Asymmetric rise: the shape of each half, the first taking ``share`` of the phase.

    Each half is scaled by itself, so that velocity returns to 0 and the lift is 1; give both with ordinates of any
    size, the second one's may be drawn above or below the axis.

    Raises
    ------
    ParameterError
        A share not inside 0 to 1, or a half without area.
    """
    if not 0 < share < 1:
        raise ParameterError("share", share, "not_within", low=0.0, high=1.0)
    halves = []
    for label, stretches, width in (("first", first, share), ("second", second, 1 - share)):
        parts = _shared(f"{label}_half", stretches, width)
        area = sum(_area(s) for s in parts)
        if area == 0:
            raise ParameterError(f"{label}_half", None, "half_without_area")
        halves.append([s.scaled(1 / area) for s in parts])
    return law_of_diagram(name, [*halves[0], *(s.scaled(-1.0) for s in halves[1])])


def _shared(name: str, stretches: Sequence[Stretch], share: float) -> list[Stretch]:
    """The segments, which together take a share of the phase; refused as ``name`` where one is too narrow."""
    whole = sum(s.width for s in stretches)
    parts = [Stretch(s.width / whole * share, s.coefficients, s.waves) for s in stretches]
    refuse_narrow(name, None, parts)
    return parts


def refuse_narrow(name: str, value: object, stretches: Sequence[Stretch]) -> None:
    """Refuse a parameter that makes a segment, in shares of the phase, too narrow for an outline."""
    if (narrow := min(s.width for s in stretches)) < LEAST_STRETCH * (1 - 1e-9):
        raise ParameterError(name, value, "narrow_stretch", share=narrow, least=LEAST_STRETCH)


def _area(stretch: Stretch) -> float:
    """Integral of a segment over its width."""
    waves = sum(
        w.amplitude / w.frequency * (math.cos(w.phase) - math.cos(w.frequency + w.phase)) for w in stretch.waves
    )
    return stretch.width * (sum(stretch.coefficients) / len(stretch.coefficients) + waves)


def _size(stretch: Stretch) -> float:
    """A bound of the area between a segment and the axis."""
    return stretch.width * (max(map(abs, stretch.coefficients)) + sum(abs(w.amplitude) for w in stretch.waves))


def _integrated(parts: Sequence[Stretch], velocity: float, factor: float) -> list[LawPiece]:
    """The displacement of segments that share the width 1, from 0 and ``velocity``; ordinates times ``factor``."""
    pieces: list[LawPiece] = []
    at, s = 0.0, 0.0
    for index, part in enumerate(parts):
        part = part.scaled(factor)
        h = part.width
        waves = tuple(Wave(-w.amplitude * (h / w.frequency) ** 2, w.frequency / h, w.phase) for w in part.waves)
        wave_s = sum(w.amplitude * math.sin(w.phase) for w in waves)
        wave_v = sum(w.amplitude * w.frequency * math.cos(w.phase) for w in waves)
        speed = _primitive(part.coefficients, velocity - wave_v, h)
        place = _primitive(speed, s - wave_s, h)
        end = 1.0 if index == len(parts) - 1 else at + h
        piece = LawPiece(at, end, place, waves)
        s, velocity = float(piece.value(end)), float(piece.value(end, 1))
        pieces.append(piece)
        at = end
    return pieces


def _primitive(values: tuple[float, ...], first: float, width: float) -> tuple[float, ...]:
    """Bernstein coefficients of an integral over an interval of a width, from a first value."""
    steps = np.concatenate([[first], np.array(values) * (width / len(values))])
    return tuple(np.cumsum(steps).tolist())
