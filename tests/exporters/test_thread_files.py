"""Threads on shafts, from files: solids keep their cylinders, drawings have the lines of GOST 2.311, refusals cures."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest

from geometry.curves.line_arc import Arc, Line
from parts.drawing.working import THIN, VISIBLE, PartDrawing
from tests.exporters.making import run, write_scene
from tests.parts.drawing.test_sections import drawing_of
from tests.parts.limits import refused, scene_of

STEPS: list[dict[str, Any]] = [
    {"diameter": 12.0, "length": 14.0, "chamfer": 1.6, "thread": "M12x1.25"},
    {"diameter": 12.0, "length": 16.0},
    {"diameter": 25.0, "length": 12.0},
    {"diameter": 20.0, "length": 30.0, "thread": "M20x1.5-6g-LH",
     "grooves": [{"at": 3.0, "width": 2.0, "diameter": 17.0}],
     "keyways": [{"at": 8.0, "length": 14.0, "width": 5.0, "depth": 3.0}]},
    {"diameter": 25.0, "length": 10.0},
]  # fmt: skip
# minor diameters of ISO 724
FINE, LEFT = 10.647, 18.376


def shaft(**more: Any) -> dict[str, Any]:
    return {"kind": "shaft", "steps": STEPS, **more}


def thin(drawing: PartDrawing) -> set[tuple[float, float, float]]:
    """Where thin lines along the axis of the long view begin and end, and how far from it."""
    lines = [c for name, c in drawing.views[0].strokes if name == THIN and isinstance(c, Line)]
    return {(*sorted((round(c.start.real, 3), round(c.end.real, 3))), round(2 * c.start.imag, 3)) for c in lines}


def test_thin_lines_stand_at_the_minor_diameter_up_to_chamfers_and_grooves() -> None:
    drawing = drawing_of(shaft())
    # from where the chamfer has the minor diameter, 12 - 1.0825 x 1.25
    begin = 0.923
    expected = {(begin, 14.0, FINE), (42.0, 45.0, LEFT), (47.0, 72.0, LEFT)}
    assert thin(drawing) == expected | {(low, high, -d) for low, high, d in expected}


def test_a_thread_ends_with_a_thick_line_where_the_cylinder_goes_on() -> None:
    ends = {}
    for bore in (0.0, 6.0):
        (view, *_) = drawing_of(shaft(bore_diameter=bore)).views
        found = [c for name, c in view.strokes if name == VISIBLE and isinstance(c, Line)
                 and abs(c.start.real - 14) + abs(c.end.real - 14) < 1e-9]  # fmt: skip
        ends[bore] = sorted(sorted((round(2 * c.start.imag, 3), round(2 * c.end.imag, 3))) for c in found)
    # cut, from the thin line alone
    assert ends == {0.0: [[-12.0, 0.0], [0.0, 12.0]], 6.0: [[-12.0, -FINE], [FINE, 12.0]]}


@pytest.mark.parametrize(("language", "pitch"), [("en", "1.5"), ("uk", "1,5")])
def test_designations_stand_at_the_diameters(language: str, pitch: str, tmp_path: Path) -> None:
    export = {"format": "svg", "purpose": "part", "drawing": {"shaft": "k6"}}
    head = f'[scene]\nlanguage = "{language}"\n'
    file = write_scene(tmp_path / "t.toml", {"s": shaft()}, [export], head)
    assert run("build", file, "--out", tmp_path / "out") == 0
    (file,) = (tmp_path / "out").rglob("*.part.svg")
    text = file.read_text("utf-8")
    assert f"M20\u00d7{pitch}-6g-LH" in text
    # the same cylinder without a thread is told beside it, with the tolerance of seats
    assert "\u00d812k6" in text
    assert "\u00d820" not in text


def test_sizes_of_a_thread_are_its_nominal_diameter_and_its_end() -> None:
    (view, *_) = drawing_of(shaft()).views
    told = {(s.before, round(s.value, 9), s.after) for s in view.sizes}
    assert {("M", 12.0, "\u00d71.25-6g"), ("M", 20.0, "\u00d71.5-6g-LH"), ("\u00d8", 17.0, ""), ("", 14.0, "")} <= told
    assert ("\u00d8", 20.0, "") not in told


def test_designations_stand_where_a_table_tells_the_corners() -> None:
    steps = [{"diameter": 10.0 + k, "length": 5.0} for k in range(24)]
    steps[2] = {"diameter": 12.0, "length": 5.0, "thread": "M12"}
    (view, *_) = drawing_of({"kind": "shaft", "steps": steps}).views
    assert [(s.before, s.value, s.after) for s in view.sizes if s.before] == [("M", 12.0, "-6g")]


def test_a_section_has_three_quarters_of_a_thin_circle_off_the_keyway() -> None:
    section = drawing_of(shaft()).views[-1]
    (arc,) = [c for name, c in section.strokes if name == THIN]
    assert isinstance(arc, Arc)
    assert 2 * arc.radius == pytest.approx(LEFT, abs=0.00051)
    assert math.degrees(arc.sweep) == pytest.approx(270.0)
    # the keyway looks to the right
    assert complex(arc.point(arc.sweep / 2)).real == pytest.approx(-arc.radius)


def test_solids_of_threaded_and_of_plain_steps_are_the_same_and_the_report_tells_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bytes_of = []
    for name, steps in (("threaded", STEPS), ("plain", [{k: v for k, v in s.items() if k != "thread"} for s in STEPS])):
        folder = tmp_path / name
        folder.mkdir()
        exports = [{"format": "step"}, {"format": "stl"}]
        file = write_scene(folder / "t.toml", {"s": {"kind": "shaft", "steps": steps}}, exports)
        assert run("build", file, "--out", folder / "out") == 0
        assert ("thread M20x1.5" in "".join(capsys.readouterr())) == (name == "threaded")
        files = sorted((folder / "out").rglob("s.st*"))
        assert [file.suffix for file in files] == [".step", ".stl"]
        bytes_of.append([file.read_bytes() for file in files])
    assert bytes_of[0] == bytes_of[1]


@pytest.mark.parametrize(
    ("changes", "key", "code", "near"),
    [
        ({"diameter": 8.2}, "steps[1].diameter", "not_of_thread", 8.0),
        ({"thread": "M8x1.1"}, "steps[1].thread", "no_such_thread_pitch", "M8x1"),
        ({"thread": "M8.5"}, "steps[1].thread", "no_thread_of_diameter", "M8"),
        (
            {"spline": {"shape": "spline", "size": "6x23x26"}, "diameter": 26.0},
            "steps[1].thread",
            "beside_spline",
            None,
        ),
    ],
)
def test_refusals_name_what_works(changes: dict[str, Any], key: str, code: str, near: object) -> None:
    step = {"diameter": 8.0, "length": 20.0, "thread": "M8"} | changes
    if "spline" in changes:
        step["thread"] = "M26x1.5"
    refusal = refused(scene_of({"kind": "shaft", "steps": [step]}))
    assert refusal is not None
    assert (refusal.key, refusal.code) == (f"parts.p.{key}", code)
    assert refusal.nearest is not None
    assert refusal.nearest.value == near


def test_a_hole_within_the_root_of_a_thread_is_refused() -> None:
    keys = {"kind": "shaft", "steps": [{"diameter": 8.0, "length": 20.0, "thread": "M8"}]}
    assert drawing_of(keys | {"bore_diameter": 6.4})
    refusal = refused(scene_of(keys | {"bore_diameter": 6.5}))
    assert refusal is not None
    assert (refusal.code, refusal.key) == ("leaves_no_wall", "parts.p.bore_diameter")


@pytest.mark.parametrize(
    ("language", "word", "number"),
    [("en", "pitch diameter of the thread", "7.188"), ("uk", "середній діаметр", "7,188")],
)
def test_the_page_is_told_in_both_languages(
    language: str, word: str, number: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("calc", "thread", "thread=M8", "--language", language) == 0
    out = capsys.readouterr().out
    assert word in out
    assert number in out
    assert run("calc", "thread", "thread=M8x2", "--language", language) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "M8" in error
