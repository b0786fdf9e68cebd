"""The title block of a sheet: form 1 of GOST 2.104, its lines and words, and nothing of the picture under it."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest

from exporters.production.plan import plan_build
from parts.base.refusal import SceneError
from parts.drawing.canvas import Box, Canvas, scale_text, text_width
from parts.drawing.cells import wrapped
from parts.drawing.title_block import TITLE_BLOCK, TitleBlock, draw_title_block
from parts.scene.files import built_in_scenes
from parts.scene.load import scene_from_dict
from tests.sampling import some_of

# widths of the eleven columns and the right-hand ones, as the form has them
COLUMNS = [7, 10, 23, 15, 10, 70, 5, 5, 5, 5, 12, 18]
# where the picture is not measured, few positions and rough curves
ROUGH = {"intervals": 2, "tolerance": 1e-3}
WORDS = {"designation": "TMM.03.001", "drawn": "Ann", "approved": "Bob", "date": "21.11.26", "organisation": "Group 21"}


def scene_of(title_block: Any, language: str = "en", **export: Any) -> Any:
    """A pair of gears whose sheet has a title block."""
    gear = {"kind": "spur_gear", "module": 10.0, "number_of_teeth": 13, "profile_shift_coefficient": 0.3}
    raw = {
        "scene": {"title": "External pair", "language": language},
        "parts": {"one": gear, "two": {**gear, "number_of_teeth": 21}},
        "mates": [{"kind": "external_gear_pair", "first": "one", "second": "two"}],
        "exports": [{"format": "sheet", "title_block": title_block, **export}],
    }
    return scene_from_dict(raw, "t", "t")


def sheets(title_block: Any, language: str = "en", **export: Any) -> Any:
    return plan_build(scene_of(title_block, language, **export), "t", [], []).sheets


def test_form_1_has_its_eleven_columns_and_rows_of_5_mm() -> None:
    canvas = Canvas(420.0, 297.0, "A3")
    box = draw_title_block(canvas, TitleBlock("name"), "en")
    assert (box.right - box.left, box.high - box.low) == TITLE_BLOCK == (185.0, 55.0)
    assert (box.right, box.low) == (canvas.frame.right, canvas.frame.low)
    lines = [(s.layer, s.curve.start - complex(box.left, box.low), s.curve.end - complex(box.left, box.low))
             for s in canvas.strokes
             if min(s.curve.start.real, s.curve.end.real) > canvas.frame.left + 1]  # fmt: skip
    upright = sorted({round(a.real) for _, a, b in lines if a.real == b.real})
    assert list(np.diff(upright)) == COLUMNS
    level = sorted({round(a.imag) for _, a, b in lines if a.imag == b.imag})
    assert level == list(range(0, 60, 5))
    assert {layer for layer, *_ in lines} == {"FRAME", "TABLE"}


def test_the_columns_of_the_margin_are_those_of_the_form() -> None:
    """Graphs 19 to 25: 5 and 7 mm wide, 25, 35, 25, 25, 35 from below, 60 and 60 from the top, read from the right."""
    canvas = Canvas(210.0, 297.0, "A4")
    draw_title_block(canvas, TitleBlock("name"), "en")
    left = [s.curve for s in canvas.strokes if s.curve.start.real < canvas.frame.left]
    assert sorted({round(c.start.real, 9) for c in left}) == [8.0, 13.0]
    level = sorted({c.start.imag for c in left if c.start.imag == c.end.imag})
    assert list(np.diff(level)) == [25, 35, 25, 25, 35, 22, 60, 60]
    turned = [t for t in canvas.texts if t.runs[0].way == 1j]
    assert [t.text for t in turned][:2] == ["Orig. no.", "Sign., date"]
    assert len(turned) == 7
    assert all(t.box.left >= 8 and t.box.right <= 13.5 and t.runs[0].at.real < 13 for t in turned)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("language", ["en", "uk"])
@pytest.mark.parametrize("export", [{}, {"purpose": "generating", "parts": ["one"]}], ids=["meshing", "generating"])
@pytest.mark.parametrize("asked", [True, WORDS], ids=["plain", "table"])
def test_the_block_stands_in_its_corner_and_nothing_else_does(
    asked: Any, export: dict[str, Any], language: str, tmp_path: Path
) -> None:
    for job in sheets(asked, language, **export):
        job.write({}, tmp_path / job.path)
        assert job.verify(tmp_path / job.path, 0.0).failures == ()
        frame = job.canvas.frame
        left, top = frame.right - TITLE_BLOCK[0], frame.low + TITLE_BLOCK[1]
        inside = [s.layer for s in job.canvas.strokes
                  if any(left + 1e-6 < p.real < frame.right - 1e-6 and frame.low + 1e-6 < p.imag < top - 1e-6
                         for p in np.atleast_1d(s.curve.point(np.linspace(*s.curve.domain, 40))))]  # fmt: skip
        assert set(inside) == {"FRAME", "TABLE"}
        words = [t.text for t in job.canvas.texts]
        assert ("Масштаб" if language == "uk" else "Scale") in words
        assert (("Аркушів 1" if language == "uk" else "Sheets 1") in words) is True
        if asked is not True:
            assert words.count("21.11.26") == 2
            assert {"TMM.03.001", "Ann", "Bob", "Group 21"} <= set(words)


def test_the_block_is_in_the_drawing_file(tmp_path: Path) -> None:
    job = next(j for j in sheets(WORDS) if j.path.endswith("dxf"))
    job.write({}, tmp_path / job.path)
    texts = {e.dxf.text for e in ezdxf.readfile(tmp_path / job.path).modelspace().query("TEXT")}
    assert {"TMM.03.001", "External pair", "Drawn", "Approved", "Mass"} <= texts


def test_long_words_stay_in_their_cells() -> None:
    canvas = Canvas(420.0, 297.0, "A3")
    long = "a name that is much longer than any cell of the form has room for, told at length " * 2
    draw_title_block(
        canvas, TitleBlock(long, long, long, long, long, long, "abc", long, 1, 1, (("drawn", long),)), "en"
    )
    for text in (t for t in canvas.texts if t.runs[0].way == 1):
        assert text.box.left >= canvas.frame.right - TITLE_BLOCK[0]
        assert text.box.right <= canvas.frame.right
    # graphs 31 and 32 stand below the frame
    names = [t for t in canvas.texts if t.box.left > canvas.frame.right - 121 and t.box.right < canvas.frame.right - 49
             and t.text != "Copied"]  # fmt: skip
    assert all(canvas.frame.low <= t.runs[0].at.imag <= canvas.frame.low + 55 for t in names)


def test_a_number_stays_at_its_symbol() -> None:
    """Lines end neither at no-break spaces nor where plain ones stand before a number, while both fit a line."""
    for space in "\u00a0 ":
        text = f"Wheel of the second stage z{space}136 m{space}2.25 x{space}0.125"
        for width in range(18, 120, 3):
            rows = wrapped(text, width, 5.0)
            assert " ".join(rows) == text
            pairs = [f"z{space}136", f"m{space}2.25", f"x{space}0.125"]
            assert all(any(pair in row for row in rows) or text_width(pair, 5.0) > width for pair in pairs)
    # a standard keeps its number
    assert wrapped("8-B ГОСТ 1643-81", 33.4, 3.5) == ["8-B", "ГОСТ 1643-81"]
    # one that fits no line is no reason to tear its numbers
    assert wrapped("1 2 3 4 5 6 7 8 9", 12.0, 5.0) == ["1 2", "3 4", "5 6", "7 8", "9"]


@pytest.mark.heavy
def test_cam_sheets_leave_room_for_it() -> None:
    """The lower right corner of a cam sheet is free: nothing else is written where the title block stands."""
    raw = tomllib.loads(built_in_scenes()["practicum_roller_cam"].read_text())
    rough = {"format": "sheet", "purpose": "cam", **ROUGH}
    plain, titled = [
        plan_build(scene_from_dict({**raw, "exports": [{**rough, **more}]}, "t", "t"), "t", [], []).sheets[0]
        .expected.canvas
        for more in ({}, {"title_block": True})
    ]  # fmt: skip
    left, top = titled.frame.right - TITLE_BLOCK[0], titled.frame.low + TITLE_BLOCK[1]
    assert len(titled.texts) > len(plain.texts)
    assert not [t for t in plain.texts if t.box.right > left and t.box.low < top]


def test_the_block_of_a_page_without_a_view_has_no_scale() -> None:
    cam = {"kind": "cam", "follower": "roller", "lift": 20.0, "follower_radius": 6.0, "base_circle_radius": 40.0,
           "phases": [{"move": m, "angle_deg": 180.0, "law": "cosine"} for m in ("rise", "return_")]}  # fmt: skip
    export = {"format": "sheet", "purpose": "cam", "paper": "A4", "title_block": True, **ROUGH}
    made = plan_build(scene_from_dict({"parts": {"disk": cam}, "exports": [export]}, "t", "t"), "t", [], []).sheets
    blocks = []
    # each as DXF and as SVG
    for job in made[::2]:
        frame = job.canvas.frame
        block = Box(frame.right - TITLE_BLOCK[0], frame.low, frame.right, frame.low + TITLE_BLOCK[1])
        blocks.append([t.text for t in job.canvas.texts if t.box.within(block) and ":" in t.text])
    # diagrams, constructions, tables
    assert blocks[:2] == [[], [scale_text(made[2].expected.paper.scale, "en")]]
    assert len(blocks) > 2
    assert not any(blocks[2:])


def test_the_block_of_one_part_tells_its_material_and_mass() -> None:
    """A plain disk by hand: pi r^2 h rho, in kg; what the scene says itself goes before it."""
    cam = {"kind": "cam", "follower": "roller", "lift": 0.001, "follower_radius": 6.0, "base_circle_radius": 40.0,
           "face_width": 10.0, "material": "steel 45", "density": 8.0,
           "phases": [{"move": m, "angle_deg": 180.0, "law": "cosine"} for m in ("rise", "return_")]}  # fmt: skip
    for given, wanted in some_of(((True, f"{np.pi * 40**2 * 10 * 8 / 1e6:.3g}"), ({"mass": "1 kg"}, "1 kg"))):
        raw = {
            "parts": {"disk": cam},
            "exports": [{"format": "sheet", "purpose": "cam", "title_block": given, **ROUGH}],
        }
        words = [t.text for t in plan_build(scene_from_dict(raw, "t", "t"), "t", [], []).sheets[0].canvas.texts]
        assert {"Steel 45", wanted} <= set(words)


@pytest.mark.parametrize(
    ("export", "key"),
    [
        ({"format": "dxf", "title_block": True}, "title_block = true"),
        ({"format": "sheet", "title_block": {"designaton": "x"}}, "did you mean designation"),
        ({"format": "sheet", "title_block": "yes"}, "true, false or a table"),
        ({"format": "sheet", "title_block": {"letter": "long"}}, "title_block.letter"),
    ],
)
def test_refusals_name_the_key(export: dict[str, Any], key: str) -> None:
    scene = scene_of(True)
    raw = {"parts": {k: {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20} for k in scene.parts},
           "exports": [export]}  # fmt: skip
    with pytest.raises(SceneError) as caught:
        scene_from_dict(raw, "t", "t")
    assert key in str(caught.value)


def test_without_the_key_a_sheet_has_none() -> None:
    for job in sheets(False):
        assert "Scale" not in [t.text for t in job.canvas.texts]
        assert job.canvas.band == 0


@pytest.mark.parametrize("language", ["en", "uk"])
def test_words_of_blocks_and_legends_fit_their_cells_hardly_squeezed(language: str) -> None:
    """Viewers that do not narrow letters show what overruns its cell."""
    from parts.base.texts import words
    from parts.drawing.canvas import HEIGHTS, plain_width, text_of
    from parts.drawing.title_block import LABELS
    from parts.texts.sheets import sheet_words

    cells = [(words(language).say(text), 15.4) for key, text in LABELS.items() if key != "document"]
    legends = ("cam", "pitch_curve", "graphical", "return_tangent", "scale_velocity", "scale_1", "scale_2", "pole_2")
    cells += [(sheet_words(language, key), 59.0) for key in legends]
    for text, room in cells:
        made = text_of(text, 0j, 2.5, room)
        assert made.box.right <= room + 1e-9
        for run in made.runs:
            assert run.height in HEIGHTS
            assert 0.9 - 1e-9 <= run.width / plain_width(run.text, run.height) <= 1 + 1e-9, text
