"""What the files of a Geneva wheel must also do: let the pin through every slot, the disc into every locking arc."""

from __future__ import annotations

import cmath
from typing import TYPE_CHECKING

import numpy as np

from parts.base.readback import Probe, Probed, outline_at
from parts.base.texts import unless

if TYPE_CHECKING:
    from geometry.gears.pins.geneva import GenevaWheel
    from parts.base.readback import ReadBack

# places along a slot
_PLACES = 65
# rounding, as a part of the wheel's size
_ROUNDING = 1e-12


class SlotProbe(Probe):
    """A pin moved along the slots, the disc held in the arcs; ``height``: where a solid is cut, mm."""

    wheel: GenevaWheel
    height: float

    def run(self, file: ReadBack, offset: float, declared: float) -> Probed:
        """Both by the distances of the outline's points, all slots at once; see ``parts.base.readback.Probe``."""
        wheel, drive = self.wheel, self.wheel.drive
        number, pitch = 2 if drive.internal else 1, 2 * drive.half_slot_angle
        points = outline_at(file, self.height, "there are no slots for the pin to pass", number)
        places = np.linspace(drive.mouth_radius, drive.deepest_radius, _PLACES)
        slots = points * np.exp(-1j * pitch * np.round(np.angle(points) / pitch))
        pin = min(float(np.abs(slots - place).min()) for place in places) - wheel.pin_diameter / 2
        half = cmath.rect(1.0, pitch / 2)
        arcs = points / half * np.exp(-1j * pitch * np.round(np.angle(points / half) / pitch))
        disc = float(np.abs(arcs - drive.centre_distance).min()) - wheel.locking_radius
        allowed = declared + offset + _ROUNDING * drive.centre_distance
        wanted = min(wheel.slot_clearance / 2, wheel.end_clearance), wheel.locking_clearance
        failures = [
            *unless(pin >= wanted[0] - allowed, "the gap between pin and slots is {gap:.6g} mm", gap=pin),
            *unless(disc >= wanted[1] - allowed, "the gap between disc and locking arcs is {gap:.6g} mm", gap=disc),
        ]
        return Probed({"slot_gap": pin, "locking_gap": disc}, tuple(failures))
