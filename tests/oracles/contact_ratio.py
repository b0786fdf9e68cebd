"""The contact ratio of main flanks from lengths on the line of action, in which no angle at a tip is needed."""

from __future__ import annotations

import math

from geometry.gears.pairs.external import ExternalPair


def main_flank_contact_ratio(pair: ExternalPair) -> float:
    """eps_alpha where only what no relief takes away of the flanks counts: (g_f + g_a) / p_et."""
    bases = pair.first.base_radius, pair.second.base_radius
    tips = [side.flank_radii()[1] for side in pair.sides]
    length = sum(math.sqrt(tip**2 - base**2) for tip, base in zip(tips, bases, strict=True))
    length -= pair.working_centre_distance * math.sin(pair.working_pressure_angle)
    return length / (2 * math.pi * bases[0] / pair.first.number_of_teeth)
