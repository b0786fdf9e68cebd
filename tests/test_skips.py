"""A test that is skipped for a reason nobody has listed makes the run fail."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

TESTS = """
import pytest


def test_listed() -> None:
    pytest.skip("this face is undercut")


def test_unlisted() -> None:
    pytest.skip("it fails on Tuesdays")
"""


def test_a_skip_needs_a_listed_reason(tmp_path: Path) -> None:
    (tmp_path / "test_it.py").write_text(TESTS, "utf-8")
    command = [sys.executable, "-m", "pytest", "-q", "-p", "tests.skips", "-p", "no:cacheprovider", "test_it.py"]
    path = str(Path(__file__).parents[1])
    bare = {"PYTHONPATH": path, "PYTEST_ADDOPTS": "", "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}
    environment = {k: v for k, v in {**os.environ, **bare}.items() if k != "PYTEST_XDIST_WORKER"}
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 1, done.stdout
    told = [line for line in done.stdout.splitlines() if "does not list" in line]
    assert len(told) == 1, done.stdout
    assert told[0].endswith("test_it.py::test_unlisted: Skipped: it fails on Tuesdays")
