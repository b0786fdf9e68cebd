"""The power module of the thesis: every position of its list, sized by rules that hold or name their driver."""

from __future__ import annotations

import cmath
import json
import math
import random
from collections import Counter
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from geometry.base.errors import ParameterError
from geometry.kinematics.two_disk import TwoDisk
from parts.base.refusal import SceneError
from parts.bodies.layered import Layered
from parts.gears.worm.part import WORM
from parts.pages.module_rules import RULES
from parts.recipes.power_module import PowerModuleKeys, checked_sizes
from parts.scene.load import scene_from_dict
from parts.scene.scene_file import SceneFile
from tests.oracles.clearances import overlaps
from tests.parts.recipes.test_power_table import placed
from tests.sampling import some_of

LIST = Path(__file__).parents[2] / "published" / "power_module_list.json"


def module(language: str = "en", /, **keys: Any) -> SceneFile:
    return scene_from_dict({"assemblies": [{"kind": "power_module", **keys}]}, "t", "t", language)


# what cranks replace, add (position, count) and drop of the list
REPLACED = {
    11: ("Crank plate of the platform", "Кривошипна плита платформи"),
    13: ("Guide of the free ring", "Напрямна вільного кільця"),
    14: ("Free ring", "Вільне кільце"),
    16: ("Crank plate of the housing", "Кривошипна плита корпусу"),
}
ADDED = {34: (6, "Crank", "Кривошип"), 35: (12, "Crank pin", "Палець кривошипа")}
DROPPED = {15: 1, 57: 1}
# what idlers add to the wheels of the thesis
BETWEEN = {36: (2, "Idler", "Проміжне колесо"), 37: (2, "Idler pin", "Палець проміжного колеса"),
           38: (2, "Link", "Ланка"), 39: (1, "Post", "Стояк")}  # fmt: skip


@pytest.mark.parametrize("orientation", ["thesis", "cranks", "idlers"])
def test_exactly_the_parts_list_of_the_thesis_but_for_what_keeps_the_platform_parallel(orientation: str) -> None:
    items = json.loads(LIST.read_text("utf-8"))["items"]
    for language in ("en", "uk"):
        scene = module(language, names=language, **({} if orientation == "cranks" else {"orientation": orientation}))
        count, names = Counter[int](), dict[int, str]()
        for instance in scene.instances.values():
            part: Any = scene.parts[str(instance.part)]
            count[part.position] += 1
            names[part.position] = part.title
            assert (part.standard is None) == (part.position < 40)
            assert (part.designation is None) == (part.position > 40)
            assert part.material
        every = {item["pos"]: item["qty"] for item in items}
        if orientation == "cranks":
            assert {k: every.pop(k) for k in DROPPED} == DROPPED
            every |= {k: row[0] for k, row in ADDED.items()}
        if orientation == "idlers":
            every |= {k: row[0] for k, row in BETWEEN.items()}
        assert count == every
        # texts have points; drawings make commas of them
        wanted = {item["pos"]: (item["name_en"], item["name_uk"]) for item in items}
        if orientation == "cranks":
            wanted |= {k: row[1:] for k, row in ADDED.items()} | REPLACED
        if orientation == "idlers":
            wanted |= {k: row[1:] for k, row in BETWEEN.items()}
        expected = {k: wanted[k][language == "uk"].replace("1,5", "1.5") for k in every}
        assert names == expected
        sums = sum(n for k, n in count.items() if k < 40), sum(n for k, n in count.items() if k > 40)
        assert sums == {"thesis": (42, 417), "cranks": (59, 416), "idlers": (49, 417)}[orientation]


def test_worms_are_drawn_with_their_thread_whatever_their_shafts() -> None:
    """The shaft is longer on one side: the thread stands as far on both."""
    keys: Any = module().parts["worm"]
    sketch = WORM.sketch(keys, WORM.thing(keys, {}))
    assert sketch is not None
    [thread] = [layer for layer in sketch.layers if any(ring.root for ring in (*layer.lower, *layer.upper))]
    assert thread.low == pytest.approx(-thread.high)
    assert 50 < thread.high < 60


def test_every_position_has_its_rules() -> None:
    assert {position for rule in RULES for position in rule.positions} >= {*range(1, 34)} - {
        # as they are bought, or closed by what others leave: spacers and snap rings
        10, 13, 15, 28, 29,
    }  # fmt: skip


