"""The language that a scene asks for, even where the scene itself is refused, and its words in it."""

from __future__ import annotations

import re
from collections.abc import Collection
from pathlib import Path
from typing import Any

from parts.base.content import content
from parts.base.texts import ENGLISH, languages, told_in
from parts.scene.files import MOST_BYTES, built_in_scenes, tables_of

# keys that hold words, and may hold them in several languages
WORDS: tuple[str, ...] = ("title", "label", "material", "notes")
# line breaks, tabs and broad blanks, for which neither XML attributes nor lines of a sheet have a place
_SPACE = re.compile(r"\s")
# those that a part keeps in one: its title stays in all of them, as STEP files tell it
WORDS_OF_PARTS: tuple[str, ...] = ("label", "material")


def language_of(address: str) -> str:
    """The language of a scene by its name or file, as far as it can be read; English where it cannot."""
    path = Path(address)
    try:
        path = built_in_scenes().get(address, path) if not path.is_file() else path
        raw = content(path, MOST_BYTES)
    except (OSError, ValueError):
        return ENGLISH
    try:
        asked = tables_of(raw).get("scene", {}).get("language")
    except (ValueError, AttributeError, RecursionError):
        # what is no TOML may still say it
        found = re.search(rb"""(?m)^[ \t]*language[ \t]*=[ \t]*["']?(\w+)""", raw)
        asked = found[1].decode() if found else ENGLISH
    if asked is None or asked in languages():
        return asked or ENGLISH
    return language_meant(asked) or ENGLISH


def language_meant(asked: object) -> str | None:
    """What is no language is refused in the one that was meant; None where none is near."""
    from parts.base.refusal import meant

    nearest = meant(asked, languages())
    return str(nearest.value) if nearest else None


def in_language(raw: dict[str, Any], source: str) -> dict[str, Any]:
    """The plain tables of a scene with their words in its language; titles of parts stay in all that they have.

    Raises
    ------
    SceneError
        A language has no catalogue.
    """
    made = {**raw, "scene": in_one(raw, raw.get("scene", {}), source, "scene")}
    for name, chosen in {"parts": WORDS_OF_PARTS, "instances": WORDS}.items():
        rows = raw.get(name, {})
        made[name] = {key: in_one(raw, table, source, f"{name}.{key}", chosen) for key, table in rows.items()}
    return made


def in_one(raw: dict[str, Any], table: object, source: str, place: str, chosen: Collection[str] = WORDS) -> Any:
    """A table of a scene (all tables: ``raw``) with the ``chosen`` of its words in the scene's language.

    Raises
    ------
    SceneError
        A language has no catalogue.
    """
    # ``list`` asks for the language alone and loads nothing of geometry
    from parts.base.materials import check_material
    from parts.base.refusal import SceneError, meant

    if not isinstance(table, dict):
        return table
    made, language = dict(table), raw.get("scene", {}).get("language", ENGLISH)
    for key in WORDS:
        if key in made:
            made[key] = _in_a_line(made[key])
        if not isinstance(told := made.get(key), dict) or not told:
            continue
        for other in told:
            if other not in languages():
                known = languages()
                raise SceneError(
                    source, f"{place}.{key}.{other}", told[other], "unknown_key", meant(other, known), known=known
                )
        if key in chosen:
            _check_all(told, key, source, f"{place}.{key}")
            if key == "material" and "density" not in table:
                for other, name in told.items():
                    check_material(name, source, f"{place}.{key}.{other}")
            made[key] = told_in(str(language), told)
    return made


def _in_a_line(words: object) -> object:
    """Words, in whatever languages, whose white space is plain blanks."""
    if isinstance(words, dict):
        return {key: _in_a_line(told) for key, told in words.items()}
    return _SPACE.sub(" ", words) if isinstance(words, str) else words


def _check_all(told: dict[str, Any], key: str, source: str, place: str) -> None:
    """Words that are not told today are words too: tomorrow's ``--language`` tells them."""
    import msgspec

    from parts.base.refusal import SceneError
    from parts.base.schema import type_words

    for language, words in told.items():
        try:
            msgspec.convert(words, list[str] if key == "notes" else bool | str if key == "label" else str)
        except msgspec.ValidationError:
            where, kind = f"{place}.{language}", "array" if key == "notes" else "str"
            if kind == "array" and isinstance(words, list):
                index = next(i for i, paragraph in enumerate(words) if not isinstance(paragraph, str))
                where, words, kind = f"{where}[{index + 1}]", words[index], "str"
            raise SceneError(source, where, words, "wrong_type", type=type_words(kind)) from None
