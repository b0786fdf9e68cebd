"""A set of files comes into its place as one: kills, errors, two builds at once, and what is not ours stays."""

from __future__ import annotations

import hashlib
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

from tests.exporters.making import part_keys, read_report, run, table, write_scene
from tests.exporters.outside import Gear
from tests.sampling import some_of

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="kills and forks of POSIX")
OLD, NEW, LAST = 12, 13, 14
# a build that does something before its n-th step that changes a folder, in a copy of a process that has all loaded
STEPS = """
import os, signal, sys
from exporters.command.cli import main
main(["build", sys.argv[1], "--out", sys.argv[2] + "/warm"])
def apart(number, deed, scene, out):
    child = os.fork()
    if child:
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    done = 0
    def hooked(real):
        def call(*given, **more):
            nonlocal done
            done += 1
            if done == number:
                deed()
            return real(*given, **more)
        return call
    for name in ("replace", "rename", "mkdir", "unlink", "rmdir"):
        setattr(os, name, hooked(getattr(os, name)))
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    os._exit(main(["build", scene, "--out", out]))
def kill():
    os.kill(os.getpid(), signal.SIGKILL)
"""


def scene_of(folder: Path, teeth: int, *formats: str) -> Path:
    """One gear, of so many teeth, in some formats."""
    exports = [{"format": f} for f in formats or ("dxf", "svg")]
    return write_scene(folder / "s.toml", {"g": part_keys(Gear(2, teeth, bore=6))}, exports)


def whole_set(folder: Path) -> int | None:
    """The teeth that the report of a folder tells of, whose every file is the one it names; None without a report."""
    if not (folder / "report.json").exists():
        return None
    report = read_report(folder)
    for entry in (*report["files"], *report["previews"]):
        assert hashlib.sha256((folder / entry["path"]).read_bytes()).hexdigest() == entry["sha256"], entry["path"]
    return int(report["scene"]["parts"]["g"]["number_of_teeth"])


def hidden(folder: Path) -> list[str]:
    """What a build hides in its folder."""
    return sorted(p.name for p in folder.glob(".*"))


def steps(code: str, *arguments: object) -> subprocess.CompletedProcess[str]:
    """Run a program that begins with ``STEPS``."""
    return subprocess.run([sys.executable, "-c", STEPS + code, *map(str, arguments)], text=True, capture_output=True,
                          timeout=120, check=True)  # fmt: skip


def test_a_kill_at_any_step_leaves_one_whole_set_or_no_report(tmp_path: Path) -> None:
    """The next build finds its way from each, itself killed at the same step of its own."""
    scene = scene_of(tmp_path, OLD, "svg")
    run("build", scene, "--out", tmp_path / "old")
    scene_of(tmp_path, NEW, "svg")
    code = """
import shutil
scene, base = sys.argv[1:]
for number in range(1, 100):
    shutil.copytree(base + "/old", f"{base}/{number}")
    if apart(number, kill, scene, f"{base}/{number}") == 0:
        break
    if os.path.exists(f"{base}/{number}/s/.moving"):
        shutil.copytree(f"{base}/{number}", f"{base}/{number}-again")
        apart(number, kill, scene, f"{base}/{number}-again")
"""
    steps(code, scene, tmp_path)
    left = [p / "s" for p in tmp_path.iterdir() if p.name[0].isdigit()]
    assert len(left) > 20
    seen = {whole_set(folder) for folder in left}
    assert seen == {OLD, NEW, None}
    moving = [folder for folder in left if whole_set(folder) is None]
    for folder in moving:
        assert {p.name for p in folder.iterdir() if p.is_file()} <= {"g.svg", "g.preview.svg"}
    scene_of(tmp_path, LAST, "svg")
    for folder in some_of(moving, 3) + random.Random(1).sample(left, 2):
        (folder / "mine.txt").write_text("mine")
        assert run("build", scene, "--out", folder.parent) == 0
        assert whole_set(folder) == LAST
        assert not hidden(folder)
        assert (folder / "mine.txt").read_text() == "mine"