@pytest.mark.parametrize(
    ("keys", "word"),
    [
        ({"second_arm": 70.0}, "give, 72 mm; 72 mm works"),
        ({"disk_thickness": 3.0}, "disk_thickness = 3.*at least"),
        ({"balls": 2000}, "between two balls of the .* circle; .*at most"),
        ({"module": 10.0}, "assemblies"),
        ({"wheel_module": 5.0, "orientation": "thesis"}, "wheel_module = 5.*; 4.8 mm works"),
        # 81 mm are 40 of 2.025
        ({"teeth": (96, 150), "orientation": "thesis"}, "wheel_module = 2.0.*; 2.025 mm works"),
        ({"wheel_module": 3.0}, 'wheel_module = 3.* "thesis" only'),
        ({"wheel_module": 2.3, "orientation": "idlers"}, "wheel_module = 2.3.*; 2 mm works"),
        ({"module": 2.4, "wheel_module": 1.6, "orientation": "idlers"}, "module = 2.4|teeth"),
        ({"axial_gap": 2.2, "orientation": "idlers"}, "axial_gap = 2.2.*before the link.*at least"),
        ({"axial_gap": 1.0}, "axial_gap = 1.*collars of the pins 35.*at least"),
        ({"ball": 30.0}, "ball = 30.*at most"),
        ({"teeth": (40, 120)}, r"teeth = \[40, 120\].*; \[96, 140\] works"),
    ],
)
def test_what_does_not_go_together_names_its_driver_and_limit(keys: dict[str, Any], word: str) -> None:
    with pytest.raises(SceneError, match=word) as refused:
        module(**keys)
    if refused.value.nearest is not None:
        module(**keys | {refused.value.key.partition("].")[2]: refused.value.nearest.value})


def test_nothing_overlaps_at_home_by_sections_and_layers() -> None:
    """Told from the tables alone; a cover too wide, holes beside their screws and balls of 8.1 show."""
    scene = module(orientation="thesis")
    assert overlaps(scene) == {}
    parts: Any = scene.parts
    parts["end_cover"].points[3].r += 4.0
    parts["guide_6"].holes[0].pitch_circle_diameter += 2.0
    parts["ball"].points[0].arc, parts["ball"].points[1].z = 4.05, 8.1
    found = {name for pair in overlaps(scene) for name in pair}
    assert {"end_cover_1", "guide_6", "bearing_ring_2", "spacer_22", "disk_3"} <= found


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("balls", "ball"), [
    (40, 8.0), (491, 8.0), (500, 7.5), *(pytest.param(n, 8.0, marks=pytest.mark.heavy) for n in (180, 310, 350)),
])  # fmt: skip
def test_cages_are_made_as_near_as_balls_may_stand(balls: int, ball: float) -> None:
    """With one ball more than fits the condition names them."""
    scene = module(balls=balls, ball=ball)
    for size in ("small_cage", "large_cage"):
        Layered().thing(scene.parts[size], {})
    if balls == 491:
        with pytest.raises(SceneError, match="room between two balls"):
            module(balls=492)


# what keeps the platform parallel
CRANKS = {"platform_plate", "ring_guide", "free_ring", "body_plate", "crank", "crank_pin"}


@pytest.mark.heavy
def test_cranks_are_free_at_home_and_what_is_too_long_shows_where_it_passes() -> None:
    scene = module()
    assert overlaps(scene) == {}
    folded = {"pinion": math.pi}
    assert overlaps(scene, folded, CRANKS) == {}
    parts: Any = scene.parts
    # through the ring's window to plate 11, and past the play of the collars
    parts["ring_guide"].points[0].z -= 12.0
    parts["ring_guide"].points[1].z -= 12.0
    for point in parts["crank_pin"].points[5:]:
        point.z += 6.0
    found = {frozenset(scene.instances[key].part for key in pair) for pair in overlaps(scene, folded, CRANKS)}
    assert {frozenset({"ring_guide", "platform_plate"}), frozenset({"crank_pin", "free_ring"})} <= found


# idlers, and what is about them
IDLERS = {"central_wheel", "satellite_wheel", "platform_wheel", "idler", "idler_pin", "idler_pin_down", "link", "post",
          "platform_axle", "nut_47", "satellite_axle"}  # fmt: skip


