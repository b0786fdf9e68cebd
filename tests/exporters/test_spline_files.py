"""Files of splined bores and shafts: their mate has the clearance that was told, and what is not so is caught."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import ezdxf
import pytest

from exporters.formats.read_dxf import read_dxf
from geometry.base.record import replace
from geometry.plane.measure import profile_area
from parts.base.refusal import SceneError
from parts.keys.spline_probe import SplineProbe
from parts.keys.splines import InvoluteSplineTable, StraightSplineTable
from parts.scene.load import make_parts, scene_from_dict
from tests.exporters.making import read_report, run, write_scene
from tests.sampling import some_of

TABLES: dict[str, StraightSplineTable | InvoluteSplineTable] = {
    "straight": StraightSplineTable("D-6x23x26", clearance=0.2, angle_deg=40.0),
    "involute": InvoluteSplineTable("20x1", clearance=0.15),
}
BORES: dict[str, dict[str, Any]] = {
    "straight": {"shape": "spline", "size": "D-6\u044523\u044526", "clearance": 0.2, "angle_deg": 40.0},
    "involute": {"shape": "involute_spline", "size": "20\u04451", "clearance": 0.15},
}
EXPORTS = ({"format": "dxf"}, {"format": "dxf", "name": "cut", "kerf": 0.2}, {"format": "svg"}, {"format": "stl"},
           {"format": "step"})  # fmt: skip


SHAFTS: dict[str, dict[str, Any]] = {
    "straight": {"steps": [{"diameter": 21.0, "length": 4.0, "chamfer": 1.0},
                           {"diameter": 26.0, "length": 20.0, "spline": BORES["straight"]},
                           {"diameter": 30.0, "length": 5.0, "chamfer": 0.5}], "centre_holes": {"diameter": 3.0}},
    "involute": {"steps": [{"diameter": 19.8, "length": 12.0, "spline": BORES["involute"]},
                           {"diameter": 15.0, "length": 8.0, "fillet": 1.0}], "bore_diameter": 10.0},
}  # fmt: skip


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the files of both, one with a chamfer."""
    root = tmp_path_factory.mktemp("spline")
    roller = {"kind": "roller", "diameter": 40.0, "face_width": 6.0}
    parts = {name: roller | {"bore": bore} for name, bore in BORES.items()}
    parts["straight"]["face_chamfer"] = 0.5
    assert run("build", write_scene(root / "s.toml", parts, EXPORTS), "--out", root / "out") == 0
    return root / "out" / "s"


def test_shafts_have_the_clearance_and_the_volume_of_their_sections(tmp_path: Path) -> None:
    """STEP, whose cylinders are true, STL, and the outline of the one whose spline is seen along the axis."""
    exports = ({"format": "step"}, {"format": "stl"}, {"format": "dxf"})
    scene = write_scene(tmp_path / "s.toml", {n: {"kind": "shaft"} | s for n, s in SHAFTS.items()}, exports)
    assert run("build", scene, "--out", tmp_path / "out") == 0
    for entry in read_report(tmp_path / "out" / "s")["files"]:
        name, is_flat = entry["part"], entry["format"] == "dxf"
        assert ("spline_gap" in entry["measured"]) == (not is_flat or name == "involute")
        if "spline_gap" in entry["measured"]:
            off = entry["max_error"] + 1e-6
            assert entry["measured"]["spline_gap"] == pytest.approx(TABLES[name].clearance, abs=off)
        if entry["format"] == "step":
            bore = TABLES[name].bore()
            area = profile_area(bore.joint.shaft().outline(-bore.clearance))
            assert entry["measured"]["volume"] == pytest.approx(AROUND[name](area), rel=1e-9)


# rows of steps, each diameter, length and spline: of eight and of sixteen teeth, whose sides stand at 45 degrees too;
# side by side, the smaller one within the roots of the larger; the same involutes twice
ROWS: dict[str, list[tuple[float, float, str]]] = {
    "eight": [(36.0, 12.0, "d-8x32x36")],
    "sixteen": [(60.0, 12.0, "d-16x52x60")],
    "side_by_side": [(19.8, 9.0, "20x1"), (36.0, 12.0, "d-8x32x36"), (26.0, 10.0, "D-6x23x26"), (19.8, 8.0, "20x1")],
    "twice": [(19.8, 9.0, "20x1"), (15.0, 5.0, ""), (19.8, 7.0, "20x1")],
}


