"""The power module of the thesis: every position of its list, sized by rules that hold or name their driver."""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from parts.base.refusal import SceneError
from parts.recipes.power_module_rules import RULES
from parts.scene.load import SceneFile, scene_from_dict

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
