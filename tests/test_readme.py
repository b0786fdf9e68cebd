"""The pages against what is on disk: what is offered is named, what is named is there, every picture is shown."""

from __future__ import annotations

import math
import re
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.documents.topics import TOPICS
from parts.base.densities import DENSITIES
from parts.base.registry import KINDS
from parts.mates.registry import MATES
from parts.recipes.registry import RECIPES
from parts.scene.files import built_in_scenes
from tests import pictures

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text("utf-8")
PACKAGES = ("geometry", "parts", "exporters")


@pytest.mark.parametrize("name", [*KINDS, *MATES, *RECIPES])
def test_everything_on_offer_is_named(name: str) -> None:
    assert re.search(rf"\b{name}\b", README)


@pytest.mark.parametrize("topic", TOPICS)
def test_every_calculation_is_named(topic: str) -> None:
    assert re.search(rf"\b{topic}\b", README)


def test_every_picture_is_there_and_shown() -> None:
    shown = set(re.findall(r"\]\(\.pictures/([\w.]+)\)", README))
    assert shown == {file.name for file in (ROOT / ".pictures").iterdir()}


@pytest.mark.parametrize("scene", [
    scene if scene == "worm" else pytest.param(scene, marks=pytest.mark.heavy)
    for scene in sorted({scene for scene, _ in pictures.OF.values()})
])  # fmt: skip
def test_pictures_are_what_the_program_makes(scene: str, tmp_path: Path) -> None:
    """``python -m tests.pictures`` makes them anew."""
    for name, text in pictures.made(scene, tmp_path).items():
        assert (pictures.FOLDER / f"{name}.svg").read_text("utf-8") == text, name


def unnamed_rooms(page: str) -> set[str]:
    """Folders of code, the second ones below geometry too, which the table of the house does not name."""
    house = page.partition("## The house")[2]
    rooms = [*ROOT.glob("geometry/*/*/__init__.py")]
    rooms += [file for package in PACKAGES for file in (ROOT / package).glob("*/__init__.py")]
    return {file.parent.name for file in rooms if f"`{file.parent.name}`" not in house}


def test_the_house_names_every_room() -> None:
    assert not unnamed_rooms(README)
    assert unnamed_rooms(README.replace("`worms`, ", "")) == {"worms"}


def test_what_is_missing_is_installed_in_the_readme_s_words() -> None:
    """From the folder of the project: no index of packages has it."""
    told = re.findall(r"pip install (\S+\])", README)
    for room in ("parts", "exporters"):
        for file in (ROOT / room).rglob("*.py"):
            told += re.findall(r"pip install (\S+\])", file.read_text("utf-8"))
    assert {word.lstrip("\"'\\") for word in told} == {".[pdf]", ".[cad]", ".[cluster]", ".[stress]"}


PAGES = {
    name: (ROOT / name).read_text("utf-8")
    for name in ("README.md", "README.uk.md", "CONTRIBUTING.md", "CONVENTIONS.md")
}
PLACES = re.compile(r"(?:geometry|parts|exporters|tests|\.ci|out)/[\w./*-]*")


@cache
def words_of_the_code() -> frozenset[str]:
    """Every word of what runs, its keys and scenes among them."""
    found: set[str] = set()
    for folder in (*PACKAGES, "tests"):
        for file in (*(ROOT / folder).rglob("*.py"), *(ROOT / folder).rglob("*.toml")):
            if file != Path(__file__):
                found |= set(re.findall(r"\w+", file.read_text("utf-8")))
    return frozenset(found | set(re.findall(r"\w+", (ROOT / "pyproject.toml").read_text("utf-8"))))


def lost_links(page: str) -> list[str]:
    """Links into the page itself that lead nowhere: a heading's anchor is its words, small, with dashes."""
    headings = re.findall(r"^##+ (.+)$", re.sub(r"```.*?```", "", page, flags=re.DOTALL), re.MULTILINE)
    anchors = {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}
    return [link for link in re.findall(r"\]\(#([^)]+)\)", page) if link not in anchors]


@pytest.mark.parametrize("name", PAGES)
def test_links_within_a_page_lead_somewhere(name: str) -> None:
    assert not lost_links(PAGES[name])


