"""The graphical method of the practicum: an acceleration diagram integrated twice by its mid-ordinates.

Lessons 4 and 5, sections 3.1 to 3.3: each moving phase is divided into 8 equal parts (figures 4.5, 5.1); the
ordinates of S'' at their middles, carried to the pole, are the slopes of a broken line (figures 4.6, 5.2); its points,
joined by a smooth curve, are S', which is integrated in the same way (figures 4.7, 5.3). The scale follows from the
stroke, mu_S = H / y_max by (4.2), and those of S' and S'' from it by (4.3) and (4.4): whatever both integrations have
lost, the last ordinate is H, and S' and S'' carry the error. Lengths of paper and pole distances cancel out.

The smooth curve through the points of S' is the one whose slopes there are the ordinates of S'': the "method of chords
and tangents" of the lessons' section 1.1. With ``chords`` the broken line itself is integrated.
"""

from __future__ import annotations

import math
from enum import StrEnum

import numpy as np

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.record import Record
from geometry.cams.motion.follower_motion import FollowerMotion, PhaseKind
from geometry.cams.motion.guides import Translating
from geometry.cams.plane.disk import DiskCam
from geometry.curves.curve import Complex, Real
from geometry.laws.law import Law
from geometry.plane.measure import distance_to_curves

# parts of a phase in the lessons, figures 4.5 and 5.1
INTERVALS = 8
# the least number that shows a rise, and more than anyone draws
LEAST_INTERVALS, MOST_INTERVALS = 2, 72
# a velocity that jumps by more than this part of lift / phase is a rigid impact
_JUMP = 1e-9


class Drawing(StrEnum):
    """What is drawn through the points of S': the smooth curve with their tangents, or the broken line."""

    SMOOTH = "smooth"
    CHORDS = "chords"


class GraphicalPhase(Record):
    """A rise or return as it comes out on paper; every array over the n intervals or their n + 1 ends.

    ``first``: number of its first position; ``angles`` rad; ``middles``: ordinates of S'' at the middles, mm/rad^2, and
    ``rate_middles`` of S', mm/rad; ``bend``: (n, 2), S'' at both ends of each interval, seen from inside; ``rate``: S',
    mm/rad; ``lift``: S, mm (rad in place of mm if oscillating). ``factor``: by how much (4.2) has stretched the scales.
    """

    kind: PhaseKind
    law: str
    first: int
    angles: Real
    middles: Real
    rate_middles: Real
    bend: Real
    rate: Real
    lift: Real
    factor: float


class GraphicalMotion(Record):
    """All moving phases of a cam by the graphical method, and the exact motion they stand for."""

    motion: FollowerMotion
    phases: tuple[GraphicalPhase, ...]
    intervals: int

    def errors(self, order: int) -> Real:
        """S (order 0) or S' (1) by the drawing less the exact ones, at all ends of intervals, one phase after another.

        At the ends of a phase the exact value is the one inside of it.
        """
        rows = []
        for phase in self.phases:
            inside = phase.angles.copy()
            inside[-1] = np.nextafter(inside[-1], 0)
            drawn = phase.lift if order == 0 else phase.rate
            rows.append(drawn - self.motion.value(inside, order))
        return np.concatenate(rows)


_CODES = {"table": "table_has_no_diagram", "rests": "rests_all_turn", "rigid": "law_with_rigid_impact"}


def graphical_hindrance(motion: FollowerMotion) -> tuple[str, str] | None:
    """What keeps a motion from being integrated on paper (table, rests, rigid), and the law that does; else None."""
    if not motion.phases:
        return "table", ""
    if all(phase.law is None for phase in motion.phases):
        return "rests", ""
    for phase in motion.phases:
        law = phase.law
        if law is None:
            continue
        starts = np.array([p.start for p in law.pieces])
        left = [0.0, *(float(p.value(p.end, 1)) for p in law.pieces[:-1])]
        right = [float(p.value(p.start, 1)) for p in law.pieces]
        if max(abs(a - b) for a, b in zip(left, right, strict=True)) > _JUMP * len(starts):
            return "rigid", law.name
    return None


