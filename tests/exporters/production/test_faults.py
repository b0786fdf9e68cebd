"""A disk that is full, slow to say so, or gone at any call: one line, exit code 2, and nothing half-written."""

from __future__ import annotations

import builtins
import io
import os
import random
import signal
import subprocess
import sys
from collections.abc import Callable
from importlib.util import find_spec
from inspect import CO_GENERATOR
from pathlib import Path
from types import FrameType
from typing import Any

import pytest
import shapely

from tests.exporters.making import part_keys, run, table, write_scene
from tests.exporters.outside import Gear

FULL = OSError(28, "No space left on device")
FORMATS = ("dxf", "svg", "stl", "3mf", "sheet") + (("step",) if find_spec("OCP") else ())
EXPORTS = [{"format": f} for f in FORMATS] + [{"format": f, "assembly": True} for f in FORMATS if f in ("3mf", "step")]
EXPORTS += [{"format": "dxf", "purpose": "drawing"}]


class Stream:
    """A file whose writing may fail."""

    def __init__(self, real: Any, step: Callable[[str], None]) -> None:
        self.real, self.step = real, step

    def write(self, data: Any) -> Any:
        self.step("write")
        return self.real.write(data)

    def __enter__(self) -> Stream:
        return self

    def __exit__(self, *error: object) -> None:
        self.real.close()

    def __getattr__(self, name: str) -> Any:
        return getattr(self.real, name)


class Disk:
    """Counts the calls of a kind, and fails at one of them."""

    def __init__(self, patch: pytest.MonkeyPatch, kind: str = "", number: int = 0) -> None:
        self.calls: dict[str, int] = {}
        self.kind, self.number = kind, number
        real_open = io.open

        def opened(file: Any, mode: str = "r", *rest: Any, **more: Any) -> Any:
            self.step("open")
            stream = real_open(file, mode, *rest, **more)
            return stream if mode.startswith("r") else Stream(stream, self.step)

        patch.setattr(io, "open", opened)
        patch.setattr(builtins, "open", opened)
        for name in ("replace", "rename", "mkdir"):
            patch.setattr(os, name, self.hooked(name, getattr(os, name)))

    def hooked(self, name: str, real: Callable[..., Any]) -> Callable[..., Any]:
        def call(*given: Any, **more: Any) -> Any:
            self.step(name)
            return real(*given, **more)

        return call

    def step(self, kind: str) -> None:
        self.calls[kind] = self.calls.get(kind, 0) + 1
        if kind == self.kind and self.calls[kind] == self.number:
            raise FULL


def scene_of(folder: Path, teeth: int) -> Path:
    """A pair in all formats."""
    parts = {"g": part_keys(Gear(2, teeth, bore=6)), "h": part_keys(Gear(2, 17))}
    mate = table("[[mates]]", {"kind": "external_gear_pair", "first": "g", "second": "h"})
    return write_scene(folder / "s.toml", parts, EXPORTS, mate)


def contents(folder: Path) -> dict[str, bytes]:
    """What lies in a folder, hidden things too."""
    return {p.name: p.read_bytes() for p in folder.iterdir()}


@pytest.mark.parametrize("every", [False, pytest.param(True, marks=pytest.mark.heavy)], ids=["some", "every"])
def test_any_call_may_fail(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], every: bool
) -> None:
    """The n-th call of each kind, one build for some n of each or for all: the old set stays as it was, to the byte."""
    folder, build = tmp_path / "o" / "s", ("build", tmp_path / "s.toml", "--out", tmp_path / "o", "--no-verify")
    scene_of(tmp_path, 12)
    counted = {}
    # what is opened once in a process is not counted
    assert run(*build) == 0
    for asked in ((), ("--format", "svg", "--part", "g")):
        with monkeypatch.context() as patch:
            disk = Disk(patch)
            assert run(*build, *asked) == 0
        counted[asked] = disk.calls
    before = contents(folder)
    faults = [(kind, n, asked) for kind, calls in disk.calls.items() for n in range(1, calls + 1)]
    # a folder that is there already need not be made
    faults.remove(("mkdir", 1, asked))
    assert {kind for kind, _, _ in faults} == {"open", "write", "replace", "rename", "mkdir"}
    draw = random.Random(7)
    if every:
        whole = counted[()].items()
        # writes go by the ten thousand
        some = {kind: draw.sample(range(1, calls + 1), min(calls, 50)) for kind, calls in whole if kind != "mkdir"}
        faults += [(kind, n, ()) for kind, numbers in some.items() for n in numbers]
    else:
        # the first call of each kind, two of the others, two of a build of all
        faults = [fault for fault in faults if fault[1] == 1] + draw.sample(faults, 2)
        faults += [(kind, draw.randint(1, counted[()][kind]), ()) for kind in ("open", "write")]
    scene_of(tmp_path, 13)
    for kind, number, asked in faults:
        capsys.readouterr()
        with monkeypatch.context() as patch:
            Disk(patch, kind, number)
            code = run(*build, *asked)
        out, error = capsys.readouterr()
        assert (code, out, error.count("\n")) == (2, "", 1), (kind, number, error)
        assert "No space left" in error
        assert contents(folder) == before, (kind, number)


