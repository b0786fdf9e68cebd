"""Drawings of all parts of all scenes: no word over a word or a line, no leader over another, no size on a line."""

from __future__ import annotations

import cmath
import math
from collections import Counter
from pathlib import Path
from typing import Any, Literal

import ezdxf
import msgspec
import pytest

from exporters.drawings.write import write_sheet_svg
from exporters.production.plan import plan_build
from parts.base.refusal import SceneError
from parts.base.registry import KINDS
from parts.scene.files import built_in_scenes
from parts.scene.load import load_scene, scene_from_dict
from parts.scene.scene_file import ExportSpec
from tests.exporters.production.test_part_drawings import PARTS, jobs
from tests.exporters.production.test_sheet_words import faults

# scenes of a third of a second, at which all tests look
LIGHT = ("idler_train", "laser_gear", "lesson_1", "worm")
Line = tuple[complex, complex]
# arrows are fans of lines of 3 mm; what only touches, mm
ARROW, TOUCH = 3.0, 0.3


def lines_of(entities: Any) -> list[Line]:
    """Straight lines without those of arrows."""
    found = [(complex(*e.dxf.start.vec2), complex(*e.dxf.end.vec2)) for e in entities]
    tips = Counter(_place(a) for a, b in found if abs(abs(b - a) - ARROW) < 0.06)
    return [(a, b) for a, b in found if abs(abs(b - a) - ARROW) >= 0.06 or tips[_place(a)] < 4]


def _place(point: complex) -> tuple[float, float]:
    return round(point.real, 5), round(point.imag, 5)


def crosses(one: Line, two: Line) -> bool:
    """Whether two lines cross within both."""
    (a, b), (c, d) = one, two
    turn = ((b - a).conjugate() * (d - c)).imag
    if abs(turn) < 1e-9:
        return False
    s, t = ((c - a).conjugate() * (d - c)).imag / turn, ((c - a).conjugate() * (b - a)).imag / turn
    ends = TOUCH / abs(b - a), TOUCH / abs(d - c)
    return ends[0] < s < 1 - ends[0] and ends[1] < t < 1 - ends[1]


def lies_on(one: Line, two: Line) -> bool:
    """Whether a line lies on another for more than half a millimetre."""
    (a, b), (c, d) = one, two
    way = (b - a) / abs(b - a)
    if abs((way.conjugate() * (d - c)).imag) > 1e-6 or abs((way.conjugate() * (c - a)).imag) > 0.1:
        return False
    low, high = sorted(((p - a) * way.conjugate()).real for p in (c, d))
    return min(high, abs(b - a)) - max(low, 0.0) > 0.5


def size_line(document: Any, one: Any) -> Line:
    """The dimension line of a size: the longest one along it."""
    way = cmath.rect(1.0, math.radians(one.dxf.angle))
    rows = lines_of(document.blocks.get(one.dxf.geometry).query("LINE"))
    along = [r for r in rows if abs((way.conjugate() * (r[1] - r[0])).imag) < 1e-6 * abs(r[1] - r[0])]
    return max(along, key=lambda r: abs(r[1] - r[0]))


def tangles(file: Path) -> list[str]:
    """Leaders over leaders; dimension lines on dimension lines and on outlines."""
    document = ezdxf.readfile(file)
    space = document.modelspace()
    sizes: list[Line] = []
    leaders: list[tuple[int, Line]] = []
    for number, one in enumerate(space.query("DIMENSION")):
        if one.dxf.angle % 90:
            leaders += [(number, row) for row in lines_of(document.blocks.get(one.dxf.geometry).query("LINE"))]
        else:
            sizes.append(size_line(document, one))
    loose = lines_of(space.query("LINE[layer=='DIMENSION']"))
    leaders += [
        (-1 - k, row) for k, row in enumerate(loose) if row[0].real != row[1].real and row[0].imag != row[1].imag
    ]
    dots = [complex(*e.dxf.center.vec2) for e in space.query("CIRCLE[layer=='THIN']") if abs(e.dxf.radius - 0.5) < 1e-6]
    thin = lines_of(space.query("LINE[layer=='THIN']"))
    leaders += [(10**6 + k, row) for k, row in enumerate(thin) if any(abs(row[0] - dot) < 1e-5 for dot in dots)]
    edges = lines_of(space.query("LINE[layer=='OUTLINE']"))
    found = [f"leaders cross near {a[0]:.0f}" for k, (m, a) in enumerate(leaders) for n, b in leaders[:k]
             if m != n and crosses(a, b)]  # fmt: skip
    found += [
        f"a size lies on another near {a[0]:.0f}" for k, a in enumerate(sizes) for b in sizes[:k] if lies_on(a, b)
    ]
    return found + [f"a size lies on an edge near {a[0]:.0f}" for a in sizes for b in edges if lies_on(a, b)]


