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


SPOILS: dict[str, tuple[Callable[[str], str], str]] = {
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


@pytest.mark.parametrize("name", SPOILS)
def test_a_spoiled_file_is_refused(file: Path, name: str) -> None:
    change, text = SPOILS[name]
    before = file.read_text("ascii")
    after = change(before)
    assert after != before
    file.write_text(after, encoding="ascii", newline="\n")
    with pytest.raises(ReadError, match=text):
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
