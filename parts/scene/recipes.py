"""Tables ``[[assemblies]]``: told out into parts, instances, mates and drives before a scene is read."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from geometry.base.errors import Nearest, ParameterError
from geometry.base.nearest import kept, nearest
from geometry.base.record import Draft, field
from parts.base.refusal import SceneError, placed
from parts.base.schema import converted, tried, unit_of
from parts.base.texts import ENGLISH, Words, languages, words
from parts.recipes.recipe import Expansion, Recipe, RecipeKeys, Table
from parts.scene.defaults import INSTEAD
from parts.scene.kinds import assembly_kind
from parts.scene.language import in_one

# keys of tables that hold the id of an instance or a part
_NAMING = ("part", "first", "second", "instance", "of", "to", "bring")
# shares of a limit that are tried where the limit itself is refused for another reason
_SMALLER = (0.9, 0.75, 0.5, 0.25, 0.1)


def told_out(raw: dict[str, Any], source: str) -> tuple[dict[str, Any], dict[str, str]]:
    """The tables of a scene without assemblies, and for places in them the keys that they have come from.

    What the scene itself says of a part or an instance that a recipe makes changes the recipe's keys of it; its own
    mates and drives stand behind.

    Raises
    ------
    SceneError
        There is no such assembly; or two make a part of one id.
    """
    told = _ToldOut()
    asked = raw.get("scene", {}).get("language", ENGLISH)
    said, grow = words(asked if asked in languages() else ENGLISH), True
    for number, table in enumerate(raw["assemblies"], 1):
        place = f"assemblies[{number}]"
        recipe, prefix, made = _made(in_one(raw, table, source, place), source, place)
        grow &= recipe.grows
        if shared := told.shared(made, prefix):
            raise SceneError(source, f"{place}.name", table.get("name"), "assemblies_share", None, "", part=shared)
        # one assembly alone is called by no name
        beside = f" ({prefix[:-1]})" if prefix and len(raw["assemblies"]) > 1 else ""
        told.take(made, prefix, place, partial(_named, prefix=prefix, beside=beside, told=said))
    tables = {key: value for key, value in raw.items() if key != "assemblies"}
    added = any(key not in told.ids() for name in told.named for key in tables.get(name, {}))
    if grow and (added or "mates" in tables) and "steps" not in tables:
        told.listed["steps"].clear()
    return tables | told.with_own(tables), told.origins


class _ToldOut(Draft):
    """Tables that recipes have made, by id or in rows, and for places in them where they have come from."""

    named: dict[str, dict[str, Table]] = field(default_factory=lambda: {"parts": {}, "instances": {}})
    listed: dict[str, list[Table]] = field(default_factory=lambda: {"mates": [], "drives": [], "steps": []})
    origins: dict[str, str] = field(default_factory=dict)

    def ids(self) -> set[str]:
        """Of all parts and instances."""
        return {key for found in self.named.values() for key in found}

    def shared(self, made: Expansion, prefix: str) -> str | None:
        """The id of a part or an instance that another assembly has made already."""
        ids = ((name, prefix + key) for name in self.named for key in getattr(made, name))
        return next((key for name, key in ids if key in self.named[name]), None)

    def take(self, made: Expansion, prefix: str, place: str, renamed: Callable[[Table], Table]) -> None:
        """Those of one assembly more."""
        for name, found in self.named.items():
            for key, own in getattr(made, name).items():
                found[prefix + key] = renamed(own)
                self.origins[f"{name}.{prefix}{key}"] = f"{place}: {name}.{prefix}{key}"
        before = {name: len(rows) for name, rows in self.listed.items()}
        for name, rows in self.listed.items():
            for own in getattr(made, name):
                rows.append(renamed(own))
                self.origins[f"{name}[{len(rows)}]"] = f"{place}: {name}[{len(rows)}]"
        for there, origin in made.origins.items():
            head, _, rest = there.partition(".")
            name, _, which = head.partition("[")
            here = f"{name}[{before[name] + int(which[:-1])}].{rest}" if which else f"{head}.{prefix}{rest}"
            self.origins[here] = f"{place}.{origin}"

    def with_own(self, tables: Mapping[str, Any]) -> dict[str, Any]:
        """With what the scene says itself: its rows behind, its keys over those of the same id."""
        told: dict[str, Any] = {}
        for name, rows in self.listed.items():
            own_rows = tables.get(name, [])
            self.origins |= {f"{name}[{len(rows) + k}]": f"{name}[{k}]" for k, _ in enumerate(own_rows, 1)}
            told[name] = [*rows, *own_rows]
        for name, found in self.named.items():
            for key, own in tables.get(name, {}).items():
                if key in found and isinstance(own, dict):
                    self.origins |= {f"{name}.{key}.{changed}": f"{name}.{key}.{changed}" for changed in own}
                    # nor does what the recipe made hold a key in another form, as a bore is round or of a shape
                    kept_keys = {k: v for k, v in found[key].items() if not any(o in own for o in INSTEAD.get(k, ()))}
                    own = {**kept_keys, **own}
                found[key] = own
            told[name] = found
        return told


def _made(table: dict[str, Any], source: str, place: str) -> tuple[Recipe[Any], str, Expansion]:
    """The recipe of one assembly, what begins its ids, and its tables."""
    from parts.recipes.registry import RECIPES

    recipe = RECIPES[assembly_kind(table, source, place)]
    keys = converted(table, recipe.keys, source, place)
    try:
        made = recipe.expanded(keys)
    except ParameterError as refusal:
        raise placed(source, place, _made_good(recipe, keys, refusal), unit_of(recipe.keys, refusal.name)) from refusal
    made.origins = _handed_on(keys, made) | made.origins
    return recipe, "" if keys.name is None else f"{keys.name}_", made


def _handed_on(keys: RecipeKeys, made: Expansion) -> dict[str, str]:
    """The places in an assembly's tables that hold a key of its own as it was given, under its own name."""
    rows = [(f"{name}.{key}", row) for name in ("parts", "instances") for key, row in getattr(made, name).items()]
    rows += [(f"{name}[{k}]", row) for name in ("mates", "drives") for k, row in enumerate(getattr(made, name), 1)]
    own = {key: getattr(keys, key) for key in keys.__struct_fields__}
    return {f"{at}.{key}": key for at, row in rows for key, value in row.items() if key in own and own[key] == value}


