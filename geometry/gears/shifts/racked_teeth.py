"""What pairs of external wheels and pinions in rings have in common, whatever their shifts."""

from __future__ import annotations

from geometry.base.record import Record
from geometry.gears.teeth.basic_rack import BasicRack


class RackedTeeth(Record):
    """Two numbers of teeth, and the rack of the first."""

    first_teeth: int
    second_teeth: int
    rack: BasicRack

    @property
    def gear_ratio(self) -> float:
        """u = z2 / z1."""
        return self.second_teeth / self.first_teeth

    @property
    def teeth(self) -> tuple[int, int]:
        """z1, z2."""
        return self.first_teeth, self.second_teeth
