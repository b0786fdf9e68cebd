"""An assembly drawing on paper: views with numbers of positions on leaders, sizes, the parts list; GOST 2.109."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping, Sequence
from functools import cache, partial
from itertools import product

import numpy as np

from geometry.base.findings import Finding
from geometry.base.record import Record, replace
from geometry.curves.line_arc import Arc, Line, lines_cross
from parts.drawing.assembly_views import Drawn
from parts.drawing.canvas import SCALES, TITLE_TEXT, Box, Canvas, Paper, Stroke, Text, text_of, text_width
from parts.drawing.choice import Asked, sheet_for
from parts.drawing.dimensioning import Laid, laid, moved
from parts.drawing.expected import Expected
from parts.drawing.hatching import hatching
from parts.drawing.ink import Ink
from parts.drawing.labels import spread
from parts.drawing.part_sheet import PartMeasures, extent, points_of
from parts.drawing.parts_list import ListRow, draw_list, list_size
from parts.drawing.title_block import TITLE_BLOCK, turned_box
from parts.drawing.working import Side, Size, View

# mm on paper: from the frame to views, between views; of hatching from part to part
_MARGIN, _BETWEEN, _HATCH, _WIDER = 6.0, 14.0, 2.5, 0.8
# of numbers: their height, from one to the next, from the view to them, the shelf beside the number, the dot, how much
# leaders rise
_HEIGHT, _STEP, _AWAY, _SHELF, _DOT, _SLANT = TITLE_TEXT, 10.0, 9.0, 1.5, 0.5, 14.0
# of the marks of the section: length of a stroke and of its arrow, how far outside
_MARK, _ARROW, _OUT = 7.0, 5.0, 2.0
# height of the longest list that stands on the drawing, mm
_MOST_LIST = 220.0
# part of the most room about a leader's end with which nearer ends are as good
_ROOMY = 0.6
# shelves that are tried for a number, each half a step lower
_TRIES = 12
# the largest extent of the views on paper, below which larger paper is better, but for what is enlarged so far
_LEAST, _ENLARGED = 120.0, 2.0
_LETTER = "A"
# mm by which lines along a size are off it at most; digits of what is a tie on any machine
_LEVEL, _DIGITS = 1e-6, 6
# how many times higher than a view a column of numbers may be that crosses fewer dimension lines
_HIGHER = 2.0
# how many times longer than high a view is whose numbers stand above it, and from one of these to the next, mm
_LONG, _ROW_STEP = 2.5, 14.0
# a number with the places where its leader may end
_Numbered = tuple[int, tuple[complex, ...]]


class AssemblyView(Record):
    """A view of an assembly with its sizes; ``marked``: the plane of the section crosses it along x; or a title."""

    drawn: Drawn
    sizes: tuple[Size, ...]
    marked: bool = False
    title: str = ""


def assembly_sheet(views: Sequence[AssemblyView], rows: Sequence[ListRow], asked: Asked) -> Expected:
    """The drawing on the smallest paper that shows it well, or as it is asked for.

    A long list stands on sheets of its own. A part that is covered in all views has no number, and a finding.

    Raises
    ------
    ParameterError
        The paper is too small for the scale, or none is large enough.
    """
    listed = rows if list_size(rows, asked.language)[1] <= _MOST_LIST else ()
    tall = TITLE_BLOCK[1] + (list_size(rows, asked.language)[1] if listed else 0.0)

    def fields(canvas: Canvas) -> Iterator[Box]:
        """Beside the title block and the list, or above them; clear of the designation."""
        frame, corner = canvas.frame, turned_box(canvas)
        frame = replace(frame, high=corner.low) if corner.wide > corner.tall else replace(frame, left=corner.right)
        if frame.low + tall > frame.high:
            return
        yield Box(frame.left, frame.low, frame.right - TITLE_BLOCK[0], frame.high).grown(-_MARGIN)
        yield Box(frame.left, frame.low + tall, frame.right, frame.high).grown(-_MARGIN)

    @cache
    def views_at(scale: float) -> tuple[Laid, ...]:
        """The views at a scale; none where words or numbers find no room."""
        found = _laid(views, rows, scale, asked)
        return () if found is None else found

    extents = [extent(view.drawn.strokes) for view in views]

    def holds(canvas: Canvas, scale: float) -> bool:
        """Whether both views stand in a field."""
        # bare views are held against the fields before they are laid out
        bare = [Box(0.0, 0.0, scale * wide, scale * tall) for wide, tall in extents]
        return any(_origins(bare, field) and _places(views_at(scale), field) for field in fields(canvas))

    def greatest(canvas: Canvas) -> float:
        """The greatest scale at which they do."""
        most = max(canvas.width, canvas.height) / max(map(max, extents))
        return next((scale for scale in SCALES if scale <= most and holds(canvas, scale)), 0.0)

    canvas, scale = sheet_for(asked, greatest, min(_ENLARGED, _LEAST / max(map(max, extents))), holds)
    made = views_at(scale)
    canvas.box("FRAME", canvas.frame)
    corner = complex(canvas.frame.right - TITLE_BLOCK[0], canvas.frame.low + tall)
    if listed:
        draw_list(canvas, corner, listed, asked.language)
    shifts = next(found for field in fields(canvas) if (found := _places(made, field)) is not None)
    outlines = [own for one, at in zip(made, shifts, strict=True) for own in moved(one, canvas, at, asked.tolerance)]
    shown = {number for share in _shared([view.drawn for view in views], rows, scale) for number in share}
    hidden = tuple(Finding("position_not_shown", row.position, 0.0) for row in rows if row.position not in shown)
    measures = PartMeasures(canvas, tuple(outlines))
    return Expected(canvas, Paper(scale, shifts[0]), (), measures=measures, findings=hidden)


def _places(views: Sequence[Laid], field: Box) -> list[complex] | None:
    """Where the origins of views stand in a field, one above the other on one axis, or side by side; None: nowhere."""
    return _origins([view.box for view in views], field) if views else None


def _origins(boxes: Sequence[Box], field: Box) -> list[complex] | None:
    """The same of their boxes."""
    gaps = _BETWEEN * (len(boxes) - 1)
    about, column, row = Box.about(boxes), sum(b.tall for b in boxes) + gaps, sum(b.wide for b in boxes) + gaps
    found = []
    if column <= field.tall and about.wide <= field.wide:
        x, y = field.left + (field.wide - about.wide) / 2 - about.left, field.high - (field.tall - column) / 2
        for box in boxes:
            found.append(complex(x, y - box.high))
            y -= box.tall + _BETWEEN
        return found
    if row <= field.wide and about.tall <= field.tall:
        x, y = field.left + (field.wide - row) / 2, field.low + (field.tall - about.tall) / 2 - about.low
        for box in boxes:
            found.append(complex(x - box.left, y))
            x += box.wide + _BETWEEN
        return found
    return None


def _laid(
    views: Sequence[AssemblyView], rows: Sequence[ListRow], scale: float, asked: Asked
) -> tuple[Laid, ...] | None:
    """All views at a scale with their numbers; None where something finds no room."""
    shares = _shared([view.drawn for view in views], rows, scale)
    found = []
    for view, share in zip(views, shares, strict=True):
        numbered = _numbered(view, share, scale, asked.language)
        if numbered is None:
            return None
        found.append(numbered)
    return tuple(found)


def _sized(view: AssemblyView, scale: float, language: str, free: Mapping[Side, float]) -> Laid | None:
    """A view with its sizes, ``free`` sides between it and them, and the letters of its section."""
    drawn = view.drawn
    marks = tuple(_marks(drawn, scale)) if view.marked else ()
    plain = View((*drawn.strokes, *marks), (), drawn.axes, view.sizes, title=view.title)
    one = laid(plain, scale, language, free=free)
    if one is None:
        return None
    _hatch(one.canvas, drawn, scale)
    ink = one.ink()
    for places in _letters(drawn, scale) if view.marked else ():
        texts = [text_of(_LETTER, at, _HEIGHT) for at in places]
        letter = next((text for text in texts if ink.holds((), text.box)), None)
        if letter is None:
            return None
        one.canvas.texts.append(letter)
        ink.boxes.append(letter.box)
    return replace(one, box=Box.about([one.box, *(text.box for text in one.canvas.texts)]))


def _hatch(canvas: Canvas, drawn: Drawn, scale: float) -> None:
    """Every part's own hatching: to one side or to the other, then wider (GOST 2.306)."""
    paper = Paper(scale, 0j)
    for number, loops in enumerate(drawn.hatched):
        placed = [[paper.scaled(c) for c in loop] for loop in loops]
        for line in hatching(placed, _HATCH + _WIDER * (number // 2), falls=number % 2 == 1):
            canvas.add("HATCH", line)


def _ends(drawn: Drawn, scale: float) -> tuple[float, float]:
    """Where the marks of the section's plane begin on the left and on the right, model mm."""
    points = points_of(drawn.strokes)
    return float(points.real.min()) - _OUT / scale, float(points.real.max()) + _OUT / scale


def _marks(drawn: Drawn, scale: float) -> Iterator[tuple[str, Line]]:
    """Strokes of the section's plane at both ends, with arrows along which it is looked at, upwards."""
    for end, way in zip(_ends(drawn, scale), (-1, 1), strict=True):
        far = end + way * _MARK / scale
        yield "FRAME", Line(complex(end), complex(far))
        tip, foot = complex(far - way * 1.0 / scale, 0), complex(far - way * 1.0 / scale, -_ARROW / scale)
        yield "THIN", Line(foot, tip)
        for side in (-1, 1):
            yield "THIN", Line(tip + complex(side * 0.7, -2.5) / scale, tip)


def _letters(drawn: Drawn, scale: float) -> Iterator[list[complex]]:
    """Where the letters of the section may stand, the left one and the right one, mm on paper: beside their arrows."""
    wide = text_width(_LETTER, _HEIGHT)
    for end, way in zip(_ends(drawn, scale), (-1, 1), strict=True):
        arrow, drop = scale * end + way * (_MARK - 1.0), -_HEIGHT - 1.5
        inner, outer = (arrow + side * 1.6 - (wide if side < 0 else 0.0) for side in (-way, way))
        yield [complex(x, y) for y in (drop, 2.6, drop - _HEIGHT, 2.6 + _HEIGHT) for x in (inner, outer)]


def _shared(drawns: Sequence[Drawn], rows: Sequence[ListRow], scale: float) -> list[dict[int, tuple[complex, ...]]]:
    """For each view the numbers that stand there, with places for their leaders: where there is most room about."""
    found: list[dict[int, tuple[complex, ...]]] = [{} for _ in drawns]
    for row in rows:
        places = [[spot for part in row.parts for spot in drawn.spots.get(part, ())] for drawn in drawns]
        room = [max((off for _, off in spots), default=-1.0) for spots in places]
        if max(room) > 0:
            best = room.index(max(room))
            ordered = sorted(places[best], key=lambda spot: -spot[1])
            ends = np.array([p for p, off in ordered if off >= _ROOMY * max(room)])
            found[best][row.position] = tuple((scale * ends).round(_DIGITS).tolist())
    return found


class _Leader(Record):
    """A number on its shelf: where its leader ends on the part, where it meets the shelf; ``way``: of the shelf, ±1."""

    number: int
    spot: complex
    elbow: complex
    way: int

    def lines(self) -> list[Line]:
        """Leader and shelf."""
        long = text_width(str(self.number), _HEIGHT) + 2 * _SHELF
        return [Line(self.spot, self.elbow), Line(self.elbow, self.elbow + self.way * long)]

    @property
    def words(self) -> Text:
        """The number above its shelf."""
        text = str(self.number)
        left = _SHELF if self.way > 0 else -_SHELF - text_width(text, _HEIGHT)
        return text_of(text, self.elbow + complex(left, 2.2), _HEIGHT)


def _numbered(view: AssemblyView, share: Mapping[int, tuple[complex, ...]], scale: float, language: str) -> Laid | None:
    """A view with its sizes and its numbers; None where one would run through words.

    The numbers stand in a column on each side, those of a long view above it. Where leaders would cross dimension lines
    all stand on one side, or nearer to the view than these: as the leaders are shortest.
    """
    if (usual := _sized(view, scale, language, {})) is None:
        return None
    numbers, box = sorted(share.items(), key=lambda pair: (pair[1][0].real, pair[0])), usual.box
    tall, wide, sides = box.tall, box.wide, _sides(numbers, box)
    room = _AWAY + 2 * _SHELF + max((text_width(str(number), _HEIGHT) for number in share), default=0.0)
    best, least = None, (math.inf, math.inf, math.inf)
    for free, (left, right) in product((0.0, room), (sides, (numbers, []), ([], numbers))):
        if best is not None and (not any(least[1:]) or _STEP * max(len(left), len(right)) > _HIGHER * tall):
            continue
        kept: dict[Side, float] = {"left": free if left else 0.0, "right": free if right else 0.0}
        one = _sized(view, scale, language, kept) if free else usual
        if one is None:
            continue
        # those of a long view stand above it, where the columns beside it would be higher than the view is
        is_long = not free and wide > _LONG * tall and len(numbers) * _STEP > 2 * tall
        row = _row(numbers, box, _ink(one, view)) if is_long else None
        found = row or _led(left, right, _body(view, scale) if free else box, _ink(one, view))
        if found is not None:
            lines = [*_size_lines(one.canvas)]
            shelved = [line for leader in found for line in leader.lines()]
            over = sum(lines_cross(line.start, line.end, *other) for line in shelved for other in lines)
            long = sum(_off(leader.spot, leader.elbow) for leader in found)
            cost = (
                float(_crossings(found, ())), float(over),
                0.0 if one is usual and left is sides[0] else long,
            )  # fmt: skip
            best, least = ((one, found), cost) if cost < least else (best, least)
    if best is None:
        return None
    one, leaders = best
    canvas = one.canvas
    for leader in leaders:
        for line in leader.lines():
            canvas.add("THIN", line)
        canvas.strokes += [Stroke("THIN", Arc(leader.spot, r, 0.0, 2 * math.pi)) for r in (_DOT, _DOT / 2)]
        canvas.texts.append(leader.words)
    ends = [line.end for leader in leaders for line in leader.lines()]
    shelves = [Box(p.real, p.imag, p.real, p.imag) for p in ends]
    return replace(one, box=Box.about([one.box, *(text.box for text in canvas.texts), *shelves]))


def _ink(one: Laid, view: AssemblyView) -> Ink:
    """All that is on paper; leaders keep off the marks of the section as off words."""
    ink = one.ink()
    marks = [line for _, line in _marks(view.drawn, one.scale)] if view.marked else []
    for side in (marks[: len(marks) // 2], marks[len(marks) // 2 :]):
        ink.boxes += [Box.of(one.scale * p for line in side for p in (line.start, line.end))] if side else []
    return ink


def _body(view: AssemblyView, scale: float) -> Box:
    """The view alone with the marks of its section, mm on paper."""
    points = scale * points_of(view.drawn.strokes)
    off = _OUT + _MARK if view.marked else 0.0
    return Box(points.real.min() - off, points.imag.min(), points.real.max() + off, points.imag.max())


def _led(left: Sequence[_Numbered], right: Sequence[_Numbered], box: Box, ink: Ink) -> list[_Leader] | None:
    """Leaders to a column on each side; None where one would run through words."""
    leaders = list[_Leader]()
    for way, column in ((-1, left), (1, right)):
        found = _column(column, way, box, ink, leaders)
        if found is None:
            return None
        leaders += found
        for leader in found:
            for line in leader.lines():
                ink.add(line)
            ink.boxes.append(leader.words.box)
    return leaders


def _size_lines(canvas: Canvas) -> Iterator[tuple[complex, complex]]:
    """Both ends of each dimension line."""
    for size in (one for one in canvas.dimensions if one.vertex is None):
        way = cmath.rect(1.0, math.radians(size.angle))
        for stroke in canvas.strokes[size.strokes.start : size.strokes.stop]:
            line = stroke.curve
            if isinstance(line, Line) and abs(((line.end - line.start) / way).imag) < _LEVEL:
                yield line.start, line.end


def _sides(numbers: Sequence[_Numbered], box: Box) -> tuple[list[_Numbered], list[_Numbered]]:
    """Numbers, from the left, of the left and of the right column: what one has no room for stands in the other one."""
    most = max(int(box.tall / _STEP) + 1, math.ceil(len(numbers) / 2))
    left = sum(spots[0].real < box.middle.real - _LEVEL for _, spots in numbers)
    left = max(min(left, most), len(numbers) - most)
    return [*numbers[:left]], [*numbers[left:]]


def _row(numbers: Sequence[_Numbered], box: Box, ink: Ink) -> list[_Leader] | None:
    """Numbers, from the left, in a row above a view, their leaders without crossings and over no words."""
    middle, half = box.middle.real, max(box.wide, _ROW_STEP * (len(numbers) - 1)) / 2
    places = spread([spots[0].real for _, spots in numbers], _ROW_STEP, middle - half, middle + half)
    chosen: list[_Leader] = []
    for (number, spots), x in zip(numbers, places, strict=True):
        elbow = complex(x, box.high + _AWAY)
        fits = (_Leader(number, spot, elbow, 1) for spot in sorted(spots, key=partial(_off, elbow)))
        free = next((one for one in fits if ink.holds(one.lines(), one.words.box)), None)
        if free is None:
            return None
        chosen.append(free)
    return _untangled(chosen, ink)


def _column(
    numbers: Sequence[_Numbered], way: int, box: Box, ink: Ink, placed: Sequence[_Leader]
) -> list[_Leader] | None:
    """The numbers of one side, from above, their leaders without crossings and over no words.

    ``placed``: leaders of the other side.
    """
    best = None
    for strict in (False, True):
        found = _swept(numbers, way, box, ink, placed, strict=strict)
        if found is not None and (best is None or _crossings(found, placed) < _crossings(best, placed)):
            best = found
        if best is None or not _crossings(best, placed):
            break
    return best


def _crossings(leaders: Sequence[_Leader], placed: Sequence[_Leader]) -> int:
    """How often leaders cross each other and those that are placed."""
    return sum(_cross(one, other) for k, one in enumerate(leaders) for other in (*placed, *leaders[:k]))


def _swept(
    numbers: Sequence[_Numbered], way: int, box: Box, ink: Ink, placed: Sequence[_Leader], *, strict: bool
) -> list[_Leader] | None:
    """The same in one sweep; ``strict``: no place of a number that is to come is above a leader."""
    x = box.right + _AWAY if way > 0 else box.left - _AWAY
    left = list(numbers)
    if not left:
        return []
    # beside the parts, but within the height of the view where there is room
    tall = _STEP * (len(left) - 1)
    middle = sum(spots[0].imag for _, spots in left) / len(left)
    y = max(min(middle + tall / 2 + _SLANT, box.high - _HEIGHT), box.low + tall)
    chosen: list[_Leader] = []
    while left:
        free, begin = None, y
        # none crosses another one where there is such a place
        for k in range(2 * _TRIES):
            y = begin if k == _TRIES else y
            elbow = complex(x, y)
            # a leader that no other place is above of is crossed by none from below
            number, spots = max(left, key=partial(_slope, elbow))
            first = _Leader(number, spots[0], elbow, way)
            shelf = first.lines()[1]
            # the shelf is that of every spot; of these the first that will do is taken
            if ink.holds([shelf], first.words.box) and not (k < _TRIES and ink.under(shelf)):
                fits = iter([first, *(replace(first, spot=s) for s in sorted(spots, key=partial(_off, elbow)))])
                if strict and k < _TRIES:
                    most = max((_slope(elbow, one) for one in left if one[0] != number), default=-math.inf)
                    fits = (one for one in fits if _slope(elbow, (number, (one.spot,))) >= most)
                others = (*placed, *chosen) if k < _TRIES else ()
                fits = (one for one in fits if not any(_cross(one, other) for other in others))
                if k < _TRIES:
                    fits = (one for one in fits if not ink.follows(one.lines()[0]))
                free = next((one for one in fits if ink.holds(one.lines(), one.words.box)), None)
            y -= _STEP if free else _STEP / 2
            if free:
                break
        if free is None:
            return None
        chosen.append(free)
        left = [one for one in left if one[0] != free.number]
    return _untangled(chosen, ink)


def _slope(elbow: complex, one: _Numbered) -> float:
    """How steeply a leader rises from its shelf."""
    way = one[1][0] - elbow
    return round(way.imag / abs(way.real), _DIGITS)


def _untangled(leaders: list[_Leader], ink: Ink) -> list[_Leader]:
    """The same, two that cross exchange their shelves, which makes both shorter."""
    for _ in range(len(leaders) ** 2):
        pairs = [(i, j) for i in range(len(leaders)) for j in range(i) if _cross(leaders[i], leaders[j])]
        for i, j in pairs:
            one, two = leaders[i], leaders[j]
            new = _Leader(one.number, one.spot, two.elbow, one.way), _Leader(two.number, two.spot, one.elbow, two.way)
            if all(ink.holds(leader.lines(), leader.words.box) for leader in new):
                leaders[i], leaders[j] = new
                break
        else:
            break
    return leaders


def _off(one: complex, other: complex) -> float:
    """Distance of two points, mm."""
    return round(abs(one - other), _DIGITS)


def _cross(one: _Leader, two: _Leader) -> bool:
    """Whether two leaders cross."""
    return lines_cross(one.spot, one.elbow, two.spot, two.elbow)
