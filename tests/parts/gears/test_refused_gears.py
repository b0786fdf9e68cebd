"""Refusals of toothed parts as data: the key as typed, a code with a sentence, the nearest value in the key's unit."""

from __future__ import annotations

import math
from typing import Any

import pytest

from geometry.base import nearest
from parts.base.reasons import reason
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict
from tests.oracles.exact_gear import GearParameters, junction, radians, relief_corner

SPUR = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 23}
RING = {"kind": "ring_gear", "module": 2.0, "number_of_teeth": 50}
RACK = {"kind": "rack", "module": 2.0, "number_of_teeth": 8}
HELIX = {"helix_angle_deg": 20.0}
SCREWED = {**SPUR, "bore_diameter": 5.0, "face_chamfer": 0.5}
HUB = {"diameter": 14.0, "above": 7.0}
REFUSED: dict[str, tuple[dict[str, Any], str, str]] = {
    "screws and hub": ({**SCREWED, "hub": {**HUB, "set_screws": {"diameter": 8.0}}}, "hub.set_screws.diameter",
                       "set_screws_wider_than_hub"),
    "screws and bore": ({**SCREWED, "hub": {**HUB, "set_screws": {"diameter": 4.9}}}, "hub.set_screws.diameter",
                        "set_screws_wider_than_bore"),
    "screws and flat": (
        {**SCREWED, "bore_diameter": 0.0, "bore": {"shape": "D", "diameter": 5.0, "flat": 4.5},
         "hub": {**HUB, "set_screws": {"diameter": 3.2}}}, "hub.set_screws.diameter", "set_screws_wider_than_bore"),
    "screws and end": ({**SCREWED, "hub": {**HUB, "set_screws": {"diameter": 2.5, "from_end": 1.0}}},
                       "hub.set_screws.from_end", "set_screws_out_of_hub"),
    "screws and face": ({**SCREWED, "hub": {"diameter": 14.0, "below": 7.0, "set_screws": {"diameter": 2.5,
                        "from_end": 6.0}}}, "hub.set_screws.from_end", "set_screws_out_of_hub"),
    "bore of the least modules": ({**SPUR, "module": 0.011, "number_of_teeth": 10, "bore_diameter": 9.0},
                                  "bore_diameter", "reaches_root_circle"),
    "pointed": ({**SPUR, "profile_shift_coefficient": 1.9}, "profile_shift_coefficient", "tooth_pointed"),
    "pointed, helical": ({**SPUR, **HELIX, "profile_shift_coefficient": 1.9}, "profile_shift_coefficient",
                         "tooth_pointed"),
    "relief, helical": ({**SPUR, **HELIX, "tip_relief": {"depth_coefficient": 0.3, "height_coefficient": 0.1}},
                        "tip_relief.depth_coefficient", "flanks_meet_below_form"),
    "cutter corner, helical": (
        {**SPUR, **HELIX, "cutter": {"number_of_teeth": 20, "tip_rounding_coefficient": 0.9}},
        "cutter.tip_rounding_coefficient", "cutter_rounding_does_not_fit"),
    "rack corner": ({**SPUR, "basic_rack": {"tip_radius_coefficient": 0.6}}, "basic_rack.tip_radius_coefficient",
                    "rack_rounding_does_not_fit"),
    "angle": ({**SPUR, "pressure_angle_deg": 40.0}, "pressure_angle_deg", "standard_rack_pointed"),
    "chamfers": ({**SPUR, "face_chamfer": 6.0}, "face_chamfer", "chamfers_meet"),
    "chamfer of teeth": ({**SPUR, "number_of_teeth": 12, "profile_shift_coefficient": 0.7, "face_chamfer": 0.8},
                         "face_chamfer", "chamfer_leaves_nothing_of_outline"),
    "chamfer of chamfered tips": ({**SPUR, "tip_chamfer": 0.4, "face_chamfer": {"above": 1.0}}, "face_chamfer.above",
                                  "chamfer_leaves_nothing_of_outline"),
    "ring tip, helical": ({**RING, **HELIX, "tip_diameter": 90.0}, "tip_diameter", "involute_ends_at_base_circle"),
    "ring shift, helical": ({**RING, **HELIX, "profile_shift_coefficient": -4.0}, "profile_shift_coefficient",
                            "no_working_angle_with_cutter"),
    "ring shift": ({**RING, "cutter": {"number_of_teeth": 20}, "profile_shift_coefficient": -2.0},
                   "profile_shift_coefficient", "no_working_angle_with_cutter"),
    "ring cutter": ({**RING, "cutter": {"number_of_teeth": 45}}, "cutter.number_of_teeth",
                    "cutter_trochoid_interference"),
    "ring root": ({**RING, "rounded_root": {"radius_coefficient": 1.2, "full_round": False}},
                  "rounded_root.radius_coefficient", "space_rounding_does_not_fit"),
    "ring root, pointed": ({**RING, "pressure_angle_deg": 30.0, "rounded_root": {"dedendum_coefficient": 1.3,
                           "radius_coefficient": 0.0, "full_round": False}}, "rounded_root.dedendum_coefficient",
                           "space_tooth_pointed"),
    "ring root below its base": ({**RING, "profile_shift_coefficient": -4.0, "rounded_root": {
                                 "dedendum_coefficient": 0.3}}, "profile_shift_coefficient", "space_tip_below_base"),
    "ring chamfer": ({**RING, "circumferential_thinning": 1.8, "face_chamfer": {"below": 0.6}}, "face_chamfer.below",
                     "chamfer_leaves_nothing_of_outline"),
    "ring chamfer, sharp roots": (
        {**RING, "pressure_angle_deg": 25.0, "face_chamfer": 1.4, "outer_diameter": 140.0,
         "rounded_root": {"dedendum_coefficient": 1.5, "radius_coefficient": 0.0, "full_round": False}},
        "face_chamfer", "chamfer_leaves_nothing_of_outline"),
    "ring chamfers and rim": ({**RING, "outer_diameter": 108.0, "face_chamfer": 0.9}, "face_chamfer",
                              "leaves_no_face_between_edges"),
    "ring chamfers and holes": ({**RING, "holes": {"count": 6, "diameter": 4.0, "pitch_circle_diameter": 110.0},
                                "face_chamfer": 0.8}, "face_chamfer", "leaves_no_face_between_edges"),
    "ring chamfers that meet": ({**RING, "face_width": 4.0, "outer_diameter": 140.0, "face_chamfer": 2.0},
                                "face_chamfer", "chamfers_meet"),
    "ring chamfer on a steep helix": ({**RING, "helix_angle_deg": 50.0, "face_chamfer": 0.2}, "face_chamfer",
                                      "chamfer_on_steep_helix"),
    "rack tip": ({**RACK, "tip_rounding": 2.0}, "tip_rounding", "rounding_does_not_fit"),
    "rack pointed, helical": (
        {**RACK, **HELIX, "basic_rack": {"addendum_coefficient": 2.5, "tip_clearance_coefficient": 0.0}},
        "basic_rack.addendum_coefficient", "rack_pointed"),
}  # fmt: skip


