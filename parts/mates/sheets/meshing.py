"""The picture of meshing as a sheet: both bodies, all circles, the line of action, the arc of action, with names.

By hand: squared paper with the line of centres, T-T and the pole, to draw the picture on.
"""

from __future__ import annotations

import cmath
import math
from itertools import pairwise

from geometry.base.record import Record, replace
from geometry.curves.curve import end_point, start_point
from geometry.curves.line_arc import Arc, Line
from geometry.gears.pictures.meshing import CIRCLES, Body, MeshingPicture
from parts.drawing.canvas import Box, Canvas, decimal, draw, fitted, scale_text
from parts.drawing.choice import Asked
from parts.drawing.labels import Labeller
from parts.drawing.table import Row, Table
from parts.drawing.view import BREAK, GAP, LEAD, TEETH, View, is_up, layout
from parts.texts.sheets import sheet_words

# how far inside a body its dimension arc runs, mm on paper
_INSIDE = 8.0
# an axis beyond a break stands so far from where its line ends, mm on paper
_AXIS = 4.0
# circles are drawn at most this far from the line of centres
_WIDEST = math.radians(75)
SYMBOLS = {"tip": "a", "working": "w", "reference": "", "base": "b", "root": "f"}


# names of circles and where each ends on the left and on the right
Ends = list[tuple[str, tuple[complex, complex]]]


class Facts(Record):
    """What stands beside the picture: its title and the rows of its table."""

    title: str
    rows: tuple[Row, ...]


def meshing_canvas(picture: MeshingPicture, module: float, facts: Facts, asked: Asked) -> tuple[Canvas, View]:
    """The sheet of a picture and what of the plane it shows, where; ``module`` in mm.

    Raises
    ------
    ParameterError
        The paper that is asked for is too small.
    """
    language = asked.language
    # what no sheet may show stands in the table
    most = [Row(sheet_words(language, "off_sheet"), "r_{b1}", "1000.000")] * 2
    canvas, view = layout(picture, module, [*facts.rows, *most, Row(sheet_words(language, "scale"), "", "0:0")], asked)
    canvas.head(facts.title, GAP)
    ends: list[Ends] = []
    dimensions: dict[str, complex] = {}
    if asked.by_hand:
        _squares(canvas, picture, view)
    else:
        ends = [_circles(canvas, body, _fan(body, view.window), view) for body in picture.bodies]
        _teeth(canvas, picture, view, asked.tolerance)
        _lines(canvas, picture, view)
        canvas.add("ARC_OF_ACTION", view.paper.scaled(picture.arc_of_action))
        canvas.add("WORKING_PITCH", view.paper.scaled(picture.pitch))
        dimensions = _dimensions(canvas, picture, view)
    rows = list(facts.rows)
    for index, body in enumerate(picture.bodies, 1):
        # what a picture of large gears leaves out
        for name in (n for n in body.radii if not view.shows(body, n)):
            value = decimal(f"{body.radii[name]:.3f}", language)
            rows.append(Row(sheet_words(language, "off_sheet"), f"r_{{{SYMBOLS[name]}{index}}}", value))
    rows.append(Row(sheet_words(language, "scale"), "", scale_text(view.paper.scale, language), answers=0))
    table = Table(tuple(rows), canvas.letters)
    table.draw(canvas, complex(canvas.frame.right - table.size[0], canvas.content.low))
    if asked.by_hand:
        return canvas, view
    labels = Labeller(canvas, view.room)
    for index, (found, body) in enumerate(zip(ends, picture.bodies, strict=True)):
        left = index == 0
        edge = view.seen.left - LEAD if left else view.seen.right + LEAD
        names = [(_circle_name(body, name, index, language), end[0 if left else 1]) for name, end in found]
        labels.column(names, edge, view.room.low + canvas.letters, view.room.high - canvas.letters, left=left)
    _names(labels, picture, view, dimensions, language)
    return canvas, view


