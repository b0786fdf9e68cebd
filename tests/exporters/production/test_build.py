"""Builds as a whole: reports, merging, same bytes, nothing half-written, nothing imported in vain."""

from __future__ import annotations

import hashlib
import json
import math
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from exporters.production.build import build, steps
from exporters.production.plan import plan_build
from exporters.verification import judge
from exporters.verification.verdict import Verdict
from geometry.base.findings import Finding
from parts.scene.formats import FileKind
from parts.scene.load import load_scene
from tests.exporters.making import part_keys, read_report, run, write_scene
from tests.exporters.outside import Gear

GEAR, OTHER = Gear(2, 23, bore=8), Gear(2, 12, 0.3, bore=6)
ALL = ({"format": "dxf"}, {"format": "svg"}, {"format": "stl"})
STOPS = [OSError(28, "No space left on device"), KeyboardInterrupt()]
MOMENTS = [("a.svg", signal.SIGINT), ("a.dxf", signal.SIGTERM), ("a.*.stl", signal.SIGTERM)]
FILE_KEYS = {"path", "format", "part", "tolerance", "max_error", "bound", "entities", "bytes", "sha256", "findings"}


def pair(folder: Path, *exports: dict[str, Any], head: str = "") -> Path:
    """A scene of two gears, a and b."""
    return write_scene(folder / "s.toml", {"a": part_keys(GEAR), "b": part_keys(OTHER)}, exports or ALL, head)


def contents(folder: Path) -> dict[str, bytes]:
    """Every file below a folder, the report without what is volatile."""
    found = {}
    for path in sorted(p for p in folder.rglob("*") if p.is_file()):
        data = path.read_bytes()
        if path.name == "report.json":
            report = json.loads(data)
            assert report.pop("run")
            data = json.dumps(report).encode()
        found[str(path.relative_to(folder))] = data
    return found


def command(*arguments: object, cwd: Path, **more: Any) -> subprocess.CompletedProcess[str]:
    """The command in a process of its own."""
    return subprocess.run([sys.executable, "-m", "exporters", *map(str, arguments)], cwd=cwd, text=True,
                          capture_output=True, timeout=120, encoding="utf-8", check=False, **more)  # fmt: skip


def test_a_bar_moves_on_by_checks_shapes_files_and_pictures(tmp_path: Path) -> None:
    """An assembly is one file, but a shape for each of its parts."""
    scene = pair(tmp_path, {"format": "3mf", "assembly": True})
    plan, told = plan_build(load_scene(scene), str(scene), [], []), list[str]()
    build(plan, tmp_path / "o", verify=False, progress=told.append)
    assert told == ["s", "a", "b", "s.3mf", "s"]
    assert len(told) == steps(plan)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("language", "word"), [("en", "the tip of the basic rack"), ("uk", "вершину вихідного контуру")]
)
def test_a_standard_racks_rounding_that_does_not_fit_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], language: str, word: str
) -> None:
    """ISO 53 is for 20 degrees; elsewhere c / (1 - sin alpha) keeps the mate's tip off the fillet."""
    gear = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 30, "pressure_angle_deg": 14.5}
    parts = {
        "a": gear, "b": gear | {"helix_angle_deg": 25.0}, "c": gear | {"kind": "rack"},
        "none": gear | {"basic_rack": "ISO 53 C"} | {"pressure_angle_deg": 20.0},
    }  # fmt: skip
    scene = write_scene(tmp_path / "s.toml", parts, [{"format": "svg"}])
    assert run("build", scene, "--out", tmp_path / "out", "--language", language) == 0
    told = [line for line in capsys.readouterr().out.splitlines() if word in line]
    # what is told of several parts is told once
    assert len(told) == 1
    least = f"{0.25 / (1 - math.sin(math.radians(14.5))):.4f}"
    assert "a, b, c:" in told[0]
    assert least in told[0]
    report = read_report(tmp_path / "out" / "s")["parts"]
    codes = {name: [f["code"] for f in part["findings"]] for name, part in report.items()}
    assert all(("rack_rounding_reduced" in found) == (name != "none") for name, found in codes.items()), codes


