"""Sheets: measured off the files as with dividers, everything named, nothing over anything, damage noticed."""

from __future__ import annotations

import itertools
import json
import math
import re
from collections.abc import Callable
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import ezdxf
import pytest

from exporters.production.build import build
from exporters.production.plan import plan_build
from exporters.production.sheets import SheetJob
from parts.base.refusal import SceneError
from parts.drawing.canvas import Box, Text, text_of
from parts.drawing.font import Run
from parts.drawing.labels import spread
from parts.scene.load import load_scene, scene_from_dict
from tests.exporters.making import run
from tests.sampling import some_of

SCENES = ("practicum_pair", "thesis_internal_pair", "rack_and_pinion", "tmm42")
# what a picture of meshing names
NAMES = {"O", "P", "N", "a", "b", "d", "d'", "T", "α"}


def scene_of(name: str, language: str = "en") -> Any:
    scene = load_scene(name)
    scene.scene.language = language
    return scene


@cache
def jobs_of(name: str, language: str = "en") -> tuple[SheetJob, ...]:
    return plan_build(scene_of(name, language), name, [], ["sheet"]).sheets


def job_of(name: str, ending: str) -> SheetJob:
    return next(j for j in jobs_of(name) if j.path.endswith(ending))


@pytest.mark.sampled(1)
@pytest.mark.parametrize("language", ["en", "uk"])
@pytest.mark.parametrize("name", SCENES)
def test_every_sheet_is_good_in_both_languages(tmp_path: Path, name: str, language: str) -> None:
    words = {}
    for job in jobs_of(name, language):
        job.write({}, tmp_path / job.path)
        verdict = job.verify(tmp_path / job.path, 0.0)
        assert verdict.failures == ()
        assert verdict.measured["max_deviation"] <= 1.1e-6
        words[job.path[-3:]] = sorted(run.text for text in job.canvas.texts for run in text.runs)
    assert words["dxf"] == words["svg"]
    assert any(re.search("[а-яіїє]", word) for word in words["dxf"]) == (language == "uk")
    if name != "tmm42":
        assert {w for word in words["dxf"] for w in re.split("[ ,]+", word)} >= NAMES


def test_the_contact_ratio_is_measured_off_the_drawing_of_the_practicum(tmp_path: Path) -> None:
    """Figures 3.5, 3.11 and 3.13 with ezdxf alone: N1N2 touches both base circles, ab and dd' give (3.20)."""
    job = job_of("practicum_pair", "dxf")
    job.write({}, tmp_path / job.path)
    space = ezdxf.readfile(tmp_path / job.path).modelspace()
    action, active = (space.query(f'LINE[layer=="{name}"]').first for name in ("LINE_OF_ACTION", "ACTIVE_LINE"))
    bases = list(space.query('ARC[layer=="CIRCLE_BASE"]'))
    assert len(bases) == 2
    scale = job.expected.paper.scale
    assert sorted(b.dxf.radius / scale for b in bases) == pytest.approx(
        [65 * math.cos(math.radians(20)), 105 * math.cos(math.radians(20))], abs=1e-8
    )
    way = (action.dxf.end - action.dxf.start).normalize()
    for base in bases:
        spoke = base.dxf.center - action.dxf.start
        assert abs(way.x * spoke.y - way.y * spoke.x) == pytest.approx(base.dxf.radius, abs=2e-8)
    # (3.20) from the radii that the drawing shows
    tips = sorted(a.dxf.radius for a in space.query('ARC[layer=="CIRCLE_TIP"]'))
    radii = sorted(b.dxf.radius for b in bases)
    centres = [b.dxf.center for b in bases]
    angle = math.acos(sum(radii) / centres[0].distance(centres[1]))
    tangents = [math.tan(math.acos(b / a)) for a, b in zip(tips, radii, strict=True)]
    ratio = (13 * (tangents[0] - math.tan(angle)) + 21 * (tangents[1] - math.tan(angle))) / (2 * math.pi)
    length = active.dxf.start.distance(active.dxf.end)
    assert length / (2 * math.pi * radii[0] / 13) == pytest.approx(ratio, abs=1e-6)
    arc, pitch = (space.query(f'ARC[layer=="{name}"]').first for name in ("ARC_OF_ACTION", "WORKING_PITCH"))
    arcs = [a.dxf.radius * math.radians((a.dxf.end_angle - a.dxf.start_angle) % 360) for a in (arc, pitch)]
    assert arcs[0] / arcs[1] == pytest.approx(ratio, abs=1e-6)
    assert ratio == pytest.approx(1.164, abs=5e-4)


