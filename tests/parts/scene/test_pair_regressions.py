"""What users broke: pairs with relief, thin walls, offers of distances and of helical shifts."""

import math
from itertools import pairwise
from typing import Any

import pytest

from exporters.production.check import scene_checks
from geometry.plane.distance import Verdict
from parts.scene.load import SceneError, make_parts, scene_from_dict
from parts.scene.placing import place

RELIEF = {"depth_coefficient": 0.02, "height_coefficient": 0.5}


def checked(raw: dict[str, Any]) -> dict[str, Any]:
    scene = scene_from_dict(raw, "t", "t")
    parts, matings = make_parts(scene, "t")
    placing = place(scene.instances, scene.drives, parts, matings, "t")
    return scene_checks(placing, parts, scene.drives, "en", contact=True)


def pair(kind: str, second: dict[str, Any], mate: dict[str, Any] | None = None, **first: Any) -> dict[str, Any]:
    gear = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 17, **first}
    joined = {"kind": kind, "first": "p", "second": "w", **(mate or {})}
    return {"parts": {"p": gear, "w": {"module": 2.0, **second}}, "mates": [joined]}


@pytest.mark.sampled(2)
@pytest.mark.parametrize("backlash", [0.0, 0.05])
@pytest.mark.parametrize(
    ("kind", "second"),
    [
        ("internal_gear_pair", {"kind": "ring_gear", "number_of_teeth": 60}),
        ("rack_pair", {"kind": "rack", "number_of_teeth": 14}),
        ("external_gear_pair", {"kind": "spur_gear", "number_of_teeth": 30}),
    ],
)
def test_relieved_tips_leave_the_verdict_decided(kind: str, second: dict[str, Any], backlash: float) -> None:
    raw = pair(
        kind,
        {**second, "pressure_angle_deg": 30.0},
        {"normal_backlash": backlash},
        pressure_angle_deg=30.0,
        tip_relief=RELIEF,
    )
    verdict = checked(raw)["mates"][0]["verdict"]
    # with backlash the pinion stands in its middle
    assert verdict in ({Verdict.CLEAR.value} if backlash else {Verdict.CONTACT.value, Verdict.CLEAR.value})


def test_a_wall_that_no_offset_leaves_is_decided() -> None:
    """The rim is 0.025 mm thick: boundaries within it were refused, and the pair was left undecided."""
    second = {"kind": "spur_gear", "number_of_teeth": 31}
    raw = pair("external_gear_pair", second, web={"thickness": 3.0, "rim_diameter": 28.95})
    assert "solids" not in checked(raw)
    # a pin through the web's recess and the rim
    raw["parts"]["q"] = {"kind": "pin", "diameter": 2.0, "length": 1.0}
    raw["instances"] = {"p": {}, "w": {}, "q": {"at": [14.4, 0.0, 0.0]}}
    (found,) = checked(raw)["solids"]
    assert (found["first"], found["second"], found["verdict"]) == ("p", "q", "overlap")


@pytest.mark.parametrize("backlash", [0.0, 0.1])
@pytest.mark.parametrize(("teeth", "shifts", "tip"), [((21, 45), (1.27, 0.566), 125.205979334607904),
                                                      ((22, 80), (1.31, 0.891), 130.596340419711772)])  # fmt: skip
