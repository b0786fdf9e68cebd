"""Contact of two noncircular gears through everything that differs: the least gap of their exact outlines.

Teeth are all different, so the search runs over as many pitches as both outlines take to come again. At each position
every piece of the second outline that samples leave near enough is held against the first outline, and minima between
samples are bracketed as for circular gears (geometry/contact.py).
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np

from geometry.contact import Boundary, Indices, Verdict, least_in_brackets, promising, sampled
from geometry.curve import Complex, Curve, Real
from geometry.gears.mesh_search import CONTACT_TOLERANCE, ContactPlace, PairContact
from geometry.gears.noncircular import NoncircularGear
from geometry.gears.noncircular_pair import NoncircularPair
from geometry.placement import Placement2
from geometry.profile import Label

# positions in a pitch, rounds of more positions beside the least gap, samples along curves in modules
_POSITIONS, _ROUNDS, _SAMPLE_STEP = 12, 4, 0.2
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
    arcs = -np.arange(mesh.pitches * _POSITIONS) * (pair.first.pitch / _POSITIONS)
    found = mesh.gaps(arcs)
    step = pair.first.pitch / _POSITIONS
    for _ in range(_ROUNDS):
        least = found.gap.min(axis=1)
        if np.all(np.abs(found.gap) <= allowed) or not np.isfinite(least).all():
            break
        # the least, the most, and where the verdict could turn: between their neighbours
        places = {int(np.argmin(least)), int(np.argmax(found.gap.min(axis=1)))}
        near = [arcs[i] + step * x for i in places for x in (-0.5, -0.25, 0.25, 0.5)]
        step /= 4
        more = np.array(near)
        arcs, found = np.concatenate([arcs, more]), found.joined(mesh.gaps(more))
    return _concluded(pair, arcs, found, allowed)


def _concluded(pair: NoncircularPair, arcs: Real, found: _Gaps, allowed: float) -> PairContact:
    drive = pair.rotations(arcs)[0]
    order = np.argsort(drive)
    gap, drive = found.gap[order], drive[order]
    gaps = gap.min(axis=1)
    worst, side = divmod(int(np.argmin(gap)), 2)
    place = ContactPlace(
        float(gap[worst, side]),
        float(drive[worst]),
        complex(found.point[order][worst, side]),
        found.labels[int(order[worst])][side],
    )
    finite = bool(np.isfinite(gap).all())
    if not finite:
        verdict = Verdict.UNDECIDED
    elif gap.min() < -allowed:
        verdict = Verdict.OVERLAP
    else:
        verdict = Verdict.CONTACT if gap.max(axis=0).min() <= allowed else Verdict.CLEAR
    sides = tuple(gap[:, 0].tolist()), tuple(gap[:, 1].tolist())
    return PairContact(verdict, allowed, tuple(drive.tolist()), tuple(gaps.tolist()), sides, place, float(gaps.max()))


@dataclass
class _Gaps:
    """Least gap at each position and tooth side (n, 2), where, in the fixed frame, and on what."""

    gap: Real
    point: Complex
    labels: list[list[tuple[Label, Label]]]

    def joined(self, other: _Gaps) -> _Gaps:
        """Both, one after the other."""
        return _Gaps(
            np.concatenate([self.gap, other.gap]),
            np.concatenate([self.point, other.point]),
            [*self.labels, *other.labels],
        )


class _Teeth:
    """The outline of a gear: curves of one period with their samples, tooth and side."""

    def __init__(self, gear: NoncircularGear) -> None:
        outline = gear.outline
        self.gear, self.segments = gear, outline.segments
        self.samples = [sampled(s.curve, _SAMPLE_STEP * gear.module) for s in outline.segments]
        self.steps = [float(s.lengths.max()) for s in self.samples]
        self.tooth, self.side = np.array(outline.owners).T
        self.teeth = gear.number_of_teeth // gear.count

    def facing(self, arc: float, reach: int) -> list[tuple[int, complex]]:
        """Segments of the teeth on either side of an arc length, and the turns that bring them there, in order."""
        middle = round(arc / self.gear.pitch - self.gear.first_tooth)
        found = []
        for tooth in range(middle - reach, middle + reach + 1):
            turns, number = divmod(tooth, self.teeth)
            turn = cmath.exp(2j * math.pi * turns / self.gear.count)
            found += [(int(i), turn) for i in np.flatnonzero(self.tooth == number)]
        return found


class _Mesh:
    """Two gears and how the second one stands to the first; points in the frame of the first gear's body."""

    def __init__(self, pair: NoncircularPair, second_turn: float, centre_shift: float) -> None:
        self.pair, self.turn = pair, second_turn
        self.distance = pair.centre_distance + centre_shift
        self.one = _Teeth(pair.first)
        self.two = self.one if pair.second is pair.first else _Teeth(pair.second)
        self.pitches = math.lcm(self.one.teeth, self.two.teeth)
        self.reach = self._teeth_in_reach()
        self.boundaries: dict[int, tuple[Boundary, list[int], Complex]] = {}

    def _teeth_in_reach(self) -> int:
        """Teeth on either side of the pitch point whose tips can meet: those curve away from the tangent."""
        one, two = self.pair.first, self.pair.second
        arcs = np.linspace(0, one.line.length * self.pitches / one.number_of_teeth, _CURVATURE_SAMPLES)
        bend = one.line.curvature(arcs) + two.line.curvature(self.pair.shift - arcs)
        height = one.tip_height + two.tip_height + _ROOM * one.module
        away = math.sqrt(2 * height / max(float(bend.min()), 1e-9))
        return min(math.ceil(away / one.pitch) + 1, math.ceil(one.number_of_teeth / 2), 12)

    def gaps(self, arcs: Real) -> _Gaps:
        """Least gap at each contact s_1 and side."""
        found = _Gaps(np.full((len(arcs), 2), np.inf), np.zeros((len(arcs), 2), complex), [])
        turns = self.pair.rotations(arcs)
        for i, arc in enumerate(arcs.tolist()):
            one, two = cmath.exp(1j * float(turns[0][i])), cmath.exp(1j * (float(turns[1][i]) + self.turn))
            found.labels.append(self._at(arc, one, two, found.gap[i], found.point[i]))
        return found

    def _boundary(self, arc: float) -> tuple[Boundary, list[int], Complex]:
        """The first outline about an arc length, and its samples; alike for all positions of one pitch."""
        number = round(arc / self.pair.first.pitch)
        if number not in self.boundaries:
            pieces = self.one.facing(number * self.pair.first.pitch, self.reach + 1)
            curves = [self._placed(self.one.segments[i].curve, turn) for i, turn in pieces]
            points = np.concatenate([self.one.samples[i].points * turn for i, turn in pieces])
            self.boundaries[number] = Boundary(tuple(curves)), [i for i, _ in pieces], points
        return self.boundaries[number]

    @staticmethod
    def _placed(curve: Curve, turn: complex) -> Curve:
        return curve.placed(Placement2(cmath.phase(turn))) if turn != 1 else curve

    def _at(self, arc: float, one: complex, two: complex, gap: Real, point: Complex) -> list[tuple[Label, Label]]:
        """Fill in the least gaps of one position, the gears turned by ``one`` and ``two``; the labels of both sides."""
        boundary, numbers, near = self._boundary(arc)
        back = one.conjugate()
        pieces = self.two.facing(self.pair.shift - arc, self.reach)
        turns = np.array([turn * two * back for _, turn in pieces])
        clouds = [
            self.two.samples[i].points * t + self.distance * back for (i, _), t in zip(pieces, turns, strict=True)
        ]
        away = np.array([np.abs(c[:, None] - near[None, :]).min() for c in clouds])
        side = np.array([self.two.side[i] for i, _ in pieces])
        steps = np.array([self.two.steps[i] for i, _ in pieces]) + max(self.one.steps)
        labels = [(Label.FLANK, Label.FLANK)] * 2
        for which in (0, 1):
            mine = np.flatnonzero(side == which)
            chosen = mine[away[mine] - steps[mine] <= away[mine].min()]
            for k in chosen.tolist():
                number = pieces[k][0]
                value, place, index = self._least(number, turns[k], self.distance * back, clouds[k], boundary)
                if value < gap[which]:
                    gap[which], point[which] = value, place * one
                    labels[which] = self.one.segments[numbers[index]].label, self.two.segments[number].label
        return labels

    def _least(
        self, number: int, turn: complex, shift: complex, points: Complex, boundary: Boundary
    ) -> tuple[float, complex, int]:
        """The least distance of one placed curve of the second outline from the first: mm, where, on which curve."""
        curve, sample = self.two.segments[number].curve, self.two.samples[number]
        t = sample.parameters

        def evaluate(at: Real, _rows: Indices) -> tuple[Real, Real]:
            feet = boundary.feet(turn * curve.point(at) + shift)
            return feet.distance, (np.conj(feet.normal) * turn * curve.derivative(at)).real

        feet = boundary.feet(points)
        value, slope = feet.distance, (np.conj(feet.normal) * turn * curve.derivative(t)).real
        k = np.flatnonzero(promising(value[:-1], value[1:], slope[:-1], slope[1:], sample.lengths, value.min()))
        accuracy = _ACCURACY * self.pair.first.module
        where, _ = least_in_brackets(evaluate, t[k], t[k + 1], (slope[k], slope[k + 1]), accuracy)
        at = np.append(where, t[int(np.argmin(value))])
        places = turn * curve.point(at) + shift
        feet = boundary.feet(places)
        best = int(np.argmin(feet.distance))
        return float(feet.distance[best]), complex(places[best]), int(feet.curve_index[best])
