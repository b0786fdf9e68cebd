"""Contact of two gears on parallel axes, a pinion in its ring too, over one whole pitch, on the exact outlines."""

from __future__ import annotations

import math

import numpy as np

from geometry.base.angles import tangent_length
from geometry.curves.curve import Complex, Real
from geometry.gears.mesh.search import MeshSearch, gear_outline
from geometry.gears.pairs.external import ExternalPair
from geometry.gears.pairs.internal import InternalPair
from geometry.gears.teeth.internal_mesh import InternalMesh
from geometry.gears.teeth.ring_tooth import RingSide
from geometry.gears.teeth.tooth import ToothSide

# where the tip corners keep this distance, in modules, only the teeth on the path of contact are looked at
_CLEAR_CORNERS = 0.1


class TurningMesh(MeshSearch):
    """Two bodies that turn about parallel axes: the first about the origin, the second about ``centre`` on the x axis.

    ``sides``: a side of a tooth of each; ``radii``: of the root and of the tip of each; ``sign``: -1 in a ring;
    ``start``: rotation of the second where the first stands at 0, rad; ``arm``: that of the flanks of the second, mm.
    """

    def __init__(
        self,
        sides: tuple[ToothSide, ToothSide | RingSide],
        module: float,
        radii: tuple[tuple[float, float], tuple[float, float]],
        distance: float,
        sign: int,
        start: float,
        arm: float,
    ) -> None:
        (first, second), self.distance, self.sign = sides, distance, sign
        # how far each reaches, a ring inwards
        self.tip_radii = radii[0][1], radii[1][1]
        # of the second's axis
        self.centre = sign * distance
        teeth = [round(math.tau / side.pitch_angle) for side in sides]
        rate = -sign * teeth[0] / teeth[1]
        super().__init__(
            (gear_outline(first), gear_outline(second)),
            (first.segments, second.segments),
            module,
            radii[0],
            (first.pitch_angle, second.pitch_angle),
            rate,
            start,
            facing=math.pi if sign > 0 else 0.0,
            arm=arm,
            closing=sign,
            reach=max(radii[1]),
            relative_turning=abs(1 - rate),
        )

    def lens(self, which: int) -> float:
        """Half of the angle, about each axis, of its tip circle that lies within the mate's material, rad."""
        tip, mate = (self.tip_radii[k] for k in (which, 1 - which))
        cosine = (self.distance**2 + tip**2 - mate**2) / (2 * self.distance * tip)
        # the pinion in a ring is seen from its far side
        cosine = cosine if which else self.sign * cosine
        return math.acos(min(1.0, max(-1.0, cosine)))

    def placing(self, position: Real, copy: Real) -> tuple[Complex, Complex]:
        """The copy about the second's axis."""
        turn = np.exp(1j * (position + copy * self.pitches[1]))
        return turn, np.full(turn.shape, self.centre + 0j)

    def to_fixed(self, points: Complex, drive: Real) -> tuple[Complex, Complex]:
        """Turned about the second's axis."""
        turned = np.exp(1j * self.second_position(drive)) * points
        return self.centre + turned, 1j * self.rate * turned

    def to_second(self, points: Complex, drive: Real, turn: Real | float = 0.0) -> tuple[Complex, Complex]:
        """Turned back about the second's axis."""
        second = self.second_position(drive) + turn
        turned = np.exp(1j * (drive - second)) * points
        centre = -self.centre * np.exp(-1j * second)
        return centre + turned, -1j * self.rate * centre + 1j * (1 - self.rate) * turned

    def corner_window(self, which: int, corners: Complex) -> tuple[Real, float]:
        """Where a corner lies within the mate's tip circle, by the polar angle that it has on its own body."""
        lens = min(self.lens(which), ((self.first_teeth, self.second_teeth)[which] + 0.5) * self.pitches[which])
        if not which:
            return -np.angle(corners), lens
        return (self.facing - np.angle(corners) - self.start) / self.rate, lens / abs(self.rate)


class GearMesh(TurningMesh):
    """Drive angle and "first" are the first gear's or the pinion's, "second" the other's or the ring's.

    The first axis is the origin and the mesh lies towards +x. An external mate's axis lies at +distance and sees the
    mesh at pi; a ring's lies at -distance, and both see it at 0.

    Parameters
    ----------
    second_turn
        Rotation of the second, rad, beyond the middle of the play (``pair.second_rotation``);
        +- ``normal_backlash / (2 second.base_radius)`` drives it to the contact of one flank.
    distance_shift
        mm by which the centre distance is more than the pair's.

    Raises
    ------
    ParameterError
        A gear of the pair cannot be built.
    """

    def __init__(
        self, pair: ExternalPair | InternalPair, second_turn: float = 0.0, distance_shift: float = 0.0
    ) -> None:
        self.pair, (first, second) = pair, pair.gears
        radii = (first.root_radius, first.tip_radius), (second.root_radius, second.tip_radius)
        distance, start = pair.working_centre_distance + distance_shift, pair.second_rotation(0.0) + second_turn
        super().__init__(pair.sides, pair.module, radii, distance, pair.sign, start, second.base_radius)

    def teeth_in_reach(self) -> tuple[int, int]:
        """Enough for the whole path of contact and one more, and no more than the tip circles enclose.

        In a ring all within the tip circles, unless corners are clear.
        """
        lenses = [math.ceil(self.lens(k) / self.pitches[k] + 0.5) for k in (0, 1)]
        if not isinstance(self.pair, InternalPair):
            teeth = min(self._teeth_on_path(), lenses[1])
            return teeth, teeth
        base = self.pair.ring.base_radius - self.pair.pinion.base_radius
        if self.distance > base:
            nominal, angle = self.pair.mesh, math.acos(base / self.distance)
            mesh = InternalMesh(nominal.teeth, nominal.base_radii, nominal.tip_radii, self.distance, angle)
            if mesh.trochoid_interference().margin > _CLEAR_CORNERS * self.module:
                teeth = self._teeth_on_path_in_ring(self.pair, angle)
                lenses = [min(teeth, lens) for lens in lenses]
        return min(lenses[0], self.pair.teeth[0] // 2 + 1), min(lenses[1], self.pair.teeth[1] // 2 + 1)

    def _teeth_on_path(self) -> int:
        gears = self.pair.gears
        along = sum(tangent_length(g.tip_radius, g.base_radius) for g in gears)
        least = tangent_length(self.distance, gears[0].base_radius + gears[1].base_radius)
        return math.ceil(max(along - least, 0.0) / self.pair.base_pitch / 2 + 0.5) + 1

    def _teeth_on_path_in_ring(self, pair: InternalPair, angle: float) -> int:
        ring, pinion = pair.ring, pair.pinion
        pitch_point = ring.base_radius * math.tan(angle)
        low = tangent_length(ring.tip_radius, ring.base_radius)
        high = tangent_length(pinion.tip_radius, pinion.base_radius) + self.distance * math.sin(angle)
        along = max(pitch_point - low, high - pitch_point, 0.0)
        return math.ceil(along / pair.base_pitch + 0.5) + 1

    def closed_form(self, drive: Real, shift: float = 0.0) -> Real:
        """That of two involutes."""
        return self.pair.flank_gaps(drive, self.second_position(drive) + shift, self.distance)