def test_a_gear_that_is_pointed_alone_is_made_with_the_tip_that_its_mate_leaves_it(
    teeth: tuple[int, int], shifts: tuple[float, float], tip: float, backlash: float
) -> None:
    # tables Б.1 and Г.1 of the practicum with the misprint 0.991 mended; m 10, tips at 40 digits by (3.3) to (3.12)
    wheel = {"kind": "spur_gear", "module": 10.0, "number_of_teeth": teeth[1], "profile_shift_coefficient": shifts[1]}
    pinion = {"module": 10.0, "number_of_teeth": teeth[0], "profile_shift_coefficient": shifts[0]}
    raw = pair("external_gear_pair", wheel, {"normal_backlash": backlash}, **pinion)
    parts, _ = make_parts(scene_from_dict(raw, "t", "t"), "t")
    assert parts["p"].thing.tip_radius == pytest.approx(tip, rel=1e-14)
    assert parts["p"].section(0.0).region.outer.reach() == pytest.approx(tip, rel=1e-12)
    # alone, far from its mate, or beside a mate that leaves it its tip, it is refused
    far = pair("external_gear_pair", wheel, {"working_centre_distance": 10.0 * sum(teeth)}, **pinion)
    low = pair("external_gear_pair", {**wheel, "profile_shift_coefficient": -shifts[0]}, **pinion)
    for refused in ({"parts": {"p": raw["parts"]["p"]}}, far, low):
        with pytest.raises(SceneError, match="pointed"):
            make_parts(scene_from_dict(refused, "t", "t"), "t")


def test_what_else_is_wrong_with_a_gear_that_is_pointed_alone_is_told_with_what_works() -> None:
    wheel = {"kind": "spur_gear", "module": 10.0, "number_of_teeth": 45, "profile_shift_coefficient": 0.566}
    holes = {"count": 6, "diameter": 60.0, "pitch_circle_diameter": 120.0}
    pinion = {"module": 10.0, "number_of_teeth": 21, "profile_shift_coefficient": 1.27, "holes": holes}
    with pytest.raises(SceneError) as refused:
        make_parts(scene_from_dict(pair("external_gear_pair", wheel, **pinion), "t", "t"), "t")
    assert refused.value.key == "parts.p.holes.diameter"
    assert refused.value.nearest is not None
    pinion["holes"] = {**holes, "diameter": refused.value.nearest.value}
    make_parts(scene_from_dict(pair("external_gear_pair", wheel, **pinion), "t", "t"), "t")


def test_a_gear_that_is_pointed_beside_its_mate_too_is_offered_the_shift_that_the_mate_bears() -> None:
    wheel = {"kind": "spur_gear", "module": 10.0, "number_of_teeth": 80, "profile_shift_coefficient": 0.891}
    alone = {"parts": {"p": pair("external_gear_pair", wheel, {}, module=10.0, number_of_teeth=22,
                                 profile_shift_coefficient=2.6)["parts"]["p"]}}  # fmt: skip
    by_itself = offered(alone)
    raw = pair("external_gear_pair", wheel, {}, module=10.0, number_of_teeth=22, profile_shift_coefficient=2.6)
    beside = offered(raw)
    assert beside > by_itself + 0.1
    for shift, builds in ((beside, True), (beside * 1.001, False)):
        raw["parts"]["p"]["profile_shift_coefficient"] = shift
        if builds:
            make_parts(scene_from_dict(raw, "t", "t"), "t")
        else:
            assert offered(raw) == pytest.approx(beside, abs=2e-4)


def offered(raw: dict[str, Any]) -> float:
    with pytest.raises(SceneError) as refusal:
        checked(raw)
    nearest = refusal.value.nearest
    assert nearest is not None
    assert isinstance(nearest.value, float)
    return nearest.value


def test_offers_of_helical_shifts_are_normal_ones() -> None:
    second = {"kind": "spur_gear", "number_of_teeth": 20, "helix_angle_deg": 30.0, "hand": "left"}
    first = {"number_of_teeth": 40, "profile_shift_coefficient": -2.0, "helix_angle_deg": 30.0}
    raw = pair("external_gear_pair", {**second, "profile_shift_coefficient": 0.1}, **first)
    works = offered(raw)
    raw["parts"]["w"]["profile_shift_coefficient"] = works
    checked(raw)
    raw["parts"]["w"]["profile_shift_coefficient"] = works - 1e-3
    assert offered(raw) == pytest.approx(works, abs=1e-3)