def test_the_drawing_has_layers_line_types_and_true_splines(tmp_path: Path) -> None:
    job = job_of("practicum_pair", "dxf")
    job.write({}, tmp_path / job.path)
    drawing = ezdxf.readfile(tmp_path / job.path)
    assert drawing.dxfversion == "AC1024"
    assert drawing.header["$INSUNITS"] == 4
    assert drawing.header["$EXTMAX"][0] == pytest.approx(job.canvas.width - 5)
    kinds = {e.dxftype() for e in drawing.modelspace()}
    assert kinds == {"LINE", "ARC", "CIRCLE", "SPLINE", "TEXT"}
    layers = {layer.dxf.name: layer.dxf for layer in drawing.layers}
    assert layers["CIRCLE_WORKING"].linetype == layers["CENTRE"].linetype != "CONTINUOUS"
    assert layers["TOOTH_START"].linetype != layers["CENTRE"].linetype
    assert layers["OUTLINE"].lineweight == 50
    assert not drawing.audit().errors


def test_librecad_finds_its_fonts_and_line_types_by_their_names(tmp_path: Path) -> None:
    """LibreCAD 2.2 (rs_filterdxfrw.cpp): a style's name is a font of its own, any other line type is drawn solid.

    Of its fonts unicode.lff has Cyrillic and no Greek, lc_opengost-ar.lff both and the sign of a number.
    """
    scene = scene_of("practicum_flat_cam", "uk")
    for export in scene.exports:
        export.tolerance = 1e-2
    job = next(j for j in plan_build(scene, "t", [], ["sheet"]).sheets if j.path.endswith("dxf"))
    job.write({}, tmp_path / job.path)
    drawing = ezdxf.readfile(tmp_path / job.path)
    texts = [(e.dxf.style, e.dxf.text) for e in drawing.modelspace().query("TEXT")]
    assert {"unicode", "lc_opengost-ar"} == {style for style, _ in texts}
    assert all(style == "lc_opengost-ar" for style, text in texts if set(text) & set("φγρωΔμ№"))
    assert any(style == "unicode" and "кулачка" in text for style, text in texts)
    assert {drawing.styles.get(style).dxf.font for style, _ in texts} == {"arial.ttf"}
    kinds = {layer.dxf.linetype for layer in drawing.layers}
    assert {"CENTER2", "DASHED2"} & kinds
    assert {kind.upper() for kind in kinds} <= {"CENTER2", "DASHED2", "CONTINUOUS"}


def test_librecad_prints_a_sheet_on_its_paper_at_its_size(tmp_path: Path) -> None:
    """LibreCAD 2.2 (rs_graphic.cpp): it prints at $PSVPSCALE, 0 gives an empty page, on paper to $PLIMMAX."""
    for name in ("practicum_pair", "tmm42"):
        job = job_of(name, "dxf")
        job.write({}, tmp_path / job.path)
        header = ezdxf.readfile(tmp_path / job.path).header
        assert header["$PSVPSCALE"] == 1
        assert [*header["$PLIMMIN"], *header["$PLIMMAX"]] == pytest.approx([0, 0, job.canvas.width, job.canvas.height])


