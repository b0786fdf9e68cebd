"""Bores, holes and spokes from scenes: the right section, and one line that says what would work."""

from __future__ import annotations

import math
import re
from pathlib import Path
from time import process_time
from typing import Any

import ezdxf
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from exporters.production.build import build
from exporters.production.plan import plan_build
from geometry.plane.measure import profile_area
from geometry.plane.profile import Label, Region
from geometry.solids.keyways import KEYWAY_TABLES
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, resolved, scene_from_dict, scene_from_resolved
from tests.sampling import examples

GEAR = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 30}
ROOT = 55.0
RING = {"count": 5, "inner_diameter": 24, "outer_diameter": 46, "width": 4, "corner_radius": 1.5}
HOLES = {"count": 6, "diameter": 6, "pitch_circle_diameter": 36}
GOOD: dict[str, dict[str, Any]] = {
    "round": {"bore": {"shape": "round", "diameter": 12}},
    "keyway": {"bore": {"shape": "keyway", "diameter": 14}},
    "two keyways": {"bore": {"shape": "keyway", "diameter": 20, "standard": "GOST 23360", "keys": 2, "angle_deg": 0}},
    "own keyway": {"bore": {"shape": "keyway", "diameter": 5, "width": 1.5, "depth": 0.8}},
    "wider keyway": {"bore": {"shape": "keyway", "diameter": 14, "width": 6.5, "corner_radius": 0}},
    "D": {"bore": {"shape": "D", "diameter": 5, "flat": 4.5}},
    "double D": {"bore": {"shape": "double_D", "diameter": 6, "across_flats": 4}},
    "hexagon": {"bore": {"shape": "hexagon", "across_flats": 6.35}, "spokes": RING},
    "rounded hexagon": {"bore": {"shape": "hexagon", "across_flats": 12, "corner_radius": 1}, "holes": HOLES},
    "square": {"bore": {"shape": "square", "across_flats": 8, "angle_deg": 45}, "holes": [HOLES]},
    "two groups": {"bore_diameter": 10,
                   "holes": [HOLES, {**HOLES, "diameter": 2, "pitch_circle_diameter": 50, "start_deg": 7.5}]},
    "spokes alone": {"spokes": {**RING, "count": 2, "start_deg": 90}},
    "holes in the spokes": {"holes": {**HOLES, "count": 5, "diameter": 2, "start_deg": 30},
                            "spokes": {**RING, "start_deg": 30}},
    "no holes": {"holes": []},
}  # fmt: skip


def scene(keys: dict[str, Any], *exports: dict[str, Any]) -> Any:
    raw = {"parts": {"gear": {**GEAR, **keys}}, "exports": list(exports) or [{"format": "dxf"}]}
    return scene_from_dict(raw, "t.toml", "t")


def region(keys: dict[str, Any], offset: float = 0.0) -> Region:
    return make_parts(scene(keys), "t.toml")[0]["gear"].section(offset).region


def refused(keys: dict[str, Any]) -> str:
    """The one line with which a gear is refused."""
    with pytest.raises(SceneError) as caught:
        make_parts(scene(keys), "t.toml")
    text = str(caught.value)
    assert "\n" not in text
    assert "msgspec" not in text
    return text


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", GOOD)
def test_every_shape_becomes_verified_files(name: str, tmp_path: Path) -> None:
    """Laser DXF of arcs and of lines, and SVG, with kerf and an inward offset; a reader's area is the exact one."""
    exports = [
        {"format": "dxf", "kerf": 0.2}, {"format": "svg", "offset": -0.1},
        {"format": "dxf", "curves": "lines", "name": "lines"},
    ]  # fmt: skip
    plan = plan_build(scene(GOOD[name], *exports), "t.toml", [], [])
    written = build(plan, tmp_path).written
    assert [item.failures for item in written] == [()] * 3
    found = ezdxf.readfile(tmp_path / "gear.lines.dxf").modelspace().query("LWPOLYLINE[layer=='CUT_INNER']")
    holes = region(GOOD[name]).holes
    assert len(found) == len(holes)
    area = 0.0
    for line in found:
        z = np.array([complex(x, y) for x, y in line.get_points("xy")])
        area += 0.5 * float(np.sum((np.conj(z) * np.roll(z, -1)).imag))
    assert area == pytest.approx(sum(profile_area(p) for p in holes), rel=5e-3)


def test_the_keyway_of_the_standard() -> None:
    """14 mm: key 5 x 5, t2 = 2.3, bottom corners 0.25; the keyway stands upwards."""
    hole = region(GOOD["keyway"]).holes[0]
    bottom = max((s.curve for s in hole.period if s.label is Label.KEYWAY), key=lambda c: complex(c.point(0.5)).imag)
    assert complex(bottom.point(0.5)) == pytest.approx(9.3j, abs=1e-14)
    assert abs(bottom.end - bottom.start) == pytest.approx(5 - 2 * 0.25)


