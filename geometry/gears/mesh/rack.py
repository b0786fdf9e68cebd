"""Contact of a gear with a rack over one whole pitch, on the exact outlines: verdict, gap curve, worst place."""

from __future__ import annotations

import math

import numpy as np

from geometry.base.angles import tangent_length
from geometry.base.placement import Placement2
from geometry.curves.curve import Complex, Real
from geometry.gears.mesh.search import MeshSearch, gear_outline
from geometry.gears.pairs.rack import RackPair, rack_flank_gaps
from geometry.plane.distance import Boundary
from geometry.plane.profile import Segment


def _as_gear(segments: tuple[Segment, ...]) -> tuple[Segment, ...]:
    """The lower half of a tooth that points to +x, space to tooth, as gears have it."""
    half_turn = Placement2(math.pi)
    return tuple(Segment(s.curve.mirrored().placed(half_turn), s.label) for s in reversed(segments))


class RackMesh(MeshSearch):
    """The rack's datum line lies at +distance; its position is y of a tooth's centre line, mm. It has no ends.

    Parameters
    ----------
    rack_shift
        mm that the rack stands to +y of the middle (``pair.rack_position``); +- normal backlash / (2 cos alpha) drives
        it to the contact of one flank.
    distance_shift
        mm by which the distance is more than the pair's.

    Raises
    ------
    ParameterError
        A part of the pair cannot be built.
    """

    def __init__(self, pair: RackPair, rack_shift: float = 0.0, distance_shift: float = 0.0) -> None:
        self.pair = pair
        self.distance = pair.distance + distance_shift
        gear, rack = pair.sides
        segments = _as_gear(rack.segments)
        outline = Boundary(tuple(s.curve for s in segments), end_normals=(1 + 0j, 1 + 0j))
        super().__init__(
            (gear_outline(gear), outline),
            (gear.segments, segments),
            pair.module,
            (pair.gear.root_radius, pair.gear.tip_radius),
            (pair.gear.pitch_angle, pair.rack.pitch),
            pair.gear.reference_radius,
            pair.rack.pitch / 2 + rack_shift,
            facing=0.0,
            arm=math.cos(pair.rack.rack.pressure_angle),
            closing=-1,
            reach=1.0,
            relative_turning=1.0,
        )

    def _reach(self) -> float:
        """Half of the rack's length that lies inside the gear's tip circle, mm."""
        tip, line = self.pair.gear.tip_radius, self.distance - self.pair.rack.addendum
        return math.sqrt(max(tip**2 - max(line, 0.0) ** 2, 0.0))

    def teeth_in_reach(self) -> tuple[int, int]:
        """Enough for the whole path of contact and one more, and no more than the tip circle encloses."""
        alpha = self.pair.rack.rack.pressure_angle
        radius = self.pair.gear.reference_radius
        after = tangent_length(self.pair.gear.tip_radius, self.pair.gear.base_radius) - radius * math.sin(alpha)
        before = (radius - self.distance + self.pair.rack.addendum) / math.sin(alpha)
        teeth = math.ceil(max(after, before, 0.0) / self.pair.base_pitch + 0.5) + 1
        teeth = min(teeth, math.ceil(self._reach() / self.pitches[1] + 0.5))
        return teeth, teeth

    def placing(self, position: Real, copy: Real) -> tuple[Complex, Complex]:
        """The copy moved along the datum line, its teeth to -x."""
        shift = np.asarray(self.distance + 1j * (position + copy * self.pitches[1]), dtype=np.complex128)
        return np.full_like(shift, -1.0), shift

    def to_fixed(self, points: Complex, drive: Real) -> tuple[Complex, Complex]:
        """Turned over and moved along."""
        moved = np.asarray(self.distance - points + 1j * self.second_position(drive))
        return moved, np.full_like(moved, 1j * self.rate)

    def to_second(self, points: Complex, drive: Real, turn: Real | float = 0.0) -> tuple[Complex, Complex]:
        """Moved back and turned over."""
        turned = np.exp(1j * drive) * points
        return self.distance + 1j * (self.second_position(drive) + turn) - turned, 1j * self.rate - 1j * turned

    def second_folded(self, points: Complex, vectors: Complex) -> tuple[Complex, Complex]:
        """Carried back by whole pitches and mirrored in a tooth's centre line."""
        points = points - 1j * self.pitches[1] * np.round(points.imag / self.pitches[1])
        upper = points.imag > 0
        return np.where(upper, np.conj(points), points), np.where(upper, np.conj(vectors), vectors)

    def corner_window(self, which: int, corners: Complex) -> tuple[Real, float]:
        """Where a corner lies within the gear's tip circle."""
        reach = min(self._reach(), (self.second_teeth + 0.5) * self.pitches[1])
        if not which:
            return -np.angle(corners), reach / self.pair.gear.reference_radius
        return (corners.imag - self.start) / self.rate, reach / self.rate

    def closed_form(self, drive: Real, shift: float = 0.0) -> Real:
        """That of an involute and a straight flank."""
        return rack_flank_gaps(self.pair, drive, self.second_position(drive) + shift, self.distance)
