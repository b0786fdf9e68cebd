"""Sliding of a pair along its line of action: specific sliding, approach and recess, speeds.

The first gear drives. Distances are measured along the line of action in the transverse section, mm; the line runs
from the first gear's base circle (0) to the second's (``line_length``), which a ring has on the other side of the first
(``sign`` -1). Source: ISO 21771; practicum, figure 3.11.
"""

from __future__ import annotations

import math

from geometry.base.angles import tangent_length
from geometry.base.record import Record
from geometry.gears.pairs.external import ExternalPair
from geometry.gears.pairs.internal import InternalPair

# of the line: as near as a root search or a limit typed with six digits comes to a base circle
_ON_THE_BASE_CIRCLE = 1e-6


class ActiveLine(Record):
    """Where contact begins (``start``, A) and ends (``end``, E) and where the pitch point lies (``pole``, P), mm."""

    line_length: float
    start: float
    end: float
    pole: float
    gear_ratio: float
    sign: int = 1

    @property
    def length(self) -> float:
        """g_alpha = A E: the practicum's segment ab, mm."""
        return self.end - self.start

    @property
    def approach(self) -> float:
        """g_f = A P, mm; negative where the pole lies before the active line."""
        return self.pole - self.start

    @property
    def recess(self) -> float:
        """g_a = P E, mm; negative where the pole lies beyond the active line."""
        return self.end - self.pole

    def specific_sliding(self, position: float) -> tuple[float, float]:
        """zeta of the first and of the second flank in contact there: 1 - v_t2 / v_t1 and 1 - v_t1 / v_t2."""
        return specific_sliding(position, self.line_length, self.gear_ratio, self.sign)

    @property
    def root_sliding(self) -> tuple[float, float]:
        """zeta_f1 at A and zeta_f2 at E: the greatest of each gear, negative."""
        return self.specific_sliding(self.start)[0], self.specific_sliding(self.end)[1]

    @property
    def tip_sliding(self) -> tuple[float, float]:
        """zeta_a1 at E and zeta_a2 at A."""
        return self.specific_sliding(self.end)[0], self.specific_sliding(self.start)[1]

    def speed_factors(self, first_working_radius: float) -> tuple[float, float]:
        """K_g = v_g / v_t at A and at E: sliding speed as a part of the speed of the working circles."""
        per_mm = (1 + self.sign / self.gear_ratio) / first_working_radius
        return self.approach * per_mm, self.recess * per_mm


def active_line(pair: ExternalPair | InternalPair) -> ActiveLine:
    """The active part of the line of action, between the ends of the active profiles."""
    base = pair.first.base_radius
    low, high = (tangent_length(r, base) for r in pair.active_profile_radii[0])
    length = pair.working_centre_distance * math.sin(pair.working_pressure_angle)
    pole = base * math.tan(pair.working_pressure_angle)
    return ActiveLine(length, low, high, pole, pair.gear_ratio, pair.sign)


def specific_sliding(position: float, line_length: float, gear_ratio: float, sign: int = 1) -> tuple[float, float]:
    """zeta_1 = 1 - (L - g) / (u g), zeta_2 = 1 - u g / (L - g); -inf where a flank is touched on its base circle.

    ``sign`` -1: of a pinion (1) in a ring (2), with g + L for L - g.
    """
    other, least = line_length - sign * position, _ON_THE_BASE_CIRCLE * line_length
    first = 1 - other / (gear_ratio * position) if position > least else -math.inf
    second = 1 - gear_ratio * position / other if other > least else -math.inf
    return first, second
