"""Scenes: loading, defaults, the built-in ones, and the round trip through what a report keeps."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from exporters.production.plan import plan_build
from parts.scene.files import built_in_scenes
from parts.scene.load import (
    load_scene,
    make_parts,
    resolved,
    scene_from_dict,
    scene_from_resolved,
    scene_from_toml,
)
from tests.sampling import examples

MINIMAL = '[parts.gear]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 23\n'


def parsed(text: str) -> Any:
    """A scene from text."""
    return scene_from_toml(text.encode(), "test.toml", "test")


def gear_of(text: str) -> Any:
    """The only part of a scene."""
    scene = parsed(text)
    return make_parts(scene, "test.toml")[0][next(iter(scene.parts))]


def test_a_minimal_scene_gets_the_defaults_of_the_standard() -> None:
    """ISO 53 A at 20 degrees, no shift: d = 46, d_a = 50, d_f = 41, d_b = 46 cos 20."""
    part = gear_of(MINIMAL)
    assert part.circles["reference_diameter"] == pytest.approx(46)
    assert part.circles["tip_diameter"] == pytest.approx(50)
    assert part.circles["root_diameter"] == pytest.approx(41)
    assert part.circles["base_diameter"] == pytest.approx(46 * math.cos(math.radians(20)))
    assert part.quantities["pitch"] == pytest.approx(2 * math.pi)
    assert part.quantities["tooth_thickness"] == pytest.approx(math.pi)
    assert part.body(0.0).levels() == (0.0, 10.0)
    assert part.section(0.0).region.holes == ()


@pytest.mark.parametrize(
    ("name", "purpose", "tolerance"),
    [
        ("dxf", "laser", 0.005),
        ("svg", "laser", 0.005),
        ("stl", "print", 0.01),
    ],
)
def test_an_export_gets_the_default_of_its_format(name: str, purpose: str, tolerance: float) -> None:
    scene = parsed(MINIMAL + f'[[exports]]\nformat = "{name}"\n')
    assert (scene.exports[0].purpose, scene.exports[0].tolerance) == (purpose, tolerance)
    assert scene.exports[0].kerf == scene.exports[0].offset == 0
    assert scene.exports[0].parts is None


@pytest.mark.parametrize("name", ["ISO 53 A", "ISO 53 B", "ISO 53 C", "ISO 53 D", "GOST 13755"])
def test_the_dedendum_is_that_of_the_named_rack(name: str) -> None:
    """ISO 53:1998, table 2: h_fP 1.25, 1.25, 1.25, 1.4; GOST 13755 is profile A."""
    dedendum = 1.4 if name.endswith("D") else 1.25
    part = gear_of(MINIMAL + f'basic_rack = "{name}"\n')
    assert part.circles["root_diameter"] == pytest.approx(46 - 2 * 2 * dedendum)


def test_a_rack_table_and_a_tip_relief_are_taken() -> None:
    part = gear_of(
        MINIMAL + "basic_rack = { addendum_coefficient = 0.8, tip_clearance_coefficient = 0.2 }\n"
        "tip_relief = { depth_coefficient = 0.02, height_coefficient = 0.4 }\n"
    )
    assert part.circles["root_diameter"] == pytest.approx(46 - 4)
    assert part.circles["tip_diameter"] == pytest.approx(46 + 3.2)


def test_whole_numbers_are_taken_where_a_length_is_asked_for() -> None:
    assert gear_of(MINIMAL.replace("2.0", "2") + "bore_diameter = 8\n").section(0.0).region.holes


def test_a_byte_order_mark_and_windows_line_ends_do_no_harm() -> None:
    text = b"\xef\xbb\xbf" + MINIMAL.replace("\n", "\r\n").encode()
    assert make_parts(scene_from_toml(text, "test.toml", "test"), "test.toml")


def test_titles_and_comments_may_be_in_any_script(tmp_path: Path) -> None:
    file = tmp_path / "сцена.toml"
    file.write_text('# коментар\n[scene]\ntitle = "Пара коліс"\nlanguage = "uk"\n' + MINIMAL, encoding="utf-8")
    scene = load_scene(str(file))
    assert (scene.name, scene.scene.title, scene.scene.language) == ("сцена", "Пара коліс", "uk")


def test_a_scene_is_found_by_name_and_by_path_and_the_path_wins(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert set(load_scene("print_gear").parts) == {"gear", "wheel"}
    (tmp_path / "print_gear").write_text(MINIMAL.replace("gear]", "mine]"), encoding="utf-8")
    assert set(load_scene("print_gear").parts) == {"mine"}
    (tmp_path / "print_gear").unlink()
    (tmp_path / "print_gear").mkdir()
    assert set(load_scene("print_gear").parts) == {"gear", "wheel"}


# the law of table 2.2 and a contour of arcs begin and end with a soft impact, lesson 1 shows undercut and thin tips,
# lesson 4 gives a flat follower an offset E, which moves its plate only; wheels of the thesis are to be wider than made
REMARKS = {
    "guidelines_cam": {"soft_impact"},
    "contour_cams": {"soft_impact"},
    "practicum_flat_cam": {"flat_offset"},
    "lesson_1": {"undercut", "thin_tip"},
    "tmm42": {"undercut", "thin_tip"},
    "power_module": {"worm_wheel_outer_not_reached"},
    "thesis_worm_1": {"worm_wheel_outer_not_reached"},
    "thesis_worm_2": {"worm_wheel_outer_not_reached"},
}


# what takes long to plan: boards for ten groups, drawings, a whole machine; their own tests build them
LONG = {"lesson_4", "lesson_5", "working_drawings", "power_module"}


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.heavy] * (name in LONG)) for name in built_in_scenes()]
)
def test_every_built_in_scene_builds_parts_without_a_bad_remark(name: str) -> None:
    scene = load_scene(name)
    assert scene.name == name
    assert scene.scene.title
    plan = plan_build(scene, name, [], [])
    # a scene for boards has its parts there, one of drawings its sheets
    assert len(plan.jobs) >= len(scene.parts) or plan.assemblies or plan.sheets
    for part in plan.parts.values():
        codes = {f.code for f in part.findings}
        assert codes <= REMARKS.get(name, set()), part.findings


def test_the_practicum_pair_has_the_dimensions_of_the_practicum() -> None:
    """Lesson 3: d = 130 and 210 mm, d_b = d cos 20, tip diameters (3.11) and (3.12), root by (3.9), (3.10)."""
    parts = make_parts(load_scene("practicum_pair"), "practicum_pair")[0]
    for name, d, x, tip in (("pinion", 130, 0.694, 160.68527481), ("wheel", 210, 0.384, 234.48527481)):
        circles = parts[name].circles
        assert circles["reference_diameter"] == pytest.approx(d)
        assert circles["base_diameter"] == pytest.approx(d * math.cos(math.radians(20)))
        assert circles["tip_diameter"] == pytest.approx(tip, abs=1e-8)
        assert circles["root_diameter"] == pytest.approx(d - 2 * 10 * (1.25 - x))


@pytest.mark.sampled(5)
@pytest.mark.parametrize("name", built_in_scenes())
def test_what_a_report_keeps_makes_the_same_scene_again(name: str) -> None:
    scene = load_scene(name)
    kept = json.loads(json.dumps(resolved(scene)))
    # what was told out has no other places any more, and no assemblies
    assert scene_from_resolved(kept, "report.json") == msgspec.structs.replace(scene, origins={}, typed={})
    assert resolved(scene_from_resolved(kept, "report.json")) == resolved(scene)


def test_a_resolved_scene_has_every_default_filled_in() -> None:
    kept = resolved(parsed(MINIMAL + '[[exports]]\nformat = "stl"\n'))
    assert kept["parts"]["gear"]["kind"] == "spur_gear"
    assert kept["parts"]["gear"]["basic_rack"] == "ISO 53 A"
    assert kept["parts"]["gear"]["pressure_angle_deg"] == 20
    assert kept["exports"][0]["tolerance"] == 0.01
    assert kept["name"] == "test"


lengths = st.floats(0, 5).map(lambda v: round(v, 6))
relief_tables = st.fixed_dictionaries(
    {"depth_coefficient": st.floats(0, 0.3)}, optional={"height_coefficient": st.floats(0.01, 3)}
)


def words(most: int) -> st.SearchStrategy[str]:
    """Any text that a scene takes: no controls (Cc), no code that is no letter (Cs, Cn)."""
    return st.text(st.characters(exclude_categories=["Cc", "Cs", "Cn"]), max_size=most)


gear_tables = st.fixed_dictionaries(
    {"kind": st.just("spur_gear"), "module": st.floats(0.01, 100), "number_of_teeth": st.integers(3, 10_000)},
    optional={
        "profile_shift_coefficient": st.floats(-10, 10),
        "pressure_angle_deg": st.floats(5, 45),
        "basic_rack": st.sampled_from(["ISO 53 B", "GOST 13755", {"addendum_coefficient": 0.9}]),
        "tip_diameter": st.floats(0.1, 1e5),
        "thinning_method": st.sampled_from(["wider_rack_tooth", "deeper_cut"]),
        "tip_relief": relief_tables,
        "tip_chamfer": lengths,
        "tip_rounding": lengths,
        "bore_diameter": lengths,
        "material": words(20).map("PLA {}".format),
        "colour": st.just("#C08040"),
    },
)
export_tables = st.fixed_dictionaries(
    {"format": st.sampled_from(["dxf", "svg"])},
    optional={
        "tolerance": st.floats(1e-7, 1),
        "curves": st.sampled_from(["arcs", "lines"]),
        "kerf": lengths,
        "name": st.from_regex(r"[A-Za-z0-9_-]{1,9}", fullmatch=True).map(lambda t: "x" + t),
    },
)


@examples(100)
@given(gear=gear_tables, exports=st.lists(export_tables, max_size=3), title=words(30))
def test_any_valid_scene_survives_the_round_trip(
    gear: dict[str, Any], exports: list[dict[str, Any]], title: str
) -> None:
    """Also through JSON, as in a report; numbers come back to the last digit."""
    scene = scene_from_dict({"scene": {"title": title}, "parts": {"g": gear}, "exports": exports}, "s.toml", "s")
    kept = json.loads(json.dumps(resolved(scene), ensure_ascii=False))
    # what was told out has no other places any more, and no assemblies
    assert scene_from_resolved(kept, "report.json") == msgspec.structs.replace(scene, origins={}, typed={})
    assert scene.parts["g"].module == gear["module"]


def test_a_spec_can_only_hold_what_its_schema_allows() -> None:
    """The schema is the struct itself: every number of a part has a least value and a unit or a range."""
    for field in msgspec.structs.fields(type(parsed(MINIMAL).parts["gear"])):
        text = str(field.type)
        if "float" in text:
            assert "ge=" in text or "gt=" in text, field.name
