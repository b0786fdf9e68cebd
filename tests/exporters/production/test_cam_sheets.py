"""Sheets of cams: numbers equal the calculation's, measured off the files with dividers, damage noticed."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest

from exporters.documents.topics import calculate
from exporters.production.build import build
from exporters.production.plan import Plan, plan_build
from exporters.production.sheets import SheetJob
from geometry.base.errors import Nearest
from parts.base.refusal import SceneError
from parts.drawing.canvas import standard_scale
from parts.scene.load import load_scene, scene_from_dict
from parts.scene.scene_file import SceneFile
from tests.exporters.making import run
from tests.sampling import some_of

CASES = {
    c["id"]: c
    for c in json.loads((Path(__file__).parents[2] / "published" / "cams.json").read_text(encoding="utf-8"))["cases"]
}
SCENES = {"practicum_flat_cam": "en", "practicum_roller_cam": "en", "guidelines_cam": "uk"}
RISE_AND_RETURN = [
    {"move": "rise", "angle_deg": 120.0, "law": "polynomial_345"},
    {"move": "dwell", "angle_deg": 30.0},
    {"move": "return_", "angle_deg": 120.0, "law": "cosine"},
    {"move": "dwell", "angle_deg": 90.0},
]
ROCKER = {
    "kind": "cam", "follower": "roller", "swing_deg": 20.0, "follower_radius": 6.0, "base_circle_radius": 40.0,
    "phases": RISE_AND_RETURN, "oscillating": {"centre_distance": 90.0, "arm_length": 80.0},
    "least_transmission_angle_deg": 45.0,
}  # fmt: skip
# where the picture is not measured, few positions and rough curves
ROUGH = {"intervals": 2, "tolerance": 1e-3}


@cache
def plan_of(name: str) -> Plan:
    return plan_build(load_scene(name), name, [], ["sheet"])


def job_of(name: str, ending: str) -> SheetJob:
    return next(j for j in plan_of(name).sheets if j.path.endswith(ending))


def words_of(job: SheetJob) -> list[str]:
    return sorted(run.text for text in job.canvas.texts for run in text.runs)


def cam_scene(part: dict[str, Any], **export: Any) -> Any:
    return scene_from_dict(
        {"parts": {"rocker": part}, "exports": [{"format": "sheet", "purpose": "cam", **export}]}, "t", "t"
    )


@pytest.mark.heavy
@pytest.mark.parametrize(("name", "language"), SCENES.items())
def test_every_sheet_is_good(tmp_path: Path, name: str, language: str) -> None:
    words = {}
    for job in plan_of(name).sheets:
        assert job.path in (f"{name}.cam.cam.dxf", f"{name}.cam.cam.svg")
        job.write({}, tmp_path / job.path)
        verdict = job.verify(tmp_path / job.path, 0.0)
        assert verdict.failures == ()
        for key in ("max_deviation", "diagram_deviation", "line_deviation", "circle_deviation"):
            assert verdict.measured[key] <= 1.1e-6
        words[job.path[-3:]] = words_of(job)
        assert job.canvas.paper == "A2"
        twin = tmp_path / f"twin.{job.path[-3:]}"
        job.write({}, twin)
        assert twin.read_bytes() == (tmp_path / job.path).read_bytes()
    assert words["dxf"] == words["svg"]
    assert any(re.search("[а-яіїє]{4}", word) for word in words["dxf"]) == (language == "uk")


def test_the_sizes_of_the_lessons_are_measured_off_the_sheets(tmp_path: Path) -> None:
    lessons = (
        ("practicum_flat_cam", 38, "000.p4.r0.sine_acceleration", "r0_mm"),
        ("practicum_roller_cam", 30, "000.p5.r0.3-4-5_polynomial", "r0_offset_helps_mm"),
    )
    for name, lift, case, key in some_of(lessons):
        wanted = next(c["recomputed"][key] for i, c in CASES.items() if i.startswith(case))
        job = job_of(name, "svg")
        job.write({}, tmp_path / job.path)
        measured = job.verify(tmp_path / job.path, 0.0).measured
        assert measured["lift_by_diagram"] == pytest.approx(lift, abs=1e-6)
        assert measured["least_radius_by_diagram"] == pytest.approx(wanted, abs=1e-6)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", SCENES)
def test_numbers_on_the_sheet_are_those_of_the_calculation(name: str) -> None:
    language = SCENES[name]
    data = json.loads(calculate("cam", [name], "json", language))
    texts = [t.text for t in job_of(name, "dxf").canvas.texts]

    def said(value: float, digits: int) -> str:
        text = f"{value:.{digits}f}"
        text = text.lstrip("-") if float(text) == 0 else text.replace("-", "\N{MINUS SIGN}")
        return text.replace(".", ",") if language == "uk" else text

    values = data["values"]
    for key in ("graphical_prime_circle_radius", "graphical_radius_error"):
        number = said(values[key], 5).rstrip("0").rstrip(".,")
        assert any(t.startswith(number) for t in texts), key
    # what is the least is told rounded up, so that it works as it is typed
    numbers = [float(found[0].replace(",", ".")) for t in texts if (found := re.match(r"\d+[.,]?\d*", t))]
    for key in ("least_prime_circle_radius", "least_base_circle_radius"):
        assert any(-1e-9 <= number - values[key] < 1e-4 for number in numbers), key
    assert len(data["graphical"]) == 18
    # the table stands row by row, its cells in order
    rows = []
    for row in data["graphical"]:
        phi, bend, rate, exact_rate = (row[k] for k in ("phi", "S''g", "S'g", "S'"))
        cells = [said(x, 2) for x in (phi, bend, rate, exact_rate)]
        cells += [said(rate - exact_rate, 3), said(row["Sg"], 2), said(row["S"], 2), said(row["Sg"] - row["S"], 3)]
        rows += [f"{row['n']:.0f}", *cells]
    start = next(k for k in range(len(texts)) if texts[k : k + len(rows)] == rows)
    # above it the heads, and the unit of each
    bend, rate, lift = ("мм/рад²", "мм/рад", "мм") if language == "uk" else ("mm/rad²", "mm/rad", "mm")
    assert texts[start - 8 : start] == ["°", bend, *[rate] * 3, *[lift] * 3]
    assert texts[start - 17] == "№"


@pytest.mark.heavy
def test_a_table_that_goes_on_has_its_heads_and_units_there_too() -> None:
    jobs = plan_build(cam_scene(ROCKER, paper="A4", intervals=40, tolerance=1e-2), "t", [], []).sheets
    told = [[text.text for text in job.canvas.texts] for job in jobs]
    tables = [texts for texts in told if any("by the drawing" in text for text in texts)]
    assert len(tables) > 1
    for texts in tables:
        start = texts.index("№")
        assert texts[start + 1 : start + 4 : 2] == ["φ", "ψ'g"]
        assert texts[start + 9 : start + 13] == ["°", "°/rad²", "°/rad", "°/rad"]


def test_both_views_of_the_roller_cam_tell_the_same_motion(tmp_path: Path) -> None:
    """With ezdxf alone: S of the diagram, the rollers of the inversion and H (10 u^3 - 15 u^4 + 6 u^5) agree."""
    job = job_of("practicum_roller_cam", "dxf")
    job.write({}, tmp_path / job.path)
    space = ezdxf.readfile(tmp_path / job.path).modelspace()
    base = space.query('CIRCLE[layer=="CIRCLE_BASE"]').first.dxf
    prime = space.query('CIRCLE[layer=="CIRCLE_PRIME"]').first.dxf
    rollers = [e.dxf for e in space.query('CIRCLE[layer=="ROLLER"]')]
    assert len(rollers) == 18
    assert {round(r.radius, 9) for r in rollers} == {8.0}
    assert prime.radius - base.radius == pytest.approx(8.0, abs=2e-8)
    start = math.sqrt(prime.radius**2 - 3.0**2)
    ways = [math.sqrt(r.center.distance(base.center) ** 2 - 3.0**2) - start for r in rollers]
    share = [k / 8 for k in range(9)]
    law = [30 * (10 * u**3 - 15 * u**4 + 6 * u**5) for u in share]
    assert ways == pytest.approx([*law, *law[::-1]], abs=3e-8)
    # the lowest diagram's ordinates, from the left; those of height 0 are no lines
    ordinates = sorted((e.dxf for e in space.query('LINE[layer=="ORDINATE"]')), key=lambda e: e.start.x)
    low = min(e.start.y for e in ordinates)
    heights = [e.end.y - e.start.y for e in ordinates if abs(e.start.y - low) < 1e-9]
    assert [0.4 * y for y in heights] == pytest.approx([*law[1:], *law[::-1][:-1]], abs=1e-8)
    # each follower stands at its angle, turned against the cam
    angles = [16.25 * k for k in range(9)] + [180 + 16.25 * k for k in range(9)]
    for roller, angle, way in zip(rollers, angles, ways, strict=True):
        place = complex(*(roller.center - base.center).vec2)
        place *= complex(math.cos(math.radians(angle)), math.sin(math.radians(angle)))
        assert place == pytest.approx(complex(3.0, start + way), abs=1e-8)


def test_scales_are_round_and_tied_by_the_lessons_formulas() -> None:
    texts = [t.text for t in job_of("practicum_roller_cam", "dxf").canvas.texts]

    def after(symbol: str) -> str:
        return texts[texts.index(symbol) + 1]

    lift, rate, bend = (float(after(f"μS{k * chr(39)}").split()[0]) for k in range(3))
    phi = math.radians(2.0)
    assert after("μφ").startswith(f"{phi:.6f} rad/mm")
    assert float(after("H1").split()[0]) == pytest.approx(lift / (rate * phi), abs=5e-4)  # (4.3)
    assert float(after("H2").split()[0]) == pytest.approx(rate / (bend * phi), abs=5e-4)  # (4.4)
    for needed, wanted in ((0.39, 0.4), (0.4, 0.4), (0.41, 0.5), (2.1, 2.5), (51.0, 100.0), (1.0, 1.0), (3e-7, 4e-7)):
        assert standard_scale(needed) == pytest.approx(wanted, rel=1e-12)


def on_layer(space: Any, kind: str, layer: str) -> Any:
    return space.query(f'{kind}[layer=="{layer}"]').first


def bend_spline(space: Any, layer: str) -> None:
    spline = on_layer(space, "SPLINE", layer)
    points = [list(p) for p in spline.control_points]
    points[len(points) // 2][1] += 1e-3
    spline.control_points = points


def last(space: Any, kind: str, layer: str) -> Any:
    return list(space.query(f'{kind}[layer=="{layer}"]'))[-1]


DAMAGE: dict[str, tuple[Callable[[Any], Any], str]] = {
    "S''": (lambda s: bend_spline(s, "DIAGRAM_BEND"), "diagrams deviate"),
    "S'": (lambda s: bend_spline(s, "DIAGRAM_RATE"), "diagrams deviate"),
    "S": (lambda s: bend_spline(s, "DIAGRAM_LIFT"), "diagrams deviate"),
    "S lost": (lambda s: s.delete_entity(on_layer(s, "SPLINE", "DIAGRAM_LIFT")), "no line from"),
    "joint diagram": (lambda s: bend_spline(s, "JOINT_DIAGRAM"), "diagrams deviate"),
    "joint diagram lost": (lambda s: s.delete_entity(on_layer(s, "SPLINE", "JOINT_DIAGRAM")), "diagrams deviate"),
    "first tangent": (lambda s: on_layer(s, "LINE", "GAMMA_TANGENT").translate(0, 1e-4, 0), "least radius"),
    "tangents": (lambda s: [s.delete_entity(e) for e in s.query('LINE[layer=="GAMMA_TANGENT"]')], "are missing"),
    "line of the offset": (lambda s: on_layer(s, "LINE", "OFFSET_AXIS").translate(1e-4, 0, 0), "OFFSET_AXIS: no line"),
    "first ordinate": (lambda s: on_layer(s, "LINE", "ORDINATE").translate(0, 1e-4, 0), "ORDINATE: no line"),
    "broken line": (lambda s: on_layer(s, "LINE", "GRAPHICAL").translate(0, 1e-4, 0), "GRAPHICAL: no line"),
    "first roller": (lambda s: on_layer(s, "CIRCLE", "ROLLER").translate(1e-4, 0, 0), "ROLLER: no circle"),
    "last roller": (lambda s: last(s, "CIRCLE", "ROLLER").dxf.set("radius", 8.001), "ROLLER: no circle"),
    "base circle": (lambda s: on_layer(s, "CIRCLE", "CIRCLE_BASE").dxf.set("radius", 17.0), "CIRCLE_BASE: no circle"),
    "profile": (lambda s: bend_spline(s, "CAM"), "outlines deviate"),
    "pitch curve": (lambda s: bend_spline(s, "PITCH_CURVE"), "outlines deviate"),
    "line of motion": (lambda s: last(s, "LINE", "CONSTRUCTION").translate(1e-4, 0, 0), "CONSTRUCTION: no line"),
    "number": (lambda s: s.query('TEXT[text=="25.17668 mm"]').first.dxf.set("text", "25.17669 mm"), "25.17668"),
    "position": (lambda s: s.delete_entity(s.query('TEXT[text=="13"]').first), "words are missing: 13"),
}


@cache
def written(folder: Path) -> Path:
    job = job_of("practicum_roller_cam", "dxf")
    file = folder / job.path
    job.write({}, file)
    return file


@pytest.fixture(scope="module")
def sheet_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return written(tmp_path_factory.mktemp("sheet"))


@pytest.mark.sampled(1)
@pytest.mark.parametrize("damage", DAMAGE)
def test_damage_is_noticed(sheet_file: Path, tmp_path: Path, damage: str) -> None:
    drawing = ezdxf.readfile(sheet_file)
    spoil, wanted = DAMAGE[damage]
    spoil(drawing.modelspace())
    drawing.saveas(tmp_path / sheet_file.name)
    failures = job_of("practicum_roller_cam", "dxf").verify(tmp_path / sheet_file.name, 0.0).failures
    assert any(wanted in failure for failure in failures), failures


def test_a_rocker_has_its_pivots_arms_and_axis(tmp_path: Path) -> None:
    """The pivots stand on their circle, the arms keep their length, both cams' axes in the joint diagram."""
    jobs = plan_build(cam_scene(ROCKER, intervals=3, tolerance=1e-3), "t", [], []).sheets
    assert [j.path for j in jobs] == ["t.cam.rocker.dxf", "t.cam.rocker.svg"]
    jobs[0].write({}, tmp_path / jobs[0].path)
    assert jobs[0].verify(tmp_path / jobs[0].path, 0.0).failures == ()
    space = ezdxf.readfile(tmp_path / jobs[0].path).modelspace()
    pivots = on_layer(space, "CIRCLE", "CIRCLE_PIVOT").dxf
    scale = jobs[0].expected.paper.scale
    assert pivots.radius == pytest.approx(90 * scale)
    arms = list(space.query('LINE[layer=="FOLLOWER"]'))
    assert len(arms) == 8
    for arm in arms:
        ends = arm.dxf.start, arm.dxf.end
        assert ends[0].distance(ends[1]) == pytest.approx(80 * scale, abs=2e-8)
        assert min(abs(e.distance(pivots.center) - pivots.radius) for e in ends) < 3e-8
    assert list(space.query('LINE[layer=="GAMMA_TANGENT"]'))
    texts = words_of(jobs[0])
    assert "C" in texts
    assert "7" in texts


