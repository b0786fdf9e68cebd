"""A build whose file fails its read-back: the old file stays, and everybody is told what it is."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from exporters.production.kept import failure_of, kept_lines
from exporters.verification import judge
from exporters.verification.verdict import Verdict
from tests.exporters.making import part_keys, read_report, run, write_scene
from tests.exporters.outside import Gear

FAULTY = "made up"


def scene_of(folder: Path, teeth: int = 23) -> Path:
    """Two gears as DXF and SVG."""
    parts = {"a": part_keys(Gear(2, teeth)), "b": part_keys(Gear(2, 12, 0.3))}
    return write_scene(folder / "s.toml", parts, [{"format": "dxf"}, {"format": "svg"}])


def spoil(monkeypatch: pytest.MonkeyPatch, name: str = "a.dxf") -> None:
    """From now on the read-back of one file finds fault."""
    real = judge.verify_part

    def failing(file: Path, *rest: Any, **more: Any) -> Verdict:
        return Verdict({"max_deviation": 1.0}, (FAULTY,)) if file.name == name else real(file, *rest, **more)

    monkeypatch.setattr(judge, "verify_part", failing)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("teeth", "fits"), [(23, True), (24, False)])
def test_the_old_file_stays_and_the_table_and_the_report_say_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], teeth: int, fits: bool
) -> None:
    folder = tmp_path / "o" / "s"
    run("build", scene_of(tmp_path), "--out", tmp_path / "o")
    old = (folder / "a.dxf").read_bytes()
    (entry,) = [e for e in read_report(folder)["files"] if e["path"] == "a.dxf"]
    spoil(monkeypatch)
    # a second failure must not forget what the first one said
    for _ in range(2):
        capsys.readouterr()
        assert run("build", scene_of(tmp_path, teeth), "--out", tmp_path / "o") == 1
        told = [line for line in capsys.readouterr().out.splitlines() if "earlier build" in line.lower()]
        assert len(told) == 1
        assert "a.dxf" in told[0]
        assert ("does not fit" in told[0]) is not fits
        assert (folder / "a.dxf").read_bytes() == old
        report = read_report(folder)
        assert "a.dxf" not in {e["path"] for e in report["files"]}
        (failed,) = report["failed"]
        assert failed["failures"] == [FAULTY]
        assert failed["kept"] == {"bytes": len(old), "sha256": entry["sha256"], "fits_scene": fits}


def test_a_file_that_somebody_changed_is_not_said_to_fit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "o" / "s"
    run("build", scene_of(tmp_path), "--out", tmp_path / "o")
    (folder / "a.dxf").write_bytes((folder / "a.dxf").read_bytes() + b" ")
    spoil(monkeypatch)
    run("build", scene_of(tmp_path), "--out", tmp_path / "o")
    assert read_report(folder)["failed"][0]["kept"]["fits_scene"] is False


def test_nothing_is_said_where_no_old_file_lies(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    spoil(monkeypatch)
    assert run("build", scene_of(tmp_path), "--out", tmp_path / "o") == 1
    assert "earlier build" not in capsys.readouterr().out.lower()
    assert read_report(tmp_path / "o" / "s")["failed"] == [{"path": "a.dxf", "failures": [FAULTY], "kept": None}]


def test_verify_does_not_vouch_for_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "o" / "s"
    run("build", scene_of(tmp_path), "--out", tmp_path / "o")
    with monkeypatch.context() as patch:
        spoil(patch)
        run("build", scene_of(tmp_path, 24), "--out", tmp_path / "o")
    # a partial build of another file keeps the word about this one
    run("build", tmp_path / "s.toml", "--out", tmp_path / "o", "--part", "b")
    capsys.readouterr()
    assert run("verify", folder / "a.dxf") == 2
    complaint = capsys.readouterr().err
    assert "its last build failed (made up)" in complaint
    assert len(complaint.splitlines()) == 1
    assert run("verify", folder / "a.svg", folder / "b.dxf") == 0


def test_a_good_build_takes_its_place_and_the_word_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "o" / "s"
    run("build", scene_of(tmp_path), "--out", tmp_path / "o")
    with monkeypatch.context() as patch:
        spoil(patch)
        run("build", scene_of(tmp_path, 24), "--out", tmp_path / "o")
    assert run("build", tmp_path / "s.toml", "--out", tmp_path / "o", "--part", "a", "--format", "dxf") == 0
    report = read_report(folder)
    assert report["failed"] == []
    assert run("verify", folder / "a.dxf") == 0


def test_the_lines_speak_both_languages() -> None:
    report = {"failed": [{"path": "a.dxf", "failures": [], "kept": {"fits_scene": fits}} for fits in (True, False)]}
    for language, alphabet in (("en", False), ("uk", True)):
        lines = kept_lines(report, language)
        assert len(lines) == 2
        assert all(any("\u0400" <= c <= "\u04ff" for c in line) is alphabet for line in lines)
        assert all("a.dxf" in line for line in lines)
    assert kept_lines(None, "en") == []


def test_why_a_file_is_not_vouched_for() -> None:
    """All that was wrong with it, whether what lies there is of this scene; nothing of other files."""
    failed = [
        {"path": "a.dxf", "failures": ["bent", "open"], "kept": {"fits_scene": True}},
        {"path": "b.dxf", "failures": ["bent"], "kept": {"fits_scene": False}},
        {"path": "c.dxf", "failures": [], "kept": None},
        {"path": "d.dxf"},
    ]
    report = {"failed": failed}
    assert failure_of(report, "a.dxf") == ("bent; open", True)
    assert failure_of(report, "b.dxf") == ("bent", False)
    assert failure_of(report, "c.dxf") == failure_of(report, "d.dxf") == ("", False)
    assert failure_of(report, "e.dxf") is None
    assert failure_of({}, "a.dxf") is None
