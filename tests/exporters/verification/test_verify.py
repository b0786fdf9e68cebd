"""Negative controls: a file is spoiled at its start, middle and end, and the read-back must catch it."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import ezdxf
import pytest

from exporters.production import recheck
from exporters.verification.judge import verify_file
from geometry.gears.teeth.offset import gear_region
from geometry.solids.body import plate
from parts.scene.formats import FILE_KINDS
from parts.scene.load import make_parts, scene_from_resolved
from tests.exporters import spoil
from tests.exporters.making import build_gear, read_report, run
from tests.exporters.outside import Gear
from tests.sampling import some_of

GEAR = Gear(2, 23, bore=8)
WIDTH = 5.0
FORMATS: dict[str, dict[str, Any]] = {
    "dxf": {"format": "dxf"},
    "r12.dxf": {"format": "dxf", "dxf_version": "R12"},
    "lines.dxf": {"format": "dxf", "curves": "lines"},
    "svg": {"format": "svg"},
    "lines.svg": {"format": "svg", "curves": "lines"},
    "stl": {"format": "stl"},
}
SHARES = {"start": 0.0, "middle": 0.5, "end": 1.0}


@pytest.fixture(scope="module")
def originals(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One folder for each format with a good file and its report."""
    root = tmp_path_factory.mktemp("originals")
    for name, export in FORMATS.items():
        (root / name).mkdir()
        build_gear(root / name, GEAR, export, face_width=WIDTH)
    return root


@cache
def region() -> Any:
    """The exact section that every file here must match."""
    from geometry.gears.teeth.basic_rack import iso_53
    from geometry.gears.teeth.spur import SpurGear

    return gear_region(SpurGear(2.0, 23, iso_53("A"), bore_diameter=8.0)).region


def exact(kind: str) -> Any:
    """What a file of a format must match: the section, or the plate of it."""
    return plate(region(), 0.0, WIDTH) if kind == "stl" else region()


def copied(originals: Path, name: str, folder: Path) -> tuple[Path, dict[str, Any]]:
    """A copy of a good file with its report; and its entry."""
    place = folder / "s"
    shutil.copytree(originals / name / "out" / "s", place)
    entry = read_report(place)["files"][0]
    return place / entry["path"], entry


def failures(file: Path, entry: dict[str, Any]) -> tuple[str, ...]:
    """What the read-back finds wrong."""
    verdict = verify_file(
        file, FILE_KINDS[entry["format"]], exact(entry["format"]), entry["max_error"], entry["tolerance"]
    )
    return verdict.failures


def check_caught(file: Path, entry: dict[str, Any], *, command: bool = True) -> None:
    """Both the function and the command must notice."""
    assert failures(file, entry)
    if command:
        assert run("verify", file) == 1


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", FORMATS)
def test_an_unspoiled_file_passes(originals: Path, tmp_path: Path, name: str, capsys: pytest.CaptureFixture) -> None:
    file, entry = copied(originals, name, tmp_path)
    assert failures(file, entry) == ()
    capsys.readouterr()
    assert run("verify", file) == 0
    assert "as reported" in capsys.readouterr().out


@pytest.mark.heavy
def test_files_of_one_report_are_held_against_parts_that_are_made_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """For each file anew they took most of the time; another report has parts of its own."""
    made = []
    monkeypatch.setattr(recheck, "make_parts", lambda scene, source: made.append(source) or make_parts(scene, source))
    assert run("build", "print_gear", "--out", tmp_path / "one", "--no-verify") == 0
    shutil.copytree(tmp_path / "one", tmp_path / "two")
    for folder in (tmp_path / "one", tmp_path / "two"):
        files = [folder / "print_gear" / entry["path"] for entry in read_report(folder / "print_gear")["files"]]
        assert len(files) > 1
        assert run("verify", *files) == 0
    assert made == [str(tmp_path / name / "print_gear" / "report.json") for name in ("one", "two")]


@pytest.mark.parametrize("name", [n for n in FORMATS if n.endswith("dxf")])
def test_a_dxf_that_was_only_saved_again_passes(originals: Path, tmp_path: Path, name: str) -> None:
    """The spoilers load and save; that alone must not be what is caught."""
    file, entry = copied(originals, name, tmp_path)
    spoil.change_dxf(file, 1, lambda rows, at: rows, 0.5)
    assert failures(file, entry) == ()


