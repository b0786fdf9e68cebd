"""The keys of an assembly of which a place follows in what its recipe makes, where nobody has typed that place."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Any

import msgspec

from geometry.base.errors import ParameterError
from parts.base.fields import fields_of
from parts.base.refusal import Rulers, SceneError
from parts.base.schema import converted, looked_up, steps_of, tried
from parts.recipes.recipe import Expansion, RecipeKeys
from parts.recipes.registry import RECIPES
from parts.scene.language import in_one

# by how much a key is moved to see what follows it
_MOVED = 1.01


def rulers(key: str, place: str, tables: dict[str, Any], source: str) -> Rulers | None:
    """What to change where a place is refused that a recipe has made; None where the file has the place itself.

    ``key``: the place in what is made; ``place``: what the file has for it; ``tables``: those that were typed.
    """
    if (at := re.match(r"(assemblies\[(\d+)\]): ", place)) is None:
        return None
    table = tables["assemblies"][int(at[2]) - 1]
    recipe = RECIPES[table["kind"]]
    keys: RecipeKeys = converted(in_one(tables, table, source, at[1]), recipe.keys, source, at[1])
    steps = list(map(str, steps_of(key.replace(f"parts.{keys.name}_", "parts.", 1))))
    made = msgspec.structs.asdict(recipe.expanded(keys))
    own, others = dict[str, None](), dict[str, None]()
    for name, path, value in _numbers(keys):
        then = next(_moved(recipe.expanded, keys, path, value), made)
        for found, there in ((own, steps), (others, steps[:2])):
            if looked_up(then, there) != looked_up(made, there):
                found[name] = None
    return Rulers(list(own), [name for name in others if name not in own])


def _moved(expanded: Callable[[Any], Expansion], keys: RecipeKeys, path: str, value: float) -> Iterator[dict[str, Any]]:
    """What a recipe makes with one of its numbers moved a little, up and down, where it may be."""
    for moved in (value + 1, value - 1) if isinstance(value, int) else (value * _MOVED or 1.0, value / _MOVED):
        with suppress(ParameterError, SceneError):
            yield msgspec.structs.asdict(expanded(tried(keys, path, moved)))


def _numbers(keys: RecipeKeys) -> Iterator[tuple[str, str, float]]:
    """The keys that hold numbers, where each of these stands, and the numbers."""
    for field in fields_of(type(keys)):
        name, held = field.encode_name, getattr(keys, field.name)
        several = isinstance(held, list | tuple)
        for k, value in enumerate(held if several else [held], 1):
            if isinstance(value, int | float) and not isinstance(value, bool):
                yield name, f"{name}[{k}]" if several else name, value