@pytest.mark.heavy
def test_idlers_are_free_stretched_and_folded_and_a_pin_too_long_strikes_the_one_that_it_passes() -> None:
    scene = module(orientation="idlers")
    assert overlaps(scene) == {}
    folded = {"pinion": math.pi}
    assert overlaps(scene, folded, IDLERS) == {}
    parts: Any = scene.parts
    # the head of the one before that of the other
    for point in parts["idler_pin_down"].points[-2:]:
        point.z -= 8.0
    found = {frozenset(scene.instances[key].part for key in pair) for pair in overlaps(scene, folded, IDLERS)}
    assert frozenset({"idler_pin_down", "idler_pin"}) in found


@pytest.mark.heavy
@pytest.mark.parametrize(("orientation", "parts"), [("cranks", CRANKS), ("idlers", IDLERS)])
def test_what_keeps_the_platform_parallel_is_free_wherever_both_disks_may_stand(
    orientation: str, parts: set[str]
) -> None:
    scene, rng = module(orientation=orientation), random.Random(16)
    for _ in range(100):
        delta, beta = (rng.uniform(-math.pi, math.pi) for _ in range(2))
        turns = {"disk_2": delta, "ring": delta, "pinion": delta + beta}
        assert overlaps(scene, turns, parts) == {}, turns


def test_the_platform_is_parallel_and_where_both_disks_carry_it() -> None:
    """Measured on the placed instances, stretched, folded and between; cranks turn as the disks do."""
    train = placed(module())[0].train
    assert train is not None
    home = train.poses([Fraction(0)] * 2)["platform"][1]
    for point in some_of((144 + 0j, 100 + 20j, -50j, -143 + 1j, 3 + 1j, 1e-6j), 2):
        delta, beta = (float(a) for a in TwoDisk().inverse(point * 1j))
        ring = delta - (beta - math.pi) / TwoDisk().ratio
        poses = train.poses([Fraction(-angle / (2 * math.pi)) for angle in (delta, ring)])
        assert abs(poses["platform"][0] - point) < 1e-9
        assert abs(math.remainder(poses["platform"][1] - home, 2 * math.pi)) < 1e-12
        for pin, holder in (("first_crank_1", "free_ring"), ("second_crank_1", "platform_plate")):
            # the far end of a crank stands on the pivots' circle of what it holds
            end = poses[pin][0] + 72 * cmath.exp(1j * poses[pin][1])
            assert abs(abs(end - poses[holder][0]) - 53) < 1e-6


def test_the_floor_is_clear_of_the_screw_that_goes_about_o1_under_thick_wheels() -> None:
    """Ring 18 is the lower the thicker they are: its head went 7 mm into the floor."""
    scene = module(orientation="thesis", wheel_width=57.9)
    assert overlaps(scene, None, {"screw_57"}) == {}
    parts: Any = scene.parts
    for point in parts["screw_57"].points:
        point.z -= 5.1
    assert overlaps(scene, None, {"screw_57"}).keys() >= {("screw_57", "body")}


# from where random drivers are taken: as large as they differ, most of them go together; and how far they are pushed
_SPREAD: dict[str, tuple[float, float]] = {
    "module": (2.4, 3.2), "worm_module": (4.9, 6.0), "ball": (6.5, 8.2), "disk_thickness": (29.0, 34.0),
    "face_width": (18.0, 27.0), "axial_gap": (3.0, 9.0), "wheel_width": (10.0, 25.0), "worm_wheel_width": (21.0, 28.0),
    "worm_length": (90.0, 160.0), "clearance": (0.05, 0.4), "platform_size": (150.0, 600.0),
    "worm_quotient": (9.0, 12.0),
}  # fmt: skip
_FAR: dict[str, tuple[float, float]] = {
    "module": (2.0, 5.0), "worm_module": (3.0, 9.0), "ball": (4.0, 14.0), "disk_thickness": (15.0, 80.0),
    "face_width": (10.0, 45.0), "axial_gap": (0.5, 40.0), "wheel_width": (4.0, 60.0), "worm_wheel_width": (8.0, 45.0),
    "worm_length": (20.0, 500.0), "clearance": (0.01, 1.0), "platform_size": (50.0, 1500.0),
    "worm_quotient": (5.0, 25.0),
}  # fmt: skip


