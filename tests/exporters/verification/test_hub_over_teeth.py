"""Hubs that are flanges over the teeth of a small pinion: meshes against sums of prisms, refusals, checks, drawings."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
import trimesh
from manifold3d import Manifold, Mesh

from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict
from tests.exporters.making import Keys, read_report, run, table, write_scene

WIDTH, BORE, HUB = 8.0, 4.0, 18.0
GEAR: Keys = {"kind": "spur_gear", "module": 1.0, "number_of_teeth": 12, "profile_shift_coefficient": 0.4,
              "face_width": WIDTH, "bore_diameter": BORE}  # fmt: skip
HUBS: dict[str, Keys] = {
    "above": {"hub": {"diameter": HUB, "above": 7.0}},
    "below": {"hub": {"diameter": HUB, "below": 6.0}, "helix_angle_deg": 25.0, "crowning": 0.02, "face_chamfer": 0.3},
    "both": {"hub": {"diameter": HUB, "below": 2.0, "above": 3.0}},
    "screwed": {"hub": {"diameter": HUB, "above": 7.0, "set_screws": {"diameter": 2.5}}, "face_chamfer": 0.3},
}
EXPORTS: list[Keys] = [{"format": "stl"}, {"format": "step"}, {"format": "svg", "purpose": "part"}]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("hubs")
    parts = {name: GEAR | hub for name, hub in HUBS.items()} | {"plain": GEAR}
    assert run("build", write_scene(place / "s.toml", parts, EXPORTS), "--out", place / "out") == 0
    return place / "out" / "s"


def area(mesh: trimesh.Trimesh, z: float) -> float:
    """Of the section at a height, mm2."""
    solid = Manifold(Mesh(np.asarray(mesh.vertices, np.float32), np.asarray(mesh.faces, np.uint32)))
    return float(solid.slice(z).area())


@pytest.mark.parametrize("name", ["above", "both"])
def test_the_hub_stands_over_the_teeth_as_they_are(folder: Path, name: str) -> None:
    mesh, plain = (trimesh.load(folder / f"{one}.stl") for one in (name, "plain"))
    assert mesh.is_watertight
    hub = HUBS[name]["hub"]
    disc = math.pi / 4 * (HUB**2 - BORE**2)
    for z in (0.01, WIDTH / 2, WIDTH - 0.01):
        assert area(mesh, z) == pytest.approx(area(plain, z), abs=0.05)
    assert area(mesh, WIDTH + hub["above"] - 0.01) == pytest.approx(disc, rel=2e-3)
    height = hub["above"] + hub.get("below", 0.0)
    wanted = read_report(folder)["parts"]["plain"]["volume"] + disc * height
    assert read_report(folder)["parts"][name]["volume"] == pytest.approx(wanted, rel=1e-9)
    assert mesh.volume == pytest.approx(wanted, rel=2e-3)


def test_teeth_have_no_chamfer_where_they_end_in_the_hub(folder: Path) -> None:
    """At the free end of crowned helical ones they have."""
    mesh = trimesh.load(folder / "below.stl")
    assert mesh.is_watertight
    radius = np.hypot(*mesh.vertices[:, :2].T)
    tips = {round(z, 3): radius[np.abs(mesh.vertices[:, 2] - z) < 1e-4].max() for z in (-6.0, -5.7, WIDTH)}
    assert tips[-6.0] == pytest.approx(HUB / 2 - 0.3, abs=0.01)
    assert tips[-5.7] == pytest.approx(HUB / 2, abs=0.01)
    whole = 6.0 / math.cos(math.radians(25)) + 1.4
    assert tips[WIDTH] == pytest.approx(whole - 0.3, abs=0.01)
    beside = mesh.vertices[np.abs(mesh.vertices[:, 2]) < 1e-4]
    assert np.any(np.abs(np.hypot(*beside[:, :2].T) - whole) < 0.01)
    words = (folder / "screwed.part.svg").read_text("utf-8")
    assert "4 chamfers 0.3" in words


@pytest.mark.parametrize(("ending", "diameter"), [("stl", 18.2), ("step", 17.9)])
def test_files_of_another_hub_fail(folder: Path, tmp_path: Path, ending: str, diameter: float) -> None:
    told = json.loads((folder / "report.json").read_text("utf-8"))
    told["scene"]["parts"]["above"]["hub"]["diameter"] = diameter
    (tmp_path / f"above.{ending}").write_bytes((folder / f"above.{ending}").read_bytes())
    (tmp_path / "report.json").write_text(json.dumps(told), "utf-8")
    assert run("verify", tmp_path / f"above.{ending}") == 1


def refused(**keys: object) -> SceneError | None:
    try:
        make_parts(scene_from_dict({"parts": {"p": GEAR | keys}}, "s", "s"), "s")
    except SceneError as refusal:
        return refusal
    return None


def test_a_hub_among_the_teeth_is_told_both_ways_out() -> None:
    """Within the roots, or over the tips; where it stands out nowhere, has a web or a sector, only the first."""
    refusal = refused(hub={"diameter": 12.0, "above": 3.0})
    assert refusal is not None
    assert (refusal.key, refusal.code) == ("parts.p.hub.diameter", "reaches_teeth")
    assert refusal.nearest is not None
    for diameter, right in (
        (refusal.nearest.value, True),
        (refusal.nearest.value + 1e-3, False),
        (refusal.numbers["flange"], True),
        (refusal.numbers["flange"] - 1e-3, False),
    ):
        assert (refused(hub={"diameter": diameter, "above": 3.0}) is None) is right
    for more in (
        {"hub": {"diameter": HUB}},
        {"hub": {"diameter": HUB, "above": 3.0}, "sector": {"teeth": 5}},
        {"hub": {"diameter": HUB, "above": 3.0}, "web": {"thickness": 3.0, "rim_diameter": 9.0}},
    ):
        other = refused(**more)
        assert other is not None
        assert other.code == "reaches_root_circle"


@pytest.mark.parametrize(("width", "code"), [(WIDTH, 0), (WIDTH + 1, 1)])
def test_a_mate_that_reaches_under_the_hub_is_found(tmp_path: Path, width: float, code: int) -> None:
    wheel = GEAR | {"number_of_teeth": 40, "face_width": width}
    mate = table("[[mates]]", {"kind": "external_gear_pair", "first": "pinion", "second": "wheel"})
    parts = {"pinion": GEAR | HUBS["above"], "wheel": wheel}
    assert run("check", write_scene(tmp_path / "s.toml", parts, EXPORTS, mate)) == code


@pytest.mark.parametrize(
    ("chamfer", "code"),
    [({"above": 0.3}, 2), ({"above": 0.02424}, 0), ({"above": 0.0253}, 2), ({"below": 0.3}, 0)],
)
def test_a_chamfer_does_not_go_under_the_hub(tmp_path: Path, chamfer: Keys, code: int) -> None:
    """Roots of 10.3 less two chamfers are within a hub of 10.2: the STEP was no valid solid, and nobody said so."""
    gear = GEAR | {"hub": {"diameter": 10.2, "above": 7.0}, "face_chamfer": chamfer}
    assert run("build", write_scene(tmp_path / "s.toml", {"g": gear}, EXPORTS[1:2]), "--out", tmp_path) == code
