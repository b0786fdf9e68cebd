"""Many analytic pieces as arrays: those of one form are evaluated together, whatever pieces the arguments stand on."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from geometry.base.roots import bracketed_roots
from geometry.laws.piece import LawPiece, Real, powers, sine_derivative

Indices = NDArray[np.intp]
# of pieces, by number, and arguments on them
PieceFunction = Callable[[Indices, Real], Real]
# so many arguments at once: their powers stay in the cache
_BLOCK = 4096
_EXTREME_SAMPLES = 65


class _Form:
    """Pieces with as many coefficients and waves as each other; all is (n,) for n ``rows`` and arguments."""

    __slots__ = ("_angles", "_end", "_factors", "_left", "_start", "_waves", "_width", "degree")

    def __init__(self, pieces: Sequence[LawPiece]) -> None:
        self._start, self._end = (np.array(x) for x in zip(*(p.domain for p in pieces), strict=True))
        self._width = self._end - self._start
        # factors of every derivative so far, and the coefficients of the next one
        self._factors: list[Real] = []
        self._left = np.array([p.coefficients for p in pieces])
        self._waves = list(zip(*(p.waves for p in pieces), strict=True))
        self._angles = [
            (np.array([w.frequency for w in wave]), np.array([w.phase for w in wave])) for wave in self._waves
        ]
        self.degree = len(pieces[0].coefficients) - 1

    def _weights(self, order: int) -> Real:
        """Bernstein coefficients of a derivative times the binomials of its degree: (pieces, degree + 1)."""
        while len(self._factors) <= order:
            last = self._left
            degree = last.shape[1] - 1
            self._factors.append(np.array([float(math.comb(degree, i)) for i in range(degree + 1)]) * last)
            self._left = np.diff(last, axis=1) * (degree / self._width)[:, None] if degree else np.zeros((len(last), 1))
        return self._factors[order]

    def values(self, rows: Indices, t: Real, orders: Sequence[int], *, waves: bool = True) -> list[Real]:
        """Derivatives of several orders, which share their powers."""
        start, end, width = self._start[rows], self._end[rows], self._width[rows]
        local, rest = powers(t, start, end, width, self.degree)
        angles = [rate[rows] * (t - start) + phase[rows] for rate, phase in self._angles] if waves else []
        result = []
        for order in orders:
            some = self._weights(order)
            m = some.shape[1] - 1
            total = np.add.reduce(some[rows].T * local[: m + 1] * rest[m::-1], axis=0)
            for wave, angle in zip(self._waves, angles, strict=False):
                size = np.array([w.amplitude * w.frequency**order for w in wave])[rows]
                total = total + size * sine_derivative(angle, order)
            result.append(total)
        return result

    def bounds(self, order: int, rows: Indices, a: Real, b: Real) -> list[Real]:
        """``LawPiece.bounds``."""
        middle, half = (a + b) / 2, (b - a) / 2
        top = max(order, self.degree)
        values = [np.abs(v) for v in self.values(rows, middle, range(top + 1), waves=False)]
        result = []
        for k in range(order + 1):
            total = np.asarray(sum(values[j] * half ** (j - k) / math.factorial(j - k) for j in range(k, top + 1)))
            for wave, (rate, phase) in zip(self._waves, self._angles, strict=True):
                at = rate[rows] * (middle - self._start[rows]) + phase[rows]
                most = np.abs(sine_derivative(at, k)) + np.abs(rate)[rows] * half
                size = np.array([abs(w.amplitude) * abs(w.frequency) ** k for w in wave])[rows]
                total = total + size * np.minimum(most, 1.0)
            result.append(total * (1 + 1e-12))
        return result


class PieceStack:
    """Pieces one behind the other; a stack is equal to itself only.

    Arguments are arrays of one shape: which piece, and t. The formulas, and their roundings, are those of ``LawPiece``.
    """

    __slots__ = ("_extremes", "_forms", "_groups", "_rows", "ends", "starts")

    def __init__(self, pieces: Sequence[LawPiece]) -> None:
        self.starts, self.ends = (np.array(x) for x in zip(*(p.domain for p in pieces), strict=True))
        forms: dict[tuple[int, int], list[int]] = {}
        for k, piece in enumerate(pieces):
            forms.setdefault((len(piece.coefficients), len(piece.waves)), []).append(k)
        self._groups = [_Form([pieces[k] for k in members]) for members in forms.values()]
        self._forms, self._rows = np.zeros(len(pieces), dtype=np.intp), np.zeros(len(pieces), dtype=np.intp)
        for form, members in enumerate(forms.values()):
            self._forms[members], self._rows[members] = form, np.arange(len(members))
        self._extremes: dict[int, tuple[Indices, Real]] = {}

    @property
    def knots(self) -> Real:
        """Where two pieces meet."""
        return self.starts[1:]

    def index(self, t: Real) -> Indices:
        """The piece on which each argument stands; at a joint the one from there on."""
        return np.searchsorted(self.knots, t, side="right")

    def at(self, index: Indices, t: Real, order: int = 0) -> Real:
        """s^(order) of the pieces ``index`` at ``t``."""
        return self.orders_at(index, t, (order,))[0]

    def values(self, t: Real, order: int) -> list[Real]:
        """s, s' ... s^(order), at a joint from the right."""
        return self.orders_at(self.index(t), t, range(order + 1))

    def orders_at(self, index: Indices, t: Real, orders: Sequence[int]) -> list[Real]:
        """Several derivatives of the pieces ``index`` at ``t``, which share their powers."""
        which, flat = np.ravel(index), np.ravel(t)
        forms, rows = self._forms[which], self._rows[which]
        found = [np.empty(flat.size) for _ in orders]
        for form, group in enumerate(self._groups):
            mine = np.flatnonzero(forms == form)
            for start in range(0, mine.size, _BLOCK):
                some = mine[start : start + _BLOCK]
                for target, value in zip(found, group.values(rows[some], flat[some], orders), strict=True):
                    target[some] = value
        return [x.reshape(np.shape(t)) for x in found]

    def bounds(self, order: int, a: Real, b: Real) -> list[Real]:
        """Proven bounds of |s|, |s'| ... |s^(order)| on intervals [a, b], each within one piece."""
        index = self.index((a + b) / 2)
        result = [np.empty(np.shape(a)) for _ in range(order + 1)]
        for form, group in enumerate(self._groups):
            mine = np.flatnonzero(self._forms[index] == form)
            for target, value in zip(
                result, group.bounds(order, self._rows[index[mine]], a[mine], b[mine]), strict=True
            ):
                target[mine] = value
        return result

    def rows(self, count: int) -> tuple[Indices, Real]:
        """(pieces, count) arguments: even ones on each piece, with its ends."""
        t = np.linspace(self.starts, self.ends, count, axis=-1)
        return np.broadcast_to(np.arange(len(t))[:, None], t.shape), t

    def extremes(self, order: int) -> tuple[Indices, Real]:
        """Pieces and arguments, the ends of each included, at which |s^(order)| may be greatest."""
        if order not in self._extremes:
            found, roots = self.sign_changes(lambda k, t: self.at(k, t, order + 1), _EXTREME_SAMPLES)
            every = np.arange(len(self.starts))
            index = np.concatenate([every, found, every])
            t = np.concatenate([self.starts, roots, self.ends])
            ranks = np.lexsort((t, index))
            self._extremes[order] = index[ranks], t[ranks]
        return self._extremes[order]

    def sign_changes(
        self, function: PieceFunction, samples: int, pieces: Indices | None = None
    ) -> tuple[Indices, Real]:
        """Roots of a function between samples of opposite sign on each piece: ``geometry.laws.piece.sign_changes``.

        ``pieces``: the numbers of those on which they are sought, by default on all.
        """
        index, t = self.rows(samples)
        if pieces is not None:
            index, t = index[pieces], t[pieces]
        values = function(index, t)
        sign = np.sign(values)
        exact = (sign[:, 1:-1] == 0) & (sign[:, :-2] * sign[:, 2:] < 0)
        row, i = np.nonzero(sign[:, :-1] * sign[:, 1:] < 0)
        k, found = index[row, i], np.zeros(0)
        if k.size:
            ends = t[row, i], t[row, i + 1], values[row, i], values[row, i + 1]
            found = bracketed_roots(lambda x: function(k, x), *ends)
        return np.concatenate([k, index[:, 1:-1][exact]]), np.concatenate([found, t[:, 1:-1][exact]])
