"""Strength of a worm drive as the thesis on the power module computes it (section 2.2), and what follows from it.

Forces in N, lengths in mm, torques in N mm, stresses in MPa. Both formulas hold for a wheel of the full width
0.75 d_a1; a narrower rim b_2 carries its share b_2 / (0.75 d_a1): the module grows as its cube root falls, the contact
stress as 1 / sqrt of it.
"""

from __future__ import annotations

import math

from geometry.base.record import Record
from geometry.gears.worms.drive import WormDrive


class Load(Record):
    """What acts on the wheel: ``torque`` T_2, N mm; factors Y_F2 of form, K_beta of width, K_v of speed."""

    torque: float
    form_factor: float
    width_factor: float = 1.5
    speed_factor: float = 1.1

    @property
    def increased(self) -> float:
        """K_beta K_v T_2, N mm."""
        return self.width_factor * self.speed_factor * self.torque


def least_module(drive: WormDrive, load: Load, allowed: float, share: float) -> float:
    """m that the bending of the wheel's teeth asks for, mm; ``allowed`` sigma_FP2, MPa, ``share`` of the full width."""
    worm = drive.worm
    acting = 1.5 / share * load.form_factor * load.increased * math.cos(worm.lead_angle)
    return (acting / (worm.diameter_quotient * drive.number_of_teeth * allowed)) ** (1 / 3)


def contact_stress(drive: WormDrive, load: Load, share: float) -> float:
    """sigma_H on the wheel's flanks, MPa; ``share`` of the full width."""
    relation = drive.number_of_teeth / drive.worm.diameter_quotient
    full = 170 / relation * math.sqrt(((relation + 1) / drive.centre_distance) ** 3 * load.increased)
    return full / math.sqrt(share)


def efficiency(drive: WormDrive, friction: float, *, back: bool = False) -> float:
    """Share of the power that leaves the mesh, ``friction`` rho' in rad; 0 if the wheel drives ``back`` and cannot."""
    gamma = drive.pitch_lead_angle
    if back:
        return max(math.tan(gamma - friction) / math.tan(gamma), 0.0)
    return math.tan(gamma) / math.tan(gamma + friction)
