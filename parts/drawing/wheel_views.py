"""Views of a wheel for its working drawing: axial section, face, bore; images of teeth after GOST 2.402.

Sections lie with the wheel's axis along x, its lower face at 0, in projection with the face: where that may be turned
a keyed bore stands with its first keyway upwards.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from geometry.base.placement import Placement2
from geometry.base.record import Record, replace
from geometry.curves.curve import start_point
from geometry.curves.line_arc import Arc, Line
from geometry.plane.profile import Label, Profile
from geometry.solids.bores import Bore, FlatBore, KeywayBore, PolygonBore, RoundBore
from geometry.solids.hub_holes import HubHoles
from geometry.solids.keyways import depth_deviation
from geometry.solids.splines import SplineBore, StraightJoint
from geometry.solids.wheel import Levels, WheelShape
from geometry.solids.windows import RoundHoles
from parts.drawing.cross_holes import cut_across, hole_angles, hole_sizes, opened, seen_in_bore, seen_within
from parts.drawing.extent import Sampled, crossings, farthest, reach, sampled, summits
from parts.drawing.places import apart, circled, place_sizes
from parts.drawing.revolved import Loop, below, block, closed, outlined, seen_edges
from parts.drawing.working import (
    AXIS,
    HIDDEN,
    THIN,
    TURNED,
    VISIBLE,
    Cut,
    Note,
    Round,
    Side,
    Size,
    Spot,
    Stroke,
    Subject,
    View,
    arc_angles,
)
from parts.texts.sheets import counted_words

# a view of a bore is so high on paper at least, mm
_LEAST_BORE = 25.0
_UP = math.pi / 2
# the name of the circle that is drawn as an axis is
PITCH = "pitch"
# mm, what is no length
_NONE = 1e-9
# mm within which a wall is an edge's own; the least turn of a corner that is seen, rad; digits of heights
_NEAR, _SMOOTH, _DIGITS = 1e-6, 1e-6, 6
# where along an edge a frame may point to it, parts of its length
_PARTS = (0.3, 0.5, 0.7, 0.15, 0.85)
# directions in which both sides of an outline are compared, rad; parts of what is equal
_SIDES, _EVEN = (-1.3, -0.7, -0.2, 0.3, 0.8, 1.4), 1e-6


class Crown(Record):
    """The rim of a worm wheel: distance of its worm's axis, radii of throat and root about that, mm."""

    distance: float
    throat: float
    root: float

    def top(self, side: Line, radius: float) -> list[Line | Arc]:
        """What stands in place of the rim's outer line, which runs in -x: the arc of a radius about the worm's axis."""
        middle = complex((side.start.real + side.end.real) / 2, self.distance)
        drop = self.distance - side.start.imag
        half = min(abs(side.start.real - side.end.real) / 2, math.sqrt(max((radius - drop) * (radius + drop), 0.0)))
        turn = math.asin(half / radius)
        arc = Arc(middle, radius, turn - _UP, -2 * turn)
        ends = complex(arc.point(0.0)), complex(arc.point(2 * turn))
        found: list[Line | Arc] = [Line(side.start, ends[0]), arc, Line(ends[1], side.end)]
        return [line for line in found if isinstance(line, Arc) or abs(line.end - line.start) > 1e-9]


class Groove(Record):
    """A groove turned into a rim: from z to z, down to a radius, mm."""

    low: float
    high: float
    radius: float


class Wheel(Record):
    """What the views of a wheel show, radii in mm.

    ``tip`` up and down from the axis, where it is not round; ``root`` and ``pitch``: of teeth on it, None: it has none;
    ``outline``: the exact one, None: it has another at each height; ``crown``: of a worm wheel; ``rounds``: circles
    about the axis that are shown, with their sizes; ``stands``: its face is drawn with the bore upright; ``runs``: its
    outside, which is round, is a working surface; ``grooves``: between rows of teeth;
    ``bevel``: of its outer edges, radially and along the axis, in place of chamfers; ``kept``: directions between which
    teeth stand where they do not all round, rad, the first turned upwards.
    """

    shape: WheelShape
    holes: HubHoles
    tip: tuple[float, float]
    outline: Profile | None
    root: float | None = None
    pitch: float | None = None
    crown: Crown | None = None
    rounds: tuple[Round, ...] = ()
    stands: bool = True
    runs: bool = False
    grooves: tuple[Groove, ...] = ()
    bevel: tuple[float, float] | None = None
    kept: tuple[tuple[float, float], ...] = ()

    def on_side(self, way: int) -> Wheel:
        """The same as its half above or below the axis has it: without teeth where it has none."""
        bare = self.kept and self.root is not None and self.tip[way < 0] <= self.root + _NONE
        return replace(self, root=None, pitch=None) if bare else self

    @property
    def reference(self) -> float | None:
        """Radius of its pitch line, which may be a circle that is shown with its size."""
        return self.pitch or next((one.radius for one in self.rounds if one.name == PITCH), None)

    @property
    def covered(self) -> tuple[bool, bool]:
        """Below and above: whether its hub is a flange over the ends of its teeth."""
        return self.shape.covered(max(self.tip))

    @property
    def sunk(self) -> tuple[Groove, ...]:
        """The grooves in which teeth stand: between flanges."""
        return tuple(g for g in self.grooves if self.root is not None and g.radius > self.root)

    def rows(self) -> list[tuple[float, float]]:
        """Between which its teeth stand along the axis, mm."""
        if self.sunk:
            return [(g.low, g.high) for g in self.sunk]
        edges = [0.0, *(z for g in self.grooves for z in (g.low, g.high)), self.shape.face_width]
        return list(zip(edges[::2], edges[1::2], strict=True))

    @property
    def turn(self) -> float:
        """By how much its face and its section are turned, rad: for its bore to stand upright, where it may."""
        if self.kept:
            return _UP - sum(self.kept[0]) / 2
        bore = self.holes.bore
        return _UP - bore.angle if self.stands and bore is not None and not isinstance(bore, RoundBore) else 0.0


