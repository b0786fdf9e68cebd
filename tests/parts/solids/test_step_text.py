"""STEP of every kind of body: its topology by brute force, its geometry by the CAD kernel, its size and its words."""

from __future__ import annotations

import re
from collections import Counter
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geometry.base.errors import GeometryError
from geometry.base.placement import Placement3
from geometry.solids.faces import Solid
from geometry.solids.mass import body_moments
from parts.base.part import Part
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict
from parts.solids.decimals import point_lines
from parts.solids.faces import solid_curves, solid_faces
from parts.solids.kernel import has_kernel
from parts.solids.step_text import StepForm, StepGroup, StepPart, real, step_text, string
from tests.parts.cams.barrel_cam.test_barrel_cam import CONE, END, GROOVE
from tests.sampling import examples

needs_kernel = pytest.mark.skipif(not has_kernel(), reason="needs the CAD kernel")
GEAR = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 23, "face_width": 20.0, "bore_diameter": 12.0}
SMALL = {**GEAR, "number_of_teeth": 9, "face_width": 6.0, "bore_diameter": 4.0}
HELICAL = {**GEAR, "helix_angle_deg": 30.0}
# the cylinders and cones are those of the tips, spaces, bores, holes, and chamfers of these
KINDS: dict[str, tuple[dict[str, Any], dict[str, int]]] = {
    "plain": (SMALL, {"Cylinder": 19, "SurfaceOfExtrusion": 36, "Plane": 2}),
    "keyway": ({**SMALL, "number_of_teeth": 14, "bore_diameter": 0.0,
                "bore": {"shape": "keyway", "diameter": 8.0}}, {}),
    "stepped": ({**GEAR, "number_of_teeth": 24, "face_width": 10.0, "web": {"thickness": 4.0, "rim_diameter": 36.0},
                 "hub": {"diameter": 20.0, "above": 3.0}}, {"Plane": 6}),
    "chamfered": ({**SMALL, "face_chamfer": {"below": 0.3}}, {}),
    "ring": ({"kind": "ring_gear", "module": 1.0, "number_of_teeth": 30, "face_width": 5.0}, {"Cylinder": 61}),
    "rack": ({"kind": "rack", "module": 2.0, "number_of_teeth": 3, "face_width": 8.0}, {"Cylinder": 6}),
    "helical": ({**SMALL, "helix_angle_deg": 20.0}, {"Cylinder": 19, "BSplineSurface": 36, "Plane": 2}),
    "double": ({**SMALL, "helix_angle_deg": 20.0, "double_helical": True}, {"Cylinder": 37, "BSplineSurface": 72}),
    "far": ({**SMALL, "helix_angle_deg": 45.0, "face_width": 60.0}, {}),
    "slanted": ({"kind": "rack", "module": 2.0, "number_of_teeth": 3, "helix_angle_deg": 20.0, "face_width": 8.0}, {}),
    "groove": (GROOVE, {}), "end": (END, {}), "cone": (CONE, {}),
}  # fmt: skip
# what OCCT 7.9 writes for such parts
WRITTEN = """ADVANCED_BREP_SHAPE_REPRESENTATION ADVANCED_FACE APPLICATION_CONTEXT APPLICATION_PROTOCOL_DEFINITION
AXIS2_PLACEMENT_3D B_SPLINE_CURVE_WITH_KNOTS B_SPLINE_SURFACE_WITH_KNOTS CARTESIAN_POINT CIRCLE CLOSED_SHELL COLOUR_RGB
CONICAL_SURFACE CONTEXT_DEPENDENT_SHAPE_REPRESENTATION CURVE_STYLE CYLINDRICAL_SURFACE DIRECTION
DRAUGHTING_PRE_DEFINED_CURVE_FONT EDGE_CURVE EDGE_LOOP FACE_BOUND FILL_AREA_STYLE FILL_AREA_STYLE_COLOUR
ITEM_DEFINED_TRANSFORMATION LINE MANIFOLD_SOLID_BREP MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION
NEXT_ASSEMBLY_USAGE_OCCURRENCE ORIENTED_EDGE PLANE PRESENTATION_STYLE_ASSIGNMENT PRODUCT PRODUCT_CONTEXT
PRODUCT_DEFINITION PRODUCT_DEFINITION_CONTEXT PRODUCT_DEFINITION_FORMATION PRODUCT_DEFINITION_SHAPE
PRODUCT_RELATED_PRODUCT_CATEGORY SHAPE_DEFINITION_REPRESENTATION SHAPE_REPRESENTATION STYLED_ITEM
SURFACE_OF_LINEAR_EXTRUSION SURFACE_SIDE_STYLE SURFACE_STYLE_FILL_AREA SURFACE_STYLE_USAGE TOROIDAL_SURFACE
SPHERICAL_SURFACE UNCERTAINTY_MEASURE_WITH_UNIT VECTOR VERTEX_POINT"""


