"""The motion of a follower over a whole turn of the cam: phases, each with its own law, or an imported table."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from enum import StrEnum
from functools import cached_property, lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.record import Record
from geometry.laws.law import Law, piecewise_value
from geometry.laws.piece import LawPiece, Real
from geometry.laws.splines import cubic_pieces
from geometry.laws.stack import Indices, PieceStack

TURN = 2 * math.pi
# phases typed in degrees close to this many rad; smaller gaps are spread over the last phase
_CLOSING = 1e-9
# jumps below this part of lift / angle^k are rounding
_JUMP = 1e-9
# lowest places of the follower below this part of its travel are rounding
_ROUNDING = 1e-12


class PhaseKind(StrEnum):
    """What the follower does in a phase."""

    RISE = "rise"
    RETURN = "return_"
    DWELL = "dwell"


class Phase(Record):
    """Cam angle (rad), change of lift (mm, or rad of an oscillating follower; negative: return), and its law."""

    angle: float
    lift: float = 0.0
    law: Law | None = None

    @property
    def kind(self) -> PhaseKind:
        """Rise, return or dwell, by the sign of the lift."""
        if self.lift == 0:
            return PhaseKind.DWELL
        return PhaseKind.RISE if self.lift > 0 else PhaseKind.RETURN


def rise(angle: float, lift: float, law: Law) -> Phase:
    """The follower moves away from the axis by ``lift`` while the cam turns by ``angle``, rad."""
    return Phase(angle, abs(lift), law)


def dwell(angle: float) -> Phase:
    """The follower rests, far or near."""
    return Phase(angle)


def return_(angle: float, lift: float, law: Law) -> Phase:
    """The follower comes back by ``lift``: S = S_before - lift s(u)."""
    return Phase(angle, -abs(lift), law)


class Joint(Record):
    """What happens at one cam angle between two pieces: the jumps of S, S', S'', S''' (right minus left).

    ``continuity`` is the order up to which all derivatives go on (at most 3); 0 is a rigid impact, 1 a soft one.
    """

    angle: float
    jumps: tuple[float, float, float, float]
    continuity: int

    @property
    def impact(self) -> str | None:
        """ "rigid": velocity jumps; "soft": acceleration jumps; else None."""
        return {-1: "rigid", 0: "rigid", 1: "soft"}.get(self.continuity)


class PieceMotion:
    """S over the way of a cam that turns (rad) or slides (mm): analytic pieces one behind the other."""

    __slots__ = ()
    pieces: tuple[LawPiece, ...]

    def value(self, way: ArrayLike, order: int = 0) -> Real:
        """S (order 0) or its derivative over the cam's way; at a joint the value from the right."""
        return piecewise_value(self.pieces, np.asarray(way, dtype=float), order)

    def values(self, t: Real, order: int) -> list[Real]:
        """S, S' ... S^(order)."""
        return [self.value(t, k) for k in range(order + 1)]

    def bounds(self, order: int, a: Real, b: Real) -> list[Real]:
        """None are known for the whole way: ask the pieces."""
        return [np.full(np.shape(a), np.inf)] * (order + 1)

    def extremes(self, order: int = 0) -> tuple[float, float]:
        """Least and greatest S^(order) (finite parts)."""
        found = [p.value(p.extremes(order), order) for p in self.pieces]
        return float(min(v.min() for v in found)), float(max(v.max() for v in found))

    @property
    def lift(self) -> float:
        """H: greatest minus least S."""
        low, high = self.extremes()
        return high - low

    @property
    def starts_lowest(self) -> bool:
        """Whether the follower is never below its place at cam angle 0: the base circle is the least of the cam."""
        return abs(self.extremes()[0]) <= _ROUNDING * self.lift

    def joints(self) -> tuple[Joint, ...]:
        """Every joint of two pieces; the first stands between the last piece and the first."""
        return _joints(self.pieces)

    def impacts(self) -> list[Joint]:
        """Joints with a rigid or soft impact."""
        return [j for j in self.joints() if j.impact]