def test_a_1_that_stands_alone_is_no_7(tmp_path: Path) -> None:
    """Fitted between two points, all of its black: of Arial's 1 that is 540 / 1466 of the height of a capital."""
    job = job_of("practicum_pair", "dxf")
    job.write({}, tmp_path / job.path)
    texts = ezdxf.readfile(tmp_path / job.path).modelspace().query("TEXT")
    shares = {t.dxf.text: (t.dxf.align_point - t.dxf.insert).magnitude / t.dxf.height for t in texts}
    assert shares["1"] == pytest.approx(540 / 1466, abs=0.05)
    assert shares["2"] == pytest.approx(0.64, abs=0.05)


def test_splines_are_dashed_whatever_draws_them(tmp_path: Path) -> None:
    """LibreCAD draws a spline solid, whatever its line type is: 4 mm and a gap of 1.5 mm are drawn as that."""
    job = job_of("practicum_pair", "dxf")
    job.write({}, tmp_path / job.path)
    space = ezdxf.readfile(tmp_path / job.path).modelspace()
    for layer in ("TOOTH_START", "TOOTH_END"):
        found = dashes(space, layer)
        assert {e.dxf.linetype for e in found} == {"CONTINUOUS"}
        curves = [[(p.x, p.y) for p in e.construction_tool().approximate(200)] for e in found]
        lengths = [sum(math.dist(a, b) for a, b in pairwise(points)) for points in curves]
        assert max(lengths) < 1.7 * 4.0
        gaps = [math.dist(one[-1], two[0]) for one, two in pairwise(curves)]
        assert sum(1.45 < gap < 1.5001 for gap in gaps) > len(gaps) / 2


def test_the_same_bytes_every_time(tmp_path: Path) -> None:
    for job, again in zip(jobs_of("practicum_pair"), plan_build(scene_of("practicum_pair"), "p", [], ["sheet"]).sheets,
                          strict=True):  # fmt: skip
        files = tmp_path / f"one.{job.path[-3:]}", tmp_path / f"two.{job.path[-3:]}"
        job.write({}, files[0])
        again.write({}, files[1])
        assert files[0].read_bytes() == files[1].read_bytes()


def on_layer(space: Any, kind: str, layer: str) -> Any:
    return space.query(f'{kind}[layer=="{layer}"]').first


def move_text(space: Any) -> None:
    texts = list(space.query("TEXT"))
    for key in ("insert", "align_point"):
        texts[3].dxf.set(key, texts[4].dxf.get(key))


def dashes(space: Any, layer: str) -> list[Any]:
    return list(space.query(f'SPLINE[layer=="{layer}"]'))


