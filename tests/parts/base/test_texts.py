"""Texts by language: messages that wait, plurals, catalogues of strangers, and a third language out of one .po."""

from __future__ import annotations

import gettext
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from decimal import Decimal
from pathlib import Path

import pytest

import parts
from geometry.base.errors import Nearest
from parts.base import texts
from parts.base.refusal import SceneError, sentence
from parts.base.texts import LOCALE, Told, add_catalogue, counted, filled, in_context, languages, listed, message, words
from tests.catalogues import compiled

HOUSE = Path(parts.__file__).parents[1]
HEAD = """\
msgid ""
msgstr ""
"Language: {language}\\n"
"Content-Type: text/plain; charset=UTF-8\\n"
"Plural-Forms: nplurals=2; plural=(n != 1);\\n"

"""
COUNTS = {1: "1 раз", 2: "2 рази", 5: "5 разів", 11: "11 разів", 21: "21 раз", 112: "112 разів", 1.5: "1.5 раза",
          0: "0 разів", 22: "22 рази", 14: "14 разів", 101: "101 раз", 0.5: "0.5 раза",
          3.0: "3 рази", -1: "-1 раз"}  # fmt: skip


@pytest.mark.parametrize("form", [".4f", ".3g", ".5g", ".6g", "g", ".0f"])
@pytest.mark.parametrize(
    "value", [0.12345678, -0.98765432, 41.4981049, 99999.96, 1234567.8, 3.0000000000000004e-5, 30.0]
)
def test_a_limit_is_told_on_its_side(form: str, value: float) -> None:
    """The decimal numbers beside it, by the decimal module: one step at most, and none where it is told whole."""
    plain, exact = Decimal(format(value, form)), Decimal(value)
    up, down = (Decimal(format(Told(value, up=side), form)) for side in (True, False))
    slack = abs(exact) * Decimal("1e-10")
    assert down - slack <= exact <= up + slack
    assert plain in (up, down)
    step = Decimal(1).scaleb(-4 if form == ".4f" else 0 if form == ".0f" else
                             exact.adjusted() + 1 - int(form[1:-1] or 6))  # fmt: skip
    assert up - down in (0, step)


@pytest.fixture
def own() -> Iterator[None]:
    """Catalogues that a test adds are gone after it."""
    before = list(texts._added)
    yield
    texts._added[:] = before
    words.cache_clear()


def catalogue(folder: Path, language: str, domain: str, body: str) -> Path:
    """A compiled catalogue in a folder of its own."""
    file = folder / language / "LC_MESSAGES" / f"{domain}.po"
    file.parent.mkdir(parents=True)
    file.write_text(HEAD.format(language=language) + body, "utf-8")
    file.with_suffix(".mo").write_bytes(compiled(file))
    return folder


def test_only_points_of_numbers_become_commas() -> None:
    assert words("uk").decimal("φ_д.в. = 50.5 + 0.25·2") == "φ_д.в. = 50,5 + 0,25·2"
    assert words("en").decimal("50.5") == "50.5"


def test_numbers_in_words_have_the_mark_of_the_language_and_names_do_not() -> None:
    said = "printed in (3.4) and fig. 3.9: 14.13 for 1.75, 3.5, as -0.5; least_angle_deg = 0.145, module = 2.5, x_0.3"
    told = said.replace("14.13 for 1.75, 3.5, as -0.5", "14,13 for 1,75; 3,5, as \N{MINUS SIGN}0,5").replace(
        "x_0.3", "x_0,3"
    )
    assert words("uk").phrase(said) == told
    assert words("en").phrase(said) == said.replace("-0.5", "\N{MINUS SIGN}0.5")


def test_printed_powers_of_ten_are_written_out() -> None:
    """Those of Python's own, not what a source prints, nor an index, nor what rounding leaves of nothing."""
    said = "8.47e-06 mm, 1e+05, -2.5e-07, 1.06e6, e-06, 3.1e-17"
    told = "0,00000847 mm, 100000, \N{MINUS SIGN}0,00000025, 1,06e6, e-06, 3,1e-17"
    assert words("uk").decimal(said) == told


def test_printed_numbers_below_zero_have_a_true_minus() -> None:
    assert words("uk").decimal("x = -0.5 (-3)") == "x = \N{MINUS SIGN}0,5 (\N{MINUS SIGN}3)"
    for name in ("08B-1", "9-36", "1e-17", "D-8x32", "5 - 3", "2026-11-29"):
        assert words("en").decimal(name) == name


