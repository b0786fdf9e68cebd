"""STL, 3MF and STEP of wheels with hubs, webs and keyed bores: read back, and spoiled."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from exporters.formats.reading import READERS
from exporters.formats.registry import REGISTRY, declared_error, shape_of
from exporters.production.plan import plan_build
from exporters.verification.judge import held, verify_file
from exporters.verification.mesh import verify_mesh
from parts.base.readback import ReadError
from parts.scene.formats import FILE_KINDS
from parts.scene.load import scene_from_dict

WHEEL: dict[str, Any] = {
    "kind": "spur_gear",
    "module": 2.0,
    "number_of_teeth": 30,
    "face_width": 10.0,
    "bore": {"shape": "keyway", "diameter": 12.0},
    "web": {"thickness": 4.0, "rim_diameter": 48.0},
    "hub": {"diameter": 22.0, "above": 5.0},
    "holes": {"count": 5, "diameter": 8.0, "pitch_circle_diameter": 35.0},
    "face_chamfer": {"below": 0.4, "above": 0.3},
    "material": "steel",
}


def asked(kind: str, **keys: Any) -> Any:
    """The job of a wheel."""
    raw = {"parts": {"g": {**WHEEL, **keys}}, "exports": [{"format": kind}]}
    return plan_build(scene_from_dict(raw, "test", "test"), "test", [], []).jobs[0]


def made(kind: str, folder: Path) -> tuple[Any, Path, float]:
    """The job, the file and its declared error."""
    job = asked(kind)
    shape, file = shape_of(job), folder / job.path
    REGISTRY[kind].write(job, shape, file)
    return job, file, declared_error(job, shape)[0]


@pytest.mark.sampled(1)
@pytest.mark.parametrize("kind", ["stl", "3mf", "step"])
@pytest.mark.parametrize("keys", [{}, {"web": None, "holes": None}, {"hub": None, "face_chamfer": 0.0}], ids=str)
def test_a_wheel_is_written_and_read_back(kind: str, keys: dict[str, Any], tmp_path: Path) -> None:
    if kind == "step":
        pytest.importorskip("OCP", exc_type=ImportError)
    given = {k: v for k, v in keys.items() if v is not None}
    for key in (k for k, v in keys.items() if v is None):
        given[key] = None
    raw = {k: v for k, v in {**WHEEL, **given}.items() if v is not None}
    scene = {"parts": {"g": raw}, "exports": [{"format": kind}]}
    job = plan_build(scene_from_dict(scene, "test", "test"), "test", [], []).jobs[0]
    shape, file = shape_of(job), tmp_path / job.path
    REGISTRY[kind].write(job, shape, file)
    verdict = verify_file(
        file, FILE_KINDS[kind], job.exact, declared_error(job, shape)[0], float(job.export.tolerance or 0)
    )
    assert verdict.failures == ()
    assert abs(verdict.measured["volume_error"]) < (1e-6 if kind == "step" else 1e-3)


@dataclass(frozen=True)
class Once:
    """The wheel's file in one format, read once for all tests."""

    job: Any
    found: Any
    declared: float


@pytest.fixture(scope="module")
def once(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Once]:
    """The file of the wheel in each format."""
    files = {kind: made(kind, tmp_path_factory.mktemp(kind)) for kind in ("stl", "step")}
    return {kind: Once(job, READERS[kind](file), declared) for kind, (job, file, declared) in files.items()}


@pytest.mark.sampled(1)
@pytest.mark.parametrize("other", [{"face_chamfer": 0.3}, {"hub": {"diameter": 22.5, "above": 5.0}},
                                   {"hub": {"diameter": 22.0, "above": 5.5}},
                                   {"web": {"thickness": 4.0, "rim_diameter": 48.0, "shift": 0.1}},
                                   {"bore": {"shape": "keyway", "diameter": 12.0, "angle_deg": 45.0}},
                                   {"holes": {"count": 5, "diameter": 8.1, "pitch_circle_diameter": 35.0}},
                                   {"holes": {"count": 4, "diameter": 8.0, "pitch_circle_diameter": 35.0}},
                                   {"bore": {"shape": "round", "diameter": 12.0}}], ids=str)  # fmt: skip
@pytest.mark.parametrize("kind", ["stl", "step"])
def test_another_wheel_is_not_taken_for_it(kind: str, other: dict[str, Any], once: dict[str, Once]) -> None:
    if kind == "step":
        pytest.importorskip("OCP", exc_type=ImportError)
    wheel = once[kind]
    assert held(wheel.found, FILE_KINDS[kind], asked(kind, **other).exact, wheel.declared, 0.01).failures


PLACES = 41


def spoiled(wheel: Once, vertices: NDArray[Any] | None = None, triangles: NDArray[Any] | None = None) -> bool:
    """Whether the mesh with other vertices or triangles is refused, or has outlines that cannot be followed."""
    good = wheel.found
    mesh = type(good)(
        good.vertices if vertices is None else vertices, good.triangles if triangles is None else triangles
    )
    try:
        return bool(verify_mesh(mesh, wheel.job.body, wheel.declared, 0.01).failures)
    except ReadError:
        return True


def test_the_mesh_as_it_is_passes(once: dict[str, Once]) -> None:
    assert not spoiled(once["stl"])


@pytest.mark.parametrize("share", [0.0, 1 / 3, 1 / 2, 1.0])
def test_a_triangle_flipped_or_lost_is_caught(once: dict[str, Once], share: float) -> None:
    good = once["stl"].found.triangles
    at = int(share * (len(good) - 1))
    flipped = good.copy()
    flipped[at] = flipped[at][::-1]
    assert spoiled(once["stl"], triangles=flipped)
    assert spoiled(once["stl"], triangles=np.delete(good, at, axis=0))


@pytest.mark.sampled(1)
@pytest.mark.parametrize("place", range(PLACES))
def test_a_spoiled_vertex_is_caught_wherever_it_is(once: dict[str, Once], place: int) -> None:
    good = once["stl"].found.vertices
    at = place * (len(good) - 1) // (PLACES - 1)

    def caught(*step: float) -> bool:
        moved = good.copy()
        moved[at] += step
        return spoiled(once["stl"], moved)

    # a vertex may slide along its outline, but not both ways across
    assert caught(0.03, 0.03, 0.0) or caught(0.03, -0.03, 0.0)
    assert caught(0.0, 0.0, 0.01)


def test_trimesh_for_those_who_go_on_in_python(tmp_path: Path) -> None:
    import trimesh

    job, _, _ = made("stl", tmp_path)
    mesh = job.part.to_trimesh(tolerance=0.05)
    assert isinstance(mesh, trimesh.Trimesh)
    assert mesh.is_watertight


def test_cadquery_for_those_who_go_on_in_python(tmp_path: Path) -> None:
    pytest.importorskip("cadquery")
    job, _, _ = made("stl", tmp_path)
    solid = job.part.to_cadquery().val()
    assert solid.isValid()
