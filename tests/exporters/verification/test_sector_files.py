"""Files of sector gears: against shapely's wedges and offsets, and spoiled ones that are caught."""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from shapely.geometry import Polygon

from geometry.gears.teeth.basic_rack import iso_53
from geometry.gears.teeth.sector import Sector
from geometry.gears.teeth.spur import SpurGear
from tests.exporters.making import Keys, dxf_chains, read_report, run, stl_triangles, svg_chains, write_scene
from tests.exporters.outside import Chain
from tests.exporters.spoil import change_dxf, change_stl, corner_shifted, dropped, flattened_or_bent, moved
from tests.geometry.gears.teeth.test_sector import expected

WIDTH = 5.0
GEAR: Keys = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 24, "face_width": WIDTH, "bore_diameter": 8.0}
SECTORS: dict[str, tuple[dict[str, Any], Sector]] = {
    "cut": ({"teeth": 6, "rest": "cut", "hub_diameter": 14.0, "corner_radius": 0.8},
            Sector(6, -2, 1, None, 14.0, 0.8)),
    "runs": ({"teeth": 4, "runs": 2, "blank_diameter": 38.0, "corner_radius": 0.4}, Sector(4, -1, 2, 38.0, None, 0.4)),
    "blank": ({"teeth": 9, "first_tooth": 3}, Sector(9, 3)),
}  # fmt: skip
EXPORTS: list[Keys] = [{"format": "dxf"}, {"format": "svg", "kerf": 0.2}, {"format": "stl"}, {"format": "3mf"},
                       {"format": "step"}, {"format": "dxf", "purpose": "drawing", "name": "d"}]  # fmt: skip


