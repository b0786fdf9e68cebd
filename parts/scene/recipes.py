"""Tables ``[[assemblies]]``: told out into parts, instances, mates and drives before a scene is read."""

from __future__ import annotations

from typing import Any

from geometry.base.errors import ParameterError
from parts.base.refusal import SceneError, meant, placed
from parts.base.schema import converted, unit_of
from parts.recipes.recipe import Expansion, Table

# keys of tables that hold the id of an instance or a part
_NAMING = ("part", "first", "second", "instance", "of")


def told_out(raw: dict[str, Any], source: str) -> tuple[dict[str, Any], dict[str, str]]:
    """The tables of a scene without assemblies, and for places in them the keys that they have come from.

    What the scene itself says of a part or an instance that a recipe makes changes the recipe's keys of it; its own
    mates and drives stand behind.

    Raises
    ------
    SceneError
        There is no such assembly; or two make a part of one id.
    """
    tables: dict[str, Any] = {key: value for key, value in raw.items() if key != "assemblies"}
    origins: dict[str, str] = {}
    parts: dict[str, Table] = {}
    instances: dict[str, Table] = {}
    lists: dict[str, list[Table]] = {"mates": [], "drives": []}
    for number, table in enumerate(raw["assemblies"], 1):
        place = f"assemblies[{number}]"
        prefix, made = _made(table, source, place)
        for part, keys in made.parts.items():
            if prefix + part in parts:
                raise SceneError(
                    source, f"{place}.name", table.get("name"), "assemblies_share", None, part=prefix + part
                )
            parts[prefix + part] = keys
            origins[f"parts.{prefix}{part}"] = f"{place}: parts.{prefix}{part}"
        for key, own in made.instances.items():
            instances[prefix + key] = _named(own, prefix)
            origins[f"instances.{prefix}{key}"] = f"{place}: instances.{prefix}{key}"
        for told, origin in made.origins.items():
            head, _, rest = told.partition(".")
            origins[f"{head}.{prefix}{rest}"] = f"{place}.{origin}"
        for name, ours in lists.items():
            for own in getattr(made, name):
                ours.append(_named(own, prefix))
                origins[f"{name}[{len(ours)}]"] = f"{place}: {name}[{len(ours)}]"
    for name, ours in lists.items():
        for number, _ in enumerate(tables.get(name, []), 1):
            origins[f"{name}[{len(ours) + number}]"] = f"{name}[{number}]"
        tables[name] = [*ours, *tables.get(name, [])]
    for name, ours_by_id in (("parts", parts), ("instances", instances)):
        own_tables = tables.get(name, {})
        for key, own in own_tables.items():
            for changed in own if isinstance(own, dict) else ():
                origins[f"{name}.{key}.{changed}"] = f"{name}.{key}.{changed}"
        both = {key: {**table, **own_tables.get(key, {})} for key, table in ours_by_id.items()}
        tables[name] = both | {key: own for key, own in own_tables.items() if key not in both}
    return tables, origins


def _made(table: object, source: str, place: str) -> tuple[str, Expansion]:
    """What begins the ids of one assembly, and its tables."""
    from parts.recipes.registry import RECIPES

    if not isinstance(table, dict):
        raise SceneError(source, place, table, "not_a_list", None, key="assemblies")
    kind = table.get("kind")
    if not isinstance(kind, str) or kind not in RECIPES:
        code = "missing_kind" if kind is None else "unknown_kind"
        raise SceneError(source, f"{place}.kind", kind, code, meant(kind, RECIPES), known=list(RECIPES))
    recipe = RECIPES[kind]
    keys = converted(table, recipe.keys, source, place)
    try:
        made = recipe.expanded(keys)
    except ParameterError as refusal:
        raise placed(source, place, refusal, unit_of(recipe.keys, refusal.name)) from refusal
    return "" if keys.name is None else f"{keys.name}_", made


def _named(table: Table, prefix: str) -> Table:
    """A table with the assembly's name before every id in it."""
    return {key: prefix + value if key in _NAMING and value is not None else value for key, value in table.items()}