def refusal(table: dict[str, Any]) -> SceneError | None:
    try:
        make_parts(scene_from_dict({"parts": {"p": table}}, "s", "s"), "s")
    except SceneError as refused:
        return refused
    return None


def with_value(table: dict[str, Any], path: str, value: Any) -> dict[str, Any]:
    key, _, rest = path.partition(".")
    return {**table, key: with_value(table[key], rest, value) if rest else value}


@pytest.mark.sampled(8)
@pytest.mark.parametrize("name", REFUSED)
def test_a_refusal_is_told_in_the_keys_of_the_scene_with_the_nearest_that_works(name: str) -> None:
    table, key, code = REFUSED[name]
    refused = refusal(table)
    assert refused is not None
    given = table
    for word in key.split("."):
        given = given[word]
    assert (refused.key, refused.code) == (f"parts.p.{key}", code)
    assert refused.value == pytest.approx(given, rel=1e-12)
    assert reason(code) != code
    found = refused.nearest
    assert found is not None
    assert refusal(with_value(table, key, found.value)) is None
    step: float = 1 if isinstance(found.value, int) else 1e-3 * max(table["module"], abs(found.value))  # type: ignore[arg-type]
    farther = found.value + (step if found.side == "at_most" else -step)  # type: ignore[operator]
    assert refusal(with_value(table, key, farther)) is not None


