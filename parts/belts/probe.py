"""What the files of a timing pulley must also do: leave room for a tooth of the belt in every groove."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from parts.base.readback import Probe, Probed, outline_at
from parts.base.texts import unless

if TYPE_CHECKING:
    from geometry.gears.belts.pulley import Pulley
    from parts.base.readback import ReadBack

_ROUNDING = 1e-12


class GrooveProbe(Probe):
    """The thickest pin that has room in the middle of every groove; ``height``: where a solid is cut, mm."""

    pulley: Pulley
    height: float

    def run(self, file: ReadBack, offset: float, declared: float) -> Probed:
        """The least gap to its pins, of all grooves at once; see ``parts.base.readback.Probe``."""
        from geometry.gears.belts.pulley import pulley_side
        from geometry.gears.mesh.search import gear_outline

        pulley, pitch = self.pulley, self.pulley.pitch_angle
        points = outline_at(file, self.height, "there are no teeth for a belt")
        # seen from tooth 1 its groove is half a pitch below
        centre = (pulley.outer_radius - pulley.depth / 2) * np.exp(-0.5j * pitch)
        radius = abs(float(gear_outline(pulley_side(pulley)).feet(np.array([centre])).distance[0]))
        points *= np.exp(-1j * pitch * np.round((np.angle(points) + pitch / 2) / pitch))
        gap = float(np.abs(points - centre).min()) - radius
        allowed = declared + offset + _ROUNDING * pulley.pitch_radius
        failures = unless(gap >= -allowed, "the gap between pins and grooves is {gap:.6g} mm", gap=gap)
        return Probed({"pin_gap": gap}, tuple(failures))
