"""The README against what is on disk: what is offered is named, every picture is there and shown."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from exporters.documents.topics import TOPICS
from parts.base.registry import KINDS
from parts.mates.registry import MATES
from parts.recipes.registry import RECIPES

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text("utf-8")


@pytest.mark.parametrize("name", [*KINDS, *MATES, *RECIPES])
def test_everything_on_offer_is_named(name: str) -> None:
    assert re.search(rf"\b{name}\b", README)


@pytest.mark.parametrize("topic", TOPICS)
def test_every_calculation_is_named(topic: str) -> None:
    assert re.search(rf"\b{topic}\b", README)


def test_every_picture_is_there_and_shown() -> None:
    shown = set(re.findall(r"\]\(\.pictures/([\w.]+)\)", README))
    assert shown == {file.name for file in (ROOT / ".pictures").iterdir()}


def test_what_is_missing_is_installed_in_the_readme_s_words() -> None:
    """From the folder of the project: no index of packages has it."""
    told = re.findall(r"pip install (\S+\])", README)
    for room in ("parts", "exporters"):
        for file in (ROOT / room).rglob("*.py"):
            told += re.findall(r"pip install (\S+\])", file.read_text("utf-8"))
    assert {word.lstrip("\"'\\") for word in told} == {".[pdf]", ".[cad]", ".[cluster]"}
