"""The working drawings of turned parts: rings in section, shafts from outside with the sections of their keyways."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from geometry.base.placement import Placement2
from geometry.base.record import replace
from geometry.curves.curve import Curve, end_point, start_point
from geometry.curves.line_arc import Arc, Line
from geometry.solids.hub_holes import HubHoles
from geometry.solids.keyways import depth_deviation
from geometry.solids.splines import SplineBore
from geometry.solids.turned import HalfSection, Hole, Piece, Pocket, Splined
from parts.base.part import Part
from parts.base.texts import MINUS
from parts.bodies.details import detailed
from parts.bodies.turned import ShaftSpec, Threaded, TurnedSpec, threaded
from parts.drawing.canvas import Box
from parts.drawing.directions import directions, spline_data, tip_zone
from parts.drawing.places import apart
from parts.drawing.revolved import Loop, below, block, closed, outer_of, outlined, seen_circles, seen_edges
from parts.drawing.turned_sizes import Fits, Own, SectionCorner, bores, listed_corners, seats, turned_sizes
from parts.drawing.wheel_views import (
    apart_sizes,
    axis_cross,
    bar,
    bore_note,
    circle_of,
    circle_size,
    hole_axes,
    hole_round,
    level,
    pitch_circle,
    section_sides,
    spline_sizes,
)
from parts.drawing.working import (
    AXIS,
    HIDDEN,
    THIN,
    TURNED,
    VISIBLE,
    Cut,
    Note,
    PartDrawing,
    Side,
    Size,
    Stroke,
    Subject,
    View,
    requirements,
)
from parts.keys.holes import hub_holes
from parts.keys.threads import thread_words

_SAME = 1e-9
# mm: where a thread ends, what is its diameter
_SMOOTH = 1e-6
# a section of a keyway is so high on paper at least, mm
_LEAST_SECTION = 20.0
# parts of a section's largest size: what is drawn too small in it, and how large its half is at most where that is
# enlarged; how far the circle about it reaches; how large the least of it is on paper then, and the whole at most, mm
_LEAST_DRAWN, _SHARE, _AROUND, _LEAST_ENLARGED, _MOST_ENLARGED = 1 / 60, 1 / 4, 1.15, 5.0, 60.0
# points along a side of a tooth for its hatching
_ALONG = 9
# part of a centre hole's size up to which the shaft about it is shown
_ABOUT = 1.5


def part_drawing(subject: Subject) -> PartDrawing:
    """A ring, or a hollow shaft, in section; a solid shaft as it is seen."""
    half = subject.part.thing
    assert isinstance(half, HalfSection)
    loop = _loop(subject.part)
    is_shaft, hollow, keys = subject.part.kind == "shaft", half.radii()[0] > 0, subject.part.keys
    holes = hub_holes(None, keys.holes, None) if isinstance(keys, TurnedSpec) else HubHoles()
    whole = _long_view(half, loop, holes, subject, is_shaft=is_shaft, cut=_is_cut(half, loop, is_shaft=is_shaft))
    if not is_shaft and hollow:
        found = [*_enlarged(half, whole, subject)]
    else:
        found = [whole] if whole.hatched else [*detailed(whole, half.heights(), subject.language)]
    if half.holes:
        found.append(_face(half, loop, holes, subject))
    if is_shaft and not hollow and (centre := _centre_hole(loop, subject)) is not None:
        found.append(centre)
    if half.pockets:
        found += _keyways(half, found[0].cuts, subject)
    bores = _spline_bores(subject)
    for cut, spline, bore in zip(found[0].cuts[len(_planes(half)) :], half.splines, bores, strict=True):
        found.append(_spline_section(half, spline, bore, f"{cut.letter}-{cut.letter}", subject))
    square = [c.letter for c in found[0].cuts if not all(p.round_ends or p.is_flat for p in _crossed(half, c.at))]
    more = [subject.words("square_keyways", letter=letter) for letter in square]
    more += [line for bore in bores for line in spline_data(bore, subject, is_shaft=True)]
    return PartDrawing(tuple(found), requirements(subject, *more, *directions(holes, subject, "")))


def _spline_bores(subject: Subject) -> list[SplineBore]:
    """What the splines of a shaft go into."""
    keys = subject.part.keys
    return [step.spline.bore() for step in keys.steps if step.spline] if isinstance(keys, ShaftSpec) else []


def _is_cut(half: HalfSection, loop: Loop, *, is_shaft: bool) -> bool:
    """Whether it is drawn in section: a solid shaft is not, nor what has nothing inside (GOST 2.305)."""
    is_outer = outer_of(loop)
    off_axis = (c for c in loop if max(start_point(c).imag, end_point(c).imag) > 0)
    return half.radii()[0] > 0 or not (is_shaft or (not half.holes and all(is_outer(c) for c in off_axis)))


def told_corners(part: Part) -> tuple[SectionCorner, ...]:
    """The corners that a table tells, of a solid shaft those from outside; none where they have sizes."""
    assert isinstance(part.thing, HalfSection)
    loop = _loop(part)
    cut, is_outer = _is_cut(part.thing, loop, is_shaft=part.kind == "shaft"), outer_of(loop)
    return listed_corners(loop, lambda curve: cut or is_outer(curve))


def _threads(part: Part) -> list[Threaded]:
    return [*threaded(part.keys)] if isinstance(part.keys, ShaftSpec) else []


def _loop(part: Part) -> Loop:
    """Half the section as it is drawn, with a corner where a thread ends amid a cylinder."""
    assert isinstance(part.thing, HalfSection)
    found, threads = list[Line | Arc](), _threads(part)
    for curve in map(_curve, part.thing.pieces):
        if isinstance(curve, Line) and abs(curve.start.imag - curve.end.imag) < _SAME:
            way, r = curve.end.real - curve.start.real, curve.start.imag
            low, high = sorted((curve.start.real, curve.end.real))
            ends = {z for one in threads if abs(2 * r - one.thread.diameter) < _SMOOTH for z in (one.low, one.high)}
            amid = sorted((z for z in ends if low + _SMOOTH < z < high - _SMOOTH), reverse=way < 0)
            found += [Line(a, b) for a, b in pairwise([curve.start, *(complex(z, r) for z in amid), curve.end])]
        else:
            found.append(curve)
    return tuple(found)


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


def _circled(half: HalfSection, holes: HubHoles) -> list[Hole]:
    """Holes that are told by the circle on which they stand."""
    alone = [centre for group in apart(holes) for centre in group.centres()]
    return [hole for hole in half.holes if all(abs(hole.centre - centre) > _SAME * 10 for centre in alone)]


class _Added(NamedTuple):
    """What holes or splines add to the view across the axis; nothing is hatched where they are ``drilled``."""

    strokes: list[Stroke]
    drilled: list[Loop]
    axes: list[Line]
    sizes: list[Size]


def _hole_circles(half: HalfSection, loop: Loop, holes: HubHoles) -> Iterator[_Added]:
    """The axial holes on each circle, where the plane of the section meets some."""
    low, high = half.heights()
    circled = _circled(half, holes)
    for radius in sorted({round(abs(hole.centre), 9) for hole in circled}):
        found = [hole for hole in circled if abs(abs(hole.centre) - radius) < _SAME * 10]
        centres = [hole.centre for hole in found]
        added = _Added([], [], [], [circle_size("holes", centres, low)])
        for way in section_sides(centres):
            for near, far in _walls(loop, found[0]):
                drill = closed([near.start, near.end, far.end, far.start])
                added.drilled.append(drill if way > 0 else below(drill))
                added.strokes.extend((VISIBLE, wall if way > 0 else wall.mirrored()) for wall in (near, far))
            added.axes.append(level((low, high), way * radius))
        yield added


def _spline_bars(bored: Iterable[tuple[Splined, SplineBore]], *, cut: bool) -> Iterator[_Added]:
    """Splined parts of a shaft: teeth are not cut along it (GOST 2.409)."""
    for spline, bore in bored:
        added = _Added([], [], [], [])
        for way in (1, -1):
            root, _, around = bar((spline.low, spline.high), *(way * radius for radius in spline.radii))
            added.strokes.append((VISIBLE if cut else THIN, root))
            added.drilled.append(around)
            if pitch := bore.joint.reference_radius:
                added.axes.append(level((spline.low, spline.high), way * pitch))
        yield added


def _pocket_sizes(half: HalfSection, low: float, corners: set[float]) -> Iterator[Size]:
    """Where along the axis keyways and flats begin, from the lower end on, and how long they are; those alike once.

    What ends at ``corners``, where a step does, is told from there.
    """
    alike = dict.fromkeys((round(p.low, 9), round(p.high, 9), p.is_flat) for p in half.pockets)
    for k, (first, last, is_flat) in enumerate(alike, 1):
        name, told = f"{'flat' if is_flat else 'keyway'}.{k}", {first, last} & corners
        if len(told) < 2:
            yield Size(f"{name}.length", complex(first), complex(last), "above")
        if not told:
            yield Size(f"{name}.at", complex(low), complex(first), "above")


def _long_view(half: HalfSection, loop: Loop, holes: HubHoles, subject: Subject, *, is_shaft: bool, cut: bool) -> View:
    """The view across the axis."""
    strokes: list[Stroke] = []
    is_outer = outer_of(loop)
    outer = [curve for curve in loop if cut or is_outer(curve)]
    inner = [curve for curve in loop if curve not in outer]
    listed = listed_corners(loop, lambda curve: curve not in inner)
    # hollow shafts are cut through their first keyway
    notched = [p for p in half.pockets if cut and not p.is_flat and abs(_across(half, p).real) < _SAME]
    lowered = [*notched, *(p for p in half.pockets if p.is_flat)]
    upper, lower = (_notched(half, outer, lowered, way) for way in (1j, -1j))
    for side in (upper, below(lower)):
        strokes += outlined(side)
    for pocket in notched:
        rim = math.copysign(math.sqrt(_radius(half, pocket) ** 2 - pocket.width**2 / 4), _across(half, pocket).imag)
        strokes.append((VISIBLE, Line(complex(pocket.low, rim), complex(pocket.high, rim))))
    for side in (inner, below(inner)):
        strokes += [(HIDDEN, curve) for _, curve in outlined(side)]
    for edge in (e for half_edge in seen_edges(loop, cut=cut) for e in (half_edge, half_edge.mirrored())):
        strokes += [(VISIBLE, left) for left in _left_by_flats(half, edge, cut=cut)]
    low, high = half.heights()
    axes = [Line(complex(low), complex(high))]
    wishes = subject.wishes
    bored = [*zip(half.splines, _spline_bores(subject), strict=True)]
    own = [Own(s.low, s.high, s.radii[1], tip_zone(bore.joint, wishes.shaft)) for s, bore in bored]
    threads = _threads(subject.part)
    own += [_designated(one, subject) for one in threads]
    strokes += _thread_lines(threads, (upper, below(lower)), cut=cut)
    fits = Fits(wishes.shaft, wishes.bore, own=tuple(own)) if is_shaft else Fits("", wishes.bore, wishes.tip)
    told = turned_sizes(loop, fits, subject.language, lambda curve: curve not in inner)
    # what a table has instead of diameters tells no thread
    sizes = [*told.sizes, *(_thread_size(one, k) for k, one in enumerate(own, 1) if listed and one.before != "Ø")]
    for pocket in half.pockets:
        if pocket not in notched:
            strokes += _seen_flat(half, pocket, cut=cut) if pocket.is_flat else _seen_slot(half, pocket, cut=cut)
    sizes += _pocket_sizes(half, low, {round(start_point(curve).real, 9) for curve in outer})
    drilled: list[Loop] = []
    for added in (*_hole_circles(half, loop, holes), *_spline_bars(bored, cut=cut)):
        strokes += added.strokes
        drilled += added.drilled
        axes += added.axes
        sizes += added.sizes
    hatched = (tuple(upper), below(lower), *map(tuple, drilled)) if cut else ()
    planes = [*_planes(half), *((spline.low + spline.high) / 2 for spline in half.splines)]
    cuts = tuple(Cut(at, subject.letter(k)) for k, at in enumerate(planes))
    # the first two tell from where on and which way round corners are counted
    numbers = (Note(corner.at, str(k)) for k, corner in enumerate(listed[:2], 1))
    rough = (*_rough(bores(loop, lambda curve: curve not in inner), loop, subject), *_rough_seats(loop, subject))
    notes = (*rough, *numbers)
    return View(tuple(strokes), hatched, tuple(axes), tuple(sizes), told.rounds, notes, cuts=cuts)


def _designated(one: Threaded, subject: Subject) -> Own:
    after = thread_words(one.thread, subject.say(one.thread.pitch))
    return Own(one.low, one.high, one.thread.diameter / 2, after, "M")


def _thread_size(one: Own, number: int) -> Size:
    at = (one.low + one.high) / 2
    ends = complex(at, -one.radius), complex(at, one.radius)
    return Size(f"thread.{number}", *ends, "left", one.before, one.after)


def _thread_lines(threads: Sequence[Threaded], halves: Sequence[Loop], *, cut: bool) -> Iterator[Stroke]:
    """Threads by GOST 2.311 (ISO 6410): a thin line at the minor diameter, a thick one where it ends on a cylinder."""
    for one in threads:
        root, tip = one.thread.minor_diameter / 2, one.thread.diameter / 2
        for way, loop in zip((1, -1), halves, strict=True):
            for a, b in _material_at(loop, way * root):
                if (low := max(a, one.low)) < (high := min(b, one.high)) - _SMOOTH:
                    yield THIN, Line(complex(low, way * root), complex(high, way * root))
            corners = [end_point(c) for c, after in pairwise([*loop, loop[0]]) if _goes_on(c, after)]
            for z in {p.real for p in corners if min(abs(p.real - one.low), abs(p.real - one.high)) < _SMOOTH}:
                yield VISIBLE, Line(complex(z, way * (root if cut else 0.0)), complex(z, way * tip))


def _goes_on(one: Line | Arc, other: Line | Arc) -> bool:
    """Whether a line along the axis goes on as another one."""
    return (
        isinstance(one, Line) and isinstance(other, Line) and abs(one.end - other.start) < _SAME
        and max(abs(p.imag - one.end.imag) for p in (one.start, other.end)) < _SAME
    )  # fmt: skip


def _enlarged(half: HalfSection, view: View, subject: Subject) -> Iterator[View]:
    """A section; where its lengths and radii are too small beside its diameters, those on its upper half, enlarged."""
    (low, high), (inner, outer) = half.heights(), half.radii()
    lengths = [s for s in view.sizes if s.side in ("above", "below") and s.value < high - low - _SAME]
    told = [*(one.value for one in lengths), *(one.value for one in view.rounds)]
    wide, size = max(2 * outer, high - low), max(high - low, outer - inner)
    if not told or size > _SHARE * wide or min(told) > _LEAST_DRAWN * wide:
        yield view
        return
    letter, middle = subject.letter(), complex(low + high, inner + outer) / 2
    about = circle_of(_AROUND * abs(complex(high, outer) - middle), middle)
    marked = Note(complex(about.point(math.pi / 4)), letter, is_letter=True)
    yield replace(
        view, strokes=(*view.strokes, (THIN, about)), notes=(*view.notes, marked), rounds=(),
        sizes=tuple(s for s in view.sizes if s not in lengths),
    )  # fmt: skip

    def above(curve: Curve) -> bool:
        return bool(curve.point(np.linspace(*curve.domain, 9)).imag.min() > inner - _SAME)

    # it stands beside the axis
    least, down = min(_MOST_ENLARGED, _LEAST_ENLARGED * size / min(told)), Placement2(0.0, complex(0.0, -middle.imag))
    yield View(
        tuple((layer, curve.placed(down)) for layer, curve in view.strokes if above(curve)),
        tuple(tuple(c.placed(down) for c in loop) for loop in view.hatched if all(above(c) for c in loop)),
        tuple(axis.placed(down) for axis in view.axes if above(axis)),
        tuple(_upward(size, down) for size in lengths),
        tuple(replace(one, centre=complex(down.apply(one.centre))) for one in view.rounds),
        title=letter, least=least,
    )  # fmt: skip


def _upward(size: Size, down: Placement2) -> Size:
    """A length on the upper half of a section, which is moved."""
    start, end = (complex(down.apply(complex(p.real, abs(p.imag)))) for p in (size.start, size.end))
    is_above = (size.side == "above") == (size.start.imag >= 0)
    return replace(size, start=start, end=end, side="above" if is_above else "below")


def _centre_hole(loop: Loop, subject: Subject) -> View | None:
    """The hole in the lower end of a solid shaft, in section; that in the other end is as this one."""
    middle = sum(start_point(c).real for c in loop) / len(loop)
    off_axis = [c for c in loop if max(start_point(c).imag, end_point(c).imag) > 0]
    is_outer = outer_of(loop)
    hole = [c for c in off_axis if not is_outer(c) and start_point(c).real < middle]
    if not hole:
        return None
    places = [p for c in hole for p in (start_point(c), end_point(c))]
    low, deep = min(p.real for p in places), max(p.real for p in places)
    mouth = max(p.imag for p in places)
    wide, far = _ABOUT * mouth, low + _ABOUT * (deep - low)
    rim = [complex(low, mouth), complex(low, wide), complex(far, wide), complex(far), complex(deep)]
    around = [Line(a, b) for a, b in pairwise(rim)]
    strokes: list[Stroke] = []
    for side in (hole, below(hole)):
        strokes += [(VISIBLE, curve) for curve in side]
    for way in (1, -1):
        lines = around if way > 0 else [line.mirrored() for line in around]
        strokes += [(VISIBLE, lines[0]), (THIN, lines[1]), (THIN, lines[2])]
    section = (*hole, *around)
    for edge in seen_edges(section, cut=True):
        strokes += [(VISIBLE, edge), (VISIBLE, edge.mirrored())]
    told = turned_sizes(section, Fits(), subject.language, lambda curve: curve in (*hole, around[0]))
    title = subject.words("centre_holes")
    return View(
        tuple(strokes), (section, below(section)), (Line(complex(low), complex(far)),), told.sizes, title=title,
        least=_LEAST_SECTION,
    )  # fmt: skip


def _rough(drilled: Sequence[Line], loop: Loop, subject: Subject) -> Iterator[Note]:
    """The sign of each bore, at its end that is nearer to an end of the part."""
    ends = [start_point(c).real for c in loop]
    words = subject.rough(subject.wishes.bore_roughness)
    for bore in drilled:
        low, high = sorted((bore.start.real, bore.end.real))
        first = (low, high) if max(ends) - high <= low - min(ends) + _SAME else (high, low)
        yield bore_note(first, -bore.start.imag, words)


def _rough_seats(loop: Loop, subject: Subject) -> Iterator[Note]:
    """The sign of each step of a shaft, where the export wishes one; a thread is no seat."""
    if (wished := subject.wishes.shaft_roughness) is None or subject.part.kind != "shaft":
        return
    threads = _threads(subject.part)

    def seated(curve: Line | Arc) -> bool:
        middle = (start_point(curve) + end_point(curve)) / 2
        return not any(one.low < middle.real < one.high for one in threads)

    for seat in seats(loop, seated):
        (start, way), words = (seat.start, seat.end - seat.start), subject.rough(wished)
        at, *others = ((start + share * way, 1j) for share in (0.5, 0.25, 0.75))
        also = (*others, *((point.conjugate(), -1j) for point, _ in (at, *others)))
        yield Note(at[0], words, is_rough=True, free=at[1], also=also)


def _walls(loop: Loop, hole: Hole) -> Iterator[tuple[Line, Line]]:
    """The walls of an axial hole in the section's plane, the nearer and the farther one, in each wall of the part."""
    sides = [
        [Line(complex(a, radius), complex(b, radius)) for a, b in _material_at(loop, radius)]
        for radius in (abs(hole.centre) - hole.radius, abs(hole.centre) + hole.radius)
    ]
    yield from zip(*sides, strict=False)


