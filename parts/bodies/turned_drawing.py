"""The working drawings of turned parts: rings in section, shafts from outside with the sections of their keyways."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator

import numpy as np

from geometry.curves.curve import end_point, start_point
from geometry.curves.line_arc import Arc, Line
from geometry.solids.turned import HalfSection, Hole, Piece, Pocket
from parts.drawing.revolved import Loop, below, closed, outlined, seen_edges
from parts.drawing.wheel_views import axis_cross, circle_of
from parts.drawing.working import (
    AXIS,
    HIDDEN,
    VISIBLE,
    Note,
    PartDrawing,
    Round,
    Side,
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
    fits = (subject.wishes.shaft, "") if is_shaft else (subject.wishes.tip, subject.wishes.bore)
    found = [_long_view(half, loop, subject, fits, cut=hollow or not is_shaft)]
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


def _long_view(half: HalfSection, loop: Loop, subject: Subject, fits: tuple[str, str], *, cut: bool) -> View:
    """The view across the axis."""
    strokes: list[Stroke] = []
    outer = {id(curve) for curve in loop if cut or _is_outer(loop, curve)}
    for side in (loop, below(loop)):
        shown = [curve for twin, curve in zip(loop, side if side is loop else reversed(side), strict=True)
                 if id(twin) in outer]  # fmt: skip
        strokes += outlined(shown)
        if not cut:
            inside = [c for twin, c in zip(loop, side if side is loop else reversed(side), strict=True)
                      if id(twin) not in outer]  # fmt: skip
            strokes += [(HIDDEN, curve) for _, curve in outlined(inside)]
    for edge in seen_edges(loop, cut=cut):
        strokes += [(VISIBLE, edge), (VISIBLE, edge.mirrored())]
    low, high = half.heights()
    axes = [Line(complex(low), complex(high))]
    sizes = [*_diameters(loop, fits, cut=cut), *_lengths(loop, low, high), *_chamfers(loop)]
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


def _is_outer(loop: Loop, curve: Line | Arc) -> bool:
    """Whether nothing lies farther from the axis than the middle of a curve."""
    middle = complex(curve.point(sum(curve.domain) / 2))
    for other in loop:
        points = other.point(np.linspace(*other.domain, 2 if isinstance(other, Line) else 65))
        for a, b in zip(points[:-1].tolist(), points[1:].tolist(), strict=True):
            if min(a.real, b.real) < middle.real < max(a.real, b.real):
                y = a.imag + (b.imag - a.imag) * (middle.real - a.real) / (b.real - a.real)
                if y > middle.imag + 1e-6 * abs(middle):
                    return False
    # a face is seen from outside where it reaches the outside
    return isinstance(curve, Arc) or abs(curve.start.real - curve.end.real) > _SAME or not _is_inner(loop, curve)


def _is_inner(loop: Loop, curve: Line | Arc) -> bool:
    """Whether a face ends in a place that something larger is over, on both sides of it: the end of a blind hole."""
    low, high = (min(start_point(c).real for c in loop), max(start_point(c).real for c in loop))
    return low + _SAME < start_point(curve).real < high - _SAME and curve is not loop[0] and _over(loop, curve)


def _over(loop: Loop, curve: Line | Arc) -> bool:
    x, top = start_point(curve).real, max(start_point(curve).imag, end_point(curve).imag)
    return any(
        isinstance(c, Line) and min(c.start.real, c.end.real) < x < max(c.start.real, c.end.real)
        and min(c.start.imag, c.end.imag) > top
        for c in loop
    )  # fmt: skip


def _diameters(loop: Loop, fits: tuple[str, str], *, cut: bool) -> Iterator[Size]:
    """The diameters of cylinders, each once: outer ones on the side to which they are nearer, inner on the right."""
    cylinders = [c for c in loop if isinstance(c, Line) and abs(c.start.imag - c.end.imag) < _SAME and c.start.imag > 0]
    if not cylinders:
        return
    ends = [x for c in loop for x in (start_point(c).real, end_point(c).real)]
    middle = (min(ends) + max(ends)) / 2
    outer = {id(c): _is_outer(loop, c) for c in cylinders}
    most = max(c.start.imag for c in cylinders)
    seen: set[tuple[float, bool]] = set()
    for c in cylinders:
        radius, is_outer = c.start.imag, outer[id(c)]
        if (key := (round(radius, 9), is_outer)) in seen:
            continue
        seen.add(key)
        x = (c.start.real + c.end.real) / 2
        side: Side = "left" if is_outer and x <= middle else "right"
        at = min(c.start.real, c.end.real) if side == "left" else max(c.start.real, c.end.real)
        fit = (fits[0] if fits[1] == "" or radius == most else "") if is_outer else fits[1]
        name = f"{'outer' if is_outer else 'inner'}_diameter.{len(seen)}"
        yield Size(name, complex(at, -radius), complex(at, radius), side, "Ø", fit)


def _lengths(loop: Loop, low: float, high: float) -> Iterator[Size]:
    """From the lower end to each face, and the whole length."""
    faces = dict[float, tuple[float, float]]()
    for c in loop:
        if isinstance(c, Line) and abs(c.start.real - c.end.real) < _SAME:
            x, top = c.start.real, max(c.start.imag, c.end.imag)
            faces[round(x, 9)] = x, max(top, faces.get(round(x, 9), (x, 0.0))[1])
    foot = next((top for x, top in faces.values() if abs(x - low) < _SAME), 0.0)
    for k, (x, top) in enumerate(sorted(v for v in faces.values() if low + _SAME < v[0] < high - _SAME), 1):
        yield Size(f"length.{k}", complex(low, -foot), complex(x, -top), "below")
    last = next((top for x, top in faces.values() if abs(x - high) < _SAME), 0.0)
    yield Size("length", complex(low, -foot), complex(high, -last), "below")


def _chamfers(loop: Loop) -> Iterator[Size]:
    """Chamfers of 45 degrees, those of one length once."""
    lengths = [abs(_end.imag - _start.imag) for _start, _end in map(_ends, loop)]
    whole, seen = max(lengths), set[float]()
    for curve in loop:
        start, end = _ends(curve)
        way = end - start
        slanted = isinstance(curve, Line) and abs(abs(way.real) - abs(way.imag)) < 1e-6 * abs(way)
        if slanted and abs(way.imag) < whole and round(abs(way.real), 9) not in seen:
            seen.add(round(abs(way.real), 9))
            yield Size(f"chamfer.{len(seen)}", start, end, "above", "", "×45°")


def _ends(curve: Line | Arc) -> tuple[complex, complex]:
    return start_point(curve), end_point(curve)


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
    lines: tuple[Line | Arc, ...] = (Line(complex(w, rim), complex(w, pocket.floor)), Line(complex(w, pocket.floor), complex(-w, pocket.floor)),
             Line(complex(-w, pocket.floor), complex(-w, rim)))  # fmt: skip
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