def test_a_given_speed_adds_scales_of_time() -> None:
    """The same diagrams are S(t), v(t), a(t) with mu_phi / omega, mu_S' omega and mu_S'' omega^2."""
    part = {"kind": "cam", "follower": "flat", "lift": 0.3, "phases": RISE_AND_RETURN,
            "least_transmission_angle_deg": 45.0, "least_curvature_radius": 1.0}  # fmt: skip
    texts = [t.text for t in plan_build(cam_scene(part, speed_rpm=600.0, **ROUGH), "t", [], []).sheets[0].canvas.texts]

    def after(symbol: str) -> float:
        return float(texts[texts.index(symbol) + 1].split()[0])

    omega = 20 * math.pi
    assert after("μt") == pytest.approx(math.radians(2) / omega, rel=1e-5)
    assert after("μv") == pytest.approx(after("μS'") * omega, rel=1e-5)
    assert after("μa") == pytest.approx(after("μS''") * omega**2 / 1000, rel=1e-5)


def test_the_angle_of_the_return_has_its_tangents() -> None:
    """They touch the diagram where S' is least, by dense samples of the cosine, and bound where the axis stands."""
    part = {"kind": "cam", "follower": "roller", "follower_radius": 5.0, "lift": 20.0, "phases": RISE_AND_RETURN,
            "least_transmission_angle_deg": 80.0, "least_return_transmission_angle_deg": 70.0}  # fmt: skip
    canvas = plan_build(cam_scene(part, **ROUGH), "t", [], []).sheets[0].canvas
    u = np.linspace(0, 1, 20_001)
    fall = 10 * (1 + np.cos(np.pi * u)), -10 * np.pi * np.sin(np.pi * u) / math.radians(120)
    up = 20 * (10 * u**3 - 15 * u**4 + 6 * u**5), 600 * u**2 * (1 - u) ** 2 / math.radians(120)
    least = max(
        float((np.abs(v) * math.tan(math.radians(gamma)) - s).max()) for (s, v), gamma in ((up, 80), (fall, 70))
    )
    texts = [t.text for t in canvas.texts]
    assert "γ'min = 70°" in texts
    assert f"r0 = {least:.2f}" in texts
    rocker = plan_build(cam_scene(ROCKER | {"least_return_transmission_angle_deg": 0.0}, **ROUGH), "t", [], [])
    assert not any("γ'" in t.text for t in rocker.sheets[0].canvas.texts)


