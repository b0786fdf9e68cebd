"""Writers and readers on a few curves and corners whose numbers are known: places, boxes, counts, chains, cuts."""

from __future__ import annotations

import math
import re
import struct
import tracemalloc
import uuid
import zipfile
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from xml.etree import ElementTree

import ezdxf
import numpy as np
import pytest

from exporters.formats.chains import chained, nodes, smooth_loops
from exporters.formats.drawing_dxf import add_curve, write_drawing_dxf
from exporters.formats.laser_dxf import write_laser_dxf
from exporters.formats.read_3mf import read_3mf, read_3mf_assembly
from exporters.formats.read_stl import read_stl
from exporters.formats.read_svg import read_svg
from exporters.formats.readback import Loop, ReadMesh, SmoothLoop
from exporters.formats.stl import write_stl
from exporters.formats.svg import number, path_data, write_laser_svg
from exporters.formats.threemf import MeshPart, write_3mf, write_3mf_assembly
from geometry.approximation.splines import fit_spline
from geometry.base.placement import Placement3
from geometry.base.tolerance import DRAWN_ROUNDING
from geometry.curves.curve import Complex
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc, Line
from geometry.plane.contour import Approximation, Contour, edge_points
from parts.base.readback import ReadError
from parts.solids.mesh import Mesh
from tests.exporters.making import svg_layer
from tests.exporters.spoil import in_model

SPLINE = fit_spline(Involute(20.0, 0.3, 0.3, 1.1), 1e-4, degree=3, continuity=2).spline


def drawing_of(curves: list[Any], folder: Path) -> tuple[dict[str, int], Any]:
    counts = write_drawing_dxf(folder / "d.dxf", (SimpleNamespace(curves=lambda: curves),))
    return counts, ezdxf.readfile(folder / "d.dxf")


def test_curves_stand_in_a_drawing_as_they_are(tmp_path: Path) -> None:
    """Lines, a circle, arcs either way round, a spline by its poles and knots; mm, one layer."""
    curves = [Line(1 + 2j, -5 + 8j), Arc(3 + 4j, 2.5, 0.3, 1.9), Arc(3 + 4j, 2.5, 0.3, -1.9), SPLINE,
              Arc(1j, 4.0, 1.0, 2 * math.pi), Arc(1j, 4.0, 1.0, -2 * math.pi), Line(0j, 1 + 0j)]  # fmt: skip
    counts, document = drawing_of(curves, tmp_path)
    assert counts == {"LINE": 2, "ARC": 2, "SPLINE": 1, "CIRCLE": 2}
    assert document.dxfversion == "AC1024"
    assert [document.header[name] for name in ("$INSUNITS", "$LUNITS", "$MEASUREMENT", "$PSVPSCALE")] == [4, 2, 1, 1]
    layer = document.layers.get("OUTLINE")
    assert (layer.color, layer.dxf.lineweight) == (7, 50)
    line, left, right, spline, *circles, _ = document.modelspace()
    assert {e.dxf.layer for e in document.modelspace()} == {"OUTLINE"}
    assert (complex(*line.dxf.start.vec2), complex(*line.dxf.end.vec2)) == (1 + 2j, -5 + 8j)
    for arc, (first, last) in ((left, (0.3, 2.2)), (right, (-1.6, 0.3))):
        assert (complex(*arc.dxf.center.vec2), arc.dxf.radius) == (3 + 4j, 2.5)
        assert (arc.dxf.start_angle, arc.dxf.end_angle) == pytest.approx(
            (math.degrees(first), math.degrees(last)), abs=1e-6
        )
    assert [complex(x, y) for x, y, z in spline.control_points] == pytest.approx(SPLINE.poles.tolist(), abs=1e-7)
    assert list(spline.knots) == pytest.approx(SPLINE.knots.tolist())
    assert spline.dxf.degree == 3
    assert [(complex(*c.dxf.center.vec2), c.dxf.radius) for c in circles] == [(1j, 4.0)] * 2


