"""Files of wheels with holes across their hubs: against trimesh's topology and shapely's sections; wrong ones fail."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
import trimesh
from manifold3d import Manifold, Mesh

from exporters.formats.read_stl import read_stl
from tests.exporters.making import Keys, read_report, run, write_scene

SCREWS: Keys = {"diameter": 2.5, "count": 2, "angle_deg": 90.0, "spacing_deg": 100.0}
HUB: Keys = {"diameter": 12.0, "above": 7.0, "set_screws": SCREWS}
GEAR: Keys = {"kind": "spur_gear", "module": 1.0, "number_of_teeth": 17, "face_width": 4.0}
PARTS: dict[str, Keys] = {
    "pinion": GEAR | {"bore_diameter": 5.0, "face_chamfer": 0.3, "hub": HUB | {"below": 2.0}},
    "helical": GEAR | {"bore": {"shape": "D", "diameter": 5.0, "flat": 4.5}, "helix_angle_deg": 20.0,
                       "hub": HUB | {"above": 0.0, "below": 6.0, "set_screws": SCREWS | {"count": 1}}},
    "pulley": {"kind": "timing_pulley", "belt": "GT2", "number_of_teeth": 20, "face_width": 7.0, "bore_diameter": 5.0,
               "flanges": {"diameter": 16.0}, "hub": HUB | {"diameter": 15.0}},
    "disk": {"kind": "ratchet_wheel", "module": 3.0, "number_of_teeth": 12, "face_width": 4.0,
             "bore": {"shape": "hexagon", "across_flats": 6.0},
             "hub": HUB | {"set_screws": SCREWS | {"spacing_deg": 120.0}}},
}  # fmt: skip
EXPORTS: list[Keys] = [
    {"format": "stl", "tolerance": 0.02, "name": "print"},
    {"format": "stl", "tolerance": 0.02, "name": "wide", "offset": -0.1, "parts": ["pinion", "helical"]},
    {"format": "step"},
    {"format": "svg", "purpose": "part", "parts": ["pinion"]},
]
# heights of the holes' axes
LEVELS = {"pinion": 4 + 7 - 3.65, "helical": -3.0, "pulley": 9 + 3.5, "disk": 4 + 3.5}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All of them, built once."""
    place = tmp_path_factory.mktemp("screws")
    assert run("build", write_scene(place / "s.toml", PARTS, EXPORTS), "--out", place / "out") == 0
    return place / "out" / "s"


def stl_of(folder: Path, name: str, stem: str = ".print") -> Path:
    """One of a part's meshes; a lone one has no stem."""
    lone = folder / f"{name}.stl"
    return lone if lone.exists() else folder / f"{name}{stem}.stl"


def strips(name: str, radius: float) -> Any:
    """What the holes take of the section through their axes."""
    table = PARTS[name]["hub"]["set_screws"]
    found = []
    for k in range(table["count"]):
        way = np.exp(1j * math.radians(table["angle_deg"] + k * table["spacing_deg"]))
        corners = [way * complex(x, y) for x, y in ((0, -radius), (20, -radius), (20, radius), (0, radius))]
        found.append(shapely.Polygon([(c.real, c.imag) for c in corners]))
    return shapely.union_all(found)


def bore(name: str, widened: float) -> Any:
    """The section of a bore."""
    if name == "disk":
        corners = np.exp(1j * np.pi / 3 * np.arange(6)) * (3 + widened) / math.cos(math.pi / 6)
        return shapely.Polygon(np.column_stack([corners.real, corners.imag]))
    found = shapely.Point(0, 0).buffer(2.5 + widened, 256)
    return found & shapely.box(-9, -9, 9, 2 + widened) if name == "helical" else found