def run_over(file: Path) -> int:
    """How many dimension lines the leaders of an assembly's numbers cross, or those of a part."""
    document = ezdxf.readfile(file)
    space = document.modelspace()
    sizes = [size_line(document, one) for one in space.query("DIMENSION") if not one.dxf.angle % 90]
    dots = [complex(*e.dxf.center.vec2) for e in space.query("CIRCLE[layer=='THIN']") if abs(e.dxf.radius - 0.5) < 1e-6]
    thin = lines_of(space.query("LINE[layer=='THIN']"))
    leaders = [row for row in thin if any(abs(row[0] - dot) < 1e-5 for dot in dots)]
    loose = lines_of(space.query("LINE[layer=='DIMENSION']"))
    leaders += [row for row in loose if row[0].real != row[1].real and row[0].imag != row[1].imag]
    assert leaders
    return sum(crosses(leader, size) for leader in leaders for size in sizes)


def _cases() -> list[Any]:
    rest = sorted({*built_in_scenes()} - {*LIGHT})
    return [*LIGHT, *(pytest.param(name, marks=pytest.mark.heavy) for name in rest)]


@pytest.mark.sampled(1)
@pytest.mark.parametrize("language", ["en", "uk"])
@pytest.mark.parametrize("purpose", ["part", "assembly"])
@pytest.mark.parametrize("name", _cases())
def test_no_word_and_no_line_of_a_drawing_stands_over_another(
    tmp_path: Path, name: str, purpose: Literal["part", "assembly"], language: Literal["en", "uk"]
) -> None:
    scene = load_scene(name)
    scene.scene.language = language
    kinds = {KINDS[str(type(spec).__struct_config__.tag)] for spec in scene.parts.values()}
    scene.exports = [ExportSpec(format="dxf", purpose=purpose, tolerance=0.01)]
    try:
        sheets = plan_build(scene, name, [], []).sheets
    except SceneError as refusal:
        # barrels have no view in assemblies, nor has what stands aslant
        if purpose == "assembly" and refusal.code in ("no_assembly_view", "assembly_axis_oblique"):
            return
        if not any(kind.drawing for kind in kinds):
            return
        raise
    for job in sheets:
        file = tmp_path / job.path
        job.write({}, file)
        write_sheet_svg(file.with_suffix(".svg"), job.canvas)
        assert faults(file.with_suffix(".svg")) == [], job.path
        assert tangles(file) == [], job.path
        assert purpose == "part" or run_over(file) == 0, job.path


def test_sizes_of_a_small_plate_keep_off_its_edges_and_its_thickness_off_its_sizes(tmp_path: Path) -> None:
    """As it was: the diameter's line lay on the upper edge, the leader of the thickness on an extension line."""
    slot = {"kind": "plate", "width": 20.0, "height": 10.0, "corner_radius": 5.0, "face_width": 3.0,
            "holes": [{"at": [0.0, 0.0], "diameter": 3.0}]}  # fmt: skip
    (job,) = jobs(slot, formats=("dxf",))
    job.write({}, tmp_path / job.path)
    assert tangles(tmp_path / job.path) == []
    document = ezdxf.readfile(tmp_path / job.path)
    dimensions = document.modelspace().query("DIMENSION")
    # both ends of it are rounded, in four arcs about two centres
    assert any(one.dxf.text == "R<> (2 places)" for one in dimensions)
    # the negative control: an edge along the line of a size
    ends = [(p.real, p.imag) for p in size_line(document, dimensions[0])]
    document.modelspace().add_line(*ends, dxfattribs={"layer": "OUTLINE"})
    document.saveas(tmp_path / job.path)
    assert tangles(tmp_path / job.path) != []


