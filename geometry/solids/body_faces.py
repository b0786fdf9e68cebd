"""The faces of a body from the finished curves of its profiles: neighbours share their edges, so the shell is closed.

Arcs become true circles (so tip, root and bore are cylinders), splines keep their poles and knots, and what stands on
every tooth is one bundle of faces.
"""

from __future__ import annotations

from collections.abc import Container, Sequence
from functools import partial
from itertools import pairwise

import numpy as np

from geometry.approximation.chamfered import Sections, chamfered_outlines, pieces_needed
from geometry.approximation.outline import Outline, spline_outline
from geometry.curves.bspline import BSpline
from geometry.curves.curve import Complex
from geometry.curves.line_arc import Arc, Line
from geometry.plane.measure import profile_area
from geometry.plane.profile import Profile
from geometry.solids.body import Body, Cap, Wall
from geometry.solids.chamfer import cut_chamfers, even_shares, openings
from geometry.solids.faces import Loop, Solid
from geometry.solids.rings import Ring, RingBuilder, spatial
from geometry.solids.screw import cut_twists, heights, turn_error, turn_spans, turn_spline, with_turn_error

# rad, and part of a radius, what is one direction and one centre
_SAME = 1e-9
# files pay by the pole
_DEGREE = 7


def body_outlines(body: Body, tolerance: float) -> tuple[Outline, ...]:
    """Every profile of a body as finished curves within ``tolerance`` mm, on screw surfaces over them too."""
    body = cut_for_faces(body)
    twisted = body.twisted_profiles()
    made = _chamfered_outlines(body, tolerance, twisted)
    for index, profile in enumerate(body.profiles):
        if index in made:
            continue
        turned = index in twisted
        own = tolerance - 2 * turn_error(profile.reach()) if turned else tolerance
        outline = spline_outline(profile, own, degree=_DEGREE, continuity=_DEGREE - 1, turned=turned)
        made[index] = with_turn_error(outline, profile.reach()) if turned else outline
    return tuple(made[i] for i in range(len(body.profiles)))


def _chamfered_outlines(body: Body, tolerance: float, twisted: Container[int]) -> dict[int, Outline]:
    """The outlines of profiles that chamfers join, each whole one with its ends; some are those of screw surfaces."""
    # the pieces of a chamfer by the profiles where they begin and end
    pieces: dict[int, dict[int, Sections]] = {}
    for wall, whole, end in body.chamfers():
        own = partial(body.section_at, wall, whole, end)
        pieces.setdefault(body.loops[whole].profile, {}).setdefault(body.loops[end].profile, own)
    ends = {end for found in pieces.values() for end in found}
    made: dict[int, Outline] = {}
    for index in sorted(pieces.keys() - ends):
        indices, chamfers = [index], []
        for end, sections in pieces[index].items():
            chamfers.append([sections])
            indices.append(end)
            while indices[-1] in pieces:
                ((end, sections),) = pieces[indices[-1]].items()
                chamfers[-1].append(sections)
                indices.append(end)
        profile, turned = body.profiles[index], index in twisted
        near = tolerance - 2 * turn_error(profile.reach()) if turned else tolerance
        bent = turned or any(_bends(profile, body.profiles[end]) for end in indices[1:])
        outlines = chamfered_outlines(profile, chamfers, near, degree=_DEGREE, turned=bent)
        if turned:
            outlines = (with_turn_error(outlines[0], profile.reach()), *outlines[1:])
        made |= dict(zip(indices, outlines, strict=True))
    return made


def _bends(whole: Profile, end: Profile) -> bool:
    """Whether lines turn or centres of arcs move from a boundary to the end of its walls, as on crowned teeth."""
    for one, other in ((a.curve, b.curve) for a, b in zip(whole.period, end.period, strict=True)):
        if isinstance(one, Line) and isinstance(other, Line):
            way, after = (line.end - line.start for line in (one, other))
            if abs((way.conjugate() * after).imag) > _SAME * abs(way) ** 2:
                return True
        elif isinstance(one, Arc) and isinstance(other, Arc) and abs(one.centre - other.centre) > _SAME * one.radius:
            return True
    return False