def test_the_report_has_the_keys_of_the_design(tmp_path: Path) -> None:
    start = time.perf_counter()
    assert run("build", pair(tmp_path), "--out", tmp_path / "out") == 0
    report = read_report(tmp_path / "out" / "s")
    assert {"files", "checks", "left_out", "scene", "versions", "run"} <= set(report)
    assert [e["path"] for e in report["files"]] == ["a.dxf", "b.dxf", "a.svg", "b.svg", "a.stl", "b.stl"]
    for entry in report["files"]:
        assert set(entry) >= FILE_KEYS
        data = (tmp_path / "out" / "s" / entry["path"]).read_bytes()
        assert entry["bytes"] == len(data)
        assert entry["sha256"] == hashlib.sha256(data).hexdigest()
        assert 0 < entry["max_error"] <= entry["tolerance"]
        assert entry["measured"]["max_deviation"] <= entry["max_error"]
        assert entry["bound"] in ("exact", "certified", "sampled")
    assert 0 < report["run"]["seconds"] < time.perf_counter() - start
    assert {"higherpair", "python", "numpy"} <= set(report["versions"])
    assert report["scene"]["parts"]["a"]["pressure_angle_deg"] == 20


def test_only_what_was_asked_for_lies_in_the_folder(tmp_path: Path) -> None:
    run("build", pair(tmp_path), "--out", tmp_path / "out")
    names = {p.name for p in (tmp_path / "out" / "s").iterdir()}
    files = {f"{p}.{e}" for p in "ab" for e in ("dxf", "svg", "stl", "preview.svg")}
    assert names == files | {"report.json", "s.preview.svg"}
    assert {p.name for p in tmp_path.iterdir()} == {"s.toml", "out"}


def test_part_and_format_leave_the_rest_out_and_say_so(tmp_path: Path) -> None:
    assert run("build", pair(tmp_path), "--out", tmp_path / "o", "--part", "b", "--format", "stl") == 0
    folder = tmp_path / "o" / "s"
    assert {p.name for p in folder.iterdir()} == {"b.stl", "b.preview.svg", "report.json"}
    left_out = {e["what"]: e["why"] for e in read_report(folder)["left_out"]}
    assert set(left_out) == {"exports[1]", "exports[2]", "parts.a"}
    assert all(left_out.values())


def test_a_format_that_the_scene_does_not_name_gets_its_defaults(tmp_path: Path) -> None:
    scene = pair(tmp_path, {"format": "dxf", "tolerance": 0.02})
    assert run("build", scene, "--out", tmp_path / "o", "--format", "svg", "--part", "a") == 0
    (entry,) = read_report(tmp_path / "o" / "s")["files"]
    assert (entry["path"], entry["tolerance"]) == ("a.svg", 0.005)
    assert run("verify", tmp_path / "o" / "s" / "a.svg") == 0


def test_partial_builds_merge_into_the_report_by_path(tmp_path: Path) -> None:
    scene, folder = pair(tmp_path), tmp_path / "o" / "s"
    run("build", scene, "--out", tmp_path / "o")
    whole = contents(folder)
    before = {e["path"]: e for e in read_report(folder)["files"]}
    (folder / "a.dxf").write_bytes(b"spoiled")
    assert run("build", scene, "--out", tmp_path / "o", "--part", "a", "--format", "dxf") == 0
    report = read_report(folder)
    assert {e["path"]: e for e in report["files"]} == before
    assert len(report["files"]) == len(before)
    assert {e["path"] for e in report["previews"]} == {"a.preview.svg", "b.preview.svg", "s.preview.svg"}
    assert {k: v for k, v in contents(folder).items() if k != "report.json"} == {
        k: v for k, v in whole.items() if k != "report.json"
    }
    assert run("verify", *(folder / p for p in before)) == 0


def test_files_of_a_changed_scene_are_not_vouched_for(tmp_path: Path) -> None:
    folder = tmp_path / "o" / "s"
    run("build", pair(tmp_path), "--out", tmp_path / "o")
    text = (tmp_path / "s.toml").read_text(encoding="utf-8").replace("= 23", "= 24")
    (tmp_path / "s.toml").write_text(text, encoding="utf-8")
    run("build", tmp_path / "s.toml", "--out", tmp_path / "o", "--part", "a", "--format", "dxf")
    assert [e["path"] for e in read_report(folder)["files"]] == ["a.dxf"]
    assert run("verify", folder / "a.svg") == 2
    assert run("verify", folder / "a.dxf") == 0


# by default another process does it, as on another machine: test_same_bytes.py
@pytest.mark.heavy
def test_two_builds_give_the_same_bytes_whatever_came_between(tmp_path: Path) -> None:
    scene = pair(tmp_path, *ALL, {"format": "dxf", "dxf_version": "R12", "name": "old"}, {"format": "svg", "name": "b"})
    for name in ("first", "second"):
        assert run("build", scene, "--out", tmp_path / name, "--no-verify") == 0
        if name == "first":
            run("build", "print_gear", "practicum_pair", "--out", tmp_path / "between", "--no-verify")
    assert contents(tmp_path / "first") == contents(tmp_path / "second")


