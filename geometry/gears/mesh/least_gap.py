"""The least signed distance of placed copies of half an outline from a gear's outline.

Every piece of a curve between samples that may hold less than what its group has found is followed: the signed
distance is 1-Lipschitz, so a piece of length l with the ends a and b stays above (a + b - l) / 2. Where the nearest
point jumps from one flank to another the distance has a peak, and a minimum may lie beside it between two samples
that both fall: pieces whose ends have different feet are therefore halved until the peak is caught. Inside the
material the jump is a trough and hides nothing. Within one foot the distance is taken to be smooth: a minimum that
neither end's slope tells of shows in the cubic through both ends.
"""

from __future__ import annotations

from operator import itemgetter
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.record import Record
from geometry.curves.curve import Complex, Curve, Real
from geometry.plane.distance import Boundary, Flags, Indices, Samples, fold_images, folded, sampled
from geometry.plane.profile import Segment

# samples along curves, in modules
_SAMPLE_STEP = 0.2
# least distances are found to this part of the module
ACCURACY = 1e-12
# a change of feet is caught to this part of the module: a minimum beside it is missed by its square
_PEAK = 2e-5
# a minimum in a piece that short (modules) is above the tangents of its ends; by this it is no candidate any more
_SHORT, _BEATEN = 0.02, 1e-9
# an arc is at most that much longer than its chord: steps are short against radii
_BULGE = 1.2
_STEPS = 80
# of a chord: a speed that is none
_AT_REST = 1e-9
# samples beside a cusp: how much nearer each one is than the one before, and how many
_CLOSER, _SCALES = 4.0, 12
# parts of a piece that a peak divides
_PARTS = 4
# what rounding leaves of a distance, as a part of the second body's coordinates
_ROUNDINGS = 8 * float(np.finfo(float).eps)


class Gaps(NamedTuple):
    """Least gap per group (n,), mm, the point it was found at in the first gear's frame, and both curves' indices.

    ``arm``: mm by which the line across the gap passes by the first gear's axis: of two flanks its base radius.
    """

    gap: Real
    arm: Real
    point: Complex
    first_index: Indices
    second_index: Indices

    @classmethod
    def unknown(cls, count: int) -> Gaps:
        """Nothing found yet."""
        none = np.zeros(count, int)
        return cls(np.full(count, np.inf), np.zeros(count), np.zeros(count, complex), none, none.copy())

    def keep(
        self, group: Indices, distance: Real, arm: Real, point: Complex, first: Indices, second: int | Indices
    ) -> None:
        """Take the least candidate of each group where it is less than what is held."""
        fresh = np.flatnonzero(distance < self.gap[group])
        order = fresh[np.lexsort((distance[fresh], group[fresh]))]
        chosen = order[np.append(True, np.diff(group[order]) > 0)] if order.size else order
        values = distance, arm, point, first, np.broadcast_to(second, distance.shape)
        for table, value in zip(self, values, strict=True):
            table[group[chosen]] = value[chosen]


class Copies(NamedTuple):
    """Halves of a pitch of the second body in the first gear's frame, n of them: turn, then shift (mm)."""

    group: Indices
    turn: Complex
    shift: Complex
    mirrored: Flags

    def place(self, rows: Indices, points: Complex, rates: Complex) -> tuple[Complex, Complex]:
        """Points and derivatives of the outline as the copies ``rows`` have them."""
        mirrored, turn = self.mirrored[rows], self.turn[rows]
        points, rates = np.where(mirrored, np.conj(points), points), np.where(mirrored, np.conj(rates), rates)
        return self.shift[rows] + turn * points, turn * rates


class _Ends(NamedTuple):
    """One end of each piece: parameter, point before it is folded, distance and slope, and what its foot is on."""

    t: Real
    point: Complex
    value: Real
    slope: Real
    foot: Indices

    def take(self, rows: Indices | Flags) -> _Ends:
        return _Ends(*map(itemgetter(rows), self))

    def and_then(self, more: _Ends) -> _Ends:
        return _Ends(*(np.concatenate(pair) for pair in zip(self, more, strict=True)))