@pytest.mark.sampled(2)
@pytest.mark.parametrize("curves", [
    [Line(1 + 2j, -5 + 8j)], [Arc(3 + 4j, 2.5, 0.3, 2.9)], [Arc(3 + 4j, 2.5, 0.3, -4.9)], [Arc(1 + 1j, 3.0, 2.0, 6.2)],
    [Arc(1 + 1j, 3.0, 2.0, 2 * math.pi)], [Line(-9 + 1j, -8 - 4j), Arc(3 - 4j, 2.0, -0.2, 0.4), Line(0j, 1 + 7j)],
])  # fmt: skip
def test_a_drawing_is_as_large_as_its_curves(curves: list[Any], tmp_path: Path) -> None:
    """By many points of each; arcs may bulge out of their ends."""
    _, document = drawing_of(curves, tmp_path)
    points = np.concatenate([c.point(np.linspace(*c.domain, 200_001)) for c in curves])
    low, high = document.header["$EXTMIN"], document.header["$EXTMAX"]
    assert (low[0], low[1], high[0], high[1]) == pytest.approx(
        (points.real.min(), points.imag.min(), points.real.max(), points.imag.max()), abs=1e-8
    )
    assert low[2] == high[2] == 0


def test_a_spline_s_drawing_holds_its_poles(tmp_path: Path) -> None:
    _, document = drawing_of([SPLINE], tmp_path)
    low, high = document.header["$EXTMIN"], document.header["$EXTMAX"]
    assert (low[0], high[1]) == pytest.approx((SPLINE.poles.real.min(), SPLINE.poles.imag.max()), abs=1e-8)


@pytest.mark.parametrize("radius", [0.013, 0.5, 3.0, 10.0, 99.0, 2.3e4])
def test_ends_of_arcs_are_as_near_as_points(radius: float) -> None:
    """Angles have the more digits the larger the circle is."""
    space = ezdxf.new("R2010").modelspace()
    for first, sweep in ((0.123456789, 1.3), (2.0, -0.7), (5.9, 0.777777777)):
        assert add_curve(space, Arc(0j, radius, first, sweep), "0") == "ARC"
        told = space[-1].dxf
        low, high = sorted((first, first + sweep))
        for angle, exact in ((told.start_angle, low), (told.end_angle, high)):
            assert abs(math.radians(angle) - exact) * radius <= DRAWN_ROUNDING


def approximation(points: list[complex], bulges: list[float], count: int = 1) -> Approximation:
    return Approximation(Contour(np.array(points), np.array(bulges), count), 0.0, "exact", 0.01)


@pytest.mark.parametrize(("version", "kind"), [("R2000", "LWPOLYLINE"), ("R12", "POLYLINE")])
def test_a_laser_file_says_how_much_is_in_it(version: str, kind: str, tmp_path: Path) -> None:
    """A period of three edges, two of them bent, four times round; a square; two engraved strokes."""
    toothed = approximation([5 + 0j, 5 + 1j, 4 + 3j], [0.1, 0.0, -0.2], 4)
    square = approximation([0j, 1 + 0j, 1 + 1j, 1j], [0.0] * 4)
    strokes = [np.array([0j, 1 + 1j]), np.array([2 + 0j, 3 + 0j, 3 + 1j])]
    layers = ("CUT_INNER", "CUT_OUTER")
    counts = write_laser_dxf(tmp_path / "l.dxf", layers, (square, toothed), version=version, strokes=strokes)
    assert counts == {kind: 4, "strokes": 2, "vertices": 16, "arcs": 8}
    assert len(ezdxf.readfile(tmp_path / "l.dxf").modelspace()) == 4
    plain = write_laser_dxf(tmp_path / "l.dxf", layers, (square, toothed), version=version)
    assert plain == {kind: 2, "vertices": 16, "arcs": 8}
    assert write_laser_svg(tmp_path / "b.svg", layers, (square, toothed), strokes, 30 + 20j) == {
        "shapes": 2, "strokes": 2, "vertices": 16
    }  # fmt: skip
    plain = write_laser_svg(tmp_path / "b.svg", layers, (square, toothed), board=30 + 20j)
    assert plain == {"shapes": 2, "vertices": 16}
    assert 'width="30mm" height="20mm" viewBox="0 0 30 20"' in (tmp_path / "b.svg").read_text("utf-8")


