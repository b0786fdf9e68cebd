"""What is not a file, or is larger than any of ours, is refused in one line, without being read."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from tests.exporters.making import part_keys, run, write_scene
from tests.exporters.outside import Gear

HUGE = 2_000_000_000


def told(*commands: str, cwd: Path) -> list[str]:
    """The one line that each command says within a small memory, and soon; exit code 2."""
    code = "import resource, sys\nresource.setrlimit(resource.RLIMIT_AS, (1_500_000_000,) * 2)\n"
    code += "from exporters.command.cli import main\nfor command in sys.argv[1:]:\n"
    code += "    if main(command.split()) != 2:\n        sys.exit(command)"
    done = subprocess.run([sys.executable, "-c", code, *commands], cwd=cwd, text=True, capture_output=True,
                          timeout=30, check=False)  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stderr.count("\n") == len(commands)
    return done.stderr.splitlines()


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="pipes and devices of POSIX")
def test_a_scene_that_is_no_file_or_a_huge_one(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.toml")
    with (tmp_path / "huge.toml").open("wb") as stream:
        stream.truncate(HUGE)
    commands = [f"{c} {scene}" for c in ("build", "check", "calc spur") for scene in ("/dev/zero", "pipe.toml")]
    *bounded, last = told(*commands, "build huge.toml", cwd=tmp_path)
    assert all("at most 4000000 bytes" in line for line in bounded), bounded
    assert "larger than 4000000 bytes" in last


@pytest.fixture
def built(tmp_path: Path) -> Path:
    """A folder of one gear as SVG and 3MF."""
    scene = write_scene(tmp_path / "s.toml", {"g": part_keys(Gear(2, 23))}, [{"format": "svg"}, {"format": "3mf"}])
    assert run("build", scene, "--out", tmp_path / "o", "--no-verify") == 0
    return tmp_path / "o" / "s"


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="pipes and devices of POSIX")
def test_a_file_to_verify_that_is_none_or_a_huge_one(built: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (built / "g.svg").unlink()
    os.mkfifo(built / "g.svg")
    with (built / "h.svg").open("wb") as stream:
        stream.truncate(HUGE)
    for place in ("endless", "again"):
        (built / place).mkdir()
        shutil.copy(built / "g.3mf", built / place)
    (built / "endless" / "report.json").symlink_to("/dev/zero")
    os.mkfifo(built / "again" / "report.json")
    files = ("g.svg", "h.svg", "endless/g.3mf", "again/g.3mf")
    pipe, huge, *reports = told(*(f"verify {file}" for file in files), cwd=built)
    assert "names of files" in pipe
    assert "larger than 1000000000 bytes" in huge
    assert all("report.json" in line for line in reports)


def test_a_package_that_unpacks_to_a_thousand_times_its_size(
    built: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Both in the model and beside it."""
    with zipfile.ZipFile(built / "g.3mf") as package:
        content = {name: package.read(name) for name in package.namelist()}
    for name in ("3D/3dmodel.model", "Metadata/thumbnail.png"):
        again = tmp_path / "again"
        shutil.rmtree(again, ignore_errors=True)
        shutil.copytree(built, again)
        with zipfile.ZipFile(again / "g.3mf", "w", zipfile.ZIP_DEFLATED, compresslevel=1) as package:
            for each, data in (content | {name: content.get(name, b"") + b"\n" * 20_000_000}).items():
                package.writestr(each, data)
        capsys.readouterr()
        assert run("verify", again / "g.3mf") == 1
        assert "unpacks to" in capsys.readouterr().out


@pytest.mark.parametrize("text", ["a = " + "[" * 9000 + "]" * 9000, "a = " + "{a = " * 9000 + "1" + "}" * 9000])
def test_a_scene_that_is_nested_without_end(tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str) -> None:
    (tmp_path / "s.toml").write_text(text)
    assert run("build", tmp_path / "s.toml", "--out", tmp_path) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert "nested too deeply: a scene needs three levels" in told


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="limits of POSIX")
def test_a_scene_that_took_the_square_of_its_length(tmp_path: Path) -> None:
    """Minutes each: tomllib compares the parts of a key, the language was looked for from every line on."""
    cases = {
        "table": ("[" + "a." * 250_000 + "a]", "nested too deeply"),
        "key": ("a." * 100_000 + "a = 1", "nested too deeply"),
        "within_a_line": ("x = {b = 1, " + "'a' . " * 250_000 + "a = 1}", "nested too deeply"),
        "empty_lines": ("\n" * 1_000_000 + "=", "Invalid statement"),
    }
    for name, (text, _) in cases.items():
        (tmp_path / f"{name}.toml").write_text(text)
    lines = told(*(f"check {name}.toml" for name in cases), cwd=tmp_path)
    for line, (name, (_, said)) in zip(lines, cases.items(), strict=True):
        assert f"{name}.toml" in line
        assert said in line
