"""Solids turned about the z axis from half a section: planes, cylinders, cones, spheres and tori, all exact.

A section is complex, r + iz, counter-clockwise. Round holes run through it along the axis; pockets for keys are sunk
into its cylinders.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Sequence
from functools import lru_cache, partial

import numpy as np

from geometry.approximation.outline import spline_outline
from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.placement import Placement2
from geometry.base.record import Draft, Record, field, replace
from geometry.curves.curve import Complex, Real
from geometry.curves.hyperbola import Hyperbola
from geometry.curves.line_arc import Line
from geometry.plane.profile import Profile
from geometry.solids.bores import FlatBore
from geometry.solids.faced import FacedBody, FacedSolid, exact_body
from geometry.solids.faces import (
    Circular,
    Cone,
    Cylinder,
    Faces,
    Frame,
    Index,
    Loop,
    Plane,
    Sphere,
    Spline,
    Straight,
    Surface,
    Torus,
    Use,
    loop_of,
    turned_over,
)  # fmt: skip
from geometry.solids.rims import NEAR, RIM_DEGREE, fitted, rim_across
from geometry.solids.rings import UP, Ring, RingBuilder
from geometry.solids.splines import SplineForm, involute_walls

# what is one place, part of the size; samples of an arc where boundaries are held against each other
_SAME, _SAMPLES = 1e-9, 33


class Corner(Record):
    """A corner of half a section, r + iz, mm.

    ``arc``: radius of the arc to the next corner, above 0 out of the material, below 0 into it, 0: a line;
    ``chamfer``: length of both legs, ``fillet``: radius, of which one is 0.
    """

    at: complex
    arc: float = 0.0
    chamfer: float = 0.0
    fillet: float = 0.0


class Piece(Record):
    """A line, or an arc about a ``centre``; ``convex``: it bulges out of the material."""

    start: complex
    end: complex
    centre: complex | None = None
    convex: bool = True

    @property
    def radius(self) -> float:
        """Of the arc, mm."""
        return 0.0 if self.centre is None else abs(self.start - self.centre)

    @property
    def on_axis(self) -> bool:
        """Whether it sweeps nothing."""
        return self.centre is None and self.start.real == self.end.real == 0

    @property
    def is_slanted(self) -> bool:
        """Whether it sweeps a cone."""
        way = self.end - self.start
        return self.centre is None and way.real != 0 != way.imag

    @property
    def is_cylinder(self) -> bool:
        """Whether it sweeps a cylinder that looks away from the axis."""
        return self.centre is None and self.start.real == self.end.real and self.start.imag < self.end.imag

    def points(self, chord: float = 0.0) -> Complex:
        """Along it, (k,); ``chord``: what chords leave of an arc at most, mm, 0: in so many steps for all."""
        if self.centre is None:
            return np.array([self.start, self.end])
        sweep = np.angle((self.end - self.centre) / (self.start - self.centre))
        way = 1 if self.convex else -1
        whole, count = way * (float(sweep) * way % (2 * math.pi)), _SAMPLES
        if chord:
            count = math.ceil(abs(whole) / math.acos(max(1 - chord / self.radius, 0.0)) / 2) + 2
        found = self.centre + (self.start - self.centre) * np.exp(1j * whole * np.linspace(0, 1, count))
        found[-1] = self.end
        return np.asarray(found)


class Hole(Record):
    """A round hole along the axis, mm."""

    centre: complex
    radius: float


class Pocket(Record):
    """A keyway in a cylinder from ``low`` to ``high``: its width, the distance of its floor from the axis, mm.

    ``angle``: of its middle, rad; ``round_ends``: as an end mill leaves them. A flat is a floor as wide as its chord,
    which may run through a chamfer to the plane face at either end of its cylinder.
    """

    low: float
    high: float
    width: float
    floor: float
    angle: float
    round_ends: bool = True
    is_flat: bool = False

    def half_width(self, radius: float) -> float:
        """Half of a flat's chord in a circle about the axis, mm; 0 of one that it only touches."""
        square = radius**2 - self.floor**2
        return math.sqrt(square) if square > _SAME * radius**2 else 0.0


class Splined(Record):
    """Teeth in place of a cylinder from ``low`` to ``high``, ``clearance`` within their form, mm.

    ``angle``: of the middle of a tooth, rad.
    """

    low: float
    high: float
    form: SplineForm
    clearance: float = 0.0
    angle: float = 0.0

    @property
    def radii(self) -> tuple[float, float]:
        """Of the circles at their roots and tips, mm."""
        return self.form.inner - self.clearance, self.form.outer - self.clearance

    def outline(self, offset: float = 0.0) -> Profile:
        """Their counter-clockwise boundary, moved ``offset`` mm outwards; OffsetError where none is left."""
        return self.form.outline(offset - self.clearance).placed(Placement2(self.angle))