CIRCLE = approximation([60 + 0j, -60 + 0j], [1.0, 1.0])
SLOT = approximation([2 + 1j, -2 + 1j, -2 - 1j, 2 - 1j], [0.0] * 4)
HOLE = approximation([9 + 0j, 5 + 0j], [-1.0, -1.0])


def lasergrbl(file: Path) -> list[tuple[str, float]]:
    """What LaserGRBL cuts, in its order: all circles, then all paths; how far its chords leave the arcs of each, mm.

    parseBasicElements and parsePath, calcArc and GetBezierApproximation of its GCodeFromSVG.cs: each quarter of a turn
    that an arc has begun is cut in 12 chords.
    """
    root = ElementTree.parse(file).getroot()
    cut = [(svg_layer(e), 0.0) for e in root if e.tag.endswith("circle")]
    for path in (e for e in root if e.tag.endswith("path")):
        at, worst = 0j, 0.0
        for command, text in re.findall("([MLA])([^MLAZ]*)", path.attrib["d"]):
            numbers = [float(x) for x in text.replace(",", " ").split()]
            to = complex(*numbers[-2:])
            if command == "A":
                turn = 2 * math.asin(min(1.0, abs(to - at) / 2 / numbers[0]))
                chords = 12 * math.ceil(turn / (math.pi / 2))
                worst = max(worst, numbers[0] * (1 - math.cos(turn / chords / 2)))
            at = to
        cut.append((svg_layer(path), worst))
    return cut


@pytest.mark.parametrize("strokes", [(), (np.array([0j, 1 + 1j]),)], ids=["cut", "engraved"])
@pytest.mark.parametrize(
    ("inner", "round_ones"), [((SLOT,), 0), ((HOLE, SLOT), 1), ((HOLE,), 2)], ids=["slot", "both", "hole"]
)
def test_lasergrbl_cuts_an_svg_in_its_order(
    inner: tuple[Approximation, ...], round_ones: int, strokes: tuple[Complex, ...], tmp_path: Path
) -> None:
    """A disc comes out last, after its slot, and engraving first, though LaserGRBL takes circles before paths."""
    layers = (*["CUT_INNER"] * len(inner), "CUT_OUTER")
    write_laser_svg(tmp_path / "disc.svg", layers, (*inner, CIRCLE), strokes)
    cut = lasergrbl(tmp_path / "disc.svg")
    assert [name for name, _ in cut] == [*["engrave"] * len(strokes), *["cut_inner"] * len(inner), "cut_outer"]
    # a circle that stands before all paths stays one, which LaserGRBL cuts with true arcs
    assert (tmp_path / "disc.svg").read_text("utf-8").count("<circle") == (0 if strokes else round_ones)


def test_lasergrbl_follows_the_arcs_of_an_svg(tmp_path: Path) -> None:
    """Within the 0.002 mm to which Grbl itself follows an arc: 0.13 mm off one of 60 mm that is cut in four."""
    write_laser_svg(tmp_path / "disc.svg", ("CUT_INNER", "CUT_OUTER"), (SLOT, CIRCLE))
    (_, straight), (_, bent) = lasergrbl(tmp_path / "disc.svg")
    assert straight == 0
    assert 0.001 < bent <= 0.002
    (_, outer) = read_svg(tmp_path / "disc.svg").loops
    ends = np.roll(outer.vertices, -1)
    assert np.abs(np.abs(edge_points(outer.vertices, ends, outer.bulges, np.linspace(0, 1, 9))) - 60).max() < 1e-5


