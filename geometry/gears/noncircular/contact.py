"""Contact of two noncircular gears through everything that differs: the least gap of their exact outlines.

Teeth are all different, so the search runs over as many pitches as both outlines take to come again. At each position
every piece of the second outline that samples leave near enough is held against the pieces of the first one near it;
minima between samples are bracketed as for circular gears (geometry/plane/distance.py), all of them at once.
"""

from __future__ import annotations

import math
from operator import itemgetter
from typing import NamedTuple

import numpy as np

from geometry.base.tolerance import CONTACT_TOLERANCE
from geometry.curves.curve import Complex, Real
from geometry.gears.mesh.search import ContactPlace, PairContact, told_contact, verdict_of
from geometry.gears.noncircular.pair import NoncircularPair
from geometry.gears.noncircular.table import CurveTable
from geometry.plane.distance import Flags, Indices, least_in_brackets, promising
from geometry.plane.profile import Label

# positions in a pitch, and rounds of more positions beside the least gap
_POSITIONS, _ROUNDS = 12, 4
_ACCURACY = 1e-12
# heights of tips that are looked at beyond those that meet, in modules
_ROOM = 0.3
_CURVATURE_SAMPLES = 513


def noncircular_contact(
    pair: NoncircularPair, second_turn: float = 0.0, centre_shift: float = 0.0, tolerance: float | None = None
) -> PairContact:
    """The exact gap of a pair through one whole turn of the first gear, or the part of it after which all comes again.

    ``second_turn``: rotation of the second gear, rad, beyond the phase at which the centrodes roll; ``centre_shift``:
    mm by which the centre distance is more than the pair's; ``tolerance`` in mm, default 1e-8 module.
    """
    allowed = CONTACT_TOLERANCE * pair.first.module if tolerance is None else tolerance
    mesh = _Mesh(pair, second_turn, centre_shift)
    step = pair.first.pitch / _POSITIONS
    arcs = np.asarray(-step * np.arange(mesh.pitches * _POSITIONS), dtype=np.float64)
    found = mesh.gaps(arcs)
    for _ in range(_ROUNDS):
        if np.all(np.abs(found.gap) <= allowed) or not np.isfinite(found.gap).all():
            break
        # the least gap, and the greatest of each side's: between their neighbours
        places = {int(np.argmin(found.gap.min(axis=1))), *np.argmax(found.gap, axis=0).tolist()}
        more = np.array([arcs[i] + step * x for i in sorted(places) for x in (-0.5, -0.25, 0.25, 0.5)])
        step /= 4
        arcs, found = np.concatenate([arcs, more]), found.joined(mesh.gaps(more))
    return _concluded(pair, arcs, found, allowed)


class _Gaps(NamedTuple):
    """Least gap at each position and tooth side (n, 2), where, in the fixed frame, and on which curves."""

    gap: Real
    point: Complex
    first: Indices
    second: Indices

    def joined(self, other: _Gaps) -> _Gaps:
        """Both, one after the other."""
        return _Gaps(*(np.concatenate(pair) for pair in zip(self, other, strict=True)))


def _concluded(pair: NoncircularPair, arcs: Real, found: _Gaps, allowed: float) -> PairContact:
    drive = pair.rotations(arcs)[0]
    order = np.argsort(drive)
    gap, drive = found.gap[order], drive[order]
    worst, side = divmod(int(np.argmin(gap)), 2)
    row = int(order[worst])
    labels: tuple[Label, Label] = (
        pair.first.outline.segments[found.first[row, side]].label,
        pair.second.outline.segments[found.second[row, side]].label,
    )
    place = ContactPlace(float(gap[worst, side]), float(drive[worst]), complex(found.point[row, side]), labels)
    return told_contact(verdict_of(gap, allowed), allowed, drive, gap, place)


class _Lanes(NamedTuple):
    """Pieces of the second outline at positions: position, side, curve, turn and shift into the first body's frame;
    candidates (n, k) of the first outline's curves with the turns that bring them there, -1 where there is none."""

    position: Indices
    side: Indices
    curve: Indices
    turn: Complex
    shift: Complex
    facing: Indices
    facing_turn: Complex

    def chosen(self, rows: Indices) -> _Lanes:
        """Some of them."""
        return _Lanes(*map(itemgetter(rows), self))


