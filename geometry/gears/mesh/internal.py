"""Contact of a pinion with its ring over one whole pitch, on the exact outlines: verdict, gap curve, worst place."""

from __future__ import annotations

import cmath
import math

import numpy as np

from geometry.curves.curve import Complex, Real
from geometry.gears.mesh.search import CONTACT_TOLERANCE, MeshSearch, PairContact, gear_outline, searched
from geometry.gears.mesh.transmission_error import TransmissionError, transmission_errors
from geometry.gears.pairs.internal import InternalPair
from geometry.gears.pairs.involute import flank_gaps
from geometry.gears.teeth.internal_mesh import InternalMesh
from geometry.gears.teeth.ring_tooth import RingSide
from geometry.plane.distance import Boundary

# where the tip corners keep this distance, in modules, only the teeth on the path of contact are looked at
_CLEAR_CORNERS = 0.1


def internal_contact(
    pair: InternalPair,
    *,
    ring_turn: float = 0.0,
    centre_shift: float = 0.0,
    tolerance: float | None = None,
    overlap_ratio: float = 0.0,
) -> PairContact:
    """The exact gap of pinion and ring over one pitch of the pinion.

    Drive angle and "first" are the pinion's, "second" the ring's; places are told with the pinion's axis as the
    origin and the mesh towards +x.

    Parameters
    ----------
    ring_turn
        Rotation of the ring, rad, beyond the middle of the pinion's tooth (``pair.second_rotation``);
        +- ``normal_backlash / (2 ring.base_radius)`` drives it to the contact of one flank.
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
    return searched(_InternalMesh(pair, ring_turn, centre_shift), allowed, overlap_ratio)


def internal_transmission(
    pair: InternalPair, *, centre_shift: float = 0.0, overlap_ratio: float = 0.0
) -> tuple[TransmissionError, TransmissionError]:
    """Transmission error of pinion and ring; the pinion drives: counter-clockwise, then clockwise.

    ``centre_shift``: mm by which the distance is more than the pair's; ``overlap_ratio``: of helical teeth.

    Raises
    ------
    ParameterError, ConvergenceError
        A part of the pair cannot be built; its teeth do not reach each other.
    """
    return transmission_errors(_InternalMesh(pair, 0.0, centre_shift), overlap_ratio)


def ring_outline(side: RingSide) -> Boundary:
    """Half a pitch of a ring's hole; beyond its ends it goes on as its mirror image."""
    return Boundary(tuple(s.curve for s in side.segments), end_normals=(-1 + 0j, -cmath.exp(-0.5j * side.pitch_angle)))


class _InternalMesh(MeshSearch):
    """The pinion's axis is the origin, the ring's lies at -distance; both see the mesh at 0."""

    def __init__(self, pair: InternalPair, ring_turn: float, centre_shift: float) -> None:
        self.pair, self.ring_turn = pair, ring_turn
        self.distance = pair.working_centre_distance + centre_shift
        pinion, ring = pair.sides
        super().__init__(
            (gear_outline(pinion), ring_outline(ring)),
            (pinion.segments, ring.segments),
            pair.module,
            (pair.pinion.root_radius, pair.pinion.tip_radius),
            (pair.pinion.pitch_angle, pair.ring.pitch_angle),
            pair.pinion.number_of_teeth / pair.ring.number_of_teeth,
        )

    def teeth_in_reach(self) -> tuple[int, int]:
        """All teeth where the tip circles overlap; where corners are clear, those on the path and one more."""
        lenses = [math.ceil(self._lens(k) / self.pitches[k] + 0.5) for k in (0, 1)]
        base = self.pair.ring.base_radius - self.pair.pinion.base_radius
        if self.distance > base:
            nominal = self.pair.mesh
            angle = math.acos(base / self.distance)
            mesh = InternalMesh(nominal.teeth, nominal.base_radii, nominal.tip_radii, self.distance, angle)
            if mesh.trochoid_interference().margin > _CLEAR_CORNERS * self.module:
                teeth = self._teeth_on_path(angle)
                lenses = [min(teeth, lens) for lens in lenses]
        return min(lenses[0], self.pair.teeth[0] // 2 + 1), min(lenses[1], self.pair.teeth[1] // 2 + 1)

    def _teeth_on_path(self, angle: float) -> int:
        ring, pinion = self.pair.ring, self.pair.pinion
        pitch_point = ring.base_radius * math.tan(angle)
        low = math.sqrt(max(ring.tip_radius**2 - ring.base_radius**2, 0.0))
        high = math.sqrt(pinion.tip_radius**2 - pinion.base_radius**2) + self.distance * math.sin(angle)
        along = max(pitch_point - low, high - pitch_point, 0.0)
        return math.ceil(along / self.pair.base_pitch + 0.5) + 1

    def _lens(self, which: int) -> float:
        """Half of the angle, about each axis, in which the pinion's tip circle lies outside the ring's, rad."""
        one, two, a = self.pair.pinion.tip_radius, self.pair.ring.tip_radius, self.distance
        if two >= one + a:
            return 0.0
        cosine = (two**2 - one**2 - a**2) / (2 * a * one) if which == 0 else (a**2 + two**2 - one**2) / (2 * a * two)
        return math.acos(min(1.0, max(-1.0, cosine)))

    def second_position(self, drive: Real) -> Real:
        return self.pair.second_rotation(0.0) + self.ring_turn + self.rate * drive

    def facing_copy(self, position: Real) -> Real:
        return np.round(-position / self.pitches[1])

    def placing(self, position: Real, copy: Real) -> tuple[Complex, Complex]:
        turn = np.exp(1j * (position + copy * self.pitches[1]))
        return turn, np.full(turn.shape, -self.distance + 0j)

    def to_fixed(self, points: Complex, drive: Real) -> tuple[Complex, Complex]:
        turned = np.exp(1j * self.second_position(drive)) * points
        return turned - self.distance, 1j * self.rate * turned

    @property
    def arm(self) -> float:
        return self.pair.ring.base_radius

    @property
    def closing(self) -> int:
        return -1

    @property
    def reach(self) -> float:
        return self.pair.ring.root_radius

    def to_second(self, points: Complex, drive: Real, turn: Real | float = 0.0) -> tuple[Complex, Complex]:
        back = np.exp(-1j * (self.second_position(drive) + turn))
        moved = np.exp(1j * drive) * points
        return back * (moved + self.distance), 1j * back * (moved - self.rate * (moved + self.distance))

    def corner_window(self, which: int, corners: Complex) -> tuple[Real, float]:
        lens = min(self._lens(which), ((self.first_teeth, self.second_teeth)[which] + 0.5) * self.pitches[which])
        if not which:
            return -np.angle(corners), lens
        drive = (-np.angle(corners) - float(self.second_position(np.zeros(1))[0])) / self.rate
        return drive, lens / self.rate

    def closed_form(self, drive: Real, shift: float = 0.0) -> Real:
        return flank_gaps(self.pair, drive, self.second_position(drive) + shift, self.distance)