def test_a_disc_that_lasergrbl_cuts_before_its_slot_is_seen(tmp_path: Path) -> None:
    write_laser_svg(tmp_path / "disc.svg", ("CUT_INNER", "CUT_OUTER"), (SLOT, CIRCLE))
    lines = (tmp_path / "disc.svg").read_text("utf-8").splitlines()
    style = lines[-2].partition(' id="')[2]
    lines[-2] = f'<circle cx="62" cy="62" r="60" id="{style}'
    (tmp_path / "disc.svg").write_text("\n".join(lines), "utf-8")
    with pytest.raises(ReadError, match="a circle stands behind a path"):
        read_svg(tmp_path / "disc.svg")


@pytest.mark.parametrize(("value", "decimals", "text"), [
    (100.0, 0, "100"), (100.0, 3, "100"), (1.2345678, 3, "1.235"), (-0.0004, 3, "0"), (-0.0, 2, "0"), (0.5, 3, "0.5"),
    (-2.50, 4, "-2.5"), (10.0, 1, "10"),
])  # fmt: skip
def test_numbers_have_no_zeros_that_say_nothing(value: float, decimals: int, text: str) -> None:
    assert number(value, decimals) == text


@pytest.mark.parametrize("bulge", [0.3, -0.3, 0.99, 1.0, -1.0, 2.5, -4.0, 0.46, 0.47])
def test_an_arc_of_a_picture_is_the_one_through_its_ends(bulge: float) -> None:
    """By its radius and flags, in quarters where it is long: all its points are as far from its centre."""
    start, end = 1 + 2j, 6 + 3j
    data = path_data(Contour(np.array([start, end]), np.array([bulge, 0.0])), 0j)
    half = 2 * math.atan(bulge)
    centre = (start + end) / 2 + 1j * (end - start) / 2 / math.tan(half)
    words = data.replace(",", " ").split()
    places, at = [], 0
    while at < len(words) - 1:
        size = {"M": 2, "L": 2, "A": 7}[words[at][0]]
        numbers = [float(words[at][1:]), *map(float, words[at + 1 : at + size])]
        places.append((words[at][0], numbers))
        at += size
    assert words[-1] == "Z"
    kinds = [kind for kind, _ in places]
    # beyond 100 degrees of turn an arc is cut into four
    arcs = 4 if abs(bulge) > math.tan(math.radians(25)) else 1
    assert kinds == ["M", "A", "L"] if arcs == 1 else ["M", "A", "A", "A", "A", "L"]
    points = [complex(numbers[-2], -numbers[-1]) for _, numbers in places]
    assert (points[0], points[-2], points[-1]) == (
        pytest.approx(start, abs=1e-5),
        pytest.approx(end, abs=1e-5),
        pytest.approx(start, abs=1e-5),
    )
    for k, (kind, numbers) in enumerate(places):
        assert abs(points[k] - centre) == pytest.approx(abs(start - centre), abs=1e-5)
        if kind == "A":
            turn = 2 * half / arcs
            assert numbers[0] == numbers[1] == pytest.approx(abs(start - centre), rel=1e-4)
            assert numbers[2:5] == [0, 0, 1 if bulge < 0 else 0]
            exact = centre + (points[k - 1] - centre) * np.exp(1j * turn)
            assert points[k] == pytest.approx(exact, abs=1e-4)


SIDES = [np.array([0j, 2, 4]), np.array([4, 4 + 3j]), np.array([4 + 3j, 2 + 5j, 3j]), np.array([3j, 0j])]
FAR = [piece + 100 for piece in SIDES]


@pytest.mark.parametrize("seed", range(4))
def test_pieces_in_any_order_and_sense_are_chained(seed: int) -> None:
    """Two loops, a circle of one piece; each begins with its first piece as that is run."""
    rng = np.random.default_rng(seed)
    circle = 50 + 50j + np.exp(1j * np.linspace(0, math.tau, 9))
    circle[-1] = circle[0]
    pieces = [p if rng.random() < 0.5 else p[::-1] for p in (*SIDES, *FAR, circle)]
    order = rng.permutation(len(pieces)).tolist()
    loops = chained([pieces[k] for k in order])
    assert sorted(len(loop) for loop in loops) == [6, 6, 8]
    wanted = {0j, 2, 4, 4 + 3j, 2 + 5j, 3j}
    for loop in loops:
        if len(loop) == 6:
            off = 100 if loop.real.max() > 50 else 0
            assert {complex(p) - off for p in loop} == wanted
            # neighbours of the loop are neighbours of the square
            for a, b in zip(loop, np.roll(loop, -1), strict=True):
                assert abs(b - a) in (2, 3, pytest.approx(2 * math.sqrt(2)))


