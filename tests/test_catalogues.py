"""The catalogues are whole: every text has its translation, with the same placeholders, and is told with numbers."""

from __future__ import annotations

import ast
import re
import string
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from collections import Counter
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from babel.messages.catalog import Message

from parts.base.psv import rows_of
from parts.base.texts import LOCALE, words
from parts.scene.files import SCENE_FOLDER
from parts.texts import checks
from tests import catalogues
from tests.catalogues import HOUSE, catalogue_files, compiled, extracted, names_typed, read, untranslated, updated
from tests.test_architecture import product_files

ROOT = Path(__file__).resolve().parent.parent
FILES = pytest.mark.parametrize("file", catalogue_files(), ids=lambda f: f.parts[-3])
CYRILLIC = re.compile("[\u0400-\u04ff]")
# where Ukrainian letters stand in the code, and why
CYRILLIC_PLACES = {
    "parts/pages/contact_steps.py": "the practicum's tables Д.1, Е.1",
    "parts/gears/spur_gear/involute_page.py": "the practicum's tables Д.1, Е.1",
    "parts/pages/misprints.py": "the practicum's tables Д.1, Е.1",
    "geometry/plane/letters.py": "the letters that are engraved",
    "geometry/gears/shifts/tables.py": "the practicum's tables А.1, Б.1, В.1, Г.1",
}

# what a translation may say in Latin letters: what is typed and is no key, kind or choice of a scene
TYPED = {
    *(
        "arcsin",
        "arctg",
        "atan",
        "beta",
        "bevel",
        "crossed",
        "build",
        "bulge",
        "calc",
        "check",
        "constant",
        "csv",
        "delta",
        "expand",
    ),
    *(
        "false",
        "gear",
        "higherpair",
        "host",
        "html",
        "install",
        "internal",
        "json",
        "kind",
        "language",
        "linear",
        "pair",
    ),
    *("planetary", "purpose", "steel", "stress", "text", "toml", "true", "value", "verify"),
}
# one term for one thing: the word of the catalogue, and what is not said in its place
TERMS_OF = {
    "uk": {
        "передаточне": "передатн|передавальн",
        "стрижень": "стержень|стержн",
        "западина": "впадин",
        "шестерня": "шестірн",
        "бічний зазор": "боков(?:ий|ого) зазор",
        "головка": "голівк",
        "гравіювати": "гравір",
        "границя міцності": "меж[аі] міцн",
        "кваліфікаційна робота": "дисертац|дипломн",
        "типово": "за замовчуванням",
        "вгнутий": r"увігнут|ввігнут|\bугнут",
        "тека": r"\bпап(?:ка|ки|ку|ці|кою)\b",
        "стоншення": "потонш",
        "складальна одиниця": "складанин",
        "закінчується": r"\bкінча[єю]т",
        "зчіплюється": "зачіплю[єю]",
        "спільна нормаль": r"загальн\w+ нормал",
        "напрям": "напрямо?к",
        "Джеймса": "джемс",
        "зубців": r"\bзубів\b",
        "апостроф '": "[ʼ’`](?=[яюєї])",
        "українські літери": "[ыэёъ]",
    }
}


@cache
def texts_of(file: Path) -> list[Message]:
    """The messages of a .po without its head, read once."""
    return [m for m in read(file) if m.id]


def placeholders(text: str) -> set[tuple[str, str, str]]:
    """Names, conversions and formats, of {braces} and of %."""
    found: set[tuple[str, str, str]] = set()
    for _, name, spec, conversion in string.Formatter().parse(text):
        # the braces of an index, O_{2}, are no placeholder
        if name is not None and not name.isdigit():
            found.add((name, spec or "", conversion or ""))
    return found | {("%", one, "") for one in re.findall(r"%(?:\(\w+\))?[sr]", text)}


def pieces(one: Message) -> tuple[list[str], list[str]]:
    """Its msgids and its translations."""
    return ([*one.id], [*one.string]) if isinstance(one.id, tuple | list) else ([one.id], [one.string])


@cache
def marked() -> dict[tuple[str | None, str], str]:
    """All texts of the product, taken out of the code once."""
    return extracted()