class FollowerMotion(PieceMotion, Record, dict=True):
    """S over the cam angle: analytic pieces from 0 to 2 pi, and the phases they came from (none for a table).

    S is counted from the lowest position that the phases begin with; the cam turns counter-clockwise.
    ``left_rows``: of a smoothed table, how far the motion leaves its rows at most, mm or rad.
    """

    pieces: tuple[LawPiece, ...]
    phases: tuple[Phase, ...] = ()
    left_rows: float | None = None

    @cached_property
    def stack(self) -> PieceStack:
        """The pieces as arrays."""
        return PieceStack(self.pieces)

    @property
    def tabled(self) -> bool:
        """Whether the pieces are the rows of one spline, C2 at every joint."""
        return not self.phases and len(self.pieces) > 1

    def value(self, way: ArrayLike, order: int = 0) -> Real:
        """S (order 0) or its derivative over the cam angle (rad), any angle; at a joint the value from the right."""
        folded = np.mod(np.asarray(way, dtype=float), TURN)
        if len(self.pieces) == 1:
            return self.pieces[0].value(folded, order)
        return self.stack.at(self.stack.index(folded), folded, order)

    def values(self, t: Real, order: int) -> list[Real]:
        """S, S' ... S^(order)."""
        source = self.stack if len(self.pieces) > 1 else self.pieces[0]
        return source.values(np.mod(t, TURN), order)

    def extremes(self, order: int = 0) -> tuple[float, float]:
        """Least and greatest S^(order) (finite parts)."""
        values = self.stack.at(*self.stack.extremes(order), order)
        return float(values.min()), float(values.max())

    def moving_pieces(self, kind: PhaseKind | None = None) -> list[LawPiece]:
        """Pieces that are no dwell; those of rises or returns only where ``kind`` says so (by the sign of S')."""
        return [self.pieces[k] for k in self.moving(kind).tolist()]

    def moving(self, kind: PhaseKind | None = None) -> Indices:
        """The numbers of these pieces."""
        moving = np.array([k for k, p in enumerate(self.pieces) if not p.is_constant], dtype=np.intp)
        if kind is None:
            return moving
        rates = self.stack.at(*self.stack.rows(33), 1)[moving] * (1.0 if kind is PhaseKind.RISE else -1.0)
        return moving[rates.max(axis=1) > _JUMP * np.abs(rates).max(axis=1)]

    def negated(self) -> FollowerMotion:
        """-S: what the counter-follower of a conjugate cam does."""
        phases = tuple(Phase(p.angle, -p.lift, p.law) for p in self.phases)
        return FollowerMotion(tuple(p.placed(0.0, 1.0, 0.0, -1.0) for p in self.pieces), phases)


@lru_cache(maxsize=16)
def _joints(pieces: tuple[LawPiece, ...]) -> tuple[Joint, ...]:
    stack = PieceStack(pieces)
    every = np.arange(len(pieces))
    before = every - 1
    widths = np.array([p.end - p.start for p in pieces])
    length = np.minimum(widths[before], widths)
    jumps, whole, continuity = [], np.ones(len(pieces), dtype=bool), np.full(len(pieces), -1)
    size = 0.0
    for order in range(4):
        # the peaks inside too: laws whose ends are 0 but for rounding have no scale there
        scale = np.abs(stack.at(*stack.extremes(order), order)).max()
        left, right = stack.at(before, stack.ends[before], order), stack.at(every, stack.starts, order)
        # a rounding of S is one of S^(order) over so short a piece
        size = scale if order == 0 else size
        rounding = 1e-15 * size / length**order
        jump = np.where(np.abs(right - left) > _JUMP * scale + rounding, right - left, 0.0)
        whole &= jump == 0
        continuity[whole] = order
        jumps.append(jump.tolist())
    return tuple(
        Joint(start, (a, b, c, d), level)
        for start, a, b, c, d, level in zip(stack.starts.tolist(), *jumps, continuity.tolist(), strict=True)
    )


def follower_motion(phases: Sequence[Phase]) -> FollowerMotion:
    """The motion of phases that follow each other from cam angle 0 and fill one turn.

    Raises
    ------
    ParameterError
        An angle that is not positive, a moving phase without a law, angles that do not make 2 pi, or lifts that do
        not bring the follower back.
    """
    if not phases:
        raise ParameterError("phases", 0, "no_phases")
    for index, phase in enumerate(phases):
        if not phase.angle > 0:
            raise ParameterError(f"phases[{index + 1}].angle", phase.angle, "not_above_zero")
        if phase.lift != 0 and phase.law is None:
            raise ParameterError(f"phases[{index + 1}].law", None, "missing")
    whole = math.fsum(p.angle for p in phases)
    if not abs(whole - TURN) <= _CLOSING:
        given = round(math.degrees(whole), 9)
        raise ParameterError("phases", given, "phases_not_a_turn", whole=given, off=round(abs(given - 360), 9))
    total = math.fsum(p.lift for p in phases)
    scale = max((abs(p.lift) for p in phases), default=0.0)
    if not abs(total) <= 1e-12 * max(scale, 1e-300) and total != 0:
        raise ParameterError("phases", total, "does_not_come_back")
    return FollowerMotion(tuple(pieces_of(phases, (TURN, 0.0))), tuple(phases))


