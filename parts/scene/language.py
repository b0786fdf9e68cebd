"""The language that a scene asks for, even where the scene itself is refused, and its words in it."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

from parts.base.content import content
from parts.base.texts import ENGLISH, languages
from parts.scene.files import MOST_BYTES, built_in_scenes, text_of

# keys that hold words, and may hold them in several languages
WORDS = ("title", "label", "material")


def language_of(address: str) -> str:
    """The language of a scene by its name or file, as far as it can be read; English where it cannot."""
    path = Path(address)
    try:
        path = built_in_scenes().get(address, path) if not path.is_file() else path
        raw = content(path, MOST_BYTES)
    except (OSError, ValueError):
        return ENGLISH
    try:
        asked = tomllib.loads(text_of(raw)).get("scene", {}).get("language")
    except (ValueError, AttributeError, RecursionError):
        # what is no TOML may still say it
        found = re.search(rb"""(?m)^\s*language\s*=\s*["'](\w+)["']""", raw)
        asked = found[1].decode() if found else ENGLISH
    return asked if asked in languages() else ENGLISH


def in_language(raw: dict[str, Any], source: str, asked: str | None) -> dict[str, Any]:
    """The tables of a scene, its titles, labels and materials in the language ``asked`` for, else in the scene's.

    Raises
    ------
    SceneError
        A language has no catalogue.
    """
    scene = raw.get("scene", {})
    tables = {key: raw[key] for key in ("parts", "instances") if isinstance(raw.get(key), dict)}
    if not isinstance(scene, dict):
        return raw
    if asked is not None:
        scene = {**scene, "language": asked}
    language = scene.get("language", ENGLISH)
    made = {**raw, "scene": _chosen(scene, language, source, "scene")}
    for name, rows in tables.items():
        made[name] = {key: _chosen(table, language, source, f"{name}.{key}") for key, table in rows.items()}
    if "defaults" in raw:
        made["defaults"] = _chosen(raw["defaults"], language, source, "defaults")
    if isinstance(told := raw.get("assemblies"), list):
        made["assemblies"] = [_chosen(one, language, source, f"assemblies[{k}]") for k, one in enumerate(told, 1)]
    return made


def _chosen(table: object, language: str, source: str, place: str) -> Any:
    """A table whose words stand in one language: the one asked for, else English, else the first."""
    # ``list`` asks for the language alone and loads nothing of geometry
    from parts.base.refusal import SceneError, meant

    if not isinstance(table, dict):
        return table
    made = dict(table)
    if language == "uk" and isinstance(table.get("title_uk"), str):
        made["title"] = table["title_uk"]
    for key in WORDS:
        if not isinstance(told := table.get(key), dict) or not told:
            continue
        for other in told:
            if other not in languages():
                known = languages()
                raise SceneError(
                    source, f"{place}.{key}.{other}", told[other], "not_one_of", meant(other, known), known=known
                )
        made[key] = told.get(language, told.get(ENGLISH, next(iter(told.values()))))
    return made
