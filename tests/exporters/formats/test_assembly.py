"""Assembly files: names, true instances, places, the same bytes every time, spoiled files caught, the kernel absent."""

from __future__ import annotations

import math
import re
import subprocess
import sys
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from tests.exporters.making import read_report, run
from tests.exporters.train import IDS, STEP, THREEMF, TRAIN, made

CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"


def places(folder: Path) -> dict[str, np.ndarray]:
    """(3, 4) of every instance by hand: z 13 / 11 by (3.4) with the working angle found by bisection."""
    alpha = math.radians(20)
    goal = math.tan(alpha) - alpha + 2 * 0.3 * math.tan(alpha) / 24
    low, high = alpha, 1.0
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if math.tan(middle) - middle < goal else (low, middle)
    distance = 24 * math.cos(alpha) / math.cos(low)
    found = {"sun": (10.0, (1.5, -2.0, 0.25)), "free": (-33.0, (0.0, 60.0, 1.0))}
    for key, direction in (("left", 180.0), ("right", 25.0)):
        angle = math.radians(direction)
        # a space of the planet looks back at the sun when a tooth of the sun looks along the direction
        turned = direction + 180 + 180 / 11 - (10.0 - direction) * 13 / 11
        found[key] = (turned, (1.5 + distance * math.cos(angle), -2.0 + distance * math.sin(angle), 0.25))
    return {key: motion(math.radians(turned), at) for key, (turned, at) in found.items()}


def motion(angle: float, at: tuple[float, float, float]) -> np.ndarray:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s, 0, at[0]], [s, c, 0, at[1]], [0, 0, 1, at[2]]])


def same_place(found: np.ndarray, expected: np.ndarray) -> bool:
    """Up to whole pitches of the planet."""
    pitches = [motion(2 * math.pi * k / 11, (0, 0, 0))[:, :3] for k in range(11)]
    return bool(
        np.abs(found[:, 3] - expected[:, 3]).max() < 1e-9
        and min(np.abs(found[:, :3] - expected[:, :3] @ p).max() for p in pitches) < 1e-10
    )


def test_a_3mf_has_one_object_a_part_and_one_item_an_instance(train_3mf: Path) -> None:
    root = ElementTree.fromstring(zipfile.ZipFile(train_3mf).read("3D/3dmodel.model"))
    objects = {o.get("id"): o.get("name") for o in root.iter(f"{CORE}object")}
    assert sorted(map(str, objects.values())) == ["planet", "sun"]
    items = {str(i.get("partnumber")): i for i in root.iter(f"{CORE}item")}
    assert {key: objects[item.get("objectid")] for key, item in items.items()} == IDS
    for key, expected in places(train_3mf.parent).items():
        found = np.array([float(x) for x in str(items[key].get("transform")).split()]).reshape(4, 3).T
        assert same_place(found, expected), key
    shades = [b.get("displaycolor") for b in root.iter(f"{CORE}base")]
    assert shades[0] == "#C08040FF"
    names = {p.name for p in train_3mf.parent.iterdir()}
    assert {"train.3mf", "sun.3mf", "planet.3mf"} <= names


def test_lib3mf_reads_the_places_too(train_3mf: Path) -> None:
    import lib3mf

    model = lib3mf.get_wrapper().CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(train_3mf))
    assert reader.GetWarningCount() == 0
    items, found = model.GetBuildItems(), {}
    while items.MoveNext():
        item = items.GetCurrent()
        fields = item.GetObjectTransform().Fields
        found[item.GetPartNumber()] = np.array([[fields[i][j] for i in range(4)] for j in range(3)])
    for key, expected in places(train_3mf.parent).items():
        assert np.abs(found[key][:, 3] - expected[:, 3]).max() < 1e-5, key


def test_a_step_has_one_product_a_part_and_one_occurrence_an_instance(train_step: Path) -> None:
    text = train_step.read_text(encoding="ascii")
    assert sorted(re.findall(r"PRODUCT\('([^']*)'", text)) == ["planet", "sun", "train"]
    assert re.findall(r"NEXT_ASSEMBLY_USAGE_OCCURRENCE\('(\d+)','([^']*)'", text) == [
        (str(n), key) for n, key in enumerate(IDS, 1)
    ]
    assert text.count("MANIFOLD_SOLID_BREP(") == 2
    assert "COLOUR_RGB" in text
    # of each part its tips, its spaces and its bore
    assert text.count("CYLINDRICAL_SURFACE(") == 2 * 3