@FILES
def test_every_text_has_its_translation(file: Path) -> None:
    stand = {(m.context, pieces(m)[0][0]) for m in texts_of(file)}
    made = marked()
    asked = set(made)
    assert sorted(map(str, asked - stand)) == [], "run python -m tests.catalogues and translate"
    assert sorted(map(str, stand - asked)) == [], "run python -m tests.catalogues"
    assert untranslated(file) == []
    assert updated(file, made) == file.read_text("utf-8"), "run python -m tests.catalogues"


@FILES
def test_the_mo_is_the_compiled_po(file: Path) -> None:
    assert compiled(file) == file.with_suffix(".mo").read_bytes(), "run python -m tests.catalogues"


@FILES
def test_translations_hold_the_same_placeholders(file: Path) -> None:
    for one in texts_of(file):
        ids, told = pieces(one)
        if any("{ " in text for text in ids):
            continue
        for text in (*ids, *told):
            assert placeholders(text) == placeholders(ids[0]), (ids[0], text)


def faults(english: str, told: str, language: str) -> list[str]:
    """What is wrong with a translation, as far as a machine can tell."""
    found = []
    if (again := told.find(told[:12], 12)) > 0 and told.startswith(told[:again].strip(), again):
        found.append("said twice")
    if "{ " not in english and times(told) != times(english):
        found.append("a field stands there more or less often")
    if "``" in told:
        found.append("a mark of a docstring")
    if told.count("  ") > english.count("  "):
        found.append("two spaces")
    if re.search(" [-–] ", told) and " - " not in english:
        found.append("a dash is —")
    bare = re.sub(r"\{[^{}]*\}|%\(\w+\)[rs]|`[^`]*`|\"[^\"]*\"", " ", told)
    latin = re.findall(r"(?<![\w.])[a-z]{4,}(?![\w.])", bare)
    found += [f"not translated: {word}" for word in latin if word not in TYPED | typed()]
    return found + [f"not {word}" for word in rivals(language).findall(told.lower())]


def ends_alike(english: str, told: str) -> bool:
    """Whether both end in the same sign of a sentence, or in none."""
    last = {text.rstrip()[-1:] for text in (english, told)}
    return len(last) == 1 or not last & set(".:;?!,")


def times(text: str) -> Counter[str]:
    """How often each field stands in a text."""
    return Counter(name for _, name, _, _ in string.Formatter().parse(text) if name is not None)


@cache
def rivals(language: str) -> re.Pattern[str]:
    """All that a language does not say; what can match nothing where it has no such list."""
    return re.compile("|".join(TERMS_OF.get(language, {}).values()) or "(?!)")


@cache
def typed() -> frozenset[str]:
    """Keys, kinds, choices and built-in scenes: they are the same in every language."""
    return frozenset(names_typed())


@FILES
def test_translations_are_sound(file: Path) -> None:
    """Said once, whole, with the same fields and signs, and in one term for one thing."""
    bad, language = {}, file.parts[-3]
    for one in texts_of(file):
        ids, told = pieces(one)
        for number, text in enumerate(told):
            english = ids[min(number, len(ids) - 1)]
            if found := faults(english, text, language):
                bad[text] = found
            # abbreviations of title blocks and lists end in a point
            if not one.context and not ends_alike(english, text):
                bad[text] = ["another sign at the end"]
    assert bad == {}


@FILES
def test_a_readme_has_the_terms_of_its_catalogue(file: Path) -> None:
    """What a user reads first names a thing as every report after it does."""
    readme = ROOT / f"README.{file.parts[-3]}.md"
    if not readme.is_file():
        pytest.skip("no source tree")
    assert rivals(file.parts[-3]).findall(readme.read_text("utf-8").lower()) == []


@FILES
def test_titles_and_notes_of_scenes_have_the_terms_of_their_catalogue(file: Path) -> None:
    """They stand in the scenes themselves: a coupon called a backlash as no report does."""
    language = file.parts[-3]
    texts = {scene: scene.read_text("utf-8").lower() for scene in sorted(SCENE_FOLDER.glob("*.toml"))}
    assert sum(f"\n{language} = " in text or f" {language} = " in text for text in texts.values()) > 20
    assert {scene.stem: found for scene, text in texts.items() if (found := rivals(language).findall(text))} == {}


