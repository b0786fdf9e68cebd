"""The conditions of an internal mesh: involute interference, trochoid interference, radial assembly.

They hold for a ring with its pinion and, with the cutter in the pinion's place, for how the ring is made. Source: the
conditions of KHK and of the Elements of Metric Gear Technology, here each with its margin in mm.
"""

from __future__ import annotations

import math

from geometry.base.angles import involute_function, roll_minus_polar, tangent_length
from geometry.base.both import both
from geometry.base.record import Record
from geometry.base.roots import bracketed_root
from geometry.gears.teeth.limits import Margin


class InternalMesh(Record):
    """Pinion (1) or cutter inside a ring (2): teeth, base and tip radii, axis distance (mm), working angle (rad).

    The flanks touch, so that backlash does not enter: a mesh with backlash is no worse.
    """

    teeth: tuple[int, int]
    base_radii: tuple[float, float]
    tip_radii: tuple[float, float]
    distance: float
    angle: float

    def _tip_involutes(self) -> tuple[float, float]:
        """inv(alpha_a) of both tips, rad; a tip inside its base circle counts as on it."""
        return both(
            roll_minus_polar(tangent_length(a, b) / b) for a, b in zip(self.tip_radii, self.base_radii, strict=True)
        )

    def involute_interference(self) -> Margin:
        """Where the ring's flank begins against where the pinion's involute can reach, along the line of action, mm.

        z_1 / z_2 >= 1 - tan(alpha_a2) / tan(alpha_w), times r_b2 tan(alpha_w).
        """
        tip, base = self.tip_radii[1], self.base_radii[1]
        # a tip circle inside the base circle has no involute there: its own depth counts
        value = math.sqrt((tip - base) * (tip + base)) if tip >= base else tip - base
        return Margin.above("involute_interference", value, self.distance * math.sin(self.angle))

    def trochoid_interference(self) -> Margin:
        """Room between the tip corners where both tip circles cross, as an arc on the ring's tip circle, mm.

        theta_1 z_1 / z_2 + inv(alpha_w) - inv(alpha_a2) - theta_2. Where the tip circles do not cross, the corners
        never meet if the ring's is the larger (margin inf); else, cos(theta_1) <= -1, the teeth always do (-inf).
        """
        first, second = self._crossing_angles()
        if first is None or second is None:
            return self._within("trochoid_interference")
        ratio = self.teeth[0] / self.teeth[1]
        tips, working = self._tip_involutes(), involute_function(self.angle)
        scale = self.tip_radii[1]
        value = scale * ((first + tips[0] - working) * ratio + working - tips[1])
        return Margin.above("trochoid_interference", value, scale * second)

    def _within(self, name: str) -> Margin:
        """What tip circles that do not cross keep wholly (inf) or, the ring's the smaller, not at all (-inf)."""
        room, needed = self.tip_radii[1], self.tip_radii[0] + self.distance
        return Margin(name, room, needed, math.inf if room >= needed else -math.inf)

    def _crossing_angles(self) -> tuple[float | None, float | None]:
        """Polar angles about both axes, from the line of centres, at which the tip circles cross."""
        (one, two), a = self.tip_radii, self.distance
        if one * two * a == 0:
            # a point crosses no circle, nor do circles about one axis
            return None, None
        cosines = (two * two - one * one - a * a) / (2 * a * one), (a * a + two * two - one * one) / (2 * a * two)
        if not all(-1 < c < 1 for c in cosines):
            return None, None
        return math.acos(cosines[0]), math.acos(cosines[1])

    def radial_assembly(self) -> Margin:
        """Whether the pinion goes into the ring along the line of centres: least room between tip corners, mm.

        The pinion's corner at the angle f about its axis faces the ring's at z_1/z_2 (f + inv(alpha_a1) -
        inv(alpha_w)) - inv(alpha_a2) + inv(alpha_w). The corners' distances from the line of centres differ least at
        the one root of the derivative; the margin vanishes where the arcsine form of the source does.
        """
        (one, two), ratio = self.tip_radii, self.teeth[0] / self.teeth[1]
        tips, working = self._tip_involutes(), involute_function(self.angle)
        first, _ = self._crossing_angles()
        if first is None:
            return self._within("radial_assembly")

        def ring_angle(f: float) -> float:
            return ratio * (f + tips[0] - working) - tips[1] + working

        def rate(f: float) -> float:
            return one * math.cos(f) - ratio * two * math.cos(ring_angle(f))

        # beyond the crossing of the tip circles the pinion's corner stays inside the ring's teeth
        last = min(first, math.pi / 2)
        at = bracketed_root(rate, 0.0, last).value if rate(0.0) > 0 > rate(last) else (last if rate(last) >= 0 else 0.0)
        return Margin.above("radial_assembly", two * math.sin(ring_angle(at)), one * math.sin(at))

    def margins(self) -> tuple[Margin, ...]:
        """All three, each >= 0 where kept."""
        return self.involute_interference(), self.trochoid_interference(), self.radial_assembly()