def _made_good(recipe: Recipe[Any], keys: RecipeKeys, refusal: ParameterError) -> ParameterError:
    """The refusal with a value of which the assembly is made, from its own limit on; none where there is none."""

    def works(value: object) -> bool:
        recipe.expanded(tried(keys, refusal.name, value))
        return True

    def cure() -> Nearest | None:
        own = refusal.nearest
        if own is None or kept(works, own.value):
            return own
        if own.side != "at_most" or not isinstance(own.value, float):
            return None
        return nearest(works, float(str(refusal.value)), [own.value * share for share in _SMALLER])

    return refusal.told_of(refusal.name, refusal.value, cure)


def _named(table: Table, prefix: str, beside: str, told: Words) -> Table:
    """A table with the assembly's name before every id in it, its title in the scene's language, the name beside it."""
    found = dict(table)
    if "title" in found:
        title = told.say(found["title"])
        stem, _, number = title.rpartition(" ")
        # the number of a row of instances stands last
        found["title"] = f"{stem}{beside} {number}" if number.isdigit() else title + beside
    for key in [key for key in _NAMING if table.get(key) is not None]:
        found[key] = [prefix + one for one in table[key]] if isinstance(table[key], list) else prefix + table[key]
    if isinstance(holes := table.get("holes"), list):
        # those of a flat part may stand on the axis of an instance
        found["holes"] = [hole | {"axis_of": prefix + hole["axis_of"]} if "axis_of" in hole else hole for hole in holes]
    return found
