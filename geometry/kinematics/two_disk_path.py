"""Rows of both angles by which the platform of a power module follows lines and arcs, within a stated error.

::

    rows = followed(TwoDisk(), [Line(-50 + 0j, 50 + 0j)], 0.01)     # through the centre without a jump
    table.drives(rows.delta, rows.beta)                              # turns of both worms, row by row
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from geometry.base.errors import ParameterError
from geometry.base.record import Draft, Record, field
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import Arc, Line
from geometry.kinematics.two_disk import TwoDisk

Piece = Line | Arc
# nearer to O1 than this share of the reach a path goes through it; its pieces meet this well, mm
_CENTRE, _JOINT = 1e-12, 1e-6
# a piece is halved at most so often, and begins with so many parts
_HALVINGS, _PARTS = 60, 4


class Followed(Record):
    """Rows of a path: ``place`` (mm), ``delta`` and ``beta`` (rad, without a jump), ``way`` along the path (mm).

    ``error``: while both drives run evenly from one row to the next, O3 stays this near to the path, mm.
    """

    place: Complex
    delta: Real
    beta: Real
    way: Real
    error: float


def followed(
    table: TwoDisk, path: Sequence[Piece], tolerance: float, elbow: int = 1, start: float | None = None
) -> Followed:
    """The rows by which O3 follows pieces, one behind the other, within ``tolerance`` (mm).

    Where the path goes through O1 or touches a singular circle the elbow changes, so that neither disk jumps nor turns
    back; where it leaves O1 in a direction that disk 2 does not have, disk 2 is turned on the spot, with both drives.
    ``start``: delta before the first row, of which whole turns are kept, and from which a path that begins at O1 turns.

    Raises
    ------
    ParameterError
        A point is out of reach, or a piece (``path[k]``, k from 1) begins where none ends.
    """
    rows = _Rows(elbow, 0.0 if start is None else start)
    for number, piece in enumerate(path, 1):
        begin = complex(piece.point(piece.domain[0]))
        if number > 1 and abs(begin - rows.end) > _JOINT:
            raise ParameterError(f"path[{number}]", number, "pieces_part", None, x=begin.real, y=begin.imag)
        for low, high in pairwise(_nodes(table, piece)):
            rows.run(table, piece, (low, high), tolerance, turns=number > 1 or start is not None)
        rows.end = complex(piece.point(piece.domain[1]))
    return rows.all()


class _Rows(Draft):
    """The rows so far; ``side``: the elbow's sign, ``last``: delta, ``bent``: beta, ``end``: of the last piece."""

    side: int
    last: float
    bent: float = 0.0
    end: complex = 0j
    columns: list[tuple[Any, ...]] = field(default_factory=list)
    way: float = 0.0
    error: float = 0.0

    def run(self, table: TwoDisk, piece: Piece, span: tuple[float, float], tolerance: float, *, turns: bool) -> None:
        """The rows of one part of a piece, with O1 at its ends at most."""
        least, most = table.reach
        begin = abs(complex(piece.point(span[0])))
        if self.columns and (most - begin <= _CENTRE * most or 0 <= begin - least <= _CENTRE * most < least):
            self.side = -self.side
        if begin <= _CENTRE * most:
            # both signs of beta lead away from O1: the one that disk 2 is nearer to
            leaving = [_leaving(piece, span[0], side) for side in (1, -1)]
            off = [abs(math.remainder(way - self.last, 2 * math.pi)) for way in leaving]
            if self.columns or turns:
                self.side = 1 if off[0] < off[1] else -1
            turned = self.last + math.remainder(leaving[0 if self.side > 0 else 1] - self.last, 2 * math.pi)
            if turns and abs(turned - self.last) > 1e-9:
                delta = np.array([turned] if self.columns else [self.last, turned])
                still = np.zeros(len(delta))
                self.columns.append((still + 0j, delta, still + self.bent, still + self.way))
            self.last = turned
        at, error = _refined(table, piece, span, self.side, tolerance)
        place, delta, beta = _angles(table, piece, at, self.side)
        delta, beta = _going_on(delta, self.last), _going_on(beta, self.bent)
        way = np.abs(piece.derivative(at)) * (at - at[0])
        skipped = 1 if self.columns else 0
        self.columns.append((place[skipped:], delta[skipped:], beta[skipped:], self.way + way[skipped:]))
        self.last, self.bent, self.way = float(delta[-1]), float(beta[-1]), self.way + float(way[-1])
        self.error = max(self.error, error)

    def all(self) -> Followed:
        """As one."""
        place, delta, beta, way = (np.concatenate(column) for column in zip(*self.columns, strict=True))
        return Followed(place, delta, beta, way, self.error)


