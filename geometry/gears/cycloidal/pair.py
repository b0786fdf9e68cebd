"""Two cycloidal gears in mesh: each one's tips touch the other's roots along the circle that has drawn both."""

from __future__ import annotations

import math

import numpy as np

from geometry.base.both import both
from geometry.base.findings import Finding
from geometry.base.record import Record
from geometry.curves.curve import Real
from geometry.gears.cycloidal.gear import CycloidalGear, cycloidal_side
from geometry.gears.mesh.gears import TurningMesh


class CycloidalPair(Record):
    """A gear and its mate: of one module, each one's inner rolling circle as large as the other's outer one."""

    first: CycloidalGear
    second: CycloidalGear

    @property
    def centre_distance(self) -> float:
        """a = r_1 + r_2, mm."""
        return self.first.pitch_radius + self.second.pitch_radius

    @property
    def normal_backlash(self) -> float:
        """j_bn, mm: on the pitch circles, where the flanks are radial, that along them."""
        return self.first.circumferential_thinning + self.second.circumferential_thinning

    @property
    def approach_ratio(self) -> float:
        """Pitches through which a flank of the first, which drives, touches before the line of centres."""
        return self.second.tip_roll / self.second.pitch_angle

    @property
    def recess_ratio(self) -> float:
        """Pitches through which it touches beyond the line of centres, where clockwork would have it."""
        return self.first.tip_roll / self.first.pitch_angle

    @property
    def contact_ratio(self) -> float:
        """Both together: above 1 the drive is not interrupted."""
        return self.approach_ratio + self.recess_ratio

    @property
    def greatest_pressure_angles(self) -> tuple[float, float]:
        """At the end of contact on the tips of the first and of the second, rad; 0 at the pitch point.

        A chord of the rolling circle through the pitch point leans on its tangent by half of the arc.
        """
        return both(g.tip_roll * g.pitch_radius / (2 * g.tip_rolling_radius) for g in (self.first, self.second))

    @property
    def tip_clearances(self) -> tuple[float, float]:
        """Between the tips of the second and the roots of the first, and the other way round, mm."""
        return both(
            self.centre_distance - other.tip_radius - own.root_radius
            for own, other in ((self.first, self.second), (self.second, self.first))
        )

    def contact_radii(self) -> tuple[float, float]:
        """Where contact ends on the root flank of the first and of the second, mm."""
        return both(
            abs(complex(own.root_flank().point(-other.tip_roll * other.pitch_radius / own.pitch_radius)))
            for own, other in ((self.first, self.second), (self.second, self.first))
        )

    def second_rotation(self, rotation: float, direction: float = 0.0) -> float:
        """Rotation of the second where the first stands so, in the middle of the play, rad."""
        ratio = self.first.number_of_teeth / self.second.number_of_teeth
        return direction + math.pi - self.second.pitch_angle / 2 - (rotation - direction) * ratio

    def findings(self) -> tuple[Finding, ...]:
        """A drive that is interrupted, tips that strike roots or run into their fillets."""
        found = []
        if self.contact_ratio < 1:
            found.append(Finding("contact_ratio", self.contact_ratio, 1.0))
        gears = ("first", self.first), ("second", self.second)
        for (name, gear), clearance, radius in zip(gears, self.tip_clearances, self.contact_radii(), strict=True):
            if clearance < 0:
                found.append(Finding(f"tip_clearance_{name}", clearance, 0.0))
            elif radius < gear.form_radius:
                found.append(Finding(f"contact_below_flank_{name}", radius, gear.form_radius))
        return tuple(found)


class CycloidalMesh(TurningMesh):
    """The exact gap of a pair through a pitch; ``second_turn``, rad, and ``distance_shift``, mm, off its place."""

    def __init__(self, pair: CycloidalPair, second_turn: float = 0.0, distance_shift: float = 0.0) -> None:
        first, second = pair.first, pair.second
        sides = cycloidal_side(first), cycloidal_side(second)
        radii = (first.root_radius, first.tip_radius), (second.root_radius, second.tip_radius)
        distance, start = pair.centre_distance + distance_shift, pair.second_rotation(0.0) + second_turn
        super().__init__(sides, first.module, radii, distance, 1, start, second.pitch_radius)

    def teeth_in_reach(self) -> tuple[int, int]:
        """What both tip circles enclose."""
        return both(math.ceil(self.lens(k) / self.pitches[k] + 0.5) for k in (0, 1))

    def closed_form(self, drive: Real, shift: float = 0.0) -> Real:
        """None for cycloids."""
        return np.full((len(drive), 2), np.inf)
