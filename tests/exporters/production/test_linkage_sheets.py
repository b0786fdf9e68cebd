"""Sheets of linkage cams: measured off the files against 40-digit poses, numbers of the calculation, damage noticed."""

from __future__ import annotations

import cmath
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
from exporters.production.plan import plan_build
from exporters.production.sheets import SheetJob
from parts.scene.load import scene_from_dict
from tests.exporters.documents.test_calc_cam_linkage import LINKS, MP, D, centre, lift, pose
from tests.parts.cams.coupler_cam.test_linkage_cam import ALL, FOUR

PHASES = [
    {"move": "rise", "angle_deg": 130.0, "law": "sine"},
    {"move": "dwell", "angle_deg": 50.0},
    {"move": "return_", "angle_deg": 130.0, "law": "polynomial_345"},
    {"move": "dwell", "angle_deg": 50.0},
]
TABLE = {k: v for k, v in FOUR.items() if k != "phases"} | {
    "swing_deg": 0.0, "motion_table": [[a, 12 - 12 * math.cos(math.radians(a))] for a in range(0, 360, 15)],
}  # fmt: skip
# the driven slider starts on the cam's axis
BESIDE = ALL["slider"] | {"driven": {"member": "slider", "start": [0.0, 0.0], "direction_deg": 70.0},
                          "coupler_point": [16.0, 39.0], "coupler_length": 52.0}  # fmt: skip
CASES: dict[str, dict[str, Any]] = {n: k | {"phases": PHASES} for n, k in ALL.items()} | {
    "table": TABLE, "beside": BESIDE,
}  # fmt: skip


def jobs(keys: dict[str, Any], language: str = "en", **export: Any) -> tuple[SheetJob, ...]:
    data = {
        "scene": {"language": language},
        "parts": {"cam": keys},
        "exports": [{"format": "sheet", "purpose": "cam", **export}],
    }
    return plan_build(scene_from_dict(data, "t", "t"), "t", [], []).sheets


@cache
def roller_job(language: str) -> SheetJob:
    return jobs(CASES["rocker"], language, **({} if language == "en" else {"tolerance": 1e-2}))[0]


@pytest.fixture(scope="module")
def roller_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("sheet") / "t.cam.cam.dxf"
    roller_job("en").write({}, file)
    return file


@pytest.mark.heavy
def test_both_languages_write_the_same_sheet_and_it_is_good(roller_file: Path, tmp_path: Path) -> None:
    verdict = roller_job("en").verify(roller_file, 0.0)
    assert verdict.failures == ()
    for key in ("max_deviation", "diagram_deviation", "line_deviation", "circle_deviation"):
        assert verdict.measured[key] <= 1.1e-6
    assert verdict.measured["lift_by_diagram"] == pytest.approx(24, abs=1e-6)
    texts = {language: [t.text for t in roller_job(language).canvas.texts] for language in ("en", "uk")}
    assert len(texts["en"]) == len(texts["uk"])
    assert not any(re.search("[а-яіїє]{4}", t) for t in texts["en"])
    assert any(t.startswith("No joint diagram") for t in texts["en"])
    assert any(t.startswith("Сумісної діаграми немає") for t in texts["uk"])
    assert any("роликовим штовхачем на шатуні" in t for t in texts["uk"])
    # a coarse one, twice
    files = [tmp_path / name for name in ("one.dxf", "twin.dxf")]
    for file in files:
        roller_job("uk").write({}, file)
    assert files[0].read_bytes() == files[1].read_bytes()


@pytest.mark.parametrize("name", ["flat", *(pytest.param(n, marks=pytest.mark.heavy) for n in CASES if n != "flat")])
def test_every_follower_and_linkage_has_its_sheet(name: str, tmp_path: Path) -> None:
    for job in jobs(CASES[name], intervals=2, tolerance=1e-2):
        job.write({}, tmp_path / job.path)
        assert job.verify(tmp_path / job.path, 0.0).failures == ()


def angles() -> list[float]:
    """The cam angles of the numbered positions, degrees: eight parts of each move, dwells whole."""
    return [16.25 * k for k in range(9)] + [180 + 16.25 * k for k in range(9)]


