"""Outlines in full size on sheets to be glued together: tiles with register marks, and a square to measure."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np

from geometry.base.record import replace
from geometry.curves.line_arc import Arc, Line
from parts.drawing.canvas import TEXT_HEIGHT, TITLE_TEXT, Box, Canvas, Paper, draw
from parts.drawing.choice import blank
from parts.drawing.expected import Expected
from parts.drawing.table import Row, Table
from parts.texts.sheets import sheet_words

# what printers leave free on every side, what the caption takes, how far neighbours overlap, mm
MARGIN, _CAPTION, OVERLAP = 8.0, 9.0, 10.0
# half of a register mark, the side of the square to measure, mm
_MARK, SQUARE = 4.0, 100.0
_NEAR = 1e-9
_MARGINS = (MARGIN, MARGIN)
Edge = Line | Arc


def model_pages(
    title: str, outlines: Mapping[str, Sequence[Edge]], errors: Mapping[str, float], paper: str, language: str
) -> list[Expected]:
    """What is needed to print and measure, then the tiles of each part; ``errors``: of each outline, mm."""
    pages, rows = [], list[Row]()
    for name, edges in outlines.items():
        tiles = _tiles(name, edges, paper, language)
        for page in tiles:
            page.canvas.max_error = errors[name]
        pages += tiles
        rows.append(Row(name, "", sheet_words(language, "model_sheets", number=len(tiles))))
    return [_cover(title, rows, paper, language), *pages]


def _cover(title: str, rows: list[Row], paper: str, language: str) -> Expected:
    """How to print, the square that must measure 100 mm, and how many sheets each part has."""
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


def _tiles(name: str, edges: Sequence[Edge], paper: str, language: str) -> list[Expected]:
    """The sheets of one outline, those that show nothing of it left out."""
    points = np.concatenate([edge.point(np.linspace(*edge.domain, 33)) for edge in edges])
    left, right, low, high = points.real.min(), points.real.max(), points.imag.min(), points.imag.max()
    layouts = []
    for upright in (True, False):
        frame = blank(paper, upright=upright, margins=_MARGINS).frame
        wide, tall = frame.wide - OVERLAP, frame.tall - _CAPTION - OVERLAP
        layouts.append((math.ceil((right - left) / wide), math.ceil((high - low) / tall), upright, wide, tall))
    columns, rows, upright, wide, tall = min(layouts, key=lambda one: one[0] * one[1])
    corner = complex(left + right - columns * wide, low + high - rows * tall) / 2
    found = []
    for row in reversed(range(rows)):
        for column in range(columns):
            canvas = blank(paper, upright=upright, margins=_MARGINS)
            frame, near = canvas.frame, corner + complex(column * wide, row * tall)
            # the cell's corner lies half of the overlap within the area
            origin = complex(frame.left, frame.low) + complex(OVERLAP, OVERLAP) / 2 - near
            cell = Box(near.real, near.imag, near.real + wide, near.imag + tall)
            pieces = [piece for edge in edges for piece in clipped(edge, cell.grown(OVERLAP / 2))]
            if not pieces:
                continue
            draw(canvas, "CUT", pieces, Paper(1.0, origin))
            if rows * columns > 1:
                _marks(canvas, cell, origin)
            cross = [Line(-_MARK * way, _MARK * way) for way in (1, 1j)]
            # it may lie where both overlap
            if Box(-_MARK, -_MARK, _MARK, _MARK).within(cell.grown(OVERLAP / 2)):
                draw(canvas, "CENTRE_MARK", cross, Paper(1.0, origin))
            place = {"row": rows - row, "column": column + 1, "rows": rows, "columns": columns}
            key = "model_tile" if rows * columns > 1 else "model_whole"
            text = sheet_words(language, key, part=name, **place)
            canvas.write(text, complex(frame.left + 2.0, frame.high - 6.0), TEXT_HEIGHT, frame.wide - 4.0)
            found.append(Expected(canvas, Paper(1.0, origin), (), {"CUT": list(pieces)}))
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
