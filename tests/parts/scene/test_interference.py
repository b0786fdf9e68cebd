"""Solids against solids: what runs into what, judged by volumes known beforehand and by polygons of GEOS."""

from __future__ import annotations

import math
from typing import Any

import pytest

from parts.scene.interference import INSET, common_volume, inner_solid, solid_overlaps
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import place

DISK = {"kind": "spur_gear", "module": 1.0, "number_of_teeth": 40}
SUN = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20}
WHEEL = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 30}
MATE = {"kind": "external_gear_pair", "first": "a", "second": "b"}


def overlaps(parts: dict[str, Any], instances: dict[str, Any] | None = None, mates: tuple[Any, ...] = ()) -> Any:
    """Names and volumes of all overlaps of a scene."""
    raw = {"parts": parts, "instances": instances or {}, "mates": list(mates)}
    file = scene_from_dict(raw, "test", "test")
    made, matings = make_parts(file, "test")
    stand = place(file.instances, file.drives, made, matings, "test")
    return {(o.first, o.second): o.volume for o in solid_overlaps(stand, made)}


def test_gears_in_mesh_do_not_overlap_and_half_a_pitch_off_they_do() -> None:
    assert overlaps({"a": SUN, "b": WHEEL}, mates=(MATE,)) == {}
    placed = {"a": {"at": [0, 0, 0]}, "b": {"at": [50, 0, 0], "rotation_deg": 180 / 30}}
    assert overlaps({"a": SUN, "b": WHEEL}, placed) == {}
    found = overlaps({"a": SUN, "b": WHEEL}, {**placed, "b": {"at": [50, 0, 0]}})
    assert found[("a", "b")] > 20


def test_a_hub_that_runs_into_a_mate_is_found_though_the_teeth_are_right() -> None:
    hub = {**SUN, "hub": {"diameter": 30, "above": 8}}
    beside = {"a": hub, "b": WHEEL, "c": WHEEL}
    # c lies above b, where only the hub of a reaches
    found = overlaps(beside, {"a": {"at": [0, 0, 0]}, "b": {"at": [50, 0, 0], "rotation_deg": 6},
                              "c": {"at": [40, 0, 12]}})  # fmt: skip
    assert set(found) == {("a", "c")}


def test_a_gear_within_a_bore_is_clear_until_it_touches_the_wall() -> None:
    ring = {**WHEEL, "number_of_teeth": 80, "bore_diameter": 60}
    small = {**SUN, "number_of_teeth": 17}
    assert overlaps({"a": ring, "b": small}, {"a": {"at": [0, 0, 0]}, "b": {"at": [10.9, 0, 0]}}) == {}
    assert overlaps({"a": ring, "b": small}, {"a": {"at": [0, 0, 0]}, "b": {"at": [11.5, 0, 0]}})


@pytest.mark.parametrize("width", [60.0, 300.0, 1200.0])
def test_a_pin_too_thick_for_a_hole_is_found_in_a_frame_of_any_length(width: float) -> None:
    """0.02 mm of the diameter, a ring of 0.755 mm^3; what was taken off a frame grew with its length."""
    hole = {"at": [width / 2 - 10.0, 0.0], "diameter": 6.0}
    frame = {"kind": "plate", "width": width, "height": 20.0, "holes": [hole], "face_width": 4.0}
    stands = {"frame": {"at": [0.0, 0.0, 0.0]}, "pin": {"at": [*hole["at"], -8.0]}}
    pin = {"kind": "pin", "diameter": 6.02, "length": 20.0}
    found = overlaps({"frame": frame, "pin": pin}, stands)[("frame", "pin")]
    assert 0.5 < found / (math.pi * (3.01**2 - 3.0**2) * 4.0) < 1.0
    assert overlaps({"frame": frame, "pin": pin | {"diameter": 6.0}}, stands) == {}


def test_coaxial_disks_share_the_common_height() -> None:
    found = overlaps({"a": DISK, "b": DISK}, {"a": {"at": [0, 0, 0]}, "b": {"at": [0, 0, 4]}})
    section = make_parts(scene_from_dict({"parts": {"a": DISK}}, "t", "t"), "t")[0]["a"].to_trimesh(0.001).volume / 10
    assert found[("a", "b")] == pytest.approx(section * 6, rel=5e-3)
    assert overlaps({"a": DISK, "b": DISK}, {"a": {"at": [0, 0, 0]}, "b": {"at": [0, 0, 10]}}) == {}