class _Pieces(NamedTuple):
    """Parts of curves that may hold a least distance."""

    curve: Indices
    row: Indices
    low: _Ends
    high: _Ends

    def take(self, rows: Indices | Flags) -> _Pieces:
        return _Pieces(self.curve[rows], self.row[rows], self.low.take(rows), self.high.take(rows))

    @property
    def bound(self) -> Real:
        """What the distance stays above, mm."""
        return (self.low.value + self.high.value - _BULGE * np.abs(self.high.point - self.low.point)) / 2

    @property
    def falls_and_rises(self) -> Flags:
        return (self.low.slope <= 0) & (self.high.slope >= 0)

    @property
    def has_peak(self) -> Flags:
        """Different feet at the ends, and not both inside the material."""
        return (self.low.foot != self.high.foot) & ((self.low.value > 0) | (self.high.value > 0))

    @property
    def hides_minimum(self) -> Flags:
        """Ends that both fall or both rise, and a cubic through them that turns in between."""
        a, b = self.low.slope, self.high.slope
        with np.errstate(divide="ignore", invalid="ignore"):
            secant = (self.high.value - self.low.value) / (self.high.t - self.low.t)
            # the cubic's slope is a + linear x + square x^2, x from 0 to 1
            linear, square = 6 * secant - 4 * a - 2 * b, 3 * (a + b) - 6 * secant
            top = -linear / (2 * square)
            turns = (a + top * linear / 2) * np.sign(a) < 0
        return (a * b > 0) & (top > 0) & (top < 1) & turns

    @property
    def crossing(self) -> Real:
        """Where the tangents of both ends cross, from the low end on; nan or inf where they are parallel."""
        low, high = self.low, self.high
        with np.errstate(divide="ignore", invalid="ignore"):
            rise = high.value - low.value - high.slope * (high.t - low.t)
            return np.asarray(rise / (low.slope - high.slope))


class _FromCusp(Curve, Record):
    """A curve that begins or ``ends`` in a cusp over the square of the way from there, over which it has a speed.

    Over its own parameter every distance is level at the cusp, and no bound by tangents holds beside it.
    """

    curve: Curve
    ends: bool

    @property
    def domain(self) -> tuple[float, float]:
        low, high = self.curve.domain
        whole = (high - low) ** 2
        return (-whole, 0.0) if self.ends else (0.0, whole)

    def _away(self, t: ArrayLike) -> Real:
        return np.sqrt(np.abs(np.asarray(t, dtype=float)))

    def _own(self, away: Real) -> Real:
        low, high = self.curve.domain
        return high - away if self.ends else low + away

    def point(self, t: ArrayLike) -> Complex:
        return self.curve.point(self._own(self._away(t)))

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        away = self._away(t)
        at = self._own(away)
        with np.errstate(divide="ignore", invalid="ignore"):
            speed = np.where(away > 0, np.abs(self.curve.derivative(at)) / away, np.abs(self.curve.derivative(at, 2)))
        return self.curve.tangent(at) * speed / 2


def _paced(curve: Curve) -> Curve:
    """The curve, where one of its ends is a cusp over a parameter that has a speed there."""
    low, high = curve.domain
    chord = abs(complex(curve.point(high)) - complex(curve.point(low)))
    starts, ends = np.abs(curve.derivative(np.array([low, high]))) * (high - low) < _AT_REST * chord
    return _FromCusp(curve, bool(ends)) if starts != ends else curve


def _samples(curve: Curve, step: float) -> Samples:
    """Samples ``step`` mm apart, and ever closer ones beside a cusp, where distances look alike at every scale."""
    found = sampled(curve, step)
    if not isinstance(curve, _FromCusp):
        return found
    t = found.parameters
    closer = (t[-2] if curve.ends else t[1]) * _CLOSER ** -np.arange(1.0, _SCALES + 1)
    t = np.sort(np.concatenate([t, closer]))
    points = np.asarray(curve.point(t))
    return Samples(t, points, _BULGE * np.abs(np.diff(points)))