def _whole(rng: random.Random, keys: dict[str, Any]) -> dict[str, Any]:
    """Drivers that are no lengths, and wheels that span the arm of those that are."""
    keys = keys | {"teeth": (96, 144), "balls": 2 * rng.randrange(20, 160)}
    if rng.random() < 0.4:
        pinion = rng.randrange(88, 108)
        keys["teeth"] = (pinion, pinion + 2 * rng.randrange(20, 29))
    if rng.random() < 0.3:
        keys["worm_teeth"] = (rng.randrange(118, 146), rng.randrange(96, 120))
    if rng.random() < 0.67:
        keys["orientation"] = rng.choice(("thesis", "idlers"))
        keys["wheels"] = rng.choice({"thesis": (24, 30, 36, 40), "idlers": (36, 42, 48)}[keys["orientation"]])
    return keys


def _spanned(keys: dict[str, Any]) -> dict[str, Any]:
    """With a module for so many teeth of the wheels."""
    pinion, ring = keys["teeth"]
    wheels = {name: keys.get("module", 3.0) * (ring - pinion) / 2 / keys["wheels"] for name in ("wheel_module",)
              if "wheels" in keys}  # fmt: skip
    return {name: value for name, value in keys.items() if name != "wheels"} | wheels


def _pushed(rng: random.Random) -> dict[str, Any]:
    """Drivers as far from the usual ones as all rules let them: together, then each for itself, into a corner."""
    usual, whole = PowerModuleKeys(), _whole(rng, {})
    ends = {name: rng.choice(_FAR[name]) for name in rng.sample(list(_FAR), rng.choice((1, 2, 2, 3, 3, 5, 8, 12)))}

    def at(shares: dict[str, float]) -> dict[str, Any]:
        far = {n: getattr(usual, n) + share * (ends[n] - getattr(usual, n)) for n, share in shares.items()}
        return _spanned(whole | {name: round(value, 3) for name, value in far.items()})

    def kept(shares: dict[str, float]) -> bool:
        try:
            checked_sizes(PowerModuleKeys(**at(shares)))
        except ParameterError:
            return False
        return True

    shares = dict.fromkeys(ends, 0.0)
    for group in (list(ends), *([name] for name in ends)):
        low, high = shares[group[0]], 2.0
        while high - low > 1e-3:
            middle = min((low + high) / 2, 1.0)
            low, high = (middle, high) if kept(shares | dict.fromkeys(group, middle)) else (low, middle)
            if low == 1.0:
                break
        shares |= dict.fromkeys(group, low)
    return at(shares)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("seed", range(200))
def test_random_drivers_make_a_module_without_overlap_or_name_what_lacks(seed: int) -> None:
    """Some drawn, some pushed to where a rule ends: there a length that no rule holds is the least."""
    rng, usual = random.Random(seed), PowerModuleKeys()
    drawn = {name: round(rng.uniform(*ends), 2) for name, ends in _SPREAD.items() if rng.random() < 0.6}
    for keys in some_of((_spanned(_whole(rng, drawn)), _pushed(rng))):
        try:
            scene = module(**keys)
        except SceneError as refusal:
            driver = refusal.key.partition("].")[2]
            assert driver in PowerModuleKeys.__struct_fields__
            nearest = refusal.nearest
            if nearest is not None and driver != "second_arm":
                assert getattr(usual, driver) != keys[driver]
            continue
        assert overlaps(scene) == {}, keys


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("keys", "name"),
    [
        ({"worm_length": 20.0}, "worm_length"), ({"worm_length": 1000.0}, "worm_length"),
        ({"worm_quotient": 4.0}, "worm_quotient"), ({"worm_quotient": 6.0}, "worm_quotient"),
        ({"worm_teeth": [30, 30]}, "worm_teeth"), ({"worm_teeth": [128, 129]}, "worm_teeth"),
        ({"worm_teeth": [106, 128]}, "worm_teeth"),
        # ring 24 stood in disk 2
        ({"worm_wheel_width": 22.546, "face_width": 18.401}, "worm_wheel_width"),
    ],
)  # fmt: skip
def test_a_driver_of_the_worms_is_refused_by_its_name_with_what_works(keys: dict[str, Any], name: str) -> None:
    with pytest.raises(SceneError) as refused:
        module(**keys)
    assert refused.value.key == f"assemblies[1].{name}"
    assert refused.value.nearest is not None
    module(**keys | {name: refused.value.nearest.value})
