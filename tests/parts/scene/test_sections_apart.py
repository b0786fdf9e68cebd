"""What keeps two solids apart, or what they have in common, by their sections: closed forms of cylinders and tubes."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
import shapely
from shapely.geometry.base import BaseGeometry

from geometry.base.placement import Vector
from parts.base.part import Part
from parts.scene.half_sections import TOUCH, Sections, drawn_along
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.standing import Instance
from parts.solids.mesh import body_mesh, mesh_outlines

RIGHT: Vector = (1.0, 0.0, 0.0)


def turned(*points: tuple[float, float], holes: dict[str, Any] | None = None) -> dict[str, Any]:
    made: dict[str, Any] = {"kind": "turned", "points": [{"r": float(r), "z": float(z)} for r, z in points]}
    return made | ({"holes": holes} if holes else {})


def tube(inner: float, outer: float, height: float, **more: Any) -> dict[str, Any]:
    return turned((inner, 0), (outer, 0), (outer, height), (inner, height), **more)


HOLES = {"count": 6, "diameter": 5.0, "pitch_circle_diameter": 40.0}
PARTS: dict[str, dict[str, Any]] = {
    "rod": tube(0, 5, 30), "thick": tube(0, 7, 30), "pin": tube(0, 2, 30), "tube": tube(6, 10, 20),
    "flange": tube(6, 30, 8, holes=HOLES), "wide": tube(20, 30, 12),
    # closed above: 6 wide from 0 to 15
    "cap": turned((6, 0), (10, 0), (10, 20), (0, 20), (0, 15), (6, 15)),
    "cone": turned((0, 0), (12, 0), (4, 16), (0, 16)),
    "plate": {"kind": "layered", "layers": [
        {"thickness": 6.0, "polygons": [{"points": [[-30, -20], [30, -20], [30, 20], [-30, 20]]}],
         "circles": [{"diameter": 12.0, "at": [15.0, 0.0]}]},
        {"thickness": 4.0, "polygons": [{"points": [[-28, -18], [-10, -18], [-10, 18], [-28, 18]]}]}]},
    "gear": {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20, "face_width": 8.0},
    "worm": {"kind": "worm", "module": 2.0, "thread_length": 30.0,
             "shaft_above": [{"diameter": 12.0, "length": 10.0}]},
    "worm_wheel": {"kind": "worm_wheel", "module": 2.0, "number_of_teeth": 30},
}  # fmt: skip


@cache
def parts() -> dict[str, Part]:
    return make_parts(scene_from_dict({"parts": PARTS}, "t", "t"), "t")[0]


@pytest.fixture(scope="module")
def sections() -> Sections:
    return Sections(parts())


def at(
    part: str, x: float = 0.0, y: float = 0.0, z: float = 0.0, axis: Vector = (0.0, 0.0, 1.0), turn: float = 0.0
) -> Instance:
    return Instance(part, part, (x, y, z), turn, axis=axis)


@pytest.mark.parametrize(
    ("one", "two", "gap"),
    [
        # about one axis
        (at("rod"), at("tube"), 1.0), (at("rod", z=-3), at("tube", z=2), 1.0),
        (at("rod", z=25.5), at("tube"), math.hypot(1, 5.5)),
        (at("thick", z=22.5), at("tube"), 2.5), (at("thick", z=-31), at("tube"), 1.0),
        (at("rod", z=-15.5), at("cap"), 0.5),
        # beside each other, and one within the other
        (at("rod"), at("tube", 20, 0), 5.0), (at("rod", 3, 4), at("tube", 15, 20), 5.0),
        (at("rod", 12, 0), at("wide"), 3.0),
        (at("rod", 0, -9), at("wide"), 6.0), (at("pin", 20, 0), at("flange"), 0.5),
        (at("pin", 20.2, 0), at("flange"), 0.3),
        (at("pin", 10, 10 * math.sqrt(3)), at("flange"), 0.5),
        (at("pin", 20 * math.cos(0.5), 20 * math.sin(0.5)), at("flange", turn=0.5), 0.5),
        # diagonally: beside by 3 and above by 4
        (at("rod", 18, 0, 24), at("tube"), 5.0),
        # a cone: beside by the distance from its slope, 2 in 1
        (at("rod", 20, 0, 4), at("cone", 0, 0, 0), None),
        # layers
        (at("pin", 15, 0), at("plate"), 4.0), (at("pin", 16, 0), at("plate"), 3.0),
        (at("rod", 40, 0), at("plate"), 5.0),
        (at("rod", 0, 0, 7), at("plate"), 1.0), (at("rod", -2, 0, 7), at("plate"), 1.0),
    ],
)  # fmt: skip
def test_what_is_apart_by_sections_is_apart_by_so_much(
    sections: Sections, one: Instance, two: Instance, gap: float | None
) -> None:
    if gap is None:
        # from (12, 0) to (4, 16) the rod's lower edge at r = 15, z = 4 is off by (15 - 10) * 2 / sqrt 5
        gap = 5.0 * 2 / math.sqrt(5)
    found = sections.between(one, two)
    assert found is not None
    assert (found.gap, found.volume, found.is_least) == (pytest.approx(gap, abs=2e-4), 0.0, False)
    back = sections.between(two, one)
    assert back is not None
    assert back.gap == pytest.approx(found.gap, abs=1e-9)
    # moved and turned together nothing changes
    moved = [at(i.part, i.at[0] * 0.8 - i.at[1] * 0.6 + 7, i.at[0] * 0.6 + i.at[1] * 0.8 - 3, i.at[2] + 11,
                turn=i.rotation + math.atan2(0.6, 0.8)) for i in (one, two)]  # fmt: skip
    same = sections.between(*moved)
    assert same is not None
    assert same.gap == pytest.approx(gap, abs=2e-4)


def test_what_touches_has_no_gap_and_what_is_a_little_in_has_none_either(sections: Sections) -> None:
    for z in (20.0, 20.0 - 0.9 * TOUCH):
        found = sections.between(at("thick", z=z), at("tube"))
        assert found is not None
        assert found.gap == 0.0


@pytest.mark.parametrize(
    ("one", "two", "volume"),
    [
        # a ring of 6 to 7, as high as both stand beside each other
        (at("thick"), at("tube"), math.pi * (49 - 36) * 20), (at("thick", z=15), at("tube"), math.pi * (49 - 36) * 5),
        (at("tube", z=4), at("thick"), math.pi * (49 - 36) * 20),
        # a rod across the bore of a tube whose wall is 10 thick: a lens of two circles
        (at("rod", 17, 0), at("wide"), None),
    ],
)  # fmt: skip
def test_what_certainly_overlaps_is_measured(
    sections: Sections, one: Instance, two: Instance, volume: float | None
) -> None:
    if volume is None:
        # of the rod all beyond 20 from the axis: its circle less what lies in that of the bore
        r, big, d = 5.0, 20.0, 17.0
        a, b = (
            math.acos((d * d + r * r - big * big) / (2 * d * r)),
            math.acos((d * d + big * big - r * r) / (2 * d * big)),
        )
        lens = r * r * (a - math.sin(2 * a) / 2) + big * big * (b - math.sin(2 * b) / 2)
        volume = 12 * (math.pi * r * r - lens)
    found = sections.between(one, two)
    assert found is not None
    assert found.gap == 0.0
    assert found.volume == pytest.approx(volume, rel=0.03)


def test_what_sections_cannot_tell_is_left_open(sections: Sections) -> None:
    """Through a flange between its holes, into a plate, gears that mesh, axes that lean."""
    assert sections.between(at("rod", 11, 0), at("plate", z=-3)) is None
    assert sections.between(at("gear"), at("gear", 40, 0)) is None
    lying = at("rod", 0, 0, 0, RIGHT)
    assert sections.between(at("rod"), lying) is None


@pytest.mark.parametrize(
    ("upright", "lying", "gap"),
    [
        # the lying rod runs from x = 0 to 30 at y and z
        (at("rod"), at("rod", -50, 0, 15, RIGHT), 10.0), (at("rod"), at("rod", -15, 20, 15, RIGHT), 10.0),
        (at("rod"), at("rod", 17, 0, 15, RIGHT), 7.0), (at("rod"), at("rod", -15, 0, 37, RIGHT), 2.0),
        (at("rod", 3, 4, 1), at("rod", -12, 4, -11, RIGHT), 7.0),
        (at("rod"), at("rod", 0, -40, 15, (0.0, 0.8, 0.6)), 40 - 0.8 * 30 - 10),
        (at("tube"), at("pin", -15, 0, 25, RIGHT), 3.0),
        # leaning: its cylinder reaches higher than its middle line by r cos
        (at("rod"), at("rod", -12, 0, 40, (0.8, 0.0, 0.6)), 40 - 0.8 * 5 - 30),
    ],
)  # fmt: skip
def test_what_lies_across_is_at_least_so_far_off(
    sections: Sections, upright: Instance, lying: Instance, gap: float
) -> None:
    for pair in ((upright, lying), (lying, upright)):
        found = sections.between(*pair)
        assert found is not None
        assert (found.gap, found.is_least) == (pytest.approx(gap, abs=1e-9), True)


def test_those_that_lie_are_told_only_on_one_line(sections: Sections) -> None:
    found = sections.between(at("rod", 5, 0, 0, RIGHT), at("tube", 0, 0, 0, RIGHT))
    assert found is not None
    assert found.gap == pytest.approx(1.0)
    stacked = sections.between(at("rod", 5, 0, 0, RIGHT), at("rod", 38, 0, 0, RIGHT))
    assert stacked is not None
    assert stacked.gap == pytest.approx(3.0)
    assert sections.between(at("rod", 5, 0, 0, RIGHT), at("rod", 5, 0, 50, RIGHT)) is None


@pytest.mark.parametrize(
    ("coming", "standing", "way", "free"),
    [
        # down into a tube, through it; into a cap from below alone
        (at("rod"), at("tube"), -1, True), (at("rod"), at("tube"), 1, True), (at("thick"), at("tube"), -1, False),
        (at("rod", z=-20), at("cap"), 1, True), (at("rod", z=-20), at("cap"), -1, False),
        (at("cap", z=20), at("rod"), -1, True),
        (at("cap", z=20), at("rod"), 1, False),
        # a pin into a hole beside the axis, and one beside its hole
        (at("pin", 20, 0), at("flange"), -1, True), (at("pin", 21, 0), at("flange"), -1, False),
        (at("rod", 45, 0), at("flange"), 1, True),
        # what stands beyond its place is passed on the way from there
        (at("thick", z=30), at("tube"), -1, True), (at("thick", z=30), at("tube"), 1, False),
        (at("thick", z=-40), at("tube"), 1, True), (at("thick", z=-40), at("tube"), -1, False),
    ],
)  # fmt: skip
def test_what_comes_along_its_axis_passes_or_not(
    sections: Sections, coming: Instance, standing: Instance, way: int, free: bool
) -> None:
    """``way``: that of its motion; it comes from the other side, from far."""
    assert sections.lets_in(coming, standing, way) is free


@pytest.mark.parametrize(
    ("near", "far", "lift", "free"),
    [
        # the rod's axis goes from 25 to 40 off the tube's; so near that they meet; above and below it; in its bore
        (25.0, 40.0, 0.0, True), (16.0, 40.0, 0.0, True), (14.0, 40.0, 0.0, False), (0.0, 40.0, 21.0, True),
        (0.0, 40.0, 19.0, False),
        (0.0, 40.0, -31.0, True), (0.0, 40.0, -29.0, False), (0.0, 0.9, 0.0, True), (0.0, 1.1, 0.0, False),
    ],
)  # fmt: skip
def test_an_axis_that_goes_about_another_keeps_off_or_not(
    sections: Sections, near: float, far: float, lift: float, free: bool
) -> None:
    assert sections.pass_each_other("tube", 0j, "rod", near, far, lift) is free
    # about an axis that is not the tube's own: 30 off it, the tube reaches from 20 to 40 there
    assert sections.pass_each_other("tube", 30 + 0j, "rod", 0.0, 14.0, lift) is True
    assert sections.pass_each_other("tube", 30 + 0j, "rod", 0.0, 16.0, 0.0) is False


L_SHAPE = shapely.Polygon([(0, 0), (6, 0), (6, 2), (2, 2), (2, 5), (0, 5)])
HOLED = shapely.Polygon(shapely.box(0, 0, 8, 6).exterior.coords, [shapely.box(2, 2, 6, 4).exterior.coords])


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "shape", [L_SHAPE, HOLED, shapely.box(0, 0, 3, 2), shapely.union(L_SHAPE, shapely.box(9, 0, 10, 1))]
)
@pytest.mark.parametrize("way", [7 + 0j, -3j, 2 + 1.5j, -4 + 0.5j, 0.5 + 0.5j])
def test_what_is_drawn_along_holds_all_that_it_passes(shape: BaseGeometry, way: complex) -> None:
    """Against the union of many places on the way; its area by Cavalieri where it is convex."""
    found = drawn_along(shape, way)
    steps = np.linspace(0, 1, 101)
    many = shapely.union_all([shapely.affinity.translate(shape, (way * s).real, (way * s).imag) for s in steps])
    assert found.buffer(1e-9).contains(many)
    assert found.difference(many.buffer(abs(way) / 100)).area < 1e-9
    if shape.equals(shape.convex_hull):
        across = np.array(shape.exterior.coords) @ np.array([way.imag, -way.real]) / abs(way)
        assert found.area == pytest.approx(shape.area + abs(way) * np.ptp(across))


def inside(points: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Which points (r, z) lie in bands with straight sides."""
    found = np.zeros(len(points), bool)
    for z0, z1, a0, a1, b0, b1 in rows:
        share = (points[:, 1] - z0) / (z1 - z0)
        found |= (
            (share > 0)
            & (share < 1)
            & (points[:, 0] > a0 + share * (a1 - a0))
            & (points[:, 0] < b0 + share * (b1 - b0))
        )
    return found