def graphical_motion(
    motion: FollowerMotion, intervals: int = INTERVALS, drawing: Drawing = Drawing.SMOOTH
) -> GraphicalMotion:
    """Both integrations of every moving phase: practicum, section 3.1 of lessons 4 and 5.

    Raises
    ------
    ParameterError
        A number of intervals out of range or too few to raise anything, or a motion with rigid impacts or from a table.
    """
    if not LEAST_INTERVALS <= intervals <= MOST_INTERVALS:
        nearest = limit(min(max(intervals, LEAST_INTERVALS), MOST_INTERVALS), intervals)
        raise ParameterError(
            "intervals", intervals, "out_of_range", nearest, least=LEAST_INTERVALS, most=MOST_INTERVALS
        )
    if (found := graphical_hindrance(motion)) is not None:
        raise ParameterError("phases", None, _CODES[found[0]], law=found[1])

    def raises(count: int) -> bool:
        laws = {phase.law for phase in motion.phases if phase.law is not None}
        return all(_summed(law, count, drawing).lift[-1] > 0 for law in laws)

    if not raises(intervals):
        works = next(filter(raises, range(intervals + 1, MOST_INTERVALS + 1)), None)
        cure = None if works is None else Nearest(works)
        raise ParameterError("intervals", intervals, "mid_ordinates_raise_nothing", cure)
    phases: list[GraphicalPhase] = []
    at, height, position = 0.0, 0.0, 0
    for index, phase in enumerate(motion.phases):
        last = index == len(motion.phases) - 1
        end = 2 * math.pi if last else at + phase.angle
        if phase.law is not None:
            drawn, step = _summed(phase.law, intervals, drawing), end - at
            # all of it stretched so that the last ordinate is 1, (4.2)
            factor = 1 / float(drawn.lift[-1])
            way = factor * phase.lift
            phases.append(
                GraphicalPhase(
                    phase.kind,
                    phase.law.name,
                    position,
                    np.linspace(at, end, intervals + 1),
                    drawn.middles * way / step**2,
                    drawn.rate_middles * way / step,
                    drawn.bend * way / step**2,
                    drawn.rate * way / step,
                    height + drawn.lift * way,
                    factor,
                )
            )
        position += 1 if phase.law is None else intervals
        at, height = end, height + phase.lift
    return GraphicalMotion(motion, tuple(phases), intervals)


class _Drawn(Record):
    """A phase of length 1, of a stroke as it comes."""

    middles: Real
    rate_middles: Real
    bend: Real
    rate: Real
    lift: Real


def _summed(law: Law, n: int, drawing: Drawing) -> _Drawn:
    """Mid-ordinates summed twice."""
    # at a jump the middle of its vertical line
    middles = np.array([(_limit(law, (i + 0.5) / n, -1) + _limit(law, (i + 0.5) / n, 1)) / 2 for i in range(n)])
    bend = np.array([(_limit(law, i / n, 1), _limit(law, (i + 1) / n, -1)) for i in range(n)])
    rate = np.concatenate([[0.0], np.cumsum(middles)]) / n
    halves = (rate[:-1] + rate[1:]) / 2
    if drawing is Drawing.SMOOTH:
        # the middle of the cubic through two points with their tangents
        halves = halves + (bend[:, 0] - bend[:, 1]) / (8 * n)
    lift = np.concatenate([[0.0], np.cumsum(halves)]) / n
    return _Drawn(middles, halves, bend, rate, lift)


def _limit(law: Law, u: float, side: int) -> float:
    """s'' beside ``u``: on its right (1) or left (-1); differs at a jump only."""
    pieces = law.pieces
    if side > 0:
        piece = next((p for p in pieces if u < p.end - 1e-12), pieces[-1])
    else:
        piece = next((p for p in reversed(pieces) if u > p.start + 1e-12), pieces[0])
    return float(piece.value(u, 2))