def test_shafts_of_several_splines_and_of_any_number_of_teeth_are_whole(tmp_path: Path) -> None:
    """Every plane, cylinder and involute is found in the STEP, whose volume is that of all sections."""
    parts: dict[str, dict[str, Any]] = {}
    drawn = dict(some_of(ROWS.items(), 2))
    wanted = dict.fromkeys(drawn, 0.0)
    for name, row in drawn.items():
        steps = []
        for diameter, length, size in row:
            shape = "spline" if "-" in size else "involute_spline"
            steps.append(
                {"diameter": diameter, "length": length} | ({"spline": {"shape": shape, "size": size}} if size else {})
            )
            table = StraightSplineTable(size) if "-" in size else InvoluteSplineTable(size) if size else None
            area = profile_area(table.bore().joint.shaft().outline()) if table else math.pi / 4 * diameter**2
            wanted[name] += length * area
        parts[name] = {"kind": "shaft", "steps": steps}
    scene = write_scene(tmp_path / "s.toml", parts, ({"format": "step"}, {"format": "stl"}))
    assert run("build", scene, "--out", tmp_path / "out") == 0
    for entry in read_report(tmp_path / "out" / "s")["files"]:
        near = 1e-9 if entry["format"] == "step" else 2e-3
        assert entry["measured"]["volume"] == pytest.approx(wanted[entry["part"]], rel=near)


def frustum(low: float, high: float, length: float) -> float:
    return math.pi / 3 * length * (low * low + low * high + high * high)


def centre_hole() -> float:
    """Cone of 60 degrees from 2.12 diameters, pilot one diameter deep, tip of 120 degrees."""
    mouth, pilot = 3.18, 1.5
    return (
        frustum(mouth, pilot, (mouth - pilot) / math.tan(math.pi / 6))
        + 3.0 * math.pi * pilot**2
        + frustum(pilot, 0.0, pilot / math.tan(math.pi / 3))
    )


AROUND: dict[str, Callable[[float], float]] = {
    "straight": lambda area: 20.0 * area + frustum(9.5, 10.5, 1.0) + 3.0 * math.pi * 10.5**2
    + 2 * frustum(14.5, 15.0, 0.5) + 4.0 * math.pi * 15.0**2 - 2 * centre_hole(),
    # the fillet is a square turned about the axis less a quarter of a circle (Pappus)
    "involute": lambda area: 12.0 * (area - 25 * math.pi) + 8.0 * math.pi * (7.5**2 - 25)
    + math.tau * (8.0 - (math.pi / 4) * (8.5 - 4 / 3 / math.pi)),
}  # fmt: skip


@pytest.mark.parametrize(
    ("changes", "key", "code", "cure"),
    [({1: {"diameter": 25.0}}, "steps[2].diameter", "not_over_spline", 26.0),
     ({1: {"chamfer": 1.0}}, "steps[2].chamfer", "chamfer_of_spline", None),
     ({0: {"diameter": 24.0}}, "steps[1].diameter", "ends_amid_spline", None),
     # tips of 25 mm beside roots of 23 mm
     ({0: {"diameter": 25.0, "chamfer": 0.0, "spline": {"shape": "spline", "size": "6x21x25"}}}, "steps[1].diameter",
      "ends_amid_spline", None),
     ({1: {"spline": {"shape": "spline", "size": "6x23x27"}}}, "steps[2].spline.size", "no_such_spline", "d-6x23x26"),
     ({1: {"spline": {"shape": "spline", "teeth": 6}}}, "steps[2].spline.inner_diameter", "one_of_two_is_missing",
      None)],
)  # fmt: skip
def test_what_no_shaft_has_is_refused(changes: dict[int, Any], key: str, code: str, cure: object) -> None:
    steps = [step | changes.get(k, {}) for k, step in enumerate(SHAFTS["straight"]["steps"])]
    with pytest.raises(SceneError) as caught:
        make_parts(scene_from_dict({"parts": {"a": {"kind": "shaft", "steps": steps}}}, "t", "t"), "t")
    assert (caught.value.key, caught.value.code) == (f"parts.a.{key}", code)
    assert (caught.value.nearest and caught.value.nearest.value) == cure


