"""Checks of a scene: pairs on exact curves through one whole pitch, and what instances placed by hand must satisfy."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from exporters.words import finding_text, words
from geometry.gears.pair_contact import pair_contact
from geometry.tolerance import PLACED_MM
from parts.instances import DriveSpec
from parts.mates import Mating
from parts.placing import Closeness, Condition, PlacedMate, Placing


def scene_checks(placing: Placing, drives: Sequence[DriveSpec], language: str, *, contact: bool) -> dict[str, Any]:
    """All that is known of how a scene's instances stand to each other; ``contact``: interference of the pairs too."""
    checks: dict[str, Any] = {}
    if placing.mates:
        checks["mates"] = [_mate(m, language, contact=contact) for m in placing.mates]
        for found, mate in zip(checks["mates"], placing.mates, strict=True):
            turns = [abs(train[mate.first.id]) for train in placing.turns if mate.first.id in train]
            if turns:
                # contact is held against a whole pitch, whatever part of it the drive runs through
                found["driven_pitches"] = turns[0] * mate.mating.pair.first.number_of_teeth
    if placing.close:
        checks["neighbours"] = [_neighbours(c, language, judged=contact) for c in placing.close]
    if placing.turns:
        checks["drives"] = [
            {"instance": d.instance, "turns": d.turns, "train": train}
            for d, train in zip(drives, placing.turns, strict=True)
        ]
    return checks


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
    }


def check_pair(
    mating: Mating,
    language: str,
    *,
    second_turn: float = 0.0,
    centre_shift: float = 0.0,
    tolerance: float | None = None,
) -> dict[str, Any]:
    """The quantities of a pair and its verdict: least gap, where, at which drive angle.

    ``second_turn`` (rad) and ``centre_shift`` (mm): how far the pair stands off the exact one; ``tolerance`` in mm.
    """
    found = pair_contact(mating.pair, second_turn=second_turn, centre_shift=centre_shift, tolerance=tolerance)
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


def _mate(mate: PlacedMate, language: str, *, contact: bool) -> dict[str, Any]:
    """A mate as its instances stand; contact is sought where its conditions hold."""
    contact = contact and all(c.met for c in mate.conditions)
    if not contact:
        found = pair_quantities(mate.mating)
    elif mate.only_checks:
        allowed = max(PLACED_MM, 1e-8 * mate.mating.pair.module)
        found = check_pair(
            mate.mating, language, second_turn=mate.second_turn, centre_shift=mate.centre_shift, tolerance=allowed
        )
    else:
        found = check_pair(mate.mating, language)
    found["direction_deg"] = math.degrees(mate.direction)
    found["second_rotation_deg"] = math.degrees(mate.second.rotation)
    if mate.only_checks:
        found["conditions"] = [_condition(c, mate, language) for c in mate.conditions]
    return found


def _condition(condition: Condition, mate: PlacedMate, language: str) -> dict[str, Any]:
    numbers = {"value": condition.value, "required": condition.required, "tolerance": condition.tolerance}
    text = words(language, condition.code).format(first=mate.first.id, second=mate.second.id, **numbers)
    return {"code": condition.code, "met": condition.met, **numbers, "text": text}


def _neighbours(close: Closeness, language: str, *, judged: bool) -> dict[str, Any]:
    code = "neighbours_collide" if close.overlap else "neighbours_close"
    found: dict[str, Any] = {
        "first": close.first,
        "second": close.second,
        "distance": close.distance,
        "sum_of_tip_radii": close.tip_sum,
        "text": words(language, code).format(
            first=close.first, second=close.second, value=close.distance, limit=close.tip_sum
        ),
    }
    if close.overlap and judged:
        found["verdict"] = "overlap"
    return found
