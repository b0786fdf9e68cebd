"""Keys of other programs and books from whose number one of ours follows: inches, pitches, radii for diameters."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping
from typing import Any

from geometry.base.errors import Nearest
from geometry.gears.teeth.module_rows import INCH

Rule = Callable[[float, Mapping[str, Any]], float]


def _of_diameter(diameter: float, keys: Mapping[str, Any]) -> float:
    """The module, of a helical gear the normal one: m = d cos(beta) / z."""
    helix = math.radians(keys.get("helix_angle_deg", 0.0))
    return float(diameter * math.cos(helix) / keys["number_of_teeth"])


def _half(diameter: float, _keys: Mapping[str, Any]) -> float:
    return diameter / 2


def _twice(radius: float, _keys: Mapping[str, Any]) -> float:
    return radius * 2


_MODULE_OF_PITCH: tuple[str, Rule] = ("module", lambda it, keys: it / math.pi)
_MODULE_OF_INCHES: tuple[str, Rule] = ("module", lambda it, keys: INCH / it)
_PITCH_CIRCLE: list[tuple[str, Rule]] = [
    ("module", _of_diameter), ("diameter_quotient", lambda it, keys: it / keys["module"]),
]  # fmt: skip
# a cycloidal disc has one lobe less than pins stand about it
_LOBES: tuple[str, Rule] = ("number_of_lobes", lambda it, keys: it - 1)
_TRANSMISSION: tuple[str, Rule] = ("least_transmission_angle_deg", lambda it, keys: 90.0 - it)
# their word in small letters with "_" between words: ours, and how it follows from their number and the other keys
RULES: dict[str, list[tuple[str, Rule]]] = {
    "diametral_pitch": [_MODULE_OF_INCHES],
    "diam_pitch": [_MODULE_OF_INCHES],
    "dp": [_MODULE_OF_INCHES],
    "circular_pitch": [_MODULE_OF_PITCH],
    "circ_pitch": [_MODULE_OF_PITCH],
    "axial_pitch": [_MODULE_OF_PITCH],
    "tooth_spacing": [_MODULE_OF_PITCH],
    "pitch": [_MODULE_OF_PITCH],
    "pitch_diameter": _PITCH_CIRCLE,
    "reference_diameter": _PITCH_CIRCLE,
    "worm_diameter": _PITCH_CIRCLE[1:],
    "diameter": _PITCH_CIRCLE[1:],
    "base_diameter": [("base_circle_radius", _half)],
    "roller_diameter": [("follower_radius", _half)],
    "follower_diameter": [("roller_diameter", lambda it, keys: it)],
    "follower_radius": [("roller_diameter", _twice)],
    "shaft_radius": [("bore_diameter", _twice)],
    "outer_radius": [("tip_diameter", _twice)],
    "number_of_pins": [_LOBES],
    "pins": [_LOBES],
    "radius": [("pitch_circle_diameter", _twice)],
    "max_pressure_angle": [_TRANSMISSION],
    "max_pressure_angle_deg": [_TRANSMISSION],
    "pressure_angle": [_TRANSMISSION],
    "pressure_angle_deg": [_TRANSMISSION],
}


def counted_over(word: str, value: object, known: Collection[str], keys: Mapping[str, Any]) -> Nearest | None:
    """The key of ours, of those ``known`` and not given yet, with the value that says the same; None: there is none.

    ``keys``: all that stands beside the word, which is ``value``.
    """
    plain = word.strip().lower().replace(" ", "_").replace("-", "_")
    # a radius where we have the diameter, or the other way round
    halved = [(plain.replace("diameter", "radius"), _half)] if "diameter" in plain else []
    twice = [(plain.replace("radius", "diameter"), _twice)] if "radius" in plain else []
    for ours, rule in [*halved, *twice, *RULES.get(plain, [])]:
        if ours not in known or ours in keys or not isinstance(value, int | float) or isinstance(value, bool):
            continue
        try:
            counted = rule(value, keys)
        except (KeyError, TypeError, ZeroDivisionError, OverflowError):
            continue
        if math.isfinite(counted):
            return Nearest(f"{ours} = {counted!r}", "same")
    return None
