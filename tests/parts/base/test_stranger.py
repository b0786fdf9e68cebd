"""A kind of part and a kind of mate from one file outside the packages: all of it works, no other file knows them."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Annotated, Any

import ezdxf
import numpy as np
import pytest
from msgspec import Meta, Struct

from exporters.command.cli import main
from parts.base import reasons, texts
from parts.base.registry import KINDS
from parts.mates.registry import MATES
from parts.outside import add_catalogue, add_kind, add_mate
from parts.pages.terms import TERMS
from parts.texts import checks, findings, quantities
from tests.catalogues import compiled

OURS = dict(TERMS)
from tests.stranger import polygon_plate as stranger  # noqa: E402

# what the stranger's page adds on import, kept out of the tests of other files
THEIRS = {name: term for name, term in TERMS.items() if name not in OURS}
for name in THEIRS:
    del TERMS[name]

SCENE = """
[scene]
language = "{language}"

[parts.base]
kind = "polygon_plate"
sides = {sides}
across_flats = 40.0
pin_diameter = {pin}
face_width = 3.0
material = "plywood 3 mm"

[parts.top]
kind = "polygon_plate"
sides = 6
across_flats = 30.0
pin_diameter = 8.0
face_width = 3.0

[[mates]]
kind = "polygon_stack"
first = "base"
second = "top"
height = {height}

[checks]
interference = true

[[exports]]
format = "dxf"
kerf = 0.2

[[exports]]
format = "dxf"
purpose = "drawing"

[[exports]]
format = "svg"

[[exports]]
format = "stl"

[[exports]]
format = "3mf"
assembly = true
name = "stack"

[[exports]]
format = "step"
"""


@pytest.fixture(autouse=True)
def known(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The stranger registers what it has, with its catalogue compiled as its own build would."""
    tables = (
        KINDS._homes,
        KINDS._loaded,
        KINDS.phrases,
        KINDS.called,
        MATES._homes,
        MATES._loaded,
        MATES.phrases,
        TERMS,
        quantities.QUANTITIES,
        findings.FINDINGS,
        checks.MATES,
        reasons._MORE,
    )
    before, catalogues = [dict(table) for table in tables], list(texts._added)
    TERMS.update(THEIRS)
    folder = tmp_path / "locale" / "uk" / "LC_MESSAGES"
    folder.mkdir(parents=True)
    (folder / "polygon.mo").write_bytes(compiled(stranger.LOCALE / "uk" / "LC_MESSAGES" / "polygon.po"))
    add_kind(stranger.POLYGON_PLATE, "Polygon")
    add_mate(stranger.POLYGON_STACK)
    add_catalogue("polygon", tmp_path / "locale")
    monkeypatch.chdir(tmp_path)
    yield
    for table, rows in zip(tables, before, strict=True):
        table.clear()
        table.update(rows)
    texts._added[:] = catalogues
    texts.words.cache_clear()


def scene(folder: Path, *, sides: int = 6, pin: float = 8.0, height: float = 3.0, language: str = "en") -> str:
    file = folder / "plates.toml"
    file.write_text(SCENE.format(sides=sides, pin=pin, height=height, language=language), encoding="utf-8")
    return str(file)


def told(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str]:
    code = main(list(words))
    seen = capsys.readouterr()
    return code, seen.out + seen.err


