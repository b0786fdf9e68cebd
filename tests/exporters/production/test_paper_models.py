"""Outlines of paper models: lines and arcs by their bulges, by hand, and round things as arcs."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.command.cli import main
from exporters.production import paper_models
from exporters.production.plan import plan_build
from exporters.verification.verdict import Verdict
from geometry.base.record import replace
from geometry.curves.curve import Complex, Real, end_point, start_point
from geometry.curves.line_arc import Arc, Line
from geometry.plane.contour import Approximation, Contour
from geometry.plane.measure import distance_to_nearest
from geometry.plane.profile import Profile
from parts.drawing import tiles
from parts.drawing.readback import ReadSheet, Taken
from parts.drawing.tiles import OnOutlines
from parts.scene.load import scene_from_toml

PLATE = """
[scene]
title = "Two plates"
[parts.first]
kind = "plate"
width = 40.0
height = 30.0
holes = [{ at = [5.0, 2.0], diameter = 8.0 }]
title = "Plate"
[parts.second]
kind = "plate"
width = 20.0
height = 10.0
title = "Plate"
[[exports]]
format = "pdf"
purpose = "model"
tolerance = 0.02
"""


@pytest.mark.parametrize("bulge", [1.0, -1.0, 0.5, -0.3, math.tan(math.radians(260) / 4)])
def test_an_arc_has_the_ends_and_the_height_of_its_bulge(bulge: float) -> None:
    """The height of its segment is half of the chord times the bulge, to the right where it turns left."""
    start, end = 3 + 1j, -2 + 5j
    arc = paper_models._arc(start, end, bulge)
    assert arc.sweep == pytest.approx(4 * math.atan(bulge))
    for share, expected in ((0.0, start), (1.0, end), (0.5, (start + end) / 2 - 0.5j * bulge * (end - start))):
        point = arc.centre + cmath.rect(arc.radius, arc.start_angle + share * arc.sweep)
        assert point == pytest.approx(expected, abs=1e-12)
    assert arc.radius == pytest.approx(abs(end - start) * (1 + bulge**2) / (4 * abs(bulge)))


def test_what_is_flatter_than_rounding_is_a_line() -> None:
    contour = Contour(np.array([0, 4, 4 + 3j, 3j]), np.array([0.0, 2e-8, -0.9e-8, -0.5]))
    edges = paper_models._edges(contour)
    assert [type(edge) for edge in edges] == [Line, Arc, Line, Arc]
    assert [(start_point(edges[k]), end_point(edges[k])) for k in (0, 2)] == [(0, 4), (4 + 3j, 3j)]


def test_round_holes_are_arcs_and_names_are_told_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    """A plate of 40 x 30 mm has four sides and its hole about (5, 2); a second one of its name has its id behind it."""
    seen: list[Any] = []
    whole = paper_models.model_pages
    monkeypatch.setattr(paper_models, "model_pages", lambda *given: seen.append(given) or whole(*given))
    (job,) = plan_build(scene_from_toml(PLATE.encode(), "s.toml", "s"), "s", [], []).sheets
    title, outlines, _, errors, paper, _ = seen[0]
    assert (title, list(outlines), list(errors), paper) == ("Two plates", ["Plate", "Plate second"], [*outlines], "A4")
    lines = [edge for edge in outlines["Plate"] if isinstance(edge, Line)]
    arcs = [edge for edge in outlines["Plate"] if isinstance(edge, Arc)]
    assert sorted(abs(edge.end - edge.start) for edge in lines) == [30, 30, 40, 40]
    assert all(abs(edge.centre - (5 + 2j)) < 1e-12 and abs(edge.radius - 4) < 1e-12 for edge in arcs)
    assert sum(abs(edge.sweep) for edge in arcs) == pytest.approx(2 * math.pi)
    assert len(outlines["Plate second"]) == 4
    assert all(0 <= error <= 0.02 for error in errors.values())
    assert job is not None


def test_the_axis_is_marked_where_sheets_overlap_and_parts_are_called_by_their_kind() -> None:
    """Of a wheel on two sheets the axis lies between both, and neither had its mark."""
    wheel = '[parts.wheel]\nkind = "spur_gear"\nmodule = 10.0\nnumber_of_teeth = 20\n'
    export = '[[exports]]\nformat = "pdf"\npurpose = "model"\ntolerance = 0.02\n'
    raw = f'[scene]\nlanguage = "uk"\n{wheel}{export}'
    (job,) = plan_build(scene_from_toml(raw.encode(), "s.toml", "s"), "s", [], []).sheets
    _, *tiles = [page.canvas for page in job.pages]
    assert [sum(stroke.layer == "CENTRE_MARK" for stroke in tile.strokes) for tile in tiles] == [2, 2]
    assert all(any(word.text.startswith("Колесо зубчасте wheel, масштаб 1:1") for word in tile.texts) for tile in tiles)


def test_a_long_title_with_breaks_stands_in_one_line_within_the_frame() -> None:
    """As many letters as a title may have fill the list of the cover, which keeps within what a printer prints."""
    title = r"Колесо\tдовга\r\nназва\u2028" * 4
    (job,) = plan_build(
        scene_from_toml(PLATE.replace('"Plate"', f'"{title}"').encode(), "s.toml", "s"), "s", [], []
    ).sheets
    told = [word.text for page in job.pages for word in page.canvas.texts]
    assert sum("Колесо довга  назва Колесо" in text for text in told) == 4
    assert not any(broad in text for text in told for broad in "\t\r\n\u2028")
    lines = [stroke.curve for stroke in job.canvas.strokes]
    ends = np.array([point for line in lines for point in (start_point(line), end_point(line))])
    assert job.canvas.frame.grown(1e-9).holds(ends) == len(ends)


def model_of(parts: str, asked: str = "") -> Any:
    """The job of a paper model of some parts."""
    export = f'[[exports]]\nformat = "pdf"\npurpose = "model"\ntolerance = 0.02\n{asked}'
    (job,) = plan_build(scene_from_toml(f"{parts}{export}".encode(), "s.toml", "s"), "s", [], []).sheets
    return job


@pytest.mark.parametrize("many", [False, True], ids=["alone", "together"])
def test_a_model_is_held_against_the_exact_outline(many: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Within its tolerance of the involute itself; arcs that miss it by 0.03 mm, drawn as they should be, are seen."""
    gear = '[parts.gear]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 12\nface_width = 3.0\n'
    parts = gear + plate_of("plate", 20.0, 10.0) * many

    def judged() -> Verdict:
        job = model_of(parts)
        job.write(None, tmp_path / "m.pdf")
        return job.verify(tmp_path / "m.pdf", 0.02)

    good = judged()
    assert not good.failures
    assert 0.002 < good.measured["max_deviation"] <= 0.02
    right = paper_models.approximate_profile

    def grown(*given: Any, **named: Any) -> Approximation:
        made = right(*given, **named)
        return replace(made, geometry=replace(made.geometry, vertices=made.geometry.vertices * (1 + 0.03 / 14)))

    monkeypatch.setattr(paper_models, "approximate_profile", grown)
    bad = judged()
    assert bad.failures
    assert bad.measured["max_deviation"] == pytest.approx(0.03, abs=0.01)