def test_a_report_does_not_depend_on_what_the_process_has_loaded(tmp_path: Path) -> None:
    """In this process ezdxf and shapely are loaded long since; a fresh one that writes an STL has no need of them."""
    environment = {**os.environ, "PYTHONHASHSEED": "2", "TZ": "Asia/Tokyo"}
    for name in ("here", "there"):
        (tmp_path / name).mkdir()
        scene = pair(tmp_path / name, {"format": "stl"})
        if name == "here":
            assert run("build", scene, "--out", tmp_path / name / "out") == 0
        else:
            assert command("build", scene, "--out", "out", cwd=tmp_path / name, env=environment).returncode == 0
    here, there = (contents(tmp_path / name / "out") for name in ("here", "there"))
    assert json.loads(here["s/report.json"]) == json.loads(there["s/report.json"])
    assert here == there
    assert not any(str(tmp_path).encode().strip(b"/") in data for data in here.values())


def failing(path: Path, kind: FileKind, *rest: Any, **more: Any) -> Verdict:
    """A read-back that finds fault with every DXF."""
    return Verdict({"max_deviation": 1.0}, ("made up",) if kind.name == "dxf" else ())


def test_a_file_that_fails_its_read_back_is_not_moved_into_place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "o" / "s"
    run("build", pair(tmp_path), "--out", tmp_path / "o")
    good = (folder / "a.dxf").read_bytes()
    (folder / "b.dxf").unlink()
    monkeypatch.setattr(judge, "verify_part", failing)
    assert run("build", tmp_path / "s.toml", "--out", tmp_path / "o") == 1
    assert "made up" in capsys.readouterr().out
    assert (folder / "a.dxf").read_bytes() == good
    assert not (folder / "b.dxf").exists()
    report = read_report(folder)
    assert [e["path"] for e in report["files"]] == ["a.svg", "b.svg", "a.stl", "b.stl"]
    assert [e["path"] for e in report["failed"]] == ["a.dxf", "b.dxf"]
    assert not list(folder.glob(".*"))


def test_no_verify_says_that_nothing_was_verified(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(judge, "verify_part", failing)
    assert run("build", pair(tmp_path), "--out", tmp_path / "o", "--no-verify") == 0
    assert all(e["verified"] is False and not e["measured"] for e in read_report(tmp_path / "o" / "s")["files"])


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", ["write_laser_dxf", "write_laser_svg", "write_stl", "save"])
@pytest.mark.parametrize("error", STOPS, ids=["full", "stop"])
def test_a_writer_that_stops_half_way_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, error: BaseException
) -> None:
    import exporters.formats.laser_dxf
    import exporters.formats.stl
    import exporters.formats.svg
    import exporters.production.preview

    def stopped(file: Path, *rest: Any, **more: Any) -> None:
        file.write_bytes(b"half")
        raise error

    owners = (exporters.production.preview, exporters.formats.laser_dxf, exporters.formats.svg, exporters.formats.stl)
    owner = next(m for m in owners if hasattr(m, name))
    monkeypatch.setattr(owner, name, stopped)
    assert run("build", pair(tmp_path), "--out", tmp_path / "new" / "o") in (2, 130)
    assert {p.name for p in tmp_path.iterdir()} == {"s.toml"}


def started(*arguments: object, cwd: Path) -> subprocess.Popen[str]:
    """The command in a process of its own, not waited for."""
    return subprocess.Popen([sys.executable, "-m", "exporters", *map(str, arguments)], cwd=cwd, text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE)  # fmt: skip