@pytest.mark.parametrize(
    ("english", "told"),
    [
        ("is missing; give it", "відсутнє; задайте йоговідсутнє; задайте його"),
        ("{a} and {b}", "{a} і {a} та {b}"),
        ("the tooth is pointed", "зуб  загострений"),
        ("the tooth is a point", "зуб - це вістря"),
        ("the wall is thin", "стінка is тонка is thin"),
        ("gear ratio", "передатне відношення"),
        ("which tooth", "который зуб"),
        ("keys of ``cam``", "ключі ``cam``"),
    ],
)
def test_an_unsound_translation_would_be_noticed(english: str, told: str) -> None:
    """Negative controls: each fault alone, and a sound text that has none."""
    assert len(faults(english, told, "uk")) == 1
    assert (
        faults(
            "{a} to {b}: remove face_width, `of` or bore", "від {a} до {b} — приберіть face_width, `of` або bore", "uk"
        )
        == []
    )
    assert not ends_alike("give it.", "задайте")


@FILES
def test_numbers_of_texts_have_points_as_those_beside_them_do(file: Path) -> None:
    """Pages and terminals print points; drawings turn all of theirs into commas."""
    mixed = []
    for one in texts_of(file):
        ids, told = pieces(one)
        points = {n.replace(".", ",") for text in ids for n in re.findall(r"\d+\.\d+", text)}
        mixed += [text for text in told if points & set(re.findall(r"\d+,\d+", text))]
    assert not mixed


def test_degrees_after_a_number_that_no_plural_counts_are_short_in_ukrainian() -> None:
    """A number of any size has one form only in ``град``: ``359.282 градусів`` was told of a wall."""
    (file,) = (f for f in catalogue_files() if f.parts[-3] == "uk")
    one = [str(m.string) for m in texts_of(file) if not m.pluralizable]
    assert [text for text in one if re.search(r"\} градус", text)] == []


def test_the_reference_diameter_has_one_name_in_ukrainian() -> None:
    """That of GOST 2.403, in tables of drawings and on pages."""
    (file,) = (f for f in catalogue_files() if f.parts[-3] == "uk")
    named = [str(m.string) for m in texts_of(file) if str(m.id).startswith("reference diameter")]
    assert len(named) > 4
    assert {" ".join(text.split()[:2]) for text in named} == {"ділильний діаметр"}


def test_what_is_told_of_several_at_once_has_no_verb_of_one_in_ukrainian() -> None:
    """``Кривошип 1 ... Кривошип 3 повертається`` was told of three: a row of instances is told as one is."""
    (file,) = (f for f in catalogue_files() if f.parts[-3] == "uk")
    told = {str(m.id): str(m.string) for m in texts_of(file) if not m.pluralizable}
    rows = [told[checks.MATES[kind]] for kind in ("fixed", "coaxial", "carried", "parallel", "pin_seat")]
    assert [
        text for text in rows if re.search(r"(?:ть|є)(?:ся)?\b.*\{second\}|\{second\} \w+(?:ть|є)(?:ся)?\b", text)
    ] == []


@FILES
def test_plurals_have_all_forms(file: Path) -> None:
    catalogue = read(file)
    plurals = [m for m in catalogue if m.pluralizable]
    assert len(plurals) > 5
    assert all(len(m.string) == catalogue.num_plurals for m in plurals)
    # Babel writes two forms in silence where the head names no language and no rule
    assert catalogue.num_plurals >= 2
    head = file.read_text("utf-8").partition("\n\n")[0]
    assert f'"Language: {file.parts[-3]}\\n"' in head
    assert "Plural-Forms: nplurals=" in head


def sample(name: str, spec: str) -> Any:
    """What may stand in a placeholder."""
    return "x" if not spec else 1.5 if spec[-1] in "fg" else 3


def numbers_of(text: str) -> dict[str, Any]:
    """Numbers for each placeholder; {inner[0]} asks for a list."""
    found = {}
    for name, spec, _ in placeholders(text):
        if name != "%":
            found[name.partition("[")[0]] = [1.5, 2.5] if "[" in name else sample(name, spec)
    return found


def told(one: Message, language: str) -> Iterator[str]:
    """A message taken through a language as the product takes it."""
    ids, _ = pieces(one)
    if "{ " in ids[0]:
        yield words(language).text(ids[0])
    elif len(ids) == 2:
        for count in (1, 2, 5, 11, 21, 112, 1.5):
            numbers = {k: count if v != "x" else v for k, v in numbers_of(ids[0]).items()}
            yield words(language).plural(*ids, count, **numbers)
    elif one.context:
        yield words(language).term(one.context, ids[0], **numbers_of(ids[0]))
    else:
        yield words(language).text(ids[0], **numbers_of(ids[0]))


