"""Factors of ISO 6336, parts 1 to 3, method B where nothing else is said; stresses in MPa, lengths in mm, angles rad.

``newest`` is the edition of 2019; without it that of 2006 with its corrigenda.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from geometry.gears.strength.materials import Group

# K_1 and K_2 of method C by the accuracy grade of ISO 1328, straight teeth and helical ones; ISO 6336-1, table 8
GRADES = range(3, 13)
_K_1 = (
    (2.1, 3.9, 7.5, 14.9, 26.8, 39.1, 52.8, 76.6, 102.6, 146.3),
    (1.9, 3.5, 6.7, 13.3, 23.9, 34.8, 47.0, 68.2, 91.4, 130.3),
)
_K_2 = (0.0193, 0.0087)
# line load below which method C holds as at it, N/mm
LEAST_LINE_LOAD = 100.0
# the speed parameter up to which it holds, m/s
MOST_SPEED = 3.0
# within which the form factor and the stress correction hold
NOTCHES, CONTACT_RATIOS, MOST_HELIX = (1.0, 8.0), (1.0, 2.5), math.radians(30)


def dynamic_coefficients(grade: int, *, helical: bool) -> tuple[float, float]:
    """K_1 and K_2 of the dynamic factor by method C."""
    return _K_1[helical][grade - GRADES.start], _K_2[helical]


def speed_parameter(speed: float, teeth: int, ratio: float) -> float:
    """(v z_1 / 100) sqrt(u^2 / (1 + u^2)), v in m/s; ISO 6336-1, 6."""
    return speed * teeth / 100 * ratio / math.hypot(1.0, ratio)


def dynamic_parts(grade: int, parameter: float, overlap_ratio: float, *, helical: bool) -> tuple[float, float]:
    """K_v0 and w_0, N/mm, of K_v = K_v0 + w_0 / w by method C of ISO 6336-1, 6. Below eps_beta = 1 between both kinds.

    Beyond ``MOST_SPEED`` the method holds no more: as there.
    """
    parameter = min(parameter, MOST_SPEED)
    speed = parameter * (2.0 if parameter <= 0.2 else 2.071 - 0.357 * parameter)
    share = min(overlap_ratio, 1.0) if helical else 0.0
    ends = (dynamic_coefficients(grade, helical=kind) for kind in (False, True))
    falling, bare = (one + share * (two - one) if share else one for one, two in zip(*ends, strict=True))
    return 1 + bare * speed, falling * speed


def dynamic_factor(parts: tuple[float, float], line_load: float) -> float:
    """K_v of its parts; ``line_load``: w = K_A F_t / b, N/mm, taken as ``LEAST_LINE_LOAD`` below it."""
    return parts[0] + parts[1] / max(line_load, LEAST_LINE_LOAD)


def load_borne(most: float, parts: tuple[float, float], line_load: float) -> float:
    """How many times a load of ``line_load`` may be carried where K_v times it may grow ``most`` times."""
    (bare, falling), product = parts, most * line_load * dynamic_factor(parts, line_load)
    if product > LEAST_LINE_LOAD * dynamic_factor(parts, LEAST_LINE_LOAD):
        return (product - falling) / bare / line_load
    return product / dynamic_factor(parts, 0.0) / line_load


def face_exponent(width: float, heights: Sequence[float]) -> float:
    """N_F of K_Fbeta = K_Hbeta^N_F, the smaller b / h of both gears, at least 3; ISO 6336-1, 7."""
    share = max(min(width / height for height in heights), 3.0)
    return share**2 / (1 + share + share**2)


def zone_factor(alpha: float, working: float, base_helix: float) -> float:
    """Z_H = sqrt(2 cos(beta_b) cos(alpha_wt) / (cos^2(alpha_t) sin(alpha_wt))); ISO 6336-2, 6; GOST 21354-87."""
    return math.sqrt(2 * math.cos(base_helix) * math.cos(working) / (math.cos(alpha) ** 2 * math.sin(working)))


def elasticity_factor(moduli: Sequence[float], ratios: Sequence[float]) -> float:
    """Z_E = sqrt(1 / (pi sum((1 - nu^2) / E))), sqrt(MPa); ISO 6336-2, 7."""
    return math.sqrt(1 / (math.pi * sum((1 - n**2) / e for e, n in zip(moduli, ratios, strict=True))))


def contact_ratio_factor(contact_ratio: float, overlap_ratio: float) -> float:
    """Z_eps; ISO 6336-2, 8; GOST 21354-87."""
    beta = min(overlap_ratio, 1.0)
    return math.sqrt((4 - contact_ratio) / 3 * (1 - beta) + beta / contact_ratio)


def helix_factor_contact(helix: float) -> float:
    """Z_beta = 1 / sqrt(cos(beta)); ISO 6336-2:2019, 9, and the corrigendum of 2008."""
    return 1 / math.sqrt(math.cos(helix))


def single_contact_factor(bare: float, overlap_ratio: float, profile: float) -> float:
    """Z_B or Z_D of M_1 or M_2; ``profile``: f_ZCa of the edition of 2019, 1 in that of 2006; ISO 6336-2, 6."""
    spur = max(bare, 1.0)
    share, helical = min(overlap_ratio, 1.0), math.sqrt(profile)
    return max(spur - share * (spur - helical), 1.0)


def root_helix_factor(helix: float, overlap_ratio: float, *, newest: bool) -> float:
    """Y_beta = 1 - eps_beta beta / 120, in the edition of 2019 divided by cos^3(beta); ISO 6336-3, 8."""
    least = 1 - min(overlap_ratio, 1.0) * math.degrees(min(helix, MOST_HELIX)) / 120
    return least / math.cos(min(helix, MOST_HELIX)) ** 3 if newest else least


def root_load_share(contact_ratio: float, overlap_ratio: float) -> float:
    """f_eps of the edition of 2019, by which Y_F falls where several teeth bear; ISO 6336-3, 6."""
    beta = min(overlap_ratio, 1.0)
    if beta == 0:
        return 1.0 if contact_ratio < 2 else 0.7
    alone = 1 - beta if contact_ratio < 2 else (1 - beta) / 2
    return math.sqrt(alone + beta / contact_ratio)


def rim_factor(rim: float | None, height: float, module: float, *, ring: bool) -> float:
    """Y_B of a rim s_R thick: external teeth by their height, rings by the module; ISO 6336-3, 9."""
    if rim is None:
        return 1.0
    if ring:
        return 1.0 if rim >= 3.5 * module else 1.15 * math.log(8.324 * module / rim)
    return 1.0 if rim >= 1.2 * height else 1.6 * math.log(2.242 * height / rim)


def deep_tooth_factor(contact_ratio: float, grade: int | None) -> float:
    """Y_DT of the virtual contact ratio, of gears of grade 4 or better; ISO 6336-3, 10."""
    if grade is None or grade > 4 or contact_ratio <= 2.05:
        return 1.0
    return 0.7 if contact_ratio > 2.5 else 2.366 - 0.666 * contact_ratio


def lubricant_coefficient(limit: float) -> float:
    """C_ZL by sigma_Hlim of the softer gear; ISO 6336-2, 12."""
    return 0.83 if limit < 850 else 0.91 if limit > 1200 else limit / 4375 + 0.6357


def lubricant_factor(limit: float, viscosity: float) -> float:
    """Z_L of the viscosity at 40 degrees, mm^2/s; ISO 6336-2, 12."""
    basic = lubricant_coefficient(limit)
    return basic + 4 * (1 - basic) / (1.2 + 134 / viscosity) ** 2


def velocity_factor(limit: float, speed: float) -> float:
    """Z_v of the circumferential speed, m/s; ISO 6336-2, 12."""
    basic = lubricant_coefficient(limit) + 0.02
    return basic + 2 * (1 - basic) / math.sqrt(0.8 + 32 / speed)


def roughness_exponent(limit: float) -> float:
    """C_ZR by sigma_Hlim of the softer gear; ISO 6336-2, 12."""
    return 0.15 if limit < 850 else 0.08 if limit > 1200 else 0.32 - 0.0002 * limit


def hardening_roughness(hard: float, soft: float, curvature: float, oil: float) -> float:
    """R_zH of both flanks' R_z, um, of rho_red, mm, and nu_40 v, mm^2/s m/s; ISO 6336-2, 13."""
    return hard * (10 / curvature) ** 0.33 * (hard / soft) ** 0.66 / (oil / 1500) ** 0.33


