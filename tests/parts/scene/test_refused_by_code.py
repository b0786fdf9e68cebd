"""Refusals that no other test meets: each by its code and key, and what it offers builds, its limit being one."""

from __future__ import annotations

from typing import Any

import pytest

from exporters.documents.topics import sheet_of
from parts.base.refusal import SceneError
from tests.offered import GONE, Raw, put, scenes
from tests.parts.scene.test_offers import judged, place_of, refusal_of

LAYER: Raw = {"kind": "layered", "layers": [{"thickness": 4.0, "circles": [{"diameter": 30.0}]}]}
PLATE: Raw = {"kind": "plate", "width": 60.0, "height": 40.0, "face_width": 4.0}
DISK: Raw = {
    "kind": "turned",
    "points": [{"r": r, "z": z} for r, z in ((5.0, 0.0), (30.0, 0.0), (30.0, 8.0), (5.0, 8.0))],
}
SHAFT: Raw = {"kind": "shaft", "steps": [{"diameter": 20.0, "length": 40.0, "keyways": [{"at": 5.0, "length": 20.0}]}]}
RING: Raw = {
    "kind": "pin_ring",
    "number_of_pins": 12,
    "pin_circle_diameter": 80.0,
    "pin_diameter": 8.0,
    "pins": "holes",
}
OUTPUT: Raw = {"kind": "output_plate", "number_of_pins": 6, "pin_diameter": 6.0, "pin_circle_diameter": 56.0,
               "outer_diameter": 70.0, "bore_diameter": 10.0, "pins": "holes"}  # fmt: skip
OVAL: Raw = {"kind": "noncircular_gear", "centrode": "oval", "axis_ratio": 1.2, "number_of_teeth": 18, "module": 2.0}
SPUR: Raw = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20}
OWN: dict[str, Raw] = {"layers": LAYER, "plate": PLATE, "disk": DISK, "shaft": SHAFT, "ring": RING, "output": OUTPUT,
                       "oval": OVAL, "spur": SPUR}  # fmt: skip
