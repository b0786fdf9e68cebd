"""Interference and contact of the pairs of a scene, on exact curves, through one whole pitch."""

from __future__ import annotations

import math
from typing import Any

from exporters.words import finding_text
from geometry.gears.pair_contact import pair_contact
from parts.mates import Mating


def pair_quantities(mating: Mating) -> dict[str, Any]:
    """What the calculation of a pair says, lengths in mm (practicum, lesson 3)."""
    pair = mating.pair
    return {
        "kind": "external_gear_pair",
        "first": mating.first,
        "second": mating.second,
        "direction_deg": mating.direction_deg,
        "gear_ratio": pair.gear_ratio,
        "working_pressure_angle_deg": math.degrees(pair.working_pressure_angle),
        "working_centre_distance": pair.working_centre_distance,
        "tip_shortening_coefficient": pair.tip_shortening_coefficient,
        "contact_ratio": pair.contact_ratio,
        "normal_backlash": pair.normal_backlash,
        "second_rotation_deg": math.degrees(pair.second_rotation(0.0, math.radians(mating.direction_deg))),
    }


def check_pair(mating: Mating, language: str) -> dict[str, Any]:
    """The quantities of a pair and its verdict: least gap, where, at which drive angle."""
    found = pair_contact(mating.pair)
    worst = found.worst
    return {
        **pair_quantities(mating),
        "verdict": found.verdict.value,
        "tolerance": found.tolerance,
        "gap": worst.gap,
        "greatest_gap": found.greatest_gap,
        "drive_angle_deg": math.degrees(worst.drive_angle),
        "point": [worst.point.real, worst.point.imag],
        "labels": [label.value for label in worst.labels],
        "findings": [
            {"code": f.code, "value": f.value, "limit": f.limit, "text": finding_text(language, f)}
            for f in mating.pair.findings()
        ],
    }