@pytest.mark.parametrize(
    ("name", "stem", "offset"),
    [*((name, ".print", 0.0) for name in PARTS), ("pinion", ".wide", -0.1), ("helical", ".wide", -0.1)],
)
def test_meshes_have_the_holes_where_they_are_told(folder: Path, name: str, stem: str, offset: float) -> None:
    mesh = trimesh.load(stl_of(folder, name, stem))
    count = PARTS[name]["hub"]["set_screws"]["count"]
    assert mesh.is_watertight
    # the bore is one handle, each hole one more
    assert mesh.euler_number == 2 - 2 * (1 + count)
    # what stands there is the ring of the hub between its holes, about the bore
    solid = Manifold(Mesh(np.asarray(mesh.vertices, np.float32), np.asarray(mesh.faces, np.uint32)))
    made = shapely.union_all([shapely.Polygon(loop) for loop in solid.slice(LEVELS[name]).to_polygons()])
    ring = shapely.Point(0, 0).buffer(PARTS[name]["hub"]["diameter"] / 2 + offset, 256)
    want = ring.difference(strips(name, 1.25 - offset)).difference(bore(name, -offset))
    assert shapely.symmetric_difference(want, made).area < 0.02 * want.length
    # what is read back has all corners of walls about holes, also where these are far off
    own, *holes = (shapely.Polygon(loop) for loop in solid.slice(1.0).to_polygons())
    read = sorted(loop.size for loop in read_stl(stl_of(folder, name, stem)).section(1.0))
    assert read == pytest.approx(sorted(loop.area for loop in (own, *holes)), rel=1e-5)


def test_what_is_told_of_the_files_is_the_parts_own(folder: Path) -> None:
    told = read_report(folder)
    for name in PARTS:
        volume = told["parts"][name]["volume"]
        mesh = trimesh.load(stl_of(folder, name))
        assert mesh.volume == pytest.approx(volume, rel=4e-3)
    for file in told["files"]:
        assert file["max_error"] <= file["tolerance"]


CHANGES: list[Keys] = [{"diameter": 2.6}, {"angle_deg": 91.0}, {"from_end": 3.0}, {"count": 1}]


@pytest.mark.parametrize(
    ("ending", "change"),
    [("step", CHANGES[1]), ("print.stl", CHANGES[0]),
     *(pytest.param("print.stl", change, marks=pytest.mark.heavy) for change in CHANGES[1:]),
     *(pytest.param("step", CHANGES[k], marks=pytest.mark.heavy) for k in (0, 2, 3))],
)  # fmt: skip
def test_files_of_other_holes_fail(folder: Path, tmp_path: Path, change: Keys, ending: str) -> None:
    file, report = (folder / name for name in (f"pinion.{ending}", "report.json"))
    told = json.loads(report.read_text("utf-8"))
    told["scene"]["parts"]["pinion"]["hub"]["set_screws"] |= change
    (tmp_path / file.name).write_bytes(file.read_bytes())
    (tmp_path / "report.json").write_text(json.dumps(told), "utf-8")
    assert run("verify", tmp_path / file.name) == 1


END, FOOT, FLAT = {"above": 7.0}, {"below": 7.0}, {"above": 7.0}
INSETS = {"end": (END, 2.5, 1.4), "foot": (FOOT, 2.5, 1.4), "flat": (FLAT, 2.9, 3.5)}


@pytest.mark.parametrize(
    ("inset", "offset", "builds"),
    [("end", -0.3, False), ("end", -0.1499, True), ("end", -0.1501, False), ("end", 1.3, False),
     ("foot", -0.1501, False), ("flat", -0.2, False), ("flat", -0.03, True)],
)  # fmt: skip
def test_an_offset_that_leaves_no_hub_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], inset: str, offset: float, builds: bool
) -> None:
    """The hole's edge stands 0.15 mm from an end of the hub, or 0.05 mm from that of a flat, which grows by 1.5."""
    side, diameter, from_end = INSETS[inset]
    hub = {"diameter": 14.0, **side, "set_screws": {"diameter": diameter, "from_end": from_end}}
    keys = GEAR | {"bore": {"shape": "D", "diameter": 5.0, "flat": 4.5}, "number_of_teeth": 24, "hub": hub}
    scene = write_scene(tmp_path / "s.toml", {"g": keys}, [{"format": "stl", "offset": offset, "tolerance": 0.05}])
    assert (run("build", scene, "--out", tmp_path / "out") == 0) == builds
    assert ("offset" in capsys.readouterr().err) != builds
