"""A worm and the wheel that it envelops, axes crossed at a right angle: dimensions by GOST 19650, exact sections.

Frame of the worm (``worm.py``); the wheel's axis is parallel to y through x = a. At a right angle every section of the
worm by a plane y = const is a rack that slides by the lead, so every such section of the wheel is an envelope in closed
form (Savvin: the common normal passes through the pitch point).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.record import Record
from geometry.base.roots import bracketed_root
from geometry.curves.curve import Complex, Real
from geometry.gears.worms.worm import Worm

# b_1 / m by GOST 19650: shift, then (number, share of z_1, share of z_2) for one or two starts and for more
_LENGTHS = (
    (-1.0, (10.5, 1.0, 0.0), (10.5, 1.0, 0.0)),
    (-0.5, (8.0, 0.0, 0.06), (9.5, 0.0, 0.09)),
    (0.0, (11.0, 0.0, 0.06), (12.5, 0.0, 0.09)),
    (0.5, (11.0, 0.0, 0.1), (12.5, 0.0, 0.1)),
    (1.0, (12.0, 0.0, 0.1), (13.0, 0.0, 0.1)),
)
# shifts of the table between which x lies are nearer than this; x by a centre distance is rounded
_APART = 0.5 - 1e-9


class WormDrive(Record):
    """A worm with its wheel; ``profile_shift_coefficient`` is the wheel's, in axial modules."""

    worm: Worm
    number_of_teeth: int
    profile_shift_coefficient: float = 0.0

    @property
    def ratio(self) -> float:
        """Turns of the worm for one of the wheel."""
        return self.number_of_teeth / self.worm.number_of_starts

    @property
    def reference_radius(self) -> float:
        """r_2, on which the wheel rolls, mm."""
        return self.worm.module * self.number_of_teeth / 2

    @property
    def centre_distance(self) -> float:
        """a_w = (z_2 + q + 2 x) m / 2, mm."""
        return self.reference_radius + self.worm.reference_radius + self.profile_shift_coefficient * self.worm.module

    @property
    def pitch_radius_of_worm(self) -> float:
        """r_w1 = (q + 2 x) m / 2, mm."""
        return self.worm.reference_radius + self.profile_shift_coefficient * self.worm.module

    @property
    def pitch_lead_angle(self) -> float:
        """gamma_w, rad."""
        return math.atan2(self.worm.parameter, self.pitch_radius_of_worm)

    @property
    def pitch_axial_pressure_angle(self) -> float:
        """alpha_xw of the flank at the pitch point, rad."""
        return self.worm.axial_pressure_angle_at(self.pitch_radius_of_worm)

    @property
    def pitch_normal_pressure_angle(self) -> float:
        """alpha_nw of the flank at the pitch point, in the normal of its helix, rad."""
        return math.atan(math.tan(self.pitch_axial_pressure_angle) * math.cos(self.pitch_lead_angle))

    @property
    def tip_radius(self) -> float:
        """r_a2 in the mid plane (the throat), mm."""
        worm = self.worm
        return self.reference_radius + (worm.addendum_coefficient + self.profile_shift_coefficient) * worm.module

    @property
    def root_radius(self) -> float:
        """r_f2 in the mid plane, mm."""
        worm = self.worm
        less = worm.addendum_coefficient + worm.tip_clearance_coefficient - self.profile_shift_coefficient
        return self.reference_radius - less * worm.module

    @property
    def most_outer_diameter(self) -> float:
        """d_ae2, the largest of the wheel by GOST 19650, mm."""
        return 2 * self.tip_radius + 6 * self.worm.module / (self.worm.number_of_starts + 2)

    @property
    def throat_radius(self) -> float:
        """Of the wheel's tip about the worm's axis, mm."""
        return self.centre_distance - self.tip_radius

    @property
    def default_outer_diameter(self) -> float:
        """d_ae2 where none is asked for, mm: GOST 19650's largest, within a throat round a third of the worm."""
        throated = max(2 * self.centre_distance - self.throat_radius, 2 * self.tip_radius)
        return min(self.most_outer_diameter, throated)

    @property
    def least_worm_length_terms(self) -> tuple[float, float, float]:
        """(c, k_1, k_2) of b_1 = (c + k_1 z_1 + k_2 z_2) m by GOST 19650: of the table's shifts about x, the longer."""
        column = 0 if self.worm.number_of_starts <= 2 else 1
        place = min(max(self.profile_shift_coefficient, -1.0), 1.0)
        return max((row[column] for shift, *row in _LENGTHS if abs(shift - place) < _APART), key=self._length)

    @property
    def least_worm_length(self) -> float:
        """b_1, mm."""
        return self._length(self.least_worm_length_terms)

    def _length(self, terms: tuple[float, float, float]) -> float:
        number, of_starts, of_teeth = terms
        return (number + of_starts * self.worm.number_of_starts + of_teeth * self.number_of_teeth) * self.worm.module

    @property
    def most_face_width(self) -> float:
        """b_2 by GOST 19650, mm: 0.75 d_a1 for up to three starts, 0.67 d_a1 for more."""
        return (0.75 if self.worm.number_of_starts <= 3 else 0.67) * 2 * self.worm.tip_radius

    def section(self, radius: ArrayLike, distance: float = 0.0, *, upper: bool = True) -> tuple[Complex, Real]:
        """The wheel's flank that the worm's upper (lower) flank cuts in the plane y = ``distance`` (mm).

        Points as complex numbers about the wheel's axis, where the worm's axis lies at -a and its z is the imaginary
        axis, for points of the worm at radii (mm); and how far the worm has then slid along its axis, mm.
        """
        worm, side = self.worm, 0 if upper else 1
        r = np.asarray(radius, float)
        z, slope = worm.axial(r, distance)[side], worm.section_slopes(r, distance)[side]
        x = np.sqrt((r - distance) * (r + distance))
        # the normal of the section passes through the pitch point
        slid = -z - (x - self.pitch_radius_of_worm) / slope
        # the worm's side of the wheel goes along with it
        turned = -slid / self.reference_radius
        return (x - self.centre_distance + 1j * (z + slid)) * np.exp(-1j * turned), slid

    def tip_radius_at(self, distance: float) -> float:
        """Radius of the throated wheel in the plane y = ``distance`` (mm), mm: infinite beside the throat."""
        if abs(distance) >= self.throat_radius:
            return math.inf
        return self.centre_distance - math.sqrt((self.throat_radius - distance) * (self.throat_radius + distance))

    def tip_contact(self, distance: float, *, upper: bool = True, outer_radius: float = math.inf) -> float | None:
        """Where along the worm (z, mm) a tip of the wheel in the plane y = ``distance`` (mm) touches it.

        None: no radius of the worm's flank cuts that tip.
        """
        worm, tip = self.worm, min(self.tip_radius_at(distance), outer_radius)

        def beyond(radius: float) -> float:
            return abs(complex(self.section(radius, distance, upper=upper)[0])) - tip

        # an involute thread is radial where it begins: its normal there meets the pitch line nowhere
        low, high = max(worm.form_radius, abs(distance)) * (1 + 1e-9), worm.tip_radius
        if low >= high or beyond(low) * beyond(high) > 0:
            return None
        radius = bracketed_root(beyond, low, high).value
        z = worm.axial(radius, distance)[0 if upper else 1]
        return float(z + self.section(radius, distance, upper=upper)[1])

    def worm_length_used(self, face_width: float, outer_radius: float = math.inf) -> float | None:
        """Twice the farthest place from the middle at which a wheel of ``face_width`` touches the worm, mm."""
        half, out = face_width / 2, self.centre_distance - outer_radius
        # where the throat ends in the outer cylinder
        end = math.sqrt(max((self.throat_radius - out) * (self.throat_radius + out), 0.0)) if out > 0 else half
        places = {0.0, half, -half, min(end, half), -min(end, half)}
        found = [self.tip_contact(y, upper=u, outer_radius=outer_radius) for y in places for u in (True, False)]
        return None if None in found else 2 * max(abs(z) for z in found if z is not None)