class HalfSection(Record):
    """The pieces of a half section, and what is cut out of the turned solid."""

    pieces: tuple[Piece, ...]
    holes: tuple[Hole, ...] = ()
    pockets: tuple[Pocket, ...] = ()
    splines: tuple[Splined, ...] = ()

    @property
    def is_round(self) -> bool:
        """Whether all of it but its holes is turned."""
        return not (self.pockets or self.splines)

    def chords(self, chord: float) -> Complex:
        """The half section by chords at most so many mm off its arcs, counter-clockwise, r + iz."""
        found = np.concatenate([piece.points(chord)[:-1] for piece in self.pieces])
        # what ends on the axis lies on it
        return np.maximum(found.real, 0.0) + 1j * found.imag

    def seen_spline(self) -> Splined | None:
        """The spline that is seen along the axis, all else being within its roots."""
        places = np.concatenate([p.points() for p in self.pieces])
        for spline in self.splines:
            inner, outer = spline.radii
            own = (places.real == outer) & (spline.low <= places.imag) & (places.imag <= spline.high)
            if (places[~own].real <= inner).all():
                return spline
        return None

    def run(self, flat: Pocket) -> tuple[Piece, ...]:
        """What a flat cuts: its cylinder, and before and after that the cone of a chamfer that it reaches."""
        pieces = self.pieces
        k = next(k for k, p in enumerate(pieces) if p.is_cylinder and flat.floor < p.start.real
                 and max(p.start.imag, flat.low) < min(p.end.imag, flat.high))  # fmt: skip
        before, own, after = (pieces[j % len(pieces)] for j in (k - 1, k, k + 1))
        first = (before,) if flat.low <= own.start.imag and before.is_slanted else ()
        last = (after,) if flat.high >= own.end.imag and after.is_slanted else ()
        return *first, own, *last

    def flat_side(self, flat: Pocket) -> tuple[Line | Hyperbola, ...]:
        """A side of a flat from its lower to its upper end, as seen from above it, z + iy."""
        found: list[Line | Hyperbola] = []
        for piece in self.run(flat):
            low, high = (flat.half_width(p.real) for p in (piece.start, piece.end))
            if piece.is_slanted:
                found.append(_hyperbola(flat, piece, low, high))
            else:
                ends = max(flat.low, piece.start.imag), min(flat.high, piece.end.imag)
                found.append(Line(complex(ends[0], low), complex(ends[1], high)))
        return tuple(found)

    def seen_flat(self) -> FlatBore | None:
        """What flats leave of the greatest circle as it is seen along the axis; None where something stands beyond."""
        lines = np.concatenate([np.column_stack([(p := piece.points())[:-1], p[1:]]) for piece in self.pieces])
        levels = np.unique([*lines.imag.ravel(), *(z for p in self.pockets for z in (p.low, p.high))])
        (first, last), outer = np.sort(lines.imag).T, self.radii()[1]
        for one in (p for p in self.pockets if p.is_flat and math.hypot(p.floor, p.width / 2) > outer * (1 - _SAME)):
            sides = [p.angle for p in self.pockets if p.is_flat and p.low == one.low]

            def is_cut(z: float, floor: float, angle: float) -> bool:
                return any(
                    p.low < z < p.high and p.floor <= floor and math.cos(p.angle - angle) > 1 - _SAME
                    for p in self.pockets if p.is_flat
                )  # fmt: skip

            beyond = lines.real.max(axis=1) > one.floor
            middles = [float(z) for z in (levels[1:] + levels[:-1]) / 2 if np.any(beyond & (first < z) & (z < last))]
            if all(is_cut(z, one.floor, angle) for z in middles for angle in sides):
                return FlatBore(2 * outer, one.floor, len(sides), one.angle)
        return None

    def radii(self) -> tuple[float, float]:
        """Nearest to the axis, and farthest from it, mm."""
        r = np.concatenate([p.points().real for p in self.pieces])
        return float(r.min()), float(r.max())

    def heights(self) -> tuple[float, float]:
        """The lowest and the highest, mm."""
        z = np.concatenate([p.points().imag for p in self.pieces])
        return float(z.min()), float(z.max())

    @property
    def is_ball(self) -> bool:
        """Whether it is a sphere."""
        first, *others = [piece for piece in self.pieces if not piece.on_axis]
        return (
            first.centre is not None and abs(first.centre.real) < _SAME and self.is_round and not self.holes
            and all(p.centre is not None and abs(p.centre - first.centre) + abs(p.radius - first.radius) < _SAME
                    for p in others)
        )  # fmt: skip