@pytest.mark.parametrize(("gap", "closed"), [(0.9, True), (1.1, False)])
def test_ends_meet_as_well_as_a_drawing_s_digits(gap: float, closed: bool) -> None:
    """Twice the rounding of numbers, and a billionth of the greatest."""
    joint = 2 * DRAWN_ROUNDING + 1e-9 * abs(2 + 5j)
    pieces = [SIDES[0], SIDES[1] + gap * joint, *SIDES[2:]]
    if closed:
        assert len(chained(pieces)) == 1
    else:
        with pytest.raises(ReadError, match=r"a contour is open at \(4"):
            chained(pieces)
    assert chained([]) == []


def test_polynomials_come_back_from_their_samples() -> None:
    """Of degree 11, span by span; run backwards they are polynomials of 1 - t."""
    rng = np.random.default_rng(3)
    share = nodes()
    assert (share[0], share[-1], len(share)) == (0.0, 1.0, 12)
    assert share + share[::-1] == pytest.approx(np.ones(12))
    first = rng.normal(size=12) + 1j * rng.normal(size=12)
    second = rng.normal(size=12) + 1j * rng.normal(size=12)
    # the second runs from the end of the first to its beginning
    second[0] = first[0]
    second[1:] *= (first.sum() - first[0]) / second[1:].sum()
    spans = [np.vander(share, 12, increasing=True) @ c for c in (first, second)]
    (loop,) = smooth_loops(spans)
    t = np.linspace(0, 1, 11)
    made = np.vander(t, 12, increasing=True) @ loop.coefficients.T
    exact = np.vander(t, 12, increasing=True) @ np.array([first, second]).T
    assert made[:, 0] == pytest.approx(exact[:, 0], abs=1e-8)
    assert made[:, 1] == pytest.approx(exact[::-1, 1], abs=1e-8)
    assert loop.points[0] == pytest.approx(first[0])
    assert SmoothLoop(np.array([[1 + 2j, 5], [4 - 7j, 1], [-2 + 0j, 3]])).size == 6.0
    assert Loop(np.array([3 + 0j, -3]), np.array([1.0, 1.0]), "").size == pytest.approx(9 * math.pi)


@pytest.mark.parametrize(("turn", "off"), [(1.0, 1e-14), (math.pi / 2, 1e-12)])
def test_arcs_come_back_from_their_samples(turn: float, off: float) -> None:
    """By eight of them one of a radian was 1.5e-9 of its radius off: arcs of wheels of 2 m failed their read-back."""
    there = np.exp(1j * turn * nodes())
    (loop,) = smooth_loops([there, there[-1] + (there[0] - there[-1]) * nodes()])
    made = np.vander(np.linspace(0, 1, 101), 12, increasing=True) @ loop.coefficients.T[:, :1]
    assert np.abs(np.abs(made) - 1).max() < off


PRISM = np.array([[x, y, z] for z in (0.0, 4.0) for x, y in ((0, 0), (6, 0), (6, 3), (0, 3))])
WALLS = [[a, b, b + 4] for a, b in ((0, 1), (1, 2), (2, 3), (3, 0))] + [
    [a, b + 4, a + 4] for a, b in ((0, 1), (1, 2), (2, 3), (3, 0))
]
BOX = ReadMesh(PRISM, np.array([*WALLS, [0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7]]))
PYRAMID = ReadMesh(np.array([[0, 0, 0], [6, 0, 0], [6, 3, 0], [0, 3, 0], [2, 1, 4.0]]),
                   np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [0, 2, 1], [0, 3, 2]]))  # fmt: skip


