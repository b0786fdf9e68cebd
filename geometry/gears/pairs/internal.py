"""The internal pair, pinion in ring: how it is made, and the conditions that only it has.

The ring's axis is the origin. Results for both gears are tuples (pinion, ring). Shift of the ring is positive away from
its axis, so that everything follows from x2 - x1. Source: GOST 19274, KHK, Elements of Metric Gear Technology.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from functools import cached_property

from geometry.base.errors import Nearest, ParameterError
from geometry.base.roots import bracketed_root
from geometry.curves.involute import Involute
from geometry.gears.pairs.involute import InvolutePair, Sums, common_sums, with_room, working_angle
from geometry.gears.teeth.internal_mesh import InternalMesh
from geometry.gears.teeth.limits import Margin
from geometry.gears.teeth.ring import RingGear
from geometry.gears.teeth.ring_tooth import RingSide, ring_side
from geometry.gears.teeth.side import Side
from geometry.gears.teeth.spur import SpurGear
from geometry.plane.profile import Label

# modules by which tips that yield keep off where they would touch a fillet or a root, and mm that are rounding
OFF_ROOT, _SAME = 0.005, 1e-9
# share of a fillet at its joint with the flank, where what touches it lies on the mate's flank
_JOINT = 1e-3


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

    @property
    def tip_limits(self) -> tuple[float, float]:
        """Largest tip diameter of the pinion and least of the ring that keep off the mate's fillet, mm."""
        line, forms = self._line_of_action, self._form_tangents()
        most = math.hypot(self.pinion.base_radius, max(forms[1] - line, 0.0))
        least = math.hypot(self.ring.base_radius, line + forms[0])
        pinion, ring = self._touching_corners()
        return 2 * min(most, pinion), 2 * max(least, ring)

    def _touching_corners(self) -> tuple[float, float]:
        """Radii of the points of both flanks that touch the mate's fillet as they pass it, mm; inf, 0: none does."""
        distance, ratio = self.working_centre_distance, self.gear_ratio

        def in_pinion(point: complex, direction: float) -> complex:
            return (point - cmath.rect(distance, direction)) * cmath.exp(1j * direction * (ratio - 1))

        def in_ring(point: complex, direction: float) -> complex:
            return (point + cmath.rect(distance, direction)) * cmath.exp(1j * direction * (1 / ratio - 1))

        one, two = self.working_radii
        pinion = _touching(self.second_side, two, in_pinion, self.pinion.flank(), 1)
        return pinion or math.inf, _touching(self.first_side, one, in_ring, self.ring.flank(), -1)

    def tips_off_roots(self) -> tuple[float | None, float | None]:
        """Tip radii, mm, that keep off the mate's fillet and root where those of the pair reach it; None: as they are.

        Given tip diameters stay. Others lie ``OFF_ROOT`` off: corners run on beyond the end of the involute.
        """
        off, (most, least), distance = OFF_ROOT * self.module, self.tip_limits, self.working_centre_distance
        most, least = (
            min(most / 2, self.ring.root_radius - distance),
            max(least / 2, distance + self.pinion.root_radius),
        )
        pinion, ring = (g.given_tip_diameter is None and self.effective_contact_ratio > 0 for g in self.gears)
        return (
            math.floor(1e4 * (most - off)) / 1e4 if pinion and self.pinion.tip_radius > most + _SAME else None,
            math.ceil(1e4 * (least + off)) / 1e4 if ring and self.ring.tip_radius < least - _SAME else None,
        )

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


def _touching(
    side: Side, pitch_radius: float, in_mate: Callable[[complex, float], complex], flank: Involute, inwards: int
) -> float:
    """Radius of the point of the mate's ``flank`` whose path touches the fillet of a ``side``, mm; 0: no point's does.

    A point of the fillet is touched where its normal passes through the pitch point (Willis), and all that touch it are
    a curve of the mate, ``in_mate(point, direction of the line of centres)``. It begins on the flank, where the fillet
    does. Where it ends in the mate's material, to the side ``inwards`` of the flank, it has crossed it.
    """
    fillet = next((segment.curve for segment in side.segments if segment.label is Label.ROOT_FILLET), None)
    if fillet is None:
        return 0.0
    root, joint = fillet.domain

    def touched(at: float) -> complex:
        point, normal = complex(fillet.point(at)), 1j * complex(fillet.tangent(at))
        along = -(point.conjugate() * normal).real
        beside = math.sqrt(max(along**2 - (abs(point) - pitch_radius) * (abs(point) + pitch_radius), 0.0))
        pitch_point = point + min(along - beside, along + beside, key=abs) * normal
        return in_mate(point, cmath.phase(pitch_point))

    def within(at: float) -> float:
        place = touched(at)
        return inwards * (cmath.phase(place) - flank.polar_angle_at_radius(abs(place)))

    last = joint - _JOINT * (joint - root)
    return abs(touched(bracketed_root(within, root, last).value)) if within(root) > 0 > within(last) else 0.0


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