def _material_at(loop: Loop, radius: float) -> list[tuple[float, float]]:
    """From where to where along the axis there is material at a distance from it."""
    places = []
    for curve in loop:
        points = curve.point(np.linspace(*curve.domain, 2 if isinstance(curve, Line) else 65))
        for a, b in zip(points[:-1].tolist(), points[1:].tolist(), strict=True):
            if (a.imag > radius) != (b.imag > radius):
                places.append(a.real + (b.real - a.real) * (radius - a.imag) / (b.imag - a.imag))
    places.sort()
    return list(zip(places[::2], places[1::2], strict=True))


def _face(half: HalfSection, loop: Loop, holes: HubHoles, subject: Subject) -> View:
    """The view along the axis, with its holes."""
    inner, outer = half.radii()
    radii = {round(radius, 9) for radius in (outer, inner, *seen_circles(loop)) if radius > _SAME}
    strokes: list[Stroke] = [(VISIBLE, circle_of(radius)) for radius in sorted(radii, reverse=True)]
    strokes += [(VISIBLE, circle_of(hole.radius, hole.centre)) for hole in half.holes]
    axes, rounds, ringed = [*axis_cross(outer), *hole_axes(holes, 0.0)], [], _circled(half, holes)
    for pitch in sorted({round(abs(hole.centre), 9) for hole in ringed}):
        strokes.append((AXIS, circle_of(pitch)))
    equal: dict[tuple[float, float], list[Hole]] = {}
    for hole in sorted(half.holes, key=lambda hole: hole.radius):
        equal.setdefault((hole.radius, round(abs(hole.centre), 9) if hole in ringed else 0.0), []).append(hole)
    for number, ((radius, _), group) in enumerate(equal.items(), 1):
        rounds.append(hole_round(f"holes.{number}.diameter", [hole.centre for hole in group], radius, subject))
    return View(tuple(strokes), (), tuple(axes), apart_sizes(holes, 0.0, outer), tuple(rounds), from_right=True)


