"""What wheels of any teeth round a circle have in common."""

from __future__ import annotations

import math

from geometry.base.record import Record


class RoundTeeth(Record):
    """A wheel with so many equal teeth, the first of which is centred on +x."""

    number_of_teeth: int

    @property
    def pitch_angle(self) -> float:
        """Angle from tooth to tooth, rad."""
        return 2 * math.pi / self.number_of_teeth