def test_what_is_wrong_is_told_in_the_language_that_is_asked_for(
    originals: Path, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    """Reports and tools read it in English."""
    file, entry = copied(originals, next(iter(FORMATS)), tmp_path)
    spoil.change_dxf(file, -1, spoil.ROW_CHANGES[0], 0.5)
    wrong = failures(file, entry)
    assert any("deviates by" in failure for failure in wrong)
    capsys.readouterr()
    assert run("verify", file, "--language", "uk") == 1
    told = capsys.readouterr().out
    assert "відхиляється від точного контуру на" in told
    assert "deviates" not in told
    assert run("verify", file, "--json") == 1
    assert json.loads(capsys.readouterr().out)["failures"] == list(wrong)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("where", SHARES)
@pytest.mark.parametrize("change", spoil.ROW_CHANGES, ids=lambda c: c.__name__)
@pytest.mark.parametrize("name", [n for n in FORMATS if n != "stl"])
def test_a_changed_vertex_is_caught(
    originals: Path, tmp_path: Path, name: str, change: Callable[..., Any], where: str
) -> None:
    file, entry = copied(originals, name, tmp_path)
    (spoil.change_svg if name.endswith("svg") else spoil.change_dxf)(file, -1, change, SHARES[where])
    check_caught(file, entry, command=where == "middle" and "lines" not in name)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("change", spoil.WHOLE_CHANGES, ids=lambda c: c.__name__)
@pytest.mark.parametrize("name", [n for n in FORMATS if n != "stl"])
def test_a_scaled_or_turned_outline_is_caught(
    originals: Path, tmp_path: Path, name: str, change: Callable[..., Any]
) -> None:
    file, entry = copied(originals, name, tmp_path)
    (spoil.change_svg if name.endswith("svg") else spoil.change_dxf)(file, -1, change, 0.5)
    check_caught(file, entry, command="lines" not in name)


@pytest.mark.parametrize("name", [n for n in FORMATS if n != "stl"])
def test_a_changed_bore_is_caught(originals: Path, tmp_path: Path, name: str) -> None:
    file, entry = copied(originals, name, tmp_path)
    change = spoil.bore_grown_svg if name.endswith("svg") else spoil.bore_grown_dxf
    change(file, 2 * entry["tolerance"])
    check_caught(file, entry)


@pytest.mark.sampled(5)
@pytest.mark.parametrize("change", spoil.DXF_CHANGES, ids=lambda c: c.__name__)
@pytest.mark.parametrize("name", ["dxf", "r12.dxf"])
def test_a_spoiled_dxf_is_caught(originals: Path, tmp_path: Path, name: str, change: Callable[..., None]) -> None:
    file, entry = copied(originals, name, tmp_path)
    drawing = ezdxf.readfile(file)
    change(drawing)
    drawing.saveas(file)
    check_caught(file, entry)


def test_a_dxf_in_another_unit_is_caught(originals: Path, tmp_path: Path) -> None:
    for unit in (0, 1, 5, 6):
        file, entry = copied(originals, "dxf", tmp_path / str(unit))
        drawing = ezdxf.readfile(file)
        drawing.header["$INSUNITS"] = unit
        drawing.saveas(file)
        check_caught(file, entry)


@pytest.mark.parametrize("change", spoil.SVG_CHANGES, ids=lambda c: c.__name__)
def test_a_spoiled_svg_is_caught(originals: Path, tmp_path: Path, change: Callable[[str], str]) -> None:
    file, entry = copied(originals, "svg", tmp_path)
    text = file.read_text(encoding="utf-8")
    changed = change(text)
    assert changed != text
    file.write_text(changed, encoding="utf-8")
    check_caught(file, entry)


@pytest.mark.sampled(14)
@pytest.mark.parametrize("where", SHARES)
@pytest.mark.parametrize("change", spoil.STL_CHANGES, ids=lambda c: c.__name__)
def test_a_spoiled_mesh_is_caught(originals: Path, tmp_path: Path, change: Callable[..., Any], where: str) -> None:
    file, entry = copied(originals, "stl", tmp_path)
    spoil.change_stl(file, change, SHARES[where], entry["tolerance"])
    check_caught(file, entry, command=where == "middle")


def test_a_mesh_that_was_only_written_again_passes(originals: Path, tmp_path: Path) -> None:
    file, entry = copied(originals, "stl", tmp_path)
    before = file.read_bytes()
    spoil.change_stl(file, lambda records, at, step: records, 0.5, 0.01)
    assert file.read_bytes() == before
    assert failures(file, entry) == ()


@pytest.mark.sampled(8)
@pytest.mark.parametrize("name", FORMATS)
@pytest.mark.parametrize("share", [0.0, 0.02, 0.5, 0.97])
def test_a_truncated_file_is_caught(originals: Path, tmp_path: Path, name: str, share: float) -> None:
    file, entry = copied(originals, name, tmp_path)
    data = file.read_bytes()
    file.write_bytes(data[: int(len(data) * share)])
    check_caught(file, entry)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", FORMATS)
def test_another_gear_under_the_same_name_is_caught(originals: Path, tmp_path: Path, name: str) -> None:
    file, entry = copied(originals, name, tmp_path)
    other = tmp_path / "other"
    other.mkdir()
    build_gear(other, Gear(2, 23, bore=8, thinning=0.03), FORMATS[name], face_width=WIDTH)
    file.write_bytes((other / "out" / "s" / file.name).read_bytes())
    check_caught(file, entry)


def test_a_declared_error_that_is_too_small_is_caught(originals: Path, tmp_path: Path) -> None:
    for name in some_of(FORMATS, 3):
        file, entry = copied(originals, name, tmp_path / name)
        verdict = verify_file(
            file, FILE_KINDS[entry["format"]], exact(entry["format"]), 0.4 * entry["max_error"], entry["tolerance"]
        )
        assert any("declared" in f for f in verdict.failures), name


def test_the_report_names_the_very_section_that_is_held_against_the_file(originals: Path) -> None:
    report = read_report(originals / "stl" / "out" / "s")
    part = make_parts(scene_from_resolved(report["scene"], "report"), "report")[0]["g"]
    assert part.body(0.0).levels() == (0.0, WIDTH)
    assert part.circles["tip_diameter"] == pytest.approx(50)
    assert part.section(0.0).region == region()