LEGAL: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "points of a table": ({"motion_table": [[a, 10 - 10 * math.cos(math.radians(a))] for a in range(0, 360, 30)],
                           "follower": "roller", "follower_radius": 6.0, "base_circle_radius": 40.0}, {}),
    "no dwell": ({"phases": [{"move": m, "angle_deg": 180.0, "law": "cosine"} for m in ("rise", "return_")],
                  "follower": "pointed", "lift": 20.0, "base_circle_radius": 40.0, "follower_offset": -9.0}, {}),
    "few": ({"phases": RISE_AND_RETURN, "follower": "flat", "lift": 0.3, "least_transmission_angle_deg": 45.0,
             "least_curvature_radius": 1.0}, {"intervals": 2}),
    "large": ({"phases": RISE_AND_RETURN, "follower": "mushroom", "lift": 3000.0, "follower_radius": 900.0,
               "base_circle_radius": 9000.0}, {}),
    "flat rocker": ({"phases": RISE_AND_RETURN, "follower": "flat", "swing_deg": 10.0, "base_circle_radius": 40.0,
                     "oscillating": {"centre_distance": 100.0, "face_offset": 3.0}}, {}),
}  # fmt: skip


@pytest.mark.heavy
def test_tables_go_on_where_one_sheet_does_not_hold_them(tmp_path: Path) -> None:
    """72 intervals have their rows, each once, on several sheets, whose numbers the title tells."""
    jobs = plan_build(cam_scene(ROCKER, intervals=72), "t", [], []).sheets
    assert [j.path for j in jobs[::2]] == [f"t.cam.rocker.{k}.dxf" for k in range(1, len(jobs) // 2 + 1)]
    for job in jobs[1::2]:
        job.write({}, tmp_path / job.path)
        assert job.verify(tmp_path / job.path, 0.0).failures == ()
    assert any(t.text.endswith(f"(2/{len(jobs) // 2})") for t in jobs[2].canvas.texts)
    starts = [t for job in jobs[4::2] for t in words_of(job) if re.fullmatch(r"\d{1,3}", t)]
    assert starts.count("77") == starts.count("145") == 1


@pytest.mark.heavy
@pytest.mark.parametrize("name", LEGAL)
def test_unusual_but_legal_cams_have_their_sheet(tmp_path: Path, name: str) -> None:
    part, export = LEGAL[name]
    for job in plan_build(cam_scene({"kind": "cam", **part}, **export), "t", [], []).sheets:
        job.write({}, tmp_path / job.path)
        assert job.verify(tmp_path / job.path, 0.0).failures == ()


def test_every_spline_of_a_table_of_many_rows_is_held_against_its_part_of_the_outline(tmp_path: Path) -> None:
    """36 rows are two exact curves, drawn as a spline between each two rows: pairs were taken in the order of both."""
    rows = [[a, 6 - 6 * math.cos(math.radians(a))] for a in range(0, 360, 10)]
    roller = {"kind": "cam", "follower": "roller", "follower_radius": 8.0, "base_circle_radius": 25.0}
    part = roller | {"motion_table": rows}
    for job in plan_build(cam_scene(part), "t", [], []).sheets:
        job.write({}, tmp_path / job.path)
        assert job.verify(tmp_path / job.path, 0.0).failures == ()
        assert all(len(job.expected.curves[layer]) > 30 for layer in ("CAM", "PITCH_CURVE"))


def test_a_table_of_points_has_a_sheet_without_the_graphical_method() -> None:
    part = {"kind": "cam", "follower": "pointed", "base_circle_radius": 60.0,
            "motion_table": [[0, 0], [120, 5], [240, 3]]}  # fmt: skip
    job = plan_build(cam_scene(part, **ROUGH), "t", [], []).sheets[0]
    assert not any("by the drawing" in t.text for t in job.canvas.texts)
    with pytest.raises(AssertionError):
        assert not any("by the drawing" in t.text for t in job_of("practicum_flat_cam", "dxf").canvas.texts)


def test_a_follower_that_begins_with_its_return_stands_far_at_0() -> None:
    """20 mm below the base circle of 30 mm it is near, at 0 far; the least radius of the cam is 10 mm."""
    phases = [("return_", 100.0), ("dwell", 60.0), ("rise", 120.0), ("dwell", 80.0)]
    table = [{"move": m, "angle_deg": a} | ({} if m == "dwell" else {"law": "sine"}) for m, a in phases]
    part = {"kind": "cam", "follower": "roller", "lift": 20.0, "follower_radius": 8.0, "base_circle_radius": 30.0}
    jobs = plan_build(cam_scene(part | {"phases": table}, **ROUGH), "r", [], []).sheets
    texts = [t.text for job in jobs if job.path.endswith("dxf") for t in job.canvas.texts]
    assert [t for t in texts if re.match("φ(near|far).* =", t)] == ["φnear = 60°", "φfar = 80°"]
    assert [t for t in texts if re.match("R.* =", t)] == ["Rb = 30.00"]
    typed = "[" + ",".join("{" + ",".join(f"{k}={json.dumps(v)}" for k, v in row.items()) + "}" for row in table) + "]"
    keys = [f"{k}={v}" for k, v in part.items() if k != "kind"]
    values = json.loads(calculate("cam", [*keys, f"phases={typed}"], "json", "en"))["values"]
    assert (values["near_dwell_angle_deg"], values["far_dwell_angle_deg"]) == (60.0, 80.0)
    assert (values["base_circle_radius"], values["least_cam_radius"]) == (30.0, pytest.approx(10.0))


def test_numbers_of_an_axis_have_the_digits_of_their_step() -> None:
    """A lift of 12 mm is told every 2.5 mm; rounded to whole ones that would be 2, 5, 8, 10."""
    scene = cam_scene({"kind": "cam", "follower": "roller", "lift": 12.0, "follower_radius": 6.0,
                       "base_circle_radius": 40.0, "phases": RISE_AND_RETURN}, tolerance=1e-3)  # fmt: skip
    texts = words_of(plan_build(scene, "t", [], ["sheet"]).sheets[0])
    assert {"2.5", "5.0", "7.5", "10.0"} <= set(texts)
    # positions and their rows are numbered too: 8 no more often than 14, which is on no axis
    assert texts.count("8") == texts.count("14")


def test_refusals_name_the_key_and_what_works() -> None:
    def told(scene: SceneFile) -> tuple[str, str, Nearest | None]:
        with pytest.raises(SceneError) as caught:
            plan_build(scene, "t", [], [])
        return caught.value.key, caught.value.code, caught.value.nearest

    asked: tuple[tuple[str, str, dict[str, Any]], ...] = (
        ("paper", "paper_too_small_for_scale", {"paper": "A4", "scale": "2.5:1"}),
        ("scale", "fits_no_paper_so_large", {"scale": "50:1"}),
    )
    for wrong, reason, keys in some_of(asked):
        key, code, nearest = told(cam_scene(ROCKER, **keys, **ROUGH))
        assert (key, code) == (f"exports[1].{wrong}", reason)
        assert nearest is not None
        assert (nearest.side == "at_least") == (wrong == "paper")
        assert plan_build(cam_scene(ROCKER, **{**keys, wrong: nearest.value}, **ROUGH), "t", [], []).sheets
    scene = cam_scene(ROCKER, **ROUGH)
    assert [j.path for j in plan_build(scene, "t", ["rocker"], []).sheets] == ["t.cam.rocker.dxf", "t.cam.rocker.svg"]
    scene.exports[0].purpose = "meshing"
    assert told(scene) == ("exports[1].purpose", "shows_gear_pairs", Nearest("cam"))
    gear = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20}
    assert told(cam_scene(gear)) == ("exports[1].purpose", "draws_only_what_is_not_here", None)
    assert told(cam_scene(gear, parts=["rocker"])) == ("exports[1].parts", "draws_only_what_is_not_here", None)
    with pytest.raises(SceneError, match="intervals"):
        cam_scene(ROCKER, intervals=1)
    for key in ("intervals", "speed_rpm"):
        with pytest.raises(SceneError, match='only for purpose = "cam"'):
            cam_scene(ROCKER, purpose="generating", **{key: 8})
    with pytest.raises(SceneError, match="show the part and not the cut"):
        cam_scene(ROCKER, kerf=0.1)


@pytest.mark.heavy
def test_a_build_reports_its_cam_sheets_and_verify_measures_them_again(tmp_path: Path) -> None:
    folder = tmp_path / "guidelines_cam"
    made = build(plan_of("guidelines_cam"), folder).written
    assert [item.failures for item in made] == [(), ()]
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    entries = {e["path"]: e for e in report["files"]}
    assert set(entries) == {"guidelines_cam.cam.cam.dxf", "guidelines_cam.cam.cam.svg"}
    assert all(e["verified"] and e["paper"] == "A2" and e["purpose"] == "cam" for e in entries.values())
    file = folder / "guidelines_cam.cam.cam.svg"
    assert run("verify", str(file)) == 0
    file.write_text(file.read_text(encoding="utf-8").replace("45,81467", "45,81468"), encoding="utf-8")
    assert run("verify", str(file)) == 1


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("part", "given"),
    [
        (
            {**ROCKER, "oscillating": None, "swing_deg": None, "lift": 30.0, "follower_offset": 3.0},
            ["E = 3.00", "γmin= 45°", "φrise= 120°", "Rmin= 40.00"],
        ),
        (ROCKER, ["d = 90.00", "γmin= 45°", "φrise= 120°", "Rmin= 40.00"]),
        (
            {**ROCKER, "follower": "flat", "follower_radius": None, "least_curvature_radius": 5.0,
             "least_transmission_angle_deg": None},
            ["d = 90.00", "Rmin= 40.00"],
        ),
    ],
)  # fmt: skip
def test_what_is_given_stays_and_what_is_found_is_empty_on_every_sheet(part: dict[str, Any], given: list[str]) -> None:
    kept = {key: value for key, value in part.items() if value is not None}
    plan = plan_build(cam_scene(kept, cells="empty", **ROUGH), "t", [], [])
    texts = ["".join(run.text for run in t.runs) for job in plan.sheets if job.path.endswith("svg")
             for t in job.canvas.texts]  # fmt: skip
    assert not set(given) - set(texts)
    # its row in the table
    assert "Rmin" in texts
    # no other size in the pictures has a value; names of rows may end in S = 0
    sizes = {text.partition("=")[0].strip() for text in texts if re.match(r"\S+ ?= -?\d", text)}
    assert all(name.startswith("φ") for name in sizes - {text.partition("=")[0].strip() for text in given})


