"""A small STEP file, spoiled in each thing that its reader asks for, and refused by that thing's own words."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from exporters.formats.read_step import read_step, read_step_assembly
from geometry.base.placement import Placement3
from parts.base.readback import ReadError
from parts.scene.load import make_parts, scene_from_dict
from parts.solids.faces import solid_curves, solid_faces
from parts.solids.step_text import StepForm, StepGroup, StepPart, step_text

PLATE = {
    "kind": "plate",
    "width": 20.0,
    "height": 12.0,
    "face_width": 3.0,
    "holes": [{"diameter": 4.0, "at": [3.0, 1.0]}],
}
Change = Callable[[str], str]


def part(name: str, colour: str = "#c08040") -> StepPart:
    """A plate of 20 x 12 x 3 with a hole of 4 at (3, 1), and all that a part may say of itself."""
    body = make_parts(scene_from_dict({"parts": {"p": PLATE}}, "t", "t"), "t")[0]["p"].body(0.0)
    solid = solid_faces(body, solid_curves(body, 1e-6))
    return StepPart(name, solid, colour, "steel", 7.85, 20 * 12 * 3 - 12 * math.pi, 650.0, f"Title of {name}", "words")


@pytest.fixture(scope="module")
def plate() -> str:
    return step_text(part("p"), StepForm())


@pytest.fixture(scope="module")
def stack() -> str:
    """Two parts: one of them twice, once in a group within the group."""
    one, two = part("one"), part("two", "#0080ff")
    turned = Placement3.towards((1.0, 0.0, 0.0), 0.5, (30.0, 4.0, -5.0))
    home = Placement3.towards((0.0, 0.0, 1.0), 0.0, (0.0, 0.0, 0.0))
    inner = StepGroup("inner", (("a", one, turned), ("b", two, home)))
    return step_text(StepGroup("outer", (("c", one, home), ("inner", inner, turned))), StepForm())


def once(old: str, new: str) -> Change:
    """The first place that looks like this replaced; ``new`` may name groups."""
    return lambda text: re.sub(old, new, text, count=1)


def kinds(text: str) -> dict[str, str]:
    """The kind of each entity."""
    return {m[1]: m[2] for m in re.finditer(r"(?<=\n)(#\d+)=([A-Z_0-9]*)", text)}


SPOILS: dict[str, tuple[Change, str, str]] = {
    # what is done, the kind of the entity that is blamed, and in which words
    "no direction": (once(r"(DIRECTION\('',\()0.,-1.,0.", r"\g<1>0.,0.,0."), "DIRECTION", "a direction without length"),
    "no vector": (once(r"(VECTOR\('',#\d+,)1\.", r"\g<1>0."), "VECTOR", "a vector without length"),
    "one axis": (
        once(r"(PLACEMENT_3D\('',#\d+,)(#\d+),#\d+", r"\1\2,\2"),
        "AXIS2_PLACEMENT_3D",
        "has axes of one direction",
    ),
    "a bound twice": (
        once(r"(FACE\('',\()#\d+(\),.*\n(?:.*\n)*?.*FACE\('',\()(#\d+)", r"\1\3\2\3"),
        "FACE_BOUND",
        "is not used once",
    ),
    "a face twice": (once(r"(SHELL\('',\()#\d+,(#\d+)", r"\1\2,\2"), "ADVANCED_FACE", "is not used once"),
    "a loop twice": (
        once(r"(BOUND\('',)#\d+(.*\n(?:.*\n)*?.*BOUND\('',)(#\d+)", r"\1\3\2\3"),
        "EDGE_LOOP",
        "is not used once",
    ),
    "a way twice": (
        once(r"(LOOP\('',\()#\d+((?:.*\n)*?.*LOOP\('',\()(#\d+)", r"\1\3\2\3"),
        "ORIENTED_EDGE",
        "is not used once",
    ),
    "another edge": (
        once(r"(ORIENTED_EDGE\('',\*,\*,)#\d+((?:.*\n)*?.*EDGE\('',\*,\*,)(#\d+)", r"\1\3\2\3"),
        "EDGE_LOOP",
        "a loop that is not closed",
    ),
    "against its loop": (once(r"(ORIENTED_EDGE\(.*\.)T", r"\1F"), "EDGE_LOOP", "a loop that is not closed"),
    "bound turned": (once(r"(FACE_BOUND\(.*\.)T", r"\1F"), "EDGE_CURVE", "not used once each way"),
    "line turned": (once(r"(EDGE_CURVE\(.*\.)T", r"\1F"), "EDGE_CURVE", "runs against its line"),
    "a smaller arc": (once(r"(CIRCLE\(.*,)2\.", r"\g<1>1.9999998"), "EDGE_CURVE", "does not end at its vertices"),
    "face turned": (once(r"(ADVANCED_FACE\(.*\.)T", r"\1F"), "ADVANCED_FACE", "a face turned inside out"),
    "hole turned": (once(r"(ADVANCED_FACE\(.*\.)F", r"\1T"), "ADVANCED_FACE", "a face turned inside out"),
    "a wider hole": (once(r"(CYLINDRICAL_SURFACE\(.*,)2\.", r"\g<1>2.0001"), "ADVANCED_FACE", "0.0001 mm away"),
    "points far apart": (once(r"1\.E-07", "1.01E-06"), "UNCERTAINTY_MEASURE_WITH_UNIT", "call points one within 1e-06"),
    "points at once": (once(r"1\.E-07", "0."), "UNCERTAINTY_MEASURE_WITH_UNIT", "call points one within"),
    "another home": (
        once(r"(DEFINITION_SHAPE\((?:.*\n)*?.*CARTESIAN_POINT\('',\()0\.", r"\g<1>2.E-12"),
        "ADVANCED_BREP_SHAPE_REPRESENTATION",
        "another origin than its part",
    ),
    "another name of the density": (
        once(r"(ITEM\('density',)'density'|'g/cm3'", "'kg'"),
        "PROPERTY_DEFINITION_REPRESENTATION",
        "in other words or units",
    ),
    "another kind of property": (
        once("'geometric validation property'", "'material property'"),
        "PROPERTY_DEFINITION_REPRESENTATION",
        "in other words or units",
    ),
    "another power": (
        once(r"(DERIVED_UNIT_ELEMENT\(#\d+,)-3\.", r"\1-2."),
        "PROPERTY_DEFINITION_REPRESENTATION",
        "in other words or units",
    ),
    "another measure": (
        once("VOLUME_MEASURE", "AREA_MEASURE"),
        "PROPERTY_DEFINITION_REPRESENTATION",
        "in other words or units",
    ),
    "two materials": (
        once("'steel'", "'stool'"),
        "PROPERTY_DEFINITION_REPRESENTATION",
        "says st[eo]+l and st[eo]+l of",
    ),
    "an entity twice": (once(r"(\n#\d+=LINE[^;]*;)", r"\1\1"), "LINE", "is there twice"),
    "a word too many": (once("'mechanical'", "'electrical'"), "PRODUCT_CONTEXT", "which no PRODUCT_CONTEXT does"),
    "an endless number": (once(r"10\.,6\.,0\.", "1.E999,6.,0."), "CARTESIAN_POINT", "is not what|beyond any length"),
    "a great number": (once(r"10\.,6\.,0\.", "1.E99,6.,0."), "CARTESIAN_POINT", "beyond any length"),
    "a radius below 0": (once(r"(CIRCLE\(.*,)2\.", r"\1-2."), "CIRCLE", "is not what CIRCLE has to be"),
}
WHOLE: dict[str, tuple[Change, str]] = {
    # what no entity is blamed for
    "schema": (once("AUTOMOTIVE_DESIGN", "CONFIG_CONTROL"), "not of the schema AUTOMOTIVE_DESIGN"),
    "header": (once("FILE_NAME", "FILE_NAMES"), "none of description, name and schema"),
    "begin": (once("ISO-10303-21", "ISO-10303-28"), "not a readable STEP file"),
    "end": (lambda text: text.replace("END-ISO-10303-21;", ""), "does not come to its end"),
    "string": (lambda text: text.replace("'mechanical')", "'mechanical)"), "has no end|line end|to its end"),
    "line end": (once("'mechanical'", "'mecha\nnical'"), "holds a line end"),
    "binary": (once("'mechanical'", '"0A"'), "binary data"),
    "blank": (once("ORIENTED_EDGE", "ORIENTED EDGE"), "a blank stands within a word"),
    "unknown": (once(r"\n#\d+=DIRECTION", r"\n#999999=OVER_RIDING_STYLED_ITEM('');\g<0>"), "OVER_RIDING_STYLED_ITEM"),
    "unknown unit": (lambda text: text.replace(".MILLI.", ".MICRO."), "is not known|refers to"),
    "wide lines": (lambda text: text.replace("POSITIVE_LENGTH_MEASURE(0.1)", "POSITIVE_LENGTH_MEASURE(0.2)"), "0.2 mm"),
}


def refused(text: str, file: Path) -> str:
    file.write_text(text, encoding="ascii", newline="\n")
    with pytest.raises(ReadError) as caught:
        read_step(file)
    return str(caught.value)


def test_each_thing_is_refused_by_its_own_words(plate: str, tmp_path: Path) -> None:
    for name, (change, kind, said) in SPOILS.items():
        spoiled = change(plate)
        assert spoiled != plate, name
        told = refused(spoiled, tmp_path / "p.step")
        blamed = re.match(r"#\d+", told)
        assert re.search(said, told), (name, told)
        assert blamed is not None, (name, told)
        assert kinds(spoiled)[blamed[0]] == kind, (name, told)


def test_a_whole_that_is_none_is_refused_by_its_own_words(plate: str, tmp_path: Path) -> None:
    for name, (change, said) in WHOLE.items():
        spoiled = change(plate)
        assert spoiled != plate, name
        assert re.search(said, refused(spoiled, tmp_path / "p.step")), name


def test_no_reference_may_lead_to_another_kind(plate: str, tmp_path: Path) -> None:
    """Each of the first entity of each kind, to an entity of another kind and to none."""
    known, seen = kinds(plate), set[str]()
    for entity in re.finditer(r"(?<=\n)(#\d+)=([A-Z_0-9]*)[^;]*;", plate):
        if entity[2] in seen:
            continue
        seen.add(entity[2])
        for use in re.finditer(r"(?<=[(,])#\d+", entity[0]):
            own = known[use[0]]
            wrong = next(name for name, kind in known.items() if kind != own and (own, kind) not in ALSO)
            for other in (wrong, "#999999999")[: 1 + (entity[2] in ("EDGE_LOOP", "STYLED_ITEM"))]:
                place = entity.start() + use.start()
                told = refused(plate[:place] + other + plate[place + len(use[0]) :], tmp_path / "p.step")
                assert re.match(rf"{entity[1]} of the STEP file refers to {other}, which is no ", told), (own, told)
    assert len(seen) > 40


# kinds that may stand where another does
ALSO = {("AXIS2_PLACEMENT_3D", "MANIFOLD_SOLID_BREP"), ("MANIFOLD_SOLID_BREP", "AXIS2_PLACEMENT_3D")}


@pytest.mark.parametrize("sign", [-1, 1])
def test_edges_lie_on_their_surfaces_as_well_as_the_file_says(sign: int, plate: str, tmp_path: Path) -> None:
    """Within 1e-7 mm, or within the file's precision where that is worse: a wall, and an arc that ends elsewhere."""
    file = tmp_path / "p.step"
    for kind, said in (("CYLINDRICAL_SURFACE", "away from its edges"), ("CIRCLE", "does not end at its vertices")):
        for precision, step, fine in ((1e-7, 0.9e-7, True), (1e-7, 1.1e-7, False), (5e-7, 4.8e-7, True),
                                      (5e-7, 5.2e-7, False), (1e-8, 0.9e-7, True)):  # fmt: skip
            radius = f"{2 + sign * step:.10f}"
            # the wall goes with the arcs, so that only their ends are off
            both = kind if kind != "CIRCLE" else "CIRCLE|CYLINDRICAL_SURFACE"
            text = re.sub(rf"((?:{both})\(.*,)2\.", rf"\g<1>{radius}", plate).replace("1.E-07", f"{precision:.12f}")
            if fine:
                file.write_text(text, encoding="ascii", newline="\n")
                assert read_step(file).precision == precision
            else:
                assert said in refused(text, file)