@pytest.mark.skipif(sys.platform == "win32", reason="limits of POSIX")
@pytest.mark.sampled(1)
@pytest.mark.parametrize("form", [f for f in FORMATS if f != "sheet"])
def test_a_file_that_does_not_fit_on_the_disk(tmp_path: Path, form: str) -> None:
    """The system itself refuses to write on, whoever writes: lib3mf ended the process by SIGABRT."""
    import resource

    def small_disk() -> None:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (9000, 9000))

    scene = write_scene(tmp_path / "s.toml", {"g": part_keys(Gear(2, 23, bore=8))}, [{"format": form}])
    done = subprocess.run([sys.executable, "-m", "exporters", "build", str(scene), "--out", "o"], cwd=tmp_path,
                          preexec_fn=small_disk, text=True, capture_output=True, timeout=60, check=False)  # fmt: skip
    assert done.returncode == 2
    assert done.stderr.startswith("higherpair: o/s: File too large")
    assert done.stderr.count("\n") == 1
    assert {p.name for p in tmp_path.iterdir()} == {"s.toml"}


class Memory:
    """Counts the calls of the product's functions from the first one of production on; memory ends at one of them."""

    def __init__(self, number: int = 0) -> None:
        self.calls, self.number = 0, number

    def __call__(self, frame: FrameType, event: str, given: object) -> None:
        home = frame.f_globals.get("__package__") or ""
        # what ends while a generator is closed reaches nobody
        once = event == "call" and not frame.f_code.co_flags & CO_GENERATOR
        if once and home.startswith(("exporters", "parts", "geometry")):
            self.calls += bool(self.calls) or home == "exporters.production"
            if 0 < self.calls == self.number:
                sys.setprofile(None)
                raise MemoryError


@pytest.mark.parametrize("builds", [8, pytest.param(400, marks=pytest.mark.heavy)])
def test_memory_may_end_in_any_function(tmp_path: Path, capsys: pytest.CaptureFixture[str], builds: int) -> None:
    """At a call drawn by chance, once all modules are loaded: one line, and the old set to the byte, or a new one."""
    asked = ("build", tmp_path / "s.toml", "--out", tmp_path / "o", "--no-verify", "--format", "svg", "--part", "g")
    scene_of(tmp_path, 12)
    assert run(*asked) == 0

    def run_with(memory: Memory) -> int:
        sys.setprofile(memory)
        try:
            return run(*asked)
        finally:
            sys.setprofile(None)

    counted = Memory()
    assert run_with(counted) == 0
    before, draw = contents(tmp_path / "o" / "s"), random.Random(7)
    # what is cached makes later builds shorter
    for number in sorted(draw.sample(range(1, 9 * counted.calls // 10), builds)):
        capsys.readouterr()
        code = run_with(Memory(number))
        out, error = capsys.readouterr()
        assert (code, out, error.count("\n")) == (2, "", 1), (number, error)
        assert "the memory does not suffice" in error
        # what fails once all is in place leaves the new set, whole
        left = contents(tmp_path / "o" / "s")
        assert left == before or (
            left.keys() == before.keys() and run("verify", tmp_path / "o" / "s" / "g.svg") == 0
        ), number


def test_memory_that_does_not_suffice_is_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    import exporters.formats.stl

    def exhausted(*given: object) -> None:
        raise MemoryError

    monkeypatch.setattr(exporters.formats.stl, "write_stl", exhausted)
    assert run("build", scene_of(tmp_path, 12), "--out", tmp_path / "o", "--format", "stl") == 2
    assert capsys.readouterr().err == (
        "higherpair: the memory does not suffice; a larger tolerance or fewer parts need less\n"
    )
    assert not (tmp_path / "o").exists()


@pytest.mark.parametrize(
    "error",
    [ImportError("lib.so: failed to map segment", name="lib", path=shapely.lib.__file__),
     ModuleNotFoundError("No module named 'shapely'", name="shapely"), OSError(12, "Cannot allocate memory")],
    ids=["mapped", "missing", "system"],
)  # fmt: skip
def test_a_library_that_cannot_be_loaded_is_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], error: Exception
) -> None:
    """What a memory that is too small does to a shared library; numpy tells its own in a page around that."""
    import exporters.formats.stl

    def lost(*given: object) -> None:
        if isinstance(error, ImportError):
            raise ImportError("a page about numpy\n" * 9) from error
        raise error

    monkeypatch.setattr(exporters.formats.stl, "write_stl", lost)
    assert run("build", scene_of(tmp_path, 12), "--out", tmp_path / "o", "--format", "stl") == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert ("shapely cannot be loaded" in told) == isinstance(error, ImportError)
    assert "the memory does not suffice" in told
    assert not (tmp_path / "o").exists()


def test_a_fault_of_our_own_import_is_no_fault_of_the_installation(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import exporters.formats.stl

    def lost(*given: object) -> None:
        raise ImportError("cannot import name", name="exporters.formats.stl", path=exporters.formats.stl.__file__)

    monkeypatch.setattr(exporters.formats.stl, "write_stl", lost)
    with pytest.raises(ImportError):
        run("build", scene_of(tmp_path, 12), "--out", tmp_path / "o", "--format", "stl")


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="names there are Unicode")
def test_a_folder_whose_name_is_not_utf8(tmp_path: Path) -> None:
    exports = [*({"format": f} for f in FORMATS if f in ("3mf", "step")), {"format": "dxf", "purpose": "drawing"}]
    scene = write_scene(tmp_path / "s.toml", {"g": part_keys(Gear(2, 12))}, exports)
    place = os.fsencode(tmp_path) + b"/o\xff"
    assert run("build", scene, "--out", os.fsdecode(place)) == 0
    files = [p for p in Path(os.fsdecode(place + b"/s")).iterdir() if p.suffix in (".3mf", ".step", ".dxf")]
    assert len(files) == len(exports)
    assert run("verify", *files) == 0
