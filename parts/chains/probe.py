"""What the files of a sprocket must also do: take a roller in every gap, on the pitch circle."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from parts.base.readback import Probe, Probed, outline_at
from parts.base.texts import unless

if TYPE_CHECKING:
    from geometry.gears.chains.sprocket import Sprocket
    from parts.base.readback import ReadBack

_ROUNDING = 1e-12


class RollerProbe(Probe):
    """A roller set in every gap; ``height``: where a solid is cut, mm."""

    sprocket: Sprocket
    height: float

    def run(self, file: ReadBack, offset: float, declared: float) -> Probed:
        """The least gap to its rollers, of all gaps at once; see ``parts.base.readback.Probe``."""
        sprocket = self.sprocket
        pitch = sprocket.pitch_angle
        points = outline_at(file, self.height, "there are no teeth for a chain") * np.exp(-0.5j * pitch)
        points *= np.exp(-1j * pitch * np.round(np.angle(points) / pitch))
        gap = float(np.abs(points - sprocket.pitch_radius).min()) - sprocket.chain.roller_diameter / 2
        wanted = sprocket.gap.depth - sprocket.chain.roller_diameter / 2
        allowed = declared + offset + _ROUNDING * sprocket.pitch_radius
        failures = unless(gap >= wanted - allowed, "the gap between rollers and teeth is {gap:.6g} mm", gap=gap)
        return Probed({"roller_gap": gap}, tuple(failures))