def plate_of(name: str, width: float, height: float) -> str:
    return f'[parts.{name}]\nkind = "plate"\nwidth = {width}\nheight = {height}\nface_width = 3.0\n'


def test_points_on_a_sheet_are_held_against_the_outline_beside_them(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every one was measured thoroughly from all outlines of its sheet, a tenth of a build of a lesson."""
    turn, asked = np.exp(2j * np.pi * np.arange(48) / 48), []
    plan = plan_build(scene_from_toml(PLATE.encode(), "s.toml", "s"), "s", [], [])
    profiles = plan.parts["second"].section(0.0).region.profiles()
    points = np.concatenate([np.linspace(-10, 10, 9) + 5j, 2.0 + (0.1 + 5.0) * 1j + 0.0 * turn])
    measured = distance_to_nearest

    def counted(points: Complex, profiles: Sequence[Profile], trusted: float) -> Real:
        asked.append(points.size)
        return measured(points, profiles, trusted)

    monkeypatch.setattr("parts.drawing.tiles.distance_to_nearest", counted)
    places = (0j, 100 + 0j, 60j)
    sheet = ReadSheet(samples=[("CUT", points + at) for at in places])
    taken = Taken(0.2)
    OnOutlines(tuple((at, profiles) for at in places)).check(sheet, taken)
    assert taken.measured["max_deviation"] == pytest.approx(0.1)
    assert not taken.failures
    assert sum(asked) == 3 * points.size


def test_parts_that_one_sheet_holds_share_it_ten_millimetres_apart() -> None:
    """Of A4 194 x 281 mm are printed on: two rows of two plates of 80 x 120 with their captions, the fifth alone."""
    plates = "".join(plate_of(name, 80.0, 120.0) for name in "abcde")
    job = model_of(plates + plate_of("long", 260.0, 20.0) + plate_of("wide", 260.0, 300.0))
    cover, four, fifth, lying, *tiles = job.pages
    assert [len(page.curves["CUT"]) for page in (four, fifth, lying)] == [16, 4, 4]
    assert (len(tiles), lying.canvas.width) == (2, 297)
    boxes = []
    for k in range(0, 16, 4):
        corners = np.array([start_point(edge) for edge in four.curves["CUT"][k : k + 4]])
        assert four.canvas.frame.grown(1e-9).holds(corners) == 4
        low, high = complex(corners.real.min(), corners.imag.min()), complex(corners.real.max(), corners.imag.max())
        assert high - low == pytest.approx(80 + 120j)
        boxes.append((low, high))
    for k, (low, high) in enumerate(boxes):
        for other_low, other_high in boxes[:k]:
            apart = other_low - high, low - other_high
            assert max(*(p.real for p in apart), *(p.imag for p in apart)) >= 10 - 1e-9
    told = [word.text for word in cover.canvas.texts]
    assert [told.count(where) for where in ("sheet 2", "sheet 3", "sheet 4", "sheets 5 to 6")] == [4, 1, 1, 1]
    captions = [word.text for word in four.canvas.texts if "1:1" in word.text]
    assert len(captions) == 4


def test_a_long_arc_beside_the_frame_keeps_within_it(tmp_path: Path) -> None:
    """The blank of a sector is two arcs of 111 degrees: by 33 places along each, it reached 0.007 mm less far."""
    scene = """
[parts.sector]
kind = "spur_gear"
module = 2.0
number_of_teeth = 31
sector = { teeth = 12 }
[parts.pinion]
kind = "spur_gear"
module = 2.0
number_of_teeth = 14
[[exports]]
format = "pdf"
purpose = "model"
"""
    (tmp_path / "sector.toml").write_text(scene, encoding="utf-8")
    assert main(["build", str(tmp_path / "sector.toml"), "--out", str(tmp_path / "out"), "--quiet"]) == 0


def test_the_mark_of_a_small_part_keeps_within_the_sheet() -> None:
    """The cross of 8 mm of a part of 6 mm at the edge of the sheet left its frame, and the file was refused."""
    _, sheet = model_of(plate_of("a", 40.0, 40.0) + plate_of("b", 6.0, 6.0)).pages
    _, small = model_of(plate_of("a", 180.0, 40.0) + plate_of("b", 6.0, 6.0)).pages
    for canvas, marks in ((sheet.canvas, 4), (small.canvas, 2)):
        crosses = [stroke.curve for stroke in canvas.strokes if stroke.layer == "CENTRE_MARK"]
        ends = np.array([point for line in crosses for point in (start_point(line), end_point(line))])
        assert (len(crosses), canvas.frame.holds(ends)) == (marks, len(ends))


def test_no_rod_is_cut_out_of_paper_where_the_notes_tell_its_length() -> None:
    """The rod is called for by its name, or where no notes say how long it is to be cut."""
    parts = plate_of("arm", 40.0, 12.0) + '[parts.axle]\nkind = "pin"\ndiameter = 6.0\nlength = 20.0\n'
    noted = '[scene]\nnotes = ["Glue."]\n'
    for scene, asked, number in ((noted, "", 1), ("", "", 2), (noted, 'parts = ["arm", "axle"]\n', 2)):
        told = [
            word.text
            for page in model_of(scene + parts, asked).pages
            for word in page.canvas.texts
            if "1:1" in word.text
        ]
        assert len(told) == number, (scene, asked)


def test_a_tile_cuts_what_may_lie_on_it_alone() -> None:
    """Each of 175 000 tiles cut the whole outline: a model of a wheel of 100 m had no end, of 5 m it took 5 s."""
    edges: list[tiles.Edge] = [Line(a, a + 300 - 200j) for a in (0j, 900 + 400j)]
    # within the overlap of two columns, and of two rows
    beside = [-50 - 210j + 140 * 3 + tiles.OVERLAP / 4, -50 - 210j + 150j * 3 - 1j * tiles.OVERLAP / 4]
    edges += [Line(beside[0] + 10j, beside[0] + 50j), Line(beside[1] + 10, beside[1] + 50)]
    edges += [Arc(600 + 500j, 450.0, start, sweep) for start, sweep in ((0.1, 1.4), (2.0, 4.0), (0.3, -2.9))]
    size = {"columns": 9, "rows": 7, "upright": True, "wide": 140.0, "tall": 150.0}
    corner, grown = -50 - 210j, tiles.OVERLAP / 2
    cells = tiles._cells(edges, corner, tiles._Layout(**size))
    for row, column in product(range(7), range(9)):
        low = corner + complex(140.0 * column, 150.0 * row)
        held = cells.get((row, column), [])
        for edge in edges:
            # places as dense as a tenth of a millimetre
            place = edge.point(np.linspace(*edge.domain, 20_001)) - low
            inside = (
                (-grown < place.real) & (place.real < 140 + grown) & (-grown < place.imag) & (place.imag < 150 + grown)
            )
            assert edge in held or not inside.any()
    # of short edges, as outlines have them, hardly any but the tile's own
    short = [Arc(600 + 500j, 450.0, 0.01 * k, 0.01) for k in range(628)]
    cells = tiles._cells(short, corner, tiles._Layout(**size))
    assert sum(map(len, cells.values())) < 2 * len(short)
