"""Wheels with holes across their hubs, as bodies told by their faces.

The faces are those of the wheel, of which hub and bore have the rims of the holes in them, and two halves of a cylinder
for each hole.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import lru_cache, partial

import numpy as np

from geometry.approximation.outline import Outline
from geometry.base.errors import ParameterError
from geometry.base.nearest import nearest
from geometry.base.record import replace
from geometry.curves.bounds import Bound
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import Arc
from geometry.plane.measure import distance_to_own, profile_area
from geometry.plane.profile import Profile
from geometry.solids.body import Body, Wall
from geometry.solids.body_faces import BodyFaces, body_outlines, cut_for_faces
from geometry.solids.cross_holes import CrossHole, Mouth, mouth_in, open_circle
from geometry.solids.faced import FacedBody, FacedSolid
from geometry.solids.faces import (
    Circular,
    Cylinder,
    Faces,
    Frame,
    Index,
    Loop,
    Plane,
    Spline,
    Straight,
    loop_of,
    turned_over,
)  # fmt: skip
from geometry.solids.mass import Moments, body_moments
from geometry.solids.measured import Measured
from geometry.solids.rims import RIM_DEGREE, rim_across
from geometry.solids.rings import UP

# heights that have one section, as files hold them; mm beyond a chamfer where its height alone tells enough
_LEVEL_DIGITS, _BEYOND = 9, 0.05
# samples of a curve, between two of which it holds the foot of what lies on it; mm that is on it
_SAMPLES, _ON = 9, 1e-9
# places about a hole at which it is integrated: the integrand is periodic
_AROUND = 128


def walls_at(body: Body, hole: CrossHole) -> tuple[Wall, Wall]:
    """The walls of hub and bore at the height of a hole, where nothing else stands."""
    there = [w for w in body.walls if body.height(w)[0] < hole.height < body.height(w)[1]]
    outer, inner = sorted(there, key=lambda w: -profile_area(body.loop_profile(w.lower)))
    return outer, inner


def mouths_of(body: Body, hole: CrossHole) -> list[Mouth | None]:
    """Those of a hole in hub and bore; None where it opens in no one face."""
    found = []
    for wall in walls_at(body, hole):
        profile = body.loop_profile(wall.lower)
        segments = [s.curve for s in profile.segments()]
        whole = [open_circle(profile.reach(), hole.angle)] if _is_circle(profile) else segments
        found.append(mouth_in(whole, (0.0,), hole))
    return found


def has_room(body: Body, holes: Sequence[CrossHole]) -> bool:
    """Whether hub and bore stand upright beside all of each hole, which opens in one face of either."""
    return all(
        low < hole.height - hole.radius and hole.height + hole.radius < high and None not in mouths_of(body, hole)
        for hole in holes
        for low, high in map(body.height, walls_at(body, hole))
    )


def crossed_at(blank: Callable[[float], Body], holes: Sequence[CrossHole], offset: float) -> FacedBody:
    """The body with holes, every boundary moved ``offset`` mm out of the material.

    Raises
    ------
    ParameterError
        ``offset``: it leaves the holes no room, or nothing of them.
    """

    def fits(moved: float) -> bool:
        return has_room(blank(moved), [hole.moved(moved) for hole in holes])

    if not fits(offset):
        raise ParameterError("offset", offset, "set_screws_lose_hub", partial(nearest, fits, offset, 0.0))
    return crossed(blank(offset), [hole.moved(offset) for hole in holes])


def crossed(body: Body, holes: Sequence[CrossHole]) -> FacedBody:
    """The body with holes between its hub and its bore, each where both stand upright and alone."""
    body = _opened(body, holes)
    reach, levels = body.section_reach(), body.levels()
    return FacedBody(
        lru_cache(maxsize=2)(partial(_faces, body, holes)),
        _surfaces(body, holes),
        partial(_moments, body, holes),
        own_ends=(levels[0], levels[-1], reach),
        whole=True,
        # within the plane of its height a point lies farther off a chamfer, and off a screw surface, than in space
        sideways=math.hypot(1.0, max(body.steepness(), 1.0 if any(map(body.is_chamfer, body.walls)) else 0.0)),
    )


def _opened(body: Body, holes: Sequence[CrossHole]) -> Body:
    """The body with the round walls of hub and bore cut open where no hole is."""
    angles = np.sort([hole.angle % math.tau for hole in holes])
    gaps = np.diff([*angles, angles[0] + math.tau])
    seam = float(angles[gaps.argmax()] + gaps.max() / 2)
    loops = list(body.loops)
    ends = [{wall.lower, wall.upper} for wall in body.walls]
    for wall in (wall for hole in holes for wall in walls_at(body, hole)):
        if not _is_circle(body.loop_profile(wall.lower)):
            continue
        # what a chamfer joins to it is turned as it is
        turned, wider = {wall.lower}, {wall.lower, wall.upper}
        while wider != turned:
            turned, wider = wider, wider.union(*(pair for pair in ends if pair & wider))
        for k in turned:
            loops[k] = replace(loops[k], turn=seam)
    return replace(body, loops=tuple(loops))


def _is_circle(profile: Profile) -> bool:
    return profile.count == 1 and all(isinstance(s.curve, Arc) and not s.curve.centre for s in profile.period)


def _faces(body: Body, holes: Sequence[CrossHole], tolerance: float) -> FacedSolid:
    outlines = body_outlines(body, tolerance)
    made = _CrossedFaces(cut_for_faces(body), outlines, holes)
    for wall in made.body.walls:
        made.wall(wall)
    for cap in made.body.caps:
        made.face(cap)
    made.cross()
    bounds = {outline.bound for outline in outlines} | ({"sampled"} if made.error else set())
    worst: Bound = next(bound for bound in ("sampled", "certified", "exact") if bound in bounds)
    return FacedSolid(made.solid(), max(made.error, *(outline.max_error for outline in outlines)), worst)


class _CrossedFaces(BodyFaces):
    """The faces of a body with holes across its hub."""

    def __init__(self, body: Body, outlines: Sequence[Outline], holes: Sequence[CrossHole]) -> None:
        super().__init__(body, outlines)
        self.holes, self.error = holes, 0.0
        # the first face of each wall
        self.first: dict[int, int] = {}

    def wall(self, wall: Wall) -> None:
        """As those of any body, remembered."""
        self.first[id(wall)] = len(self.faces)
        super().wall(wall)

    def cross(self) -> None:
        """The holes, and their rims in the faces that they open in."""
        rims: dict[tuple[int, int], list[Loop]] = {}
        for hole in self.holes:
            mouths = []
            for wall in walls_at(self.body, hole):
                ring = self.at(wall.lower)
                mouth = mouth_in(ring.curves, np.angle(ring.turns).tolist(), hole)
                assert mouth is not None
                mouths.append((mouth, (self.first[id(wall)] + mouth.curve, mouth.place)))
            (outer, over), (inner, under) = mouths
            out, within = self._hole(hole, outer, inner)
            rims.setdefault(over, []).append(out)
            rims.setdefault(under, []).append(within)
        for index in {index for index, _ in rims}:
            faces = self.faces[index]
            rows = np.arange(len(faces.loops[0][0]))
            own = {row: loops for (other, row), loops in rims.items() if other == index}
            rest = rows[~np.isin(rows, [*own])]
            made = [replace(_rows(faces, [row]), loops=(*_rows(faces, [row]).loops, *own[row])) for row in own]
            self.faces[index], *others = [*made, *([_rows(faces, rest)] if len(rest) else [])]
            self.faces += others

    def _hole(self, hole: CrossHole, outer: Mouth, inner: Mouth) -> tuple[Loop, Loop]:
        """The wall of a hole in two halves; the loops of its rims on the hub and in the bore."""
        out = np.array([[math.cos(hole.angle), math.sin(hole.angle), 0.0]])
        across = np.cross(UP, out)
        middle = hole.height * UP

        def at(side: Real, rise: Real, away: Real) -> Index:
            places = middle + side[:, None] * across + rise[:, None] * UP + away[:, None] * out
            return self.add_points(places[:, 0] + 1j * places[:, 1], places[:, 2])

        sides = hole.radius * np.array([1.0, -1.0])
        corners = [self.add_vertices(at(sides, np.zeros(2), mouth.rise(sides))) for mouth in (inner, outer)]
        lines = self.add_edges(corners[0], corners[1], Straight(out))
        rims: tuple[list[Index], list[Index]] = ([], [])
        for k, way in enumerate((1.0, -1.0)):
            start, end = ([k], [1 - k])
            for found, ends, mouth in zip(rims, corners, (inner, outer), strict=True):
                shape: Circular | Spline
                if mouth.is_round:
                    knots, poles, error = rim_across(hole.radius, mouth.away)
                    self.error = max(self.error, error)
                    along, rise, away = poles[1:-1].T
                    own = [self.points_of(ends[start]), at(way * along, way * rise, away), self.points_of(ends[end])]
                    shape = Spline(RIM_DEGREE, knots, np.concatenate(own)[None])
                else:
                    centre = at(np.zeros(1), np.zeros(1), np.array([mouth.away]))
                    shape = Circular(Frame(centre, out, across), hole.radius)
                found.append(self.add_edges(ends[start], ends[end], shape))
            axis = Frame(at(np.zeros(1), np.zeros(1), np.array([inner.away])), out, across)
            around = [(rims[0][k], False), (lines[start], True), (rims[1][k], True), (lines[end], False)]
            self.bounded(Cylinder(axis, hole.radius), around, along=False)
        within = [(edge, True) for edge in rims[0]]
        return loop_of(turned_over([(edge, True) for edge in rims[1]])), loop_of(within)


def _rows(faces: Faces, rows: Sequence[int] | Index) -> Faces:
    """Some faces of a bundle on planes or cylinders."""
    surface = faces.surface
    assert isinstance(surface, Cylinder | Plane)
    frame = surface.frame
    origin = frame.origin if len(frame.origin) == 1 else frame.origin[rows]
    axis, zero = (way if len(way) == 1 else way[rows] for way in (frame.axis, frame.zero))
    own = Frame(origin, axis, zero)
    return replace(faces, surface=replace(surface, frame=own), loops=tuple((e[rows], way) for e, way in faces.loops))


def _surfaces(body: Body, holes: Sequence[CrossHole]) -> tuple[Measured, ...]:
    """Every surface once: the levels of its faces, its walls, its holes."""
    levels = [Measured("plane", partial(_to_level, z), 0) for z in sorted({body.loops[c.outer].z for c in body.caps})]
    walls: dict[object, Wall] = {}
    for wall in body.walls:
        place = body.loops[wall.lower]
        # one surface is one wall, on both sides of a web too
        turn = None if _is_circle(body.loop_profile(wall.lower)) else place.turn
        walls.setdefault((place.profile, turn) if body.is_upright(wall) else id(wall), wall)
    found = [Measured("wall", _to_wall(body, wall), _turns(body, wall)) for wall in walls.values()]
    return (*levels, *found, *(Measured("cylinder", partial(_to_hole, hole)) for hole in holes))


def _turns(body: Body, wall: Wall) -> int:
    profile = body.loop_profile(wall.lower)
    return 0 if _is_circle(profile) else profile.count


def _to_level(z: float, points: Real) -> Real:
    return np.asarray(np.abs(points[:, 2] - z))


def _to_hole(hole: CrossHole, points: Real) -> Real:
    """How far points (n, 3) lie from the wall of a hole; behind the axis as from its seat there."""
    plane = (points[:, 0] + 1j * points[:, 1]) * np.exp(-1j * hole.angle)
    away = np.hypot(np.hypot(plane.imag, points[:, 2] - hole.height) - hole.radius, np.minimum(plane.real, 0.0))
    return np.asarray(away)


def _to_wall(body: Body, wall: Wall) -> Callable[[Real], Real]:
    """How far points (n, 3) lie from a wall, each within the plane of its height; no farther than beyond a chamfer."""
    profile = body.loop_profile(wall.lower)
    far = max(float(np.abs(np.diff(s.curve.point(np.linspace(*s.curve.domain, _SAMPLES)))).max())
              for s in profile.period)  # fmt: skip
    if profile.count > 1:
        # what overhangs belongs to the period beside
        far = max(far, profile.reach() * abs(profile.pitch_angle))

    def distance(points: Real) -> Real:
        if not body.is_chamfer(wall):
            return _to_profiles([body.moved_back(wall, points)], [profile], far)[0]
        places, heights = points[:, 0] + 1j * points[:, 1], np.round(points[:, 2], _LEVEL_DIGITS)
        levels = np.clip(heights, *body.height(wall))
        found = np.abs(heights - levels)
        beside = np.flatnonzero(found < _BEYOND)
        each, own = np.unique(levels[beside], return_inverse=True)
        mine = [beside[own == k] for k in range(len(each))]
        sections = [body.standing(wall, z) for z in each.tolist()]
        for rows, away in zip(mine, _to_profiles([places[rows] for rows in mine], sections, far), strict=True):
            found[rows] = np.hypot(found[rows], away)
        return found

    return distance


def _to_profiles(places: Sequence[Complex], profiles: Sequence[Profile], far: float) -> list[Real]:
    """How far places (n,) lie from their profiles, mm; what is ``far`` lies on no curve and is not told so well."""
    found = distance_to_own(places, profiles, trusted=math.inf)
    doubtful = [np.flatnonzero((x > _ON) & (x < far)) for x in found]
    thorough = distance_to_own([x[k] for x, k in zip(places, doubtful, strict=True)], profiles)
    for own, rows, better in zip(found, doubtful, thorough, strict=True):
        own[rows] = better
    return found


def _moments(body: Body, holes: Sequence[CrossHole]) -> Moments:
    """Those of the body less those of its holes, by sums about each: what they sum is periodic."""
    own = body_moments(body)
    volume, first = own.volume, own.volume * own.centre
    second = np.trace(own.inertia) / 2 * np.eye(3) - own.inertia
    turns = math.pi * (np.arange(_AROUND) / _AROUND - 0.5)
    for hole in holes:
        across, high = hole.radius * np.sin(turns), 2 * hole.radius * np.cos(turns)
        outer, inner = (mouth.rise(across) for mouth in mouths_of(body, hole) if mouth is not None)
        weight = high * hole.radius * np.cos(turns) * math.pi / _AROUND
        length, square, cube = ((outer**k - inner**k) / k for k in (1, 2, 3))
        lost = float(weight @ length)
        axes = np.array([[-math.sin(hole.angle), math.cos(hole.angle), 0.0],
                         [math.cos(hole.angle), math.sin(hole.angle), 0.0], [0.0, 0.0, 1.0]])  # fmt: skip
        moved = axes.T @ np.array([0.0, weight @ square, 0.0])
        tensor = np.diag([weight @ (across**2 * length), weight @ cube, weight @ (high**2 * length) / 12])
        up = hole.height * axes[2]
        volume -= lost
        first = first - moved - lost * up
        second = second - axes.T @ tensor @ axes - np.outer(moved, up) - np.outer(up, moved) - lost * np.outer(up, up)
    return Moments(volume, first / volume, np.trace(second) * np.eye(3) - second)
