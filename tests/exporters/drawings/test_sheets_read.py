"""Sheets of other hands: arcs as SVG 1.1 (F.6.5) has them, and paths of a PDF page told by their points and looks."""

from __future__ import annotations

import cmath
import math
import re
from itertools import pairwise
from pathlib import Path

import ezdxf
import numpy as np
import pytest

from exporters.drawings.read import read_sheets
from exporters.drawings.read_pdf import PdfPage, PdfPath
from exporters.drawings.write import write_sheet_dxf, write_sheet_svg
from geometry.approximation.splines import fit_spline
from geometry.base.placement import Placement2
from geometry.base.record import replace
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc
from parts.base.readback import ReadError
from parts.drawing.canvas import STYLES, Canvas, Stroke
from parts.drawing.readback import PER_CURVE

HEIGHT = 297.0


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> str:
    """An SVG with one stroke."""
    canvas = Canvas(210.0, HEIGHT, "A4")
    canvas.line("CAM", 40 + 70j, 80 + 70j)
    file = tmp_path_factory.mktemp("page") / "p.svg"
    write_sheet_svg(file, canvas)
    return file.read_text(encoding="utf-8")


def drawn(page: str, data: str, folder: Path) -> tuple[list[tuple[complex, float, float]], list[np.ndarray]]:
    """Arcs and points of a path in the place of the stroke."""
    (folder / "p.svg").write_text(re.sub(r' d="[^"]*"', f' d="{data}"', page), encoding="utf-8")
    (sheet,) = read_sheets(folder / "p.svg", [["CAM"]])
    assert (sheet.width, sheet.height) == (210.0, HEIGHT)
    return [(a.centre, a.radius, a.sweep) for a in sheet.arcs], [points for _, points in sheet.samples]


def by_the_standard(start: complex, end: complex, radius: float, large: int, sweep: int) -> tuple[complex, float]:
    """Centre and signed turn in the page's own axes, y downwards: F.6.5.1 to F.6.5.6 for a circle."""
    half = (start - end) / 2
    root = math.sqrt(max(radius**2 - abs(half) ** 2, 0.0) / abs(half) ** 2)
    own = (-1 if large == sweep else 1) * root * complex(half.imag, -half.real)
    centre = own + (start + end) / 2
    turn = cmath.phase((end - centre) / (start - centre))
    if sweep and turn < 0:
        turn += 2 * math.pi
    if not sweep and turn > 0:
        turn -= 2 * math.pi
    return centre, turn


@pytest.mark.parametrize("large", [0, 1])
@pytest.mark.parametrize("sweep", [0, 1])
@pytest.mark.parametrize("end", [90 + 100j, 55 + 142j, 60 + 81j])
def test_an_arc_goes_by_its_flags(large: int, sweep: int, end: complex, page: str, tmp_path: Path) -> None:
    start, radius = 60 + 120j, 25.0
    data = f"M{start.real},{start.imag} A{radius},{radius} 0 {large} {sweep} {end.real},{end.imag}"
    ((centre, size, turned),), (points,) = drawn(page, data, tmp_path)
    exact, turn = by_the_standard(start, end, radius, large, sweep)
    assert (turn > 0) is bool(sweep)
    assert (abs(turn) > math.pi) is bool(large)
    up = complex(exact.real, HEIGHT - exact.imag)
    assert centre == pytest.approx(up, abs=1e-9)
    assert (size, turned) == (radius, pytest.approx(abs(turn), abs=1e-9))
    way = exact + (start - exact) * np.exp(1j * turn * np.linspace(0, 1, PER_CURVE))
    assert points == pytest.approx(way.real + 1j * (HEIGHT - way.imag), abs=1e-9)


@pytest.mark.parametrize("sweep", [0, 1])
def test_arcs_that_follow_each_other_are_one(sweep: int, page: str, tmp_path: Path) -> None:
    """Three of 100 degrees, the first two alone, and a line after them that is its own."""
    way = 1 if sweep else -1
    ends = [100 + 100j + 20 * cmath.exp(1j * way * math.radians(30 + 100 * k)) for k in range(4)]
    path = f"M{ends[0].real},{ends[0].imag} " + " ".join(f"A20,20 0 0 {sweep} {e.real},{e.imag}" for e in ends[1:])
    ((centre, radius, turned),), (points,) = drawn(page, path, tmp_path)
    assert centre == pytest.approx(complex(100, HEIGHT - 100), abs=1e-9)
    assert (radius, turned) == (20.0, pytest.approx(math.radians(300), abs=1e-9))
    turns = np.concatenate([30 + 100 * k + 100 * np.linspace(0, 1, PER_CURVE) for k in range(3)])
    exact = 100 + 100j + 20 * np.exp(1j * way * np.radians(turns))
    assert points == pytest.approx(exact.real + 1j * (HEIGHT - exact.imag), abs=1e-9)


