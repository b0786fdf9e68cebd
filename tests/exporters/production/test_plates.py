"""Plates and coupons: what a printer and a laser get, measured on the files by trimesh, shapely and ezdxf."""

from __future__ import annotations

import copy
import itertools
import json
import math
import re
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import shapely

from exporters.command.cli import main
from exporters.production import plates
from exporters.production.plan import plan_build
from exporters.production.recheck import recheck
from parts.base.refusal import SceneError
from parts.keys.boards import BedSpec
from parts.scene.load import scene_from_toml
from tests.exporters.production.test_boards import contours, pieces_of, polygon

if TYPE_CHECKING:
    import trimesh

BED = """
[parts.ring]
kind = "pin"
diameter = 40.0
bore_diameter = 30.0
length = {length}
[parts.bar]
kind = "plate"
width = {width}
height = 10.0
face_width = 4.0
[beds.printer]
width = 80.0
depth = 80.0
height = 50.0
copies = {{ bar = 4, ring = 3 }}
{more}
[[exports]]
format = "3mf"
purpose = "plate"
"""


def scene(folder: Path, *, width: float = 60.0, length: float = 5.0, more: str = "") -> Path:
    file = folder / "set.toml"
    file.write_text(BED.format(width=width, length=length, more=more), encoding="utf-8")
    return file


def meshes(file: Path) -> dict[str, trimesh.Trimesh]:
    """Every item of a 3MF in its place, read from its text alone."""
    import trimesh

    text = zipfile.ZipFile(file).read("3D/3dmodel.model").decode()
    objects = {}
    for number, body in re.findall(r'<object id="(\d+)"[^>]*>(.*?)</object>', text, re.S):
        corners = [[float(x) for x in row] for row in re.findall(r'<vertex x="(.*?)" y="(.*?)" z="(.*?)"', body)]
        faces = [[int(x) for x in row] for row in re.findall(r'<triangle v1="(\d+)" v2="(\d+)" v3="(\d+)"', body)]
        objects[number] = (np.array(corners), np.array(faces))
    found = {}
    for item in re.findall(r"<item [^>]*>", text):
        said = dict(re.findall(r'(\w+)="(.*?)"', item))
        number, name, place = said["objectid"], said["partnumber"], said["transform"]
        rows = np.array([float(x) for x in place.split()]).reshape(4, 3)
        corners, faces = objects[number]
        found[name] = trimesh.Trimesh(corners @ rows[:3] + rows[3], faces, process=False)
    return found


def test_plates_lie_on_the_bed_and_apart(tmp_path: Path) -> None:
    assert main(["build", str(scene(tmp_path)), "--out", str(tmp_path), "--quiet"]) == 0
    files = sorted((tmp_path / "set").glob("set.plate.*.3mf"))
    for file in files:
        # what lies on each stands in its picture: a shape for each piece, words on it, a row of the legend
        picture = file.with_suffix(".preview.svg").read_text("utf-8")
        pieces = [piece["part"] for piece in pieces_of(tmp_path / "set", file.name)["pieces"].values()]
        assert picture.count("<path ") == len(pieces)
        for part, kind in {"ring": "Pin", "bar": "Plate"}.items():
            assert len(re.findall(rf">\d {kind}</text>", picture)) == pieces.count(part)
            told = re.findall(rf">\d: {pieces.count(part)} × {kind} {part}</text>", picture)
            assert len(told) == (part in pieces)
    names: list[str] = []
    for file in files:
        found = meshes(file)
        names += found
        hulls = []
        for mesh in found.values():
            assert mesh.is_watertight
            low, high = mesh.bounds
            assert abs(low[2]) <= 1e-6
            assert min(*low[:2], *(80 - high[:2])) >= 5 - 1e-6
            hulls.append(shapely.MultiPoint(mesh.vertices[:, :2]).convex_hull)
        assert min((a.distance(b) for a, b in itertools.combinations(hulls, 2)), default=9.0) >= 2 - 1e-6
        assert recheck(file).verdict.failures == ()
    assert sorted(names) == ["bar_1", "bar_2", "bar_3", "bar_4", "ring_1", "ring_2", "ring_3"]
    # what is kept is measured as trimesh and shapely have it, and bounds are held to within the declared error
    report = json.loads((tmp_path / "set" / "report.json").read_text("utf-8"))
    for file in files:
        (declared,) = (entry["max_error"] for entry in report["files"] if entry["path"] == file.name)
        measured, solids = recheck(file).verdict.measured, meshes(file)
        corners = np.concatenate([mesh.vertices for mesh in solids.values()])
        assert measured["height"] == pytest.approx(corners[:, 2].max(), abs=1e-6)
        margin = min(corners[:, :2].min(), 80 - corners[:, :2].max())
        assert measured["least_margin"] == pytest.approx(margin, abs=1e-6)
        flat = [shapely.MultiPoint(mesh.vertices[:, :2]).convex_hull for mesh in solids.values()]
        gap = min((a.distance(b) for a, b in itertools.combinations(flat, 2)), default=9.0)
        if gap < 3.0:
            assert measured["least_gap"] == pytest.approx(gap, abs=1e-6)
        for key, value, sign in (("gap", gap, 1), ("margin", margin, 1), ("height", measured["height"], -1)):
            for share, well in ((0.4, True), (1.6, False)):
                if value < 9.0 or key != "gap":
                    told = copy.deepcopy(report)
                    told["scene"]["beds"]["printer"][key] = value + sign * share * declared
                    (tmp_path / "set" / "report.json").write_text(json.dumps(told), encoding="utf-8")
                    assert (recheck(file).verdict.failures == ()) is well, (key, share)
    (tmp_path / "set" / "report.json").write_text(json.dumps(report), encoding="utf-8")
    # a wider gap than the one that was kept is noticed, and a narrower bed
    for key, value in (("gap", 4.0), ("width", 70.0), ("height", 4.0)):
        report = json.loads((tmp_path / "set" / "report.json").read_text("utf-8"))
        report["scene"]["beds"]["printer"][key] = value
        (tmp_path / "set" / "report.json").write_text(json.dumps(report), encoding="utf-8")
        assert any(recheck(file).verdict.failures for file in files)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("keys", "words"), [
    ({"width": 100.0, "length": 100.0}, "ring (0.5) and bar (0.6"), ({"width": 140.0}, "bar (0.49"),
])  # fmt: skip
def test_parts_too_large_for_a_bed_are_named_with_their_scale(
    keys: dict[str, Any], words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["build", str(scene(tmp_path, **keys)), "--out", str(tmp_path)]) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert words.split(" and ", maxsplit=1)[0] in told
    assert words.rsplit(" and ", maxsplit=1)[-1] in told
    assert not (tmp_path / "set").exists()
    # the bed that it names is the least one, to 1 mm
    (sides,) = re.findall(r"(\d+) x (\d+) x (\d+) mm", told)
    bed = dict(zip(("width", "depth", "height"), map(int, sides), strict=True))
    text = (tmp_path / "set.toml").read_text("utf-8")
    for less, code in ((0, 0), (1, 2)):
        for key, side in bed.items():
            text = re.sub(rf"\[beds(.*)\b{key} = \d+", rf"[beds\g<1>{key} = {side - less}", text, flags=re.S)
        (tmp_path / "set.toml").write_text(text, encoding="utf-8")
        assert main(["build", str(tmp_path / "set.toml"), "--out", str(tmp_path), "--quiet", "--no-verify"]) == code