def test_leaders_that_cross_are_seen(tmp_path: Path) -> None:
    (job,) = jobs(PARTS["bearing"], formats=("dxf",))
    job.write({}, tmp_path / job.path)
    document = ezdxf.readfile(tmp_path / job.path)
    for a, b in (((30, 100), (50, 120)), ((50, 100), (30, 120))):
        document.modelspace().add_line(a, b, dxfattribs={"layer": "DIMENSION"})
    document.saveas(tmp_path / job.path)
    assert tangles(tmp_path / job.path) == ["leaders cross near 50+100j"]


def test_leaders_of_numbers_keep_off_dimension_lines(tmp_path: Path) -> None:
    """As it was: numbers stood on both sides, whatever sizes were there, and the larger gear's leader crossed one."""
    gear = {"kind": "spur_gear", "module": 2.0, "face_width": 10.0, "bore_diameter": 8.0}
    gears = {key: gear | {"number_of_teeth": teeth} for key, teeth in (("small", 17), ("large", 40))}
    raw = {"parts": gears, "mates": [{"kind": "external_gear_pair", "first": "small", "second": "large"}],
           "exports": [{"format": "dxf", "purpose": "assembly"}]}  # fmt: skip
    (job,) = plan_build(scene_from_dict(raw, "t", "t"), "t", [], []).sheets
    job.write({}, tmp_path / job.path)
    assert run_over(tmp_path / job.path) == 0


def test_dimension_lines_stand_beyond_numbers_where_leaders_would_cross_them(tmp_path: Path) -> None:
    """As it was: with sizes on all sides of the view four leaders crossed some."""
    scene = load_scene("laser_gear_set")
    scene.exports = [ExportSpec(format="dxf", purpose="assembly", tolerance=0.01)]
    (job,) = plan_build(scene, "laser_gear_set", [], []).sheets
    job.write({}, tmp_path / job.path)
    assert run_over(tmp_path / job.path) == 0


@pytest.mark.heavy
def test_edges_that_are_one_on_paper_are_drawn_once(tmp_path: Path) -> None:
    """The posts of a cage behind its section: edges 0.0003 mm from each other were two lines."""
    cage = msgspec.to_builtins(load_scene("power_module").parts["large_cage"])
    (job,) = jobs({key: cage[key] for key in ("kind", "layers")}, formats=("dxf",))
    write_sheet_svg(tmp_path / "s.svg", job.canvas)
    assert faults(tmp_path / "s.svg") == []


def test_the_sign_on_the_seats_of_a_ring_keeps_off_dimension_lines(tmp_path: Path) -> None:
    """As it was: sizes chose first, and the sign's leader crossed the one of the ring's inner diameter."""
    (job,) = jobs(PARTS["pin ring"], formats=("dxf",))
    job.write({}, tmp_path / job.path)
    assert run_over(tmp_path / job.path) == 0


@pytest.mark.heavy
def test_an_angle_without_room_beside_sizes_chooses_before_them(tmp_path: Path) -> None:
    """As it was: the tip angle found room at 1:5 only, with leaders across each other."""
    scene = load_scene("bevel_differential")
    scene.exports = [ExportSpec(format="dxf", purpose="part", parts=["side"], tolerance=0.01)]
    (job,) = plan_build(scene, "bevel_differential", [], []).sheets
    job.write({}, tmp_path / job.path)
    assert tangles(tmp_path / job.path) == []
    assert {one.scale for one in job.canvas.dimensions} == {1.0}
