"""The same files in any process and place, on any machine: other processors' kernels of numpy and BLAS by switches."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from tests.same_bytes import SCENES, hashes
from tests.sampling import some_of

ROOT = Path(__file__).parents[3]
_FOUND = np.show_config(mode="dicts").get("SIMD Extensions", {}).get("found", [])
# an old processor has neither; kernels of BLAS by name
OLD = {"NPY_DISABLE_CPU_FEATURES": " ".join(_FOUND), "OPENBLAS_CORETYPE": "Prescott"}
MACHINES = {
    "Haswell": {"OPENBLAS_CORETYPE": "Haswell"},
    "Zen": {"OPENBLAS_CORETYPE": "Zen"},
    "Sandybridge": {"OPENBLAS_CORETYPE": "Sandybridge"},
    "old": OLD,
}


def elsewhere(names: list[str], machine: dict[str, str]) -> dict[str, str]:
    """The hashes of scenes that are built by another process as on another machine."""
    command = [sys.executable, "-m", "tests.same_bytes", *names]
    environment = {**os.environ, **machine, "PYTHONHASHSEED": "2", "TZ": "Asia/Tokyo", "PYTHONPATH": str(ROOT)}
    run = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=True)
    return {path: found for found, path in (line.split(" ", 1) for line in run.stdout.splitlines())}


def test_an_old_processor_writes_the_same_files(tmp_path: Path) -> None:
    """Splines, arcs, meshes and STEP: before, 16 of these files differed."""
    scenes = some_of(["print_gear", "lantern_pair"])
    assert elsewhere(scenes, OLD) == hashes(scenes, tmp_path)


@pytest.mark.heavy
@pytest.mark.parametrize("machine", MACHINES)
@pytest.mark.parametrize("scene", sorted(f.stem for f in SCENES.glob("*.toml")))
def test_every_scene_has_the_same_files_on_any_processor(tmp_path: Path, scene: str, machine: str) -> None:
    assert elsewhere([scene], MACHINES[machine]) == hashes([scene], tmp_path)