def test_a_plane_cuts_a_mesh_in_its_outline() -> None:
    """A box in its corners alone, whatever its diagonals are; a pyramid a quarter of its height up."""
    (loop,) = BOX.section(1.0)
    assert sorted(loop.vertices.tolist(), key=lambda p: (p.real, p.imag)) == [0j, 3j, 6 + 0j, 6 + 3j]
    assert loop.size == 18
    assert not loop.bulges.any()
    (loop,) = PYRAMID.section(1.0)
    exact = [complex(x + (2 - x) / 4, y + (1 - y) / 4) for x, y in ((0, 0), (0, 3), (6, 0), (6, 3))]
    # a diagonal of its foot is not cut
    assert sorted(loop.vertices.tolist(), key=lambda p: (p.real, p.imag)) == pytest.approx(exact)
    assert BOX.section(5.0) == ()
    two = ReadMesh(np.vstack([PRISM, PRISM + np.array([10, 0, 0])]), np.vstack([BOX.triangles, BOX.triangles + 8]))
    assert sorted(loop.vertices.real.min() for loop in two.section(2.0)) == [0, 10]
    with pytest.raises(ReadError, match="not closed"):
        ReadMesh(PRISM, BOX.triangles[1:]).section(1.0)
    assert BOX.faces().shape == (12, 3, 3)
    assert (BOX.names(), ReadMesh(PRISM, BOX.triangles, "b").names()) == (None, ("b",))


MESH = Mesh(PRISM, BOX.triangles)


def test_a_normal_of_an_stl_agrees_with_its_corners_or_is_not_given(tmp_path: Path) -> None:
    """Leant by 5 degrees, whose cosine is above 0.99, it passes; by 10, turned round or taken from another side not."""
    write_stl(tmp_path / "m.stl", MESH)
    data = (tmp_path / "m.stl").read_bytes()
    # the last triangle lies in the upper face
    at = 84 + 50 * 11
    assert struct.unpack_from("<3f", data, at) == (0, 0, 1)
    leant = {degrees: (math.sin(math.radians(degrees)), 0.0, math.cos(math.radians(degrees))) for degrees in (5, 10)}
    for normal, passes in (
        (leant[5], True),
        ((0, 0, 0), True),
        (leant[10], False),
        ((0, 0, -1), False),
        ((0, 1, 0), False),
    ):
        (tmp_path / "n.stl").write_bytes(data[:at] + struct.pack("<3f", *normal) + data[at + 12 :])
        if passes:
            assert len(read_stl(tmp_path / "n.stl").triangles) == 12
            continue
        with pytest.raises(ReadError, match="normal"):
            read_stl(tmp_path / "n.stl")


def test_meshes_come_back_as_they_were_written(tmp_path: Path) -> None:
    """Counts, corners and triangles; one item that stays where it is, one that is moved."""
    assert write_stl(tmp_path / "m.stl", MESH) == {"triangles": 12, "vertices": 8}
    found = read_stl(tmp_path / "m.stl")
    assert len(found.vertices) == 8
    assert np.array_equal(found.vertices[found.triangles], PRISM[BOX.triangles])
    part = MeshPart("m", MESH, "#0a14ff", "Box", "PLA")
    assert write_3mf(tmp_path / "m.3mf", part) == {"triangles": 12, "vertices": 8}
    places = [("here", "m", Placement3()), ("there", "n", Placement3(translation=(1.0, 2.0, 3.25)))]
    counts = write_3mf_assembly(tmp_path / "a.3mf", "All", [part, MeshPart("n", MESH, None)], places)
    assert counts == {"triangles": 24, "vertices": 16}
    whole = read_3mf_assembly(tmp_path / "a.3mf")
    assert whole.title == "All"
    assert [(p.name, p.colour) for p in whole.prototypes] == [("m", "#0a14ff"), ("n", "#b8c4d0")]
    assert [p.part.title for p in whole.prototypes] == ["Box", None]
    assert [p.part.material for p in whole.prototypes] == ["PLA", "n"]
    assert [(o.name, o.prototype, o.place[:, 3].tolist()) for o in whole.occurrences] == [
        ("here", 0, [0, 0, 0]), ("there", 1, [1.0, 2.0, 3.25])
    ]  # fmt: skip
    # an item without a place stands where its part does
    (single,) = read_3mf_assembly(tmp_path / "m.3mf").occurrences
    assert np.array_equal(single.place, np.eye(3, 4))