@pytest.mark.sampled(1)
@pytest.mark.parametrize("flat", [False, True])
def test_the_joint_diagram_of_a_rocker_is_drawn_by_hand_on_squared_paper(flat: bool) -> None:
    """Students had a bare line from the cam's axis to the pivot; on A3 the diagrams stand on a sheet of their own."""
    other = {"follower": "flat", "follower_radius": None, "least_curvature_radius": 5.0,
             "least_transmission_angle_deg": None}  # fmt: skip
    part = {key: value for key, value in (ROCKER | (other if flat else {})).items() if value is not None}
    plan = plan_build(cam_scene(part, cells="empty", **(ROUGH | {"paper": "A3"})), "t", [], [])
    pages = [job.canvas for job in plan.sheets if job.path.endswith("svg")]
    page = next(one for one in pages if {"O", "C"} <= {text.text for text in one.texts})
    assert not any(text.text.startswith("φ") for text in page.texts)
    squares = [s.curve for s in page.strokes if s.layer == "ORDINATE"]
    pivot = next(s.curve.end for s in page.strokes if s.layer == "AXIS")
    for way in (1, 1j):
        across = [(c.start / way).real for c in squares if abs(((c.end - c.start) / way).real) < 1e-9]
        assert len(across) > 5
        assert min(across) < (pivot / way).real < max(across)
