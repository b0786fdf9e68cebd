"""Metric threads: the profile of ISO 68-1 (GOST 9150), limits of external ones by ISO 965-1 (GOST 16093)."""

from __future__ import annotations

import math
from itertools import pairwise

from geometry.base.record import Record

# the series R 40 of ISO 3, to which tolerances are rounded
_R40 = (100, 106, 112, 118, 125, 132, 140, 150, 160, 170, 180, 190, 200, 212, 224, 236, 250, 265, 280, 300, 315, 335,
        355, 375, 400, 425, 450, 475, 500, 530, 560, 600, 630, 670, 710, 750, 800, 850, 900, 950, 1000)  # fmt: skip
# mm: ends of the steps of diameters within which a tolerance of the pitch diameter is one
_STEPS = (0.99, 1.4, 2.8, 5.6, 11.2, 22.4, 45.0, 90.0, 180.0, 355.0)
# um: what the tables have otherwise than their formulas rounded, by the pitch; of d2 also by the end of the step
_DEVIATIONS = {0.75: 22.0}
_MAJOR_TOLERANCES = {4.0: 475.0}
_PITCH_TOLERANCES = {(5.6, 0.5): 75.0, (90.0, 5.0): 250.0}
# a step and a pitch for which no second source of the tables is known
_UNHELD = (355.0, 3.0)


class ThreadLimits(Record):
    """Fundamental deviation es and tolerances T_d and T_d2, um; the least and the greatest d and d2, mm."""

    deviation: float
    tolerances: tuple[float, float]
    major: tuple[float, float]
    pitch: tuple[float, float]


class MetricThread(Record):
    """An external thread; ``tolerance``: its class. Diameters and pitch, mm."""

    diameter: float
    pitch: float
    coarse: bool
    tolerance: str
    left: bool = False

    @property
    def height(self) -> float:
        """H, of the basic triangle."""
        return math.sqrt(3) / 2 * self.pitch

    @property
    def pitch_diameter(self) -> float:
        """d2 (ISO 724)."""
        return self.diameter - 3 / 4 * self.height

    @property
    def minor_diameter(self) -> float:
        """d1 of the basic profile (ISO 724)."""
        return self.diameter - 5 / 4 * self.height

    @property
    def root_diameter(self) -> float:
        """d3: the root is rounded H / 6 from the corner of the triangle (ISO 68-1)."""
        return self.diameter - 17 / 12 * self.height

    @property
    def stress_area(self) -> float:
        """A_s, mm^2: of a rod as strong, on the mean of pitch and root diameter (ISO 898-1)."""
        return math.pi / 16 * (self.pitch_diameter + self.root_diameter) ** 2

    @property
    def root_area(self) -> float:
        """A_3, mm^2, on the root diameter."""
        return math.pi / 4 * self.root_diameter**2

    @property
    def lead_angle(self) -> float:
        """On the pitch cylinder, rad."""
        return math.atan(self.pitch / (math.pi * self.pitch_diameter))

    def limits(self) -> ThreadLimits | None:
        """Those of the classes 6g and 6h by the formulas of ISO 965-1; None of another class."""
        low, high = next((a, b) for a, b in pairwise(_STEPS) if a < self.diameter <= b)
        if self.tolerance not in ("6g", "6h") or (high, self.pitch) == _UNHELD:
            return None
        p, mean = self.pitch, math.sqrt(low * high)
        deviation = -(_DEVIATIONS.get(p) or _rounded(15 + 11 * p)) if self.tolerance == "6g" else 0.0
        major = _MAJOR_TOLERANCES.get(p) or _rounded(180 * p ** (2 / 3) - 3.15 / math.sqrt(p))
        pitch = _PITCH_TOLERANCES.get((high, p)) or _rounded(90 * p**0.4 * mean**0.1)
        spans = [((size + (deviation - width) / 1000), size + deviation / 1000)
                 for size, width in ((self.diameter, major), (self.pitch_diameter, pitch))]  # fmt: skip
        return ThreadLimits(deviation, (major, pitch), *spans)


def _rounded(value: float) -> float:
    """The number of the series nearest to one, in whole um."""
    decade = 10.0 ** (math.floor(math.log10(value)) - 2)
    return float(round(min(_R40, key=lambda number: abs(number - value / decade)) * decade))