@pytest.mark.parametrize("index", [-1, 8])
def test_a_triangle_of_a_3mf_names_a_vertex_that_is_there(index: int, tmp_path: Path) -> None:
    """The last of eight is 7 (3MF core specification, 4.1.4.1); -1 is not another word for it."""
    write_3mf(tmp_path / "m.3mf", MeshPart("m", MESH, None))
    assert len(read_3mf(tmp_path / "m.3mf").vertices) == 8
    in_model(lambda text: re.sub(r'(v[123])="7"', rf'\1="{index}"', text))(tmp_path / "m.3mf")
    with pytest.raises(ReadError, match="a vertex that is not there"):
        read_3mf(tmp_path / "m.3mf")


def test_objects_and_items_of_a_3mf_are_the_same_at_every_writing(tmp_path: Path) -> None:
    """All identities are those of RFC 4122, 4.3, by the ids of parts and occurrences; none is random."""
    part = MeshPart("m", MESH, "#0a14ff", "Box")
    places = [("here", "m", Placement3()), ("there", "m", Placement3(translation=(30.0, 2.0, 3.25)))]
    for file, roots in (
        ("m.3mf", ["object/m", "item/m", "build/m"]),
        ("a.3mf", ["object/All/m", "item/All/here", "item/All/there", "build/All"]),
    ):
        written = []
        for _ in range(2):
            if file == "m.3mf":
                write_3mf(tmp_path / file, part)
            else:
                write_3mf_assembly(tmp_path / file, "All", [part], places)
            written.append((tmp_path / file).read_bytes())
        assert written[0] == written[1]
        model = zipfile.ZipFile(tmp_path / file).read("3D/3dmodel.model").decode()
        found = set(re.findall(r'UUID="([^"]+)"', model))
        assert found == {str(uuid.uuid5(uuid.NAMESPACE_URL, f"higherpair/{root}")) for root in roots}


@pytest.mark.parametrize(
    ("there", "instead", "why"),
    [
        ("<vertices>", "<vertices><vertex x='0' y='0' z='0' w='1'/>", "has w, which is not read here"),
        ("</vertices>", "</vertices><slices/>", "holds <slices>, which is not read here"),
        ("<build", "<vertex x='0' y='0' z='0'/><build", "stands in no object"),
    ],
)
def test_what_a_3mf_has_beside_its_meshes_is_not_passed_over(
    there: str, instead: str, why: str, tmp_path: Path
) -> None:
    write_3mf(tmp_path / "m.3mf", MeshPart("m", MESH, None))
    in_model(lambda text: text.replace(there, instead, 1))(tmp_path / "m.3mf")
    with pytest.raises(ReadError, match=why):
        read_3mf(tmp_path / "m.3mf")


def test_reading_a_3mf_keeps_its_numbers_alone(tmp_path: Path) -> None:
    """Each vertex and triangle was an element of a tree: a gear at the finest tolerance told took 2.6 GB."""
    a, b = np.divmod(np.arange(15_000), 150)
    one = np.flatnonzero((a < 99) & (b < 149))
    flat = np.concatenate([np.stack([one, one + 150, one + 1], 1), np.stack([one + 1, one + 150, one + 151], 1)])
    mesh = Mesh(np.stack([a, b, np.zeros(15_000)], axis=1), flat)
    write_3mf(tmp_path / "m.3mf", MeshPart("m", mesh, None))
    tracemalloc.start()
    made = read_3mf(tmp_path / "m.3mf")
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert np.abs(made.vertices - mesh.vertices).max() < 1e-4
    assert np.array_equal(made.triangles, flat)
    # the numbers twice, of whole packages; as elements they were 34 times as much
    assert most < 5 * (made.vertices.nbytes + made.triangles.nbytes)
