"""A small sheet in each of its formats, against expectations that differ in one thing, little or much."""

from __future__ import annotations

import copy
import math
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from exporters.drawings.sheets import sheet_rounding, write_sheets
from exporters.drawings.verify import verify_sheets
from geometry.approximation.splines import fit_spline
from geometry.base.record import replace
from geometry.curves.bspline import BSpline
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc, Line
from parts.drawing.canvas import Canvas, Paper, Stroke, draw
from parts.drawing.expected import Circle, Expected, Meshing
from tests.sampling import some_of

TOLERANCE = 1e-3
PAPER = Paper(2.0, 60 + 70j)
SPIRAL = Involute(5.0, 1.5, 0.3, 1.2)
FORMS = [".dxf", ".svg", ".pdf"]


def part(radius: float) -> tuple[Arc, Line]:
    return Arc(3 + 2j, radius, 0.3, 1.9), Line(1 + 1j, 12 - 3j)


def meshing(canvas: Canvas) -> Meshing:
    """A line of action at 20 degrees between base circles of 10 and 15 ; its part, arc, pitch."""
    turn = np.exp(1j * math.radians(20.0))
    centres = 100 + 120j, 100 + 120j - 25j / math.cos(math.radians(20.0))
    feet = complex(centres[0] - 10j * turn), complex(centres[1] + 15j * turn)
    way = (feet[1] - feet[0]) / abs(feet[1] - feet[0])
    pitch = 2 * math.pi * 10 / 12
    ends = feet[0] + 0.1 * way, feet[0] + (0.1 + 1.2 * pitch) * way
    canvas.line("LINE_OF_ACTION", *feet)
    canvas.line("ACTIVE_LINE", *ends)
    canvas.add("ARC_OF_ACTION", Arc(centres[0], 10.6, 4.0, 1.2 * 0.5))
    canvas.add("WORKING_PITCH", Arc(centres[0], 10.6, 1.0, 0.5))
    return Meshing(((centres[0], 10.0), (centres[1], 15.0)), 12, 1.2 * pitch, 10.6 * 0.6, 10.6 * 0.5, 1.2)


@cache
def expected() -> Expected:
    canvas = Canvas(210.0, 297.0, "A4")
    for curve in part(4.0):
        draw(canvas, "OUTLINE", [curve], PAPER)
    draw(canvas, "ACTIVE_FLANK", [fit_spline(SPIRAL, 1e-4, degree=3, continuity=2).spline], PAPER)
    canvas.add("CIRCLE_BASE", Arc(60 + 70j, 10.0, 0.4, 2 * math.pi))
    canvas.line("CENTRE", 40 + 70j, 80 + 70j)
    canvas.line("TANGENT", 30 + 200j, 150 + 200j)
    canvas.write("Wheel", 50 + 250j)
    canvas.write("z = 12", 50 + 230j, 3.5)
    canvas.write_rising("12,5", 120 + 60j, 3.5, 30.0)
    told = meshing(canvas)
    circles = (Circle("CIRCLE_BASE", 60 + 70j, 10.0), Circle("TANGENT", None, 200.0))
    curves = {"OUTLINE": list(part(4.0)), "ACTIVE_FLANK": [SPIRAL]}
    return Expected(canvas, PAPER, circles, curves, told)