def part_of(keys: dict[str, Any]) -> Part:
    return make_parts(scene_from_dict({"parts": {"p": keys}}, "test", "test"), "test")[0]["p"]


@cache
def made(name: str) -> tuple[Part, Solid, str]:
    """A part of the table, its faces, and its file within 1e-6 mm."""
    part = part_of(KINDS[name][0])
    body = part.body(0.0)
    solid = solid_faces(body, solid_curves(body, 9e-7))
    return part, solid, step_text(StepPart("p", solid, None), StepForm())


@pytest.mark.parametrize("digits", [8, 11])
def test_points_have_the_digits_of_pythons_own_numbers(digits: int) -> None:
    rng = np.random.default_rng(digits)
    odd = [0.0, -0.0, 0.5, -0.5, 10.0, -1e-12, 9.999999999999999, 99.95, -123456.789, 1e5, 1e-8, -3e-8, 6e-9]
    values = np.concatenate([odd, rng.uniform(-200, 200, 8), rng.integers(-99, 99, 3) / 8.0])
    expected = [f"{round(x, digits) + 0.0:.{digits}f}".rstrip("0") for x in values.tolist()]
    rows = zip(expected[::3], expected[1::3], expected[2::3], strict=True)
    wanted = "".join(f"#{95 + k}=CARTESIAN_POINT('',({','.join(row)}));\n" for k, row in enumerate(rows))
    assert point_lines(95, values.reshape(-1, 3), digits) == wanted


def check_closed(solid: Solid) -> None:
    """Every edge is run once each way, every loop is closed, and the shell is one, of a whole number of handles."""
    starts, ends = (np.concatenate([getattr(e, x) for e in solid.edges]) for x in ("start", "end"))
    uses: Counter[tuple[int, bool]] = Counter()
    # the bundle and row of each face by its edges: faces that share one are joined
    joined: list[list[int]] = []
    rings = 0
    for faces in solid.faces:
        for row in range(len(faces.loops[0][0])):
            own: list[int] = []
            for edges, senses in faces.loops:
                loop = list(zip(edges[row].tolist(), senses.tolist(), strict=True))
                uses.update(loop)
                way = [(starts[e], ends[e]) if along else (ends[e], starts[e]) for e, along in loop]
                assert all(a[1] == b[0] for a, b in zip(way, [*way[1:], way[0]], strict=True))
                own += [e for e, _ in loop]
            rings += len(faces.loops) - 1
            joined.append(own)
    assert set(uses.values()) == {1}
    assert set(uses) == {(e, way) for e in range(len(starts)) for way in (True, False)}
    by_edge: dict[int, set[int]] = {}
    for face, own in enumerate(joined):
        for edge in own:
            by_edge.setdefault(edge, set()).add(face)
    seen, waiting = {0}, [0]
    while waiting:
        for other in {f for edge in joined[waiting.pop()] for f in by_edge[edge]} - seen:
            seen.add(other)
            waiting.append(other)
    assert len(seen) == len(joined)
    # Euler and Poincare: vertices - edges + faces - inner loops = 2 - 2 handles
    genus, odd = divmod(2 - (len(solid.vertices) - len(starts) + len(joined) - rings), 2)
    assert odd == 0
    assert genus >= 0


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", KINDS)
def test_every_edge_is_run_once_each_way(name: str) -> None:
    _, solid, text = made(name)
    check_closed(solid)
    # and nothing stands in the file that is not used, nor is anything used that does not stand there
    there = set(re.findall(r"^#(\d+)=", text, re.MULTILINE))
    used = set(re.findall(r"#(\d+)(?![=\d])", text))
    roots = set(re.findall(r"^#(\d+)=(?:APPLICATION_PROT|SHAPE_DEFINITION_REP|PRODUCT_RELATED)", text, re.MULTILINE))
    assert used <= there
    assert there - used == roots
    assert set(re.findall(r"=([A-Z_0-9]+)\(", text)) <= set(WRITTEN.split())