def _across(half: HalfSection, pocket: Pocket) -> complex:
    """The direction of a keyway in sections seen from the lower end: the reader's side on the right, up as it is."""
    # the first keyway looks at the reader in the long view; where that is cut, a quarter off it
    front = half.pockets[0].angle + (math.pi / 2 if half.radii()[0] > 0 else 0.0)
    return cmath.exp(1j * (front - pocket.angle))


def _cylinder(half: HalfSection, pocket: Pocket) -> tuple[float, float, float]:
    """Of what a keyway or a flat is in, a chamfer at its end left out: the radius, and from where to where, mm."""
    spans = [(p.start.real, *sorted((p.start.imag, p.end.imag))) for p in half.pieces
             if p.centre is None and abs(p.start.real - p.end.real) < _SAME]  # fmt: skip
    within = [(r, max(low, pocket.low), min(high, pocket.high)) for r, low, high in spans]
    return max(span for span in within if span[2] - span[1] > _SAME)


def _radius(half: HalfSection, pocket: Pocket) -> float:
    """Of the cylinder that a keyway is in, mm."""
    return _cylinder(half, pocket)[0]


def _notched(half: HalfSection, loop: Loop, pockets: Sequence[Pocket], way: complex) -> Loop:
    """A loop with the keyways that lie in its plane, and as far as flats leave it, which look to its side."""
    for pocket in pockets:
        lean = math.acos(max(-1.0, min(1.0, (_across(half, pocket) * way.conjugate()).real)))
        radius = _radius(half, pocket)
        if not pocket.is_flat and lean < _SAME**0.5:
            depth, inner = pocket.floor, [(pocket.low, pocket.floor), (pocket.high, pocket.floor)]
        elif pocket.is_flat and math.cos(lean) * radius > pocket.floor:
            depth, run = pocket.floor / math.cos(lean), half.run(pocket)
            places = [complex(min(max(p.imag, pocket.low), pocket.high), p.real)
                      for p in (run[0].start, *(piece.end for piece in run)) if p.real > depth]  # fmt: skip
            inner = [
                (p.real, pocket.floor * math.cos(lean) + pocket.half_width(p.imag) * math.sin(lean)) for p in places
            ]
        else:
            continue
        loop = _cut_away(loop, Box(pocket.low, depth, pocket.high, radius), [complex(*p) for p in inner])
    return loop