def test_a_piece_of_an_arc_that_turns_the_other_way_shows_in_its_points(page: str, tmp_path: Path) -> None:
    """Two half turns of one circle, the first of which is on the other side: an S."""
    ((_, radius, turned),), (points,) = drawn(page, "M20,50 A10,10 0 0 1 40,50 A10,10 0 0 0 60,50", tmp_path)
    assert (radius, turned) == (10.0, pytest.approx(2 * math.pi))
    assert (points.imag.min(), points.imag.max()) == pytest.approx((HEIGHT - 60, HEIGHT - 40), abs=1e-9)


def test_bezier_curves_follow_each_other_in_one_line(page: str, tmp_path: Path) -> None:
    """De Casteljau at each share of two pieces; y is turned over."""
    poles = [10 + 20j, 20 + 60j, 50 + 60j, 60 + 20j, 70 - 20j, 90 + 5j, 95 + 30j]
    path = f"M{poles[0].real},{poles[0].imag} " + " ".join(
        "C" + " ".join(f"{p.real},{p.imag}" for p in poles[k : k + 3]) for k in (1, 4)
    )
    arcs, (points,) = drawn(page, path, tmp_path)
    assert arcs == []
    exact = []
    for k in (0, 3):
        for t in np.linspace(0, 1, PER_CURVE):
            row = poles[k : k + 4]
            while len(row) > 1:
                row = [a + t * (b - a) for a, b in pairwise(row)]
            exact.append(complex(row[0].real, HEIGHT - row[0].imag))
    assert points == pytest.approx(np.array(exact), abs=1e-9)


@pytest.mark.parametrize(("data", "said"), [
    ("M1,2 L3", "the path command L lacks a coordinate"), ("M1,2 L", "the path command L lacks a coordinate"),
    ("M1,2 A5,6 0 0 1 3,4", "a circular arc"), ("M1,2 A5,5 0 0 1.5 3,4", "a circular arc"),
    ("M1,2 A5,5 0 -1 1 3,4", "a circular arc"),
    ("M1,2 Q3,4 5,6", "the path command Q"), ("M1,2 L3,4 Z", "the path command Z lacks a coordinate"),
])  # fmt: skip
def test_commands_that_no_sheet_has_are_named(data: str, said: str, page: str, tmp_path: Path) -> None:
    with pytest.raises(ReadError, match=said):
        drawn(page, data, tmp_path)


BLACK = STYLES["CAM"]


def path_of(*strokes: tuple[np.ndarray, ...]) -> PdfPath:
    return PdfPath(strokes, BLACK.colour, BLACK.width, BLACK.dashes)


def cubic_of_arc(centre: complex, radius: float, first: float, sweep: float) -> np.ndarray:
    """The usual four poles of a short arc: k = 4/3 tan(sweep / 4)."""
    reach = 4 / 3 * math.tan(sweep / 4)
    a, d = (cmath.exp(1j * angle) for angle in (first, first + sweep))
    return np.array([centre + radius * p for p in (a, a * (1 + 1j * reach), d * (1 - 1j * reach), d)])


def test_strokes_of_a_page_are_lines_arcs_and_curves() -> None:
    """A line, an arc of three cubics, a curve of a cubic and a line, and a bow that no circle follows."""
    line = np.array([10 + 10j, 40 + 50j])
    arc = tuple(cubic_of_arc(60 + 70j, 25.0, 0.4 + 0.2 * k, 0.2) for k in range(3))
    curve = np.array([0j, 10 + 20j, 30 + 20j, 40 + 0j])
    mixed = (curve, np.array([40 + 0j, 60 - 10j]))
    straight = (np.array([0j, 5 + 5j]), np.array([5 + 5j, 9 + 9j]))
    page = PdfPage(210.0, 297.0, [path_of((line,), arc, mixed, straight)])
    sheet = page.sheet(["CAM"])
    assert (sheet.width, sheet.height) == (210.0, 297.0)
    assert [(x.layer, x.start, x.end) for x in sheet.lines] == [("CAM", 10 + 10j, 40 + 50j)]
    (found,) = sheet.arcs
    assert (found.layer, found.centre) == ("CAM", pytest.approx(60 + 70j, abs=1e-3))
    assert (found.radius, found.sweep) == (pytest.approx(25, abs=1e-3), pytest.approx(0.6, abs=1e-5))
    t = np.linspace(0, 1, PER_CURVE)
    bow = (1 - t) ** 3 * curve[0] + 3 * t * (1 - t) ** 2 * curve[1] + 3 * t**2 * (1 - t) * curve[2] + t**3 * curve[3]
    assert len(sheet.samples) == 4
    assert sheet.samples[0][1] == pytest.approx(10 + 10j + (30 + 40j) * t)
    assert sheet.samples[2][1] == pytest.approx(np.concatenate([bow, 40 + (20 - 10j) * t]))
    assert np.abs(np.abs(sheet.samples[1][1] - (60 + 70j)) - 25).max() < 1e-6