def test_the_volume_is_that_of_another_library() -> None:
    placed = {"a": {"at": [0, 0, 0]}, "b": {"at": [47, 3, 2], "rotation_deg": 11}}
    found = overlaps({"a": SUN, "b": WHEEL}, placed)[("a", "b")]
    parts = make_parts(scene_from_dict({"parts": {"a": SUN, "b": WHEEL}}, "t", "t"), "t")[0]
    shapely = pytest.importorskip("shapely")
    from shapely import affinity

    from geometry.approximation.chords import approximate_profile

    areas = []
    for key in ("a", "b"):
        points, _ = approximate_profile(parts[key].section(0.0).region.outer, 0.001, arcs=False).geometry.expanded()
        areas.append(shapely.Polygon(list(zip(points.real, points.imag, strict=True))))
    turned = affinity.translate(affinity.rotate(areas[1], 11, origin=(0, 0)), 47, 3)
    common = areas[0].intersection(turned).area * 8
    assert math.isclose(found, common, rel_tol=0.05)


def test_a_turned_body_is_looked_at_a_little_within_its_surface() -> None:
    """A cylinder whose every face has gone in by the same little."""
    rod = {"kind": "shaft", "steps": [{"diameter": 20.0, "length": 30.0}]}
    part = make_parts(scene_from_dict({"parts": {"a": rod}}, "t", "t"), "t")[0]["a"]
    inset = INSET * part.body(0.0).section_reach()
    found = inner_solid(part).volume()
    assert math.pi * (10 - 2 * inset) ** 2 * (30 - 4 * inset) < found < math.pi * (10 - inset) ** 2 * (30 - 2 * inset)


def test_a_land_that_nothing_can_be_taken_off_costs_no_fine_mesh() -> None:
    """Between two chamfers the rim keeps 2e-5 mm: what stood within all of that had 144 378 vertices an outline."""
    web = {"thickness": 3.881, "rim_diameter": 29.2999}
    gear = SUN | {"number_of_teeth": 18, "face_width": 6.0, "bore_diameter": 6.0, "face_chamfer": {"below": 0.4}}
    part = make_parts(scene_from_dict({"parts": {"g": gear | {"web": web}}}, "t", "t"), "t")[0]["g"]
    solid, true = inner_solid(part), part.to_trimesh(1e-3).volume
    assert solid.num_tri() < 50_000
    assert 0.995 * true < solid.volume() < true


def test_pairs_as_far_apart_in_another_direction_or_height_do_not_stand_alike() -> None:
    """A bar of 40 by 10 by 3 and a tile of 8: 8 along the bar they share 8 x 8 x 3 mm^3, two thirds of it 1 mm above
    that, and 8 across an eighth, as the bar ends 1 mm within the tile.
    """
    parts = {
        "bar": {"kind": "plate", "width": 40.0, "height": 10.0, "face_width": 3.0},
        "tile": {"kind": "plate", "width": 8.0, "height": 8.0, "face_width": 3.0},
    }
    ways = {"along": [8.0, 0.0, 0.0], "across": [0.0, 8.0, 0.0], "above": [8.0, 0.0, 1.0]}
    shared = {"along": 192.0, "across": 24.0, "above": 128.0}
    for order in (("along", "across", "above"), ("above", "across", "along")):
        placed: dict[str, Any] = {}
        for k, name in enumerate(order):
            x, y, z = ways[name]
            placed |= {f"bar_{name}": {"part": "bar", "at": [100.0 * k, 0.0, 0.0]},
                       f"tile_{name}": {"part": "tile", "at": [100.0 * k + x, y, z]}}  # fmt: skip
        told = {(f"bar_{name}", f"tile_{name}"): pytest.approx(shared[name], rel=0.02) for name in order}
        assert overlaps(parts, placed) == told


def test_pairs_that_stand_alike_are_held_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """A row in which each is turned on by its own angle; one that stands otherwise is another pair."""
    held = []

    def common(pair: Any) -> float:
        held.append(pair)
        return common_volume(pair)

    monkeypatch.setattr("parts.scene.interference.common_volume", common)
    turned = {f"g{k}": {"part": "a", "rotation_deg": 90.0 * k, "at": at}
              for k, at in enumerate([[0, 0, 0], [39, 0, 0], [39, 39, 0], [0, 39, 0]])}  # fmt: skip
    found = overlaps({"a": SUN}, turned)
    assert len(found) == 4
    # 20 teeth look alike at right angles: all are alike but for the sense in which two are told
    assert len(held) == 2
    assert max(found.values()) == pytest.approx(min(found.values()), rel=1e-6)
    other = overlaps({"a": SUN}, turned | {"g3": {"part": "a", "at": [0, 38, 0]}})
    assert other[("g0", "g3")] > 1.05 * found[("g0", "g3")]
    assert other[("g0", "g1")] == found[("g0", "g1")]
