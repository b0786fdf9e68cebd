"""Which wish of a pair is to blame where its gears cannot exist: the one without which they can, with the nearest."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import msgspec
from msgspec import Struct

from exporters.calculations.inputs import PLACE, refusal
from geometry.errors import GeometryError, ParameterError, at_least, at_most
from parts.schema import SceneError

# keys of a pair that its gears follow, in the order in which they are let go
WISHES = ("working_centre_distance", "normal_backlash", "circumferential_backlash", "side_clearance_class")
# halvings of the way from what works to what was asked for
_STEPS = 24


def wish_refused(
    topic: str, keys: Struct, error: ParameterError | SceneError, made: Callable[[Any], Any]
) -> SceneError:
    """The refusal of a pair told as that of the wish that asks too much, with the nearest that works.

    ``made`` gives the calculated pair of changed keys, or refuses them. A refusal that names a wish already, or that no
    single wish causes, stays as it is.
    """
    told = error if isinstance(error, SceneError) else refusal(topic, error)
    for name in WISHES:
        asked = getattr(keys, name, None)
        if asked is None:
            continue
        pair = _attempt(made, msgspec.structs.replace(keys, **{name: None}))
        if pair is None:
            continue
        key, why = f"{topic}.{name}", told.remedy.partition(";")[0]
        if told.key == key and "works" in told.remedy:
            return told
        reason = f"{told.key.removeprefix(topic + '.')}: {why}" if told.key != key else why
        if isinstance(asked, str):
            return SceneError(PLACE, key, asked, f"{reason}; without it the pair works")
        text = _nearest(keys, name, float(asked), float(getattr(pair, name)), made)
        return SceneError(PLACE, key, asked, f"{reason}; {text}")
    return told


def _nearest(keys: Struct, name: str, asked: float, usual: float, made: Callable[[Any], Any]) -> str:
    """The value between the usual one and the one asked for that is nearest to this, in words."""

    def works(value: float) -> bool:
        return value >= 0 and _attempt(made, msgspec.structs.replace(keys, **{name: value})) is not None

    good, bad = usual, asked
    for _ in range(_STEPS):
        middle = (good + bad) / 2
        good, bad = (middle, bad) if works(middle) else (good, middle)
    for digits in (4, 6, 9):
        text = at_most(good, digits) if good < asked else at_least(good, digits)
        if works(float(text)):
            return f"at {'most' if good < asked else 'least'} {text} mm works"
    return "without it the pair works"


def _attempt(made: Callable[[Any], Any], keys: Struct) -> Any:
    try:
        return made(keys)
    except (GeometryError, SceneError):
        return None