def level(ends: tuple[float, float], height: float) -> Line:
    """A line along the axis at a height."""
    return Line(complex(ends[0], height), complex(ends[1], height))


def bar(ends: tuple[float, float], near: float, far: float) -> tuple[Line, Line, tuple[Line, ...]]:
    """What is drilled along a section: both walls, and the loop about it, which is not hatched."""
    return level(ends, near), level(ends, far), block(*ends, near, far)


def circle_of(radius: float, centre: complex = 0j) -> Arc:
    """A whole circle."""
    return Arc(centre, radius, 0.0, 2 * math.pi)


def axis_cross(radius: float) -> tuple[Line, Line]:
    """The two axes of a round view."""
    return Line(complex(-radius), complex(radius)), Line(-1j * radius, 1j * radius)


def bore_radii(bore: Bore | None) -> tuple[float, float]:
    """Distance of the bore's walls from the axis upwards and downwards, once it stands upright, mm."""
    match bore:
        case None:
            return 0.0, 0.0
        case KeywayBore():
            radius = bore.diameter / 2
            return radius + bore.depth, radius + bore.depth * (bore.keys == 2)
        case FlatBore():
            return bore.flat_distance, bore.diameter / 2 if bore.flats == 1 else bore.flat_distance
        case PolygonBore():
            return bore.across_flats / 2, bore.across_flats / 2
        case SplineBore():
            # teeth stand in the plane of the section, uncut (GOST 2.409)
            return bore.form.inner, bore.form.inner
        case _:
            return bore.reach, bore.reach


def bore_cut(bore: Bore | None, low: float, high: float, turn: float) -> tuple[tuple[float, float], list[Line]]:
    """A bore, turned (rad), in the upright plane through its axis: its walls up and down from there, edges behind it.

    Edges run from ``low`` to ``high``; one is seen where no wall stands before it.
    """
    upright = bore is None or isinstance(bore, RoundBore | SplineBore) or abs(bore.angle + turn - _UP) < _NONE
    if bore is None or upright:
        return bore_radii(bore), [*keyway_edges(bore, low, high)]
    profile = bore.profile().placed(Placement2(turn))
    walls = reach(profile, _UP), reach(profile, -_UP)
    return walls, [level((low, high), y) for y in _edges_behind(profile)]


def _edges_behind(profile: Profile) -> list[float]:
    """Heights of the corners behind the upright plane through the axis that no wall stands before."""
    outline, heights = sampled(profile), list[float]()
    curves = outline.curves
    for before, after in zip((curves[-1], *curves[:-1]), curves, strict=True):
        corner = start_point(after)
        ways = before.tangent(before.domain[1]), after.tangent(after.domain[0])
        if corner.real > _NONE and abs(complex(ways[1] - ways[0])) > _SMOOTH and _stands_free(outline, corner):
            heights.append(corner.imag)
    return heights


def _stands_free(outline: Sampled, at: complex) -> bool:
    """Whether no wall stands between the upright plane through the axis and a place behind it."""
    return not any(_NEAR < x < at.real - _NEAR for x in crossings(outline, 1j * at.imag, 1.0))


def _beyond(wheel: Wheel, way: int) -> list[float]:
    """Heights above or below the section of a rim that is not round at which edges behind it are seen, mm; none of
    teeth between their outermost edge and the section.
    """
    outline, tip = wheel.outline, wheel.tip[way < 0]
    if outline is None or wheel.stands or wheel.root is not None or wheel.grooves or wheel.bevel:
        return []
    tops = [at for s in outline.segments() for at in summits(s.curve, way * 1j) if at.real > -_NEAR]
    all_along = sampled(outline)
    heights = [way * y for y in _edges_behind(outline)] + [way * at.imag for at in tops if _stands_free(all_along, at)]
    toothed = any(s.label is Label.FLANK for s in outline.period)
    found = sorted({round(y, _DIGITS) for y in heights if y > tip + _NEAR})
    return found[-1:] if toothed else found


def _rim_behind(wheel: Wheel, way: int) -> list[Line]:
    """The lines of what is seen of a rim beyond its section, up or down."""
    if not (heights := _beyond(wheel, way)):
        return []
    shape, far = wheel.shape, heights[-1]
    low, high = complex(shape.chamfer_below), complex(shape.face_width - shape.chamfer_above)
    ends = [0j, 1j * (far - shape.chamfer_below), low + 1j * far, high + 1j * far,
            shape.face_width + 1j * (far - shape.chamfer_above), complex(shape.face_width)]  # fmt: skip
    ends[0], ends[-1] = (
        at + 1j * (wheel.tip[way < 0] - cut)
        for at, cut in zip((0j, complex(shape.face_width)), (shape.chamfer_below, shape.chamfer_above), strict=True)
    )
    lines = [Line(a, b) for a, b in pairwise(ends) if abs(b - a) > _NONE]
    lines += [Line(low + 1j * y, high + 1j * y) for y in heights[:-1]]
    return [line if way > 0 else line.mirrored() for line in lines]


def keyway_edges(bore: Bore | None, low: float, high: float) -> Iterator[Line]:
    """The edges between keyways and their bore, once it stands upright, from end to end of it, mm."""
    if isinstance(bore, KeywayBore):
        rim = math.sqrt((bore.diameter - bore.width) * (bore.diameter + bore.width)) / 2
        yield from (level((low, high), way * rim) for way in (1, -1)[: bore.keys])


class SplineCut(NamedTuple):
    """Of splines in a section: their teeth, which are not hatched, their roots, the lines of their reference circle."""

    teeth: tuple[Loop, ...] = ()
    roots: tuple[Line, ...] = ()
    axes: tuple[Line, ...] = ()