@needs_kernel
@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", KINDS)
def test_the_kernel_calls_it_one_valid_solid_of_the_exact_volume(name: str, tmp_path: Path) -> None:
    from OCP.BRep import BRep_Tool
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps
    from OCP.ShapeAnalysis import ShapeAnalysis_ShapeTolerance
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer

    from parts.solids.kernel import faces_of, solids_of

    part, _, text = made(name)
    (solid,) = solids_of(text)
    assert BRepCheck_Analyzer(solid).IsValid()
    shells = TopExp_Explorer(solid, TopAbs_ShapeEnum.TopAbs_SHELL)
    assert BRep_Tool.IsClosed_s(shells.Current())
    shells.Next()
    assert not shells.More()
    assert ShapeAnalysis_ShapeTolerance().Tolerance(solid, 1) <= 1e-6
    found = GProp_GProps()
    BRepGProp.VolumePropertiesGK_s(solid, found, 1e-9)
    body = part.body(0.0)
    exact = body.moments.volume if body.is_faced else body_moments(body).volume
    assert abs(found.Mass() / exact - 1) < 1e-7
    kinds = Counter(BRepAdaptor_Surface(face).GetType().name.removeprefix("GeomAbs_") for face in faces_of(solid))
    expected = KINDS[name][1]
    assert {kind: kinds[kind] for kind in expected} == expected


@given(st.integers(5, 40), st.floats(0.3, 5), st.floats(-0.2, 0.6), st.sampled_from([0.0, 8.0, 30.0]), st.booleans())
@examples(12)
def test_random_gears_are_closed(teeth: int, module: float, shift: float, helix: float, double: bool) -> None:
    keys = {**GEAR, "number_of_teeth": teeth, "module": module, "profile_shift_coefficient": shift,
            "bore_diameter": module, "face_width": 3 * module}  # fmt: skip
    if helix:
        keys |= {"helix_angle_deg": helix, "double_helical": double}
    try:
        body = part_of(keys).body(0.0)
    except (SceneError, GeometryError):
        return
    check_closed(solid_faces(body, solid_curves(body, 1e-5)))


@pytest.mark.parametrize(("keys", "most"), [(GEAR, 220_000), (HELICAL, 560_000)], ids=["gear", "helical"])
def test_files_are_small(keys: dict[str, Any], most: int) -> None:
    body = part_of(keys).body(0.0)
    solid = solid_faces(body, solid_curves(body, 9.9e-7))
    assert len(step_text(StepPart("p", solid, "#c08040"), StepForm())) <= most


@pytest.mark.heavy
def test_a_file_of_ten_thousand_teeth_is_ten_times_that_of_a_thousand() -> None:
    """Its faces and its length; 200 teeth stay below 1.8 MB."""
    sizes = {}
    for teeth in (200, 1000, 10_000):
        body = part_of({**GEAR, "number_of_teeth": teeth}).body(0.0)
        text = step_text(StepPart("p", solid_faces(body, solid_curves(body, 9.9e-7)), None), StepForm())
        assert text.count("=ADVANCED_FACE(") == 6 * teeth + 3
        sizes[teeth] = len(text)
    assert sizes[200] <= 1_800_000
    assert 9.5 < sizes[10_000] / sizes[1000] < 11


@pytest.mark.parametrize(("value", "written"), [(0.0, "0."), (-0.0, "0."), (20.0, "20."), (0.1, "0.1"),
    (1e-7, "1.E-07"), (1.25e-9, "1.25E-09"), (-3.5, "-3.5"), (1e16, "1.E+16"),
    (1 / 3, "0.333333333333333")])  # fmt: skip
