"""The same files in any process and place, on any machine: other processors' kernels of numpy and BLAS by switches."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from tests.same_bytes import SCENES, are_alike, build, unlike
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


def elsewhere(names: list[str], machine: dict[str, str], folder: Path) -> Path:
    """A folder with the files of scenes that another process builds, as on another machine."""
    command = [sys.executable, "-m", "exporters", "build", *names, "--out", str(folder), "--no-verify", "-q"]
    environment = {**os.environ, **machine, "PYTHONHASHSEED": "2", "TZ": "Asia/Tokyo", "PYTHONPATH": str(ROOT)}
    subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, check=True)
    return folder


@pytest.fixture(scope="module")
def here(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """A folder with the files of a scene as this process builds it, once for all machines."""

    def made(scene: str) -> Path:
        folder = tmp_path_factory.mktemp(scene)
        build([scene], folder)
        return folder

    return cache(made)


def test_an_old_processor_writes_the_same_files(tmp_path: Path, here: Callable[[str], Path]) -> None:
    """Splines, arcs, meshes and STEP: before, 16 of these files differed."""
    for scene in some_of(["print_gear", "lantern_pair"]):
        assert unlike(elsewhere([scene], OLD, tmp_path / scene), here(scene)) == []


@pytest.mark.heavy
def test_an_old_processor_tells_the_same_place_of_contact() -> None:
    """Teeth that touch all the way have the same gap everywhere: where it is least, rounding must not choose."""

    def checked(machine: dict[str, str]) -> list[dict[str, object]]:
        command = [sys.executable, "-m", "exporters", "check", "practicum_pair", "idler_train", "--json"]
        environment = {**os.environ, **machine, "PYTHONPATH": str(ROOT)}
        told = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, check=True).stdout
        return [mate for scene in json.loads(told) for mate in scene["mates"]]

    one, other = checked({}), checked(OLD)
    assert len(one) > 2
    for own, old in zip(one, other, strict=True):
        assert own["drive_angle_deg"] == pytest.approx(old["drive_angle_deg"], abs=1e-6)
        assert own["point"] == pytest.approx(old["point"], abs=1e-6)


def stl(triangles: list[list[int]]) -> bytes:
    """A mesh over places in a row, unturned."""
    rows = np.zeros((len(triangles), 12), dtype="<f4")
    rows[:, 3::3] = triangles
    return bytes(80) + len(rows).to_bytes(4, "little") + b"".join(row.tobytes() + bytes(2) for row in rows)


@pytest.mark.parametrize(
    ("one", "two", "alike"),
    [
        (b"(28.893825016,14.)", b"(28.893825017,14.)", True),
        (b"(28.893825016,14.)", b"(28.893825018,14.)", False),
        (b"10\n0.2777984665053936\n", b"10\n0.27779846650539\n", True),
        (b"A99,99 0 1", b"A98,98 0 1", False),
        (b"#18=A(#17)", b"#18=A(#16)", False),
        (b"A(1.)", b"B(1.)", False),
        (b'<vertex x="1"/><triangle v1="0" v2="1" v3="2"/>', b'<vertex x="1"/><triangle v1="1" v2="3" v3="2"/>', True),
        (b'<vertex x="1"/><triangle v1="0" v2="1" v3="2"/>', b'<vertex x="2"/><triangle v1="0" v2="1" v3="2"/>', False),
        (stl([[0, 1, 2], [0, 2, 3]]), stl([[0, 1, 3], [1, 2, 3]]), True),
        (stl([[0, 1, 2], [0, 2, 3]]), stl([[0, 1, 2], [0, 2, 4]]), False),
    ],
)
def test_only_the_last_digits_may_differ(one: bytes, two: bytes, alike: bool) -> None:
    assert are_alike(one, two) == alike


@pytest.mark.heavy
@pytest.mark.parametrize("machine", MACHINES)
@pytest.mark.parametrize("scene", sorted(f.stem for f in SCENES.glob("*.toml")))
def test_every_scene_has_the_same_files_on_any_processor(
    tmp_path: Path, here: Callable[[str], Path], scene: str, machine: str
) -> None:
    assert unlike(elsewhere([scene], MACHINES[machine], tmp_path), here(scene)) == []