def test_it_is_listed_and_shown(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert all(f"  {name} " in told(capsys, "list")[1] for name in ("polygon_plate", "polygon_stack"))
    assert "Плоска пластина" in told(capsys, "list", "--language", "uk")[1]
    code, text = told(capsys, "new", "polygon_plate")
    assert code == 0
    assert "across_flats = 40.0" in text
    (tmp_path / "new.toml").write_text(text, encoding="utf-8")
    assert told(capsys, "build", "new.toml", "--format", "dxf")[0] == 0
    assert 'kind = "polygon_stack"' in told(capsys, "new", "polygon_stack")[1]


def test_every_format_is_built_verified_and_right(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    import trimesh

    code, text = told(capsys, "build", scene(tmp_path))
    assert code == 0, text
    folder = tmp_path / "out" / "plates"
    report = json.loads((folder / "report.json").read_text("utf-8"))
    assert {f["format"] for f in report["files"]} == {"dxf", "svg", "stl", "3mf", "step"}
    probed = [f for f in report["files"] if f["format"] != "3mf"]
    assert all("pin_hole" in f["measured"] for f in probed)
    # the hexagon by its own formula: s^2 sqrt(3) / 2 less the hole
    exact = 40.0**2 * math.sqrt(3) / 2 - math.pi * 16
    mesh = trimesh.load_mesh(folder / "base.stl")
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(3.0 * exact, rel=2e-3)
    hole = next(e for e in ezdxf.readfile(folder / "base.drawing.dxf").modelspace() if e.dxftype() == "CIRCLE")
    assert hole.dxf.radius == pytest.approx(4.0, abs=1e-9)
    assert told(capsys, "verify", str(folder / "base.laser.dxf"))[0] == 0
    assert (folder / "base.preview.svg").stat().st_size > 500


@pytest.mark.parametrize("share", [0.0, 0.5, 0.98])
def test_a_spoiled_file_is_caught(tmp_path: Path, share: float, capsys: pytest.CaptureFixture[str]) -> None:
    told(capsys, "build", scene(tmp_path), "--format", "dxf")
    file = tmp_path / "out" / "plates" / "base.laser.dxf"
    drawing = ezdxf.readfile(file)
    hole = min(drawing.modelspace(), key=lambda e: len(e.get_points()))
    points = hole.get_points("xyb")
    index = int(share * len(points))
    points[index] = (points[index][0] * 0.97, points[index][1] * 0.97, points[index][2])
    hole.set_points(points, "xyb")
    drawing.saveas(file)
    code, text = told(capsys, "verify", str(file))
    assert code == 1, text


def test_a_pin_that_does_not_fit_is_caught_by_the_probe() -> None:
    class Loop:
        points, size = 3.9 * np.exp(2j * np.pi * np.arange(90) / 90), 3.9

    class File:
        def section(self, z: float) -> list[Loop]:
            return [Loop()]

    found = stranger.PinFits(8.0, 1.5).run(File(), 0.0, 1e-3)  # type: ignore[arg-type]
    assert found.failures
    assert not stranger.PinFits(7.8, 1.5).run(File(), 0.0, 1e-3).failures  # type: ignore[arg-type]


@pytest.mark.parametrize(("language", "reason", "works"), [
    ("en", "the hole leaves 0.5 mm of wall", "at most 38 mm works"),
    ("uk", "отвір лишає 0.5 мм стінки", "38"),
])  # fmt: skip
def test_it_is_refused_in_both_languages(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], language: str, reason: str, works: str
) -> None:
    code, text = told(capsys, "build", scene(tmp_path, pin=39.0, language=language))
    assert code == 2
    assert "parts.base.pin_diameter = 39.0" in text
    assert reason in text
    assert works in text
    assert told(capsys, "build", scene(tmp_path, pin=38.0), "--format", "dxf")[0] == 0
    assert told(capsys, "build", scene(tmp_path, pin=38.04), "--format", "dxf")[0] == 2


def test_the_mate_places_checks_and_refuses(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, text = told(capsys, "check", scene(tmp_path))
    assert code == 0, text
    assert told(capsys, "check", scene(tmp_path, height=2.0))[0] == 1
    code, text = told(capsys, "build", scene(tmp_path, sides=5))
    assert code == 2
    assert "parts.top.sides = 6" in text
    assert "as many sides as the plate below" in text
    code, text = told(capsys, "build", scene(tmp_path, sides=5, language="uk"))
    assert "стільки ж сторін" in text


@pytest.mark.parametrize(("language", "called"), [("en", "Polygon"), ("uk", "Багатокутник")])
def test_it_is_called_by_its_name_where_it_has_no_title(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], language: str, called: str
) -> None:
    file = Path(scene(tmp_path, language=language))
    file.write_text(file.read_text("utf-8") + '\n[[exports]]\nformat = "csv"\n', encoding="utf-8")
    code, text = told(capsys, "build", str(file), "--format", "csv")
    assert code == 0, text
    (table,) = (tmp_path / "out" / "plates").glob("*.csv")
    rows = table.read_text("utf-8-sig").splitlines()
    assert sum(called in row for row in rows) == 2


def test_it_is_calculated(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, text = told(capsys, "calc", "polygon_plate", scene(tmp_path), "part=base", "--format", "json")
    assert code == 0, text
    assert '"wall": 16.0' in text
    code, text = told(
        capsys, "calc", "polygon_plate", "sides=6", "across_flats=40", "pin_diameter=8", "--language", "uk"
    )
    assert code == 0
    assert "стінка" in text


@pytest.mark.parametrize(("field", "own", "taken"), [
    ("name", "spur_gear", "spur_gear"),
    ("reasons", {"out_of_range": "b"}, "out_of_range"),
    ("findings", {"thin_rim": "a"}, "thin_rim"),
    ("quantities", {"pin_diameter": "pin"}, "pin_diameter"),
])  # fmt: skip
def test_a_name_that_is_another_ones_is_refused(
    monkeypatch: pytest.MonkeyPatch, field: str, own: object, taken: str
) -> None:
    """It would be told of built-in kinds too, or never."""
    kind = stranger.PolygonPlateKind()
    monkeypatch.setattr(kind, field, own)
    before = [dict(KINDS._homes), dict(findings.FINDINGS), dict(quantities.QUANTITIES), dict(reasons._MORE)]
    monkeypatch.setattr(kind, "name", own if field == "name" else "another_plate")
    with pytest.raises(ValueError, match=f"already: {taken}"):
        add_kind(kind)
    assert [dict(KINDS._homes), findings.FINDINGS, quantities.QUANTITIES, reasons._MORE] == before


def test_a_mate_of_a_name_that_is_another_ones_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    add_mate(stranger.POLYGON_STACK)
    other = stranger.PolygonStack()
    with pytest.raises(ValueError, match="already: polygon_stack"):
        add_mate(other)
    monkeypatch.setattr(other, "name", "fixed")
    with pytest.raises(ValueError, match="already: fixed"):
        add_mate(other)


class Wall(Struct):
    """A wall."""

    height: Annotated[float, Meta(examples=[3.0])]
    width: float


class Nameless(Struct):
    width: float = 1.0


class BareKey(stranger.PolygonPlateKeys, kw_only=True):
    """Keys with one that nothing is told of."""

    corners: Annotated[int, Meta(description="number of corners")]


class KeyOfWall(stranger.PolygonPlateKeys, kw_only=True):
    """Keys with a table that has such a key."""

    side: Wall


class KeyOfNameless(stranger.PolygonPlateKeys, kw_only=True):
    """Keys with tables that do not say what they are."""

    sides_of: list[Nameless] | None = None


class BareMate(stranger.PolygonStackKeys, kw_only=True):
    """Keys of a mate."""

    turned: float


@pytest.mark.parametrize(("add", "kind", "keys", "told"), [
    (add_kind, stranger.PolygonPlateKind, BareKey, "corners has neither default nor example"),
    (add_kind, stranger.PolygonPlateKind, KeyOfWall, "side.width has neither default nor example"),
    (add_kind, stranger.PolygonPlateKind, KeyOfNameless, "sides_of has no docstring"),
    (add_kind, stranger.PolygonPlateKind, Nameless, "the table of its keys has no docstring"),
    (add_mate, stranger.PolygonStack, BareMate, "turned has neither default nor example"),
])  # fmt: skip
def test_keys_that_new_could_not_tell_are_refused_at_once(
    monkeypatch: pytest.MonkeyPatch, add: Callable[[Any], None], kind: Any, keys: type[Struct], told: str
) -> None:
    """``new`` would end in an IndexError, or print a scene that is none: ``corners = …``."""
    bare = kind()
    monkeypatch.setattr(bare, "name", "bare")
    monkeypatch.setattr(bare, "keys", keys)
    with pytest.raises(ValueError, match=f"^kind bare: {told}$"):
        add(bare)
    assert "bare" not in KINDS
    assert "bare" not in MATES


def test_a_thin_wall_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = told(capsys, "build", scene(tmp_path, pin=37.0), "--format", "dxf")[1]
    assert "thin wall: 1.50 mm" in text
    assert "тонка стінка" in told(capsys, "build", scene(tmp_path, pin=37.0, language="uk"), "--format", "dxf")[1]


def test_no_other_file_knows_it() -> None:
    root = Path(stranger.__file__).parents[2]
    here = {Path(__file__).name, "polygon_plate.py"}
    for package in ("geometry", "parts", "exporters"):
        for file in (root / package).rglob("*.py"):
            assert file.name in here or "polygon_plate" not in file.read_text("utf-8")
