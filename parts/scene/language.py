"""The language that a scene asks for, even where the scene itself is refused."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

from parts.base.content import content
from parts.base.texts import ENGLISH, languages
from parts.scene.files import MOST_BYTES, built_in_scenes, text_of


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
