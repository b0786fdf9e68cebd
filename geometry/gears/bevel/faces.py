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
from geometry.curves.bspline import BSpline, SeenEdge, basis_matrix
from geometry.curves.curve import Complex, Real, end_point, start_point
from geometry.curves.line_arc import Arc
from geometry.gears.bevel.gear import BevelGear
from geometry.gears.bevel.walls import wall_distance
from geometry.plane.profile import Label, Profile, Segment
from geometry.solids.body_faces import body_outlines
from geometry.solids.faced import FacedBody, FacedSolid
from geometry.solids.faces import Cone, Frame, Index
from geometry.solids.measured import Measured
from geometry.solids.rings import AHEAD, UP
from geometry.solids.splines import involute_walls
from geometry.solids.toothed import ToothedFaces, ToothWall

# spans across a tooth and along it at most: tooth lines bend most where they come near the apex
_DEGREE, _MOST_SPANS, _MOST_ALONG, _SAMPLES, _MARGIN = 7, 64, 256, 11, 1.5
# kernels join edges and faces within 1e-7 mm
_TARGET, _ROUNDING = 2e-8, 8e-15
# the share of it that an edge may take of a flank's
_EDGE = 0.8
_RULED = np.array([0.0, 0.0, 1.0, 1.0])
_SIDES = ("fillet", "flank")


def faced_bevel(gear: BevelGear) -> FacedBody:
    """A bevel gear as files, mass and checks take it."""
    walls = tuple(
        Measured(f"{name} {way:+d}", partial(wall_distance, gear, name, way), gear.number_of_teeth)
        for name in _SIDES for way in (1, -1)
    )  # fmt: skip
    walls += involute_walls(*gear.blank.holes.profiles())
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
    made.within()
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
    """Fillet and flank of the upper side, from the root on; they meet beyond what a long cone distance rounds."""
    sides: list[Segment] = []
    for name, label in zip(_SIDES, (Label.ROOT_FILLET, Label.FLANK), strict=True):
        knots, poles, _ = _fitted(gear, name, tolerance)
        seen = poles[:, 0] + 1j * poles[:, 1]
        if sides:
            seen[0] = end_point(sides[-1].curve)
        sides.append(Segment(SeenEdge(BSpline(_DEGREE, knots, seen)), label))
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


def _fitted_walls(gear: BevelGear, tolerance: float) -> tuple[tuple[ToothWall, ...], float]:
    """Its flank and fillet, ruled by rays of the apex where they are cones, and the error of both, mm."""
    degrees, along = dict.fromkeys(_SIDES, 1), dict.fromkeys(_SIDES, _RULED)
    across, poles, error, apex = {}, {}, 0.0, gear.placed(np.zeros(3))
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
    walls = tuple(ToothWall((_DEGREE, degrees[k]), across[k], along[k], poles[k]) for k in _SIDES)
    return walls, max(error, _MARGIN * worst if free else 0.0)


def _fitted_wall(gear: BevelGear, name: str, across: Real, along: Real, fine: Real) -> tuple[Real, float]:
    """Poles (u, v, 3) of a wall on both knots, and their error at shares ``fine`` of the face, mm."""
    shares = np.linspace(0.0, 1.0, _SAMPLES * (len(across) - 2 * _DEGREE - 1) + 1)
    exact = gear.wall_points(name, greville(_DEGREE, across), greville(_DEGREE, along))
    poles = tensor_poles(_DEGREE, across, along, exact)
    rows, columns = basis_matrix(_DEGREE, across, shares), basis_matrix(_DEGREE, along, fine)
    made = np.einsum("iu,uvc,jv->ijc", rows, poles, columns, optimize=True)
    return poles, float(np.linalg.norm(made - gear.wall_points(name, shares, fine), axis=2).max())


# faces ----------------------------------------------------------------------------------------------------------


class _Bevel(ToothedFaces):
    """Vertices, edges and faces of one gear; ``worst``: of its splines, mm."""

    def __init__(self, gear: BevelGear, tolerance: float) -> None:
        super().__init__(gear.core, body_outlines(gear.core, tolerance), gear.number_of_teeth)
        self.gear, (upper, error) = gear, _fitted_walls(gear, tolerance)
        other = gear.opposite()
        lower, worst = (upper, error) if other == gear else _fitted_walls(other, tolerance)
        self.walls, self.worst = {-1: lower, 1: upper}, max(error, worst)

    def height(self, place: complex) -> float:
        """z of a place of the blank, mm."""
        return self.gear.mounting_distance - place.imag

    def cone(self, place: complex, slant: float, *, up: bool) -> Cone:
        """The cone about the axis through a place of the blank, which widens upwards or downwards by ``slant`` rad."""
        frame = Frame(self.on_axis(self.height(place)), UP if up else -UP, AHEAD)
        return Cone(frame, place.real, slant)

    def arc(self, place: complex, start: Index, end: Index) -> Index:
        """Arcs on the circle of a place of the blank, counter-clockwise."""
        return self.circle_arcs(place.real, self.height(place), start, end)

    def teeth(self) -> None:
        """Flanks, fillets, lands, and what both ends leave between them."""
        gear, made = self.gear, self.sides(self.walls)
        (outer, inner), rays = made.corners, made.radial
        tops = gear.outer(gear.tip_angle), gear.inner(gear.inner_tip_angle)
        tips = [self.arc(top, at[:, 2], at[:, 3]) for top, at in zip(tops, made.corners, strict=True)]
        feet_at = gear.outer(gear.root_angle), gear.front
        roots = [self.arc(f, at[:, 5], np.roll(at[:, 0], -1)) for f, at in zip(feet_at, made.corners, strict=True)]
        self.bounded(self.cone(tops[0], gear.tip_cone_angle, up=False),
                     [(tips[0], True), (rays[3], True), (tips[1], False), (rays[2], False)])  # fmt: skip
        self.bounded(self.cone(feet_at[0], gear.root_angle, up=False),
                     [(roots[0], True), (np.roll(rays[0], -1), True), (roots[1], False), (rays[5], False)])  # fmt: skip
        feet = self.arc(gear.front, inner[:, 0], inner[:, 5])
        slant = math.pi / 2 - gear.pitch_angle
        self.bounded(self.cone(gear.front, slant, up=True), [*made.over(1, tips[1]), (feet, False)], along=False)
        front = np.stack([feet, roots[1]], axis=1).reshape(1, -1)
        self.rims[self.body.walls[0].upper] = front, np.full(front.shape[1], True)
        # the back cone, from the teeth down to the rim
        rim, at, over = gear.rim, self.place(outer[:, 0]), made.over(0, tips[0])
        plane: Complex = at[:, 0] + 1j * at[:, 1]
        low = self.add_vertices(self.add_points(np.asarray(plane / np.abs(plane) * rim.real), self.height(rim)))
        way = at - self.place(low)
        way = way / np.linalg.norm(way, axis=1)[:, None]
        circle = rim.real, self.height(rim)
        self.skirt(self.cone(rim, slant, up=True), circle, low, way, outer[:, 0], roots[0], over)