@pytest.mark.parametrize(("count", "told"), COUNTS.items())
def test_ukrainian_counts(count: float, told: str) -> None:
    assert words("uk").say(counted("{n:.9g} time", "{n:.9g} times", by="n", n=count)) == told
    one = "{value:.0f} edge is shorter than {limit:.3g} mm; merging it would break the tolerance"
    many = "{value:.0f} edges are shorter than {limit:.3g} mm; merging them would break the tolerance"
    assert words("uk").plural(one, many, count, value=count, limit=1.0).startswith(f"{count:.0f} відрі")


@pytest.mark.parametrize(
    ("value", "unit", "english", "ukrainian"),
    [(1.0, "modules", "1 module", "1 модуль"), (2.0, "modules", "2 modules", "2 модулі"),
     (5.0, "modules", "5 modules", "5 модулів"), (0.2, "modules", "0.2 modules", "0.2 модуля"),
     (21.0, "degrees", "21 degrees", "21 градус"), (112.0, "degrees", "112 degrees", "112 градусів"),
     (1.0, "degrees", "1 degree", "1 градус"), (1.5, "mm", "1.5 mm", "1.5 мм")],
)  # fmt: skip
def test_units_of_what_would_work_go_with_their_numbers(value: float, unit: str, english: str, ukrainian: str) -> None:
    refusal = SceneError("s", "key", 9.0, "not_finite", lambda: Nearest(value, "at_most"), unit)
    assert sentence(refusal, "en").endswith(f"; at most {english} works")
    assert sentence(refusal, "uk").endswith(f"; підходить щонайбільше {ukrainian}")


def test_english_counts() -> None:
    times = [words("en").plural("{n:g} time", "{n:g} times", n, n=n) for n in (1, 2, 0, 1.5, 21, -1)]
    assert times == ["1 time", "2 times", "0 times", "1.5 times", "21 times", "-1 times"]


def test_a_message_tells_what_it_holds_in_the_same_language() -> None:
    inner = message("gear {number}", number=2)
    outer = filled("{rule}: {why}", rule=inner, why="as typed: {brace}")
    assert words("en").say(outer) == "gear 2: as typed: {brace}"
    assert words("uk").say(outer) == "колесо 2: as typed: {brace}"
    assert words("uk").say(listed(["number of teeth", inner])) == "число зубців, колесо 2"
    assert words("uk").say(in_context("sheet", "number of teeth")) == "число зубців"
    assert words("uk").say("nobody said this") == "nobody said this"
    # braces are plain where no number is given
    assert words("en").text("{ a }") == "{ a }"
    assert words("uk").text("") == ""


def test_numbers_as_drawings_print_them() -> None:
    assert [words(one).decimal("0.25 mm") for one in ("en", "uk")] == ["0.25 mm", "0,25 mm"]


def test_a_stranger_brings_a_catalogue(tmp_path: Path, own: None) -> None:
    said = "a plate of {corners} corners, by a stranger"
    assert words("uk").text(said, corners=6) == "a plate of 6 corners, by a stranger"
    body = f'msgid "{said}"\nmsgstr "плита, кутів {{corners}}"\n\nmsgid "number of teeth"\nmsgstr "не наше"\n'
    add_catalogue("stranger", catalogue(tmp_path, "uk", "stranger", body))
    assert words("uk").text(said, corners=6) == "плита, кутів 6"
    # ours is asked first
    assert words("uk").text("number of teeth") == "число зубців"
    assert words("en").text(said, corners=6) == "a plate of 6 corners, by a stranger"


def test_english_asks_for_no_catalogue(tmp_path: Path, own: None, monkeypatch: pytest.MonkeyPatch) -> None:
    def never(*_: object, **__: object) -> None:
        raise AssertionError("a catalogue is looked for")

    words.cache_clear()
    monkeypatch.setattr(gettext, "find", never)
    monkeypatch.setattr(gettext, "translation", never)
    add_catalogue("stranger", tmp_path)
    assert words("en").text("gear {number}", number=1) == "gear 1"
    assert words("en").decimal("0.5") == "0.5"
    # negative control
    with pytest.raises(AssertionError, match="looked for"):
        words("uk")


def run(code: str, house: Path = HOUSE, **environment: str) -> str:
    """What Python prints in a process of its own, with the packages of a house."""
    kept = {k: v for k, v in os.environ.items() if k not in ("LANG", "LANGUAGE", "LC_ALL", "LC_MESSAGES")}
    env = kept | {"PYTHONPATH": str(house), "PYTHONUTF8": "1", "COLUMNS": "120", **environment}
    made = subprocess.run(
        [sys.executable, "-P", "-c", code], env=env, capture_output=True, encoding="utf-8", check=False
    )
    return made.stdout + made.stderr


