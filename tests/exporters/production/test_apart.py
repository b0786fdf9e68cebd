"""Signals, crashes and kills while the CAD kernel works: prompt, and nothing half-written is left.

The kernel is played by C calls that hold the interpreter, as its own long calls do.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from importlib.util import find_spec
from pathlib import Path

import pytest

from tests.exporters.making import part_keys, write_scene
from tests.exporters.outside import Gear

pytestmark = [
    pytest.mark.skipif(find_spec("OCP") is None, reason="the CAD kernel is an extra"),
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="a process apart is forked on Linux"),
]
# longer than the test waits for anything
HOLD = "ctypes.PyDLL(None).sleep(300)"
CRASH = "os.kill(os.getpid(), signal.SIGSEGV)"
GO_ON = "pass"


def started(folder: Path, *moments: str, out: str = "new/out", hang_up: str = "SIG_DFL") -> subprocess.Popen[str]:
    """A build of one STEP file whose writer, in the place of the kernel, does what ``moments`` say.

    What a hang-up does is set, for tests that run under nohup would hand on that it does nothing.
    """
    scene = write_scene(folder / "s.toml", {"g": part_keys(Gear(2, 23))}, [{"format": "step"}])
    writer = ("import ctypes, os, signal, sys\nfrom exporters.command import cli\n"
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


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_does_not_wait_for_the_kernel(tmp_path: Path, number: signal.Signals) -> None:
    with started(tmp_path, HOLD) as process:
        staging(tmp_path)
        process.send_signal(number)
        _, complaint = process.communicate(timeout=60)
    assert process.returncode == 130
    assert complaint == "higherpair: interrupted; nothing half-written is left\n"
    assert {p.name for p in tmp_path.iterdir()} == {"s.toml"}


def test_a_hang_up_that_is_turned_off_stays_off(tmp_path: Path) -> None:
    """As under nohup."""
    with started(tmp_path, "os.kill(os.getppid(), signal.SIGHUP)", hang_up="SIG_IGN") as process:
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


def test_a_crash_of_the_kernel_is_one_line_and_leaves_nothing(tmp_path: Path) -> None:
    with started(tmp_path, CRASH) as process:
        out, complaint = process.communicate(timeout=60)
    assert process.returncode == 1
    assert not out
    assert complaint == "higherpair: the CAD kernel has crashed (signal 11); nothing half-written is left\n"
    assert {p.name for p in tmp_path.iterdir()} == {"s.toml"}


@pytest.mark.parametrize(("moment", "code"), [(GO_ON, 0), ("raise OSError(28, 'No space left on device')", 2)])
def test_the_exit_code_is_that_of_the_work(tmp_path: Path, moment: str, code: int) -> None:
    with started(tmp_path, moment) as process:
        out, complaint = process.communicate(timeout=60)
    assert process.returncode == code
    # said once, by one of both processes
    assert (out + complaint).count("g.step" if code == 0 else "No space left") == 1


def test_the_work_does_not_outlive_its_command(tmp_path: Path) -> None:
    with started(tmp_path, HOLD) as process:
        worker = int(staging(tmp_path).name.removeprefix(".building-"))
        assert worker != process.pid
        process.kill()
        process.communicate(timeout=60)
    end = time.monotonic() + 60
    while Path(f"/proc/{worker}").exists() and "State:\tZ" not in Path(f"/proc/{worker}/status").read_text():
        assert time.monotonic() < end
        time.sleep(0.01)


def test_a_caller_in_python_keeps_its_process(tmp_path: Path) -> None:
    """Only a command of its own splits: a program or a test that calls ``main`` gets its answer itself."""
    scene = write_scene(tmp_path / "s.toml", {"g": part_keys(Gear(2, 23))}, [{"format": "step"}])
    code = ("import os, sys\nfrom exporters.command import cli\nfrom geometry.base.record import replace\n"
            "from exporters.formats.registry import REGISTRY\n"
            "def write(job, made, file):\n"
            "    return {'pid': int(file.write_text(str(os.getpid())) and os.getpid())}\n"
            "REGISTRY['step'] = replace(REGISTRY['step'], write=write)\n"
            "cli.main(sys.argv[1:])\nprint('caller', os.getpid())")  # fmt: skip
    done = subprocess.run([sys.executable, "-c", code, "build", str(scene), "--out", "o", "--no-verify"], cwd=tmp_path,
                          text=True, capture_output=True, timeout=60, check=True)  # fmt: skip
    written = (tmp_path / "o" / "s" / "g.step").read_text()
    assert done.stdout.splitlines()[-1] == f"caller {written}"
    assert int(written) != os.getpid()