def wait_for(place: Path, pattern: str, process: subprocess.Popen[str]) -> None:
    """Until a file has appeared; a build that ends before is an error of the test."""
    end = time.monotonic() + 60
    while not list(place.rglob(pattern)):
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < end
        time.sleep(0.005)


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
@pytest.mark.sampled(1)
@pytest.mark.parametrize(("moment", "number"), MOMENTS)
def test_an_interrupted_build_leaves_nothing_behind(tmp_path: Path, number: signal.Signals, moment: str) -> None:
    big = {"kind": "spur_gear", "module": 1.0, "number_of_teeth": 3000, "bore_diameter": 20.0}
    exports = [{"format": "dxf"}, {"format": "svg"}, *({"format": "stl", "name": f"n{i}"} for i in range(3))]
    scene = write_scene(tmp_path / "s.toml", {"a": big}, exports)
    with started("build", scene, "--out", "new/out", cwd=tmp_path) as process:
        wait_for(tmp_path, moment, process)
        process.send_signal(number)
        _, complaint = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "Traceback" not in complaint
    assert len(complaint.splitlines()) == 1
    assert {p.name for p in tmp_path.iterdir()} == {"s.toml"}


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_an_interrupted_build_leaves_the_files_of_the_last_one(tmp_path: Path) -> None:
    scene = pair(tmp_path)
    run("build", scene, "--out", tmp_path / "out")
    before = contents(tmp_path / "out")
    text = scene.read_text(encoding="utf-8").replace("= 23", "= 9000")
    scene.write_text(text, encoding="utf-8")
    with started("build", scene, "--out", "out", cwd=tmp_path) as process:
        wait_for(tmp_path / "out" / "s", ".building-*/a.svg", process)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=60)
    assert process.returncode == 130
    assert contents(tmp_path / "out") == before


def test_a_stop_within_an_exec_ends_with_the_code_of_an_interrupt(tmp_path: Path) -> None:
    """Dataclasses use exec(), and Python remembers an interrupt in it till its own end, which would be by SIGINT."""
    lines = [
        "import sys",
        "from exporters.command.process import interrupted",
        "try:",
        "    exec('raise KeyboardInterrupt')",
    ]
    lines += ["except KeyboardInterrupt:", "    sys.exit(interrupted())"]
    (tmp_path / "stopped.py").write_text("\n".join(lines), encoding="utf-8")
    done = subprocess.run([sys.executable, "-m", "stopped"], cwd=tmp_path, capture_output=True, timeout=60, check=False)
    assert done.returncode == 130


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
@pytest.mark.parametrize("last", ["", "; return 0"], ids=["the last line", "a line follows"])
def test_a_stop_that_a_loading_library_passes_over_still_stops(tmp_path: Path, last: str) -> None:
    """As xml.etree does where its C half is stopped: it goes on without it, and the build ended as if nothing was."""
    careless = "import os, signal\ntry:\n    os.kill(os.getpid(), signal.SIGINT)\nexcept BaseException:\n    pass\n"
    (tmp_path / "careless.py").write_text(careless, encoding="utf-8")
    lines = ["import sys", "from exporters.command import cli", "def listed(options):", f"    import careless{last}"]
    lines += ["from exporters.command import list as asked", "asked.run = listed", "sys.exit(cli.main(['list']))"]
    (tmp_path / "stopped.py").write_text("\n".join(lines), encoding="utf-8")
    done = subprocess.run([sys.executable, "-m", "stopped"], cwd=tmp_path, capture_output=True, timeout=60, check=False)
    assert done.returncode == 130


def loaded_by(*words: object, cwd: Path) -> list[str]:
    """The modules that a command has loaded when it ends."""
    code = ("import atexit, sys; from exporters.command.cli import main; "
            "atexit.register(lambda: sys.stderr.write('|' + ' '.join(sys.modules))); main(sys.argv[1:])")  # fmt: skip
    done = subprocess.run([sys.executable, "-c", code, *map(str, words)], cwd=cwd, text=True, capture_output=True,
                          timeout=60, check=True)  # fmt: skip
    return done.stderr.rpartition("|")[2].split()


HEAVY = ("cadquery", "OCP", "trimesh", "manifold3d", "scipy", "matplotlib")


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("formats", "never"),
    [
        (["dxf", "svg", "stl"], HEAVY),
        (["dxf"], (*HEAVY, "ezdxf", "rich")),
        (["stl"], (*HEAVY, "ezdxf", "rich")),
        (["svg"], (*HEAVY, "ezdxf", "rich")),
    ],
)
def test_a_build_imports_nothing_in_vain(tmp_path: Path, formats: list[str], never: tuple[str, ...]) -> None:
    scene = pair(tmp_path, *({"format": f} for f in formats))
    loaded = {name.split(".")[0] for name in loaded_by("build", scene, "--out", tmp_path / "o", cwd=tmp_path)}
    assert {"numpy", "msgspec", "geometry"} <= loaded
    assert not loaded & set(never)


# what one plain gear has no use for: cutters and their fillets, keyways, windows, pairs, other kinds
NOT_OF_A_GEAR = ("parts.base.densities",
                 "geometry.gears.teeth.cutter", "geometry.curves.cutter_fillet", "geometry.curves.elliptic_fillet",
                 "geometry.solids.keyways", "geometry.solids.windows", "geometry.gears.pairs", "geometry.gears.mesh",
                 "geometry.cams", "geometry.laws", "geometry.kinematics", "parts.mates", "parts.cams", "parts.pins",
                 "geometry.approximation.twisted", "exporters.verification.twisted", "exporters.formats.read_assembly",
                 "exporters.production.kept", "exporters.production.preview_labels",
                 "exporters.production.check")  # fmt: skip


