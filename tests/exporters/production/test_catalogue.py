"""A catalogue: every choice built as alone, refusals as rows, the same bytes whoever builds, nothing lost by a kill."""

from __future__ import annotations

import csv
import hashlib
import json
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from exporters.production import catalogue
from exporters.production.catalogue import entry_of
from exporters.production.moving import hash_of
from exporters.verification import judge
from exporters.verification.verdict import Verdict
from parts.scene.load import load_scene
from parts.scene.variants import axes_of, variants
from tests.exporters.making import part_keys, read_report, run, write_scene
from tests.exporters.outside import Gear

VARY = ("--vary", "g.number_of_teeth=7:10", "--vary", "g.module=1,2")
TABLES = ("catalogue.csv", "catalogue.json")


def scene_in(folder: Path, *formats: str) -> Path:
    """A gear with a bore that few teeth have no room for."""
    keys = part_keys(Gear(2, 23, bore=6)) | {"material": "steel"}
    return write_scene(folder / "s.toml", {"g": keys}, [{"format": f} for f in formats or ("dxf", "stl")])


def catalogued(scene: Path, out: Path, *words: str) -> list[dict[str, Any]]:
    """The entries of a catalogue that is well."""
    assert run("catalogue", scene, *VARY, "--out", out, *words) == 0
    return json.loads((out / "s" / "catalogue.json").read_text("utf-8"))


def contents(folder: Path) -> dict[str, bytes]:
    """Every file of a catalogue but the reports, which tell of seconds."""
    files = (p for p in folder.rglob("*") if p.is_file() and p.name != "report.json")
    return {str(p.relative_to(folder)): p.read_bytes() for p in files}