def bend_spline(space: Any) -> None:
    spline = on_layer(space, "SPLINE", "OUTLINE")
    points = [list(p) for p in spline.control_points]
    points[len(points) // 2][0] += 1e-3
    spline.control_points = points


DAMAGE: dict[str, tuple[Callable[[Any], Any], str]] = {
    "active line": (lambda s: on_layer(s, "LINE", "ACTIVE_LINE").translate(1e-4, 0, 0), "leaves the line of action"),
    "its end": (
        lambda s: on_layer(s, "LINE", "ACTIVE_LINE").dxf.set("end", on_layer(s, "LINE", "ACTIVE_LINE").dxf.start),
        "instead of",
    ),
    "base circle": (lambda s: on_layer(s, "ARC", "CIRCLE_BASE").dxf.set("radius", 100.0), "no circle of"),
    "line of action": (lambda s: on_layer(s, "LINE", "LINE_OF_ACTION").translate(0, 1e-4, 0), "misses the base circle"),
    "arc of action": (
        lambda s: on_layer(s, "ARC", "ARC_OF_ACTION").dxf.set("end_angle", 110.0),
        "contact_ratio_by_arc",
    ),
    "pitch": (lambda s: on_layer(s, "ARC", "WORKING_PITCH").destroy(), "measures"),
    "tooth": (bend_spline, "outlines deviate"),
    "tooth lost": (lambda s: s.delete_entity(on_layer(s, "SPLINE", "OUTLINE")), "no line from"),
    "first dash lost": (lambda s: s.delete_entity(dashes(s, "TOOTH_END")[1]), "outlines deviate"),
    "dash lost": (lambda s: s.delete_entity(dashes(s, "TOOTH_END")[2]), "no line from"),
    "dashes doubled": (lambda s: dashes(s, "TOOTH_START")[1].dxf.set("linetype", "BYLAYER"), "in its dashes"),
    "dash moved": (lambda s: dashes(s, "TOOTH_START")[1].translate(0.01, 0, 0), "outlines deviate"),
    "word lost": (lambda s: s.delete_entity(s.query('TEXT[text=="P"]').first), "words are missing: P"),
    "word over word": (move_text, "stands over"),
    "beyond the frame": (lambda s: on_layer(s, "LINE", "CENTRE").translate(0, 400, 0), "leaves the frame"),
    "foreign": (lambda s: s.add_point((50, 50)), "a POINT stands in the sheet"),
}


@pytest.mark.sampled(1)
@pytest.mark.parametrize("damage", DAMAGE)
def test_damage_is_noticed(tmp_path: Path, damage: str) -> None:
    job = job_of("practicum_pair", "dxf")
    file = tmp_path / job.path
    job.write({}, file)
    drawing = ezdxf.readfile(file)
    spoil, wanted = DAMAGE[damage]
    spoil(drawing.modelspace())
    drawing.saveas(file)
    assert any(wanted in failure for failure in job.verify(file, 0.0).failures), job.verify(file, 0.0).failures


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("pattern", "instead", "wanted"),
    [
        (r'(<g id="ACTIVE_LINE"[^>]*>\n<path d="M)[\d.]+', r"\g<1>300", "leaves the line of action"),
        (r'(<g id="CIRCLE_TIP"[^>]*>\n<path d="M\S+ A)[\d.]+,[\d.]+', r"\g<1>161,161", "no circle of"),
        (r">P</text>", "></text>", "words are missing: P"),
        (r'width="[\d.]+mm"', 'width="500mm"', "size in mm"),
        (r"</svg>", "", "is not an SVG file"),
        (r"C(\d+)", r"Q\1", "path command Q"),
    ],
)
def test_damage_of_an_svg_is_noticed(tmp_path: Path, pattern: str, instead: str, wanted: str) -> None:
    job = job_of("practicum_pair", "svg")
    file = tmp_path / job.path
    job.write({}, file)
    text, count = re.subn(pattern, instead, file.read_text(encoding="utf-8"), count=1)
    assert count == 1
    file.write_text(text, encoding="utf-8")
    assert any(wanted in failure for failure in job.verify(file, 0.0).failures), job.verify(file, 0.0).failures


def test_a_build_reports_and_verifies_its_sheets(tmp_path: Path) -> None:
    scene = scene_of("rack_and_pinion")
    plan = plan_build(scene, "rack_and_pinion", [], ["sheet"])
    written = build(plan, tmp_path / "rack_and_pinion", partial=True).written
    assert [item.failures for item in written] == [(), ()]
    report = json.loads((tmp_path / "rack_and_pinion" / "report.json").read_text(encoding="utf-8"))
    entries = {e["path"]: e for e in report["files"]}
    assert set(entries) == {"rack_and_pinion.meshing.1.dxf", "rack_and_pinion.meshing.1.svg"}
    for path, entry in entries.items():
        assert entry["verified"]
        assert entry["part"] is None
        assert entry["paper"].startswith("A")
        assert entry["max_error"] <= entry["tolerance"] * 1.01
        assert run("verify", str(tmp_path / "rack_and_pinion" / path)) == 0
    file = tmp_path / "rack_and_pinion" / "rack_and_pinion.meshing.1.svg"
    file.write_text(file.read_text(encoding="utf-8").replace(">P</text>", ">Q</text>"), encoding="utf-8")
    assert run("verify", str(file)) == 1