class LeastGap:
    """The first gear's outline, and half a pitch of the second body's with its samples."""

    def __init__(self, first: Boundary, pitch: float, segments: tuple[Segment, ...], module: float) -> None:
        self.first, self.pitch, self.segments, self.module = first, pitch, segments, module
        self.curves = [_paced(s.curve) for s in segments]
        self.samples: list[Samples] = [_samples(curve, _SAMPLE_STEP * module) for curve in self.curves]
        self.rates = [np.asarray(c.derivative(q.parameters)) for c, q in zip(self.curves, self.samples, strict=True)]

    @property
    def rounding(self) -> float:
        """What rounding leaves of a distance, mm."""
        return _ROUNDINGS * max(float(np.abs(s.points).max()) for s in self.samples)

    @property
    def longest(self) -> float:
        """The longest of the steps between samples, mm."""
        return max(float(s.lengths.max()) for s in self.samples)

    def radii(self, copies: Copies) -> list[Real]:
        """For each curve the least distance of copies' samples from the first gear's axis, mm: (n,) each."""
        found = []
        for sample in self.samples:
            both = np.where(copies.mirrored[:, None], np.conj(sample.points), sample.points)
            found.append(np.abs(copies.shift[:, None] + copies.turn[:, None] * both).min(axis=1))
        return found

    def search(self, copies: Copies, chosen: list[Flags], found: Gaps, accuracy: float = ACCURACY) -> None:
        """Enter into ``found`` what the copies hold that is less, to ``accuracy`` modules.

        ``chosen`` (n,) tells for each curve which copies of it are looked at.
        """
        pieces, least = self._sampled(copies, chosen, found), max(accuracy * self.module, self.rounding)
        for step in range(_STEPS):
            pieces = pieces.take(self._hopeful(pieces, found.gap[copies.group[pieces.row]] - least, least))
            if not pieces.row.size:
                return
            pieces = self._divided(pieces, step, copies, found)

    def _sampled(self, copies: Copies, chosen: list[Flags], found: Gaps) -> _Pieces:
        """All pieces between samples, measured in one go."""
        rows = [np.flatnonzero(c) for c in chosen]
        counts = [len(s.parameters) for s in self.samples]
        points, rates = np.zeros(0, complex), np.zeros(0, complex)
        blocks = []
        for r, count, sample, rate in zip(rows, counts, self.samples, self.rates, strict=True):
            blocks.append(copies.place(np.repeat(r, count), np.tile(sample.points, len(r)), np.tile(rate, len(r))))
        points, rates = (np.concatenate([b[k] for b in blocks]) for k in (0, 1))
        curve = np.repeat(np.arange(len(rows)), [len(r) * c for r, c in zip(rows, counts, strict=True)])
        row = np.concatenate([np.repeat(r, c) for r, c in zip(rows, counts, strict=True)])
        t = np.concatenate([np.tile(s.parameters, len(r)) for r, s in zip(rows, self.samples, strict=True)])
        ends = self._measured(curve, row, t, points, rates, copies, found)
        # a piece goes from a sample to the next one of the same copy of the same curve
        lower = np.flatnonzero((curve[:-1] == curve[1:]) & (row[:-1] == row[1:])) if len(row) else row
        return _Pieces(curve[lower], row[lower], ends.take(lower), ends.take(lower + 1))

    def _measured(
        self, curve: Indices, row: Indices, t: Real, points: Complex, rates: Complex, copies: Copies, found: Gaps
    ) -> _Ends:
        inner, turned = folded(points, rates, self.pitch)
        feet = self.first.feet(inner)
        arm = np.abs((np.conj(inner) * feet.normal).imag)
        found.keep(copies.group[row], feet.distance, arm, points, feet.curve_index, curve)
        foot = fold_images(points, self.pitch) * len(self.first.curves) + feet.curve_index
        return _Ends(t, points, feet.distance, (np.conj(feet.normal) * turned).real, foot)

    def _hopeful(self, pieces: _Pieces, best: Real, accuracy: float) -> Flags:
        """Pieces that may hold less than ``best``."""
        length = np.abs(pieces.high.point - pieces.low.point)
        flatter = np.minimum(np.abs(pieces.low.slope), np.abs(pieces.high.slope))
        with np.errstate(invalid="ignore"):
            tangents = pieces.low.value + pieces.low.slope * pieces.crossing
            # where they cross within the piece, as those of a convex function do
            crossed = (pieces.crossing >= 0) & (pieces.crossing <= pieces.high.t - pieces.low.t)
        room = np.where(pieces.low.foot == pieces.high.foot, _BEATEN * self.module, 0.0)
        above = (length < _SHORT * self.module) & (tangents >= best + room) & crossed
        # of a convex function the least is within slope * width
        trough = pieces.falls_and_rises & (flatter * (pieces.high.t - pieces.low.t) > accuracy) & ~above
        jump = (pieces.has_peak | pieces.hides_minimum) & (length > _PEAK * self.module)
        return (pieces.bound < best) & (trough | jump)

    def _divided(self, pieces: _Pieces, step: int, copies: Copies, found: Gaps) -> _Pieces:
        """Pieces in two, those that a peak may divide in many: there is no telling where."""
        many = pieces.has_peak | pieces.hides_minimum
        few, more = pieces.take(~many), pieces.take(many)
        shares = np.arange(1, _PARTS) / _PARTS
        t = _split(few, step)[None, :], more.low.t + shares[:, None] * (more.high.t - more.low.t)
        curve = np.concatenate([few.curve, np.tile(more.curve, len(shares))])
        row = np.concatenate([few.row, np.tile(more.row, len(shares))])
        middle = self._ends(curve, row, np.concatenate([a.ravel() for a in t]), copies, found)
        halves = _chained(few, middle.take(np.arange(len(few.row))), 1)
        parts = _chained(more, middle.take(np.arange(len(few.row), len(row))), len(shares))
        return _Pieces(
            np.append(halves.curve, parts.curve), np.append(halves.row, parts.row),
            halves.low.and_then(parts.low), halves.high.and_then(parts.high),
        )  # fmt: skip

    def _ends(self, curve: Indices, row: Indices, t: Real, copies: Copies, found: Gaps) -> _Ends:
        """Distances at parameters of curves."""
        points, rates = np.empty(len(t), complex), np.empty(len(t), complex)
        for number, one in enumerate(self.curves):
            mine = np.flatnonzero(curve == number)
            if mine.size:
                points[mine], rates[mine] = one.point(t[mine]), one.derivative(t[mine])
        return self._measured(curve, row, t, *copies.place(row, points, rates), copies, found)


