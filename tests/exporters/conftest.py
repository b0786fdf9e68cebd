"""Assembly files that several test files read."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.exporters.train import STEP, THREEMF, made


@pytest.fixture(scope="session")
def train_3mf(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The assembly of the train as 3MF, its parts and report beside it."""
    return made(tmp_path_factory.mktemp("a"), THREEMF, {"format": "3mf"}) / "train.3mf"


@pytest.fixture(scope="session")
def train_step(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The same as STEP, with one part beside it."""
    pytest.importorskip("OCP", reason="the CAD kernel is an extra", exc_type=ImportError)
    return made(tmp_path_factory.mktemp("a"), STEP, {"format": "step", "parts": ["sun"]}) / "train.step"