def _cut_away(loop: Loop, box: Box, inner: Sequence[complex]) -> Loop:
    """A loop whose lines in a box are replaced by lines along so many places, from left to right."""
    kept: list[Line | Arc | None] = []
    size = max(abs(box.right), abs(box.high))
    for curve in loop:
        first, last = _in_box(curve, box, _SAME * size) if isinstance(curve, Line) else (1.0, 0.0)
        if not isinstance(curve, Line) or last <= first:
            kept.append(curve)
            continue
        way = curve.end - curve.start
        before, after = curve.start + first * way, curve.start + last * way
        kept += [Line(curve.start, before)] if first * abs(way) > _SAME * size else []
        kept.append(None)
        kept += [Line(after, curve.end)] if (1 - last) * abs(way) > _SAME * size else []
    if None not in kept:
        return loop
    # from behind what is cut away round to it
    begin = max(k for k, one in enumerate(kept) if one is None and kept[(k + 1) % len(kept)] is not None) + 1
    left = [curve for curve in [*kept[begin:], *kept[:begin]] if curve is not None]
    start, end = end_point(left[-1]), start_point(left[0])
    places = [start, *(inner if start.real < end.real else inner[::-1]), end]
    return (*left, *(Line(a, b) for a, b in pairwise(places) if abs(b - a) > _SAME * size))


