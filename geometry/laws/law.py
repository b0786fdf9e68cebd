"""A law of motion: lift 0 to 1 over the phase's share 0 to 1, in analytic pieces."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.record import Record
from geometry.laws.piece import LawPiece, Real

# jumps below this part of the greatest acceleration are rounding
_SMOOTH = 1e-9
# velocity and acceleration
Rates = tuple[float, float]
AT_REST: Rates = (0.0, 0.0)
# what the name of a law that is run backwards ends in
REVERSED = ", reversed"


class Law(Record):
    """Pieces that follow each other from u = 0 to 1, with s(0) = 0 and s(1) = 1.

    A follower's S over a phase of angle phi and lift H is H s(u), u = k of the tables (share of the phase); its
    derivatives are H/phi s', H/phi^2 s'', H/phi^3 s'''.
    """

    name: str
    pieces: tuple[LawPiece, ...]

    def value(self, u: ArrayLike, order: int = 0) -> Real:
        """s or its derivative at ``u``, of its shape; at an inner joint the value from the right."""
        return piecewise_value(self.pieces, np.asarray(u, dtype=float), order)

    def peak(self, order: int) -> tuple[float, float]:
        """The greatest |s^(order)| (finite part) and the u at which it stands."""
        best, where = 0.0, 0.0
        for piece in self.pieces:
            at = piece.extremes(order)
            size = np.abs(piece.value(at, order))
            index = int(np.argmax(size))
            if size[index] > best * (1 + 1e-12):
                best, where = float(size[index]), float(at[index])
        return best, where

    def jerk(self, before: Rates = AT_REST, after: Rates = AT_REST) -> float:
        """C_j, the greatest |s^(3)|: infinite where velocity or acceleration jumps (VDI 2143).

        ``before`` and ``after``: s' and s'' of the motion that it joins at either end, in its own units. Where the law
        itself ends without them, a jump there is that motion's.
        """
        first, last = self.pieces[0], self.pieces[-1]

        def rates(piece: LawPiece, at: float) -> Rates:
            return float(piece.value(at, 1)), float(piece.value(at, 2))

        met = [(rates(a, a.end), rates(b, b.start)) for a, b in pairwise(self.pieces)]
        ends = [(rates(first, first.start), before), (rates(last, last.end), after)]
        smooth = _SMOOTH * max(1.0, self.peak(2)[0])
        jumps = [abs(a - b) for pair in met for a, b in zip(*pair, strict=True)]
        jumps += [abs(own - other) for pair in ends for own, other in zip(*pair, strict=True) if abs(own) > smooth]
        return math.inf if max(jumps, default=0.0) > smooth else self.peak(3)[0]

    def reversed_in_time(self) -> Law:
        """The law run backwards and upside down, 1 - s(1 - u): first and last half exchanged."""
        pieces = []
        for piece in reversed(self.pieces):
            back = piece.reversed_in_time().placed(0.0, 1.0, 1.0, -1.0)
            pieces.append(back.spanning(1.0 - piece.end, 1.0 - piece.start))
        return Law(f"{self.name}{REVERSED}", tuple(pieces))


def piecewise_value(pieces: tuple[LawPiece, ...], t: Real, order: int) -> Real:
    """Value of a chain of pieces; arguments beyond its ends take the first or the last formula."""
    if len(pieces) == 1:
        return pieces[0].value(t, order)
    inner = np.array([p.start for p in pieces[1:]])
    index = np.searchsorted(inner, t, side="right")
    result = np.empty(np.shape(t))
    for k, piece in enumerate(pieces):
        mine = index == k
        if np.any(mine):
            result[mine] = piece.value(t[mine], order)
    return result
