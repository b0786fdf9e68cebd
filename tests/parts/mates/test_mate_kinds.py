"""Internal and rack mates, wanted distances and backlash: places by polygons of GEOS, refusals in one line."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import shapely
import shapely.affinity

from geometry.approximation.chords import approximate_profile
from geometry.base.errors import Nearest
from parts.base.part import Part
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import place
from parts.scene.standing import Instance

RING = {"kind": "ring_gear", "module": 2.0, "number_of_teeth": 60}
SUN = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20}
WHEEL = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 31, "profile_shift_coefficient": 0.2}
RACK = {"kind": "rack", "module": 2.0, "number_of_teeth": 11}


def scene(parts: dict[str, Any], *mates: dict[str, Any], instances: dict[str, Any] | None = None) -> Any:
    """Parts and where they stand."""
    raw = {"parts": parts, "mates": list(mates), "instances": instances or {}}
    file = scene_from_dict(raw, "test", "test")
    made, matings = make_parts(file, "test")
    return made, matings, place(file.instances, file.drives, made, matings, "test")


def polygon(part: Part, instance: Instance, extra: float = 0.0) -> shapely.Polygon:
    """The section of an instance, chords within 2 um, turned ``extra`` rad more."""
    region = part.section(0.0).region
    rings = []
    for profile in (region.outer, *region.holes):
        points, _ = approximate_profile(profile, 0.002, arcs=False).geometry.expanded()
        points = points * np.exp(1j * (instance.rotation + extra)) + instance.centre
        rings.append(np.stack([points.real, points.imag], axis=1))
    return shapely.Polygon(rings[0], rings[1:])


def overlap(made: dict[str, Part], stand: Any, first: str, second: str, extra: float = 0.0) -> tuple[float, float]:
    """Common area, mm^2, and least distance, mm, of two instances; the second turned more."""
    by_id = {i.id: i for i in stand.instances}
    one, two = (polygon(made[by_id[k].part], by_id[k], e) for k, e in ((first, 0.0), (second, extra)))
    return one.intersection(two).area, one.distance(two)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("direction", [0.0, 33.0, -120.0])
@pytest.mark.parametrize("ring_first", [True, False])
def test_a_pinion_stands_in_its_ring_in_either_order(direction: float, ring_first: bool) -> None:
    first, second = ("ring", "sun") if ring_first else ("sun", "ring")
    mate = {"kind": "internal_gear_pair", "first": first, "second": second, "direction_deg": direction}
    made, _, stand = scene({"ring": RING, "sun": SUN}, mate)
    assert abs(stand.instances[0].centre - stand.instances[1].centre) == pytest.approx(40.0, rel=1e-12)
    area, distance = overlap(made, stand, first, second)
    assert area < 2e-3
    assert distance < 0.004
    assert overlap(made, stand, first, second, extra=math.pi / (20 if ring_first else 60))[0] > 1.0


@pytest.mark.parametrize("teeth", [10, 11])
@pytest.mark.parametrize("direction", [-90.0, 25.0])
def test_a_rack_stands_under_its_gear(teeth: int, direction: float) -> None:
    mate = {"kind": "rack_pair", "first": "wheel", "second": "rack", "direction_deg": direction}
    made, matings, stand = scene({"wheel": WHEEL, "rack": {**RACK, "number_of_teeth": teeth}}, mate)
    assert matings[0].distance == pytest.approx(31.4, rel=1e-12)
    area, distance = overlap(made, stand, "wheel", "rack")
    assert area < 2e-3
    assert distance < 0.004
    assert overlap(made, stand, "rack", "wheel", extra=math.pi / 31)[0] > 1.0


@pytest.mark.sampled(1)
@pytest.mark.parametrize("kind", ["internal_gear_pair", "rack_pair", "external_gear_pair"])
def test_a_wanted_backlash_thins_both_by_half(kind: str) -> None:
    parts = {"internal_gear_pair": (RING, SUN), "rack_pair": (WHEEL, RACK), "external_gear_pair": (SUN, WHEEL)}[kind]
    mate = {"kind": kind, "first": "a", "second": "b", "normal_backlash": 0.1}
    made, matings, stand = scene({"a": parts[0], "b": parts[1]}, mate)
    assert matings[0].normal_backlash == pytest.approx(0.1, rel=1e-9)
    found = matings[0].contact(0.0, 0.0, None)
    # the corner of a standard rack just reaches where the thinned gear's fillet begins
    assert found.worst.gap == pytest.approx(0.05, abs=5e-4 if kind == "rack_pair" else 1e-9)
    assert overlap(made, stand, "a", "b")[1] == pytest.approx(0.05, abs=0.005)


def test_a_part_that_sets_its_own_thinning_keeps_it() -> None:
    mate = {"kind": "external_gear_pair", "first": "a", "second": "b", "normal_backlash": 0.1}
    made, matings, _ = scene({"a": {**SUN, "circumferential_thinning": 0.03}, "b": WHEEL}, mate)
    total = 0.1 / math.cos(math.radians(20))
    thickness = [made[k].quantities["tooth_thickness"] for k in "ab"]
    plain = [make_parts(scene_from_dict({"parts": {"x": p}}, "t", "t"), "t")[0]["x"] for p in (SUN, WHEEL)]
    assert plain[0].quantities["tooth_thickness"] - thickness[0] == pytest.approx(0.03, abs=1e-12)
    assert plain[1].quantities["tooth_thickness"] - thickness[1] == pytest.approx(total - 0.03, abs=1e-12)
    assert matings[0].normal_backlash == pytest.approx(0.1, rel=1e-9)


@pytest.mark.parametrize("wanted", [(0.1, 0.2, 0.1), (0.2, 0.1, 0.25), (0.3, 0.2, 0.15), (0.1,) * 3])
def test_each_mate_of_a_train_has_the_backlash_that_it_asks_for(wanted: tuple[float, float, float]) -> None:
    """By (A_1 + A_2) cos(alpha) of each pair; a gear between two had the larger thinning, and both pairs more."""
    train = {"a": SUN, "b": WHEEL, "c": {**SUN, "number_of_teeth": 22}, "d": WHEEL}
    links = [("a", "b"), ("b", "c"), ("c", "d")]
    raw = {
        "parts": train,
        "mates": [
            {"kind": "external_gear_pair", "first": one, "second": two, "normal_backlash": asked}
            for (one, two), asked in zip(links, wanted, strict=True)
        ],
    }
    made, matings = make_parts(scene_from_dict(raw, "t", "t"), "t")
    assert [m.normal_backlash for m in matings] == pytest.approx(list(wanted), rel=1e-9)
    cosine = math.cos(math.radians(20))
    for (one, two), asked in zip(links, wanted, strict=True):
        thinnings = [made[k].thing.circumferential_thinning for k in (one, two)]
        assert sum(thinnings) * cosine == pytest.approx(asked, rel=1e-9)


def test_a_gear_that_meshes_with_its_like_is_thinned_by_half() -> None:
    raw = {
        "parts": {"a": SUN},
        "instances": {"one": {"part": "a"}, "two": {"part": "a"}},
        "mates": [{"kind": "external_gear_pair", "first": "one", "second": "two", "normal_backlash": 0.1}],
    }
    assert make_parts(scene_from_dict(raw, "t", "t"), "t")[1][0].normal_backlash == pytest.approx(0.1, rel=1e-9)


@pytest.mark.parametrize("kind", ["internal_gear_pair", "rack_pair", "external_gear_pair"])
def test_a_backlash_that_nothing_is_left_to_give_is_refused(kind: str) -> None:
    """Both teeth are as thin as their keys say: j_bn = (A_1 + A_2) cos(alpha), and another was passed over."""
    parts = {"internal_gear_pair": (RING, SUN), "rack_pair": (WHEEL, RACK), "external_gear_pair": (SUN, WHEEL)}[kind]
    thin = {name: {**keys, "circumferential_thinning": 0.05} for name, keys in zip("ab", parts, strict=True)}
    mate = {"kind": kind, "first": "a", "second": "b"}
    own = 0.1 * math.cos(math.radians(20))
    assert scene(thin, mate)[1][0].normal_backlash == pytest.approx(own, rel=1e-9)
    assert scene(thin, {**mate, "normal_backlash": round(own, 5)})[1][0].normal_backlash == pytest.approx(own, rel=1e-9)
    for asked in (0.05, 0.3):
        with pytest.raises(SceneError, match=f"normal_backlash = {asked}.*{own:.6g} mm; remove normal_backlash"):
            scene(thin, {**mate, "normal_backlash": asked})


def test_a_wanted_centre_distance_is_kept_and_one_too_small_is_refused() -> None:
    mate = {"kind": "external_gear_pair", "first": "a", "second": "b", "working_centre_distance": 51.6}
    _, matings, stand = scene({"a": SUN, "b": WHEEL}, mate)
    assert abs(stand.instances[1].centre - stand.instances[0].centre) == pytest.approx(51.6, rel=1e-14)
    assert matings[0].normal_backlash > 0.1
    with pytest.raises(SceneError) as caught:
        scene({"a": SUN, "b": WHEEL}, {**mate, "working_centre_distance": 51.0})
    assert caught.value.key == "mates[1].working_centre_distance"
    assert caught.value.nearest is not None
    least = caught.value.nearest.value
    scene({"a": SUN, "b": WHEEL}, {**mate, "working_centre_distance": least})


@pytest.mark.parametrize(
    ("kind", "first", "second", "key", "hint"),
    [
        ("external_gear_pair", "ring", "sun", "first", "internal_gear_pair"),
        ("internal_gear_pair", "sun", "wheel", "second", "external_gear_pair"),
        ("rack_pair", "rack", "sun", "first", "swap first and second"),
        ("external_gear_pair", "sun", "rack", "second", "rack_pair"),
    ],
)
def test_a_mate_of_the_wrong_kind_names_the_right_one(kind: str, first: str, second: str, key: str, hint: str) -> None:
    parts = {"ring": RING, "sun": SUN, "wheel": WHEEL, "rack": RACK}
    with pytest.raises(SceneError) as caught:
        scene(parts, {"kind": kind, "first": first, "second": second})
    assert caught.value.key == f"mates[1].{key}"
    assert hint in caught.value.remedy


def test_a_planet_between_sun_and_ring_closes_only_in_the_right_place() -> None:
    """z 60 = 20 + 2 x 20: the third mate only checks; a planet that is turned by hand is found out."""
    parts = {"sun": SUN, "planet": SUN, "ring": RING}
    mates = (
        {"kind": "external_gear_pair", "first": "sun", "second": "planet", "direction_deg": 90.0},
        {"kind": "internal_gear_pair", "first": "planet", "second": "ring", "direction_deg": -90.0},
    )
    made, _, stand = scene(parts, *mates)
    assert abs(stand.instances[2].centre) < 1e-12
    assert overlap(made, stand, "planet", "ring")[0] < 2e-3
    turns = {i.id: i.rotation for i in stand.instances}
    for off, met in ((0.0, True), (0.02, False)):
        fixed = {
            "planet": {"at": [0.0, 40.0, 0.0], "rotation_deg": math.degrees(turns["planet"]) + off},
            "ring": {"at": [0.0, 0.0, 0.0], "rotation_deg": math.degrees(turns["ring"])},
        }
        _, _, again = scene(parts, *mates, instances=fixed)
        assert all(c.met for c in again.mates[1].conditions) is met


HELICAL = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 19, "helix_angle_deg": 25.0}


@pytest.mark.parametrize(
    ("other", "key", "remedy"),
    [
        ({"hand": "right"}, "hand", '"left" works'),
        ({"helix_angle_deg": 20.0, "hand": "left"}, "helix_angle_deg", "25 degrees works"),
        ({"double_helical": True, "hand": "left"}, "double_helical", "false works"),
        ({"module": 2.5, "hand": "left"}, "module", "2 mm works"),
    ],
)
def test_helices_that_do_not_mesh_are_refused_in_the_parts_own_keys(
    other: dict[str, Any], key: str, remedy: str
) -> None:
    mate = {"kind": "external_gear_pair", "first": "a", "second": "b"}
    with pytest.raises(SceneError) as caught:
        scene({"a": HELICAL, "b": {**HELICAL, **other}}, mate)
    assert caught.value.key == f"mates[1]: parts.b.{key}"
    assert remedy in caught.value.remedy


def test_a_straight_gear_beside_a_helical_one_is_cured_in_one_step() -> None:
    """The same angle would need the other hand too: straight teeth mesh with straight ones."""
    mate = {"kind": "external_gear_pair", "first": "a", "second": "b"}
    with pytest.raises(SceneError) as caught:
        scene({"a": HELICAL, "b": {**HELICAL, "helix_angle_deg": 0.0}}, mate)
    assert caught.value.key == "mates[1]: parts.a.helix_angle_deg"
    assert caught.value.nearest == Nearest(0.0)
    scene({"a": {**HELICAL, "helix_angle_deg": 0.0}, "b": {**HELICAL, "helix_angle_deg": 0.0}}, mate)


def test_helical_gears_mesh_at_every_height() -> None:
    """Sections turned by the lead of each gear touch and do not overlap, by polygons."""
    mate = {"kind": "external_gear_pair", "first": "a", "second": "b"}
    made, matings, stand = scene({"a": HELICAL, "b": {**HELICAL, "number_of_teeth": 33, "hand": "left"}}, mate)
    assert matings[0].distance == pytest.approx(52 / math.cos(math.radians(25)), rel=1e-12)
    by_id = {i.id: i for i in stand.instances}
    for z in (0.0, 3.3, 8.0):
        turns = [math.tan(math.radians(25)) * z / (2 * t / math.cos(math.radians(25)) / 2) for t in (19, -33)]
        one, two = (polygon(made[k], by_id[k], extra) for k, extra in zip("ab", turns, strict=True))
        assert one.intersection(two).area < 2e-3
        assert one.distance(two) < 0.004


@pytest.mark.parametrize("kind", ["internal_gear_pair", "rack_pair", "external_gear_pair"])
def test_a_backlash_that_leaves_no_teeth_names_one_that_does(kind: str) -> None:
    parts = {"internal_gear_pair": (RING, SUN), "rack_pair": (WHEEL, RACK), "external_gear_pair": (SUN, WHEEL)}[kind]
    mate = {"kind": kind, "first": "a", "second": "b", "normal_backlash": 6.0}
    with pytest.raises(SceneError) as caught:
        scene({"a": parts[0], "b": parts[1]}, mate)
    assert caught.value.key == "mates[1].normal_backlash"
    most = float(caught.value.remedy.split("at most ")[1].split(" mm")[0])
    assert scene({"a": parts[0], "b": parts[1]}, {**mate, "normal_backlash": most})[1]


@pytest.mark.parametrize(
    ("kind", "distance"), [("external_gear_pair", 60.0), ("rack_pair", 40.0), ("internal_gear_pair", 37.7)]
)
def test_gears_that_do_not_reach_each_other_are_refused(kind: str, distance: float) -> None:
    parts = {"internal_gear_pair": (RING, SUN), "rack_pair": (WHEEL, RACK), "external_gear_pair": (SUN, WHEEL)}[kind]
    mate = {"kind": kind, "first": "a", "second": "b", "working_centre_distance": distance}
    with pytest.raises(SceneError) as caught:
        scene({"a": parts[0], "b": parts[1]}, mate)
    assert caught.value.key == "mates[1].working_centre_distance"
    value = float(caught.value.remedy.split(" mm works")[0].split()[-1])
    assert scene({"a": parts[0], "b": parts[1]}, {**mate, "working_centre_distance": value})[1]


def test_a_ring_is_blamed_for_what_is_the_ring_s() -> None:
    mate = {"kind": "internal_gear_pair", "first": "ring", "second": "sun"}
    with pytest.raises(SceneError) as caught:
        scene({"ring": RING, "sun": {**SUN, "module": 3.0}}, mate)
    assert caught.value.key == "mates[1]: parts.ring.module"


def test_a_rack_that_is_shorter_than_its_mesh_says_so() -> None:
    mate = {"kind": "rack_pair", "first": "a", "second": "b"}
    # contact ratio 1.7: two teeth are in contact at once
    for teeth, numbers in ((2, [(2.0, 3.0)]), (3, [])):
        _, matings, _ = scene({"a": WHEEL, "b": {**RACK, "number_of_teeth": teeth}}, mate)
        assert [(f.value, f.limit) for f in matings[0].findings() if f.code == "short_rack"] == numbers


def test_herringbones_need_one_width() -> None:
    double = {**HELICAL, "double_helical": True}
    mate = {"kind": "external_gear_pair", "first": "a", "second": "b"}
    with pytest.raises(SceneError, match="face_width"):
        scene({"a": {**double, "face_width": 10.0}, "b": {**double, "hand": "left", "face_width": 20.0}}, mate)


THIN = {"circumferential_thinning": 0.05}


@pytest.mark.parametrize("pitches", [0, -2])
def test_a_rack_may_stand_anywhere_in_its_play(pitches: int) -> None:
    """Thinned teeth of 0.1 mm together leave the rack 0.05 mm along its way to either side, pitch after pitch."""
    parts = {"wheel": SUN | THIN, "rack": RACK | THIN}
    mate = {"kind": "rack_pair", "first": "wheel", "second": "rack", "direction_deg": -90.0}
    _, _, stand = scene(parts, mate)
    middle, turned = stand.instances[1].centre, math.degrees(stand.instances[1].rotation)
    for share in (0.99, -0.99, 1.01, -1.01):
        # the rack's way is the line of centres, turned by a quarter
        at = middle + 0.05 * share + pitches * 2 * math.pi
        by_hand = {"wheel": {"at": [0, 0, 0]}, "rack": {"at": [at.real, at.imag, 0], "rotation_deg": turned}}
        _, _, placed = scene(parts, mate, instances=by_hand)
        found = {c.code: c for c in placed.mates[0].conditions}
        assert found["centre_distance"].met
        assert found["rack_phase"].met is (abs(share) < 1)
        assert found["rack_phase"].value == pytest.approx(0.05 * share, abs=1e-9)
        assert found["rack_phase"].tolerance == pytest.approx(0.05, abs=2e-5)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("kind", "first", "second", "radius", "nearer"),
    [
        # a wheel that turns on brings its teeth, on this side of its axis, down upon the first's: on its upper flanks
        ("external_gear_pair", SUN, WHEEL | {"profile_shift_coefficient": 0.0}, 31.0, 1),
        ("internal_gear_pair", SUN, RING, 60.0, 0),
        # the pinion itself turns on
        ("internal_gear_pair", RING, SUN, 20.0, 1),
        ("rack_pair", SUN, RACK, None, 0),
    ],
)
def test_a_second_that_stands_off_the_middle_is_nearer_to_one_flank(
    kind: str, first: dict[str, Any], second: dict[str, Any], radius: float | None, nearer: int
) -> None:
    """Off by half of its play, along the reference circle 0.025 of 0.05 mm: flanks are as far apart by cos(alpha)."""
    _, (mating,), _ = scene({"a": first | THIN, "b": second | THIN}, {"kind": kind, "first": "a", "second": "b"})
    for sense in (1, -1):
        sides = mating.contact(sense * 0.025 / (radius or 1.0), 0.0, None).side_gaps
        gaps = [min(sides[nearer]), min(sides[1 - nearer])][::sense]
        # the corner of a standard rack reaches a little below where the thinned gear's flank begins
        assert gaps == pytest.approx([0.025 * math.cos(math.radians(20)), 0.075 * math.cos(math.radians(20))], abs=6e-4)


HELIX = math.tan(math.radians(25.0)) / (19.0 / math.cos(math.radians(25.0)))


def by_hand(height: float, turned: float, **keys: Any) -> dict[str, Any]:
    """Conditions of two helical gears placed as their mate has them, the second that far up, the first turned, rad."""
    parts = {"a": HELICAL | keys, "b": HELICAL | {"number_of_teeth": 33, "hand": "left"} | keys}
    mate = {"kind": "external_gear_pair", "first": "a", "second": "b"}
    _, _, stand = scene(parts, mate)
    there = stand.instances[1]
    instances = {
        "a": {"at": [0, 0, 0], "rotation_deg": math.degrees(turned)},
        "b": {"at": [there.centre.real, 0, height], "rotation_deg": math.degrees(there.rotation)},
    }
    _, _, placed = scene(parts, mate, instances=instances)
    (found,) = placed.mates
    return {c.code: c for c in found.conditions} | {"face": found.mating.face}


@pytest.mark.sampled(2)
@pytest.mark.parametrize("height", [4.0, -4.0, 10.0, 11.0])
def test_helical_gears_at_different_heights_meet_where_the_lead_has_turned_them(height: float) -> None:
    """A right-hand gear's section turns on with its height; the mate sees the one that is at its lower face."""
    met = by_hand(height, -height * HELIX)
    assert met["phase"].met
    assert not by_hand(height, height * HELIX)["phase"].met
    width = max(10.0 - abs(height), 0.0)
    assert met["common_face_width"].value == pytest.approx(10.0 - abs(height))
    assert met["common_face_width"].met is (width > 0)
    assert met["face"].width == pytest.approx(width)
    assert met["face"].overlap_ratio == pytest.approx(width * math.sin(math.radians(25.0)) / (2 * math.pi), abs=1e-12)


