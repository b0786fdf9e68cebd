"""Unions that msgspec 0.22 frees wrongly, which ends the process: a pattern of words beside a table or a list."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from msgspec import inspect as types

from parts.base.registry import KINDS
from parts.keys.boards import BedSpec, BoardSpec
from parts.mates.registry import MATES
from parts.recipes.registry import RECIPES
from parts.scene.instances import DriveSpec, InstanceTable
from parts.scene.scene_file import ChecksSpec, ExportSpec, SceneInfo

COLLECTIONS = types.DictType | types.ListType | types.VarTupleType | types.TupleType


def bare(kind: Any) -> Any:
    """A type without what is said of it."""
    return bare(kind.type) if isinstance(kind, types.Metadata) else kind


def crashing(kind: Any, place: str, seen: set[type]) -> Iterator[str]:
    """Places of a type, at any depth, with such a union."""
    kind = bare(kind)
    if isinstance(kind, types.StructType) and kind.cls not in seen:
        seen.add(kind.cls)
        for field in kind.fields:
            yield from crashing(field.type, f"{place}.{field.name}", seen)
    if isinstance(kind, types.UnionType):
        choices = [bare(one) for one in kind.types]
        patterns = [one for one in choices if isinstance(one, types.StrType) and one.pattern]
        if patterns and any(isinstance(one, COLLECTIONS) for one in choices):
            yield place
    within = [getattr(kind, name) for name in ("item_type", "key_type", "value_type") if hasattr(kind, name)]
    for one in (*within, *getattr(kind, "types", ()), *getattr(kind, "item_types", ())):
        yield from crashing(one, place, seen)


def test_no_key_has_a_pattern_beside_a_table() -> None:
    tables = {name: kind.keys for every in (KINDS, MATES, RECIPES) for name, kind in every.items()}
    tables |= {one.__name__: one for one in (BedSpec, BoardSpec, ChecksSpec, DriveSpec, ExportSpec, InstanceTable)}
    seen: set[type] = set()
    found = [place for name, keys in tables.items() for place in crashing(types.type_info(keys), name, seen)]
    assert found == [*crashing(types.type_info(SceneInfo), "scene", seen)] == []
    assert len(seen) > 80


def test_such_a_union_is_seen() -> None:
    """Told by hand: msgspec is never shown one, since that alone ends the process at some later time."""
    title = types.UnionType((types.StrType(pattern=r"\S"), types.DictType(types.StrType(), types.AnyType())))
    assert [*crashing(types.ListType(types.Metadata(title)), "wrong", set())] == ["wrong"]
    assert [*crashing(types.UnionType((types.StrType(pattern=r"\S"), types.NoneType())), "right", set())] == []