def test_rollers_and_linkages_stand_where_forty_digit_poses_are_turned_to(roller_file: Path) -> None:
    """With ezdxf alone: rollers at every position, at four of them the rocker, rod and guide with their lengths."""
    space = ezdxf.readfile(roller_file).modelspace()
    paper, case = roller_job("en").expected.paper, LINKS["roller"]
    middle = space.query('CIRCLE[layer=="CIRCLE_BASE"]').first.dxf.center
    rollers = [e.dxf for e in space.query('CIRCLE[layer=="ROLLER"]')]
    assert len(rollers) == 18
    for roller, degrees in zip(rollers, angles(), strict=True):
        t = MP.radians(MP.mpf(degrees))
        wanted = complex(centre(case, lift("roller", t)) * MP.expj(-t))
        assert complex(*(roller.center - middle).vec2) == pytest.approx(wanted * paper.scale, abs=1e-8)
        assert roller.radius == pytest.approx(6 * paper.scale)
    found = [(complex(*e.dxf.start.vec2), complex(*e.dxf.end.vec2)) for e in space.query('LINE[layer=="FOLLOWER"]')]
    off = complex(*middle.vec2)
    for number in (0, 6, 9, 15):
        t = MP.radians(MP.mpf(angles()[number]))
        joint, theta = pose(case.linkage, lift("roller", t))
        far = joint + 43 * MP.expj(theta)
        for start, end, length in ((91 + 26j, joint, 58), (joint, far, 43), (far, 62 + 124j, 68)):
            ends = [complex(p * MP.expj(-t)) * paper.scale + off for p in map(MP.mpc, (start, end))]
            assert abs(ends[1] - ends[0]) == pytest.approx(length * paper.scale)
            assert any(abs(a - ends[0]) + abs(b - ends[1]) < 3e-8 for a, b in found), (number, length)
    assert not any(abs(a - b) < 1e-6 for a, b in found)
    circles = sorted(e.dxf.radius / paper.scale for e in space.query('CIRCLE[layer=="CIRCLE_PIVOT"]'))
    assert circles == pytest.approx([abs(91 + 26j), abs(62 + 124j)])


@pytest.mark.parametrize("language", ["en", "uk"])
def test_the_table_of_positions_holds_the_calculations_numbers(language: str) -> None:
    texts = [t.text for t in roller_job(language).canvas.texts]
    words = [
        "kind=linkage_cam", "follower=roller", "follower_radius=6", "coupler_length=43", "coupler_point=[6,16]",
        "swing_deg=24", 'driven={member="rocker",pivot=[91,26],length=58,start_angle_deg=167}', "step=16.25",
        'guide={member="rocker",pivot=[62,124],length=68}',
        'phases=[{move="rise",angle_deg=130,law="sine"},{move="dwell",angle_deg=50},'
        '{move="return_",angle_deg=130,law="polynomial_345"},{move="dwell",angle_deg=50}]',
    ]  # fmt: skip
    data = json.loads(calculate("cam", words, "json", "en"))
    seen = 0
    for row, other in zip(data["positions"], data["linkage"], strict=True):
        if row["phi"] not in angles():
            continue
        values = (
            row["phi"],
            other["theta"],
            other["x_02"],
            other["y_02"],
            row["nu"],
            other["nu_c"],
            row["x"],
            row["y"],
        )
        cells = [f"{x:.2f}".replace(".", "," if language == "uk" else ".") for x in values]
        cells = ["0" + c[2:] if re.fullmatch("-0[.,]00", c) else c.replace("-", "\N{MINUS SIGN}") for c in cells]
        start = [str(angles().index(row["phi"])), *cells]
        assert any(texts[k : k + len(start)] == start for k in range(len(texts))), start
        seen += 1
    assert seen >= 10


