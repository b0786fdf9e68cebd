"""The command as a process: all of its output at its end, streams that are closed, stops within an import, bars."""

from __future__ import annotations

import contextlib
import importlib.abc
import importlib.machinery
import os
import signal
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

from exporters.command.cli import main
from parts.solids.kernel import has_kernel
from tests.exporters.making import part_keys, run, write_scene
from tests.exporters.outside import Gear

# the command as an installed script calls it
RUN = [sys.executable, "-c", "import sys; from exporters.command.cli import run; sys.exit(run())"]


def test_a_process_writes_all_that_it_has_to_say_and_ends_with_its_code(tmp_path: Path) -> None:
    """Longer than a pipe holds at once, and a complaint beside it."""
    done = subprocess.run([*RUN, "schema"], capture_output=True, check=False, timeout=120)
    assert done.returncode == 0
    assert len(done.stdout) > 65_536
    assert done.stdout.rstrip().endswith(b"}")
    assert done.stderr == b""
    wrong = subprocess.run([*RUN, "build", str(tmp_path / "none.toml")], capture_output=True, check=False, timeout=120)
    assert (wrong.returncode, wrong.stdout) == (2, b"")
    assert wrong.stderr.startswith(b"higherpair: ")
    assert wrong.stderr.endswith(b"\n")


@pytest.mark.skipif(sys.platform == "win32", reason="no /dev/fd there")
def test_closed_streams_are_no_error(tmp_path: Path) -> None:
    """Without output, and without a place for complaints: the code alone tells."""
    for words, code in ((["list"], 0), (["build", str(tmp_path / "none.toml")], 2)):
        line = " ".join(f"'{word}'" for word in [*RUN, *words])
        done = subprocess.run(["/bin/sh", "-c", f"{line} >&- 2>&-"], capture_output=True, check=False, timeout=120)
        assert (done.returncode, done.stdout, done.stderr) == (code, b"", b"")


class Stopping(importlib.abc.MetaPathFinder):
    """Sends a signal to this process while a module is loaded, and notes whether all of it was."""

    def __init__(self, name: str, number: signal.Signals) -> None:
        self.name, self.number = name, number
        self.loaded = False

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> importlib.machinery.ModuleSpec | None:
        if fullname != self.name:
            return None
        stopping = self

        class Loader(importlib.abc.Loader):
            def exec_module(self, module: ModuleType) -> None:
                signal.raise_signal(stopping.number)
                module.__dict__["DENSITIES"] = {}
                stopping.loaded = True

        return importlib.machinery.ModuleSpec(fullname, Loader())