def test_the_tables_of_lesson_1_stand_on_the_sheet() -> None:
    """Tables 1.1 and 1.2 for m 16, d 160: d_b = d cos 20, p = 16 pi, S_t = p / 2 and p / 2 + 2 x tan 20."""
    texts = {run.text for text in job_of("tmm42", "dxf").canvas.texts for run in text.runs}
    pitch = 16 * math.pi
    for value in (160 * math.cos(math.radians(20)), pitch, pitch / 2, pitch / 2 + 2 * 112 / 17 * math.tan(math.pi / 9)):
        assert any(f"{value:.5f}".rstrip("0") in text for text in texts), value
    assert {"zero wheel", "shifted wheel", "undercut"} <= texts
    # with true minus signs, as on pages; it was (17 - z)/17
    assert "(17 \N{MINUS SIGN} z)/17 = (17 \N{MINUS SIGN} 10)/17" in texts


def test_the_scene_of_the_device_has_its_calculation() -> None:
    """Both wheels are of one disk: the shifted one brings both tables."""
    from tests.exporters.documents.test_calc import values_of

    values = values_of("tmm42 tmm42")["values"]
    assert values["number_of_teeth"] == 10
    assert values["profile_shift_coefficient"] == pytest.approx(7 / 17, rel=1e-12)


def gear(teeth: int = 20, **more: Any) -> dict[str, Any]:
    return {"kind": "spur_gear", "module": 2.0, "number_of_teeth": teeth, **more}


def scene_with(export: dict[str, Any], parts: dict[str, Any] | None = None, *, mates: bool = True) -> Any:
    raw: dict[str, Any] = {
        "parts": parts or {"one": gear(), "two": gear(30)},
        "exports": [{"format": "sheet", "tolerance": 1e-3, **export}],
    }
    if mates:
        raw["mates"] = [{"kind": "external_gear_pair", "first": "one", "second": "two"}]
    return scene_from_dict(raw, "t", "t")


@pytest.mark.parametrize(
    ("export", "key"),
    [
        ({"mate": 2}, "mate = 2"),
        ({"kerf": 0.1}, "kerf"),
        ({"offset": 0.1}, "offset"),
        ({"curves": "lines"}, "curves"),
        ({"dxf_version": "R12"}, "dxf_version"),
        ({"assembly": True}, "assembly"),
        ({"parts": ["one"]}, "parts"),
        ({"purpose": "laser"}, "purpose"),
        ({"rack_step": 4.0}, "rack_step"),
        ({"purpose": "generating", "mate": 1}, "mate"),
        ({"purpose": "generating"}, "both wheels of a disk"),
        ({"purpose": "generating", "parts": ["one"], "rack_step": 0.01}, "rack_step"),
    ],
)
def test_refusals_name_the_key(export: dict[str, Any], key: str) -> None:
    with pytest.raises(SceneError) as caught:
        plan_build(scene_with(export), "t", [], [])
    assert key in str(caught.value)


def test_a_picture_needs_a_pair_and_the_device_an_external_gear() -> None:
    with pytest.raises(SceneError) as caught:
        plan_build(scene_with({}, mates=False), "t", [], [])
    assert caught.value.code == "shows_gear_pairs_of_mates"
    ring = {"kind": "ring_gear", "module": 2.0, "number_of_teeth": 60}
    with pytest.raises(SceneError) as caught:
        plan_build(scene_with({"purpose": "generating"}, {"ring": ring}, mates=False), "t", [], [])
    assert caught.value.code == "shows_external_gears"


def test_two_mates_have_two_pictures_and_one_part_none() -> None:
    scene = load_scene("idler_train")
    pairs = len(scene.mates)
    plan = plan_build(scene, "idler_train", [], ["sheet"])
    assert [j.path for j in plan.sheets] == [
        f"idler_train.meshing.{k}.{e}" for k in range(1, pairs + 1) for e in ("dxf", "svg")
    ]
    plan = plan_build(scene_with({}), "t", ["one"], [])
    assert plan.sheets == ()
    assert any("sheet" in str(one.why) for one in plan.left_out)


