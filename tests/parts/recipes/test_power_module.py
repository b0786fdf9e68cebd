"""The power module of the thesis: every position of its list, sized by rules that hold or name their driver."""

from __future__ import annotations

import json
import random
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from parts.base.refusal import SceneError
from parts.pages.module_rules import RULES
from parts.recipes.power_module import PowerModuleKeys
from parts.scene.load import SceneFile, scene_from_dict
from tests.oracles.clearances import overlaps

LIST = Path(__file__).parents[2] / "published" / "power_module_list.json"


def module(**keys: Any) -> SceneFile:
    return scene_from_dict({"assemblies": [{"kind": "power_module", **keys}]}, "t", "t")


def test_exactly_the_parts_list_of_the_thesis() -> None:
    items = json.loads(LIST.read_text("utf-8"))["items"]
    for language in ("en", "uk"):
        scene = module(names=language)
        count, names = Counter[int](), dict[int, tuple[str, str]]()
        for instance in scene.instances.values():
            part: Any = scene.parts[str(instance.part)]
            count[part.position] += 1
            names[part.position] = (part.title, part.title_uk)
            assert (part.standard is None) == (part.position < 40)
            assert (part.designation is None) == (part.position > 40)
            assert part.material
        assert count == {item["pos"]: item["qty"] for item in items}
        # texts have points; drawings make commas of them
        wanted = {item["pos"]: (item[f"name_{language}"], item["name_uk"]) for item in items}
        assert names == {k: tuple(name.replace("1,5", "1.5") for name in pair) for k, pair in wanted.items()}
        assert (sum(n for k, n in count.items() if k < 40), sum(n for k, n in count.items() if k > 40)) == (42, 417)


def test_every_position_has_its_rules() -> None:
    assert {position for rule in RULES for position in rule.positions} >= {*range(1, 34)} - {
        # as they are bought, or closed by what others leave: spacers, snap rings and plugs
        10, 13, 15, 28, 29, 32,
    }  # fmt: skip


@pytest.mark.parametrize(
    ("keys", "word"),
    [
        ({"second_arm": 70.0}, "axes 72 mm apart; 72 mm works"),
        ({"disk_thickness": 3.0}, "disk_thickness = 3.*at least"),
        ({"balls": 2000}, "between two balls of the .* circle; .*at most"),
        ({"module": 10.0}, "assemblies"),
        ({"wheel_module": 5.0}, "wheel_module = 5"),
        ({"ball": 30.0}, "ball = 30.*at most"),
        ({"teeth": (40, 120)}, "teeth"),
    ],
)
def test_what_does_not_go_together_names_its_driver_and_limit(keys: dict[str, Any], word: str) -> None:
    with pytest.raises(SceneError, match=word):
        module(**keys)


def test_nothing_overlaps_at_home_by_sections_and_layers() -> None:
    """Told from the tables alone; a cover too wide, holes beside their screws and balls of 8.1 show."""
    scene = module()
    assert overlaps(scene) == {}
    parts: Any = scene.parts
    parts["end_cover"].points[3].r += 4.0
    parts["guide_6"].holes[0].pitch_circle_diameter += 2.0
    parts["ball"].points[0].arc, parts["ball"].points[1].z = 4.05, 8.1
    found = {name for pair in overlaps(scene) for name in pair}
    assert {"end_cover_1", "guide_6", "bearing_ring_2", "spacer_22", "disk_3"} <= found


# from where random drivers are taken: as large as they differ, most of them go together
_SPREAD: dict[str, tuple[float, float]] = {
    "module": (2.4, 3.2), "worm_module": (4.9, 6.0), "ball": (6.5, 8.2), "disk_thickness": (29.0, 34.0),
    "face_width": (18.0, 27.0), "axial_gap": (3.0, 9.0), "wheel_width": (10.0, 25.0), "worm_wheel_width": (21.0, 28.0),
    "worm_length": (90.0, 160.0), "clearance": (0.05, 0.4), "platform_size": (150.0, 600.0),
    "worm_quotient": (9.0, 12.0),
}  # fmt: skip


@pytest.mark.sampled(1)
@pytest.mark.parametrize("seed", range(500))
def test_random_drivers_make_a_module_without_overlap_or_name_what_lacks(seed: int) -> None:
    rng, usual = random.Random(seed), PowerModuleKeys()
    for _ in range(2):
        keys: dict[str, Any] = {
            name: round(rng.uniform(*ends), 2) for name, ends in _SPREAD.items() if rng.random() < 0.6
        }
        keys["teeth"] = (96, 144)
        # wheels that span the arm
        keys["wheel_module"] = keys.get("module", 3.0) * 24 / rng.choice((24, 30, 36, 40))
        keys["balls"] = 2 * rng.randrange(20, 160)
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