def graphical_flat_radius(drawn: GraphicalMotion) -> float:
    """r_0 by the tangent at 45 degrees to the drawn diagram S(S''), mm: lesson 4, section 3.2, figure 4.9."""
    best = 0.0
    for phase in drawn.phases:
        ends = -(phase.bend + np.stack([phase.lift[:-1], phase.lift[1:]], axis=1))
        for run in _runs(ends):
            best = max(best, _touch(run))
    return best


def graphical_prime_radius(
    drawn: GraphicalMotion, offset: float, rise_limit: float, return_limit: float | None = None
) -> float:
    """r_0 by the tangent at gamma_min = 90 degrees - ``rise_limit`` (rad) to the drawn diagram S(S'), mm.

    Lesson 5, section 3.2, figure 5.6: O'_1 stands on the axis S' that is moved by E; of a rise only (force closure),
    unless returns have a limit too.
    """
    limits = {PhaseKind.RISE: rise_limit, PhaseKind.RETURN: return_limit}
    height = 0.0
    for phase in drawn.phases:
        if (limit := limits.get(phase.kind)) is not None:
            for side in (1 / math.tan(limit), -1 / math.tan(limit)):
                height = max(height, _touch(side * phase.rate - phase.lift) - offset * side)
    return math.hypot(offset, height)


def _runs(ends: Real) -> list[Real]:
    """Values at both ends of intervals as chains, broken where neighbours do not agree."""
    chains: list[list[float]] = []
    for left, right in ends.tolist():
        if chains and math.isclose(chains[-1][-1], left, rel_tol=1e-9, abs_tol=1e-12):
            chains[-1].append(right)
        else:
            chains.append([left, right])
    return [np.array(c) for c in chains]


def _touch(values: Real) -> float:
    """The greatest value of a smooth curve through points: that of the parabola through the best and its neighbours."""
    k = int(np.argmax(values))
    if k in (0, len(values) - 1):
        return float(values[k])
    before, best, after = values[k - 1 : k + 2]
    bow = 2 * best - before - after
    return float(best + (before - after) ** 2 / (8 * bow)) if bow > 0 else float(best)


def graphical_profile(cam: DiskCam, drawn: GraphicalMotion) -> Complex:
    """Points of the profile by inversion (section 3.3, figures 4.11, 5.7), one at each position, cam's frame, mm.

    The cam's own base circle with the drawn S and S': the point where the follower of that position touches, whose
    direction the drawn S' tells.
    """
    found = [cam.touched([phase.lift, phase.rate]) * np.exp(-1j * phase.angles) for phase in drawn.phases]
    return np.concatenate(found)


def graphical_profile_error(cam: DiskCam, drawn: GraphicalMotion) -> float:
    """The greatest distance of the drawn profile's points from the exact cam of the same base circle, mm."""
    curves = [cam.curve(piece) for piece in cam.motion.pieces if not piece.is_constant]
    return float(distance_to_curves(graphical_profile(cam, drawn), curves).max())


def graphical_radius(
    cam: DiskCam, drawn: GraphicalMotion, rise_limit: float | None, return_limit: float | None = None
) -> tuple[float, float] | None:
    """r_0 by the drawing and exactly, mm; None of an oscillating cam, or of a roller without a limit (rad)."""
    from geometry.cams.plane.synthesis import flat_base_radius, roller_prime_radius

    if not isinstance(cam.mount, Translating):
        return None
    if cam.is_flat:
        return graphical_flat_radius(drawn), flat_base_radius(cam.motion).value
    if rise_limit is None or not cam.motion.moving_pieces(PhaseKind.RISE):
        return None
    limits = cam.mount.offset, rise_limit, return_limit
    return graphical_prime_radius(drawn, *limits), roller_prime_radius(cam.motion, *limits)
