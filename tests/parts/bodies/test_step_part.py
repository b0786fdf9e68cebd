"""A STEP file of one's own as a part: bodies of the CAD kernel's own making, their volume, place and interference."""

from __future__ import annotations

import json
import math
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from exporters.command.cli import main
from exporters.production.plan import plan_build
from geometry.solids.area import surface_area
from parts.base.refusal import SceneError
from parts.scene.interference import solid_overlaps
from parts.scene.load import load_scene, make_parts
from parts.scene.placing import place
from parts.scene.scene_file import ExportSpec
from parts.solids.kernel import KernelError, edges_of, has_kernel, kernel_errors, silent_kernel, solids_of

pytestmark = pytest.mark.skipif(not has_kernel(), reason="the CAD kernel is an extra")
# a box of 40 x 40 x 30 with a round shaft of 5 x 20 on it, in a place of its own
BOX, RADIUS, LENGTH, ASIDE = (40.0, 40.0, 30.0), 2.5, 20.0, (7.0, -3.0, 11.0)
SHAFT = math.pi * RADIUS**2 * LENGTH
VOLUME = math.prod(BOX) + SHAFT
# of the centre of gravity above the box's lower face
HIGH = (math.prod(BOX) * BOX[2] / 2 + SHAFT * (BOX[2] + LENGTH / 2)) / VOLUME
SCENE = """
[parts.motor]
kind = "step_part"
file = "bought/motor.step"
origin = [27.0, 17.0, 41.0]
density = 2.0
colour = "#404040"
title = "Двигун"

[parts.gear]
kind = "spur_gear"
module = 1.0
number_of_teeth = 20
face_width = 8.0
bore_diameter = 5.0

[[mates]]
kind = "{mate}"
first = "motor"
second = "gear"
{height}

[checks]
interference = true

[[exports]]
format = "step"
assembly = true

[[exports]]
format = "stl"

[[exports]]
format = "3mf"
assembly = true
"""


def motor() -> Any:
    """The body by the kernel's own booleans."""
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Fuse
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox, BRepPrimAPI_MakeCylinder
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

    x, y, z = ASIDE
    box = BRepPrimAPI_MakeBox(gp_Pnt(x, y, z), *BOX).Shape()
    foot = gp_Ax2(gp_Pnt(x + BOX[0] / 2, y + BOX[1] / 2, z + BOX[2] / 2), gp_Dir(0, 0, 1))
    shaft = BRepPrimAPI_MakeCylinder(foot, RADIUS, BOX[2] / 2 + LENGTH).Shape()
    return BRepAlgoAPI_Fuse(box, shaft).Shape()


def written(file: Path, shape: Any, unit: str = "MM") -> None:
    """A shape by the kernel's own writer."""
    from OCP.Interface import Interface_Static
    from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer

    file.parent.mkdir(exist_ok=True)
    with silent_kernel():
        writer = STEPControl_Writer()
        Interface_Static.SetCVal_s("write.step.unit", unit)
        writer.Transfer(shape, STEPControl_StepModelType.STEPControl_AsIs)
        writer.Write(str(file))
        Interface_Static.SetCVal_s("write.step.unit", "MM")


def scene_in(folder: Path, mate: str = "fixed", height: str = "offset = [0.0, 0.0, 5.0]") -> Path:
    """The scene of a gear on a motor, beside the motor's file."""
    written(folder / "bought" / "motor.step", motor())
    file = folder / "driven.toml"
    file.write_text(SCENE.format(mate=mate, height=height), encoding="utf-8")
    return file


def alone(folder: Path, name: str = "body.step", more: str = "") -> Any:
    """The part of a scene with nothing else."""
    file = folder / "alone.toml"
    file.write_text(f'[parts.body]\nkind = "step_part"\nfile = "{name}"\n{more}', encoding="utf-8")
    return make_parts(load_scene(str(file)), str(file))[0]["body"]