def test_the_kerf_coupon_tells_the_kerf(tmp_path: Path) -> None:
    """Cut k wide, the plug of 10 mm fits the slot that is named k without play."""
    assert main(["build", "kerf_coupon", "--out", str(tmp_path), "--quiet", "--format", "dxf", "--no-verify"]) == 0
    file = tmp_path / "kerf_coupon" / "kerf_coupon.board.1.dxf"
    rings = [polygon(rows) for _, rows in contours(file)]
    pieces = pieces_of(file.parent, file.name)["pieces"]
    (plug,) = (ring for ring in rings if ring.area == pytest.approx(100 + 25 * math.pi, rel=1e-3))
    kerfs = []
    for name, piece in pieces.items():
        if not name.startswith("kerf"):
            continue
        at = shapely.Point(piece["at"])
        slot = min((ring for ring in rings if ring.contains(at)), key=lambda ring: ring.area)
        sides = sorted((slot.bounds[2] - slot.bounds[0], slot.bounds[3] - slot.bounds[1]))
        kerf = int(piece["part"].removeprefix("kerf_")) / 100
        assert sides[0] + kerf == pytest.approx(10 - kerf, abs=1e-6)
        cut, left = slot.buffer(kerf / 2, 64), plug.buffer(-kerf / 2, 64)
        assert cut.area == pytest.approx(left.area, rel=1e-3)
        kerfs.append(kerf)
    assert sorted(kerfs) == pytest.approx([0.06 + 0.02 * k for k in range(16)])