def _in_box(line: Line, box: Box, beside: float) -> tuple[float, float]:
    """From which share of a line to which it lies in a box or on its boundary."""
    way = line.end - line.start
    first, last = box.span(line.start, way, beside)
    low, high = max(first, 0.0), min(last, 1.0)
    return (low, high) if (high - low) * abs(way) > beside else (1.0, 0.0)


def _seen_flat(half: HalfSection, flat: Pocket, *, cut: bool) -> Iterator[Stroke]:
    """A flat in the long view, with the thin diagonals of what is plane (GOST 2.305); the outline shows it edge on."""
    way = _across(half, flat)
    is_seen = way.real > _SAME and not cut
    twins = (
        _across(half, p)
        for p in half.pockets
        if p.is_flat and (p.low, p.high, p.floor) == (flat.low, flat.high, flat.floor)
    )
    if abs(way.real) < _SAME or (
        not is_seen and not cut and any(abs(other - way.conjugate() * -1) < _SAME for other in twins)
    ):
        return

    def placed(point: complex, side: int) -> complex:
        return complex(point.real, way.imag * flat.floor + side * way.real * point.imag)

    layer, sides = VISIBLE if is_seen else HIDDEN, half.flat_side(flat)
    for side in (1, -1):
        for curve in sides:
            if isinstance(curve, Line):
                yield layer, Line(placed(curve.start, side), placed(curve.end, side))
                if is_seen:
                    yield THIN, Line(placed(curve.start, side), placed(curve.end, -side))
            else:
                yield layer, replace(curve, centre=placed(curve.centre, 1), across=side * way.real * curve.across)
    for end in (start_point(sides[0]), end_point(sides[-1])):
        if end.imag > _SAME:
            yield layer, Line(placed(end, 1), placed(end, -1))