def test_a_link_that_leads_nowhere_is_found() -> None:
    page = README.replace("### Cams\n", "### Cams and more\n")
    assert lost_links(page) == ["cams"]


def unknown(page: str) -> list[str]:
    """Places that are not on disk, names that the code does not have, commands that there are not, of a page."""
    text = re.sub(r"\\\\|out/\w[\w./]*|<!--.*?-->", " ", page)
    # CONTRIBUTING tells places within `tests/`, and LANGUAGE stands for any
    places = [re.sub("[A-Z]{4,}", "*", place.rstrip("./")) for place in PLACES.findall(text) if place != "out/"]
    found = [place for place in places if not any(any(home.glob(place)) for home in (ROOT, ROOT / "tests"))]
    for told in re.findall(r"`([^`\n]+)`", text):
        if re.fullmatch(r"[a-z][a-z0-9]*(_[a-z0-9]+)+|[a-z][\w.]*\.py|[A-Z][a-z]+[A-Z]\w+", told):
            # of a group's members and of built-in scenes the code has no word of their own
            known = {told, re.sub(r"_\d+$", "", told)} & (words_of_the_code() | built_in_scenes().keys())
            found += [] if known or (told.endswith(".py") and any(ROOT.rglob(told))) else [told]
    for command in re.findall(r"higherpair (build|check|new|calc|verify|converge|catalogue) ([\w-]+)(?=[ `\n])", text):
        verb, name = command
        known_names = TOPICS if verb == "calc" else {**built_in_scenes(), **KINDS, **MATES, **RECIPES}
        found += [] if name in known_names or name in ("out", "my_gear") else [" ".join(command)]
    return found


@pytest.mark.parametrize("name", PAGES)
def test_what_a_page_names_is_there(name: str) -> None:
    assert unknown(PAGES[name]) == []


def test_the_ukrainian_page_says_what_the_english_one_does() -> None:
    """Its commands stand there too, but for the language; its pictures and files are there, its kinds exist."""

    def commands(page: str) -> set[str]:
        fenced = re.findall(r"^```(\w*)\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
        blocks = "\n".join(text for form, text in fenced if not form)
        lines = (re.sub(r" --language uk|\.venv/bin/", "", line.partition("#")[0]) for line in blocks.splitlines())
        return {" ".join(line.split()) for line in lines if line.strip()}

    ours = PAGES["README.uk.md"]
    assert commands(ours) <= commands(README)
    assert len(commands(ours)) > 15
    assert set(re.findall(r"\]\((\.pictures/[\w.]+)\)", ours)) <= set(re.findall(r"\]\((\.pictures/[\w.]+)\)", README))
    # keys of its scenes are those of the English page
    tables = [set(re.findall(r"^(\w+) =", page, re.MULTILINE)) for page in (ours, README)]
    assert tables[0] - tables[1] <= {"language"}
    assert "](README.uk.md)" in README
    assert "](README.md)" in ours


@pytest.mark.parametrize(
    "spoiled",
    ["`parts/base/no_such.py`", "`exporters/nowhere/`", "`no_such_name_at_all`", "`NoSuchClass`", "`nofile.py`",
     "`higherpair build lesson_9`", "higherpair calc spurs module=2"],
)  # fmt: skip
def test_what_is_not_there_is_noticed(spoiled: str) -> None:
    assert len(unknown(spoiled)) == 1


def test_the_script_gives_what_it_says() -> None:
    """Its last gear, z 111 m 2: tips at m (z + 2) / 2, roots at m (z - 2.5) / 2, an area between the two circles."""
    (script,) = re.findall(r"^```python\n(.*?)^```", README, re.DOTALL | re.MULTILINE)
    told: dict[str, Any] = {}
    exec(script, told)
    x, y = told["points"].real, told["points"].imag
    sizes = abs(told["points"])
    assert (sizes.max(), sizes.min()) == pytest.approx((113.0, 108.5), abs=0.005)
    area = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2
    assert math.pi * 108.5**2 < area < math.pi * 113.0**2
    assert 0 < told["chords"].max_error <= 0.005
    assert {type(curve).__name__ for curve in told["flanks"]} >= {"Involute", "TrochoidFillet"}


def test_the_count_of_materials_is_that_of_the_table() -> None:
    assert f"shows {len(DENSITIES) // 100 * 100} names" in README