def spline_cut(bore: Bore | None, low: float, high: float, chamfers: tuple[float, float] = (0.0, 0.0)) -> SplineCut:
    """What a section from ``low`` to ``high`` has of a bore's splines; legs of ``chamfers`` at both ends, mm."""
    if not isinstance(bore, SplineBore):
        return SplineCut()
    under, over = chamfers
    tips, roots = (
        [complex(low, r + under), complex(low + under, r), complex(high - over, r), complex(high, r + over)]
        for r in (bore.form.inner, bore.reach)
    )
    tooth, root = closed([*tips, *roots[::-1]]), closed(roots)[:-1]
    axes = tuple(level((low, high), way * _beside_tips(bore)) for way in (1, -1) if _beside_tips(bore))
    return SplineCut((tooth, below(tooth)), (*root, *(line.mirrored() for line in root)), axes)


def _bore_chamfers(shape: WheelShape, at: Levels) -> tuple[float, float]:
    """Legs of the chamfers at the lower and the upper end of a bore: none where a recessed web ends it."""
    below, above = (
        cut if at.hub[side] != at.web[side] or at.web[side] == at.rim[side] else 0.0
        for side, cut in ((0, shape.chamfer_below), (1, shape.chamfer_above))
    )
    return below, above


def _half(wheel: Wheel, bore: float, outer: float, *, toothed: bool) -> list[complex]:
    """Corners of half a section, x + iy = height + i radius, from the bore upwards on the upper face and back."""
    shape, at = wheel.shape, wheel.shape.levels
    sides, chamfers = [], _bore_chamfers(shape, at)
    for side, cut in ((1, shape.chamfer_above), (0, shape.chamfer_below)):
        way = 1 if side else -1
        stepped, recessed = at.hub[side] != at.web[side], at.web[side] != at.rim[side]
        points: list[complex] = []
        inner = chamfers[side] if bore else 0.0
        points += [complex(at.hub[side] - way * inner, bore), complex(at.hub[side], bore + inner)]
        if stepped and shape.hub is not None:
            radius = shape.hub.diameter / 2
            points += [complex(at.hub[side], radius - cut), complex(at.hub[side] - way * cut, radius)]
            points += [complex(at.web[side], radius)]
        if recessed and shape.web is not None:
            radius = shape.web.rim_diameter / 2
            points += [complex(at.web[side], radius), complex(at.rim[side] - way * cut, radius)]
            points += [complex(at.rim[side], radius + cut)]
        deep, wide = (0.0, 0.0) if toothed or wheel.covered[side] else wheel.bevel or (cut, cut)
        # of a groove that runs out at this face
        top = next((g.radius for g in wheel.grooves if (g.low, g.high)[side] == at.rim[side]), outer)
        points += [complex(at.rim[side], top - deep), complex(at.rim[side] - way * wide, top)]
        sides.append(points)
    deep, wide = wheel.bevel or (0.0, 0.0)
    notches = [complex(z, r) for g in reversed(wheel.grooves)
               for z, r in ((g.high + wide, outer), (g.high, outer - deep), (g.high, g.radius),
                            (g.low, g.radius), (g.low, outer - deep), (g.low - wide, outer))
               if at.rim[0] < z < at.rim[1]]  # fmt: skip
    return [*sides[0], *notches, *sides[1][::-1]]


def _loops(wheel: Wheel, bore: float, tip: float) -> tuple[Loop, Loop, Loop]:
    """Half a section, what is hatched of it, and the root line of teeth, which are not."""
    loop, width, crown = closed(_half(wheel, bore, tip, toothed=False)), wheel.shape.face_width, wheel.crown
    if wheel.root is None:
        return loop, loop, ()
    if crown is None:
        lines = [level(row, wheel.root) for row in wheel.rows()]
        if wheel.sunk:
            cut = replace(wheel, grooves=tuple(replace(g, radius=wheel.root) for g in wheel.sunk))
            walls = [Line(complex(z, wheel.root), complex(z, g.radius))
                     for g in wheel.sunk for z in (g.low, g.high) if 0 < z < width]  # fmt: skip
            return loop, closed(_half(cut, bore, tip, toothed=False)), (*lines, *walls)
        solid = closed(_half(replace(wheel, bevel=None), bore, wheel.root, toothed=True))
        return loop, solid, tuple(lines)
    edge = crown.distance - math.sqrt((crown.root - width / 2) * (crown.root + width / 2))
    solid = closed(_half(wheel, bore, edge, toothed=True))
    tips, roots = (crown.top(Line(complex(width, y), 1j * y), r) for y, r in ((tip, crown.throat), (edge, crown.root)))
    return _topped(loop, tip, tips), _topped(solid, edge, roots), tuple(roots)


def _topped(loop: Loop, height: float, top: Loop) -> Loop:
    """A loop with other lines in place of the one at a height."""
    return tuple(
        piece for c in loop for piece in (top if isinstance(c, Line) and c.start.imag == c.end.imag == height else (c,))
    )


def section_view(wheel: Wheel, subject: Subject) -> View:
    """The axial section; holes and spokes are turned into its plane."""
    shape, holes, at = wheel.shape, wheel.holes, wheel.shape.levels
    strokes: list[Stroke] = []
    hatched: list[Loop] = []
    axes = [Line(complex(min(at.hub[0], 0.0)), complex(max(at.hub[1], shape.face_width)))]
    bores, edges = bore_cut(holes.bore, *at.hub, wheel.turn)
    spline = spline_cut(holes.bore, *at.hub, _bore_chamfers(shape, at))
    hatched += spline.teeth
    axes += spline.axes
    for bore, tip, way in zip(bores, wheel.tip, (1, -1), strict=True):

        def placed(loop: Loop, way: int = way) -> Loop:
            return loop if way > 0 else below(loop)

        half = wheel.on_side(way)
        loop, solid, root = _loops(half, bore, tip)
        hatched.append(tuple(placed(solid)))
        strokes += outlined(placed(loop))
        strokes += [(VISIBLE, line) for line in placed((*root, *seen_edges(loop, cut=True)))]
        strokes += [(VISIBLE, line) for line in _rim_behind(wheel, way)]
        if half.reference is not None:
            axes += [level(row, way * half.reference) for row in wheel.rows()]
        cut_holes(holes, wheel.turn, way, at.web, (strokes, hatched, axes))
    strokes += [(VISIBLE, edge) for edge in (*edges, *spline.roots)]
    across = cut_across(shape.hub, holes.bore, wheel.turn)
    strokes += [(VISIBLE, rim) for rim in seen_in_bore(shape.hub, wheel.turn, across)]
    strokes = opened(strokes, across)
    hatched += [hole.loop() for hole in across]
    axes += [hole.axis() for hole in across]
    sizes, notes = tuple(_section_sizes(wheel, subject)), _section_notes(wheel, subject, at, -bores[1])
    return View(
        tuple(strokes), tuple(map(tuple, hatched)), tuple(axes), sizes, tuple(_crown_rounds(wheel)), notes,
        rim=_rim_spots(wheel) if any(one.name == "tip_diameter" for one in sizes) else (), face=_face_spots(wheel),
    )  # fmt: skip