def _chained(pieces: _Pieces, middle: _Ends, count: int) -> _Pieces:
    """Pieces cut at ``count`` places each, place after place in ``middle``."""
    low, high = pieces.low.and_then(middle), middle.and_then(pieces.high)
    return _Pieces(np.tile(pieces.curve, count + 1), np.tile(pieces.row, count + 1), low, high)


def _split(pieces: _Pieces, step: int) -> Real:
    """Where pieces are divided: the middle each fourth time and where feet change; else the minimum of a cubic.

    The cubic goes through both ends with their slopes. Where the feet change inside the material, the trough is where
    the tangents of both ends cross.
    """
    low, high = pieces.low, pieces.high
    width = high.t - low.t
    share = np.full(width.shape, 0.5)
    if step % 4 != 3:
        with np.errstate(divide="ignore", invalid="ignore"):
            first = low.slope + high.slope - 3 * (high.value - low.value) / width
            root = np.sqrt(first * first - low.slope * high.slope)
            cubic = 1 - (high.slope + root - first) / (high.slope - low.slope + 2 * root)
            found = np.where(low.foot != high.foot, pieces.crossing / width, cubic)
        usable = pieces.falls_and_rises & ~pieces.has_peak & np.isfinite(found)
        share = np.where(usable, np.clip(found, 0.001, 0.999), share)
    return low.t + share * width