@pytest.mark.heavy
def test_the_fit_coupon_has_its_fits(tmp_path: Path) -> None:
    import trimesh

    assert main(["build", "fit_coupon", "--out", str(tmp_path), "--quiet", "--no-verify"]) == 0
    (file,) = (tmp_path / "fit_coupon").glob("*.plate.*.3mf")
    found = meshes(file)

    def section(name: str) -> shapely.Polygon:
        mesh = found[name]
        mesh.apply_translation([*-mesh.bounds.mean(axis=0)[:2], 0.0])
        lines = trimesh.intersections.mesh_plane(mesh, [0, 0, 1], [0, 0, 2.0])[:, :, :2].round(9)
        faces = shapely.get_parts(shapely.polygonize([shapely.MultiLineString(list(lines))]))
        return max(faces, key=lambda face: shapely.Polygon(face.exterior).area)

    bores = [math.sqrt(4 * shapely.Polygon(hole).area / math.pi) for hole in section("bores_1").interiors]
    assert sorted(bores) == pytest.approx([8 + k / 10 for k in range(7)], abs=0.02)
    for k in range(5):
        (hexagon,) = section(f"hexagon_{80 + k}_1").interiors
        # 2 sqrt(3) r^2 about a circle of radius r
        assert 2 * math.sqrt(shapely.Polygon(hexagon).area / (2 * math.sqrt(3))) == pytest.approx(8 + k / 10, abs=1e-3)
    # teeth are thinner on the circle of 36 mm by half of j_bn / cos(20 deg), which is the same on both of a pair
    circle = shapely.Point(0, 0).buffer(18, 512).exterior
    thick = [shapely.Polygon(section(f"gear_{k}_1").exterior).intersection(circle).length / 18 for k in range(1, 6)]
    backlash = np.array([0.05, 0.1, 0.15, 0.2, 0.3])
    # the reference thickness is half of the pitch; chords of 0.002 mm stand within both flanks, alike on all
    off = np.array(thick) - (math.pi - backlash / 2 / math.cos(math.radians(20)))
    assert np.abs(off).max() <= 0.005
    assert np.ptp(off) <= 1e-4


FEET = {
    "long": (shapely.box(-10.0, 3.0, 20.2, 103.0), -2.0, 8.5),
    "tall": (shapely.box(5.0, 5.0, 65.0, 25.0), 0.5, 40.75),
    "small": (shapely.box(0.0, 0.0, 9.0, 8.0), 0.0, 3.0),
}


@pytest.mark.parametrize(("bed", "key", "parts"), [
    # 50 - 10 mm for 100 and for 60; 30 mm for 40.25
    ((50.0, 50.0, 30.0), "width", ["long (0.4)", "tall (0.6666)"]), ((200.0, 200.0, 30.0), "height", ["tall (0.7453)"]),
    ((110.0, 60.0, 40.0), "height", ["tall (0.9937)"]),
    # 100 mm across 59 or along 99: the depth lacks 1 mm, the width 41; the other way round on a bed that is turned
    ((69.0, 109.0, 60.0), "depth", ["long (0.99)"]), ((109.0, 69.0, 60.0), "width", ["long (0.99)"]),
])  # fmt: skip
def test_a_bed_that_is_too_small_is_refused_with_the_least_that_holds_all(
    bed: tuple[float, float, float], key: str, parts: list[str]
) -> None:
    """30.2 x 100 and 60 x 20 mm lie in 100 x 30.2, 5 mm of margin all round: 110 x 41; 40.25 mm are 41."""
    width, depth, height = bed
    spec = BedSpec(width=width, depth=depth, height=height, margin=5.0, gap=2.0)
    with pytest.raises(SceneError) as refused:
        plates._laid_out(spec, FEET, dict.fromkeys(FEET, 1), "s", "beds.b")
    error = refused.value
    assert (error.key, error.value, error.code) == (f"beds.b.{key}", getattr(spec, key), "too_small_for_parts")
    assert [error.numbers[name] for name in ("width", "depth", "height")] == [110, 41, 41]
    assert re.findall(r"\w+ \([\d.]+\)", str(error)) == parts


def test_what_is_named_instead_of_a_small_bed_holds_all() -> None:
    enough = BedSpec(width=110.0, depth=41.0, height=41.0, margin=5.0, gap=2.0)
    assert plates._laid_out(enough, FEET, dict.fromkeys(FEET, 1), "s", "beds.b")


OFFSET = """
[parts.a]
kind = "spur_gear"
module = 2.0
number_of_teeth = 17
face_width = 4.0
[beds.printer]
width = 80.0
depth = 80.0
height = 50.0
[[exports]]
format = "3mf"
purpose = "plate"
offset = {offset}
"""


@pytest.mark.sampled(1)
@pytest.mark.parametrize("offset", [1e-6, 1e-5])
def test_an_offset_of_almost_nothing_lies_as_the_gear_itself(offset: float) -> None:
    """Where an undercut tooth has edges as long: before, a traceback of outlines that cross."""
    feet = []
    for moved in (offset, 0.0):
        scene = scene_from_toml(OFFSET.format(offset=moved).encode(), "s.toml", "s")
        (plate,) = (job for job in plan_build(scene, "s.toml", [], []).assemblies if isinstance(job, plates.PlateJob))
        feet.append(plate.feet["a"])
    assert feet[0].hausdorff_distance(feet[1]) <= plates._CHORDS[0]


def test_every_piece_is_set_down_on_the_bed(monkeypatch: pytest.MonkeyPatch) -> None:
    """What reaches 2.5 mm below its origin is lifted by so much."""
    whole = plates._footprint
    monkeypatch.setattr(plates, "_footprint", lambda *job: (whole(*job)[0], -2.5, whole(*job)[2]))
    text = BED.format(width=60.0, length=5.0, more="")
    found = plan_build(scene_from_toml(text.encode(), "s.toml", "s"), "s", [], []).assemblies
    laid = [job for job in found if isinstance(job, plates.PlateJob)]
    assert {piece.at[2] for plate in laid for piece in plate.instances} == {2.5}