def test_a_real_has_a_point_and_fifteen_digits(value: float, written: str) -> None:
    """ISO 10303-21, 7.3.2: the point is never left out, the exponent follows an E."""
    assert real(value) == written


@pytest.mark.parametrize(("words", "written"), [("gear", "gear"), ("it's a \\", "it''s a \\\\"),
    ("Колесо z 8", "\\X2\\041A043E043B04350441043E\\X0\\ z 8"),
    ("⌀\U0001d400", "\\X4\\000023000001D400\\X0\\")])  # fmt: skip
def test_words_are_ascii(words: str, written: str) -> None:
    """ISO 10303-21, 7.3.3: quotes and backslashes doubled, other letters in hexadecimal."""
    assert string(words) == written


@needs_kernel
def test_the_kernel_s_document_has_name_colour_material_density_volume_and_area(tmp_path: Path) -> None:
    from OCP.Quantity import Quantity_Color
    from OCP.STEPCAFControl import STEPCAFControl_Reader
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDataStd import TDataStd_Name
    from OCP.TDF import TDF_LabelSequence
    from OCP.TDocStd import TDocStd_Document
    from OCP.XCAFDoc import (
        XCAFDoc_Area,
        XCAFDoc_ColorSurf,
        XCAFDoc_ColorTool,
        XCAFDoc_DocumentTool,
        XCAFDoc_Material,
        XCAFDoc_MaterialTool,
        XCAFDoc_Volume,
    )

    part = StepPart("колесо", made("plain")[1], "#c08040", "сталь 45", 7.85, 1234.5678901, 987.654321)
    file = tmp_path / "p.step"
    file.write_text(step_text(part, StepForm(author="Ім'я", organisation="КПІ")), encoding="ascii")
    # the kernel's header has no names that are not ASCII: the file is asked itself
    assert "('\\X2\\04060" in file.read_text()
    assert "('\\X2\\041A041F0406\\X0\\')" in file.read_text()
    reader, document = STEPCAFControl_Reader(), TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    reader.SetMatMode(True)
    reader.SetNameMode(True)
    reader.SetColorMode(True)
    reader.SetPropsMode(True)
    reader.ReadFile(str(file))
    assert reader.Transfer(document)
    found = TDF_LabelSequence()
    XCAFDoc_DocumentTool.ShapeTool_s(document.Main()).GetFreeShapes(found)
    name, shade, volume, area = TDataStd_Name(), Quantity_Color(), XCAFDoc_Volume(), XCAFDoc_Area()
    assert found.Value(1).FindAttribute(TDataStd_Name.GetID_s(), name)
    assert name.Get().ToExtString() == "колесо"
    assert XCAFDoc_ColorTool.GetColor_s(found.Value(1), XCAFDoc_ColorSurf, shade)
    assert Quantity_Color.ColorToHex_s(shade, True).ToCString().lower() == "#c08040"
    assert found.Value(1).FindAttribute(XCAFDoc_Volume.GetID_s(), volume)
    assert volume.Get() == pytest.approx(1234.5678901, rel=1e-14)
    assert found.Value(1).FindAttribute(XCAFDoc_Area.GetID_s(), area)
    assert area.Get() == pytest.approx(987.654321, rel=1e-14)
    # g/mm^3
    assert XCAFDoc_MaterialTool.GetDensityForShape_s(found.Value(1)) == pytest.approx(7.85e-3)
    materials, material = TDF_LabelSequence(), XCAFDoc_Material()
    XCAFDoc_DocumentTool.MaterialTool_s(document.Main()).GetMaterialLabels(materials)
    assert materials.Value(1).FindAttribute(XCAFDoc_Material.GetID_s(), material)
    assert material.GetName().ToCString() == "сталь 45"


def test_every_face_may_have_its_own_surface() -> None:
    text = step_text(StepPart("p", made("plain")[1]), StepForm(shared=False))
    surfaces = re.findall(r"=ADVANCED_FACE\('',\([^)]*\),#(\d+),", text)
    assert len(set(surfaces)) == len(surfaces) == 9 * 6 + 3
    assert made("plain")[2].count("=CYLINDRICAL_SURFACE(") == 3