def half_section(corners: Sequence[Corner]) -> tuple[Piece, ...]:
    """The pieces between corners in either order, each corner with its chamfer or fillet.

    Raises
    ------
    ParameterError
        ``points[k]``: what they enclose is no half section.
    """
    corners = list(corners)
    size, turned = len(corners), _signed(corners) < 0
    turned = turned or (size == 2 and corners[0].at.imag > corners[1].at.imag)
    numbers = list(range(size, 0, -1) if turned else range(1, size + 1))
    if turned:
        # an arc goes from the later corner to the earlier one
        corners = [replace(corners[-1 - k], arc=corners[(-2 - k) % size].arc) for k in range(size)]
    owners = [numbers[(k + 1) % size] if turned else numbers[k] for k in range(size)]
    edges = [_edge(one, corners[(k + 1) % size], owners[k]) for k, one in enumerate(corners)]
    found: list[Piece] = []
    cuts = [_cut(edges[k - 1], edges[k], corner, numbers[k]) for k, corner in enumerate(corners)]
    for k, edge in enumerate(edges):
        (_, begin, cut), (end, _, _) = cuts[k], cuts[(k + 1) % len(cuts)]
        if cut is not None:
            found.append(cut)
        if edge.centre is None:
            way = edge.end - edge.start
            left = ((end - begin) * way.conjugate()).real / abs(way)
            if left < -_SAME * abs(way):
                at, refusal = _longer(edges, corners, cuts, k)
                raise refusal.renamed(f"points[{numbers[at]}].{refusal.name}")
            if left <= _SAME * abs(way):
                continue
        found.append(Piece(begin, end, edge.centre, edge.convex))
    # where an edge was used up, its neighbours meet
    found = [replace(p, start=before.end) for p, before in zip(found, [found[-1], *found[:-1]], strict=True)]
    _check(found)
    return tuple(found)


def _longer(
    edges: list[Piece], corners: list[Corner], cuts: list[tuple[complex, complex, Piece | None]], k: int
) -> tuple[int, ParameterError]:
    """The corner that cuts more off an edge than is left of it, of both the larger cut that a smaller one can cure."""
    count = len(edges)
    legs = [abs(begin - corner.at) for (_, begin, _), corner in zip(cuts, corners, strict=True)]

    def room(j: int) -> float:
        """What both edges of a corner have for its legs, mm."""
        beside = (edges[j - 1], legs[j - 1]), (edges[j], legs[(j + 1) % count])
        return min(abs(edge.end - edge.start) - other for edge, other in beside)

    both = sorted((j for j in (k, (k + 1) % count) if legs[j]), key=lambda j: (room(j) > 0, legs[j]))
    corner, leg = corners[both[-1]], legs[both[-1]]
    key, size = ("chamfer", corner.chamfer) if corner.chamfer else ("fillet", corner.fillet)
    most = room(both[-1]) * size / leg
    # an edge may be used up
    cure = limit(most * (1 + _SAME / 2), size, digits=6) if most > 0 else None
    return both[-1], ParameterError(key, size, "corner_longer_than_edge", cure)


def _signed(corners: Sequence[Corner]) -> float:
    at = np.array([c.at for c in corners])
    return float(np.sum((np.conj(at) * np.roll(at, -1)).imag))


def _edge(one: Corner, two: Corner, number: int) -> Piece:
    chord = two.at - one.at
    if abs(chord) <= _SAME * max(abs(one.at), abs(two.at)):
        raise ParameterError(f"points[{number}].z", one.at.imag, "two_points_are_one")
    if not one.arc:
        return Piece(one.at, two.at)
    rest = one.arc**2 - abs(chord) ** 2 / 4
    if rest < -_SAME * one.arc**2:
        least = limit(math.copysign(abs(chord) / 2 * (1 + _SAME), one.arc), one.arc, digits=6)
        raise ParameterError(f"points[{number}].arc", one.arc, "arc_shorter_than_chord", least)
    side = 1 if one.arc > 0 else -1
    centre = (one.at + two.at) / 2 + 1j * side * chord / abs(chord) * math.sqrt(max(rest, 0.0))
    if abs(centre.real) <= _SAME * abs(one.arc):
        centre = complex(0.0, centre.imag)
    if centre.real < 0:
        raise ParameterError(f"points[{number}].arc", one.arc, "arc_about_beyond_axis")
    return Piece(one.at, two.at, centre, one.arc > 0)


