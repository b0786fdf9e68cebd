"""Views on paper with their dimensions: each word in a place that is free of lines and words; GOST 2.307, 2.309."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from heapq import merge
from itertools import accumulate, islice, pairwise, product
from operator import attrgetter

import numpy as np

from geometry.approximation.outline import CadCurve
from geometry.base.record import Record, replace
from geometry.curves.curve import Curve
from geometry.curves.line_arc import Arc, Line
from parts.base.texts import MINUS
from parts.drawing.canvas import (
    SMALL_TEXT,
    TEXT_HEIGHT,
    TITLE_TEXT,
    Box,
    Canvas,
    Dimension,
    Paper,
    Stroke,
    Text,
    decimal,
    draw,
    exact_each,
    fitted_each,
    rising_text,
    text_of,
    text_width,
)
from parts.drawing.hatching import hatching
from parts.drawing.ink import FREE, Ink, Role
from parts.drawing.working import AXIS, TURNED, VISIBLE, Angle, Cut, Note, Round, Side, Size, Slant, View, number_text

# mm on paper: from the view to the first dimension line, from line to line; arrow, half its width; how far extension
# lines reach beyond; from a line to its words; how far axes reach beyond their ends
_FIRST, _STEP, ARROW, _BARB, _BEYOND, _GAP, _AXIS = 10.0, 8.0, 3.0, 0.5, 1.5, 1.5, 4.0
# lines that fill an arrow
_FAN = 5
_HATCH = 2.5
# leaders: how far out, every how many degrees
_REACHES = (9.0, 13.0, 18.0, 24.0, 32.0, 42.0, 55.0, 70.0)
_TURNS = (0.0, 15.0, -15.0, 30.0, -30.0, 50.0, -50.0, 80.0, -80.0, 120.0, -120.0, 160.0)
# words beside a circle: how far out, where
_NEARBY, _AROUND = (1.0, 2.0, 3.0, 4.5), (45.0, -45.0, 135.0, -135.0, 0.0, 180.0, 90.0, -90.0)
# how far the letter of a view stands above its arrow
_ABOVE = 2.2
# from words of a title to the middle of the sign of a view that is turned
_SIGN = 5.0
# the frame of a tolerance and that of a datum (GOST 2.308): its height, from its lines to words; the triangle of a
# datum, from that to its frame; a leader's end beside a frame
_FRAME, _WITHIN, _TRIANGLE, _STUB, _SHELF = 7.0, 1.5, 3.5, 2.5, 3.0
# how much longer that end is where the frame then stands free of the part
_SHELVES = (_SHELF, 8.0, 14.0, 20.0)
# lines that fill that triangle
_FILL = 17
# the sign of roughness: heights of its legs; where its words begin
_SHORT, _LONG, _WORDS = 3.5, 8.0, 5.2
_SLOPE = math.tan(math.radians(30))
# places whose costs are told at once
_AT_ONCE = 16
# rows of a side, and layouts of a view, that are tried
ROWS, _TRIES = 20, 12
# sizes that share less than this along a side may stand in one row, model mm
_SHARED = 1e-3
# marks of a section: from the view to the stroke, its length, its arrow (a view has it too); steps out
_MARK, _STROKE, _LOOK, _OUT = 2.0, 7.0, 6.0, 30
# how much farther beyond the end of a dimension line its words may stand
_FARTHER = (0.0, 4.0, 8.0, 13.0, 20.0, 30.0)
# how much wider words are in LibreCAD, and how far from the dimension it puts them, mm
_WIDER, _LIBRE_GAP = 1.03, 0.9
# how many rows nearer a sign seems on the extension of its line, a leader on the side of its arc where it should stand
_PREFERRED = 3.0
# cosine of the angle to the way out of the material within which leaders come to a surface
_GRAZING = 0.2
# how many rows farther away another point of the same surface seems
_OTHER = 1.0
_DIMENSION = "DIMENSION"
# the ways out of a view to the dimension lines on its sides
_OUTWARD: dict[Side, complex] = {"left": -1.0, "right": 1.0, "above": 1j, "below": -1j}
# for which the arc of an angle stands where it is asked for room
_CHORDS = 8
# mm on paper within which two arcs about one place seem one
_BESIDE = 2.0


class Laid(Record):
    """What is added to a view on a canvas of its own, its origin at 0, and the room that all takes, mm on paper.

    The view's own curves are not on the canvas: they are fitted once it is known at which scale it is drawn.
    """

    view: View
    canvas: Canvas
    scale: float
    box: Box

    def ink(self) -> Ink:
        """All that is on paper."""
        ink = Ink([self.scale * piece for piece in self.view.chords], [text.box for text in self.canvas.texts])
        for stroke in self.canvas.strokes:
            ink.add(stroke.curve)
        return ink


# what stands on a leader or a shelf
_Led = Round | Slant | Angle | Note
_Span = tuple[float, float]
# between which points a dimension is, through where its line goes, its angle
_Told = tuple[tuple[complex, complex], complex, float]


class _NoRoomError(Exception):
    """A size, leader or note found no place that is free."""

    def __init__(self, owner: Size | _Led) -> None:
        super().__init__()
        self.owner = owner


def laid(
    view: View, scale: float, language: str, *, own: bool = False, free: Mapping[Side, float] | None = None
) -> Laid | None:
    """A view with all of its dimensions, at a scale; None where they find no room.

    ``own``: its scale is not the sheet's, which is all that some programs know, so its numbers stand as words;
    ``free``: how much dimension lines leave free on a side of the view for what will stand there, mm on paper.
    """
    free = {**_framed_sides(view), **(free or {})}
    if (usual := _filled(view, scale, language, free, own=own)) is None:
        return None
    # where leaders run over dimension lines, notes choose before sizes; where over each other, the last one first too
    for first in (view.notes, view.notes[::-1]):
        over = usual.ink.run_over()
        if over[0] or (over[1] and first == view.notes):
            other = _filled(view, scale, language, free, own=own, first=first)
            if other is not None and other.ink.run_over() < over:
                usual = other
    return Laid(view, usual.canvas, scale, usual.extent())


def _framed_sides(view: View) -> dict[Side, float]:
    """What dimension lines leave free for frames of runouts that would stand across them: of what is round inside, of a
    face beside sizes that span it.
    """
    found: dict[Side, float] = {}
    for note in view.notes:
        inner = note.at.imag * note.free.imag < 0
        side: Side = "right" if inner or note.free.real > 0 else "left"
        spans = [(one.start.imag, one.end.imag) for one in view.sizes if one.side == side]
        heights = [at.imag for at, _ in ((note.at, note.free), *note.also)]
        if note.datum and (inner or (note.free.real and all(any(a < y < b for a, b in spans) for y in heights))):
            found[side] = sum(_cells(note.text)) + 2 * _SHELF
    return found


def _filled(
    view: View, scale: float, language: str, free: Mapping[Side, float], *, own: bool, first: Sequence[Note] = ()
) -> _Layout | None:
    """A view with all of its dimensions, ``first`` those notes; None where they find no room."""
    leaders: list[_Led] = [*view.slants, *view.angles, *view.rounds, *(() if first else view.notes)]
    order: list[Size | _Led] = [*sorted(view.sizes, key=lambda one: one.value), *leaders]
    tried: list[list[Size | _Led]] = []
    while order not in tried and len(tried) < _TRIES:
        tried.append(order)
        made = _Layout(view, scale, language, free, own=own)
        try:
            made.fill([*first, *order], view.title)
            return made
        except _NoRoomError as refusal:
            owner = refusal.owner
            rest = [one for one in order if one is not owner]
            # what had no room is the first to choose among sizes or leaders, then before all
            like = [k for k, one in enumerate(rest) if isinstance(one, Size) == isinstance(owner, Size)]
            at = min(like, default=len(rest))
            order = [*rest[:at], owner, *rest[at:]]
            if order in tried:
                order = [owner, *rest]
    return None


def least_rows(view: View) -> int:
    """The rows that the sizes on a side of a view take at least, at any scale: no two over one place share a row."""
    found = 0
    for side, out in _OUTWARD.items():
        spans = [sorted(_along(p, out) for p in (one.start, one.end)) for one in view.sizes if one.side == side]
        ends = sorted(end for low, high in spans for end in ((low + _SHARED, 1), (high - _SHARED, -1)))
        found = max(found, *accumulate((step for _, step in ends), initial=0))
    return found


class _Layout:
    """Fills the canvas of one view; rows of dimension lines by their side."""

    def __init__(self, view: View, scale: float, language: str, free: Mapping[Side, float], *, own: bool) -> None:
        self.canvas, self.ink, self.language, self.own, self.free = Canvas(0.0, 0.0, ""), Ink(), language, own, free
        self.paper = Paper(scale, 0j)
        self.ink.pieces += [scale * piece for piece in view.chords]
        straight = (
            scale * piece for (_, c), piece in zip(view.strokes, view.chords, strict=True) if isinstance(c, Line)
        )
        self.ink.note({"edge": [Line(complex(piece[0, 0]), complex(piece[1, 0])) for piece in straight]})
        self.circles = [
            Arc(scale * c.centre, scale * c.radius, c.start_angle, c.sweep)
            for _, c in view.strokes if isinstance(c, Arc)
        ]  # fmt: skip
        self.body = self.extent()
        for loop in hatching([[self.paper.scaled(c) for c in loop] for loop in view.hatched], _HATCH):
            self._stroke("HATCH", loop)
        for axis in view.axes:
            start, end = self.paper.point(axis.start), self.paper.point(axis.end)
            beyond = _AXIS * (end - start) / abs(end - start)
            self._stroke(AXIS, Line(start - beyond, end + beyond), "edge")
        self.rows: dict[str, list[list[_Span]]] = {}
        for cut in view.cuts:
            self._cut(cut, view.sizes)

    def fill(self, order: Sequence[Size | _Led], title: str) -> None:
        """Add all words with their lines, in this order."""
        for k, one in enumerate(order):
            match one:
                case Size():
                    # where extension lines will run past its words
                    later = [other for other in order[k + 1 :] if isinstance(other, Size) and other.side == one.side]
                    coming = [self.paper.point(p) for other in later for p in (other.start, other.end)]
                    # one that is placed before those that will stand within it leaves them their rows
                    within = sum(_is_within(other, one) for other in later)
                    self._put(one, self._sizes(one, coming, within), self._sizes(one, (), within))
                case Slant():
                    self._put(one, self._slants(one))
                case Angle():
                    # a contour is no dimension line (GOST 2.307)
                    free = (place for place in self._angles(one) if not self._lies_on_circle(place))
                    self._put(one, free, self._angles(one))
                case Round():
                    self._put(one, self._radii(one) if one.is_radius else self._diameters(one))
                case Note():
                    self._put(one, merge(self._on_axis(one), self._notes(one), key=attrgetter("cost")))
        if title:
            box = self.extent()
            words, sign, more = (part.strip() for part in title.partition(TURNED))
            long = text_width(words, TITLE_TEXT) + (2 * _SIGN + text_width(more, TITLE_TEXT) if sign else 0.0)
            at = complex(box.middle.real - long / 2, box.high + 3.0)
            self._write(text_of(words, at, TITLE_TEXT))
            if sign:
                self._turned(at + complex(text_width(words, TITLE_TEXT) + _SIGN, TITLE_TEXT / 2))
                self._write(text_of(more, at + long - text_width(more, TITLE_TEXT), TITLE_TEXT))

    def _turned(self, middle: complex) -> None:
        """The sign of a view that is turned: most of a circle with an arrow at its end; GOST 2.305."""
        arc = Arc(middle, TITLE_TEXT / 2, math.radians(20.0), -math.radians(300.0))
        tip = middle + cmath.rect(TITLE_TEXT / 2, arc.start_angle + arc.sweep)
        self._stroke(_DIMENSION, arc)
        for line in _arrow(tip, cmath.rect(1.0, arc.start_angle + arc.sweep + math.radians(127.0))):
            self._stroke(_DIMENSION, line)

    def extent(self) -> Box:
        """All that is drawn and written."""
        if not (lines := self.ink.lines).size:
            return Box(0.0, 0.0, 0.0, 0.0)
        ends = (float(end) for end in (lines.real.min(), lines.imag.min(), lines.real.max(), lines.imag.max()))
        return Box.about([Box(*ends), *self.ink.boxes])

    def _stroke(self, layer: str, curve: CadCurve, role: Role | None = None) -> None:
        self.canvas.strokes.append(Stroke(layer, curve))
        self.ink.add(curve, role)

    def _write(self, text: Text) -> None:
        self.canvas.texts.append(text)
        self.ink.boxes.append(text.box)

    def _cut(self, cut: Cut, sizes: Sequence[Size]) -> None:
        """Both marks of a section, each in the nearest place where its letter is clear, of extension lines too."""
        x, wide = self.paper.point(complex(cut.at)).real, text_width(cut.letter, TITLE_TEXT)
        for way, edge, side in ((1, self.body.high, "above"), (-1, self.body.low, "below")):
            near = [one for one in sizes if one.side == side]
            coming = [self.paper.point(p).real for one in near for p in (one.start, one.end)]
            # where their extension lines end at the latest
            last = way * edge + _FIRST + _STEP * len(near)
            places: list[tuple[Line, list[Line], Text]] = []
            for low in (edge + way * (_MARK + _STROKE * k) for k in range(_OUT)):
                tip = complex(x, low + way * (_STROKE - 2.0))
                foot = 1.0 if cut.from_right else -1.0
                mark, lines = Line(complex(x, low), complex(x, low + way * _STROKE)), [*_arrow(tip, foot)]
                # beside the foot of the arrow, on its shaft, beyond its tip, beyond the end of the stroke
                lefts = (-_LOOK - wide - 1.0, -_LOOK + 0.5, 1.5, -wide / 2)
                if cut.from_right:
                    lefts = (_LOOK + 1.0, _LOOK - wide - 0.5, -wide - 1.5, -wide / 2)
                end = 4.2 if way > 0 else -3.0 - TITLE_TEXT
                for left, lift in zip(lefts, (-TITLE_TEXT / 2, 1.0, -TITLE_TEXT / 2, end), strict=True):
                    text = text_of(cut.letter, tip + complex(left, lift), TITLE_TEXT)
                    places.append((mark, [Line(tip + foot * _LOOK, tip), *lines], text))
            free = (
                place for place in places
                if self.ink.holds([place[0], *place[1]], place[2].box)
                and (
                    min(way * place[2].box.low, way * place[2].box.high) > last
                    or not any(place[2].box.left - 2 * FREE < at < place[2].box.right + 2 * FREE for at in coming)
                )
            )  # fmt: skip
            mark, lines, text = next(free, places[-4])
            self._stroke(VISIBLE, mark, "edge")
            self._drawn(lines, text)

    def _put(self, one: Size | _Led, *ways: Iterator[_Place]) -> None:
        """Draw it in the best place of the first of some ways that has one which is free."""
        best = next(filter(None, map(self._best, ways)), None)
        if best is None:
            raise _NoRoomError(one)
        drawn = self._drawn(best.drawn, best.text)
        if (framed := best.framed) is not None:
            for line in (*framed.stub, *framed.lines):
                self._stroke(_DIMENSION, line)
            self.canvas.texts += framed.texts
            self.ink.boxes.append(framed.room)
            self.ink.note({"leader": framed.stub})
        if best.told and not isinstance(one, Note):
            self._dimension(one, best.told, best.text, *drawn)
        if best.row is not None:
            best.row.append(best.reach)
        self.ink.note(best.lines)

    def _best(self, places: Iterator[_Place]) -> _Place | None:
        """The best of places that are free; they rise in their least cost."""
        best, least = None, (math.inf, math.inf)
        while some := [*islice(places, _AT_ONCE)]:
            for place, more in zip(some, self.ink.costs([place.lines for place in some]), strict=True):
                # of two that cost as much the nearer one
                total = place.cost + more, place.cost
                if total < least and self._has_room(place):
                    best, least = place, total
            if some[-1].least > least[0]:
                break
        return best

    def _has_room(self, place: _Place) -> bool:
        """Whether all words and lines of a place are free of others."""
        framed = place.framed
        if framed is None:
            return self.ink.holds(place.all_lines, place.text.box)
        return self.ink.holds([*place.all_lines, *framed.stub], place.text.box) and self.ink.holds([], framed.room)

    def _sizes(self, size: Size, coming: Sequence[complex], within: int) -> Iterator[_Place]:
        """Where a linear dimension may stand, in the rows of its side.

        ``coming``: places from which extension lines will run to the same side; ``within``: how many rows are left to
        what will stand nearer.
        """
        edge = {
            "left": self.body.left, "right": self.body.right, "above": self.body.high, "below": self.body.low
        }[size.side]  # fmt: skip
        out, ends = _OUTWARD[size.side], (self.paper.point(size.start), self.paper.point(size.end))
        first = _FIRST + self.free.get(size.side, 0.0)
        levels = [
            _Level(out, ends, edge + (out.real + out.imag) * (first + _STEP * index), float(abs(index - within)), row)
            for index, row in enumerate(self.rows.setdefault(size.side, [[] for _ in range(ROWS)]))
        ]
        return self._linears(size, levels, coming)

    def _diameters(self, one: Round) -> Iterator[_Place]:
        """Where a diameter may stand, between lines beside its circle.

        It is linear to programs, as a radius is: some turn what stands on a leader, and others read it as 0.
        """
        centre, radius = self.paper.point(one.centre), self.paper.scale * one.radius
        levels = []
        for reach, out in product(_REACHES, (1j, 1.0, -1j, -1.0)):
            half = radius * (1j if out.real else 1.0)
            top = centre + (radius + reach) * out
            at = top.real if out.real else top.imag
            levels.append(_Level(out, (centre - half, centre + half), at, reach / _STEP, []))
        return self._linears(one, levels, ())

    def _linears(self, one: Size | Round, levels: Sequence[_Level], coming: Sequence[complex]) -> Iterator[_Place]:
        """Where a dimension may stand at these levels, its words along its line."""
        known, words = self.ink.costs([level.lines(level.span) for level in levels]), self._words(one)
        wide = text_width(words)
        for k in sorted(range(len(levels)), key=lambda k: levels[k].cost + known[k]):
            level, (low, high) = levels[k], levels[k].span
            past = [_along(p, level.out) for p in coming]
            for begin in _begins(low, high, wide, _along(self.body.middle, level.out)):
                # words stand above their line, those of an upright one on its left
                if level.is_upright:
                    text = rising_text(words, complex(level.at - _GAP, begin))
                else:
                    text = text_of(words, complex(begin, level.at + _GAP))
                lines = level.lines((begin, begin + wide))
                place = _Place(lines, level.arrows, text, level.cost, level.told, known[k], level.row)
                for one_way, taken in level.flagged(place, one.datum) if one.datum else ((place, ()),):
                    spans = (begin, begin + wide), *taken
                    reach = min(low, *(a for a, _ in spans)), max(high, *(b for _, b in spans))
                    # chains share their ends
                    if any(_meet(reach, other) for other in level.row) or (taken and _meet(*spans)):
                        continue
                    if not any(a - 2 * FREE < at < b + 2 * FREE for at in past for a, b in spans):
                        yield replace(one_way, reach=reach)

    def _words(self, one: Size | Slant | Round) -> str:
        """All that is written of a dimension."""
        return one.before + number_text(one.value, self.language) + one.after + one.places

    def _template(self, one: Size | Slant | Round) -> str:
        """The words of a dimension as programs keep them; the font that they draw it in has no minus."""
        is_broken = isinstance(one, Size) and one.whole is not None
        number = number_text(one.value, self.language) if self.own or is_broken else "<>"
        return one.before.replace("Ø", "%%c") + number + one.after.replace(MINUS, "-") + one.places

    def _dimension(
        self, one: Size | Slant | Round | Angle, told: _Told, text: Text, strokes: range, texts: range
    ) -> None:
        """Note what programs need to know of a dimension."""
        (points, line, angle), scale = told, self.paper.scale
        if isinstance(one, Size) and one.whole is not None:
            scale *= one.drawn / one.whole
        middle, is_beside, vertex = text.box.middle, False, None
        if isinstance(one, Angle):
            name, template, vertex = "angle", one.words.replace("°", "%%d"), self.paper.point(one.at)
        else:
            name, template = one.name, self._template(one)
            # LibreCAD moves words that are longer than their dimension along it, by half of both: they begin so much
            # before
            apart, length = one.value * scale, sum(run.width for run in text.runs) * _WIDER
            if is_beside := length > apart:
                middle -= ((length + apart) / 2 + _LIBRE_GAP) * cmath.rect(1.0, math.radians(angle))
        mark = decimal("0.0", self.language)[1]
        self.canvas.dimensions.append(Dimension(
            name, one.value, scale, points, line, angle, template, mark, middle, is_beside, strokes, texts, vertex
        ))  # fmt: skip

    def _drawn(self, lines: Iterable[CadCurve], text: Text) -> tuple[range, range]:
        """Draw lines and words of one size or note; which strokes and texts of the canvas they are."""
        first, count = len(self.canvas.strokes), len(self.canvas.texts)
        for line in lines:
            self._stroke(_DIMENSION, line)
        self._write(text)
        return range(first, len(self.canvas.strokes)), range(count, count + 1)

    def _slants(self, one: Slant) -> Iterator[_Place]:
        """Where a size along a slope may stand: its words on a shelf beyond either end of its line."""
        start, end = self.paper.point(one.start), self.paper.point(one.end)
        way = one.way if ((end - start) * one.way.conjugate()).real > 0 else -one.way
        long = ((end - start) * way.conjugate()).real
        levels = [((p - start) * one.out.conjugate()).real for p in (start, end)]
        # programs that take every size as aligned read the same number of points beside each other
        ends = start + max(levels) * one.out, start + max(levels) * one.out + long * way
        turn = math.degrees(cmath.phase(way if way.real > 0 else -way))
        for index, more in product(range(ROWS), _FARTHER):
            level = max(levels) + _FIRST + _STEP / 2 * index
            feet = [start + level * one.out, start + level * one.out + long * way]
            edges = [Line(p, foot + _BEYOND * one.out) for p, foot in zip((start, end), feet, strict=True)]
            inner = way if _is_inside(0.0, long) else -way
            arrows = [*_arrow(feet[0], inner), *_arrow(feet[1], -inner)]
            out = 0.0 if inner == way else ARROW + 2.0
            for sense, foot, other in ((1.0, feet[1], feet[0]), (-1.0, feet[0], feet[1])):
                elbow = foot + sense * (ARROW + 2.0 + more) * way
                shelf, text = _shelved(elbow, self._words(one), sense * way)
                cost = index / 2 + more / _STEP + _OTHER * sum(map(self.ink.beside, (elbow, *feet)))
                lines: dict[Role, Sequence[Line]] = {
                    "extension": edges, "dimension": [Line(other - sense * out * way, elbow)], "leader": shelf
                }  # fmt: skip
                yield _Place(lines, arrows, text, cost, (ends, feet[0], turn))

    def _angles(self, one: Angle) -> Iterator[_Place]:
        """Where an angle may stand: its arc nearer or farther, its words on a shelf from its middle or its end."""
        at, start = self.paper.point(one.at), cmath.phase(one.first)
        sweep = cmath.phase(one.second / one.first)
        sense, middle = math.copysign(1.0, sweep), cmath.rect(1.0, start + sweep / 2)
        reaches = [self.paper.scale * reach for reach in one.reaches]
        for radius, far, within in product(_REACHES, (_BEYOND, *_REACHES), (True, False)):
            if within and radius * abs(sweep) < 2 * ARROW + 1.0:
                continue
            ends = [at + radius * one.first, at + radius * one.second]
            edges = [
                Line(at + reach * way, at + (radius + _BEYOND) * way)
                for way, reach in zip((one.first, one.second), reaches, strict=True) if radius + _BEYOND > reach
            ]  # fmt: skip
            # from the tips of the arrows along the arc, within the angle or without
            along = (1.0 if within else -1.0) * sense * 1j
            arrows = [*_arrow(ends[0], along * one.first), *_arrow(ends[1], -along * one.second)]
            more = 0.0 if within else (ARROW + 2.0) / radius
            arc = Arc(at, radius, start - sense * more, sweep + 2 * sense * more)
            turns = arc.start_angle + arc.sweep * np.linspace(0.0, 1.0, _CHORDS + 1)
            places = [at + cmath.rect(radius, float(turn)) for turn in turns]
            way = middle if within else -sense * 1j * cmath.rect(1.0, arc.start_angle)
            foot = at + radius * middle if within else places[0]
            shelf, text = _shelved(foot + far * way, one.words, middle if within else one.first)

            points = (ends[0], ends[1]) if sweep > 0 else (ends[1], ends[0])
            lines: dict[Role, Sequence[Line]] = {
                "extension": edges, "dimension": [Line(a, b) for a, b in pairwise(places)],
                "leader": [Line(foot, foot + far * way), *shelf],
            }  # fmt: skip
            cost, told = (radius + far) / _STEP + _OTHER * (not within), (points, at + arc.radius * middle, 0.0)
            yield _Place(lines, arrows, text, cost, told, arc=arc)

    def _lies_on_circle(self, place: _Place) -> bool:
        """Whether the arc of an angle lies on one of the view, or so near it that both seem one."""
        arc = place.arc
        assert arc is not None
        return any(abs(one.centre - arc.centre) + abs(one.radius - arc.radius) < _BESIDE for one in self.circles)

    def _radii(self, one: Round) -> Iterator[_Place]:
        """Where a radius may stand, on a leader whose shelf carries the words: to each arc, from both of its sides."""
        arcs = ((one.centre, one.angles, 0.0), *((*arc, _OTHER) for arc in one.also))
        ways = (
            self._leaders(one, self.paper.point(at), angles, more, inward=inward)
            for inward in (False, True)
            for at, angles, more in arcs
        )
        return merge(*ways, key=attrgetter("cost"))

    def _leaders(
        self, one: Round, centre: complex, angles: Sequence[float], more: float, *, inward: bool
    ) -> Iterator[_Place]:
        """Of a radius to an arc, to its centre or away from it; ``more``: its own cost."""
        for reach, angle in product(_REACHES, angles):
            way = cmath.rect(1.0, math.radians(angle))
            out = -way if inward else way
            tip = centre + self.paper.scale * one.radius * way
            elbow = tip + reach * out
            shelf, text = _shelved(elbow, self._words(one), out)
            turn = math.degrees(cmath.phase(way if way.real > 0 else -way))
            cost = reach / _STEP + _PREFERRED * (inward != one.inward) + more
            lines: dict[Role, Sequence[Line]] = {"leader": [Line(tip, elbow), *shelf]}
            yield _Place(lines, _arrow(tip, out), text, cost, ((centre, tip), tip, turn))

    def _on_axis(self, note: Note) -> Iterator[_Place]:
        """Where an arrow that looks along an axis, or a sign on the extension of a pitch line, may stand."""
        tip = self.paper.point(note.at)
        back = -note.looks
        for k in range(2 * ROWS) if back else ():
            foot = tip + (_FIRST + _STEP / 2 * k) * back
            # the letter stands above an arrow that is level, on the right of one that is upright
            beside = complex(2 * ARROW, _ABOVE) if back == 1 else complex(_ABOVE, ARROW)
            text = text_of(note.text, foot + beside, TITLE_TEXT)
            yield _Place({"leader": [Line(foot, foot + _LOOK * back)]}, _arrow(foot, back), text, k / 2)
        for reach in _REACHES if note.goes_on else ():
            lines, text = rough_sign(tip + reach, note.text)
            along = Line(tip + _AXIS, tip + reach + _SHORT * _SLOPE)
            yield _Place({"leader": [along, *lines]}, [], text, reach / _STEP - _PREFERRED)

    def _notes(self, note: Note) -> Iterator[_Place]:
        """Where it may stand, on a leader or beside its circle."""
        if note.looks:
            return
        if note.about is not None:
            yield from self._beside(note, self.paper.scale * note.about)
            return
        middle = self.body.middle
        spots = [(note.at, note.free, 0.0), *((at, free, _OTHER) for at, free in note.also)]
        ways = sorted(product(_REACHES, spots), key=lambda way: way[0] / _STEP + way[1][2])
        for reach, (at, free, more) in ways:
            tip, cost = self.paper.point(at), reach / _STEP + more
            best = math.degrees(cmath.phase(free or tip - middle)) if free or tip != middle else 45.0
            for turn in _TURNS:
                way = cmath.rect(1.0, math.radians(best + turn))
                if free and (way * free.conjugate()).real < _GRAZING * abs(free):
                    continue
                elbow = tip + reach * way
                if note.is_rough:
                    # the sign stands clear of its leader, whichever way that comes
                    side = 1.0 if way.real >= 0 else -1.0
                    off = _SHORT * _SLOPE + 1.0 if side > 0 else _WORDS + text_width(note.text, SMALL_TEXT) + 2.0
                    lines, text = rough_sign(elbow + side * off, note.text)
                    lines.append(Line(elbow, elbow + side * (off + 1.0)))
                elif note.datum:
                    # a runout is measured straight out of the surface
                    for side, long in product((1.0, -1.0), _SHELVES) if turn == 0.0 else ():
                        foot = elbow + side * long
                        text, framed = _runout(foot, side, note.text, note.datum)
                        led: dict[Role, Sequence[Line]] = {"leader": [Line(tip, elbow), Line(elbow, foot)]}
                        more = cost + (long - _SHELF) / _STEP
                        yield _Place(led, _arrow(tip, way), text, more, framed=framed)
                    continue
                else:
                    lines, text = _shelved(elbow, note.text, way, TITLE_TEXT if note.is_letter else TEXT_HEIGHT)
                yield _Place({"leader": [Line(tip, elbow), *lines]}, _arrow(tip, way), text, cost)

    def _beside(self, note: Note, radius: float) -> Iterator[_Place]:
        """Where a word may stand beside a circle."""
        middle, wide = self.paper.point(note.at), text_width(note.text)
        for far, turn in product(_NEARBY, _AROUND):
            way = cmath.rect(1.0, math.radians(turn))
            near = middle + (radius + far) * way
            corner = near - complex(wide * (1 - way.real) / 2, TEXT_HEIGHT * (1 - way.imag) / 2)
            yield _Place({}, [], text_of(note.text, corner), far / _STEP)


class _Level(Record, dict=True):
    """Where a dimension line may stand: ``out`` from its two ends, at a place across it; its cost in rows.

    ``row``: what is taken along it, where others stand at the same level.
    """

    out: complex
    ends: tuple[complex, complex]
    at: float
    cost: float
    row: list[_Span]

    @property
    def is_upright(self) -> bool:
        """Whether the line is."""
        return self.out.real != 0

    @cached_property
    def points(self) -> list[complex]:
        """Its ends, the lower or left one first."""
        return sorted(self.ends, key=lambda p: _along(p, self.out))

    @cached_property
    def span(self) -> _Span:
        """Where both are along the line."""
        low, high = (_along(p, self.out) for p in self.points)
        return low, high

    def on(self, place: float, at: float) -> complex:
        """A place along the line at a level."""
        return complex(at, place) if self.is_upright else complex(place, at)

    def lines(self, words: _Span) -> dict[Role, list[Line]]:
        """Extension lines, and the dimension line as far as words reach."""
        low, high = self.span
        feet = zip(self.points, (self.on(place, self.at) for place in self.span), strict=True)
        lines = [Line(point, foot + _BEYOND * self.out) for point, foot in feet if abs(point - foot) > 1e-9]
        start, end = self.span if _is_inside(low, high) else (low - ARROW - 2.0, high + ARROW + 2.0)
        line = Line(self.on(min(start, words[0]), self.at), self.on(max(end, words[1]), self.at))
        return {"extension": lines, "dimension": [line]}

    @property
    def arrows(self) -> list[Line]:
        """Both, within where there is room."""
        way = (1.0 if _is_inside(*self.span) else -1.0) * (1j if self.is_upright else 1.0)
        first, second = (self.on(place, self.at) for place in self.span)
        return [*_arrow(first, way), *_arrow(second, -way)]

    def flagged(self, place: _Place, datum: str) -> Iterator[tuple[_Place, tuple[_Span]]]:
        """Its place with the mark of a datum at either end, and what that takes along the line; GOST 2.308."""
        for index, (end, way) in enumerate(zip(self.span, (-1.0, 1.0), strict=True)):
            # the triangle stands in place of an arrow that is outside
            within = _is_inside(*self.span)
            arrows = place.arrows if within else place.arrows[_FAN * (1 - index) :][:_FAN]
            far = _TRIANGLE + _STUB, _TRIANGLE + _STUB + _FRAME
            tip, foot, last = (self.on(end + way * at, self.at) for at in (_TRIANGLE, *far))
            base = [self.at + _TRIANGLE / math.sqrt(3.0) * (2 * k / (_FILL - 1) - 1) for k in range(_FILL)]
            half, middle = complex(_FRAME, _FRAME) / 2, (foot + last) / 2
            box, taken = Box.of([middle - half, middle + half]), sorted([end, end + way * far[1]])
            stub = [*(Line(tip, self.on(end, at)) for at in base), Line(tip, foot)]
            framed = _Framed(box, _sides(box), (_within(datum, box),), stub)
            yield replace(place, arrows=arrows, framed=framed), ((taken[0], taken[1]),)

    @property
    def told(self) -> _Told:
        """What programs know of it: those that take every size as aligned read the same with points at one level."""
        beside = max(self.points, key=lambda p: (p * self.out.conjugate()).real)
        first, second = (self.on(place, beside.real if self.is_upright else beside.imag) for place in self.span)
        return (first, second), self.on(self.span[1], self.at), 90.0 if self.is_upright else 0.0


class _Framed(Record):
    """A frame with its lines, and words beside those of its place; ``stub``: what leads to it."""

    frame: Box
    lines: Sequence[Line]
    texts: Sequence[Text]
    stub: Sequence[Line] = ()

    @property
    def room(self) -> Box:
        """What other lines and words keep off."""
        return self.frame.grown(_GAP - FREE)


class _Place(Record):
    """A place for words: lines by what they are, arrows, words, what it costs in rows.

    ``told``: what programs know of a dimension. ``known``: what its lines cost at least, in rows. ``row``: where it
    will take ``reach`` along its line. ``arc``: its line as it is drawn. ``framed``: a frame beside it.
    """

    lines: Mapping[Role, Sequence[Line]]
    arrows: Sequence[Line]
    text: Text
    cost: float
    told: _Told | None = None
    known: float = 0.0
    row: list[_Span] | None = None
    reach: _Span = (0.0, 0.0)
    arc: Arc | None = None
    framed: _Framed | None = None

    @property
    def least(self) -> float:
        """What it costs at least."""
        return self.cost + self.known

    @property
    def all_lines(self) -> list[Line]:
        """Straight ones, in the order in which they are drawn."""
        return [*(line for lines in self.lines.values() for line in lines), *self.arrows]

    @property
    def drawn(self) -> Sequence[CadCurve]:
        """All that is drawn."""
        if self.arc is None:
            return self.all_lines
        return [*self.lines["extension"], *self.lines["leader"], self.arc, *self.arrows]


def _meet(one: _Span, two: _Span) -> bool:
    """Whether dimension lines of one row overlap or are too near, but for those that end in one place."""
    if min(abs(one[0] - two[1]), abs(two[0] - one[1])) < 1e-6:
        return False
    return one[0] - 1 < two[1] and two[0] < one[1] + 1


def _is_within(one: Size, other: Size) -> bool:
    """Whether a size stands nearer to the view than another one over it."""
    out = _OUTWARD[other.side]
    (low, high), (left, right) = (sorted(_along(p, out) for p in (size.start, size.end)) for size in (one, other))
    return one.value < other.value and low < right and left < high


def _along(point: complex, out: complex) -> float:
    """Where it is along a dimension line that stands that way out."""
    return point.imag if out.real else point.real


def _begins(low: float, high: float, wide: float, middle: float) -> Iterator[float]:
    """Where words may begin along a dimension line: in its middle, to a side of it, beyond its ends."""
    room = high - low - wide - 2 * (ARROW + 2 * FREE)
    if room >= 0:
        yield from ((low + high - wide) / 2 + share * room / 2 for share in (0.0, 0.5, -0.5, 1.0, -1.0))
    for more in _FARTHER:
        beyond = high + ARROW + 2.0 + more, low - ARROW - 2.0 - wide - more
        yield from beyond if low + high >= 2 * middle - 1e-9 else beyond[::-1]


def _is_inside(low: float, high: float) -> bool:
    """Whether arrows have room within a dimension line."""
    return high - low >= 2 * ARROW + 1.0


def _arrow(tip: complex, way: complex) -> list[Line]:
    """An arrow's lines from its tip; ``way``: from the tip to its foot."""
    return [Line(tip, tip + way * complex(ARROW, _BARB * (2 * k / (_FAN - 1) - 1))) for k in range(_FAN)]


