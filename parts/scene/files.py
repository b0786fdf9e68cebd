"""Scene files: where those of the package lie, their titles, and the text that a file holds."""

from __future__ import annotations

import codecs
import re
import tomllib
from functools import cache
from pathlib import Path
from typing import Any

from parts.base.texts import told_in

SCENE_FOLDER = Path(__file__).parents[1] / "scenes"
# a scene that is larger than this is not one
MOST_BYTES = 4_000_000
# a key of so many parts in a row, for which tomllib takes the square of the time; one of four is right
_DEEP_KEY = re.compile(r"""(?m)(?:^|[\[{,])[ \t]*(?:(?:[\w-]+|"[^"\n]*"|'[^'\n]*')[ \t]*\.[ \t]*){50}""")


@cache
def built_in_scenes() -> dict[str, Path]:
    """Names and files of the scenes that come with the package."""
    return {path.stem: path for path in sorted(SCENE_FOLDER.glob("*.toml"))}


def title_of(file: Path, language: str) -> str:
    """The title of a scene of the package, in a language that it has or in English."""
    told = tomllib.loads(file.read_text(encoding="utf-8"))["scene"]["title"]
    return told_in(language, told)


def text_of(raw: bytes) -> str:
    """The text of a scene file: UTF-8, with a mark of byte order or without; UTF-16 with one, as PowerShell writes it.

    Raises
    ------
    UnicodeDecodeError
        It is neither.
    """
    if raw[:2] in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE):
        return raw.decode("utf-16")
    if (b"\0" in raw[::2]) is not (b"\0" in raw[1::2]):
        # of UTF-16 without a mark the same half of each Latin letter
        zero = raw.index(b"\0")
        raise UnicodeDecodeError("utf-8", raw, zero, zero + 1, "no text")
    text = raw.decode("utf-8-sig")
    # old editors of the Mac end lines so, which all editors of today read
    return text if "\n" in text else text.replace("\r", "\n")


def tables_of(raw: bytes) -> dict[str, Any]:
    """What a scene file holds.

    Raises
    ------
    UnicodeDecodeError, tomllib.TOMLDecodeError, RecursionError
        It is no text, no TOML, or nested far beyond what scenes need.
    """
    text = text_of(raw)
    if _DEEP_KEY.search(text):
        raise RecursionError
    return tomllib.loads(text)
