"""Refusals of scenes that speak Ukrainian: in that language too, with the same key, value and number that works."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from exporters.cli import main
from exporters.words_errors import in_ukrainian, language_of, piece_in_ukrainian
from exporters.words_errors_parts import CAMS, GEARS

ROOT = Path(__file__).parents[2]
# what makes scenes and gears, whose refusals the table was written for
COVERED = [
    *ROOT.glob("geometry/gears/*.py"), *(ROOT / "geometry" / f"{n}.py" for n in ("wheel", "bores", "hub_holes")),
    *(ROOT / "parts" / f"{n}.py" for n in ("schema", "scene", "spur_gear", "ring_gear", "rack", "mates", "instances",
                                           "placing", "cutter_keys", "hole_keys", "helix_keys")),
]  # fmt: skip
CALLS = {"ParameterError", "SceneError", "UndercutError", "PointedTipError", "OffsetError"}
NAMES = {"text", "remedy", "reason", "why"}


def rendered(node: ast.expr) -> str | None:
    """A text of the source with 7 for every value in it."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.JoinedStr):
        parts = (
            v.value if isinstance(v, ast.Constant) else "" if "near(" in ast.unparse(v) else "7" for v in node.values
        )
        return "".join(map(str, parts))
    return None


def pieces(file: Path) -> Iterator[str]:
    """All pieces of refusals in a file."""
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        found: list[ast.expr] = []
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in CALLS:
            found = node.args[3:4] if node.func.id == "SceneError" else node.args[2:3]
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name) and node.targets[0].id in NAMES:
            found = [node.value]
        for text in filter(None, map(rendered, found)):
            yield from (p for p in text.split("; ") if re.search("[a-z]{3}", p))


def test_nine_of_ten_pieces_of_gear_refusals_are_in_the_table() -> None:
    found = {piece: piece_in_ukrainian(piece) for file in COVERED for piece in pieces(file)}
    assert len(found) > 120
    missing = [piece for piece, made in found.items() if made is None]
    assert len(missing) <= 0.1 * len(found), missing


def test_every_pattern_is_english_on_one_side_and_ukrainian_on_the_other() -> None:
    lines = [line for text in (GEARS, CAMS) for line in text.strip().splitlines()]
    assert len(lines) > 180
    for line in lines:
        en, _, uk = line.partition("|")
        assert en.isascii(), line
        assert re.search("[а-яіїєґ]", uk), line
        assert not re.search("[ыэъё]", uk), line
        assert en.count("{}") == uk.count("{}"), line


GEAR = "[scene]\nlanguage = 'uk'\n[parts.a]\nkind = 'spur_gear'\n{}[[exports]]\nformat = 'svg'\n"
SIZE = "module = 2.0\nnumber_of_teeth = 20\n"
WRONG = {
    "unknown key": ("modul = 2.0\nnumber_of_teeth = 20\n", "parts.a.modul = 2.0: невідомий ключ (можливо, module?)"),
    "missing": ("number_of_teeth = 20\n", "parts.a.module: відсутнє"),
    "range": ("module = 0.0\nnumber_of_teeth = 20\n", "щонайменше 0.01, щонайбільше 1000 мм"),
    "not a number": ("module = 'two'\nnumber_of_teeth = 20\n", "має бути числом"),
    "not whole": ("module = 2.0\nnumber_of_teeth = 20.5\n", "має бути цілим числом"),
    "infinite": ("module = inf\nnumber_of_teeth = 20\n", "має бути скінченним числом, меншим за 1e308"),
    "tip": (SIZE + "tip_chamfer = 3.0\n", "parts.a.tip_chamfer = 3.0: обидві фаски зуба перекрились би"),
    "cutter": (SIZE + "cutter = { number_of_teeth = 3 }\n",
               "cutter.addendum_coefficient: зуб довбача загострюється нижче за коло вершин; підходить щонайменше 14"),
    "rack": (SIZE + "basic_rack = { addendum_coefficient = 3.0 }\n", "зуб рейки загострюється до лінії вершин"),
    "not TOML": ("module = \n", "не є TOML"),
    "unknown word": (SIZE + "basic_rack = 'ISO 53 E'\n", "одне з"),
}  # fmt: skip


@pytest.mark.parametrize(("keys", "words"), WRONG.values(), ids=WRONG.keys())
def test_a_ukrainian_scene_is_refused_in_ukrainian(
    keys: str, words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "s.toml"
    file.write_text(GEAR.format(keys), encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path)]) == 2
    line = capsys.readouterr().err
    assert line.count("\n") == 1
    assert words in line
    file.write_text(GEAR.format(keys).replace("'uk'", "'en'"), encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path)]) == 2
    english = capsys.readouterr().err
    assert not re.search("[а-яіїєґ]", english)
    # every number of the English line stands in the Ukrainian one too
    assert set(re.findall(r"\d+\.\d+", english)) <= set(re.findall(r"\d+\.\d+", line))


def test_calc_speaks_the_language_that_was_asked_for(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["calc", "gear-pair", "module=2", "first.number_of_teeth=17", "second.number_of_teeth=23"]
    assert main([*words, "working_centre_distance=30", "--language", "uk"]) == 2
    line = capsys.readouterr().err
    assert "кута зачеплення не існує" in line
    assert "підходить щонайменше 37.587705 мм" in line


def test_offers_and_unknown_pieces() -> None:
    assert in_ukrainian("leaves no tip; at most 1.5 mm works") == "не лишає вершини; підходить щонайбільше 1.5 мм"
    assert in_ukrainian("what no table holds; 20 works") == "what no table holds; підходить 20"
    told = in_ukrainian("leaves no flank; with no cutter, tip_chamfer = 0 it works")
    assert told == "не лишає профілю; підходить так: без cutter, tip_chamfer = 0"
    assert piece_in_ukrainian("quite another sentence") is None


def test_the_language_of_a_broken_scene_is_still_read(tmp_path: Path) -> None:
    broken = tmp_path / "b.toml"
    broken.write_text('[scene]\nlanguage = "uk"\n[parts.a\n', encoding="utf-8")
    assert language_of(str(broken)) == "uk"
    assert language_of(str(tmp_path / "none.toml")) == "en"
    assert language_of("practicum_pair") in ("en", "uk")
    assert language_of("") == "en"