def test_the_kernel_finds_every_solid_of_a_step_in_its_place(train_step: Path) -> None:
    """The plain reader, which knows of no names: centres of mass lie on the axes, half a face width up."""
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps
    from OCP.STEPControl import STEPControl_Reader
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer

    reader = STEPControl_Reader()
    reader.ReadFile(str(train_step))
    reader.TransferRoots()
    solids, centres = TopExp_Explorer(reader.OneShape(), TopAbs_ShapeEnum.TopAbs_SOLID), []
    while solids.More():
        properties = GProp_GProps()
        BRepGProp.VolumeProperties_s(solids.Current(), properties)
        place = properties.CentreOfMass()
        centres.append([place.X(), place.Y(), place.Z()])
        solids.Next()
    expected = [m[:, 3] + [0, 0, 5.0] for m in places(train_step.parent).values()]
    assert len(centres) == 4
    for row in expected:
        assert min(np.abs(np.array(centres) - row).max(axis=1)) < 1e-6


def test_locations_in_a_step_are_exact(train_step: Path) -> None:
    from exporters.formats.read_step import read_step_assembly

    found = read_step_assembly(train_step)
    assert found.title == "train"
    assert sorted(name for name, *_ in found.prototypes) == ["planet", "sun"]
    placed = {name: (found.prototypes[index][0], matrix) for name, index, matrix, _ in found.occurrences}
    assert {name: part for name, (part, _) in placed.items()} == IDS
    for key, expected in places(train_step.parent).items():
        assert same_place(placed[key][1], expected), key


@pytest.mark.parametrize("kind", ["train_3mf", "train_step"])
def test_the_report_tells_of_an_assembly_and_verify_reads_it(kind: str, request: pytest.FixtureRequest) -> None:
    file = request.getfixturevalue(kind)
    report = read_report(file.parent)
    (entry,) = [e for e in report["files"] if e["part"] is None]
    assert (entry["path"], entry["instances"]) == (file.name, list(IDS))
    assert entry["verified"]
    assert entry["measured"]["max_deviation"] <= entry["max_error"] <= entry["tolerance"]
    assert entry["measured"]["max_displacement"] < 1e-9
    assert {key: i["part"] for key, i in report["instances"].items()} == IDS
    for key, expected in places(file.parent).items():
        assert report["instances"][key]["at"] == pytest.approx(expected[:, 3].tolist(), abs=1e-9)
    assert [m["second"] for m in report["checks"]["mates"]] == ["left", "right"]
    assert run("verify", file) == 0


@pytest.mark.heavy
def test_both_assemblies_keep_their_bytes_in_any_process(train_step: Path, train_3mf: Path, tmp_path: Path) -> None:
    """In this process, where a good many occurrences have been written since, and in a fresh one."""
    exports = (STEP, THREEMF)
    made(tmp_path, *exports, name="other", verify=False)
    here = made(tmp_path / "out", *exports, verify=False)
    scene = here.parents[1] / "train.toml"
    command = [sys.executable, "-m", "exporters", "build", str(scene), "--out", str(tmp_path / "b"), "--no-verify"]
    subprocess.run(command, check=True, capture_output=True)
    for file in (train_step, train_3mf):
        assert (here / file.name).read_bytes() == file.read_bytes()
        assert (tmp_path / "b" / "train" / file.name).read_bytes() == file.read_bytes()


def test_assemblies_beside_parts_keep_their_own_names(tmp_path: Path) -> None:
    """A scene of a part's name, two assemblies, and one of chosen parts."""
    some = {**THREEMF, "name": "planets", "parts": ["planet"]}
    folder = made(tmp_path, {"format": "3mf"}, {**THREEMF, "name": "all"}, some, name="sun", verify=False)
    assert {p.name for p in folder.glob("*.3mf")} == {"sun.3mf", "planet.3mf", "sun.all.3mf", "sun.planets.3mf"}
    entries = {e["path"]: e for e in read_report(folder)["files"]}
    assert entries["sun.planets.3mf"]["instances"] == ["left", "right", "free"]
    assert run("verify", *folder.glob("*.3mf")) == 0
    folder = made(tmp_path / "out", {"format": "3mf"}, THREEMF, name="sun", verify=False)
    assert {p.name for p in folder.glob("*.3mf")} == {"sun.3mf", "planet.3mf", "sun.assembly.3mf"}