def cut_for_faces(body: Body) -> Body:
    """The body with pieces of chamfers and of screw surfaces that one face each can follow."""

    def pieces(wall: Wall, whole: int, end: int) -> list[float]:
        opens, growing = openings(body, wall, whole, end), partial(even_shares, opens=0.0)
        cuts: list[float] = []
        for low, high in pairwise(sorted({0.0, *opens, 1.0})):
            # beside a cusp an edge runs as from it
            ways = (growing, even_shares) if low in opens else (even_shares, growing)
            cuts += pieces_needed(partial(body.section_at, wall, whole, end), (low, high), *ways)
        return cuts

    return cut_twists(cut_chamfers(body, pieces))


def body_solid(body: Body, outlines: Sequence[Outline]) -> Solid:
    """The faces of a body over the finished curves of its profiles."""
    made = BodyFaces(cut_for_faces(body), outlines)
    for wall in made.body.walls:
        made.wall(wall)
    for cap in made.body.caps:
        made.face(cap)
    return made.solid()


class BodyFaces(RingBuilder):
    """Rings, walls and caps of one body."""

    def __init__(self, body: Body, outlines: Sequence[Outline]) -> None:
        super().__init__()
        self.body, self.outlines = body, outlines
        self.known: dict[int, Ring] = {}

    def at(self, loop: int) -> Ring:
        """The ring of a loop, made once."""
        if loop not in self.known:
            place = self.body.loops[loop]
            self.known[loop] = self.ring(self.outlines[place.profile], place.z, place.turn, place.shift)
        return self.known[loop]

    def wall(self, wall: Wall) -> None:
        """The faces of a wall between its two rings."""
        body, height = self.body, self.body.height(wall)
        lower, upper = self.at(wall.lower), self.at(wall.upper)
        if body.is_chamfer(wall):
            grids = self._chamfer_poles(wall, lower, upper)
            degree = grids[0].shape[1] - 1
            along = BSpline(degree, np.repeat([0.0, 1.0], degree + 1), np.zeros(degree + 1, complex))
            self.ruled(lower, upper, height, along, np.linspace(*height, degree + 1), grids)
        elif twist := body.twist(wall):
            turn = turn_spline(twist, turn_spans(twist, body.loop_profile(wall.lower).reach()))
            starts = (c.poles if isinstance(c, BSpline) else np.array([c.point(c.domain[0])]) for c in lower.curves)
            self.ruled(lower, upper, height, turn, heights(turn, *height), [s[:, None] * turn.poles for s in starts])
        else:
            self.swept(lower, upper, spatial(np.array([body.shear(wall)]), height[1] - height[0]))

    def _chamfer_poles(self, wall: Wall, lower: Ring, upper: Ring) -> list[Complex]:
        """The poles of each face of a chamfer from its lower to its upper ring."""
        ends = [self.outlines[self.body.loops[loop].profile] for loop in (wall.lower, wall.upper)]
        if ends[0].is_circle:
            return [np.array([[complex(ring.curves[0].point(0.0)) for ring in (lower, upper)]])]
        # the end of a chamfer has its faces' poles, from the whole boundary on
        if next(whole for own, whole, _ in self.body.chamfers() if own is wall) == wall.upper:
            return [grid[:, ::-1] for grid in ends[0].faces]
        return list(ends[1].faces)

    def face(self, cap: Cap) -> None:
        """A plane face within its rings."""
        loops = [self.around(cap.outer, cap.up), *(self.around(hole, not cap.up) for hole in cap.holes)]
        self.cap(self.body.loops[cap.outer].z, loops, up=cap.up)

    def around(self, loop: int, left: bool) -> Loop:
        """A ring as a loop that turns left, or right, as seen from above."""
        return self.at(loop).loop(forwards=(profile_area(self.body.loop_profile(loop)) > 0) == left)
