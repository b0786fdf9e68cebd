"""The working drawing of a part on paper: its views, block of data, general roughness, requirements; GOST 2.109."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache
from itertools import product

import numpy as np

from geometry.base.errors import ParameterError
from geometry.base.record import Record, replace
from geometry.curves.curve import Complex, Curve
from geometry.curves.line_arc import Arc
from geometry.plane.measure import distance_to_curve
from parts.base.texts import N_, fault
from parts.drawing.canvas import SCALES, TEXT_HEIGHT, Box, Canvas, Paper, scale_text
from parts.drawing.cells import wrapped
from parts.drawing.choice import Asked, blank, sheet_for
from parts.drawing.dimensioning import ROWS, Laid, laid, least_rows, moved, rough_sign
from parts.drawing.expected import Expected
from parts.drawing.readback import ReadSheet, Taken
from parts.drawing.title_block import TITLE_BLOCK, turned_box
from parts.drawing.working import PartDrawing, Stroke, View, number_text

# from line to line of requirements; room for the sign of roughness; mm
_LINE, _SIGN = 7.0, (48.0, 20.0)
# from the frame to views, from view to view, mm
_MARGIN, _BETWEEN = 5.0, 12.0
# the largest extent of a view on paper below which larger paper is better: of small parts, and of others
_LEAST_SMALL, _LEAST = 45.0, 120.0
# how many times smaller than at its least scale a part is drawn at most, where its sizes have no room
_SMALLER = 5.0
# how many times larger than the others a lettered view is drawn at most, where its own sizes have no room
_LARGER = 4.0
# model mm by which a number of a file may be off
_SAME = 1e-6
# a curve of a file is another's where their ends are farther apart, mm on paper
_NEAR = 0.01
_INDENT = 1.0
# half of what a bracket turns, rad
_BRACKET = 0.65
# places along each side of a sheet that are tried for views, and for a row of views with others apart from it
_TRIED, _TRIED_APART = 24, 8
# so many lettered views stand about the others
_FEW = 3


def _left(points: Complex) -> float:
    """How far to the left the nearer end of a run stands."""
    return float(points[[0, -1]].real.min())


class PartMeasures(Record):
    """Every dimension's number is read off the file; every exact curve is found there.

    ``outlines``: curves in model mm with the paper that they lie on and their layer.
    """

    canvas: Canvas
    outlines: tuple[tuple[Paper, str, Curve], ...]

    def check(self, sheet: ReadSheet, taken: Taken) -> None:
        """Hold the file against the model."""
        worst = 0.0
        layers = dict.fromkeys(name for name, _ in sheet.samples)
        drawn = {name: [points for layer, points in sheet.samples if layer == name] for name in layers}
        # those that begin farther left first: of many only few lie near
        for runs in drawn.values():
            runs.sort(key=_left)
        reaches = {name: np.array([points[[0, -1]] for points in runs]) for name, runs in drawn.items()}
        lefts = {name: ends.real.min(axis=1) for name, ends in reaches.items()}
        for paper, layer, curve in self.outlines:
            ends = curve.point(np.array(curve.domain)) * paper.scale + paper.origin
            off, left = math.inf, ends.real.min()
            first, last = np.searchsorted(lefts.get(layer, np.zeros(0)), (left - _NEAR, left + _NEAR))
            both = reaches[layer][first:last] if first < last else np.zeros((0, 2), dtype=complex)
            # a file may run along a curve either way
            near = np.minimum(np.abs(both - ends).max(axis=1), np.abs(both[:, ::-1] - ends).max(axis=1))
            for k in (first + np.flatnonzero(near < _NEAR)).tolist():
                model = (drawn[layer][k] - paper.origin) / paper.scale
                off = min(off, float(distance_to_curve(model, curve).max()) * paper.scale)
            worst = max(worst, off)
        taken.measured["max_deviation"] = worst
        taken.unless(worst <= taken.room, "outlines deviate by {worst:.3g} mm from the exact ones", worst=worst)
        if sheet.dimensions is None:
            return
        wanted = self.canvas.dimensions
        if len(sheet.dimensions) != len(wanted):
            taken.failures.append(
                fault("{count} dimensions instead of {wanted}", count=len(sheet.dimensions), wanted=len(wanted))
            )
            return
        off = max((abs(a.value - b.value) for a, b in zip(sheet.dimensions, wanted, strict=True)), default=0.0)
        taken.measured["dimensions"], taken.measured["dimension_deviation"] = float(len(wanted)), off
        taken.unless(off <= _SAME, "a dimension measures {off:.3g} beside the model", off=off)
        told = N_("a dimension says {text} instead of {other}")
        for read, one in zip(sheet.dimensions, wanted, strict=True):
            taken.unless(read.text == one.text, told, text=read.text, other=one.text)


class Block(Record):
    """What stands in the upper right corner: width and height, mm, and what draws it from that corner on."""

    size: tuple[float, float]
    draw: Callable[[Canvas, complex], object]


class _Corner(Record):
    """What stands in the corners of a sheet: lines of requirements, block of data, sign of roughness.

    ``has_signs``: some surfaces have signs of their own.
    """

    requirements: tuple[str, ...]
    data: Block | None
    roughness: str
    has_signs: bool

    @property
    def low(self) -> float:
        """Height of the title block and the requirements above it, mm."""
        lines = _LINE * len(self.requirements)
        return TITLE_BLOCK[1] + (lines + _MARGIN if lines else 0.0)

    @property
    def high(self) -> tuple[float, float]:
        """Width and height of what stands in the upper right corner, mm."""
        if self.data is None:
            return _SIGN
        return max(self.data.size[0], _SIGN[0]), _SIGN[1] + self.data.size[1]

    def taken(self, canvas: Canvas) -> tuple[Box, ...]:
        """Where no views may stand: at the data, the designation, the title block and the requirements above it."""
        frame, (wide, tall) = canvas.frame, self.high
        return (turned_box(canvas), Box(frame.right - wide, frame.high - tall, frame.right, frame.high),
                Box(frame.right - TITLE_BLOCK[0], frame.low, frame.right, frame.low + self.low))  # fmt: skip

    def draw(self, canvas: Canvas) -> None:
        """All of it."""
        frame = canvas.frame
        canvas.box("FRAME", frame)
        left = frame.right - TITLE_BLOCK[0]
        for k, line in enumerate(reversed(self.requirements)):
            y = frame.low + TITLE_BLOCK[1] + _MARGIN + _LINE * k
            canvas.write(line, complex(left + _INDENT, y), TEXT_HEIGHT, TITLE_BLOCK[0] - 2 * _INDENT)
        self._sign(canvas, complex(frame.right - _SIGN[0] + 6.0, frame.high - _SIGN[1] + 6.0))
        if self.data is not None:
            self.data.draw(canvas, complex(frame.right, frame.high - _SIGN[1]))

    def _sign(self, canvas: Canvas, foot: complex) -> None:
        """The roughness of all surfaces, or of all other ones: then in brackets the sign of the rest (GOST 2.309)."""
        lines, text = rough_sign(foot, self.roughness, TEXT_HEIGHT)
        canvas.texts.append(text)
        x = text.box.right + 2.5
        small = rough_sign(complex(x + 5.2, foot.imag), "")[0][:2] if self.has_signs else []
        for line in (*lines, *small):
            canvas.line("THIN", line.start, line.end)
        if not self.has_signs:
            return
        # brackets as arcs: programs fit letters to a length, and a bracket has hardly any
        middle = complex(x + 6.0, foot.imag + 4.0)
        for turn in (0.0, math.pi):
            canvas.add("THIN", Arc(middle, 6.0, turn - _BRACKET, 2 * _BRACKET))


def part_sheet(drawing: PartDrawing, data: Sequence[Block], roughness: float, asked: Asked) -> Expected:
    """The working drawing of a part on the smallest paper that shows it well, or as it is asked for.

    ``data``: the block of data in the forms that it may have, the best first; none: there is none.

    Raises
    ------
    ParameterError
        The paper is too small for the scale, or none is large enough.
    """
    language = asked.language
    if (rows := max(map(least_rows, drawing.views))) > ROWS:
        raise ParameterError("paper", asked.paper, "sizes_fit_no_paper", count=rows, most=ROWS)
    lines: list[str] = []
    for number, text in enumerate(drawing.requirements, 1):
        # one alone has no number (GOST 2.316)
        words = f"{number}. {text}" if len(drawing.requirements) > 1 else text
        lines += wrapped(words, TITLE_BLOCK[0] - 2 * _INDENT, TEXT_HEIGHT)
    has_signs = any(note.is_rough for view in drawing.views for note in view.notes)
    sign = f"Ra {number_text(roughness, language)}"
    forms: Sequence[Block | None] = data or [None]
    corners = [_Corner(tuple(lines), block, sign, has_signs) for block in forms]
    row = sorted(drawing.views, key=lambda view: not view.from_right)
    size = extent(drawing.views[0].strokes)
    needed = _LEAST_SMALL / max(size) if max(size) < _LEAST_SMALL else min(1.0, _LEAST / max(size))
    least = next((s for s in reversed(SCALES) if s >= needed), SCALES[0])

    @cache
    def views_at(scale: float) -> tuple[Laid, ...]:
        """The views at a scale; none where their words find no room."""
        found = [_laid(view, scale, asked) for view in row]
        return () if None in found else tuple(one for one in found if one is not None)

    def held(canvas: Canvas, scale: float, *, apart: bool) -> tuple[_Corner, list[complex]] | None:
        """The first form of what stands in the corners that leaves room for the views, and where those stand."""
        frame = canvas.frame
        for corner in corners:
            has_room = corner.low + corner.high[1] <= frame.tall and corner.high[0] <= frame.wide
            if has_room and (shifts := _places(views_at(scale), corner, canvas, apart=apart)) is not None:
                return corner, shifts
        return None

    def holds(canvas: Canvas, scale: float) -> bool:
        """Whether all views stand on a sheet."""
        return any(held(canvas, scale, apart=one) for one in (False, True))

    def greatest(canvas: Canvas) -> float:
        """The greatest scale at which they do."""
        most = min(canvas.frame.wide, canvas.frame.tall) / min(size)
        # unless a paper is asked for, what is large enough stays in its size
        most, low = (most, 0.0) if asked.paper else (min(most, max(least, 1.0)), least / _SMALLER)
        return next((s for s in SCALES if low <= s <= most and holds(canvas, s)), 0.0)

    canvas, scale = sheet_for(asked, greatest, least, holds)
    # the paper may lie the other way where all views then stand on one axis
    turned = blank(canvas.paper, upright=canvas.width > canvas.height, band=asked.band)
    ways = [(canvas, False), *([(turned, False)] if canvas.paper != "A4" else []), (canvas, True)]
    canvas, found = next((one, at) for one, apart in ways if (at := held(one, scale, apart=apart)) is not None)
    views = views_at(scale)
    corner, shifts = found
    corner.draw(canvas)
    outlines = [own for one, at in zip(views, shifts, strict=True) for own in moved(one, canvas, at, asked.tolerance)]
    return Expected(canvas, Paper(scale, shifts[0]), (), measures=PartMeasures(canvas, tuple(outlines)))


def points_of(strokes: Sequence[Stroke]) -> Complex:
    """Points all along the lines of a view."""
    return np.concatenate([c.point(np.linspace(*c.domain, 33)) for _, c in strokes])


def extent(strokes: Sequence[Stroke]) -> tuple[float, float]:
    """Width and height of what they show, model mm."""
    points = points_of(strokes)
    return float(np.ptp(points.real)) or 1.0, float(np.ptp(points.imag)) or 1.0


def _laid(view: View, scale: float, asked: Asked) -> Laid | None:
    """A view, of its own scale where it would be too small, or where its letters find room at a larger one only;
    its title tells that.
    """
    needed = max(scale, view.least / max(extent(view.strokes))) if view.least else scale
    own = next((s for s in reversed(SCALES) if s >= needed), SCALES[0])
    larger = [s for s in reversed(SCALES) if own < s <= _LARGER * own] if view.title and not view.in_row else []
    for one in (own, *larger):
        title = view.title if one == scale else f"{view.title} ({scale_text(one, asked.language)})"
        if (found := laid(replace(view, title=title), one, asked.language, own=one != scale)) is not None:
            return found
    return None


def _places(views: Sequence[Laid], corner: _Corner, canvas: Canvas, *, apart: bool) -> list[complex] | None:
    """Where the origins of views stand: in a row on one axis, or those with letters ``apart``; None: not at all.

    What has no letter stands beside what it is a view of.
    """
    if not views:
        return None
    boxes, frame = [view.box for view in views], canvas.frame.grown(-_MARGIN)
    taken = [box.grown(_MARGIN) for box in corner.taken(canvas)]
    loose = [k for k, view in enumerate(views) if apart and k and view.view.title and not view.view.in_row]
    row, x = dict[int, complex](), 0.0
    for k in range(len(views)):
        if k not in loose:
            row[k] = complex(x - boxes[k].left)
            x += boxes[k].wide + _BETWEEN
    stand = [boxes[k].moved(at) for k, at in row.items()]
    # of many rows with others about them not each is tried
    free = _free_places(stand, frame, taken, _TRIED_APART if loose else _TRIED)
    # few stand as near to the axis as there is room, many as a page is read
    many = len(loose) > _FEW
    for by in sorted(free, key=_reading) if many else free:
        found = {k: at + by for k, at in row.items()}
        for k in loose:
            others = [boxes[n].moved(at).grown(_BETWEEN) for n, at in found.items()]
            order = _reading if many else lambda at, by=by: (abs(at.imag - by.imag), abs(at.real - by.real))
            near = min(_free_places([boxes[k]], frame, [*taken, *others], _TRIED), key=order, default=None)
            if near is None:
                break
            found[k] = near
        else:
            return [found[k] for k in range(len(views))]
    return None


def _reading(at: complex) -> tuple[float, float]:
    """From the upper left corner on, line by line."""
    return -at.imag, at.real


def _free_places(boxes: Sequence[Box], frame: Box, taken: Sequence[Box], tried: int) -> list[complex]:
    """Shifts of rectangles, so many tried each way, that keep them in the frame and off others; the middle first."""
    whole = Box.about(boxes)
    right, high = frame.wide - whole.wide, frame.tall - whole.tall
    if min(right, high) < 0:
        return []
    share = np.linspace(0.0, 1.0, tried + 1)
    by = np.add.outer(frame.left - whole.left + right * share, 1j * (frame.low - whole.low + high * share)).ravel()
    kept = np.ones(len(by), dtype=bool)
    for one, other in product(boxes, taken):
        across = (by.real + one.left < other.right) & (by.real + one.right > other.left)
        kept &= ~(across & (by.imag + one.low < other.high) & (by.imag + one.high > other.low))
    away = np.add.outer(np.abs(share - 0.5) ** 2, np.abs(share - 0.5) ** 2).ravel()
    order = np.argsort(away, kind="stable")
    return by[order[kept[order]]].tolist()