def test_each_size_may_be_given_alone() -> None:
    def size(**keys: float) -> tuple[float, float]:
        z = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 9)) for s in region(
            {"bore": {"shape": "keyway", "diameter": 14, "corner_radius": 0, "angle_deg": 0, **keys}}
        ).holes[0].period if s.label is Label.KEYWAY])  # fmt: skip
        return float(np.ptp(z.imag)), float(z.real.max()) - 7

    assert size() == pytest.approx((5, 2.3))
    assert size(width=4) == pytest.approx((4, 2.3))
    assert size(depth=3) == pytest.approx((5, 3))
    assert size(width=4, depth=3) == pytest.approx((4, 3))


def test_both_standards_are_known() -> None:
    for standard in KEYWAY_TABLES:
        assert region({"bore": {"shape": "keyway", "diameter": 30, "standard": standard}}).holes


def test_the_short_form_is_the_round_bore() -> None:
    assert region({"bore_diameter": 12}) == region(GOOD["round"])


@pytest.mark.parametrize("name", GOOD)
def test_a_report_keeps_the_tables(name: str) -> None:
    original = scene(GOOD[name])
    again = scene_from_resolved(resolved(original), "report.json")
    assert again.parts == original.parts


WRONG: dict[str, tuple[dict[str, Any], str, str]] = {
    "no table": ({"bore": 3}, "gear.bore = 3", '"double_D"'),
    "no shape": ({"bore": {"diameter": 3}}, "gear.bore.shape: is missing", '"hexagon"'),
    "unknown shape": ({"bore": {"shape": "octagon"}}, 'gear.bore.shape = "octagon"', '"keyway"'),
    "shape is a number": ({"bore": {"shape": 8}}, "gear.bore.shape = 8", '"square"'),
    "unknown key": ({"bore": {"shape": "D", "diametre": 3}}, "gear.bore.diametre = 3", "did you mean diameter"),
    "key of another shape": ({"bore": {"shape": "hexagon", "flat": 3}}, "gear.bore.flat = 3", "across_flats"),
    "missing size": ({"bore": {"shape": "D", "diameter": 3}}, "gear.bore.flat: is missing", "opposite side"),
    "text": ({"bore": {"shape": "square", "across_flats": "x"}}, 'gear.bore.across_flats = "x"', "a number"),
    "standard": ({"bore": {"shape": "keyway", "diameter": 9, "standard": "ANSI"}}, 'standard = "ANSI"', "DIN 6885"),
    "both bores": ({**GOOD["D"], "bore_diameter": 5}, "gear.bore_diameter = 5", "either"),
    "list of holes": ({"holes": [HOLES, {**HOLES, "count": 0}]}, "gear.holes[2].count = 0", "at least 1"),
    "unknown key of holes": ({"holes": {**HOLES, "diamter": 1}}, "gear.holes.diamter = 1", "did you mean diameter"),
    "holes as text": ({"holes": "six"}, 'gear.holes = "six"', "a list of tables"),
    "one spoke": ({"spokes": {**RING, "count": 1}}, "gear.spokes.count = 1", "at least 2"),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_table_is_told_in_one_line(name: str) -> None:
    keys, place, remedy = WRONG[name]
    with pytest.raises(SceneError) as caught:
        make_parts(scene(keys), "t.toml")
    assert place in str(caught.value)
    assert remedy in str(caught.value)
    assert "\n" not in str(caught.value)


KEYWAY = {"shape": "keyway", "diameter": 14}
UNFIT: dict[str, tuple[dict[str, Any], str]] = {
    "bore in the root": ({"bore": {"shape": "round", "diameter": 55}}, "bore.diameter"),
    "keyway in the root": ({"bore": {"shape": "keyway", "diameter": 50}}, "bore.diameter"),
    "deep keyway": ({"bore": {**KEYWAY, "depth": 21}}, "bore."),
    "wide keyway": ({"bore": {**KEYWAY, "width": 14}}, "bore.width"),
    "corner of a keyway": ({"bore": {**KEYWAY, "corner_radius": 3}}, "bore.corner_radius"),
    "shaft too thin for a key": ({"bore": {"shape": "keyway", "diameter": 4}}, "bore.diameter"),
    "shaft too thick for a key": ({"bore": {"shape": "keyway", "diameter": 501}}, "bore.diameter"),
    "flat outside": ({"bore": {"shape": "D", "diameter": 5, "flat": 5}}, "bore.flat"),
    "flat beyond the axis": ({"bore": {"shape": "D", "diameter": 5, "flat": 2.5}}, "bore.flat"),
    "double flat": ({"bore": {"shape": "double_D", "diameter": 5, "across_flats": 6}}, "bore.across_flats"),
    "hexagon in the root": ({"bore": {"shape": "hexagon", "across_flats": 50}}, "bore.across_flats"),
    "square of no side": ({"bore": {"shape": "square", "across_flats": 9, "corner_radius": 4.5}}, "bore.corner_radius"),
    "holes in the root": ({"holes": {**HOLES, "pitch_circle_diameter": 50}}, "holes.pitch_circle_diameter"),
    "large holes": ({"holes": {**HOLES, "diameter": 30}}, "holes.diameter"),
    "many holes": ({"holes": {**HOLES, "count": 40}}, "holes.diameter"),
    "holes in the bore": ({"bore_diameter": 30, "holes": HOLES}, "holes.diameter"),
    "holes inside the bore": ({"bore_diameter": 30, "holes": {**HOLES, "pitch_circle_diameter": 15}}, "holes."),
    "second group": ({"holes": [HOLES, {**HOLES, "start_deg": 5}]}, "holes[2]."),
    "spokes in the root": ({"spokes": {**RING, "outer_diameter": 56}}, "spokes.outer_diameter"),
    "spokes in the bore": ({"bore_diameter": 25, "spokes": RING}, "spokes.inner_diameter"),
    "no window": ({"spokes": {**RING, "width": 15}}, "spokes.width"),
    "no ring": ({"spokes": {**RING, "inner_diameter": 46}}, "spokes.inner_diameter"),
    "corner of a window": ({"spokes": {**RING, "corner_radius": 6}}, "spokes.corner_radius"),
    "hole in a window": ({"spokes": RING, "holes": HOLES}, "holes."),
}  # fmt: skip


def repaired(keys: dict[str, Any], text: str) -> dict[str, Any]:
    """The keys with what a refusal offers in place of what it refused."""
    place = re.match(r"t\.toml: parts\.gear\.([a-z]+)(?:\[(\d+)\])?\.([a-z_]+) = ", text)
    assert place, text
    owner, item, name = place.groups()
    offered = re.search(r"; at (?:most|least) ([\d.]+)(?: mm)? works$", text)
    values = {name: offered[1]} if offered else dict(re.findall(r"([a-z_]+) = ([\d.]+)(?= with| mm works)", text))
    assert values, text
    numbers = {k: int(v) if k == "count" else float(v) for k, v in values.items()}
    if item is None:
        return {**keys, owner: {**keys[owner], **numbers}}
    index = int(item) - 1
    return {**keys, owner: [{**t, **numbers} if i == index else t for i, t in enumerate(keys[owner])]}


@pytest.mark.parametrize("name", UNFIT)
def test_what_does_not_fit_is_refused_with_what_works(name: str) -> None:
    keys, key = UNFIT[name]
    text = refused(keys)
    assert f"parts.gear.{key}" in text
    assert region(repaired(keys, text)).holes


def test_the_named_value_is_the_nearest() -> None:
    """Closed forms of three limits, to the digits that are printed; but for a round bore a wall of 0.05 mm is left."""
    limits = {
        "bore in the root": ROOT,
        "holes in the bore": 6.0 - 0.1,
        "hexagon in the root": (ROOT - 0.1) * math.cos(math.pi / 6),
        "many holes": 36 * math.sin(math.pi / 40) - 0.05,
    }
    for name, limit in limits.items():
        offered = re.search(r"at most ([\d.]+)", refused(UNFIT[name][0]))
        assert offered, name
        assert limit - 2e-4 <= float(offered[1]) < limit, name


def test_a_kerf_that_closes_any_hole_is_refused_with_one_that_works() -> None:
    """The narrowest of all holes decides; a keyway is one."""
    for keys, limit in ((GOOD["keyway"], 5.0), (GOOD["two groups"], 2.0), ({"bore": {**KEYWAY, "width": 1.2}}, 1.2)):
        with pytest.raises(SceneError) as caught:
            plan_build(scene(keys, {"format": "dxf", "kerf": 9.0}), "t.toml", [], [])
        offered = re.search(r"at most ([\d.]+) mm works", str(caught.value))
        assert offered
        assert 0 < float(offered[1]) < limit
        assert plan_build(scene(keys, {"format": "dxf", "kerf": float(offered[1])}), "t.toml", [], []).jobs


sizes = st.floats(0.001, 60) | st.floats(1e-12, 1e5)
shapes = st.one_of(
    st.fixed_dictionaries(
        {"shape": st.just("keyway"), "diameter": sizes},
        optional={"width": sizes, "depth": sizes, "corner_radius": sizes, "keys": st.integers(1, 2)},
    ),
    st.fixed_dictionaries({"shape": st.just("D"), "diameter": sizes, "flat": sizes}),
    st.fixed_dictionaries({"shape": st.just("double_D"), "diameter": sizes, "across_flats": sizes}),
    st.fixed_dictionaries(
        {"shape": st.sampled_from(["hexagon", "square"]), "across_flats": sizes}, optional={"corner_radius": sizes}
    ),
)
groups = st.fixed_dictionaries(
    {"count": st.integers(1, 60), "diameter": sizes, "pitch_circle_diameter": sizes},
    optional={"start_deg": st.floats(-360, 360)},
)
rings = st.fixed_dictionaries(
    {"count": st.integers(2, 30), "inner_diameter": sizes, "outer_diameter": sizes, "width": sizes},
    optional={"corner_radius": sizes, "start_deg": st.floats(-360, 360)},
)


@examples(25)
@given(
    st.fixed_dictionaries(
        {}, optional={"bore": shapes, "holes": groups | st.lists(groups, max_size=2), "spokes": rings}
    ),
    st.floats(-0.3, 0.3),
)  # fmt: skip
def test_any_tables_give_a_section_or_one_line(keys: dict[str, Any], offset: float) -> None:
    line = ""
    try:
        plan = plan_build(scene(keys, {"format": "dxf", "offset": offset}), "t.toml", [], [])
    except SceneError as error:
        line = str(error)
    assert "\n" not in line
    if line:
        return
    holes = plan.jobs[0].section.region.holes
    assert all(profile_area(hole) < 0 for hole in holes)


def test_many_groups_of_holes_that_meet_are_refused_at_once() -> None:
    """Half a million pairs of them were looked at for each trial, minutes long, where the first two meet."""
    hole = {"count": 3, "diameter": 1.0, "pitch_circle_diameter": 20.0}
    part = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 23, "holes": [hole] * 1000}
    began = process_time()
    with pytest.raises(SceneError) as refused:
        make_parts(scene_from_dict({"parts": {"p": part}}, "s", "s"), "s")
    assert refused.value.code == "holes_touch_another_group"
    assert process_time() - began < 10