@pytest.mark.parametrize("part", ["cap", "cone", "flange"])
def test_bands_are_the_half_section_between_its_levels(sections: Sections, part: str) -> None:
    corners = [(p["r"], p["z"]) for p in PARTS[part]["points"]]
    shape = shapely.Polygon(corners)
    points = np.random.default_rng(2).uniform([-1, -1], [31, 21], (3000, 2))
    assert (inside(points, sections.made(part).bands) == shapely.contains_xy(shape, *points.T)).all()
    # the plan of what is turned has all of it, and no more than 3 % of its radius more
    plan = sections.made(part).plan
    reach = max(r for r, _ in corners)
    for z0, z1, section in plan:
        own = shape.intersection(shapely.box(0, z0 + 1e-6, 99, z1 - 1e-6)).bounds
        far = max(abs(np.array(section.exterior.coords)).max(axis=0))
        assert own[2] - 1e-3 <= far <= own[2] + 0.03 * reach + 1e-3
    assert sorted({z for z0, z1, _ in plan for z in (z0, z1)})[0] == 0.0


def test_a_plan_leaves_out_bores_and_holes(sections: Sections) -> None:
    ((low, high, section),) = sections.made("flange").plan
    assert (low, high) == (0.0, 8.0)
    assert section.area == pytest.approx(math.pi * (30**2 - 6**2 - 6 * 2.5**2), rel=2e-4)
    cylinders = sections.made("cap").cylinders
    assert cylinders.tolist() == [[0.0, 15.0, 10.0], [15.0, 20.0, 10.0]]


