"""``higherpair calc shift-choice`` of internal pairs: formulas, languages, pictures read back, refusals that mend."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
import shapely

from exporters.documents import topics
from exporters.documents.contour_dxf import SCALE, write_contour_dxf
from exporters.documents.render import SPOKEN, render
from exporters.documents.topics import calculate, sheet_of
from geometry.base.errors import Nearest
from geometry.base.record import replace
from geometry.curves.implicit import Box
from geometry.gears.pairs.internal import internal_pair
from geometry.gears.shifts.finder import for_sum
from geometry.gears.shifts.internal import InternalRequirements, Window, conditions, internal_contour, window
from geometry.gears.shifts.internal_shifts import InternalShiftPair
from geometry.gears.teeth.basic_rack import iso_53
from geometry.gears.teeth.cutter import PinionCutter
from geometry.gears.teeth.ring import RoundedRoot
from parts.base.refusal import SceneError
from parts.base.texts import MINUS, words
from parts.gears.ring_gear.part import RingGearSpec, checked_ring_gear
from parts.gears.spur_gear.part import SpurGearSpec, checked_spur_gear, gear_of
from parts.mates.pages import internal_shift_choice, shift_choice
from parts.mates.pages.contour_marks import checked_picture
from parts.mates.pages.internal_shift_choice import InternalShiftKeys, shift_pair
from parts.pages.contour_picture import (
    ContourPicture,
    clipped,
    contour_svg,
    grid_step,
    kinds_shown,
    line_name,
    line_title,
    tool_texts,
)
from parts.pages.inputs import checked, table_of
from parts.pages.page import Sheet
from parts.scene.load import load_scene, make_parts
from tests.exporters.command.test_cli import complaint
from tests.exporters.documents.test_calc import evaluated, refused, sheet_for, values_of
from tests.exporters.making import run

GIVEN = "kind=internal_gear_pair module=2 first.number_of_teeth=20 second.number_of_teeth=60"
WORDS = f"shift-choice {GIVEN} working_centre_distance=40.5 second.cutter.number_of_teeth=25"
SCENE = """
[parts.ring]
kind = "ring_gear"
module = 2.0
number_of_teeth = 60
profile_shift_coefficient = 0.3
tip_rule = "KHK"
cutter.number_of_teeth = 20
[parts.pinion]
kind = "spur_gear"
module = 2.0
number_of_teeth = 24
profile_shift_coefficient = 0.1
[[mates]]
kind = "internal_gear_pair"
first = "ring"
second = "pinion"
"""


@pytest.fixture(autouse=True, scope="module")
def _coarse_pictures() -> Iterator[None]:
    """Chords and grids of contours as coarse as lines need to be there at all: finer ones take half of a page."""

    def coarse(pair: InternalShiftPair) -> Window | None:
        found = window(pair)
        return found and replace(found, box=replace(found.box, cells=16))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(internal_shift_choice, "window", coarse)
        patch.setattr(internal_shift_choice, "_TOLERANCE", 1e-2)
        yield


def test_every_printed_formula_gives_its_value() -> None:
    checked = [step for step in sheet_for(WORDS).steps() if step.formula]
    assert len(checked) >= 12
    for step in checked:
        assert evaluated(step) == pytest.approx(step.value, rel=1e-9, abs=1e-9), (step.name, step.formula)
    assert any(abs(evaluated(step, 1e-3) - float(step.value)) > 1e-6 for step in checked)


def test_choices_are_those_of_built_pairs() -> None:
    data = values_of(WORDS)
    choices = data["choices"]
    assert [c["name"] for c in choices] == [
        "no shift", "least wear: equal sliding", "greatest contact ratio", "a_w = 40.5 mm",
    ]  # fmt: skip
    alpha = iso_53().pressure_angle
    pair = InternalShiftPair(20, 60, iso_53(), PinionCutter(1.0, 25, alpha))
    for choice in choices:
        x1, x2 = (choice["profile_shift_coefficient"][name] for name in ("first", "second"))
        made = internal_pair(pair.pinion(x1), pair.ring(x2))
        assert choice["contact_ratio"] == pytest.approx(made.contact_ratio, rel=1e-9)
        if choice["name"].startswith("a_w"):
            assert 2 * made.working_centre_distance == pytest.approx(40.5, rel=1e-12)
        if "equal" in choice["name"]:
            assert choice["root_sliding"]["first"] == pytest.approx(choice["root_sliding"]["second"], rel=1e-6)
    names = {line["name"] for line in data["blocking_contour"]}
    assert names >= {"working_angle", "undercut_first", "contact_ratio", "equal_sliding", "cutter_radial_assembly"}


@pytest.mark.parametrize("language", ["en", "uk"])
def test_every_form_and_language(language: str) -> None:
    for form in SPOKEN:
        assert len(render(sheet_for(WORDS), form, language)) > 1000
    page = sheet_for(WORDS)
    for text in (page.title, *(section.title for section in page.sections), *page.notes):
        en, uk = (words(one).say(text) for one in ("en", "uk"))
        assert not re.search(r"[а-яіїєґ]{2}", en)
        assert re.search(r"[а-яіїєґ]{2}", uk)
    text = render(sheet_for(WORDS), "text", language)
    assert ("внутрішня пара" if language == "uk" else "internal pair") in text
    assert text.count("#") > 100


@pytest.fixture(scope="module")
def contour() -> Any:
    pair = InternalShiftPair(30, 44, iso_53(), PinionCutter(1.0, 20, iso_53().pressure_angle))
    found = window(pair)
    assert found is not None
    return internal_contour(pair, InternalRequirements(), replace(found.box, cells=16), 1e-2)


def test_every_line_has_a_style_and_words() -> None:
    alpha = iso_53().pressure_angle
    shaper = PinionCutter(1.0, 20, alpha)
    for root in (shaper, RoundedRoot()):
        pair = InternalShiftPair(14, 60, iso_53(), root, pinion_cutter=shaper)
        names = {c.name for c in conditions(pair).values()}
        for name in (*names, "undercut_to_active_flank_first", "fillet_interference_first"):
            told = words("en").say(line_name(name))
            assert told.isprintable()
            assert not re.search(r"[а-яіїєґ]{2}", told)
        texts = [tool_texts(pair, words(language)) for language in ("en", "uk")]
        assert len(texts[0]) == len(texts[1]) == 4
        assert "k_2" in texts[0][1]


def test_the_drawing_has_the_lines_of_the_contour(contour: Any, tmp_path: Path) -> None:
    """Read back by ezdxf: each vertex of each line's layer keeps the condition at 0."""
    file = tmp_path / "contour.dxf"
    marks = {"1: here": (0.1, 0.2)}
    counts = write_contour_dxf(file, contour, marks, words("uk"))
    drawing = ezdxf.readfile(file)
    assert not drawing.audit().errors
    space = drawing.modelspace()
    lines = [e for e in space.query("LWPOLYLINE") if e.dxf.layer not in ("AXES", "REGION")]
    assert len(lines) == sum(len(clipped(line.points, contour.box)) for line in contour.lines)
    assert counts["LWPOLYLINE"] == len(lines) + len(contour.region) + 1
    known = {n.upper().replace(" ", "_"): c for n, c in conditions(contour.pair).items()}
    checked = 0
    for entity in lines:
        name = entity.dxf.layer.replace("FILLET_INTERFERENCE_FIRST", "ACTIVE_FLANK_FIRST")
        name = name.replace("UNDERCUT_TO_", "")
        for x, y, *_ in list(entity.get_points())[1:-1]:
            assert abs(known[name].margin(x / SCALE, y / SCALE)) < 1e-6, name
            checked += 1
    assert checked > 100
    circle = space.query("CIRCLE").first
    assert (circle.dxf.center.x, circle.dxf.center.y) == pytest.approx((10, 20))
    texts = " ".join(e.dxf.text for e in space.query("TEXT"))
    assert "довбач вінця: z_0 = 20" in texts
    assert "інтерференція" in texts
    box, step = contour.box, grid_step(contour.box)
    along = [e.dxf.text for e in space.query("TEXT") if abs(e.dxf.insert.y - (box.bottom * SCALE - 8)) < 1e-6]
    assert along == [
        f"{k * step:.3g}".replace(".", ",").replace("-", MINUS)
        for k in range(-1000, 1000)
        if box.left <= k * step <= box.right
    ]
    # the same bytes every time
    first = file.read_bytes()
    write_contour_dxf(file, contour, marks, words("uk"))
    assert file.read_bytes() == first