def test_what_a_splined_step_cannot_have_is_told_as_it_was_typed() -> None:
    steps = [dict(step) for step in SHAFTS["straight"]["steps"]]
    steps[1]["keyways"] = [{"at": 3.0, "length": 10.0}]
    with pytest.raises(SceneError, match=re.escape("keyways = [{ at = 3.0, length = 10.0 }]: must be")):
        make_parts(scene_from_dict({"parts": {"a": {"kind": "shaft", "steps": steps}}}, "t", "t"), "t")


def test_the_chamfer_of_a_splined_step_goes_where_the_refusal_says() -> None:
    """Onto a step thinner than the roots, 23 mm; the words name that size."""
    pilot = {"diameter": 22.9, "length": 2.0, "chamfer": 1.0}
    toothed = {"diameter": 26.0, "length": 20.0, "spline": {"shape": "spline", "size": "6x23x26"}}
    with pytest.raises(SceneError, match=re.escape("thinner than its roots, 23 mm")):
        make_parts(
            scene_from_dict({"parts": {"a": {"kind": "shaft", "steps": [toothed | {"chamfer": 1.0}]}}}, "t", "t"), "t"
        )
    # of a fit with play they are thinner by twice as much as it is told
    loose = toothed | {"spline": {"shape": "spline", "size": "6x23x26", "clearance": 0.2}, "chamfer": 1.0}
    with pytest.raises(SceneError, match=re.escape("thinner than its roots, 22.6 mm")):
        make_parts(scene_from_dict({"parts": {"a": {"kind": "shaft", "steps": [loose]}}}, "t", "t"), "t")
    sheet = {"format": "svg", "purpose": "part", "drawing": {"requirements": ["Chamfer of the teeth 1 x 45."]}}
    told = {"parts": {"a": {"kind": "shaft", "steps": [pilot, toothed]}}, "exports": [sheet]}
    made, *_ = make_parts(scene_from_dict(told, "t", "t"), "t")
    assert "a" in made


def test_the_shaft_has_the_clearance_that_was_asked_for(built: Path) -> None:
    files = read_report(built)["files"]
    assert len(files) == 10
    for entry in files:
        wanted, off = TABLES[entry["part"]].clearance - entry["offset"], entry["max_error"] + 1e-6
        assert entry["measured"]["spline_gap"] == pytest.approx(wanted, abs=off)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", TABLES)
def test_another_shaft_is_caught(built: Path, name: str) -> None:
    """One that stands a tenth of a degree aslant, one that is looser, and one that is thicker."""
    bore, file = TABLES[name].bore(), read_dxf(built / f"{name}.laser.dxf")
    (good,) = TABLES[name].probes(3.0)
    assert good.run(file, 0.0, 5e-3).failures == ()
    thick = {"width": 6.02} if name == "straight" else {"thickness": bore.joint.thickness + 0.02}
    for other in (
        replace(bore, angle=bore.angle + 0.0017),
        replace(bore, clearance=bore.clearance + 0.006),
        replace(bore, joint=replace(bore.joint, **thick)),
    ):
        (failure,) = SplineProbe(other, 3.0).run(file, 0.0, 5e-3).failures
        assert "clearance" in failure


@pytest.mark.parametrize("name", TABLES)
def test_the_last_slot_alone_is_caught(built: Path, tmp_path: Path, name: str) -> None:
    """The one slot before the first stands 0.05 mm beside its place."""
    bore = TABLES[name].bore()
    (probe,) = TABLES[name].probes(3.0)
    document = ezdxf.readfile(built / f"{name}.laser.dxf")
    rows = document.modelspace().query("LWPOLYLINE")
    outline = min(rows, key=lambda row: max(math.hypot(x, y) for x, y in row.get_points("xy")))
    pitch, points = math.tau / bore.joint.teeth, outline.get_points("xyb")
    last = cmath.rect(1.0, bore.angle - pitch)
    turn, spoiled = cmath.rect(1.0, 0.05 / bore.reach), list[tuple[float, float, float]]()
    for x, y, bulge in points:
        place = complex(x, y)
        place *= turn if abs(cmath.phase(place / last)) < pitch / 2 and abs(place) > bore.reach - 0.4 else 1.0
        spoiled.append((place.real, place.imag, bulge))
    assert 0 < sum(new != tuple(old) for new, old in zip(spoiled, points, strict=True)) < 20
    outline.set_points(spoiled, format="xyb")
    document.saveas(tmp_path / "spoiled.dxf")
    (failure,) = probe.run(read_dxf(tmp_path / "spoiled.dxf"), 0.0, 5e-3).failures
    assert "clearance" in failure