@FILES
def test_every_message_is_told_with_numbers(file: Path) -> None:
    language = file.parts[-3]
    same = []
    for one in texts_of(file):
        for text in told(one, language):
            assert not placeholders(text) or "{ " in pieces(one)[0][0] or "%" in text, text
            if text in list(told(one, "en")):
                same.append(text)
    # units, symbols and patterns without a word
    assert len(same) < 40
    assert [text for text in same if len(re.findall("[a-z]{3,}", text)) > 2] == []


def test_a_text_without_translation_would_be_noticed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Negative controls: a new mark in the code; a lost form; a doubtful translation; other placeholders."""
    package = tmp_path / "parts"
    package.mkdir()
    (package / "__init__.py").write_text("", "utf-8")
    code = 'title = N_("nobody has translated this")\npage.say(message("{n} of it", n=1), words.term("unit", "ell"))\n'
    (package / "new.py").write_text(code + 'counted("{n} ell", "{n} ells", by="n")\nN_(title)\n', "utf-8")
    monkeypatch.setattr(catalogues, "_PACKAGES", (package,))
    monkeypatch.setattr(catalogues, "_kept_in_data", lambda: iter(()))
    made = extracted()
    assert made == {(None, "nobody has translated this"): "", (None, "{n} of it"): "", ("unit", "ell"): "",
                    (None, "{n} ell"): "{n} ells"}  # fmt: skip
    file = tmp_path / "higherpair.po"
    head = (LOCALE / "uk" / "LC_MESSAGES" / "higherpair.po").read_text("utf-8").partition("\n\n")[0]
    file.write_text(head + "\n\n", "utf-8")
    file.write_text(updated(file, made), "utf-8")
    assert len(untranslated(file)) == 4
    forms = "".join(f'msgstr[{k}] "{k}"\n' for k in range(3))
    file.write_text(file.read_text("utf-8").replace('msgstr[0] ""\nmsgstr[1] ""\nmsgstr[2] ""\n', forms), "utf-8")
    text = file.read_text("utf-8").replace('"ell"\nmsgstr ""', '"ell"\nmsgstr "лікоть"')
    file.write_text(
        text.replace('msgid "{n} of it"\nmsgstr ""', '#, fuzzy\nmsgid "{n} of it"\nmsgstr "{m} з нього"'), "utf-8"
    )
    assert sorted(untranslated(file)) == sorted(
        ["nobody has translated this", "{n} of it", str(("{n} ell", "{n} ells"))]
    )
    assert placeholders("{n} of it") != placeholders("{m} з нього")
    assert placeholders("{n:.4f}") != placeholders("{n:.3f}")
    assert placeholders("expected %s") != placeholders("потрібно")


def cyrillic_in(source: str) -> list[int]:
    """Lines of code with a Cyrillic letter."""
    return [n for n, line in enumerate(source.splitlines(), 1) if CYRILLIC.search(line)]


def test_ukrainian_stands_in_the_catalogue_and_not_in_the_code() -> None:
    found = {}
    for place, file in product_files().items():
        if lines := cyrillic_in(file.read_text("utf-8")):
            found[place] = lines
    assert {place: lines for place, lines in found.items() if place not in CYRILLIC_PLACES} == {}
    assert sorted(CYRILLIC_PLACES) == sorted(set(CYRILLIC_PLACES) & set(found)), "a place that needs no leave"
    # in terms only symbols: no word of two letters but an index
    for line in (HOUSE / "parts/pages/terms.psv").read_text("utf-8").splitlines():
        if CYRILLIC.search(line):
            name, key, symbol, unit, english, *_ = line.split("|")
            assert not CYRILLIC.search(name + key + unit + english)
            assert len(symbol) < 12
    for index, english in rows_of(str(HOUSE / "parts/pages/symbols.py"), "indices"):
        assert not CYRILLIC.search(english)
        assert len(index) < 8
    # and materials and units stand as users write them in scenes of any language
    own = ("terms.psv", "densities.psv", "indices.psv", "units.psv")
    tables = [file for file in (HOUSE / "parts").rglob("*.psv") if file.name not in own]
    assert not any(CYRILLIC.search(file.read_text("utf-8")) for file in tables)
    assert cyrillic_in('a = "ok"\nb = "ні"') == [2]


def test_argparse_says_nothing_of_its_own() -> None:
    """What this Python's argparse may tell a user of ours stands in the catalogue."""
    import argparse
    import inspect

    developers = ("conflict", "__call__", "required", "mutually", "callable", "merge", "must start", "dest=", "parser",
                  "deprecated", 'argument "-"', "%(prog)s", "can't open", "unexpected option", "(default",
                  "subcommands", "%(heading)s")  # fmt: skip
    calls = [c for c in ast.walk(ast.parse(inspect.getsource(argparse))) if isinstance(c, ast.Call)]
    said = [a.value for c in calls if isinstance(c.func, ast.Name) and c.func.id in ("_", "ngettext") for a in c.args
            if isinstance(a, ast.Constant)]  # fmt: skip
    assert len(said) > 20
    known = {word for (_, one), many in marked().items() for word in (one, many)}
    left = [text for text in said if text not in known and not any(word in text for word in developers)]
    assert left == []