def test_the_drawing_has_its_axes_numbers_and_key_where_they_belong(contour: Any, tmp_path: Path) -> None:
    """Layers by colour, one for each line; numbers at their places, the key beside the box, all within the extents."""
    file = tmp_path / "contour.dxf"
    marks = {"1: here": (0.1, 0.2), "2: there": (contour.box.left / 2, contour.box.top / 2)}
    counts = write_contour_dxf(file, contour, marks, words("en"))
    drawing = ezdxf.readfile(file)
    space, box = drawing.modelspace(), contour.box
    assert drawing.dxfversion == "AC1024"
    assert [drawing.header[name] for name in ("$INSUNITS", "$LUNITS", "$MEASUREMENT")] == [4, 2, 1]
    assert counts == {kind: len(space.query(kind)) for kind in ("LWPOLYLINE", "LINE", "CIRCLE", "TEXT")}
    used = {e.dxf.layer for e in space}
    colours = {layer.dxf.name: layer.color for layer in drawing.layers if layer.dxf.name in used}
    assert colours.keys() == used
    own = {name: colour for name, colour in colours.items() if name not in ("AXES", "REGION", "KEY", "CHOICES")}
    assert (colours["AXES"], colours["REGION"], colours["KEY"], colours["CHOICES"]) == (8, 3, 7, 6)
    kinds = {line.name for line in contour.lines}
    assert len(set(own.values())) == min(10, len(kinds))
    rings = [
        np.array([complex(x, y) for x, y, *_ in e.get_points()]) / SCALE for e in space.query('*[layer=="REGION"]')
    ]
    for ring, exact in zip(rings, contour.region, strict=True):
        assert np.allclose(ring, np.asarray(exact), atol=1e-12)
    # the frame, and the axes that cross it
    (frame,) = (e for e in space.query("LWPOLYLINE") if e.dxf.layer == "AXES")
    corners = {(round(x / SCALE, 9), round(y / SCALE, 9)) for x, y, *_ in frame.get_points()}
    assert corners == {(round(x, 9), round(y, 9)) for x in (box.left, box.right) for y in (box.bottom, box.top)}
    axes = sorted((e.dxf.start.x, e.dxf.start.y, e.dxf.end.x, e.dxf.end.y) for e in space.query('LINE[layer=="AXES"]'))
    edges = [SCALE * edge for edge in (box.left, box.bottom, box.right, box.top)]
    crossing = [(0.0, edges[1], 0.0, edges[3])] * (box.left < 0 < box.right)
    crossing += [(edges[0], 0.0, edges[2], 0.0)] * (box.bottom < 0 < box.top)
    assert np.allclose(np.ravel(axes), np.ravel(sorted(crossing)))
    # each number stands below or beside its place, within half a row
    numbers = [e for e in space.query('TEXT[layer=="AXES"]') if not e.dxf.text.startswith("x")]
    for text in numbers:
        x, y, value = text.dxf.insert.x, text.dxf.insert.y, float(text.dxf.text.replace(MINUS, "-"))
        below = edges[1] - 15 < y < edges[1] and abs(x - SCALE * value) < 10
        beside = edges[0] - 25 < x < edges[0] and abs(y + text.dxf.height / 2 - SCALE * value) < 3
        assert below != beside, (x, y, value)
    titles = {e.dxf.text: e.dxf.insert for e in space.query('TEXT[layer=="AXES"]') if e.dxf.text.startswith("x")}
    assert edges[2] - 25 < titles["x1"].x < edges[2]
    assert edges[1] - 30 < titles["x1"].y < min(e.dxf.insert.y for e in numbers) - 5
    assert edges[0] - 25 < titles["x2"].x < edges[0]
    assert edges[3] < titles["x2"].y < edges[3] + 20
    # the key: rows one below the other beside the box, each line's sample at the height of its name's middle
    rows = [e for e in space.query("TEXT") if e.dxf.insert.x > edges[2] and e.dxf.layer != "AXES"]
    heights = [e.dxf.insert.y for e in rows]
    assert heights[0] + rows[0].dxf.height == pytest.approx(edges[3])
    assert np.allclose(-np.diff(heights), 9)
    for sample in space.query("LINE"):
        if sample.dxf.layer != "AXES":
            (name,) = (e for e in rows if e.dxf.layer == sample.dxf.layer)
            assert edges[2] < sample.dxf.start.x < sample.dxf.end.x < name.dxf.insert.x
            assert sample.dxf.start.y == sample.dxf.end.y == pytest.approx(name.dxf.insert.y + name.dxf.height / 2)
    for number, (told, (x1, x2)) in enumerate(marks.items(), 1):
        ring = space.query("CIRCLE")[number - 1].dxf
        assert (ring.center.x, ring.center.y, ring.radius) == pytest.approx((SCALE * x1, SCALE * x2, 2))
        beside = [e.dxf.insert for e in space.query("TEXT") if e.dxf.text == str(number) and e.dxf.layer == "CHOICES"]
        assert any(2 < abs(complex(*at.vec2) - SCALE * complex(x1, x2)) < 6 and at.x > ring.center.x for at in beside)
        assert f"{told}: {x1:.4f} / {x2:.4f}".replace("-", MINUS) in [e.dxf.text for e in rows]
    low, high = drawing.header["$EXTMIN"], drawing.header["$EXTMAX"]
    for text in space.query("TEXT"):
        assert low[0] <= text.dxf.insert.x < high[0]
        assert low[1] <= text.dxf.insert.y < text.dxf.insert.y + text.dxf.height <= high[1]
    assert low[0] == pytest.approx(edges[0] - 20)
    assert edges[2] + 100 < high[0] < edges[2] + 400


