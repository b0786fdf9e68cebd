"""The only reasons for which a test may be skipped, each with when it holds; a run with any other one fails."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path

import pytest

from parts.solids.kernel import has_kernel


def _lacks(*modules: str) -> Callable[[], bool]:
    return lambda: any(find_spec(module) is None for module in modules)


def _no_kernel() -> bool:
    return not has_kernel()


def _here() -> bool:
    return True


# the beginning of what pytest tells
REASONS: dict[str, Callable[[], bool]] = {
    "the CAD kernel is an extra": _no_kernel,
    "needs the CAD kernel": _no_kernel,
    "Dask, the extra cluster, is not installed": _lacks("distributed"),
    "could not import 'OCP'": _no_kernel,
    "could not import 'cadquery'": _lacks("cadquery"),
    "this kernel has no such setting": has_kernel,
    "the frames are those of ezdxf": _here,
    "(pipes|signals|limits|kills).* of POSIX": lambda: not sys.platform.startswith("linux"),
    "names there are Unicode": lambda: sys.platform in ("win32", "darwin"),
    "not a git repository": lambda: not (Path(__file__).parents[1] / ".git").exists(),
    "no source tree": lambda: not (Path(__file__).parents[1] / "pyproject.toml").is_file(),
    "another choice of tests": _here,
    "this face is undercut": _here,
    "this numpy loads them anyway, or never": _here,
    "a million triangles; the heavy tests have them": _here,
}


def is_allowed(reason: str) -> bool:
    """Whether a test may be skipped on this machine for a reason, as pytest tells it."""
    told = reason.removeprefix("Skipped: ")
    return any(re.match(start, told) and holds() for start, holds in REASONS.items())


_unlisted: list[str] = []


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """Collects skips for other reasons; of all workers where there are some."""
    if report.skipped and isinstance(report.longrepr, tuple) and not is_allowed(report.longrepr[2]):
        _unlisted.append(f"{report.nodeid}: {report.longrepr[2]}")


def pytest_sessionfinish(session: pytest.Session) -> None:
    """A run with such a skip fails."""
    if _unlisted and "PYTEST_XDIST_WORKER" not in os.environ:
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Names them."""
    for line in _unlisted:
        terminalreporter.write_line(f"skipped for a reason that tests/skips.py does not list: {line}", red=True)