def _circle_name(body: Body, name: str, index: int, language: str) -> str:
    symbol = f"{SYMBOLS[name]}{index + 1}"
    if body.centre is None:
        return sheet_words(language, f"{name}_line")
    return f"r_{{{symbol}}} = {decimal(f'{body.radii[name]:.2f}', language)}"


def _fan(body: Body, window: Box) -> tuple[float, float]:
    """How far the circles run to the left and to the right of the line of centres, rad; a rack's lines, mm."""
    if body.centre is None:
        return -window.left, window.right
    up = is_up(body, window)
    sides = []
    for reach in (body.centre.real - window.left, window.right - body.centre.real):
        angles = [_WIDEST]
        for radius in body.radii.values():
            if radius > reach:
                angles.append(math.asin(reach / radius))
            drop = (window.low - body.centre.imag) if up else (body.centre.imag - window.high)
            if abs(drop) < radius and drop > 0:
                angles.append(math.acos(drop / radius))
        sides.append(min(angles))
    return sides[0], sides[1]


def _circles(
    canvas: Canvas, body: Body, fan: tuple[float, float], view: View
) -> list[tuple[str, tuple[complex, complex]]]:
    """The circles of a body as arcs about the mesh; the names and both ends of each, on paper."""
    found: Ends = []
    for name in CIRCLES:
        if name not in body.radii or not view.shows(body, name):
            continue
        layer, radius = f"CIRCLE_{name.upper()}", body.radii[name]
        if body.centre is None:
            line = Line(complex(-fan[0], radius), complex(fan[1], radius))
            canvas.add(layer, view.paper.scaled(line))
            found.append((name, (view.paper.point(line.start), view.paper.point(line.end))))
            continue
        if is_up(body, view.window):
            arc = Arc(body.centre, radius, math.pi / 2 - fan[1], fan[0] + fan[1])
            ends = end_point(arc), start_point(arc)
        else:
            arc = Arc(body.centre, radius, -math.pi / 2 - fan[0], fan[0] + fan[1])
            ends = start_point(arc), end_point(arc)
        canvas.add(layer, view.paper.scaled(arc))
        found.append((name, (view.paper.point(ends[0]), view.paper.point(ends[1]))))
    return found


def _teeth(canvas: Canvas, picture: MeshingPicture, view: View, tolerance: float) -> None:
    """Three teeth of each body in the main position, one at both ends of contact, and the working flanks."""
    for exact in picture.bodies:
        tooth, gap, active = (
            fitted(canvas, curves, view.paper.scale, tolerance) for curves in (exact.tooth, exact.gap, exact.active)
        )
        body = replace(exact, tooth=tooth, gap=gap, active=active)
        for layer, made in (
            ("TOOTH_START", body.tooth_at(picture.start)),
            ("TOOTH_END", body.tooth_at(picture.end)),
            ("OUTLINE", body.chain(picture.shown, TEETH)),
            ("ACTIVE_FLANK", body.active_at(picture.shown)),
        ):
            draw(canvas, layer, made, view.paper)


def _squares(canvas: Canvas, picture: MeshingPicture, view: View) -> None:
    """Squared paper about the pole, the line of centres and T-T; how far the axes are is for students to find."""
    pole, to, window, room = picture.on_line(picture.pole), view.paper.point, view.window, view.room
    at = to(pole)
    # both lines run between those of the squares
    canvas.squares_about(at, room, beside=0.5)
    canvas.line("CENTRE", to(complex(0, window.low)), to(complex(0, window.high)))
    canvas.line("TANGENT", to(complex(window.left, pole.imag)), to(complex(window.right, pole.imag)))
    _mark(canvas, at)