def spoil_spline(space: Any, layer: str) -> None:
    spline = space.query(f'SPLINE[layer=="{layer}"]').first
    points = [list(p) for p in spline.control_points]
    points[len(points) // 2][1] += 1e-3
    spline.control_points = points


DAMAGE: dict[str, tuple[Callable[[Any], Any], str]] = {
    "link": (lambda s: s.query('LINE[layer=="FOLLOWER"]').first.translate(1e-4, 0, 0), "FOLLOWER: no line"),
    "rod": (lambda s: list(s.query('LINE[layer=="CONSTRUCTION"]'))[-1].translate(1e-4, 0, 0), "CONSTRUCTION: no line"),
    "roller": (lambda s: s.query('CIRCLE[layer=="ROLLER"]').first.translate(1e-4, 0, 0), "ROLLER: no circle"),
    "pivots": (lambda s: s.query('CIRCLE[layer=="CIRCLE_PIVOT"]').first.dxf.set("radius", 9.0), "CIRCLE_PIVOT: no"),
    "profile": (lambda s: spoil_spline(s, "CAM"), "outlines deviate"),
    "pitch curve": (lambda s: spoil_spline(s, "PITCH_CURVE"), "outlines deviate"),
    "S": (lambda s: spoil_spline(s, "DIAGRAM_LIFT"), "diagrams deviate"),
    "number": (lambda s: s.query('TEXT[text=="133.58"]').first.dxf.set("text", "133.59"), "133.58"),
}


@pytest.mark.sampled(1)
@pytest.mark.parametrize("damage", DAMAGE)
def test_damage_is_noticed(roller_file: Path, tmp_path: Path, damage: str) -> None:
    drawing = ezdxf.readfile(roller_file)
    spoil, wanted = DAMAGE[damage]
    spoil(drawing.modelspace())
    drawing.saveas(tmp_path / roller_file.name)
    failures = roller_job("en").verify(tmp_path / roller_file.name, 0.0).failures
    assert any(wanted in failure for failure in failures), failures


def test_a_slider_is_drawn_on_its_line(tmp_path: Path) -> None:
    """Four linkages with two sliders: a line and a rectangle each, the lines in their directions turned back."""
    job = jobs(CASES["slider"], intervals=4, tolerance=1e-2)[0]
    file = tmp_path / job.path
    job.write({}, file)
    lines = [(complex(*e.dxf.start.vec2), complex(*e.dxf.end.vec2))
             for e in ezdxf.readfile(file).modelspace().query('LINE[layer=="FOLLOWER"]')]  # fmt: skip
    guides = [b - a for a, b in lines if abs(abs(b - a) - 28) < 2e-8]
    assert len(guides) == 8
    turned = [D(x) for x in (0.0, 97.5, 180.0, 277.5)]
    wanted = [cmath.exp(1j * (D(way) - t)) for t in turned for way in (70, 10)]
    assert [g / abs(g) for g in guides] == pytest.approx(wanted, abs=1e-9)
    # the legend shows one more
    assert len(lines) == 4 * (3 + 2 * 5) + 1
    assert job.verify(file, 0.0).failures == ()


@pytest.mark.heavy
def test_rows_that_one_sheet_does_not_hold_stand_on_the_next() -> None:
    """Of as many intervals as there may be, each position has its row in both tables."""
    made = [job for job in jobs(CASES["rocker"], intervals=72, tolerance=1e-2) if job.path.endswith("dxf")]
    assert len(made) > 2
    texts = [[t.text for t in job.canvas.texts] for job in made]
    places = [start + 130 / 72 * k for start in (0, 180) for k in range(73)]
    for number, place in enumerate(places):
        row = [str(number), f"{place:.2f}"]
        assert sum(own[k : k + 2] == row for own in texts for k in range(len(own))) == 2, row


def test_the_title_block_and_a_speed_stand_on_the_sheet() -> None:
    """Nothing of the picture lies under the title block, whose numbers are those of the page."""
    job = jobs(CASES["rocker"], intervals=2, speed_rpm=60.0, title_block={"designation": "TMM.05"}, tolerance=1e-2)[0]
    texts = [t.text for t in job.canvas.texts]
    at = texts.index("μt")
    assert float(texts[at + 1].split()[0]) == pytest.approx(math.radians(2) / (2 * math.pi), rel=1e-4)
    assert texts.count("TMM.05") >= 1
    right, low = job.canvas.frame.right, job.canvas.frame.low
    for stroke in job.canvas.strokes:
        if stroke.layer not in ("FRAME", "TABLE"):
            points = stroke.curve.point(np.linspace(*stroke.curve.domain, 65))
            under = (points.real > right - 185) & (points.imag < low + 55)
            assert not under.any(), stroke.layer