def test_tips_that_a_pair_shortens_away_are_refused() -> None:
    second = {"kind": "spur_gear", "number_of_teeth": 20, "profile_shift_coefficient": 0.3}
    raw = pair("external_gear_pair", second, number_of_teeth=40, profile_shift_coefficient=-2.0)
    with pytest.raises(SceneError, match=r"profile_shift_coefficient = 0\.3: "):
        checked(raw)


@pytest.mark.parametrize("distance", [30.0, 41.0 - 5.0, 55.0])
def test_offers_of_distances_work(distance: float) -> None:
    ring = {"kind": "ring_gear", "number_of_teeth": 60}
    raw = pair("internal_gear_pair", ring, {"working_centre_distance": distance})
    raw["mates"][0]["working_centre_distance"] = offered(raw)
    assert checked(raw)["mates"][0]["contact_ratio"] >= 1 - 1e-3


def test_a_backlash_that_each_pair_of_a_train_takes_alone_and_both_do_not_is_told() -> None:
    """The idler is thinned for the driver too, so that teeth that the wheel leaves whole alone are pointed."""

    def train(backlash: float) -> dict[str, Any]:
        rows = {"driver": (17, 0.3), "idler": (23, 0.15), "wheel": (31, -0.2)}
        parts = {name: {"kind": "spur_gear", "module": 2.0, "number_of_teeth": z, "profile_shift_coefficient": x}
                 for name, (z, x) in rows.items()}  # fmt: skip
        first = {"kind": "external_gear_pair", "first": "driver", "second": "idler", "normal_backlash": backlash}
        second = {"kind": "external_gear_pair", "first": "idler", "second": "wheel", "normal_backlash": 0.05}
        return {"parts": parts, "mates": [first, second]}

    with pytest.raises(SceneError) as refused:
        make_parts(scene_from_dict(train(1.2), "t", "t"), "t")
    told = refused.value
    assert (told.key, told.code, told.numbers["gears"]) == (
        "mates[1].normal_backlash", "backlash_leaves_no_teeth", ["wheel"])  # fmt: skip
    assert told.nearest is not None
    most = told.nearest.value
    assert isinstance(most, float)
    make_parts(scene_from_dict(train(most), "t", "t"), "t")
    with pytest.raises(SceneError):
        make_parts(scene_from_dict(train(most * 1.001), "t", "t"), "t")
    # each pair alone takes it
    for kept in (0, 1):
        alone = train(1.2)
        names = [alone["mates"][kept][end] for end in ("first", "second")]
        make_parts(scene_from_dict({"parts": {n: alone["parts"][n] for n in names}, "mates": [alone["mates"][kept]]},
                                   "t", "t"), "t")  # fmt: skip


def test_a_backlash_is_refused_by_what_all_pairs_of_a_train_take() -> None:
    """Before, each pair told its own limit, and what was offered met the refusal of the next one."""
    parts = {f"g{z}": {"kind": "spur_gear", "module": 2.0, "number_of_teeth": z} for z in (40, 30, 20, 12)}
    mates = [{"kind": "external_gear_pair", "first": first, "second": second, "normal_backlash": 4.0}
             for first, second in pairwise(parts)]  # fmt: skip
    with pytest.raises(SceneError) as refused:
        make_parts(scene_from_dict({"parts": parts, "mates": mates}, "t", "t"), "t")
    assert refused.value.key == "mates[1].normal_backlash"
    assert refused.value.numbers["gears"] == list(parts)
    assert refused.value.nearest is not None
    most = refused.value.nearest.value
    assert isinstance(most, float)
    held = {"parts": parts, "mates": [mate | {"normal_backlash": most} for mate in mates]}
    make_parts(scene_from_dict(held, "t", "t"), "t")
    # at the tip of 12 teeth nothing is left of half of the angle by ISO 21771; both of a pair are thinned
    alpha = math.acos(12 * math.cos(math.radians(20)) / 14)
    half = math.pi / 24 + math.tan(math.radians(20)) - math.radians(20) - math.tan(alpha) + alpha
    assert most == pytest.approx(2 * 24 * half * math.cos(math.radians(20)), abs=1e-3)
