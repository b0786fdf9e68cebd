"""Two noncircular gears of one pairing: how they stand to each other, their ratio, their contact ratio.

At the centrode's arc length s_1 of the first gear the second one touches at s_2 = shift - s_1; both were cut by one
rack seen from its two sides, so that their flanks touch where both touch it.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.findings import Finding
from geometry.base.record import Record
from geometry.curves.curve import Real
from geometry.gears.noncircular.gear import NoncircularGear


class NoncircularPair(Record):
    """Two gears in mesh, in either order; the first one's frame, its axis, is the origin."""

    first: NoncircularGear
    second: NoncircularGear

    @property
    def centre_distance(self) -> float:
        """a, mm."""
        assert self.first.pairing is not None
        return self.first.pairing.centre_distance

    @property
    def normal_backlash(self) -> float:
        """j_bn = (thinning_1 + thinning_2) cos(alpha), mm."""
        thinning = self.first.circumferential_thinning + self.second.circumferential_thinning
        return thinning * math.cos(self.first.rack.pressure_angle)

    @property
    def shift(self) -> float:
        """s_1 + s_2 of a contact, mm: 0 of driver and mate, half a lobe of two equal drivers."""
        if self.first.first_tooth != self.second.first_tooth:
            return 0.0
        return self.second.line.length / (2 * self.second.line.lobes)

    def second_rotation(self, rotation: float, direction: float = 0.0) -> float:
        """Rotation of the second gear where the first stands so, rad; ``direction`` of the line of centres."""
        arc = self.first.line.arc_at_angle(direction - rotation)
        return direction + math.pi - float(self.second.line.angle(self.shift - arc))

    def first_rotation(self, rotation: float, direction: float = 0.0) -> float:
        """Rotation of the first gear where the second stands so, rad: ``second_rotation`` back."""
        arc = self.second.line.arc_at_angle(direction + math.pi - rotation)
        return direction - float(self.first.line.angle(self.shift - arc))

    def rotations(self, arc: ArrayLike) -> tuple[Real, Real]:
        """Rotations of both gears at contacts s_1, the line of centres along +x, rad."""
        s = np.asarray(arc, dtype=float)
        return -self.first.line.angle(s), math.pi - self.second.line.angle(self.shift - s)

    @property
    def ratio_range(self) -> tuple[float, float]:
        """Least and greatest ratio."""
        least, greatest = self.first.radii
        return least / (self.centre_distance - least), greatest / (self.centre_distance - greatest)

    def contact_spans(self) -> Real:
        """Lengths along the centrode, mm, over which each flank of the first gear touches: (2, teeth) of a period."""
        pitch = self.first.pitch
        gears = self.first, self.second
        spans = []
        outlines = [g.outline for g in gears]
        teeth = [g.number_of_teeth // g.count for g in gears]
        for side in (0, 1):
            # flank k of the first gear meets flank j of the second: crossings are opposite, up to the shift
            number = np.arange(teeth[0]) + outlines[0].first
            sign = 1.0 if side == 0 else -1.0
            low = [sign * o.sides.start[side] for o in outlines]
            high = [sign * o.sides.at_tip[side] for o in outlines]
            # the flank of the second that crosses the pitch line where the first one's does
            half = sign * pitch / 4
            crossing = (number + gears[0].first_tooth) * pitch - half
            index = np.round((self.shift - crossing + half) / pitch - gears[1].first_tooth).astype(int)
            index -= outlines[1].first
            turns, which = np.divmod(index, teeth[1])
            moved = sign * turns * teeth[1] * pitch
            from_mate = sign * self.shift - (high[1][which] + moved), sign * self.shift - (low[1][which] + moved)
            spans.append(np.minimum(high[0], from_mate[1]) - np.maximum(low[0], from_mate[0]))
        return np.array(spans)

    @property
    def least_contact_ratio(self) -> float:
        """The shortest contact of a flank over the pitch."""
        return float(self.contact_spans().min()) / self.first.pitch

    def findings(self) -> tuple[Finding, ...]:
        """Teeth that part."""
        ratio = self.least_contact_ratio
        return (Finding("contact_ratio", ratio, 1.0),) if ratio < 1 else ()