@pytest.mark.parametrize("box", [
    Box(-0.43, 1.27, -0.31, 1.13, 4), Box(0.13, 0.97, 0.26, 0.88, 4), Box(-2.0, 4.0, 0.0, 3.0, 4),
])  # fmt: skip
def test_numbers_are_all_those_that_lie_along_the_box(contour: Any, box: Box, tmp_path: Path) -> None:
    """Multiples of the step between the sides of any box, each once; axes where the box has them within."""
    write_contour_dxf(tmp_path / "b.dxf", replace(contour, box=box, region=()), {}, words("en"))
    space = ezdxf.readfile(tmp_path / "b.dxf").modelspace()
    numbers = [e for e in space.query('TEXT[layer=="AXES"]') if not e.dxf.text.startswith("x")]
    below = sorted(float(e.dxf.text.replace(MINUS, "-")) for e in numbers if e.dxf.insert.y < box.bottom * SCALE - 5)
    beside = sorted(float(e.dxf.text.replace(MINUS, "-")) for e in numbers if e.dxf.insert.y >= box.bottom * SCALE - 3)
    places = [k * grid_step(box) for k in range(-100, 101)]
    assert below == pytest.approx([x for x in places if box.left <= x <= box.right], abs=1e-9)
    assert beside == pytest.approx([y for y in places if box.bottom <= y <= box.top], abs=1e-9)
    upright = [e for e in space.query('LINE[layer=="AXES"]') if e.dxf.start.x == e.dxf.end.x]
    level = [e for e in space.query('LINE[layer=="AXES"]') if e.dxf.start.y == e.dxf.end.y]
    assert (len(upright), len(level)) == (box.left < 0 < box.right, box.bottom < 0 < box.top)


