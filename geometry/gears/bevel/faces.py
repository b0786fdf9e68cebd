"""The faces of a bevel gear: splines over its flanks and fillets, everything else exact.

Every edge of a straight tooth is drawn on the back cone once; at the inner end stands the same, smaller, and rays of
the apex join both. So a surface is as near to the exact cone over its curve as that curve is to the spline. Where the
tip cone does not meet the apex a flank ends before its rays do, and other tooth lines are no rays: such surfaces are
drawn from root to tip at every cone distance.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from functools import lru_cache, partial

import numpy as np

from geometry.approximation.tensor import axis_poles, clamped, greville, tensor_poles
from geometry.base.errors import ConvergenceError
from geometry.base.record import Record
from geometry.curves.bspline import BSpline, SeenEdge, basis_matrix
from geometry.curves.curve import Complex, Real, end_point, start_point
from geometry.curves.line_arc import Arc
from geometry.gears.bevel.gear import BevelGear
from geometry.gears.bevel.walls import wall_distance
from geometry.plane.profile import Label, Profile, Segment
from geometry.solids.body_faces import BodyFaces, body_outlines
from geometry.solids.faced import FacedBody, FacedSolid
from geometry.solids.faces import (
    Circular,
    Cone,
    Faces,
    Frame,
    Index,
    Loop,
    Spline,
    SplineSurface,
    Straight,
    Surface,
)
from geometry.solids.measured import Measured
from geometry.solids.rings import AHEAD, UP

# spans across a tooth and along it at most: tooth lines bend most where they come near the apex
_DEGREE, _MOST_SPANS, _MOST_ALONG, _SAMPLES, _MARGIN = 7, 64, 256, 11, 1.5
# kernels join edges and faces within 1e-7 mm
_TARGET, _ROUNDING = 2e-8, 8e-15
# the share of it that an edge may take of a flank's
_EDGE = 0.8
_RULED = np.array([0.0, 0.0, 1.0, 1.0])
_SIDES = ("fillet", "flank")

# edges (n,) and whether they run forwards
Use = tuple[Index, bool]


def faced_bevel(gear: BevelGear) -> FacedBody:
    """A bevel gear as files, mass and checks take it."""
    walls = tuple(
        Measured(f"{name} {way:+d}", partial(wall_distance, gear, name, way), gear.number_of_teeth)
        for name in _SIDES for way in (1, -1)
    )  # fmt: skip
    made = lru_cache(maxsize=2)(partial(bevel_solid, gear))
    ends = 0.0, gear.height, max(gear.outer(gear.tip_angle).real, gear.rim.real)
    return FacedBody(lambda tolerance: made(min(tolerance, _TARGET)), walls, own_ends=ends)


def bevel_solid(gear: BevelGear, tolerance: float) -> FacedSolid:
    """The faces of a bevel gear, splines within ``tolerance`` mm.

    Raises
    ------
    ConvergenceError
        64 spans for a curve are not enough.
    """
    made = _Bevel(gear, tolerance)
    made.teeth()
    for wall in made.body.walls[1:]:
        made.wall(wall)
    for cap in made.body.caps:
        made.face(cap)
    return FacedSolid(made.solid(), max(made.worst, *(outline.max_error for outline in made.outlines)), "sampled")


def seen_profile(gear: BevelGear, tolerance: float) -> Profile:
    """The outer end as it is seen along the axis, splines within ``tolerance`` mm."""
    upper, lower = (_seen_side(one, tolerance) for one in (gear, gear.opposite()))
    low, high = cmath.phase(start_point(upper[0].curve)), cmath.phase(end_point(upper[1].curve))
    below, beside = cmath.phase(start_point(lower[0].curve)), cmath.phase(end_point(lower[1].curve))
    land = Arc(0j, gear.outer(gear.tip_angle).real, -beside, beside + high)
    floor = Arc(0j, gear.outer(gear.root_angle).real, low, math.tau / gear.number_of_teeth - (low + below))
    back = [Segment(s.curve.reversed(), s.label) for s in reversed(upper)]
    rise = [Segment(s.curve.reversed().mirrored(), s.label) for s in lower]
    period = (*rise, Segment(land, Label.TIP_LAND), *back, Segment(floor, Label.ROOT_LAND))
    return Profile(period, gear.number_of_teeth)


def _seen_side(gear: BevelGear, tolerance: float) -> list[Segment]:
    """Fillet and flank of the upper side, from the root on."""
    sides = []
    for name, label in zip(_SIDES, (Label.ROOT_FILLET, Label.FLANK), strict=True):
        knots, poles, _ = _fitted(gear, name, tolerance)
        sides.append(Segment(SeenEdge(BSpline(_DEGREE, knots, poles[:, 0] + 1j * poles[:, 1])), label))
    return sides


def _fitted(gear: BevelGear, name: str, tolerance: float) -> tuple[Real, Real, float]:
    """Knots, poles (k, 3) of the upper side of tooth 0 on the back cone, and their error, mm.

    Knots serve the inner end as well, where that is another curve.
    """
    least, spans = max(_EDGE * min(tolerance, _TARGET) / _MARGIN, _ROUNDING * gear.cone_distance), 1
    ends: list[Callable[[Real], Real]] = [partial(gear.points, name)]
    if not gear.is_straight:
        ends.append(lambda shares: gear.wall_points(name, shares, np.ones(1))[:, 0])
    while spans <= _MOST_SPANS:
        knots = clamped(_DEGREE, np.linspace(0.0, 1.0, spans + 1))
        fine = np.linspace(0.0, 1.0, _SAMPLES * spans + 1)
        made = [axis_poles(_DEGREE, knots, end(greville(_DEGREE, knots)), 0) for end in ends]
        error = max(
            float(np.linalg.norm(basis_matrix(_DEGREE, knots, fine) @ poles - end(fine), axis=1).max())
            for end, poles in zip(ends, made, strict=True)
        )
        if error <= least:
            return knots, made[0], _MARGIN * error
        spans *= 2
    raise ConvergenceError("spline of a bevel tooth", error, spans)


class _Walls(Record):
    """Splines of the upper side of tooth 0 by name: knots from root to tip, degrees and knots along the teeth, poles.

    ``error``: of them all, mm.
    """

    across: dict[str, Real]
    degrees: dict[str, int]
    along: dict[str, Real]
    poles: dict[str, Real]
    error: float


def _fitted_walls(gear: BevelGear, tolerance: float) -> _Walls:
    """Its flank and fillet, ruled by rays of the apex where they are cones."""
    across, degrees, along, poles = {}, dict.fromkeys(_SIDES, 1), dict.fromkeys(_SIDES, _RULED), {}
    error, apex = 0.0, gear.placed(np.zeros(3))
    for name in _SIDES:
        across[name], outer, worst = _fitted(gear, name, tolerance)
        error = max(error, worst)
        poles[name] = np.stack([outer, apex + gear.inner_distance / gear.cone_distance * (outer - apex)], axis=1)
    free = [name for name in _SIDES if not gear.is_straight or (name == "flank" and not gear.tip_to_apex)]
    least, spans, worst = max(min(tolerance, _TARGET) / _MARGIN, 2 * _ROUNDING * gear.cone_distance), 1, math.inf
    while free and worst > least:
        if spans > _MOST_ALONG:
            raise ConvergenceError("spline of a bevel flank", worst, spans)
        knots, worst = clamped(_DEGREE, np.linspace(0.0, 1.0, spans + 1)), 0.0
        fine = np.linspace(0.0, 1.0, _SAMPLES * spans + 1)
        for name in free:
            degrees[name], along[name] = _DEGREE, knots
            poles[name], off = _fitted_wall(gear, name, across[name], knots, fine)
            worst = max(worst, off)
        spans *= 2
    if free == ["flank"] and len(along["flank"]) > 2 * (_DEGREE + 1):
        # faces side by side have as many spans
        degrees["fillet"], along["fillet"] = degrees["flank"], along["flank"]
        low, high = np.moveaxis(poles["fillet"], 1, 0)
        shares = greville(_DEGREE, along["flank"])
        poles["fillet"] = low[:, None] + shares[:, None] * (high - low)[:, None]
    return _Walls(across, degrees, along, poles, max(error, _MARGIN * worst if free else 0.0))


def _fitted_wall(gear: BevelGear, name: str, across: Real, along: Real, fine: Real) -> tuple[Real, float]:
    """Poles (u, v, 3) of a wall on both knots, and their error at shares ``fine`` of the face, mm."""
    shares = np.linspace(0.0, 1.0, _SAMPLES * (len(across) - 2 * _DEGREE - 1) + 1)
    exact = gear.wall_points(name, greville(_DEGREE, across), greville(_DEGREE, along))
    poles = tensor_poles(_DEGREE, across, along, exact)
    rows, columns = basis_matrix(_DEGREE, across, shares), basis_matrix(_DEGREE, along, fine)
    made = np.einsum("iu,uvc,jv->ijc", rows, poles, columns, optimize=True)
    return poles, float(np.linalg.norm(made - gear.wall_points(name, shares, fine), axis=2).max())


# faces ----------------------------------------------------------------------------------------------------------


class _Bevel(BodyFaces):
    """Vertices, edges and faces of one gear; ``worst``: of its splines, mm.

    ``rims``: what stands in place of the core's first wall, by its loops.
    """

    def __init__(self, gear: BevelGear, tolerance: float) -> None:
        core = gear.core
        super().__init__(core, body_outlines(core, tolerance))
        self.gear, upper, self.rims = gear, _fitted_walls(gear, tolerance), dict[int, Loop]()
        self.starts = np.arange(gear.number_of_teeth)
        other = gear.opposite()
        self.walls = {-1: upper if other == gear else _fitted_walls(other, tolerance), 1: upper}
        self.worst = max(walls.error for walls in self.walls.values())

    def height(self, place: complex) -> float:
        """z of a place of the blank, mm."""
        return self.gear.mounting_distance - place.imag

    def on_teeth(self, points: Real) -> Index:
        """Numbers of points (k, 3) of tooth 0 on all teeth, (n, k)."""
        turn = np.exp(1j * math.tau * self.starts / self.gear.number_of_teeth)
        plane = turn[:, None] * (points[:, 0] + 1j * points[:, 1])
        return self.add_points(plane, np.broadcast_to(points[:, 2], plane.shape))

    def within(self, surface: Surface, around: list[Use], *, along: bool = True) -> None:
        """Faces within edges that turn left about them, as seen from outside."""
        loop = np.stack([edge for edge, _ in around], axis=1), np.array([way for _, way in around])
        self.faces.append(Faces(surface, (loop,), along))

    def cone(self, place: complex, slant: float, *, up: bool) -> Cone:
        """The cone about the axis through a place of the blank, which widens upwards or downwards by ``slant`` rad."""
        frame = Frame(self.on_axis(self.height(place)), UP if up else -UP, AHEAD)
        return Cone(frame, place.real, slant)

    def arc(self, place: complex, start: Index, end: Index) -> Index:
        """Arcs on the circle of a place of the blank, counter-clockwise."""
        frame = Frame(self.on_axis(self.height(place)), UP, AHEAD)
        return self.add_edges(start, end, Circular(frame, place.real))

    def teeth(self) -> None:
        """Flanks, fillets, lands, and what both ends leave between them."""
        gear, mirror = self.gear, np.array([1.0, -1.0, 1.0])
        ends, vertices = [], []
        for end in (0, -1):
            # from the lower root over the tip to the upper root
            lower, upper = (
                np.array([poles["fillet"][0, end], poles["flank"][0, end], poles["flank"][-1, end]])
                for poles in (self.walls[-1].poles, self.walls[1].poles)
            )
            points = self.on_teeth(np.concatenate([lower * mirror, upper[::-1]]))
            ends.append(points)
            vertices.append(np.stack([self.add_vertices(column) for column in points.T], axis=1))
        self.vertices_at = vertices
        places = [self.place(vertex) for vertex in np.concatenate(vertices, axis=1).T]
        rays: dict[int, Index] = {}
        # flanks end at the tip cone on rays where that meets the apex
        degrees = self.walls[1].degrees
        for k in range(6) if degrees["flank"] == 1 else (0, 1, 4, 5) if degrees["fillet"] == 1 else ():
            way = places[6 + k] - places[k]
            way = way / np.linalg.norm(way, axis=1)[:, None]
            rays[k] = self.add_edges(vertices[0][:, k], vertices[1][:, k], Straight(way))
        splines: list[dict[tuple[str, int], Index]] = [{}, {}]
        for side, (place, name) in [(s, p) for s in (-1, 1) for p in enumerate(_SIDES)]:
            first, last = (place, place + 1) if side < 0 else (5 - place, 4 - place)
            walls = self.walls[side]
            grid = self._grid(walls.poles[name] * (mirror if side < 0 else 1.0), ends, first, last)
            for end in (0, 1):
                curve = Spline(_DEGREE, walls.across[name], grid[:, :, -end])
                splines[end][name, side] = self.add_edges(vertices[end][:, first], vertices[end][:, last], curve)
            for corner, u in ((first, 0), (last, -1)):
                if corner not in rays:
                    line = Spline(walls.degrees[name], walls.along[name], grid[:, u])
                    rays[corner] = self.add_edges(vertices[0][:, corner], vertices[1][:, corner], line)
            surface = SplineSurface((_DEGREE, walls.degrees[name]), walls.across[name], walls.along[name], grid)
            low, high = splines[0][name, side], splines[1][name, side]
            around = [(low, True), (rays[last], True), (high, False), (rays[first], False)]
            if side > 0:
                around = [(edge, not way) for edge, way in reversed(around)]
            self.within(surface, around, along=side < 0)
        after = [np.roll(v[:, 0], -1) for v in vertices]
        tops = gear.outer(gear.tip_angle), gear.inner(gear.inner_tip_angle)
        tips = [self.arc(top, v[:, 2], v[:, 3]) for top, v in zip(tops, vertices, strict=True)]
        feet_at = gear.outer(gear.root_angle), gear.front
        roots = [self.arc(foot, v[:, 5], a) for foot, v, a in zip(feet_at, vertices, after, strict=True)]
        self.within(self.cone(tops[0], gear.tip_cone_angle, up=False),
                  [(tips[0], True), (rays[3], True), (tips[1], False), (rays[2], False)])  # fmt: skip
        self.within(self.cone(gear.outer(gear.root_angle), gear.root_angle, up=False),
                  [(roots[0], True), (np.roll(rays[0], -1), True), (roots[1], False), (rays[5], False)])  # fmt: skip
        feet = self.arc(gear.front, vertices[1][:, 0], vertices[1][:, 5])
        over = [(splines[1]["fillet", -1], True), (splines[1]["flank", -1], True), (tips[1], True),
                (splines[1]["flank", 1], False), (splines[1]["fillet", 1], False), (feet, False)]  # fmt: skip
        slant = math.pi / 2 - gear.pitch_angle
        self.within(self.cone(gear.front, slant, up=True), over, along=False)
        front = np.stack([feet, roots[1]], axis=1).reshape(1, -1)
        self.rims[self.body.walls[0].upper] = front, np.full(front.shape[1], True)
        self._back_cone(splines[0], tips[0], roots[0], slant)

    def _grid(self, poles: Real, ends: list[Index], first: int, last: int) -> Index:
        """Numbers (n, u, v) of poles (u, v, 3) on all teeth, whose corners stand already."""
        inner = np.ones(poles.shape[:2], bool)
        inner[np.ix_((0, -1), (0, -1))] = False
        grid = np.empty((len(self.starts), *poles.shape[:2]), int)
        grid[:, inner] = self.on_teeth(poles[inner])
        for u, corner in ((0, first), (-1, last)):
            for v in (0, 1):
                grid[:, u, -v] = ends[v][:, corner]
        return grid

    def _back_cone(self, splines: dict[tuple[str, int], Index], tips: Index, roots: Index, slant: float) -> None:
        """From the teeth down to the rim, tooth by tooth."""
        gear, rim = self.gear, self.gear.rim
        roots_at = self.vertices_at[0][:, 0]
        at = self.place(roots_at)
        plane: Complex = at[:, 0] + 1j * at[:, 1]
        low = self.add_vertices(self.add_points(np.asarray(plane / np.abs(plane) * rim.real), self.height(rim)))
        way = at - self.place(low)
        lines = self.add_edges(low, roots_at, Straight(way / np.linalg.norm(way, axis=1)[:, None]))
        arcs = self.arc(rim, low, np.roll(low, -1))
        around = [
            (arcs, True), (np.roll(lines, -1), True), (roots, False), (splines["fillet", 1], True),
            (splines["flank", 1], True), (tips, False), (splines["flank", -1], False), (splines["fillet", -1], False),
            (lines, False),
        ]  # fmt: skip
        self.within(self.cone(gear.rim, slant, up=True), around)
        self.rims[self.body.walls[0].lower] = arcs[::-1][None], np.full(len(arcs), False)

    def around(self, loop: int, left: bool) -> Loop:
        """The loop of a face, which runs about teeth or rim where the core begins."""
        return self.rims[loop] if loop in self.rims else super().around(loop, left)
