"""What keys of parts and assemblies take from files of the user's: ``motion_table = { file = "lift.csv" }``."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from geometry.base.errors import ParameterError
from parts.base.content import content_beside
from parts.base.refusal import placed

KEYS = ("motion_table", "picture")


def has_files(raw: dict[str, Any]) -> bool:
    """Whether a part or an assembly of a scene names such a file."""
    parts, told = raw.get("parts"), raw.get("assemblies")
    tables = [*(parts.values() if isinstance(parts, dict) else ()), *(told if isinstance(told, list) else ())]
    return any(isinstance(table, dict) and [*_named(table)] for table in tables)


def with_files(raw: dict[str, Any], source: str) -> dict[str, Any]:
    """The tables of a scene with what those files hold in place of their names.

    Raises
    ------
    SceneError
        A file that is not there, or does not hold it.
    """
    made = dict(raw)
    if isinstance(parts := raw.get("parts"), dict):
        made["parts"] = {key: _read(table, source, f"parts.{key}") for key, table in parts.items()}
    if isinstance(told := raw.get("assemblies"), list):
        made["assemblies"] = [_read(table, source, f"assemblies[{k}]") for k, table in enumerate(told, 1)]
    return made


def _named(table: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """Keys of a table with the names of their files."""
    for key in KEYS:
        told = table.get(key)
        if isinstance(told, dict) and [*told] == ["file"] and isinstance(told["file"], str):
            yield key, told["file"]


def _read(table: object, source: str, place: str) -> object:
    if not isinstance(table, dict):
        return table
    found = dict(table)
    for key, name in _named(table):
        try:
            found[key] = _held(key, name, Path(source).parent)
        except ParameterError as refusal:
            raise placed(source, f"{place}.{key}", refusal) from None
    return found


def _held(key: str, name: str, folder: Path) -> list[list[float]]:
    if key == "picture":
        from parts.scene import picture_files

        return picture_files.picture_of(content_beside(name, folder, picture_files.MOST_BYTES), name)
    from parts.scene import motion_files

    return motion_files.rows_of(content_beside(name, folder, motion_files.MOST_BYTES), name)