def test_the_picture_has_a_line_and_a_key_for_each_condition(contour: Any) -> None:
    text = contour_svg(contour, {"1: here": (0.1, 0.2)}, words("uk"))
    assert text.count("<polyline") == sum(len(clipped(line.points, contour.box)) for line in contour.lines)
    shown = kinds_shown(contour)
    assert {line.name for line in shown} >= {"trochoid_interference", "radial_assembly", "contact_ratio"}
    told = {"".join(one.itertext()) for one in ET.fromstring(text)}
    for line in shown:
        # its indices lowered
        assert line_title(line.name, line.level, words("uk")).replace("_", "") in told


def test_lines_are_cut_off_at_the_box(contour: Any) -> None:
    """As shapely cuts them."""
    box = contour.box
    small = Box(box.left / 2, box.right / 3, box.bottom / 2, box.top / 2, 1)
    frame, cut = shapely.box(small.left, small.bottom, small.right, small.top), 0
    for line in contour.lines:
        whole = shapely.LineString([(p.real, p.imag) for p in line.points])
        pieces = clipped(line.points, small)
        assert sum(abs(b - a) for piece in pieces for a, b in pairwise(piece)) == pytest.approx(
            whole.intersection(frame).length, abs=1e-7
        )
        cut += bool(pieces) and not frame.contains(whole)
    assert cut > 5