def kernel_box(shape: Any) -> list[float]:
    """Corners of the box about a shape, by the kernel."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib

    box = Bnd_Box()
    BRepBndLib.AddOptimal_s(shape, box, False, False)
    return list(box.Get())


def test_a_motor_with_its_gear_is_built_verified_and_read_by_the_kernel(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = scene_in(tmp_path)
    assert main(["build", str(scene), "--out", str(tmp_path / "o")]) == 0
    made = tmp_path / "o" / "driven"
    body, gear = solids_of((made / "driven.step").read_text("ascii"))
    # the origin lies in the middle of the box's upper face
    half = BOX[0] / 2
    assert kernel_box(body) == pytest.approx([-half, -half, -BOX[2], half, half, LENGTH], abs=1e-6)
    assert kernel_box(gear)[2::3] == pytest.approx([5.0, 13.0], abs=1e-6)
    part = json.loads((made / "report.json").read_text("utf-8"))["parts"]["motor"]
    assert part["mass"] == pytest.approx(2.0 * VOLUME / 1000, rel=1e-9)
    # what was built is verified without the file that it came from, wherever that has gone
    (tmp_path / "bought" / "motor.step").unlink()
    monkeypatch.chdir(made)
    for file in ("driven.step", "driven.3mf", "motor.stl"):
        assert main(["verify", file]) == 0, file


def test_its_volume_and_place_are_the_kernel_s_in_any_unit(tmp_path: Path) -> None:
    for unit in ("MM", "INCH", "M"):
        written(tmp_path / "body.step", motor(), unit)
        moments = alone(tmp_path).body(0.0).moments
        assert moments.volume == pytest.approx(VOLUME, rel=1e-9)
        assert moments.centre == pytest.approx([27.0, 17.0, 11.0 + HIGH], abs=1e-7)


def test_its_drawing_is_refused_by_its_key(tmp_path: Path) -> None:
    scene = load_scene(str(scene_in(tmp_path)))
    for parts, key in ((["motor"], "exports[1].parts"), (["gear"], ""), (None, "")):
        scene.exports = [ExportSpec(format="dxf", purpose="part", parts=parts)]
        if not key:
            assert [job.path for job in plan_build(scene, "driven", [], []).sheets] == ["gear.part.dxf"]
            continue
        with pytest.raises(SceneError) as caught:
            plan_build(scene, "driven", [], [])
        assert (caught.value.key, caught.value.code) == (key, "no_working_drawing")


def test_its_axis_becomes_z(tmp_path: Path) -> None:
    written(tmp_path / "body.step", motor())
    turned = alone(tmp_path, more="origin = [27, 17, 11]\naxis = [0, 0, -2]\n").body(0.0)
    assert turned.moments.centre == pytest.approx([0.0, 0.0, -HIGH], abs=1e-7)
    # z is laid on x about y, so that the file's z is the part's -x, before that is turned about z
    laid = alone(tmp_path, more="origin = [7, 17, 11]\naxis = [1, 0, 0]\nrotation_deg = 90\n").body(0.0)
    assert laid.moments.centre == pytest.approx([0.0, HIGH, 20.0], abs=1e-7)
    with pytest.raises(SceneError, match="axis"):
        alone(tmp_path, more="axis = [0, 0, 0]\n")


@pytest.mark.parametrize(
    ("mate", "height", "common"),
    [
        ("fixed", "offset = [0.0, 0.0, 5.0]", 0.0),
        ("coaxial", "height = 0.0", 0.0),
        # 4 mm of the gear about its bore lie in the box
        ("coaxial", "height = -4.0", None),
    ],
)
def test_what_runs_into_it_is_found(tmp_path: Path, mate: str, height: str, common: float | None) -> None:
    scene = load_scene(str(file := scene_in(tmp_path, mate, height)))
    parts, matings = make_parts(scene, str(file))
    found = solid_overlaps(place(scene.instances, [], parts, matings, str(file)), parts)
    if common == 0:
        assert found == ()
        return
    gear = parts["gear"].made_by.moments(parts["gear"].body(0.0)).volume
    assert [o.volume for o in found] == [pytest.approx(gear / 2, rel=5e-3)]


def _shapes() -> dict[str, Callable[[], Any]]:
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse
    from OCP.BRepBuilderAPI import (
        BRepBuilderAPI_MakeEdge,
        BRepBuilderAPI_MakeFace,
        BRepBuilderAPI_MakeWire,
        BRepBuilderAPI_NurbsConvert,
    )  # fmt: skip
    from OCP.BRepFilletAPI import BRepFilletAPI_MakeFillet
    from OCP.BRepOffsetAPI import BRepOffsetAPI_MakePipe, BRepOffsetAPI_ThruSections
    from OCP.BRepPrimAPI import (
        BRepPrimAPI_MakeBox,
        BRepPrimAPI_MakeCone,
        BRepPrimAPI_MakeCylinder,
        BRepPrimAPI_MakePrism,
        BRepPrimAPI_MakeRevol,
        BRepPrimAPI_MakeSphere,
        BRepPrimAPI_MakeTorus,
    )  # fmt: skip
    from OCP.GC import GC_MakeArcOfCircle
    from OCP.GeomAPI import GeomAPI_Interpolate, GeomAPI_PointsToBSpline
    from OCP.gp import gp_Ax1, gp_Ax2, gp_Circ, gp_Dir, gp_Pnt, gp_Vec
    from OCP.TColgp import TColgp_Array1OfPnt, TColgp_HArray1OfPnt

    def ball(at: float) -> Any:
        return BRepPrimAPI_MakeSphere(gp_Pnt(0, 0, at), 5.0).Shape()

    def rod(y: float, z: float) -> Any:
        return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, -30), gp_Dir(0, y, z)), 3.0, 100.0).Shape()

    def oval(z: float = 0.0, size: float = 1.0) -> Any:
        """Half an oval, a spline, and the line across it."""
        points = TColgp_Array1OfPnt(1, 9)
        for k in range(9):
            turn = math.pi * k / 8
            points.SetValue(k + 1, gp_Pnt(10 * size * math.cos(turn), 7 * size * math.sin(turn), z))
        curve = GeomAPI_PointsToBSpline(points).Curve()
        round_, across = BRepBuilderAPI_MakeEdge(curve), BRepBuilderAPI_MakeEdge(curve.EndPoint(), curve.StartPoint())
        return BRepBuilderAPI_MakeWire(round_.Edge(), across.Edge()).Wire()

    def prism(*way: float) -> Any:
        return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(oval()).Face(), gp_Vec(*way)).Shape()

    def loft() -> Any:
        made = BRepOffsetAPI_ThruSections(True, False)
        for z, size in ((0.0, 1.0), (5.0, 0.8), (10.0, 1.1)):
            made.AddWire(oval(z, size))
        return made.Shape()

    def vase() -> Any:
        """Circles joined smoothly: a spline that closes round itself, of which the kernel fails to say what it is."""
        made = BRepOffsetAPI_ThruSections(True, False)
        for z, radius in ((0.0, 10.0), (10.0, 6.0), (20.0, 9.0)):
            rim = BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(gp_Pnt(0, 0, z), gp_Dir(0, 0, 1)), radius))
            made.AddWire(BRepBuilderAPI_MakeWire(rim.Edge()).Wire())
        return made.Shape()

    def disc(y: float, radius: float) -> Any:
        """Across a pipe of radius 10 round z, or the straight one before it."""
        rim = BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(gp_Pnt(10, y, 0), gp_Dir(0, 1, 0), gp_Dir(0.3, 0, 1)), radius))
        return BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(rim.Edge()).Wire()).Face()

    def elbow(turn: float, radius: float = 2.5) -> Any:
        return BRepPrimAPI_MakeRevol(disc(0, radius), gp_Ax1(gp_Pnt(), gp_Dir(0, 0, 1)), turn).Shape()

    def pipe() -> Any:
        """A straight one and an elbow, hollow."""
        bow = GC_MakeArcOfCircle(gp_Pnt(10, 0, 0), gp_Pnt(math.sqrt(50), math.sqrt(50), 0), gp_Pnt(0, 10, 0)).Value()
        run = BRepBuilderAPI_MakeEdge(gp_Pnt(10, -20, 0), gp_Pnt(10, 0, 0)).Edge(), BRepBuilderAPI_MakeEdge(bow).Edge()
        spine = BRepBuilderAPI_MakeWire(*run).Wire()
        outer, inner = (BRepOffsetAPI_MakePipe(spine, disc(-20, radius)).Shape() for radius in (2.5, 1.5))
        return BRepAlgoAPI_Cut(outer, inner).Shape()

    def round_oval() -> Any:
        """A prism on a spline that closes smoothly."""
        points = TColgp_HArray1OfPnt(1, 8)
        for k in range(8):
            points.SetValue(k + 1, gp_Pnt(10 * math.cos(math.pi * k / 4), 7 * math.sin(math.pi * k / 4), 0))
        closed = GeomAPI_Interpolate(points, True, 1e-9)
        closed.Perform()
        rim = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(closed.Curve()).Edge()).Wire()
        return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(rim).Face(), gp_Vec(0, 0, 8)).Shape()

    drill = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, -9, 4), gp_Dir(0, 1, 0)), 1.5, 60.0).Shape()
    across = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(-30, 1, 2), gp_Dir(1, 0, 0)), 2.0, 60.0).Shape()
    aslant = BRepPrimAPI_MakeBox(
        gp_Ax2(gp_Pnt(-20, 3, -20), gp_Dir(0.3, 0.1, 1), gp_Dir(1, 0, -0.3)), 60, 60, 60
    ).Shape()
    box, round_rod = BRepPrimAPI_MakeBox(gp_Pnt(-20, -20, 0), 40, 40, 30).Shape(), rod(0, 1)
    torus = BRepPrimAPI_MakeTorus(gp_Ax2(gp_Pnt(0, 0, 10), gp_Dir(0, 0, 1)), 3.0, 1.0).Shape()
    cone = BRepPrimAPI_MakeCone(gp_Ax2(gp_Pnt(1, 2, 3), gp_Dir(0, 0.6, 0.8)), 5.0, 0.0, 9.0).Shape()

    def rounded() -> Any:
        made = BRepFilletAPI_MakeFillet(box)
        for edge in edges_of(box):
            made.Add(2.0, edge)
        return made.Shape()

    return {
        "ball": lambda: ball(0.0),
        "ring": lambda: torus,
        "cone": lambda: cone,
        "stump": lambda: BRepPrimAPI_MakeCone(2.0, 5.0, 9.0).Shape(),
        "dimple": lambda: BRepAlgoAPI_Cut(box, ball(30.0)).Shape(),
        "groove": lambda: BRepAlgoAPI_Cut(round_rod, torus).Shape(),
        "bore": lambda: BRepAlgoAPI_Cut(box, round_rod).Shape(),
        "prism": lambda: prism(0, 0, 8),
        "lean": lambda: prism(2, 1, 8),
        "loft": loft,
        "vase": vase,
        "trimmed": lambda: BRepAlgoAPI_Cut(prism(0, 0, 8), drill).Shape(),
        "rational": lambda: BRepBuilderAPI_NurbsConvert(round_rod).Shape(),
        "hollow": lambda: BRepAlgoAPI_Cut(box, ball(15.0)).Shape(),
        "ellipse": lambda: BRepAlgoAPI_Cut(box, rod(0.2, 1)).Shape(),
        "rational_cone": lambda: BRepBuilderAPI_NurbsConvert(cone).Shape(),
        "rational_ring": lambda: BRepBuilderAPI_NurbsConvert(torus).Shape(),
        "rational_ellipse": lambda: BRepBuilderAPI_NurbsConvert(BRepAlgoAPI_Cut(box, rod(0.2, 1)).Shape()).Shape(),
        "elbow": lambda: elbow(math.pi / 2),
        "long_elbow": lambda: elbow(4.0),
        "pipe": pipe,
        "round_oval": round_oval,
        # where two rods cross, and a torus is cut aslant, edges are the kernel's splines
        "crossed": lambda: BRepAlgoAPI_Cut(round_rod, across).Shape(),
        "cut_elbow": lambda: BRepAlgoAPI_Cut(elbow(math.pi / 2), aslant).Shape(),
        # a dome whose seam ends at a rib: its pole stands among other bounds
        "ribbed_dome": lambda: BRepAlgoAPI_Fuse(
            BRepPrimAPI_MakeSphere(10.0, 0.0, math.pi / 2).Shape(),
            BRepPrimAPI_MakeBox(gp_Pnt(-12, -1, 0), 24, 2, 4).Shape(),
        ).Shape(),
        "half_ring": lambda: BRepPrimAPI_MakeTorus(10.0, 2.5, math.pi).Shape(),
        # faces that are more than half of the tube
        "flat_ring": lambda: BRepAlgoAPI_Cut(
            torus, BRepPrimAPI_MakeBox(gp_Pnt(-9, -9, 10.6), 18, 18, 9).Shape()
        ).Shape(),
        # at each corner a part of a sphere with a vertex at its file's pole
        "rounded": rounded,
    }


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "name",
    ["ball", "ring", "cone", "stump", "dimple", "groove", "bore", "prism", "lean", "loft", "ellipse", "rational",
     "rational_cone", "rational_ring", "rational_ellipse", "rounded", "elbow", "long_elbow", "pipe", "half_ring",
     "flat_ring", "round_oval", "crossed", "cut_elbow", "ribbed_dome", "vase"],
)  # fmt: skip
def test_solids_are_taken_over(name: str, tmp_path: Path) -> None:
    """Through a file of ours, read back and judged by the kernel too."""
    written(tmp_path / "body.step", _shapes()[name]())
    alone(tmp_path, more='\n[[exports]]\nformat = "step"\n\n[[exports]]\nformat = "stl"\ntolerance = 0.1\n')
    assert main(["build", str(tmp_path / "alone.toml"), "--out", str(tmp_path / "o"), "--verify", "kernel"]) == 0


def test_errors_of_the_kernel_are_told_as_such() -> None:
    """They have no type in common; others pass."""
    from OCP.gp import gp_Dir

    with pytest.raises(KernelError, match="zero norm"), kernel_errors():
        gp_Dir(0, 0, 0)
    with pytest.raises(ZeroDivisionError), kernel_errors():
        _ = 1 / 0


def test_the_area_of_an_elbow_is_told_and_read_back(tmp_path: Path) -> None:
    """By Pappus, where a seam of the torus runs round its axis."""
    for name, turn in (("elbow", math.pi / 2), ("long_elbow", 4.0), ("half_ring", math.pi)):
        written(tmp_path / "body.step", _shapes()[name]())
        solid = alone(tmp_path, more='\n[[exports]]\nformat = "step"\n').body(0.0).within(1e-3).geometry
        assert surface_area(solid) == pytest.approx(2 * math.pi * 2.5 * (10 * turn + 2.5), rel=1e-12)
        assert main(["build", str(tmp_path / "alone.toml"), "--out", str(tmp_path / "o")]) == 0, name


def test_a_face_whose_bounds_end_beyond_its_spline_is_taken_over(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By rounding, as of the wheel of our own bevel pair: 1.1e-9, of which the kernel makes no trimmed surface."""
    import OCP.BRepTools

    kernel: Any = OCP.BRepTools.BRepTools

    class Wide(kernel):
        """Bounds that begin too early."""

        @staticmethod
        def UVBounds_s(face: Any) -> tuple[float, ...]:
            """As the kernel finds them, but for the first."""
            first, *others = kernel.UVBounds_s(face)
            return (first - 5e-9, *others)

    written(tmp_path / "body.step", _shapes()["loft"]())
    volume = alone(tmp_path).body(0.0).moments.volume
    monkeypatch.setattr(OCP.BRepTools, "BRepTools", Wide)
    assert alone(tmp_path).body(0.0).moments.volume == pytest.approx(volume, rel=1e-9)