def _left_by_flats(half: HalfSection, edge: Line, *, cut: bool) -> Iterator[Line]:
    """What flats leave of an edge across the axis."""
    spans = [tuple(sorted((edge.start.imag, edge.end.imag)))]
    for flat in half.pockets:
        way, at = _across(half, flat), edge.start.real
        if not flat.is_flat or not flat.low + _SAME < at < flat.high - _SAME or (cut and abs(way.imag) < _SAME):
            continue
        radius = max(p.real for piece in half.run(flat) for p in (piece.start, piece.end) if abs(p.imag - at) < _SAME)
        corners = sorted(way.imag * flat.floor + side * way.real * flat.half_width(radius) for side in (1, -1))
        if way.real < _SAME and abs(way.imag) > _SAME:
            corners = [corners[0], math.inf] if way.imag > 0 else [-math.inf, corners[1]]
        elif way.real < 0:
            continue
        gaps = [(-math.inf, corners[0]), (corners[1], math.inf)]
        spans = [(max(a, c), min(b, d)) for a, b in spans for c, d in gaps if min(b, d) - max(a, c) > _SAME]
    yield from (Line(complex(edge.start.real, a), complex(edge.start.real, b)) for a, b in spans)


def _seen_slot(half: HalfSection, pocket: Pocket, *, cut: bool) -> list[Stroke]:
    """A keyway in the long view: its floor and its rim, hidden where it looks away or stands before the cut."""
    way, radius = _across(half, pocket), _radius(half, pocket)
    layer = VISIBLE if way.real > _SAME and not cut else HIDDEN
    if abs(way.imag) < _SAME:
        return [(layer, curve) for curve in _slot(pocket)]
    if abs(way.real) < _SAME:
        floor, rim = way.imag * pocket.floor, way.imag * radius
        corners = [complex(pocket.low, rim), complex(pocket.low, floor), complex(pocket.high, floor)]
        return [(HIDDEN, Line(a, b)) for a, b in pairwise([*corners, complex(pocket.high, rim)])]
    plan = np.concatenate(
        [c.point(np.linspace(*c.domain, 2 if isinstance(c, Line) else 33))[:-1] for c in _slot(pocket)]
    )
    found: list[Stroke] = []
    for name, heights in ((layer, np.sqrt(radius**2 - plan.imag**2)), (HIDDEN, np.full(plan.size, pocket.floor))):
        points = plan.real + 1j * (way.imag * heights + way.real * plan.imag)
        found += [(name, line) for line in closed(points.tolist())]
    return found


