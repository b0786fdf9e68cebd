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


_MODULE_OF_PITCH: tuple[str, Rule] = ("module", lambda it, keys: it / math.pi)
_MODULE_OF_INCHES: tuple[str, Rule] = ("module", lambda it, keys: INCH / it)
_HALF_FOLLOWER: tuple[str, Rule] = ("follower_radius", lambda it, keys: it / 2)
_WHOLE_ROLLER: tuple[str, Rule] = ("roller_diameter", lambda it, keys: it * 2)
_BORE: tuple[str, Rule] = ("bore_diameter", lambda it, keys: it * 2)
_PITCH_CIRCLE: list[tuple[str, Rule]] = [
    ("module", _of_diameter), ("diameter_quotient", lambda it, keys: it / keys["module"]),
]  # fmt: skip
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
    "base_circle_diameter": [("base_circle_radius", lambda it, keys: it / 2)],
    "base_diameter": [("base_circle_radius", lambda it, keys: it / 2)],
    "roller_diameter": [_HALF_FOLLOWER],
    "follower_diameter": [_HALF_FOLLOWER, ("roller_diameter", lambda it, keys: it)],
    "roller_radius": [_WHOLE_ROLLER],
    "follower_radius": [_WHOLE_ROLLER],
    "bore_radius": [_BORE],
    "shaft_radius": [_BORE],
    "max_pressure_angle": [_TRANSMISSION],
    "max_pressure_angle_deg": [_TRANSMISSION],
    "pressure_angle": [_TRANSMISSION],
    "pressure_angle_deg": [_TRANSMISSION],
}


def counted_over(word: str, value: object, known: Collection[str], keys: Mapping[str, Any]) -> Nearest | None:
    """The key of ours, of those ``known`` and not given yet, with the value that says the same; None: there is none.

    ``keys``: all that stands beside the word, which is ``value``.
    """
    for ours, rule in RULES.get(word.strip().lower().replace(" ", "_").replace("-", "_"), []):
        if ours not in known or ours in keys or not isinstance(value, int | float) or isinstance(value, bool):
            continue
        try:
            counted = rule(value, keys)
        except (KeyError, TypeError, ZeroDivisionError, OverflowError):
            continue
        if math.isfinite(counted):
            return Nearest(f"{ours} = {counted!r}", "same")
    return None