def test_rational_splines_become_what_they_are(tmp_path: Path) -> None:
    """Cylinders, planes and circles, whose volume is a closed form to the last digits; an ellipse is followed."""
    for name, volume in (("rational", 900 * math.pi), ("rational_cone", 75 * math.pi)):
        written(tmp_path / "body.step", _shapes()[name]())
        body = alone(tmp_path).body(0.0)
        assert not body.walls
        assert body.moments.volume == pytest.approx(volume, rel=1e-12)
    written(tmp_path / "body.step", _shapes()["ellipse"]())
    assert 0 < alone(tmp_path).body(0.0).within(1e-3).max_error < 1e-9


def test_a_pole_that_is_moved_is_found(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """In the file written of a loft, within its surface, by two tolerances across it."""
    written(tmp_path / "body.step", _shapes()["loft"]())
    alone(tmp_path, more='\n[[exports]]\nformat = "step"\n')
    assert main(["build", str(tmp_path / "alone.toml"), "--out", str(tmp_path / "o")]) == 0
    file = tmp_path / "o" / "alone" / "body.step"
    text = file.read_text("ascii")
    surface = re.search(r"B_SPLINE_SURFACE_WITH_KNOTS\('',\d,\d,\((.*?)\),\.UNSP", text, re.DOTALL)
    assert surface is not None
    rows = [row.split(",") for row in re.findall(r"\(([^)]*)\)", surface[1])]
    pole = rows[len(rows) // 2][len(rows[0]) // 2]
    moved = re.sub(
        rf"(\n{pole}=CARTESIAN_POINT\('',\()([^,]*),([^,]*)",
        lambda m: f"{m[1]}{float(m[2]) + 1e-5:.8f},{float(m[3]) + 1e-5:.8f}", text,
    )  # fmt: skip
    assert moved != text
    file.write_text(moved, "ascii")
    assert main(["verify", str(file)]) == 1
    assert "deviates by" in capsys.readouterr().out


def test_what_is_not_one_such_solid_is_refused_in_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Compound

    def refusal(name: str = "body.step", entity: str = "") -> str:
        with pytest.raises(SceneError) as told:
            alone(tmp_path, name)
        assert "\n" not in str(told.value)
        assert re.search(entity, str(told.value))
        return told.value.code

    pair, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(pair)
    for name in ("ball", "stump"):
        builder.Add(pair, _shapes()[name]())
    for shape, code, entity in (
        (pair, "step_several", "solid = 1 to 2"),
        (_shapes()["hollow"](), "step_hollow", ""),
        (_shapes()["trimmed"](), "step_trimmed", r"#\d+ SURFACE_OF_LINEAR_EXTRUSION"),
    ):
        written(tmp_path / "body.step", shape)
        assert refusal(entity=entity) == code
    written(tmp_path / "body.step", pair)
    volumes = [alone(tmp_path, more=f"solid = {k}\n").body(0.0).moments.volume for k in (1, 2)]
    assert volumes == pytest.approx([math.pi * 500 / 3, math.pi * 9.0 * 39 / 3], rel=1e-9)
    with pytest.raises(SceneError, match=r"body\.solid.*2 solids"):
        alone(tmp_path, more="solid = 3\n")
    (tmp_path / "body.step").write_text("no STEP file", encoding="utf-8")
    assert refusal() == "step_solids"
    # the kernel comes to no end of it; in a name it is none
    (tmp_path / "body.step").write_text("#1=POINT('1.E999',(1.E400,2.,3.));", encoding="utf-8")
    assert refusal(entity="number 1.E400") == "step_number"
    (tmp_path / "body.step").write_bytes(b"0" * 8_000_001)
    assert refusal() == "too_large_step"
    assert refusal("none.step") == "no_such_file"
    (tmp_path / "folder.step").mkdir()
    assert refusal("folder.step") == "unreadable"
    for elsewhere in ("../body.step", "/body.step", "C:/body.step", "a/../../body.step", "..\\\\body.step"):
        assert refusal(elsewhere) == "file_elsewhere", elsewhere
    assert refusal("motor.stl") == "not_allowed"
    written(tmp_path / "body.step", motor())
    monkeypatch.setitem(sys.modules, "OCP.IFSelect", None)
    assert refusal() == "needs_kernel"