def test_the_half_section_and_hull_of_a_worm_hold_its_thread(sections: Sections) -> None:
    """Whole up to the tips all round: no corner of its mesh lies outside, and the tips are reached."""
    part = parts()["worm"]
    body = part.body(0.0)
    vertices = body_mesh(body, mesh_outlines(body, 0.01, 0.0)).vertices
    made = sections.made("worm")
    assert made.half is not None
    half = shapely.Polygon(np.column_stack([made.half.real, made.half.imag]))
    radius = np.hypot(vertices[:, 0], vertices[:, 1])
    points = shapely.points(radius, vertices[:, 2])
    assert shapely.distance(half, points).max() < 1e-6
    # q 10: tips at m (q / 2 + 1), the thread 30 long, a shaft of 12 above it
    assert half.bounds[2] == pytest.approx(12.0)
    assert half.bounds[1] >= -15.5
    assert half.bounds[3] == pytest.approx(vertices[:, 2].max())
    assert half.bounds[1] == pytest.approx(vertices[:, 2].min())
    hull = made.hull
    low_x, low_y, low_z, high_x, high_y, high_z = hull.bounding_box()
    assert [low_z, high_z] == pytest.approx([vertices[:, 2].min(), vertices[:, 2].max()], abs=1e-4)
    assert min(-low_x, -low_y, high_x, high_y) >= 12.0
    whole = 2 * math.pi * half.area * half.centroid.x
    assert hull.volume() == pytest.approx(whole, rel=1e-3)
    assert hull.volume() >= whole
    assert sections.made("rod").hull is None


def test_a_worm_wheel_counts_as_a_disk_up_to_its_rim(sections: Sections) -> None:
    """Its core is known, all about that is teeth: 1 mm beyond its reach is 1 mm."""
    made = sections.made("worm_wheel")
    reach = parts()["worm_wheel"].body(0.0).section_reach()
    found = sections.between(at("rod", reach + 6.0, 0), at("worm_wheel"))
    assert found is not None
    assert found.gap == pytest.approx(1.0, abs=1e-3)
    for _, _, section in made.layers:
        assert abs(np.array(section.exterior.coords)).max() == pytest.approx(reach, rel=1e-4)
    assert sections.between(at("rod", reach - 3.0, 0), at("worm_wheel")) is None