def _rim_spots(wheel: Wheel) -> tuple[Spot, ...]:
    """Places on the outer line above and below, between its chamfers and grooves."""
    rows, tip = wheel.rows(), wheel.tip[0]
    if (crown := wheel.crown) is not None:
        edge = Line(complex(wheel.shape.face_width, tip), 1j * tip)
        rows = [(c.end.real, c.start.real) for c in crown.top(edge, crown.throat) if isinstance(c, Line)]
    low, high = max(rows, key=lambda row: row[1] - row[0], default=(0.0, 0.0))
    return spots(complex(low, tip), complex(high, tip), 1j) if high > low else ()


def _face_spots(wheel: Wheel) -> tuple[Spot, ...]:
    """Places on the upper end face of the rim above and below the axis, between its inner edge and teeth or outside."""
    shape, bores = wheel.shape, bore_radii(wheel.holes.bore)
    if shape.hub is not None and wheel.covered[1]:
        end = shape.levels.hub[1]
        return spots(complex(end, shape.hub.diameter / 2), complex(end, max(bores)), 1 + 0j)
    inner = max(*bores, shape.hub.diameter / 2 if shape.hub else 0.0, shape.web.rim_diameter / 2 if shape.web else 0.0)
    outer = min(*wheel.tip, wheel.root or math.inf)
    return spots(complex(shape.face_width, outer), complex(shape.face_width, inner), 1 + 0j)


def spots(start: complex, end: complex, out: complex) -> tuple[Spot, ...]:
    """Places on a line of a section and its image below the axis, the best first, with the ways out of the material."""
    along = (start + part * (end - start) for part in _PARTS)
    return tuple(pair for at in along for pair in ((at, out), (at.conjugate(), out.conjugate())))


def cut_holes(
    holes: HubHoles, turn: float, way: int, ends: tuple[float, float],
    drawn: tuple[list[Stroke], list[Loop], list[Line]],
) -> None:  # fmt: skip
    """Holes and windows in a half of a section, between ``ends``: their strokes, loops not hatched, and axes."""
    strokes, hatched, axes = drawn
    for low, high, is_hole in _openings(holes, turn, way):
        *walls, loop = bar(ends, way * low, way * high)
        hatched.append(loop)
        strokes += [(VISIBLE, wall) for wall in walls]
        if is_hole:
            axes.append(level(ends, way * (low + high) / 2))


def circle_sizes(holes: HubHoles, turn: float, z: float) -> list[Size]:
    """The diameters of the circles on which holes stand."""
    return [circle_size(f"holes.{k}", _turned(group, turn), z) for k, group in enumerate(circled(holes), 1)]


def _crown_rounds(wheel: Wheel) -> Iterator[Round]:
    """The radius of a worm wheel's throat."""
    if (crown := wheel.crown) is not None:
        edge = Line(complex(wheel.shape.face_width, wheel.tip[0]), 1j * wheel.tip[0])
        arc = next(curve for curve in crown.top(edge, crown.throat) if isinstance(curve, Arc))
        yield Round("throat_radius", arc.centre, arc.radius, "R", is_radius=True, angles=arc_angles(arc), inward=True)


def section_sides(centres: Sequence[complex]) -> tuple[int, ...]:
    """In which halves of a section holes on one circle are shown: turned into its plane, one alone in its own half."""
    return (1, -1) if len(centres) > 1 else (1 if centres[0].imag > -_NONE else -1,)


def circle_size(name: str, centres: Sequence[complex], z: float) -> Size:
    """The diameter of the circle that holes stand on, of one alone how far it is from the axis."""
    radius = abs(centres[0])
    if len(centres) > 1:
        return Size(f"{name}.pitch_circle_diameter", complex(z, -radius), complex(z, radius), "left", "Ø")
    return Size(f"{name}.distance", complex(z), complex(z, section_sides(centres)[0] * radius), "left")


def _openings(holes: HubHoles, turn: float, way: int) -> list[tuple[float, float, bool]]:
    """Holes and windows as a half of the section shows them: nearest to and farthest from the axis, mm; if round."""
    found = [((g.pitch_circle_diameter - g.diameter) / 2, g.reach, True) for g in circled(holes)
             if way in section_sides(_turned(g, turn))]  # fmt: skip
    spokes = holes.spokes
    return found if spokes is None else [*found, (spokes.inner_diameter / 2, spokes.reach, False)]