def _going_on(angles: Real, last: float) -> Real:
    """Without a jump, from a whole number of turns on that is nearest to the last one."""
    angles = np.unwrap(angles)
    return np.asarray(angles + 2 * math.pi * round((last - angles[0]) / (2 * math.pi)))


def _nodes(table: TwoDisk, piece: Piece) -> list[float]:
    """Where a piece is cut before it is refined: its ends, evenly, and where it is nearest to and farthest from O1."""
    begin, end = piece.domain
    found = {begin + (end - begin) * k / _PARTS for k in range(_PARTS + 1)}
    if isinstance(piece, Line):
        chord = piece.end - piece.start
        found.add(-(piece.start.conjugate() * chord).real / abs(chord) ** 2)
    else:
        sense = math.copysign(1.0, piece.sweep)
        towards = cmath.phase(piece.centre) - piece.start_angle
        found |= {(sense * (towards + k * math.pi)) % (2 * math.pi) + 2 * math.pi * m for k in (0, 1) for m in (0, -1)}
    inside = sorted(t for t in found if begin <= t <= end)
    merged = inside[:1]
    for t in inside[1:]:
        # of two that are one by rounding: the end, or the one that is O1
        if t - merged[-1] > 1e-12 * (end - begin):
            merged.append(t)
        elif t == end or abs(complex(piece.point(t))) <= _CENTRE * table.reach[1]:
            merged[-1] = t
    return merged


def _leaving(piece: Piece, at: float, side: int, way: int = 1) -> float:
    """delta as the path leaves O1, or (``way`` -1) comes to it."""
    tangent = way * complex(piece.derivative(at))
    return math.atan2(tangent.real, tangent.imag) - side * math.pi / 2


def _angles(table: TwoDisk, piece: Piece, at: Real, side: int) -> tuple[Complex, Real, Real]:
    """Points, delta and beta; O1 as the limit along the path."""
    place = np.asarray(piece.point(at))
    near = np.abs(place) <= _CENTRE * table.reach[1]
    place = np.where(near, 0, place)
    delta, beta = table.inverse(place, side)
    for k in np.flatnonzero(near & (table.reach[0] == 0)):
        delta[k] = _leaving(piece, float(at[k]), side, 1 if k == 0 else -1)
    return place, delta, beta


def _refined(
    table: TwoDisk, piece: Piece, span: tuple[float, float], side: int, tolerance: float
) -> tuple[Real, float]:
    """Parameters of rows on a part of a piece, and the error between them.

    Between two rows both angles run evenly, so that O3'' is at most L1 phi2'^2 + L2 phi3'^2, which bounds how far it
    is from its chord; the chord is as far from an arc as its sagitta.
    """
    at = np.array(span)
    first, second = table.arms
    for _ in range(_HALVINGS):
        _, delta, beta = _angles(table, piece, at, side)
        turn = np.abs(np.remainder(np.diff(delta) + math.pi, 2 * math.pi) - math.pi)
        other = np.abs(np.remainder(np.diff(beta - delta) + math.pi, 2 * math.pi) - math.pi)
        bent = piece.radius if isinstance(piece, Arc) else 0.0
        error = (first * turn**2 + second * other**2 + bent * np.diff(at) ** 2) / 8
        wide = np.flatnonzero(error > tolerance)
        if not wide.size:
            return at, float(error.max())
        at = np.insert(at, wide + 1, (at[wide] + at[wide + 1]) / 2)
    raise ParameterError("tolerance", tolerance, "path_too_near_centre", None, least=float(error.max()))