def shape(chain: Chain) -> Polygon:
    """A file's outline with its arcs cut into fine chords."""
    points = []
    for start, end, sweep in zip(chain.vertices, np.roll(chain.vertices, -1), chain.sweeps, strict=True):
        if sweep == 0:
            points.append(np.array([start]))
            continue
        centre = (start + end) / 2 + 1j * (end - start) / (2 * math.tan(sweep / 2))
        count = max(2, math.ceil(abs(sweep) / 0.002))
        points.append(centre + (start - centre) * np.exp(1j * sweep * np.arange(count) / count))
    whole = np.concatenate(points)
    return Polygon(np.column_stack([whole.real, whole.imag]))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All of them, built once."""
    place = tmp_path_factory.mktemp("sectors")
    parts = {name: GEAR | {"sector": table} for name, (table, _) in SECTORS.items()}
    assert run("build", write_scene(place / "s.toml", parts, EXPORTS), "--out", place / "out") == 0
    return place / "out" / "s"


@cache
def outline(name: str, offset: float = 0.0) -> Any:
    made = SpurGear(2.0, 24, iso_53("A"), sector=SECTORS[name][1])
    return expected(made).buffer(offset, quad_segs=100)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", SECTORS)
def test_files_hold_the_wedge_of_the_gear(folder: Path, name: str) -> None:
    """Cut outlines, one moved by half of the kerf; the mesh's volume."""
    cut = max((shape(c) for c in dxf_chains(folder / f"{name}.laser.dxf")), key=lambda p: p.area)
    assert cut.symmetric_difference(outline(name)).area < 0.005 * cut.length
    (kerf,) = [f for f in folder.glob(f"{name}*.svg") if "preview" not in f.name]
    moved_out = max((shape(c) for c in svg_chains(kerf)), key=lambda p: p.area)
    middle = np.array(moved_out.bounds).reshape(2, 2).mean(axis=0)
    asked = outline(name, 0.1)
    assert moved_out.area == pytest.approx(asked.area, rel=2e-4)
    assert np.array(moved_out.bounds) - np.tile(middle, 2) == pytest.approx(
        np.array(asked.bounds) - np.tile(np.array(asked.bounds).reshape(2, 2).mean(axis=0), 2), abs=0.006
    )
    corners = stl_triangles(folder / f"{name}.stl").corners.astype(float)
    volume = float(np.einsum("ni,ni->n", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6)
    asked_volume = WIDTH * (outline(name).area - 16 * math.pi)
    # chords of 0.01 mm all along
    assert volume == pytest.approx(asked_volume, abs=0.01 * WIDTH * (outline(name).length + 8 * math.pi))


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", SECTORS)
@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_spoiled_files_are_caught(folder: Path, tmp_path: Path, name: str, share: float) -> None:
    """A vertex moved, an arc bent, one left out; a corner of a mesh: at the start, in the middle, at the end."""
    for file in folder.iterdir():
        (tmp_path / file.name).write_bytes(file.read_bytes())
    dxf, stl = tmp_path / f"{name}.laser.dxf", tmp_path / f"{name}.stl"
    assert run("verify", dxf, stl) == 0
    outer = max(range(2), key=lambda k: len(dxf_chains(dxf)[k].vertices))
    for change in (moved, flattened_or_bent, dropped):
        dxf.write_bytes((folder / dxf.name).read_bytes())
        change_dxf(dxf, outer, change, share)
        assert run("verify", dxf) == 1
    change_stl(stl, corner_shifted, share, 0.01)
    assert run("verify", stl) == 1


def test_every_file_is_read_back(folder: Path) -> None:
    found = read_report(folder)["files"]
    assert len([f for f in found if not f.get("failures")]) == len(found) >= 3 * len(EXPORTS)


def test_the_blank_of_a_ring_is_read_back_as_it_is(tmp_path: Path) -> None:
    """Before: places on its long arcs were held against the outside of the rim, which a quick look took for nearer."""
    ring: Keys = {"kind": "ring_gear", "module": 0.5, "number_of_teeth": 60, "face_width": WIDTH,
                  "sector": {"teeth": 2, "blank_diameter": 33.53}}  # fmt: skip
    assert run("build", write_scene(tmp_path / "s.toml", {"g": ring}, [{"format": "step"}]), "--out", tmp_path) == 0


SHARP: dict[str, Keys] = {
    "runs": GEAR | {"sector": {"teeth": 4, "runs": 2, "blank_diameter": 38.0}},
    "cut": GEAR | {"sector": {"teeth": 6, "rest": "cut", "hub_diameter": 14.0}},
    "ring": {"kind": "ring_gear", "module": 2.0, "number_of_teeth": 24, "face_width": WIDTH,
             "sector": {"teeth": 4, "runs": 2, "blank_diameter": 60.0}},
}  # fmt: skip


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", SHARP)
def test_sharp_corners_of_a_rest_stay_sharp_at_a_face_chamfer(tmp_path: Path, name: str) -> None:
    """The lower face of the STL holds what shapely's mitre leaves of the upper one. Before: any depth was refused."""
    part = SHARP[name] | {"face_chamfer": {"below": 0.5}}
    scene = write_scene(tmp_path / "s.toml", {"g": part}, [{"format": "stl", "tolerance": 0.004}])
    assert run("build", scene, "--out", tmp_path) == 0
    (file,) = tmp_path.glob("s/*.stl")
    corners = stl_triangles(file).corners.astype(float)
    below, above = (
        shapely.union_all([Polygon(c[:, :2]) for c in corners if np.ptp(c[:, 2]) == 0 and c[0, 2] == z])
        for z in (0.0, WIDTH)
    )
    wanted = above.buffer(-0.5, join_style="mitre", mitre_limit=20.0)
    assert below.symmetric_difference(wanted).area < 0.006 * wanted.length
    # rounded corners are seen
    assert (
        below.symmetric_difference(above.buffer(-0.5)).area > wanted.symmetric_difference(above.buffer(-0.5)).area / 2
    )


@pytest.mark.heavy
def test_the_long_sides_of_a_helical_sector_are_sliced_beside_a_chamfer(tmp_path: Path) -> None:
    """14 mm long, they ask for finer slices than were tried: no tolerance could be met."""
    part = SHARP["cut"] | {"helix_angle_deg": 15.0, "face_chamfer": {"below": 0.4}}
    assert run("build", write_scene(tmp_path / "s.toml", {"g": part}, [{"format": "stl"}]), "--out", tmp_path) == 0