def shaft(shape: str, grown: float) -> Any:
    """The section of what goes into each bore, drawn by hand and moved out by ``grown`` mm on all sides."""
    import shapely

    def disk(radius: float) -> Any:
        return shapely.Point(0, 0).buffer(radius + grown, quad_segs=500)

    if shape == "keyway":
        # DIN 6885 for 12 to 17 mm: 5 wide, 2.3 deep in the hub
        return disk(7).union(shapely.box(-2.5 - grown, 0, 2.5 + grown, 9.3 + grown))
    if shape in ("D", "double_D"):
        low = -20.0 if shape == "D" else -4.5 - grown
        return disk(5).intersection(shapely.box(-20, low, 20, 4.5 + grown))
    if shape == "round":
        return disk(5)
    sides = 6 if shape == "hexagon" else 4
    corners = (5 + grown) / math.cos(math.pi / sides) * np.exp(1j * math.pi * (2 * np.arange(sides) + 1) / sides) * 1j
    return shapely.Polygon(np.column_stack([corners.real, corners.imag]))


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("shape", "sizes"),
    [
        ("round", {"diameter": 10}), ("keyway", {"diameter": 14, "corner_radius": 0}),
        ("D", {"diameter": 10, "flat": 9.5}), ("double_D", {"diameter": 10, "across_flats": 9}),
        ("hexagon", {"across_flats": 10}), ("square", {"across_flats": 10}),
    ],
)  # fmt: skip
def test_a_clearance_moves_every_wall_of_a_bore_off_its_shaft(
    shape: str, sizes: dict[str, float], tmp_path: Path
) -> None:
    """As far as that of splines does, along the normal: 0.15 mm; the STL is cut by trimesh, the shaft drawn by hand."""
    import shapely
    import trimesh

    keys = {"bore": {"shape": shape, **sizes, "clearance": 0.15}}
    exports = {"format": "stl", "tolerance": 0.001}
    assert build(plan_build(scene(keys, exports), "t.toml", [], []), tmp_path).well
    mesh = trimesh.load(tmp_path / "gear.stl")
    edges = trimesh.intersections.mesh_plane(mesh, [0, 0, 1], [0, 0, 5.0])[:, :, :2].round(7)
    (gear, *_) = sorted(shapely.polygonize(shapely.linestrings(edges)).geoms, key=lambda face: -face.area)
    (hole,) = (shapely.Polygon(ring) for ring in gear.interiors)
    assert hole.symmetric_difference(shaft(shape, 0.15)).area < 0.002 * hole.length
    assert shapely.distance(hole.exterior, shaft(shape, 0.0).exterior) == pytest.approx(0.15, abs=0.002)


def test_a_clearance_that_leaves_no_rim_is_told() -> None:
    assert "bore" in (told := refused({"bore": {"shape": "D", "diameter": 10, "flat": 9, "clearance": 30}}))
    assert "works" in told or "at most" in told