def _section_sizes(wheel: Wheel, subject: Subject) -> list[Size]:
    shape, at, wishes = wheel.shape, wheel.shape.levels, subject.wishes
    width, bore, found = shape.face_width, wheel.holes.bore, list[Size]()

    def diameter(name: str, size: float, z: float, side: Side, fit: str = "") -> None:
        found.append(Size(name, complex(z, -size / 2), complex(z, size / 2), side, "Ø", fit))

    up, down = wheel.tip
    if up == down and (wheel.stands or wheel.outline is None):
        below, above = shape.chamfer_below, width - shape.chamfer_above
        diameter("tip_diameter", 2 * up, *((above, "right") if wheel.covered[0] else (below, "left")), wishes.tip)
    if (crown := wheel.crown) is not None:
        throat = crown.distance - crown.throat
        diameter("throat_diameter", 2 * throat, width / 2, "right")
        found.append(Size("throat_plane", 1j * up, complex(width / 2, throat), "above"))
    if shape.web is not None:
        diameter("web.rim_diameter", shape.web.rim_diameter, 0.0, "left")
        found.append(Size("web.thickness", complex(at.web[0], shape.web.rim_diameter / 2),
                          complex(at.web[1], shape.web.rim_diameter / 2), "above"))  # fmt: skip
        if at.web[0] > 0:
            inner = 1j * shape.web.rim_diameter / 2
            found.append(Size("web.below", inner, at.web[0] + inner, "above"))
    found += circle_sizes(wheel.holes, wheel.turn, at.web[0])
    if (spokes := wheel.holes.spokes) is not None:
        diameter("spokes.inner_diameter", spokes.inner_diameter, at.web[0], "left")
        diameter("spokes.outer_diameter", spokes.outer_diameter, at.web[0], "left")
    found += _hub_sizes(wheel, subject)
    if isinstance(bore, RoundBore):
        diameter("bore_diameter", bore.diameter, at.hub[1], "right", wishes.bore)
    foot = -1j * max([down, *_beyond(wheel, -1)])
    found.append(Size("face_width", foot, width + foot, "below", "", wishes.width))
    half = closed(_half(wheel, bore_radii(bore)[0], up, toothed=False))
    edges = [complex(z, up) for z in at.rim]
    if shape.hub is not None:
        edges = [complex(at.hub[k], shape.hub.diameter / 2) if wheel.covered[k] else edges[k] for k in (0, 1)]
    return found + _chamfer_sizes(shape, half, edges, subject)


def _hub_sizes(wheel: Wheel, subject: Subject) -> Iterator[Size]:
    """Of a hub its diameter where it has an edge, its length, the holes across it."""
    shape, at = wheel.shape, wheel.shape.levels
    if (hub := shape.hub) is None:
        return
    edge, (below, above) = hub.diameter / 2, at.stepped
    if below or above:
        z = at.hub[1] - shape.chamfer_above if above else at.hub[0] + shape.chamfer_below
        yield Size("hub.diameter", complex(z, -edge), complex(z, edge), "right" if above else "left", "Ø")
    if at.hub[1] > at.rim[1] or at.hub[0] < 0:
        yield Size("hub.length", complex(at.hub[0], -edge), complex(at.hub[1], -edge), "below")
    end = at.hub[hub.above >= hub.below]
    yield from hole_sizes(hub, cut_across(hub, wheel.holes.bore, wheel.turn), end, subject)
    # of a hub on one side alone its length and the face width tell the rest
    if at.hub[0] < 0 and at.hub[1] > at.rim[1]:
        yield Size("hub.below", complex(at.hub[0], -edge), -1j * wheel.tip[1], "below")


def _chamfer_sizes(shape: WheelShape, half: Sequence[Line], edges: Sequence[complex], subject: Subject) -> list[Size]:
    """The chamfers of ``half`` a section at its outer ``edges`` below and above, each with how many are like it."""
    found = []
    for name, cut, edge, way in (
        ("above", shape.chamfer_above, edges[1], -1), ("below", shape.chamfer_below, edges[0], 1),
    ):  # fmt: skip
        if cut and not (name == "below" and cut == shape.chamfer_above):
            ends = edge + way * cut, edge
            lines = [line.end - line.start for line in half]
            count = sum(abs(abs(d.real) - cut) + abs(abs(d.imag) - cut) < _NONE for d in lines)
            words = counted_words(subject.language, "chamfers_of", count)
            found.append(Size(f"face_chamfer.{name}", *ends, "above", words, "×45°"))
    return found


def _section_notes(wheel: Wheel, subject: Subject, at: Levels, wall: float) -> tuple[Note, ...]:
    """Signs of roughness of the teeth, or of the outside, and of the bore, whose wall stands at a height."""
    found = []
    if wheel.reference is not None and not wheel.sunk:
        width, free = wheel.shape.face_width, not wheel.covered[1]
        found.append(subject.worked(complex(width if free else width / 2, wheel.reference), goes_on=free))
    elif wheel.runs or (not wheel.stands and wheel.outline is not None):
        found.append(subject.worked(complex(0.7 * wheel.shape.face_width, wheel.tip[0])))
    if wheel.holes.bore is not None:
        found.append(bore_note(at.hub, wall, subject.rough(subject.wishes.bore_roughness)))
    return tuple(found)


def bore_note(ends: tuple[float, float], wall: float, words: str) -> Note:
    """The sign of a bore's wall in a section: at its upper end, or where there is more room; not from the material."""
    low, high = ends
    inside = complex((low + high) / 2, wall), complex(0.0, -wall)
    return Note(complex(high, wall), words, is_rough=True, free=1 + 0j, also=(inside, (complex(low, wall), -1 + 0j)))


def goes_on(section: View, length: float) -> View:
    """A section whose bore goes on beyond its upper face: what stood at the bore's end stands so much farther, mm."""
    return replace(section, notes=tuple(replace(note, at=note.at + length) for note in section.notes))


def exact_teeth(outline: Profile, count: int, turn: float, tip: float) -> list[Stroke]:
    """``count`` teeth about the upward direction of a profile that is turned, as they are; the tip circle elsewhere."""
    step = outline.pitch_angle
    # of two ranges that are as near to it the one before it, on any machine
    first = math.ceil((_UP - turn) / step - count / 2 - _NEAR)
    shown = range(first, first + count)
    found: list[Stroke] = []
    for k in shown:
        placement = Placement2(turn + step * k)
        found += [(VISIBLE, segment.curve.placed(placement)) for segment in outline.period]
    if count < outline.count:
        begin = turn + step * (shown.stop - 0.5)
        found.append((VISIBLE, Arc(0j, tip, begin, math.copysign(2 * math.pi, step) - step * count)))
    return found


