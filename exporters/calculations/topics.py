"""The topics of ``higherpair calc``: which file makes the sheet of each, and how it is asked for."""

from __future__ import annotations

import importlib
from collections.abc import Sequence
from pathlib import Path

from exporters.calculations.inputs import PLACE, table_of
from exporters.calculations.render import FORMATS, render
from exporters.calculations.sheet import Sheet
from parts.schema import SceneError, near

# each module has sheet_of(table, scene, source, language)
TOPICS = {
    "spur": "spur",
    "tmm42": "tmm42",
    "gear-pair": "gear_pair",
    "shift-choice": "shift_choice",
    "cam": "cam",
    "cycloidal": "cycloidal",
    "lantern": "lantern",
    "noncircular": "noncircular",
}
LANGUAGES = ("en", "uk")


def calculate(topic: str, words: Sequence[str], form: str, language: str | None) -> str:
    """The rendered calculation of a topic; ``words`` are at most one scene and any number of key=value.

    Raises
    ------
    SceneError
        A wrong topic, key or value, with the nearest that works.
    """
    if topic not in TOPICS:
        raise SceneError(PLACE, "TOPIC", topic, f"unknown topic{near(topic, TOPICS)}; topics: {', '.join(TOPICS)}")
    for name, value, known in (("--format", form, FORMATS), ("--language", language, LANGUAGES)):
        if value is not None and value not in known:
            raise SceneError(PLACE, name, value, f"must be one of {', '.join(known)}{near(value, known)}")
    sheet, spoken = sheet_of(topic, words)
    language = language or spoken
    if sheet.picture_file is not None and language in sheet.drawings:
        sheet.drawings[language](Path(sheet.picture_file))
    elif sheet.picture_file is not None and language in sheet.pictures:
        Path(sheet.picture_file).write_text(sheet.pictures[language], encoding="utf-8", newline="\n")
    return render(sheet, form, language)


def sheet_of(topic: str, words: Sequence[str]) -> tuple[Sheet, str]:
    """The sheet of a topic and the language of its scene."""
    addresses = [word for word in words if "=" not in word or Path(word).is_file()]
    if len(addresses) > 1:
        raise SceneError(PLACE, addresses[1], None, f"one scene is enough; {addresses[0]} is given already")
    table = table_of([word for word in words if word not in addresses])
    module = importlib.import_module(f"exporters.calculations.{TOPICS[topic]}")
    if not addresses:
        return module.sheet(table), "en"
    from parts.scene import load_scene

    scene = load_scene(addresses[0])
    return module.sheet(module.table_from(scene, addresses[0], table)), scene.scene.language