def _shelved(elbow: complex, words: str, way: complex, height: float = TEXT_HEIGHT) -> tuple[list[Line], Text]:
    """A shelf at the end of a leader, with the words above it."""
    wide = text_width(words, height) + 1.0
    left = elbow if way.real >= -1e-9 else elbow - wide
    # what letters reach below their line grows with them
    return [Line(left, left + wide)], text_of(words, left + complex(0.5, _GAP * height / TEXT_HEIGHT), height)


def _sides(box: Box) -> list[Line]:
    """The four lines of a frame."""
    return [Line(a, b) for a, b in pairwise([*box.corners, box.corners[0]])]


def _within(words: str, frame: Box) -> Text:
    """Words in the middle of a frame."""
    return text_of(words, frame.middle - complex(text_width(words), TEXT_HEIGHT) / 2)


def _cells(size: str) -> tuple[float, float, float]:
    """The widths of the cells of a runout's frame: of its sign, its size, its datum."""
    return _FRAME, text_width(size) + 2 * _WITHIN, _FRAME


def _runout(foot: complex, side: float, size: str, datum: str) -> tuple[Text, _Framed]:
    """The size of a runout and the frame about it, with its sign and datum, on a side of a place; GOST 2.308."""
    widths = _cells(size)
    left, low = foot.real if side > 0 else foot.real - sum(widths), foot.imag - _FRAME / 2
    sign, number, letter = (Box(a, low, b, low + _FRAME) for a, b in pairwise(accumulate(widths, initial=left)))
    frame, way = Box.about([sign, letter]), cmath.rect(1.0, math.radians(45.0))
    start, tip = (sign.middle + part * _FRAME * way for part in (-0.35, 0.35))
    parted = [Line(complex(x, low), complex(x, frame.high)) for x in (number.left, letter.left)]
    lines = [*_sides(frame), *parted, Line(start, tip), *_arrow(tip, -way)]
    return _within(size, number), _Framed(frame, lines, (_within(datum, letter),))


