"""The sheet of a worm in its wheel: lines of contact on both flanks of a tooth, and their zone along the worm."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np

from geometry.approximation.tensor import clamped, greville
from geometry.base.errors import ParameterError
from geometry.base.record import Record, replace
from geometry.curves.bspline import BSpline, basis_matrix
from geometry.curves.curve import Complex, Real
from geometry.gears.worms.field import Field
from parts.drawing.canvas import Box, Canvas, Paper, decimal, scale_text
from parts.drawing.choice import Asked, sheet_for
from parts.drawing.expected import Expected
from parts.drawing.labels import Labeller
from parts.drawing.readback import ReadSheet, Taken, lines_missing
from parts.drawing.table import Row, Table
from parts.mates.worm import WormMating
from parts.texts.sheets import sheet_words

_TITLE, _GAP, _LEGEND = 14.0, 8.0, 12.0
# places of the worm in a pitch; lines of the first are drawn strong
_PLACES = 6
_NOW, _LATER, _FIELDS = "ACTIVE_LINE", "CONSTRUCTION", ("TOOTH_START", "TOOTH_END")
_TOOTH = "OUTLINE"
# the least height of a tooth on paper, mm, below which larger paper is better
_LEAST_TOOTH = 20.0
# spans of a line's spline: the first try and the most
_SPANS, _MOST_SPANS = 8, 512
# points of a line that are held against the closed form
_LOOKED_AT = 41


class _Line(Record):
    """A line on the wheel's lower flank between heights, mm.

    ``exact``: at heights, the distance from the wheel's axis and, imaginary, the place along the worm, mm.
    """

    heights: tuple[float, float]
    exact: Callable[[Real], Complex]

    def spline(self, tolerance: float) -> tuple[BSpline, float]:
        """The cubic through exact points, its parameter the height, and how far it is off between them, mm."""
        count = _SPANS
        while True:
            knots = clamped(3, np.linspace(*self.heights, count + 1))
            places = greville(3, knots)
            poles: Complex = np.linalg.solve(basis_matrix(3, knots, places), self.exact(places)).astype(np.complex128)
            made = BSpline(3, knots, poles)
            between = np.linspace(*self.heights, 4 * count + 1)
            off = float(np.abs(made.point(between) - self.exact(between)).max())
            if off <= tolerance:
                return made, off
            if count > _MOST_SPANS:
                raise ParameterError("tolerance", tolerance, "tolerance_not_met", None, residual=off, steps=count)
            count *= 2


class _View(Record):
    """How a line is drawn; ``way`` -1: after half a turn about the line of centres, that of the upper flank.

    Heights run to the right in views ``of_wheel``, upwards in those of the worm.
    """

    layer: str
    line: _Line
    way: int
    of_wheel: bool
    paper: Paper

    def points(self, heights: Real, place: Complex) -> Complex:
        """Heights and places of the line, or poles of both, in the view, mm."""
        if self.of_wheel:
            return np.asarray(self.way * heights + 1j * place.real)
        return np.asarray(self.way * (place.imag + 1j * heights))

    def heights(self, points: Complex) -> Real:
        """Heights of points of the view, mm."""
        return np.asarray(self.way * (points.real if self.of_wheel else points.imag))


class WormMeasures(Record):
    """Every line is read back and held against the closed form at the heights at which it was read."""

    curves: tuple[_View, ...]

    def check(self, sheet: ReadSheet, taken: Taken) -> None:
        """Deviation of lines of contact and of the fields' borders on paper, mm."""
        worst = 0.0
        for layer in (_NOW, _LATER, *_FIELDS, _TOOTH):
            wanted = [curve for curve in self.curves if curve.layer == layer]
            found = [points for name, points in sheet.samples if name == layer]
            if len(found) < len(wanted):
                taken.failures.append(lines_missing(layer, found, wanted))
                continue
            # files keep the order of drawing within a layer
            for points, curve in zip(found, wanted, strict=False):
                model = (points - curve.paper.origin) / curve.paper.scale
                heights, (low, high) = curve.heights(model), curve.line.heights
                ends = max(abs(heights.min() - low), abs(heights.max() - high))
                some = np.linspace(0, len(points) - 1, min(len(points), _LOOKED_AT)).round().astype(int)
                at = np.clip(heights[some], low, high)
                off = np.abs(model[some] - curve.points(at, curve.line.exact(at))).max()
                worst = max(worst, curve.paper.scale * float(max(off, ends)))
        taken.measured["contact_line_deviation"] = worst
        taken.unless(worst <= taken.room, "lines of contact are {worst:.3g} mm off", worst=worst)


