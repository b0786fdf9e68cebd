"""Contact of an external spur pair over one whole pitch, on the exact outlines: verdict, gap curve, worst place.

The search and its words are in ``mesh_search``; here is how the second gear moves.
"""

from __future__ import annotations

import math

import numpy as np

from geometry.curves.curve import Complex, Real
from geometry.gears.mesh.search import CONTACT_TOLERANCE, ContactPlace, MeshSearch, PairContact, gear_outline, searched
from geometry.gears.mesh.transmission_error import TransmissionError, transmission_errors
from geometry.gears.pairs.external import ExternalPair
from geometry.gears.pairs.involute import flank_gaps

__all__ = ["CONTACT_TOLERANCE", "ContactPlace", "PairContact", "pair_contact"]


def pair_contact(
    pair: ExternalPair,
    *,
    second_turn: float = 0.0,
    centre_shift: float = 0.0,
    tolerance: float | None = None,
    overlap_ratio: float = 0.0,
) -> PairContact:
    """The exact gap of a pair over one pitch of the first gear.

    Parameters
    ----------
    second_turn
        Rotation of the second gear, rad, beyond the middle of the first one's space (``pair.second_rotation``);
        +- ``normal_backlash / (2 second.base_radius)`` drives it to the contact of one flank.
    centre_shift
        mm by which the centre distance is more than the pair's.
    tolerance
        mm; default 1e-8 module.
    overlap_ratio
        Of helical teeth whose section the pair is: drive angle that their face covers, in pitches.

    Raises
    ------
    ParameterError
        A gear of the pair cannot be built.
    """
    allowed = CONTACT_TOLERANCE * pair.module if tolerance is None else tolerance
    return searched(_ExternalMesh(pair, second_turn, centre_shift), allowed, overlap_ratio)


def pair_transmission(
    pair: ExternalPair, *, centre_shift: float = 0.0, overlap_ratio: float = 0.0
) -> tuple[TransmissionError, TransmissionError]:
    """Transmission error of two external gears: counter-clockwise, then clockwise.

    ``centre_shift``: mm by which the distance is more than the pair's; ``overlap_ratio``: of helical teeth.

    Raises
    ------
    ParameterError, ConvergenceError
        A part of the pair cannot be built; its teeth do not reach each other.
    """
    return transmission_errors(_ExternalMesh(pair, 0.0, centre_shift), overlap_ratio)


class _ExternalMesh(MeshSearch):
    """Two external gears: the second one's axis lies at +distance and sees the mesh at pi."""

    def __init__(self, pair: ExternalPair, second_turn: float, centre_shift: float) -> None:
        self.pair, self.second_turn = pair, second_turn
        self.distance = pair.working_centre_distance + centre_shift
        first, second = pair.sides
        super().__init__(
            (gear_outline(first), gear_outline(second)),
            (first.segments, second.segments),
            pair.module,
            (pair.first.root_radius, pair.first.tip_radius),
            (pair.first.pitch_angle, pair.second.pitch_angle),
            -pair.first.number_of_teeth / pair.second.number_of_teeth,
        )

    def teeth_in_reach(self) -> tuple[int, int]:
        """Enough for the whole path of contact and one more, and no more than the tip circles enclose."""
        gears, line = self.pair.gears, self.distance
        along = sum(math.sqrt(max(g.tip_radius**2 - g.base_radius**2, 0)) for g in gears)
        least = math.sqrt(max(line**2 - (gears[0].base_radius + gears[1].base_radius) ** 2, 0))
        teeth = math.ceil(max(along - least, 0.0) / self.pair.base_pitch / 2 + 0.5) + 1
        teeth = min(teeth, math.ceil(self._lens(1) / self.pitches[1] + 0.5))
        return teeth, teeth

    def _lens(self, which: int) -> float:
        """Half of the angle of a gear's tip circle that lies inside the mate's, rad; 0 where they are apart."""
        tip, mate = self.pair.gears[which].tip_radius, self.pair.gears[1 - which].tip_radius
        cosine = (self.distance**2 + tip**2 - mate**2) / (2 * self.distance * tip)
        return math.acos(min(1.0, max(-1.0, cosine)))

    def second_position(self, drive: Real) -> Real:
        return self.pair.second_rotation(0.0) + self.second_turn + self.rate * drive

    def facing_copy(self, position: Real) -> Real:
        return np.round((math.pi - position) / self.pitches[1])

    def placing(self, position: Real, copy: Real) -> tuple[Complex, Complex]:
        turn = np.exp(1j * (position + copy * self.pitches[1]))
        return turn, np.full(turn.shape, self.distance + 0j)

    def to_fixed(self, points: Complex, drive: Real) -> tuple[Complex, Complex]:
        turned = np.exp(1j * self.second_position(drive)) * points
        return self.distance + turned, 1j * self.rate * turned

    @property
    def arm(self) -> float:
        return self.pair.second.base_radius

    @property
    def closing(self) -> int:
        return 1

    @property
    def reach(self) -> float:
        return self.pair.second.tip_radius

    def to_second(self, points: Complex, drive: Real, turn: Real | float = 0.0) -> tuple[Complex, Complex]:
        second = self.second_position(drive) + turn
        turned = np.exp(1j * (drive - second)) * points
        centre = -self.distance * np.exp(-1j * second)
        return centre + turned, -1j * self.rate * centre + 1j * (1 - self.rate) * turned

    def corner_window(self, which: int, corners: Complex) -> tuple[Real, float]:
        lens = min(self._lens(which), (self.first_teeth + 0.5) * self.pitches[which])
        if not which:
            return -np.angle(corners), lens
        drive = (math.pi - np.angle(corners) - float(self.second_position(np.zeros(1))[0])) / self.rate
        return drive, lens / abs(self.rate)

    def closed_form(self, drive: Real, shift: float = 0.0) -> Real:
        return flank_gaps(self.pair, drive, self.second_position(drive) + shift, self.distance)