@pytest.fixture(scope="module")
def plain(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A catalogue made by one process."""
    folder = tmp_path_factory.mktemp("plain")
    catalogued(scene_in(folder), folder / "o")
    return folder / "o" / "s"


def test_every_choice_is_built_as_it_is_alone(plain: Path, tmp_path: Path) -> None:
    entries = json.loads((plain / "catalogue.json").read_text("utf-8"))
    assert [tuple(e["keys"].values()) for e in entries] == [(z, m) for z in range(7, 11) for m in (1, 2)]
    good = [e for e in entries if e["verdict"] == "ok"]
    refused = [e for e in entries if e["verdict"] == "refused"]
    assert len(good) + len(refused) == 8
    # d_f = (z - 2.5) m at least, undercut or not, against a bore of 6 mm
    assert {tuple(e["keys"].values()) for e in refused} == {(7, 1), (8, 1)}
    for e in refused:
        assert e["key"] == "parts.g.bore_diameter"
        assert "root circle" in e["why"]
        assert not (plain / e["folder"]).exists()
    e = good[-1]
    keys = part_keys(Gear(2, 10, bore=6)) | {"material": "steel"}
    alone = write_scene(tmp_path / "alone.toml", {"g": keys}, [{"format": "dxf"}, {"format": "stl"}])
    assert run("build", alone, "--out", tmp_path) == 0
    for file in e["files"]:
        made = (plain / e["folder"] / file["path"]).read_bytes()
        assert made == (tmp_path / "alone" / file["path"]).read_bytes()
        assert file["sha256"] == hashlib.sha256(made).hexdigest()
        assert 0 < file["deviation"] <= file["max_error"]
    told = read_report(tmp_path / "alone")["parts"]["g"]
    assert {(f["volume"], f["mass"]) for f in e["files"]} == {(told["volume"], told["mass"])}


def test_the_table_has_a_row_for_each_file_and_each_refusal(plain: Path) -> None:
    rows = list(csv.DictReader((plain / "catalogue.csv").read_text("utf-8").splitlines()))
    assert [r["verdict"] for r in rows].count("refused") == 2
    assert [r["verdict"] for r in rows].count("ok") == 12
    for row in rows:
        if row["verdict"] == "ok":
            file = plain / row["folder"] / row["file"]
            assert row["sha256"] == hashlib.sha256(file.read_bytes()).hexdigest()
            assert float(row["mass_g"]) == pytest.approx(float(row["volume_mm3"]) * 7.85e-3)
        else:
            assert row["why"].startswith("parts.g.bore_diameter: ")


def test_a_catalogue_of_refusals_alone_is_wrong_input(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene = scene_in(tmp_path)
    assert (
        run("catalogue", scene, "--vary", "g.number_of_teeth=7", "--vary", "g.module=1", "--out", tmp_path / "o") == 2
    )
    told = capsys.readouterr()
    assert "0 ok, 1 refused" in told.out
    assert told.err.count("\n") == 1
    assert "--vary = " in told.err
    assert (tmp_path / "o" / "s" / "catalogue.csv").is_file()


def test_two_processes_make_the_same_bytes(plain: Path, tmp_path: Path) -> None:
    catalogued(scene_in(tmp_path), tmp_path / "o", "--jobs", "2")
    assert contents(tmp_path / "o" / "s") == contents(plain)


def test_what_is_finished_is_kept_and_what_is_spoiled_is_made_again(plain: Path, tmp_path: Path) -> None:
    scene, made = scene_in(tmp_path), tmp_path / "o" / "s"
    entries = catalogued(scene, tmp_path / "o")
    folders = [made / e["folder"] for e in entries if e["files"]]
    (folders[0] / "g.dxf").write_bytes(b"spoiled")
    (folders[1] / "g.preview.svg").unlink()
    (folders[2] / "report.json").write_text("{}")
    before = [(f / "report.json").stat().st_ino for f in folders]
    catalogued(scene, tmp_path / "o")
    assert contents(made) == contents(plain)
    after = [(f / "report.json").stat().st_ino for f in folders]
    assert [a == b for a, b in zip(after, before, strict=True)] == [False] * 3 + [True] * 3
    # another scene is another catalogue
    write_scene(scene, {"g": part_keys(Gear(2, 23, bore=6)) | {"material": "brass"}}, [{"format": "dxf"}])
    assert all(len(e["files"]) == bool(e["files"]) for e in catalogued(scene, tmp_path / "o"))


@pytest.mark.parametrize(("change", "again"), [
    (lambda report: report["run"].update(seconds=0.0), False),
    (lambda report: report["files"][0].update(verified=False), True),
    (lambda report: report["failed"].append({"path": "x.dxf", "failures": ["bent"]}), True),
    (lambda report: report["versions"].update(higherpair="0.0.1"), True),
    (lambda report: report.pop("versions"), True),
    (lambda report: report["scene"]["parts"]["g"].update(face_width=6.0), True),
    (lambda report: report["files"][0].update(sha256="0" * 64), True),
    (lambda report: report["previews"][0].update(sha256="0" * 64), True),
    (lambda report: report["files"][0].update(path="none.dxf"), True),
], ids=["seconds", "unverified", "failed", "version", "no version", "scene", "file", "picture", "missing"])  # fmt: skip
def test_a_folder_is_kept_only_where_its_report_vouches_for_all_of_it(
    change: Callable[[dict[str, Any]], object], again: bool, tmp_path: Path
) -> None:
    scene = scene_in(tmp_path, "svg")
    (variant,) = variants(load_scene(str(scene)), axes_of(["g.number_of_teeth=23"], load_scene(str(scene))))
    task = variant, str(scene), tmp_path / "o"
    told = entry_of(*task)
    assert (told["verdict"], told["key"], told["why"]) == ("ok", None, "")
    file = tmp_path / "o" / variant.name / "report.json"
    report = json.loads(file.read_text("utf-8"))
    change(report)
    file.write_text(json.dumps(report), encoding="utf-8")
    before = file.stat().st_ino
    assert entry_of(*task)["files"] == told["files"]
    assert (file.stat().st_ino != before) is again


def test_what_failed_in_a_folder_is_told_file_by_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A row without files of its own that are good, and why; the command fails."""
    real = judge.verify_part

    def failing(file: Path, *rest: Any, **more: Any) -> Verdict:
        return Verdict({}, ("bent", "open")) if file.suffix == ".dxf" else real(file, *rest, **more)

    monkeypatch.setattr(judge, "verify_part", failing)
    scene = scene_in(tmp_path, "dxf", "svg")
    assert run("catalogue", scene, "--vary", "g.module=1,2", "--out", tmp_path / "o") == 1
    for entry in json.loads((tmp_path / "o" / "s" / "catalogue.json").read_text("utf-8")):
        assert (entry["verdict"], entry["why"]) == ("failed", "g.dxf: bent; g.dxf: open")
        assert [file["path"] for file in entry["files"]] == ["g.svg"]
    rows = list(csv.DictReader((tmp_path / "o" / "s" / "catalogue.csv").read_text("utf-8").splitlines()))
    assert [(next(iter(row.values())), row["verdict"], row["file"], row["why"]) for row in rows] == [
        (m, "failed", "g.svg", "g.dxf: bent; g.dxf: open") for m in ("1", "2")
    ]


@pytest.mark.sampled(1)
@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL there")
@pytest.mark.parametrize("jobs", ["1", "2"])
def test_a_kill_loses_nothing(plain: Path, tmp_path: Path, jobs: str) -> None:
    scene, made = scene_in(tmp_path), tmp_path / "o" / "s"
    command = [sys.executable, "-m", "exporters", "catalogue", str(scene), *VARY, "--out", str(tmp_path / "o")]
    begun = subprocess.Popen([*command, "--jobs", jobs], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    deadline = time.monotonic() + 60
    while not (found := list(made.glob("*/report.json"))) and time.monotonic() < deadline:
        time.sleep(0.002)
    begun.send_signal(signal.SIGKILL)
    begun.wait(60)
    # workers hold the pipe too: its end is theirs
    assert begun.stderr is not None
    begun.stderr.read()
    assert not (made / "catalogue.csv").exists()
    kept = {f: f.stat().st_ino for f in found}
    catalogued(scene, tmp_path / "o", "--jobs", jobs)
    assert contents(made) == contents(plain)
    assert {f: f.stat().st_ino for f in found} == kept


@pytest.mark.parametrize(("words", "told"), [
    (("--vary", "g.modul=1"), "--vary: parts.g.modul = 1: unknown key"),
    (("--vary", "g.module=3:1"), '--vary: g.module = "3:1": a range is'),
    (("--vary", "g.module=1", "--jobs", "0"), "catalogue: --jobs = 0: must be from 1 to 1024"),
    (("--vary", "g.module=1", "--jobs", "2", "--dask", "tcp://a:1"), "not allowed with argument"),
    (("--vary", "g.module=1", "--dask", "nonsense://a"), "catalogue: --dask = "),
    ((), "the following arguments are required: --vary"),
])  # fmt: skip
def test_wrong_words_are_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], words: tuple[str, ...], told: str
) -> None:
    try:
        code = run("catalogue", scene_in(tmp_path), *words, "--out", tmp_path / "o")
    except SystemExit as end:
        code = end.code
    assert code == 2
    line = capsys.readouterr().err
    assert told in line
    assert line.count("\n") == 1
    assert not (tmp_path / "o").exists()


@pytest.mark.heavy
def test_a_cluster_makes_the_same_bytes(plain: Path, tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed", reason="Dask, the extra cluster, is not installed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        catalogued(scene_in(tmp_path), tmp_path / "o", "--dask", cluster.scheduler_address)
    assert contents(tmp_path / "o" / "s") == contents(plain)


def test_a_build_is_finished_when_each_of_its_files_is_verified(tmp_path: Path) -> None:
    """One of two that is not is made again."""
    (tmp_path / "a").write_bytes(b"a")
    (tmp_path / "b").write_bytes(b"b")
    for first, second in ((True, True), (True, False), (False, True), (False, False)):
        report = {
            "scene": {"s": 1}, "versions": {"higherpair": catalogue.__version__}, "failed": [],
            "files": [{"path": "a", "sha256": hash_of(tmp_path / "a"), "verified": first},
                      {"path": "b", "sha256": hash_of(tmp_path / "b"), "verified": second}],
            "previews": [],
        }  # fmt: skip
        assert catalogue._is_finished(report, {"s": 1}, tmp_path) == (first and second)