def _cut(before: Piece, after: Piece, corner: Corner, number: int) -> tuple[complex, complex, Piece | None]:
    """Where the edge before a corner ends and the one after it begins, and what lies between."""
    size, key = (corner.chamfer, "chamfer") if corner.chamfer else (corner.fillet, "fillet")
    if not size:
        return corner.at, corner.at, None
    if before.centre is not None or after.centre is not None:
        raise ParameterError(f"points[{number}].{key}", size, "corner_of_an_arc", Nearest(0.0))
    back, ahead = before.start - before.end, after.end - after.start
    back, ahead = back / abs(back), ahead / abs(ahead)
    turn = math.atan2((-back.conjugate() * ahead).imag, (-back.conjugate() * ahead).real)
    # on the axis half a section has no corner that the solid would have
    if abs(turn) < _SAME or corner.at.real == 0:
        raise ParameterError(f"points[{number}].{key}", size, "corner_is_straight", Nearest(0.0))
    leg = size if key == "chamfer" else size * math.tan(abs(turn) / 2)
    ends = corner.at + leg * back, corner.at + leg * ahead
    if key == "chamfer":
        return (*ends, Piece(*ends))
    centre = ends[0] + size * (1j if turn > 0 else -1j) * -back
    if centre.real < 0:
        # as far as the axis, for all grows with the radius
        most = limit(size * corner.at.real / (corner.at.real - centre.real) * (1 - _SAME), size, digits=6)
        raise ParameterError(f"points[{number}].fillet", size, "arc_about_beyond_axis", most)
    return (*ends, Piece(*ends, centre, turn > 0))


def _check(pieces: Sequence[Piece]) -> None:
    """The boundary runs beside the axis and crosses itself nowhere."""
    lines = [p.points() for p in pieces]
    size = max(float(np.abs(p).max()) for p in lines)
    if any(float(p.real.min()) < -_SAME * size for p in lines):
        raise ParameterError("points", None, "section_beyond_axis")
    for piece, after in zip(pieces, [*pieces[1:], pieces[0]], strict=True):
        if piece.centre is not None and piece.centre.real > 0 and 0 in (piece.start.real, piece.end.real):
            raise ParameterError("points", None, "arc_ends_on_axis")
        if piece.end.real == 0 and not piece.on_axis and not after.on_axis:
            raise ParameterError("points", None, "section_touches_axis")
    a = np.concatenate([p[:-1] for p in lines])
    b = np.concatenate([p[1:] for p in lines])
    way = b - a

    def side(p: Complex) -> Real:
        return np.asarray((np.conj(way)[:, None] * (p[None, :] - a[:, None])).imag)

    one, two = np.sign(side(a)), np.sign(side(b))
    crossing = (one * two < 0) & (one * two < 0).T
    # neighbours have their corner alone in common, beside which digits may put an end
    own = np.arange(len(a))
    crossing[own, own - 1] = crossing[own - 1, own] = False
    # a corner may lie on no edge but its own two, and none may turn back on the one before it
    length = np.maximum(np.abs(way) ** 2, 1e-300)[:, None]
    share = np.clip((np.conj(way)[:, None] * (a[None, :] - a[:, None])).real / length, 0.0, 1.0)
    near = np.abs(a[:, None] + share * way[:, None] - a[None, :]) <= _SAME * size
    near[own, own] = near[own - 1, own] = False
    back = np.conj(np.roll(way, 1)) * way
    crossing |= near | np.diag((back.real < 0) & (np.abs(back.imag) <= _SAME * np.abs(back)))
    if np.any(crossing) or float(np.sum((np.conj(a) * b).imag)) <= 0:
        raise ParameterError("points", None, "boundary_crosses_itself")


def _hyperbola(flat: Pocket, piece: Piece, first: float, last: float) -> Hyperbola:
    """The curve in which a flat cuts a cone, between places across it: along the axis, and across the flat."""
    slope = (piece.end.imag - piece.start.imag) / (piece.end.real - piece.start.real)
    centre = complex(piece.start.imag - slope * piece.start.real)
    way = math.copysign(1.0, last - first)
    ends = (way * math.asinh(across / flat.floor) for across in (first, last))
    return Hyperbola(centre, slope * flat.floor, way * flat.floor, *ends)


