"""Signals while a file is written: prompt, and nothing half-written is left."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.exporters.making import part_keys, write_scene
from tests.exporters.outside import Gear

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="signals of POSIX")
# longer than the test waits for anything
HOLD = "time.sleep(300)"


def started(folder: Path, *moments: str, out: str = "new/out", hang_up: str = "SIG_DFL") -> subprocess.Popen[str]:
    """A build of one STEP file whose writer does what ``moments`` say.

    What a hang-up does is set, for tests that run under nohup would hand on that it does nothing.
    """
    scene = write_scene(folder / "s.toml", {"g": part_keys(Gear(2, 23))}, [{"format": "step"}])
    writer = ("import os, signal, sys, time\nfrom exporters.command import cli\n"
              "from geometry.base.record import replace\n"
              "from exporters.formats.registry import REGISTRY\n"
              "def write(job, made, file):\n    file.write_text('half')\n")  # fmt: skip
    writer += "".join(f"    {moment}\n" for moment in ("(file.parent / 'begun').touch()", *moments))
    writer += f"    return {{}}\nsignal.signal(signal.SIGHUP, signal.{hang_up})\n"
    row = "REGISTRY['step'] = replace(REGISTRY['step'], write=write)"
    code = f"{writer}{row}\nsys.exit(cli.main())\n"
    return subprocess.Popen([sys.executable, "-c", code, "build", str(scene), "--out", out, "--no-verify"], cwd=folder,
                            text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)  # fmt: skip


def staging(folder: Path) -> Path:
    """The folder of the build, as soon as its writer is at work."""
    end = time.monotonic() + 60
    while not (found := list(folder.rglob(".building-*/begun"))):
        assert time.monotonic() < end
        time.sleep(0.005)
    return found[0].parent


@pytest.mark.sampled(1)
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_does_not_wait_for_the_file(tmp_path: Path, number: signal.Signals) -> None:
    with started(tmp_path, HOLD) as process:
        staging(tmp_path)
        process.send_signal(number)
        _, complaint = process.communicate(timeout=60)
    assert process.returncode == 130
    assert complaint == "higherpair: interrupted; nothing half-written is left\n"
    assert {p.name for p in tmp_path.iterdir()} == {"s.toml"}


def test_a_signal_within_a_destructor_is_not_lost(tmp_path: Path) -> None:
    """Python writes what is raised there to the terminal, and goes on."""
    dying = "type('Held', (), {'__del__': lambda held: signal.raise_signal(signal.SIGTERM)})()"
    with started(tmp_path, dying, "time.sleep(0.1)") as process:
        _, complaint = process.communicate(timeout=60)
    assert (process.returncode, complaint) == (130, "higherpair: interrupted; nothing half-written is left\n")
    assert {p.name for p in tmp_path.iterdir()} == {"s.toml"}


def test_a_hang_up_that_is_turned_off_stays_off(tmp_path: Path) -> None:
    """As under nohup."""
    with started(tmp_path, "os.kill(os.getpid(), signal.SIGHUP)", hang_up="SIG_IGN") as process:
        _, complaint = process.communicate(timeout=60)
    assert (process.returncode, complaint) == (0, "")


def test_a_signal_leaves_the_files_of_the_last_build(tmp_path: Path) -> None:
    folder = tmp_path / "out" / "s"
    folder.mkdir(parents=True)
    (folder / "g.step").write_text("whole")
    with started(tmp_path, HOLD, out="out") as process:
        staging(tmp_path)
        process.terminate()
        process.communicate(timeout=60)
    assert {p.name: p.read_text() for p in folder.iterdir()} == {"g.step": "whole"}
