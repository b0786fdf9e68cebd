"""Which wish of a pair is to blame where its gears cannot exist: the one without which they can, with the nearest."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import msgspec
from msgspec import Struct

from geometry.base.errors import GeometryError
from geometry.base.nearest import nearest
from parts.base.refusal import REMOVED, SceneError, explained
from parts.base.schema import unit_of
from parts.pages.inputs import PLACE

# keys of a pair that its gears follow, in the order in which they are let go
WISHES = ("working_centre_distance", "normal_backlash", "circumferential_backlash", "side_clearance_class")


def wish_refused(topic: str, keys: Struct, told: SceneError, made: Callable[[Any], Any]) -> SceneError:
    """The refusal of a pair told as that of the wish that asks too much, with the nearest that works.

    ``made`` gives the calculated pair of changed keys, or refuses them. A refusal that names a wish and what works
    already, or that no single wish causes, stays as it is; what does not work with the other keys is not offered.
    """

    def works(name: str, value: object) -> bool:
        changed = msgspec.structs.replace(keys, **{name: value})
        return not (isinstance(value, float) and value < 0) and _attempt(made, changed) is not None

    for name in WISHES:
        asked = getattr(keys, name, None)
        if asked is None:
            continue
        pair = _attempt(made, msgspec.structs.replace(keys, **{name: None}))
        if pair is None:
            continue
        key, code, numbers = f"{topic}.{name}", told.code, dict(told.numbers)
        if told.key == key and told.nearest is not None and works(name, told.nearest.value):
            return told
        if told.key != key:
            why = explained(SceneError(PLACE, key, asked, code, None, "", **numbers))
            code, numbers = "wish_not_met", {"place": told.key.removeprefix(f"{topic}."), "why": why}
        if isinstance(asked, str):
            return SceneError(PLACE, key, asked, code, REMOVED, "", **numbers)
        usual = float(getattr(pair, name))
        # without the wish the pair works, if no other value is found
        found = nearest(partial(works, name), float(asked), usual) or REMOVED
        return SceneError(PLACE, key, asked, code, found, unit_of(type(keys), name), **numbers)
    name = told.key.removeprefix(f"{topic}.")
    if name in WISHES and told.nearest is not None and not works(name, told.nearest.value):
        told.offer(None)
    return told


def _attempt(made: Callable[[Any], Any], keys: Struct) -> Any:
    try:
        return made(keys)
    except (GeometryError, SceneError):
        return None