def test_a_plate_is_measured_and_told(plate: str, tmp_path: Path) -> None:
    file = tmp_path / "p.step"
    file.write_text(plate, encoding="ascii", newline="\n")
    found = read_step(file)
    hole, model = math.pi * 2**2, found.model
    assert model.flux.sum() == pytest.approx((240 - hole) * 3, rel=1e-13)
    assert sorted(model.area) == pytest.approx(
        sorted([36, 60, 36, 60, 12 * math.pi, 240 - hole, 240 - hole]), rel=1e-13
    )
    # edges of the plate twice, circles twice, and the seam of the hole twice
    assert model.bounds == pytest.approx(2 * (2 * 64 + 4 * 3 + 2 * 4 * math.pi + 3), rel=1e-13)
    assert model.is_upright.tolist() == [True] * 5 + [False] * 2
    assert np.array_equal(model.heights, [[0.0] * 6 + [3.0], [3.0] * 5 + [0.0, 3.0]])
    assert sorted(loop.size for loop in found.section(1.0)) == pytest.approx([4, 20])
    assert not found.section(-0.1)
    assert not found.section(3.1)
    assert (found.colour, found.products, found.precision) == ("#c08040", ("p",), 1e-7)
    assert found.said == {
        "material name": "steel",
        "density": 7.85,
        "volume": pytest.approx(240 * 3 - 3 * hole),
        "surface area": 650.0,
        "title": "Title of p",
        "description": "words",
    }