def hardening_factor(hardness: float, roughness: float = 3.0) -> float:
    """Z_W of a through hardened gear, HB, on a hard pinion, smooth up to R_zH = 3 um; ISO 6336-2, 13."""
    return (1.2 - (min(max(hardness, 130.0), 470.0) - 130) / 1700) * (3 / min(max(roughness, 3.0), 16.0)) ** 0.15


def notch_sensitivity(notch: float, slip: float) -> float:
    """Y_delta_relT by the slip layer rho', mm, and q_s against 2.5 of the test gear; ISO 6336-3, 13."""
    own, test = (math.sqrt(slip * (1 + 2 * q) / 5) for q in (notch, 2.5))
    return (1 + own) / (1 + test)


def surface_factor(group: Group, roughness: float) -> float:
    """Y_R_relT of the fillet's R_z, um, held within 1 and 40; ISO 6336-3, 14."""
    high, fall, power, smooth = _SURFACES[group.surface]
    return smooth if roughness < 1 else high - fall * (min(roughness, 40.0) + 1) ** power


_SURFACES = {
    "hard": (1.674, 0.529, 0.1, 1.12),
    "soft": (5.306, 4.203, 0.01, 1.07),
    "brittle": (4.299, 3.259, 0.0058, 1.025),
}


def size_factor(group: Group, module: float) -> float:
    """Y_X of the normal module; ISO 6336-3, 15."""
    start, fall, most = _SIZES[group.size]
    return 1.0 if module <= 5 else start - fall * min(module, most)


_SIZES = {"tough": (1.03, 0.006, 30.0), "hard": (1.05, 0.01, 25.0), "iron": (1.075, 0.015, 25.0)}


def life_factor(knots: Sequence[tuple[float, float]], cycles: float, last: float) -> float:
    """Z_NT or Y_NT: straight lines in logarithms between (cycles, factor), to ``last`` at 10^10; ISO 6336-2, 11."""
    line = [*knots, (1e10, last)]
    if cycles <= line[0][0]:
        return line[0][1]
    if cycles >= line[-1][0]:
        return line[-1][1]
    (n, y), (far, least) = next(p for p in pairwise(line) if p[0][0] <= cycles <= p[1][0])
    return float(y * (least / y) ** (math.log(cycles / n) / math.log(far / n)))
