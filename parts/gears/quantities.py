"""The named results that gears and rings report alike: diameters, pitch, thicknesses, those of a helix."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from parts.keys.helix import ToothedKeys, helix_quantities

if TYPE_CHECKING:
    from geometry.gears.teeth.ring import RingGear
    from geometry.gears.teeth.spur import SpurGear


def circles(gear: SpurGear | RingGear, root_form_diameter: float) -> dict[str, float]:
    """Diameters of a transverse section, mm."""
    return {
        "tip_diameter": 2 * gear.tip_radius,
        "reference_diameter": 2 * gear.reference_radius,
        "base_diameter": 2 * gear.base_radius,
        "root_form_diameter": root_form_diameter,
        "root_diameter": 2 * gear.root_radius,
    }


def tooth_quantities(keys: ToothedKeys, gear: SpurGear | RingGear, tip_thickness: float) -> dict[str, float]:
    """Pitch and tooth thicknesses of a transverse section, and what helical teeth have beside, mm."""
    return {
        "pitch": math.pi * gear.module,
        "tooth_thickness": gear.reference_thickness,
        "tip_tooth_thickness": tip_thickness,
        **helix_quantities(keys, gear.reference_radius),
    }