def placed(angle: float, at: tuple[float, float, float]) -> np.ndarray:
    """Turned about z, then laid so that z looks along x, then moved."""
    c, s = math.cos(angle), math.sin(angle)
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])
    lay = Placement3.towards((1.0, 0.0, 0.0), 0.0, (0.0, 0.0, 0.0)).apply(np.eye(3)).T
    whole = np.eye(4)
    whole[:3, :3], whole[:3, 3] = lay @ turn, at
    return whole


def test_parts_stand_in_groups_as_they_were_put(stack: str, tmp_path: Path) -> None:
    file = tmp_path / "s.step"
    file.write_text(stack, encoding="ascii", newline="\n")
    found = read_step_assembly(file)
    assert (found.title, [p.name for p in found.prototypes]) == ("outer", ["one", "two"])
    assert [p.colour for p in found.prototypes] == ["#c08040", "#0080ff"]
    turned = placed(0.5, (30.0, 4.0, -5.0))
    expected = {"c": (0, np.eye(4), ""), "a": (0, turned @ turned, "inner"), "b": (1, turned, "inner")}
    assert [o.name for o in found.occurrences] == ["c", "a", "b"]
    for name, index, place, within in found.occurrences:
        of, where, group = expected[name]
        assert (index, within) == (of, group)
        assert np.allclose(place, where[:3], atol=1e-12)