def worm_sheet(mating: WormMating, field: Field, title: str, asked: Asked) -> Expected:
    """The sheet of a pair; ``title``: of both parts.

    Raises
    ------
    ParameterError
        The paper that is asked for is too small, or none is large enough; the tolerance cannot be met.
    """
    language, teeth, worm = asked.language, field.teeth, mating.worm
    rows = _rows(mating, field, language)
    root = float(teeth.root_radius(0.0))
    depth = float(teeth.tip_radius(teeth.width / 2)) - root
    wide = max(mating.body.length, 2 * mating.body.start[0], field.length_used())

    def room(sheet: Canvas) -> Box:
        size, content = Table((*rows, _scale(1.0, language)), sheet.letters).size, sheet.content.grown(-_GAP)
        right, low = content.right, content.low
        if sheet.height > sheet.width:
            low += size[1] + _GAP
        else:
            right -= size[0] + _GAP
        return Box(content.left, low, right, sheet.content.high - _TITLE - _GAP)

    def greatest(sheet: Canvas) -> float:
        box = room(sheet)
        across, up = box.wide, box.tall - 3 * _LEGEND
        return max(min(across / wide, (across - 2 * _GAP) / (2 * teeth.width), up / (2 * worm.tip_radius + depth)), 0.0)

    canvas, scale = sheet_for(asked, greatest, _LEAST_TOOTH / depth)
    box = room(canvas)
    middle, spare = box.middle.real, teeth.width * scale / 2 + _GAP
    # room that is left over goes between, above and below
    spread = (box.tall - scale * (2 * worm.tip_radius + depth)) / 3
    flanks = [Paper(scale, complex(middle + way * spare, box.low + spread - scale * root)) for way in (-1, 1)]
    along = Paper(scale, complex(middle, box.high - spread - scale * worm.tip_radius))
    canvas.head(f"{sheet_words(language, 'worm')}: {title}", _GAP)
    curves = _curves(field, flanks, along, math.pi * worm.module)
    _draw_curves(canvas, curves, scale, asked.tolerance)
    _draw_sides(canvas, field, flanks, along)
    _draw_worm(canvas, mating, along)
    table = Table((*rows, _scale(scale, language)), canvas.letters)
    table.draw(canvas, complex(canvas.content.right - table.size[0], canvas.content.low))
    labels = Labeller(canvas, box)
    half = field.length_used() / 2
    high = along.point(1j * worm.tip_radius) + 0.6j * _LEGEND
    for x in (-half, half):
        canvas.line("DIMENSION", along.point(complex(x, 0)), along.point(complex(x, worm.tip_radius)) + 0.7j * _LEGEND)
    canvas.line("DIMENSION", high - scale * half, high + scale * half)
    labels.name(f"b_{{1u}} = {decimal(f'{2 * half:.2f}', language)}", high, prefer=1j)
    for number, paper in enumerate(flanks, 1):
        labels.name(str(number), paper.point(1j * (root + depth)), prefer=1j)
    return Expected(canvas, along, (), measures=WormMeasures(tuple(curves)))


def _draw_curves(canvas: Canvas, curves: list[_View], scale: float, tolerance: float) -> None:
    """Each line, whose views share one spline, in its places."""
    made: dict[int, BSpline] = {}
    for curve in curves:
        key = id(curve.line)
        if key not in made:
            # an eighth of the tolerance is left to the file's numbers
            made[key], off = curve.line.spline(0.875 * tolerance / scale)
            canvas.max_error, canvas.sampled = max(canvas.max_error, off * scale), True
        fit = made[key]
        seen = replace(fit, poles=curve.points(greville(3, fit.knots), fit.poles))
        canvas.add(curve.layer, curve.paper.scaled(seen))