def test_a_hub_ends_where_holes_begin() -> None:
    holes = [{"count": 6, "pitch_circle_diameter": 40.0, "diameter": 10.0}]
    hub = {"diameter": 34.0, "below": 5.0}
    refused = refusal({**SPUR, "number_of_teeth": 40, "bore_diameter": 10.0, "hub": hub, "holes": holes})
    assert refused is not None
    assert refused.nearest is not None
    assert 29.9 < refused.nearest.value < 30.0  # type: ignore[operator]


def test_a_search_is_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    """No search of a refusal tries more values than it may, whatever is wrong."""
    tried: list[int] = []
    search = nearest.nearest

    def counted(holds: Any, *rest: Any, **more: Any) -> Any:
        tried.append(0)

        def one(value: float) -> bool:
            tried[-1] += 1
            return bool(holds(value))

        return search(one, *rest, **more)

    for home in ("geometry.gears.teeth.limits", "geometry.gears.teeth.ring_limits", "parts.gears.spur_gear.part",
                 "parts.keys.holes", "parts.scene.checks", "parts.base.offers"):  # fmt: skip
        monkeypatch.setattr(f"{home}.nearest", counted)
    for table, *_ in REFUSED.values():
        refused = refusal(table)
        assert refused is not None
        assert refused.nearest is not None
    assert tried
    assert max(tried) <= nearest.MOST_TRIALS


@pytest.mark.parametrize(("own", "cutters", "blamed"), [(0.0, -1.0, "cutter."), (-2.0, 0.0, ""), (-2.0, -1.0, "")])
def test_of_two_shifts_without_a_cut_the_larger_is_blamed(own: float, cutters: float, blamed: str) -> None:
    cutter = {"number_of_teeth": 23, "profile_shift_coefficient": cutters}
    refused = refusal({**SPUR, "profile_shift_coefficient": own, "cutter": cutter})
    assert refused is not None
    assert (refused.key, refused.value) == (f"parts.p.{blamed}profile_shift_coefficient", cutters if blamed else own)


@pytest.mark.heavy
def test_a_relief_leaves_no_flank_that_crosses_it_below_the_form_circle() -> None:
    """Of an undercut gear: refused from the height on at which both crossings are on one circle, to 50 digits."""
    low, high = 0.8, 1.0
    for _ in range(18):
        middle = (low + high) / 2
        exact = GearParameters(5, 2, radians(20), 1, "0.25", "0.38", "-0.2", relief_depth="0.01", relief_height=middle)
        above = abs(relief_corner(exact)[2]) > abs(junction(exact).point)
        low, high = (middle, high) if above else (low, middle)
    teeth = {**SPUR, "number_of_teeth": 5, "profile_shift_coefficient": -0.2}
    for height, code in ((low - 1e-6, None), (high + 1e-6, "relief_leaves_no_flank")):
        refused = refusal({**teeth, "tip_relief": {"depth_coefficient": 0.01, "height_coefficient": height}})
        assert (refused and (refused.key, refused.code)) == (code and ("parts.p.tip_relief.depth_coefficient", code))


@pytest.mark.parametrize(("angle", "code"), [(1.0, "worm_flank_above_reference"), (5.0, "worm_flank_above_root")])
def test_of_a_thread_that_a_small_wheel_grinds_it_is_told_where_its_flank_begins(angle: float, code: str) -> None:
    """Above the reference cylinder there is none to be measured; either way more q cures it."""
    worm = {"kind": "worm", "module": 2.0, "thread_length": 30.0, "diameter_quotient": 3.0, "pressure_angle_deg": angle}
    refused = refusal({**worm, "form": "ZK1", "grinding_wheel_diameter": 12.0})
    assert refused is not None
    assert (refused.key, refused.code) == ("parts.p.diameter_quotient", code)
    found = refused.nearest
    assert found is not None
    assert found.side == "at_least"
    assert refusal({**worm, "form": "ZK1", "grinding_wheel_diameter": 12.0, "diameter_quotient": found.value}) is None