def _lines(canvas: Canvas, picture: MeshingPicture, view: View) -> None:
    """Line of centres, T-T, the theoretical and the active line of action, the spokes to N1 and N2."""
    window, to = view.window, view.paper.point
    canvas.line("CENTRE", to(complex(0, window.low)), to(complex(0, window.high)))
    for axis, way in _broken(picture, view).values():
        # a thin zigzag, then the axis on what is left of the line
        foot = axis - way * (BREAK - _AXIS)
        points = [foot + way * k + side for k, side in ((0.0, 0.0), (1.0, -2.0), (3.0, 2.0), (4.0, 0.0))]
        for start, end in pairwise(points):
            canvas.line("DIMENSION", start, end)
        canvas.line("CENTRE", points[-1], axis + way * _AXIS)
        _mark(canvas, axis)
    pole = picture.on_line(picture.pole)
    canvas.line("TANGENT", to(complex(window.left, pole.imag)), to(complex(window.right, pole.imag)))
    low, high = _clipped(picture, window)
    canvas.line("LINE_OF_ACTION", to(picture.on_line(low)), to(picture.on_line(high)))
    canvas.line("ACTIVE_LINE", to(picture.on_line(picture.start)), to(picture.on_line(picture.end)))
    for body, point in zip(picture.bodies, picture.tangent_points, strict=True):
        if body.centre is not None and point is not None and view.holds(body.centre) and view.holds(point):
            canvas.line("DIMENSION", to(body.centre), to(point))
    for point in _marks(picture):
        if view.holds(point):
            _mark(canvas, to(point))
    radius = _angle_radius(picture, view)
    phase = cmath.phase(picture.direction)
    canvas.add("DIMENSION", Arc(to(pole), radius, phase, math.pi - phase))


def _mark(canvas: Canvas, at: complex) -> None:
    """A point, on paper."""
    canvas.add("DIMENSION", Arc(at, 0.8, 0.0, 2 * math.pi))


def _broken(picture: MeshingPicture, view: View) -> dict[int, tuple[complex, complex]]:
    """Of the bodies whose axes lie beyond the window: where the axis stands on paper instead, and the way out."""
    found = {}
    below, above = view.beyond(picture)
    for bodies, edge, way in ((below, view.seen.low, -1j), (above, view.seen.high, 1j)):
        for k, body in enumerate(bodies, 1):
            found[body] = complex(view.paper.origin.real, edge) + way * (k * BREAK - _AXIS), way
    return found


def _angle_radius(picture: MeshingPicture, view: View) -> float:
    """Radius of the arc that shows alpha_w, mm on paper: outside of the active line where there is room."""
    most = view.paper.scale * -view.window.left * 0.85
    return min(max(1.35 * view.paper.scale * (picture.end - picture.pole), 14.0), most)


def _lineends_of(picture: MeshingPicture) -> tuple[float, float]:
    """Places s of N1 and N2; of a rack the end lies beyond the active line."""
    last = picture.tangent_points[1]
    if last is None:
        return 0.0, picture.end + 0.35 * (picture.end - picture.start)
    reach = ((last - picture.tangent_points[0]) / picture.direction).real
    return min(0.0, reach), max(picture.end if reach < 0 else reach, reach)


def _clipped(picture: MeshingPicture, window: Box) -> tuple[float, float]:
    """The part of the line of action between N1 and N2 (and the active line) that the window holds."""
    low, high = _lineends_of(picture)
    first, last = window.span(picture.tangent_points[0], picture.direction)
    return max(low, first), min(high, last)


def _marks(picture: MeshingPicture) -> list[complex]:
    points = [picture.on_line(s) for s in (picture.start, picture.end, picture.pole)]
    points += [p for p in picture.tangent_points if p is not None]
    points += [b.centre for b in picture.bodies if b.centre is not None]
    return points


