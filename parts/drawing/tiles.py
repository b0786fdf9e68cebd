"""Outlines in full size on sheets to be glued together: tiles with register marks, and a square to measure."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

import numpy as np

from geometry.base.placement import Placement2
from geometry.base.record import Record, replace
from geometry.curves.curve import Curve, Real
from geometry.curves.line_arc import Arc, Line
from geometry.plane.measure import distance_to_nearest, profile_disc
from geometry.plane.profile import Profile
from parts.base.texts import N_
from parts.drawing.canvas import TEXT_HEIGHT, TITLE_TEXT, Box, Canvas, Paper, draw, text_width
from parts.drawing.choice import blank
from parts.drawing.expected import Expected
from parts.drawing.readback import ReadSheet, Taken
from parts.drawing.table import Row, Table
from parts.texts.sheets import sheet_words

# what printers leave free on every side, what the caption takes, how far neighbours overlap, mm
MARGIN, _CAPTION, OVERLAP = 8.0, 9.0, 10.0
# half of a register mark, the side of the square to measure, mm
_MARK, SQUARE = 4.0, 100.0
_NEAR = 1e-9
_MARGINS = (MARGIN, MARGIN)
Edge = Line | Arc
# the axis of a part
_CROSS = tuple(Line(-_MARK * way, _MARK * way) for way in (1, 1j))


class OnOutlines(Record):
    """Holds all that is cut on a sheet against the exact outlines, each moved to its place on the paper, mm."""

    placed: tuple[tuple[complex, Sequence[Profile]], ...]

    def check(self, sheet: ReadSheet, taken: Taken) -> None:
        """How far the lines of the file are from the nearest one."""
        points = np.concatenate([np.zeros(0, np.complex128), *(p for layer, p in sheet.samples if layer == "CUT")])
        discs = [[(origin + at, reach) for at, reach in map(profile_disc, own)] for origin, own in self.placed]
        gaps = [[(np.abs(points - at), reach) for at, reach in own] for own in discs]
        most = np.min([gap + reach for own in gaps for gap, reach in own], axis=0)
        near = np.full(points.shape, np.inf)
        for (origin, profiles), own in zip(self.placed, gaps, strict=True):
            # none is asked of points that are nearer to another one for certain
            mine = np.min([gap - reach for gap, reach in own], axis=0) <= most
            found = distance_to_nearest(points[mine] - origin, profiles, taken.room)
            near[mine] = np.minimum(near[mine], found)
        worst = float(near.max(initial=0.0))
        taken.measured["max_deviation"] = max(worst, taken.measured.get("max_deviation", 0.0))
        taken.unless(worst <= taken.room, N_("outlines deviate by {worst:.3g} mm from the exact ones"), worst=worst)


def model_pages(
    title: str,
    outlines: Mapping[str, Sequence[Edge]],
    exact: Mapping[str, Sequence[Profile]],
    errors: Mapping[str, float],
    paper: str,
    language: str,
) -> list[Expected]:
    """What is needed to print and measure, then each part: its outline, the exact ones, the error between, mm.

    Outlines that a sheet holds whole share it where it has room for several.
    """
    boxes = {name: _box_of(edges) for name, edges in outlines.items()}
    layouts = {name: _layout(box, paper) for name, box in boxes.items()}
    groups: list[list[str]] = []
    for upright in (True, False):
        whole = [n for n, one in layouts.items() if one.columns * one.rows == 1 and one.upright == upright]
        groups += _groups(whole, boxes, blank(paper, upright=upright, margins=_MARGINS).frame, language)
    shared = {name: group for group in groups if len(group) > 1 for name in group}
    pages, rows, first = list[Expected](), list[Row](), dict[str, int]()
    for name, edges in outlines.items():
        if name not in first:
            group = shared.get(name, [name])
            first |= dict.fromkeys(group, len(pages) + 2)
            if len(group) > 1:
                shown = {n: outlines[n] for n in group}
                made = [_together(shown, exact, boxes, layouts[name].upright, paper, language)]
            else:
                made = _tiles(name, edges, exact[name], layouts[name], boxes[name], paper, language)
            for page in made:
                page.canvas.max_error = max(errors[n] for n in group)
            pages += made
        last = len(pages) + 1 if name not in shared else first[name]
        key = "model_sheet" if last == first[name] else "model_sheets"
        rows.append(Row(name, "", sheet_words(language, key, first=first[name], last=last)))
    return [_cover(title, rows, paper, language), *pages]


class _Layout(Record):
    """In how many tiles an outline lies on paper, and the size of each, mm."""

    columns: int
    rows: int
    upright: bool
    wide: float
    tall: float


def _layout(box: Box, paper: str) -> _Layout:
    """The fewest tiles."""
    found = []
    for upright in (True, False):
        frame = blank(paper, upright=upright, margins=_MARGINS).frame
        wide, tall = frame.wide - OVERLAP, frame.tall - _CAPTION - OVERLAP
        found.append(_Layout(math.ceil(box.wide / wide), math.ceil(box.tall / tall), upright, wide, tall))
    return min(found, key=lambda one: one.columns * one.rows)


def _box_of(edges: Sequence[Edge]) -> Box:
    return Box.of(point for edge in edges for point in _outmost(edge))


def _outmost(edge: Edge) -> Iterator[complex]:
    """The ends of an edge, and where an arc runs along a side of its box."""
    yield from edge.point(np.array(edge.domain)).tolist()
    if isinstance(edge, Arc):
        low, high = sorted((edge.start_angle, edge.start_angle + edge.sweep))
        for quarter in range(math.ceil(low / (math.pi / 2)), math.floor(high / (math.pi / 2)) + 1):
            yield edge.centre + edge.radius * 1j ** (quarter % 4)


def _caption(name: str, language: str) -> str:
    return sheet_words(language, "model_whole", part=name)


def _cell(name: str, box: Box, frame: Box, language: str) -> complex:
    """The room that an outline takes on a sheet with its caption, mm."""
    return complex(max(box.wide, min(text_width(_caption(name, language)), frame.wide)), box.tall + _CAPTION)


def _groups(names: Sequence[str], boxes: Mapping[str, Box], frame: Box, language: str) -> list[list[str]]:
    """The outlines of each sheet: in rows, the tallest first."""
    found: list[list[str]] = []
    at, deep = 0j, 0.0
    for name in sorted(names, key=lambda n: -boxes[n].tall):
        cell = _cell(name, boxes[name], frame, language)
        if found and at.real + cell.real > frame.wide:
            at, deep = complex(0.0, at.imag + deep + OVERLAP), 0.0
        if not found or at.imag + cell.imag > frame.tall:
            found.append([])
            at, deep = 0j, 0.0
        found[-1].append(name)
        at, deep = at + cell.real + OVERLAP, max(deep, cell.imag)
    return found


def _together(
    outlines: Mapping[str, Sequence[Edge]],
    exact: Mapping[str, Sequence[Profile]],
    boxes: Mapping[str, Box],
    upright: bool,
    paper: str,
    language: str,
) -> Expected:
    """One sheet of several outlines, in rows."""
    canvas = blank(paper, upright=upright, margins=_MARGINS)
    frame, curves, placed = canvas.frame, list[Curve](), list[tuple[complex, Sequence[Profile]]]()
    at, deep = complex(frame.left, frame.high), 0.0
    for name, edges in outlines.items():
        box, cell = boxes[name], _cell(name, boxes[name], frame, language)
        if at.real + cell.real > frame.right + _NEAR:
            at, deep = complex(frame.left, at.imag - deep - OVERLAP), 0.0
        canvas.write(_caption(name, language), at - 6.0j, TEXT_HEIGHT, frame.wide)
        place = Paper(1.0, at - 1j * _CAPTION - complex(box.left, box.high))
        moved = [edge.placed(Placement2(0.0, place.origin)) for edge in edges]
        draw(canvas, "CUT", moved, Paper(1.0, 0j))
        curves += moved
        placed.append((place.origin, exact[name]))
        # that of a small part beside the frame would leave the sheet
        cross = Box(-_MARK, -_MARK, _MARK, _MARK).moved(place.origin)
        if Box(0.0, 0.0, 0.0, 0.0).within(box) and cross.within(frame):
            draw(canvas, "CENTRE_MARK", _CROSS, place)
        at, deep = at + cell.real + OVERLAP, max(deep, cell.imag)
    return Expected(canvas, Paper(1.0, 0j), (), {"CUT": curves}, measures=OnOutlines(tuple(placed)))


def _cover(title: str, rows: list[Row], paper: str, language: str) -> Expected:
    """How to print, the square that must measure 100 mm, and on which sheets each part is."""
    canvas = blank(paper, upright=True, margins=_MARGINS)
    frame = canvas.frame
    wide, at = frame.wide, complex(frame.left, frame.high - 2 * TITLE_TEXT)
    canvas.write(title, at, TITLE_TEXT, wide)
    for key in ("model_print", "model_glue"):
        at -= 2.2j * TEXT_HEIGHT
        canvas.write(sheet_words(language, key), at, TEXT_HEIGHT, wide)
    low = at.imag - SQUARE - 3 * TEXT_HEIGHT
    square = Box(frame.left + 2.0, low, frame.left + 2.0 + SQUARE, low + SQUARE)
    canvas.box("CUT", square)
    canvas.write(f"{SQUARE:g} x {SQUARE:g}", complex(square.left + 4.0, square.low + 4.0), TEXT_HEIGHT)
    table = Table(tuple(rows), TEXT_HEIGHT, wide - 4.0)
    # as many as there is room for: what is missing has its sheets all the same
    room = int((square.low - frame.low - 6.0) / (table.size[1] / len(rows)))
    table = replace(table, rows=table.rows[:room])
    if table.rows:
        table.draw(canvas, complex(frame.left + 2.0, square.low - 6.0 - table.size[1]))
    sides = [Line(a, b) for a, b in pairwise([*square.corners, square.corners[0]])]
    return Expected(canvas, Paper(1.0, 0j), (), {"CUT": list(sides)})


def _tiles(
    name: str,
    edges: Sequence[Edge],
    exact: Sequence[Profile],
    layout: _Layout,
    box: Box,
    paper: str,
    language: str,
) -> list[Expected]:
    """The sheets of one outline, those that show nothing of it left out."""
    columns, rows, upright, wide, tall = layout.columns, layout.rows, layout.upright, layout.wide, layout.tall
    corner = complex(box.left + box.right - columns * wide, box.low + box.high - rows * tall) / 2
    found = []
    cells = _cells(edges, corner, layout)
    for row, column in sorted(cells, key=lambda at: (-at[0], at[1])):
        near = corner + complex(column * wide, row * tall)
        cell = Box(near.real, near.imag, near.real + wide, near.imag + tall)
        pieces = [piece for edge in cells[row, column] for piece in clipped(edge, cell.grown(OVERLAP / 2))]
        if not pieces:
            continue
        canvas = blank(paper, upright=upright, margins=_MARGINS)
        frame = canvas.frame
        # the cell's corner lies half of the overlap within the area
        origin = complex(frame.left, frame.low) + complex(OVERLAP, OVERLAP) / 2 - near
        draw(canvas, "CUT", pieces, Paper(1.0, origin))
        if rows * columns > 1:
            _marks(canvas, cell, origin)
        # it may lie where both overlap
        if Box(-_MARK, -_MARK, _MARK, _MARK).within(cell.grown(OVERLAP / 2)):
            draw(canvas, "CENTRE_MARK", _CROSS, Paper(1.0, origin))
        place = {"row": rows - row, "column": column + 1, "rows": rows, "columns": columns}
        tiled = sheet_words(language, "model_tile", part=name, **place)
        text = tiled if rows * columns > 1 else _caption(name, language)
        canvas.write(text, complex(frame.left + 2.0, frame.high - 6.0), TEXT_HEIGHT, frame.wide - 4.0)
        on = OnOutlines(((origin, exact),))
        found.append(Expected(canvas, Paper(1.0, origin), (), {"CUT": list(pieces)}, measures=on))
    return found


def _cells(edges: Sequence[Edge], corner: complex, layout: _Layout) -> dict[tuple[int, int], list[Edge]]:
    """The edges that may show on each tile, by its row and column."""
    found: dict[tuple[int, int], list[Edge]] = {}
    for edge in edges:
        ends = edge.point(np.array(edge.domain)) - corner
        # no place of an arc is farther off its chord
        off = OVERLAP / 2 + (edge.radius * (1 - math.cos(edge.sweep / 2)) if isinstance(edge, Arc) else 0.0)

        def span(along: Real, side: float, count: int, off: float = off) -> range:
            first, last = math.floor((along.min() - off) / side), math.floor((along.max() + off) / side)
            return range(max(first, 0), min(last, count - 1) + 1)

        for row in span(ends.imag, layout.tall, layout.rows):
            for column in span(ends.real, layout.wide, layout.columns):
                found.setdefault((row, column), []).append(edge)
    return found


def _marks(canvas: Canvas, cell: Box, origin: complex) -> None:
    """Crosses at the corners of a cell, which its neighbours have too."""
    for x in (cell.left, cell.right):
        for y in (cell.low, cell.high):
            for way in (_MARK, 1j * _MARK):
                canvas.line("REGISTER", origin + complex(x, y) - way, origin + complex(x, y) + way)


def clipped(edge: Edge, box: Box) -> list[Edge]:
    """The pieces of a line or an arc that lie in a box."""
    a, b = edge.domain
    cuts = sorted({a, b, *(t for t in _crossings(edge, box) if a + _NEAR < t < b - _NEAR)})
    found: list[Edge] = []
    for low, high in pairwise(cuts):
        middle = complex(edge.point((low + high) / 2))
        if box.left <= middle.real <= box.right and box.low <= middle.imag <= box.high:
            found.append(edge if (low, high) == (a, b) else edge.trimmed(low, high))
    return found


def _crossings(edge: Edge, box: Box) -> list[float]:
    """Where a line or an arc meets the lines of a box's sides."""
    found = []
    for way, sides in ((1.0, (box.left, box.right)), (-1j, (box.low, box.high))):
        for side in sides:
            if isinstance(edge, Line):
                start, end = (edge.start * way).real, (edge.end * way).real
                found += [(side - start) / (end - start)] if end != start else []
                continue
            reach = (side - (edge.centre * way).real) / edge.radius
            if abs(reach) <= 1:
                for angle in (math.acos(reach), -math.acos(reach)):
                    turn = (angle - cmath.phase(way) - edge.start_angle) * math.copysign(1.0, edge.sweep)
                    found.append(turn % (2 * math.pi))
    return found