def face_view(wheel: Wheel, subject: Subject) -> View:
    """The view along the axis: circles for teeth, as many as are wished exact; hub, bore, holes."""
    turn, tip = wheel.turn, max(wheel.tip)
    placement = Placement2(turn)
    strokes: list[Stroke] = []
    if wheel.covered[1]:
        strokes += [(HIDDEN, circle_of(tip))]
    elif wheel.outline is None:
        strokes += [(VISIBLE, circle_of(tip))]
    elif wheel.pitch is None or wheel.kept:
        strokes += [(VISIBLE, s.curve.placed(placement)) for s in wheel.outline.segments()]
    else:
        count = min(subject.wishes.teeth, wheel.outline.count)
        strokes += exact_teeth(wheel.outline, count, turn, tip) if count else [(VISIBLE, circle_of(tip))]
    if wheel.pitch is not None:
        strokes += [(AXIS, arc) for arc in pitch_arcs(wheel.pitch, wheel.kept, turn)]
    shape, at = wheel.shape, wheel.shape.levels
    if (hub := shape.hub) is not None:
        seen = at.hub[1] > at.web[1] or wheel.covered[0]
        # holes across it end there
        strokes += [(VISIBLE if seen else HIDDEN, circle_of(hub.diameter / 2))] if seen or hub.set_screws else []
    if shape.web is not None and at.web[1] < at.rim[1]:
        strokes.append((VISIBLE, circle_of(shape.web.rim_diameter / 2)))
    if wheel.outline is not None:
        marks = subject.part.section(0.0).region.marks
        strokes += [(THIN, s.curve.placed(placement)) for mark in marks for s in mark.segments()]
    holes = wheel.holes
    if isinstance(holes.bore, SplineBore):
        strokes += _spline_circles(holes.bore)
        holes = replace(holes, bore=None)
    for profile in holes.profiles():
        strokes += [(VISIBLE, s.curve.placed(placement)) for s in profile.segments()]
    strokes += [(AXIS, circle_of(group.pitch_circle_diameter / 2)) for group in circled(wheel.holes)]
    axes = (*_face_axes(wheel), *hole_axes(wheel.holes, turn))
    rounds = [*group_rounds(wheel.holes, turn, subject), *wheel.rounds]
    strokes += [(AXIS if one.name == PITCH else THIN, circle_of(one.radius)) for one in wheel.rounds]
    notes = []
    if (spokes := wheel.holes.spokes) is not None:
        text = subject.words("spokes_of", count=spokes.count, width=subject.say(spokes.width))
        if spokes.corner_radius:
            radius = subject.say(spokes.corner_radius)
            text += f", {subject.words('spoke_corners', radius=radius)}"
        at_spoke = cmath.rect((spokes.inner_diameter + spokes.outer_diameter) / 4, spokes.start + turn)
        notes.append(Note(at_spoke + 0.5j * spokes.width * cmath.exp(1j * (spokes.start + turn)), text))
    strokes += seen_within(shape.hub, wheel.holes.bore, turn)
    sizes, angles = apart_sizes(wheel.holes, turn, tip), tuple(hole_angles(shape.hub, turn, subject))
    return View(tuple(strokes), (), axes, sizes, tuple(rounds), tuple(notes), from_right=True, angles=angles)


def pitch_arcs(radius: float, kept: Sequence[tuple[float, float]], turn: float) -> list[Arc]:
    """A reference circle where teeth stand, ``kept`` from one direction to another, or all round."""
    return [Arc(0j, radius, low + turn, high - low) for low, high in kept] or [circle_of(radius)]


def _face_axes(wheel: Wheel) -> tuple[Line, Line]:
    """The axes of a face: from side to side of it, and of the circles about it that are shown."""
    hub = wheel.shape.hub
    rim = max(*wheel.tip, hub.diameter / 2 if hub is not None and any(wheel.covered) else 0.0)
    if (wheel.stands and not wheel.kept) or wheel.outline is None:
        return axis_cross(rim)
    least = max((one.radius for one in wheel.rounds), default=0.0)
    curves = [s.curve for s in wheel.outline.placed(Placement2(wheel.turn)).segments()]
    left, right, low, high = (max((farthest(curves, way) / way).real, least) for way in (-1, 1, -1j, 1j))
    return Line(complex(-left), complex(right)), Line(-1j * low, 1j * high)


def apart_sizes(holes: HubHoles, turn: float, outer: float) -> tuple[Size, ...]:
    """Of holes that are on no circle with others the distances from the axes."""
    return tuple(place_sizes((c for group in apart(holes) for c in _turned(group, turn)), complex(-outer, -outer)))


def _turned(group: RoundHoles, turn: float) -> list[complex]:
    """The centres of holes in a view that is turned."""
    return [centre * cmath.exp(1j * turn) for centre in group.centres()]


def hole_axes(holes: HubHoles, turn: float) -> tuple[Line, ...]:
    """Short axes of round holes, along the radius, or along both axes from which they are told."""
    alone = [(c, g.diameter / 2) for g in apart(holes) for c in _turned(g, turn)]
    return (
        *(axis_along(c, g.diameter / 2) for g in circled(holes) for c in _turned(g, turn)),
        *(Line(c - r * way, c + r * way) for c, r in alone for way in (1, 1j)),
    )


def axis_along(centre: complex, radius: float) -> Line:
    """The axis of a hole, along the radius to it."""
    way = centre / abs(centre) * radius
    return Line(centre - way, centre + way)


def group_rounds(holes: HubHoles, turn: float, subject: Subject) -> tuple[Round, ...]:
    """The diameters of groups of round holes, with how many there are."""
    equal = [(group.diameter, _turned(group, turn)) for group in circled(holes)]
    alone = dict[float, list[complex]]()
    for group in apart(holes):
        alone.setdefault(group.diameter, []).extend(_turned(group, turn))
    found = []
    for index, (diameter, centres) in enumerate((*equal, *alone.items()), 1):
        found.append(hole_round(f"holes.{index}.diameter", centres, diameter / 2, subject))
    return tuple(found)