def test_a_flat_file_of_a_gear_loads_nothing_of_solids_but_its_keys(tmp_path: Path) -> None:
    """Its picture did, for what is turned."""
    write_scene(tmp_path / "one.toml", {"a": part_keys(GEAR)}, ALL)
    loaded = loaded_by("build", "one.toml", "--format", "dxf", cwd=tmp_path)
    solids = {name for name in loaded if name.startswith("geometry.solids.")}
    assert solids <= {f"geometry.solids.{name}" for name in ("bores", "hub_holes", "wheel")}
    assert not [name for name in loaded if name.startswith("parts.solids")]


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("words", "never"),
    [
        (["build", "one.toml", "--format", "dxf"], (*NOT_OF_A_GEAR, "geometry.solids.body", "parts.solids")),
        (["build", "one.toml", "--format", "stl"], NOT_OF_A_GEAR),
        (["list"], ("numpy", "msgspec", "geometry", "parts.keys", "parts.gears", "parts.mates.involute")),
        (["check", "one.toml"], ("exporters.formats", "exporters.production.order", "parts.scene.assembly_order")),
        (["new", "external_gear_pair"], ("numpy", "parts.gears", "geometry.solids")),
        *((["new", mate], ("numpy",)) for mate in ("bevel_pair", "worm_pair", "crossed_helical_pair")),
        (["--help"], ("numpy", "msgspec", "dataclasses", "inspect", "shutil", "math", "parts.base.reasons")),
    ],
    ids=lambda value: value[0] if isinstance(value, list) else "",
)
def test_a_command_loads_what_it_needs(tmp_path: Path, words: list[str], never: tuple[str, ...]) -> None:
    write_scene(tmp_path / "one.toml", {"a": part_keys(GEAR)}, ALL)
    loaded = loaded_by(*words, cwd=tmp_path)
    assert "exporters.command.cli" in loaded
    assert [m for m in loaded if m in never or m.startswith(tuple(f"{name}." for name in never))] == []


def test_findings_reach_the_report_in_both_languages(tmp_path: Path) -> None:
    texts = []
    for language in ("en", "uk"):
        head = f'[scene]\nlanguage = "{language}"\n\n'
        scene = write_scene(tmp_path / "s.toml", {"a": part_keys(Gear(2, 8))}, ALL[1:2], head)
        assert run("build", scene, "--out", tmp_path / language) == 0
        (entry,) = read_report(tmp_path / language / "s")["files"]
        (undercut,) = [f for f in entry["findings"] if f["code"] == "undercut"]
        # x_min = h_Ff - z sin^2(20)/2 with h_Ff = 1.25 - 0.38 (1 - sin 20)
        assert undercut["limit"] == pytest.approx(1.25 - 0.38 * (1 - 0.3420201433) - 4 * 0.3420201433**2)
        texts.append(undercut["text"])
    assert texts[0].isascii()
    assert "підрізан" in texts[1]


@pytest.mark.parametrize(("teeth", "told"), [(300, False), (340, True)])
def test_a_step_file_that_loads_slowly_elsewhere_is_told(tmp_path: Path, teeth: int, told: bool) -> None:
    scene = write_scene(tmp_path / "s.toml", {"a": part_keys(Gear(1, teeth, bore=8))}, [{"format": "step"}])
    assert run("build", scene, "--out", tmp_path / "o", "--no-verify") == 0
    text = (tmp_path / "o" / "s" / "a.step").read_text()
    (entry,) = read_report(tmp_path / "o" / "s")["files"]
    found = {f["code"]: f["value"] for f in entry["findings"]}
    # the ends and the bore are three
    faces = text.count("=ADVANCED_FACE(") - 3
    assert found.get("many_faces") == (faces if told else None)
    assert (faces > 2000) == told


def test_every_finding_has_words_in_both_languages() -> None:
    from parts.texts.findings import FINDINGS, finding_text

    for code in FINDINGS:
        english, ukrainian = (finding_text(language, Finding(code, 1.5, 2.5)) for language in ("en", "uk"))
        assert english.isascii()
        assert any("\u0400" <= c <= "\u04ff" for c in ukrainian), code
        assert "{" not in english + ukrainian