WAY = "parts.p.steps[1].keyways[1]"
PHASES = "parts.p.phases"
# scene, its changed keys, the refusal's key and code
CASES: list[tuple[str, dict[str, Any], str, str]] = [
    ("layers", {"parts.p.layers[1].slots": [{"start": [0.0, 0.0], "end": [0.0, 0.0], "width": 2.0}]},
     "parts.p.layers[1].slots[1].end", "slot_ends_at_start"),
    ("layers", {"parts.p.layers[1].polygons": [{"points": [[0.0, 0.0], [9.0, 0.0], [9.0, 0.0], [0.0, 9.0]]}]},
     "parts.p.layers[1].polygons[1].corner_radius", "roundings_meet"),
    ("plate", {"parts.p.slots": [{"start": [1.0, 0.0], "end": [1.0, 0.0], "width": 2.0}]}, "parts.p.slots[1].end",
     "slot_ends_at_start"),
    ("disk", {"parts.p.holes": [{"count": 4, "diameter": 12.0, "pitch_circle_diameter": 15.0}]}, "parts.p.holes",
     "hole_reaches_edge"),
    ("shaft", {"parts.p.bore_diameter": 6.0, "parts.p.centre_holes": {"diameter": 2.0}}, "parts.p.bore_diameter",
     "either_key"),
    ("shaft", {f"{WAY}.depth": 10.0}, f"{WAY}.depth", "keyway_of_no_depth"),
    ("shaft", {f"{WAY}.depth": 0.4}, f"{WAY}.depth", "keyway_of_no_depth"),
    ("shaft", {f"{WAY}.length": 5.0}, f"{WAY}.length", "keyway_shorter_than_wide"),
    ("shaft", {f"{WAY}.at": 20.5}, f"{WAY}.at", "keyway_beyond_step"),
    ("shaft", {"parts.p.steps[1].keyways": [{"at": 5.0, "length": 20.0}, {"at": 5.0, "length": 20.0,
     "angle_deg": 120.0}]},
     "parts.p.steps[1].keyways[2].angle_deg", "keyways_meet"),
    ("end barrel", {"parts.p.clearance": 0.1}, "parts.p.clearance", "end_without_play"),
    ("end barrel", {"parts.p.web_thickness": 40.0}, "parts.p.web_thickness", "web_reaches_track"),
    ("end barrel", {"parts.p.hub.diameter": 8.0}, "parts.p.hub.diameter", "no_wall_around_bore"),
    ("end barrel", {"parts.p.bore_diameter": 60.0}, "parts.p.bore_diameter", "no_wall_to_floor"),
    ("barrel", {"parts.p.bore_diameter": 54.0}, "parts.p.bore_diameter", "no_wall_to_floor"),
    ("barrel", {"parts.p.length": 28.2}, "parts.p.length", "groove_needs_length"),
    ("barrel", {"parts.p.web_thickness": 3.0}, "parts.p.web_thickness", "for_end_only"),
    ("barrel", {"parts.p.cone_angle_deg": 10.0}, "parts.p.cone_angle_deg", "for_conical_only"),
    ("barrel", {"parts.p.end_margin": 10.0}, "parts.p.end_margin", "follows_from"),
    ("swinging barrel", {"parts.p.oscillating.start_angle_deg": 80.0}, "parts.p.oscillating.start_angle_deg",
     "arm_along_axis"),
    ("swinging roller", {"parts.p.follower_offset": 3.0}, "parts.p.follower_offset", "arm_has_no_offset"),
    ("swinging roller", {"parts.p.oscillating.face_offset": 3.0}, "parts.p.oscillating.face_offset", "for_flat_only"),
    ("swinging roller", {"parts.p.oscillating.centre_distance": GONE}, "parts.p.oscillating.centre_distance",
     "distance_missing"),
    ("swinging roller", {"parts.p.base_circle_radius": GONE}, "parts.p.base_circle_radius", "base_circle_missing"),
    ("swinging flat", {"parts.p.base_circle_radius": GONE}, "parts.p.base_circle_radius", "base_circle_missing_of_arm"),
    ("swinging mushroom", {"parts.p.plate_diameter": 30.0}, "parts.p.plate_diameter", "for_faces_only"),
    ("mushroom stem", {"parts.p.follower_radius": GONE}, "parts.p.follower_radius", "follower_without_radius"),
    ("new follower", {"parts.p.stem_length": 3.0}, "parts.follower.stem_length", "shorter_than_half_width"),
    # what was left out is not to blame
    ("new follower", {"parts.p.stem_width": 170.0}, "parts.follower.stem_width", "wider_than_twice_length"),
    ("cut gear", {"parts.p.pressure_angle_deg": 30.0}, "parts.p.pressure_angle_deg", "cutter_tooth_pointed"),
    ("new carrier_plate", {"parts.p.boss_diameter": 1.0}, "parts.carrier_plate.pin_diameter", "no_wall_in_boss"),
    ("flat arm", {"parts.p.pin_diameter": 3.0}, "parts.p.pin_diameter", "for_other_ends"),
    ("table", {"parts.p.phases": [{"move": "rise", "angle_deg": 360.0, "law": "sine"}]}, "parts.p.phases",
     "phases_or_table"),
    ("table", {"parts.p.lift": 3.0}, "parts.p.lift", "lift_in_table"),
    ("pointed", {"parts.p.lift": 0.0}, "parts.p.lift", "no_lift"),
    ("pointed", {f"{PHASES}[2].law": "sine"}, f"{PHASES}[2].law", "dwell_with_law"),
    ("pointed", {f"{PHASES}[1].law": GONE}, f"{PHASES}[1].law", "law_missing"),
    ("pointed", {f"{PHASES}[3].move": "rise"}, f"{PHASES}[4].move", "does_not_come_back"),
    ("wedge", {"parts.p.follower": "flat"}, "parts.p.follower", "flat_on_wedge"),
    ("wedge", {"parts.p.run_in": 1.0}, "parts.p.run_in", "no_room_for_corner"),
    ("wedge", {"parts.p.base_height": 0.5}, "parts.p.corner_radius", "no_room_in_plate"),
    ("wedge", {"parts.p.corner_radius": 30.0}, "parts.p.corner_radius", "no_room_in_plate"),
    ("ring", {"parts.p.seat_clearance": -3.0}, "parts.p.seat_clearance", "leaves_no_seat"),
    ("ring", {"parts.p.inner_diameter": 79.0}, "parts.p.inner_diameter", "inside_reaches_pin_holes"),
    ("output", {"parts.p.seat_clearance": -2.0}, "parts.p.seat_clearance", "leaves_no_hole"),
    ("output", {"parts.p.seat_clearance": 12.0, "parts.p.outer_diameter": 120.0}, "parts.p.seat_clearance",
     "holes_touch_each_other"),
    ("oval", {"parts.p.centre_distance": 40.0}, "parts.p.module", "either_key"),
    ("oval", {"parts.p.eccentricity": 0.2}, "parts.p.axis_ratio", "either_key"),
    ("oval", {"parts.p.ratio_cosines": [0.1]}, "parts.p.ratio_cosines", "not_of_this_centrode"),
    ("oval", {"parts.p.bore_diameter": 8.0, "parts.p.bore": {"shape": "square", "across_flats": 8.0}},
     "parts.p.bore_diameter", "either_key"),
    ("oval", {"parts.p.axis_ratio": 3.0}, "parts.p.axis_ratio", "centrode_concave"),
    ("new worm_wheel", {"parts.p.outer_diameter": 10.0}, "parts.worm_wheel.outer_diameter", "within_throat"),
    ("new cycloidal_disc", {"parts.p.eccentricity": 30.0}, "parts.cycloidal_disc.eccentricity", "pin_paths_have_loops"),
    ("conjugate", {"parts.b.holes": [{"count": 2, "diameter": 6.0, "pitch_circle_diameter": 200.0}]},
     "parts.b.holes[1].pitch_circle_diameter", "holes_beyond_base_circle"),
    ("cam and arm", {"parts.b.arm_length": 71.0}, "mates[1]: parts.b.arm_length", "cam_has_another"),
    ("spur", {"parts.p.cutter": {"number_of_teeth": 20}, "parts.p.basic_rack": {"tip_clearance_coefficient": 0.3}},
     "parts.p.basic_rack.tip_clearance_coefficient", "made_by_cutter"),
    ("spur", {"boards.a": {"width": 100.0, "height": 100.0, "thickness": 3.0, "parts": ["p", "p"]}}, "boards.a.parts",
     "listed_twice"),
]  # fmt: skip