def _dimensions(canvas: Canvas, picture: MeshingPicture, view: View) -> dict[str, complex]:
    """Arcs inside the bodies that carry d d' and p_w, with lines out to where these lie; the middle of each."""
    (first, second), inside, to = picture.bodies, _INSIDE / view.paper.scale, view.paper.point

    def within(body: Body) -> float:
        root = body.radii["root"]
        base = body.radii["base"] if view.shows(body, "base") else root
        radius = min(root, base) - inside
        # where the axis is broken right behind the base circle, before it
        return radius if view.crosses(body, radius) else (root + base) / 2

    found, mark, beyond = {}, picture.pitch, second.radii["root"] + inside
    if (radius := within(first)) > 0:
        found["arc"] = _dimension_arc(canvas, view, picture.arc_of_action, radius)
    if isinstance(mark, Line):
        ends = [(end, complex(end.real, beyond)) for end in (mark.start, mark.end)]
        for outer, inner in ends:
            canvas.line("DIMENSION", to(outer), to(inner))
        start, end = (to(inner) for _, inner in ends)
        canvas.line("DIMENSION", start, end)
        canvas.arrow("DIMENSION", start, -1)
        canvas.arrow("DIMENSION", end, 1)
        found["pitch"] = to((ends[0][1] + ends[1][1]) / 2)
    elif (radius := beyond if picture.kind == "internal" else within(second)) > 0:
        found["pitch"] = _dimension_arc(canvas, view, mark, radius)
    return found


def _dimension_arc(canvas: Canvas, view: View, arc: Arc, radius: float) -> complex:
    """An arc about the same centre with arrows at its ends; its middle on paper."""
    shown = Arc(arc.centre, radius, arc.start_angle, arc.sweep)
    canvas.add("DIMENSION", view.paper.scaled(shown))
    for t, sense in ((0.0, -1), (arc.sweep, 1)):
        inner, outer = complex(shown.point(t)), complex(arc.point(t))
        canvas.line("DIMENSION", view.paper.point(outer), view.paper.point(inner))
        canvas.arrow("DIMENSION", view.paper.point(inner), sense * complex(shown.tangent(t)))
    return view.paper.point(complex(shown.point(arc.sweep / 2)))


def _names(
    labels: Labeller, picture: MeshingPicture, view: View, dimensions: dict[str, complex], language: str
) -> None:
    """Names of points, arcs and angles."""
    to, window = view.paper.point, view.window
    pole = picture.on_line(picture.pole)
    arc = picture.arc_of_action
    labels.name("P", to(pole), prefer=1 + 0.3j)
    labels.name("a", to(picture.on_line(picture.start)), prefer=1 - 1j)
    labels.name("b", to(picture.on_line(picture.end)), prefer=-1 + 1j)
    labels.name("d", to(complex(arc.point(0.0))), prefer=1 - 1j)
    labels.name("d'", to(complex(arc.point(arc.sweep))), prefer=-1 - 1j)
    low, high = _clipped(picture, window)
    for index, point in enumerate(picture.tangent_points):
        if point is None:
            continue
        if view.holds(point):
            labels.name(f"N_{{{index + 1}}}", to(point))
        else:
            end = low if abs(picture.on_line(low) - point) < abs(picture.on_line(high) - point) else high
            labels.name(sheet_words(language, "towards", name=f"N_{{{index + 1}}}"), to(picture.on_line(end)))
    broken = _broken(picture, view)
    for index, body in enumerate(picture.bodies):
        if body.centre is not None:
            at = broken[index][0] if index in broken else to(body.centre)
            labels.name(f"O_{{{index + 1}}}", at, prefer=1 + 0j)
    phase = cmath.phase(picture.direction)
    middle = to(pole) + cmath.rect(_angle_radius(picture, view), (math.pi + phase) / 2)
    labels.name("α_{w}", middle, prefer=-1 + 0j)
    labels.name("T", to(complex(window.left, pole.imag)), prefer=-1 + 0j)
    labels.name("T", to(complex(window.right, pole.imag)), prefer=1 + 0j)
    if "arc" in dimensions:
        length = decimal(f"{abs(arc.sweep) * arc.radius:.3f}", language)
        labels.name(f"dd' = {length}", dimensions["arc"], prefer=-1j)
    if "pitch" in dimensions:
        length = decimal(f"{picture.working_pitch:.3f}", language)
        labels.name(f"p_{{w}} = {length}", dimensions["pitch"], prefer=1j)