def turned_solid(section: HalfSection, seam: float = 0.0, tolerance: float = 1e-6) -> FacedSolid:
    """The faces of a half section, involutes within a tolerance, mm; ``seam``: where its surfaces are cut open, rad.

    Raises
    ------
    ParameterError
        ``holes``: one of them does not run from a plane face to another one within the material.
    """
    made = _Turned(section, seam, tolerance)
    for spline in section.splines:
        made.teeth(spline)
    for piece in section.pieces:
        made.piece(piece)
    for hole in section.holes:
        made.hole(hole)
    made.close()
    return FacedSolid(made.solid(), made.error, "sampled" if made.error else "exact")


def turned_body(section: HalfSection, seam: float = 0.0) -> FacedBody:
    """The body of a half section; what sides of teeth are no planes are splines for every tolerance."""
    # one surface is one wall, however often it stands on the shaft
    once = {(spline.form, spline.clearance, spline.angle): spline for spline in section.splines}.values()
    walls = tuple(wall for spline in once for wall in involute_walls(spline.outline()))
    if not walls:
        return exact_body(turned_solid(section, seam))
    return FacedBody(lru_cache(maxsize=2)(partial(turned_solid, section, seam)), walls)


class _Level(Draft):
    """A plane face: its height, its radii and its loops."""

    z: float
    radii: tuple[float, float]
    up: bool
    loops: list[Loop] = field(default_factory=list)


class _Rim(Draft):
    """The circle of a corner of the section, from the seam on: arcs, and flats between their ends."""

    vertex: Index
    arcs: list[Index] = field(default_factory=list)
    flats: list[tuple[Pocket, Index, Index]] = field(default_factory=list)

    def around(self, over: Callable[[Pocket, Index, Index], list[Use]]) -> list[Use]:
        """Its arcs, and what bridges flats from end to end."""
        found = [(arc, True) for arc in self.arcs[:1]]
        for flat, arc in zip(self.flats, self.arcs[1:], strict=True):
            found += [*over(*flat), (arc, True)]
        return found


class _Flat(Draft):
    """The edges about a flat: those of its left and right sides from below, and those across its ends."""

    left: list[Index] = field(default_factory=list)
    right: list[Index] = field(default_factory=list)
    low: list[Use] = field(default_factory=list)
    high: list[Use] = field(default_factory=list)


