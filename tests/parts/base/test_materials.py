"""Densities by the names in a scene, and mass properties against trimesh."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from parts.base.materials import density_of, mass_properties, material_told
from parts.base.texts import words
from parts.scene.load import make_parts, scene_from_dict
from tests.exporters.making import part_keys, read_report, run, write_scene
from tests.exporters.outside import Gear


@pytest.mark.parametrize(
    ("text", "density"),
    [
        ("PLA", 1.24),
        ("plywood 3 mm", 0.65),
        ("Stainless steel 1.4301", 7.93),
        ("Steel C45", 7.85),
        ("сталь 45", 7.85),
        ("plastic", None),
        (None, None),
    ],
)
def test_a_material_is_known_by_its_name_anywhere_in_the_text(text: str | None, density: float | None) -> None:
    assert density_of(text) == density


def test_mass_and_inertia_agree_with_the_mesh() -> None:
    raw = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 23, "bore": {"shape": "D", "diameter": 8, "flat": 7},
           "hub": {"diameter": 20, "above": 6}, "material": "brass"}  # fmt: skip
    part = make_parts(scene_from_dict({"parts": {"g": raw}}, "test", "test"), "test")[0]["g"]
    mesh, found = part.to_trimesh(tolerance=0.001), mass_properties(part.made_by.moments(part.body(0.0)), part.density)
    mesh.density = 8.5e-3
    assert found["mass"] == pytest.approx(mesh.mass, rel=2e-4)
    assert np.allclose(found["centre_of_mass"], mesh.center_mass, atol=1e-3)
    tensor = np.array(found["inertia_tensor"])
    assert np.allclose(tensor, mesh.moment_inertia, rtol=5e-4, atol=1e-4 * tensor[2, 2])
    # the axis stands beside the centre of mass: Steiner
    x, y, _ = found["centre_of_mass"]
    assert found["axial_inertia"] == pytest.approx(tensor[2, 2] + found["mass"] * (x * x + y * y), rel=1e-12)


def test_a_density_of_one_s_own_goes_first() -> None:
    raw = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 23, "material": "PLA", "density": 1.1}
    part = make_parts(scene_from_dict({"parts": {"g": raw}}, "test", "test"), "test")[0]["g"]
    assert part.density == 1.1


@pytest.mark.parametrize(("keys", "told"), [({}, False), ({"material": "PLA"}, False), ({"material": "plywod"}, True),
                                            ({"material": "plywod", "density": 0.6}, False)])  # fmt: skip
def test_a_material_without_a_density_is_told(keys: dict[str, object], told: bool, tmp_path: Path) -> None:
    scene = write_scene(tmp_path / "s.toml", {"g": part_keys(Gear(2, 23)) | keys}, [{"format": "svg"}])
    assert run("build", scene, "--out", tmp_path, "--no-verify") == 0
    found = read_report(tmp_path / "s")["parts"]["g"]["findings"]
    assert ("unknown_material" in [f["code"] for f in found]) is told


def test_a_known_material_is_told_in_the_language_of_the_drawing() -> None:
    """Name and mm are translated: what else the user wrote stays, as does what nobody knows."""
    pairs = {"plywood 3 mm": "фанера 3 мм", "stainless steel 40Х": "нержавна сталь 40Х", "Steel": "сталь", "PLA": "PLA"}
    for given, told in {**pairs, "unobtainium": "unobtainium"}.items():
        assert material_told(given, words("uk")) == told
        assert material_told(given, words("en")) == given
    assert not material_told(None, words("uk"))