# what a scene of one gear has besides, the refusal's key and code
SCENES: list[tuple[Raw, str, str]] = [
    ({"mates": [3]}, "mates[1]", "not_a_list"),
    ({"assemblies": [3]}, "assemblies[1]", "not_a_list"),
    ({"parts": {"p": SPUR, "P": SPUR}}, "parts.p", "same_but_for_case"),
    ({"parts": {"con": SPUR}}, "parts.con", "device_name"),
    ({"parts": {"a b": SPUR}}, "parts.a b", "not_a_name"),
    ({"boards": {"a b": {"width": 100.0, "height": 100.0, "thickness": 3.0}}}, "boards.a b", "not_a_name"),
    ({"exports": [{"format": "stl", "kerf": 0.2}]}, "exports[1].kerf", "kerf_of_a_print"),
    ({"exports": [{"format": "svg", "purpose": "board"}]}, "exports[1].purpose", "no_boards"),
    ({"mates": [{"kind": "parallel", "first": "p", "second": "p"}]}, "mates[1].second", "mate_in_itself"),
    ({"mates": [{"kind": "parallel", "first": "p", "second": "q"}]}, "mates[1].second", "no_such_instance"),
    ({"parts": {"p": SPUR, "q": SPUR}, "mates": [{"kind": "parallel", "first": "p", "second": "q", "module": 2.0}]},
     "mates[1].module", "key_of_a_part"),
    ({"parts": {"p": {"kind": "rack", "module": 2.0, "number_of_teeth": 9}, "q": SPUR}, "mates": [{"kind": "rack_pair",
      "first": "p", "second": "q"}]}, "mates[1].first", "mate_joins_swapped"),
]  # fmt: skip
# words of calc, the key and the code
WORDS: list[tuple[str, str, str]] = [
    ("spur module.a=2", "spur.module", "wrong_type_of"),
    ("spur module=2 module.a=3 number_of_teeth=20", "module.a", "has_a_value"),
    ("spur module=2 number_of_teeth=20 part=p", "part", "part_without_scene"),
    ("worm module=2 number_of_teeth=40 power=100", "worm.power", "needs_other"),
    ("worm module=2 number_of_teeth=40 power=100 torque=3", "worm.power", "other_is_given"),
    ("worm module=2 number_of_teeth=40 wheel_torque=100 torque=3", "worm.wheel_torque", "other_is_given"),
    ("worm module=2 friction_coefficient=0.1", "worm.number_of_teeth", "worm_wheel_missing"),
    ("gear-pair module=2 first.number_of_teeth=13 second.number_of_teeth=90 shifts=practicum", "gear-pair.shifts",
     "not_in_table"),
    ("gear-pair module=2 first.number_of_teeth=13 second.number_of_teeth=21 shifts=practicum "
     "first.profile_shift_coefficient=0", "gear-pair.shifts", "other_is_given"),
    ("gear-pair module=2 first.number_of_teeth=13 second.number_of_teeth=21 shifts=practicum "
     "pressure_angle_deg=25", "gear-pair.shifts", "other_is_given"),
    ("lever first=slider crank_length=50 coupler_length=200 speed=3 speed_rpm=30", "lever.speed_rpm", "other_is_given"),
    ("gear-pair second.kind=ring", "gear-pair.second.kind", "not_one_of"),
    ("shift-choice kind=rack_pair", "shift-choice.kind", "unknown_pair"),
    ("power-module groove_radius=2", "power-module.groove_radius", "groove_below_ball"),
    ("power-table path=[]", "power-table.path", "no_path"),
    ("power-table path=[[1,2,1,2,0]]", "power-table.path", "piece_is_a_point"),
    ("power-table path=[[50,80,60,90,0]] x=3", "power-table.x", "either_of"),
    ("power-table x=10 y=80 picture=a.png", "power-table.picture", "file_ends_in"),
    ("train teeth=[20,40] meshes=1-2 driver=1 driven=1", "train.driven", "driven_is_driver"),
    ("train teeth=[20,40] meshes=1+2", "train.meshes", "write_mesh"),
    ("train teeth=[20,40] meshes=1-3", "train.meshes", "no_such_wheel"),
    ("train meshes=1-2", "train.teeth", "missing_key"),
    ("train meshes=1-1", "train.meshes", "rolls_on_itself"),
    # no such word, quoted or not
    ("worm module=2 form=5", "worm.form", "wrong_type_of"),
    ("sprocket chain=41.5 number_of_teeth=17", "sprocket.chain", "no_such_chain"),
    ("train teeth=[20,40] meshes=1-2 held=7", "train.held", "no_such_link"),
    ("train teeth=[20,40] meshes=1-2 carriers.1=1", "train.carriers.1", "stands_on_itself"),
    ("train teeth=[20,40] meshes=1-1", "train.meshes", "rolls_on_itself"),
    ("train teeth=[20,40,20] meshes=1-2 carriers.H=3", "train.carriers.H", "carrier_without_satellites"),
    ("gear-pair module=2 first.number_of_teeth=20", "gear-pair.second.number_of_teeth", "missing_key"),
]  # fmt: skip


