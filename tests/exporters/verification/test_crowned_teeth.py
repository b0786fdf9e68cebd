"""Files of crowned teeth: thicknesses of slices against the involute's own formula; other crowning fails."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
import shapely
import shapely.affinity
import trimesh
from manifold3d import Manifold, Mesh

from geometry.curves.curve import Real
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict
from tests.exporters.making import Keys, read_report, run, write_scene

WIDTH, CROWNING = 12.0, 0.06
GEAR: Keys = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 23, "face_width": WIDTH, "bore_diameter": 8.0,
              "crowning": CROWNING}  # fmt: skip
PARTS: dict[str, Keys] = {
    "plain": GEAR,
    "whole": GEAR | {"face_chamfer": 0.4, "hub": {"diameter": 20.0, "above": 6.0}, "profile_shift_coefficient": 0.2,
                     "web": {"thickness": 4.0, "rim_diameter": 36.0}},
    "undercut": GEAR | {"number_of_teeth": 9, "bore_diameter": 4.0, "crowning": 0.03, "tooth_mark": {},
                        "tip_chamfer": 0.1},
    "sector": GEAR | {"sector": {"teeth": 5}, "tip_rounding": 0.15},
    "helical": GEAR | {"helix_angle_deg": 28.0, "hand": "left", "face_chamfer": {"above": 0.5}},
    "double": GEAR | {"helix_angle_deg": 25.0, "double_helical": True, "face_chamfer": {"below": 0.4}},
    # a chamfer beyond the middle, and below it crowning so low that one slice is enough: the bore ends there too
    "thin": {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 8, "profile_shift_coefficient": 0.207,
             "face_width": 0.3, "bore_diameter": 2.957, "face_chamfer": {"above": 0.21}, "crowning": 0.0001},
}  # fmt: skip
EXPORTS: list[Keys] = [{"format": "stl"}, {"format": "step"}, {"format": "svg", "purpose": "part"}]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All of them, built once; a mate's backlash thins crowned teeth too."""
    place = tmp_path_factory.mktemp("crowned")
    assert run("build", write_scene(place / "s.toml", PARTS, EXPORTS), "--out", place / "out") == 0
    return place / "out" / "s"


def thickness(section: shapely.Geometry, radius: float) -> float:
    """Of tooth 1 along a circle about the axis, mm."""
    turns: Real = np.linspace(-0.13, 0.13, 26_001)
    inside = shapely.contains_xy(section, radius * np.cos(turns), radius * np.sin(turns))
    return radius * 0.26 * float(np.count_nonzero(inside)) / len(turns)


@pytest.mark.parametrize("name", ["plain", "whole", "sector"])
def test_slices_are_as_thick_as_the_involute_turned(folder: Path, name: str) -> None:
    """A flank that goes back by c along its normal turns by c / r_b about the axis."""
    mesh = trimesh.load(folder / f"{name}.stl")
    assert mesh.is_watertight
    solid = Manifold(Mesh(np.asarray(mesh.vertices, np.float32), np.asarray(mesh.faces, np.uint32)))
    shift = PARTS[name].get("profile_shift_coefficient", 0.0)
    reference, base = 23.0, 23.0 * math.cos(math.radians(20))
    whole = math.pi + 4 * shift * math.tan(math.radians(20))
    for z in (0.7, 2.0, 5.0, 6.0, 8.3, 11.4):
        relief = CROWNING * (2 * z / WIDTH - 1) ** 2
        rings = solid.slice(z).to_polygons()
        section = shapely.Polygon(max(rings, key=lambda ring: np.abs(ring).max()))
        if name != "sector":
            # every tooth is the first one
            next_one = shapely.affinity.rotate(section, 360 / 23, origin=(0, 0))
            assert shapely.symmetric_difference(section, next_one).area < 0.01 * section.length
        for radius in (22.6, 23.0, 24.0):
            involute = math.acos(base / radius)
            turned = 2 * (math.tan(involute) - involute - math.tan(math.radians(20)) + math.radians(20))
            wanted = radius * (whole / reference - turned - 2 * relief / base)
            assert thickness(section, radius) == pytest.approx(wanted, abs=0.023)


def test_volumes_and_tables_tell_what_is_made(folder: Path) -> None:
    told = read_report(folder)
    for name in PARTS:
        assert trimesh.load(folder / f"{name}.stl").volume == pytest.approx(told["parts"][name]["volume"], rel=1e-3)
    assert "Crowning of each flank" in (folder / "plain.part.svg").read_text("utf-8")


