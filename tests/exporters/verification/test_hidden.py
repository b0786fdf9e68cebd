"""Files whose outlines are as they should be, but which hide, colour, lift or turn something: verify finds each."""

from __future__ import annotations

import re
import shutil
import zipfile
from collections.abc import Callable
from pathlib import Path

import ezdxf
import pytest
from ezdxf.document import Drawing
from ezdxf.entities import DXFGraphic

from exporters.formats.read_drawing import read_drawing
from parts.base.readback import ReadError
from parts.solids.kernel import has_kernel
from tests.exporters.making import part_keys, run, table, write_scene
from tests.exporters.outside import Gear
from tests.sampling import some_of

Spoil = Callable[[Path], None]
STEP = has_kernel()


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A coloured gear with a bore in every format, and the sheet of its pair."""
    folder = tmp_path_factory.mktemp("good")
    parts = {"g": part_keys(Gear(2, 12, bore=6)) | {"colour": "#c08040"}, "h": part_keys(Gear(2, 15))}
    forms = ("svg", "stl", "3mf", *(("step",) if STEP else ()))
    exports = [{"format": f, "parts": ["g"]} for f in forms]
    exports += [{"format": "dxf", "parts": ["g"], "name": name} | more for name, more in
                (("new", {}), ("old", {"dxf_version": "R12"}), ("drawn", {"purpose": "drawing"}))]  # fmt: skip
    exports += [{"format": "sheet"}]
    mate = table("[[mates]]", {"kind": "external_gear_pair", "first": "g", "second": "h"})
    # the command that follows verifies what a build would
    assert run("build", write_scene(folder / "s.toml", parts, exports, mate), "--out", folder, "--no-verify") == 0
    assert run("verify", *(folder / "s").glob("*[!n]")) == 0
    return folder / "s"


def text(change: Callable[[str], str]) -> Spoil:
    """A spoiler of a file of text."""

    def spoil(file: Path) -> None:
        before = file.read_bytes().decode("latin-1")
        after = change(before)
        assert after != before
        file.write_bytes(after.encode("latin-1"))

    return spoil


def swap(old: str, new: str) -> Spoil:
    """The first of some words replaced."""
    return text(lambda t: t.replace(old, new, 1))


def flip(pattern: str, number: int) -> Spoil:
    """One of the senses of STEP entities of a kind turned."""

    def change(before: str) -> str:
        found = list(re.finditer(rf"={pattern}\([^;]*,\.([TF])\.\);", before))
        place = found[number * (len(found) - 1) // 4]
        return before[: place.start(1)] + ("F" if place[1] == "T" else "T") + before[place.end(1) :]

    return text(change)


def drawing(change: Callable[[Drawing], object]) -> Spoil:
    """A spoiler of a DXF by ezdxf."""

    def spoil(file: Path) -> None:
        document = ezdxf.readfile(file)
        change(document)
        document.saveas(file)

    return spoil


def entity(change: Callable[[DXFGraphic], object], which: int = -1) -> Spoil:
    """A spoiler of one entity of a DXF."""
    return drawing(lambda document: change(list(document.modelspace())[which]))


def attribute(name: str, value: object, which: int = -1) -> Spoil:
    """One attribute of an entity."""
    return entity(lambda one: one.dxf.set(name, value), which)


def layer(change: Callable[[ezdxf.entities.Layer], object], name: str = "CUT_OUTER") -> Spoil:
    """A spoiler of a layer."""
    return drawing(lambda document: change(document.layers.get(name)))


def outer_first(document: Drawing) -> None:
    """The outline before the bore."""
    space = document.modelspace()
    bore = next(iter(space))
    again = bore.copy()
    space.delete_entity(bore)
    space.add_entity(again)


def package(change: Callable[[str], str], name: str = "3D/3dmodel.model") -> Spoil:
    """A spoiler of a part of a 3MF."""

    def spoil(file: Path) -> None:
        with zipfile.ZipFile(file) as inside:
            content = {n: inside.read(n) for n in inside.namelist()}
        changed = change(content[name].decode()).encode()
        assert changed != content[name]
        with zipfile.ZipFile(file, "w") as inside:
            for each, data in (content | {name: changed}).items():
                inside.writestr(each, data)

    return spoil


def second_model(file: Path) -> None:
    """A package whose relations begin with another model than the one that is looked at."""
    with zipfile.ZipFile(file, "a") as inside:
        inside.writestr("3D/other.model", inside.read("3D/3dmodel.model"))
    package(lambda t: t.replace("3dmodel.model", "other.model", 1), "_rels/.rels")(file)


def twice(file: Path) -> None:
    """A package with two models of one name."""
    with zipfile.ZipFile(file, "a") as inside, pytest.warns(UserWarning, match="Duplicate"):
        inside.writestr("3D/3dmodel.model", inside.read("3D/3dmodel.model"))


def stl_header(start: bytes) -> Spoil:
    """Another beginning of an STL."""

    def spoil(file: Path) -> None:
        data = file.read_bytes()
        file.write_bytes(start.ljust(80) + data[80:])

    return spoil


def stl_attribute(file: Path) -> None:
    """A triangle with a colour of its own."""
    data = bytearray(file.read_bytes())
    data[84 + 48 : 84 + 50] = b"\x1f\x80"
    file.write_bytes(bytes(data))


LASER: dict[str, Spoil] = {
    "off": layer(lambda y: y.off()),
    "frozen": layer(lambda y: y.freeze()),
    "frozen bore": layer(lambda y: y.freeze(), "CUT_INNER"),
    "layer colour": layer(lambda y: setattr(y, "color", 3)),
    "dashed": drawing(lambda d: (d.linetypes.add("DASHED", [1.0, 0.5, -0.5]),
                                 d.layers.get("CUT_OUTER").dxf.set("linetype", "DASHED"))),
    "colour": attribute("color", 5),
    "line type": drawing(lambda d: (d.linetypes.add("DASHED", [1.0, 0.5, -0.5]),
                                    list(d.modelspace())[-1].dxf.set("linetype", "DASHED"))),
    "thickness": attribute("thickness", 3.0),
    "order": drawing(outer_first),
}  # fmt: skip
SPOILT: dict[str, dict[str, Spoil]] = {
    "g.new.dxf": LASER | {
        "plot": layer(lambda y: y.dxf.set("plot", 0)),
        "see-through layer": layer(lambda y: setattr(y, "transparency", 1.0)),
        "true layer colour": swap("  2\nCUT_OUTER\n 70\n0\n", "  2\nCUT_OUTER\n 70\n0\n420\n65280\n"),
        "invisible": attribute("invisible", 1, 0),
        "true colour": swap("CUT_OUTER\n100\nAcDbPolyline", "CUT_OUTER\n420\n65280\n100\nAcDbPolyline"),
        "width": attribute("const_width", 0.5),
        "one width": entity(lambda e: e.set_points([(x, y, 1.0, 1.0, b) for x, y, *_, b in e.get_points()])),
        "elevation": attribute("elevation", 4.0),
        "weight": attribute("lineweight", 200),
        "weight of a layer": layer(lambda y: y.dxf.set("lineweight", 200)),
        "see-through": swap("CUT_OUTER\n100\nAcDbPolyline", "CUT_OUTER\n440\n33554458\n100\nAcDbPolyline"),
        "paper": swap("LWPOLYLINE\n  5\n34\n330\n17", "LWPOLYLINE\n  5\n34\n330\n1B"),
    },
    "g.old.dxf": LASER | {
        "width": attribute("default_start_width", 0.5),
        "one width": entity(lambda e: e.vertices[3].dxf.set("start_width", 0.5)),
        "elevation": attribute("elevation", (0, 0, 4.0)),
    },
    "g.drawn.dxf": {
        "off": layer(lambda y: y.off(), "OUTLINE"),
        "frozen": layer(lambda y: y.freeze(), "OUTLINE"),
        "plot": layer(lambda y: y.dxf.set("plot", 0), "OUTLINE"),
        "layer colour": layer(lambda y: setattr(y, "color", 3), "OUTLINE"),
        "weight of a layer": layer(lambda y: y.dxf.set("lineweight", 200), "OUTLINE"),
        "see-through layer": layer(lambda y: setattr(y, "transparency", 1.0), "OUTLINE"),
        "invisible": attribute("invisible", 1),
        "colour": attribute("color", 5),
        "thickness": attribute("thickness", 3.0),
        "elevation": entity(lambda e: setattr(e, "control_points", [(x, y, 1.0) for x, y, _ in e.control_points]), 5),
    },
    "s.meshing.1.dxf": {
        "off": layer(lambda y: y.off(), "OUTLINE"),
        "layer colour": layer(lambda y: setattr(y, "color", 2), "OUTLINE"),
        "line type": layer(lambda y: y.dxf.set("linetype", "CONTINUOUS"), "CENTRE"),
        "weight": layer(lambda y: y.dxf.set("lineweight", 200), "CENTRE"),
        "invisible words": attribute("invisible", 1),
        "mirrored words": attribute("text_generation_flag", 2),
    },
    "g.svg": {
        **{f"{name} in style": swap("fill:none;", f"fill:none;{name};") for name in
           ("display:none", "visibility:hidden", "opacity:0", "stroke-opacity:0", "clip-path:url(#x)",
            "stroke-dasharray:1 1")},
        **{name: swap('id="cut_outer"', f'id="cut_outer" {name}') for name in
           ('display="none"', 'visibility="hidden"', 'opacity="0"', 'clip-path="url(#x)"', 'mask="url(#x)"')},
        "hidden picture": swap('version="1.1"', 'version="1.1" display="none"'),
        "group": text(lambda t: t.replace("<path", '<g style="display:none"><path').replace("</svg>", "</g></svg>")),
        "picture in it": text(lambda t: t.replace("<path", '<svg x="9" y="9"><path').replace("</svg>", "</svg></svg>")),
        "colour": swap("#ff0000", "#00ff00"),
        "fill": swap("fill:none", "fill:#ff0000"),
        "no line": swap("stroke-width:0.1", "stroke-width:0"),
        "broad line": swap("stroke-width:0.1", "stroke-width:5"),
        "style sheet": swap("<svg", '<?xml-stylesheet href="x.css"?><svg'),
        "entity": swap("<svg", '<!DOCTYPE svg [<!ATTLIST path display CDATA "none">]><svg'),
        "animation": text(lambda t: re.sub(r"(<path[^>]*)/>", r'\1><set attributeName="display"/></path>', t)),
        "order": text(lambda t: re.sub(r"(<circle[^>]*/>\n)(<path[^>]*/>\n)", r"\2\1", t)),
    },
    "s.meshing.1.svg": {
        "hidden": swap('<g id="OUTLINE" style="', '<g id="OUTLINE" style="display:none;'),
        "group": swap('<g id="OUTLINE"', '<g id="OUTLINE" opacity="0"'),
        "path": swap("<path d", '<path visibility="hidden" d'),
        "words": swap("<text x", '<text display="none" x'),
        "colour": swap("stroke:#000000", "stroke:#ffffff"),
        "covered": swap("</svg>", '<rect width="100%" height="100%" style="fill:#ffffff"/></svg>'),
    },
    "g.3mf": {
        "material": package(lambda t: re.sub(r'(<base name=")g"', r'\1steel"', t)),
        "support": package(lambda t: t.replace('type="model"', 'type="support"')),
        "not printed": package(lambda t: t.replace("<item ", '<item printable="0" ')),
        "extension": package(lambda t: t.replace('unit="', 'requiredextensions="s" unit="', 1)),
        "colour": package(lambda t: t.replace("#C08040", "#4080C0")),
        "see-through": package(lambda t: t.replace("#C08040FF", "#C0804010")),
        "colour of a triangle": package(lambda t: t.replace("<triangle ", '<triangle pid="1" p1="0" ', 1)),
        "painted": package(lambda t: t.replace("</mesh>", '<t:trianglesets xmlns:t="t"/></mesh>')),
        "path": package(lambda t: t.replace("<item ", '<item p:path="/3D/other.model" ')),
        "another model": second_model,
        "twice": twice,
    },
    "g.stl": {"solid": stl_header(b"solid g"), "Solid": stl_header(b" Solid"), "colour": stl_attribute},
    "g.step": {
        **{f"{kind} {n}": flip(kind, n) for kind in ("ADVANCED_FACE", "FACE_BOUND", "ORIENTED_EDGE", "EDGE_CURVE")
           for n in (0, 1, 4)},
        "all faces": text(lambda t: re.sub(r"(ADVANCED_FACE\([^;]*,\.)([TF])",
                                           lambda m: m[1] + ("F" if m[2] == "T" else "T"), t)),
        "colour": text(lambda t: re.sub(r"COLOUR_RGB\('',0\.\d+", "COLOUR_RGB('',0.1", t)),
        "hidden": text(lambda t: t.replace("ENDSEC;\nEND-", "#99999 = INVISIBILITY((#1));\nENDSEC;\nEND-")),
    },
}  # fmt: skip


# how each is told, by the end of its table's name; what is not listed is told in more ways than one
SAID: dict[str, dict[str, str]] = {
    "g.svg": {"in style": "the sty", '"': "which may hide or mov", "hidden picture": "svg has a display",
              "group": "<g> stands among", "picture in it": "<svg> stands among", "colour": "is named CUT_",
              "fill": "the style", "no line": "the style", "broad line": "the style", "style sheet": "holds <\\?xml-st",
              "entity": "holds <!DOCTYP", "animation": "<set> stands among", "order": "a circle stands behind a path"},
    "g.3mf": {"material": "material name: steel instead of g", "support": 'type = "support"',
              "not printed": 'printable = "0"', "extension": "requiredextensions =",
              "colour": "#4080c0 instead of #c08040", "see-through": "can be seen through", "of a triangle": "has pid",
              "painted": "holds <", "path": "<item> of the 3MF has {", "another model": "begins with",
              "twice": "holds a part twice"},
    "g.stl": {"olid": 'begins with "solid"', "colour": "has an attribute"},
    "g.step": {"ADVANCED_FACE 0": "a face turned insi", "ADVANCED_FACE 1": "turned insi", "all faces": "turned insi",
               "ADVANCED_FACE 4": "a face turned insi", "colour": "instead of #c08040", "hidden": "holds INVISIBILITY",
               "FACE_BOUND 0": "is an edge that is no", "EDGE_CURVE 0": "does not end at its ve",
               "ORIENTED_EDGE 1": "a loop that is not", "EDGE_CURVE 4": "runs against its line"},
}  # fmt: skip


@pytest.mark.parametrize("name", SAID)
def test_what_is_hidden_is_told(name: str, good: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    # a STEP is held against the kernel too, which takes a second
    for spoil in some_of(SPOILT[name], 2 if name == "g.step" else 4):
        said = next((words for end, words in SAID[name].items() if spoil.endswith(end)), "")
        assert re.search(f"FAILED.*{said}", found(name, spoil, good, tmp_path, capsys), re.DOTALL), spoil


@pytest.mark.sampled(3)
@pytest.mark.parametrize(("name", "spoil"), [(n, s) for n in SPOILT if n not in SAID for s in SPOILT[n]])
def test_what_is_hidden_is_found(
    name: str, spoil: str, good: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert "FAILED" in found(name, spoil, good, tmp_path, capsys)


def found(name: str, spoil: str, good: Path, folder: Path, capsys: pytest.CaptureFixture[str]) -> str:
    """What ``verify`` says of a spoiled file."""
    if name == "g.step" and not STEP:
        pytest.skip("the CAD kernel is an extra")
    for file in (name, "report.json"):
        shutil.copy(good / file, folder)
    SPOILT[name][spoil](folder / name)
    capsys.readouterr()
    assert run("verify", folder / name) == 1
    return capsys.readouterr().out


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["g.new.dxf", "g.old.dxf", "g.drawn.dxf", "s.meshing.1.dxf"])
def test_a_drawing_that_was_only_saved_again_passes(name: str, good: Path, tmp_path: Path) -> None:
    for file in (name, "report.json"):
        shutil.copy(good / file, tmp_path)
    drawing(lambda document: None)(tmp_path / name)
    assert run("verify", tmp_path / name) == 0


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (layer(lambda y: y.off(), "OUTLINE"), "layer OUTLINE is off"),
        (layer(lambda y: y.freeze(), "OUTLINE"), "layer OUTLINE is frozen"),
        (layer(lambda y: y.dxf.set("plot", 0), "OUTLINE"), "layer OUTLINE is not plotted"),
        (drawing(lambda d: d.layers.remove("OUTLINE")), "layer OUTLINE is not in the layer table"),
    ],
)
def test_a_layer_of_a_drawing_that_is_not_shown_is_named(spoil: Spoil, said: str, good: Path, tmp_path: Path) -> None:
    file = Path(shutil.copy(good / "g.drawn.dxf", tmp_path))
    spoil(file)
    with pytest.raises(ReadError, match=said):
        read_drawing(file)
