"""ruff and mypy find nothing, where they are installed with the tests."""

from __future__ import annotations

import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


@pytest.mark.parametrize(
    ("tool", "options"),
    [
        ("ruff", ["check", "--no-cache"]),
        pytest.param("ruff", ["format", "--check", "--no-cache"], marks=pytest.mark.heavy),
        pytest.param("mypy", [], marks=pytest.mark.heavy),
    ],
    ids=["rules", "format", "types"],
)
def test_what_checks_sources_finds_nothing(tool: str, options: list[str]) -> None:
    if find_spec(tool) is None or not (ROOT / "pyproject.toml").is_file():
        pytest.skip("no source tree")
    done = subprocess.run([sys.executable, "-m", tool, *options], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
