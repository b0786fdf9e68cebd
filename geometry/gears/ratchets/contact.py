"""Contact of a pawl with its wheel, from the tooth that it holds until it drops in front of the next one.

Bodies of lines and arcs come nearest at a corner of one of them, about the middle of a round end, or where a straight
edge is at right angles to the line to the axis; the signed distances of these places from the other's exact outline
tell all of the gap.
"""

from __future__ import annotations

import cmath
import math
from functools import cached_property
from itertools import pairwise

import numpy as np

from geometry.base.placement import Placement2
from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import Arc, Line
from geometry.gears.mesh.search import ContactPlace, PairContact, first_least, told_contact, verdict_of
from geometry.gears.ratchets.pawl import PawlShape
from geometry.gears.ratchets.wheel import dot
from geometry.plane.distance import Boundary
from geometry.plane.profile import Label, joint_turn
from geometry.solids.plate import Edge

# |gap| up to this part of the tip radius is contact; places of the ride; teeth beside the pawl
CONTACT_TOLERANCE = 1e-8
_PLACES, _BESIDE = 96, 3
_LEAST_TURN = 1e-9


class RatchetContact(Record, dict=True):
    """A pawl that ``turn`` (rad) and ``shift`` (mm, along the line of centres) off its place."""

    pawl: PawlShape
    turn: float = 0.0
    shift: float = 0.0

    def result(self, tolerance: float | None = None) -> PairContact:
        """The verdict; the drive angle is the wheel's turn in its free sense since the pawl was seated."""
        wheel = self.pawl.wheel
        allowed = CONTACT_TOLERANCE * wheel.tip_radius if tolerance is None else tolerance
        last = (wheel.pitch_angle + self.pawl.overrun) * (1 - _LEAST_TURN)
        turns: Real = np.linspace(0.0, last, _PLACES)
        found = [self.gap(turn) for turn in turns.tolist()]
        gaps = np.stack([np.array([gap for gap, _ in found])] * 2, axis=1)
        k = first_least(gaps[:, 0])
        labels = Label.FLANK, Label.TIP_LAND
        worst = ContactPlace(float(gaps[k, 0]), float(turns[k]), found[k][1], labels)
        return told_contact(verdict_of(gaps, allowed), allowed, turns, gaps, worst)

    def gap(self, turn: float) -> tuple[float, complex]:
        """Least signed distance, mm, and its place, where the wheel has turned so far, rad."""
        pawl, side = self.pawl, self.pawl.wheel.side
        swung = cmath.exp(1j * (self.turn - side * pawl.stands(turn)))
        pivot = pawl.pivot * (1 + self.shift / pawl.pivot_distance)
        own, radii = self._of_pawl
        feet = self._feet(pivot, swung)
        places = np.concatenate([pivot + (own - pawl.pivot) * swung, feet])
        radii = np.concatenate([radii, np.zeros(len(feet))])
        wheel = self._wheel.feet(places * cmath.exp(-1j * turn)).distance - radii
        corners = self._edges * cmath.exp(1j * turn)
        edges = self._pawl.feet(pawl.pivot + (corners - pivot) / swung).distance
        gaps, seen = np.concatenate([wheel, edges]), np.concatenate([places, corners])
        k = first_least(gaps)
        return float(gaps[k]), complex(seen[k])

    def seated(self, places: Complex) -> float:
        """Least signed distance, mm, of places from the wheel in whose frame they are."""
        return float(self._wheel.feet(places).distance.min())

    @cached_property
    def _pawl(self) -> Boundary:
        return Boundary(self.pawl.edges(), closed=True)

    @cached_property
    def _of_pawl(self) -> tuple[Complex, Real]:
        """Corners, and the middles of round ends with their radii; in the frame of the wheel, the pawl seated."""
        edges = self.pawl.edges()
        left = [(a, b) for a, b in pairwise([edges[-1], *edges]) if joint_turn(a, b) > _LEAST_TURN]
        found = [(complex(b.point(b.domain[0])), 0.0) for _, b in left]
        found += [(edge.centre, edge.radius) for edge in edges if isinstance(edge, Arc) and edge.sweep > 0]
        return np.array([place for place, _ in found]), np.array([radius for _, radius in found])

    @cached_property
    def _teeth(self) -> range:
        """Those that may be near the pawl, tooth 1 as 0."""
        wheel = self.pawl.wheel
        far = math.ceil(abs(cmath.phase(self.pawl.pivot)) / wheel.pitch_angle) + _BESIDE
        count = min(far + _BESIDE, wheel.number_of_teeth)
        return range(_BESIDE - count, _BESIDE)

    @cached_property
    def _wheel(self) -> Boundary:
        """The outline of these teeth."""
        wheel = self.pawl.wheel
        turns = [Placement2(wheel.pitch_angle * k) for k in self._teeth]
        edges: list[Edge] = [edge.placed(turn) for turn in turns for edge in wheel.period()]
        if wheel.internal:
            edges = [edge.reversed() for edge in reversed(edges)]
        return Boundary(tuple(edges), closed=len(turns) == wheel.number_of_teeth)

    @cached_property
    def _edges(self) -> Complex:
        """The edges of these teeth, and where their backs begin."""
        wheel = self.pawl.wheel
        ends = np.array([wheel.tip_radius, wheel.notch.back_start])
        return np.concatenate([ends * cmath.exp(1j * wheel.pitch_angle * k) for k in self._teeth])

    def _feet(self, pivot: complex, swung: complex) -> Complex:
        """Places on the straight sides of the pawl that are nearest to the axis of an external wheel."""
        found = []
        for line in (edge for edge in self.pawl.edges() if isinstance(edge, Line) and not self.pawl.wheel.internal):
            start, end = (pivot + (place - self.pawl.pivot) * swung for place in (line.start, line.end))
            share = -dot(start, end - start) / abs(end - start) ** 2
            if 0 < share < 1:
                found.append(start + share * (end - start))
        return np.array(found, dtype=complex)