def _slot(pocket: Pocket) -> tuple[Line | Arc, ...]:
    """A keyway as it is seen from above."""
    half = pocket.width / 2
    if not pocket.round_ends:
        return block(pocket.low, pocket.high, -half, half)
    low, high = complex(pocket.low + half), complex(pocket.high - half)
    return (
        Line(low - 1j * half, high - 1j * half),
        Arc(high, half, -math.pi / 2, math.pi),
        Line(high + 1j * half, low + 1j * half),
        Arc(low, half, math.pi / 2, math.pi),
    )


def _crossed(half: HalfSection, at: float) -> list[Pocket]:
    return [p for p in half.pockets if p.low < at < p.high]


def _planes(half: HalfSection) -> list[float]:
    """Where sections are drawn: through every keyway, through those beside each other at once."""
    found: list[float] = []
    for pocket in half.pockets:
        if not any(pocket.low < at < pocket.high for at in found):
            found.append(sum(_cylinder(half, pocket)[1:]) / 2)
    return found


def _keyways(half: HalfSection, cuts: Sequence[Cut], subject: Subject) -> Iterator[View]:
    """The sections through keyways, those that stand aslant there once more, turned."""
    for cut in cuts:
        here = _crossed(half, cut.at)
        told: list[Pocket] = []
        for pocket in here:
            if pocket in told:
                continue
            way = _across(half, pocket)
            aslant = cmath.phase(way) - math.pi / 2 * round(cmath.phase(way) / (math.pi / 2))
            turn = cmath.exp(-1j * aslant) if abs(aslant) > _SAME else 1.0 + 0j
            seen = [p for p in here if p not in told and _upright(turn * _across(half, p))]
            title = f"{cut.letter}-{cut.letter}"
            if turn != 1.0:
                angle = subject.say(abs(math.degrees(aslant)))
                title += f" {TURNED} {angle}°"
            yield _keyway(half, here, seen, turn, title, subject)
            told += seen