def hole_round(
    name: str, centres: Sequence[complex], radius: float, subject: Subject, words: str = "holes_of"
) -> Round:
    """The diameter of equal holes, with how many there are, on the one that is farthest up and right."""
    best = max(centres, key=lambda c: c.real + c.imag)
    return Round(name, best, radius, f"{counted_words(subject.language, words, len(centres))}Ø")


def _depth_limit(bore: KeywayBore | FlatBore, subject: Subject) -> str:
    """The deviation of a bore with one keyway of the standards from its other side to the keyway's bottom."""
    if not isinstance(bore, KeywayBore) or bore.keys != 1:
        return ""
    found = depth_deviation(bore.diameter, bore.width, bore.depth, in_shaft=False)
    return "" if found is None else f" +{subject.say(found)}"


def bore_view(bore: Bore, subject: Subject, others: float | None = None, letter: int = 0) -> View:
    """The bore alone, upright, with the sizes of its keyway or flats.

    ``others``: by how much views beside it are turned, rad; None: as it is. ``letter``: which names it, 0 the first.
    """
    angle = _UP - bore.angle
    turn = Placement2(angle)
    strokes = [(VISIBLE, s.curve.placed(turn)) for s in bore.profile().segments()]
    up, down = bore_radii(bore)
    sizes, rounds = [], list[Round]()
    wishes = subject.wishes
    if isinstance(bore, KeywayBore | FlatBore):
        radius = bore.diameter / 2
        sizes += [Size("bore_diameter", -1j * radius, 1j * radius, "left", "Ø", wishes.bore),
                  Size("bore.height", -1j * down, 1j * up, "right", "", _depth_limit(bore, subject))]  # fmt: skip
        if isinstance(bore, KeywayBore):
            half, corner = bore.width / 2, bore.corner_radius
            sizes.append(Size("bore.width", complex(-half, up - corner), complex(half, up - corner), "above", "",
                              wishes.keyway))  # fmt: skip
            if corner:
                centre = complex(half - corner, up - corner)
                rounds.append(_corner(centre, corner, (45.0, 30.0, 60.0)))
    elif isinstance(bore, SplineBore):
        return _spline_view(bore, strokes, subject, others, letter)
    else:
        sizes.append(Size("bore.across_flats", -1j * down, 1j * up, "right", "", wishes.bore))
        rounded = max((curve for _, curve in strokes if isinstance(curve, Arc)), key=_leftmost, default=None)
        if rounded is not None:
            way = math.degrees(cmath.phase(rounded.centre))
            angles = tuple(way + turn for turn in (0.0, 15.0, -15.0, 30.0, -30.0))
            rounds.append(_corner(rounded.centre, rounded.radius, angles))
    name = _bore_title(angle, subject, others, letter)
    # axes end at its walls: words of sizes stand close to them
    half = bore.diameter / 2 if isinstance(bore, KeywayBore | FlatBore) else bore.reach
    axes = Line(complex(-half), complex(half)), Line(-1j * down, 1j * up)
    return View(tuple(strokes), (), axes, tuple(sizes), tuple(rounds), (), name, _LEAST_BORE)


def _bore_title(angle: float, subject: Subject, others: float | None, letter: int) -> str:
    """The letter of a view that is turned by an angle, rad, and by how much more than those beside it."""
    off = 0.0 if others is None else math.remainder(angle - others, math.tau)
    turned = f" {TURNED} {subject.say(abs(math.degrees(off)))}°" if abs(off) > _NONE else ""
    return subject.letter(letter) + turned


def _spline_view(bore: SplineBore, strokes: list[Stroke], subject: Subject, others: float | None, letter: int) -> View:
    """Slots, upright, with what tells them."""
    sizes, rounds, note = spline_sizes(bore, subject, is_shaft=False)
    strokes += pitch_circle(bore.joint.reference_radius)
    title = _bore_title(_UP - bore.angle, subject, others, letter)
    return View(tuple(strokes), (), axis_cross(bore.reach), sizes, rounds, (note,), title, _LEAST_BORE)


def pitch_circle(radius: float) -> list[Stroke]:
    """The reference circle of involute splines; nothing of straight ones."""
    return [(AXIS, circle_of(radius))] if radius else []


def _beside_tips(bore: SplineBore) -> float:
    """Radius of the reference circle, 0 where there is none, or where their tips are drawn over it."""
    return pitch if abs((pitch := bore.joint.reference_radius) - bore.form.inner) > _NEAR else 0.0


def _spline_circles(bore: SplineBore) -> list[Stroke]:
    """Splines seen along their axis: their tips, the roots thin, the reference circle (GOST 2.409)."""
    return [
        (VISIBLE, circle_of(bore.form.inner)),
        (THIN, circle_of(bore.reach)),
        *pitch_circle(_beside_tips(bore)),
    ]


def spline_sizes(
    bore: SplineBore, subject: Subject, *, is_shaft: bool
) -> tuple[tuple[Size, ...], tuple[Round, ...], Note]:
    """Of upright slots, or of the teeth of their shaft: width of straight ones, diameters, designation (GOST 2.409).

    The outer diameter of a shaft is told along it, and not once more (GOST 2.307).
    """
    joint, wishes = bore.joint, subject.wishes
    form, play = (joint.shaft(), -bore.clearance) if is_shaft else (bore.form, 0.0)
    straight = joint if isinstance(joint, StraightJoint) else None
    # a diameter is told where its circle is: at the teeth, or between them
    step, usual = 360 / joint.teeth, wishes.shaft if is_shaft else wishes.bore
    places = [90 + step * k for k in range(1, joint.teeth)]
    zones = {fit.symbol: fit.zone(is_shaft) for fit in joint.fits}
    inner, outer = (
        zones.get(symbol) or (usual if straight and straight.centring == name else "")
        for name, symbol in (("inner", "d"), ("outer", "D"))
    )
    rounds = (
        Round("spline.outer_diameter", 0j, form.outer + play, after=outer, angles=tuple(places)),
        Round("spline.inner_diameter", 0j, form.inner + play, after=inner, angles=tuple(p + step / 2 for p in places)),
    )
    side = form.flank.shifted(play).at((form.inner + form.outer) / 2 + play).conjugate() * 1j
    width = Size("spline.width", complex(-side.real, side.imag), side, "above", "", zones.get("b", ""))
    note = Note(side, subject.words(f"spline_{joint.standard}", name=joint.named(is_shaft=is_shaft)))
    return (width,) if straight else (), rounds[1:] if is_shaft else rounds, note


