"""The JSON Schema of scenes: what an editor needs to complete keys and to mark wrong ones."""

from __future__ import annotations

import inspect
import json
from typing import Annotated, Any, Union

import msgspec
from msgspec import Meta

from parts.base.registry import KINDS
from parts.keys.boards import BedSpec, BoardSpec
from parts.mates.registry import MATES
from parts.recipes.registry import RECIPES
from parts.scene.defaults import default_names
from parts.scene.instances import DriveSpec, InstanceTable
from parts.scene.language import WORDS, WORDS_OF_PARTS
from parts.scene.scene_file import ChecksSpec, ExportSpec, SceneInfo
from parts.scene.steps import StepSpec
from parts.scene.told_files import KEYS


def scene_schema() -> str:
    """The schema of every key of every kind of part and mate, JSON Schema 2020-12."""
    # a type made while we run, which mypy cannot follow
    part: Any = Union[tuple(kind.keys for kind in KINDS.values())]  # noqa: UP007
    mate: Any = Union[tuple(kind.keys for kind in MATES.values())]  # noqa: UP007
    recipe: Any = Union[tuple(kind.keys for kind in RECIPES.values())]  # noqa: UP007
    tables: list[tuple[str, Any, Any]] = [
        ("scene", SceneInfo, msgspec.field(default_factory=SceneInfo)),
        ("parts", Annotated[dict[str, part], Meta(min_length=1)], {}),
        ("assemblies", list[recipe], []),
        ("instances", dict[str, InstanceTable], {}),
        ("mates", list[mate], []),
        ("drives", list[DriveSpec], []),
        ("steps", list[StepSpec], []),
        ("boards", dict[str, BoardSpec], {}),
        ("beds", dict[str, BedSpec], {}),
        ("checks", ChecksSpec, msgspec.field(default_factory=ChecksSpec)),
        ("exports", list[ExportSpec], []),
    ]
    scene = msgspec.defstruct("Scene", tables, forbid_unknown_fields=True, kw_only=True)
    schema = msgspec.json.schema(scene)
    names = default_names(ExportSpec)
    told = {"type": "object", "properties": {key: {} for key in names}, "additionalProperties": False}
    schema["$defs"]["Scene"]["properties"]["defaults"] = told
    for table in schema["$defs"].values():
        if "description" in table:
            # a docstring, which an editor shows as it stands
            table["description"] = inspect.cleandoc(table["description"]).replace("``", "")
        _add_files(table.get("properties", {}))
    # words may be told in several languages
    several = {"type": "object", "additionalProperties": {"type": "string"}}
    recipes = [(entry.keys.__name__, WORDS) for entry in RECIPES.values()]
    kinds_of_part = [(kind.keys.__name__, WORDS_OF_PARTS) for kind in KINDS.values()]
    for table, words in [("SceneInfo", WORDS), ("InstanceTable", WORDS), *recipes, *kinds_of_part]:
        properties = schema["$defs"][table]["properties"]
        for name in [name for name in words if name in properties]:
            told_so = {"type": "object", "additionalProperties": properties[name]} if name == "notes" else several
            properties[name] = {"anyOf": [properties[name], told_so], "default": properties[name].get("default")}
    needed: dict[str, Any] = {}
    for place, items, kinds in (
        ("parts", "additionalProperties", KINDS),
        ("mates", "items", MATES),
        ("assemblies", "items", RECIPES),
    ):
        rows = [(kind, schema["$defs"][entry.keys.__name__]) for kind, entry in kinds.items()]
        needed[place] = {items: {"allOf": [_if_kind(kind, table.get("required", [])) for kind, table in rows]}}
        # what a table needs may stand in the defaults
        for _, table in rows:
            table["required"] = [key for key in table.get("required", ()) if key not in names]
    schema["$defs"]["Scene"] |= {"if": {"not": {"required": ["defaults"]}}, "then": {"properties": needed}}
    # what an assembly makes may be changed by keys alone
    keys = schema["$defs"]["Scene"]["properties"]["parts"]
    keys["additionalProperties"] = {"anyOf": [keys["additionalProperties"], {"not": {"required": ["kind"]}}]}
    schema["$defs"]["Scene"]["anyOf"] = [{"required": ["parts"]}, {"required": ["assemblies"]}]
    return json.dumps({"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}, indent=1) + "\n"


def _add_files(properties: dict[str, Any]) -> None:
    """What may stand in a file of the user's: a motion, a picture."""
    file = {"type": "object", "properties": {"file": {"type": "string"}}, "required": ["file"],
            "additionalProperties": False}  # fmt: skip
    for key in (key for key in KEYS if key in properties):
        own = properties[key]
        properties[key] = {**own, "anyOf": [*own["anyOf"], file]} if "anyOf" in own else {"anyOf": [own, file]}


def _if_kind(kind: str, keys: list[str]) -> dict[str, Any]:
    """What a table of a kind needs."""
    return {"if": {"properties": {"kind": {"const": kind}}, "required": ["kind"]}, "then": {"required": keys}}
