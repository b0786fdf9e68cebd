"""Drawing DXF and STEP: measured with the brute-force rack, valid for their readers, spoiled files caught."""

from __future__ import annotations

import math
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest

from exporters.verification.judge import verify_file
from parts.scene.formats import FILE_KINDS
from parts.scene.load import load_scene, make_parts
from tests.exporters.making import build_gear, part_keys, run, write_scene
from tests.exporters.outside import Gear
from tests.oracles.rack_sweep import RackTool, outline_error

GEARS = {
    "plain": Gear(2.0, 23, bore=8.0),
    "undercut": Gear(3.0, 8, bore=6.0),
    "shifted": Gear(1.0, 40, shift=0.87, bore=5.0),
}
DRAWING = {"format": "dxf", "purpose": "drawing"}
STEP = {"format": "step"}


def spline_points(file: Path, count: int = 200) -> np.ndarray:
    """Points on every spline of the first tooth of a drawing, evaluated by ezdxf."""
    found = []
    for entity in list(ezdxf.readfile(file).modelspace().query("SPLINE"))[:4]:
        tool = entity.construction_tool()
        knots = np.asarray(tool.knots())
        found += [complex(p.x, p.y) for p in tool.points(np.linspace(knots[0], knots[-1], count))]
    return np.array(found)


def rack_error(points: np.ndarray, gear: Gear) -> float:
    """Greatest distance of points from the outline that a brute-force rack leaves."""
    tool = RackTool(
        gear.module, math.radians(gear.angle_deg), gear.addendum, gear.clearance, gear.tip_rounding, gear.shift
    )
    return float(np.max(outline_error(points, tool, gear.teeth, gear.tip_radius)))


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", GEARS)
def test_a_drawing_keeps_a_nanometre_on_flank_and_fillet(tmp_path: Path, name: str) -> None:
    gear = GEARS[name]
    (entry,) = build_gear(tmp_path, gear, DRAWING)["files"]
    worst = rack_error(spline_points(tmp_path / "out" / "s" / "g.dxf"), gear)
    assert 0 < worst <= entry["max_error"] <= 1e-6
    assert entry["max_error"] <= 2 * worst + 1e-13 * gear.tip_radius


def test_a_drawing_holds_true_splines_arcs_and_circles(tmp_path: Path) -> None:
    build_gear(tmp_path, GEARS["plain"], DRAWING)
    drawing = ezdxf.readfile(tmp_path / "out" / "s" / "g.dxf")
    assert drawing.dxfversion == "AC1024"
    assert drawing.header["$INSUNITS"] == 4
    assert not drawing.audit().has_errors
    kinds = sorted(e.dxftype() for e in drawing.modelspace())
    assert [kinds.count(k) for k in ("ARC", "CIRCLE", "SPLINE")] == [2 * 23, 1, 4 * 23]
    assert len(kinds) == 7 * 23 - 23 + 1
    for spline in drawing.modelspace().query("SPLINE"):
        assert spline.dxf.degree == 3
        assert len(spline.control_points) > 3
        assert len(spline.fit_points) == 0