def test_the_points_of_herringbones_stand_at_one_height() -> None:
    for height, met in ((0.0, True), (1.0, False), (-1.0, False)):
        found = by_hand(height, 0.0, double_helical=True, face_width=20.0)["herringbone_height"]
        assert (found.met, found.value) == (met, height)
        # all mates fit within 1e-5 mm
        assert (found.required, found.tolerance) == (0.0, 1e-5)


@pytest.mark.parametrize("turned", [0.0, 0.001, -0.3])
def test_what_a_mate_by_hand_must_be_is_told_beside_what_it_is(turned: float) -> None:
    """19 and 33 teeth with a normal module of 2: the distance by their reference circles, the phase by the turn of one
    and the ratio; of faces no more than that they overlap."""
    found = by_hand(0.0, turned)
    distance = (19 + 33) / math.cos(math.radians(25.0))
    told = found["centre_distance"]
    assert (told.value, told.required) == (pytest.approx(distance, rel=1e-12), pytest.approx(distance, rel=1e-12))
    assert told.tolerance == pytest.approx(1e-5, rel=0.1)
    # the second has to turn back by 19 / 33 of what the first is turned, or on to its next tooth
    off = (found["phase"].value - found["phase"].required) / 360 * 33
    wanted = turned / (2 * math.pi) * 19
    assert math.remainder(off - wanted, 1.0) == pytest.approx(0.0, abs=1e-6)
    assert abs(off) <= 0.5 + 1e-9
    assert (found["common_face_width"].required, found["common_face_width"].tolerance) == (0.0, 0.0)


def test_a_rack_that_is_drawn_away_gains_twice_the_way_by_sine() -> None:
    """Both flanks stand at 20 degrees: 0.3 mm more than r = 20 mm."""
    mate = {"kind": "rack_pair", "first": "a", "second": "b", "working_centre_distance": 20.3}
    _, (mating,), _ = scene({"a": SUN, "b": RACK}, mate)
    assert mating.normal_backlash == pytest.approx(0.6 * math.sin(math.radians(20)), rel=1e-9)
    assert mating.contact(0.0, 0.0, None).worst.gap == pytest.approx(0.3 * math.sin(math.radians(20)), abs=1e-9)