class _Mesh:
    """Two gears and how the second one stands to the first; points in the frame of the first gear's body."""

    def __init__(self, pair: NoncircularPair, second_turn: float, centre_shift: float) -> None:
        self.pair, self.turn = pair, second_turn
        self.distance = pair.centre_distance + centre_shift
        self.one, self.two = CurveTable(pair.first), CurveTable(pair.second)
        self.pitches = math.lcm(self.one.teeth, self.two.teeth)
        self.reach = self._teeth_in_reach()

    def _teeth_in_reach(self) -> int:
        """Teeth on either side of the pitch point whose tips can meet: those curve away from the tangent."""
        one, two = self.pair.first, self.pair.second
        arcs = np.linspace(0, one.pitch * self.pitches, _CURVATURE_SAMPLES)
        bend = one.line.curvature(arcs) + two.line.curvature(self.pair.shift - arcs)
        height = one.tip_height + two.tip_height + _ROOM * one.module
        away = math.sqrt(2 * height / max(float(bend.min()), 1e-9))
        return min(math.ceil(away / one.pitch) + 1, math.ceil(one.number_of_teeth / 2), 12)

    def gaps(self, arcs: Real) -> _Gaps:
        """Least gap at each contact s_1 and side."""
        first, second = self.pair.rotations(arcs)
        lanes = self._lanes(arcs, np.exp(1j * (second + self.turn - first)), self.distance * np.exp(-1j * first))
        values, where, index = self._least(lanes)
        shape = len(arcs), 2
        gap, point = np.full(shape, np.inf), np.zeros(shape, complex)
        one, two = np.zeros(shape, dtype=int), np.zeros(shape, dtype=int)
        # the least of each position and side is assigned last
        order = np.argsort(-values, kind="stable")
        at = lanes.position[order], lanes.side[order]
        gap[at], one[at], two[at] = values[order], index[order], lanes.curve[order]
        point[at] = (where * np.exp(1j * first)[lanes.position])[order]
        return _Gaps(gap, point, one, two)

    def _lanes(self, arcs: Real, turns: Complex, shifts: Complex) -> _Lanes:
        """Pieces that may hold the least gap of their position and side, by the distances of samples."""
        found = []
        for i, arc in enumerate(arcs.tolist()):
            mine, my_turn = self.two.about(self.pair.shift - arc, self.reach)
            facing, facing_turn = self.one.about(arc, self.reach)
            clouds = self.two.few[mine] * (my_turn * turns[i])[:, None] + shifts[i]
            near = self.one.few[facing] * facing_turn[:, None]
            away = np.abs(clouds.ravel()[:, None] - near.ravel()[None, :])
            away = away.reshape(*clouds.shape, *near.shape).min(axis=3)
            stride = self.two.strides[mine]
            bound = away - (stride[:, None] + self.one.strides[facing][None, :])[:, None, :]
            for side in (0, 1):
                rows = np.flatnonzero(self.two.side[mine] == side)
                rows = rows[bound[rows].min(axis=(1, 2)) <= away[rows].min()]
                finer = []
                for k in rows.tolist():
                    # curves that may be nearest to some point of the piece
                    some = np.flatnonzero((bound[k] <= away[k].min(axis=1)[:, None] + stride[k]).any(axis=0))
                    finer.append(
                        self._nearer(mine[k], my_turn[k] * turns[i], shifts[i], facing[some], facing_turn[some])
                    )
                best = min(one[0] for one in finer)
                for k, (_, least, curves, turn) in zip(rows.tolist(), finer, strict=True):
                    if least <= best:
                        found.append((i, side, mine[k], my_turn[k] * turns[i], shifts[i], curves, turn))
        most = max(len(f[5]) for f in found)
        facing = np.array([np.append(f[5], np.full(most - len(f[5]), -1)) for f in found]).astype(int)
        turned = np.array([np.append(f[6], np.ones(most - len(f[6]))) for f in found])
        places, which, curves, turn, shift = (np.array(column) for column in list(zip(*found, strict=True))[:5])
        return _Lanes(places, which, curves, turn, shift, facing, turned)

    def _nearer(
        self, curve: int, turn: complex, shift: complex, facing: Indices, facing_turn: Complex
    ) -> tuple[float, float, Indices, Complex]:
        """Distance of all samples of a piece from those of curves, what it can be at least, and the curves, with their
        turns, that may be nearest to some point of the piece."""
        points = self.two.samples[curve] * turn + shift
        near = self.one.samples[facing] * facing_turn[:, None]
        away = np.abs(points[None, :, None] - near[:, None, :]).min(axis=2)
        bound = away - self.one.steps[facing][:, None] - self.two.steps[curve]
        kept = (bound <= away.min(axis=0)[None, :] + self.two.steps[curve]).any(axis=1)
        return float(away.min()), float(bound.min()), facing[kept], facing_turn[kept]

    def _least(self, lanes: _Lanes) -> tuple[Real, Complex, Indices]:
        """The least signed distance of each piece, where, and of which curve of the first outline."""
        shares = self.two.shares
        rows = np.arange(len(lanes.curve))
        low, high = self.two.low[lanes.curve], self.two.high[lanes.curve]
        t = low[:, None] + (high - low)[:, None] * shares
        many = np.repeat(rows, len(shares))
        value, slope, _, index = (x.reshape(t.shape) for x in self._measured(lanes.chosen(many), t.ravel()))
        lengths = np.broadcast_to(self.two.lengths[lanes.curve], (len(rows), len(shares) - 1))
        best = value.min(axis=1)
        # no more than the least of the position and side
        least = np.full((int(lanes.position.max()) + 1, 2), np.inf)
        np.minimum.at(least, (lanes.position, lanes.side), best)
        limit = least[lanes.position, lanes.side][:, None]
        chosen: Flags = promising(value[:, :-1], value[:, 1:], slope[:, :-1], slope[:, 1:], lengths, limit)
        row, k = np.nonzero(chosen)
        part = lanes.chosen(row)

        def evaluate(at: Real, some: Indices) -> tuple[Real, Real]:
            found = self._measured(part.chosen(some), at)
            return found[0], found[1]

        accuracy = _ACCURACY * self.pair.first.module
        where, _ = least_in_brackets(evaluate, t[row, k], t[row, k + 1], (slope[row, k], slope[row, k + 1]), accuracy)
        every = np.concatenate([row, rows])
        at = np.concatenate([where, t[rows, np.argmin(value, axis=1)]])
        value, _, points, index = self._measured(lanes.chosen(every), at)
        order = np.argsort(-value, kind="stable")
        result, place, which = np.zeros(len(rows)), np.zeros(len(rows), complex), np.zeros(len(rows), dtype=int)
        result[every[order]], place[every[order]], which[every[order]] = value[order], points[order], index[order]
        return result, place, which

    def _measured(self, lanes: _Lanes, t: Real) -> tuple[Real, Real, Complex, Indices]:
        """Signed distances of points of pieces from the first outline, their rates over t, points, and curves."""
        point, direction, speed, _ = self.two.at(lanes.curve, t)
        point, rate = lanes.turn * point + lanes.shift, lanes.turn * direction * speed
        size, distance, slope = (np.full(len(t), np.inf) for _ in range(3))
        index = np.zeros(len(t), dtype=int)
        for k in range(lanes.facing.shape[1]):
            rows = np.flatnonzero(lanes.facing[:, k] >= 0)
            curve, turn = lanes.facing[rows, k], lanes.facing_turn[rows, k]
            gap, normal = self.one.distance(curve, point[rows] * np.conj(turn))
            nearer = np.abs(gap) < size[rows]
            rows, gap, normal = rows[nearer], gap[nearer], (normal * turn)[nearer]
            size[rows], distance[rows], index[rows] = np.abs(gap), gap, curve[nearer]
            slope[rows] = (np.conj(normal) * rate[rows]).real
        return distance, slope, point, index
