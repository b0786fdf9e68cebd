"""The frame of a laser DXF and its lean reader, held against ezdxf."""

from __future__ import annotations

import io
import json
from collections.abc import Callable
from pathlib import Path

import ezdxf
import numpy as np
import pytest

from exporters.formats.laser_dxf import VERSIONS, laser_dxf
from exporters.formats.read_dxf import read_dxf
from exporters.production.recheck import audited, recheck
from geometry.plane.contour import Approximation, Contour
from parts.base.readback import ReadError
from tests.exporters.making import build_gear
from tests.exporters.outside import Gear
from tests.oracles import dxf_frame

LAYERS = ("ENGRAVE", "CUT_INNER", "CUT_INNER", "CUT_OUTER")


def drawn(version: str) -> str:
    """Four contours of lines and arcs on three layers."""
    rng = np.random.default_rng(7)
    contours = [
        Contour(np.exp(2j * np.pi * np.arange(n) / n) * rng.uniform(1, 1e5), np.tile([0.0, 0.25], n // 2), 1)
        for n in (4, 6, 8, 10)
    ]
    made = tuple(Approximation(c, 0.0, "exact", 0.001) for c in contours)
    return laser_dxf(LAYERS, made, version=version)


@pytest.fixture(params=VERSIONS)
def file(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    path = tmp_path / f"{request.param}.dxf"
    path.write_text(drawn(request.param), encoding="ascii", newline="\n")
    return path


@pytest.mark.skipif(ezdxf.__version__ != dxf_frame.MADE_BY, reason=f"the frames are those of ezdxf {dxf_frame.MADE_BY}")
@pytest.mark.parametrize("version", VERSIONS)
def test_the_frame_is_what_ezdxf_writes(version: str) -> None:
    frame = Path(__file__).parents[3] / "exporters" / "formats" / "frames" / f"{version}.dxf"
    assert frame.read_text("ascii") == dxf_frame.frame(version)


def test_the_package_carries_its_frames() -> None:
    import exporters.formats.laser_dxf

    assert all((Path(exporters.formats.laser_dxf.__file__).parent / "frames" / f"{v}.dxf").is_file() for v in VERSIONS)


def test_ezdxf_reads_the_same_contours_without_a_remark(file: Path) -> None:
    drawing = ezdxf.readfile(file)
    auditor = drawing.audit()
    assert not auditor.errors
    assert not auditor.fixes
    ours = read_dxf(file).loops
    assert [loop.layer for loop in ours] == list(LAYERS)
    for entity, loop in zip(drawing.modelspace(), ours, strict=True):
        if entity.dxftype() == "LWPOLYLINE":
            rows = np.array(entity.get_points("xyb"))
        else:
            rows = np.array([(v.dxf.location.x, v.dxf.location.y, v.dxf.bulge) for v in entity.vertices])
        assert np.array_equal(loop.vertices, rows[:, 0] + 1j * rows[:, 1])
        assert np.array_equal(loop.bulges, rows[:, 2])
    assert {layer.dxf.name: layer.dxf.color for layer in drawing.layers if layer.dxf.name in LAYERS} == {
        "ENGRAVE": 5, "CUT_INNER": 3, "CUT_OUTER": 1}  # fmt: skip


def test_ezdxf_writes_it_again_with_the_same_records(file: Path) -> None:
    """Nothing of ours is dropped, mended or set in another way when ezdxf saves the drawing."""
    drawing = ezdxf.readfile(file)
    stream = io.StringIO()
    drawing.write(stream)

    def records(text: str) -> list[list[tuple[str, str]]]:
        lines = [line.strip() for line in text.splitlines()]
        pairs = list(zip(lines[::2], lines[1::2], strict=True))
        starts = [i for i, pair in enumerate(pairs) if pair in (("0", "LAYER"), ("0", "LWPOLYLINE"), ("0", "VERTEX"))]
        ends = [next(j for j in range(i + 1, len(pairs)) if pairs[j][0] == "0") for i in starts]
        return [sorted(pairs[a:b]) for a, b in zip(starts, ends, strict=True)]

    assert records(stream.getvalue()) == records(file.read_text("ascii"))


def _heads(text: str) -> list[int]:
    kind = "LWPOLYLINE" if "LWPOLYLINE" in text else "POLYLINE"
    mark = f"  0\n{kind}\n  5\n"
    return [i + len(mark) for i in range(len(text)) if text.startswith(mark, i)]


def _handle_of(text: str, which: int) -> str:
    return text[_heads(text)[which] :].split("\n", 1)[0]


def _with_handle(text: str, which: int, handle: str) -> str:
    at = _heads(text)[which]
    return text[:at] + handle + text[text.index("\n", at) :]


def _without_last(text: str, code: str) -> str:
    at = text.index(code, text.rindex("VERTEX" if "VERTEX" in text else "LWPOLYLINE"))
    end = text.index("\n", at + len(code)) + 1
    return text[:at] + text[end:]


def _turned(text: str) -> str:
    at = _heads(text)[2]
    end = text.index("\n", at) + 1
    return text[:end] + "210\n0.0\n220\n0.0\n230\n-1.0\n" + text[end:]


def _opened(text: str) -> str:
    """Without the flag that closes the first contour, which comes last before its points."""
    at = text.index(" 70\n1\n", _heads(text)[0])
    return text[:at] + " 70\n0\n" + text[at + 6 :]


def _with_group(code: int, value: str, *, which: int = 0) -> Callable[[str], str]:
    """A group put in behind the handle of a contour."""

    def change(text: str) -> str:
        at = text.index("\n", _heads(text)[which]) + 1
        return f"{text[:at]}{code:>3}\n{value}\n{text[at:]}"

    return change


def _layer_says(code: int, value: str, name: str = "CUT_INNER") -> Callable[[str], str]:
    """A layer with another value of a group, or with a group that it had not."""

    def change(text: str) -> str:
        at = text.index(f"  2\n{name}\n 70\n0\n 62\n")
        end = text.index("  0\n", at + 15)
        rows = text[at:end]
        mark = f"{code:>3}\n"
        found = rows.find(f"\n{mark}") + 1
        if found:
            stop = rows.index("\n", found + len(mark))
            rows = rows[: found + len(mark)] + value + rows[stop:]
        else:
            rows += f"{mark}{value}\n"
        return text[:at] + rows + text[end:]

    return change


def _second_layer(text: str) -> str:
    """Another layer of a name, in small letters."""
    at = text.index("  0\nENDTAB", text.index("  2\nCUT_OUTER\n"))
    return text[:at] + "  0\nLAYER\n  2\ncut_outer\n 70\n0\n 62\n1\n" + text[at:]


def _span(text: str, which: int) -> tuple[int, int]:
    """Where a contour begins and ends."""
    starts = [text.rindex("  0\n", 0, head) for head in _heads(text)]
    return starts[which], [*starts[1:], text.rindex("  0\nENDSEC")][which]


def _opened_at(which: int, *, straight: bool = False, corners: int = 99) -> Callable[[str], str]:
    """A contour without its flag, perhaps without its bulges, with some of its corners only."""

    def change(text: str) -> str:
        start, end = _span(text, which)
        body = text[start:end].replace(" 70\n1\n", " 70\n0\n", 1)
        mark = "  0\nVERTEX\n" if "VERTEX" in body else " 10\n"
        own, *points = body.split(mark)
        tail = "".join(points[-1].partition("  0\nSEQEND")[1:])
        told = min(corners, len(points))
        own = own.replace(f" 90\n{len(points)}\n", f" 90\n{told}\n")
        body = own + "".join(mark + point.removesuffix(tail) for point in points[:told]) + tail
        return text[:start] + (body.replace(" 42\n0.25\n", "") if straight else body) + text[end:]

    return change


def _line_before(text: str) -> str:
    start, _ = _span(text, 0)
    return text[:start] + "  0\nLINE\n  8\nENGRAVE\n" + text[start:]


def _once(old: str, new: str) -> Callable[[str], str]:
    return lambda text: text.replace(old, new, 1)


# what would lift, broaden, hide, colour or dash a contour, where its absence says that it is as its layer is
LOOKS = {
    **dict.fromkeys((38, 39, 43, 48, 71, 72, 73, 74, 75), "2.0"),
    30: "0.5",
    40: "0.1",
    41: "0.1",
    60: "1",
    62: "5",
    67: "1",
    370: "200",
    6: "DASHED",
    410: "Sheet",
    420: "65280",
}
SPOILS: dict[str, tuple[Callable[[str], str], str]] = {
    **{f"group {c}": (_with_group(c, value), f" has {value.upper()} for group {c}") for c, value in LOOKS.items()},
    **{f"group {c} of the last": (_with_group(c, LOOKS[c], which=3), f"CUT_OUTER has .* {c}") for c in (6, 39, 62)},
    "a line too many": (lambda t: t + "  0\n", "within a pair of lines"),
    "empty": (lambda t: "", "too early"),
    "a section in a section": (_once("  0\nENDSEC\n", ""), "SECTION in the wrong place"),
    "an end within a section": (lambda t: t.replace("  0\nENDSEC\n  0\nEOF\n", "  0\nEOF\n"), "EOF in the wrong place"),
    **{f"frozen by {n}": (_layer_says(70, str(n)), "layer CUT_INNER is frozen") for n in (1, 2, 3)},
    "off": (_layer_says(62, "-3"), "layer CUT_INNER is off"),
    "not plotted": (_layer_says(290, "0", "ENGRAVE"), "layer ENGRAVE is not plotted"),
    **{f"{name} in another colour": (_layer_says(62, "2", name), f"layer {name} has another colour than {colour}")
       for name, colour in (("ENGRAVE", 5), ("CUT_INNER", 3), ("CUT_OUTER", 1))},
    "true colour": (_layer_says(420, "65280"), "layer CUT_INNER has another colour"),
    "see-through": (_layer_says(1001, "AcCmTransparency"), "layer CUT_INNER is transparent"),
    "broad": (_layer_says(370, "30"), "layer CUT_INNER is drawn wider than 0.25 mm"),
    "dashed": (_layer_says(6, "DASHED"), "layer CUT_INNER is not drawn through"),
    "a layer twice": (_second_layer, "two layers cut_outer"),
    "a line": (_line_before, "a LINE stands on layer ENGRAVE"),
    "opened, with arcs": (_opened_at(0), "an open or bent polyline on layer ENGRAVE"),
    "opened, straight": (_opened_at(2, straight=True), "an open or bent polyline on layer CUT_INNER"),
    "one point": (_opened_at(0, straight=True, corners=1), "an open or bent polyline on layer ENGRAVE"),
    "splined": (lambda t: t[: _heads(t)[1]] + t[_heads(t)[1] :].replace(" 70\n1\n", " 70\n5\n", 1), "open or bent"),
}  # fmt: skip
SPOILS |= {
    "cut short": (lambda t: t[: len(t) // 2], "not a readable DXF"),
    "without its end": (lambda t: t.replace("  0\nEOF\n", ""), "too early"),
    "no number": (lambda t: t.replace("\n 20\n", "\n 20\nx", 1).replace(" 10\n", " 1o\n"), "not a readable DXF"),
    "a missing section": (lambda t: t.replace("  2\nENTITIES\n", "  2\nELSEWHERE\n"), "no section ENTITIES"),
    "an end too many": (lambda t: t.replace("  0\nEOF\n", "  0\nENDSEC\n  0\nEOF\n"), "ENDSEC in the wrong place"),
    "a handle twice": (lambda t: _with_handle(t, 1, _handle_of(t, 0)), "uses a handle twice"),
    "a free handle": (lambda t: _with_handle(t, 1, "FFFF"), "calls free"),
    "an open contour": (_opened, "an open or bent polyline"),
    "a layer that is not there": (lambda t: t.replace("  2\nCUT_INNER\n", "  2\nCUT_WITHIN\n"), "no layer CUT_INNER"),
    "a vertex without y": (lambda t: _without_last(t, " 20\n"), "vertices where"),
    "turned over": (_turned, "a plane of its own"),
}


def check_refused(file: Path, before: str, spoils: dict[str, tuple[Callable[[str], str], str]]) -> None:
    """Each of the ways to spoil a file is refused in its own words."""
    for name, (change, text) in spoils.items():
        after = change(before)
        assert after != before, name
        file.write_text(after, encoding="ascii", newline="\n")
        with pytest.raises(ReadError, match=text):
            read_dxf(file)


def test_a_spoiled_file_is_refused(file: Path) -> None:
    check_refused(file, file.read_text("ascii"), SPOILS)


# what says nothing that its absence would not say
HARMLESS: dict[str, Callable[[str], str]] = {
    **{f"group {c}": _with_group(c, v) for c, v in ((39, "0.0"), (48, "1.0"), (60, "0"), (62, "256"), (6, "ByLayer"),
                                                    (230, "1.0"), (370, "-1"), (1000, "words"))},
    "thin lines of the layer": _layer_says(370, "25"),
    "plotted": _layer_says(290, "1"),
    "continuous": _layer_says(6, "CONTINUOUS"),
    "locked": _layer_says(70, "4"),
    "another layer off": _layer_says(62, "-7", "0"),
    "engraved strokes": _opened_at(0, straight=True, corners=2),
}  # fmt: skip


def test_what_says_nothing_is_no_fault(file: Path) -> None:
    before, loops = file.read_text("ascii"), read_dxf(file).loops
    for name, change in HARMLESS.items():
        after = change(before)
        assert after != before, name
        file.write_text(after, encoding="ascii", newline="\n")
        again = read_dxf(file)
        assert len(again.loops) + len(again.strokes) == len(loops), name
        for one, other in zip(again.loops[::-1], loops[::-1], strict=False):
            assert np.array_equal(one.vertices, other.vertices), name
            assert np.array_equal(one.bulges, other.bulges), name


R2000_SPOILS: dict[str, tuple[Callable[[str], str], str]] = {
    "inches": (lambda t: t.replace("$INSUNITS\n 70\n4\n", "$INSUNITS\n 70\n1\n"), "not in mm"),
    "on paper": (
        lambda t: t[: _heads(t)[1]] + t[_heads(t)[1] :].replace("330\n17\n", "330\n1B\n", 1),
        "not stand in the model",
    ),
    "another count": (lambda t: t[: _heads(t)[1]] + t[_heads(t)[1] :].replace(" 90\n6\n", " 90\n5\n", 1), "5 are told"),
}


def test_a_spoiled_new_file_is_refused(tmp_path: Path) -> None:
    check_refused(tmp_path / "s.dxf", drawn("R2000"), R2000_SPOILS)


R12_SPOILS: dict[str, tuple[Callable[[str], str], str]] = {
    "a corner on another layer": (
        _once("VERTEX\n  5\n39\n  8\nCUT_INNER", "VERTEX\n  5\n39\n  8\nENGRAVE"),
        "vertices on another",
    ),
    "a corner lifted": (
        lambda t: t[: _heads(t)[3]] + " 30\n4.0\n".join(t[_heads(t)[3] :].rsplit(" 30\n0.0\n", 1)),
        "4.0 for group 30",
    ),
    "without SEQEND": (lambda t: t.replace("  0\nSEQEND\n  5\n37\n  8\nENGRAVE\n", ""), "has no SEQEND"),
}


def test_a_spoiled_old_file_is_refused(tmp_path: Path) -> None:
    check_refused(tmp_path / "s.dxf", drawn("R12"), R12_SPOILS)


def test_an_engraved_line_after_a_contour_is_refused(file: Path) -> None:
    text = file.read_text("ascii")
    file.write_text(_opened_at(0, straight=True, corners=2)(text), encoding="ascii", newline="\n")
    assert [len(s) for s in read_dxf(file).strokes] == [2]
    late = text.replace("CUT_OUTER", "<>").replace("ENGRAVE", "CUT_OUTER").replace("<>", "ENGRAVE")
    late = late.replace("ENGRAVE\n 70\n0\n 62\n1", "ENGRAVE\n 70\n0\n 62\n5").replace(
        "CUT_OUTER\n 70\n0\n 62\n5", "CUT_OUTER\n 70\n0\n 62\n1"
    )
    file.write_text(_opened_at(3, straight=True)(late), encoding="ascii", newline="\n")
    with pytest.raises(ReadError, match="an engraved line comes after"):
        read_dxf(file)


def test_a_pointer_to_nothing_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "p.dxf"
    file.write_text(drawn("R2000").replace("330\n17\n100\nAcDbEntity\n  8\nCUT", "330\nAAA\n100\nAcDbEntity\n  8\nCUT"))
    with pytest.raises(ReadError, match="points at a handle AAA"):
        read_dxf(file)


def test_what_ezdxf_saves_of_ours_is_read_alike(file: Path, tmp_path: Path) -> None:
    again = tmp_path / "again.dxf"
    ezdxf.readfile(file).saveas(again)
    for ours, theirs in zip(read_dxf(file).loops, read_dxf(again).loops, strict=True):
        assert np.array_equal(ours.vertices, theirs.vertices)
        assert np.array_equal(ours.bulges, theirs.bulges)
        assert ours.layer == theirs.layer


def test_verify_asks_ezdxf_too(tmp_path: Path) -> None:
    build_gear(tmp_path, Gear(2, 23, bore=8), {"format": "dxf"})
    file = tmp_path / "out" / "s" / "g.dxf"
    assert recheck(file).verdict.failures == ()
    # the line type of a layer without contours hurts none, which is why our own reader passes over it
    text = file.read_text("ascii")
    spoiled = text.replace("  6\nContinuous\n", "  6\nNOWHERE\n", 1)
    file.write_text(spoiled, encoding="ascii", newline="\n")
    read_dxf(file)
    with pytest.raises(ReadError, match="audit"):
        audited(file)
    assert any("audit" in f for f in recheck(file).verdict.failures)


def test_a_laser_build_imports_no_ezdxf(tmp_path: Path) -> None:
    import subprocess
    import sys

    scene = tmp_path / "s.toml"
    scene.write_text('[parts.g]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 23\n[[exports]]\nformat = "dxf"\n')
    code = f"import sys; from exporters.command.cli import main\ntry: main(['build', {str(scene)!r}, '--out', {str(tmp_path)!r}])\nexcept SystemExit: pass\nprint('ezdxf' in sys.modules, 'OCP' in sys.modules)"  # noqa: E501
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert told.splitlines()[-1] == "False False"
    assert "ezdxf" not in json.loads((tmp_path / "s" / "report.json").read_text("utf-8"))["versions"]


def test_the_extents_are_those_of_the_drawing(file: Path) -> None:
    header = ezdxf.readfile(file).header
    low, high = complex(*header["$EXTMIN"][:2]), complex(*header["$EXTMAX"][:2])
    dense = []
    for loop in read_dxf(file).loops:
        for a, b, bulge in zip(loop.vertices, np.roll(loop.vertices, -1), loop.bulges, strict=True):
            # points of an arc by its own sweep, turned about its centre
            sweep = 4 * np.arctan(bulge)
            share = np.linspace(0, 1, 4001)
            if bulge == 0:
                dense.append(a + (b - a) * share)
                continue
            centre = (a - b * np.exp(-1j * sweep)) / (1 - np.exp(-1j * sweep))
            dense.append(centre + (a - centre) * np.exp(1j * sweep * share))
    points = np.concatenate(dense)
    size = abs(high - low)
    for found, sampled in (
        (low.real, points.real.min()), (low.imag, points.imag.min()),
        (-high.real, -points.real.max()), (-high.imag, -points.imag.max()),
    ):  # fmt: skip
        assert sampled - 1e-6 * size < found <= sampled + 1e-14 * size