def _corner(centre: complex, radius: float, angles: tuple[float, ...]) -> Round:
    return Round("bore.corner_radius", centre, radius, "R", is_radius=True, angles=angles)


def ring_section(
    shape: WheelShape, radii: tuple[float, float, float], holes: HubHoles, subject: Subject, other: float | None = None
) -> View:
    """The axial section of a ring with holes in its rim, and with the chamfers of its shape.

    ``radii``: of the edge that is seen inside, of where the material of the plane begins, of the outside, mm;
    ``other``: of both edges below the axis, where it is another there.
    """
    outer, width, low, high = radii[2], shape.face_width, shape.chamfer_below, shape.chamfer_above

    def half(inner: float, under: float = low, over: float = high) -> tuple[Line, ...]:
        """From an ``inner`` edge with its chamfers outwards."""
        inside = [complex(0, inner + under), complex(under, inner), complex(width - over, inner)]
        outside = [complex(width, outer - high), complex(width - high, outer), complex(low, outer)]
        return closed([*inside, complex(width, inner + over), *outside, complex(0, outer - low)])

    strokes: list[Stroke] = []
    hatched: list[Loop] = []
    axes = [Line(0j, complex(width))]
    for way in (1, -1):
        seen, begins = radii[:2] if way > 0 or other is None else (other, other)
        loop = half(seen)
        solid = loop if seen == begins else half(begins, 0.0, 0.0)
        hatched.append(solid if way > 0 else below(solid))
        side = loop if way > 0 else below(loop)
        strokes += [*outlined(side), (VISIBLE, level((0.0, width), way * begins))]
        strokes += [(VISIBLE, edge if way > 0 else edge.mirrored()) for edge in seen_edges(loop, cut=True)]
        cut_holes(holes, 0.0, way, (0.0, width), (strokes, hatched, axes))
    wishes = subject.wishes
    sizes = [
        Size("outer_diameter", complex(low, -outer), complex(low, outer), "left", "Ø", wishes.tip),
        Size("face_width", complex(0, -outer), complex(width, -outer), "below", "", wishes.width),
    ]
    sizes += [
        *circle_sizes(holes, 0.0, 0.0),
        *_chamfer_sizes(shape, half(radii[0]), (1j * outer, width + 1j * outer), subject),
    ]
    return View(tuple(strokes), tuple(map(tuple, hatched)), tuple(axes), tuple(sizes))


def ring_face(outer: float, holes: HubHoles, subject: Subject) -> View:
    """The outside of a ring along its axis, with the holes in its rim."""
    face: list[Stroke] = [(VISIBLE, circle_of(outer))]
    for group in holes.round_holes:
        face += [(VISIBLE, circle_of(group.diameter / 2, centre)) for centre in group.centres()]
    face += [(AXIS, circle_of(group.pitch_circle_diameter / 2)) for group in circled(holes)]
    axes = (*axis_cross(outer), *hole_axes(holes, 0.0))
    return View(
        tuple(face), (), axes, apart_sizes(holes, 0.0, outer), group_rounds(holes, 0.0, subject), from_right=True
    )


def _leftmost(corner: Arc) -> float:
    """How far left and up the corner of a bore is: its size stands on the right."""
    return 0.1 * corner.centre.imag - corner.centre.real


def wheel_views(wheel: Wheel, subject: Subject, walls: Sequence[Profile] = ()) -> tuple[View, ...]:
    """Section, face, and the bore where it is not round; ``walls``: what else the section cuts."""
    section, face = section_view(wheel, subject), face_view(wheel, subject)
    if not (even := _is_even(wheel) and all(map(_both_alike, walls))):
        # a plane of no symmetry is marked (GOST 2.305)
        letter = subject.letter()
        section = replace(section, title=f"{letter}-{letter}", in_row=True)
        face = replace(face, cuts=(Cut(0.0, letter),))
    return with_bore((section, face), wheel.holes.bore, wheel.shape.levels.hub[1], subject, wheel.turn, int(not even))


def _is_even(wheel: Wheel) -> bool:
    """Whether both sides of the plane of its section are alike, but for bores and holes."""
    outline = wheel.outline
    if outline is None or wheel.stands or wheel.root is not None:
        return True
    return _both_alike(outline)


def _both_alike(outline: Profile) -> bool:
    """Whether an outline is as far from the axis on both sides of the upright plane."""
    sides = ((reach(outline, angle), reach(outline, math.pi - angle)) for angle in _SIDES)
    return all(abs(one - other) < _EVEN * one for one, other in sides)


def with_bore(
    views: tuple[View, ...], bore: Bore | None, end: float, subject: Subject, others: float | None = None,
    letter: int = 0,
) -> tuple[View, ...]:  # fmt: skip
    """Views, the first along the axis, and that of a bore which is not round, seen from beyond an ``end`` of the axis.

    ``others`` and ``letter``: as of ``bore_view``.
    """
    if bore is None or isinstance(bore, RoundBore):
        return views
    arrow = Note(complex(end), subject.letter(letter), looks=-1)
    along = replace(views[0], notes=(*views[0].notes, arrow))
    return along, *views[1:], bore_view(bore, subject, others, letter)