def test_a_stop_at_any_step_leaves_a_whole_set_and_nothing_hidden(tmp_path: Path) -> None:
    """Also one that comes while what was replaced is removed."""
    scene, numbers = scene_of(tmp_path, OLD, "svg"), [1, *some_of(range(2, 19), 5)]
    run("build", scene, "--out", tmp_path / "old")
    scene_of(tmp_path, NEW, "svg")
    code = f"""
import shutil
scene, base = sys.argv[1:]
for number in {numbers}:
    shutil.copytree(base + "/old", f"{{base}}/{{number}}")
    apart(number, lambda: os.kill(os.getpid(), signal.SIGTERM), scene, f"{{base}}/{{number}}")
"""
    steps(code, scene, tmp_path)
    left = [tmp_path / str(number) / "s" for number in numbers]
    assert {whole_set(folder) for folder in left} == {OLD, NEW}
    assert not [folder for folder in left if hidden(folder)]


def test_verify_tells_of_a_half_moved_set(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene, folder = scene_of(tmp_path, OLD), tmp_path / "out" / "s"
    run("build", scene, "--out", tmp_path / "out")
    scene_of(tmp_path, NEW)
    code = 'raise SystemExit(0 if apart(7, kill, sys.argv[1], sys.argv[2] + "/out") == -9 else 1)'
    steps(code, scene, tmp_path)
    assert hidden(folder) == [".moving"]
    capsys.readouterr()
    for name in ("g.dxf", "g.svg"):
        assert run("verify", folder / name) == 2
        assert "build the scene again" in capsys.readouterr().err
    # a build of some files gives the others their place, and the report their entries, back
    scene_of(tmp_path, OLD)
    assert run("build", scene, "--out", tmp_path / "out", "--format", "svg") == 0
    assert whole_set(folder) == OLD
    assert {e["path"] for e in read_report(folder)["files"]} == {"g.dxf", "g.svg"}
    assert run("verify", folder / "g.dxf", folder / "g.svg") == 0


@pytest.mark.sampled(1)
@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt()], ids=["full", "stop"])
def test_an_error_at_any_move_leaves_the_old_set(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: BaseException
) -> None:
    folder, real = tmp_path / "out" / "s", os.replace
    run("build", scene_of(tmp_path, OLD), "--out", tmp_path / "out")
    before = {p.name: p.read_bytes() for p in folder.iterdir()}
    scene = scene_of(tmp_path, NEW)
    for number in range(1, 100):
        done = 0

        def failing(source: Any, target: Any, number: int = number) -> None:
            nonlocal done
            done += 1
            if done == number:
                raise error
            real(source, target)

        with monkeypatch.context() as patch:
            patch.setattr(os, "replace", failing)
            code = run("build", scene, "--out", tmp_path / "out", "--no-verify")
        if code == 0:
            break
        assert code == (2 if isinstance(error, OSError) else 130)
        assert {p.name: p.read_bytes() for p in folder.iterdir()} == before
    assert number > 2 * len(before)
    assert whole_set(folder) == NEW


def test_two_builds_at_once_do_not_mix_their_sets(tmp_path: Path) -> None:
    """The second comes to its own moves while the first is among them."""
    first, second = tmp_path / "a" / "s.toml", tmp_path / "b" / "s.toml"
    for scene, teeth in ((first, OLD), (second, NEW)):
        scene.parent.mkdir()
        scene_of(scene.parent, teeth)
    (tmp_path / "out" / "s").mkdir(parents=True)
    code = """
import time
base = sys.argv[2]
second = os.fork()
if second == 0:
    while not os.path.exists(base + "/begun"):
        time.sleep(0.001)
    os._exit(apart(0, None, base + "/b/s.toml", base + "/out"))
def among_the_moves():
    open(base + "/begun", "w").close()
    time.sleep(0.5)
code = apart(5, among_the_moves, sys.argv[1], base + "/out")
sys.exit(code or os.waitstatus_to_exitcode(os.waitpid(second, 0)[1]))
"""
    steps(code, first, tmp_path)
    assert whole_set(tmp_path / "out" / "s") == NEW
    assert not hidden(tmp_path / "out" / "s")


@pytest.mark.parametrize("name", [".building-1", ".building-999999999", ".moving"])
def test_cleaning_follows_no_link(tmp_path: Path, name: str) -> None:
    theirs, folder = tmp_path / "theirs", tmp_path / "out" / "s"
    for place in (theirs / ".replaced", folder):
        place.mkdir(parents=True)
    for file in (theirs / "kept", theirs / ".replaced" / "g.svg"):
        file.write_text("theirs")
    (theirs / ".names").write_text('["g.svg"]')
    (folder / name).symlink_to(theirs)
    code = run("build", scene_of(tmp_path, OLD, "svg"), "--out", tmp_path / "out")
    assert code == (2 if name == ".moving" else 0)
    assert (folder / name).is_symlink()
    assert {p.read_text() for p in theirs.rglob("[!.]*") if p.is_file()} == {"theirs"}
    assert len(list(theirs.rglob("*"))) == 4