def pieces_of(phases: Sequence[Phase], last: tuple[float, float] | None = None) -> Iterator[LawPiece]:
    """The laws of phases one behind the other, from 0 on; ``last``: where the last one ends, and S there."""
    at, s = 0.0, 0.0
    for index, phase in enumerate(phases):
        end, after = at + phase.angle, s + phase.lift
        if last is not None and index == len(phases) - 1:
            end, after = last
        if phase.law is None:
            yield LawPiece(at, end, (s,))
        else:
            placed = [p.placed(at, end - at, s, after - s) for p in phase.law.pieces]
            edges = [at, *(p.start for p in placed[1:]), end]
            yield from (p.spanning(*span) for p, span in zip(placed, pairwise(edges), strict=True))
        at, s = end, after


def motion_of_table(angles: Sequence[float], lifts: Sequence[float], tolerance: float = 0.0) -> FollowerMotion:
    """A measured or foreign motion: a periodic cubic spline (C2) through lifts at rising cam angles, rad.

    The first point is repeated at one turn after it; a last row that already says so may stand there. ``tolerance``:
    the rows may be left by so much, in their own unit, so that the motion bends least: ``geometry.laws.smoothing``.

    Raises
    ------
    ParameterError
        Fewer than 3 points, angles that do not rise or span more than one turn, a last row that contradicts the
        first, all at one height, or a tolerance within which a follower at rest would stand.
    """
    at, values = np.asarray(angles, dtype=float), np.asarray(lifts, dtype=float)
    key = "motion_table"
    if len(at) < 3 or len(at) != len(values):
        raise ParameterError(key, len(at), "table_too_short")
    if at[0] != 0:
        raise ParameterError(f"{key}[1][1]", math.degrees(at[0]), "table_not_from_zero", Nearest(0.0))
    if (steps := np.diff(at)).min() <= 0:
        row = int(np.argmin(steps)) + 2
        above, given = math.degrees(at[row - 2]), math.degrees(at[row - 1])
        raise ParameterError.beyond(f"{key}[{row}][1]", given, "angles_do_not_rise", above + 1e-6, above=above)
    if abs(at[-1] - TURN) <= _CLOSING:
        if abs(values[-1] - values[0]) > 1e-9 * np.ptp(values):
            first, last = float(values[0]), float(values[-1])
            raise ParameterError(f"{key}[{len(at)}][2]", last, "last_row_not_as_first", Nearest(first))
        if len(at) < 4:
            raise _beyond_turn(key, at, "table_too_short")
        at, values = at[:-1], values[:-1]
    if not at[-1] < TURN:
        raise _beyond_turn(key, at, "table_beyond_turn")
    if not np.ptp(values) > 0:
        raise ParameterError(key, len(values), "table_without_lift")
    left_rows = None
    if tolerance:
        if not tolerance < (most := float(np.ptp(values)) / 2):
            works = limit(most * (1 - 1e-9), tolerance, digits=9)
            raise ParameterError("table_tolerance", tolerance, "rest_within_tolerance", works)
        from geometry.laws.smoothing import smoothed

        rows, values = values, smoothed(at, values, TURN, tolerance)
        left_rows = float(np.abs(rows - values).max())
    closed = cubic_pieces(np.append(at, TURN), np.append(values, values[0]), periodic=True)
    return FollowerMotion(tuple(LawPiece(a, b, c) for a, b, c in closed), left_rows=left_rows)


def _beyond_turn(key: str, at: Real, code: str) -> ParameterError:
    """The refusal of a last row that stands at one turn or beyond it."""
    given = math.degrees(at[-1])
    return ParameterError.beyond(f"{key}[{len(at)}][1]", given, code, 360 * (1 - 1e-9))