def spoil_spline(entities: list[Any]) -> None:
    middle = entities[len(entities) // 2]
    poles = [tuple(p) for p in middle.control_points]
    poles[len(poles) // 2] = (poles[len(poles) // 2][0] + 4e-6, poles[len(poles) // 2][1], 0.0)
    middle.control_points = poles


def spoil_end(entities: list[Any]) -> None:
    first = entities[0]
    poles = [tuple(p) for p in first.control_points]
    poles[0] = (poles[0][0] + 1e-6, poles[0][1], 0.0)
    first.control_points = poles


def spoil_by_loss(entities: list[Any]) -> None:
    entities[-1].destroy()


def spoil_layer(entities: list[Any]) -> None:
    entities[-1].dxf.layer = "0"


@pytest.mark.sampled(2)
@pytest.mark.parametrize("spoil", [spoil_spline, spoil_end, spoil_by_loss, spoil_layer])
def test_a_spoiled_drawing_is_caught(tmp_path: Path, spoil: Any) -> None:
    build_gear(tmp_path, GEARS["plain"], DRAWING)
    file = tmp_path / "out" / "s" / "g.dxf"
    assert run("verify", file) == 0
    drawing = ezdxf.readfile(file)
    spoil(list(drawing.modelspace().query("SPLINE")))
    drawing.saveas(file)
    assert run("verify", file) == 1


def test_a_step_is_made_and_read_back_without_the_kernel(tmp_path: Path) -> None:
    scene = write_scene(tmp_path / "s.toml", {"g": part_keys(GEARS["plain"])}, [STEP])
    code = "import sys; sys.modules['OCP'] = None; from exporters.command.cli import main; "
    code += "scene, out, file = sys.argv[1:]; sys.exit(main(['build', scene, '--out', out]) or main(['verify', file]))"
    files = [str(scene), str(tmp_path / "out"), str(tmp_path / "out" / "s" / "g.step")]
    subprocess.run([sys.executable, "-c", code, *files], check=True, capture_output=True)


@pytest.fixture(scope="module")
def step_build(tmp_path_factory: pytest.TempPathFactory) -> Path:
    pytest.importorskip("OCP", reason="the CAD kernel is an extra", exc_type=ImportError)
    folder = tmp_path_factory.mktemp("step")
    build_gear(folder, GEARS["plain"], STEP)
    return folder / "out" / "s" / "g.step"


def test_a_step_keeps_a_nanometre_under_220_kb(step_build: Path) -> None:
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.GeomAbs import GeomAbs_CurveType
    from OCP.STEPControl import STEPControl_Reader
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    reader = STEPControl_Reader()
    reader.ReadFile(str(step_build))
    reader.TransferRoots()
    edges, points = TopExp_Explorer(reader.OneShape(), TopAbs_ShapeEnum.TopAbs_EDGE), []
    while edges.More():
        curve = BRepAdaptor_Curve(TopoDS.Edge_s(edges.Current()))
        if curve.GetType() == GeomAbs_CurveType.GeomAbs_BSplineCurve:
            for t in np.linspace(curve.FirstParameter(), curve.LastParameter(), 12):
                place = curve.Value(float(t))
                points.append(complex(place.X(), place.Y()))
        edges.Next()
    assert len(points) > 12 * 4 * 23
    assert rack_error(np.array(points), GEARS["plain"]) <= 1e-6
    assert step_build.stat().st_size < 220_000
    text = step_build.read_text()
    # all tips lie in one cylinder, all roots in one, and the bore in one
    assert text.count("CYLINDRICAL_SURFACE(") == 3
    assert "PRODUCT('g'" in text
    assert "AUTOMOTIVE_DESIGN" in text


def test_a_step_has_the_exact_volume_and_verifies(step_build: Path) -> None:
    assert run("verify", step_build) == 0
    from exporters.production.report import read_report

    report = read_report(step_build.parent)
    assert report is not None
    assert abs(report["files"][0]["measured"]["volume_error"]) < 1e-7


@pytest.mark.parametrize("number", ["NAN", "-inf", "nan(0x1)", "1.E+400"])
def test_a_step_with_what_is_no_number_is_refused_at_once(step_build: Path, tmp_path: Path, number: str) -> None:
    text = step_build.read_text()
    lines = list(re.finditer(r"CARTESIAN_POINT\('',\(([-+.E\d]+),", text))
    middle = lines[len(lines) // 2]
    file = tmp_path / "g.step"
    file.write_text(text[: middle.start(1)] + number + text[middle.end(1) :])
    parts = make_parts(load_scene(str(step_build.parents[2] / "s.toml")), "s")[0]
    (failure,) = verify_file(file, FILE_KINDS["step"], parts["g"].body(0.0), 1e-6, 1e-6, "g").failures
    assert "CARTESIAN_POINT" in failure or "beyond any length" in failure


@pytest.mark.parametrize("spoil", ["pole 0", "pole 1", "pole 2", "truncate", "other"])
def test_a_spoiled_step_is_caught(step_build: Path, tmp_path: Path, spoil: str) -> None:
    text = step_build.read_text()
    if spoil == "truncate":
        text = text[: len(text) // 2]
    elif spoil.startswith("pole"):
        # a flank's spline stands in the file for each of its ends
        splines = re.findall(r"B_SPLINE_CURVE_WITH_KNOTS\('',7,\((.*?)\)", text, re.DOTALL)
        pole = splines[int(spoil[-1])].split(",")[4].strip()
        line = re.search(rf"{pole}=CARTESIAN_POINT\('',\(([-+.E\d]+),", text)
        assert line is not None
        text = text[: line.start(1)] + repr(float(line[1]) + 1e-4) + text[line.end(1) :]
    file = tmp_path / "g.step"
    file.write_text(text)
    parts = make_parts(load_scene(str(step_build.parents[2] / "s.toml")), "s")[0]
    body = parts["g"].body(-0.001 if spoil == "other" else 0.0)
    assert verify_file(file, FILE_KINDS["step"], body, 1e-6, 1e-6).failures


def test_a_step_has_the_same_bytes_in_another_process_and_after_another(step_build: Path, tmp_path: Path) -> None:
    scene = step_build.parents[2] / "s.toml"
    build_gear(tmp_path, GEARS["undercut"], STEP)
    assert run("build", scene, "--out", tmp_path / "a") == 0
    command = [sys.executable, "-m", "exporters", "build", str(scene), "--out", str(tmp_path / "b"), "--no-verify"]
    subprocess.run(command, check=True, capture_output=True)
    expected = step_build.read_bytes()
    assert (tmp_path / "a" / "s" / "g.step").read_bytes() == expected
    assert (tmp_path / "b" / "s" / "g.step").read_bytes() == expected
