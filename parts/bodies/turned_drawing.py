"""The working drawings of turned parts: rings in section, shafts from outside with the sections of their keyways."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from geometry.curves.curve import start_point
from geometry.curves.line_arc import Arc, Line
from geometry.solids.turned import HalfSection, Hole, Piece, Pocket
from parts.drawing.revolved import Loop, below, chamfers, closed, diameters, is_outer, lengths, outlined, seen_edges
from parts.drawing.wheel_views import axis_cross, circle_of
from parts.drawing.working import (
    AXIS,
    HIDDEN,
    VISIBLE,
    Note,
    PartDrawing,
    Round,
    Size,
    Stroke,
    Subject,
    View,
    requirements,
)
from parts.texts.sheets import sheet_words

_SAME = 1e-9
# a section of a keyway is so high on paper at least, mm
_LEAST_SECTION = 20.0
_LETTERS = "ABCDEFGHJK"


def part_drawing(subject: Subject) -> PartDrawing:
    """A ring, or a hollow shaft, in section; a solid shaft as it is seen."""
    half = subject.part.thing
    assert isinstance(half, HalfSection)
    loop = tuple(_curve(piece) for piece in half.pieces)
    is_shaft, hollow = subject.part.kind == "shaft", half.radii()[0] > 0
    found = [_long_view(half, loop, subject, is_shaft=is_shaft, cut=hollow or not is_shaft)]
    if half.holes:
        found.append(_face(half, subject))
    found += [_keyway(half, pocket, k, subject) for k, pocket in enumerate(half.pockets)]
    return PartDrawing(tuple(found), requirements(subject))


def _swapped(point: complex) -> complex:
    """r + iz as it is drawn, its axis along x."""
    return complex(point.imag, point.real)


def _curve(piece: Piece) -> Line | Arc:
    start, end = _swapped(piece.start), _swapped(piece.end)
    if piece.centre is None:
        return Line(start, end)
    centre, points = _swapped(piece.centre), piece.points()
    turns = np.diff(np.unwrap(np.angle(points.imag + 1j * points.real - centre)))
    return Arc(centre, piece.radius, cmath.phase(start - centre), float(turns.sum()))


def _long_view(half: HalfSection, loop: Loop, subject: Subject, *, is_shaft: bool, cut: bool) -> View:
    """The view across the axis."""
    strokes: list[Stroke] = []
    outer = [curve for curve in loop if cut or is_outer(loop, curve)]
    inner = [curve for curve in loop if curve not in outer]
    for side in (outer, below(outer)):
        strokes += outlined(side)
    for side in (inner, below(inner)):
        strokes += [(HIDDEN, curve) for _, curve in outlined(side)]
    for edge in seen_edges(loop, cut=cut):
        strokes += [(VISIBLE, edge), (VISIBLE, edge.mirrored())]
    low, high = half.heights()
    axes = [Line(complex(low), complex(high))]
    wishes = subject.wishes
    fits, largest = ((wishes.shaft, ""), None) if is_shaft else (("", wishes.bore), wishes.tip)
    sizes = [*diameters(loop, fits, largest), *lengths(loop), *chamfers(loop)]
    for k, pocket in enumerate(half.pockets, 1):
        strokes += _slot(pocket)
        # seen from above, where it lies in the middle
        ends = complex(pocket.low, 0), complex(pocket.high, 0)
        sizes.append(Size(f"keyway.{k}.length", *ends, "above"))
        sizes.append(Size(f"keyway.{k}.at", complex(low), ends[0], "above"))
    for radius in sorted({round(abs(hole.centre), 9) for hole in half.holes}):
        found = [hole for hole in half.holes if abs(abs(hole.centre) - radius) < _SAME * 10]
        for way in (1, -1):
            strokes += [(VISIBLE, line if way > 0 else line.mirrored()) for line in _walls(loop, found[0])]
            axes.append(Line(complex(low, way * radius), complex(high, way * radius)))
        sizes.append(Size("holes.pitch_circle_diameter", complex(low, -radius), complex(low, radius), "left", "Ø"))
    hatched = (tuple(loop), below(loop)) if cut else ()
    return View(tuple(strokes), hatched, tuple(axes), tuple(sizes), tuple(_fillets(loop)), _rough(loop, subject))


def _fillets(loop: Loop) -> Iterator[Round]:
    """Radii of arcs, each once."""
    seen = set[float]()
    for curve in loop:
        if isinstance(curve, Arc) and round(curve.radius, 9) not in seen:
            seen.add(round(curve.radius, 9))
            way = math.degrees(cmath.phase(complex(curve.point(abs(curve.sweep) / 2)) - curve.centre))
            spread = math.degrees(abs(curve.sweep)) / 2
            angles = tuple(way + share * spread for share in (0.0, 0.5, -0.5, 0.9, -0.9))
            yield Round(f"radius.{len(seen)}", curve.centre, curve.radius, "R", is_radius=True, angles=angles)


def _rough(loop: Loop, subject: Subject) -> tuple[Note, ...]:
    """The sign of the bore of a ring."""
    radii = [c.start for c in loop if isinstance(c, Line) and abs(c.start.imag - c.end.imag) < _SAME]
    inner = [p for p in radii if p.imag > 0]
    if not inner or min(start_point(c).imag for c in loop) <= 0:
        return ()
    least = min(inner, key=lambda p: p.imag)
    at = max(start_point(c).real for c in loop)
    words = f"Ra {subject.say(subject.wishes.bore_roughness)}"
    return (Note(complex(at, -least.imag), words, is_rough=True),) if abs(least.real - at) < 1 else ()


def _walls(loop: Loop, hole: Hole) -> Iterator[Line]:
    """The walls of an axial hole in the plane of the section."""
    for radius in (abs(hole.centre) - hole.radius, abs(hole.centre) + hole.radius):
        places = []
        for curve in loop:
            points = curve.point(np.linspace(*curve.domain, 2 if isinstance(curve, Line) else 65))
            for a, b in zip(points[:-1].tolist(), points[1:].tolist(), strict=True):
                if (a.imag > radius) != (b.imag > radius):
                    places.append(a.real + (b.real - a.real) * (radius - a.imag) / (b.imag - a.imag))
        if len(places) >= 2:
            yield Line(complex(min(places), radius), complex(max(places), radius))


def _face(half: HalfSection, subject: Subject) -> View:
    """The view along the axis, with its holes."""
    inner, outer = half.radii()
    strokes: list[Stroke] = [(VISIBLE, circle_of(outer))]
    strokes += [(VISIBLE, circle_of(inner))] if inner > 0 else []
    strokes += [(VISIBLE, circle_of(hole.radius, hole.centre)) for hole in half.holes]
    axes = [*axis_cross(outer)]
    rounds = []
    for pitch in sorted({round(abs(hole.centre), 9) for hole in half.holes}):
        strokes.append((AXIS, circle_of(pitch)))
    for number, radius in enumerate(sorted({hole.radius for hole in half.holes}), 1):
        group = [hole for hole in half.holes if hole.radius == radius]
        best = max(group, key=lambda hole: hole.centre.real + hole.centre.imag)
        words = sheet_words(subject.language, "holes_of", count=len(group)) if len(group) > 1 else ""
        rounds.append(Round(f"holes.{number}.diameter", best.centre, radius, f"{words}Ø"))
    return View(tuple(strokes), (), tuple(axes), (), tuple(rounds))


def _slot(pocket: Pocket) -> list[Stroke]:
    """A keyway as it is seen from above."""
    half = pocket.width / 2
    if not pocket.round_ends:
        corners = [complex(x, y) for x, y in ((pocket.low, -half), (pocket.high, -half), (pocket.high, half),
                                              (pocket.low, half))]  # fmt: skip
        return [(VISIBLE, line) for line in closed(corners)]
    low, high = complex(pocket.low + half), complex(pocket.high - half)
    return [
        (VISIBLE, Line(low - 1j * half, high - 1j * half)),
        (VISIBLE, Arc(high, half, -math.pi / 2, math.pi)),
        (VISIBLE, Line(high + 1j * half, low + 1j * half)),
        (VISIBLE, Arc(low, half, math.pi / 2, math.pi)),
    ]


def _keyway(half: HalfSection, pocket: Pocket, number: int, subject: Subject) -> View:
    """The section across a keyway, which stands upwards."""
    middle = (pocket.low + pocket.high) / 2
    radius = max(p.start.real for p in half.pieces
                 if p.centre is None and abs(p.start.real - p.end.real) < _SAME
                 and min(p.start.imag, p.end.imag) <= middle <= max(p.start.imag, p.end.imag))  # fmt: skip
    w, inner = pocket.width / 2, half.radii()[0]
    rim = math.sqrt(radius * radius - w * w)
    turn = cmath.phase(complex(w, rim))
    around = Arc(0j, radius, math.pi - turn, math.pi + 2 * turn)
    walls = [complex(w, rim), complex(w, pocket.floor), complex(-w, pocket.floor), complex(-w, rim)]
    lines: list[Line | Arc] = [Line(a, b) for a, b in pairwise(walls)]
    bore = [circle_of(inner)] if inner > 0 else list[Arc]()
    sizes = (
        Size(f"keyway.{number + 1}.width", complex(-w, rim), complex(w, rim), "above", "", subject.wishes.shaft_keyway),
        Size(f"keyway.{number + 1}.height", -1j * radius, 1j * pocket.floor, "right"),
    )
    letter = _LETTERS[number % len(_LETTERS)]
    shown: tuple[Line | Arc, ...] = (*lines, around, *bore)
    return View(
        tuple((VISIBLE, curve) for curve in shown),
        ((*lines, around), *((hole,) for hole in bore)), axis_cross(radius), sizes, (), (),
        f"{letter}-{letter}", _LEAST_SECTION,
    )  # fmt: skip