OPENED = """
import sys
opened = []
sys.addaudithook(lambda event, args: opened.append(str(args[0])) if event == "open" else None)
from exporters.command.cli import main
for more in ([], ["--language", "uk"]):
    for asked in (["calc", "spur", "module=2", "number_of_teeth=23"], ["check", "practicum_pair"], ["check", "james"]):
        main([*asked, *more])
    print("MO", [name for name in opened if name.endswith((".mo", ".po"))])
"""


def test_english_commands_open_no_catalogue_and_ukrainian_ones_open_one() -> None:
    """By what Python itself says it opens, in a process of its own; the parts of ``james`` are named by its recipe."""
    english, told = run(OPENED).split("MO []\n")
    assert english
    assert told.count("higherpair.mo") == 1
    assert "колесо" in told
    assert "Сателіт" in told


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["LANGUAGE", "LANG", "LC_ALL", "LC_MESSAGES"])
def test_the_language_of_the_terminal_does_not_matter(name: str, tmp_path: Path) -> None:
    """Even where the system has a catalogue for argparse, which gettext would ask for by that variable."""
    catalogue(tmp_path, "uk", "messages", 'msgid "usage: "\nmsgstr "SYSTEM: "\n')
    code = "import gettext; gettext.bindtextdomain('messages', {!r})\n{}\n"
    code += "from exporters.command.cli import main\nmain({!r})"
    control = "import argparse; argparse.ArgumentParser().print_usage()"
    speaks = {name: "uk_UA.UTF-8"}
    # negative control: argparse alone does as the terminal says
    assert "SYSTEM: " in run(code.format(str(tmp_path), control, ["list"]), **speaks)
    assert "usage: higherpair build" in run(code.format(str(tmp_path), "", ["build", "--help"]), **speaks)
    asked = ["build", "--help", "--language", "uk"]
    assert "використання: higherpair build" in run(code.format(str(tmp_path), "", asked), **speaks)
    wrong = run(code.format(str(tmp_path), "", ["build"]), **speaks)
    assert wrong == "higherpair: the following arguments are required: SCENE; see `higherpair build --help`\n"


def test_the_scene_says_in_which_language_its_command_is_misused(tmp_path: Path) -> None:
    scene = tmp_path / "s.toml"
    scene.write_text('[scene]\nlanguage = "uk"\n', "utf-8")
    code = "from exporters.command.cli import main\nmain({!r})"
    told = run(code.format(["build", str(scene), "--nothing"]))
    assert told == "higherpair: невідомі аргументи: --nothing; див. `higherpair build --help`\n"
    told = run(code.format(["build", str(scene), "--nothing", "--language", "en"]))
    assert told == "higherpair: unrecognized arguments: --nothing; see `higherpair build --help`\n"
    assert "використання: " in run(code.format(["build", str(scene), "--help"]))


def test_a_third_language_is_one_po(tmp_path: Path) -> None:
    """A copy of the house with one file more: its scenes, its command and its calculations speak that language."""
    for package in ("geometry", "parts", "exporters"):
        shutil.copytree(HOUSE / package, tmp_path / package)
    body = 'msgid "External gear"\nmsgstr "Koło zębate"\n\nmsgid "options"\nmsgstr "opcje"\n\n'
    catalogue(tmp_path / "parts" / "locale", "pl", "higherpair", body)
    code = "from contextlib import suppress\nfrom exporters.command.cli import main\nfor words in {!r}:\n"
    code += "    print('@@', flush=True)\n    with suppress(SystemExit):\n        main(words)\n"
    calc = ["calc", "spur", "module=2", "number_of_teeth=23", "--language", "pl"]
    scene = tmp_path / "s.toml"
    scene.write_text('[scene]\nlanguage = "pl"\n[parts.gear]\nkind = "spur_gear"\nmodule = 2\nnumber_of_teeth = 23\n')
    asked = [calc, ["list", "--help", "--language", "pl"], ["new", "spur_gear"], ["calc", "spur", str(scene)]]
    _, told, options, new, of_scene = run(code.format(asked), tmp_path).split("@@\n")
    assert told.startswith("Koło zębate\n")
    # what it lacks is English
    assert "number of teeth" in told
    assert "opcje:" in options
    assert 'one of "en", "pl", "uk"' in new
    assert of_scene.startswith("Koło zębate\n")
    # negative control: this house has none
    told = run(code.format([calc])).removeprefix("@@\n")
    assert told == 'higherpair: calc: --language = "pl": must be one of en, uk\n'
    assert languages() == ("en", "uk")
    assert sorted(p.name for p in LOCALE.iterdir()) == ["uk"]
