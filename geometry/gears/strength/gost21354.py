"""Factors of GOST 21354-87 where they are others than those of ISO 6336; stresses in MPa, lengths in mm."""

from __future__ import annotations

import math

# of steel on steel, sqrt(MPa)
ELASTICITY_FACTOR = 190.0
# cycles to the limit in bending, and the most in contact
BENDING_CYCLES, MOST_CONTACT_CYCLES = 4e6, 120e6


def contact_stress(z_factors: float, force: float, width: float, diameter: float, ratio: float, sign: int) -> float:
    """sigma_H = Z sqrt(F_t / (b d_1) (u +- 1) / u), force with its factors of load; GOST 21354-87, ISO 6336-2."""
    return z_factors * math.sqrt(force / (width * diameter) * (ratio + sign) / ratio)


def form_factor(virtual_teeth: float, shift: float) -> float:
    """Y_FS = 3.47 + 13.2 / z_v - 29.7 x / z_v + 0.092 x^2, of external teeth."""
    return 3.47 + (13.2 - 29.7 * shift) / virtual_teeth + 0.092 * shift**2


def helix_factor(helix: float, overlap_ratio: float) -> float:
    """Y_beta = 1 - eps_beta beta / 120, not below 0.7; helix in rad."""
    return max(1 - overlap_ratio * math.degrees(helix) / 120, 0.7)


def contact_ratio_factor(contact_ratio: float, overlap_ratio: float, helix: float) -> float:
    """Y_eps: 1 of straight teeth, 0.2 + 0.8 / eps_alpha below eps_beta = 1, 1 / eps_alpha beyond."""
    if helix == 0:
        return 1.0
    return 0.2 + 0.8 / contact_ratio if overlap_ratio < 1 else 1 / contact_ratio


def contact_cycles(hardness: float) -> float:
    """N_Hlim = 30 HB^2.4, at most 120 millions."""
    return float(min(30 * hardness**2.4, MOST_CONTACT_CYCLES))


def contact_life(cycles: float, limit: float, *, hard: bool) -> float:
    """Z_N: by the power 1/6, at most 2.6 of soft flanks and 1.8 of hard ones, then by 1/20, at least 0.75."""
    if cycles <= limit:
        return float(min((limit / cycles) ** (1 / 6), 1.8 if hard else 2.6))
    return float(max((limit / cycles) ** (1 / 20), 0.75))


def bending_life(cycles: float, *, hard: bool) -> float:
    """Y_N = (4 10^6 / N)^(1/q_F): q_F 9 and at most 2.5 of hard teeth, 6 and at most 4 of soft ones, at least 1."""
    power, most = (9, 2.5) if hard else (6, 4.0)
    return float(min(max((BENDING_CYCLES / cycles) ** (1 / power), 1.0), most))


def velocity_factor(speed: float, *, hard: bool) -> float:
    """Z_v of the speed, m/s: 0.85 v^0.1 of soft flanks, 0.925 v^0.05 of hard ones, 1 up to 5 m/s."""
    if speed <= 5:
        return 1.0
    return float(max(0.925 * speed**0.05 if hard else 0.85 * speed**0.1, 1.0))


def contact_size_factor(diameter: float) -> float:
    """Z_X = sqrt(1.07 - 10^-4 d), 1 up to 700 mm."""
    return math.sqrt(1.07 - 1e-4 * diameter) if diameter > 700 else 1.0


def bending_size_factor(diameter: float) -> float:
    """Y_X = 1.05 - 0.000125 d, 1 up to 400 mm."""
    return min(1.05 - 0.000125 * diameter, 1.0)


def gradient_factor(module: float) -> float:
    """Y_delta = 1.082 - 0.172 lg(m)."""
    return 1.082 - 0.172 * math.log10(module)


def contact_limit(hardness: float) -> float:
    """sigma_Hlimb = 2 H_HB + 70 of steel that is normalized or quenched and tempered."""
    return 2 * hardness + 70


def bending_limit(hardness: float) -> float:
    """sigma_Flimb = 1.75 H_HB of the same."""
    return 1.75 * hardness