def _spline_section(half: HalfSection, spline: Splined, bore: SplineBore, title: str, subject: Subject) -> View:
    """A section through teeth, the first of them upright."""
    turn = Placement2(math.pi / 2)
    curves = [s.curve.placed(turn) for s in spline.form.outline(-spline.clearance).segments()]
    loop = list[Line | Arc]()
    for curve in curves:
        points = curve.point(np.linspace(*curve.domain, _ALONG)).tolist()
        loop += [curve] if isinstance(curve, Line | Arc) else [Line(a, b) for a, b in pairwise(points)]
    inner = half.radii()[0]
    hole = [circle_of(inner)] if inner > 0 else list[Arc]()
    sizes, rounds, note = spline_sizes(bore, subject, is_shaft=True)
    strokes = [(VISIBLE, curve) for curve in (*curves, *hole)] + pitch_circle(bore.joint.reference_radius)
    return View(
        tuple(strokes), (tuple(loop), *((c,) for c in hole)),
        axis_cross(spline.radii[1]), sizes, rounds, (note,), title, _LEAST_SECTION,
    )  # fmt: skip


def _upright(way: complex) -> bool:
    return min(abs(way.real), abs(way.imag)) < _SAME


_SIDES: dict[complex, tuple[Side, Side]] = {
    1: ("right", "below"), 1j: ("above", "right"), -1: ("left", "above"), -1j: ("below", "left"),
}  # fmt: skip


def _keyway(
    half: HalfSection, here: Sequence[Pocket], told: Sequence[Pocket], turn: complex, title: str, subject: Subject
) -> View:
    """A section through keyways, with the sizes of those that are told in it."""
    radius, inner = _radius(half, here[0]), half.radii()[0]
    pieces: list[tuple[float, list[complex]]] = []
    sizes: list[Size] = []
    for pocket in here:
        way, w = turn * _across(half, pocket), pocket.width / 2
        rim = math.sqrt(radius * radius - w * w)
        walls = [complex(rim, -w), complex(pocket.floor, -w), complex(pocket.floor, w), complex(rim, w)]
        if pocket.is_flat:
            walls = walls[1:3]
        if _upright(way):
            way = complex(round(way.real), round(way.imag))
        pieces.append((cmath.phase(way) % math.tau, [p * way for p in walls]))
        if pocket not in told:
            continue
        across, along = _SIDES[way]
        number = half.pockets.index(pocket) + 1
        facing = [p for p in here if abs(turn * _across(half, p) + way) < _SAME]
        if pocket.is_flat:
            # of two of them the distance, of one that to the other side
            if not any(p.is_flat and half.pockets.index(p) + 1 < number for p in facing):
                other = -(pocket.floor if any(p.is_flat for p in facing) else radius)
                sizes.append(Size(f"flat.{number}.size", way * other, way * pocket.floor, along))
            continue
        faced = bool(facing)
        limit = depth_deviation(2 * radius, pocket.width, radius - pocket.floor, in_shaft=True)
        depth = "" if limit is None else f" {'+' if faced else MINUS}{subject.say(limit)}"
        sizes += [
            Size(f"keyway.{number}.width", way * walls[0], way * walls[-1], across, "", subject.wishes.shaft_keyway),
            Size(f"keyway.{number}.height", way * radius * (1 if faced else -1), way * pocket.floor, along, "", depth),
        ]
    pieces.sort(key=lambda pair: pair[0])
    rims: list[Line | Arc] = []
    for k, (_, walls) in enumerate(pieces):
        rims += [Line(a, b) for a, b in pairwise(walls)]
        start, end = cmath.phase(walls[-1]), cmath.phase(pieces[(k + 1) % len(pieces)][1][0])
        rims.append(Arc(0j, radius, start, (end - start) % math.tau))
    bore = [circle_of(inner)] if inner > 0 else list[Arc]()
    thin = [arc for one in _threads(subject.part) if one.low < here[0].low < one.high
            for arc in _three_quarters(one.thread.minor_diameter / 2, [walls for _, walls in pieces])]  # fmt: skip
    return View(
        (*((VISIBLE, curve) for curve in (*rims, *bore)), *((THIN, arc) for arc in thin)),
        (tuple(rims), *((hole,) for hole in bore)),
        axis_cross(radius), tuple(sizes), (), (), title, _LEAST_SECTION,
    )  # fmt: skip


def _three_quarters(radius: float, cuts: Sequence[Sequence[complex]]) -> Iterator[Arc]:
    """A thread along its axis: three quarters of a circle, the gap about the first keyway, without what keyways cut."""
    begin = cmath.phase(sum(cuts[0])) + math.pi / 4
    gaps = [(0.0, 0.0), (1.5 * math.pi, math.tau)]
    for walls in cuts[1:]:
        half = math.asin(min(1.0, abs(walls[0] - walls[-1]) / 2 / radius))
        middle = (cmath.phase(sum(walls)) - begin) % math.tau
        if min(map(abs, walls)) < radius and middle < 1.5 * math.pi:
            gaps.append((middle - half, middle + half))
    for (_, low), (high, _) in pairwise(sorted(gaps)):
        if high > low:
            yield Arc(0j, radius, begin + low, high - low)
