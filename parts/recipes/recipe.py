"""What a kind of assembly has to say: its keys, and the plain tables of a scene that they become.

A recipe is a ``Recipe``, registered by one row of ``parts/recipes/kinds.psv``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Annotated, Any, Generic, TypeVar

from msgspec import Meta, Struct

from geometry.base.record import Draft, Record, field
from parts.base.part_keys import Density, Material
from parts.base.texts import Message
from parts.keys.base import IDENTIFIER
from parts.recipes.names import Named

Table = dict[str, Any]
# how far something is driven
Turns = Annotated[float, Meta(ge=-1000, le=1000, extra={"unit": "turns"})]

_NAME = Meta(pattern=IDENTIFIER, description="the ids of all its parts begin with it, as in a_sun", examples=["a"])


class RecipeKeys(Struct, forbid_unknown_fields=True, tag_field="kind", kw_only=True):
    """Keys of every assembly."""

    name: Annotated[str, _NAME] | None = None


class ModelKeys(RecipeKeys, kw_only=True):
    """Keys of one whose parts are all made of the same."""

    material: Material | None = None
    density: Density | None = None


class Expansion(Draft):
    """Tables as a scene file has them, but that titles are texts.

    ``origins``: for places in them (``parts.sun.module``), the recipe's key.
    """

    parts: dict[str, Table] = field(default_factory=dict)
    instances: dict[str, Table] = field(default_factory=dict)
    mates: list[Table] = field(default_factory=list)
    drives: list[Table] = field(default_factory=list)
    steps: list[Table] = field(default_factory=list)
    origins: dict[str, str] = field(default_factory=dict)

    def name_instances(self, names: Mapping[str, Named]) -> None:
        """Give instances their titles, by id, or by what it is without its number and is not their part's."""
        titles = {name: one.title for name, one in names.items() if one.title}
        for name, table in self.instances.items():
            stem, _, number = name.rpartition("_")
            if name in titles:
                table["title"] = titles[name]
            elif number.isdigit() and stem != table["part"] and stem in titles:
                table["title"] = Message("{title} {number}", {"title": Message(titles[stem]), "number": number})


K = TypeVar("K", bound=RecipeKeys)


class Recipe(Record, Generic[K]):
    """A kind of assembly: its keys (a msgspec struct, tagged with its name), and what makes plain tables of them.

    Ids in the tables are without the assembly's name. Where there is no such assembly, ``expanded`` raises a
    ParameterError that names the recipe's key. One that ``grows`` is a part of larger drives: where a scene adds to it
    and tells no steps, its own are left out.
    """

    keys: type[K]
    expanded: Callable[[K], Expansion]
    grows: bool = False