LEGAL = {
    "large": (gear(1000), gear(1000)),
    "small": (gear(8, profile_shift_coefficient=0.5), gear(9, profile_shift_coefficient=0.5)),
    "pole outside": (gear(12, profile_shift_coefficient=0.8), gear(60, profile_shift_coefficient=-1.9)),
    "relieved": (gear(20, tip_relief={"depth_coefficient": 0.02}), gear(30, tip_chamfer=0.1)),
}


@pytest.mark.heavy
@pytest.mark.parametrize("name", LEGAL)
def test_extreme_but_legal_pairs_have_their_picture(tmp_path: Path, name: str) -> None:
    one, two = LEGAL[name]
    for job in plan_build(scene_with({}, {"one": one, "two": two}), "t", [], []).sheets:
        job.write({}, tmp_path / job.path)
        assert job.verify(tmp_path / job.path, 0.0).failures == ()


def test_text_is_as_wide_as_it_says() -> None:
    text: Text = text_of("r_{a1} = 82,63", 10 + 20j)
    runs: tuple[Run, ...] = text.runs
    assert text.text == "ra1 = 82,63"
    assert [r.text for r in runs] == ["r", "a1", "= 82,63"]
    assert all(a.at.real + a.width <= b.at.real + 1e-9 for a, b in itertools.pairwise(runs))
    narrow = text_of("a long line of words", 0j, most=20.0)
    assert narrow.box.right <= 20.0 + 1e-9
    assert narrow.runs[0].height == pytest.approx(1.8)
    assert Box(0, 0, 1, 1).overlaps(Box(0.5, 0.5, 2, 2))
    assert not Box(0, 0, 1, 1).overlaps(Box(1, 0, 2, 1))


def test_names_in_a_column_keep_their_distance_and_order() -> None:
    assert spread([0, 10, 20], 5, -100, 100) == [0, 10, 20]
    assert spread([0, 0, 0], 6, -100, 100) == [-6, 0, 6]
    crowded = spread([9.0, 9.5, 50.0, 99.0], 7, 0, 100)
    assert all(b - a >= 7 - 1e-12 for a, b in itertools.pairwise(crowded))
    assert spread([98, 99], 7, 0, 100)[-1] <= 100
    assert spread([5] * 5, 30, 0, 100) == [0, 25, 50, 75, 100]


def generating(part: dict[str, Any], **export: Any) -> Any:
    """A scene of one wheel on the device TMM-42."""
    return scene_with({"purpose": "generating", **export}, {"wheel": part}, mates=False)


def test_one_unshifted_wheel_is_the_zero_wheel_alone(tmp_path: Path) -> None:
    """No second wheel in tables and picture; one with a shift has both tables."""
    for shift, number in some_of(((0.0, 0), (0.3, 1))):
        wheel = gear(20, module=10.0, profile_shift_coefficient=shift)
        job = plan_build(generating(wheel, tolerance=1e-3), "t", [], []).sheets[0]
        job.write({}, tmp_path / job.path)
        assert job.verify(tmp_path / job.path, 0.0).failures == ()
        words = " ".join(run.text for text in job.canvas.texts for run in text.runs).lower()
        assert words.count("shifted wheel:") == number
        assert "zero wheel" in words
        # in the picture, by its whole name
        named = {"zero wheel", "shifted wheel"} & {text.text for text in job.canvas.texts}
        assert named == {("zero wheel", "shifted wheel")[number]}


@pytest.mark.sampled(1)
@pytest.mark.parametrize("module", [0.2, 1.0, 10.0, 400.0])
def test_the_device_takes_wheels_of_every_size(module: float, tmp_path: Path) -> None:
    for job in plan_build(generating(gear(12, module=module)), "t", [], []).sheets:
        job.write({}, tmp_path / job.path)
        assert job.verify(tmp_path / job.path, 0.0).failures == ()