@pytest.mark.parametrize("key", [{"author": "me"}, {"organisation": "us"}, {"shared": False}])
def test_keys_of_step_are_for_step_alone(key: dict[str, object]) -> None:
    scene = {"parts": {"p": SMALL}, "exports": [{"format": "step", **key}]}
    assert scene_from_dict(scene, "test", "test").exports
    with pytest.raises(SceneError, match=f"{next(iter(key))}.*only for format"):
        scene_from_dict({"parts": {"p": SMALL}, "exports": [{"format": "stl", **key}]}, "test", "test")


def test_names_colours_and_places_come_back(tmp_path: Path) -> None:
    """Cyrillic names, one product in two places."""
    from exporters.formats.read_step import read_step_assembly

    wheel, pin = StepPart("колесо", made("plain")[1], "#c08040"), StepPart("pin's", made("end")[1], "#4f8fc0")
    turned = Placement3.about_z(0.3, (1.0, 2.0, -3.0))
    rows = (("left", wheel, Placement3()), ("праве", wheel, turned), ("pin", pin, turned))
    text = step_text(StepGroup("пара", rows), StepForm())
    assert text == step_text(StepGroup("пара", rows), StepForm())
    assert text.isascii()
    assert text.count("MANIFOLD_SOLID_BREP(") == 2
    file = tmp_path / "pair.step"
    file.write_text(text, encoding="ascii")
    found = read_step_assembly(file)
    assert found.title == "пара"
    assert [(p.name, p.colour) for p in found.prototypes] == [("колесо", "#c08040"), ("pin's", "#4f8fc0")]
    assert [(o.name, o.prototype) for o in found.occurrences] == [("left", 0), ("праве", 0), ("pin", 1)]
    for occurrence, (_, _, place) in zip(found.occurrences, rows, strict=True):
        assert np.abs(occurrence.place - place.matrix()).max() < 1e-12


def test_directions_that_are_alike_but_for_their_last_bits_are_one() -> None:
    """They hang on the processor, and so did the numbers of all entities."""
    pin, more = StepPart("pin", made("plain")[1]), [0.0, 1e-15, -1e-15, 1e-9]
    rows = tuple((f"pin {k}", pin, Placement3.about_z(0.3 + turn, (5.0 * k, 0.0, 0.0))) for k, turn in enumerate(more))
    counts = [step_text(StepGroup("pins", rows[:n]), StepForm()).count("=DIRECTION(") for n in (1, 3, 4)]
    assert counts == [counts[0], counts[0], counts[0] + 1]


@needs_kernel
def test_an_assembly_may_stand_in_another_twice() -> None:
    """A pair of pins in two places: one solid in the file, four for the kernel, each where it belongs."""
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    from parts.solids.kernel import solids_of

    pin = StepPart("pin", made("plain")[1])
    away, up = Placement3(translation=(50.0, 0.0, 0.0)), Placement3.about_z(0.5, (0.0, 0.0, 30.0))
    pair = StepGroup("pair", (("a", pin, Placement3()), ("b", pin, away)))
    text = step_text(StepGroup("whole", (("one", pair, Placement3()), ("two", pair, up))), StepForm())
    assert [text.count(f"={kind}(") for kind in ("MANIFOLD_SOLID_BREP", "NEXT_ASSEMBLY_USAGE_OCCURRENCE")] == [1, 4]
    centres = []
    for solid in solids_of(text):
        found = GProp_GProps()
        BRepGProp.VolumeProperties_s(solid, found)
        centres.append([found.CentreOfMass().Coord(i) for i in (1, 2, 3)])
    own = np.array([[0.0, 0.0, 3.0]])
    expected = np.concatenate([own, away.apply(own), up.apply(own), up.apply(away.apply(own))])
    away_from = np.abs(np.array(centres)[:, None] - expected).max(axis=2)
    assert len(centres) == 4
    assert sorted(away_from.argmin(axis=0).tolist()) == [0, 1, 2, 3]
    assert away_from.min(axis=0).max() < 1e-6