STACKED: dict[str, tuple[Change, str]] = {
    "numbers": (once(r"(OCCURRENCE\(')2", r"\g<1>4"), "are not numbered one by one"),
    "a group by another name": (
        once(r"(OCCURRENCE\('\d',')inner", r"\1outer"),
        "inner in the STEP file stands there as",
    ),
    "a group with a title": (
        once("PRODUCT\\('inner','inner'", "PRODUCT('inner','other'"),
        "an assembly with another title",
    ),
    "a part in itself": (once(r"(OCCURRENCE\('\d','\w+','',)(#\d+),#\d+", r"\1\2,\2"), "itself|another product|stands"),
    "two placed as one": (
        once(
            r"(CONTEXT_DEPENDENT_SHAPE_REPRESENTATION\()(#\d+)((?:.*\n)*?.*CONTEXT_DEPENDENT_SHAPE_REPRESENTATION\()#\d+",
            r"\1\2\3\2",
        ),
        "of 2 CONTEXT_DEPENDENT|places another product|of 0 CONTEXT_DEPENDENT",
    ),
    "axes of another": (
        once(r"(ITEM_DEFINED_TRANSFORMATION\('','',)(#\d+),(#\d+)", r"\1\3,\2"),
        "axes that are none of its products'",
    ),
    "two colours of one": (
        once(r"(STYLED_ITEM\('color',\(#\d+\),)(#\d+)((?:.*\n)*?.*STYLED_ITEM\('color',\(#\d+\),)#\d+", r"\1\2\3\2"),
        "colours a solid that has a colour",
    ),
}


def test_a_stack_that_is_spoiled_is_refused_by_its_own_words(stack: str, tmp_path: Path) -> None:
    file = tmp_path / "s.step"
    for name, (change, said) in STACKED.items():
        spoiled = change(stack)
        assert spoiled != stack, name
        file.write_text(spoiled, encoding="ascii", newline="\n")
        with pytest.raises(ReadError, match=said):
            read_step_assembly(file)
