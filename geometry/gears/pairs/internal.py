"""The internal pair, pinion in ring: how it is made, and the conditions that only it has.

The ring's axis is the origin. Results for both gears are tuples (pinion, ring). Shift of the ring is positive away from
its axis, so that everything follows from x2 - x1. Source: GOST 19274, KHK, Elements of Metric Gear Technology.
"""

from __future__ import annotations

from functools import cached_property

from geometry.base.errors import Nearest, ParameterError
from geometry.gears.pairs.involute import InvolutePair, Sums, common_sums, with_room, working_angle
from geometry.gears.teeth.internal_mesh import InternalMesh
from geometry.gears.teeth.limits import Margin
from geometry.gears.teeth.ring import RingGear
from geometry.gears.teeth.ring_tooth import RingSide, ring_side
from geometry.gears.teeth.spur import SpurGear


class InternalPair(InvolutePair[RingGear, RingSide], dict=True):
    """A pinion in mesh with a ring; made by ``internal_pair``."""

    roles = ("pinion", "ring")

    @cached_property
    def second_side(self) -> RingSide:
        """The exact side of the ring's spaces; raises ParameterError where it cannot be built."""
        return ring_side(self.second)

    @property
    def pinion(self) -> SpurGear:
        """The first gear."""
        return self.first

    @property
    def ring(self) -> RingGear:
        """The second."""
        return self.second

    def pinion_rotation(self, ring_rotation: float, direction: float = 0.0) -> float:
        """Rotation of the pinion that brings a tooth of it into the middle of a space of the ring, rad.

        ``direction`` is that of the line of centres. Not reduced to one turn.
        """
        return direction + (ring_rotation - direction) * self.gear_ratio

    @property
    def mesh(self) -> InternalMesh:
        """The numbers that decide on interference, with the tips where their flanks end."""
        bases = self.pinion.base_radius, self.ring.base_radius
        tips = self.pinion.tip_radius, self.ring.tip_radius
        return InternalMesh(self.teeth, bases, tips, self.working_centre_distance, self.working_pressure_angle)

    def margins(self) -> tuple[Margin, ...]:
        """Involute and trochoid interference and radial assembly (``InternalMesh``), then those of every pair."""
        return *self.mesh.margins(), *super().margins()


def internal_pair(pinion: SpurGear, ring: RingGear, working_centre_distance: float | None = None) -> InternalPair:
    """The pair at zero backlash but for thinning, or at a given centre distance, mm. No tip is changed.

    inv(alpha_w) = inv(alpha) + 2 (x_2 - x_1) tan(alpha) / (z_2 - z_1), a_w = (r_b2 - r_b1) / cos(alpha_w).

    Raises
    ------
    ParameterError
        Modules or pressure angles differ, the pinion has as many teeth as the ring, no working angle exists, or the
        teeth would overlap at the centre distance. Each names the nearest value that works.
    """
    sums = common_sums(pinion, ring, "pinion")
    if sums.teeth >= 0:
        least = Nearest(pinion.number_of_teeth + 1, "at_least")
        raise ParameterError("number_of_teeth", ring.number_of_teeth, "not_above_pinion_teeth", least)
    if working_centre_distance is None:
        angle = working_angle(sums, pinion, ring, "pinion")
        distance = sums.distance(angle)
    else:
        # farther out there is no more room, but less
        sums.refuse_below_base(working_centre_distance)
        distance, angle = with_room(sums, working_centre_distance)
    return InternalPair(pinion, ring, distance, angle)


def shift_difference(pinion: SpurGear, ring: RingGear, distance: float) -> float:
    """x_2 - x_1 of the pair without thinning at a wanted centre distance, mm."""
    return -Sums.of(pinion, ring).shift_at(distance)