def test_a_chamfered_face_has_room_for_digits_as_one_that_ends_where_its_chamfers_begin() -> None:
    """0.4 mm less at the bore and at the root, where the rack's clearance of 0.25 + 0.2 modules makes as much."""
    mark = {"tooth_mark": {"depth": 0.4, "height": 20.0}}
    chamfered = {"bore_diameter": 10.0, "face_chamfer": {"above": 0.4}}
    narrow = {"bore_diameter": 10.8, "basic_rack": {"tip_clearance_coefficient": 0.45}}
    most = []
    for keys in (chamfered, narrow):
        refused = refusal({**SPUR, **keys, **mark})
        assert refused is not None
        assert (refused.key, refused.code) == ("parts.p.tooth_mark.height", "no_room_for_digits")
        assert refused.nearest is not None
        most.append(refused.nearest.value)
    assert most[0] == pytest.approx(most[1], rel=1e-9)


def room(**screws: float) -> tuple[str, float, str] | None:
    """The key of screws of 2.5 mm in a bore of 5 mm, and hub of 14 mm, that is refused, and what would work."""
    refused = refusal({**SCREWED, "hub": {**HUB, "set_screws": {"diameter": 2.5, **screws}}})
    if refused is None:
        return None
    assert refused.code == "set_screws_meet"
    found = refused.nearest
    return refused.key.rpartition(".")[2], 0.0 if found is None else found.value, "" if found is None else found.side


@pytest.mark.parametrize(
    ("given", "turned", "side"),
    [(20.0, 0.0, "at_least"), (0.0, 0.0, "at_least"), (340.0, 360.0, "at_most"), (-20.0, 0.0, "at_most")],
)
def test_holes_that_meet_are_told_how_far_apart_they_have_room(given: float, turned: float, side: str) -> None:
    """Each takes asin(r / R) of the bore to either side, and half of a wall of 0.5 % of the hub's radius, 0.035 mm."""
    step = 2 * math.degrees(math.asin(1.25 / 2.5) + 0.035 / 2.5 / 2)
    least = turned + step if (turned == 0) == (given >= 0) else turned - step
    told = room(count=2, spacing_deg=given)
    assert told == ("spacing_deg", pytest.approx(least, abs=1e-4), side)
    assert room(count=2, spacing_deg=told[1]) is None
    assert room(count=2, spacing_deg=least + (-1e-6 if side == "at_least" else 1e-6)) is not None


@pytest.mark.parametrize(("spacing", "most"), [(90.0, 4), (120.0, 3), (61.0, 5), (180.0, 2), (75.0, 4)])
def test_holes_that_meet_are_told_how_many_have_room(spacing: float, most: int) -> None:
    """As many as come round before one is nearer than 60.8 degrees to another."""
    assert room(count=12, spacing_deg=spacing) == ("count", most, "at_most")
    assert room(count=most, spacing_deg=spacing) is None
    assert room(count=most + 1, spacing_deg=spacing) is not None


def test_a_mill_is_told_to_leave_corners_of_windows_and_bores() -> None:
    """Told of fillets alone: a square bore or a window of smaller corners came out with material in them."""
    spokes = {"count": 4, "inner_diameter": 16.0, "outer_diameter": 30.0, "width": 4.0, "corner_radius": 1.0}
    bore = {"shape": "square", "across_flats": 6.0, "corner_radius": 0.5}
    scene = {"parts": {"p": {**SPUR, "number_of_teeth": 30, "spokes": spokes, "bore": bore}}}
    part = make_parts(scene_from_dict(scene, "s", "s"), "s")[0]["p"]
    for offset, corners in ((0.4, []), (0.6, [0.5]), (1.2, [1.0, 0.5])):
        told = [f for f in part.section(offset).findings if f.code.startswith("corners_of_")]
        assert [(f.value, f.limit) for f in told] == [(offset, radius) for radius in corners]