def scene(name: str, changes: dict[str, Any]) -> Raw:
    raw = {"parts": {"p": OWN[name]}, "exports": [{"format": "svg"}]} if name in OWN else scenes()[name]
    own = next(iter(raw["parts"]))
    for key, value in changes.items():
        place = place_of(key)
        raw = put(raw, (place[0], own, *place[2:]) if place[1] == "p" else place, value)
    return raw


@pytest.mark.parametrize(("name", "changes", "key", "code"), CASES)
def test_each_refusal_names_its_key_and_offers_what_builds(
    name: str, changes: dict[str, Any], key: str, code: str
) -> None:
    assert refusal_of(scene(name, {})) is None
    refusal = refusal_of(raw := scene(name, changes))
    assert refusal is not None
    assert (refusal.key, refusal.code) == (key, code)
    assert judged(raw, refusal) == []


@pytest.mark.parametrize(("changes", "key", "code"), SCENES)
def test_what_is_wrong_in_a_scene_is_named(changes: Raw, key: str, code: str) -> None:
    refusal = refusal_of({"parts": {"p": SPUR}, "exports": [{"format": "svg"}]} | changes)
    assert refusal is not None
    assert (refusal.key, refusal.code) == (key, code)


@pytest.mark.parametrize(("words", "key", "code"), WORDS)
def test_what_is_wrong_in_words_of_calc_is_named(words: str, key: str, code: str) -> None:
    topic, *rest = words.split()
    with pytest.raises(SceneError) as caught:
        sheet_of(topic, rest)
    assert (caught.value.key, caught.value.code) == (key, code)