@pytest.mark.parametrize(
    ("ending", "crowning"),
    [("stl", 0.066), ("step", 0.054), *(pytest.param(*one, marks=pytest.mark.heavy)
                                        for one in (("stl", 0.0), ("stl", 0.054), ("step", 0.0), ("step", 0.066)))],
)  # fmt: skip
def test_files_of_another_crowning_fail(folder: Path, tmp_path: Path, crowning: float, ending: str) -> None:
    told = json.loads((folder / "report.json").read_text("utf-8"))
    told["scene"]["parts"]["plain"]["crowning"] = crowning
    (tmp_path / f"plain.{ending}").write_bytes((folder / f"plain.{ending}").read_bytes())
    (tmp_path / "report.json").write_text(json.dumps(told), "utf-8")
    assert run("verify", tmp_path / f"plain.{ending}") == 1


def test_a_full_round_root_asks_for_a_land() -> None:
    """The standard rack of 25 degrees is full round."""
    refusal = refused(pressure_angle_deg=25.0)
    assert refusal is not None
    assert (refusal.key, refusal.code) == ("parts.p.crowning", "crowned_full_round")
    assert refused(pressure_angle_deg=25.0, circumferential_thinning=0.01) is None


def refused(**keys: object) -> SceneError | None:
    scene = scene_from_dict({"parts": {"p": GEAR | keys}}, "s.toml", "s")
    try:
        make_parts(scene, "s.toml")
    except SceneError as refusal:
        return refusal
    return None


@pytest.mark.parametrize(
    ("keys", "code"),
    [({"thinning_method": "deeper_cut", "circumferential_thinning": 0.1}, "not_crowned"),
     ({"crowning": 1.5}, "crowned_away"), ({"crowning": 0.8, "number_of_teeth": 11}, "crowned_away")],
)  # fmt: skip
def test_crowning_that_cannot_be_is_refused(keys: Keys, code: str) -> None:
    refusal = refused(**keys)
    assert refusal is not None
    assert (refusal.key, refusal.code) == ("parts.p.crowning", code)
    assert refusal.nearest is not None
    offered = refusal.nearest.value
    assert isinstance(offered, float)
    assert refused(**keys | {"crowning": offered}) is None
    assert refused(**keys | {"crowning": offered + 2e-3}) is not None


@pytest.mark.parametrize("keys", [{}, {"bore_diameter": 0.0, "tip_relief": {"depth_coefficient": 0.02}}])
def test_a_chamfer_that_leaves_no_tooth_is_refused_by_its_own_key(keys: Keys) -> None:
    """As without crowning, with a depth that works: a diameter was refused that is no key."""
    refusal = refused(**keys, face_chamfer={"below": 1.4})
    assert refusal is not None
    assert (refusal.key, refusal.code) == ("parts.p.face_chamfer.below", "chamfer_leaves_nothing_of_outline")
    assert refusal.nearest is not None
    offered = refusal.nearest.value
    assert isinstance(offered, float)
    assert refused(**keys, face_chamfer={"below": offered}) is None
    assert refused(**keys, face_chamfer={"below": offered + 0.01}) is not None


def test_a_chamfer_may_reach_beyond_the_middle(tmp_path: Path) -> None:
    """The bore's is one with it: the teeth's was cut in the middle, the bore's not, and the mesh was refused."""
    chamfers = {"below": {"below": 0.7, "above": 0.2}, "above": {"above": 0.7}}
    parts: dict[str, Keys] = {
        name: GEAR | {"number_of_teeth": 17, "face_width": 1.2, "face_chamfer": chamfer}
        for name, chamfer in chamfers.items()
    }
    exports: list[Keys] = [{"format": "stl", "tolerance": 0.02}]
    assert run("build", write_scene(tmp_path / "s.toml", parts, exports), "--out", tmp_path / "out") == 0


def test_a_flat_outline_tells_that_it_has_the_middle_alone(tmp_path: Path) -> None:
    assert run("build", write_scene(tmp_path / "s.toml", {"g": GEAR}, [{"format": "dxf"}]), "--out", tmp_path) == 0
    (file,) = read_report(tmp_path / "s")["files"]
    assert "holds only the section" in str(file["findings"])