def _curves(field: Field, flanks: list[Paper], along: Paper, pitch: float) -> list[_View]:
    """Lines of contact, borders of the field and of the tooth: on flank 1 and its turned image 2, and on the worm."""
    teeth = field.teeth
    first, last = field.slides()
    numbers = np.arange(math.ceil(first / pitch * _PLACES), math.floor(last / pitch * _PLACES) + 1)

    def touched(heights: Real, radii: Real) -> Complex:
        cut = field.touching(heights, radii)
        return np.asarray(np.abs(cut.plane) + 1j * cut.touching.imag)

    def contact(slide: float) -> Callable[[Real], Complex]:
        return lambda heights: touched(heights, field.line(heights, slide))

    def along_radius(radius: Callable[[Real], Real]) -> Callable[[Real], Complex]:
        return lambda heights: radius(heights).astype(np.complex128)

    def border(end: int) -> Callable[[Real], Complex]:
        return lambda heights: touched(heights, field.edges(heights)[end])

    slides = numbers * pitch / _PLACES
    lines = [
        (_LATER if numbers[k] % _PLACES else _NOW, _Line((a, b), contact(slides[k]))) for k, a, b in field.lines(slides)
    ]
    spans = list(pairwise(teeth.breaks))
    borders = [_Line(span, border(end)) for span in field.spans() for end in (0, 1)]
    tooth = [_Line(span, along_radius(r)) for span in spans for r in (teeth.root_radius, teeth.tip_radius)]
    found = []
    for way, flank, layer in zip((1, -1), flanks, _FIELDS, strict=True):
        for name, line in (*lines, *((layer, line) for line in borders)):
            found += [_View(name, line, way, True, flank), _View(name, line, way, False, along)]
        found += [_View(_TOOTH, line, way, True, flank) for line in tooth]
    return found


def _draw_sides(canvas: Canvas, field: Field, flanks: list[Paper], along: Paper) -> None:
    """Straight sides of the tooth and of the fields, at the ends of the face; of a field where it goes as far."""
    half = field.teeth.width / 2
    ends = np.array([-half, half])
    root, tip = field.teeth.root_radius(ends), field.teeth.tip_radius(ends)
    edges = field.edges(ends)
    there, cuts = np.greater(*edges), [field.touching(ends, radii) for radii in edges]
    for way, paper, layer in zip((1, -1), flanks, _FIELDS, strict=True):
        for k, height in enumerate(ends.tolist()):
            canvas.line(_TOOTH, *(paper.point(complex(way * height, r[k])) for r in (root, tip)))
            if there[k]:
                canvas.line(layer, *(along.point(way * complex(cut.touching.imag[k], height)) for cut in cuts))


def _draw_worm(canvas: Canvas, mating: WormMating, paper: Paper) -> None:
    """Its thread's outline, seen along the line of centres, and its axis."""
    worm, body = mating.worm, mating.body
    foot = complex(body.length / 2, worm.root_radius)
    above = [complex(z, r) for z, r in reversed(body.envelope()) if abs(z) <= body.start[0]]
    corners = [*above, *(p.conjugate() for p in reversed(above))]
    for start, end in zip(corners, (*corners[1:], corners[0]), strict=True):
        canvas.line(_TOOTH, paper.point(start), paper.point(end))
    for side in (1, -1):
        canvas.line("CIRCLE_ROOT", paper.point(complex(-foot.real, side * foot.imag)),
                    paper.point(complex(foot.real, side * foot.imag)))  # fmt: skip
    canvas.line("CENTRE", paper.point(-foot.real) - 4, paper.point(foot.real) + 4)


def _scale(scale: float, language: str) -> Row:
    return Row(sheet_words(language, "scale"), "", scale_text(scale, language), answers=0)


def _rows(mating: WormMating, field: Field, language: str) -> list[Row]:
    worm, teeth = mating.worm, field.teeth
    first, last = field.slides()

    def row(key: str, symbol: str, value: float, digits: str = ".6g", answers: int = 1) -> Row:
        return Row(sheet_words(language, key), symbol, decimal(f"{value:{digits}}", language), answers=answers)

    samples = (
        ("contact_now", _NOW),
        ("contact_later", _LATER),
        *zip(("worm_field_1", "worm_field_2"), _FIELDS, strict=True),
    )
    return [
        row("module", "m", worm.module, answers=0),
        row("worm_quotient", "q", worm.diameter_quotient, answers=0),
        row("worm_starts", "z_{1}", worm.number_of_starts, answers=0),
        row("number_of_teeth", "z_{2}", teeth.number_of_teeth, answers=0),
        row("centre_distance", "a_{w}", mating.distance, ".3f"),
        row("rim_width", "b_{2}", teeth.width, answers=0),
        row("worm_thread", "b_{1}", mating.body.length, answers=0),
        row("worm_used", "b_{1u}", field.length_used(), ".2f"),
        row("ratio", "ε_{γ}", (last - first) / (math.pi * worm.module), ".4f"),
        *(Row(sheet_words(language, key), sample=layer) for key, layer in samples),
    ]
