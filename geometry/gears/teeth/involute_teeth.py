"""What pinion cutters, external gears and rings have in common: involute teeth on a reference circle."""

from __future__ import annotations

import math

from geometry.base.record import Record


class InvoluteTeeth(Record):
    """Teeth of a module (mm) round a circle, with flanks of one base circle; the transverse section."""

    module: float
    number_of_teeth: int

    @property
    def pressure_angle(self) -> float:
        """Alpha on the reference circle, rad."""
        raise NotImplementedError

    @property
    def sign(self) -> int:
        """1 where teeth point away from the axis, -1 in a ring: that of its numbers in ISO 21771."""
        return 1

    @property
    def pitch_angle(self) -> float:
        """Angle from tooth to tooth, rad."""
        return 2 * math.pi / self.number_of_teeth

    @property
    def reference_radius(self) -> float:
        """r = m z / 2."""
        return self.module * self.number_of_teeth / 2

    @property
    def base_radius(self) -> float:
        """r_b = r cos(alpha)."""
        return self.reference_radius * math.cos(self.pressure_angle)