def test_a_build_of_one_part_leaves_the_assembly_as_it_is(tmp_path: Path) -> None:
    folder = made(tmp_path, {"format": "3mf"}, THREEMF, verify=False)
    before = (folder / "train.3mf").read_bytes()
    assert run("build", tmp_path / "train.toml", "--out", tmp_path / "out", "--part", "sun") == 0
    assert (folder / "train.3mf").read_bytes() == before
    report = read_report(folder)
    assert {"what": "exports[2]", "why": "an assembly of all its parts was not asked for"} in report["left_out"]
    assert run("verify", folder / "train.3mf") == 0


@pytest.mark.heavy
def test_a_scene_in_another_script_gets_an_ascii_title(tmp_path: Path) -> None:
    pytest.importorskip("OCP", reason="the CAD kernel is an extra", exc_type=ImportError)
    folder = made(tmp_path, STEP, THREEMF, name="передача 2")
    assert re.search(r"PRODUCT\('_+2'", (folder / "передача 2.step").read_text(encoding="ascii"))
    assert run("verify", folder / "передача 2.step", folder / "передача 2.3mf") == 0


def test_an_offset_shrinks_the_parts_and_not_the_places(tmp_path: Path) -> None:
    """Sixty metres away too, where doubles are coarser."""
    assert "60.0, 1.0" in TRAIN
    folder = made(tmp_path, {**THREEMF, "offset": -0.05}, text=TRAIN.replace("60.0, 1.0", "60000.0, 1.0"))
    (entry,) = read_report(folder)["files"]
    assert entry["offset"] == -0.05
    assert entry["measured"]["max_displacement"] < 1e-9
    assert run("verify", folder / "train.3mf") == 0


def test_sub_assemblies_and_what_a_list_says_stand_in_step(tmp_path: Path) -> None:
    """A sub-assembly is a product, equal parts are written once; the read-back holds the tree and the words."""
    from exporters.formats.read_step import ReadSolid, read_step_assembly
    from exporters.production.recheck import recheck

    scene = tmp_path / "дерево 2.toml"
    scene.write_text(
        """
[parts.pin]
kind = "pin"
diameter = 5.0
length = 20.0
title = { en = "Pin", uk = "\u0428\u0442\u0438\u0444\u0442" }
position = 7
standard = "ISO 2338"

[parts.base]
kind = "plate"
width = 60.0
height = 40.0
designation = "AB.01"

[instances]
base = { at = [0, 0, -10] }
left = { part = "pin", at = [-20, 0, 0], subassembly = "pins" }
right = { part = "pin", at = [20, 0, 0], subassembly = "pins" }
alone = { part = "pin", at = [0, 0, 0] }

[[exports]]
format = "step"
assembly = true
""",
        encoding="utf-8",
    )
    assert run("build", scene, "--out", tmp_path, "-q") == 0
    file = tmp_path / "дерево 2" / "дерево 2.step"
    found = read_step_assembly(file)
    assert {o.name: o.within for o in found.occurrences} == {"base": "", "left": "pins", "right": "pins", "alone": ""}
    solids = {p.name: p.part for p in found.prototypes if isinstance(p.part, ReadSolid)}
    said = {name: solid.said["description"] for name, solid in solids.items()}
    assert {solid.said.get("title") for solid in solids.values()} == {None, "7 Pin"}
    assert said == {"base": "AB.01", "pin": "ISO 2338; \u0428\u0442\u0438\u0444\u0442"}
    text = file.read_text(encoding="ascii")
    # its name in the letters of Part 21
    assert "PRODUCT('_______2'" in text
    assert text.count("=MANIFOLD_SOLID_BREP(") == 2
    for old, new in (("'pins'", "'other'"), ("'AB.01'", "'AB.02'"), ("\\X2\\0428", "\\X2\\0429")):
        assert old in text
        file.write_text(text.replace(old, new), encoding="ascii")
        assert recheck(file).verdict.failures