@pytest.mark.parametrize(
    ("part", "export", "key", "mended"),
    [
        ({"cutter": {"number_of_teeth": 25}}, {}, "parts.wheel.cutter.number_of_teeth = 25", ({}, {})),
        ({"helix_angle_deg": 15.0}, {}, "parts.wheel.helix_angle_deg = 15", ({"helix_angle_deg": 0.0}, {})),
        ({}, {"rack_step": 1000.0}, "exports[1].rack_step = 1000", ({}, {"rack_step": None})),
        # a rack drawn as often as may be
        pytest.param({}, {"rack_step": 0.01}, "exports[1].rack_step = 0.01", ({}, {"rack_step": None}),
                     marks=pytest.mark.heavy),
    ],
)  # fmt: skip
def test_what_the_device_cannot_do_is_named(part: Any, export: Any, key: str, mended: Any) -> None:
    with pytest.raises(SceneError) as caught:
        plan_build(generating(gear(20, module=10.0, **part), **export), "t", [], [])
    assert key in str(caught.value)
    keys, more = mended
    # what is drawn is not looked at
    more = {"tolerance": 1e-2, **more}
    if "rack_step" in more:
        offered = caught.value.nearest
        assert offered
        more = {"rack_step": offered.value}
    assert plan_build(generating(gear(20, module=10.0, **keys), **more), "t", [], []).sheets


def test_the_least_step_of_the_rack_is_a_part_of_its_pitch() -> None:
    """As it is told, and a little less is refused: of 10 pi mm, 400 steps."""
    for step in (0.01, 10 * math.pi / 400 - 1e-6):
        with pytest.raises(SceneError) as caught:
            plan_build(generating(gear(20, module=10.0), rack_step=step), "t", [], [])
        offered = caught.value.nearest
        assert offered is not None
        assert offered.side == "at_least"
        assert isinstance(offered.value, float)
        assert 0 <= offered.value - 10 * math.pi / 400 < 1e-5


HELICAL: dict[str, tuple[dict[str, Any], dict[str, Any], str]] = {
    "external": (gear(20, hand="left"), gear(30), "external_gear_pair"),
    "internal": (gear(20), {**gear(70), "kind": "ring_gear"}, "internal_gear_pair"),
    "rack": (gear(20, hand="left"), {**gear(9), "kind": "rack"}, "rack_pair"),
}


@pytest.mark.sampled(1)
@pytest.mark.parametrize("language", ["en", "uk"])
@pytest.mark.parametrize("kind", HELICAL)
def test_a_helical_pair_shows_its_transverse_section_and_tells_normal_data(
    kind: str, language: str, tmp_path: Path
) -> None:
    first, second, mate = HELICAL[kind]
    helix = {"helix_angle_deg": 20.0, "face_width": 30.0}
    raw = {
        "scene": {"language": language},
        "parts": {"one": {**first, **helix, "profile_shift_coefficient": 0.2}, "two": {**second, **helix}},
        "mates": [{"kind": mate, "first": "one", "second": "two"}], "exports": [{"format": "sheet", "tolerance": 1e-3}],
    }  # fmt: skip
    for job in plan_build(scene_from_dict(raw, "t", "t"), "t", [], []).sheets:
        job.write({}, tmp_path / job.path)
        assert job.verify(tmp_path / job.path, 0.0).failures == ()
        words = [t.text.replace(",", ".") for t in job.canvas.texts]
        assert any(("торцевий переріз" if language == "uk" else "transverse section") in w for w in words)
        assert {"mn", "mt", "β", "xn1", "20.0000°", "0.2"} <= set(words)
        assert f"{2 / math.cos(math.radians(20)):.6g}" in words
        assert f"{30 * math.sin(math.radians(20)) / (2 * math.pi):.4f}" in words
