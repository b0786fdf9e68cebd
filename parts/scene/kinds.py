"""The kinds of a scene's tables: which one a table says that it is, and where a kind of other tables belongs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from parts.base.lazy import Index
from parts.base.refusal import SceneError
from parts.base.registry import KINDS
from parts.base.schema import kind_of


def part_kind(table: Mapping[str, Any], source: str, place: str) -> str:
    """The kind of a part.

    Raises
    ------
    SceneError
        It has none, or one that no part has; one of other tables is told where it belongs.
    """
    return _kind(table, KINDS, source, place)


def mate_kind(table: Mapping[str, Any], source: str, place: str) -> str:
    """The kind of a mate; see ``part_kind``."""
    from parts.mates.registry import MATES

    return _kind(table, MATES, source, place, "unknown_mate")


def assembly_kind(table: Mapping[str, Any], source: str, place: str) -> str:
    """The kind of an assembly; see ``part_kind``."""
    from parts.recipes.registry import RECIPES

    return _kind(table, RECIPES, source, place)


def _kind(
    table: Mapping[str, Any], known: Index[Any], source: str, place: str, code: str = "unknown_kind"
) -> str:  # fmt: skip
    try:
        return kind_of(table, known, source, place, code)
    except SceneError as refusal:
        if refusal.code == code and (where := _home(refusal.value)):
            raise SceneError(source, refusal.key, refusal.value, "kind_of_other_tables", where=where) from refusal
        raise


def _home(kind: object) -> str:
    """The tables that have such a kind; "": none have."""
    return next((where for where, kinds in homes().items() if isinstance(kind, str) and kind in kinds), "")


def homes() -> dict[str, Index[Any]]:
    """The kinds of the tables that have some, by the header of such a table."""
    from parts.mates.registry import MATES
    from parts.recipes.registry import RECIPES

    return {"[parts.NAME]": KINDS, "[[mates]]": MATES, "[[assemblies]]": RECIPES}