@contextlib.contextmanager
def stopped_within(name: str, number: signal.Signals) -> Iterator[Stopping]:
    kept, finder = sys.modules.pop(name), Stopping(name, number)
    sys.meta_path.insert(0, finder)
    try:
        yield finder
    finally:
        sys.meta_path.remove(finder)
        sys.modules[name] = kept


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_stop_within_an_import_waits_for_its_end(
    number: signal.Signals, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The module is whole, nothing of the list is printed, and the handlers are those of before."""
    import parts.base.densities  # noqa: F401

    # what imports it is loaded anew
    monkeypatch.delitem(sys.modules, "exporters.command.list", raising=False)
    before, traced = signal.getsignal(number), sys.gettrace()
    with stopped_within("parts.base.densities", number) as found:
        assert main(["list"]) == 130
    assert found.loaded
    assert capsys.readouterr().out == ""
    assert signal.getsignal(number) == before
    sys.settrace(traced)


def test_a_stop_between_imports_is_told_at_once(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def stop(*_: object) -> dict[str, Path]:
        signal.raise_signal(signal.SIGINT)
        raise AssertionError

    monkeypatch.setattr(importlib.import_module("exporters.command.list"), "built_in_scenes", stop)
    assert main(["list"]) == 130
    said = capsys.readouterr()
    assert (said.out, said.err.count("\n")) == ("", 1)
    assert "nothing half-written is left" in said.err


def test_a_stop_while_a_refusal_looks_for_what_works_is_told_too(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    refused = ["calc", "spur", "module=0", "number_of_teeth=23"]
    assert main(refused) == 2
    capsys.readouterr()

    def stop(*_: object) -> str:
        signal.raise_signal(signal.SIGINT)
        raise AssertionError

    monkeypatch.setattr("parts.base.refusal.sentence", stop)
    assert main(refused) == 130
    said = capsys.readouterr()
    assert (said.out, said.err.count("\n")) == ("", 1)
    assert "nothing half-written is left" in said.err


class Terminal:
    """Standard output that is a terminal."""

    def __init__(self, stream: Any) -> None:
        self.stream = stream

    def isatty(self) -> bool:
        return True

    def __getattr__(self, name: str) -> Any:
        return getattr(self.stream, name)


class Bar:
    """A bar of rich: what it is asked to show."""

    made: list[Bar]

    def __init__(self, **options: object) -> None:
        self.options, self.tasks, self.steps, self.shown = options, [], [], False
        Bar.made.append(self)

    def __enter__(self) -> Bar:
        self.shown = True
        return self

    def __exit__(self, *_: object) -> None:
        self.shown = False

    def add_task(self, name: str, total: int) -> int:
        self.tasks.append((name, total))
        return 7

    def update(self, task: int, advance: int, description: str) -> None:
        assert self.shown
        assert task == 7
        self.steps.append((advance, description))


@pytest.mark.parametrize(("more", "bars"), [([], 1), (["-q"], 0), (["--json"], 0)])
def test_a_bar_on_a_terminal_goes_on_by_each_step_to_its_end(
    more: list[str], bars: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As many steps as it was told at the beginning; it is gone when all is done."""
    Bar.made = []
    monkeypatch.setattr("rich.progress.Progress", Bar)
    monkeypatch.setattr(sys, "stdout", Terminal(sys.stdout))
    keys = part_keys(Gear(2, 12))
    scene = write_scene(tmp_path / "s.toml", {"g": keys, "h": keys}, [{"format": "svg"}, {"format": "dxf"}])
    assert run("build", scene, "--out", tmp_path, *more) == 0
    assert len(Bar.made) == bars
    for bar in Bar.made:
        ((name, total),) = bar.tasks
        assert name == "s"
        assert [advance for advance, _ in bar.steps] == [1] * total
        told = [step for _, step in bar.steps]
        assert (told[0], told[-1]) == ("s", "s")
        assert {"g.svg", "h.svg", "g.dxf", "h.dxf", "g", "h"} <= set(told)
        assert bar.options == {"transient": True}


@pytest.mark.parametrize("broken", [False, True], ids=["not installed", "does not load"])
def test_the_kernel_is_asked_for_only_where_it_is(
    broken: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Nor where a library of the system is missing, with which no wheel comes."""
    for name in [name for name in sys.modules if name.partition(".")[0] == "OCP"]:
        monkeypatch.delitem(sys.modules, name)
    if broken:
        (tmp_path / "lib" / "OCP").mkdir(parents=True)
        (tmp_path / "lib" / "OCP" / "__init__.py").write_text("raise ImportError('libGL.so.1: no such file')\n")
        monkeypatch.syspath_prepend(tmp_path / "lib")
    else:
        monkeypatch.setitem(sys.modules, "OCP", None)
    has_kernel.cache_clear()
    try:
        scene = write_scene(tmp_path / "s.toml", {"g": part_keys(Gear(2, 12))}, [{"format": "step"}])
        assert run("build", scene, "--out", tmp_path, "--verify", "kernel") == 2
        told = capsys.readouterr().err
        assert told.startswith(f'higherpair: {scene}: --verify = "kernel"')
        assert told.count("\n") == 1
        assert not (tmp_path / "s").exists()
        assert run("build", scene, "--out", tmp_path, "--verify", "reader", "-q") == 0
        assert run("verify", tmp_path / "s" / "g.step") == 0
    finally:
        has_kernel.cache_clear()


def test_an_environment_keeps_the_threads_that_it_asks_for(monkeypatch: pytest.MonkeyPatch) -> None:
    for given, kept in ((None, "1"), ("3", "3")):
        monkeypatch.delenv("OPENBLAS_NUM_THREADS", raising=False)
        if given:
            monkeypatch.setenv("OPENBLAS_NUM_THREADS", given)
        with contextlib.suppress(SystemExit):
            main(["--version"])
        assert os.environ["OPENBLAS_NUM_THREADS"] == kept


def test_output_to_a_reader_that_left_is_no_error(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is printed goes nowhere, and the code is that of a command that is done."""

    class Left(SimpleNamespace):
        def write(self, text: str) -> int:
            raise BrokenPipeError

        def flush(self) -> None:
            raise BrokenPipeError

        def isatty(self) -> bool:
            return False

    monkeypatch.setattr(sys, "stdout", Left())
    assert main(["list"]) == 0
    sys.stdout.write("nowhere")
