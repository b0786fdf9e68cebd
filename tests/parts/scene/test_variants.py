"""What --vary asks for: lists and ranges with their ends, the product of the keys, and refusals in one line."""

from __future__ import annotations

from decimal import Decimal

import pytest

from parts.base.refusal import SceneError
from parts.scene.load import scene_from_dict
from parts.scene.scene_file import SceneFile
from parts.scene.variants import axes_of, variants
from tests.exporters.making import part_keys
from tests.exporters.outside import Gear

SCENE: SceneFile = scene_from_dict(
    {"parts": {"gear": part_keys(Gear(2, 23)), "other": part_keys(Gear(2, 23))}, "exports": [{"format": "dxf"}]},
    "s",
    "s",
)


@pytest.mark.parametrize(("text", "values"), [
    ("8:12", [8, 9, 10, 11, 12]),
    ("8:12:3", [8, 11]),
    ("1,2,3", [1, 2, 3]),
    ("1:3,7, 9:10", [1, 2, 3, 7, 9, 10]),
    ("0:1:0.1", [float(Decimal(k) / 10) for k in range(11)]),
    ("-0.5:0.5:0.5", [-0.5, 0.0, 0.5]),
    (".5:1.5", [0.5, 1.5]),
    ("5:5", [5]),
    ('"a, b","c"', ["a, b", "c"]),
    ("left,right", ["left", "right"]),
    ("true,false", [True, False]),
])  # fmt: skip
def test_lists_and_ranges(text: str, values: list[object]) -> None:
    (axis,) = axes_of([f"gear.module={text}"], SCENE)
    assert list(axis.values) == values
    assert [type(v) for v in axis.values] == [type(v) for v in values]


def test_a_step_of_a_half_finds_the_whole_numbers_of_a_key_that_takes_no_others() -> None:
    # all of them were refused, 8.0 teeth too
    (axis,) = axes_of(["gear.number_of_teeth=8:9:0.5"], SCENE)
    assert [(value, type(value)) for value in axis.values] == [(8, int), (8.5, float), (9, int)]


def test_every_choice_once_in_a_folder_of_its_own() -> None:
    (dotted,) = variants(SCENE, axes_of(["gear.title=No."], SCENE))
    assert not dotted.name.endswith(".")
    axes = axes_of(["gear.number_of_teeth=8:10", "other.module=1,2.5", "gear.material=ÄÖ/..,steel"], SCENE)
    found = list(variants(SCENE, axes))
    # centred on d and on D: two splines, which were refused for one listed twice
    cases = list(variants(SCENE, axes_of(["gear.bore.size=d-8x36x40,D-8x36x40,D-8x36x42"], SCENE)))
    assert [v.values["gear.bore.size"] for v in cases] == ["d-8x36x40", "D-8x36x40", "D-8x36x42"]
    assert len({v.name.lower() for v in cases}) == 3
    assert [v.name for v in cases][::2] == ["gear.bore.size=d-8x36x40", "gear.bore.size=D-8x36x42"]
    assert len(found) == 12
    assert len({v.name.lower() for v in found}) == 12
    assert all(v.name.isascii() and "/" not in v.name for v in found)
    for v in found:
        parts = v.scene["parts"]
        assert parts["gear"]["number_of_teeth"] == v.values["gear.number_of_teeth"]
        assert parts["other"]["module"] == v.values["other.module"]
        assert parts["gear"]["module"] == parts["other"]["number_of_teeth"] - 21 == 2
    assert found[0].name.startswith("gear.number_of_teeth=8,other.module=1,gear.material=")


def test_dates_and_numbers_of_thousands_of_digits_are_values_as_typed() -> None:
    """What comes of them is a row's: before, no table could hold a date, nor Python read so long a number."""
    for text in ("2026-01-01", "10:00:00", f"1{'0' * 5000}"):
        assert axes_of([f"gear.module={text}"], SCENE)[0].values == (text,)
    assert axes_of(["gear.module=[2026-01-01, 2]"], SCENE)[0].values == (["2026-01-01", 2],)


def test_a_key_within_a_table() -> None:
    (axis,) = axes_of(["gear.tip_relief.depth_coefficient=0.01,0.02"], SCENE)
    assert [v.scene["parts"]["gear"]["tip_relief"] for v in variants(SCENE, [axis])] == [
        {"depth_coefficient": value} for value in (0.01, 0.02)
    ]


@pytest.mark.parametrize(("words", "code", "key"), [
    (["gear.module"], "no_variation", "gear.module"),
    (["module=1,2"], "no_variation", "module=1,2"),
    (["gear.module="], "no_variation", "gear.module="),
    (["gear.module=1,,2"], "no_variation", "gear.module"),
    (["wheel.module=1"], "no_such_part", "wheel.module"),
    (["gear.modul=1"], "unknown_key", "parts.gear.modul"),
    (["gear.module.x=1"], "unknown_key", "gear.module.x"),
    (["gear.tip_relief.x=1"], "unknown_key", "parts.gear.tip_relief.x"),
    (["gear.module=2:1"], "no_range", "gear.module"),
    (["gear.module=1:2:0"], "no_range", "gear.module"),
    (["gear.module=1:2:-1"], "no_range", "gear.module"),
    (["gear.module=1:1e30:1e-30"], "no_range", "gear.module"),
    # before: a traceback of numbers beyond what decimal ones hold
    (["gear.module=1:1e9999999999"], "no_range", "gear.module"),
    (["gear.module=0:1:1e-9999999"], "no_range", "gear.module"),
    # ends are included: 12.5 was left out without a word
    (["gear.number_of_teeth=10:12.5"], "range_misses_end", "gear.number_of_teeth"),
    (["gear.module=1,1.0"], "listed_twice", "gear.module"),
    (["gear.material=steel,steel"], "listed_twice", "gear.material"),
    (["gear.module=1", "gear.module=2"], "given_twice", "gear.module"),
    (["gear.module=1:1000", "other.module=1:1000"], "too_many_variants", "gear.module=1:1000 other.module=1:1000"),
])  # fmt: skip
def test_what_is_no_variation_is_refused_by_its_key(words: list[str], code: str, key: str) -> None:
    with pytest.raises(SceneError) as refusal:
        axes_of(words, SCENE)
    assert (refusal.value.code, refusal.value.key, refusal.value.source) == (code, key, "--vary")
    assert "\n" not in str(refusal.value)