def test_pictures_are_written_by_their_ending(contour: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name, start in (("c.svg", "<svg"), ("c.DXF", "  0\nSECTION")):
        page = Sheet("shift-choice", "contour")
        page.picture = ContourPicture(contour, (("region: {conditions}", (0.1, 0.2)),))
        page.picture_file = str(tmp_path / name)
        monkeypatch.setattr(topics, "sheet_of", lambda _topic, _words, _language, page=page: (page, "uk"))
        calculate("shift-choice", [], "text", "uk")
        text = (tmp_path / name).read_text(encoding="utf-8")
        assert text.startswith(start)
        assert "1: область" in text


@pytest.mark.parametrize("name", ["contour.txt", "contour", "contour.svg.gz", ".txt", "no_such_folder/contour.svg"])
def test_other_endings_are_refused_with_one_that_works(name: str) -> None:
    with pytest.raises(SceneError) as caught:
        checked_picture("shift-choice", name)
    works = caught.value.nearest
    assert works
    assert isinstance(works.value, str)
    checked_picture("shift-choice", works.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("kind", [GIVEN, "first.number_of_teeth=13 second.number_of_teeth=21"])
def test_both_kinds_of_pairs_refuse_a_text_file(kind: str) -> None:
    told = refused("shift-choice", *kind.split(), "picture=contour.txt")
    assert (told.code, told.nearest) == ("file_ends_in", Nearest("contour.svg"))


def test_a_scene_gives_pair_cutter_and_shifts(tmp_path: Path) -> None:
    file = tmp_path / "pair.toml"
    file.write_text(SCENE, encoding="utf-8")
    scene = load_scene(str(file))
    for typed, teeth, cutter in (
        ({}, 24, 20),
        ({"second.cutter.number_of_teeth": 30, "first.number_of_teeth": 22}, 22, 30),
    ):
        table = shift_choice.table_from(scene, str(file), table_of([f"{k}={v}" for k, v in typed.items()]))
        assert table.pop("kind") == "internal_gear_pair"
        keys = checked(table, InternalShiftKeys, "shift-choice")
        pair = shift_pair(keys)
        assert pair.teeth == (teeth, 60)
        assert pair.plain_tip
        assert isinstance(pair.root, PinionCutter)
        assert pair.root.number_of_teeth == cutter
        assert (keys.first.profile_shift_coefficient, keys.second.profile_shift_coefficient) == (0.1, 0.3)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("wanted", "word"), [("37.6", "at least"), ("45", "at most")])
def test_the_nearest_distance_that_works_is_named_and_works(wanted: str, word: str) -> None:
    table = table_of(WORDS.replace("40.5", wanted).replace("shift-choice ", "").split())
    table.pop("kind")
    keys = checked(table, InternalShiftKeys, "shift-choice")
    pair, page = shift_pair(keys), Sheet("shift-choice", "")
    found = internal_shift_choice._wanted_difference(keys, pair)
    assert found is not None
    assert for_sum(pair, InternalRequirements(), found) is None
    internal_shift_choice._nearest_distance(page, keys.module, pair, InternalRequirements(), found)
    match = re.search(rf"{word} ([\d.]+) mm works", words("en").say(page.notes[0]))
    assert match
    again = checked(table | {"working_centre_distance": float(match[1])}, InternalShiftKeys, "shift-choice")
    total = internal_shift_choice._wanted_difference(again, pair)
    assert total is not None
    assert for_sum(pair, InternalRequirements(), total) is not None
    # and is the nearest but for its last digits
    farther = float(match[1]) + (2e-4 if word == "at most" else -2e-4)
    again = checked(table | {"working_centre_distance": farther}, InternalShiftKeys, "shift-choice")
    total = internal_shift_choice._wanted_difference(again, pair)
    assert total is not None
    assert for_sum(pair, InternalRequirements(), total) is None


@pytest.mark.heavy
def test_the_pair_of_the_power_module(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "contour.svg"
    assert run("calc", "shift-choice", "thesis_internal_pair", f"picture={file.as_posix()}") == 0
    text = capsys.readouterr().out
    assert "as given" in text
    assert "outside the contour" not in text
    assert file.read_text(encoding="utf-8").startswith("<svg")


@pytest.mark.parametrize(
    ("arguments", "key", "code", "nearest"),
    [
        ("kind=internal_gear_pair first.number_of_teeth=20", "shift-choice.second", "missing_key", None),
        (f"{GIVEN} kind2=1", "shift-choice.kind2", "unknown_key", None),
        ("kind=internal_gear first.number_of_teeth=20", "shift-choice.kind", "unknown_pair", "internal_gear_pair"),
        (f"{GIVEN} least_tip_clearence=0.1", "shift-choice.least_tip_clearence", "unknown_key", "least_tip_clearance"),
        (f"{GIVEN} basic_rack=ISO", "shift-choice.basic_rack", "not_allowed", "ISO 53 D"),
        (
            "kind=internal_gear_pair first.number_of_teeth=60 second.number_of_teeth=60",
            "shift-choice.second.number_of_teeth",
            "not_above_pinion_teeth",
            61,
        ),
        (
            f"{GIVEN} second.cutter.number_of_teeth=60",
            "shift-choice.second.cutter.number_of_teeth",
            "not_below_ring_teeth",
            59,
        ),
        (
            f"{GIVEN} second.cutter.number_of_teeth=20 second.rounded_root.full_round=true",
            "shift-choice.second.rounded_root",
            "either_key",
            None,
        ),
        (
            f"{GIVEN} second.cutter.number_of_teeth=20 second.cutter.tip_rounding_coefficient=2",
            "shift-choice.second.cutter.tip_rounding_coefficient",
            "cutter_rounding_does_not_fit",
            0.3462,
        ),
        (f"{GIVEN} working_centre_distance=10", "shift-choice.working_centre_distance", "no_working_angle", 37.587705),
        (f"{GIVEN} second.tip_rule=DIN", "shift-choice.second.tip_rule", "not_allowed", None),
        (f"{GIVEN} second=60", "second", "given_twice", None),
        ("rack_and_pinion", "mate", "shifts_of_gear_pairs", None),
        ("thesis_internal_pair second=3", "shift-choice.second", "write_teeth", None),
    ],
)
def test_wrong_input_gets_one_clear_line(
    arguments: str, key: str, code: str, nearest: object, capsys: pytest.CaptureFixture[str]
) -> None:
    told = refused("shift-choice", *arguments.split())
    assert (told.key, told.code, told.nearest and told.nearest.value) == (key, code, nearest)
    assert complaint(capsys, "calc", "shift-choice", *arguments.split()) == f"higherpair: {told}\n"


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("pinion", "ring", "more", "limited"),
    [(20, 28, {}, True), (13, 24, {"h": 0.8}, True), (20, 60, {}, False), (40, 80, {"x2": 0.5}, False)],
)
def test_the_given_shifts_have_the_numbers_of_a_check(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, pinion: int, ring: int, more: dict[str, float], limited: bool
) -> None:
    """The ring's tip is the one of a build, by whatever cutter; without that 20/28 would say 1.866."""
    file = tmp_path / "pair.toml"
    keys = f"profile_shift_coefficient = {more.get('x2', 0.0)}\naddendum_coefficient = {more.get('h', 1.0)}"
    file.write_text(
        f'[parts.p]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = {pinion}\n'
        f'[parts.r]\nkind = "ring_gear"\nmodule = 2.0\nnumber_of_teeth = {ring}\n{keys}\n'
        '[[mates]]\nkind = "internal_gear_pair"\nfirst = "p"\nsecond = "r"\n',
        encoding="utf-8",
    )
    scene = load_scene(str(file))
    made, (mating,) = make_parts(scene, str(file))
    # the page of the scene without the contour, which takes as long as all choices
    monkeypatch.setattr(internal_shift_choice, "window", lambda pair: None)
    page = sheet_of("shift-choice", [str(file)])[0]
    ratio = next(step.value for step in page.steps() if step.name == "contact_ratio")
    keys_of_pinion, keys_of_ring = (scene.parts[name] for name in "pr")
    assert isinstance(keys_of_pinion, SpurGearSpec)
    assert isinstance(keys_of_ring, RingGearSpec)
    built = internal_pair(gear_of(keys_of_pinion), checked_ring_gear(keys_of_ring))
    assert ratio == pytest.approx(built.contact_ratio, rel=1e-12)
    # a ring whose tips its mate makes shorter still is told with the pair
    told = {f.code for f in (*made["r"].findings, *mating.findings())}
    assert bool(told & {"ring_tip_limited", "tips_shortened_ring"}) is limited
    assert ("made shallower" in render(page, "text", "en")) is limited


@pytest.mark.heavy
def test_helical_choices_are_those_of_built_pairs() -> None:
    """Pinion and ring of a build from the normal shifts that are told, and every formula by its own numbers."""
    beta, width = 18.0, 24.0
    typed = f"helix_angle_deg={beta} face_width={width} least_contact_ratio=2.4 working_centre_distance=42.8"
    page = sheet_for(f"shift-choice {GIVEN} {typed}")
    for step in page.steps():
        if step.formula:
            assert evaluated(step) == pytest.approx(step.value, rel=1e-9, abs=1e-9), (step.name, step.formula)
    overlap = width * math.sin(math.radians(beta)) / (math.pi * 2)
    choices = page.data["choices"]
    assert [c["name"] for c in choices] == [
        "no shift", "least wear: equal sliding", "greatest contact ratio", "a_w = 42.8 mm",
    ]  # fmt: skip
    for choice in choices:
        x1, x2 = (choice["profile_shift_coefficient"][name] for name in ("first", "second"))
        common = {"module": 2.0, "helix_angle_deg": beta, "face_width": width}
        pinion = SpurGearSpec(number_of_teeth=20, profile_shift_coefficient=x1, **common)
        ring = RingGearSpec(number_of_teeth=60, profile_shift_coefficient=x2, **common)
        made = internal_pair(checked_spur_gear(pinion), checked_ring_gear(ring))
        assert choice["contact_ratio"] == pytest.approx(made.contact_ratio + overlap, rel=1e-9)
        assert choice["contact_ratio"] >= 2.4 or choice["name"] == "no shift"
        if choice["name"].startswith("a_w"):
            assert made.working_centre_distance == pytest.approx(42.8, rel=1e-12)
    assert {line["name"] for line in page.data["blocking_contour"]} >= {"total_contact_ratio", "cutter_radial_assembly"}


def test_a_scene_tells_the_helix_and_the_face_of_its_ring(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    helical = SCENE.replace("[parts.pinion]", "helix_angle_deg = 12.0\nface_width = 30.0\n[parts.pinion]")
    file = tmp_path / "helical.toml"
    file.write_text(helical.replace("[[mates]]", "helix_angle_deg = -12.0\nface_width = 25.0\n[[mates]]"), "utf-8")
    monkeypatch.setattr(internal_shift_choice, "window", lambda pair: None)
    monkeypatch.setattr(internal_shift_choice, "_found_choices", lambda *given: [])
    told = {step.name: step.value for step in sheet_of("shift-choice", [str(file)])[0].steps()}
    assert told["helix_angle_deg"] == pytest.approx(12.0)
    assert told["face_width"] == 25.0