def test_a_list_of_files_names_none_outside_the_folder(tmp_path: Path) -> None:
    folder = tmp_path / "out" / "s"
    (folder / ".moving" / ".replaced").mkdir(parents=True)
    (folder / ".moving" / ".names").write_text('["../../kept", "..", "", "g.svg"]')
    (tmp_path / "kept").write_text("mine")
    assert run("build", scene_of(tmp_path, OLD, "svg"), "--out", tmp_path / "out") == 0
    assert (tmp_path / "kept").read_text() == "mine"


@pytest.mark.parametrize("names", ["[", "5", "null", '{"g.svg": 1}', "[5]", '["\\u0000"]', "[" * 100_000])
def test_a_list_of_files_that_is_none_is_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], names: str
) -> None:
    moving = tmp_path / "out" / "s" / ".moving"
    moving.mkdir(parents=True)
    (moving / ".names").write_text(names)
    assert run("build", scene_of(tmp_path, OLD, "svg"), "--out", tmp_path / "out") == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert "a damaged list of files" in told


FORMATS = ("dxf", "svg", "stl", "3mf", "sheet") + (("step",) if find_spec("OCP") else ())


def all_formats(folder: Path, teeth: int) -> Path:
    """A pair, and an assembly of it, in all formats."""
    parts = {"g": part_keys(Gear(2, teeth, bore=6)), "h": part_keys(Gear(2, 17))}
    exports = [{"format": f} for f in FORMATS] + [{"format": "3mf", "assembly": True}]
    mate = table("[[mates]]", {"kind": "external_gear_pair", "first": "g", "second": "h"})
    return write_scene(folder / "s.toml", parts, exports, mate)


@pytest.fixture(scope="module")
def old_set(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A whole set of files in all formats."""
    folder = tmp_path_factory.mktemp("old")
    assert run("build", all_formats(folder, OLD), "--out", folder / "out", "--no-verify") == 0
    return folder / "out"


@pytest.mark.heavy
@pytest.mark.parametrize("seed", range(100))
def test_a_kill_at_a_random_moment_of_all_formats(tmp_path: Path, old_set: Path, seed: int) -> None:
    """By each of the signals, the last moments more often: before, among and after the moves."""
    draw = random.Random(seed)
    folder, out = tmp_path / "out" / "s", tmp_path / "out"
    shutil.copytree(old_set, out)
    (folder / "mine.txt").write_text("mine")
    scene = all_formats(tmp_path, NEW)
    started = [sys.executable, "-m", "exporters", "build", str(scene), "--out", str(out), "--no-verify"]
    with subprocess.Popen(started, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
        end = time.monotonic() + 60
        # from one of the files of the set on, or from its being moved, for a moment
        mark = draw.choice(["g.svg", "s.3mf", "g.step", "g.preview.svg", "s.preview.svg", "report.json", ".names"])
        while process.poll() is None and not list(folder.glob(f".*/{mark}")) and time.monotonic() < end:
            time.sleep(0.0005)
        time.sleep(draw.random() ** 4 * 0.2)
        number = draw.choice([signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL, signal.SIGKILL])
        process.send_signal(number)
        _, complaint = process.communicate(timeout=60)
    assert process.returncode in (0, 130, -signal.SIGKILL)
    assert complaint in ("", "higherpair: interrupted; nothing half-written is left\n")
    if process.returncode == -signal.SIGKILL:
        # the process that works for the killed one dies with it
        time.sleep(0.3)
        assert whole_set(folder) in (OLD, NEW, None)
    else:
        assert whole_set(folder) in (OLD, NEW)
        assert not hidden(folder)
    named = ("g.svg", "g.stl", "s.3mf")
    half = ".moving" in hidden(folder)
    assert run("verify", *(folder / name for name in named if (folder / name).exists())) == (2 if half else 0)
    assert run("build", all_formats(tmp_path, LAST), "--out", out, "--no-verify", "--format", "svg") == 0
    assert whole_set(folder) == LAST
    assert not hidden(folder)
    assert (folder / "mine.txt").read_text() == "mine"
