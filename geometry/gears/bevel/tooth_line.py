"""Tooth lines of the crown gear: straight, skew, or the arc of a face mill; on each sphere they turn its section."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.record import Record
from geometry.curves.curve import Real


class ToothLine(Record):
    """An arc of ``cutter_radius`` mm (infinite: a straight line) in the crown gear's pitch plane, told off its radii.

    ``spiral_angle``, rad, is that at ``mean_distance`` mm from the apex (ISO 23509: beta_m, r_c0, R_m).
    """

    mean_distance: float
    spiral_angle: float
    cutter_radius: float

    def _sine(self, distance: ArrayLike) -> Real:
        at, mean = np.asarray(distance, dtype=float), self.mean_distance
        curved = (at**2 - mean**2) / self.cutter_radius
        # beyond 1 the arc has turned back before it gets there
        return np.clip((2 * mean * math.sin(self.spiral_angle) + curved) / (2 * at), -1.0, 1.0)

    def spiral(self, distance: ArrayLike) -> Real:
        """beta, rad, at distances from the apex, mm."""
        return np.asarray(np.arcsin(self._sine(distance)))

    def turn(self, distance: ArrayLike) -> Real:
        """By which the crown gear is turned there against ``mean_distance``, rad: tan beta / R summed up.

        The cutter's axis is seen from the apex under atan2(cos beta, R / r_c0 - sin beta) to the radius
        (DERIVATIONS.md, section 20).
        """
        at, sine = np.asarray(distance, dtype=float), self._sine(distance)
        mean, radius = self.mean_distance, self.cutter_radius
        start = np.arctan2(np.cos(self.spiral_angle), mean / radius - np.sin(self.spiral_angle))
        return np.asarray(start - np.arctan2(np.sqrt(1 - sine**2), at / radius - sine))