def rough_sign(foot: complex, words: str, height: float = SMALL_TEXT) -> tuple[list[Line], Text]:
    """The sign of a surface that stands on ``foot``, its words below the shelf."""
    top = foot + complex(_LONG * _SLOPE, _LONG)
    text = text_of(words, foot + complex(_WORDS, _LONG - 1.0 - height), height)
    shelf = Line(top, complex(text.box.right + 1.0, top.imag))
    return [Line(foot + complex(-_SHORT * _SLOPE, _SHORT), foot), Line(foot, top), shelf], text


def moved(view: Laid, canvas: Canvas, shift: complex, tolerance: float) -> list[tuple[Paper, str, Curve]]:
    """Put a view onto a sheet, its curves within ``tolerance`` mm on paper; the exact one of each, where it lies."""
    paper, exact = Paper(view.scale, shift), [curve for _, curve in view.view.strokes]
    curves, outlines = fitted_each(canvas, exact, view.scale, tolerance), list[tuple[Paper, str, Curve]]()
    for (layer, _), made, parts in zip(view.view.strokes, curves, exact_each(exact, curves), strict=True):
        draw(canvas, layer, made, paper)
        outlines += [(paper, layer, part) for part in parts]
    strokes, texts = len(canvas.strokes), len(canvas.texts)
    canvas.take(view.canvas, shift)
    canvas.dimensions += [
        replace(
            one,
            points=(one.points[0] + shift, one.points[1] + shift),
            line=one.line + shift,
            middle=one.middle + shift,
            strokes=range(one.strokes.start + strokes, one.strokes.stop + strokes),
            texts=range(one.texts.start + texts, one.texts.stop + texts),
            vertex=None if one.vertex is None else one.vertex + shift,
        )
        for one in view.canvas.dimensions
    ]
    return outlines