class _Turned(RingBuilder):
    """Builds a turned solid."""

    def __init__(self, section: HalfSection, seam: float, tolerance: float) -> None:
        super().__init__()
        self.section, self.error, self.tolerance = section, 0.0, tolerance
        self.rings: dict[complex, Ring] = {}
        self.ahead = np.array([[math.cos(seam), math.sin(seam), 0.0]])
        self.sideways = np.cross(self.ahead, UP)
        self.known: dict[complex, _Rim] = {}
        self.levels: list[_Level] = []
        self.flats = {p: _Flat() for p in section.pockets if p.is_flat}
        self.cut: dict[complex, list[Pocket]] = {}
        for flat in sorted(self.flats, key=lambda p: (p.angle - seam) % math.tau):
            run = section.run(flat)
            for at in (run[0].start, *(piece.end for piece in run)):
                if flat.low <= at.imag <= flat.high and at.real >= flat.floor * (1 - _SAME):
                    self.cut.setdefault(at, []).append(flat)

    def point(self, at: complex) -> Index:
        """A point of the half plane of the seam."""
        if at.real == 0:
            return self.on_axis(at.imag)
        plane = at.real * (self.ahead[0, 0] + 1j * self.ahead[0, 1])
        return self.add_points(np.array([plane]), at.imag)

    def rim(self, at: complex) -> _Rim:
        """The circle of a corner of the section, none of one on the axis, with a vertex at the seam."""
        if at not in self.known:
            rim = self.known[at] = _Rim(self.add_vertices(self.point(at)))
            last = rim.vertex
            if at.real > 0:
                circle = Circular(self.frame_at(at.imag), at.real)
                for flat in self.cut.get(at, ()):
                    first, after = self.ends(flat, at)
                    rim.arcs.append(self.add_edges(last, first, circle))
                    rim.flats.append((flat, first, after))
                    last = after
                rim.arcs.append(self.add_edges(last, rim.vertex, circle))
        return self.known[at]

    def ends(self, flat: Pocket, at: complex) -> tuple[Index, Index]:
        """The vertices where a flat ends on the circle of a place of the section, one where it only touches it."""
        half = flat.half_width(at.real)
        first, after = (cmath.rect(1.0, flat.angle) * complex(flat.floor, side * half) for side in (-1, 1))
        vertex = self.add_vertices(self.add_points(np.array([first]), at.imag))
        return vertex, self.add_vertices(self.add_points(np.array([after]), at.imag)) if half else vertex

    def chord(self, flat: Pocket, first: Index, after: Index) -> list[Use]:
        """The edge across an end of a flat in a plane, if it is no point."""
        if first is after:
            return []
        found = [(self.add_edges(first, after, Straight(_out_and_across(flat)[1])), True)]
        height = self.place(first)[0, 2]
        made = self.flats[flat]
        if height - flat.low < flat.high - height:
            made.low = found
        else:
            made.high = found
        return found

    def teeth(self, spline: Splined) -> None:
        """The walls of a spline between its rings."""
        outline = spline_outline(spline.outline(), self.tolerance, degree=RIM_DEGREE, continuity=RIM_DEGREE - 1)
        self.error = max(self.error, outline.max_error)
        low, high = (self.ring(outline, z) for z in (spline.low, spline.high))
        self.swept(low, high, UP)
        radius = spline.radii[1]
        self.rings |= {complex(radius, spline.low): low, complex(radius, spline.high): high}

    def piece(self, piece: Piece) -> None:
        """What a piece of the section sweeps."""
        is_ring = piece.start in self.rings and piece.end in self.rings
        if piece.on_axis or (is_ring and piece.start.real == piece.end.real):
            return
        if piece.centre is None and piece.start.imag == piece.end.imag:
            up = piece.end.real < piece.start.real
            inner, outer = sorted((piece.start.real, piece.end.real))
            level = _Level(piece.start.imag, (inner, outer), up)
            for at, is_outer in ((piece.start, up), (piece.end, not up)):
                if at in self.rings:
                    level.loops.insert(0 if is_outer else 1, self.rings[at].loop(forwards=is_outer == up))
                elif at.real:
                    around = self.rim(at).around(self.chord)
                    level.loops.insert(0 if is_outer else 1, loop_of(around if is_outer == up else turned_over(around)))
            self.levels.append(level)
            return
        low, high = self.rim(piece.start), self.rim(piece.end)
        surface, along = self._surface(piece)
        amid = [
            p
            for p in self.section.pockets
            if piece.is_cylinder and piece.start.imag < p.low and p.high < piece.end.imag
        ]
        holes = [(p, self.island(p, piece) if p.is_flat else self.pocket(p, piece.start.real)) for p in amid]
        through = [flat for flat, *_ in low.flats]
        if through and through == [flat for flat, *_ in high.flats]:
            self._between_flats(piece, low, high, surface, holes)
            return
        seam = self.add_edges(low.vertex, high.vertex, self._seam(piece))
        below = low.around(partial(self.notch, piece, up=True))
        above = high.around(partial(self.notch, piece, up=False))
        around = [*below, (seam, True), *turned_over(above), (seam, False)]
        self.faces.append(Faces(surface, (loop_of(around), *(loop for _, loop in holes)), along))

    def _between_flats(
        self, piece: Piece, low: _Rim, high: _Rim, surface: Surface, holes: Sequence[tuple[Pocket, Loop]]
    ) -> None:
        """The faces of what flats cut from end to end, each from a flat to the next one."""
        sides = [
            self.sides(flat, piece, below, above)
            for (flat, *below), (_, *above) in zip(low.flats, high.flats, strict=True)
        ]
        count = len(sides)
        for k in range(count):
            begin, end = low.flats[k][0].angle, low.flats[(k + 1) % count][0].angle
            wide = (end - begin) % math.tau or math.tau
            below, above = (
                [(arc, True) for arc in ([*rim.arcs, rim.arcs[0]])[k + 1 : k + 2 + (k + 1 == count)]]
                for rim in (low, high)
            )
            around = [*below, (sides[(k + 1) % count][0], True), *turned_over(above), (sides[k][1], False)]
            own = [loop for p, loop in holes if (p.angle - begin) % math.tau < wide]
            self.faces.append(Faces(surface, (loop_of(around), *own)))

    def sides(self, flat: Pocket, piece: Piece, low: Sequence[Index], high: Sequence[Index]) -> tuple[Index, Index]:
        """Both sides of a flat along a piece, from its ends below to those above."""
        made = self.flats[flat]
        found = []
        for one, two, side in zip(low, high, (-1, 1), strict=True):
            edge = (
                self.add_edges(one, two, Straight(UP)) if piece.is_cylinder else self._hyperbola(flat, piece, one, two)
            )
            (made.left if side < 0 else made.right).append(edge)
            found.append(edge)
        return found[0], found[1]

    def notch(self, piece: Piece, flat: Pocket, first: Index, after: Index, *, up: bool) -> list[Use]:
        """The edges about a flat that ends amid a piece, from end to end of it on its rim; ``up``: on the lower one."""
        if not piece.is_cylinder:
            arch = [(self._hyperbola(flat, piece, first, after), True)]
            made = self.flats[flat]
            if up:
                made.high = arch
            else:
                made.low = arch
            return arch
        ends, arc = self.step(flat, piece, up=not up)
        left, right = self.sides(flat, piece, *(((first, after), ends) if up else (ends, (first, after))))
        return [(left, up), (arc, True), (right, not up)]

    def island(self, flat: Pocket, piece: Piece) -> Loop:
        """The loop about a flat both of whose ends lie amid a cylinder."""
        (low, below), (high, above) = (self.step(flat, piece, up=up) for up in (True, False))
        left, right = self.sides(flat, piece, low, high)
        return loop_of(turned_over([(below, True), (right, True), (above, False), (left, False)]))

    def step(self, flat: Pocket, piece: Piece, *, up: bool) -> tuple[tuple[Index, Index], Index]:
        """The plane face at an end of a flat amid a cylinder: the flat's ends there, and the arc between them."""
        z = flat.low if up else flat.high
        ends = self.ends(flat, complex(piece.start.real, z))
        arc = self.add_edges(*ends, Circular(self.frame_at(z), piece.start.real))
        around = [(arc, True), *turned_over(self.chord(flat, *ends))]
        self.cap(z, [loop_of(around if up else turned_over(around))], up=up)
        return ends, arc

    def _hyperbola(self, flat: Pocket, piece: Piece, one: Index, two: Index) -> Index:
        """The edge in which a flat cuts a cone, between two vertices."""
        out, across = _out_and_across(flat)
        first, last = ((self.place(v) @ across[0])[0] for v in (one, two))
        curve = _hyperbola(flat, piece, first, last)

        def spatial(shares: Real) -> Real:
            found = curve.point(curve.start + (curve.end - curve.start) * shares)
            return np.column_stack([found.real, found.imag])

        def off(points: Real) -> Real:
            z, y = points.T
            return np.abs(curve.centre.real + curve.along / flat.floor * np.hypot(flat.floor, y) - z)

        knots, poles, error = fitted(spatial, off, NEAR * max(piece.start.real, piece.end.real))
        self.error = max(self.error, error)
        z, y = poles[1:-1].T
        places = flat.floor * out[0] + y[:, None] * across
        inner = self.add_points(places[:, 0] + 1j * places[:, 1], z)
        points = np.concatenate([self.points_of(one), inner, self.points_of(two)])
        return self.add_edges(one, two, Spline(RIM_DEGREE, knots, points[None]))

    def _seam(self, piece: Piece) -> Straight | Circular:
        if piece.centre is None:
            step = piece.end - piece.start
            return Straight((step.real * self.ahead + step.imag * UP) / abs(step))
        axis = self.sideways if piece.convex else -self.sideways
        return Circular(Frame(self.point(piece.centre), axis, self.ahead), piece.radius)

    def _surface(self, piece: Piece) -> tuple[Cylinder | Cone | Sphere | Torus, bool]:
        """Its surface, and whether that looks out of the material."""
        if piece.centre is None:
            return self.lathed(piece.start, piece.end), piece.end.imag > piece.start.imag
        middle, off = self.frame_at(piece.centre.imag), piece.centre.real
        return Torus(middle, off, piece.radius) if off else Sphere(middle, piece.radius), piece.convex

    def hole(self, hole: Hole) -> None:
        """A hole between two plane faces."""
        near, far = abs(hole.centre) - hole.radius, abs(hole.centre) + hole.radius
        over = [level for level in self.levels if level.radii[0] < near and far < level.radii[1]]
        inside = [p for p in self.section.pieces if p.points().real.min() < far and p.points().real.max() > near]
        if len(over) != 2 or len(inside) != 2 or over[0].up == over[1].up:
            raise ParameterError("holes", None, "hole_between_no_planes")
        low, high = sorted(over, key=lambda level: level.z)
        start = self.ahead[0, 0] + 1j * self.ahead[0, 1]
        rings = []
        for level in (low, high):
            vertex = self.add_vertices(self.add_points(np.array([hole.centre + hole.radius * start]), level.z))
            centre = self.add_points(np.array([hole.centre]), level.z)
            circle = self.add_edges(vertex, vertex, Circular(Frame(centre, UP, self.ahead), hole.radius))
            rings.append((vertex, circle, centre))
            level.loops.append(loop_of([(circle, not level.up)]))
        (top, above, _), (bottom, below, centre) = rings[1], rings[0]
        seam = self.add_edges(bottom, top, Straight(UP))
        wall = Cylinder(Frame(centre, UP, self.ahead), hole.radius)
        self.bounded(wall, [(above, True), (seam, False), (below, False), (seam, True)], along=False)

    def pocket(self, pocket: Pocket, radius: float) -> Loop:
        """The faces of a pocket; the loop of its rim on the cylinder."""
        out, across = _out_and_across(pocket)
        half = pocket.width / 2
        lift = math.sqrt(radius**2 - half**2)
        inset = half if pocket.round_ends else 0.0
        ends = pocket.low + inset, pocket.high - inset

        def at(side: Real, height: Real | float, z: Real) -> Index:
            places = side[:, None] * across + np.broadcast_to(height, side.shape)[:, None] * out + z[:, None] * UP
            return self.add_points(places[:, 0] + 1j * places[:, 1], places[:, 2])

        # counter-clockwise as seen from outside, where across points to the right: the lower right one first
        side, z = half * np.array([1.0, 1.0, -1.0, -1.0]), np.array([ends[0], ends[1], ends[1], ends[0]])
        floor, rim = (self.add_vertices(at(side, height, z)) for height in (pocket.floor, lift))
        ups = self.add_edges(floor, rim, Straight(out))
        edges: tuple[list[Index], list[Index]] = ([], [])
        ways = UP, -across, -UP, across
        for k, way in enumerate(ways):
            after, is_end, end = (k + 1) % 4, k in (1, 3), ends[k == 1]
            # each side looks where the next one goes
            normal = ways[after]
            below: Straight | Circular = Straight(way)
            above: Straight | Circular | Spline = Straight(way)
            wall: Plane | Cylinder = Plane(Frame(self.points_of(floor[k : k + 1]), normal, across if is_end else UP))
            if is_end and pocket.round_ends:
                middle = at(np.zeros(1), pocket.floor, np.array([end]))
                knots, rounded, error = rim_across(half, radius)
                self.error = max(self.error, error)
                way_out = 1.0 if k == 1 else -1.0
                inner = at(way_out * rounded[1:-1, 0], rounded[1:-1, 2], end + way_out * rounded[1:-1, 1])
                poles = np.concatenate([self.points_of(rim[k : k + 1]), inner, self.points_of(rim[after : after + 1])])
                below, above = Circular(Frame(middle, out, -way), half), Spline(RIM_DEGREE, knots, poles[None])
                wall = Cylinder(Frame(middle, out, across), half)
            elif is_end:
                above = Circular(Frame(self.on_axis(end), normal, out), radius)
            for found, corners, shape in zip(edges, (floor, rim), (below, above), strict=True):
                found.append(self.add_edges(corners[k : k + 1], corners[after : after + 1], shape))
            # seen from within the pocket the edge of its floor runs backwards
            low, high = (edges[0][k], False), (edges[1][k], True)
            around = [low, (ups[k : k + 1], True), high, (ups[after : after + 1], False)]
            self.bounded(wall, around, along=isinstance(wall, Plane))
        floor_plane = Plane(Frame(self.points_of(floor[:1]), out, UP))
        self.bounded(floor_plane, [(edge, True) for edge in edges[0]])
        return loop_of(turned_over([(edge, True) for edge in edges[1]]))

    def close(self) -> None:
        """The plane faces with the holes in them."""
        for level in self.levels:
            self.cap(level.z, level.loops, up=level.up)
        for flat, made in self.flats.items():
            right, left = ([(edge, True) for edge in side] for side in (made.right, made.left))
            around = [*made.low, *right, *turned_over(made.high), *turned_over(left)]
            out, _ = _out_and_across(flat)
            origin = self.add_points(np.array([cmath.rect(flat.floor, flat.angle)]), flat.low)
            self.bounded(Plane(Frame(origin, out, UP)), around)


def _out_and_across(pocket: Pocket) -> tuple[Real, Real]:
    """From the axis to the middle of a pocket, and across it, (1, 3)."""
    out = np.array([[math.cos(pocket.angle), math.sin(pocket.angle), 0.0]])
    return out, np.cross(UP, out)