@pytest.fixture(scope="module", params=FORMS)
def file(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("sheet") / f"s{request.param}"
    write_sheets(path, [expected().canvas], "Sheet")
    return path


def stroked(number: int, change: Callable[[Stroke], Stroke]) -> Callable[[Expected], Expected]:
    """One of the strokes another one."""

    def changed(one: Expected) -> Expected:
        canvas = copy.copy(one.canvas)
        canvas = replace(canvas, strokes=[*canvas.strokes])
        canvas.strokes[number] = change(canvas.strokes[number])
        return replace(one, canvas=canvas)

    return changed


def moved(by: complex) -> Callable[[Stroke], Stroke]:
    def change(stroke: Stroke) -> Stroke:
        curve = stroke.curve
        if isinstance(curve, Line):
            return replace(stroke, curve=Line(curve.start + by, curve.end + by))
        return replace(stroke, curve=replace(curve, centre=curve.centre + by))

    return change


def worded(number: int, **changes: object) -> Callable[[Expected], Expected]:
    """A run of one of the words another one."""

    def changed(one: Expected) -> Expected:
        texts = [*one.canvas.texts]
        runs = [*texts[number].runs]
        by = {key: runs[0].at + value if key == "at" else value for key, value in changes.items()}
        runs[0] = replace(runs[0], **by)
        texts[number] = replace(texts[number], runs=tuple(runs))
        return replace(one, canvas=replace(one.canvas, texts=texts))

    return changed


def meshed(**changes: object) -> Callable[[Expected], Expected]:
    def changed(one: Expected) -> Expected:
        assert one.meshing is not None
        return replace(one, meshing=replace(one.meshing, **changes))

    return changed


def more(one: Expected) -> Expected:
    return replace(
        one, canvas=replace(one.canvas, strokes=[*one.canvas.strokes, Stroke("CENTRE", Line(40j + 40, 90 + 40j))])
    )


def fewer(one: Expected) -> Expected:
    return replace(one, canvas=replace(one.canvas, strokes=[s for s in one.canvas.strokes if s.layer != "CENTRE"]))


FAR = 0.02
CHANGES: dict[str, tuple[Callable[[Expected], Expected], str]] = {
    "paper": (lambda one: replace(one, canvas=replace(one.canvas, width=211.0)), "has paper of 210"),
    "arc": (stroked(0, moved(FAR)), "OUTLINE: no line from"),
    "line": (stroked(1, moved(FAR * 1j)), "OUTLINE: a line too many from"),
    "circle": (stroked(3, moved(FAR)), "CIRCLE_BASE: no line from"),
    "radius": (stroked(3, lambda s: replace(s, curve=replace(s.curve, radius=10.0 + FAR))), "CIRCLE_BASE: a line too"),
    "base circle": (lambda one: replace(one, circles=(Circle("CIRCLE_BASE", 60 + 70j, 10.0 + FAR), one.circles[1])),
                    "CIRCLE_BASE: no circle of 10.02"),
    "centre": (lambda one: replace(one, circles=(Circle("CIRCLE_BASE", 60 + FAR + 70j, 10.0), one.circles[1])),
               "CIRCLE_BASE: no circle of 10.0"),
    "straight": (lambda one: replace(one, circles=(one.circles[0], Circle("TANGENT", None, 200.0 - FAR))),
                 "TANGENT: no circle of 199.98"),
    "no circle": (lambda one: replace(one, circles=(Circle("FRAME", 60 + 70j, 10.0),)), "FRAME: no circle of"),
    "curve": (lambda one: replace(one, curves={**one.curves, "OUTLINE": list(part(4.0 + FAR))}), "outlines deviate by"),
    "flank": (lambda one: replace(one, curves={"ACTIVE_FLANK": [Involute(5.0, 1.502, 0.3, 1.2)]}), "outlines"),
    "longer flank": (lambda one: replace(one, curves={"ACTIVE_FLANK": [Involute(5.0, 1.5, 0.3, 1.21)]}), "outlines"),
    "line more": (more, "CENTRE: no line from 40.000, 40.000 to 90.000, 40.000 mm"),
    "word": (worded(0, at=FAR), "Wheel does not stand at"),
    "another word": (worded(0, text="Wheels"), "words are missing: Wheels"),
    "higher": (worded(1, height=5.0), "z = 12 stands at"),
    "wider": (worded(1, width=20.0), "z = 12 does not stand"),
    "turned": (worded(2, way=1.0), "12,5 does not stand"),
    "base": (meshed(tangents=((100 + 120j, 10.0 + FAR), (100 + 120j, 40.0))), "misses the base circle of 10.0"),
    "active line": (meshed(active_length=6.3), "the active line of action measures 6.28318"),
    "arc of action": (meshed(arc_length=6.38), "the arc of action measures 6.3"),
    "pitch": (meshed(pitch_length=5.32), "the working pitch measures 5."),
    "ratio": (meshed(contact_ratio=1.21), "contact_ratio_by_line measures 1."),
    "teeth": (meshed(teeth=13), "contact_ratio_by_line measures 1.3"),
}  # fmt: skip


@pytest.mark.parametrize("file", [form for form in FORMS if form == ".pdf"], indirect=True)
def test_a_state_that_may_hide_lines_is_told(file: Path, tmp_path: Path) -> None:
    good, spoilt = file.read_bytes(), tmp_path / "s.pdf"
    spoilt.write_bytes(good.replace(b"/Type /ExtGState", b"/Type /ExtGState /CA 0"))
    assert spoilt.read_bytes() != good
    assert any("with CA" in failure for failure in verify_sheets(spoilt, [expected()], TOLERANCE).failures)


def test_a_sheet_is_what_it_was_made_of(file: Path) -> None:
    found = verify_sheets(file, [expected()], TOLERANCE)
    assert found.failures == ()
    whole = expected()
    higher = replace(whole, canvas=replace(whole.canvas, height=whole.canvas.height + 1))
    assert any("has paper of 210" in failure for failure in verify_sheets(file, [higher], TOLERANCE).failures)
    assert found.measured["words"] == 3
    assert found.measured["circles"] == 2
    assert found.measured["circle_deviation"] < sheet_rounding(file)
    assert found.measured["max_deviation"] < 2e-4 + sheet_rounding(file)
    for name in ("contact_ratio_by_line", "contact_ratio_by_arc"):
        assert found.measured[name] == pytest.approx(1.2, abs=1e-3)


def test_a_sheet_is_no_other_one(file: Path) -> None:
    for name, (change, said) in some_of(CHANGES.items(), 6):
        failures = verify_sheets(file, [change(expected())], TOLERANCE).failures
        assert any(said in failure for failure in failures), (name, failures)


def test_what_has_the_ends_and_the_middle_of_a_line_or_an_arc_is_neither_yet(file: Path, tmp_path: Path) -> None:
    """An S about a line, and one about a quarter of a circle, each some 2 mm off."""
    thirds, middle = np.arange(4) / 3, 90 + 90j
    bent = 30 * np.exp(1j * math.pi / 4 * thirds) * [1, 1.1, 1.1, 1]
    cases = {
        Line(20 + 20j, 50 + 20j): 20 + 20j + 30 * thirds + np.array([0, 9j, -9j, 0]),
        Arc(middle, 30.0, 0.0, math.pi / 2): middle + np.concatenate([bent, 1j**0.5 * bent[1:]]),
    }
    for exact, poles in cases.items():
        spans = len(poles) // 3
        knots = np.repeat(np.arange(spans + 1.0), [4, *[3] * (spans - 1), 4])
        canvas = Canvas(210.0, 297.0, "A4")
        draw(canvas, "OUTLINE", [BSpline(3, knots, poles)], Paper(1.0, 0j))
        other = tmp_path / f"o{file.suffix}"
        write_sheets(other, [canvas], "Sheet")
        wanted = Expected(replace(canvas, strokes=[Stroke("OUTLINE", exact)]), PAPER, ())
        assert any("OUTLINE: no line" in told for told in verify_sheets(other, [wanted], TOLERANCE).failures)


def test_what_is_within_the_tolerance_is_good(file: Path) -> None:
    """The same changes by half of what is allowed, and by twice of it."""
    allowed = TOLERANCE + sheet_rounding(file)
    for share, good in ((0.5, True), (2.5, False)):
        by = share * allowed
        changes = (stroked(0, moved(by)), stroked(3, moved(by)), stroked(4, moved(1j * by)),
                   lambda one, by=by: replace(one, circles=(Circle("CIRCLE_BASE", 60 + 70j, 10.0 + by),)),
                   lambda one, by=by: replace(one, curves={"OUTLINE": list(part(4.0 + by / 2))}))  # fmt: skip
        for number, change in enumerate(changes):
            assert (verify_sheets(file, [change(expected())], TOLERANCE).failures == ()) is good, (share, number)


def test_what_stands_over_each_other_or_leaves_the_frame_is_told(file: Path, tmp_path: Path) -> None:
    canvas = Canvas(210.0, 297.0, "A4")
    canvas.line("CENTRE", 40 + 70j, 80 + 70j)
    canvas.line("CENTRE", 40 + 72j, 208 + 72j)
    canvas.write("Wheel", 50 + 250j)
    canvas.write("12345", 55 + 251j)
    canvas.write("far away", 200 + 30j)
    other = tmp_path / f"o{file.suffix}"
    write_sheets(other, [canvas], "Sheet")
    failures = verify_sheets(other, [Expected(canvas, PAPER, ())], TOLERANCE).failures
    assert sorted(failures) == [
        "12345 stands over Wheel",
        "CENTRE: a curve leaves the frame",
        "far away leaves the frame",
    ]


def test_no_rounding_misses_a_base_circle_far_beyond_the_line_of_action(tmp_path: Path) -> None:
    """Of gears of 1001 and 2000 teeth a PDF's line was said to miss circles ten of its lengths away by 0.0005 mm."""

    def missed(path: Path, one: Expected) -> int:
        return sum("misses the base circle" in failure for failure in verify_sheets(path, [one], 1e-6).failures)

    middle, layers = 100 + 150j, ("LINE_OF_ACTION", "ACTIVE_LINE")
    for number, degrees in enumerate(np.linspace(1.0, 41.0, 9)):
        way, whole = complex(np.exp(1j * math.radians(degrees))), expected()
        canvas = replace(whole.canvas, strokes=[s for s in whole.canvas.strokes if s.layer not in layers])
        canvas.line("LINE_OF_ACTION", middle - 20 * way, middle + 20 * way)
        canvas.line("ACTIVE_LINE", middle, middle + 2 * math.pi * way)
        write_sheets(tmp_path / f"{number}.pdf", [canvas], "Sheet")
        for more, wanted in ((0.0, 0), (0.05, 2)):
            tangents = tuple((middle + along * way * (1 + 5j), 4000.0 + more) for along in (-800.0, 800.0))
            assert whole.meshing is not None
            one = replace(whole, canvas=canvas, meshing=replace(whole.meshing, tangents=tangents))
            assert missed(tmp_path / f"{number}.pdf", one) == wanted


def test_a_mesh_without_its_lines_is_told(file: Path, tmp_path: Path) -> None:
    one = expected()
    for layer in ("LINE_OF_ACTION", "ACTIVE_LINE", "ARC_OF_ACTION", "WORKING_PITCH"):
        canvas = replace(one.canvas, strokes=[s for s in one.canvas.strokes if s.layer != layer])
        other = tmp_path / f"{layer}{file.suffix}"
        write_sheets(other, [canvas], "Sheet")
        failures = verify_sheets(other, [replace(one, canvas=canvas)], TOLERANCE).failures
        assert failures == ("the line of action, its active part, the arc of action or the pitch is missing",)


@pytest.mark.parametrize("turn", ["rotate(45 120 60)", "rotate(-90)", "scale(2)"])
def test_words_that_are_turned_in_no_known_way_are_refused(turn: str, tmp_path: Path) -> None:
    """Upright, rising or upside down about their own place: a reader of files knows no other."""
    file = tmp_path / "s.svg"
    write_sheets(file, [expected().canvas], "Sheet")
    text = file.read_text(encoding="utf-8")
    (rising,) = re.findall(r'transform="(rotate\(-90 [^"]*)"', text)
    file.write_text(text.replace(rising, turn), encoding="utf-8")
    (found,) = verify_sheets(file, [expected()], TOLERANCE).failures
    assert f"words that are turned by {turn}" in found