def test_the_archives_carry_the_catalogues(tmp_path: Path) -> None:
    """By the build of setuptools itself; skipped where there is no source tree or no build."""
    if not (ROOT / "pyproject.toml").is_file():
        pytest.skip("no source tree")
    data = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["setuptools"]["package-data"]["parts"]
    for language in (p.name for p in LOCALE.iterdir()):
        for ending in ("po", "mo"):
            place = Path(f"locale/{language}/LC_MESSAGES/higherpair.{ending}")
            assert any(place.match(pattern) for pattern in data), place
    pytest.importorskip("setuptools", "77")
    tree = tmp_path / "tree"
    for file in (*ROOT.glob("*.toml"), ROOT / "README.md", ROOT / "LICENSE"):
        (tree / file.name).parent.mkdir(exist_ok=True)
        (tree / file.name).write_bytes(file.read_bytes())
    for package in ("parts", "exporters", "geometry"):
        for file in (ROOT / package).rglob("*"):
            if file.suffix in (".po", ".mo", ".psv") or file.name in ("__init__.py", "py.typed"):
                goal = tree / file.relative_to(ROOT)
                goal.parent.mkdir(parents=True, exist_ok=True)
                goal.write_bytes(file.read_bytes())
    code = f"from setuptools import build_meta as b; b.build_wheel({str(tmp_path)!r}); b.build_sdist({str(tmp_path)!r})"
    done = subprocess.run([sys.executable, "-c", code], cwd=tree, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    (wheel,), (archive,) = list(tmp_path.glob("*.whl")), list(tmp_path.glob("*.tar.gz"))
    with tarfile.open(archive) as packed:
        names = [*zipfile.ZipFile(wheel).namelist(), *packed.getnames()]
    for ending in ("po", "mo"):
        assert sum(name.endswith(f"parts/locale/uk/LC_MESSAGES/higherpair.{ending}") for name in names) == 2
    for table in (file for package in ("parts", "exporters") for file in (HOUSE / package).rglob("*.psv")):
        assert sum(name.endswith(f"/{table.relative_to(HOUSE)}") or name == str(table.relative_to(HOUSE))
                   for name in names) == 2  # fmt: skip
    # the types of all three packages hold for whoever imports them (PEP 561)
    for package in ("parts", "exporters", "geometry"):
        assert sum(name.endswith(f"{package}/py.typed") for name in names) == 2


def test_tomllib_says_nothing_of_its_own() -> None:
    """What this Python's tomllib may tell of a scene stands in the catalogue."""
    import inspect
    from tomllib import _parser

    calls = [c for c in ast.walk(ast.parse(inspect.getsource(_parser))) if isinstance(c, ast.Call)]
    raised = [
        c.args for c in calls if isinstance(c.func, ast.Name) and c.func.id in ("suffixed_err", "TOMLDecodeError")
    ]
    # Python 3.14 gives the text and its place behind the words
    told = [next((a for a in args if isinstance(a, ast.Constant | ast.JoinedStr)), args[-1]) for args in raised]
    pieces = [t.values if isinstance(t, ast.JoinedStr) else [t] for t in told]
    said = {"".join(v.value if isinstance(v, ast.Constant) else "{what}" for v in row) for row in pieces}
    assert len(said) > 15
    assert {text for text in said if text[0].isupper()} <= {word for _, word in marked()}
