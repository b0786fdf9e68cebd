"""Forces that one link passes to another: summed, and told about any point; arrays of states at once."""

from __future__ import annotations

import numpy as np

from geometry.base.record import Record
from geometry.curves.curve import Complex, Real


class Wrench(Record):
    """What forces add up to, with their moment about the origin.

    ``force``: N, across z; ``axial``: N, along z; ``tilt``: N mm, the sum of h F - p F_z over forces at p and the
    height h, which is the moment across z turned back by a quarter; ``turn``: N mm about z.
    """

    force: Complex
    axial: Real
    tilt: Complex
    turn: Real

    def __add__(self, other: Wrench) -> Wrench:
        return Wrench(
            self.force + other.force, self.axial + other.axial, self.tilt + other.tilt, self.turn + other.turn
        )

    def __neg__(self) -> Wrench:
        return Wrench(-self.force, -self.axial, -self.tilt, -self.turn)

    def about(self, point: Complex | complex, height: float) -> Wrench:
        """The same, its moment about another point (mm)."""
        return Wrench(
            self.force,
            self.axial,
            self.tilt - height * self.force + point * self.axial,
            self.turn - np.imag(np.conj(point) * self.force),
        )


def force_at(
    point: Complex | complex,
    height: float,
    force: Complex | complex,
    axial: Real | float = 0.0,
    turn: Real | float = 0.0,
) -> Wrench:
    """A force (N) at a point (mm), and a couple ``turn`` (N mm) about z."""
    return Wrench(
        np.asarray(force, dtype=complex),
        np.asarray(axial, dtype=float),
        np.asarray(height * force - point * axial, dtype=complex),
        np.imag(np.conj(point) * force) + turn,
    )