@pytest.mark.parametrize("off", [3e-5, 4e-4])
def test_what_is_nearly_round_is_an_arc_to_a_tenth_of_a_micrometre(off: float) -> None:
    """A whole turn of 24 cubics, pulled to an ellipse: within 1e-4 mm of its mean circle, or beyond."""
    pieces = tuple(cubic_of_arc(0j, 30.0, math.radians(15 * k), math.radians(15)) for k in range(24))
    pulled = tuple(p.real * (1 + off / 30) + 1j * p.imag for p in pieces)
    sheet = PdfPage(210.0, 297.0, [path_of(pulled)]).sheet(["CAM"])
    assert bool(sheet.arcs) is (off < 1e-4)
    if sheet.arcs:
        assert (sheet.arcs[0].sweep, abs(sheet.arcs[0].centre)) == (
            pytest.approx(math.tau, abs=1e-6),
            pytest.approx(0, abs=1e-6),
        )


@pytest.mark.parametrize("changes", [
    {"colour": "#000001"}, {"width": BLACK.width + 2e-3}, {"dashes": (4.0, 1.5)},
])  # fmt: skip
def test_a_path_that_looks_otherwise_is_told_by_its_layer(changes: dict[str, object]) -> None:
    path = path_of((np.array([0j, 1 + 1j]),))
    with pytest.raises(ReadError, match="layer CAM looks otherwise"):
        PdfPage(10.0, 10.0, [replace(path, **changes)]).sheet(["CAM"])
    dashed = replace(path, colour=STYLES["TOOTH_START"].colour, width=0.25, dashes=(4.0, 1.5))
    assert PdfPage(10.0, 10.0, [dashed]).sheet(["TOOTH_START"]).samples[0][0] == "TOOTH_START"
    for dashes in ((4.0, 1.6), (4.0, 1.5, 0.5), ()):
        with pytest.raises(ReadError, match="layer TOOTH_START looks otherwise"):
            PdfPage(10.0, 10.0, [replace(dashed, dashes=dashes)]).sheet(["TOOTH_START"])
    with pytest.raises(ReadError, match="has 1 paths on a page instead of 2"):
        PdfPage(10.0, 10.0, [path]).sheet(["CAM", "CUT"])


def test_what_is_counted_is_what_stands_in_the_file(tmp_path: Path) -> None:
    """Of each kind so many entities as ezdxf finds: two lines, three arcs and a circle, splines and their dashes."""
    canvas = Canvas(210.0, HEIGHT, "A4")
    canvas.line("CAM", 40 + 70j, 80 + 70j)
    canvas.line("CENTRE", 40 + 70j, 80 + 90j)
    for k in range(3):
        canvas.add("OUTLINE", Arc(100 + 100j, 10.0 + k, 0.2, 1.5))
    canvas.add("OUTLINE", Arc(100 + 100j, 20.0, 0.0, math.tau))
    curve = fit_spline(Involute(20.0, 0.3, 0.3, 1.9), 1e-3, degree=3, continuity=2).spline
    for layer in ("OUTLINE", "TOOTH_START"):
        canvas.strokes.append(Stroke(layer, curve.placed(Placement2(0.0, 100 + 150j))))
    canvas.write("Wheel", 50 + 250j)
    canvas.write("x_{1} = 3", 50 + 230j)
    counts = write_sheet_dxf(tmp_path / "s.dxf", canvas)
    document = ezdxf.readfile(tmp_path / "s.dxf")
    space = document.modelspace()
    assert counts == {kind: len(space.query(kind)) for kind in ("LINE", "ARC", "CIRCLE", "SPLINE", "TEXT")}
    assert (counts["LINE"], counts["ARC"], counts["CIRCLE"], counts["TEXT"]) == (2, 3, 1, 4)
    # one whole spline, and as many dashes of 4 mm and gaps of 1.5 as its length holds
    length = float(np.abs(np.diff(curve.point(np.linspace(*curve.domain, 20_001)))).sum())
    assert counts["SPLINE"] == 1 + 1 + round((length - 4) / 5.5)
    low, high = document.header["$EXTMIN"], document.header["$EXTMAX"]
    assert (*low, *high) == (20, 5, 0, 205, 292, 0)
    assert write_sheet_svg(tmp_path / "s.svg", canvas) == {"paths": 8, "texts": 4}
