"""The faces of a face gear: splines over its flanks and fillets; planes and cylinders, and all within, as its core.

Splines run from root to tip and along the radius; they interpolate the exact envelope at Greville's places.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from functools import lru_cache, partial

import numpy as np

from geometry.approximation.outline import Outline
from geometry.approximation.tensor import axis_poles, clamped, greville, seen_places
from geometry.base.errors import ConvergenceError
from geometry.base.placement import Placement2
from geometry.curves.bspline import BSpline, SeenEdge, basis_matrix
from geometry.curves.curve import Real, end_point, start_point
from geometry.curves.line_arc import Arc
from geometry.gears.face.gear import FLANK, SIDES, FaceGear, Places
from geometry.gears.face.walls import wall_distance
from geometry.plane.profile import Label, Profile, Segment
from geometry.solids.body_faces import body_outlines
from geometry.solids.faced import FacedBody, FacedSolid
from geometry.solids.faces import Plane
from geometry.solids.measured import Measured
from geometry.solids.rings import UP
from geometry.solids.splines import involute_walls
from geometry.solids.toothed import ToothedFaces, ToothWall

# degrees across a side and along it, where it is nearly straight; spans one way at most, samples of each gap
# between interpolated places, and what is added to sampled errors
_DEGREES, _MOST_SPANS, _SAMPLES, _MARGIN = (7, 5), 64, 4, 1.5
# mm: splines are never farther off, along the normal; and at both ends from the cylinders there, where kernels join
# edges and faces within 1e-7 mm
_COARSEST, _JOINT, _ROUNDING = 1e-6, 2e-8, 8e-15
# by which power spans across a side come closer at the joint of fillet and flank
_CLOSER = 1.5
# lines of the other way on which the spans of one are chosen
_LINES = 5


def faced_face_gear(gear: FaceGear) -> FacedBody:
    """A face gear as files, mass and checks take it."""
    walls = tuple(
        Measured(name, partial(wall_distance, gear, which), gear.number_of_teeth)
        for name, which in zip(("fillet", "flank"), SIDES, strict=True)
    )
    walls += involute_walls(*gear.core.profiles)
    made = lru_cache(maxsize=2)(partial(face_gear_solid, gear))
    low, *_, high = gear.core.levels()
    ends = low, max(high, gear.height), gear.outer_radius
    return FacedBody(lambda t: made(min(t, _COARSEST)), walls, own_ends=ends)


class _Wall(ToothWall, eq=False):
    """With its errors, mm: along the normals, and of both ends off their cylinders."""

    error: float
    ends: float


def seen_spaces(gear: FaceGear, tolerance: float) -> Profile:
    """What lies between the tips, and within them, as it is seen along the axis; splines within ``tolerance`` mm."""
    degree = _DEGREES[1]
    knots = clamped(degree, np.linspace(0.0, 1.0, _spans(gear, FLANK, 1, tolerance) + 1))
    poles = axis_poles(degree, knots, _spatial(gear, _places(gear, FLANK, np.ones(1), greville(degree, knots)))[0], 0)
    inwards = SeenEdge(BSpline(degree, knots, poles[:, 0] + 1j * poles[:, 1]))
    outer, inner = (cmath.phase(end(inwards)) for end in (start_point, end_point))
    pitch = math.tau / gear.number_of_teeth
    # from middle to middle of teeth: points are folded into that sector
    below = [Arc(0j, gear.inner_radius, start, inner) for start in (0.0, pitch - inner)]
    space = Arc(0j, gear.outer_radius, outer, pitch - 2 * outer)
    into = inwards.reversed().mirrored().placed(Placement2(pitch))
    edges = below[0], inwards.reversed(), space, into, below[1]
    labels = Label.BODY, Label.FLANK, Label.BODY, Label.FLANK, Label.BODY
    return Profile(tuple(map(Segment, edges, labels)), gear.number_of_teeth)


def _places(gear: FaceGear, which: int, share: Real, inwards: Real) -> Places:
    """Places (u, v) of the upper side of tooth 1.

    Radii are those of the joint of fillet and flank at even pressure angles: near the undercut these have a branch.
    """
    ends = gear.outer_radius, gear.inner_radius
    high, low = np.arccos(gear.section_x(0.0) / gear.side(FLANK, 0.0, np.array(ends)).x).tolist()
    radius = gear.cut_radius(high + (low - high) * inwards, gear.shaper.form_length)
    radius[inwards == 0], radius[inwards == 1] = ends
    return gear.side(which, share[:, None], radius)


def _spatial(gear: FaceGear, at: Places) -> Real:
    """The same as points of the part (..., 3), mm."""
    return np.stack([at.plane.real, at.plane.imag, gear.shaper_height - at.depth], axis=-1)


def _off(gear: FaceGear, at: Places, made: Real) -> Real:
    """How far points (u, v, 3) are off places (u, v) along the normals of the side, mm."""
    # the gear has turned with the shaper since it stood as it is described
    turn = gear.rolled * at.turn - math.pi / gear.number_of_teeth
    normal = np.stack([at.normal.real * np.sin(turn), at.normal.real * np.cos(turn), -at.normal.imag], axis=-1)
    return np.abs(((made - _spatial(gear, at)) * normal).sum(axis=-1))


def _off_ends(gear: FaceGear, made: Real) -> float:
    """How far points (u, v, 3) of both ends of v are off the cylinders there, mm."""
    radii = np.hypot(made[:, [0, -1], 0], made[:, [0, -1], 1])
    return float(np.abs(radii - (gear.outer_radius, gear.inner_radius)).max())


def _spans(gear: FaceGear, which: int, axis: int, least: float) -> int:
    """Least spans across a side (axis 0) or along it (1) with which its lines are near enough."""
    lines, spans, degree = np.linspace(0.0, 1.0, _LINES), 1, _DEGREES[axis]
    while spans <= _MOST_SPANS:
        breaks = _breaks(which, axis, spans)
        knots = clamped(degree, breaks)
        fine = seen_places(degree, knots, _SAMPLES)

        def at(own: Real) -> Places:
            return _places(gear, which, *((own, lines) if axis == 0 else (lines, own)))

        poles = axis_poles(degree, knots, _spatial(gear, at(greville(degree, knots))), axis)
        made = np.moveaxis(np.tensordot(basis_matrix(degree, knots, fine), poles, (1, axis)), 0, axis)
        error = float(_off(gear, at(fine), made).max())
        if error <= least and (axis or _off_ends(gear, made) <= _joint(gear)):
            return spans
        spans += 1 + spans // 4
    raise ConvergenceError("spline of a face gear's tooth", error, spans)


def _joint(gear: FaceGear) -> float:
    """How far an end may be off its cylinder, mm."""
    return max(_JOINT / _MARGIN, _ROUNDING * gear.outer_radius)


def _breaks(which: int, axis: int, spans: int) -> Real:
    """Shares at the ends of spans, which across a side come closer at the joint of fillet and flank."""
    even = np.linspace(0.0, 1.0, spans + 1)
    if axis:
        return even
    return even**_CLOSER if which == FLANK else 1 - (1 - even) ** _CLOSER


def _fitted(gear: FaceGear, tolerance: float) -> tuple[_Wall, ...]:
    """Fillet and flank; both have the same spans along the radius, where they share an edge."""
    least = max(tolerance / _MARGIN, _ROUNDING * gear.outer_radius)
    across = [_spans(gear, which, 0, least) for which in SIDES]
    along = max(_spans(gear, which, 1, least) for which in SIDES)
    while max(*across, along) <= _MOST_SPANS:
        walls = tuple(_fitted_wall(gear, which, across[which], along) for which in SIDES)
        far = [wall.error > least * _MARGIN or wall.ends > _joint(gear) for wall in walls]
        if not any(far):
            return walls
        across, along = [n + more for n, more in zip(across, far, strict=True)], along + 1
    raise ConvergenceError("spline of a face gear's tooth", max(wall.error for wall in walls), _MOST_SPANS)


def _fitted_wall(gear: FaceGear, which: int, across: int, along: int) -> _Wall:
    """A side on so many spans both ways, from the outer radius inwards."""
    breaks = _breaks(which, 0, across), _breaks(which, 1, along)
    knots = [clamped(degree, own) for degree, own in zip(_DEGREES, breaks, strict=True)]
    exact = _places(gear, which, *(greville(degree, own) for degree, own in zip(_DEGREES, knots, strict=True)))
    half = axis_poles(_DEGREES[1], knots[1], _spatial(gear, exact), 1)
    poles = axis_poles(_DEGREES[0], knots[0], half, 0)
    fine = [seen_places(degree, own, _SAMPLES) for degree, own in zip(_DEGREES, knots, strict=True)]
    rows, columns = (basis_matrix(*each) for each in zip(_DEGREES, knots, fine, strict=True))
    made = np.einsum("iu,uvc,jv->ijc", rows, poles, columns, optimize=True)
    error = _MARGIN * float(_off(gear, _places(gear, which, *fine), made).max())
    return _Wall(_DEGREES, knots[0], knots[1], poles, error, _off_ends(gear, made))


def face_gear_solid(gear: FaceGear, tolerance: float) -> FacedSolid:
    """The faces of a face gear, splines within ``tolerance`` mm.

    Raises
    ------
    ConvergenceError
        64 spans one way are not enough.
    """
    walls = _fitted(gear, tolerance)
    core = body_outlines(gear.core, tolerance)
    made = _Built(gear, walls, core)
    made.teeth()
    made.within()
    worst = max(*(wall.error for wall in walls), *(outline.max_error for outline in core))
    return FacedSolid(made.solid(), worst, "sampled")


class _Built(ToothedFaces):
    """Vertices, edges and faces of one gear."""

    def __init__(self, gear: FaceGear, walls: tuple[_Wall, ...], core: Sequence[Outline]) -> None:
        super().__init__(gear.core, core, gear.number_of_teeth)
        self.gear, self.walls = gear, walls
        self.radii = gear.outer_radius, gear.inner_radius

    def teeth(self) -> None:
        """Flanks, fillets, tips, and what both ends leave between them."""
        gear, made = self.gear, self.sides({-1: self.walls, 1: self.walls})
        (outer, inner), radial = made.corners, made.radial
        tips = [
            self.circle_arcs(radius, gear.height, at[:, 2], at[:, 3])
            for radius, at in zip(self.radii, made.corners, strict=True)
        ]
        self.bounded(Plane(self.frame_at(gear.height)),
                     [(tips[0], True), (radial[3], True), (tips[1], False), (radial[2], False)])  # fmt: skip
        feet = self.circle_arcs(self.radii[1], gear.thickness, inner[:, 0], inner[:, 5])
        self.bounded(self.pipe(self.radii[1]), [*made.over(1, tips[1]), (feet, False)], along=False)
        roots = self.circle_arcs(self.radii[0], gear.thickness, outer[:, 5], np.roll(outer[:, 0], -1))
        # the root and the plate within the teeth are one plane
        after = [np.roll(radial[0], -1), np.roll(feet, -1), np.roll(radial[5], -1)]
        ways = np.tile([True, True, True, False], len(self.turns))
        self.rims[self.body.walls[0].upper] = np.stack([roots, *after], axis=1).reshape(1, -1), ways
        at = self.place(outer[:, 0])
        low = self.add_vertices(self.add_points(np.asarray(at[:, 0] + 1j * at[:, 1]), 0.0))
        over = made.over(0, tips[0])
        self.skirt(self.pipe(self.radii[0]), (self.radii[0], 0.0), low, UP, outer[:, 0], roots, over)
